// SPDX-License-Identifier: MIT
// The persistence diagram: births on the horizontal axis, deaths on the vertical one, infinity on a
// separate line. If there are many bars, it shows their density and the most persistent ones. A
// lasso selects.
import { Axis, kLabelSize, leftOf, type Tick, widest } from "./axis";
import { BarChart } from "./bar_chart";
import { drawDensity } from "./diagram_density";
import { drawNumbers } from "./dot_numbers";
import { fanOut, type Crowd } from "./fanned_dots";
import { isInside } from "./lasso";
import { LabelPlaces } from "../common/label_places";
import { drawMarker } from "./marker";
import { drawMatching } from "./matching_lines";
import { intervalText, shownValue } from "../model/words";
import { clipped, grouped, homology, short } from "../common/number_format";
import { textWidth, type Pen } from "./pen";
import type { Size } from "../common/dom";
import type { Change, Session } from "../model/session";

const kRight = 14,
  kTop = 10,
  kBottom = 38,
  kInfinityRoom = 20,
  kMinusInfinityRoom = 34;
const kMostMarkers = 3000,
  kLongest = 1200,
  kLeastFanned = 0.1, // share of the range of values
  kReach = 14;

export class Diagram extends BarChart {
  protected redrawsOn: Change[] = ["dims", "colour"];
  x: Float32Array; // position of each bar, pixels
  y: Float32Array;
  births = new Axis(0, 1, 0, 1);
  deaths = new Axis(0, 1, 0, 1);
  private readonly hint: string;
  private lasso: number[] = [];
  private left = 0; // position of the axis of deaths

  constructor(session: Session) {
    const [first, second] = session.report.meta.barcodes;
    const hint = second
      ? `filled: ${first!.name}, hollow: ${second.name}`
      : "lasso to select";
    super(session, "diagram", "Persistence diagram", hint);
    this.hint = hint;
    this.x = new Float32Array(session.report.bars.size);
    this.y = new Float32Array(session.report.bars.size);
    this.over.addEventListener("pointerdown", (event) => this.begin(event));
    this.over.addEventListener("pointermove", (event) => this.move(event));
    this.over.addEventListener("pointerup", (event) => this.end(event));
    this.over.addEventListener("pointerleave", () => this.session.setFocus({}));
  }

  draw(pen: Pen, size: Size): void {
    const { theme, report } = this.session;
    const { bars } = report;
    this.placeBars(size);
    const left = this.births.from,
      right = this.births.to;
    const bottom = this.deaths.from,
      top = this.deaths.to;
    pen.polygon([left, bottom, right, bottom, right, top], theme.shade);
    this.drawAxes(pen, size);
    pen.line(left, bottom, right, top, theme.faint, 1);
    if (bars.size === 0)
      pen.text((left + right) / 2, (top + bottom) / 2 - 40, "no bars", {
        colour: theme.muted,
        anchor: "middle",
        size: 13,
      });
    let shown = 0;
    for (let i = 0; i < bars.size; ++i) if (this.session.isShown(i)) ++shown;
    const many = shown > kMostMarkers;
    const marked = this.shownBars(many ? kLongest : kMostMarkers);
    const crowds = this.fan(marked);
    const lines = drawMatching(pen, this.session, this);
    const farthest =
      lines.all > lines.drawn
        ? ` · lines: of ${grouped(lines.all)} pairs the ${grouped(lines.drawn)} that move farthest`
        : "";
    this.head.querySelector(".hint")!.textContent = this.hint + farthest;
    if (many) drawDensity(pen, this.session, this.x, this.y, size);
    for (let i = marked.length - 1; i >= 0; --i) {
      const bar = marked[i]!;
      const colour = this.session.colourOfDim(bars.dim[bar]!);
      const hollow = bars.barcodeOf(bar) === 1;
      const edge = hollow ? colour : marked.length < 400 ? theme.panel : "none";
      drawMarker(
        pen,
        bars.dim[bar]!,
        this.x[bar]!,
        this.y[bar]!,
        3.6,
        hollow ? "none" : colour,
        0.85,
        edge,
        hollow ? 1.4 : 0.8,
      );
    }
    this.drawCounts(pen, crowds);
  }

