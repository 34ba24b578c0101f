#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the data in this folder, which pages of docs/ use: make.py. Needs only the standard
library, and makes the same files each time."""
import gzip
import math
import random
import struct
from pathlib import Path

HERE = Path(__file__).resolve().parent


def torus():
    """600 points near a torus with the radii 2 and 1: two loops, one void."""
    rng = random.Random(1)
    lines = ["x,y,z"]
    while len(lines) <= 600:
        turn, tube = rng.uniform(0, 2 * math.pi), rng.uniform(0, 2 * math.pi)
        from_axis = 2 + math.cos(tube)
        if rng.random() * 3 > from_axis:
            continue  # rejected at random, for a uniform density on the surface
        point = (from_axis * math.cos(turn), from_axis * math.sin(turn), math.sin(tube))
        lines.append(",".join(f"{x + rng.gauss(0, 0.03):.4f}" for x in point))
    (HERE / "torus.csv").write_text("\n".join(lines) + "\n")


def phantom():
    """A head as a scanner sees it, 32 x 40 x 32 voxels as NIfTI: a bright skull around a brain with
    two dark ventricles and a small dark lesion."""
    rng = random.Random(2)
    shape = (32, 40, 32)

    def within(x, y, z, centre, radii):
        return sum(((p - c) / r) ** 2 for p, c, r in zip((x, y, z), centre, radii)) <= 1

    voxels = bytearray()
    for z in range(shape[2]):
        for y in range(shape[1]):
            for x in range(shape[0]):
                value = 10
                if within(x, y, z, (15.5, 19.5, 15.5), (14, 18, 14)):
                    value = 210
                if within(x, y, z, (15.5, 19.5, 15.5), (11.5, 15.5, 11.5)):
                    value = 120
                if within(x, y, z, (11.5, 18.5, 16), (2.5, 6, 3)) or within(x, y, z, (19.5, 18.5, 16), (2.5, 6, 3)):
                    value = 40
                if within(x, y, z, (17, 29, 12), (2, 2, 2)):
                    value = 60
                voxels.append(max(0, min(255, round(value + rng.gauss(0, 6)))))
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *shape, 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 2, 8)  # data type 2, 8 bits: unsigned bytes
    struct.pack_into("<8f", header, 76, 1, 5, 5, 5, 1, 1, 1, 1)
    struct.pack_into("<3f", header, 108, 352, 1, 0)
    header[344:348] = b"n+1\0"
    with open(HERE / "phantom.nii.gz", "wb") as file, gzip.GzipFile("", "wb", mtime=0, fileobj=file) as packed:
        packed.write(bytes(header) + bytes(voxels))


def hills():
    """A height field of 30 x 30 vertices as PLY: two peaks, a pass between them, and a crater."""
    rng = random.Random(3)
    n = 30
    lines = ["ply", "format ascii 1.0", f"element vertex {n * n}", "property float x", "property float y",
             "property float z", f"element face {2 * (n - 1) ** 2}", "property list uchar int vertex_indices",
             "end_header"]

    def bump(x, y, at, width):
        return math.exp(-((x - at[0]) ** 2 + (y - at[1]) ** 2) / width ** 2)

    for i in range(n):
        for j in range(n):
            x, y = 3 * i / (n - 1), 3 * j / (n - 1)
            z = (bump(x, y, (0.9, 1.0), 0.6) + 0.8 * bump(x, y, (2.2, 2.0), 0.65)
                 - 0.45 * bump(x, y, (2.2, 2.0), 0.28) + rng.gauss(0, 0.006))
            lines.append(f"{x:.4f} {y:.4f} {z:.4f}")
    for i in range(n - 1):
        for j in range(n - 1):
            a, b, c, d = i * n + j, (i + 1) * n + j, (i + 1) * n + j + 1, i * n + j + 1
            lines += [f"3 {a} {b} {c}", f"3 {a} {c} {d}"]
    (HERE / "hills.ply").write_text("\n".join(lines) + "\n")


def waves(rng, count, samples):
    """Cosine waves with noise. Each wave lags one step behind the previous wave."""
    return [[math.cos(2 * math.pi * (5 * i / samples - k / count)) + rng.gauss(0, 0.2) for i in range(samples)]
            for k in range(count)]


def correlations():
    """Correlations of twelve sensors around a ring, as a table written by pandas."""
    signals = waves(random.Random(4), 12, 120)
    names = [f"sensor{k + 1}" for k in range(12)]

    def centred(values):
        mean = sum(values) / len(values)
        values = [v - mean for v in values]
        norm = math.sqrt(sum(v * v for v in values))
        return [v / norm for v in values]

    rows = [centred(values) for values in signals]
    lines = ["," + ",".join(names)]
    for i, (name, row) in enumerate(zip(names, rows)):
        numbers = (1.0 if i == j else round(sum(a * b for a, b in zip(row, other)), 4) for j, other in enumerate(rows))
        lines.append(name + "," + ",".join(f"{r:g}" for r in numbers))
    (HERE / "correlations.csv").write_text("\n".join(lines) + "\n")


def pulse():
    """A signal of 300 samples: ten beats with noise."""
    rng = random.Random(5)
    lines = ["t,value"]
    for i in range(300):
        phase = (i / 30) % 1
        value = math.exp(-((phase - 0.3) / 0.07) ** 2) + 0.35 * math.exp(-((phase - 0.6) / 0.1) ** 2)
        lines.append(f"{i / 100:.2f},{value + rng.gauss(0, 0.03):.4f}")
    (HERE / "pulse.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    for make in (torus, phantom, hills, correlations, pulse):
        make()
