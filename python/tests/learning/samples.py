# SPDX-License-Identifier: MIT
"""Helpers for the tests of estimators."""
import numpy as np


def of_class(kind):
    return kind.__name__


def same(a, b):
    """True if two lists of lists of arrays are equal."""
    return len(a) == len(b) and all(
        len(x) == len(y) and all(map(np.array_equal, x, y)) for x, y in zip(a, b))
