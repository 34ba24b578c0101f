# SPDX-License-Identifier: MIT
"""ripser.py's interface on top of libph.

>>> from libph.compat.ripser import ripser
>>> ripser(np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 1]]))["dgms"][1]
array([[1.        , 1.41421354]])

The numbers are the same as in ripser.py: rounded to single precision, and in the order of
ripser.py. ``dtype=np.float64`` gives exact numbers. docs/how-to/coming-from.md lists the cases in
which libph deliberately gives another answer.
"""
from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from .. import _arrays, _options, _run
from .._compute import cubical
from .._core import version as __version__
from .._errors import DataError, NotBuiltIn, UsageError
from . import _flag, _missing
from .persim import plot_diagrams as plot_dgms

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .._run import RunOptions
    from ._ripser_class import Rips

__all__ = ["Rips", "__version__", "correlation_to_distance", "get_greedy_perm", "lower_star_img",
           "plot_dgms", "ripser"]


def __getattr__(name: str) -> Any:
    if name == "Rips":  # its base class is part of scikit-learn
        from ._ripser_class import Rips
        return Rips
    return _missing.attribute(__name__, name, __all__)


def ripser(X: Any, maxdim: int = 1, thresh: float = np.inf, coeff: int = 2,
           distance_matrix: bool = False, do_cocycles: bool = False, metric: Any = "euclidean",
           n_perm: int | None = None, *, dtype: DTypeLike = np.float32,
           **run: Unpack[RunOptions]) -> dict[str, Any]:
    """Diagrams of the Vietoris-Rips filtration, and the further results of ripser.py.

    Parameters
    ----------
    X : array_like or sparse matrix
        Points, one per row; or distances: entries above the diagonal are used, and entries on the
        diagonal are births.
    maxdim : int
        The highest dimension of homology; a negative number counts as 0.
    thresh : float
        The largest distance at which points are joined.
    coeff : int
        A prime.
    distance_matrix : bool
        If True, X holds distances.
    do_cocycles : bool
        If True, each bar of dimension 1 and above has a cocycle.
    metric : str or callable
        As in scikit-learn's `pairwise_distances`.
    n_perm : int, optional
        Number of points to take. Each point is the one farthest from the points taken before it.
    dtype : {float32, float64}
        The precision of the filtration.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    dict
        `dgms`, `cocycles`: a list for each dimension; `num_edges`, `dperm2all`, `idx_perm`,
        `r_cover`.

    Raises
    ------
    UsageError, DataError
        Both are ValueErrors.
    """
    _run.check_names("ripser", run, ripser)
    kind = _flag.precision(dtype)
    if not hasattr(X, "shape"):
        X = _arrays.as_array(X, "X")
    if len(X.shape) != 2:
        raise UsageError(f"X: found an array of shape {X.shape}, expected (points, coordinates), "
                         "or a square matrix of distances")
    _look_at_shape(X, distance_matrix, n_perm)
    limit = _flag.last_rounded_to(_flag.threshold(thresh), kind)
    max_dim = _flag.dimension(maxdim)

    points = np.arange(X.shape[0])
    covering: Any = 0.0
    distances: Any
    if n_perm and n_perm < X.shape[0]:
        points, radii, to_all = get_greedy_perm(X, n_perm, distance_matrix, metric)
        covering, distances = radii[-1], to_all[:, points]
    elif distance_matrix:
        distances = to_all = X
    else:
        with _run.within_limit(run):
            distances = to_all = _pairwise(X, metric)
    if _arrays.is_sparse(distances):
        flag = _flag.of_sparse(distances, limit, distances.shape[0], upper_wins=False)
    else:
        flag = _flag.of_dense(distances, limit, kind, is_symmetric=to_all is X)
    chains = "cocycles" if do_cocycles and max_dim else None
    bars = _flag.compute(flag, max_dim, kind, False, field=coeff, representatives=chains, **run)
    cocycles: list[list[NDArray[np.int64]]] = [[] for _ in bars.dgms]
    if chains:
        for dim in range(1, max_dim + 1):
            cocycles[dim] = [_cocycle(bars, place, coeff, points) for place in bars.places(dim)]
    return {"dgms": bars.dgms, "cocycles": cocycles, "num_edges": flag.edges, "dperm2all": to_all,
            "idx_perm": points, "r_cover": covering}


