# SPDX-License-Identifier: MIT
"""Drop-ins: the interfaces of other packages over libph.

Each is a module here, as `libph.compat.ripser`. `install` gives them the names of the packages that
they replace, so that other people's code runs unchanged. docs/how-to/coming-from.md says how, and
where libph answers otherwise on purpose.
"""
from __future__ import annotations

import importlib
import sys
from typing import TYPE_CHECKING

from .. import _options
from .._errors import UsageError

__all__ = ["install"]

# What each brings along.
_MODULES = {
    "ripser": (),
    "gph": ("gph.modules", "gph.modules.gph_ripser", "gph.modules.gph_collapser"),
    "cripser": ("tcripser",),
    "gudhi": ("gudhi.hera", "gudhi.wasserstein", "gudhi.sklearn", "gudhi.flag_filtration",
              "gudhi.flag_filtration.edge_collapse", "gudhi.dtm_rips_complex",
              "gudhi.weighted_rips_complex"),
    "persim": (),
}
_DROP_INS = sorted([*_MODULES, "tcripser"])


def install(*names: str) -> None:
    """Has `import ripser` and the like import libph's drop-in, in this process.

    Parameters
    ----------
    *names : str
        "ripser", "gph", "cripser" (with "tcripser"), "gudhi", "persim".

    Raises
    ------
    UsageError
        If one of them is imported already: whoever did so keeps what it got.

    Examples
    --------
    >>> from libph import compat
    >>> compat.install("ripser")
    >>> import ripser
    >>> ripser.__name__
    'libph.compat.ripser'
    """
    chosen = []
    for name in names:
        _options.choice("install", name, _MODULES)
        chosen += [name, *_MODULES[name]]
    ours = {}
    for name in chosen:
        try:
            ours[name] = importlib.import_module(f"{__name__}.{name}")
        except ImportError:  # gudhi.sklearn, without scikit-learn
            if name != "gudhi.sklearn":
                raise
    for name, module in ours.items():
        there = sys.modules.get(name)
        if there not in (None, module):
            raise UsageError(f"install: {name} is imported already, from "
                             f"{getattr(there, '__file__', 'elsewhere')}; install it before that")
    sys.modules.update(ours)


if not TYPE_CHECKING:  # for a type checker a name that is missing is an error

    def __getattr__(name):
        """The drop-ins, loaded when they are looked at."""
        if name in _DROP_INS:
            return importlib.import_module(f"{__name__}.{name}")
        raise AttributeError(f"libph.compat has no {name!r}; there are {', '.join(_DROP_INS)}")

    def __dir__():
        return [*__all__, *_DROP_INS]
