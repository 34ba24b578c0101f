// SPDX-License-Identifier: MIT
// Pixels of a PNG as browsers write it: eight bits, with or without alpha, not interlaced.
import assert from "node:assert/strict";
import { inflateSync } from "node:zlib";

/// The pixels of a PNG, four bytes each, with their `width` and `height`.
export function decodedPng(png) {
  const width = png.readUInt32BE(16),
    height = png.readUInt32BE(20),
    [depth, colourType, , , interlace] = png.subarray(24, 29);
  assert.ok(depth === 8 && (colourType === 2 || colourType === 6) && interlace === 0);
  const parts = [];
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at))
    if (png.toString("latin1", at + 4, at + 8) === "IDAT")
      parts.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
  const bytes = inflateSync(Buffer.concat(parts));
  const size = colourType === 6 ? 4 : 3,
    stride = size * width;
  const pixels = new Uint8Array(4 * width * height).fill(255);
  let above = new Uint8Array(stride),
    row = new Uint8Array(stride);
  for (let y = 0, from = 0; y < height; ++y, from += stride) {
    const filter = bytes[from++];
    for (let i = 0; i < stride; ++i) {
      const left = i < size ? 0 : row[i - size],
        up = above[i];
      let guess = 0;
      if (filter === 1) guess = left;
      else if (filter === 2) guess = up;
      else if (filter === 3) guess = (left + up) >> 1;
      else if (filter === 4) guess = paeth(left, up, i < size ? 0 : above[i - size]);
      row[i] = bytes[from + i] + guess;
    }
    for (let x = 0, to = 4 * width * y, i = 0; x < width; ++x, to += 4, i += size)
      for (let k = 0; k < size; ++k) pixels[to + k] = row[i + k];
    [above, row] = [row, above];
  }
  return Object.assign(pixels, { width, height });
}

function paeth(left, up, corner) {
  const a = Math.abs(up - corner),
    b = Math.abs(left - corner),
    c = Math.abs(left + up - 2 * corner);
  return a <= b && a <= c ? left : b <= c ? up : corner;
}

/// The part of a picture that lies in a box, as whole pixels.
export function cropped(picture, { x, y, width, height }) {
  const left = Math.max(0, Math.floor(x)),
    top = Math.max(0, Math.floor(y)),
    right = Math.min(picture.width, Math.ceil(x + width)),
    bottom = Math.min(picture.height, Math.ceil(y + height));
  const columns = right - left,
    pixels = new Uint8Array(4 * columns * (bottom - top));
  for (let row = top; row < bottom; ++row) {
    const from = 4 * (row * picture.width + left);
    pixels.set(picture.subarray(from, from + 4 * columns), 4 * (row - top) * columns);
  }
  return Object.assign(pixels, { width: columns, height: bottom - top });
}
