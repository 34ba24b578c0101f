// SPDX-License-Identifier: MIT
// The complex up to a filtration value: the edges that the program wrote, or, of a Vietoris-Rips
// complex of points that are all here, the pairs within that distance; and its triangles.
import { elementOf } from "./cell_geometry";
import { shortestPairs, trianglesOf, type SortedPairs } from "./pairs_within";
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
    const { ends, values, reach } = this.pairs;
    const limit = value * (1 + 1e-6); // positions are float32
    let low = 0,
      high = values.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (values[middle]! <= limit) low = middle + 1;
      else high = middle;
    }
    const shown = ends.subarray(0, 2 * low);
    const triangles = this.isFlag() ? trianglesOf(shown, kMostTriangles) : new Uint32Array();
    return {
      ends: this.places(shown),
      corners: this.places(triangles ?? []),
      edges: low,
      triangles: triangles && triangles.length / 3,
      more: value > reach,
    };
  }

  /// Whether a triangle is there as soon as its edges are.
  private isFlag(): boolean {
    return this.report.meta.provenance.complex === "rips";
  }
  private nearest(): SortedPairs {
    return shortestPairs(this.report.cloud!.positions, this.report.bars.high, kMostEdges);
  }
  private written(): SortedPairs {
    const { ends, values } = this.report.edges!;
    const kept: number[] = [],
      keptValues: number[] = [];
    for (let e = 0; e < values.length; ++e) {
      const pair = [0, 1].map((side) => elementOf(this.report, ends[2 * e + side]!) ?? -1);
      if (Math.min(...pair) < 0) continue;
      kept.push(Math.min(...pair), Math.max(...pair));
      keptValues.push(values[e]!);
    }
    const complete = this.report.meta.cloud?.edges_up_to ?? Infinity;
    return { ends: Uint32Array.from(kept), values: Float64Array.from(keptValues), reach: complete };
  }
  private places(elements: ArrayLike<number>): Float32Array {
    const to = new Float32Array(3 * elements.length);
    const { positions } = this.report.cloud!;
    for (let i = 0; i < elements.length; ++i)
      to.set(positions.subarray(3 * elements[i]!, 3 * elements[i]! + 3), 3 * i);
    return to;
  }
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
