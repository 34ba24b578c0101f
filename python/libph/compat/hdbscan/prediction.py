# SPDX-License-Identifier: MIT
"""New rows in the clusters of fitted rows, and how strongly rows belong to each cluster."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ... import _arrays, _options
from ..._errors import UsageError
from .. import _missing

if TYPE_CHECKING:
    from ._estimators import HDBSCAN
    from ._fit import Fit

__all__ = ["PredictionData", "all_points_membership_vectors", "approximate_predict",
           "approximate_predict_scores", "membership_vector"]

_BLOCK = 2**17  # numbers computed at a time
_Integers = NDArray[np.int64]
_Numbers = NDArray[np.float64]


def __getattr__(name: str) -> Any:
    return _missing.attribute(__name__, name, __all__)


class PredictionData(NamedTuple):
    """Facts about fitted rows and clusters.

    Attributes
    ----------
    raw_data : ndarray
        The fitted rows.
    core_distances : ndarray
        The core distance of each row.
    cluster_tree : ndarray
        The rows of the condensed tree for clusters.
    cluster_map : dict
        For each cluster inside a chosen one, its label.
    reverse_cluster_map : dict
        For each label, the number of its cluster.
    max_lambdas : dict
        For each cluster inside a chosen one, the largest lambda value of the chosen one.
    leaf_max_lambdas : dict
        For each cluster, its largest lambda value.
    exemplars : list of ndarray
        For each label, the points that stay longest.
    """

    raw_data: Any
    core_distances: _Numbers
    cluster_tree: NDArray[np.void]
    cluster_map: dict[int, int]
    reverse_cluster_map: dict[int, int]
    max_lambdas: dict[int, float]
    leaf_max_lambdas: dict[int, float]
    exemplars: list[Any]


def _joined(clusterer: HDBSCAN, points: Any) -> tuple[Fit, Any, _Integers, _Numbers]:
    """The fit, the new rows, the fitted row that each reaches first, and the value at which it
    does."""
    fit = clusterer._fitted()
    rows = fit.space.table_of_new(points, fit.data)
    kept = fit.space.kept(rows)
    joined, values = np.full(rows.shape[0], -1), np.full(rows.shape[0], np.inf)
    if len(kept):
        joined[kept], values[kept] = fit.hierarchy.attachments(
            fit.space.for_attachment(fit.data, fit.kept, rows[kept]))
    return fit, rows, joined, values


def approximate_predict(clusterer: HDBSCAN, points_to_predict: Any,
                        return_connecting_points: bool = False) -> tuple[Any, ...]:
    """The clusters that new rows would join.

    A row gets the core distance that it would have among the fitted rows, and joins the fitted row
    that it reaches first. It stays with this row as long as the row stays in its cluster. The
    clusters themselves do not change. For the fitted rows, the result is `labels_` and
    `probabilities_`.

    Parameters
    ----------
    clusterer : HDBSCAN
        A fitted estimator. It needs no prediction data.
    points_to_predict : array_like
        New points. With ``metric="precomputed"``, their distances from the fitted rows. Rows that
        are not finite are noise.
    return_connecting_points : bool
        If True, the result has a third array, the fitted row that each new row reaches first; -1 if
        there is none.

    Returns
    -------
    labels, probabilities : ndarray
    """
    fit, _, joined, values = _joined(clusterer, points_to_predict)
    labels, probabilities = fit.predicted(joined, values)
    if _options.flag("return_connecting_points", return_connecting_points):
        return labels, probabilities, joined
    return labels, probabilities


def approximate_predict_scores(clusterer: HDBSCAN, points_to_predict: Any) -> _Numbers:
    """The outlier scores of new rows, from 0 to 1.

    For the fitted rows, the result is `outlier_scores_`.

    Parameters
    ----------
    clusterer, points_to_predict
        As in `approximate_predict`.
    """
    fit, _, joined, values = _joined(clusterer, points_to_predict)
    cluster, leaves_at = fit.left_by(joined, values)
    return 1 - _quotient(fit.tree.clusters["least"][cluster], leaves_at)


def membership_vector(clusterer: HDBSCAN, points_to_predict: Any) -> _Numbers:
    """How strongly new rows belong to each cluster.

    As in the package, the formula is not that of `all_points_membership_vectors`: it favours the
    nearest cluster more.

    Parameters
    ----------
    clusterer, points_to_predict
        As in `approximate_predict`.

    Returns
    -------
    ndarray
        One row per new row, one column per cluster. The sum of a row is the probability that it
        belongs to a cluster.
    """
    fit, rows, joined, values = _joined(clusterer, points_to_predict)
    return _strengths(fit, rows, *fit.left_by(joined, values),
                      lambda share: 1 / (1 - share), (0.5, 2.0))


def all_points_membership_vectors(clusterer: HDBSCAN) -> _Numbers:
    """How strongly the fitted rows belong to each cluster.

    Parameters
    ----------
    clusterer : HDBSCAN
        A fitted estimator.

    Returns
    -------
    ndarray
        One row per fitted row, one column per cluster. The sum of a row is the probability that it
        belongs to a cluster. Without clusters, an array of zeros, one per row.
    """
    fit = clusterer._fitted()
    if not len(fit.chosen):
        return np.zeros(len(fit.tree))
    return _strengths(fit, fit.data, fit.tree.cluster_of, fit.tree.leaves_at,
                      lambda share: np.exp(-1 / share), (1.0, 1.0))


def _strengths(fit: Fit, rows: Any, cluster: _Integers, leaves_at: _Numbers, score: Any,
               exponents: tuple[float, float]) -> _Numbers:
    """The product of two shares and a probability, for each row and each chosen cluster.

    The first share is in proportion to 1 / distance from the exemplars of the cluster. The second
    one grows with `score`, a function of the bottom of the cluster that the row leaves divided by
    the value at which the row meets the chosen cluster. The probability is the quotient of the
    values at which the chosen cluster that it meets first ends and at which the row meets it.
    """
    result = _arrays.new_array((len(cluster), len(fit.chosen)))
    result[:] = 0
    joined = np.flatnonzero(np.isfinite(leaves_at))
    if not len(joined) or not len(fit.chosen):
        return result
    meetings, exemplars = fit.meetings(), fit.exemplars()
    step = max(1, _BLOCK // len(fit.chosen))
    for first in range(0, len(joined), step):  # in parts, because each part needs several arrays
        part = joined[first:first + step]
        near = _shares_of_near(fit.space.nearest(rows[part], fit.data, exemplars))
        result[part] = _strengths_of_joined(fit, cluster[part], leaves_at[part], meetings, near,
                                            score, exponents)
    return result


def _strengths_of_joined(fit: Fit, cluster: _Integers, leaves_at: _Numbers, meetings: _Numbers,
                         near: _Numbers, score: Any, exponents: tuple[float, float]) -> _Numbers:
    """The strengths of rows that join a cluster. `near` is the first of the two shares."""
    clusters = fit.tree.clusters
    met = meetings[cluster]
    met = np.where(met < 0, leaves_at[:, None], met)
    with np.errstate(divide="ignore"):
        scores = score(_quotient(clusters["bottom"][cluster][:, None], met))
    largest = scores.max(axis=1, keepdims=True)
    with np.errstate(invalid="ignore"):  # inf - inf
        inside = np.where(scores == largest, 1.0, np.exp(scores - largest))
    inside /= inside.sum(axis=1, keepdims=True)
    shares = near**exponents[0] * inside**exponents[1]
    first = met.min(axis=1)
    ends = np.where(met == first[:, None], clusters["bottom"][fit.chosen], 0).max(axis=1)
    probability = _quotient(np.minimum(ends, leaves_at), first)
    strengths: _Numbers = shares * (probability / shares.sum(axis=1))[:, None]
    return strengths


def _quotient(less: _Numbers, more: _Numbers) -> _Numbers:
    """The quotient, at most 1; 1 for zeros, 0 for an infinite denominator."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(less >= more, 1.0, np.where(np.isinf(more), 0.0, less / more))


def _shares_of_near(distances: _Numbers) -> _Numbers:
    """Shares in proportion to 1 / distance. Distances of 0 share everything."""
    is_zero = distances == 0
    with np.errstate(divide="ignore"):
        inverse = np.where(is_zero.any(axis=1, keepdims=True), is_zero, 1 / distances)
    total = inverse.sum(axis=1, keepdims=True)
    return np.where(total > 0, inverse / np.where(total > 0, total, 1), 1 / distances.shape[1])
