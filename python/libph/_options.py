# SPDX-License-Identifier: MIT
"""Checks the values of options, with clear error messages.

The checks accept plain values at once, because small computations take no longer than a few checks.
"""
from __future__ import annotations

import functools
import inspect
import math
import numbers
import operator
import os
import re
import sys
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from types import FunctionType
from typing import Any, TypeVar

import numpy as np

from ._errors import UsageError

_Callable = TypeVar("_Callable", bound=Callable[..., Any])
_BOOLS = (bool, np.bool_)
_UNITS = {"": 1, "B": 1, "K": 10**3, "M": 10**6, "G": 10**9, "T": 10**12,
          "KI": 2**10, "MI": 2**20, "GI": 2**30, "TI": 2**40}


def refuse(name: str, value: Any, expected: str) -> UsageError:
    """An error that says what was found and what was expected.

    >>> str(refuse("max_dim", -1, "at least 0"))
    'max_dim: found -1, expected at least 0'
    """
    found = " ".join(repr(value).split())  # arrays take several lines
    if len(found) > 60:
        found = f"{type(value).__name__} {found[:50]}…"
    return UsageError(f"{name}: found {found}, expected {expected}")


def whole(name: str, value: Any, least: int, most: int = 2**63 - 1) -> int:
    """A whole number from `least` to `most`."""
    if type(value) is int and least <= value <= most:
        return value
    try:
        if isinstance(value, _BOOLS):
            raise TypeError
        number = operator.index(value)
    except TypeError:
        number = least - 1
    if not least <= number <= most:
        bounds = f", at least {least}" if most == 2**63 - 1 else f", {least} to {most}"
        if least <= -2**31:  # so low a bound means that there is none
            bounds = "" if most == 2**63 - 1 else f", at most {most}"
        raise refuse(name, value, f"a whole number{bounds}")
    return number


def real(name: str, value: Any, expected: str = "a number", least: float = -math.inf) -> float:
    """A number that is not NaN."""
    if type(value) is float and value >= least:
        return value
    try:
        if type(value) is not int and (isinstance(value, (*_BOOLS, str, bytes)) or not (
                isinstance(value, numbers.Real) or hasattr(value, "__float__"))):
            raise TypeError
        number = float(value)
    except (TypeError, ValueError, OverflowError, RuntimeError):
        raise refuse(name, value, expected) from None
    if not number >= least:
        raise refuse(name, value, expected)
    return number


def positive(name: str, value: Any) -> float:
    """A finite number above 0."""
    number = real(name, value, "a finite number above 0")
    if not 0 < number < math.inf:
        raise refuse(name, value, "a finite number above 0")
    return number


def flag(name: str, value: Any) -> bool:
    """True or False, including NumPy's."""
    if value is True or value is False:
        return value
    if isinstance(value, np.bool_):
        return bool(value)
    raise refuse(name, value, "True or False")


def choice(name: str, value: Any, names: Collection[Any]) -> Any:
    """One of a few words. A scalar of NumPy counts as the Python object that it holds.

    >>> choice("collapse", np.True_, ["auto", True, False])
    True
    """
    for known in names:
        if value is known:
            return value
    names = list(names)
    if isinstance(value, np.generic):
        value = value.item()
    if not (isinstance(value, (str, bool, int, float)) or value is None) or not any(
            value == known and type(value) is type(known) for known in names):
        raise refuse(name, value, " or ".join(
            filter(None, [", ".join(map(repr, names[:-1])), repr(names[-1])])))
    return value


def size(name: str, value: Any) -> int:
    """A size in bytes, given as a number or as "4GiB".

    >>> size("memory_limit", "1.5 MiB")
    1572864
    """
    expected = "bytes, or a size such as '4GiB', '500MB' or 1e9"
    if isinstance(value, str):
        match = re.fullmatch(r"\s*([0-9.]+(?:e[0-9]+)?)\s*([kmgt]i?)?b?\s*", value.lower())
        try:
            amount = float(match[1]) * _UNITS[(match[2] or "").upper()] if match else 0.0
        except ValueError:
            amount = 0.0
    else:
        amount = real(name, value, expected)
    if not 1 <= amount < 2**63:
        raise refuse(name, value, expected)
    return int(amount)


