// SPDX-License-Identifier: MIT
// Unusual reports that test a page: nothing, one point, hostile names, a million bars, ties.
import { barArrays, byOrder, metaOf } from "./fixture_parts.mjs";
import { clusters } from "./point_fixtures.mjs";
import { contracted, mergeTree } from "./reference_tree.mjs";
import { random } from "./random.mjs";

const kHostile = `<script>alert(1)</script><img src=x onerror=alert(2)>&amp;"'\u202e--><!--`;

export function empty() {
  return { meta: metaOf("empty.csv"), arrays: barArrays([]) };
}

export function singlePoint() {
  return {
    meta: metaOf("one.csv", {
      cloud: { metric: "euclidean" },
      tree: { rule: "value", cut: 0 },
      provenance: { complex: "rips", input: { description: "1 point in R^3, CSV" } },
    }),
    arrays: {
      ...barArrays([[0, 0, Infinity]]),
      "points/position": [Float64Array.of(1, 2, 3), { shape: [1, 3] }],
      "points/leaf": Uint16Array.of(0),
      "tree/leaf_birth": Float64Array.of(0),
      "tree/leaf_points": Uint32Array.of(1),
      "tree/leaf_vertices": Uint32Array.of(1),
      "tree/leaf_bar": Uint32Array.of(0, 0),
      "tree/merge_younger": new Uint32Array(),
      "tree/merge_elder": new Uint32Array(),
      "tree/merge_value": new Float64Array(),
      "tree/merge_level": new Float64Array(),
    },
  };
}

export function hostile() {
  const { arrays } = twoBarcodes();
  return {
    meta: metaOf(kHostile, {
      value: { label: kHostile, unit: kHostile },
      program: kHostile,
      barcodes: [
        { name: kHostile, cells: "vertices" },
        { name: "</script><script>alert(3)</script>", cells: "vertices" },
      ],
      provenance: {
        version: kHostile,
        command: ["ph-barcode", kHostile, "it's; rm -rf /"],
        complex: kHostile,
        engine: kHostile,
        input: { path: kHostile, description: kHostile, sha256: kHostile },
        warnings: [kHostile],
        notes: { [kHostile]: kHostile },
        timings: { [kHostile]: 1 },
      },
    }),
    arrays,
  };
}

export function twoBarcodes() {
  const make = (seed, shift) => {
    const next = random(seed),
      bars = [[0, 0, Infinity]];
    for (let i = 0; i < 120; ++i) bars.push([0, 0, 0.1 + 0.4 * next()]);
    for (let i = 0; i < 80; ++i) {
      const birth = 0.2 + 0.5 * next();
      bars.push([1, birth, birth + 0.01 + 0.15 * next() ** 2]);
    }
    bars.push([1, 0.4, 1.6 + shift], [1, 0.55, 1.2 - shift]);
    return bars.sort(byOrder);
  };
  return {
    meta: metaOf("monday.csv and tuesday.csv", {
      barcodes: [
        { name: "monday.csv", cells: "vertices" },
        { name: "tuesday.csv", cells: "vertices" },
      ],
      distances: [
        { dim: 0, bottleneck: 0.0123 },
        { dim: 1, bottleneck: null },
      ],
      provenance: {
        command: ["ph-barcode", "--compare", "monday.csv", "tuesday.csv", "--report", "week.html"],
      },
    }),
    arrays: { ...barArrays(make(1, 0)), ...barArrays(make(2, 0.05), "bars2") },
  };
}

export function infiniteOnly() {
  return {
    meta: metaOf("infinite.json"),
    arrays: barArrays([
      [0, 0, Infinity],
      [0, 0, Infinity],
      [0, -Infinity, Infinity],
      [1, 2, Infinity],
    ]),
  };
}

