# SPDX-License-Identifier: MIT
"""Tests which bars are significant and whether groups of barcodes differ."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _options, _results, _run
from ._barcodes import Barcode
from ._errors import DataError, UsageError
from ._vectors import as_diagram

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from typing_extensions import Unpack

    from ._run import RunOptions

_MOST = 2**63 - 1


@_options.with_hints
def p_values(bars: Barcode | ArrayLike, dim: int | None = None, *, filtration: str | None = None,
             corrected: bool = True) -> NDArray[np.float64]:
    """The p-value of each bar: the probability that a bar of noise stands out at least as much.

    The test applies to loops, hollows and holes of higher dimension in point sets. For bars of
    noise, log log (death / birth) follows one law up to a shift, whatever distribution the points
    are drawn from [Bobrowski, Skraba 2023]. Values may be radii, diameters or squares. With few
    bars the test is weak, because the shift is computed from the mean of these bars.

    Parameters
    ----------
    bars : Barcode or array_like
        A barcode, or an array of rows birth, death.
    dim : int, optional
        For a barcode: the dimension, at least 1.
    filtration : {"rips", "cech"}, optional
        The filtration of the bars; "cech" also for alpha complexes. Default: "rips" for barcodes of
        `rips`, "cech" for barcodes of `alpha` except with ``values="delaunay-rips"``.
    corrected : bool
        If True, p is multiplied by the number of finite bars longer than 0, up to 1 (Bonferroni):
        then all bars with p at most 0.05 are real with a probability of 95 %.

    Returns
    -------
    ndarray
        A p-value for each bar of `dim`, in their order. NaN for bars that never die.

    Examples
    --------
    >>> rng = np.random.default_rng(0)
    >>> angles = rng.uniform(0, 2 * np.pi, 200)
    >>> circle = np.column_stack([np.cos(angles), np.sin(angles)]) + rng.normal(0, 0.1, (200, 2))
    >>> int((ph.p_values(ph.rips(circle), dim=1) < 0.05).sum())
    1
    """
    if isinstance(bars, Barcode):
        if dim is None:
            raise UsageError("dim: found None, expected the dimension of the bars, at least 1")
        rows = bars.dgm(_options.whole("dim", dim, 1))
        kind = bars.meta.get("complex")
        if filtration is None and kind in ("alpha", "delaunay-cech"):
            filtration = "cech"
        if filtration is None and kind != "rips":
            raise UsageError(f"filtration: found None, expected 'rips' or 'cech' for bars of "
                             f"complex {kind!r}; the test is not defined for images")
    else:
        if dim is not None:
            raise UsageError("dim: does nothing for arrays, expected a Barcode")
        if filtration is None:
            raise UsageError("filtration: found None, expected 'rips' or 'cech' for an array")
        rows = as_diagram(bars, "bars")
    chosen = "rips" if filtration is None else _options.choice("filtration", filtration,
                                                               ["rips", "cech"])
    found = _core.p_values(np.ascontiguousarray(rows), chosen)
    return np.asarray(found[_options.flag("corrected", corrected)])


def confidence_radius(X: ArrayLike, *, alpha: float = 0.05, subsamples: int = 100,
                      size: int | None = None, seed: int = 0, **run: Unpack[RunOptions]) -> float:
    """A bound on the distance between points and the set from which they were drawn.

    With probability 1 - alpha, the Hausdorff distance is at most c, in the limit of many points
    [Fasy et al. 2014, subsampling]. Therefore bars of the distance function that are longer than 2
    c are real. The values of `rips` are diameters, which are twice as large: bars of `rips` longer
    than 4 c are real. The bound is conservative: expect it to be large.

    Parameters
    ----------
    X : array_like
        Points, one per row; Euclidean.
    alpha : float
        The probability of being wrong, above 0 and below 1.
    subsamples : int
        Number of subsamples.
    size : int, optional
        Number of points of each subsample. Default: n / ln n.
    seed : int
        Seed of the random numbers; the same seed gives the same result.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    float
        c, in the unit of the points.

    Examples
    --------
    >>> rng = np.random.default_rng(0)
    >>> angles = rng.uniform(0, 2 * np.pi, 2000)
    >>> circle = np.column_stack([np.cos(angles), np.sin(angles)])
    >>> 0.02 < ph.confidence_radius(circle) < 0.2
    True
    """
    _run.check_names("confidence_radius", run, confidence_radius)
    points = _arrays.as_points(X)
    return float(_run.run(
        _core.confidence_radius, points, _alpha(alpha),
        _options.whole("subsamples", subsamples, 1),
        0 if size is None else _options.whole("size", size, 1),
        _options.whole("seed", seed, 0, _MOST), options=dict(run)))


class Band(NamedTuple):
    """A mean and a band around it; see `confidence_band`.

    Attributes
    ----------
    mean : ndarray
        The mean, in the shape of one function. `lower` and `upper` have the same shape.
    lower : ndarray
        The lower end of the band.
    upper : ndarray
        The upper end of the band.
    """

    mean: NDArray[np.float64]
    lower: NDArray[np.float64]
    upper: NDArray[np.float64]

    def __repr__(self) -> str:
        return _results.in_brief(self)

    def plot(self, ax: Axes | None = None, *, grid: ArrayLike | None = None, layer: int = 0,
             **options: Any) -> Axes:
        """Draws the mean as a line in its band. Needs matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            The axes to draw on. Default: the axes of a new figure.
        grid : array_like, optional
            The values at which the functions were evaluated. Default: 0, 1, 2, …
        layer : int
            The row to draw, for landscapes with several layers.
        **options
            Style of the line, passed to `Axes.plot`: `color`, `label`, …

        Returns
        -------
        matplotlib.axes.Axes
        """
        if np.ndim(self.mean) > 2:
            raise UsageError(f"plot: found functions of shape {np.shape(self.mean)}, expected a "
                             "number for each grid point, or one row of such numbers per layer")
        mean, lower, upper = (np.atleast_2d(part) for part in self)
        row = _options.whole("layer", layer, 0, len(mean) - 1)
        places = np.arange(mean.shape[1]) if grid is None else \
            _arrays.as_values(grid, "grid", mean.shape[1])
        if ax is None:
            import matplotlib.pyplot
            _, ax = matplotlib.pyplot.subplots()
        line, = ax.plot(places, mean[row], **options)
        ax.fill_between(places, lower[row], upper[row], color=line.get_color(), alpha=0.25,
                        linewidth=0)
        return ax


def confidence_band(functions: ArrayLike, *, alpha: float = 0.05, repetitions: int = 1000,
                    seed: int = 0, **run: Unpack[RunOptions]) -> Band:
    """The mean of functions such as landscapes, and a band that contains the true mean.

    With probability 1 - alpha, in the limit of many samples, the true mean lies in the band
    everywhere at once. Uses the multiplier bootstrap [Chazal et al. 2014].

    Parameters
    ----------
    functions : array_like
        An array whose first axis counts samples, at least 2: the rows that
        `libph.sklearn.Landscape` returns, or ``[bars.landscape(1, range=...) for bars in ...]`` on
        one grid.
    alpha : float
        The probability of being wrong, above 0 and below 1.
    repetitions : int
        Number of repetitions of the bootstrap.
    seed : int
        Seed of the random numbers; the same seed gives the same result.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Band

    Examples
    --------
    >>> samples = np.random.default_rng(0).normal(3, 1, (100, 20))
    >>> band = ph.confidence_band(samples)
    >>> bool((band.lower < 3).all() and (3 < band.upper).all())
    True
    """
    _run.check_names("confidence_band", run, confidence_band)
    array = _arrays.as_float64(_arrays.as_array(functions, "functions"), "functions")
    if array.ndim < 2 or len(array) < 2:
        raise UsageError(f"functions: found an array of shape {array.shape}, expected at least two "
                         "samples along the first axis, and at least one more axis")
    if not np.isfinite(array).all():
        where = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise DataError(f"functions: {_arrays.place_of(where)}: found {array[where]}, expected a "
                        "finite number")
    block, half_width = _run.run(
        _core.confidence_band, np.ascontiguousarray(array).ravel(), len(array), _alpha(alpha),
        _options.whole("repetitions", repetitions, 1), _options.whole("seed", seed, 0, _MOST),
        options=dict(run))
    mean = np.asarray(block).reshape(array.shape[1:])
    return Band(mean, mean - half_width, mean + half_width)


class PermutationTest(NamedTuple):
    """The result of `permutation_test`.

    Attributes
    ----------
    p : float
        The probability that groups from one distribution are at least as far apart.
    loss : float
        The sum over the groups of half the mean of ``distance ** power`` over all pairs within the
        group.
    """

    p: float
    loss: float


def permutation_test(distances: ArrayLike, groups: Any, *, shuffles: int = 1000, power: float = 1.0,
                     seed: int = 0, **run: Unpack[RunOptions]) -> PermutationTest:
    """Tests whether groups of barcodes differ [Robinson, Turner 2017].

    The test shuffles the labels and compares the mean distances within groups.

    Parameters
    ----------
    distances : array_like
        A finite square matrix, as `diagram_distances` returns it.
    groups : sequence
        The group of each barcode: numbers other than NaN, or words. There must be at least two
        groups of at least two barcodes.
    shuffles : int
        Number of shuffles. The least possible p is 1 / (shuffles + 1).
    power : float
        Exponent of the distances, above 0.
    seed : int
        Seed of the random numbers; the same seed gives the same result.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    PermutationTest

    Examples
    --------
    >>> places = np.array([0, 1, 2, 3, 50, 51, 52, 53])
    >>> distances = abs(places[:, None] - places)
    >>> ph.permutation_test(distances, list("aaaabbbb")).p < 0.05
    True
    """
    _run.check_names("permutation_test", run, permutation_test)
    matrix = _arrays.as_float64(_arrays.as_array(distances, "distances"), "distances")
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1]:
        raise UsageError(f"distances: found an array of shape {matrix.shape}, expected a square "
                         "matrix")
    if not np.array_equal(matrix, matrix.T):
        i, j = (int(k) for k in np.argwhere(matrix != matrix.T)[0])
        raise DataError(f"distances: found {matrix[i, j]} at row {i}, column {j} and {matrix[j, i]} "
                        f"at row {j}, column {i}, expected a symmetric matrix without NaN")
    if np.diagonal(matrix).any():
        i = int(np.argmax(np.diagonal(matrix) != 0))
        raise DataError(f"distances: row {i}, column {i}: found {matrix[i, i]}, expected 0 on the "
                        "diagonal")
    try:
        labels = np.asarray(groups, dtype=object)  # a number among words stays a number
        if any(label != label for label in labels.flat):
            raise ValueError("NaN is equal to nothing")
        names, numbers = np.unique(labels, return_inverse=True)
    except (TypeError, ValueError):  # None, numbers among words, lists of unequal lengths
        raise _options.refuse("groups", groups, "numbers or words, none of them NaN, one for "
                              "each row of the distances") from None
    if labels.shape != (len(matrix),):
        raise UsageError(f"groups: found an array of shape {labels.shape}, expected {len(matrix)}, "
                         "one for each row of the distances")
    sizes = np.bincount(numbers, minlength=len(names))
    if len(names) < 2 or sizes.min() < 2:
        raise UsageError(f"groups: found {len(names)} groups of sizes {sizes.tolist()}, expected at least "
                         "two groups, each of at least two barcodes")
    p, loss = _run.run(
        _core.permutation_test, matrix, numbers.astype(np.int64),
        _options.whole("shuffles", shuffles, 1), _options.positive("power", power),
        _options.whole("seed", seed, 0, _MOST), options=dict(run))
    return PermutationTest(p, loss)


def _alpha(alpha: Any) -> float:
    number = _options.real("alpha", alpha, "a number above 0, below 1")
    if not 0 < number < 1:
        raise _options.refuse("alpha", alpha, "a number above 0, below 1")
    return number
