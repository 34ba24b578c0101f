#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Shows the longest loop of two circles, and their bars: two_circles.py POINTS PICTURE."""
import sys

import matplotlib
import numpy as np

import libph as ph


def picture(data, path):
    """The points with the loop, and the diagram."""
    import matplotlib.pyplot as plt
    points = np.loadtxt(data, delimiter=",", skiprows=1)
    bars = ph.rips(points, representatives="cycles")
    loop = points[bars.representative(bars.longest(1)).loop()]
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), constrained_layout=True)
    left.scatter(*points.T, s=12, color="black")
    left.fill(*loop.T, edgecolor="C1", fill=False, linewidth=2)
    left.set(aspect="equal", xticks=[], yticks=[], title="the longest loop")
    bars.plot(ax=right)
    figure.savefig(path, dpi=80, metadata={"Software": None})
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    matplotlib.use("agg")
    picture(*sys.argv[1:])
