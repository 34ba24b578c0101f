# SPDX-License-Identifier: MIT
"""Reads lists of diagrams in all their layouts."""
from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from .. import _arrays
from .._barcodes import Barcode
from .._errors import UsageError
from .._vectors import Diagram, as_diagram

_EXPECTED = ("expected a list with an entry for each sample: a diagram, a list of diagrams or a "
             "Barcode; or an array (samples, bars, 3) of rows (birth, death, dimension)")


class Samples(NamedTuple):
    """Diagrams, the same number for each sample."""

    rows: list[list[Diagram]]
    names: list[str]  # names of the diagrams of a sample


def samples_of(X: Any) -> Samples:
    """Reads diagrams from any `output` of `RipsPersistence`, from a table of diagrams, and from
    lists of arrays."""
    if hasattr(X, "columns") and hasattr(X, "iloc"):
        found = _rows_of([list(row) for row in X.itertuples(index=False)])
        if found.names[:1] == ["dgm0"]:
            return Samples(found.rows, [str(name) for name in X.columns])
        return found
    if isinstance(X, np.ndarray) and X.dtype != object:
        return _of_giotto(X)
    if isinstance(X, (str, bytes, dict, Barcode)) or not isinstance(X, Iterable):
        raise UsageError(f"X: found {type(X).__name__}, {_EXPECTED}")
    return _rows_of(list(X))


def samples_like(fitted: Sequence[str], X: Any) -> Samples:
    """Samples with the same diagrams as the fitted samples, whose names are given.

    Lists of arrays have no names, but must have the same number of diagrams.
    """
    samples = samples_of(X)
    if not samples.rows:
        return samples
    if len(samples.names) != len(fitted):
        raise UsageError(f"X: found {len(samples.names)} diagrams for each sample, expected "
                         f"{len(fitted)} as in the fitted samples")
    if list(fitted) != samples.names and "dgm0" not in (fitted[0], samples.names[0]):
        raise UsageError(f"X: found diagrams {', '.join(samples.names)}, expected "
                         f"{', '.join(fitted)}, in the order of the fitted samples")
    return samples


def without_component(dgm: Diagram) -> str:
    """The option that leaves out the only bar that never dies, if it is born first, as a component
    is; otherwise an empty text."""
    endless = np.isinf(dgm[:, 1])
    if np.count_nonzero(endless) != 1 or dgm[endless, 0] > dgm[:, 0].min():
        return ""
    return ("reduced=True of the estimator that found the bars leaves out the component that never "
            "dies")


def _rows_of(samples: Sequence[Any]) -> Samples:
    samples = [sample[0] if isinstance(sample, (list, tuple)) and len(sample) == 1
               and isinstance(sample[0], Barcode) else sample for sample in samples]
    if samples and all(isinstance(sample, Barcode) for sample in samples):
        count = 1 + max(bars._top_dim for bars in samples)
        rows = [[as_diagram(bars.dgm(dim), f"sample {i}, H{dim}") for dim in range(count)]
                for i, bars in enumerate(samples)]
        return Samples(rows, [f"H{dim}" for dim in range(count)])
    rows = []
    split = [_parts_of(sample) for sample in samples]
    are_diagrams = any(parts is None for parts in split)
    for i, (sample, parts) in enumerate(zip(samples, split)):
        if parts is None or (are_diagrams and not parts):  # among diagrams, [] is an empty diagram
            rows.append([as_diagram(sample, f"sample {i}")])
        else:
            rows.append([as_diagram(part, f"sample {i}, diagram {j}")
                         for j, part in enumerate(parts)])
        if len(rows[i]) != len(rows[0]):
            raise UsageError(f"X: sample {i}: found {len(rows[i])} diagrams, expected "
                             f"{len(rows[0])} as in sample 0")
    if rows and not rows[0]:
        raise UsageError("X: found samples without diagrams, expected at least one; a diagram "
                         "without bars is an array of shape (0, 2)")
    return Samples(rows, [f"dgm{j}" for j in range(len(rows[0]) if rows else 0)])


def _parts_of(sample: Any) -> Sequence[Any] | None:
    """The diagrams of a sample; None if the sample is itself a diagram."""
    if isinstance(sample, Barcode):
        raise UsageError("X: found barcodes and arrays, expected one of the two")
    if isinstance(sample, np.ndarray):
        return list(sample) if sample.dtype == object and sample.ndim == 1 else None
    if not isinstance(sample, (list, tuple)):
        return None
    # A list of pairs of numbers is a diagram.
    return None if sample and all(map(_is_pair, sample)) else sample


def _is_pair(part: Any) -> bool:
    try:
        return not isinstance(part, np.ndarray) and np.ndim(part) == 1 and len(part) == 2
    except ValueError:  # lists of different lengths; the reader will report the problem
        return False


def _of_giotto(X: Any) -> Samples:
    array = _arrays.as_array(X, "X")
    if array.ndim != 3 or array.shape[2] != 3:
        raise UsageError(f"X: found an array of shape {array.shape}, {_EXPECTED}")
    numbers = _arrays.as_float64(array, "X")
    dims = np.unique(numbers[:, :, 2])
    if len(array) and not len(dims):
        raise UsageError(f"X: found an array of shape {array.shape}, expected at least one bar of "
                         "each dimension; a bar of length 0 stands for no bar")
    if not (dims == np.floor(dims)).all() or (dims < 0).any():
        raise UsageError(f"X: found dimensions {dims}, expected whole numbers from 0 on")
    # Bars of length 0 are padding.
    is_bar = numbers[:, :, 0] != numbers[:, :, 1]
    rows = [[as_diagram(row[(row[:, 2] == dim) & kept][:, :2], f"sample {i}, H{int(dim)}")
             for dim in dims] for i, (row, kept) in enumerate(zip(numbers, is_bar))]
    return Samples(rows, [f"H{int(dim)}" for dim in dims])
