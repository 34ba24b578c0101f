// SPDX-License-Identifier: MIT
// The rows beneath the data, which select the slice of a volume and the value up to which the
// complex is shown.
import { el, select } from "../common/dom";
import { axisNames } from "../model/volume_axes";
import type { Session } from "../model/session";

export function sliceControls(session: Session, shape: number[]): HTMLElement {
  const slider = el("input", { type: "range", min: 0, step: 1, "aria-label": "slice" });
  const number = el("output", {});
  const axes = axisNames(session.report.meta).map((name, k) => [String(k), name] as [string, string]);
  const choice = select("slice across", axes, String(session.sliceAxis), (value) => {
    session.set("sliceAxis", Number(value), "slice");
    session.set("slice", Math.floor(shape[Number(value)]! / 2), "slice");
  });
  const show = () => {
    choice.querySelector("select")!.value = String(session.sliceAxis);
    slider.max = String(shape[session.sliceAxis]! - 1);
    slider.value = String(session.slice);
    number.textContent = String(session.slice);
  };
  slider.addEventListener("input", () => session.set("slice", Number(slider.value), "slice"));
  session.onChange((changes) => changes.has("slice") && show());
  show();
  return el("div", { class: "row" }, choice, slider, number);
}

export function scrubber(session: Session, reading: HTMLOutputElement): HTMLElement {
  const { bars, meta } = session.report;
  const kSteps = 500;
  const direction = meta.value.negated ? "down to" : "up to";
  const label = `${meta.value.label.toLowerCase()} ${direction}`;
  const slider = el("input", {
    type: "range",
    min: 0,
    max: kSteps,
    step: 1,
    "aria-label": label,
  });
  slider.addEventListener("input", () => {
    const place = Number(slider.value) / kSteps;
    session.set(
      "scale",
      place === 1 ? undefined : bars.low * (1 - place) + bars.high * place,
      "scale",
    );
  });
  const show = () => {
    const { scale } = session;
    slider.value = String(
      scale === undefined
        ? kSteps
        : Math.round((kSteps * (scale - bars.low)) / (bars.high - bars.low || 1)),
    );
  };
  session.onChange((changes) => changes.has("scale") && show());
  show();
  // The displayed value changes after the slider.
  const say = () => slider.setAttribute("aria-valuetext", reading.textContent ?? "");
  new MutationObserver(say).observe(reading, { childList: true, characterData: true, subtree: true });
  return el("div", { class: "row scrubber" }, el("span", {}, label), slider, reading);
}
