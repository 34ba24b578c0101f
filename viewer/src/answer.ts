// SPDX-License-Identifier: MIT
// What stands out among the bars, and the sentence above the views that says so. docs/report.md has
// the criterion in words.
import { counted, homology, short } from "./numbers";
import { capital, holes, intervalText, inWords, listed, times } from "./words";
import type { Bars } from "./bars";
import type { Report } from "./report";

export interface Answer {
  dim: number; // of the bars that stand out, or of the longest one; -1: there is none
  bars: number[]; // that stand out, the most persistent first: selected at first
  sentence: string;
  components: boolean; // several components stand out: the merge tree says something
}

/// How far the longest bars of a dimension are from the others.
export interface Gap {
  count: number; // bars above the widest gap
  ratio: number; // of the lengths at its two ends; Infinity: nothing is below
}

const kLeastRatio = 2, // of a gap that makes bars stand out
  kLeastShare = 0.1, // of the longest bar: shorter ones are not at the upper end of a gap
  kHardly = 1.05,
  kMostAbove = 64, // bars above a gap
  kFew = 4; // bars; among so few wide gaps are chance

/// The widest gap, as a ratio, between neighbours of finite lengths > 0 that descend. Lengths below
/// a tenth of the first and all after the 64th are not at the upper end of it.
/// @param alike as many lengths are a gap by themselves, if there is none and nothing is below them.
export function widestGap(lengths: ArrayLike<number>, alike = kFew): Gap {
  const gap: Gap = { count: 0, ratio: 1 };
  for (let n = 1; n <= Math.min(lengths.length, kMostAbove); ++n) {
    if (lengths[n - 1]! < kLeastShare * lengths[0]!) break;
    const next = lengths[n];
    const ratio = next === undefined ? (n <= alike ? Infinity : 0) : lengths[n - 1]! / next;
    const isEnd = next === undefined && gap.ratio >= kLeastRatio;
    if (ratio > gap.ratio && !isEnd) [gap.count, gap.ratio] = [n, ratio];
  }
  return gap;
}

/// The bars of one dimension of a barcode by what is known of their lengths.
interface Lengths {
  dim: number;
  endless: number[]; // bars that never end
  finite: number[]; // bars, the longest first
  lengths: number[]; // of them; of a bar that is alive at the threshold what is known of it
  alive: number; // so many of `finite`, the first ones, are alive at the threshold
}

/// @param threshold where the complex was cut: bars alive there are at least that long.
function lengthsOf(bars: Bars, dim: number, threshold: number | undefined): Lengths {
  const result: Lengths = { dim, endless: [], finite: [], lengths: [], alive: 0 };
  const cut = dim > 0 ? threshold : undefined;
  const known: [bar: number, length: number][] = [],
    alive: typeof known = [];
  for (const bar of bars.of(dim, 0)) {
    const isAlive = bars.isInfinite(bar) && cut !== undefined;
    const length = isAlive ? cut - bars.birth[bar]! : bars.persistence(bar);
    if (length === Infinity) result.endless.push(bar);
    else if (isAlive) alive.push([bar, length]);
    else if (!(length > 0) || known.length > 4 * kMostAbove) break;
    else known.push([bar, length]);
  }
  // How long those would be that were born late nobody knows: they are no lower end of a gap.
  const longer = alive.filter(([, length]) => length > (known[0]?.[1] ?? 0));
  result.alive = longer.length;
  known.unshift(...longer.sort((a, b) => b[1] - a[1]));
  result.finite = known.map(([bar]) => bar);
  result.lengths = known.map(([, length]) => length);
  return result;
}

/// The bars of a dimension that stand out.
/// @param scale length below which few bars are noise.
function outstanding(found: Lengths, scale: number, range: number): { bars: number[]; gap: Gap } {
  // Some points have as many components at first.
  const gap = widestGap(found.lengths, found.dim === 0 ? 1 : kFew);
  const shortest = found.lengths[gap.count - 1] ?? 0;
  const few = found.finite.length <= kFew && shortest < kLeastShare * range;
  const stands = gap.ratio >= kLeastRatio && shortest >= kLeastShare * scale && !few;
  const above = stands ? found.finite.slice(0, gap.count) : [];
  // One component is always there: it is none that stands out among others.
  const alone = found.dim === 0 && found.endless.length === 1 && above.length === 0;
  return { bars: alone ? [] : [...found.endless, ...above], gap };
}

export function answerOf(report: Report): Answer {
  const { bars, meta } = report;
  if (meta.barcodes.length > 1) return comparisonOf(report);
  if (report.tree && meta.tree?.command) return segmentsOf(report);
  const threshold = meta.provenance.threshold ?? undefined;
  const dims = [...bars.dims].reverse();
  const found = dims.map((dim) => lengthsOf(bars, dim, threshold));
  const scale = Math.max(0, ...found.filter((f) => f.dim > 0).map((f) => f.lengths[0] ?? 0));
  const range = bars.high - bars.low;
  const out = found.map((f) => ({ found: f, ...outstanding(f, f.dim > 0 ? scale : 0, range) }));
  const first = out.find((o) => o.bars.length > 0);
  if (!first) return plain(dims[0] ?? -1, nothing(found, !!report.image));
  const others = out.filter((o) => o !== first && o.bars.length > 0);
  const names = others.map(
    (o) => `${inWords(o.bars.length).toLowerCase()} ${holes(o.found.dim, o.bars.length)}`,
  );
  const count = others.reduce((sum, o) => sum + o.bars.length, 0);
  const verb = count === 1 ? "stands" : "stand";
  const also = count > 0 ? ` ${capital(listed(names))} ${verb} out, too.` : "";
  return {
    dim: first.found.dim,
    bars: first.bars,
    components: out.some((o) => o.found.dim === 0 && o.bars.length > 0),
    sentence: `${sentenceOf(first.found, first.bars, first.gap, report)}.${also}`,
  };
}

