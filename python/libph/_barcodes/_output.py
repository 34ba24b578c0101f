# SPDX-License-Identifier: MIT
"""Barcodes as arrays and tables, files, pictures, pages and text."""
from __future__ import annotations

import html
import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from .. import _core, _options, _run
from .._results import description_of, origin_of, spaced
from . import _layouts, _places

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

    from .._report import Report
    from ._barcode import Barcode


@_options.with_hints
class Output:
    """The methods of `Barcode` that return or write the bars in other forms."""

    __slots__ = ()

    @property
    def _barcode(self) -> Barcode:
        return cast("Barcode", self)

    def to_numpy(self, layout: str = "dim-birth-death") -> Any:
        """The bars in the layout of another program.

        Parameters
        ----------
        layout : {"dim-birth-death", "giotto", "ripser", "gudhi"}
            "dim-birth-death": rows dim, birth, death. "giotto": rows birth, death, dim, as in
            giotto-tda. "ripser": a list of arrays as in ripser.py, with H0 sorted by death and
            other dimensions by descending birth. "gudhi": a list of (dim, (birth, death)) as in
            GUDHI, with dimensions descending and the longest bars first. `from_dgms` takes all of
            them.
        """
        return _layouts.in_layout(self._barcode, layout)

    def to_pandas(self, places: bool = False) -> pandas.DataFrame:
        """A table with the columns dim, birth, death, and p if the bars have p-values.

        Parameters
        ----------
        places : bool
            Add columns that say where the hole of each bar is. For bars of points or simplices:
            `birth_vertices` and `death_vertices`, the vertices of its cells. For points with
            coordinates and ``representatives="cycles"``, also the mean place of the cells of the
            bar's cycle (`centroid_0`, … by coordinate; NaN for components), unless the space is
            periodic or the bars were read from a file. For images, which need
            ``representatives="voxels"``: the voxels whose values are the birth and the death
            (`birth_0`, `birth_1`, … by axis, and `death_0`, …), the mean place of the bar's voxels
            or of its cycle (`centroid_0`, …) and the number of its voxels (`voxels`, 0 for a
            cycle). If the image has an `affine`, also the same places in its space (`birth_x`,
            `birth_y`, `birth_z`, …) and, in three axes, the `volume` of the voxels in the unit of
            the `affine`, cubed. The place of a death is NaN or None if the bar never dies.
        """
        import pandas
        bars = self._barcode
        columns: dict[str, Any] = dict(zip(("dim", "birth", "death"), map(np.array, bars._arrays)))
        if bars.p_values is not None:
            columns["p"] = bars.p_values
        if _options.flag("places", places):
            columns |= _places.columns_of_places(bars)
        return pandas.DataFrame(columns)

    def save(self, path: str | os.PathLike[str], format: str | None = None) -> None:
        """Writes the barcode to a file, completely or not at all.

        Parameters
        ----------
        path : path
            The file; its extension selects the format: .csv, .json, .ripser, .pers, .dipha or
            .npy. Only .json stores the whole barcode, with cells, chains, voxels and `meta`.
        format : str, optional
            "csv", "json", "ripser", "pers", "dipha" or "npy".
        """
        bars = self._barcode
        _run.run(_core.save, bars._bars, _options.path_of(path),
                 None if format is None else str(format), origin_of(bars.meta), options={})

    def plot(self, kind: str = "diagram", ax: Axes | None = None, *,
             dims: int | Iterable[int] | None = None, noise: float | None = None,
             **style: Any) -> Axes:
        """Draws the barcode with matplotlib.

        A notebook shows the picture; elsewhere ``matplotlib.pyplot.show()`` opens a window, and
        ``axes.figure.savefig(path)`` writes a file.

        Parameters
        ----------
        kind : {"diagram", "barcode", "betti"}
            "diagram": points birth, death. "barcode": lines from birth to death. "betti": Betti
            numbers over the filtration value.
        ax : Axes, optional
            The axes to draw on. Default: the axes of a new figure.
        dims : int or iterable of int, optional
            Show only these dimensions. Default: all.
        noise : float, optional
            For a diagram: draws a grey band along the diagonal that covers bars of at most this
            length. For bars of `rips`, use ``4 * ph.confidence_radius(X)``.
        **style
            Passed on to the drawing function: `scatter`, `hlines` or `step`.

        Returns
        -------
        Axes
        """
        from ._plots import plot
        return plot(self._barcode, kind, ax, dims, noise, style)

    def report(self, X: Any = None, *, title: str = "", **options: Any) -> Report:
        """An interactive page that links diagram, barcode and data.

        Parameters
        ----------
        X : optional
            The data from which the bars were computed: the page shows them with cells, chains and
            the merge tree. For a mesh or simplices, pass the result of `read`. Default: only the
            bars are shown.
        title : str
            Title of the page. Default: a description of the data.
        **options
            Keywords of the computation that the barcode does not store: an array of `weights`, a
            function as `metric`. For a barcode from a file, all keywords whose values were not the
            defaults.

        Returns
        -------
        Report

        Raises
        ------
        NotBuiltIn
            If libph was built without npm.
        DataError
            If the bars do not belong to X.
        """
        from .. import _report
        return _report.report_of_bars(self._barcode, X, title, options)

    def __repr__(self) -> str:
        return _in_words(self._barcode)

    def _repr_html_(self) -> str:
        bars = self._barcode
        svg = _run.run(bars._bars.svg, "", bool(bars.meta.get("superlevel")), options={})
        return f"<div>{html.escape(repr(self))}<br>{svg[svg.find('<svg'):]}</div>"


def _in_words(bars: Barcode) -> str:
    """The first line that a user sees: the kind of data and the number of bars."""
    meta = bars.meta
    name = " of ".join(filter(None, [str(meta.get("complex") or "barcode"),
                                     description_of(meta)]))
    counts: list[str] = []
    for dim, count in zip(*(x.tolist() for x in np.unique(bars.dims, return_counts=True))):
        noun = "" if counts else " bar" if count == 1 else " bars"
        counts.append(f"{spaced(count)}{noun} of H{dim}")
    text = f"Barcode({name}, field {meta.get('field', 2)}: {', '.join(counts) or 'no bars'}"
    dim = int(bars.dims[-1]) if len(bars) else 0
    if dim > 0:
        bar = bars[bars.longest(dim)]
        text += f", longest [{bar.birth:.6g}, {bar.death:.6g})"
    return text + ")"
