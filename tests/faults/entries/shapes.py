# SPDX-License-Identifier: MIT
"""Rows 85 to 96: valid data that are extreme cases of geometry or of cloud files."""
import os
import struct

from arrays import CAMERA
from clouds import NAN, columns, compressed, floats, pcd_header, ply_header
from files import GREY, npy, packed, png

from entry import Entry, bars, labels, refused, taken

POINT_ALONE = bars("0,0,inf")
KEEP_ALL = ("--plane", "off", "--min-size", "1")


def text(rows):
    return "".join(" ".join(map(str, row)) + "\n" for row in rows)


def same():
    yield taken(85, "points", "4 times one point", "1 2\n" * 4, POINT_ALONE, "--check")
    yield taken(85, "points", "their zero-length bars", "1 2\n" * 3, bars("0,0,0", "0,0,0", "0,0,inf"),
                "--min-persistence", "-1", "--max-dim", "0")
    yield taken(85, "distance", "all zero", "0 0 0\n" * 3, POINT_ALONE, "--check")
    yield taken(85, "lower-distance", "all zero", "0\n0 0\n", POINT_ALONE, "--max-dim", "2")
    yield taken(85, "sparse", "all zero", "0 1 0\n1 2 0\n", POINT_ALONE)
    yield taken(85, "npy", "a constant image", npy("<f8", (4, 4), packed("<f8", [7] * 16)),
                bars("0,7,inf"), "--check")
    yield taken(85, "npy", "all infinite", npy("<f8", (4,), packed("<f8", [float("inf")] * 4)), bars(),
                "--check")
    yield taken(85, "simplices", "one value", "0 : 1\n1 : 1\n0 1 : 1\n", bars("0,1,inf"), "--check")
    yield taken(85, "xyz", "40 times one point", "0 0 1\n" * 40, labels(*[1] * 40), *KEEP_ALL)
    yield taken(85, "xyz", "40 times one point, plane", "0 0 1\n" * 40, labels(*[0] * 40))


def collinear():
    yield taken(86, "points", "on an axis", "0 0\n1 0\n3 0\n", bars("0,0,1", "0,0,2", "0,0,inf"),
                "--max-dim", "2", "--check")
    yield taken(86, "points", "on a diagonal", text((i, i) for i in range(5)),
                bars(*["0,0,1.4142135623730951"] * 4, "0,0,inf"), "--max-dim", "2", "--check")
    yield taken(86, "points", "one coordinate", "0\n1\n2\n", bars("0,0,1", "0,0,1", "0,0,inf"))
    yield taken(86, "xyz", "a row of 40", text((i / 64, 0, 1) for i in range(40)),
                labels(*[1] * 40), *KEEP_ALL)
    yield taken(86, "xyz", "a row of 40, plane", text((i / 64, 0, 1) for i in range(40)),
                labels(*[1] * 40), "--method", "paper")


def cocircular():
    loop = "1,1,1.4142135623730951"
    yield taken(87, "points", "a square", "0 0\n1 0\n1 1\n0 1\n",
                bars("0,0,1", "0,0,1", "0,0,1", "0,0,inf", loop), "--check")
    yield taken(87, "points", "a 4 x 4 grid", text((i, j) for i in range(4) for j in range(4)),
                bars(*["0,0,1"] * 15, "0,0,inf", *[loop] * 9), "--check", "--max-dim", "2")
    yield taken(87, "points", "a cube", text((i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)),
                bars(*["0,0,1"] * 7, "0,0,inf", *[loop] * 5), "--check")
    yield taken(87, "points", "an octahedron", "1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n",
                bars(*["0,0,1.4142135623730951"] * 5, "0,0,inf", "2,1.4142135623730951,2"),
                "--check", "--max-dim", "2")


