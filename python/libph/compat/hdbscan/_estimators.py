# SPDX-License-Identifier: MIT
"""The estimators, in a module of their own because their base classes load scikit-learn."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from sklearn.base import BaseEstimator, ClusterMixin
from sklearn.utils.validation import check_is_fitted

from ... import _arrays, _options
from ..._errors import NotBuiltIn, UsageError
from . import fit_of, robust_single_linkage
from ._fit import Fit, linkage_of
from .plots import CondensedTree, MinimumSpanningTree, SingleLinkageTree
from .prediction import PredictionData

_Numbers = NDArray[np.float64]
_Integers = NDArray[np.int64]



class HDBSCAN(ClusterMixin, BaseEstimator):
    """Clusters by density, at any scale; other rows are noise.

    Labels differ from those of the package where values are equal; see `libph.compat.hdbscan`.

    Parameters
    ----------
    min_cluster_size : int
        The least number of points in a cluster, at least 2.
    min_samples : int, optional
        The core distance of a point is the distance to its nearest other point of this rank. A
        number above n - 1 is lowered to n - 1, for n points. Default: `min_cluster_size`.
    cluster_selection_epsilon : float
        A cluster that joins others at a distance below this is replaced by the first cluster around
        it that does not.
    cluster_selection_persistence : float
        Must be 0.
    max_cluster_size : int
        With "eom", larger clusters are not chosen; 0: there is no limit.
    metric : str or callable
        "euclidean", "manhattan", "chebyshev", "minkowski", "cosine", "haversine" (of latitude and
        longitude in radians), or "precomputed": X is a matrix of distances, dense or sparse. For
        all other metrics of scikit-learn's `pairwise_distances`, the matrix of distances is
        computed first. A function of two points is called once for each pair.
    alpha : float
        Distances are divided by this number before they are compared with core distances.
    p : float, optional
        The exponent of ``metric="minkowski"``. Default: 2.
    algorithm, leaf_size, memory, approx_min_span_tree, gen_min_span_tree, core_dist_n_jobs, \
