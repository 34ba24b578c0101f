// SPDX-License-Identifier: MIT
import { barArrays, byOrder, kNone, metaOf } from "./fixture_parts.mjs";
import { contracted, cutOf, mergeTree } from "./reference_tree.mjs";
import { random } from "./random.mjs";
import { octahedral, quantised } from "./write_report.mjs";

/// The distances of the two nearest spots, and their numbers.
function twoNearest(spots, x, y) {
  let first = [Infinity, -1],
    second = first;
  for (let k = 0; k < spots.length; ++k) {
    const distance = Math.hypot(x - spots[k][0], y - spots[k][1]);
    if (distance < first[0]) [first, second] = [[distance, k], first];
    else if (distance < second[0]) second = [distance, k];
  }
  return [first, second];
}

/// The program's result for the parts of its cut: two pairs of parts form one object each, and the
/// second largest part is a wall. The table is the first surface.
function answerOf(tree, vertexOfPoint, parts, leafOf, arrays) {
  const joined = new Map([[7, 3], [5, 10]]), // part 7 joins part 3, part 5 joins part 10
    wall = 1;
  const leaves = arrays["tree/leaf_birth"].length;
  const partOfLeaf = new Int32Array(leaves).fill(-1);
  vertexOfPoint.forEach((v, i) => {
    if (v !== kNone) partOfLeaf[leafOf[v]] = parts.labels[i] - 1;
  });
  const places = parts.segments.map((_, k) => k).filter((k) => !joined.has(k) && k !== wall);
  const points = (k) => {
    const others = [...joined].filter(([, into]) => into === k).map(([from]) => from);
    return [k, ...others].reduce((sum, part) => sum + parts.segments[part].points, 0);
  };
  places.sort((a, b) => points(b) - points(a));
  const labels = Uint32Array.from(
    partOfLeaf,
    (part) => places.indexOf(joined.get(part) ?? part) + 1,
  );
  const onWall = Array.from(partOfLeaf, (part) => part === wall);
  const palette = ["#e69f00", "#0072b2", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442"];
  return {
    flat: { on: Uint8Array.from(tree.births, (_, v) => Number(onWall[leafOf[v]])), least: 0.85 },
    answer: {
      points: places.map(points),
      scene: {
        segments: places.map((_, i) => ({
          number: i + 1,
          colour: palette[i % 7],
          persistence: i === 0 ? null : 1.5 * i,
          role: i === 2 ? "container" : "object",
          ...(i === 3 ? { on_segment: 1 } : i === 2 ? {} : { on_surface: 1 }),
        })),
        surfaces: [{ role: "support" }, { role: "wall" }],
        removed: 1,
        flat: 0.85,
        objects: true,
      },
      arrays: {
        "tree/leaf_label": labels,
        "tree/leaf_surface": Uint8Array.from(onWall, (is) => (is ? 2 : 0)),
        "tree/leaf_on": [
          Uint32Array.from(onWall, (is, leaf) => (is ? arrays["tree/leaf_vertices"][leaf] : 0)),
          { shape: [leaves, 1] },
        ],
      },
    },
  };
}

/// A scene as ph-segment sees one: an organised cloud of rounded objects on a table, seams between
/// them, parts of one object that the program joined, a wall, ground truth.
export function scene(width = 640, height = 536, { seeds = 26 } = {}) {
  const next = random(5),
    n = width * height;
  const spots = Array.from({ length: seeds }, () => [
    width * next(),
    height * (0.15 + 0.85 * next()),
    0.25 + 0.5 * next(),
  ]);
  const xyz = new Float32Array(3 * n),
    rgb = new Uint8Array(3 * n),
    truth = new Uint16Array(n),
    births = new Float64Array(n);
  const normals = new Int8Array(2 * n),
    vertexOfPoint = new Uint32Array(n);
  for (let i = 0; i < n; ++i) {
    const x = i % width,
      y = Math.floor(i / width);
    const d = twoNearest(spots, x, y);
    const gap = (d[1][0] - d[0][0]) / width,
      bulge = Math.max(0, 1 - (6 * d[0][0]) / width);
    const z =
      1.6 - (0.5 * y) / height - 0.1 * spots[d[0][1]][2] - 0.08 * bulge + 0.001 * (next() - 0.5);
    xyz.set([((x - width / 2) * z) / width, ((y - height / 2) * z) / width, z], 3 * i);
    births[i] =
      Math.round(
        1e6 *
          (0.6 *
            Math.exp(-((gap * 60) ** 2)) *
            (0.15 + spots[d[0][1]][2] * 0.5 + spots[d[1][1]][2] * 0.5) +
            0.012 * next()),
      ) / 1e6;
    const inside = d[0][0] < width / 4;
    truth[i] = inside ? d[0][1] + 1 : 0;
    vertexOfPoint[i] = inside ? i : kNone;
    const shade = 90 + 100 * bulge + 12 * next();
    rgb.set(
      [
        shade * (0.6 + 0.4 * ((d[0][1] * 0.37) % 1)),
        shade * (0.6 + 0.4 * ((d[0][1] * 0.71) % 1)),
        shade * 0.7,
      ],
      3 * i,
    );
    normals.set(
      octahedral([(x - spots[d[0][1]][0]) / width, (y - spots[d[0][1]][1]) / width, -0.3]),
      2 * i,
    );
  }
  const edges = [];
  for (let i = 0; i < n; ++i) {
    if (vertexOfPoint[i] === kNone) continue;
    for (const [j, ok] of [
      [i + 1, (i + 1) % width !== 0],
      [i + width, i + width < n],
    ])
      if (ok && vertexOfPoint[j] !== kNone) edges.push([j, i, Math.max(births[i], births[j])]);
  }
  const tree = mergeTree(
    births.map((b, i) => (vertexOfPoint[i] === kNone ? Infinity : b)),
    edges,
  );
  // Vertices that never enter are not leaves: the tree gets only the vertices that enter, under new
  // numbers.
  const entered = [...vertexOfPoint].filter((v) => v !== kNone);
  const number = new Map(entered.map((v, k) => [v, k]));
  const inner = {
    births: Float64Array.from(entered, (v) => births[v]),
    merges: tree.merges.map((m) => ({
      ...m,
      younger: number.get(m.younger),
      elder: number.get(m.elder),
      youngerEnd: number.get(m.youngerEnd),
      elderEnd: number.get(m.elderEnd),
    })),
  };
  const ofPoint = vertexOfPoint.map((v) => (v === kNone ? kNone : number.get(v)));
  const options = { rule: "persistence", minPart: 200, minSize: 32 };
  const lasting = inner.merges.filter((m) => m.persistence > 0);
  const bars = lasting.map((m) => ({ bar: [0, inner.births[m.younger], m.value], merge: m }));
  const least = inner.births.indexOf(inner.births.reduce((a, b) => Math.min(a, b)));
  bars.push({ bar: [0, inner.births[least], Infinity] });
  bars.sort((a, b) => byOrder(a.bar, b.bar));
  const numberOf = new Map(bars.map((b, i) => [b.merge, i]));
  const { arrays, leafOf } = contracted(inner, ofPoint, {
    ...options,
    barOf: (m) => numberOf.get(m) ?? kNone,
  });
  const touching = new Set();
  for (const [j, i] of edges) {
    const a = leafOf[ofPoint[i]],
      b = leafOf[ofPoint[j]];
    if (a !== b) touching.add(`${Math.min(a, b)},${Math.max(a, b)}`);
  }
  const pairs = [...touching]
    .map((t) => t.split(",").map(Number))
    .sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const cut = 0.05,
    parts = cutOf(inner, ofPoint, { ...options, cut });
  const { answer, flat } = answerOf(inner, ofPoint, parts, leafOf, arrays);
  const meta = metaOf("desk.pcd", {
    program: "ph-segment 0.1.0",
    value: { label: "Concavity" },
    cloud: { unit: "m", viewpoint: [0, 0, 0], up: [0, -1, 0] },
    tree: {
      rule: "persistence",
      label: "least persistence",
      cut,
      min_size: 32,
      command: [
        "ph-segment",
        "desk.pcd",
        "--min-persistence",
        "{cut}",
        "--parts",
        "--labels",
        "labels.npy",
      ],
    },
    scene: answer.scene,
    provenance: {
      version: "ph-segment 0.1.0",
      engine: "union-find",
      command: ["ph-segment", "desk.pcd", "--report", "desk.html"],
      input: { path: "desk.pcd", description: `${n} points, PCD, ${width} x ${height}` },
      notes: {
        Plane: "found, 41 % of the points in range",
        "Cross-check": "equal to boundary-matrix reduction",
      },
      warnings: ["2 focal lengths differ by more than a tenth"],
    },
  });
  return {
    meta,
    tree: inner,
    vertexOfPoint: ofPoint,
    options: { ...options, flat },
    answer,
    arrays: {
      ...barArrays(bars.map((b) => b.bar)),
      ...arrays,
      "tree/leaf_bar": Uint32Array.of(leafOf[least], numberOf.get(undefined)),
      "tree/touching": [
        Uint32Array.from(pairs.flat()),
        { shape: [pairs.length, 2], filter: "delta planes" },
      ],
      ...answer.arrays,
      "points/surface": Uint8Array.from(ofPoint, (v) => Number(v === kNone)),
      "points/position": quantised(xyz, 3),
      "points/rgb": [rgb, { shape: [n, 3], filter: "delta" }],
      "points/normal": [normals, { shape: [n, 2], filter: "delta" }],
      "points/truth": truth,
    },
  };
}
