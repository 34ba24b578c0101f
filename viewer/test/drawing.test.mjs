// SPDX-License-Identifier: MIT
// Tests the positions of drawn items without a browser: fanned-out dots, and the lines of a
// matching.
import assert from "node:assert/strict";
import test from "node:test";
import { importSource } from "./support/import_source.mjs";
import { random } from "./support/random.mjs";

const { fanOut } = await importSource("charts/fanned_dots.ts");
const { drawMatching } = await importSource("charts/matching_lines.ts");
const { Matching } = await importSource("model/matching.ts");
const { Bars } = await importSource("model/bars.ts");
const { drawDensity } = await importSource("charts/diagram_density.ts");
const { spacingOf } = await importSource("geometry/point_spacing.ts");
const { firstPose } = await importSource("scene/pose.ts");
const { LabelPlaces } = await importSource("common/label_places.ts");

const kLeft = 50,
  kRight = 348;

/// Dots of equal bars on the line of infinity, fanned out; the first `numbered` ones have numbers.
function onLine(count, at, { numbered = 0, right = kRight } = {}) {
  const x = new Float32Array(count).fill(at),
    y = new Float32Array(count).fill(14);
  const group = Array.from({ length: count }, (_, i) => i);
  const crowds = fanOut([group], x, y, () => true, (bar) => bar < numbered, kLeft, right);
  return { x: [...x], crowds };
}
const isApart = (x, least) => {
  const sorted = [...x].sort((a, b) => a - b);
  return sorted.every((v, i) => i === 0 || v - sorted[i - 1] >= least);
};

test("dots on the line of infinity stand side by side, within the axis", () => {
  for (const [at, count, least] of [
    [kLeft, 5, 8],
    [kRight, 5, 8],
    [200, 5, 8],
    [kLeft, 36, 8], // more than fit at full pitch
    [kRight, 36, 8],
    [200, 60, 2],
  ]) {
    const { x, crowds } = onLine(count, at);
    assert.ok(isApart(x, Math.min(least, (kRight - kLeft) / 2 / count)), `${count} at ${at}: ${x}`);
    assert.ok(x.every((v) => v >= kLeft - 1e-3 && v <= kRight + 1e-3), `${x}`);
    assert.deepEqual(crowds, []);
  }
});

test("of more than 60 those with numbers stand apart, the others are a crowd", () => {
  const { x, crowds } = onLine(100, kLeft, { numbered: 30 });
  assert.ok(isApart(x.slice(0, 30), 5), `${x.slice(0, 30)}`);
  assert.equal(new Set(x.slice(30)).size, 1);
  assert.ok(!x.slice(0, 30).includes(x[99]));
  assert.deepEqual(crowds.map((c) => c.count), [70]);
});

test("elsewhere dots lie around their place", () => {
  const x = new Float32Array(30).fill(100),
    y = new Float32Array(30).fill(100);
  const some = Array.from({ length: 24 }, (_, i) => i);
  const of = (group) => fanOut([group], x, y, () => false, () => false, kLeft, kRight);
  assert.deepEqual(of(some), []);
  for (const i of some)
    for (const j of some)
      if (i < j) assert.ok(Math.hypot(x[i] - x[j], y[i] - y[j]) > 5, `${i} and ${j}`);
  assert.deepEqual(of(Array.from({ length: 30 }, (_, i) => i)), [{ x: 100, y: 100, count: 30 }]);
});

/// The lines of a drawn matching. @param bars [birth, death] of each barcode.
function linesOf(barcodes, pairs) {
  const columns = barcodes.map((bars) => ({
    dim: new Uint8Array(bars.length).fill(1),
    birth: Float64Array.from(bars, (b) => b[0]),
    death: Float64Array.from(bars, (b) => b[1]),
  }));
  const bars = new Bars(columns, barcodes.map((_, i) => ({ name: `${i}` })), 0);
  const lines = [];
  const axis = { at: (v) => v };
  const session = {
    theme: { muted: "#000" },
    isShown: () => true,
    report: { bars, matching: pairs && new Matching(Uint32Array.from(pairs)) },
  };
  const places = { x: Float32Array.from(bars.birth), y: Float32Array.from(bars.death), births: axis, deaths: axis };
  const left = drawMatching({ line: (...line) => lines.push(line) }, session, places);
  return { lines, left };
}

