// SPDX-License-Identifier: MIT
// A page of a report in headless Chromium, opened as a file, with what went wrong in it.
import { mkdirSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { reportHtml } from "./write_report.mjs";

const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
const executable = process.env.CHROMIUM ?? "/usr/bin/chromium";
/// Two million points take a software renderer seconds.
const kPatient = 120_000;

export function template() {
  const built = process.env.PH_REPORT_TEMPLATE ?? join(root, "build/report-template.html");
  return readFileSync(built, "utf8");
}

export async function launch({ webgl = true } = {}) {
  const args = [
    "--no-sandbox",
    ...(webgl
      ? ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
      : ["--disable-gpu", "--disable-3d-apis"]),
  ];
  return chromium.launch({ executablePath: executable, args });
}

const folder = mkdtempSync(join(tmpdir(), "ph-report-"));
let written = 0;

/// Opens a report. `problems` collects console errors, page errors, and every request but the file.
export async function open(
  browser,
  report,
  { width = 1280, height = 800, dark = false, hash = "", reducedMotion, scripts = true } = {},
) {
  const path = join(folder, `${++written}.html`);
  const html =
    typeof report === "string" ? report : reportHtml(template(), report.meta, report.arrays);
  writeFileSync(path, html);
  const context = await browser.newContext({
    viewport: { width, height },
    colorScheme: dark ? "dark" : "light",
    reducedMotion,
    javaScriptEnabled: scripts,
    acceptDownloads: true,
  });
  const page = await context.newPage();
  const problems = [];
  page.on(
    "console",
    (m) =>
      ["error", "warning"].includes(m.type()) &&
      !/GPU stall|software WebGL|willReadFrequently/i.test(m.text()) &&
      problems.push(`console: ${m.text()}`),
  );
  page.on("pageerror", (e) => problems.push(`error: ${e.message}`));
  page.on("dialog", (d) => {
    problems.push(`dialog: ${d.message()}`);
    void d.dismiss();
  });
  const url = pathToFileURL(path).href;
  page.on(
    "request",
    (r) =>
      r.url().split("#")[0] !== url &&
      !r.url().startsWith("data:") &&
      !r.url().startsWith("blob:") &&
      problems.push(`request: ${r.url()}`),
  );
  const start = performance.now();
  await page.goto(url + hash);
  if (!scripts) return { page, problems, close: () => context.close() };
  await page.waitForSelector("#app[data-first-frame], .failure", { timeout: 60000 });
  const firstFrame = Number(await page.getAttribute("#app", "data-first-frame"));
  return {
    page,
    problems,
    bytes: html.length,
    firstFrame,
    wall: performance.now() - start,
    close: () => context.close(),
  };
}

/// The pixels of an element, four bytes each, with their `width` and `height`.
export async function pixelsOf(page, selector) {
  const box = await page.locator(selector).first().boundingBox();
  const png = await page.screenshot({ clip: box, timeout: kPatient });
  const { text, width, height } = await page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = image.width;
    canvas.height = image.height;
    const c = canvas.getContext("2d");
    c.drawImage(image, 0, 0);
    const pixels = c.getImageData(0, 0, image.width, image.height).data;
    let text = "";
    for (let i = 0; i < pixels.length; i += 8192)
      text += String.fromCharCode(...pixels.subarray(i, i + 8192));
    return { text: btoa(text), width: image.width, height: image.height };
  }, png.toString("base64"));
  return Object.assign(new Uint8Array(Buffer.from(text, "base64")), { width, height });
}

/// How many colours the pixels of an element have: an empty view has one.
export async function coloursOf(page, selector) {
  const pixels = await pixelsOf(page, selector);
  return new Set(new Uint32Array(pixels.buffer)).size;
}

const hueOf = (r, g, b) =>
  (Math.atan2(Math.sqrt(3) * (g - b), 2 * r - g - b) * (180 / Math.PI) + 360) % 360;

/// How many pixels of an element have the hue of a colour, whatever the light on it.
export async function tintedPixels(page, selector, [r, g, b]) {
  const pixels = await pixelsOf(page, selector),
    wanted = hueOf(r, g, b);
  let count = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    const rgb = pixels.subarray(i, i + 3);
    const vivid = Math.max(...rgb) - Math.min(...rgb) > 40;
    const away = Math.abs(hueOf(...rgb) - wanted);
    if (vivid && Math.min(away, 360 - away) < 12) ++count;
  }
  return count;
}

export async function picture(page, name) {
  if (!process.env.PICTURES) return;
  mkdirSync(process.env.PICTURES, { recursive: true });
  await page.screenshot({ path: join(process.env.PICTURES, `${name}.png`), timeout: kPatient });
}

/// Limits are for an idle machine.
export const kPatience = Number(process.env.PATIENCE ?? 4);
export const median = (times) => [...times].sort((a, b) => a - b)[times.length >> 1];

/// Input waits for the next frame.
export const frame = (page) =>
  page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
  );

export async function setSlider(page, selector, value) {
  await page.$eval(
    selector,
    (input, v) => {
      input.value = v;
      input.dispatchEvent(new Event("input", { bubbles: true }));
    },
    String(value),
  );
  await frame(page);
}
