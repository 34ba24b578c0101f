// SPDX-License-Identifier: MIT
// The merge tree: one vertical line per branch, from its birth up to the value at which it merges
// into an older branch. If there are many branches, only the most persistent ones are shown.
import { Axis, kLabelSize, kLeastLeft, leftOf, type Tick } from "./axis";
import { nameOfBar } from "./bar_chart";
import { Chart } from "./chart";
import { table, type Size } from "../common/dom";
import { clipped, counted, grouped, short } from "../common/number_format";
import { hex } from "../common/palette";
import type { Pen } from "./pen";
import { kNone } from "../model/payload";
import type { MergeTree } from "../model/merge_tree";
import { LabelPlaces } from "../common/label_places";
import { shownValue } from "../model/words";
import type { Change, Session } from "../model/session";

const kRight = 12,
  kTop = 16,
  kBottom = 16,
  kPitch = 6,
  kReach = 10;

interface Drawn {
  branch: number;
  x: number;
  y1: number; // birth
  y2: number; // death
  parent: number; // x of the branch that it merges into; NaN: none
}

export class TreeChart extends Chart {
  protected redrawsOn: Change[] = ["cut", "colour"];
  private drawn: Drawn[] = [];
  private left = 0; // position of the axis
  private current = -1;
  private readonly tree: MergeTree;
  private readonly byLevel: Uint32Array;

  constructor(session: Session) {
    super(session, "tree", "Merge tree", "");
    this.tree = session.report.tree!;
    const { tree } = this;
    const level = Float64Array.from({ length: tree.leaves }, (_, b) => tree.level(b));
    const size = tree.sizes();
    // The largest level comes first. Among branches that never merge, the larger one comes first;
    // among other branches of equal level, the one that merges later. In this order, a branch
    // always follows the branch that it merges into.
    this.byLevel = new Uint32Array(tree.leaves)
      .map((_, i) => i)
      .sort((a, b) =>
        level[a]! > level[b]!
          ? -1
          : level[a]! < level[b]!
            ? 1
            : level[a] === Infinity
              ? size[b]! - size[a]!
              : tree.deathOf[b]! - tree.deathOf[a]!,
      );
    this.over.addEventListener("pointermove", (event) => this.focus(this.branchNear(event)));
    this.over.addEventListener("pointerleave", () => this.session.setFocus({}));
    this.over.addEventListener("click", (event) => {
      const bar = this.barOf(this.branchNear(event));
      const more = event.shiftKey || event.ctrlKey || event.metaKey;
      this.session.select(bar < 0 ? [] : [bar], more ? "toggle" : "replace");
    });
  }

  draw(pen: Pen, size: Size): void {
    const {
      theme,
      report: { meta },
      cutValue,
    } = this.session;
    const { tree } = this;
    const { axis, ticks } = this.layOut(size);
    const { left } = this;
    const unit = clipped([meta.value.unit, axis.unit].filter(Boolean).join(" "), 16);
    const small = { colour: theme.muted, size: kLabelSize } as const;
    for (const tick of ticks) {
      pen.line(left, tick.at, size.width - kRight, tick.at, theme.grid);
      pen.text(left - 6, tick.at + 3.5, tick.label, { ...small, anchor: "end" });
    }
    // The axis has the same title as the axis of the barcode, because both show the same values.
    const label = clipped(meta.value.label.toLowerCase(), 24);
    pen.text(12, size.height / 2, unit ? `${label} (${unit})` : label, {
      ...small,
      anchor: "middle",
      upwards: true,
    });
    for (const d of this.drawn) {
      const merged = this.isMerged(d.branch);
      this.drawBranch(pen, d, merged ? theme.faint : this.colourOf(d.branch), merged ? 1 : 2.2);
    }
    if (tree.arrays.rule === "value" && cutValue > 0) {
      const y = axis.at(cutValue);
      pen.line(left, y, size.width - kRight, y, theme.muted, 1.2, [5, 4]);
      pen.text(size.width - kRight, y - 4, `cut ${short(cutValue, 3)}`, {
        ...small,
        anchor: "end",
      });
    }
    this.head.querySelector(".hint")!.textContent =
      this.drawn.length < tree.leaves
        ? `the ${grouped(this.drawn.length)} most persistent of ${grouped(tree.leaves)} branches`
        : "";
  }

  /// True if the cut has joined a branch to the one that it merges into.
  private isMerged(branch: number): boolean {
    const merge = this.tree.deathOf[branch]!;
    return merge !== kNone && this.tree.isDone(merge, this.session.cutValue);
  }

  /// Draws the numbers of branches. They belong to the overlay, because they may change with the
  /// selection.
  private drawNumbers(pen: Pen): void {
    const numbers = this.session.numbers(),
      labelPlaces = new LabelPlaces();
    for (const d of this.drawn) {
      const label = numbers.get(this.barOf(d.branch));
      if (label === undefined || this.isMerged(d.branch)) continue;
      const number = String(this.session.numberOf(label));
      if (labelPlaces.take(d.x, d.y1 + 11, number))
        pen.text(d.x, Math.min(d.y1 + 11, this.size.height - 2), number, {
          colour: this.session.theme.muted,
          size: 10.5,
          anchor: "middle",
        });
    }
  }

  protected drawOver(pen: Pen): void {
    const { theme, focus } = this.session;
    this.drawNumbers(pen);
    for (const d of this.drawn) {
      const bar = this.barOf(d.branch);
      if (bar < 0 || !(bar === focus.bar || this.session.isSelected(bar))) continue;
      this.drawBranch(pen, d, bar === focus.bar ? theme.ink : theme.accent, 6);
      this.drawBranch(pen, d, this.colourOf(d.branch), 3);
      pen.circle(d.x, d.y1, 4, this.colourOf(d.branch), 1, theme.ink, 1.2);
    }
  }

