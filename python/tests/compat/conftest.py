# SPDX-License-Identifier: MIT
"""Fixtures shared by the tests of the drop-ins."""
import pytest

from libph.compat import gudhi


@pytest.fixture(scope="module")
def gudhi_itself():
    genuine = pytest.importorskip("gudhi", reason="GUDHI is not installed")
    if genuine is gudhi:
        pytest.skip("gudhi is the drop-in")
    return genuine
