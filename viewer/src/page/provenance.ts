// SPDX-License-Identifier: MIT
// Shows the origin of the page: everything that is needed to reproduce it.
import { commandLine } from "../model/command_line";
import { button, el } from "../common/dom";
import { bytes, counted, exact, grouped, homology, seconds, short } from "../common/number_format";
import type { Meta } from "../model/meta";
import type { Session } from "../model/session";

export function provenanceDialog(session: Session): HTMLDialogElement {
  const { meta, bars, elements, tree, payloadBytes } = session.report;
  const p = meta.provenance;
  const command = el("code", { class: "command" });
  const list = el("dl", {});
  const entry = (name: string, value: string | number | Node | null | undefined) => {
    if (value === undefined || value === null || value === "") return;
    list.append(
      el("dt", {}, name),
      el("dd", {}, typeof value === "number" ? String(value) : value),
    );
  };
  entry("Program", p.version ?? meta.program);
  entry(
    "Command",
    p.command &&
      el(
        "span",
        {},
        command,
        button("copy", () => void navigator.clipboard?.writeText(command.textContent ?? ""), {
          class: "quiet",
        }),
      ),
  );
  entry("Input", p.input?.path);
  entry("Read as", p.input?.description);
  entry("SHA-256", p.input?.sha256);
  entry("Complex", p.complex);
  entry("Metric", ofValues(p, "metric"));
  entry("Construction", ofValues(p, "construction"));
  entry("Periodic axes", ofValues(p, "periodic"));
  entry("Field", p.field && (p.field === 2 ? "Z/2" : `Z/${p.field}`));
  entry("Highest dimension", p.max_dim);
  entry("Threshold", typeof p.threshold === "number" ? exact(p.threshold) : undefined);
  const least = p.filtration?.min_persistence;
  entry(
    "Left out",
    typeof least === "number" && least > 0 ? `bars of length ${exact(least)} and less` : undefined,
  );
  entry("Engine", p.engine);
  entry(
    "Bars",
    bars.dims.map((dim) => `${grouped(bars.count(dim, 0))} in dimension ${dim}`).join(", ") ||
      "none",
  );
  entry("Distances", distancesOf(meta).join("\n"));
  if (tree)
    entry(
      "Merge tree",
      `${counted(tree.leaves, "leaf").replace("leafs", "leaves")}, ${counted(tree.merges, "merge")}`,
    );
  entry(
    "Times",
    Object.entries(p.timings ?? {})
      .map(([stage, s]) => `${stage} ${seconds(s)}`)
      .join(", "),
  );
  entry("Peak memory", typeof p.peak_memory === "number" ? bytes(p.peak_memory) : undefined);
  for (const [name, text] of Object.entries(p.notes ?? {})) entry(name, text);
  for (const warning of p.warnings ?? []) entry("Warning", warning);
  if (elements)
    entry(
      "In this page",
      `${counted(elements.count, session.report.image ? "voxel" : "point")}, ${bytes(payloadBytes)} of data`,
    );
  const dialog = el(
    "dialog",
    { class: "about", "aria-label": "About this report" },
    el("h2", {}, "About this report"),
    list,
    button("close", () => dialog.close(), { class: "close" }),
  );
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  const show = () => (command.textContent = commandLine(session));
  session.onChange((changes) => changes.has("cut") && show());
  show();
  return dialog;
}

/// A name, or numbers, from the description of the values.
function ofValues(provenance: Meta["provenance"], name: string): string | undefined {
  const said = provenance.filtration?.[name];
  if (Array.isArray(said)) return said.join(", ");
  return typeof said === "string" ? said : undefined;
}

/// "H₁ bottleneck 0.05", one per dimension.
export function distancesOf(meta: Meta): string[] {
  return (meta.distances ?? []).map(
    ({ dim, bottleneck }) => `${homology(dim)} bottleneck ${short(bottleneck ?? Infinity)}`,
  );
}

export function helpDialog(): HTMLDialogElement {
  const rows: [string, string][] = [
    ["hover, or arrow keys", "bring out a bar, a branch, a segment or a point in every view"],
    ["click, or Enter", "select it; with Shift, add it or take it away"],
    ["drag in the diagram", "select all bars inside the lasso"],
    ["Shift + arrow keys there", "select bar after bar, the most persistent first"],
    ["drag, wheel", "turn and zoom the cloud; with the right button, move it"],
    ["arrows, + − 0", "the same where the cloud has the focus; 0 shows everything"],
    ["Tab", "go from control to control; charts can be turned into tables"],
    ["Escape", "select nothing"],
  ];
  const dialog = el(
    "dialog",
    { class: "about", "aria-label": "Help" },
    el("h2", {}, "How to read and use this page"),
    el(
      "p",
      {},
      "A bar [birth, death) is a hole: H₀ components, H₁ loops, H₂ voids. A dot far above the diagonal, or a long bar, is a persistent hole. All views show the same bars; the address of the page keeps what you see.",
    ),
    el("dl", {}, ...rows.flatMap(([key, text]) => [el("dt", {}, key), el("dd", {}, text)])),
    button("close", () => dialog.close(), { class: "close" }),
  );
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  return dialog;
}
