# SPDX-License-Identifier: MIT
"""How ph-barcode interprets a matrix or an array: it never silently misreads its input. The tests
compute the expected results from the numbers that were written to the file."""
import math
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from guess_test import GuessTest, components, csv, distances_of, flat  # noqa: E402
from program import files, main  # noqa: E402


def correlations(rng, n):
    """The correlation matrix of n random walks."""
    series = [[rng.gauss(0, 1) for _ in range(12)] for _ in range(n)]
    for row in series:
        mean = sum(row) / len(row)
        norm = math.sqrt(sum((x - mean) ** 2 for x in row))
        row[:] = [(x - mean) / norm for x in row]
    return [[1.0 if i == j else sum(a * b for a, b in zip(*sorted((series[i], series[j]))))
             for j in range(n)] for i in range(n)]


class Matrices(GuessTest):
    def setUp(self):
        super().setUp()
        self.rng = random.Random(7)
        self.r = correlations(self.rng, 20)
        self.of_r = {(i, j): 1 - self.r[i][j] for i in range(20) for j in range(i)}
        self.write("r.csv", csv(self.r))
        self.write("r.npy", files.array((20, 20), flat(self.r)))

    def test_correlations(self):
        for name in ("r.csv", "r.npy"):
            self.check(self.of_r, name, "--from-correlation")
            self.refused(65, ["--from-correlation", "--format points"], name)
            points = self.h0(name, "--format", "points")
            self.assertAlmostEqual(points[0], components(distances_of(self.r))[0])
        self.check(self.of_r, "r.csv", "--from-correlation", "--symmetrise", "max")

    def test_a_pair_that_differs(self):
        for size in (1e-4, 0.3):
            r = [row[:] for row in self.r]
            r[4][3] += size if r[4][3] < 0 else -size
            self.write("one.csv", csv(r))
            self.write("one.npy", files.array((20, 20), flat(r)))
            for name in ("one.csv", "one.npy"):
                self.refused(65, ["nearly symmetric", "--from-correlation", "--format points"],
                             name)
                self.refused(65, ["--symmetrise"], name, "--from-correlation")
        covariance = [[3 * x for x in row] for row in r]
        self.write("c.csv", csv(covariance))
        self.check(distances_of(covariance), "c.csv", note="nearly symmetric: read as points")

    def test_advice_is_of_use(self):
        names = [f"v{i}" for i in range(20)]
        self.write("named.csv", "," + ",".join(names) + "\n" + "".join(
            f"{names[i]}," + csv([self.r[i]]) for i in range(20)))
        self.check(self.of_r, "named.csv", "--from-correlation", note="left out",
                   silent=["also takes it"])
        self.write("large.csv", csv([[1.2 * x for x in row] for row in self.r]))
        self.h0("large.csv", note="--format distance --diagonal zero reads distances",
                silent=["--from-correlation"])
        d = [[math.sqrt(max(0, 2 - 2 * x)) if i != j else 1.2 for j, x in enumerate(row)]
             for i, row in enumerate(self.r)]
        self.write("d.csv", csv(d))
        self.h0("d.csv", note="--diagonal zero reads distances")
        self.check({(i, j): d[i][j] for i in range(20) for j in range(i)}, "d.csv", "--format",
                   "distance", "--diagonal", "zero", note="taken as 0")

    def test_names(self):
        names = [f"v{i}" for i in range(20)]
        header = "," + ",".join(names) + "\n"
        rows = [f"{names[i]}," + csv([self.r[i]]) for i in range(20)]
        self.write("named.csv", header + "".join(rows))
        self.check(self.of_r, "named.csv", "--from-correlation", note="holds row names|no name")
        self.refused(65, ["--from-correlation"], "named.csv")
        numbered = [f"{i}," + csv([self.r[i]]) for i in range(20)]
        self.write("numbered.csv", "," + ",".join(map(str, range(20))) + "\n" + "".join(numbered))
        self.check(self.of_r, "numbered.csv", "--from-correlation", note="left out")
        self.write("quoted.csv", '"",' + ",".join(f'"{n}"' for n in names) + "\n"
                   + "".join(f'"{names[i]}",' + csv([self.r[i]]) for i in range(20)))
        self.check(self.of_r, "quoted.csv", "--from-correlation")
        self.write("shuffled.csv", header + rows[1] + rows[0] + "".join(rows[2:]))
        self.refused(65, ["different orders", "v1"], "shuffled.csv", "--from-correlation")
        self.write("cov.csv", header + "".join(
            f"{names[i]}," + csv([[4 * x for x in self.r[i]]]) for i in range(20)))
        self.refused(65, ["--format distance", "--format points"], "cov.csv")

    def test_a_correlation_that_is_not_there(self):
        r = [row[:] for row in self.r]
        for i, j in ((3, 4), (0, 19)):
            r[i][j] = r[j][i] = math.nan
        pairs = {p: d for p, d in self.of_r.items() if p not in ((4, 3), (19, 0))}
        self.write("nan.csv", csv(r))
        self.write("gaps.csv", "," + ",".join(f"v{i}" for i in range(20)) + "\n" + "".join(
            f"v{i}," + csv([row]).replace("nan", "") for i, row in enumerate(r)))
        self.write("nan.npy", files.array((20, 20), flat(r)))
        for name in ("nan.csv", "gaps.csv", "nan.npy"):
            self.check(pairs, name, "--from-correlation", "--nan", "drop")
            self.refused(65, ["--nan drop"] if name != "nan.csv" else [], name, "--from-correlation")
            self.expect(65, name, "--nan", "drop")

    def test_sparse(self):
        rows = [(i, j, self.r[i][j]) for i in range(20) for j in range(i) if (i + j) % 3]
        self.write("r.sparse", "".join(f"{i} {j} {r!r}\n" for i, j, r in rows))
        self.check({(i, j): 1 - r for i, j, r in rows}, "r.sparse", "--from-correlation",
                   "--threshold", "2")
        self.write("bad.sparse", "0 1 0.5\n1 2 1.5\n")
        self.refused(65, [":2:5:", "not a correlation"], "bad.sparse", "--from-correlation")

    def test_rounding_on_the_diagonal(self):
        d = [[math.sqrt(max(0, 2 * (1 - x))) for x in row] for row in self.r]
        pairs = {(i, j): d[i][j] for i in range(20) for j in range(i)}
        exact = csv(d)
        self.write("exact.csv", exact)
        self.write("savetxt.txt", "".join(" ".join(f"{x:.18e}" for x in row) + "\n" for row in d))
        for k, noise in ((5, 2.1e-8), (0, -1e-17)):
            d[k][k] = noise
        self.write("d.csv", csv(d))
        self.write("d.npy", files.array((20, 20), flat(d)))
        for name in ("exact.csv", "savetxt.txt"):
            self.check(pairs, name, note="zero diagonal", silent=["rounding"])
        for name in ("d.csv", "d.npy"):
            self.check(pairs, name, note="rounding")
            self.check(pairs, name, "--format", "distance", note="rounding")
        largest = max(pairs.values())
        for factor, code in ((0.99e-6, 0), (1.01e-6, 65)):
            d[7][7] = factor * largest
            self.write("edge.csv", csv(d))
            self.write("edge.npy", files.array((20, 20), flat(d)))
            self.expect(code, "edge.csv", "--format", "distance", "--quiet")
            self.expect(code, "edge.npy", "--format", "distance", "--quiet")
        self.refused(65, ["edge.csv:8:", "non-zero diagonal", "--diagonal zero",
                          "--diagonal births"], "edge.csv", "--format", "distance")
        d[7][7] = 1e-4 * largest
        d[5][5] = -0.25 * largest
        self.write("zero.csv", csv(d))
        self.write("zero.npy", files.array((20, 20), flat(d)))
        for name in ("zero.csv", "zero.npy"):
            self.check(pairs, name, "--diagonal", "zero",
                       note=f"diagonal has entries up to {0.25 * largest:.2g}, taken as 0")
            self.refused(65, ["--diagonal zero"], name, "--format", "distance")

    def test_what_is_no_matrix(self):
        points = [[self.rng.random(), self.rng.random()] for _ in range(9)]
        self.write("p.csv", csv(points))
        self.write("p.npy", files.array((9, 2), flat(points)))
        for option in (["--from-correlation"], ["--symmetrise", "max"], ["--diagonal", "births"]):
            for name in ("p.csv", "p.npy"):
                is_usage = name == "p.csv" and option[0] == "--diagonal"
                self.refused(64 if is_usage else 65, [option[0]], name, *option)
        square = [[self.rng.random() for _ in range(6)] for _ in range(6)]
        self.write("square.csv", csv(square))
        self.check(distances_of(square), "square.csv", silent=["symmetric", "--format"])
        for i in range(6):
            for j in range(i):
                square[i][j] = square[j][i]
        self.write("even.csv", csv(square))
        self.check(distances_of(square), "even.csv", note="symmetric: read as points; --format")


