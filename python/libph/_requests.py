# SPDX-License-Identifier: MIT
"""Translates the keywords of a function into requests to _core."""
from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _core, _options, _results, _run
from ._errors import (Cancelled, DataError, Error, MemoryLimitError, NotBuiltIn, UsageError,
                      reworded)
from ._images import affine_of
from ._simplices import joined_values, simplex_list
from ._sources import Source, metric_name, source_of

_MOST_DIMENSIONS = 1_000_000  # no simplex that fits into memory has a higher dimension
_EXPONENTS = {1: "1", 2: "2", math.inf: "inf"}
ALPHA_VALUES = ["alpha", "delaunay-cech", "delaunay-rips"]
_NUMBERS = {name: number for number, name in _EXPONENTS.items()}
_Result = TypeVar("_Result")
_RequestOf = Callable[[dict[str, Any]], "Request"]


def _within_limit(request_of: _RequestOf) -> _RequestOf:
    """The same function, whose copies of the input count towards the memory limit."""
    @functools.wraps(request_of)
    def limited(o: dict[str, Any]) -> Request:
        if _run.memory_limit(o["run"]) is None:
            return request_of(o)
        with _run.within_limit(o["run"]) as copies:
            request = request_of(o)
        return request._replace(copied=sum(copies))
    return limited


class PointImage(NamedTuple):
    """An image of a point cloud; see `point_image`.

    Attributes
    ----------
    image : ndarray
        Values of the voxels; axis k is coordinate k. NaN: the voxel is absent.
    first : ndarray
        The centre of the voxel at (0, ..., 0), in the coordinates of the points.
    voxel : float
        The edge of a voxel.
    """

    image: NDArray[np.float64]
    first: NDArray[np.float64]
    voxel: float

    def __repr__(self) -> str:
        return _results.in_brief(self)


class Request(NamedTuple):
    """A complex to build, what to compute from it, and how."""

    recipe: _core.Recipe
    task: _core.Task | None
    options: dict[str, Any]  # options of the run
    facts: Callable[[], dict[str, Any]]
    slab_layers: int = 0
    copied: int = 0  # bytes of copies of the input

    @property
    def meta(self) -> dict[str, Any]:
        """The facts about the origin of a barcode that are known before the computation. They are
        made when they are needed, because drop-ins do not need them."""
        return self.facts()

    def run(self, function: Callable[..., _Result]) -> _Result:
        """Calls a function of _core and translates its errors into the terms of the keywords."""
        arguments = (self.recipe,) if self.task is None else (self.recipe, self.task)
        try:
            return _run.run(function, *arguments, options=self.options,
                            slab_layers=self.slab_layers, copied=self.copied)
        except (DataError, MemoryLimitError) as error:
            raise self.told(error) from None

    def told(self, error: Error) -> Error:
        """The error. If a keyword would help, the message names this keyword."""
        message = str(error)
        if isinstance(error, MemoryLimitError):
            return self._with_ways_to_fit(error)
        kind, _, place = error._place.partition(" ")
        if error._found != "nan" or kind not in ("point", "voxel"):
            return error
        if kind == "point":
            return reworded(error, f"{message}; nan='drop' leaves such points out", ("nan", "drop"))
        index = np.unravel_index(int(place), self.meta["shape"])
        return reworded(error, f"image: {_arrays.place_of([int(i) for i in index])}: found nan, "
                        "expected a number; nan='drop' leaves out what is NaN or masked",
                        ("nan", "drop"))


    def _with_ways_to_fit(self, error: MemoryLimitError) -> MemoryLimitError:
        """The error, with changes of the keywords that keep the computation within the limit."""
        if self.task is None:
            return error
        try:
            ways = _run.run(_core.ways_to_fit, self.recipe, self.task,
                            options={**self.options, "progress": False},
                            slab_layers=self.slab_layers, copied=self.copied)
        except (Cancelled, MemoryLimitError):
            return error
        message = str(error).removesuffix(_run.LARGER_LIMIT)
        if not ways:
            return reworded(error, f"{message}; ph.estimate says how much memory a computation "
                            "needs")
        fit = "may fit" if self.meta["complex"] == "cubical" else "would fit"
        changes = "; ".join(text for _, text in ways)
        return reworded(error, f"{message}; what {fit}: {changes}; or a larger memory_limit",
                        *ways[0][0])


