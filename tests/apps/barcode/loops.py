# SPDX-License-Identifier: MIT
"""Tests `loops` in ph-barcode's JSON: vertex names, the user's numbering, and options."""
import json
import math
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, files, main  # noqa: E402


def ring(n, shift=0.0):
    return [(math.cos(2 * math.pi * i / n) + shift, math.sin(2 * math.pi * i / n))
            for i in range(n)]


def text(points):
    return "".join(" ".join(repr(x) for x in point) + "\n" for point in points)


class Loops(ProgramTest):
    def result(self, *arguments):
        run = self.expect(0, *arguments, "--output-format", "json", "--quiet")
        return json.loads(run.stdout)["bars"]

    def loops(self, *arguments):
        bars = self.result(*arguments, "--representatives", "cycles")
        for bar in bars:
            self.assertEqual("loops" in bar, bar["dim"] == 1, bar)
        return [bar for bar in bars if bar["dim"] == 1]

    def test_square(self):
        (bar,) = self.loops("square.txt")
        (loop,) = bar["loops"]
        self.assertAlmostEqual(loop.pop("length"), 1 + 1 + math.dist((1, 1), (0, 1.25)) + 1.25)
        self.assertEqual(loop, {"vertices": [0, 1, 2, 3], "coefficient": 1, "tight": "shortest"})
        # The representative itself does not change.
        self.assertEqual(sorted(tuple(e["vertices"]) for e in bar["representative"]),
                         [(0, 1), (0, 3), (1, 2), (2, 3)])

    def test_each_choice(self):
        (plain,) = self.loops("square.txt", "--loops", "plain")
        self.assertEqual(plain["loops"][0]["tight"], "no")
        self.assertEqual(plain["loops"][0]["vertices"], [0, 1, 2, 3])
        bars = self.result("square.txt", "--representatives", "cycles", "--loops", "none")
        self.assertFalse(any("loops" in bar for bar in bars))
        (tight,) = self.loops("square.txt", "--loops", "tight")
        self.assertEqual(tight, self.loops("square.txt")[0])
        self.assertEqual(tight["representative"], plain["representative"])

    def test_asked_for_in_vain(self):
        for arguments in ([], ["--representatives", "cocycles"]):
            run = self.expect(64, "square.txt", "--loops", "plain", *arguments, "-o", "x.json")
            self.assertIn("--representatives cycles", run.stderr)
        for output in (["-o", "x.csv"], ["--output-format", "none"],
                       ["-o", "x.npy", "--report", "x.html"]):
            with self.subTest(output=output):
                if "--report" in output:
                    self.require_page()
                run = self.expect(64, "square.txt", "--loops", "tight",
                                  "--representatives", "cycles", *output)
                self.assertIn("expected json", run.stderr)
        run = self.expect(64, "square.txt", "--loops", "short", "--representatives", "cycles")
        self.assertIn("tight", run.stderr)
        for dimensions in (["--max-dim", "0"], ["--min-dim", "2", "--max-dim", "2"]):
            run = self.expect(64, "square.txt", "--loops", "plain", "--representatives", "cycles",
                              "-o", "x.json", *dimensions)
            self.assertIn("needs dimension 1", run.stderr)
        asked = ["--representatives", "cycles", "-o", "x.json", "--loops"]
        self.write("hole.npy", files.array((3, 3), [1.0] * 4 + [5.0] + [1.0] * 4))
        run = self.expect(64, "hole.npy", *asked, "tight")
        self.assertIn("expected rips", run.stderr)
        self.expect(0, "hole.npy", *asked, "plain")
        self.write("ring.phat", "0\n0\n0\n1 0 1\n1 1 2\n1 0 2\n")
        for choice in ("tight", "plain"):
            run = self.expect(64, "ring.phat", "--format", "phat", *asked, choice)
            self.assertIn("vertices to walk along", run.stderr)
        self.expect(0, "ring.phat", "--format", "phat", *asked, "none")
        # If loops were not requested, no message mentions them.
        self.expect(0, "square.txt", "--representatives", "cycles", "-o", "x.json")

    def test_numbers_are_those_of_the_input(self):
        lines = text(ring(12)).splitlines()
        lines.insert(3, "nan 0")
        lines.insert(0, "nan nan")
        self.write("gaps.txt", "\n".join(lines) + "\n")
        (bar,) = self.loops("gaps.txt", "--nan", "drop")
        self.assertEqual(bar["loops"][0]["vertices"], [1, 2, 3, 5, 6, 7, 8, 9, 10, 11, 12, 13])
        # In a subsample, each vertex keeps its number among all points.
        points = ring(40)
        self.write("many.txt", text(points))
        (bar,) = self.loops("many.txt", "--subsample", "10")
        (loop,) = bar["loops"]
        self.assertLessEqual(len(loop["vertices"]), 10)
        self.assertEqual(loop["vertices"], sorted(loop["vertices"]))
        walk = loop["vertices"] + loop["vertices"][:1]
        self.assertAlmostEqual(
            loop["length"],
            sum(math.dist(points[a], points[b]) for a, b in zip(walk, walk[1:])))
        # The numbering also counts the rows with NaN, although their points are left out.
        lines = text(points).splitlines()
        self.write("both.txt", "\n".join(["nan nan"] * 5 + lines) + "\n")
        (bar,) = self.loops("both.txt", "--subsample", "10", "--nan", "drop")
        self.assertEqual(bar["loops"][0]["vertices"], [v + 5 for v in loop["vertices"]])
        # Each point occurs twice.
        self.write("twice.txt", text(points + points))
        for bar in self.loops("twice.txt"):
            self.assertLess(max(bar["loops"][0]["vertices"]), 80)

    def test_noise_does_not_lengthen_the_loop(self):
        """In a thick ring, the representative has detours. The loop must nevertheless equal the
        shortest one, which a separate search finds."""
        source = random.Random(3)
        points = [(r * math.cos(a), r * math.sin(a)) for r, a in
                  ((source.uniform(1, 1.6), source.uniform(0, 2 * math.pi)) for _ in range(150))]
        self.write("thick.txt", text(points))
        bars = self.loops("thick.txt")
        bar = max(bars, key=lambda b: b["death"] - b["birth"])
        (loop,) = bar["loops"]
        self.assertEqual(loop["tight"], "shortest")
        u, v = bar["birth_cell"]["vertices"]
        birth = bar["birth"]
        # Bellman-Ford from u to v along edges shorter than the bar's birth. No older bar is alive
        # at that value. Therefore, each path from u to v closes a loop that represents the bar.
        edges = [(math.dist(p, q), i, j) for i, p in enumerate(points)
                 for j, q in enumerate(points[:i]) if math.dist(p, q) < birth]
        distance = {u: 0.0}
        for _ in points:
            for length, i, j in edges:
                for a, b in ((i, j), (j, i)):
                    if distance.get(a, math.inf) + length < distance.get(b, math.inf):
                        distance[b] = distance[a] + length
        self.assertAlmostEqual(loop["length"], distance[v] + birth)
        (plain,) = [b for b in self.loops("thick.txt", "--loops", "plain")
                    if b["birth_cell"] == bar["birth_cell"]]
        self.assertLessEqual(loop["length"], sum(x["length"] for x in plain["loops"]) + 1e-9)

    def test_fields_and_threads(self):
        source = random.Random(5)
        points = [(source.random(), source.random()) for _ in range(120)]
        self.write("cloud.txt", text(points))
        for field in ("2", "3", "5"):
            one = self.loops("cloud.txt", "--field", field, "--threads", "1")
            two = self.loops("cloud.txt", "--field", field, "--threads", "4")
            self.assertEqual(one, two)
            for bar in one:
                for loop in bar["loops"]:
                    self.assertIn(loop["tight"], ("shortest", "locally"))
                    self.assertGreater(loop["coefficient"], 0)

    def test_a_threshold_leaves_loops_that_never_die(self):
        self.write("ring.txt", text(ring(12)))
        (bar,) = self.loops("ring.txt", "--threshold", "0.6")
        self.assertIsNone(bar["death"])
        self.assertEqual(bar["loops"][0]["vertices"], list(range(12)))
        self.assertEqual(bar["loops"][0]["tight"], "shortest")

    def test_images(self):
        rows = [1.0] * 9
        rows[4] = 5.0
        self.write("hole.npy", files.array((3, 3), rows))
        (bar,) = self.loops("hole.npy")
        self.assertEqual(bar["loops"], [{
            "grid": [[0, 0], [0, 2], [0, 4], [2, 4], [4, 4], [4, 2], [4, 0], [2, 0]],
            "coefficient": 1, "tight": "no"}])
        # In the T-construction, the vertices are corners of voxels, and the loop surrounds the
        # voxel in the middle.
        (bar,) = self.loops("hole.npy", "--construction", "cells")
        for vertex in bar["loops"][0]["grid"]:
            self.assertTrue(all(x % 2 == 0 and 0 <= x <= 6 for x in vertex))
        # The loop crosses the place where a periodic axis closes.
        self.write("band.npy", files.array((2, 5), [1.0] * 5 + [3.0] * 5))
        bar = self.loops("band.npy", "--periodic", "1")[0]
        self.assertEqual(bar["loops"][0]["grid"], [[0, 0], [0, 2], [0, 4], [0, 6], [0, 8]])
        # A bar whose representative is a set of voxels has no loops. A bar of the same result whose
        # representative is a cycle has loops.
        volume = files.array((3, 3, 3), [1.0 if (y, x) != (1, 1) else 2.0 for z in range(3)
                                 for y in range(3) for x in range(3)])
        bars = self.result(self.write("pipe.npy", volume), "--representatives", "voxels",
                           "--periodic", "0")
        for bar in bars:
            self.assertEqual("loops" in bar, "representative" in bar and bar["dim"] == 1)
        self.assertTrue(any("loops" in bar for bar in bars))

    def test_simplices_and_matrices(self):
        self.write("ring.simplices", "0 : 0\n5 : 0\n9 : 0\n0 5 : 1\n5 9 : 1\n0 9 : 2\n")
        (bar,) = self.loops("ring.simplices", "--format", "simplices")
        self.assertEqual(bar["loops"],
                         [{"vertices": [0, 5, 9], "coefficient": 1, "tight": "no"}])
        self.write("ring.phat", "0\n0\n0\n1 0 1\n1 1 2\n1 0 2\n")
        bars = self.result("ring.phat", "--format", "phat", "--representatives", "cycles")
        self.assertFalse(any("loops" in bar for bar in bars))

    def test_read_back(self):
        self.expect(0, "square.txt", "--representatives", "cycles", "-o", "a.json", "--quiet")
        self.expect(0, "square.txt", "--representatives", "cycles", "--loops", "none",
                    "-o", "b.json", "--quiet")
        self.expect(0, "--compare", "a.json", "b.json", "--quiet")
        self.require_page()
        self.expect(0, "--compare", "a.json", "b.json", "--report", "c.html", "--quiet")


if __name__ == "__main__":
    main()
