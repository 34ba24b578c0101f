# SPDX-License-Identifier: MIT
"""Computes the required results of ph-segment from docs/explanation/segmentation.md: points in
range, voxels, components of the Vietoris-Rips complex, and cuts of a merge tree. Comparisons that
depend on rounding are treated separately."""
import math
from fractions import Fraction

import numpy as np
from scipy.spatial import cKDTree

ROUNDING = 1e-12
MOST_EDGES = 60000


class Unsure(Exception):
    """The result depends on rounding, or would take too long to compute."""


class Sets:
    def __init__(self, count):
        self.up = list(range(count))

    def find(self, v):
        while self.up[v] != v:
            self.up[v] = self.up[self.up[v]]
            v = self.up[v]
        return v

    def join(self, u, v):
        """@return True if the two sets were separate."""
        u, v = self.find(u), self.find(v)
        self.up[max(u, v)] = min(u, v)
        return u != v

    def names(self):
        return np.array([self.find(v) for v in range(len(self.up))], int)


def as_floats(xyz):
    """The coordinates as 32-bit floats; coordinates outside their range become holes."""
    with np.errstate(over="ignore"):
        return xyz.astype("f4").astype("f8")


def in_range(xyz, viewpoint, max_range, crop):
    """@return a mask of the points in range. @throws Unsure"""
    with np.errstate(invalid="ignore", over="ignore"):
        square = ((xyz - viewpoint) ** 2).sum(axis=1)
        kept = np.isfinite(xyz).all(axis=1)
        if math.isfinite(max_range):
            limit = max_range * max_range
            for i in np.nonzero(kept & (abs(square - limit) <= ROUNDING * limit))[0]:
                exact = sum((Fraction(a) - Fraction(b)) ** 2 for a, b in zip(xyz[i].tolist(), map(float, viewpoint)))
                if exact != Fraction(max_range) ** 2 or square[i] != limit:
                    raise Unsure("a point at the border of the range")
            kept &= square <= limit
        if crop is not None:
            low, high = np.array(crop[::2]), np.array(crop[1::2])
            kept &= ((xyz >= low) & (xyz <= high)).all(axis=1)
    return kept


class Voxels:
    """The cubes with points, and the centroids of these points, in the order of the grid, z
    slowest."""

    def __init__(self, xyz, edge):
        with np.errstate(over="ignore"):
            units = xyz / edge
        cells = np.floor(units)
        self.edge = edge
        self.cells, self.of_point, self.counts = np.unique(cells[:, ::-1] + 0.0, axis=0, return_inverse=True,
                                                           return_counts=True)
        self.of_point = self.of_point.reshape(-1)
        self.cells = self.cells[:, ::-1]
        inside = units - cells
        sums = np.zeros((len(self.cells), 3))
        np.add.at(sums, self.of_point, inside)
        self.centroids = (self.cells + sums / self.counts[:, None]) * edge
        # The centroid is exact if no number is rounded: coordinates have few bits, and their sum is
        # divided by a power of two.
        grain = inside * 2 ** 10
        rough = np.zeros(len(self.cells), bool)
        np.logical_or.at(rough, self.of_point, (grain != np.floor(grain)).any(axis=1))
        self.exact = ~rough & (self.counts & (self.counts - 1) == 0) & (self.counts < 1024) & \
            (abs(self.cells).max(axis=1, initial=0) < 2 ** 20) & (math.frexp(edge)[0] == 0.5)
        self.error = 1e-9 * edge + 4e-16 * abs(self.centroids).max(initial=0)

    def __len__(self):
        return len(self.cells)


def close_pairs(voxels, distance):
    """@return the pairs of voxels at most `distance` apart, and their distances. @throws Unsure"""
    if len(voxels) < 2:
        return np.zeros((0, 2), int), np.zeros(0)
    unit = 1 / voxels.edge  # prevents squares from underflowing
    tree = cKDTree(voxels.centroids * unit)
    slack = distance * unit * (1 + 1e-9) + 3 * voxels.error * unit
    if tree.count_neighbors(tree, slack) > 2 * MOST_EDGES:
        raise Unsure("too many edges")
    pairs = tree.query_pairs(slack, output_type="ndarray")
    if len(pairs) == 0:
        return np.zeros((0, 2), int), np.zeros(0)
    apart = (voxels.centroids[pairs[:, 0]] - voxels.centroids[pairs[:, 1]]) * unit
    length = np.sqrt((apart ** 2).sum(axis=1)) * voxels.edge
    both = voxels.exact[pairs].all(axis=1)
    near = abs(length - distance) <= np.where(both, 1e-14 * distance, 3 * voxels.error + 1e-14 * distance)
    for k in np.nonzero(near)[0]:
        square = sum(Fraction(x) ** 2 for x in (apart[k] * voxels.edge).tolist())
        if not both[k] or square != Fraction(length[k]) ** 2:
            raise Unsure("an edge of the largest distance")
    kept = length <= distance
    return pairs[kept], length[kept]


