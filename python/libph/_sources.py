# SPDX-License-Identifier: MIT
"""Sources of distances: points, matrices, functions, with the options that each one accepts."""
from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _core, _options
from ._errors import DataError, UsageError

METRICS = {"euclidean": "euclidean", "manhattan": "manhattan", "chebyshev": "chebyshev",
           "minkowski": "minkowski", "cosine": "cosine", "hamming": "hamming",
           "l2": "euclidean", "l1": "manhattan", "cityblock": "manhattan"}
_ACCEPTED = "; symmetrise='max', 'min' or 'lower' accepts it"
_ROUNDING = 1e-6  # relative to the largest distance, as in the readers of files
_BYTES_PER_ENTRY = 88  # the most that an entry of a sparse matrix takes while it is converted


class Source(NamedTuple):
    """Distances, and other facts found in the data."""

    space: _core.MetricSpace
    points: int
    coordinates: int | None = None            # of points
    births: NDArray[np.float64] | None = None  # births, from the diagonal
    ids: NDArray[np.int64] | None = None       # numbers of the points that are left


def source_of(X: Any, *, metric: Any = "euclidean", minkowski_p: Any = 2.0, nan: Any = "error",
              diagonal: Any = "zero", symmetrise: Any = None,
              has_nan_option: bool = True) -> Source:
    """Makes a metric space from the user's data; a Source is returned unchanged.

    For a function without an option `nan`, messages do not name this option. A sparse matrix is
    refused if its conversion could take more than the memory limit.
    """
    if isinstance(X, Source):
        return X
    _options.choice("nan", nan, ["error", "drop"])
    _options.choice("diagonal", diagonal, ["zero", "births", "any"])
    _options.choice("symmetrise", symmetrise, [None, "max", "min", "lower"])
    if not has_nan_option:
        nan = None
    name = metric_name(metric)
    p = _options.real("minkowski_p", minkowski_p, "a number, at least 1", least=1)
    if p != 2 and name != "minkowski":
        found = "a function as metric" if name == "function" else f"metric='{metric}'"
        raise UsageError(f"minkowski_p: does nothing for {found}, expected metric='minkowski'")
    if name == "precomputed":
        if _arrays.is_sparse(X):
            return _of_sparse(X, nan, diagonal, symmetrise)
        return _of_matrix(X, nan, diagonal, symmetrise)
    if diagonal != "zero" or symmetrise is not None:
        option = "diagonal" if diagonal != "zero" else "symmetrise"
        what = "a function as metric" if name == "function" else "points"
        raise UsageError(f"{option}: does nothing for {what}; metric='precomputed' reads distances")
    return _of_function(X, metric, nan) if name == "function" else _of_points(X, name, p, nan)


def metric_name(metric: Any) -> str:
    """The first name of a metric; "function" for a user's own function."""
    if callable(metric):
        return "function"
    name = None
    if isinstance(metric, str):
        name = metric if metric == "precomputed" else METRICS.get(metric)
    if name is None:
        raise _options.refuse("metric", metric, ", ".join(METRICS) + ", 'precomputed' or a function "
                              "of two points; scipy.spatial.distance.pdist has more metrics: its distances "
                              "are accepted with metric='precomputed'")
    return name


def _of_points(X: Any, name: str, p: float, nan: str | None) -> Source:
    if _arrays.is_sparse(X):
        raise UsageError("X: found a sparse matrix; metric='precomputed' reads its entries as "
                         "distances, .toarray() makes points of it")
    points = _arrays.as_points(X)
    _warn_of_a_matrix(points)
    count, ids = len(points), None
    if nan == "drop":
        whole = ~np.isnan(points).any(axis=1)
        if not whole.all():
            ids = np.flatnonzero(whole)
            points = points[whole]
    space = _core.MetricSpace.of_points(points, name, p)
    return Source(space, count, points.shape[1], None, ids)


def _of_matrix(X: Any, nan: str | None, diagonal: str, symmetrise: str | None) -> Source:
    array = _arrays.as_distances(X)
    births = None
    if diagonal == "zero" and _is_correlation(array):
        raise DataError("X: found 1 on the whole diagonal and nothing larger, as in correlations, "
                        "expected distances, with 0 there; 1 - X are distances; diagonal='births' "
                        "treats the diagonal as births of the points, diagonal='any' as 0")
    if array.ndim == 1 and (diagonal == "births" or symmetrise is not None):
        name = "diagonal" if diagonal == "births" else "symmetrise"
        raise UsageError(f"{name}: does nothing for condensed distances, expected a square matrix")
    if diagonal == "births":
        births = np.array(np.diagonal(array), dtype=np.float64)
    space = _core.MetricSpace.of_distances(
        array, symmetrise or "none", nan or "error", diagonal == "zero", nan is not None)
    return Source(space, space.size, None, births)


