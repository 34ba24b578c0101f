# SPDX-License-Identifier: MIT
"""GUDHI's module of edge collapse."""
from . import edge_collapse

__all__ = ["edge_collapse"]
