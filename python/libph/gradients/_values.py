# SPDX-License-Identifier: MIT
"""Values of cells as functions of the input: pixels, values of vertices."""
from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import _arrays
from .._errors import DataError, UsageError
from .._requests import PointImage

Integers = NDArray[np.int64]
Numbers = NDArray[np.float64]

_ROUNDING = 1e-6  # relative to the largest value; a larger difference means other data


class CellValues:
    """The elements that determine the values of cells, one row per cell, with a gradient
    accumulator."""

    width: int  # length of a row of `deciders`

    def values(self, dim: int, cells: Integers) -> Numbers:
        """The value of each cell."""
        raise NotImplementedError

    def deciders(self, dim: int, cells: Integers) -> Integers:
        """The elements that determine the value of each cell."""
        raise NotImplementedError

    def add(self, dim: int, cells: Integers, factors: Numbers) -> None:
        """Adds the gradients of the values of cells, times factors."""
        raise NotImplementedError

    def gradient(self) -> Any:
        """The sum of all added gradients."""
        raise NotImplementedError

    def compare(self, dim: int, cells: Integers, stated: Numbers, what: str) -> None:
        """Refuses data from which the barcode was not computed."""
        found = self.values(dim, cells)
        largest = max(1e-300, float(np.abs(stated[np.isfinite(stated)]).max(initial=0)))
        wrong = ~((np.abs(found - stated) <= _ROUNDING * largest) | (found == stated))
        if wrong.any():
            i = int(np.argmax(wrong))
            raise DataError(f"X: found the value {found[i]} of the cell {cells[i].tolist()}, "
                            f"expected {stated[i]}, the {what} of its bar; X and weights must "
                            "be the data from which the barcode was computed")


class StarValues(CellValues):
    """A simplex has the value of its last vertex; a cell has its own value."""

    width = 1

    def __init__(self, X: Any, count: int | None) -> None:
        self._values = _arrays.as_values(X, "X", count, "vertex")
        self._gradient = np.zeros(len(self._values))

    def values(self, dim: int, cells: Integers) -> Numbers:
        values: Numbers = self._values[self.deciders(dim, cells)[:, 0]]
        return values

    def deciders(self, dim: int, cells: Integers) -> Integers:
        if cells.max() >= len(self._values):
            raise DataError(f"X: found {len(self._values)} values, expected one for cell "
                            f"{cells.max()}; X must be the data from which the barcode was computed")
        last = np.argmax(self._values[cells], axis=1)
        return np.take_along_axis(cells, last[:, None], axis=1)

    def add(self, dim: int, cells: Integers, factors: Numbers) -> None:
        np.add.at(self._gradient, self.deciders(dim, cells)[:, 0], factors)

    def gradient(self) -> Numbers:
        return self._gradient


class VoxelValues(CellValues):
    """A cube has the value of one of the pixels that it touches."""

    def __init__(self, X: Any, meta: Mapping[str, Any]) -> None:
        image = _arrays.as_array(X.image if isinstance(X, PointImage) else X, "X")
        self._shape = tuple(meta["shape"])
        if image.shape != self._shape:
            raise UsageError(f"X: found an image of shape {image.shape}, expected {self._shape}, as "
                             "stored in the barcode")
        self.width = len(self._shape)
        self._sign = -1.0 if meta["superlevel"] else 1.0
        self._image = image
        self._periodic = meta["periodic"]
        self._are_vertices = meta["construction"] == "vertices"
        self._gradient = np.zeros(self._shape)

    def _levels(self, at: tuple[Integers, ...]) -> Numbers:
        """The values of pixels; a pixel with the value NaN never enters."""
        levels = self._sign * self._image[at].astype(np.float64)
        return np.where(np.isnan(levels), np.inf, levels)

    def values(self, dim: int, cells: Integers) -> Numbers:
        return self._levels(tuple(self.deciders(dim, cells).T))

    def deciders(self, dim: int, cells: Integers) -> Integers:
        """In the V-construction, the largest corner; in the T-construction, the least pixel around
        the cube."""
        ends = []  # for each axis, the two pixels that the cube may touch; -1 for none
        for axis, count in enumerate(self._shape):
            place = cells[:, axis]
            if self._are_vertices:
                low, high = place // 2, (place + 1) // 2
            else:
                low, high = (place - 1) // 2, place // 2
            if axis in self._periodic:
                low, high = low % count, high % count
            ends.append((np.where(low < count, low, -1), np.where(high < count, high, -1)))
        best = np.full((len(cells), self.width), -1, dtype=np.int64)
        sign = 1 if self._are_vertices else -1
        levels = np.full(len(cells), -np.inf)
        for corner in itertools.product(*ends):
            at = np.column_stack(corner)
            exists = (at >= 0).all(axis=1)
            level = np.where(exists, sign * self._levels(tuple(at.T)), -np.inf)
            is_better = exists & ((level > levels) | (best[:, 0] < 0))
            levels[is_better] = level[is_better]
            best[is_better] = at[is_better]
        return best

    def add(self, dim: int, cells: Integers, factors: Numbers) -> None:
        np.add.at(self._gradient, tuple(self.deciders(dim, cells).T), self._sign * factors)

    def gradient(self) -> Numbers:
        return self._gradient
