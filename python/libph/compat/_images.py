# SPDX-License-Identifier: MIT
"""Shared code of the drop-ins for images: the voxels that determine the values of cells."""
from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray


def deciding_voxels(cells: NDArray[np.int64], image: NDArray[Any], is_vertices: bool,
                    periodic: Sequence[bool] = ()) -> NDArray[np.int64]:
    """For each cell, in doubled grid coordinates, the voxel that determines its value.

    This is the largest of its vertices, or the smallest of the cubes around it; the first among
    equals. `periodic` states for each axis whether it is periodic. Default: no axis is.
    """
    if not len(cells):
        return np.empty((0, image.ndim), dtype=np.int64)
    extents = np.array(image.shape)
    first = cells // 2 if is_vertices else (cells - 1) // 2
    ends = [np.where(periodic or False, end % extents, np.clip(end, 0, extents - 1))
            for end in (first, first + cells % 2 if is_vertices else cells // 2)]
    best = ends[0]
    values = image[tuple(best.T)]
    for at_end in itertools.product((0, 1), repeat=image.ndim):
        voxels = np.where(at_end, ends[1], ends[0])
        found = image[tuple(voxels.T)]
        better = found > values if is_vertices else found < values
        best = np.where(better[:, None], voxels, best)
        values = np.where(better, found, values)
    return best
