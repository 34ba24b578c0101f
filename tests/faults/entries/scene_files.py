# SPDX-License-Identifier: MIT
"""Rows 66 to 68: inputs of ph-segment other than clouds: stored merge trees, cameras, lists of
frames."""
import binascii
import struct

from entry import Entry, sample, with_bytes, with_change

TREE = sample("tree", "surface.tree")
# Offsets of numbers in the header of a tree: 8 bytes of magic, then the version, and so on.
VERSION, METHOD, SIZE, COUNTS = 8, 16, 24, 40


def sealed(content):
    """The content with a checksum that matches it."""
    return content[:-4] + struct.pack("<I", binascii.crc32(content[:-4]))


def with_number(form, offset, value):
    return sealed(with_bytes(TREE, offset, struct.pack("<" + form, value)))


TREES = [
    ("nothing", b"", "no points"),
    ("the magic alone", TREE[:8], "truncated|header"),
    ("another magic", b"ph-bush\n" + TREE[8:], "not plain text"),
    ("without its last byte", TREE[:-1], "truncated"),
    ("a byte behind its end", TREE + b"\0", "trailing data"),
    ("a bit that fell over", with_bytes(TREE, 100, bytes([TREE[100] ^ 1])), "checksum|damaged"),
    ("version 1", with_number("Q", VERSION, 1), "version"),
    ("version 2^32 - 1", with_number("Q", VERSION, 2**64 - 1), "version"),
    ("an unknown method", with_number("Q", METHOD, 77), "method, found 77"),
    ("2^40 columns", with_number("Q", SIZE, 2**40), "width"),
    ("2^40 rows", with_number("Q", SIZE + 8, 2**40), "height"),
    ("2^64 - 1 vertices", with_number("Q", COUNTS, 2**64 - 1), "vertices"),
    ("no vertices", with_number("Q", COUNTS, 0), "vertices|merges|trailing"),
    ("a merge of a vertex that is not there",
     sealed(with_change(TREE, struct.pack("<dII", .75, 2, 1), struct.pack("<dII", .75, 9, 1))), "found 9-1"),
    ("a merge of a vertex with itself",
     sealed(with_change(TREE, struct.pack("<dII", .75, 2, 1), struct.pack("<dII", .75, 1, 1))), "found 1-1"),
    ("a merge of two that are one",
     sealed(with_change(TREE, struct.pack("<dII", .75, 2, 1), struct.pack("<dII", .75, 0, 1))), "edges of a forest"),
    ("merges that go down",
     sealed(with_change(TREE, struct.pack("<dII", .75, 2, 1), struct.pack("<dII", -5., 2, 1))), "found -5"),
    ("a merge at NaN",
     sealed(with_change(TREE, struct.pack("<dII", .75, 2, 1), struct.pack("<dII", float("nan"), 2, 1))),
     "value of a merge, found nan"),
    ("a merge at infinity",
     sealed(with_change(TREE, struct.pack("<dII", .75, 2, 1), struct.pack("<dII", float("inf"), 2, 1))),
     "value of a merge, found inf"),
    ("a point of a vertex that is not there",
     sealed(with_change(TREE, struct.pack("<5I", 0, 1, 2**32 - 1, 1, 2),
                        struct.pack("<5I", 0, 1, 2**32 - 1, 1, 3))), "vertex of a point, found 3"),
    ("a birth that is NaN",
     sealed(with_change(TREE, struct.pack("<3d", .25, 0., .125), struct.pack("<3d", .25, float("nan"), .125))),
     "birth, found nan"),
]

