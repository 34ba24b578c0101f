// SPDX-License-Identifier: MIT
// Shows the data: a coloured cloud, image or volume, with the selection drawn on it.
import { Colouring } from "./colouring";
import { scrubber, sliceControls } from "./data_controls";
import { button, el, isOfBrowser, onResize, select } from "../common/dom";
import { ImageSlice } from "./image_slice";
import { Labels } from "./labels";
import { Legend } from "./legend";
import { counted, grouped, homology, short } from "../common/number_format";
import { Overlay, thinLines, veil } from "./overlay";
import { PointCloud } from "./point_cloud";
import { firstPose } from "./pose";
import { shapesOf, type Shape } from "./representatives";
import { bettiAt, ShownComplex, type ShownPart } from "../geometry/shown_complex";
import { rendererOf, Stage } from "./stage";
import { SurfaceMesh } from "./surface_mesh";
import { shownValue } from "../model/words";
import { StaticPicture } from "./static_picture";
import { Group, type LineSegments, type Mesh } from "three";
import type { Report } from "../model/report";
import type { ColourMode } from "../model/colour_modes";
import type { Change, Session } from "../model/session";

export class DataView {
  readonly panel: HTMLElement;
  readonly stage: Stage | undefined;
  private readonly colouring: Colouring;
  private readonly truthColouring: Colouring | undefined;
  private readonly cloud: PointCloud | undefined;
  private readonly mesh: SurfaceMesh | undefined;
  private readonly slice: ImageSlice | undefined;
  private readonly overlay = new Overlay();
  private readonly still: StaticPicture | undefined;
  private readonly complex: ShownComplex;
  private readonly complexGroup = new Group();
  private complexShape: Shape | undefined; // for the still picture
  private outside: Uint32Array | undefined; // vertices of a mesh that belong to no triangle
  private readonly head: HTMLElement;
  private readonly body = el("div", { class: "data-body" });
  private readonly canvasHost = el("div", { class: "stage" });
  private readonly legend: Legend;
  private readonly reading = el("output", { class: "reading" });
  private facing: number; // the axis of the slice that the eye looks along
  private left: Uint8Array | undefined; // points of hidden surfaces
  private pressedAt: [number, number] | undefined;

  constructor(private readonly session: Session) {
    const { report } = session;
    this.colouring = new Colouring(session);
    this.colouring.update();
    this.complex = new ShownComplex(report);
    if (report.isMesh) this.outside = this.complex.outside();
    this.facing = session.sliceAxis;
    const pose = firstPose(report, session.sliceAxis);
    if (report.image) this.slice = new ImageSlice(report.image.shape, this.colouring.rgba);
    else {
      const { origin, positions } = report.cloud!;
      const eye = report.meta.cloud?.viewpoint?.map((c, k) => c - origin[k]!);
      this.cloud = new PointCloud(positions, this.colouring.rgba, pose, eye);
      const { surface } = this.complex;
      if (surface) this.mesh = new SurfaceMesh(positions, this.cloud.tint, surface);
      if (report.elements!.truth) {
        this.truthColouring = new Colouring(session);
        this.truthColouring.update("truth");
      }
    }
    this.head = el(
      "header",
      {},
      el("h2", {}, kindOf(report)),
    );
    this.panel = el("section", { class: "panel data", "aria-label": "Data" }, this.head, this.body);
    const renderer = rendererOf();
    if (renderer) {
      this.stage = new Stage(pose, !report.image, renderer);
      this.setUpStage(this.stage);
    } else {
      this.still = new StaticPicture(report, pose, this.slice);
      const note = "WebGL is not available here: a still picture.";
      this.canvasHost.append(this.still.element, el("p", { class: "note" }, note));
    }
    this.legend = new Legend(session, this.colouring);
    this.body.append(this.canvasHost, this.legend.element);
    this.addControls();
    this.slice?.show(session.sliceAxis, session.slice);
    session.onChange((changes) => this.update(changes));
    this.update(new Set<Change>(["colour", "scale"]));
  }

  /// The picture as it is now, as a PNG.
  picture(): string | undefined {
    this.stage?.render();
    return this.stage?.renderer.domElement.toDataURL("image/png");
  }

