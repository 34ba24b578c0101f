# SPDX-License-Identifier: MIT
"""Estimates of the memory and work of a computation."""
from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from . import _arrays, _core, _options
from ._compute import alpha, cubical, rips
from ._images import SpatialImage
from ._requests import PointImage, Request, alpha_request, cubical_request, rips_request
from ._options import arguments_of, signature_of
from ._results import in_units, spaced


class Estimate(NamedTuple):
    """An estimate of a computation; see `estimate`.

    Attributes
    ----------
    bytes_low : float
        The least predicted memory of the complex and the computation, in bytes.
    bytes_high : float
        The largest predicted memory, in bytes.
    cells : tuple of float
        Number of cells per dimension, as far as the engine lists them.
    counted_dims : int
        The numbers of cells below this dimension are counted; from this dimension on, they are
        estimated from a sample. If edges are collapsed and there are more than 300 000, all these
        numbers are of the complex before the collapse, and therefore upper bounds.
    engine : str
        The engine that will run.
    reason : str
        Why this engine will run.
    collapses : bool
        True if edges are collapsed first.
    collapse_reason : str
        Why edges are collapsed, or why not.
    max_dim : int
        The highest dimension of homology.
    """

    bytes_low: float
    bytes_high: float
    cells: tuple[float, ...]
    counted_dims: int
    engine: str
    reason: str
    collapses: bool
    collapse_reason: str
    max_dim: int

    def __repr__(self) -> str:
        cells = ", ".join(f"{'' if dim < self.counted_dims else 'about '}{spaced(round(count))} of "
                          f"dimension {dim}" for dim, count in enumerate(self.cells))
        return (f"Estimate({in_units(self.bytes_low)} to {in_units(self.bytes_high)}; engine "
                f"{self.engine}, up to H{self.max_dim}"
                + (f"; cells: {cells}" if cells else "")
                + ("; edges are collapsed" if self.collapses else "") + ")")


def request_of(data: Any, complex: Any, options: dict[str, Any]) -> Request:
    """The computation that `rips`, `cubical` or `alpha` would run on the data."""
    _options.choice("complex", complex, [None, "rips", "cubical", "alpha"])
    if complex == "alpha":
        return alpha_request(_arguments(alpha, data, options))
    is_image = complex == "cubical" or (complex is None and (
        isinstance(data, (PointImage, SpatialImage))
        or (not _arrays.is_sparse(data) and _axes_of(data) > 2)))
    if is_image:
        return cubical_request(_arguments(cubical, data, options))
    if complex is None:
        _warn_of_a_picture(data)
    return rips_request(_arguments(rips, data, options))


def _warn_of_a_picture(data: Any) -> None:
    """Warns of an array of points that has the type and the extents of a picture."""
    few = 16  # coordinates, which points may well have
    if isinstance(data, np.ndarray) and data.dtype in (np.uint8, np.bool_) and data.ndim == 2 \
            and min(data.shape) > few:
        rows, columns = data.shape
        warnings.warn(f"data: read as {rows} points of R^{columns}; the array has the type of a "
                      "picture, uint8 or bool; complex='cubical' takes it as an image", stacklevel=5)


def _arguments(function: Callable[..., Any], data: Any, options: dict[str, Any]) -> dict[str, Any]:
    """The arguments of the function. The error about a keyword that only another complex accepts
    names this complex."""
    functions = (rips, cubical, alpha)
    for name in [name for name in options if name not in signature_of(function).parameters]:
        others = [repr(other.__name__) for other in functions
                  if name in signature_of(other).parameters]
        if others:
            raise TypeError(f"{function.__name__}() got an unexpected keyword argument {name!r}; "
                            f"complex={' or '.join(others)} accepts it")
    return arguments_of(function, data, options)


def _axes_of(data: Any) -> int:
    axes = getattr(data, "ndim", None)
    if axes is None:
        try:
            axes = np.ndim(data)
        except Exception:  # the reader reports what foreign objects raise
            return 0
    return axes if isinstance(axes, int) else 0


def estimate(data: Any, *, complex: str | None = None, **options: Any) -> Estimate:
    """Estimates what `rips`, `cubical` or `alpha` will need: memory, cells, engine.

    The estimate takes a fraction of the time and memory of the computation.

    Parameters
    ----------
    data : array_like, sparse matrix or PointImage
        As in `rips`, `cubical` or `alpha`.
    complex : {None, "rips", "cubical", "alpha"}
        Which complex to use. Default: cubical for three axes or more, for a `SpatialImage`, which
        `read` returns, and for a `PointImage`; else rips.
    **options
        All keywords of that function.

    Returns
    -------
    Estimate

    Examples
    --------
    >>> found = ph.estimate([[0, 0], [1, 0], [1, 1], [0, 1]], max_dim=1)
    >>> found.engine
    'edge-links'
    >>> found
    Estimate(... bytes to ... MiB; engine edge-links, up to H1;
    cells: 4 of dimension 0, 6 of dimension 1)
    """
    found = request_of(data, complex, options).run(_core.estimate)
    return Estimate(found.bytes_low, found.bytes_high, tuple(found.cells), found.counted_dims,
                    found.engine, found.reason, found.collapses, found.collapse_reason,
                    found.max_dim)
