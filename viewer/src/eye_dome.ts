// SPDX-License-Identifier: MIT
// Points of a surface as a surface: pinholes between their marks are filled, and a pixel is darker
// the farther it lies behind its neighbours, so that what is in front is seen to be so (eye-dome
// lighting: Christian Boucheny, 2009).
import {
  DepthTexture,
  Mesh,
  NearestFilter,
  OrthographicCamera,
  type PerspectiveCamera,
  PlaneGeometry,
  Scene,
  ShaderMaterial,
  Vector2,
  Vector3,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";

const kVertex = `
varying vec2 at;
void main() {
  at = uv;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;
const kFragment = `
uniform sampler2D colours;
uniform sampler2D depths;
uniform vec2 texel;
uniform vec2 planes; // near, far
uniform vec3 reach; // pixels: least; of a mark at depth 1; whether that is so at every depth
varying vec2 at;
float depthAt(vec2 place) { return texture2D(depths, place).x; }
float away(float depth) {
  return log2(planes.x * planes.y / (planes.y - depth * (planes.y - planes.x)));
}
void main() {
  vec2 from = at;
  float depth = depthAt(at);
  if (depth >= 1.0) {
    float beside = 0.0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {
        vec2 next = at + vec2(x, y) * texel;
        float there = depthAt(next);
        if (there >= 1.0) continue;
        beside += 1.0;
        if (there < depth) {
          depth = there;
          from = next;
        }
      }
    if (beside < 5.0) discard;
  }
  float here = away(depth), behind = 0.0;
  float even = reach.z > 0.5 ? 0.006 : 0.0; // the noise of a camera
  float wide = clamp(reach.y * (reach.z > 0.5 ? 1.0 : exp2(-here)), reach.x, 8.0 * reach.x);
  for (int i = 0; i < 8; ++i) {
    float angle = 0.7853982 * float(i);
    float there = depthAt(at + wide * texel * vec2(cos(angle), sin(angle)));
    if (there < 1.0) behind += clamp(here - away(there) - even, 0.0, 0.05);
  }
  gl_FragColor = vec4(texture2D(colours, from).rgb * max(0.4, exp(-16.0 * behind / sqrt(wide))), 1.0);
  gl_FragDepth = depth;
}`;

export class EyeDome {
  readonly scene = new Scene(); // what is drawn so
  /// How large the marks of points are, in space or as an angle: within a mark all is even.
  mark = 0;
  isAngle = false;
  private readonly target = new WebGLRenderTarget(1, 1, {
    depthTexture: new DepthTexture(1, 1),
    magFilter: NearestFilter,
    minFilter: NearestFilter,
  });
  private readonly material = new ShaderMaterial({
    vertexShader: kVertex,
    fragmentShader: kFragment,
    uniforms: {
      colours: { value: this.target.texture },
      depths: { value: this.target.depthTexture },
      texel: { value: new Vector2() },
      planes: { value: new Vector2() },
      reach: { value: new Vector3(1, 0, 0) },
    },
  });
  private readonly screen = new Scene();
  private readonly flat = new OrthographicCamera();

  constructor() {
    const sheet = new Mesh(new PlaneGeometry(2, 2), this.material);
    sheet.frustumCulled = false;
    this.screen.add(sheet);
  }

  /// Draws the scene into what the renderer draws to at present, whose viewport is this large.
  render(renderer: WebGLRenderer, camera: PerspectiveCamera, width: number, height: number): void {
    const ratio = renderer.getPixelRatio();
    const w = Math.max(1, Math.round(width * ratio)),
      h = Math.max(1, Math.round(height * ratio));
    if (this.target.width !== w || this.target.height !== h) this.target.setSize(w, h);
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.render(this.scene, camera);
    renderer.setRenderTarget(null);
    const { uniforms } = this.material;
    (uniforms["texel"]!.value as Vector2).set(1 / w, 1 / h);
    (uniforms["planes"]!.value as Vector2).set(camera.near, camera.far);
    const { mark, isAngle } = this;
    const scale = 0.5 * h * camera.projectionMatrix.elements[5]!;
    (uniforms["reach"]!.value as Vector3).set(1.2 * ratio, 0.7 * mark * scale, isAngle ? 1 : 0);
    renderer.render(this.screen, this.flat);
  }
}
