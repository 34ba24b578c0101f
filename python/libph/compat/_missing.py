# SPDX-License-Identifier: MIT
"""Names and modules that a package has and the drop-in for it does not have: the error says what to
use instead."""
from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from types import ModuleType
from typing import Any, NoReturn

from .._errors import NotBuiltIn

_HERE = __name__.rpartition(".")[0]
_PACKAGES = {"gudhi": "GUDHI", "hdbscan": "hdbscan", "persim": "persim"}


def attribute(module: str, name: str, known: Iterable[str]) -> Any:
    """What the `__getattr__` of the module returns.

    For a function or class of the original, it is a function that raises `NotBuiltIn`. Scripts that
    import such a name without using it therefore run.
    """
    from .. import _hints
    place = module[len(_HERE) + 1:]
    package, _, path = f"{place}.{name}".partition(".")
    if path not in _hints.MISSING_NAMES.get(package, {}):
        raise AttributeError(f"module {module!r} has no attribute {name!r}"
                             + (_module_hint(package, path) or _hints.of_name(name, {}, known)))

    def missing(*arguments: Any, **options: Any) -> NoReturn:
        hint = _hints.MISSING_NAMES[package][path]
        raise NotBuiltIn(f"{name}: not in this drop-in; {_PACKAGES[package]} has it"
                         + (hint and f"; {hint}"))

    return missing


def _module_hint(package: str, path: str) -> str:
    """The end of a message about a module of the original; empty for any other module."""
    from .. import _hints
    from . import _MODULES
    place = _MODULES.get(package, {}).get(f"{package}.{path}")
    if place:  # only `install` makes a module of it
        return f"; {_HERE}.{place} has its functions"
    hint = _hints.MISSING_MODULES.get(package, {}).get(path)
    if hint is None:
        return ""
    return f"; {_PACKAGES[package]} has it" + (hint and f"; {hint}")


class _Finder:
    """Finds no module, but explains why a drop-in lacks a module of the original. It comes after all
    other finders, so that they are not affected."""

    @staticmethod
    def find_spec(name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
                  ) -> None:
        full = name
        top = name.partition(".")[0]
        if getattr(sys.modules.get(top), "__name__", None) == f"{_HERE}.{top}":  # it is installed
            full = f"{_HERE}.{name}"
        if not full.startswith(f"{_HERE}."):
            return
        package, _, inner = full[len(_HERE) + 1:].partition(".")
        hint = _module_hint(package, inner)
        if hint:
            # The error has no `name`, because `from package import module` would then ignore it.
            raise ModuleNotFoundError(f"No module named {name!r} in this drop-in{hint}")


sys.meta_path.append(_Finder)
