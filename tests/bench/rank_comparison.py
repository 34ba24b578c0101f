# SPDX-License-Identifier: MIT
"""bench/parts/compare_ranks.py on a small volume, with another program as a peer."""
import pathlib
import shutil
import subprocess
import sys
import unittest

BUILD = pathlib.Path(sys.argv.pop(1))
BENCH = pathlib.Path(__file__).resolve().parents[2] / "bench/parts/compare_ranks.py"

try:
    import numpy  # noqa: F401
    import scipy  # noqa: F401
except ImportError:
    print("skipped: numpy or scipy is not there")
    sys.exit(77)
if not (BUILD / "apps/barcode/ph-barcode-mpi").exists() or not shutil.which("mpirun"):
    print("skipped: there is no MPI")
    sys.exit(77)


class RankComparison(unittest.TestCase):
    def test_a_row_for_each_number_of_ranks(self):
        run = subprocess.run([sys.executable, "-B", BENCH, BUILD, "--rows", "16³", "--kinds", "noise,waves",
                              "--ranks", "1,2", "--repeat", "1", "--peer", "copy = cp {input} {output}",
                              "--peer", "failing = cp none {output}"],
                             capture_output=True, text=True, timeout=200, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in run.stdout.splitlines()[2:]]
        self.assertEqual([row[0] for row in rows[:7]],
                         ["16³ noise, one process", "16³ noise, 1 rank", "16³ noise, copy, 1 rank",
                          "16³ noise, failing, 1 rank", "16³ noise, 2 ranks", "16³ noise, copy, 2 ranks",
                          "16³ noise, failing, 2 ranks"])
        self.assertEqual(len(rows), 14)
        for row in rows:
            if "failing" in row[0]:
                self.assertEqual(row[1:4], ["exit 1", "–", "–"])
            else:
                self.assertGreater(float(row[3]), 1, row)


if __name__ == "__main__":
    unittest.main()
