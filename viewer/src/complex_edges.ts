// SPDX-License-Identifier: MIT
// The edges of the complex up to a filtration value: those that the program wrote, or, of a
// Vietoris-Rips complex of points that are all here, the pairs within that distance.
import { elementOf } from "./cell_geometry";
import type { Report } from "./report";

export const kMostEdges = 40_000;
const kMostPoints = 50_000;

export interface Edges {
  ends: Float32Array; // x, y, z of each end
  count: number;
  more: boolean; // there are more than the budget
}

export class ComplexEdges {
  readonly available: boolean;
  private readonly computed: boolean;

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
  upTo(value: number): Edges {
    return this.computed ? this.pairsWithin(value) : this.written(value);
  }

  private written(value: number): Edges {
    const { ends, values } = this.report.edges!;
    let count = 0; // they are sorted
    while (count < values.length && values[count]! <= value) ++count;
    const to = new Float32Array(6 * Math.min(count, kMostEdges));
    const positions = this.report.cloud!.positions;
    for (let e = 0; 6 * e < to.length; ++e)
      for (const side of [0, 1]) {
        const i = elementOf(this.report, ends[2 * e + side]!) ?? 0;
        to.set(positions.subarray(3 * i, 3 * i + 3), 6 * e + 3 * side);
      }
    return { ends: to, count, more: count > kMostEdges };
  }
  /// Neighbours are looked for in cubes of this edge and next to them.
  private pairsWithin(r: number): Edges {
    const p = this.report.cloud!.positions,
      n = p.length / 3;
    const ends: number[] = [];
    let count = 0;
    if (!(r > 0)) return { ends: new Float32Array(), count, more: false };
    const cell = (v: number) => Math.floor(v / r);
    const name = (x: number, y: number, z: number) => `${x},${y},${z}`;
    const cubes = new Map<string, number[]>();
    for (let i = 0; i < n && count <= kMostEdges; ++i) {
      const x = p[3 * i]!,
        y = p[3 * i + 1]!,
        z = p[3 * i + 2]!;
      const [cx, cy, cz] = [cell(x), cell(y), cell(z)];
      for (let a = cx - 1; a <= cx + 1; ++a)
        for (let b = cy - 1; b <= cy + 1; ++b)
          for (let c = cz - 1; c <= cz + 1; ++c)
            for (const j of cubes.get(name(a, b, c)) ?? []) {
              if (Math.hypot(p[3 * j]! - x, p[3 * j + 1]! - y, p[3 * j + 2]! - z) > r) continue;
              if (++count <= kMostEdges)
                ends.push(p[3 * j]!, p[3 * j + 1]!, p[3 * j + 2]!, x, y, z);
            }
      const own = name(cx, cy, cz),
        list = cubes.get(own);
      if (list) list.push(i);
      else cubes.set(own, [i]);
    }
    return { ends: Float32Array.from(ends), count, more: count > kMostEdges };
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
