# SPDX-License-Identifier: MIT
"""What ph-barcode takes a table, an array or a picture for: never for something else in silence.
The results are computed here again, from the numbers before they became a file."""
import math
import os
import random
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import program  # noqa: E402
from program import ProgramTest, files  # noqa: E402


def components(pairs):
    """Deaths of H0 over {(i, j): d}, by Kruskal's algorithm; ids from 0, inf joins nothing."""
    parent = {v: v for pair in pairs for v in pair}

    def root(v):
        while parent[v] != v:
            v = parent[v]
        return v

    deaths = []
    for (i, j), d in sorted(pairs.items(), key=lambda item: item[1]):
        if not math.isinf(d) and root(i) != root(j):
            parent[root(i)] = root(j)
            deaths.append(d)
    return deaths + [math.inf] * (len(parent) - len(deaths))


def distances_of(points):
    return {(i, j): math.dist(points[i], points[j]) for i in range(len(points)) for j in range(i)}


def correlations(rng, n):
    """A matrix of correlations of n random walks."""
    series = [[rng.gauss(0, 1) for _ in range(12)] for _ in range(n)]
    for row in series:
        mean = sum(row) / len(row)
        norm = math.sqrt(sum((x - mean) ** 2 for x in row))
        row[:] = [(x - mean) / norm for x in row]
    return [[1.0 if i == j else sum(a * b for a, b in zip(*sorted((series[i], series[j]))))
             for j in range(n)] for i in range(n)]


def csv(rows):
    return "".join(",".join(map(repr, row)) + "\n" for row in rows)


def flat(rows):
    return [x for row in rows for x in row]


def png(width, height, colour, bits, samples, palette=b""):
    row, code = len(samples) // height, "B" if bits == 8 else "H"
    rows = [struct.pack(f">{row}{code}", *samples[y * row:(y + 1) * row]) for y in range(height)]
    return files.png(width, height, bits, colour, rows,
                     files.png_chunk(b"PLTE", palette) if palette else b"")


class Guesses(ProgramTest):
    def h0(self, *arguments, note="", silent=()):
        """Deaths of H0; stderr must have the note, and none of what must not be said."""
        run = self.expect(0, *arguments, "--max-dim", "0")
        self.assertRegex(run.stderr, note or "^")
        for word in silent:
            self.assertNotIn(word, run.stderr)
        self.assertEqual(self.expect(0, *arguments, "--max-dim", "0", "--quiet").stderr, "")
        return [float(line.split(",")[2]) for line in run.stdout.splitlines()[1:]]

    def check(self, pairs, *arguments, **expected):
        found, wanted = self.h0(*arguments, **expected), components(pairs)
        self.assertEqual(len(found), len(wanted), arguments)
        for a, b in zip(found, wanted):
            self.assertTrue(a == b or math.isclose(a, b, rel_tol=1e-12), (arguments, a, b))

    def refused(self, code, words, *arguments):
        message = self.expect(code, *arguments, "--quiet").stderr
        for word in words:
            self.assertIn(word, message)


class Matrices(Guesses):
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
                   silent=["takes it, too"])
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
        self.check(self.of_r, "named.csv", "--from-correlation", note="names of the rows|no name")
        self.refused(65, ["--from-correlation"], "named.csv")
        numbered = [f"{i}," + csv([self.r[i]]) for i in range(20)]
        self.write("numbered.csv", "," + ",".join(map(str, range(20))) + "\n" + "".join(numbered))
        self.check(self.of_r, "numbered.csv", "--from-correlation", note="left out")
        self.write("quoted.csv", '"",' + ",".join(f'"{n}"' for n in names) + "\n"
                   + "".join(f'"{names[i]}",' + csv([self.r[i]]) for i in range(20)))
        self.check(self.of_r, "quoted.csv", "--from-correlation")
        self.write("shuffled.csv", header + rows[1] + rows[0] + "".join(rows[2:]))
        self.refused(65, ["another order", "v1"], "shuffled.csv", "--from-correlation")
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


