// SPDX-License-Identifier: MIT
// Opens reports as files in headless Chromium, and lists the problems of each page.
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { cropped, decodedPng } from "./png.mjs";
import { reportHtml } from "./write_report.mjs";

const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
const executable = process.env.CHROMIUM ?? "/usr/bin/chromium";
/// The longest wait, in milliseconds; a software renderer takes seconds to draw two million points.
const kPatient = 120_000;

let read;
export function template() {
  const built = process.env.PH_REPORT_TEMPLATE ?? join(root, "build/report-template.html");
  return (read ??= readFileSync(built, "utf8"));
}

/// WebGL is rendered by software, and so are pages, because the software renderer of WebGL draws
/// them slowly.
const optionsOf = (webgl) => ({
  executablePath: executable,
  args: [
    "--no-sandbox",
    ...(webgl
      ? ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-compositing"]
      : ["--disable-gpu", "--disable-3d-apis"]),
  ],
});

export const launch = ({ webgl = true } = {}) => chromium.launch(optionsOf(webgl));

const folder = mkdtempSync(join(tmpdir(), "ph-report-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
let written = 0;

// The next test reuses the page that a test closes, because starting a process for each page would
// take longer than most tests. The page opened last is in front, because a page behind another one
// draws only one frame per second.
const pagesOf = new WeakMap();

async function pageOf(browser, scripts, touch) {
  if (!scripts) return (await browser.newContext({ javaScriptEnabled: false })).newPage();
  if (touch) return (await browser.newContext({ hasTouch: true, isMobile: true })).newPage();
  if (!pagesOf.has(browser))
    pagesOf.set(browser, { context: browser.newContext(), free: [], opened: [] });
  const { context, free, opened } = pagesOf.get(browser);
  const page = free.pop() ?? (await (await context).newPage());
  opened.push(page);
  await page.bringToFront();
  return page;
}

async function release(browser, page) {
  const { free, opened } = pagesOf.get(browser);
  page.removeAllListeners();
  await page.mouse.move(0, 0);
  await page.goto("about:blank");
  opened.splice(opened.indexOf(page), 1);
  free.push(page);
  await opened.at(-1)?.bringToFront();
}

/// Opens a report. `problems` collects errors and warnings in the console, page errors, dialogs,
/// and every request except the request for the file itself.
export async function open(
  browser,
  report,
  {
    width = 1280,
    height = 800,
    dark = false,
    hash = "",
    reducedMotion = null,
    scripts = true,
    touch = false,
  } = {},
) {
  const path = join(folder, `${++written}.html`);
  const html =
    typeof report === "string" ? report : reportHtml(template(), report.meta, report.arrays);
  writeFileSync(path, html);
  const page = await pageOf(browser, scripts, touch);
  await page.setViewportSize({ width, height });
  await page.emulateMedia({ media: null, colorScheme: dark ? "dark" : "light", reducedMotion });
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
  if (!scripts) return { page, problems, close: () => page.context().close() };
  await page.waitForSelector("#app[data-first-frame], .failure", { timeout: 60000 });
  const firstFrame = Number(await page.getAttribute("#app", "data-first-frame"));
  return {
    page,
    problems,
    bytes: html.length,
    firstFrame,
    wall: performance.now() - start,
    close: () => (touch ? page.context().close() : release(browser, page)),
  };
}

/// Opens a report in a separate browser, where the page can be zoomed as by a reader, because an
/// emulated screen reports less to the page. `zoom` returns true if the browser was able to zoom.
export async function openZoomable({ meta, arrays }) {
  const options = { ...optionsOf(true), viewport: null };
  const context = await chromium.launchPersistentContext(join(folder, "profile"), options);
  const path = join(folder, `${++written}.html`);
  writeFileSync(path, reportHtml(template(), meta, arrays));
  const page = await context.newPage();
  await page.goto(pathToFileURL(path).href);
  await page.waitForSelector("#app[data-first-frame]");
  const zoom = async (factor) => {
    const settings = await context.newPage();
    const set = (value) =>
      new Promise((done) => chrome.settingsPrivate.setDefaultZoom(value, () => done(true)));
    const isSet = await settings
      .goto("chrome://settings/appearance")
      .then(() => settings.evaluate(set, factor))
      .catch(() => false);
    await settings.close();
    await page.bringToFront();
    return isSet;
  };
  return { page, zoom, close: () => context.close() };
}

/// The pixels of an element, four bytes each, with their `width` and `height`.
/// @param part the part of the element, as fractions of its sides: [left, top, right, bottom].
export async function pixelsOf(page, selector, part = [0, 0, 1, 1]) {
  const box = await page.locator(selector).first().boundingBox();
  const clip = {
    x: box.x + part[0] * box.width,
    y: box.y + part[1] * box.height,
    width: (part[2] - part[0]) * box.width,
    height: (part[3] - part[1]) * box.height,
  };
  return decodedPng(await page.screenshot({ clip, timeout: kPatient }));
}

/// Boxes of elements, and the pixels of each, all from one screenshot.
export async function allPixelsOf(page, selectors) {
  const boxes = [];
  for (const selector of selectors) boxes.push(await page.locator(selector).first().boundingBox());
  const whole = decodedPng(await page.screenshot({ timeout: kPatient }));
  return boxes.map((box) => cropped(whole, box));
}

/// The number of colours of pixels; an empty view has one.
export const colourCount = (pixels) => new Set(new Uint32Array(pixels.buffer)).size;

export const coloursOf = async (page, selector) => colourCount(await pixelsOf(page, selector));

const hueOf = (r, g, b) =>
  (Math.atan2(Math.sqrt(3) * (g - b), 2 * r - g - b) * (180 / Math.PI) + 360) % 360;

/// The number of pixels far from grey. With a colour, only pixels with the hue of the colour count,
/// whatever the lighting.
export function vividPixels(pixels, spread, colour) {
  const wanted = colour && hueOf(...colour);
  let count = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    const r = pixels[i],
      g = pixels[i + 1],
      b = pixels[i + 2];
    if (Math.max(r, g, b) - Math.min(r, g, b) <= spread) continue;
    if (colour) {
      const away = Math.abs(hueOf(r, g, b) - wanted);
      if (Math.min(away, 360 - away) >= 12) continue;
    }
    ++count;
  }
  return count;
}

export const tintedPixels = async (page, selector, colour) =>
  vividPixels(await pixelsOf(page, selector), 40, colour);

export async function picture(page, name) {
  if (!process.env.PICTURES) return;
  mkdirSync(process.env.PICTURES, { recursive: true });
  await page.screenshot({ path: join(process.env.PICTURES, `${name}.png`), timeout: kPatient });
}

/// A factor for time limits, which are stated for an idle machine.
export const kPatience = Number(process.env.PATIENCE ?? 4);
export const median = (times) => [...times].sort((a, b) => a - b)[times.length >> 1];

/// Waits until the next frame is drawn, because the page handles input once per frame.
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

/// The file that an item of the menu offers.
export async function downloaded(page, label) {
  await page.click("summary");
  const [file] = await Promise.all([
    page.waitForEvent("download"),
    page.click(`.menu >> text=${label}`),
  ]);
  return Buffer.concat(await (await file.createReadStream()).toArray());
}
