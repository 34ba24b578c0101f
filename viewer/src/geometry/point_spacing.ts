// SPDX-License-Identifier: MIT
// Measures the distance between neighbouring points, which a mark must cover so that a surface has
// no holes.

const kSampled = 800,
  kMostCompared = 4000, // number of points compared with one point
  kOutermost = 0.01, // share of the points at each end of an axis that may be outliers
  kNeighbours = 4; // in a grid, the four nearest points are one spacing away

/// The median, over some points, of the distance to the fourth nearest other place. With an eye,
/// this distance is divided by the distance from the eye, because a camera samples equal angles. 0
/// if unknown.
export function spacingOf(positions: Float32Array, eye?: ArrayLike<number>): number {
  const count = positions.length / 3;
  if (count <= kNeighbours) return 0;
  const grid = new Grid(positions);
  const found: number[] = [];
  const sampled = Math.min(count, kSampled);
  for (let k = 0; k < sampled; ++k) {
    const i = Math.floor((k * count) / sampled);
    const distance = grid.neighbour(i);
    if (!Number.isFinite(distance)) continue;
    const away = eye
      ? Math.hypot(...[0, 1, 2].map((c) => positions[3 * i + c]! - eye[c]!)) || Infinity
      : 1;
    found.push(distance / away);
  }
  return found.sort((a, b) => a - b)[found.length >> 1] ?? 0;
}

/// Points sorted into cubes; the cubes share the lists of a hash table.
class Grid {
  private readonly low: number[] = [];
  private readonly cube: number;
  private readonly start: Uint32Array;
  private readonly members: Uint32Array;
  private readonly mask: number;

  constructor(private readonly positions: Float32Array) {
    const count = positions.length / 3;
    const size: number[] = [];
    for (let c = 0; c < 3; ++c) {
      const step = Math.max(1, Math.floor(count / 20_000));
      const sample = new Float32Array(Math.ceil(count / step));
      for (let i = 0; i < sample.length; ++i) sample[i] = positions[3 * i * step + c]!;
      sample.sort();
      const cut = Math.floor(kOutermost * sample.length);
      this.low.push(sample[cut]!);
      size.push(sample[sample.length - 1 - cut]! - sample[cut]!);
    }
    // Assumes that the points cover an area with the two longer sides of the box. The edge of the
    // cubes is chosen such that each cube on this area holds some points.
    const [long, middle] = size.sort((a, b) => b - a) as [number, number];
    this.cube = 2.5 * Math.sqrt((long * Math.max(middle, long / count)) / count) || 1;
    this.mask = 2 ** Math.ceil(Math.log2(count + 1)) - 1;
    this.start = new Uint32Array(this.mask + 2);
    const list = new Uint32Array(count);
    for (let i = 0; i < count; ++i) {
      list[i] = this.listOf(...this.cubeOf(i));
      ++this.start[list[i]! + 1]!;
    }
    for (let k = 1; k < this.start.length; ++k) this.start[k]! += this.start[k - 1]!;
    const next = this.start.slice();
    this.members = new Uint32Array(count);
    for (let i = 0; i < count; ++i) this.members[next[list[i]!]!++] = i;
  }

  /// The distance of the fourth nearest other place; infinite if it lies beyond the neighbouring
  /// cubes.
  neighbour(of: number): number {
    const nearest = new Array<number>(kNeighbours).fill(Infinity);
    const lists = new Set<number>();
    const [x, y, z] = this.cubeOf(of);
    for (let dx = -1; dx <= 1; ++dx)
      for (let dy = -1; dy <= 1; ++dy)
        for (let dz = -1; dz <= 1; ++dz) lists.add(this.listOf(x + dx, y + dy, z + dz));
    const p = this.positions;
    let members = 0;
    for (const list of lists) members += this.start[list + 1]! - this.start[list]!;
    // In crowded cubes, only every n-th point is examined. On a surface, this makes the distance
    // larger by a factor of √n, which is divided out below.
    const step = Math.ceil(members / kMostCompared);
    for (const list of lists)
      for (let k = this.start[list]!; k < this.start[list + 1]!; k += step) {
        const i = this.members[k]!;
        const square =
          (p[3 * i]! - p[3 * of]!) ** 2 +
          (p[3 * i + 1]! - p[3 * of + 1]!) ** 2 +
          (p[3 * i + 2]! - p[3 * of + 2]!) ** 2;
        if (square === 0 || square >= nearest[kNeighbours - 1]!) continue;
        let at = kNeighbours - 1;
        for (; at > 0 && nearest[at - 1]! > square; --at) nearest[at] = nearest[at - 1]!;
        nearest[at] = square;
      }
    const distance = Math.sqrt(nearest[kNeighbours - 1]! / step);
    return distance <= this.cube ? distance : Infinity;
  }

  private cubeOf(i: number): [number, number, number] {
    const at = (c: number) => Math.floor((this.positions[3 * i + c]! - this.low[c]!) / this.cube);
    return [at(0), at(1), at(2)];
  }
  private listOf(x: number, y: number, z: number): number {
    return (Math.imul(x, 73856093) ^ Math.imul(y, 19349663) ^ Math.imul(z, 83492791)) & this.mask;
  }
}
