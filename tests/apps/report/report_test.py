# SPDX-License-Identifier: MIT
"""Runs ph-barcode --report and reads the page back; shared by the tests of its reports."""
import csv
import math
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import program  # noqa: E402
from program import ProgramTest, has_page  # noqa: E402
from report_reader import Report  # noqa: E402


def circle(n, noise=0.0, seed=1):
    rng = random.Random(seed)
    turn = [2 * math.pi * i / n for i in range(n)]
    return "".join(f"{math.cos(t) + noise * rng.random()} {math.sin(t) + noise * rng.random()}\n"
                   for t in turn)


class ReportTest(ProgramTest):
    def setUp(self):
        super().setUp()
        if not has_page(program.PROGRAM):
            run = self.expect(69, "square.txt", "--report", "r.html")
            self.assertIn("not built in", run.stderr)
        self.require_page()

    def report(self, *arguments, name="r.html"):
        self.expect(0, *arguments, "--report", name, "--quiet")
        return Report(self.path(name))

    def bars_of_csv(self, text):
        return [(int(r["dim"]), float(r["birth"]), float(r["death"]))
                for r in csv.DictReader(text.splitlines())]
