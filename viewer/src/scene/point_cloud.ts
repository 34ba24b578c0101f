// SPDX-License-Identifier: MIT
// Shows the points of a cloud on the stage, and finds the point under the pointer. If there are
// enough points for a surface, their marks close the gaps between the points; otherwise the marks
// are dots.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Matrix4,
  Points,
  ShaderMaterial,
  Vector2,
  Vector3,
} from "three";
import { spacingOf } from "../geometry/point_spacing";
import type { Pose } from "./pose";
import type { Stage } from "./stage";

const kReach = 6, // distance in pixels at which the pointer finds a point
  kCell = 6,
  kSurface = 3000, // least number of points that form a surface
  kCover = 1.5; // spacings that a mark covers, so that neighbours in any direction touch

const kVertex = `
attribute vec3 tint;
uniform float scale;
uniform float spacing;
uniform bool seen;
uniform vec3 eye;
uniform vec2 limits;
uniform vec4 haze; // centre and radius of the cloud
uniform vec4 air; // colour of the air, and its share at the far end
varying vec3 colour;
varying float size;
void main() {
  vec4 at = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * at;
  float wide = seen ? spacing * distance(position, eye) : spacing;
  size = clamp(wide * scale * projectionMatrix[1][1] / gl_Position.w, limits.x, limits.y);
  gl_PointSize = size;
  float middle = (modelViewMatrix * vec4(haze.xyz, 1.0)).z;
  float part = clamp(0.5 + 0.5 * (middle - at.z) / haze.w, 0.0, 1.0);
  colour = mix(tint, air.rgb, air.a * part);
}`;
const kFragment = `
uniform bool round;
uniform bool soft; // true if nothing lies behind a mark: then the edge of the mark is smooth
varying vec3 colour;
varying float size;
void main() {
  float out_by = round ? size * (length(gl_PointCoord - 0.5) - 0.5) + 0.5 : 0.0;
  if (out_by > (soft ? 1.0 : 0.5)) discard;
  gl_FragColor = vec4(colour, soft ? min(1.0, 1.0 - out_by) : 1.0);
}`;

export class PointCloud {
  readonly object: Points;
  readonly tint: BufferAttribute;
  private readonly material: ShaderMaterial;
  readonly isSurface: boolean; // true if its points hide what is behind them
  private left: Uint8Array | undefined; // points that are left out

  /// @param eye position of the sensor in the space of the positions, if known.
  constructor(
    readonly positions: Float32Array,
    rgba: Uint8Array,
    pose: Pose,
    eye: ArrayLike<number> | undefined,
  ) {
    const count = positions.length / 3;
    this.isSurface = !pose.flat && count >= kSurface;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    this.tint = new BufferAttribute(rgba, 4, true);
    geometry.setAttribute("tint", this.tint);
    const spacing = this.isSurface ? kCover * spacingOf(positions, eye) : 0;
    this.material = new ShaderMaterial({
      vertexShader: kVertex,
      fragmentShader: kFragment,
      transparent: pose.flat,
      depthWrite: !pose.flat,
      uniforms: {
        scale: { value: 1 },
        spacing: { value: spacing || (0.3 * pose.radius) / Math.sqrt(count) },
        seen: { value: spacing > 0 && eye !== undefined },
        eye: { value: new Vector3(...Array.from(eye ?? [0, 0, 0])) },
        limits: { value: new Vector2(1.5, 14) },
        round: { value: !this.isSurface },
        soft: { value: pose.flat },
        haze: { value: [...pose.centre.toArray(), pose.radius || 1] },
        air: { value: [1, 1, 1, 0] },
      },
    });
    this.object = new Points(geometry, this.material);
    this.object.frustumCulled = false;
  }

