# SPDX-License-Identifier: MIT
"""Distances between two barcodes, and between all pairs of a list."""
from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core, _options, _run
from .._barcodes import Barcode
from ._diagrams import all_rows, two_diagrams
from ._metric import metric_of, refuse_options_of_others

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .._run import RunOptions

_DISTANCES = ["bottleneck", "wasserstein", "sliced_wasserstein"]


@overload
def bottleneck(  # type: ignore[misc]  # a Barcode is also array_like; the first match counts
        a: Barcode, b: Barcode, dim: None = None, *, relative_error: float = 0.0,
        at_most: float = math.inf, **run: Unpack[RunOptions]) -> dict[int, float]: ...
@overload
def bottleneck(a: ArrayLike, b: ArrayLike, dim: int | None = None, *, relative_error: float = 0.0,
               at_most: float = math.inf, **run: Unpack[RunOptions]) -> float: ...


def bottleneck(a: Any, b: Any, dim: int | None = None, *, relative_error: float = 0.0,
               at_most: float = math.inf, **run: Unpack[RunOptions]) -> float | dict[int, float]:
    """The exact bottleneck distance between two barcodes.

    Each bar is paired with a bar of the other barcode, or left over. The distance is the least d
    such that births and deaths of each pair are at most d apart, and bars left over are at most 2 d
    long. Bars that never die are paired only with each other; if their numbers differ, the distance
    is inf.

    Parameters
    ----------
    a, b : Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    dim : int, optional
        For two barcodes: the dimension to compare. Default: every dimension.
    relative_error : float
        0: the exact distance. Otherwise the result is at least the distance, and at most 1 +
        relative_error times as large.
    at_most : float
        Distances above this value need not be exact: for them, the result is at least the distance,
        and more than `at_most`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    float or dict of int to float
        For two barcodes without `dim`, the distance in each dimension.

    Examples
    --------
    >>> ph.bottleneck([[0, 1.5]], [[0, 1.25]])
    0.25
    """
    _run.check_names("bottleneck", run, bottleneck)
    return _of_each_dim(a, b, dim, metric_of("bottleneck", relative_error=relative_error,
                                             at_most=at_most), run)


@overload
def wasserstein(  # type: ignore[misc]
        a: Barcode, b: Barcode, dim: None = None, *, order: float = 1.0, ground: float = math.inf,
        relative_error: float = 0.0, at_most: float = math.inf, **run: Unpack[RunOptions]
        ) -> dict[int, float]: ...
@overload
def wasserstein(a: ArrayLike, b: ArrayLike, dim: int | None = None, *, order: float = 1.0,
                ground: float = math.inf, relative_error: float = 0.0, at_most: float = math.inf,
                **run: Unpack[RunOptions]) -> float: ...


def wasserstein(a: Any, b: Any, dim: int | None = None, *, order: float = 1.0,
                ground: float = math.inf, relative_error: float = 0.0, at_most: float = math.inf,
                **run: Unpack[RunOptions]) -> float | dict[int, float]:
    """The Wasserstein distance between two barcodes, exact or with a certified error bound.

    Each bar is paired with a bar of the other barcode, or left over. A pair costs its distance to
    the power of `order`; a bar left over costs its distance from the diagonal to the same power.
    The Wasserstein distance is the root, of degree `order`, of the least sum. Bars that never die
    are paired only with each other; if their numbers differ, the distance is inf.

    Parameters
    ----------
    a, b : Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    dim : int, optional
        For two barcodes: the dimension to compare. Default: every dimension.
    order : float
        p, at least 1 and finite. `bottleneck` corresponds to p = inf.
    ground : float
        q, the norm that measures a pair, at least 1: inf for the larger difference of births and
        deaths, 2 for the Euclidean norm.
    relative_error : float
        0: the exact distance. Otherwise the result is at least the distance, and at most 1 +
        relative_error times as large; 0.01 is several times as fast.
    at_most : float
        Distances above this value need not be exact: for them, the result is at least the distance,
        and more than `at_most`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    float or dict of int to float
        For two barcodes without `dim`, the distance in each dimension.

    Examples
    --------
    >>> ph.wasserstein([[0, 1.5], [0, 1]], [[0, 1.25]])
    0.75
    >>> ph.wasserstein([[0, 1.5]], [[1, 1.5]], order=2, ground=2)
    1.0
    """
    _run.check_names("wasserstein", run, wasserstein)
    return _of_each_dim(a, b, dim, metric_of("wasserstein", order, ground, relative_error, at_most),
                        run)


