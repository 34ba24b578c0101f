// SPDX-License-Identifier: MIT
// A colour for each point or voxel, by what the reader asked for. What is not brought out fades.
import { ramp, segmentColour, type Rgb } from "./palette";
import type { ColourMode, Session } from "./session";

export interface Range {
  low: number;
  high: number;
}

const kNoSegment: Rgb = [150, 156, 165];

export class Colouring {
  /// Red, green, blue, 255 of each element.
  readonly rgba: Uint8Array;
  private readonly base: Uint8Array; // without highlights
  private readonly ranges = new Map<ColourMode, Range>();
  private baseKey = "";
  private key = ""; // of what is brought out
  private selection: number[] = [];

  constructor(private readonly session: Session) {
    const count = session.report.elements!.count;
    this.rgba = new Uint8Array(4 * count);
    this.base = new Uint8Array(4 * count);
  }

  /// The values that a continuous colour spans.
  range(mode: ColourMode): Range | undefined {
    if (mode !== "depth" && mode !== "birth" && mode !== "persistence") return undefined;
    let range = this.ranges.get(mode);
    if (!range) this.ranges.set(mode, (range = this.measure(mode)));
    return range;
  }

  /// @return whether any colour may have changed: a pointer moves much inside one segment.
  update(mode: ColourMode = this.session.colour): boolean {
    const { session } = this;
    const painted = this.paintBase(mode);
    const { segment, bar } = session.focus;
    const key = [segment, segment > 0 ? -1 : bar, session.scale ?? "all"].join();
    if (!painted && key === this.key && session.selection === this.selection) return false;
    this.key = key;
    this.selection = session.selection;
    this.fade();
    return true;
  }

  private fade(): void {
    const { session } = this;
    const { elements } = session.report;
    const leaves = session.highlightedLeaves();
    const limit = elements!.birth ? session.scale : undefined;
    const fade = session.theme.dark ? [30, 35, 42] : [232, 235, 239];
    this.rgba.set(this.base);
    if (!leaves && limit === undefined) return;
    const { leaf, birth, count } = elements!;
    for (let i = 0; i < count; ++i) {
      const out = leaves && leaf && !leaves[leaf[i]!];
      if (!out && !(limit !== undefined && birth![i]! > limit)) continue;
      for (let k = 4 * i; k < 4 * i + 3; ++k) this.rgba[k] = 0.2 * this.rgba[k]! + 0.8 * fade[k - 4 * i]!;
    }
  }

  private paintBase(mode: ColourMode): boolean {
    const { session } = this;
    const key = [mode, session.theme.dark, mode === "segment" || mode === "persistence" ? session.cutValue : 0].join();
    if (key === this.baseKey) return false;
    this.baseKey = key;
    const { base } = this;
    const put = (i: number, c: Rgb) => {
      base[4 * i] = c[0];
      base[4 * i + 1] = c[1];
      base[4 * i + 2] = c[2];
      base[4 * i + 3] = 255;
    };
    const { elements, cloud } = session.report;
    const { count, rgb, normals, leaf, truth } = elements!;
    const range = this.range(mode);
    if (mode === "segment" || mode === "persistence") {
      const ofLeaf = mode === "segment" ? this.segmentColours() : this.persistenceColours(range!);
      for (let i = 0; i < count; ++i) put(i, ofLeaf[leaf![i]!] ?? this.colourOfNone());
      if (mode === "segment" && rgb) this.shadeBy((i) => 0.299 * rgb[3 * i]! + 0.587 * rgb[3 * i + 1]! + 0.114 * rgb[3 * i + 2]!);
      if (mode === "segment" && session.report.image) {
        const { low, high } = this.range("birth")!;
        this.shadeBy((i) => (255 * (elements!.birth![i]! - low)) / (high - low || 1));
      }
    } else if (mode === "rgb") {
      for (let i = 0; i < count; ++i) put(i, [rgb![3 * i]!, rgb![3 * i + 1]!, rgb![3 * i + 2]!]);
    } else if (mode === "truth") {
      const colours = new Map<number, Rgb>([[0, this.colourOfNone()]]);
      for (const label of [...new Set(truth!)].sort((a, b) => a - b))
        if (label > 0) colours.set(label, segmentColour((label - 1) % 28));
      for (let i = 0; i < count; ++i) put(i, colours.get(truth![i]!)!);
    } else if (mode === "normal") {
      for (let i = 0; i < count; ++i) put(i, colourOfNormal(normals![2 * i]!, normals![2 * i + 1]!));
    } else if (mode === "plain") {
      for (let i = 0; i < count; ++i) put(i, session.theme.dark ? [168, 178, 190] : [92, 102, 115]);
    } else {
      const value = mode === "depth" ? this.depths(cloud!.positions) : (i: number) => elements!.birth![i]!;
      const span = range!.high - range!.low || 1;
      for (let i = 0; i < count; ++i) put(i, ramp((value(i) - range!.low) / span));
    }
    return true;
  }

