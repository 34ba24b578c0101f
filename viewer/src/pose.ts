// SPDX-License-Identifier: MIT
// From where the data are seen first: from where the sensor stood, if that is known.
import { Vector3 } from "three";
import { placeInImage } from "./cell_geometry";
import type { Report } from "./report";
import type { Pose } from "./stage";

const kSampled = 20000;

export function firstPose(report: Report): Pose {
  const { image, cloud, meta } = report;
  if (image) {
    const [planes, rows, columns] = image.shape as [number, number, number];
    const flat = planes === 1;
    return {
      centre: new Vector3(...placeInImage((planes - 1) / 2, (rows - 1) / 2, (columns - 1) / 2)),
      radius: flat ? Math.max(rows, columns) / 2 : Math.hypot(planes, rows, columns) / 2,
      towards: flat ? new Vector3(0, 0, 1) : new Vector3(0.75, 0.55, 1),
      up: new Vector3(0, 1, 0),
      flat,
    };
  }
  const { low, high } = boundsOf(cloud!.positions);
  const centre = low.clone().add(high).multiplyScalar(0.5);
  const radius = high.clone().sub(low).length() / 2 || 1;
  if (cloud!.dims < 3)
    return { centre, radius: 0.75 * radius || 1, towards: new Vector3(0, 0, 1), up: new Vector3(0, 1, 0), flat: true };
  const eye = meta.cloud?.viewpoint;
  const up = new Vector3(...((meta.cloud?.up ?? (eye ? [0, -1, 0] : [0, 0, 1])) as [number, number, number]));
  const towards = eye
    ? new Vector3(...(eye.map((c, k) => c - cloud!.origin[k]!) as [number, number, number])).sub(centre)
    : new Vector3(0.55, -0.9, 0.6);
  if (towards.lengthSq() === 0) towards.set(0, -1, 0);
  return { centre, radius: eye ? 0.72 * radius : 0.85 * radius, towards, up, flat: false };
}

/// The box of all but the outermost hundredth in each axis: a speck far away must not make the
/// rest small.
function boundsOf(positions: Float32Array): { low: Vector3; high: Vector3 } {
  const low = new Vector3(), high = new Vector3();
  const count = positions.length / 3, step = Math.max(1, Math.floor(count / kSampled));
  for (let axis = 0; axis < 3; ++axis) {
    const sample: number[] = [];
    for (let i = 0; i < count; i += step) sample.push(positions[3 * i + axis]!);
    sample.sort((a, b) => a - b);
    const cut = Math.floor(sample.length / 100);
    low.setComponent(axis, sample[cut]!);
    high.setComponent(axis, sample[sample.length - 1 - cut]!);
  }
  return { low, high };
}
