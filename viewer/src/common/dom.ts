// SPDX-License-Identifier: MIT
// Creates elements without markup: every text goes through textContent, so that the name of a file
// or a field cannot become HTML.

/// The size of an element in pixels.
export interface Size {
  width: number;
  height: number;
}

type Attributes = Record<string, string | number | boolean | undefined>;
type Child = Node | string | undefined;

function fill<E extends Element>(element: E, attributes: Attributes, children: Child[]): E {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    element.setAttribute(name, value === true ? "" : String(value));
  }
  for (const child of children) if (child !== undefined) element.append(child);
  return element;
}

export function el<K extends keyof HTMLElementTagNameMap>(
  name: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  return fill(document.createElement(name), attributes, children);
}

export function svg<K extends keyof SVGElementTagNameMap>(
  name: K,
  attributes: Attributes = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  return fill(document.createElementNS("http://www.w3.org/2000/svg", name), attributes, children);
}

export function button(
  text: string,
  action: () => void,
  attributes: Attributes = {},
): HTMLButtonElement {
  const element = el("button", { type: "button", ...attributes }, text);
  element.addEventListener("click", action);
  return element;
}

/// A labelled choice; `change` receives the chosen value.
export function select(
  label: string,
  options: [value: string, text: string][],
  value: string,
  change: (value: string) => void,
): HTMLLabelElement {
  const element = el("select", {}, ...options.map(([v, text]) => el("option", { value: v }, text)));
  element.value = value;
  element.addEventListener("change", () => change(element.value));
  return el("label", { class: "field" }, el("span", {}, label), element);
}

/// A table with its own scroll bar; the first row of cells holds the headings.
export function table(
  caption: string,
  head: string[],
  rows: (string | number)[][],
): HTMLTableElement {
  return el(
    "table",
    {},
    el("caption", {}, caption),
    el("thead", {}, el("tr", {}, ...head.map((text) => el("th", { scope: "col" }, text)))),
    el(
      "tbody",
      {},
      ...rows.map((row) => el("tr", {}, ...row.map((cell) => el("td", {}, String(cell))))),
    ),
  );
}

/// True if a key is a shortcut of the browser: zoom, the previous page.
export function isOfBrowser({ ctrlKey, altKey, metaKey }: KeyboardEvent): boolean {
  return ctrlKey || altKey || metaKey;
}

/// Calls `changed` when the size of an element changes, or when the number of screen pixels per
/// page pixel changes, as on another monitor or after a zoom.
export function onResize(element: Element, changed: () => void): void {
  let last = "";
  const look = () => {
    const now = [element.clientWidth, element.clientHeight, window.devicePixelRatio].join();
    if (now !== last) changed();
    last = now;
  };
  new ResizeObserver(look).observe(element);
  if ("devicePixelContentBoxSize" in ResizeObserverEntry.prototype) // WebKit does not support this
    new ResizeObserver(look).observe(element, { box: "device-pixel-content-box" });
}

/// Offers a file to the reader as a download.
export function download(name: string, content: Blob): void {
  const url = URL.createObjectURL(content);
  el("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