  /// Writes the number of bars at each crowd, starting with the largest crowd. A number that would
  /// overlap another one is left out.
  private drawCounts(pen: Pen, crowds: Crowd[]): void {
    const { theme } = this.session,
      labelPlaces = new LabelPlaces(10);
    for (const { x, y, count } of crowds.sort((a, b) => b.count - a.count)) {
      const text = `${grouped(count)} here`,
        half = textWidth(text, 10) / 2;
      const at = Math.min(x + 7, this.size.width - 2 * half - 2);
      if (!labelPlaces.take(at + half, y + 13, text)) continue;
      pen.text(at, y + 13, text, { colour: theme.muted, size: 10, halo: theme.panel });
    }
  }

  /// Draws equal bars side by side, and bars of segments in the order of their numbers. Near the
  /// diagonal, where single bars do not matter, equal bars overlap.
  private fan(marked: Uint32Array): Crowd[] {
    const { session } = this;
    const { bars } = session.report;
    const numbers = session.numbers();
    const place = (bar: number) => numbers.get(bar) ?? Infinity;
    const groups = new Map<string, number[]>();
    const keyOf = (bar: number) => [bars.birth[bar], bars.death[bar], bars.barcodeOf(bar)].join();
    const least = kLeastFanned * (bars.high - bars.low);
    for (const bar of marked) {
      if (bars.persistence(bar) < least) continue;
      const group = groups.get(keyOf(bar));
      if (group) group.push(bar);
      else groups.set(keyOf(bar), [bar]);
    }
    // Bars without a marker are at most as long as the last one with a marker, or infinite.
    const isMarked = new Set(marked);
    const last = Math.max(least, bars.persistence(marked.at(-1) ?? 0));
    for (const bar of marked.length < bars.size ? this.shownBars(bars.size) : []) {
      if (bars.persistence(bar) < last) break;
      if (!isMarked.has(bar)) groups.get(keyOf(bar))?.push(bar);
    }
    const several = [...groups.values()].filter((group) => group.length > 1);
    for (const group of several) group.sort((a, b) => (place(a) < place(b) ? -1 : 1));
    return fanOut(
      several,
      this.x,
      this.y,
      (bar) => bars.isInfinite(bar),
      (bar) => numbers.has(bar),
      this.births.from,
      this.births.to,
    );
  }

  protected drawOver(pen: Pen): void {
    const { session } = this;
    const {
      theme,
      report: { bars },
    } = session;
    this.drawCut(pen);
    for (const [tinted, colour] of session.tintedBars())
      if (session.isShown(tinted))
        drawMarker(pen, 0, this.x[tinted]!, this.y[tinted]!, 4.2, colour, 1, theme.panel, 0.8);
    drawNumbers(pen, session, this);
    const most = session.selection.length > 5000 ? 1 : 2;
    for (const bar of session.selection.slice(0, 5000)) {
      if (!session.isShown(bar)) continue;
      this.drawChosen(pen, bar, 3 + most, theme.accent, most);
    }
    const bar = session.focus.bar;
    if (bar >= 0 && session.isShown(bar)) {
      const x = this.x[bar]!,
        y = this.y[bar]!;
      this.drawChosen(pen, bar, 6.5, theme.ink, 1.5);
      this.drawLabel(pen, x, y, `${homology(bars.dim[bar]!)} ${intervalText(session.report, bar)}`);
    }
    if (this.lasso.length >= 4) pen.polygon(this.lasso, theme.accent, 0.12, theme.muted, 1);
  }

