// SPDX-License-Identifier: MIT
import type { Axis } from "./axis";
import type { Pen } from "./pen";
import type { Session } from "./session";

const kMostDrawn = 3000; // bars

/// Where the bars of a diagram are.
export interface Places {
  x: Float32Array;
  y: Float32Array;
  births: Axis;
  deaths: Axis;
}

/// Which bar of the first barcode becomes which one of the second: lines between pairs, and dotted
/// ones to the diagonal for those without a partner.
export function drawMatching(pen: Pen, session: Session, { x, y, births, deaths }: Places): void {
  const { theme, report } = session;
  const { matching, bars } = report;
  if (!matching || bars.size > kMostDrawn) return;
  for (let bar = 0; bar < bars.size; ++bar) {
    const partner = matching.partnerOf(bar);
    if (!session.isShown(bar) || (partner !== undefined && partner < bar)) continue;
    if (partner !== undefined)
      pen.line(x[bar]!, y[bar]!, x[partner]!, y[partner]!, theme.muted, 1.2);
    else if (!bars.isInfinite(bar) && bars.birth[bar]! > -Infinity) {
      const middle = bars.birth[bar]! / 2 + bars.death[bar]! / 2;
      pen.line(x[bar]!, y[bar]!, births.at(middle), deaths.at(middle), theme.muted, 1, [2, 3]);
    }
  }
}
