// SPDX-License-Identifier: MIT
// Tests that highlights and selections in one view appear in all views, that the slider makes the
// same cuts as the programs, and that exactly the selection is exported.
import assert from "node:assert/strict";
import test from "node:test";
import { image } from "./support/image_fixture.mjs";
import { torus } from "./support/point_fixtures.mjs";
import { scene } from "./support/scene_fixture.mjs";
import { cutOf } from "./support/reference_tree.mjs";
import {
  coloursOf,
  downloaded,
  frame,
  launch,
  open,
  picture,
  pixelsOf,
  setSlider,
  tintedPixels,
  vividPixels,
} from "./support/browser.mjs";

const reading = (page) => page.textContent(".status .reading");
const selection = (page) => page.textContent(".status .selection");
/// The number of pixels that are not empty on the canvas over a chart.
const drawnOver = (page, chart) =>
  page.evaluate((name) => {
    const canvas = document.querySelector(`${name} canvas.over`);
    const data = canvas
      .getContext("2d", { willReadFrequently: true })
      .getImageData(0, 0, canvas.width, canvas.height).data;
    let drawn = 0;
    for (let i = 3; i < data.length; i += 4) if (data[i] > 0) ++drawn;
    return drawn;
  }, chart);

test("a link shows the same view", { timeout: 120_000 }, async (t) => {
  const browser = await launch();
  t.after(() => browser.close());
  for (const [name, make] of Object.entries({ image: () => image([60, 150]), scene })) {
    const report = make();
    const { page, close } = await open(browser, report);
    const box = await page.locator(".stage canvas").boundingBox();
    await page.mouse.move(box.x + 0.6 * box.width, box.y + box.height / 2);
    await page.mouse.wheel(0, -120);
    await page.waitForFunction(() => location.hash.includes("view="));
    await page.mouse.move(0, 0);
    const hash = await page.evaluate(() => location.hash);
    const seen = await pixelsOf(page, ".stage");
    const again = await open(browser, report, { hash });
    const shown = await pixelsOf(again.page, ".stage");
    let others = 0;
    for (let i = 0; i < seen.length; i += 4) if (Math.abs(seen[i] - shown[i]) > 40) ++others;
    assert.ok(others < 0.02 * (seen.length / 4), `${name}: ${others} of ${seen.length / 4} pixels`);
    await again.close();
    await close();
  }
});

