# SPDX-License-Identifier: MIT
"""Tables of points or distances, and how their metrics are computed."""
from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ... import _arrays, _hierarchy, _options
from ..._errors import DataError, NotBuiltIn, UsageError

_Integers = NDArray[np.int64]
_Numbers = NDArray[np.float64]


class Space:
    """A metric, and how it is computed: by libph, or as a matrix by scikit-learn.

    `given` are parameters of the metric, among the keywords of `function`.
    """

    def __init__(self, function: Callable[..., Any], metric: Any, p: Any, alpha: float,
                 given: dict[str, Any]) -> None:
        self.metric = metric
        self.alpha = alpha
        self._given = given
        if isinstance(metric, str) and metric == "mahalanobis" and "V" in given:
            self._given = {"VI": np.linalg.inv(given["V"])}  # the name that SciPy has
        self._p = 2.0
        self._farthest = np.inf
        self.name: Any = None  # the metric of libph; None: it is scikit-learn's
        allowed: list[str] = []
        if callable(metric):
            self.name, allowed = functools.partial(metric, **given) if given else metric, [*given]
        elif not isinstance(metric, str):
            raise _options.refuse("metric", metric, "a name or a function of two points")
        elif metric in _hierarchy.METRICS and metric != "hamming":  # libph counts, others divide
            self.name = _hierarchy.METRICS[metric]
            if self.name == "minkowski" and p is not None:
                self._p = _options.real("p", p, "a number, at least 1", 1)
        elif metric == "precomputed":
            self.name, allowed = "precomputed", ["max_dist"]
            if given.get("max_dist"):
                self._farthest = _options.positive("max_dist", given["max_dist"])
        else:
            allowed = [*given]
        for name in given:
            if name not in allowed:
                from ... import _hints
                known = list(_options.signature_of(function).parameters)[1:-1]
                raise _hints.unexpected(function.__name__, name, known)

    @property
    def has_points(self) -> bool:
        return not (isinstance(self.name, str) and self.name == "precomputed")

    @property
    def _is_on_sphere(self) -> bool:
        """True for points of the unit sphere whose chords are computed instead of their arcs. The
        longer chord has the longer arc, but `alpha` compares lengths."""
        return isinstance(self.metric, str) and self.metric == "haversine" and self.alpha == 1

    def table(self, X: Any) -> Any:
        """The rows as an array of doubles, or as a sparse matrix."""
        if not _arrays.is_sparse(X):
            X = _arrays.as_float64(_arrays.as_array(X, "X"), "X")
        else:
            X = X.tocsr()
            if self.has_points:
                self.name = None  # libph reads sparse distances, but not sparse points
        if X.ndim != 2:
            raise UsageError(f"X: found an array of shape {X.shape}, expected rows of numbers")
        if not self.has_points and X.shape[0] != X.shape[1]:
            raise UsageError(f"X: found a matrix of shape {X.shape}, expected a square one of "
                             "distances")
        return X

    def table_of_new(self, new: Any, X: Any) -> Any:
        """New rows, which have the columns of X."""
        if not _arrays.is_sparse(new):
            new = _arrays.as_float64(_arrays.as_array(new, "points_to_predict"),
                                     "points_to_predict")
        if new.ndim != 2 or new.shape[1] != X.shape[1]:
            raise UsageError(f"points_to_predict: found an array of shape {new.shape}, expected "
                             f"rows with {X.shape[1]} columns, as the fitted table has")
        return new

    def kept(self, X: Any) -> _Integers:
        """The rows that take part: those without NaN and infinite numbers."""
        if self.has_points and _arrays.is_sparse(X):
            return np.setdiff1d(np.arange(X.shape[0]), X.tocoo().row[~np.isfinite(X.data)])
        if self.has_points:
            return np.flatnonzero(np.isfinite(X).all(axis=1))
        if np.isnan(X.data if _arrays.is_sparse(X) else X).any():
            raise DataError("X: found NaN among the distances, expected numbers at least 0; inf "
                            "means that a pair is never joined")
        return np.arange(X.shape[0])

    def hierarchy(self, X: Any, kept: _Integers, k: int, min_size: int) -> _hierarchy.Hierarchy:
        """The hierarchy of these rows."""
        data, name = X, self.name
        reading: Callable[[_Numbers], _Numbers] = _hierarchy.as_they_are
        if self._is_on_sphere:
            data, name, reading = _on_sphere(X), "euclidean", _arcs
        elif name is None:
            data, name = np.full((X.shape[0],) * 2, np.inf), "precomputed"
            data[np.ix_(kept, kept)] = self._pairwise(X[kept])
        return _hierarchy.Hierarchy(data, kept, k, min_size, metric=name, p=self._p,
                                    alpha=self.alpha, farthest=self._farthest, reading=reading)

    def for_attachment(self, X: Any, kept: _Integers, new: Any) -> Any:
        """New rows in the form that `Hierarchy.attachments` expects."""
        if self._is_on_sphere:
            return _on_sphere(new)
        if self.name is not None:
            return new
        distances = np.full((new.shape[0], X.shape[0]), np.inf)
        distances[:, kept] = self._pairwise(new, X[kept])
        return distances

    def nearest(self, new: Any, X: Any, sets: list[_Integers]) -> _Numbers:
        """For each new row, its distance from the nearest of several sets of rows of X."""
        found = np.full((new.shape[0], len(sets)), np.inf)
        strip = max(1, 2**22 // max([1, *map(len, sets)]))
        for start in range(0, len(found), strip):
            part = slice(start, start + strip)
            for label, rows in enumerate(sets):
                if len(rows):
                    found[part, label] = self.distances(new[part], X, rows).min(axis=1)
        return found

    def distances(self, new: Any, X: Any, rows: _Integers) -> _Numbers:
        """The distances of new rows from some rows of X."""
        if not self.has_points:
            if _arrays.is_sparse(new):
                raise UsageError("X: found only some of the distances (a sparse matrix), expected "
                                 "all")
            return np.asarray(new[:, rows])
        if self.name is None or self._is_on_sphere:
            return self._pairwise(new, X[rows])
        from scipy.spatial.distance import cdist
        name = self.name if callable(self.name) else {"manhattan": "cityblock"}.get(self.name,
                                                                                    self.name)
        return np.asarray(cdist(new, X[rows], name, **(
            {"p": self._p} if name == "minkowski" else {})))

    def _pairwise(self, *tables: Any) -> _Numbers:
        try:
            from sklearn.metrics import pairwise_distances
        except ImportError:
            raise NotBuiltIn(f"metric={self.metric!r}: needs scikit-learn, which is not installed; "
                             "metric='precomputed' takes distances") from None
        return np.asarray(pairwise_distances(*tables, metric=self.metric, **self._given))


def _on_sphere(X: Any) -> _Numbers:
    """Points of the unit sphere, from rows of latitude and longitude in radians."""
    if X.shape[1] != 2:
        raise UsageError(f"X: found an array of shape {X.shape}, expected rows of latitude and "
                         "longitude in radians")
    latitude, longitude = X.T
    return np.column_stack([np.cos(latitude) * np.cos(longitude),
                            np.cos(latitude) * np.sin(longitude), np.sin(latitude)])


def _arcs(chords: _Numbers) -> _Numbers:
    """The lengths of arcs of the unit circle. Infinity stays."""
    arcs: _Numbers = np.where(np.isinf(chords), chords, 2 * np.arcsin(np.clip(chords / 2, 0, 1)))
    return arcs
