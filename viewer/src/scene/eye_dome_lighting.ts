// SPDX-License-Identifier: MIT
// Makes points look like the surface on which they lie: pinholes between their marks are filled, a
// pixel is darker the farther it lies behind its surroundings (after the eye-dome lighting of
// Christian Boucheny, 2009), and the surface is lit from the eye.
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
uniform bool lamp;
uniform float pixel; // an angle
uniform vec3 reach; // pixels: the least; of a mark at depth 1; 1 if the same at any depth
varying vec2 at;
float depthAt(vec2 place) { return texture2D(depths, place).x; }
float away(float depth) {
  return log2(planes.x * planes.y / (planes.y - depth * (planes.y - planes.x)));
}
float beside(vec2 place, float here) {
  float there = depthAt(place);
  return there < 1.0 ? away(there) : here;
}
void main() {
  vec2 from = at;
  float depth = depthAt(at);
  if (depth >= 1.0) {
    float neighbours = 0.0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {
        vec2 next = at + vec2(x, y) * texel;
        float there = depthAt(next);
        if (there >= 1.0) continue;
        neighbours += 1.0;
        if (there < depth) {
          depth = there;
          from = next;
        }
      }
    if (neighbours < 5.0) discard;
  }
  float here = away(depth);
  bool isCamera = reach.z > 0.5;
  float wide = clamp(reach.y * (isCamera ? 1.0 : exp2(-here)), reach.x, 8.0 * reach.x);
  // Depths from a camera are noisy, and the edges of marks are steps.
  float noise = isCamera ? 0.004 : 1.5 * wide * pixel;
  // How far the pixel lies behind the mean of the depths on opposite sides of it; 0 on a plane.
  float behind = 0.0;
  vec2 slope = vec2(0.0);
  for (int i = 0; i < 4; ++i) {
    float angle = 0.7853982 * float(i);
    vec2 towards = vec2(cos(angle), sin(angle));
    float one = beside(at + wide * texel * towards, here), other = beside(at - wide * texel * towards, here);
    behind += clamp(here - 0.5 * (one + other) - noise, 0.0, 0.05);
    // The smaller difference is the slope: the larger one may cross the edge of the surface.
    float up = one - here, down = here - other;
    if (i == 0) slope.x = abs(up) < abs(down) ? up : down;
    if (i == 2) slope.y = abs(up) < abs(down) ? up : down;
  }
  float light = exp(-(isCamera ? 24.0 : 9.0) * behind);
  if (lamp) {
    vec2 tangent = 0.6931472 * slope / (wide * pixel);
    light *= 0.5 + 0.5 * inversesqrt(1.0 + dot(tangent, tangent));
  }
  gl_FragColor = vec4(texture2D(colours, from).rgb * max(0.4, light), 1.0);
  gl_FragDepth = depth;
}`;

export class EyeDome {
  readonly scene = new Scene(); // objects that are drawn this way
  /// The size of the mark drawn for each point, as a length or (if `isAngle`) as an angle. Within a
  /// mark, shading is uniform.
  mark = 0;
  isAngle = false;
  lamp = true; // objects without their own shades are lit from the eye
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
      lamp: { value: true },
      pixel: { value: 1 },
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

  /// Draws the scene into the renderer's current target, whose viewport has this size.
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
    uniforms["lamp"]!.value = this.lamp && !isAngle; // a camera's depth is too rough for it
    uniforms["pixel"]!.value = 1 / scale;
    (uniforms["reach"]!.value as Vector3).set(1.2 * ratio, 0.7 * mark * scale, isAngle ? 1 : 0);
    renderer.render(this.screen, this.flat);
  }
}
