# SPDX-License-Identifier: MIT
"""GUDHI's function for edge collapse, over `libph.collapse`."""
from __future__ import annotations

from typing import Any

import numpy as np

from .... import _options
from ...._points import collapse

__all__ = ["reduce_graph"]


def reduce_graph(input_edges: Any, nb_iterations: int = 1) -> Any:
    """Fewer edges with the same bars.

    Parameters
    ----------
    input_edges : scipy.sparse.coo_matrix
        Each edge once, in either triangle, with its value, of any sign.
    nb_iterations : int
        How often GUDHI collapses. libph goes on for as long as it helps.

    Returns
    -------
    scipy.sparse.coo_matrix
        Of the same type of numbers.
    """
    from scipy.sparse import coo_matrix
    _options.whole("nb_iterations", nb_iterations, 0)
    edges = input_edges.tocoo()
    if nb_iterations == 0 or not edges.nnz:
        return coo_matrix(edges)
    # libph has no values below 0. What is collapsed depends on their order alone.
    levels, ranks = np.unique(edges.data, return_inverse=True)
    size = max(edges.shape)
    found = collapse(coo_matrix((ranks.astype(np.float64), (edges.row, edges.col)),
                                shape=(size, size)))
    data = levels[found.data.astype(np.int64)].astype(edges.data.dtype)
    return coo_matrix((data, (found.row, found.col)), shape=edges.shape)
