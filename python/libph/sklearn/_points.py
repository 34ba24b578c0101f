# SPDX-License-Identifier: MIT
"""Transformers for one point cloud, whose rows are samples: distances to a measure and to
landmarks."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from sklearn.base import BaseEstimator, ClassNamePrefixFeaturesOutMixin, TransformerMixin
from sklearn.utils.validation import check_is_fitted

from .. import _options
from .._points import farthest_points, root_mean_square
from ._base import neighbours_wanted, table_of
from ._neighbours import METRICS, Neighbours, distances_between


class DistanceToMeasure(ClassNamePrefixFeaturesOutMixin, TransformerMixin, BaseEstimator):
    """The distance to the measure of the fitted points, which is large at outliers.

    It is the root mean square of the distances to the k nearest fitted points [Chazal,
    Cohen-Steiner & Mérigot 2011]. A fitted point counts as one of its own neighbours.

    Parameters
    ----------
    k : int
        Number of neighbours.
    metric : str
        "euclidean", "manhattan", "chebyshev" or "cosine".
    n_jobs : int, optional
        Number of threads of the search. Default: one.

    See Also
    --------
    libph.distance_to_measure : the same distance for the points themselves.

    Examples
    --------
    >>> ph.sklearn.DistanceToMeasure(k=2).fit([[0], [1], [5]]).transform([[0], [9]])
    array([[0.70710678],
           [6.32455532]])
    """

    def __init__(self, k: int = 10, metric: str = "euclidean", n_jobs: int | None = None) -> None:
        self.k = k
        self.metric = metric
        self.n_jobs = n_jobs

    def fit(self, X: Any, y: Any = None) -> DistanceToMeasure:
        """Keeps the points.

        Parameters
        ----------
        X : array_like
            Points, one per row.
        y : None
            Not used; present because pipelines pass it.

        Returns
        -------
        self
        """
        k = _options.whole("k", self.k, 1)
        metric = _options.choice("metric", self.metric, METRICS)
        points = table_of(self, X, reset=True)
        neighbours_wanted(k, len(points))
        self._search = Neighbours(points, k, metric, self.n_jobs)
        self._n_features_out = 1
        return self

    def transform(self, X: Any) -> NDArray[np.float64]:
        """The distance of each row to the measure.

        Parameters
        ----------
        X : array_like
            Points, one per row.

        Returns
        -------
        ndarray
            One column.
        """
        check_is_fitted(self)
        distances, _ = self._search.of(table_of(self, X, reset=False))
        return root_mean_square(distances)[:, None]


class FarthestPoints(ClassNamePrefixFeaturesOutMixin, TransformerMixin, BaseEstimator):
    """Landmarks spread over all points by farthest-point sampling [Gonzalez 1985].

    The first landmark is row 0; each further landmark is the point farthest from the landmarks
    before it. A transformer of scikit-learn must keep all rows; therefore `transform` returns the
    distances to the landmarks, and `points_` holds the selected rows. Inside a pipeline of clouds,
    ``RipsPersistence(subsample=n)`` selects points.

    Parameters
    ----------
    n : int
        Number of landmarks. If there are fewer distinct points, all of them are landmarks.
    metric : str
        "euclidean", "manhattan", "chebyshev" or "cosine".

    Attributes
    ----------
    points_ : ndarray
        The landmarks, in their order.
    indices_ : ndarray
        The rows of the landmarks.
    radii_ : ndarray
        The distance of each landmark to the nearest landmark before it; inf for the first.
    covering_radius_ : float
        Each point is at most this far from a landmark.

    Examples
    --------
    >>> sample = ph.sklearn.FarthestPoints(n=2).fit([[0], [1], [10], [11]])
    >>> sample.points_
    array([[ 0.],
           [11.]])
    >>> sample.transform([[4]])
    array([[4., 7.]])
    """

    def __init__(self, n: int = 8, metric: str = "euclidean") -> None:
        self.n = n
        self.metric = metric

    def fit(self, X: Any, y: Any = None) -> FarthestPoints:
        """Selects the landmarks.

        Parameters
        ----------
        X : array_like
            Points, one per row.
        y : None
            Not used; present because pipelines pass it.

        Returns
        -------
        self
        """
        count = _options.whole("n", self.n, 1)
        metric = _options.choice("metric", self.metric, METRICS)
        points = table_of(self, X, reset=True)
        self.indices_, self.radii_, self.covering_radius_ = farthest_points(
            points, count, metric=metric)
        self.points_ = points[self.indices_]
        self._n_features_out = len(self.indices_)
        return self

    def transform(self, X: Any) -> NDArray[np.float64]:
        """The distance of each row to each landmark.

        Parameters
        ----------
        X : array_like
            Points, one per row.

        Returns
        -------
        ndarray
            One row per point, one column per landmark.
        """
        check_is_fitted(self)
        metric = _options.choice("metric", self.metric, METRICS)
        return distances_between(table_of(self, X, reset=False), self.points_, metric)