def _task(max_dim: Any, min_dim: Any, field: Any, engine: Any, collapse: Any, min_persistence: Any,
          representatives: Any, cells: Any, loops: str, kinds: tuple[str, ...]) -> _core.Task:
    known = _core.engine_named(engine) if isinstance(engine, str) else None
    if known is None:
        raise _options.refuse("engine", engine, ", ".join(_core.engine_names()))
    collapse = _options.choice("collapse", collapse, ["auto", True, False, "on", "off"])
    how = {True: "on", False: "off"}.get(collapse, collapse)
    kind = _options.choice("representatives", representatives, [None, *kinds]) or "none"
    highest = None if max_dim is None else _options.whole("max_dim", max_dim, 0, _MOST_DIMENSIONS)
    lowest = _options.whole("min_dim", min_dim, 0, _MOST_DIMENSIONS)
    if highest is not None and lowest > highest:
        raise _options.refuse("min_dim", lowest, f"at most max_dim ({highest})")
    return _core.Task(
        highest, lowest, _options.whole("field", field, 2, 2**31 - 1), known, how,
        _options.real("min_persistence", min_persistence), kind, _options.flag("cells", cells),
        loops)


_cached_task = functools.lru_cache(maxsize=64, typed=True)(_task)


_CHAINS = ("none", "cycles", "cocycles")


def _task_of(o: dict[str, Any], loops: str, kinds: tuple[str, ...] = _CHAINS) -> _core.Task:
    arguments = (o["max_dim"], o["min_dim"], o["field"], o["engine"], o.get("collapse", "auto"),
                 o["min_persistence"], o["representatives"], o["cells"], loops, kinds)
    try:
        return _cached_task(*arguments)
    except TypeError:  # a list, for example, is not hashable
        return _task(*arguments)


def _loops_of(o: dict[str, Any], default: str) -> str:
    loops = _options.choice("loops", o["loops"], [None, "none", "plain", "tight"])
    if o["representatives"] not in ("cycles", "voxels"):
        if loops not in (None, "none"):
            raise UsageError("loops: does nothing without cycles as representatives, found "
                             f"representatives={o['representatives']!r}")
        return "none"
    if loops == "tight" and default != "tight":
        raise UsageError("loops: found 'tight', which is for rips, expected 'plain'")
    return loops or default


def _threshold(o: dict[str, Any], least: float = -math.inf) -> float | None:
    value = o["threshold"]
    expected = "a number" if least < 0 else f"a distance, at least {least:g}"
    return None if value is None else _options.real("threshold", value, expected, least)


def _unless(value: Any, default: Any) -> Any:
    return None if value == default else value


def _meta(complex_name: str, o: dict[str, Any], **more: Any) -> dict[str, Any]:
    """The facts about a request; see `Request.meta`."""
    meta = {"complex": complex_name, "field": o["field"], "threshold": o["threshold"],
            "min_persistence": float(o["min_persistence"]), "min_dim": int(o["min_dim"]) or None,
            "representatives": _unless(o["representatives"], "none"), **more}
    return {name: value for name, value in meta.items() if value is not None}


