// SPDX-License-Identifier: MIT
// How the barcode shares its height: rows of each dimension, and which bars have one.
import { kRowOfFew } from "./bar_line";

export const kStrip = 12; // height of what stands for the bars without a row
const kLeastRow = 2.5,
  kMostRow = 14,
  kFewBars = 6; // of a dimension that has higher rows where the others are thin

/// So many rows fill the room.
export function rowsIn(room: number): number {
  return Math.floor(room / kMostRow);
}

/// How many rows each dimension has, and how high they are: where all of them are thin, those of a
/// dimension with few bars are not.
export function layOut(
  counts: number[],
  wishes: number[],
  room: number,
): { rows: number[]; heights: number[] } {
  const isFew = counts.map((count) => count <= kFewBars);
  const needed = counts.reduce((sum, count, i) => sum + (isFew[i] ? count * kRowOfFew : 0), 0);
  const share = (high: boolean[], taken: number) => {
    const others = wishes.map((wish, i) => (high[i] ? 0 : wish));
    const some = others.filter((wish) => wish > 0).length;
    const given = shared(others, Math.floor((room - taken - kStrip * some) / kLeastRow));
    const rows = given.map((n, i) => (high[i] ? counts[i]! : n));
    const strips = kStrip * rows.filter((n, i) => n < counts[i]!).length;
    const sum = rows.reduce((a, n, i) => a + (high[i] ? 0 : n), 0);
    const row = Math.min(kMostRow, (room - taken - strips) / Math.max(1, sum));
    return { rows, heights: high.map((is) => (is ? kRowOfFew : row)), row };
  };
  const even = share(counts.map(() => false), 0);
  return even.row >= kRowOfFew || needed > room / 2 ? even : share(isFew, needed);
}

/// Bars with a row, the last of them replaced by `most` of those that want one at most.
export function withRows(bars: Uint32Array, wanted: number[], most: number): Uint32Array {
  const present = new Set(bars),
    wants = new Set(wanted);
  const missing = wanted.filter((bar) => !present.has(bar)).slice(0, most);
  const result = bars.slice();
  for (let i = result.length - 1; i >= 0 && missing.length > 0; --i)
    if (!wants.has(result[i]!)) result[i] = missing.pop()!;
  return result;
}

/// Shares rows among bands: none gets more than it needs, what is left over goes to the others.
function shared(needs: number[], rows: number): number[] {
  const given = needs.map(() => 0);
  let open = needs.map((_, i) => i),
    left = Math.max(needs.length, rows);
  while (open.length > 0) {
    const share = Math.max(1, Math.floor(left / open.length));
    const content = open.filter((i) => needs[i]! <= share);
    if (content.length === 0) {
      for (const i of open) given[i] = share;
      break;
    }
    for (const i of content) {
      given[i] = needs[i]!;
      left -= needs[i]!;
    }
    open = open.filter((i) => needs[i]! > share);
  }
  return given;
}
