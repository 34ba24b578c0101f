#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the demo's inputs from data of installed Debian packages: demo_data.py FOLDER.

kitten.csv      5 210 points on the surface of a cat whose tail makes a loop (libcgal-demo)
skull.npy       a CT volume of a skull, 64^3 (libcgal-demo)
depth.png, color.png   the RGB-D frame Motorcycle of the Middlebury stereo set (python3-skimage)
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
    """INRIMAGE-4: a header of 256 bytes, then float32, x fastest."""
    raw = cgal_file("data/images/skull_2.9.inr")
    header = dict(line.split("=", 1) for line in raw[:256].decode("ascii").splitlines() if "=" in line)
    shape = [int(header[axis]) for axis in ("ZDIM", "YDIM", "XDIM")]
    if header["TYPE"] != "float" or header["CPU"] != "decm":
        raise SystemExit(f"skull: found {header}, expected little-endian floats")
    numpy.save(path, numpy.frombuffer(raw, "<f4", offset=256).reshape(shape))


def write_motorcycle(folder):
    """Depth in millimetres from disparity: Z = focal length * baseline / (disparity + offset)."""
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


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    write_kitten(folder / "kitten.csv")
    write_skull(folder / "skull.npy")
    write_motorcycle(folder)


if __name__ == "__main__":
    main()