@_within_limit
def rips_request(o: dict[str, Any]) -> Request:
    """The request for X and all keywords of `rips`."""
    _run.check_names("rips", o["run"], o)
    source = source_of(o["X"], metric=o["metric"], minkowski_p=o["minkowski_p"], nan=o["nan"],
                       diagonal=o["diagonal"], symmetrise=o["symmetrise"])
    threshold = _threshold(o, 0)
    births, neighbours, exponent = _weights(o, source)
    is_weighted = births is not None or any(k is not None for k in neighbours.values())
    subsample, radius, approximation = o["subsample"], o["subsample_radius"], o["approximation"]
    if subsample is not None:
        subsample = _options.whole("subsample", subsample, 1)
    if radius is not None:
        radius = _finite("subsample_radius", radius)
    if approximation is not None:
        approximation = _options.positive("approximation", approximation)
    merge = o["merge_equal_points"]
    if merge is not None:
        merge = _options.flag("merge_equal_points", merge)
    for name, value in (("subsample", subsample), ("subsample_radius", radius),
                        ("approximation", approximation)):
        if value is None:
            continue
        if is_weighted:
            raise UsageError(f"{name}: cannot be combined with weights; leave out one of them")
        if not source.space.is_complete:
            raise UsageError(f"{name}: needs all distances, found only some of them")
    task = _task_of(o, _loops_of(o, "tight"))
    keywords = {**o, "threshold": threshold, "dtm_neighbours": neighbours["dtm_neighbors"],
                "core_neighbours": neighbours["core_neighbors"], "weight_exponent": exponent,
                "approximation": approximation, "merge_equal_points": merge}
    recipe = _core.RipsRecipe(source.space, keywords, births, subsample, radius, source.ids)
    weights = o["weights"] if isinstance(o["weights"], str) else None if births is None else "given"
    return Request(recipe, task, o["run"], lambda: _meta(
        "rips", o, points=source.points, coordinates=source.coordinates,
        metric="precomputed" if source is o["X"] else metric_name(o["metric"]),
        minkowski_p=o["minkowski_p"] if o["metric"] == "minkowski" else None,
        weights=weights, **neighbours, approximation=approximation,
        weight_exponent=None if weights is None else _NUMBERS[exponent],
        subsample=o["subsample"], subsample_radius=o["subsample_radius"],
        nan=_unless(o["nan"], "error"), diagonal=_unless(o["diagonal"], "zero"),
        symmetrise=o["symmetrise"]))


def _finite(name: str, value: Any) -> float:
    number = _options.real(name, value, "a finite number, at least 0", 0)
    if number == math.inf:
        raise _options.refuse(name, value, "a finite number, at least 0")
    return number


def _weights(o: dict[str, Any], source: Source
             ) -> tuple[NDArray[np.float64] | None, dict[str, int | None], str]:
    """Returns births, the options that count neighbours, and the exponent."""
    weights, exponent = o["weights"], o["weight_exponent"]
    neighbours = {name: o[name] for name in ("dtm_neighbors", "core_neighbors")}
    is_computed = isinstance(weights, str)
    if weights is not None and source.births is not None:
        raise UsageError("weights: cannot be combined with diagonal='births', which already gives "
                         "each point a birth; leave out one of them")
    if is_computed:
        _options.choice("weights", weights, ["dtm", "core"])
        if neighbours[f"{weights}_neighbors"] is None:
            raise UsageError(f"{weights}_neighbors: found none, expected the number of neighbours "
                             f"for weights={weights!r}")
        if not source.space.is_complete:
            raise UsageError(f"weights: {weights!r} needs all distances, found only some of them")
    for name, count in neighbours.items():
        kind = name.partition("_")[0]
        if count is not None and not (is_computed and kind == weights):
            raise UsageError(f"{name}: does nothing without weights={kind!r}")
        if count is not None:
            least = 1 if kind == "dtm" else 0  # with "dtm", the point itself counts
            neighbours[name] = _options.whole(name, count, least,
                                              max(least, source.space.size - 1 + least))
    births = source.births
    if weights is not None and not is_computed:
        births = _arrays.as_values(weights, "weights", source.points, "point")
        if source.ids is not None:
            births = births[source.ids]
        bad = ~((births >= 0) & (births < np.inf))
        if bad.any():
            raise UsageError(f"weights: entry {int(np.argmax(bad))}: found "
                             f"{births[np.argmax(bad)]}, expected a finite number, at least 0")
    if exponent is None:
        return births, neighbours, "1" if is_computed and weights == "dtm" else "inf"
    if births is None and not is_computed:
        raise UsageError("weight_exponent: does nothing without weights")
    number = _options.real("weight_exponent", exponent, "1, 2 or inf")
    if number not in _EXPONENTS:
        raise _options.refuse("weight_exponent", exponent, "1, 2 or inf")
    return births, neighbours, _EXPONENTS[number]


