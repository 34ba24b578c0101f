// SPDX-License-Identifier: MIT
// Draws text on the data: the numbers of segments, which also appear at bars, dots and branches,
// and the names of the axes of a volume.
import { placeInImage } from "../geometry/cell_geometry";
import { svg } from "../common/dom";
import { axisNames } from "../model/volume_axes";
import { LabelPlaces } from "../common/label_places";
import type { PointCloud } from "./point_cloud";
import type { Report } from "../model/report";
import type { Session } from "../model/session";
import type { Stage } from "./stage";

const kPatience = 60, // milliseconds of waiting after the last change
  kSize = 12, // text size in pixels
  // A place is hidden if its distance exceeds the distance of the nearest point by this factor.
  kBehind = 1.02,
  kPlaces = 48; // candidate places of a segment, for when its middle is hidden

type Place = [number, number, number];
interface Label {
  text: string;
  places: Place[]; // the best first
}

export class Labels {
  readonly element = svg("svg", { class: "numbers", "aria-hidden": "true" });
  private labels: Label[] = [];
  private seen = new Map<Label, Place | undefined>();
  private finding = 0;
  private looking = 0;

  constructor(
    private readonly session: Session,
    private readonly stage: Stage,
    private readonly cloud: PointCloud | undefined,
  ) {
    // On voxels or a surface, letters are dark with a light edge, whatever the colours of the page.
    const { report } = session;
    const isOnData = report.isMesh || !!cloud?.isSurface || report.image?.shape[0] === 1;
    this.element.classList.toggle("on-data", isOnData);
    session.onChange((changes) => {
      const any = (["cut", "colour", "selection", "slice"] as const).some((c) => changes.has(c));
      if (any) this.find();
    });
    this.find();
  }

  /// Finds the labels anew after a delay, so that moving a cut does not wait for them.
  private find(): void {
    clearTimeout(this.finding);
    this.finding = window.setTimeout(() => {
      this.labels = placesOf(this.session);
      this.look();
    }, kPatience);
  }
  /// Moves the labels to their places in the picture. Hidden labels are determined when the picture
  /// stands still.
  place(): void {
    this.show();
    clearTimeout(this.looking);
    if (!this.cloud || this.labels.length === 0) return;
    this.looking = window.setTimeout(() => this.look(), kPatience);
  }
  private show(): void {
    const labelPlaces = new LabelPlaces(kSize);
    const { width, height } = this.stage.shown;
    this.element.replaceChildren(
      ...this.labels.flatMap((label) => {
        const place = this.seen.has(label) ? this.seen.get(label) : label.places[0];
        const at = place && this.stage.pixelOf(...place);
        if (!at) return [];
        const [x, y] = at,
          isIn = x >= 0 && x <= width && y >= 0 && y <= height;
        if (!isIn || !labelPlaces.take(x, y, label.text)) return [];
        return [svg("text", { x: x.toFixed(1), y: (y + 4).toFixed(1) }, label.text)];
      }),
    );
  }
  /// Finds for each label the first place without other points in front of it.
  private look(): void {
    const { cloud, stage } = this;
    this.seen.clear();
    if (cloud?.isSurface) {
      const places = this.labels.flatMap((label) => label.places);
      const first = cloud.depthsAt(stage, places.map((place) => stage.pixelOf(...place)));
      let k = 0;
      for (const label of this.labels) {
        const from = k;
        k += label.places.length;
        const isSeen = (place: Place, i: number) =>
          first[from + i]! < Infinity && stage.depthOf(...place) <= kBehind * first[from + i]!;
        this.seen.set(label, label.places.find(isSeen));
      }
    }
    this.show();
  }
}

