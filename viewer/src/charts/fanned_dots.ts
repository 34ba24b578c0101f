// SPDX-License-Identifier: MIT
// Fans out dots of a diagram that coincide, so that each can be seen and hit.

/// Distance between dots in pixels.
export const kPitch = 8.5;
/// The most dots that are fanned out at one place, and on the line of infinity. If there are more,
/// their count is shown.
const kMostFanned = 24,
  kMostOnLine = 60;

export interface Crowd {
  x: number;
  y: number;
  count: number;
}

/// Moves the dots of equal bars apart: side by side on the line of infinity, and around their place
/// elsewhere.
/// @param groups the bars at each place, in the order in which they are placed.
/// @param onLine true if a bar is on the line of infinity.
/// @param isNumbered true if a bar has its number beside it and must not be hidden.
/// @return the places with too many dots to fan out.
export function fanOut(
  groups: Iterable<number[]>,
  x: Float32Array,
  y: Float32Array,
  onLine: (bar: number) => boolean,
  isNumbered: (bar: number) => boolean,
  left: number,
  right: number,
): Crowd[] {
  const crowds: Crowd[] = [];
  for (const group of groups) {
    const [first] = group as [number];
    const at = { x: x[first]!, y: y[first]! };
    if (onLine(first)) {
      // Fans out all dots, or only the numbered dots; then the other dots are stacked behind them.
      const apart = group.length <= kMostOnLine ? group : group.filter(isNumbered);
      // The dots extend towards the side with more room.
      const side = right - at.x >= at.x - left ? 1 : -1;
      const pitch = Math.min(kPitch, (side > 0 ? right - at.x : at.x - left) / apart.length);
      apart.forEach((bar, k) => (x[bar] = at.x + side * k * pitch));
      const end = at.x + side * apart.length * pitch;
      if (apart.length === group.length) continue;
      for (const bar of group) if (!isNumbered(bar)) x[bar] = end;
      crowds.push({ x: end, y: at.y, count: group.length - apart.length });
      continue;
    }
    if (group.length > kMostFanned) {
      crowds.push({ ...at, count: group.length });
      continue;
    }
    group.forEach((bar, k) => {
      const angle = 2.399963 * k, // golden angle: fills evenly
        radius = 0.62 * kPitch * Math.sqrt(k);
      x[bar] = at.x + radius * Math.cos(angle);
      y[bar] = at.y + radius * Math.sin(angle);
    });
  }
  return crowds;
}
