# SPDX-License-Identifier: MIT
"""Clustering by the persistence of a density on a graph of neighbours (ToMATo)."""
from __future__ import annotations

import warnings
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from sklearn.base import BaseEstimator, ClusterMixin
from sklearn.exceptions import ConvergenceWarning
from sklearn.neighbors import NearestNeighbors

from .. import _arrays, _options
from .._compute import filtered
from .._errors import UsageError
from .._points import root_mean_square
from .._trees import merge_tree
from ._base import neighbours_wanted, table_of
from ._neighbours import METRICS, Neighbours

_Integers = NDArray[np.int64]
_Numbers = NDArray[np.float64]

_STANDS_OUT = 1.5  # least ratio of a bar to the next shorter one; noise seldom reaches it
_BYTES_PER_NEIGHBOUR = 80  # the most that the graph of neighbours takes while hills are found


class PersistenceClustering(ClusterMixin, BaseEstimator):
    """Clusters are the peaks of a density that rise high above the passes to higher peaks.

    The algorithm is ToMATo [Chazal, Guibas, Oudot & Skraba 2013]. Each point is joined to its k
    nearest points, and follows the densest of the points to which it is joined, up to a peak. The
    sublevel sets of f = -log(density) have one bar for each peak: this bar is born at the peak and
    dies at the pass to a denser peak. Its length is the logarithm of the ratio of the densities of
    peak and pass. Clusters with short bars are merged into the denser cluster.

    Parameters
    ----------
    k : int
        Number of points to which each point is joined, including itself.
    n_clusters : int, optional
        Number of clusters. The peaks with the longest bars are chosen.
    min_persistence : float, optional
        Peaks with bars longer than this are clusters. With ``log(2)``, a peak must be more than
        twice as dense as the pass.
    density : "dtm" or callable
        "dtm": the inverse of the distance to the measure of the k nearest points. A distance of 0,
        which points with k - 1 copies have, counts as the least distance above 0. A function takes
        X and returns a positive density for each row.
    metric : str
        "euclidean", "manhattan", "chebyshev", "cosine", or "precomputed": X is a square matrix of
        distances.
    n_jobs : int, optional
        Number of threads for the search for neighbours. Default: one.

    Attributes
    ----------
    labels_ : ndarray
        The cluster of each point; clusters are numbered by the density of their peaks, the densest
        being 0.
    n_clusters_ : int
    peaks_ : ndarray
        The densest point of each cluster.
    barcode_ : Barcode
        The bars of f, one for each peak; `barcode_.birth_cells(0)` are the peaks, and the ends of
        an edge in `barcode_.death_cells(0)` are in the two parts that meet.
    function_ : ndarray
        f at each point.

    Notes
    -----
    Without `n_clusters` and `min_persistence`, the number of clusters is guessed. Bars that never
    die are clusters. The other bars are sorted by length, with 0 at the end. If the bar before the
    largest gap is at least one and a half times as long as the bar after it, this bar and all
    longer ones are clusters. Look at ``barcode_.plot()`` before you trust the guess.

    If the graph has several components, each has at least one cluster. If `n_clusters` is smaller,
    components whose densest points are near each other are joined, with a `ConvergenceWarning`.

    Examples
    --------
    >>> X = [[0], [1], [2], [3], [20], [21], [22], [23]]
    >>> ph.sklearn.PersistenceClustering(k=3, n_clusters=2).fit_predict(X)
    array([0, 0, 0, 0, 1, 1, 1, 1])
    """

    def __init__(self, k: int = 10, n_clusters: int | None = None,
                 min_persistence: float | None = None, density: Any = "dtm",
                 metric: str = "euclidean", n_jobs: int | None = None) -> None:
        self.k = k
        self.n_clusters = n_clusters
        self.min_persistence = min_persistence
        self.density = density
        self.metric = metric
        self.n_jobs = n_jobs

    def fit(self, X: Any, y: Any = None) -> PersistenceClustering:
        """Clusters the points.

        Parameters
        ----------
        X : array_like
            Points, one per row, or distances.
        y : None
            Not used; present because pipelines pass it.

        Returns
        -------
        self
        """
        k = _options.whole("k", self.k, 1)
        metric = _options.choice("metric", self.metric, [*METRICS, "precomputed"])
        if self.n_clusters is not None and self.min_persistence is not None:
            raise UsageError("n_clusters: cannot be combined with min_persistence; leave out one "
                             "of them")
        points = table_of(self, X, reset=True)
        if metric == "precomputed" and points.shape[0] != points.shape[1]:
            raise UsageError(f"X: found a matrix of shape {points.shape}, expected a square one of "
                             "distances")
        neighbours_wanted(k, len(points))
        if metric == "precomputed":
            search = NearestNeighbors(n_neighbors=k, metric=metric, n_jobs=self.n_jobs).fit(points)
            distances, neighbours = search.kneighbors(points)
        else:
            distances, neighbours = Neighbours(points, k, metric, self.n_jobs).of(points)
        self.function_ = self._function(points, distances)
        hills = _hills_of(self.function_, neighbours)
        joins = self._joins(points, hills)
        self.labels_, self.peaks_ = _clusters_of(hills, joins)
        self.n_clusters_ = len(self.peaks_)
        self.barcode_ = filtered(
            [hills.peaks[:, None], hills.peaks[hills.passes]],
            [self.function_[hills.peaks], hills.heights], max_dim=0)
        return self

    def _function(self, points: _Numbers, distances: _Numbers) -> _Numbers:
        if callable(self.density):
            density = _arrays.as_values(self.density(points), "density", len(points), "point")
            wrong = ~((density > 0) & np.isfinite(density))
            if wrong.any():
                i = int(np.argmax(wrong))
                raise UsageError(f"density: row {i}: found {density[i]}, expected a finite "
                                 "number above 0")
            return np.asarray(-np.log(density))
        _options.choice("density", self.density, ["dtm"])
        to_measure = root_mean_square(distances)
        is_zero = to_measure == 0
        to_measure[is_zero] = to_measure[~is_zero].min() if not is_zero.all() else 1
        return np.asarray(np.log(to_measure))

    def _joins(self, points: _Numbers, hills: _Hills) -> _Integers:
        """Pairs of hills to be merged."""
        lengths = hills.lengths
        parts = len(hills.peaks) - len(lengths)
        order = np.argsort(-lengths, kind="stable")
        if self.min_persistence is not None:
            least = _options.real("min_persistence", self.min_persistence, "a number, at least 0", 0)
            return np.asarray(hills.passes[lengths <= least])
        if self.n_clusters is None:
            return np.asarray(hills.passes[order[_before_gap(lengths[order]):]])
        wanted = _options.whole("n_clusters", self.n_clusters, 1)
        if wanted > len(hills.peaks):
            warnings.warn(f"n_clusters: found {wanted}, expected at most {len(hills.peaks)}, the number "
                          "of peaks of the density; each peak is a cluster", ConvergenceWarning,
                          stacklevel=3)
        if wanted >= parts:
            return np.asarray(hills.passes[order[wanted - parts:]])
        warnings.warn(f"n_clusters: found {wanted}, expected at least {parts}, the number of parts of "
                      "the graph of neighbours; the parts whose densest points are nearest to each "
                      "other are joined; a larger k also joins parts", ConvergenceWarning, stacklevel=3)
        return np.concatenate([hills.passes, self._joined_parts(points, hills, wanted)])

    def _joined_parts(self, points: _Numbers, hills: _Hills, wanted: int) -> _Integers:
        """Finds the densest peak of each component, and then joins these peaks by single
        linkage."""
        is_highest = np.ones(len(hills.peaks), dtype=bool)
        is_highest[hills.lower] = False
        highest = np.flatnonzero(is_highest)
        at = hills.peaks[highest]
        sample = points[np.ix_(at, at)] if self.metric == "precomputed" else points[at]
        tree = merge_tree(sample, complex="rips", metric=self.metric, threshold=np.inf)
        return np.asarray(highest[tree.edges[:len(highest) - wanted]])

    def _more_tags(self) -> dict[str, Any]:
        return {"pairwise": self.metric == "precomputed"}

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.input_tags.pairwise = self.metric == "precomputed"
        return tags


