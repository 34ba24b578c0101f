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
import type { Size } from "./chart";
import type { Pose } from "./pose";

// Colours are what the screen shows; nothing is lit.
ColorManagement.enabled = false;

const kFieldOfView = 40,
  kMargin = 1.08;

export class Stage {
  readonly scene = new Scene();
  readonly camera: PerspectiveCamera | OrthographicCamera;
  readonly controls: OrbitControls;
  size: Size = { width: 0, height: 0 };
  moved = false; // by the reader
  /// Called before each of two pictures side by side; undefined: one picture.
  besides: ((side: 0 | 1) => void) | undefined;
  private held = false;
  private scheduled = false;

  /// @throws Error without WebGL.
  constructor(
    private readonly pose: Pose,
    readonly renderer = new WebGLRenderer({ antialias: true, alpha: true }),
  ) {
    renderer.outputColorSpace = LinearSRGBColorSpace;
    renderer.setPixelRatio(window.devicePixelRatio || 1);
    renderer.autoClear = false;
    this.camera = pose.flat ? new OrthographicCamera() : new PerspectiveCamera(kFieldOfView);
    this.camera.up.copy(pose.up);
    this.controls = new OrbitControls(this.camera, renderer.domElement);
    this.controls.enableRotate = !pose.flat;
    if (pose.flat) this.controls.mouseButtons.LEFT = 2; // pan
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("start", () => (this.held = true));
    this.controls.addEventListener("end", () => (this.held = false));
    this.controls.addEventListener("change", () => {
      this.moved ||= this.held;
      this.invalidate();
    });
    this.reset();
  }

  /// Everything in view.
  reset(): void {
    const { centre, radius, towards, half } = this.pose;
    const tangent = Math.tan((kFieldOfView * Math.PI) / 360);
    const fitting = kMargin * Math.max(half.height, half.width / this.aspect());
    const distance =
      this.pose.distance ?? (this.pose.flat ? 4 * radius : fitting / tangent + half.depth);
    if (this.pose.distance && this.camera instanceof PerspectiveCamera)
      this.camera.fov = (360 / Math.PI) * Math.atan(fitting / distance);
    this.camera.position.copy(centre).addScaledVector(towards, distance);
    this.camera.near = distance / 200;
    this.camera.far = distance * 20 + 10 * radius;
    this.camera.zoom = 1;
    this.controls.target.copy(centre);
    if (this.camera instanceof OrthographicCamera) this.frame(fitting);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.moved = false;
    this.invalidate();
  }
  resize(size: Size): void {
    this.size = size;
    if (size.width === 0 || size.height === 0) return;
    this.renderer.setSize(size.width, size.height);
    if (this.camera instanceof PerspectiveCamera) this.camera.aspect = this.aspect();
    else this.frame(this.camera.top);
    this.camera.updateProjectionMatrix();
    if (!this.moved) this.reset();
    this.invalidate();
  }
  private frame(half: number): void {
    const aspect = this.aspect();
    Object.assign(this.camera, {
      left: -half * aspect,
      right: half * aspect,
      top: half,
      bottom: -half,
    });
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
      this.renderer.render(this.scene, this.camera);
    }
  }
  /// From pixels to -1 … 1, in the picture that holds them.
  normalised(x: number, y: number): [number, number] {
    const width = this.besides ? this.size.width / 2 : this.size.width;
    return [2 * ((x % width) / width) - 1, 1 - (2 * y) / this.size.height];
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
    return (this.besides ? this.size.width / 2 : this.size.width) / this.size.height || 1;
  }
}