test("of very many pairs those that move farthest have lines", () => {
  const many = Array.from({ length: 2000 }, (_, i) => [0, 10 + i]);
  const pairs = many.flatMap((_, i) => [i, 2000 + i]);
  const { lines, left } = linesOf([many, many.map(([b, d]) => [b + (d - 10) / 1e4, d])], pairs);
  assert.deepEqual(left, { drawn: 1500, all: 2000 });
  assert.equal(Math.min(...lines.map((l) => l[1])), 510);
});

test("a matching: lines between partners, dotted ones to the diagonal", () => {
  const two = [
    [[0, 4], [0, 2]],
    [[1, 4]],
  ];
  assert.deepEqual(linesOf(two).lines, []);
  const { lines } = linesOf(two, [0, 2]);
  assert.deepEqual(lines.map((l) => l.slice(0, 4)), [[0, 4, 1, 4], [0, 2, 1, 1]]);
  assert.deepEqual(lines.map((l) => l[6]), [undefined, [2, 3]]);
});

test("a density passes over what is nowhere", () => {
  const rects = [];
  const session = {
    hiddenDims: new Set(),
    colourOfDim: () => "#000",
    report: { bars: { size: 4, dims: [0], dim: [0, 0, 0, 0] } },
  };
  const x = Float32Array.of(10, NaN, 500, -3),
    y = Float32Array.of(10, 10, 10, 10);
  drawDensity({ rect: (...rect) => rects.push(rect) }, session, x, y, { width: 30, height: 30 });
  assert.deepEqual(rects.map((r) => r.slice(0, 2)), [[9, 9]]);
  assert.ok(rects.every((r) => Number.isFinite(r[5])));
});

test("the spacing of a grid, whatever lies far from it", (t) => {
  const side = 401,
    next = random(2);
  const grid = Float32Array.from({ length: 3 * side * side }, (_, k) => {
    const i = Math.floor(k / 3);
    return [i % side, Math.floor(i / side), 0.01 * next()][k % 3];
  });
  const expected = spacingOf(grid);
  assert.ok(Math.abs(expected - 1) < 0.1, `${expected}`);
  const far = grid.slice();
  far.set([1e7, -1e7, 1e7], 3 * 1234);
  const start = process.cpuUsage();
  const found = spacingOf(far);
  const { user, system } = process.cpuUsage(start);
  t.diagnostic(`with one point far away in ${((user + system) / 1000).toFixed(0)} ms`);
  assert.ok(Math.abs(found - expected) < 0.1, `${found}`);
  assert.ok(user + system < 250_000 * Number(process.env.PATIENCE ?? 4));
});

test("the first view has an upright axis and an eye for any direction upwards", () => {
  const next = random(3);
  const positions = Float32Array.from({ length: 300 }, () => next());
  for (const up of [[0, 0, 1], [1, 1, 0], [0, -1, 0], [1, 0, 0], [1, -1, 1]]) {
    const { towards, half } = firstPose({
      meta: { cloud: { up } },
      cloud: { dims: 3, origin: [0, 0, 0], positions },
    });
    assert.ok(Math.abs(towards.length() - 1) < 1e-6, `${up}: ${towards.toArray()}`);
    assert.ok(half.width > 0.1 && half.height > 0.1);
    const along = Math.abs(towards.x * up[0] + towards.y * up[1] + towards.z * up[2]) / Math.hypot(...up);
    assert.ok(along < 0.8, `${up}: seen from above`);
  }
});

test("a mesh stands along y, a relief along z, either on a flat base if it has one", () => {
  const next = random(5);
  const upOf = (size, more = {}) => {
    const positions = Float32Array.from({ length: 3000 }, (_, i) => size[i % 3] * next());
    return firstPose({ meta: {}, cloud: { dims: 3, origin: [0, 0, 0], positions }, ...more }).up;
  };
  const isMesh = true;
  assert.deepEqual(upOf([1, 1.2, 0.9], { isMesh }).toArray(), [0, 1, 0]);
  assert.deepEqual(upOf([1, 1.2, 0.2], { isMesh }).toArray(), [0, 0, 1]);
  assert.deepEqual(upOf([1, 1.2, 0.9]).toArray(), [0, 0, 1], "points");
  // A fifth of the vertices lie exactly at the lower end of x.
  const positions = Float32Array.from({ length: 3000 }, (_, i) =>
    i % 15 === 0 ? 0 : next(),
  );
  const cloud = { dims: 3, origin: [0, 0, 0], positions };
  assert.deepEqual(firstPose({ meta: {}, cloud, isMesh }).up.toArray(), [1, 0, 0]);
});

