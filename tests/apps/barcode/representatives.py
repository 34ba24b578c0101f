# SPDX-License-Identifier: MIT
"""--representatives: checks each representative against the definition of a cycle or cocycle. Some
representatives are determined by the definition, up to a factor and the order of cells. These
representatives are also compared with stored files.

representatives.py PROGRAM --update rewrites these files.

"""
import itertools
import json
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import oracle  # noqa: E402
from program import SQUARE, ProgramTest, files, main  # noqa: E402

UPDATE = "--update" in sys.argv
if UPDATE:
    sys.argv.remove("--update")
GOLDEN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "representatives")

TORUS = [tuple(sorted((v + a) % 7 for a in triangle)) for v in range(7)
         for triangle in ((0, 1, 3), (0, 2, 3))]
MATRIX = "0\n0\n0\n1 0 1\n1 1 2\n1 0 2\n2 3 4 5\n"  # a triangle, in PHAT's text format


def cells_of(filtration):
    """The value and boundary of each cell."""
    return {cell: (value, dict(boundary)) for cell, (value, _, boundary) in filtration.items()}


def torus():
    """The cells of a torus: vertices at value 0, edges at 1, triangles at 2."""
    simplices = {face for t in TORUS for k in (1, 2, 3) for face in itertools.combinations(t, k)}
    return cells_of(oracle.simplicial({s: len(s) - 1 for s in sorted(simplices)}))


def rips(text):
    points = [tuple(map(float, line.split())) for line in text.splitlines()]
    return cells_of(oracle.flag_filtration([0.0] * len(points), lambda i, j: math.dist(points[i], points[j]), 1))


def image(rows):
    """The cells of an image in the V-construction, named by doubled coordinates."""
    voxels = {(x, y): value for x, row in enumerate(rows) for y, value in enumerate(row)}
    return cells_of(oracle.cubical_filtration((len(rows), len(rows[0])), voxels))


def matrix():
    lines = [list(map(int, line.split()))[1:] for line in MATRIX.splitlines()]
    return {(i,): (i, {(row,): 1 for row in facets}) for i, facets in enumerate(lines)}


def name(cell):
    """A cell of the JSON file as a tuple."""
    return (cell["row"],) if "row" in cell else tuple(cell.get("vertices") or cell["grid"])


