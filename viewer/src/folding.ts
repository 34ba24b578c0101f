// SPDX-License-Identifier: MIT
// Panels that say nothing about these data are folded away: their title stays, and a button that
// opens them.
import { button } from "./dom";
import type { Session } from "./session";

/// Adds the button. @param folded how the panel begins. @return folds it, or opens it.
export function foldable(
  panel: HTMLElement,
  title: string,
  folded: boolean,
): (fold: boolean) => void {
  const toggle = button("", () => show(!panel.classList.contains("folded")), { class: "quiet fold" });
  const show = (fold: boolean) => {
    panel.classList.toggle("folded", fold);
    toggle.textContent = fold ? "show" : "hide";
    toggle.setAttribute("aria-expanded", String(!fold));
    toggle.setAttribute("aria-label", `${fold ? "show" : "hide"}: ${title}`);
  };
  panel.querySelector("header")!.append(toggle);
  show(folded);
  return show;
}

/// Whether a cut of the tree says something: there are components that stand out, or the data begin
/// with the colours of several segments and another cut has other ones.
export function cutSays(session: Session): boolean {
  const { tree } = session.report;
  if (!tree || tree.merges === 0) return false;
  if (session.answer.components) return true;
  const coloured = session.colour === "segment" && session.cut!.segments.length > 1;
  return (coloured || !session.report.elements) && changesWithTheCut(session);
}

function changesWithTheCut({ report }: Session): boolean {
  const tree = report.tree!,
    { from, to } = report.meta.tree!;
  const count = (cut: number) => tree.cut(cut, false).segments.length;
  let highest = 0;
  for (const level of tree.arrays.levels) if (level < Infinity) highest = Math.max(highest, level);
  return count(from ?? 0) !== count(to ?? 1.1 * highest);
}
