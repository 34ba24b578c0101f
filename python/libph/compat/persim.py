# SPDX-License-Identifier: MIT
"""persim's `plot_diagrams`, `bottleneck` and `wasserstein` on top of libph."""
from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _arrays, _distances, _options
from .._core import version as __version__
from .._errors import UsageError
from . import _missing

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["__version__", "bottleneck", "plot_diagrams", "wasserstein"]
__path__: list[str] = []  # like a package; the statement `import persim.images` gets a hint


def __getattr__(name: str) -> Any:
    return _missing.attribute(__name__, name, __all__)


@_options.with_hints
def bottleneck(dgm1: ArrayLike, dgm2: ArrayLike, matching: bool = False) -> Any:
    """The bottleneck distance between the bars that die; others are left out with a warning.

    Parameters
    ----------
    dgm1, dgm2 : array_like
        Rows birth, death; further columns are ignored.
    matching : bool
        If True, the matching is returned as well.

    Returns
    -------
    float or (float, ndarray)
        The matching has rows of an index in `dgm1`, an index in `dgm2`, and a cost; -1 is the
        diagonal. Indices count only bars that die.
    """
    a, b = _finite(dgm1, "dgm1"), _finite(dgm2, "dgm2")
    if not _options.flag("matching", matching):
        return _distances.bottleneck(a, b)
    return _with_costs(_distances.bottleneck_matching(a, b), np.inf)


@_options.with_hints
def wasserstein(dgm1: ArrayLike, dgm2: ArrayLike, matching: bool = False) -> Any:
    """The Wasserstein distance of order 1 with Euclidean ground norm between the bars that die; all
    other bars are left out with a warning.

    Parameters
    ----------
    dgm1, dgm2 : array_like
        Rows birth, death; further columns are ignored.
    matching : bool
        If True, the matching is returned as well.

    Returns
    -------
    float or (float, ndarray)
        The matching has rows of an index in `dgm1`, an index in `dgm2`, and a cost; -1 is the
        diagonal. Indices count only bars that die.
    """
    a, b = _finite(dgm1, "dgm1"), _finite(dgm2, "dgm2")
    if not _options.flag("matching", matching):
        return _distances.wasserstein(a, b, ground=2)
    return _with_costs(_distances.wasserstein_matching(a, b, ground=2), 2)


def _with_costs(matching: _distances.Matching, norm: float) -> tuple[float, NDArray[np.float64]]:
    costs = []
    for i, j in matching.pairs:
        if i >= 0 and j >= 0:
            costs.append(np.linalg.norm(matching.a[i] - matching.b[j], norm))
        else:
            birth, death = matching.a[i] if i >= 0 else matching.b[j]
            costs.append(np.linalg.norm([death - birth, death - birth], norm) / 2)
    return matching.distance, np.column_stack([matching.pairs, costs])


def _rows(dgm: ArrayLike, name: str) -> NDArray[np.float64]:
    rows = _arrays.as_float64(_arrays.as_array(dgm, name), name)
    if rows.size == 0:
        return np.empty((0, 2))
    if rows.ndim != 2 or rows.shape[1] < 2:
        raise UsageError(f"{name}: found an array of shape {rows.shape}, expected rows "
                         "(birth, death)")
    return rows


def _finite(dgm: ArrayLike, name: str) -> NDArray[np.float64]:
    rows = _rows(dgm, name)
    keep = np.isfinite(rows[:, 1])
    if not keep.all():
        warnings.warn(f"{name} has points with non-finite death times;ignoring those points",
                      stacklevel=3)
    return np.ascontiguousarray(rows[keep, :2])


