// SPDX-License-Identifier: MIT
// Opens every synthetic report in headless Chromium: each view shows something, without console
// errors, requests or dialogs. Screenshots go to the folder that PICTURES names.
import assert from "node:assert/strict";
import test from "node:test";
import * as odd from "./support/odd_fixtures.mjs";
import { image } from "./support/image_fixture.mjs";
import { clusters, torus } from "./support/point_fixtures.mjs";
import { reportHtml } from "./support/write_report.mjs";
import {
  allPixelsOf,
  coloursOf,
  downloaded,
  frame,
  launch,
  open,
  picture,
  setSlider,
  template,
  vividPixels,
} from "./support/browser.mjs";

const kCharts = [".diagram .chart", ".barcode .chart"];
const cases = {
  torus: [torus, [...kCharts, ".stage"]],
  clusters: [clusters, [...kCharts, ".stage", ".cut .chart", ".tree .chart"]],
  image: [image, [...kCharts, ".stage", ".cut .chart", ".tree .chart"]],
  volume: [() => image([28, 36, 44]), [...kCharts, ".stage", ".cut .chart", ".tree .chart"]],
  empty: [odd.empty, []],
  single_point: [odd.singlePoint, [".barcode .chart", ".stage"]],
  hostile: [odd.hostile, kCharts],
  two_barcodes: [odd.twoBarcodes, kCharts],
  infinite_only: [odd.infiniteOnly, kCharts],
  many_dims: [odd.manyDims, kCharts],
  ties: [odd.ties, kCharts],
  tree_only: [odd.treeOnly, [...kCharts, ".cut .chart", ".tree .chart"]],
  extreme: [odd.extreme, [...kCharts, ".stage"]],
};

/// A volume whose axes have names.
function volume() {
  const { meta, arrays } = image([12, 20, 24]);
  return { meta: { ...meta, image: { ...meta.image, axes: ["x", "y", "z"] } }, arrays };
}

/// Asserts that a chart shows colours, and that the data have more than one colour.
function assertShows(view, pixels) {
  if (view !== ".stage") return assert.ok(vividPixels(pixels, 25) > 30, `${view} is empty`);
  const counts = new Map();
  for (const p of new Uint32Array(pixels.buffer)) counts.set(p, (counts.get(p) ?? 0) + 1);
  const other = pixels.length / 4 - Math.max(...counts.values());
  assert.ok(other > 20, `${view}: ${other} pixels are not the background`);
}

