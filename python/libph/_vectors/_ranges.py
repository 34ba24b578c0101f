# SPDX-License-Identifier: MIT
"""Grids and pixels: their checks, and their defaults learned from diagrams."""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from .. import _core, _options
from ._diagrams import Diagram

Range = tuple[float, float]

_BANDWIDTH = 1 / 20  # relative to the longer range


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
    """The range itself; for a single number, a range of some width around it; for no numbers (inf,
    -inf), [0, width]."""
    if low > high:
        return 0.0, width
    if low < high:
        return low, high
    half = max(width / 2, abs(low) * 2**-40)  # otherwise rounding would swallow it
    return low - half, high + half


def range_of_values(dgms: Sequence[Diagram]) -> Range:
    """The range from the least to the largest finite number in the diagrams."""
    return _core.fitted_range(list(dgms))


def ranges_of_image(dgms: Sequence[Diagram], births: Range | None, lengths: Range | None
                    ) -> tuple[Range, Range]:
    """The ranges of births and of persistence. In place of a range, None stands for all births, or
    for persistence from 0 to the longest bar."""
    joined = np.concatenate([np.empty((0, 2)), *dgms])
    joined = joined[joined[:, 0] < joined[:, 1]]  # bars of length 0 do not count
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
    """The default bandwidth: a twentieth of the longer range."""
    return _BANDWIDTH * max(births[1] - births[0], lengths[1] - lengths[0])
