# SPDX-License-Identifier: MIT
"""The output of ph-barcode in each format, compared with results worked out by hand."""
import json
import math
import os
import random
import shutil
import struct
import subprocess
import sys
import unittest
import xml.dom.minidom

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import SQUARE_CSV, ProgramTest, files, main  # noqa: E402


class Formats(ProgramTest):
    def test_csv_is_the_default(self):
        run = self.expect(0, "square.txt")
        self.assertEqual(run.stdout, SQUARE_CSV)
        self.assertEqual(run.stderr, "ph-barcode: read square.txt: 4 points in R^2, text\n")

    def test_quiet_says_nothing(self):
        self.assertEqual(self.expect(0, "square.txt", "--quiet").stderr, "")

    def test_ripser(self):
        run = self.expect(0, "square.txt", "--output-format", "ripser", "--threshold=1.3")
        self.assertEqual(run.stdout, "persistence intervals in dim 0:\n [0,1)\n [0,1)\n"
                         " [0,1.03078)\n [0, )\npersistence intervals in dim 1:\n [1.25, )\n")

    def test_ripser_prints_empty_dimensions(self):
        run = self.expect(0, "square.txt", "--output-format=ripser", "--max-dim", "2")
        self.assertTrue(run.stdout.endswith("persistence intervals in dim 2:\n"))

    def test_pers(self):
        run = self.expect(0, "square.txt", "--output-format", "pers", "--max-dim", "0")
        self.assertEqual(run.stdout, "0 0 1\n0 0 1\n0 0 1.0307764064044151\n0 0 inf\n")

    def test_none(self):
        self.assertEqual(self.expect(0, "square.txt", "--output-format", "none").stdout, "")

    def test_json(self):
        self.expect(0, "square.txt", "-o", "out.json")
        result = json.loads(self.read("out.json"))
        self.assertEqual(result["format"], "ph-barcode")
        self.assertEqual(result["version"], 1)
        self.assertEqual(result["input"]["path"], "square.txt")
        self.assertEqual(result["complex"], "rips")
        self.assertEqual((result["field"], result["max_dim"]), (2, 1))
        self.assertAlmostEqual(result["threshold"], math.sqrt(2))
        self.assertIn("persistence", result["timings"])
        self.assertGreater(result["peak_memory"], 0)
        bars = [(b["dim"], b["birth"], b["death"]) for b in result["bars"]]
        self.assertEqual(bars[3:], [(0, 0, None), (1, 1.25, math.sqrt(2))])
        self.assertIsNone(result["bars"][3]["death_cell"])
        self.assertEqual(result["bars"][4]["birth_cell"], {"vertices": [0, 3]})
        self.assertEqual(result["bars"][4]["death_cell"], {"vertices": [0, 2, 3]})

    def test_components_alone_need_a_spanning_forest_only(self):
        expected = [line for line in SQUARE_CSV.splitlines(keepends=True) if line[0] != "1"]
        run = self.expect(0, "square.txt", "--max-dim", "0", "--verbose")
        self.assertEqual(run.stdout, "".join(expected))
        self.assertIn("engine union-find: only components are requested; a spanning forest",
                      run.stderr)
        run = self.expect(0, "square.txt", "--max-dim", "0", "--dry-run")
        self.assertIn("dimension 1: 3\n", run.stdout)
        for others, has_forest, is_same in ((["--check"], True, True),
                                            (["--engine", "standard"], False, True),
                                            (["--engine", "cohomology"], False, True),
                                            (["--metric", "hamming"], True, False)):
            run = self.expect(0, "square.txt", "--max-dim", "0", "--verbose", *others)
            self.assertEqual("spanning forest" in run.stderr, has_forest)
            self.assertEqual(run.stdout == "".join(expected), is_same)

    def test_components_have_representatives(self):
        for kind, sizes in (("cycles", [2, 2, 2, 1]), ("cocycles", [1, 1, 1, 4])):
            self.expect(0, "square.txt", "--max-dim", "0", "--representatives", kind, "-o",
                        "out.json")
            bars = json.loads(self.read("out.json"))["bars"]
            self.assertEqual([len(b["representative"]) for b in bars], sizes)

    def test_json_of_image_and_matrix_name_their_cells(self):
        self.write("image.npy", files.array((1, 3), [0, 2, 1]))
        bars = json.loads(self.expect(0, "image.npy", "--output-format", "json").stdout)["bars"]
        self.assertEqual([(b["birth_cell"], b["death_cell"]) for b in bars],
                         [({"grid": [0, 0]}, None), ({"grid": [0, 4]}, {"grid": [0, 3]})])
        self.write("edge.phat", "0\n0\n1 0 1\n")
        bars = json.loads(self.expect(0, "edge.phat", "--format", "phat", "--output-format",
                                      "json").stdout)["bars"]
        self.assertEqual([(b["birth_cell"], b["death_cell"]) for b in bars],
                         [({"row": 0}, None), ({"row": 1}, {"row": 2})])

    def test_dipha(self):
        self.expect(0, "square.txt", "-o", "out.dipha", "--threshold", "1.3")
        data = self.read_bytes("out.dipha")
        self.assertEqual(struct.unpack("<3q", data[:24]), (8067171840, 2, 5))
        self.assertEqual(struct.unpack("<q2d", data[-24:]), (-2, 1.25, 1.3))

    def test_npy(self):
        self.expect(0, "square.txt", "-o", "out.npy")
        data = self.read_bytes("out.npy")
        length = struct.unpack("<H", data[8:10])[0]
        self.assertEqual((10 + length) % 64, 0)
        self.assertIn(b"(5, 3)", data[:10 + length])
        self.assertEqual(struct.unpack("<3d", data[-24:]), (1, 1.25, math.sqrt(2)))

    def test_format_follows_the_extension(self):
        self.expect(0, "square.txt", "-o", "OUT.CSV")
        self.assertEqual(self.read("OUT.CSV"), SQUARE_CSV)
        self.expect(0, "square.txt", "-o", "out.csv", "--output-format", "pers")
        self.assertTrue(self.read("out.csv").startswith("0 0 1\n"))

    def test_merge_tree(self):
        self.expect(0, "square.txt", "--plot", "t.svg", "--plot", "b.svg", "--plot-kind", "tree",
                    "--plot-kind", "barcode")
        self.assertIn("Merge tree: 4 classes of", self.read("t.svg"))
        self.assertIn("Barcode: 4 bars", self.read("b.svg"))
        self.write("ring.pgm", "P2\n3 3\n9\n0 1 2 1 9 3 2 3 0\n")
        self.expect(0, "ring.pgm", "--plot", "r.svg", "--plot-kind", "tree")
        self.assertIn("Merge tree: 2 classes of", self.read("r.svg"))

    def test_no_merge_tree(self):
        run = self.expect(64, "square.txt", "--subsample", "3", "-o", "s.csv", "--plot", "t.svg", "--quiet",
                          "--plot-kind", "tree")
        self.assertIn("square.txt has no merge tree", run.stderr)
        self.assertFalse(os.path.exists(self.path("t.svg")) or os.path.exists(self.path("s.csv")))

    def test_plots(self):
        self.expect(0, "square.txt", "--plot", "a.svg", "--plot", "b.svg", "--plot-kind", "diagram",
                    "--plot-kind", "betti", "--output-format", "none")
        self.assertIn("<desc>Persistence diagram", self.read("a.svg"))
        self.assertIn("<desc>Betti curves", self.read("b.svg"))
        for name in ("a.svg", "b.svg"):
            xml.dom.minidom.parseString(self.read(name))


