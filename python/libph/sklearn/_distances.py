# SPDX-License-Identifier: MIT
"""Distances of lists of diagrams. What is computed stands in `libph._distances`."""
from __future__ import annotations

import math
from typing import Any

import numpy as np
from joblib import effective_n_jobs
from numpy.typing import NDArray
from sklearn.base import TransformerMixin
from sklearn.utils.validation import check_is_fitted

from .. import _distances, _options
from .._errors import UsageError
from ._base import MakesTables, TakesDiagrams
from ._diagrams import Samples, samples_of


class DiagramDistances(MakesTables, TransformerMixin, TakesDiagrams):
    """The distances of diagrams from those that it was fitted to.

    Where a sample has several diagrams, a norm makes one number of their distances.

    Parameters
    ----------
    distance : {"wasserstein", "bottleneck", "sliced_wasserstein"}
        Which distance; see `libph.wasserstein`, `libph.bottleneck`, `libph.sliced_wasserstein`.
    order, ground : float
        Of "wasserstein".
    relative_error : float
        Of "wasserstein" and "bottleneck": how much too large a distance may be.
    directions : int
        Of "sliced_wasserstein".
    norm : float
        Of several diagrams of a sample: 1 adds their distances, 2 takes the root of the sum of
        squares, inf the largest.
    n_jobs : int, optional
        Threads, as scikit-learn counts them. Default: one.

    Attributes
    ----------
    n_features_in_ : int
        How many diagrams a sample has.

    Examples
    --------
    >>> train, test = [[[0, 1]], [[0, 4]]], [[[0, 3]]]
    >>> ph.sklearn.DiagramDistances("bottleneck").fit(train).transform(test)
    array([[1.5, 1. ]])
    """

    def __init__(self, distance: str = "wasserstein", order: float = 1.0, ground: float = math.inf,
                 relative_error: float = 0.0, directions: int = 50, norm: float = 2.0,
                 n_jobs: int | None = None) -> None:
        self.distance = distance
        self.order = order
        self.ground = ground
        self.relative_error = relative_error
        self.directions = directions
        self.norm = norm
        self.n_jobs = n_jobs

    def fit(self, X: Any, y: Any = None) -> Any:
        """Keeps the diagrams.

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
        self._fitted = samples
        self.n_features_in_ = len(samples.rows[0])
        return self

    def transform(self, X: Any) -> Any:
        """The distances of each sample from each of those that were fitted.

        Parameters
        ----------
        X : list
            An entry for each sample, as of `PersistenceImage.transform`.

        Returns
        -------
        ndarray or DataFrame
            A row for each sample, a column for each of those that were fitted.
        """
        check_is_fitted(self, "n_features_in_")
        samples = samples_of(X)
        if samples.rows and len(samples.rows[0]) != self.n_features_in_:
            raise UsageError(f"X: found {len(samples.rows[0])} diagrams for each sample, expected "
                             f"{self.n_features_in_} as in the samples that were fitted")
        return self._in_table(X, self._all(samples, self._fitted))

    def fit_transform(self, X: Any, y: Any = None, **fit_params: Any) -> Any:
        """The distances of all pairs; each is computed once.

        Parameters
        ----------
        X : list
            As of `transform`.
        y : None

        Returns
        -------
        ndarray or DataFrame
            Square.
        """
        self.fit(X, y)
        return self._in_table(X, self._all(self._fitted, None))

    def get_feature_names_out(self, input_features: Any = None) -> NDArray[np.object_]:
        """Names of the columns.

        Parameters
        ----------
        input_features : None

        Returns
        -------
        ndarray of str
        """
        check_is_fitted(self, "n_features_in_")
        return np.array([f"sample{i}" for i in range(len(self._fitted.rows))], dtype=object)

    def _all(self, samples: Samples, others: Samples | None) -> NDArray[np.float64]:
        norm = _options.real("norm", self.norm, "a number, at least 1, or inf", 1)
        of_diagrams = [
            _distances.diagram_distances(
                [row[k] for row in samples.rows],
                None if others is None else [row[k] for row in others.rows],
                distance=self.distance, order=self.order, ground=self.ground,
                relative_error=self.relative_error, directions=self.directions,
                threads=effective_n_jobs(self.n_jobs))
            for k in range(self.n_features_in_)]
        result: NDArray[np.float64] = np.linalg.norm(of_diagrams, norm, axis=0)
        return result
