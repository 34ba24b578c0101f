# SPDX-License-Identifier: MIT
"""Shared code of the drop-ins for Vietoris-Rips filtrations.

A flag filtration is given by distances and by the births of its vertices, which are on the diagonal
of a matrix. Only the entries above the diagonal of a matrix count.

The replaced programs compute in single precision: they round distances first. Here bars are
computed from the exact distances and rounded afterwards. The result is the same, because rounding
is monotone: it maps one filtration, and its barcode, to the other.
"""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import DTypeLike, NDArray

from .. import _arrays, _core, _options, _run
from .._barcodes import Barcode
from .._compute import rips
from .._errors import DataError, UsageError
from .._sources import Source, diagonal_of, sparse_entries, unique_pairs

_STRIP = 512  # rows of a matrix that are processed together
_ROUNDING = 1e-6  # the entries of a pair may differ by this share of the largest distance


class Flag(NamedTuple):
    """A flag filtration, up to a limit beyond which only components count."""

    size: int
    births: NDArray[np.float64] | None  # None: all are 0
    matrix: NDArray[Any] | None  # distances above the diagonal; all numbers are at least 0
    pairs: tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]] | None  # i < j, value
    limit: float
    edges: int  # what ripser.py calls num_edges

    def values(self, u: NDArray[np.int64], v: NDArray[np.int64]) -> NDArray[np.float64]:
        """The distances of pairs u < v; -inf for pairs that are not joined."""
        if self.matrix is not None:
            return np.asarray(self.matrix[u, v], dtype=np.float64)
        assert self.pairs is not None
        i, j, values = self.pairs
        keys, wanted = i * self.size + j, u * self.size + v
        order = np.argsort(keys, kind="stable")
        if not len(order):
            return np.full(u.shape, -np.inf)
        places = order[np.minimum(np.searchsorted(keys, wanted, sorter=order), len(order) - 1)]
        return np.where(keys[places] == wanted, values[places], -np.inf)


class Bars(NamedTuple):
    """The bars of each dimension, in the order of other programs."""

    barcode: Barcode
    dgms: list[NDArray[np.float64]]  # rounded, without bars of length zero
    blocks: list[_core.Block]

    def places(self, dim: int) -> NDArray[np.int64]:
        """The indices of the bars of a dimension in `barcode`."""
        return np.asarray(self.blocks[dim])


# ---- numbers


def precision(dtype: DTypeLike) -> np.dtype[Any]:
    """float32 or float64."""
    try:
        kind = np.dtype(dtype)
    except TypeError:
        kind = np.dtype(object)
    if kind not in (np.float32, np.float64):
        raise _options.refuse("dtype", dtype, "numpy.float32 or numpy.float64")
    return kind


def threshold(value: Any) -> float:
    """The largest distance at which points are joined."""
    return _options.real("thresh", value)


def dimension(value: Any) -> int:
    """The highest dimension of homology; a negative number counts as 0."""
    return max(0, _options.whole("maxdim", value, -2**63))


def last_rounded_to(limit: float, dtype: np.dtype[Any]) -> float:
    """The largest double that is at most `limit` once both are rounded.

    >>> last_rounded_to(1.0, np.dtype(np.float32)) - 1.0 == 2.0 ** -24
    True
    """
    return _core.last_rounded_to(limit) if dtype == np.float32 else limit


def ordered(dgm: NDArray[np.float64], dim: int) -> NDArray[np.int64]:
    """The order of Ripser: H0 by death; others by descending birth, then descending death."""
    births, deaths = dgm.T
    return np.asarray(np.lexsort((births, deaths) if dim == 0 else (-deaths, -births)))


# ---- filtrations of matrices


def of_dense(matrix: Any, limit: float, dtype: np.dtype[Any], is_symmetric: bool,
             births: NDArray[np.float64] | None = None) -> Flag:
    """The filtration of a matrix.

    Parameters
    ----------
    matrix : array_like
        Distances above the diagonal.
    limit : float
        The largest distance at which points are joined.
    is_symmetric : bool
        True if the entries below the diagonal must be the same.
    births : ndarray, optional
        Births of the vertices. Default: the diagonal.
    """
    array = _arrays.as_distances(matrix, "X")
    if array.ndim != 2:
        raise UsageError(f"X: found an array of shape {array.shape}, expected a square matrix")
    wrong, i, j, has_births, is_plain, limit, edges = _run.run(
        _core.flag_facts, array, births, limit, dtype == np.float32, is_symmetric, options={})
    if wrong == "birth":
        raise DataError(f"X: the diagonal: entry {i}: found nan, expected a number")
    if wrong == "nan":
        raise DataError(f"X: row {i}, column {j}: found nan, expected a number")
    if wrong == "unequal":
        raise DataError(f"X: row {i}, column {j}: found {array[i, j]}, but {array[j, i]} in row "
                        f"{j}, column {i}; expected both equal")
    n = len(array)
    if is_plain and not has_births:
        return Flag(n, None, array, None, limit, edges)
    if births is None:
        births = np.array(np.diagonal(array), dtype=np.float64)
    if is_plain:
        return Flag(n, births, array, None, limit, edges)
    u, v = (np.concatenate(parts) for parts in zip(*_joined(array, limit)))
    values = np.asarray(array[u, v], dtype=np.float64)
    return Flag(n, births, None, (u, v, values), limit, edges)


