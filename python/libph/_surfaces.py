# SPDX-License-Identifier: MIT
"""Surfaces of alpha complexes, as triangles."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _options, _run
from ._files import path_of
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
        The points, all of them, (n, 2) or (n, 3).
    triangles : ndarray
        Rows of three points, (m, 3). Seen from outside they are counterclockwise.
    singular : ndarray of bool
        Which triangles have no tetrahedron of the complex on either side; they come last. Of
        points of the plane none has.
    """

    vertices: NDArray[np.float64]
    triangles: NDArray[np.int64]
    singular: NDArray[np.bool_]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the surface, with the points that it has, as a PLY or OFF file.

        Parameters
        ----------
        path : path
            Its extension, ``.ply`` or ``.off``, says the format. PLY names the points, too.
        """
        name = path_of(path)
        if not name.lower().endswith((b".ply", b".off")):
            raise _options.refuse("path", path, "a name that ends in .ply or .off")
        _run.run(_core.write_surface, name, np.ravel(self.vertices).astype(np.float64),
                 self.vertices.shape[1], np.ravel(self.triangles).astype(np.int64),
                 int(len(self.triangles) - np.count_nonzero(self.singular)), options={})


def alpha_shape(X: Any, value: float, *, wrap: bool = False, squared: bool | None = None,
                weights: ArrayLike | None = None, nan: str = "error",
                **run: Unpack[RunOptions]) -> Surface:
    """The surface of the alpha complex of points at a value: what balls of that radius enclose.

    Of points of the plane it is all triangles up to the value.

    Parameters
    ----------
    X : array_like
        Points of R^2 or R^3, one a row.
    value : float
        The radius, or its square if `squared`.
    wrap : bool
        The wrap complex instead: the critical simplices up to the value with all that lies below
        them. It has the same holes without frayed edges [Edelsbrunner 2003].
    squared, weights, nan
        As of `alpha`.
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
    options: dict[str, Any] = dict(run)
    _run.check_names("alpha_shape", options, {"X", "value", "wrap", "squared", "weights", "nan"})
    at = _options.real("value", value)
    recipe = alpha_recipe({"squared": squared, "weights": weights}, source_of(X, nan=nan))[0]
    corners, regular = _run.run(_core.surface, recipe, at, _options.flag("wrap", wrap),
                                options=options)
    triangles = np.asarray(corners).reshape(-1, 3)
    return Surface(_arrays.as_points(X), triangles, np.arange(len(triangles)) >= regular)
