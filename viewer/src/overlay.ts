// SPDX-License-Identifier: MIT
// Shapes on the stage: wide lines, translucent triangles, dots. They are seen through the data.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  Points,
  PointsMaterial,
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
        triangles.length > 0 &&
          new Mesh(
            flat(triangles),
            new MeshBasicMaterial({
              color: shape.colour,
              transparent: true,
              opacity: shape.opacity,
              side: DoubleSide,
              depthWrite: false,
            }),
          ),
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
        part.renderOrder = 10 + i;
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

/// The edges of the complex: many and thin.
export function thinLines(ends: Float32Array, colour: string): LineSegments {
  const lines = new LineSegments(
    flat(ends),
    new LineBasicMaterial({ color: colour, transparent: true, opacity: 0.35, depthWrite: false }),
  );
  lines.frustumCulled = false;
  return lines;
}

function flat(coordinates: ArrayLike<number>): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(coordinates), 3));
  return geometry;
}

function wideLines(segments: number[], shape: Shape): LineSegments2 {
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(segments);
  const material = new LineMaterial({
    color: shape.colour,
    linewidth: shape.width,
    depthTest: shape.width < 2,
    transparent: true,
  });
  return new LineSegments2(geometry, material);
}
