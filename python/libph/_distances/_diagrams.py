# SPDX-License-Identifier: MIT
"""The diagrams given by the caller, as rows birth, death."""
from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import _arrays, _options
from .._barcodes import Barcode
from .._errors import UsageError


def two_diagrams(a: Any, b: Any, dim: int | None
                  ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    are_barcodes = isinstance(a, Barcode), isinstance(b, Barcode)
    _check_dim(dim, any(are_barcodes), all(are_barcodes))
    return _rows(a, "a", dim), _rows(b, "b", dim)


def all_rows(name: str, diagrams: Iterable[Any], dim: int | None) -> list[NDArray[np.float64]]:
    """The rows of each diagram of a list; `name` is the name of the argument."""
    if isinstance(diagrams, (str, bytes, dict, Barcode)) or not isinstance(diagrams, Iterable):
        raise _options.refuse(name, diagrams, "a list of barcodes or diagrams")
    given = list(diagrams)
    are_barcodes = [isinstance(diagram, Barcode) for diagram in given]
    if given:
        _check_dim(dim, any(are_barcodes), all(are_barcodes))
    return [_rows(diagram, f"{name}[{i}]", dim) for i, diagram in enumerate(given)]


def _check_dim(dim: int | None, has_barcodes: bool, only_barcodes: bool) -> None:
    if dim is None and has_barcodes:
        raise UsageError("dim: found None, expected the dimension of the bars "
                         + ("to compare" if only_barcodes else "that the array holds"))
    if dim is not None and not has_barcodes:
        raise UsageError("dim: does nothing for arrays, expected a Barcode")


def _rows(bars: Any, name: str, dim: int | None) -> NDArray[np.float64]:
    if isinstance(bars, Barcode):
        return bars.dgm(_options.whole("dim", dim, 0))
    if isinstance(bars, (list, tuple)):
        for row in bars:
            if isinstance(row, np.ndarray) and row.ndim == 2:
                raise UsageError(f"{name}: found a list of arrays, expected one array of rows "
                                 f"(birth, death); {name}[1] has the rows of H1")
            if isinstance(row, tuple) and len(row) == 2 and isinstance(row[1], tuple):
                raise UsageError(f"{name}: found pairs (dimension, (birth, death)), expected rows "
                                 "(birth, death) of a single dimension")
    array = _arrays.as_array(bars, name)
    if array.size == 0:
        return np.empty((0, 2))
    if array.ndim != 2 or array.shape[1] != 2:
        raise UsageError(f"{name}: found an array of shape {array.shape}, expected rows "
                         "(birth, death)")
    return _arrays.as_float64(array, name)
