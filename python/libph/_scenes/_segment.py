# SPDX-License-Identifier: MIT
"""Finds objects in a point cloud or a depth image, by H0 persistence of its surface."""
from __future__ import annotations

import inspect
import logging
import math
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _arrays, _core, _options, _run
from .._errors import MemoryLimitError, UsageError
from ._clouds import scene_of
from ._segmentation import Segmentation

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from .._run import RunOptions

_LOG = logging.getLogger("libph")
_METHODS = ("surface", "paper", "supervoxels")
# Options for reading the scene. All others control the segmentation.
_OF_INPUT = ("cloud", "colours", "intrinsics", "camera", "depth_scale", "run")
_MOST_STEPS = 2**31 - 1
_SPACING, _DISTANCE, _STEPS, _NOISE = 0.03, 0.025, 10, 0.005


def segment(cloud: Any, *, method: str | None = None, supervoxels: float | None = None,
            voxel: float | None = None, min_persistence: float | None = None,
            min_part: int | None = None, min_size: int | None = None,
            objects: bool | None = None, max_range: float = 2.0, crop: ArrayLike | None = None,
            plane: bool | int = True, plane_distance: float | None = None,
            plane_noise: float | None = None, previous: Segmentation | None = None,
            viewpoint: Sequence[float] | None = None,
            distance: float | None = None, steps: int | str | None = None, check: bool = True,
            colours: Any = None, intrinsics: ArrayLike | None = None, camera: Any = None,
            depth_scale: float | None = None, **run: Unpack[RunOptions]) -> Segmentation:
    """Segments a point cloud or a depth image into objects.

    All lengths are in metres. Doubts about the result, such as a missing plane or lengths that look
    like millimetres, are issued as a ``UserWarning`` and stored in `Segmentation.meta`.

    Parameters
    ----------
    cloud : array_like or path
        Points in space (n, 3), or (rows, columns, 3) as a camera sees them, with NaN where it sees
        nothing. With `intrinsics` or `camera`, a depth image (rows, columns): floats are metres,
        integers millimetres, and values up to 0 are holes. Or the path of a file of either kind, or
        of a tree that `Segmentation.save` wrote; a tree accepts no other options.
    method : {None, "surface", "paper", "supervoxels"}
        "surface" (default): by the shape of the surface. "paper": by distance alone, as in Beksi &
        Papanikolopoulos, ICRA 2016. "supervoxels": into pieces of similar size.
    supervoxels : float, optional
        For "supervoxels": the largest distance of the surface from a seed. Default: 0.03.
    voxel : float, optional
        The edge of a voxel. Default: 0.005, or more for a sparse cloud; "paper": 0.01.
    min_persistence : float, optional
        The least persistence of a part. For "surface", its unit is the noise: the concavity that
        the free part of the supporting plane shows. Default: 1. For "supervoxels", it is a length.
        Default: 0.
    min_part : int, optional
        The fewest voxels of a part; a smaller part joins a neighbour. Default: 200; for
        "supervoxels" 8. Not for "paper".
    min_size : int, optional
        The fewest voxels of an object. Default: 32; for "supervoxels" 1.
    objects : bool, optional
        If True, the visible parts of one object are joined. Default: True. Only for "surface".
    max_range : float
        Points farther from the viewpoint are left out.
    crop : array_like, optional
        Points outside this box are left out: xmin, xmax, ymin, ymax, zmin, zmax.
    plane : bool or int
        If True, the supporting plane and everything behind it are removed. A number N >= 1 is the
        most supports, such as the boards of a shelf; True means at most 8.
    plane_distance : float, optional
        Half the thickness of the plane. Default: 0.005; "paper": 0.006.
    plane_noise : float, optional
        The least half thickness at a range of one metre; it grows with the square of the range.
        Default: 0.005. Not for "paper".
    previous : Segmentation, optional
        The segmentation of the previous frame, from the same camera. The search for the supporting
        plane starts at the plane of that frame, so that the plane does not jump.
    viewpoint : sequence of float, optional
        The position of the sensor. Default: the position that the file or the rays of the pixels
        give, otherwise the origin.
    distance : float, optional
        For "paper": the largest distance that joins two voxels. Default: 0.025.
    steps : int or "exact", optional
        For "paper": the number of steps of the filtration up to `distance`. Default: 10.
    check : bool
        If True, persistence is computed twice, by union-find and by reduction of a matrix, and
        compared.
    colours : array_like or path, optional
        Red, green and blue of each point or pixel, as bytes or as floats from 0 to 1. The
        segmentation does not use them; they appear in files and pictures. If `cloud` is the path of
        a depth image, the path of an image.
    intrinsics : array_like, optional
        For a depth image: fx, fy, cx, cy in pixels, or the matrix of the camera (3, 3).
    camera : str or path, optional
        Instead of `intrinsics`: a calibration file (camera_info of ROS, OpenCV, Open3D, RealSense,
        BOP, or the nine numbers of a matrix), or the name of a camera, such as "realsense-d435".
    depth_scale : float, optional
        Number of units per metre of a depth image, or of the coordinates of a cloud: 1000 for
        millimetres. All results are in metres. Default: the scale of the camera, else 1000 for
        depths of whole numbers, else 1.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Segmentation

    Examples
    --------
    Two boxes on a table, seen from above:

    >>> rows, columns = np.mgrid[0:240, 0:320]
    >>> depth = np.full((240, 320), 0.8)
    >>> depth[60:120, 60:120] = 0.7
    >>> depth[100:180, 180:260] = 0.72
    >>> found = ph.segment(depth, intrinsics=(260, 260, 159.5, 119.5))
    >>> found
    Segmentation(240 x 320 points, method surface: 2 objects)
    >>> found.labels[[90, 140, 0], [90, 220, 0]].tolist()
    [2, 1, 0]
    """
    given = dict(locals())
    _run.check_names("segment", given["run"], segment)
    scene = scene_of(cloud, colours=colours, intrinsics=intrinsics, camera=camera,
                     depth_scale=depth_scale, run=given["run"])
    if isinstance(scene.cloud, _core.Segmentation):
        _require_no_options(given)
        return Segmentation._of(scene.cloud, scene.name, [])
    options = _options_of(given)
    try:
        found = _run.run(_core.segment, scene.cloud, options, options=given["run"])
    except MemoryLimitError as error:
        edges = "distance or " if given["method"] == "paper" else ""
        message = str(error).removesuffix(_run.LARGER_LIMIT)
        raise MemoryLimitError(f"{message}; lower {edges}max_range, enlarge voxel, or raise "
                               "memory_limit") from None
    return Segmentation._of(found, scene.name, _told(scene.cloud, scene.name, found))


