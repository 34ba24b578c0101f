# SPDX-License-Identifier: MIT
"""A call with a small input costs little more than its computation, which takes microseconds."""
import resource
import time

import numpy as np
import pytest

import libph as ph

X = np.random.default_rng(0).random((10, 2))


def test_an_image_with_two_axes_costs_about_as_much_as_a_row():
    """The tables for two axes are made once, not for each image."""
    times = {1: [], 2: []}
    for _ in range(200):
        for axes, image in ((1, X.ravel()), (2, X)):
            start = time.perf_counter()
            ph.cubical(image)
            times[axes].append(time.perf_counter() - start)
    assert min(times[2]) < 2.5 * min(times[1])


def test_one_small_sample_needs_no_thread():
    """A call waits for a thread, and each wait is a switch to another thread or process."""
    persistence = pytest.importorskip("libph.sklearn").RipsPersistence()
    persistence.fit_transform([X])
    before = resource.getrusage(resource.RUSAGE_SELF).ru_nvcsw
    for _ in range(100):
        persistence.fit_transform([X])
    assert resource.getrusage(resource.RUSAGE_SELF).ru_nvcsw - before < 50
