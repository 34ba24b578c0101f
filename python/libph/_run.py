# SPDX-License-Identifier: MIT
"""The options of all computations, which limit, observe and stop them."""
from __future__ import annotations

import atexit
import contextlib
import inspect
import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextvars import ContextVar
from typing import Any, Protocol, TypedDict, TypeVar, Union

from . import _core, _imports, _options
from ._errors import Cancelled, MemoryLimitError, Timeout, reworded

Progress = Union[bool, Callable[[str, int, int], object]]
_Result = TypeVar("_Result")


class Stop(Protocol):
    """An object that can request a stop: a ``threading.Event``."""

    def is_set(self) -> bool: ...


class RunOptions(TypedDict, total=False):
    """Keywords that every computation accepts."""

    threads: int | None
    memory_limit: int | str | None
    progress: Progress
    timeout: float | None
    stop: Stop | None


_NAMES = ("threads", "memory_limit", "progress", "timeout", "stop")
_DEFAULTS: ContextVar[dict[str, Any]] = ContextVar("libph.limits", default={})
_COPIES: ContextVar[list[int] | None] = ContextVar("libph.copies", default=None)
_PLAIN = _core.RunOptions(0, None, None, None, None, 0)

atexit.register(_core.end_calls)
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_core.forget_calls)


@contextlib.contextmanager
@_options.with_hints
def limits(*, memory: int | str | None = None, threads: int | None = None,
           timeout: float | None = None, progress: Progress | None = None) -> Iterator[None]:
    """Sets defaults for all computations of this thread or task within a ``with`` block.

    Parameters
    ----------
    memory : int or str, optional
        The default of `memory_limit`: the largest amount of memory that a computation may take, in
        bytes or as text ("4GiB").
    threads : int, optional
        Threads that a computation may use.
    timeout : float, optional
        Seconds that a computation may take.
    progress : bool or callable, optional
        The receiver of progress reports; see `libph`.

    Examples
    --------
    >>> with ph.limits(memory="1GiB", threads=1):
    ...     bars = ph.rips([[0, 0], [1, 0]])
    """
    given = {"memory_limit": memory, "threads": threads, "timeout": timeout, "progress": progress}
    chosen = {name: value for name, value in given.items() if value is not None}
    _check(chosen)
    token = _DEFAULTS.set({**_DEFAULTS.get(), **chosen})
    try:
        yield
    finally:
        _DEFAULTS.reset(token)


@contextlib.contextmanager
def within_limit(options: Mapping[str, Any]) -> Iterator[list[int]]:
    """Makes the `memory_limit` of these keywords the default within a ``with`` block.

    Yields the bytes of each copy of input that the block, or a block around it, has made.
    """
    limit = memory_limit(options)
    counted = copies()
    if limit is None:
        yield counted
        return
    default = _DEFAULTS.set({**_DEFAULTS.get(), "memory_limit": limit})
    count = _COPIES.set(counted)
    try:
        yield counted
    finally:
        _COPIES.reset(count)
        _DEFAULTS.reset(default)


def copies() -> list[int]:
    """The list of the current `within_limit`; outside, a list that nobody reads."""
    counted = _COPIES.get()
    return [] if counted is None else counted


# What helps if a memory limit is too small, and nothing else is known to help.
LARGER_LIMIT = "; a larger memory_limit may help"


def run(function: Callable[..., _Result], *arguments: Any, options: dict[str, Any],
        slab_layers: int = 0, copied: int = 0) -> _Result:
    """Calls a function of _core whose last argument is RunOptions.

    `options` are the keywords that the user gave. `copied` are the bytes of copies of the input,
    which count towards the memory limit.
    """
    defaults = _DEFAULTS.get()
    try:
        if not options and not defaults and not slab_layers:
            return function(*arguments, _PLAIN)
        given = _check({**defaults, **{k: v for k, v in options.items() if v is not None}})
        progress = given.get("progress")
        with _bar() if progress is True else contextlib.nullcontext(progress) as report:
            return function(*arguments, _core.RunOptions(
                given.get("threads", 0), given.get("memory_limit"), given.get("timeout"), report,
                given.get("stop"), slab_layers, copied))
    except MemoryLimitError as error:
        message = str(error)
        if not message.startswith("memory limit of") or ";" in message:
            raise
        raise reworded(error, message + LARGER_LIMIT) from None


