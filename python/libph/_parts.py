# SPDX-License-Identifier: MIT
"""Parts of an image that processes compute apart, and what they make together."""
from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from . import _core, _options, _run
from ._barcodes import Barcode
from ._errors import DataError, UsageError
from ._requests import cubical_request

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._run import RunOptions

_MOST_PARTS = 2**31 - 1


class ImagePart:
    """What is known of an image's barcode from some of its layers; see `image_part`.

    It can be pickled, and sent to another process. Two are equal if they are the same bytes.

    Attributes
    ----------
    first, last : int
        Which parts it covers, from 0 on.
    parts : int
        How many there are in all.
    shape : tuple of int
        Of the whole image.
    """

    def __init__(self, data: bytes) -> None:
        facts = _core.part_facts(data)
        self._bytes = data
        self._facts = facts
        self.first: int = facts["first"]
        self.last: int = facts["last"]
        self.parts: int = facts["parts"]
        self.shape: tuple[int, ...] = facts["shape"]

    @classmethod
    def from_bytes(cls, data: bytes) -> ImagePart:
        """The part that `to_bytes` stored, or ``ph-barcode --part`` in a file.

        Raises
        ------
        DataError
            If it is no part, or damaged: a part has a checksum.
        """
        if not isinstance(data, (bytes, bytearray, memoryview)):
            raise UsageError(f"data: found {type(data).__name__}, expected bytes")
        return cls(bytes(data))

    def to_bytes(self) -> bytes:
        """The part as bytes, the same on every machine: what a file of it has.

        ``ph-barcode --join`` takes such a file.
        """
        return self._bytes

    @property
    def is_whole(self) -> bool:
        """Whether it covers all parts."""
        return self.first == 0 and self.last + 1 == self.parts

    def barcode(self, **run: Unpack[RunOptions]) -> Barcode:
        """The barcode of the image, the same as `cubical` gives.

        Raises
        ------
        DataError
            If parts are missing.
        """
        _run.check_names("barcode", run)
        facts = self._facts
        meta = {"complex": "cubical", "field": 2, "shape": self.shape,
                "construction": facts["construction"], "superlevel": facts["superlevel"],
                "periodic": tuple(k for k, closes in enumerate(facts["periodic"]) if closes)}
        return Barcode._of(_run.run(_core.part_bars, self._bytes, options=dict(run)), meta)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ImagePart):
            return NotImplemented
        return self._bytes == other._bytes

    def __hash__(self) -> int:
        return hash(self._bytes)

    def __reduce__(self) -> tuple[type[ImagePart], tuple[bytes]]:
        return (ImagePart, (self._bytes,))

    def __repr__(self) -> str:
        which = f"{self.first}" if self.first == self.last else f"{self.first} to {self.last}"
        return f"ImagePart({which} of {self.parts}, shape={self.shape}, {len(self._bytes)} bytes)"


def image_part(image: Any, part: int, parts: int, *, construction: str = "vertices",
               superlevel: bool = False, periodic: Any = (), threshold: float | None = None,
               max_dim: int | None = None, min_dim: int = 0, cells: bool = True,
               nan: str = "error", slab_layers: int | None = None,
               **run: Unpack[RunOptions]) -> ImagePart:
    """Computes one of several parts of an image's barcode: some layers of its first axis.

    Only the voxels of these layers, and of one on either side, are looked at. So the image may be a
    memory map, ``numpy.load(path, mmap_mode="r")``, that no machine could hold.

    Parameters
    ----------
    image : array_like
        As of `cubical`, of 2 axes or more.
    part : int
        Which one, from 0 on.
    parts : int
        How many there are: at most one a layer.
    construction, superlevel, periodic, threshold, nan, slab_layers
        As of `cubical`. All parts need the same.
    max_dim, min_dim : int, optional
        As of `cubical`. Volumes have ``max_dim=0``, or, if no axis closes up, ``min_dim=2``: loops
        need all layers at once. So it is of more axes: the last dimension is their number less 1.
    cells : bool
        Whether bars know the cells of their birth and death.
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
    count = _options.whole("parts", parts, 1, _MOST_PARTS)
    number = _options.whole("part", part, 0, count - 1)
    highest = None if max_dim is None else _options.whole("max_dim", max_dim, 0)
    lowest = _options.whole("min_dim", min_dim, 0)
    data = _run.run(_core.image_part, request.recipe, number, count, lowest, highest,
                    _options.flag("cells", cells), options=request.options,
                    slab_layers=request.slab_layers)
    return ImagePart(data)


def join_parts(parts: Iterable[ImagePart], **run: Unpack[RunOptions]) -> ImagePart:
    """Joins parts of one image, which are neighbours, in any order.

    It is associative: parts can be joined in any grouping, on any machines.

    Parameters
    ----------
    parts : iterable of ImagePart
        One at least.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    ImagePart

    Raises
    ------
    DataError
        If parts are missing between others, are there twice, or belong to another image or to other
        options.

    Examples
    --------
    >>> image = np.random.default_rng(0).random((8, 9))
    >>> ph.join_parts([ph.image_part(image, i, 4) for i in (2, 1)])
    ImagePart(1 to 2 of 4, shape=(8, 9), ... bytes)
    """
    _run.check_names("join_parts", run, join_parts)
    chosen = list(parts)
    for part in chosen:
        if not isinstance(part, ImagePart):
            raise UsageError(f"parts: found {type(part).__name__}, expected ImagePart")
    if not chosen:
        raise DataError("parts: found none, expected one at least")
    return ImagePart(_run.run(_core.join_parts, [part._bytes for part in chosen],
                              options=dict(run)))
