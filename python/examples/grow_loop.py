#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Moves points so that their largest loop grows: grow_loop.py PICTURE."""
import sys

import matplotlib
import numpy as np

import libph as ph


def grow(X, steps, rate):
    """Moves the points so that the longest bar of H1 grows: follows the gradient of its length, and
    keeps the points in the unit square."""
    for _ in range(steps):
        bars = ph.rips(X).filter(dim=1)
        d_lengths = np.zeros(len(bars))
        d_lengths[bars.longest(1)] = 1
        step = ph.gradients.pullback(bars, X, -d_lengths, d_lengths)
        X = np.clip(X + rate * step, 0, 1)
    return X


def picture(path):
    """Points and diagrams before, during and after the growth."""
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(2, 3, figsize=(9, 6), constrained_layout=True)
    X, done = np.random.default_rng(0).random((100, 2)), 0
    for column, steps in zip(axes.T, (0, 75, 300)):
        X, done = grow(X, steps - done, 0.02), steps
        bars = ph.rips(X)
        column[0].scatter(*X.T, s=12, color="black")
        column[0].set(title=f"after {steps} steps", aspect="equal", xlim=(-0.03, 1.03),
                      ylim=(-0.03, 1.03), xticks=[], yticks=[])
        bars.plot(ax=column[1])
        column[1].set(xlim=(-0.02, 1), ylim=(0, 1.1), xlabel="birth", ylabel="death")
    figure.savefig(path, dpi=80, metadata={"Software": None})
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    matplotlib.use("agg")
    picture(sys.argv[1])
