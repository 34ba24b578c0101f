# SPDX-License-Identifier: MIT
"""The methods of GUDHI's complexes that compute and return bars."""
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ... import _core, _options
from ..._barcodes import Barcode
from ..._errors import UsageError


class _OrderError(UsageError, RuntimeError):
    """GUDHI raises RuntimeError if nothing has been computed yet."""


@_options.with_hints
class Persistence:
    """Keeps the computed bars, and returns them in the forms of GUDHI."""

    _bars: _core.Bars | None = None
    _dims = 0
    _above: NDArray[np.float64] | None = None

    def _keep(self, bars: _core.Bars, dims: int, above: NDArray[np.float64] | None = None) -> None:
        """Stores the bars of this many dimensions. `above` holds the births of the bars of the last
        dimension, which never die."""
        self._bars, self._dims, self._above = bars, dims, above

    def _is_persistence_defined(self) -> bool:
        return self._bars is not None

    def _barcode(self, asked: str) -> Barcode:
        if self._bars is None:
            raise _OrderError(f"{asked}: compute_persistence() must be called first")
        return Barcode._of(self._bars, {})

    def _order(self, dim: int) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
        """The order of the bars of a dimension (by death, or by birth if they never die), and which
        of them die."""
        births, deaths = self._barcode("order").dgm(dim).T
        order = np.lexsort((births, deaths))
        return order, deaths[order] < np.inf

    def _dgm(self, dim: int) -> NDArray[np.float64]:
        if self._above is not None and dim == self._dims - 1:
            return np.column_stack([self._above, np.full(len(self._above), np.inf)])
        return self._barcode("dgm").dgm(dim)[self._order(dim)[0]]

    def _listed(self) -> list[tuple[int, tuple[float, float]]]:
        assert self._bars is not None
        bars = _core.listed(self._bars)
        if self._above is None:
            return bars
        return [*((self._dims - 1, (birth, np.inf)) for birth in self._above.tolist()), *bars]

    def persistence_intervals_in_dimension(self, dimension: int) -> NDArray[np.float64]:
        """The bars of a dimension: rows birth, death, sorted by death."""
        self._barcode("persistence_intervals_in_dimension")
        if not 0 <= _options.whole("dimension", dimension, -2**31) < self._dims:
            return np.empty((0, 2))
        return self._dgm(dimension)

    def betti_numbers(self) -> list[int]:
        """The number of bars of each dimension that never die."""
        self._barcode("betti_numbers")
        return [int((self._dgm(dim)[:, 1] == np.inf).sum()) for dim in range(self._dims)]

    def persistent_betti_numbers(self, from_value: float, to_value: float) -> list[int]:
        """The number of bars of each dimension that are born at or before `from_value` and die
        after `to_value` or never."""
        self._barcode("persistent_betti_numbers")
        born = _options.real("from_value", from_value)
        alive = _options.real("to_value", to_value)
        counts = []
        for dgm in map(self._dgm, range(self._dims)):
            lives = (dgm[:, 1] > alive) | (dgm[:, 1] == np.inf)
            counts.append(int(((dgm[:, 0] <= born) & lives).sum()))
        return counts
