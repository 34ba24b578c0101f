// SPDX-License-Identifier: MIT
// Reports of made-up data: each function gives the metadata and the arrays of one.
import { contracted, cutOf, mergeTree } from "./reference_tree.mjs";
import { random } from "./random.mjs";
import { octahedral, quantised } from "./write_report.mjs";

const kNone = 0xffffffff;

/// @param bars [dim, birth, death] each.
export function barArrays(bars, prefix = "bars") {
  return {
    [`${prefix}/dim`]: Uint8Array.from(bars, (b) => b[0]),
    [`${prefix}/birth`]: Float64Array.from(bars, (b) => b[1]),
    [`${prefix}/death`]: Float64Array.from(bars, (b) => b[2]),
  };
}

export function metaOf(title, more = {}) {
  return {
    format: "ph-report", version: 1, title, program: "ph-barcode 0.1.0",
    value: { label: "Filtration value" }, barcodes: [{ name: title, cells: "vertices" }],
    ...more,
    provenance: {
      version: "ph-barcode 0.1.0", command: ["ph-barcode", title, "--report", "out.html"], field: 2,
      input: { path: title, sha256: "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855" },
      engine: "lens", timings: { read: 0.0021, persistence: 0.184, write: 0.02 }, peak_memory: 41_000_000,
      ...more.provenance,
    },
  };
}

const byOrder = (a, b) => a[0] - b[0] || a[1] - b[1] || a[2] - b[2];

