# SPDX-License-Identifier: MIT
"""What a clustering computes, and the numbering of its clusters."""
from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ... import _hierarchy, _options
from ..._clusters import ClusterTree
from ..._errors import NotBuiltIn, UsageError
from ._space import Space

_Integers = NDArray[np.int64]
_Numbers = NDArray[np.float64]

ALGORITHMS = ["best", "generic", "prims_kdtree", "prims_balltree", "boruvka_kdtree",
              "boruvka_balltree"]
_CONDENSED = np.dtype([("parent", np.intp), ("child", np.intp), ("lambda_val", np.float64),
                       ("child_size", np.intp)])


class Fit:
    """The hierarchy of a table, the clusters chosen from it, and their numbers.

    The parameters are those of `function`, and `given` are those of the metric.

    Clusters are numbered from the root down, level by level, and those with the same parent in the
    order of their first rows. Labels are in the order of these numbers.

    Attributes
    ----------
    data : ndarray or sparse matrix
        The table.
    kept : ndarray
        The rows that are finite.
    space : Space
    hierarchy : Hierarchy
    tree : ClusterTree
    labels, probabilities, persistence : ndarray
    chosen : ndarray
        By label: the row of the cluster in ``tree.clusters``.
    numbers : ndarray
        The number of each row of ``tree.clusters``.
    """

    def __init__(self, function: Callable[..., Any], X: Any, given: dict[str, Any], *,
                 min_cluster_size: int = 5, min_samples: int | None = None, alpha: float = 1.0,
                 cluster_selection_epsilon: float = 0.0, max_cluster_size: int = 0,
                 metric: Any = "euclidean", p: float | None = None,
                 cluster_selection_method: str = "eom", allow_single_cluster: bool = False,
                 match_reference_implementation: bool = False) -> None:
        least = _options.whole("min_cluster_size", min_cluster_size, 2)
        samples = least if min_samples is None else _options.whole("min_samples", min_samples, 1)
        if _options.flag("match_reference_implementation", match_reference_implementation):
            least, samples = least + 1, samples - 1
        largest = _options.whole("max_cluster_size", max_cluster_size, -2**63)
        self.space = Space(function, metric, p, _options.positive("alpha", alpha), given)
        self.data = self.space.table(X)
        self.kept = kept = self.space.kept(self.data)
        if not len(kept):
            raise UsageError(f"X: found {self.data.shape[0]} rows, none of them finite, expected "
                             "at least one")
        k = min(max(samples, 1), len(kept) - 1)
        self.hierarchy = self.space.hierarchy(self.data, kept, k, least)
        self.tree = self.hierarchy.tree
        self._selection: dict[str, Any] = {
            "method": cluster_selection_method, "epsilon": cluster_selection_epsilon,
            "allow_single": allow_single_cluster, "max_size": largest if largest > 0 else None}
        found = self.tree.select(**self._selection)
        self.numbers = _numbers_of(self.tree)
        order = np.argsort(self.numbers[found.chosen])
        self.chosen = found.chosen[order]
        self._label_of = np.append(np.argsort(order), -1)
        self.labels = self._label_of[found.labels]
        self.probabilities = found.probabilities
        self.persistence = _hierarchy.persistence(self.tree, self.chosen)

    def predicted(self, joined: _Integers, values: _Numbers) -> tuple[_Integers, _Numbers]:
        """The labels and probabilities of new rows, from the rows that they join."""
        found = self.tree._locate(joined, values, **self._selection)
        return self._label_of[found.labels], found.probabilities

    def left_by(self, joined: _Integers, values: _Numbers) -> tuple[_Integers, _Numbers]:
        """The cluster that each new row leaves, and the value at which it does."""
        tree, clusters = self.tree, self.tree.clusters
        has_point = joined >= 0
        cluster = np.where(has_point, tree.cluster_of[joined], len(clusters) - 1)
        leaves_at = np.where(has_point, np.maximum(tree.leaves_at[joined], values), np.inf)
        while True:
            parent = clusters["parent"][cluster]
            is_past = (clusters["top"][cluster] <= values) & (parent >= 0)
            if not is_past.any():
                return cluster, leaves_at
            cluster = np.where(is_past, parent, cluster)

    def labels_of_clusters(self) -> _Integers:
        """For each cluster of the tree, the label of the chosen cluster at or around it, or -1."""
        parents = self.tree.clusters["parent"].tolist()
        label = np.full(len(parents), -1)
        label[self.chosen] = np.arange(len(self.chosen))
        for c in range(len(parents) - 2, -1, -1):  # parents come after their children
            if label[c] < 0:
                label[c] = label[parents[c]]
        return label

    def meetings(self) -> _Numbers:
        """For each cluster of the tree and each chosen one, the value at which the two join; -1 if
        one of them lies in the other."""
        clusters = self.tree.clusters
        parents = clusters["parent"].tolist()
        has = np.zeros((len(parents), len(self.chosen)), dtype=bool)  # the chosen one lies inside
        has[self.chosen, np.arange(len(self.chosen))] = True
        for c, parent in enumerate(parents[:-1]):
            has[parent] |= has[c]
        met = np.full(has.shape, -1.0)
        is_in = self.labels_of_clusters()
        for c in range(len(parents) - 2, -1, -1):
            parent = parents[c]
            met[c] = np.where(met[parent] >= 0, met[parent],
                              np.where(has[c], -1, clusters["top"][c]))
            if is_in[c] >= 0:
                met[c, is_in[c]] = -1
        return met

    def exemplars(self) -> list[_Integers]:
        """For each label, the rows that stay longest."""
        return _hierarchy.exemplars(self.tree, self.chosen, self.labels)

    def condensed(self) -> NDArray[np.void]:
        """The rows of the condensed tree, by parent and then by lambda."""
        tree, n = self.tree, len(self.tree)
        clusters, inner = tree.clusters, np.arange(len(tree.clusters) - 1)
        rows = np.empty(n + len(inner), dtype=_CONDENSED)
        rows["parent"] = self.numbers[np.append(tree.cluster_of, clusters["parent"][inner])]
        rows["child"] = np.append(np.arange(n), self.numbers[inner])
        with np.errstate(divide="ignore"):
            rows["lambda_val"] = 1 / np.append(tree.leaves_at, clusters["top"][inner])
        rows["child_size"] = np.append(np.ones(n), clusters["size"][inner])
        ordered: NDArray[np.void] = rows[
            np.lexsort([rows["child"], rows["lambda_val"], rows["parent"]])]
        return ordered

    def spanning_tree(self) -> _Numbers:
        """The edges of the spanning forest: two rows and a value, by ascending value."""
        return np.column_stack([self.tree.edges, self.tree.values])