@contextlib.contextmanager
def rounds(stage: str, total: int, options: Mapping[str, Any]) -> Iterator[Iterator[int]]:
    """Numbers the rounds of a computation that calls others. The timeout and the progress count the
    rounds together, and the other options hold for every computation of the rounds.

    `options` are the keywords that the user gave.
    """
    given = {**_DEFAULTS.get(), **{k: v for k, v in options.items() if v is not None}}
    checked = _check(given)
    seconds, stop, progress = (checked.get(name) for name in ("timeout", "stop", "progress"))
    end = time.monotonic() + (seconds or 0)

    def numbers(report: Callable[[str, int, int], object] | None) -> Iterator[int]:
        for i in range(total):
            if stop is not None and stop.is_set():
                raise Cancelled("stopped on request")
            if seconds is not None:
                left = end - time.monotonic()
                if left <= 0:
                    raise Timeout(f"timeout: not finished after {seconds:g} s; a larger timeout or "
                                  f"fewer {stage} may help")
                _DEFAULTS.set({**given, "progress": False, "timeout": left})
            if report is not None:
                report(stage, i, total)
            yield i
        if report is not None:
            report(stage, total, total)

    token = _DEFAULTS.set({**given, "progress": False})
    try:
        with _bar() if progress is True else contextlib.nullcontext(progress) as report:
            yield numbers(report)
    finally:
        _DEFAULTS.reset(token)


def memory_limit(options: Mapping[str, Any]) -> int | None:
    """The memory that a computation with these keywords may take, in bytes, if it is limited."""
    limit = options.get("memory_limit")
    if limit is None:
        limit = _DEFAULTS.get().get("memory_limit")
    return None if limit is None else _options.size("memory_limit", limit)


def check_names(function: str, options: Mapping[str, object],
                known: Iterable[str] | Callable[..., Any] = ()) -> None:
    """Refuses unknown keywords, as Python does for explicit keywords, and adds a hint.

    `known` are the other keywords, or the function that has them.
    """
    for name in options:
        if name not in _NAMES:
            from . import _hints
            others = inspect.signature(known).parameters if callable(known) else known
            raise _hints.unexpected(function, name, [*others, *_NAMES])


def _check(given: dict[str, Any]) -> dict[str, Any]:
    """The options in the form that _core expects."""
    checked = {}
    for name, value in given.items():
        if name == "threads":
            value = _options.whole(name, value, 1, 4096)
        elif name == "memory_limit":
            value = _options.size(name, value)
        elif name == "timeout":
            value = _options.positive(name, value)
        elif name == "stop" and not callable(getattr(value, "is_set", None)):
            raise _options.refuse(name, value, "a threading.Event")
        elif name == "progress" and not callable(value):
            value = _options.flag(name, value) or None
        checked[name] = value
    return checked


@contextlib.contextmanager
def _bar() -> Iterator[Callable[[str, int, int], object] | None]:
    """A callback that shows progress as a tqdm bar; None if tqdm is not installed."""
    try:
        tqdm = _imports.load("tqdm.auto").tqdm
    except ImportError:
        yield None
        return
    bar: Any = None
    shown: str | None = None

    def report(stage: str, done: int, total: int) -> None:
        nonlocal bar, shown
        if stage != shown:
            if bar is not None:
                bar.close()
            bar, shown = tqdm(desc=stage, total=total or None, leave=False), stage
        bar.update(done - bar.n)

    try:
        yield report
    finally:
        if bar is not None:
            bar.close()
