# SPDX-License-Identifier: MIT
"""How ph-barcode interprets a table, vertex values or a picture: it never silently misreads its
input. The tests compute the expected results from the numbers that were written to the file."""
import os
import random
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from guess_test import GuessTest, csv, distances_of, flat  # noqa: E402
from program import SQUARE_CSV, files, main  # noqa: E402


def png(width, height, colour, bits, samples, palette=b""):
    row, code = len(samples) // height, "B" if bits == 8 else "H"
    rows = [struct.pack(f">{row}{code}", *samples[y * row:(y + 1) * row]) for y in range(height)]
    return files.png(width, height, bits, colour, rows,
                     files.png_chunk(b"PLTE", palette) if palette else b"")


class Tables(GuessTest):
    def setUp(self):
        super().setUp()
        rng = random.Random(5)
        self.points = [[rng.gauss(0, 1), rng.gauss(0, 1)] for _ in range(12)]
        self.pairs = distances_of(self.points)

    def table(self, header, lead):
        return header + "\n" + "".join(f"{lead(i)},{csv([p])}" for i, p in enumerate(self.points))

    def test_index(self):
        for header in (",x,y", '"",x,y', "idx,x,y", "Index,x,y", "Unnamed: 0,x,y", "id,x,y"):
            for first in (0, 1):
                self.write("t.csv", self.table(header, lambda i, first=first: i + first))
                self.check(self.pairs, "t.csv", note="first column.*left out")
        for header in (",x,y", "id,x,y"):
            self.write("t.csv", self.table(header, lambda i: f'"a, {i}"'))
            self.check(self.pairs, "t.csv", note="left out")
        with_index = distances_of([[i, *p] for i, p in enumerate(self.points)])
        self.write("t.csv", self.table("t,x,y", lambda i: i))
        self.check(with_index, "t.csv", silent=["first column"])
        self.write("t.csv", self.table("t,x,y", lambda i: i).split("\n", 1)[1])
        self.check(with_index, "t.csv", note="holds row numbers and is read as a coordinate")
        self.write("t.csv", self.table("id,x,y", lambda i: i * i + 3))
        self.h0("t.csv", note="id, is read as numbers; --columns 2-3")
        for name in ("sample_id", "n", "point", "obs", "subject", "sample", "row id"):
            self.write("t.csv", self.table(f"{name},x,y", lambda i: i + 1))
            self.h0("t.csv", note=f"{name}, holds row numbers and is read as a coordinate; "
                                  "--columns 2-3")
            self.check(self.pairs, "t.csv", "--columns", "2-3", silent=["counts"])

    def test_an_index_of_a_cloud(self):
        cloud = [[*p, k % 3 / 2] for k, p in enumerate(self.points)]
        pairs = distances_of(cloud)
        for header, lead in ((",x,y,z", str), ("x,y,z", str), ("id,x,y,z", lambda i: str(i + 1)),
                             ('"","x","y","z"', lambda i: f'"r{i}"')):
            self.write("c.xyz", header + "\n" + "".join(
                f"{lead(i)},{csv([p])}" for i, p in enumerate(cloud)))
            self.check(pairs, "c.xyz", note="left out", silent=["--columns"])
        self.write("c.xyz", "id,x,y,z\n" + "".join(f"7,{csv([p])}" for p in cloud))
        self.check(pairs, "c.xyz", silent=["left out", "--columns"])

    def test_missing_values(self):
        text = "x,y,z\n0,0,1\nNA,1,1\n1,\"NA\",0\n3,1,\n2,2,2\n"
        self.write("na.csv", text)
        self.assertEqual(len(self.h0("na.csv", "--nan", "drop", note="3 of 5 points")), 2)
        self.refused(65, ["na.csv:3:1:", "--nan drop"], "na.csv")
        self.write("last.csv", "x,y,z\n0,0,1\n3,1,\n2,2,2\n")
        self.refused(65, ["last.csv:3:", "--nan drop"], "last.csv")
        self.write("first.csv", "x,y,z\n3,1,\n0,0,1\n2,2,2\n")
        self.refused(65, ["--nan drop"], "first.csv")
        self.write("ragged.csv", "x,y,z\n0,0,1\n3,1\n2,2,2\n")
        self.assertNotIn("--nan", self.expect(65, "ragged.csv").stderr)

    def test_missing_values_between_tabs(self):
        table = "\tx\ty\n" + "".join(f"{i}\t{x!r}\t{y!r}\n" for i, (x, y) in enumerate(self.points))
        self.write("t.tsv", table)
        self.check(self.pairs, "t.tsv", note="left out")
        self.write("empty.tsv", table.replace("\n", "\t\n").replace(f"\n3\t{self.points[3][0]!r}\t",
                                                                   "\n3\t\t"))
        self.refused(65, ["empty.tsv:5:3: empty cell", "--nan drop"], "empty.tsv")
        # All rows lack the same column. No other column may take its place.
        self.write("column.tsv", "x\ty\tz\n" + "".join(f"{x!r}\t\t{y!r}\n" for x, y in self.points))
        self.refused(65, ["column.tsv:2:", "empty cell"], "column.tsv")
        self.check(self.pairs, "column.tsv", "--columns", "x,z")

    def test_a_cloud_without_comments(self):
        cloud = [[*p, k % 3 / 2] for k, p in enumerate(self.points)]
        for header, separator in (("r,x,y,z,comment", ","), ("r;x;y;z;comment", ";"),
                                  ("r\tx\ty\tz\tcomment", "\t")):
            self.write("c.xyz", header + "\n" + "".join(
                separator.join(map(repr, [0.5, *p])) + separator + "\n" for p in cloud))
            self.refused(65, ["c.xyz:2:", "found 4 cells, expected 5, the number of names in the header"],
                         "c.xyz")

    def test_times_are_rows(self):
        self.write("row.csv", "1,2,4,8,16\n")
        self.refused(65, ["a series of 1 times"], "row.csv", "--delay", "2")
        rows = [[v + k for k in range(5)] for v in flat(self.points)]
        self.write("rows.csv", csv(rows))
        self.write("rows.npy", files.array((24, 5), flat(rows)))
        windows = distances_of([a + b for a, b in zip(rows, rows[1:])])
        for name in ("rows.csv", "rows.npy"):
            self.check(windows, name, "--delay", "2", silent=["image"])

    def test_a_triangle_with_its_diagonal(self):
        self.write("t.txt", "0\n1,0\n5,3,0\n")
        self.h0("t.txt", note="each row ends in 0")
        self.write("t.txt", "0\n1,0\n5,3,1\n")
        self.h0("t.txt", silent=["ends in 0"])

    def test_no_rows(self):
        for text in ("", "# nothing\n", "x,y\n"):
            self.write("empty.csv", text)
            self.refused(65, ["no points"], "empty.csv")

    def test_bars(self):
        self.write("bars.csv", "0,0,1\n0,0,2\n1,1,2\n")
        self.h0("bars.csv", note="dimension, birth and death; ph-barcode plot bars.csv")
        self.write("bars.npy", files.array((3, 3), [0, 0, 1, 0, 0, 2, 1, 1, 2]))
        self.h0("bars.npy", note="ph-barcode plot bars.npy")
        self.write("endless.csv", "0,0,inf\n0,0,2\n")
        self.refused(65, ["ph-barcode plot endless.csv"], "endless.csv")
        self.write("p.csv", "0,0,1\n0.5,0,2\n1,1,2\n")
        self.h0("p.csv", silent=["death"])

    def test_columns(self):
        self.write("t.csv", self.table("name,x,y", lambda i: f"p{i}"))
        self.refused(65, [":2:1:", "--columns"], "t.csv")
        for columns in ("x,y", "2-3", "3,2", "y,x", "x,3"):
            self.check(self.pairs, "t.csv", "--columns", columns)
        # There is no header, because all cells are numbers.
        self.write("numbers.csv", self.table("2,1,3", lambda i: i))
        for wrong in ("z", "4", "0", "3-2", "x,2", "2-9"):
            self.refused(64, ["--columns"], "t.csv", "--columns", wrong)
        self.refused(64, ["--columns"], "t.csv", "--columns", "x,,y")
        self.write("q.csv", '"x","y"\n' + "".join(f'"{p[0]!r}","{p[1]!r}"\n' for p in self.points))
        self.check(self.pairs, "q.csv")
        self.write("m.off", "OFF\n1 0 0\n0 0 0\n")
        self.refused(64, ["--columns", "off"], "m.off", "--columns", "1")

    def test_signals(self):
        values = [p[0] for p in self.points]
        lows = [v for i, v in enumerate(values) if all(
            v < values[k] for k in (i - 1, i + 1) if 0 <= k < len(values))]
        self.write("s.csv", "".join(f"{v!r}\n" for v in values))
        self.assertEqual(len(self.h0("s.csv", "--complex", "cubical", note="signal of 12")), len(lows))
        self.write("row.csv", csv([values]))
        self.assertEqual(len(self.h0("row.csv", "--complex", "cubical", note="signal of 12")),
                         len(lows))
        self.write("p.csv", csv(self.points))
        self.h0("s.csv", note="--complex cubical reads a signal")
        self.refused(64, ["--voxel", "--format grid"], "p.csv", "--complex", "cubical")
        rows = [[v + k * k % 3 for k in range(6)] for v in values]
        self.write("i.csv", csv(rows))
        self.write("i.npy", files.array((12, 6), flat(rows)))
        expected = self.expect(0, "i.npy", "--complex", "cubical").stdout
        self.assertEqual(self.expect(0, "i.csv", "--complex", "cubical").stdout, expected)
        self.assertEqual(self.expect(0, "i.csv", "--format", "grid").stdout, expected)


