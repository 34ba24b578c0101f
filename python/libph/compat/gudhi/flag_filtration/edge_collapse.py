# SPDX-License-Identifier: MIT
"""GUDHI's function for edge collapse, based on `libph.collapse`."""
from __future__ import annotations

from typing import Any

import numpy as np

from .... import _arrays, _options
from ...._errors import DataError
from ...._points import collapse
from ...._sources import coordinates, sparse_entries, unique_pairs

__all__ = ["reduce_graph"]


def reduce_graph(input_edges: Any, nb_iterations: int = 1) -> Any:
    """Collapses edges; the edges that are left have the same bars.

    Parameters
    ----------
    input_edges : scipy.sparse.coo_matrix
        Each edge once, in either triangle, with its value, of any sign.
    nb_iterations : int
        The number of rounds in GUDHI. With 0, nothing is collapsed. With any other number, libph
        continues as long as rounds help.

    Returns
    -------
    scipy.sparse.coo_matrix
        The remaining edges, with the same number type.

    Raises
    ------
    DataError
        If a value is NaN, or an edge has two values.
    """
    from scipy.sparse import coo_matrix
    _options.whole("nb_iterations", nb_iterations, 0)
    edges = coordinates(input_edges, "input_edges")
    row, column, values = sparse_entries(edges, "input_edges")
    for wrong, expected in ((np.isnan(values), "a number"),
                            ((row == column) & (values != 0), "none on the diagonal")):
        if wrong.any():
            k = int(np.argmax(wrong))
            raise DataError(f"input_edges: {_arrays.place_of((row[k], column[k]))}: found "
                            f"{values[k]}, expected {expected}")
    if nb_iterations == 0 or not edges.nnz:
        return coo_matrix(edges)
    is_edge = row != column
    i, j, values = unique_pairs(row[is_edge], column[is_edge], values[is_edge], 0.0, None, "",
                                "input_edges")
    # libph has no negative values. The collapse depends only on the order of values.
    levels, ranks = np.unique(values, return_inverse=True)
    size = max(edges.shape)
    found = collapse(coo_matrix((ranks.astype(np.float64), (i, j)), shape=(size, size)))
    data = levels[found.data.astype(np.int64)].astype(edges.data.dtype)
    return coo_matrix((data, (found.row, found.col)), shape=edges.shape)
