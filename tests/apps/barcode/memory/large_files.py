# SPDX-License-Identifier: MIT
"""Tests large inputs. Most of them are memory-mapped, and larger than the memory limit plus all
allowed additional memory. The program keeps to the limit, whatever part of it reads the input. A
run that needs more memory fails soon."""
import gzip
import os
import shutil
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../support"))
from program import files, main  # noqa: E402
from under_limit import BESIDE, UnderLimit  # noqa: E402

SECONDS = 60  # CPU seconds; every run must end within this time
SECONDS_TO_REFUSE = 6  # CPU seconds; a refusal takes one or two
MIDDLE = struct.pack("<4d", 1, 2, 1, 3)


def write_zeros(path, descr, shape, middle):
    """Writes an array of zeros with some other bytes in the middle. The zeros are holes in the
    file."""
    size = int(descr[-1])
    for n in shape:
        size *= n
    with open(path, "wb") as file:
        file.write(files.npy(descr, shape, b""))
        start = file.tell()
        file.seek(start + size // 2)
        file.write(middle)
        file.truncate(start + size)


def write_inputs(folder):
    path = lambda name: os.path.join(folder, name)
    write_zeros(path("bytes.npy"), "|u1", (360, 360, 360), b"\x03" * 10)  # 44 MiB
    write_zeros(path("long.npy"), "<f4", (300, 200, 200), MIDDLE)  # 46
    write_zeros(path("picture.npy"), "<f4", (4400, 4400), MIDDLE)  # 74
    write_zeros(path("floats.npy"), "<f8", (190, 190, 190), MIDDLE)  # 52
    write_zeros(path("shown.npy"), "<f8", (9, 1000, 1000), MIDDLE)  # 69
    with open(path("bars.txt"), "w") as file:  # a stored barcode with 60 MiB of comments
        file.write("dim,birth,death\n0,0,inf\n")
        for _ in range(60):
            file.write(("#" + 1022 * "-" + "\n") * 1024)
    with open(path("bytes.npy"), "rb") as file, gzip.open(path("bytes.npy.gz"), "wb", 1) as packed:
        shutil.copyfileobj(file, packed, 1 << 16)


class LargeFiles(UnderLimit):
    write_inputs = staticmethod(write_inputs)
    # file, limits in MiB, options
    ROWS = (("bytes.npy", (8,), ("--max-dim", "0", "--report", "o.html")),
            ("bytes.npy", (8,), ("--max-dim", "0", "--report", "o.html", "--plot", "o.svg",
                                 "--plot-kind", "diagram", "--superlevel")),
            ("bytes.npy", (8,), ("--max-dim", "0", "--construction", "cells", "--periodic", "0",
                                 "--report", "o.html")),
            ("bytes.npy.gz", (8,), ("--max-dim", "0", "--report", "o.html")),
            ("long.npy", (8,), ("--max-dim", "0", "--report", "o.html")),
            ("picture.npy", (8,), ("--report", "o.html")),
            ("picture.npy", (8,), ("--report", "o.html", "--plot", "o.svg", "--plot-kind", "tree")),
            ("floats.npy", (1, 10), ("--report", "o.html")),
            ("floats.npy", (10,), ("--report", "o.html", "--superlevel")),
            ("floats.npy", (8,), ("--engine", "cohomology", "--report", "o.html")),
            ("floats.npy", (8,), ("--representatives", "voxels", "--output-format", "json",
                                  "--report", "o.html")),
            ("bars.txt", (8, 80), ("--report", "o.html")),
            ("shown.npy", (1, 24), ("--max-dim", "0", "--report", "o.html")),
            ("shown.npy", (1, 24), ("--max-dim", "0", "--superlevel", "--report", "o.html")))

    def test_the_limit_holds(self):
        self.require_page()
        ends = set()
        for name, limits, options in self.ROWS:
            for limit in limits:
                with self.subTest(name=name, limit=limit, options=options):
                    code, peak, seconds, message = self.run_within(limit, SECONDS, (name, *options))
                    ends.add((name, code))
                    # For images with so many voxels, a merge tree is refused.
                    self.assertIn(code, (64, 75) if "tree" in options else (0, 75), message)
                    self.assertLessEqual(peak, limit + BESIDE, f"exit code {code}")
                    if code != 0:
                        self.assertLess(seconds, SECONDS_TO_REFUSE)
                        self.assertEqual(message.count("\n"), 1, message)
                    self.forget("out", "o.html", "o.svg")
        # Some of the runs must succeed and some must fail; otherwise, the test would show nothing
        # about one outcome.
        self.assertLessEqual({("long.npy", 0), ("picture.npy", 0), ("floats.npy", 0),
                              ("bytes.npy", 75), ("floats.npy", 75), ("shown.npy", 75)}, ends)


if __name__ == "__main__":
    main()
