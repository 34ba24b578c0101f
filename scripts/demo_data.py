#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the demo's inputs from data of installed Debian packages: demo_data.py FOLDER.

kitten.csv      5 210 points on the surface of a cat whose tail makes a loop (libcgal-demo)
skull.npy       a CT volume of a skull, 64^3 (libcgal-demo)
depth.png, color.png   the RGB-D frame Motorcycle of the Middlebury stereo set (python3-skimage)
table.npy       a synthetic depth image in metres, focal length 525 pixels: a table with a book, two
                boxes side by side, two cans and a pen, and a wall behind the table
"""
import pathlib
import shutil
import sys
import tarfile

import numpy

CGAL_DATA = "/usr/share/doc/libcgal-dev/data.tar.gz"
SKIMAGE_DATA = pathlib.Path("/usr/lib/python3/dist-packages/skimage/data")


def cgal_file(name):
    with tarfile.open(CGAL_DATA) as archive:
        return archive.extractfile(name).read()


def write_kitten(path):
    rows = [line.split()[:3] for line in cgal_file("data/points_3/kitten.xyz").decode().splitlines()]
    path.write_text("x,y,z\n" + "".join(",".join(row) + "\n" for row in rows if row))


def write_skull(path):
    """Reads INRIMAGE-4: a header of 256 bytes, then float32, x fastest."""
    raw = cgal_file("data/images/skull_2.9.inr")
    header = dict(line.split("=", 1) for line in raw[:256].decode("ascii").splitlines() if "=" in line)
    shape = [int(header[axis]) for axis in ("ZDIM", "YDIM", "XDIM")]
    if header["TYPE"] != "float" or header["CPU"] != "decm":
        raise SystemExit(f"skull: found {header}, expected little-endian floats")
    numpy.save(path, numpy.frombuffer(raw, "<f4", offset=256).reshape(shape))


def write_motorcycle(folder):
    """Computes depth in millimetres from disparity: Z = focal length * baseline / (disparity +
    offset)."""
    import struct
    import zlib

    disparity = numpy.load(SKIMAGE_DATA / "motorcycle_disp.npz")["arr_0"]
    depth = 994.978 * 193.001 / (disparity + 31.086)
    depth = numpy.where(numpy.isfinite(disparity), numpy.rint(depth), 0).astype(">u2")
    height, width = depth.shape

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + row.tobytes() for row in depth)
    (folder / "depth.png").write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
    shutil.copy(SKIMAGE_DATA / "motorcycle_left.png", folder / "color.png")


def write_table(path):
    """A camera 0.9 m from the table looks down at an angle of 40 degrees. The depth noise grows
    with the square of the range."""
    width, height, focal = 640, 480, 525.0
    tilt = numpy.radians(40)
    u, v = numpy.meshgrid(numpy.arange(width) - 319.5, numpy.arange(height) - 239.5)
    # The axes of the table: x right, y away, z up. The camera looks at the middle of the table.
    eye = 0.9 * numpy.array([0, -numpy.cos(tilt), numpy.sin(tilt)])
    forward = numpy.array([0, numpy.cos(tilt), -numpy.sin(tilt)])
    down = numpy.array([0, -numpy.sin(tilt), -numpy.cos(tilt)])
    rays = (u[..., None] / focal * numpy.array([1.0, 0, 0]) + v[..., None] / focal * down + forward)
    depth = numpy.full((height, width), numpy.inf)

    def plane(axis, at, inside):
        with numpy.errstate(divide="ignore", invalid="ignore"):
            t = (at - eye[axis]) / rays[..., axis]
            hit = (t > 0) & inside(eye + t[..., None] * rays)
        depth[hit] = numpy.minimum(depth, t)[hit]

    def box(low, high):
        with numpy.errstate(divide="ignore", invalid="ignore"):
            a, b = (numpy.array(low) - eye) / rays, (numpy.array(high) - eye) / rays
        enter, leave = numpy.minimum(a, b).max(-1), numpy.maximum(a, b).min(-1)
        hit = (enter < leave) & (enter > 0)
        depth[hit] = numpy.minimum(depth, enter)[hit]

    def cylinder(x, y, radius, top):
        across, from_axis = rays[..., :2], eye[:2] - (x, y)
        a, b = (across ** 2).sum(-1), (across * from_axis).sum(-1)
        root = b * b - a * ((from_axis ** 2).sum() - radius ** 2)
        t = (-b - numpy.sqrt(numpy.maximum(root, 0))) / a
        z = eye[2] + t * rays[..., 2]
        hit = (root > 0) & (z > 0) & (z < top)
        depth[hit] = numpy.minimum(depth, t)[hit]
        plane(2, top, lambda p: (p[..., 0] - x) ** 2 + (p[..., 1] - y) ** 2 < radius ** 2)

    plane(2, 0, lambda p: (abs(p[..., 0]) < 0.7) & (abs(p[..., 1]) < 0.45))
    plane(1, 0.6, lambda p: p[..., 2] > -0.7)
    box((-0.3, -0.2, 0), (-0.14, 0.02, 0.004))    # the book
    box((-0.08, -0.02, 0), (0.04, 0.12, 0.12))    # two boxes that touch
    box((0.04, 0.0, 0), (0.14, 0.1, 0.06))
    cylinder(0.27, -0.05, 0.033, 0.115)           # the cans
    cylinder(-0.2, 0.16, 0.045, 0.09)
    box((0.05, -0.2, 0), (0.11, -0.193, 0.009))   # the pen
    noise = numpy.random.default_rng(7).normal(0, 0.0004, depth.shape)
    depth = numpy.where(numpy.isfinite(depth), depth + noise * depth ** 2, numpy.nan)
    numpy.save(path, depth.astype("<f4"))


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    # The first function needs no other package; each of the others stops the script if its package
    # is missing.
    write_table(folder / "table.npy")
    write_kitten(folder / "kitten.csv")
    write_skull(folder / "skull.npy")
    write_motorcycle(folder)


if __name__ == "__main__":
    main()
