#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares HDBSCAN of libph with other packages on the same points, in one run:

    compare_clusters.py build/release --python PYTHON --machine 'two shared cores'

PYTHON is an interpreter that has the other packages; a package that it lacks is left out with a
message. Each fit runs in a process of its own, on one thread. The script measures only the fit: its
user + system CPU seconds, and the bytes per point by which the peak of resident memory exceeds the
memory before the fit. Imports, reading the points and the compilation of a first small fit are not
counted. It compares the values of all merges with those of libph, and writes the table
bench/results/clusters.csv. bench/README.md explains the method.
"""
import argparse
import csv
import datetime
import os
import pathlib
import subprocess
import sys
import tempfile
from dataclasses import dataclass

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from measuring import LONG, Limits, Meter  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
NEIGHBOURS = 5  # the core distance is the distance to this neighbour; also the least cluster size
WARM = 500  # points of the first fit, which is not measured

# A program imports its package, and defines the functions `fit` and `values_of`, which gives the
# values of all merges.
LIBPH = """
from libph.sklearn import HDBSCAN
def fit(X):
    return HDBSCAN(min_cluster_size=K, min_samples=K + 1).fit(X)
def values_of(found):
    return found.cluster_tree_.values
"""
CONTRIB = """
from hdbscan import HDBSCAN
def fit(X):
    return HDBSCAN(min_cluster_size=K, min_samples=K, core_dist_n_jobs=1).fit(X)
def values_of(found):
    return found.single_linkage_tree_.to_numpy()[:, 2]
"""
FAST = """
from fast_hdbscan import HDBSCAN
def fit(X):
    return HDBSCAN(min_cluster_size=K, min_samples=K).fit(X)
def values_of(found):
    return found.single_linkage_tree_.to_numpy()[:, 2]
"""
SKLEARN = """
from sklearn.cluster import HDBSCAN
def fit(X):
    return HDBSCAN(min_cluster_size=K, min_samples=K + 1, n_jobs=1, copy=False).fit(X)
def values_of(found):
    return found._single_linkage_tree_["value"]
"""
# The name of each package, its distribution, and its program.
PACKAGES = {"libph": (None, LIBPH), "hdbscan": ("hdbscan", CONTRIB),
            "fast_hdbscan": ("fast_hdbscan", FAST), "scikit-learn": ("scikit-learn", SKLEARN)}
MEASURE = """
import resource, sys
import numpy as np
def report(kind, error, trace):  # on both outputs: the meter reads one, this script the other
    print(f"{kind.__name__}:", *str(error).split())
    sys.__excepthook__(kind, error, trace)
sys.excepthook = report
PROGRAM
def status(name):
    with open("/proc/self/status") as file:
        return next(1024 * int(line.split()[1]) for line in file if line.startswith(name))
def seconds():
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime
X = np.load(INPUT)
fit(X[:WARM])
with open("/proc/self/clear_refs", "w") as file:
    file.write("5")  # from now on, VmHWM is the peak of what follows
before, start = status("VmRSS"), seconds()
found = fit(X)
taken = seconds() - start
print(taken, (status("VmHWM") - before) / len(X))
np.save(OUTPUT, np.sort(values_of(found)))
"""


@dataclass(frozen=True)
class Fit:
    outcome: str  # "ok", or the reason why there are no figures
    seconds: float = 0.0
    bytes_per_point: float = 0.0


def uniform(rng, count, axes):
    return rng.random((count, axes))


def blobs(rng, count, axes):
    """50 normal distributions of different widths in a unit cube, and 5 % noise."""
    centres, widths = rng.random((50, axes)), rng.uniform(0.005, 0.05, 50)
    group = rng.integers(50, size=count)
    points = centres[group] + rng.normal(size=(count, axes)) * widths[group, None]
    noise = rng.random(count) < 0.05
    points[noise] = rng.random((noise.sum(), axes))
    return points


def patches(rng, count, axes):
    """20 clusters, each near a random affine subspace of 8 dimensions."""
    points, group = rng.normal(0, 0.02, (count, axes)), rng.integers(20, size=count)
    for g in range(20):
        rows = group == g
        frame, _ = np.linalg.qr(rng.normal(size=(axes, 8)))
        points[rows] += rng.normal(size=axes) + rng.normal(0, 0.3, (rows.sum(), 8)) @ frame.T
    return points


# Number of points, axes, their kind, its words, and whether the page shows the row.
ROWS = [(100_000, 2, blobs, "blobs", True), (100_000, 2, uniform, "uniform", False),
        (100_000, 3, blobs, "blobs", False), (100_000, 3, uniform, "uniform", True),
        (1_000_000, 2, blobs, "blobs", True), (1_000_000, 2, uniform, "uniform", False),
        (1_000_000, 3, blobs, "blobs", True), (1_000_000, 3, uniform, "uniform", False),
        (100_000, 8, blobs, "blobs", True), (100_000, 8, uniform, "uniform", True),
        (20_000, 50, patches, "20 clusters, each near a subspace of 8 axes", True)]


def spaced(count):
    return f"{count:,}".replace(",", " ")


def name_of(count, axes, words):
    exponent = str(axes).translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{spaced(count)} points of R{exponent}, {words}"


def installed(python):
    """The packages of an interpreter, with their versions."""
    found = {"libph": ""}
    for name, (distribution, _) in PACKAGES.items():
        if distribution:
            code = f"import importlib.metadata as m; print(m.version({distribution!r}))"
            done = subprocess.run([python, "-c", code], capture_output=True, text=True)
            if done.returncode:
                print(f"left out: {name}, which {python} does not have", file=sys.stderr)
            else:
                found[name] = done.stdout.strip()
    return found


class Bench:
    """Runs the fits of one row; the packages take turns."""

    def __init__(self, options):
        limits = Limits(options.time_limit, options.memory_limit)
        self._meter = Meter(options.build / "bench" / "bench_run", limits)
        self._python = options.python

    def row(self, points, packages):
        """The best fit of each package, and how far its values are from libph's, as a share."""
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder, "points.npy")
            np.save(source, points)
            fits = {name: [] for name in packages}
            while waiting := [name for name in packages if not self._enough(fits[name])]:
                for name in waiting:
                    fits[name].append(self._fit(name, source, pathlib.Path(folder, f"{name}.npy")))
            best = {name: min(runs, key=lambda fit: fit.seconds) if runs[-1].outcome == "ok"
                    else runs[-1] for name, runs in fits.items()}
            values = {name: np.load(pathlib.Path(folder, f"{name}.npy"))
                      for name, fit in best.items() if fit.outcome == "ok"}
        ours = values.pop("libph", None)
        return best, {} if ours is None else {
            name: difference(ours, theirs) for name, theirs in values.items()}

    @staticmethod
    def _enough(runs):
        return bool(runs) and (runs[-1].outcome != "ok" or len(runs) >= 3
                               or sum(fit.seconds for fit in runs) >= LONG)

    def _fit(self, name, source, output):
        text = MEASURE
        for word, value in {"PROGRAM": PACKAGES[name][1], "INPUT": repr(str(source)),
                            "OUTPUT": repr(str(output)), "WARM": WARM}.items():
            text = text.replace(word, str(value))
        with tempfile.TemporaryFile("w+") as printed:
            run = self._meter.run([self._python, "-c", f"K = {NEIGHBOURS}\n{text}"], printed)
            printed.seek(0)
            *_, last = printed.read().splitlines() or [""]
        if run.ok:
            return Fit("ok", *map(float, last.split()))
        print(f"{name}: {run.outcome}: {last}", file=sys.stderr)
        return Fit(run.outcome)


