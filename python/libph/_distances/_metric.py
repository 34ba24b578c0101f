# SPDX-License-Identifier: MIT
"""The distance to measure between two diagrams."""
from __future__ import annotations

import math

from .. import _core, _options
from .._errors import UsageError


def metric_of(kind: str, order: float = 1.0, ground: float = math.inf, relative_error: float = 0.0,
              at_most: float = math.inf, directions: int = 50) -> _core.DiagramMetric:
    return _core.DiagramMetric(
        kind, _options.real("order", order, "a number, at least 1"),
        _options.real("ground", ground, "a number, at least 1, or inf"),
        _options.real("relative_error", relative_error, "a number, at least 0", 0),
        _options.real("at_most", at_most, "a number, at least 0", 0),
        _options.whole("directions", directions, 1, 2**31 - 1))


def refuse_options_of_others(distance: str, order: float, ground: float, relative_error: float,
                             directions: int) -> None:
    """Refuses parameters that the distance does not use."""
    for name, value, default, owners in (
            ("order", order, 1.0, ["wasserstein"]), ("ground", ground, math.inf, ["wasserstein"]),
            ("relative_error", relative_error, 0.0, ["wasserstein", "bottleneck"]),
            ("directions", directions, 50, ["sliced_wasserstein"])):
        if value != default and distance not in owners:
            raise UsageError(f"{name}: does nothing for distance={distance!r}, only for "
                             + " and ".join(map(repr, owners)))
