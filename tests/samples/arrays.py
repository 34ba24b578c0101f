# SPDX-License-Identifier: MIT
"""Samples of binary formats: NumPy, NIfTI, NRRD, MetaImage, VTI, DIPHA, PHAT, Ripser's
triangle, PGM and PNG."""
import struct
import zipfile
import zlib

from sample import Sample
import files
import tiff_files
from tiff_files import page, tiff
from files import (GREY, GREY_ALPHA, KINDS, META_TYPES, NIFTI_TYPES, NRRD_TYPES, PALETTE, RGB, RGBA, VTI_TYPES, gzipped, npy, npy_header,
                   npz, packed, png, png_chunk, words)

VALUES = [0, 5, 2, 4, 9, 1]


def numpy_image(name, descr, shape=(2, 3), values=VALUES, **options):
    return Sample(name, "npy_image", npy(descr, shape, packed(descr, values), **options), True)


GRID = npy("<f8", (2, 3), packed("<f8", VALUES))
# A structured array with padding, text and a field of two numbers.
RECORDS = npy_header(
    "{'descr': [('ring', '|u1'), ('x', '<f4'), ('y', '<f4'), ('', '|V2'), ('z', '<f4'), "
    "('name', '|S3'), ('pair', '<u2', (2,))], 'fortran_order': False, 'shape': (3,), }"
) + b"".join(struct.pack("<Bff2xf3s2H", k, k / 4, 1 - k, 2, b"abc", k, 7) for k in range(3))
NUMPY = [
    *(numpy_image(f"{kind}.npy", ("|" if kind in ("b1", "i1", "u1") else "<") + kind)
      for kind in KINDS),
    *(numpy_image(f"big_endian_{kind}.npy", ">" + kind) for kind in KINDS if kind[1] != "1"),
    numpy_image("fortran.npy", "<f8", fortran=True),
    numpy_image("fortran_volume.npy", "<i2", (2, 1, 3), fortran=True),
    numpy_image("version_2.npy", "<f4", version=2),
    numpy_image("version_3.npy", "<f8", version=3),
    numpy_image("vector.npy", "<f8", (6,)),
    Sample("number.npy", "npy_image",
           npy_header("{'descr': '<f8', 'fortran_order': False, 'shape': (), }")
           + struct.pack("<d", 7), True),
    numpy_image("infinite.npy", "<f8", (3,), [float("-inf"), 1, float("inf")]),
    Sample("keys_in_any_order.npy", "npy_image",
           npy_header('{"shape": (1,2,), "fortran_order": True, "descr": "<u2"}') + b"\1\0\2\0",
           True),
    Sample("points.npy", "points", npy("<f8", (3, 2), packed("<f8", VALUES)), True,
           ("{}", "--complex", "rips")),
    Sample("distances.npy", "distances",
           npy("<f4", (3, 3), packed("<f4", [0, 1, 2, 1, 0, 1.5, 2, 1.5, 0])), True,
           ("{}", "--format", "distance")),
    Sample("records.npy", "npy_points", RECORDS, True),
    Sample("records_of_a_cloud.npy", "npy_cloud", RECORDS, True, ("{}",),
           "ph-segment"),
    Sample("stored.npz", "image", npz({"a.npy": GRID}), True),
    Sample("deflated.npz", "image", npz({"a.npy": GRID}, zipfile.ZIP_DEFLATED), True),
    Sample("two.npz", "points", npz({"a.npy": GRID, "points.npy": GRID}), True,
           ("{}:points", "--complex", "rips")),
    Sample("grid.npy.gz", "image", gzipped(GRID), True),
]


def nifti_sample(name, descr, extents=(3, 2), values=VALUES, **options):
    return Sample(name, "nifti", files.nifti(descr, extents, values, **options), True)


NIFTI = [
    *(nifti_sample(f"{kind}.nii", "<" + kind) for kind in NIFTI_TYPES if kind != "i8"),
    nifti_sample("f4_scaled.nii", "<f4", slope=0.5, intercept=-1),
    nifti_sample("big_endian_f8.nii", ">f8"),
    nifti_sample("volume_i8.nii", "<i8", extents=(3, 1, 2, 1, 1)),
    Sample("u2.nii.gz", "nifti", gzipped(files.nifti("<u2", (3, 2), VALUES)), True),
]


def nrrd_sample(name, descr, extents=(3, 2), values=VALUES, **options):
    return Sample(name, "nrrd", files.nrrd(descr, extents, values, **options), True)


