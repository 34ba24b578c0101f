# SPDX-License-Identifier: MIT
"""The trees of a clustering: as arrays, tables, graphs and pictures."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ... import _options
from ..._clusters import numbered
from ..._errors import UsageError
from .. import _missing
from ._drawing import Colours, capped, in_the_plane, places_of, steps_of, without_frame

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

__all__ = ["CondensedTree", "MinimumSpanningTree", "SingleLinkageTree"]

_Numbers = NDArray[np.float64]
_Integers = NDArray[np.int64]


def __getattr__(name: str) -> Any:
    return _missing.attribute(__name__, name, __all__)


@_options.with_hints
class CondensedTree:
    """The clusters, and the points that leave them.

    Parameters
    ----------
    condensed_tree_array : ndarray
        One row per point and per cluster other than the root: `parent`, `child`, `lambda_val` and
        `child_size`. Points are 0 to n - 1, and the root is n. Clusters are numbered from the root
        down, level by level.
    chosen : ndarray
        The number of the cluster of each label.
    """

    def __init__(self, condensed_tree_array: NDArray[np.void], chosen: _Integers) -> None:
        self._raw_tree = condensed_tree_array
        self._chosen = chosen

    def _select_clusters(self) -> list[int]:
        chosen: list[int] = self._chosen.tolist()
        return chosen

    def to_numpy(self) -> NDArray[np.void]:
        """The rows."""
        return self._raw_tree.copy()

    def to_pandas(self) -> pandas.DataFrame:
        """The rows as a table."""
        import pandas
        return pandas.DataFrame(self._raw_tree)

    def to_networkx(self) -> Any:
        """The tree as a `networkx.DiGraph`, whose edges lead from parents to children.

        The `weight` of an edge is the lambda value at which the child leaves its parent, and the
        `size` of a node is its number of points.
        """
        import networkx
        tree = self._raw_tree
        graph = networkx.DiGraph()
        graph.add_weighted_edges_from(zip(*(tree[name].tolist() for name in
                                            ("parent", "child", "lambda_val"))))
        networkx.set_node_attributes(
            graph, dict(zip(tree["child"].tolist(), tree["child_size"].tolist())), "size")
        return graph

    def get_plot_data(self, leaf_separation: float = 1, log_size: bool = False,
                      max_rectangle_per_icicle: int = 20) -> dict[str, Any]:
        """What `plot` draws.

        Parameters
        ----------
        leaf_separation : float
            The distance between leaves, as a share of the width of the root.
        log_size : bool
            If True, widths are the logarithms of numbers of points.
        max_rectangle_per_icicle : int
            The greatest number of bars per cluster.

        Returns
        -------
        dict
            `bar_centers`, `bar_tops`, `bar_bottoms`, `bar_widths`: a number for each bar, where a
            top is a height above the bottom. `line_xs`, `line_ys`: two ends for each line from a
            cluster to one of its children. `cluster_bounds`: left, right, bottom and top of each
            cluster. Infinite lambda values are drawn a tenth above the largest finite one.
        """
        width: Any = np.log if _options.flag("log_size", log_size) else np.asarray
        most = _options.whole("max_rectangles_per_icicle", max_rectangle_per_icicle, 1)
        tree, root = self._raw_tree, int(self._raw_tree["parent"].min())
        lambdas = capped(tree["lambda_val"])
        order = np.lexsort([lambdas, tree["parent"]])
        parents, starts = np.unique(tree["parent"][order], return_index=True)
        rows_of = dict(zip(parents.tolist(), np.split(order, starts[1:])))
        is_cluster = tree["child"] >= root
        children = {c: tree["child"][rows[is_cluster[rows]]].tolist()
                    for c, rows in rows_of.items()}
        size = {root: root, **dict(zip(tree["child"][is_cluster].tolist(),
                                       tree["child_size"][is_cluster].tolist()))}
        bottom = {root: 0.0, **dict(zip(tree["child"][is_cluster].tolist(),
                                        lambdas[is_cluster].tolist()))}
        x = places_of(root, children, leaf_separation * float(width(root)))
        bars: list[tuple[float, float, float, float]] = []
        bounds = {}
        for c, rows in rows_of.items():
            values, first = np.unique(lambdas[rows], return_index=True)
            leaving = np.add.reduceat(tree["child_size"][rows], first)
            # The width just below each value: at least one point, because the logarithm needs it.
            widths = width(np.maximum(size[c] - np.cumsum(leaving) + leaving, 1))
            ends = steps_of(widths, most)
            tops, below = values[ends], np.append(bottom[c], values[ends[:-1]])
            bars += zip([x[c]] * len(ends), tops - below, below,
                        widths[np.append(0, ends[:-1] + 1)])
            half = float(width(size[c])) / 2
            bounds[c] = [x[c] - half, x[c] + half, bottom[c], float(values[-1])]
        lines = [(c, child) for c in rows_of for child in children[c]]
        names = ["bar_centers", "bar_tops", "bar_bottoms", "bar_widths"]
        return {**dict(zip(names, map(list, zip(*bars)))),
                "line_xs": [[x[c], bounds[child][0 if x[child] < x[c] else 1]]
                            for c, child in lines],
                "line_ys": [[bottom[child]] * 2 for _, child in lines],
                "cluster_bounds": bounds}

    def plot(self, leaf_separation: float = 1, cmap: Any = "viridis", select_clusters: bool = False,
             label_clusters: bool = False, selection_palette: Any = None, axis: Axes | None = None,
             colorbar: bool = True, log_size: bool = False,
             max_rectangles_per_icicle: int = 20) -> Axes:
        """Draws the tree from the top down: a bar is as wide as the cluster has points.

        Parameters
        ----------
        leaf_separation, log_size, max_rectangles_per_icicle
            As in `get_plot_data`.
        cmap : str or colormap
            Colours of the bars by their widths; "none": black.
        select_clusters : bool
            If True, an oval surrounds each chosen cluster.
        label_clusters : bool
            If True, the label of each chosen cluster is written beside its oval.
        selection_palette : list of colors, optional
            The colour of each oval, by label. Default: red.
        axis : Axes, optional
            The axes to draw on. Default: the current axes.
        colorbar : bool

        Returns
        -------
        Axes
        """
        import matplotlib.pyplot as plt
        from matplotlib.patches import Ellipse
        data = self.get_plot_data(leaf_separation, log_size, max_rectangles_per_icicle)
        axis = axis or plt.gca()
        widths = np.asarray(data["bar_widths"])
        colours = Colours(cmap, widths)
        axis.bar(data["bar_centers"], data["bar_tops"], bottom=data["bar_bottoms"], width=widths,
                 color=colours.of(widths), align="center", linewidth=0)
        for xs, ys in zip(data["line_xs"], data["line_ys"]):
            axis.plot(xs, ys, color="black", linewidth=1)
        height = max((b[3] for b in data["cluster_bounds"].values()), default=0.0)
        for label, c in enumerate(self._select_clusters() if select_clusters else []):
            left, right, bottom, top = data["cluster_bounds"][c]
            centre = ((left + right) / 2, (bottom + top) / 2)
            palette = selection_palette
            axis.add_artist(Ellipse(
                centre, 2 * (right - left), max(1.2 * (top - bottom), 0.05 * height),
                facecolor="none", linewidth=2,
                edgecolor="r" if palette is None or len(palette) <= label else palette[label]))
            if label_clusters:
                axis.annotate(str(label), (right + (right - left) / 2, centre[1]), ha="left",
                              va="center")
        colours.add_bar(colorbar, axis, "log(Number of points)" if log_size else "Number of points")
        axis.invert_yaxis()
        return without_frame(axis, "$\\lambda$ value")


@_options.with_hints
class SingleLinkageTree:
    """The merges of components.

    Parameters
    ----------
    linkage : ndarray
        The linkage matrix in the format of ``scipy.cluster.hierarchy``.
    """

    def __init__(self, linkage: _Numbers) -> None:
        self._linkage = linkage

    def to_numpy(self) -> _Numbers:
        """The linkage matrix."""
        return self._linkage.copy()

    def to_pandas(self) -> pandas.DataFrame:
        """The merges as a table: `parent`, `left_child`, `right_child`, `distance`, `size`."""
        import pandas
        n = len(self._linkage) + 1
        left, right, distance, size = self._linkage.T
        return pandas.DataFrame({"parent": np.arange(n, 2 * n - 1), "left_child": left,
                                 "right_child": right, "distance": distance, "size": size})

    def to_networkx(self) -> Any:
        """The merges as a `networkx.DiGraph`, whose edges lead from parents to children.

        The `weight` of an edge is the distance of the merge, and the `size` of a component is its
        number of points.
        """
        import networkx
        graph = networkx.DiGraph()
        rows = list(enumerate(self._linkage.tolist(), len(self._linkage) + 1))
        for parent, (left, right, distance, _) in rows:
            graph.add_edge(parent, int(left), weight=distance)
            graph.add_edge(parent, int(right), weight=distance)
        networkx.set_node_attributes(graph, {parent: row[3] for parent, row in rows}, "size")
        return graph

    def get_clusters(self, cut_distance: float, min_cluster_size: int = 5) -> _Integers:
        """The components of merges below a distance, as labels 0, 1, … in the order of their first
        points.

        Parameters
        ----------
        cut_distance : float
        min_cluster_size : int
            Points of smaller components are noise, with label -1.
        """
        cut = _options.real("cut_distance", cut_distance)
        least = _options.whole("min_cluster_size", min_cluster_size, 1)
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import connected_components
        n = len(self._linkage) + 1
        rows = np.flatnonzero(self._linkage[:, 2] < cut)
        child = self._linkage[rows, :2].astype(np.int64).ravel()
        graph = coo_array((np.ones(len(child), dtype=np.int8), (child, np.repeat(n + rows, 2))),
                          shape=(2 * n - 1, 2 * n - 1))
        component = connected_components(graph, directed=False)[1][:n]
        return numbered(component, np.bincount(component)[component] >= least)

    def plot(self, axis: Axes | None = None, truncate_mode: str | None = None, p: int = 0,
             vary_line_width: bool = True, cmap: Any = "viridis", colorbar: bool = True) -> Axes:
        """Draws the dendrogram. Merges at infinity are a tenth above the highest other one.

        Parameters
        ----------
        axis : Axes, optional
            The axes to draw on. Default: the current axes.
        truncate_mode : {None, "none", "lastp", "level", "mtica"}
            "lastp": only the last `p` - 1 merges are drawn. "level" or "mtica": only merges that
            are at most `p` merges away from the last one.
        p : int
        vary_line_width : bool
            If True, a line is wider if its component has more points.
        cmap : str or colormap
            Colours of the lines by numbers of points; "none": black.
        colorbar : bool

        Returns
        -------
        Axes
        """
        import matplotlib.pyplot as plt
        from matplotlib.collections import LineCollection
        mode = _options.choice("truncate_mode", truncate_mode,
                               [None, "none", "lastp", "level", "mtica"])
        linkage, n = self._linkage, len(self._linkage) + 1
        level = np.zeros(2 * n - 1, dtype=np.int64)
        for row in range(n - 2, -1, -1):
            level[linkage[row, :2].astype(np.int64)] = level[n + row] + 1
        rows = np.arange(n - 1)
        if mode == "lastp":
            rows = rows[max(0, n - _options.whole("p", p, 1)):]
        elif mode in ("level", "mtica"):
            rows = rows[level[n:] <= _options.whole("p", p, 0)]
        children = {n + row: linkage[row, :2].astype(np.int64).tolist() for row in rows.tolist()}
        x = places_of(2 * n - 2, children, 10)
        y = np.append(np.zeros(n), capped(linkage[:, 2]))
        y[~np.isin(np.arange(2 * n - 1), n + rows)] = 0
        size = np.append(np.ones(n), linkage[:, 3])
        down = [(node, child) for node, pair in children.items() for child in pair]
        sizes = size[[child for _, child in down]] if vary_line_width else np.ones(len(down))
        colours = Colours(cmap, np.log2(sizes))
        axis = axis or plt.gca()
        axis.add_collection(LineCollection(
            [[(x[child], y[node]), (x[child], y[child])] for node, child in down],
            colors=colours.of(np.log2(sizes)), linewidths=np.log2(1 + sizes), capstyle="butt"))
        axis.add_collection(LineCollection(
            [[(x[a], y[node]), (x[b], y[node])] for node, (a, b) in children.items()],
            colors="black", linewidths=1.0))
        axis.autoscale_view()
        colours.add_bar(colorbar, axis, "log(Number of points)")
        return without_frame(axis, "distance")


@_options.with_hints
class MinimumSpanningTree:
    """The spanning forest of the mutual reachability distances.

    Parameters
    ----------
    mst : ndarray
        Rows of two points and the value of their edge, by ascending value.
    data : ndarray or None
        The points; None if only their distances are known.
    """

    def __init__(self, mst: _Numbers, data: Any) -> None:
        self._mst = mst
        self._data = data

    def to_numpy(self) -> _Numbers:
        """The rows."""
        return self._mst.copy()

    def to_pandas(self) -> pandas.DataFrame:
        """The edges as a table: `from`, `to`, `distance`."""
        import pandas
        return pandas.DataFrame({"from": self._mst[:, 0].astype(np.int64),
                                 "to": self._mst[:, 1].astype(np.int64),
                                 "distance": self._mst[:, 2]})

    def to_networkx(self) -> Any:
        """The forest as a `networkx.Graph`.

        The `weight` of an edge is its value, and `data` of a node are the coordinates of the point,
        if they are known.
        """
        import networkx
        graph = networkx.Graph()
        graph.add_weighted_edges_from((int(u), int(v), value) for u, v, value in self._mst.tolist())
        if self._data is not None:
            networkx.set_node_attributes(graph, dict(enumerate(map(tuple, self._data))), "data")
        return graph

    def plot(self, axis: Axes | None = None, node_size: float = 40, node_color: Any = "k",
             node_alpha: float = 0.8, edge_alpha: float = 0.5, edge_cmap: Any = "viridis_r",
             edge_linewidth: float = 2, vary_line_width: bool = True, colorbar: bool = True
             ) -> Axes:
        """Draws points and edges. scikit-learn's t-SNE projects points with three or more
        coordinates.

        Parameters
        ----------
        axis : Axes, optional
            The axes to draw on. Default: the current axes.
        node_size, node_color, node_alpha, edge_alpha, edge_cmap, edge_linewidth
            How points and edges look; edges are coloured by their values.
        vary_line_width : bool
            If True, shorter edges are wider.
        colorbar : bool

        Returns
        -------
        Axes
        """
        if self._data is None:
            raise UsageError("plot: found distances, expected points; to_networkx() has the graph")
        import matplotlib.pyplot as plt
        from matplotlib.collections import LineCollection
        axis = axis or plt.gca()
        places, values = in_the_plane(np.asarray(self._data, dtype=np.float64)), self._mst[:, 2]
        width: Any = edge_linewidth
        if vary_line_width and len(values):
            least = values[values > 0].min(initial=values.max())
            width = edge_linewidth * (1 + np.log(values.max() / np.maximum(values, least or 1.0)))
        lines = LineCollection(places[self._mst[:, :2].astype(np.int64)], linewidths=width,
                               cmap=edge_cmap, alpha=edge_alpha)
        lines.set_array(values)
        axis.add_collection(lines)
        axis.scatter(*places.T, c=node_color, alpha=node_alpha, s=node_size)
        axis.set(xticks=[], yticks=[])
        if colorbar:
            axis.figure.colorbar(lines, ax=axis).ax.set_ylabel("Mutual reachability distance")
        return axis
