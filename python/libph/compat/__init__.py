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

# What each brings along, and in which of our modules it is, if no file of ours has the name.
_MODULES: dict[str, dict[str, str]] = {
    "ripser": {"ripser.ripser": "ripser"},
    "gph": {"gph.modules": "", "gph.modules.gph_collapser": "", "gph.modules.gph_ripser": "",
            "gph.modules.gph_ripser_coeff": "gph.modules.gph_ripser", "gph.python": "gph",
            "gph.python.ripser_interface": "gph"},
    "cripser": {"tcripser": "", "cripser.tcripser": "tcripser", "cripser.utils": "cripser"},
    "gudhi": {
        "gudhi.hera": "", "gudhi.random": "", "gudhi.sklearn": "", "gudhi.wasserstein": "",
        "gudhi.flag_filtration": "", "gudhi.flag_filtration.edge_collapse": "",
        "gudhi.wasserstein.wasserstein": "gudhi.wasserstein",
        **dict.fromkeys(["gudhi.sklearn.cubical_persistence", "gudhi.sklearn.rips_persistence"],
                        "gudhi.sklearn"),
        **dict.fromkeys(["gudhi.bottleneck", "gudhi.cubical_complex", "gudhi.dtm_rips_complex",
                         "gudhi.periodic_cubical_complex", "gudhi.rips_complex",
                         "gudhi.simplex_tree", "gudhi.weighted_rips_complex"], "gudhi")},
    "persim": dict.fromkeys(["persim.bottleneck", "persim.visuals", "persim.wasserstein"],
                            "persim"),
}
_DROP_INS = sorted([*_MODULES, "tcripser"])


def install(*names: str) -> None:
    """Has `import ripser` and the like import libph's drop-in, in this process.

    Parameters
    ----------
    *names : str
        "ripser", "gph", "cripser" (with "tcripser"), "gudhi", "persim"; with the names of modules
        in them, as ripser.ripser and gudhi.rips_complex.

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
    chosen: dict[str, str] = {}
    for name in names:
        _options.choice("install", name, _MODULES)
        chosen |= {name: "", **_MODULES[name]}
    ours = {}
    for name, place in chosen.items():
        try:
            ours[name] = importlib.import_module(f"{__name__}.{place or name}")
        except ImportError:  # without scikit-learn
            if not name.startswith("gudhi.sklearn"):
                raise
    for name, module in ours.items():
        there = sys.modules.get(name)
        if there not in (None, module):
            raise UsageError(f"install: {name} is imported already, from "
                             f"{getattr(there, '__file__', 'elsewhere')}; install it before that")
    sys.modules.update(ours)
    for name, module in ours.items():
        package, _, own = name.rpartition(".")
        if package and not hasattr(ours[package], own):  # persim.bottleneck is the function
            setattr(ours[package], own, module)


if not TYPE_CHECKING:  # for a type checker a name that is missing is an error

    def __getattr__(name):
        """The drop-ins, loaded when they are looked at."""
        if name in _DROP_INS:
            return importlib.import_module(f"{__name__}.{name}")
        raise AttributeError(f"libph.compat has no {name!r}; there are {', '.join(_DROP_INS)}")

    def __dir__():
        return [*__all__, *_DROP_INS]
