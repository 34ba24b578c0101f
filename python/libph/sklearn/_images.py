# SPDX-License-Identifier: MIT
"""Persistence images of diagrams."""
from __future__ import annotations

from typing import Any

from .. import _options
from .._vectors import Diagram
from .._vectors._functions import ORIENTATIONS, PIXELS, checked_power, image
from .._vectors._ranges import checked_resolution, default_bandwidth, ranges_of_image
from ._vectoriser import Vectoriser, ranges_of


class PersistenceImage(Vectoriser):
    """Persistence images [Adams et al. 2017]: diagrams as pictures, smoothed and weighted.

    Each bar is a normal distribution around the point (birth, persistence), times a weight. The
    value of a pixel is the integral over the pixel, exact to the last digits. Bars of length 0 do
    not count.

    Parameters
    ----------
    bandwidth : float, optional
        The standard deviation, in the unit of the values. Default: a twentieth of the longer range.
    resolution : int or pair of int
        Number of pixels along births, and along persistence.
    birth_range, persistence_range : pair of float or list of pairs, optional
        The ranges that the image covers: one for all diagrams of a sample, or one for each of them.
        Default: from the least birth to the largest, and from 0 to the largest persistence, of the
        fitted samples. Values outside the range are ignored.
    weight_power : float
        The weight is the persistence to this power; 0: all weights are 1.
    infinity : {"error", "drop"} or float
        What to do with a bar that never dies: "error" raises an error, "drop" leaves the bar out,
        and with a number the bar dies at this value.
    pixel : {"integral", "density"}
        The value of a pixel: the integral over it, or the density at its centre, as in GUDHI.
    orientation : {"ascending", "descending", "births"}
        The meaning of the rows of an image. "ascending": intervals of persistence, ascending.
        "descending": the same, descending, as in giotto-tda. "births": intervals of births, as in
        persim.

    Attributes
    ----------
    birth_ranges_ : list of pair of float
        The range of births of each diagram of a sample.
    persistence_ranges_ : list of pair of float
        The same for persistence.
    bandwidths_ : list of float
        The bandwidth of each diagram of a sample.

    Examples
    --------
    >>> dgms = [[[0, 1]], [[1, 3], [0, 2]]]
    >>> ph.sklearn.PersistenceImage(resolution=(1, 2)).fit_transform(dgms).round(2)
    array([[0.25, 0.25],
           [0.  , 1.  ]])
    """

    def __init__(self, bandwidth: float | None = None, resolution: Any = 20, birth_range: Any = None,
                 persistence_range: Any = None, weight_power: float = 1.0,
                 infinity: float | str = "error", pixel: str = "integral",
                 orientation: str = "ascending") -> None:
        self.bandwidth = bandwidth
        self.resolution = resolution
        self.birth_range = birth_range
        self.persistence_range = persistence_range
        self.weight_power = weight_power
        self.infinity = infinity
        self.pixel = pixel
        self.orientation = orientation

    def _check(self) -> None:
        _options.choice("pixel", self.pixel, PIXELS)
        _options.choice("orientation", self.orientation, ORIENTATIONS)

    def _fit_columns(self, columns: list[list[Diagram]]) -> None:
        self._pixels = checked_resolution(self.resolution)
        self._power = checked_power("weight_power", self.weight_power)
        births = ranges_of("birth_range", self.birth_range, len(columns))
        lengths = ranges_of("persistence_range", self.persistence_range, len(columns))
        pairs = [ranges_of_image(dgms, b, p)
                 for dgms, b, p in zip(columns, births, lengths)]
        self.birth_ranges_ = [pair[0] for pair in pairs]
        self.persistence_ranges_ = [pair[1] for pair in pairs]
        self.bandwidths_ = [
            default_bandwidth(*pair) if self.bandwidth is None else
            _options.positive("bandwidth", self.bandwidth) for pair in pairs]

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return image(dgm, self.bandwidths_[place], self._pixels, self.birth_ranges_[place],
                              self.persistence_ranges_[place], self._power, self.pixel, self.orientation)

    def _endings(self) -> list[str]:
        births, lengths = range(self._pixels[0]), range(self._pixels[1])
        if self.orientation == "births":
            return [f"p{i}_b{j}" for j in births for i in lengths]
        rows = reversed(lengths) if self.orientation == "descending" else lengths
        return [f"p{i}_b{j}" for i in rows for j in births]