function placesOf(session: Session): Label[] {
  const { report } = session;
  const leaf = report.elements?.leaf;
  const isVolume = (report.image?.shape[0] ?? 1) > 1;
  if (isVolume) return axesOf(report);
  const numbers = session.numbers();
  if (!session.cut || !leaf || numbers.size === 0) return [];
  const found = middles(session, numbers);
  const labels: Label[] = [];
  for (const label of numbers.values()) {
    const elements = found.get(label);
    if (!elements) continue;
    labels.push({ text: String(session.numberOf(label)), places: elements.map((i) => placeOf(report, i)) });
  }
  return labels;
}

function placeOf({ image, cloud }: Report, element: number): Place {
  const columns = image?.shape[2] ?? 1;
  if (image) return placeInImage(0, Math.floor(element / columns), element % columns);
  return [0, 1, 2].map((k) => cloud!.positions[3 * element + k]!) as Place;
}

/// For each segment, the element nearest to its middle, then some others, the nearest first; the
/// number is placed on one of them. In an image, a segment is its basin up to the value at which it
/// meets another one.
function middles(session: Session, numbers: Map<number, number>): Map<number, number[]> {
  const { elements, image, cloud, tree } = session.report;
  const { count, birth, leaf } = elements!;
  const most = Math.max(...numbers.values()) + 1;
  const limits = new Float64Array(most).fill(Infinity);
  const isWanted = new Uint8Array(most);
  for (const [bar, number] of numbers) {
    isWanted[number] = 1;
    if (image) limits[number] = tree!.markBasin(tree!.branchOf(bar)!, session.cutValue, () => {});
  }
  const labelOfLeaf = new Uint32Array(tree!.leaves);
  for (let i = 0; i < labelOfLeaf.length; ++i) {
    const label = session.cut!.labelOfLeaf[i]!;
    if (label < most && isWanted[label]) labelOfLeaf[i] = label;
  }
  const columns = image?.shape[2] ?? 1,
    positions = cloud?.positions;
  const labelOf = (i: number) => {
    const label = labelOfLeaf[leaf![i]!] ?? 0;
    return image && birth![i]! >= limits[label]! ? 0 : label;
  };
  const coordinate = positions
    ? (i: number, k: number) => positions[3 * i + k]!
    : (i: number, k: number) => (k === 0 ? i % columns : k === 1 ? Math.floor(i / columns) : 0);
  const sums = new Float64Array(4 * most);
  for (let i = 0; i < count; ++i) {
    const label = labelOf(i);
    if (label === 0) continue;
    for (let k = 0; k < 3; ++k) sums[4 * label + k]! += coordinate(i, k);
    ++sums[4 * label + 3]!;
  }
  const squareOf = (i: number, label: number) => {
    let square = 0;
    for (let k = 0; k < 3; ++k)
      square += (coordinate(i, k) - sums[4 * label + k]! / sums[4 * label + 3]!) ** 2;
    return square;
  };
  const best = new Float64Array(most),
    nearest = new Float64Array(most).fill(Infinity),
    met = new Uint32Array(most);
  const others = new Map<number, number[]>();
  for (let i = 0; i < count; ++i) {
    const label = labelOf(i);
    if (label === 0) continue;
    const square = squareOf(i, label);
    if (square < nearest[label]!) [best[label], nearest[label]] = [i, square];
    const list = others.get(label) ?? [];
    if (list.length === 0) others.set(label, list);
    const step = Math.ceil(sums[4 * label + 3]! / kPlaces);
    if (cloud && met[label]!++ % step === 0) list.push(i);
  }
  for (const [label, list] of others) {
    list.sort((a, b) => squareOf(a, label) - squareOf(b, label));
    list.unshift(best[label]!);
  }
  return others;
}

/// The names of the axes of a volume, each at the end of its edge of the box.
export function axesOf({ image, meta }: Report): Label[] {
  const sizes = image!.shape as [number, number, number];
  const least = [-0.5, -0.5, -0.5] as const;
  return axisNames(meta).map((name, axis) => {
    const at = [...least] as Place;
    at[axis] = sizes[axis]! + 0.05 * Math.max(...sizes);
    return { text: name, places: [placeInImage(...at)] };
  });
}
