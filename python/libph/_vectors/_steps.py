# SPDX-License-Identifier: MIT
"""Exact functions of a real number: step functions and piecewise linear functions."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _arrays, _core
from .._errors import DataError


@dataclass(frozen=True, eq=False)
class StepFunction:
    """A step function with integer values, such as an Euler curve or a Betti curve.

    It is 0 before ``at[0]``, and ``value[i]`` from ``at[i]`` up to, but not including, ``at[i +
    1]``. Call it with a number or an array, without NaN.

    Attributes
    ----------
    at : ndarray
        The values at which it changes, ascending.
    value : ndarray
        The value from each of these points on.

    Examples
    --------
    >>> curve = ph.rips([[0], [1], [3]]).betti_function(0)
    >>> curve.at, curve.value
    (array([0., 1., 2.]), array([3, 2, 1]))
    >>> curve(1.5), curve([-1, 0, 5])
    (2, array([0, 3, 1]))
    """

    at: NDArray[np.float64]
    value: NDArray[np.int64]

    @classmethod
    def _of(cls, blocks: tuple[_core.Block, _core.Block]) -> StepFunction:
        return cls(*(_frozen(block) for block in blocks))

    @overload
    def __call__(  # type: ignore[misc]  # a number is also array_like; the first match counts
            self, t: float) -> int: ...
    @overload
    def __call__(self, t: ArrayLike) -> NDArray[np.int64]: ...

    def __call__(self, t: Any) -> Any:
        padded = np.concatenate([[0], self.value])
        values = padded[np.searchsorted(self.at, _places("t", t), side="right")]
        return int(values) if np.ndim(values) == 0 else values

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, StepFunction):
            return NotImplemented
        return np.array_equal(self.at, other.at) and np.array_equal(self.value, other.value)

    def __hash__(self) -> int:
        return hash((self.at.tobytes(), self.value.tobytes()))

    def __repr__(self) -> str:
        return f"StepFunction({_what('change', self.at)})"


@dataclass(frozen=True, eq=False)
class PiecewiseLinear:
    """A continuous function that is linear between its critical points, such as a layer of a
    landscape.

    It is 0 before the first critical point and after the last. Call it with a number or an array,
    without NaN.

    Attributes
    ----------
    at : ndarray
        The critical points, ascending.
    value : ndarray
        The values at the critical points.

    Examples
    --------
    >>> first, = ph.rips([[0], [2]]).exact_landscape(0, infinity="drop")
    >>> first.at, first.value
    (array([0., 1., 2.]), array([0., 1., 0.]))
    >>> first(1.5), first([-1, 1])
    (0.5, array([0., 1.]))
    """

    at: NDArray[np.float64]
    value: NDArray[np.float64]

    @classmethod
    def _of(cls, blocks: tuple[_core.Block, _core.Block], factor: float) -> PiecewiseLinear:
        at, value = (np.asarray(block) for block in blocks)
        return cls(_frozen(at), _frozen(value * factor))

    @overload
    def __call__(self, t: float) -> float: ...  # type: ignore[misc]
    @overload
    def __call__(self, t: ArrayLike) -> NDArray[np.float64]: ...

    def __call__(self, t: Any) -> Any:
        values = np.interp(_places("t", t), self.at, self.value, left=0.0, right=0.0)
        return float(values) if np.ndim(values) == 0 else values

    def __repr__(self) -> str:
        return f"PiecewiseLinear({_what('critical point', self.at)})"


def _places(name: str, t: Any) -> NDArray[np.float64]:
    """The points at which a function is evaluated, without NaN."""
    numbers = _arrays.as_float64(_arrays.as_array(t, name), name)
    refuse_nan(name, numbers)
    return numbers


def refuse_nan(name: str, numbers: NDArray[np.float64]) -> None:
    """Raises a DataError with the place of the first NaN, if there is one."""
    wrong = np.isnan(numbers)
    if wrong.any():
        place = "" if not numbers.ndim else _arrays.place_of(
            [int(i) for i in np.argwhere(wrong)[0]]) + ": "
        raise DataError(f"{name}: {place}found nan, expected a number")


def _frozen(data: Any) -> NDArray[Any]:
    array = np.asarray(data)
    array.flags.writeable = False
    return array


def _what(name: str, at: NDArray[np.float64]) -> str:
    if not len(at):
        return f"no {name}s"
    ends = f" at {at[0]:g}" if len(at) == 1 else f"s from {at[0]:g} to {at[-1]:g}"
    return f"{len(at)} {name}{ends}"
