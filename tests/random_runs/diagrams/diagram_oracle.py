# SPDX-License-Identifier: MIT
"""Distances between persistence diagrams by their definitions: each bar has a place on the
diagonal, and one assignment covers all bars. Reads no files, and shares nothing with libph. Needs
NumPy and SciPy.

A diagram is a list of bars (birth, death) of one dimension. Bars of length 0 do not count."""
import itertools
import math

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import maximum_bipartite_matching

INF = math.inf
FEW = 2000  # up to this number of ways to pair bars, all are tried


def kinds(bars):
    """@return four kinds of bars: the finite bars; the births of bars that are born and never die,
    sorted; the deaths of bars that always existed and die, sorted; and the number of bars that
    always existed and never die."""
    finite = [(b, e) for b, e in bars if b < e and not math.isinf(b) and not math.isinf(e)]
    rays = sorted(b for b, e in bars if b > -INF and e == INF)
    always = sorted(e for b, e in bars if b == -INF and e < INF)
    return finite, rays, always, sum(b == -INF and e == INF for b, e in bars)


def same_numbers(a, b):
    """True if both diagrams have the same number of infinite bars of each kind; otherwise, their
    distance is infinite."""
    a, b = kinds(a), kinds(b)
    return (len(a[1]), len(a[2]), a[3]) == (len(b[1]), len(b[2]), b[3])


def differences(a, b):
    """The distances between infinite bars, which are paired in the order of their finite ends."""
    return [abs(x - y) for k in (1, 2) for x, y in zip(kinds(a)[k], kinds(b)[k])]


def norm(x, y, ground):
    largest = max(x, y)
    if ground == INF or largest == 0:
        return largest
    return largest * ((x / largest) ** ground + (y / largest) ** ground) ** (1 / ground)


def costs(a, b, ground):
    """Costs of finite bars: of each pair, of each unmatched bar of `a`, and of each unmatched bar
    of `b`."""
    pairs = np.zeros((len(a), len(b)))
    for (i, p), (j, q) in itertools.product(enumerate(a), enumerate(b)):
        pairs[i, j] = norm(abs(p[0] - q[0]), abs(p[1] - q[1]), ground)
    factor = 1 if ground == INF else 2 ** (1 / ground)
    return (pairs, *(np.array([(e - b) / 2 * factor for b, e in bars]) for bars in (a, b)))


def square(pairs, alone_a, alone_b):
    """The square matrix of costs. Rows are the bars of `a`, then a place on the diagonal for each
    bar of `b`; columns are the bars of `b`, then a place for each bar of `a`. A bar can only go to
    its own place on the diagonal."""
    n, m = pairs.shape
    table = np.full((n + m, n + m), INF)
    table[:n, :m] = pairs
    table[range(n), range(m, m + n)] = alone_a
    table[range(n, n + m), range(m)] = alone_b
    table[n:, m:] = 0
    return table


def bottleneck(a, b):
    """The bottleneck distance. It is exact, because it equals one of the differences that are
    computed in double precision."""
    if not same_numbers(a, b):
        return INF
    least = max(differences(a, b), default=0.0)
    table = square(*costs(kinds(a)[0], kinds(b)[0], INF))
    values = [0.0, *np.unique(table[np.isfinite(table)])]
    low, high = 0, len(values) - 1
    while low < high:
        middle = (low + high) // 2
        matched = maximum_bipartite_matching(csr_matrix(table <= values[middle]), perm_type="column")
        if (matched >= 0).all():
            high = middle
        else:
            low = middle + 1
    return max(least, float(values[low]))


def ways(n, m):
    """The number of ways to pair n bars with m bars."""
    return sum(math.comb(n, k) * math.comb(m, k) * math.factorial(k) for k in range(min(n, m) + 1))


def least_of_all(pairs, alone_a, alone_b):
    """The least sum, by trying all ways to pair the bars."""
    best = INF
    n, m = pairs.shape
    for k in range(min(n, m) + 1):
        for own in itertools.combinations(range(n), k):
            rest_a = [alone_a[i] for i in range(n) if i not in own]
            for others in itertools.permutations(range(m), k):
                rest = [alone_b[j] for j in range(m) if j not in others]
                best = min(best, math.fsum([*(pairs[i, j] for i, j in zip(own, others)), *rest_a, *rest]))
    return best


def wasserstein(a, b, order, ground):
    """@return the distance, and the distance if all finite bars were unmatched."""
    if not same_numbers(a, b):
        return INF, INF
    rays = differences(a, b)
    pairs, alone_a, alone_b = costs(kinds(a)[0], kinds(b)[0], ground)
    unit = max([*rays, *alone_a, *alone_b], default=0)
    if unit == 0:
        return 0.0, 0.0
    with np.errstate(over="ignore"):  # a pair that overflows costs more than the diagonal
        pairs, alone_a, alone_b = ((c / unit) ** order for c in (pairs, alone_a, alone_b))
    if ways(*pairs.shape) <= FEW:
        least = least_of_all(pairs, alone_a, alone_b)
    else:
        table = square(pairs, alone_a, alone_b)
        table[~np.isfinite(table)] = 1e6 * sum(table.shape)
        rows, columns = linear_sum_assignment(table)
        least = math.fsum(table[rows, columns])
    powers = math.fsum((x / unit) ** order for x in rays)
    alone = math.fsum([*alone_a, *alone_b, powers])
    return unit * (least + powers) ** (1 / order), unit * alone ** (1 / order)


def sliced(a, b, directions):
    if not same_numbers(a, b):
        return INF
    first, second = kinds(a)[0], kinds(b)[0]
    nearest = [[(x / 2 + y / 2,) * 2 for x, y in bars] for bars in (first, second)]
    lists = np.array(first + nearest[1]).reshape(-1, 2), np.array(second + nearest[0]).reshape(-1, 2)
    total = []
    for k in range(directions):
        line = np.array([math.cos(k * math.pi / directions), math.sin(k * math.pi / directions)])
        one, other = (np.sort(points @ line) for points in lists)
        total.append(math.fsum(np.abs(one - other)))
    return math.fsum(total) / directions + math.fsum(differences(a, b))


def loss(distances, labels, power):
    """The loss of --groups. For each group of n barcodes, the powers of the distances are summed
    over ordered pairs, and the sum is divided by 2 n (n - 1). The loss is the total of all groups.
    @param distances a square matrix."""
    total = 0.0
    for word in sorted(set(labels)):
        own = [i for i, w in enumerate(labels) if w == word]
        within = math.fsum(distances[i][j] ** power for i, j in itertools.permutations(own, 2))
        total += within / (2 * len(own) * (len(own) - 1))
    return total


def deals(labels):
    """All ways to assign the labels, each once."""
    return set(itertools.permutations(labels))