def of_sparse(matrix: Any, limit: float, size: int, upper_wins: bool,
              births: NDArray[np.float64] | None = None) -> Flag:
    """The filtration of a sparse matrix: stored pairs are joined, including stored zeros.

    Both triangles are read. If a pair has two entries, the upper one counts; with `upper_wins` they
    may differ.
    """
    row, column, values = sparse_entries(matrix)
    missing = np.isnan(values)
    if missing.any():
        k = int(np.argmax(missing))
        raise DataError(f"X: row {row[k]}, column {column[k]}: found nan, expected a number")
    on_diagonal = row == column
    if births is None:
        births = diagonal_of(size, row[on_diagonal], values[on_diagonal], _rounding_of(values),
                             None, "")
    return of_pairs(row[~on_diagonal], column[~on_diagonal], values[~on_diagonal], limit, births,
                    upper_wins)


def of_pairs(row: NDArray[np.int64], column: NDArray[np.int64], values: NDArray[np.float64],
             limit: float, births: NDArray[np.float64], upper_wins: bool) -> Flag:
    """The filtration of some pairs."""
    # `unique_pairs` prefers entries below the diagonal, hence the transpose.
    i, j, values = unique_pairs(column, row, values, _rounding_of(values),
                                "lower" if upper_wins else None, "")
    keep = values <= limit
    edges = int(np.count_nonzero(keep))
    keep &= values < np.inf
    return Flag(len(births), births, None, (i[keep], j[keep], values[keep]), limit, edges)


def _rounding_of(values: NDArray[np.float64]) -> float:
    return _ROUNDING * float(np.abs(values[np.isfinite(values)]).max(initial=0.0))


def _joined(array: NDArray[Any], limit: float) -> Any:
    """Rows and columns of the pairs that are joined, some rows at a time."""
    yield np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    for begin in range(0, len(array), _STRIP):
        rows = array[begin:begin + _STRIP]
        i, j = np.nonzero((rows <= limit) & (rows < np.inf))
        above = j > i + begin
        yield i[above] + begin, j[above]


# ---- bars


def compute(flag: Flag, max_dim: int, dtype: np.dtype[Any], essential_last: bool,
            **options: Any) -> Bars:
    """The bars of a filtration, without bars of length zero."""
    levels = None
    births, limit = flag.births, flag.limit
    if flag.matrix is not None:
        # The transpose of the array, because the part below its diagonal is read.
        space = _core.MetricSpace.of_distances(flag.matrix.T, "lower", "error", False)
    else:
        assert births is not None and flag.pairs is not None
        i, j, values = flag.pairs
        if min(values.min(initial=0.0), births.min(initial=0.0)) < 0 or np.isinf(births).any():
            # libph has no negative distances and no births at inf. Bars depend only on the order of
            # values, so their ranks serve as values.
            levels, ranks = np.unique(np.concatenate([births, values]), return_inverse=True)
            births, values = np.split(ranks.astype(np.float64), [len(births)])
        limit = np.inf
        space = _core.MetricSpace.of_pairs(flag.size, i, j, np.ascontiguousarray(values))
    source = Source(space, flag.size, None, births if births is not None and births.any() else None)
    barcode = rips(source, max_dim=max_dim, threshold=None if limit == np.inf else limit, **options)
    return bars_of(barcode, max_dim, dtype, essential_last, levels)


def bars_of(barcode: Barcode, max_dim: int, dtype: np.dtype[Any], essential_last: bool = False,
            levels: NDArray[np.float64] | None = None) -> Bars:
    """A barcode, rounded and in the order of `ordered`; ranks are mapped back to `levels`. With
    `essential_last`, bars above H0 that never die follow the others."""
    found = _core.ripser_dgms(barcode._bars, max_dim, dtype == np.float32, essential_last, levels)
    return Bars(barcode, [np.asarray(dgm) for dgm, _ in found], [places for _, places in found])


def youngest_edges(values_of: Any, simplices: NDArray[np.int64]) -> NDArray[np.int64]:
    """For each simplex, the edge with the largest value, its larger vertex first. Among equal
    edges, it is the one with the smallest larger vertex, then with the smallest smaller vertex.
    Vertices stay as they are.

    `values_of` returns the values of pairs u < v.
    """
    count, vertices = simplices.shape
    if vertices == 1:
        return simplices
    if not count:
        return np.empty((0, 2), dtype=np.int64)
    pairs = np.array([(a, b) for b in range(vertices) for a in range(b)])
    values = values_of(simplices[:, pairs[:, 0]], simplices[:, pairs[:, 1]])
    chosen = pairs[np.argmax(values, axis=1)]
    return np.take_along_axis(simplices, chosen[:, ::-1], axis=1)
