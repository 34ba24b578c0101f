# SPDX-License-Identifier: MIT
"""Tests images that are computed in slabs, on request or because of the memory limit. For any slab
height, the bars stay the same. The memory use stays within the limit plus 32 MiB."""
import array
import gzip
import math
import os
import random
import re
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import program  # noqa: E402
from program import ProgramTest, main  # noqa: E402

EXTENTS = (160, 150, 144)
UNITS = {"KiB": 1 / 1024, "MiB": 1, "GiB": 1024}  # in MiB
BESIDE = 32  # MiB that code, libraries and small allocations may take in addition to the limit


def write_waves(path):
    """Writes a float32 image (13 MiB) with few critical cells: its rows are shifted sections of one
    periodic row, raised in waves."""
    depth, height, width = EXTENTS
    period = 97
    wave = [math.sin(2 * math.pi * i / period) + 0.4 * math.sin(2 * math.pi * 5 * i / period) for i in range(period)]
    repeated = [array.array("f", (wave[(i + k) % period] + 0.7 * math.cos(2 * math.pi * k / period) for i in range(width)))
                for k in range(period)]
    with open(path, "wb") as file:
        for z in range(depth):
            for y in range(height):
                repeated[(z + int(20 * math.sin(y / 9)) + y) % period].tofile(file)


class Slabs(ProgramTest):
    def setUp(self):
        super().setUp()
        write_waves(self.path("waves.raw"))
        self.raw = ("--raw-shape", ",".join(map(str, EXTENTS)), "--raw-type", "float32")

    def bars(self, name, *options):
        """@return the bars as CSV, and the peak memory of the run in MiB."""
        arguments = [program.PROGRAM, name, *self.raw, "--quiet", "-o", "out.csv", *options]
        pid = os.posix_spawn(program.PROGRAM, arguments, os.environ)
        _, status, usage = os.wait4(pid, 0)
        self.assertEqual(os.waitstatus_to_exitcode(status), 0, options)
        with open("out.csv", encoding="ascii") as file:
            return file.read(), usage.ru_maxrss / 1024

    def test_the_same_bars(self):
        os.chdir(self.folder)
        self.addCleanup(os.chdir, "/")
        with open("waves.raw", "rb") as raw, gzip.open("waves.raw.gz", "wb", 1) as packed:
            packed.write(raw.read())
        # With periodic axes, the waves do not match where the ends of an axis meet, which causes
        # more critical cells.
        for least, *image in ((24, "--construction", "vertices"), (24, "--construction", "cells"), (40, "--periodic", "0,2")):
            expected, _ = self.bars("waves.raw", *image)
            self.assertGreater(expected.count("\n"), 100)
            plain, both = ("waves.raw",), ("waves.raw", "waves.raw.gz")
            for names, *options in ((both, "--slab-layers", "1"), (plain, "--slab-layers", "7", "--threads", "1"),
                                    (plain, "--slab-layers", "80"), (both, "--memory-limit", f"{least}MiB"),
                                    (plain, "--memory-limit", f"{least + 8}MiB", "--threads", "2")):
                with self.subTest(image=image, options=options):
                    for name in names:
                        found, peak = self.bars(name, *image, *options)
                        self.assertEqual(found, expected)
                        if options[0] == "--memory-limit":
                            self.assertLess(peak, int(options[1][:-3]) + BESIDE)
        self.assertEqual(self.files(), ["out.csv", "square.txt", "waves.raw", "waves.raw.gz"])

    def test_what_they_take_is_foreseen(self):
        os.chdir(self.folder)
        self.addCleanup(os.chdir, "/")
        for options in (("--memory-limit", "24MiB"), ("--slab-layers", "4"), ()):
            _, peak = self.bars("waves.raw", *options)
            said = self.expect(0, "waves.raw", *self.raw, *options, "--dry-run").stdout
            least, unit = re.search(r"^memory +([\d.]+) (\wiB) to ", said, re.MULTILINE).groups()
            self.assertLess(float(least) * UNITS[unit], peak, said)

    def test_representatives_give_way(self):
        """Representatives need all layers at once. The run suggests leaving out the
        representatives. Without them, it fits into the limit."""
        arguments = ("waves.raw", *self.raw, "--memory-limit", "24MiB", "--output-format", "json")
        message = self.expect(75, *arguments, "--representatives", "cycles").stderr
        changes = re.search("what may fit: (--representatives none[^(]*) ", message)
        self.assertIsNotNone(changes, message)
        self.expect(0, *arguments, *changes[1].split())

    def test_loops_that_do_not_fit(self):
        random.seed(3)
        with open(self.path("noise.raw"), "wb") as file:
            file.write(random.randbytes(200 * 200 * 200))
        message = self.expect(75, "noise.raw", "--raw-shape", "200,200,200", "--memory-limit", "180MiB",
                              "--output-format", "none").stderr
        self.assertIn("bars of dimension 1", message)
        self.assertIn("--memory-limit", message)
        for others in (("--max-dim", "0"), ("--min-dim", "2")):
            self.expect(0, "noise.raw", "--raw-shape", "200,200,200", "--memory-limit", "180MiB", *others,
                        "--output-format", "none")

    def test_no_room_for_temporary_files(self):
        environment = dict(os.environ, TMPDIR=self.path("missing"))
        run = subprocess.run([program.PROGRAM, "waves.raw", *self.raw, "--raw-skip", "0", "--slab-layers", "9", "-o", "out.csv"],
                             cwd=self.folder, env=environment, capture_output=True, text=True)
        self.assertEqual(run.returncode, 74)
        self.assertIn("TMPDIR", run.stderr)

    def test_arguments(self):
        for value in ("0", "-1", "x"):
            self.expect(64, "waves.raw", *self.raw, "--slab-layers", value)
        self.expect(64, "square.txt", "--slab-layers", "3")
        self.expect(64, "square.txt", "--min-dim", "2", "--max-dim", "1")
        run = self.expect(0, "square.txt", "--min-dim", "1")
        self.assertEqual(run.stdout, "dim,birth,death\n1,1.25,1.4142135623730951\n")


if __name__ == "__main__":
    main()
