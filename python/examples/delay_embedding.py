#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Shows a signal, its windows as points, and the bar of its period: delay_embedding.py SIGNAL PICTURE."""
import sys

import matplotlib
import numpy as np

import libph as ph


def picture(data, path):
    """The signal; two coordinates of its windows, with the loop; the diagram."""
    import matplotlib.pyplot as plt
    t, signal = np.loadtxt(data, delimiter=",", skiprows=1).T
    windows = np.lib.stride_tricks.sliding_window_view(signal, 12)
    bars = ph.rips(windows, representatives="cycles")
    loop = windows[bars.representative(bars.longest(1)).loop()]
    closed = np.vstack([loop, loop[:1]])
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.4), constrained_layout=True,
                                gridspec_kw={"width_ratios": (1.6, 1, 1)})
    axes[0].plot(t, signal, color="black", linewidth=1)
    axes[0].set(xlabel="t", title="the signal")
    axes[1].scatter(windows[:, 0], windows[:, 6], s=6, color="black")
    axes[1].plot(closed[:, 0], closed[:, 6], color="C1", linewidth=1.5)
    axes[1].set(xlabel="value", ylabel="value 6 samples later", title="its windows, and their loop")
    bars.plot(ax=axes[2])
    figure.savefig(path, dpi=80, metadata={"Software": None})
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    matplotlib.use("agg")
    picture(*sys.argv[1:])
