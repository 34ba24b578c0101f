// SPDX-License-Identifier: MIT
// From where the data are seen first: from where the sensor stood, if that is known.
import { Vector3 } from "three";
import { placeInImage } from "./cell_geometry";
import type { Report } from "./report";

type Triple = [number, number, number];

export interface Pose {
  centre: Vector3;
  towards: Vector3; // unit, from the centre to the eye
  up: Vector3;
  flat: boolean; // a plane, seen from above
  /// Half of what is seen: to the side, upwards, towards the eye.
  half: { width: number; height: number; depth: number };
  radius: number;
}

const kSampled = 20000;

export function firstPose(report: Report): Pose {
  const { image, cloud, meta } = report;
  if (image) {
    const [planes, rows, columns] = image.shape as Triple;
    const corners: number[] = [];
    for (const plane of [-0.5, planes - 0.5])
      for (const row of [-0.5, rows - 0.5])
        for (const column of [-0.5, columns - 0.5]) corners.push(...placeInImage(planes === 1 ? 0 : plane, row, column));
    const flat = planes === 1;
    return poseOf(corners, flat ? new Vector3(0, 0, 1) : new Vector3(0.75, 0.55, 1), new Vector3(0, 1, 0), flat);
  }
  const sample = sampled(cloud!.positions);
  if (cloud!.dims < 3) return poseOf(sample, new Vector3(0, 0, 1), new Vector3(0, 1, 0), true);
  const eye = meta.cloud?.viewpoint;
  const up = new Vector3(...((meta.cloud?.up ?? (eye ? [0, -1, 0] : [0, 0, 1])) as Triple)).normalize();
  if (!eye) return poseOf(sample, new Vector3(0.55, -0.9, 0.6), up, false);
  const { centre } = poseOf(sample, new Vector3(0, -1, 0), up, false);
  const towards = new Vector3(...(eye.map((c, k) => c - cloud!.origin[k]!) as Triple)).sub(centre);
  if (towards.lengthSq() === 0) towards.set(0, -1, 0);
  return poseOf(sample, towards, up, false);
}

function sampled(positions: Float32Array): number[] {
  const step = Math.max(1, Math.floor(positions.length / 3 / kSampled));
  const sample: number[] = [];
  for (let i = 0; i < positions.length; i += 3 * step) sample.push(positions[i]!, positions[i + 1]!, positions[i + 2]!);
  return sample;
}

/// The box along the axes of the picture of all but a few outermost points: a speck far away must
/// not make the rest small.
function poseOf(coordinates: number[], towards: Vector3, up: Vector3, flat: boolean): Pose {
  const forward = towards.clone().normalize();
  const right = new Vector3().crossVectors(up, forward);
  if (right.lengthSq() < 1e-6) right.set(1, 0, 0);
  right.normalize();
  const above = new Vector3().crossVectors(forward, right);
  const centre = new Vector3(), half: number[] = [];
  for (const axis of [right, above, forward]) {
    const along: number[] = [];
    for (let i = 0; i < coordinates.length; i += 3)
      along.push(axis.x * coordinates[i]! + axis.y * coordinates[i + 1]! + axis.z * coordinates[i + 2]!);
    along.sort((a, b) => a - b);
    const cut = Math.floor(along.length / 200);
    const low = along[cut]!, high = along[along.length - 1 - cut]!;
    centre.addScaledVector(axis, (low + high) / 2);
    half.push((high - low) / 2);
  }
  const radius = Math.hypot(...half) || 1;
  const [width, height, depth] = half.map((h) => Math.max(h, 0.05 * radius)) as Triple;
  return { centre, towards: forward, up, flat, half: { width, height, depth }, radius };
}
