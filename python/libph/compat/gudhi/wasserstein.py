# SPDX-License-Identifier: MIT
"""GUDHI's module wasserstein: the exact distance and its matching."""
from __future__ import annotations

import math
from typing import Any

import numpy as np

from ... import _distances, _options
from ..._errors import NotBuiltIn
from .hera import _check_width

__all__ = ["wasserstein_distance"]
__path__: list[str] = []  # like a package; `import gudhi.wasserstein.barycenter` gets a hint


@_options.with_hints
def wasserstein_distance(X: Any, Y: Any, matching: bool = False, order: float = 1.0,
                         internal_p: float = math.inf, enable_autodiff: bool = False,
                         keep_essential_parts: bool = True) -> Any:
    """The Wasserstein distance between two diagrams.

    Parameters
    ----------
    X, Y : array_like
        Rows birth, death.
    matching : bool
        If True, the matching is returned as well.
    order : float
        p: at least 1, finite.
    internal_p : float
        The norm that measures a pair, at least 1.
    enable_autodiff : bool
        Not built in.
    keep_essential_parts : bool
        If True, bars that never die count.

    Returns
    -------
    float or (float, ndarray)
        The matching has rows of an index in `X` and an index in `Y`; -1 is the diagonal. It is None
        if the distance is infinite.
    """
    if _options.flag("enable_autodiff", enable_autodiff):
        raise NotBuiltIn("enable_autodiff: libph returns only numbers; GUDHI has it")
    _check_width(X, Y)
    if not 1 <= _options.real("order", order) < math.inf:
        raise _options.refuse("order", order, "a finite number of at least 1")
    rows = [np.asarray(dgm, dtype=np.float64).reshape(-1, 2) for dgm in (X, Y)]
    kept = [np.arange(len(dgm)) if _options.flag("keep_essential_parts", keep_essential_parts)
            else np.flatnonzero(np.isfinite(dgm).all(axis=1)) for dgm in rows]
    found = _distances.wasserstein_matching(rows[0][kept[0]], rows[1][kept[1]], order=order,
                                            ground=internal_p)
    if not _options.flag("matching", matching):
        return found.distance
    if math.isinf(found.distance):
        return found.distance, None
    # Indices of all bars; the last number stands for the diagonal, whose index is -1.
    places = [np.append(kept[side], -1)[found.pairs[:, side]] for side in (0, 1)]
    return found.distance, np.column_stack(places)
