// SPDX-License-Identifier: MIT
// The points of a cloud on the stage, and which of them is under the pointer.
import { BufferAttribute, BufferGeometry, Matrix4, Points, ShaderMaterial, Vector2 } from "three";
import type { Stage } from "./stage";

const kReach = 6; // pixels

const kVertex = `
attribute vec3 tint;
uniform float size;
uniform vec2 limits;
varying vec3 colour;
void main() {
  colour = tint;
  vec4 at = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * at;
  gl_PointSize = clamp(size * projectionMatrix[1][1] / gl_Position.w, limits.x, limits.y);
}`;
const kFragment = `
varying vec3 colour;
void main() {
  vec2 at = gl_PointCoord - 0.5;
  if (dot(at, at) > 0.25) discard;
  gl_FragColor = vec4(colour, 1.0);
}`;

export class PointCloud {
  readonly object: Points;
  readonly tint: BufferAttribute;
  private readonly material: ShaderMaterial;

  /// @param spacing how far a point is from the next, about.
  constructor(
    readonly positions: Float32Array,
    rgba: Uint8Array,
    private readonly spacing: number,
  ) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    this.tint = new BufferAttribute(rgba, 4, true);
    geometry.setAttribute("tint", this.tint);
    this.material = new ShaderMaterial({
      vertexShader: kVertex,
      fragmentShader: kFragment,
      uniforms: { size: { value: 1 }, limits: { value: new Vector2(1.5, 14) } },
    });
    this.object = new Points(geometry, this.material);
    this.object.frustumCulled = false;
  }

  recolour(): void {
    this.tint.needsUpdate = true;
  }
  resize(height: number, pixelRatio: number): void {
    const least = this.positions.length > 60000 ? 1.5 : 4.5;
    this.material.uniforms["size"]!.value = 0.15 * this.spacing * height * pixelRatio;
    (this.material.uniforms["limits"]!.value as Vector2).set(least * pixelRatio, 14 * pixelRatio);
  }
  /// The nearest point to the eye among those at these pixels; -1: none.
  at(stage: Stage, x: number, y: number): number {
    const [px, py] = stage.normalised(x, y);
    const m = new Matrix4().multiplyMatrices(
      stage.camera.projectionMatrix,
      stage.camera.matrixWorldInverse,
    ).elements as number[];
    const width = stage.besides ? stage.size.width / 2 : stage.size.width;
    const rx = (2 * kReach) / width,
      ry = (2 * kReach) / stage.size.height;
    const p = this.positions;
    let best = -1,
      nearest = Infinity;
    for (let i = 0; i < p.length; i += 3) {
      const a = p[i]!,
        b = p[i + 1]!,
        c = p[i + 2]!;
      const w = m[3]! * a + m[7]! * b + m[11]! * c + m[15]!;
      if (w <= 0) continue;
      const dx = (m[0]! * a + m[4]! * b + m[8]! * c + m[12]!) / w - px;
      if (dx > rx || dx < -rx) continue;
      const dy = (m[1]! * a + m[5]! * b + m[9]! * c + m[13]!) / w - py;
      if (dy > ry || dy < -ry) continue;
      // A point right under the pointer goes before one that is a little nearer to the eye.
      const depth =
        (m[2]! * a + m[6]! * b + m[10]! * c + m[14]!) / w +
        0.002 * ((dx / rx) ** 2 + (dy / ry) ** 2);
      if (depth < nearest) [best, nearest] = [i / 3, depth];
    }
    return best;
  }
}
