# SPDX-License-Identifier: MIT
"""The common base of transformers from diagrams to vectors; `libph._vectors` computes the
vectors."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from sklearn.base import TransformerMixin
from sklearn.utils.validation import check_is_fitted

from .. import _arrays
from .._errors import UsageError
from .._vectors import Diagram, Range, checked_infinity, settled
from .._vectors._ranges import checked_range
from ._base import MakesTables, TakesDiagrams
from ._diagrams import Samples, samples_like, samples_of, without_component


class Vectoriser(MakesTables, TransformerMixin, TakesDiagrams):
    """The common base of transformers from diagrams to vectors."""

    _may_keep = False
    infinity: Any

    def fit(self, X: Any, y: Any = None) -> Any:
        """Learns the number of diagrams of a sample, and the ranges that are not given.

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
        samples = samples_of(X)
        if not samples.rows:
            raise UsageError("X: found no samples, expected at least one")
        columns = [list(column) for column in zip(*self._settled(samples))]
        self.n_features_in_ = len(columns)
        self._check()
        self._diagram_names = samples.names
        self._fit_columns(columns)
        return self

    def transform(self, X: Any) -> Any:
        """The vector of each sample.

        Parameters
        ----------
        X : list
            An entry for each sample: a diagram, which is an array of rows birth, death; a list of
            diagrams, one for each dimension; or a `libph.Barcode`. Alternatively an array (samples,
            bars, 3) of rows birth, death, dimension, in which bars of length 0 are ignored; or a
            pandas DataFrame whose cells are diagrams.

        Returns
        -------
        ndarray or DataFrame
            One row per sample: the features of its first diagram, then of its second, and so on.
        """
        check_is_fitted(self, "n_features_in_")
        self._check()
        samples = samples_like(self._diagram_names, X)
        vectors = _arrays.new_array((len(samples.rows), self._n_features_out))
        for i, row in enumerate(self._settled(samples)):
            vectors[i] = np.concatenate([np.ravel(self._vector(dgm, j)) for j, dgm in enumerate(row)])
        return self._in_table(X, vectors)

    def get_feature_names_out(self, input_features: Any = None) -> NDArray[np.object_]:
        """Names of the columns.

        Parameters
        ----------
        input_features : sequence of str, optional
            Names of the diagrams of a sample. Default: H0, H1, ... for barcodes and arrays with
            dimensions, the columns of a table, and dgm0, dgm1, ... otherwise.

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
        """The diagrams, with bars that never die treated as `infinity` specifies."""
        rule = checked_infinity(self.infinity, self._may_keep)
        return [[settled(dgm, rule, f"sample {i}, {name}", without_component)
                 for dgm, name in zip(row, samples.names)] for i, row in enumerate(samples.rows)]

    def _check(self) -> None:
        """Checks the parameters that `transform` reads, because they may have changed since
        `fit`."""

    def _fit_columns(self, columns: list[list[Diagram]]) -> None:
        """Learns parameters from the diagrams at each place in a sample."""

    def _vector(self, dgm: Diagram, place: int) -> Any:
        raise NotImplementedError

    def _endings(self) -> list[str]:
        """The names of the features of one diagram."""
        raise NotImplementedError


def ranges_of(name: str, given: Any, count: int) -> list[Range | None]:
    """A range for each place, from None, one range for all, or a list with one range or None per
    place."""
    if given is None:
        return [None] * count
    items = list(given) if isinstance(given, (list, tuple, np.ndarray)) else [given]
    if any(item is None or np.ndim(item) == 1 for item in items):
        if len(items) != count:
            raise UsageError(f"{name}: found {len(items)} ranges, expected {count}, one for each "
                             "diagram of a sample")
        return [None if item is None else checked_range(name, item) for item in items]
    return [checked_range(name, given)] * count
