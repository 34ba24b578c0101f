// SPDX-License-Identifier: MIT
// The axes of a volume: what they are called, and across which one the first slice lies.
import type { Meta } from "./meta";

/// What the axes are called, in the order of the array.
export function axisNames(meta: Meta): string[] {
  return meta.image?.axes ?? ["axis 0", "axis 1", "axis 2"];
}

/// The slice that is shown first: across z, or the first axis.
export function firstAxis(meta: Meta): number {
  return meta.image?.axes ? 2 : 0;
}
