// SPDX-License-Identifier: MIT
// The merge tree of H0 and its cuts. It uses the same arithmetic on the same doubles as
// ph::MergeTree, so that a cut has the same segments here as in the program.
//
// The program has contracted everything that no cut can separate: a leaf is a set of vertices that
// are together in every cut. Each leaf is also a branch, which is born there and dies in the merge
// in which its component is the younger one.
import { DisjointSets, numbered } from "./disjoint_sets";
import { FlatSets, type FlatLeaves } from "./flat_sets";
import { kNone, PayloadError, type Numbers } from "./payload";

/// The rule for doing a merge at a cut. `persistence`: the merge is done if its level, which is its
/// persistence, is below the cut. `value`: it is done if its level, which is its value, is at most
/// the cut.
export type CutRule = "persistence" | "value";

/// The label and the surface of each leaf; 0: none.
export interface Answer {
  labels: Numbers;
  surfaces: Numbers;
  segments: number;
}

export interface TreeArrays {
  rule: CutRule;
  minSize: number; // fewest vertices of a segment
  births: Numbers;
  points: Numbers;
  vertices: Numbers;
  younger: Numbers; // the leaf at the edge's end in the younger component
  elder: Numbers;
  values: Numbers;
  levels: Numbers;
  answer: Answer | undefined; // the program's segments, at its own cut
  flat: FlatLeaves | undefined; // which components are surfaces, at any other cut
  touching: Numbers | undefined; // pairs of leaves that touch in space
  mergeBar: Numbers | undefined;
  leafBar: Numbers | undefined;
  infinite: (bar: number) => boolean;
}

export interface Segment {
  label: number;
  points: number;
  vertices: number;
  oldestLeaf: number;
}

export interface Cut {
  labelOfLeaf: Uint32Array; // 0: in no segment
  surfaceOfLeaf: Uint8Array; // 0: on no surface
  segments: Segment[]; // segment i has label i + 1
}

export class MergeTree {
  readonly leaves: number;
  readonly merges: number;
  /// The merge that kills each branch; kNone for a branch that never dies.
  readonly deathOf: Uint32Array;
  /// The branch that each branch merges into, or kNone.
  readonly parentOf: Uint32Array;
  /// An order in which each branch comes right before the branches that merge into it, and the
  /// index of each branch in this order.
  readonly order: Uint32Array;
  readonly rank: Uint32Array;
  /// One past the last index of the branches that merge into a branch.
  readonly end: Uint32Array;
  /// The bar of each branch, and the branch of each bar. An unknown bar is kNone; an unknown branch
  /// is missing.
  readonly barOf: Uint32Array;
  private readonly branchOfBar = new Map<number, number>();

  constructor(readonly arrays: TreeArrays) {
    this.leaves = arrays.births.length;
    this.merges = arrays.younger.length;
    this.checkSizes();
    this.deathOf = new Uint32Array(this.leaves).fill(kNone);
    this.parentOf = new Uint32Array(this.leaves).fill(kNone);
    this.barOf = new Uint32Array(this.leaves).fill(kNone);
    this.order = new Uint32Array(this.leaves);
    this.rank = new Uint32Array(this.leaves);
    this.end = new Uint32Array(this.leaves);
    this.linkBranches();
    this.orderBranches();
    this.linkBars();
  }

