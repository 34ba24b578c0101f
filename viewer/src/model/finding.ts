// SPDX-License-Identifier: MIT
// Finds the bars that stand out, and writes the sentence about them, which stands above the views.
// docs/reference/report.md describes the criterion.
import { kLeastShare, kMostAbove, suggestedCut } from "./cuts";
import { counted, homology, short } from "../common/number_format";
import { capital, holes, intervalText, inWords, kindOfSegment, listed, shownValue, times } from "./words";
import { surfacesInWords } from "./scene_words";
import type { Bars } from "./bars";
import type { Meta } from "./meta";
import type { Report } from "./report";

export interface Finding {
  dim: number; // dimension of the bars that stand out, or of the longest one; -1 if there is none
  bars: number[]; // bars that stand out, the most persistent first; selected at the start
  sentence: string;
  components: boolean; // true if the sentence, the cut and the merge tree are about components
}

/// The gap between the longest bars of a dimension and the others.
export interface Gap {
  count: number; // bars above the widest gap
  ratio: number; // ratio of the lengths at its two ends; Infinity: nothing is below
}

const kLeastRatio = 2, // ratio of a gap that makes bars stand out
  kWideAmongFew = 4, // the same, among so few bars that all may lie above the gap
  // Least length of a bar that is alone in its dimension, as a share of the longest bar of H1 and
  // higher.
  kLeastAlone = 1 / 3,
  kHardly = 1.05,
  kMostKnown = 4 * kMostAbove, // number of bars of a dimension that are examined
  kMostSelected = 1000,
  kFew = 4; // number of bars; among so few, wide gaps occur by chance

/// The widest gap, as a ratio, between neighbours in a descending list of finite lengths > 0.
/// Lengths below a tenth of the first, and all lengths after the 64th, cannot be the upper end of a
/// gap.
/// @param alike the most lengths that may all lie above the gap, with nothing below it; this is the
/// result unless a gap among them is much wider than chance explains.
/// @param least the fewest lengths that may lie above the gap.
export function widestGap(lengths: ArrayLike<number>, alike = kFew, least = 1): Gap {
  const gap: Gap = { count: 0, ratio: 1 };
  const apart = lengths.length <= alike ? kWideAmongFew : kLeastRatio;
  for (let n = Math.max(1, least); n <= Math.min(lengths.length, kMostAbove); ++n) {
    if (lengths[n - 1]! < kLeastShare * lengths[0]!) break;
    const next = lengths[n];
    const ratio = next === undefined ? (n <= alike ? Infinity : 0) : lengths[n - 1]! / next;
    const isEnd = next === undefined && gap.ratio >= apart;
    if (ratio > gap.ratio && !isEnd) [gap.count, gap.ratio] = [n, ratio];
  }
  return gap;
}

/// The bars of one dimension of a barcode, grouped by what is known about their lengths.
interface Lengths {
  dim: number;
  endless: number[]; // bars of infinite length, except bars that are alive at the threshold
  reach: number; // the longest length; an infinite bar counts up to the last value
  isEndless: boolean; // true if a bar never ends; infinite bars may also have no beginning
  finite: number[]; // long bars that are alive at the threshold, and finite bars; longest first
  lengths: number[]; // their lengths; for a bar that is alive at the threshold, its known part
  alive: number; // the first `alive` bars of `finite` are alive at the threshold
}

