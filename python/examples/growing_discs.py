#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Shows discs around points as they grow, and the barcode: growing_discs.py PICTURE."""
import sys

import matplotlib
import numpy as np

import libph as ph

DIAMETERS = (0.35, 0.62, 1.0, 1.75)
COLOURS = ("C0", "C1")


def points_of_ring():
    """18 points near a circle of radius 1."""
    rng = np.random.default_rng(3)
    angles = np.linspace(0, 2 * np.pi, 18, endpoint=False) + rng.normal(0, 0.09, 18)
    radii = 1 + rng.normal(0, 0.07, 18)
    return np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])


def draw_discs(axes, points, diameter):
    """Draws the discs, and a line between the centres of any two discs that meet."""
    import matplotlib.pyplot as plt
    for x, y in points:
        axes.add_patch(plt.Circle((x, y), diameter / 2, color="C0", alpha=0.25, linewidth=0))
    for i, p in enumerate(points):
        for q in points[:i]:
            if np.linalg.norm(p - q) <= diameter:
                axes.plot(*np.transpose([p, q]), color="C0", linewidth=1)
    axes.scatter(*points.T, s=10, color="black", zorder=3)
    pieces, loops = ph.rips(points).betti(diameter)
    counts = f"{pieces} piece{'' if pieces == 1 else 's'}, {loops} loop{'' if loops == 1 else 's'}"
    axes.set(aspect="equal", xlim=(-2, 2), ylim=(-2, 2), xticks=[], yticks=[],
             title=f"{diameter:g} wide: {counts}")


def draw_bars(axes, bars):
    """Draws a line for each bar, with one colour per dimension."""
    end = 2.1
    for row, bar in enumerate(bars):
        axes.plot([bar.birth, min(bar.death, end)], [row, row], color=COLOURS[bar.dim], linewidth=2.5)
    for diameter in DIAMETERS:
        axes.axvline(diameter, color="black", linewidth=0.8, linestyle=":")
    axes.plot([], [], color="C0", label="pieces (H0)")
    axes.plot([], [], color="C1", label="loops (H1)")
    axes.legend(loc="lower right")
    axes.set(xlim=(0, end), yticks=[], xlabel="diameter of the discs", title="the barcode")


def picture(path):
    """Four moments, and all bars with a dotted line at each moment."""
    import matplotlib.pyplot as plt
    points = points_of_ring()
    figure = plt.figure(figsize=(10, 5.2), constrained_layout=True)
    grid = figure.add_gridspec(2, 4)
    for column, diameter in enumerate(DIAMETERS):
        draw_discs(figure.add_subplot(grid[0, column]), points, diameter)
    draw_bars(figure.add_subplot(grid[1, :]), ph.rips(points))
    figure.savefig(path, dpi=80, metadata={"Software": None})
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    matplotlib.use("agg")
    picture(sys.argv[1])
