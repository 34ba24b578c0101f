// SPDX-License-Identifier: MIT
// Formats numbers for readers.

const kSub = "₀₁₂₃₄₅₆₇₈₉",
  kSuper = "⁰¹²³⁴⁵⁶⁷⁸⁹";

function inDigits(number: number, digits: string): string {
  return [...String(Math.abs(number))].map((d) => digits[Number(d)]).join("");
}

/// H₁
export function homology(dim: number): string {
  return "H" + inDigits(dim, kSub);
}

export function superscript(number: number): string {
  return (number < 0 ? "⁻" : "") + inDigits(number, kSuper);
}

/// 12,345
export function grouped(count: number): string {
  return String(count).replace(/\B(?=(\d{3})+$)/g, ",");
}

export function counted(count: number, noun: string): string {
  return `${grouped(count)} ${noun}${count === 1 ? "" : "s"}`;
}

/// `digits` significant digits, or all digits before the point if there are more. With an exponent
/// below 1e-4, and from 1e6 on if more than `digits` digits are before the point. ∞ and −∞ are
/// symbols.
export function short(value: number, digits = 4): string {
  if (value === Infinity) return "∞";
  if (value === -Infinity) return "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value),
    whole = Math.floor(Math.log10(size)) + 1; // digits before the point
  const text =
    size < 1e-4 || (size >= 1e6 && whole > digits)
      ? value
          .toExponential(digits - 1)
          .replace(/\.?0+e/, "e")
          .replace("e+", "e")
      : String(Number(value.toPrecision(Math.max(digits, whole))));
  return text.replace(/-/g, "−");
}

/// The number of significant digits, from 4 to 15, that distinguish values of about this size with
/// this difference.
export function digitsFor(size: number, difference: number): number {
  const digits = Math.ceil(Math.log10(size) - Math.log10(difference)) + 2;
  return Number.isFinite(digits) ? Math.min(15, Math.max(4, digits)) : 4;
}

/// The shortest text that reads back as the same double, as the programs write it.
export function exact(value: number): string {
  if (!Number.isFinite(value)) return value > 0 ? "inf" : "-inf";
  const [digits, power] = value.toExponential().split("e") as [string, string];
  const exponent = Number(power);
  if (value === 0 || (exponent >= -4 && exponent < 16)) {
    const places = digits.replace(/\D/g, "").length - 1 - exponent;
    return places > 0 ? value.toFixed(places) : String(value);
  }
  return `${digits}e${exponent < 0 ? "-" : "+"}${String(Math.abs(exponent)).padStart(2, "0")}`;
}

/// Rounded to a thousandth of a range.
export function inRange(value: number, range: number): string {
  const digits = Math.ceil(Math.log10(Math.max(Math.abs(value), range) / range)) + 3;
  return short(Math.abs(value) < range / 1000 ? 0 : value, Math.min(15, Math.max(1, digits)));
}

export function bytes(count: number): string {
  if (count >= 1 << 30) return `${(count / (1 << 30)).toFixed(2)} GiB`;
  if (count >= 1 << 20) return `${(count / (1 << 20)).toFixed(1)} MiB`;
  return `${Math.ceil(count / 1024)} KiB`;
}

export function seconds(value: number): string {
  return value < 1 ? `${short(1000 * value, 3)} ms` : `${short(value, 3)} s`;
}

/// The beginning and the end of a long text.
export function clipped(text: string, most: number): string {
  const letters = [...text];
  if (letters.length <= most) return text;
  const half = Math.max(1, Math.floor(most / 2) - 1);
  return [...letters.slice(0, half), "…", ...letters.slice(-half)].join("");
}