/// @param threshold the value at which the complex was cut off. A bar that is alive there is at
/// least as long as its known part.
function lengthsOf(bars: Bars, dim: number, threshold: number | undefined): Lengths {
  const result: Lengths = {
    dim,
    endless: [],
    reach: 0,
    isEndless: false,
    finite: [],
    lengths: [],
    alive: 0,
  };
  const cut = dim > 0 ? threshold : undefined;
  const known: [bar: number, length: number][] = [],
    alive: typeof known = [];
  for (const bar of bars.of(dim, 0)) {
    const isAlive = bars.isInfinite(bar) && cut !== undefined;
    const length = isAlive ? cut - bars.birth[bar]! : bars.persistence(bar);
    if (length === Infinity) {
      result.endless.push(bar);
      result.isEndless ||= bars.isInfinite(bar);
    }
    else if (isAlive) alive.push([bar, length]);
    else if (!(length > 0) || known.length > kMostKnown) break;
    else known.push([bar, length]);
  }
  // A bar that is alive at the threshold may be longer than its known part, and thus cannot be the
  // lower end of a gap. It counts only if its known part is longer than all bars that end.
  const longer = alive.filter(([, length]) => length > (known[0]?.[1] ?? 0));
  result.alive = longer.length;
  known.unshift(...longer.sort((a, b) => b[1] - a[1]));
  result.finite = known.map(([bar]) => bar);
  result.lengths = known.map(([, length]) => length);
  const seen = result.endless
    .map((bar) => bars.high - bars.birth[bar]!)
    .filter((length) => length < Infinity);
  result.reach = seen.reduce((a, b) => Math.max(a, b), result.lengths[0] ?? 0);
  return result;
}

/// The bars of a dimension that stand out.
/// @param scale length below which a few bars count as noise.
function outstanding(found: Lengths, scale: number, range: number): { bars: number[]; gap: Gap } {
  // Every point is a component at first, so a few components are not evidence of structure.
  const gap = widestGap(found.lengths, found.dim === 0 ? 1 : kFew, found.alive);
  const shortest = found.lengths[gap.count - 1] ?? 0;
  const few = found.finite.length <= kFew && shortest < kLeastShare * range;
  const alone = gap.ratio === Infinity && found.lengths[0]! < kLeastAlone * scale;
  const isLong = shortest >= kLeastShare * scale && !few && !alone;
  const stands = gap.ratio >= kLeastRatio && isLong;
  const above = stands ? found.finite.slice(0, gap.count) : [];
  // One component always exists: it does not stand out among others.
  const only =
    found.dim === 0 && found.endless.length === 1 && found.isEndless && above.length === 0;
  return { bars: only ? [] : [...found.endless, ...above], gap };
}

export function findingOf(report: Report): Finding {
  const { bars, meta } = report;
  if (meta.barcodes.length > 1) return comparisonOf(report);
  if (report.tree && meta.tree?.command) return segmentsOf(report);
  const threshold = meta.provenance.threshold ?? undefined;
  const dims = [...bars.dims].reverse();
  const found = dims.map((dim) => lengthsOf(bars, dim, threshold));
  const scale = Math.max(0, ...found.filter((f) => f.dim > 0).map((f) => f.reach));
  const range = bars.high - bars.low;
  const out = found.map((f) => ({ found: f, ...outstanding(f, f.dim > 0 ? scale : 0, range) }));
  const some = out.filter((o) => o.bars.length > 0);
  // Whatever its values, a closed surface has a void that never ends: other bars say more.
  const first = some.find((o) => !isWhole(o.found, o.bars)) ?? some[0];
  if (!first) return nothingOf(dims[0] ?? -1, found, report);
  const others = some.filter((o) => o !== first);
  const names = others.map(
    (o) => `${inWords(o.bars.length).toLowerCase()} ${holes(o.found.dim, o.bars.length)}`,
  );
  const count = others.reduce((sum, o) => sum + o.bars.length, 0);
  const verb = count === 1 ? "stands" : "stand";
  const also = count > 0 ? ` ${capital(listed(names))} ${verb} out as well.` : "";
  return {
    dim: first.found.dim,
    bars: first.bars.length > kMostSelected ? [] : first.bars,
    components: out.some((o) => o.found.dim === 0 && o.bars.length > 0),
    sentence: `${sentenceOf(first.found, first.bars, first.gap, report)}.${also}`,
  };
}

/// True if a dimension above 1 has just one bar, which never ends: the class of the whole space.
function isWhole({ dim, isEndless, finite }: Lengths, out: number[]): boolean {
  return dim > 1 && isEndless && out.length === 1 && finite.length === 0;
}

