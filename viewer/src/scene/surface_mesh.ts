// SPDX-License-Identifier: MIT
// Shows the triangles of a mesh as a surface, with the colours of its vertices.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Mesh,
  Raycaster,
  ShaderMaterial,
  Vector2,
  Vector3,
} from "three";
import type { Stage } from "./stage";

const kVertex = `
attribute vec3 tint;
varying vec3 colour;
varying vec3 place;
void main() {
  colour = tint;
  place = (modelViewMatrix * vec4(position, 1.0)).xyz;
  gl_Position = projectionMatrix * vec4(place, 1.0);
}`;
// The visible side is lit, so that no triangle is black.
const kFragment = `
varying vec3 colour;
varying vec3 place;
void main() {
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  if (normal.z < 0.0) normal = -normal;
  float light = 0.55 + 0.5 * max(0.0, dot(normal, normalize(vec3(0.3, 0.5, 0.9))));
  gl_FragColor = vec4(min(colour * light, 1.0), 1.0);
}`;

export class SurfaceMesh {
  readonly object: Mesh<BufferGeometry, ShaderMaterial>;

  /// @param corners indices into `positions`, three per triangle.
  constructor(positions: Float32Array, tint: BufferAttribute, corners: Uint32Array) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setAttribute("tint", tint);
    geometry.setIndex(new BufferAttribute(corners, 1));
    const material = new ShaderMaterial({
      vertexShader: kVertex,
      fragmentShader: kFragment,
      side: DoubleSide,
      polygonOffset: true, // edges lie in front of it
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    this.object = new Mesh(geometry, material);
    this.object.frustumCulled = false;
  }

  /// The corner nearest to the visible point of the surface at these pixels; -1 if there is none.
  at(stage: Stage, x: number, y: number): number {
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2(...stage.normalised(x, y)), stage.camera);
    const hit = caster.intersectObject(this.object)[0];
    if (!hit?.face) return -1;
    const place = this.object.worldToLocal(hit.point),
      corner = new Vector3();
    const positions = this.object.geometry.getAttribute("position");
    const far = (i: number) => corner.fromBufferAttribute(positions, i).distanceToSquared(place);
    const { a, b, c } = hit.face;
    return [b, c].reduce((best, i) => (far(i) < far(best) ? i : best), a);
  }
  /// Draws only the first of its triangles.
  show(triangles: number): void {
    this.object.geometry.setDrawRange(0, 3 * triangles);
  }
}