function sentenceOf(found: Lengths, out: number[], gap: Gap, { meta, bars }: Report): string {
  const many = out.length;
  const subject = `${inWords(many)} ${holes(found.dim, many)}`;
  const of = (bar: number) => intervalText(meta, bars.birth[bar]!, bars.death[bar]!);
  const above = many - found.endless.length;
  if (above === 0) {
    const which = many <= 2 ? `: ${out.map(of).join(" and ")}` : "";
    return found.dim === 0 && many > 1
      ? `${subject} never merge${which}`
      : `${subject} never ${many === 1 ? "ends" : "end"}${which}`;
  }
  const verb = many === 1 ? "stands out" : "stand out";
  const last = out[many - 1]!;
  const least = out.some((bar) => bars.isInfinite(bar)) && found.alive > 0 ? "at least " : "";
  const ratio = `${least}${times(gap.ratio)} as long as the next`;
  const only = gap.ratio === Infinity;
  if (many === 1) return `${subject} ${verb}: ${of(last)}, ${only ? "the only one" : ratio}`;
  const shorter = many === 2 ? "shorter" : "shortest";
  return only
    ? `${subject} ${verb}: there are no others, and the ${shorter} is ${of(last)}`
    : `${subject} ${verb}: the ${shorter}, ${of(last)}, is ${ratio}`;
}

/// "No loop stands out: the longest is 1.1 times as long as the next."
function nothing(found: Lengths[], isImage: boolean): string {
  const some = found.filter((f) => f.finite.length > 0 || f.endless.length > 0);
  if (some.length === 0) return "There are no bars.";
  // Components of points say little where there are holes to speak of.
  const told = (
    !isImage && some.some((f) => f.dim > 0) ? some.filter((f) => f.dim > 0) : some
  ).slice(0, 3);
  const longer = (f: Lengths) => {
    const ratio = f.lengths[0]! / f.lengths[1]!;
    return ratio < kHardly ? "hardly longer than the next" : `${times(ratio)} as long as the next`;
  };
  const one = (f: Lengths) =>
    f.finite.length > 1 ? `the longest is ${longer(f)}` : "there is one, and it is short";
  if (told.length === 1) {
    const f = told[0]!;
    if (f.dim === 0 && f.finite.length === 0) return "All is one component: there is no other bar.";
    return `No ${holes(f.dim)} stands out: ${one(f)}.`;
  }
  const each = told.map((f) => {
    if (f.finite.length > 1) return `the longest ${holes(f.dim)} is ${longer(f)}`;
    return f.finite.length === 1
      ? `there is one ${holes(f.dim)}, and it is short`
      : `all is one ${holes(f.dim)}`;
  });
  const names = listed(
    told.map((f) => holes(f.dim)),
    "or",
  );
  const alike = told.every((f) => f.lengths[0]! / f.lengths[1]! < kHardly);
  if (alike) return `No ${names} stands out: of each the longest is hardly longer than the next.`;
  return `No ${names} stands out: ${listed(each)}.`;
}

/// Nothing is selected.
function plain(dim: number, sentence: string): Answer {
  return { dim, bars: [], sentence, components: false };
}

/// What ph-segment found is no single bar.
function segmentsOf({ tree, meta, bars }: Report): Answer {
  const { cut: at, what = "segment" } = meta.tree!;
  const { segments } = tree!.cut(at, tree!.hasJoins);
  const dim = bars.dims[0] ?? -1;
  const [largest] = segments;
  if (!largest) return plain(dim, `No ${what} was found.`);
  const points = (segment: typeof largest) => counted(segment.points, "point");
  if (segments.length === 1) return plain(dim, `One ${what} of ${points(largest)}.`);
  const ends = `the largest has ${points(largest)}, the smallest ${points(segments.at(-1)!)}`;
  return plain(dim, `${inWords(segments.length)} ${what}s: ${ends}.`);
}

function comparisonOf({ meta, bars, matching }: Report): Answer {
  const distances = (meta.distances ?? []).map((d) => ({
    dim: d.dim,
    value: d.bottleneck ?? Infinity,
  }));
  const most = distances.reduce(
    (a, b) => (b.value > a.value ? b : a),
    distances[0] ?? { dim: bars.dims[0] ?? -1, value: NaN },
  );
  const name = homology(most.dim);
  if (Number.isNaN(most.value)) return plain(most.dim, "Two barcodes.");
  if (most.value === 0)
    return plain(most.dim, "The two barcodes are equal: every bottleneck distance is 0.");
  if (most.value === Infinity)
    return plain(
      most.dim,
      `In ${name} different numbers of bars never end: the bottleneck distance is infinite.`,
    );
  const sentence = `The barcodes differ most in ${name}: ends of bars have to move by ${short(most.value)}, the bottleneck distance.`;
  return { ...plain(most.dim, sentence), bars: matching?.widest(bars, most.dim) ?? [] };
}