def _look_at_shape(X: Any, is_distances: bool, n_perm: int | None) -> None:
    """Raises the warnings and errors of ripser.py about the shape of the data."""
    rows, columns = X.shape
    if is_distances:
        if rows != columns:
            raise UsageError(f"Distance matrix is not square: found shape {X.shape}")
    elif rows == columns:
        warnings.warn("The input matrix is square, but the distance_matrix flag is off.  Did you "
                      "mean to indicate that this was a distance matrix?", stacklevel=3)
    elif rows < columns:
        warnings.warn("The input point cloud has more columns than rows; did you mean to "
                      "transpose?", stacklevel=3)
    if n_perm is None or _options.whole("n_perm", n_perm, -2**63) == 0:
        return
    if is_distances and _arrays.is_sparse(X):
        raise UsageError("Greedy permutation is not supported for sparse distance matrices")
    if n_perm > rows:
        raise UsageError("Number of points in greedy permutation is greater than number of points "
                         f"in the point cloud: found {n_perm}, expected at most {rows}")
    if n_perm < 0:
        raise UsageError("Should be a strictly positive number of points in the greedy "
                         f"permutation: found {n_perm}")


def _pairwise(X: Any, metric: Any, *others: Any) -> NDArray[Any]:
    """The distances of scikit-learn; its Euclidean distances differ from others in the last
    digits."""
    if not others and type(X) is np.ndarray and type(metric) is str and metric == "euclidean":
        points = X.astype(np.float64) if X.dtype.kind in "biu" else X
        if points.dtype == np.float64 and points.size and np.isfinite(points).all():
            return _euclidean(points)
    try:
        from sklearn.metrics import pairwise_distances
    except ImportError:
        raise NotBuiltIn("ripser: distances between these points need scikit-learn, which is not "
                         "installed; distance_matrix=True takes distances, ph.rips takes points"
                         ) from None
    return np.asarray(pairwise_distances(X, *others, metric=metric))


