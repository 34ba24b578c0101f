// SPDX-License-Identifier: MIT
// Reports of synthetic points: each function returns the metadata and the arrays of one.
import { barArrays, byOrder, metaOf } from "./fixture_parts.mjs";
import { contracted, mergeTree } from "./reference_tree.mjs";
import { random } from "./random.mjs";
import { quantised } from "./write_report.mjs";

/// A torus of `rows` by `columns` points, its two loops and its void with their cycles.
export function torus(rows = 44, columns = 22) {
  const next = random(7),
    n = rows * columns,
    R = 2,
    r = 0.8;
  const xyz = new Float64Array(3 * n);
  for (let i = 0; i < n; ++i) {
    const u = (2 * Math.PI * (Math.floor(i / columns) + 0.3 * next())) / rows,
      v = (2 * Math.PI * ((i % columns) + 0.3 * next())) / columns;
    xyz.set(
      [(R + r * Math.cos(v)) * Math.cos(u), (R + r * Math.cos(v)) * Math.sin(u), r * Math.sin(v)],
      3 * i,
    );
  }
  const at = (i, j) => ((i + rows) % rows) * columns + ((j + columns) % columns);
  const length = (a, b) =>
    Math.hypot(
      xyz[3 * a] - xyz[3 * b],
      xyz[3 * a + 1] - xyz[3 * b + 1],
      xyz[3 * a + 2] - xyz[3 * b + 2],
    );
  const edges = [];
  for (let a = 0; a < n; ++a)
    for (let b = 0; b < a; ++b) if (length(a, b) < 0.8) edges.push([a, b, length(a, b)]);
  const tree = mergeTree(new Float64Array(n), edges);
  const bars = tree.merges.map((m) => ({
    bar: [0, 0, m.value],
    birth: [m.younger],
    death: [m.youngerEnd, m.elderEnd],
  }));
  bars.push({ bar: [0, 0, Infinity], birth: [0], death: [], chain: [0] });
  const loop = (count, point) =>
    Array.from({ length: count }, (_, k) => [point(k), point(k + 1)]).flat();
  const along = loop(columns, (j) => at(0, j)),
    around = loop(rows, (i) => at(i, columns / 2));
  const skin = [];
  for (let i = 0; i < rows; ++i)
    for (let j = 0; j < columns; ++j)
      skin.push(at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
  bars.push({
    bar: [1, 0.31, 1.33],
    birth: along.slice(0, 2),
    death: [at(0, 0), at(0, 7), at(0, 14)],
    chain: along,
  });
  bars.push({
    bar: [1, 0.36, 2.05],
    birth: around.slice(0, 2),
    death: [at(0, 11), at(15, 11), at(30, 11)],
    chain: around,
  });
  bars.push({
    bar: [2, 0.52, 1.36],
    birth: skin.slice(0, 3),
    death: [at(0, 0), at(0, 5), at(0, 11), at(0, 16)],
    chain: skin,
  });
  for (let k = 0; k < 160; ++k) {
    const a = at(Math.floor(next() * rows), Math.floor(next() * columns)),
      birth = 0.22 + 0.16 * next();
    const i = Math.floor(a / columns),
      j = a % columns,
      square = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
    bars.push({
      bar: [1, birth, birth + 0.12 * next() ** 3 + 1e-3],
      birth: square.slice(0, 2),
      death: square.slice(0, 3),
      chain: loop(4, (q) => square[q % 4]),
    });
  }
  bars.sort((a, b) => byOrder(a.bar, b.bar));
  const meta = metaOf("torus.csv", {
    value: { label: "Diameter" },
    barcodes: [{ name: "torus.csv", cells: "vertices", representatives: "cycles" }],
    cloud: { metric: "euclidean" },
    provenance: {
      complex: "rips",
      max_dim: 2,
      threshold: 2.4,
      input: { path: "torus.csv", description: `${n} points in R^3, CSV` },
      command: [
        "ph-barcode",
        "torus.csv",
        "--max-dim",
        "2",
        "--representatives",
        "cycles",
        "--report",
        "torus.html",
      ],
    },
  });
  const chained = bars.map((b, i) => ({ ...b, i })).filter((b) => b.chain);
  const start = [0];
  for (const b of chained) start.push(start.at(-1) + b.chain.length / (b.bar[0] + 1));
  return {
    meta,
    arrays: {
      ...barArrays(bars.map((b) => b.bar)),
      "bars/birth_cells": Uint32Array.from(bars.flatMap((b) => b.birth)),
      "bars/death_cells": Uint32Array.from(bars.flatMap((b) => b.death)),
      "chains/bar": Uint32Array.from(chained, (b) => b.i),
      "chains/start": Uint32Array.from(start),
      "chains/cells": Uint32Array.from(chained.flatMap((b) => b.chain)),
      "points/position": quantised(xyz, 3),
    },
  };
}

/// Clusters in the plane with the tree of their Vietoris-Rips components.
export function clusters(n = 900) {
  const next = random(3),
    xy = new Float64Array(2 * n);
  const normal = () => Math.sqrt(-2 * Math.log(1 - next())) * Math.cos(2 * Math.PI * next());
  const centres = [
    [0, 0, 0.5],
    [4, 1, 0.4],
    [1.5, 4, 0.6],
    [5, 5, 0.3],
    [-3, 3, 0.35],
  ];
  for (let i = 0; i < n; ++i) {
    const [x, y, s] = centres[i % centres.length];
    xy.set([x + s * normal(), y + s * normal()], 2 * i);
  }
  const edges = [];
  for (let a = 0; a < n; ++a)
    for (let b = 0; b < a; ++b) {
      const d = Math.hypot(xy[2 * a] - xy[2 * b], xy[2 * a + 1] - xy[2 * b + 1]);
      if (d < 4) edges.push([a, b, d]);
    }
  const tree = mergeTree(new Float64Array(n), edges),
    points = Uint32Array.from({ length: n }, (_, i) => i);
  const bars = [...tree.merges.map((m) => [0, 0, m.value]), [0, 0, Infinity]];
  const { arrays } = contracted(tree, points, {
    rule: "value",
    barOf: (m) => tree.merges.indexOf(m),
  });
  const meta = metaOf("clusters.csv", {
    cloud: { metric: "euclidean" },
    tree: { rule: "value", label: "distance", cut: 0.6, what: "cluster", min_size: 5 },
    provenance: {
      complex: "rips",
      max_dim: 0,
      input: { path: "clusters.csv", description: `${n} points in R^2, CSV` },
    },
  });
  return {
    meta,
    tree,
    vertexOfPoint: points,
    options: { rule: "value", minSize: 5 },
    arrays: {
      ...barArrays(bars),
      ...arrays,
      "tree/leaf_bar": Uint32Array.of(0, n - 1),
      "points/position": quantised(xy, 2),
    },
  };
}
