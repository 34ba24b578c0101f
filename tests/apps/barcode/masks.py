# SPDX-License-Identifier: MIT
"""Voxels left out by a mask never enter: tests random images with a mask in each format that
supports masks.

The script writes files; oracle.py computes the expected barcodes from the numbers and reads no
files. To test more images than the suite does: masks.py PROGRAM --images 20000
"""
import gzip
import itertools
import math
import os
import random
import sys
import zipfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import oracle  # noqa: E402
from program import ProgramTest, files, main  # noqa: E402

IMAGES = 600
BATCH = 25  # number of images in one command


def in_c_order(shape):
    return itertools.product(*map(range, shape))


def first_axis_fastest(shape):
    return (at[::-1] for at in itertools.product(*map(range, shape[::-1])))


def numbers_of(voxels, places, scale=1.0):
    return [math.nan if voxels[at] is None else voxels[at] / scale for at in places]


def npy(descr, fortran=False):
    def write(shape, voxels):
        places = first_axis_fastest(shape) if fortran else in_c_order(shape)
        return files.array(shape, numbers_of(voxels, places), descr, fortran)
    return write


def npz(shape, voxels):
    return files.npz({"scan.npy": npy("<f8")(shape, voxels)}, zipfile.ZIP_DEFLATED)


def nifti(descr, slope=0.0):
    """A NIfTI writer. With a slope, the stored numbers are halved, and the reader doubles them."""
    def write(shape, voxels):
        numbers = numbers_of(voxels, first_axis_fastest(shape), slope or 1.0)
        return files.nifti(descr, shape, numbers, slope)
    return write


def dipha(shape, voxels):
    return files.dipha_image(shape, numbers_of(voxels, first_axis_fastest(shape)))


def perseus_grid(mark):
    def write(shape, voxels):
        numbers = [mark if voxels[at] is None else f"{voxels[at]:g}" for at in first_axis_fastest(shape)]
        return "\n".join(map(str, [len(shape), *shape, *numbers])).encode()
    return write


def perseus_cubes(shape, voxels):
    lines = [str(len(shape))]
    lines += [" ".join(map(str, at)) + f" {voxels[at]:g}" for at in in_c_order(shape) if voxels[at] is not None]
    return "\n".join(lines).encode()


def zipped(write):
    return lambda shape, voxels: gzip.compress(write(shape, voxels))


NAN = ("--nan", "drop")
# name: extension, writer, options, the values that the format can hold
FORMATS = {
    "npy f8": (".npy", npy(">f8"), NAN, "any"),
    "npy f4": (".npy", npy("<f4"), NAN, "any"),
    "npy f4 fortran": (".npy", npy(">f4", True), NAN, "any"),
    "npy f2": (".npy", npy("<f2"), NAN, "any"),
    "npy gz": (".npy.gz", zipped(npy("<f8")), NAN, "any"),
    "npz": (".npz", npz, NAN, "any"),
    "nifti f4": (".nii", nifti("<f4"), NAN, "any"),
    "nifti f8 scaled": (".nii", nifti("<f8", 0.5), NAN, "any"),
    "nifti gz": (".nii.gz", zipped(nifti("<f8")), NAN, "any"),
    "dipha": (".dipha", dipha, NAN, "any"),
    "perseus inf": (".perseus", perseus_grid("inf"), (), "finite"),
    "perseus -1": (".perseus", perseus_grid("-1"), (), "positive"),
    "perseus cubes": (".perseus", perseus_cubes, (), "listed"),
}


