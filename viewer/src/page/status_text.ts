// SPDX-License-Identifier: MIT
import { nameOfBar } from "../charts/bar_chart";
import { counted, digitsFor, exact, grouped, short } from "../common/number_format";
import { factsOf, nameOfSurface } from "../model/scene_words";
import { kindOfSegment } from "../model/words";
import type { Session } from "../model/session";

/// Describes the item under the pointer in words.
export function readingOf(session: Session): string {
  const { focus, cut } = session;
  const words: string[] = [];
  if (focus.element >= 0) words.push(...elementWords(session, focus.element));
  const segment = cut?.segments[focus.segment - 1];
  if (segment) {
    const what = session.report.image ? "voxel" : "point";
    const kind = kindOfSegment(session.report.meta);
    words.push(`${kind} ${session.numberOf(segment.label)}, ${counted(segment.points, what)}`);
    const said = session.saidOf(segment.label);
    if (said) words.push(factsOf(session.report.meta.scene!, said));
  }
  const surface = focus.element >= 0 ? session.surfaceOf(focus.element) : 0;
  if (surface > 0) words.push(nameOfSurface(session.report.meta.scene!, surface));
  if (focus.bar >= 0) words.push(nameOfBar(session, focus.bar));
  return words.join("  ·  ");
}

function elementWords(session: Session, element: number): string[] {
  const { cloud, image, elements } = session.report;
  const words: string[] = [];
  if (cloud) {
    const at = Array.from({ length: cloud.dims }, (_, k) => {
      const value = cloud.positions[3 * element + k]! + cloud.origin[k]!;
      return short(value, digitsFor(Math.abs(value), cloud.extent / 100));
    });
    words.push(`point ${grouped(cloud.index?.[element] ?? element)} (${at.join(", ")})`);
  } else if (image) {
    const [planes, rows, columns] = image.shape as [number, number, number];
    const at = [
      Math.floor(element / (rows * columns)),
      Math.floor(element / columns) % rows,
      element % columns,
    ];
    words.push(
      `voxel (${at.slice(planes === 1 ? 1 : 0).join(", ")}), value ${exact(image.values[element]!)}`,
    );
  }
  if (elements?.truth) words.push(`ground truth ${elements.truth[element]}`);
  return words;
}

/// The selection in a few words.
export function selectionOf(session: Session): string {
  const {
    selection,
    report: { bars },
  } = session;
  if (selection.length === 0) return "nothing selected";
  if (selection.length === 1) return nameOfBar(session, selection[0]!);
  let most = selection[0]!;
  for (const bar of selection) if (bars.persistence(bar) > bars.persistence(most)) most = bar;
  return `${counted(selection.length, "bar")} selected, the most persistent: ${nameOfBar(session, most)}`;
}
