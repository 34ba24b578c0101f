# SPDX-License-Identifier: MIT
"""The result of a segmentation."""
from __future__ import annotations

import functools
import html
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import _core, _options, _run
from .._barcodes import Barcode
from .._results import Meta, in_brief, require_version, with_arrays
from .._errors import UsageError
from .._report import Report, require_page
from .._trees import MergeTree
from ._objects import Objects, SceneSurface, segment_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .._run import RunOptions

_FORMATS = {".npy": "npy", ".png": "png", ".csv": "csv", ".txt": "csv", ".pcd": "pcd",
            ".ply": "ply", ".tree": "tree", ".json": "json"}
_STATE_VERSION = 1


class Voxels(NamedTuple):
    """The voxels of a scene: the vertices of its filtered graph.

    Attributes
    ----------
    centroids : ndarray
        The mean of the points in each voxel, (v, 3).
    normals : ndarray or None
        The normal of the surface in each voxel, NaN where there is none, (v, 3). None for method
        "paper".
    points : ndarray
        Number of points in each voxel.
    labels : ndarray
        The object of each voxel; 0 for none.
    of_point : ndarray
        The voxel of each point of the cloud; -1 for none. It has the shape of
        `Segmentation.labels`.
    """

    centroids: NDArray[np.float64]
    normals: NDArray[np.float64] | None
    points: NDArray[np.int64]
    labels: NDArray[np.uint32]
    of_point: NDArray[np.int64]

    def __repr__(self) -> str:
        return in_brief(self)


