# SPDX-License-Identifier: MIT
"""Tests that many points in special position give correct bars in near-linear time."""
import collections
import json
import os
import random
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, main  # noqa: E402

MANY = 300000
SECONDS = 20  # computing all pairs of 10^5 points or more would take minutes


class Degenerate(ProgramTest):
    def write_points(self, points):
        with open(self.path("points.txt"), "w") as file:
            file.writelines(" ".join(map(repr, p)) + "\n" for p in points)

    def counts(self, points, *options):
        """@return for each bar, how often it occurs."""
        self.write_points(points)
        return self.counts_again(*options)

    def counts_again(self, *options):
        """@return the counts for the points that were written last."""
        start = time.monotonic()
        run = self.expect(0, "points.txt", "--quiet", *options)
        self.assertLess(time.monotonic() - start, SECONDS)
        bars = run.stdout.splitlines()[1:]
        return dict(collections.Counter(bars))

    def test_all_equal(self):
        self.assertEqual(self.counts([(1.5, -2.0, 7.0)] * MANY), {"0,0,inf": 1})
        self.assertEqual(self.counts_again("--max-dim", "0", "--min-persistence", "-1"),
                         {"0,0,0": MANY - 1, "0,0,inf": 1})
        self.assertEqual(self.counts([(1.5,)] * 1000, "--min-persistence", "-1", "--max-dim", "0"),
                         {"0,0,0": 999, "0,0,inf": 1})

    def test_components_of_many_points(self):
        random.seed(1)
        self.write_points((random.random(), random.random(), random.random()) for _ in range(MANY))
        for threads in ("1", "3"):
            bars = self.counts_again("--max-dim", "0", "--threads", threads)
            self.assertEqual(sum(bars.values()), MANY)
            self.assertEqual(bars["0,0,inf"], 1)
            lengths = sorted(float(bar.split(",")[2]) for bar in bars)[:-1]
            self.assertLess(lengths[-1], 0.05)
        # The 4.5 * 10^10 pairs would not fit into the memory limit.
        self.expect(0, "points.txt", "--quiet", "--max-dim", "0", "--threshold", "0.01",
                    "--memory-limit", "256MiB", "-o", "bars.json")
        self.assertLess(json.loads(self.read("bars.json"))["peak_memory"], 288 * 2 ** 20)

    def test_components_in_bad_position(self):
        n = 200000
        line = [(0.5 * i, 0.25 * i, -0.5 * i) for i in range(n)]
        self.assertEqual(self.counts(line, "--max-dim", "0"),
                         {"0,0,0.75": n - 1, "0,0,inf": 1})
        # The points form nested pairs of clusters. The distance between the two clusters of a pair
        # is large compared to their sizes.
        halves = [(sum(4.0 ** k for k in range(17) if i >> k & 1),) for i in range(2 ** 17)]
        bars = self.counts(halves, "--max-dim", "0")
        self.assertEqual(sum(bars.values()), 2 ** 17)
        self.assertEqual(bars["0,0,1"], 2 ** 16)
        grid = [(float(i), float(j), float(k)) for i in range(50) for j in range(50)
                for k in range(50)]
        random.shuffle(grid)
        self.assertEqual(self.counts(grid, "--max-dim", "0", "--metric", "manhattan"),
                         {"0,0,1": 50 ** 3 - 1, "0,0,inf": 1})

    def test_copies(self):
        corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
        random.seed(1)
        points = random.choices(corners, k=MANY)
        self.assertEqual(self.counts(points),
                         {"0,0,1": 3, "0,0,inf": 1, "1,1,1.4142135623730951": 1})
        self.assertEqual(self.counts(points, "--threshold", "1.2", "--metric", "chebyshev"),
                         {"0,0,1": 3, "0,0,inf": 1})

    def test_collinear(self):
        points = [(0.5 * i, 0.25 * i, -0.5 * i) for i in range(200000)]
        self.assertEqual(self.counts(points, "--threshold", "1"),
                         {"0,0,0.75": 199999, "0,0,inf": 1})

    def test_grid(self):
        side = 200  # each square is a class of H1 until its diagonals kill it
        points = [(float(i), float(j)) for i in range(side) for j in range(side)]
        self.assertEqual(self.counts(points, "--threshold", "1.5"),
                         {"0,0,1": side * side - 1, "0,0,inf": 1,
                          "1,1,1.4142135623730951": (side - 1) ** 2})

    def test_spreads(self):
        for unit in (2.0 ** -1000, 2.0 ** 1000, 5e-324):  # i * unit is exact
            with self.subTest(unit=unit):
                points = [(unit * i, 0.0) for i in range(100000)]
                self.assertEqual(self.counts(points, "--threshold", repr(unit)),
                                 {f"0,0,{unit!r}": 99999, "0,0,inf": 1})
        ends = [(1e300 * (i % 2), 1e-300 * i) for i in range(1000)]
        self.assertEqual(sum(self.counts(ends, "--max-dim", "0").values()), 1000)


if __name__ == "__main__":
    main()