@_within_limit
def alpha_request(o: dict[str, Any]) -> Request:
    """The request for X and all keywords of `alpha`."""
    _run.check_names("alpha", o["run"], o)
    value = _options.choice("values", o["values"], ALPHA_VALUES)
    source = source_of(o["X"], nan=o["nan"])
    recipe, squared, period = alpha_recipe(o, source, value, _threshold(o))
    task = _task_of(o, _loops_of(o, "plain"))
    return Request(recipe, task, o["run"], lambda: _meta(
        value, o, points=source.points, coordinates=source.coordinates, squared=squared,
        weights=None if o["weights"] is None else "given",
        period=tuple(period) if any(period) else None, nan=_unless(o["nan"], "error")))


def alpha_recipe(o: dict[str, Any], source: Source, value: str = "alpha",
                 threshold: float | None = None) -> tuple[_core.AlphaRecipe, bool, list[float]]:
    """Returns the recipe, True if values are squares, and the lengths of periodic axes."""
    if not _core.alpha_support():
        raise NotBuiltIn("alpha: this build of libph has no alpha complexes, because CGAL was "
                         "missing. Install it (Debian: apt install libcgal-dev), then install "
                         "libph again (pip install .); a build with CGAL falls under the GPL")
    dims = source.coordinates
    if dims is not None and not 1 <= dims <= 3 and source.points:
        raise UsageError(f"X: found points of R^{dims}, expected R^1 to R^3; ph.rips takes points "
                         "of any dimension")
    weights = o["weights"]
    squared = weights is not None if o["squared"] is None else _options.flag("squared", o["squared"])
    if weights is not None:
        weights = _arrays.as_values(weights, "weights", source.points, "point")
        if not squared:
            raise UsageError("squared: found False with weights, expected True, because squared "
                             "radii may be negative")
        if value != "alpha":
            raise UsageError(f"weights: found values={value!r}, expected values='alpha', the only "
                             "values with weights")
        if source.ids is not None:
            weights = weights[source.ids]
    elif threshold is not None and threshold < 0:
        raise _options.refuse("threshold", threshold, "a radius or its square, at least 0")
    period = _period(o.get("period"), dims or 0)
    if any(period) and value != "alpha":
        raise UsageError(f"period: found values={value!r}, expected values='alpha', the only "
                         "values with periodic axes")
    recipe = _core.AlphaRecipe(source.space, value, squared, weights, period,
                               math.inf if threshold is None else threshold, source.ids)
    return recipe, squared, period


def _period(period: Any, axes: int) -> list[float]:
    """A length for each axis, 0 for axes that are not periodic; empty if none is."""
    if period is None:
        return []
    expected = f"a length, or one for each of {axes} axes, with 0 or None for an axis that is not periodic"
    if isinstance(period, (str, bytes)) or np.ndim(period) > 1:
        raise _options.refuse("period", period, expected)
    given = [period] * axes if np.ndim(period) == 0 else list(period)
    if len(given) != axes:
        raise _options.refuse("period", period, expected)
    return [0.0 if length is None else _finite("period", length) for length in given]


@_within_limit
def cubical_request(o: dict[str, Any]) -> Request:
    """The request for the image and all keywords of `cubical`."""
    _run.check_names("cubical", o["run"], o)
    image, nan = o["image"], _options.choice("nan", o["nan"], ["error", "drop"])
    affine = affine_of(image)
    if isinstance(image, PointImage):
        image, nan = image.image, "drop"
    elif hasattr(image, "dataobj"):  # an image of nibabel
        image = image.dataobj
    array = _arrays.as_image(image)
    construction = _options.choice("construction", o["construction"], ["vertices", "cells"])
    superlevel = _options.flag("superlevel", o["superlevel"])
    periodic = _options.axes("periodic", o["periodic"], array.ndim)
    threshold = _threshold(o)
    slab_layers = o.get("slab_layers")
    layers = 0 if slab_layers is None else _options.whole("slab_layers", slab_layers, 1, 2**31 - 1)
    task = _task_of(o, _loops_of(o, "plain"), (*_CHAINS, "voxels"))
    recipe = _core.cubical_recipe(array, nan == "drop", _arrays.is_mapped_file(image),
                                  construction == "vertices", superlevel, periodic, threshold)
    return Request(recipe, task, o["run"], lambda: _meta(
        "cubical", o, shape=array.shape, affine=affine, construction=construction,
        superlevel=superlevel, periodic=tuple(k for k, wraps in enumerate(periodic) if wraps),
        nan=_unless(nan, "error")), layers)