@_options.with_hints
class Segmentation:
    """The objects of a scene: a merge tree and one cut of it.

    A segmentation is immutable. Two segmentations are equal if their trees and cuts are equal.

    Attributes
    ----------
    labels : ndarray
        The object of each point; 0 for none. Shape (rows, columns) if the cloud has rows and
        columns, else (n,). Read-only.
    objects : Objects
        The properties of each object.
    surfaces : tuple of SceneSurface
        The planes that bound the scene: the removed plane, other supports, walls.
    surface_labels : ndarray
        The surface of each point, counted from 1; 0 for none. It has the shape of `labels`.
        Read-only.
    points : ndarray
        The points of the cloud, in the order of `labels`.
    tree : MergeTree
        The merge tree of the voxels. `voxels` gives their positions.
    voxels : Voxels
        The vertices of the tree.
    barcode : Barcode
        The H0 barcode of the tree, including bars of length 0.
    meta : Mapping
        How it was made: `method`, `voxel`, `plane` (a, b, c, d of ax + by + cz + d = 0),
        `viewpoint`, the cut, `noise` (pairs of a range and of the concavity that a flat surface
        shows there), and `notes`.
    """

    _found: _core.Segmentation
    labels: NDArray[np.uint32]
    objects: Objects
    surfaces: tuple[SceneSurface, ...]
    surface_labels: NDArray[np.uint8]
    meta: Mapping[str, Any]

    def __init__(self) -> None:
        raise TypeError("a Segmentation cannot be constructed directly; ph.segment returns one")

    @classmethod
    def _of(cls, found: _core.Segmentation, name: str, notes: Sequence[str],
            version: str = _core.version) -> Segmentation:
        self = object.__new__(cls)
        self._found = found
        self.labels = np.asarray(found.labels)
        self.labels.flags.writeable = False
        known = {"path": name, "shape": self.labels.shape, **found.facts, "notes": tuple(notes),
                 "version": version}
        self.meta = Meta({key: value for key, value in known.items() if value != ""})
        self.objects = Objects(segment_of(facts) for facts in found.segments)
        self.surfaces = tuple(SceneSurface(*facts) for facts in found.surfaces)
        self.surface_labels = np.asarray(found.surface_labels)
        self.surface_labels.flags.writeable = False
        return self

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Segmentation):
            return NotImplemented
        return self._found is other._found or np.array_equal(np.asarray(self._found.tree_file()),
                                                             np.asarray(other._found.tree_file()))

    def __hash__(self) -> int:
        return hash(np.asarray(self._found.tree_file()).tobytes())

    def __copy__(self) -> Segmentation:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Segmentation:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        told = (self.meta.get("path", ""), self.meta["notes"], self.meta["version"])
        return (_restored, (_STATE_VERSION, with_arrays(self._found.state()), told))

    @property
    def points(self) -> NDArray[np.float64]:
        """The points of the cloud, in metres and in the order of `labels`: ``points[labels == 1]``
        are the points of the first object. Shape ``(*labels.shape, 3)``; a hole has NaN.

        Raises UsageError for a stored tree, which has no cloud.
        """
        if not self._found.has_cloud:
            raise UsageError("points: a stored tree has no cloud; its voxels have centroids")
        return np.asarray(self._found.points).reshape(*self.labels.shape, 3)

    @property
    def tree(self) -> MergeTree:
        """The merge tree of the voxels."""
        return MergeTree(self._found.tree, None)

    @property
    def voxels(self) -> Voxels:
        """The voxels that are the vertices of the tree."""
        normals = np.asarray(self._found.normals)
        return Voxels(np.asarray(self._found.centroids),
                      None if self.meta["method"] == "paper" else normals,
                      np.asarray(self._found.counts), np.asarray(self._found.voxel_labels),
                      np.asarray(self._found.voxel_of_point))

    @property
    def barcode(self) -> Barcode:
        """The H0 barcode of the tree."""
        paper = self.meta["method"] == "paper"
        meta = {"complex": "rips" if paper else "lower-star", "points": self.meta["voxels"]}
        return Barcode._of(self._found.barcode, meta)

    # ---- other cuts

    def cut(self, value: float | None = None, *, n: int | None = None, min_part: int | None = None,
            min_size: int | None = None, objects: bool | None = None,
            **run: Unpack[RunOptions]) -> Segmentation:
        """A coarser or finer segmentation of the same tree, in milliseconds.

        Parameters
        ----------
        value : float, optional
            The least persistence of a part; for method "paper", the distance up to which voxels
            join, at most the distance of the tree. Default: unchanged.
        n : int, optional
            Instead of `value`: the number of objects to find. If the cut already has this many
            objects, it does not change.
        min_part, min_size, objects
            As in `segment`. Default: unchanged.
        **run
            `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

        Returns
        -------
        Segmentation

        Raises
        ------
        UsageError
            If no cut was found that has `n` objects.
        """
        _run.check_names("cut", dict(run), self.cut)
        method = self.meta["method"]
        if min_part is not None:
            if method == "paper":
                raise UsageError("min_part: does nothing for method 'paper'")
            min_part = _options.whole("min_part", min_part, 1)
        if min_size is not None:
            min_size = _options.whole("min_size", min_size, 1)
        if objects is not None:
            if method != "surface":
                raise UsageError(f"objects: does nothing for method '{method}'")
            objects = _options.flag("objects", objects)
        if value is not None:
            value = _options.real("value", value, "a number, at least 0", 0)
            if n is not None:
                raise UsageError("n: cannot be combined with value; leave out one of them")
            if value > self.meta.get("distance", np.inf):
                raise _options.refuse("value", value, f"at most {self.meta['distance']}, the "
                                      "distance up to which the tree was made")

        def found_at(value: float | None) -> _core.Segmentation:
            return _run.run(self._found.cut, value, min_part, min_size, objects,
                            options=dict(run))

        found = found_at(value)
        if n is not None:
            n = _options.whole("n", n, 0)
            if len(found.segments) != n:
                found = found_at(self._value_of(n, min_part, min_size, found_at))
            if len(found.segments) != n:
                raise _no_cut(n, [str(len(found.segments))])
        return Segmentation._of(found, self.meta.get("path", ""), self.meta["notes"])

    def _value_of(self, n: int, min_part: int | None, min_size: int | None, found_at: Any
                  ) -> float:
        """The cut value for this number of objects."""
        tree = self._found.tree
        sizes = np.sort(np.column_stack([np.asarray(tree.elder_sizes),
                                         np.asarray(tree.younger_sizes)]), axis=1)
        values = np.asarray(tree.values)
        if self.meta["method"] == "paper":
            return _distance_of(n, np.append(0.0, values), np.concatenate([[[0, 0]], sizes]),
                                self.meta["voxels"], min_size or self.meta["min_size"])
        separates = sizes[:, 0] >= (min_part or self.meta["min_part"])
        births = np.asarray(tree.births)[np.asarray(tree.younger)]
        # Between two consecutive levels, all cuts are equal. The last level joins everything that
        # can be joined.
        levels = np.unique(np.append((values - births)[separates], 0.0))
        levels = np.append(levels, np.nextafter(levels[-1], np.inf))

        @functools.lru_cache(maxsize=None)
        def count(i: int) -> int:
            return len(found_at(float(levels[i])).segments)

        def first_with(most: int) -> int:
            """Bisection works because a coarser cut has fewer objects."""
            low, high = 0, len(levels)
            while low < high:
                middle = (low + high) // 2
                low, high = (low, middle) if count(middle) <= most else (middle + 1, high)
            return low

        first, end = first_with(n), first_with(n - 1)
        if first == end:
            counts = [str(count(i)) for i in (first - 1, first) if 0 <= i < len(levels)]
            raise _no_cut(n, counts)
        if end == len(levels):
            return float(levels[first])
        return float((levels[max(first - 1, 0)] + levels[end - 1]) / 2)

    # ---- more about objects

    def signature(self, *labels: int, **run: Unpack[RunOptions]) -> Barcode:
        """The loops and hollows of an object, or of several objects together.

        A bar of dimension 1 is a loop. The loop closes when the voxels have grown by the birth of
        the bar, and the death of the bar is the radius of the largest ball that fits through the
        loop. Lengths are in metres.

        Parameters
        ----------
        *labels : int
            Labels of the objects.
        **run
            `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.
        """
        _run.check_names("signature", dict(run), self.signature)
        chosen = [self._label("labels", label) for label in labels]
        if not chosen:
            raise UsageError("labels: found none, expected the label of an object")
        bars = _run.run(self._found.signature, chosen, options=dict(run))
        return Barcode._of(bars, {"complex": "cubical", "field": 2})

    def first_meeting(self, a: int, b: int) -> tuple[float, NDArray[np.float64]] | None:
        """The value at which two objects first meet, and where they meet; None if they never do."""
        meeting = self._found.first_meeting(self._label("a", a), self._label("b", b))
        return None if meeting is None else (meeting[0], np.array(meeting[1]))

    def _label(self, name: str, label: Any) -> int:
        if not self.objects:
            raise UsageError(f"{name}: found {label!r}, but there are no objects")
        return _options.whole(name, label, 1, len(self.objects))

    # ---- output

    def save(self, path: str | os.PathLike[str], format: str | None = None) -> None:
        """Writes a file, completely or not at all.

        Parameters
        ----------
        path : path
            The file; its extension selects content and format. The labels: .npy, .png (16 bits,
            rows and columns) or .csv. The cloud with all its fields and the labels: .pcd or .ply.
            The tree: .tree, for `segment` and the program ph-segment, or .json.
        format : str, optional
            One of these extensions without its dot.
        """
        file = _options.path_of(path)
        extension = os.path.splitext(os.fsdecode(file))[1].lower()
        known = _FORMATS.get(extension) if format is None else format
        if known not in _FORMATS.values():
            raise _options.refuse("format" if format else "path", format or os.fsdecode(file),
                                  ", ".join(_FORMATS) if format is None
                                  else ", ".join(dict.fromkeys(_FORMATS.values())))
        if known in ("pcd", "ply") and not self._found.has_cloud:
            raise UsageError(f"format: found {known}, but a stored tree has no cloud")
        if known == "png" and self.labels.ndim == 1:
            raise UsageError("format: found png for a cloud without rows and columns, expected npy "
                             "or csv")
        _run.run(self._found.save, file, known, options={})

    def report(self, *, title: str = "", **run: Unpack[RunOptions]) -> Report:
        """An interactive page of points and merge tree, as ``ph-segment --report`` writes it.

        Parameters
        ----------
        title : str
            Title of the page. Default: the name of the file, or a description of the scene.
        **run
            `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

        Returns
        -------
        Report

        Raises
        ------
        NotBuiltIn
            If libph was built without npm.
        """
        _run.check_names("report", dict(run), self.report)
        require_page()
        path = self.meta.get("path", "")
        title = str(title) or os.path.basename(path) or repr(self)
        meta = {"program": f"libph {_core.version}", "input": path}
        page = _run.run(_core.page_of_scene, self._found, title, meta, list(self.meta["notes"]),
                        options=dict(run))
        return Report._of(page, title)

    def __repr__(self) -> str:
        shape = " x ".join(map(str, self.labels.shape))
        count = len(self.objects)
        what = "supervoxel" if self.meta["method"] == "supervoxels" else "object"
        return (f"Segmentation({shape} points, method {self.meta['method']}: {count} {what}"
                f"{'' if count == 1 else 's'})")

    def _repr_html_(self) -> str:
        svg = _run.run(self._found.svg, options={})
        notes = "".join(f"<div>{html.escape(note)}</div>" for note in self.meta["notes"])
        return (f"<div>{html.escape(repr(self))}{notes}<div>{svg[svg.find('<svg'):]}</div>"
                f"{self.objects._repr_html_()}</div>")