  private setUpStage(stage: Stage): void {
    const canvas = stage.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute(
      "aria-label",
      `${this.description()}. Arrow keys turn or move it, plus and minus zoom, 0 fits it.`,
    );
    this.canvasHost.append(canvas);
    stage.data.add(...[this.cloud, this.mesh, this.slice].flatMap((part) => part?.object ?? []));
    if (stage.dome && this.cloud)
      Object.assign(stage.dome, this.mesh ? { lamp: false } : this.cloud.mark);
    stage.scene.add(this.complexGroup, this.overlay.group);
    const labels = new Labels(this.session, stage, this.cloud);
    this.canvasHost.append(labels.element);
    stage.rendered = () => labels.place();
    if (this.slice) stage.scene.add(thinLines(Float32Array.from(this.slice.outline()), "#7d8794"));
    onResize(this.canvasHost, () => {
      const size = { width: this.canvasHost.clientWidth, height: this.canvasHost.clientHeight };
      stage.resize(size);
      this.cloud?.resize(size.height, stage.renderer.getPixelRatio(), stage.largestMark);
      stage.render(); // at once: a resized canvas is empty
    });
    addEventListener("beforeprint", () => stage.render()); // the previous drawing is gone
    stage.turned = () => this.session.changed("view");
    canvas.addEventListener("pointermove", (event) => event.buttons === 0 && this.hover(event));
    canvas.addEventListener("pointerleave", () => this.session.setFocus({}));
    canvas.addEventListener(
      "pointerdown",
      (event) => (this.pressedAt = [event.clientX, event.clientY]),
    );
    canvas.addEventListener("click", (event) => this.click(event));
    canvas.addEventListener("keydown", (event) => this.key(event, stage));
  }

  private description(): string {
    const { report } = this.session;
    if (report.image)
      return `Image of ${report.image.shape.filter((n, i) => n > 1 || i > 0).join(" × ")}`;
    const { count } = report.elements!;
    if (!report.isMesh) return `Cloud of ${counted(count, "point")}`;
    return `Mesh of ${count === 1 ? "1 vertex" : `${grouped(count)} vertices`}`;
  }

  private addControls(): void {
    const { session } = this;
    const { report } = session;
    const modes = session.colourModes();
    const size = this.description().replace(/^(Cloud|Image|Mesh) of /, "");
    const colour = select("colour", modes, session.colour, (value) =>
      session.set("colour", value as ColourMode, "colour"),
    );
    session.onChange((changes) => {
      if (changes.has("colour")) colour.querySelector("select")!.value = session.colour;
    });
    this.head.append(el("span", { class: "hint" }, size), colour);
    if (this.truthColouring && this.stage) {
      const box = el("input", { type: "checkbox" });
      box.addEventListener("change", () => session.set("beside", box.checked, "colour"));
      this.head.append(el("label", { class: "field" }, box, el("span", {}, "ground truth beside")));
    }
    if (this.stage)
      this.head.append(
        button("fit", () => this.stage!.reset(), { class: "quiet", title: "See everything (0)" }),
      );
    if (report.image && report.image.shape[0]! > 1)
      this.panel.append(sliceControls(session, report.image.shape));
    if (report.bars.size > 0 && (this.complex.available || report.elements!.birth))
      this.panel.append(scrubber(session, this.reading));
    if (report.meta.cloud?.projection)
      this.panel.append(el("p", { class: "note" }, report.meta.cloud.projection));
  }

  /// Restores the initial view of the slice, unless the eye already looks along its axis.
  face(): void {
    const { report, sliceAxis } = this.session;
    if (this.facing === sliceAxis) return;
    this.facing = sliceAxis;
    (this.stage ?? this.still)!.face(firstPose(report, sliceAxis));
  }

