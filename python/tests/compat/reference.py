# SPDX-License-Identifier: MIT
"""Textbook persistent homology, slow and without libph: the reference for the drop-ins."""
import itertools

import numpy as np

INF = np.inf


def sign(vertices):
    """The sign of the permutation that sorts the vertices."""
    pairs = itertools.combinations(vertices, 2)
    return -1 if sum(a > b for a, b in pairs) % 2 else 1


class Flag:
    """A flag filtration. `distances` is a matrix, with inf for each pair of vertices that no edge
    joins. `births` has the birth of each vertex."""

    def __init__(self, distances, births=None, limit=INF):
        self.n = len(distances)
        self.births = np.zeros(self.n) if births is None else np.asarray(births)
        self.d = np.maximum(distances, np.maximum(self.births[:, None], self.births))
        self.d[(np.asarray(distances) > limit) | (self.d == INF)] = INF

    def value(self, simplex):
        pairs = [self.d[a, b] for a, b in itertools.combinations(sorted(simplex), 2)]
        return max(pairs + [self.births[v] for v in simplex])

    def simplices(self, dim):
        """All simplices of a dimension that have a finite value."""
        found = [(self.value(s), s) for s in itertools.combinations(range(self.n), dim + 1)]
        return [(value, s) for value, s in found if value < INF]

    def bars(self, max_dim, p=2):
        """For each dimension, the sorted bars of positive length as a (k, 2) array. Reduces the
        columns of the boundary matrix from left to right."""
        cells = sorted((value, len(s), s) for dim in range(max_dim + 2)
                       for value, s in self.simplices(dim))
        place = {s: i for i, (_, _, s) in enumerate(cells)}
        columns, killed_by, positive = {}, {}, set()
        for j, (_, size, s) in enumerate(cells):
            faces = [s[:k] + s[k + 1:] for k in range(size)] if size > 1 else []
            column = {place[face]: (-1)**k % p for k, face in enumerate(faces)}
            while column and max(column) in killed_by:
                low = max(column)
                other = columns[killed_by[low]]
                factor = -column[low] * pow(other[low], -1, p) % p
                for i, c in other.items():
                    column[i] = (column.get(i, 0) + factor * c) % p
                column = {i: c for i, c in column.items() if c}
            if column:
                killed_by[max(column)], columns[j] = j, column
            else:
                positive.add(j)
        bars = [[] for _ in range(max_dim + 1)]
        for i in positive:
            value, size, _ = cells[i]
            death = cells[killed_by[i]][0] if i in killed_by else INF
            if size <= max_dim + 1 and value != death:
                bars[size - 1].append((value, death))
        return [np.array(sorted(b)).reshape(-1, 2) for b in bars]

    def check_cocycle(self, rows, p, birth, death):
        """Checks a cocycle. Each row holds the vertices of a simplex and its coefficient. The
        cocycle must be zero on all simplices that are older than the birth. Its coboundary must be
        zero before the death. At the birth, the cocycle must not be a coboundary."""
        dim = len(rows[0]) - 2
        cochain = {}
        for *vertices, coefficient in np.asarray(rows).tolist():
            simplex = tuple(sorted(vertices))
            assert len(set(simplex)) == dim + 1 and simplex not in cochain
            assert 0 < coefficient < p and birth <= self.value(simplex) < INF
            cochain[simplex] = coefficient * sign(vertices)
        for value, s in self.simplices(dim + 1):
            if value < death:
                faces = (s[:k] + s[k + 1:] for k in range(dim + 2))
                assert sum((-1)**k * cochain.get(f, 0) for k, f in enumerate(faces)) % p == 0
        there = [s for value, s in self.simplices(dim) if value <= birth]
        below = [s for value, s in self.simplices(dim - 1) if value <= birth]
        place = {s: i for i, s in enumerate(below)}
        matrix = np.zeros((len(there), len(below) + 1), dtype=int)
        for i, s in enumerate(there):
            for k in range(dim + 1):
                matrix[i, place[s[:k] + s[k + 1:]]] = (-1)**k
            matrix[i, -1] = cochain.get(s, 0)
        assert rank(matrix, p) > rank(matrix[:, :-1], p)


def rank(matrix, p):
    """The rank of a matrix over Z/p."""
    rows, found = [list(row) for row in matrix % p], 0
    for column in range(matrix.shape[1]):
        pivot = next((i for i in range(found, len(rows)) if rows[i][column]), None)
        if pivot is None:
            continue
        rows[found], rows[pivot] = rows[pivot], rows[found]
        inverse = pow(int(rows[found][column]), -1, p)
        for i in range(found + 1, len(rows)):
            factor = rows[i][column] * inverse
            if factor:
                rows[i] = [(a - factor * b) % p for a, b in zip(rows[i], rows[found])]
        found += 1
    return found


def sorted_rows(dgm):
    dgm = np.asarray(dgm, dtype=float).reshape(-1, 2)
    return dgm[np.lexsort(dgm.T[::-1])]


def same(dgms, others):
    """True if two lists of diagrams have the same bars."""
    return len(dgms) == len(others) and all(
        np.array_equal(sorted_rows(a), sorted_rows(b)) for a, b in zip(dgms, others))


def random_distances(rng, n, ties):
    """A random symmetric matrix with a zero diagonal."""
    upper = rng.integers(1, 4, (n, n)).astype(float) if ties else rng.random((n, n))
    upper = np.triu(upper, 1)
    return upper + upper.T


def single(numbers):
    """The doubles rounded to single precision."""
    return np.asarray(numbers, dtype=np.float32).astype(float)
