#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the cost of alpha complexes with the cost of CGAL's triangulation alone, and with GUDHI:
compare_alpha.py BUILD [--gudhi-python PYTHON] [--million] [ROW…]

Measures whole programs on one thread, including the time to read the input: CPU seconds (the least
of three runs, or the only run if it is long) and peak memory. GUDHI runs in the faster of its modes
`safe` and `exact`, because its mode `fast` guarantees nothing. Bars are compared by their total
length in each dimension. Prints a table in Markdown."""
import argparse
import math
import os
import random
import resource
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

PEER = """
import sys, numpy, gudhi
points = numpy.load(sys.argv[1])
weights = numpy.load(sys.argv[3]).tolist() if len(sys.argv) > 3 else None
tree = gudhi.AlphaComplex(points=points, weights=weights, precision=sys.argv[2]).create_simplex_tree()
tree.compute_persistence(homology_coeff_field=2, persistence_dim_max=True)
for dim in range(points.shape[1]):
    bars = tree.persistence_intervals_in_dimension(dim)
    bars = bars[numpy.isfinite(bars).all(axis=1)] if len(bars) else numpy.empty((0, 2))
    print(len(bars), (bars[:, 1] - bars[:, 0]).sum())
"""


def uniform(count, dims=3):
    return [[random.random() for _ in range(dims)] for _ in range(count)]


def sphere(count):
    found = []
    for _ in range(count):
        x = [random.gauss(0, 1) for _ in range(3)]
        length = math.sqrt(sum(c * c for c in x))
        found.append([c / length for c in x])
    return found


def torus(count):
    found = []
    while len(found) < count:
        u, v = random.uniform(0, 2 * math.pi), random.uniform(0, 2 * math.pi)
        if random.random() * 1.4 < 1 + 0.4 * math.cos(v):
            far = 1 + 0.4 * math.cos(v)
            found.append([far * math.cos(u), far * math.sin(u), 0.4 * math.sin(v)])
    return found


def clusters(count):
    centres = uniform(50)
    return [[c + random.gauss(0, 0.02) for c in random.choice(centres)] for _ in range(count)]


def grid(side):
    return [[x, y, z] for x in range(side) for y in range(side) for z in range(side)]


ROWS = {"10 000 in a cube": lambda: uniform(10_000), "100 000 in a cube": lambda: uniform(100_000),
        "100 000 on a sphere": lambda: sphere(100_000), "100 000 on a torus": lambda: torus(100_000),
        "100 000 in 50 clusters": lambda: clusters(100_000), "grid of 46³": lambda: grid(46),
        "100 000 in a cube, weighted": lambda: uniform(100_000)}
MILLION = {"1 000 000 in a square": lambda: uniform(1_000_000, 2),
           "1 000 000 in a cube": lambda: uniform(1_000_000)}


def write(path, rows):
    """Writes rows of float64 as an NPY file."""
    shape = f"({len(rows)}, {len(rows[0])})" if isinstance(rows[0], list) else f"({len(rows)},)"
    header = f"{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}".ljust(117) + "\n"
    flat = [x for row in rows for x in row] if isinstance(rows[0], list) else rows
    with open(path, "wb") as file:
        file.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode())
        file.write(struct.pack(f"<{len(flat)}d", *flat))


def measure(command, folder):
    """@return CPU seconds, peak memory in MB, output."""
    best = None
    for _ in range(3):
        out = open(folder / "out", "w+")
        process = subprocess.Popen(command, stdout=out, stderr=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        if status:
            return None
        out.seek(0)
        found = used.ru_utime + used.ru_stime, used.ru_maxrss * 1024 / 1e6, out.read()
        if best is None or found[0] < best[0]:
            best = found
        if found[0] > 5:
            break
    return best


def bars_of(path):
    """For each dimension, the number of finite bars and their total length."""
    found = {}
    with open(path) as file:
        next(file)
        for line in file:
            dim, birth, death = line.split(",")[:3]
            if death.strip() != "inf":
                count, length = found.get(int(dim), (0, 0.0))
                found[int(dim)] = count + 1, length + float(death) - float(birth)
    return found


def agree(ours, peers):
    """True if the total lengths of the bars agree in each dimension. The numbers of bars are not
    compared, because a bar of length 0 may get a tiny positive length in GUDHI through rounding."""
    for dim, line in enumerate(peers.splitlines()):
        length = float(line.split()[1])
        if not math.isclose(ours.get(dim, (0, 0.0))[1], length, rel_tol=1e-6, abs_tol=1e-9):
            return False
    return True


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("rows", nargs="*")
    parser.add_argument("--gudhi-python", default=sys.executable)
    parser.add_argument("--million", action="store_true")
    arguments = parser.parse_args()
    random.seed(1)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    program = arguments.build / "apps/barcode/ph-barcode"
    bench = arguments.build / "bench/bench_alpha"
    print("| points | libph s | MB | CGAL's triangulation s | libph / CGAL | GUDHI s | MB | GUDHI / libph |")
    print("|---|---|---|---|---|---|---|---|")
    rows = {**ROWS, **(MILLION if arguments.million else {})}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for row, make in rows.items():
            if arguments.rows and row not in arguments.rows:
                continue
            points = make()
            write(folder / "points.npy", points)
            weights, peer_weights = [], []
            if row.endswith("weighted"):
                write(folder / "weights.npy", [random.uniform(0, 1e-4) for _ in points])
                weights = ["--weights", folder / "weights.npy"]
                peer_weights = [folder / "weights.npy"]
            ours = measure([program, folder / "points.npy", "--complex", "alpha", "--alpha-values", "squared",
                            *weights, "--threads", "1", "--quiet", "-o", folder / "bars.csv"], folder)
            alone = measure([bench, "delaunay", folder / "points.npy"], folder)
            triangulation = float(alone[2].split()[0])
            computed = measure([bench, "bars", folder / "points.npy"], folder)
            ratio = "–" if weights else f"{float(computed[2].split()[0]) / triangulation:.2f}"
            peers = [measure([arguments.gudhi_python, "-c", PEER, folder / "points.npy", mode, *peer_weights],
                             folder) for mode in ("safe", "exact")]
            peers = [peer for peer in peers if peer]
            peer = min(peers, default=None)
            text = "– | – | –"
            if peer:
                text = f"{peer[0]:.3g} | {peer[1]:.0f} | {peer[0] / ours[0]:.1f}"
                if not agree(bars_of(folder / "bars.csv"), peer[2]):
                    text += " (other bars)"
            print(f"| {row} | {ours[0]:.3g} | {ours[1]:.0f} | {triangulation:.3g} | {ratio} | {text} |", flush=True)


if __name__ == "__main__":
    main()
