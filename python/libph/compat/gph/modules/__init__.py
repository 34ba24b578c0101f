# SPDX-License-Identifier: MIT
"""The parts of giotto-ph's compiled modules that other code imports."""
from . import gph_collapser, gph_ripser

__all__ = ["gph_collapser", "gph_ripser"]
