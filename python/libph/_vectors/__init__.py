# SPDX-License-Identifier: MIT
"""Vectors of diagrams, which _core computes, and the methods of `Barcode` that return them.

`_diagrams` defines diagrams and the treatment of bars that never die, `_ranges` grids and pixels,
`_functions` vectors of one diagram, `_steps` exact functions, and `_summaries` the methods.
`_euler` and `_kernels` depend on barcodes and are imported where they are needed.
"""
from ._diagrams import Diagram, Infinity, as_diagram, checked_infinity, lengths, settled
from ._ranges import Range
from ._steps import PiecewiseLinear, StepFunction
from ._summaries import Summaries

__all__ = ["Diagram", "Infinity", "PiecewiseLinear", "Range", "StepFunction", "Summaries",
           "as_diagram", "checked_infinity", "lengths", "settled"]
