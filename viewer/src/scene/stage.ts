// SPDX-License-Identifier: MIT
// The three-dimensional picture: renderer, camera and controls. Draws when something changed, not
// all the time.
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

// Colours are what the screen shows; nothing is lit.
ColorManagement.enabled = false;

const kFieldOfView = 40,
  kMargin = 1.08;

/// Nothing without WebGL. The renderer would write to the console that there is none.
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
  moved = false; // by the reader
  /// Called before each of two pictures side by side; undefined: one picture.
  besides: ((side: 0 | 1) => void) | undefined;
  /// Called after each picture: what lies over it follows.
  rendered: (() => void) | undefined;
  turned: (() => void) | undefined; // by the reader
  /// What is solid and seen in perspective has its depth brought out.
  readonly dome: EyeDome | undefined;
  private held = false;
  private scheduled = false;

  /// @param solid the data have a depth that is worth being brought out: points, a surface.
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
  /// Where the data go, beneath all that is drawn over them.
  get data(): Scene {
    return this.dome?.scene ?? this.scene;
  }
  /// Looks from elsewhere. The controls keep the direction that was upwards when they were made.
  face(pose: Pose): void {
    this.pose = pose;
    this.camera.up.copy(pose.up);
    this.controls.dispose();
    this.controls = this.makeControls();
    this.reset();
  }
  /// Everything in view.
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
  /// What is seen from where the eye stood at first, in a picture of this shape, whatever the reader
  /// has done: an address has the place of the eye and the zoom only.
  /// @return how far the eye stood at first.
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
  /// The size of the picture, of the left one of two.
  get shown(): Size {
    const { width, height } = this.size;
    return { width: this.besides ? width / 2 : width, height };
  }
  /// How far a place is from the eye, along its view.
  depthOf(x: number, y: number, z: number): number {
    return -new Vector3(x, y, z).applyMatrix4(this.camera.matrixWorldInverse).z;
  }
  /// From pixels to -1 … 1, in the picture that holds them.
  normalised(x: number, y: number): [number, number] {
    const { width } = this.shown;
    return [2 * ((x % width) / width) - 1, 1 - (2 * y) / this.size.height];
  }
  /// Where in the picture, in pixels, a place is; in the left one of two. undefined: behind the eye.
  pixelOf(x: number, y: number, z: number): [number, number] | undefined {
    const at = new Vector3(x, y, z).project(this.camera);
    if (at.z > 1 || at.z < -1) return undefined;
    const { width } = this.shown;
    return [(width * (at.x + 1)) / 2, (this.size.height * (1 - at.y)) / 2];
  }
  /// Turns (3-D) or moves (flat) the picture by the keyboard; `zoom` as a factor.
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
  /// Where the eye is, for the address of the page.
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
