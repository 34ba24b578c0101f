# SPDX-License-Identifier: MIT
"""The methods of `Barcode` that return vectors and curves."""
from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _arrays, _core, _options, _run
from ._diagrams import Diagram, as_diagram, checked_infinity, settled
from ._functions import (HEIGHTS, NORMS, ORIENTATIONS, PIXELS, checked_entropy, checked_power,
                         entropy, factor_of, image, landscape, life_entropy, silhouette, statistics,
                         statistics_names)
from ._ranges import (Range, checked_range, checked_resolution, default_bandwidth, range_of_values,
                      ranges_of_image)
from ._steps import PiecewiseLinear, StepFunction, refuse_nan


def _require_room(bars: int) -> None:
    """Refuses a curve of so many bars if it would exceed the limit of the current block."""
    per_bar = 112  # bytes of a bar, its ends while they are sorted, and the steps there
    _arrays.require_room(per_bar * bars, f"the conversion of the {bars} bars may take")


@_options.with_hints
class Summaries:
    """The methods of `Barcode` that summarise it in numbers; `Barcode` defines `dgm`."""

    __slots__ = ()

    if TYPE_CHECKING:
        @property
        def _top_dim(self) -> int: ...
        @property
        def _arrays(self) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]: ...
        def dgm(self, dim: int) -> Diagram: ...
        def __len__(self) -> int: ...

    # ---- numbers

    def statistics(self, dim: int, *, infinity: float | str = "error") -> dict[str, float]:
        """38 numbers that describe the bars of a dimension, a good first choice [Ali et al. 2023].

        For births, deaths, midpoints and lengths: mean, standard deviation, median, interquartile
        range, range, and the 10th, 25th, 75th and 90th percentiles; then the number of bars and
        their entropy in nats. Bars of length 0 do not count. Without bars, all numbers are 0.

        Parameters
        ----------
        dim : int
            The dimension of the bars.
        infinity : {"error", "drop"} or float
            What to do with a bar that never dies: "error" raises an error, "drop" leaves the bar
            out, and with a number the bar dies at this value.

        Returns
        -------
        dict of str to float

        Examples
        --------
        >>> numbers = ph.rips([[0], [1], [3]]).statistics(0, infinity="drop")
        >>> numbers["count"], numbers["length_mean"], round(numbers["entropy"], 4)
        (2.0, 1.5, 0.6365)
        """
        numbers = statistics(self._settled(dim, infinity, may_keep=False))
        return dict(zip(statistics_names(), numbers.tolist()))

    def entropy(self, dim: int, *, unit: str = "nats", normalised: str | None = None) -> float:
        """The persistent entropy of a dimension [Chintakunta et al. 2015]; bars that never die are
        ignored.

        Each bar has a share in the sum of the lengths; the result is the entropy of these shares.

        Parameters
        ----------
        dim : int
            The dimension of the bars.
        unit : {"nats", "bits"}
            Natural logarithms, or logarithms to the base 2, as in giotto-tda.
        normalised : {None, "count", "total"}
            "count": divided by the largest possible value, the logarithm of the number of bars, as
            in persim. "total": divided by the logarithm of the sum of the lengths, as in
            giotto-tda; the result then depends on the unit of the values.

        Returns
        -------
        float

        Examples
        --------
        >>> bars = ph.rips([[0], [1], [2]])
        >>> round(bars.entropy(0), 4), bars.entropy(0, unit="bits")
        (0.6931, 1.0)
        """
        checked_entropy(unit, normalised, NORMS)
        return entropy(self.dgm(dim), unit, normalised)

    # ---- curves

    def betti(self, t: float) -> NDArray[np.int64]:
        """The Betti numbers at a value: the number of bars of each dimension that are alive."""
        return self.betti_curve([_options.real("t", t)])[:, 0]

    def betti_curve(self, grid: ArrayLike) -> NDArray[np.int64]:
        """The Betti numbers at each value of a grid, one row per dimension.

        >>> ph.rips([[0], [1], [3]]).betti_curve([0, 1, 2])
        array([[3, 2, 1],
               [0, 0, 0]])
        """
        values = _arrays.as_values(grid, "grid")
        refuse_nan("grid", values)
        curves = np.empty((self._top_dim + 1, len(values)), dtype=np.int64)
        for dim in range(self._top_dim + 1):
            curves[dim] = self.betti_function(dim)(values)
        # No bar is alive at infinity, where step functions have their last value.
        return np.where(values < math.inf, curves, 0)

    def betti_function(self, dim: int) -> StepFunction:
        """The Betti number of a dimension at any value: the exact curve, with all its steps.

        >>> curve = ph.rips([[0], [1], [3]]).betti_function(0)
        >>> curve.at, curve.value, curve(0.5)
        (array([0., 1., 2.]), array([3, 2, 1]), 3)
        """
        rows = self.dgm(dim)
        _require_room(len(rows))
        return StepFunction._of(_run.run(_core.curve_of_bars, rows, None, options={}))

    def euler_curve(self) -> StepFunction:
        """The Euler characteristic at any value: the alternating sum of the Betti numbers.

        It equals the curve of the complex if the barcode has all dimensions and neither `threshold`
        nor `min_persistence` removed bars. `libph.euler_curve` computes the curve of an image
        directly.

        >>> curve = ph.cubical([[1, 1, 1, 1, 1], [1, 5, 1, 7, 1], [1, 1, 1, 1, 1]]).euler_curve()
        >>> curve.at, curve.value
        (array([1., 5., 7.]), array([-1,  0,  1]))
        """
        _require_room(len(self))
        dims, births, deaths = self._arrays
        return StepFunction._of(_run.run(_core.curve_of_bars, np.column_stack([births, deaths]), dims,
                                         options={}))

    def life_entropy(self, dim: int, *, resolution: int = 100, range: Any = None,
                     infinity: float | str = "error", unit: str = "nats", normalised: bool = False
                     ) -> NDArray[np.float64]:
        """The entropy of the bars that are alive at the values of a grid [Atienza et al. 2020].

        It is the sum of -p log p over the bars with birth <= t < death, where p is the share of a
        bar in the sum of all lengths.

        Parameters
        ----------
        dim : int
            The dimension of the bars.
        resolution : int
            Number of values of the grid, including both ends of the range.
        range : pair of float, optional
            The ends of the grid. Default: the least and the largest finite value of these bars. Set
            the range if curves are to be compared.
        infinity : {"error", "drop"} or float
            What to do with a bar that never dies: "error" raises an error, "drop" leaves the bar
            out, and with a number the bar dies at this value.
        unit : {"nats", "bits"}
            Natural logarithms, or logarithms to the base 2.
        normalised : bool
            If True, the values are divided by their sum, as in GUDHI.

        Returns
        -------
        ndarray

        Examples
        --------
        >>> ph.rips([[0], [1], [2]]).life_entropy(0, resolution=3, range=(0, 2), unit="bits",
        ...                                       infinity="drop")
        array([1., 0., 0.])
        """
        checked_entropy(unit, normalised, (True, False))
        dgm, ends, count = self._on_grid(dim, range, resolution, infinity, may_keep=False)
        return life_entropy(dgm, ends, count, unit, normalised)

    def silhouette(self, dim: int, *, power: float = 1.0, resolution: int = 100, range: Any = None,
                   infinity: float | str = "error", height: str = "tent") -> NDArray[np.float64]:
        """The silhouette of a dimension [Chazal et al. 2014]: one curve for all its bars.

        It is the mean of max(0, min(t - birth, death - t)) over the bars, weighted by lengths to a
        power.

        Parameters
        ----------
        dim : int
            The dimension of the bars.
        power : float
            Exponent of the lengths; 0: all bars have the same weight, as in GUDHI.
        resolution : int
            Number of values of the grid, including both ends of the range.
        range : pair of float, optional
            The ends of the grid. Default: the least and the largest finite value of these bars. Set
            the range if curves are to be compared.
        infinity : {"error", "drop"} or float
            What to do with a bar that never dies: "error" raises an error, "drop" leaves the bar
            out, and with a number the bar dies at this value.
        height : {"tent", "euclidean"}
            The height of a bar. "tent": half its length, which is the height of its tent.
            "euclidean": √2 times as much, which is the Euclidean distance of (birth, death) from
            the diagonal, as in GUDHI.

        Returns
        -------
        ndarray

        Examples
        --------
        >>> bars = ph.rips([[0], [2], [6]])
        >>> bars.silhouette(0, resolution=5, infinity="drop").round(3)
        array([0.   , 1.   , 1.333, 0.667, 0.   ])
        """
        exponent = checked_power("power", power)
        _options.choice("height", height, HEIGHTS)
        dgm, ends, count = self._on_grid(dim, range, resolution, infinity, may_keep=False)
        return silhouette(dgm, exponent, ends, count, height)

    def landscape(self, dim: int, *, layers: int = 5, resolution: int = 100, range: Any = None,
                  infinity: float | str = "keep", height: str = "tent") -> NDArray[np.float64]:
        """The persistence landscape of a dimension [Bubenik 2015], exact at the values of a grid.

        Layer k at t is the k-th largest of max(0, min(t - birth, death - t)) over the bars.

        Parameters
        ----------
        dim : int
            The dimension of the bars.
        layers : int
            The number of layers.
        resolution : int
            Number of values of the grid, including both ends of the range.
        range : pair of float, optional
            The ends of the grid. Default: the least and the largest finite value of these bars. Set
            the range if landscapes are to be compared.
        infinity : {"keep", "error", "drop"} or float
            What to do with a bar that never dies: "keep" lets it grow for ever, "error" raises an
            error, "drop" leaves the bar out, and with a number the bar dies at this value.
        height : {"tent", "euclidean"}
            The height of a bar. "tent": half its length, which is the height of its tent.
            "euclidean": √2 times as much, which is the Euclidean distance of (birth, death) from
            the diagonal, as in GUDHI.

        Returns
        -------
        ndarray
            A row for each layer.

        Examples
        --------
        >>> ph.rips([[0], [2]]).landscape(0, layers=2, resolution=5)
        array([[0. , 0.5, 1. , 1.5, 2. ],
               [0. , 0.5, 1. , 0.5, 0. ]])
        """
        count = _options.whole("layers", layers, 1, 2**20)
        _options.choice("height", height, HEIGHTS)
        dgm, ends, values = self._on_grid(dim, range, resolution, infinity, may_keep=True)
        return landscape(dgm, count, ends, values, height)

    def exact_landscape(self, dim: int, layers: int = 5, *, infinity: float | str = "error",
                        height: str = "tent") -> list[PiecewiseLinear]:
        """The persistence landscape of a dimension with all its critical points.

        Source: Bubenik, Dłotko, A persistence landscapes toolbox for topological statistics, 2017.

        Parameters
        ----------
        dim : int
            The dimension of the bars.
        layers : int
            The largest number of layers; layers that are 0 everywhere are left out.
        infinity : {"error", "drop"} or float
            What to do with a bar that never dies: "error" raises an error, "drop" leaves the bar
            out, and with a number the bar dies at this value.
        height : {"tent", "euclidean"}
            As in `landscape`.

        Returns
        -------
        list of PiecewiseLinear
            A function for each layer.

        Examples
        --------
        >>> layers = ph.rips([[0], [2], [6]]).exact_landscape(0, infinity="drop")
        >>> [layer.at.tolist() for layer in layers]
        [[0.0, 2.0, 4.0], [0.0, 1.0, 2.0]]
        >>> layers[0](1.75)
        1.75
        """
        count = _options.whole("layers", layers, 1, 2**31 - 1)
        _options.choice("height", height, HEIGHTS)
        found = _run.run(_core.exact_landscape, self._settled(dim, infinity, may_keep=False), count,
                         options={})
        return [PiecewiseLinear._of(layer, factor_of(height)) for layer in found]

    # ---- pictures

    def image(self, dim: int, *, bandwidth: float | None = None, resolution: Any = 20,
              birth_range: Any = None, persistence_range: Any = None, weight_power: float = 1.0,
              infinity: float | str = "error", pixel: str = "integral",
              orientation: str = "ascending") -> NDArray[np.float64]:
        """The persistence image of a dimension [Adams et al. 2017].

        Each bar is a normal distribution around the point (birth, persistence), times a weight. The
        value of a pixel is the integral over the pixel, exact to the last digits. Bars of length 0
        do not count.

        Parameters
        ----------
        dim : int
            The dimension of the bars.
        bandwidth : float, optional
            The standard deviation, in the unit of the values. Default: a twentieth of the longer
            range.
        resolution : int or pair of int
            Number of pixels along births, and along persistence.
        birth_range, persistence_range : pair of float, optional
            The ranges that the image covers. Default: from the least birth to the largest, and from
            0 to the largest persistence, of these bars. Set both if images are to be compared.
        weight_power : float
            The weight is the persistence to this power; 0: all weights are 1.
        infinity : {"error", "drop"} or float
            What to do with a bar that never dies: "error" raises an error, "drop" leaves the bar
            out, and with a number the bar dies at this value.
        pixel : {"integral", "density"}
            The value of a pixel: the integral over it, or the density at its centre, as in GUDHI.
        orientation : {"ascending", "descending", "births"}
            The meaning of rows. "ascending": intervals of persistence, ascending. "descending": the
            same, descending, as in giotto-tda. "births": intervals of births, as in persim.

        Returns
        -------
        ndarray
            One row per interval of persistence and one column per interval of births, unless
            `orientation` says otherwise.

        Examples
        --------
        >>> bars = ph.rips([[0, 0], [1, 0], [1, 1], [0, 1]])
        >>> bars.image(1, resolution=1, bandwidth=0.01, birth_range=(0, 2),
        ...            persistence_range=(0, 1)).round(6)
        array([[0.414214]])
        """
        births = None if birth_range is None else checked_range("birth_range", birth_range)
        lengths = None if persistence_range is None else checked_range(
            "persistence_range", persistence_range)
        pixels = checked_resolution(resolution)
        power = checked_power("weight_power", weight_power)
        _options.choice("pixel", pixel, PIXELS)
        _options.choice("orientation", orientation, ORIENTATIONS)
        dgm = self._settled(dim, infinity, may_keep=False)
        births, lengths = ranges_of_image([dgm], births, lengths)
        width = default_bandwidth(births, lengths) if bandwidth is None else \
            _options.positive("bandwidth", bandwidth)
        return image(dgm, width, pixels, births, lengths, power, pixel, orientation)

    # ---- shared helpers

    def _on_grid(self, dim: int, range: Any, resolution: Any, infinity: Any, may_keep: bool
                 ) -> tuple[Diagram, Range, int]:
        """The bars, the ends of the grid, and its number of values."""
        count = _options.whole("resolution", resolution, 1, 2**30)
        dgm = self._settled(dim, infinity, may_keep)
        ends = range_of_values([dgm]) if range is None else checked_range("range", range)
        return dgm, ends, count

    def _settled(self, dim: int, infinity: Any, may_keep: bool) -> Diagram:
        """The bars of a dimension, without infinite ends if `infinity` does not allow them."""
        rule = checked_infinity(infinity, may_keep)
        rows = self.dgm(dim)
        if rule == "drop":  # including bars born at -inf
            rows = rows[np.isfinite(rows).all(axis=1)]
        return settled(as_diagram(rows, "bars"), rule, "bars")