SCANNER = ("space: left-posterior-superior\nspace directions: (1,0,0) (0,0,2.5) none\n"
           "space origin: (-3,4,0.5)\nkinds: domain domain time\n# by hand\nunits key:=mm\n")
NRRD = [
    *(nrrd_sample(f"{kind}.nrrd", "<" + kind) for kind in NRRD_TYPES),
    nrrd_sample("big_endian_i2.nrrd", ">i2"),
    nrrd_sample("packed.nrrd", "<u2", encoding="gzip"),
    nrrd_sample("text.nrrd", "|u1", encoding="text"),
    nrrd_sample("text_of_floats.nrrd", "<f4", encoding="text", lines="spacings: 1 0.5\n"),
    nrrd_sample("scanner.nrrd", "|u1", (3, 2, 1), lines=SCANNER),
    nrrd_sample("at_the_end.nrrd", "|u1", lines="byte skip: -1\n"),
]


def meta_sample(name, descr, extents=(3, 2), values=VALUES, **options):
    return Sample(name, "metaimage", files.meta_image(descr, extents, values, **options), True)


META_IMAGE = [
    *(meta_sample(f"{kind}.mha", "<" + kind) for kind in META_TYPES),
    meta_sample("big_endian_i2.mha", ">i2"),
    meta_sample("packed.mha", "<u2", encoding="gzip"),
    meta_sample("text.mha", "|u1", encoding="text"),
    meta_sample("placed.mha", "|u1", (3, 2, 1), lines="ElementSpacing = 1 0.5 2\nOffset = -3 4 0.5\n"
                "TransformMatrix = 1 0 0 0 0 1 0 1 0\nAnatomicalOrientation = RAI\n"),
    meta_sample("at_the_end.mha", "|u1", lines="HeaderSize = -1\nComment = by hand\n"),
]


def vti_sample(name, descr, encoding, extents=(3, 2), values=VALUES, **options):
    return Sample(name, "vti", files.vti(descr, extents, values, encoding, **options), True)


VTI = [
    *(vti_sample(f"{kind}.vti", "<" + kind, "base64") for kind in VTI_TYPES),
    *(vti_sample(f"{encoding}.vti", "<u2", encoding)
      for encoding in ("text", "raw", "appended_base64", "gzip_base64", "gzip_raw",
                       "gzip_appended_base64")),
    vti_sample("big_endian_i2.vti", ">i2", "gzip_raw"),
    vti_sample("placed.vti", "|u1", "text", (3, 1, 2),
               image='Spacing="1 0.5 2" Origin="-3 4 0.5" Direction="1 0 0 0 0 1 0 1 0"'),
]


def dipha(name, reader, *numbers):
    return Sample(name, reader, files.dipha(*numbers), True)


DIPHA = [
    dipha("image.dipha", "image", 1, 6, 2, 3, 2, *map(float, VALUES)),
    dipha("volume.dipha", "image", 1, 4, 3, 2, 1, 2, 1., -2., float("inf"), 0.5),
    dipha("many_distances.dipha", "distances", 7, 6, *(float(abs(i - j)) for i in range(6)
                                                       for j in range(6))),
    dipha("distances.dipha", "distances", 7, 3, 0., 1., 2., 1., 0., 1.5, 2., 1.5, 0.),
    dipha("sparse.dipha", "sparse", 8, 3, 2, 1, 0, 1, 2, 0, 1., 2., 1.),
    dipha("boundary.dipha", "phat", 0, 0, 3, 1, 0, 0, 1, 0.0, 0.5, 2.0, 0, 0, 0, 2, 0, 1),
    dipha("any_order.dipha", "phat", 0, 0, 3, 1, 1, 0, 0, 2.0, 0.0, 0.5, 0, 2, 2, 2, 2, 1),
]

BINARY = [
    Sample("binary.bin", "binary_distances", struct.pack("<6f", 1, 2, 1.25, 1.5, 2, 1), False),
    Sample("pair.bin", "binary_distances", struct.pack("<f", 0.5), False,
           ("{}", "--format", "binary")),
    Sample("triangle_binary.phat", "phat",
           words("<", 7, 0, 0, 0, 0, 0, 0, 1, 2, 0, 1, 1, 2, 1, 2, 1, 2, 0, 2, 2, 3, 3, 4, 5), True),
]


def depth_scene():
    """A depth image of 8 x 6 pixels in millimetres: a box in front of a wall, and a hole."""
    rows = [[2000] * 8 for _ in range(6)]
    for y in range(2, 5):
        rows[y][2:5] = [1000, 1000, 1000]
    rows[0][0] = 0
    return [struct.pack(">8H", *row) for row in rows]


