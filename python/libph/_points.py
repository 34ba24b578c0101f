# SPDX-License-Identifier: MIT
"""Functions for points and distances that need no barcode."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _options, _results, _run
from ._compute import rips
from ._errors import DataError, UsageError
from ._requests import PointImage, rips_request
from ._sources import source_of

if TYPE_CHECKING:
    from scipy.sparse import coo_array
    from typing_extensions import Unpack

    from ._run import RunOptions


class Subsample(NamedTuple):
    """Points in the order of farthest-point sampling; see `farthest_points`.

    Attributes
    ----------
    indices : ndarray
        The points, point 0 first.
    radii : ndarray
        The distance of each point to the nearest point before it; inf for the first.
    covering_radius : float
        Each point of the whole set is at most this far from one of these points.
    """

    indices: NDArray[np.int64]
    radii: NDArray[np.float64]
    covering_radius: float

    def __repr__(self) -> str:
        return _results.in_brief(self)


def point_image(X: ArrayLike, voxel: float, *, value: str = "distance", margin: int = 1,
                **run: Unpack[RunOptions]) -> PointImage:
    """Converts points to an image for `cubical`. The time is proportional to points and voxels.

    Parameters
    ----------
    X : array_like
        Points of 1 to 8 coordinates, one per row.
    voxel : float
        The edge of a voxel, in the unit of the points.
    value : {"distance", "occupancy", "density"}
        The value of a voxel. "distance": its distance to the nearest voxel with a point.
        "occupancy": 0 if it has a point. "density": minus the number of its points. With the last
        two, voxels without points are absent.
    margin : int
        Number of layers of voxels around the bounding box.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    PointImage

    Examples
    --------
    >>> ph.point_image([[0.0], [2.0]], 1.0).image
    array([1., 0., 1., 0., 1.])
    """
    _run.check_names("point_image", run, point_image)
    name = _options.choice("value", value, ["distance", "occupancy", "density"])
    edge = _options.positive("voxel", voxel)
    image, first = _run.run(
        _core.point_image, _arrays.as_points(X), edge, name,
        _options.whole("margin", margin, 0, 2**31), options=dict(run))
    return PointImage(np.asarray(image), np.asarray(first), edge)


@_options.with_hints
def delay_embedding(series: ArrayLike, dimension: int, delay: int = 1, *,
                    window: int | None = None, step: int | None = None) -> NDArray[np.float64]:
    """The delay embedding of a time series: each point has the values at several times.

    If the series is periodic, the points run around a loop (F. Takens, Detecting strange attractors
    in turbulence, 1981). `ph-barcode --delay` does the same with a table.

    Parameters
    ----------
    series : array_like
        Values, one per time, shape (times,); or several quantities, shape (times, quantities).
    dimension : int
        Number of times that make up a point.
    delay : int
        Number of steps between consecutive times of a point.
    window : int, optional
        If given, the points of every window of this many consecutive times form a cloud of their
        own, for `batch`. This shows how the shape of the series changes.
    step : int, optional
        Number of times between the starts of consecutive windows. Default: 1.

    Returns
    -------
    ndarray
        Shape (points, dimension * quantities), where points = times - (dimension - 1) * delay: all
        quantities of the first time come first, then all quantities of the next time. With
        `window`, the shape is (windows, points per window, dimension * quantities). The array may
        be a view of `series`.

    Examples
    --------
    >>> ph.delay_embedding([0, 1, 2, 3, 4, 5], 3, delay=2)
    array([[0., 2., 4.],
           [1., 3., 5.]])
    >>> ph.delay_embedding([0, 1, 2, 3, 4, 5], 2, window=4, step=2).shape
    (2, 3, 2)
    """
    values = _arrays.as_float64(_arrays.as_array(series, "series"), "series")
    if values.ndim not in (1, 2):
        raise UsageError(f"series: found an array of shape {values.shape}, expected (times,) or "
                         "(times, quantities)")
    dimension = _options.whole("dimension", dimension, 1)
    span = (dimension - 1) * _options.whole("delay", delay, 1) + 1
    if len(values) < span:
        raise DataError(f"series: found {len(values)} times, expected at least {span} for a "
                        f"dimension of {dimension} and a delay of {delay}")
    if step is not None and window is None:
        raise UsageError("step: does nothing without window")
    of_points = np.lib.stride_tricks.sliding_window_view(values, span, axis=0)[..., ::delay]
    if values.ndim == 2:  # quantities before times
        of_points = np.swapaxes(of_points, 1, 2)
        # In these cases, the rows cannot be a view of the series.
        if delay > 1 or not values.flags.c_contiguous:
            copy = _arrays.new_array(of_points.shape)
            copy[...] = of_points
            of_points = copy
        of_points = of_points.reshape(len(of_points), dimension * values.shape[1])
    points: NDArray[np.float64] = of_points
    if window is None:
        return points
    window = _options.whole("window", window, span, len(values))
    step = 1 if step is None else _options.whole("step", step, 1)
    windows = np.lib.stride_tricks.sliding_window_view(points, window - span + 1, axis=0)[::step]
    return np.swapaxes(windows, 1, 2)


def farthest_points(X: Any, n: int | None = None, *, radius: float = 0.0,
                    metric: Any = "euclidean", minkowski_p: float = 2.0,
                    **run: Unpack[RunOptions]) -> Subsample:
    """Farthest-point sampling: after point 0, always the point farthest from the points before it.

    Parameters
    ----------
    X : array_like
        As in `rips`; all distances must be known.
    n : int, optional
        Largest number of points. Default: as many as `radius` requires; for a radius of 0, all
        distinct points.
    radius : float
        Sampling stops when every point is at most this far from a chosen point.
    metric, minkowski_p
        As in `rips`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Subsample

    Examples
    --------
    >>> ph.farthest_points([[0], [1], [10], [11]], 2)
    Subsample(indices=array([0, 3]), radii=array([inf, 11.]), covering_radius=1.0)
    """
    _run.check_names("farthest_points", run, farthest_points)
    source = _complete(X, metric, minkowski_p)
    count = 2**62 if n is None else _options.whole("n", n, 1)
    covering = _options.real("radius", radius, "a finite number, at least 0", 0)
    if covering == np.inf:
        raise _options.refuse("radius", radius, "a finite number, at least 0")
    indices, radii, reached = _run.run(_core.farthest_points, source, count, covering,
                                       options=dict(run))
    return Subsample(np.asarray(indices), np.asarray(radii), reached)


def distance_to_measure(X: Any, k: int, *, metric: Any = "euclidean", minkowski_p: float = 2.0,
                        **run: Unpack[RunOptions]) -> NDArray[np.float64]:
    """For each point, the root mean square of the distances to its k nearest points.

    The point itself is one of them. The value is small where points are dense, and large at
    outliers.

    Parameters
    ----------
    X : array_like
        As in `rips`; all distances must be known.
    k : int
        Number of neighbours, from 1 to the number of points.
    metric, minkowski_p
        As in `rips`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    ndarray

    Examples
    --------
    >>> ph.distance_to_measure([[0], [1], [5]], 2)
    array([0.70710678, 0.70710678, 2.82842712])
    """
    _run.check_names("distance_to_measure", run, distance_to_measure)
    source = _complete(X, metric, minkowski_p)
    neighbours = _options.whole("k", k, 1, max(1, source.size))
    if source.size == 0:
        return np.empty(0)
    return np.asarray(_run.run(_core.distance_to_measure, source, neighbours, options=dict(run)))


def core_distances(X: Any, k: int, *, metric: Any = "euclidean", minkowski_p: float = 2.0,
                   **run: Unpack[RunOptions]) -> NDArray[np.float64]:
    """For each point, the distance to its k-th nearest other point.

    Copies of the point count. HDBSCAN* (Campello, Moulavi, Sander 2013) counts the point itself:
    its m_pts, and `min_samples` of scikit-learn, are k + 1.

    Parameters
    ----------
    X : array_like
        As in `rips`; all distances must be known.
    k : int
        Number of neighbours, less than the number of points. With 0, all core distances are 0.
    metric, minkowski_p
        As in `rips`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    ndarray

    Examples
    --------
    >>> ph.core_distances([[0], [1], [5]], 1)
    array([1., 1., 4.])
    """
    _run.check_names("core_distances", run, core_distances)
    source = _complete(X, metric, minkowski_p)
    neighbours = _options.whole("k", k, 0, max(0, source.size - 1))
    return np.asarray(_run.run(_core.core_distances, source, neighbours, options=dict(run)))


def root_mean_square(distances: NDArray[np.float64]) -> NDArray[np.float64]:
    """The root mean square of each row, without a square that overflows or vanishes."""
    largest = distances.max(axis=1, keepdims=True)
    largest[largest == 0] = 1
    mean: NDArray[np.float64] = np.sqrt(np.mean((distances / largest)**2, axis=1)) * largest[:, 0]
    return mean


def _complete(X: Any, metric: Any, minkowski_p: Any) -> _core.MetricSpace:
    space = source_of(X, metric=metric, minkowski_p=minkowski_p, has_nan_option=False).space
    if not space.is_complete:
        raise UsageError("X: found only some of the distances (a sparse matrix), expected all")
    return space


def collapse(distances: Any, *, threshold: float | None = None, nan: str = "error",
             diagonal: str = "zero", symmetrise: str | None = None,
             **run: Unpack[RunOptions]) -> coo_array:
    """Removes or delays edges such that the bars of positive length stay the same in every
    dimension.

    Parameters
    ----------
    distances : array_like or sparse matrix
        As in ``rips(..., metric="precomputed")``.
    threshold : float, optional
        The largest distance that is kept. Default: the enclosing radius.
    nan : {"error", "drop"}, diagonal : {"zero", "any"}, symmetrise : {None, "max", "min", "lower"}
        As in `rips`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    scipy.sparse.coo_array
        Each remaining edge once, above the diagonal; pairs that are not stored are never joined.

    Examples
    --------
    >>> ph.collapse([[0, 1, 3], [1, 0, 2], [3, 2, 0]]).nnz
    2
    """
    from scipy.sparse import coo_array
    _run.check_names("collapse", run, collapse)
    _options.choice("diagonal", diagonal, ["zero", "any"])
    request = rips_request(_options.arguments_of(rips, distances, {
        "metric": "precomputed", "threshold": threshold, "nan": nan, "diagonal": diagonal,
        "symmetrise": symmetrise, "merge_equal_points": False, **run}))
    u, v, values = _run.run(_core.collapsed_edges, request.recipe, options=request.options)
    n = request.meta["points"]
    i, j = np.asarray(u), np.asarray(v)
    return coo_array((np.asarray(values), (np.minimum(i, j), np.maximum(i, j))), shape=(n, n))