def _told(cloud: _core.Cloud, name: str, found: _core.Segmentation) -> list[str]:
    """The warnings for the user, which the result also keeps."""
    for note in cloud.notes:
        _LOG.info("%s: %s", name or "cloud", note)
    doubts = cloud.guesses + found.notes
    for doubt in doubts:
        warnings.warn(doubt, UserWarning, stacklevel=3)
    return cloud.notes + doubts


def _require_no_options(given: dict[str, Any]) -> None:
    for name, parameter in inspect.signature(segment).parameters.items():
        value, default = given[name], parameter.default
        is_default = value is default or (
            isinstance(value, (bool, int, float, np.generic)) and value == default)
        if name not in _OF_INPUT and not is_default:
            raise UsageError(f"{name}: does nothing for a stored tree, which keeps the options it "
                             "was made with; Segmentation.cut makes another cut")


def _options_of(o: dict[str, Any]) -> _core.SegmentOptions:
    """The options in the form that _core expects. Refuses an option that has no effect."""
    method = o["method"]
    if o["supervoxels"] is not None:
        if method not in (None, "supervoxels"):
            raise UsageError(f"supervoxels: found method={method!r}, expected method='supervoxels' "
                             "or no method")
        method = "supervoxels"
    method = "surface" if method is None else _options.choice("method", method, _METHODS)
    supports = None
    if type(o["plane"]) is int:
        supports = _options.whole("plane", o["plane"], 1, 255)
    plane = supports is not None or _options.flag("plane", o["plane"])
    if supports is not None and method != "surface":
        raise UsageError(f"plane: found {supports} with method {method!r}, expected True or False, "
                         "or method 'surface'")
    idle = [(name, plane, "plane=True") for name in ("plane_distance", "plane_noise", "previous")]
    idle += [(name, method != "paper", "method 'surface' or 'supervoxels'")
             for name in ("min_persistence", "min_part", "plane_noise")]
    idle += [(name, method == "paper", "method 'paper'") for name in ("distance", "steps")]
    idle += [("objects", method == "surface", "method 'surface'")]
    for name, works, expected in idle:
        if o[name] is not None and not works:
            raise UsageError(f"{name}: does nothing here, expected {expected}")
    return _core.SegmentOptions(
        method=method, voxel=_if_given(_options.positive, "voxel", o),
        min_size=_if_given(_at_least_one, "min_size", o),
        max_range=_options.real("max_range", o["max_range"], "a length, at least 0", 0),
        crop=_if_given(_box, "crop", o), plane=plane,
        most_supports=supports,
        plane_distance=_if_given(_options.positive, "plane_distance", o),
        plane_noise=_if_given(_length, "plane_noise", o, _NOISE),
        plane_guess=_if_given(_plane_of, "previous", o),
        viewpoint=_if_given(_point, "viewpoint", o), check=_options.flag("check", o["check"]),
        min_persistence=_if_given(_at_least_zero, "min_persistence", o),
        objects=_if_given(_options.flag, "objects", o, True),
        min_part=_if_given(_at_least_one, "min_part", o),
        spacing=_if_given(_options.positive, "supervoxels", o, _SPACING),
        distance=_if_given(_length, "distance", o, _DISTANCE),
        steps=_if_given(_steps, "steps", o, _STEPS))


