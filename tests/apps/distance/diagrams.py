# SPDX-License-Identifier: MIT
"""Random barcodes, and the distances between them by the definition: all ways to pair the bars are
tried."""
import csv
import io
import itertools
import math
import random

INF = math.inf


def csv_of(bars):
    return "dim,birth,death\n" + "".join(f"{d},{b},{e}\n" for d, b, e in bars)


def random_bars(seed, counts, grid=None):
    """@param counts for each dimension, the number of bars, and how many of them never die. @param
    grid if it is not None, births and deaths are multiples of 1 / grid."""
    chance = random.Random(seed)
    bars = []
    for dim, (finite, infinite) in counts.items():
        for k in range(finite + infinite):
            birth, death = sorted((chance.random(), chance.random()))
            if grid:
                birth, death = math.floor(birth * grid) / grid, math.floor(death * grid) / grid
            bars.append((dim, birth, death if k < finite else INF))
    return bars


def of_dim(bars, dim):
    return [(b, e) for d, b, e in bars if d == dim]


def norm(x, y, ground):
    return max(x, y) if ground == INF else (x**ground + y**ground)**(1 / ground)


def to_diagonal(bar, ground):
    middle = (bar[0] + bar[1]) / 2
    return norm(middle - bar[0], bar[1] - middle, ground)


def costs_of(a, b, ground):
    """The matrix of costs. Rows are the bars of `a`, followed by a place on the diagonal for each
    bar of `b`; columns are the bars of `b`, followed by a place for each bar of `a`."""
    return ([[norm(abs(p[0] - q[0]), abs(p[1] - q[1]), ground) for q in b]
             + [to_diagonal(p, ground)] * len(a) for p in a]
            + [[to_diagonal(q, ground) for q in b] + [0.0] * len(a) for _ in b])


def total(costs, order):
    return max(costs, default=0.0) if order == INF else math.fsum(c**order for c in costs)**(1 / order)


def distance(a, b, order=INF, ground=INF):
    """The distance between two barcodes of one dimension with few bars. An infinite `order` gives
    the bottleneck distance."""
    finite = [[bar for bar in bars if bar[1] < INF] for bars in (a, b)]
    rays = [sorted(bar[0] for bar in bars if bar[1] == INF) for bars in (a, b)]
    if len(rays[0]) != len(rays[1]):
        return INF
    costs = costs_of(*finite, ground)
    best = min(total([costs[i][j] for i, j in enumerate(order_of)], order)
               for order_of in itertools.permutations(range(len(costs))))
    return total([best, *(abs(x - y) for x, y in zip(*rays))], order)


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))
