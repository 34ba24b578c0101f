// SPDX-License-Identifier: MIT
// Finds pairs of points that are near each other, and the triangles that edges form.

/// The pairs i < j of points at a distance of at most `r`, as one flat list; undefined if there are
/// more than `most` pairs. @param p x, y, z of each point.
function pairsWithin(p: Float32Array, r: number, most: number): number[] | undefined {
  const cubes = cubesOf(p, r);
  const pairs: number[] = [];
  const meet = (i: number, j: number) => {
    if (distance(p, i, j) <= r) pairs.push(Math.min(i, j), Math.max(i, j));
  };
  for (const { points, next } of cubes.values()) {
    for (let a = 0; a < points.length; ++a) {
      for (let b = 0; b < a; ++b) meet(points[b]!, points[a]!);
      for (const key of next) for (const j of cubes.get(key)?.points ?? []) meet(points[a]!, j);
      if (pairs.length > 2 * most) return undefined;
    }
  }
  return pairs;
}

interface Cube {
  points: number[];
  next: number[]; // names of the neighbouring cubes that come after this cube
}

function cubesOf(p: Float32Array, r: number): Map<number, Cube> {
  const low = [Infinity, Infinity, Infinity];
  let extent = 0;
  for (let i = 0; i < p.length; ++i) low[i % 3] = Math.min(low[i % 3]!, p[i]!);
  for (let i = 0; i < p.length; ++i) extent = Math.max(extent, p[i]! - low[i % 3]!);
  // Names of cubes must be exactly representable numbers.
  const side = Math.max(r, extent / 2 ** 16) || 1;
  const kStride = 2 ** 17;
  const cubes = new Map<number, Cube>();
  for (let i = 0; 3 * i < p.length; ++i) {
    let key = 0;
    for (let k = 0; k < 3; ++k)
      key = key * kStride + Math.floor((p[3 * i + k]! - low[k]!) / side) + 1;
    const cube = cubes.get(key);
    if (cube) cube.points.push(i);
    else {
      const next: number[] = [];
      for (let step = 14; step < 27; ++step)
        next.push(
          key + (Math.floor(step / 9) - 1) * kStride ** 2 +
            ((Math.floor(step / 3) % 3) - 1) * kStride + ((step % 3) - 1),
        );
      cubes.set(key, { points: [i], next });
    }
  }
  return cubes;
}

function distance(p: Float32Array, i: number, j: number): number {
  return Math.hypot(
    p[3 * i]! - p[3 * j]!,
    p[3 * i + 1]! - p[3 * j + 1]!,
    p[3 * i + 2]! - p[3 * j + 2]!,
  );
}

export interface SortedPairs {
  ends: Uint32Array; // two numbers per pair
  values: Float32Array | Float64Array; // ascending
  missingFrom: number; // pairs at or above this value may be missing
}

/// The shortest pairs up to a distance of `limit`, at most `most` of them. A few guesses determine
/// the radius of the search, so fewer pairs may be found, usually more than four fifths of `most`.
export function shortestPairs(p: Float32Array, limit: number, most: number): SortedPairs {
  let best: number[] = [],
    reach = 0,
    over = Infinity;
  // The search doubles the radius while it finds few enough pairs, or divides it by 8 while it
  // finds too many; then it bisects.
  let guess = limit / 64;
  for (let round = 0; round < 24 && reach < limit; ++round) {
    const pairs = pairsWithin(p, guess, most);
    if (pairs) [best, reach] = [pairs, guess];
    else over = guess;
    if (best.length > 1.6 * most) break; // four fifths of `most` are enough
    if (over === Infinity) guess = Math.min(limit, 2 * reach);
    else guess = reach > 0 ? (reach + over) / 2 : over / 8;
  }
  const length = (at: number) => distance(p, best[2 * at]!, best[2 * at + 1]!);
  const lengths = Float32Array.from({ length: best.length / 2 }, (_, at) => length(at));
  const order = Uint32Array.from(lengths, (_, at) => at).sort((a, b) => lengths[a]! - lengths[b]!);
  const ends = new Uint32Array(best.length);
  order.forEach((from, to) => ends.set([best[2 * from]!, best[2 * from + 1]!], 2 * to));
  const missingFrom = reach < limit ? reach : Infinity;
  return { ends, values: Float32Array.from(order, (at) => lengths[at]!), missingFrom };
}

/// The triples of points whose pairs are all edges; nothing if there are more than `most`.
/// @param ends pairs i < j, each once.
export function trianglesOf(ends: Uint32Array, most: number): Uint32Array | undefined {
  const above = new Map<number, Set<number>>();
  for (let e = 0; e < ends.length; e += 2) {
    const set = above.get(ends[e]!);
    if (set) set.add(ends[e + 1]!);
    else above.set(ends[e]!, new Set([ends[e + 1]!]));
  }
  const triangles: number[] = [];
  for (let e = 0; e < ends.length; e += 2) {
    const [i, j] = [ends[e]!, ends[e + 1]!];
    const far = above.get(i)!;
    for (const k of above.get(j) ?? []) if (far.has(k)) triangles.push(i, j, k);
    if (triangles.length > 3 * most) return undefined;
  }
  return Uint32Array.from(triangles);
}
