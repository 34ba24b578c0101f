# SPDX-License-Identifier: MIT
"""ph-segment --report: compares the page with the other outputs, and its cuts with ph-segment
--cut.

segment_report.py PH_SEGMENT

The environment variable PH_TEST_DATA names the folder of the optional test data.

"""
import csv
import hashlib
import json
import math
import os
import random
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import program  # noqa: E402
from program import ProgramTest, has_page, main  # noqa: E402
from report_reader import NONE, Report  # noqa: E402
from room import room  # noqa: E402

TEST_DATA = os.environ.get("PH_TEST_DATA", "")
SCENE = os.path.abspath(os.path.join(TEST_DATA, "scenes/test57.pcd"))  # many parts that touch


def table_scene(width=64, height=48):
    """A binary, organised PCD file: a plane with two boxes, a hole, colours and ground truth."""
    rng = random.Random(1)
    records = []
    for v in range(height):
        for u in range(width):
            box = 1 if 10 <= u < 26 and 12 <= v < 30 else 2 if 26 <= u < 44 and 16 <= v < 34 else 0
            z = (1.0, 0.9, 0.86)[box] + 0.0005 * rng.random()
            if (u, v) == (3, 3):
                z = math.nan
            x, y = (u - width / 2) * 0.008 * z, (v - height / 2) * 0.008 * z
            records.append(struct.pack("<fffIB", x, y, z, u << 16 | v << 8 | box, box))
    header = ("VERSION 0.7\nFIELDS x y z rgba label\nSIZE 4 4 4 4 1\nTYPE F F F U U\n"
              f"COUNT 1 1 1 1 1\nWIDTH {width}\nHEIGHT {height}\nVIEWPOINT 0 0 0 1 0 0 0\n"
              f"POINTS {width * height}\nDATA binary\n")
    return header.encode() + b"".join(records)


def hidden_scene(width=320, height=240):
    """A binary, organised PCD file: a table, a box, and a post in front that hides the box's
    middle."""
    records = []
    for v in range(height):
        for u in range(width):
            is_post, is_box = 150 <= u < 166 and 60 <= v < 200, 100 <= u < 220 and 90 <= v < 160
            z = 0.8 if is_post else 0.9 if is_box else 1.0
            x, y = (u - width / 2) * 0.002 * z, (v - height / 2) * 0.002 * z
            records.append(struct.pack("<fff", x, y, z))
    header = ("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
              f"WIDTH {width}\nHEIGHT {height}\nVIEWPOINT 0 0 0 1 0 0 0\n"
              f"POINTS {width * height}\nDATA binary\n")
    return header.encode() + b"".join(records)


