# SPDX-License-Identifier: MIT
"""Barcodes as text, and the lengths of bars."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .._results import description_of, spaced

if TYPE_CHECKING:
    from ._barcode import Barcode


def lengths(births: NDArray[np.float64], deaths: NDArray[np.float64]) -> NDArray[np.float64]:
    """The length of each bar: 0 for a bar that dies at its birth, even at -inf."""
    lengths = np.zeros(len(births))
    np.subtract(deaths, births, out=lengths, where=deaths != births)
    return lengths


def in_words(bars: Barcode) -> str:
    """The first line that a user sees: the kind of data and the number of bars."""
    meta = bars.meta
    name = " of ".join(filter(None, [str(meta.get("complex") or "barcode"),
                                     description_of(meta)]))
    counts: list[str] = []
    for dim, count in zip(*(x.tolist() for x in np.unique(bars.dims, return_counts=True))):
        noun = "" if counts else " bar" if count == 1 else " bars"
        counts.append(f"{spaced(count)}{noun} of H{dim}")
    text = f"Barcode({name}, field {meta.get('field', 2)}: {', '.join(counts) or 'no bars'}"
    dim = int(bars.dims[-1]) if len(bars) else 0
    if dim > 0:
        bar = bars[bars.longest(dim)]
        text += f", longest [{bar.birth:.6g}, {bar.death:.6g})"
    return text + ")"
