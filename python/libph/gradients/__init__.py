# SPDX-License-Identifier: MIT
"""Births and deaths as functions of points, distances and pixels, and their derivatives.

A birth or a death is the value of a cell, and one element of the input determines this value: the
longest edge of a simplex, or one pixel of a cube. If all values differ, the same element determines
the value throughout a neighbourhood of X. The derivative of the birth or the death is then the
derivative of a distance, or 1 at a pixel.

At ties, births and deaths are not differentiable. There, the derivative of one of the tied elements
is returned:

* among cells that are born at the same value, the cell that the barcode names;
* among equally long edges of a simplex, the first one in the order of its vertices; among equal
  pixels, the first one in C order;
* for a distance of 0, the derivative 0; among equal differences of coordinates, for
  ``metric="chebyshev"``, the first one; among equally near points, for ``weights="dtm"``, the
  points with the smallest numbers.

`libph.torch` offers the same derivatives for torch tensors.
"""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _arrays, _options
from .._barcodes import Barcode
from .._errors import UsageError
from ._edges import RipsValues
from ._values import CellValues, StarValues, VoxelValues

__all__ = ["deciders", "pullback"]


@_options.with_hints
def pullback(bars: Barcode, X: Any, d_births: ArrayLike | None = None,
             d_deaths: ArrayLike | None = None, *, weights: ArrayLike | None = None) -> Any:
    """The derivative of a function of births and deaths with respect to the data.

    The vector-Jacobian product: the sum over the bars of d_births[i] times the gradient of birth i,
    plus d_deaths[i] times the gradient of death i.

    Parameters
    ----------
    bars : Barcode
        A barcode of `rips`, `cubical`, `lower_star` or `boundary`, with cells; or some of its bars.
    X : array_like or sparse matrix
        The data from which they were computed: points, distances, an image, values of vertices or
        of cells.
    d_births, d_deaths : array_like, optional
        For each bar, the derivative of the function with respect to its birth, and to its death.
        Default: 0. For a bar that never dies, the derivative with respect to its death must be 0.
    weights : array_like, optional
        The `weights` that `rips` received, if they were an array. They are treated as constants.

    Returns
    -------
    ndarray or sparse matrix
        An array in the shape of X. For a matrix of distances, each of the two entries of a pair has
        half of the derivative. For a sparse matrix, the result has the entries of X; if only one
        entry of a pair is stored, it has all of the derivative.

    Raises
    ------
    UsageError
        If births and deaths are not differentiable, as for ``metric="hamming"``, a function as the
        metric, or an approximation. Also if the derivative is unknown, as for complexes of
        `filtered` and barcodes from files.
    DataError
        If the bars were not computed from X.

    Examples
    --------
    A loop is born at its longest edge and dies at the diagonal:

    >>> rectangle = [[0, 0], [3, 0], [3, 4], [0, 4]]
    >>> bars = ph.rips(rectangle).filter(dim=1)
    >>> list(bars)
    [Bar(dim=1, birth=4.0, death=5.0)]
    >>> ph.gradients.pullback(bars, rectangle, d_deaths=[1])
    array([[-0.6, -0.8],
           [ 0. ,  0. ],
           [ 0.6,  0.8],
           [ 0. ,  0. ]])
    """
    values = _values_of(bars, X, weights)
    for name, given, is_death in (("d_births", d_births, False), ("d_deaths", d_deaths, True)):
        if given is None:
            continue
        factors = _arrays.as_values(given, name, len(bars), "bar")
        if is_death:
            endless = np.isinf(bars.deaths)
            if factors[endless].any():  # NaN is not 0
                i = int(np.flatnonzero(endless & (factors != 0))[0])
                raise UsageError(f"d_deaths: entry {i}: found {factors[i]}, expected 0 for a bar that "
                                 "never dies")
        for dim, places, cells in _cells_of(bars, is_death):
            values.add(dim, cells, factors[places])
    return values.gradient()


@_options.with_hints
def deciders(bars: Barcode, X: Any, *, weights: ArrayLike | None = None
             ) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The elements of the input that determine each birth and each death.

    With these numbers, any program with automatic differentiation can compute births and deaths
    itself.

    Parameters
    ----------
    bars, X, weights
        As in `pullback`.

    Returns
    -------
    births, deaths : ndarray
        One row per bar. For points and distances, the ends of an edge, or the same number twice for
        the birth of a point; for images, a pixel; otherwise one vertex or cell. -1 if the bar never
        dies.

    Examples
    --------
    >>> rectangle = [[0, 0], [3, 0], [3, 4], [0, 4]]
    >>> bars = ph.rips(rectangle).filter(dim=1)
    >>> births, deaths = ph.gradients.deciders(bars, rectangle)
    >>> births, deaths
    (array([[0, 3]]), array([[0, 2]]))
    """
    values = _values_of(bars, X, weights)
    answers = []
    for is_death in (False, True):
        rows = np.full((len(bars), values.width), -1, dtype=np.int64)
        for dim, places, cells in _cells_of(bars, is_death):
            rows[places] = values.deciders(dim, cells)
        answers.append(rows)
    return answers[0], answers[1]


def _cells_of(bars: Barcode, is_death: bool) -> Any:
    """For each dimension of cells: the indices of the bars, and their cells."""
    for dim in np.unique(bars.dims).tolist():
        places = np.arange(len(bars))[bars._range(dim)]
        cells = bars.death_cells(dim) if is_death else bars.birth_cells(dim)
        if is_death:
            dies = np.isfinite(bars.deaths[places])
            places, cells = places[dies], cells[dies]
        if len(places):
            yield dim + is_death, places, cells


def _values_of(bars: Any, X: Any, weights: Any) -> CellValues:
    """The values of the cells of a barcode, checked against it."""
    if not isinstance(bars, Barcode):
        raise UsageError(f"bars: found {type(bars).__name__}, expected a Barcode")
    meta = bars.meta
    kind = meta.get("complex")
    if weights is not None and meta.get("weights") != "given":
        raise UsageError("weights: do nothing, because the barcode was computed without weights given as "
                         "an array")
    values: CellValues
    if kind == "rips" and "points" in meta:
        values = RipsValues(X, meta, weights)
    elif kind == "cubical" and "shape" in meta:
        values = VoxelValues(X, meta)
    elif kind == "lower-star" and "points" in meta:
        values = StarValues(X, meta["points"])
    elif kind == "explicit" and bars._bars.cell_kind == "row":
        values = StarValues(X, None)
    else:
        raise UsageError(f"bars: found a barcode of the complex {kind!r}, expected one from rips, "
                         "cubical, lower_star or boundary, because the cell values of other "
                         "complexes are not known as functions of X")
    for is_death, stated in ((False, bars.births), (True, bars.deaths)):
        for dim, places, cells in _cells_of(bars, is_death):
            values.compare(dim, cells, stated[places], "death" if is_death else "birth")
    return values
