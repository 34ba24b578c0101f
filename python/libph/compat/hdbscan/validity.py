# SPDX-License-Identifier: MIT
"""The validity of a clustering by density."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ... import _arrays, _options
from ..._errors import UsageError
from .. import _missing
from ._space import Space

__all__ = ["validity_index"]

_Integers = NDArray[np.int64]
_Numbers = NDArray[np.float64]


def __getattr__(name: str) -> Any:
    return _missing.attribute(__name__, name, __all__)


def validity_index(X: Any, labels: Any, metric: Any = "euclidean", d: int | None = None,
                   per_cluster_scores: bool = False, mst_raw_dist: bool = False,
                   verbose: bool = False, **kwd_args: Any) -> Any:
    """The density-based validity of a clustering (Moulavi, Jaskowiak, Campello, Zimek, Sander,
    Density-based clustering validation, 2014).

    Parameters
    ----------
    X : array_like
        Points, one per row. With ``metric="precomputed"``, a square matrix of distances.
    labels : array_like
        The cluster of each row; -1 is noise.
    metric : str or callable
        As in `HDBSCAN`.
    d : int, optional
        The exponent of densities, the number of coordinates. It is needed for
        ``metric="precomputed"``, and points have their own.
    per_cluster_scores : bool
        If True, the validity of each cluster is returned as well; NaN for a label without rows.
    mst_raw_dist : bool
        If True, distances are compared instead of mutual reachability distances.
    verbose : bool
        If True, the sparseness and the separation of each cluster are printed.
    **kwd_args
        Parameters of the metric.

    Returns
    -------
    float or (float, ndarray)
        The validity is from -1 to 1, and 1 is best. It is the mean over the clusters, weighted with
        their shares of the rows; NaN if there is only one cluster.

    Examples
    --------
    >>> from libph.compat import hdbscan
    >>> X = [[0], [1], [2.5], [20], [21], [22.5]]
    >>> round(hdbscan.validity_index(X, [0, 0, 0, 1, 1, 1]), 3)
    0.906
    """
    given = dict(kwd_args)
    space = Space(validity_index, metric, given.pop("p", None), 1.0, given)
    data = space.table(X)
    group = _arrays.as_array(labels, "labels")
    if group.shape != data.shape[:1]:
        raise UsageError(f"labels: found an array of shape {group.shape}, expected {data.shape[0]} "
                         "numbers, one for each row of X")
    if space.has_points:
        dimension = data.shape[1]
    elif d is None:
        raise UsageError("d: found None, expected the number of coordinates, because "
                         "metric='precomputed' does not tell")
    else:
        dimension = _options.whole("d", d, 1)
    raw = _options.flag("mst_raw_dist", mst_raw_dist)
    count = int(group.max(initial=-1)) + 1
    members = [np.flatnonzero(group == c) for c in range(count)]
    there = [c for c in range(count) if len(members[c])]
    core: dict[int, Any] = {}
    inner: dict[int, _Integers] = {}
    sparseness = np.full(count, np.nan)
    for c in there:
        distances = space.distances(data[members[c]], data, members[c])
        core[c] = np.zeros(len(distances)) if raw else _core_of_all(distances, dimension)
        reach = np.maximum(np.maximum(distances, core[c]), core[c][:, None])
        inner[c], sparseness[c] = _inside(reach)
    separation = np.full((count, count), np.inf)
    for i in there:
        for j in (j for j in there if j > i):
            distances = space.distances(data[members[i][inner[i]]], data, members[j][inner[j]])
            reach = np.maximum(np.maximum(distances, core[i][inner[i]][:, None]), core[j][inner[j]])
            separation[i, j] = separation[j, i] = reach.min()
    least = separation.min(axis=1, initial=np.inf)
    with np.errstate(invalid="ignore"):
        validity = (least - sparseness) / np.maximum(least, sparseness)
    if _options.flag("verbose", verbose):
        for c in there:
            print(f"cluster {c}: separation {least[c]}, sparseness {sparseness[c]}")
    total = float(sum(validity[c] * len(members[c]) for c in there) / data.shape[0])
    return (total, validity) if _options.flag("per_cluster_scores", per_cluster_scores) else total


def _core_of_all(distances: _Numbers, dimension: int) -> _Numbers:
    """The core distance of each point of a cluster with respect to all others: the mean of
    (1 / distance)**dimension, to the power -1 / dimension. Copies do not count."""
    with np.errstate(divide="ignore"):
        density = np.where(distances == 0, 0.0, 1 / distances)**dimension
        mean = density.sum(axis=1) / max(1, len(distances) - 1)
        return np.where(mean.any(), mean**(-1 / dimension), 0.0)


def _inside(reach: _Numbers) -> tuple[_Integers, float]:
    """The inner points of the spanning tree of a cluster, those with several edges, and the longest
    edge between inner points; of all points if there is no such edge."""
    n = len(reach)
    u, v, values = np.zeros(n - 1, dtype=np.int64), np.zeros(n - 1, dtype=np.int64), np.zeros(n - 1)
    nearest = reach[0].copy()
    is_left = np.arange(n) > 0
    for i in range(n - 1):  # Prim's algorithm; of edges with equal values, that of the first rows
        left = np.flatnonzero(is_left)
        v[i] = new = left[nearest[left].argmin()]
        values[i] = nearest[new]
        u[i] = np.flatnonzero(~is_left & (reach[new] == values[i]))[0]
        is_left[new] = False
        np.minimum(nearest, reach[new], out=nearest)
    is_inner = np.bincount(np.append(u, v), minlength=n) > 1
    if not is_inner.any():
        is_inner[0] = True
    between = is_inner[u] & is_inner[v]
    chosen = values[between] if between.any() else values
    return np.flatnonzero(is_inner), float(chosen.max(initial=0))
