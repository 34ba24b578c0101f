# SPDX-License-Identifier: MIT
"""Clusters by density: the cluster trees of HDBSCAN*."""
from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core, _options, _results, _run
from ._estimate import request_of
from ._trees import MergeTree, check_names, merge_tree

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._run import RunOptions

SCALES = ["inverse", "linear", "log"]
METHODS = ["eom", "leaf"]
_CLUSTER = np.dtype([("parent", np.int64), ("top", np.float64), ("bottom", np.float64),
                     ("least", np.float64), ("size", np.int64), ("mass", np.float64)])


class Clusters(NamedTuple):
    """A partition of the points into clusters and noise; see `ClusterTree.select`.

    Attributes
    ----------
    labels : ndarray
        The cluster of each point, 0, 1, … in the order of the first point of each cluster; -1 is
        noise.
    probabilities : ndarray
        How long each point stays in its cluster, as a share of the time until the cluster splits or
        ends, at most 1; 0 for noise.
    chosen : ndarray
        The row of each cluster in `ClusterTree.clusters`, by label.
    """

    labels: NDArray[np.int64]
    probabilities: NDArray[np.float64]
    chosen: NDArray[np.int64]

    def __repr__(self) -> str:
        return _results.in_brief(self)


@_options.with_hints
class ClusterTree:
    """The components with at least `min_size` points, and how they split as the value falls.

    This is the condensed tree of HDBSCAN* (Campello, Moulavi, Sander, Density-based clustering
    based on hierarchical density estimates, 2013). Edges of equal value are removed at once, so
    the tree does not depend on the order of the points.

    Attributes
    ----------
    edges : ndarray
        The edges of a spanning forest, (m, 2).
    values : ndarray
        The value of each edge, ascending.
    births : ndarray
        The value at which each point enters, (n,).
    min_size : int
        Components with fewer points are not clusters.
    scale : str
        "inverse", "linear" or "log"; see `cluster_tree`.
    """

    def __init__(self, births: NDArray[np.float64], values: NDArray[np.float64],
                 edges: NDArray[np.int64], min_size: int, scale: str,
                 tree: _core.ClusterTree) -> None:
        self.births = births
        self.values = values
        self.edges = edges
        self.min_size = min_size
        self.scale = scale
        self._tree = tree

    def __reduce__(self) -> tuple[Any, ...]:
        return (of_forest, (self.births, self.values, self.edges, self.min_size, self.scale))

    def __len__(self) -> int:
        return len(self.births)

    def __repr__(self) -> str:
        return (f"ClusterTree({len(self)} points, {len(self.clusters)} clusters of at least "
                f"{self.min_size})")

    @property
    def clusters(self) -> NDArray[np.void]:
        """One row per cluster, children before their parents, the root last.

        The fields are `parent`, the row of the cluster that it splits from, -1 for the root; `top`,
        the value at which it joins other clusters, inf for the root; `bottom`, the value at which
        it splits or ends; `least`, the least bottom of the cluster and all clusters inside it;
        `size`, the number of its points just below `top`; and `mass`, its stability.
        """
        tree = self._tree
        columns = [np.asarray(column) for column in (
            tree.parents, tree.tops, tree.bottoms, tree.least, tree.sizes, tree.masses)]
        table = np.empty(len(columns[0]), dtype=_CLUSTER)
        for name, column in zip(_CLUSTER.names or (), columns):
            table[name] = column
        return table

    @property
    def cluster_of(self) -> NDArray[np.int64]:
        """For each point, the row of the cluster that it leaves."""
        return np.asarray(self._tree.cluster_of)

    @property
    def leaves_at(self) -> NDArray[np.float64]:
        """For each point, the value at which it leaves its cluster."""
        return np.asarray(self._tree.leaves_at)

    @property
    def merge_tree(self) -> MergeTree:
        """All merges of components, whatever their sizes are."""
        u, v = np.ascontiguousarray(self.edges.T)
        tree = _run.run(_core.merge_tree_of_forest, self.births, u, v, self.values, options={})
        return MergeTree(tree, None)

    def with_min_size(self, min_size: int, **run: Unpack[RunOptions]) -> ClusterTree:
        """The same tree with another least size, which must be at least the first one.

        This takes about a hundredth of the time of a new tree.
        """
        _run.check_names("with_min_size", run)
        tree = _run.run(self._tree.with_min_size, _options.whole("min_size", min_size, 2),
                        options=dict(run))
        return ClusterTree(self.births, self.values, self.edges, min_size, self.scale, tree)

    def select(self, method: str = "eom", *, epsilon: float = 0.0, allow_single: bool = False,
               max_size: int | None = None) -> Clusters:
        """Chooses clusters, none of them inside another.

        Parameters
        ----------
        method : {"eom", "leaf"}
            "eom": the clusters with the largest total stability. "leaf": the clusters without
            clusters inside them.
        epsilon : float
            A cluster that joins others at a value below `epsilon` is replaced by the first cluster
            around it that does not.
        allow_single : bool
            If True, the root may be chosen, which holds all points.
        max_size : int, optional
            With "eom", larger clusters are not chosen.

        Returns
        -------
        Clusters
        """
        return _clusters_of(self._tree.select(
            *_selection(method, epsilon, allow_single, max_size)))

    def _locate(self, points: NDArray[np.int64], values: NDArray[np.float64],
                method: str = "eom", *, epsilon: float = 0.0, allow_single: bool = False,
                max_size: int | None = None) -> Clusters:
        """The clusters of added points. `points` has the point of the tree that each one joins, -1
        if there is none, and `values` the value at which it does."""
        return _clusters_of(self._tree.locate(
            np.ascontiguousarray(points, dtype=np.int64),
            np.ascontiguousarray(values, dtype=np.float64),
            *_selection(method, epsilon, allow_single, max_size)))

    def cut(self, value: float, *, min_size: int = 1) -> NDArray[np.int64]:
        """The components at a value, as labels 0, 1, … in the order of their first points.

        With core distances as births, this is DBSCAN* with the radius `value`.

        Parameters
        ----------
        value : float
            Points that enter later, and edges with larger values, are left out.
        min_size : int
            Points of smaller components are noise, with label -1, as are points that have not
            entered.
        """
        value = _options.real("value", value)
        min_size = _options.whole("min_size", min_size, 1)
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import connected_components
        n = len(self)
        u, v = self.edges[:int(np.searchsorted(self.values, value, side="right"))].T
        graph = coo_array((np.ones(len(u), dtype=np.int8), (u, v)), shape=(n, n))
        _, component = connected_components(graph, directed=False)
        sizes = np.bincount(component, minlength=1)
        return numbered(component, (self.births <= value) & (sizes[component] >= min_size))

    def outlier_scores(self) -> NDArray[np.float64]:
        """The GLOSH score of each point, from 0 to 1.

        It is 1 minus the share of its own time in the time of the last point of the cluster that it
        leaves (Campello, Moulavi, Zimek, Sander, Hierarchical density estimates for data
        clustering, visualization, and outlier detection, 2015).
        """
        return np.asarray(self._tree.outlier_scores())


