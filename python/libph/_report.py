# SPDX-License-Identifier: MIT
"""Interactive pages for a result: one HTML file, or a frame in a notebook."""
from __future__ import annotations

import html
import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _arrays, _core, _options, _run
from ._compute import boundary, filtered, lower_star, rips
from ._errors import DataError, NotBuiltIn, UsageError
from ._estimate import request_of
from ._files import Boundary, Mesh, Simplices
from ._options import arguments_of
from ._requests import (ALPHA_VALUES, PointImage, Request, boundary_request, filtered_request,
                        lower_star_request, rips_request)
from ._results import description_of, origin_of

if TYPE_CHECKING:
    from ._barcodes import Barcode

_HEIGHT = 720  # size in pixels of a frame in a notebook
# The keywords of the computation that a barcode stores.
_KNOWN = {
    "rips": ("metric", "minkowski_p", "weights", "dtm_neighbors", "core_neighbors", "weight_exponent", "subsample",
             "subsample_radius", "approximation", "nan", "diagonal", "symmetrise"),
    "cubical": ("construction", "superlevel", "periodic", "nan"),
    **dict.fromkeys(ALPHA_VALUES, ("squared", "weights", "period", "nan"))}
_OF_ALL = ("threshold", "field", "max_dim", "representatives")


class Report:
    """An interactive page: a notebook shows it in a frame, and `save` writes it as one file.

    The page needs neither a network nor Python. docs/reference/report.md describes it.
    """

    __slots__ = ("_page", "title")

    _page: bytes
    title: str

    def __init__(self) -> None:
        raise TypeError("a Report cannot be constructed directly; ph.report, Barcode.report and "
                        "Segmentation.report return one")

    @classmethod
    def _of(cls, page: bytes, title: str) -> Report:
        self = object.__new__(cls)
        self._page = page
        self.title = title
        return self

    @property
    def html(self) -> str:
        """The whole page."""
        return self._page.decode()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the page to a file, completely or not at all."""
        _run.run(_core.write_file, _options.path_of(path), self._page, options={})

    def __repr__(self) -> str:
        return f"Report({self.title!r}, {len(self._page) / 1e6:.1f} MB)"

    def _repr_html_(self) -> str:
        # The page is a separate document: it and the notebook cannot access each other.
        return (f'<iframe sandbox="allow-scripts allow-downloads" title="{html.escape(self.title)}"'
                f' style="width: 100%; height: {_HEIGHT}px; border: 0"'
                f' srcdoc="{html.escape(self.html)}"></iframe>')


def require_page() -> None:
    """Raises NotBuiltIn if this build has no report page. Call it before the computation."""
    if not _core.has_page():
        raise NotBuiltIn("report: this build of libph has no report page, because npm or its packages "
                         "were missing. Install Node.js with npm (Debian: apt "
                         "install npm), then install libph again (pip install .)")


def report(data: Any, *, complex: str | None = None, title: str = "", **options: Any) -> Report:
    """Computes a barcode and shows it with the data, as ``ph-barcode --report`` does.

    Parameters
    ----------
    data : array_like, sparse matrix, PointImage, Mesh, Simplices or Boundary
        As in `rips`, `cubical` or `alpha`; or the result of `read`.
    complex : {None, "rips", "cubical", "alpha"}
        For arrays: which complex to use. Default: cubical for three axes or more and for a
        PointImage, else rips.
    title : str
        Title of the page. Default: a description of the data.
    **options
        All keywords of the function that computes the barcode.

    Returns
    -------
    Report

    Examples
    --------
    >>> ph.report([[0, 0], [1, 0], [1, 1], [0, 1]])        # doctest: +SKIP
    Report('rips of 4 points in R^2', 0.7 MB)
    """
    from ._barcodes import Barcode
    require_page()
    source = _source_of(data, complex, options)
    bars = Barcode._of(source.request.run(_core.barcode), source.request.meta)
    return _page(bars, source, title)


class _Source(NamedTuple):
    """The data from which bars are computed, and the data that a page shows with them."""

    request: Request
    vertices: Any = None  # positions of the vertices in space
    has_axes: bool = False


_LISTED: dict[type, tuple[Callable[..., Any], Callable[..., Request]]] = {
    Simplices: (filtered, filtered_request), Boundary: (boundary, boundary_request)}


def _source_of(data: Any, complex: str | None, options: dict[str, Any]) -> _Source:
    if not isinstance(data, (Mesh, Simplices, Boundary)):
        return _Source(request_of(data, complex, options), None, isinstance(data, PointImage))
    if complex is not None:
        raise UsageError(f"complex: found {complex!r}, but a {type(data).__name__} is itself a "
                         "complex")
    if not isinstance(data, Mesh):
        function, request = _LISTED[type(data)]
        given = arguments_of(function, data[0], {**dict(zip(data._fields[1:], data[1:])), **options})
        return _Source(request({"loops": None, **given}))
    vertices = _arrays.as_points(data.vertices, "vertices")
    if data.values is None:
        return _Source(rips_request(arguments_of(rips, vertices, options)))
    return _Source(lower_star_request(arguments_of(
        lower_star, data.values, {"simplices": data.triangles, **options})), vertices)


def report_of_bars(bars: Barcode, X: Any, title: str, options: dict[str, Any]) -> Report:
    """See `Barcode.report`."""
    require_page()
    if X is None:
        if options:
            raise UsageError(f"{next(iter(options))}: does nothing without X")
        return _page(bars, None, title)
    meta = bars.meta
    kind = meta.get("complex")
    known = (*_KNOWN.get(str(kind), ()), *_OF_ALL)
    given = {name: meta[name] for name in known if meta.get(name) is not None}
    # The barcode stores these births as weights, but the diagonal of the data states them already.
    if given.get("diagonal") == "births":
        given.pop("weights", None)
    if isinstance(X, (Mesh, Simplices, Boundary)):
        kind = None
    elif kind not in _KNOWN:
        raise UsageError(f"X: found {type(X).__name__} for bars of complex {kind!r}, expected a Mesh, "
                         "Simplices or a Boundary, as ph.read returns them")
    for name, unknown in (("metric", "function"), ("weights", "given")):
        if given.get(name) == unknown and name not in options:
            raise UsageError(f"{name}: found none, expected the value with which the bars were computed")
    if "covering_radius" in meta and not {"subsample", "subsample_radius"} & {*given, *options}:
        raise UsageError("subsample: found none, expected the value with which the bars were computed")
    if isinstance(X, PointImage):
        given.pop("nan", None)
    if kind in ALPHA_VALUES:
        given["values"], kind = kind, "alpha"
    source = _source_of(X, kind, {**given, **options})
    for name in ("points", "shape"):
        found, expected = source.request.meta.get(name), meta.get(name)
        if expected is not None and found != expected:
            raise DataError(f"X: found {found} {'' if name == 'shape' else name}".rstrip() +
                            f", expected {expected}, as stored with the bars")
    return _page(bars, source, title)


def _page(bars: Barcode, source: _Source | None, title: str) -> Report:
    meta = origin_of(bars.meta)
    title = str(title) or " of ".join(filter(None, [str(meta.get("complex") or "barcode"),
                                                    description_of(meta)]))
    notes = []
    if meta["vertex_weights"]:
        notes.append(("Vertices enter late", meta["vertex_weights"]))
    if meta.get("approximation") is not None:
        notes.append(("Approximation", f"epsilon {meta['approximation']:g}: bars are born and die "
                      "later by a factor of 1 + epsilon at most"))
    arguments: tuple[Any, ...] = (None, _EMPTY_TASK, None, False)
    options: dict[str, Any] = {}
    if source is not None:
        arguments = (source.request.recipe, source.request.task, source.vertices, source.has_axes)
        options = source.request.options
    page = _run.run(_core.page_of_bars, bars._bars, *arguments, title, meta, notes, options=options)
    return Report._of(page, title)


_EMPTY_TASK = _core.Task(None, 0, 2, "auto", "auto", 0.0, "none", True, "none")
