// SPDX-License-Identifier: MIT
// The legend of the colours: segments with their counts, a scale for a continuous colour, the marks
// of a selection.
import { kOutermost, type Colouring, type Range } from "./colouring";
import { el, svg } from "../common/dom";
import { counted, grouped, homology, inRange } from "../common/number_format";
import { dimColour, greyOf, hex, kSurfaces, ramp, type Rgb } from "../common/palette";
import { factsOf, nameOfSurface, standing } from "../model/scene_words";
import { kindOfSegment } from "../model/words";
import { barsInView, isWholeMesh, kBirthColour, kDeathColour } from "./representatives";
import type { Session } from "../model/session";

const kMostRows = 200;

export class Legend {
  readonly element = el("aside", { class: "legend", "aria-label": "Legend" });
  private readonly colours = el("div", { class: "colours" });
  private readonly marks = el("div", { class: "marks" });
  private rows: HTMLButtonElement[] = [];
  private switches: HTMLInputElement[] = []; // switches of the surfaces

  constructor(
    private readonly session: Session,
    private readonly colouring: Colouring,
  ) {
    this.element.append(this.colours, this.marks);
    session.onChange((changes) => {
      if (changes.has("cut") || changes.has("colour") || changes.has("theme")) this.showColours();
      if (changes.has("surfaces")) this.showSwitches();
      if (changes.has("focus") || changes.has("selection") || changes.has("theme"))
        this.showMarks();
    });
    this.showColours();
    this.showMarks();
  }