YAML = b"""image_width: 640
image_height: 480
camera_matrix:
  rows: 3
  cols: 3
  data: [525.0, 0.0, 319.5, 0.0, 525.0, 239.5, 0.0, 0.0, 1.0]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.0, 0.0, 0.0, 0.0, 0.0]
"""
LENS = with_change(YAML, b"data: [0.0,", b"data: [0.5,")
OPEN3D = b'{"width": 640, "height": 480, "intrinsic_matrix": [525, 0, 0, 0, 525, 0, 319.5, 239.5, 1]}'
CAMERAS = [
    ("nothing", "c.yaml", b"", "no image_width"),
    ("a word", "c.yaml", b"camera\n", ":1:1: "),
    ("eight numbers", "c.txt", b"525 0 319.5 0 525 239.5 0 0\n", "found 8 numbers, expected 9.*--intrinsics"),
    ("a matrix that is not a camera's", "c.txt", b"525 0 319.5 0 525 239.5 0 1 1\n", "camera matrix.*--intrinsics"),
    ("half a RealSense", "c.json", b'{"fx": 525, "fy": 525, "ppx": 319.5}', "found no ppy.*--intrinsics"),
    ("two cameras of BOP", "c.json", b'{"0": {"cam_K": [5, 0, 3, 0, 5, 3, 0, 0, 1]}, "1": {"cam_K": [6, 0, 3, 0, 5, 3, 0, 0, 1]}}',
     "several cameras, found pictures 0 and 1.*--intrinsics"),
    ("cameras of colour and depth", "c.json",
     b'{"color": {"fx": 5, "fy": 5, "cx": 3, "cy": 3}, "depth": {"fx": 6, "fy": 6, "cx": 3, "cy": 3}}',
     "several cameras, found color and depth.*--intrinsics"),
    ("a lens of ORB-SLAM", "c.yaml", b"Camera.fx: 5\nCamera.fy: 5\nCamera.cx: 3\nCamera.cy: 3\nCamera.k1: 0.2\n",
     ":5:1: lens coefficients.*rectify the image"),
    ("a scale that may be in two units", "c.json", b'{"fx": 5, "fy": 5, "cx": 3, "cy": 3, "depth_scale": 10}',
     "depth_scale, found 10"),
    ("no focal lengths", "c.yaml", with_change(YAML, b"[525.0", b"[0.0"), "focal lengths, found 0"),
    ("a focal length below 0", "c.yaml", with_change(YAML, b"[525.0", b"[-525.0"), "focal lengths, found -525"),
    ("a focal length of NaN", "c.yaml", with_change(YAML, b"[525.0", b"[.nan"), ":6:10: not a number"),
    ("a focal length beyond the doubles", "c.yaml", with_change(YAML, b"[525.0", b"[1e999"), ":6:10: not a number"),
    ("a matrix of eight numbers", "c.yaml", with_change(YAML, b", 0.0, 1.0]", b", 1.0]"), "found 8 numbers"),
    ("a matrix of ten numbers", "c.yaml", with_change(YAML, b", 1.0]", b", 1.0, 0.0]"), "found 10 numbers"),
    ("a skewed matrix", "c.yaml", with_change(YAML, b"[525.0, 0.0", b"[525.0, 7.0"), "found 525, 7"),
    ("a matrix whose last row is no 0 0 1", "c.yaml", with_change(YAML, b"0.0, 0.0, 1.0]", b"0.0, 0.0, 2.0]"), "camera matrix"),
    ("no matrix", "c.yaml", with_change(YAML, b"camera_matrix", b"camera_matter"), "no camera_matrix.data"),
    ("an unknown lens", "c.yaml", with_change(LENS, b"plumb_bob", b"crystal_ball"), "crystal_ball"),
    ("a lens that is NaN", "c.yaml", with_change(YAML, b"data: [0.0,", b"data: [.nan,"), "not a number"),
    ("a lens of a thousand numbers", "c.yaml",
     with_change(YAML, b"data: [0.0, 0.0, 0.0, 0.0, 0.0]", b"data: [" + b"0.0, " * 999 + b"0.5]"), "1000"),
    ("a width of 0", "c.yaml", with_change(YAML, b"640", b"0"), ":1:14: "),
    ("a width of 10^12", "c.yaml", with_change(YAML, b"640", b"1000000000000"), ":1:14: "),
    ("a list that nobody ends", "c.yaml", with_change(YAML, b"1.0]\ndist", b"1.0\ndist"), ":7:1: "),
    ("lists in lists", "c.yaml", with_change(YAML, b"[525.0", b"[" * 1000 + b"525.0"), ":6:10: "),
    ("a key twice", "c.yaml", YAML + b"image_width: 320\n", "a repeated key"),
    ("an alias that grows", "c.yaml",
     b"a: &a [x, x]\nb: &b [*a, *a]\nc: &c [*b, *b]\nd: &d [*c, *c]\n" + YAML, "anchor or alias"),
    ("more than a camera takes", "c.yaml", YAML + b"# " + b"x" * (1 << 21) + b"\n", "found 2097"),
    ("NUL bytes", "c.yaml", YAML + b"\0\0\0\n", "not plain text"),
    ("JSON without a matrix", "c.json", b'{"width": 640, "height": 480}', "found no intrinsic_matrix"),
    ("JSON with a matrix of words", "c.json", with_change(OPEN3D, b"[525", b'["525"'), "expected a number"),
    ("JSON with a matrix row after row", "c.json",
     with_change(OPEN3D, b"[525, 0, 0, 0, 525, 0, 319.5, 239.5, 1]", b"[525, 0, 319.5, 0, 525, 239.5, 0, 0, 1]"),
     "column by column"),
    ("JSON with 1e999", "c.json", with_change(OPEN3D, b"319.5", b"1e999"), "number out of range"),
    ("JSON with a number that begins with a point", "c.json", with_change(OPEN3D, b"319.5", b".5"),
     r"not a JSON number, found \.5"),
    ("JSON without an end", "c.json", OPEN3D[:-1], "end of the file"),
    ("JSON with its matrix twice", "c.json",
     with_change(OPEN3D, b"}", b', "intrinsic_matrix": [1, 0, 0, 0, 1, 0, 0, 0, 1]}'),
     "intrinsic_matrix, found a second one"),
    ("JSON nested a hundred thousand times", "c.json", b'{"a":' * 100_000, "nested too deeply"),
]

