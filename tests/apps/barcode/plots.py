# SPDX-License-Identifier: MIT
"""Tests plots as PNG, which must show the same as the SVG: plots.py PH-BARCODE"""
import os
import random
import shutil
import struct
import subprocess
import sys
import unittest
import zlib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, main  # noqa: E402

KINDS = ("barcode", "diagram", "betti", "tree")
WIDTH = 1040
H0, H1, WHITE = (0x00, 0x72, 0xb2), (0xd5, 0x5e, 0x00), (255, 255, 255)


def chunks(data):
    """@return name and content of each chunk of a PNG, checksums compared."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", data[:8]
    at, found = 8, []
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at:at + 8])
        content = data[at + 8:at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(name + content)
        found.append((name, content))
        at += 12 + size
    assert found[-1] == (b"IEND", b"")
    return found


def pixels(data):
    """@return width, and the pixels of an 8-bit RGB(A) PNG as rows of colours, by the letter."""
    parts = chunks(data)
    width, height, bits, kind = struct.unpack(">IIBB", dict(parts)[b"IHDR"][:10])
    assert bits == 8 and kind in (2, 6), (bits, kind)
    step = 3 if kind == 2 else 4
    raw = zlib.decompress(b"".join(content for name, content in parts if name == b"IDAT"))
    assert len(raw) == height * (width * step + 1)
    rows, above = [], bytes(width * step)
    for y in range(height):
        start = y * (width * step + 1)
        above = unfiltered(raw[start], raw[start + 1:start + 1 + width * step], above, step)
        rows.append(list(zip(above[0::step], above[1::step], above[2::step])))
    return width, rows


def unfiltered(kind, line, above, step):
    """@return what a row was before a PNG filter made it shorter."""
    if not any(line) and kind in (2, 4):  # most rows are white: the one above once more
        return above
    if kind == 0:
        return line
    if kind == 2:
        return bytes([(byte + up) & 255 for byte, up in zip(line, above)])
    found = bytearray(step) + line  # and no pixel before the first
    for i, (byte, up, corner) in enumerate(zip(line, above, bytes(step) + above)):
        left = found[i]
        if kind == 1:
            guess = left
        elif kind == 3:
            guess = (left + up) // 2
        else:
            a, b, c = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
            guess = left if a <= b and a <= c else up if b <= c else corner
        found[i + step] = (byte + guess) & 255
    return bytes(found[step:])


def places(rows, colour):
    """@return where a pixel has a colour, exactly or nearly."""
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

    def content(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def test_every_kind(self):
        for kind in KINDS:
            with self.subTest(kind=kind):
                run = self.expect(0, "square.txt", "--plot", "a.png", "--plot-kind", kind, "--plot", "b.PNG",
                                  "--output-format", "none", "--quiet")
                self.assertEqual((run.stdout, run.stderr), ("", ""))
                self.assertEqual(self.content("a.png"), self.content("b.PNG"))
                self.assertLess(len(self.content("a.png")), 200_000)
                self.assertIn((b"pHYs", struct.pack(">IIB", 11811, 11811, 1)),
                              chunks(self.content("a.png")))
                width, rows = pixels(self.content("a.png"))
                self.assertEqual(width, WIDTH)
                self.assertGreater(len(places(rows, H0)), 100)
                self.assertEqual(len(places(rows, H1)) > 100, kind != "tree")
                self.assertEqual({colour for row in rows[:20] for colour in row}, {WHITE}, "a margin")

    @unittest.skipUnless(shutil.which("rsvg-convert"), "rsvg-convert is not installed")
    def test_it_is_the_svg(self):
        """Bars, points and curves are at the places where another program draws those of the
        SVG."""
        number = random.Random(1).random
        self.write("points.txt", "".join(f"{number()} {number()}\n" for _ in range(150)))
        for kind in KINDS:
            with self.subTest(kind=kind):
                self.expect(0, "points.txt", "--plot", "a.png", "--plot", "a.svg", "--plot-kind", kind,
                            "--output-format", "none")
                theirs = subprocess.run(["rsvg-convert", "-w", str(WIDTH), "a.svg"], cwd=self.folder,
                                       check=True, stdout=subprocess.PIPE).stdout
                (width, mine), (other_width, theirs) = pixels(self.content("a.png")), pixels(theirs)
                self.assertEqual(width, other_width)
                self.assertLessEqual(abs(len(mine) - len(theirs)), 1)
                for colour in (H0, H1):
                    # The letters on the left are in another font.
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
                _, rows = pixels(self.content("e.png"))
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
