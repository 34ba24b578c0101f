# SPDX-License-Identifier: MIT
"""ph-cluster: points and distances of all formats give the same labels; what is missing, infinite or
something else is handled as the messages say."""
import gzip
import math
import os
import random
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, files, main  # noqa: E402


def blobs(seed=1, size=40):
    rng = random.Random(seed)
    return [(rng.gauss(9 * (k % 3), .5), rng.gauss(k % 3, .5), 1 + rng.random()) for k in range(size)]


def text(table):
    return "".join(" ".join(map(repr, row)) + "\n" for row in table)


def labels_of(output):
    return [int(line) for line in output.splitlines()[1:]]


class InputsTest(ProgramTest):
    def labels(self, *arguments, **options):
        return labels_of(self.expect(0, *arguments, "--quiet", **options).stdout)

    def test_formats_of_points(self):
        points = blobs()
        n = len(points)
        header = f"VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\n" \
                 f"WIDTH {n}\nHEIGHT 1\nPOINTS {n}\nDATA ascii\n"
        ply = f"ply\nformat ascii 1.0\nelement vertex {n}\nproperty double x\n" \
              "property double y\nproperty double z\nend_header\n"
        self.write("p.txt", text(points))
        expected = self.labels("p.txt")
        self.assertEqual(set(expected), {0, 1, 2})
        self.write("p.csv", "x,y,z\n" + text(points).replace(" ", ","))
        self.write("p.txt.gz", gzip.compress(text(points).encode()))
        self.write("p.pcd", header + text(points))
        self.write("p.ply", ply + text(points))
        self.write("p.off", f"OFF\n{n} 0 0\n" + text(points))
        self.write("p.npy", files.array((n, 3), [x for p in points for x in p]))
        self.write("p.bin", b"".join(struct.pack(">3d", *p) for p in points))
        for arguments in (["p.csv"], ["p.txt.gz"], ["p.pcd"], ["p.ply"], ["p.off"], ["p.npy"],
                          ["p.bin", "--raw-points", "3", "--raw-type", "float64", "--raw-big-endian"]):
            self.assertEqual(self.labels(*arguments), expected, arguments)
        self.assertEqual(self.labels("-", input=text(points)), expected)
        self.assertEqual(self.labels("p.csv", "--columns", "x,y"), self.labels("p.txt", "--columns", "1-2"))

    def test_formats_of_distances(self):
        points = blobs()
        n = len(points)
        distances = [[math.dist(p, q) for q in points] for p in points]
        self.write("p.txt", text(points))
        self.write("m.txt", text(distances))
        self.write("l.txt", text(row[:i] for i, row in enumerate(distances) if i))
        self.write("u.txt", text(row[i + 1:] for i, row in enumerate(distances) if i + 1 < n))
        self.write("s.txt", text((i, j, distances[i][j]) for i in range(n) for j in range(i)))
        self.write("m.npy", files.array((n, n), [d for row in distances for d in row]))
        for more in ([], ["--neighbours", "0"], ["--min-size", "3", "--method", "leaf"]):
            expected = self.labels("p.txt", *more)
            for arguments in (["m.txt"], ["m.txt", "--format", "distance"], ["l.txt", "--format", "lower-distance"],
                              ["u.txt", "--format", "upper-distance"], ["s.txt", "--format", "sparse"], ["m.npy"]):
                self.assertEqual(self.labels(*arguments, *more), expected, (arguments, more))

    def test_the_order_of_points_does_not_matter(self):
        points = [(round(x, 1), round(y, 1)) for x, y, _ in blobs(2, 90)]
        order = list(range(len(points)))
        random.Random(3).shuffle(order)
        self.write("p.txt", text(points))
        self.write("q.txt", text(points[k] for k in order))
        for more in ([], ["--method", "leaf", "--min-size", "3"]):
            first, second = self.labels("p.txt", *more), self.labels("q.txt", *more)
            pairs = {(first[k], second[place]) for place, k in enumerate(order)}
            self.assertEqual(len(pairs), len(set(first)))
            self.assertEqual([b for a, b in pairs if a == -1], [-1] * (-1 in first))

    def test_missing_values(self):
        points = blobs()
        for k in (0, 17):
            points[k] = (math.nan, 0, 1)
        kept = [p for k, p in enumerate(points) if k not in (0, 17)]
        self.write("p.txt", text(points))
        self.write("kept.txt", text(kept))
        run = self.expect(65, "p.txt")
        self.assertIn("--nan drop accepts missing values", run.stderr)
        expected = self.labels("kept.txt")
        for k in (0, 17):
            expected.insert(k, -3)
        self.assertEqual(self.labels("p.txt", "--nan", "drop"), expected)
        rows = self.expect(0, "p.txt", "--nan", "drop", "--scores", "--quiet").stdout.splitlines()
        self.assertEqual((rows[0], rows[1]), ("label,probability,outlier_score", "-3,nan,nan"))
        # A cloud may have holes.
        self.write("p.xyz", text(points))
        self.assertEqual(self.labels("p.xyz"), expected)
        self.assertIn("found 2 points with NaN", self.expect(65, "p.xyz", "--nan", "error").stderr)

    def test_points_without_neighbours(self):
        rows = [(i, j, 1 + (i + j) / 100) for group in (range(5), range(5, 10)) for i in group for j in group if j < i]
        rows.append((10, 9, 3))
        self.write("s.txt", text(rows))
        arguments = ["s.txt", "--format", "sparse", "--min-size", "3", "--scores", "--quiet"]
        run = self.expect(0, *arguments)
        found = [line.split(",") for line in run.stdout.splitlines()[1:]]
        self.assertEqual([int(row[0]) for row in found], [0] * 5 + [1] * 5 + [-1])
        self.assertEqual(found[10][1:], ["0", "1"])  # it is never joined
        # With one neighbour, the last point has a core distance.
        one = self.labels("s.txt", "--format", "sparse", "--min-size", "3", "--neighbours", "1")
        self.assertEqual(one, [0] * 5 + [1] * 6)
        matrix = [[math.inf] * 11 for _ in range(11)]
        for i, j, d in rows:
            matrix[i][j] = matrix[j][i] = d
        for i in range(11):
            matrix[i][i] = 0
        self.write("m.txt", text(matrix))
        self.assertEqual(self.expect(0, "m.txt", "--format", "distance", *arguments[3:]).stdout, run.stdout)

    def test_births_on_the_diagonal(self):
        points = [p[:2] for p in blobs()]
        distances = [[math.dist(p, q) for q in points] for p in points]
        with_births = [[d if i != j else sorted(row)[4] for j, d in enumerate(row)] for i, row in enumerate(distances)]
        self.write("m.txt", text(with_births))
        self.write("p.txt", text(points))
        self.assertEqual(self.labels("m.txt", "--diagonal", "births"), self.labels("p.txt", "--neighbours", "4"))
        self.assertEqual(self.labels("m.txt", "--diagonal", "zero"), self.labels("p.txt"))
        self.expect(65, "m.txt", "--format", "distance")
        run = self.expect(64, "m.txt", "--diagonal", "births", "--neighbours", "4")
        self.assertIn("--neighbours: cannot be combined with --diagonal births", run.stderr)

    def test_few_points(self):
        self.write("two.txt", "0 0\n1 0\n")
        for arguments, expected in (([], [-1, -1]), (["--min-size", "2"], [-1, -1]),
                                    (["--min-size", "2", "--allow-single"], [0, 0]), (["--neighbours", "1"], [-1, -1])):
            self.assertEqual(self.labels("two.txt", *arguments), expected, arguments)
        self.assertIn("--neighbours 1 instead of 4, because there are only 2 points", self.expect(0, "two.txt").stderr)
        self.assertIn("expected at most the number of other points, 1",
                      self.expect(64, "two.txt", "--neighbours", "2").stderr)
        self.write("one.txt", "5\n")
        self.assertEqual(self.labels("one.txt", "--format", "points"), [-1])
        self.write("none.txt", "# nothing\n")
        self.expect(65, "none.txt")
        for more in ([], ["--scores"], ["--neighbours", "3"]):
            self.assertEqual(self.expect(0, "none.txt", "--allow-empty", "--quiet", *more).stdout.count("\n"), 1)

    def test_something_else(self):
        self.write("bars.csv", "dim,birth,death\n0,0,1\n0,0,inf\n")
        self.assertIn("found a barcode, expected points or distances", self.expect(65, "bars.csv").stderr)
        self.assertEqual(self.labels("bars.csv", "--columns", "birth"), [-1, -1])
        self.write("i.pgm", "P2\n2 1\n9\n1 2\n")
        self.assertIn("found image of 1 x 2 voxels, PGM, expected points or distances", self.expect(65, "i.pgm").stderr)
        self.write("s.simplices", "0 : 0\n1 : 0\n0 1 : 1\n")
        self.assertIn("expected points or distances", self.expect(65, "s.simplices").stderr)
        for name, content in (("a.txt", "1 2\n3\n"), ("b.txt", "1 x\n2 3\n"), ("c.txt", "1 inf\n2 3\n"),
                              ("d.pcd", "VERSION 0.7\n")):
            self.write(name, content)
            self.assertIn(name, self.expect(65, name).stderr)
        self.assertIn("missing.txt", self.expect(66, "missing.txt").stderr)
        self.expect(66, ".")
        self.write("zero.txt", "0 0\n1 1\n2 1\n")
        self.assertIn("zero.txt", self.expect(65, "zero.txt", "--metric", "cosine").stderr)


if __name__ == "__main__":
    main()