  private update(changes: Set<Change>): void {
    const any = (...these: Change[]) => these.some((change) => changes.has(change));
    const { session } = this;
    if (any("theme")) this.truthColouring?.update("truth");
    if (any("theme", "colour")) this.showAir();
    if (any("focus", "selection", "cut", "colour", "scale", "theme")) {
      if (this.colouring.update()) {
        this.cloud?.recolour();
        this.slice?.recolour();
      }
    }
    if (any("surfaces") || (any("cut") && session.hiddenSurfaces.size > 0)) this.showSurfaces();
    if (any("slice")) {
      this.slice?.show(session.sliceAxis, session.slice);
      this.face();
    }
    if (any("scale", "theme")) this.showScale();
    if (any("colour") && this.stage) this.showBeside(this.stage);
    const shapes = any("focus", "selection", "theme", "colour") ? shapesOf(session) : undefined;
    if (shapes && this.stage) this.overlay.show(shapes);
    const complex = this.complexShape ? [this.complexShape] : [];
    this.still?.draw(this.colouring.rgba, this.left, [...complex, ...(shapes ?? shapesOf(session))]);
    this.stage?.invalidate();
  }
  private showSurfaces(): void {
    const { session } = this;
    const hidden = session.hiddenSurfaces;
    const { count } = session.report.elements!;
    this.left =
      hidden.size === 0
        ? undefined
        : Uint8Array.from({ length: count }, (_, i) => Number(hidden.has(session.surfaceOf(i))));
    this.cloud?.leaveOut(this.left);
  }
  private showBeside(stage: Stage): void {
    const { beside } = this.session;
    const geometry = this.cloud?.object.geometry;
    if (beside && this.truthColouring && geometry) {
      const truth = this.cloud!.tint.clone();
      truth.array.set(this.truthColouring.rgba);
      truth.needsUpdate = true;
      stage.besides = (side) =>
        geometry.setAttribute("tint", side === 0 ? this.cloud!.tint : truth);
    } else if (stage.besides) {
      stage.besides = undefined;
      geometry?.setAttribute("tint", this.cloud!.tint);
    }
    stage.resize(stage.size);
  }
  /// Fades far points unless a camera saw the points, because nothing else shows their distance.
  private showAir(): void {
    const { report, theme, colour } = this.session;
    const part = report.cloud?.dims !== 3 || report.meta.cloud?.viewpoint || colour === "rgb" ? 0 : 0.6;
    this.cloud?.setAir(theme.panel, part);
  }
  private showScale(): void {
    const { scale, report, theme } = this.session;
    for (const child of [...this.complexGroup.children] as (LineSegments | Mesh)[]) {
      child.geometry.dispose();
      this.complexGroup.remove(child);
    }
    this.complexShape = undefined;
    // A mesh is shown as a surface; all edges of a Rips complex would hide everything.
    const shown = scale ?? (report.isMesh ? Infinity : undefined);
    const value = scale === undefined ? "all" : short(shownValue(report.meta, scale), 3);
    if (shown === undefined) {
      this.mesh?.show(0);
      this.cloud?.showOnly(undefined);
    }
    let text = scale === undefined ? value : `${value}   ${bettiInWords(report, scale)}`;
    if (this.complex.available && shown !== undefined) {
      const part = this.complex.upTo(shown);
      const corners = part.corners ?? new Uint32Array();
      this.mesh?.show(corners.length / 3);
      // Vertices and edges are visible where there are no triangles, or none yet.
      if (this.mesh) this.cloud!.showOnly(scale === undefined ? this.outside : undefined);
      if (!this.mesh || scale !== undefined)
        this.complexGroup.add(thinLines(this.complex.places(part.ends), theme.ink));
      if (!this.mesh) this.complexGroup.add(veil(this.complex.places(corners), theme.ink));
      if (this.still) {
        const geometry = {
          points: [],
          segments: this.complex.places(part.ends),
          triangles: this.complex.places(corners),
        };
        this.complexShape = { geometry, colour: theme.muted, width: 0.5, opacity: 0.05, surface: false };
      }
      text += `   ${partInWords(part)}`;
    }
    this.reading.textContent = text;
  }

  private elementAt(event: MouseEvent): number {
    const box = this.canvasHost.getBoundingClientRect();
    const x = event.clientX - box.left,
      y = event.clientY - box.top;
    const stage = this.stage!;
    // Elements behind a surface are not under the pointer.
    const corner = this.mesh?.at(stage, x, y) ?? -1;
    if (corner >= 0) return corner;
    return this.cloud?.at(stage, x, y) ?? this.slice?.at(stage, x, y) ?? -1;
  }
  private hover(event: PointerEvent): void {
    const element = this.elementAt(event);
    if (element < 0) return this.session.setFocus({});
    this.session.setFocus({
      element,
      bar: this.session.barOf(element),
      segment: this.session.segmentOf(element),
    });
  }
  private click(event: MouseEvent): void {
    const [x, y] = this.pressedAt ?? [event.clientX, event.clientY];
    if (Math.hypot(event.clientX - x, event.clientY - y) > 4) return; // the picture was rotated
    const element = this.elementAt(event),
      bar = element < 0 ? -1 : this.session.barOf(element);
    const more = event.shiftKey || event.ctrlKey || event.metaKey;
    this.session.select(bar < 0 ? [] : [bar], more ? "toggle" : "replace");
  }
  private key(event: KeyboardEvent, stage: Stage): void {
    if (isOfBrowser(event)) return;
    const moves: Record<string, [number, number, number]> = {
      ArrowLeft: [-1, 0, 1],
      ArrowRight: [1, 0, 1],
      ArrowUp: [0, -1, 1],
      ArrowDown: [0, 1, 1],
      "+": [0, 0, 1.2],
      "=": [0, 0, 1.2],
      "-": [0, 0, 1 / 1.2],
    };
    const move = moves[event.key];
    if (event.key === "0") stage.reset();
    else if (move) stage.nudge(...move);
    else return;
    this.session.changed("view");
    event.preventDefault();
  }
}

function kindOf({ image, isMesh }: Report): string {
  if (image) return image.shape[0]! > 1 ? "Volume" : "Image";
  return isMesh ? "Mesh" : "Point cloud";
}

function bettiInWords(report: Report, value: number): string {
  return bettiAt(report, value)
    .map((b, dim) => `β${homology(dim).slice(1)} ${grouped(b)}`)
    .join("  ");
}

function partInWords({ ends, corners, moreEdges, moreTriangles }: ShownPart): string {
  const of = (count: number, cell: string, more: boolean) =>
    more ? `the first ${grouped(count)} ${cell}s` : counted(count, cell);
  const edges = of(ends.length / 2, "edge", moreEdges);
  if (!corners) return `${edges}, more triangles than can be drawn`;
  return corners.length > 0 ? `${edges}, ${of(corners.length / 3, "triangle", moreTriangles)}` : edges;
}