  /// The size of its marks, in space or as an angle.
  get mark(): { mark: number; isAngle: boolean } {
    const { spacing, seen } = this.material.uniforms;
    return {
      mark: this.isSurface ? (spacing!.value as number) : 0,
      isAngle: seen!.value as boolean,
    };
  }
  /// Draws only some of its points; undefined: all of them.
  showOnly(elements: Uint32Array | undefined): void {
    this.object.geometry.setIndex(elements ? new BufferAttribute(elements, 1) : null);
    this.object.visible = elements?.length !== 0;
  }
  /// Leaves out some of its points: they are not drawn, not under the pointer, and hide nothing.
  leaveOut(mask: Uint8Array | undefined): void {
    this.left = mask;
    const rest: number[] = [];
    for (let i = 0; mask && i < mask.length; ++i) if (!mask[i]) rest.push(i);
    this.showOnly(mask && Uint32Array.from(rest));
  }
  recolour(): void {
    this.tint.needsUpdate = true;
  }
  /// Makes far points fade into this colour, by at most `part`. True colours do not change.
  setAir(colour: string, part: number): void {
    const { r, g, b } = new Color(colour);
    this.material.uniforms["air"]!.value = [r, g, b, part];
  }
  /// @param largest the largest size of a mark that the graphics card draws, device pixels.
  resize(height: number, pixelRatio: number, largest: number): void {
    const { scale, limits } = this.material.uniforms;
    // Near the eye, the marks of a surface are as large as possible, because smaller ones would
    // leave holes.
    const [least, most] = this.isSurface ? [2, largest / pixelRatio] : this.positions.length > 60000 ? [1.5, 14] : [5, 14];
    scale!.value = 0.5 * height * pixelRatio;
    (limits!.value as Vector2).set(least! * pixelRatio, most! * pixelRatio);
  }
  /// The point at these pixels that is nearest to the eye; -1: none.
  at(stage: Stage, x: number, y: number): number {
    const [px, py] = stage.normalised(x, y);
    const m = new Matrix4().multiplyMatrices(
      stage.camera.projectionMatrix,
      stage.camera.matrixWorldInverse,
    ).elements as number[];
    const { width, height } = stage.shown;
    const rx = (2 * kReach) / width,
      ry = (2 * kReach) / height;
    const p = this.positions;
    let best = -1,
      nearest = Infinity;
    for (let i = 0; i < p.length; i += 3) {
      const a = p[i]!,
        b = p[i + 1]!,
        c = p[i + 2]!;
      const w = m[3]! * a + m[7]! * b + m[11]! * c + m[15]!;
      if (w <= 0 || this.left?.[i / 3]) continue;
      const dx = (m[0]! * a + m[4]! * b + m[8]! * c + m[12]!) / w - px;
      if (dx > rx || dx < -rx) continue;
      const dy = (m[1]! * a + m[5]! * b + m[9]! * c + m[13]!) / w - py;
      if (dy > ry || dy < -ry) continue;
      // A point exactly under the pointer is preferred to one that is slightly nearer to the eye.
      const depth =
        (m[2]! * a + m[6]! * b + m[10]! * c + m[14]!) / w +
        0.002 * ((dx / rx) ** 2 + (dy / ry) ** 2);
      if (depth < nearest) [best, nearest] = [i / 3, depth];
    }
    return best;
  }
  /// The distance of the nearest point to the eye around each of some pixels; Infinity if there is
  /// none.
  depthsAt(stage: Stage, pixels: ([number, number] | undefined)[]): Float64Array {
    const { width, height } = stage.shown;
    const depths = new Float64Array(pixels.length).fill(Infinity);
    const columns = Math.ceil(width / kCell),
      rows = Math.ceil(height / kCell);
    const cells = new Int32Array(columns * rows).fill(-1); // the pixel in each cell
    const cellOf = (x: number, y: number) =>
      x >= 0 && x < width && y >= 0 && y < height
        ? Math.floor(y / kCell) * columns + Math.floor(x / kCell)
        : -1;
    const place = pixels.map((at) => (at ? cellOf(...at) : -1));
    place.forEach((cell, i) => cell >= 0 && (cells[cell] = i));
    const m = new Matrix4().multiplyMatrices(
      stage.camera.projectionMatrix,
      stage.camera.matrixWorldInverse,
    ).elements as number[];
    const p = this.positions;
    for (let i = 0; i < p.length; i += 3) {
      const a = p[i]!,
        b = p[i + 1]!,
        c = p[i + 2]!;
      const w = m[3]! * a + m[7]! * b + m[11]! * c + m[15]!; // its depth in perspective
      if (w <= 0 || this.left?.[i / 3]) continue;
      const x = ((m[0]! * a + m[4]! * b + m[8]! * c + m[12]!) / w + 1) * (width / 2),
        y = (1 - (m[1]! * a + m[5]! * b + m[9]! * c + m[13]!) / w) * (height / 2);
      const cell = cellOf(x, y);
      const which = cell < 0 ? -1 : cells[cell]!;
      if (which >= 0 && w < depths[which]!) depths[which] = w;
    }
    // Pixels in one cell share its depth.
    return depths.map((depth, i) => (place[i]! < 0 ? depth : depths[cells[place[i]!]!]!));
  }
}
