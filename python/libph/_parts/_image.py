# SPDX-License-Identifier: MIT
"""Parts of the barcode of an image."""
from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from .. import _core, _options, _run
from .._barcodes import Barcode
from .._errors import DataError, UsageError
from .._requests import cubical_request
from ._part import Part, checked_numbers

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .._run import RunOptions


class ImagePart(Part):
    """The barcode of an image, as far as some of its layers determine it; see `image_part`.

    A part can be pickled and sent to another process. Two parts are equal if their bytes are equal.

    Attributes
    ----------
    first, last : int
        The first and the last part that this object covers, counted from 0.
    parts : int
        Total number of parts.
    shape : tuple of int
        Shape of the whole image.
    has_loops : bool
        True if `ImageLoops` must find some of the requested bars.
    """

    def __init__(self, data: bytes) -> None:
        data = self._checked(data)
        facts = _core.image_part_facts(data)
        super().__init__(data)
        self._facts = facts
        self._held: _core.HeldPart | None = None  # until its ImageLoops takes it
        self.first: int = facts["first"]
        self.last: int = facts["last"]
        self.parts: int = facts["parts"]
        self._present = range(self.first, self.last + 1)
        self.shape: tuple[int, ...] = facts["shape"]
        self.has_loops: bool = facts["has_loops"]

    def told_to_loops(self, **run: Unpack[RunOptions]) -> list[bytes]:
        """For each part, the message that starts the search for its loops. Joining the parts
        determines these messages.

        Raises
        ------
        DataError
            If parts are missing.
        UsageError
            If the part has no loops.
        """
        _run.check_names("told_to_loops", run)
        if not self.has_loops:
            raise UsageError("told_to_loops: found a part without loops, expected one of a volume "
                             "that was computed with loops=True")
        return _run.run(_core.told_to_loops, self._bytes, options=dict(run))

    def barcode(self, *, loops: Iterable[Barcode] | None = None,
                **run: Unpack[RunOptions]) -> Barcode:
        """The barcode of the image, identical to the result of `cubical`.

        Parameters
        ----------
        loops : iterable of Barcode, optional
            The results of `ImageLoops.barcode` of all parts, in any order, if the part has loops.
        **run
            `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

        Raises
        ------
        DataError
            If parts, loops of parts, or messages between them are missing.
        """
        _run.check_names("barcode", run, self.barcode)
        meta = self._meta()
        given: list[Barcode] = [] if loops is None else _options.several(
            "loops", loops, "the results of ImageLoops.barcode for all parts")
        self._check_loops(given)
        field = given[0].meta["field"] if given else 2
        bars = _run.run(_core.image_part_bars, self._bytes, [bars._bars for bars in given], field,
                        options=dict(run))
        return Barcode._of(bars, {**meta, "field": field})

    def _meta(self) -> dict[str, Any]:
        facts = self._facts
        return {"complex": "cubical", "shape": self.shape, "construction": facts["construction"],
                "superlevel": facts["superlevel"],
                "periodic": tuple(k for k, closes in enumerate(facts["periodic"]) if closes)}

    def _check_loops(self, loops: list[Barcode]) -> None:
        """Checks that the loops belong to this image, that there is one for each part, and that no
        message was lost."""
        for bars in loops:
            if not isinstance(bars, Barcode) or "messages_sent" not in bars.meta:
                raise UsageError(f"loops: found {type(bars).__name__}, expected a result "
                                 "of ImageLoops.barcode")
        if not self.has_loops:
            if loops:
                raise UsageError(f"loops: found {len(loops)} barcodes, expected none for a part "
                                 "without loops (has_loops is False)")
            return
        found = sorted(bars.meta["part"] for bars in loops)
        if found != list(range(self.parts)):
            raise DataError(f"loops: found loops of {len(set(found))} of {self.parts} parts in "
                            f"{len(found)} barcodes, expected one for each part")
        expected = {**self._meta(), "parts": self.parts, "field": loops[0].meta["field"],
                    "threshold": self._facts["threshold"]}
        for bars in loops:
            for name, value in expected.items():
                if bars.meta.get(name) != value:
                    raise DataError(f"loops: {name}: found {bars.meta.get(name)!r}, expected "
                                    f"{value!r}, as for the image and the other loops")
        sent, received = (sum(bars.meta[name] for bars in loops)
                          for name in ("messages_sent", "messages_received"))
        if sent != received:
            raise DataError(f"loops: found {received} received messages, expected {sent}, the "
                            "number of sent messages")

    def __repr__(self) -> str:
        return f"ImagePart({self._words()}, shape={self.shape}, {len(self._bytes)} bytes)"


def image_part(image: Any, part: int, parts: int, *, construction: str = "vertices",
               superlevel: bool = False, periodic: Any = (), threshold: float | None = None,
               max_dim: int | None = None, min_dim: int = 0, cells: bool = True,
               loops: bool = False, nan: str = "error", slab_layers: int | None = None,
               **run: Unpack[RunOptions]) -> ImagePart:
    """Computes one of several parts of an image's barcode: some layers of its first axis.

    Reads only the voxels of these layers and of one layer on either side. The image may therefore
    be a memory map, ``numpy.load(path, mmap_mode="r")``, that is larger than the memory of any
    machine. All options except `slab_layers` and `run` must be the same for all parts.

    Parameters
    ----------
    image : array_like
        As in `cubical`, with 2 axes or more.
    part : int
        Index of this part, from 0.
    parts : int
        Number of parts, at most one per layer.
    construction, superlevel, periodic, threshold, nan, slab_layers
        As in `cubical`.
    max_dim, min_dim : int, optional
        As in `cubical`. Images with d axes, three or more, need ``max_dim=0`` or, if no axis is
        periodic, ``min_dim=d - 1``, because the dimensions in between need all layers at once. For
        volumes, `loops` lifts this restriction.
    cells : bool
        If True, bars store the cells of their birth and death.
    loops : bool
        If True, `ImageLoops` will find the bars of a volume that need all layers at once. The part
        keeps its voxels until an `ImageLoops` takes them, with all its layers in memory, whatever
        `slab_layers` is. `ImagePart.has_loops` is True if there can be such bars.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    ImagePart

    Examples
    --------
    >>> image = np.random.default_rng(0).random((8, 9))
    >>> parts = [ph.image_part(image, i, 3) for i in range(3)]
    >>> ph.join_parts(parts).barcode() == ph.cubical(image)
    True
    """
    options = {"image": image, "construction": construction, "superlevel": superlevel,
               "periodic": periodic, "threshold": threshold, "max_dim": max_dim,
               "min_dim": min_dim, "cells": cells, "nan": nan, "slab_layers": slab_layers,
               "field": 2, "engine": "auto", "representatives": None, "loops": None,
               "min_persistence": 0.0, "run": run}
    _run.check_names("image_part", run, image_part)
    request = cubical_request(options)
    number, count = checked_numbers(part, parts)
    highest = None if max_dim is None else _options.whole("max_dim", max_dim, 0)
    lowest = _options.whole("min_dim", min_dim, 0)
    data, held = _run.run(_core.image_part, request.recipe, number, count, lowest, highest,
                          _options.flag("cells", cells), _options.flag("loops", loops),
                          options=request.options, slab_layers=request.slab_layers)
    made = ImagePart(data)
    made._held = held
    return made
