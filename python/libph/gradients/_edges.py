# SPDX-License-Identifier: MIT
"""Values of simplices of Vietoris-Rips filtrations as functions of points and distances."""
from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from .. import _arrays
from .._errors import DataError, UsageError
from .._points import root_mean_square
from .._sources import METRICS
from ._distances import Distances, MatrixDistances, PointDistances, SparseDistances
from ._values import CellValues, Integers, Numbers

_BLOCK = 2**24  # distances that are processed together


class _Edge(NamedTuple):
    """The values of edges, and their derivatives."""

    values: Numbers
    of_distance: Numbers
    of_births: tuple[Numbers, Numbers]  # births of the two ends


class RipsValues(CellValues):
    """A simplex enters with its last edge; the value of an edge is a function of its length and of
    the births of its ends."""

    width = 2

    def __init__(self, X: Any, meta: Mapping[str, Any], weights: Any) -> None:
        if meta.get("approximation") is not None:
            raise UsageError("bars: found an approximation, whose births and deaths are not functions "
                             "of single distances")
        self._distances = _distances_of(X, meta)
        self._count = self._distances.size
        if self._count != meta["points"]:
            raise DataError(f"X: found {self._count} points, expected {meta['points']}; X must be "
                            "the data from which the barcode was computed")
        self._exponent = meta.get("weight_exponent", math.inf)
        self._neighbours: int | None = None
        self._are_core = False
        self._births: Numbers | None = None
        self._has_diagonal = False
        kind = meta.get("weights")
        if kind in ("dtm", "core"):
            self._neighbours = meta[f"{kind}_neighbors"]
            self._are_core = kind == "core"
            self._births = np.full(self._count, np.nan)  # computed where they are needed
        elif kind == "given":
            self._births, self._has_diagonal = self._given_births(weights)
        self._of_births = np.zeros(self._count)

    def _given_births(self, weights: Any) -> tuple[Numbers, bool]:
        if weights is not None:
            return _arrays.as_values(weights, "weights", self._count, "point"), False
        diagonal = self._distances.diagonal()
        if diagonal is None:
            raise UsageError("weights: found none, expected the weights with which the barcode was computed")
        return diagonal, True

    # ---- births of points

    def _births_of(self, points: Integers) -> Numbers:
        if self._births is None:
            return np.zeros(points.shape)
        if self._neighbours is not None:
            missing = np.unique(points[np.isnan(self._births[points])])
            for part in self._parts(missing):
                rows, k = self._distances.rows(part), self._neighbours  # rows have the point itself
                if self._are_core:
                    self._births[part] = np.partition(rows, k, axis=1)[:, k]
                else:
                    self._births[part] = 2 * root_mean_square(np.partition(rows, k - 1, axis=1)[:, :k])
        return self._births[points]

    def _parts(self, points: Integers) -> Any:
        step = max(1, _BLOCK // max(1, self._count))
        return (points[first:first + step] for first in range(0, len(points), step))

    def _spread_births(self) -> None:
        """Passes the derivatives with respect to births on to distances, because births with
        `weights="dtm"` or "core" are functions of distances."""
        for part in self._parts(np.flatnonzero(self._of_births)):
            rows = self._distances.rows(part)
            order = np.argsort(rows, axis=1, kind="stable")
            if self._are_core:
                self._distances.add(part, order[:, self._neighbours], self._of_births[part])
                continue
            near = order[:, :self._neighbours]
            lengths = np.take_along_axis(rows, near, axis=1)
            births = self._births_of(part)[:, None]
            factors = np.divide(4 * self._of_births[part, None] * lengths, births * near.shape[1],
                                out=np.zeros_like(lengths), where=births > 0)
            self._distances.add(np.repeat(part, near.shape[1]), near.ravel(), factors.ravel())
        self._of_births[:] = 0

    # ---- edges

    def _edge(self, i: Integers, j: Integers) -> _Edge:
        lengths = self._distances.between(i, j)
        one, zero = np.ones(len(i)), np.zeros(len(i))
        if self._births is None:
            return _Edge(lengths, one, (zero, zero))
        a, b = self._births_of(i), self._births_of(j)
        if self._exponent == math.inf:
            met, of_length, of_a, of_b = lengths, one, zero, zero
        elif self._exponent == 1:
            met, of_length, of_a, of_b = lengths + (a + b) / 2, one, one / 2, one / 2
        else:
            met, of_length, of_a, of_b = _met_of_squares(lengths, a, b)
        values = np.maximum(met, np.maximum(a, b))
        is_met, is_a = met == values, a == values
        return _Edge(values, np.where(is_met, of_length, 0),
                     (np.where(is_met, of_a, is_a), np.where(is_met, of_b, ~is_a)))

    def _longest(self, cells: Integers) -> Integers:
        """The ends of the last edge of each simplex; for a vertex, the vertex twice."""
        if cells.shape[1] == 1:
            return np.repeat(cells, 2, axis=1)
        best = np.empty((len(cells), 2), dtype=np.int64)
        values = np.full(len(cells), -np.inf)
        for u, v in itertools.combinations(range(cells.shape[1]), 2):
            value = self._edge(cells[:, u], cells[:, v]).values
            is_later = value > values
            values[is_later] = value[is_later]
            best[is_later] = cells[is_later][:, [u, v]]
        return best

    # ---- the interface of CellValues

    def values(self, dim: int, cells: Integers) -> Numbers:
        i, j = self._longest(cells).T
        return self._births_of(i) if dim == 0 else self._edge(i, j).values

    def deciders(self, dim: int, cells: Integers) -> Integers:
        edges = self._longest(cells)
        if dim > 0 and self._births is not None:
            of_distance, (of_i, of_j) = self._edge(*edges.T)[1:]
            edges = np.where((of_distance == 0)[:, None],
                             np.where(of_i > 0, edges[:, 0], edges[:, 1])[:, None], edges)
        return edges

    def add(self, dim: int, cells: Integers, factors: Numbers) -> None:
        i, j = self._longest(cells).T
        if dim == 0:
            np.add.at(self._of_births, i, factors)
            return
        edge = self._edge(i, j)
        self._distances.add(i, j, factors * edge.of_distance)
        np.add.at(self._of_births, i, factors * edge.of_births[0])
        np.add.at(self._of_births, j, factors * edge.of_births[1])

    def gradient(self) -> Any:
        if self._neighbours is not None:
            self._spread_births()
        return self._distances.gradient(self._of_births if self._has_diagonal else None)


def _met_of_squares(lengths: Numbers, a: Numbers, b: Numbers) -> tuple[Numbers, ...]:
    """The value t at which the balls of radii sqrt(t² - a²) / 2 and sqrt(t² - b²) / 2 meet, and the
    derivatives of t.

    If one ball already contains the other point when that point is born, the balls meet at this
    birth.
    """
    # In a unit of about their size, no square overflows. Powers of 2 cause no rounding.
    largest = np.maximum(lengths, np.maximum(a, b))
    unit = np.ldexp(1.0, np.frexp(np.where(largest > 0, largest, 1))[1] - 1)
    lengths, a, b = lengths / unit, a / unit, b / unit
    meet = 4 * lengths**2 > np.abs(a**2 - b**2)
    d: Numbers = np.where(meet, lengths, 1)
    half_sum, half_difference = (a + b) / 2, (a - b) / 2
    outer, inner = d**2 + half_sum**2, d**2 + half_difference**2
    t = np.where(meet, np.sqrt(outer) * np.sqrt(inner) / d, -np.inf)
    finite: Numbers = np.where(meet, t, 0)
    of_distance: Numbers = finite * (d / outer + d / inner - 1 / d)
    of_sum, of_difference = finite * half_sum / outer / 2, finite * half_difference / inner / 2
    return t * unit, of_distance, of_sum + of_difference, of_sum - of_difference


def _distances_of(X: Any, meta: Mapping[str, Any]) -> Distances:
    metric = meta["metric"]
    if metric == "precomputed":
        return SparseDistances(X) if _arrays.is_sparse(X) else MatrixDistances(X)
    name = METRICS.get(metric)
    if name is None or name == "hamming":
        raise UsageError(f"bars: found metric={metric!r}, expected one that can be differentiated: "
                         "'euclidean', 'manhattan', 'chebyshev', 'minkowski', 'cosine', "
                         "'precomputed'")
    p = {"euclidean": 2.0, "manhattan": 1.0, "chebyshev": math.inf, "cosine": 0.0}.get(name)
    return PointDistances(X, float(meta["minkowski_p"]) if p is None else p)
