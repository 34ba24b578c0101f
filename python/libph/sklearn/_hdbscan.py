# SPDX-License-Identifier: MIT
"""Clustering by density without a scale and without the number of clusters (HDBSCAN*)."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.sparse
from joblib import effective_n_jobs
from numpy.typing import NDArray
from sklearn.base import BaseEstimator, ClusterMixin
from sklearn.metrics import pairwise_distances
from sklearn.utils.validation import check_is_fitted

from .. import _hierarchy, _options, _real_clusters, _run
from .._clusters import Clusters, of_forest
from .._errors import DataError, UsageError
from .._trees import MergeTree
from ._base import table_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .._run import RunOptions

_Integers = NDArray[np.int64]
_Numbers = NDArray[np.float64]

INFINITE, MISSING = -2, -3  # labels of rows with infinite numbers and with NaN


class HDBSCAN(ClusterMixin, BaseEstimator):
    """Clusters are components of a density that last long, at any scale; other points are noise.

    This is HDBSCAN* (Campello, Moulavi, Sander, Density-based clustering based on hierarchical
    density estimates, 2013), which is H0 of a Rips filtration with births: a point enters at its
    core distance, and an edge enters at the largest of its length and the core distances of its
    ends. Components with at least `min_cluster_size` points are clusters.

    Edges of equal value are removed at once, as the definition says. The labels therefore do not
    depend on the order of the rows. Labels of other packages do, because they remove such edges one
    by one; where no two values are equal, their labels are the same.

    Parameters
    ----------
    min_cluster_size : int
        The least number of points in a cluster, at least 2.
    min_samples : int, optional
        The core distance of a point is the distance to its nearest point of this rank, where the
        point itself has rank 1. With 1, all core distances are 0, and the hierarchy is single
        linkage. Default: `min_cluster_size`.
    cluster_selection_epsilon : float
        A cluster that joins others at a distance below this is replaced by the first cluster around
        it that does not.
    max_cluster_size : int, optional
        With "eom", larger clusters are not chosen.
    metric : str or callable
        As in `libph.rips`; "precomputed": X is a matrix of distances, dense or sparse. A pair that
        a sparse matrix does not store is never joined.
    metric_params : dict, optional
        ``{"p": p}`` for ``metric="minkowski"``.
    alpha : float
        Distances are divided by this number before they are compared with core distances.
    algorithm, leaf_size, copy
        Accepted for the sake of scikit-learn's interface. They change nothing: the forest is exact
        whatever the algorithm, and X is never changed.
    n_jobs : int, optional
        Number of threads. Default: one.
    cluster_selection_method : {"eom", "leaf"}
        "eom": the clusters with the largest total stability. "leaf": the clusters without clusters
        inside them.
    allow_single_cluster : bool
        If True, all points may form one cluster.
    store_centers : {None, "centroid", "medoid", "both"}
        Whether to compute `centroids_` or `medoids_`.

    Attributes
    ----------
    labels_ : ndarray
        The cluster of each row, 0, 1, … in the order of the first rows of the clusters. -1 is
        noise, -2 a row with an infinite number, -3 a row with NaN.
    probabilities_ : ndarray
        How strongly each row belongs to its cluster, from 0 to 1; NaN for rows with NaN.
    outlier_scores_ : ndarray
        The GLOSH scores, from 0 to 1; NaN for rows with NaN or infinite numbers.
    cluster_persistence_ : ndarray
        For each cluster, its stability as a share of the largest stability that a cluster of its
        size could have in this tree, from 0 to 1.
    cluster_tree_ : ClusterTree
        The hierarchy of clusters.
    centroids_, medoids_ : ndarray
        One row per cluster, if `store_centers` says so: the mean weighted with probabilities, and
        the row with the least sum of weighted distances to the other rows of the cluster.

    Examples
    --------
    >>> X = [[0], [1], [2], [3], [20], [21], [22], [23], [50]]
    >>> ph.sklearn.HDBSCAN(min_cluster_size=3, min_samples=2).fit_predict(X)
    array([ 0,  0,  0,  0,  1,  1,  1,  1, -1])
    """

    def __init__(self, min_cluster_size: int = 5, min_samples: int | None = None,
                 cluster_selection_epsilon: float = 0.0, max_cluster_size: int | None = None,
                 metric: Any = "euclidean", metric_params: dict[str, Any] | None = None,
                 alpha: float = 1.0, algorithm: str = "auto", leaf_size: int = 40,
                 n_jobs: int | None = None, cluster_selection_method: str = "eom",
                 allow_single_cluster: bool = False, store_centers: str | None = None,
                 copy: bool = False) -> None:
        self.min_cluster_size = min_cluster_size
        self.min_samples = min_samples
        self.cluster_selection_epsilon = cluster_selection_epsilon
        self.max_cluster_size = max_cluster_size
        self.metric = metric
        self.metric_params = metric_params
        self.alpha = alpha
        self.algorithm = algorithm
        self.leaf_size = leaf_size
        self.n_jobs = n_jobs
        self.cluster_selection_method = cluster_selection_method
        self.allow_single_cluster = allow_single_cluster
        self.store_centers = store_centers
        self.copy = copy

    def fit(self, X: Any, y: Any = None) -> HDBSCAN:
        """Clusters the rows.

        Parameters
        ----------
        X : array_like or sparse matrix
            Points, one per row. With ``metric="precomputed"``, a square matrix of distances.
        y : None
            Not used; present because pipelines pass it.

        Returns
        -------
        self
        """
        min_size = _options.whole("min_cluster_size", self.min_cluster_size, 2)
        _options.choice("store_centers", self.store_centers, [None, "centroid", "medoid", "both"])
        is_precomputed = self._is_precomputed()
        data = table_of(self, X, reset=True, are_finite=False, may_be_sparse=is_precomputed)
        if is_precomputed:
            self._marks = _check_distances(data)
        else:
            self._marks = _marks_of(data)
        kept = np.flatnonzero(self._marks == 0)
        self._hierarchy = self._hierarchy_of(data, kept, min_size)
        self.cluster_tree_ = self._hierarchy.tree
        chosen = self.cluster_tree_.select(**self._selection())
        self.labels_, self.probabilities_ = self._marked(chosen)
        self._chosen = chosen.chosen
        self._centres_of(data)
        return self

    def _hierarchy_of(self, data: Any, kept: _Integers, min_size: int) -> _hierarchy.Hierarchy:
        rank = min_size if self.min_samples is None else _options.whole(
            "min_samples", self.min_samples, 1)
        if rank > len(kept):
            name = "min_cluster_size" if self.min_samples is None else "min_samples"
            raise UsageError(f"{name}: found {rank}, expected at most the number of rows that are "
                             f"finite, n_samples = {len(kept)}")
        return _hierarchy.Hierarchy(
            data, kept, rank - 1, min_size, metric=self._metric(),
            p=(self.metric_params or {}).get("p", 2.0), alpha=_options.positive("alpha", self.alpha),
            threads=effective_n_jobs(self.n_jobs))

    def _metric(self) -> Any:
        return _hierarchy.METRICS.get(self.metric, self.metric) if isinstance(self.metric, str) \
            else self.metric

    def _is_precomputed(self) -> bool:
        return isinstance(self.metric, str) and self.metric == "precomputed"

    def _selection(self) -> dict[str, Any]:
        return {"method": self.cluster_selection_method, "epsilon": self.cluster_selection_epsilon,
                "allow_single": self.allow_single_cluster, "max_size": self.max_cluster_size}

    def _marked(self, clusters: Clusters) -> tuple[_Integers, _Numbers]:
        """Labels and probabilities, with the marks of rows that are not finite."""
        labels = np.where(self._marks < 0, self._marks, clusters.labels)
        probabilities = np.where(self._marks == MISSING, np.nan, clusters.probabilities)
        return labels, probabilities

    def _centres_of(self, data: Any) -> None:
        if self.store_centers is None:
            return
        if self._is_precomputed():
            raise UsageError("store_centers: found a matrix of distances, expected points")
        members = [np.flatnonzero(self.labels_ == c) for c in range(len(self._chosen))]
        weights = [self.probabilities_[rows] for rows in members]
        shape = (len(members), data.shape[1])
        if self.store_centers in ("centroid", "both"):
            self.centroids_ = np.array([np.average(data[rows], weights=w, axis=0) for rows, w in
                                        zip(members, weights)]).reshape(shape)
        if self.store_centers in ("medoid", "both"):
            how = self.metric_params or {}
            self.medoids_ = np.array([
                data[rows[np.argmin((pairwise_distances(data[rows], metric=self.metric, **how)
                                     * w).sum(axis=1))]]
                for rows, w in zip(members, weights)]).reshape(shape)

    # ---- more results

    @property
    def outlier_scores_(self) -> _Numbers:
        """The GLOSH score of each row."""
        return np.where(self._marks < 0, np.nan, self.cluster_tree_.outlier_scores())

    @property
    def cluster_persistence_(self) -> _Numbers:
        """The stability of each cluster, as a share of the largest that a cluster of its size could
        have."""
        return _hierarchy.persistence(self.cluster_tree_, self._chosen)

    @property
    def exemplars_(self) -> list[_Integers]:
        """For each cluster, the rows that stay longest in the leaves of the tree inside it."""
        return _hierarchy.exemplars(self.cluster_tree_, self._chosen, self.labels_)

    @property
    def merge_tree_(self) -> MergeTree:
        """All merges of components, whatever their sizes are."""
        return self.cluster_tree_.merge_tree

    @property
    def single_linkage_tree_(self) -> _Numbers:
        """The merges as a linkage matrix of ``scipy.cluster.hierarchy``."""
        return self.merge_tree_.linkage

    @property
    def minimum_spanning_tree_(self) -> _Numbers:
        """The edges of the spanning forest as rows u, v, value, by ascending value."""
        tree = self.cluster_tree_
        return np.column_stack([tree.edges, tree.values])

    def cut(self, *, min_cluster_size: int | None = None,
            cluster_selection_method: str | None = None,
            cluster_selection_epsilon: float | None = None,
            allow_single_cluster: bool | None = None,
            max_cluster_size: int | None = None) -> _Integers:
        """The labels with other parameters, without another search for the forest.

        Parameters
        ----------
        min_cluster_size, cluster_selection_method, cluster_selection_epsilon, \
