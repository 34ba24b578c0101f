# SPDX-License-Identifier: MIT
"""Matchings between the bars of two diagrams."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core, _results, _run
from .._barcodes import Barcode
from ._diagrams import two_diagrams
from ._metric import metric_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from typing_extensions import Unpack

    from .._run import RunOptions


@dataclass(frozen=True, eq=False, repr=False)
class Matching:
    """A matching between two diagrams; see `bottleneck_matching`, `wasserstein_matching`.

    Attributes
    ----------
    distance : float
        The cost of the matching: the distance between the diagrams, or a larger number within the
        requested error.
    lower : float
        A lower bound for the distance.
    pairs : ndarray
        Rows (i, j): bar i of `a` is paired with bar j of `b`; -1 is the diagonal. Each bar is in
        one row. Empty if the distance is infinite.
    order : float
        p, see `wasserstein`; inf for the bottleneck distance.
    ground : float
        q, see `wasserstein`; inf for the bottleneck distance.
    a : ndarray
        The first diagram, rows birth, death.
    b : ndarray
        The second diagram.
    """

    distance: float
    lower: float
    pairs: NDArray[np.int64]
    order: float
    ground: float
    a: NDArray[np.float64]
    b: NDArray[np.float64]

    def __repr__(self) -> str:
        return _results.in_brief(self)

    def plot(self, ax: Axes | None = None, **style: Any) -> Axes:
        """Draws both diagrams, and a line for each pair, with matplotlib.

        Parameters
        ----------
        ax : Axes, optional
            The axes to draw on. Default: the axes of a new figure.
        **style
            Style of the lines, for matplotlib's LineCollection.

        Returns
        -------
        Axes
        """
        from .._barcodes._plots import plot_matching
        return plot_matching(self.a, self.b, self.pairs, ax, style)


def bottleneck_matching(a: Barcode | ArrayLike, b: Barcode | ArrayLike, dim: int | None = None,
                        **run: Unpack[RunOptions]) -> Matching:
    """The matching that attains the bottleneck distance.

    Parameters
    ----------
    a, b : Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    dim : int, optional
        For barcodes: the dimension.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Matching

    Examples
    --------
    >>> ph.bottleneck_matching([[0, 4], [1, 1.5]], [[0, 5]]).pairs
    array([[ 0,  0],
           [ 1, -1]])
    """
    _run.check_names("bottleneck_matching", run, bottleneck_matching)
    return _matching(a, b, dim, "bottleneck", math.inf, math.inf, 0.0, run)


def wasserstein_matching(a: Barcode | ArrayLike, b: Barcode | ArrayLike, dim: int | None = None, *,
                         order: float = 1.0, ground: float = math.inf, relative_error: float = 0.0,
                         **run: Unpack[RunOptions]) -> Matching:
    """The matching that attains the Wasserstein distance.

    Parameters
    ----------
    a, b : Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    dim : int, optional
        For barcodes: the dimension.
    order, ground, relative_error : float
        As in `wasserstein`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Matching

    Examples
    --------
    >>> matching = ph.wasserstein_matching([[0, 4], [1, 1.5]], [[0, 5], [7, 9]], order=2)
    >>> matching.pairs
    array([[ 0,  0],
           [ 1, -1],
           [-1,  1]])
    """
    _run.check_names("wasserstein_matching", run, wasserstein_matching)
    return _matching(a, b, dim, "wasserstein", order, ground, relative_error, run)


def _matching(a: Any, b: Any, dim: int | None, kind: str, order: float, ground: float,
              relative_error: float, run: Any) -> Matching:
    rows_a, rows_b = two_diagrams(a, b, dim)
    metric = metric_of(kind, order, ground, relative_error)
    value, lower, pairs = _run.run(_core.matching, rows_a, rows_b, metric, options=dict(run))
    # Copies, so that the matching does not change with the caller's arrays.
    return Matching(value, lower, np.asarray(pairs), float(order), float(ground), np.array(rows_a),
                    np.array(rows_b))