class Representatives(ProgramTest):
    def bars(self, *arguments):
        text = self.expect(0, *arguments, "--output-format", "json", "--quiet").stdout
        result = json.loads(text)
        self.assertEqual(result["representatives"], arguments[arguments.index("--representatives")
                                                              + 1])
        return result["bars"]

    def check_cycle(self, bar, chain, cells, field):
        boundary = {}
        for cell, a in chain.items():
            self.assertLessEqual(cells[cell][0], bar["birth"])
            for facet, b in cells[cell][1].items():
                boundary[facet] = (boundary.get(facet, 0) + a * b) % field
        self.assertFalse(any(boundary.values()), f"{bar}: not closed")

    def check_cocycle(self, bar, chain, cells, field):
        self.assertTrue(all(cells[cell][0] >= bar["birth"] for cell in chain))
        for value, boundary in cells.values():
            sum_ = sum(b * chain.get(facet, 0) for facet, b in boundary.items()) % field
            if bar["death"] is None or value < bar["death"]:
                self.assertEqual(sum_, 0, f"{bar}: coboundary not zero")
        if bar["death"] is not None:
            killer = cells[name(bar["death_cell"])][1]
            self.assertNotEqual(sum(b * chain.get(f, 0) for f, b in killer.items()) % field, 0)

    def check(self, case, cells, field, *arguments, forced=(("cycles", 1),)):
        """@param forced the kinds and dimensions of representatives that the definition
        determines."""
        for kind, check in (("cycles", self.check_cycle), ("cocycles", self.check_cocycle)):
            with self.subTest(case=case, kind=kind):
                bars = self.bars(*arguments, "--field", str(field), "--representatives", kind)
                for bar in bars:
                    terms = bar["representative"]
                    chain = {name(term): term["coefficient"] for term in terms}
                    self.assertEqual(len(chain), len(terms), "a cell occurs twice")
                    self.assertIn(name(bar["birth_cell"]), chain)
                    for a in chain.values():
                        self.assertTrue(a != 0 and abs(a) <= field / 2, bar)
                    check(bar, chain, cells, field)
                for forced_kind, dim in forced:
                    if forced_kind == kind:
                        self.compare(f"{case}_{kind}.json", [self.normal(bar, field) for bar in bars
                                                             if bar["dim"] == dim])

    def test_voxels(self):
        rows = [[9, 9, 9, 9, 9, 9], [9, 1, 1, 1, 9, 3], [9, 1, 7, 1, 9, 3], [9, 1, 1, 1, 9, 9]]
        text = "P2\n6 4\n9\n" + "\n".join(" ".join(map(str, row)) for row in rows) + "\n"
        bars = self.bars(self.write("pit.pgm", text), "--representatives", "voxels")
        found = {(bar["dim"], bar["birth"], bar["death"]): bar for bar in bars}
        self.assertEqual(found[0, 1, None]["voxels"], [[0, 24]])
        self.assertEqual(found[0, 3, 9]["voxels"], [[11, 1], [17, 1]])
        self.assertEqual(found[0, 3, 9]["birth_voxel"], [1, 5])
        self.assertEqual(found[1, 1, 7]["voxels"], [[14, 1]])
        self.assertEqual(found[1, 1, 7]["death_voxel"], [2, 2])
        # A bar of H1 has a cycle instead of a set of voxels.
        volume = files.array((3, 3, 3), [1.0 if (y, x) != (1, 1) else 2.0 for z in range(3)
                                 for y in range(3) for x in range(3)])
        for construction in ("vertices", "cells"):
            bars = self.bars(self.write("pipe.npy", volume), "--representatives", "voxels",
                             "--construction", construction, "--periodic", "0")
            for bar in bars:
                self.assertNotEqual("voxels" in bar, "representative" in bar)
                self.assertEqual("voxels" in bar, bar["dim"] in (0, 2))
            self.assertEqual({bar["dim"] for bar in bars}, {0, 1, 2})

    def test_voxels_of_points_with_holes(self):
        """Cells of a grid have no point numbers, even if rows of the table are left out."""
        ring = ["0,0", "nan,1", "2,0", "4,0", "4,2", "4,4", ",7", "2,4", "0,4", "0,2", "9,9"]
        whole = [line for line in ring if line not in ("nan,1", ",7")]
        self.write("holes.csv", "\n".join(ring) + "\n")
        self.write("whole.csv", "\n".join(whole) + "\n")
        for kind in ("cycles", "cocycles", "voxels"):
            options = ["--nan", "drop", "--complex", "cubical", "--voxel", "0.5", "--representatives",
                       kind]
            bars = self.bars("whole.csv", *options)
            self.assertEqual(self.bars("holes.csv", *options), bars, kind)
            self.assertGreater(len(bars), 2)
        rips = ["--nan", "drop", "--representatives", "cycles"]
        names = [i for i, line in enumerate(ring) if line in whole]
        for a, b in zip(self.bars("holes.csv", *rips), self.bars("whole.csv", *rips)):
            self.assertEqual(name(a["birth_cell"]), tuple(names[v] for v in name(b["birth_cell"])))

    def normal(self, bar, field):
        """The bar with its terms sorted and scaled such that the birth cell has coefficient 1."""
        chain = {name(term): (term, term["coefficient"]) for term in bar["representative"]}
        scale = pow(chain[name(bar["birth_cell"])][1], -1, field)
        terms = []
        for _, (term, a) in sorted(chain.items()):
            a = a * scale % field
            terms.append({**term, "coefficient": a - field if a > field / 2 else a})
        # The test loops.py checks the loops.
        bar = {key: value for key, value in bar.items() if key != "loops"}
        return {**bar, "representative": terms}

    def compare(self, file, bars):
        path = os.path.join(GOLDEN, file)
        if UPDATE:
            os.makedirs(GOLDEN, exist_ok=True)
            with open(path, "w") as out:
                out.write("[\n" + ",\n".join(json.dumps(bar) for bar in bars) + "\n]\n")
        with open(path) as want:
            self.assertEqual(bars, json.load(want))

    def test_square(self):
        self.check("square", rips(SQUARE), 2, "square.txt")

    def test_copies_of_points(self):
        self.write("copies.txt", SQUARE * 2)
        for field in (2, 3):
            self.check("copies", rips(SQUARE * 2), field, "copies.txt", forced=())

    def test_torus(self):
        self.write("torus.txt", "".join(f"{' '.join(map(str, s))} : {v}\n"
                                        for s, (v, _) in torus().items()))
        for field in (2, 3):
            self.check(f"torus_z{field}", torus(), field, "torus.txt", "--format", "simplices",
                       forced=[("cycles", 2)])

    def test_ring(self):
        rows = [[0, 1, 2], [1, 9, 3], [2, 3, 4]]
        self.write("ring.npy", files.array((3, 3), sum(rows, [])))
        for field in (2, 3):
            self.check(f"ring_z{field}", image(rows), field, "ring.npy")

    def test_boundary_matrix(self):
        self.write("triangle.phat", MATRIX)
        self.check("matrix", matrix(), 2, "triangle.phat", "--format", "phat",
                   forced=[("cycles", 1), ("cocycles", 1)])

    def test_engines(self):
        for engine in ("twist", "cohomology"):
            bars = self.bars("square.txt", "--engine", engine, "--representatives", "cycles")
            loop = {name(term) for term in bars[-1]["representative"]}
            self.assertEqual(loop, {(0, 1), (1, 2), (2, 3), (0, 3)})

    def test_verbose_names_the_engine(self):
        run = self.expect(0, "square.txt", "--verbose", "--representatives", "cycles",
                          "--output-format", "json")
        self.assertIn("engine edge-links: ", run.stderr)

    def test_check_compares_the_bars(self):
        run = self.expect(0, "square.txt", "--representatives", "cycles", "--check", "--verbose",
                          "-o", "out.json")
        self.assertIn("the reference engine agrees", run.stderr)
        self.assertEqual(len(json.loads(self.read("out.json"))["bars"][4]["representative"]), 4)

    def test_threshold_cuts_cocycles(self):
        # The threshold cuts off both triangles of a strip, and also the vertex and the edges that
        # only the second triangle has.
        self.write("strip.txt", "0 : 0\n1 : 0\n2 : 0\n3 : 5\n0 1 : 1\n1 2 : 1\n0 2 : 2\n"
                   "1 3 : 5\n2 3 : 5\n0 1 2 : 6\n1 2 3 : 5\n")
        bars = self.bars("strip.txt", "--format", "simplices", "--threshold", "4",
                         "--representatives", "cocycles")
        self.assertEqual([bar["death"] for bar in bars], [1, 1, None, None])
        for bar in bars:
            for term in bar["representative"]:
                self.assertNotIn(3, term["vertices"])
        self.assertEqual(len(bars[2]["representative"]), 3)

    def test_points_left_out_keep_their_numbers(self):
        self.write("holes.txt", "nan 0\n" + SQUARE)
        loop = self.bars("holes.txt", "--nan", "drop", "--representatives", "cycles")[-1]
        self.assertEqual({v for term in loop["representative"] for v in term["vertices"]},
                         {1, 2, 3, 4})

    def test_none_is_the_default(self):
        result = json.loads(self.expect(0, "square.txt", "--output-format", "json").stdout)
        self.assertNotIn("representatives", result)
        self.assertNotIn("representative", result["bars"][0])

    def test_batch(self):
        self.expect(64, "square.txt", "-o", "out/", "--representatives", "cocycles")
        self.expect(0, "square.txt", "-o", "out/", "--representatives", "cycles",
                    "--output-format", "json")
        self.assertIn("representative", self.read("out/square.json"))


if __name__ == "__main__":
    main()
