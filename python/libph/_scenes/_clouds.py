# SPDX-License-Identifier: MIT
"""Converts a user's description of a scene into a cloud of _core."""
from __future__ import annotations

import os
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import _arrays, _core, _options, _run
from .._errors import DataError, MissingInputError, UsageError


class Scene(NamedTuple):
    """The input of a segmentation, and its origin."""

    cloud: _core.Cloud | _core.Segmentation  # a SceneTree if a stored tree was read
    name: str                                # path of the file; empty for an array
    is_depth: bool


def scene_of(data: Any, *, colours: Any, intrinsics: Any, camera: Any, depth_scale: Any,
             run: dict[str, Any]) -> Scene:
    """Reads the input from an array or a file."""
    is_path = isinstance(data, (str, bytes, os.PathLike))
    if intrinsics is not None and camera is not None:
        raise UsageError("camera: cannot be combined with intrinsics; leave out one of them")
    name = os.fsdecode(data) if is_path else ""
    scale = None if depth_scale is None else _scale(depth_scale)
    if intrinsics is None and camera is None:
        if not is_path:
            return Scene(_cloud(data, colours, scale, run), name, False)
        if colours is not None:
            raise UsageError("colours: does nothing for a cloud file, whose own colours are read")
        return Scene(_run.run(_core.read_scene, _options.path_of(data, "cloud"), scale,
                              options=run), name, False)
    seen_by = _camera(intrinsics, camera, run)
    if colours is not None and isinstance(colours, (str, bytes, os.PathLike)) != is_path:
        raise _options.refuse("colours", colours, "a path, like the depth image" if is_path
                              else "an array, like the depth image")
    if not is_path:
        return Scene(_depth(data, colours, seen_by, scale, run), name, True)
    cloud = _run.run(_core.read_depth, _options.path_of(data, "cloud"),
                     b"" if colours is None else _options.path_of(colours, "colours"), seen_by,
                     scale, options=run)
    return Scene(cloud, name, True)


def _scale(value: Any) -> float:
    scale = _options.positive("depth_scale", value)
    if scale < 1:
        raise UsageError(f"depth_scale: found {scale}, expected units per metre, at least 1; if a "
                         f"unit is {scale} m, the scale is {1 / scale:.6g}")
    return scale


def _camera(intrinsics: Any, name: Any, run: dict[str, Any]) -> _core.Camera:
    if intrinsics is not None:
        return _core.Camera(*_intrinsics(intrinsics))
    known = _core.camera_named(name) if isinstance(name, str) else None
    if known is not None:
        return known
    if not isinstance(name, (str, bytes, os.PathLike)):
        raise _options.refuse("camera", name, "a path or a name; intrinsics takes numbers")
    path = _options.path_of(name, "camera")
    if not os.path.exists(path):
        raise MissingInputError(f"camera: found {os.fsdecode(path)!r}, expected an existing file "
                                f"or one of {', '.join(_core.camera_names())}")
    return _run.run(_core.read_camera, path, options=run)


def _intrinsics(given: Any) -> list[float]:
    """FX, FY, CX, CY; or a camera matrix as in OpenCV."""
    expected = "fx, fy, cx, cy, or the 3 x 3 matrix [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]"
    if isinstance(given, (str, bytes, os.PathLike)):
        raise _options.refuse("intrinsics", given,
                              f"{expected}; camera takes a file or the name of a camera")
    numbers = _arrays.as_float64(_arrays.as_array(given, "intrinsics"), "intrinsics")
    if numbers.shape == (3, 3):
        fx, fy, cx, cy = (float(numbers[place]) for place in ((0, 0), (1, 1), (0, 2), (1, 2)))
        matrix = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
        if not np.array_equal(numbers, matrix):
            raise _options.refuse("intrinsics", given, expected)
        return [fx, fy, cx, cy]
    if numbers.shape != (4,) or not np.isfinite(numbers).all():
        raise _options.refuse("intrinsics", given, expected)
    return [float(number) for number in numbers]


def _cloud(data: Any, colours: Any, scale: float | None, run: dict[str, Any]) -> _core.Cloud:
    array = _arrays.as_array(data, "cloud")
    if array.size == 0 and array.ndim == 1:
        array = np.empty((0, 3))
    if array.ndim not in (2, 3) or array.shape[-1] != 3:
        hint = ""
        if array.ndim == 2:
            hint = "; a depth image needs intrinsics or camera, colours are given by colours"
        raise UsageError(f"cloud: found an array of shape {array.shape}, expected (points, 3) or "
                         f"(rows, columns, 3){hint}")
    points = _arrays.side_by_side(_arrays.as_float64(array, "cloud"), "cloud")
    infinite = np.isinf(points)
    if infinite.any():
        index = _arrays.first_of(infinite)
        raise DataError(f"cloud: {_arrays.place_of(index)}: found {points[index]}, expected a "
                        "finite number, or nan for a hole")
    bytes_of = None if colours is None else _colours(colours, points.shape[:-1])
    return _run.run(_core.cloud_of_points, points, bytes_of, scale, options=run)


def _depth(data: Any, colours: Any, camera: _core.Camera, scale: float | None, run: dict[str, Any]
           ) -> _core.Cloud:
    array = _arrays.as_array(data, "cloud")
    if array.ndim != 2:
        hint = "; depth[..., 0] is one" if array.ndim == 3 and array.shape[2] == 1 else ""
        raise UsageError(f"cloud: found an array of shape {array.shape}, expected a depth image of "
                         f"rows and columns, because a camera is given{hint}")
    given = data if _arrays.is_masked(data) else array  # masked integers have become floats
    usual = 1.0 if given.dtype.kind == "f" else 1000.0
    image = _arrays.side_by_side(_arrays.as_image(array, "cloud"), "cloud")
    bytes_of = None if colours is None else _colours(colours, array.shape)
    return _run.run(_core.cloud_of_depth, image, bytes_of, camera, usual, scale,
                    options=run)


def _colours(data: Any, shape: tuple[int, ...]) -> NDArray[np.uint8]:
    """The colours as bytes, three or four per point."""
    array = _arrays.as_array(data, "colours")
    if array.shape[:-1] != shape or array.shape[-1] not in (3, 4):
        raise UsageError(f"colours: found an array of shape {array.shape}, expected "
                         f"{(*shape, 3)} or {(*shape, 4)}: red, green, blue and maybe alpha of "
                         "each point")
    if array.dtype == np.uint8:
        return _arrays.side_by_side(array, "colours")
    is_share = array.dtype.kind == "f"
    most = 1 if is_share else 255
    wrong = ~((array >= 0) & (array <= most))
    if wrong.any():
        index = _arrays.first_of(wrong)
        raise DataError(f"colours: {_arrays.place_of(index)}: found {array[index]}, expected a "
                        f"number from 0 to {most} (the array is {array.dtype})")
    bytes_of = np.floor(array * 255 + 0.5) if is_share else array
    return np.asarray(bytes_of, dtype=np.uint8)
