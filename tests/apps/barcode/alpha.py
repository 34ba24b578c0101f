# SPDX-License-Identifier: MIT
"""--complex alpha: compares bars with known values and with GUDHI. Also tests weights, hidden
points, surface files, refused inputs, and the message of a build without CGAL."""
import json
import math
import os
import random
import struct
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import program  # noqa: E402
from program import ProgramTest, main  # noqa: E402

try:
    import gudhi
except ImportError:
    gudhi = None

UNIT_SQUARE = "0 0\n1 0\n1 1\n0 1\n"


def version():
    return subprocess.run([program.PROGRAM, "--version", "--verbose"], check=True, text=True,
                          stdout=subprocess.PIPE).stdout


def rows(csv):
    return [tuple(float(x) for x in line.split(",")) for line in csv.splitlines()[1:]]


def sphere(count, seed=1):
    """Random points near a sphere, in general position."""
    rng = random.Random(seed)
    found = []
    for _ in range(count):
        x = [rng.gauss(0, 1) for _ in range(3)]
        length = math.sqrt(sum(c * c for c in x)) * rng.uniform(0.99, 1.01)
        found.append([c / length for c in x])
    return found


def text(table):
    return "".join(" ".join(map(repr, row)) + "\n" for row in table)


def read_ply(data):
    """@return the coordinates of the vertices, the number of the input point at each vertex, the
    triangles, and the marks of the triangles."""
    end = data.index(b"end_header\n") + len(b"end_header\n")
    lines = data[:end].decode().splitlines()
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"], lines
    vertices, faces = (int(line.split()[2]) for line in lines if line.startswith("element"))
    at = [struct.unpack_from("<dddI", data, end + 28 * i) for i in range(vertices)]
    start = end + 28 * vertices
    corners = [struct.unpack_from("<BiiiB", data, start + 14 * i) for i in range(faces)]
    assert len(data) == start + 14 * faces and all(c[0] == 3 for c in corners)
    return ([v[:3] for v in at], [v[3] for v in at], [c[1:4] for c in corners], [c[4] for c in corners])


def read_off(content):
    numbers = content.split()
    assert numbers[0] == "OFF"
    vertices, faces = int(numbers[1]), int(numbers[2])
    at = [tuple(map(float, numbers[4 + 3 * i:7 + 3 * i])) for i in range(vertices)]
    start = 4 + 3 * vertices
    return at, [tuple(map(int, numbers[start + 4 * i + 1:start + 4 * i + 4])) for i in range(faces)]


def volume(at, triangles):
    """The volume inside a closed surface whose triangles are counterclockwise from outside."""
    total = 0
    for a, b, c in triangles:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = at[a], at[b], at[c]
        total += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return total / 6


class WithoutCgal(ProgramTest):
    def test_version_names_the_licence(self):
        built_in = "alpha complexes need" not in version()
        self.assertIn("licence", version())
        self.assertEqual("GPL" in version(), built_in)

    def test_it_is_refused(self):
        if "alpha complexes need it" not in version():
            self.skipTest("CGAL is built in")
        for kind in ("alpha", "delaunay-cech", "delaunay-rips"):
            done = self.expect(69, "square.txt", "--complex", kind)
            self.assertIn(f"--complex {kind}: not built in", done.stderr)


