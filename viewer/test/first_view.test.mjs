// SPDX-License-Identifier: MIT
// Tests what a reader sees before the first click: the finding, a cloud without holes whose back is
// hidden, an unchanged image, and informative panels. Everything is tested on a phone as well.
import assert from "node:assert/strict";
import test from "node:test";
import { barArrays, metaOf } from "./support/fixture_parts.mjs";
import { image } from "./support/image_fixture.mjs";
import * as odd from "./support/odd_fixtures.mjs";
import { clusters, torus } from "./support/point_fixtures.mjs";
import { scene } from "./support/scene_fixture.mjs";
import { importSource } from "./support/import_source.mjs";
import {
  downloaded,
  frame,
  launch,
  open,
  picture,
  pixelsOf,
  tintedPixels,
  vividPixels,
} from "./support/browser.mjs";

const { kPitch } = await importSource("charts/fanned_dots.ts");

const selection = (page) => page.textContent(".status .selection");
const kOrange = [230, 159, 0],
  kBlue = [0, 114, 178],
  kGreen = [0, 158, 115];

/// Points with colours of their own.
function cloudOf(positions, rgb, cloud = {}) {
  const count = positions.length / 3;
  return {
    meta: metaOf("cloud.csv", { cloud }),
    arrays: {
      ...barArrays([[0, 0, Infinity], [0, 0, 1]]),
      "points/position": [Float64Array.from(positions), { shape: [count, 3] }],
      "points/rgb": [Uint8Array.from(rgb), { shape: [count, 3] }],
    },
  };
}
/// A grid of points, one pitch apart.
function sheet(side, place, colour) {
  const positions = [],
    rgb = [];
  for (let i = 0; i < side; ++i)
    for (let j = 0; j < side; ++j) {
      positions.push(...place(i, j));
      rgb.push(...colour);
    }
  return { positions, rgb };
}
/// Pixels in the middle of the stage that are background (white).
async function holes(page) {
  const pixels = await pixelsOf(page, ".stage", [0.4, 0.46, 0.6, 0.54]);
  let count = 0;
  for (let at = 0; at < pixels.length; at += 4)
    if (pixels[at] > 240 && pixels[at + 1] > 240 && pixels[at + 2] > 240) ++count;
  return count;
}
/// A small scene, which is quick to make; its texts are as long as the texts of a large scene.
function smallScene() {
  const report = scene(160, 134);
  report.meta.provenance.input.description = "343 040 points, PCD, 640 x 536";
  return report;
}