def _is_correlation(array: NDArray[Any]) -> bool:
    if array.ndim != 2 or len(array) < 2 or not _are_near(np.diagonal(array), 1, _ROUNDING):
        return False
    with np.errstate(invalid="ignore"):
        return not (np.abs(array) > 1 + _ROUNDING).any()  # NaN is allowed here


def _are_near(numbers: NDArray[Any], number: Any, rounding: float) -> bool:
    with np.errstate(invalid="ignore"):
        return bool((np.abs(numbers - number) <= rounding).all())


def _warn_of_a_matrix(points: NDArray[np.float64]) -> None:
    """Warns of an array of points that may be a matrix: a symmetric array with 0 or 1 on its
    diagonal is unlikely to hold points, except for the corners of a regular simplex, whose
    coordinates take two values."""
    rows, columns = points.shape
    if rows != columns or rows < 4:
        return
    diagonal, rounding = np.diagonal(points), _ROUNDING * float(np.abs(points).max())
    is_zero = _are_near(diagonal, 0, rounding)
    if not (is_zero and points.min() >= 0) and not _is_correlation(points):
        return
    if not _are_near(points, points.T, rounding) or np.count_nonzero(
            points == points[0, 1]) >= rows * (rows - 1):
        return
    number, what, distances = ("0", "distances", "X") if is_zero else ("1", "correlations", "1 - X")
    warnings.warn(f"X: read as {rows} points of R^{rows}; the array is symmetric, with {number} "
                  f"on its diagonal, as {what} are; metric='precomputed' takes {distances} as "
                  "distances", UserWarning, stacklevel=_options.user_level())


def sparse_entries(matrix: Any, name: str = "X"
                   ) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """Row, column and value of each entry that a sparse matrix stores, as in `coordinates`."""
    coo = coordinates(matrix, name)
    return (coo.row.astype(np.int64), coo.col.astype(np.int64), _arrays.as_float64(coo.data, name))


def coordinates(matrix: Any, name: str, copy: bool = False) -> Any:
    """The matrix in COO format, with the zeros that it stores as entries.

    Raises
    ------
    DataError
        If entries are not real numbers, or if a BSR or DIA matrix has a zero off its main diagonal:
        such a zero may be an entry, or fill a block or a diagonal.
    """
    coo = matrix.tocoo(copy=copy)
    if coo.data.dtype.kind not in "biuf":
        raise DataError(f"{name}: found entries of type {coo.data.dtype}, expected real numbers")
    kind = getattr(matrix, "format", None)
    if kind == "bsr":
        place = _zero_of_blocks(coo)
        what, way_out = "blocks", (".tocsr() reads such zeros as entries; .eliminate_zeros() after "
                                   "it removes them")
    else:
        place = _zero_of_diagonals(matrix) if kind == "dia" else None
        what, way_out = "diagonals", (".tocsr() removes such zeros; a CSR matrix made from rows, "
                                      "columns and values can store them as entries")
    if place is not None:
        raise DataError(f"{name}: {_arrays.place_of(place)}: found 0 in a matrix of format {kind}, "
                        f"which fills its {what} with zeros, expected none off the main diagonal; "
                        f"{way_out}")
    return coo


def _zero_of_blocks(coo: Any) -> tuple[int, int] | None:
    zeros = np.flatnonzero((coo.data == 0) & (coo.row != coo.col))
    return (int(coo.row[zeros[0]]), int(coo.col[zeros[0]])) if len(zeros) else None


def _zero_of_diagonals(matrix: Any) -> tuple[int, int] | None:
    rows, columns = matrix.shape
    for offset, diagonal in zip(matrix.offsets.tolist(), matrix.data):
        first, end = max(0, offset), max(0, min(columns, rows + offset))
        zeros = np.flatnonzero(diagonal[first:end] == 0)
        if offset and len(zeros):
            column = first + int(zeros[0])
            return column - offset, column
    return None