  protected describe(): string {
    const { cut, cutValue } = this.session;
    return `Merge tree of ${grouped(this.tree.leaves)} branches, ${counted(cut?.segments.length ?? 0, "segment")} at the cut ${short(cutValue)}. Arrow keys go from branch to branch, Enter selects.`;
  }
  protected makeTable(): HTMLTableElement {
    const { tree } = this,
      { meta } = this.session.report;
    const rows = Array.from(this.byLevel.subarray(0, 500), (b) => [
      b,
      short(shownValue(meta, tree.arrays.births[b]!), 6),
      short(shownValue(meta, tree.death(b)), 6),
      tree.parentOf[b] === kNone ? "" : tree.parentOf[b]!,
      tree.arrays.points[b]!,
      this.session.numberOf(this.session.cut?.labelOfLeaf[b] ?? 0) || "",
    ]);
    return table(
      "Branches, the most persistent first",
      ["branch", "birth", "merges at", "into", "points of its leaf", "segment"],
      rows,
    );
  }
  protected step(by: number): void {
    const order = [...this.drawn].sort((a, b) => a.x - b.x);
    this.current = Math.min(order.length - 1, Math.max(0, this.current + by));
    this.focus(order[this.current]?.branch ?? -1);
  }
  protected choose(how: "replace" | "toggle"): void {
    if (this.session.focus.bar >= 0) this.session.select([this.session.focus.bar], how);
  }

  private layOut(size: Size): { axis: Axis; ticks: Tick[] } {
    const { tree } = this;
    const most = Math.max(1, Math.floor((size.width - kLeastLeft - kRight) / kPitch));
    const shown = this.prominent(most).sort((a, b) => tree.rank[a]! - tree.rank[b]!);
    let low = Infinity,
      high = -Infinity,
      endless = false;
    for (const b of shown) {
      const death = tree.death(b);
      low = Math.min(low, tree.arrays.births[b]!);
      high = Math.max(high, tree.arrays.births[b]!, Number.isFinite(death) ? death : -Infinity);
      endless ||= !Number.isFinite(death);
    }
    if (!Number.isFinite(low)) low = Math.min(0, high);
    const axis = new Axis(
      low,
      Math.max(high, low),
      size.height - kBottom,
      kTop + (endless ? 12 : 0),
      this.session.report.meta.value.negated,
    );
    const ticks = axis.ticks(Math.max(2, (size.height - kTop - kBottom) / 40));
    this.left = leftOf(ticks);
    const left = this.left + 10,
      right = size.width - kRight - 10;
    const x = new Map(
      shown.map((b, i) => [
        b,
        left + (i * (right - left)) / Math.max(1, shown.length - 1),
      ]),
    );
    if (shown.length === 1) x.set(shown[0]!, (left + right) / 2);
    this.drawn = shown.map((branch) => {
      const death = tree.death(branch);
      return {
        branch,
        x: x.get(branch)!,
        y1: axis.at(tree.arrays.births[branch]!),
        y2: Number.isFinite(death) ? axis.at(death) : kTop - 6,
        parent: x.get(tree.parentOf[branch]!) ?? NaN,
      };
    });
    return { axis, ticks };
  }
  /// At most `most` branches: the largest trunks, and then the most persistent branches that merge
  /// into a shown branch. A trunk is a branch that never merges.
  private prominent(most: number): number[] {
    const { tree, byLevel } = this;
    let roots = 0;
    while (roots < tree.leaves && tree.parentOf[byLevel[roots]!] === kNone) ++roots;
    const shown = Array.from(
      byLevel.subarray(0, Math.min(roots, Math.max(most >> 1, most - (tree.leaves - roots)))),
    );
    const isShown = new Set(shown);
    for (const branch of byLevel.subarray(roots)) {
      if (shown.length >= most) break;
      if (!isShown.has(tree.parentOf[branch]!)) continue;
      shown.push(branch);
      isShown.add(branch);
    }
    return shown;
  }
  private drawBranch(pen: Pen, d: Drawn, colour: string, width: number): void {
    pen.stroke(
      Number.isNaN(d.parent) ? [d.x, d.y1, d.x, d.y2] : [d.x, d.y1, d.x, d.y2, d.parent, d.y2],
      colour,
      width,
    );
  }
  private colourOf(branch: number): string {
    const label = this.session.cut?.labelOfLeaf[branch] ?? 0;
    const colour = this.session.segmentColours[label - 1];
    return colour ? hex(colour) : this.session.theme.faint;
  }
  private barOf(branch: number): number {
    const bar = branch < 0 ? kNone : this.tree.barOf[branch]!;
    return bar === kNone ? -1 : bar;
  }
  private focus(branch: number): void {
    const bar = this.barOf(branch);
    this.over.title = bar >= 0 ? nameOfBar(this.session, bar) : "";
    const segment = bar < 0 && branch >= 0 ? (this.session.cut?.labelOfLeaf[branch] ?? 0) : 0;
    this.session.setFocus({ bar, segment });
  }
  private branchNear(event: MouseEvent): number {
    const [x, y] = this.place(event);
    let best = -1,
      nearest = kReach;
    for (const d of this.drawn) {
      if (y > d.y1 + 6 || y < d.y2 - 6) continue;
      const distance = Math.abs(x - d.x);
      if (distance < nearest) [best, nearest] = [d.branch, distance];
    }
    return best;
  }
}
