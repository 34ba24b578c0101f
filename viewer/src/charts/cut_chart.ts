// SPDX-License-Identifier: MIT
// The cut: a slider beneath a curve, which shows the number of segments at every cut. A wide step
// of the curve is a gap between persistences; the widest gap suggests a cut.
import { Chart } from "./chart";
import { button, el, table, type Size } from "../common/dom";
import { CutScale, kSteps, segmentCounts } from "../model/cuts";
import { counted, exact, grouped, short } from "../common/number_format";
import { kindOfSegment } from "../model/words";
import { textWidth, type Pen } from "./pen";
import type { Change, Session } from "../model/session";

const kSamples = 200,
  kThumb = 8,
  kTop = 15,
  kBottom = 16;
const kTitles = ["segments left at each cut (logarithmic)", "segments left at each cut", "segments"];

export class CutChart extends Chart {
  protected redrawsOn: Change[] = ["cut"];
  private readonly scale: CutScale;
  readonly counts: number[]; // number of segments at each sample
  private readonly slider: HTMLInputElement;
  private readonly number: HTMLInputElement;
  private readonly outcome = el("output", { class: "outcome" });
  private readonly suggested: number | undefined;

  constructor(session: Session) {
    super(session, "cut", "Cut", "");
    const meta = session.report.meta.tree!,
      tree = session.report.tree!;
    this.scale = new CutScale(tree, meta.from, meta.to, meta.cut);
    this.counts = segmentCounts(
      tree,
      Array.from({ length: kSamples + 1 }, (_, i) => this.scale.at(i / kSamples)),
    );
    this.suggested = session.suggestion();
    const name = [meta.label ?? "persistence", meta.unit && `(${meta.unit})`]
      .filter(Boolean)
      .join(" ");
    this.slider = el("input", {
      type: "range",
      min: 0,
      max: kSteps,
      step: 1,
      "aria-label": `cut at ${name}`,
    });
    this.number = el("input", {
      type: "number",
      min: 0,
      step: "any",
      "aria-label": `cut at ${name}`,
      class: "number",
    });
    this.slider.addEventListener("input", () =>
      session.setCut(this.scale.at(Number(this.slider.value) / kSteps)),
    );
    this.number.addEventListener("change", () => {
      const value = Number(this.number.value);
      if (this.number.value !== "" && value >= this.scale.from && value <= (meta.to ?? Infinity))
        session.setCut(value);
      else this.show();
    });
    this.head
      .querySelector(".hint")!
      .replaceWith(
        el("label", { class: "field" }, el("span", {}, name), this.number),
        this.outcome,
        ...this.shortcuts(meta.cut),
      );
    this.body.after(this.slider);
    if (this.note()) this.panel.append(el("p", { class: "note" }, this.note()));
    session.onChange((changes) => changes.has("cut") && this.show());
    session.onShown(
      (milliseconds) => (this.outcome.title = `cut and coloured in ${milliseconds.toFixed(1)} ms`),
    );
    this.over.addEventListener("click", (event) =>
      session.setCut(this.scale.at(this.part(this.place(event)[0]))),
    );
    this.show();
  }

