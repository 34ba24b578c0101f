# SPDX-License-Identifier: MIT
"""Differences between scikit-learn 1.2 and later versions."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from sklearn.base import BaseEstimator
from sklearn.utils._set_output import _get_output_config

from .. import _options
from .._errors import UsageError

try:
    from sklearn.utils.validation import validate_data as _validate_data  # 1.6
    _FINITE = "ensure_all_finite"
except ImportError:
    def _validate_data(estimator: Any, X: Any, **how: Any) -> Any:
        return estimator._validate_data(X, **how)
    _FINITE = "force_all_finite"


def table_of(estimator: BaseEstimator, X: Any, reset: bool, *, are_finite: bool = True,
             may_be_sparse: bool = False) -> Any:
    """The rows of one cloud; `reset` is True for the cloud to which the estimator is fitted.
    `are_finite` is False if NaN and infinite numbers are allowed."""
    return _validate_data(estimator, X, dtype=np.float64, reset=reset,
                          accept_sparse=["csr"] if may_be_sparse else False,
                          **{_FINITE: are_finite})


class MakesTables:
    """`set_output` for transformers of lists.

    `set_output` of scikit-learn 1.2 fails for lists, because it mistakes their method `index` for
    row names. Moreover, pandas would take diagrams apart.
    """

    def __init_subclass__(cls, **how: Any) -> None:
        super().__init_subclass__(**{"auto_wrap_output_keys": None, **how})

    def get_feature_names_out(self, input_features: Any = None) -> NDArray[np.object_]:
        """Names of the columns."""
        raise NotImplementedError

    def set_output(self, *, transform: str | None = None) -> Any:
        """Sets the kind of table that `transform` returns.

        Parameters
        ----------
        transform : {"default", "pandas"}, optional
            "pandas": a DataFrame with the columns of `get_feature_names_out`, whose cells are
            numbers, diagrams or barcodes.

        Returns
        -------
        self
        """
        if transform is not None:
            _options.choice("transform", transform, ["default", "pandas"])
            self._sklearn_output_config = {"transform": transform}
        return self

    def _in_table(self, X: Any, rows: Any) -> Any:
        """The rows, or the DataFrame that `set_output` requested."""
        kind = _get_output_config("transform", self)["dense"]
        if kind == "default":
            return rows
        if kind != "pandas":  # the choice of set_config
            raise _options.refuse("transform_output", kind, "'default' or 'pandas'")
        import pandas
        index = X.index if hasattr(X, "iloc") else None
        return pandas.DataFrame(_as_cells(rows), index, self.get_feature_names_out())


def _as_cells(rows: Any) -> Any:
    if isinstance(rows, np.ndarray):
        return rows
    rows = [row if isinstance(row, list) else [row] for row in rows]
    cells = np.empty((len(rows), max(map(len, rows), default=0)), dtype=object)
    for place in np.ndindex(cells.shape):
        cells[place] = rows[place[0]][place[1]]
    return cells


class TakesLists(BaseEstimator):
    """An estimator for lists of clouds, images or diagrams, to which the checks for tables do not
    apply."""

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
