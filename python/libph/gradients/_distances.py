# SPDX-License-Identifier: MIT
"""Distances from points or matrices, and the propagation of their derivatives."""
from __future__ import annotations

import math
from typing import Any

import numpy as np

from .. import _arrays, _sources
from .._errors import DataError, UsageError
from ._values import Integers, Numbers


class Distances:
    """Distances with a gradient accumulator."""

    size: int

    def between(self, i: Integers, j: Integers) -> Numbers:
        """The distance of each pair."""
        raise NotImplementedError

    def rows(self, i: Integers) -> Numbers:
        """The distances from some points to all points."""
        raise NotImplementedError

    def add(self, i: Integers, j: Integers, factors: Numbers) -> None:
        """Adds the gradients of the distances of pairs, times factors."""
        raise NotImplementedError

    def diagonal(self) -> Numbers | None:
        """The diagonal of a matrix."""
        return None

    def gradient(self, on_diagonal: Numbers | None) -> Any:
        """The sum of all added gradients, plus the contribution of the diagonal."""
        raise NotImplementedError


class PointDistances(Distances):
    """Distances of points. `p` is the Minkowski exponent; 0 stands for one minus the cosine of the
    angle."""

    def __init__(self, X: Any, p: float) -> None:
        self._X = _arrays.as_points(X)
        self._p = p
        self.size = len(self._X)
        self._gradient = np.zeros(self._X.shape)

    def between(self, i: Integers, j: Integers) -> Numbers:
        return self._lengths(self._X[i], self._X[j])

    def rows(self, i: Integers) -> Numbers:
        return np.stack([self._lengths(self._X[k], self._X) for k in i.tolist()])

    def _lengths(self, x: Numbers, y: Numbers) -> Numbers:
        if self._p == 0:
            # Equals 1 - cos, but keeps its digits for small angles.
            squares: Numbers = ((_unit(x)[0] - _unit(y)[0])**2).sum(axis=-1)
            return squares / 2
        return _norm(x - y, self._p)

    def add(self, i: Integers, j: Integers, factors: Numbers) -> None:
        i, j, factors = i[factors != 0], j[factors != 0], factors[factors != 0]
        if self._p == 0:
            (x, x_length), (y, y_length) = _unit(self._X[i]), _unit(self._X[j])
            between = x - y
            value = (between**2).sum(axis=1, keepdims=True) / 2
            np.add.at(self._gradient, i, factors[:, None] * (between - value * x) / x_length)
            np.add.at(self._gradient, j, -factors[:, None] * (between + value * y) / y_length)
            return
        step = factors[:, None] * _gradient_of_norm(self._X[i] - self._X[j], self._p)
        np.add.at(self._gradient, i, step)
        np.add.at(self._gradient, j, -step)

    def gradient(self, on_diagonal: Numbers | None) -> Any:
        return self._gradient


def _unit(x: Numbers) -> tuple[Numbers, Numbers]:
    length = _norm(x, 2)[..., None]
    with np.errstate(invalid="ignore"):
        return x / length, length


def _norm(x: Numbers, p: float) -> Numbers:
    size = np.abs(x)
    largest: Numbers = size.max(axis=-1, initial=0)
    if p == math.inf:
        return largest
    # Powers of numbers up to 1 do not overflow.
    share = size / np.where(largest > 0, largest, 1)[..., None]
    lengths: Numbers = (share**p).sum(axis=-1)**(1 / p)
    return largest * lengths


def _gradient_of_norm(x: Numbers, p: float) -> Numbers:
    """The gradient of the norm; 0 for the zero vector."""
    if p == math.inf:
        first = np.argmax(np.abs(x), axis=1)[:, None]
        gradient: Numbers = np.zeros_like(x)
        np.put_along_axis(gradient, first, np.sign(np.take_along_axis(x, first, axis=1)), axis=1)
        return gradient
    length = _norm(x, p)[:, None]
    gradient = np.sign(x) * (np.abs(x) / np.where(length > 0, length, 1))**(p - 1)
    return gradient


