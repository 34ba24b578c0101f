// SPDX-License-Identifier: MIT
// Tests the size and speed of large reports: with many bars, leaves or points, they must stay
// usable.
import assert from "node:assert/strict";
import test from "node:test";
import * as odd from "./support/odd_fixtures.mjs";
import { scene } from "./support/scene_fixture.mjs";
import { coloursOf, kPatience, launch, median, open, picture, setSlider } from "./support/browser.mjs";

test("a million bars, a scene, two million points", { timeout: 500_000 }, async (t) => {
  const browser = await launch();
  t.after(() => browser.close());
  await t.test("bars", async (tt) => {
    const { page, problems, bytes, firstFrame, close } = await open(browser, odd.manyBars());
    const hover = await page.$eval(".diagram canvas.over", (canvas) => {
      const box = canvas.getBoundingClientRect(),
        times = [];
      return new Promise((done) => {
        const next = (k) => {
          if (k === 12) return done(times);
          const start = performance.now();
          canvas.dispatchEvent(
            new PointerEvent("pointermove", {
              clientX: box.left + 80 + 15 * k,
              clientY: box.top + 60 + 8 * k,
            }),
          );
          requestAnimationFrame(() =>
            setTimeout(() => {
              times.push(performance.now() - start);
              next(k + 1);
            }),
          );
        };
        next(0);
      });
    });
    tt.diagnostic(
      `${(bytes / 2 ** 20).toFixed(1)} MiB, first frame ${firstFrame} ms, hover to frame ${median(hover).toFixed(0)} ms`,
    );
    await picture(page, "many_bars");
    assert.ok((await coloursOf(page, ".diagram .chart")) > 50);
    assert.ok(median(hover) < 100 * kPatience);
    assert.deepEqual(problems, []);
    await close();
  });
  await t.test("components of 300 000 points, each a leaf", async (tt) => {
    const { page, problems, bytes, firstFrame, close } = await open(browser, odd.manyLeaves());
    const times = [];
    for (const place of [300, 700, 1100, 500]) {
      await setSlider(page, ".cut input[type=range]", place);
      const title = await page.getAttribute(".cut .outcome", "title");
      times.push(Number(title.match(/[\d.]+/)[0]));
    }
    const list = times.map((ms) => ms.toFixed(0)).join(", ");
    tt.diagnostic(
      `${(bytes / 2 ** 20).toFixed(1)} MiB, first frame ${firstFrame} ms, cuts in ${list} ms`,
    );
    assert.ok(median(times) < 50 * kPatience);
    assert.deepEqual(problems, []);
    await close();
  });
  await t.test("a scene of 343 040 points, its cut", async (tt) => {
    const report = scene(),
      count = report.vertexOfPoint.length;
    const { page, problems, bytes, firstFrame, wall, close } = await open(browser, report);
    tt.diagnostic(
      `${count} points: ${(bytes / 2 ** 20).toFixed(2)} MiB, ${(bytes / count).toFixed(1)} bytes a point, first frame ${firstFrame} ms (with the browser's work ${wall.toFixed(0)} ms)`,
    );
    assert.ok(bytes <= 12 * count && bytes <= 5 * 2 ** 20, "the page is too large");
    assert.ok(firstFrame < 1500 * kPatience, "the page is too slow");
    const times = [];
    for (const place of [300, 900, 1200, 1500, 700])
      times.push(
        await page.$eval(
          ".cut input[type=range]",
          (input, v) => {
            const start = performance.now();
            input.value = v;
            input.dispatchEvent(new Event("input", { bubbles: true }));
            return new Promise((done) =>
              requestAnimationFrame(() => setTimeout(() => done(performance.now() - start))),
            );
          },
          String(place),
        ),
      );
    const own = Number((await page.getAttribute(".cut .outcome", "title")).match(/[\d.]+/)[0]);
    tt.diagnostic(
      `cut and coloured in ${own} ms; drawn by the software renderer after ${times.map((ms) => ms.toFixed(0)).join(", ")} ms`,
    );
    assert.ok(own < 50 * kPatience);
    await picture(page, "scene_cut");
    assert.deepEqual(problems, []);
    await close();
  });
  await t.test("points", async (tt) => {
    const n = 2_000_000,
      xyz = new Uint16Array(3 * n),
      rgb = new Uint8Array(3 * n);
    for (let i = 0; i < n; ++i) {
      const u = i % 2000,
        v = Math.floor(i / 2000);
      xyz.set([u * 32, v * 60, 30000 + 12000 * Math.sin(u / 90) * Math.cos(v / 70)], 3 * i);
      rgb.set([u / 8, v / 4, 128], 3 * i);
    }
    const { meta, arrays } = odd.ties();
    const { page, problems, bytes, firstFrame, close } = await open(browser, {
      meta: { ...meta, title: "large.ply", cloud: {} },
      arrays: {
        ...arrays,
        "points/position": [
          xyz,
          { shape: [n, 3], filter: "delta planes", offset: [0, 0, 0], scale: [1e-4, 1e-4, 1e-4] },
        ],
        "points/rgb": [rgb, { shape: [n, 3], filter: "delta" }],
      },
    });
    tt.diagnostic(`${(bytes / 2 ** 20).toFixed(1)} MiB, first frame ${firstFrame} ms`);
    assert.ok((await coloursOf(page, ".stage")) > 50);
    await picture(page, "two_million_points");
    assert.deepEqual(problems, []);
    await close();
  });
});
