// SPDX-License-Identifier: MIT
// Colours that people with any common kind of colour blindness can distinguish: Masataka Okabe and
// Kei Ito, "Color Universal Design" (2008). Dimensions also have shapes, for print.

export type Rgb = [number, number, number];

const kSegments = [0xe69f00, 0x0072b2, 0x009e73, 0xcc79a7, 0x56b4e9, 0xd55e00, 0xf0e442];
const kDims = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
const kDimsOnDark = ["#4aa8e0", "#f08030", "#25c496", "#dd93bb", "#f0b429", "#8fd0f5"];

export interface Theme {
  dark: boolean;
  ink: string;
  muted: string;
  faint: string; // axes, ticks
  grid: string;
  panel: string;
  shade: string; // area in which no bar can lie
  accent: string;
}

/// The preference of the reader's system.
export function prefersDark(): boolean {
  return matchMedia("(prefers-color-scheme: dark)").matches;
}

export function themeOf(dark: boolean): Theme {
  return dark
    ? {
        dark,
        ink: "#e6e9ee",
        muted: "#9aa3af",
        faint: "#6b7480",
        grid: "#2a3038",
        panel: "#181c22",
        shade: "#20252c",
        accent: "#ffd24a",
      }
    : {
        dark,
        ink: "#1c2128",
        muted: "#5d6673",
        faint: "#8b939e",
        grid: "#e9ecf0",
        panel: "#ffffff",
        shade: "#f4f5f7",
        accent: "#111418",
      };
}

export function dimColour(dim: number, theme: Theme): string {
  const colours = theme.dark ? kDimsOnDark : kDims;
  return colours[dim] ?? theme.muted;
}

export function hex([r, g, b]: Rgb): string {
  return "#" + [r, g, b].map((c) => Math.round(c).toString(16).padStart(2, "0")).join("");
}

export function fromHex(text: string): Rgb {
  return [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16)) as Rgb;
}

/// Colours of the surfaces that bound a scene, by role; no segment has them.
export const kSurfaces = {
  support: "#b9ac93",
  floor: "#a39a8b",
  shelf: "#c7b9a0",
  wall: "#93a4b9",
  ceiling: "#a9b6c6",
} as const;

/// The index of a colour among the seven colours of segments; -1 if it is none of them.
export function numberOfColour([r, g, b]: Rgb): number {
  return kSegments.indexOf((r << 16) | (g << 8) | b);
}

/// The seven colours, then lighter and darker ones, so that there are colours for any number of
/// segments.
export function segmentColour(i: number): Rgb {
  const base = kSegments[i % kSegments.length]!;
  const rgb: Rgb = [base >> 16, (base >> 8) & 255, base & 255];
  const round = Math.floor(i / kSegments.length);
  if (round === 0) return rgb;
  const towards = round % 2 === 1 ? 255 : 0;
  const share = 1 - 0.6 ** Math.ceil(round / 2);
  return rgb.map((c) => Math.round(c + share * (towards - c))) as Rgb;
}

/// A colour number for each segment, such that touching segments differ. Each segment gets its
/// `wish` if possible, so that a segment keeps its colour while the cut changes around it.
export function coloursApart(touching: Iterable<number>[], wish: number[]): number[] {
  const choice: number[] = [];
  const uses = new Array<number>(kSegments.length).fill(0);
  touching.forEach((neighbours, i) => {
    const taken = new Set<number>();
    for (const j of neighbours) if (choice[j] !== undefined) taken.add(choice[j]);
    let best = wish[i]! < 0 || taken.has(wish[i]!) ? -1 : wish[i]!;
    for (let c = 0; best < 0 && c < kSegments.length; ++c) if (!taken.has(c)) best = c;
    if (wish[i]! < 0 && best >= 0)
      for (let c = 0; c < kSegments.length; ++c)
        if (!taken.has(c) && uses[c]! < uses[best]!) best = c;
    for (let c = kSegments.length; best < 0; ++c) if (!taken.has(c)) best = c;
    if (best < uses.length) ++uses[best]!;
    choice.push(best);
  });
  return choice;
}

// Viridis (Stefan van der Walt and Nathaniel Smith, CC0) at nine values.
const kViridis: Rgb[] = [
  [68, 1, 84],
  [71, 44, 122],
  [59, 81, 139],
  [44, 113, 142],
  [33, 144, 141],
  [39, 173, 129],
  [92, 200, 99],
  [170, 220, 50],
  [253, 231, 37],
];

/// @param part from 0 to 1
export function ramp(part: number): Rgb {
  const at = Math.min(1, Math.max(0, part)) * (kViridis.length - 1);
  const i = Math.min(kViridis.length - 2, Math.floor(at));
  const low = kViridis[i]!,
    high = kViridis[i + 1]!;
  return [0, 1, 2].map((k) => Math.round(low[k]! + (at - i) * (high[k]! - low[k]!))) as Rgb;
}

/// @param part from 0 to 1
export function greyOf(part: number): Rgb {
  const level = Math.round(255 * Math.min(1, Math.max(0, part)));
  return [level, level, level];
}
