# SPDX-License-Identifier: MIT
"""Parts of the components of a point cloud."""
from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _arrays, _core, _options, _run
from .._barcodes import Barcode
from ._part import Part, checked_numbers

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from .._run import RunOptions


class CloudPart(Part):
    """The components of a cloud, as far as some of its blocks determine them; see `cloud_part`.

    A part can be pickled and sent to another process. Two parts are equal if their bytes are equal.

    Attributes
    ----------
    parts : int
        Total number of parts.
    points, coordinates : int
        Number of points of the whole cloud, and of coordinates per point.
    threshold : float or None
        The largest distance at which two points are joined.
    """

    def __init__(self, data: bytes) -> None:
        data = self._checked(data)
        facts = _core.cloud_part_facts(data)
        super().__init__(data)
        self.parts: int = facts["parts"]
        self._present: tuple[int, ...] = facts["present"]
        self.points: int = facts["points"]
        self.coordinates: int = facts["coordinates"]
        self.threshold: float | None = facts["threshold"]

    def barcode(self, *, cells: bool = True, **run: Unpack[RunOptions]) -> Barcode:
        """The bars of H0 of the cloud, identical to the bars of `rips` with ``max_dim=0``.

        Parameters
        ----------
        cells : bool
            If True, bars store the cells of their birth and death. Without cells, a bar takes 24
            bytes.
        **run
            `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

        Raises
        ------
        DataError
            If parts are missing, or if the cloud changed during the computation.
        """
        _run.check_names("barcode", run, self.barcode)
        meta = {"complex": "rips", "field": 2, "points": self.points,
                "coordinates": self.coordinates, "metric": "euclidean"}
        return Barcode._of(_run.run(_core.cloud_part_bars, self._bytes,
                                    _options.flag("cells", cells), options=dict(run)), meta)

    def __repr__(self) -> str:
        return (f"CloudPart({self._words()}, {self.points} points in R^{self.coordinates}, "
                f"{len(self._bytes)} bytes)")


def cloud_part(points: ArrayLike, part: int, parts: int, *, threshold: float | None = None,
               **run: Unpack[RunOptions]) -> CloudPart:
    """Computes the components (H0) of some blocks of a point cloud: one of several parts.

    Each part reads all points but holds one block at a time, at about 200 bytes per point. The
    points may therefore be a memory map, ``numpy.load(path, mmap_mode="r")``, that is larger than
    the memory of any machine: points in float64 stay in the file.

    Parameters
    ----------
    points : array_like
        Points of at most 8 coordinates, one per row. Distances are Euclidean.
    part : int
        Index of this part, from 0.
    parts : int
        Number of parts, the same for all parts.
    threshold : float, optional
        The largest distance at which two points are joined, in the unit of the points. Default: no
        limit. It must be the same for all parts.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    CloudPart

    Raises
    ------
    DataError
        If a coordinate is not a finite number.
    UsageError
        If the points have more than 8 coordinates.

    Examples
    --------
    >>> points = np.random.default_rng(0).random((50, 3))
    >>> parts = [ph.cloud_part(points, i, 3) for i in range(3)]
    >>> ph.join_parts(parts).barcode() == ph.rips(points, max_dim=0)
    True
    """
    _run.check_names("cloud_part", run, cloud_part)
    array = _arrays.as_points(points, "points")
    number, count = checked_numbers(part, parts)
    limit = None if threshold is None else _options.real("threshold", threshold,
                                                         "a distance, at least 0", 0)
    return CloudPart(_run.run(_core.cloud_part, array, number, count, limit, options=dict(run)))
