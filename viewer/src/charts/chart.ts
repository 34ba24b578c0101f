// SPDX-License-Identifier: MIT
// The common base of all charts: a panel with a title, two canvases (the chart, and an overlay that
// follows the pointer), a table that can replace the chart, and the keyboard.
import { button, el, isOfBrowser, onResize, type Size } from "../common/dom";
import { CanvasPen, type Pen } from "./pen";
import type { Change, Session } from "../model/session";

export abstract class Chart {
  readonly panel: HTMLElement;
  protected readonly head: HTMLElement;
  protected readonly body: HTMLElement;
  protected readonly base: HTMLCanvasElement;
  protected readonly over: HTMLCanvasElement;
  protected size: Size = { width: 0, height: 0 };
  private tableShown = false;

  constructor(
    protected readonly session: Session,
    id: string,
    title: string,
    hint: string,
  ) {
    this.base = el("canvas", { "aria-hidden": "true" });
    this.over = el("canvas", { class: "over", tabindex: 0, role: "img", "aria-label": title });
    this.body = el("div", { class: "chart" }, this.base, this.over);
    const toggle = button("table", () => this.toggleTable(toggle), {
      class: "quiet",
      "aria-pressed": "false",
      title: `${title} as a table`,
    });
    this.head = el("header", {}, el("h2", {}, title), el("span", { class: "hint" }, hint), toggle);
    this.panel = el("section", { class: `panel ${id}`, "aria-label": title }, this.head, this.body);
    this.over.addEventListener("keydown", (event) => this.onKey(event));
    session.onChange((changes) => this.update(changes));
    onResize(this.body, () => this.resize());
  }

  /// Draws the chart, without the selection and the item under the pointer.
  abstract draw(pen: Pen, size: Size): void;
  protected abstract drawOver(pen: Pen): void;
  protected abstract redrawsOn: Change[];
  protected abstract makeTable(): HTMLTableElement;
  protected abstract describe(): string;
  /// Moves the focus by some items; with `extend`, also selects the items that it passes.
  protected abstract step(by: number, extend: boolean): void;
  protected abstract choose(how: "replace" | "toggle"): void;

  /// Draws the chart with its selected and focused items, for pictures.
  drawAll(pen: Pen, size: Size): void {
    this.draw(pen, size);
    this.drawOver(pen);
  }
  takeFocus(): void {
    this.over.focus();
  }
  get isFolded(): boolean {
    return this.panel.classList.contains("folded");
  }
  get shape(): Size {
    return this.size;
  }

  protected refresh(): void {
    if (this.size.width < 40 || this.size.height < 40) return;
    this.paint(this.base, (pen) => this.draw(pen, this.size));
    this.over.setAttribute("aria-label", this.describe());
    this.refreshOver();
    if (this.tableShown) this.showTable();
  }
  protected refreshOver(): void {
    if (this.size.width >= 40 && this.size.height >= 40)
      this.paint(this.over, (pen) => this.drawOver(pen));
  }
  protected place(event: PointerEvent | MouseEvent): [number, number] {
    const box = this.over.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  private update(changes: Set<Change>): void {
    if (changes.has("theme") || this.redrawsOn.some((change) => changes.has(change)))
      this.refresh();
    else if (changes.has("focus") || changes.has("selection") || changes.has("cut"))
      this.refreshOver();
  }
  private paint(canvas: HTMLCanvasElement, draw: (pen: Pen) => void): void {
    const context = canvas.getContext("2d");
    if (!context) return;
    const { width, height } = this.size;
    context.setTransform(canvas.width / width, 0, 0, canvas.height / height, 0, 0);
    context.clearRect(0, 0, width, height);
    draw(new CanvasPen(context));
  }
  private resize(): void {
    const width = this.body.clientWidth,
      height = this.body.clientHeight;
    const ratio = window.devicePixelRatio || 1;
    this.size = { width, height };
    for (const canvas of [this.base, this.over]) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    this.refresh();
  }
  private onKey(event: KeyboardEvent): void {
    if (isOfBrowser(event)) return;
    const steps: Record<string, number> = {
      ArrowRight: 1,
      ArrowDown: 1,
      ArrowLeft: -1,
      ArrowUp: -1,
      PageDown: 10,
      PageUp: -10,
    };
    const by = steps[event.key];
    if (by !== undefined) this.step(by, event.shiftKey);
    else if (event.key === "Enter" || event.key === " ")
      this.choose(event.shiftKey ? "toggle" : "replace");
    else return;
    event.preventDefault();
  }
  private toggleTable(toggle: HTMLButtonElement): void {
    this.tableShown = !this.tableShown;
    toggle.setAttribute("aria-pressed", String(this.tableShown));
    this.body.querySelector(".table")?.remove();
    if (this.tableShown) this.showTable();
  }
  private showTable(): void {
    this.body.querySelector(".table")?.remove();
    this.body.append(
      el(
        "div",
        { class: "table", tabindex: 0, role: "region", "aria-label": "table" },
        this.makeTable(),
      ),
    );
  }
}
