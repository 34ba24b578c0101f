// SPDX-License-Identifier: MIT
// Draws a bar of the barcode: a line, an arrow if it never ends, and its number at its end.
import type { Pen } from "./pen";

export interface Item {
  bar: number;
  x1: number;
  x2: number;
  y: number; // upper end of its row
  row: number; // height
  endless: boolean; // an arrow follows
}

export const kNumber = 9.5, // text size
  kRowOfFew = 9;
const kThinRow = 5;

export function thicknessOf(row: number): number {
  return row > kThinRow ? 0.62 * row : row > 3.2 ? row - 1.2 : row - 0.6;
}
function arrowOf({ row }: Item): number {
  return Math.min(5, Math.max(2.5, row / 2));
}
/// The distance that a bar extends beyond its end: the length of an arrow if the bar never ends,
/// otherwise 0.
export function reachOf(item: Item): number {
  return item.endless ? 1.6 * arrowOf(item) : 0;
}

/// Draws one bar. @param edge widens the bar and its arrow on all sides.
export function drawLine(pen: Pen, item: Item, thick: number, colour: string, edge = 0): void {
  const { x1, x2, y, row } = item;
  const middle = y + row / 2;
  const width = Math.max(1, x2 - x1) + (item.endless ? edge : 2 * edge);
  pen.rect(x1 - edge, middle - thick / 2, width, thick, colour);
  if (!item.endless) return;
  const r = arrowOf(item);
  const corners = [x2, middle - r, x2 + 1.6 * r, middle, x2, middle + r];
  pen.polygon(corners, colour, 1, edge > 0 ? colour : "none", 2 * edge);
}

/// Draws a bar with an outline, both within its row, so that it covers no other bar.
export function drawChosen(pen: Pen, item: Item, colour: string, outline: string): void {
  const edge = item.row > kRowOfFew ? 1.5 : 1;
  const thick = Math.max(1, Math.min(0.75 * item.row, item.row - 2 * edge));
  drawLine(pen, item, thick + 2 * edge, outline, edge);
  drawLine(pen, item, thick, colour);
}

/// Groups of bars whose numbers would overlap.
export function closeTogether(items: Item[]): Item[][] {
  const groups: Item[][] = [];
  for (const item of items) {
    const first = groups.at(-1)?.[0];
    if (first && item.y - first.y < kNumber) groups.at(-1)!.push(item);
    else groups.push([item]);
  }
  return groups;
}

/// "2, 3, 4" or, with less room, "2, 3, …". @param room the number of letters that fit.
export function asManyAsFit(numbers: number[], room: number): string {
  for (let count = numbers.length; count > 0; --count) {
    const text = [...numbers.slice(0, count), ...(count < numbers.length ? ["…"] : [])].join(", ");
    if (text.length <= room || count === 1) return text;
  }
  return "";
}