CAMERA = ("--intrinsics", "100,100,4,3")
COLOUR_OF = ("--depth", "depth.png", "--color", "{}", *CAMERA)


def colour(name, *arguments, **options):
    return Sample(name, "png", png(*arguments, **options), True, COLOUR_OF, "ph-segment",
                  ("depth.png",))


def interlaced_grey():
    """A PNG of 2 x 2 pixels, interlaced by Adam7: passes 1, 6 and 7 hold the pixels (0,0) and (1,0)
    and the second row."""
    header = struct.pack(">IIBBBBB", 2, 2, 8, GREY, 0, 0, 1)
    return (b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", header)
            + png_chunk(b"IDAT", zlib.compress(b"\0\1" b"\0\2" b"\0\3\4")) + png_chunk(b"IEND", b""))


PALETTE_CHUNK = png_chunk(b"PLTE", bytes([0, 0, 0, 255, 0, 0, 0, 0, 255]))
PICTURES = [
    Sample("grey.png", "image", png(3, 2, 8, GREY, [b"\0\5\2", b"\4\11\1"]), True),
    Sample("grey_16.png", "image", png(2, 2, 16, GREY, [b"\0\0\xff\xff", b"\1\0\0\1"]), True),
    Sample("grey_1.png", "image", png(3, 2, 1, GREY, [b"\xa0", b"\x40"]), True),
    Sample("interlaced.png", "image", interlaced_grey(), True),
    Sample("text_chunk.png", "image",
           png(2, 1, 8, GREY, [b"\1\2"], png_chunk(b"tEXt", b"Title\0two pixels")), True),
    Sample("depth.png", "png", png(8, 6, 16, GREY, depth_scene()), True,
           ("--depth", "{}", *CAMERA), "ph-segment"),
    colour("colour.png", 8, 6, 8, RGB, [bytes([255, 128, 0]) * 8] * 6),
    colour("colour_16.png", 8, 6, 16, RGB, [bytes([1, 2, 3, 4, 5, 6]) * 8] * 6),
    colour("alpha.png", 8, 6, 8, RGBA, [bytes([255, 128, 0, 9]) * 8] * 6),
    colour("grey_alpha.png", 8, 6, 8, GREY_ALPHA, [bytes([7, 255]) * 8] * 6),
    colour("palette.png", 8, 6, 8, PALETTE, [bytes([0, 1, 2, 0, 1, 2, 0, 1])] * 6,
           extra=PALETTE_CHUNK),
    Sample("raw.pgm", "image", b"P5 3 2 9\n" + bytes(VALUES), True),
    Sample("raw_16.pgm", "image", b"P5\n# deep\n2 2\n65535\n" + b"\0\1\xff\xff\1\0\0\0", True),
]

DEEP = [k * k % 251 for k in range(300)]
TIFF = [Sample(name + ".tif", "tiff", content, True) for name, content in (
    *((kind, tiff([page("<" + kind, (2, 3), VALUES)])) for kind in KINDS if kind != "b1"),
    ("big_endian_i2", tiff([page(">i2", (2, 3), VALUES)], ">")),
    ("bigtiff_f8", tiff([page("<f8", (2, 3), VALUES)], big=True)),
    ("bilevel", tiff([page("|u1", (2, 1), [0xA0, 0x40], t256=3, t258=1)])),
    ("lzw", tiff([page("|u1", (15, 20), DEEP, tiff_files.LZW)])),
    ("deflate", tiff([page("<u2", (2, 3), VALUES, tiff_files.DEFLATE, t317=2)])),
    ("old_deflate", tiff([page("<u4", (2, 3), VALUES, tiff_files.OLD_DEFLATE)])),
    ("float_bytes", tiff([page("<f4", (2, 3), [0] * 6, tiff_files.DEFLATE, t317=3)])),
    ("pack_bits", tiff([page("|u1", (2, 3), [0, 0, 0, 4, 9, 9], tiff_files.PACK_BITS)])),
    ("tiles", tiff([page("|u1", (2, 3), VALUES, chunk=(1, 2))])),
    ("pages", tiff([page("|u1", (1, 3), VALUES[:3]), page("|u1", (1, 3), VALUES[3:])])),
    ("reduced", tiff([page("|u1", (2, 3), VALUES), page("|u1", (1, 1), [3], t254=1)])),
    ("grey_alpha", tiff([page("|u1", (1, 2), [1, 255, 2, 255], t338=1)])),
)]

SAMPLES = NUMPY + NIFTI + NRRD + META_IMAGE + VTI + DIPHA + BINARY + PICTURES + TIFF
