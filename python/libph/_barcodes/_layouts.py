# SPDX-License-Identifier: MIT
"""Barcodes in the layouts of other programs, and from them."""
from __future__ import annotations

import numbers
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .. import _arrays, _core, _options
from .._errors import DataError, UsageError

if TYPE_CHECKING:
    from ._barcode import Barcode

LAYOUTS = ["dim-birth-death", "giotto", "ripser", "gudhi"]
_MOST_DIM = 2**20  # as in files
_Columns = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]


def in_layout(bars: Barcode, layout: str) -> Any:
    """See `Barcode.to_numpy`."""
    _options.choice("layout", layout, LAYOUTS)
    dims, births, deaths = bars._arrays
    if layout == "giotto":
        return np.column_stack([births, deaths, dims])
    if layout == "ripser":
        dgms = bars.dgms()
        return [dgm[np.lexsort((-dgm[:, 1], -dgm[:, 0]) if dim else (dgm[:, 0], dgm[:, 1]))]
                for dim, dgm in enumerate(dgms)]
    if layout == "gudhi":
        return _core.listed(bars._bars)
    return np.asarray(bars)


def from_layout(dgms: Any, layout: str | None
                ) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64], int]:
    """The dimensions, births and deaths for `Barcode.from_dgms`, and the highest dimension."""
    layout = _options.choice("layout", layout, [None, *LAYOUTS]) or _layout_of(dgms)
    least = 0
    if layout == "ripser":
        each = _options.several("dgms", dgms, "one array for each dimension")
        (dims, births, deaths), least = _by_dimension(each), len(each) - 1
    elif layout == "gudhi":
        dims, births, deaths = _of_pairs(dgms)
    else:
        dims, births, deaths = _columns(dgms)
        if layout == "giotto":
            dims, births, deaths = deaths, dims, births
    _check(dims, births, deaths, layout)
    whole = dims.astype(np.int64)
    return whole, births, deaths, max(least, int(whole.max(initial=0)))


def _layout_of(dgms: Any) -> str:
    if isinstance(dgms, Mapping):
        raise UsageError(f"dgms: found {type(dgms).__name__}, expected the arrays in it, such as "
                         "result['dgms'] of ripser.py")
    if isinstance(dgms, (list, tuple)):
        if dgms and all(map(_is_pair, dgms)):
            return "gudhi"
        if all(map(_is_diagram, dgms)):
            return "ripser"
    array = _arrays.as_array(dgms, "dgms")
    if array.ndim == 3 and array.shape[2] == 3:
        raise UsageError(f"dgms: found an array of shape {array.shape}, with the bars of each of "
                         "several inputs, expected the bars of one input, such as dgms[0]")
    if array.ndim == 2 and array.shape[1] == 2:
        raise UsageError("dgms: found one array of rows birth, death, expected one array for each "
                         "dimension; a list [dgm] makes them bars of H0")
    if array.ndim != 2 or array.shape[1] != 3:
        raise UsageError(f"dgms: found an array of shape {array.shape}, expected a list of arrays "
                         "(n, 2), one for each dimension, or one array (n, 3)")
    dims, births, deaths = _columns(array)
    fitting = [name for name, columns in (("dim-birth-death", (dims, births, deaths)),
                                          ("giotto", (deaths, dims, births)))
               if _first_wrong(*columns) is None]
    if len(fitting) == 1 or not len(array):
        return fitting[0]
    both = "both" if fitting else "neither of"
    raise UsageError(f"dgms: found rows that fit {both} dim, birth, death and birth, death, dim, "
                     "expected layout='dim-birth-death' or layout='giotto'")


def _is_pair(item: Any) -> bool:
    """True for dim, (birth, death)."""
    return (isinstance(item, (list, tuple)) and len(item) == 2
            and isinstance(item[0], numbers.Real)
            and isinstance(item[1], (list, tuple, np.ndarray)) and len(item[1]) == 2)


def _is_diagram(item: Any) -> bool:
    """True for rows birth, death, and for no rows."""
    if not hasattr(item, "__len__"):
        return False
    return len(item) == 0 or (hasattr(item[0], "__len__") and len(item[0]) == 2)


def _columns(rows: Any) -> _Columns:
    array = _arrays.as_float64(_arrays.as_array(rows, "dgms"), "dgms")
    if not array.size:
        array = array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise UsageError(f"dgms: found an array of shape {array.shape}, expected (n, 3)")
    return array[:, 0].copy(), array[:, 1].copy(), array[:, 2].copy()


def _of_pairs(pairs: Any) -> _Columns:
    rows = []
    for i, pair in enumerate(_options.several("dgms", pairs, "a list of (dim, (birth, death))")):
        if not _is_pair(pair):
            raise _options.refuse(f"dgms[{i}]", pair, "dim, (birth, death)")
        rows.append((pair[0], *pair[1]))
    return _columns(rows)


def _by_dimension(dgms: list[Any]) -> _Columns:
    found = [np.empty((0, 3))]
    for dim, dgm in enumerate(dgms):
        name = f"dgms[{dim}]"
        array = _arrays.as_float64(_arrays.as_array(dgm, name), name)
        if not array.size:
            continue
        if array.ndim != 2 or array.shape[1] != 2:
            raise UsageError(f"{name}: found an array of shape {array.shape}, expected (n, 2): rows "
                             "birth, death")
        found.append(np.insert(array, 0, dim, axis=1))
    return _columns(np.concatenate(found))


def _first_wrong(dims: NDArray[np.float64], births: NDArray[np.float64],
                 deaths: NDArray[np.float64]) -> int | None:
    """The index of the first bar that cannot be one."""
    wrong = ~((dims >= 0) & (dims <= _MOST_DIM) & (np.floor(dims) == dims) & (births <= deaths)
              & (births < np.inf))
    return int(np.argmax(wrong)) if wrong.any() else None


def _check(dims: NDArray[np.float64], births: NDArray[np.float64], deaths: NDArray[np.float64],
           layout: str) -> None:
    i = _first_wrong(dims, births, deaths)
    if i is None:
        return
    dim, birth, death = dims[i], births[i], deaths[i]
    if layout == "ripser":
        place = f"dgms[{int(dim)}]: row {i - int(np.searchsorted(dims, dim))}"
    else:
        place = f"dgms: row {i}"
    if birth > death:
        raise DataError(f"{place}: found birth {birth:g} and death {death:g}, expected birth <= "
                        "death; superlevel sets have such bars: negate both numbers")
    if not birth <= death or birth == np.inf:
        raise DataError(f"{place}: found birth {birth:g} and death {death:g}, expected numbers, and "
                        "a finite birth")
    raise DataError(f"{place}: found dimension {dim:g}, expected a whole number, 0 to {_MOST_DIM}")