def linkage_of(tree: ClusterTree) -> _Numbers:
    """The linkage matrix. Components that no edge joins are joined to the last one at infinity."""
    rows, n = tree.merge_tree.linkage, len(tree)
    nodes = n + len(rows)
    roots = np.roll(np.setdiff1d(np.arange(nodes), rows[:, :2]), 1)
    size = np.append(np.ones(n), rows[:, 3])[roots]
    more = np.empty((len(roots) - 1, 4))
    more[:, 0], more[:, 2], more[:, 3] = roots[1:], np.inf, np.cumsum(size)[1:]
    more[:, 1] = np.append(roots[:1], nodes + np.arange(len(more)))[:len(more)]
    return np.vstack([rows, more])


def _numbers_of(tree: ClusterTree) -> _Integers:
    """The number of each cluster: the root has the number of points."""
    parents = tree.clusters["parent"]
    first = np.full(len(parents), len(tree))
    np.minimum.at(first, tree.cluster_of, np.arange(len(tree)))
    children: list[list[int]] = [[] for _ in parents]
    for c, parent in enumerate(parents[:-1].tolist()):  # children come before their parents
        first[parent] = min(first[parent], first[c])
        children[parent].append(c)
    order = [len(parents) - 1]
    for c in order:
        order += sorted(children[c], key=first.__getitem__)
    numbers = np.empty(len(parents), dtype=np.int64)
    numbers[order] = len(tree) + np.arange(len(parents))
    return numbers


def refuse_unless(name: str, value: Any, default: Any, instead: str) -> None:
    """Refuses a value that only the original can handle."""
    if _options.real(name, value) != default:
        raise NotBuiltIn(f"{name}: found {value!r}, expected {default}: not in this drop-in; "
                         f"hdbscan has it; {instead}")


