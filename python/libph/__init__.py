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

All names are loaded on first use. ``from libph import *`` leaves out three modules: `libph.sklearn`
and `libph.torch`, which need scikit-learn and torch, and `libph.compat`, which offers the
interfaces of other packages.
"""
try:
    from ._core import version as __version__
except ModuleNotFoundError as _error:
    import sys as _sys
    raise ImportError(f"libph: {__path__[0]} has no compiled module _core for Python "
                      f"{_sys.version_info[0]}.{_sys.version_info[1]}; `pip install .` in the root "
                      "of the repository builds it", name=_error.name) from None

from . import _imports

# The public names of each module. A module is imported when one of its names is first used, because
# most programs use few of them. `__init__.pyi` states the same names for type checkers.
_NAMES = {
    "_barcodes": "Bar Barcode Chain Loop",
    "_batch": "batch",
    "_clusters": "ClusterTree Clusters cluster_tree",
    "_compute": "alpha boundary cubical filtered lower_star rips",
    "_distances": "Barycentre Matching barycentre bottleneck bottleneck_matching "
                  "diagram_distances sliced_wasserstein wasserstein wasserstein_matching",
    "_errors": "Cancelled DataError Error InternalError MemoryLimitError MissingInputError "
               "NotBuiltIn OutputError Timeout UsageError",
    "_estimate": "Estimate estimate",
    "_files": "Boundary Mesh Simplices read read_barcode",
    "_images": "SpatialImage write_nifti",
    "_parts": "CloudPart ImageLoops ImagePart cloud_part image_part join_parts",
    "_points": "Subsample collapse core_distances delay_embedding distance_to_measure farthest_points "
               "point_image",
    "_real_clusters": "ClusterSignificance ClusterStability",
    "_report": "Report report",
    "_requests": "PointImage",
    "_run": "limits",
    "_scenes": "LabelTracker Objects SceneSurface Segment Segmentation Tracked Voxels segment",
    "_significance": "Band PermutationTest confidence_band confidence_radius p_values "
                     "permutation_test",
    "_surfaces": "Surface alpha_shape",
    "_trees": "MergeTree merge_tree",
    "_vectors": "PiecewiseLinear StepFunction",
    "_vectors._euler": "euler_curve",
    "_vectors._kernels": "diagram_kernels",
}
_MODULES = {name: module for module, names in _NAMES.items() for name in names.split()}
# `from . import NAME` also finds these modules through `__getattr__`, which loads them in a way that
# permits forks.
_PACKAGES = ("_hints", "_report", "compat", "gradients", "sklearn", "torch")
__all__ = sorted([*_MODULES, "__version__", "gradients"])


def __getattr__(name):
    if name in _MODULES:
        globals()[name] = found = getattr(_imports.load(f"{__name__}.{_MODULES[name]}"), name)
        return found
    if name in _PACKAGES:
        try:
            return _imports.load(f"{__name__}.{name}")
        except ModuleNotFoundError as error:
            package = (error.name or "").partition(".")[0]
            if package == __name__:
                raise
            raise AttributeError(f"libph.{name} needs {package}, which is not installed") from None
    hint = ""
    if not name.startswith("_"):  # such names are modules that are not imported yet
        from . import _hints
        hint = _hints.of_name(name, _hints.MODULE, __all__)
    raise AttributeError(f"libph has no {name!r}{hint}")


def __dir__():
    return sorted({*globals(), *__all__, *_PACKAGES})
