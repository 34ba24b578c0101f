// SPDX-License-Identifier: MIT
// The barcode: a line a bar, one band a dimension, two barcodes side by side. Where there are more
// bars than rows the most persistent ones have a row and the others are a strip: darker where more
// of them live.
import { Axis } from "./axis";
import { BarChart } from "./bar_chart";
import { clipped, grouped, homology } from "./numbers";
import { dimColour } from "./palette";
import type { Pen } from "./pen";
import type { Size } from "./chart";
import type { Change, Session } from "./session";

const kLeft = 34,
  kRight = 32,
  kTop = 8,
  kBottom = 38,
  kGap = 10,
  kStrip = 12,
  kLeastRow = 2.5,
  kRowsOfNoNote = 12,
  kMostRow = 14,
  kMostRedrawn = 50_000; // bars; more are not drawn anew at each cut

interface Item {
  bar: number;
  x1: number;
  x2: number;
  y: number; // upper end of its row
  row: number; // height
}
interface Band {
  dim: number;
  barcode: number;
  bars: Uint32Array; // that have a row, in the order of the barcode: by birth
  rest: Uint32Array;
}

export class Barcode extends BarChart {
  protected redrawsOn: Change[] = ["dims", "colour"];
  private items: Item[] = [];
  private rowsFor: Map<number, string> | undefined; // bars that had to have a row
  private axes: Axis[] = [];

  constructor(session: Session) {
    super(session, "barcode", "Barcode", "");
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
    const small = { colour: theme.muted, size: 10.5, anchor: "middle" } as const;
    this.axes.forEach((axis, i) => {
      for (const tick of axis.ticks(Math.max(2, (axis.to - axis.from) / 75))) {
        pen.line(tick.at, top, tick.at, bottom, theme.grid);
        pen.text(tick.at, bottom + 14, tick.label, small);
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
      (kLeft + size.width - kRight) / 2,
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
    for (const item of this.items) {
      const focused = item.bar === focus.bar;
      if (!focused && !this.session.isSelected(item.bar)) continue;
      const colour = focused ? theme.ink : theme.accent;
      const thick = Math.max(5, 0.75 * item.row),
        y = item.y + item.row / 2;
      pen.rect(item.x1 - 1.5, y - thick / 2 - 1.5, item.x2 - item.x1 + 3, thick + 3, colour);
      pen.rect(
        item.x1,
        y - thick / 2,
        Math.max(1, item.x2 - item.x1),
        thick,
        this.session.colourOfBar(item.bar),
      );
    }
  }
  private drawTinted(pen: Pen): void {
    const tints = this.session.tintedBars();
    if (tints.size === 0) return;
    const numbers = this.session.numbers();
    let free = -Infinity; // where the next number has room
    for (const { bar, x1, x2, y, row } of this.items) {
      const colour = tints.get(bar);
      if (!colour) continue;
      const thick = row > 5 ? 0.62 * row : Math.max(1.5, row);
      pen.rect(x1, y + (row - thick) / 2, Math.max(1, x2 - x1), thick, colour);
      const number = numbers.get(bar);
      if (number === undefined || y + row / 2 < free) continue;
      pen.text(x2 + (this.session.report.bars.isInfinite(bar) ? 4 : 3), y + row / 2 + 3.5, String(number), {
        colour: this.session.theme.muted,
        size: 9.5,
      });
      free = y + row / 2 + 9.5;
    }
  }

  private makeAxes(size: Size): Axis[] {
    const { bars, meta } = this.session.report;
    const n = meta.barcodes.length;
    const width = (size.width - kLeft - kRight * n) / n;
    return meta.barcodes.map((_, i) => {
      const from = kLeft + i * (width + kRight);
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
    // Components that say nothing leave the room to the others.
    const few = this.session.answer.dim !== 0 && this.session.tintedBars().size === 0;
    const counts = dims.map((dim) => Math.max(...meta.barcodes.map((_, i) => bars.count(dim, i))));
    const others = counts.reduce((sum, n, i) => sum + (dims[i] === 0 ? 0 : n), 0);
    const rest = Math.max(kRowsOfNoNote, Math.floor(room / kMostRow) - others);
    const wishes = counts.map((n, i) => (few && dims[i] === 0 ? Math.min(n, rest) : n));
    const rows = shared(wishes, Math.floor((room - kStrip * dims.length) / kLeastRow));
    const needsStrip = counts.map((count, i) => count > rows[i]!);
    const strips = needsStrip.filter(Boolean).length * kStrip;
    const row = Math.min(
      kMostRow,
      (room - strips) /
        Math.max(
          1,
          rows.reduce((a, b) => a + b, 0),
        ),
    );
    let y = top + kGap / 2;
    dims.forEach((dim, i) => {
      const height = rows[i]! * row + (needsStrip[i] ? kStrip : 0);
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

  /// Bars of segments: they have a row, however many others are as long.
  private wanted(dim: number, barcode: number): number[] {
    return dim === 0 && barcode === 0 ? [...this.session.tintedBars().keys()] : [];
  }

  private drawBand(pen: Pen, band: Band, y: number, row: number): void {
    const { bars } = this.session.report;
    const axis = this.axes[band.barcode]!,
      colour = this.session.colourOfDim(band.dim);
    const thick = row > 5 ? 0.62 * row : row > 3.2 ? row - 1.2 : row - 0.6;
    for (const bar of band.bars) {
      const x1 = bars.birth[bar] === -Infinity ? axis.from - 6 : axis.at(bars.birth[bar]!);
      const infinite = bars.isInfinite(bar),
        x2 = infinite ? axis.to + 6 : axis.at(bars.death[bar]!);
      pen.rect(x1, y + (row - thick) / 2, Math.max(1, x2 - x1), thick, colour);
      if (infinite) {
        const r = Math.min(5, Math.max(2.5, row / 2)),
          middle = y + row / 2;
        pen.polygon([x2, middle - r, x2 + 1.6 * r, middle, x2, middle + r], colour);
      }
      this.items.push({ bar, x1, x2: x2 + (infinite ? 6 : 0), y, row });
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
      if (x < item.x1 - 4 || x > item.x2 + 8) continue;
      const distance = Math.abs(y - item.y - item.row / 2);
      if (distance < nearest) [best, nearest] = [item.bar, distance];
    }
    return best;
  }
}

/// Bars with a row, the last of them replaced by `most` of those that want one at most.
function withRows(bars: Uint32Array, wanted: number[], most: number): Uint32Array {
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
