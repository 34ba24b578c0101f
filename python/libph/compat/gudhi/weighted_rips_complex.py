# SPDX-License-Identifier: MIT
"""Where GUDHI has its class of this name."""
from ._trees import WeightedRipsComplex

__all__ = ["WeightedRipsComplex"]
