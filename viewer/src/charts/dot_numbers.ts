// SPDX-License-Identifier: MIT
import type { Places } from "./matching_lines";
import type { Pen } from "./pen";
import { LabelPlaces } from "../common/label_places";
import type { Session } from "../model/session";

/// Places the numbers of segments at their dots: beneath the line of infinity, where dots are side
/// by side; otherwise beside the dots.
export function drawNumbers(pen: Pen, session: Session, { x, y }: Places): void {
  const labelPlaces = new LabelPlaces();
  for (const [bar, label] of session.numbers()) {
    const number = String(session.numberOf(label));
    if (!session.isShown(bar)) continue;
    const beneath = session.report.bars.isInfinite(bar);
    const at = x[bar]! + (beneath ? 0 : 11),
      base = y[bar]! + (beneath ? 15 : 3.5);
    if (!labelPlaces.take(at, base, number)) continue;
    pen.text(at, base, number, {
      colour: session.theme.muted,
      size: 9.5,
      anchor: "middle",
    });
  }
}
