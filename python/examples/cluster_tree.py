#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Shows the cluster tree of points, the barcode, and the clusters: cluster_tree.py PICTURE."""
import sys

import matplotlib
import numpy as np

import libph as ph

NEIGHBOURS, MIN_SIZE = 10, 20
TICKS = (0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.5, 1)  # values that the axis of values names


def points():
    """Two dense groups side by side, a loose one, and noise."""
    rng = np.random.default_rng(0)
    groups = [rng.normal((0, 0), 0.15, (100, 2)), rng.normal((0.8, 0), 0.15, (100, 2)),
              rng.normal((3, 1.5), 0.6, (150, 2))]
    return np.vstack([*groups, rng.uniform((-1, -1), (5, 3.5), (50, 2))])


def colour_of(label):
    return "0.75" if label < 0 else f"C{label}"


def label_of_clusters(clusters, chosen):
    """For each cluster of the tree, the label of the chosen cluster that contains it, or -1."""
    labels = np.full(len(clusters), -1)
    labels[chosen] = np.arange(len(chosen))
    for c in reversed(range(len(clusters) - 1)):  # a parent before its children; the root is last
        labels[c] = max(labels[c], labels[clusters["parent"][c]])
    return labels


def first_points(tree):
    """For each cluster of the tree, the number of its first point."""
    first = np.full(len(tree.clusters), len(tree))
    np.minimum.at(first, tree.cluster_of, np.arange(len(tree)))
    for c, parent in enumerate(tree.clusters["parent"][:-1]):
        first[parent] = min(first[parent], first[c])
    return first


def draw_tree(axes, tree, chosen):
    """Draws each cluster from its top down to its bottom, as wide as it has points at a value."""
    clusters = tree.clusters
    labels, middle = label_of_clusters(clusters, chosen), np.zeros(len(clusters))
    first = first_points(tree)
    for c in reversed(range(len(clusters))):
        cluster = clusters[c]
        leaving = np.append(1 / tree.leaves_at[tree.cluster_of == c], 1 / cluster["bottom"])
        heights, counts = np.unique(leaving, return_counts=True)
        sizes = cluster["size"] - np.append(0, np.cumsum(counts))
        sizes[-1] = sizes[-2]  # at its bottom, a cluster splits or ends
        axes.fill_betweenx(np.append(1 / cluster["top"], heights), middle[c] - sizes / 2,
                           middle[c] + sizes / 2, step="post", linewidth=0,
                           color=colour_of(labels[c]),
                           alpha=1 if c in chosen or labels[c] < 0 else 0.6)
        children = np.flatnonzero(clusters["parent"] == c)
        children = children[np.argsort(first[children])]
        sizes = clusters["size"][children]
        middle[children] = middle[c] - sizes.sum() / 2 + np.cumsum(sizes) - sizes / 2
    axes.set(title=f"tree: clusters of at least {tree.min_size} points", xticks=[],
             ylabel="value, on the scale of 1 / value")


def draw_bars(axes, tree, labels):
    """Draws each bar from its birth up to its death, in the colour of the cluster of its peak."""
    peaks = np.append(tree.younger, tree.elder[-1])
    births, deaths = tree.births[peaks], np.append(tree.values, np.inf)
    bars = np.flatnonzero(births < deaths)
    groups = np.where(labels[peaks] < 0, labels.max() + 1, labels[peaks])  # noise is last
    for column, bar in enumerate(bars[np.lexsort((-deaths[bars], groups[bars]))]):
        axes.plot([column, column], [1 / births[bar], 1 / deaths[bar]], linewidth=4,
                  solid_capstyle="butt", color=colour_of(labels[peaks[bar]]))
    axes.set(title="barcode: H0 with births", xticks=[])


def picture(path):
    """The tree and the barcode share the axis of values."""
    import matplotlib.pyplot as plt
    X = points()
    tree = ph.merge_tree(X, weights="core", core_neighbors=NEIGHBOURS)
    clusters = tree.clusters(MIN_SIZE)
    labels, _, chosen = clusters.select()
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(12, 4), constrained_layout=True,
                                                 gridspec_kw={"width_ratios": (5, 4, 6)})
    draw_tree(left, clusters, chosen)
    draw_bars(middle, tree, labels)
    for axes in (left, middle):
        axes.set(ylim=(1.02 / tree.births.min(), 0), yticks=[1 / t for t in TICKS],
                 yticklabels=TICKS)
    right.scatter(*X.T, s=10, c=[colour_of(label) for label in labels])
    right.set(aspect="equal", xticks=[], yticks=[], title="clusters, and noise in grey")
    figure.savefig(path, dpi=80, metadata={"Software": None})
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    matplotlib.use("agg")
    picture(sys.argv[1])
