# SPDX-License-Identifier: MIT
"""Barcodes of lists of point clouds, distances and images."""
from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
from joblib import effective_n_jobs
from numpy.typing import NDArray
from sklearn.base import TransformerMixin

from .. import _arrays, _options
from .._barcodes import Barcode
from .._batch import computed
from .._compute import alpha, cubical, rips
from .._errors import UsageError
from .._requests import PointImage
from .._vectors import checked_infinity, settled
from ._base import MakesTables, TakesLists

_OUTPUTS = ["list", "giotto", "barcode"]


class _Persistence(MakesTables, TransformerMixin, TakesLists):
    """The common base of the barcode transformers."""

    homology_dimensions: Any
    output: Any
    infinity: Any
    reduced: Any
    n_jobs: Any
    _function: Callable[..., Barcode]

    def fit(self, X: Any, y: Any = None) -> Any:
        """Checks the parameters. There is nothing to learn.

        Parameters
        ----------
        X : list
            As in `transform`.
        y : None
            Not used; present because pipelines pass it.

        Returns
        -------
        self
        """
        self._checked()
        self._samples(X)
        return self

    def transform(self, X: Any) -> Any:
        """The diagrams of each sample.

        Parameters
        ----------
        X : list
            Samples, as described above.

        Returns
        -------
        list of list of ndarray, ndarray or list of Barcode
            The type that `output` selects; a table if `set_output` requested one, except for
            ``output="giotto"``.
        """
        dims = self._checked()
        samples = self._samples(X)
        bars = computed(self._function, samples, {
            **self._options(), "max_dim": max(dims), "min_dim": min(dims),
            "cells": self.output == "barcode", "threads": effective_n_jobs(self.n_jobs)}, "sample")
        if self.output == "barcode":
            return self._in_table(X, bars)
        rows = [[self._diagram(one, dim) for dim in dims] for one in bars]
        if self.output == "giotto":
            return _giotto(rows, dims)
        is_one = not _are_several(self.homology_dimensions)
        return self._in_table(X, [row[0] for row in rows] if is_one else rows)

    def get_feature_names_out(self, input_features: Any = None) -> NDArray[np.object_]:
        """The dimensions: H0, H1; or "barcode" for ``output="barcode"``.

        Parameters
        ----------
        input_features : None
            Ignored: samples have no features.

        Returns
        -------
        ndarray of str
        """
        names = ["barcode"] if self.output == "barcode" else [f"H{d}" for d in self._checked()]
        return np.array(names, dtype=object)

    def _checked(self) -> list[int]:
        """Checks all parameters and returns the dimensions."""
        given = self.homology_dimensions
        dims = [_options.whole("homology_dimensions", dim, 0)
                for dim in (given if _are_several(given) else [given])]
        if isinstance(given, (set, frozenset)):
            dims.sort()
        if not dims or len(set(dims)) < len(dims):
            raise _options.refuse("homology_dimensions", given, "at least one dimension, each once")
        _options.choice("output", self.output, _OUTPUTS)
        _options.flag("reduced", self.reduced)
        if self.infinity is not None:
            checked_infinity(self.infinity, may_keep=False)
        if self.output == "barcode" and (self.infinity is not None or self.reduced):
            raise UsageError("output: found 'barcode', which keeps the bars as computed; infinity "
                             "and reduced need 'list' or 'giotto'")
        return dims

    def _samples(self, X: Any) -> Sequence[Any]:
        raise NotImplementedError

    def _options(self) -> dict[str, Any]:
        """The keyword arguments for `self._function`, without the dimensions."""
        raise NotImplementedError

    def _diagram(self, bars: Barcode, dim: int) -> NDArray[np.float64]:
        dgm = bars.dgm(dim)
        if self.reduced and dim == 0:
            endless = np.flatnonzero(dgm[:, 1] == math.inf)
            dgm = np.delete(dgm, endless[:1], axis=0)
        return dgm if self.infinity is None else settled(dgm, self.infinity, f"H{dim}")


def _are_several(dims: Any) -> bool:
    """True for a list or another iterable of dimensions."""
    return (isinstance(dims, Iterable) and not isinstance(dims, (str, bytes))
            and getattr(dims, "ndim", 1) > 0)


def _own(transformer: Any, names: list[str]) -> dict[str, Any]:
    return {name: getattr(transformer, name) for name in names}


