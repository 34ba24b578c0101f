// SPDX-License-Identifier: MIT
// Tests the positions of panels, controls and words, at any width and on any screen.
import assert from "node:assert/strict";
import test from "node:test";
import { barArrays, byOrder, metaOf } from "./support/fixture_parts.mjs";
import { image } from "./support/image_fixture.mjs";
import { illegible, textsOf } from "./support/chart_texts.mjs";
import { treeOnly } from "./support/odd_fixtures.mjs";
import { frame, launch, open, openZoomable, picture } from "./support/browser.mjs";
import { clusters } from "./support/point_fixtures.mjs";
import { scene } from "./support/scene_fixture.mjs";

const kWidths = [320, 390, 620, 761, 768, 809, 900, 1024, 1153, 1280, 2560];

/// A report whose values are mapped by `valueOf` and negated at the axes.
function elsewhere({ meta, arrays }, valueOf) {
  const isValue = (name) => /\/(birth|death|leaf_birth|merge_value|merge_level)$/.test(name);
  const moved = Object.entries(arrays).map(([name, values]) => [
    name,
    isValue(name) ? values.map(valueOf) : values,
  ]);
  const { tree, ...rest } = meta;
  return {
    meta: { ...rest, tree: { ...tree, cut: valueOf(tree.cut) }, value: { ...meta.value, negated: true } },
    arrays: Object.fromEntries(moved),
  };
}

/// Controls that are outside their panel or covered by something else.
const unreachable = (page) =>
  page.evaluate(() => {
    const bad = [];
    for (const panel of document.querySelectorAll(".panel, .top")) {
      // Scrolling to the control could move it within its panel.
      panel.scrollIntoView({ block: "start" });
      for (const control of panel.querySelectorAll("header button, header select, header input, nav > *")) {
        if (!control.checkVisibility() || control.closest("dialog, .items")) continue;
        const box = control.getBoundingClientRect(),
          around = panel.getBoundingClientRect();
        const at = document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
        const isIn = box.left >= around.left && box.right <= around.right && box.right <= innerWidth;
        if (!isIn || !control.contains(at)) bad.push(`${panel.className}: ${control.textContent}`);
      }
    }
    return bad;
  });

test("pictures are as fine as the screen when the page is zoomed", { timeout: 60_000 }, async (t) => {
  const { page, zoom, close } = await openZoomable(clusters());
  t.after(close);
  for (const factor of [1.5, 1]) {
    if (!(await zoom(factor))) return t.skip("this browser has no page of settings");
    await page.waitForFunction(
      (ratio) =>
        devicePixelRatio === ratio &&
        [...document.querySelectorAll("canvas")].every(
          (canvas) => Math.abs(canvas.width / canvas.clientWidth - ratio) < 0.02,
        ),
      factor,
      { timeout: 10_000 },
    );
  }
});

