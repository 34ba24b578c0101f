// SPDX-License-Identifier: MIT
// The initial view of the data: from the position of the sensor, if known.
import { Vector3 } from "three";
import { placeInImage } from "../geometry/cell_geometry";
import { sliceView } from "./slice_view";
import type { Report } from "../model/report";

type Triple = [number, number, number];

export interface Pose {
  centre: Vector3;
  towards: Vector3; // unit, from the centre to the eye
  up: Vector3;
  flat: boolean; // true for a plane, seen from above
  /// Half the visible extent: to the side, upwards, towards the eye.
  half: { width: number; height: number; depth: number };
  radius: number;
  /// Distance of the sensor from the centre; undefined if there is no sensor.
  distance: number | undefined;
}

const kSampled = 20000;

/// @param axis the axis of a volume that the slice is perpendicular to.
export function firstPose(report: Report, axis = 0): Pose {
  const { image, cloud, meta } = report;
  if (image) {
    const [planes, rows, columns] = image.shape as Triple;
    const corners: number[] = [];
    for (const plane of [-0.5, planes - 0.5])
      for (const row of [-0.5, rows - 0.5])
        for (const column of [-0.5, columns - 0.5])
          corners.push(...placeInImage(planes === 1 ? 0 : plane, row, column));
    if (planes === 1) return poseOf(corners, new Vector3(0, 0, 1), new Vector3(0, 1, 0), true);
    const { towards, up } = sliceView(meta, axis);
    return poseOf(corners, towards, up, false);
  }
  const sample = sampled(cloud!.positions);
  if (cloud!.dims < 3) return poseOf(sample, new Vector3(0, 0, 1), new Vector3(0, 1, 0), true);
  const eye = meta.cloud?.viewpoint;
  const known = meta.cloud?.up ?? (eye && [0, -1, 0]);
  const up = known ? new Vector3(...(known as Triple)).normalize() : standing(sample, report.isMesh);
  const around = poseOf(sample, broadside(sample, up), up, false);
  if (!eye) return around;
  const sensor = new Vector3(...(eye.map((c, k) => c - cloud!.origin[k]!) as Triple));
  const distance = sensor.distanceTo(around.centre);
  return distance > 0.3 * around.radius ? poseOfSensor(sample, sensor, around) : around;
}

const kBase = 0.01, // share of an extent
  kLeastOnBase = 0.02, // share of the points
  kMoreThanElsewhere = 4,
  kFlat = 1 / 3; // share of both other extents

/// The upward direction if the data do not state it: away from a flat base, which has many points
/// near one end of one axis only. Without a base, the direction is z for points and for a relief,
/// which is a mesh that is flat along z. For other meshes, it is y, as in OBJ, glTF and most scans
/// distributed as OFF or PLY.
function standing(sample: number[], isMesh: boolean): Vector3 {
  const count = sample.length / 3;
  const extents: number[] = [];
  const shares: { axis: number; sign: number; share: number }[] = [];
  for (let axis = 0; axis < 3; ++axis) {
    let low = Infinity,
      high = -Infinity;
    for (let i = axis; i < sample.length; i += 3) {
      low = Math.min(low, sample[i]!);
      high = Math.max(high, sample[i]!);
    }
    const near = kBase * (high - low);
    extents.push(high - low);
    let below = 0,
      above = 0;
    for (let i = axis; i < sample.length; i += 3) {
      if (sample[i]! <= low + near) ++below;
      if (sample[i]! >= high - near) ++above;
    }
    shares.push({ axis, sign: 1, share: below / count }, { axis, sign: -1, share: above / count });
  }
  shares.sort((a, b) => b.share - a.share);
  const [base, next] = shares as [(typeof shares)[0], (typeof shares)[0]];
  const isRelief = extents[2]! < kFlat * Math.min(extents[0]!, extents[1]!);
  const up = isMesh && !isRelief ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1);
  if (base.share >= kLeastOnBase && base.share >= kMoreThanElsewhere * next.share)
    up.set(0, 0, 0).setComponent(base.axis, base.sign);
  return up;
}