  /// Draws a selected bar or the one under the pointer. A bar of the second barcode stays hollow:
  /// its outline surrounds a ring in the colour of the bar.
  private drawChosen(pen: Pen, bar: number, r: number, edge: string, width: number): void {
    const { bars } = this.session.report;
    const colour = this.session.colourOfBar(bar);
    const draw = (size: number, fill: string, stroke: string, line: number) =>
      drawMarker(pen, bars.dim[bar]!, this.x[bar]!, this.y[bar]!, size, fill, 1, stroke, line);
    if (bars.barcodeOf(bar) === 0) return draw(r, colour, edge, width);
    draw(r + 1, this.session.theme.panel, edge, width);
    draw(r - 1, "none", colour, 1.6);
  }

  private drawLabel(pen: Pen, x: number, y: number, text: string): void {
    const { theme } = this.session;
    const width = 6.2 * text.length + 12;
    const atLeft = x + width + 12 > this.size.width;
    const left = Math.max(2, atLeft ? x - width - 10 : x + 10),
      top = Math.max(2, y - 26);
    pen.rect(left, top, width, 20, theme.panel, 0.94);
    pen.polygon(
      [left, top, left + width, top, left + width, top + 20, left, top + 20],
      "none",
      1,
      theme.grid,
      1,
    );
    pen.text(left + 6, top + 14, text, { colour: theme.ink, size: 11 });
  }

  private placeBars(size: Size): void {
    const { bars } = this.session.report;
    let fromBelow = false,
      toAbove = false;
    for (let i = 0; i < bars.size; ++i) {
      fromBelow ||= bars.birth[i] === -Infinity;
      toAbove ||= bars.isInfinite(i);
    }
    const margin = 0.03 * (bars.high / 2 - bars.low / 2) * 2;
    const fits = Number.isFinite(bars.low - margin) && Number.isFinite(bars.high + margin);
    const low = bars.low === 0 || !fits ? bars.low : bars.low - margin,
      high = fits ? bars.high + margin : bars.high;
    const top = kTop + (toAbove ? kInfinityRoom : 0);
    const { negated } = this.session.report.meta.value;
    this.deaths = new Axis(low, high, size.height - kBottom, top, negated);
    this.left = leftOf(this.deathTicks());
    const left = this.left + (fromBelow ? kMinusInfinityRoom : 0);
    const births = (right: number) => new Axis(low, high, left, size.width - right, negated);
    this.births = births(kRight);
    // Half of the last label may extend to the right of the axis.
    this.births = births(Math.max(kRight, widest(this.birthTicks()) / 2));
    for (let i = 0; i < bars.size; ++i) {
      this.x[i] = bars.birth[i] === -Infinity ? this.left + 6 : this.births.at(bars.birth[i]!);
      this.y[i] = bars.isInfinite(i) ? kTop + 4 : this.deaths.at(bars.death[i]!);
    }
  }

  private deathTicks(): Tick[] {
    const { from, to } = this.deaths;
    return this.deaths.ticks(Math.max(2, (from - to) / 45));
  }
  private birthTicks(): Tick[] {
    const { from, to } = this.births;
    return this.births.ticks(Math.max(2, (to - from) / 75));
  }
  private drawAxes(pen: Pen, size: Size): void {
    const {
      left,
      session: {
        theme,
        report: { meta },
      },
    } = this;
    const bottom = this.deaths.from,
      right = this.births.to;
    const unit = clipped([meta.value.unit, this.births.unit].filter(Boolean).join(" "), 24);
    const small = { colour: theme.muted, size: kLabelSize } as const;
    for (const tick of this.birthTicks()) {
      pen.line(tick.at, this.deaths.to, tick.at, bottom, theme.grid);
      pen.text(tick.at, bottom + 14, tick.label, { ...small, anchor: "middle" });
    }
    for (const tick of this.deathTicks()) {
      pen.line(this.births.from, tick.at, right, tick.at, theme.grid);
      pen.text(left - 6, tick.at + 3.5, tick.label, { ...small, anchor: "end" });
    }
    pen.line(left, kTop - 4, left, bottom, theme.faint);
    pen.line(left, bottom, right, bottom, theme.faint);
    pen.text((this.births.from + right) / 2, size.height - 7, unit ? `birth (${unit})` : "birth", {
      ...small,
      anchor: "middle",
    });
    pen.text(12, (this.deaths.to + bottom) / 2, unit ? `death (${unit})` : "death", {
      ...small,
      anchor: "middle",
      upwards: true,
    });
    if (this.deaths.to > kTop) {
      pen.line(left, kTop + 4, right, kTop + 4, theme.faint, 1, [3, 3]);
      pen.text(left - 6, kTop + 9, short(shownValue(meta, Infinity)), { ...small, size: 14, anchor: "end" });
    }
    if (this.births.from > left) {
      pen.line(left + 6, kTop, left + 6, bottom, theme.faint, 1, [3, 3]);
      pen.text(left + 6, bottom + 14, short(shownValue(meta, -Infinity)), { ...small, anchor: "middle" });
    }
  }

