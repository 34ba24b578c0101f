# SPDX-License-Identifier: MIT
"""Vectors of diagrams, which _core computes, and the methods of `Barcode` that give them.

`_diagrams`: what a diagram is, and what becomes of bars that never die. `_ranges`: grids and pixels.
`_functions`: a vector of one diagram. `_steps`: functions that are exact. `_summaries`: methods.
`_euler` and `_kernels` know of barcodes, and are imported by who needs them.
"""
from ._diagrams import Diagram, Infinity, as_diagram, checked_infinity, settled
from ._ranges import Range
from ._steps import PiecewiseLinear, StepFunction
from ._summaries import Summaries

__all__ = ["Diagram", "Infinity", "PiecewiseLinear", "Range", "StepFunction", "Summaries",
           "as_diagram", "checked_infinity", "settled"]
