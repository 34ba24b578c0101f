# SPDX-License-Identifier: MIT
"""Births and deaths as functions of points, distances and pixels, and their derivatives.

A birth or a death is the value of a cell, and that is the value of one thing in the input: the
longest edge of a simplex, one pixel of a cube. Near X it stays the value of that thing, so its
derivative is the derivative of a distance, or 1 at a pixel. This holds where all values differ.

At ties births and deaths are not differentiable. What is given there is the derivative of one of
the things that decide:

* of cells that are born at the same value the cell that the barcode names;
* of equally long edges of a simplex the first one, in the order of its vertices; of equal pixels
  the first one, in C order;
* of a distance 0 the derivative 0; of equal differences of coordinates, for
  ``metric="chebyshev"``, the first one; of equally near points, for ``weights="dtm"``, those of
  the smallest numbers.

`libph.torch` has the same as functions of torch.
"""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _arrays
from .._barcodes import Barcode
from .._errors import UsageError
from ._edges import RipsValues
from ._values import CellValues, StarValues, VoxelValues

__all__ = ["deciders", "pullback"]


def pullback(bars: Barcode, X: Any, d_births: ArrayLike | None = None,
             d_deaths: ArrayLike | None = None, *, weights: ArrayLike | None = None) -> Any:
    """The derivative of a function of births and deaths with respect to the data.

    The vector-Jacobian product: the sum over the bars of d_births[i] times the gradient of birth i,
    plus d_deaths[i] times the gradient of death i.

    Parameters
    ----------
    bars : Barcode
        Of `rips`, `cubical`, `lower_star` or `boundary`, with cells; or some of its bars.
    X : array_like or sparse matrix
        What they were computed of: points, distances, an image, values of vertices or of cells.
    d_births, d_deaths : array_like, optional
        Of each bar the derivative of the function with respect to its birth, and to its death.
        Default: 0. With respect to the death of a bar that never dies it has to be 0.
    weights : array_like, optional
        What `rips` got as `weights`, if an array. They are constants.

    Returns
    -------
    ndarray or sparse matrix
        Of the shape of X. Of a matrix of distances each of the two entries of a pair has half of
        the derivative; of a sparse one, with the entries of X, all of it where one is stored.

    Raises
    ------
    UsageError
        If births and deaths are no differentiable functions: ``metric="hamming"``, a function as
        the metric, an approximation. Or if it is not known how: complexes of `filtered`, barcodes
        of files.
    DataError
        If X is not what the bars were computed of.

    Examples
    --------
    A loop is born at the longest of its edges, and dies at the diagonal:

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


def deciders(bars: Barcode, X: Any, *, weights: ArrayLike | None = None
             ) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """What decides on each birth and each death.

    With these numbers any program that differentiates can compute births and deaths itself.

    Parameters
    ----------
    bars, X, weights
        As of `pullback`.

    Returns
    -------
    births, deaths : ndarray
        A row for each bar. Of points and distances the ends of an edge, the same number twice where
        it is the birth of a point; of images a pixel; otherwise one vertex or cell. -1: it never
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
    """By dimension of the cells: the places of the bars, their cells."""
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
        raise UsageError("weights: do nothing, the barcode was computed without an array of them")
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
        raise UsageError(f"bars: found a barcode of the complex {kind!r}, expected one that rips, "
                         "cubical, lower_star or boundary computed: the values of its cells are not "
                         "known as functions of X")
    for is_death, stated in ((False, bars.births), (True, bars.deaths)):
        for dim, places, cells in _cells_of(bars, is_death):
            values.compare(dim, cells, stated[places], "death" if is_death else "birth")
    return values
