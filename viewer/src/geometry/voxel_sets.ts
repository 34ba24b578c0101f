// SPDX-License-Identifier: MIT
// The voxel set of each bar: its voxels and, in a volume, the surface around them.
import { placeInImage } from "./cell_geometry";
import type { Numbers } from "../model/payload";
import type { VoxelSets } from "../model/report";

/// The runs of the set of a bar; empty if the bar has no set.
export function runsOf(sets: VoxelSets | undefined, bar: number): Numbers {
  const set = sets?.ofBar.get(bar);
  if (!sets || set === undefined) return new Uint32Array();
  return sets.runs.subarray(2 * sets.start[set]!, 2 * sets.start[set + 1]!);
}

const kMostFaces = 150_000,
  kMostBlocks = 2 ** 22;

const kMostKept = 32;

/// The surface around the set of a bar. Surfaces are cached, because the pointer returns to the
/// same bars.
export function surfaceOfBar(sets: VoxelSets, bar: number, shape: number[]): Float32Array {
  const surface = sets.surfaces.get(bar) ?? surfaceOf(runsOf(sets, bar), shape);
  if (sets.surfaces.size >= kMostKept) sets.surfaces.clear();
  sets.surfaces.set(bar, surface);
  return surface;
}

/// Triangles around a set, as x, y, z of each corner. The voxels of a large set are grouped into
/// cubes. The edge of the cubes is doubled until few enough cubes are left, because the picture has
/// no room for more.
export function surfaceOf(runs: Numbers, shape: number[]): Float32Array {
  const box = boxOf(runs, shape);
  for (let step = 1; ; step *= 2) {
    const sizes = box.low.map((low, k) => Math.floor((box.high[k]! - low) / step) + 3);
    if (sizes.reduce((product, n) => product * n, 1) > kMostBlocks) continue;
    const corners = new Blocks(runs, shape, box.low, sizes, step).surface();
    if (corners.length <= 18 * kMostFaces) return Float32Array.from(corners);
  }
}

function boxOf(runs: Numbers, shape: number[]): { low: number[]; high: number[] } {
  const [, rows, columns] = shape as [number, number, number];
  const low = [Infinity, Infinity, Infinity],
    high = [-Infinity, -Infinity, -Infinity];
  const meet = (axis: number, at: number) => {
    low[axis] = Math.min(low[axis]!, at);
    high[axis] = Math.max(high[axis]!, at);
  };
  for (let i = 0; i + 1 < runs.length; i += 2)
    for (const place of [runs[i]!, runs[i]! + runs[i + 1]! - 1]) {
      meet(0, Math.floor(place / (rows * columns)));
      meet(1, Math.floor(place / columns) % rows);
      meet(2, place % columns);
    }
  // A run may continue past the end of a row or a plane.
  for (let i = 0; i + 1 < runs.length; i += 2) {
    const first = runs[i]!,
      last = first + runs[i + 1]! - 1;
    if (Math.floor(first / columns) !== Math.floor(last / columns)) {
      meet(2, 0);
      meet(2, columns - 1);
    }
    if (Math.floor(first / (rows * columns)) !== Math.floor(last / (rows * columns))) {
      meet(1, 0);
      meet(1, rows - 1);
    }
  }
  return { low, high };
}

/// Cubes of `step`³ voxels with an empty layer around them; a cube is in the set if any of its
/// voxels is.
class Blocks {
  private readonly isIn: Uint8Array;
  private readonly strides: [number, number, number];

  constructor(
    runs: Numbers,
    shape: number[],
    private readonly low: number[],
    private readonly sizes: number[],
    private readonly step: number,
  ) {
    const [, rows, columns] = shape as [number, number, number];
    const [planes, height, width] = sizes as [number, number, number];
    this.strides = [height * width, width, 1];
    this.isIn = new Uint8Array(planes * height * width);
    const block = (at: number, axis: number) => Math.floor((at - low[axis]!) / step) + 1;
    for (let i = 0; i + 1 < runs.length; i += 2)
      for (let place = runs[i]!, end = place + runs[i + 1]!; place < end; ++place)
        this.isIn[
          block(Math.floor(place / (rows * columns)), 0) * this.strides[0] +
            block(Math.floor(place / columns) % rows, 1) * width +
            block(place % columns, 2)
        ] = 1;
  }

  /// The faces between the set and the rest. Adjacent coplanar faces within a row form one
  /// rectangle.
  surface(): number[] {
    const corners: number[] = [];
    const [planes, rows, columns] = this.sizes as [number, number, number];
    for (let plane = 1; plane < planes - 1; ++plane)
      for (let row = 1; row < rows - 1; ++row)
        for (let axis = 0; axis < 3; ++axis)
          for (const side of [0, 1]) {
            const next = this.strides[axis]! * (2 * side - 1),
              from = plane * this.strides[0] + row * this.strides[1];
            let first = -1;
            for (let column = 1; column < columns; ++column) {
              const at = from + column;
              const open = this.isIn[at] === 1 && this.isIn[at + next] === 0;
              if (open && first < 0) first = column;
              if (first >= 0 && (!open || axis === 2)) {
                const last = open ? column + 1 : column;
                this.face(corners, [plane, row, first], last, axis, side);
                first = -1;
              }
            }
          }
    return corners;
  }
  private face(to: number[], from: number[], end: number, axis: number, side: number): void {
    const low = [...from],
      high = [from[0]! + 1, from[1]! + 1, end];
    if (side === 1) low[axis] = high[axis]!;
    else high[axis] = low[axis]!;
    const [u, v] = [0, 1, 2].filter((k) => k !== axis) as [number, number];
    const corner = (a: number, b: number) => {
      const at = [...low];
      if (a) at[u] = high[u]!;
      if (b) at[v] = high[v]!;
      const voxel = at.map((c, k) => (c - 1) * this.step + this.low[k]! - 0.5);
      return placeInImage(voxel[0]!, voxel[1]!, voxel[2]!);
    };
    const [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
    to.push(...a, ...b, ...c, ...a, ...c, ...d);
  }
}
