# SPDX-License-Identifier: MIT
"""Compares ph-cluster with the definitions of HDBSCAN*, applied to the matrix of all distances: from
the top down, all edges of one value are removed at once. Skipped without NumPy."""
import math
import os
import random
import sys

try:
    import numpy
except ImportError:
    print("skipped: NumPy is missing")
    sys.exit(77)

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, main  # noqa: E402

TRIALS = 300
METRICS = {"euclidean": lambda d: numpy.sqrt((d * d).sum(-1)), "manhattan": lambda d: numpy.abs(d).sum(-1),
           "chebyshev": lambda d: numpy.abs(d).max(-1)}


def inverse(value):
    return math.inf if value == 0 else 1 / value


def parts_of(reach, points, value):
    """The components of the points when only edges below a value are left."""
    left, parts = set(points), []
    while left:
        part, new = set(), {min(left)}
        while new:
            part |= new
            left -= new
            new = {q for q in left if any(reach[p, q] < value for p in new)}
        parts.append(sorted(part))
    return parts


class Cluster:
    """A cluster, what leaves it, and the clusters inside it."""

    def __init__(self, reach, points, top, least_size, leaves_at, own):
        self.points, self.top, self.children = points, top, []
        lives = {}
        while True:
            # The value at which the points break apart.
            value = 0.0
            reached, rest = {points[0]}, set(points[1:])
            while rest:
                nearest, q = min((min(reach[p, q] for p in reached), q) for q in rest)
                value = max(value, nearest)
                reached.add(q)
                rest.remove(q)
            parts = parts_of(reach, points, value)
            real = [part for part in parts if len(part) >= least_size]
            for part in parts:
                if part in real:
                    continue
                for p in part:
                    lives[p], leaves_at[p], own[p] = value, value, self
            if len(real) != 1:
                break
            points = real[0]
        self.bottom = value
        for part in real:
            lives.update(dict.fromkeys(part, value))
        self.mass = sum(inverse(v) - inverse(top) for v in lives.values())
        self.children = [Cluster(reach, part, value, least_size, leaves_at, own) for part in real]
        self.least = min([self.bottom, *(c.least for c in self.children)])
        for child in self.children:
            child.parent = self

    def all(self):
        yield self
        for child in self.children:
            yield from child.all()


class Close(Exception):
    """Two sums differ by so little that rounding could decide."""


def heaviest(cluster, root, options):
    """The clusters at or inside a cluster with the largest total mass, and this mass."""
    chosen, best = [], 0.0
    for child in cluster.children:
        more, mass = heaviest(child, root, options)
        chosen += more
        best += mass
    may = (cluster is not root or options["single"]) and len(cluster.points) <= options["max_size"]
    if may and best != cluster.mass and math.isclose(best, cluster.mass, rel_tol=1e-9):
        raise Close
    return ([cluster], cluster.mass) if may and cluster.mass >= best else (chosen, best)


def selection(root, options):
    if options["method"] == "eom":
        chosen, _ = heaviest(root, root, options)
    else:
        chosen = [c for c in root.all() if not c.children and (c is not root or options["single"])]
    wide = []
    for cluster in chosen:
        while cluster is not root and cluster.top < options["epsilon"] and (
                options["single"] or cluster.parent is not root):
            cluster = cluster.parent
        if cluster not in wide:
            wide.append(cluster)
    return [c for c in wide if not any(c is not d and set(c.points) <= set(d.points) for d in wide)]


def expected(points, k, least_size, metric, options):
    """@return labels, probabilities and outlier scores."""
    n = len(points)
    distances = METRICS[metric](points[:, None] - points[None])
    others = numpy.sort(distances + numpy.diag([math.inf] * n), axis=1)
    core = others[:, k - 1] if k else numpy.zeros(n)
    reach = numpy.maximum(distances, numpy.maximum(core[:, None], core[None]))
    leaves_at, own = [0.0] * n, [None] * n
    root = Cluster(reach, list(range(n)), math.inf, least_size, leaves_at, own)
    labels, shares = [-1] * n, [0.0] * n
    chosen = sorted(selection(root, options), key=lambda c: min(c.points))
    if chosen == [root]:
        limit = options["epsilon"] or root.bottom
        members = [[p for p in root.points if leaves_at[p] <= limit]]
    else:
        members = [c.points for c in chosen]
    number = 0
    for cluster, group in zip(chosen, members):
        for p in group:
            labels[p] = number
            shares[p] = 1.0 if leaves_at[p] <= cluster.bottom else cluster.bottom / leaves_at[p]
        number += 1
    scores = [0.0 if v == 0 else 1 - cluster.least / v for v, cluster in zip(leaves_at, own)]
    return labels, shares, scores


class Definition(ProgramTest):
    def trial(self, seed):
        rng = random.Random(seed)
        kind = rng.choice(("uniform", "blobs", "grid", "copies"))
        n, axes = rng.randrange(10, 36), rng.randrange(1, 4)
        if kind == "uniform":
            rows = [[rng.random() for _ in range(axes)] for _ in range(n)]
        elif kind == "blobs":
            rows = [[rng.gauss(3 * rng.randrange(3), .3) for _ in range(axes)] for _ in range(n)]
        else:
            side = 12 if kind == "grid" else 4
            rows = [[float(rng.randrange(side)) for _ in range(axes)] for _ in range(n)]
        least_size, k = rng.randrange(2, 6), rng.randrange(0, 5)
        metric = rng.choice(sorted(METRICS))
        options = {"method": rng.choice(("eom", "leaf")), "epsilon": rng.choice((0, 0, rng.uniform(.05, 3))),
                   "single": rng.random() < .3, "max_size": math.inf}
        more = []
        if options["method"] == "eom" and rng.random() < .3:
            options["max_size"] = rng.randrange(least_size, n)
            more = ["--max-size", str(options["max_size"])]
        if options["single"]:
            more.append("--allow-single")
        if options["epsilon"]:
            more += ["--epsilon", repr(options["epsilon"])]
        self.write("p.txt", "".join(" ".join(map(repr, row)) + "\n" for row in rows))
        run = self.expect(0, "p.txt", "--format", "points", "--min-size", str(least_size), "--neighbours", str(k),
                          "--metric", metric, "--method", options["method"], *more, "--scores", "--quiet")
        found = [line.split(",") for line in run.stdout.splitlines()[1:]]
        labels, shares, scores = expected(numpy.array(rows), k, least_size, metric, options)
        what = (seed, kind, k, least_size, metric, options)
        self.assertEqual([int(row[0]) for row in found], labels, what)
        for column, values in ((1, shares), (2, scores)):
            for row, value in zip(found, values):
                self.assertAlmostEqual(float(row[column]), value, 12, what)
        return len(set(labels) - {-1})

    def test_random_points(self):
        counts, close = {}, 0
        for seed in range(TRIALS):
            try:
                count = self.trial(seed)
                counts[count] = counts.get(count, 0) + 1
            except Close:
                close += 1
        print(f"{TRIALS} trials, {close} of them left to rounding; "
              f"by number of clusters: {dict(sorted(counts.items()))}")
        self.assertLess(close, TRIALS / 20)
        self.assertGreater(sum(counts.get(count, 0) for count in range(2, 9)), TRIALS / 4)


if __name__ == "__main__":
    main()
