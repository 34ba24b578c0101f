// SPDX-License-Identifier: MIT
// Decides which sets of leaves are surfaces of a scene (walls and boards) instead of segments.
import type { Numbers } from "./payload";

/// The data that distinguish the walls and boards of a scene from its segments: how many vertices
/// of each leaf lie on each plane. A set of leaves is surface `first` + p if at least the share
/// `least` of its vertices lies on plane p.
export interface FlatLeaves {
  on: Numbers; // leaf by leaf, `planes` numbers each
  planes: number;
  first: number;
  least: number;
}

/// Counts the vertices of sets of leaves on each plane.
export class FlatSets {
  private readonly on: Float64Array; // for each root, its number of vertices on each plane

  /// @param flat undefined for a tree without planes, in which no set is a surface.
  constructor(
    private readonly flat: FlatLeaves | undefined,
    leaves: number,
  ) {
    this.on = new Float64Array(leaves * (flat?.planes ?? 0));
  }
  /// Adds a leaf to a set.
  enter(leaf: number, root: number): void {
    const { flat } = this;
    for (let p = 0; p < (flat?.planes ?? 0); ++p)
      this.on[root * flat!.planes + p]! += flat!.on[leaf * flat!.planes + p]!;
  }
  /// Joins two sets.
  join(from: number, to: number): void {
    const planes = this.flat?.planes ?? 0;
    for (let p = 0; p < planes; ++p) this.on[to * planes + p]! += this.on[from * planes + p]!;
  }
  /// The number of the surface that a set is; 0 if the set is not a surface. @param vertices the
  /// number of vertices of the set.
  surfaceOf(root: number, vertices: number): number {
    const { flat } = this;
    for (let p = 0; p < (flat?.planes ?? 0); ++p)
      if (this.on[root * flat!.planes + p]! / vertices >= flat!.least) return flat!.first + p;
    return 0;
  }
}
