// SPDX-License-Identifier: MIT
// The bars of one or two barcodes as columns of numbers. Bar i of the second barcode has number
// `first[1] + i`, so that one number names any bar.
import type { BarcodeMeta } from "./meta";
import { PayloadError, type Numbers } from "./payload";

interface Columns {
  dim: Numbers;
  birth: Numbers;
  death: Numbers;
  birthCells: Numbers | undefined;
  deathCells: Numbers | undefined;
}

export class Bars {
  readonly size: number;
  readonly first: number[] = [0];
  readonly dim: Uint8Array;
  readonly birth: Float64Array;
  readonly death: Float64Array;
  readonly dims: number[]; // dimensions that occur, ascending
  /// All bars, the most persistent first (infinite ones before all others); equal bars keep their
  /// order.
  readonly byPersistence: Uint32Array;
  readonly low: number; // least and largest finite value; 0 and 1 if there is none
  readonly high: number;
  private readonly groups: Map<number, Uint32Array>[];
  private readonly cellStart: (Float64Array | undefined)[][] = [];

  constructor(
    private readonly columns: Columns[],
    private readonly meta: BarcodeMeta[],
    private readonly axes: number,
  ) {
    for (const c of columns) {
      if (c.birth.length !== c.dim.length || c.death.length !== c.dim.length)
        throw new PayloadError("bars: columns of different lengths");
      this.first.push(this.first.at(-1)! + c.dim.length);
    }
    this.size = this.first.at(-1)!;
    this.dim = new Uint8Array(this.size);
    this.birth = new Float64Array(this.size);
    this.death = new Float64Array(this.size);
    columns.forEach((c, i) => {
      this.dim.set(c.dim, this.first[i]);
      this.birth.set(c.birth, this.first[i]);
      this.death.set(c.death, this.first[i]);
    });
    this.dims = [...new Set(this.dim)].sort((a, b) => a - b);
    [this.low, this.high] = this.finiteRange();
    this.byPersistence = this.sorted();
    this.groups = columns.map((_, i) => this.grouped(i));
    columns.forEach((c, i) => {
      this.cellStart.push([c.birthCells && this.starts(i, 0), c.deathCells && this.starts(i, 1)]);
    });
  }

  persistence(bar: number): number {
    const birth = this.birth[bar]!,
      death = this.death[bar]!;
    return birth === death ? 0 : death - birth;
  }
  isInfinite(bar: number): boolean {
    return this.death[bar] === Infinity;
  }
  /// The barcode of a bar, 0 or 1.
  barcodeOf(bar: number): number {
    return bar < this.first[1]! ? 0 : 1;
  }
  count(dim: number, barcode: number): number {
    return this.of(dim, barcode).length;
  }
  /// The bars of one dimension of one barcode, the most persistent first.
  of(dim: number, barcode: number): Uint32Array {
    return this.groups[barcode]?.get(dim) ?? new Uint32Array();
  }
  /// The first `most` of bars that are sorted by persistence. Infinite bars get more than half of
  /// these places only if there are too few finite bars to fill the rest.
  prominent(sorted: Uint32Array, most: number): Uint32Array {
    let infinite = 0;
    while (infinite < sorted.length && this.isInfinite(sorted[infinite]!)) ++infinite;
    const kept = Math.min(infinite, Math.max(most >> 1, most - (sorted.length - infinite)));
    const result = new Uint32Array(Math.min(sorted.length, most));
    result.set(sorted.subarray(0, kept));
    result.set(sorted.subarray(infinite, infinite + result.length - kept), kept);
    return result;
  }
  /// The number of integers that name a cell, which has the dimension of a bar (`above` 0) or the
  /// next dimension (`above` 1).
  arity(bar: number, above: 0 | 1): number {
    const kind = this.meta[this.barcodeOf(bar)]?.cells ?? "vertices";
    if (kind === "row") return 1;
    return kind === "grid" ? this.axes : this.dim[bar]! + 1 + above;
  }
  /// The birth cell (0) or death cell (1) of a bar; empty if unknown.
  cell(bar: number, which: 0 | 1): number[] {
    const barcode = this.barcodeOf(bar);
    const starts = this.cellStart[barcode]?.[which];
    const column = this.columns[barcode]!;
    const cells = which === 0 ? column.birthCells : column.deathCells;
    if (!starts || !cells) return [];
    const i = bar - this.first[barcode]!;
    return Array.from(cells.subarray(starts[i]!, starts[i + 1]!));
  }