def path_of(path: Any, argument: str = "path") -> bytes:
    """The path in the form that _core expects; "-" is a file of this name."""
    try:
        name = os.fsencode(path)
    except (TypeError, UnicodeError):
        name = b""
    if b"\0" in name or not name:
        raise refuse(argument, path, "a path")
    return b"./-" if name == b"-" else name


def several(name: str, values: Any, what: str) -> list[Any]:
    """An iterable, other than a text or a mapping, as a list."""
    if isinstance(values, (str, bytes, Mapping)) or not isinstance(values, Iterable):
        raise refuse(name, values, what)
    return list(values)


def one_or_several(name: str, values: Any, least: int) -> list[int]:
    """A whole number from `least`, or an iterable of such numbers, as a list."""
    is_one = isinstance(values, str) or not isinstance(values, Iterable)
    return [whole(name, value, least) for value in ([values] if is_one else values)]


def axes(name: str, value: Any, count: int) -> list[bool]:
    """Some axes of an image: their numbers, a bool for each axis, or True or "all" for all.

    >>> axes("periodic", [0, -1], 3)
    [True, False, True]
    """
    chosen = _axes(value, count)
    if chosen is None:
        raise refuse(name, value,
                     f"axes from {-count} to {count - 1}, {count} bools, 'all', True or False")
    return chosen


def _axes(value: Any, count: int) -> list[bool] | None:
    if isinstance(value, _BOOLS):
        return [bool(value)] * count
    if isinstance(value, (str, bytes)):
        return [True] * count if value == "all" else None
    try:
        given: Sequence[Any] = list(value) if isinstance(value, Iterable) else [value]
    except TypeError:
        return None
    if given and all(isinstance(axis, _BOOLS) for axis in given):
        return [bool(axis) for axis in given] if len(given) == count else None
    chosen = [False] * count
    for axis in given:
        try:
            chosen[whole("axis", axis, -count, count - 1)] = True
        except UsageError:
            return None
    return chosen


def user_level() -> int:
    """The `stacklevel` that makes a warning point at the line that called libph."""
    frame, level = sys._getframe(1), 1
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith("libph"):
        frame, level = frame.f_back, level + 1
    return level


# ---- keywords that a function does not have


def with_hints(target: _Callable) -> _Callable:
    """A decorator: if a function gets an unknown keyword, its error names the keyword that is
    meant. For a class, it decorates the constructor and the methods.

    Functions with run options call `_run.check_names` instead.
    """
    if isinstance(target, type):
        for name, member in list(vars(target).items()):
            function = getattr(member, "__func__", member)  # of a static method or class method
            if isinstance(function, FunctionType) and (
                    not name.startswith("_") or name in ("__init__", "__new__")):
                answering = with_hints(function)
                setattr(target, name, answering if function is member else type(member)(answering))
        return target  # type: ignore[return-value]
    if target.__code__.co_flags & inspect.CO_VARKEYWORDS:
        return target

    @functools.wraps(target)
    def call(*arguments: Any, **keywords: Any) -> Any:
        try:
            return target(*arguments, **keywords)
        except TypeError:
            known = inspect.signature(target).parameters
            unknown = [name for name in keywords if name not in known]
            if not unknown:
                raise
            from . import _hints
            name = target.__name__
            if name in ("__init__", "__new__"):
                name = target.__qualname__.split(".")[-2]
            raise _hints.unexpected(name, unknown[0], list(known)) from None

    return call  # type: ignore[return-value]


# ---- keywords of one function that another one accepts as well

signature_of = functools.lru_cache(maxsize=None)(inspect.signature)


def arguments_of(function: Callable[..., Any], data: Any, given: Mapping[str, Any]
                 ) -> dict[str, Any]:
    """All arguments that `function(data, **given)` would see, including defaults."""
    try:
        bound = signature_of(function).bind(data, **given)
    except TypeError as error:
        raise TypeError(f"{function.__name__}() {error}") from None
    bound.apply_defaults()
    return dict(bound.arguments)
