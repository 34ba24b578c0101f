# SPDX-License-Identifier: MIT
"""The inputs of compare_images.py: seeded pictures and volumes, and scans. Needs numpy."""
import gzip
import math
import re
import struct
from dataclasses import dataclass

import numpy

SEED = 1


@dataclass(frozen=True)
class Row:
    name: str
    shape: tuple
    kind: str
    usual: bool  # measured unless --rows selects other rows


def noise(shape, generator):
    return generator.random(shape)


def eight_bit(shape, generator):
    return numpy.floor(256 * generator.random(shape))


def smooth(shape, generator):
    """A few waves with a little noise: features are tens of voxels wide, and about one voxel in a
    few hundred is critical."""
    axes = numpy.meshgrid(*[numpy.arange(n, dtype=float) for n in shape], indexing="ij", sparse=True)
    waves = sum(math.sin(1 + k) * numpy.sin(0.05 * (1 + k % 3) * sum((1 + (k + j) % 3) * x for j, x in enumerate(axes)))
                for k in range(5))
    return waves + 0.01 * generator.random(shape)


def smooth_8_bit(shape, generator):
    """The image of `smooth` as a camera or scanner would store it: 256 values, most neighbours
    equal, and a little noise between two neighbouring values."""
    values = smooth(shape, generator)
    values -= values.min()
    return numpy.floor(values * (255.99 / values.max()))


def elevation(shape, _):
    """A ramp along the diagonal, which has a single bar."""
    return sum(numpy.meshgrid(*[numpy.arange(n, dtype=float) for n in shape], indexing="ij", sparse=True))


def marschner_lobb(shape, _):
    """Concentric rings on [-1, 1]^3 whose wavelength decreases towards the middle (Marschner &
    Lobb, An evaluation of reconstruction filters for volume rendering, 1994)."""
    alpha, frequency = 0.25, 6
    z, y, x = numpy.meshgrid(*[numpy.linspace(-1, 1, n) for n in shape], indexing="ij", sparse=True)
    rings = numpy.cos(2 * math.pi * frequency * numpy.cos(math.pi * numpy.sqrt(x * x + y * y) / 2))
    return (1 - numpy.sin(math.pi * z / 2) + alpha * (1 + rings)) / (2 * (1 + alpha))


KINDS = {"noise": noise, "smooth": smooth, "8-bit": eight_bit, "smooth 8-bit": smooth_8_bit}
SIZES = {"2048²": (2048, 2048), "64³": (64, 64, 64), "128³": (128, 128, 128), "256³": (256, 256, 256),
         "512³": (512, 512, 512), "24⁴": (24, 24, 24, 24), "32⁴": (32, 32, 32, 32)}

ROWS = [Row(f"{size} {kind}", shape, kind, math.prod(shape) <= 2048**2 or (size, kind) == ("256³", "smooth"))
        for size, shape in SIZES.items() for kind in KINDS]
# The synthetic images from the table of Guillou, Vidal & Tierny, Discrete Morse Sandwich.
MADE = {"random": noise, "elevation": elevation, "Marschner-Lobb": marschner_lobb}
ROWS += [Row(f"192³ {kind}", (192, 192, 192), kind, usual=False) for kind in MADE]
ROWS.append(Row("16³ smooth", (16, 16, 16), "smooth", usual=False))  # a small row for the tests


def inrimage(content):
    """A volume of float32 in Inrimage-4, as in CGAL's examples: a text header of 256 bytes, x
    fastest."""
    header = dict(re.findall(r"^(\w+)=(\S+)", content[:256].decode("ascii"), re.MULTILINE))
    if (header["TYPE"], header["VDIM"]) != ("float", "1"):
        raise ValueError(f"Inrimage: found TYPE={header['TYPE']}, VDIM={header['VDIM']}, expected float, 1")
    shape = [int(header[axis + "DIM"]) for axis in "ZYX"]
    return numpy.frombuffer(content, numpy.float32, math.prod(shape), 256).reshape(shape)


def nifti(content):
    """A volume of bytes in NIfTI-1, little-endian, x fastest."""
    kind, = struct.unpack_from("<h", content, 70)
    if kind != 2:
        raise ValueError(f"NIfTI: found type {kind}, expected 2, unsigned bytes")
    shape = struct.unpack_from("<3h", content, 42)[::-1]
    begin, = struct.unpack_from("<f", content, 108)
    return numpy.frombuffer(content, numpy.uint8, math.prod(shape), int(begin)).reshape(shape)


# Scans from Debian packages: libcgal-demo (in data.tar.gz) and mricron-data.
SCANS = {"CT skull": ((64, 64, 64), "skull_2.9.inr", inrimage), "MRI head": ((181, 217, 181), "ch2.nii.gz", nifti)}
ROWS += [Row(name, shape, "scan", False) for name, (shape, _, _) in SCANS.items()]


def values_of(row, scans):
    if row.kind != "scan":
        return (KINDS | MADE)[row.kind](row.shape, numpy.random.default_rng(SEED))
    _, name, read = SCANS[row.name]
    content = (scans / name).read_bytes()
    return read(gzip.decompress(content) if name.endswith(".gz") else content).astype(float)


def input_file(row, made, scans):
    """The path of a row's input, which is written first if it is missing. `scans` is the folder of
    the scans."""
    path = made / (row.name.replace(" ", "_") + ".npy")
    if not path.exists():
        part = path.with_suffix(".part.npy")
        numpy.save(part, values_of(row, scans))
        part.rename(path)
    return path
