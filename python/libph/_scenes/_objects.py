# SPDX-License-Identifier: MIT
"""The objects of a scene, as a table, and the surfaces that bound it."""
from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas

_MOST_ROWS = 30  # number of rows of a table in a notebook


class Segment(NamedTuple):
    """One object of a scene; lengths in metres.

    Attributes
    ----------
    label : int
        Its number in `Segmentation.labels`: 1, 2, ... by decreasing number of points.
    points : int
        Number of its points.
    voxels : int
        Number of its voxels.
    persistence : float
        The value at which the object first meets another object, minus its own lowest value. It
        measures the confidence in the object, and is inf if the object meets no other.
    centroid : ndarray (3,)
        The mean of its points, without the points at its base on the plane. All lengths are in
        metres.
    box : ndarray (2, 3)
        The least and the largest coordinates of its points.
    centre : ndarray (3,)
        The middle of the tight box around its visible part.
    axes : ndarray (3, 3)
        Three unit vectors along the tight box, one per row. If a plane was removed, the last vector
        is the normal of the plane.
    size : ndarray (3,)
        The length of the tight box along each axis.
    neighbours : tuple of (int, float)
        The labels of the objects that it touches, each with the value at which the two meet, in the
        order of these values.
    role : str
        "object", "container" or "support". A container, such as a bin, has at least three other
        objects in it. A support is a leg of a table.
    on : tuple of (str, int) or None
        What it stands on: ("surface", i), where i is an index into `Segmentation.surfaces`, or
        ("object", label). None if this is not visible.
    """

    label: int
    points: int
    voxels: int
    persistence: float
    centroid: NDArray[np.float64]
    box: NDArray[np.float64]
    centre: NDArray[np.float64]
    axes: NDArray[np.float64]
    size: NDArray[np.float64]
    neighbours: tuple[tuple[int, float], ...]
    role: str
    on: tuple[str, int] | None

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Segment):
            return False
        pairs: Iterable[tuple[Any, Any]] = zip(self, other)
        return all(np.array_equal(mine, its) for mine, its in pairs)

    def __ne__(self, other: object) -> bool:
        return not self == other


class SceneSurface(NamedTuple):
    """A plane that bounds a scene; it is not an object.

    Attributes
    ----------
    role : str
        "support": a plane that objects stand on, such as a table. "floor": the lowest of several
        supports. "shelf": a support with another one above or below it. "wall": a plane behind
        which nothing is visible. "ceiling": such a plane that faces the supports.
    plane : tuple of float
        (a, b, c, d) of ax + by + cz + d = 0. The left-hand side is positive for points on the same
        side of the plane as the camera.
    centre : tuple of float
        The middle of the tight box around the points that were removed with the surface.
    axes : tuple of three tuples of float
        Three unit vectors along this box. The last vector is the normal of the plane.
    size : tuple of float
        The length of this box along each axis, in metres; (0, 0, 0) for a wall or a ceiling that
        was found among the segments.
    """

    role: str
    plane: tuple[float, float, float, float]
    centre: tuple[float, float, float]
    axes: tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]
    size: tuple[float, float, float]


