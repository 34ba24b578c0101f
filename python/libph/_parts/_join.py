# SPDX-License-Identifier: MIT
"""Joining parts of one kind."""
from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, TypeVar

from .. import _core, _options, _run
from .._errors import DataError, UsageError
from ._cloud import CloudPart
from ._image import ImagePart

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .._run import RunOptions

_P = TypeVar("_P", ImagePart, CloudPart)


def join_parts(parts: Iterable[_P], **run: Unpack[RunOptions]) -> _P:
    """Joins neighbouring parts of one image, or any parts of one cloud, in any order.

    Joining is associative: parts can be joined in any grouping, on any machines.

    Parameters
    ----------
    parts : iterable of ImagePart, or of CloudPart
        At least one part.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    ImagePart or CloudPart

    Raises
    ------
    DataError
        If parts occur twice, if they belong to different images or clouds, if their options differ,
        or if parts of an image are missing between others.

    Examples
    --------
    >>> image = np.random.default_rng(0).random((8, 9))
    >>> ph.join_parts([ph.image_part(image, i, 4) for i in (2, 1)])
    ImagePart(1 to 2 of 4, shape=(8, 9), ... bytes)
    """
    _run.check_names("join_parts", run, join_parts)
    chosen: list[_P] = _options.several("parts", parts, "a list of ImagePart or CloudPart")
    for part in chosen:
        if not isinstance(part, (ImagePart, CloudPart)):
            raise UsageError(
                f"parts: found {type(part).__name__}, expected ImagePart or CloudPart")
    if not chosen:
        raise DataError("parts: found none, expected at least one")
    kind = type(chosen[0])
    for part in chosen:
        if type(part) is not kind:
            raise DataError(f"parts: found {type(part).__name__} together with {kind.__name__}, "
                            "expected parts of one kind")
    join = _core.join_image_parts if kind is ImagePart else _core.join_cloud_parts
    return kind(_run.run(join, [part._bytes for part in chosen], options=dict(run)))