class Values(GuessTest):
    def test_of_a_mesh(self):
        faces = "3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n"
        corners = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"]
        self.write("m.off", "OFF\n4 4 0\n" + "\n".join(corners) + "\n" + faces)
        self.write("m.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                   "property float z\nproperty short height\nelement face 4\n"
                   "property list uchar int vertex_indices\nend_header\n"
                   + "".join(f"{c} {h}\n" for c, h in zip(corners, (5, 1, 3, 2))) + faces)
        self.write("v.txt", "5\n1\n3\n2\n")
        expected = "dim,birth,death\n0,1,inf\n2,5,inf\n"
        self.write("v.csv", "height\n5\n1\n3\n2\n")
        self.write("v.npy", files.array((4,), [5, 1, 3, 2]))
        self.write("column.npy", files.array((4, 1), [5, 1, 3, 2]))
        self.write("whole.npy", files.array((4,), [5, 1, 3, 2], "<i4"))
        for mesh in ("m.off", "m.ply"):
            for values in ("v.txt", "v.csv", "v.npy", "column.npy", "whole.npy", "m.ply:height"):
                run = self.expect(0, mesh, "--values", values)
                self.assertEqual(run.stdout, expected, (mesh, values))
                self.assertNotIn("faces are not used", run.stderr)
            self.assertIn("4 faces are not used", self.expect(0, mesh).stderr)
        self.write("square.npy", files.array((2, 2), [5, 1, 3, 2]))
        self.write("few.npy", files.array((3,), [5, 1, 3]))
        for values, words in (("square.npy", ["(2, 2)"]), ("few.npy", ["too few", "3", "4"]),
                              ("m.ply", ["height"]), ("m.ply:depth", ["depth", "height"])):
            self.refused(65, words, "m.off", "--values", values)
        self.refused(65, ["property"], "m.ply:height")

    def test_of_points(self):
        self.write("w.npy", files.array((4,), [0.5, 0, 0, 0.25]))
        self.write("w.txt", "0.5\n0\n0\n0.25\n")
        results = {self.expect(0, "square.txt", "--vertex-weights", name).stdout
                   for name in ("w.npy", "w.txt")}
        self.assertEqual(len(results), 1)
        self.assertNotEqual(results, {SQUARE_CSV})


