# SPDX-License-Identifier: MIT
"""What libph raises: these classes and no others, but for Ctrl-C and what a callback raises.

Each is a class of Python's own, too, so that ``except ValueError`` catches bad data.
"""


from __future__ import annotations

from typing import TypeVar


class Error(Exception):
    """Anything that libph raises. The message says what, found, expected, and a hint.

    Attributes
    ----------
    remedies : tuple of (str, str)
        Keywords that the hint names, each with a value: ``("nan", "drop")``. The value is empty
        where several help. Of a `MemoryLimitError` they are to be set together: the first of the
        ways out that the message names.
    """

    remedies: tuple[tuple[str, str], ...] = ()
    _place: str = ""            # where it went wrong
    _found: str = ""            # what was found there
    _input: int | None = None   # of several inputs
    _cause: Error | None = None  # what went wrong with it


class UsageError(Error, ValueError):
    """An argument or option makes no sense."""


class DataError(Error, ValueError):
    """The data are malformed; the message names row and column."""


class MissingInputError(Error, FileNotFoundError):
    """A file is missing or unreadable."""


class OutputError(Error, OSError):
    """A file cannot be created, or reading or writing it broke off."""


class MemoryLimitError(Error, MemoryError):
    """The memory limit would be exceeded. Nothing is lost but the computation."""


class Cancelled(Error):
    """The computation was stopped by `stop`."""


class Timeout(Cancelled, TimeoutError):
    """The computation was stopped when its `timeout` was over."""


class NotBuiltIn(Error, NotImplementedError):
    """A feature was left out of this build, is none of libph's, or needs a GPU that is not there."""


class InternalError(Error, RuntimeError):
    """A bug in libph: please report it."""


_AnyError = TypeVar("_AnyError", bound=Error)


def reworded(error: _AnyError, message: str, *remedies: tuple[str, str]) -> _AnyError:
    """An error of the same class with another message and these additional remedies."""
    other = type(error)(message)
    other.remedies = error.remedies + remedies
    return other


for _class in list(globals().values()):
    if isinstance(_class, type) and issubclass(_class, Error):
        _class.__module__ = "libph"  # where users find it
