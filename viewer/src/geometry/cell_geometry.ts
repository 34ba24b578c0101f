// SPDX-License-Identifier: MIT
// Cells as points, segments and triangles in the space of the cloud or of the image.
import type { Report } from "../model/report";

export interface Geometry {
  points: number[]; // x, y, z of each point
  segments: number[]; // x, y, z of each end
  triangles: number[]; // x, y, z of each corner
}

export const emptyGeometry = (): Geometry => ({ points: [], segments: [], triangles: [] });

/// The index of a vertex among the shown elements; undefined if the vertex is not shown. @param
/// vertex its number in the input.
export function elementOf(report: Report, vertex: number): number | undefined {
  const index = report.cloud?.index;
  if (!index) return vertex < (report.elements?.count ?? 0) ? vertex : undefined;
  let low = 0,
    high = index.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (index[middle]! < vertex) low = middle + 1;
    else high = middle;
  }
  return index[low] === vertex ? low : undefined;
}

export class CellGeometry {
  constructor(private readonly report: Report) {}

  /// @param numbers vertices of a simplex, or doubled coordinates of a cube.
  add(to: Geometry, numbers: ArrayLike<number>, from: number, count: number): void {
    const { image, cloud } = this.report;
    if (image) addCube(to, numbers, from, count, image.shift);
    else if (cloud) this.addSimplex(to, numbers, from, count);
  }

  private addSimplex(to: Geometry, numbers: ArrayLike<number>, from: number, count: number): void {
    const corners: number[][] = [];
    for (let i = from; i < from + count; ++i) {
      const element = elementOf(this.report, numbers[i]!);
      if (element === undefined) return;
      corners.push([...this.report.cloud!.positions.subarray(3 * element, 3 * element + 3)]);
    }
    if (corners.length === 1) to.points.push(...corners[0]!);
    for (let i = 0; i < corners.length; ++i)
      for (let j = 0; j < i; ++j) {
        to.segments.push(...corners[j]!, ...corners[i]!);
        for (let k = 0; k < j; ++k)
          to.triangles.push(...corners[k]!, ...corners[j]!, ...corners[i]!);
      }
  }
}

/// The place of a point of an image: columns go to the right, rows down, planes towards the reader.
export function placeInImage(plane: number, row: number, column: number): [number, number, number] {
  return [column, -row, plane];
}

function addCube(
  to: Geometry,
  numbers: ArrayLike<number>,
  from: number,
  count: number,
  shift: number,
): void {
  const doubled = [0, 0, 0];
  for (let k = 0; k < count; ++k) doubled[3 - count + k] = numbers[from + k]! + shift;
  const spans = [0, 1, 2].filter(
    (k) => k >= 3 - count && (numbers[from + k - 3 + count]! & 1) === 1,
  );
  const corner = (signs: number[]) => {
    const at = doubled.map((c) => c / 2);
    spans.forEach((axis, i) => (at[axis]! += signs[i]! / 2));
    return placeInImage(at[0]!, at[1]!, at[2]!);
  };
  if (spans.length === 0) to.points.push(...corner([]));
  if (spans.length === 1) to.segments.push(...corner([-1]), ...corner([1]));
  if (spans.length === 2)
    addSquare(to, corner([-1, -1]), corner([1, -1]), corner([1, 1]), corner([-1, 1]));
  if (spans.length === 3)
    for (const sign of [-1, 1])
      for (let axis = 0; axis < 3; ++axis) {
        const face = (a: number, b: number) => {
          const signs = [a, b];
          signs.splice(axis, 0, sign);
          return corner(signs);
        };
        addSquare(to, face(-1, -1), face(1, -1), face(1, 1), face(-1, 1));
      }
}

function addSquare(to: Geometry, a: number[], b: number[], c: number[], d: number[]): void {
  to.triangles.push(...a, ...b, ...c, ...a, ...c, ...d);
  to.segments.push(...a, ...b, ...b, ...c, ...c, ...d, ...d, ...a);
}
