// SPDX-License-Identifier: MIT
// Words on the data: the numbers of segments, which bars, dots and branches have, too; the names of
// the axes of a volume.
import { placeInImage } from "./cell_geometry";
import { svg } from "./dom";
import { axisNames } from "./slice_view";
import { Spots } from "./spots";
import type { PointCloud } from "./point_cloud";
import type { Report } from "./report";
import type { Session } from "./session";
import type { Stage } from "./stage";

const kPatience = 60, // milliseconds after the last change
  kSize = 12, // of the text, pixels
  kBehind = 1.02; // of the distance of what hides it

interface Label {
  text: string;
  place: [number, number, number];
}

export class Labels {
  readonly element = svg("svg", { class: "numbers", "aria-hidden": "true" });
  private labels: Label[] = [];
  private hidden = new Set<Label>();
  private finding = 0;
  private looking = 0;

  constructor(
    private readonly session: Session,
    private readonly stage: Stage,
    private readonly cloud: PointCloud | undefined,
  ) {
    session.onChange((changes) => {
      const any = (["cut", "colour", "selection", "slice"] as const).some((c) => changes.has(c));
      if (any) this.find();
    });
    this.find();
  }

  /// A moving cut does not wait for it.
  private find(): void {
    clearTimeout(this.finding);
    this.finding = window.setTimeout(() => {
      this.labels = placesOf(this.session);
      this.hidden = this.behind();
      this.show();
    }, kPatience);
  }
  /// To where the picture has their places. What hides some of them is found when it stands still.
  place(): void {
    this.show();
    clearTimeout(this.looking);
    if (!this.cloud || this.labels.length === 0) return;
    this.looking = window.setTimeout(() => {
      this.hidden = this.behind();
      this.show();
    }, kPatience);
  }
  private show(): void {
    const spots = new Spots(kSize);
    const { width, height } = this.stage.shown;
    this.element.replaceChildren(
      ...this.labels.flatMap((label) => {
        const at = this.stage.pixelOf(...label.place);
        if (!at || this.hidden.has(label)) return [];
        const [x, y] = at,
          isIn = x >= 0 && x <= width && y >= 0 && y <= height;
        if (!isIn || !spots.take(x, y, label.text)) return [];
        return [svg("text", { x: x.toFixed(1), y: (y + 4).toFixed(1) }, label.text)];
      }),
    );
  }
  /// Those with other points before them.
  private behind(): Set<Label> {
    const hidden = new Set<Label>();
    const { cloud, stage } = this;
    if (!cloud?.isSurface) return hidden;
    const at = this.labels.map(({ place }) => stage.pixelOf(...place));
    const first = cloud.depthsAt(stage, at);
    this.labels.forEach((label, i) => {
      if (stage.depthOf(...label.place) > kBehind * first[i]!) hidden.add(label);
    });
    return hidden;
  }
}

function placesOf(session: Session): Label[] {
  const { report } = session;
  const leaf = report.elements?.leaf;
  const isVolume = (report.image?.shape[0] ?? 1) > 1;
  if (isVolume) return axesOf(report);
  const numbers = session.numbers();
  if (!session.cut || !leaf || numbers.size === 0) return [];
  const best = middles(session, numbers);
  const labels: Label[] = [];
  for (const number of numbers.values()) {
    const element = best[number]!;
    if (element >= 0) labels.push({ text: String(number), place: placeOf(report, element) });
  }
  return labels;
}

function placeOf({ image, cloud }: Report, element: number): Label["place"] {
  const columns = image?.shape[2] ?? 1;
  if (image) return placeInImage(0, Math.floor(element / columns), element % columns);
  return [0, 1, 2].map((k) => cloud!.positions[3 * element + k]!) as Label["place"];
}

/// The element of each segment that is nearest to its middle: the number lies on it. In an image a
/// segment is its basin up to where it meets another one.
function middles(session: Session, numbers: Map<number, number>): Float64Array {
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
  const best = new Float64Array(most).fill(-1),
    nearest = new Float64Array(most).fill(Infinity);
  for (let i = 0; i < count; ++i) {
    const label = labelOf(i);
    if (label === 0) continue;
    let square = 0;
    for (let k = 0; k < 3; ++k)
      square += (coordinate(i, k) - sums[4 * label + k]! / sums[4 * label + 3]!) ** 2;
    if (square < nearest[label]!) [best[label], nearest[label]] = [i, square];
  }
  return best;
}

/// The names of the axes of a volume, each at the end of its edge of the box.
function axesOf({ image, meta }: Report): Label[] {
  const sizes = image!.shape as [number, number, number];
  const least = [-0.5, -0.5, -0.5] as const;
  return axisNames(meta).map((name, axis) => {
    const at = [...least] as Label["place"];
    at[axis] = sizes[axis]! + 0.05 * Math.max(...sizes);
    return { text: name, place: placeInImage(...at) };
  });
}
