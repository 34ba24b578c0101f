// SPDX-License-Identifier: MIT
// Draws a still picture of the cloud or the slice as SVG if there is no WebGL. It has the colours
// of the live picture.
import { PerspectiveCamera, OrthographicCamera, Vector3 } from "three";
import { svg } from "../common/dom";
import { axesOf } from "./labels";
import type { ImageSlice } from "./image_slice";
import type { Report } from "../model/report";
import type { Shape } from "./representatives";
import type { Pose } from "./pose";

const kMostPoints = 6000,
  kMostMarks = 4000, // number of shapes of one kind
  kSide = 600;
const kBox = { colour: "#7d8794", width: 1, opacity: 1, surface: false };

type Triple = [Vector3, Vector3, Vector3];

export class StaticPicture {
  readonly element = svg(
    "svg",
    { viewBox: `0 0 ${kSide} ${kSide}`, class: "still", role: "img" },
    svg("title", {}, "The data, seen from the front"),
  );
  private camera!: PerspectiveCamera | OrthographicCamera;
  private readonly isVolume: boolean;

  constructor(
    private readonly report: Report,
    pose: Pose,
    private readonly slice: ImageSlice | undefined,
  ) {
    this.isVolume = (report.image?.shape[0] ?? 1) > 1;
    this.face(pose);
  }

  face({ centre, radius, towards, up, flat, half, distance: ofSensor }: Pose): void {
    const margin = this.isVolume ? 1.2 : 1.05; // room for the names of the axes, which lie outside
    const fitting = margin * Math.max(half.width, half.height);
    const distance = ofSensor ?? (flat ? 4 * radius : 2.7 * fitting + half.depth);
    // SVG draws a slice as a parallelogram, because it has no perspective.
    this.camera = flat || this.slice
      ? new OrthographicCamera(-fitting, fitting, fitting, -fitting, 0, distance + 4 * radius)
      : new PerspectiveCamera(
          (360 / Math.PI) * Math.atan(fitting / distance),
          1,
          distance / 200,
          distance + 50 * radius,
        );
    this.camera.up.copy(up);
    this.camera.position.copy(centre).addScaledVector(towards, distance);
    this.camera.lookAt(centre);
    this.camera.updateMatrixWorld();
  }

  /// @param left points that are left out.
  draw(rgba: Uint8Array, left: Uint8Array | undefined, shapes: Shape[]): void {
    const marks = this.slice ? this.pictureOfSlice(this.slice) : this.dots(rgba, left);
    this.element.replaceChildren(
      this.element.firstChild!,
      ...marks,
      ...shapes.flatMap((shape) => [...this.triangles(shape), ...this.lines(shape)]),
      this.axes(),
    );
  }

  private dots(rgba: Uint8Array, left: Uint8Array | undefined): SVGElement[] {
    const positions = this.report.cloud!.positions,
      count = positions.length / 3;
    const step = Math.max(1, Math.ceil(count / kMostPoints));
    const seen: { depth: number; dot: SVGElement }[] = [];
    for (let i = 0; i < count; i += step) {
      if (left?.[i]) continue;
      const at = this.project(positions, 3 * i);
      const fill = `rgb(${rgba[4 * i]} ${rgba[4 * i + 1]} ${rgba[4 * i + 2]})`;
      seen.push({
        depth: at.z,
        dot: svg("circle", { cx: at.x.toFixed(1), cy: at.y.toFixed(1), r: 2.4, fill }),
      });
    }
    return seen.sort((a, b) => b.depth - a.depth).map(({ dot }) => dot);
  }
  /// The triangles of a shape, the farthest first. If there are very many triangles, or lines, only
  /// every n-th is drawn, which is enough to show the shape.
  private triangles(shape: Shape): SVGElement[] {
    const { triangles } = shape.geometry;
    const step = 9 * Math.max(1, Math.ceil(triangles.length / 9 / kMostMarks));
    const seen: { depth: number; mark: SVGElement }[] = [];
    for (let i = 0; i + 8 < triangles.length; i += step) {
      const [a, b, c] = [0, 3, 6].map((k) => this.project(triangles, i + k)) as Triple;
      const points = [a, b, c].map((p) => `${p.x.toFixed(1)},${p.y.toFixed(1)}`).join(" ");
      const opacity = shape.surface ? 0.4 * shape.opacity : shape.opacity;
      const mark = svg("polygon", { points, fill: shape.colour, "fill-opacity": opacity });
      seen.push({ depth: a.z + b.z + c.z, mark });
    }
    return seen.sort((a, b) => b.depth - a.depth).map(({ mark }) => mark);
  }
  private lines(shape: Shape): SVGElement[] {
    const { segments, points } = shape.geometry;
    const marks: SVGElement[] = [];
    const step = 6 * Math.max(1, Math.ceil(segments.length / 6 / kMostMarks));
    for (let i = 0; i + 5 < segments.length; i += step) {
      const a = this.project(segments, i),
        b = this.project(segments, i + 3);
      marks.push(
        svg("line", {
          x1: a.x.toFixed(1),
          y1: a.y.toFixed(1),
          x2: b.x.toFixed(1),
          y2: b.y.toFixed(1),
          stroke: shape.colour,
          "stroke-width": shape.width,
        }),
      );
    }
    for (let i = 0; i + 2 < points.length; i += 3) {
      const a = this.project(points, i);
      marks.push(
        svg("circle", { cx: a.x.toFixed(1), cy: a.y.toFixed(1), r: 5, fill: shape.colour }),
      );
    }
    return marks;
  }
  /// The box of a volume, and in it the slice.
  private pictureOfSlice(slice: ImageSlice): SVGElement[] {
    const { pixels, width, height } = slice.pixels();
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = height;
    canvas
      .getContext("2d")!
      .putImageData(new ImageData(new Uint8ClampedArray(pixels), width, height), 0, 0);
    const corners = slice.corners();
    const [first, right, down] = [0, 3, 9].map((k) => this.project(corners, k)) as Triple;
    const pixel = [right, down].flatMap((end, k) => {
      const side = end.sub(first).divideScalar(k === 0 ? width : height);
      return [side.x, side.y];
    });
    const image = svg("image", {
      href: canvas.toDataURL(),
      width,
      height,
      transform: `matrix(${[...pixel, first.x, first.y].join(" ")})`,
    });
    const geometry = { points: [], segments: slice.outline(), triangles: [] };
    return [...this.lines({ geometry, ...kBox }), image];
  }
  /// The names of the axes of a volume.
  private axes(): SVGElement {
    const names = this.isVolume ? axesOf(this.report) : [];
    const words = names.map(({ text, places }) => {
      const { x, y } = this.project(places[0]!, 0);
      return svg("text", { x: x.toFixed(1), y: (y + 4).toFixed(1) }, text);
    });
    return svg("g", { class: "numbers" }, ...words);
  }
  private project(from: ArrayLike<number>, i: number): Vector3 {
    const at = new Vector3(from[i], from[i + 1], from[i + 2]).project(this.camera);
    return at.set((kSide * (at.x + 1)) / 2, (kSide * (1 - at.y)) / 2, at.z);
  }
}
