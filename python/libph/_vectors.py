# SPDX-License-Identifier: MIT
"""Vectors of diagrams: images, landscapes, Betti curves, entropies, lengths.

A diagram is an array (k, 2) of rows birth, death. What stands here is exact, and knows nothing of
where diagrams come from: `Barcode` and `libph.sklearn` share it.
"""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _options
from ._errors import DataError, UsageError

Diagram = NDArray[np.float64]
Range = tuple[float, float]
Infinity = Union[float, str]

_BLOCK = 2**22  # numbers that are made at a time
_BANDWIDTH = 1 / 20  # of the longer range


def as_diagram(data: Any, name: str) -> Diagram:
    """Rows birth, death of numbers with birth <= death, none born at an infinite value."""
    array = _arrays.as_array(data, name)
    if array.size == 0 and array.ndim < 3:
        return np.empty((0, 2))
    if array.ndim != 2 or array.shape[1] != 2:
        raise UsageError(f"{name}: found an array of shape {array.shape}, expected rows birth, "
                         "death")
    dgm = _arrays.as_float64(array, name)
    wrong = ~(dgm[:, 0] <= dgm[:, 1])
    if wrong.any():
        i = int(np.argmax(wrong))
        raise DataError(f"{name}: row {i}: found birth {dgm[i, 0]} and death {dgm[i, 1]}, expected "
                        "birth <= death")
    endless = np.isinf(dgm[:, 0])
    if endless.any():
        i = int(np.argmax(endless))
        raise DataError(f"{name}: row {i}: found birth {dgm[i, 0]}, expected a finite number")
    return dgm


def checked_infinity(infinity: Any, may_keep: bool) -> Infinity:
    """What becomes of deaths at infinity: "error", "drop", "keep" if it is defined, a number."""
    words = ["error", "drop"] + ["keep"] * may_keep
    if isinstance(infinity, str):
        if infinity not in words:
            raise _options.refuse("infinity", infinity, ", ".join(map(repr, words)) + " or a number")
        return infinity
    number = _options.real("infinity", infinity, ", ".join(map(repr, words)) + " or a number")
    if math.isinf(number):
        raise _options.refuse("infinity", infinity, "a finite number")
    return number


def settled(dgm: Diagram, infinity: Infinity, name: str) -> Diagram:
    """The diagram with its infinite deaths as `infinity` says."""
    endless = np.isinf(dgm[:, 1])
    if infinity == "keep" or not endless.any():
        return dgm
    if infinity == "error":
        raise UsageError(f"{name}: row {int(np.argmax(endless))}: found a bar that never dies; "
                         "infinity='drop' leaves such bars out, infinity=NUMBER is their death")
    if infinity == "drop":
        kept: Diagram = dgm[~endless]
        return kept
    latest = float(dgm[endless, 0].max())
    if isinstance(infinity, str) or latest > infinity:
        raise UsageError(f"infinity: found {infinity}, expected at least {latest}, the birth of a "
                         "bar that never dies")
    return np.column_stack([dgm[:, 0], np.where(endless, infinity, dgm[:, 1])])


# ---- ranges


def checked_range(name: str, value: Any) -> Range:
    """Two finite numbers, the first below the second."""
    expected = "two finite numbers, the first below the second"
    try:
        low, high = (_options.real(name, number) for number in value)
    except (TypeError, ValueError):
        raise _options.refuse(name, value, expected) from None
    if not -math.inf < low < high < math.inf:
        raise _options.refuse(name, value, expected)
    return low, high


def widened(low: float, high: float, width: float = 1.0) -> Range:
    """The range; of one number a range of a width around it, of none (inf, -inf) [0, width]."""
    if low > high:
        return 0.0, width
    if low < high:
        return low, high
    half = max(width / 2, abs(low) * 2**-40)  # or rounding would swallow it
    return low - half, high + half


def range_of_values(dgms: Sequence[Diagram]) -> Range:
    """From the least to the largest finite number in the diagrams."""
    low, high = math.inf, -math.inf
    for dgm in dgms:
        finite = dgm[np.isfinite(dgm)]
        if finite.size:
            low, high = min(low, float(finite.min())), max(high, float(finite.max()))
    return widened(low, high)