def _euclidean(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The Euclidean distances of finite points, with the digits of scikit-learn, whose import takes
    longer than most computations. Both use the law of cosines and the same functions of NumPy."""
    squares = np.einsum("ij,ij->i", points, points)
    distances = _arrays.new_array((len(points), len(points)))
    np.matmul(points, points.T, out=distances)
    distances *= -2
    distances += squares[:, None]
    distances += squares
    np.maximum(distances, 0, out=distances)
    np.fill_diagonal(distances, 0)
    return np.sqrt(distances, out=distances)


@_options.with_hints
def get_greedy_perm(X: Any, n_perm: int | None = None, distance_matrix: bool = False,
                    metric: Any = "euclidean"
                    ) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[Any]]:
    """Selects point 0, and then always the point that is farthest from the points before it.

    Parameters
    ----------
    X, distance_matrix, metric
        As in `ripser`, but without sparse matrices.
    n_perm : int, optional
        Number of points. Default: all.

    Returns
    -------
    tuple of ndarray
        The points; for each point, the radius within which it and the points before it cover all
        points; its distances to all points.
    """
    if distance_matrix or not hasattr(X, "shape"):
        X = _arrays.as_array(X, "X")
    count = _options.whole("n_perm", n_perm or X.shape[0], 0, X.shape[0])

    def row(i: int) -> NDArray[Any]:
        if distance_matrix:
            return np.asarray(X[i])
        distances = _pairwise(X, metric, X[i:i + 1]).ravel()
        distances[i] = 0
        return distances

    points, radii = np.zeros(count, dtype=np.int64), np.zeros(count)
    to_all = []
    nearest: Any = np.inf
    for k in range(count):
        points[k] = np.argmax(nearest)
        to_all.append(row(int(points[k])))
        nearest = np.minimum(nearest, to_all[-1])
        radii[k] = nearest.max()
    return points, radii, np.array(to_all)


def _cocycle(bars: _flag.Bars, place: Any, p: int, points: NDArray[np.int64]) -> NDArray[np.int64]:
    """One row per simplex: its vertices, descending, and the coefficient from 0 to p - 1."""
    chain = bars.barcode.representative(int(place))
    return np.column_stack([points[chain.cells[:, ::-1]], chain.coefficients % p])


def lower_star_img(img: ArrayLike, *, dtype: DTypeLike = np.float32, **run: Unpack[RunOptions]
                   ) -> NDArray[np.float64]:
    """H0 of the sublevel sets of a picture, whose pixels have eight neighbours.

    Parameters
    ----------
    img : array_like
        An array of numbers with two axes.
    dtype : {float32, float64}
        The precision of the filtration.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    ndarray
        Rows birth, death, sorted by death.
    """
    _run.check_names("lower_star_img", run, lower_star_img)
    kind = _flag.precision(dtype)
    image = _arrays.as_image(img, "img")
    if image.ndim != 2:
        raise UsageError(f"img: found an array of shape {image.shape}, expected two axes")
    barcode = cubical(image, construction="cells", max_dim=0, cells=False, **run)
    return _flag.bars_of(barcode, 0, kind).dgms[0]


@_options.with_hints
def correlation_to_distance(C: ArrayLike, check_input: bool = True) -> NDArray[np.float64]:
    """Converts correlations c to distances: the square root of 2 (1 - c), from 0 to 2, with 0 on
    the diagonal.

    Parameters
    ----------
    C : array_like
        A symmetric matrix of correlations. Values outside [-1, 1] are clipped.
    check_input : bool
        If True, C is checked first.

    Raises
    ------
    UsageError
        If C is not a square matrix.
    DataError
        If C is not symmetric, or has an entry below -1.05 or above 1.05, or NaN.

    Warns
    -----
    RuntimeWarning
        If an entry is outside [-1, 1], or an entry on the diagonal is not 1.
    """
    correlations = _arrays.as_float64(_arrays.as_array(C, "C"), "C")
    if check_input:
        _look_at_correlations(correlations)
    distances = np.clip(correlations, -1, 1)
    np.subtract(1, distances, out=distances)
    distances *= 2
    np.sqrt(distances, out=distances)
    np.fill_diagonal(distances, 0)
    return distances


def _look_at_correlations(C: NDArray[np.float64]) -> None:
    if C.ndim != 2:
        raise UsageError(f"Input must be a 2D matrix: found an array of shape {C.shape}")
    if C.shape[0] != C.shape[1]:
        raise UsageError(f"Matrix must be square: found shape {C.shape}")
    if np.isnan(C).any():
        i, j = np.argwhere(np.isnan(C))[0]
        raise DataError(f"C: row {i}, column {j}: found nan, expected a number from -1 to 1")
    if not np.allclose(C, C.T, rtol=1e-5, atol=1e-5):
        i, j = np.argwhere(~np.isclose(C, C.T, rtol=1e-5, atol=1e-5))[0]
        raise DataError(f"Matrix must be symmetric: row {i}, column {j}: found {C[i, j]}, but "
                        f"{C[j, i]} in row {j}, column {i}")
    largest = float(np.abs(C).max(initial=0.0))
    if largest > 1.05:
        raise DataError("Values are significantly outside the valid correlation bounds [-1,1]: "
                        f"found {largest} in absolute value; a covariance matrix, or data?")
    if largest > 1:
        warnings.warn("Some values are slightly outside the valid correlation bounds [-1,1], "
                      f"{largest} in absolute value. They are replaced by the bounds.",
                      RuntimeWarning, stacklevel=3)
    if not np.allclose(np.diagonal(C), 1, atol=1e-3):
        warnings.warn("The matrix diagonal elements deviate from 1.0. Are these correlations?",
                      RuntimeWarning, stacklevel=3)
