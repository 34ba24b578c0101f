// SPDX-License-Identifier: MIT
// Dots of a diagram that lie on each other, fanned out: each can be seen and hit.

const kPitch = 8.5, // pixels from dot to dot
  kMostFanned = 24; // dots at one place; of more their number is shown

export interface Crowd {
  x: number;
  y: number;
  count: number;
}

/// Moves dots of equal bars: those on the line of infinity side by side, others around their place.
/// @param groups bars of one place each, in the order in which they get theirs.
/// @param onLine whether a bar is on the line of infinity.
/// @return the places with more dots than can be fanned out.
export function fanOut(
  groups: Iterable<number[]>,
  x: Float32Array,
  y: Float32Array,
  onLine: (bar: number) => boolean,
  right: number,
): Crowd[] {
  const crowds: Crowd[] = [];
  for (const group of groups) {
    const [first] = group as [number];
    const at = { x: x[first]!, y: y[first]! };
    if (group.length > kMostFanned) {
      crowds.push({ ...at, count: group.length });
      continue;
    }
    if (onLine(first)) {
      // To the side where there is room.
      const room = right - at.x > group.length * kPitch ? 1 : -1;
      group.forEach((bar, k) => (x[bar] = at.x + room * k * kPitch));
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
