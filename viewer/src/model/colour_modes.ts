// SPDX-License-Identifier: MIT
import { kindOfSegment } from "./words";
import type { Report } from "./report";

export type ColourMode =
  "grey" | "segment" | "rgb" | "truth" | "normal" | "depth" | "birth" | "persistence" | "plain";

const kLeastPart = 0.02; // share of the largest segment

/// The colour modes of a report, the default first. An image is unchanged by default, and a mesh is
/// coloured by its values. Other data are coloured by segment if there are several segments,
/// otherwise by the input colours, and without these in one colour.
export function colourModesOf(report: Report): [ColourMode, string][] {
  const { elements, tree, cloud, image, isMesh, meta } = report;
  const modes: [ColourMode, string][] = [];
  const told = !!tree && !!elements?.leaf;
  if (image) modes.push(["grey", "grey value"]);
  if (isMesh && elements?.birth) modes.push(["birth", "value"]);
  if (told) modes.push(["segment", kindOfSegment(meta)]);
  if (elements?.rgb) modes.push(["rgb", "input colour"]);
  if (!image) modes.push(["plain", "one colour"]);
  if (elements?.truth) modes.push(["truth", "ground truth"]);
  if (elements?.normals) modes.push(["normal", "normal"]);
  if (cloud?.dims === 3) modes.push(["depth", meta.cloud?.viewpoint ? "depth" : "z"]);
  if (!isMesh && elements?.birth) modes.push(["birth", image ? "value" : "birth"]);
  if (told) modes.push(["persistence", "persistence"]);
  if (modes[0]?.[0] === "segment" && !hasParts(report) && modes.length > 1)
    modes.push(modes.shift()!);
  return modes;
}

/// True if the program's cut has more than one large part; results of ph-segment are always shown.
function hasParts({ tree, meta }: Report): boolean {
  if (!tree || meta.tree?.command) return !!tree;
  const [first, second] = tree.cut(meta.tree!.cut).segments;
  return second !== undefined && second.points >= kLeastPart * first!.points;
}
