// SPDX-License-Identifier: MIT
// The contents of a report: its checked metadata, and its arrays under the names of
// docs/reference/report-format.md.
import { decoded, PayloadError, type Block, type Numbers, type Payload } from "./payload";
import { Bars } from "./bars";
import { MergeTree } from "./merge_tree";
import { Matching } from "./matching";
import type { Meta, SceneMeta } from "./meta";

/// The points or voxels that are shown.
export interface Elements {
  count: number;
  rgb: Uint8Array | undefined;
  normals: Int8Array | undefined; // octahedral encoding, two per point
  readonly birth: Numbers | undefined; // computed on first use
  truth: Numbers | undefined;
  surface: Numbers | undefined; // removed surface that the point belonged to; 0: none
  leaf: Numbers | undefined; // leaf in the merge tree; 2^bits - 1: none
}

export interface Cloud {
  dims: number;
  origin: number[];
  positions: Float32Array; // x, y, z of each point from the origin, in units of the input
  index: Numbers | undefined; // number of each point in the input; ascending
  extent: number; // largest distance from the origin along an axis
}

export interface Image {
  shape: number[]; // planes, rows, columns
  values: Numbers;
  shift: number; // converts a doubled coordinate to twice the index of its voxel
}

/// Representatives: a bar has the chain `ofBar.get(bar)`; chain i has the cells start[i] …
/// start[i + 1] - 1.
export interface Chains {
  ofBar: Map<number, number>;
  start: Numbers;
  cells: Numbers;
  coefficients: Numbers | undefined;
  first: Float64Array; // index into `cells` of each chain
}

/// Sets of voxels of bars, as runs of consecutive voxels.
export interface VoxelSets {
  ofBar: Map<number, number>;
  start: Numbers; // set i has the runs start[i] … start[i + 1] - 1
  runs: Numbers; // index of the first voxel, and number of voxels, of each run
  surfaces: Map<number, Float32Array>; // surfaces of the last bars shown, by bar
}

export interface Report {
  meta: Meta;
  bars: Bars;
  elements: Elements | undefined;
  cloud: Cloud | undefined;
  image: Image | undefined;
  tree: MergeTree | undefined;
  chains: Chains | undefined;
  matching: Matching | undefined; // for the two barcodes of a comparison
  voxels: VoxelSets | undefined;
  edges: { ends: Numbers; values: Numbers } | undefined;
  triangles: { corners: Numbers; values: Numbers } | undefined;
  isMesh: boolean; // true if the triangles are data; otherwise they depend on the scale
  payloadBytes: number;
}

