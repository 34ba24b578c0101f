# SPDX-License-Identifier: MIT
"""giotto-ph's functions for edge collapse, over `libph.collapse`."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .... import _arrays
from ...._points import collapse

__all__ = ["flag_complex_collapse_edges_coo", "flag_complex_collapse_edges_dense"]

Edges = tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float32]]


def flag_complex_collapse_edges_coo(row: ArrayLike, column: ArrayLike, data: ArrayLike,
                                    thresh: float = np.inf) -> Edges:
    """Fewer edges with the same bars, of the edges above the diagonal.

    Parameters
    ----------
    row, column, data : array_like
        The ends of edges, and their values.
    thresh : float
        The largest value that is kept.

    Returns
    -------
    tuple of ndarray
        Rows, columns and values, by row and column.
    """
    from scipy.sparse import coo_matrix
    i, j = _arrays.as_integers(row, "row"), _arrays.as_integers(column, "column")
    values = _arrays.as_values(data, "data", len(i), "edge")
    keep = (i < j) & (values <= thresh) & (values < np.inf)
    n = int(j[keep].max(initial=-1)) + 1
    found = collapse(coo_matrix((values[keep], (i[keep], j[keep])), shape=(n, n)))
    order = np.lexsort((found.col, found.row))
    return (found.row[order].astype(np.int32), found.col[order].astype(np.int32),
            found.data[order].astype(np.float32))


def flag_complex_collapse_edges_dense(dm: ArrayLike, thresh: float = np.inf) -> Edges:
    """The same of a matrix: of its entries above the diagonal.

    Parameters
    ----------
    dm : array_like
        A square matrix of values.
    thresh : float
        The largest value that is kept.

    Returns
    -------
    tuple of ndarray
        Rows, columns and values, by row and column.
    """
    matrix: Any = _arrays.as_distances(dm, "dm")
    i, j = np.triu_indices(len(matrix), 1)
    return flag_complex_collapse_edges_coo(i, j, matrix[i, j], thresh)
