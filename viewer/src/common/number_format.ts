// SPDX-License-Identifier: MIT
// Numbers as a reader wants them.

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

/// To four significant digits; ∞ and −∞ by their signs.
export function short(value: number, digits = 4): string {
  if (value === Infinity) return "∞";
  if (value === -Infinity) return "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text =
    size >= 1e6 || size < 1e-4
      ? value
          .toExponential(digits - 1)
          .replace(/\.?0+e/, "e")
          .replace("e+", "e")
      : String(Number(value.toPrecision(digits)));
  return text.replace(/-/g, "−");
}

/// The shortest text that reads back to the same double, as the programs write it.
export function exact(value: number): string {
  return value === Infinity ? "inf" : value === -Infinity ? "-inf" : String(value);
}

/// To a thousandth of a range.
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
