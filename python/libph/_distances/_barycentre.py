# SPDX-License-Identifier: MIT
"""Means of diagrams."""
from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core, _options, _results, _run
from .._barcodes import Barcode
from ._diagrams import all_rows

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .._run import RunOptions


class Barycentre(NamedTuple):
    """A mean of diagrams; see `barycentre`.

    Attributes
    ----------
    diagram : ndarray
        Rows birth, death, ascending.
    root_mean_square : float
        The root mean square of its distances to the diagrams.
    rounds : int
        Number of rounds that lowered the root mean square by more than `tolerance`.
    converged : bool
        True if the last round lowered it by no more than `tolerance`.
    """

    diagram: NDArray[np.float64]
    root_mean_square: float
    rounds: int
    converged: bool

    def __repr__(self) -> str:
        return _results.in_brief(self)


def barycentre(diagrams: Iterable[Barcode | ArrayLike], dim: int | None = None, *,
               max_rounds: int = 100, tolerance: float = 1e-6, **run: Unpack[RunOptions]
               ) -> Barycentre:
    """A barycentre (Fréchet mean) of diagrams [Turner, Mileyko, Mukherjee, Harer 2014].

    The result is a local minimum of the mean square of the Wasserstein distances to the diagrams
    (order 2, Euclidean ground norm). The search starts at the medoid. Each bar of the result is the
    mean of the bars with which it is paired; many bars of the result may be short.

    Parameters
    ----------
    diagrams : sequence of Barcode or array_like
        Barcodes, or arrays of rows birth, death, all with the same number of bars that never die.
    dim : int, optional
        For barcodes: the dimension.
    max_rounds : int
        The largest number of rounds; 0 returns the medoid.
    tolerance : float
        The search ends after a round that lowers the root mean square by this fraction or less.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Barycentre

    Examples
    --------
    >>> ph.barycentre([[[0, 4]], [[1, 5]], [[2, 3]]]).diagram
    array([[1., 4.]])
    """
    _run.check_names("barycentre", run, barycentre)
    rounds = _options.whole("max_rounds", max_rounds, 0, 2**31 - 1)
    least_gain = _options.real("tolerance", tolerance, "a finite number, at least 0", 0)
    block, root_mean_square, done, converged = _run.run(
        _core.barycentre, all_rows("diagrams", diagrams, dim), rounds, least_gain,
        options=dict(run))
    return Barycentre(np.asarray(block), root_mean_square, done, converged)
