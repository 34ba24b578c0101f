# SPDX-License-Identifier: MIT
"""What the estimators for HDBSCAN* share: the hierarchy of rows, and what is read from it."""
from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _core, _run, _sources
from ._clusters import ClusterTree, cluster_tree, of_forest
from ._points import core_distances

_Integers = NDArray[np.int64]
_Numbers = NDArray[np.float64]

METRICS = {**_sources.METRICS, "infinity": "chebyshev", "p": "minkowski"}  # by scikit-learn's names


def as_they_are(values: _Numbers) -> _Numbers:
    """The values themselves."""
    return values


class Hierarchy:
    """The cluster tree of rows that enter at their core distances, and the places of new rows in
    it.

    Parameters
    ----------
    data : ndarray or sparse matrix
        Points, one per row, or a square matrix of distances.
    kept : ndarray
        The rows that take part; other rows never enter.
    k : int
        The core distance of a row is the distance to its k-th nearest other row.
    min_size : int
        Components with fewer rows are not clusters.
    metric : str or callable
        As in `rips`.
    p : float
        The exponent of ``metric="minkowski"``.
    alpha : float
        Distances are divided by this number before they are compared with core distances.
    farthest : float
        The core distance of a row with fewer than k known distances; if infinite, such a row never
        enters.
    reading : callable
        A monotone function, from distances to values of the tree.
    threads : int, optional
        Number of threads.

    Attributes
    ----------
    tree : ClusterTree
    births : ndarray
        The core distance of each row, before `reading`; infinite if it never enters.
    k : int
        As given.
    has_distances : bool
        True if `data` is a matrix of distances.
    """

    def __init__(self, data: Any, kept: _Integers, k: int, min_size: int, *,
                 metric: Any = "euclidean", p: float = 2.0, alpha: float = 1.0,
                 farthest: float = np.inf, reading: Callable[[_Numbers], _Numbers] = as_they_are,
                 threads: int | None = None) -> None:
        self._data = data  # for new rows
        self.k = k
        self._metric = metric
        self._p = p
        self._alpha = alpha
        self._farthest = farthest
        self._reading = reading
        self._options = {} if threads is None else {"threads": threads}
        how: dict[str, Any] = {"metric": metric, **self._options}
        if isinstance(metric, str) and metric == "minkowski":
            how["minkowski_p"] = p
        self.has_distances = isinstance(metric, str) and metric == "precomputed"
        n = data.shape[0]
        points = data if len(kept) == n else data[kept]
        if self.has_distances and len(kept) < n:
            points = points[:, kept]
        is_plain = alpha == 1 and reading is as_they_are and len(kept) == n
        if is_plain and not self.has_distances:  # one search finds the births and the edges
            self.tree = cluster_tree(points, min_size, complex="rips", threshold=np.inf,
                                     weights="core", core_neighbors=k, **how)
            self.births = self.tree.births
            return
        if _arrays.is_sparse(points):
            births = np.minimum(_core_of_stored(points, k), farthest)
        else:
            births = core_distances(points, k, **how)
        if np.isinf(births).any():  # such a row has too few neighbours
            is_in = np.isfinite(births)
            kept, births, points = kept[is_in], births[is_in], points[is_in][:, is_in]
        tree = cluster_tree(points, min_size, complex="rips", threshold=np.inf,
                            weights=births * alpha, **how)
        self.births = births
        if len(kept) < n:
            self.births = np.full(n, np.inf)
            self.births[kept] = births
        if not is_plain or len(kept) < n:
            # Births are multiplied and divided as well, so that rounding keeps the order.
            tree = of_forest(reading(self.births * alpha / alpha), reading(tree.values / alpha),
                             kept[tree.edges], min_size, "inverse")
        self.tree = tree

    def rows(self, chosen: _Integers) -> Any:
        """Some rows of the data: points, or the distances between them."""
        rows = self._data[chosen]
        return rows[:, chosen] if self.has_distances else rows

    def of(self, data: Any, k: int, min_size: int, threads: int) -> Hierarchy:
        """The hierarchy of other data, with the same distances between rows."""
        return Hierarchy(data, np.arange(data.shape[0]), k, min_size, metric=self._metric,
                         p=self._p, alpha=self._alpha, farthest=self._farthest,
                         reading=self._reading, threads=threads)

    def attachments(self, rows: Any) -> tuple[_Integers, _Numbers]:
        """For each new row, the row of the hierarchy that it reaches first, and the value at which
        it does; -1 and inf if it reaches none.

        The core distance of a new row is its distance to the row of rank k + 1. A copy of a row
        therefore has the core distance of that row. For ``metric="precomputed"``, `rows` has the
        distances from the rows of the hierarchy.
        """
        fitted = np.flatnonzero(np.isfinite(self.births))
        births = self.births[fitted] * self._alpha
        rank = self.k + 1
        if isinstance(self._metric, str) and not self.has_distances:
            points = np.ascontiguousarray(self._data[fitted])
            core = np.asarray(_run.run(_core.core_distances_among, points, rows, self.k,
                                       self._metric, self._p, options=self._options))
            found = _run.run(_core.attachments, points, births, rows, core * self._alpha,
                             self._metric, self._p, options=self._options)
            joined, values = (np.asarray(block) for block in found)
        else:
            distances = rows[:, fitted] if self.has_distances else np.array(
                [[self._metric(x, y) for y in self._data[fitted]] for x in rows]
            ).reshape(len(rows), -1)
            core = np.zeros(len(rows)) if rank == 1 else np.full(len(rows), np.inf)
            if 1 < rank <= len(fitted):
                core = np.partition(distances, rank - 1, axis=1)[:, rank - 1]
            reach = np.maximum(np.maximum(distances, births), core[:, None] * self._alpha)
            joined, values = reach.argmin(axis=1), reach.min(axis=1)
            joined[np.isinf(values)] = -1
        return np.where(joined >= 0, fitted[joined], -1), self._reading(values / self._alpha)


def _core_of_stored(distances: Any, k: int) -> _Numbers:
    """The core distances of a sparse matrix of distances, infinite for rows that store fewer than k
    of them."""
    from scipy.sparse import csr_matrix
    rows = csr_matrix(distances)
    rows.sum_duplicates()
    core = np.zeros(rows.shape[0])
    if k == 0:
        return core
    for i in range(rows.shape[0]):
        of_row = slice(rows.indptr[i], rows.indptr[i + 1])
        others = rows.data[of_row][rows.indices[of_row] != i]
        core[i] = np.partition(others, k - 1)[k - 1] if len(others) >= k else np.inf
    return core


def persistence(tree: ClusterTree, chosen: _Integers) -> _Numbers:
    """The stability of each chosen cluster, as a share of the largest that a cluster of its size
    could have in the tree."""
    clusters = tree.clusters
    least = clusters["least"][-1] if len(clusters) else 0.0
    if least == 0:  # copies of a point never separate
        return np.ones(len(chosen))
    return np.asarray(clusters["mass"][chosen] / clusters["size"][chosen] * least)


def exemplars(tree: ClusterTree, chosen: _Integers, labels: _Integers) -> list[_Integers]:
    """For each chosen cluster, those of its points that stay longest in the leaves of the tree."""
    clusters = tree.clusters
    is_leaf = np.ones(len(clusters), dtype=bool)
    is_leaf[clusters["parent"][clusters["parent"] >= 0]] = False
    own = tree.cluster_of
    is_last = is_leaf[own] & (tree.leaves_at == clusters["bottom"][own])
    return [np.flatnonzero(is_last & (labels == c)) for c in range(len(chosen))]
