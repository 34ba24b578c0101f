# SPDX-License-Identifier: MIT
"""Scenes for the tests of segmentation."""
import os
from pathlib import Path

import numpy as np

TABLE = Path(os.environ.get("PH_SOURCE_DIR", Path(__file__).parents[3])) / "examples/data/table.pcd"
CAMERA = (260.0, 255.0, 79.5, 59.5)


def points_of_scene(rng, noise=0.001):
    """Boxes and balls on a table, seen from above by a sensor at the origin: z points forward."""
    parts = [np.column_stack([rng.uniform(-0.4, 0.4, (9000, 2)), np.full(9000, 0.9)])]
    for _ in range(rng.integers(1, 5)):
        centre, edge = rng.uniform(-0.25, 0.25, 2), rng.uniform(0.06, 0.14)
        if rng.integers(2):
            top = np.column_stack([centre + rng.uniform(-edge, edge, (5000, 2)),
                                   np.full(5000, 0.9 - edge)])
        else:
            ball = rng.normal(size=(5000, 3))
            ball *= edge / np.linalg.norm(ball, axis=1)[:, None]
            ball[:, 2] = -np.abs(ball[:, 2])
            top = ball + [*centre, 0.88]
        parts.append(top)
    points = np.concatenate(parts)
    return points + rng.normal(scale=noise, size=points.shape)


def depth_of_scene(rng):
    """A depth image in metres of boxes on a table, with holes."""
    depth = np.full((120, 160), 0.9)
    for _ in range(4):
        row, column = rng.integers(0, 90), rng.integers(0, 120)
        depth[row:row + rng.integers(12, 40), column:column + rng.integers(12, 50)] = \
            rng.uniform(0.7, 0.85)
    depth[rng.random(depth.shape) < 0.05] = np.nan
    return depth
