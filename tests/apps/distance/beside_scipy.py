# SPDX-License-Identifier: MIT
"""Compares ph-distance with the assignments that SciPy computes for cost matrices, in which each
bar also has a place on the diagonal. Skipped without SciPy."""
import math
import os
import sys

try:
    import numpy
    from scipy.optimize import linear_sum_assignment
except ImportError:
    print("skipped: SciPy is missing")
    sys.exit(77)

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, main  # noqa: E402
from diagrams import INF, costs_of, csv_of, of_dim, random_bars, rows_of  # noqa: E402

KINDS = [((), INF, INF), (("--distance", "wasserstein"), 1, INF),
         (("--distance", "wasserstein", "--ground", "2"), 1, 2),
         (("--distance", "wasserstein", "--order", "2", "--ground", "2"), 2, 2),
         (("--distance", "wasserstein", "--order", "4", "--ground", "1"), 4, 1)]
SIZES = [(0, 9), (1, 1), (60, 45), (120, 120)]


def distance(a, b, order, ground):
    costs = numpy.array(costs_of(a, b, ground))
    if order < INF:
        return (costs[linear_sum_assignment(costs**order)]**order).sum()**(1 / order)
    low, high = 0, len(values := numpy.unique(costs)) - 1
    while low < high:  # finds the least value at which all bars can be paired
        middle = (low + high) // 2
        refused = costs > values[middle]
        if refused[linear_sum_assignment(refused)].any():
            low = middle + 1
        else:
            high = middle
    return values[low]


class BesideScipy(ProgramTest):
    def test_distances(self):
        for sizes in SIZES:
            for grid in (None, 8):
                diagrams = [random_bars(seed, {1: (size, 0)}, grid) for seed, size in enumerate(sizes, sizes[1])]
                for name, bars in zip(("a.csv", "b.csv"), diagrams):
                    self.write(name, csv_of(bars))
                for options, order, ground in KINDS:
                    expected = distance(*(of_dim(bars, 1) for bars in diagrams), order, ground)
                    for error in ("0", "0.01", "0.3"):
                        run = self.expect(0, "a.csv", "b.csv", *options, "--error", error, "--quiet",
                                          "--output-format", "csv")
                        row, = rows_of(run.stdout)
                        value, lower = float(row["value"]), float(row["lower"])
                        self.assertTrue(lower <= expected * (1 + 1e-12) and expected <= value * (1 + 1e-12),
                                        (sizes, grid, row, expected))
                        self.assertLessEqual(value, (1 + float(error)) * lower * (1 + 1e-12))
                        if error == "0":
                            self.assertTrue(math.isclose(value, expected, rel_tol=1e-12, abs_tol=1e-13))


if __name__ == "__main__":
    main()
