# SPDX-License-Identifier: MIT
"""giotto-ph's interface on top of libph.

>>> from libph.compat.gph import ripser_parallel
>>> ripser_parallel(np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 1]]))["dgms"][1]
array([[1.       , 1.4142135]], dtype=float32)

The numbers are the same as in giotto-ph: in single precision, and in the order of giotto-ph.
``dtype=np.float64`` gives exact numbers. docs/how-to/coming-from.md lists the cases in which libph
deliberately gives another answer.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from ... import _arrays, _options, _run
from ..._core import version as __version__
from ..._errors import NotBuiltIn, UsageError
from .. import _flag
from .._weights import weighted
from . import modules

if TYPE_CHECKING:
    from collections.abc import Mapping

    from typing_extensions import Unpack

    from ..._run import RunOptions

__all__ = ["__version__", "modules", "ripser_parallel"]


def ripser_parallel(X: Any, maxdim: int = 1, thresh: float = np.inf, coeff: int = 2,
                    metric: Any = "euclidean", metric_params: Mapping[str, Any] = {},
                    nearest_neighbors_params: Mapping[str, Any] = {},
                    weights: ArrayLike | str | None = None,
                    weight_params: Mapping[str, Any] | None = None, collapse_edges: bool = False,
                    n_threads: int = 1, return_generators: bool = False, *,
                    dtype: DTypeLike = np.float32, **run: Unpack[RunOptions]) -> dict[str, Any]:
    """Diagrams of the Vietoris-Rips filtration, as giotto-ph returns them.

    Parameters
    ----------
    X : array_like or sparse matrix
        Points, one per row; with ``metric="precomputed"``, distances with births on the diagonal. A
        dense matrix is read above the diagonal; a sparse matrix is read in both triangles, and of
        two entries the upper one counts. Pairs that are not stored are never joined.
    maxdim : int
        The highest dimension of homology.
    thresh : float
        The largest distance at which points are joined. Doubles in a dense matrix are compared as
        they are, and other distances in single precision.
    coeff : int
        A prime.
    metric : str or callable
        As in scikit-learn's `pairwise_distances`, or "precomputed".
    metric_params : dict
        More arguments for the metric.
    nearest_neighbors_params : dict
        Arguments for scikit-learn's `NearestNeighbors`, which finds the distances of points up to
        a finite `thresh`.
    weights : array_like or "DTM", optional
        The diameters at which points enter; "DTM": twice the distance to a measure.
    weight_params : dict, optional
        "p": how a ball grows after the birth of its point, 1 (default), 2 or inf. For "DTM" also
        "n_neighbors", the number of neighbours without the point itself (3), and "r", the exponent
        of the mean (2).
    collapse_edges : bool
        If True, edges are always collapsed first. Otherwise they are collapsed if this saves time.
        The bars are the same.
    n_threads : int
        Number of threads; -1: one per core.
    return_generators : bool
        If True, the edges that determine the values of simplices are returned as well.
    dtype : {float32, float64}
        The precision of the filtration, and of the diagrams.
    **run
        `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    dict
        `dgms`: a diagram for each dimension. With `return_generators` also `gens`, a tuple of four:
        for H0, rows of the birth vertex and the larger and smaller vertex of the death edge; for
        each dimension from 1, rows of birth edge and death edge; the vertices of bars of H0 that
        never die; for each dimension from 1, the edges of bars that never die.

    Raises
    ------
    UsageError, DataError
        Both are ValueErrors.
    NotBuiltIn
        A NotImplementedError, for `collapse_edges` with `return_generators`, and for other values
        of p.
    """
    _run.check_names("ripser_parallel", run, ripser_parallel)
    if collapse_edges and return_generators:
        raise NotBuiltIn("collapse_edges: found True with return_generators=True, expected one of "
                         "the two; without collapse_edges, edges are collapsed if that helps")
    kind = _flag.precision(dtype)
    limit, max_dim = _flag.threshold(thresh), _flag.dimension(maxdim)
    if "threads" not in run:
        run["threads"] = None if n_threads == -1 else _options.whole("n_threads", n_threads, 1)
    distances = _distances(X, limit, metric, metric_params, nearest_neighbors_params,
                           None if n_threads == -1 else n_threads)
    births = None
    if collapse_edges or _arrays.is_sparse(distances) or distances.dtype != np.float64:
        limit = _flag.last_rounded_to(limit, kind)  # giotto-ph compares in single precision
    if weights is not None:
        distances, births = weighted(distances, weights, weight_params or {})
    if _arrays.is_sparse(distances):
        size = births.size if births is not None else max(distances.shape)
        flag = _flag.of_sparse(distances, limit, size, upper_wins=True, births=births)
    else:
        flag = _flag.of_dense(distances, limit, kind, is_symmetric=False, births=births)
    bars = _flag.compute(flag, max_dim, kind, True, field=coeff,
                         collapse=True if collapse_edges else "auto", **run)
    found: dict[str, Any] = {"dgms": [dgm.astype(kind) for dgm in bars.dgms]}
    if return_generators:
        found["gens"] = _generators(flag, bars)
    return found


def _distances(X: Any, limit: float, metric: Any, metric_params: Mapping[str, Any],
               neighbors_params: Mapping[str, Any], jobs: int | None) -> Any:
    """A matrix of distances, or a sparse one."""
    if isinstance(metric, str) and metric == "precomputed":
        if _arrays.is_sparse(X):
            return X
        matrix = _arrays.as_distances(X)
        if matrix.ndim != 2:
            raise UsageError(f"X: found an array of shape {matrix.shape}, expected a square matrix")
        return matrix
    try:
        from scipy.sparse import triu
        from sklearn.metrics import pairwise_distances
        from sklearn.neighbors import NearestNeighbors
    except ImportError:
        raise NotBuiltIn("ripser_parallel: distances between points need scikit-learn, which is "
                         "not installed; metric='precomputed' takes distances, ph.rips takes points"
                         ) from None
    if limit == np.inf:
        return pairwise_distances(X, metric=metric, **metric_params)
    near = NearestNeighbors(radius=limit, metric=metric, metric_params=metric_params, n_jobs=jobs,
                            **neighbors_params).fit(X)
    # If a pair is as far apart as the limit, up to rounding, only one of its points may find the
    # other.
    return triu(near.radius_neighbors_graph(mode="distance"))


def _generators(flag: _flag.Flag, bars: _flag.Bars) -> tuple[Any, ...]:
    """Represents the simplices of birth and death by their last edges."""
    finite, essential = [], []
    for dim, dgm in enumerate(bars.dgms):
        places = bars.places(dim) - np.searchsorted(bars.barcode.dims, dim)
        dies = np.isfinite(dgm[:, 1])
        born = _flag.youngest_edges(flag.values, bars.barcode.birth_cells(dim)[places])
        killed = _flag.youngest_edges(flag.values,
                                      bars.barcode.death_cells(dim)[places[dies]])
        finite.append(np.column_stack([born[dies], killed]))
        essential.append(born[~dies])
    return finite[0], finite[1:], essential[0][:, 0], essential[1:]
