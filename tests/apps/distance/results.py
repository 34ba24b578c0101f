# SPDX-License-Identifier: MIT
"""Tests of ph-distance: distances agree with the definitions in every output format, matrices are
correct, and every input format is read."""
import itertools
import json
import math
import os
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, files, main  # noqa: E402
from diagrams import INF, csv_of, distance, of_dim, random_bars, rows_of  # noqa: E402

KINDS = [((), INF, INF), (("--distance", "wasserstein"), 1, INF),
         (("--distance", "wasserstein", "--order", "2", "--ground", "2"), 2, 2),
         (("--distance", "wasserstein", "--order", "1.5", "--ground", "1"), 1.5, 1),
         (("--distance", "wasserstein", "--order", "3", "--ground", "inf"), 3, INF)]
HEADINGS = ["bottleneck distance (order inf, ground norm inf)", "Wasserstein distance (order 1, ground norm inf)",
            "Wasserstein distance (order 2, ground norm 2)", "Wasserstein distance (order 1.5, ground norm 1)",
            "Wasserstein distance (order 3, ground norm inf)"]


class Results(ProgramTest):
    def setUp(self):
        super().setUp()
        self.bars = {}
        for seed in range(4):
            name = f"{'abcd'[seed]}.csv"
            self.bars[name] = random_bars(seed, {0: (3, 1), 1: (4 if seed % 2 else 3, 0)},
                                          grid=16 if seed > 1 else None)
            self.write(name, csv_of(self.bars[name]))

    def out(self, *arguments, **options):
        return self.expect(0, *arguments, "--quiet", **options).stdout

    def check_row(self, row, order, ground):
        a, b = (of_dim(self.bars[row[side]], int(row["dim"])) for side in "ab")
        expected = distance(a, b, order, ground)
        self.assertTrue(math.isclose(float(row["value"]), expected, rel_tol=1e-12), (row, expected))
        self.assertTrue(math.isclose(float(row["lower"]), expected, rel_tol=1e-12), (row, expected))
        self.assertEqual((float(row["order"]), float(row["ground"]), row["directions"]), (order, ground, ""))

    def test_all_pairs_by_the_definition(self):
        for (options, order, ground), heading in zip(KINDS, HEADINGS):
            rows = rows_of(self.out(*self.bars, *options, "--output-format", "csv"))
            self.assertEqual([(row["dim"], row["a"], row["b"]) for row in rows],
                             [(dim, a, b) for dim in "01" for a, b in itertools.combinations(self.bars, 2)])
            for row in rows:
                self.check_row(row, order, ground)
                self.assertEqual(row["distance"], options[1] if options else "bottleneck")
            text = self.out(*self.bars, *options).splitlines()
            self.assertEqual(text[0], heading + " of 4 barcodes")
            self.assertEqual(text[1:], [f"H{r['dim']}  {r['value']}  {r['a']}  {r['b']}" for r in rows])
            document = json.loads(self.out(*self.bars, *options, "--output-format", "json"))
            self.assertEqual(document["inputs"], list(self.bars))
            self.assertEqual([document["order"], document["ground"]],
                             [None if x == INF else x for x in (order, ground)])
            self.assertEqual([[d["dim"], document["inputs"][d["a"]], document["inputs"][d["b"]], d["value"], d["lower"]]
                              for d in document["distances"]],
                             [[int(r["dim"]), r["a"], r["b"], float(r["value"]), float(r["lower"])] for r in rows])

    def test_two_barcodes(self):
        for (options, order, ground), heading in zip(KINDS, HEADINGS):
            rows = rows_of(self.out("a.csv", "b.csv", *options, "--output-format", "csv"))
            for row in rows:
                self.check_row(row, order, ground)
            self.assertEqual(self.out("a.csv", "b.csv", *options),
                             f"{heading} of a.csv and b.csv\n" + "".join(f"H{r['dim']}  {r['value']}\n" for r in rows))
            for dims in ("1", "1,0"):
                found = rows_of(self.out("a.csv", "b.csv", *options, "--dims", dims, "--output-format", "csv"))
                self.assertEqual(found, [rows[int(d)] for d in dims.split(",")])

    def test_limits(self):
        a, b = (of_dim(self.bars[name], 1) for name in ("a.csv", "b.csv"))
        for options, order, ground in KINDS:
            expected = distance(a, b, order, ground)
            run = ("a.csv", "b.csv", "--dim", "1", *options)
            for error in ("0", "0.01", "1"):
                row, = rows_of(self.out(*run, "--error", error, "--output-format", "csv"))
                value, lower = float(row["value"]), float(row["lower"])
                self.assertTrue(lower <= expected * (1 + 1e-12) and expected <= value * (1 + 1e-12), row)
                self.assertLessEqual(value, (1 + float(error)) * lower * (1 + 1e-12))
                heading, text = self.out(*run, "--error", error).splitlines()
                self.assertEqual(f", relative error {error}) of" in heading, error != "0")
                exact = error == "0" or value == lower
                self.assertEqual(text, f"H1  {row['value']}" + ("" if exact else f" (at least {row['lower']})"))
            below, above = repr(expected / 4), repr(expected * 2)
            text = self.out(*run, "--at-most", below).splitlines()[1]
            self.assertTrue(text.startswith(f"H1  more than {below}: from "), text)
            low, high = (float(word) for word in text.split(": from ")[1].split(" to "))
            self.assertTrue(expected / 4 < low <= expected * (1 + 1e-12) <= high * (1 + 2e-12), (text, expected))
            document = json.loads(self.out(*run, "--at-most", below, "--output-format", "json"))
            self.assertEqual((document["at_most"], document["distances"][0]["lower"]), (expected / 4, low))
            text = self.out(*run, "--at-most", above).splitlines()[1]
            self.assertTrue(math.isclose(float(text[4:]), expected, rel_tol=1e-12), text)

    def test_the_sliced_distance(self):
        for directions in (1, 7, 50):
            options = [] if directions == 50 else ["--directions", str(directions)]
            rows = rows_of(self.out("a.csv", "b.csv", "--distance", "sliced", *options, "--output-format", "csv"))
            for row in rows:
                a, b = (of_dim(self.bars[row[side]], int(row["dim"])) for side in "ab")
                rays = [sorted(x for x, y in bars if y == INF) for bars in (a, b)]
                a, b = ([bar for bar in bars if bar[1] < INF] for bars in (a, b))
                first, second = (one + [((x + y) / 2,) * 2 for x, y in other] for one, other in ((a, b), (b, a)))
                expected = 0.0
                for k in range(directions):
                    cos, sin = math.cos(k * math.pi / directions), math.sin(k * math.pi / directions)
                    lines = [sorted(x * cos + y * sin for x, y in points) for points in (first, second)]
                    expected += sum(abs(x - y) for x, y in zip(*lines)) / directions
                expected += sum(abs(x - y) for x, y in zip(*rays))
                self.assertTrue(math.isclose(float(row["value"]), expected, rel_tol=1e-12), (row, expected))
                self.assertEqual((row["order"], row["ground"], row["directions"]), ("1", "", str(directions)))
            self.assertTrue(self.out("a.csv", "b.csv", "--distance", "sliced", *options).startswith(
                f"sliced Wasserstein distance (order 1, {directions} directions) of a.csv and b.csv\n"))

    def test_matrices(self):
        values = {(r["a"], r["b"]): float(r["value"])
                  for r in rows_of(self.out(*self.bars, "--dim", "1", "--output-format", "csv"))}
        square = [[0.0 if a == b else values[min(a, b), max(a, b)] for b in self.bars] for a in self.bars]
        # The matrix replaces the table.
        self.assertEqual(self.out(*self.bars, "--dim", "1", "--matrix", "m.csv"), "")
        self.assertIn("m.csv: bottleneck distance (order inf, ground norm inf) in H1",
                      self.expect(0, *self.bars, "--dim", "1", "--matrix", "m.csv").stderr)
        rows = rows_of(self.read("m.csv"))
        self.assertEqual([row["input"] for row in rows], list(self.bars))
        self.assertEqual([[float(row[name]) for name in self.bars] for row in rows], square)
        self.assertEqual(self.out(*self.bars, "--dim", "1", "--matrix", "-"), self.read("m.csv"))
        self.assertEqual(self.out(*self.bars, "--dim", "1", "--matrix", "m.npy", "--output-format", "text"),
                         self.out(*self.bars, "--dim", "1"))
        content = self.read_bytes("m.npy")
        start = 10 + struct.unpack("<H", content[8:10])[0]
        self.assertEqual(eval(content[10:start]),  # the header as NumPy reads it
                         {"descr": "<f8", "fortran_order": False, "shape": (4, 4)})
        self.assertEqual(list(struct.unpack("<16d", content[start:])), list(itertools.chain(*square)))
        run = self.expect(64, *self.bars, "--matrix", "n.npy")
        self.assertIn("--matrix: found H0 and H1, expected one dimension; --dim D", run.stderr)
        self.assertNotIn("n.npy", self.files())
        self.write("e.csv", csv_of(bar for bar in self.bars["a.csv"] if bar[0] == 1))
        self.expect(0, "e.csv", "e.csv", "--matrix", "n.csv")  # the bars have a single dimension
        self.assertEqual(self.read("n.csv"), "input,e.csv,e.csv\ne.csv,0,0\ne.csv,0,0\n")

    def test_infinite_distances(self):
        for name, bars in (("x.csv", [(0, 0, INF), (1, 0, 2)]), ("y.csv", [(0, 0, INF), (0, 1, INF)]),
                           ("z.csv", [(0, -INF, 3), (0, -INF, INF)])):
            self.write(name, csv_of(bars))
        run = self.expect(0, "x.csv", "y.csv")
        self.assertEqual(run.stdout.splitlines()[1:], ["H0  inf: 1 and 2 bars that never die", "H1  1"])
        self.assertNotIn("infinite", run.stderr)
        text = self.out("x.csv", "z.csv", "--distance", "sliced").splitlines()[1]
        self.assertEqual(text, "H0  inf: 1 and 0 bars that never die, 0 and 1 bars that were always there, 0 and 1 bars "
                         "that were always there and never die")
        run = self.expect(0, "x.csv", "y.csv", "z.csv", "--output-format", "csv")
        self.assertIn("H0: 3 distances are infinite, because the numbers of infinite bars differ", run.stderr)
        self.assertEqual([r["value"] for r in rows_of(run.stdout)], ["inf"] * 3 + ["1", "1", "0"])
        run = self.expect(0, "x.csv", "y.csv", "--dim", "0", "--matrix", "m.csv", "--output-format", "json")
        self.assertIn("H0: 1 distance is infinite", run.stderr)
        self.assertEqual(json.loads(run.stdout)["distances"], [{"a": 0, "b": 1, "dim": 0, "value": None, "lower": None}])
        self.assertEqual(self.read("m.csv"), "input,x.csv,y.csv\nx.csv,0,inf\ny.csv,inf,0\n")

    def test_dimensions_that_are_not_there(self):
        run = self.expect(0, "a.csv", "b.csv", "--dims", "2,0")
        self.assertIn("--dims: no barcode has bars of H2: all distances are 0", run.stderr)
        self.assertEqual(run.stdout.splitlines()[1], "H2  0")
        self.write("none.csv", csv_of([]))
        run = self.expect(0, "none.csv", "none.csv")
        self.assertEqual(run.stdout.splitlines()[1:], ["no bars"])
        self.assertEqual(json.loads(self.out("none.csv", "none.csv", "--output-format", "json"))["distances"], [])
        self.assertIn("found no bars", self.expect(64, "none.csv", "none.csv", "--matrix", "x.npy").stderr)
        # All bars of the second barcode are paired with the diagonal.
        self.assertEqual(self.out("none.csv", "a.csv", "--dim", "1"),
                         f"{HEADINGS[0]} of none.csv and a.csv\nH1  "
                         f"{max((e - b) / 2 for b, e in of_dim(self.bars['a.csv'], 1))}\n")

    def test_inputs(self):
        expected = self.out("a.csv", "b.csv", "--output-format", "csv")
        content = csv_of(self.bars["a.csv"])
        self.assertEqual(self.out("-", "b.csv", "--output-format", "csv", input=content), expected.replace("a.csv", "-"))
        self.write("a.csv.gz", files.gzipped(content.encode()))
        self.write('odd,"a.csv', content)
        numbers = [x for bar in self.bars["a.csv"] for x in bar]
        self.write("a.npy", files.array((len(numbers) // 3, 3), numbers, "<f8"))
        self.write("a.pers", "".join(f"{d} {b} {e}\n" for d, b, e in self.bars["a.csv"]))
        for name in ("a.csv.gz", 'odd,"a.csv', "a.npy", "a.pers"):
            rows = rows_of(self.out(name, "b.csv", "--output-format", "csv"))
            self.assertEqual([{**row, "a": "a.csv"} for row in rows], rows_of(expected), name)
            self.assertEqual({row["a"] for row in rows}, {name})
        os.mkdir(self.path("folder"))
        for name in ("b.csv", "a.csv"):
            self.write("folder/" + name, csv_of(self.bars[name]))
        self.write("folder/readme.txt", "no barcode")
        self.assertEqual(self.out("folder", "--output-format", "csv"),
                         expected.replace("a.csv", "folder/a.csv").replace("b.csv", "folder/b.csv"))
        os.mkdir(self.path("empty"))
        self.expect(66, "empty", "a.csv")
        self.expect(66, "missing.csv", "a.csv")
        self.assertIn("square.txt:1", self.expect(65, "square.txt", "a.csv").stderr)
        self.write("bad.csv", csv_of([(0, 2, 1)]))
        self.assertIn("bad.csv:2", self.expect(65, "a.csv", "bad.csv").stderr)

    def test_threads_and_memory(self):
        names = [self.write(f"{i}.csv", csv_of(random_bars(i, {1: (10 + 3 * (i % 7), 0)}))) for i in range(20)]
        for kind in (["--distance", "wasserstein", "--error", "0.05"], ["--distance", "sliced"], []):
            one = self.out(*names, *kind, "--threads", "1", "--output-format", "csv")
            self.assertEqual(self.out(*names, *kind, "--threads", "4", "--output-format", "csv"), one)
        large = self.write("large.csv", csv_of((1, i, i + 1) for i in range(200_000)))
        self.assertIn("--memory-limit", self.expect(75, large, large, "--memory-limit", "8MB").stderr)


if __name__ == "__main__":
    main()