test("numbers keep apart, larger ones more", () => {
  const small = new LabelPlaces(9.5),
    large = new LabelPlaces(24);
  for (const places of [small, large]) assert.ok(places.take(0, 0, "12"));
  assert.ok(small.take(0, 12, "12"));
  assert.ok(!large.take(0, 12, "12"));
  assert.ok(!small.take(3, 0, "7"));
});

/// Marks that a diagram or a barcode draws over its bars. @param fields the fields of the chart.
async function drawnOver(module, name, fields) {
  const { [name]: Chart } = await importSource(module);
  const marks = [];
  const log = (kind) => (...mark) => marks.push({ kind, mark });
  const kinds = ["line", "rect", "polygon", "circle", "text"];
  const pen = Object.fromEntries(kinds.map((kind) => [kind, log(kind)]));
  Object.assign(Object.create(Chart.prototype), fields).drawOver(pen);
  return marks;
}
const kTheme = { panel: "panel", accent: "accent", ink: "ink", muted: "muted" };
/// A session of bars [dim, birth, death] of each barcode.
function sessionOf(barcodes, { selection = [], focus = -1, tints = [], numbers = [] } = {}) {
  const columns = barcodes.map((bars) => ({
    dim: Uint8Array.from(bars, (b) => b[0]),
    birth: Float64Array.from(bars, (b) => b[1]),
    death: Float64Array.from(bars, (b) => b[2]),
  }));
  const names = barcodes.map((_, i) => ({ name: `${i}` }));
  const tinted = new Map(tints);
  return {
    theme: kTheme,
    selection,
    focus: { bar: focus },
    report: { bars: new Bars(columns, names, 0), meta: { value: {}, barcodes: names } },
    isShown: () => true,
    isSelected: (bar) => selection.includes(bar),
    tintedBars: () => tinted,
    numbers: () => new Map(numbers),
    numberOf: (label) => label,
    colourOfBar: (bar) => tinted.get(bar) ?? "colour",
  };
}

test("in a comparison a chosen dot of the second barcode stays hollow", async () => {
  for (const [bar, isHollow] of [[0, false], [1, true]])
    for (const chosen of [{ selection: [bar] }, { focus: bar }]) {
      const session = sessionOf([[[1, 0, 4]], [[1, 1, 4]]], chosen);
      const size = { width: 400, height: 300 };
      const fields = { session, x: [10, 20], y: [10, 20], lasso: [], size };
      const marks = await drawnOver("charts/diagram.ts", "Diagram", fields);
      const fills = marks.filter((m) => m.kind === "polygon").map((m) => m.mark[1]);
      assert.equal(fills.includes("colour"), !isHollow, JSON.stringify([bar, chosen]));
      assert.ok(marks.some((m) => m.mark.includes("colour")));
    }
});

/// Bars in thin rows, one below the other. @param ends their right ends, Infinity: an arrow.
function rowsOf(ends, row) {
  return ends.map((end, i) => {
    const endless = end === Infinity;
    return { bar: i, x1: 10, x2: endless ? 106 : end, y: row * i, row, endless };
  });
}
const overBarcode = (items, options) => {
  const bars = items.map(({ x2, endless }) => [0, 10, endless ? Infinity : x2]);
  const session = sessionOf([bars], options);
  const size = { width: 150, height: 300 };
  const fields = { session, items, rowsFor: session.tintedBars(), size };
  return drawnOver("charts/barcode.ts", "Barcode", fields);
};

test("a selected bar covers no other one and keeps its arrow", async () => {
  for (const row of [2.6, 3, 5.5, 8.5, 14]) {
    const items = rowsOf([90, Infinity, 80], row);
    const marks = await overBarcode(items, { selection: [1], tints: [[1, "tint"]] });
    for (const { mark } of marks.filter((m) => m.kind === "rect"))
      assert.ok(mark[1] > row - 0.3 && mark[1] + mark[3] < 2 * row + 0.3, `row ${row}: ${mark}`);
    const arrows = marks.filter((m) => m.kind === "polygon").map((m) => m.mark[1]);
    assert.deepEqual(arrows, ["tint", "accent", "tint"]);
  }
});