def spreads():
    yield taken(88, "points", "3-4-5 triangle", "0 0\n3e-300 0\n3e-300 4e-300\n",
                bars("0,0,3e-300", "0,0,4e-300", "0,0,inf"), "--check")
    yield taken(88, "points", "its hypotenuse", "0 0\n3e-300 4e-300\n", bars("0,0,5e-300", "0,0,inf"))
    yield taken(88, "points", "the smallest denormal", "0\n5e-324\n", bars("0,0,5e-324", "0,0,inf"))
    yield taken(88, "distance", "the smallest denormal", "0 5e-324\n5e-324 0\n",
                bars("0,0,5e-324", "0,0,inf"))
    yield taken(88, "npy", "denormals", npy("<f8", (3,), packed("<f8", [0, 1e-310, 5e-324])),
                bars("0,0,inf", "0,5e-324,1e-310"), "--check")
    yield taken(89, "points", "its hypotenuse", "0 0\n3e300 4e300\n", bars("0,0,5e+300", "0,0,inf"))
    yield taken(89, "points", "both spreads", "0 0\n1e-300 0\n1e300 0\n",
                bars("0,0,1e-300", "0,0,1e+300", "0,0,inf"), "--check")
    yield taken(89, "points", "with 1e-300", "0\n1e-300\n1e300\n",
                bars("0,0,1e-300", "0,0,1e+300", "0,0,inf"))
    yield taken(89, "distance", "the largest double", "0 1.7976931348623157e308\n"
                "1.7976931348623157e308 0\n", bars("0,0,1.7976931348623157e+308", "0,0,inf"))
    yield taken(89, "points", "manhattan", "0 0\n3e300 4e300\n", bars("0,0,7e+300", "0,0,inf"),
                "--metric", "manhattan")
    # A distance beyond the largest double is refused.
    for metric in ("euclidean", "manhattan", "chebyshev"):
        yield refused(89, "points", f"twice the largest double, {metric}", "-1.7e308 0\n1.7e308 0\n",
                      "two points are farther apart than the largest double", "--metric", metric)
    yield taken(90, "points", "500 times each corner", "0 0\n1 0\n1 1\n0 1.25\n" * 500,
                bars("0,0,1", "0,0,1", "0,0,1.0307764064044151", "0,0,inf",
                     "1,1.25,1.4142135623730951"))
    yield taken(90, "sparse", "1000 times each pair", "0 1 1\n2 1 2\n1 0 1\n" * 1000,
                bars("0,0,1", "0,0,2", "0,0,inf"))
    yield taken(90, "xyz", "20,000 times two points", "0 0 1\n1 0 1\n" * 20_000,
                labels(*[1, 2] * 20_000), *KEEP_ALL)


def pcd_files(points, width, height):
    """The same organised cloud in each of PCD's three data encodings."""
    ascii_rows = text([str(c) if c == c else "nan" for c in p] for p in points).encode()
    return {"ascii": pcd_header(width=width, height=height) + ascii_rows,
            "binary": pcd_header(width=width, height=height, data="binary") + floats(points),
            "binary_compressed": pcd_header(width=width, height=height, data="binary_compressed")
            + compressed(columns(points))}


def depth(rows, bits=16):
    return png(len(rows[0]), len(rows), bits, GREY, [struct.pack(f">{len(r)}H", *r) for r in rows])


def of_depth(row, name, content, output, *options):
    return Entry(row, f"depth: {name}", "ph-segment", ("--depth", "d.png", *CAMERA, "--labels", "-",
                                                       "--quiet", *options), 0,
                 files={"d.png": content}, output=output)


