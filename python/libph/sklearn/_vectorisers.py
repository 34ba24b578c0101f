# SPDX-License-Identifier: MIT
"""Vectors of lists of diagrams. What is computed stands in `libph._vectors`."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from sklearn.base import TransformerMixin
from sklearn.utils.validation import check_is_fitted

from .. import _options, _vectors
from .._errors import UsageError
from .._vectors import Diagram, Range
from ._base import MakesTables, TakesDiagrams
from ._diagrams import Samples, samples_of


class _Vectoriser(MakesTables, TransformerMixin, TakesDiagrams):
    """What the vectors of diagrams have in common."""

    _may_keep = False
    infinity: Any

    def fit(self, X: Any, y: Any = None) -> Any:
        """Learns the number of diagrams of a sample, and the ranges that are not given.

        Parameters
        ----------
        X : list
            As of `transform`.
        y : None

        Returns
        -------
        self
        """
        samples = samples_of(X)
        if not samples.rows:
            raise UsageError("X: found no samples, expected at least one")
        columns = [list(column) for column in zip(*self._settled(samples))]
        self.n_features_in_ = len(columns)
        self._diagram_names = samples.names
        self._fit_columns(columns)
        return self

    def transform(self, X: Any) -> Any:
        """A vector of each sample.

        Parameters
        ----------
        X : list
            An entry for each sample: a diagram, which is an array of rows birth, death; a list of
            diagrams, one for each dimension; or a `libph.Barcode`. Or an array (samples, bars, 3)
            of rows birth, death, dimension, in which bars of length 0 are ignored; or a table of
            pandas whose cells are diagrams.

        Returns
        -------
        ndarray or DataFrame
            A row for each sample: what is said of its first diagram, of its second, and so on.
        """
        check_is_fitted(self, "n_features_in_")
        samples = samples_of(X)
        if samples.rows and len(samples.rows[0]) != self.n_features_in_:
            raise UsageError(f"X: found {len(samples.rows[0])} diagrams for each sample, expected "
                             f"{self.n_features_in_} as in the samples that were fitted")
        vectors = np.empty((len(samples.rows), self._n_features_out))
        for i, row in enumerate(self._settled(samples)):
            vectors[i] = np.concatenate([np.ravel(self._vector(dgm, j)) for j, dgm in enumerate(row)])
        return self._in_table(X, vectors)

    def get_feature_names_out(self, input_features: Any = None) -> NDArray[np.object_]:
        """Names of the columns.

        Parameters
        ----------
        input_features : sequence of str, optional
            Names of the diagrams of a sample. Default: H0, H1, ... of barcodes and arrays with
            dimensions, the columns of a table, dgm0, dgm1, ... of others.

        Returns
        -------
        ndarray of str
        """
        check_is_fitted(self, "n_features_in_")
        names = self._diagram_names if input_features is None else list(input_features)
        if len(names) != self.n_features_in_:
            raise UsageError(f"input_features: found {len(names)} names, expected "
                             f"{self.n_features_in_}, one for each diagram of a sample")
        endings = self._endings()
        return np.array([f"{name}_{ending}" for name in names for ending in endings], dtype=object)

    @property
    def _n_features_out(self) -> int:
        return self.n_features_in_ * len(self._endings())

    def _settled(self, samples: Samples) -> list[list[Diagram]]:
        """With what `infinity` makes of bars that never die."""
        rule = _vectors.checked_infinity(self.infinity, self._may_keep)
        return [[_vectors.settled(dgm, rule, f"sample {i}, {name}")
                 for dgm, name in zip(row, samples.names)] for i, row in enumerate(samples.rows)]

    def _fit_columns(self, columns: list[list[Diagram]]) -> None:
        """Of each place in a sample the diagrams that are there."""

    def _vector(self, dgm: Diagram, place: int) -> Any:
        raise NotImplementedError

    def _endings(self) -> list[str]:
        """Of the names of the features of one diagram."""
        raise NotImplementedError


def _ranges(name: str, given: Any, count: int) -> list[Range | None]:
    """A range for each place: None, one for all, or a list with one or None for each."""
    if given is None:
        return [None] * count
    items = list(given) if isinstance(given, (list, tuple, np.ndarray)) else [given]
    if any(item is None or np.ndim(item) == 1 for item in items):
        if len(items) != count:
            raise UsageError(f"{name}: found {len(items)} ranges, expected {count}, one for each "
                             "diagram of a sample")
        return [None if item is None else _vectors.checked_range(name, item) for item in items]
    return [_vectors.checked_range(name, given)] * count


class PersistenceImage(_Vectoriser):
    """Persistence images [Adams et al. 2017]: diagrams as pictures, smoothed and weighted.

    Each bar is a normal distribution around the point (birth, persistence), times a weight. A pixel
    has the integral over it, to the last digits.

    Parameters
    ----------
    bandwidth : float, optional
        The standard deviation, in the unit of the values. Default: a twentieth of the longer range.
    resolution : int or pair of int
        How many pixels along births, and along persistence.
    birth_range, persistence_range : pair of float or list of pairs, optional
        What the image shows: for all diagrams of a sample, or for each of them. Default: of the
        samples that are fitted, from the least birth to the largest, and from 0 to the largest
        persistence. What lies outside is not seen.
    weight_power : float
        The weight is the persistence to this power; 0: all bars weigh 1.
    infinity : {"error", "drop"} or float
        What a bar that never dies is: an error, left out, or one that dies at this value.

    Attributes
    ----------
    birth_ranges_, persistence_ranges_ : list of pair of float
    bandwidths_ : list of float
        Of each diagram of a sample.

    Examples
    --------
    >>> dgms = [[[0, 1]], [[1, 3], [0, 2]]]
    >>> ph.sklearn.PersistenceImage(resolution=(1, 2)).fit_transform(dgms).round(2)
    array([[0.25, 0.25],
           [0.  , 1.  ]])
    """

    def __init__(self, bandwidth: float | None = None, resolution: Any = 20, birth_range: Any = None,
                 persistence_range: Any = None, weight_power: float = 1.0,
                 infinity: float | str = "error") -> None:
        self.bandwidth = bandwidth
        self.resolution = resolution
        self.birth_range = birth_range
        self.persistence_range = persistence_range
        self.weight_power = weight_power
        self.infinity = infinity

    def _fit_columns(self, columns: list[list[Diagram]]) -> None:
        self._pixels = _vectors.checked_resolution(self.resolution)
        self._power = _options.real("weight_power", self.weight_power, "a number, at least 0", 0)
        births = _ranges("birth_range", self.birth_range, len(columns))
        lengths = _ranges("persistence_range", self.persistence_range, len(columns))
        pairs = [_vectors.ranges_of_image(dgms, b, p)
                 for dgms, b, p in zip(columns, births, lengths)]
        self.birth_ranges_ = [pair[0] for pair in pairs]
        self.persistence_ranges_ = [pair[1] for pair in pairs]
        self.bandwidths_ = [
            _vectors.default_bandwidth(*pair) if self.bandwidth is None else
            _options.positive("bandwidth", self.bandwidth) for pair in pairs]

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return _vectors.image(dgm, self.bandwidths_[place], self._pixels, self.birth_ranges_[place],
                              self.persistence_ranges_[place], self._power)

    def _endings(self) -> list[str]:
        return [f"p{i}_b{j}" for i in range(self._pixels[1]) for j in range(self._pixels[0])]


class _OnGrid(_Vectoriser):
    """Functions of the filtration value, at the values of a grid."""

    _may_keep = True
    resolution: Any
    range: Any

    def _fit_columns(self, columns: list[list[Diagram]]) -> None:
        self._count = _options.whole("resolution", self.resolution, 1, 2**30)
        self.ranges_ = [_vectors.range_of_values(dgms) if given is None else given for dgms, given
                        in zip(columns, _ranges("range", self.range, len(columns)))]
        self.grids_ = [np.linspace(low, high, self._count) for low, high in self.ranges_]


class Landscape(_OnGrid):
    """Persistence landscapes [Bubenik 2015], exact at the values of a grid.

    Layer k at t is the k-th largest of max(0, min(t - birth, death - t)) over the bars.

    Parameters
    ----------
    layers : int
        How many.
    resolution : int
        How many values the grid has, both ends of the range among them.
    range : pair of float or list of pairs, optional
        From where to where: for all diagrams of a sample, or for each of them. Default: from the
        least finite value in the samples that are fitted to the largest. What lies outside is not
        seen.
    infinity : {"keep", "error", "drop"} or float
        What a bar that never dies is: one that grows for ever, an error, left out, or one that dies
        at this value.

    Attributes
    ----------
    ranges_ : list of pair of float
    grids_ : list of ndarray
        Of each diagram of a sample.

    Examples
    --------
    >>> ph.sklearn.Landscape(layers=1, resolution=5).fit_transform([[[0, 2]], [[1, 2]]])
    array([[0. , 0.5, 1. , 0.5, 0. ],
           [0. , 0. , 0. , 0.5, 0. ]])
    """

    def __init__(self, layers: int = 5, resolution: int = 100, range: Any = None,
                 infinity: float | str = "keep") -> None:
        self.layers = layers
        self.resolution = resolution
        self.range = range
        self.infinity = infinity

    def _fit_columns(self, columns: list[list[Diagram]]) -> None:
        self._layers = _options.whole("layers", self.layers, 1, 2**20)
        super()._fit_columns(columns)

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return _vectors.landscape(dgm, self._layers, self.grids_[place])

    def _endings(self) -> list[str]:
        return [f"layer{k}_{i}" for k in range(self._layers) for i in range(self._count)]


class BettiCurve(_OnGrid):
    """How many bars live at each value of a grid.

    Parameters
    ----------
    resolution : int
        How many values the grid has, both ends of the range among them.
    range : pair of float or list of pairs, optional
        From where to where: for all diagrams of a sample, or for each of them. Default: from the
        least finite value in the samples that are fitted to the largest.
    infinity : {"keep", "error", "drop"} or float
        What a bar that never dies is: one that lives for ever, an error, left out, or one that dies
        at this value.

    Attributes
    ----------
    ranges_ : list of pair of float
    grids_ : list of ndarray
        Of each diagram of a sample.

    Examples
    --------
    >>> ph.sklearn.BettiCurve(resolution=3).fit_transform([[[0, 2]], [[0, 2], [1, np.inf]]])
    array([[1., 1., 0.],
           [1., 2., 1.]])
    """

    def __init__(self, resolution: int = 100, range: Any = None,
                 infinity: float | str = "keep") -> None:
        self.resolution = resolution
        self.range = range
        self.infinity = infinity

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return _vectors.betti_curve(dgm, self.grids_[place])

    def _endings(self) -> list[str]:
        return [f"betti{i}" for i in range(self._count)]


class Entropy(_Vectoriser):
    """The persistent entropy of each diagram, in nats [Chintakunta et al. 2015].

    The entropy of the shares that bars have in the sum of their lengths; 0 without bars.

    Parameters
    ----------
    infinity : {"error", "drop"} or float
        What a bar that never dies is: an error, left out, or one that dies at this value.

    Examples
    --------
    >>> ph.sklearn.Entropy().fit_transform([[[0, 1], [0, 1]], [[0, 5]]]).round(4)
    array([[0.6931],
           [0.    ]])
    """

    def __init__(self, infinity: float | str = "error") -> None:
        self.infinity = infinity

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return _vectors.entropy(dgm)

    def _endings(self) -> list[str]:
        return ["entropy"]


class Lengths(_Vectoriser):
    """The largest lengths of bars, descending; 0 where there are no more bars.

    Parameters
    ----------
    count : int
        How many of each diagram.
    infinity : {"error", "drop"} or float
        What a bar that never dies is: an error, left out, or one that dies at this value.

    Examples
    --------
    >>> ph.sklearn.Lengths(count=2).fit_transform([[[0, 1], [1, 4]], [[0, 2]]])
    array([[3., 1.],
           [2., 0.]])
    """

    def __init__(self, count: int = 5, infinity: float | str = "error") -> None:
        self.count = count
        self.infinity = infinity

    def _fit_columns(self, columns: Sequence[list[Diagram]]) -> None:
        self._count = _options.whole("count", self.count, 1, 2**30)

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return _vectors.longest(dgm, self._count)

    def _endings(self) -> list[str]:
        return [f"length{i}" for i in range(self._count)]