class MatrixDistances(Distances):
    """Distances of a square or condensed matrix."""

    def __init__(self, X: Any) -> None:
        self._X = _arrays.as_distances(X)
        self._is_square = self._X.ndim == 2
        self.size = len(self._X) if self._is_square else \
            round((1 + math.sqrt(1 + 8 * len(self._X))) / 2)
        self._gradient = np.zeros(self._X.shape)

    def _place(self, i: Integers, j: Integers) -> Integers:
        """Index in the condensed form."""
        low, high = np.minimum(i, j), np.maximum(i, j)
        place: Integers = low * (2 * self.size - low - 1) // 2 + high - low - 1
        return place

    def between(self, i: Integers, j: Integers) -> Numbers:
        if self._is_square:
            both: Numbers = self._X[i, j].astype(np.float64) + self._X[j, i]
            return both / 2
        return np.asarray(self._X[self._place(i, j)], dtype=np.float64)

    def rows(self, i: Integers) -> Numbers:
        if self._is_square:
            rows: Numbers = (self._X[i].astype(np.float64) + self._X[:, i].T) / 2
        else:
            others = np.broadcast_to(np.arange(self.size), (len(i), self.size))
            at = np.where(others == i[:, None], 0, self._place(i[:, None], others))
            rows = self._X[at].astype(np.float64)
        rows[np.arange(len(i)), i] = 0
        return rows

    def add(self, i: Integers, j: Integers, factors: Numbers) -> None:
        i, j, factors = i[i != j], j[i != j], factors[i != j]
        if self._is_square:
            np.add.at(self._gradient, (i, j), factors / 2)
            np.add.at(self._gradient, (j, i), factors / 2)
        else:
            np.add.at(self._gradient, self._place(i, j), factors)

    def diagonal(self) -> Numbers | None:
        return np.array(np.diagonal(self._X), dtype=np.float64) if self._is_square else None

    def gradient(self, on_diagonal: Numbers | None) -> Any:
        if on_diagonal is not None:
            np.fill_diagonal(self._gradient, on_diagonal)
        return self._gradient


class SparseDistances(Distances):
    """Distances of a sparse matrix: each stored entry is a variable."""

    def __init__(self, X: Any) -> None:
        coo = _sources.coordinates(X, "X", copy=True)
        self._coo, self.size = coo, coo.shape[0]
        row, column = coo.row.astype(np.int64), coo.col.astype(np.int64)
        key = np.minimum(row, column) * self.size + np.maximum(row, column)
        self._keys, self._first, self._pair_of, self._stored = np.unique(
            key, return_index=True, return_inverse=True, return_counts=True)
        self._values = np.bincount(self._pair_of, weights=coo.data.astype(np.float64),
                                   minlength=len(self._keys)) / self._stored
        self._gradient = np.zeros(len(self._keys))

    def _find(self, i: Integers, j: Integers) -> tuple[Integers, Any]:
        key = np.minimum(i, j) * self.size + np.maximum(i, j)
        at = np.minimum(np.searchsorted(self._keys, key), max(0, len(self._keys) - 1))
        return at, self._keys[at] == key if len(self._keys) else np.zeros(len(key), dtype=bool)

    def between(self, i: Integers, j: Integers) -> Numbers:
        at, is_stored = self._find(i, j)
        if not is_stored.all():
            k = int(np.argmin(is_stored))
            raise DataError(f"X: row {i[k]}, column {j[k]}: found no entry, expected one; X must be "
                            "the data from which the barcode was computed")
        return self._values[at]

    def rows(self, i: Integers) -> Numbers:
        raise UsageError("X: found only some of the distances (a sparse matrix), expected all")

    def add(self, i: Integers, j: Integers, factors: Numbers) -> None:
        np.add.at(self._gradient, self._find(i, j)[0], factors)

    def diagonal(self) -> Numbers | None:
        values = np.zeros(self.size)
        is_stored = self._keys // self.size == self._keys % self.size
        values[self._keys[is_stored] % self.size] = self._values[is_stored]
        return values

    def gradient(self, on_diagonal: Numbers | None) -> Any:
        entries = self._gradient[self._pair_of] / self._stored[self._pair_of]
        if on_diagonal is not None:
            is_diagonal = self._coo.row == self._coo.col
            entries[is_diagonal] = on_diagonal[self._coo.row[is_diagonal]]
        return type(self._coo)((entries, (self._coo.row, self._coo.col)), shape=self._coo.shape)