  draw(pen: Pen, size: Size): void {
    const { theme, cutValue } = this.session;
    const most = Math.max(1, ...this.counts),
      height = size.height - kTop - kBottom;
    const few = Math.min(...this.counts),
      least = few > most / 4 ? 0.8 * few : 0;
    // The scale is logarithmic, because large cuts leave few segments, whose number matters.
    const y = (count: number) =>
      kTop +
      height * (1 - Math.log((count + 1) / (least + 1)) / Math.log((most + 1) / (least + 1)));
    const x = (place: number) => kThumb + place * (size.width - 2 * kThumb);
    const line: number[] = [];
    this.counts.forEach((count, i) =>
      line.push(x(i / kSamples), y(count), x(Math.min(1, (i + 1) / kSamples)), y(count)),
    );
    pen.polygon(
      [...line, x(1), kTop + height, x(0), kTop + height],
      theme.dark ? "#2b6ea3" : "#0072b2",
      0.18,
    );
    pen.stroke(line, theme.dark ? "#4aa8e0" : "#0072b2", 1.4);
    const small = { colour: theme.muted, size: 10 } as const;
    const ends = [this.scale.from, this.scale.to].map((value) => short(value, 3));
    pen.text(x(0), size.height - 4, ends[0]!, small);
    pen.text(x(1), size.height - 4, ends[1]!, { ...small, anchor: "end" });
    pen.text(x(0), kTop - 5, grouped(this.counts[0]!), small);
    pen.text(x(1), kTop - 5, grouped(this.counts.at(-1)!), { ...small, anchor: "end" });
    const room = x(1) - x(0) - 2 * Math.max(...ends.map((text) => textWidth(text, 10) + 8));
    const words = kTitles.find((text) => textWidth(text, 10) <= room) ?? "";
    pen.text(x(0.5), size.height - 4, words, { ...small, anchor: "middle" });
    if (this.suggested !== undefined) {
      const at = x(this.scale.place(this.suggested));
      pen.line(at, kTop - 3, at, kTop + height, theme.dark ? "#25c496" : "#009e73", 1.2, [3, 3]);
      const right = at > size.width / 2;
      const [first, last] = [this.counts[0]!, this.counts.at(-1)!].map((n) => textWidth(grouped(n), 10) + 6);
      const place = right ? Math.min(at - 5, x(1) - last!) : Math.max(at + 5, x(0) + first!);
      pen.text(place, kTop - 5, "widest gap", {
        ...small,
        colour: theme.dark ? "#25c496" : "#00795a",
        anchor: right ? "end" : "start",
      });
    }
    const at = x(this.scale.place(cutValue));
    pen.line(at, kTop - 3, at, kTop + height, theme.ink, 1.6);
  }
  protected drawOver(): void {}
  protected describe(): string {
    return `Number of segments at every cut, from ${this.counts[0]} at ${short(this.scale.from)} to ${this.counts.at(-1)} at ${short(this.scale.to)}. Arrow keys move the cut.`;
  }
  protected makeTable(): HTMLTableElement {
    const rows: (string | number)[][] = [];
    this.counts.forEach((count, i) => {
      if (i === 0 || count !== this.counts[i - 1])
        rows.push([exact(this.scale.at(i / kSamples)), count]);
    });
    return table("Segments at each cut", ["cut", "segments"], rows);
  }
  protected step(by: number): void {
    this.session.setCut(this.scale.at(this.scale.place(this.session.cutValue) + by / 200));
  }
  protected choose(): void {
    if (this.suggested !== undefined) this.session.setCut(this.suggested);
  }

  private part(x: number): number {
    return (x - kThumb) / (this.size.width - 2 * kThumb);
  }
  private shortcuts(own: number): HTMLButtonElement[] {
    const to = (text: string, value: number) =>
      button(text, () => this.session.setCut(value), {
        class: "quiet shortcut",
        title: `cut at ${exact(value)}`,
      });
    return [
      to("program's cut", own),
      ...(this.suggested === undefined || this.suggested === own ? [] : [to("widest gap", this.suggested)]),
    ];
  }
  /// Says whether the program's answer is shown, if this answer joins parts of objects; otherwise
  /// empty.
  private note(): string {
    const { meta } = this.session.report;
    if (!meta.scene?.objects) return "";
    return this.session.isAnswer
      ? `This is the program's answer: at ${exact(meta.tree!.cut)} it joins parts of one object. Other cuts, and the curve, go by persistence alone, as with --parts.`
      : "Not the program's answer: this cut goes by persistence alone, as with --parts. “program's cut” goes back to it.";
  }
  private show(): void {
    const { session } = this;
    const count = session.cut!.segments.length,
      what = kindOfSegment(session.report.meta);
    this.slider.value = String(Math.round(kSteps * this.scale.place(session.cutValue)));
    this.slider.setAttribute(
      "aria-valuetext",
      `${short(session.cutValue)}: ${counted(count, what)}`,
    );
    this.number.value = exact(session.cutValue);
    this.outcome.textContent = `${grouped(count)} ${what}${count === 1 ? "" : "s"}`;
    const note = this.panel.querySelector(".note");
    if (note) note.textContent = this.note();
  }
}
