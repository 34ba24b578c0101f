# SPDX-License-Identifier: MIT
"""Barcodes of all kinds, and all that their methods return."""
import numpy as np
import pytest

import libph as ph

RNG = np.random.default_rng(0)
ANGLES = np.linspace(0, 2 * np.pi, 20, endpoint=False)
CIRCLE = np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])
POINTS = RNG.normal(size=(60, 3))
VOLUME = RNG.integers(0, 99, size=(6, 7, 5))
TETRAHEDRON = [(0,), (1,), (2,), (3,), (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3), (0, 1, 2)]

BARCODES = {
    "points": lambda: ph.rips(POINTS, max_dim=2),
    "cycles": lambda: ph.rips(POINTS, representatives="cycles"),
    "cocycles": lambda: ph.rips(POINTS, representatives="cocycles", field=3),
    "no cells": lambda: ph.rips(POINTS, cells=False),
    "zero length": lambda: ph.rips(POINTS.round(), min_persistence=-1),
    "image": lambda: ph.cubical(VOLUME),
    "image with cycles": lambda: ph.cubical(VOLUME, representatives="cycles", field=5),
    "image with voxels": lambda: ph.cubical(VOLUME, representatives="voxels", superlevel=True),
    "simplices": lambda: ph.filtered(TETRAHEDRON, range(11), representatives="cycles"),
    "no bars": lambda: ph.rips([]),
    "weights": lambda: ph.rips(POINTS, weights="dtm", dtm_neighbors=4),
    "subsample": lambda: ph.rips(POINTS, subsample=20),
    "approximation": lambda: ph.rips(POINTS, approximation=1),
    "left out": lambda: ph.rips(np.vstack([[np.nan] * 3, POINTS]), nan="drop",
                                representatives="cycles"),
}
each = pytest.mark.parametrize("bars", [pytest.param(make(), id=name)
                                        for name, make in BARCODES.items()])


def parts(bars):
    """All properties of a barcode that its methods return."""
    seen = [bars.dims, bars.births, bars.deaths]
    if bars._bars.has_cells:
        for dim in range(4):
            seen += [bars.birth_cells(dim), bars.death_cells(dim)]
    for i in range(len(bars) if bars.meta.get("representatives") else 0):
        chain = bars.representative(i)
        seen += [chain.cells, chain.coefficients]
        if bars.meta["representatives"] != "cocycles" and bars[i].dim == 1:
            seen += [np.array([chain.tightness]), *(loop.vertices for loop in chain.loops())]
        if bars.meta["representatives"] == "voxels":
            seen += [bars.voxels(i), bars.birth_voxel(i), bars.death_voxel(i) or ()]
    return seen


def same(a, b):
    return len(a) == len(b) and all(np.array_equal(x, y) for x, y in zip(a, b))