prediction_data
        These change nothing: the forest is always exact, and all attributes are always there.
        `libph.limits` sets the number of threads.
    cluster_selection_method : {"eom", "leaf"}
        "eom": the clusters with the largest total stability. "leaf": the clusters without clusters
        inside them.
    allow_single_cluster : bool
        If True, all points may form one cluster.
    branch_detection_data : bool
        Must be False.
    match_reference_implementation : bool
        If True, `min_samples` counts the point itself, and a cluster needs one point more.
    cluster_selection_epsilon_max : float
        Must be inf.
    **kwargs
        Parameters of the metric. For a sparse matrix of distances, ``max_dist`` is the core
        distance of a point that stores fewer than `min_samples` distances; without it, such a point
        is noise.

    Attributes
    ----------
    labels_ : ndarray
        The cluster of each row, from 0; -1 is noise. Rows with NaN or infinite numbers are noise.
    probabilities_ : ndarray
        How strongly each row belongs to its cluster, from 0 to 1.
    cluster_persistence_ : ndarray
        For each cluster, its stability as a share of the largest stability that a cluster of its
        size could have in this tree, from 0 to 1.
    """

    def __init__(self, min_cluster_size: int = 5, min_samples: int | None = None,
                 cluster_selection_epsilon: float = 0.0, cluster_selection_persistence: float = 0.0,
                 max_cluster_size: int = 0, metric: Any = "euclidean", alpha: float = 1.0,
                 p: float | None = None, algorithm: str = "best", leaf_size: int = 40,
                 memory: Any = None, approx_min_span_tree: bool = True,
                 gen_min_span_tree: bool = False, core_dist_n_jobs: int = 4,
                 cluster_selection_method: str = "eom", allow_single_cluster: bool = False,
                 prediction_data: bool = False, branch_detection_data: bool = False,
                 match_reference_implementation: bool = False,
                 cluster_selection_epsilon_max: float = float("inf"), **kwargs: Any) -> None:
        self.min_cluster_size = min_cluster_size
        self.min_samples = min_samples
        self.cluster_selection_epsilon = cluster_selection_epsilon
        self.cluster_selection_persistence = cluster_selection_persistence
        self.max_cluster_size = max_cluster_size
        self.metric = metric
        self.alpha = alpha
        self.p = p
        self.algorithm = algorithm
        self.leaf_size = leaf_size
        self.memory = memory
        self.approx_min_span_tree = approx_min_span_tree
        self.gen_min_span_tree = gen_min_span_tree
        self.core_dist_n_jobs = core_dist_n_jobs
        self.cluster_selection_method = cluster_selection_method
        self.allow_single_cluster = allow_single_cluster
        self.prediction_data = prediction_data
        self.branch_detection_data = branch_detection_data
        self.match_reference_implementation = match_reference_implementation
        self.cluster_selection_epsilon_max = cluster_selection_epsilon_max
        self._metric_kwargs = kwargs

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """The parameters, with those of the metric."""
        return {**super().get_params(deep), **self._metric_kwargs}

    def set_params(self, **params: Any) -> HDBSCAN:
        """Changes parameters, also those of the metric."""
        for name in self._metric_kwargs.keys() & params.keys():
            self._metric_kwargs[name] = params.pop(name)
        super().set_params(**params)
        return self

    def fit(self, X: Any, y: Any = None) -> HDBSCAN:
        """Clusters the rows.

        Parameters
        ----------
        X : array_like or sparse matrix
            Points, one per row. With ``metric="precomputed"``, a square matrix of distances, in
            which inf means that a pair is never joined.
        y : None
            Not used; present because pipelines pass it.

        Returns
        -------
        self
        """
        if _options.flag("branch_detection_data", self.branch_detection_data):
            raise NotBuiltIn("branch_detection_data: found True, expected False: branches are not "
                             "in this drop-in; hdbscan has them")
        self._fit = fit_of(X, super().get_params(deep=False), self._metric_kwargs)
        self.labels_ = self._fit.labels
        self.probabilities_ = self._fit.probabilities
        self.cluster_persistence_ = self._fit.persistence
        return self

    def fit_predict(self, X: Any, y: Any = None) -> _Integers:
        """Clusters the rows; the result is `labels_`."""
        return self.fit(X).labels_

    def generate_prediction_data(self) -> None:
        """Does nothing: a fitted estimator can always predict."""

    def _fitted(self) -> Fit:
        check_is_fitted(self, "_fit")
        return self._fit

    # ---- more results

    @property
    def condensed_tree_(self) -> CondensedTree:
        """The clusters, and the points that leave them."""
        fit = self._fitted()
        return CondensedTree(fit.condensed(), fit.numbers[fit.chosen])

    @property
    def single_linkage_tree_(self) -> SingleLinkageTree:
        """The merges of components."""
        return SingleLinkageTree(linkage_of(self._fitted().tree))

    @property
    def minimum_spanning_tree_(self) -> MinimumSpanningTree:
        """The spanning forest of the mutual reachability distances."""
        fit = self._fitted()
        is_drawn = fit.space.has_points and not _arrays.is_sparse(fit.data)
        return MinimumSpanningTree(fit.spanning_tree(), fit.data if is_drawn else None)

    @property
    def outlier_scores_(self) -> _Numbers:
        """The GLOSH score of each row, from 0 to 1."""
        return self._fitted().tree.outlier_scores()

    @property
    def exemplars_(self) -> list[Any]:
        """For each cluster, the points that stay longest in the leaves of the tree inside it."""
        fit = self._fitted()
        if not fit.space.has_points:
            raise AttributeError("exemplars_: found distances, expected points; "
                                 "libph.sklearn.HDBSCAN has the rows of exemplars")
        return [fit.data[rows] for rows in fit.exemplars()]

    @property
    def prediction_data_(self) -> PredictionData:
        """Facts about rows and clusters."""
        fit = self._fitted()
        tree = fit.condensed()
        with np.errstate(divide="ignore"):
            ends = 1 / fit.tree.clusters["bottom"]
        labels = fit.labels_of_clusters()
        numbers = fit.numbers.tolist()
        inside = [(number, label) for number, label in zip(numbers, labels.tolist()) if label >= 0]
        return PredictionData(
            fit.data, fit.tree.births, tree[tree["child"] >= len(fit.tree)], dict(inside),
            dict(enumerate(fit.numbers[fit.chosen].tolist())),
            {number: float(ends[fit.chosen[label]]) for number, label in inside},
            dict(zip(numbers, ends.tolist())), self.exemplars_)

    @property
    def relative_validity_(self) -> float:
        """A validity of the clustering (Moulavi, Jaskowiak, Campello, Zimek, Sander, Density-based
        clustering validation, 2014), computed from the spanning forest only.

        It compares the results of several parameters for the same rows.
        """
        fit = self._fitted()
        count, (u, v), values = len(fit.chosen), fit.tree.edges.T, fit.tree.values
        a, b = fit.labels[u], fit.labels[v]
        sparseness, separation = np.zeros(count), np.full(count, np.inf)
        is_inside, is_between = (a == b) & (a >= 0), (a != b) & (a >= 0) & (b >= 0)
        np.maximum.at(sparseness, a[is_inside], values[is_inside])
        for side in (a, b):
            np.minimum.at(separation, side[is_between], values[is_between])
        to_noise = values[(a < 0) != (b < 0)]
        farthest = values.max(initial=0)
        if count == 1 and len(to_noise):
            farthest = to_noise.min()
        separation[np.isinf(separation)] = 2 * farthest
        sizes = np.bincount(fit.labels[fit.labels >= 0], minlength=count)
        with np.errstate(invalid="ignore"):
            validity = (separation - sparseness) / np.maximum(separation, sparseness)
        return float((validity * sizes).sum() / len(fit.labels))

    def weighted_cluster_centroid(self, cluster_id: int) -> _Numbers:
        """The mean of the points of a cluster, weighted with their probabilities."""
        rows, weights = self._members(cluster_id)
        return np.asarray(np.average(rows, weights=weights, axis=0))

    def weighted_cluster_medoid(self, cluster_id: int) -> _Numbers:
        """The point of a cluster with the least sum of weighted distances to its other points."""
        rows, weights = self._members(cluster_id)
        distances = self._fit.space.distances(rows, rows, np.arange(len(rows)))
        return np.asarray(rows[np.argmin((distances * weights).sum(axis=1))])

    def _members(self, cluster_id: int) -> tuple[Any, _Numbers]:
        fit = self._fitted()
        label = _options.whole("cluster_id", cluster_id, 0, len(fit.chosen) - 1)
        if not fit.space.has_points or _arrays.is_sparse(fit.data):
            raise UsageError("X: found a matrix of distances, or a sparse one, expected points")
        is_in = fit.labels == label
        return fit.data[is_in], fit.probabilities[is_in]

    def dbscan_clustering(self, cut_distance: float, min_cluster_size: int = 5) -> _Integers:
        """The components of edges below a distance, which are the clusters of DBSCAN without its
        border points.

        Parameters
        ----------
        cut_distance : float
            Edges with a value below this join clusters.
        min_cluster_size : int
            Points of smaller components are noise.

        Returns
        -------
        ndarray
            Labels 0, 1, … in the order of the first points; -1 is noise.
        """
        return self.single_linkage_tree_.get_clusters(cut_distance, min_cluster_size)


@_options.with_hints
class RobustSingleLinkage(ClusterMixin, BaseEstimator):
    """Robust single linkage (Chaudhuri, Dasgupta, Rates of convergence for the cluster tree, 2010).

    Parameters
    ----------
    cut : float
        Edges with a value below this join clusters.
    k : int
        The core distance of a point is the distance to its k-th nearest other point, at most n - 1.
    alpha : float
        Distances are divided by this number, at least 1, before they are compared with core
        distances.
    gamma : int
        Points of smaller components are noise.
    metric : str or callable
        As in `HDBSCAN`.
    algorithm, core_dist_n_jobs
        These change nothing.
    metric_params : dict, optional
        Parameters of the metric.

    Attributes
    ----------
    labels_ : ndarray
        Labels 0, 1, … in the order of the first points; -1 is noise.
    cluster_hierarchy_ : SingleLinkageTree
    """

    def __init__(self, cut: float = 0.4, k: int = 5, alpha: float = 1.4142135623730951,
                 gamma: int = 5, metric: Any = "euclidean", algorithm: str = "best",
                 core_dist_n_jobs: int = 4, metric_params: dict[str, Any] | None = None) -> None:
        self.cut = cut
        self.k = k
        self.alpha = alpha
        self.gamma = gamma
        self.metric = metric
        self.algorithm = algorithm
        self.core_dist_n_jobs = core_dist_n_jobs
        self.metric_params = metric_params

    def fit(self, X: Any, y: Any = None) -> RobustSingleLinkage:
        """Clusters the rows.

        Parameters
        ----------
        X : array_like or sparse matrix
            Points, or distances.
        y : None
            Not used; present because pipelines pass it.

        Returns
        -------
        self
        """
        self.labels_, linkage = robust_single_linkage(
            X, self.cut, self.k, self.alpha, self.gamma, self.metric, self.algorithm,
            **(self.metric_params or {}))
        self.cluster_hierarchy_ = SingleLinkageTree(linkage)
        return self

    def fit_predict(self, X: Any, y: Any = None) -> _Integers:
        """Clusters the rows; the result is `labels_`."""
        return self.fit(X).labels_
