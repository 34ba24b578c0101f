// SPDX-License-Identifier: MIT

/// Records the places of numbers: a number that would overlap another is left out.
export class LabelPlaces {
  private readonly taken: [x: number, y: number, halfWidth: number][] = [];

  /// @param size the size of the text, pixels.
  constructor(private readonly size = 9.5) {}

  /// True if there is room for a text centred here; reserves the room.
  take(x: number, y: number, text: string): boolean {
    const half = 0.284 * this.size * text.length + 1.2,
      high = 0.95 * this.size;
    if (this.taken.some(([a, b, w]) => Math.abs(a - x) < w + half && Math.abs(b - y) < high))
      return false;
    this.taken.push([x, y, half]);
    return true;
  }
}
