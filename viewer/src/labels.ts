// SPDX-License-Identifier: MIT
// Words on the data: the numbers of segments, which bars, dots and branches have, too; the names of
// the axes of a volume.
import { placeInImage } from "./cell_geometry";
import { svg } from "./dom";
import { axisNames } from "./slice_view";
import type { Report } from "./report";
import type { Session } from "./session";
import type { Stage } from "./stage";

const kPatience = 60; // milliseconds after the last change

interface Label {
  text: string;
  place: [number, number, number];
}

export class Labels {
  readonly element = svg("svg", { class: "numbers", "aria-hidden": "true" });
  private labels: Label[] = [];
  private timer = 0;

  constructor(
    private readonly session: Session,
    private readonly stage: Stage,
  ) {
    session.onChange((changes) => {
      const any = (["cut", "colour", "selection", "slice"] as const).some((c) => changes.has(c));
      if (any) this.find();
    });
    this.find();
  }

  /// A moving cut does not wait for it.
  private find(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => {
      this.labels = placesOf(this.session);
      this.place();
    }, kPatience);
  }
  /// To where the picture has their places.
  place(): void {
    this.element.replaceChildren(
      ...this.labels.flatMap(({ text, place }) => {
        const at = this.stage.pixelOf(...place);
        if (!at) return [];
        return [svg("text", { x: at[0].toFixed(1), y: (at[1] + 4).toFixed(1) }, text)];
      }),
    );
  }
}

function placesOf(session: Session): Label[] {
  const { report } = session;
  const leaf = report.elements?.leaf;
  const isVolume = (report.image?.shape[0] ?? 1) > 1;
  if (isVolume) return axesOf(report);
  if (!session.cut || !leaf) return [];
  const numbers = [...session.numbers().values()];
  const wanted = new Uint8Array(session.cut.segments.length + 1);
  for (const number of numbers) wanted[number] = 1;
  const best = middles(session, wanted);
  const at = placesFrom(report);
  return numbers
    .filter((number) => best[number]! >= 0)
    .map((number) => ({ text: String(number), place: [...at(best[number]!)] as Label["place"] }));
}

/// Where each element is; what is returned is overwritten by the next call.
function placesFrom({ image, cloud }: Report): (element: number) => Label["place"] {
  if (image) return (i) => placeInImage(0, Math.floor(i / image.shape[2]!), i % image.shape[2]!);
  const { positions } = cloud!;
  const place: Label["place"] = [0, 0, 0];
  return (i) => {
    for (let k = 0; k < 3; ++k) place[k] = positions[3 * i + k]!;
    return place;
  };
}

/// The element of each segment that is nearest to its middle: the number lies on it. In an image a
/// segment is its basin up to where it meets another one.
function middles(session: Session, wanted: Uint8Array): Float64Array {
  const { report, cutValue } = session;
  const { count, birth } = report.elements!;
  const limits = new Float64Array(wanted.length).fill(Infinity);
  if (report.image)
    for (const [bar, number] of session.numbers())
      limits[number] = report.tree!.markBasin(report.tree!.branchOf(bar)!, cutValue, () => {});
  const at = placesFrom(report);
  const labelOf = (i: number) => {
    const label = session.segmentOf(i);
    return wanted[label] && !(report.image && birth![i]! >= limits[label]!) ? label : 0;
  };
  const sums = new Float64Array(4 * wanted.length);
  for (let i = 0; i < count; ++i) {
    const label = labelOf(i);
    if (label === 0) continue;
    const place = at(i);
    for (let k = 0; k < 3; ++k) sums[4 * label + k]! += place[k]!;
    ++sums[4 * label + 3]!;
  }
  const best = new Float64Array(wanted.length).fill(-1),
    nearest = new Float64Array(wanted.length).fill(Infinity);
  for (let i = 0; i < count; ++i) {
    const label = labelOf(i);
    if (label === 0) continue;
    const place = at(i);
    let square = 0;
    for (let k = 0; k < 3; ++k)
      square += (place[k]! - sums[4 * label + k]! / sums[4 * label + 3]!) ** 2;
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
