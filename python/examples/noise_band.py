# SPDX-License-Identifier: MIT
"""Shows which loops are more than noise: noise_band.py PICTURE.

Draws a noisy circle and its bars of H1, with the band of lengths that chance explains. Bars with a
p-value of at most 0.05 have a ring.
"""
import sys

import matplotlib
import numpy as np

import libph as ph

matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402


def main(picture):
    rng = np.random.default_rng(0)
    angles = rng.uniform(0, 2 * np.pi, 3000)
    points = np.column_stack([np.cos(angles), np.sin(angles)]) + rng.normal(0, 0.03, (3000, 2))
    bars = ph.rips(points)
    figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.6), layout="constrained")
    left.scatter(*points.T, s=1, color="C0")
    left.set(aspect="equal", xlabel="x", ylabel="y", title="3000 points")
    bars.plot(dims=1, ax=right, noise=4 * ph.confidence_radius(points))
    real = bars.dgm(1)[ph.p_values(bars, 1) <= 0.05]
    right.scatter(*real.T, s=90, facecolors="none", edgecolors="black", label="p ≤ 0.05")
    right.set_title("loops, and what noise explains")
    right.legend(loc="lower right")
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1])
