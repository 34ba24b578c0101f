# SPDX-License-Identifier: MIT
"""A part of GUDHI's interface on top of libph: Rips and cubical complexes, bottleneck distance.

>>> from libph.compat import gudhi
>>> tree = gudhi.RipsComplex(points=[[0, 0], [1, 0], [1, 1], [0, 1]]).create_simplex_tree(2)
>>> tree.persistence(min_persistence=0.4)[0]
(1, (1.0, 1.4142135623730951))

Missing functions raise `NotBuiltIn`. docs/how-to/coming-from.md lists the cases in which libph
deliberately gives another answer.
"""
from __future__ import annotations

from typing import Any

from ... import _options
from ..._core import version as __version__
from .. import _missing
from . import random
from ._cubical import CubicalComplex, PeriodicCubicalComplex
from ._trees import DTMRipsComplex, FlagTree, RipsComplex, WeightedRipsComplex
from .hera import bottleneck_distance as _bottleneck

__all__ = ["CubicalComplex", "DTMRipsComplex", "FlagTree", "PeriodicCubicalComplex", "RipsComplex",
           "WeightedRipsComplex", "__version__", "bottleneck_distance", "random"]


def __getattr__(name: str) -> Any:
    return _missing.attribute(__name__, name, __all__)


@_options.with_hints
def bottleneck_distance(diagram_1: Any, diagram_2: Any, e: float | None = None) -> float:
    """The bottleneck distance between two diagrams.

    Parameters
    ----------
    diagram_1, diagram_2 : array_like
        Rows birth, death.
    e : float, optional
        The allowed error. It has no effect, because libph is exact.

    Returns
    -------
    float
    """
    if e is not None:
        _options.real("e", e, "a number of at least 0", 0)
    return _bottleneck(diagram_1, diagram_2)
