# SPDX-License-Identifier: MIT
"""ph-barcode --report: tests the page as a file, its bars and the origin of the bars, and pages
with two barcodes."""
import hashlib
import json
import math
import os
import random
import sys
import unittest
import xml.dom.minidom

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import SQUARE_CSV, files, main  # noqa: E402
from report_reader import Report  # noqa: E402
from report_test import ReportTest, circle  # noqa: E402


class Reports(ReportTest):
    def test_bars_are_those_of_the_file_in_its_order(self):
        self.write("c.txt", circle(40, 0.2))
        run = self.expect(0, "c.txt", "--report", "r.html", "--max-dim", "2")
        self.assertEqual(Report(self.path("r.html")).bars(), self.bars_of_csv(run.stdout))

    def test_without_scripts_there_is_a_picture(self):
        self.write("<b>&.txt", circle(20))
        text = self.report("<b>&.txt").text
        self.assertEqual(text.count("<noscript>"), 1)
        picture = text[text.index("<noscript>"):text.index("</noscript>")]
        svg = xml.dom.minidom.parseString(picture[picture.index("<svg"):])
        self.assertEqual(svg.getElementsByTagName("title")[0].firstChild.data, "<b>&.txt")
        self.assertFalse(any(e.hasAttribute("style") for e in svg.getElementsByTagName("*")))

    def test_a_report_is_complete_or_absent(self):
        run = self.expect(73, "square.txt", "--report", "missing/r.html", "--quiet")
        self.assertIn("missing/r.html", run.stderr)
        self.write("bad.txt", "0 0\n1\n")
        self.write("r.html", "of yesterday")
        self.expect(65, "bad.txt", "--report", "r.html")
        self.assertEqual(self.read("r.html"), "of yesterday")
        self.expect(0, "square.txt", "--report", "r.html")
        self.assertTrue(self.read("r.html").endswith("</html>\n"))

    @unittest.skipUnless(os.path.exists("/dev/full"), "no /dev/full")
    def test_a_full_disk(self):
        with open("/dev/full", "w") as full:
            run = self.expect(74, "square.txt", "--output-format", "none", "--report", "-",
                              stdout=full)
        self.assertIn("No space", run.stderr)

    def test_cells_and_representatives_are_those_of_the_json(self):
        self.write("c.txt", circle(30, 0.2))
        for field in ("2", "3"):
            report = self.report("c.txt", "--representatives", "cycles", "-o", "c.json",
                                 "--field", field)
            bars = json.loads(self.read("c.json"))["bars"]
            self.assertEqual([(b["dim"], b["birth"], b["death"] or math.inf) for b in bars],
                             report.bars())
            self.assertEqual([v for b in bars for v in b["birth_cell"]["vertices"]],
                             report["bars/birth_cells"])
            self.assertEqual([v for b in bars if b["death_cell"]
                              for v in b["death_cell"]["vertices"]], report["bars/death_cells"])
            terms = [t for b in bars for t in b["representative"]]
            self.assertEqual([v for t in terms for v in t["vertices"]], report["chains/cells"])
            self.assertEqual(report["chains/start"][-1], len(terms))
            self.assertEqual([b for b, _ in enumerate(bars)], report["chains/bar"])
            if field == "3":
                self.assertEqual([t["coefficient"] for t in terms], report["chains/coefficients"])
            else:
                self.assertNotIn("chains/coefficients", report)
            self.assertEqual(report.meta["barcodes"],
                             [{"name": "c.txt", "cells": "vertices", "representatives": "cycles"}])

    def test_representatives_need_no_json(self):
        report = self.report("square.txt", "--representatives", "cocycles")
        self.assertEqual(report.meta["barcodes"][0]["representatives"], "cocycles")

    def test_where_it_comes_from(self):
        report = self.report("square.txt", "--threads", "1", "--field", "3", "--max-dim", "1")
        p = report.meta["provenance"]
        self.assertEqual(p["command"],
                         ["ph-barcode", "square.txt", "--threads", "1", "--field", "3",
                          "--max-dim", "1", "--report", "r.html", "--quiet"])
        self.assertEqual(p["input"]["sha256"], hashlib.sha256(self.read_bytes("square.txt")).hexdigest())
        self.assertIn("4 points in R^2", p["input"]["description"])
        self.assertEqual((p["complex"], p["field"], p["max_dim"]), ("rips", 3, 1))
        self.assertIn("persistence", p["timings"])
        self.assertGreater(p["peak_memory"], 1e6)
        self.assertTrue(report.meta["program"].startswith("ph-barcode "))

    def test_the_hash_is_that_of_all_files_that_were_read(self):
        header, data = files.two_files((3, 2, 2), range(12), "v.raw")
        self.write("v.mhd", header)
        self.write("v.raw", data)
        self.write("v.nhdr", b"NRRD0004\ntype: uint8\ndimension: 2\nsizes: 3 4\nencoding: raw\n"
                   b"data file: v.raw\n")
        slices = {f"s/{name}": b"P5 3 2 9\n" + bytes([k] * 6)
                  for k, name in enumerate(("a2.pgm", "a10.pgm"))}
        os.mkdir(self.path("s"))
        for name, content in {**slices, "s/a1.txt": b"no slice"}.items():
            self.write(name, content)
        for arguments, parts in ((["v.mhd"], (header, data)),
                                 (["v.nhdr"], (self.read_bytes("v.nhdr"), data)),
                                 (["--stack", "s"], slices.values())):
            with self.subTest(arguments=arguments):
                found = self.report(*arguments).meta["provenance"]["input"]["sha256"]
                self.assertEqual(found, hashlib.sha256(b"".join(parts)).hexdigest())

    def test_what_was_assumed_is_a_note(self):
        self.write("p.csv", "x,y\n0,0\n1,0\n")
        provenance = self.report("p.csv").meta["provenance"]
        self.assertIn("header", provenance["notes"]["Assumed"])
        self.assertNotIn("warnings", provenance)

    def test_hostile_names_stay_text(self):
        name = "<script>alert(1)<\u2044script>'\"&\n.txt"
        self.write(name, "0 0\n1 0\n")
        report = self.report(name)
        self.assertEqual(report.meta["title"], name)
        self.assertNotIn("<script>alert", report.text)
        hostile = b"\xff<!--.txt"
        with open(os.path.join(os.fsencode(self.folder), hostile), "wb") as file:
            file.write(b"0 0\n1 0\n")
        self.assertEqual(self.report(hostile).meta["title"], "\ufffd<!--.txt")

    def test_nothing_is_left_of_a_run_that_failed(self):
        self.write("bad.txt", "0 0\n1\n")
        before = self.files()
        self.expect(65, "bad.txt", "--report", "r.html")
        self.assertEqual(self.files(), before)
        self.expect(73, "square.txt", "--report", "no/such/r.html")
        self.expect(64, "square.txt", "--report", "r.svg")
        self.expect(64, "square.txt", "square.txt", "--report", "r.html", "-o", "all/")
        self.expect(64, "square.txt", "--report", "-")
        self.assertEqual(self.files(), before)

    def test_standard_output_and_input(self):
        run = self.expect(0, "-", "--report", "-", "--output-format", "none", "--quiet",
                          input="0 0\n3 4\n")
        self.write("r.html", run.stdout)
        self.assertEqual(Report(self.path("r.html")).bars(), [(0, 0, 5), (0, 0, math.inf)])

    def test_a_dry_run_writes_nothing(self):
        self.expect(0, "square.txt", "--dry-run", "--report", "r.html")
        self.assertNotIn("r.html", self.files())

    def test_no_points(self):
        self.write("none.txt", "")
        self.assertEqual(self.report("none.txt", "--allow-empty").bars(), [])

    def test_two_barcodes(self):
        self.write("a.csv", SQUARE_CSV)
        self.write("b.csv", "dim,birth,death\n0,0,inf\n1,1,3\n")
        run = self.expect(0, "--compare", "a.csv", "b.csv", "--report", "r.html")
        self.assertTrue(run.stdout.startswith("bottleneck distance (order inf, ground norm inf) of a.csv and b.csv\nH0  "))
        report = Report(self.path("r.html"))
        self.assertEqual(report.bars(), self.bars_of_csv(SQUARE_CSV))
        self.assertEqual(report.bars("bars2"), [(0, 0, math.inf), (1, 1, 3)])
        self.assertEqual([b["name"] for b in report.meta["barcodes"]], ["a.csv", "b.csv"])

    def test_distances_of_two_barcodes(self):
        self.write("a.csv", "dim,birth,death\n1,0,5\n0,0,inf\n2,1,2\n0,0,1\n0,0,0.5\n")
        self.write("b.csv", "dim,birth,death\n0,0.25,inf\n0,0,1.125\n1,0,5\n1,2,inf\n")
        report = self.report("--compare", "a.csv", "b.csv")
        self.assertEqual(report.meta["distances"], [
            {"dim": 0, "bottleneck": 0.25}, {"dim": 1, "bottleneck": None},
            {"dim": 2, "bottleneck": 0.5}])
        self.assertNotIn("Distances left out", report.meta["provenance"]["notes"])
        self.write("many.csv", "dim,birth,death\n0,0,1\n" + "1,0,1\n" * 40_001)
        report = self.report("--compare", "a.csv", "many.csv")
        self.assertEqual([d["dim"] for d in report.meta["distances"]], [0, 2])
        self.assertEqual(report.meta["provenance"]["notes"]["Distances left out"],
                         "H1: 40002 bars; at most 40000 are compared")

    def test_the_matching_is_worth_the_distances(self):
        rng = random.Random(3)
        files = []
        for name in ("a.csv", "b.csv"):
            bars = [(0, 0, math.inf)] + [(dim, birth, birth + rng.random() ** 3) for dim in (0, 1)
                                         for birth in [rng.random() for _ in range(30)]]
            bars.sort()
            self.write(name, "dim,birth,death\n" + "".join(f"{d},{b},{e}\n" for d, b, e in bars))
            files.append(bars)
        report = self.report("--compare", "a.csv", "b.csv")
        first, second = files
        pairs = report.arrays["matching/pairs"].rows()
        distance = {d["dim"]: d["bottleneck"] for d in report.meta["distances"]}
        paired = [set(), set()]
        worst = dict.fromkeys(distance, 0)
        for i, j in pairs:
            a, b = first[i], second[j - len(first)]
            self.assertEqual(a[0], b[0])
            paired[0].add(i)
            paired[1].add(j - len(first))
            moved = max(abs(x - y) if x != y else 0 for x, y in zip(a[1:], b[1:]))
            worst[a[0]] = max(worst[a[0]], moved)
        for bars, seen in zip(files, paired):
            self.assertEqual(len(seen), len(pairs))
            for k, (dim, birth, death) in enumerate(bars):
                if k not in seen:
                    worst[dim] = max(worst[dim], (death - birth) / 2)
        self.assertEqual(worst, distance)

    def test_comparisons_that_make_no_sense(self):
        self.write("a.csv", SQUARE_CSV)
        self.expect(64, "--compare", "a.csv", "--report", "r.html")
        self.expect(64, "square.txt", "--compare", "a.csv", "a.csv", "--report", "r.html")
        self.expect(66, "--compare", "a.csv", "none.csv", "--report", "r.html")
        self.write("bad.csv", "dim,birth,death\n0,2,1\n")
        self.expect(65, "--compare", "a.csv", "bad.csv", "--report", "r.html")
        self.assertNotIn("r.html", self.files())


if __name__ == "__main__":
    main()
