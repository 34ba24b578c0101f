# SPDX-License-Identifier: MIT
"""Functions of diagrams at the values of a grid."""
from __future__ import annotations

from typing import Any

import numpy as np

from .. import _options
from .._vectors import Diagram
from .._vectors._functions import (HEIGHTS, betti_curve, checked_entropy, checked_power, landscape,
                                   life_entropy, silhouette)
from .._vectors._ranges import range_of_values
from ._vectoriser import Vectoriser, ranges_of


class _OnGrid(Vectoriser):
    """Functions of the filtration value, at the values of a grid."""

    _ending: str  # prefix of the names of features, followed by a number
    resolution: Any
    range: Any

    def _fit_columns(self, columns: list[list[Diagram]]) -> None:
        self._count = _options.whole("resolution", self.resolution, 1, 2**30)
        self.ranges_ = [range_of_values(dgms) if given is None else given for dgms, given
                        in zip(columns, ranges_of("range", self.range, len(columns)))]
        self.grids_ = [np.linspace(low, high, self._count) for low, high in self.ranges_]

    def _endings(self) -> list[str]:
        return [f"{self._ending}{i}" for i in range(self._count)]


class Landscape(_OnGrid):
    """Persistence landscapes [Bubenik 2015], exact at the values of a grid.

    Layer k at t is the k-th largest of max(0, min(t - birth, death - t)) over the bars.

    Parameters
    ----------
    layers : int
        The number of layers.
    resolution : int
        Number of values of the grid, including both ends of the range.
    range : pair of float or list of pairs, optional
        The ends of the grid: one range for all diagrams of a sample, or one for each of them.
        Default: the least and the largest finite value in the fitted samples. Values outside the
        range are ignored.
    infinity : {"keep", "error", "drop"} or float
        What to do with a bar that never dies: "keep" lets it grow for ever, "error" raises an
        error, "drop" leaves the bar out, and with a number the bar dies at this value.
    height : {"tent", "euclidean"}
        The height of a bar. "tent": half its length, which is the height of its tent. "euclidean":
        √2 times as much, which is the Euclidean distance of (birth, death) from the diagonal, as in
        GUDHI.

    Attributes
    ----------
    ranges_ : list of pair of float
        The range of each diagram of a sample. ``range=ranges_`` gives another transformer the same
        grid.
    grids_ : list of ndarray
        The values of the grid of each diagram.

    Examples
    --------
    >>> ph.sklearn.Landscape(layers=1, resolution=5).fit_transform([[[0, 2]], [[1, 2]]])
    array([[0. , 0.5, 1. , 0.5, 0. ],
           [0. , 0. , 0. , 0.5, 0. ]])
    """

    _may_keep = True

    def __init__(self, layers: int = 5, resolution: int = 100, range: Any = None,
                 infinity: float | str = "keep", height: str = "tent") -> None:
        self.layers = layers
        self.resolution = resolution
        self.range = range
        self.infinity = infinity
        self.height = height

    def _check(self) -> None:
        _options.choice("height", self.height, HEIGHTS)

    def _fit_columns(self, columns: list[list[Diagram]]) -> None:
        self._layers = _options.whole("layers", self.layers, 1, 2**20)
        super()._fit_columns(columns)

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return landscape(dgm, self._layers, self.ranges_[place], self._count, self.height)

    def _endings(self) -> list[str]:
        return [f"layer{k}_{i}" for k in range(self._layers) for i in range(self._count)]