class Arrays(Guesses):
    def setUp(self):
        super().setUp()
        rng = random.Random(3)
        self.points = [[rng.gauss(0, 1) for _ in range(3)] for _ in range(24)]
        self.write("x.npy", files.array((24, 3), flat(self.points)))
        self.pairs = distances_of(self.points)

    def test_points(self):
        self.check(self.pairs, "x.npy", note="24 x 3 array: read as a point a row; --complex cubical")
        for options in (["--format", "npy", "--complex", "rips"], ["--format", "points"]):
            self.check(self.pairs, "x.npy", *options, silent=["--complex cubical"])
        self.check({(i, j): math.dist(self.points[i][:2], self.points[j][:2])
                    for i in range(24) for j in range(i)}, "x.npy", "--columns", "1-2")
        self.check({(i, j): sum(abs(a - b) for a, b in zip(self.points[i], self.points[j]))
                    for i in range(24) for j in range(i)}, "x.npy", "--metric", "manhattan")
        self.assertEqual(len(self.h0("x.npy", "--subsample", "10")), 10)
        self.refused(64, ["--columns", "from 1 to 3"], "x.npy", "--columns", "4")

    def test_images(self):
        image = self.h0("x.npy", "--complex", "cubical", silent=["a point a row"])
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


class Tables(Guesses):
    def setUp(self):
        super().setUp()
        rng = random.Random(5)
        self.points = [[rng.gauss(0, 1), rng.gauss(0, 1)] for _ in range(12)]
        self.pairs = distances_of(self.points)

    def table(self, header, lead):
        return header + "\n" + "".join(f"{lead(i)},{csv([p])}" for i, p in enumerate(self.points))

    def test_index(self):
        for header in (",x,y", '"",x,y', "idx,x,y", "Index,x,y", "Unnamed: 0,x,y", "id,x,y"):
            for first in (0, 1):
                self.write("t.csv", self.table(header, lambda i, first=first: i + first))
                self.check(self.pairs, "t.csv", note="first column.*left out")
        for header in (",x,y", "id,x,y"):
            self.write("t.csv", self.table(header, lambda i: f'"a, {i}"'))
            self.check(self.pairs, "t.csv", note="left out")
        with_index = distances_of([[i, *p] for i, p in enumerate(self.points)])
        self.write("t.csv", self.table("t,x,y", lambda i: i))
        self.check(with_index, "t.csv", silent=["first column"])
        self.write("t.csv", self.table("t,x,y", lambda i: i).split("\n", 1)[1])
        self.check(with_index, "t.csv", note="counts the rows and is read as a coordinate")
        self.write("t.csv", self.table("id,x,y", lambda i: i * i + 3))
        self.h0("t.csv", note="id, is taken as numbers; --columns 2-3")
        for name in ("sample_id", "n", "point", "obs", "subject", "sample", "row id"):
            self.write("t.csv", self.table(f"{name},x,y", lambda i: i + 1))
            self.h0("t.csv", note=f"{name}, counts the rows and is read as a coordinate; "
                                  "--columns 2-3")
            self.check(self.pairs, "t.csv", "--columns", "2-3", silent=["counts"])

    def test_an_index_of_a_cloud(self):
        cloud = [[*p, k % 3 / 2] for k, p in enumerate(self.points)]
        pairs = distances_of(cloud)
        for header, lead in ((",x,y,z", str), ("x,y,z", str), ("id,x,y,z", lambda i: str(i + 1)),
                             ('"","x","y","z"', lambda i: f'"r{i}"')):
            self.write("c.xyz", header + "\n" + "".join(
                f"{lead(i)},{csv([p])}" for i, p in enumerate(cloud)))
            self.check(pairs, "c.xyz", note="left out", silent=["--columns"])
        self.write("c.xyz", "id,x,y,z\n" + "".join(f"7,{csv([p])}" for p in cloud))
        self.check(pairs, "c.xyz", silent=["left out", "--columns"])

    def test_missing_values(self):
        text = "x,y,z\n0,0,1\nNA,1,1\n1,\"NA\",0\n3,1,\n2,2,2\n"
        self.write("na.csv", text)
        self.assertEqual(len(self.h0("na.csv", "--nan", "drop", note="3 of 5 points")), 2)
        self.refused(65, ["na.csv:3:1:", "--nan drop"], "na.csv")
        self.write("last.csv", "x,y,z\n0,0,1\n3,1,\n2,2,2\n")
        self.refused(65, ["last.csv:3:", "--nan drop"], "last.csv")
        self.write("first.csv", "x,y,z\n3,1,\n0,0,1\n2,2,2\n")
        self.refused(65, ["--nan drop"], "first.csv")
        self.write("ragged.csv", "x,y,z\n0,0,1\n3,1\n2,2,2\n")
        self.assertNotIn("--nan", self.expect(65, "ragged.csv").stderr)

    def test_no_rows(self):
        for text in ("", "# nothing\n", "x,y\n"):
            self.write("empty.csv", text)
            self.refused(65, ["no points"], "empty.csv")

    def test_bars(self):
        self.write("bars.csv", "0,0,1\n0,0,2\n1,1,2\n")
        self.h0("bars.csv", note="dimension, birth and death; ph-barcode plot bars.csv")
        self.write("bars.npy", files.array((3, 3), [0, 0, 1, 0, 0, 2, 1, 1, 2]))
        self.h0("bars.npy", note="ph-barcode plot bars.npy")
        self.write("endless.csv", "0,0,inf\n0,0,2\n")
        self.refused(65, ["ph-barcode plot endless.csv"], "endless.csv")
        self.write("p.csv", "0,0,1\n0.5,0,2\n1,1,2\n")
        self.h0("p.csv", silent=["death"])

    def test_columns(self):
        self.write("t.csv", self.table("name,x,y", lambda i: f"p{i}"))
        self.refused(65, [":2:1:", "--columns"], "t.csv")
        for columns in ("x,y", "2-3", "3,2", "y,x", "x,3"):
            self.check(self.pairs, "t.csv", "--columns", columns)
        self.write("numbers.csv", self.table("2,1,3", lambda i: i))  # no header: all are numbers
        for wrong in ("z", "4", "0", "3-2", "x,2", "2-9"):
            self.refused(64, ["--columns"], "t.csv", "--columns", wrong)
        self.refused(64, ["--columns"], "t.csv", "--columns", "x,,y")
        self.write("q.csv", '"x","y"\n' + "".join(f'"{p[0]!r}","{p[1]!r}"\n' for p in self.points))
        self.check(self.pairs, "q.csv")
        self.write("m.off", "OFF\n1 0 0\n0 0 0\n")
        self.refused(64, ["--columns", "off"], "m.off", "--columns", "1")

    def test_signals(self):
        values = [p[0] for p in self.points]
        lows = [v for i, v in enumerate(values) if all(
            v < values[k] for k in (i - 1, i + 1) if 0 <= k < len(values))]
        self.write("s.csv", "".join(f"{v!r}\n" for v in values))
        self.assertEqual(len(self.h0("s.csv", "--complex", "cubical", note="signal of 12")), len(lows))
        self.write("row.csv", csv([values]))
        self.assertEqual(len(self.h0("row.csv", "--complex", "cubical", note="signal of 12")),
                         len(lows))
        self.write("p.csv", csv(self.points))
        self.h0("s.csv", note="--complex cubical reads a signal")
        self.refused(64, ["--voxel", "--format grid"], "p.csv", "--complex", "cubical")
        rows = [[v + k * k % 3 for k in range(6)] for v in values]
        self.write("i.csv", csv(rows))
        self.write("i.npy", files.array((12, 6), flat(rows)))
        expected = self.expect(0, "i.npy", "--complex", "cubical").stdout
        self.assertEqual(self.expect(0, "i.csv", "--complex", "cubical").stdout, expected)
        self.assertEqual(self.expect(0, "i.csv", "--format", "grid").stdout, expected)


