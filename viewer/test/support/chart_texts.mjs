// SPDX-License-Identifier: MIT
// Records the texts that a chart draws and their places, because a canvas keeps only pixels.
import { frame } from "./browser.mjs";

/// Redraws the charts. @return for each text of a chart, on both canvases, `text` and its box in
/// CSS pixels from the upper left corner of the chart; and the `width` and `height` of the chart.
export async function textsOf(page, chart) {
  await page.evaluate(() => {
    if (window.written) return;
    window.written = new Map();
    const pen = CanvasRenderingContext2D.prototype;
    const { clearRect, fillText } = pen;
    pen.clearRect = function (...box) {
      window.written.set(this.canvas, []);
      return clearRect.apply(this, box);
    };
    pen.fillText = function (text, x, y) {
      const { width } = this.measureText(text);
      const from = this.textAlign === "center" ? x - width / 2 : this.textAlign === "end" ? x - width : x;
      const size = parseFloat(/([\d.]+)px/.exec(this.font)[1]);
      const scale = this.canvas.width / this.canvas.clientWidth;
      const corners = [[from, y - 0.72 * size], [from + width, y]].map(([u, v]) =>
        this.getTransform().transformPoint({ x: u, y: v }),
      );
      const ends = (name) => corners.map((corner) => corner[name] / scale).sort((a, b) => a - b);
      const [[left, right], [top, bottom]] = [ends("x"), ends("y")];
      window.written.get(this.canvas)?.push({ text, left, right, top, bottom });
      return fillText.call(this, text, x, y);
    };
  });
  const { width, height } = page.viewportSize();
  for (const other of [width + 16, width]) {
    await page.setViewportSize({ width: other, height });
    await frame(page);
  }
  return page.$eval(`${chart} .chart`, (body) => ({
    width: body.clientWidth,
    height: body.clientHeight,
    texts: [...body.querySelectorAll("canvas")].flatMap((canvas) => window.written.get(canvas) ?? []),
  }));
}

const meet = (a, b) =>
  Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 &&
  Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;

/// The texts of a chart that are cut off, and pairs that overlap.
export function illegible({ texts, width, height }) {
  const isOut = ({ left, right, top, bottom }) =>
    left < -0.5 || top < -0.5 || right > width + 0.5 || bottom > height + 0.5;
  const pairs = texts.flatMap((a, i) => texts.slice(i + 1).map((b) => [a, b]));
  return [
    ...texts.filter(isOut).map(({ text }) => `${text} is cut off`),
    ...pairs.filter(([a, b]) => meet(a, b)).map(([a, b]) => `${a.text} on ${b.text}`),
  ];
}
