#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Compares libph's barcodes with the barcodes of another program: compare.py ripser|gudhi CASES

Exits with 77 if the other program is not installed.
"""
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

SKIPPED = 77


def normal(bars):
    """A barcode without empty bars, as a sorted list of (dim, birth, death)."""
    return sorted((int(d), b, e) for d, b, e in bars if b < e)


def ripser_bars(case, folder):
    path = os.path.join(folder, f"{case['number']}.lower")
    with open(path, "w") as file:
        at = 0
        for i in range(1, case["points"]):
            file.write(",".join(f"{d:.0f}" for d in case["lower"][at:at + i]) + "\n")
            at += i
    # The format is named explicitly, because the default format of Debian's Ripser 1.2.1 is not the
    # format that its help states. Ripser also aborts on --dim 0.
    command = ["ripser", "--format", "lower-distance", "--dim", str(max(1, case["max_dim"]))]
    if case["threshold"] is not None:
        command += ["--threshold", str(case["threshold"])]
    output = subprocess.run(command + [path], check=True, capture_output=True, text=True).stdout
    os.remove(path)
    bars, dim = [], None
    for line in output.splitlines():
        if found := re.match(r"persistence intervals in dim (\d+)", line):
            dim = int(found[1])
        elif found := re.match(r" \[([^,]+), ?([^)]*)\)", line):
            bars.append((dim, float(found[1]), float(found[2]) if found[2] else math.inf))
    return normal(bar for bar in bars if bar[0] <= case["max_dim"])


def gudhi_bars(case):
    import gudhi
    import numpy

    field = case["field"]
    if case["kind"] == "cubical":
        shape = [int(n) for n in case["extents"]]
        voxels = numpy.array(case["values"]).reshape(shape)
        if any(case["periodic"]):
            complex_ = gudhi.PeriodicCubicalComplex(
                top_dimensional_cells=voxels, periodic_dimensions=[bool(p) for p in case["periodic"]])
        else:
            complex_ = gudhi.CubicalComplex(top_dimensional_cells=voxels)
        pairs = complex_.persistence(homology_coeff_field=field, min_persistence=0)
        return normal((d, b, e) for d, (b, e) in pairs)
    if case["kind"] == "rips":
        at, rows = 0, []
        for i in range(case["points"]):
            rows.append(case["lower"][at:at + i])
            at += i
        limit = math.inf if case["threshold"] is None else case["threshold"]
        tree = gudhi.RipsComplex(distance_matrix=rows, max_edge_length=limit).create_simplex_tree(
            max_dimension=case["max_dim"] + 1)
        top = case["max_dim"]
    else:
        tree = gudhi.SimplexTree()
        for vertices, value in case["simplices"]:
            tree.insert([int(v) for v in vertices], value)
        top = tree.dimension()
    # By default, GUDHI leaves out the highest dimension of a complex. Here it is computed. Bars
    # above `top` are then removed, because the simplices that end them are cut off.
    pairs = tree.persistence(homology_coeff_field=field, min_persistence=0,
                             persistence_dim_max=True)
    return normal((d, b, e) for d, (b, e) in pairs if d <= top)


def distance_failures(cases):
    """The number of bottleneck distances that differ from GUDHI's, which are exact up to
    rounding."""
    import gudhi

    failed = 0
    for case in cases:
        theirs = gudhi.bottleneck_distance(case["first"], case["second"], e=0)
        if not math.isclose(case["bottleneck"], theirs, rel_tol=1e-12):
            failed += 1
            print(f"case {case['number']}: {json.dumps(case)}\n  gudhi {theirs}")
    finite = sum(case["bottleneck"] < math.inf for case in cases)
    print(f"{len(cases) - failed} passed, {failed} failed (bottleneck distances compared with "
          f"gudhi, {finite} of them finite)")
    return failed if finite else 1


def main():
    peer, path = sys.argv[1:]
    with open(path) as file:
        cases = [json.loads(line) | {"number": i} for i, line in enumerate(file)]
    pairs = [case for case in cases if case["kind"] == "distance"]
    cases = [case for case in cases if case["kind"] != "distance"]
    failed = 0
    if peer == "ripser":
        if not shutil.which("ripser"):
            print("SKIPPED: the program ripser is not installed (apt install ripser)")
            return SKIPPED
        cases = [case for case in cases if case["kind"] == "rips"]
        with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(4) as pool:
            results = list(pool.map(lambda case: ripser_bars(case, folder), cases))
        ours = [normal(case["bars_over_2"]) for case in cases]
    else:
        try:
            import gudhi  # noqa: F401
            import numpy  # noqa: F401
        except ImportError as error:
            print(f"SKIPPED: {error} (apt install python3-gudhi python3-numpy)")
            return SKIPPED
        failed = distance_failures(pairs)
        results = [gudhi_bars(case) for case in cases]
        ours = [normal(case["bars"]) for case in cases]

    differ = 0
    for case, found, expected in zip(cases, ours, results):
        if found == expected:
            continue
        differ += 1
        if differ <= 3:
            print(f"case {case['number']}: {json.dumps(case)}\n  libph {found}\n  {peer} {expected}")
    print(f"{len(cases) - differ} passed, {differ} failed (barcodes compared with {peer})")
    return 1 if failed or differ or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
