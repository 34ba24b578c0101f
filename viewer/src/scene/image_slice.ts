// SPDX-License-Identifier: MIT
// Shows one slice of an image or a volume on the stage.
import {
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  DoubleSide,
  Mesh,
  MeshBasicMaterial,
  NearestFilter,
  Raycaster,
  Vector2,
} from "three";
import { placeInImage } from "../geometry/cell_geometry";
import type { Stage } from "./stage";

export class ImageSlice {
  readonly object: Mesh<BufferGeometry, MeshBasicMaterial>;
  private axis = 0;
  private index = 0;

  constructor(
    readonly shape: number[],
    private readonly rgba: Uint8Array,
  ) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(12), 3));
    geometry.setAttribute("uv", new BufferAttribute(new Float32Array([0, 0, 1, 0, 1, 1, 0, 1]), 2));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.object = new Mesh(geometry, new MeshBasicMaterial({ side: DoubleSide, alphaTest: 0.5 }));
    this.object.frustumCulled = false;
  }

  /// The edges of a volume; empty for an image.
  outline(): number[] {
    const [planes, rows, columns] = this.shape as [number, number, number];
    if (planes === 1) return [];
    const lines: number[] = [];
    const ends = [
      [-0.5, planes - 0.5],
      [-0.5, rows - 0.5],
      [-0.5, columns - 0.5],
    ] as const;
    for (let axis = 0; axis < 3; ++axis)
      for (const a of [0, 1])
        for (const b of [0, 1])
          for (const end of [0, 1]) {
            const at = [a, b];
            at.splice(axis, 0, end);
            lines.push(...placeInImage(ends[0][at[0]!]!, ends[1][at[1]!]!, ends[2][at[2]!]!));
          }
    return lines;
  }
  show(axis: number, index: number): void {
    this.axis = axis;
    this.index = Math.min(this.shape[axis]! - 1, Math.max(0, index));
    const position = this.object.geometry.getAttribute("position") as BufferAttribute;
    position.set(this.corners());
    position.needsUpdate = true;
    this.object.geometry.computeBoundingSphere();
    this.recolour();
  }
  /// The corners of the slice, in the order: first pixel, end of the first row, last pixel, start
  /// of the last row.
  corners(): number[] {
    const [v, u] = this.sides();
    const corner = (i: number, j: number) => {
      const at = [0, 0, 0];
      at[this.axis] = this.index;
      at[v] = i;
      at[u] = j;
      return placeInImage(at[0]!, at[1]!, at[2]!);
    };
    const rows = this.shape[v]! - 0.5,
      columns = this.shape[u]! - 0.5;
    return [
      ...corner(-0.5, -0.5),
      ...corner(-0.5, columns),
      ...corner(rows, columns),
      ...corner(rows, -0.5),
    ];
  }
  recolour(): void {
    const { pixels, width, height } = this.pixels();
    const material = this.object.material;
    material.map?.dispose();
    material.map = new DataTexture(pixels, width, height);
    material.map.magFilter = NearestFilter;
    material.map.minFilter = NearestFilter;
    material.map.needsUpdate = true;
    material.needsUpdate = true;
  }
  /// The colours of the slice, row by row.
  pixels(): { pixels: Uint8Array; width: number; height: number } {
    const [v, u] = this.sides();
    const height = this.shape[v]!,
      width = this.shape[u]!;
    const from = new Uint32Array(this.rgba.buffer),
      to = new Uint32Array(width * height);
    const first = this.element(0, 0),
      down = height > 1 ? this.element(1, 0) - first : 0,
      right = width > 1 ? this.element(0, 1) - first : 0;
    for (let i = 0, k = 0; i < height; ++i)
      for (let j = 0, at = first + i * down; j < width; ++j, at += right) to[k++] = from[at]!;
    return { pixels: new Uint8Array(to.buffer), width, height };
  }
  /// The voxel at these pixels; -1: none.
  at(stage: Stage, x: number, y: number): number {
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2(...stage.normalised(x, y)), stage.camera);
    const uv = caster.intersectObject(this.object)[0]?.uv;
    if (!uv) return -1;
    const [v, u] = this.sides();
    const cell = (part: number, size: number) => Math.min(size - 1, Math.floor(part * size));
    return this.element(cell(uv.y, this.shape[v]!), cell(uv.x, this.shape[u]!));
  }

  private sides(): [number, number] {
    return [this.axis === 0 ? 1 : 0, this.axis === 2 ? 1 : 2];
  }
  private element(i: number, j: number): number {
    const [v, u] = this.sides();
    const at = [0, 0, 0];
    at[this.axis] = this.index;
    at[v] = i;
    at[u] = j;
    return (at[0]! * this.shape[1]! + at[1]!) * this.shape[2]! + at[2]!;
  }
}