@overload
def sliced_wasserstein(  # type: ignore[misc]
        a: Barcode, b: Barcode, dim: None = None, *, directions: int = 50,
        **run: Unpack[RunOptions]) -> dict[int, float]: ...
@overload
def sliced_wasserstein(a: ArrayLike, b: ArrayLike, dim: int | None = None, *, directions: int = 50,
                       **run: Unpack[RunOptions]) -> float: ...


def sliced_wasserstein(a: Any, b: Any, dim: int | None = None, *, directions: int = 50,
                       **run: Unpack[RunOptions]) -> float | dict[int, float]:
    """The sliced Wasserstein distance between two barcodes [Carrière, Cuturi, Oudot 2017].

    Bars are projected onto lines, and the sorted projections are compared. This distance differs
    from `wasserstein`: it is at most 2 √2 times the Wasserstein distance of order 1. exp(-distance)
    is a positive definite kernel.

    Parameters
    ----------
    a, b : Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    dim : int, optional
        For two barcodes: the dimension to compare. Default: every dimension.
    directions : int
        Number of lines, evenly spread over all directions; the mean over them is returned.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    float or dict of int to float
        For two barcodes without `dim`, the distance in each dimension.

    Examples
    --------
    >>> round(ph.sliced_wasserstein([[0, 1]], []), 3)
    0.45
    """
    _run.check_names("sliced_wasserstein", run, sliced_wasserstein)
    return _of_each_dim(a, b, dim, metric_of("sliced_wasserstein", directions=directions), run)


def diagram_distances(diagrams: Iterable[Barcode | ArrayLike],
                      others: Iterable[Barcode | ArrayLike] | None = None, dim: int | None = None,
                      *, distance: str = "wasserstein", order: float = 1.0,
                      ground: float = math.inf, relative_error: float = 0.0, directions: int = 50,
                      **run: Unpack[RunOptions]) -> NDArray[np.float64]:
    """The distances between all pairs of diagrams, computed on all cores.

    Parameters
    ----------
    diagrams : sequence of Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    others : sequence of Barcode or array_like, optional
        The diagrams to which distances are computed. Default: `diagrams` themselves.
    dim : int, optional
        For barcodes: the dimension.
    distance : {"wasserstein", "bottleneck", "sliced_wasserstein"}
        The distance to compute.
    order, ground : float
        For "wasserstein"; see `wasserstein`.
    relative_error : float
        For "wasserstein" and "bottleneck": the allowed relative error; results are never too small.
    directions : int
        For "sliced_wasserstein": number of lines.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    ndarray
        A matrix of shape (len(diagrams), len(others)); symmetric without `others`. Estimators of
        scikit-learn accept it with ``metric="precomputed"``.

    Examples
    --------
    >>> ph.diagram_distances([[[0, 1]], [[0, 2]], []])
    array([[0. , 1. , 0.5],
           [1. , 0. , 1. ],
           [0.5, 1. , 0. ]])
    """
    _run.check_names("diagram_distances", run, diagram_distances)
    name = _options.choice("distance", distance, _DISTANCES)
    refuse_options_of_others(name, order, ground, relative_error, directions)
    metric = metric_of(name, order, ground, relative_error, directions=directions)
    rows = all_rows("diagrams", diagrams, dim)
    columns = None if others is None else all_rows("others", others, dim)
    return np.asarray(_run.run(_core.distances, rows, columns, metric, options=dict(run)))


def _of_each_dim(a: Any, b: Any, dim: int | None, metric: _core.DiagramMetric, run: Any
                 ) -> float | dict[int, float]:
    """The distance, or a distance for each dimension of two barcodes."""
    def distance(x: NDArray[np.float64], y: NDArray[np.float64]) -> float:
        return float(_run.run(_core.distance, x, y, metric, options=dict(run))[0])

    if dim is None and isinstance(a, Barcode) and isinstance(b, Barcode):
        return {d: distance(a.dgm(d), b.dgm(d)) for d in range(max(a._top_dim, b._top_dim) + 1)}
    return distance(*two_diagrams(a, b, dim))
