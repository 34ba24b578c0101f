# SPDX-License-Identifier: MIT
"""GUDHI's module hera: its bottleneck distance, exact."""
from __future__ import annotations

from typing import Any, NoReturn

from ... import _arrays, _diagrams, _options
from ..._errors import NotBuiltIn, UsageError

__all__ = ["bottleneck_distance", "wasserstein_distance"]


class _WidthError(UsageError, TypeError):
    """GUDHI has a TypeError where rows are not birth, death."""


def bottleneck_distance(X: Any, Y: Any, delta: float = 0.01) -> float:
    """The bottleneck distance of two diagrams.

    Parameters
    ----------
    X, Y : array_like
        Rows birth, death.
    delta : float
        The error that is allowed; there is none.

    Returns
    -------
    float

    Raises
    ------
    UsageError, DataError
        Both are a ValueError; the one for rows of another width is a TypeError, too.
    """
    _options.real("delta", delta, "a number of at least 0", 0)
    for name, dgm in (("diagram 1", X), ("diagram 2", Y)):
        array = _arrays.as_array(dgm, name)
        if array.shape != (0,) and (array.ndim != 2 or array.shape[1] != 2):
            raise _WidthError(f"{name}: found an array of shape {array.shape}, expected rows "
                              "birth, death")
    distance: float = _diagrams.bottleneck(X, Y)
    return distance


def wasserstein_distance(*arguments: Any, **options: Any) -> NoReturn:
    """Not built in: GUDHI has it."""
    raise NotBuiltIn("wasserstein_distance: libph has no such distance; GUDHI has it")
