// SPDX-License-Identifier: MIT

/// 0 … size - 1.
export function numbered(size: number): Uint32Array {
  const numbers = new Uint32Array(size);
  for (let i = 0; i < size; ++i) numbers[i] = i;
  return numbers;
}

/// Disjoint sets with path halving; the root of a set is its smallest number.
export class DisjointSets {
  private readonly parent: Uint32Array;

  constructor(size: number) {
    this.parent = numbered(size);
  }
  find(v: number): number {
    const p = this.parent;
    while (p[v] !== v) v = p[v] = p[p[v]!]!;
    return v;
  }
  /// Precondition: two roots. @return the root that remains.
  join(a: number, b: number): number {
    const root = Math.min(a, b);
    this.parent[Math.max(a, b)] = root;
    return root;
  }
}