def _if_given(check: Any, name: str, options: dict[str, Any], default: Any = None) -> Any:
    value = options[name]
    return default if value is None else check(name, value)


def _plane_of(name: str, value: Any) -> tuple[float, ...] | None:
    """The plane of a segmentation, and the share of the points that belong to it."""
    if not isinstance(value, Segmentation):
        raise _options.refuse(name, value, "the result of ph.segment for the previous frame")
    plane = value.meta.get("plane")
    return None if plane is None else (*plane, value.meta["plane_share"])


def _at_least_one(name: str, value: Any) -> int:
    return _options.whole(name, value, 1)


def _at_least_zero(name: str, value: Any) -> float:
    return _options.real(name, value, "a number, at least 0", 0)


def _length(name: str, value: Any) -> float:
    length = _options.real(name, value, "a finite length, at least 0", 0)
    if math.isinf(length):
        raise _options.refuse(name, value, "a finite length, at least 0")
    return length


def _steps(name: str, value: Any) -> int:
    """The number of steps; 0 stands for 'exact'."""
    if isinstance(value, str):
        if value != "exact":
            raise _options.refuse(name, value, "a whole number of at least 1, or 'exact'")
        return 0
    return _options.whole(name, value, 1, _MOST_STEPS)


def _point(name: str, value: Any) -> list[float]:
    numbers = _arrays.as_float64(_arrays.as_array(value, name), name)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise _options.refuse(name, value, "three finite numbers x, y, z")
    return [float(number) for number in numbers]


def _box(name: str, value: Any) -> list[list[float]]:
    """The two corners of a box."""
    numbers = _arrays.as_float64(_arrays.as_array(value, name), name)
    expected = "xmin, xmax, ymin, ymax, zmin, zmax, each minimum before its maximum"
    if numbers.shape not in ((6,), (3, 2)):
        raise _options.refuse(name, value, expected)
    corners = numbers.reshape(3, 2).T
    if not (corners[0] <= corners[1]).all():
        raise _options.refuse(name, value, expected)
    return [[float(x) for x in corner] for corner in corners]
