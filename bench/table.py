#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints tables that compare engines and cloud readers with peers: table.py BUILD_DIR [--ripser
PROGRAM] [--gudhi-python PYTHON] [--scenes FOLDER] [--repeat N].

Measures user + system CPU seconds and peak resident memory on one thread, the best of N runs; our
program and the peer run alternately. Peers print nothing or to /dev/null; our programs write no
output. Needs numpy for the inputs. A peer that is not given is left out."""
import argparse
import json
import pathlib
import subprocess
import tempfile

import numpy

from measuring import Meter

GUDHI_CUBICAL = """
import resource, sys
import numpy, gudhi
values = numpy.load(sys.argv[1])
before = resource.getrusage(resource.RUSAGE_SELF)
# vertices=… came later than 3.7: the T-construction of the same array has as many cells and more.
complex = gudhi.CubicalComplex(dimensions=values.shape, top_dimensional_cells=values.flatten(order="F"))
complex.compute_persistence(homology_coeff_field=2)
after = resource.getrusage(resource.RUSAGE_SELF)
print(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, after.ru_maxrss * 1024 / 1e6)
"""


def measure_gudhi(python, volume, repeat):
    runs = [subprocess.run([python, "-c", GUDHI_CUBICAL, volume], capture_output=True, text=True, check=True)
            for _ in range(repeat)]
    return min(tuple(map(float, run.stdout.split())) for run in runs)


def row(name, ours, theirs, peer):
    text = f"| {name} | {ours[0]:.2f} / {ours[1]:.0f} | "
    if theirs:
        text += f"{peer} {theirs[0]:.2f} / {theirs[1]:.0f} | {theirs[0] / ours[0]:.1f} |"
    else:
        text += "– | – |"
    print(text, flush=True)


def smooth_volume(n, generator):
    x, y, z = numpy.meshgrid(*[numpy.arange(n)] * 3, indexing="ij")
    return (numpy.sin(0.3 * x) + numpy.cos(0.23 * y + 1) * numpy.sin(0.31 * z)
            + 0.05 * generator.random((n, n, n)))


def engines(arguments, folder):
    barcode = arguments.build / "apps/barcode/ph-barcode"
    meter = Meter(arguments.build / "bench/bench_run", repeat=arguments.repeat)

    def measure(*command):
        best = meter.best(command)
        if not best.ok:
            raise SystemExit(f"{command}: {best.outcome}")
        return best.cpu, best.peak

    ours = lambda *options: measure(barcode, *options, "--threads", "1", "--quiet", "--output-format", "none")
    print("| input | libph: s / MB | peer: s / MB | peer / libph |\n|---|---|---|---|")
    generator = numpy.random.default_rng(1)
    points = folder / "points.txt"
    numpy.savetxt(points, generator.random((1000, 3)))
    theirs = arguments.ripser and measure(arguments.ripser, "--format", "point-cloud", "--dim", "1", points)
    row("Rips H1, 1 000 random points of R³, `cohomology`",
        ours(points, "--max-dim", "1", "--engine", "cohomology"), theirs, "Ripser")
    volumes = {"noise": generator.random((64, 64, 64)), "smooth": smooth_volume(64, generator)}
    volumes["8-bit"] = numpy.floor(255 * volumes["noise"])
    for name, values in volumes.items():
        path = folder / f"{name}.npy"
        numpy.save(path, values)
        theirs = arguments.gudhi_python and measure_gudhi(arguments.gudhi_python, path, arguments.repeat)
        row(f"cubical H0–H2, 64³ {name} (T), `gradient`",
            ours(path, "--engine", "gradient", "--construction", "cells"), theirs, "GUDHI")


def readers(arguments):
    program = arguments.build / "bench/bench_readers"
    if not program.exists():
        return
    scenes = sorted(arguments.scenes.glob("*.pcd"))[:3] if arguments.scenes else []
    run = subprocess.run([program, *scenes, "--benchmark_format=json", "--benchmark_min_time=1"],
                         capture_output=True, text=True, check=True)
    print("\n| reader | CPU ms | MB/s |\n|---|---|---|")
    for b in json.loads(run.stdout)["benchmarks"]:
        print(f"| {b['name']} | {b['cpu_time']:.1f} | {b['bytes_per_second'] / 1e6:.0f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--ripser")
    parser.add_argument("--gudhi-python")
    parser.add_argument("--scenes", type=pathlib.Path)
    parser.add_argument("--repeat", type=int, default=3)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        engines(arguments, pathlib.Path(folder))
        readers(arguments)


if __name__ == "__main__":
    main()
