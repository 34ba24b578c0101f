# SPDX-License-Identifier: MIT
"""Loops of volumes, which parts find together by exchanging messages."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .. import _core, _options, _run
from .._barcodes import Barcode
from .._errors import UsageError
from ._image import ImagePart

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .._run import RunOptions


def _as_bytes(name: str, data: Any) -> bytes:
    if not isinstance(data, (bytes, bytearray, memoryview)):
        raise UsageError(f"{name}: found {type(data).__name__}, expected bytes")
    return bytes(data)


class ImageLoops:
    """The loops of a volume that belong to one part; finding loops needs all layers at once.

    The parts work in parallel, in any processes on any machines, and send each other messages until
    no message is in transit. Neither the schedule nor the order in which messages arrive affects
    the result. An `ImageLoops` cannot be sent to another process. After a call that failed or was
    stopped, the object is useless, and a new part must be computed.

    Parameters
    ----------
    part : ImagePart
        A fresh result of ``image_part(…, loops=True)``, in the same process. It lends its voxels
        once. The image must not change until the work is done.
    field : int
        Coefficients are in Z/p for this prime p. It must be the same for all parts.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`. `threads` and
        `memory_limit` apply to the whole work.

    Attributes
    ----------
    part, parts : int
        Index of the part, from 0, and the number of parts.

    Raises
    ------
    UsageError
        If the part has no loops, was sent or joined, or has already lent its voxels.

    Examples
    --------
    Three parts in one process. `letters` holds the messages in transit, each with its receiver:

    >>> volume = np.random.default_rng(0).random((9, 8, 7))
    >>> parts = [ph.image_part(volume, i, 3, loops=True) for i in range(3)]
    >>> whole = ph.join_parts(parts)
    >>> loops = [ph.ImageLoops(part) for part in parts]
    >>> for i, told in enumerate(whole.told_to_loops()):
    ...     loops[i].begin(told)
    >>> while True:
    ...     letters = []
    ...     for some in loops:
    ...         some.work()
    ...         letters += some.take_messages()
    ...     if not letters:
    ...         break
    ...     for to, message in letters:
    ...         loops[to].receive(message)
    >>> bars = whole.barcode(loops=[some.barcode() for some in loops])
    >>> bars == ph.cubical(volume)
    True
    """

    def __init__(self, part: ImagePart, *, field: int = 2, **run: Unpack[RunOptions]) -> None:
        _run.check_names("ImageLoops", run, ["field"])
        if not isinstance(part, ImagePart):
            raise UsageError(f"part: found {type(part).__name__}, expected ImagePart")
        self._field = _options.whole("field", field, 2, 2**31 - 1)
        held, part._held = part._held, None
        if held is None:
            found = "one that was already used, sent or joined" if part.has_loops else \
                "one without loops"
            raise UsageError(f"part: found {found}, expected an unused result of "
                             "image_part(…, loops=True) that has loops")
        try:
            self._loops = _run.run(_core.RunningLoops, held, self._field, options=dict(run))
        except UsageError:
            part._held = held  # the part keeps its voxels, because they were not taken
            raise
        self._meta = part._meta()
        self.part: int = self._loops.part
        self.parts: int = part.parts

    def begin(self, told: bytes, **run: Unpack[RunOptions]) -> None:
        """Starts the work, once, with the entry of `ImagePart.told_to_loops` for this part.

        Raises
        ------
        DataError
            If the entry is damaged, or belongs to another part or to an image with other extents or
            options. Voxels are not compared, because no part has seen them all.
        """
        _run.check_names("begin", run, ["told"])
        _run.run(self._loops.begin, _as_bytes("told", told), options=dict(run))

    def receive(self, message: bytes) -> None:
        """Receives a message for this part, even before `begin`. Each message must be received
        exactly once.

        Raises
        ------
        DataError
            If the message is damaged, is for another part, or was received before.
        """
        self._loops.receive(_as_bytes("message", message))

    @property
    def is_idle(self) -> bool:
        """True if there is nothing to do until a message is received."""
        return self._loops.is_idle

    def work(self, most: int | None = None, **run: Unpack[RunOptions]) -> None:
        """Reduces columns until all columns are done or wait for other parts, or until `most`
        columns are reduced."""
        _run.check_names("work", run, ["most"])
        count = None if most is None else _options.whole("most", most, 1)
        _run.run(self._loops.work, count, options=dict(run))

    def take_messages(self) -> list[tuple[int, bytes]]:
        """The messages to send since the last call, each as a pair of receiver and message."""
        return self._loops.take_messages()

    @property
    def messages_sent(self) -> int:
        """Number of messages taken so far."""
        return self._loops.traffic[0]

    @property
    def messages_received(self) -> int:
        """Number of messages received so far.

        No message is in transit once all parts together have received as many messages as they have
        sent. If all parts are also idle and have no messages to take, the work is done.
        """
        return self._loops.traffic[1]

    @property
    def bytes_sent(self) -> int:
        """Number of bytes of all messages taken so far."""
        return self._loops.traffic[4]

    def barcode(self, **run: Unpack[RunOptions]) -> Barcode:
        """The bars of this part, for ``ImagePart.barcode(loops=…)``; available once all parts are
        done.

        Raises
        ------
        UsageError
            If there is work left, or there are messages to take.
        """
        _run.check_names("barcode", run)
        bars = _run.run(self._loops.bars, options=dict(run))
        sent, received = self._loops.traffic[:2]
        return Barcode._of(bars, {**self._meta, "field": self._field, "part": self.part,
                                  "parts": self.parts, "messages_sent": sent,
                                  "messages_received": received})

    def __reduce__(self) -> Any:
        raise TypeError("ImageLoops stay in the process that computed their part")

    def __repr__(self) -> str:
        return f"ImageLoops({self.part} of {self.parts}, shape={self._meta['shape']})"
