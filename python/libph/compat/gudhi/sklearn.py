# SPDX-License-Identifier: MIT
"""GUDHI's classes for scikit-learn, which turn lists of clouds or images into lists of diagrams."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from joblib import effective_n_jobs
from numpy.typing import NDArray
from sklearn.base import BaseEstimator, TransformerMixin

from ... import _arrays, _options
from ..._barcodes import Barcode
from ..._batch import computed
from ..._compute import cubical, rips
from ..._errors import UsageError
from .. import _missing
from .._flag import ordered

__all__ = ["CubicalPersistence", "RipsPersistence"]
__path__: list[str] = []  # like a package; `import gudhi.sklearn.cech_persistence` gets a hint

_RIPS_INPUTS = ["point cloud", "full distance matrix", "lower distance matrix",
                "distance coo_matrix"]


def __getattr__(name: str) -> Any:
    return _missing.attribute(__name__, name, __all__)


class _DiagramsOfEach(TransformerMixin, BaseEstimator):
    """Computes the diagrams of samples, each on one of several threads."""

    homology_dimensions: int | Sequence[int]
    homology_coeff_field: int
    n_jobs: int | None
    _function: Callable[..., Barcode]

    def fit(self, X: Any, y: Any = None, Y: Any = None) -> Any:
        """Checks the parameters; there is nothing to learn. `Y` is GUDHI's name for `y`."""
        self._dims()
        return self

    def transform(self, X: Any, y: Any = None, Y: Any = None) -> list[Any]:
        """The diagrams of each sample: one, or a list if `homology_dimensions` is a list."""
        dims = self._dims()
        bars = computed(self._function, [self._input(x) for x in X], {
            **self._keywords(), "max_dim": max(dims), "field": self.homology_coeff_field,
            "threads": effective_n_jobs(self.n_jobs)}, "sample")
        found: list[Any] = [[self._in_order(b.dgm(dim), dim) for dim in dims] for b in bars]
        return [dgms[0] for dgms in found] if np.ndim(self.homology_dimensions) == 0 else found

    def _dims(self) -> list[int]:
        if np.ndim(self.homology_dimensions) > 1 or np.size(self.homology_dimensions) == 0:
            raise _options.refuse("homology_dimensions", self.homology_dimensions,
                                  "a dimension, or a list of some")
        return [_options.whole("homology_dimensions", dim, 0)
                for dim in np.atleast_1d(np.asarray(self.homology_dimensions)).tolist()]

    def _input(self, x: Any) -> Any:
        """The arguments of the function that computes the barcode of a sample."""
        raise NotImplementedError

    def _keywords(self) -> dict[str, Any]:
        raise NotImplementedError

    def _in_order(self, dgm: NDArray[np.float64], dim: int) -> NDArray[np.float64]:
        """The bars of a dimension, in Ripser's order."""
        return np.asarray(dgm[ordered(dgm, dim)])

    def get_feature_names_out(self, input_features: Any = None) -> list[str]:
        """Names of columns: H0, H1, ..."""
        return [f"H{dim}" for dim in self._dims()]


@_options.with_hints
class RipsPersistence(_DiagramsOfEach):
    """Diagrams of Rips filtrations.

    Parameters
    ----------
    homology_dimensions : int or list of int
        With one dimension, each sample has a diagram; with a list, a list of diagrams.
    threshold : float
        The largest distance at which points are joined; not for a "distance coo_matrix".
    input_type : {"point cloud", "full distance matrix", "lower distance matrix", \
"distance coo_matrix"}
        The kind of each sample. The upper triangle of a lower matrix is not read; a sparse matrix
        contains each pair once.
    num_collapses : int or "auto"
        0: edges are not collapsed; above 0: they are.
    homology_coeff_field : int
        A prime.
    n_jobs : int, optional
        Number of samples processed at a time, as in joblib.
    """

    _function = staticmethod(rips)

    def __init__(self, homology_dimensions: int | Sequence[int] = 0, threshold: float = np.inf,
                 input_type: str = "point cloud", num_collapses: int | str = "auto",
                 homology_coeff_field: int = 11, n_jobs: int | None = None) -> None:
        self.homology_dimensions = homology_dimensions
        self.threshold = threshold
        self.input_type = input_type
        self.num_collapses = num_collapses
        self.homology_coeff_field = homology_coeff_field
        self.n_jobs = n_jobs

    def _input(self, x: Any) -> Any:
        if self.input_type == "point cloud":
            return _arrays.as_points(x)
        return _lower(x) if self.input_type == "lower distance matrix" else x

    def _keywords(self) -> dict[str, Any]:
        kind = _options.choice("input_type", self.input_type, _RIPS_INPUTS)
        keywords: dict[str, Any] = {}
        if kind != "distance coo_matrix" and self.threshold != np.inf:
            keywords["threshold"] = self.threshold
        if kind != "point cloud":
            keywords["metric"] = "precomputed"
        if self.num_collapses != "auto":
            keywords["collapse"] = _options.whole("num_collapses", self.num_collapses, 0) > 0
        return keywords


def _lower(x: Any) -> NDArray[np.float64]:
    """A square matrix from a lower triangle, or from its rows."""
    n = len(x)
    square = np.zeros((n, n))
    for i in range(n):
        if len(x[i]) < i:
            raise UsageError(f"X: row {i}: found {len(x[i])} numbers, expected at least {i}")
        square[i, :i] = x[i][:i]
    return square + square.T


@_options.with_hints
class CubicalPersistence(_DiagramsOfEach):
    """Diagrams of images.

    Parameters
    ----------
    homology_dimensions : int or list of int
        With one dimension, each sample has a diagram; with a list, a list of diagrams.
    input_type : {"top_dimensional_cells", "vertices"}
        The cells that the values belong to.
    homology_coeff_field : int
        A prime.
    min_persistence : float
        Bars with death - birth <= this value are left out; a negative value keeps all bars.
    n_jobs : int, optional
        Number of samples processed at a time, as in joblib.
    """

    _function = staticmethod(cubical)

    def __init__(self, homology_dimensions: int | Sequence[int] = 0,
                 input_type: str = "top_dimensional_cells", homology_coeff_field: int = 11,
                 min_persistence: float = 0.0, n_jobs: int | None = None) -> None:
        self.homology_dimensions = homology_dimensions
        self.input_type = input_type
        self.homology_coeff_field = homology_coeff_field
        self.min_persistence = min_persistence
        self.n_jobs = n_jobs

    def _input(self, x: Any) -> Any:
        return _arrays.as_image(x, "X")

    def _keywords(self) -> dict[str, Any]:
        kind = _options.choice("input_type", self.input_type, ["top_dimensional_cells", "vertices"])
        return {"construction": "vertices" if kind == "vertices" else "cells", "cells": False,
                "min_persistence": self.min_persistence}

    def _in_order(self, dgm: NDArray[np.float64], dim: int) -> NDArray[np.float64]:
        """Sorted by death, as in GUDHI."""
        return super()._in_order(dgm, 0)
