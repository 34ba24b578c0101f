# SPDX-License-Identifier: MIT
"""Samples of merge trees of scenes, as ph-segment stores them."""
import binascii
import struct

from sample import Sample
from files import words

SURFACE, PAPER = 0, 1
SUPPORT = 1
NO_VERTEX = 0xFFFFFFFF


def header(method, size, counts, distance, plane, cut):
    """The header of a stored tree. @param counts vertices, merges, points with a vertex, edges.
    @param cut value, min_part, … The plane, if there is one, is the only surface."""
    surface = words("<", SUPPORT, *plane[1:], *[0.] * 15) if plane[0] else b""
    return b"ph-tree\n" + words("<", 4, method, *size, *counts, 1.0, 0.0, 0.0, 0.0, distance, 0,
                                *plane, *cut, plane[0], plane[0], 0) + surface


def tree(name, *parts):
    content = b"".join(parts)
    content += struct.pack("<I", binascii.crc32(content))
    return Sample(name, "tree", content, True, program="ph-segment")


def merge(value, u, v):
    return struct.pack("<dII", value, u, v)


# Three voxels in a row, each with an edge of one metre; four points and a hole.
CELLS = words("<", 0., 0., 1., 1., 0., 1., 2., 0., 1.)
CENTROIDS = words("<", .5, .5, 1.5, 1.25, .5, 1.5, 2.5, .5, 1.5)
POINTS = struct.pack("<5I", 0, 1, NO_VERTEX, 1, 2) + struct.pack(
    "<12f", .5, .5, 1.5, 1.25, .25, 1.5, 1.25, .75, 1.5, 2.5, .5, 1.5)

SAMPLES = [
    tree("surface.tree",
         header(SURFACE, (5, 1), (3, 2, 4, 2), 0., (1, 0., 0., -1., 3., .25), (.5, 1, 1, 1)),
         CELLS, CENTROIDS, words("<", 0., 0., -1., 0., 0., -1., *[float("nan")] * 3),
         words("<", 1, 2, 1), words("<", .25, 0., .125), merge(.25, 1, 0), merge(.75, 2, 1), POINTS),
    tree("paper.tree",
         header(PAPER, (5, 1), (3, 2, 4, 2), 1.5, (0, 0., 0., 0., 0., 0.), (1., 1, 1, 0)),
         CELLS, CENTROIDS, words("<", 1, 2, 1), words("<", 0., 0., 0.), merge(.75, 1, 0),
         merge(1.25, 2, 1), POINTS),
    tree("empty.tree",
         header(SURFACE, (2, 1), (0, 0, 0, 0), 0., (0, 0., 0., 0., 0., 0.), (.01, 200, 32, 1)),
         struct.pack("<2I", NO_VERTEX, NO_VERTEX)),
]