function sentenceOf(found: Lengths, out: number[], gap: Gap, report: Report): string {
  const { meta, bars } = report;
  const many = out.length;
  const subject = `${inWords(many)} ${holes(found.dim, many)}`;
  const of = (bar: number) => intervalText(report, bar);
  const above = many - found.endless.length;
  if (above === 0) {
    const which = many <= 2 ? `: ${out.map(of).join(" and ")}` : "";
    const isLong = (bar: number) => isFinite(bars.birth[bar]!) && isFinite(bars.death[bar]!);
    const what = out.every(isLong)
      ? `${many === 1 ? "is" : "are"} longer than any number`
      : fate(found, many, meta, out.every((bar) => bars.isInfinite(bar)));
    return `${subject} ${what}${which}`;
  }
  const verb = many === 1 ? "stands out" : "stand out";
  const last = out[many - 1]!;
  const least = gap.count === found.alive ? "at least " : "";
  const ratio = `${least}${times(gap.ratio)} as long as the next`;
  const only = gap.ratio === Infinity;
  if (many === 1) return `${subject} ${verb}: ${of(last)}, ${only ? "the only one" : ratio}`;
  const shorter = many === 2 ? "shorter" : "shortest";
  return only
    ? `${subject} ${verb}: there are no others, and the ${shorter} is ${of(last)}`
    : `${subject} ${verb}: the ${shorter}, ${of(last)}, is ${ratio}`;
}

/// The end of a sentence about bars of infinite length; nothing is known about them beyond the
/// threshold.
function fate(found: Lengths, many: number, meta: Meta, all: boolean): string {
  const { threshold } = meta.provenance;
  if (!found.isEndless) return many === 1 ? "has no beginning" : "have no beginning";
  if (!all) return "have no beginning or no end";
  if (found.dim > 0 || many === 1) return many === 1 ? "never ends" : "never end";
  if (typeof threshold !== "number") return "never merge";
  return `are apart ${meta.value.negated ? "down" : "up"} to ${short(shownValue(meta, threshold))}`;
}

/// The finding if no bar stands out. It selects no bar, but if its sentence mentions components,
/// the page still suggests a cut.
function nothingOf(dim: number, found: Lengths[], report: Report): Finding {
  const sentence = nothing(found, report);
  const gap = toldOf(found, report).some((f) => f.dim === 0) ? gapOfCuts(report) : "";
  if (!gap) return plain(dim, sentence);
  return { ...plain(dim, sentence.replace(/\.$/, `; ${gap}.`)), components: true };
}

/// "the widest gap leaves 24 basins", as in the cut panel; nothing if the gap leaves one basin.
function gapOfCuts({ tree, meta }: Report): string {
  const at = tree && suggestedCut(tree, meta.tree?.from ?? 0, meta.tree?.to ?? Infinity);
  const left = at === undefined ? 0 : tree!.cut(at).segments.length;
  return left > 1 ? `the widest gap leaves ${counted(left, kindOfSegment(meta))}` : "";
}

/// The dimensions for which the sentence says why no bar stands out.
function toldOf(found: Lengths[], { image }: Report): Lengths[] {
  const some = found.filter((f) => f.finite.length > 0 || f.endless.length > 0);
  // Components of points say little if there are holes to mention.
  const isImage = image || some.every((f) => f.dim === 0);
  return (isImage ? some : some.filter((f) => f.dim > 0)).slice(0, 3);
}

/// "No loop stands out: the longest is 1.1 times as long as the next."
function nothing(found: Lengths[], report: Report): string {
  const { bars } = report;
  const told = toldOf(found, report);
  if (bars.size === 0) return "There are no bars.";
  if (told.length === 0) return "No bar stands out: all have length 0.";
  if (told.length === 1) {
    const f = told[0]!;
    if (f.dim === 0 && f.finite.length === 0) return "All is one component: there is no other bar.";
    return `No ${f.endless.length > 0 ? "other " : ""}${holes(f.dim)} stands out: ${lengthsInWords(f, false)}.`;
  }
  const each = told.map((f) =>
    f.finite.length > 0 ? lengthsInWords(f, true) : `all is one ${holes(f.dim)}`,
  );
  const names = listed(
    told.map((f) => holes(f.dim)),
    "or",
  );
  const alike = told.every((f) => f.alive === 0 && f.lengths[0]! / f.lengths[1]! < kHardly);
  const where = told.length === 2 ? "both" : "all";
  if (alike)
    return `No ${names} stands out: in ${where}, the longest bar is hardly longer than the next.`;
  return `No ${names} stands out: ${listed(each)}.`;
}

