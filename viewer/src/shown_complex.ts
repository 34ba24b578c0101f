// SPDX-License-Identifier: MIT
// The complex up to a filtration value: the edges that the program wrote, or, of a Vietoris-Rips
// complex of points that are all here, the pairs within that distance; and its triangles.
import { elementOf } from "./cell_geometry";
import { shortestPairs, trianglesOf, type SortedPairs } from "./pairs_within";
import type { Numbers } from "./payload";
import type { Report } from "./report";

const kMostEdges = 40_000,
  kMostTriangles = 40_000,
  kMostPoints = 50_000;

export interface ShownPart {
  ends: Float32Array; // x, y, z of each end of an edge
  corners: Float32Array; // x, y, z of each corner of a triangle
  edges: number;
  triangles: number | undefined; // undefined: too many to draw
  more: boolean; // there are more edges than the budget has
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
    const triangles = this.trianglesUpTo(value, shown);
    return {
      ends: this.places(shown),
      corners: this.places(triangles ?? []),
      edges: shown.length / 2,
      triangles: triangles && triangles.length / 3,
      more: missingFrom < Infinity && value >= missingFrom,
    };
  }

  /// The triangles of a mesh, three places each, ascending by value; undefined: it is none.
  get surface(): Uint32Array | undefined {
    const { triangles } = this.report;
    return triangles && this.available ? this.elementsOf(triangles.corners, 3) : undefined;
  }

  /// Those that the program wrote, or, of a flag complex, those whose edges are there.
  private trianglesUpTo(value: number, edges: Uint32Array): Uint32Array | undefined {
    const { triangles, meta } = this.report;
    if (triangles) {
      const count = countUpTo(triangles.values, value);
      return this.elementsOf(triangles.corners, 3).subarray(0, 3 * count);
    }
    const isFlag = meta.provenance.complex === "rips";
    return isFlag ? trianglesOf(edges, kMostTriangles) : new Uint32Array();
  }
  private nearest(): SortedPairs {
    return shortestPairs(this.report.cloud!.positions, this.report.bars.high, kMostEdges);
  }
  private written(): SortedPairs {
    const { edges, meta } = this.report;
    return {
      ends: this.elementsOf(edges!.ends, 2),
      values: Float64Array.from(edges!.values),
      missingFrom: meta.cloud?.edges_below ?? Infinity,
    };
  }
  private readonly found = new Map<Numbers, Uint32Array>();
  /// Vertices of cells as places in the picture, ascending within a cell.
  private elementsOf(vertices: Numbers, arity: number): Uint32Array {
    let elements = this.found.get(vertices);
    if (elements) return elements;
    elements = Uint32Array.from(vertices, (v) => elementOf(this.report, v) ?? 0);
    for (let i = 0; i < elements.length; i += arity) elements.subarray(i, i + arity).sort();
    this.found.set(vertices, elements);
    return elements;
  }
  private places(elements: ArrayLike<number>): Float32Array {
    const to = new Float32Array(3 * elements.length);
    const { positions } = this.report.cloud!;
    for (let i = 0; i < elements.length; ++i)
      to.set(positions.subarray(3 * elements[i]!, 3 * elements[i]! + 3), 3 * i);
    return to;
  }
}

/// How many of ascending values lie up to another one. Values and positions are float32.
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

/// How many bars of each dimension live at a value.
export function bettiAt(report: Report, value: number): number[] {
  const { bars } = report;
  const betti = new Array<number>((bars.dims.at(-1) ?? -1) + 1).fill(0);
  const end = bars.first[1]!;
  for (let i = 0; i < end; ++i)
    if (bars.birth[i]! <= value && value < bars.death[i]!) ++betti[bars.dim[i]!]!;
  return betti;
}
