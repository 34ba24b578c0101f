// SPDX-License-Identifier: MIT
// Shapes on the stage: wide lines, translucent triangles, dots. They are visible through the data.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  Points,
  PointsMaterial,
  ShaderMaterial,
  Color,
} from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import type { Shape } from "./representatives";

export class Overlay {
  readonly group = new Group();

  show(shapes: Shape[]): void {
    this.clear();
    shapes.forEach((shape, i) => {
      const { points, segments, triangles } = shape.geometry;
      const parts = [
        ...(triangles.length > 0 ? (shape.surface ? shaded : filled)(flat(triangles), shape) : []),
        segments.length > 0 && wideLines(segments, shape),
        points.length > 0 &&
          new Points(
            flat(points),
            new PointsMaterial({
              color: shape.colour,
              size: 11,
              sizeAttenuation: false,
              depthTest: false,
              transparent: true,
            }),
          ),
      ];
      for (const part of parts) {
        if (!part) continue;
        part.renderOrder = 10 * (i + 1) + part.renderOrder;
        part.frustumCulled = false;
        this.group.add(part);
      }
    });
  }
  private clear(): void {
    for (const child of [...this.group.children]) {
      const { geometry, material } = child as Mesh<BufferGeometry, MeshBasicMaterial>;
      geometry.dispose();
      material.dispose();
      this.group.remove(child);
    }
  }
}

/// The opacity of `count` lines. If there are more than `some` lines, the opacity is lower, because
/// the lines would otherwise merge into solid black.
function faintest(opacity: number, count: number, some: number): number {
  return Math.max(0.015, opacity * Math.min(1, (some / count) ** 0.75));
}

/// Many thin lines: the edges of the complex, or an outline.
export function thinLines(ends: Float32Array, colour: string): LineSegments {
  const lines = new LineSegments(
    flat(ends),
    new LineBasicMaterial({
      color: colour,
      transparent: true,
      opacity: faintest(0.35, ends.length / 6, 3000),
      depthWrite: false,
    }),
  );
  lines.frustumCulled = false;
  return lines;
}

/// The triangles of the complex.
export function veil(corners: Float32Array, colour: string): Mesh {
  const material = new MeshBasicMaterial({
    color: colour,
    transparent: true,
    opacity: faintest(0.16, corners.length / 9, 1000),
    side: DoubleSide,
    depthWrite: false,
  });
  const mesh = new Mesh(flat(corners), material);
  mesh.frustumCulled = false;
  return mesh;
}

function flat(coordinates: ArrayLike<number>): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(coordinates), 3));
  return geometry;
}

/// Marks, visible through everything.
function filled(geometry: BufferGeometry, { colour, opacity }: Shape): Object3D[] {
  const look = { color: colour, transparent: true, opacity, side: DoubleSide };
  return [new Mesh(geometry, new MeshBasicMaterial({ ...look, depthTest: false }))];
}

const kVertex = `
varying vec3 place;
void main() {
  place = (modelViewMatrix * vec4(position, 1.0)).xyz;
  gl_Position = projectionMatrix * vec4(place, 1.0);
}`;
// Triangles of a cycle have no consistent orientation: the visible side is lit.
const kFragment = `
uniform vec3 colour;
uniform float opacity;
varying vec3 place;
void main() {
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  if (normal.z < 0.0) normal = -normal;
  float light = 0.3 + 0.75 * max(0.0, dot(normal, normalize(vec3(0.4, 0.6, 0.9))));
  gl_FragColor = vec4(min(colour * light, 1.0), opacity);
}`;

/// Draws a surface: all of it faintly, even behind the data, and then its visible part, shaded. To
/// find the visible part, the depth of the surface is drawn before the colours of this part.
function shaded(geometry: BufferGeometry, { colour, opacity }: Shape): Object3D[] {
  const layer = (order: number, part: number, depthWrite: boolean) => {
    const material = new ShaderMaterial({
      vertexShader: kVertex,
      fragmentShader: kFragment,
      uniforms: { colour: { value: new Color(colour) }, opacity: { value: part } },
      side: DoubleSide,
      transparent: true,
      depthWrite,
      depthTest: order > 0,
      colorWrite: part > 0,
      polygonOffset: true, // the edges of the surface lie in front of it
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    const mesh = new Mesh(geometry, material);
    mesh.renderOrder = order;
    return mesh;
  };
  return [layer(0, 0.35 * opacity, false), layer(1, 0, true), layer(2, opacity, false)];
}

function wideLines(segments: ArrayLike<number>, shape: Shape): LineSegments2 {
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(Float32Array.from(segments));
  const material = new LineMaterial({
    color: shape.colour,
    linewidth: shape.width,
    depthTest: shape.width < 2,
    transparent: true,
  });
  const lines = new LineSegments2(geometry, material);
  lines.renderOrder = 3;
  return lines;
}
