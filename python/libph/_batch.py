# SPDX-License-Identifier: MIT
"""Barcodes of many inputs at a time."""
from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterable
from typing import Any

from . import _core, _options, _run
from ._barcodes import Barcode
from ._compute import alpha, boundary, cubical, filtered, lower_star, rips
from ._errors import Cancelled, Error, UsageError, reworded
from ._requests import (Request, alpha_request, boundary_request, cubical_request, filtered_request,
                        lower_star_request, rips_request)

_REQUESTS: dict[Any, Callable[[dict[str, Any]], Request]] = {
    alpha: alpha_request, boundary: boundary_request, cubical: cubical_request,
    filtered: filtered_request, lower_star: lower_star_request, rips: rips_request,
}


def batch(function: Callable[..., Barcode], inputs: Iterable[Any], **options: Any) -> list[Barcode]:
    """Computes the barcodes of many inputs, several at a time.

    Returns the same as ``[function(x, **options) for x in inputs]``, but faster: each thread takes
    one input after another, whereas separate calls would start threads for each input.

    Parameters
    ----------
    function : callable
        `rips`, `alpha`, `cubical`, `lower_star`, `filtered` or `boundary`.
    inputs : iterable
        The first arguments of the function: clouds or images, which may differ in size. For
        functions with several data arguments, such as `lower_star`, tuples of these arguments.
    **options
        Keywords of the function, the same for all inputs; and `threads`, `memory_limit`,
        `progress`, `timeout`, `stop`, which apply to all inputs together; see `libph`. The timeout
        starts once all inputs are converted.

    Returns
    -------
    list of Barcode
        In the order of the inputs.

    Raises
    ------
    Error
        The errors of the function; the message begins with the number of the input that failed. A
        failure stops the other inputs, and no barcodes are returned. If several inputs fail, the
        timing of threads decides which one is named.

    Examples
    --------
    >>> clouds = [[[0, 0], [1, 0], [1, 1], [0, 1]], [[0], [3]]]
    >>> ph.batch(ph.rips, clouds, max_dim=0, threads=2)
    [Barcode(rips of 4 points in R^2, field 2: 4 bars of H0), \
Barcode(rips of 2 points in R^1, field 2: 2 bars of H0)]
    """
    return computed(function, inputs, options, "input")


def computed(function: Callable[..., Barcode], inputs: Iterable[Any], options: dict[str, Any],
             what: str) -> list[Barcode]:
    """The barcodes that `batch` returns. `what` is the word for an input in messages."""
    if function not in _REQUESTS:
        raise _options.refuse("function", function, "rips, alpha, cubical, lower_star, filtered or "
                              "boundary from libph")
    request_of = _REQUESTS[function]
    places, defaults = _parameters(function)
    keywords = {**defaults, **{k: v for k, v in options.items() if k in defaults}}
    run = {k: v for k, v in options.items() if k not in defaults}
    _run.check_names(function.__name__, run, keywords)
    requests: list[Request] = []
    with _run.within_limit(run) as copies:
        for i, given in enumerate(_options.several(f"{what}s", inputs, "a list of them")):
            try:
                requests.append(request_of(_arguments(given, places, keywords)))
            except Error as error:
                raise reworded(error, f"{what} {i}: {error}") from None
    if not requests:
        return []
    try:
        bars = _run.run(_core.barcodes, [r.recipe for r in requests],
                        # Every request has a task.
                        [r.task for r in requests if r.task is not None],
                        options=run, slab_layers=requests[0].slab_layers,
                        copied=sum(copies))
    except Cancelled:
        raise
    except Error as error:
        if error._input is None or error._cause is None:
            raise
        reason = requests[error._input]._replace(options=run).told(error._cause)
        raise reworded(reason, f"{what} {error._input}: {reason}") from None
    return [Barcode._of(b, request.meta) for b, request in zip(bars, requests)]


@functools.lru_cache(maxsize=None)
def _parameters(function: Callable[..., Barcode]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The data arguments and the keywords, both with their defaults."""
    parameters = inspect.signature(function).parameters.values()
    places = {p.name: p.default for p in parameters if p.kind is p.POSITIONAL_OR_KEYWORD}
    return places, {p.name: p.default for p in parameters if p.kind is p.KEYWORD_ONLY}


def _arguments(given: Any, places: dict[str, Any], keywords: dict[str, Any]) -> dict[str, Any]:
    """All arguments of a request: the data in `given`, the keywords, and defaults for the
    others."""
    values = (given,) if len(places) == 1 else given
    needed = sum(default is inspect.Parameter.empty for default in places.values())
    if not isinstance(values, tuple) or not needed <= len(values) <= len(places):
        raise UsageError(f"found {type(given).__name__}, expected a tuple ({', '.join(places)})")
    return {"loops": None, **places, **keywords, **dict(zip(places, values)), "run": {}}
