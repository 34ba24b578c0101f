# SPDX-License-Identifier: MIT
"""Helpers for the tests of estimators."""
import numpy as np


def of_class(kind):
    return kind.__name__


def same(a, b):
    """True if two lists of lists of arrays are equal."""
    return len(a) == len(b) and all(
        len(x) == len(y) and all(map(np.array_equal, x, y)) for x, y in zip(a, b))


def blobs(rng):
    """Three groups of points of different densities, and noise."""
    return np.vstack([rng.normal((0, 0), 0.2, (30, 2)), rng.normal((2, 0), 0.4, (25, 2)),
                      rng.normal((0, 3), 0.1, (20, 2)), rng.uniform(-2, 5, (15, 2))])