def difference(ours, theirs):
    """The largest difference between sorted values, as a share of the value; infinite if the
    numbers of values differ."""
    if len(ours) != len(theirs):
        return float("inf")
    scale = np.maximum(np.abs(ours), np.finfo(float).tiny)
    return float(np.max(np.abs(ours - theirs) / scale, initial=0.0))


def cells_of(fit, options):
    if fit is not None and fit.outcome == "ok":
        return [f"{fit.seconds:.3g}", f"{fit.bytes_per_point:.0f}"]
    limits = {"time": f"beyond {options.time_limit} s",
              "memory": f"beyond {options.memory_limit >> 30} GiB"}
    return [limits.get(fit.outcome, "–") if fit else "–", ""]


def said_of(who, fit, difference_of_values, options):
    """A fit in words, for the terminal."""
    seconds, memory = cells_of(fit, options)
    words = f"{who} {seconds} s, {memory} B per point" if memory else f"{who} {seconds}"
    return words + (f", values differ by {difference_of_values:.1g}"
                    if difference_of_values > 1e-9 else "")


def table(results, versions, options):
    """The rows of the CSV file, with its header."""
    header = ["shown", "input", *(f"{name} {unit}" for name in PACKAGES for unit in ("s", "B")),
              "best / libph", "script", "machine", "date", "versions"]
    source = [pathlib.Path(__file__).resolve().relative_to(ROOT).as_posix(), options.machine,
              datetime.date.today().isoformat(),
              ", ".join(f"{name} {version}" for name, version in versions.items() if version)]
    rows = []
    for shown, name, best in results:
        peers = [fit.seconds for who, fit in best.items() if who != "libph" and fit.outcome == "ok"]
        is_known = peers and best["libph"].outcome == "ok"
        ratio = f"{min(peers) / best['libph'].seconds:.3g}" if is_known else "–"
        cells = [cell for who in PACKAGES for cell in cells_of(best.get(who), options)]
        rows.append(["yes" if shown else "", name, *cells, ratio, *source])
    return [header, *rows]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path,
                        help="a build with PH_BUILD_PYTHON and PH_BUILD_BENCHMARKS")
    parser.add_argument("--python", default=sys.executable,
                        help="an interpreter with the other packages")
    parser.add_argument("--path", type=pathlib.Path,
                        help="the folder that has libph (default: BUILD/python)")
    parser.add_argument("--rows", default="", help="only rows with this in their name")
    parser.add_argument("--share", type=float, default=1.0,
                        help="of the points of each row, to try the script")
    parser.add_argument("--time-limit", type=int, default=600, help="CPU seconds of a process")
    parser.add_argument("--memory-limit", type=int, default=12 << 30, help="bytes of a process")
    parser.add_argument("--machine", required=True, help="words about the machine, for the table")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "bench/results/clusters.csv")
    options = parser.parse_args()

    os.environ["PYTHONPATH"] = str((options.path or options.build / "python").resolve())
    for library in ("OMP", "OPENBLAS", "MKL", "NUMBA"):
        os.environ[f"{library}_NUM_THREADS"] = "1"
    versions, bench, results = installed(options.python), Bench(options), []
    for count, axes, make, words, shown in ROWS:
        count = max(int(count * options.share), WARM)
        name = name_of(count, axes, words)
        if options.rows not in name:
            continue
        best, differences = bench.row(make(np.random.default_rng(1), count, axes), versions)
        results.append((shown, name, best))
        print(f"{name}:", "; ".join(said_of(who, fit, differences.get(who, 0), options)
                                    for who, fit in best.items()), flush=True)
    with options.output.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(table(results, versions, options))


if __name__ == "__main__":
    main()
