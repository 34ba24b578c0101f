// SPDX-License-Identifier: MIT
// Shows the number of dots as a tint where dots of a diagram would hide each other.
import type { Pen } from "./pen";
import type { Session } from "../model/session";

const kCell = 3; // pixels

/// @param x, y position of each bar, pixels.
export function drawDensity(
  pen: Pen,
  session: Session,
  x: Float32Array,
  y: Float32Array,
  size: { width: number; height: number },
): void {
  const { bars } = session.report;
  const columns = Math.ceil(size.width / kCell),
    rows = Math.ceil(size.height / kCell);
  for (const dim of bars.dims) {
    if (session.hiddenDims.has(dim)) continue;
    const counts = new Uint32Array(columns * rows);
    let most = 0;
    for (let i = 0; i < bars.size; ++i) {
      if (bars.dim[i] !== dim) continue;
      const column = Math.floor(x[i]! / kCell),
        row = Math.floor(y[i]! / kCell);
      if (!(column >= 0 && column < columns && row >= 0 && row < rows)) continue;
      most = Math.max(most, ++counts[row * columns + column]!);
    }
    const colour = session.colourOfDim(dim),
      scale = 1 / Math.log(most + 1);
    counts.forEach((count, cell) => {
      if (count > 0)
        pen.rect(
          (cell % columns) * kCell,
          Math.floor(cell / columns) * kCell,
          kCell,
          kCell,
          colour,
          0.3 + 0.65 * Math.log(count + 1) * scale,
        );
    });
  }
}
