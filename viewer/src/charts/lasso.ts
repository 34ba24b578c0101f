// SPDX-License-Identifier: MIT

/// True if a ray to the right crosses the polygon an odd number of times.
export function isInside(polygon: number[], x: number, y: number): boolean {
  let inside = false;
  for (let i = 0, j = polygon.length - 2; i < polygon.length; j = i, i += 2) {
    const xi = polygon[i]!,
      yi = polygon[i + 1]!,
      xj = polygon[j]!,
      yj = polygon[j + 1]!;
    if (yi > y !== yj > y && x < ((xj - xi) * (y - yi)) / (yj - yi) + xi) inside = !inside;
  }
  return inside;
}
