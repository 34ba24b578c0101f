// SPDX-License-Identifier: MIT
// Charts whose items are bars: diagram and barcode. They share the keyboard control, the table and
// the description.
import { Chart } from "./chart";
import { table } from "../common/dom";
import { counted, homology, short } from "../common/number_format";
import { endsOf, intervalText, listed } from "../model/words";
import type { Session } from "../model/session";

const kMostRows = 500;

/// "H₁ [0.5, 2.25), persistence 1.75"; the name of the bar's barcode follows if there are two.
export function nameOfBar(session: Session, bar: number): string {
  const { bars, meta } = session.report;
  const of = meta.barcodes.length > 1 ? `, ${meta.barcodes[bars.barcodeOf(bar)]!.name}` : "";
  return `${homology(bars.dim[bar]!)} ${intervalText(session.report, bar)}, persistence ${short(bars.persistence(bar))}${of}`;
}

export abstract class BarChart extends Chart {
  private current = -1; // index among the shown bars, by persistence

  /// At most `most` of the bars whose dimensions are not hidden, the most persistent first.
  protected shownBars(most: number): Uint32Array {
    const { bars } = this.session.report,
      hidden = this.session.hiddenDims.size > 0;
    const shown = hidden
      ? bars.byPersistence.filter((bar) => this.session.isShown(bar))
      : bars.byPersistence;
    return bars.prominent(shown, most);
  }
  protected makeTable(): HTMLTableElement {
    const { bars, meta } = this.session.report;
    const two = meta.barcodes.length > 1;
    const shown = this.shownBars(kMostRows);
    const hidden = bars.dims.filter((dim) => this.session.hiddenDims.has(dim));
    const left = hidden.flatMap((dim) => meta.barcodes.map((_, i) => bars.count(dim, i)));
    const count = left.reduce((sum, n) => sum - n, bars.size);
    const caption = [
      shown.length < count ? `The ${shown.length} most persistent of ${counted(count, "bar")}` : counted(count, "bar"),
      ...(hidden.length > 0 ? [`without ${listed(hidden.map(homology))}`] : []),
    ].join(", ");
    return table(
      caption,
      [...(two ? ["barcode"] : []), "dimension", "birth", "death", "persistence"],
      Array.from(shown, (bar) => [
        ...(two ? [meta.barcodes[bars.barcodeOf(bar)]!.name] : []),
        bars.dim[bar]!,
        ...endsOf(this.session.report, bar, 6),
        short(bars.persistence(bar), 6),
      ]),
    );
  }
  protected describe(): string {
    const { bars } = this.session.report;
    const counts = bars.dims.map(
      (dim) => `${counted(bars.count(dim, 0), "bar")} in dimension ${dim}`,
    );
    return `${counts.join(", ") || "no bars"}. Arrow keys go from bar to bar, the most persistent first; Enter selects; with Shift, arrow keys select the bars that they pass.`;
  }
  protected step(by: number, extend: boolean): void {
    const shown = this.shownBars(this.session.report.bars.size);
    const from = Math.max(0, this.current);
    this.current = Math.min(shown.length - 1, Math.max(0, this.current + by));
    const bar = shown[this.current];
    if (bar === undefined) return;
    const [first, last] = [Math.min(from, this.current), Math.max(from, this.current)];
    if (extend) this.session.select(shown.subarray(first, last + 1), "add");
    this.session.setFocus({ bar });
  }
  protected choose(how: "replace" | "toggle"): void {
    if (this.session.focus.bar >= 0) this.session.select([this.session.focus.bar], how);
  }
}
