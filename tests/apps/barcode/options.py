# SPDX-License-Identifier: MIT
"""The effects of ph-barcode's options, compared with results worked out by hand."""
import json
import math
import os
import random
import select
import struct
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import program  # noqa: E402
from program import SQUARE, SQUARE_CSV, ProgramTest, files, main  # noqa: E402

TRIANGLE = "0 : 0\n1 : 0\n2 : 0\n0 1 : 1\n1 2 : 2\n0 2 : 3\n0 1 2 : 4\n"


class Options(ProgramTest):
    def bars(self, *arguments, **options):
        lines = self.expect(0, *arguments, "--quiet", **options).stdout.splitlines()
        self.assertEqual(lines[0], "dim,birth,death")
        return [(int(d), float(b), float(e)) for d, b, e in (x.split(",") for x in lines[1:])]

    def test_metrics(self):
        self.write("two.txt", "0 0\n3 4\n")
        for metric, distance in (("euclidean", 5), ("manhattan", 7), ("chebyshev", 4),
                                 ("minkowski:1", 7), ("hamming", 2)):
            self.assertEqual(self.bars("two.txt", "--metric", metric)[0][2], distance, metric)
        self.write("two.txt", "1 0\n0 1\n")
        self.assertEqual(self.bars("two.txt", "--metric", "cosine")[0][2], 1)

    def test_aliases(self):
        self.assertEqual(self.bars("square.txt", "--max-scale", "1.1", "--modulus", "3"),
                         self.bars("square.txt", "--threshold", "1.1", "--field", "3"))

    def test_significance(self):
        rng = random.Random(3)
        points = [(math.cos(a) + rng.gauss(0, 0.1), math.sin(a) + rng.gauss(0, 0.1))
                  for a in (rng.uniform(0, 2 * math.pi) for _ in range(80))]
        self.write("circle.csv", "".join(f"{x!r},{y!r}\n" for x, y in points))
        lines = self.expect(0, "circle.csv", "--significance", "--quiet").stdout.splitlines()
        self.assertEqual(lines[0], "dim,birth,death,p")
        rows = [line.split(",") for line in lines[1:]]
        self.assertEqual([row[:3] for row in rows], [
            line.split(",") for line in self.expect(0, "circle.csv", "--quiet").stdout.splitlines()[1:]])
        self.assertEqual({row[3] for row in rows if row[0] == "0"}, {""})
        loops = [(float(b), float(d), float(p)) for dim, b, d, p in rows if dim == "1"]
        ratios = [math.log(math.log(death / birth)) for birth, death, _ in loops]
        mean = sum(ratios) / len(ratios)
        for (_, _, p), ratio in zip(loops, ratios):
            expected = len(loops) * math.exp(-math.exp(ratio - mean - 0.5772156649015329))
            self.assertAlmostEqual(p, min(1, expected), 12)
        self.assertEqual([p < 0.05 for _, _, p in loops].count(True), 1)
        self.expect(0, "circle.csv", "--significance", "-o", "out.json", "--quiet")
        bars = json.loads(self.read("out.json"))["bars"]
        self.assertEqual([bar["p"] for bar in bars if bar["dim"] == 1], [p for _, _, p in loops])
        self.assertFalse([bar for bar in bars if bar["dim"] == 0 and "p" in bar])
        # A bar that is cut off by the threshold has no p-value. When written bars are read again,
        # their p-values are kept.
        self.expect(0, "circle.csv", "--significance", "--threshold", "0.8", "-o", "cut.csv")
        self.assertIn("inf,\n", self.read("cut.csv"))
        again = self.expect(0, "cut.csv")
        self.assertEqual(again.stdout, self.read("cut.csv"))
        self.assertNotIn("not kept", again.stderr)

    def test_significance_is_refused(self):
        for arguments, words in (
                (["--min-persistence", "0.1"], "expected all bars"), (["--dtm", "2"], "weights"),
                (["--max-dim", "0"], "--max-dim 0"), (["--output-format", "npy"], "csv or json"),
                (["--output-format", "ripser"], "csv or json")):
            done = self.expect(64, "square.txt", "--significance", *arguments)
            self.assertIn("--significance: found", done.stderr)
            self.assertIn(words, done.stderr)
        self.write("image.pgm", "P2 2 2 9\n1 2\n3 4\n")
        self.assertIn("--significance", self.expect(64, "image.pgm", "--significance").stderr)
        for line in ("1,0.5,2,1.5", "1,0.5,2,-0.1", "1,0.5,2,x", "1,0.5,2,0.1,3"):
            self.write("wrong.csv", "dim,birth,death,p\n" + line + "\n")
            self.expect(65, "wrong.csv")

    def test_standard_input(self):
        self.assertEqual(self.bars("-", input=SQUARE), self.bars("square.txt"))

    def test_distance_formats(self):
        want = [(0, 0, 1), (0, 0, 2), (0, 0, math.inf)]
        self.write("lower.txt", "1\n3 2\n")
        self.assertEqual(self.bars("lower.txt", "--format", "lower-distance"), want)
        self.write("upper.txt", "1 3\n2\n")
        self.assertEqual(self.bars("upper.txt", "--format", "upper-distance"), want)
        self.write("full.txt", "0 1 3\n1 0 2\n3 2 0\n")
        self.assertEqual(self.bars("full.txt", "--format", "distance"), want)
        self.write("sparse.txt", "0 1 1\n1 2 2\n")
        self.assertEqual(self.bars("sparse.txt", "--format", "sparse"), want)
        self.write("floats.bin", struct.pack("<3f", 1, 3, 2))
        self.assertEqual(self.bars("floats.bin", "--format", "binary"), want)

    def test_asymmetry_and_correlation(self):
        self.write("asymmetric.txt", "0 1\n3 0\n")
        self.expect(65, "asymmetric.txt", "--format", "distance")
        for way, death in (("max", 3), ("min", 1), ("lower", 3)):
            self.assertEqual(self.bars("asymmetric.txt", "--format", "distance", "--symmetrise",
                                       way)[0][2], death)
        self.write("correlation.txt", "1 0.25\n0.25 1\n")
        self.assertEqual(self.bars("correlation.txt", "--format", "distance",
                                   "--from-correlation")[0][2], 0.75)

    def test_nan_dropped_keeps_the_numbers_of_the_points(self):
        self.write("holes.txt", "0 0\nnan 0\n5 0\n")
        self.expect(65, "holes.txt")
        result = json.loads(self.expect(0, "holes.txt", "--nan", "drop", "--output-format",
                                        "json").stdout)
        self.assertEqual(result["bars"][0]["death_cell"], {"vertices": [0, 2]})

    def test_empty_input(self):
        self.write("empty.txt", "# nothing\n")
        self.assertIn("no points", self.expect(65, "empty.txt").stderr)
        self.assertEqual(self.bars("empty.txt", "--allow-empty"), [])

    def test_image(self):
        self.write("row.npy", files.array((5,), [0, 3, 1, 4, 2]))
        self.assertEqual(self.bars("row.npy"), [(0, 0, math.inf), (0, 1, 3), (0, 2, 4)])
        self.assertEqual(self.bars("row.npy", "--threshold", "3"),
                         [(0, 0, math.inf), (0, 1, 3), (0, 2, math.inf)])
        self.assertEqual(self.bars("row.npy", "--periodic", "0"),
                         [(0, 0, math.inf), (0, 1, 3), (1, 4, math.inf)])
        self.assertEqual(self.bars("row.npy", "--periodic=all"), self.bars("row.npy", "--periodic=0"))
        self.assertEqual(self.bars("row.npy", "--construction", "cells"), self.bars("row.npy"))
        self.assertEqual(len(self.bars("row.npy", "--superlevel")), 2)
        self.write("points.npy", files.array((2, 2), [0, 0, 3, 4]))
        self.assertEqual(self.bars("points.npy", "--complex", "rips")[0], (0, 0, 5))

    def test_raw_images(self):
        self.write("volume.raw", b"header" + struct.pack(">6H", 1, 9, 2, 9, 9, 9))
        shape = ("volume.raw", "--raw-shape", "2,3", "--raw-skip", "6")
        self.assertEqual(self.bars(*shape, "--raw-type", "uint16", "--raw-big-endian"),
                         [(0, 1, math.inf), (0, 2, 9)])
        for arguments, code, what in (
                (shape, 65, "trailing data"),
                ((*shape, "--raw-type", "float64"), 65, "truncated"),
                (("volume.raw", "--raw-skip", "6"), 64, "--raw-shape"),
                (("volume.raw", "--format", "raw"), 64, "--raw-shape"),
                ((*shape, "--format", "npy"), 64, "--format raw"),
                (("volume.raw", "--raw-shape", "2,-3"), 64, "--raw-shape"),
                (("volume.raw", "--raw-shape", "2,,3"), 64, "--raw-shape")):
            self.assertIn(what, self.expect(code, *arguments).stderr)

    def test_raw_points(self):
        points = [(0.5, 0, 7, 0.25), (3.5, 4, 7, 0.5), (0.5, 1, 7, 0.75)]
        scan = [x for point in points for x in point]
        self.write("scan.bin", struct.pack("<12f", *scan))
        self.write("deep.bin", b"header" + struct.pack(">12d", *scan))
        self.write("points.txt", "".join(f"{x} {y} {z}\n" for x, y, z, _ in points).encode())
        wanted = self.bars("points.txt")
        self.assertEqual(self.bars("scan.bin", "--raw-points", "4", "--columns", "1-3"), wanted)
        self.assertEqual(self.bars("deep.bin", "--raw-points", "4", "--columns", "1-3", "--raw-skip", "6",
                                   "--raw-type", "float64", "--raw-big-endian"), wanted)
        self.assertEqual(len(self.bars("scan.bin", "--raw-points", "4")), 3)
        for arguments, code, what in (
                (("--raw-points", "5"), 65, "byte 40: truncated point, found 8 of its bytes, expected 20"),
                (("--raw-points", "0"), 64, "--raw-points"),
                (("--raw-points", "4", "--columns", "5"), 64, "--columns"),
                (("--raw-points", "4", "--raw-shape", "12"), 64, "--raw-points"),
                (("--raw-points", "4", "--format", "npy"), 64, "--format raw"),
                (("--raw-type", "float32"), 64, "--raw-points"), (("--format", "raw"), 64, "--raw-points"),
                (("--raw-points", "4", "--raw-type", "uint8", "--raw-big-endian"), 64, "one byte")):
            self.assertIn(what, self.expect(code, "scan.bin", *arguments).stderr)
        self.write("triangle.bin", struct.pack("<120f", *range(120)))
        note = self.expect(0, "triangle.bin").stderr
        self.assertIn("read as distances; --raw-points 4 reads 30 points of 4 numbers; 3, 5 and 6", note)
        self.write("scan.bin", struct.pack("<120f", -1, *range(119)))
        refused = self.expect(65, "scan.bin").stderr
        self.assertIn("negative distance", refused)
        self.assertIn("--raw-points 4 reads 30 points of 4 numbers; 3, 5 and 6", refused)

    def test_meshes_with_seams(self):
        # The two triangles of a square, each with its own vertices.
        self.write("square.off", b"OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n0 1 0\n1 0 0\n1 1 0\n"
                                 b"3 0 1 2\n3 5 3 4\n")
        self.write("values.txt", b"0 1 2 2 1 3\n")
        mesh = ("square.off", "--values", "values.txt")
        split = self.expect(0, *mesh)
        self.assertIn("2 positions have several vertices each", split.stderr)
        self.assertIn("--weld joins them", split.stderr)
        self.assertEqual(split.stdout.count("inf"), 2)
        welded = self.expect(0, *mesh, "--weld")
        self.assertIn("2 of 6 vertices joined", welded.stderr)
        self.assertEqual(welded.stdout, "dim,birth,death\n0,0,inf\n")
        # The vertices keep the numbers of the file.
        self.write("values.txt", b"3 4 4 4 4 0\n")
        cells = self.expect(0, *mesh, "--weld", "--representatives", "cycles", "--output-format", "json")
        self.assertIn('"death_cell":{"vertices":[1,5]}', cells.stdout.replace(" ", ""))
        self.write("values.txt", b"0 1 2 9 1 3\n")
        self.assertIn("the values 2 of vertex 2 and 9 of vertex 3, expected equal values for --weld",
                      self.expect(65, *mesh, "--weld").stderr)
        self.assertIn("--weld", self.expect(64, "square.off", "--weld", "--quiet").stderr)

    def test_points_as_voxels(self):
        # Two empty voxels separate two groups of points.
        self.write("line.txt", "0.5\n0.7\n3.5\n3.6\n3.7\n")
        cubical = ("line.txt", "--complex", "cubical", "--voxel", "1")
        self.assertEqual(self.bars(*cubical), [(0, 0, 1), (0, 0, math.inf)])
        self.assertEqual(self.bars(*cubical, "--voxel-value", "occupancy"),
                         [(0, 0, math.inf)] * 2)
        self.assertEqual(self.bars(*cubical, "--voxel-value", "density"),
                         [(0, -3, math.inf), (0, -2, math.inf)])
        self.assertEqual(self.bars(*cubical, "--threshold", "0.5"), [(0, 0, math.inf)] * 2)
        self.expect(0, *cubical, "-o", "out.json")
        result = json.loads(self.read("out.json"))
        self.assertEqual(result["complex"], "cubical")
        self.assertEqual(result["voxels"], {"edge": 1, "first": [0], "value": "distance"})
        self.write("holes.xyz", "0 0 0\nnan nan nan\n2 0 0\n")
        self.assertEqual(len(self.bars("holes.xyz", *cubical[1:], "--voxel-value", "occupancy")), 2)

    def test_points_as_voxels_need_an_edge(self):
        for arguments, what in (
                (("square.txt", "--complex", "cubical"), "--voxel"),
                (("square.txt", "--voxel", "1"), "--complex cubical"),
                (("square.txt", "--voxel-value", "density"), "--complex cubical"),
                (("square.txt", "--complex", "cubical", "--voxel", "0"), "above 0"),
                (("square.txt", "--complex", "cubical", "--voxel", "1", "--metric", "manhattan"),
                 "--metric"),
                (("square.txt", "--complex", "cubical", "--voxel", "1", "--collapse", "on"),
                 "--collapse"),
                (("square.txt", "--superlevel"), "--superlevel")):
            self.assertIn(what, self.expect(64, *arguments).stderr)
        self.assertIn("voxels", self.expect(75, "square.txt", "--complex", "cubical", "--voxel",
                                            "1e-9").stderr)

    def test_simplices(self):
        self.write("triangle.txt", TRIANGLE)
        want = [(0, 0, 1), (0, 0, 2), (0, 0, math.inf), (1, 3, 4)]
        for field in ("2", "3", "2147483647"):
            self.assertEqual(self.bars("triangle.txt", "--format", "simplices", "--field", field),
                             want)
        self.assertEqual(self.bars("triangle.txt", "--format", "simplices", "--threshold", "3"),
                         want[:3] + [(1, 3, math.inf)])
        self.assertEqual(self.bars("triangle.txt", "--format", "simplices", "--threshold", "1.5"),
                         [(0, 0, 1), (0, 0, math.inf), (0, 0, math.inf)])

    def test_lower_star(self):
        self.write("triangle.txt", TRIANGLE)
        self.write("values.txt", "5\n6\n7\n")
        self.assertEqual(self.bars("triangle.txt", "--format", "simplices", "--complex",
                                   "lower-star", "--values", "values.txt"), [(0, 5, math.inf)])
        self.write("mesh.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                   "3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n")
        self.write("values.txt", "1\n2\n3\n4\n")
        self.assertEqual(self.bars("mesh.off", "--values", "values.txt"),
                         [(0, 1, math.inf), (2, 4, math.inf)])
        self.assertEqual(len(self.bars("mesh.off", "--max-dim", "0")), 4)

    def test_boundary_matrix(self):
        self.write("edge.phat", "0\n0\n1 0 1\n")
        self.write("edge.vals", "0\n0.5\n2\n")
        self.assertEqual(self.bars("edge.phat", "--format", "phat", "--values", "edge.vals"),
                         [(0, 0, math.inf), (0, 0.5, 2)])
        self.assertEqual(self.bars("edge.phat", "--format", "phat"),
                         [(0, 0, math.inf), (0, 1, 2)])

    def test_vertex_weights(self):
        self.write("weights.txt", "0 0.5 3 0\n")
        run = self.expect(0, "square.txt", "--vertex-weights", "weights.txt", "--max-dim", "0")
        self.assertEqual(run.stdout, "dim,birth,death\n0,0,1.25\n0,0,inf\n0,0.5,1\n")
        for others in (["--check"], ["--engine", "standard", "--check"], ["--max-dim", "2"],
                       ["--collapse", "on", "--check"]):
            run = self.expect(0, "square.txt", "--vertex-weights", "weights.txt", *others)
            self.assertEqual(run.stdout, "dim,birth,death\n0,0,1.25\n0,0,inf\n0,0.5,1\n")
        run = self.expect(0, "square.txt", "--vertex-weights", "weights.txt", "--threshold", "1")
        self.assertEqual(run.stdout, "dim,birth,death\n0,0,inf\n0,0,inf\n0,0.5,1\n")
        self.expect(0, "square.txt", "--vertex-weights", "weights.txt", "--weight-exponent", "1",
                    "-o", "out.json")
        result = json.loads(self.read("out.json"))
        self.assertEqual(result["vertex_weights"], "file, exponent 1")
        self.assertEqual([(b["birth"], b["death"]) for b in result["bars"]],
                         [(0, 1.25), (0, None), (0.5, 1.25)])

    def test_weights_of_points_left_out_are_passed_over(self):
        self.write("holes.txt", "0 0\nnan 1\n1 0\n")
        self.write("weights.txt", "0 7 2\n")
        run = self.expect(0, "holes.txt", "--nan", "drop", "--vertex-weights", "weights.txt")
        self.assertEqual(run.stdout, "dim,birth,death\n0,0,inf\n")
        self.write("weights.txt", "0 2\n")
        self.expect(65, "holes.txt", "--nan", "drop", "--vertex-weights", "weights.txt", "--quiet")

    def test_dtm(self):
        self.write("line.txt", "0\n1\n9\n")
        # Each point counts as one of its own two nearest neighbours.
        f = [math.sqrt(0.5), math.sqrt(0.5), math.sqrt(32)]
        run = self.expect(0, "line.txt", "--dtm", "2", "--output-format", "json", "--check")
        result = json.loads(run.stdout)
        self.assertEqual(result["vertex_weights"], "dtm 2, exponent 1")
        found = [x for b in result["bars"] for x in (b["birth"], b["death"])]
        for x, expected in zip(found, [2 * f[0], 1 + 2 * f[0], 2 * f[0], None, 2 * f[2],
                                       8 + f[1] + f[2]]):
            self.assertAlmostEqual(x, expected) if expected else self.assertIsNone(x)
        for metric in ("manhattan", "hamming"):
            self.expect(0, "line.txt", "--dtm", "2", "--metric", metric, "--check")

    def test_core(self):
        self.write("line.txt", "0\n1\n3\n10\n")
        run = self.expect(0, "line.txt", "--core", "2", "--output-format", "json", "--check")
        result = json.loads(run.stdout)
        self.assertEqual(result["vertex_weights"], "core 2, exponent inf")
        # The core distances are 3, 2, 3 and 9.
        found = [(b["birth"], b["death"]) for b in result["bars"] if b["dim"] == 0]
        self.assertEqual(found, [(2, None)])
        run = self.expect(0, "line.txt", "--core", "1", "--max-dim", "0", "--output-format", "json",
                          "--check")
        found = [(b["birth"], b["death"]) for b in json.loads(run.stdout)["bars"]]
        self.assertEqual(found, [(1, None)])

    def test_subsample(self):
        self.write("line.txt", "0\n1\n2\n10\n")
        run = self.expect(0, "line.txt", "--subsample", "2", "-o", "out.json")
        self.assertIn("2 of 4 points, covering radius 2: bars longer than 4 are real", run.stderr)
        result = json.loads(self.read("out.json"))
        self.assertEqual(result["subsample"], {"points": 2, "of": 4, "covering_radius": 2})
        self.assertEqual([b["birth_cell"] for b in result["bars"]],
                         [{"vertices": [3]}, {"vertices": [0]}])
        run = self.expect(0, "line.txt", "--subsample-radius", "1", "--check", "--quiet")
        self.assertEqual(run.stdout, "dim,birth,death\n0,0,2\n0,0,8\n0,0,inf\n")
        self.assertEqual(run.stderr, "")
        self.write("matrix.txt", "0 1 2\n1 0 1\n2 1 0\n")
        run = self.expect(0, "matrix.txt", "--format", "distance", "--subsample", "2")
        self.assertIn("if the triangle inequality holds", run.stderr)
        self.assertEqual(run.stdout, "dim,birth,death\n0,0,2\n0,0,inf\n")
        self.write("holes.txt", "nan 0\n0 0\n0 1\n0 9\n")
        run = self.expect(0, "holes.txt", "--nan", "drop", "--subsample", "2",
                          "--output-format", "json")
        self.assertEqual(json.loads(run.stdout)["bars"][0]["birth_cell"], {"vertices": [3]})

    def test_a_gpu_gives_the_same_or_is_said_to_be_missing(self):
        self.write("line.txt", "0\n1\n3\n")
        same = self.expect(0, "line.txt", "--max-dim", "0", "--device", "cpu", "--quiet")
        self.assertEqual(same.stdout, "dim,birth,death\n0,0,1\n0,0,2\n0,0,inf\n")
        run = self.run_program("line.txt", "--max-dim", "0", "--device", "gpu", "--quiet")
        if run.returncode == 0:
            self.assertEqual(run.stdout, same.stdout)
        else:
            self.assertEqual(run.stdout, "")
            self.assertEqual(run.returncode, 69)
            self.assertRegex(run.stderr, "device gpu: (not built in: it needs CUDA|CUDA says)")
        for options in ([], ["--max-dim", "0", "--metric", "manhattan"],
                        ["--max-dim", "0", "--engine", "standard"],
                        ["--max-dim", "0", "--dtm", "2"],
                        ["--max-dim", "0", "--core", "2"]):
            run = self.expect(64, "line.txt", "--device", "gpu", *options)
            self.assertIn("expected components (H0) of points with Euclidean distances", run.stderr)
        self.write("matrix.txt", "0 1\n1 0\n")
        run = self.expect(64, "matrix.txt", "--format", "distance", "--device", "gpu")
        self.assertIn("--device: makes sense for Rips complexes of points only", run.stderr)

    def test_approximate(self):
        generator = random.Random(4)
        self.write("cloud.txt", "".join(f"{generator.random()} {generator.random()}\n"
                                        for _ in range(300)))
        exact = self.expect(0, "cloud.txt", "--max-dim", "0").stdout.splitlines()[1:]
        run = self.expect(0, "cloud.txt", "--approximate", "0.5", "--check", "-o", "out.json")
        self.assertIn("of 44850 edges: births and deaths are too late by a factor of at most 1.5", run.stderr)
        result = json.loads(self.read("out.json"))
        self.assertEqual(result["approximation"], 0.5)
        deaths = [b["death"] for b in result["bars"] if b["dim"] == 0]
        for line, death in zip(exact[:-1], deaths):
            early = float(line.split(",")[2])
            self.assertTrue(early <= death <= 1.5 * early * (1 + 1e-12))
        run = self.expect(0, "square.txt", "--approximate", "1e-9", "--quiet")
        self.assertEqual(run.stdout, SQUARE_CSV)

    def test_min_persistence_beside_a_threshold(self):
        self.write("triangle.txt", TRIANGLE)
        self.assertEqual(self.bars("triangle.txt", "--format", "simplices", "--threshold", "3",
                                   "--min-persistence", "1"),
                         [(0, 0, 2), (0, 0, math.inf), (1, 3, math.inf)])

    def test_min_persistence(self):
        self.assertEqual(len(self.bars("square.txt", "--min-persistence", "1")), 2)
        self.write("pair.txt", "0 0\n0 0\n")
        self.assertEqual(len(self.bars("pair.txt")), 1)
        self.assertIn((0, 0, 0), self.bars("pair.txt", "--min-persistence=-1"))

    def test_engines_agree_with_the_oracle(self):
        for engine in ("auto", "standard", "twist", "cohomology"):
            run = self.expect(0, "square.txt", "--engine", engine, "--check", "--max-dim", "2",
                              "--verbose")
            self.assertEqual(run.stdout, SQUARE_CSV)
            self.assertIn("the reference engine agrees", run.stderr)
            self.assertIn("engine ", run.stderr)

    def test_collapse_leaves_the_bars_and_says_what_it_did(self):
        random.seed(11)
        rows = [f"{random.random()} {random.random()}" for _ in range(40)]
        self.write("cloud.txt", "\n".join(rows) + "\n")
        runs = {}
        for way, words in (("on", "collapse on (requested)"), ("off", "collapse off (requested)"),
                           ("auto", "% of a sample of the edges are dominated)")):
            options = ("cloud.txt", "--collapse", way, "--max-dim", "2", "--engine", "cohomology")
            runs[way] = self.expect(0, *options, "--check", "--verbose")
            self.assertIn(words, runs[way].stderr)
            self.assertIn("the reference engine agrees", runs[way].stderr)
            self.assertIn("collapse " + ("off" if way == "off" else "on"),
                          self.expect(0, *options, "--dry-run").stdout)
        self.assertEqual(runs["on"].stdout, runs["off"].stdout)
        self.assertEqual(runs["auto"].stdout, runs["off"].stdout)
        # For H1, the edges are not collapsed; an image has no edges to collapse.
        self.assertIn("collapse off (", self.expect(0, "cloud.txt", "--verbose").stderr)
        self.write("image.npy", files.array((1, 3), [0, 2, 1]))
        self.assertNotIn("collapse", self.expect(0, "image.npy", "--verbose").stderr)

    def test_high_dimensions_are_legal(self):
        self.assertEqual(self.bars("square.txt", "--max-dim", "60"), self.bars("square.txt"))

    def test_dry_run_computes_nothing(self):
        run = self.expect(0, "square.txt", "--dry-run", "-o", "out.csv")
        for word in ("input ", "complex ", "engine ", "cells ", "memory "):
            self.assertIn(word, run.stdout)
        self.assertIn("cells    dimension 0: 4\n", run.stdout)
        self.assertIn("cells    dimension 2 and above: not listed\n", run.stdout)
        self.assertEqual(self.files(), ["square.txt"])

    def test_dry_run_says_what_it_does_not_do(self):
        dry = ("square.txt", "--dry-run")
        for options in (("--output-format", "pers"), ("--min-persistence", "1"), ("--force",),
                        ("--loops", "plain", "--representatives", "cycles", "--output-format",
                         "json")):
            run = self.expect(0, *dry, *options)
            self.assertIn(options[0], run.stderr, options)
        for options in (("--output-format", "json"), ("--field", "3"), ("--min-dim", "1")):
            self.assertRegex(self.expect(0, *dry, *options).stderr,
                             f"--dry-run uses {options[0]}.* only to estimate memory")
        for options in ((), ("--min-persistence=-1",)):
            self.assertNotIn("-dry-run", self.expect(0, *dry, *options).stderr)
        self.write("row.npy", files.array((3,), [0, 2, 1]))
        self.assertNotIn("does nothing",
                         self.expect(0, "row.npy", "--slab-layers", "1", "--dry-run").stderr)
        self.write("four.npy", files.array((2, 2, 2, 2), range(16)))
        self.assertIn("--slab-layers does nothing: with n >= 4 axes, bars of dimensions 1 to n - 2",
                      self.expect(0, "four.npy", "--slab-layers", "1", "--dry-run").stderr)
        self.assertNotIn("does nothing", self.expect(0, "four.npy", "--slab-layers", "1",
                                                     "--max-dim", "0", "--dry-run").stderr)

    def test_options_of_bars_that_nobody_sees(self):
        self.write("row.npy", files.array((3,), [0, 2, 1]))
        tree = ("row.npy", "--plot", "t.svg", "--plot-kind", "tree")
        bars = ("--min-persistence", "5", "--max-dim", "0")
        run = self.expect(0, *tree, "--output-format", "none", *bars)
        self.assertIn("--max-dim, --min-persistence: ignored, because only the merge tree",
                      run.stderr)
        for options in (bars, (*bars, "--output-format", "none", "--check"),
                        (*bars, "--output-format", "none", "--plot", "b.svg", "--plot-kind",
                         "diagram"), ("--output-format", "none")):
            self.assertNotIn("ignored", self.expect(0, *tree, *options).stderr)

    def test_representatives_that_nobody_sees(self):
        for options in (("--output-format", "none"), ("--plot", "pics/")):
            run = self.expect(64, "square.txt", "--representatives", "cycles", *options)
            self.assertIn("--representatives: found output format none, expected json", run.stderr)
        self.assertEqual(self.files(), ["square.txt"])

    def test_json_progress(self):
        run = self.expect(0, "square.txt", "--progress", "json", "--quiet")
        for line in run.stderr.splitlines():
            json.loads(line)

    def test_progress_is_heard_every_second(self):
        """Progress is reported even if nothing happens: here, the program waits for its input."""
        with subprocess.Popen([program.PROGRAM, "-", "--progress", "json", "--quiet"],
                              stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE) as run:
            heard = [json.loads(run.stderr.readline())["seconds"] for _ in range(3)]
            run.communicate(b"0\n1\n", 20)
        self.assertEqual(run.returncode, 0)
        for before, after in zip([0, *heard], heard):
            self.assertLess(after - before, 1)

    def test_no_bar_while_somebody_types(self):
        try:
            terminal, stdin = os.openpty()
        except OSError as error:
            self.skipTest(f"no pseudo-terminal: {error.strerror}")
        with subprocess.Popen([program.PROGRAM, "-", "--progress", "bar", "--quiet"], stdin=stdin,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as run:
            os.close(stdin)
            os.write(terminal, b"0\n")
            time.sleep(2)
            os.set_blocking(run.stderr.fileno(), False)
            self.assertIsNone(run.stderr.read(), "a bar among what is typed")
            os.set_blocking(run.stderr.fileno(), True)
            os.write(terminal, b"1\n\x04")
            stdout, _ = run.communicate(timeout=20)
            os.close(terminal)
        self.assertEqual((run.returncode, stdout), (0, b"dim,birth,death\n0,0,1\n0,0,inf\n"))

    def test_a_pipe_is_waited_for_with_a_bar(self):
        with subprocess.Popen([program.PROGRAM, "-", "--progress", "bar", "--quiet"],
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE) as run:
            time.sleep(1.5)
            stderr = run.communicate(b"0\n1\n", 20)[1]
        self.assertRegex(stderr, rb"^(\r\x1b\[Kread 0)+\r\x1b\[K")

    def test_no_bar_while_results_are_written(self):
        """The process that reads the results is slow."""
        random.seed(7)
        self.write("picture.pgm", b"P5 1200 1200 255\n" + random.randbytes(1200 * 1200))
        with subprocess.Popen([program.PROGRAM, "picture.pgm", "--engine", "twist", "--progress",
                               "bar", "--quiet"], cwd=self.folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as run:
            os.set_blocking(run.stderr.fileno(), False)
            select.select([run.stdout], [], [], 60)  # the first page of the results has arrived
            before = run.stderr.read()
            self.assertRegex(before, rb"\] +\d+ %")
            self.assertTrue(before.endswith(b"\r\x1b[K"), before[-100:])
            time.sleep(2)
            self.assertIsNone(run.stderr.read(), "a bar among the results")
            os.set_blocking(run.stderr.fileno(), True)
            run.communicate(timeout=60)
        self.assertEqual(run.returncode, 0)


class Version(ProgramTest):
    def test_version_and_help(self):
        self.assertRegex(self.expect(0, "--version").stdout, r"^ph-barcode \d+\.\d+\.\d+\n$")
        for order in (("--version", "--verbose"), ("--verbose", "--version")):
            text = self.expect(0, *order).stdout
            for word in ("compiler", "build type", "assertions", "Eigen", "fmt", "CLI11", "libpng",
                         "PNG plots", "zlib", "PCL", "CGAL", "engines", "reads", "writes"):
                self.assertRegex(text, rf"(?m)^{word} +\S")
        text = self.expect(0, "--help", "all").stdout
        for option in ("--max-dim", "--threshold", "--max-scale", "--memory-limit", "default"):
            self.assertIn(option, text)


if __name__ == "__main__":
    main()
