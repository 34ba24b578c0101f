# SPDX-License-Identifier: MIT
"""Keywords of one function that another one takes, too."""
from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Mapping
from typing import Any

_signature = functools.lru_cache(maxsize=None)(inspect.signature)


def arguments_of(function: Callable[..., Any], data: Any, given: Mapping[str, Any]
                 ) -> dict[str, Any]:
    """What `function(data, **given)` would see: all of its arguments, defaults among them."""
    try:
        bound = _signature(function).bind(data, **given)
    except TypeError as error:
        raise TypeError(f"{function.__name__}() {error}") from None
    bound.apply_defaults()
    return dict(bound.arguments)
