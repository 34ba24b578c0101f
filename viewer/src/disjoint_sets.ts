// SPDX-License-Identifier: MIT

/// 0 … size - 1.
export function numbered(size: number): Uint32Array {
  const numbers = new Uint32Array(size);
  for (let i = 0; i < size; ++i) numbers[i] = i;
  return numbers;
}

/// Disjoint sets by linking the smaller to the larger, with path halving.
export class DisjointSets {
  private readonly parent: Uint32Array;
  private readonly size: Uint32Array;

  constructor(size: number) {
    this.parent = numbered(size);
    this.size = new Uint32Array(size).fill(1);
  }
  find(v: number): number {
    const p = this.parent;
    while (p[v] !== v) v = p[v] = p[p[v]!]!;
    return v;
  }
  /// Precondition: two different roots. @return the one that is left.
  join(a: number, b: number): number {
    const [child, root] = this.size[a]! < this.size[b]! ? [a, b] : [b, a];
    this.parent[child] = root;
    this.size[root]! += this.size[child]!;
    return root;
  }
}
