// SPDX-License-Identifier: MIT
// The state of the page in its address, so that a link shows the same.
import type { DataView } from "../scene/data_view";
import { exact } from "../common/number_format";
import { prefersDark, themeOf } from "../common/palette";
import type { ColourMode } from "../model/colour_modes";
import type { Session } from "../model/session";

const kMostBars = 200;

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
  if (!session.selectsTheFinding && selection.length <= kMostBars) parts.set("bars", selection.join(","));
  if (data?.stage?.moved) parts.set("view", data.stage.view.join(","));
  return [...parts].map(([name, value]) => `${name}=${value}`).join("&");
}

/// What is not understood is passed over.
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
  const cut = Number(parts.get("cut"));
  if (report.tree && parts.has("cut") && cut >= 0 && Number.isFinite(cut)) session.setCut(cut);
  const colour = parts.get("colour") as ColourMode;
  if (report.elements && session.colourModes().some(([mode]) => mode === colour))
    session.set("colour", colour, "colour");
  for (const dim of numbers("hide"))
    if (report.bars.dims.includes(dim) && !session.hiddenDims.has(dim)) session.toggleDim(dim);
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
  if (parts.has("theme")) session.set("theme", themeOf(parts.get("theme") === "dark"), "theme");
  const bars = numbers("bars").filter(
    (bar) => Number.isInteger(bar) && bar >= 0 && bar < report.bars.size,
  );
  if (parts.has("bars")) session.select(bars);
  data?.face(); // before the view, not after it
  if (data?.stage && parts.has("view")) data.stage.view = numbers("view");
}