class Masks(ProgramTest):
    def shape(self, choose, axes):
        return [choose.randint(1, (0, 9, 4, 3)[axes]) for _ in range(axes)]

    def voxels(self, choose, shape, values):
        """Random values. Some voxels are absent; in formats that allow infinite values, some values
        are infinite."""
        share = choose.choice((0.1, 0.3, 0.6))
        finite = [1.0, 2.0, 3.0, 5.0] if values in ("positive", "listed") else [-1.5, 0.0, 0.25, 1.0, 2.0]
        voxels = {}
        for at in in_c_order(shape):
            value = choose.choice(finite)
            if values == "any" and choose.random() < 0.1:
                value = choose.choice((math.inf, -math.inf))
            voxels[at] = None if choose.random() < share else value
        if values == "listed":  # the listed cubes determine the extent of the grid
            voxels[tuple(n - 1 for n in shape)] = 4.0
        return voxels

    def read_bars(self, path):
        with open(path, encoding="ascii") as file:
            lines = file.read().splitlines()
        self.assertEqual(lines[0], "dim,birth,death")
        return sorted((int(d), float(b), float(e)) for d, b, e in (line.split(",") for line in lines[1:]))

    def check_batch(self, choose, number):
        name = choose.choice(sorted(FORMATS))
        extension, write, options, values = FORMATS[name]
        axes = choose.randint(1, 3)
        how = {"cells": choose.random() < 0.5, "superlevel": choose.random() < 0.5,
               "periodic": [k for k in range(axes) if choose.random() < 0.3]}
        options = [*options, "--complex", "cubical", "--construction", "cells" if how["cells"] else "vertices"]
        options += ["--superlevel"] if how["superlevel"] else []
        options += ["--periodic", ",".join(map(str, how["periodic"]))] if how["periodic"] else []
        options += ["--slab-layers", str(choose.randint(1, 3))] if choose.random() < 0.4 else []
        options += ["--check"] if choose.random() < 0.4 else []
        folder, expected = f"batch{number}", {}
        os.mkdir(self.path(folder))
        for i in range(BATCH):
            shape = self.shape(choose, axes)
            if extension.startswith(".nii"):
                shape[-1] += 1  # NIfTI ignores a last axis of one voxel
            voxels = self.voxels(choose, shape, values)
            self.write(f"{folder}/{i:02}{extension}", write(shape, voxels))
            expected[f"{i:02}"] = oracle.barcode(oracle.cubical_filtration(shape, voxels, **how))
        inputs = sorted(os.path.join(folder, f) for f in os.listdir(self.path(folder)))
        run = self.run_program(*inputs, *options, "--quiet", "--allow-empty", "-o", f"{folder}-bars/")
        context = f"{name} {' '.join(options)} in {self.folder}/{folder}\n{run.stderr}"
        self.assertEqual(run.returncode, 0, context)
        written = sorted(os.listdir(self.path(f"{folder}-bars")))
        self.assertEqual(len(written), BATCH)
        for file, (stem, bars) in zip(written, sorted(expected.items())):
            self.assertTrue(file.startswith(stem))
            self.assertEqual(self.read_bars(self.path(f"{folder}-bars/{file}")), bars, f"{stem}: {context}")

    def test_random_images(self):
        choose = random.Random(27)
        for number in range(IMAGES // BATCH):
            self.check_batch(choose, number)

    def test_points_in_voxels(self):
        """Voxels without points are absent, both in sublevel and in superlevel sets."""
        choose = random.Random(5)
        for number in range(12):
            shape = [choose.randint(2, 4), choose.randint(2, 4)]
            counts = {at: choose.choice((0, 0, 1, 2, 3)) for at in in_c_order(shape)}
            counts[0, 0] = counts[tuple(n - 1 for n in shape)] = 1
            # The grid extends from a point in the first voxel to a point in the last voxel, plus a
            # margin of one voxel.
            points = [[x + (0.0 if at == (0, 0) else 0.5) for x in at] for at in counts for _ in range(counts[at])]
            self.write("points.csv", "".join(f"{x},{y}\n" for x, y in points))
            voxels = {at: None for at in in_c_order([n + 2 for n in shape])}
            for kind in ("occupancy", "density"):
                for (x, y), count in counts.items():
                    if count:
                        voxels[x + 1, y + 1] = 0.0 if kind == "occupancy" else -float(count)
                for cells, superlevel in itertools.product((False, True), repeat=2):
                    options = ["--construction", "cells" if cells else "vertices"] + ["--superlevel"] * superlevel
                    self.expect(0, "points.csv", "--complex", "cubical", "--voxel", "1", "--voxel-value", kind,
                                "--quiet", "--check", *options, "-o", "bars.csv")
                    self.assertEqual(self.read_bars(self.path("bars.csv")),
                                     oracle.barcode(oracle.cubical_filtration(
                                         [n + 2 for n in shape], voxels, cells, superlevel)))

    def test_without_the_option_nan_is_refused(self):
        self.write("n.npy", npy("<f8")([4], {(0,): 1.0, (1,): None, (2,): 2.0, (3,): 0.5}))
        self.assertIn("value at [1], found NaN", self.expect(65, "n.npy").stderr)
        run = self.expect(0, "n.npy", "--nan", "drop", "--superlevel")
        self.assertEqual(run.stdout, "dim,birth,death\n0,-2,inf\n0,-1,inf\n")
        self.assertIn("1 voxel is NaN: masked", run.stderr)


if __name__ == "__main__":
    if "--images" in sys.argv:
        at = sys.argv.index("--images")
        IMAGES = int(sys.argv[at + 1])
        del sys.argv[at:at + 2]
    main()