test("pages", { timeout: 500_000 }, async (t) => {
  const browser = await launch();
  t.after(() => browser.close());
  for (const [name, [make, views]] of Object.entries(cases))
    await t.test(name, async (tt) => {
      const { page, problems, firstFrame, bytes, close } = await open(browser, make());
      const look = async (theme) => {
        await frame(page);
        (await allPixelsOf(page, views)).forEach((pixels, i) => assertShows(views[i], pixels));
        await picture(page, `${name}${theme}`);
      };
      await look("");
      await page.emulateMedia({ colorScheme: "dark" });
      await look("_dark");
      await page.emulateMedia({ colorScheme: "light" });
      await page.setViewportSize({ width: 900, height: 800 });
      await frame(page);
      await picture(page, `${name}_900`);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
      assert.ok(!wide, "the page is wider than the window");
      assert.deepEqual(problems, []);
      tt.diagnostic(`${(bytes / 2 ** 20).toFixed(2)} MiB, first frame ${firstFrame} ms`);
      await close();
    });

  await t.test("a page that opens dark", async () => {
    for (const name of ["torus", "image"]) {
      const [make, views] = cases[name];
      const { page, problems, close } = await open(browser, make(), { dark: true });
      (await allPixelsOf(page, views)).forEach((pixels, i) => {
        assertShows(views[i], pixels);
        if (views[i] !== ".stage") assert.ok(pixels[0] < 60, `${views[i]} is not dark`);
      });
      assert.deepEqual(problems, []);
      await close();
    }
  });

  await t.test("hostile names stay text", async () => {
    const { page, problems, close } = await open(browser, odd.hostile());
    assert.equal(await page.locator("img").count(), 0);
    assert.match(await page.textContent("h1"), /^<script>alert\(1\)<\/script><img/);
    await page.click("text=About");
    assert.match(await page.textContent("dialog[open] code"), /'it'\\''s; rm -rf \/'/);
    assert.equal(await page.locator("dialog[open] img, dialog[open] script").count(), 0);
    await page.keyboard.press("Escape");
    const svg = (await downloaded(page, "Picture, SVG")).toString();
    assert.match(svg, /&lt;script&gt;/);
    assert.doesNotMatch(svg, /<script/);
    assert.deepEqual(problems, []);
    await close();
  });

  await t.test("an inline script that is not the page's own does not run", async () => {
    const { meta, arrays } = odd.empty();
    const html = reportHtml(template(), meta, arrays).replace(
      '<div id="app"',
      `<script>document.title = "owned"</script><div onclick="x()" style="color:red" id="x"></div><div id="app"`,
    );
    const { page, problems, close } = await open(browser, html);
    assert.equal(await page.title(), "empty.csv");
    assert.ok(problems.some((p) => /Content Security Policy/.test(p)));
    await close();
  });

  await t.test("every control has a name, and the keyboard reaches it", async () => {
    for (const make of [torus, image, odd.twoBarcodes]) {
      const { page, close } = await open(browser, make());
      const nameless = await page.$$eval(
        "button, input, select, summary, canvas[role=img], section, svg:not([aria-hidden])",
        (all) =>
          all
            .filter((e) => !e.closest("dialog:not([open])") && !e.closest("details:not([open]) .items"))
            .filter((e) => {
              const label = e.closest("label")?.textContent;
              return !(e.getAttribute("aria-label") || label || e.textContent).trim();
            })
            .map((e) => e.outerHTML.slice(0, 80)),
      );
      assert.deepEqual(nameless, []);
      const wanted = await page.$$eval("button, input, select, summary, canvas[role=img]", (all) =>
        all.filter((e) => !e.disabled && e.checkVisibility() && e.tabIndex >= 0).length,
      );
      await page.evaluate(() => {
        window.reached = new Set();
        document.addEventListener("focusin", (event) => window.reached.add(event.target));
      });
      for (let i = 0; i < 2 * wanted; ++i) await page.keyboard.press("Tab");
      const reached = await page.evaluate(() => window.reached.size);
      assert.ok(wanted > 5 && reached >= wanted, `${reached} of ${wanted}`);
      assert.equal(await page.getAttribute(".status .reading", "aria-live"), "polite");
      await close();
    }
  });

  await t.test("on paper there are no controls; what moves, stands still if asked to", async () => {
    const { page, close } = await open(browser, torus(), { reducedMotion: "reduce" });
    const duration = () =>
      page.$eval(".top button", (e) => getComputedStyle(e).transitionDuration);
    assert.equal(await duration(), "0s");
    await page.emulateMedia({ reducedMotion: "no-preference" });
    assert.notEqual(await duration(), "0s");
    assert.ok(await page.locator(".top button").first().isVisible());
    await page.emulateMedia({ media: "print" });
    const controls = page.locator("button:not(.chip):visible, select:visible, input:visible");
    assert.equal(await controls.count(), 0); // chips name the dimensions
    assert.ok(await page.locator(".diagram canvas").first().isVisible());
    await close();
    assert.match(template(), /http-equiv="Content-Security-Policy" content="default-src 'none'; /);
  });

  await t.test("two barcodes: how far they are apart", async () => {
    const { page, close } = await open(browser, odd.twoBarcodes());
    const words = /H₀ bottleneck 0\.0123.*H₁ bottleneck ∞/s;
    assert.match(await page.textContent(".title p"), words);
    await page.click("text=About");
    assert.match(await page.textContent("dialog[open]"), words);
    await close();
  });

  await t.test("where cut and tree are folded, the other panels have the page", async () => {
    const { page, close } = await open(browser, odd.treeOnly());
    const width = async () => (await page.locator(".column.right").boundingBox()).width;
    const before = await width();
    for (const panel of [".cut", ".tree"]) await page.click(`${panel} .fold`);
    const after = await width();
    assert.ok(before < 800 && after > 1200, `${before}, then ${after} pixels`);
    await close();
  });

  await t.test("an address names a slice", async () => {
    const { page, problems, close } = await open(browser, image([8, 10, 12]), { hash: "#slice=2,5" });
    const row = page.locator(".row", { has: page.getByLabel("slice", { exact: true }) }).first();
    assert.equal(await row.locator("select").inputValue(), "2");
    assert.equal(await row.locator("output").textContent(), "5");
    await row.locator("select").selectOption("1");
    await page.waitForFunction(() => location.hash.includes("slice=1,5"));
    // The other slice is seen from the place in the address, not from its front.
    const view = "view=30,9,40,5,-4,4,1";
    await page.evaluate((v) => (location.hash = `slice=0,3&${v}`), view);
    await frame(page);
    await setSlider(page, '.row input[aria-label="slice"]', 4);
    await page.waitForFunction(() => location.hash.includes("slice=0,4"));
    assert.ok((await page.evaluate(() => location.hash)).endsWith(view), await page.evaluate(() => location.hash));
    assert.deepEqual(problems, []);
    await close();
  });

  await t.test("a frame of a notebook, which has no address and may do nothing", async () => {
    const { meta, arrays } = clusters();
    const html = reportHtml(template(), meta, arrays);
    const escaped = html.replaceAll("&", "&amp;").replaceAll('"', "&quot;");
    const page = await browser.newPage();
    const problems = [];
    page.on("pageerror", (e) => problems.push(e.message));
    page.on("request", (r) => r.url().startsWith("http") && problems.push(r.url()));
    await page.setContent(
      `<iframe sandbox="allow-scripts" width="1000" height="700" srcdoc="${escaped}"></iframe>`,
    );
    const inner = page.frameLocator("iframe");
    await inner.locator("#app[data-first-frame]").waitFor();
    await inner.locator(".chip").first().click(); // elsewhere, the address keeps this state
    await page.waitForTimeout(400);
    assert.ok(await inner.locator(".diagram canvas").first().isVisible());
    assert.deepEqual(problems, []);
    await page.close();
  });

  await t.test("what is no report says so", async () => {
    const { page, close } = await open(browser, template());
    assert.match(await page.textContent(".failure"), /holds no report/);
    await close();
    const { meta, arrays } = odd.ties();
    const bad = await open(browser, {
      meta,
      arrays: { ...arrays, "bars/death": new Float64Array(3) },
    });
    assert.match(await bad.page.textContent(".failure"), /different lengths/);
    await bad.close();
  });
});

test(
  "without WebGL there is a still picture",
  { timeout: 120_000 },
  async (t) => {
    const browser = await launch({ webgl: false });
    t.after(() => browser.close());
    for (const [name, make] of Object.entries({ torus, image, volume })) {
      const { page, problems, close } = await open(browser, make());
      assert.ok((await page.locator("svg.still > *").count()) > 1);
      assert.ok((await coloursOf(page, ".stage")) > 4);
      await picture(page, `${name}_no_webgl`);
      assert.deepEqual(problems, []);
      if (name === "image") {
        // The loop runs along the middles of pixels, from a quarter to three quarters of each side.
        const at = await page.$eval("svg.still", (still) => {
          const boxOf = (elements) => {
            const boxes = elements.map((e) => e.getBBox()).map((b) => [b.x, b.y, b.x + b.width, b.y + b.height]);
            return boxes.reduce((a, b) => [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])]);
          };
          const { a, b, c, d, e, f } = still.querySelector("image").transform.baseVal[0].matrix;
          const loop = boxOf([...still.querySelectorAll('line[stroke-width="3.5"]')]);
          return { skew: [b, c], loop: loop.map((v, k) => (k % 2 ? (v - f) / d : (v - e) / a)) };
        });
        assert.ok(at.skew.every((v) => Math.abs(v) < 1e-6));
        [40.5, 30.5, 120.5, 90.5].forEach((v, k) => assert.ok(Math.abs(at.loop[k] - v) < 0.1, `${at.loop}`));
        const style = await page.$eval(".still image", (e) => getComputedStyle(e).imageRendering);
        assert.equal(style, "pixelated");
      }
      if (name === "volume") {
        // The slice across z: x to the right, y up.
        const middle = async (selector) => {
          const box = await page.locator(selector).boundingBox();
          return [box.x + box.width / 2, box.y + box.height / 2];
        };
        const [slice, x, y, z] = await Promise.all(
          ["image", ...["x", "y", "z"].map((axis) => `text:text-is("${axis}")`)].map((what) =>
            middle(`.still ${what}`),
          ),
        );
        assert.ok(x[0] > slice[0] && Math.abs(x[0] - z[0]) > Math.abs(x[1] - z[1]), `${x}, ${z}`);
        assert.ok(y[1] < slice[1] && y[1] < Math.min(x[1], z[1]), `${y}`);
        const before = await page.getAttribute(".still image", "transform");
        await page.locator(".row select").selectOption("0");
        await frame(page);
        assert.notEqual(await page.getAttribute(".still image", "transform"), before);
      }
      await close();
    }
  },
);
