// SPDX-License-Identifier: MIT
// The merge tree with every vertex, its cuts as the programs make them, and its contraction for a
// report. It follows libph/src/facade/merge_tree.cpp and libsegment/src/objects/components.cpp, not
// the page.

class DisjointSets {
  constructor(size) {
    this.parent = Uint32Array.from({ length: size }, (_, i) => i);
  }
  find(v) {
    while (this.parent[v] !== v) v = this.parent[v] = this.parent[this.parent[v]];
    return v;
  }
  link(child, root) {
    this.parent[child] = root;
  }
}

/// The merge tree of a graph by the elder rule; among equal births, the vertex with the smaller
/// number is older. @param births the birth of each vertex. @param edges [u, v, value] for each
/// edge.
export function mergeTree(births, edges) {
  const values = Float64Array.from(edges, (e) => e[2]);
  const order = Uint32Array.from(edges, (_, i) => i).sort((i, j) => values[i] - values[j] || i - j);
  const sets = new DisjointSets(births.length),
    size = new Uint32Array(births.length).fill(1);
  const oldest = Uint32Array.from(births, (_, i) => i);
  const merges = [];
  for (const i of order) {
    const [u, v, value] = edges[i];
    let a = sets.find(u),
      b = sets.find(v),
      ends = [u, v];
    if (a === b) continue;
    const before = births[oldest[a]] - births[oldest[b]] || oldest[a] - oldest[b];
    if (before < 0) [a, b, ends] = [b, a, [v, u]]; // a: the younger one
    merges.push({
      value,
      younger: oldest[a],
      elder: oldest[b],
      youngerEnd: ends[0],
      elderEnd: ends[1],
      persistence: value === births[oldest[a]] ? 0 : value - births[oldest[a]],
      least: Math.min(size[a], size[b]),
    });
    sets.link(a, b);
    size[b] += size[a];
  }
  return { births, merges };
}

/// The segments of a cut. @param vertexOfPoint the vertex of each point; 0xffffffff: none.
/// @param flat a component with a share of `least` of its vertices `on` a plane is not a segment.
export function cutOf(tree, vertexOfPoint, { rule, cut, minPart = 1, minSize = 1, flat }) {
  const n = tree.births.length,
    sets = new DisjointSets(n);
  for (const m of tree.merges) {
    const separates = rule === "value" ? m.value > cut : m.persistence >= cut && m.least >= minPart;
    if (!separates) sets.link(sets.find(m.youngerEnd), sets.find(m.elderEnd));
  }
  const components = new Map();
  for (let v = 0; v < n; ++v) {
    if (rule === "value" && tree.births[v] > cut) continue;
    const root = sets.find(v);
    if (!components.has(root)) components.set(root, { root, first: v, points: 0, voxels: 0, on: 0 });
    ++components.get(root).voxels;
    components.get(root).on += flat?.on[v] ?? 0;
  }
  for (const v of vertexOfPoint)
    if (v !== 0xffffffff && components.has(sets.find(v))) ++components.get(sets.find(v)).points;
  const kept = [...components.values()]
    .filter((c) => c.voxels >= minSize && !(flat && c.on >= flat.least * c.voxels))
    .sort((a, b) => b.points - a.points || b.voxels - a.voxels || a.first - b.first);
  const label = new Map(kept.map((c, i) => [c.root, i + 1]));
  return {
    segments: kept,
    labels: Uint32Array.from(vertexOfPoint, (v) =>
      v === 0xffffffff || (rule === "value" && tree.births[v] > cut)
        ? 0
        : (label.get(sets.find(v)) ?? 0),
    ),
  };
}

/// The tree of a report: merges that some cut leaves undone stay, and all others are contracted.
/// @param from the least cut. @param barOf returns the bar that a merge kills.
export function contracted(
  tree,
  vertexOfPoint,
  { rule, minPart = 1, from = 0, barOf = () => 0xffffffff },
) {
  const n = tree.births.length,
    sets = new DisjointSets(n);
  const stays = (m) =>
    rule === "value" ? m.value > from : m.least >= minPart && m.persistence >= from;
  for (const m of tree.merges)
    if (!stays(m)) sets.link(sets.find(m.youngerEnd), sets.find(m.elderEnd));
  const leafOfRoot = new Map(),
    leafOf = new Uint32Array(n);
  const birth = [],
    points = [],
    vertices = [];
  for (let v = 0; v < n; ++v) {
    const root = sets.find(v);
    if (!leafOfRoot.has(root)) {
      leafOfRoot.set(root, birth.length);
      birth.push(Infinity);
      points.push(0);
      vertices.push(0);
    }
    const leaf = (leafOf[v] = leafOfRoot.get(root));
    ++vertices[leaf];
    birth[leaf] = Math.min(birth[leaf], tree.births[v]);
  }
  for (const v of vertexOfPoint) if (v !== 0xffffffff) ++points[leafOf[v]];
  const kept = tree.merges.filter(stays);
  const wide = birth.length >= 0xffff;
  const leaf = Array.from(vertexOfPoint, (v) =>
    v === 0xffffffff ? (wide ? 0xffffffff : 0xffff) : leafOf[v],
  );
  return {
    leafOf,
    arrays: {
      "points/leaf": wide ? Uint32Array.from(leaf) : Uint16Array.from(leaf),
      "tree/leaf_birth": Float64Array.from(birth),
      "tree/leaf_points": Uint32Array.from(points),
      "tree/leaf_vertices": Uint32Array.from(vertices),
      "tree/merge_younger": Uint32Array.from(kept, (m) => leafOf[m.youngerEnd]),
      "tree/merge_elder": Uint32Array.from(kept, (m) => leafOf[m.elderEnd]),
      "tree/merge_value": Float64Array.from(kept, (m) => m.value),
      "tree/merge_level": Float64Array.from(kept, (m) =>
        rule === "value" ? m.value : m.persistence,
      ),
      "tree/merge_bar": Uint32Array.from(kept, barOf),
    },
  };
}
