#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the Python package with other packages on the same arrays, in one run. Each measurement
covers a whole interpreter.

    compare_python.py build/release --path FOLDER_WITH_A_PACKAGE --json results.json

A package that is neither installed nor in a folder given by --path leaves its cells empty. The
script measures user + system CPU seconds and peak resident memory of `python3 -c PROGRAM`: this
includes the start of the interpreter, imports and reading the array. The first row measures the
interpreter when it imports only NumPy. A separate run, which is not measured, compares the bars
with ours. Needs NumPy; bench/README.md explains the method.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
from dataclasses import dataclass

import numpy as np

import agreement
from measuring import Limits, Meter

# Pieces of the source code of the programs. Names in capitals, such as INPUT, are replaced. A
# program stores its result as `bars`, a list of (k, 2) arrays.
LOAD = "import numpy as np\nX = np.load(INPUT)\n"
LIBPH = "import libph as ph\nb = ph.CALL\nbars = [b.dgm(d) for d in range(DIM + 1)]\n"
RIPSER = ("from PACKAGE import ripser\n"
          "bars = ripser(X, maxdim=DIM, distance_matrix=MATRIX, MORE)['dgms']\n")
GIOTTO = ("from gph import ripser_parallel\n"
          "bars = ripser_parallel(X, maxdim=DIM, metric=METRIC, MORE)['dgms']\n")
COLLAPSE = "tree.collapse_edges()\ntree.expansion(DIM + 1)\n"
GUDHI_RIPS = ("import gudhi\n"
              "tree = gudhi.RipsComplex(WHAT=X, max_edge_length=LIMIT).create_simplex_tree(max_dimension=1)\n"
              + COLLAPSE + "tree.compute_persistence(2)\n"
              "bars = [tree.persistence_intervals_in_dimension(d) for d in range(DIM + 1)]\n")
GUDHI_IMAGE = ("import gudhi\nimage = gudhi.CubicalComplex(top_dimensional_cells=X)\nimage.compute_persistence(2)\n"
               "bars = [image.persistence_intervals_in_dimension(d) for d in range(DIM + 1)]\n")
CRIPSER = ("import PACKAGE\nrows = PACKAGE.computePH(X, maxdim=DIM)[:, :3]\n"
           "rows[rows[:, 2] > 1e300, 2] = np.inf\n"
           "bars = [rows[rows[:, 0] == d, 1:] for d in range(DIM + 1)]\n")


@dataclass(frozen=True)
class Row:
    name: str
    make: object  # a function without arguments that makes the input
    programs: dict  # name of a package: text of its program


def filled(text, **words):
    for name, value in words.items():
        text = text.replace(name.upper(), str(value))
    return LOAD + text


def rips_row(name, make, dim, matrix=False, limit=None):
    metric = "precomputed" if matrix else "euclidean"
    threshold = f"threshold={limit}" if limit else ""
    thresh = f"thresh={limit}" if limit else ""
    call = f"rips(X, max_dim={dim}, threads=1, metric={metric!r}, {threshold})"
    return Row(name, make, {
        "libph": filled(LIBPH, call=call, dim=dim),
        "libph.compat.ripser": filled(RIPSER, package="libph.compat.ripser", dim=dim, matrix=matrix,
                                      more=f"threads=1, {thresh}"),
        "ripser.py": filled(RIPSER, package="ripser", dim=dim, matrix=matrix, more=thresh),
        "giotto-ph": filled(GIOTTO, dim=dim, metric=repr(metric), more=thresh),
        "GUDHI": filled(GUDHI_RIPS.replace(COLLAPSE, "") if dim == 0 else GUDHI_RIPS, what="distance_matrix" if matrix else "points", dim=dim,
                        limit=limit or "float('inf')"),
    })


def image_row(name, make, construction):
    dim = name.count("³") + 1
    call = f"cubical(X, construction={construction!r}, threads=1)"
    programs = {"libph": filled(LIBPH, call=call, dim=dim)}
    if construction == "vertices":
        programs["cripser"] = filled(CRIPSER, package="cripser", dim=dim)
    else:
        programs["cripser"] = filled(CRIPSER, package="tcripser", dim=dim)
        programs["GUDHI"] = filled(GUDHI_IMAGE, dim=dim)
    return Row(name, make, programs)


def sphere(count, axes, seed):
    points = np.random.default_rng(seed).normal(size=(count, axes))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def uniform(count, axes, seed=1):
    return np.random.default_rng(seed).random((count, axes))


def distances(count, seed=1):
    points = uniform(count, 3, seed)
    return np.sqrt(((points[:, None] - points[None]) ** 2).sum(-1))


def noise(*shape):
    return np.random.default_rng(1).random(shape)


def waves(*shape):
    grids = np.meshgrid(*(np.linspace(0, 12, n) for n in shape), indexing="ij")
    return sum(np.sin((k + 1) * g) for k, g in enumerate(grids)) + np.cos(grids[0] * grids[-1])


