# SPDX-License-Identifier: MIT
"""Tables and label images that show where the holes of a barcode are."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .._errors import UsageError

if TYPE_CHECKING:
    from ._barcode import Barcode

_COORDINATES = "xyz"


def columns_of_places(bars: Barcode) -> dict[str, Any]:
    """The columns of `Barcode.to_pandas(places=True)`, without dim, birth and death."""
    if not len(bars):
        return {}
    if bars._bars.representatives == "voxels":
        return _columns_of_voxels(bars)
    if not bars._bars.has_cells:
        raise bars._found_none("cells", "computed with cells=True")
    if bars._bars.cell_kind == "grid":
        raise bars._found_none("voxels", "of an image computed with representatives='voxels'")
    places = range(len(bars))
    deaths = [bars.death_cell(i) for i in places]
    centroids = np.asarray(bars._bars.centroids)
    return {"birth_vertices": [tuple(bars.birth_cell(i).tolist()) for i in places],
            "death_vertices": [None if cell is None else tuple(cell.tolist()) for cell in deaths],
            **{f"centroid_{axis}": column for axis, column in enumerate(centroids.T)}}


def _columns_of_voxels(bars: Barcode) -> dict[str, Any]:
    axes = len(bars._require_voxels())
    ends = {end: np.full((len(bars), axes), np.nan) for end in ("birth", "death", "centroid")}
    sizes = np.zeros(len(bars), dtype=np.int64)
    for i in range(len(bars)):
        ends["birth"][i] = bars.birth_voxel(i)
        ends["death"][i] = bars.death_voxel(i) or np.nan
        ends["centroid"][i], sizes[i] = _centre(bars, i)
    columns: dict[str, Any] = {}
    for end, places in ends.items():
        for axis in range(axes):
            columns[f"{end}_{axis}"] = places[:, axis]
    columns["voxels"] = sizes
    affine = bars.affine
    if affine is None:
        return columns
    matrix = affine[:3, :min(3, axes)]
    for end, places in ends.items():
        in_space = places[:, :3] @ matrix.T + affine[:3, 3]
        for name, values in zip(_COORDINATES, in_space.T):
            columns[f"{end}_{name}"] = values
    if axes == 3:
        columns["volume"] = sizes * abs(np.linalg.det(matrix))
    return columns


def _centre(bars: Barcode, i: int) -> tuple[NDArray[np.float64], int]:
    """The mean place of the voxels of bar i and their number; of a cycle, the mean of its cells."""
    places = np.asarray(bars._bars.voxels(i))
    if places.size:
        return np.mean(np.unravel_index(places, bars.meta["shape"]), axis=1), places.size
    cells = bars.representative(i).cells
    # The voxel (i, j) is the cell (2 i, 2 j), or (2 i + 1, 2 j + 1).
    shift = bars.meta.get("construction") == "cells"
    centre: NDArray[np.float64] = (cells.mean(axis=0) - shift) / 2
    return centre, 0


def label_image(bars: Barcode, dim: int) -> NDArray[np.uint32]:
    """See `Barcode.labels`."""
    labels = np.zeros(bars._require_voxels(), dtype=np.uint32)
    flat = labels.reshape(-1)
    sets = {i: np.asarray(bars._bars.voxels(i)) for i in np.flatnonzero(bars.dims == dim).tolist()}
    if sets and not any(places.size for places in sets.values()):
        raise UsageError(f"dim: found {dim}, whose bars have cycles, expected 0 or "
                         f"{labels.ndim - 1}, whose bars have voxels")
    # A smaller set lies within a larger one, and is painted over it.
    for i in sorted(sets, key=lambda i: -sets[i].size):
        flat[sets[i]] = i + 1
    return labels
