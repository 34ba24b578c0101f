// SPDX-License-Identifier: MIT
// The state of the page, shared by all views. A view changes this state through the methods here,
// and redraws when it is notified of a change. No view refers to another view.
import { findingOf, type Finding } from "./finding";
import { colourModesOf, type ColourMode } from "./colour_modes";
import { coloursApart, dimColour, fromHex, hex, numberOfColour, segmentColour, themeOf, type Rgb, type Theme } from "../common/palette";
import { suggestedCut } from "./cuts";
import type { Cut } from "./merge_tree";
import type { SegmentMeta } from "./meta";
import { kNone, type Numbers } from "./payload";
import type { Report } from "./report";
import { firstAxis } from "./volume_axes";
import { touchingInImage, touchingInSpace } from "./touching_leaves";

export type Change =
  | "focus"
  | "selection"
  | "cut"
  | "colour"
  | "dims"
  | "scale"
  | "slice"
  | "surfaces"
  | "theme"
  | "view";

/// The item under the pointer or the keyboard focus.
export interface Focus {
  bar: number; // -1: none
  segment: number; // 0: none
  element: number; // -1: none
}
const kNoTints = new Map<number, string>();
const kMostTinted = 200, // most segments whose bars are coloured
  kMostNumbered = 30;
const kNothing: Focus = { bar: -1, segment: 0, element: -1 };

export class Session {
  focus: Focus = kNothing;
  selection: number[] = []; // bars, ascending
  colour: ColourMode;
  hiddenDims = new Set<number>();
  hiddenSurfaces = new Set<number>();
  theme: Theme = themeOf(false);
  cutValue: number;
  cut: Cut | undefined;
  segmentColours: Rgb[] = [];
  beside = false; // show ground truth beside the data
  scale: number | undefined; // filtration value up to which the complex is shown
  sliceAxis = 0;
  slice = 0;
  readonly finding: Finding;
  private selected: Uint8Array;
  private leafColours: number[] = [];
  private readonly listeners: ((changes: Set<Change>) => void)[] = [];
  private pending = new Set<Change>();
  private cutMilliseconds = 0;
  private shown: (milliseconds: number) => void = () => {};

  constructor(readonly report: Report) {
    this.selected = new Uint8Array(report.bars.size);
    this.cutValue = report.meta.tree?.cut ?? 0;
    this.showMiddleSlice();
    if (report.tree) this.recut();
    this.colour = this.colourModes()[0]![0];
    this.finding = findingOf(report);
    this.select(this.finding.bars);
  }
  /// Resets everything except the theme.
  startAgain(): void {
    const { report } = this;
    this.focus = kNothing;
    this.colour = this.colourModes()[0]![0];
    this.hiddenDims.clear();
    this.hiddenSurfaces.clear();
    this.beside = false;
    this.scale = undefined;
    this.showMiddleSlice();
    this.select(this.finding.bars);
    if (report.tree) this.setCut(report.meta.tree!.cut);
    this.changed("focus", "colour", "dims", "surfaces", "view", "scale", "slice");
  }
  private showMiddleSlice(): void {
    const { image, meta } = this.report;
    this.sliceAxis = (image?.shape[0] ?? 1) > 1 ? firstAxis(meta) : 0;
    this.slice = Math.floor((image?.shape[this.sliceAxis] ?? 1) / 2);
  }

  // Changes.

  onChange(listener: (changes: Set<Change>) => void): void {
    this.listeners.push(listener);
  }
  /// Notifies the views once per frame, however many changes there are.
  changed(...changes: Change[]): void {
    if (this.pending.size === 0) requestAnimationFrame(() => this.flush());
    for (const change of changes) this.pending.add(change);
  }
  private flush(): void {
    const changes = this.pending;
    this.pending = new Set();
    const start = performance.now();
    for (const listener of this.listeners) listener(changes);
    if (changes.has("cut")) this.shown(this.cutMilliseconds + performance.now() - start);
  }
  /// Calls `listener` with the time from a change of the cut until every view was notified.
  onShown(listener: (milliseconds: number) => void): void {
    this.shown = listener;
  }

  setFocus(focus: Partial<Focus>): void {
    const next = { ...kNothing, ...focus };
    const old = this.focus;
    if (next.bar === old.bar && next.segment === old.segment && next.element === old.element)
      return;
    this.focus = next;
    this.changed("focus");
  }
  select(bars: Iterable<number>, how: "replace" | "add" | "toggle" = "replace"): void {
    if (how === "replace") this.selected.fill(0);
    for (const bar of bars) this.selected[bar] = how === "toggle" ? 1 - this.selected[bar]! : 1;
    this.selection = [];
    for (let i = 0; i < this.selected.length; ++i) if (this.selected[i]) this.selection.push(i);
    if (this.colour === "grey") this.tints = undefined;
    this.changed("selection");
  }
  /// True if exactly the bars of the finding are selected, as at the start.
  get selectsTheFinding(): boolean {
    const { bars } = this.finding;
    return this.selection.length === bars.length && bars.every((bar) => this.isSelected(bar));
  }
  isSelected(bar: number): boolean {
    return this.selected[bar] === 1;
  }
  setCut(value: number): void {
    this.cutValue = value;
    this.recut();
    this.changed("cut");
  }
  set<K extends "colour" | "scale" | "beside" | "slice" | "sliceAxis" | "theme">(
    what: K,
    value: this[K],
    change: Change,
  ): void {
    (this as Session)[what] = value;
    if (change === "colour") this.tints = undefined;
    this.changed(change);
  }
  toggleDim(dim: number): void {
    if (!this.hiddenDims.delete(dim)) this.hiddenDims.add(dim);
    this.changed("dims");
  }