def _giotto(rows: list[list[NDArray[np.float64]]], dims: list[int]) -> NDArray[np.float64]:
    """Rows birth, death, dim, the same number for each sample, padded with bars of length 0."""
    parts = []
    for dim, dgms in sorted(zip(dims, zip(*rows)), key=lambda pair: pair[0]):
        births = np.concatenate([dgm[:, 0] for dgm in dgms])
        part = np.full((len(rows), max(1, *map(len, dgms)), 3), births.min() if len(births) else 0.0)
        part[:, :, 2] = dim
        for i, dgm in enumerate(dgms):
            part[i, :len(dgm), :2] = dgm
        parts.append(part)
    return np.concatenate(parts, axis=1) if parts else np.empty((0, len(dims), 3))


def list_of(X: Any, what: str, axes: int) -> Sequence[Any]:
    """The samples. An array with this many axes is one sample, not a list."""
    if _arrays.is_sparse(X) or isinstance(X, (str, bytes)) or (
            isinstance(X, np.ndarray) and X.dtype != object and X.ndim <= axes):
        found = f"an array of shape {X.shape}" if hasattr(X, "shape") else type(X).__name__
        raise UsageError(f"X: found {found}, expected a list of {what}; [X] is a list of one")
    if not isinstance(X, Iterable):
        raise UsageError(f"X: found {type(X).__name__}, expected a list of {what}")
    return list(X)


class RipsPersistence(_Persistence):
    """The barcodes of point clouds or distances, computed with `libph.rips`.

    Samples are point clouds, which may have different numbers of points; with
    ``metric="precomputed"``, they are matrices of distances, dense, condensed or sparse.

    Parameters
    ----------
    homology_dimensions : int or tuple of int
        The dimensions. With a single number, each sample becomes one diagram; otherwise a list of
        diagrams.
    metric, minkowski_p, threshold, weights, dtm_neighbors, core_neighbors, field, collapse, \
approximation
        As in `libph.rips`.
    subsample : int, optional
        Number of points to keep of each cloud. Each point is the one farthest from the points
        chosen before it.
    min_persistence : float
        Bars with death - birth <= this value are left out.
    output : {"list", "giotto", "barcode"}
        "list": arrays (k, 2) of rows birth, death. "giotto": one array (samples, bars, 3) of rows
        birth, death, dimension, padded with bars of length 0 at the least birth of their dimension,
        with at least one bar per dimension. "barcode": a `libph.Barcode` for each sample.
    infinity : None, "drop", "error" or float
        What to do with bars that never die: None keeps them, "drop" leaves them out, "error" raises
        an error, and with a number they die at this value.
    reduced : bool
        If True, the component that never dies is left out; if there are several, the eldest one.
    n_jobs : int, optional
        Number of threads, each of which computes one sample at a time. If there are at least twice
        as many threads as samples, each sample gets several. Default: one.

    Examples
    --------
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> ph.sklearn.RipsPersistence(homology_dimensions=1).fit_transform([square])
    [array([[1.        , 1.41421356]])]
    """

    _function = staticmethod(rips)

    def __init__(self, homology_dimensions: Any = (0, 1), metric: Any = "euclidean",
                 minkowski_p: float = 2.0, threshold: float | None = None, weights: Any = None,
                 dtm_neighbors: int | None = None, core_neighbors: int | None = None,
                 field: int = 2, collapse: Any = "auto", subsample: int | None = None, approximation: float | None = None,
                 min_persistence: float = 0.0, output: str = "list", infinity: Any = None,
                 reduced: bool = False, n_jobs: int | None = None) -> None:
        self.homology_dimensions = homology_dimensions
        self.metric = metric
        self.minkowski_p = minkowski_p
        self.threshold = threshold
        self.weights = weights
        self.dtm_neighbors = dtm_neighbors
        self.core_neighbors = core_neighbors
        self.field = field
        self.collapse = collapse
        self.subsample = subsample
        self.approximation = approximation
        self.min_persistence = min_persistence
        self.output = output
        self.infinity = infinity
        self.reduced = reduced
        self.n_jobs = n_jobs

    def _samples(self, X: Any) -> Sequence[Any]:
        return list_of(X, "distances" if self.metric == "precomputed" else "clouds", 2)

    def _options(self) -> dict[str, Any]:
        return _own(self, ["metric", "minkowski_p", "threshold", "weights", "dtm_neighbors",
                           "core_neighbors", "field", "collapse", "subsample", "approximation", "min_persistence"])


