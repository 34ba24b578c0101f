# SPDX-License-Identifier: MIT
"""ph-vectorise: tables agree with the definitions in both formats; also tests inputs of all
formats."""
import csv
import io
import math
import os
import statistics
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, files, main  # noqa: E402

INF = math.inf
A = [(0, 0, 4), (0, 1, 2), (0, 0, INF), (1, 3, 5), (1, 2, 2), (1, 1, 4)]
B = [(0, 0, 1), (1, 2, 3)]
EMPTY = []


def csv_of(bars):
    return "dim,birth,death\n" + "".join(f"{d},{b},{e}\n" for d, b, e in bars)


def finite(bars, dim):
    return [(b, e) for d, b, e in bars if d == dim and b < e < INF]


def tent(bar, t):
    return max(0.0, min(t - bar[0], bar[1] - t))


def grid(low, high, count):
    return [low + (high - low) * i / (count - 1) for i in range(count)]


class Results(ProgramTest):
    def setUp(self):
        super().setUp()
        for name, bars in (("a.csv", A), ("b.csv", B), ("none.csv", EMPTY)):
            self.write(name, csv_of(bars))

    def table(self, *arguments, **options):
        """The names of the columns, and a dictionary from each input to the numbers in its row."""
        run = self.expect(0, *arguments, "--quiet", **options)
        self.assertEqual(run.stderr, "")
        header, *rows = csv.reader(io.StringIO(run.stdout))
        self.assertEqual(header[0], "input")
        for row in rows:
            self.assertEqual(len(row), len(header))
        return header[1:], {row[0]: [float(x) for x in row[1:]] for row in rows}

    def assert_near(self, found, expected):
        self.assertEqual(len(found), len(expected))
        for x, y in zip(found, expected):
            self.assertAlmostEqual(x, y, places=12)

    def test_statistics_are_the_default(self):
        names, rows = self.table("a.csv", "b.csv", "none.csv")
        self.assertEqual(list(rows), ["a.csv", "b.csv", "none.csv"])
        self.assertEqual(len(names), 2 * 38)
        self.assertEqual(rows["none.csv"], [0.0] * 76)
        column = dict(zip(names, rows["a.csv"]))
        lengths = [e - b for b, e in finite(A, 1)]
        self.assertAlmostEqual(column["H1_length_mean"], statistics.fmean(lengths))
        self.assertAlmostEqual(column["H1_length_sd"], statistics.pstdev(lengths))
        self.assertAlmostEqual(column["H1_birth_median"], 2)
        self.assertAlmostEqual(column["H0_death_p25"], 2.5)
        self.assertEqual(column["H0_count"], 2)  # one of the bars never dies
        shares = [x / sum(lengths) for x in lengths]
        self.assertAlmostEqual(column["H1_entropy"], -sum(p * math.log(p) for p in shares))

    def test_curves(self):
        values = grid(-1, 5, 13)
        for kind in ("betti", "silhouette", "life-entropy"):
            names, rows = self.table("a.csv", "b.csv", "--kind", kind, "--grid", "-1,5,13",
                                     "--power", "2") if kind == "silhouette" else \
                self.table("a.csv", "b.csv", "--kind", kind, "--grid", "-1,5,13")
            self.assertEqual(len(names), 26)
            self.assertEqual(names[13], f"H1_{kind.replace('-', '_')}0")
            for name, given in (("a.csv", A), ("b.csv", B)):
                expected = []
                for dim in (0, 1):
                    bars = finite(given, dim)
                    total = sum(e - b for b, e in bars)
                    for t in values:
                        alive = [(e - b) / total for b, e in bars if b <= t < e]
                        weights = [(e - b)**2 for b, e in bars]
                        expected.append({
                            "betti": len(alive),
                            "life-entropy": -sum(p * math.log(p) for p in alive),
                            "silhouette": sum(w * tent(bar, t) for w, bar in zip(weights, bars))
                            / sum(weights)}[kind])
                self.assert_near(rows[name], expected)

    def test_landscapes(self):
        names, rows = self.table("a.csv", "--kind", "landscape", "--layers", "3", "--dim", "1",
                                 "--grid", "0,6,7")
        self.assertEqual(names[7], "H1_layer1_0")
        expected = [sorted((tent(bar, t) for bar in [*finite(A, 1), (0, 0)]), reverse=True)[k]
                    for k in range(3) for t in grid(0, 6, 7)]
        self.assert_near(rows["a.csv"], expected)

    def test_images(self):
        names, rows = self.table("a.csv", "--kind", "image", "--dims", "1", "--grid", "0,6,3",
                                 "--length-grid", "0,4,2", "--sigma", "0.5", "--power", "2")
        self.assertEqual(names[4], "H1_p1_b1")

        def share(low, high, centre):
            return (math.erf((high - centre) / 0.5 / math.sqrt(2))
                    - math.erf((low - centre) / 0.5 / math.sqrt(2))) / 2
        expected = [sum((e - b)**2 * share(2 * i, 2 * i + 2, b) * share(2 * j, 2 * j + 2, e - b)
                        for b, e in finite(A, 1)) for j in range(2) for i in range(3)]
        self.assert_near(rows["a.csv"], expected)

    def test_single_numbers(self):
        lengths = sorted((e - b for b, e in finite(A, 1)), reverse=True)
        names, rows = self.table("a.csv", "--kind", "lengths", "--dims", "1", "--count", "3")
        self.assertEqual(names, ["H1_length0", "H1_length1", "H1_length2"])
        self.assert_near(rows["a.csv"], lengths + [0])
        shares = [x / sum(lengths) for x in lengths]
        entropy = -sum(p * math.log(p) for p in shares)
        self.assert_near(self.table("a.csv", "--kind", "entropy", "--dims", "1")[1]["a.csv"], [entropy])
        self.assert_near(self.table("a.csv", "--kind", "entropy", "--dims", "1", "--normalised")[1]
                         ["a.csv"], [entropy / math.log(2)])

    def test_atol(self):
        # With as many centres as bars, the centres are the bars.
        points = sorted({*finite(A, 1), *finite(B, 1)})
        for contrast, decay in (("laplace", lambda d, w: math.exp(-d / w)),
                                ("gauss", lambda d, w: math.exp(-(d / w)**2))):
            names, rows = self.table("a.csv", "b.csv", "--kind", "atol", "--dims", "1", "--count", "3",
                                     "--contrast", contrast, "--seed", "7")
            self.assertEqual(names[2], "H1_centre2")
            widths = [min(math.dist(p, q) for q in points if q != p) / 2 for p in points]
            for name, bars in (("a.csv", A), ("b.csv", B)):
                self.assert_near(rows[name], [sum(decay(math.dist(bar, p), w) for bar in finite(bars, 1))
                                              for p, w in zip(points, widths)])

    def test_infinite_bars(self):
        def first(*arguments):
            return self.table("a.csv", "--kind", "betti", "--dims", "0", "--grid", "0,9,4",
                              *arguments)[1]["a.csv"]
        self.assertEqual(first(), [1, 1, 0, 0])
        self.assertEqual(first("--infinite", "drop"), [1, 1, 0, 0])
        self.assertEqual(first("--infinite", "keep"), [2, 2, 1, 1])
        self.assertEqual(first("--infinite", "6.5"), [2, 2, 1, 0])
        run = self.expect(0, "a.csv", "--kind", "lengths", "--dims", "0")
        self.assertIn("left out: 1 bar without a finite birth", run.stderr)
        self.assertNotIn("left out", self.expect(0, "a.csv", "--kind", "lengths", "--dims", "1").stderr)
        run = self.expect(65, "a.csv", "--infinite", "error")
        self.assertIn("a.csv: found a bar [0, inf) of H0", run.stderr)
        self.write("late.csv", csv_of([(0, 3, INF)]))
        run = self.expect(64, "late.csv", "--infinite", "2")
        self.assertIn("late.csv: --infinite: ", run.stderr)
        self.assertIn("at least 3", run.stderr)

    def test_what_cannot_be_counted_is_named(self):
        self.write("early.csv", "dim,birth,death\n1,-inf,3\n")
        run = self.expect(65, "early.csv", "--kind", "landscape", "--infinite", "keep")
        self.assertIn("early.csv: found a bar [-inf, 3), expected a finite birth; --infinite drop", run.stderr)
        self.write("vast.csv", "dim,birth,death\n1,0,1e101\n")
        for kind in ("betti", "landscape", "euler", "image", "atol"):
            self.assertIn("vast.csv: found 1e+101", self.expect(65, "vast.csv", "--kind", kind).stderr)
            if kind in ("betti", "landscape", "euler"):
                self.assertIn("vast.csv: found 1e+101",
                              self.expect(65, "vast.csv", "--kind", kind, "--infinite", "keep").stderr)

    def test_euler_curves_of_barcodes_and_images(self):
        names, rows = self.table("a.csv", "b.csv", "--kind", "euler", "--grid", "0,6,7")
        self.assertEqual(names[6], "euler6")
        for name, bars in (("a.csv", A), ("b.csv", B)):
            self.assertEqual(rows[name], [sum((-1)**d for d, b, e in bars if b <= t < e)
                                          for t in range(7)])
        ring = [0, 1, 0, 1, 5, 1, 0, 1, 0]
        self.write("ring.npy", files.array((3, 3), ring, "|u1"))
        self.write("float.npy", files.array((3, 3), ring, "<f4"))
        self.write("hole.npy", files.array((3, 3), [math.nan if v == 5 else v for v in ring], "<f4"))

        def curve(*arguments):
            return next(iter(self.table(*arguments, "--kind", "euler")[1].values()))
        for name in ("ring.npy", "float.npy"):
            self.assertEqual(curve(name, "--grid", "-1,5,7"), [0, 4, 0, 0, 0, 0, 1])
            self.assertEqual(curve(name, "--grid", "6"), [4, 0, 0, 0, 0, 1])  # the grid from 0 to 5
            self.assertEqual(curve(name, "--superlevel", "--grid", "-6,0,7"), [0, 1, 1, 1, 1, 1, 1])
            self.assertEqual(curve(name, "--construction", "cells", "--grid", "0,5,2"), [4, 1])
            self.assertEqual(curve(name, "--periodic", "all", "--grid", "0,5,2"), [1, 0])
            self.assertEqual(curve(name, "--periodic", "0", "--grid", "0,5,2"), [2, 0])
        self.expect(65, "hole.npy", "--kind", "euler")
        self.assertEqual(curve("hole.npy", "--nan", "drop", "--grid", "0,5,2"), [4, 0])
        # An array with three columns may be an image or a barcode.
        self.write("bars.npy", files.array((2, 3), [0, 0, 1, 1, 1, 3], "<f8"))
        self.assertEqual(curve("bars.npy", "--format", "barcode", "--grid", "0,2,3"), [1, -1, -1])
        self.assertEqual(curve("bars.npy", "--format", "image", "--grid", "0,2,3"), [1, 1, 1])
        self.expect(65, "square.txt", "--kind", "euler", "--format", "image")

    def test_arrays(self):
        for kind in ("statistics", "betti"):
            names, rows = self.table("a.csv", "b.csv", "--kind", kind)
            self.expect(0, "a.csv", "b.csv", "--kind", kind, "-o", "x.npy", "--quiet")
            content = self.run_program("a.csv", "b.csv", "--kind", kind, "--output-format", "npy",
                                       text=False).stdout
            self.assertEqual(content, self.read_bytes("x.npy"))
            self.assertEqual(content[:8], b"\x93NUMPY\x01\x00")
            start = 10 + struct.unpack("<H", content[8:10])[0]
            self.assertEqual(start % 64, 0)
            header = eval(content[10:start])  # the header as NumPy reads it
            self.assertEqual(header, {"descr": "<f8", "fortran_order": False,
                                      "shape": (2, len(names))})
            numbers = struct.unpack(f"<{2 * len(names)}d", content[start:])
            self.assertEqual(list(numbers), rows["a.csv"] + rows["b.csv"])

    def test_inputs(self):
        expected = self.table("a.csv", "b.csv")[1]
        os.mkdir(self.path("folder"))
        for name, bars in (("a.csv", A), ("b.csv", B), ("readme.txt", [])):
            self.write(f"folder/{name}", csv_of(bars))
        rows = self.table("folder")[1]
        self.assertEqual(list(rows), ["folder/a.csv", "folder/b.csv"])
        self.assertEqual(list(rows.values()), list(expected.values()))
        rows = self.table("-", "b.csv", input=csv_of(A))[1]
        self.assertEqual(rows, {"-": expected["a.csv"], "b.csv": expected["b.csv"]})
        self.write("a.csv.gz", files.gzipped(csv_of(A).encode()))
        self.write('odd,"name.csv', csv_of(A))
        rows = self.table("a.csv.gz", 'odd,"name.csv')[1]
        self.assertEqual(rows, {"a.csv.gz": expected["a.csv"], 'odd,"name.csv': expected["a.csv"]})
        os.mkdir(self.path("empty"))
        self.expect(66, "empty")
        self.expect(66, "missing.csv")
        self.expect(65, "none.csv")  # no bars, and thus no dimensions
        self.assertEqual(self.table("none.csv", "--dims", "0")[1]["none.csv"], [0.0] * 38)
        self.assertIn("square.txt:1", self.expect(65, "square.txt").stderr)

    def test_images_larger_than_the_memory(self):
        """Images stay in their files and are read layer by layer."""
        count = 96
        values = bytes((x * x + 7 * y + 13 * z * x) % 251 for z in range(count) for y in range(count)
                       for x in range(count * 2))
        self.write("bytes.npy", files.npy("|u1", (count, count, 2 * count), values))
        grid_of = ["--kind", "euler", "--grid", "0,250,251", "--quiet"]
        expected = self.expect(0, "bytes.npy", *grid_of).stdout
        run = self.expect(0, "bytes.npy", *grid_of, "--memory-limit", "1MB", "--threads", "1")
        self.assertEqual(run.stdout, expected)
        # At the last value, the complex is the whole box, which has the Euler characteristic 1.
        self.assertEqual(expected.splitlines()[1].split(",")[-1], "1")

    def test_threads_and_memory(self):
        names = [self.write(f"{i}.csv", csv_of([(i % 2, j, j + 1 + i) for j in range(50)]))
                 for i in range(30)]
        for kind in ("landscape", "image", "atol"):
            one = self.run_program(*names, "--kind", kind, "--threads", "1").stdout
            self.assertEqual(self.run_program(*names, "--kind", kind, "--threads", "4").stdout, one)
        run = self.expect(75, *names, "--kind", "landscape", "--grid", "1000000", "--memory-limit", "50MB")
        self.assertIn("--memory-limit", run.stderr)


if __name__ == "__main__":
    main()
