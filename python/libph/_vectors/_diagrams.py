# SPDX-License-Identifier: MIT
"""Diagrams: arrays (k, 2) of rows birth, death."""
from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from .. import _arrays, _options
from .._errors import DataError, UsageError

Diagram = NDArray[np.float64]
Infinity = Union[float, str]


def as_diagram(data: Any, name: str) -> Diagram:
    """Rows birth, death with birth <= death and finite births."""
    array = _arrays.as_array(data, name)
    if array.size == 0 and array.ndim < 3:
        return np.empty((0, 2))
    if array.ndim != 2 or array.shape[1] != 2:
        raise UsageError(f"{name}: found an array of shape {array.shape}, expected rows "
                         "(birth, death)")
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


def lengths(births: NDArray[np.float64], deaths: NDArray[np.float64]) -> NDArray[np.float64]:
    """The length of each bar: 0 for a bar that dies at its birth, even at -inf."""
    lengths = np.zeros(len(births))
    np.subtract(deaths, births, out=lengths, where=deaths != births)
    return lengths


def checked_infinity(infinity: Any, may_keep: bool) -> Infinity:
    """The treatment of infinite deaths: "error", "drop", "keep" where it is defined, or a
    number."""
    words = ["error", "drop"] + ["keep"] * may_keep
    if isinstance(infinity, str):
        if infinity not in words:
            raise _options.refuse("infinity", infinity, ", ".join(map(repr, words)) + " or a number")
        return infinity
    number = _options.real("infinity", infinity, ", ".join(map(repr, words)) + " or a number")
    if math.isinf(number):
        raise _options.refuse("infinity", infinity, "a finite number")
    return number


def settled(dgm: Diagram, infinity: Infinity, name: str,
            other_way: Callable[[Diagram], str] | None = None) -> Diagram:
    """The diagram, with infinite deaths treated as `infinity` specifies.

    The message of the error names what `other_way` returns before the values of `infinity`.
    """
    endless = np.isinf(dgm[:, 1])
    if infinity == "keep" or not endless.any():
        return dgm
    if infinity == "error":
        ways = [other_way(dgm) if other_way else "", "infinity='drop' leaves such bars out, "
                "infinity=NUMBER sets their death"]
        raise UsageError(f"{name}: row {int(np.argmax(endless))}: found a bar that never dies; "
                         + "; ".join(filter(None, ways)))
    if infinity == "drop":
        kept: Diagram = dgm[~endless]
        return kept
    latest = float(dgm[endless, 0].max())
    if isinstance(infinity, str) or latest > infinity:
        raise UsageError(f"infinity: found {infinity}, expected at least {latest}, the birth of a "
                         "bar that never dies")
    return np.column_stack([dgm[:, 0], np.where(endless, infinity, dgm[:, 1])])