def organised():
    hole = (NAN, NAN, NAN)
    for data, content in pcd_files([hole] * 6, 3, 2).items():
        yield taken(91, "pcd", data, content, labels(*[0] * 6))
        yield Entry(91, f"ph-barcode: {data}", "ph-barcode", ("c.pcd",), 65, "no points", "c.pcd",
                    {"c.pcd": content})
        yield Entry(91, f"ph-barcode, allowed: {data}", "ph-barcode", ("c.pcd", "--allow-empty"), 0,
                    files={"c.pcd": content}, output=bars())
    yield of_depth(91, "no pixel", depth([[0] * 4] * 3), labels(*[0] * 12))
    yield taken(91, "xyz", "all NaN", "nan nan nan\n" * 3, labels(0, 0, 0))
    yield taken(91, "ply", "all NaN", ply_header("ascii", "element vertex 2", "property float x",
                                                 "property float y", "property float z")
                + b"nan nan nan\n" * 2, labels(0, 0))
    one = [hole, (0, 0.5, 1), hole, hole]
    for data, content in pcd_files(one, 2, 2).items():
        yield taken(92, "pcd", data, content, labels(0, 0, 0, 0))
        yield taken(92, "pcd", f"{data}, kept", content, labels(0, 1, 0, 0), *KEEP_ALL)
        yield Entry(92, f"ph-barcode: {data}", "ph-barcode", ("c.pcd", "--quiet"), 0,
                    files={"c.pcd": content}, output=POINT_ALONE)
    yield of_depth(92, "one pixel", depth([[0, 0], [0, 900]]), labels(0, 0, 0, 1), *KEEP_ALL)
    yield of_depth(92, "of one", depth([[900]]), labels(1), *KEEP_ALL)
    yield taken(92, "points", "one point", "1 2\n", POINT_ALONE, "--max-dim", "5", "--check")
    yield taken(92, "npy", "one voxel", npy("<f8", (1, 1, 1), packed("<f8", [3])), bars("0,3,inf"),
                "--check")
    row = [(i / 128, 0, 1) for i in range(40)]
    for width, height in ((40, 1), (1, 40)):
        for data, content in pcd_files(row, width, height).items():
            yield taken(93, "pcd", f"{width} x {height}, {data}", content, labels(*[1] * 40), *KEEP_ALL)
    yield of_depth(93, "one row", depth([[1000] * 4]), labels(1, 1, 1, 1), *KEEP_ALL)
    yield of_depth(93, "one column", depth([[1000]] * 4), labels(1, 1, 1, 1), *KEEP_ALL)


def written(path, *parts):
    """A check that, after the run, the file contains each of these parts."""
    def check(folder):
        with open(os.path.join(folder, path), "rb") as file:
            content = file.read()
        return "; ".join(f"no {part!r} in {content[:600]!r}" for part in parts if part not in content)
    return check


def fields():
    def kept(row, name, content, path, *parts):
        return Entry(row, name, "ph-segment", ("c.pcd", *KEEP_ALL, "-o", path), 0, output="",
                     files={"c.pcd": content}, creates=(path,), after=written(path, *parts))

    labelled = pcd_header("x y z label", "4 4 4 4", "F F F U", "1 1 1 1", 2) + b"0 0 1 7\n1 0 1 8\n"
    yield kept(94, "a label", labelled, "out.pcd", b"FIELDS x y z label_in label\n")
    yield kept(94, "a label, to PLY", labelled, "out.ply", b"property uint label_in\n",
               b"property uint label\n", struct.pack("<2I", 7, 1), struct.pack("<2I", 8, 2))
    twice = (pcd_header("x y z label label_in", "4 4 4 4 4", "F F F U U", "1 1 1 1 1", 1)
             + b"0 0 1 7 6\n")
    yield kept(94, "label and label_in", twice, "out.pcd", b"FIELDS x y z label_in_2 label_in label\n")
    thick = pcd_header("x y z label", "4 4 4 4", "F F F U", "1 1 1 2", 1) + b"0 0 1 7 8\n"
    yield kept(94, "a label of two", thick, "out.pcd", b"FIELDS x y z label_in label\n")
    colour = pcd_header("x y z rgb", "4 4 4 4", "F F F F", "1 1 1 1", 1, data="binary")
    bits = struct.pack("<I", 0xFFFF8040)  # opaque orange, which as a float is NaN with a payload
    yield kept(95, "to PLY", colour + floats([(0, 0, 1)]) + bits, "out.ply", b"property uchar red\n",
               b"\xff\x80\x40")
    yield kept(95, "to PCD", colour + floats([(0, 0, 1)]) + bits, "out.pcd", bits)
    signalling = struct.pack("<I", 0x7F800001)
    yield kept(95, "a signalling NaN", colour + floats([(0, 0, 1)]) + signalling, "out.pcd", signalling)
    normals = pcd_header("x y z normal_x normal_y normal_z", "4 4 4 4 4 4", "F F F F F F",
                         "1 1 1 1 1 1", 2)
    for word in ("0", "nan", "-0"):
        yield taken(96, "pcd", f"normals of {word}",
                    normals + f"0 0 1 {word} {word} {word}\n1 0 1 0 0 1\n".encode(), labels(1, 2),
                    *KEEP_ALL)
    yield kept(96, "kept in PLY", normals + b"0 0 1 0 0 0\n1 0 1 0 0 0\n", "out.ply",
               b"property float nz\n")


ENTRIES = [*same(), *collinear(), *cocircular(), *spreads(), *organised(), *fields()]