def _selection(method: str, epsilon: float, allow_single: bool, max_size: int | None
               ) -> tuple[str, float, bool, int]:
    """The options of a choice of clusters, checked."""
    return (_options.choice("method", method, METHODS),
            _options.real("epsilon", epsilon, "a number, at least 0", 0),
            _options.flag("allow_single", allow_single),
            0 if max_size is None else _options.whole("max_size", max_size, 1))


def _clusters_of(blocks: tuple[Any, Any, Any]) -> Clusters:
    return Clusters(*(np.asarray(block) for block in blocks))


def numbered(component: NDArray[Any], is_kept: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Labels 0, 1, … in the order of the first points of the components; -1 where `is_kept` is
    False."""
    labels = np.full(len(component), -1, dtype=np.int64)
    _, first, inverse = np.unique(component[is_kept], return_index=True, return_inverse=True)
    labels[is_kept] = np.argsort(np.argsort(first))[inverse.ravel()]
    return labels


def of_forest(births: NDArray[np.float64], values: NDArray[np.float64], edges: NDArray[np.int64],
              min_size: int, scale: str, options: dict[str, Any] | None = None) -> ClusterTree:
    """The cluster tree of a spanning forest."""
    tree = _run.run(_core.ClusterTree, len(births), np.ascontiguousarray(edges[:, 0]),
                    np.ascontiguousarray(edges[:, 1]), values, min_size, scale,
                    options=options or {})
    return ClusterTree(births, values, edges, min_size, scale, tree)


def of_merge_tree(tree: MergeTree, min_size: int, scale: str) -> ClusterTree:
    """The cluster tree of a merge tree."""
    return of_forest(tree.births, tree.values, tree.edges,
                     _options.whole("min_size", min_size, 2),
                     _options.choice("scale", scale, SCALES))


def cluster_tree(data: Any, min_size: int = 5, *, scale: str | None = None,
                 complex: str | None = None, **options: Any) -> ClusterTree:
    """The cluster tree of points, distances, or an image.

    With ``weights="core"``, this is the hierarchy of HDBSCAN*. `libph.sklearn.HDBSCAN` does the
    same with the interface of scikit-learn.

    Parameters
    ----------
    data : array_like, sparse matrix or PointImage
        As in `merge_tree`.
    min_size : int
        Components with fewer points are not clusters, at least 2.
    scale : {"inverse", "linear", "log"}, optional
        The measure of the life of a cluster, as a function of the value: 1 / value; the largest
        value of an edge minus the value; or the logarithm of their quotient. Default: "linear" for
        images, else "inverse".
    complex : {None, "rips", "cubical", "alpha"}
        As in `merge_tree`.
    **options
        As in `merge_tree`.

    Returns
    -------
    ClusterTree

    Examples
    --------
    >>> X = [[0], [1], [2], [3], [20], [21], [22], [23], [50]]
    >>> tree = ph.cluster_tree(X, 3, weights="core", core_neighbors=1)
    >>> tree
    ClusterTree(9 points, 3 clusters of at least 3)
    >>> tree.select().labels
    array([ 0,  0,  0,  0,  1,  1,  1,  1, -1])
    """
    min_size = _options.whole("min_size", min_size, 2)
    if scale is not None:
        scale = _options.choice("scale", scale, SCALES)
    request = request_of(data, complex, options)
    name = request.meta["complex"]
    check_names("a cluster tree", name, options)
    if name != "rips":
        return merge_tree(data, complex=complex, **options).clusters(min_size, scale=scale)
    forest = request._replace(task=None).run(
        functools.partial(_core.spanning_forest, size=request.meta["points"]))
    births, values, u, v = (np.asarray(block) for block in forest)
    return of_forest(births, values, np.column_stack([u, v]), min_size, scale or "inverse",
                     request.options)