  private showColours(): void {
    const { session } = this;
    this.rows = [];
    const range = this.colouring.range(session.colour);
    if (session.colour === "segment") this.colours.replaceChildren(...this.segments());
    else if (range) this.colours.replaceChildren(this.scale(range));
    else this.colours.replaceChildren();
  }
  private segments(): HTMLElement[] {
    const { session } = this;
    const segments = session.cut!.segments;
    const name = kindOfSegment(session.report.meta),
      what = session.report.image ? "voxel" : "point";
    const ofSurface = session.pointsOfSurfaces();
    const total = segments.reduce((sum, s) => sum + s.points, 0);
    const none = session.report.elements!.count - total - ofSurface.reduce((a, b) => a + b, 0);
    const { scene } = session.report.meta;
    this.rows = segments.slice(0, kMostRows).map((segment, i) => {
      const said = session.saidOf(segment.label),
        number = session.numberOf(segment.label);
      const facts = said && factsOf(scene!, said);
      const row = el(
        "button",
        {
          type: "button",
          class: "row",
          "aria-label": [`${name} ${number}`, counted(segment.points, what), facts]
            .filter(Boolean)
            .join(", "),
          title: facts,
        },
        swatch(hex(session.segmentColours[i]!)),
        el("span", { class: "name" }, String(number)),
        said && scene!.surfaces.length > 0 ? el("span", { class: "says" }, standing(scene!, said)) : undefined,
        el("span", { class: "count" }, grouped(segment.points)),
      );
      const bar = () => session.barOfSegment(segment.label);
      const focus = () => session.setFocus({ segment: segment.label, bar: bar() });
      row.addEventListener("pointerenter", focus);
      row.addEventListener("focus", focus);
      row.addEventListener("pointerleave", () => session.setFocus({}));
      row.addEventListener("blur", () => session.setFocus({}));
      row.addEventListener(
        "click",
        (event) => bar() >= 0 && session.select([bar()], event.shiftKey ? "toggle" : "replace"),
      );
      return row;
    });
    const rest = segments.length - this.rows.length;
    return [
      el("h3", {}, name, el("span", { class: "count" }, `${what}s`)),
      ...this.rows,
      ...(rest > 0 ? [el("p", { class: "note" }, `and ${grouped(rest)} smaller`)] : []),
      ...(ofSurface.length > 0 ? this.surfaces(ofSurface) : []),
      ...(none > 0
        ? [
            el(
              "p",
              { class: "row none" },
              swatch(session.theme.dark ? "#545c67" : "#969ca5"),
              el("span", { class: "name" }, "none"),
              el("span", { class: "count" }, grouped(none)),
            ),
          ]
        : []),
    ];
  }
  /// The surfaces of the scene, each with a switch.
  private surfaces(points: number[]): HTMLElement[] {
    const { session } = this;
    const scene = session.report.meta.scene!;
    this.switches = points.map((_, i) => {
      const box = el("input", { type: "checkbox" });
      box.addEventListener("change", () => session.toggleSurface(i + 1));
      return box;
    });
    this.showSwitches();
    return [
      el("h3", {}, "surface"),
      ...points.map((count, i) =>
        el(
          "label",
          { class: "row surface" },
          this.switches[i],
          swatch(kSurfaces[scene.surfaces[i]!.role] ?? kSurfaces.support),
          el("span", { class: "name" }, nameOfSurface(scene, i + 1)),
          el("span", { class: "count" }, grouped(count)),
        ),
      ),
    ];
  }
  private showSwitches(): void {
    this.switches.forEach((box, i) => (box.checked = !this.session.hiddenSurfaces.has(i + 1)));
  }
  private scale({ low, high, clipped }: Range): HTMLElement {
    const { session } = this;
    const {
      colour,
      report: { meta },
    } = session;
    const unit = (colour === "depth" ? meta.cloud?.unit : meta.value.unit) ?? "";
    const bar = svg("svg", {
      viewBox: "0 0 14 100",
      preserveAspectRatio: "none",
      class: "ramp",
      "aria-hidden": "true",
    });
    bar.append(...steps(colour === "grey" ? greyOf : ramp));
    const ticks = (high > low ? [high, (low + high) / 2, low] : [low]).map((v) =>
      el("span", {}, inRange(v, high - low || 1)),
    );
    const name = session.colourModes().find(([mode]) => mode === colour)?.[1] ?? colour;
    return el(
      "div",
      {},
      el("h3", {}, unit ? `${name} (${unit})` : name),
      el("div", { class: "scale" }, bar, el("div", { class: "ticks" }, ...ticks)),
      clipped
        ? el("p", { class: "note" }, `up to ${100 * kOutermost} % of the values lie beyond each end`)
        : undefined,
    );
  }
  private showMarks(): void {
    const { session } = this;
    const { bars, chains, voxels, tree, meta } = session.report;
    const shown = barsInView(session).filter((bar) => bars.barcodeOf(bar) === 0);
    this.rows.forEach((row, i) => row.classList.toggle("on", session.focus.segment === i + 1));
    const rows: HTMLElement[] = [];
    const mark = (colour: string, text: string) =>
      rows.push(el("p", { class: "row" }, swatch(colour), el("span", { class: "name" }, text)));
    const hasChain = (bar: number) => !!chains?.ofBar.has(bar) && !isWholeMesh(session.report, bar);
    const chained = new Set(shown.filter(hasChain).map((bar) => bars.dim[bar]!));
    const kind = meta.barcodes[0]!.representatives?.replace(/s$/, "") ?? "representative";
    const what = kind === "voxel" ? "cycle" : kind;
    for (const dim of [...chained].sort((a, b) => a - b))
      mark(dimColour(dim, session.theme), `${homology(dim)} ${what}`);
    const filled = new Set(
      shown.filter((bar) => voxels?.ofBar.has(bar)).map((bar) => bars.dim[bar]!),
    );
    for (const dim of [...filled].sort((a, b) => a - b))
      mark(dimColour(dim, session.theme), `${homology(dim)} ${dim === 0 ? "component" : "hollow"}`);
    if (shown.some((bar) => bars.cell(bar, 0).length > 0)) mark(kBirthColour, "birth cell");
    if (shown.some((bar) => bars.cell(bar, 1).length > 0)) mark(kDeathColour, "death cell");
    const note = (text: string) => {
      // The name of an option is not broken at its hyphens.
      const parts = text.split(/(--\w+)/).map((part, i) => (i % 2 === 0 ? part : unbroken(part)));
      rows.push(el("p", { class: "note" }, ...parts));
    };
    if (shown.some((bar) => isWholeMesh(session.report, bar)))
      note("The cycle of this bar is the whole mesh.");
    // The one or two cells that are drawn show where a bar begins and ends, but not its hole.
    const isAsked = meta.barcodes[0]!.representatives !== undefined;
    if (!isAsked && shown.some((bar) => bars.dim[bar] !== 0 || !tree))
      note(noteOf(shown.length, session.report.image ? "voxels" : "cycles"));
    this.marks.replaceChildren(...rows);
  }
}

const kSteps = 50;

/// Draws the steps of a colour scale, from the colour of the largest value, at the top, to the
/// colour of the least value. Each colour extends to the lower end, and the next one is drawn over
/// it, because colours that only touch would leave stripes where they meet within a pixel.
function steps(map: (part: number) => Rgb): SVGElement[] {
  return Array.from({ length: kSteps }, (_, i) => {
    const y = (100 * i) / kSteps;
    const fill = hex(map(1 - i / (kSteps - 1)));
    return svg("rect", { y, width: 14, height: 100 - y, fill });
  });
}

/// A hint on how to add the voxels or cycles of the bars to the report.
function noteOf(count: number, kind: "voxels" | "cycles"): string {
  const bars = count === 1 ? "this bar" : "these bars";
  if (kind === "voxels")
    return `The report has no voxels of ${bars}: --representatives voxels adds them.`;
  const [cycles, them] = count === 1 ? ["cycle", "it"] : ["cycles", "them"];
  return `The report has no ${cycles} of ${bars}: --representatives cycles adds ${them}.`;
}

const unbroken = (text: string) => el("span", { class: "unbroken" }, text);

export function swatch(colour: string): SVGSVGElement {
  return svg(
    "svg",
    { viewBox: "0 0 12 12", class: "swatch", "aria-hidden": "true" },
    svg("rect", { width: 12, height: 12, rx: 3, fill: colour }),
  );
}
