# SPDX-License-Identifier: MIT
"""Drop-ins: the interfaces of other packages on top of libph.

Each drop-in is a module here, such as `libph.compat.ripser`. `install` gives it the name of the
package that it replaces, so that existing code runs unchanged. docs/how-to/coming-from.md shows
how, and lists the cases in which libph deliberately gives another answer.
"""
from __future__ import annotations

import importlib
import sys
from typing import TYPE_CHECKING

from .. import _options
from .._errors import UsageError
from . import _missing as _missing  # its finder explains which modules a drop-in lacks

__all__ = ["install"]

# The modules of each package. If libph's own module has another name, the value is that name.
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
    "hdbscan": {"hdbscan.plots": "", "hdbscan.prediction": "", "hdbscan.validity": "",
                "hdbscan.hdbscan_": "hdbscan", "hdbscan.robust_single_linkage_": "hdbscan"},
}
_DROP_INS = sorted([*_MODULES, "tcripser"])


def install(*names: str) -> None:
    """Makes statements such as `import ripser` import libph's drop-in, in this process.

    Parameters
    ----------
    *names : str
        "ripser", "gph", "cripser" (with "tcripser"), "gudhi", "persim", "hdbscan". Their modules,
        such as ripser.ripser and gudhi.rips_complex, are included.

    Raises
    ------
    UsageError
        If one of them is already imported, because the modules that imported it would keep the
        original.

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
            raise UsageError(f"install: {name} is already imported, from "
                             f"{getattr(there, '__file__', 'elsewhere')}; call install before that")
    sys.modules.update(ours)
    for name, module in ours.items():
        package, _, own = name.rpartition(".")
        # persim.bottleneck is a function, not a module.
        if package and not hasattr(ours[package], own):
            setattr(ours[package], own, module)


if not TYPE_CHECKING:  # hidden from type checkers, which then report missing names

    def __getattr__(name):
        """Loads a drop-in on first use."""
        if name in _DROP_INS:
            return importlib.import_module(f"{__name__}.{name}")
        raise AttributeError(f"libph.compat has no {name!r}; it has {', '.join(_DROP_INS)}")

    def __dir__():
        return [*__all__, *_DROP_INS]
