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

from typing import Any, NoReturn

from ... import _options
from ..._core import version as __version__
from ..._errors import NotBuiltIn
from . import random
from ._cubical import CubicalComplex, PeriodicCubicalComplex
from ._trees import DTMRipsComplex, FlagTree, RipsComplex, WeightedRipsComplex
from .hera import bottleneck_distance as _bottleneck

__all__ = ["CubicalComplex", "DTMRipsComplex", "FlagTree", "PeriodicCubicalComplex", "RipsComplex",
           "WeightedRipsComplex", "__version__", "bottleneck_distance", "random"]

_ELSEWHERE = {
    "AlphaComplex", "CoverComplex", "DelaunayCechComplex", "DelaunayComplex",
    "EuclideanStrongWitnessComplex", "EuclideanWitnessComplex", "SimplexTree",
    "StrongWitnessComplex", "TangentialComplex", "WitnessComplex", "choose_n_farthest_points",
    "pick_n_random_points", "plot_persistence_barcode", "plot_persistence_density",
    "plot_persistence_diagram",
    "read_lower_triangular_matrix_from_csv_file",
    "read_persistence_intervals_grouped_by_dimension", "read_persistence_intervals_in_dimension",
    "read_points_from_off_file", "sparsify_point_set", "write_points_to_off_file"}

_INSTEAD = {
    "SimplexTree": "ph.filtered takes simplices and values",
    "choose_n_farthest_points": "ph.farthest_points gives the indices of the points",
    "plot_persistence_barcode": "ph.rips(...).plot('barcode') draws bars",
    "plot_persistence_diagram": "ph.rips(...).plot() draws bars",
    "read_points_from_off_file": "ph.read(path).vertices has the points of an OFF file",
    "sparsify_point_set": "ph.farthest_points(X, radius=...) thins points out"}


def __getattr__(name: str) -> Any:
    if name not in _ELSEWHERE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

    def missing(*arguments: Any, **options: Any) -> NoReturn:
        hint = f"; {_INSTEAD[name]}" if name in _INSTEAD else ""
        raise NotBuiltIn(f"{name}: not in this drop-in; GUDHI has it{hint}")

    return missing


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
