# SPDX-License-Identifier: MIT
"""Of one point cloud, a row a sample: distances to a measure and to landmarks."""
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
    """The distance to the measure of the points that were fitted: large at outliers.

    The root of the mean square of the distances to the k nearest of these points
    [Chazal, Cohen-Steiner & Mérigot 2011]. A point that was fitted is one of them itself.

    Parameters
    ----------
    k : int
        How many neighbours.
    metric : str
        "euclidean", "manhattan", "chebyshev" or "cosine".
    n_jobs : int, optional
        Threads of the search. Default: one.

    See Also
    --------
    libph.distance_to_measure : the same for the points themselves.

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
            Points, one a row.
        y : None
            Not used; pipelines pass it.

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
        """The distance of each row.

        Parameters
        ----------
        X : array_like
            Points, one a row.

        Returns
        -------
        ndarray
            One column.
        """
        check_is_fitted(self)
        distances, _ = self._search.of(table_of(self, X, reset=False))
        return root_mean_square(distances)[:, None]


class FarthestPoints(ClassNamePrefixFeaturesOutMixin, TransformerMixin, BaseEstimator):
    """Landmarks that are spread over all points, by farthest-point sampling [Gonzalez 1985].

    The first is row 0, each further one the point farthest from those before. A transformer of
    scikit-learn keeps all rows, so `transform` gives the distances to the landmarks; the selected
    rows are `points_`. Inside a pipeline of clouds, ``RipsPersistence(subsample=n)`` selects.

    Parameters
    ----------
    n : int
        How many landmarks. Of fewer points, or fewer different ones, all are landmarks.
    metric : str
        "euclidean", "manhattan", "chebyshev" or "cosine".

    Attributes
    ----------
    points_ : ndarray
        The landmarks, in their order.
    indices_ : ndarray
        Their rows.
    radii_ : ndarray
        Of each its distance to the nearest of those before; inf for the first.
    covering_radius_ : float
        Each point is at most so far from a landmark.

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
            Points, one a row.
        y : None
            Not used; pipelines pass it.

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
            Points, one a row.

        Returns
        -------
        ndarray
            A row for each point, a column for each landmark.
        """
        check_is_fitted(self)
        metric = _options.choice("metric", self.metric, METRICS)
        return distances_between(table_of(self, X, reset=False), self.points_, metric)