allow_single_cluster, max_cluster_size
            As in the estimator. Default: the values of the estimator.

        Returns
        -------
        ndarray
            Labels as in `labels_`.
        """
        check_is_fitted(self)
        tree = self.cluster_tree_
        if min_cluster_size is not None:
            size = _options.whole("min_cluster_size", min_cluster_size, 2)
            tree = tree.with_min_size(size) if size >= tree.min_size else of_forest(
                tree.births, tree.values, tree.edges, size, tree.scale)
        changes = {"method": cluster_selection_method, "epsilon": cluster_selection_epsilon,
                   "allow_single": allow_single_cluster, "max_size": max_cluster_size}
        return self._marked(tree.select(**{
            **self._selection(), **{k: v for k, v in changes.items() if v is not None}}))[0]

    def predict(self, X: Any) -> _Integers:
        """The clusters that new rows would join.

        A row gets the core distance that it would have among the fitted rows, and joins the fitted
        row that it reaches first. It stays with this row as long as the row stays in its cluster.
        The clusters themselves do not change. For the fitted rows, the result is `labels_`.

        Parameters
        ----------
        X : array_like
            New points. With ``metric="precomputed"``, their distances from the fitted rows.

        Returns
        -------
        ndarray
            Labels as in `labels_`.
        """
        return self._located(X)[0]

    def _located(self, X: Any) -> tuple[_Integers, _Numbers]:
        """Labels and probabilities of new rows."""
        check_is_fitted(self)
        data = table_of(self, X, reset=False, are_finite=False)
        marks = np.zeros(len(data), dtype=np.int64) if self._is_precomputed() else _marks_of(data)
        tree = self.cluster_tree_
        joined, values = np.full(len(data), -1), np.full(len(data), np.inf)
        kept = marks == 0
        joined[kept], values[kept] = self._hierarchy.attachments(data[kept])
        found = tree._locate(joined, values, **self._selection())
        return (np.where(marks < 0, marks, found.labels),
                np.where(marks == MISSING, np.nan, found.probabilities))

    def dbscan_clustering(self, cut_distance: float, min_cluster_size: int = 5) -> _Integers:
        """The labels of DBSCAN* with a given radius: clusters are components at one value.

        Parameters
        ----------
        cut_distance : float
            Edges with values up to this number join clusters. Rows with a larger core distance are
            noise.
        min_cluster_size : int
            Smaller components are noise.

        Returns
        -------
        ndarray
            Labels as in `labels_`.
        """
        check_is_fitted(self)
        labels = self.cluster_tree_.cut(
            _options.real("cut_distance", cut_distance),
            min_size=_options.whole("min_cluster_size", min_cluster_size, 1))
        return np.where(self._marks < 0, self._marks, labels)

    # ---- which clusters are real

    def stability(self, resamples: int = 100, *, fraction: float = 0.632, seed: int = 0,
                  **run: Unpack[RunOptions]) -> _real_clusters.ClusterStability:
        """How well subsamples reproduce each cluster.

        Each subsample is drawn without replacement and clustered with the same parameters, except
        that the sizes of clusters and `min_samples`, without the point itself, are multiplied by
        `fraction`. Each cluster is compared with the most similar cluster of the subsample: the
        Jaccard similarity is the number of sampled points in both, divided by the number of sampled
        points in at least one (Hennig, Cluster-wise assessment of cluster stability, 2007). The
        manual of his R package fpc says: do not trust a cluster with a mean below 0.6; from 0.75 on
        it is stable, and from 0.85 on highly stable. This is not the stability of HDBSCAN*, which
        libph calls mass.

        Parameters
        ----------
        resamples : int
            Number of subsamples.
        fraction : float
            The size of each subsample, as a share of the rows, above 0 and below 1. Default: the
            share of distinct rows in a bootstrap sample. Copies of rows would be clusters.
        seed : int
            Seed of the random numbers; the same seed gives the same result.
        **run
            `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`. Default for
            threads: `n_jobs`.

        Returns
        -------
        ClusterStability
        """
        _run.check_names("stability", run, HDBSCAN.stability)
        kept, threads = self._rows_and_threads(run)
        return _real_clusters.stability(
            self._hierarchy, kept, self.labels_[kept], self._selection(), resamples, fraction, seed,
            threads, dict(run))

    def significance(self, samples: int = 199, *, null: str = "both", seed: int = 0,
                     **run: Unpack[RunOptions]) -> _real_clusters.ClusterSignificance:
        """The p-value of each cluster: how often noise has a cluster that is as clearly separated.

        Noise is drawn with as many points as the data, from one normal distribution with the same
        mean and covariance, or from a uniform distribution over the box along the principal axes
        that encloses the data. The *prominence* of a cluster is the value at which it joins other
        clusters, divided by the least value at which a part of it still has `min_cluster_size`
        points. Where clusters join, the most prominent one goes on. The *separation* of a cluster
        is the prominence of the less prominent side where it joins others, or where a cluster that
        goes on as it does, whichever is largest. p is (r + 1) / (samples + 1), for r samples of
        noise in which any cluster has at least this separation. Because all clusters of the noise
        count, p holds for all clusters of the data together.

        A small p says that the data are not one such cloud. Points along a curve get one as well.

        Parameters
        ----------
        samples : int
            Number of samples of noise. The least possible p is 1 / (samples + 1).
        null : {"both", "normal", "uniform"}
            The distribution of the noise; "both": the larger of the two p-values.
        seed, **run
            As in `stability`.

        Returns
        -------
        ClusterSignificance
        """
        _run.check_names("significance", run, HDBSCAN.significance)
        kept, threads = self._rows_and_threads(run)
        return _real_clusters.significance(self._hierarchy, kept, self._chosen, samples, null, seed,
                                           threads, dict(run))

    def _rows_and_threads(self, run: RunOptions) -> tuple[_Integers, int]:
        check_is_fitted(self)
        threads = run.get("threads")
        return (np.flatnonzero(self._marks == 0),
                effective_n_jobs(self.n_jobs) if threads is None else threads)

    def _more_tags(self) -> dict[str, Any]:
        return {"allow_nan": not self._is_precomputed(), "pairwise": self._is_precomputed()}

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.input_tags.allow_nan = not self._is_precomputed()
        tags.input_tags.pairwise = tags.input_tags.sparse = self._is_precomputed()
        return tags


def _marks_of(data: _Numbers) -> _Integers:
    """For each row, 0 or the label of a row that is not finite."""
    return np.where(np.isnan(data).any(axis=1), MISSING,
                    np.where(np.isinf(data).any(axis=1), INFINITE, 0))


def _check_distances(data: Any) -> _Integers:
    if data.shape[0] != data.shape[1]:
        raise UsageError(f"X: found a matrix of shape {data.shape}, expected a square one of "
                         "distances")
    values = data.data if scipy.sparse.issparse(data) else data
    if np.isnan(values).any():
        raise DataError("X: found NaN among the distances, expected numbers at least 0; inf means "
                        "that a pair is never joined")
    return np.zeros(data.shape[0], dtype=np.int64)
