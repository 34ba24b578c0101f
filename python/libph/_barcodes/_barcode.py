# SPDX-License-Identifier: MIT
"""Barcodes: sequences of bars, also available as arrays."""
from __future__ import annotations

import operator
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from .. import _core, _options
from .._errors import UsageError
from .._results import Meta, require_version, with_arrays
from .._vectors import Summaries, lengths
from . import _layouts
from ._cells import Cells
from ._output import Output

# The layout of bars in _core.
_BAR = np.dtype({"names": ["dim", "birth", "death"], "formats": ["i4", "f8", "f8"],
                 "offsets": [0, 8, 16], "itemsize": 24})
_STATE_VERSION = 1
_MOST_DIM = 2**31 - 1  # of _core
_Arrays = tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]


class Bar(NamedTuple):
    """A hole that appears at `birth` and disappears at `death`, or never if `death` is ``inf``.

    The hole is a component in dimension 0, a loop in dimension 1, a hollow in dimension 2, and in
    general a class of H_dim. A bar is a tuple: ``dim, birth, death = bar``.
    """

    dim: int
    birth: float
    death: float

    @property
    def persistence(self) -> float:
        """The length of the bar."""
        return self.death - self.birth if self.birth != self.death else 0.0


@_options.with_hints
class Barcode(Cells, Summaries, Output, Sequence[Bar]):
    """The result of persistent homology: bars, ordered by dimension, birth and death.

    An immutable sequence of `Bar`, also available as arrays. Barcodes are equal if their bars are
    equal. Bars that never die have the death ``inf``.

    Attributes
    ----------
    meta : Mapping
        The origin of the barcode: `complex`, `field`, `max_dim`, `engine`, the `threshold` if there
        is one, and further facts such as the number of `points` or the `shape` of the image.

    Examples
    --------
    >>> bars = ph.rips([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> len(bars), bars[-1]
    (5, Bar(dim=1, birth=1.0, death=1.4142135623730951))
    >>> bars.dgm(1)
    array([[1.        , 1.41421356]])
    >>> [bar.persistence for bar in bars if bar.dim == 0]
    [1.0, 1.0, 1.0, inf]
    """

    __slots__ = ("_bars", "_values", "meta", "__weakref__")

    _bars: _core.Bars
    _values: _Arrays | None  # filled on first use
    meta: Mapping[str, Any]

    def __init__(self, *_: Any) -> None:
        raise TypeError("a Barcode cannot be constructed directly; ph.Barcode.from_dgms takes the "
                        "arrays of other packages, ph.rips, ph.cubical and the like compute one, "
                        "and ph.read_barcode reads one")

    @classmethod
    def from_dgms(cls, dgms: Any, layout: str | None = None) -> Barcode:
        """The barcode of diagrams that another package computed.

        It has neither cells nor representatives, and `meta` does not state how it was computed.

        Parameters
        ----------
        dgms : list or array_like
            One of the layouts of `to_numpy`.
        layout : {None, "ripser", "dim-birth-death", "giotto", "gudhi"}
            "ripser": one array of rows birth, death per dimension, as `dgms` of ripser.py, or
            ``[tree.persistence_intervals_in_dimension(d) for d in (0, 1)]`` of GUDHI.
            "dim-birth-death" and "giotto": an array (n, 3) of rows dim, birth, death or birth,
            death, dim. "gudhi": a list of (dim, (birth, death)), as `persistence()` of GUDHI.
            Default: the layout that `dgms` has. Rows that fit both layouts of (n, 3) are refused.

        Returns
        -------
        Barcode

        Raises
        ------
        UsageError
            If the layout is not recognised, or `dgms` does not have it.
        DataError
            If a number is NaN, a bar dies before its birth, or a dimension is not a whole number.

        Examples
        --------
        >>> bars = ph.Barcode.from_dgms([[[0, 1], [0, np.inf]], [[1, 1.5]]])
        >>> bars
        Barcode(barcode, field 2: 2 bars of H0, 1 of H1, longest [1, 1.5))
        >>> ph.Barcode.from_dgms(bars.to_numpy("giotto")) == bars
        True
        """
        dims, births, deaths, max_dim = _layouts.from_layout(dgms, layout)
        return cls._made(_core.Bars.of(dims, births, deaths), {"max_dim": max_dim})

    @classmethod
    def _of(cls, bars: _core.Bars, meta: Mapping[str, Any]) -> Barcode:
        """The barcode of bars of _core. The facts found during the computation are added to
        `meta`."""
        return cls._made(bars, {**meta, **bars.facts, "version": _core.version})

    @classmethod
    def _made(cls, bars: _core.Bars, meta: Mapping[str, Any]) -> Barcode:
        self = object.__new__(cls)
        self._bars = bars
        self._values = None
        self.meta = meta if isinstance(meta, Meta) else Meta(meta)
        return self

    # ---- sequence methods

    def __len__(self) -> int:
        return len(self._bars)

    @overload
    def __getitem__(self, i: int) -> Bar: ...
    @overload
    def __getitem__(self, i: slice | NDArray[np.bool_]) -> Barcode: ...

    def __getitem__(self, i: int | slice | NDArray[np.bool_]) -> Bar | Barcode:
        if isinstance(i, np.ndarray) and i.dtype == np.bool_:
            if i.shape != (len(self),):
                raise IndexError(f"bars[...]: found an array of bools of shape {i.shape}, expected "
                                 f"one per bar, ({len(self)},)")
            return self._selected(np.flatnonzero(i))
        if isinstance(i, slice):
            return self._selected(np.sort(np.arange(len(self))[i]))
        try:
            place = operator.index(i)
        except TypeError:
            raise TypeError(f"bars[...]: found {type(i).__name__}, expected a whole number, a "
                            "slice or one bool per bar; dgm(1) is the array of the bars of H1, filter() chooses bars"
                            ) from None
        if not -len(self) <= place < len(self):
            known = f", expected an index from {-len(self)} to {len(self) - 1}" if len(self) else ""
            raise IndexError(f"bars[{place}]: found {len(self)} bars{known}")
        return Bar(*self._records[place].item())

    if not TYPE_CHECKING:  # hidden from type checkers, which then report missing names

        def __getattr__(self, name):
            from .. import _hints
            raise AttributeError(f"a Barcode has no {name!r}" + _hints.of_name(
                name, _hints.BARCODE, dir(type(self))))

    def __iter__(self) -> Iterator[Bar]:
        return map(Bar._make, self._records.tolist())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Barcode):
            return NotImplemented
        return bool(len(self) == len(other) and all(
            np.array_equal(mine, its) for mine, its in zip(self._arrays, other._arrays)))

    def __hash__(self) -> int:
        return hash(tuple(array.tobytes() for array in self._arrays))

    def __copy__(self) -> Barcode:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Barcode:
        return self

    # ---- arrays

    @property
    def _records(self) -> NDArray[Any]:
        return np.asarray(self._bars).view(_BAR)

    @property
    def _arrays(self) -> _Arrays:
        if self._values is None:
            records = self._records
            arrays = (records["dim"].astype(np.int64), records["birth"].copy(),
                      records["death"].copy())
            for array in arrays:
                array.flags.writeable = False
            self._values = arrays
        return self._values

    @property
    def dims(self) -> NDArray[np.int64]:
        """The dimension of each bar."""
        return self._arrays[0]

    @property
    def births(self) -> NDArray[np.float64]:
        """The birth of each bar."""
        return self._arrays[1]

    @property
    def deaths(self) -> NDArray[np.float64]:
        """The death of each bar; inf for a bar that never dies."""
        return self._arrays[2]

    @property
    def p_values(self) -> NDArray[np.float64] | None:
        """The p-value of each bar, if the barcode was read from a file with p-values; else None.

        ``ph-barcode --significance`` writes such files. NaN: the bar has no p-value.
        The function ``ph.p_values(bars)`` computes p-values.
        """
        values = np.asarray(self._bars.p_values)
        return values if values.size else None

    def _range(self, dim: int) -> slice:
        """The indices of the bars of a dimension."""
        first, last = np.searchsorted(self.dims, [dim, dim + 1])
        return slice(int(first), int(last))

    @property
    def _top_dim(self) -> int:
        """The highest dimension that was requested or that has a bar."""
        known: int = self.meta.get("max_dim", -1)
        return max(known, self._bars.top_dim)

    def dgm(self, dim: int) -> NDArray[np.float64]:
        """The bars of one dimension, as a new array of rows birth, death.

        >>> ph.rips([[0], [1]]).dgm(0)
        array([[ 0.,  1.],
               [ 0., inf]])
        """
        return np.asarray(self._bars.dgm(min(_options.whole("dim", dim, 0), _MOST_DIM)))

    def dgms(self) -> list[NDArray[np.float64]]:
        """A list with the `dgm` of every dimension."""
        return [self.dgm(dim) for dim in range(self._top_dim + 1)]

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        if copy is False:
            raise ValueError("a Barcode cannot become an array without a copy")
        rows = np.column_stack(self._arrays)
        return rows if dtype is None else rows.astype(dtype, copy=False)

    # ---- indices and selections

    def _place(self, i: Any) -> int:
        place = _options.whole("i", i, -len(self), len(self) - 1)
        return place + len(self) if place < 0 else place

    def _selected(self, places: NDArray[Any]) -> Barcode:
        return Barcode._made(self._bars.selected(np.ascontiguousarray(places, dtype=np.int64)),
                             self.meta)

    @overload
    def longest(self, dim: int, n: None = None) -> int: ...
    @overload
    def longest(self, dim: int, n: int) -> NDArray[np.int64]: ...

    def longest(self, dim: int, n: int | None = None) -> int | NDArray[np.int64]:
        """The index of the longest bar of a dimension, or the indices of the `n` longest bars.

        Bars that never die come first. The others follow by descending length; equally long bars
        keep their order.
        """
        places = self._range(_options.whole("dim", dim, 0))
        births, deaths = self.births[places], self.deaths[places]
        order = np.lexsort((-lengths(births, deaths), deaths < np.inf)) + places.start
        if n is not None:
            chosen: NDArray[np.int64] = order[:_options.whole("n", n, 0)]
            return chosen
        if not len(order):
            raise UsageError(f"longest: found no bar of dimension {dim}")
        return int(order[0])

    def filter(self, *, dim: int | Iterable[int] | None = None,
               min_persistence: float | None = None, born_before: float | None = None) -> Barcode:
        """A barcode of some of the bars, with their cells and chains.

        Parameters
        ----------
        dim : int or iterable of int, optional
            The dimension or dimensions to keep.
        min_persistence : float, optional
            Bars with death - birth <= this value are left out.
        born_before : float, optional
            Bars born at this value or later are left out.
        """
        dims, births, deaths = self._arrays
        keep = np.ones(len(self), dtype=bool)
        if dim is not None:
            keep &= np.isin(dims, _options.one_or_several("dim", dim, 0))
        if min_persistence is not None:
            least = _options.real("min_persistence", min_persistence)
            keep &= lengths(births, deaths) > least
        if born_before is not None:
            keep &= births < _options.real("born_before", born_before)
        return self._selected(np.flatnonzero(keep))

    def __reduce__(self) -> tuple[Any, ...]:
        return (_restored, (_STATE_VERSION, with_arrays(self._bars.state()), dict(self.meta)))


def _restored(version: int, state: dict[str, Any], meta: dict[str, Any]) -> Barcode:
    """Called by pickle."""
    require_version(version, _STATE_VERSION)
    return Barcode._made(_core.Bars.from_state(state), meta)