class Arrays(GuessTest):
    def setUp(self):
        super().setUp()
        rng = random.Random(3)
        self.points = [[rng.gauss(0, 1) for _ in range(3)] for _ in range(24)]
        self.write("x.npy", files.array((24, 3), flat(self.points)))
        self.pairs = distances_of(self.points)

    def test_points(self):
        self.check(self.pairs, "x.npy", note="24 x 3 array: read as one point per row; --complex cubical")
        for options in (["--format", "npy", "--complex", "rips"], ["--format", "points"]):
            self.check(self.pairs, "x.npy", *options, silent=["--complex cubical"])
        self.check({(i, j): math.dist(self.points[i][:2], self.points[j][:2])
                    for i in range(24) for j in range(i)}, "x.npy", "--columns", "1-2")
        self.check({(i, j): sum(abs(a - b) for a, b in zip(self.points[i], self.points[j]))
                    for i in range(24) for j in range(i)}, "x.npy", "--metric", "manhattan")
        self.assertEqual(len(self.h0("x.npy", "--subsample", "10")), 10)
        self.refused(64, ["--columns", "from 1 to 3"], "x.npy", "--columns", "4")

    def test_images(self):
        image = self.h0("x.npy", "--complex", "cubical", silent=["one point per row"])
        self.assertNotEqual(image, components(self.pairs))
        small = files.array((24, 3), [int(50 * abs(x)) % 256 for x in flat(self.points)], "|u1")
        self.write("u.npy", small)
        self.h0("u.npy", note="read as an image; --complex rips")
        self.assertEqual(len(self.h0("u.npy", "--complex", "rips", silent=["image"])), 24)
        self.write("wide.npy", files.array((11, 3), flat(self.points[:11])))
        self.h0("wide.npy", note="image of 11 x 3")
        for rows, columns in ((30, 64), (30, 10), (100, 17), (10, 3)):
            values = [math.sin(k * k) for k in range(rows * columns)]
            for form in ("<f8", "<f4"):
                self.write("f.npy", files.array((rows, columns), values, form))
                self.h0("f.npy", note=f"{rows} x {columns} array: read as an image; --complex rips")
            self.h0("f.npy", "--complex", "cubical", silent=["array"])
            self.h0("f.npy", "--superlevel", silent=["array"])
            self.assertEqual(len(self.h0("f.npy", "--complex", "rips", silent=["image"])), rows)
        self.write("u.npy", files.array((5, 6), list(range(30)), "|u1"))
        self.h0("u.npy", silent=["array"])
        self.write("one.npy", files.array((72,), flat(self.points)))
        self.h0("one.npy", note="signal of 72 values")
        self.write("batch.npy", files.array((2, 12, 3), flat(self.points)))
        self.h0("batch.npy", note="three axes: read as a volume")
        for shape, note in (((40, 40, 3), r"3 channels, take one channel, a\[\.\.\., 0\]"),
                            ((3, 40, 40), r"3 channels, take one channel, a\[0\]"),
                            ((4, 16, 30), r"4 channels, take one channel, a\[0\]")):
            self.write("colours.npy", files.array(shape, [k % 251 for k in range(math.prod(shape))], "|u1"))
            self.h0("colours.npy", note=note)
        for shape in ((3, 15, 40), (5, 40, 40), (40, 3, 40)):
            self.write("volume.npy", files.array(shape, [k % 251 for k in range(math.prod(shape))], "|u1"))
            self.h0("volume.npy", silent=["channel"])

    def test_distances(self):
        d = [[math.dist(p, q) for q in self.points] for p in self.points]
        self.write("d.npy", files.array((24, 24), flat(d)))
        for options in ([], ["--complex", "rips"], ["--subsample", "24"]):
            self.check(self.pairs, "d.npy", *options, note="read as distances")
        self.h0("d.npy", "--complex", "cubical", note="image of 24 x 24")
        picture = [[0.0] * 24 for _ in range(24)]
        picture[3][9] = picture[9][3] = 5.0
        self.write("black.npy", files.array((24, 24), flat(picture)))
        self.h0("black.npy", note="read as an image; --format distance")


if __name__ == "__main__":
    main()