  isDone(merge: number, cut: number): boolean {
    const level = this.arrays.levels[merge]!;
    return this.arrays.rule === "persistence" ? level < cut : level <= cut;
  }
  /// Number of vertices of each branch with everything that merges into it.
  sizes(): Float64Array {
    const before = new Float64Array(this.leaves + 1);
    this.order.forEach(
      (leaf, place) => (before[place + 1] = before[place]! + this.arrays.vertices[leaf]!),
    );
    return Float64Array.from(
      { length: this.leaves },
      (_, b) => before[this.end[b]!]! - before[this.rank[b]!]!,
    );
  }
  /// How long a branch stays separate, in the measure of the cut.
  level(branch: number): number {
    const merge = this.deathOf[branch]!;
    return merge === kNone ? Infinity : this.arrays.levels[merge]!;
  }
  death(branch: number): number {
    const merge = this.deathOf[branch]!;
    return merge === kNone ? Infinity : this.arrays.values[merge]!;
  }
  /// The branch that a leaf belongs to in a cut: the innermost branch around the leaf that is not
  /// merged.
  branchAt(leaf: number, cut: number): number {
    let branch = leaf;
    for (;;) {
      const merge = this.deathOf[branch]!;
      if (merge === kNone || !this.isDone(merge, cut)) return branch;
      branch = this.parentOf[branch]!;
    }
  }
  /// For each leaf, the branch that it belongs to in a cut.
  branchesAt(cut: number): Uint32Array {
    const branches = new Uint32Array(this.leaves);
    for (const branch of this.order) {
      const merge = this.deathOf[branch]!; // its parent comes before it
      const isMerged = merge !== kNone && this.isDone(merge, cut);
      branches[branch] = isMerged ? branches[this.parentOf[branch]!]! : branch;
    }
    return branches;
  }
  /// Marks the leaves of a branch, without the branches inside it that the cut keeps apart.
  markBranch(branch: number, cut: number, mask: Uint8Array): void {
    for (let r = this.rank[branch]!; r < this.end[branch]!;) {
      const b = this.order[r]!;
      const apart = b !== branch && cut > 0 && !this.isDone(this.deathOf[b]!, cut);
      if (!apart) mask[b] = 1;
      r = apart ? this.end[b]! : r + 1;
    }
  }
  /// Calls `mark` on the leaves that markBranch marks. @return the value up to which the vertices
  /// of these leaves form the component that is born in the branch. At this value, the component
  /// dies or meets a part that the cut keeps separate.
  markBasin(branch: number, cut: number, mark: (leaf: number) => void): number {
    let limit = this.death(branch);
    for (let r = this.rank[branch]!; r < this.end[branch]!;) {
      const b = this.order[r]!;
      const apart = b !== branch && cut > 0 && !this.isDone(this.deathOf[b]!, cut);
      if (apart) limit = Math.min(limit, this.death(b));
      else mark(b);
      r = apart ? this.end[b]! : r + 1;
    }
    return limit;
  }
  branchOf(bar: number): number | undefined {
    return this.branchOfBar.get(bar);
  }
  /// The segments of the program's own cut, unchanged; for a tree that does not state them, the
  /// segments of the cut `at`.
  answer(at: number): Cut {
    const { answer, points, vertices, births } = this.arrays;
    if (!answer) return this.cut(at);
    const segments: Segment[] = Array.from({ length: answer.segments }, (_, i) => ({
      label: i + 1,
      points: 0,
      vertices: 0,
      oldestLeaf: -1,
    }));
    for (let leaf = 0; leaf < this.leaves; ++leaf) {
      const segment = segments[answer.labels[leaf]! - 1];
      if (!segment) continue;
      segment.points += points[leaf]!;
      segment.vertices += vertices[leaf]!;
      if (segment.oldestLeaf < 0 || births[leaf]! < births[segment.oldestLeaf]!)
        segment.oldestLeaf = leaf;
    }
    return {
      labelOfLeaf: Uint32Array.from(answer.labels),
      surfaceOfLeaf: Uint8Array.from(answer.surfaces),
      segments,
    };
  }

  /// The segments of a cut, as MergeTree::basins or MergeTree::components and extract_components
  /// find them. O(leaves + merges + segments log segments).
  cut(at: number): Cut {
    const a = this.arrays;
    const sets = new DisjointSets(this.leaves);
    const join = (x: number, y: number) => void sets.join(sets.find(x), sets.find(y));
    for (let k = 0; k < this.merges; ++k) if (this.isDone(k, at)) join(a.younger[k]!, a.elder[k]!);
    return this.extract(sets, at);
  }

  private extract(sets: DisjointSets, at: number): Cut {
    const a = this.arrays;
    const points = new Float64Array(this.leaves),
      vertices = new Float64Array(this.leaves);
    const oldest = new Int32Array(this.leaves).fill(-1);
    const rootOf = new Uint32Array(this.leaves).fill(kNone);
    const flat = new FlatSets(a.flat, this.leaves);
    for (let leaf = 0; leaf < this.leaves; ++leaf) {
      if (a.rule === "value" && a.births[leaf]! > at) continue;
      const root = (rootOf[leaf] = sets.find(leaf));
      points[root]! += a.points[leaf]!;
      vertices[root]! += a.vertices[leaf]!;
      flat.enter(leaf, root);
      if (oldest[root]! < 0 || a.births[leaf]! < a.births[oldest[root]!]!) oldest[root] = leaf;
    }
    const roots: number[] = [],
      surfaceOfRoot = new Uint8Array(this.leaves);
    for (let leaf = 0; leaf < this.leaves; ++leaf)
      if (vertices[leaf]! > 0 && vertices[leaf]! >= a.minSize) {
        surfaceOfRoot[leaf] = flat.surfaceOf(leaf, vertices[leaf]!);
        if (surfaceOfRoot[leaf] === 0) roots.push(leaf);
      }
    // Leaves are numbered by their smallest vertex, and so are roots.
    roots.sort((x, y) => points[y]! - points[x]! || vertices[y]! - vertices[x]! || x - y);
    const labelOfRoot = new Uint32Array(this.leaves);
    const segments = roots.map((root, i) => {
      labelOfRoot[root] = i + 1;
      return {
        label: i + 1,
        points: points[root]!,
        vertices: vertices[root]!,
        oldestLeaf: oldest[root]!,
      };
    });
    const labelOfLeaf = new Uint32Array(this.leaves),
      surfaceOfLeaf = new Uint8Array(this.leaves);
    for (let leaf = 0; leaf < this.leaves; ++leaf) {
      if (rootOf[leaf] === kNone) continue;
      labelOfLeaf[leaf] = labelOfRoot[rootOf[leaf]!]!;
      surfaceOfLeaf[leaf] = surfaceOfRoot[rootOf[leaf]!]!;
    }
    return { labelOfLeaf, surfaceOfLeaf, segments };
  }

