# SPDX-License-Identifier: MIT
"""A call with a small input costs little more than its computation, which takes microseconds."""
import resource
import sys
import time

import numpy as np
import pytest

import libph as ph
from libph.compat import gudhi, ripser

X = np.random.default_rng(0).random((10, 2))
DISTANCES = np.sqrt(((X[:, None] - X)**2).sum(axis=2))


def rips_tree():
    return gudhi.RipsComplex(points=X).create_simplex_tree(max_dimension=2)


# Each call, with the largest number of functions that Python may call for it.
CALLS = {
    "rips": (lambda: ph.rips(X), 80),
    "alpha": (lambda: ph.alpha(X), 75),
    "cubical": (lambda: ph.cubical(X), 65),
    "dgms": (lambda: ph.rips(X).dgms(), 100),
    "ripser": (lambda: ripser.ripser(DISTANCES, distance_matrix=True), 95),
    "gudhi.rips": (lambda: rips_tree().persistence(), 85),
    "gudhi.cubical": (lambda: gudhi.CubicalComplex(top_dimensional_cells=X).persistence(), 72),
}


def functions_called(call):
    """The number of functions, of Python or built in, that Python calls. Unlike a time, it does not
    depend on the machine."""
    count = 0

    def see(frame, event, argument):
        nonlocal count
        count += event in ("call", "c_call")

    call()  # imports what it needs
    sys.setprofile(see)
    try:
        call()
    finally:
        sys.setprofile(None)
    return count


@pytest.mark.parametrize("name", CALLS)
def test_few_functions_are_called(name):
    call, most = CALLS[name]
    if name == "alpha" and not ph._core.alpha_support():
        pytest.skip("built without CGAL")
    assert functions_called(call) <= most


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
