// SPDX-License-Identifier: MIT
// Describes the segments and surfaces of a scene in words.
import { counted, short } from "../common/number_format";
import { listed } from "./words";
import type { SceneMeta, SegmentMeta } from "./meta";

const kSurfaceRoles: readonly string[] = ["support", "floor", "shelf", "wall", "ceiling"];

/// "support 1": the name of a surface; its number is the same as in `--surfaces` and in the JSON.
export function nameOfSurface({ surfaces }: SceneMeta, number: number): string {
  const role = surfaces[number - 1]?.role ?? "";
  return `${kSurfaceRoles.includes(role) ? role : "surface"} ${number}`;
}

/// "on support 1" or "on 3"; the role of the segment if it does not visibly stand on anything.
export function standing(scene: SceneMeta, segment: SegmentMeta): string {
  if (segment.on_surface) return `on ${nameOfSurface(scene, segment.on_surface)}`;
  if (segment.on_segment) return `on ${segment.on_segment}`;
  return roleOf(segment);
}

function roleOf({ role }: SegmentMeta): string {
  return role === "container" || kSurfaceRoles.includes(role) ? role : "object";
}

/// "object on support 1, confidence 4.2"
export function factsOf(scene: SceneMeta, segment: SegmentMeta): string {
  const role = roleOf(segment);
  const on = standing(scene, segment);
  const confidence =
    segment.persistence === null ? "touches no other" : `confidence ${short(segment.persistence, 3)}`;
  return `${role}${on === role ? "" : ` ${on}`}, ${confidence}`;
}

/// "1 support and 2 walls"; empty if there are none.
export function surfacesInWords({ surfaces }: SceneMeta): string {
  const count = (role: string) => surfaces.filter((s) => s.role === role).length;
  const words = kSurfaceRoles.filter((role) => count(role) > 0);
  return listed(words.map((role) => counted(count(role), role)));
}
