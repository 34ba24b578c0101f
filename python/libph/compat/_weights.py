# SPDX-License-Identifier: MIT
"""Weighted Rips filtrations: points that enter late, and the distances at which their balls meet.

Anai et al., DTM-based filtrations, 2020.
"""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _arrays, _options, _sources
from .._errors import DataError, NotBuiltIn, UsageError

_STRIP = 512  # rows of a matrix that are computed together


def weighted(distances: Any, weights: ArrayLike | str, params: Mapping[str, Any]
             ) -> tuple[Any, NDArray[np.float64]]:
    """Distances at which the balls of two points meet, and the births of points.

    Parameters
    ----------
    distances : ndarray or sparse matrix
        Only the part above the diagonal of an array is read.
    weights : array_like or "DTM"
    params : dict
        "p", "r", "n_neighbors", as in `ripser_parallel`.
    """
    if isinstance(weights, str) and weights != "DTM":
        raise UsageError(f"'{weights}' passed for `weights` but the only allowed string is 'DTM'")
    known = ("p", "r", "n_neighbors")
    for name in params:
        if name not in known:
            raise UsageError(f"weight_params: found {name!r}, expected {', '.join(known)}")
    p = params.get("p", 1)
    if p not in (1, 2, np.inf):
        raise NotBuiltIn(f"weight_params: p: found {p}, expected 1, 2 or inf")
    if _arrays.is_sparse(distances):
        return _of_sparse(distances, weights, p, params)
    n = len(distances)
    mirrored = np.triu(distances, 1).astype(np.float64, copy=False)
    mirrored += mirrored.T
    _refuse_negative(mirrored)
    births = distance_to_measure(lambda i: mirrored[i], n, params) if isinstance(weights, str) \
        else _given(weights, n)
    for begin in range(0, n, _STRIP):
        rows = slice(begin, begin + _STRIP)
        mirrored[rows] = meeting(mirrored[rows], births[rows, None], births, p)
    return mirrored, births


def _of_sparse(matrix: Any, weights: ArrayLike | str, p: float, params: Mapping[str, Any]
               ) -> tuple[Any, NDArray[np.float64]]:
    from scipy.sparse import coo_matrix
    n = max(matrix.shape)
    row, column, values = _sources.sparse_entries(matrix)
    _refuse_negative(values)
    row, column, values = (a[row != column] for a in (row, column, values))
    # Each pair once. If a pair has two entries, the upper one counts.
    i, j = np.minimum(row, column), np.maximum(row, column)
    order = np.lexsort((row > column, j, i))
    i, j, values = i[order], j[order], values[order]
    first = np.ones(len(i), dtype=bool)
    first[1:] = (i[1:] != i[:-1]) | (j[1:] != j[:-1])
    i, j, values = i[first], j[first], values[first]
    if isinstance(weights, str):
        ends, both = np.concatenate([i, j]), np.concatenate([values, values])
        order = np.argsort(ends, kind="stable")
        begins = np.searchsorted(ends[order], np.arange(n + 1)).tolist()
        both = both[order]
        births = distance_to_measure(lambda k: both[begins[k]:begins[k + 1]], n, params, False)
    else:
        births = _given(weights, n)
    return coo_matrix((meeting(values, births[i], births[j], p), (i, j)), shape=(n, n)), births


def _refuse_negative(values: NDArray[Any]) -> None:
    if values.min(initial=0.0) < 0:
        raise DataError(f"X: found the distance {values.min()} with weights, expected 0 or more")


def _given(weights: ArrayLike, n: int) -> NDArray[np.float64]:
    births = _arrays.as_values(np.ravel(weights), "weights", n, "point")
    wrong = ~(births >= 0)
    if wrong.any():
        raise UsageError(f"weights: entry {int(np.argmax(wrong))}: found "
                         f"{births[np.argmax(wrong)]}, expected a number of at least 0")
    return births


def distance_to_measure(distances_of: Any, n: int, params: Mapping[str, Any],
                         has_itself: bool = True) -> NDArray[np.float64]:
    """For each point, twice the power mean, with exponent r, of the distances to its nearest points
    and to itself."""
    neighbours = _options.whole("weight_params: n_neighbors", params.get("n_neighbors", 3), 1)
    r = _options.positive("weight_params: r", params.get("r", 2))
    births = np.empty(n)
    for k in range(n):
        distances = distances_of(k)
        if has_itself:
            distances = np.delete(distances, k)
        if len(distances) < neighbours:
            raise UsageError(f"weight_params: n_neighbors: found {neighbours}, expected at most "
                             f"{len(distances)}, the number of neighbours known for point {k}")
        nearest = np.partition(distances, neighbours - 1)[:neighbours]
        births[k] = 2 * ((nearest**r).sum() / (neighbours + 1))**(1 / r)
    return births


def meeting(d: NDArray[np.float64], a: NDArray[np.float64], b: NDArray[np.float64], p: float
             ) -> NDArray[np.float64]:
    """The value t at which balls born at a and b meet: the solution of 2 d = (t**p - a**p)**(1/p) +
    (t**p - b**p)**(1/p), or the later birth if they meet before it."""
    later = np.maximum(a, b)
    if p == np.inf:
        return np.maximum(d, later)
    if p == 1:
        return np.maximum(later, d + (a + b) / 2)
    with np.errstate(divide="ignore", invalid="ignore"):
        meet = np.sqrt((d**2 + ((a + b) / 2)**2) * (d**2 + ((a - b) / 2)**2)) / d
        return np.where(4 * d**2 <= np.abs(a**2 - b**2), later, meet)
