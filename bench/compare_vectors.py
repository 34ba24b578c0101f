#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the time to compute vectors of 10,000 uniform bars with the time that GUDHI's
representations need: compare_vectors.py BUILD [--gudhi-python PYTHON]

Our times are the rows of bench_vectors. Both packages are measured in CPU seconds of the
computation alone, the least of three runs. Prints a table in Markdown."""
import argparse
import re
import subprocess
import sys
from pathlib import Path

PEER = """
import time
import gudhi
import gudhi.representations as vectors
import numpy
bars = numpy.sort(numpy.random.default_rng(1).random((10_000, 2)), axis=1)
grid = {"resolution": 1000, "sample_range": [0, 1]}
pixels = {"resolution": [100, 100], "im_range": [0, 1, 0, 1], "weight": lambda p: p[1]}
print(gudhi.__version__)
for name, vectoriser in (
        ("Betti curve, 1000 points", vectors.BettiCurve(**grid)),
        ("silhouette, 1000 points", vectors.Silhouette(weight=lambda p: p[1] - p[0], **grid)),
        ("landscape, 5 x 1000", vectors.Landscape(num_landscapes=5, **grid)),
        ("image, 100 x 100, sigma 0.05", vectors.PersistenceImage(bandwidth=0.05, **pixels))):
    best = float("inf")
    for _ in range(3):
        start = time.process_time()
        vectoriser.fit_transform([bars])
        best = min(best, time.process_time() - start)
    print(f"{name}  {1000 * best} ms")
"""


def rows_of(*command):
    """The milliseconds of each row by its name, and the first line of the output."""
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return ({name.strip(): float(ms) for name, ms in re.findall(r"(?m)^(\S.*?) {2,}([\d.]+) ms$", text)},
            text.splitlines()[0])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("--gudhi-python", default=sys.executable)
    arguments = parser.parse_args()
    ours, _ = rows_of(arguments.build / "bench/bench_vectors", "0")
    peers, version = rows_of(arguments.gudhi_python, "-c", PEER)
    print(f"| vector | libph: ms | GUDHI {version}: ms | GUDHI / libph |\n|---|---|---|---|")
    for name, ms in ours.items():
        peer = peers.get(name)
        print(f"| {name} | {ms:.3g} | {f'{peer:.3g}' if peer else '–'} | {f'{peer / ms:.0f}' if peer else '–'} |")


if __name__ == "__main__":
    main()
