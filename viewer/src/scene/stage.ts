// SPDX-License-Identifier: MIT
// The three-dimensional picture: renderer, camera and controls. Draws only when something has
// changed.
import {
  ColorManagement,
  LinearSRGBColorSpace,
  OrthographicCamera,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { el, type Size } from "../common/dom";
import { EyeDome } from "./eye_dome_lighting";
import type { Pose } from "./pose";

// three.js does not convert colours between colour spaces.
ColorManagement.enabled = false;

const kFieldOfView = 40,
  kMargin = 1.08;

/// Undefined without WebGL. A context is requested first, because the renderer would otherwise
/// write an error to the console.
export function rendererOf(): WebGLRenderer | undefined {
  const canvas = el("canvas");
  const context = canvas.getContext("webgl2", { antialias: true, alpha: true });
  return context ? new WebGLRenderer({ canvas, context }) : undefined;
}

export class Stage {
  readonly scene = new Scene();
  readonly camera: PerspectiveCamera | OrthographicCamera;
  controls: OrbitControls;
  size: Size = { width: 0, height: 0 };
  moved = false; // moved by the reader
  /// Called before each of two pictures side by side; undefined for a single picture.
  besides: ((side: 0 | 1) => void) | undefined;
  /// Called after each picture, so that overlays follow.
  rendered: (() => void) | undefined;
  turned: (() => void) | undefined; // called when the reader has moved the picture
  /// Solid data in perspective get depth shading.
  readonly dome: EyeDome | undefined;
  private held = false;
  private scheduled = false;

  /// @param solid true if the data have a depth worth shading: points, a surface.
  constructor(
    private pose: Pose,
    solid: boolean,
    readonly renderer: WebGLRenderer,
  ) {
    renderer.outputColorSpace = LinearSRGBColorSpace;
    renderer.autoClear = false;
    this.camera = pose.flat ? new OrthographicCamera() : new PerspectiveCamera(kFieldOfView);
    this.camera.up.copy(pose.up);
    if (!pose.flat && solid) this.dome = new EyeDome();
    this.controls = this.makeControls();
    this.reset();
  }

  /// The widest point that can be drawn, device pixels.
  get largestMark(): number {
    const gl = this.renderer.getContext();
    return (gl.getParameter(gl.ALIASED_POINT_SIZE_RANGE) as Float32Array)[1]!;
  }
  private makeControls(): OrbitControls {
    const controls = new OrbitControls(this.camera, this.renderer.domElement);
    controls.enableRotate = !this.pose.flat;
    if (this.pose.flat) controls.mouseButtons.LEFT = 2; // pan
    controls.zoomToCursor = true;
    controls.addEventListener("start", () => (this.held = true));
    controls.addEventListener("end", () => {
      this.held = false;
      this.turned?.();
    });
    controls.addEventListener("change", () => {
      this.moved ||= this.held;
      this.invalidate();
    });
    return controls;
  }
  /// The group for the data, beneath everything that is drawn over them.
  get data(): Scene {
    return this.dome?.scene ?? this.scene;
  }
  /// Changes the viewpoint. New controls are made, because controls keep the upward direction that
  /// they start with.
  face(pose: Pose): void {
    this.pose = pose;
    this.camera.up.copy(pose.up);
    this.controls.dispose();
    this.controls = this.makeControls();
    this.reset();
  }
  /// Fits everything into the view.
  reset(): void {
    const { centre, towards } = this.pose;
    this.camera.zoom = 1;
    this.camera.position.copy(centre).addScaledVector(towards, this.fit());
    this.controls.target.copy(centre);
    this.controls.update();
    this.moved = false;
    this.invalidate();
  }
  resize(size: Size): void {
    this.size = size;
    if (size.width === 0 || size.height === 0) return;
    this.renderer.setPixelRatio(window.devicePixelRatio || 1);
    this.renderer.setSize(size.width, size.height);
    if (this.moved) this.fit();
    else this.reset();
    this.invalidate();
  }
  /// Sets the initial projection for a picture of this shape, whatever the reader has done, because
  /// an address stores only the position of the eye, its target and the zoom.
  /// @return the initial distance of the eye.
  private fit(): number {
    const { camera } = this,
      aspect = this.aspect();
    const { radius, half, flat } = this.pose;
    const fitting = kMargin * Math.max(half.height, half.width / aspect);
    const tangent = Math.tan((kFieldOfView * Math.PI) / 360);
    const distance = this.pose.distance ?? (flat ? 4 * radius : fitting / tangent + half.depth);
    if (camera instanceof PerspectiveCamera) {
      camera.aspect = aspect;
      if (this.pose.distance) camera.fov = (360 / Math.PI) * Math.atan(fitting / distance);
    } else {
      const [right, top] = [fitting * aspect, fitting];
      Object.assign(camera, { left: -right, right, top, bottom: -top });
    }
    camera.near = distance / 200;
    camera.far = distance * 20 + 10 * radius;
    camera.updateProjectionMatrix();
    return distance;
  }
  invalidate(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => this.render());
  }
  render(): void {
    this.scheduled = false;
    const { width, height } = this.size;
    if (width === 0 || height === 0) return;
    this.renderer.setScissorTest(false);
    this.renderer.setViewport(0, 0, width, height);
    this.renderer.clear();
    for (const side of this.besides ? ([0, 1] as const) : ([0] as const)) {
      if (this.besides) {
        this.renderer.setViewport((side * width) / 2, 0, width / 2, height);
        this.renderer.setScissor((side * width) / 2, 0, width / 2, height);
        this.renderer.setScissorTest(true);
        this.besides(side);
      }
      if (this.camera instanceof PerspectiveCamera)
        this.dome?.render(this.renderer, this.camera, this.shown.width, height);
      this.renderer.render(this.scene, this.camera);
    }
    this.rendered?.();
  }
  /// The size of the picture, or of the left one of two.
  get shown(): Size {
    const { width, height } = this.size;
    return { width: this.besides ? width / 2 : width, height };
  }
  /// The distance of a place from the eye, measured along the axis of the camera.
  depthOf(x: number, y: number, z: number): number {
    return -new Vector3(x, y, z).applyMatrix4(this.camera.matrixWorldInverse).z;
  }
  /// Converts pixels to -1 … 1, in the picture that contains them.
  normalised(x: number, y: number): [number, number] {
    const { width } = this.shown;
    return [2 * ((x % width) / width) - 1, 1 - (2 * y) / this.size.height];
  }
  /// The position of a place in the picture, in pixels (in the left one of two). undefined: behind
  /// the eye.
  pixelOf(x: number, y: number, z: number): [number, number] | undefined {
    const at = new Vector3(x, y, z).project(this.camera);
    if (at.z > 1 || at.z < -1) return undefined;
    const { width } = this.shown;
    return [(width * (at.x + 1)) / 2, (this.size.height * (1 - at.y)) / 2];
  }
  /// Rotates (3-D) or moves (flat) the picture by the keyboard; `zoom` is a factor.
  nudge(dx: number, dy: number, zoom: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    if (this.pose.flat) {
      const step = (0.15 * this.pose.radius) / this.camera.zoom;
      for (const v of [this.camera.position, this.controls.target])
        v.add(new Vector3(-dx * step, dy * step, 0));
      this.camera.zoom *= zoom;
      this.camera.updateProjectionMatrix();
    } else {
      const right = new Vector3().crossVectors(this.camera.up, offset).normalize();
      offset.applyAxisAngle(this.camera.up.clone().normalize(), -0.12 * dx);
      const tilted = offset.clone().applyAxisAngle(right, -0.12 * dy);
      if (tilted.angleTo(this.camera.up) > 0.05 && tilted.angleTo(this.camera.up) < Math.PI - 0.05)
        offset.copy(tilted);
      this.camera.position.copy(this.controls.target).add(offset.divideScalar(zoom));
    }
    this.controls.update();
    this.moved = true;
    this.invalidate();
  }
  /// The position of the eye, its target and the zoom, for the address of the page.
  get view(): number[] {
    const { position } = this.camera,
      { target } = this.controls;
    return [...position.toArray(), ...target.toArray(), this.camera.zoom].map((v) =>
      Number(v.toPrecision(5)),
    );
  }
  set view(values: number[]) {
    if (values.length !== 7 || !values.every(Number.isFinite)) return;
    this.camera.position.fromArray(values);
    this.controls.target.fromArray(values, 3);
    this.camera.zoom = values[6]!;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.moved = true;
    this.invalidate();
  }

  private aspect(): number {
    return this.shown.width / this.shown.height || 1;
  }
}
