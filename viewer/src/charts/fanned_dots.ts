// SPDX-License-Identifier: MIT
// Dots of a diagram that lie on each other, fanned out: each can be seen and hit.

/// Pixels from dot to dot.
export const kPitch = 8.5;
/// Dots at one place; of more their number is shown.
const kMostFanned = 24,
  kMostOnLine = 60;

export interface Crowd {
  x: number;
  y: number;
  count: number;
}

/// Moves dots of equal bars: those on the line of infinity side by side, others around their place.
/// @param groups bars of one place each, in the order in which they get theirs.
/// @param onLine whether a bar is on the line of infinity.
/// @param isNumbered whether its number is beside it: it must not be hidden.
/// @return the places with more dots than can be fanned out.
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
      // All of them, or those with numbers and the others on each other behind these.
      const apart = group.length <= kMostOnLine ? group : group.filter(isNumbered);
      // To the side where there is more room.
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
      const angle = 2.399963 * k, // golden: evenly filled
        radius = 0.62 * kPitch * Math.sqrt(k);
      x[bar] = at.x + radius * Math.cos(angle);
      y[bar] = at.y + radius * Math.sin(angle);
    });
  }
  return crowds;
}
