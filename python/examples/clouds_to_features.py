#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws a ring and a disc, their loops as diagrams, and the pixels that a classifier receives:
clouds_to_features.py PICTURE."""
import sys

import matplotlib
import numpy as np

from libph.sklearn import PersistenceImage, RipsPersistence


def clouds():
    """One cloud of each kind, as on the page about pipelines."""
    rng = np.random.default_rng(0)
    angle = rng.uniform(0, 2 * np.pi, (2, 40))
    radius = np.array([np.ones(40), np.sqrt(rng.random(40))])
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=2)
    return points + 0.1 * rng.standard_normal(points.shape)


def picture(path):
    """One row per cloud, one column per step of the pipeline."""
    import matplotlib.pyplot as plt
    samples = clouds()
    diagrams = RipsPersistence(homology_dimensions=1).fit_transform(samples)
    pixels = PersistenceImage(resolution=8, bandwidth=0.1)
    features = pixels.fit_transform(diagrams)
    births, lengths = pixels.birth_ranges_[0], pixels.persistence_ranges_[0]
    figure, axes = plt.subplots(2, 3, figsize=(9, 5.4), constrained_layout=True)
    for row, cloud, diagram, feature in zip(axes, samples, diagrams, features):
        row[0].scatter(*cloud.T, s=12, color="black")
        row[0].set(aspect="equal", xticks=[], yticks=[], xlim=(-1.4, 1.4), ylim=(-1.4, 1.4))
        row[1].scatter(*diagram.T, s=16, color="C1")
        row[1].plot([0, 2], [0, 2], color="0.7", linewidth=1)
        row[1].set(aspect="equal", xlim=(0, 2), ylim=(0, 2), xlabel="birth", ylabel="death")
        row[2].imshow(feature.reshape(8, 8), origin="lower", extent=(*births, *lengths),
                      aspect="auto", vmin=0, vmax=features.max())
        row[2].set(xlabel="birth", ylabel="death - birth")
    for axis, title in zip(axes[0], ("a cloud", "RipsPersistence: its loops",
                                     "PersistenceImage: 64 numbers")):
        axis.set_title(title)
    figure.savefig(path, dpi=80, metadata={"Software": None})
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    matplotlib.use("agg")
    picture(sys.argv[1])
