// SPDX-License-Identifier: MIT
// The barcode: one line per bar, one band per dimension, two barcodes side by side. If there are
// more bars than rows, the most persistent ones have a row, and the others form a strip that is
// darker where more of them are alive.
import { Axis, kLabelSize } from "./axis";
import { BarChart } from "./bar_chart";
import {
  asManyAsFit,
  closeTogether,
  drawChosen,
  drawLine,
  kNumber,
  reachOf,
  thicknessOf,
  type Item,
} from "./bar_line";
import { kStrip, layOut, rowsIn, withRows } from "./barcode_rows";
import { clipped, grouped, homology } from "../common/number_format";
import { dimColour } from "../common/palette";
import { textWidth, type Pen } from "./pen";
import type { Size } from "../common/dom";
import type { Change, Session } from "../model/session";

const kLeft = 34,
  kRight = 32,
  kRightOfNumbers = 46,
  kTop = 8,
  kBottom = 38,
  kGap = 10,
  kRowsOfNoNote = 12,
  kDigit = 5.5,
  kMostRedrawn = 50_000; // most bars that are redrawn whenever the cut changes

interface Band {
  dim: number;
  barcode: number;
  bars: Uint32Array; // bars with a row, in the order of the barcode: by birth
  rest: Uint32Array;
}

export class Barcode extends BarChart {
  protected redrawsOn: Change[] = ["dims", "colour"];
  private items: Item[] = [];
  private rowsFor: Map<number, string> | undefined; // bars that must have a row
  private axes: Axis[] = [];
  private readonly right: number; // room for arrows and, if bars have numbers, for these numbers

  constructor(session: Session) {
    super(session, "barcode", "Barcode", "");
    this.right = session.report.tree ? kRightOfNumbers : kRight;
    this.over.addEventListener("pointermove", (event) =>
      this.session.setFocus({ bar: this.barAt(event) }),
    );
    this.over.addEventListener("pointerleave", () => this.session.setFocus({}));
    this.over.addEventListener("click", (event) => {
      const bar = this.barAt(event),
        more = event.shiftKey || event.ctrlKey || event.metaKey;
      this.session.select(bar < 0 ? [] : [bar], more ? "toggle" : "replace");
    });
  }

  draw(pen: Pen, size: Size): void {
    const {
      theme,
      report: { bars, meta },
    } = this.session;
    this.items = [];
    this.rowsFor = this.session.tintedBars();
    this.axes = this.makeAxes(size);
    const two = meta.barcodes.length > 1;
    const top = kTop + (two ? 16 : 0),
      bottom = size.height - kBottom;
    const unit = clipped([meta.value.unit, this.axes[0]!.unit].filter(Boolean).join(" "), 24);
    const small = { colour: theme.muted, size: kLabelSize, anchor: "middle" } as const;
    this.axes.forEach((axis, i) => {
      for (const tick of axis.ticks(Math.max(2, (axis.to - axis.from) / 75))) {
        pen.line(tick.at, top, tick.at, bottom, theme.grid);
        const half = textWidth(tick.label, kLabelSize) / 2;
        pen.text(Math.max(tick.at, half), bottom + 14, tick.label, small);
      }
      pen.line(axis.from, bottom, axis.to, bottom, theme.faint);
      if (two)
        pen.text(
          (axis.from + axis.to) / 2,
          kTop + 5,
          clipped(meta.barcodes[i]!.name, (axis.to - axis.from) / 6.5),
          { ...small, colour: theme.ink },
        );
    });
    const label = clipped(meta.value.label.toLowerCase(), 40);
    pen.text(
      (kLeft + size.width - this.right) / 2,
      size.height - 7,
      unit ? `${label} (${unit})` : label,
      small,
    );
    if (bars.size === 0)
      pen.text(size.width / 2, (top + bottom) / 2, "no bars", { ...small, size: 13 });
    this.drawBands(pen, top, bottom);
  }

  protected drawOver(pen: Pen): void {
    const {
      theme,
      focus,
    } = this.session;
    const { bars } = this.session.report;
    const isQuick = bars.size <= kMostRedrawn;
    if (isQuick && this.rowsFor !== this.session.tintedBars()) return this.refresh();
    this.drawTinted(pen);
    for (const item of this.items)
      if (item.bar === focus.bar || this.session.isSelected(item.bar)) {
        const outline = item.bar === focus.bar ? theme.ink : theme.accent;
        drawChosen(pen, item, this.session.colourOfBar(item.bar), outline);
      }
    this.drawNumbers(pen);
  }
  private drawTinted(pen: Pen): void {
    const tints = this.session.tintedBars();
    for (const item of this.items) {
      const colour = tints.get(item.bar);
      if (colour) drawLine(pen, item, Math.max(1.5, thicknessOf(item.row)), colour);
    }
  }
  /// Draws the numbers of bars. All bars must be drawn first, so that no bar covers a number. If
  /// rows are less high than a number, the bars of neighbouring rows share one text, which stands
  /// at the end of the longest of these bars.
  private drawNumbers(pen: Pen): void {
    const numbers = this.session.numbers();
    const numbered = this.items.filter((item) => numbers.has(item.bar));
    for (const group of closeTogether(numbered)) {
      const x = 3 + Math.max(...group.map((item) => item.x2 + reachOf(item)));
      const y = group[0]!.y + group[0]!.row / 2; // the next group is far enough away
      const own = group.map((item) => this.session.numberOf(numbers.get(item.bar)!));
      pen.text(x, y + 3.5, asManyAsFit(own, (this.size.width - x) / kDigit), {
        colour: this.session.theme.muted,
        size: kNumber,
        halo: this.session.theme.panel,
      });
    }
  }

