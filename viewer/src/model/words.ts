// SPDX-License-Identifier: MIT
// Describes holes and intervals in words. For superlevel sets, a report holds minus the values;
// readers see the values themselves, which fall from birth to death.
import { digitsFor, grouped, homology, short } from "../common/number_format";
import type { Meta } from "./meta";
import type { Report } from "./report";

/// "loop", "loops": the noun for a bar of a dimension.
export function holes(dim: number, count = 1): string {
  const many = count !== 1;
  if (dim > 2) return `${homology(dim)} class${many ? "es" : ""}`;
  return ["component", "loop", "void"][dim]! + (many ? "s" : "");
}

const kWords = "No One Two Three Four Five Six Seven Eight Nine Ten Eleven Twelve".split(" ");

/// A count at the beginning of a sentence: "Two", "13".
export function inWords(count: number): string {
  return kWords[count] ?? grouped(count);
}

export function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/// "20 times", "1.1 times".
export function times(ratio: number): string {
  if (ratio >= 1000) return "more than 1,000 times";
  return `${ratio >= 9.95 ? Math.round(ratio) : ratio.toFixed(1)} times`;
}

/// "a, b and c"
export function listed(words: string[], last = "and"): string {
  if (words.length < 2) return words.join("");
  return `${words.slice(0, -1).join(", ")} ${last} ${words.at(-1)}`;
}

/// The noun for a part of the cut.
export function kindOfSegment(meta: Meta): string {
  return meta.tree?.what ?? "segment";
}

/// A filtration value in the reader's terms.
export function shownValue(meta: Meta, value: number): number {
  return meta.value.negated ? 0 - value : value;
}

/// Birth and death of a bar, with enough digits to distinguish them; for a bar that never ends,
/// enough digits to distinguish the values in the report.
export function endsOf({ meta, bars }: Report, bar: number, least = 4): [string, string] {
  const ends = [bars.birth[bar]!, bars.death[bar]!];
  const size = Math.max(...ends.map(Math.abs).filter(Number.isFinite));
  const length = bars.persistence(bar);
  const digits = digitsFor(size, Number.isFinite(length) ? length : bars.high - bars.low);
  return ends.map((v) => short(shownValue(meta, v), Math.max(least, digits))) as [string, string];
}

/// "[0.184, 1.465)"; for superlevel sets, from the larger value to the smaller one.
export function intervalText(report: Report, bar: number): string {
  return `[${endsOf(report, bar).join(", ")})`;
}