def ranges_of_image(dgms: Sequence[Diagram], births: Range | None, lengths: Range | None
                    ) -> tuple[Range, Range]:
    """Ranges of births and persistence. Those that are None: all births, and 0 to the longest."""
    joined = np.concatenate([np.empty((0, 2)), *dgms])
    if lengths is None:
        longest = float((joined[:, 1] - joined[:, 0]).max()) if len(joined) else 0.0
        lengths = 0.0, longest or 1.0
    if births is None:
        low, high = (float(joined[:, 0].min()), float(joined[:, 0].max())) if len(joined) else \
            (math.inf, -math.inf)
        births = widened(low, high, lengths[1] - lengths[0])
    return births, lengths


def checked_resolution(resolution: Any) -> tuple[int, int]:
    """Pixels along births and persistence: two numbers, or one for both."""
    try:
        pair = tuple(resolution)
    except TypeError:
        pair = (resolution, resolution)
    if len(pair) != 2:
        raise _options.refuse("resolution", resolution, "a whole number, or two")
    return (_options.whole("resolution", pair[0], 1, 2**20),
            _options.whole("resolution", pair[1], 1, 2**20))


def default_bandwidth(births: Range, lengths: Range) -> float:
    """A twentieth of the longer range."""
    return _BANDWIDTH * max(births[1] - births[0], lengths[1] - lengths[0])


# ---- vectors


