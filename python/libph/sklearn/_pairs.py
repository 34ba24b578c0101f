# SPDX-License-Identifier: MIT
"""Numbers for pairs of a given diagram and a fitted diagram."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from sklearn.base import TransformerMixin
from sklearn.utils.validation import check_is_fitted

from .._errors import UsageError
from ._base import MakesTables, TakesDiagrams
from ._diagrams import Samples, samples_like, samples_of


class BesideFitted(MakesTables, TransformerMixin, TakesDiagrams):
    """A transformer with one column for each fitted sample."""

    def fit(self, X: Any, y: Any = None) -> Any:
        """Keeps the diagrams.

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
        self._fitted = samples
        self.n_features_in_ = len(samples.rows[0])
        return self

    def transform(self, X: Any) -> Any:
        """The number for each pair of a sample and a fitted sample.

        Parameters
        ----------
        X : list
            An entry for each sample, as for `PersistenceImage.transform`.

        Returns
        -------
        ndarray or DataFrame
            One row per sample, one column per fitted sample.
        """
        check_is_fitted(self, "n_features_in_")
        samples = samples_like(self._fitted.names, X)
        return self._in_table(X, self._all(samples, self._fitted))

    def fit_transform(self, X: Any, y: Any = None, **fit_params: Any) -> Any:
        """The numbers for all pairs of fitted samples, each computed once.

        Parameters
        ----------
        X : list
            As in `transform`.
        y : None
            Not used; present because pipelines pass it.

        Returns
        -------
        ndarray or DataFrame
            One row and one column per fitted sample.
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
        raise NotImplementedError
