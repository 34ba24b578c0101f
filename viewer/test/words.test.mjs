// SPDX-License-Identifier: MIT
// Tests that numbers on the page have enough digits, and that numbers in written files have the
// same digits as in the programs' files. Also tests the steps of the cut.
import assert from "node:assert/strict";
import test from "node:test";
import { importSource } from "./support/import_source.mjs";
import { random } from "./support/random.mjs";

const { digitsFor, exact, short } = await importSource("common/number_format.ts");
const { endsOf, intervalText } = await importSource("model/words.ts");
const { Bars } = await importSource("model/bars.ts");
const { CutScale, kSteps } = await importSource("model/cuts.ts");
const { Session } = await importSource("model/session.ts");

test("four digits, and all before the point", () => {
  for (const [value, text] of [
    [0.123456, "0.1235"],
    [51874, "51874"],
    [-51874.25, "−51874"],
    [999_999, "999999"],
    [1_234_567, "1.235e6"],
    [1e6, "1e6"],
    [0.00001234, "1.234e−5"],
    [0, "0"],
    [-Infinity, "−∞"],
  ])
    assert.equal(short(value), text);
  assert.equal(short(5412345.25, 9), "5412345.25");
  assert.equal(digitsFor(1, 1), 4);
  assert.equal(digitsFor(1000, 0.001), 8);
  for (const none of [0, NaN, Infinity]) assert.equal(digitsFor(1, none), 4);
  assert.equal(digitsFor(1e300, 1e-300), 15);
});

test("files have the numbers of the programs", () => {
  for (const [value, text] of [
    [1.7468116547508943e-9, "1.7468116547508943e-09"],
    [-9.999999747378752e-5, "-9.999999747378752e-05"],
    [0.0001, "0.0001"],
    [1e16, "1e+16"],
    [1234567890123456, "1234567890123456"],
    [1e-300, "1e-300"],
    [5e-324, "5e-324"],
    [-0, "0"],
    [0.1, "0.1"],
    [Infinity, "inf"],
    [-Infinity, "-inf"],
  ])
    assert.equal(exact(value), text);
  const next = random(3);
  for (let i = 0; i < 20_000; ++i) {
    const value = (next() - 0.5) * 10 ** Math.floor(40 * (next() - 0.5));
    assert.equal(Number(exact(value)), value);
  }
});

test("the ends of a bar can be told apart", () => {
  const report = (bars) => ({
    meta: { value: { label: "" } },
    bars: new Bars(
      [
        {
          dim: Uint8Array.from(bars, () => 0),
          birth: Float64Array.from(bars, (b) => b[0]),
          death: Float64Array.from(bars, (b) => b[1]),
        },
      ],
      [{ name: "a" }],
      0,
    ),
  });
  const near = report([[-999.995, -999.994961], [-999.995, Infinity], [-1000.002, -999.995]]);
  assert.equal(intervalText(near, 0), "[−999.995, −999.994961)");
  assert.equal(intervalText(near, 1), "[−999.995, ∞)");
  assert.deepEqual(endsOf(report([[0.5, 2.25]]), 0, 6), ["0.5", "2.25"]);
  assert.equal(intervalText(report([[1234, 43434]]), 0), "[1234, 43434)");
  assert.equal(intervalText(report([[1, 1]]), 0), "[1, 1)");
});

test("the slider of the cut stays within its ends, and each step moves it", () => {
  const tree = (levels) => ({ arrays: { levels: Float64Array.from(levels) } });
  for (const [levels, from, to, cut] of [
    [[1, 1.2, 1.3], 1, undefined, 1.41],
    [[1e-9, 1e-3, 5], undefined, undefined, 0],
    [[0.001, 0.4], 0.2, 0.5, 0.3],
    [[2, 2, 2], 2, 2, 2],
    [[], undefined, undefined, 0],
  ]) {
    const scale = new CutScale(tree(levels), from, to, cut);
    let before = -Infinity;
    for (let step = 0; step <= kSteps; ++step) {
      const at = scale.at(step / kSteps);
      assert.ok(at >= scale.from && at <= scale.to, `${at}`);
      assert.ok(at > before || scale.from === scale.to || step === 1, `${at} after ${before}`);
      before = at;
      if (step > 1 && scale.from < scale.to)
        assert.ok(Math.abs(scale.place(at) * kSteps - step) < 0.51);
    }
  }
});

// Points that are left out also have numbers.
test("the loop through a point is found by its number in the input", () => {
  const bars = new Bars(
    [{ dim: Uint8Array.of(1), birth: Float64Array.of(1), death: Float64Array.of(2) }],
    [{ name: "a", representatives: "cycles" }],
    0,
  );
  const report = {
    meta: { barcodes: [{ name: "a" }], value: { label: "" }, provenance: {} },
    bars,
    cloud: { dims: 2, index: Uint32Array.of(1, 4, 5, 9), positions: new Float32Array(12) },
    elements: { count: 4 },
    chains: {
      ofBar: new Map([[0, 0]]),
      cells: Uint32Array.of(4, 5, 5, 9, 4, 9),
      start: Uint32Array.of(0, 3),
      first: Float64Array.of(0, 6),
    },
  };
  globalThis.requestAnimationFrame ??= () => 0;
  const session = new Session(report);
  assert.deepEqual([0, 1, 2, 3].map((i) => session.barOf(i)), [-1, 0, 0, 0]);
});
