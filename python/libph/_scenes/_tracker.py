# SPDX-License-Identifier: MIT
"""Numbers and roles of objects that stay the same from frame to frame."""
from __future__ import annotations

from typing import Any, NamedTuple, NoReturn

import numpy as np
from numpy.typing import NDArray

from .. import _arrays, _core, _options
from .._errors import UsageError
from ._objects import standing_on
from ._segmentation import Segmentation


class Tracked(NamedTuple):
    """The identity of an object over several frames.

    Attributes
    ----------
    number : int
        The number of the object, which stays the same from frame to frame.
    role : str
        "object", "container", or a role of a surface (see `SceneSurface`). A wall that one frame
        shows as an object keeps the role "wall".
    on : tuple of (str, int) or None
        What it stands on, in the form of `Segment.on` of that frame.
    """

    number: int
    role: str
    on: tuple[str, int] | None


@_options.with_hints
class LabelTracker:
    """Gives the objects of a stream of frames stable numbers and roles.

    A segment takes the number of the object with which it overlaps most, measured as a share of the
    union of the two. The shared places must be more than a quarter of the places of the smaller
    one. All other segments get new numbers. Places are pixels, or cubes of edge `cell` in clouds
    without rows and columns; in that case the camera must stand still. The role of an object, and
    what it stands on, change when three frames in a row agree.

    Parameters
    ----------
    patience : int
        Number of frames for which an object that is not visible is remembered.
    cell : float
        The edge of the cubes, in metres.

    Examples
    --------
    >>> tracker = LabelTracker()
    >>> tracker.update(np.array([[1, 1, 0], [1, 1, 2]]))
    array([[1, 1, 0],
           [1, 1, 2]], dtype=uint32)
    >>> tracker.update(np.array([[2, 2, 0], [2, 2, 0]]))
    array([[1, 1, 0],
           [1, 1, 0]], dtype=uint32)
    """

    def __init__(self, *, patience: int = 5, cell: float = 0.01) -> None:
        frames = _options.whole("patience", patience, 0, 2**31 - 2)
        self._tracker = _core.LabelTracker(frames, _options.positive("cell", cell))

    def __reduce__(self) -> NoReturn:
        # Without this, protocols 0 and 1 of pickle call a base class of pybind11, which ends the
        # process.
        raise TypeError("cannot pickle a LabelTracker: it belongs to one stream of frames")

    def update(self, frame: Any) -> Any:
        """Processes the next frame.

        Parameters
        ----------
        frame : Segmentation or array_like of int
            The result of `segment`, or labels from another source, where 0 means none.

        Returns
        -------
        tuple of Tracked, or ndarray
            For a `Segmentation`, a `Tracked` for each of its objects, in the order of ``objects``.
            For labels, an array with the number of each label's object.
        """
        if isinstance(frame, Segmentation):
            return tuple(Tracked(number, role, standing_on(*on))
                         for number, role, on in self._tracker.update(frame._found))
        labels = _labels(frame)
        numbers = np.asarray(self._tracker.update_labels(labels.ravel()))
        return numbers.reshape(labels.shape)


def _labels(frame: Any) -> NDArray[np.uint32]:
    labels = _arrays.as_integers(_arrays.as_array(frame, "frame"), "frame")
    if labels.size and not (0 <= labels.min() and labels.max() < 2**32):
        raise UsageError(f"frame: found labels from {labels.min()} to {labels.max()}, expected 0 to "
                         f"{2**32 - 1}")
    return np.ascontiguousarray(labels, dtype=np.uint32)
