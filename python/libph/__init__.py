# SPDX-License-Identifier: MIT
"""Persistent homology of points, distances, images, meshes and filtered complexes.

>>> import libph as ph
>>> bars = ph.rips([[0, 0], [1, 0], [1, 1], [0, 1]])
>>> bars.dgm(1)
array([[1.        , 1.41421356]])

Computations release the GIL and stop on Ctrl-C. All of them accept these keywords:

threads : int
    How many threads to use. Default: one per core. Results do not depend on this number.
memory_limit : int or str
    The largest amount of memory that the computation may take, in bytes or as text ("4GiB"). If the
    computation needs more, it ends with a `MemoryLimitError`. Default: 90 % of the memory of the
    machine or of the control group, minus the memory that the process already uses.
progress : bool or callable
    True shows a progress bar if tqdm is installed. A callable receives ``(stage, done, total)`` at
    most ten times per second; `total` is 0 if it is unknown. An exception that it raises stops the
    computation.
timeout : float
    Seconds after which the computation ends with a `Timeout`.
stop : threading.Event
    Once it is set, the computation ends with `Cancelled`.

The data must not change while a computation runs. `limits` sets defaults for a block of code.

Three modules are loaded on first use: `libph.sklearn` and `libph.torch`, which need scikit-learn
and torch, and `libph.compat`, which offers the interfaces of other packages.
"""
import typing as _typing

try:
    from ._core import version as __version__
except ModuleNotFoundError as _error:
    import sys as _sys
    raise ImportError(f"libph: {__path__[0]} has no compiled module _core for Python "
                      f"{_sys.version_info[0]}.{_sys.version_info[1]}; `pip install .` in the root "
                      "of the repository builds it", name=_error.name) from None

from . import gradients
from ._barcodes import Bar, Barcode, Chain, Loop
from ._batch import batch
from ._compute import alpha, boundary, cubical, filtered, lower_star, rips
from ._distances import (Barycentre, Matching, barycentre, bottleneck, bottleneck_matching,
                         diagram_distances, sliced_wasserstein, wasserstein, wasserstein_matching)
from ._errors import (Cancelled, DataError, Error, InternalError, MemoryLimitError,
                      MissingInputError, NotBuiltIn, OutputError, Timeout, UsageError)
from ._estimate import Estimate, estimate
from ._files import Boundary, Mesh, Simplices, read, read_barcode
from ._parts import CloudPart, ImageLoops, ImagePart, cloud_part, image_part, join_parts
from ._points import (Subsample, collapse, delay_embedding, distance_to_measure, farthest_points,
                      point_image)
from ._report import Report, report
from ._requests import PointImage
from ._run import limits
from ._scenes import (LabelTracker, Objects, SceneSurface, Segment, Segmentation, Tracked, Voxels,
                      segment)
from ._significance import (Band, PermutationTest, confidence_band, confidence_radius, p_values,
                            permutation_test)
from ._surfaces import Surface, alpha_shape
from ._trees import MergeTree, merge_tree
from ._vectors import PiecewiseLinear, StepFunction
from ._vectors._euler import euler_curve
from ._vectors._kernels import diagram_kernels

__all__ = [
    "Band", "Bar", "Barcode", "Barycentre", "Boundary", "Cancelled", "Chain", "CloudPart",
    "DataError", "Error", "Estimate", "ImageLoops", "ImagePart", "InternalError", "LabelTracker",
    "Loop", "Matching", "MemoryLimitError", "MergeTree", "Mesh", "MissingInputError", "NotBuiltIn",
    "Objects", "OutputError", "PermutationTest", "PiecewiseLinear", "PointImage", "Report",
    "SceneSurface", "Segment", "Segmentation", "Simplices", "StepFunction", "Subsample", "Surface",
    "Timeout", "Tracked", "UsageError", "Voxels", "__version__",
    "alpha", "alpha_shape", "barycentre", "batch",
    "bottleneck", "bottleneck_matching", "boundary", "cloud_part", "collapse", "confidence_band",
    "confidence_radius", "cubical", "delay_embedding", "diagram_distances", "diagram_kernels",
    "distance_to_measure",
    "estimate", "euler_curve", "farthest_points", "filtered", "gradients", "image_part",
    "join_parts", "limits", "lower_star",
    "merge_tree", "p_values", "permutation_test", "point_image", "read", "read_barcode", "report",
    "rips", "segment", "sliced_wasserstein", "wasserstein", "wasserstein_matching",
]

if not _typing.TYPE_CHECKING:  # hidden from type checkers, which then report missing names

    def __getattr__(name):
        if name in ("compat", "sklearn", "torch"):
            import importlib
            try:
                return importlib.import_module(f"{__name__}.{name}")
            except ModuleNotFoundError as error:
                package = (error.name or "").partition(".")[0]
                if package == __name__:
                    raise
                raise AttributeError(f"libph.{name} needs {package}, which is not installed"
                                     ) from None
        from . import _hints
        raise AttributeError(f"libph has no {name!r}" + _hints.of_name(
            name, _hints.MODULE, __all__))

    def __dir__():
        return sorted({*globals(), "compat", "sklearn", "torch"})
