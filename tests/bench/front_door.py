# SPDX-License-Identifier: MIT
"""Tests bench/front_door.py: its verdicts on known figures, and on small inputs the ways to call
this build's libraries, which are named doors."""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy  # noqa: F401
except ModuleNotFoundError:
    print("SKIPPED: no NumPy")
    sys.exit(77)

BUILD = pathlib.Path(sys.argv.pop(1))
BENCH = pathlib.Path(__file__).resolve().parents[2] / "bench"
sys.path.insert(0, str(BENCH))
import front_door  # noqa: E402
from front_door import Cost, Result  # noqa: E402

# The largest allowed ratios of CPU time and memory, for inputs of a fifth of the size. On a quiet
# machine, all ratios are 1 or below; the margin is for a busy machine.
CPU_BOUND, MEMORY_BOUND = 2, 1.5
SCALE = 0.2

BARS = {0: (3, 2.5), 1: (1, 0.125)}


def result(cpu=0.1, peak=10.0, outcome="ok", bars=BARS):
    return Result("a row", "C", Cost(cpu, peak, outcome), Cost(0.1, 10.0), bars, BARS)


class Judgement(unittest.TestCase):
    def said(self, *results, bounds=(1.2, 1.5)):
        return list(front_door.faults(results, bounds))

    def test_equal_doors_pass(self):
        self.assertEqual(self.said(result(), result(0.05, 5.0)), [])

    def test_small_differences_are_noise(self):
        small = Result("a row", "C", Cost(0.021, 11.9), Cost(0.002, 4.0), BARS, BARS)
        self.assertEqual(self.said(small), [])
        self.assertEqual(front_door.ratio(0.021, 0.002, front_door.CPU_FLOOR), "≈ 1")
        self.assertEqual(front_door.ratio(0.040, 0.002, front_door.CPU_FLOOR), "20")

    def test_a_row_beyond_a_bound_is_named(self):
        said, = self.said(result(cpu=0.13))
        self.assertEqual(said, "a row: C: 1.3 times the CPU time (0.130 s, ph-barcode 0.100 s), allowed 1.2")
        said, = self.said(result(peak=20.0))
        self.assertEqual(said, "a row: C: 2 times the memory (20 MB, ph-barcode 10 MB), allowed 1.5")
        said, = self.said(result(cpu=1, peak=100))
        self.assertIn("CPU time", said)
        self.assertIn("memory", said)

    def test_other_bars_are_a_fault_without_bounds(self):
        for bars, words in (({0: (2, 2.5), 1: (1, 0.125)}, "H0: 2 bars, ph-barcode 3"),
                            ({0: (3, 2.5)}, "H1: 0 bars, ph-barcode 1"),
                            ({0: (3, 2.5), 1: (1, 0.12501)}, "H1: the bars are 0.12501 long together"),
                            (None, "no bars were printed")):
            said, = self.said(result(bars=bars), bounds=None)
            self.assertTrue(said.startswith(f"a row: C: {words}"), said)
        self.assertEqual(self.said(result(bars={0: (3, math.nextafter(2.5, 3)), 1: (1, 0.125)})), [])

    def test_a_door_that_fails_is_a_fault_without_bounds(self):
        self.assertEqual(self.said(result(outcome="memory", bars=None), bounds=None),
                         ["a row: C: it did not end well: memory"])

    def test_noise_grows_with_the_start(self):
        cost = Cost(0.045, 10.0), Cost(0.005, 10.0)
        self.assertEqual(self.said(Result("a row", "Python", *cost, BARS, BARS, 0.12)), [])
        said, = self.said(Result("a row", "Python", *cost, BARS, BARS, 0.04))
        self.assertIn("9 times the CPU time", said)

    def test_only_what_is_beyond_a_bound_each_time_counts(self):
        good, bad, failed = result(), result(cpu=9.0), result(bars=None)
        for measured, last, left in (([good, bad], good, [bad]), ([bad, good, bad], good, [bad]),
                                     ([bad, bad, bad, good], bad, [good]),
                                     ([failed, good], failed, [good])):
            rest = iter(measured)
            found = front_door.confirmed(lambda: [next(rest)], (2, 1.5))
            self.assertEqual((found, list(rest)), ([last], left))

    def test_summaries(self):
        self.assertEqual(front_door.summary_of_csv("dim,birth,death\n0,0,1\n0,0,inf\n1,1,1.25\n", 1),
                         {0: (2, 1.0), 1: (1, 0.25)})
        self.assertEqual(front_door.summary("0 2 1\n1 1 0.25\n"), {0: (2, 1.0), 1: (1, 0.25)})


class Doors(unittest.TestCase):
    def run_script(self, *arguments, code=0):
        run = subprocess.run([sys.executable, "-B", BENCH / "front_door.py", BUILD, *arguments], capture_output=True,
                             text=True, timeout=280)
        self.assertEqual(run.returncode, code, run.stderr + run.stdout)
        return run

    def test_no_door_costs_much_more_than_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "figures.csv")
            run = self.run_script("--scale", str(SCALE), "--together", "0.02", "--csv", path, "--check",
                                  str(CPU_BOUND), str(MEMORY_BOUND))
            with open(path, newline="", encoding="utf-8") as file:
                figures = list(csv.DictReader(file))
        names = [row.name for row in front_door.rows_of(SCALE)]
        for name in names:
            self.assertIn(f"| {name} | ", run.stdout)
        self.assertEqual(list(dict.fromkeys(f["input"] for f in figures)), names)
        self.assertLessEqual({"C++", "C++ moved"}, {f["door"] for f in figures})
        self.assertEqual({f["outcome"] for f in figures}, {"ok"})
        self.assertGreater(min(float(f["program_peak_mb"]) for f in figures), 1)

    def test_arguments(self):
        self.assertIn("no row has 'nothing' in its name", self.run_script("--rows", "nothing", code=1).stderr)
        self.assertIn("expected CPU and MEMORY", self.run_script("--check", "2", code=2).stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
