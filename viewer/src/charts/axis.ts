// SPDX-License-Identifier: MIT
// Maps values to pixels, with ticks at round numbers. Very large and very small values share one
// power of ten, which is shown beside the name of the axis.
import { superscript } from "../common/number_format";
import { textWidth } from "./pen";

export interface Tick {
  at: number; // pixels
  label: string;
}

export const kLabelSize = 10.5,
  kLeastLeft = 50;
const kTitle = 24; // width, including the space beside the labels

/// The distance from the left edge to a vertical axis, which leaves room for its labels and its
/// title.
export function leftOf(ticks: Tick[]): number {
  return Math.ceil(Math.max(kLeastLeft, kTitle + widest(ticks)));
}
/// The width of the widest label.
export function widest(ticks: Tick[]): number {
  return Math.max(...ticks.map(({ label }) => textWidth(label, kLabelSize)));
}

export class Axis {
  private readonly exponent: number = 0;
  private readonly low: number;
  private readonly high: number;

  constructor(
    low: number,
    high: number,
    readonly from: number,
    readonly to: number,
    private readonly negated = false, // the labels show the negated values
  ) {
    const largest = Math.max(Math.abs(low), Math.abs(high));
    if (largest > 0) {
      const power = Math.floor(Math.log10(largest));
      if (power < -3 || power > 4) this.exponent = power;
    }
    this.low = this.inUnits(low);
    this.high = this.inUnits(high);
    const least = 1e-12 * Math.max(Math.abs(this.low), Math.abs(this.high), 1e-300);
    if (!(this.high - this.low > least)) {
      const room = this.low === 0 ? 1 : 0.5 * Math.abs(this.low);
      if (this.low !== 0) this.low -= room;
      this.high += room;
    }
  }

  at(value: number): number {
    const part = (this.inUnits(value) - this.low) / (this.high - this.low);
    return this.from + Math.min(1, Math.max(0, part)) * (this.to - this.from);
  }
  value(at: number): number {
    const part = Math.min(1, Math.max(0, (at - this.from) / (this.to - this.from)));
    const half = Math.trunc(this.exponent / 2);
    return (this.low + part * (this.high - this.low)) * 10 ** half * 10 ** (this.exponent - half);
  }
  /// The common power of ten, such as ×10⁻⁵, or nothing.
  get unit(): string {
    return this.exponent === 0 ? "" : "×10" + superscript(this.exponent);
  }
  ticks(count: number): Tick[] {
    const rough = (this.high - this.low) / Math.max(1, count);
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * ([1, 2, 5].find((factor) => factor * power >= rough * 0.99) ?? 10);
    const decimals = Math.max(0, -Math.floor(Math.log10(step * 1.0001)));
    const ticks: Tick[] = [];
    const first = Math.ceil(this.low / step - 1e-6),
      last = Math.floor(this.high / step + 1e-6);
    for (let i = first; i <= last && ticks.length < 100; ++i) {
      const value = i * step;
      const part = Math.min(1, Math.max(0, (value - this.low) / (this.high - this.low)));
      ticks.push({
        at: this.from + part * (this.to - this.from),
        label: (value === 0 ? 0 : this.negated ? -value : value).toFixed(decimals).replace("-", "−"),
      });
    }
    return ticks;
  }

  private inUnits(value: number): number {
    // Divides by two powers of ten, because a power of ten beyond 10^±308 is not a double, but one
    // with half the exponent is.
    const half = Math.trunc(this.exponent / 2);
    return value / 10 ** half / 10 ** (this.exponent - half);
  }
}