/// The direction to an eye that sees the largest horizontal spread from the side and slightly from
/// above; for flat data, more from above.
function broadside(sample: number[], up: Vector3): Vector3 {
  const parts = up.toArray().map(Math.abs);
  const first = new Vector3().setComponent(parts.indexOf(Math.min(...parts)), 1);
  const a = first.addScaledVector(up, -first.dot(up)).normalize(),
    b = new Vector3().crossVectors(up, a);
  const at = new Vector3(),
    mean = [0, 0],
    count = sample.length / 3;
  const flat = (i: number) => [at.fromArray(sample, i).dot(a), at.dot(b)] as [number, number];
  for (let i = 0; i < sample.length; i += 3)
    flat(i).forEach((c, k) => (mean[k] = mean[k]! + c / count));
  let aa = 0,
    ab = 0,
    bb = 0;
  for (let i = 0; i < sample.length; i += 3) {
    const [u, v] = flat(i),
      x = u - mean[0]!,
      y = v - mean[1]!;
    aa += x * x;
    ab += x * y;
    bb += y * y;
  }
  const height = extentAlong(sample, up),
    width = Math.max(extentAlong(sample, a), extentAlong(sample, b));
  // The angle of the longer axis; the eye is a quarter turn away from it, plus some degrees.
  const along = 0.5 * Math.atan2(2 * ab, aa - bb);
  const eye = along - Math.PI / 2 + 0.35;
  return new Vector3()
    .addScaledVector(a, Math.cos(eye))
    .addScaledVector(b, Math.sin(eye))
    .addScaledVector(up, Math.max(0.4, 0.9 - 1.3 * (height / (width || 1))));
}

function extentAlong(sample: number[], axis: Vector3): number {
  const { low, high } = ends(sample, (x, y, z) => axis.x * x + axis.y * y + axis.z * z);
  return high - low;
}

/// The pose of the sensor, which looks at the middle of the visible points. Sizes are measured at
/// the distance of the centre.
function poseOfSensor(coordinates: number[], sensor: Vector3, around: Pose): Pose {
  const distance = sensor.distanceTo(around.centre);
  const towards = sensor.clone().sub(around.centre).normalize();
  const half: number[] = [];
  for (const last of [false, true]) {
    const right = new Vector3().crossVectors(around.up, towards).normalize();
    const above = new Vector3().crossVectors(towards, right);
    const turn = new Vector3();
    for (const axis of [right, above]) {
      const { low, high } = ends(coordinates, (x, y, z) => {
        const from = new Vector3(x, y, z).sub(sensor),
          depth = -from.dot(towards);
        return depth > 0 ? from.dot(axis) / depth : 0;
      });
      turn.addScaledVector(axis, (low + high) / 2);
      if (last) half.push((distance * (high - low)) / 2);
    }
    if (!last) towards.sub(turn).normalize();
  }
  return {
    ...around,
    centre: sensor.clone().addScaledVector(towards, -distance),
    towards,
    distance,
    half: { width: half[0]!, height: half[1]!, depth: around.radius },
  };
}

/// The range of a coordinate without a few outermost points, because a distant speck must not make
/// the other points small.
function ends(
  coordinates: number[],
  value: (x: number, y: number, z: number) => number,
): { low: number; high: number } {
  const values: number[] = [];
  for (let i = 0; i < coordinates.length; i += 3)
    values.push(value(coordinates[i]!, coordinates[i + 1]!, coordinates[i + 2]!));
  values.sort((a, b) => a - b);
  const cut = Math.floor(values.length / 1000);
  return { low: values[cut]!, high: values[values.length - 1 - cut]! };
}

function sampled(positions: Float32Array): number[] {
  const step = Math.max(1, Math.floor(positions.length / 3 / kSampled));
  const sample: number[] = [];
  for (let i = 0; i < positions.length; i += 3 * step)
    sample.push(positions[i]!, positions[i + 1]!, positions[i + 2]!);
  return sample;
}

/// The pose whose extent is the box of the points along the axes of the picture.
function poseOf(coordinates: number[], towards: Vector3, up: Vector3, flat: boolean): Pose {
  const forward = towards.clone().normalize();
  const right = new Vector3().crossVectors(up, forward);
  if (right.lengthSq() < 1e-6) right.set(1, 0, 0);
  right.normalize();
  const above = new Vector3().crossVectors(forward, right);
  const centre = new Vector3(),
    half: number[] = [];
  for (const axis of [right, above, forward]) {
    const { low, high } = ends(coordinates, (x, y, z) => axis.x * x + axis.y * y + axis.z * z);
    centre.addScaledVector(axis, (low + high) / 2);
    half.push((high - low) / 2);
  }
  const radius = Math.hypot(...half) || 1;
  const [width, height, depth] = half.map((h) => Math.max(h, 0.05 * radius)) as Triple;
  return {
    centre,
    towards: forward,
    up,
    flat,
    half: { width, height, depth },
    radius,
    distance: undefined,
  };
}
