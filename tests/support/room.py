# SPDX-License-Identifier: MIT
"""A depth camera's view of a synthetic table with boxes in front of a wall with a board, and of a
small wall at the side, as an organised PCD file."""
import math
import random
import struct

EYE = (0.0, -0.9, 0.9)  # x right, y away, z up; the camera looks down at 45 degrees
TABLE = ((-0.6, -0.5, -0.02), (0.6, 0.5, 0.0))
LARGE, SMALL = ((-0.12, -0.05, 0.0), (0.06, 0.09, 0.13)), ((-0.07, -0.02, 0.13), (0.02, 0.07, 0.2))
BESIDE = ((0.13, -0.05, 0.0), (0.27, 0.07, 0.11))
WALL = ((-0.5, 0.6, -0.1), (0.5, 0.62, 1.5))
BOARD = ((-0.45, 0.25, 0.25), (0.45, 0.58, 0.27))
PANEL = ((-0.6, 0.1, -0.1), (-0.58, 0.22, 0.2))
BLOCKS = (TABLE, LARGE, SMALL, BESIDE, WALL, BOARD, PANEL)


def _entry(block, ray):
    near, far = 0.0, math.inf
    for low, high, eye, step in zip(*block, EYE, ray):
        a, b = (low - eye) / step, (high - eye) / step
        near, far = max(near, min(a, b)), min(far, max(a, b))
    return near if 0 < near < far else math.inf


def room(width=240, height=180, seed=1, noise=0.0005):
    """The bytes of the PCD file. The depth noise grows with the square of the depth."""
    rng, focal, c = random.Random(seed), 0.53 * width, math.sqrt(0.5)
    records = []
    for v in range(height):
        for u in range(width):
            px, py = (u - width / 2 + 0.5) / focal, (v - height / 2 + 0.5) / focal
            ray = (px, c - c * py, -c - c * py)
            depth = min(_entry(block, ray) for block in BLOCKS)
            depth += noise * depth * depth * rng.gauss(0, 1) if depth < math.inf else 0
            point = [eye + depth * step if depth < math.inf else math.nan
                     for eye, step in zip(EYE, ray)]
            records.append(struct.pack("<fff", *point))
    header = ("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
              f"WIDTH {width}\nHEIGHT {height}\nVIEWPOINT {EYE[0]} {EYE[1]} {EYE[2]} 1 0 0 0\n"
              f"POINTS {width * height}\nDATA binary\n")
    return header.encode() + b"".join(records)