  /// A quarter of what the camera saw, so that a segment is not flat.
  private shadeBy(grey: (i: number) => number): void {
    for (let i = 0; i < this.base.length / 4; ++i)
      for (let k = 4 * i, g = grey(i); k < 4 * i + 3; ++k) this.base[k] = 0.75 * this.base[k]! + 0.25 * g;
  }
  private colourOfNone(): Rgb {
    return this.session.theme.dark ? [84, 92, 103] : kNoSegment;
  }
  private segmentColours(): Rgb[] {
    const { cut, segmentColours } = this.session;
    return Array.from(cut!.labelOfLeaf, (label) => segmentColours[label - 1] ?? this.colourOfNone());
  }
  private persistenceColours(range: Range): Rgb[] {
    const { report: { tree }, cutValue } = this.session;
    const span = range.high - range.low || 1;
    return Array.from({ length: tree!.leaves }, (_, leaf) =>
      ramp((tree!.level(tree!.branchAt(leaf, cutValue)) - range.low) / span));
  }
  private depths(positions: Float32Array): (i: number) => number {
    const { meta, cloud } = this.session.report;
    const eye = meta.cloud?.viewpoint, origin = cloud!.origin;
    if (!eye) return (i) => positions[3 * i + 2]! + origin[2]!;
    const [x, y, z] = eye.map((c, k) => c - origin[k]!) as Rgb;
    return (i) => Math.hypot(positions[3 * i]! - x, positions[3 * i + 1]! - y, positions[3 * i + 2]! - z);
  }
  private measure(mode: ColourMode): Range {
    const { elements, cloud, tree } = this.session.report;
    if (mode === "persistence") {
      const levels = tree!.arrays.levels.filter((v) => Number.isFinite(v));
      return rangeOf(levels.length, (i) => levels[i]!, 0);
    }
    if (mode === "depth") return rangeOf(elements!.count, this.depths(cloud!.positions));
    return rangeOf(elements!.count, (i) => elements!.birth![i]!);
  }
}

function rangeOf(count: number, value: (i: number) => number, least = Infinity): Range {
  let low = least, high = -Infinity;
  for (let i = 0; i < count; ++i) {
    const v = value(i);
    if (!Number.isFinite(v)) continue;
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return high < low ? { low: 0, high: 1 } : { low, high };
}

/// Two numbers of an octahedron, -127 … 127; -128: no normal.
export function normalOf(u: number, v: number): [number, number, number] | undefined {
  if (u === -128) return undefined;
  let x = u / 127, y = v / 127;
  const z = 1 - Math.abs(x) - Math.abs(y);
  if (z < 0) [x, y] = [(1 - Math.abs(y)) * (x < 0 ? -1 : 1), (1 - Math.abs(x)) * (y < 0 ? -1 : 1)];
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

function colourOfNormal(u: number, v: number): Rgb {
  const n = normalOf(u, v);
  return n ? (n.map((c) => Math.round(127.5 * (c + 1))) as Rgb) : kNoSegment;
}

