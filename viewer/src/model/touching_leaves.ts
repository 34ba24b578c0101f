// SPDX-License-Identifier: MIT
// Finds touching leaves if the program did not state them: leaves with neighbouring voxels, or with
// points in the same or neighbouring cubes of a coarse grid.
import type { Numbers } from "./payload";

const kCubes = 96; // cubes along the longest side

export function touchingInImage(leaf: Numbers, shape: number[], leaves: number): Uint32Array {
  const pairs = new Set<number>();
  const [, rows, columns] = shape as [number, number, number];
  for (const step of [1, columns, rows * columns])
    for (let i = 0; i + step < leaf.length; ++i) {
      const wraps =
        (step === 1 && (i + 1) % columns === 0) ||
        (step === columns && Math.floor(i / columns) % rows === rows - 1);
      if (!wraps) add(pairs, leaf[i]!, leaf[i + step]!, leaves);
    }
  return unpacked(pairs, leaves);
}

export function touchingInSpace(
  leaf: Numbers,
  positions: Float32Array,
  leaves: number,
): Uint32Array {
  const low = [Infinity, Infinity, Infinity],
    high = [-Infinity, -Infinity, -Infinity];
  positions.forEach((v, i) => {
    low[i % 3] = Math.min(low[i % 3]!, v);
    high[i % 3] = Math.max(high[i % 3]!, v);
  });
  const edge = Math.max(...high.map((h, k) => h - low[k]!)) / kCubes || 1;
  const sizes = high.map((h, k) => Math.floor((h - low[k]!) / edge) + 2);
  const strides = [1, sizes[0]!, sizes[0]! * sizes[1]!];
  const inCube = new Int32Array(strides[2]! * sizes[2]!).fill(-1);
  const pairs = new Set<number>();
  for (let i = 0; i < leaf.length; ++i) {
    if (leaf[i]! >= leaves) continue;
    let cube = 0;
    for (let k = 0; k < 3; ++k)
      cube += strides[k]! * Math.floor((positions[3 * i + k]! - low[k]!) / edge);
    if (inCube[cube]! < 0) inCube[cube] = leaf[i]!;
    add(pairs, inCube[cube]!, leaf[i]!, leaves);
    for (const stride of strides)
      for (const next of [cube - stride, cube + stride])
        if (inCube[next]! >= 0) add(pairs, inCube[next]!, leaf[i]!, leaves);
  }
  return unpacked(pairs, leaves);
}

function add(pairs: Set<number>, a: number, b: number, leaves: number): void {
  if (a === b || a >= leaves || b >= leaves) return;
  pairs.add(Math.min(a, b) * leaves + Math.max(a, b)); // exact: far below 2^53
}

function unpacked(pairs: Set<number>, leaves: number): Uint32Array {
  const result = new Uint32Array(2 * pairs.size);
  let at = 0;
  for (const pair of pairs) {
    result[at++] = Math.floor(pair / leaves);
    result[at++] = pair % leaves;
  }
  return result;
}
