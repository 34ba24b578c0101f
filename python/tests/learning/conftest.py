# SPDX-License-Identifier: MIT
"""Sample data for the tests of libph.sklearn."""
import pytest


@pytest.fixture
def clouds(rng):
    return [rng.random((n, 2)) for n in (12, 20, 15, 18)]


@pytest.fixture
def dgms(clouds):
    from libph.sklearn import RipsPersistence
    return RipsPersistence(reduced=True).fit_transform(clouds)
