# SPDX-License-Identifier: MIT
"""Functions that draw with matplotlib: they return the Axes and change no global settings."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import _hints, _options
from .._errors import UsageError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._barcode import Barcode


def plot(bars: Barcode, kind: Any, ax: Axes | None, dims: Any, noise: float | None,
         style: dict[str, Any]) -> Axes:
    """See `Barcode.plot`."""
    for name in style:
        hint = _hints.of_foreign_keyword(name, ["kind", "ax", "dims", "noise"])
        if hint:
            raise UsageError(f"{name}: plot has no such keyword{hint}")
    if dims is not None:
        bars = bars.filter(dim=_known_dims(bars, dims))
    draw = {"diagram": _diagram, "barcode": _lines, "betti": _betti}[
        _options.choice("kind", kind, ["diagram", "barcode", "betti"])]
    if ax is None:
        import matplotlib.pyplot
        _, ax = matplotlib.pyplot.subplots()
    if noise is not None:
        if kind != "diagram":
            raise UsageError(f"noise: does nothing for kind={kind!r}, expected kind='diagram'")
        noise = _options.real("noise", noise, "a finite number, at least 0", 0)
        low, high = _ends(bars).finite
        ax.fill_between([low, high], [low, high], [low + noise, high + noise], color="0.9",
                        linewidth=0, zorder=-1)
    draw(bars, ax, style)
    return ax


def _known_dims(bars: Barcode, dims: Any) -> list[int]:
    """The requested dimensions, which must be among the dimensions that were computed."""
    wanted = _options.one_or_several("dims", dims, 0)
    least, most = bars.meta.get("min_dim", 0), bars._top_dim
    if not all(least <= dim <= most for dim in wanted):
        raise _options.refuse("dims", dims, "no dimension, because there are no bars" if most < least
                              else f"{least}, the only dimension of these bars" if most == least
                              else f"dimensions of these bars, {least} to {most}")
    return wanted


class _Ends(NamedTuple):
    """The least and the largest finite value, and the positions at which -inf and inf are drawn."""

    finite: tuple[float, float]
    infinite: tuple[float, float]

    def place(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """The position at which each value is drawn."""
        return np.clip(values, *self.infinite)


def _ends(bars: Barcode) -> _Ends:
    return _ends_of(np.concatenate([bars.births, bars.deaths]))


def _ends_of(values: NDArray[np.float64]) -> _Ends:
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    room = 0.1 * ((high - low) or 1.0)
    return _Ends((low, high), (low - room, high + room))


def _dims(bars: Barcode) -> list[int]:
    return [int(dim) for dim in np.unique(bars.dims)]


def _label(bars: Barcode) -> str:
    return "Value of -f" if bars.meta.get("superlevel") else "Filtration value"


def _diagram(bars: Barcode, ax: Axes, style: dict[str, Any]) -> None:
    ends = _ends(bars)
    (low, high), (before, infinity) = ends
    ax.plot([low, high], [low, high], color="0.7", linewidth=1, zorder=0)
    line = {"color": "0.7", "linewidth": 1, "linestyle": "--", "zorder": 0}
    if (bars.deaths == np.inf).any():
        ax.axhline(infinity, **line)
        ax.annotate("∞", (low, infinity), textcoords="offset points", xytext=(0, 3))
    if (bars.deaths == -np.inf).any():
        ax.axhline(before, **line)
        ax.annotate("−∞", (high, before), textcoords="offset points", xytext=(0, 3))
    if (bars.births == -np.inf).any():
        ax.axvline(before, **line)
        ax.annotate("−∞", (before, high), textcoords="offset points", xytext=(3, 0))
    for dim in _dims(bars):
        births, deaths = ends.place(bars.dgm(dim)).T
        ax.scatter(births, deaths, **{"s": 16, "label": f"H{dim}", "color": f"C{dim % 10}",
                                      **style})
    ax.set_xlabel(f"Birth: {_label(bars).lower()}")
    ax.set_ylabel("Death")
    if len(bars):
        ax.legend()


def _lines(bars: Barcode, ax: Axes, style: dict[str, Any]) -> None:
    ends = _ends(bars)
    row = 0
    drawn = []
    for dim in _dims(bars):
        dgm = ends.place(bars.dgm(dim))
        ax.hlines(np.arange(row, row + len(dgm)), *dgm.T,
                  **{"label": f"H{dim}", "color": f"C{dim % 10}", **style})
        drawn.append(dgm)
        row += len(dgm)
    ax.set_yticks([])
    ax.set_xlabel(_label(bars))
    if len(bars):
        all_ends = np.concatenate(drawn)
        place = _empty_place(all_ends, (all_ends.min() + all_ends.max()) / 2)
        if place:
            ax.legend(loc=place)
        else:
            ax.legend(loc="upper left", bbox_to_anchor=(1, 1))


def _empty_place(ends: NDArray[np.float64], middle: float) -> str | None:
    """A corner without bars, in a picture whose bars are stacked from the bottom up, or None.

    matplotlib's own choice of a corner ignores the lines of the bars.
    """
    height = np.linspace(0, 1, len(ends)) if len(ends) > 1 else np.array([0.5])
    for side, is_there in (("right", ends[:, 1] > middle), ("left", ends[:, 0] < middle)):
        for place, centre in (("lower", 0.1), ("upper", 0.9), ("center", 0.5)):
            if not (is_there & (np.abs(height - centre) < 0.2)).any():
                return f"{place} {side}"
    return None


def _betti(bars: Barcode, ax: Axes, style: dict[str, Any]) -> None:
    ends = _ends(bars)
    values = np.unique(np.concatenate([bars.births, bars.deaths,
                                       [ends.finite[0], ends.infinite[1]]]))
    values = values[np.isfinite(values)]
    curves = bars.betti_curve(values)
    for dim in _dims(bars):
        ax.step(values, curves[dim], where="post", **{"label": f"H{dim}", "color": f"C{dim % 10}",
                                                **style})
    ax.set_xlabel(_label(bars))
    ax.set_ylabel("Betti number")
    if len(bars):
        ax.legend()


def plot_matching(a: NDArray[np.float64], b: NDArray[np.float64], pairs: NDArray[np.int64],
                  ax: Axes | None, style: dict[str, Any]) -> Axes:
    """See `Matching.plot`."""
    from matplotlib.collections import LineCollection
    if ax is None:
        import matplotlib.pyplot
        _, ax = matplotlib.pyplot.subplots()
    ends = _ends_of(np.concatenate([a.ravel(), b.ravel()]))
    ax.plot(ends.finite, ends.finite, color="0.7", linewidth=1, zorder=0)
    a, b = ends.place(a), ends.place(b)
    lines = []
    for i, j in pairs:
        points = [dgm[k] if k >= 0 else None for dgm, k in ((a, i), (b, j))]
        lines.append([np.repeat(points[1 - side].mean(), 2) if point is None else point
                      for side, point in enumerate(points)])
    ax.add_collection(LineCollection(lines, **{"colors": "0.4", "linewidths": 1, "zorder": 1,
                                               **style}))
    for dgm, name, marker in ((a, "a", "o"), (b, "b", "s")):
        ax.scatter(dgm[:, 0], dgm[:, 1], 16, label=name, marker=marker, zorder=2)
    ax.set(xlabel="Birth", ylabel="Death")
    ax.legend()
    return ax
