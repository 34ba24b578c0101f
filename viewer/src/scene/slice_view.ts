// SPDX-License-Identifier: MIT
// The viewing direction from which a slice across each axis of a volume appears upright.
import { Vector3 } from "three";
import type { Meta } from "../model/meta";

type Triple = [number, number, number];
interface View {
  towards: Triple; // from the slice to the eye
  up: Triple;
}

// In the space of placeInImage: columns go to the right, rows down, planes towards the reader.
const kOfArrays: View[] = [
    { towards: [0, 0, 1], up: [0, 1, 0] }, // columns to the right, rows down
    { towards: [0, -1, 0], up: [0, 0, 1] }, // columns to the right, planes up
    { towards: [-1, 0, 0], up: [0, 0, 1] }, // rows to the right, planes up
  ],
  kOfSpace: View[] = [
    { towards: [0, 0, 1], up: [1, 0, 0] }, // across x: y to the right, z up
    { towards: [0, 1, 0], up: [1, 0, 0] }, // across y: x to the right, z up
    { towards: [1, 0, 0], up: [0, -1, 0] }, // across z: x to the right, y up
  ];

/// Named axes lie in space, with x to the right and z up; otherwise an array is shown as it would
/// be printed.
export function sliceView(meta: Meta, axis: number): { towards: Vector3; up: Vector3 } {
  const view = (meta.image?.axes ? kOfSpace : kOfArrays)[axis]!;
  const towards = new Vector3(...view.towards),
    up = new Vector3(...view.up);
  const right = new Vector3().crossVectors(up, towards);
  // Slightly from the side, to show that it is a volume.
  return { towards: towards.addScaledVector(right, 0.4).addScaledVector(up, 0.3), up };
}
