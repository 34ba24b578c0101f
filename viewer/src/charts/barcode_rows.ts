// SPDX-License-Identifier: MIT
// Divides the height of the barcode: the rows of each dimension, and the bars that get one.
import { kRowOfFew } from "./bar_line";

export const kStrip = 12; // height of the strip for bars without a row
const kLeastRow = 2.5,
  kMostRow = 14,
  kFewBars = 6; // most bars of a dimension whose rows stay higher when others are thin

/// The number of rows that fill the room.
export function rowsIn(room: number): number {
  return Math.floor(room / kMostRow);
}

/// The number and the height of the rows of each dimension. If rows have to be thin, the rows of a
/// dimension with few bars stay taller.
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

/// The bars that get a row: `bars`, except that at most `most` of the `wanted` bars that are
/// missing from it replace its last ones.
export function withRows(bars: Uint32Array, wanted: number[], most: number): Uint32Array {
  const present = new Set(bars),
    wants = new Set(wanted);
  const missing = wanted.filter((bar) => !present.has(bar)).slice(0, most);
  const result = bars.slice();
  for (let i = result.length - 1; i >= 0 && missing.length > 0; --i)
    if (!wants.has(result[i]!)) result[i] = missing.pop()!;
  return result;
}

/// Shares rows among bands. No band gets more rows than it needs; the rows that it leaves go to the
/// other bands.
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