class Ripser(ProgramTest):
    @unittest.skipUnless(shutil.which("ripser"), "the program ripser is not installed")
    def test_intervals_are_those_that_ripser_prints(self):
        def intervals(text):
            lines = text.splitlines()
            start = next(i for i, line in enumerate(lines) if line.startswith("persistence"))
            blocks = []
            for line in lines[start:]:
                if line.startswith("persistence"):
                    blocks.append([line])
                else:
                    blocks[-1].append(line)
            return [[block[0]] + sorted(block[1:]) for block in blocks]

        random.seed(5)
        # The distances are whole numbers, because Ripser computes in single precision.
        rows = [" ".join(str(random.randint(1, 999)) for _ in range(i)) for i in range(1, 40)]
        self.write("lower.txt", "\n".join(rows) + "\n")
        for extra in ([], ["--threshold", "300"], ["--threshold", "150"]):
            theirs = subprocess.run(["ripser", "--format", "lower-distance", "--dim", "2", *extra,
                                     "lower.txt"], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(theirs.returncode, 0)
            ours = self.expect(0, "lower.txt", "--format", "lower-distance", "--max-dim", "2",
                               "--output-format", "ripser", *extra)
            self.assertEqual(intervals(ours.stdout), intervals(theirs.stdout), extra)


if __name__ == "__main__":
    main()
