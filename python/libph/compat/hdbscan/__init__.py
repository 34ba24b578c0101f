# SPDX-License-Identifier: MIT
"""The interface of the package hdbscan, on top of libph.

The labels differ from those of the package on purpose. Mutual reachability makes many edges of
equal length. The package removes such edges one by one, in an order that depends on the order of
the rows; libph removes them at once, as the definition says. The clusters are therefore the same
for any order of the rows, and they are those of the package where no two values are equal. The
numbers of clusters differ as well: here they go from the root down, level by level, and clusters
with the same parent are in the order of their first rows. In the package they depend on the
direction in which its search finds an edge.

>>> from libph.compat import hdbscan
>>> X = [[0], [1], [2], [3], [20], [21], [22], [23], [50]]
>>> found = hdbscan.HDBSCAN(min_cluster_size=3, min_samples=1).fit(X)
>>> found.labels_
array([ 0,  0,  0,  0,  1,  1,  1,  1, -1])

`min_samples` does not count the point itself. docs/how-to/coming-from.md lists the cases in which
libph deliberately gives another answer.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ... import _options
from ..._core import version as __version__
from .. import _missing
from ._fit import ALGORITHMS, Fit, linkage_of, refuse_unless
from .prediction import (all_points_membership_vectors, approximate_predict,
                         approximate_predict_scores, membership_vector)
from .validity import validity_index

if TYPE_CHECKING:
    from ._estimators import HDBSCAN, RobustSingleLinkage

__all__ = ["HDBSCAN", "RobustSingleLinkage", "__version__", "all_points_membership_vectors",
           "approximate_predict", "approximate_predict_scores", "hdbscan", "membership_vector",
           "robust_single_linkage", "validity_index"]

# The parameters that change something and are not refused.
_USED = ["min_cluster_size", "min_samples", "alpha", "cluster_selection_epsilon",
         "max_cluster_size", "metric", "p", "cluster_selection_method", "allow_single_cluster",
         "match_reference_implementation"]


def __getattr__(name: str) -> Any:
    if name in ("HDBSCAN", "RobustSingleLinkage"):  # their base class is scikit-learn's
        from . import _estimators
        return getattr(_estimators, name)
    return _missing.attribute(__name__, name, __all__)


def hdbscan(X: Any, min_cluster_size: int = 5, min_samples: int | None = None, alpha: float = 1.0,
            cluster_selection_epsilon: float = 0.0, cluster_selection_persistence: float = 0.0,
            max_cluster_size: int = 0, metric: Any = "minkowski", p: float | None = 2,
            leaf_size: int = 40, algorithm: str = "best", memory: Any = None,
            approx_min_span_tree: bool = True, gen_min_span_tree: bool = False,
            core_dist_n_jobs: int = 4, cluster_selection_method: str = "eom",
            allow_single_cluster: bool = False, match_reference_implementation: bool = False,
            cluster_selection_epsilon_max: float = float("inf"), **kwargs: Any
            ) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64],
                       NDArray[np.void], NDArray[np.float64], NDArray[np.float64] | None]:
    """The clusters of a table, without an estimator.

    Parameters
    ----------
    X, min_cluster_size, min_samples, alpha, cluster_selection_epsilon, \
cluster_selection_persistence, max_cluster_size, metric, p, leaf_size, algorithm, memory, \
approx_min_span_tree, core_dist_n_jobs, cluster_selection_method, allow_single_cluster, \
match_reference_implementation, cluster_selection_epsilon_max, kwargs
        As in `HDBSCAN`.
    gen_min_span_tree : bool
        If True, the last result is the spanning forest; else it is None.

    Returns
    -------
    labels, probabilities, persistence : ndarray
    condensed_tree : ndarray
        Rows `parent`, `child`, `lambda_val`, `child_size`.
    single_linkage_tree : ndarray
        A linkage matrix of ``scipy.cluster.hierarchy``.
    min_spanning_tree : ndarray or None
        Rows of two points and a value.

    Examples
    --------
    >>> from libph.compat import hdbscan
    >>> hdbscan.hdbscan([[0], [1], [2], [20], [21], [22]], 3, 1)[0]
    array([0, 0, 0, 1, 1, 1])
    """
    fit = fit_of(X, locals(), kwargs)
    wants_forest = _options.flag("gen_min_span_tree", gen_min_span_tree)
    return (fit.labels, fit.probabilities, fit.persistence, fit.condensed(), linkage_of(fit.tree),
            fit.spanning_tree() if wants_forest else None)


def fit_of(X: Any, options: dict[str, Any], given: dict[str, Any]) -> Fit:
    """The fit with the parameters of `hdbscan`, by name; `given` are those of the metric."""
    _options.choice("algorithm", options["algorithm"], ALGORITHMS)
    refuse_unless("cluster_selection_persistence", options["cluster_selection_persistence"], 0,
                  "cluster_selection_epsilon joins clusters by distance")
    refuse_unless("cluster_selection_epsilon_max", options["cluster_selection_epsilon_max"], np.inf,
                  "max_cluster_size bounds the sizes of clusters")
    return Fit(hdbscan, X, given, **{name: options[name] for name in _USED})


def robust_single_linkage(X: Any, cut: float, k: int = 5, alpha: float = 1.4142135623730951,
                          gamma: int = 5, metric: Any = "euclidean", algorithm: str = "best",
                          memory: Any = None, leaf_size: int = 40, core_dist_n_jobs: int = 4,
                          **kwargs: Any) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Robust single linkage (Chaudhuri, Dasgupta, Rates of convergence for the cluster tree, 2010).

    Parameters
    ----------
    X, cut, k, alpha, gamma, metric, algorithm, core_dist_n_jobs
        As in `RobustSingleLinkage`.
    memory, leaf_size
        These change nothing.
    **kwargs
        Parameters of the metric.

    Returns
    -------
    labels : ndarray
    single_linkage_tree : ndarray
        A linkage matrix of ``scipy.cluster.hierarchy``.

    Examples
    --------
    >>> from libph.compat import hdbscan
    >>> hdbscan.robust_single_linkage([[0], [1], [2], [20], [21], [22]], 2, k=1, gamma=3)[0]
    array([0, 0, 0, 1, 1, 1])
    """
    from .plots import SingleLinkageTree
    _options.choice("algorithm", algorithm, ALGORITHMS)
    given = dict(kwargs)
    fit = Fit(robust_single_linkage, X, given, min_samples=_options.whole("k", k, 1),
              alpha=_options.real("alpha", alpha, "a number, at least 1", 1), metric=metric,
              p=given.pop("p", None))
    linkage = linkage_of(fit.tree)
    return SingleLinkageTree(linkage).get_clusters(cut, _options.whole("gamma", gamma, 1)), linkage
