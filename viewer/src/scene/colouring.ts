// SPDX-License-Identifier: MIT
// The colour of each point or voxel in the chosen mode. Elements that are not highlighted fade.
import { dimColour, fromHex, greyOf, kSurfaces, ramp, segmentColour, type Rgb } from "../common/palette";
import { barsInView } from "./representatives";
import { runsOf } from "../geometry/voxel_sets";
import type { ColourMode } from "../model/colour_modes";
import type { Numbers } from "../model/payload";
import type { Session } from "../model/session";

export interface Range {
  low: number;
  high: number;
  clipped?: boolean; // true if some values lie beyond its ends
}

/// Red is in the lowest byte, because textures expect this byte order.
function packed([r, g, b]: Rgb): number {
  return (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;
}

/// Mixes two colours: `part` 256ths of `a`, and the rest of `b`.
function mixed(a: number, b: number, part: number): number {
  const channel = (shift: number) =>
    ((((a >>> shift) & 255) * part + ((b >>> shift) & 255) * (256 - part)) >> 8) << shift;
  return (0xff000000 | channel(16) | channel(8) | channel(0)) >>> 0;
}

export class Colouring {
  /// Red, green, blue and 255 for each element; zeros for an absent voxel.
  readonly rgba: Uint8Array;
  private readonly shown: Uint32Array; // the same numbers as 32-bit words
  private readonly base: Uint32Array; // without highlights
  private readonly ranges = new Map<ColourMode, Range>();
  private mode: ColourMode = "plain"; // state of the last painting
  private baseKey = "";
  private key = ""; // state of the highlight
  private selection: number[] = [];

  constructor(private readonly session: Session) {
    const count = session.report.elements!.count;
    this.shown = new Uint32Array(count);
    this.base = new Uint32Array(count);
    this.rgba = new Uint8Array(this.shown.buffer);
  }

  /// The range of values that a continuous colour scale covers.
  range(mode: ColourMode): Range | undefined {
    if (!["grey", "depth", "birth", "persistence"].includes(mode)) return undefined;
    let range = this.ranges.get(mode);
    if (!range) this.ranges.set(mode, (range = this.measure(mode)));
    return range;
  }

  /// Updates the colours. @return true if any colour may have changed; while a pointer moves inside
  /// one segment, none changes.
  update(mode: ColourMode = this.session.colour): boolean {
    const { session } = this;
    this.mode = mode;
    const painted = this.paintBase(mode);
    const { segment, bar } = session.focus;
    // If bars have sets of voxels, the set of the bar is shown, whichever segment is highlighted.
    const anyBar = segment > 0 && !session.report.voxels;
    const basins = mode === "grey" ? session.cutValue : 0;
    const key = [segment, anyBar ? -1 : bar, session.scale ?? "all", basins].join();
    if (!painted && key === this.key && session.selection === this.selection) return false;
    this.key = key;
    this.selection = session.selection;
    this.fade();
    this.tintSets();
    return true;
  }

  private fade(): void {
    const { session } = this;
    const { leaf, birth, count } = session.report.elements!;
    // A grey picture does not change, except that highlighted elements are coloured.
    const isGrey = this.mode === "grey";
    const leaves = leaf && !isGrey ? session.highlightedLeaves() : undefined;
    const limit = birth ? session.scale : undefined;
    const fade = packed(session.theme.dark ? [30, 35, 42] : [232, 235, 239]);
    this.shown.set(this.base);
    if (isGrey) this.tintBasins();
    if (!leaves && limit === undefined) return;
    for (let i = 0; i < count; ++i) {
      const out =
        (leaves && !leaves[leaf![i]!]) || (limit !== undefined && !(birth![i]! <= limit));
      if (out && this.base[i] !== 0) this.shown[i] = mixed(this.base[i]!, fade, 51);
    }
  }

  /// Colours the basins of the bars in view, each up to the value at which it meets a part that the
  /// cut keeps separate.
  private tintBasins(): void {
    const { session } = this;
    const { elements, tree, voxels } = session.report;
    const { leaf, birth, count } = elements!;
    if (!tree || !leaf) return;
    const { segment } = session.focus;
    const ofSegment = segment > 0 ? [session.barOfSegment(segment)] : undefined;
    const bars = (ofSegment ?? barsInView(session)).filter((bar) => !voxels?.ofBar.has(bar));
    const colours = new Uint32Array(tree.leaves),
      limits = new Float64Array(tree.leaves);
    let any = false;
    for (const bar of bars) {
      const branch = tree.branchOf(bar);
      const leaves: number[] = [];
      if (branch === undefined) continue;
      const limit = tree.markBasin(branch, session.cutValue, (b) => leaves.push(b));
      if (limit === Infinity) continue; // the only basin is the whole picture
      any = true;
      for (const b of leaves) {
        colours[b] = packed(session.segmentColours[session.cut!.labelOfLeaf[b]! - 1] ?? [0, 0, 0]);
        limits[b] = limit;
      }
    }
    if (!any) return;
    for (let i = 0; i < count; ++i)
      if (birth![i]! < limits[leaf[i]!]!)
        this.shown[i] = mixed(colours[leaf[i]!]!, this.base[i]!, 144);
  }

  /// Colours the sets of voxels of the bars in view; less persistent bars are drawn over the
  /// others.
  private tintSets(): void {
    const { session } = this;
    const { voxels, bars } = session.report;
    if (!voxels) return;
    for (const bar of barsInView(session)) {
      const runs = runsOf(voxels, bar);
      const colour = packed(fromHex(dimColour(bars.dim[bar]!, session.theme)));
      for (let k = 0; k + 1 < runs.length; k += 2)
        for (let i = runs[k]!, end = i + runs[k + 1]!; i < end; ++i)
          this.shown[i] = mixed(colour, this.base[i]!, 176);
    }
  }

  private paintBase(mode: ColourMode): boolean {
    const { session, base } = this;
    const key = [
      mode,
      session.theme.dark,
      mode === "segment" || mode === "persistence" ? session.cutValue : 0,
    ].join();
    if (key === this.baseKey) return false;
    this.baseKey = key;
    const colourAt = this.colours(mode);
    for (let i = 0; i < base.length; ++i) base[i] = colourAt(i);
    return true;
  }

  private colours(mode: ColourMode): (i: number) => number {
    const { session } = this;
    const { rgb, normals, leaf, birth } = session.report.elements!;
    const none = packed(session.theme.dark ? [84, 92, 103] : [150, 156, 165]);
    switch (mode) {
      case "segment": {
        const ofLeaf = this.segmentColours(none),
          ofSurface = this.surfaceColours(none),
          { surface } = session.report.elements!,
          grey = this.grey();
        const colourOf = (i: number) => ofLeaf[leaf![i]!] ?? ofSurface[surface?.[i] ?? 0] ?? none;
        if (!grey) return colourOf;
        const isThere = session.report.image
          ? (i: number) => Number.isFinite(session.report.image!.values[i]!)
          : () => true;
        return (i) =>
          isThere(i) ? mixed(colourOf(i), grey[i]! * 0x010101, 192) : 0;
      }
      case "persistence": {
        const ofLeaf = this.persistenceColours();
        const there = session.report.image?.values;
        return (i) => (there && !Number.isFinite(there[i]!) ? 0 : (ofLeaf[leaf![i]!] ?? none));
      }
      case "rgb":
        return (i) => packed([rgb![3 * i]!, rgb![3 * i + 1]!, rgb![3 * i + 2]!]);
      case "truth":
        return this.truthColours(none);
      case "normal":
        return (i) => colourOfNormal(normals![2 * i]!, normals![2 * i + 1]!) ?? none;
      case "plain": {
        // Light colours suit a surface, which is shaded; dots need contrast.
        const light = session.theme.dark || (this.rgba.length > 12000 && session.report.cloud?.dims === 3);
        const colour = packed(light ? [178, 187, 198] : [92, 102, 115]);
        return () => colour;
      }
      default: {
        const values = session.report.image?.values ?? birth!;
        const value =
          mode === "depth"
            ? this.depths(session.report.cloud!.positions)
            : (i: number) => values[i]!;
        const { low, high } = this.range(mode)!,
          span = high - low || 1,
          map = mode === "grey" ? greyOf : ramp;
        // Absent voxels must not have the colour of a value.
        const absent = session.report.image ? 0 : none;
        return (i) => (Number.isFinite(value(i)) ? packed(map((value(i) - low) / span)) : absent);
      }
    }
  }

  private shades: Uint8Array | undefined;
  /// The brightness that the camera or the image shows, a quarter of which is added to the colours
  /// so that a segment does not look flat; undefined if there is neither.
  private grey(): Uint8Array | undefined {
    const { elements, image } = this.session.report;
    const { rgb, count } = elements!;
    if (this.shades || !(rgb || image)) return this.shades;
    this.shades = new Uint8Array(count);
    const { low, high } = rgb ? { low: 0, high: 0 } : this.range("birth")!;
    for (let i = 0; i < count; ++i)
      this.shades[i] = rgb
        ? 0.299 * rgb[3 * i]! + 0.587 * rgb[3 * i + 1]! + 0.114 * rgb[3 * i + 2]!
        : 255 * Math.min(1, Math.max(0, (image!.values[i]! - low) / (high - low || 1)));
    return this.shades;
  }
  private segmentColours(none: number): Uint32Array {
    const { cut, segmentColours } = this.session;
    const ofLabel = [none, ...segmentColours.map(packed)],
      ofSurface = this.surfaceColours(none);
    const ofLeaf = new Uint32Array(cut!.labelOfLeaf.length);
    for (let leaf = 0; leaf < ofLeaf.length; ++leaf) {
      const label = cut!.labelOfLeaf[leaf]!;
      ofLeaf[leaf] = label > 0 ? ofLabel[label]! : (ofSurface[cut!.surfaceOfLeaf[leaf]!] ?? none);
    }
    return ofLeaf;
  }
  /// The colours of the surfaces by number; number 0 stands for elements on no surface.
  private surfaceColours(none: number): number[] {
    const surfaces = this.session.report.meta.scene?.surfaces ?? [];
    return [none, ...surfaces.map(({ role }) => packed(fromHex(kSurfaces[role] ?? kSurfaces.support)))];
  }
  private persistenceColours(): Uint32Array {
    const {
      report: { tree },
      cutValue,
    } = this.session;
    const { low, high } = this.range("persistence")!,
      span = high - low || 1;
    return tree!
      .branchesAt(cutValue)
      .map((branch) => packed(ramp((tree!.level(branch) - low) / span)));
  }
  private truthColours(none: number): (i: number) => number {
    const { truth } = this.session.report.elements!;
    const colours = new Map<number, number>([[0, none]]);
    for (const label of new Set(truth!))
      if (label > 0) colours.set(label, packed(segmentColour((label - 1) % 28)));
    return (i) => colours.get(truth![i]!)!;
  }
  private depths(positions: Float32Array): (i: number) => number {
    const { meta, cloud } = this.session.report;
    const eye = meta.cloud?.viewpoint,
      origin = cloud!.origin;
    if (!eye) return (i) => positions[3 * i + 2]! + origin[2]!;
    const [x, y, z] = eye.map((c, k) => c - origin[k]!) as Rgb;
    return (i) =>
      Math.hypot(positions[3 * i]! - x, positions[3 * i + 1]! - y, positions[3 * i + 2]! - z);
  }
  private measure(mode: ColourMode): Range {
    const { elements, cloud, tree } = this.session.report;
    if (mode === "persistence") {
      const levels = tree!.arrays.levels.filter((v) => Number.isFinite(v));
      return rangeOf(levels.length, (i) => levels[i]!, 0);
    }
    if (mode === "depth") return rangeOf(elements!.count, this.depths(cloud!.positions));
    const values = this.session.report.image?.values ?? elements!.birth!;
    // Bytes are used directly as grey values.
    if (mode === "grey" && values instanceof Uint8Array) return { low: 0, high: 255 };
    const whole = rangeOf(elements!.count, (i) => values[i]!);
    return mode === "grey" ? withoutOutermost(values, whole) : whole;
  }
}

/// The share of the values at each end that count as outliers; without this limit, outliers would
/// use up most of the greys.
export const kOutermost = 0.005;

function withoutOutermost(values: Numbers, whole: Range): Range {
  const step = Math.max(1, Math.floor(values.length / 50_000));
  const sample: number[] = [];
  for (let i = 0; i < values.length; i += step)
    if (Number.isFinite(values[i]!)) sample.push(values[i]!);
  const sorted = Float64Array.from(sample).sort();
  const cut = Math.floor(kOutermost * sorted.length);
  if (cut === 0) return whole;
  const low = sorted[cut]!,
    high = sorted[sorted.length - 1 - cut]!;
  const few = high > low && high / 2 - low / 2 < (whole.high / 2 - whole.low / 2) / 2;
  return few ? { low, high, clipped: true } : whole;
}

function rangeOf(count: number, value: (i: number) => number, least = Infinity): Range {
  let low = least,
    high = -Infinity;
  for (let i = 0; i < count; ++i) {
    const v = value(i);
    if (!Number.isFinite(v)) continue;
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return high < low ? { low: 0, high: 1 } : { low, high };
}

/// Decodes the two numbers of an octahedral normal, -127 … 127; -128: no normal.
function normalOf(u: number, v: number): [number, number, number] | undefined {
  if (u === -128) return undefined;
  let x = u / 127,
    y = v / 127;
  const z = 1 - Math.abs(x) - Math.abs(y);
  if (z < 0) [x, y] = [(1 - Math.abs(y)) * (x < 0 ? -1 : 1), (1 - Math.abs(x)) * (y < 0 ? -1 : 1)];
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

function colourOfNormal(u: number, v: number): number | undefined {
  const n = normalOf(u, v);
  return n && packed(n.map((c) => Math.round(127.5 * (c + 1))) as Rgb);
}
