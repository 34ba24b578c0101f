# SPDX-License-Identifier: MIT
"""Distances between the rows of two tables, exact to the last digits at any offset and scale.

scikit-learn's fast distances use dot products, which lose digits if rows are near each other and
far from 0. Here they use differences of coordinates, in a unit in which no square overflows.
"""
from __future__ import annotations

import numpy as np
from joblib import Parallel, delayed
from numpy.typing import NDArray
from scipy.spatial.distance import cdist
from sklearn.neighbors import NearestNeighbors

from .. import _sources
from .._errors import DataError

# The metrics that libph and scikit-learn both know by these names, with the same values.
METRICS = ["euclidean", "l2", "manhattan", "l1", "cityblock", "chebyshev", "cosine"]

_Numbers = NDArray[np.float64]
_MOST_FOR_A_TREE = 15  # with more coordinates, a tree visits nearly all points and is slower
_ENTRIES = 2**21  # size of the table of distances that a thread holds
_ROOM = 400  # rows may be 2**400 times as far from 0 as points: the square of that is a double


class Neighbours:
    """Finds the nearest neighbours of rows among some points.

    Parameters
    ----------
    points : ndarray
        Points, one per row.
    k : int
        Number of neighbours to find.
    metric : str
        One of METRICS.
    n_jobs : int, optional
        Number of threads, in the convention of scikit-learn.
    """

    def __init__(self, points: _Numbers, k: int, metric: str, n_jobs: int | None) -> None:
        self._points, self._name = _comparable(points, metric)
        self._k = k
        self._n_jobs = n_jobs
        self._exponent = _exponent_of(self._points)
        is_for_a_tree = self._points.shape[1] <= _MOST_FOR_A_TREE
        self._search = self._search_in(self._exponent) if is_for_a_tree else None

    def _search_in(self, exponent: int) -> NearestNeighbors:
        # This tree uses differences of coordinates; "brute", and hence "auto", do not.
        search = NearestNeighbors(n_neighbors=self._k, metric=_of_differences(self._name),
                                  algorithm="kd_tree", n_jobs=self._n_jobs)
        return search.fit(np.ldexp(self._points, -exponent))

    def of(self, rows: _Numbers) -> tuple[_Numbers, NDArray[np.int64]]:
        """For each row, the distances to its k nearest points, ascending, and the indices of these
        points."""
        rows = _comparable(rows, self._name)[0]
        exponent = max(self._exponent, _exponent_of(rows) - _ROOM)
        scaled = np.ldexp(rows, -exponent)
        if self._search is None:
            distances, places = self._by_all(scaled, np.ldexp(self._points, -exponent))
        else:
            search = self._search if exponent == self._exponent else self._search_in(exponent)
            distances, places = search.kneighbors(scaled)
        return _in_metric(np.ldexp(distances, exponent), self._name), places

    def _by_all(self, rows: _Numbers, points: _Numbers) -> tuple[_Numbers, NDArray[np.int64]]:
        """Computes all distances, some rows at a time, and selects the nearest points."""
        many = max(1, _ENTRIES // len(points))
        strips = [rows[start:start + many] for start in range(0, len(rows), many)]
        found = Parallel(n_jobs=self._n_jobs, prefer="threads")(
            delayed(_nearest)(strip, points, self._k, _of_differences(self._name)) for strip in strips)
        return np.concatenate([f[0] for f in found]), np.concatenate([f[1] for f in found])


def _nearest(rows: _Numbers, points: _Numbers, k: int,
             metric: str) -> tuple[_Numbers, NDArray[np.int64]]:
    apart = cdist(rows, points, metric)
    places = np.argpartition(apart, k - 1, axis=1)[:, :k]
    distances = np.take_along_axis(apart, places, axis=1)
    order = np.argsort(distances, axis=1, kind="stable")
    return np.take_along_axis(distances, order, axis=1), np.take_along_axis(places, order, axis=1)


def distances_between(rows: _Numbers, points: _Numbers, metric: str) -> _Numbers:
    """The distance of each row to each point, as a matrix."""
    (rows, name), (points, _) = _comparable(rows, metric), _comparable(points, metric)
    exponent = max(_exponent_of(rows), _exponent_of(points))
    distances = cdist(np.ldexp(rows, -exponent), np.ldexp(points, -exponent), _of_differences(name))
    return _in_metric(np.ldexp(distances, exponent), name)


def _comparable(rows: _Numbers, metric: str) -> tuple[_Numbers, str]:
    """The rows (for cosine distances, their directions) and the first name of the metric."""
    name = _sources.METRICS[metric]
    if name != "cosine":
        return rows, name
    largest = np.abs(rows).max(axis=1, keepdims=True)
    if not largest.all():
        raise DataError(f"X: row {int(np.argmin(largest))}: found the zero vector, which has no "
                        "direction; the cosine distance needs one")
    rows = rows / largest
    return rows / np.sqrt((rows**2).sum(axis=1, keepdims=True)), name


def _of_differences(name: str) -> str:
    return {"manhattan": "cityblock", "chebyshev": "chebyshev"}.get(name, "euclidean")


def _in_metric(distances: _Numbers, name: str) -> _Numbers:
    """For unit vectors x and y, 1 - cos equals |x - y|² / 2, which keeps its digits."""
    return distances**2 / 2 if name == "cosine" else distances


def _exponent_of(rows: _Numbers) -> int:
    """The scale of the largest coordinate, as a power of 2."""
    return int(np.frexp(np.abs(rows).max(initial=0.0))[1])
