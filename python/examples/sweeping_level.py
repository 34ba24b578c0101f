#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Shows a level that rises over a signal, and the bars of its pits: sweeping_level.py PICTURE."""
import sys

import matplotlib
import numpy as np

import libph as ph


def picture(path):
    """The signal with the bars of its pits, and their diagram."""
    import matplotlib.pyplot as plt
    t = np.linspace(0, 10, 400)
    signal = np.sin(t * 1.9) + 0.08 * (t - 5) ** 2 / 2 + 0.12 * np.sin(t * 11)
    bars = ph.cubical(signal)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.8), constrained_layout=True,
                                         gridspec_kw={"width_ratios": (2, 1)})
    left.plot(t, signal, color="black", linewidth=1.2)
    top = signal.max()
    for bar in bars:
        lowest = t[np.flatnonzero(signal == bar.birth)[0]]
        left.plot([lowest, lowest], [bar.birth, min(bar.death, top)], color="C0", linewidth=2.5)
        left.scatter(lowest, bar.birth, color="C0", s=18, zorder=3)
    left.set(xticks=[], ylabel="value, and level", title="a bar for each pit: from its floor to where it flows over")
    bars.plot(ax=right)
    figure.savefig(path, dpi=80, metadata={"Software": None})
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    matplotlib.use("agg")
    picture(sys.argv[1])
