# SPDX-License-Identifier: MIT
"""Lists of simplices, as arrays by dimension or as tuples of vertices."""
from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _run
from ._errors import DataError, UsageError


class SimplexList(NamedTuple):
    """Simplex i has the vertices ``vertices[offsets[i]:offsets[i + 1]]``."""

    vertices: NDArray[np.int64]
    offsets: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.offsets) - 1


def simplex_list(simplices: Any, name: str = "simplices") -> SimplexList:
    """Accepts an array with one simplex per row, a list of such arrays, or a list of vertex
    tuples. A list is refused if its conversion could take more than the memory limit."""
    if isinstance(simplices, SimplexList):
        return simplices
    if isinstance(simplices, (str, bytes, dict)) or not isinstance(simplices, Iterable) or (
            _arrays.is_graph(simplices)):
        from . import _hints
        raise UsageError(f"{name}: found {type(simplices).__name__}, expected an array with a "
                         "simplex per row, a list of such arrays, or a list of tuples of vertices"
                         + _hints.of_object(simplices))
    if hasattr(simplices, "__array__"):
        _require_room([simplices], name)
        return _joined([_of_array(simplices, name)])
    items = list(simplices)
    _require_room(items, name)
    if items and all(getattr(item, "ndim", 0) == 2 for item in items):
        return _joined([_of_array(item, f"{name}[{k}]") for k, item in enumerate(items)])
    return _of_tuples(items, name)


def _require_room(items: list[Any], name: str) -> None:
    """`items` are arrays, or tuples of vertices. The list, its copy in the library and the values
    of the simplices take at most 24 bytes per vertex and 40 bytes per simplex."""
    if _run.memory_limit({}) is None:
        return
    rows = [np.shape(item) if hasattr(item, "__array__") else
            (1, len(item) if hasattr(item, "__len__") else 1) for item in items]
    count = sum(shape[0] if shape else 1 for shape in rows)
    vertices = sum(int(np.prod(shape)) for shape in rows)
    _arrays.require_room(24 * vertices + 40 * count,
                         f"the conversion of the {count} {name} may take")


def _of_array(array: Any, name: str) -> SimplexList:
    rows = _arrays.as_integers(array, name)
    if rows.ndim == 1 and rows.size == 0:
        rows = rows.reshape(0, 1)
    if rows.ndim != 2 or rows.shape[1] == 0:
        raise UsageError(f"{name}: found an array of shape {rows.shape}, expected (simplices, "
                         "vertices of each)")
    return SimplexList(rows.ravel(), np.arange(0, rows.size + 1, rows.shape[1], dtype=np.int64))


def _of_tuples(items: list[Any], name: str) -> SimplexList:
    vertices: list[Any] = []
    offsets = [0]
    for i, simplex in enumerate(items):
        try:
            if isinstance(simplex, (str, bytes)):
                raise TypeError
            vertices.extend(simplex)
        except TypeError:
            raise DataError(f"{name}: simplex {i}: found {type(simplex).__name__}, expected a tuple "
                            "of vertices") from None
        if len(vertices) == offsets[-1]:
            raise DataError(f"{name}: simplex {i}: found no vertices")
        offsets.append(len(vertices))
    try:
        numbers = _arrays.as_integers(vertices, name) if vertices else np.empty(0, dtype=np.int64)
    except (DataError, UsageError):
        for i in range(len(items)):  # its index in the list
            _arrays.as_integers(vertices[offsets[i]:offsets[i + 1]], f"{name}: simplex {i}")
        raise
    if numbers.ndim != 1:
        raise DataError(f"{name}: found nested vertices, expected whole numbers")
    return SimplexList(numbers, np.array(offsets, dtype=np.int64))


def _joined(parts: list[SimplexList]) -> SimplexList:
    if len(parts) == 1:
        return parts[0]
    ends = np.cumsum([0] + [len(part.vertices) for part in parts])
    offsets = [part.offsets[1:] + begin for part, begin in zip(parts, ends)]
    return SimplexList(np.concatenate([part.vertices for part in parts]),
                       np.concatenate([np.zeros(1, dtype=np.int64), *offsets]))


def joined_values(values: Any, count: int, name: str = "values") -> NDArray[np.float64]:
    """A number for each simplex: from one array, or from an array for each array of simplices."""
    if isinstance(values, (list, tuple)) and values and all(
            getattr(item, "ndim", 0) == 1 for item in values):
        values = np.concatenate([_arrays.as_values(item, f"{name}[{k}]")
                                 for k, item in enumerate(values)])
    return _arrays.as_values(values, name, count, "simplex")