class Values(Guesses):
    def test_of_a_mesh(self):
        faces = "3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n"
        corners = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"]
        self.write("m.off", "OFF\n4 4 0\n" + "\n".join(corners) + "\n" + faces)
        self.write("m.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                   "property float z\nproperty short height\nelement face 4\n"
                   "property list uchar int vertex_indices\nend_header\n"
                   + "".join(f"{c} {h}\n" for c, h in zip(corners, (5, 1, 3, 2))) + faces)
        self.write("v.txt", "5\n1\n3\n2\n")
        expected = "dim,birth,death\n0,1,inf\n2,5,inf\n"
        self.write("v.csv", "height\n5\n1\n3\n2\n")
        self.write("v.npy", files.array((4,), [5, 1, 3, 2]))
        self.write("column.npy", files.array((4, 1), [5, 1, 3, 2]))
        self.write("whole.npy", files.array((4,), [5, 1, 3, 2], "<i4"))
        for mesh in ("m.off", "m.ply"):
            for values in ("v.txt", "v.csv", "v.npy", "column.npy", "whole.npy", "m.ply:height"):
                run = self.expect(0, mesh, "--values", values)
                self.assertEqual(run.stdout, expected, (mesh, values))
                self.assertNotIn("faces are not used", run.stderr)
            self.assertIn("4 faces are not used", self.expect(0, mesh).stderr)
        self.write("square.npy", files.array((2, 2), [5, 1, 3, 2]))
        self.write("few.npy", files.array((3,), [5, 1, 3]))
        for values, words in (("square.npy", ["(2, 2)"]), ("few.npy", ["too few", "3", "4"]),
                              ("m.ply", ["height"]), ("m.ply:depth", ["depth", "height"])):
            self.refused(65, words, "m.off", "--values", values)
        self.refused(65, ["property"], "m.ply:height")

    def test_of_points(self):
        self.write("w.npy", files.array((4,), [0.5, 0, 0, 0.25]))
        self.write("w.txt", "0.5\n0\n0\n0.25\n")
        results = {self.expect(0, "square.txt", "--vertex-weights", name).stdout
                   for name in ("w.npy", "w.txt")}
        self.assertEqual(len(results), 1)
        self.assertNotEqual(results, {program.SQUARE_CSV})