test("linked views", { timeout: 300_000 }, async (t) => {
  const browser = await launch();
  t.after(() => browser.close());
  const report = torus();
  const { page, problems, close } = await open(browser, report);

  await t.test("the keyboard goes through the bars, all views follow", async () => {
    await page.focus(".diagram canvas.over");
    for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowRight");
    await frame(page);
    assert.match(await reading(page), /^H₁ \[0\.36, 2\.05\)|^H₁ \[0\.31, 1\.33\)|^H₂/);
    assert.ok((await drawnOver(page, ".barcode")) > 20 && (await drawnOver(page, ".diagram")) > 20);
    await page.keyboard.press("Enter");
    await frame(page);
    assert.match(await selection(page), /^H/);
    assert.ok((await coloursOf(page, ".stage")) > 4);
    await picture(page, "torus_selected");
    await page.keyboard.press("Escape");
    await frame(page);
    assert.equal(await selection(page), "nothing selected");
    for (let i = 0; i < 2; ++i) await page.keyboard.press("Shift+ArrowRight");
    await frame(page);
    assert.match(await selection(page), /^3 bars selected/);
    await page.keyboard.press("Shift+PageUp");
    await frame(page);
    assert.match(await selection(page), /^5 bars selected/);
    await page.keyboard.press("Escape");
    await frame(page);
  });

  await t.test(
    "a lasso selects, and the selection is exported as the programs write it",
    async () => {
      const box = await page.locator(".diagram canvas.over").boundingBox();
      const at = (x, y) => [box.x + x * box.width, box.y + y * box.height];
      await page.mouse.move(...at(0.13, 0.06));
      await page.mouse.down();
      for (const corner of [
        [0.45, 0.06],
        [0.45, 0.62],
        [0.13, 0.62],
        [0.13, 0.07],
      ])
        await page.mouse.move(...at(...corner), { steps: 4 });
      await page.mouse.up();
      await frame(page);
      assert.match(await selection(page), /^3 bars selected/);
      await picture(page, "torus_lasso");
      const csv = (await downloaded(page, "Selected bars, CSV")).toString();
      assert.equal(csv, "dim,birth,death\n1,0.31,1.33\n1,0.36,2.05\n2,0.52,1.36\n");
      const json = JSON.parse((await downloaded(page, "JSON")).toString());
      assert.equal(json.bars.length, 3);
      assert.equal(json.format, "ph-barcode");
      for (const member of ["program", "input", "timings", "peak_memory"])
        assert.ok(json[member] !== undefined, member);
      assert.deepEqual(Object.keys(json.bars[1].representative[0]), ["vertices", "coefficient"]);

      assert.equal(json.bars[1].representative.length, 44);
      assert.equal(
        json.command,
        "ph-barcode torus.csv --max-dim 2 --representatives cycles --report torus.html",
      );
      const svg = (await downloaded(page, "Picture, SVG")).toString();
      assert.match(svg, />birth<\/text>/);
      assert.match(svg, /<image [^>]*href="data:image\/png/);
      const png = await downloaded(page, "Picture, PNG");
      assert.equal(png.subarray(1, 4).toString(), "PNG");
      assert.ok(png.length > 50_000);
    },
  );

  await t.test("the address keeps what is seen", async () => {
    await page.waitForTimeout(300);
    const hash = new URL(page.url()).hash;
    assert.match(hash, /bars=\d+,\d+,\d+/);
    const again = await open(browser, report, { hash: `${hash}&colour=plain&theme=dark` });
    assert.equal(await again.page.inputValue(".data select"), "plain");
    assert.equal(await again.page.getAttribute("html", "data-theme"), "dark");
    assert.match(await selection(again.page), /^3 bars selected/);
    // State that the new address does not name returns to its default.
    await again.page.evaluate(() => (location.hash = "bars=2-4,7&hide=0"));
    await again.page.waitForFunction(() => document.documentElement.dataset.theme === "light");
    assert.match(await selection(again.page), /^4 bars selected/);
    await again.page.waitForFunction(() => /bars=2-4,7/.test(location.hash));
    await again.page.evaluate(() => (location.hash = ""));
    await again.page.waitForFunction(
      () => document.querySelectorAll('.chip[aria-pressed="false"]').length === 0,
    );
    await again.close();
  });

  await t.test("a click on a point selects the representative through it", async () => {
    await page.keyboard.press("Escape");
    const box = await page.locator(".stage canvas").boundingBox();
    let found = false;
    for (let k = 0; k < 80 && !found; ++k) {
      await page.mouse.move(
        box.x + box.width * (0.2 + 0.6 * ((k * 0.618) % 1)),
        box.y + box.height * (0.3 + 0.4 * ((k * 0.377) % 1)),
      );
      await frame(page);
      found = /point .* H/.test(await reading(page));
    }
    assert.ok(found);
    await page.mouse.down();
    await page.mouse.up();
    await frame(page);
    assert.match(await selection(page), /^H[₁₂]/);
    assert.ok((await drawnOver(page, ".diagram")) > 20);
  });

  await t.test("a surface is filled, also where there is no WebGL", async (tt) => {
    const green = [0, 158, 115];
    const bar = report.arrays["bars/dim"].indexOf(2);
    const still = await launch({ webgl: false });
    tt.after(() => still.close());
    for (const [there, view] of [
      [browser, ".stage"],
      [still, ".stage svg"],
    ]) {
      const { page, close } = await open(there, report, { hash: "#colour=plain&bars=" });
      const before = await tintedPixels(page, view, green);
      const goTo = async (hash) => {
        await page.evaluate((to) => (location.hash = to), hash);
        await frame(page);
      };
      await goTo(`bars=${bar}`);
      const after = await tintedPixels(page, view, green);
      assert.ok(before < 500 && after > 15_000, `${view}: ${before} and ${after} green pixels`);
      assert.match(await page.textContent(".legend .marks"), /H₂ cycle.*birth cell.*death cell/);
      await goTo("bars=&scale=0.4");
      assert.ok((await coloursOf(page, view)) > 100, "edges are seen");
      await close();
    }
  });

  await t.test("the filtration grows edges, then triangles", async () => {
    const dark = await page.evaluate(() => document.documentElement.dataset.theme === "dark");
    assert.ok(!dark);
    const inks = [],
      counts = [];
    for (const place of [0, 60, 100, 125]) {
      await setSlider(page, ".scrubber input", place);
      const words = await page.textContent(".scrubber output");
      assert.match(words, /β₀ \d+ /);
      const [, edges, triangles] = words.match(/([\d,]+) edges?(?:, ([\d,]+) triangles?)?$/);
      counts.push([edges, triangles ?? "0"].map((n) => Number(n.replaceAll(",", ""))));
      inks.push((await coloursOf(page, ".stage")));
      await picture(page, `torus_scale_${place}`);
    }
    assert.deepEqual(counts[0], [0, 0]);
    for (let i = 1; i < counts.length; ++i)
      for (const k of [0, 1]) assert.ok(counts[i][k] >= counts[i - 1][k], `${counts}`);
    assert.ok(counts.at(-1)[1] > counts.at(-1)[0] / 2, `${counts}`);
    assert.ok(inks.at(-1) > 2 * inks[0], `${inks}`);
    await setSlider(page, ".scrubber input", 480);
    assert.match(await page.textContent(".scrubber output"), /first .* more triangles than can/);
  });

  await t.test("charts are tables, too", async () => {
    await page.click(".diagram header button");
    assert.equal(await page.locator(".diagram tbody tr").count(), 500);
    assert.equal(await page.locator(".diagram th").count(), 4);
    await picture(page, "torus_table");
  });
  assert.deepEqual(problems, []);
  await close();
  await t.test("the live cut of a scene", (tt) => cutOfAScene(tt, browser));
});

async function cutOfAScene(t, browser) {
  const report = scene(320, 268);
  const { page, problems, close } = await open(browser, report);
  await picture(page, "scene");

  const countsInLegend = () =>
    page.$$eval(".legend button.row .count", (rows) =>
      rows.map((r) => Number(r.textContent.replaceAll(",", ""))),
    );

  await t.test("first the program's answer, with what it says of it", async () => {
    const { points } = report.answer;
    assert.equal(await page.textContent(".cut .outcome"), `${points.length} segments`);
    assert.deepEqual(await countsInLegend(), points);
    assert.match(
      await page.textContent(".cut .note"),
      /the program's answer: at 0\.05 it joins parts of one object/,
    );
    const rows = page.locator(".legend button.row");
    const says = await rows.locator(".says").allTextContents();
    assert.deepEqual(says.slice(0, 5), ["on support 1", "on support 1", "container", "on 1", "on support 1"]);
    assert.equal(await rows.nth(0).getAttribute("title"), "object on support 1, touches no other");
    assert.equal(await rows.nth(2).getAttribute("title"), "container, confidence 3");
    assert.equal(await rows.nth(3).getAttribute("title"), "object on 1, confidence 4.5");
    assert.match(await page.textContent(".finding span"), /Besides: 1 support and 1 wall\.$/);
    await rows.nth(3).hover();
    await frame(page);
    assert.match(await reading(page), /^segment 4, [\d,]+ points {2}· {2}object on 1, confidence 4\.5/);
    const json = JSON.parse((await downloaded(page, "JSON")).toString());
    assert.deepEqual(
      json.segments[3],
      { label: 4, points: points[3], vertices: points[3], persistence: 4.5, role: "object", on: { segment: 1 } },
    );
    assert.deepEqual(json.surfaces, [{ number: 1, role: "support" }, { number: 2, role: "wall" }]);
  });

  await t.test("surfaces are listed apart, and can be switched off", async () => {
    const rows = page.locator(".legend .surface");
    assert.deepEqual(await rows.locator(".name").allTextContents(), ["support 1", "wall 2"]);
    const [support, wall] = (await rows.locator(".count").allTextContents()).map((text) =>
      Number(text.replaceAll(",", "")),
    );
    const none = report.vertexOfPoint.filter((v) => v === 0xffffffff).length;
    assert.equal(support, none);
    const all = report.answer.points.reduce((a, b) => a + b, 0) + support + wall;
    assert.ok(all <= report.vertexOfPoint.length && all > 0.99 * report.vertexOfPoint.length);
    await page.mouse.move(2, 2);
    // Surfaces are paler than segments; therefore the vivid pixels, which belong to segments, are
    // subtracted.
    const tints = async () => {
      const pixels = await pixelsOf(page, ".stage");
      const pale = (colour) => vividPixels(pixels, 10, colour) - vividPixels(pixels, 40, colour);
      return [pale([147, 164, 185]), pale([185, 172, 147])];
    };
    await frame(page);
    const before = await tints();
    await rows.nth(1).locator("input").uncheck();
    await frame(page);
    const without = await tints();
    await picture(page, "scene_without_wall");
    assert.ok(before[0] > 500 && without[0] < before[0] / 4, `wall: ${before[0]}, ${without[0]}`);
    assert.ok(without[1] > before[1] / 2, `support: ${before[1]}, ${without[1]}`);
    await rows.nth(1).locator("input").check();
    await frame(page);
    assert.deepEqual(await tints(), before);
  });

  await t.test("every other cut has the program's segments, and says what it is", async () => {
    for (const cut of [0, 0.01, 0.08, 0.2, 0.3, 0.5]) {
      await page.fill(".cut input[type=number]", String(cut));
      await page.keyboard.press("Enter");
      await frame(page);
      const expected = cutOf(report.tree, report.vertexOfPoint, { ...report.options, cut });
      const text = await page.textContent(".cut .outcome");
      assert.equal(
        text,
        `${expected.segments.length} segment${expected.segments.length === 1 ? "" : "s"}`,
      );
      assert.match(
        await page.textContent(".cut .note"),
        /^Not the program's answer: .* persistence alone, as with --parts\./,
      );
      assert.equal(await page.locator(".legend .says").count(), 0);
      assert.deepEqual(
        await countsInLegend(),
        expected.segments.slice(0, 200).map((s) => s.points),
      );
    }
    const json = JSON.parse((await downloaded(page, "JSON")).toString());
    assert.equal(
      json.command,
      "ph-segment desk.pcd --min-persistence 0.5 --parts --labels labels.npy",
    );
  });

  await t.test("a segment in the legend, its branch, its bar and its points are one", async () => {
    await page.click(".cut >> text=program's cut");
    await frame(page);
    const before = await page.screenshot({ clip: await page.locator(".stage").boundingBox() });
    const drawn = async () => [await drawnOver(page, ".tree"), await drawnOver(page, ".barcode")];
    const [tree, barcode] = await drawn();
    await page.hover(".legend button.row >> nth=2");
    await frame(page);
    assert.match(await reading(page), /^segment 3, .* H₀/);
    const [treeThen, barcodeThen] = await drawn();
    assert.ok(treeThen > tree + 20 && barcodeThen > barcode + 5);
    const after = await page.screenshot({ clip: await page.locator(".stage").boundingBox() });
    assert.notDeepEqual(before, after);
    await page.click(".legend button.row >> nth=2");
    await frame(page);
    await picture(page, "scene_selected");
    const bar = await selection(page);
    const box = await page.locator(".stage canvas").boundingBox();
    await page.keyboard.press("Escape");
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await frame(page);
    assert.match(await selection(page), /^H₀/);
    assert.ok(bar.startsWith("H₀"));
  });

  await t.test("bars have the colours of their segments", async () => {
    await page.keyboard.press("Escape");
    await page.mouse.move(2, 2);
    const pink = [204, 121, 167];
    const inCharts = async () => [
      await tintedPixels(page, ".barcode .chart", pink),
      await tintedPixels(page, ".diagram .chart", pink),
    ];
    await frame(page);
    const coloured = await inCharts();
    await page.selectOption(".data select", "depth");
    await frame(page);
    const plain = await inCharts();
    await page.selectOption(".data select", "segment");
    assert.ok(coloured[0] > 50 && coloured[1] > 10, `${coloured}`);
    assert.deepEqual(plain, [0, 0]);
  });

  await t.test("other colours, ground truth beside, and 900 pixels", async () => {
    for (const mode of ["rgb", "normal", "depth", "persistence", "truth"]) {
      await page.selectOption(".data select", mode);
      await frame(page);
      assert.ok((await coloursOf(page, ".stage")) > 20, mode);
      await picture(page, `scene_${mode}`);
    }
    await page.selectOption(".data select", "segment");
    await page.check("text=ground truth beside");
    await frame(page);
    await picture(page, "scene_beside");
    await page.setViewportSize({ width: 900, height: 800 });
    await page.waitForTimeout(200);
    await picture(page, "scene_900");
    await page.click("text=Dark");
    await page.waitForTimeout(200);
    await picture(page, "scene_900_dark");
  });
  assert.deepEqual(problems, []);
  await close();
}