  private makeAxes(size: Size): Axis[] {
    const { bars, meta } = this.session.report;
    const n = meta.barcodes.length;
    const width = (size.width - kLeft - this.right * n) / n;
    return meta.barcodes.map((_, i) => {
      const from = kLeft + i * (width + this.right);
      return new Axis(bars.low, bars.high, from, from + width, meta.value.negated);
    });
  }

  private drawBands(pen: Pen, top: number, bottom: number): void {
    const {
      theme,
      report: { bars, meta },
    } = this.session;
    const dims = this.session.dimsInOrder().filter((dim) => !this.session.hiddenDims.has(dim));
    if (dims.length === 0) return;
    const room = bottom - top - kGap * dims.length;
    // If the finding is not about components, bars of components get only the rows that other
    // dimensions leave, but enough rows for the coloured bars.
    const few = this.session.finding.dim !== 0;
    const tinted = 2 * this.session.tintedBars().size;
    const counts = dims.map((dim) => Math.max(...meta.barcodes.map((_, i) => bars.count(dim, i))));
    const others = counts.reduce((sum, n, i) => sum + (dims[i] === 0 ? 0 : n), 0);
    const rest = Math.max(tinted, kRowsOfNoNote, rowsIn(room) - others);
    const wishes = counts.map((n, i) => (few && dims[i] === 0 ? Math.min(n, rest) : n));
    const { rows, heights } = layOut(counts, wishes, room);
    let y = top + kGap / 2;
    dims.forEach((dim, i) => {
      const row = heights[i]!;
      const height = rows[i]! * row + (counts[i]! > rows[i]! ? kStrip : 0);
      pen.text(kLeft - 8, y + Math.min(height / 2 + 4, height), homology(dim), {
        colour: dimColour(dim, theme),
        size: 12,
        anchor: "end",
        bold: true,
      });
      meta.barcodes.forEach((_, barcode) =>
        this.drawBand(pen, this.band(dim, barcode, rows[i]!), y, row),
      );
      y += height + kGap;
      if (i + 1 < dims.length)
        pen.line(kLeft, y - kGap / 2, this.axes.at(-1)!.to, y - kGap / 2, theme.grid);
    });
  }

  private band(dim: number, barcode: number, rows: number): Band {
    const { bars } = this.session.report,
      all = bars.of(dim, barcode),
      shown = withRows(bars.prominent(all, rows), this.wanted(dim, barcode), rows >> 1);
    const drawn = new Set(all.length > rows ? shown : []);
    return {
      dim,
      barcode,
      bars: shown.sort(),
      rest: drawn.size > 0 ? all.filter((bar) => !drawn.has(bar)) : all.subarray(rows),
    };
  }

  /// Bars of segments always have a row, even if many other bars are as long.
  private wanted(dim: number, barcode: number): number[] {
    return dim === 0 && barcode === 0 ? [...this.session.tintedBars().keys()] : [];
  }

  private drawBand(pen: Pen, band: Band, y: number, row: number): void {
    const { bars } = this.session.report;
    const axis = this.axes[band.barcode]!,
      colour = this.session.colourOfDim(band.dim);
    for (const bar of band.bars) {
      const x1 = bars.birth[bar] === -Infinity ? axis.from - 6 : axis.at(bars.birth[bar]!);
      const endless = bars.isInfinite(bar),
        x2 = endless ? axis.to + 6 : axis.at(bars.death[bar]!);
      const item = { bar, x1, x2, y, row, endless };
      drawLine(pen, item, thicknessOf(row), colour);
      this.items.push(item);
      y += row;
    }
    if (band.rest.length > 0) this.drawStrip(pen, band, axis, y);
  }

  private drawStrip(pen: Pen, band: Band, axis: Axis, y: number): void {
    const {
      theme,
      report: { bars },
    } = this.session;
    const columns = Math.ceil(axis.to - axis.from);
    const alive = new Int32Array(columns + 2);
    for (const bar of band.rest) {
      ++alive[Math.floor(axis.at(bars.birth[bar]!) - axis.from)]!;
      --alive[Math.floor(axis.at(bars.death[bar]!) - axis.from) + 1]!;
    }
    for (let i = 1; i < alive.length; ++i) alive[i]! += alive[i - 1]!;
    const scale = 1 / Math.log(alive.reduce((a, b) => Math.max(a, b), 0) + 1);
    for (let i = 0; i < columns; ++i)
      if (alive[i]! > 0)
        pen.rect(
          axis.from + i,
          y + 2,
          1,
          3,
          this.session.colourOfDim(band.dim),
          0.2 + 0.75 * Math.log(alive[i]! + 1) * scale,
        );
    pen.text(axis.to, y + 13, `+ ${grouped(band.rest.length)} more`, {
      colour: theme.muted,
      size: 9.5,
      anchor: "end",
    });
  }

  private barAt(event: MouseEvent): number {
    const [x, y] = this.place(event);
    let best = -1,
      nearest = 5;
    for (const item of this.items) {
      if (x < item.x1 - 4 || x > item.x2 + reachOf(item) + 8) continue;
      const distance = Math.abs(y - item.y - item.row / 2);
      if (distance < nearest) [best, nearest] = [item.bar, distance];
    }
    return best;
  }
}
