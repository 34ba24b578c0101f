# SPDX-License-Identifier: MIT
"""Surfaces of alpha complexes, as triangles."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _options, _results, _run
from ._errors import DataError, UsageError
from ._requests import alpha_recipe
from ._sources import source_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._run import RunOptions


class Surface(NamedTuple):
    """A surface as triangles; see `alpha_shape`.

    Attributes
    ----------
    vertices : ndarray
        All points, (n, 2) or (n, 3); (0, 3) if there are no points.
    triangles : ndarray
        Rows of three points, (m, 3). Seen from outside, they are counterclockwise.
    singular : ndarray of bool
        True for triangles without a tetrahedron of the complex on either side; they come last. For
        points in a plane, False for all triangles.
    """

    vertices: NDArray[np.float64]
    triangles: NDArray[np.int64]
    singular: NDArray[np.bool_]

    def __repr__(self) -> str:
        return _results.in_brief(self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the surface and its points as a PLY or OFF file.

        Parameters
        ----------
        path : path
            The file; its extension, ``.ply`` or ``.off``, selects the format. PLY also stores the
            numbers of the points.

        Raises
        ------
        UsageError, DataError
            If the arrays do not fit together as they do in the result of `alpha_shape`.
        """
        name = _options.path_of(path)
        if not name.lower().endswith((b".ply", b".off")):
            raise _options.refuse("path", path, "a name that ends in .ply or .off")
        points, triangles, regular = self._checked()
        _run.run(_core.write_surface, name, points.ravel(), points.shape[1], triangles.ravel(),
                 regular, options={})

    def _checked(self) -> tuple[NDArray[np.float64], NDArray[np.int64], int]:
        """The vertices, the triangles, and the number of triangles that are not singular."""
        points = _arrays.as_points(self.vertices, "vertices")
        if points.shape[1] not in (2, 3):
            raise UsageError(f"vertices: found an array of shape {points.shape}, expected (n, 2) "
                             "or (n, 3)")
        triangles = _arrays.as_integers(self.triangles, "triangles")
        if triangles.ndim != 2 or triangles.shape[1] != 3:
            raise UsageError(f"triangles: found an array of shape {triangles.shape}, expected "
                             "(m, 3)")
        beyond = (triangles < 0) | (triangles >= len(points))
        if beyond.any():
            row, column = (int(k) for k in np.argwhere(beyond)[0])
            raise DataError(f"triangles: {_arrays.place_of((row, column))}: found "
                            f"{triangles[row, column]}, expected one of {len(points)} points, "
                            "counted from 0")
        singular = _arrays.as_array(self.singular, "singular")
        if singular.shape != (len(triangles),) or singular.dtype.kind != "b":
            raise UsageError(f"singular: found {singular.dtype} of shape {singular.shape}, "
                             f"expected bool of shape ({len(triangles)},), one for each triangle")
        regular = len(triangles) - int(np.count_nonzero(singular))
        if singular[:regular].any():
            raise DataError(f"singular: entry {int(np.argmax(singular))}: found True before False, "
                            "expected singular triangles to come last")
        return points, triangles, regular


def alpha_shape(X: Any, value: float, *, wrap: bool = False, squared: bool | None = None,
                weights: ArrayLike | None = None, nan: str = "error",
                **run: Unpack[RunOptions]) -> Surface:
    """The surface of the alpha complex of points at a value.

    The complex is homotopy equivalent to the union of the balls of that radius. For points in the
    plane, the surface consists of all triangles with values up to `value`.

    Parameters
    ----------
    X : array_like
        Points in R^1, R^2 or R^3, one per row.
    value : float
        The radius of the balls, or its square if `squared` is True.
    wrap : bool
        If True, use the wrap complex instead: the critical simplices up to the value with
        everything below them in the gradient. The alpha complex collapses onto the wrap complex;
        both have the same holes [Edelsbrunner 2003].
    squared, weights, nan
        As in `alpha`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Surface

    Examples
    --------
    >>> cube = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    >>> len(ph.alpha_shape(cube, 1).triangles)
    12
    """
    _run.check_names("alpha_shape", run, alpha_shape)
    at = _options.real("value", value)
    source = source_of(X, nan=nan)
    recipe = alpha_recipe({"squared": squared, "weights": weights}, source)[0]
    corners, regular = _run.run(_core.surface, recipe, at, _options.flag("wrap", wrap),
                                options=dict(run))
    triangles = np.asarray(corners).reshape(-1, 3)
    # A copy, so that the surface does not change with the caller's array.
    vertices = np.array(_arrays.as_points(X)) if source.points else np.empty((0, 3))
    return Surface(vertices, triangles, np.arange(len(triangles)) >= regular)