@_options.with_hints
def plot_diagrams(diagrams: Any, plot_only: Any = None, title: str | None = None,
                  xy_range: Any = None, labels: Any = None, colormap: str = "default",
                  size: float = 20, ax_color: Any = "black", diagonal: bool = True,
                  lifetime: bool = False, legend: bool = True, show: bool = False,
                  ax: Axes | None = None) -> Axes:
    """Draws diagrams with matplotlib.

    Parameters
    ----------
    diagrams : ndarray or list of ndarray
        Rows birth, death; further columns are ignored.
    plot_only : list of int, optional
        Indices of the diagrams to draw.
    title : str, optional
    xy_range : list of float, optional
        The ends of the axes: left, right, bottom, top.
    labels : str or list of str, optional
        Labels for the legend.
    colormap : str
        A style of matplotlib, for this picture; "default": the current settings.
    size : float
        Size of the markers.
    ax_color : color
        Colour of the lines.
    diagonal : bool
        If True, the diagonal is drawn.
    lifetime : bool
        If True, death - birth is drawn instead of death.
    legend : bool
    show : bool
        If True, `matplotlib.pyplot.show` is called.
    ax : Axes, optional
        The axes to draw on. Default: the current axes.

    Returns
    -------
    Axes
    """
    import matplotlib.pyplot as plt
    from contextlib import nullcontext
    dgms = list(diagrams) if isinstance(diagrams, (list, tuple)) else [diagrams]
    names = [f"$H_{{{k}}}$" for k in range(len(dgms))] if labels is None else labels
    if plot_only is not None and len(plot_only):
        plot_only = [_options.whole("plot_only", k, -len(dgms), len(dgms) - 1) for k in plot_only]
        dgms = [dgms[k] for k in plot_only]
        names = [names[k] for k in plot_only] if isinstance(names, list) else names
    if not isinstance(names, list):
        names = [names] * len(dgms)
    rows = [_rows(dgm, f"diagrams[{k}]")[:, :2] for k, dgm in enumerate(dgms)]
    with nullcontext() if colormap == "default" else plt.style.context(colormap):
        ax = ax or plt.gca()
        _draw(ax, rows, names, xy_range, size, ax_color, diagonal and not lifetime, lifetime)
        if title is not None:
            ax.set_title(title)
        if legend and rows:
            ax.legend(loc="lower right")
    if show:
        plt.show()
    return ax


def _draw(ax: Axes, dgms: list[NDArray[np.float64]], names: list[str], xy_range: Any, size: float,
          color: Any, diagonal: bool, lifetime: bool) -> None:
    numbers = np.concatenate([np.zeros(0), *(dgm.ravel() for dgm in dgms)])
    finite = numbers[np.isfinite(numbers)]
    if xy_range:
        ends = _options.several("xy_range", xy_range, "left, right, bottom, top")
        if len(ends) != 4:
            raise _options.refuse("xy_range", xy_range, "left, right, bottom, top")
        left, right, bottom, top = (_options.real("xy_range", end) for end in ends)
    else:
        low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 1.0)
        room = (high - low) / 5 or 1.0
        left = bottom = low - room / 2
        right = top = high + room
    if lifetime:
        height = top - bottom
        bottom, top = -height / 20, height * 19 / 20
        ax.plot([left, right], [0, 0], color=color)
        dgms = [np.column_stack([dgm[:, 0], dgm[:, 1] - dgm[:, 0]]) for dgm in dgms]
    if diagonal:
        ax.plot([left, right], [left, right], "--", color=color)
    if np.isinf(numbers).any():
        infinity = bottom + (top - bottom) * 0.95
        ax.plot([left, right], [infinity, infinity], "--", color="black", label=r"$\infty$")
        dgms = [np.where(np.isinf(dgm), infinity, dgm) for dgm in dgms]
    for dgm, name in zip(dgms, names):
        ax.scatter(dgm[:, 0], dgm[:, 1], size, label=name, edgecolor="none")
    ax.set(xlim=(left, right), ylim=(bottom, top), xlabel="Birth",
           ylabel="Lifetime" if lifetime else "Death")
    ax.set_aspect("equal", "box")
