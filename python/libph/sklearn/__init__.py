# SPDX-License-Identifier: MIT
"""Persistent homology in pipelines of scikit-learn.

For lists of point clouds, distances or images: `RipsPersistence`, `AlphaPersistence`,
`CubicalPersistence`. For lists of diagrams: `Statistics`, `PersistenceImage`, `Landscape`,
`Silhouette`, `BettiCurve`, `LifeEntropy`, `Entropy`, `Lengths`, `Atol`, `DiagramDistances`,
`DiagramKernels`. For lists of images, without their bars: `EulerCurve`. For one cloud, whose rows
are samples: `HDBSCAN`, `PersistenceClustering`, `DistanceToMeasure`, `FarthestPoints`.

>>> import libph.sklearn
>>> from sklearn.pipeline import make_pipeline
>>> clouds = [[[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 0], [2, 0], [2, 2], [0, 2]]]
>>> steps = make_pipeline(ph.sklearn.RipsPersistence(homology_dimensions=(1,)),
...                       ph.sklearn.Lengths(count=1))
>>> steps.fit_transform(clouds).round(3)
array([[0.414],
       [0.828]])
"""
import typing as _typing

from .. import _options
from ._atol import Atol
from ._clustering import PersistenceClustering
from ._curves import BettiCurve, Landscape, LifeEntropy, Silhouette
from ._distances import DiagramDistances, DiagramKernels
from ._euler import EulerCurve
from ._hdbscan import HDBSCAN
from ._images import PersistenceImage
from ._numbers import Entropy, Lengths, Statistics
from ._persistence import AlphaPersistence, CubicalPersistence, RipsPersistence
from ._points import DistanceToMeasure, FarthestPoints

__all__ = ["AlphaPersistence", "Atol", "BettiCurve", "CubicalPersistence", "DiagramDistances",
           "DiagramKernels", "DistanceToMeasure", "Entropy", "EulerCurve", "FarthestPoints", "HDBSCAN",
           "Landscape", "Lengths",
           "LifeEntropy", "PersistenceClustering", "PersistenceImage", "RipsPersistence",
           "Silhouette", "Statistics"]

for _name in __all__:
    _options.with_hints(globals()[_name])

if not _typing.TYPE_CHECKING:  # hidden from type checkers, which then report missing names

    def __getattr__(name):
        from .. import _hints
        raise AttributeError(f"libph.sklearn has no {name!r}" + _hints.of_name(
            name, _hints.SKLEARN, __all__))