def _of_sparse(X: Any, nan: str | None, diagonal: str, symmetrise: str | None) -> Source:
    """Reads both triangles. Stored zeros are distances; pairs that are not stored are never
    joined."""
    if len(X.shape) != 2 or X.shape[0] != X.shape[1]:
        raise UsageError(f"X: found a sparse matrix of shape {X.shape}, expected a square one")
    _arrays.require_room(_BYTES_PER_ENTRY * X.nnz,
                         f"the conversion of the {X.nnz} entries of X may take")
    # Indices keep their type, which is int32 in most matrices, until the pairs are unique.
    coo = coordinates(X, "X")
    row, column, values = coo.row, coo.col, _arrays.as_float64(coo.data, "X")
    del coo  # each array goes as soon as it is replaced
    missing = np.isnan(values)
    if missing.any():
        if nan != "drop":
            _fail(row, column, values, missing,
                  "0 or more" + ("" if nan is None else "; nan='drop' never joins such a pair"))
        row, column, values = row[~missing], column[~missing], values[~missing]
    rounding = _ROUNDING * float(np.max(values, where=np.isfinite(values), initial=0.0))

    births = None
    on_diagonal = row == column
    if on_diagonal.any():
        if diagonal == "births":
            births = diagonal_of(X.shape[0], row[on_diagonal], values[on_diagonal], rounding,
                                 symmetrise, _ACCEPTED)
        elif diagonal == "zero":
            wrong = on_diagonal & (np.abs(values) > rounding)
            if wrong.any():
                _fail(row, column, values, wrong, "0 on the diagonal; diagonal='births' treats it "
                      "as the birth of the point, diagonal='any' as 0")
    keep = ~on_diagonal & (values != np.inf)
    if not keep.all():
        row = row[keep]
        column = column[keep]
        values = values[keep]
    if (values < -rounding).any():
        _fail(row, column, values, values < -rounding, "0 or more")
    if (values < 0).any():
        values = np.maximum(values, 0)
    i, j, values = unique_pairs(row, column, values, rounding, symmetrise, _ACCEPTED)
    space = _core.MetricSpace.of_pairs(X.shape[0], i.astype(np.int64), j.astype(np.int64), values)
    return Source(space, X.shape[0], None, births)


def unique_pairs(row: NDArray[Any], column: NDArray[Any], values: NDArray[np.float64],
                 rounding: float, symmetrise: str | None, hint: str, name: str = "X"
                 ) -> tuple[NDArray[Any], NDArray[Any], NDArray[np.float64]]:
    """Each pair once. Entries of one pair must be equal; if they differ by rounding, the entry
    below the diagonal is used."""
    i, j = np.minimum(row, column), np.maximum(row, column)
    order = np.lexsort((row > column, j, i))
    i, j, values = i[order], j[order], values[order]
    is_first = np.ones(len(i), dtype=bool)
    is_first[1:] = (i[1:] != i[:-1]) | (j[1:] != j[:-1])
    starts = np.flatnonzero(is_first)
    if len(starts) == len(i):
        return i, j, values
    largest, least = (np.maximum.reduceat(values, starts), np.minimum.reduceat(values, starts))
    with np.errstate(invalid="ignore"):  # the difference of two infinite entries is NaN
        differ = largest - least > rounding
    if symmetrise is None and differ.any():
        k = int(np.argmax(differ))
        place = i[starts[k]], j[starts[k]]
        mirror = "" if place[0] == place[1] else " and its mirror image"
        raise DataError(f"{name}: {_arrays.place_of(place)}{mirror}: found {least[k]} and "
                        f"{largest[k]}, expected equal values{hint}")
    lower = values[np.append(starts[1:], len(i)) - 1]
    chosen = {"max": largest, "min": least}.get(symmetrise or "lower", lower)
    return i[starts], j[starts], chosen


def diagonal_of(size: int, places: NDArray[Any], values: NDArray[np.float64], rounding: float,
                symmetrise: str | None, hint: str) -> NDArray[np.float64]:
    """The diagonal of a sparse matrix, 0 where nothing is stored. Entries that are stored twice are
    treated like the two entries of a pair."""
    i, _, values = unique_pairs(places, places, values, rounding, symmetrise, hint)
    diagonal = np.zeros(size)
    diagonal[i] = values
    return diagonal


def _fail(row: NDArray[Any], column: NDArray[Any], values: NDArray[np.float64],
          wrong: NDArray[np.bool_], expected: str) -> None:
    k = int(np.argmax(wrong))
    raise DataError(f"X: row {row[k]}, column {column[k]}: found {values[k]}, expected {expected}")


def _of_function(X: Any, metric: Callable[[Any, Any], float], nan: str | None) -> Source:
    """The distances between any objects; the metric is called once per pair."""
    things = X if isinstance(X, (list, tuple)) else _arrays.as_array(X, "X")
    if not isinstance(things, (list, tuple)) and things.ndim == 0:
        raise UsageError("X: found one number, expected points")
    n = len(things)
    distances = np.empty(n * (n - 1) // 2)
    place = 0
    for i in range(n):
        for j in range(i + 1, n):
            distance = metric(things[i], things[j])
            try:
                distances[place] = distance
            except (TypeError, ValueError):
                raise DataError(f"metric of points {i} and {j}: found {type(distance).__name__}, "
                                "expected a number") from None
            place += 1
    if n == 0:
        distances = np.empty((0, 0))  # an empty array is the condensed form of one point
    space = _core.MetricSpace.of_distances(distances, "none", nan or "error", True,
                                           nan is not None)
    return Source(space, n)