def _restored(version: int, state: dict[str, Any], told: tuple[str, Sequence[str], str]
              ) -> Segmentation:
    """Called by pickle."""
    require_version(version, _STATE_VERSION)
    found = _run.run(_core.Segmentation.from_state, state, options={})
    return Segmentation._of(found, *told)


def _distance_of(n: int, values: NDArray[np.float64], sizes: NDArray[np.int64], voxels: int,
                 least: int) -> float:
    """The largest distance at which `n` components have at least `least` voxels.

    Parameters
    ----------
    values, sizes
        For each merge, in order: its distance, and the number of voxels on both sides, the smaller
        first.
    """
    gained = (sizes[:, 1] < least) & (sizes.sum(axis=1) >= least)
    lost = (sizes[:, 0] >= least).astype(int)
    counts = (voxels if least == 1 else 0) + np.cumsum(gained - lost)
    is_last = np.append(values[1:] != values[:-1], True)
    reached = np.flatnonzero(is_last & (counts == n))
    if not len(reached):
        found = np.unique(counts[is_last])
        below, above = found[found < n][-1:], found[found > n][:1]
        raise _no_cut(n, [str(count) for count in (*below, *above)])
    return float(values[reached[-1]])


def _no_cut(n: int, counts: Sequence[str]) -> UsageError:
    return UsageError(f"n: found no cut into {n} objects; the nearest cuts give "
                      f"{' and '.join(counts) or 'none'}")
