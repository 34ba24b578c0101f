# SPDX-License-Identifier: MIT
"""ph-distance --matching: each bar is in exactly one pair, and the cost of the pairs is the
distance."""
import json
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, main  # noqa: E402
from diagrams import INF, csv_of, norm, of_dim, random_bars, rows_of, to_diagonal, total  # noqa: E402

KINDS = [((), INF, INF), (("--distance", "wasserstein"), 1, INF),
         (("--distance", "wasserstein", "--order", "2", "--ground", "2"), 2, 2),
         (("--distance", "wasserstein", "--order", "3", "--ground", "1"), 3, 1),
         (("--distance", "wasserstein", "--error", "0.2"), 1, INF)]


def gap(x, y):
    return 0.0 if x == y else abs(x - y)


class Matchings(ProgramTest):
    def matched(self, *options):
        """The rows of the matching and the distances, each by dimension."""
        run = self.expect(0, "a.csv", "b.csv", *options, "--matching", "m.csv", "--output-format", "json", "--quiet")
        rows = {}
        for row in rows_of(self.read("m.csv")):
            self.assertEqual(row["distance"], options[1] if options else "bottleneck")
            rows.setdefault(int(row["dim"]), []).append(row)
        return rows, {d["dim"]: d["value"] for d in json.loads(run.stdout)["distances"]}

    def check(self, rows, bars, value, order, ground):
        """@param bars the bars of one dimension of both barcodes, in the order in which ph-barcode
        writes bars."""
        for side, own in zip("ab", bars):
            places = [int(row[side]) for row in rows if row[side] != "diagonal"]
            self.assertEqual(sorted(places), list(range(len(own))))
            for row in rows:
                if row[side] != "diagonal":
                    self.assertEqual((float(row[side + "_birth"]), float(row[side + "_death"])), own[int(row[side])])
        keys = [int(row["a"]) if row["a"] != "diagonal" else math.inf for row in rows]
        self.assertEqual(keys, sorted(keys))
        self.assertEqual({(float(row["order"]), float(row["ground"])) for row in rows} - {(order, ground)}, set())
        costs = []
        for row in rows:
            a, b = ((float(row[side + "_birth"]), float(row[side + "_death"])) for side in "ab")
            self.assertFalse(row["a"] == row["b"] == "diagonal")
            for side, own, other in (("a", a, b), ("b", b, a)):
                if row[side] == "diagonal":
                    self.assertEqual(own, ((other[0] + other[1]) / 2,) * 2)
                    self.assertAlmostEqual(float(row["cost"]), to_diagonal(other, ground), places=14)
            costs.append(norm(gap(a[0], b[0]), gap(a[1], b[1]), ground))
            self.assertAlmostEqual(float(row["cost"]), costs[-1], places=14)
        self.assertTrue(math.isclose(total(costs, order), value, rel_tol=1e-12, abs_tol=1e-14), (costs, value))

    def test_pairs_cost_what_the_distance_is(self):
        for grid in (None, 8):
            for sizes in ((3, 5), (0, 4), (30, 25)):
                both = [sorted(random_bars(10 * seed + size, {0: (size, 2), 1: (size, 0)}, grid))
                        for seed, size in enumerate(sizes)]
                both = [bars + [(0, -INF, 0.1 + k), (0, -INF, INF)] for k, bars in enumerate(both)]
                both = [sorted(bars) for bars in both]
                for name, bars in zip(("a.csv", "b.csv"), both):
                    self.write(name, csv_of(bars))
                for options, order, ground in KINDS:
                    rows, values = self.matched(*options)
                    self.assertEqual(list(values), [0, 1])
                    for dim, value in values.items():
                        self.check(rows.get(dim, []), [of_dim(bars, dim) for bars in both], value, order, ground)

    def test_the_distance_is_the_same(self):
        for name, seed in (("a.csv", 1), ("b.csv", 2)):
            self.write(name, csv_of(random_bars(seed, {0: (9, 1), 1: (12, 0)})))
        for options, _, _ in KINDS:
            run = ("a.csv", "b.csv", *options, "--quiet")
            printed = self.expect(0, *run).stdout
            self.assertEqual(self.expect(0, *run, "--matching", "m.csv").stdout, printed)

    def test_json_says_the_same(self):
        self.write("a.csv", csv_of([(1, 0, 4), (1, 1, 2), (1, 3, INF), (2, 0, INF)]))
        self.write("b.csv", csv_of([(1, 0, 5), (1, 3.5, INF), (3, -INF, 2)]))
        self.expect(0, "a.csv", "b.csv", "--matching", "m.json", "-o", "d.json")
        found = json.loads(self.read("m.json"))
        self.assertEqual((found["format"], found["distance"], found["inputs"]),
                         ("ph-distance matching", "bottleneck", ["a.csv", "b.csv"]))
        self.assertEqual(found["distances"], [{"dim": 1, "value": 1, "lower": 1},
                                              {"dim": 2, "value": None, "lower": None},
                                              {"dim": 3, "value": None, "lower": None}])
        self.assertEqual(found["pairs"], [
            {"dim": 1, "a": {"bar": 0, "birth": 0, "death": 4}, "b": {"bar": 0, "birth": 0, "death": 5}, "cost": 1},
            {"dim": 1, "a": {"bar": 1, "birth": 1, "death": 2},
             "b": {"bar": "diagonal", "birth": 1.5, "death": 1.5}, "cost": 0.5},
            {"dim": 1, "a": {"bar": 2, "birth": 3, "death": None},
             "b": {"bar": 1, "birth": 3.5, "death": None}, "cost": 0.5}])
        self.expect(0, "a.csv", "b.csv", "--matching", "-", "-o", "d.json", "--dim", "1")
        run = self.expect(0, "a.csv", "b.csv", "--matching", "-", "-o", "d.json", "--dim", "1", "--quiet")
        self.assertEqual(run.stdout, "dim,distance,order,ground,a,b,a_birth,a_death,b_birth,b_death,cost\n"
                         "1,bottleneck,inf,inf,0,0,0,4,0,5,1\n1,bottleneck,inf,inf,1,diagonal,1,2,1.5,1.5,0.5\n"
                         "1,bottleneck,inf,inf,2,1,3,inf,3.5,inf,0.5\n")
        self.write("always.csv", csv_of([(1, -INF, 2)]))
        self.expect(0, "always.csv", "always.csv", "--matching", "m.json")
        self.assertEqual(json.loads(self.read("m.json"))["pairs"][0]["a"], {"bar": 0, "birth": "-inf", "death": 2})


if __name__ == "__main__":
    main()
