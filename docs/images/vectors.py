#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the vectors of one barcode: vectors.py BARS.csv OUT.png. The numbers come from
ph-vectorise, which must be on the path; needs matplotlib."""
import csv
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

DIM, POINTS, PIXELS, LAYERS, RANGE = "1", 400, 60, 3, (0.0, 1.8)
COLOURS = ("#1f77b4", "#ff7f0e", "#2ca02c")


def vector(bars, kind, *options):
    with tempfile.NamedTemporaryFile(suffix=".csv") as out:
        subprocess.run(["ph-vectorise", bars, "--kind", kind, "--dims", DIM, *options, "-o", out.name, "--quiet",
                        "--force"], check=True)
        with open(out.name, encoding="utf-8") as file:
            return [float(x) for x in list(csv.reader(file))[1][1:]]


def curve(axes, values, label, count=1):
    low, high = RANGE
    at = [low + (high - low) * i / (POINTS - 1) for i in range(POINTS)]
    for k in range(count):
        axes.plot(at, values[k * POINTS:(k + 1) * POINTS], color=COLOURS[k], linewidth=1.4)
    axes.set_title(label, fontsize=9)
    axes.set_xlim(*RANGE)
    axes.set_ylim(bottom=0)


def main(bars, out):
    with open(bars, encoding="utf-8") as file:
        rows = [(float(r["birth"]), float(r["death"])) for r in csv.DictReader(file) if r["dim"] == DIM]
    figure, grid = plt.subplots(2, 3, figsize=(8.4, 4.6), layout="constrained")
    axes = iter(grid.flat)
    diagram = next(axes)
    for k, (birth, death) in enumerate(sorted(rows)):
        diagram.plot([birth, death], [k, k], color=COLOURS[0], linewidth=3)
    diagram.set_title("bars of H1", fontsize=9)
    diagram.set_yticks([])
    diagram.set_xlim(*RANGE)
    diagram.set_ylim(-1, len(rows))
    on_grid = ["--grid", f"{RANGE[0]},{RANGE[1]},{POINTS}"]
    curve(next(axes), vector(bars, "betti", *on_grid), "betti")
    curve(next(axes), vector(bars, "landscape", "--layers", str(LAYERS), *on_grid), "landscape, 3 layers", LAYERS)
    curve(next(axes), vector(bars, "silhouette", *on_grid), "silhouette")
    curve(next(axes), vector(bars, "life-entropy", *on_grid), "life-entropy")
    image = next(axes)
    pixels = vector(bars, "image", "--grid", f"-0.2,0.6,{PIXELS}", "--length-grid", f"0,1.8,{PIXELS}",
                    "--sigma", "0.08")
    image.imshow([pixels[i * PIXELS:(i + 1) * PIXELS] for i in range(PIXELS)], origin="lower", aspect="auto",
                 extent=(-0.2, 0.6, 0, 1.8), cmap="viridis")
    image.set_title("image", fontsize=9)
    image.set_xlabel("birth", fontsize=8)
    image.set_ylabel("length", fontsize=8)
    for panel in grid.flat:
        panel.tick_params(labelsize=7)
    figure.savefig(out, dpi=110, metadata={"Software": None})


if __name__ == "__main__":
    main(*sys.argv[1:3])