/// A torus of `rows` by `columns` points, its two loops and its void with their cycles.
export function torus(rows = 44, columns = 22) {
  const next = random(7), n = rows * columns, R = 2, r = 0.8;
  const xyz = new Float64Array(3 * n);
  for (let i = 0; i < n; ++i) {
    const u = (2 * Math.PI * (Math.floor(i / columns) + 0.3 * next())) / rows, v = (2 * Math.PI * ((i % columns) + 0.3 * next())) / columns;
    xyz.set([(R + r * Math.cos(v)) * Math.cos(u), (R + r * Math.cos(v)) * Math.sin(u), r * Math.sin(v)], 3 * i);
  }
  const at = (i, j) => ((i + rows) % rows) * columns + ((j + columns) % columns);
  const length = (a, b) => Math.hypot(xyz[3 * a] - xyz[3 * b], xyz[3 * a + 1] - xyz[3 * b + 1], xyz[3 * a + 2] - xyz[3 * b + 2]);
  const edges = [];
  for (let a = 0; a < n; ++a) for (let b = 0; b < a; ++b) if (length(a, b) < 0.8) edges.push([a, b, length(a, b)]);
  const tree = mergeTree(new Float64Array(n), edges);
  const bars = tree.merges.map((m) => ({ bar: [0, 0, m.value], birth: [m.younger], death: [m.youngerEnd, m.elderEnd] }));
  bars.push({ bar: [0, 0, Infinity], birth: [0], death: [], chain: [0] });
  const loop = (count, point) => Array.from({ length: count }, (_, k) => [point(k), point(k + 1)]).flat();
  const along = loop(columns, (j) => at(0, j)), around = loop(rows, (i) => at(i, columns / 2));
  const skin = [];
  for (let i = 0; i < rows; ++i) for (let j = 0; j < columns; ++j)
    skin.push(at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
  bars.push({ bar: [1, 0.31, 1.33], birth: along.slice(0, 2), death: [at(0, 0), at(0, 7), at(0, 14)], chain: along });
  bars.push({ bar: [1, 0.36, 2.05], birth: around.slice(0, 2), death: [at(0, 11), at(15, 11), at(30, 11)], chain: around });
  bars.push({ bar: [2, 0.52, 1.36], birth: skin.slice(0, 3), death: [at(0, 0), at(0, 5), at(0, 11), at(0, 16)], chain: skin });
  for (let k = 0; k < 160; ++k) {
    const a = at(Math.floor(next() * rows), Math.floor(next() * columns)), birth = 0.22 + 0.16 * next();
    const i = Math.floor(a / columns), j = a % columns, square = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
    bars.push({ bar: [1, birth, birth + 0.12 * next() ** 3 + 1e-3], birth: square.slice(0, 2), death: square.slice(0, 3), chain: loop(4, (q) => square[q % 4]) });
  }
  bars.sort((a, b) => byOrder(a.bar, b.bar));
  const meta = metaOf("torus.csv", {
    value: { label: "Diameter" }, barcodes: [{ name: "torus.csv", cells: "vertices", representatives: "cycles" }],
    cloud: { metric: "euclidean" },
    provenance: { complex: "rips", max_dim: 2, threshold: 2.4, input: { path: "torus.csv", description: `${n} points in R^3, CSV` }, command: ["ph-barcode", "torus.csv", "--max-dim", "2", "--representatives", "cycles", "--report", "torus.html"] },
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
  const next = random(3), xy = new Float64Array(2 * n);
  const normal = () => Math.sqrt(-2 * Math.log(1 - next())) * Math.cos(2 * Math.PI * next());
  const centres = [[0, 0, 0.5], [4, 1, 0.4], [1.5, 4, 0.6], [5, 5, 0.3], [-3, 3, 0.35]];
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
  const tree = mergeTree(new Float64Array(n), edges), points = Uint32Array.from({ length: n }, (_, i) => i);
  const bars = [...tree.merges.map((m) => [0, 0, m.value]), [0, 0, Infinity]];
  const { arrays } = contracted(tree, points, { rule: "value", barOf: (m) => tree.merges.indexOf(m) });
  const meta = metaOf("clusters.csv", {
    cloud: { metric: "euclidean" },
    tree: { rule: "value", label: "distance", cut: 0.6, what: "cluster", min_size: 5 },
    provenance: { complex: "rips", max_dim: 0, input: { path: "clusters.csv", description: `${n} points in R^2, CSV` } },
  });
  return {
    meta, tree, vertexOfPoint: points, options: { rule: "value", minSize: 5 },
    arrays: { ...barArrays(bars), ...arrays, "tree/leaf_bar": Uint32Array.of(0, n - 1), "points/position": quantised(xy, 2) },
  };
}

/// A grey picture of dark blobs, or a volume of hollow balls; its tree is that of sublevel sets.
export function image(shape = [120, 160]) {
  const next = random(11), size = shape.reduce((a, b) => a * b, 1), axes = shape.length;
  const blobs = Array.from({ length: 14 }, () => ({ at: shape.map((s) => s * (0.1 + 0.8 * next())), r: Math.min(...shape) * (0.07 + 0.09 * next()), depth: 60 + 150 * next() }));
  const place = (v) => {
    const at = [];
    for (let k = axes - 1; k >= 0; --k) {
      at[k] = v % shape[k];
      v = Math.floor(v / shape[k]);
    }
    return at;
  };
  const values = Uint8Array.from({ length: size }, (_, v) => {
    const p = place(v);
    let grey = 230 - 12 * next();
    for (const b of blobs) {
      const d = Math.hypot(...p.map((c, k) => c - b.at[k])) / b.r;
      grey -= b.depth * (axes === 3 ? Math.exp(-((d - 1) ** 2) * 6) : Math.exp(-d * d));
    }
    return Math.max(0, Math.min(255, Math.round(grey)));
  });
  const strides = shape.map((_, k) => shape.slice(k + 1).reduce((a, b) => a * b, 1));
  const edges = [];
  for (let v = 0; v < size; ++v)
    place(v).forEach((c, k) => {
      if (c + 1 < shape[k]) edges.push([v, v + strides[k], Math.max(values[v], values[v + strides[k]])]);
    });
  const births = Float64Array.from(values), tree = mergeTree(births, edges);
  const lasting = tree.merges.filter((m) => m.persistence > 0);
  const bars = lasting.map((m) => ({ bar: [0, births[m.younger], m.value], birth: m.younger, merge: m }));
  const least = values.indexOf(Math.min(...values));
  bars.push({ bar: [0, values[least], Infinity], birth: least });
  bars.sort((a, b) => byOrder(a.bar, b.bar));
  const place2 = (v) => place(v).map((c) => 2 * c);
  const numberOf = new Map(bars.map((b, i) => [b.merge, i]));
  const points = Uint32Array.from({ length: size }, (_, v) => v);
  const { arrays, leafOf } = contracted(tree, points, { rule: "persistence", from: 1, barOf: (m) => numberOf.get(m) ?? kNone });
  const loops = squareLoop(shape);
  const all = [...bars.map((b) => b.bar), ...loops.map((l) => l.bar)];
  const name = axes === 3 ? "balls.npy" : "blobs.png";
  const meta = metaOf(name, {
    value: { label: "Grey value" }, image: { construction: "vertices" },
    barcodes: [{ name, cells: "grid", representatives: "cycles" }],
    tree: { rule: "persistence", label: "persistence", cut: 25, from: 1, what: "basin", min_size: 1 },
    provenance: { complex: "cubical", engine: "arrows", input: { path: name, description: `image of ${shape.join(" x ")} voxels` } },
  });
  return {
    meta, tree, vertexOfPoint: points, options: { rule: "persistence" },
    arrays: {
      ...barArrays(all),
      "bars/birth_cells": Uint32Array.from([...bars.flatMap((b) => place2(b.birth)), ...loops.flatMap((l) => l.cells.slice(0, axes))]),
      "chains/bar": Uint32Array.from(loops, (_, i) => bars.length + i),
      "chains/start": Uint32Array.from([0, ...loops.map((l) => l.cells.length / axes)].map(((sum) => (v) => (sum += v))(0))),
      "chains/cells": Uint32Array.from(loops.flatMap((l) => l.cells)),
      "image/values": [values, { shape, filter: "delta" }],
      ...arrays,
      "tree/leaf_bar": Uint32Array.of(leafOf[least], numberOf.get(undefined)),
    },
  };
}

/// One loop of edges (and in a volume one closed surface of squares) in doubled coordinates.
function squareLoop(shape) {
  const axes = shape.length, from = shape.map((s) => 2 * Math.floor(s / 4)), to = shape.map((s) => 2 * Math.floor((3 * s) / 4));
  const [a, b] = [axes - 2, axes - 1], edges = [];
  const middle = shape.map((s) => 2 * Math.floor(s / 2));
  for (const side of [from, to]) {
    for (let v = from[b] + 1; v < to[b]; v += 2) edges.push(middle.map((c, k) => (k === a ? side[a] : k === b ? v : c)));
    for (let v = from[a] + 1; v < to[a]; v += 2) edges.push(middle.map((c, k) => (k === b ? side[b] : k === a ? v : c)));
  }
  const result = [{ bar: [1, 90, 180], cells: edges.flat() }];
  if (axes === 3) {
    const squares = [];
    for (const flat of [0, 1, 2])
      for (const side of [from[flat], to[flat]]) {
        const [p, q] = [0, 1, 2].filter((k) => k !== flat);
        for (let i = from[p] + 1; i < to[p]; i += 2)
          for (let j = from[q] + 1; j < to[q]; j += 2) {
            const cell = [0, 0, 0];
            cell[flat] = side;
            cell[p] = i;
            cell[q] = j;
            squares.push(...cell);
          }
      }
    result.push({ bar: [2, 120, 201], cells: squares });
  }
  return result;
}

/// A scene as ph-segment sees one: an organised cloud of rounded objects on a table, seams between
/// them, parts of one object that the program joined, ground truth.
export function scene(width = 640, height = 536, { seeds = 26 } = {}) {
  const next = random(5), n = width * height;
  const spots = Array.from({ length: seeds }, () => [width * next(), height * (0.15 + 0.85 * next()), 0.25 + 0.5 * next()]);
  const xyz = new Float32Array(3 * n), rgb = new Uint8Array(3 * n), truth = new Uint16Array(n), births = new Float64Array(n);
  const normals = new Int8Array(2 * n), vertexOfPoint = new Uint32Array(n);
  for (let i = 0; i < n; ++i) {
    const x = i % width, y = Math.floor(i / width);
    const d = spots.map(([sx, sy], k) => [Math.hypot(x - sx, y - sy), k]).sort((a, b) => a[0] - b[0]);
    const gap = (d[1][0] - d[0][0]) / width, bulge = Math.max(0, 1 - (6 * d[0][0]) / width);
    const z = 1.6 - (0.5 * y) / height - 0.1 * spots[d[0][1]][2] - 0.08 * bulge + 0.001 * (next() - 0.5);
    xyz.set([((x - width / 2) * z) / width, ((y - height / 2) * z) / width, z], 3 * i);
    births[i] = Math.round(1e6 * (0.6 * Math.exp(-((gap * 60) ** 2)) * (0.15 + spots[d[0][1]][2] * 0.5 + spots[d[1][1]][2] * 0.5) + 0.012 * next())) / 1e6;
    const inside = d[0][0] < width / 4;
    truth[i] = inside ? d[0][1] + 1 : 0;
    vertexOfPoint[i] = inside ? i : kNone;
    const shade = 90 + 100 * bulge + 12 * next();
    rgb.set([shade * (0.6 + 0.4 * ((d[0][1] * 0.37) % 1)), shade * (0.6 + 0.4 * ((d[0][1] * 0.71) % 1)), shade * 0.7], 3 * i);
    normals.set(octahedral([(x - spots[d[0][1]][0]) / width, (y - spots[d[0][1]][1]) / width, -0.3]), 2 * i);
  }
  const edges = [];
  for (let i = 0; i < n; ++i) {
    if (vertexOfPoint[i] === kNone) continue;
    for (const [j, ok] of [[i + 1, (i + 1) % width !== 0], [i + width, i + width < n]])
      if (ok && vertexOfPoint[j] !== kNone) edges.push([j, i, Math.max(births[i], births[j])]);
  }
  const tree = mergeTree(births.map((b, i) => (vertexOfPoint[i] === kNone ? Infinity : b)), edges);
  // Vertices that never enter are no leaves: give the tree those that do, under new numbers.
  const entered = [...vertexOfPoint].filter((v) => v !== kNone);
  const number = new Map(entered.map((v, k) => [v, k]));
  const inner = {
    births: Float64Array.from(entered, (v) => births[v]),
    merges: tree.merges.map((m) => ({ ...m, younger: number.get(m.younger), elder: number.get(m.elder), youngerEnd: number.get(m.youngerEnd), elderEnd: number.get(m.elderEnd) })),
  };
  const ofPoint = vertexOfPoint.map((v) => (v === kNone ? kNone : number.get(v)));
  const options = { rule: "persistence", minPart: 200, minSize: 32 };
  const lasting = inner.merges.filter((m) => m.persistence > 0);
  const bars = lasting.map((m) => ({ bar: [0, inner.births[m.younger], m.value], merge: m }));
  const least = inner.births.indexOf(inner.births.reduce((a, b) => Math.min(a, b)));
  bars.push({ bar: [0, inner.births[least], Infinity] });
  bars.sort((a, b) => byOrder(a.bar, b.bar));
  const numberOf = new Map(bars.map((b, i) => [b.merge, i]));
  const { arrays, leafOf } = contracted(inner, ofPoint, { ...options, barOf: (m) => numberOf.get(m) ?? kNone });
  const touching = new Set();
  for (const [j, i] of edges) {
    const a = leafOf[ofPoint[i]], b = leafOf[ofPoint[j]];
    if (a !== b) touching.add(`${Math.min(a, b)},${Math.max(a, b)}`);
  }
  const pairs = [...touching].map((t) => t.split(",").map(Number)).sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const cut = 0.05, parts = cutOf(inner, ofPoint, { ...options, cut });
  const joins = Uint32Array.of(leafOf[parts.segments[3].first], leafOf[parts.segments[7].first], leafOf[parts.segments[10].first], leafOf[parts.segments[5].first]);
  const meta = metaOf("desk.pcd", {
    program: "ph-segment 0.1.0", value: { label: "Concavity" },
    cloud: { unit: "m", viewpoint: [0, 0, 0], up: [0, -1, 0], width, height },
    tree: {
      rule: "persistence", label: "least persistence", cut, min_size: 32, joined: true,
      command: ["ph-segment", "desk.pcd", "--min-persistence", "{cut}", "--parts", "--labels", "labels.npy"],
    },
    provenance: {
      version: "ph-segment 0.1.0", engine: "union_find", command: ["ph-segment", "desk.pcd", "--report", "desk.html"],
      input: { path: "desk.pcd", description: `${n} points, PCD, ${width} x ${height}` },
      notes: { Plane: "found, 41 % of the points in range", "Cross-check": "equal to boundary-matrix reduction" },
      warnings: ["2 focal lengths differ by more than a tenth"],
    },
  });
  return {
    meta, tree: inner, vertexOfPoint: ofPoint, options, joinedAt: cut,
    arrays: {
      ...barArrays(bars.map((b) => b.bar)), ...arrays,
      "tree/leaf_bar": Uint32Array.of(leafOf[least], numberOf.get(undefined)),
      "tree/touching": [Uint32Array.from(pairs.flat()), { shape: [pairs.length, 2], filter: "delta planes" }],
      "tree/joins": [joins, { shape: [2, 2] }],
      "points/position": quantised(xyz, 3),
      "points/rgb": [rgb, { shape: [n, 3], filter: "delta" }],
      "points/normal": [normals, { shape: [n, 2], filter: "delta" }],
      "points/truth": truth,
    },
  };
}
