# SPDX-License-Identifier: MIT
"""bench/compare_rips.py on a tiny input, with peers that are right, that are wrong, that never end,
or that use too much memory."""
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop(1))
BENCH = pathlib.Path(__file__).resolve().parents[2] / "bench"
sys.path.insert(0, str(BENCH))
import agreement  # noqa: E402
import rips_rows  # noqa: E402
import rips_table  # noqa: E402

ROW = "h2:tiny_12"
PEER = {
    "right": "print(open({bars!r}).read())",
    "wrong": "print('persistence intervals in dim 0:')",
    "endless": "while True: pass",
    "greedy": "hoard = [0] * (1 << 30)",
}


class RipsComparison(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.json = self.folder / "results.json"

    def peer(self, name):
        path = self.folder / f"{name}.py"
        path.write_text(PEER[name].format(bars=str(self.folder / "bars.txt")))
        return f"{name} 1.0 = {sys.executable} -S {path} {{options}}"

    def compare(self, *arguments, code=0):
        run = subprocess.run([sys.executable, "-B", BENCH / "compare_rips.py", BUILD, "--json", self.json,
                              "--repeat", "1", "--together", "0.01", *arguments],
                             capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, code, run.stderr)
        return run

    def results(self):
        row, = json.loads(self.json.read_text())["rows"]
        return row, {(e["program"], e["threads"]): e for e in row["results"]}

    def test_without_peers(self):
        run = self.compare("--rows", ROW, "--threads", "1,2")
        row, results = self.results()
        self.assertEqual({key: e["outcome"] for key, e in results.items()}, {("libph", 1): "ok", ("libph", 2): "ok"})
        self.assertGreater(row["limit"]["cpu"], 0)
        self.assertGreater(results["libph", 1]["peak_mb"], 0)
        self.assertIn(f"| {ROW} | ", run.stdout)

    def test_peers_and_limits(self):
        path = rips_rows.input_file(next(r for r in rips_rows.ROWS if r.name == ROW), self.folder, self.folder)
        ours = subprocess.run([BUILD / "apps/barcode/ph-barcode", path, "--quiet", "--max-dim", "2",
                               "--output-format", "ripser"], capture_output=True, text=True, check=True).stdout
        (self.folder / "bars.txt").write_text(ours)
        self.compare("--rows", ROW, "--peer", self.peer("right"), "--peer", self.peer("endless"), "--time-limit", "1")
        # This is a separate test, because sanitizers reserve more memory than the limit.
        self.compare("--rows", ROW, "--peer", self.peer("greedy"), "--only", "greedy", "--memory-limit", "1GiB",
                     "--no-check")
        row, results = self.results()
        self.assertEqual({name: e["outcome"] for (name, _), e in results.items()},
                         {"libph": "ok", "right 1.0": "ok", "endless 1.0": "time", "greedy 1.0": "memory"})
        self.assertEqual(row["bars"], {"right 1.0": "equal"})

    def test_a_difference_is_told_and_results_are_kept(self):
        self.compare("--rows", ROW, "--only", "libph", "--no-check")
        run = self.compare("--rows", ROW, "--peer", self.peer("wrong"), "--only", "wrong", code=1)
        self.assertIn("H0: only ours [0, ", run.stderr)
        _, results = self.results()
        self.assertEqual(set(results), {("libph", 1), ("wrong 1.0", 1)})

    def test_choices_by_hand_are_ours(self):
        run = self.compare("--rows", ROW, "--choice=--engine standard", "--choice=--engine union-find")
        row, results = self.results()
        self.assertEqual([(name, e["outcome"]) for (name, _), e in results.items()],
                         [("libph", "ok"), ("libph --engine standard", "ok"), ("libph --engine union-find", "exit 64")])
        self.assertEqual(row["bars"], {"libph --engine standard": "equal"})
        self.assertIn("| libph / best choice |", run.stdout)

    def test_an_unknown_row_is_named(self):
        self.assertIn("no such row: h9:nothing", self.compare("--rows", "h9:nothing", code=1).stderr)

    def test_agreement_allows_rounding_only(self):
        ours = {0: [(0.0, 1.0), (0.0, math.inf)], 1: [(2.0, 3.0)]}
        self.assertIsNone(agreement.difference(ours, {0: [(0.0, 0.999999), (0.0, math.inf)],
                                                      1: [(1.999998, 2.000001), (2.0, 3.00001)]}))
        for theirs in ({0: ours[0]}, {0: ours[0], 1: [(2.0, 3.001)]}, {0: ours[0], 1: [(2.0, math.inf)]},
                       {0: ours[0], 1: [(2.0, 3.0), (2.0, 3.0)]}):
            self.assertRegex(agreement.difference(ours, theirs), "^H1: only")

    def test_samples_are_the_same_everywhere(self):
        made = {}
        for name in ("cube_600", "s2_600", "tiny_12"):
            path = rips_rows.input_file(rips_rows.Row(name, 1), self.folder, self.folder)
            made[name] = path.read_bytes()
        self.assertTrue(made["cube_600"].startswith(b"0.134364244 0.847433737 0.763774619\n"))
        self.assertEqual(made["s2_600"].count(b"\n"), 600)
        self.assertEqual(len(made["tiny_12"]), 4 * 66)

    def test_figures_have_three_digits(self):
        self.assertEqual([rips_table.number(x) for x in (0.00123, 0.0123, 1.234, 12.34, 123.4)],
                         ["0.0012", "0.012", "1.23", "12.3", "123"])


class RipsLimit(unittest.TestCase):
    def run_limit(self, kind, content, code=0):
        with tempfile.NamedTemporaryFile() as file:
            file.write(content)
            file.flush()
            run = subprocess.run([BUILD / "bench/bench_rips_limit", kind, file.name], capture_output=True, text=True)
        self.assertEqual(run.returncode, code, run.stderr)
        return run.stdout

    def test_edges_up_to_the_enclosing_radius(self):
        # Four points in a row with steps of 1: the enclosing radius is 2, and therefore no edge
        # joins the two ends.
        points = self.run_limit("points", b"0,0\n1,0\n\n2 0\n3 0")
        self.assertTrue(points.startswith("4 points, 5 edges, sorted"), points)
        lower = struct.pack("<6f", 1, 2, 1, 3, 2, 1)
        self.assertTrue(self.run_limit("binary", lower).startswith("4 points, 5 edges, sorted"))

    def test_no_points_are_an_error(self):
        self.run_limit("points", b"", code=65)


if __name__ == "__main__":
    unittest.main(verbosity=2)
