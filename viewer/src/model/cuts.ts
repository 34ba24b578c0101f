// SPDX-License-Identifier: MIT
// Finds cuts: the number of branches that a cut separates, and the widest gap between their
// persistences.
import { DisjointSets, numbered } from "./disjoint_sets";
import { FlatSets } from "./flat_sets";
import type { MergeTree } from "./merge_tree";

/// The upper end of a gap is at least this share of the largest level, and is one of the
/// `kMostAbove` largest levels.
export const kLeastShare = 0.1,
  kMostAbove = 64;

/// Levels of all merges, ascending.
function levelsOf(tree: MergeTree): Float64Array {
  return Float64Array.from(tree.arrays.levels).sort();
}

/// The number of segments at each of some ascending cuts. A larger cut joins everything that a
/// smaller one joins, so that one sweep is enough. O(n log n) for n leaves, merges and cuts.
export function segmentCounts(tree: MergeTree, cuts: number[]): number[] {
  const { levels, vertices, births, younger, elder, rule, minSize } = tree.arrays;
  const merges = numbered(tree.merges).sort((a, b) => levels[a]! - levels[b]!);
  const entries = numbered(tree.leaves);
  if (rule === "value") entries.sort((a, b) => births[a]! - births[b]!);
  const sets = new DisjointSets(tree.leaves),
    size = new Float64Array(tree.leaves),
    flat = new FlatSets(tree.arrays.flat, tree.leaves);
  let segments = 0,
    merged = 0,
    entered = 0;
  const count = (root: number) => {
    const isLarge = size[root]! > 0 && size[root]! >= minSize;
    return Number(isLarge && flat.surfaceOf(root, size[root]!) === 0);
  };
  return cuts.map((cut) => {
    for (
      ;
      entered < entries.length && (rule !== "value" || births[entries[entered]!]! <= cut);
      ++entered
    ) {
      const leaf = entries[entered]!,
        root = sets.find(leaf);
      segments -= count(root);
      size[root]! += vertices[leaf]!;
      flat.enter(leaf, root);
      segments += count(root);
    }
    for (; merged < merges.length && tree.isDone(merges[merged]!, cut); ++merged) {
      const u = sets.find(younger[merges[merged]!]!),
        v = sets.find(elder[merges[merged]!]!);
      if (u === v) continue;
      segments -= count(u) + count(v);
      const into = sets.join(u, v),
        from = into === u ? v : u;
      size[into]! += size[from]!;
      flat.join(from, into);
      segments += count(into);
    }
    return segments;
  });
}

/// A cut between the two neighbouring levels with the largest ratio. The upper of the two must be
/// one of the largest levels, because large ratios of small levels occur by chance. If no ratio is
/// large enough and the cut is by persistence, the cut lies between the two neighbouring levels
/// with the largest difference.
export function suggestedCut(tree: MergeTree, from: number, to: number): number | undefined {
  const levels = levelsOf(tree)
    .filter((v) => v > 0 && Number.isFinite(v))
    .slice(-kMostAbove - 1);
  const widest = (least: number, width: (low: number, high: number) => number) => {
    let best: number | undefined,
      most = least;
    for (let i = 0; i + 1 < levels.length; ++i) {
      const [low, high] = [levels[i]!, levels[i + 1]!];
      const middle = Math.sqrt(low) * Math.sqrt(high);
      if (high < kLeastShare * levels.at(-1)!) continue;
      if (width(low, high) <= most || middle < from || middle > to) continue;
      most = width(low, high);
      best = Number(middle.toPrecision(3));
    }
    return best;
  };
  const byRatio = widest(1.2, (low, high) => high / low);
  if (byRatio !== undefined || tree.arrays.rule === "value") return byRatio;
  return widest(0, (low, high) => high - low);
}

/// Number of steps of the slider.
export const kSteps = 2000;

/// Converts a slider's position (0 … 1) to a cut and back, on a logarithmic scale. Position 0 is
/// the least cut that is allowed, which may be 0.
export class CutScale {
  readonly from: number;
  readonly to: number;
  private readonly least: number; // smallest value on the logarithmic part
  private readonly digits: number; // digits that distinguish one step of the slider from the next

  constructor(tree: MergeTree, from: number | undefined, to: number | undefined, cut: number) {
    const levels = levelsOf(tree).filter((v) => v > 0 && Number.isFinite(v));
    const largest = Math.max(levels.at(-1) ?? 0, cut, from ?? 0);
    this.from = from ?? 0;
    this.to = to ?? (largest > 0 ? 1.1 * largest : 1);
    const low = Math.max(this.from, levels[Math.max(0, levels.length - 400)] ?? this.to / 100);
    const lower = Math.max(Math.min(low, cut > 0 ? cut / 2 : low), this.to * 1e-6);
    this.least = Math.min(Math.max(lower, this.from), this.to);
    const step = Math.log(this.to / this.least) / kSteps;
    this.digits = step > 0 ? Math.min(15, Math.max(4, Math.ceil(1 - Math.log10(step)))) : 4;
  }
  at(place: number): number {
    if (place <= 0) return this.from;
    if (place >= 1) return this.to;
    const cut = this.least * (this.to / this.least) ** place;
    return Math.min(this.to, Math.max(this.from, Number(cut.toPrecision(this.digits))));
  }
  place(cut: number): number {
    if (cut <= this.least || this.least === this.to) return 0;
    return Math.min(1, Math.log(cut / this.least) / Math.log(this.to / this.least));
  }
}
