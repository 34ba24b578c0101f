// SPDX-License-Identifier: MIT
// Folds away panels that say nothing about the data. The title of a folded panel remains, with a
// button that opens it.
import { button } from "../common/dom";
import type { Session } from "../model/session";

/// Adds the button that folds and opens a panel. @param folded true if the panel starts folded.
/// @return a function that opens the panel, unless the reader has already used the button.
export function foldable(panel: HTMLElement, title: string, folded: boolean): () => void {
  let isDecided = false;
  const act = () => {
    isDecided = true;
    show(!panel.classList.contains("folded"));
  };
  const toggle = button("", act, { class: "quiet fold" });
  const show = (fold: boolean) => {
    panel.classList.toggle("folded", fold);
    toggle.textContent = fold ? "show" : "hide";
    toggle.setAttribute("aria-expanded", String(!fold));
    toggle.setAttribute("aria-label", `${fold ? "show" : "hide"}: ${title}`);
  };
  panel.querySelector("header")!.append(toggle);
  show(folded);
  return () => {
    if (!isDecided) show(false);
  };
}

/// True if the cut of the tree is informative. One reason is that components stand out. The other
/// is that different cuts have different numbers of segments, and the page shows several colours of
/// segments or no data.
/// @param counts numbers of segments at cuts along the slider.
export function cutSays(session: Session, counts: number[]): boolean {
  const { tree } = session.report;
  if (!tree || tree.merges === 0) return false;
  if (session.finding.components) return true;
  const coloured = session.colour === "segment" && session.cut!.segments.length > 1;
  return (coloured || !session.report.elements) && new Set(counts).size > 1;
}