class AlphaPersistence(_Persistence):
    """The barcodes of point clouds in the plane or in space, computed with `libph.alpha`.

    Samples are point clouds, which may have different numbers of points. Filtration values are
    radii of balls.

    Parameters
    ----------
    homology_dimensions : int or tuple of int
        The dimensions. With a single number, each sample becomes one diagram; otherwise a list of
        diagrams.
    values, squared, threshold, field
        As in `libph.alpha`.
    min_persistence : float
        Bars with death - birth <= this value are left out.
    output, infinity, reduced, n_jobs
        As in `RipsPersistence`.

    Examples
    --------
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> ph.sklearn.AlphaPersistence(homology_dimensions=1).fit_transform([square])
    [array([[0.5       , 0.70710678]])]
    """

    _function = staticmethod(alpha)

    def __init__(self, homology_dimensions: Any = (0, 1), values: str = "alpha",
                 squared: bool = False, threshold: float | None = None, field: int = 2,
                 min_persistence: float = 0.0, output: str = "list", infinity: Any = None,
                 reduced: bool = False, n_jobs: int | None = None) -> None:
        self.homology_dimensions = homology_dimensions
        self.values = values
        self.squared = squared
        self.threshold = threshold
        self.field = field
        self.min_persistence = min_persistence
        self.output = output
        self.infinity = infinity
        self.reduced = reduced
        self.n_jobs = n_jobs

    def _samples(self, X: Any) -> Sequence[Any]:
        return list_of(X, "clouds", 2)

    def _options(self) -> dict[str, Any]:
        return _own(self, ["values", "squared", "threshold", "field", "min_persistence"])


class CubicalPersistence(_Persistence):
    """The barcodes of images, computed with `libph.cubical`.

    Samples are images, which may have different extents. A dimension must be below the number of
    their axes; if an axis is periodic, it may equal that number.

    Parameters
    ----------
    homology_dimensions : int or tuple of int
        The dimensions. With a single number, each sample becomes one diagram; otherwise a list of
        diagrams.
    construction, superlevel, periodic, threshold, field, nan
        As in `libph.cubical`.
    min_persistence : float
        Bars with death - birth <= this value are left out.
    output, infinity, reduced, n_jobs
        As in `RipsPersistence`.

    Examples
    --------
    >>> ring = [[9, 9, 9, 9, 9], [9, 1, 1, 1, 9], [9, 1, 7, 1, 9], [9, 1, 1, 1, 9], [9, 9, 9, 9, 9]]
    >>> ph.sklearn.CubicalPersistence().fit_transform([ring])
    [[array([[ 1., inf]]), array([[1., 7.]])]]
    """

    _function = staticmethod(cubical)

    def __init__(self, homology_dimensions: Any = (0, 1), construction: str = "vertices",
                 superlevel: bool = False, periodic: Any = (), threshold: float | None = None,
                 field: int = 2, nan: str = "error", min_persistence: float = 0.0,
                 output: str = "list", infinity: Any = None, reduced: bool = False,
                 n_jobs: int | None = None) -> None:
        self.homology_dimensions = homology_dimensions
        self.construction = construction
        self.superlevel = superlevel
        self.periodic = periodic
        self.threshold = threshold
        self.field = field
        self.nan = nan
        self.min_persistence = min_persistence
        self.output = output
        self.infinity = infinity
        self.reduced = reduced
        self.n_jobs = n_jobs

    def _samples(self, X: Any) -> Sequence[Any]:
        samples = list_of(X, "images", 1)
        most = max(self._checked())
        for i, sample in enumerate(samples):
            image = sample.image if isinstance(sample, PointImage) else sample
            axes = _arrays.as_array(image, f"sample {i}").ndim
            if most > axes or (most == axes and not any(
                    _options.axes("periodic", self.periodic, axes))):
                raise UsageError(f"sample {i}: homology_dimensions: found {most}, expected less "
                                 f"than the {axes} axes of the image; [X] is a list of one image")
        return samples

    def _options(self) -> dict[str, Any]:
        return _own(self, ["construction", "superlevel", "periodic", "threshold", "field", "nan",
                           "min_persistence"])
