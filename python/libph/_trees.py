# SPDX-License-Identifier: MIT
"""Merge trees: how components join."""
from __future__ import annotations

import functools
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _options
from ._errors import UsageError
from ._estimate import request_of

if TYPE_CHECKING:
    from ._clusters import ClusterTree

_RIPS_OPTIONS = ("threshold", "metric", "minkowski_p", "weights", "dtm_neighbors",
                 "core_neighbors", "weight_exponent", "nan", "diagonal", "symmetrise")
_CUBICAL_OPTIONS = ("threshold", "construction", "superlevel", "periodic", "nan")
_ALPHA_OPTIONS = ("threshold", "values", "squared", "weights", "nan")
_RUN_OPTIONS = ("threads", "memory_limit", "progress", "timeout", "stop")


@_options.with_hints
class MergeTree:
    """H0 as a tree: how components of the sublevel sets join as the value grows.

    For points, this is single-linkage clustering. Vertices are points, or voxels in C order; with
    the construction "cells", they are corners of voxels.

    Attributes
    ----------
    births : ndarray
        The value at which each vertex enters; inf if it never does.
    values : ndarray
        The value of each merge, ascending.
    edges : ndarray
        The edge that joins two components in each merge, (m, 2). Together, the edges form a minimum
        spanning forest.
    elder : ndarray
        The birth vertex of the component that survives each merge.
    younger : ndarray
        The birth vertex of the component that dies in each merge.
    shape : tuple of int or None
        For an image: the shape to which `components` and `basins` can be reshaped.
    """

    def __init__(self, tree: _core.MergeTree, shape: tuple[int, ...] | None) -> None:
        self._tree = tree
        self.births: NDArray[np.float64] = np.asarray(tree.births)
        self.values: NDArray[np.float64] = np.asarray(tree.values)
        self.edges: NDArray[np.int64] = np.column_stack([np.asarray(tree.u), np.asarray(tree.v)])
        self.elder: NDArray[np.int64] = np.asarray(tree.elder)
        self.younger: NDArray[np.int64] = np.asarray(tree.younger)
        self.shape = shape

    def __reduce__(self) -> tuple[Any, ...]:
        ends = np.column_stack([self.edges, self.elder, self.younger])
        sizes = np.column_stack([np.asarray(self._tree.elder_sizes),
                                 np.asarray(self._tree.younger_sizes)])
        return (_restored, (self.births, self.values, ends, sizes, self.shape))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, MergeTree):
            return NotImplemented
        return self.shape == other.shape and self._tree.equals(other._tree)

    def __hash__(self) -> int:
        return hash((self.shape, self.edges.tobytes()))

    def __len__(self) -> int:
        return len(self.births)

    def __repr__(self) -> str:
        return f"MergeTree({len(self)} vertices, {len(self.values)} merges)"

    @property
    def linkage(self) -> NDArray[np.float64]:
        """The merges as a linkage matrix of ``scipy.cluster.hierarchy``.

        Each row has two clusters, a value and a size. There are n - 1 rows if all n vertices become
        one component.
        """
        return np.asarray(self._tree.linkage)

    def components(self, t: float) -> NDArray[np.int64]:
        """For each vertex, the birth vertex of its component at the value `t`.

        -1 for a vertex that has not entered.
        """
        return np.asarray(self._tree.components(_options.real("t", t)))

    def basins(self, min_persistence: float, min_size: int = 1) -> NDArray[np.int64]:
        """For each vertex, one vertex that stands for its whole basin; -1 if the vertex never
        enters.

        Two basins stay apart if the merge of their components has at least this persistence and
        both components have at least this many vertices. This is clustering by persistence
        (ToMATo).
        """
        return np.asarray(self._tree.basins(_options.real("min_persistence", min_persistence),
                                            _options.whole("min_size", min_size, 1)))

    def clusters(self, min_size: int = 5, *, scale: str | None = None) -> ClusterTree:
        """The cluster tree: the components with at least this many vertices, and how they split.

        `scale` is as in `cluster_tree`; by default, it is "linear" for an image.
        """
        from ._clusters import of_merge_tree
        default = "inverse" if self.shape is None else "linear"
        return of_merge_tree(self, min_size, scale or default)


def _restored(births: NDArray[np.float64], values: NDArray[np.float64], ends: NDArray[np.int64],
              sizes: NDArray[np.int64], shape: tuple[int, ...] | None) -> MergeTree:
    return MergeTree(_core.restored_tree(births, values, ends.ravel(), sizes.ravel()), shape)


def check_names(what: str, complex_name: str, options: Iterable[str]) -> None:
    """Refuses options of `rips`, `cubical` and `alpha` that do nothing for H0 as a tree."""
    kind = {"rips": _RIPS_OPTIONS, "cubical": _CUBICAL_OPTIONS}
    allowed = kind.get(complex_name, _ALPHA_OPTIONS) + _RUN_OPTIONS
    for name in options:
        if name not in allowed:
            raise UsageError(f"{name}: does nothing for {what} of {complex_name}, "
                             f"expected {', '.join(allowed)}")


def merge_tree(data: Any, *, complex: str | None = None, **options: Any) -> MergeTree:
    """The merge tree of points, distances, or an image.

    Parameters
    ----------
    data : array_like, sparse matrix or PointImage
        As in `rips`, `cubical` or `alpha`.
    complex : {None, "rips", "cubical", "alpha"}
        Which complex to use. Default: cubical for three axes or more and for a PointImage, else
        rips.
    **options
        As in `rips`: `threshold`, `metric`, `minkowski_p`, `weights`, `dtm_neighbors`,
        `core_neighbors`, `weight_exponent`, `nan`, `diagonal`, `symmetrise`. As in `cubical`: `threshold`,
        `construction`, `superlevel`, `periodic`, `nan`. As in `alpha`: `threshold`, `values`,
        `squared`, `weights`, `nan`. Also `threads`, `memory_limit`, `progress`, `timeout`, `stop`.
        With ``nan="drop"``, points that are left out never enter.

    Returns
    -------
    MergeTree

    Examples
    --------
    >>> tree = ph.merge_tree([[0], [1], [10], [12]])
    >>> tree.components(3)
    array([0, 0, 2, 2])
    >>> tree.linkage
    array([[0., 1., 1., 2.],
           [2., 3., 2., 2.],
           [4., 5., 9., 4.]])
    """
    request = request_of(data, complex, options)
    check_names("a merge tree", request.meta["complex"], options)
    points = request.meta.get("points", 0)  # including the points that nan="drop" leaves out
    tree = request._replace(task=None).run(functools.partial(_core.merge_tree, size=points))
    shape = request.meta.get("shape")
    if shape is not None and request.meta["construction"] == "cells":
        periodic = request.meta["periodic"]
        shape = tuple(n + (k not in periodic) for k, n in enumerate(shape))
    return MergeTree(tree, shape)