DEPTH = sample("png", "depth.png")
CLOUD = b"0 0 1\n1 0 1\n"


def entries():
    for name, content, message in TREES:
        yield Entry(66, name, "ph-segment", ("scene.tree", "--labels", "l.csv", "-o", "l.pcd"), 65, message, "scene.tree",
                    {"scene.tree": content})
    yield Entry(66, "a cut at NaN", "ph-segment", ("scene.tree", "--cut", "nan"), 64, "found 'nan'", "--cut",
                {"scene.tree": TREE})
    for name, file, content, message in CAMERAS:
        yield Entry(67, name, "ph-segment", ("--depth", "d.png", "--camera", file), 65, message, file,
                    {"d.png": DEPTH, file: content})
    for name, content, code, message, named in (
            ("a frame that is missing", b"a.xyz\nmissing.xyz\n", 66, "cannot open", "missing.xyz"),
            ("a name with NUL", b"a.xyz\0b.xyz\n", 65, "found a NUL byte after 'a.xyz'", "--frames-from"),
            ("a line that is no name", b"a" * 100_000 + b"\n", 65, "found a line of more than 65536 bytes", "--frames-from"),
            ("coordinates beyond single precision", b"far.xyz\n", 65, r"found 1e\+39, expected at most", "coordinate 2"),
            ("a name that would clear the screen", b"\x1b[2J.xyz\n", 66, "cannot open", "\\x1B[2J.xyz"),
            ("a folder", b".\n", 66, "directory", "."),
            ("the list itself", b"frames.txt\n", 65, "no points", "frames.txt"),
            ("a name of 5000 letters", b"a" * 5000 + b".xyz\n", 73, "too long", "aaaa")):
        yield Entry(68, name, "ph-segment", ("--frames-from", "frames.txt", "-o", "out/"), code,
                    message, named, creates=("out",), files={"frames.txt": content, "a.xyz": CLOUD, "b.xyz": CLOUD,
                                                                    "far.xyz": b"0 0 1\n0 0 1e39\n"})


ENTRIES = list(entries())
