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
    """What an object of a frame is over some frames.

    Attributes
    ----------
    number : int
        It keeps it from frame to frame.
    role : str
        "object", "unknown", "support" or "wall": a wall that is an object in one frame is still a
        wall.
    on : tuple of (str, int) or None
        What it stands on, as `Segment.on` of that frame says it.
    """

    number: int
    role: str
    on: tuple[str, int] | None


class LabelTracker:
    """Gives the objects of a stream of frames numbers and roles that hold.

    A segment takes the number of the object with which it shares most places, if they share more
    than a quarter of the smaller of the two. All else gets a new number. Places are pixels, or
    cubes of `cell` in clouds without rows and columns; then the camera must stand still. The role
    of an object, and what it stands on, change when three frames in a row say the same.

    Parameters
    ----------
    patience : int
        For so many frames an object that is not seen is remembered.
    cell : float
        The edge of those cubes, metres.

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
        # Else protocols 0 and 1 of pickle ask a base class of pybind11, which ends the process.
        raise TypeError("cannot pickle a LabelTracker: it is what was seen of one stream so far")

    def update(self, frame: Any) -> Any:
        """The next frame.

        Parameters
        ----------
        frame : Segmentation or array_like of int
            What `segment` gave, or labels of a raster from elsewhere, 0: none.

        Returns
        -------
        tuple of Tracked, or ndarray
            Of a `Segmentation` what each of its objects is, that of ``objects[i]`` at i. Of labels
            the number of the object of each.
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
