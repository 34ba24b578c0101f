# SPDX-License-Identifier: MIT
"""Fixtures shared by all tests. The environment variable PH_BARCODE names the program to compare
with."""
import os

import numpy as np
import pytest

import libph


@pytest.fixture(autouse=True)
def _names_of_doctests(doctest_namespace):
    doctest_namespace["ph"] = libph
    doctest_namespace["np"] = np


@pytest.fixture
def rng(request):
    """A random generator whose seed is the name of the test."""
    return np.random.default_rng(list(request.node.name.encode()))


@pytest.fixture(scope="session")
def program():
    path = os.environ.get("PH_BARCODE", "")
    if not os.access(path, os.X_OK):
        pytest.skip("PH_BARCODE names no program")
    return path