def _erf(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """NumPy has none. Beyond 6 it is 1 to the last bit."""
    values = np.sign(x)
    near = np.abs(x) < 6
    values[near] = [math.erf(v) for v in x[near].tolist()]
    return values


def _mass(centres: NDArray[np.float64], span: Range, count: int, bandwidth: float
          ) -> NDArray[np.float64]:
    """Of a normal distribution around each centre its share in each of `count` pixels."""
    edges = np.linspace(*span, count + 1)
    values = _erf((edges - centres[:, None]) / (bandwidth * math.sqrt(2)))
    return np.diff(values, axis=1) / 2


def image(dgm: Diagram, bandwidth: float, resolution: tuple[int, int], births: Range, lengths: Range,
          weight_power: float) -> NDArray[np.float64]:
    """The persistence image [Adams et al. 2017], a row for each interval of persistence.

    Each bar is a normal distribution around (birth, persistence), times its persistence to the
    power of `weight_power`. A pixel has the integral over it.
    """
    persistence = dgm[:, 1] - dgm[:, 0]
    total = np.zeros((resolution[1], resolution[0]))
    step = max(1, _BLOCK // (sum(resolution) + 2))
    for first in range(0, len(dgm), step):
        part = slice(first, first + step)
        along_births = _mass(dgm[part, 0], births, resolution[0], bandwidth)
        along_lengths = _mass(persistence[part], lengths, resolution[1], bandwidth)
        total += (along_lengths * persistence[part, None]**weight_power).T @ along_births
    return total


def landscape(dgm: Diagram, layers: int, grid: NDArray[np.float64]) -> NDArray[np.float64]:
    """The first persistence landscapes [Bubenik 2015] at the values of a grid, a row each.

    Landscape k at t is the k-th largest of max(0, min(t - birth, death - t)).
    """
    values = np.zeros((layers, len(grid)))
    found = min(layers, len(dgm))
    if found == 0:
        return values
    step = max(1, _BLOCK // len(dgm))
    for first in range(0, len(grid), step):
        t = grid[first:first + step, None]
        tents = np.minimum(t - dgm[:, 0], dgm[:, 1] - t)
        largest = np.sort(np.partition(tents, len(dgm) - found)[:, len(dgm) - found:])
        values[:found, first:first + step] = np.maximum(largest[:, ::-1].T, 0)
    return values


def betti_curve(dgm: Diagram, grid: NDArray[np.float64]) -> NDArray[np.int64]:
    """How many bars live at each value of a grid."""
    born = np.searchsorted(np.sort(dgm[:, 0]), grid, side="right")
    died = np.searchsorted(np.sort(dgm[:, 1]), grid, side="right")
    return born - died


def entropy(dgm: Diagram) -> float:
    """The persistent entropy, in nats: of the shares of finite bars in the sum of their lengths."""
    lengths = dgm[:, 1] - dgm[:, 0]
    lengths = lengths[np.isfinite(lengths) & (lengths > 0)]
    if not len(lengths):
        return 0.0
    share = lengths / lengths.sum()
    return 0.0 - float((share * np.log(share)).sum())


def longest(dgm: Diagram, count: int) -> NDArray[np.float64]:
    """The largest lengths, descending; 0 where there are no more bars."""
    lengths = np.sort(dgm[:, 1] - dgm[:, 0])[::-1][:count]
    return np.concatenate([lengths, np.zeros(count - len(lengths))])


# ---- of barcodes


class Summaries:
    """What a `Barcode` says in numbers: see there for `dgm`."""

    __slots__ = ()

    if TYPE_CHECKING:
        @property
        def _top_dim(self) -> int: ...
        def dgm(self, dim: int) -> Diagram: ...

    def betti(self, t: float) -> NDArray[np.int64]:
        """The Betti numbers at a value: how many bars of each dimension live."""
        return self.betti_curve([_options.real("t", t)])[:, 0]

    def betti_curve(self, grid: ArrayLike) -> NDArray[np.int64]:
        """The Betti numbers at each value of a grid, a row for each dimension.

        >>> ph.rips([[0], [1], [3]]).betti_curve([0, 1, 2])
        array([[3, 2, 1],
               [0, 0, 0]])
        """
        values = _arrays.as_values(grid, "grid")
        curves = np.empty((self._top_dim + 1, len(values)), dtype=np.int64)
        for dim in range(self._top_dim + 1):
            curves[dim] = betti_curve(self.dgm(dim), values)
        return curves

    def entropy(self, dim: int) -> float:
        """The persistent entropy of a dimension: of the lengths of bars that die, in nats."""
        return entropy(self.dgm(dim))

    def image(self, dim: int, *, bandwidth: float | None = None, resolution: Any = 20,
              birth_range: Any = None, persistence_range: Any = None, weight_power: float = 1.0,
              infinity: float | str = "error") -> NDArray[np.float64]:
        """The persistence image of a dimension [Adams et al. 2017].

        Each bar is a normal distribution around the point (birth, persistence), times a weight. A
        pixel has the integral over it, to the last digits.

        Parameters
        ----------
        dim : int
            The dimension of the bars.
        bandwidth : float, optional
            The standard deviation, in the unit of the values. Default: a twentieth of the longer
            range.
        resolution : int or pair of int
            How many pixels along births, and along persistence.
        birth_range, persistence_range : pair of float, optional
            What the image shows. Default: from the least birth to the largest, and from 0 to the
            largest persistence, of these bars. Give both where images are to be compared.
        weight_power : float
            The weight is the persistence to this power; 0: all bars weigh 1.
        infinity : {"error", "drop"} or float
            What a bar that never dies is: an error, left out, or one that dies at this value.

        Returns
        -------
        ndarray
            A row for each interval of persistence, ascending, a column for each of births.

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
        power = _options.real("weight_power", weight_power, "a number, at least 0", 0)
        dgm = self._settled(dim, infinity, may_keep=False)
        births, lengths = ranges_of_image([dgm], births, lengths)
        width = default_bandwidth(births, lengths) if bandwidth is None else \
            _options.positive("bandwidth", bandwidth)
        return image(dgm, width, pixels, births, lengths, power)

    def landscape(self, dim: int, *, layers: int = 5, resolution: int = 100, range: Any = None,
                  infinity: float | str = "keep") -> NDArray[np.float64]:
        """The persistence landscape of a dimension [Bubenik 2015], exact at the values of a grid.

        Layer k at t is the k-th largest of max(0, min(t - birth, death - t)) over the bars.

        Parameters
        ----------
        dim : int
            The dimension of the bars.
        layers : int
            How many.
        resolution : int
            How many values the grid has, both ends of the range among them.
        range : pair of float, optional
            From where to where. Default: from the least finite value of these bars to the largest.
            Give it where landscapes are to be compared.
        infinity : {"keep", "error", "drop"} or float
            What a bar that never dies is: one that grows for ever, an error, left out, or one that
            dies at this value.

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
        values = _options.whole("resolution", resolution, 1, 2**30)
        dgm = self._settled(dim, infinity, may_keep=True)
        low, high = range_of_values([dgm]) if range is None else \
            checked_range("range", range)
        return landscape(dgm, count, np.linspace(low, high, values))

    def _settled(self, dim: int, infinity: Any, may_keep: bool) -> NDArray[np.float64]:
        """The bars of a dimension, finite if they are to be."""
        rule = checked_infinity(infinity, may_keep)
        return settled(as_diagram(self.dgm(dim), "bars"), rule, "bars")