class Reports(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("scene.pcd", table_scene())
        if not has_page(program.PROGRAM):
            run = self.expect(69, "scene.pcd", "--report", "r.html")
            self.assertIn("not built in", run.stderr)
        self.require_page()

    def labels(self, *arguments):
        self.expect(0, *arguments, "--labels", "l.csv", "--quiet")
        return [int(line) for line in self.read("l.csv").split()]

    def expect_answer(self, scene, *options):
        """Checks that the page, as it is first shown, has the labels, surfaces and descriptions of
        the other outputs."""
        own = self.labels(scene, *options, "--report", "r.html", "--surfaces", "s.csv", "--json",
                          "s.json")
        report, summary = Report(self.path("r.html")), json.loads(self.read("s.json"))
        labels, surfaces = report.answer(len(own))
        self.assertEqual(labels, own)
        if not scene.endswith(".tree"):  # a stored tree has no points of removed surfaces
            self.assertEqual(surfaces, [int(line) for line in self.read("s.csv").split()])
        self.assertEqual([s["role"] for s in report.meta["scene"]["surfaces"]],
                         [s["role"] for s in summary["surfaces"]])
        said = [(s["number"], s["role"], s["persistence"], s.get("on_surface"),
                 s.get("on_segment")) for s in report.meta["scene"]["segments"]]
        on = [s["on"] or {} for s in summary["segments"]]
        self.assertEqual(said, [(s["label"], s["role"], s["persistence"], o.get("surface"),
                                 o.get("segment")) for s, o in zip(summary["segments"], on)])
        return report

    def expect_cuts(self, scene, options, cuts):
        """Checks that, at some cuts, the page and the program give every point the same segment."""
        report = self.expect_answer(scene, *options)
        tree = report.meta["tree"]
        points = len(self.read("l.csv").split())
        counts = set()
        for cut in cuts:
            words = [w.replace("{cut}", repr(cut)) for w in tree["command"][1:]]
            words[-1] = "l.csv"
            self.expect(0, *words, "--quiet")
            expected = [int(line) for line in self.read("l.csv").split()]
            self.assertEqual(report.point_labels(cut, points), expected, f"{options} {cut}")
            counts.add(max(expected))
        return report, counts

    def test_every_cut_of_a_small_scene(self):
        for options in (["--min-part", "5", "--min-size", "3"], ["--method", "paper"],
                        ["--method", "paper", "--voxel", "0.012", "--distance", "0.03",
                         "--steps", "exact"],
                        ["--supervoxels", "0.03", "--min-size", "2"]):
            cuts = (0.0, 0.005, 0.011, 0.02) if "paper" in options else (0.0, 0.003, 0.05, 0.4)
            self.expect_cuts("scene.pcd", options, cuts)

    def test_every_cut_of_a_real_scene(self):
        if not TEST_DATA or not os.path.exists(SCENE):
            self.skipTest(f"PH_TEST_DATA, which is {TEST_DATA!r}, has no scenes/test57.pcd")
        report, counts = self.expect_cuts(SCENE, [], (0.0, 1.0, 5.0, 15.0, 30.0))
        self.assertGreaterEqual(len(counts), 3)
        self.assertLess(os.path.getsize(self.path("r.html")), 5_000_000)
        _, counts = self.expect_cuts(SCENE, ["--method", "paper", "--distance", "0.03"],
                                     (0.01, 0.02, 0.03))
        self.assertGreaterEqual(len(counts), 2)

    def test_roles_surfaces_and_every_cut_of_a_room(self):
        self.write("room.pcd", room())
        options = ["--max-range", "3", "--min-part", "40", "--min-persistence", "0.5"]
        report, counts = self.expect_cuts("room.pcd", options, (0.0, 0.3, 1.0, 8.0, 60.0))
        self.assertEqual(counts, {2, 3})
        scene = report.meta["scene"]
        self.assertEqual([s["role"] for s in scene["surfaces"]], ["support", "wall", "shelf", "wall"])
        self.assertEqual((scene["removed"], scene["objects"]), (3, True))
        self.assertEqual([(s.get("on_surface"), s.get("on_segment")) for s in scene["segments"]],
                         [(1, None), (1, None), (None, 1)])
        self.assertEqual(set(report["tree/leaf_surface"]), {0, 4})
        self.assertEqual(set(report["points/surface"]), {0, 1, 2, 3})

    def test_an_answer_that_no_cut_of_the_tree_gives(self):
        self.write("hidden.pcd", hidden_scene())
        report = self.expect_answer("hidden.pcd")
        tree = report.meta["tree"]
        labels, _ = report.answer(320 * 240)
        self.assertEqual(max(labels), 2)
        self.assertEqual(max(report.point_labels(tree["cut"], 320 * 240)), 3)
        command = [w.replace("{cut}", "1") for w in tree["command"][1:]]
        self.assertEqual(command[-4:-2], ["1", "--parts"])
        self.expect(0, *command[:-1], "l.csv", "--quiet")
        self.assertEqual([int(line) for line in self.read("l.csv").split()],
                         report.point_labels(tree["cut"], 320 * 240))

    def test_a_stream_has_the_numbers_and_colours_of_its_objects(self):
        self.write("a.pcd", room(seed=1))
        self.write("b.pcd", table_scene())
        self.write("c.pcd", room(seed=2))
        self.expect(0, "a.pcd", "b.pcd", "c.pcd", "--report", "all/", "--json", "all.jsonl",
                    "--stable-labels", "--max-range", "3", "--min-part", "40", "--quiet")
        palette = ["#e69f00", "#0072b2", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442"]
        numbers = set()
        for name, line in zip("abc", self.read("all.jsonl").splitlines()):
            said = Report(self.path(f"all/{name}.html")).meta["scene"]["segments"]
            expected = [s["label"] for s in json.loads(line)["segments"]]
            self.assertEqual([s["number"] for s in said], expected, name)
            self.assertEqual([s["colour"] for s in said], [palette[(n - 1) % 7] for n in expected])
            numbers.update(expected)
        self.assertGreater(max(numbers), 3)

    def test_points_are_those_of_the_input(self):
        self.expect(0, "scene.pcd", "--report", "r.html", "--json", "s.json")
        report, scene = Report(self.path("r.html")), table_scene()
        step = struct.calcsize("<fffIB")
        start = scene.index(b"DATA binary\n") + 12
        points = [struct.unpack_from("<fffIB", scene, start + i * step) for i in range(64 * 48)]
        kept = [i for i, p in enumerate(points) if not math.isnan(p[2])]
        self.assertEqual(report["points/index"], kept)
        self.assertEqual(report.arrays["points/rgb"].rows(),
                         [(points[i][3] >> 16, points[i][3] >> 8 & 255, points[i][3] & 255)
                          for i in kept])
        self.assertEqual(report["points/truth"], [points[i][4] for i in kept])
        for i, place in zip(kept, report.arrays["points/position"].rows()):
            for a, b in zip(points[i], place):
                self.assertAlmostEqual(a, b, delta=2e-5)
        summary = json.loads(self.read("s.json"))
        self.assertEqual(report.meta["tree"]["min_size"], summary["cut"]["min_size"])
        self.assertEqual(sum(report["tree/leaf_vertices"]), summary["complex"]["vertices"])
        self.assertEqual(len(report["points/normal"]), 2 * len(kept))

    def test_bars_are_those_of_a_length(self):
        self.expect(0, "scene.pcd", "--report", "r.html", "--barcode", "b.csv")
        bars = [(int(r["dim"]), float(r["birth"]), float(r["death"]))
                for r in csv.DictReader(self.read("b.csv").splitlines())]
        report = Report(self.path("r.html"))
        self.assertEqual(report.bars(), [b for b in bars if b[2] > b[1]])
        index = set(report["points/index"])
        self.assertTrue(index.issuperset(report["bars/birth_cells"]))
        self.assertEqual(len(report["bars/death_cells"]),
                         2 * sum(b[2] < math.inf for b in report.bars()))

    def test_each_branch_has_its_bar(self):
        self.expect(0, "scene.pcd", "--report", "r.html", "--min-part", "2")
        report = Report(self.path("r.html"))
        bars = report.bars()
        for bar, value, level in zip(report["tree/merge_bar"], report["tree/merge_value"],
                                     report["tree/merge_level"]):
            if level > 0:
                self.assertEqual((bars[bar][2], bars[bar][2] - bars[bar][1]), (value, level))
            else:
                self.assertEqual(bar, NONE)
        named = [b for b in report["tree/merge_bar"] if b != NONE]
        named += [b for _, b in report.arrays["tree/leaf_bar"].rows()]
        self.assertEqual(sorted(named), list(range(len(bars))))

    def test_a_stored_tree_has_a_report_too(self):
        self.labels("scene.pcd", "--tree", "s.tree")
        report = self.expect_answer("s.tree")
        self.assertEqual(report.meta["tree"]["command"][:2], ["ph-segment", "s.tree"])
        self.assertNotIn("points/rgb", report)

    def test_where_it_comes_from(self):
        self.expect(0, "scene.pcd", "--report", "r.html", "--method=paper", "--cut", "0.02",
                    "--json", "s.json", "--quiet", "--no-check", "--plane", "off")
        report = Report(self.path("r.html"))
        self.assertEqual(report.meta["tree"]["command"],
                         ["ph-segment", "scene.pcd", "--plane", "off", "--method", "paper",
                          "--no-check", "--cut", "{cut}", "--labels", "labels.npy"])
        p = report.meta["provenance"]
        self.assertEqual(p["command"][:4], ["ph-segment", "scene.pcd", "--report", "r.html"])
        self.assertEqual(p["input"]["sha256"], hashlib.sha256(table_scene()).hexdigest())
        self.assertEqual(p["input"]["description"], "3072 points, 64 x 48")
        self.assertEqual(report.meta["tree"]["cut"], 0.02)
        self.assertEqual(report.meta["tree"]["to"], 0.025)
        self.assertEqual(p["notes"]["Cross-check"], "skipped")
        self.assertEqual(report.meta["cloud"]["viewpoint"], [0, 0, 0])

    def test_a_stream_has_a_report_a_frame(self):
        self.write("other.pcd", table_scene())
        self.expect(0, "scene.pcd", "other.pcd", "--report", "all/", "--quiet")
        self.assertEqual(sorted(os.listdir(self.path("all"))), ["other.html", "scene.html"])
        report = Report(self.path("all/other.html"))
        self.assertEqual(report.meta["tree"]["command"][1], "other.pcd")

    def test_a_cloud_that_is_empty_or_only_holes(self):
        self.write("e.xyz", "nan nan nan\nnan nan nan\n")
        self.expect(0, "e.xyz", "--report", "r.html")
        report = Report(self.path("r.html"))
        self.assertEqual(report.bars(), [])
        self.assertEqual(report.arrays["points/position"].shape, [0, 3])

    def test_what_goes_wrong_leaves_nothing(self):
        before = self.files()
        self.expect(64, "scene.pcd", "--report", "r.txt")
        self.expect(73, "scene.pcd", "--report", "no/such/r.html")
        self.expect(66, "none.pcd", "--report", "r.html")
        self.assertEqual(self.files(), before)


if __name__ == "__main__":
    main()
