# SPDX-License-Identifier: MIT
"""Which clusters are real: whether subsamples have them, and whether noise has them."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _options, _results, _run
from ._clusters import ClusterTree
from ._errors import DataError, UsageError
from ._hierarchy import Hierarchy

_Integers = NDArray[np.int64]
_Numbers = NDArray[np.float64]

NULLS = ["both", "normal", "uniform"]
_MOST = 2**63 - 1


class ClusterStability(NamedTuple):
    """How well subsamples reproduce each cluster; see `libph.sklearn.HDBSCAN.stability`.

    Attributes
    ----------
    jaccard : ndarray
        For each cluster, its mean Jaccard similarity to the most similar cluster of a subsample,
        from 0 to 1; NaN if no subsample has a point of the cluster.
    quartiles : ndarray
        The lower quartile, the median and the upper quartile of these similarities, in three rows.
    dissolved : ndarray
        The number of subsamples in which the similarity is at most 0.5.
    recovered : ndarray
        The number of subsamples in which the similarity is above 0.75.
    """

    jaccard: _Numbers
    quartiles: _Numbers
    dissolved: _Integers
    recovered: _Integers

    def __repr__(self) -> str:
        return _results.in_brief(self)


class ClusterSignificance(NamedTuple):
    """How clearly each cluster is separated; see `libph.sklearn.HDBSCAN.significance`.

    Attributes
    ----------
    p : ndarray
        For each cluster, the probability that noise has a cluster that is separated at least as
        clearly.
    separation : ndarray
        The separation of each cluster, at least 1, without unit.
    """

    p: _Numbers
    separation: _Numbers

    def __repr__(self) -> str:
        return _results.in_brief(self)


def stability(hierarchy: Hierarchy, kept: _Integers, labels: _Integers, selection: dict[str, Any],
              resamples: int, fraction: float, seed: int, threads: int, options: dict[str, Any]
              ) -> ClusterStability:
    """The stability of the clusters that `labels` gives to the rows `kept`."""
    resamples = _options.whole("resamples", resamples, 1)
    seed = _options.whole("seed", seed, 0, _MOST)
    fraction = _options.real("fraction", fraction, "a number above 0, below 1")
    n = len(kept)
    size = round(fraction * n)
    if not 0 < fraction < 1 or size < 2:
        raise _options.refuse("fraction", fraction, "a number above 0, below 1, such that "
                              f"subsamples of {n} rows have at least 2")
    k = min(max(round(fraction * hierarchy.k), min(hierarchy.k, 1)), size - 1)
    min_size = max(round(fraction * hierarchy.tree.min_size), 2)
    if selection["max_size"] is not None:
        selection = {**selection, "max_size": max(round(fraction * selection["max_size"]), 1)}
    similarities = np.full((resamples, int(labels.max(initial=-1)) + 1), np.nan)
    with _run.rounds("subsamples", resamples, options) as rounds:
        for i in rounds:
            rows = np.random.default_rng([seed, i]).choice(n, size, replace=False)
            rows.sort()
            tree = hierarchy.of(hierarchy.rows(kept[rows]), k, min_size, threads).tree
            similarities[i] = _similarities(labels[rows], tree.select(**selection).labels,
                                            similarities.shape[1])
    summary = np.full((4, similarities.shape[1]), np.nan)
    for c, column in enumerate(similarities.T):
        known = column[~np.isnan(column)]
        if len(known):
            summary[:, c] = known.mean(), *np.quantile(known, [0.25, 0.5, 0.75])
    return ClusterStability(summary[0], summary[1:], np.sum(similarities <= 0.5, axis=0),
                            np.sum(similarities > 0.75, axis=0))


def _similarities(labels: _Integers, found: _Integers, clusters: int) -> _Numbers:
    """For each cluster, its largest Jaccard similarity to a found cluster. NaN: it has no rows."""
    width = int(found.max(initial=-1)) + 2  # column 0 is noise
    common = np.bincount((labels + 1) * width + found + 1, minlength=(clusters + 1) * width)
    common = common.reshape(-1, width)
    sizes = common.sum(axis=1)[1:, None]
    both = common[1:, 1:]
    union = sizes + common.sum(axis=0)[1:] - both
    best = np.max(both / np.maximum(union, 1), axis=1, initial=0.0)
    return np.where(sizes[:, 0] > 0, best, np.nan)


def significance(hierarchy: Hierarchy, kept: _Integers, chosen: _Integers, samples: int, null: str,
                 seed: int, threads: int, options: dict[str, Any]) -> ClusterSignificance:
    """The significance of the chosen clusters of a tree."""
    samples = _options.whole("samples", samples, 1)
    seed = _options.whole("seed", seed, 0, _MOST)
    null = _options.choice("null", null, NULLS)
    if hierarchy.has_distances:
        raise UsageError("significance: found a matrix of distances, expected points, because the "
                         "noise has their covariance; `stability` accepts distances")
    tree = hierarchy.tree
    if len(tree.clusters) and tree.clusters["least"].min() == 0:
        raise DataError("significance: found a cluster of copies of a point, expected distances "
                        "above 0, because noise has no copies; a larger min_samples may help")
    separation = _separations(tree)
    X = np.asarray(hierarchy.rows(kept), dtype=np.float64)
    mean = X.mean(axis=0)
    scores, spread, axes = np.linalg.svd(X - mean, full_matrices=False)
    scores *= spread
    nulls = NULLS[1:] if null == "both" else [null]
    largest = np.ones((len(nulls), samples))
    with _run.rounds("samples of noise", largest.size, options) as rounds:
        for i in rounds:
            kind, sample = divmod(i, samples)
            rng = np.random.default_rng([seed, i])
            if nulls[kind] == "normal":
                noise = rng.normal(size=scores.shape) * (spread / np.sqrt(len(X) - 1))
            else:
                noise = rng.uniform(scores.min(axis=0), scores.max(axis=0), size=scores.shape)
            of_noise = hierarchy.of(mean + noise @ axes, hierarchy.k, tree.min_size, threads).tree
            largest[kind, sample] = _separations(of_noise).max(initial=1.0)
    at_least = np.sum(largest[:, :, None] >= separation[chosen], axis=1)
    return ClusterSignificance((at_least.max(axis=0) + 1) / (samples + 1), separation[chosen])


def _separations(tree: ClusterTree) -> _Numbers:
    """For each cluster of a tree, how clearly it is separated from others.

    The prominence of a cluster is top / least. Where clusters separate, the less prominent one is
    new, and the most prominent one continues the cluster around them. The separation of a cluster
    is the prominence of the less prominent side where it separates, or where a cluster that it
    continues does, whichever is largest; 1 for the root.
    """
    clusters = tree.clusters
    separation = np.ones(len(clusters))
    if len(clusters) < 2:
        return separation
    parent = clusters["parent"][:-1]
    prominence = clusters["top"][:-1] / clusters["least"][:-1]
    separation[:-1] = prominence
    order = np.lexsort((-prominence, parent))
    starts = np.flatnonzero(np.diff(parent[order], prepend=-1))
    first, second = order[starts], order[starts + 1]  # of the children of each cluster
    separation[first] = prominence[second]
    best = np.zeros(len(clusters))
    best[parent[first]] = prominence[first]
    for c in np.flatnonzero(prominence == best[parent])[::-1]:  # parents before their children
        separation[c] = max(separation[c], separation[parent[c]])
    return separation
