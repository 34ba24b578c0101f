# SPDX-License-Identifier: MIT
"""Barcodes in the layouts of other programs, and as text."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .. import _options
from .._results import description_of, spaced

if TYPE_CHECKING:
    from ._barcode import Barcode


def lengths(births: NDArray[np.float64], deaths: NDArray[np.float64]) -> NDArray[np.float64]:
    """The length of each bar: 0 for a bar that dies at its birth, even at -inf."""
    lengths = np.zeros(len(births))
    np.subtract(deaths, births, out=lengths, where=deaths != births)
    return lengths


def in_layout(bars: Barcode, layout: str) -> Any:
    """See `Barcode.to_numpy`."""
    _options.choice("layout", layout, ["dim-birth-death", "giotto", "ripser", "gudhi"])
    dims, births, deaths = bars._arrays
    if layout == "giotto":
        return np.column_stack([births, deaths, dims])
    if layout == "ripser":
        dgms = bars.dgms()
        return [dgm[np.lexsort((-dgm[:, 1], -dgm[:, 0]) if dim else (dgm[:, 0], dgm[:, 1]))]
                for dim, dgm in enumerate(dgms)]
    if layout == "gudhi":
        order = np.lexsort((births, -lengths(births, deaths), -dims))
        return [(int(dims[i]), (float(births[i]), float(deaths[i]))) for i in order]
    return np.asarray(bars)


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
