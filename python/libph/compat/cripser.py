# SPDX-License-Identifier: MIT
"""The interface of CubicalRipser's package cripser, on top of libph.

>>> from libph.compat import cripser
>>> ring = np.array([[9, 9, 9, 9, 9], [9, 1, 1, 1, 9], [9, 1, 7, 1, 9], [9, 1, 1, 1, 9],
...                  [9, 9, 9, 9, 9.0]])
>>> cripser.computePH(ring)[1]
array([1., 1., 7., 3., 2., 0., 2., 2., 0.])

docs/how-to/coming-from.md lists the cases in which libph deliberately gives another answer.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _arrays, _options, _run
from .._compute import cubical
from .._core import version as __version__
from .._errors import UsageError
from ._flag import ordered
from ._images import deciding_voxels

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .._run import RunOptions

__all__ = ["__version__", "computePH", "computePH_T", "compute_ph", "dual_embedding",
           "group_by_dim", "to_gudhi_diagrams", "to_gudhi_persistence"]

_NEVER = np.finfo(np.float64).max  # the death of a bar that never dies


def computePH(arr: ArrayLike, maxdim: int = 2, top_dim: bool = False, embedded: bool = False,
              location: str = "yes", **run: Unpack[RunOptions]) -> NDArray[np.float64]:
    """The barcode of an image whose voxels are vertices.

    Parameters
    ----------
    arr : array_like
        Values of voxels, with one to four axes.
    maxdim : int
        The highest dimension of homology.
    top_dim : bool
        If True, only the highest dimension is reported: the number of axes minus one.
    embedded : bool
        If True, the image is negated and surrounded by a layer of -inf, except along a third or
        fourth axis of extent 1. The barcode is dual to the barcode of the other construction.
    location : str
        Has no effect, as in cripser: both locations are always reported.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    ndarray
        One row per bar: dimension, birth, death, the three coordinates of the voxel that has the
        birth value, and the three coordinates of the voxel that has the death value (four
        coordinates each for images with four axes). A bar that never dies has the largest double as
        its death, and zeros as coordinates. A birth at -inf is minus the largest double. Voxels of
        the layer of `embedded` have coordinates -1, or the extent of the image. H0 is sorted by
        death, other dimensions by descending birth.
    """
    return _rows("computePH", arr, "vertices", maxdim, top_dim, embedded, run)


def computePH_T(arr: ArrayLike, maxdim: int = 2, top_dim: bool = False, embedded: bool = False,
                location: str = "yes", **run: Unpack[RunOptions]) -> NDArray[np.float64]:
    """The barcode of an image whose voxels are cubes of the highest dimension.

    Parameters and result are the same as in `computePH`.
    """
    return _rows("computePH", arr, "cells", maxdim, top_dim, embedded, run)


def compute_ph(arr: ArrayLike, *, filtration: str = "V", maxdim: int = 3, top_dim: bool = False,
               embedded: bool = False, location: str = "yes", inf_cutoff: bool = True,
               **run: Unpack[RunOptions]) -> NDArray[np.float64]:
    """`computePH` for the filtration "V", `computePH_T` for "T".

    Other parameters and the result are the same as in `computePH`.

    Parameters
    ----------
    inf_cutoff : bool
        If True, a bar that never dies has the death inf instead of the largest double.
    """
    name = _options.choice("filtration", str(filtration).upper(), ["V", "T"])
    construction = {"V": "vertices", "T": "cells"}[name]
    rows = _rows("compute_ph", arr, construction, maxdim, top_dim, embedded, run)
    if _options.flag("inf_cutoff", inf_cutoff):
        rows[:, 2] = _without_bounds(rows[:, 2])
    return rows


def dual_embedding(arr: ArrayLike) -> NDArray[np.float64]:
    """The image of the corners of voxels: a corner has the least value of the voxels around it.

    The result is larger by one along each axis.

    Parameters
    ----------
    arr : array_like
        Values of voxels, with one to four axes.
    """
    corners = _arrays.as_float64(_image(arr), "arr")
    for axis in range(corners.ndim):
        margin = [(int(k == axis),) * 2 for k in range(corners.ndim)]
        wide = np.pad(corners, margin, constant_values=np.inf)
        corners = np.minimum(np.delete(wide, -1, axis), np.delete(wide, 0, axis))
    return corners


def _image(arr: ArrayLike) -> NDArray[Any]:
    image = _arrays.as_image(arr, "arr")
    if image.ndim > 4:
        raise UsageError(f"arr: found an array of shape {image.shape}, expected 1 to 4 axes; "
                         "ph.cubical takes up to 8")
    return image


def _rows(function: str, arr: ArrayLike, construction: str, maxdim: int, top_dim: bool,
          embedded: bool, run: Any) -> NDArray[np.float64]:
    _run.check_names(function, run, compute_ph)
    image = _image(arr)
    axes = image.ndim
    highest = min(_options.whole("maxdim", maxdim, 0), axes - 1)
    lowest = axes - 1 if _options.flag("top_dim", top_dim) else 0
    if lowest:
        highest = lowest
    margin = np.zeros(axes, dtype=int)
    if _options.flag("embedded", embedded):
        # A third or fourth axis of extent 1 does not count.
        margin[[axis < 2 or n > 1 for axis, n in enumerate(image.shape)]] = 1
        image = np.pad(-_arrays.as_float64(image, "arr"), np.column_stack([margin, margin]),
                       constant_values=-np.inf)
    barcode = cubical(image, construction=construction, min_dim=lowest, max_dim=highest, **run)
    tables = [_table(barcode, dim, image, construction == "vertices", margin)
              for dim in range(lowest, highest + 1)]
    return np.concatenate(tables)


def _table(barcode: Any, dim: int, image: NDArray[Any], is_vertices: bool,
           margin: NDArray[np.int64]) -> NDArray[np.float64]:
    """The rows of `computePH` for one dimension."""
    dgm = barcode.dgm(dim)
    order = ordered(dgm, dim)
    dgm = dgm[order]
    width = max(3, image.ndim)
    rows = np.zeros((len(dgm), 3 + 2 * width))
    rows[:, 0] = dim
    rows[:, 1:3] = np.clip(dgm, -_NEVER, _NEVER)
    dies = np.isfinite(dgm[:, 1])
    born = barcode.birth_cells(dim)[order]
    killed = barcode.death_cells(dim)[order[dies]]
    rows[:, 3:3 + image.ndim] = deciding_voxels(born, image, is_vertices) - margin
    rows[dies, 3 + width:3 + width + image.ndim] = \
        deciding_voxels(killed, image, is_vertices) - margin
    return rows


# ---- conversion for other programs


def _bars_of(ph: ArrayLike, columns: int) -> NDArray[np.float64]:
    rows = np.asarray(ph, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] < columns:
        raise UsageError(f"ph: found an array of shape {rows.shape}, expected rows of computePH")
    return rows


def _without_bounds(numbers: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.where(numbers >= _NEVER / 2, np.inf, numbers)


@_options.with_hints
def to_gudhi_diagrams(ph: ArrayLike, *, maxdim: int | None = None, include_empty: bool = True
                      ) -> list[NDArray[np.float64]]:
    """A diagram for each dimension: rows birth, death, with inf for bars that never die.

    Parameters
    ----------
    ph : array_like
        Rows of `computePH`.
    maxdim : int, optional
        The highest dimension. Default: the highest dimension that occurs.
    include_empty : bool
        If True, dimensions without bars have a diagram as well.
    """
    rows = _bars_of(ph, 3)
    if maxdim is None:
        maxdim = int(rows[:, 0].max(initial=0))
    dgms = [rows[rows[:, 0] == dim, 1:3] for dim in range(maxdim + 1)]
    return [np.column_stack([dgm[:, 0], _without_bounds(dgm[:, 1])]) for dgm in dgms
            if include_empty or len(dgm)]


def to_gudhi_persistence(ph: ArrayLike) -> list[tuple[int, tuple[float, float]]]:
    """The bars as GUDHI lists them: dimension and (birth, death), in the order of the rows.

    Parameters
    ----------
    ph : array_like
        Rows of `computePH`.
    """
    rows = _bars_of(ph, 3)
    return [(int(dim), (birth, death)) for dim, birth, death in
            zip(rows[:, 0].tolist(), rows[:, 1].tolist(), _without_bounds(rows[:, 2]).tolist())]


def group_by_dim(ph: ArrayLike) -> list[NDArray[np.float64]]:
    """The rows of each dimension.

    Parameters
    ----------
    ph : array_like
        Rows of `computePH`, of 9 or 11 columns.
    """
    rows = _bars_of(ph, 9)
    return [rows[rows[:, 0] == dim] for dim in range(int(rows[:, 0].max(initial=0)) + 1)]