  /// Draws the line of the cut: components whose bars lie above it stay separate.
  private drawCut(pen: Pen): void {
    const {
      report: { tree, bars },
      theme,
      cutValue,
    } = this.session;
    if (!tree || !this.session.isShown(0) || bars.dim[0] !== 0 || cutValue <= 0) return;
    if (this.session.tintedBars().size === 0) return; // no visible colour depends on the cut
    const low = this.births.value(this.births.from),
      high = this.deaths.value(this.deaths.to);
    if (cutValue > high) return;
    const sloped = tree.arrays.rule === "persistence";
    if (sloped && low + cutValue > high) return;
    const right = sloped ? this.births.at(high - cutValue) : this.births.to;
    const y1 = this.deaths.at(sloped ? low + cutValue : cutValue);
    pen.line(this.births.from, y1, right, sloped ? this.deaths.to : y1, theme.muted, 1.2, [5, 4]);
    pen.text(
      right - (sloped ? 16 : 4),
      sloped ? this.deaths.to + 11 : y1 - 5,
      `cut ${short(cutValue, 3)}`,
      { colour: theme.muted, size: 10.5, anchor: "end" },
    );
  }

  private barAt(x: number, y: number): number {
    let best = -1,
      nearest = kReach * kReach;
    for (const bar of this.session.report.bars.byPersistence) {
      const dx = this.x[bar]! - x,
        dy = this.y[bar]! - y,
        d = dx * dx + dy * dy;
      if (d >= nearest || !this.session.isShown(bar)) continue;
      nearest = d;
      best = bar;
    }
    return best;
  }
  private begin(event: PointerEvent): void {
    if (event.button !== 0) return;
    this.over.setPointerCapture(event.pointerId);
    this.lasso = this.place(event);
  }
  private move(event: PointerEvent): void {
    const at = this.place(event);
    if (this.lasso.length === 0) return this.session.setFocus({ bar: this.barAt(...at) });
    const [x, y] = this.lasso.slice(-2) as [number, number];
    if (Math.hypot(at[0] - x, at[1] - y) < 3) return;
    this.lasso.push(...at);
    this.refreshOver();
  }
  private end(event: PointerEvent): void {
    const lasso = this.lasso,
      more = event.shiftKey || event.ctrlKey || event.metaKey;
    this.lasso = [];
    if (lasso.length === 0) return;
    if (lasso.length < 6) {
      const bar = this.barAt(...this.place(event));
      this.session.select(bar < 0 ? [] : [bar], more ? "toggle" : "replace");
    } else {
      this.session.select(this.barsInside(lasso), more ? "add" : "replace");
    }
    this.refreshOver();
  }
  private barsInside(lasso: number[]): number[] {
    const inside: number[] = [];
    for (let bar = 0; bar < this.x.length; ++bar)
      if (this.session.isShown(bar) && isInside(lasso, this.x[bar]!, this.y[bar]!))
        inside.push(bar);
    return inside;
  }
}
