# SPDX-License-Identifier: MIT
"""Vectors of one diagram, whose bars must suit the function.

_core computes them. This module adds the conventions of other packages.
"""
from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import _arrays, _core, _options, _run
from .._errors import DataError, UsageError
from ._diagrams import Diagram
from ._ranges import Range

Vector = NDArray[np.float64]

HEIGHTS = ("tent", "euclidean")
UNITS = ("nats", "bits")
NORMS = (None, "count", "total")
PIXELS = ("integral", "density")
ORIENTATIONS = ("ascending", "descending", "births")

_BLOCK = 2**20  # numbers computed at a time


def _filled(function: Callable[..., None], dgm: Diagram, shape: int | tuple[int, ...],
            *arguments: Any) -> Vector:
    """The array that a function of _core fills."""
    out = _arrays.new_array(shape)
    _run.run(function, dgm, *arguments, out.reshape(-1), options={})
    return out


# ---- numbers


def statistics_names() -> list[str]:
    """The names of the numbers of `statistics`, in order."""
    return _core.statistics_names()


def statistics(dgm: Diagram) -> Vector:
    """The 38 numbers that `statistics_names` lists."""
    return _filled(_core.statistics, dgm, len(statistics_names()))


def checked_entropy(unit: Any, normalised: Any, norms: Sequence[Any]) -> None:
    """Refuses unknown units and norms. Also refuses a unit for a normalised entropy, which has
    none."""
    _options.choice("unit", unit, UNITS)
    _options.choice("normalised", normalised, norms)
    if normalised and unit != "nats":
        raise UsageError(f"unit: found {unit!r}, which does nothing for normalised={normalised!r}: "
                         "such values have no unit")


def entropy(dgm: Diagram, unit: str = "nats", normalised: str | None = None) -> float:
    """The persistent entropy of the finite bars.

    "count": divided by the logarithm of the number of bars; "total": divided by the logarithm of
    the sum of their lengths.
    """
    finite = dgm[np.isfinite(dgm).all(axis=1)]
    value = _run.run(_core.entropy, finite, normalised == "count", options={})
    if normalised == "total" and value > 0:
        total = float((finite[:, 1] - finite[:, 0]).sum())
        if total == 1:
            raise DataError("normalised: found bars whose lengths add up to 1, expected a sum whose "
                            "logarithm is not 0")
        return value / math.log(total)
    return value / math.log(2) if unit == "bits" else value


def longest(dgm: Diagram, count: int) -> Vector:
    """The largest lengths, descending, padded with 0."""
    return _filled(_core.longest_lengths, dgm, count)


# ---- curves


def checked_power(name: str, value: Any) -> float:
    """The exponent of a length."""
    number = _options.real(name, value, "a finite number, at least 0", 0)
    if number == math.inf:
        raise _options.refuse(name, value, "a finite number, at least 0")
    return number


def factor_of(height: str) -> float:
    """The factor by which the heights of tents are multiplied."""
    return math.sqrt(2) if height == "euclidean" else 1.0


def landscape(dgm: Diagram, layers: int, ends: Range, count: int, height: str = "tent") -> Vector:
    """The first persistence landscapes at `count` values between two ends, one row per layer."""
    values = _filled(_core.landscape, dgm, (layers, count), ends, layers)
    return values * factor_of(height)


def silhouette(dgm: Diagram, power: float, ends: Range, count: int, height: str = "tent") -> Vector:
    """The mean of the tents, weighted by lengths to a power."""
    return _filled(_core.silhouette, dgm, count, ends, power) * factor_of(height)


def betti_curve(dgm: Diagram, ends: Range, count: int) -> Vector:
    """The number of bars alive at each value."""
    return _filled(_core.betti_curve, dgm, count, ends)


def life_entropy(dgm: Diagram, ends: Range, count: int, unit: str = "nats",
                 normalised: bool = False) -> Vector:
    """The entropy of the bars that are alive at each value.

    If `normalised`, the values are divided by their sum.
    """
    values = _filled(_core.life_entropy_curve, dgm, count, ends)
    if normalised:
        total = float(values.sum())
        return values / total if total > 0 else values
    return values / math.log(2) if unit == "bits" else values


# ---- images


def image(dgm: Diagram, bandwidth: float, resolution: tuple[int, int], births: Range, lengths: Range,
          weight_power: float, pixel: str = "integral", orientation: str = "ascending") -> Vector:
    """The persistence image [Adams et al. 2017].

    Each bar is a normal distribution around (birth, persistence), times its persistence to the
    power of `weight_power`.
    """
    if pixel == "integral":
        pixels = _filled(_core.persistence_image, dgm, (resolution[1], resolution[0]),
                         (*births, resolution[0]), (*lengths, resolution[1]), bandwidth,
                         weight_power)
    else:
        pixels = _densities(dgm, bandwidth, resolution, births, lengths, weight_power)
    if orientation == "births":
        return np.ascontiguousarray(pixels.T)
    return pixels[::-1] if orientation == "descending" else pixels


def _densities(dgm: Diagram, bandwidth: float, resolution: tuple[int, int], births: Range,
               lengths: Range, weight_power: float) -> Vector:
    """The sum of the densities at the centre of each pixel."""
    dgm = dgm[dgm[:, 0] < dgm[:, 1]]
    persistence = dgm[:, 1] - dgm[:, 0]
    pixels = _arrays.new_array((resolution[1], resolution[0]))
    pixels[:] = 0
    step = max(1, _BLOCK // sum(resolution))
    for first in range(0, len(dgm), step):
        part = slice(first, first + step)
        along_births = _density(dgm[part, 0], births, resolution[0], bandwidth)
        along_lengths = _density(persistence[part], lengths, resolution[1], bandwidth)
        pixels += (along_lengths * persistence[part, None]**weight_power).T @ along_births
    return pixels


def _density(centres: Vector, span: Range, count: int, bandwidth: float) -> Vector:
    """The density of a normal distribution around each number, in the middle of each interval."""
    width = (span[1] - span[0]) / count
    middles = span[0] + width * (np.arange(count) + 0.5)
    values: Vector = np.exp(-((middles - centres[:, None]) / bandwidth)**2 / 2)
    return values / (bandwidth * math.sqrt(2 * math.pi))


# ---- learned from a batch


def fit_atol(dgms: list[Diagram], centres: int, seed: int) -> tuple[Vector, Vector]:
    """Learns centres, and returns them as rows birth, death, together with their widths."""
    places, widths = _run.run(_core.fit_atol, dgms, centres, seed, 300, options={})
    return np.asarray(places), np.asarray(widths)


def atol(dgm: Diagram, centres: Vector, widths: Vector, contrast: str) -> Vector:
    """Measures how much of a diagram is near each centre."""
    return _filled(_core.atol_vector, dgm, len(widths), centres, widths, contrast)
