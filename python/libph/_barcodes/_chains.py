# SPDX-License-Identifier: MIT
"""Representatives of bars: cycles, cocycles, and the loops that make up cycles."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import _core, _options
from .._errors import UsageError
from .._results import in_brief, require_version, with_arrays

_STATE_VERSION = 1


class Loop(NamedTuple):
    """A closed walk along edges; the last vertex is joined to the first.

    Attributes
    ----------
    vertices : ndarray
        Indices of points, in order; for images, doubled grid coordinates, one row per vertex.
    coefficient : int
        How often the walk counts in the chain.
    length : float or None
        The sum of the values of its edges, if these values are lengths.
    """

    vertices: NDArray[np.int64]
    coefficient: int
    length: float | None

    def __repr__(self) -> str:
        return in_brief(self)


@_options.with_hints
class Chain:
    """A cycle or cocycle: cells of the input, each with its coefficient.

    Attributes
    ----------
    cells : ndarray
        One row per cell: its vertices, ascending; for images, its doubled grid coordinates.
    coefficients : ndarray
        Between -p/2 and p/2; always 1 over Z/2.
    """

    __slots__ = ("_bars", "_found", "_i", "cells", "coefficients")

    def __init__(self, bars: _core.Bars, i: int) -> None:
        cells, coefficients = bars.chain(i)
        self.cells: NDArray[np.int64] = np.asarray(cells)
        self.coefficients: NDArray[np.int64] = np.asarray(coefficients)
        self._bars, self._i = bars, i
        self._found: tuple[list[Loop], str] | None = None

    def __len__(self) -> int:
        return len(self.coefficients)

    def __reduce__(self) -> tuple[Any, ...]:
        alone = self._bars.selected(np.array([self._i]))
        return (_restored, (_STATE_VERSION, with_arrays(alone.state())))

    def __repr__(self) -> str:
        return f"Chain({len(self)} cells)"

    def loops(self) -> list[Loop]:
        """The loops of a cycle of H1. Times their coefficients, they sum to a cycle of the class.

        Raises
        ------
        UsageError
            If the chain is not a cycle of edges.
        """
        return self._loops_found()[0]

    @property
    def tightness(self) -> str:
        """The guarantee about the length of the loops: "no", "locally" or "shortest"."""
        return self._loops_found()[1]

    def _loops_found(self) -> tuple[list[Loop], str]:
        if self._found is None:
            if self._bars.representatives == "cocycles":
                raise UsageError("loops: found a cocycle, expected a cycle, as "
                                 "representatives='cycles' gives")
            if self._bars.cell_kind == "row":
                raise UsageError("loops: found rows of a boundary matrix, expected edges with "
                                 "vertices")
            loops, tightness = self._bars.loops(self._i)
            of_points = self._bars.cell_kind == "vertices"
            self._found = [Loop(np.asarray(vertices)[:, 0] if of_points else np.asarray(vertices),
                                coefficient, length)
                           for vertices, coefficient, length in loops], tightness
        return self._found

    def loop(self) -> NDArray[np.int64]:
        """The vertices of the first loop, in order; most cycles have only one."""
        loops = self.loops()
        if not loops:
            raise UsageError("loop: found a chain without edges, expected a cycle of H1")
        return loops[0].vertices

    def to_dense(self, n: int) -> NDArray[np.int64]:
        """The chain as an array with one axis of length `n` for each vertex of a cell.

        The coefficient of the cell [u < v < ...] is at [u, v, ...].
        """
        if self._bars.cell_kind != "vertices":
            raise UsageError("to_dense: found cells of a grid or a matrix, expected vertices")
        least = int(self.cells.max()) + 1 if self.cells.size else 0
        dense = np.zeros((_options.whole("n", n, least),) * self.cells.shape[1], dtype=np.int64)
        dense[tuple(self.cells.T)] = self.coefficients
        return dense


def _restored(version: int, state: dict[str, Any]) -> Chain:
    """Called by pickle: the chain of a barcode of one bar."""
    require_version(version, _STATE_VERSION)
    return Chain(_core.Bars.from_state(state), 0)
