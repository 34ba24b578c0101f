// SPDX-License-Identifier: MIT
// Compares the geometry in space with the results of slow, simple methods.
import assert from "node:assert/strict";
import test from "node:test";
import { importSource } from "./support/import_source.mjs";
import { random } from "./support/random.mjs";

const { surfaceOf } = await importSource("geometry/voxel_sets.ts");
const { shortestPairs, trianglesOf } = await importSource("geometry/near_pairs.ts");

function runsOfMask(mask) {
  const runs = [];
  for (let i = 0; i < mask.length; ++i)
    if (mask[i] && !(i > 0 && mask[i - 1])) runs.push(i, 1);
    else if (mask[i]) ++runs[runs.length - 1];
  return Uint32Array.from(runs);
}

/// The names of the unit squares that are covered by the triangles of rectangles along the axes.
function squaresOf(corners) {
  const squares = new Set();
  for (let i = 0; i < corners.length; i += 18) {
    const xs = [0, 1, 2].map((k) => Array.from({ length: 6 }, (_, j) => corners[i + 3 * j + k]));
    const low = xs.map((x) => Math.min(...x)),
      high = xs.map((x) => Math.max(...x));
    const flat = [0, 1, 2].filter((k) => low[k] === high[k]);
    assert.equal(flat.length, 1);
    const [u, v] = [0, 1, 2].filter((k) => k !== flat[0]);
    for (let a = low[u]; a < high[u]; ++a)
      for (let b = low[v]; b < high[v]; ++b) {
        const at = [0, 0, 0];
        at[flat[0]] = low[flat[0]];
        at[u] = a;
        at[v] = b;
        const name = `${flat[0]}:${at}`;
        assert.ok(!squares.has(name), "no square twice");
        squares.add(name);
      }
  }
  return squares;
}

test("the surface of a set of voxels is the squares between it and the rest", () => {
  const next = random(5);
  for (const shape of [
    [1, 1, 1],
    [3, 4, 5],
    [5, 1, 7],
    [6, 6, 6],
  ])
    for (const share of [0.1, 0.5, 0.95, 1]) {
      const [planes, rows, columns] = shape;
      const mask = Array.from({ length: planes * rows * columns }, () => next() < share);
      mask[Math.floor(next() * mask.length)] = true;
      const isIn = (p, r, c) =>
        p >= 0 && r >= 0 && c >= 0 && p < planes && r < rows && c < columns &&
        mask[(p * rows + r) * columns + c];
      const expected = new Set();
      for (let p = 0; p <= planes; ++p)
        for (let r = 0; r <= rows; ++r)
          for (let c = 0; c <= columns; ++c)
            // Columns to the right, rows down, planes towards the reader.
            [
              [0, isIn(p, r, c - 1), [c - 0.5, -r - 0.5, p - 0.5]],
              [1, isIn(p, r - 1, c), [c - 0.5, -r + 0.5, p - 0.5]],
              [2, isIn(p - 1, r, c), [c - 0.5, -r - 0.5, p - 0.5]],
            ].forEach(([axis, before, at]) => {
              if (Boolean(before) !== Boolean(isIn(p, r, c))) expected.add(`${axis}:${at}`);
            });
      assert.deepEqual([...squaresOf(surfaceOf(runsOfMask(mask), shape))].sort(), [...expected].sort());
    }
});

test("a set that is too large to draw is drawn in larger cubes, at its place", () => {
  const shape = [200, 200, 200],
    next = random(6);
  const runs = [];
  for (let at = 60; at + 10 < 200 ** 3; at += 40) runs.push(at, 1 + Math.floor(next() * 10));
  const corners = surfaceOf(Uint32Array.from(runs), shape);
  assert.ok(corners.length > 0 && corners.length <= 18 * 150_000, `${corners.length / 18} faces`);
  for (let k = 0; k < 3; ++k) {
    let low = Infinity,
      high = -Infinity;
    for (let i = k; i < corners.length; i += 3)
      [low, high] = [Math.min(low, corners[i]), Math.max(high, corners[i])];
    assert.ok(Math.abs(high - low - 200) < 32, `${k}: ${low} … ${high}`);
  }
});

/// All pairs and all triangles within a distance, by trying each.
function allWithin(p, r) {
  const n = p.length / 3,
    near = (i, j) =>
      Math.hypot(p[3 * i] - p[3 * j], p[3 * i + 1] - p[3 * j + 1], p[3 * i + 2] - p[3 * j + 2]) <= r;
  const pairs = [],
    triangles = [];
  for (let i = 0; i < n; ++i)
    for (let j = i + 1; j < n; ++j) {
      if (!near(i, j)) continue;
      pairs.push(`${i},${j}`);
      for (let k = j + 1; k < n; ++k) if (near(i, k) && near(j, k)) triangles.push(`${i},${j},${k}`);
    }
  return { pairs: pairs.sort(), triangles: triangles.sort() };
}

const grouped = (numbers, size) =>
  Array.from({ length: numbers.length / size }, (_, i) =>
    [...numbers.subarray(size * i, size * (i + 1))].join(),
  ).sort();

test("edges and triangles of points are all pairs and triples that are near", () => {
  const next = random(8);
  for (const [n, spread] of [
    [1, [1, 1, 1]],
    [60, [1, 1, 1]],
    [60, [5, 5, 0]],
    [60, [1, 0, 0]],
    [40, [1000, 1e-3, 1]],
  ]) {
    const p = Float32Array.from({ length: 3 * n }, (_, i) => 7 + spread[i % 3] * (next() - 0.5));
    if (n > 10) p.copyWithin(0, 3, 9); // points that are equal
    for (const r of [0.05, 0.4, 3]) {
      const { ends, values, missingFrom } = shortestPairs(p, r, 1e6);
      assert.equal(missingFrom, Infinity);
      const expected = allWithin(p, r);
      assert.deepEqual(grouped(ends, 2), expected.pairs);
      assert.ok(values.every((v, i) => i === 0 || values[i - 1] <= v));
      assert.deepEqual(grouped(trianglesOf(ends, 1e6), 3), expected.triangles);
      if (expected.triangles.length > 1)
        assert.equal(trianglesOf(ends, expected.triangles.length - 1), undefined);
    }
  }
});

test("of too many pairs the shortest are found, none of them missing", () => {
  const next = random(9);
  const p = Float32Array.from({ length: 3 * 800 }, () => next());
  const { ends, values, missingFrom } = shortestPairs(p, 2, 4000);
  assert.ok(values.length > 1500 && values.length <= 4000, `${values.length}`);
  assert.ok(missingFrom < 2);
  assert.deepEqual(grouped(ends, 2), allWithin(p, missingFrom).pairs);
  const one = shortestPairs(new Float32Array(3 * 1000), 1, 100);
  assert.deepEqual([one.values.length, one.missingFrom], [0, 0]);
});

test("fifty thousand points are no trouble", (t) => {
  const next = random(10);
  for (const dims of [1, 2, 3]) {
    const p = Float32Array.from({ length: 150_000 }, (_, i) => (i % 3 < dims ? next() : 0));
    const start = process.cpuUsage();
    const { values } = shortestPairs(p, 1, 40_000);
    const { user, system } = process.cpuUsage(start);
    t.diagnostic(`${dims} axes: ${values.length} edges, ${((user + system) / 1000).toFixed(0)} ms of CPU`);
    assert.ok(values.length > 10_000 && user + system < 8e6);
  }
});
