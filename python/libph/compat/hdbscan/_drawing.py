# SPDX-License-Identifier: MIT
"""Places and colours of what the trees of a clustering draw."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_Numbers = NDArray[np.float64]
_Integers = NDArray[np.int64]


def capped(values: _Numbers) -> _Numbers:
    """The values, where those that are infinite are a tenth above the largest finite one."""
    largest = values[np.isfinite(values)].max(initial=0)
    return np.where(np.isinf(values), 1.1 * largest or 1.0, values)


def places_of(root: int, children: dict[int, list[int]], distance: float) -> dict[int, float]:
    """The place of each node from left to right: leaves at equal distances, and other nodes in the
    middle between their first and last children."""
    order, stack = [], [root]
    while stack:
        order.append(stack.pop())
        stack.extend(reversed(children.get(order[-1], [])))
    x: dict[int, float] = {}
    leaves = [node for node in order if not children.get(node)]
    x.update(zip(leaves, distance * np.arange(len(leaves))))
    for node in reversed(order):
        if node not in x:
            x[node] = (x[children[node][0]] + x[children[node][-1]]) / 2
    return x


def steps_of(widths: _Numbers, most: int) -> _Integers:
    """The places at which bars of nearly the same width end, at most `most` of them."""
    level = (widths[0] - widths) * most / ((widths[0] - widths[-1]) or 1.0)
    level = np.minimum(level.astype(np.int64), most - 1)
    return np.append(np.flatnonzero(np.diff(level)), len(widths) - 1)


def in_the_plane(points: _Numbers) -> _Numbers:
    """Two coordinates per point; t-SNE projects points that have more."""
    if points.shape[1] <= 2:
        return np.pad(points, [(0, 0), (0, 2 - points.shape[1])])
    from sklearn.decomposition import PCA
    from sklearn.manifold import TSNE
    if points.shape[1] > 32:
        points = PCA(n_components=min(32, len(points))).fit_transform(points)
    return np.asarray(TSNE(perplexity=min(30.0, len(points) / 3)).fit_transform(points))


class Colours:
    """Colours by size, or black."""

    def __init__(self, cmap: Any, sizes: _Numbers) -> None:
        self._mappable = None
        if not (isinstance(cmap, str) and cmap == "none"):
            from matplotlib.cm import ScalarMappable
            from matplotlib.colors import Normalize
            self._mappable = ScalarMappable(Normalize(0, sizes.max(initial=0) or 1.0), cmap)
            self._mappable.set_array(sizes)

    def of(self, sizes: _Numbers) -> Any:
        """The colours of these sizes."""
        return "black" if self._mappable is None else self._mappable.to_rgba(sizes)

    def add_bar(self, is_wanted: bool, axis: Axes, text: str) -> None:
        """Adds a colour bar with a label, if there are colours and it is wanted."""
        if is_wanted and self._mappable is not None:
            axis.figure.colorbar(self._mappable, ax=axis).ax.set_ylabel(text)


def without_frame(axis: Axes, label: str) -> Axes:
    """The axes with only the vertical one, and its label."""
    axis.set(xticks=[], ylabel=label)
    for side in ("right", "top", "bottom"):
        axis.spines[side].set_visible(False)
    return axis
