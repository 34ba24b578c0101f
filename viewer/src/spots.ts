// SPDX-License-Identifier: MIT

/// Where numbers already stand: one that would lie on another is left out.
export class Spots {
  private readonly taken: [x: number, y: number, halfWidth: number][] = [];

  /// Whether a text of 9.5 pixels, centred here, has room; takes it.
  take(x: number, y: number, text: string): boolean {
    const half = 2.7 * text.length + 1.2;
    if (this.taken.some(([a, b, w]) => Math.abs(a - x) < w + half && Math.abs(b - y) < 9)) return false;
    this.taken.push([x, y, half]);
    return true;
  }
}