function fail(what: string): never {
  throw new PayloadError(`report: ${what}`);
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function checkedMeta(value: unknown): Meta {
  if (!isRecord(value) || value["format"] !== "ph-report") fail("found another format");
  if (value["version"] !== 1) fail(`found version ${String(value["version"])}, expected 1`);
  for (const name of ["title", "program"])
    if (typeof value[name] !== "string") fail(`${name} is no text`);
  if (!isRecord(value["provenance"])) fail("provenance is missing");
  if (!isRecord(value["value"])) fail("value is missing");
  const barcodes = value["barcodes"];
  if (!Array.isArray(barcodes) || barcodes.length < 1 || barcodes.length > 2)
    fail("expected one or two barcodes");
  if (!barcodes.every((b) => isRecord(b) && typeof b["name"] === "string"))
    fail("a barcode has no name");
  if (value["scene"] !== undefined) checkScene(value["scene"]);
  return readable(value) as Meta;
}

function checkScene(scene: unknown): void {
  if (!isRecord(scene)) fail("scene is no object");
  const { segments, surfaces } = scene;
  if (!Array.isArray(segments) || !segments.every(isRecord)) fail("scene.segments is no list");
  if (!Array.isArray(surfaces) || !surfaces.every(isRecord)) fail("scene.surfaces is no list");
  for (const { colour } of segments)
    if (typeof colour !== "string" || !/^#[0-9a-f]{6}$/.test(colour)) fail("a segment has no colour");
}

/// Characters that change the text direction could make a name disguise the text around it, so they
/// are replaced. Command lines keep them, because they must name the file.
function readable(value: unknown, key = ""): unknown {
  if (key === "command") return value;
  if (typeof value === "string") return value.replace(/[\u202a-\u202e\u2066-\u2069]/g, "\ufffd");
  if (Array.isArray(value)) return value.map((item) => readable(item));
  if (!isRecord(value)) return value;
  return Object.fromEntries(
    Object.entries(value).map(([name, item]) => [readable(name), readable(item, name)]),
  );
}

export function reportOf(payload: Payload): Report {
  const meta = checkedMeta(payload.meta);
  const block = (name: string) => payload.blocks.get(name);
  const array = (name: string) => {
    const found = block(name);
    return found && decoded(found);
  };
  const need = (name: string) => array(name) ?? fail(`array ${name} is missing`);

  const bars = new Bars(
    meta.barcodes.map((_, i) => {
      const prefix = i === 0 ? "bars" : "bars2";
      return {
        dim: need(`${prefix}/dim`),
        birth: need(`${prefix}/birth`),
        death: need(`${prefix}/death`),
        birthCells: array(`${prefix}/birth_cells`),
        deathCells: array(`${prefix}/death_cells`),
      };
    }),
    meta.barcodes,
    block("image/values")?.shape.length ?? 0,
  );
  const cloud = cloudOf(block("points/position"), array("points/index"));
  const image = imageOf(block("image/values"), meta);
  const count = cloud ? cloud.positions.length / 3 : (image?.values.length ?? 0);
  const ofElement = (name: string) => {
    const found = array(`points/${name}`);
    if (found && found.length < count) fail(`points/${name} is too short`);
    return found;
  };
  let births = ofElement("birth");
  const elements =
    count > 0
      ? {
          count,
          rgb: ofElement("rgb") as Uint8Array | undefined,
          normals: block("points/normal")?.values as Int8Array | undefined,
          get birth() {
            return (births ??= image && birthsOf(image, meta));
          },
          truth: ofElement("truth"),
          surface: ofElement("surface"),
          leaf: ofElement("leaf"),
        }
      : undefined;
  const edges = block("complex/edges")
    ? { ends: need("complex/edges"), values: need("complex/edge_values") }
    : undefined;
  return {
    meta,
    bars,
    elements,
    cloud,
    image,
    tree: meta.tree ? treeOf(meta.tree, meta.scene, need, array, bars) : undefined,
    chains: chainsOf(need, array, bars, meta),
    matching: matchingOf(array("matching/pairs"), bars),
    voxels: image && voxelsOf(need, array, image),
    edges,
    triangles: block("complex/triangles")
      ? { corners: need("complex/triangles"), values: need("complex/triangle_values") }
      : undefined,
    isMesh: block("complex/triangles") !== undefined && !isTriangulated(meta),
    payloadBytes: payload.bytes,
  };
}

/// True if the simplices belong to a triangulation of the points.
function isTriangulated({ provenance }: Meta): boolean {
  return ["alpha", "delaunay-cech", "delaunay-rips"].includes(provenance.complex ?? "");
}

/// Positions relative to the least coordinates, because float32 is too coarse for map coordinates.
function cloudOf(block: Block | undefined, index: Numbers | undefined): Cloud | undefined {
  if (!block || block.values.length === 0) return undefined;
  const dims = block.shape[1] ?? 1,
    { values, offset, scale } = block;
  if (block.shape.length !== 2 || dims < 1 || dims > 3)
    fail("points/position needs one to three columns");
  const origin = [0, 0, 0];
  for (let k = 0; k < dims; ++k) origin[k] = offset[k] ?? least(values, k, dims);
  const positions = new Float32Array(3 * block.shape[0]!);
  const reach = [0, 0, 0];
  for (let i = 0, p = 0; i < values.length; i += dims, p += 3)
    for (let k = 0; k < dims; ++k) {
      const from =
        scale.length > 0 ? (scale[k] ?? scale[0]!) * values[i + k]! : values[i + k]! - origin[k]!;
      positions[p + k] = from;
      reach[k] = Math.max(reach[k]!, from);
    }
  return { dims, origin, positions, index, extent: Math.max(...reach) };
}

function least(values: Numbers, from: number, step: number): number {
  let low = Infinity;
  for (let i = from; i < values.length; i += step) low = Math.min(low, values[i]!);
  return low;
}

function imageOf(block: Block | undefined, meta: Meta): Image | undefined {
  if (!block || block.values.length === 0) return undefined;
  if (block.shape.length > 3) fail("image/values has more than three axes");
  const shape = [1, 1, 1, ...block.shape].slice(-3);
  return { shape, values: decoded(block), shift: meta.image?.construction === "cells" ? -1 : 0 };
}

/// The value at which each voxel enters: its own, or minus its own for superlevel sets. NaN: never.
function birthsOf({ values }: Image, meta: Meta): Numbers {
  if (!meta.value.negated) return values;
  const births = roomForNegated(values);
  for (let i = 0; i < births.length; ++i) births[i] = -values[i]!;
  return births;
}

function roomForNegated(values: Numbers): Numbers {
  if (values instanceof Float32Array) return new Float32Array(values.length);
  if (values.BYTES_PER_ELEMENT === 1) return new Int16Array(values.length);
  if (values.BYTES_PER_ELEMENT === 2) return new Int32Array(values.length);
  return new Float64Array(values.length);
}

function treeOf(
  meta: NonNullable<Meta["tree"]>,
  scene: SceneMeta | undefined,
  need: (name: string) => Numbers,
  array: (name: string) => Numbers | undefined,
  bars: Bars,
): MergeTree {
  const flat = scene && array("tree/leaf_on");
  return new MergeTree({
    rule: meta.rule,
    minSize: meta.min_size ?? 1,
    births: need("tree/leaf_birth"),
    points: need("tree/leaf_points"),
    vertices: need("tree/leaf_vertices"),
    younger: need("tree/merge_younger"),
    elder: need("tree/merge_elder"),
    values: need("tree/merge_value"),
    levels: need("tree/merge_level"),
    answer: scene && {
      labels: need("tree/leaf_label"),
      surfaces: need("tree/leaf_surface"),
      segments: scene.segments.length,
    },
    flat: flat && {
      on: flat,
      planes: scene!.surfaces.length - scene!.removed,
      first: scene!.removed + 1,
      least: scene!.flat,
    },
    touching: array("tree/touching"),
    mergeBar: array("tree/merge_bar"),
    leafBar: array("tree/leaf_bar"),
    infinite: (bar) => bars.isInfinite(bar),
  });
}

function chainsOf(
  need: (name: string) => Numbers,
  array: (name: string) => Numbers | undefined,
  bars: Bars,
  meta: Meta,
): Chains | undefined {
  const bar = array("chains/bar");
  if (!bar) return undefined;
  const start = need("chains/start");
  const ofBar = new Map<number, number>();
  const first = new Float64Array(bar.length + 1);
  for (let i = 0; i < bar.length; ++i) {
    ofBar.set(bar[i]!, i);
    const arity = bars.arity(bar[i]!, 0);
    first[i + 1] = first[i]! + (start[i + 1]! - start[i]!) * arity;
  }
  const cells = need("chains/cells");
  if (first[bar.length]! > cells.length) fail("chains/cells is too short");
  if (meta.barcodes[0]?.cells === "row") return undefined;
  return { ofBar, start, cells, coefficients: array("chains/coefficients"), first };
}

function matchingOf(pairs: Numbers | undefined, bars: Bars): Matching | undefined {
  if (!pairs) return undefined;
  for (const bar of pairs) if (bar >= bars.size) fail(`matching/pairs: there is no bar ${bar}`);
  return new Matching(pairs);
}

function voxelsOf(
  need: (name: string) => Numbers,
  array: (name: string) => Numbers | undefined,
  image: Image,
): VoxelSets | undefined {
  const bar = array("voxels/bar");
  if (!bar) return undefined;
  const start = need("voxels/start"),
    runs = need("voxels/runs");
  if (2 * (start[bar.length] ?? Infinity) > runs.length) fail("voxels/runs is too short");
  for (let i = 0; i + 1 < runs.length; i += 2)
    if (runs[i]! + runs[i + 1]! > image.values.length) fail("voxels/runs leaves the image");
  return { ofBar: new Map(Array.from(bar, (b, i) => [b, i])), start, runs, surfaces: new Map() };
}