ROWS = [
    rips_row("10 points of R³, H1", lambda: uniform(10, 3), 1),
    rips_row("1 000 uniform points of R³, H1", lambda: uniform(1000, 3), 1),
    rips_row("2 000 uniform points of R³, H1", lambda: uniform(2000, 3), 1),
    rips_row("1 000 points of R³ as distances, H1", lambda: distances(1000), 1, matrix=True),
    rips_row("300 points of the sphere S², H2", lambda: sphere(300, 3, 1), 2),
    rips_row("10 000 uniform points of R³, threshold 0.1, H1", lambda: uniform(10000, 3), 1, limit=0.1),
    rips_row("5 000 uniform points of the plane, H0", lambda: uniform(5000, 2), 0),
    image_row("picture 1024², noise, V", lambda: noise(1024, 1024), "vertices"),
    image_row("picture 1024², noise, T", lambda: noise(1024, 1024), "cells"),
    image_row("volume 64³, noise, V", lambda: noise(64, 64, 64), "vertices"),
    image_row("volume 64³, noise, T", lambda: noise(64, 64, 64), "cells"),
    image_row("volume 128³, waves, V", lambda: waves(128, 128, 128), "vertices"),
    image_row("volume 128³, waves, T", lambda: waves(128, 128, 128), "cells"),
]
PACKAGES = ("libph", "libph.compat.ripser", "ripser.py", "giotto-ph", "cripser", "GUDHI")


def bars_of(text, python):
    """The bars that a program finds, or the last line of its error message."""
    with tempfile.NamedTemporaryFile(suffix=".npz") as file:
        done = subprocess.run([python, "-c", text + f"np.savez({file.name!r}, *bars)\n"], capture_output=True, text=True)
        if done.returncode:
            return None, (done.stderr.strip().splitlines() or [f"exit {done.returncode}"])[-1]
        with np.load(file.name) as arrays:
            return {d: sorted(map(tuple, arrays[f"arr_{d}"])) for d in range(len(arrays.files))}, None


def compared(row, texts, python):
    """The programs that ran. Each has a description of the first difference from our bars, or
    None."""
    ours, complaint = bars_of(texts["libph"], python)
    if ours is None:
        raise SystemExit(f"{row.name}: libph: {complaint}")
    found = {}
    for who, text in texts.items():
        bars, complaint = bars_of(text, python)
        if bars is None:
            print(f"{row.name}: {who}: {complaint}", file=sys.stderr)
        else:
            found[who] = agreement.difference(ours, bars)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path, help="a build with PH_BUILD_PYTHON and PH_BUILD_BENCHMARKS")
    parser.add_argument("--path", action="append", default=[], help="a folder with a package; may be repeated")
    parser.add_argument("--python", default=sys.executable)
    parser.add_argument("--rows", default="", help="only rows with this in their name")
    parser.add_argument("--time-limit", type=int, default=300, help="CPU seconds of a run")
    parser.add_argument("--memory-limit", type=int, default=12 << 30, help="bytes of a run")
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()

    os.environ["PYTHONPATH"] = os.pathsep.join([str((options.build / "python").resolve()), *options.path])
    os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"
    meter = Meter(options.build / "bench" / "bench_run", Limits(options.time_limit, options.memory_limit))
    results, differs = [], False
    start = meter.best([options.python, "-c", "import numpy"])
    print(f"import numpy: {start.cpu:.3f} s / {start.peak:.0f} MB\n")
    print("| input | " + " | ".join(PACKAGES) + " | best / libph |\n|" + "---|" * (len(PACKAGES) + 2))
    for row in (row for row in ROWS if options.rows in row.name):
        with tempfile.NamedTemporaryFile(suffix=".npy") as file:
            np.save(file.name, row.make())
            texts = {who: text.replace("INPUT", repr(file.name)) for who, text in row.programs.items()}
            found = compared(row, texts, options.python)
            runs = dict(zip(found, meter.best_in_turns([[options.python, "-c", texts[who]] for who in found])))
        for who, difference in found.items():
            if difference:
                differs = True
                print(f"{row.name}: {who}: {difference}", file=sys.stderr)
        cells = [(f"{runs[who].cpu:.3f} / {runs[who].peak:.0f}" if runs[who].ok else runs[who].outcome)
                 if who in runs else "–" for who in PACKAGES]
        peers = [run.cpu for who, run in runs.items() if not who.startswith("libph") and run.ok]
        ratio = f"{min(peers) / runs['libph'].cpu:.3g}" if peers else "–"
        print(f"| {row.name} | " + " | ".join(cells) + f" | {ratio} |", flush=True)
        results.append({"row": row.name, "runs": {who: vars(run) for who, run in runs.items()}})
    if options.json:
        options.json.write_text(json.dumps({"numpy": vars(start), "rows": results}, indent=1))
    return 1 if differs else 0


if __name__ == "__main__":
    sys.exit(main())
