// SPDX-License-Identifier: MIT
// Tests that words and controls around the views are legible in dark mode, fit in one line on a
// phone, and have the style of the reader's device.
import assert from "node:assert/strict";
import test from "node:test";
import { image } from "./support/image_fixture.mjs";
import { downloaded, frame, launch, open, picture, pixelsOf } from "./support/browser.mjs";
import { clusters, torus } from "./support/point_fixtures.mjs";

const kPhone = { width: 390, height: 844 };
const kNineDigits = "0.123456789";

/// The report of a run without --representatives.
function plain(report) {
  const { meta, arrays } = report;
  const isChain = (name) => name.startsWith("chains/");
  delete meta.barcodes[0].representatives;
  const left = Object.entries(arrays).filter(([name]) => !isChain(name));
  return { meta, arrays: Object.fromEntries(left) };
}

test("words and controls", { timeout: 200_000 }, async (t) => {
  const browser = await launch();
  t.after(() => browser.close());

  await t.test("numbers on a dark page are light, those on a picture dark", async () => {
    for (const [make, hash, fill, edge] of [
      [clusters, "", "rgb(230, 233, 238)", "rgb(24, 28, 34)"],
      [() => image([16, 20, 24]), "", "rgb(230, 233, 238)", "rgb(24, 28, 34)"], // the axes
      [image, "#colour=segment", "rgb(20, 24, 29)", "rgb(255, 255, 255)"],
    ]) {
      const { page, problems, close } = await open(browser, make(), { dark: true, hash });
      await page.waitForSelector(".numbers text");
      const style = await page.$eval(".numbers text", (e) => {
        const { fill, stroke } = getComputedStyle(e);
        return { fill, stroke };
      });
      assert.deepEqual(style, { fill, stroke: edge });
      const svg = (await downloaded(page, "Picture, SVG")).toString();
      const colour = fill === "rgb(230, 233, 238)" ? "#e6e9ee" : "#14181d";
      assert.ok(svg.includes(`fill="${colour}" stroke=`));
      assert.deepEqual(problems, []);
      await close();
    }
  });

  await t.test("on a telephone no button and no hint breaks into a line of its own", async () => {
    for (const [name, make] of Object.entries({ image, clusters, torus })) {
      const { page, close } = await open(browser, make(), kPhone);
      const middle = async (selector) => {
        const box = await page.locator(selector).first().boundingBox();
        return box.y + box.height / 2;
      };
      const title = await middle(".data h2");
      assert.ok(Math.abs((await middle('.data button:has-text("fit")')) - title) < 5, name);
      const hint = await page.locator(".diagram .hint").boundingBox();
      assert.ok(hint.height < 22, `${name}: the hint has ${hint.height} pixels`);
      const cut = page.locator(".panel.cut:not(.folded)");
      if (await cut.count()) {
        const heading = await middle(".cut h2");
        for (const what of [".outcome", ".fold"])
          assert.ok(Math.abs((await middle(`.cut ${what}`)) - heading) < 5, `${name}: ${what}`);
        const shortcut = page.locator(".cut .shortcut").first();
        const field = await middle(".cut .number");
        const box = await shortcut.boundingBox();
        assert.ok(Math.abs(box.y + box.height / 2 - field) < 5, `${name}: the shortcut is alone`);
      }
      await picture(page, `controls_${name}`);
      await close();
    }
  });

  await t.test("the field of the cut shows nine digits", async () => {
    const { page, close } = await open(browser, clusters());
    const [has, needs] = await page.$eval(
      ".cut .number",
      (field, digits) => {
        const pen = document.createElement("canvas").getContext("2d");
        const { font, paddingLeft, paddingRight } = getComputedStyle(field);
        pen.font = font;
        const kArrows = 16; // pixels of the arrows that a number field shows
        const padding = parseFloat(paddingLeft) + parseFloat(paddingRight);
        return [field.clientWidth - padding - kArrows, pen.measureText(digits).width];
      },
      kNineDigits,
    );
    assert.ok(has >= needs, `${has} of ${needs} pixels`);
    await close();
  });

  await t.test("where nothing can hover the page speaks of tapping", async () => {
    const words = (page) => page.textContent(".status .reading");
    const desk = await open(browser, torus());
    assert.match(await words(desk.page), /^Hover over/);
    await desk.close();
    const phone = await open(browser, torus(), { ...kPhone, touch: true });
    assert.match(await words(phone.page), /^Tap a bar/);
    await phone.close();
  });

  await t.test("a report without representatives says how to get them", async () => {
    const note = (page) => page.locator(".marks .note").allTextContents();
    const without = await open(browser, plain(torus()));
    const [text] = await note(without.page);
    assert.match(text, /^The report has no cycle of this bar: --representatives cycles adds it\.$/);
    assert.match(await without.page.textContent(".marks"), /birth cell/);
    const option = await without.page.locator(".marks .unbroken").boundingBox();
    assert.ok(option.height < 20, "the name of the option is in one line");
    await without.close();
    const drawn = await open(browser, torus());
    assert.deepEqual(await note(drawn.page), []);
    await drawn.close();
  });

  await t.test("a scale of colours has no stripes", async () => {
    const { page, close } = await open(browser, image());
    const { width, height, ...pixels } = await pixelsOf(page, ".ramp", [0.4, 0.03, 0.6, 0.97]);
    const levels = Array.from({ length: height }, (_, y) => pixels[4 * y * width]);
    // A difference of one is rounding. If the page showed between two steps, the stripe would be
    // lighter by up to 55.
    const rises = levels.filter((level, y) => y > 0 && level > levels[y - 1] + 1);
    assert.equal(rises.length, 0, `${levels}`);
    assert.ok(levels[0] > 200 && levels.at(-1) < 50);
    await close();
  });

  await t.test("shortcuts are the browser's own", async () => {
    const { page, close } = await open(browser, clusters());
    const isTaken = (canvas, key, modifiers) =>
      page.$eval(
        canvas,
        (element, options) =>
          !element.dispatchEvent(new KeyboardEvent("keydown", { ...options, bubbles: true, cancelable: true })),
        { key, ...modifiers },
      );
    for (const [canvas, keys] of [
      [".stage canvas", ["0", "-", "=", "ArrowLeft"]],
      [".diagram canvas.over", ["ArrowLeft", "PageDown", "Enter"]],
    ])
      for (const key of keys) {
        assert.ok(await isTaken(canvas, key, {}), `${key} on ${canvas}`);
        for (const modifier of ["ctrlKey", "altKey", "metaKey"])
          assert.ok(!(await isTaken(canvas, key, { [modifier]: true })), `${modifier} ${key}`);
      }
    await close();
  });

  await t.test("Escape closes the menu, then it clears the selection", async () => {
    const { page, close } = await open(browser, torus());
    const state = async () => [
      await page.locator(".menu[open]").count(),
      (await page.textContent(".status .selection")) === "nothing selected",
    ];
    await page.click(".menu summary");
    assert.deepEqual(await state(), [1, false]);
    await page.keyboard.press("Tab");
    await page.keyboard.press("Escape");
    await frame(page);
    assert.deepEqual(await state(), [0, false]);
    assert.ok(await page.$eval(".menu summary", (e) => e === document.activeElement));
    await page.keyboard.press("Escape");
    await frame(page);
    assert.deepEqual(await state(), [0, true]);
    await close();
  });

  await t.test("a table says of which bars it is", async () => {
    const { page, close } = await open(browser, image(), { hash: "#hide=0" });
    const caption = () => page.textContent(".barcode caption");
    await page.click(".barcode button:has-text('table')");
    assert.equal(await caption(), "1 bar, without H₀");
    await page.click(".chip >> nth=0");
    await frame(page);
    assert.equal(await caption(), "0 bars, without H₀ and H₁");
    for (const chip of [0, 1]) await page.click(`.chip >> nth=${chip}`);
    await frame(page);
    assert.match(await caption(), /^The 500 most persistent of [\d,]+ bars$/);
    await close();
  });

  await t.test("the tree and the barcode call their axis alike", async () => {
    const { page, close } = await open(browser, clusters());
    await frame(page);
    const svg = (await downloaded(page, "Picture, SVG")).toString();
    assert.equal(svg.match(/>filtration value</g)?.length, 2);
    assert.doesNotMatch(svg, />value</);
    await close();
  });
});