  toggleSurface(surface: number): void {
    if (!this.hiddenSurfaces.delete(surface)) this.hiddenSurfaces.add(surface);
    this.changed("surfaces");
  }

  // The cut.

  /// True if the segments are the program's own answer, about which the report knows more.
  get isAnswer(): boolean {
    const tree = this.report.tree;
    return !!tree?.arrays.answer && this.cutValue === this.report.meta.tree!.cut;
  }
  /// The program's description of a segment of its answer.
  saidOf(label: number): SegmentMeta | undefined {
    return this.isAnswer ? this.report.meta.scene!.segments[label - 1] : undefined;
  }
  /// The number that names a segment: the number in the files that the program wrote, otherwise the
  /// label.
  numberOf(label: number): number {
    return this.saidOf(label)?.number ?? label;
  }
  private recut(): void {
    const start = performance.now();
    const tree = this.report.tree!;
    this.cut = this.isAnswer ? tree.answer(this.cutValue) : tree.cut(this.cutValue);
    if (this.focus.segment > this.cut.segments.length) this.focus = kNothing;
    this.segmentColours = this.coloursOf(this.cut);
    this.tints = undefined;
    this.cutMilliseconds = performance.now() - start;
  }
  private coloursOf(cut: Cut): Rgb[] {
    if (this.cutValue === this.report.meta.tree!.cut) this.leafColours = []; // as at the start
    if (this.isAnswer) {
      const colours = this.report.meta.scene!.segments.map((s) => fromHex(s.colour));
      cut.segments.forEach((s, i) => (this.leafColours[s.oldestLeaf] = numberOfColour(colours[i]!)));
      return colours;
    }
    const pairs = this.touchingLeaves();
    const none = new Set<number>();
    const touching = cut.segments.map(() => (pairs.length > 0 ? new Set<number>() : none));
    for (let k = 0; k + 1 < pairs.length; k += 2) {
      const a = cut.labelOfLeaf[pairs[k]!]!,
        b = cut.labelOfLeaf[pairs[k + 1]!]!;
      if (a === b || a === 0 || b === 0) continue;
      touching[a - 1]!.add(b - 1);
      touching[b - 1]!.add(a - 1);
    }
    // A segment keeps the previous colour of its oldest leaf.
    const wish = cut.segments.map((s) => this.leafColours[s.oldestLeaf] ?? -1);
    const choice = coloursApart(touching, wish);
    cut.segments.forEach((s, i) => (this.leafColours[s.oldestLeaf] = choice[i]!));
    return choice.map(segmentColour);
  }
  private touching: Numbers | undefined;
  private touchingLeaves(): Numbers {
    const { tree, elements, image, cloud } = this.report;
    if (tree!.arrays.touching) return tree!.arrays.touching;
    // With very many leaves, each leaf is a speck whose colour carries no information.
    const few = elements?.leaf && tree!.leaves <= 20_000;
    this.touching ??= !few
      ? new Uint32Array()
      : image
        ? touchingInImage(elements.leaf!, image.shape, tree!.leaves)
        : touchingInSpace(elements.leaf!, cloud!.positions, tree!.leaves);
    return this.touching;
  }
  suggestion(): number | undefined {
    const { tree, meta } = this.report;
    return tree && suggestedCut(tree, meta.tree?.from ?? 0, meta.tree?.to ?? Infinity);
  }

  // Relations between elements, segments, surfaces and bars.

