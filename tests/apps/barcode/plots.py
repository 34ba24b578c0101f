# SPDX-License-Identifier: MIT
"""Tests plots in PNG format, which must look the same as in SVG: plots.py PH-BARCODE"""
import os
import random
import shutil
import struct
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import png_reader  # noqa: E402
from program import ProgramTest, main  # noqa: E402

KINDS = ("barcode", "diagram", "betti", "tree")
WIDTH = 1040
H0, H1, WHITE = (0x00, 0x72, 0xb2), (0xd5, 0x5e, 0x00), (255, 255, 255)


def pixels(data):
    """@return the width of an 8-bit RGB(A) PNG, and its pixels as rows of colours."""
    (width, _, bits, colour), rows = png_reader.rows_of(data)
    assert bits == 8 and colour in (2, 6), (bits, colour)
    step = len(rows[0]) // width
    return width, [list(zip(row[0::step], row[1::step], row[2::step])) for row in rows]


def places(rows, colour):
    """@return the places of the pixels that have this colour, or nearly this colour."""
    alike = {found for found in set().union(*rows)
             if max(abs(a - b) for a, b in zip(found, colour)) < 60}
    return {(x, y) for y, row in enumerate(rows) if not alike.isdisjoint(row)
            for x, found in enumerate(row) if found in alike}


class Words(ProgramTest):
    def test_an_input_may_follow_the_picture(self):
        self.expect(0, "--plot", "a.svg", "--plot", "b.svg", "--plot-kind", "diagram", "square.txt",
                    "-o", "bars.csv")
        for name in ("a.svg", "b.svg"):
            self.assertIn("</svg>", self.read(name))
        self.expect(0, "--alpha-shape", "1=shape.off", "--complex", "alpha", "--wrap", "1=wrap.off",
                    "square.txt", "-o", "bars.csv")
        self.assertTrue(self.read("shape.off").startswith("OFF"))


class Png(ProgramTest):
    def setUp(self):
        super().setUp()
        text = self.expect(0, "--version", "--verbose").stdout
        self.is_built_in = "PNG plots   FreeType" in text
        if self.is_built_in:
            return
        self.assertIn("PNG plots   no\n", text)
        run = self.expect(69, "missing.txt", "--plot", "x.PNG")
        self.assertIn("PNG plots are not built in; use .svg", run.stderr)
        self.assertEqual(self.files(), ["square.txt"])
        self.skipTest("PNG plots are not built in, and refused")

    def test_every_kind(self):
        for kind in KINDS:
            with self.subTest(kind=kind):
                run = self.expect(0, "square.txt", "--plot", "a.png", "--plot-kind", kind, "--plot", "b.PNG",
                                  "--output-format", "none", "--quiet")
                self.assertEqual((run.stdout, run.stderr), ("", ""))
                self.assertEqual(self.read_bytes("a.png"), self.read_bytes("b.PNG"))
                self.assertLess(len(self.read_bytes("a.png")), 200_000)
                self.assertIn((b"pHYs", struct.pack(">IIB", 11811, 11811, 1)),
                              png_reader.chunks(self.read_bytes("a.png")))
                width, rows = pixels(self.read_bytes("a.png"))
                self.assertEqual(width, WIDTH)
                self.assertGreater(len(places(rows, H0)), 100)
                self.assertEqual(len(places(rows, H1)) > 100, kind != "tree")
                self.assertEqual({colour for row in rows[:20] for colour in row}, {WHITE}, "a margin")

    @unittest.skipUnless(shutil.which("rsvg-convert"), "rsvg-convert is not installed")
    def test_it_is_the_svg(self):
        """Bars, points and curves are at the same places in the PNG file and in a picture that
        another program renders from the SVG file."""
        number = random.Random(1).random
        self.write("points.txt", "".join(f"{number()} {number()}\n" for _ in range(150)))
        for kind in KINDS:
            with self.subTest(kind=kind):
                self.expect(0, "points.txt", "--plot", "a.png", "--plot", "a.svg", "--plot-kind", kind,
                            "--output-format", "none")
                theirs = subprocess.run(["rsvg-convert", "-w", str(WIDTH), "a.svg"], cwd=self.folder,
                                       check=True, stdout=subprocess.PIPE).stdout
                (width, mine), (other_width, theirs) = pixels(self.read_bytes("a.png")), pixels(theirs)
                self.assertEqual(width, other_width)
                self.assertLessEqual(abs(len(mine) - len(theirs)), 1)
                for colour in (H0, H1):
                    # The numbers on the left are not compared, because the two programs use
                    # different fonts.
                    a, b = ({p for p in places(rows, colour) if p[0] > 120} for rows in (mine, theirs))
                    self.assertEqual(len(a) > 500, kind != "tree" or colour == H0)
                    for one, other in ((a, b), (b, a)):
                        near = {(x + dx, y + dy) for x, y in other for dx in (-1, 0, 1) for dy in (-1, 0, 1)}
                        self.assertGreaterEqual(len(one & near), 0.995 * len(one), colour)

    def test_no_bars(self):
        self.write("empty.txt", "")
        for kind in KINDS[:3]:
            with self.subTest(kind=kind):
                self.expect(0, "empty.txt", "--format", "points", "--allow-empty", "--plot", "e.png",
                            "--plot-kind", kind)
                _, rows = pixels(self.read_bytes("e.png"))
                self.assertGreater(len({colour for row in rows for colour in row}), 2)
                self.assertFalse(places(rows, H0))

    def test_where_it_cannot_be_written(self):
        run = self.expect(73, "square.txt", "--plot", "missing/out.png")
        self.assertIn("missing/out.png", run.stderr)
        os.mkdir(self.path("folder.png"))
        self.expect(73, "square.txt", "--plot", "folder.png")
        self.assertEqual(self.files(), ["folder.png", "square.txt"])
        run = self.expect(64, "square.txt", "--plot", "out.gif")
        self.assertIn("found 'out.gif', expected a name that ends in .svg or .png", run.stderr)

    def test_pixels_count_in_memory(self):
        run = self.expect(75, "square.txt", "--plot", "out.png", "--memory-limit", "4MiB", "--quiet")
        self.assertIn("memory", run.stderr)
        self.assertEqual(self.files(), ["square.txt"])
        self.expect(0, "square.txt", "--plot", "out.png", "--memory-limit", "64MiB")


if __name__ == "__main__":
    main()
