// SPDX-License-Identifier: MIT
// Synthetic inputs for the programs.
import { random } from "./random.mjs";

/// Points on a sphere and a few far from it, "x,y,z" per line.
export function spherePoints(count = 60) {
  const next = random(4),
    lines = ["x,y,z"];
  for (let i = 0; i < count; ++i) {
    const z = 1 - (2 * i + 1) / count,
      r = Math.sqrt(1 - z * z),
      turn = 2.39996 * i;
    lines.push([r * Math.cos(turn), r * Math.sin(turn), z + 0.02 * next()].join());
  }
  lines.push("3,0,0", "3.2,0,0");
  return lines.join("\n");
}

/// A table top seen from above with two boxes that touch, "x y z" per line, metres.
export function tableScene() {
  const next = random(9),
    lines = [];
  for (let x = -0.3; x < 0.3; x += 0.004)
    for (let y = -0.2; y < 0.2; y += 0.004) {
      const left = x > -0.12 && x < 0 && Math.abs(y) < 0.07,
        right = x >= 0 && x < 0.1 && Math.abs(y) < 0.05;
      const z = 1 - (left ? 0.1 : right ? 0.06 : 0) + 0.0005 * next();
      lines.push([x, y, z].map((v) => v.toFixed(5)).join(" "));
    }
  return lines.join("\n");
}

/// An array of float32 as NPY.
export function npy(shape, values) {
  const words = `{'descr': '<f4', 'fortran_order': False, 'shape': (${shape.join(", ")}), }`;
  const head = Buffer.alloc(128, " ");
  head.write("\x93NUMPY\x01\x00", "latin1");
  head.writeUInt16LE(118, 8);
  head.write(words, 10);
  head.write("\n", 127);
  return Buffer.concat([head, Buffer.from(Float32Array.from(values).buffer)]);
}
