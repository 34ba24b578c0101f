# SPDX-License-Identifier: MIT
"""The common base of results: they state their origin, and they can be pickled."""
from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from . import _core
from ._errors import UsageError


_FEW = 12  # numbers that a description lists


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


def in_brief(result: Any) -> str:
    """A named tuple or a dataclass on one line. Arrays and lists of more than 12 elements are given
    by their shape.

    >>> in_brief(ph.farthest_points([[x] for x in range(20)]))
    'Subsample(indices=<20 int64>, radii=<20 float64>, covering_radius=0.0)'
    """
    fields: Iterable[str] = getattr(result, "_fields", None) or vars(result)
    return (f"{type(result).__name__}("
            + ", ".join(f"{name}={_value_in_brief(getattr(result, name))}" for name in fields) + ")")


def _value_in_brief(value: Any) -> str:
    if isinstance(value, list) and len(value) > _FEW:
        return f"<list of {spaced(len(value))}>"
    if isinstance(value, np.ndarray) and value.size > _FEW:
        return f"<{' x '.join(map(str, value.shape))} {value.dtype}>"
    return " ".join(repr(value).split())


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
    if isinstance(weights, str) and f"{weights}_neighbors" in meta:
        source = f"{weights} {meta[f'{weights}_neighbors']}"
    else:
        source = "diagonal" if meta.get("diagonal") == "births" else "given"
    return f"{source}, exponent {meta['weight_exponent']}"


def weights_in(words: str) -> dict[str, Any]:
    """The keywords of `rips` or `alpha` for which `vertex_weights_of` returned these words.

    >>> weights_in("dtm 5, exponent 1")
    {'weights': 'dtm', 'dtm_neighbors': 5, 'weight_exponent': 1.0}
    """
    if words.startswith("squared radii of balls"):
        return {"weights": "given"}
    match = re.fullmatch(r"(given|file|diagonal|(dtm|core) (\d+)), exponent (\S+)", words)
    if match is None:
        return {}
    source, computed, neighbors, exponent = match.groups()
    return {"weights": computed or "given",
            **({f"{computed}_neighbors": int(neighbors)} if computed else {}),
            **({"diagonal": "births"} if source == "diagonal" else {}),
            "weight_exponent": float(exponent)}


def origin_of(meta: Any) -> dict[str, Any]:
    """The origin of a barcode as files state it."""
    known = {"input_description": description_of(meta), "vertex_weights": vertex_weights_of(meta)}
    program = f"libph {meta.get('version', _core.version)}"
    return {**known, "program": program, **meta}


def in_units(size: float) -> str:
    """A size in bytes with a unit.

    >>> in_units(1023), in_units(4.5 * 2**20)
    ('1023 bytes', '4.5 MiB')
    """
    for unit in ("bytes", "KiB", "MiB", "GiB"):
        if size < 1024:
            break
        size /= 1024
    else:
        unit = "TiB"
    return f"{size:.4g} {unit}"


def spaced(number: int) -> str:
    """A number with spaces between groups of three digits.

    >>> spaced(12345)
    '12 345'
    """
    return f"{number:,}".replace(",", " ")
