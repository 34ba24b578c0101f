#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares an image on several MPI ranks with the same image in one process, and with other MPI
programs.

    compare_ranks.py build/release --rows 128³ --ranks 1,2,4 --peer 'OTHER 1.0 = PROGRAM {input} {output}'

In a peer's command, {input} is a .npy file of float32 in C order, and {output} is a path to which
the peer may write. The peer runs under mpirun, like ph-barcode-mpi. The script measures user +
system CPU seconds of all ranks together, wall seconds, and the peak resident memory of the largest
rank. The bars of ph-barcode-mpi must equal the bars of ph-barcode, byte for byte. Needs numpy and
scipy.
"""
import argparse
import filecmp
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy
from scipy.ndimage import gaussian_filter

# The code shared by all benchmarks.
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from measuring import Limits, Meter  # noqa: E402

# Needed in containers, where the user is root.
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def noise(shape):
    return numpy.random.default_rng(shape[0]).random(shape, dtype=numpy.float32)


def blurred(shape):
    """Noise blurred into features of about eight voxels."""
    return gaussian_filter(noise(shape), 4, mode="wrap").astype(numpy.float32)


def waves(shape):
    """A few waves along each axis without noise: an image with hardly any bars."""
    z, y, x = numpy.meshgrid(*[numpy.linspace(0, 8 * numpy.pi, n, dtype=numpy.float32) for n in shape], indexing="ij",
                             sparse=True)
    return numpy.sin(z) + numpy.sin(1.3 * y) * numpy.cos(z) + numpy.sin(.7 * x) * numpy.cos(.9 * y)


KINDS = {"noise": noise, "blurred noise": blurred, "waves": waves}
SIZES = {"16³": (16,) * 3, "64³": (64,) * 3, "128³": (128,) * 3, "256³": (256,) * 3, "512³": (512,) * 3}


def mebibytes(text):
    number, unit = text.split()
    return float(number) * {"B": 2**-20, "KiB": 2**-10, "MiB": 1, "GiB": 2**10}[unit]


def sent(command):
    """The data that all ranks sent to one another in total, in MiB, as the ranks report them."""
    said = subprocess.run([*command, "--verbose"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True).stderr
    return sum(mebibytes(size) for size in re.findall(r"sent ([\d.]+ \w+)", said))


def print_row(name, run, one, sends=""):
    ratio = f"{run.cpu / one.cpu:.2f}" if run.ok and one.ok else "–"
    wall = f"{run.wall / one.wall:.2f}" if run.ok and one.ok else "–"
    took = f"{run.cpu:.2f} | {run.wall:.2f} | {run.peak:.0f}" if run.ok else f"{run.outcome} | – | –"
    print(f"| {name} | {took} | {ratio} | {wall} | {sends} |", flush=True)


def compare(array, name, programs, options, folder):
    image, bars, one_process = folder / "image.npy", folder / "bars.csv", folder / "one.csv"
    numpy.save(image, array)
    meter = Meter(programs / "bench/bench_run", Limits(seconds=options.seconds), options.repeat)
    common = ["--threads", "1", "--quiet"]
    one = meter.best([programs / "apps/barcode/ph-barcode", image, "-o", one_process, *common])
    print_row(f"{name}, one process", one, one)
    for ranks in options.ranks:
        run = ["mpirun", "--oversubscribe", "-n", str(ranks)]
        ours = [*run, str(programs / "apps/barcode/ph-barcode-mpi"), str(image), "-o", str(bars)]
        took = meter.best([*ours, *common])
        if took.ok and not filecmp.cmp(bars, one_process, shallow=False):
            raise SystemExit(f"{name}: found other bars on {ranks} ranks than in one process")
        words = f"{ranks} rank" if ranks == 1 else f"{ranks} ranks"
        print_row(f"{name}, {words}", took, one, f"{sent([*ours, '--threads', '1']):.0f}")
        for peer in options.peer:
            title, command = peer.split(" = ", 1)
            arguments = [word.format(input=image, output=folder / "peer") for word in command.split()]
            print_row(f"{name}, {title}, {words}", meter.best([*run, *arguments]), one)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--rows", default="64³", help="sizes, separated by commas: " + ", ".join(SIZES))
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--ranks", default="1,2,4", type=lambda text: [int(n) for n in text.split(",")])
    parser.add_argument("--peer", action="append", default=[], metavar="NAME = COMMAND")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--seconds", type=int, help="of CPU time that a program may take")
    options = parser.parse_args()
    os.environ.update(AS_ROOT)
    print("| input | CPU s | wall s | MB of the largest | CPU / one | wall / one | MiB sent |\n|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for size in options.rows.split(","):
            for kind in options.kinds.split(","):
                compare(KINDS[kind](SIZES[size]), f"{size} {kind}", options.build, options, pathlib.Path(folder))


if __name__ == "__main__":
    main()
