# SPDX-License-Identifier: MIT
"""ph-barcode with stored barcodes: drawing, converting, comparing. Also tests pictures of several
inputs."""
import json
import math
import os
import re
import struct
import sys
import xml.etree.ElementTree
from random import Random

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import SQUARE, SQUARE_CSV, ProgramTest, files, main  # noqa: E402

FORMATS = ("csv", "json", "ripser", "pers", "dipha", "npy")
SVG = "{http://www.w3.org/2000/svg}"


class Stored(ProgramTest):
    def texts(self, name):
        """The texts in a picture."""
        root = xml.etree.ElementTree.parse(self.path(name)).getroot()
        return [text.text for text in root.iter(SVG + "text")]

    def bars(self, *arguments):
        lines = self.expect(0, *arguments, "--quiet").stdout.splitlines()[1:]
        return [tuple(map(float, line.split(","))) for line in lines]

    def store(self, *arguments):
        """Writes the barcode of the square in each format."""
        for form in FORMATS:
            self.expect(0, "square.txt", "-o", f"bars.{form}", *arguments)

    def test_every_format_is_drawn_alike(self):
        self.store()
        for kind in ("barcode", "diagram", "betti"):
            self.expect(0, "square.txt", "--plot", "direct.svg", "--plot-kind", kind,
                        "--output-format", "none")
            for form in FORMATS:
                if form == "ripser":  # this format has only six digits
                    continue
                run = self.expect(0, "plot", f"bars.{form}", "-o", f"{form}.svg", "--plot-kind", kind)
                self.assertEqual(run.stdout, "")
                self.assertEqual(run.stderr, f"ph-barcode: read bars.{form}: a barcode, 5 bars\n")
                self.assertEqual(self.read(f"{form}.svg"), self.read("direct.svg"), (form, kind))

    def test_what_can_be_nothing_else_needs_no_word(self):
        self.store()
        for form in ("csv", "json", "dipha", "pers"):
            run = self.expect(0, f"bars.{form}", "--plot", "d.svg")
            self.assertEqual(run.stdout, SQUARE_CSV)
            self.assertIn("a barcode, 5 bars", run.stderr)
        self.assertIn("a barcode, 5 bars", self.expect(0, "bars.ripser").stderr)
        # Files with rows of numbers are still points or an image.
        self.write("rows.csv", "0,0,1\n1,0.5,2\n")
        self.assertIn("points in R^3", self.expect(0, "rows.csv").stderr)
        self.assertNotIn("a barcode", self.run_program("bars.npy").stderr)
        # With --format, a file is read in the format that the user states.
        self.assertNotIn("a barcode", self.run_program("bars.csv", "--format", "points").stderr)

    def test_converted(self):
        self.store()
        for source in ("csv", "json", "pers", "dipha", "npy"):
            for form in ("csv", "pers", "dipha", "npy"):
                self.expect(0, "plot", f"bars.{source}", "-o", f"again.{form}", "--output-format",
                            form)
                self.assertEqual(self.read_bytes(f"again.{form}"), self.read_bytes(f"bars.{form}"),
                                 (source, form))

    def test_json_keeps_what_it_says(self):
        def members(name):
            return json.loads(self.read(name))
        for options in (["--field", "3", "--max-dim", "2", "--threshold", "1.5", "--dtm", "2"],
                        ["--core", "1"], ["--subsample", "3", "--representatives", "cocycles"],
                        ["--approximate", "0.5"],
                        ["--complex", "cubical", "--voxel", "0.5"],
                        ["--complex", "cubical", "--voxel", "0.5", "--representatives", "voxels"],
                        ["--representatives", "cycles"], ["--significance"]):
            self.expect(0, "square.txt", *options, "-o", "a.json")
            run = self.expect(0, "a.json", "-o", "b.json")
            self.assertNotIn("not kept", run.stderr)
            self.assertEqual(members("a.json"), members("b.json"), options)
        self.write("x.json", self.read("a.json").replace('"bars":', '"colours": 3, "bars":'))
        run = self.expect(0, "x.json", "-o", "b.json")
        self.assertIn("x.json: not kept: colours\n", run.stderr)
        self.assertNotIn("not kept", self.expect(0, "x.json", "-o", "b.csv").stderr)
        # Other formats do not state the origin of the bars.
        self.expect(0, "b.csv", "-o", "c.json")
        self.assertEqual(members("c.json")["input"],
                         {"path": "b.csv", "description": "a barcode, 5 bars"})
        for name in ("complex", "field", "max_dim", "threshold", "engine"):
            self.assertNotIn(name, members("c.json"))

    def test_a_file_by_the_name_of_plot(self):
        self.write("plot", SQUARE)
        self.assertEqual(self.expect(0, "plot").stdout, SQUARE_CSV)
        self.assertEqual(self.expect(0, "./plot").stdout, SQUARE_CSV)

    def test_refused(self):
        self.store()
        for arguments, what in (
                (("plot",), "INPUT is missing"), (("plot", "bars.csv"), "-o FILE.svg"),
                (("bars.csv", "--metric", "manhattan"), "--metric"),
                (("bars.csv", "--max-dim", "1"), "--max-dim"),
                (("plot", "bars.csv", "-o", "x.svg", "--superlevel"), "--superlevel"),
                (("plot", "bars.csv", "-o", "x.svg", "--plot-kind", "tree"), "tree"),
                (("plot", "bars.csv", "-o", "x.svg", "--output-format", "json"), "--plot x.svg"),
                (("plot", "bars.csv", "-o", "x.png", "--output-format", "csv"), "--plot x.png"),
                (("plot", "bars.csv", "-o", "x.gif"), "--output: found 'x.gif'"),
                (("plot", "bars.csv", "-o", "q.csv"), "expected FILE.svg or FILE.png"),
                (("square.txt", "-o", "x.svg"), "--plot x.svg draws the barcode"),
                (("square.txt", "-o", "x.PNG"), "--plot x.PNG draws the barcode"),
                (("--compare", "bars.csv"), "--compare: found 1, expected two barcodes"),
                (("--compare", *["bars.csv"] * 3), "--compare: found 3, expected two barcodes"),
                (("bars.csv", "--max-dim", "1"), "makes sense for a computation only")):
            self.assertIn(what, self.expect(64, *arguments).stderr)
        self.assertNotIn("--plot", self.expect(64, "plot", "bars.csv", "-o", "x.gif").stderr)
        self.expect(65, "plot", "square.txt", "-o", "x.svg")
        self.assertNotIn("x.svg", self.files())

    def test_a_picture_and_no_barcode(self):
        self.store()
        self.expect(0, "plot", "bars.csv", "-o", "x.svg", "--output-format", "none")
        self.assertTrue(self.texts("x.svg"))
        self.assertEqual(self.expect(0, "plot", "bars.csv", "--plot", "x.svg", "--output-format",
                                     "csv").stdout, SQUARE_CSV)

    def test_too_large_for_the_memory(self):
        rows = [x for i in range(200_000) for x in (0, 0, 1 + i)]
        self.write("big.npy", files.array((200_000, 3), rows))
        run = self.expect(75, "plot", "big.npy", "-o", "x.svg", "--memory-limit", "1MiB")
        self.assertIn("use fewer bars, or raise --memory-limit", run.stderr)
        for option in ("--max-dim", "--subsample", "--threshold"):
            self.assertNotIn(option, run.stderr)

    def test_pictures_of_a_batch(self):
        self.write("pair.txt", "0 0\n3 4\n")
        both = ("square.txt", "pair.txt")
        self.expect(0, *both, "--plot", "pictures/")
        self.assertEqual(sorted(os.listdir(self.path("pictures"))), ["pair.svg", "square.svg"])
        self.expect(0, *both, "-o", "out/", "--plot", "pictures/*-d.svg", "--plot-kind", "diagram")
        self.assertEqual(sorted(os.listdir(self.path("out"))), ["pair.csv", "square.csv"])
        self.expect(0, "square.txt", "--plot", "alone.svg", "--plot-kind", "diagram", "--quiet")
        self.assertEqual(self.read("pictures/square-d.svg"), self.read("alone.svg"))
        self.assertIn("FOLDER/", self.expect(64, *both, "--plot", "x.svg").stderr)
        self.expect(0, *both, "-o", "named/*.pers")
        self.assertEqual(sorted(os.listdir(self.path("named"))), ["pair.pers", "square.pers"])
        # For a single input, * in an output name stands for the name of the input as well.
        self.expect(0, "pair.txt", "-o", "one/*.json", "--plot", "*-one.svg")
        self.assertEqual(os.listdir(self.path("one")), ["pair.json"])
        self.assertIn("pair-one.svg", self.files())
        self.expect(0, "plot", "out/pair.csv", "out/square.csv", "-o", "again/")
        self.assertEqual(sorted(os.listdir(self.path("again"))), ["pair.svg", "square.svg"])

    def test_a_folder_is_its_files(self):
        os.mkdir(self.path("in"))
        for name in ("b.txt", "a.csv", "notes.md", "c.npy"):
            self.write(f"in/{name}", files.array((2, 2), [0, 1, 2, 3]) if name == "c.npy" else SQUARE)
        run = self.expect(0, "in", "-o", "out/")
        self.assertEqual([line.split(":")[1].strip() for line in run.stderr.splitlines()],
                         ["in/a.csv", "in/b.txt", "in/c.npy"])
        self.assertEqual(sorted(os.listdir(self.path("out"))), ["a.csv", "b.csv", "c.csv"])
        os.mkdir(self.path("empty"))
        self.assertIn("a folder without", self.expect(66, "empty", "-o", "out/").stderr)
        run = self.expect(66, "in")
        for words in ("in: it is a directory", "-o FOLDER/", "--plot FOLDER/"):
            self.assertIn(words, run.stderr)

    def test_compare(self):
        self.write("a.csv", "dim,birth,death\n0,0,1\n0,0,inf\n1,1,2\n")
        self.write("b.csv", "dim,birth,death\n0,0,1.5\n0,0,inf\n1,1,2\n1,3,3.5\n2,0,inf\n")
        pair = ("--compare", "a.csv", "b.csv")
        run = self.expect(0, *pair)
        self.assertEqual(run.stdout, "bottleneck distance (order inf, ground norm inf) of a.csv and b.csv\n"
                         "H0  0.5\nH1  0.25\nH2  inf: 0 and 1 bars that never die\n")
        self.assertEqual(self.expect(0, *pair, "--output-format", "csv").stdout,
                         "dim,bottleneck\n0,0.5\n1,0.25\n2,inf\n")
        self.expect(0, *pair, "-o", "d.json")
        distances = json.loads(self.read("d.json"))
        self.assertEqual(distances["inputs"], ["a.csv", "b.csv"])
        self.assertEqual([(d["dim"], d["bottleneck"]) for d in distances["distances"]],
                         [(0, 0.5), (1, 0.25), (2, None)])
        self.assertEqual(self.expect(0, *pair, "--output-format", "none").stdout, "")
        run = self.expect(0, *pair, "--output-format", "none", "-o", "x.csv")
        self.assertIn("--output-format none ignores --output x.csv", run.stderr)
        self.assertNotIn("x.csv", self.files())
        run = self.expect(64, *pair, "-o", "d.npy")
        self.assertIn("--output: found d.npy", run.stderr)
        self.assertNotIn("--output-format", run.stderr)
        for arguments in (("--output-format", "npy"), ("--plot", "x.svg"), ("--metric", "hamming"),
                          ("--max-dim", "1")):
            self.assertIn(arguments[0], self.expect(64, *pair, *arguments).stderr)

    def test_compare_says_what_was_computed_in_another_way(self):
        self.write("p.txt", "0 0\n1 0\n0 1\n")
        self.expect(0, "p.txt", "-o", "a.json", "--quiet")
        self.expect(0, "p.txt", "--threshold", "9", "-o", "same.json", "--quiet")
        self.expect(0, "p.txt", "--max-dim", "2", "--field", "3", "-o", "b.json", "--quiet")
        self.write("c.csv", "dim,birth,death\n0,0,1\n")
        self.assertIn("b.json was not computed in the same way as a.json: field 3, not 2; max_dim 2, not 1",
                      self.expect(0, "--compare", "a.json", "b.json").stderr)
        for other in ("same.json", "c.csv"):
            self.assertNotIn("was not computed", self.expect(0, "--compare", "a.json", other).stderr)
        for options, words in ((["--metric", "chebyshev", "--min-persistence", "0.5"],
                                "metric chebyshev, not euclidean; min_persistence 0.5, not 0"),
                               (["--complex", "cubical", "--voxel", "1"],
                                "complex cubical, not rips; max_dim 2, not 1")):
            self.expect(0, "p.txt", *options, "-o", "o.json", "--quiet")
            self.assertIn(f"o.json was not computed in the same way as a.json: {words}\n",
                          self.expect(0, "--compare", "a.json", "o.json").stderr)
        self.write("m.npy", files.array((2, 3), [5, 1, 4, 1, 3, 2]))
        self.expect(0, "m.npy", "-o", "v.json", "--quiet")
        self.expect(0, "m.npy", "--construction", "cells", "--periodic", "0,1", "-o", "t.json",
                    "--quiet")
        self.assertIn("t.json was not computed in the same way as v.json: construction cells, not vertices; "
                      "periodic axes 0, 1, not none\n",
                      self.expect(0, "--compare", "v.json", "t.json").stderr)

    def test_the_report_of_a_comparison_is_a_file(self):
        self.require_page()
        self.write("a.csv", "dim,birth,death\n0,0,1\n")
        for arguments in ((), ("--output-format", "json")):
            run = self.expect(64, "--compare", "a.csv", "a.csv", "--report", "-", *arguments)
            self.assertIn("--report", run.stderr)

    def test_compare_says_what_it_leaves_out(self):
        self.write("a.csv", "dim,birth,death\n0,0,1\n")
        self.write("many.csv", "dim,birth,death\n" + "1,0,1\n" * 40_001)
        for output in ([], ["--output-format", "csv"], ["--output-format", "json"]):
            run = self.expect(0, "--compare", "a.csv", "many.csv", *output)
            self.assertIn("left out: H1: 40001 bars; at most 40000", run.stderr)

    def test_looks(self):
        self.write("bars.csv", "dim,birth,death\n0,0,1\n0,0,inf\n0,5,6\n1,1,100\n")
        draw = ("plot", "bars.csv", "-o", "x.svg")
        self.expect(0, *draw, "--dims", "1", "--title", "a < b & \"c\"")
        self.assertEqual([t for t in self.texts("x.svg") if t.startswith("H")], ["H₁"])
        self.assertIn('a < b & "c"', self.texts("x.svg"))
        self.assertIn("a &lt; b &amp; &quot;c&quot;", self.read("x.svg"))
        self.assertNotIn("--dims", self.expect(0, *draw, "--dims", "0,1").stderr)
        self.assertIn("--dims 3: there are no bars", self.expect(0, *draw, "--dims", "1,3").stderr)
        self.expect(0, *draw, "--axis", "0,2")
        self.assertIn("2.0", self.texts("x.svg"))
        self.assertIn("1 beyond", self.texts("x.svg"))  # the bar [5, 6)
        self.expect(0, *draw, "--axis", "log")
        self.assertTrue({"1", "10", "100"} <= set(self.texts("x.svg")), self.texts("x.svg"))
        self.expect(0, *draw, "--size", "640x480")
        self.assertIn('width="640" height="480"', self.read("x.svg"))
        self.expect(0, "plot", "bars.csv", "-o", "x.png", "--size", "640x480")
        self.assertEqual(struct.unpack(">II", self.read_bytes("x.png")[16:24]), (640, 480))
        for option, value in (("--size", "640"), ("--size", "0x1"), ("--size", "1x20000"),
                              ("--axis", "2,1"), ("--axis", "0,1,log"), ("--axis", "0"),
                              ("--axis", "0,inf"), ("--dims", "-1"), ("--dims", "x")):
            self.assertIn(option, self.expect(64, *draw, option, value).stderr)
        for option, value in (("--size", "9x9"), ("--title", "x"), ("--axis", "log")):
            self.assertIn("needs --plot", self.expect(64, "square.txt", option, value).stderr)
        self.assertIn("--dims: found no output with bars", self.expect(
            64, "square.txt", "--plot", "t.svg", "--plot-kind", "tree", "--output-format", "none",
            "--dims", "1").stderr)

    def test_places_of_voxels(self):
        """A table of sets of voxels says where they are, in space if the file does."""
        self.write("v.npy", files.array((3, 4), [4, 1, 5, 9, 2, 7, 3, 9, 5, 0, 5, 9]))
        rows = self.expect(0, "v.npy", "--representatives", "voxels", "--max-dim", "0").stdout
        self.assertEqual(rows.splitlines(), [
            "dim,birth,death,birth_0,birth_1,death_0,death_1,centroid_0,centroid_1,voxels",
            "0,0,inf,2,1,,,1,1.5,12", "0,1,5,0,1,2,0,0.3333333333333333,0.3333333333333333,3",
            "0,2,4,1,0,0,0,1,0,1",
            "0,3,5,1,2,0,2,1,2,1"])
        self.write("rows.csv", rows)
        again = self.expect(0, "rows.csv")
        self.assertEqual(again.stdout, "".join(",".join(row.split(",")[:3]) + "\n"
                                               for row in rows.splitlines()))
        self.expect(0, "v.npy", "--representatives", "voxels", "-o", "v.json")
        self.assertEqual(self.expect(0, "v.json", "--dims", "0").stdout, rows)
        self.assertIn("expected json, or csv for a table of places", self.expect(
            64, "v.npy", "--representatives", "voxels", "--output-format", "npy").stderr)

    def test_places_of_cycles(self):
        """A table of cycles of points says where they are, as the mean of their cells."""
        self.write("far.txt", "10 20\n11 20\n11 21\n10 21\n")
        cycles = ("--representatives", "cycles", "--min-dim", "1")
        rows = self.expect(0, "far.txt", *cycles).stdout
        self.assertEqual(rows, "dim,birth,death,centroid_0,centroid_1\n1,1,1.4142135623730951,10.5,20.5\n")
        self.write("rows.csv", rows)
        self.assertEqual(self.expect(0, "rows.csv").stdout, "dim,birth,death\n1,1,1.4142135623730951\n")
        self.write("nan.txt", "nan 0\n10 20\n11 20\n11 21\n10 21\n")
        self.assertEqual(self.expect(0, "nan.txt", *cycles, "--nan", "drop").stdout, rows)
        both = self.expect(0, "far.txt", "--representatives", "cycles").stdout.splitlines()
        self.assertEqual(both[1:5], ["0,0,1,,", "0,0,1,,", "0,0,1,,", "0,0,inf,,"])
        chosen = self.expect(0, "far.txt", "--representatives", "cycles", "--dims", "1").stdout
        self.assertEqual(chosen, rows)
        self.write("long.txt", "".join(" ".join(["0"] * 11 + [x]) + "\n" for x in "12"))
        rows = self.expect(0, "long.txt", "--representatives", "cycles", "--max-dim", "0").stdout
        self.assertTrue(rows.splitlines()[0].endswith("centroid_10,centroid_11"))
        self.write("rows.csv", rows)
        self.assertEqual(len(self.expect(0, "rows.csv").stdout.splitlines()), 3)
        for options in (("--representatives", "cocycles"), ("--representatives", "cycles", "-o", "x.npy")):
            self.expect(64, "far.txt", *options)
        self.write("v.npy", files.array((3, 4), [4, 1, 5, 9, 2, 7, 3, 9, 5, 0, 5, 9]))
        self.assertIn("whose cycles have no places", self.expect(
            64, "v.npy", "--representatives", "cycles").stderr)

    def test_dimensions(self):
        """--dims chooses the bars that are written, in every format, with all their data."""
        def of_dim(text, dim):
            return [line for line in text.splitlines()[1:] if line.startswith(f"{dim},")]
        random = Random(3)
        self.write("cube.npy", files.array((5, 5, 5), [random.random() for _ in range(125)]))
        everything = self.expect(0, "cube.npy").stdout
        for dim in "012":
            rows = of_dim(everything, dim)
            self.assertTrue(rows)
            self.assertEqual(self.expect(0, "cube.npy", "--dims", dim).stdout.splitlines()[1:], rows)
        self.assertEqual(self.expect(0, "cube.npy", "--dims", "2,0").stdout.splitlines()[1:],
                         of_dim(everything, 0) + of_dim(everything, 2))
        for kind in ("voxels", "cycles", "cocycles"):
            self.expect(0, "cube.npy", "--representatives", kind, "-o", "all.json")
            self.expect(0, "cube.npy", "--representatives", kind, "--dims", "1,2", "-o", "some.json")
            self.expect(0, "all.json", "--dims", "1,2", "-o", "again.json")
            whole, some = json.loads(self.read("all.json")), json.loads(self.read("some.json"))
            self.assertEqual(some["bars"], [bar for bar in whole["bars"] if bar["dim"] > 0], kind)
            self.assertEqual(some["dims"], [1, 2])
            self.assertEqual(json.loads(self.read("again.json"))["bars"], some["bars"], kind)
        note = self.expect(0, "cube.npy", "--dims", "1,5")
        self.assertIn("--dims 5: there are no bars of this dimension", note.stderr)

    def test_pictures_of_superlevel_sets_name_the_values_of_the_image(self):
        self.write("row.npy", files.array((5,), [50, 10, 40, 10, 30]))
        for kind in ("barcode", "diagram", "betti", "tree"):
            run = self.expect(0, "row.npy", "--superlevel", "--plot", "x.svg", "--plot-kind", kind)
            self.assertIn("0,-50,inf", run.stdout)  # files keep the negated values
            numbers = [float(t) for t in self.texts("x.svg") if re.fullmatch("[0-9.]+", t or "")
                       and float(t) >= 10]
            self.assertTrue({50.0, 10.0} & set(numbers), (kind, self.texts("x.svg")))
            self.assertFalse([t for t in self.texts("x.svg") if "−" in t], kind)
            axis = [n for n in numbers if n % 5 == 0][:4]
            self.assertEqual(axis, sorted(axis, reverse=True), kind)

    def test_json_says_that_it_is_of_superlevel_sets(self):
        self.write("row.npy", files.array((5,), [50, 10, 40, 10, 30]))
        for options in ([], ["--axis", "10,50"]):
            for kind in ("barcode", "diagram", "betti"):
                look = ["--plot-kind", kind, *options]
                self.expect(0, "row.npy", "--superlevel", "-o", "a.json", "--plot", "direct.svg",
                            *look)
                self.expect(0, "a.json", "-o", "b.json")
                for name in ("a.json", "b.json"):
                    self.assertIs(json.loads(self.read(name))["superlevel"], True)
                    self.expect(0, "plot", name, "-o", "again.svg", *look)
                    self.assertEqual(self.read("again.svg"), self.read("direct.svg"),
                                     (kind, options))
        self.expect(0, "row.npy", "-o", "a.json")
        self.assertNotIn("superlevel", json.loads(self.read("a.json")))

    def test_json_says_what_the_bars_are_of(self):
        self.write("p.csv", "0,0\n1,0\n0,1\n3,1\n")
        self.write("d.csv", "0,1,2\n1,0,1\n2,1,0\n")
        self.write("m.npy", files.array((3, 4), [5, 1, 4, 1, 3, 2, 9, 0, 1, 1, 7, 2]))
        names = ("metric", "construction", "periodic", "superlevel", "min_persistence", "min_dim")
        for arguments, expected in (
                (["p.csv"], {"metric": "euclidean", "min_persistence": 0}),
                (["p.csv", "--metric", "minkowski:3.5", "--min-persistence", "0.25"],
                 {"metric": "minkowski:3.5", "min_persistence": 0.25}),
                (["p.csv", "--metric", "minkowski:inf", "--min-persistence=-1"],
                 {"metric": "minkowski:inf", "min_persistence": -1}),
                (["p.csv", "--metric", "hamming", "--max-dim", "2", "--min-dim", "1"],
                 {"metric": "hamming", "min_persistence": 0, "min_dim": 1}),
                (["d.csv", "--format", "distance"], {"metric": "precomputed", "min_persistence": 0}),
                (["p.csv", "--complex", "cubical", "--voxel", "0.5"],
                 {"construction": "vertices", "min_persistence": 0}),
                (["m.npy"], {"construction": "vertices", "min_persistence": 0}),
                (["m.npy", "--construction", "cells", "--periodic", "1", "--superlevel"],
                 {"construction": "cells", "periodic": [1], "superlevel": True,
                  "min_persistence": 0}),
                (["m.npy", "--periodic", "all", "--engine", "standard"],
                 {"construction": "vertices", "periodic": [0, 1], "min_persistence": 0})):
            self.expect(0, *arguments, "-o", "a.json")
            self.expect(0, "a.json", "-o", "b.json")
            for name in ("a.json", "b.json"):
                found = json.loads(self.read(name))
                self.assertEqual({n: found[n] for n in names if n in found}, expected, arguments)

    def test_json_of_parts_says_what_that_of_the_whole_says(self):
        self.write("p.csv", "0,0\n1,0\n0,1\n3,1\n")
        self.write("m.npy", files.array((4, 3), [5, 1, 4, 1, 3, 2, 9, 0, 1, 1, 7, 2]))
        for options in (["p.csv", "--complex", "rips", "--max-dim", "0"],
                        ["m.npy", "--construction", "cells", "--periodic", "1", "--superlevel"]):
            self.expect(0, *options, "-o", "whole.json")
            keep = ["--keep-cells"] if options[0] == "m.npy" else []
            for k in (1, 2):
                self.expect(0, *options, *keep, "--part", f"{k}/2", "-o", f"{k}.ph")
            self.expect(0, "--join", "1.ph", "2.ph", "-o", "joined.json")
            whole, joined = (json.loads(self.read(n)) for n in ("whole.json", "joined.json"))
            for name in ("input", "engine", "timings", "peak_memory"):
                del whole[name], joined[name]
            self.assertEqual(joined, whole, options)

    def test_the_axis_of_superlevel_sets_is_of_the_image(self):
        self.write("row.npy", files.array((5,), [50, 10, 40, 10, 30]))
        for kind in ("barcode", "diagram", "betti", "tree"):
            self.expect(0, "row.npy", "--superlevel", "--plot", "x.svg", "--plot-kind", kind,
                        "--axis", "10,50")
            texts = self.texts("x.svg")
            self.assertTrue({"50", "10"} <= set(texts), (kind, texts))
            self.assertFalse([t for t in texts if "beyond" in t], (kind, texts))

    def test_the_tree_of_one_class_begins_at_its_birth(self):
        self.write("one.npy", files.array((2,), [-3, -3]))
        self.expect(0, "one.npy", "--plot", "x.svg", "--plot-kind", "tree")
        ticks = [t.replace("−", "-") for t in self.texts("x.svg") if re.fullmatch("−?[0-9.]+", t)]
        self.assertEqual(min(float(t) for t in ticks), -3)
        self.assertTrue(math.isfinite(float(ticks[-1])))


if __name__ == "__main__":
    main()
