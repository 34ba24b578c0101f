# SPDX-License-Identifier: MIT
"""The common base of parts of images and clouds."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeVar

from .. import _options
from .._errors import UsageError

_MOST_PARTS = 2**30
_P = TypeVar("_P", bound="Part")


class Part:
    """A part: its bytes, and the facts that they state."""

    parts: int
    _present: Sequence[int]  # ascending

    def __init__(self, data: bytes) -> None:
        self._bytes = data

    @staticmethod
    def _checked(data: Any) -> bytes:
        if not isinstance(data, (bytes, bytearray, memoryview)):
            raise UsageError(f"data: found {type(data).__name__}, expected bytes")
        return bytes(data)

    @classmethod
    def from_bytes(cls: type[_P], data: bytes) -> _P:
        """The part that `to_bytes` stored, or that ``ph-barcode --part`` wrote to a file.

        Raises
        ------
        DataError
            If the bytes are not such a part or are damaged; a part has a checksum.
        """
        return cls(data)

    def to_bytes(self) -> bytes:
        """The part as bytes, exactly as in its file; they are the same on every machine.

        ``ph-barcode --join`` accepts such a file.
        """
        return self._bytes

    @property
    def missing(self) -> tuple[int, ...]:
        """The missing parts, from 0, ascending."""
        present = set(self._present)
        return tuple(i for i in range(self.parts) if i not in present)

    @property
    def is_whole(self) -> bool:
        """True if it has all parts."""
        return len(self._present) == self.parts

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Part) or type(other) is not type(self):
            return NotImplemented
        return self._bytes == other._bytes

    def __hash__(self) -> int:
        return hash(self._bytes)

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (self._bytes,))

    def _words(self) -> str:
        """Its parts, as text: "2 of 8", "1 to 3 of 8", "3 parts of 8"."""
        first, last, count = self._present[0], self._present[-1], len(self._present)
        if count == 1:
            return f"{first} of {self.parts}"
        if last - first == count - 1:
            return f"{first} to {last} of {self.parts}"
        return f"{count} parts of {self.parts}"


def checked_numbers(part: Any, parts: Any) -> tuple[int, int]:
    """Index of a part and the number of parts."""
    count = _options.whole("parts", parts, 1, _MOST_PARTS)
    return _options.whole("part", part, 0, count - 1), count
