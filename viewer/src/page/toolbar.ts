// SPDX-License-Identifier: MIT
// The line above the views: title, dimensions to show and hide, export, theme, help.
import { commandLine } from "../model/command_line";
import { button, download, el, svg } from "../common/dom";
import { pictureSvg, picturePng, selectionCsv, selectionJson, type Views } from "./exports";
import { counted, grouped, homology } from "../common/number_format";
import { dimColour, themeOf } from "../common/palette";
import { distancesOf, helpDialog, provenanceDialog } from "./provenance";
import type { Report } from "../model/report";
import type { Session } from "../model/session";

export class Toolbar {
  readonly element: HTMLElement;
  private readonly chips = el("div", {
    class: "chips",
    role: "group",
    "aria-label": "dimensions shown",
  });

  constructor(
    private readonly session: Session,
    views: Views,
    page: HTMLElement,
  ) {
    const { meta } = session.report;
    const about = provenanceDialog(session),
      help = helpDialog();
    const warnings = meta.provenance.warnings?.length ?? 0;
    const theme = button("", () => session.set("theme", themeOf(!session.theme.dark), "theme"));
    const showTheme = () => (theme.textContent = session.theme.dark ? "Light" : "Dark");
    this.element = el(
      "header",
      { class: "top" },
      el(
        "div",
        { class: "title" },
        el("h1", { title: meta.title }, meta.title),
        el("p", {}, subtitle(session.report)),
      ),
      this.chips,
      el(
        "nav",
        { "aria-label": "Page" },
        ...(warnings > 0
          ? [button(counted(warnings, "warning"), () => about.showModal(), { class: "warning" })]
          : []),
        this.exportMenu(views, page),
        button("About", () => about.showModal()),
        theme,
        button("Help", () => help.showModal()),
      ),
      about,
      help,
    );
    session.onChange((changes) => {
      if (changes.has("dims") || changes.has("theme")) this.showChips();
      if (changes.has("theme")) showTheme();
    });
    this.showChips();
    showTheme();
  }

  private showChips(): void {
    const { session } = this;
    const { bars, meta } = session.report;
    this.chips.replaceChildren(
      ...session.dimsInOrder().map((dim) => {
        const counts = meta.barcodes.map((_, i) => grouped(bars.count(dim, i))).join(" / ");
        const chip = button("", () => session.toggleDim(dim), {
          class: "chip",
          "aria-pressed": String(!session.hiddenDims.has(dim)),
          "aria-label": `${counts} bars in dimension ${dim}`,
          title: `show or hide dimension ${dim}`,
        });
        chip.append(
          marker(dim, dimColour(dim, session.theme)),
          el("b", {}, homology(dim)),
          el("span", {}, counts),
        );
        return chip;
      }),
    );
  }

  private exportMenu(views: Views, page: HTMLElement): HTMLElement {
    const { session } = this;
    const name =
      session.report.meta.title.replace(/[^A-Za-z0-9._-]+/g, "_").slice(0, 60) || "report";
    const text = (type: string, content: string) => new Blob([content], { type });
    const title = el("summary", {}, "Export");
    const menu = el("details", { class: "menu" }, title);
    const item = (label: string, action: () => void) =>
      button(label, () => {
        menu.open = false;
        action();
      });
    const copy = async () => {
      const isDone = await navigator.clipboard?.writeText(commandLine(session)).then(
        () => true,
        () => false,
      );
      if (!isDone) prompt("The command line of this view", commandLine(session));
      title.textContent = isDone ? "Copied" : "Export";
      setTimeout(() => (title.textContent = "Export"), 2000);
    };
    menu.append(
      el(
        "div",
        { class: "items" },
        item("Picture, PNG", async () =>
          download(`${name}.png`, await picturePng(pictureSvg(session, views, page))),
        ),
        item("Picture, SVG", () =>
          download(`${name}.svg`, text("image/svg+xml", pictureSvg(session, views, page))),
        ),
        item("Selected bars, CSV", () =>
          download(`${name}.csv`, text("text/csv", selectionCsv(session))),
        ),
        item("Selected bars and segments, JSON", () =>
          download(`${name}.json`, text("application/json", selectionJson(session))),
        ),
        ...(session.report.meta.provenance.command
          ? [item("Copy the command line of this view", () => void copy())]
          : []),
      ),
    );
    document.addEventListener("click", (event) => {
      if (!menu.contains(event.target as Node)) menu.open = false;
    });
    return menu;
  }
}

function marker(dim: number, colour: string): SVGSVGElement {
  const shapes = [
    "M6 2a4 4 0 1 0 .01 0z",
    "M6 1.5l4.6 8.3H1.4z",
    "M2.4 2.4h7.2v7.2H2.4z",
    "M6 .8L10.6 6 6 11.2 1.4 6z",
  ];
  return svg(
    "svg",
    { viewBox: "0 0 12 12", class: "swatch", "aria-hidden": "true" },
    svg("path", { d: shapes[dim % 4]!, fill: colour }),
  );
}

/// "1,024 points in R^3 · rips · ph-barcode 0.1.0", or the distances between two barcodes.
function subtitle({ meta }: Report): string {
  const p = meta.provenance;
  return [p.input?.description, p.complex, ...distancesOf(meta), meta.program]
    .filter(Boolean)
    .join("  ·  ");
}
