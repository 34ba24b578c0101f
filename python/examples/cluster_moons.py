#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Finds clusters by the persistence of a density, and draws its bars: cluster_moons.py PICTURE."""
import sys

import matplotlib
import numpy as np
from sklearn.datasets import make_blobs, make_moons

from libph.sklearn import PersistenceClustering


def points():
    """Two moons and a less dense blob."""
    moons, _ = make_moons(1500, noise=0.07, random_state=0)
    blob, _ = make_blobs(500, centers=[[0.5, 2.2]], cluster_std=0.4, random_state=0)
    return np.vstack([moons, blob])


def picture(path):
    """The clusters, and the diagram of the density with the gap above the noise."""
    import matplotlib.pyplot as plt
    X = points()
    found = PersistenceClustering(k=15, n_clusters=3).fit(X)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4.2), constrained_layout=True)
    left.scatter(*X.T, s=5, c=[f"C{label}" for label in found.labels_])
    left.scatter(*X[found.peaks_].T, s=120, marker="*", color="black")
    left.set(aspect="equal", title="clusters and their densest points", xticks=[], yticks=[])
    found.barcode_.plot(ax=right)
    right.set(title="bars of -log(density)", xlabel="birth: at the peak",
              ylabel="death: at the pass")
    figure.savefig(path, dpi=80, metadata={"Software": None})
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    matplotlib.use("agg")
    picture(sys.argv[1])