def levels(voxels, length, distance, steps):
    """The value of each edge. @throws Unsure"""
    if steps == 0 or len(length) == 0:
        return length
    if distance == 0:
        return np.zeros(len(length))
    exact = length / distance * steps
    k = np.ceil(exact)
    off = abs(exact - np.round(exact)) * distance / steps
    near = (off <= 3 * voxels.error + 1e-13 * distance) & (length < distance)
    if near.any():
        raise Unsure("an edge at a level")
    return np.where(k >= steps, distance, k * distance / steps)


class Rips:
    """The graph of method paper, and the merge tree of its components."""

    def __init__(self, voxels, distance, steps):
        self.pairs, self.lengths = close_pairs(voxels, distance)
        self.voxels, self.distance, self.steps = voxels, distance, steps

    def values(self):
        return levels(self.voxels, self.lengths, self.distance, self.steps)

    def components(self, cut):
        """The components at a distance. @throws Unsure"""
        sets = Sets(len(self.voxels))
        if cut == self.distance:
            chosen = self.pairs
        else:
            values = self.values()
            slack = 1e-12 * cut + (3 * self.voxels.error if self.steps == 0 else 0)
            if (abs(values - cut) <= slack).any():
                raise Unsure("a cut at a value")
            chosen = self.pairs[values <= cut]
        for u, v in chosen.tolist():
            sets.join(u, v)
        return sets.names()

    def deaths(self):
        values, sets = self.values(), Sets(len(self.voxels))
        order = np.argsort(values, kind="stable")
        return [values[k] for k in order.tolist() if sets.join(*self.pairs[k].tolist())]


def basins(merges, count, value, least_part):
    """Cuts a merge tree, whose merges have the form of the program's JSON. @return the basin of
    each vertex."""
    sets = Sets(count)
    for m in merges:
        separates = m["value"] - m["younger_birth"] >= value and \
            min(m["elder_size"], m["younger_size"]) >= least_part
        if not separates:
            sets.join(*m["edge"])
    return sets.names()


def replay(tree):
    """The first violation of the elder rule by the merges of a tree, or None."""
    births = [math.inf if v["birth"] is None else v["birth"] for v in tree["vertices"]]
    sets, size, first = Sets(len(births)), [1] * len(births), list(range(len(births)))
    last = -math.inf
    for k, m in enumerate(tree["merges"]):
        a, b = (sets.find(v) for v in m["edge"])
        if a == b:
            return f"merge {k} joins what is one"
        if m["value"] < last or m["value"] < max(births[v] for v in m["edge"]):
            return f"merge {k} comes before it can"
        last = m["value"]
        if {first[a], first[b]} != {m["elder"], m["younger"]}:
            return f"merge {k} names other vertices"
        elder, younger = (a, b) if first[a] == m["elder"] else (b, a)
        found = [m["elder_size"], m["younger_size"], m["elder_birth"], m["younger_birth"]]
        expected = [size[elder], size[younger], births[m["elder"]], births[m["younger"]]]
        if found != expected or births[m["elder"]] > births[m["younger"]]:
            return f"merge {k}: found {found}, expected {expected}"
        sets.join(a, b)
        root = sets.find(a)
        size[root], first[root] = size[elder] + size[younger], m["elder"]
    return None


def meeting(tree, labels, a, b):
    """The value at which two segments join, when the parts of each are joined from the start; None
    if they never join. @param labels of the vertices"""
    sets = Sets(len(labels))
    ends = [np.nonzero(labels == x)[0].tolist() for x in (a, b)]
    for members in ends:
        for v in members:
            sets.join(members[0], v)
    for m in tree["merges"]:
        sets.join(*m["edge"])
        if sets.find(ends[0][0]) == sets.find(ends[1][0]):
            return m["value"]
    return None