test("the first view", { timeout: 300_000 }, async (t) => {
  const browser = await launch();
  t.after(() => browser.close());

  await t.test("what stands out is said and selected; the address keeps another selection", async () => {
    const first = await open(browser, torus());
    assert.equal(
      await first.page.textContent(".finding span"),
      "One void stands out: [0.52, 1.36), the only one. Two loops stand out as well.",
    );
    assert.match(await selection(first.page), /^H₂ \[0\.52, 1\.36\)/);
    assert.ok((await tintedPixels(first.page, ".stage", kGreen)) > 15_000, "its cycle is drawn");
    assert.ok(!(await first.page.locator(".finding button").isVisible()));
    assert.equal(await first.page.textContent(".chips .chip >> nth=0"), "H₂1");
    await first.page.waitForTimeout(250);
    assert.equal(new URL(first.page.url()).hash, "");
    await first.page.keyboard.press("Escape");
    await first.page.waitForFunction(() => location.hash.includes("bars="));
    assert.equal(await selection(first.page), "nothing selected");
    const hash = new URL(first.page.url()).hash;
    await first.page.click(".finding button");
    // The button is gone; keyboard focus continues from the bars.
    assert.ok(await first.page.evaluate(() => document.activeElement.matches(".diagram canvas")));
    await frame(first.page);
    assert.match(await selection(first.page), /^H₂/);
    await first.close();
    const again = await open(browser, torus(), { hash });
    assert.equal(await selection(again.page), "nothing selected");
    await again.close();
  });

  await t.test("a surface of points has no holes, at any size and from any side", async (tt) => {
    const flat = sheet(100, (i, j) => [i, j, 0.02 * Math.sin(i)], kOrange);
    // A camera sees these points at equal angles and at different depths.
    const seen = sheet(
      200,
      (i, j) => {
        const depth = 1 + i / 400;
        return [(depth * (j - 100)) / 200, (depth * (i - 100)) / 200, depth];
      },
      kOrange,
    );
    for (const [name, { positions, rgb }, cloud] of [
      ["flat", flat, {}],
      ["seen", seen, { viewpoint: [0, 0, 0], up: [0, -1, 0] }],
    ]) {
      const report = cloudOf(positions, rgb, cloud);
      const { page, problems, close } = await open(browser, report, { hash: "#colour=rgb" });
      await page.focus(".stage canvas");
      for (const [width, height] of [[390, 844], [700, 640], [1920, 1200]]) {
        await page.setViewportSize({ width, height });
        await page.keyboard.press("0");
        await frame(page);
        assert.equal(await holes(page), 0, `${name}, ${width} x ${height}`);
        for (const key of ["ArrowLeft", "ArrowLeft", "ArrowUp", "+", "+", "+"]) await page.keyboard.press(key);
        await frame(page);
        assert.equal(await holes(page), 0, `${name}, ${width} x ${height}, turned and near`);
        await picture(page, `sheet_${name}_${width}`);
      }
      assert.deepEqual(problems, []);
      await close();
    }
    tt.diagnostic("no pixel of the background within the sheets");
  });

  await t.test("the back does not show through the front", async () => {
    const positions = [],
      rgb = [];
    for (let k = 0; k < 6000; ++k) {
      // A ball: the half that the eye sees is blue, the other orange.
      const z = 1 - (2 * (k + 0.5)) / 6000,
        turn = 2.399963 * k,
        r = Math.sqrt(1 - z * z);
      positions.push(r * Math.cos(turn), r * Math.sin(turn), z);
      rgb.push(...(z > 0 ? kBlue : kOrange));
    }
    const ball = cloudOf(positions, rgb, { viewpoint: [0, 0, 6], up: [0, 1, 0] });
    ball.meta.tree = { rule: "value", cut: 0.5 };
    Object.assign(ball.arrays, {
      "points/leaf": Uint16Array.from({ length: 6000 }, (_, k) => Number(k >= 3000)),
      "tree/leaf_birth": Float64Array.of(0, 0),
      "tree/leaf_points": Uint32Array.of(3000, 3000),
      "tree/leaf_vertices": Uint32Array.of(3000, 3000),
      "tree/leaf_bar": Uint32Array.of(0, 0),
      "tree/merge_younger": Uint32Array.of(1),
      "tree/merge_elder": Uint32Array.of(0),
      "tree/merge_value": Float64Array.of(1),
      "tree/merge_level": Float64Array.of(1),
      "tree/merge_bar": Uint32Array.of(1),
    });
    const { page, close } = await open(browser, ball, { hash: "#colour=rgb" });
    const pixels = await pixelsOf(page, ".stage");
    const front = vividPixels(pixels, 40, kBlue),
      back = vividPixels(pixels, 40, kOrange);
    assert.ok(front > 30_000 && back < front / 500, `${front} and ${back} pixels`);
    // The number of the segment behind is hidden as well.
    await page.evaluate(() => (location.hash = "colour=segment"));
    await page.waitForFunction(() => document.querySelectorAll(".numbers text").length === 1);
    await page.focus(".stage canvas");
    for (let i = 0; i < 13; ++i) await page.keyboard.press("ArrowLeft"); // a quarter turn shows both
    await page.waitForFunction(() => document.querySelectorAll(".numbers text").length === 2);
    await close();
  });

  await t.test("an image is grey, and only chosen basins are coloured", async () => {
    const { page, close } = await open(browser, image(), { hash: "#bars=" });
    const vivid = async () => vividPixels(await pixelsOf(page, ".stage"), 25);
    assert.equal(await page.inputValue(".data select"), "grey");
    const ticks = await page.$$eval(".legend .ticks span", (all) => all.map((e) => e.textContent));
    assert.deepEqual([ticks[0], ticks[2]], ["255", "0"], "grey values are as they are");
    assert.equal(await vivid(), 0);
    const box = await page.locator(".stage canvas").boundingBox();
    await page.mouse.click(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
    await page.mouse.move(2, 2);
    await frame(page);
    assert.match(await selection(page), /^H₀/);
    // The branch gets its number again, although only the overlay of the chart is redrawn.
    await page.keyboard.press("Escape");
    await page.waitForFunction(() => document.querySelectorAll(".numbers text").length === 0);
    await page.evaluate(() => {
      const { prototype } = CanvasRenderingContext2D;
      const original = prototype.fillText;
      window.drawn = [];
      prototype.fillText = function (text, ...more) {
        if (this.canvas.closest(".tree")) window.drawn.push(text);
        original.call(this, text, ...more);
      };
    });
    await page.mouse.click(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
    await page.mouse.move(2, 2);
    await page.waitForSelector(".numbers text");
    await frame(page);
    assert.ok((await page.evaluate(() => window.drawn)).includes(await page.textContent(".numbers text")));
    const some = await vivid();
    assert.ok(some > 1000 && some < (box.width * box.height) / 2, `${some} pixels`);
    await close();
  });

  await t.test("superlevel sets: values of the data; voxels that are not there are nothing", async () => {
    const side = 40;
    const values = Float32Array.from({ length: side * side }, (_, i) => {
      const [x, y] = [i % side, Math.floor(i / side)];
      return x < 10 && y < 10 ? NaN : 250 - 5 * Math.hypot(x - 25, y - 25);
    });
    values[side * side - 1] = Infinity;
    const name = "hill.npy";
    const { page, problems, close } = await open(browser, {
      meta: metaOf(name, {
        value: { label: "Value", negated: true },
        image: { construction: "vertices" },
        barcodes: [{ name, cells: "grid" }],
      }),
      arrays: {
        ...barArrays([[0, -250, Infinity], [0, -200, -120], [1, -180, -60]]),
        "image/values": [values, { shape: [side, side] }],
      },
    });
    assert.match(await page.textContent(".finding"), /\[180, 60\)/);
    assert.match(await page.textContent(".scrubber"), /^value down to/);
    const ticks = await page.$$eval(".legend .ticks span", (all) => all.map((e) => e.textContent));
    assert.equal(ticks[0], "250");
    assert.ok(ticks.every((text) => !/[−∞]/.test(text)), `${ticks}`);
    await page.click(".diagram header >> text=table");
    const cells = await page.$$eval(".diagram td", (all) => all.map((e) => e.textContent));
    assert.ok(cells.includes("250") && cells.includes("−∞") && cells.includes("60"), `${cells}`);
    assert.ok(!cells.some((text) => /−\d/.test(text)), `${cells}`);
    // The absent corner shows the background.
    const pixels = await pixelsOf(page, ".stage");
    const { width, height } = pixels;
    const at = (x, y) => {
      const scale = Math.min(width, height) / side / 1.08;
      const px = Math.round(width / 2 + (x - side / 2) * scale),
        py = Math.round(height / 2 + (y - side / 2) * scale);
      return [...pixels.subarray(4 * (py * width + px)).subarray(0, 3)];
    };
    assert.deepEqual(at(5, 5), [255, 255, 255]);
    assert.ok(at(25.5, 25.5)[0] > 230 && at(12.5, 12.5)[0] < 220, `${at(25.5, 25.5)} ${at(12.5, 12.5)}`);
    await page.evaluate(() => (location.hash = "scale=-200"));
    await frame(page);
    assert.match(await page.textContent(".scrubber output"), /^200 /);
    assert.deepEqual(problems, []);
    await close();
  });

  await t.test("equal bars are fanned out, each can be hit", async () => {
    const bars = [...Array(5).fill([0, 0, Infinity]), ...Array(4).fill([1, 1, 3]), [1, 1, 1.2]];
    const { page, close } = await open(browser, { meta: metaOf("equal.csv"), arrays: barArrays(bars) });
    const box = await page.locator(".diagram canvas.over").boundingBox();
    for (let bar = 0; bar < 5; ++bar) {
      // The line of infinity; its first dot is at the left end of the axis.
      await page.mouse.click(box.x + 50 + bar * kPitch, box.y + 14);
      await page.waitForFunction((b) => location.hash.includes(`bars=${b}`), bar);
    }
    await close();
  });

  await t.test("numbers at objects, bars and branches", async () => {
    const { page, close } = await open(browser, clusters());
    await page.waitForSelector(".numbers text");
    const numbers = await page.$$eval(".numbers text", (all) => all.map((e) => e.textContent));
    const rows = await page.$$eval(".legend button.row .name", (all) => all.map((e) => e.textContent));
    assert.ok(rows.length > 2);
    assert.deepEqual(numbers.sort(), rows.slice(0, 30).sort());
    // All these numbers are in an exported picture, with the sentence.
    const svg = (await downloaded(page, "Picture, SVG")).toString();
    const words = [...svg.matchAll(/<text [^>]*>([^<]*)</g)].map(([, text]) => text);
    assert.ok(words.includes(await page.textContent(".finding span")));
    for (const row of rows) assert.ok(words.filter((w) => w === row).length >= 4, `${row} in legend, data, charts`);
    // A panel that the reader folds stays folded.
    await page.click(".tree .fold");
    await page.selectOption(".data select", "persistence");
    await frame(page);
    assert.ok(!(await page.locator(".tree .chart").isVisible()) && (await page.locator(".cut .chart").isVisible()));
    assert.ok(!/>Merge tree</.test(await downloaded(page, "Picture, SVG")));
    await close();
  });

  await t.test("panels that say nothing are folded, and open", async () => {
    const { page, close } = await open(browser, odd.singlePoint());
    for (const panel of [".cut", ".tree", ".diagram"]) {
      assert.ok(!(await page.locator(`${panel} .chart`).isVisible()), panel);
      await page.click(`${panel} .fold`);
      assert.ok(await page.locator(`${panel} .chart`).isVisible(), panel);
      assert.equal(await page.getAttribute(`${panel} .fold`, "aria-expanded"), "true");
    }
    await close();
    const again = await open(browser, odd.singlePoint());
    const svg = (await downloaded(again.page, "Picture, SVG")).toString();
    assert.ok(!/NaN|>Merge tree<|>Persistence diagram</.test(svg) && />Barcode</.test(svg));
    // An address that names a cut opens the panel of the cut.
    await again.page.evaluate(() => (location.hash = "cut=0.5"));
    await again.page.waitForSelector(".cut .chart", { state: "visible" });
    await again.close();
  });

  await t.test("a mesh is its surface, in the colours of its values", async () => {
    const side = 12,
      count = side * side + 1;
    const positions = Float64Array.from({ length: 3 * count }, (_, k) =>
      [Math.floor(k / 3) % side, Math.floor(k / 3 / side), 0][k % 3],
    );
    positions.set([15, 5, 0], 3 * side * side); // in no triangle
    const corners = [];
    for (let y = 0; y + 1 < side; ++y)
      for (let x = 0; x + 1 < side; ++x) {
        const a = y * side + x;
        corners.push(a, a + 1, a + side, a + 1, a + side, a + side + 1);
      }
    const value = (v) => v % side;
    const order = Array.from({ length: corners.length / 3 }, (_, k) => corners.slice(3 * k, 3 * k + 3))
      .map((c) => [Math.max(...c.map(value)), c])
      .sort((a, b) => a[0] - b[0]);
    const { page, problems, close } = await open(browser, {
      meta: metaOf("sheet.off", { cloud: {}, provenance: { complex: "lower-star" } }),
      arrays: {
        ...barArrays([[0, 0, Infinity], [0, 1, 2]]),
        "points/position": [positions, { shape: [count, 3] }],
        "points/birth": Float32Array.from({ length: count }, (_, v) => value(v)),
        "complex/edges": [Uint32Array.of(0, 1), { shape: [1, 2] }],
        "complex/edge_values": Float32Array.of(1),
        "complex/triangles": [Uint32Array.from(order.flatMap(([, c]) => c)), { shape: [order.length, 3] }],
        "complex/triangle_values": Float32Array.from(order, ([v]) => v),
      },
    });
    const kYellow = [253, 231, 37],
      kViolet = [72, 36, 117];
    const colours = async () => {
      const pixels = await pixelsOf(page, ".stage canvas");
      return [vividPixels(pixels, 40, kYellow), vividPixels(pixels, 40, kViolet)];
    };
    assert.match(await page.textContent(".scrubber output"), / 1 edge, 242 triangles$/);
    const outside = await pixelsOf(page, ".stage canvas", [0.8, 0, 1, 1]);
    const dot = outside.filter((v, i) => i % 4 === 0 && v < 200).length;
    assert.ok(dot > 5, `${dot} pixels of a vertex in no triangle`);
    assert.match(await page.getAttribute(".stage canvas", "aria-label"), /^Mesh of 145 vertices/);
    const [yellow, violet] = await colours();
    assert.ok(yellow > 2000 && violet > 2000, `${yellow} and ${violet} pixels`);
    await page.evaluate(() => (location.hash = "scale=4"));
    await frame(page);
    const [less, same] = await colours();
    assert.ok(less < yellow / 10 && same > violet / 2, `${yellow}, ${violet} pixels, then ${less} and ${same}`);
    assert.deepEqual(problems, []);
    await close();
  });

  await t.test("a comparison draws its matching", async () => {
    const make = (pairs) => ({
      meta: metaOf("a and b", {
        barcodes: [{ name: "a" }, { name: "b" }],
        distances: [{ dim: 1, bottleneck: 1 }],
      }),
      arrays: {
        ...barArrays([[1, 0, 4], [1, 0, 2]]),
        ...barArrays([[1, 1, 4]], "bars2"),
        "matching/pairs": [Uint32Array.from(pairs), { shape: [pairs.length / 2, 2] }],
      },
    });
    const { page, close } = await open(browser, make([0, 2]));
    const svg = (await downloaded(page, "Picture, SVG")).toString();
    assert.equal(svg.match(/stroke-dasharray="2 3"/g)?.length, 1, "one bar goes to the diagonal");
    assert.match(await selection(page), /^2 bars selected/);
    await close();
    const bad = await open(browser, make([0, 7]));
    assert.match(await bad.page.textContent(".failure"), /no bar 7/);
    await bad.close();
  });

  await t.test("slices of a volume stand upright, its axes have names", async () => {
    const report = image([20, 24, 28]);
    report.meta.image.axes = ["x", "y", "z"];
    const { page, close } = await open(browser, report);
    await page.waitForSelector(".numbers text");
    const words = async () =>
      Object.fromEntries(
        await page.$$eval(".numbers text", (all) =>
          all.map((e) => [e.textContent, [Number(e.getAttribute("x")), Number(e.getAttribute("y"))]]),
        ),
      );
    assert.equal(await page.inputValue(".data .row select"), "2"); // across z
    const { x, y } = await words();
    assert.ok(x[0] > y[0] && y[1] < x[1], `x ${x} is to the right, y ${y} up`);
    await page.selectOption(".data .row select", "0");
    await frame(page);
    await frame(page);
    const side = await words();
    assert.ok(side.y[0] > side.z[0] && side.z[1] < side.y[1], `y ${side.y} is to the right, z ${side.z} up`);
    await close();
  });

  await t.test("a scene: its tree is open; heads wrap in narrow windows; nothing is cut off", async () => {
    const { page, problems, close } = await open(browser, smallScene());
    assert.ok(await page.locator(".tree .chart").isVisible());
    for (const width of [700, 500, 390]) {
      await page.setViewportSize({ width, height: width === 390 ? 844 : 900 });
      await frame(page);
      const heights = await page.$$eval(".panel > header", (all) => all.map((e) => e.getBoundingClientRect().height));
      assert.ok(Math.max(...heights) < 110, `heads of ${heights} pixels in a window of ${width}`);
    }
    await assertNothingIsCutOff(page, "scene");
    assert.deepEqual(problems, []);
    await close();
  });

  await t.test("nothing is cut off on a telephone", async () => {
    for (const [name, make] of Object.entries({ torus, image, two: odd.twoBarcodes, volume: () => image([20, 24, 28]) })) {
      const { page, problems, close } = await open(browser, make(), { width: 390, height: 844 });
      await assertNothingIsCutOff(page, name);
      assert.deepEqual(problems, []);
      await close();
    }
  });
});

/// Asserts that no text or control is cut off in a window of 390 pixels.
async function assertNothingIsCutOff(page, name) {
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  assert.ok(wide <= 0, `${name} is ${wide} pixels too wide`);
  const cut = await page.$$eval(".top *, .finding *, .panel > header *, .panel > .row *, .legend *, .status *", (all) =>
    all
      .filter((e) => e.checkVisibility() && !e.closest("svg, .menu .items, dialog, option"))
      .filter((e) => {
        const box = e.getBoundingClientRect(),
          panel = e.closest(".panel, .top, .status, .finding").getBoundingClientRect();
        const ends = box.right > Math.min(390, panel.right) + 0.5 || box.left < -0.5;
        return ends || (e.children.length === 0 && e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 0);
      })
      .map((e) => `${e.tagName} ${e.textContent.slice(0, 40)}`),
  );
  assert.deepEqual(cut, [], name);
  if (await page.locator(".stage").count()) {
    const [stage, panel] = [await page.locator(".stage").boundingBox(), await page.locator(".panel.data").boundingBox()];
    assert.ok(stage.width > panel.width - 4, `${name}: the picture has ${stage.width} of ${panel.width} pixels`);
  }
  await picture(page, `phone_${name}`);
}