export function manyDims() {
  const next = random(9),
    bars = [];
  for (let dim = 0; dim < 9; ++dim)
    for (let i = 0; i < 12; ++i) {
      const birth = dim + next();
      bars.push([dim, birth, birth + 2 * next() ** 2 + 0.05]);
    }
  return {
    meta: metaOf("sphere8.simplices", { provenance: { complex: "explicit" } }),
    arrays: barArrays(bars.sort(byOrder)),
  };
}

export function ties() {
  const bars = [];
  for (let i = 0; i < 40; ++i) bars.push([0, 0, 1], [1, 1, 2], [1, 1, 1]);
  bars.push([0, 0, Infinity]);
  return { meta: metaOf("ties.csv"), arrays: barArrays(bars.sort(byOrder)) };
}

export function manyBars(n = 1_000_000) {
  const next = random(2),
    bars = [[0, 0, Infinity]];
  for (let i = 1; i < n; ++i) {
    const dim = i % 10 < 4 ? 0 : i % 10 < 9 ? 1 : 2,
      birth = dim === 0 ? 20 * next() : 60 + 60 * next() + 20 * dim;
    bars.push([dim, birth, birth + 0.01 - 8 * Math.log(1 - next()) * (i % 5000 === 0 ? 12 : 1)]);
  }
  return {
    meta: metaOf("brain.nii.gz", {
      value: { label: "Intensity" },
      provenance: {
        complex: "cubical",
        engine: "gradient",
        input: { description: "image of 181 x 217 x 181 voxels, NIfTI-1" },
      },
    }),
    arrays: barArrays(bars.sort(byOrder)),
  };
}

/// A merge tree that was computed from distances, without points.
export function treeOnly() {
  const { meta, arrays } = clusters(200);
  const { cloud, ...rest } = meta;
  delete arrays["points/position"];
  delete arrays["points/leaf"];
  return { meta: { ...rest, title: "matrix.csv" }, arrays };
}

/// Bars with extremely large and small values, and an image with holes.
export function extreme() {
  const bars = [
    [0, -1.7e308, 1.7e308],
    [0, -Infinity, 5e-324],
    [0, 0, 5e-324],
    [1, 1e-300, 1e300],
    [1, 1, Infinity],
  ];
  return {
    meta: metaOf("extreme.npy", { image: {} }),
    arrays: {
      ...barArrays(bars),
      "image/values": [
        Float64Array.of(NaN, -Infinity, Infinity, 0, 1e300, -1e300),
        { shape: [2, 3], filter: "planes" },
      ],
    },
  };
}

/// The components of a few hundred thousand points, each of which is a leaf.
export function manyLeaves(n = 300_000) {
  const next = random(4),
    side = Math.ceil(Math.sqrt(n)),
    xy = new Float64Array(2 * n),
    edges = [];
  for (let i = 0; i < n; ++i) {
    xy.set([(i % side) + next(), Math.floor(i / side) + next()], 2 * i);
    for (const j of [i - 1, i - side])
      if (j >= 0)
        edges.push([j, i, Math.hypot(xy[2 * i] - xy[2 * j], xy[2 * i + 1] - xy[2 * j + 1])]);
  }
  const tree = mergeTree(new Float64Array(n), edges),
    points = Uint32Array.from({ length: n }, (_, i) => i);
  const number = new Map(tree.merges.map((m, i) => [m, i]));
  const { arrays } = contracted(tree, points, { rule: "value", barOf: (m) => number.get(m) });
  return {
    meta: metaOf("many.csv", {
      cloud: { metric: "euclidean" },
      tree: { rule: "value", label: "distance", cut: 0.9, what: "cluster", min_size: 2 },
      provenance: { complex: "rips" },
    }),
    arrays: {
      ...barArrays([...tree.merges.map((m) => [0, 0, m.value]), [0, 0, Infinity]]),
      ...arrays,
      "tree/leaf_bar": Uint32Array.of(0, n - 1),
      "points/position": [Float32Array.from(xy), { shape: [n, 2], filter: "planes" }],
    },
  };
}
