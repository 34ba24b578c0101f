# SPDX-License-Identifier: MIT
"""What scikit-learn 1.2 and later ones want said in different words."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from sklearn.base import BaseEstimator

from .._errors import UsageError

try:
    from sklearn.utils.validation import validate_data as _validate_data  # 1.6
except ImportError:
    def _validate_data(estimator: Any, X: Any, **how: Any) -> Any:
        return estimator._validate_data(X, **how)


def table_of(estimator: BaseEstimator, X: Any, reset: bool) -> NDArray[np.float64]:
    """The rows of one cloud; `reset`: it is the one that the estimator is fitted to."""
    return _validate_data(estimator, X, dtype=np.float64, reset=reset)


class TakesLists(BaseEstimator):
    """An estimator of lists of clouds, images or diagrams: no table, and nothing to fit to it."""

    def _more_tags(self) -> dict[str, Any]:
        return {"X_types": ["3darray"], "stateless": True, "requires_fit": False}

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.input_tags.two_d_array = False
        tags.input_tags.three_d_array = True
        tags.requires_fit = False
        return tags


class TakesDiagrams(BaseEstimator):
    """An estimator that is fitted to a list of diagrams."""

    def _more_tags(self) -> dict[str, Any]:
        return {"X_types": ["3darray"]}

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.input_tags.two_d_array = False
        tags.input_tags.three_d_array = True
        return tags


def neighbours_wanted(k: int, count: int) -> None:
    """Refuses more neighbours than there are points."""
    if k > count:
        raise UsageError(f"k: found {k}, expected at most the number of points, n_samples = {count}")
