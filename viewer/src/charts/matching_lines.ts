// SPDX-License-Identifier: MIT
import type { Axis } from "./axis";
import { Matching } from "../model/matching";
import type { Pen } from "./pen";
import type { Session } from "../model/session";

const kMostDrawn = 1500; // pairs

/// The positions of the bars of a diagram.
export interface Places {
  x: Float32Array;
  y: Float32Array;
  births: Axis;
  deaths: Axis;
}

/// Shows the matching of two barcodes: lines between pairs, and dotted lines to the diagonal for
/// bars without a partner. If there are many pairs, only the pairs that move farthest are drawn.
/// @return the number of lines, and how many of them are drawn.
export function drawMatching(
  pen: Pen,
  session: Session,
  { x, y, births, deaths }: Places,
): { drawn: number; all: number } {
  const { theme, report } = session;
  const { matching, bars } = report;
  if (!matching) return { drawn: 0, all: 0 };
  const pairs: { bar: number; partner: number | undefined; move: number }[] = [];
  for (let bar = 0; bar < bars.size; ++bar) {
    const partner = matching.partnerOf(bar);
    if (!session.isShown(bar) || (partner !== undefined && partner < bar)) continue;
    pairs.push({ bar, partner, move: Matching.move(bars, bar, partner) });
  }
  // Compares instead of subtracting, because Infinity - Infinity is NaN.
  if (pairs.length > kMostDrawn) pairs.sort((a, b) => (a.move > b.move ? -1 : 1));
  const shown = pairs.slice(0, kMostDrawn);
  for (const { bar, partner } of shown) {
    if (partner !== undefined)
      pen.line(x[bar]!, y[bar]!, x[partner]!, y[partner]!, theme.muted, 1.2);
    else if (!bars.isInfinite(bar) && bars.birth[bar]! > -Infinity) {
      const middle = bars.birth[bar]! / 2 + bars.death[bar]! / 2;
      pen.line(x[bar]!, y[bar]!, births.at(middle), deaths.at(middle), theme.muted, 1, [2, 3]);
    }
  }
  return { drawn: shown.length, all: pairs.length };
}
