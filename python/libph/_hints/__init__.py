# SPDX-License-Identifier: MIT
"""Hints at the end of error messages: names from other packages, and their equivalents in libph."""
from __future__ import annotations

import difflib
from collections.abc import Iterable

from ._tables import BARCODE, KEYWORDS, MODULE, SKLEARN, VALUES

__all__ = ["BARCODE", "KEYWORDS", "MODULE", "SKLEARN", "of_keyword", "of_name"]


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
        name, [there for there in known if not there.startswith("_") and there != name], 1, 0.7)
    return f"; did you mean {close[0]!r}?" if close else ""


def of_keyword(name: str, known: Iterable[str]) -> str:
    """The same for a keyword that a function does not have.

    >>> of_keyword("distance_matrix", ["metric"]), of_keyword("treshold", ["threshold"])
    ("; did you mean metric='precomputed'?", "; did you mean 'threshold'?")
    """
    known = list(known)
    new = KEYWORDS.get(name)
    if new in known:
        return f"; did you mean {VALUES.get(name) or VALUES.get(new) or repr(new)}?"
    return of_name(name, {}, known)