  private starts(barcode: number, which: 0 | 1): Float64Array {
    const from = this.first[barcode]!,
      to = this.first[barcode + 1]!;
    const starts = new Float64Array(to - from + 1);
    for (let i = from; i < to; ++i) {
      const length = which === 1 && this.isInfinite(i) ? 0 : this.arity(i, which);
      starts[i - from + 1] = starts[i - from]! + length;
    }
    return starts;
  }
  private finiteRange(): [number, number] {
    let low = Infinity,
      high = -Infinity;
    for (const values of [this.birth, this.death]) {
      for (const v of values) {
        if (!Number.isFinite(v)) continue;
        if (v < low) low = v;
        if (v > high) high = v;
      }
    }
    return low > high ? [0, 1] : [low, high];
  }
  private grouped(barcode: number): Map<number, Uint32Array> {
    const counts = new Uint32Array(256);
    for (const dim of this.columns[barcode]!.dim) ++counts[dim]!;
    const groups = new Map(this.dims.map((dim) => [dim, new Uint32Array(counts[dim]!)]));
    const filled = new Uint32Array(256);
    for (const bar of this.byPersistence) {
      if (this.barcodeOf(bar) !== barcode) continue;
      const dim = this.dim[bar]!;
      groups.get(dim)![filled[dim]!++] = bar;
    }
    return groups;
  }
  private sorted(): Uint32Array {
    const length = new Float64Array(this.size);
    for (let i = 0; i < this.size; ++i) length[i] = this.persistence(i);
    return decreasing(length);
  }
}

/// The indices of numbers >= 0, the largest first; equal numbers keep their order. A comparison
/// sort of a million bars would take too long: two radix passes of 16 bits over float32 come first,
/// then a sort of the values that these passes cannot distinguish.
function decreasing(values: Float64Array): Uint32Array {
  const n = values.length,
    bits = new Uint32Array(Float32Array.from(values).buffer);
  let order = new Uint32Array(n),
    next = new Uint32Array(n);
  for (let i = 0; i < n; ++i) order[i] = i;
  for (const shift of [0, 16]) {
    const start = new Uint32Array(65537);
    for (let i = 0; i < n; ++i) ++start[65536 - ((bits[i]! >>> shift) & 65535)]!;
    for (let k = 1; k <= 65536; ++k) start[k]! += start[k - 1]!;
    for (const i of order) next[start[65535 - ((bits[i]! >>> shift) & 65535)]!++] = i;
    [order, next] = [next, order];
  }
  for (let from = 0, to = 1; from < n; from = to++) {
    while (to < n && bits[order[to]!] === bits[order[from]!]) ++to;
    if (to - from > 1) sortRun(order, from, to, values);
  }
  return order;
}

/// Sorts indices of equal floats by their doubles. Most runs are pairs, so short runs are sorted by
/// insertion.
function sortRun(order: Uint32Array, from: number, to: number, values: Float64Array): void {
  if (to - from > 16) {
    // Compares instead of subtracting, because Infinity - Infinity is NaN.
    order
      .subarray(from, to)
      .sort((a, b) => (values[a]! > values[b]! ? -1 : values[a]! < values[b]! ? 1 : a - b));
    return;
  }
  for (let i = from + 1; i < to; ++i) {
    const bar = order[i]!;
    let j = i;
    for (; j > from && values[order[j - 1]!]! < values[bar]!; --j) order[j] = order[j - 1]!;
    order[j] = bar;
  }
}
