# SPDX-License-Identifier: MIT
"""giotto-ph's functions for edge collapse, based on `libph.collapse`."""
from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .... import _arrays
from ...._errors import DataError, UsageError
from ...._points import collapse
from ... import _flag

__all__ = ["flag_complex_collapse_edges_coo", "flag_complex_collapse_edges_dense"]

Edges = tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float32]]


def flag_complex_collapse_edges_coo(row: ArrayLike, column: ArrayLike, data: ArrayLike,
                                    thresh: float = np.inf) -> Edges:
    """Collapses the edges above the diagonal; the edges that are left have the same bars.

    Parameters
    ----------
    row, column, data : array_like
        The two ends and the values of the edges.
    thresh : float
        The largest value to keep.

    Returns
    -------
    tuple of ndarray
        Rows, columns and values, sorted by row, then by column.
    """
    from scipy.sparse import coo_matrix
    i, j = _arrays.as_integers(row, "row"), _arrays.as_integers(column, "column")
    values = _arrays.as_values(data, "data", len(i), "edge")
    missing = np.isnan(values) & (i < j)
    if missing.any():
        raise DataError(f"data: entry {int(np.argmax(missing))}: found nan, expected a number")
    keep = (i < j) & (values <= _flag.threshold(thresh)) & (values < np.inf)
    n = int(j[keep].max(initial=-1)) + 1
    found = collapse(coo_matrix((values[keep], (i[keep], j[keep])), shape=(n, n)))
    order = np.lexsort((found.col, found.row))
    return (found.row[order].astype(np.int32), found.col[order].astype(np.int32),
            found.data[order].astype(np.float32))


def flag_complex_collapse_edges_dense(dm: ArrayLike, thresh: float = np.inf) -> Edges:
    """The same for the entries above the diagonal of a matrix.

    Parameters
    ----------
    dm : array_like
        A square matrix of values.
    thresh : float
        The largest value to keep.

    Returns
    -------
    tuple of ndarray
        Rows, columns and values, sorted by row, then by column.
    """
    matrix = _arrays.as_distances(dm, "dm")
    if matrix.ndim != 2:
        raise UsageError(f"dm: found an array of shape {matrix.shape}, expected a square matrix; "
                         "scipy.spatial.distance.squareform makes one of condensed distances")
    missing = np.isnan(np.triu(matrix, 1))
    if missing.any():
        place = tuple(int(k) for k in np.argwhere(missing)[0])
        raise DataError(f"dm: {_arrays.place_of(place)}: found nan, expected a number")
    i, j = np.triu_indices(len(matrix), 1)
    return flag_complex_collapse_edges_coo(i, j, matrix[i, j], thresh)