class Objects(Sequence[Segment]):
    """The objects of a scene as a table. A row is a `Segment`, and a column is an array or,
    for `role` and `on`, a list."""

    def __init__(self, segments: Iterable[Segment]) -> None:
        self._segments = tuple(segments)

    @overload
    def __getitem__(self, i: int) -> Segment: ...
    @overload
    def __getitem__(self, i: slice) -> Objects: ...

    def __getitem__(self, i: int | slice) -> Segment | Objects:
        found = self._segments[i]
        return found if isinstance(found, Segment) else Objects(found)

    def __len__(self) -> int:
        return len(self._segments)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Objects) and self._segments == other._segments

    def __repr__(self) -> str:
        rows = [f"{s.label}: {s.points} points at ({', '.join(f'{x:.3f}' for x in s.centre)})"
                for s in self._segments[:3]]
        more = ", ..." if len(self) > 3 else ""
        return f"Objects({len(self)}{': ' if rows else ''}{'; '.join(rows)}{more})"

    def _column(self, name: str, kind: Any, shape: tuple[int, ...] = ()) -> NDArray[Any]:
        column = np.array([getattr(s, name) for s in self._segments], dtype=kind)
        return column.reshape(len(self), *shape)

    @property
    def label(self) -> NDArray[np.int64]:
        """The label of each object."""
        return self._column("label", np.int64)

    @property
    def points(self) -> NDArray[np.int64]:
        """The number of points of each object."""
        return self._column("points", np.int64)

    @property
    def voxels(self) -> NDArray[np.int64]:
        """The number of voxels of each object."""
        return self._column("voxels", np.int64)

    @property
    def persistence(self) -> NDArray[np.float64]:
        """The persistence of each object: the confidence in it."""
        return self._column("persistence", np.float64)

    @property
    def centroid(self) -> NDArray[np.float64]:
        """The mean of the points of each object, (k, 3)."""
        return self._column("centroid", np.float64, (3,))

    @property
    def centre(self) -> NDArray[np.float64]:
        """The middle of the tight box of each object, (k, 3)."""
        return self._column("centre", np.float64, (3,))

    @property
    def axes(self) -> NDArray[np.float64]:
        """The axes of the tight box of each object, (k, 3, 3)."""
        return self._column("axes", np.float64, (3, 3))

    @property
    def size(self) -> NDArray[np.float64]:
        """The lengths of the tight box of each object along its axes, (k, 3)."""
        return self._column("size", np.float64, (3,))

    @property
    def role(self) -> list[str]:
        """The role of each object, such as "object" or "container"."""
        return [s.role for s in self._segments]

    @property
    def on(self) -> list[tuple[str, int] | None]:
        """What each object stands on, as `Segment.on`."""
        return [s.on for s in self._segments]

    def to_pandas(self) -> pandas.DataFrame:
        """A DataFrame with one row per object and the label as its index.

        The columns are `points`, `voxels`, `persistence`, `role`, `on`, and one column for each
        number of `centroid`, `centre` and `size`.
        """
        import pandas
        columns: dict[str, Any] = {"points": self.points, "voxels": self.voxels,
                                   "persistence": self.persistence, "role": self.role,
                                   "on": self.on}
        for name in ("centroid", "centre", "size"):
            values = getattr(self, name)
            for k, axis in enumerate("012" if name == "size" else "xyz"):
                columns[f"{name}_{axis}"] = values[:, k]
        return pandas.DataFrame(columns, index=pandas.Index(self.label, name="label"))

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{name}</th>" for name in ("label", "points", "voxels", "persistence",
                                                       "centre (m)", "size (m)"))
        rows = [f"<tr><th>{s.label}</th><td>{s.points}</td><td>{s.voxels}</td>"
                f"<td>{s.persistence:.3g}</td><td>{_numbers(s.centre)}</td>"
                f"<td>{_numbers(s.size)}</td></tr>" for s in self._segments[:_MOST_ROWS]]
        if len(self) > _MOST_ROWS:
            rows.append(f"<tr><td colspan=6>and {len(self) - _MOST_ROWS} more</td></tr>")
        return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"


def _numbers(values: Iterable[float]) -> str:
    return ", ".join(f"{x:.3f}" for x in values)


def standing_on(surface: int, label: int) -> tuple[str, int] | None:
    """What an object stands on: the surface with this number, counted from 1, or the object with
    this label. 0 means none."""
    return ("surface", surface - 1) if surface else ("object", label) if label else None


def segment_of(facts: dict[str, Any]) -> Segment:
    """The `Segment` of an object, made from the facts of _core."""
    arrays = {name: np.array(facts[name]) for name in ("centroid", "box", "centre", "axes", "size")}
    for array in arrays.values():
        array.flags.writeable = False
    on = standing_on(*facts["on"])
    return Segment(facts["label"], facts["points"], facts["voxels"], facts["persistence"],
                   neighbours=tuple(facts["neighbours"]), role=facts["role"], on=on, **arrays)