test("layout", { timeout: 200_000 }, async (t) => {
  const browser = await launch();
  t.after(() => browser.close());

  await t.test("on a telephone the panels of a report without data are readable", async () => {
    for (const [width, height] of [[390, 844], [320, 700]]) {
      const { page, problems, close } = await open(browser, treeOnly(), { width, height });
      const boxes = [];
      for (const [panel, least] of [[".cut", 120], [".tree", 300], [".diagram", 300], [".barcode", 300]]) {
        const box = await page.locator(`.panel${panel}`).boundingBox();
        assert.ok(box.height >= least, `${panel} has ${box.height} pixels`);
        boxes.push(box);
      }
      boxes.reduce((above, box) => (assert.ok(box.y >= above.y + above.height), box));
      const chart = await page.locator(".cut .chart").boundingBox();
      assert.ok(chart.y + chart.height <= boxes[0].y + boxes[0].height, "the cut is in its panel");
      await picture(page, `layout_tree_${width}`);
      assert.deepEqual(problems, []);
      await close();
    }
  });

  await t.test("every control can be reached at every width", async () => {
    for (const [name, make] of Object.entries({ clusters, image, treeOnly, scene })) {
      const { page, close } = await open(browser, make());
      for (const width of kWidths) {
        await page.setViewportSize({ width, height: 800 });
        await frame(page);
        assert.deepEqual(await unreachable(page), [], `${name} at ${width}`);
        const isWide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
        assert.ok(!isWide, `${name} at ${width}`);
      }
      await close();
    }
  });

  await t.test("long numbers at the axes are not cut off", async () => {
    for (const [valueOf, label] of [
      [(v) => 999.99 + 0.001 * v, /^−99\d\.\d{3}/],
      [(v) => 10_000 + v, /^−1\d{4}/],
      [(v) => 1 + 1e-7 * v, /^−1\.\d{7}/],
    ])
      for (const width of [320, 1280]) {
        const report = elsewhere(treeOnly(), valueOf);
        const { page, close } = await open(browser, report, { width, height: 800 });
        for (const chart of [".diagram", ".tree", ".barcode"]) {
          const drawn = await textsOf(page, chart);
          assert.ok(drawn.texts.some(({ text }) => label.test(text)), `${chart}: ${drawn.texts.map(({ text }) => text)}`);
          assert.deepEqual(illegible(drawn), [], `${chart} at ${width}`);
        }
        await close();
      }
  });

  await t.test("on a narrow page words do not lie on each other", async () => {
    const bars = [[0, 0, Infinity]];
    for (let i = 0; i < 40; ++i)
      bars.push([0, 0, 1], [0, 0, 1.02], [0, 0.01, 1], [1, 1.9, 2.9], ...(i ? [[1, 1.9, 2.95]] : []));
    const crowds = { meta: metaOf("crowds.csv"), arrays: barArrays(bars.sort(byOrder)) };
    const { page, close } = await open(browser, crowds, { width: 320, height: 700 });
    const drawn = await textsOf(page, ".diagram");
    assert.deepEqual(illegible(drawn), []);
    const counts = drawn.texts.filter(({ text }) => /here/.test(text));
    assert.ok(counts.length >= 2 && counts.every(({ text }) => text === "40 here"), "the largest");
    await close();
    for (const factor of [1, 1.2345e-9]) {
      const report = elsewhere(treeOnly(), (v) => factor * v);
      const cut = await open(browser, report, { width: 320, height: 700 });
      const { texts, ...size } = await textsOf(cut.page, ".cut");
      assert.ok(texts.some(({ text }) => /^segments/.test(text)));
      assert.deepEqual(illegible({ texts, ...size }), []);
      await cut.close();
    }
  });

  await t.test("a crowd of thousands is counted as a whole", async () => {
    const bars = [[0, 0, Infinity], [1, 0.5, 3]];
    for (let i = 0; i < 5000; ++i) bars.push([0, 0, 1]);
    const report = { meta: metaOf("equal.csv"), arrays: barArrays(bars.sort(byOrder)) };
    const { page, close } = await open(browser, report);
    const { texts } = await textsOf(page, ".diagram");
    assert.deepEqual(texts.filter(({ text }) => /here/.test(text)).map(({ text }) => text), ["5,000 here"]);
    await close();
  });

  await t.test("a chart that has not heard of another screen is whole", async () => {
    const { page, close } = await open(browser, clusters(), { width: 1000, height: 700 });
    const session = await page.context().newCDPSession(page);
    const screen = { width: 1000, height: 700, mobile: false, deviceScaleFactor: 2 };
    await session.send("Emulation.setDeviceMetricsOverride", screen);
    await page.waitForFunction(() => devicePixelRatio === 2);
    await page.focus(".diagram canvas.over");
    await page.keyboard.press("ArrowRight");
    await frame(page);
    const [drawn, canvas] = await page.$eval(".diagram canvas.over", (over) => [
      over.getContext("2d").getTransform().a,
      over.width / over.clientWidth,
    ]);
    assert.equal(drawn, canvas);
    await session.send("Emulation.clearDeviceMetricsOverride");
    await close();
  });

  await t.test("a finger on a chart scrolls the page, on the diagram it draws a lasso", async () => {
    const phone = { width: 390, height: 844, touch: true };
    const { page, close } = await open(browser, treeOnly(), phone);
    const session = await page.context().newCDPSession(page);
    // The page continues to scroll for a while after the finger has left it.
    const atRest = async () => {
      for (let last = NaN, still = 0, tries = 0; ; ++tries) {
        const now = await page.evaluate(() => scrollY);
        still = now === last ? still + 1 : 0;
        if (still === 10 || tries === 300) return now;
        last = now;
        await frame(page);
      }
    };
    const scrolled = async (chart) => {
      await page.$eval(chart, (panel) => panel.scrollIntoView({ block: "center" }));
      const before = await atRest();
      const box = await page.locator(`${chart} canvas.over`).boundingBox();
      const touch = (type, ...places) =>
        session.send("Input.dispatchTouchEvent", {
          type,
          touchPoints: places.map((y) => ({ x: box.x + box.width / 2, y: box.y + box.height / 2 + y })),
        });
      await touch("touchStart", 0);
      for (let y = 0; y <= 150; y += 10) await touch("touchMove", y).then(() => frame(page));
      await touch("touchEnd");
      await frame(page);
      return before - (await page.evaluate(() => scrollY));
    };
    for (const chart of [".tree", ".barcode"])
      assert.ok((await scrolled(chart)) > 50, `${chart} does not scroll`);
    assert.equal(await scrolled(".diagram"), 0);
    await close();
  });
});
