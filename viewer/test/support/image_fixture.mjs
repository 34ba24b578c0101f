// SPDX-License-Identifier: MIT
import { barArrays, byOrder, kNone, metaOf } from "./fixture_parts.mjs";
import { contracted, mergeTree } from "./reference_tree.mjs";
import { random } from "./random.mjs";

/// A grey picture of dark blobs, or a volume of hollow balls, with the merge tree of its sublevel
/// sets.
export function image(shape = [120, 160]) {
  const next = random(11),
    size = shape.reduce((a, b) => a * b, 1),
    axes = shape.length;
  const blobs = Array.from({ length: 14 }, () => ({
    at: shape.map((s) => s * (0.1 + 0.8 * next())),
    r: Math.min(...shape) * (0.07 + 0.09 * next()),
    depth: 60 + 150 * next(),
  }));
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
      if (c + 1 < shape[k])
        edges.push([v, v + strides[k], Math.max(values[v], values[v + strides[k]])]);
    });
  const births = Float64Array.from(values),
    tree = mergeTree(births, edges);
  const lasting = tree.merges.filter((m) => m.persistence > 0);
  const bars = lasting.map((m) => ({
    bar: [0, births[m.younger], m.value],
    birth: m.younger,
    merge: m,
  }));
  const least = values.indexOf(Math.min(...values));
  bars.push({ bar: [0, values[least], Infinity], birth: least });
  bars.sort((a, b) => byOrder(a.bar, b.bar));
  const place2 = (v) => place(v).map((c) => 2 * c);
  const numberOf = new Map(bars.map((b, i) => [b.merge, i]));
  const points = Uint32Array.from({ length: size }, (_, v) => v);
  const { arrays, leafOf } = contracted(tree, points, {
    rule: "persistence",
    from: 1,
    barOf: (m) => numberOf.get(m) ?? kNone,
  });
  const loops = squareLoop(shape);
  const all = [...bars.map((b) => b.bar), ...loops.map((l) => l.bar)];
  const name = axes === 3 ? "balls.npy" : "blobs.png";
  const meta = metaOf(name, {
    value: { label: "Grey value" },
    image: { construction: "vertices" },
    barcodes: [{ name, cells: "grid", representatives: "cycles" }],
    tree: {
      rule: "persistence",
      label: "persistence",
      cut: 25,
      from: 1,
      what: "basin",
      min_size: 1,
    },
    provenance: {
      complex: "cubical",
      engine: "gradient",
      input: { path: name, description: `image of ${shape.join(" x ")} voxels` },
    },
  });
  return {
    meta,
    tree,
    vertexOfPoint: points,
    options: { rule: "persistence" },
    arrays: {
      ...barArrays(all),
      "bars/birth_cells": Uint32Array.from([
        ...bars.flatMap((b) => place2(b.birth)),
        ...loops.flatMap((l) => l.cells.slice(0, axes)),
      ]),
      "chains/bar": Uint32Array.from(loops, (_, i) => bars.length + i),
      "chains/start": Uint32Array.from(
        [0, ...loops.map((l) => l.cells.length / axes)].map(
          (
            (sum) => (v) =>
              (sum += v)
          )(0),
        ),
      ),
      "chains/cells": Uint32Array.from(loops.flatMap((l) => l.cells)),
      "image/values": [values, { shape, filter: "delta" }],
      ...arrays,
      "tree/leaf_bar": Uint32Array.of(leafOf[least], numberOf.get(undefined)),
    },
  };
}

/// One loop of edges (and in a volume one closed surface of squares) in doubled coordinates.
function squareLoop(shape) {
  const axes = shape.length,
    from = shape.map((s) => 2 * Math.floor(s / 4)),
    to = shape.map((s) => 2 * Math.floor((3 * s) / 4));
  const [a, b] = [axes - 2, axes - 1],
    edges = [];
  const middle = shape.map((s) => 2 * Math.floor(s / 2));
  for (const side of [from, to]) {
    for (let v = from[b] + 1; v < to[b]; v += 2)
      edges.push(middle.map((c, k) => (k === a ? side[a] : k === b ? v : c)));
    for (let v = from[a] + 1; v < to[a]; v += 2)
      edges.push(middle.map((c, k) => (k === b ? side[b] : k === a ? v : c)));
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
