# SPDX-License-Identifier: MIT
"""The common base of results: they state their origin, and they can be pickled."""
from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from . import _core
from ._errors import UsageError


class Meta(Mapping[str, Any]):
    """The origin of a result: an immutable dictionary."""

    __slots__ = ("_items",)

    def __init__(self, items: Mapping[str, Any]) -> None:
        self._items = dict(items)

    def __getitem__(self, name: str) -> Any:
        return self._items[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __hash__(self) -> int:
        return hash(frozenset(self._items.items()))

    def __repr__(self) -> str:
        return f"Meta({self._items!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        return (Meta, (self._items,))


def with_arrays(state: Any) -> Any:
    """A state of _core in a form that can be pickled, with blocks as arrays."""
    if isinstance(state, _core.Block):
        return np.asarray(state)
    if isinstance(state, dict):
        return {name: with_arrays(member) for name, member in state.items()}
    return tuple(map(with_arrays, state)) if isinstance(state, tuple) else state


def require_version(found: int, expected: int) -> None:
    """Refuses the state of another version of libph."""
    if found != expected:
        raise UsageError(f"pickle: found version {found}, expected {expected}: it was written by "
                         "another version of libph")


def description_of(meta: Any) -> str:
    """A description of the data: "20 points in R^2". Empty if unknown."""
    if "shape" in meta:
        return " x ".join(map(str, meta["shape"]))
    if "points" not in meta:
        return ""
    number = spaced(meta["points"])
    return f"{number} points" + (f" in R^{meta['coordinates']}" if "coordinates" in meta else "")


def vertex_weights_of(meta: Any) -> str:
    """The reason why vertices enter late, in the words of ph-barcode: "dtm 5, exponent 1". Empty if
    no vertex enters late."""
    weights = meta.get("weights")
    if weights is None:
        return ""
    if "squared" in meta:
        return "squared radii of balls, given"
    source = f"dtm {meta['dtm_neighbors']}" if weights == "dtm" else (
        "diagonal" if meta.get("diagonal") == "births" else "given")
    return f"{source}, exponent {meta['weight_exponent']}"


def origin_of(meta: Any) -> dict[str, Any]:
    """The origin of a barcode as files state it."""
    known = {"input_description": description_of(meta), "vertex_weights": vertex_weights_of(meta)}
    return {**known, **meta, "program": f"libph {_core.version}"}


def spaced(number: int) -> str:
    """A number with spaces between groups of three digits.

    >>> spaced(12345)
    '12 345'
    """
    return f"{number:,}".replace(",", " ")
