// SPDX-License-Identifier: MIT
import { addressOf, goTo } from "./address";
import { Barcode } from "../charts/barcode";
import { CutChart } from "../charts/cut_chart";
import { DataView } from "../scene/data_view";
import { Diagram } from "../charts/diagram";
import { button, el } from "../common/dom";
import { cutSays, foldable } from "./folding";
import { prefersDark, themeOf } from "../common/palette";
import { readPayload } from "../model/payload";
import { readingOf, selectionOf } from "./status_text";
import { reportOf } from "../model/report";
import { Session } from "../model/session";
import { Toolbar } from "./toolbar";
import { TreeChart } from "../charts/tree_chart";
import type { Views } from "./exports";

async function start(app: HTMLElement): Promise<void> {
  const session = new Session(reportOf(await readPayload(document)));
  const { report } = session;
  document.title = report.meta.title;
  followTheme(session);

  const data = report.elements ? new DataView(session) : undefined;
  const diagram = new Diagram(session),
    barcode = new Barcode(session);
  const cut = report.tree && new CutChart(session),
    tree = report.tree && new TreeChart(session);
  const views: Views = {
    data,
    charts: [
      ["Persistence diagram", diagram],
      ["Barcode", barcode],
      ...(cut && tree
        ? ([
            ["Cut", cut],
            ["Merge tree", tree],
          ] as Views["charts"])
        : []),
    ],
  };
  if (cut && tree) {
    const folded = !cutSays(session, cut.counts);
    const unfold = [
      foldable(cut.panel, "Cut", folded),
      foldable(tree.panel, "Merge tree", folded),
    ];
    // A reader who asks for the colours of segments, or for another cut, wants to see the cut and
    // the tree.
    session.onChange((changes) => {
      const ofCut = session.colour === "segment" || session.colour === "persistence";
      const other = session.cutValue !== report.meta.tree!.cut;
      if ((changes.has("colour") && ofCut) || (changes.has("cut") && other))
        for (const open of unfold) open();
    });
  }
  if (report.bars.size < 2) foldable(diagram.panel, "Persistence diagram", true);
  const left = [data?.panel, cut?.panel, tree?.panel].filter((panel) => panel !== undefined);
  const page = el(
    "main",
    { class: data ? "with-data" : left.length > 0 ? "with-tree" : "bars-only" },
    ...(left.length > 0 ? [el("div", { class: "column left" }, ...left)] : []),
    el("div", { class: "column right" }, diagram.panel, barcode.panel),
  );
  const toolbar = new Toolbar(session, views, page).element;
  app.replaceChildren(toolbar, findingLine(session, diagram), page, statusLine(session));

  document.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || document.querySelector("dialog[open]")) return;
    const menu = document.querySelector<HTMLDetailsElement>(".menu[open]");
    if (!menu) return session.select([]);
    menu.open = false;
    menu.querySelector("summary")!.focus();
  });
  keepAddress(session, data);
  app.removeAttribute("aria-busy");
  requestAnimationFrame(() =>
    requestAnimationFrame(() => {
      app.dataset["firstFrame"] = performance.now().toFixed(0);
    }),
  );
}

function followTheme(session: Session): void {
  const show = () =>
    (document.documentElement.dataset["theme"] = session.theme.dark ? "dark" : "light");
  session.theme = themeOf(prefersDark());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (event) =>
    session.set("theme", themeOf(event.matches), "theme"),
  );
  session.onChange((changes) => changes.has("theme") && show());
  show();
}

/// The finding in one sentence; a click selects its bars again.
function findingLine(session: Session, diagram: Diagram): HTMLElement {
  const { sentence, bars } = session.finding;
  const select = () => {
    session.select(bars);
    diagram.takeFocus(); // the button hides itself
  };
  const again = button("select", select, { class: "quiet", title: "select these bars" });
  const show = () => (again.hidden = bars.length === 0 || session.selectsTheFinding);
  session.onChange((changes) => changes.has("selection") && show());
  show();
  return el("p", { class: "finding" }, el("span", {}, sentence), again);
}

function statusLine(session: Session): HTMLElement {
  const reading = el("output", { class: "reading", "aria-live": "polite" });
  const selection = el("span", { class: "selection" });
  const clear = button("clear", () => session.select([]), { class: "quiet" });
  const hint = matchMedia("(hover: none)").matches
    ? "Tap a bar, a branch or a point to select it."
    : "Hover over a bar, a branch or a point; click selects it.";
  const show = () => {
    reading.textContent = readingOf(session) || hint;
    selection.textContent = selectionOf(session);
    clear.disabled = session.selection.length === 0;
  };
  session.onChange(
    (changes) => (changes.has("focus") || changes.has("selection") || changes.has("cut")) && show(),
  );
  show();
  return el("footer", { class: "status" }, reading, selection, clear);
}

function keepAddress(session: Session, data: DataView | undefined): void {
  if (location.protocol === "about:") return; // a frame in a notebook has no address
  goTo(location.hash, session, data);
  let timer = 0;
  session.onChange((changes) => {
    if (changes.size === 1 && changes.has("focus")) return;
    clearTimeout(timer);
    timer = setTimeout(() => history.replaceState(null, "", `#${addressOf(session, data)}`), 150);
  });
  addEventListener("hashchange", () => goTo(location.hash, session, data));
}

const app = document.getElementById("app")!;
start(app).catch((error: unknown) => {
  const what = error instanceof Error ? error.message : String(error);
  app.replaceChildren(
    el("p", { class: "failure", role: "alert" }, `This report cannot be shown: ${what}`),
  );
  app.removeAttribute("aria-busy");
});
