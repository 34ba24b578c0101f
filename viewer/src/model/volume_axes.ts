// SPDX-License-Identifier: MIT
// The axes of a volume: their names, and the axis of the first slice.
import type { Meta } from "./meta";

/// The names of the axes, in the order of the array.
export function axisNames(meta: Meta): string[] {
  return meta.image?.axes ?? ["axis 0", "axis 1", "axis 2"];
}

/// The slice that is shown first: across z, or across the first axis.
export function firstAxis(meta: Meta): number {
  return meta.image?.axes ? 2 : 0;
}