  leafOf(element: number): number {
    const leaf = this.report.elements?.leaf?.[element] ?? kNone;
    return leaf < (this.report.tree?.leaves ?? 0) ? leaf : -1;
  }
  segmentOf(element: number): number {
    const leaf = this.leafOf(element);
    return leaf < 0 ? 0 : (this.cut?.labelOfLeaf[leaf] ?? 0);
  }
  /// The surface on which an element lies; 0: none.
  surfaceOf(element: number): number {
    const leaf = this.leafOf(element);
    if (leaf < 0) return this.report.elements?.surface?.[element] ?? 0;
    return this.cut?.surfaceOfLeaf[leaf] ?? 0;
  }
  /// The number of elements on each surface.
  pointsOfSurfaces(): number[] {
    const { meta, elements } = this.report;
    const points = new Array<number>(meta.scene?.surfaces.length ?? 0).fill(0);
    if (points.length === 0) return points;
    for (let i = 0; i < elements!.count; ++i) {
      const surface = this.surfaceOf(i);
      if (surface > 0) ++points[surface - 1]!;
    }
    return points;
  }
  /// The bar of the branch that an element belongs to; without a tree, the bar of the most
  /// persistent representative through it. -1: none.
  barOf(element: number): number {
    const leaf = this.leafOf(element);
    if (leaf >= 0) {
      const bar = this.report.tree!.barOf[this.report.tree!.branchAt(leaf, this.cutValue)]!;
      return bar === kNone ? -1 : bar;
    }
    if (this.report.tree) return -1;
    return this.barsThrough().get(this.report.cloud?.index?.[element] ?? element) ?? -1;
  }
  barOfSegment(label: number): number {
    const segment = this.cut?.segments[label - 1];
    if (!segment) return -1;
    const tree = this.report.tree!;
    const bar = tree.barOf[tree.branchAt(segment.oldestLeaf, this.cutValue)]!;
    return bar === kNone ? -1 : bar;
  }
  /// The leaves to highlight, as a mask; undefined: none in particular.
  highlightedLeaves(): Uint8Array | undefined {
    const tree = this.report.tree;
    if (!tree) return undefined;
    const mask = new Uint8Array(tree.leaves);
    let any = false;
    const { segment, bar } = this.focus;
    if (segment > 0) {
      for (let leaf = 0; leaf < tree.leaves; ++leaf)
        if (this.cut!.labelOfLeaf[leaf] === segment) mask[leaf] = 1;
      return mask;
    }
    for (const b of bar >= 0 ? [bar] : this.selection) {
      const branch = tree.branchOf(b);
      if (branch === undefined) continue;
      tree.markBranch(branch, this.cutValue, mask);
      any = true;
    }
    return any ? mask : undefined;
  }
  private tints: Map<number, string> | undefined;
  /// For the bar of each of the largest segments, the colour of the segment in the data; empty if
  /// the data show no segments. In a grey image, only selected segments have a colour.
  tintedBars(): Map<number, string> {
    const isGrey = this.colour === "grey";
    if ((this.colour !== "segment" && !isGrey) || !this.cut) return kNoTints;
    this.tints ??= new Map(
      this.cut.segments
        .slice(0, kMostTinted)
        .map((s) => [this.barOfSegment(s.label), hex(this.segmentColours[s.label - 1]!)] as const)
        .filter(([bar]) => bar >= 0 && !(isGrey && !this.isSelected(bar))),
    );
    return this.tints;
  }
  /// Labels, by bar, of the segments that have a number in every view: the largest coloured ones.
  numbers(): Map<number, number> {
    const numbers = new Map<number, number>();
    const tints = this.tintedBars();
    if ((this.cut?.segments.length ?? 0) < 2) return numbers;
    for (const { label } of this.cut!.segments) {
      if (numbers.size >= kMostNumbered || label > kMostTinted) break;
      const bar = this.barOfSegment(label);
      if (tints.has(bar)) numbers.set(bar, label);
    }
    return numbers;
  }
  /// The colour of a bar.
  colourOfBar(bar: number): string {
    return this.tintedBars().get(bar) ?? this.colourOfDim(this.report.bars.dim[bar]!);
  }
  /// The colour of bars without their own colour: if segments have colours, bars of H0 are grey, as
  /// in the tree.
  colourOfDim(dim: number): string {
    const grey = dim === 0 && this.colour === "segment";
    return grey ? this.theme.faint : dimColour(dim, this.theme);
  }
  isShown(bar: number): boolean {
    return !this.hiddenDims.has(this.report.bars.dim[bar]!);
  }

  /// All dimensions: the one that the finding is about, then the others in descending order.
  dimsInOrder(): number[] {
    const { dims } = this.report.bars,
      { dim } = this.finding;
    return [...dims.filter((d) => d === dim), ...dims.filter((d) => d !== dim).reverse()];
  }

  private through: Map<number, number> | undefined;
  /// For each vertex, by its number in the input, the most persistent bar whose representative
  /// contains it; the vertex need not be shown.
  private barsThrough(): Map<number, number> {
    if (this.through) return this.through;
    this.through = new Map();
    const { chains, bars, cloud } = this.report;
    if (!chains || !cloud) return this.through;
    for (const bar of bars.byPersistence) {
      const chain = chains.ofBar.get(bar);
      if (chain === undefined || bars.dim[bar] === 0) continue;
      for (let i = chains.first[chain]!; i < chains.first[chain + 1]!; ++i)
        if (!this.through.has(chains.cells[i]!)) this.through.set(chains.cells[i]!, bar);
    }
    return this.through;
  }

  /// The colour modes of this report, the default first.
  colourModes(): [ColourMode, string][] {
    this.modes ??= colourModesOf(this.report);
    return this.modes;
  }
  private modes: [ColourMode, string][] | undefined;
}
