// SPDX-License-Identifier: MIT
// Opens reports of the programs in headless Chromium. Usage: node programs.test.mjs PH_BARCODE
// PH_SEGMENT. The environment variable PH_TEST_DATA names the folder of the optional test data,
// which include a real scene. Exit code 77: nothing could be tested.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import test from "node:test";
import { coloursOf, downloaded, frame, launch, open, picture, tintedPixels } from "./support/browser.mjs";
import { npy, spherePoints, tableScene } from "./support/program_inputs.mjs";

const [barcode, segment] = process.argv.slice(2).map((path) => resolve(path));
const data = process.env.PH_TEST_DATA ?? "";
const scene = data && resolve(data, "scenes/test57.pcd");
if (!execFileSync(barcode, ["--version", "--verbose"]).toString().match(/reports +built in/)) {
  console.log("SKIPPED: reports are not built in");
  process.exit(77);
}

const folder = mkdtempSync(join(tmpdir(), "ph-programs-"));
const run = (program, ...words) =>
  execFileSync(program, [...words, "--quiet"], { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
const written = (name) => readFileSync(join(folder, name), "utf8");
const kCharts = [".diagram .chart", ".barcode .chart"];
const kTree = [".cut .chart", ".tree .chart"];

/// Opens a report that a program made. Each of these views must show something when it is open.
async function look(browser, name, views, act = async () => {}) {
  const { page, problems, close } = await open(browser, written(name));
  for (const folded of await page.$$(".panel.folded .fold")) await folded.click();
  for (const view of views) assert.ok((await coloursOf(page, view)) > 1, `${view} is empty`);
  await act(page);
  await picture(page, `program_${name.replace(".html", "")}`);
  assert.deepEqual(problems, []);
  await close();
}

/// The number of segments that the page states at a cut.
async function countAt(page, cut) {
  await page.fill(".cut input[type=number]", String(cut));
  await page.keyboard.press("Enter");
  await frame(page);
  return Number((await page.textContent(".cut .outcome")).replace(/\D/g, ""));
}

test("reports of the programs", { timeout: 300_000 }, async (t) => {
  const browser = await launch();
  t.after(async () => {
    await browser.close();
    rmSync(folder, { recursive: true });
  });

  await t.test("ph-barcode: points, with loops to select", async () => {
    writeFileSync(join(folder, "sphere.csv"), spherePoints());
    run(barcode, "sphere.csv", "--max-dim", "2", "--representatives", "cycles", "-o", "sphere.csv.json",
      "--output-format", "json", "--report", "sphere.html");
    const { bars } = JSON.parse(written("sphere.csv.json"));
    await look(browser, "sphere.html", [...kCharts, ".stage", ...kTree], async (page) => {
      assert.equal(await page.textContent("h1"), "sphere.csv");
      for (const cut of [0.1, 0.3, 0.7]) {
        const expected = bars.filter(({ dim, death }) => dim === 0 && !(death <= cut && death !== null));
        assert.equal(await countAt(page, cut), expected.length);
      }
      await page.click("text=About");
      const about = await page.textContent("dialog[open]");
      assert.match(about, /ph-barcode sphere\.csv --max-dim 2/);
      assert.match(about, /Metric\s*euclidean/);
      assert.doesNotMatch(about, /Construction|Left out/);
      await page.keyboard.press("Escape");
    });
  });

  await t.test("ph-barcode: an image", async () => {
    const rows = Array.from({ length: 24 }, (_, y) =>
      Array.from({ length: 32 }, (_, x) => Math.round(100 + 90 * Math.sin(x / 3) * Math.cos(y / 4))).join(" "),
    );
    writeFileSync(join(folder, "waves.pgm"), `P2\n32 24\n255\n${rows.join("\n")}\n`);
    run(barcode, "waves.pgm", "-o", "waves.csv", "--report", "waves.html");
    await look(browser, "waves.html", [...kCharts, ".stage", ...kTree]);
    run(barcode, "waves.pgm", "-o", "waves.csv", "--report", "cells.html", "--construction", "cells",
      "--periodic", "0,1", "--min-persistence", "2.5");
    await look(browser, "cells.html", kCharts, async (page) => {
      await page.click("text=About");
      const about = await page.textContent("dialog[open]");
      assert.match(about, /Construction\s*cells\s*Periodic axes\s*0, 1\s*Field/);
      assert.match(about, /Left out\s*bars of length 2\.5 and less/);
      await page.keyboard.press("Escape");
    });
  });

  await t.test("ph-barcode: what is exported says of its values what the program's JSON says", async () => {
    writeFileSync(join(folder, "dots.csv"), "x,y\n0,0\n1,0\n0,1\n1,1\n0.5,3\n");
    for (const words of [
      ["waves.pgm", "--superlevel"],
      ["dots.csv", "--complex", "alpha", "--alpha-values", "squared"],
      ["dots.csv", "--dtm", "2"],
      ["dots.csv", "--core", "2"],
    ]) {
      run(barcode, ...words, "-o", "bars.json", "--report", "bars.html");
      // The last two are counts of the input, not of what is shown.
      const { bars, input, timings, peak_memory, vertices, edges, ...said } = JSON.parse(
        written("bars.json"),
      );
      await look(browser, "bars.html", kCharts, async (page) => {
        await page.keyboard.press("Escape");
        await frame(page);
        const text = (await downloaded(page, "JSON")).toString();
        const exported = JSON.parse(text);
        for (const [name, value] of Object.entries(said)) assert.deepEqual(exported[name], value, name);
        for (const bar of exported.bars) delete bar.barcode;
        assert.deepEqual(exported.bars, bars);
        writeFileSync(join(folder, "exported.json"), text);
      });
      run(barcode, "plot", "exported.json", "-o", "exported.csv", "--output-format", "csv");
      run(barcode, "plot", "bars.json", "-o", "bars.csv", "--output-format", "csv");
      assert.equal(written("exported.csv"), written("bars.csv"));
    }
  });

  await t.test("ph-barcode: sets of voxels are coloured in a picture, surfaces in a volume", async () => {
    const kGreen = [0, 158, 115],
      kOrange = [213, 94, 0];
    const grid = (size, value) => Array.from({ length: size }, (_, i) => value(i));
    // A ring, and a ball with a hollow.
    const ring = grid(40 * 40, (i) => Math.hypot((i % 40) - 20, Math.floor(i / 40) - 20));
    const ball = grid(24 ** 3, (i) =>
      Math.hypot((i % 24) - 12, (Math.floor(i / 24) % 24) - 12, Math.floor(i / 576) - 12),
    );
    const write = (name, shape, distances, radius) =>
      writeFileSync(
        join(folder, name),
        npy(shape, distances.map((d) => Math.abs(d - radius))),
      );
    write("ring.npy", [40, 40], ring, 12);
    write("ball.npy", [24, 24, 24], ball, 8);
    for (const [name, dim, colour, least] of [
      ["ring", 1, kOrange, 3000],
      ["ball", 2, kGreen, 3000],
    ]) {
      run(barcode, `${name}.npy`, "--representatives", "voxels", "-o", `${name}.csv`,
        "--report", `${name}.html`);
      const rows = written(`${name}.csv`).trim().split("\n").slice(1).map((r) => r.split(",").map(Number));
      const length = ([d, birth, death]) => (d === dim ? death - birth : -1);
      const bar = rows.indexOf([...rows].sort((a, b) => length(b) - length(a))[0]);
      await look(browser, `${name}.html`, [...kCharts, ".stage"], async (page) => {
        await page.selectOption(".data select", "birth");
        await page.click("text=clear"); // the page has chosen a bar
        const before = await tintedPixels(page, ".stage", colour);
        await page.evaluate((b) => (location.hash = `colour=birth&bars=${b}`), bar);
        await frame(page);
        const after = await tintedPixels(page, ".stage", colour);
        assert.ok(after - before > least, `${name}: ${before} and ${after} pixels`);
        assert.match(await page.textContent(".legend .marks"), /hollow.*birth cell.*death cell/);
      });
    }
  });

  await t.test("ph-barcode: a mesh is seen as one, and grows with its values", async () => {
    const side = 10,
      rows = Array.from({ length: side * side }, (_, i) => [i % side, Math.floor(i / side)]);
    const faces = rows.flatMap(([x, y], i) =>
      x + 1 < side && y + 1 < side
        ? [`3 ${i} ${i + 1} ${i + side}`, `3 ${i + 1} ${i + side} ${i + side + 1}`]
        : [],
    );
    const vertices = rows.map(([x, y]) => `${x} ${y} ${Math.sin(x)}`);
    writeFileSync(
      join(folder, "sheet.off"),
      `OFF\n${rows.length} ${faces.length} 0\n${[...vertices, ...faces].join("\n")}\n`,
    );
    writeFileSync(join(folder, "x.txt"), rows.map(([x]) => x).join("\n"));
    run(barcode, "sheet.off", "--values", "x.txt", "--min-persistence", "-1", "-o", "sheet.csv",
      "--report", "sheet.html");
    await look(browser, "sheet.html", [...kCharts, ".stage"], async (page) => {
      const words = () => page.textContent(".scrubber output");
      assert.equal(await words(), "all   261 edges, 162 triangles");
      assert.equal(await page.textContent(".data h2"), "Mesh");
      await page.evaluate(() => (location.hash = "scale=4"));
      await frame(page);
      assert.match(await words(), /β₀ 1 .* 121 edges, 72 triangles$/);
    });
    run(barcode, "sphere.csv", "--metric", "manhattan", "-o", "far.csv", "--report", "far.html");
    await look(browser, "far.html", [".stage"], async (page) => {
      await page.evaluate(() => (location.hash = "scale=1.2"));
      await frame(page);
      assert.match(await page.textContent(".scrubber output"), /[\d,]+ edges, [\d,]+ triangles$/);
    });
  });

  await t.test("ph-barcode: an alpha complex is a cloud at first, and a surface at a radius", async (t) => {
    writeFileSync(
      join(folder, "cube.csv"),
      [0, 1, 2, 3, 4, 5, 6, 7].map((i) => `${i & 1} ${(i >> 1) & 1} ${i >> 2}`).join("\n"),
    );
    if (execFileSync(barcode, ["--version", "--verbose"]).toString().includes("alpha complexes need it")) {
      t.skip("CGAL is not built in");
      return;
    }
    run(barcode, "cube.csv", "--complex", "alpha", "--min-persistence", "-1", "-o", "cube.json",
      "--report", "cube.html");
    await look(browser, "cube.html", [...kCharts, ".stage"], async (page) => {
      const words = () => page.textContent(".scrubber output");
      assert.equal(await words(), "all");
      assert.equal(await page.textContent(".data h2"), "Point cloud");
      await page.evaluate(() => (location.hash = "scale=0.5"));
      await frame(page);
      assert.match(await words(), /β₀ 1 .* 12 edges$/);
      await page.evaluate(() => (location.hash = "scale=2"));
      await frame(page);
      assert.match(await words(), /β₀ 1 .* edges, 1\d triangles$/);
    });
  });

  await t.test("ph-barcode: two barcodes, a hostile name, no points", async () => {
    const name = "<script>alert(1)<img>.csv";
    writeFileSync(join(folder, name), "dim,birth,death\n0,0,1\n0,0,inf\n1,0.5,2\n");
    run(barcode, "--compare", name, "waves.csv", "--report", "two.html");
    await look(browser, "two.html", kCharts, async (page) => {
      assert.match(await page.textContent("h1"), /^<script>alert\(1\)<img>\.csv and waves\.csv$/);
      assert.equal(await page.locator("h1 img, h1 script").count(), 0);
    });
    const { page, problems, close } = await open(browser, written("two.html"), { scripts: false });
    assert.equal(await page.locator("noscript svg").count(), 2);
    assert.ok(await page.locator("noscript svg").last().isVisible());
    assert.match(await page.textContent("noscript svg text[font-weight=bold]"), /^<script>alert/);
    assert.equal(await page.locator("noscript img, noscript script").count(), 0);
    assert.ok(!(await page.locator("#app").isVisible()));
    await picture(page, "program_without_scripts");
    assert.deepEqual(problems, []);
    await close();
    writeFileSync(join(folder, "none.txt"), "");
    run(barcode, "none.txt", "--allow-empty", "-o", "none.csv", "--report", "none.html");
    await look(browser, "none.html", []);
  });

  await t.test("ph-segment: cuts of the page are those of the program", async (tt) => {
    let input = scene;
    if (!input || !existsSync(input)) {
      tt.diagnostic(`skipped: PH_TEST_DATA, which is "${data}", has no scenes/test57.pcd`);
      writeFileSync(join(folder, "table.xyz"), tableScene());
      input = "table.xyz";
    }
    run(segment, input, "--report", "scene.html", "--json", "scene.json", "--surfaces", "scene.csv");
    // Points of each segment, the largest first.
    const sizes = (json) => JSON.parse(written(json)).segments.map(({ points }) => points);
    const legend = (page) =>
      page.$$eval(".legend button.row .count", (rows) =>
        rows.map((r) => Number(r.textContent.replaceAll(",", ""))),
      );
    await look(browser, "scene.html", [...kCharts, ".stage", ...kTree], async (page) => {
      assert.deepEqual(await legend(page), sizes("scene.json"), "the program's own cut");
      const { segments, surfaces } = JSON.parse(written("scene.json"));
      const titles = await page.$$eval(".legend button.row", (rows) => rows.map((r) => r.title));
      assert.deepEqual(titles.map((title) => title.split(/[ ,]/)[0]), segments.map(({ role }) => role));
      const onSurface = written("scene.csv").trim().split("\n").map(Number);
      assert.deepEqual(
        await page.$$eval(".legend .surface", (rows) => rows.map((r) => r.textContent.replaceAll(",", ""))),
        surfaces.map(({ number, role }) => {
          const points = onSurface.filter((surface) => surface === number).length;
          return `${role} ${number}${points}`;
        }),
      );
      const counts = new Set();
      for (const cut of [0, 0.02, 0.1, 0.5]) {
        run(segment, input, "--cut", String(cut), "--parts", "--json", "cut.json");
        counts.add(await countAt(page, cut));
        assert.deepEqual(await legend(page), sizes("cut.json"), `at ${cut}`);
      }
      tt.diagnostic(`numbers of segments: ${[...counts].join(", ")}`);
    });
  });
});