test("numbers at bars are drawn last, those of close ones together", async () => {
  const items = rowsOf([Infinity, 60, 70, 80, 20, 20, 20, 50], 4);
  const numbers = [[1, 2], [2, 3], [3, 4], [7, 1]];
  const marks = await overBarcode(items, { tints: numbers.map(([bar]) => [bar, "tint"]), numbers });
  const texts = marks.slice(-2).map((m) => m.mark);
  assert.deepEqual(texts.map((text) => text[2]), ["2, 3, 4", "1"]);
  assert.ok(texts[0][0] > 80, "beyond the longest of them");
  assert.equal(texts[0][3].halo, "panel");
  const narrow = rowsOf([Infinity, Infinity, Infinity], 3);
  const all = [[0, 1], [1, 12], [2, 3]];
  const tints = all.map(([bar]) => [bar, "tint"]);
  const [text] = (await overBarcode(narrow, { tints, numbers: all })).slice(-1);
  assert.equal(text.mark[2], "1, …");
});

test("a dimension with few bars has high rows beside one with many", async () => {
  const { layOut } = await importSource("charts/barcode_rows.ts");
  const { rows, heights } = layOut([2, 96], [2, 96], 270);
  assert.equal(rows[0], 2);
  assert.ok(heights[0] >= 9 && heights[1] >= 2.5, `${heights}`);
  const strips = rows[1] < 96 ? 12 : 0;
  assert.ok(rows[0] * heights[0] + rows[1] * heights[1] + strips <= 270);
  // If there is room for all rows, they are equally high.
  assert.deepEqual(layOut([2, 10], [2, 10], 270), { rows: [2, 10], heights: [14, 14], row: 14 });
});

const { isWholeMesh, kBirthColour, kDeathColour, shapesOf } =
  await importSource("scene/representatives.ts");
const { dimColour, greyOf, ramp, segmentColour } = await importSource("common/palette.ts");

test("no colour of values, segments or dimensions is that of a birth cell", () => {
  const rgbOf = (colour) => [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
  const others = [rgbOf(kDeathColour)];
  for (let k = 0; k <= 100; ++k) others.push(ramp(k / 100), greyOf(k / 100));
  for (let k = 0; k < 7; ++k) others.push(segmentColour(k));
  for (let dim = 0; dim < 6; ++dim)
    for (const dark of [false, true]) others.push(rgbOf(dimColour(dim, { dark })));
  const mark = rgbOf(kBirthColour);
  for (const other of others)
    assert.ok(Math.hypot(...other.map((c, k) => c - mark[k])) > 100, `${other}`);
});

test("a death cell is an outline, a chain that is the whole mesh is not drawn", () => {
  const positions = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1);
  const faces = [0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3];
  const columns = {
    dim: Uint8Array.of(1, 2),
    birth: Float64Array.of(0, 2),
    death: Float64Array.of(1, Infinity),
    birthCells: Uint32Array.of(0, 1, 1, 2, 3),
    deathCells: Uint32Array.of(0, 1, 2),
  };
  const report = {
    bars: new Bars([columns], [{ name: "", cells: "vertices" }], 0),
    cloud: { positions },
    elements: { count: 4 },
    triangles: { corners: faces, values: [0, 1, 1, 2] },
    chains: { ofBar: new Map([[1, 0]]), start: [0, 4], cells: faces, first: [0, 12] },
  };
  const shapes = (bar) => shapesOf({ report, theme: {}, focus: { bar }, selection: [] });
  const death = shapes(0).find((shape) => shape.colour === kDeathColour).geometry;
  assert.deepEqual([death.triangles.length, death.segments.length], [0, 18]);
  assert.ok(isWholeMesh(report, 1));
  const triangles = (shape) => shape.surface && shape.geometry.triangles.length;
  assert.ok(!shapes(1).some(triangles));
  report.chains.start = [0, 3]; // three of its four faces
  assert.ok(shapes(1).some(triangles));
});