class Pictures(GuessTest):
    def test_channels(self):
        rng = random.Random(2)
        for bits in (8, 16):
            pixels = [[rng.randrange(1 << bits) for _ in range(4)] for _ in range(30)]
            luma = [(299 * r + 587 * g + 114 * b + 500) // 1000 for r, g, b, _ in pixels]
            planes = dict(zip(("red", "green", "blue", "alpha"), map(list, zip(*pixels))), grey=luma)
            self.write("rgba.png", png(6, 5, 6, bits, flat(pixels)))
            self.write("rgb.png", png(6, 5, 2, bits, flat(p[:3] for p in pixels)))
            self.write("la.png", png(6, 5, 4, bits, flat((p[0], p[3]) for p in pixels)))
            for channel, values in planes.items():
                self.write("i.npy", files.array((5, 6), values))
                expected = self.expect(0, "i.npy").stdout
                for name in ("rgba.png", "rgb.png"):
                    if (name, channel) != ("rgb.png", "alpha"):
                        run = self.expect(0, name, "--channel", channel)
                        self.assertEqual(run.stdout, expected, (name, channel, bits))
            for channel, k in (("grey", 0), ("alpha", 3)):
                self.write("i.npy", files.array((5, 6), [p[k] for p in pixels]))
                self.assertEqual(self.expect(0, "la.png", "--channel", channel).stdout,
                                 self.expect(0, "i.npy").stdout)
            for name in ("rgba.png", "rgb.png", "la.png"):
                self.refused(65, ["--channel grey", "channels"], name)
            self.refused(65, ["no channel alpha"], "rgb.png", "--channel", "alpha")
            self.refused(65, ["no channel red"], "la.png", "--channel", "red")
            self.write("same.png", png(6, 5, 2, bits, flat([p[0]] * 3 for p in pixels)))
            self.write("grey.png", png(6, 5, 0, bits, [p[0] for p in pixels]))
            same = self.expect(0, "same.png")
            self.assertIn("read as grey", same.stderr)
            self.assertEqual(same.stdout, self.expect(0, "grey.png").stdout)

    def test_palette(self):
        rng = random.Random(4)
        colours = [[rng.randrange(256) for _ in range(3)] for _ in range(5)]
        places = [rng.randrange(5) for _ in range(30)]
        self.write("p.png", png(6, 5, 3, 8, places, bytes(flat(colours))))
        self.refused(65, ["--channel grey"], "p.png")
        self.write("i.npy", files.array((5, 6), [colours[k][1] for k in places]))
        self.assertEqual(self.expect(0, "p.png", "--channel", "green").stdout,
                         self.expect(0, "i.npy").stdout)

    def test_what_is_no_png(self):
        for name, content, words in (
                ("x.jpg", b"\xff\xd8\xff\xe0" + bytes(90), ["JPEG", "convert it to PNG"]),
                ("x.png", b"\xff\xd8\xff\xe0" + bytes(90), ["JPEG", "convert it to PNG"]),
                ("x.tif", b"II*\0" + bytes(90), ["pages of a TIFF, found none"]),
                ("x.webp", b"RIFF\x10\0\0\0WEBPVP8 " + bytes(40), ["WebP"]),
                ("x.obj", b"# a mesh\nmtllib m.mtl\no cube\nv 0 0 1\nv 1 0 0\nf 1 2 1\n",
                 ["OBJ mesh", "to PLY"]),
                ("x.stl", b"solid a\nfacet normal 0 0 1\nouter loop\n", ["STL mesh", "to PLY"]),
                ("y.stl", bytes(80) + b"\2\0\0\0" + bytes(100), ["STL mesh", "to PLY"]),
                ("x.h5", b"\x89HDF\r\n\x1a\n" + bytes(90), ["HDF5", ".npy"])):
            self.write(name, content)
            self.refused(65, [name, *words], name)
        self.refused(64, ["--channel", "PNG"], "square.txt", "--channel", "red")


if __name__ == "__main__":
    main()
