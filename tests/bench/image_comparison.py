# SPDX-License-Identifier: MIT
"""bench/compare_images.py on a small volume, with peers that are right, peers that are wrong, and
peers that accept only other inputs."""
import gzip
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy  # noqa: F401
except ImportError:
    print("skipped: numpy is not there")
    sys.exit(77)

BUILD = pathlib.Path(sys.argv.pop(1))
BENCH = pathlib.Path(__file__).resolve().parents[2] / "bench"
OURS = BUILD / "apps/barcode/ph-barcode"
ROW = "16³ smooth"


class ImageComparison(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def compare(self, *arguments, code=0, row=ROW):
        run = subprocess.run([sys.executable, "-B", BENCH / "compare_images.py", BUILD, "--json",
                              self.folder / "results.json", "--repeat", "1", "--together", "0.01", "--rows", row,
                              "--construction", "cells", *arguments], capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, code, run.stderr)
        row, = json.loads((self.folder / "results.json").read_text())["rows"]
        return row, run.stdout

    def test_peers(self):
        engine = f"{OURS} {{input}} --quiet --construction cells --engine twist --output-format [pers|none]"
        row, table = self.compare("--threads", "1,2", "--peer", f"right 1.0 = construction=cells {engine}",
                                  "--peer", f"flat 1.0 = construction=cells axes=2 {engine}",
                                  "--peer", f"other 1.0 = construction=vertices {engine}")
        self.assertEqual([(e["program"], e["threads"], e["outcome"]) for e in row["results"]],
                         [("libph", 1, "ok"), ("libph", 2, "ok"), ("right 1.0", 1, "ok")])
        self.assertEqual(row["bars"], {"right 1.0": "equal"})
        self.assertIn(f"| {ROW}, cells | ", table)

    def test_a_difference_is_told(self):
        peer = f"wrong 1.0 = construction=cells {OURS} {{input}} --quiet --output-format [pers|none]"
        row, _ = self.compare("--peer", peer, code=1)
        self.assertIn("bars of ours", row["bars"]["wrong 1.0"])

    def test_scans(self):
        header = b"#INRIMAGE-4#{\nXDIM=4\nYDIM=3\nZDIM=2\nVDIM=1\nTYPE=float\nPIXSIZE=32 bits\n"
        volume = [float(x % 5) for x in range(24)]
        (self.folder / "skull_2.9.inr").write_bytes(header.ljust(256, b"\n") + struct.pack("<24f", *volume))
        nifti = bytearray(352)
        struct.pack_into("<8h", nifti, 40, 3, 4, 3, 2, 1, 1, 1, 1)
        struct.pack_into("<h", nifti, 70, 2)
        struct.pack_into("<f", nifti, 108, 352)
        (self.folder / "ch2.nii.gz").write_bytes(gzip.compress(bytes(nifti) + bytes(map(int, volume))))
        for name in ("CT skull", "MRI head"):
            made = self.folder / name
            (self.folder / "results.json").unlink(missing_ok=True)
            self.compare("--scans", self.folder, "--made", made, row=name)
            read = numpy.load(next(made.iterdir()))
            self.assertEqual((read.shape, read.ravel().tolist()), ((2, 3, 4), volume))

    def test_arguments(self):
        for arguments in (("--peer", "nobody = prog {input}"), ("--peer", "nobody = construction=cells prog"),
                          ("--rows", "none")):
            run = subprocess.run([sys.executable, "-B", BENCH / "compare_images.py", BUILD, *arguments],
                                 capture_output=True, text=True, timeout=60)
            self.assertNotEqual(run.returncode, 0)
            self.assertRegex(run.stderr, "expected NAME|no such row")


if __name__ == "__main__":
    unittest.main(verbosity=2)
