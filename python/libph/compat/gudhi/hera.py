# SPDX-License-Identifier: MIT
"""GUDHI's module hera: its distances between diagrams, computed exactly."""
from __future__ import annotations

import math
from typing import Any

import numpy as np

from ... import _arrays, _distances, _options
from ..._errors import UsageError

__all__ = ["bottleneck_distance", "wasserstein_distance"]


class _WidthError(UsageError, TypeError):
    """The rows of a diagram are not pairs (birth, death). GUDHI raises TypeError for it."""


@_options.with_hints
def bottleneck_distance(X: Any, Y: Any, delta: float = 0.01) -> float:
    """The bottleneck distance between two diagrams.

    Parameters
    ----------
    X, Y : array_like
        Rows birth, death.
    delta : float
        The allowed error. It has no effect, because libph is exact.

    Returns
    -------
    float

    Raises
    ------
    UsageError, DataError
        Both are ValueErrors; the error for rows of another width is also a TypeError.
    """
    _options.real("delta", delta, "a number of at least 0", 0)
    _check_width(X, Y)
    distance: float = _distances.bottleneck(X, Y)
    return distance


@_options.with_hints
def wasserstein_distance(X: Any, Y: Any, order: float = 1.0, internal_p: float = float("inf"),
                         delta: float = 0.01, matching: bool = False) -> Any:
    """The Wasserstein distance between two diagrams.

    Parameters
    ----------
    X, Y : array_like
        Rows birth, death.
    order : float
        p: at least 1, finite.
    internal_p : float
        The norm that measures a pair, at least 1.
    delta : float
        The allowed relative error. It has no effect, because libph is exact.
    matching : bool
        If True, the matching is returned as well.

    Returns
    -------
    float or (float, ndarray)
        The matching has rows of an index in `X` and an index in `Y`; -1 is the diagonal. It is None
        if the distance is infinite.

    Raises
    ------
    UsageError, DataError
        Both are ValueErrors; the error for rows of another width is also a TypeError.
    """
    _options.real("delta", delta, "a number of at least 0", 0)
    _check_width(X, Y)
    if not _options.flag("matching", matching):
        return _distances.wasserstein(X, Y, order=order, ground=internal_p)
    found = _distances.wasserstein_matching(X, Y, order=order, ground=internal_p)
    return found.distance, (None if math.isinf(found.distance) else found.pairs.astype(np.int32))


def _check_width(X: Any, Y: Any) -> None:
    for name, dgm in (("diagram 1", X), ("diagram 2", Y)):
        array = _arrays.as_array(dgm, name)
        if array.shape != (0,) and (array.ndim != 2 or array.shape[1] != 2):
            raise _WidthError(f"{name}: found an array of shape {array.shape}, expected rows "
                              "(birth, death)")
