#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws three textures, their diagrams, and two of the numbers that tell them apart: textures.py
PICTURE.

The photographs come with scikit-image (Debian: python3-skimage)."""
import sys
from pathlib import Path

import matplotlib
import skimage

import libph as ph
from libph.sklearn import CubicalPersistence, Statistics

NAMES = "brick", "grass", "gravel"
SIDE = 32


def patches_of(photo):
    """Squares of the photograph that do not overlap, row by row."""
    blocks = photo.reshape(512 // SIDE, SIDE, 512 // SIDE, SIDE).swapaxes(1, 2)
    return list(blocks.reshape(-1, SIDE, SIDE))


def picture(path):
    import matplotlib.pyplot as plt
    folder = Path(skimage.__file__).parent / "data"
    photos = [ph.read(folder / f"{name}.png") for name in NAMES]
    figure, axes = plt.subplots(2, 4, figsize=(11, 5.2), constrained_layout=True)
    for column, (name, photo) in enumerate(zip(NAMES, photos)):
        patch = patches_of(photo)[100]
        axes[0, column].imshow(patch, cmap="gray", vmin=0, vmax=255)
        axes[0, column].set(title=name, xticks=[], yticks=[])
        ph.cubical(patch).plot(ax=axes[1, column])
        axes[1, column].set(xlim=(0, 255), title="")
    numbers = Statistics(infinity="drop").set_output(transform="pandas")
    patches = [patch for photo in photos for patch in patches_of(photo)]
    table = numbers.fit_transform(
        CubicalPersistence(reduced=True).set_output(transform="pandas").fit_transform(patches))
    for axis, (x, y) in zip(axes[:, 3], (("H0_count", "H1_count"),
                                         ("H0_length_mean", "H1_length_mean"))):
        for i, name in enumerate(NAMES):
            rows = table.iloc[256 * i:256 * (i + 1)]
            axis.scatter(rows[x], rows[y], s=4, label=name)
        axis.set(xlabel=x, ylabel=y)
    axes[0, 3].legend(markerscale=3)
    axes[0, 3].set_title("768 patches")
    figure.savefig(path, dpi=80, metadata={"Software": None})
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    matplotlib.use("agg")
    picture(sys.argv[1])