class Pictures(Guesses):
    def test_channels(self):
        rng = random.Random(2)
        for bits in (8, 16):
            pixels = [[rng.randrange(1 << bits) for _ in range(4)] for _ in range(30)]
            luma = [(299 * r + 587 * g + 114 * b + 500) // 1000 for r, g, b, _ in pixels]
            planes = dict(zip(("red", "green", "blue", "alpha"), map(list, zip(*pixels))), grey=luma)
            self.write("rgba.png", png(6, 5, 6, bits, flat(pixels)))
            self.write("rgb.png", png(6, 5, 2, bits, flat(p[:3] for p in pixels)))
            self.write("la.png", png(6, 5, 4, bits, flat((p[0], p[3]) for p in pixels)))
            for channel, values in planes.items():
                self.write("i.npy", files.array((5, 6), values))
                expected = self.expect(0, "i.npy").stdout
                for name in ("rgba.png", "rgb.png"):
                    if (name, channel) != ("rgb.png", "alpha"):
                        run = self.expect(0, name, "--channel", channel)
                        self.assertEqual(run.stdout, expected, (name, channel, bits))
            for channel, k in (("grey", 0), ("alpha", 3)):
                self.write("i.npy", files.array((5, 6), [p[k] for p in pixels]))
                self.assertEqual(self.expect(0, "la.png", "--channel", channel).stdout,
                                 self.expect(0, "i.npy").stdout)
            for name in ("rgba.png", "rgb.png", "la.png"):
                self.refused(65, ["--channel grey", "channels"], name)
            self.refused(65, ["no channel alpha"], "rgb.png", "--channel", "alpha")
            self.refused(65, ["no channel red"], "la.png", "--channel", "red")
            self.write("same.png", png(6, 5, 2, bits, flat([p[0]] * 3 for p in pixels)))
            self.write("grey.png", png(6, 5, 0, bits, [p[0] for p in pixels]))
            same = self.expect(0, "same.png")
            self.assertIn("read as grey", same.stderr)
            self.assertEqual(same.stdout, self.expect(0, "grey.png").stdout)

    def test_palette(self):
        rng = random.Random(4)
        colours = [[rng.randrange(256) for _ in range(3)] for _ in range(5)]
        places = [rng.randrange(5) for _ in range(30)]
        self.write("p.png", png(6, 5, 3, 8, places, bytes(flat(colours))))
        self.refused(65, ["--channel grey"], "p.png")
        self.write("i.npy", files.array((5, 6), [colours[k][1] for k in places]))
        self.assertEqual(self.expect(0, "p.png", "--channel", "green").stdout,
                         self.expect(0, "i.npy").stdout)

    def test_what_is_no_png(self):
        for name, content, words in (
                ("x.jpg", b"\xff\xd8\xff\xe0" + bytes(90), ["JPEG", "convert it to PNG"]),
                ("x.png", b"\xff\xd8\xff\xe0" + bytes(90), ["JPEG", "convert it to PNG"]),
                ("x.tif", b"II*\0" + bytes(90), ["TIFF"]), ("x.tiff", b"MM\0*" + bytes(90), ["TIFF"]),
                ("x.webp", b"RIFF\x10\0\0\0WEBPVP8 " + bytes(40), ["WebP"]),
                ("x.obj", b"# a mesh\nmtllib m.mtl\no cube\nv 0 0 1\nv 1 0 0\nf 1 2 1\n",
                 ["OBJ mesh", "OFF or PLY"]),
                ("x.stl", b"solid a\nfacet normal 0 0 1\nouter loop\n", ["STL mesh", "OFF or PLY"]),
                ("y.stl", bytes(80) + b"\2\0\0\0" + bytes(100), ["STL mesh", "OFF or PLY"]),
                ("x.h5", b"\x89HDF\r\n\x1a\n" + bytes(90), ["HDF5", ".npy"])):
            self.write(name, content)
            self.refused(65, [name, *words], name)
        self.refused(64, ["--channel", "PNG"], "square.txt", "--channel", "red")


if __name__ == "__main__":
    program.main()
