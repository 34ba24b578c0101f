# SPDX-License-Identifier: MIT
"""Distances of barcodes."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _options, _run
from ._barcodes import Barcode
from ._errors import UsageError

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._run import RunOptions


@overload
def bottleneck(  # type: ignore[misc]  # a Barcode is array_like, too: the first that fits counts
        a: Barcode, b: Barcode, dim: None = None, **run: Unpack[RunOptions]
        ) -> dict[int, float]: ...
@overload
def bottleneck(a: ArrayLike, b: ArrayLike, dim: int | None = None, **run: Unpack[RunOptions]
               ) -> float: ...


def bottleneck(a: Any, b: Any, dim: int | None = None, **run: Unpack[RunOptions]
               ) -> float | dict[int, float]:
    """The bottleneck distance of two barcodes, exact.

    Bars that never die are paired with such bars only; where their numbers differ the distance is
    inf.

    Parameters
    ----------
    a, b : Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    dim : int, optional
        Of two barcodes: the dimension to compare. Default: each.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    float or dict of int to float
        Of two barcodes without `dim` the distance in each dimension.

    Examples
    --------
    >>> ph.bottleneck([[0, 1.5]], [[0, 1.25]])
    0.25
    """
    _run.check_names("bottleneck", run, bottleneck)
    are_barcodes = isinstance(a, Barcode), isinstance(b, Barcode)
    if all(are_barcodes) and dim is None:
        return {d: _distance(a.dgm(d), b.dgm(d), run)
                for d in range(max(a._top_dim, b._top_dim) + 1)}
    if dim is None and any(are_barcodes):
        raise UsageError("dim: found None, expected the dimension of the bars that the array holds")
    if dim is not None and not any(are_barcodes):
        raise UsageError("dim: does nothing for arrays, expected a Barcode")
    return _distance(_rows(a, "a", dim), _rows(b, "b", dim), run)


def _rows(bars: Any, name: str, dim: int | None) -> NDArray[np.float64]:
    if isinstance(bars, Barcode):
        return bars.dgm(_options.whole("dim", dim, 0))
    if isinstance(bars, (list, tuple)):
        for row in bars:
            if isinstance(row, np.ndarray) and row.ndim == 2:
                raise UsageError(f"{name}: found a list of arrays, expected one of rows birth, "
                                 f"death; {name}[1] are those of H1")
            if isinstance(row, tuple) and len(row) == 2 and isinstance(row[1], tuple):
                raise UsageError(f"{name}: found pairs (dimension, (birth, death)), expected rows "
                                 "birth, death, of one dimension")
    array = _arrays.as_array(bars, name)
    if array.size == 0:
        return np.empty((0, 2))
    if array.ndim != 2 or array.shape[1] != 2:
        raise UsageError(f"{name}: found an array of shape {array.shape}, expected rows birth, "
                         "death")
    return _arrays.as_float64(array, name)


def _distance(a: NDArray[np.float64], b: NDArray[np.float64], run: Any) -> float:
    return float(_run.run(_core.bottleneck, a, b, options=dict(run)))