@_within_limit
def lower_star_request(o: dict[str, Any]) -> Request:
    """The request for values, simplices and all keywords of `lower_star`."""
    _run.check_names("lower_star", o["run"], o)
    values = _arrays.as_values(o["values"], "values")
    cells = simplex_list(o["simplices"])
    recipe = _core.lower_star_recipe(cells.vertices, cells.offsets, values, _threshold(o))
    task = _task_of(o, _loops_of(o, "plain"))
    return Request(recipe, task, o["run"], lambda: _meta("lower-star", o, points=len(values)))


@_within_limit
def filtered_request(o: dict[str, Any]) -> Request:
    """The request for simplices, values and all keywords of `filtered`."""
    _run.check_names("filtered", o["run"], o)
    cells = simplex_list(o["simplices"])
    values = joined_values(o["values"], len(cells))
    recipe = _core.simplices_recipe(cells.vertices, cells.offsets, values, _threshold(o))
    task = _task_of(o, _loops_of(o, "plain"))
    return Request(recipe, task, o["run"], lambda: _meta("explicit", o))


@_within_limit
def boundary_request(o: dict[str, Any]) -> Request:
    """The request for matrix, dims, values and all keywords of `boundary`."""
    _run.check_names("boundary", o["run"], o)
    matrix = o["matrix"]
    if not _arrays.is_sparse(matrix):
        raise UsageError(f"matrix: found {type(matrix).__name__}, expected a sparse matrix of "
                         "scipy.sparse: column j is the boundary of cell j")
    if len(matrix.shape) != 2 or matrix.shape[0] != matrix.shape[1]:
        raise UsageError(f"matrix: found shape {matrix.shape}, expected a square one: a row and a "
                         "column for each cell")
    # The copies of Python and of the library take at most this much.
    _arrays.require_room(64 * matrix.nnz + 64 * matrix.shape[0],
                         f"the conversion of the {matrix.nnz} entries of matrix may take")
    columns = matrix.tocsc(copy=True)
    columns.sum_duplicates()
    incidences = _arrays.as_integers(columns.data, "matrix")
    if o["field"] == 2:
        incidences = (incidences % 2).astype(np.int8)  # signs do not matter
    columns = type(columns)((incidences, columns.indices, columns.indptr), shape=columns.shape)
    columns.eliminate_zeros()
    cells = columns.shape[0]
    dims = _arrays.as_integers(o["dims"], "dims")
    if dims.shape != (cells,):
        raise UsageError(f"dims: found an array of shape {dims.shape}, expected {cells} numbers, one "
                         "for each cell")
    most = 2**31 - 1
    for name, array, least in (("dims", dims, 0), ("matrix", columns.data, -most)):
        if array.size and (array.min() < least or array.max() > most):
            raise UsageError(f"{name}: found {array.min()} to {array.max()}, expected whole numbers "
                             f"from {least} to {most}")
    signs = np.empty(0) if o["field"] == 2 else columns.data
    values = np.arange(cells, dtype=np.float64) if o["values"] is None else \
        _arrays.as_values(o["values"], "values", cells, "cell")
    recipe = _core.boundary_recipe(
        dims.astype(np.int32), columns.indptr.astype(np.int64), columns.indices.astype(np.int64),
        signs.astype(np.int32), values, _threshold(o))
    task = _task_of(o, "none")
    return Request(recipe, task, o["run"], lambda: _meta("explicit", o))
