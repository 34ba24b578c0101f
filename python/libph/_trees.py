# SPDX-License-Identifier: MIT
"""Merge trees: how components join."""
from __future__ import annotations

import functools
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _options
from ._errors import UsageError
from ._estimate import request_of

_RIPS_OPTIONS = ("threshold", "metric", "minkowski_p", "weights", "dtm_neighbors",
                 "weight_exponent", "nan", "diagonal", "symmetrise")
_CUBICAL_OPTIONS = ("threshold", "construction", "superlevel", "periodic", "nan")
_ALPHA_OPTIONS = ("threshold", "values", "squared", "weights", "nan")
_RUN_OPTIONS = ("threads", "memory_limit", "progress", "timeout", "stop")


class MergeTree:
    """H0 as a tree: how components of the sublevel sets join as the value grows.

    Of points this is single-linkage clustering. Vertices are points, or voxels in C
    order; corners of voxels, where the construction is "cells".

    Attributes
    ----------
    births : ndarray
        When each vertex enters; inf: never.
    values : ndarray
        Of each merge its value, ascending.
    edges : ndarray
        Of each merge the edge that joins two components: of a minimum spanning forest, (m, 2).
    elder : ndarray
        Of each merge the vertex that gave birth to the component that survives.
    younger : ndarray
        Of each merge the vertex that gave birth to the component that dies.
    shape : tuple of int or None
        Of an image: what `components` and `basins` may be reshaped to.
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

    def __len__(self) -> int:
        return len(self.births)

    def __repr__(self) -> str:
        return f"MergeTree({len(self)} vertices, {len(self.values)} merges)"

    @property
    def linkage(self) -> NDArray[np.float64]:
        """The merges as a linkage matrix of ``scipy.cluster.hierarchy``.

        Rows of two clusters, value and size: n - 1 of them if all n vertices become one component.
        """
        return np.asarray(self._tree.linkage)

    def components(self, t: float) -> NDArray[np.int64]:
        """For each vertex the vertex that gave birth to its component at the value `t`.

        -1 for a vertex that has not entered.
        """
        return np.asarray(self._tree.components(_options.real("t", t)))

    def basins(self, min_persistence: float, min_size: int = 1) -> NDArray[np.int64]:
        """For each vertex a vertex of its basin, the same for all of it; -1 if it never enters.

        Two basins stay apart if the merge of their components is so persistent, and both have so
        many vertices: clustering by persistence (ToMATo).
        """
        return np.asarray(self._tree.basins(_options.real("min_persistence", min_persistence),
                                            _options.whole("min_size", min_size, 1)))


def _restored(births: NDArray[np.float64], values: NDArray[np.float64], ends: NDArray[np.int64],
              sizes: NDArray[np.int64], shape: tuple[int, ...] | None) -> MergeTree:
    return MergeTree(_core.restored_tree(births, values, ends.ravel(), sizes.ravel()), shape)


def merge_tree(data: Any, *, complex: str | None = None, **options: Any) -> MergeTree:
    """The merge tree of points, distances, or an image.

    Parameters
    ----------
    data : array_like, sparse matrix or PointImage
        As of `rips`, `cubical` or `alpha`.
    complex : {None, "rips", "cubical", "alpha"}
        Which of them. Default: cubical for three axes or more and for a PointImage, else rips.
    **options
        As of `rips`: `threshold`, `metric`, `minkowski_p`, `weights`, `dtm_neighbors`,
        `weight_exponent`, `nan`, `diagonal`, `symmetrise`. As of `cubical`: `threshold`,
        `construction`, `superlevel`, `periodic`, `nan`. As of `alpha`: `threshold`, `values`,
        `squared`, `weights`, `nan`. And `threads`, `memory_limit`, `progress`, `timeout`, `stop`.
        With ``nan="drop"`` points that are left out never enter.

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
    kind = {"rips": _RIPS_OPTIONS, "cubical": _CUBICAL_OPTIONS}
    allowed = kind.get(request.meta["complex"], _ALPHA_OPTIONS) + _RUN_OPTIONS
    for name in options:
        if name not in allowed:
            raise UsageError(f"{name}: does nothing for a merge tree of {request.meta['complex']}, "
                             f"expected {', '.join(allowed)}")
    points = request.meta.get("points", 0)  # those that nan="drop" leaves out included
    tree = request._replace(task=None).run(functools.partial(_core.merge_tree, size=points))
    shape = request.meta.get("shape")
    if shape is not None and request.meta["construction"] == "cells":
        periodic = request.meta["periodic"]
        shape = tuple(n + (k not in periodic) for k, n in enumerate(shape))
    return MergeTree(tree, shape)