class Silhouette(_OnGrid):
    """Silhouettes [Chazal et al. 2014]: one curve for all bars, exact at the values of a grid.

    At t, it is the mean of max(0, min(t - birth, death - t)) over the bars, weighted by lengths to
    a power.

    Parameters
    ----------
    power : float
        Exponent of the lengths; 0: all bars have the same weight, as in GUDHI.
    resolution : int
        Number of values of the grid, including both ends of the range.
    range : pair of float or list of pairs, optional
        The ends of the grid: one range for all diagrams of a sample, or one for each of them.
        Default: the least and the largest finite value in the fitted samples.
    infinity : {"error", "drop"} or float
        What to do with a bar that never dies: "error" raises an error, "drop" leaves the bar out,
        and with a number the bar dies at this value.
    height : {"tent", "euclidean"}
        The height of a bar. "tent": half its length, which is the height of its tent. "euclidean":
        √2 times as much, which is the Euclidean distance of (birth, death) from the diagonal, as in
        GUDHI.

    Attributes
    ----------
    ranges_ : list of pair of float
        The range of each diagram of a sample. ``range=ranges_`` gives another transformer the same
        grid.
    grids_ : list of ndarray
        The values of the grid of each diagram.

    Examples
    --------
    >>> ph.sklearn.Silhouette(resolution=5).fit_transform([[[0, 2], [2, 4]], [[0, 4]]])
    array([[0. , 0.5, 0. , 0.5, 0. ],
           [0. , 1. , 2. , 1. , 0. ]])
    """

    _ending = "silhouette"

    def __init__(self, power: float = 1.0, resolution: int = 100, range: Any = None,
                 infinity: float | str = "error", height: str = "tent") -> None:
        self.power = power
        self.resolution = resolution
        self.range = range
        self.infinity = infinity
        self.height = height

    def _check(self) -> None:
        _options.choice("height", self.height, HEIGHTS)

    def _fit_columns(self, columns: list[list[Diagram]]) -> None:
        self._power = checked_power("power", self.power)
        super()._fit_columns(columns)

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return silhouette(dgm, self._power, self.ranges_[place], self._count, self.height)


class BettiCurve(_OnGrid):
    """The number of bars alive at each value of a grid.

    Parameters
    ----------
    resolution : int
        Number of values of the grid, including both ends of the range.
    range : pair of float or list of pairs, optional
        The ends of the grid: one range for all diagrams of a sample, or one for each of them.
        Default: the least and the largest finite value in the fitted samples.
    infinity : {"keep", "error", "drop"} or float
        What to do with a bar that never dies: "keep" lets it live for ever, "error" raises an
        error, "drop" leaves the bar out, and with a number the bar dies at this value.

    Attributes
    ----------
    ranges_ : list of pair of float
        The range of each diagram of a sample. ``range=ranges_`` gives another transformer the same
        grid.
    grids_ : list of ndarray
        The values of the grid of each diagram.

    Examples
    --------
    >>> ph.sklearn.BettiCurve(resolution=3).fit_transform([[[0, 2]], [[0, 2], [1, np.inf]]])
    array([[1., 1., 0.],
           [1., 2., 1.]])
    """

    _may_keep = True
    _ending = "betti"

    def __init__(self, resolution: int = 100, range: Any = None,
                 infinity: float | str = "keep") -> None:
        self.resolution = resolution
        self.range = range
        self.infinity = infinity

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return betti_curve(dgm, self.ranges_[place], self._count)


class LifeEntropy(_OnGrid):
    """The entropy of the bars that are alive at each value of a grid [Atienza et al. 2020].

    It is the sum of -p log p over the bars with birth <= t < death, where p is the share of a bar
    in the sum of the lengths of all bars of the diagram.

    Parameters
    ----------
    resolution : int
        Number of values of the grid, including both ends of the range.
    range : pair of float or list of pairs, optional
        The ends of the grid: one range for all diagrams of a sample, or one for each of them.
        Default: the least and the largest finite value in the fitted samples.
    infinity : {"error", "drop"} or float
        What to do with a bar that never dies: "error" raises an error, "drop" leaves the bar out,
        and with a number the bar dies at this value.
    unit : {"nats", "bits"}
        Natural logarithms, or logarithms to the base 2.
    normalised : bool
        If True, the values are divided by their sum, as in GUDHI.

    Attributes
    ----------
    ranges_ : list of pair of float
        The range of each diagram of a sample. ``range=ranges_`` gives another transformer the same
        grid.
    grids_ : list of ndarray
        The values of the grid of each diagram.

    Examples
    --------
    >>> life = ph.sklearn.LifeEntropy(resolution=3, unit="bits")
    >>> life.fit_transform([[[0, 1], [1, 2]], [[0, 2]]])
    array([[0.5, 0.5, 0. ],
           [0. , 0. , 0. ]])
    """

    _ending = "life"

    def __init__(self, resolution: int = 100, range: Any = None, infinity: float | str = "error",
                 unit: str = "nats", normalised: bool = False) -> None:
        self.resolution = resolution
        self.range = range
        self.infinity = infinity
        self.unit = unit
        self.normalised = normalised

    def _check(self) -> None:
        checked_entropy(self.unit, self.normalised, (True, False))

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return life_entropy(dgm, self.ranges_[place], self._count, self.unit, self.normalised)