class _Hills(NamedTuple):
    """The peaks of a density, and the passes between the hills below them."""

    peaks: _Integers    # indices of the points, densest first
    hill_of: _Integers  # the hill of each point
    passes: _Integers   # (passes, 2): the hills that meet where two components merge
    lower: _Integers    # for each pass, the hill of the lower peak of the two components
    heights: _Numbers   # for each pass, the value of the function
    lengths: _Numbers   # for each pass, the length of the bar that dies there


def _hills_of(function: _Numbers, neighbours: _Integers) -> _Hills:
    """Computes the hills. All steps use the ranks of the points, so that their numbers break
    ties."""
    n = len(function)
    _arrays.require_room(_BYTES_PER_NEIGHBOUR * neighbours.size,
                         f"the conversion of the {neighbours.size} neighbours may take")
    order = np.argsort(function, kind="stable")
    rank = np.empty(n, dtype=np.int64)
    rank[order] = np.arange(n)
    ends = np.repeat(rank, neighbours.shape[1]), rank[neighbours.ravel()]
    low, high = np.minimum(*ends), np.maximum(*ends)

    up = np.arange(n)  # for each point, the densest point that it is joined to
    np.minimum.at(up, high, low)
    while True:
        farther = up[up]
        if np.array_equal(farther, up):
            break
        up = farther
    tops, hill_of_rank = np.unique(up, return_inverse=True)

    # The first edge between any two hills that meet.
    one, other = hill_of_rank[low], hill_of_rank[high]
    meet = one != other
    one, other, high = one[meet], other[meet], high[meet]
    one, other = np.minimum(one, other), np.maximum(one, other)
    by_age = np.lexsort((high, other, one))
    one, other, high = one[by_age], other[by_age], high[by_age]
    first = np.ones(len(one), dtype=bool)
    first[1:] = (one[1:] != one[:-1]) | (other[1:] != other[:-1])
    count = len(tops)
    graph = coo_matrix((high[first].astype(np.float64), (one[first], other[first])),
                       shape=(count, count))
    tree = merge_tree(graph, complex="rips", metric="precomputed", weights=tops.astype(np.float64))

    heights = function[order[tree.values.astype(np.int64)]]
    return _Hills(order[tops], hill_of_rank[rank], tree.edges, tree.younger, heights,
                  heights - function[order[tops[tree.younger]]])


def _before_gap(lengths: _Numbers) -> int:
    """The number of lengths, in descending order, before the largest gap; 0 if the gap is not
    large."""
    if not len(lengths):
        return 0
    below = np.append(lengths[1:], 0.0)
    count = int(np.argmax(lengths - below)) + 1
    return count if lengths[count - 1] >= _STANDS_OUT * below[count - 1] else 0


def _clusters_of(hills: _Hills, joins: _Integers) -> tuple[_Integers, _Integers]:
    """Labels of points, and the densest point of each cluster."""
    count = len(hills.peaks)
    graph = coo_matrix((np.ones(len(joins)), (joins[:, 0], joins[:, 1])), shape=(count, count))
    cluster_of_hill = connected_components(graph, directed=False)[1]
    # Hills are numbered by descending density: the first hill of a cluster is its densest.
    _, first, numbered = np.unique(cluster_of_hill, return_index=True, return_inverse=True)
    highest, label = np.unique(first[numbered], return_inverse=True)
    return label[hills.hill_of], hills.peaks[highest]
