// SPDX-License-Identifier: MIT
// The metadata of a report, as in docs/reference/report-format.md.
import type { CutRule } from "./merge_tree";

export type CellKind = "vertices" | "grid" | "row";

export interface BarcodeMeta {
  name: string;
  cells?: CellKind;
  representatives?: "cycles" | "cocycles" | "voxels";
}

export interface Provenance {
  version?: string;
  command?: string[];
  input?: { path?: string; description?: string; sha256?: string };
  complex?: string;
  field?: number;
  max_dim?: number;
  threshold?: number | null;
  filtration?: Record<string, unknown>; // further facts, as in the JSON of the bars
  engine?: string;
  timings?: Record<string, number>;
  peak_memory?: number | null;
  warnings?: string[];
  notes?: Record<string, string>;
}

export type SurfaceRole = "support" | "floor" | "shelf" | "wall" | "ceiling";

/// A segment of the program's own answer; its index in the list is its label minus one.
export interface SegmentMeta {
  number: number; // the number that names the segment in the files of the program
  colour: string; // "#rrggbb"
  persistence: number | null; // null: infinite
  // "support": a leg of a table. The roles of surfaces are also known from earlier frames.
  role: "object" | "container" | SurfaceRole;
  on_surface?: number;
  on_segment?: number; // the number of the segment that it stands on
}

/// The properties of a segmentation in addition to its labels.
export interface SceneMeta {
  segments: SegmentMeta[];
  surfaces: { role: SurfaceRole }[]; // by number, from 1
  removed: number; // how many of these surfaces have no leaf
  flat: number; // least share of a surface's vertices on its plane
  objects: boolean; // true if the answer joins the parts of an object
}

export interface Meta {
  format: "ph-report";
  version: 1;
  title: string;
  program: string;
  provenance: Provenance;
  value: { label: string; unit?: string; negated?: boolean };
  barcodes: BarcodeMeta[];
  cloud?: {
    unit?: string;
    up?: number[];
    viewpoint?: number[];
    projection?: string;
    metric?: string;
    edges_below?: number;
    triangles_below?: number;
  };
  image?: { construction?: "vertices" | "cells"; axes?: string[] };
  tree?: {
    rule: CutRule;
    label?: string;
    unit?: string;
    cut: number;
    from?: number;
    to?: number;
    min_size?: number;
    what?: string;
    command?: string[];
  };
  scene?: SceneMeta;
  distances?: { dim: number; bottleneck: number | null }[]; // null: infinite
}
