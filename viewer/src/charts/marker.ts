// SPDX-License-Identifier: MIT
import type { Pen } from "./pen";

/// Each dimension has its own shape, because colours may be lost in print.
export function drawMarker(
  pen: Pen,
  dim: number,
  x: number,
  y: number,
  r: number,
  fill: string,
  opacity: number,
  stroke: string,
  width: number,
): void {
  switch (dim % 4) {
    case 1:
      return pen.polygon(
        [x, y - 1.25 * r, x + 1.15 * r, y + 0.8 * r, x - 1.15 * r, y + 0.8 * r],
        fill,
        opacity,
        stroke,
        width,
      );
    case 2:
      return pen.polygon(
        [x - r, y - r, x + r, y - r, x + r, y + r, x - r, y + r],
        fill,
        opacity,
        stroke,
        width,
      );
    case 3:
      return pen.polygon(
        [x, y - 1.35 * r, x + 1.1 * r, y, x, y + 1.35 * r, x - 1.1 * r, y],
        fill,
        opacity,
        stroke,
        width,
      );
    default:
      return pen.circle(x, y, r, fill, opacity, stroke, width);
  }
}
