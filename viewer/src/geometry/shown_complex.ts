// SPDX-License-Identifier: MIT
// The edges and triangles of the complex up to a filtration value. The edges are the edges that the
// program wrote or, for a Vietoris-Rips complex whose points are all shown, the pairs of points
// within this distance.
import { elementOf } from "./cell_geometry";
import { shortestPairs, trianglesOf, type SortedPairs } from "./near_pairs";
import type { Numbers } from "../model/payload";
import type { Report } from "../model/report";

const kMostEdges = 40_000,
  kMostTriangles = 40_000,
  kMostPoints = 50_000;

export interface ShownPart {
  ends: Uint32Array; // indices of shown points, two per edge
  corners: Uint32Array | undefined; // three per triangle; undefined: too many to draw
  moreEdges: boolean; // true if the complex may have more edges at this value
  moreTriangles: boolean; // true if it may have more triangles
}

export class ShownComplex {
  readonly available: boolean;
  private readonly computed: boolean;
  private pairs: SortedPairs | undefined;

  constructor(private readonly report: Report) {
    const { cloud, meta, edges } = report;
    this.computed =
      !edges &&
      !!cloud &&
      meta.provenance.complex === "rips" &&
      meta.cloud?.metric === "euclidean" &&
      !meta.cloud.projection &&
      cloud.positions.length / 3 <= kMostPoints;
    this.available = !!cloud && (!!edges || this.computed);
  }
  upTo(value: number): ShownPart {
    this.pairs ??= this.computed ? this.nearest() : this.written();
    const { ends, values, missingFrom } = this.pairs;
    const shown = ends.subarray(0, 2 * countUpTo(values, value));
    return {
      ends: shown,
      corners: this.trianglesUpTo(value, shown),
      moreEdges: reaches(value, missingFrom),
      moreTriangles: reaches(value, this.report.meta.cloud?.triangles_below),
    };
  }
  /// The coordinates x, y, z of each of these elements.
  places(elements: Uint32Array): Float32Array {
    const to = new Float32Array(3 * elements.length);
    const { positions } = this.report.cloud!;
    for (let i = 0; i < elements.length; ++i)
      for (let k = 0; k < 3; ++k) to[3 * i + k] = positions[3 * elements[i]! + k]!;
    return to;
  }

  /// The vertices that belong to no triangle of a mesh.
  outside(): Uint32Array {
    const isIn = new Uint8Array(this.report.elements!.count);
    for (const element of this.surface ?? []) isIn[element] = 1;
    let count = 0;
    const found = new Uint32Array(isIn.length);
    for (let i = 0; i < isIn.length; ++i) if (isIn[i] === 0) found[count++] = i;
    return found.subarray(0, count);
  }
  /// The triangles, three indices of shown points each, ascending by value; undefined if there are
  /// none.
  get surface(): Uint32Array | undefined {
    const { triangles } = this.report;
    return triangles && this.available ? this.elementsOf(triangles.corners) : undefined;
  }

  /// The triangles that the program wrote or, for a flag complex, all triangles whose edges are
  /// present.
  private trianglesUpTo(value: number, edges: Uint32Array): Uint32Array | undefined {
    const { triangles, meta } = this.report;
    if (triangles) {
      const count = countUpTo(triangles.values, value);
      return this.elementsOf(triangles.corners).subarray(0, 3 * count);
    }
    const isFlag = meta.provenance.complex === "rips";
    return isFlag ? trianglesOf(edges, kMostTriangles) : new Uint32Array();
  }
  private nearest(): SortedPairs {
    return shortestPairs(this.report.cloud!.positions, this.report.bars.high, kMostEdges);
  }
  private written(): SortedPairs {
    const { edges, meta } = this.report;
    const ends = this.elementsOf(edges!.ends);
    // The order i < j that trianglesOf expects.
    for (let i = 0; i < ends.length; i += 2) ends.subarray(i, i + 2).sort();
    return {
      ends,
      values: Float64Array.from(edges!.values),
      missingFrom: meta.cloud?.edges_below ?? Infinity,
    };
  }
  private readonly found = new Map<Numbers, Uint32Array>();
  /// The indices of the vertices of cells among the shown points.
  private elementsOf(vertices: Numbers): Uint32Array {
    let elements = this.found.get(vertices);
    if (elements) return elements;
    elements = new Uint32Array(vertices.length);
    for (let i = 0; i < elements.length; ++i)
      elements[i] = elementOf(this.report, vertices[i]!) ?? 0;
    this.found.set(vertices, elements);
    return elements;
  }
}

/// True if cells may be missing at `value`: it is not below `missingFrom`, the first value at which
/// cells are missing.
function reaches(value: number, missingFrom = Infinity): boolean {
  return missingFrom < Infinity && value >= missingFrom;
}

/// The number of ascending `values` that are at most `value`, with a tolerance because they are
/// float32.
function countUpTo(values: ArrayLike<number>, value: number): number {
  const limit = value + 1e-6 * Math.abs(value);
  let low = 0,
    high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle]! <= limit) low = middle + 1;
    else high = middle;
  }
  return low;
}

/// The number of bars of each dimension that are alive at a value.
export function bettiAt(report: Report, value: number): number[] {
  const { bars } = report;
  const betti = new Array<number>((bars.dims.at(-1) ?? -1) + 1).fill(0);
  const end = bars.first[1]!;
  for (let i = 0; i < end; ++i)
    if (bars.birth[i]! <= value && value < bars.death[i]!) ++betti[bars.dim[i]!]!;
  return betti;
}