/// Compares the lengths in a dimension where no bar stands out.
/// @param named true to use a noun such as "loops", not only "all" and "the longest".
function lengthsInWords({ dim, lengths, alive, endless }: Lengths, named: boolean): string {
  const many = lengths.length;
  const hole = named ? ` ${holes(dim)}` : "",
    all = named ? ` ${holes(dim, 2)}` : "";
  if (many === 1) return `there is one${endless.length > 0 ? " other" : ""}${hole}, and it is short`;
  if (alive === many) return `all${all} are alive at the threshold, and short`;
  if (lengths[0] === lengths[many - 1])
    return `${many <= kMostKnown ? "all" : "the longest"}${all} are equally long`;
  const upper = Math.max(1, alive);
  const ratio = lengths[upper - 1]! / lengths[upper]!;
  const least = alive > 0 ? "at least " : "";
  const subject = alive > 1 ? `the shortest${hole} alive at the threshold` : `the longest${hole}`;
  return ratio < kHardly && alive === 0
    ? `${subject} is hardly longer than the next`
    : `${subject} is ${least}${times(ratio)} as long as the next`;
}

/// A finding that selects no bar.
function plain(dim: number, sentence: string): Finding {
  return { dim, bars: [], sentence, components: false };
}

/// The finding of a report of ph-segment, whose result is a number of segments instead of bars.
function segmentsOf({ tree, meta, bars }: Report): Finding {
  const { cut: at } = meta.tree!,
    what = kindOfSegment(meta);
  const { segments } = tree!.answer(at);
  const dim = bars.dims[0] ?? -1;
  const [largest] = segments;
  const surfaces = meta.scene ? surfacesInWords(meta.scene) : "";
  const found = (sentence: string) =>
    plain(dim, surfaces ? `${sentence} Besides: ${surfaces}.` : sentence);
  if (!largest) return found(`No ${what} was found.`);
  const points = (segment: typeof largest) => counted(segment.points, "point");
  if (segments.length === 1) return found(`One ${what} of ${points(largest)}.`);
  const ends = `the largest has ${points(largest)}, the smallest ${points(segments.at(-1)!)}`;
  return found(`${inWords(segments.length)} ${what}s: ${ends}.`);
}

function comparisonOf({ meta, bars, matching }: Report): Finding {
  const distances = (meta.distances ?? []).map((d) => ({
    dim: d.dim,
    value: d.bottleneck ?? Infinity,
  }));
  const most = distances.reduce(
    (a, b) => (b.value > a.value ? b : a),
    distances[0] ?? { dim: bars.dims[0] ?? -1, value: NaN },
  );
  const name = homology(most.dim);
  const left = bars.dims.filter((dim) => !distances.some((d) => d.dim === dim)).map(homology);
  const rest =
    left.length > 0 ? ` ${listed(left)} ${left.length === 1 ? "was" : "were"} not compared.` : "";
  const equal = left.length > 0 ? listed(distances.map((d) => homology(d.dim))) : "";
  if (Number.isNaN(most.value)) return plain(most.dim, `Two barcodes.${rest}`);
  if (most.value === 0)
    return plain(
      most.dim,
      `The two barcodes are equal${equal && ` in ${equal}`}: every bottleneck distance is 0.${rest}`,
    );
  if (most.value === Infinity)
    return plain(
      most.dim,
      `In ${name} different numbers of bars never end: the bottleneck distance is infinite.${rest}`,
    );
  const distance = `the bottleneck distance is ${short(most.value)}`;
  const sentence = `The barcodes differ most in ${name}: ${distance}.${rest}`;
  return { ...plain(most.dim, sentence), bars: matching?.widest(bars, most.dim) ?? [] };
}
