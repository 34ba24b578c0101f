// SPDX-License-Identifier: MIT
// The pairs of bars of two barcodes, such that no end of a bar moves farther than the bottleneck
// distance. Bars without a pair move to the diagonal.
import type { Bars } from "./bars";
import type { Numbers } from "./payload";

export class Matching {
  private readonly partners = new Map<number, number>();

  /// @param pairs numbers of bars, alternating between the first and the second barcode.
  constructor(pairs: Numbers) {
    for (let i = 0; i + 1 < pairs.length; i += 2) {
      this.partners.set(pairs[i]!, pairs[i + 1]!);
      this.partners.set(pairs[i + 1]!, pairs[i]!);
    }
  }
  /// The bar with which a bar is paired; undefined if the bar goes to the diagonal.
  partnerOf(bar: number): number | undefined {
    return this.partners.get(bar);
  }
  /// The distance that a bar moves: the larger of the distances of its two ends.
  static move(bars: Bars, bar: number, partner: number | undefined): number {
    if (partner === undefined) return bars.persistence(bar) / 2;
    const apart = (a: number, b: number) => (a === b ? 0 : Math.abs(a - b));
    return Math.max(
      apart(bars.birth[bar]!, bars.birth[partner]!),
      apart(bars.death[bar]!, bars.death[partner]!),
    );
  }
  /// The bar of a dimension that moves farthest, with its partner.
  widest(bars: Bars, dim: number): number[] {
    let found: number[] = [],
      most = 0;
    for (const barcode of [0, 1])
      for (const bar of bars.of(dim, barcode)) {
        const partner = this.partnerOf(bar);
        const move = Matching.move(bars, bar, partner);
        if (move > most) [found, most] = [partner === undefined ? [bar] : [bar, partner], move];
      }
    return found;
  }
}
