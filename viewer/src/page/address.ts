// SPDX-License-Identifier: MIT
// Stores the state of the page in its address, so that a link shows the same view.
import type { DataView } from "../scene/data_view";
import { exact } from "../common/number_format";
import { prefersDark, themeOf } from "../common/palette";
import type { ColourMode } from "../model/colour_modes";
import type { Session } from "../model/session";

const kMostRuns = 400; // number of runs of selected bars

/// "1-3,7" of 1, 2, 3, 7.
function inRuns(ascending: number[]): string[] {
  const runs: string[] = [];
  for (let i = 0; i < ascending.length; ) {
    const first = i;
    while (ascending[++i] === ascending[i - 1]! + 1);
    runs.push(i - first === 1 ? `${ascending[first]}` : `${ascending[first]}-${ascending[i - 1]}`);
  }
  return runs;
}

function fromRuns(text: string, size: number): number[] {
  return text.split(",").flatMap((run) => {
    if (!/^\d+(-\d+)?$/.test(run)) return [];
    const [first, last = first] = run.split("-").map(Number) as [number, number?];
    return last! < size ? Array.from({ length: last! - first + 1 }, (_, i) => first + i) : [];
  });
}

export function addressOf(session: Session, data: DataView | undefined): string {
  const { report, selection, hiddenDims } = session;
  const parts = new Map<string, string>();
  if (report.tree && session.cutValue !== report.meta.tree!.cut)
    parts.set("cut", exact(session.cutValue));
  if (report.elements && session.colour !== session.colourModes()[0]?.[0])
    parts.set("colour", session.colour);
  if (hiddenDims.size > 0) parts.set("hide", [...hiddenDims].join(","));
  if (session.scale !== undefined) parts.set("scale", exact(session.scale));
  if (report.image) parts.set("slice", `${session.sliceAxis},${session.slice}`);
  if (session.theme.dark !== prefersDark())
    parts.set("theme", session.theme.dark ? "dark" : "light");
  if (!session.selectsTheFinding) {
    const runs = inRuns(selection);
    if (runs.length <= kMostRuns) parts.set("bars", runs.join(","));
  }
  if (session.hiddenSurfaces.size > 0) parts.set("without", [...session.hiddenSurfaces].join(","));
  if (session.beside) parts.set("beside", "truth");
  if (data?.stage?.moved) parts.set("view", data.stage.view.join(","));
  return [...parts].map(([name, value]) => `${name}=${value}`).join("&");
}

/// Restores the state that an address describes. State that the address does not name takes its
/// default; unknown parts of the address are ignored.
export function goTo(address: string, session: Session, data: DataView | undefined): void {
  const { report } = session;
  const parts = new Map(
    address
      .replace(/^#/, "")
      .split("&")
      .map((part) => part.split("=", 2) as [string, string]),
  );
  const numbers = (name: string) =>
    (parts.get(name) ?? "")
      .split(",")
      .filter((w) => w !== "")
      .map(Number);
  session.startAgain();
  const cut = Number(parts.get("cut"));
  if (report.tree && parts.has("cut") && cut >= 0 && Number.isFinite(cut)) session.setCut(cut);
  const colour = parts.get("colour") as ColourMode;
  if (report.elements && session.colourModes().some(([mode]) => mode === colour))
    session.set("colour", colour, "colour");
  for (const dim of new Set(numbers("hide")))
    if (report.bars.dims.includes(dim)) session.toggleDim(dim);
  for (const surface of new Set(numbers("without")))
    if (report.meta.scene?.surfaces[surface - 1]) session.toggleSurface(surface);
  if (report.elements?.truth && parts.get("beside") === "truth")
    session.set("beside", true, "view");
  const scale = Number(parts.get("scale"));
  if (parts.has("scale") && Number.isFinite(scale)) session.set("scale", scale, "scale");
  const [axis, slice] = numbers("slice");
  const size = report.image?.shape[axis ?? -1];
  if (
    size !== undefined &&
    slice !== undefined &&
    Number.isInteger(slice) &&
    slice >= 0 &&
    slice < size
  ) {
    session.set("sliceAxis", axis!, "slice");
    session.set("slice", slice, "slice");
  }
  const isDark = parts.has("theme") ? parts.get("theme") === "dark" : prefersDark();
  session.set("theme", themeOf(isDark), "theme");
  if (parts.has("bars")) session.select(fromRuns(parts.get("bars")!, report.bars.size));
  data?.face(); // must come before the view, because it resets the view
  if (data?.stage && parts.has("view")) data.stage.view = numbers("view");
  else data?.stage?.reset();
}
