# SPDX-License-Identifier: MIT
"""Samples of point clouds and meshes: PCD, PLY, XYZ, PTS."""
import struct

from sample import Sample
from files import gzipped, lzf, pcd_header

NAN = float("nan")
CORNERS = [(0, 0, 1), (0.5, 0, 1), (0, 0.25, 1), (0.5, 0.25, 2)]


def cloud(name, reader, content, sized=True):
    return Sample(name, reader, content, sized, ("{}",), "ph-segment")


def floats(points):
    return b"".join(struct.pack("<3f", *p) for p in points)


def compressed(fields):
    """A body of binary_compressed data. @param fields for each field, the bytes of all points."""
    content = b"".join(fields)
    packed = lzf(content)
    return struct.pack("<II", len(packed), len(content)) + packed


def columns(points):
    return [struct.pack(f"<{len(points)}f", *column) for column in zip(*points)]


RGB = dict(fields="x y z rgb", sizes="4 4 4 4", types="F F F U", counts="1 1 1 1")
WIDE = dict(fields="x y z _ label normal", sizes="8 4 4 1 2 4", types="F F F U I F",
            counts="1 1 1 3 1 3", width=2)
PCD = [
    cloud("ascii.pcd", "pcd", pcd_header() + b"0 0 1\n0.5 0 1\n0 0.25 1\n0.5 0.25 2\n"),
    cloud("ascii_holes.pcd", "pcd",
          pcd_header(width=2, height=2) + b"0 0 1\nnan nan nan\n0 0.25 1\n0.5 0.25 2\n"),
    cloud("ascii_rgb.pcd", "pcd", pcd_header(**RGB, width=2) + b"0 0 1 16711680\n1 0 1 7\n"),
    cloud("ascii_wide.pcd", "pcd",
          pcd_header(**WIDE) + b"0 0 1 1 2 3 -7 0 0 1\n1 0 1 0 0 0 9 0 1 0\n"),
    cloud("short_header.pcd", "pcd",
          b"VERSION .7\nFIELDS x y z\nWIDTH 2\nDATA ascii\n1 2 3\n4 5 6\n"),
    cloud("old.pcd", "pcd", b"# .PCD v.5\nVERSION .5\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
          b"POINTS 2\nDATA ascii\n1 2 3\n4 5 6\n"),
    cloud("binary.pcd", "pcd", pcd_header(data="binary") + floats(CORNERS)),
    cloud("binary_organised.pcd", "pcd",
          pcd_header(width=2, height=2, data="binary")
          + floats([(NAN, NAN, NAN), *CORNERS[1:]])),
    cloud("binary_wide.pcd", "pcd", pcd_header(**WIDE, data="binary")
          + b"".join(struct.pack("<dff3Bh3f", i, 0, 1, 1, 2, 3, 9, 0, 0, 1) for i in (0, 1))),
    cloud("compressed.pcd", "pcd",
          pcd_header(data="binary_compressed") + compressed(columns(CORNERS))),
    cloud("compressed_organised.pcd", "pcd",
          pcd_header(width=2, height=2, data="binary_compressed")
          + compressed(columns([(NAN, NAN, NAN), *CORNERS[1:]]))),
    cloud("compressed_matches.pcd", "pcd",
          pcd_header(width=64, data="binary_compressed")
          + compressed(columns([(0, 0, 0)] * 64))),
    cloud("ascii.pcd.gz", "pcd",
          gzipped(pcd_header() + b"0 0 1\n0.5 0 1\n0 0.25 1\n0.5 0.25 2\n")),
    Sample("points.pcd", "points", pcd_header(data="binary") + floats(CORNERS), True),
]


def ply_header(form, *lines):
    return "\n".join(("ply", f"format {form} 1.0", *lines, "end_header", "")).encode()


XYZ = ("property float x", "property float y", "property float z")
TRIANGLE = ("element vertex 3", *XYZ, "element face 1",
            "property list uchar int vertex_indices")
WITH_LIST = ("comment a vertex with a list", "obj_info made by hand", "element vertex 2",
             "property double x", "property float32 y", "property float z",
             "property uchar red", "property uchar green", "property uchar blue",
             "property list ushort float weights")


def triangle(order):
    return (struct.pack(order + "9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
            + struct.pack(order + "B3i", 3, 0, 1, 2))


def with_list(order):
    return (struct.pack(order + "d2f3BH2f", 0, 0, 1, 255, 0, 0, 2, 0.5, 0.5)
            + struct.pack(order + "d2f3BH", 1, 0, 1, 0, 255, 0, 0))


def mesh(name, content):
    return Sample(name, "ply_mesh", content, True)


PLY_ASCII = ply_header("ascii", *TRIANGLE) + b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
PLY = [
    cloud("ascii.ply", "ply", PLY_ASCII),
    cloud("little_endian.ply", "ply",
          ply_header("binary_little_endian", "element vertex 4", *XYZ) + floats(CORNERS)),
    cloud("big_endian.ply", "ply",
          ply_header("binary_big_endian", *TRIANGLE) + triangle(">")),
    cloud("list_ascii.ply", "ply",
          ply_header("ascii", *WITH_LIST) + b"0 0 1 255 0 0 2 0.5 0.5\n1 nan 1 0 255 0 0\n"),
    cloud("list_little_endian.ply", "ply",
          ply_header("binary_little_endian", *WITH_LIST) + with_list("<")),
    cloud("list_big_endian.ply", "ply",
          ply_header("binary_big_endian", *WITH_LIST) + with_list(">")),
    mesh("mesh_ascii.ply", PLY_ASCII),
    mesh("mesh_little_endian.ply", ply_header("binary_little_endian", *TRIANGLE) + triangle("<")),
    mesh("mesh_big_endian.ply", ply_header("binary_big_endian", *TRIANGLE) + triangle(">")),
    cloud("ascii.ply.gz", "ply", gzipped(PLY_ASCII)),
]

TEXT = [
    cloud("blank.xyz", "xyz", b"0 0 1\n0.5 0 1\nnan nan nan\n0 0.25 1\n", False),
    cloud("header.csv", "xyz", b"x,y,z,intensity\n0,0,1,5\n0.5,0,1,6\n", False),
    cloud("colours.xyzrgb", "xyz", b"0 0 1 255 0 0\n0.5 0 1 0 255 9\n", False),
    cloud("plain.pts", "pts", b"3\n0 0 1\n0.5 0 1\n0 0.25 1\n"),
    cloud("intensity.pts", "pts", b"2\n0 0 1 -5\n0.5 0 1 6\n"),
    cloud("colours.pts", "pts", b"2\n0 0 1 -5 255 0 0\n0.5 0 1 6 0 9 3\n"),
]

SAMPLES = PCD + PLY + TEXT
