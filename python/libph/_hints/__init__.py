# SPDX-License-Identifier: MIT
"""Hints at the end of error messages: names from other packages, and their equivalents in libph."""
from __future__ import annotations

import difflib
from collections.abc import Iterable
from typing import Any

from ._tables import (BARCODE, EXPLAINED, MISSING_MODULES, MISSING_NAMES, MODULE, OBJECTS,
                      OPPOSITES, SAME, SKLEARN)

__all__ = ["BARCODE", "EXPLAINED", "MISSING_MODULES", "MISSING_NAMES", "MODULE", "OBJECTS", "SAME",
           "SKLEARN", "of_foreign_keyword", "of_keyword", "of_name", "of_object", "unexpected"]


def of_name(name: str, table: dict[str, str], known: Iterable[str]) -> str:
    """The end of a message about a missing name; empty if there is no hint.

    >>> of_name("wasserstein", {"wasserstein": "use ph.bottleneck"}, [])
    '; use ph.bottleneck'
    >>> of_name("riips", {}, ["rips", "cubical"])
    "; did you mean 'rips'?"
    """
    if name in table:
        return "; " + table[name]
    close = [] if name.startswith("_") else difflib.get_close_matches(
        name, [there for there in known if not there.startswith("_") and there != name
               and not _are_opposites(name, there)], 1, 0.7)
    return f"; did you mean {close[0]!r}?" if close else ""


def of_keyword(name: str, known: Iterable[str]) -> str:
    """The same for a keyword that a function does not have.

    >>> of_keyword("thresh", ["threshold"]), of_keyword("treshold", ["threshold"])
    ("; did you mean 'threshold'?", "; did you mean 'threshold'?")
    """
    known = list(known)
    return of_foreign_keyword(name, known) or of_name(name, {}, known)


def of_foreign_keyword(name: str, known: Iterable[str]) -> str:
    """The same, but only for keywords of other packages, not for typing errors.

    >>> of_foreign_keyword("sublevel", ["superlevel"])
    '; sublevel sets are the default, superlevel=True takes superlevel sets'
    """
    there = set(known)
    for names, needed, hint in EXPLAINED:
        if name in names.split() and there.issuperset(needed.split()):
            return "; " + hint
    for group in SAME:
        if name in group:
            for same in group:
                if same in there:
                    return f"; did you mean {same!r}?"
    return ""


def of_object(data: Any) -> str:
    """The same for an object of another package that is not an array."""
    for attributes, hint in OBJECTS:
        if all(hasattr(data, attribute) for attribute in attributes.split()):
            return "; " + hint
    return ""


def unexpected(function: str, keyword: str, known: Iterable[str]) -> TypeError:
    """The error about a keyword that a function does not have."""
    return TypeError(f"{function}() got an unexpected keyword argument {keyword!r}"
                     + of_keyword(keyword, known))


def _are_opposites(a: str, b: str) -> bool:
    """True if one name has a word where the other one has its opposite.

    >>> _are_opposites("max_persistence", "min_persistence"), _are_opposites("max_dims", "max_dim")
    (True, False)
    """
    return any((x in a and y in b and y not in a) or (y in a and x in b and x not in a)
               for x, y in OPPOSITES)
