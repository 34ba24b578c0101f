# SPDX-License-Identifier: MIT
"""The errors of libph.

Other errors come from Ctrl-C, callbacks, missing packages, and wrong uses of Python, such as an
unknown keyword or an index beyond the last bar. Each error class except `Cancelled` also derives
from a built-in class, so that ``except ValueError`` catches bad data.
"""


from __future__ import annotations

from typing import TypeVar


class Error(Exception):
    """The base class of all errors of libph. The message says what was wrong, what was found and
    expected, and gives a hint.

    Attributes
    ----------
    remedies : tuple of (str, str)
        Keywords that the hint names, each with a value: ``("nan", "drop")``. The value is empty if
        several values help. The keywords of a `MemoryLimitError` are the first of the solutions
        that the message names, and must be set together.
    """

    remedies: tuple[tuple[str, str], ...] = ()
    _place: str = ""            # the place of the error
    _found: str = ""            # what was found there
    _input: int | None = None   # index of the input, if there are several
    _cause: Error | None = None  # the problem with this input


class UsageError(Error, ValueError):
    """An argument or option is invalid."""


class DataError(Error, ValueError):
    """The data are malformed; the message names the place if there is one."""


class MissingInputError(Error, FileNotFoundError):
    """A file is missing or unreadable."""


class OutputError(Error, OSError):
    """A file cannot be created, or reading or writing it failed midway."""


class MemoryLimitError(Error, MemoryError):
    """The memory limit would be exceeded. Only the current computation is lost."""


class Cancelled(Error):
    """The computation was stopped by `stop`."""


class Timeout(Cancelled, TimeoutError):
    """The computation was stopped because it exceeded its `timeout`."""


class NotBuiltIn(Error, NotImplementedError):
    """A feature is missing from this build, does not exist in libph, or needs a GPU that is missing."""


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
        _class.__module__ = "libph"  # the module where users find it