class Alpha(ProgramTest):
    def setUp(self):
        super().setUp()
        if "alpha complexes need it" in version():
            self.skipTest("CGAL is not built in")
        self.write("unit.txt", UNIT_SQUARE)

    def bars(self, *arguments, **options):
        return rows(self.expect(0, *arguments, "--quiet", **options).stdout)

    def test_lengths_that_are_known(self):
        half = math.sqrt(0.5)
        components = [(0, 0, 0.5)] * 3 + [(0, 0, math.inf)]
        self.assertEqual(self.bars("unit.txt", "--complex", "alpha"), [*components, (1, 0.5, half)])
        squared = self.bars("unit.txt", "--complex", "alpha", "--alpha-values", "squared")
        self.assertEqual(squared, [(0, 0, 0.25)] * 3 + [(0, 0, math.inf), (1, 0.25, 0.5)])
        for kind in ("delaunay-cech", "delaunay-rips"):
            self.assertEqual(self.bars("unit.txt", "--complex", kind)[-1], (1, 0.5, half))
        # In an equilateral triangle of side 2, the radius of the circumcircle exceeds half a side.
        self.write("triangle.txt", f"0 0\n2 0\n1 {math.sqrt(3)!r}\n")
        found = self.bars("triangle.txt", "--complex", "alpha")[-1]
        self.assertAlmostEqual(found[2], 2 / math.sqrt(3), places=15)
        # In the Delaunay-Rips complex, the balls of every two corners meet at radius 1, up to
        # rounding of the side lengths in the last digit.
        self.assertFalse([bar for bar in self.bars("triangle.txt", "--complex", "delaunay-rips")
                          if bar[0] == 1 and bar[2] - bar[1] > 1e-15])
        # --threshold cuts off later deaths. --max-dim leaves out bars of higher dimensions.
        self.assertEqual(self.bars("unit.txt", "--complex", "alpha", "--threshold", "0.6")[-1],
                         (1, 0.5, math.inf))
        self.assertEqual(self.bars("unit.txt", "--complex", "alpha", "--max-dim", "0"), components)

    def test_against_gudhi(self):
        if gudhi is None:
            self.skipTest("no python3-gudhi")
        rng = random.Random(3)
        for dims in (2, 3):
            points = [[rng.random() for _ in range(dims)] for _ in range(80)]
            weights = [rng.uniform(-0.01, 0.01) for _ in points]
            self.write("cloud.txt", text(points))
            self.write("weights.txt", text([[w] for w in weights]))
            for given, how in ((None, []), (weights, ["--weights", "weights.txt"])):
                tree = gudhi.AlphaComplex(points=points, weights=given,
                                          precision="exact").create_simplex_tree()
                tree.compute_persistence(persistence_dim_max=True)
                expected = sorted((d, *bar) for d in range(dims) for bar in
                                  tree.persistence_intervals_in_dimension(d) if bar[0] < bar[1])
                found = sorted(self.bars("cloud.txt", "--complex", "alpha", "--alpha-values", "squared",
                                         *how, "--check"))
                self.assertEqual(len(found), len(expected))
                for a, b in zip(found, expected):
                    self.assertEqual(a[0], b[0])
                    for x, y in zip(a[1:], b[1:]):
                        self.assertTrue(math.isclose(x, y, rel_tol=1e-11, abs_tol=1e-15), (a, b))

    def test_weights(self):
        self.write("two.txt", "0 0 0\n3 0 0\n0.5 0 0\n")
        self.write("weights.txt", "1\n4\n-9\n")
        done = self.expect(0, "two.txt", "--complex", "alpha", "--weights", "weights.txt")
        # The balls of radius 1 and 2 touch. The centre of the third ball lies between their
        # centres, and the third ball always stays inside the first ball.
        self.assertEqual(rows(done.stdout), [(0, -4, math.inf), (0, -1, 0)])
        self.assertIn("1 point not in the complex, hidden by points", done.stderr)
        self.assertIn("with larger weights: 2", done.stderr)
        self.expect(0, "two.txt", "--complex", "alpha", "--weights", "weights.txt", "-o", "bars.json")
        document = json.loads(self.read("bars.json"))
        self.assertEqual((document["complex"], document["vertex_weights"], document["alpha"]),
                         ("alpha", "squared radii of balls, from a file", {"squared": True, "hidden": [2]}))
        # When the program rewrites the bars, it keeps the properties of the complex.
        self.expect(0, "bars.json", "-o", "again.json", "--quiet")
        self.assertEqual(json.loads(self.read("again.json"))["alpha"], document["alpha"])

    def test_period(self):
        self.write("one.txt", "0.5 0.25 0\n")
        one = ["one.txt", "--complex", "alpha", "--alpha-values", "squared"]
        # A point on three periodic axes stands for a cubic lattice. Per point, the lattice has
        # three edges, three squares and one cube.
        self.assertEqual(self.bars(*one, "--period", "2"),
                         [(0, 0, math.inf), *[(1, 1, math.inf)] * 3, *[(2, 2, math.inf)] * 3, (3, 3, math.inf)])
        self.assertEqual(self.bars(*one, "--period", "2,0,4"),
                         [(0, 0, math.inf), (1, 1, math.inf), (1, 4, math.inf), (2, 5, math.inf)])
        self.expect(0, *one, "--period", "2,0,4", "-o", "bars.json", "--quiet")
        self.assertEqual(json.loads(self.read("bars.json"))["alpha"], {"squared": True, "period": [2, 0, 4]})
        self.assertEqual(self.bars(*one, "--period", "2", "--check", "--field", "3"),
                         self.bars(*one, "--period", "2"))
        for arguments, words in ((["--period", "1,2"], "found 2 numbers for 3 axes"),
                                 (["--period", "-1"], "--period: found '-1'"),
                                 (["--period", "2", "--wrap", "1=x.ply"], "--wrap: cannot be combined with --period"),
                                 (["--period", "2", "--plot", "x.svg", "--plot-kind", "tree"], "no merge tree")):
            self.assertIn(words, self.expect(64, *one, *arguments).stderr)
        self.assertIn("expected --complex alpha", self.expect(64, "one.txt", "--complex", "delaunay-rips", "--period",
                                                    "2").stderr)

    def test_points_that_were_left_out_keep_numbers(self):
        self.write("gap.txt", "nan 0\n" + UNIT_SQUARE)
        self.write("weights.txt", "7\n0\n0\n0\n0\n")
        for how in ([], ["--weights", "weights.txt"]):
            self.expect(0, "gap.txt", "--nan", "drop", "--complex", "alpha", "--alpha-values", "squared", *how, "-o",
                        "bars.json", "--representatives", "cycles", "--loops", "plain", "--quiet",
                        "--alpha-shape", "1=shape.ply")
            _, numbers, triangles, _ = read_ply(self.read_bytes("shape.ply"))
            self.assertEqual((numbers, len(triangles)), ([1, 2, 3, 4], 2))
            loop = json.loads(self.read("bars.json"))["bars"][-1]
            self.assertEqual((loop["birth"], loop["death"]), (0.25, 0.5))
            self.assertEqual(sorted(sorted(term["vertices"]) for term in loop["representative"]),
                             [[1, 2], [1, 4], [2, 3], [3, 4]])

    def test_fields_and_engines_agree(self):
        self.write("cloud.txt", text(sphere(60)))
        expected = self.bars("cloud.txt", "--complex", "alpha")
        for how in (["--engine", "standard"], ["--engine", "cohomology", "--field", "3"],
                    ["--field", "5"], ["--threads", "2", "--check"]):
            self.assertEqual(self.bars("cloud.txt", "--complex", "alpha", *how), expected)

    def test_surfaces(self):
        points = sphere(200)
        self.write("cloud.txt", text(points))
        self.expect(0, "cloud.txt", "--complex", "alpha", "--quiet", "-o", "bars.csv",
                    "--alpha-shape", "2=shape.ply", "--alpha-shape", "10=hull.off",
                    "--wrap", "10=wrap.ply", "--alpha-shape", "1e-9=none.ply")
        at, numbers, triangles, marks = read_ply(self.read_bytes("shape.ply"))
        self.assertEqual(set(marks), {0})
        for place, point in zip(at, numbers):
            self.assertEqual(list(place), points[point])
        self.assertEqual(sorted(numbers), numbers)
        directed = [edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a))]
        self.assertEqual(len(set(directed)), len(directed))
        self.assertEqual({(b, a) for a, b in directed}, set(directed))  # the surface is closed
        at, triangles = read_off(self.read("hull.off"))
        self.assertEqual(len(at) - len(triangles) / 2, 2)  # Euler's formula with 3 F = 2 E
        self.assertTrue(3.8 < volume(at, triangles) < 4.19)
        at, _, triangles, marks = read_ply(self.read_bytes("wrap.ply"))
        self.assertTrue(0 < volume(at, [t for t, m in zip(triangles, marks) if not m]) < 4.19)
        self.assertEqual(read_ply(self.read_bytes("none.ply")), ([], [], [], []))
        # A surface written by the program can be read like any other mesh.
        self.assertEqual(self.bars("hull.off", "--complex", "alpha", "--max-dim", "0")[-1][2], math.inf)

    def test_surfaces_of_a_batch(self):
        os.mkdir(self.path("in"))
        for k in range(2):
            self.write(f"in/{k}.txt", text(sphere(20 + k, k)))
        self.expect(0, "in", "-o", "out/", "--complex", "alpha", "--alpha-shape", "5=shapes/")
        self.assertEqual(sorted(os.listdir(self.path("shapes"))), ["0.ply", "1.ply"])
        self.expect(0, "in", "--output-format", "none", "--complex", "alpha", "--wrap", "5=wraps/*.off")
        self.assertEqual(sorted(os.listdir(self.path("wraps"))), ["0.off", "1.off"])
        self.assertIn("--alpha-shape", self.expect(64, "in", "-o", "out/", "--complex", "alpha",
                                                   "--alpha-shape", "5=one.ply").stderr)

    def test_refused(self):
        self.write("r4.txt", "0 0 0 0\n1 0 0 1\n")
        self.write("weights.txt", "0\n1\n2\n3\n")
        self.write("few.txt", "0\n1\n")
        self.write("endless.txt", "0\n1\n2\ninf\n")
        alpha = ["unit.txt", "--complex", "alpha"]
        for code, arguments, words in (
                (64, ["r4.txt", "--complex", "alpha"], "found points of R^4, expected R^1 to R^3"),
                (64, [*alpha, "--metric", "manhattan"], "--metric: makes sense for"),
                (64, [*alpha, "--subsample", "3"], "--subsample: makes sense for"),
                (64, [*alpha, "--weights", "weights.txt", "--alpha-values", "radius"], "expected squared"),
                (64, ["unit.txt", "--complex", "delaunay-cech", "--weights", "weights.txt"], "expected --complex alpha"),
                (64, ["unit.txt", "--complex", "delaunay-rips", "--wrap", "1=x.ply"], "expected --complex alpha"),
                (64, ["unit.txt", "--complex", "delaunay-rips", "--significance"], "known only for these"),
                (64, [*alpha, "--weights", "weights.txt", "--significance"], "vertices with weights"),
                (65, [*alpha, "--weights", "few.txt"], "few.txt"),
                (65, [*alpha, "--weights", "endless.txt"], "expected a finite number"),
                (66, [*alpha, "--weights", "missing.txt"], "missing.txt"),
                (64, [*alpha, "--threshold", "-1"], "expected a radius or its square, at least 0"),
                (64, [*alpha, "--alpha-shape", "x.ply"], "expected R=FILE.ply"),
                (64, [*alpha, "--alpha-shape", "1=x.stl"], "expected R=FILE.ply"),
                (64, [*alpha, "--wrap", "far=x.ply"], "--wrap"),
                (64, [*alpha, "--threshold", "0.5", "--wrap", "0.6=x.ply"],
                 "--wrap: found 0.6, expected at most --threshold (0.5)"),
                (64, [*alpha, "--loops", "tight", "--representatives", "cycles", "--output-format",
                      "json"], "--loops plain"),
                (64, ["unit.txt", "--wrap", "1=x.ply"], "--wrap: makes sense for points with --complex alpha")):
            self.assertIn(words, self.expect(code, *arguments).stderr)
        self.assertFalse([name for name in self.files() if name.startswith("x.")])

    def test_significance(self):
        rng = random.Random(2)
        circle = [[math.cos(t) + rng.gauss(0, 0.05), math.sin(t) + rng.gauss(0, 0.05)]
                  for t in (rng.uniform(0, 2 * math.pi) for _ in range(150))]
        self.write("circle.txt", text(circle))
        self.expect(0, "circle.txt", "--complex", "alpha", "--significance", "-o", "bars.json", "--quiet")
        bars = [bar for bar in json.loads(self.read("bars.json"))["bars"] if bar["dim"] == 1]
        # Bobrowski and Skraba (2023): their constant A is 1/2 for alpha complexes.
        logs = [math.log(math.log(bar["death"] / bar["birth"])) for bar in bars]
        shift = -0.5772156649015329 - 0.5 * sum(logs) / len(logs)
        for bar, l in zip(bars, logs):
            p = min(1, len(bars) * math.exp(-math.exp(0.5 * l + shift)))
            self.assertAlmostEqual(bar["p"], p, places=9)
        self.assertEqual(sum(bar["p"] < 0.05 for bar in bars), 1)

    def test_report_and_tree(self):
        self.require_page()
        self.write("cloud.txt", text(sphere(100)))
        self.expect(0, "cloud.txt", "--complex", "alpha", "--report", "page.html", "--plot", "tree.svg",
                    "--plot-kind", "tree", "-o", "bars.json", "--representatives", "cycles", "--quiet")
        page = self.read("page.html")
        for part in ("complex/triangles", "complex/edges", "Radius"):
            self.assertIn(part, page)
        self.assertIn("<svg", self.read("tree.svg"))

    def test_dry_run(self):
        self.write("cloud.txt", text(sphere(100)))
        said = self.expect(0, "cloud.txt", "--complex", "alpha", "--dry-run", "--quiet").stdout
        for word in ("complex alpha", "engine gradient", "memory "):
            self.assertIn(word, said.replace("   ", " ").replace("  ", " "))


if __name__ == "__main__":
    main()
