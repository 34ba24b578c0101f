# SPDX-License-Identifier: MIT
"""Distances of barcodes, matchings, and barycentres."""
from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _options, _run
from ._barcodes import Barcode
from ._errors import UsageError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from typing_extensions import Unpack

    from ._run import RunOptions

_DISTANCES = ["bottleneck", "wasserstein", "sliced_wasserstein"]


@overload
def bottleneck(  # type: ignore[misc]  # a Barcode is array_like, too: the first that fits counts
        a: Barcode, b: Barcode, dim: None = None, *, relative_error: float = 0.0,
        at_most: float = math.inf, **run: Unpack[RunOptions]) -> dict[int, float]: ...
@overload
def bottleneck(a: ArrayLike, b: ArrayLike, dim: int | None = None, *, relative_error: float = 0.0,
               at_most: float = math.inf, **run: Unpack[RunOptions]) -> float: ...


def bottleneck(a: Any, b: Any, dim: int | None = None, *, relative_error: float = 0.0,
               at_most: float = math.inf, **run: Unpack[RunOptions]) -> float | dict[int, float]:
    """The bottleneck distance of two barcodes, exact.

    Bars are paired or left over. The distance is the least d such that births and deaths of each
    pair are at most d apart, and bars left over are at most 2 d long. Bars that never die are
    paired with such bars only; where their numbers differ the distance is inf.

    Parameters
    ----------
    a, b : Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    dim : int, optional
        Of two barcodes: the dimension to compare. Default: each.
    relative_error : float
        0: the distance itself. Else what is returned is at least the distance, and at most
        1 + relative_error times as large.
    at_most : float
        Distances beyond need not be known: then what is returned is at least the distance, and
        more than `at_most`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    float or dict of int to float
        Of two barcodes without `dim` the distance in each dimension.

    Examples
    --------
    >>> ph.bottleneck([[0, 1.5]], [[0, 1.25]])
    0.25
    """
    _run.check_names("bottleneck", run, bottleneck)
    return _of_each_dim(a, b, dim, _metric("bottleneck", relative_error=relative_error,
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
    """The Wasserstein distance of two barcodes, to the last digits or certified within a bound.

    Bars are paired or left over. A pair costs its distance to the power of `order`, and a bar left
    over its distance from the diagonal to this power. The distance is the root of the least sum.
    Bars that never die are paired with such bars only; where their numbers differ it is inf.

    Parameters
    ----------
    a, b : Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    dim : int, optional
        Of two barcodes: the dimension to compare. Default: each.
    order : float
        p, at least 1 and finite. `bottleneck` is what p = inf would be.
    ground : float
        q, the norm of a pair, at least 1: inf for the larger difference of births and deaths, 2
        for the Euclidean norm.
    relative_error : float
        0: the distance itself. Else what is returned is at least the distance, and at most
        1 + relative_error times as large; 0.01 is several times as fast.
    at_most : float
        Distances beyond need not be known: then what is returned is at least the distance, and
        more than `at_most`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    float or dict of int to float
        Of two barcodes without `dim` the distance in each dimension.

    Examples
    --------
    >>> ph.wasserstein([[0, 1.5], [0, 1]], [[0, 1.25]])
    0.75
    >>> ph.wasserstein([[0, 1.5]], [[1, 1.5]], order=2, ground=2)
    1.0
    """
    _run.check_names("wasserstein", run, wasserstein)
    return _of_each_dim(a, b, dim, _metric("wasserstein", order, ground, relative_error, at_most),
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
    """The sliced Wasserstein distance of two barcodes [Carrière, Cuturi, Oudot 2017].

    Bars are projected to lines, and sorted numbers are compared. It is another distance than
    `wasserstein`: at most 2 √2 times as large as that of order 1. exp(-distance) is a positive
    definite kernel.

    Parameters
    ----------
    a, b : Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    dim : int, optional
        Of two barcodes: the dimension to compare. Default: each.
    directions : int
        How many lines, evenly around; the mean over them is returned.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    float or dict of int to float
        Of two barcodes without `dim` the distance in each dimension.

    Examples
    --------
    >>> round(ph.sliced_wasserstein([[0, 1]], []), 3)
    0.45
    """
    _run.check_names("sliced_wasserstein", run, sliced_wasserstein)
    return _of_each_dim(a, b, dim, _metric("sliced_wasserstein", directions=directions), run)


@dataclass(frozen=True, eq=False)
class Matching:
    """Which bars of two diagrams are paired; see `bottleneck_matching`, `wasserstein_matching`.

    Attributes
    ----------
    distance : float
        What the matching costs: the distance of the diagrams, or a number above it as near as was
        asked for.
    lower : float
        The distance is not below this.
    pairs : ndarray
        Rows (i, j): bar i of `a` is paired with bar j of `b`; -1 is the diagonal. Each bar is in
        one row. No rows if the distance is infinite.
    order : float
        p, see `wasserstein`; inf for the bottleneck distance.
    ground : float
        q, see `wasserstein`; inf for the bottleneck distance.
    a : ndarray
        The first diagram, rows birth, death.
    b : ndarray
        The second diagram.
    """

    distance: float
    lower: float
    pairs: NDArray[np.int64]
    order: float
    ground: float
    a: NDArray[np.float64]
    b: NDArray[np.float64]

    def plot(self, ax: Axes | None = None, **style: Any) -> Axes:
        """Draws both diagrams, and a line for each pair, with matplotlib.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw. Default: new ones.
        **style
            Of the lines, for matplotlib's LineCollection.

        Returns
        -------
        Axes
        """
        from ._barcodes._plots import plot_matching
        return plot_matching(self.a, self.b, self.pairs, ax, style)


def bottleneck_matching(a: Barcode | ArrayLike, b: Barcode | ArrayLike, dim: int | None = None,
                        **run: Unpack[RunOptions]) -> Matching:
    """Which bars the bottleneck distance pairs.

    Parameters
    ----------
    a, b : Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    dim : int, optional
        Of barcodes: the dimension.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Matching

    Examples
    --------
    >>> ph.bottleneck_matching([[0, 4], [1, 1.5]], [[0, 5]]).pairs
    array([[ 0,  0],
           [ 1, -1]])
    """
    _run.check_names("bottleneck_matching", run, bottleneck_matching)
    return _matching(a, b, dim, "bottleneck", math.inf, math.inf, 0.0, run)


def wasserstein_matching(a: Barcode | ArrayLike, b: Barcode | ArrayLike, dim: int | None = None, *,
                         order: float = 1.0, ground: float = math.inf, relative_error: float = 0.0,
                         **run: Unpack[RunOptions]) -> Matching:
    """Which bars the Wasserstein distance pairs.

    Parameters
    ----------
    a, b : Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    dim : int, optional
        Of barcodes: the dimension.
    order, ground, relative_error : float
        As of `wasserstein`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Matching

    Examples
    --------
    >>> matching = ph.wasserstein_matching([[0, 4], [1, 1.5]], [[0, 5], [7, 9]], order=2)
    >>> matching.pairs
    array([[ 0,  0],
           [ 1, -1],
           [-1,  1]])
    """
    _run.check_names("wasserstein_matching", run, wasserstein_matching)
    return _matching(a, b, dim, "wasserstein", order, ground, relative_error, run)


def diagram_distances(diagrams: Iterable[Barcode | ArrayLike],
                      others: Iterable[Barcode | ArrayLike] | None = None, dim: int | None = None,
                      *, distance: str = "wasserstein", order: float = 1.0,
                      ground: float = math.inf, relative_error: float = 0.0, directions: int = 50,
                      **run: Unpack[RunOptions]) -> NDArray[np.float64]:
    """The distances of all pairs of diagrams, on all cores.

    Parameters
    ----------
    diagrams : sequence of Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    others : sequence of Barcode or array_like, optional
        Others, to each of which the distance is computed. Default: the diagrams themselves.
    dim : int, optional
        Of barcodes: the dimension.
    distance : {"wasserstein", "bottleneck", "sliced_wasserstein"}
        Which distance.
    order, ground : float
        Of "wasserstein", as of `wasserstein`.
    relative_error : float
        Of "wasserstein" and "bottleneck": how much too large a distance may be.
    directions : int
        Of "sliced_wasserstein".
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    ndarray
        Of shape (len(diagrams), len(others)); symmetric without `others`. Estimators of
        scikit-learn take it with ``metric="precomputed"``.

    Examples
    --------
    >>> ph.diagram_distances([[[0, 1]], [[0, 2]], []])
    array([[0. , 1. , 0.5],
           [1. , 0. , 1. ],
           [0.5, 1. , 0. ]])
    """
    _run.check_names("diagram_distances", run, diagram_distances)
    name = _options.choice("distance", distance, _DISTANCES)
    _refuse_options_of_others(name, order, ground, relative_error, directions)
    metric = _metric(name, order, ground, relative_error, directions=directions)
    rows = all_rows("diagrams", diagrams, dim)
    columns = None if others is None else all_rows("others", others, dim)
    return np.asarray(_run.run(_core.distances, rows, columns, metric, options=dict(run)))


class Barycentre(NamedTuple):
    """A diagram in the middle of others; see `barycentre`.

    Attributes
    ----------
    diagram : ndarray
        Rows birth, death, ascending.
    root_mean_square : float
        Of its distances to the diagrams.
    rounds : int
        That lowered it.
    converged : bool
        Whether it ended before `max_rounds`.
    """

    diagram: NDArray[np.float64]
    root_mean_square: float
    rounds: int
    converged: bool


def barycentre(diagrams: Iterable[Barcode | ArrayLike], dim: int | None = None, *,
               max_rounds: int = 100, tolerance: float = 1e-6, **run: Unpack[RunOptions]
               ) -> Barycentre:
    """A barycentre (Fréchet mean) of diagrams [Turner, Mileyko, Mukherjee, Harer 2014].

    A local minimum of the mean square of the Wasserstein distances of order 2 with Euclidean ground
    norm. It begins at the medoid. Each of its bars is the mean of the bars that it is paired with,
    so there may be many that are short.

    Parameters
    ----------
    diagrams : sequence of Barcode or array_like
        Barcodes, or arrays of rows birth, death, with as many bars that never die.
    dim : int, optional
        Of barcodes: the dimension.
    max_rounds : int
        The most rounds; 0: the medoid.
    tolerance : float
        It ends after a round that lowers the root mean square by this part of it, or less.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Barycentre

    Examples
    --------
    >>> ph.barycentre([[[0, 4]], [[1, 5]], [[2, 3]]]).diagram
    array([[1., 4.]])
    """
    _run.check_names("barycentre", run, barycentre)
    rounds = _options.whole("max_rounds", max_rounds, 0, 2**31 - 1)
    least_gain = _options.real("tolerance", tolerance, "a finite number, at least 0", 0)
    block, root_mean_square, done, converged = _run.run(
        _core.barycentre, all_rows("diagrams", diagrams, dim), rounds, least_gain,
        options=dict(run))
    return Barycentre(np.asarray(block), root_mean_square, done, converged)


# ---- what the distances have in common


def _metric(kind: str, order: float = 1.0, ground: float = math.inf, relative_error: float = 0.0,
            at_most: float = math.inf, directions: int = 50) -> _core.DiagramMetric:
    return _core.DiagramMetric(
        kind, _options.real("order", order, "a number, at least 1"),
        _options.real("ground", ground, "a number, at least 1, or inf"),
        _options.real("relative_error", relative_error, "a number, at least 0", 0),
        _options.real("at_most", at_most, "a number, at least 0", 0), _options.whole("directions", directions, 1, 2**31 - 1))


def _refuse_options_of_others(distance: str, order: float, ground: float, relative_error: float,
                              directions: int) -> None:
    """Refuses what the distance does not look at."""
    for name, value, default, owners in (
            ("order", order, 1.0, ["wasserstein"]), ("ground", ground, math.inf, ["wasserstein"]),
            ("relative_error", relative_error, 0.0, ["wasserstein", "bottleneck"]),
            ("directions", directions, 50, ["sliced_wasserstein"])):
        if value != default and distance not in owners:
            raise UsageError(f"{name}: does nothing for distance={distance!r}, only for "
                             + " and ".join(map(repr, owners)))


def _of_each_dim(a: Any, b: Any, dim: int | None, metric: _core.DiagramMetric, run: Any
                 ) -> float | dict[int, float]:
    """The distance, or one of each dimension of two barcodes."""
    def distance(x: NDArray[np.float64], y: NDArray[np.float64]) -> float:
        return float(_run.run(_core.distance, x, y, metric, options=dict(run))[0])

    if dim is None and isinstance(a, Barcode) and isinstance(b, Barcode):
        return {d: distance(a.dgm(d), b.dgm(d)) for d in range(max(a._top_dim, b._top_dim) + 1)}
    return distance(*_two_diagrams(a, b, dim))


def _matching(a: Any, b: Any, dim: int | None, kind: str, order: float, ground: float,
              relative_error: float, run: Any) -> Matching:
    rows_a, rows_b = _two_diagrams(a, b, dim)
    metric = _metric(kind, order, ground, relative_error)
    value, lower, pairs = _run.run(_core.matching, rows_a, rows_b, metric, options=dict(run))
    # Copies: a matching stays what it is when the caller's arrays change.
    return Matching(value, lower, np.asarray(pairs), float(order), float(ground), np.array(rows_a),
                    np.array(rows_b))


def _two_diagrams(a: Any, b: Any, dim: int | None
                  ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    are_barcodes = isinstance(a, Barcode), isinstance(b, Barcode)
    _check_dim(dim, any(are_barcodes), all(are_barcodes))
    return _rows(a, "a", dim), _rows(b, "b", dim)


def all_rows(name: str, diagrams: Iterable[Any], dim: int | None) -> list[NDArray[np.float64]]:
    if isinstance(diagrams, (str, bytes, dict, Barcode)) or not isinstance(diagrams, Iterable):
        raise _options.refuse(name, diagrams, "a list of barcodes or diagrams")
    given = list(diagrams)
    are_barcodes = [isinstance(diagram, Barcode) for diagram in given]
    if given:
        _check_dim(dim, any(are_barcodes), all(are_barcodes))
    return [_rows(diagram, f"{name}[{i}]", dim) for i, diagram in enumerate(given)]


def _check_dim(dim: int | None, has_barcodes: bool, only_barcodes: bool) -> None:
    if dim is None and has_barcodes:
        raise UsageError("dim: found None, expected the dimension of the bars "
                         + ("to compare" if only_barcodes else "that the array holds"))
    if dim is not None and not has_barcodes:
        raise UsageError("dim: does nothing for arrays, expected a Barcode")


def _rows(bars: Any, name: str, dim: int | None) -> NDArray[np.float64]:
    if isinstance(bars, Barcode):
        return bars.dgm(_options.whole("dim", dim, 0))
    if isinstance(bars, (list, tuple)):
        for row in bars:
            if isinstance(row, np.ndarray) and row.ndim == 2:
                raise UsageError(f"{name}: found a list of arrays, expected one of rows birth, "
                                 f"death; {name}[1] are those of H1")
            if isinstance(row, tuple) and len(row) == 2 and isinstance(row[1], tuple):
                raise UsageError(f"{name}: found pairs (dimension, (birth, death)), expected rows "
                                 "birth, death, of one dimension")
    array = _arrays.as_array(bars, name)
    if array.size == 0:
        return np.empty((0, 2))
    if array.ndim != 2 or array.shape[1] != 2:
        raise UsageError(f"{name}: found an array of shape {array.shape}, expected rows birth, "
                         "death")
    return _arrays.as_float64(array, name)