  private checkSizes(): void {
    const a = this.arrays;
    for (const column of [a.points, a.vertices])
      if (column.length !== this.leaves)
        throw new PayloadError("tree: leaf columns differ in length");
    for (const column of [a.elder, a.values, a.levels])
      if (column.length !== this.merges)
        throw new PayloadError("tree: merge columns differ in length");
    for (const column of a.answer ? [a.answer.labels, a.answer.surfaces] : [])
      if (column.length !== this.leaves)
        throw new PayloadError("tree: leaf columns differ in length");
    for (const label of a.answer?.labels ?? [])
      if (label > a.answer!.segments) throw new PayloadError(`tree: there is no segment ${label}`);
    if (a.flat && a.flat.on.length !== a.flat.planes * this.leaves)
      throw new PayloadError("tree: leaf_on has another size");
    for (const column of [a.younger, a.elder, a.touching ?? []])
      for (const leaf of column)
        if (leaf >= this.leaves) throw new PayloadError(`tree: there is no leaf ${leaf}`);
  }
  private linkBranches(): void {
    const a = this.arrays;
    const sets = new DisjointSets(this.leaves);
    const branch = numbered(this.leaves); // the branch of each root
    for (let k = 0; k < this.merges; ++k) {
      const younger = sets.find(a.younger[k]!),
        elder = sets.find(a.elder[k]!);
      if (younger === elder)
        throw new PayloadError(`tree: merge ${k} joins a component with itself`);
      this.deathOf[branch[younger]!] = k;
      const survivor = (this.parentOf[branch[younger]!] = branch[elder]!);
      branch[sets.join(younger, elder)] = survivor;
    }
  }
  /// Sorts the branches depth first. Branches that merge first come first, so that a drawing has no
  /// crossings.
  private orderBranches(): void {
    const head = new Uint32Array(this.leaves).fill(kNone),
      next = new Uint32Array(this.leaves).fill(kNone);
    const branchOfMerge = new Uint32Array(this.merges);
    for (let b = 0; b < this.leaves; ++b)
      if (this.deathOf[b] !== kNone) branchOfMerge[this.deathOf[b]!] = b;
    for (let k = this.merges - 1; k >= 0; --k) {
      const b = branchOfMerge[k]!,
        parent = this.parentOf[b]!;
      next[b] = head[parent]!;
      head[parent] = b;
    }
    let place = 0;
    for (let root = 0; root < this.leaves; ++root) {
      if (this.parentOf[root] !== kNone) continue;
      for (let b = root; ;) {
        this.rank[b] = place;
        this.order[place++] = b;
        if (head[b] !== kNone) {
          b = head[b]!;
          continue;
        }
        this.end[b] = place;
        while (b !== root && next[b] === kNone) {
          b = this.parentOf[b]!;
          this.end[b] = place;
        }
        if (b === root) break;
        b = next[b]!;
      }
    }
  }
  private linkBars(): void {
    const { mergeBar, leafBar, infinite } = this.arrays;
    const rootOf = (leaf: number) => {
      while (this.parentOf[leaf] !== kNone) leaf = this.parentOf[leaf]!;
      return leaf;
    };
    for (let b = 0; b < this.leaves; ++b) {
      const merge = this.deathOf[b]!;
      if (mergeBar && merge !== kNone) this.name(b, mergeBar[merge]!);
    }
    // Bars that no merge of the tree kills: infinite bars, and bars that were contracted away.
    if (leafBar) {
      for (let i = 0; i + 1 < leafBar.length; i += 2) {
        const leaf = leafBar[i]!,
          bar = leafBar[i + 1]!;
        if (this.branchOfBar.has(bar) || leaf >= this.leaves) continue;
        if (infinite(bar)) this.name(rootOf(leaf), bar);
        else this.branchOfBar.set(bar, leaf);
      }
    }
  }
  private name(branch: number, bar: number): void {
    if (bar === kNone) return;
    this.barOf[branch] = bar;
    this.branchOfBar.set(bar, branch);
  }
}
