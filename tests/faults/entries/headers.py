# SPDX-License-Identifier: MIT
"""Rows 31 to 38: headers that promise missing or impossible data."""
import struct

from arrays import GRID, VALUES
from clouds import TRIANGLE, XYZ, floats, ply_header
import files
from files import DIPHA_MAGIC, GREY, RGB, dipha, npy, npy_header, npz, pcd_header, png, png_chunk, words

from entry import Entry, refused, sample, with_bytes, with_change

TERA = 10 ** 12
TOP = 2 ** 63 - 1
POINT = b"0 0 1\n"
RAW = floats([(0, 0, 1)])
OFF = "OFF\n{} {} 0\n0 0 0\n"


def ply(form, count):
    return (ply_header(form, f"element vertex {count}", *XYZ)
            + (POINT if form == "ascii" else RAW))


def shape(text, descr="<f8"):
    return npy_header(f"{{'descr': '{descr}', 'fortran_order': False, 'shape': {text}, }}") + bytes(8)


def nifti():
    return files.nifti("|u1", (3, 2), VALUES)


def with_size(content, width, height):
    """A PNG whose header states another size and has a matching checksum."""
    header = struct.pack(">II", width, height) + content[24:29]
    return content[:8] + png_chunk(b"IHDR", header) + content[33:]


def extents(*numbers):
    content = bytearray(nifti())
    struct.pack_into(f"<{len(numbers) + 1}h", content, 40, len(numbers), *numbers)
    return bytes(content)


def tera():
    for data, body in (("ascii", POINT), ("binary", RAW), ("binary_compressed", bytes(8) + RAW)):
        yield refused(31, "pcd", data, pcd_header(width=TERA, data=data) + body,
                      "truncated|uncompressed size")
    for form in ("ascii", "binary_little_endian", "binary_big_endian"):
        yield refused(31, "ply", form, ply(form, TERA), "truncated: the count of vertex does not fit")
    yield refused(31, "ply", "faces", with_change(sample("ply", "ascii.ply"), b"face 1",
                                                  b"face 1000000000000"), "count of face")
    yield refused(31, "off", "vertices", OFF.format(TERA, 0), "truncated: the counts do not fit")
    yield refused(31, "off", "faces", OFF.format(1, TERA), "truncated: the counts do not fit")
    yield refused(31, "off", "vertices after the word", f"OFF{TERA} 0 0\n0 0 0\n",
                  "truncated: the counts do not fit")
    yield refused(31, "points", "said rows", f"x y\n{TERA}\n0 0\n1 1\n",
                  "truncated, found 2 points, expected 1000000000000, as line 2 says")
    yield refused(31, "off", "corners", f"OFF\n1 1 0\n0 0 0\n{TERA} 0\n", "number of corners")
    yield refused(31, "pts", "points", f"{TERA}\n0 0 1\n", "number of points out of range")
    yield refused(31, "npy", "values", shape("(1000000000000,)"), "truncated, found 8 bytes")
    yield refused(31, "npy", "booleans", shape("(1000000000000,)", "|b1"), "truncated")
    yield refused(31, "npy-distance", "rows", shape("(1000000, 1000000)"), "truncated")
    yield refused(31, "npy-points", "rows", shape("(1000000000000, 1)"), "truncated")
    yield refused(31, "npz", "values", npz({"a.npy": shape("(1000000000000,)")}), "truncated")
    yield refused(31, "dipha", "values", dipha(1, TERA, 1, TERA, 0.), "number of values")
    yield refused(31, "dipha", "distances", dipha(7, TERA, 0.), "number of points")
    yield refused(31, "dipha", "a million distances", dipha(7, 10 ** 6, 0.), "number of points|trunc")
    yield refused(31, "dipha", "sparse distances", dipha(8, TERA, 0, 0), "number of points")
    yield refused(31, "dipha", "a degree", dipha(8, 1, TERA, 0, 0), "number of connections")
    yield refused(31, "dipha", "cells", dipha(0, 0, TERA, 1, 0), "number of cells")
    yield refused(31, "dipha", "facets", dipha(0, 0, 1, 0, 0, 0., 0, TERA), "number of facets")
    yield refused(31, "dipha", "axes", dipha(1, 1, TERA, 1), "number of axes")
    yield refused(31, "phat", "cells", words("<", TERA, 0, 0), "number of cells")
    yield refused(31, "phat", "facets", words("<", 1, 0, TERA), "number of facets")
    yield refused(31, "phat", "a dimension", words("<", 1, TERA, 0), "dimension of cell 0")
    yield refused(31, "pgm", "pixels, P5", b"P5 1000000 1000000 255\n\0", "truncated")
    yield refused(31, "pgm", "pixels, P2", "P2 1000000 1000000 255\n0\n", "truncated")
    yield refused(31, "png", "pixels", with_size(sample("image", "grey.png"), 65535, 65535),
                  "does not fit|PNG")
    yield refused(31, "perseus", "values", "1\n1000000000000\n1 2\n", "sizes do not fit the file")
    yield refused(31, "perseus", "a cube far away", "2\n1000000 1000000 5\n", "input.perseus")
    yield refused(31, "nifti", "voxels", extents(32767, 32767, 931), "truncated")
    yield refused(31, "nifti", "offset", with_bytes(nifti(), 108, struct.pack("<f", 1e12)),
                  "offset of the voxels")
    yield refused(31, "phat", "a dimension, ascii", f"{TERA}\n", ":1:1: dimension")


def overflow():
    half = 2 ** 32
    for data, body in (("ascii", POINT), ("binary", RAW), ("binary_compressed", bytes(8) + RAW)):
        yield refused(32, "pcd", f"2^32 x 2^32, {data}",
                      pcd_header(width=half, height=half, points=0, data=data) + body, "POINTS")
        yield refused(32, "pcd", f"2^62 points, {data}",
                      pcd_header(width=2 ** 62, data=data) + body, "truncated|uncompressed|points")
    yield refused(32, "npy", "2^32 x 2^32", shape(f"({half}, {half})"), "truncated")
    yield refused(32, "npy", "2^21 three times", shape("(2097152, 2097152, 2097152)"), "truncated")
    yield refused(32, "npy", "2^32 x 2^32 x 0", shape(f"({half}, {half}, 0)"), "input.npy")
    yield refused(32, "dipha", "2^61 distances", dipha(7, half, 0.), "number of points")
    yield refused(32, "dipha", "2^32 x 2^32", dipha(1, 0, 2, half, half), "number of values")
    yield refused(32, "dipha", "2^61 cells", dipha(0, 0, 2 ** 61, 1), "number of cells")
    yield refused(32, "phat", "2^60 cells", words("<", 2 ** 60, 0, 0), "number of cells")
    yield refused(32, "pgm", "2^31 x 2^31", "P5 2147483648 2147483648 255\n0", "truncated")
    yield refused(32, "pgm", "2^31 x 2^31, two bytes", "P5 2147483648 2147483648 256\n0", "truncated")
    yield refused(32, "pgm", "2^32 wide", "P5 4294967296 1 255\n0", "width out of range")
    yield refused(32, "png", "2^31 - 1 wide", with_size(sample("image", "grey.png"), TOP >> 32, 1),
                  "PNG")
    yield refused(32, "perseus", "2^40 x 2^40", f"2\n{2 ** 40} {2 ** 40}\n1\n", "do not fit the file")
    yield refused(32, "perseus", "16 axes of 2^40", f"16\n{' '.join([str(2 ** 40)] * 16)}\n1\n",
                  "do not fit the file")
    yield refused(32, "nifti", "7 axes of 32767", extents(*[32767] * 7), "truncated")
    yield refused(32, "off", "2^40 twice", OFF.format(2 ** 40, 2 ** 40), "counts do not fit")


def negative():
    for data in ("ascii", "binary", "binary_compressed"):
        yield refused(33, "pcd", f"WIDTH, {data}", pcd_header(width=-1, data=data) + POINT,
                      "WIDTH out of range, found .*-1")
    yield refused(33, "pcd", "HEIGHT", pcd_header(height=-1) + POINT, "HEIGHT out of range")
    yield refused(33, "pcd", "POINTS", pcd_header(points=-4) + POINT, "POINTS out of range")
    for form in ("ascii", "binary_little_endian"):
        yield refused(33, "ply", form, ply(form, -1), "count out of range, found .*-1")
    yield refused(33, "off", "vertices", OFF.format(-1, 0), "number of vertices out of range")
    yield refused(33, "off", "faces", OFF.format(1, -1), "number of faces out of range")
    yield refused(33, "off", "corners", "OFF\n1 1 0\n0 0 0\n-1 0\n", "number of corners out of range")
    yield refused(33, "pts", "points", "-1\n0 0 1\n", "input.pts")
    yield refused(33, "npy", "shape", shape("(-1,)"), "shape, found -1")
    yield refused(33, "npy", "both sides", shape("(-1, -1)"), "shape, found -1")
    yield refused(33, "dipha", "values", dipha(1, -1, 1, -1), "number of values")
    yield refused(33, "dipha", "an axis", dipha(1, 1, 1, -1, 0.), "size of an axis out of range")
    yield refused(33, "dipha", "distances", dipha(7, -2, 0.), "number of points")
    yield refused(33, "dipha", "facets", dipha(0, 0, 1, 0, 0, 0., 0, -1), "number of facets")
    yield refused(33, "dipha", "a facet", dipha(0, 0, 2, 1, 0, 1, 0., 0., 0, 0, 1, -1), "facet")
    yield refused(33, "dipha", "a dimension", dipha(0, 0, 1, 0, -1, 0., 0, 0), "dimension")
    yield refused(33, "phat", "cells", words("<", -1, 0, 0), "number of cells")
    yield refused(33, "phat", "facets", words("<", 1, 0, -1), "number of facets")
    yield refused(33, "phat", "a dimension, ascii", "-1\n", ":1:1: dimension out of range")
    yield refused(33, "pgm", "width", "P2 -1 1 9\n0\n", "width is not a number")
    yield refused(33, "pgm", "grey", "P2 1 1 9\n-1\n", "grey value is not a number")
    yield refused(33, "perseus", "dimension", "-1\n1\n1\n", ":1:1: dimension out of range")
    yield refused(33, "nifti", "an axis", extents(-3, 2), "size of axis 0, found -3")
    yield refused(33, "nifti", "number of axes", with_bytes(nifti(), 40, b"\xff\xff"),
                  "number of axes, found -1")
    yield refused(33, "nifti", "offset", with_bytes(nifti(), 108, struct.pack("<f", -352)),
                  "offset of the voxels")


def beyond_int64():
    word = str(2 ** 63)
    yield refused(34, "pcd", "WIDTH", pcd_header(width=word, points=1) + POINT, "WIDTH out of range")
    yield refused(34, "pcd", "POINTS", pcd_header(points=word) + POINT, "POINTS out of range")
    yield refused(34, "pcd", "2^63 - 1 points", pcd_header(width=TOP, data="binary") + RAW,
                  "truncated|points")
    yield refused(34, "ply", "count", ply("ascii", word), "count out of range")
    yield refused(34, "ply", "2^63 - 1 vertices", ply("binary_little_endian", TOP), "truncated")
    yield refused(34, "off", "vertices", OFF.format(word, 0), "number of vertices out of range")
    yield refused(34, "pts", "points", f"{word}\n0 0 1\n", "number of points out of range")
    yield refused(34, "npy", "shape", shape(f"({word},)"), "a number out of the range of int64")
    yield refused(34, "npy", "2^63 - 1", shape(f"({TOP},)"), "truncated")
    yield refused(34, "npy", "header length", b"\x93NUMPY\2\0" + b"\xff" * 4 + b"{}", "truncated")
    yield refused(34, "dipha", "2^63 - 1 values", dipha(1, TOP, 1, TOP, 0.), "number of values")
    yield refused(34, "dipha", "a dimension", dipha(0, 0, 1, TOP, TOP, 0., 0, 0), "dimension")
    yield refused(34, "phat", "2^63 - 1 cells", words("<", TOP, 0, 0), "number of cells")
    yield refused(34, "phat", "2^63 - 1 facets", words("<", 1, 0, TOP), "number of facets")
    yield refused(34, "pgm", "width", f"P2 {word} 1 9\n0\n", "width out of range")
    yield refused(34, "perseus", "a size", f"1\n{word}\n1\n", "size of an axis out of range")
    yield refused(34, "perseus", "dimension", f"{word}\n1\n", "dimension out of range")
    yield refused(34, "perseus", "-2^63", f"1\n-{word}\n1\n", "size of an axis out of range")


def disagreeing():
    yield refused(35, "pcd", "POINTS below", pcd_header(points=3) + POINT * 4, "not WIDTH x HEIGHT")
    yield refused(35, "pcd", "POINTS above", pcd_header(points=5) + POINT * 4, "not WIDTH x HEIGHT")
    yield refused(35, "pcd", "no WIDTH or POINTS", b"VERSION .7\nFIELDS x y z\nDATA ascii\n0 0 1\n",
                  "neither WIDTH nor POINTS")
    yield refused(35, "pcd", "no FIELDS", b"VERSION .7\nWIDTH 1\nDATA ascii\n0 0 1\n", "no FIELDS")
    yield refused(35, "pcd", "SIZE of two fields", with_change(pcd_header(), b"SIZE 4 4 4",
                                                              b"SIZE 4 4"), "SIZE too short")
    yield refused(35, "pcd", "WIDTH twice", with_change(pcd_header(), b"WIDTH 4",
                                                       b"WIDTH 4\nWIDTH 5"), "a second WIDTH")
    yield refused(35, "pcd", "a field twice", pcd_header("x y x") + POINT, "named twice")
    yield refused(35, "pcd", "no z", pcd_header("x y", "4 4", "F F", "1 1", 1) + b"0 1\n",
                  "no coordinate z")
    yield refused(35, "ply", "a property twice", ply_header("ascii", "element vertex 1", *XYZ, XYZ[0])
                  + b"0 0 0 0\n", "named twice")
    yield refused(35, "ply", "no z", ply_header("ascii", "element vertex 1", *XYZ[:2]) + b"0 0\n",
                  "no coordinate z")
    yield refused(35, "ply", "no vertices", ply_header("ascii", "element face 0",
                                                       "property list uchar int vertex_indices"),
                  "no element vertex")
    yield refused(35, "dipha", "values and sizes", dipha(1, 3, 1, 2, 0., 1., 2.), "number of values")
    yield refused(35, "dipha", "degrees and pairs", dipha(8, 2, 1, 0, 1, 1, 1.), "byte")
    yield refused(35, "dipha", "offsets fall", dipha(0, 0, 3, 1, 0, 0, 1, 0., 0., 1., 0, 2, 1, 2, 0, 1),
                  "offset of a cell's facets")
    yield refused(35, "pgm", "above the largest grey", "P2 1 1 9\n10\n", "grey value out of range")
    yield refused(35, "pgm", "above the largest grey, P5", b"P5 1 1 9\n\xff", "grey value out of range")
    yield refused(35, "pgm", "grey of 0", "P2 1 1 0\n0\n", "largest grey value out of range")
    yield refused(35, "pgm", "grey of 65536", "P2 1 1 65536\n0\n", "largest grey value out of range")
    yield refused(35, "xyz", "an atom less", "3\nwater\nO 0.5 0.25 1.5\nH 1 0.5 1.5\n",
                  "truncated, found 2 atoms, expected 3 atoms, as line 1 says")
    yield refused(35, "pts", "one point less", "3\n0 0 1\n1 0 1\n", "truncated, found 2 points")
    yield refused(35, "npy", "no shape", npy_header("{'descr': '<f8', 'fortran_order': False, }"),
                  "incomplete NPY header")
    yield refused(35, "npy", "descr twice", npy_header("{'descr': '<f8', 'descr': '<f4', }"),
                  "once each")


def depth_images():
    grey = sample("png", "depth.png")
    camera = ("--depth", "d.png", "--intrinsics", "100,100,4,3")

    def entry(row, name, content, message, *options, named="d.png", colour=b"", code=65):
        return Entry(row, f"depth: {name}", "ph-segment", (*camera, *options), code, message, named,
                     {"d.png": content, "c.png": colour} if colour else {"d.png": content})

    yield entry(35, "colours of another size", grey, "colour image: found 2 x 1 pixels, expected 8 x 6",
                "--color", "c.png", named="c.png", colour=png(2, 1, 8, GREY, [b"\1\2"]))
    yield entry(35, "colours are no picture", grey, "not a PNG", "--color", "c.png", named="c.png",
                colour=b"0 0 0\n")
    yield entry(38, "depth in colours", png(1, 1, 8, RGB, [b"\1\2\3"]), "found 3 channels, expected 1",
                named="d.png")
    yield entry(38, "a cloud", sample("pcd", "ascii.pcd"), "not a depth image")
    yield entry(31, "pixels", with_size(grey, 65535, 65535), "does not fit|PNG")


def counts_and_sizes():
    many = "1 1 2000000000"
    for data, body in (("ascii", POINT), ("binary", RAW), ("binary_compressed", bytes(8) + RAW)):
        yield refused(36, "pcd", f"COUNT 2e9, {data}", pcd_header(counts=many, data=data) + body,
                      "points too large")
    yield refused(36, "pcd", "COUNT 2^62", pcd_header(counts=f"1 1 {2 ** 62}") + POINT, "points too l")
    yield refused(36, "pcd", "COUNT 2^63", pcd_header(counts=f"1 1 {2 ** 63}") + POINT,
                  "COUNT out of range")
    yield refused(36, "pcd", "COUNT 0", pcd_header(counts="1 1 0") + POINT, "COUNT out of range")
    yield refused(36, "pcd", "COUNT -1", pcd_header(counts="1 1 -1") + POINT, "COUNT out of range")
    yield refused(36, "pcd", "COUNT 2 of z", pcd_header(width=1, counts="1 1 2") + POINT,
                  "truncated|incomplete")
    for size in (3, 5, 16, 0, -4):
        yield refused(37, "pcd", f"SIZE {size}", pcd_header(sizes=f"4 4 {size}") + POINT, "SIZE")
    yield refused(37, "pcd", "a float of 1", pcd_header(sizes="4 4 1") + POINT, "TYPE F of SIZE 1")
    yield refused(37, "npy", "a float of 3", shape("(1,)", "<f3"), "NPY element type, found <f3")
    yield refused(37, "npy", "a float of 16", shape("(1,)", "<f16"), "NPY element type")
    yield refused(37, "nifti", "bits of a voxel", with_bytes(nifti(), 72, b"\x18\0"),
                  "bits of a voxel, found 24")
    yield refused(37, "nifti", "header size", with_bytes(nifti(), 0, b"\x5d\1"),
                  "not a NIfTI-1 file")
    yield refused(37, "png", "3 bits", png(1, 1, 3, 0, [b"\0"]), "PNG")
    yield refused(37, "binary", "3 bytes", b"\0\0\0", "not a triangle")


def unknown():
    for kind in ("D", "float", "f", "S"):
        yield refused(38, "pcd", f"TYPE {kind}", pcd_header(types=f"F F {kind}") + POINT,
                      f"TYPE, found {kind}")
    yield refused(38, "pcd", "DATA", pcd_header(data="zipped") + POINT, "DATA, found zipped")
    yield refused(38, "pcd", "VERSION", with_change(pcd_header(), b"VERSION 0.7", b"VERSION 9"),
                  "PCD version")
    yield refused(38, "pcd", "keyword", with_change(pcd_header(), b"HEIGHT", b"HIGHT"), "HIGHT")
    yield refused(38, "pcd", "VIEWPOINT of 6", with_change(pcd_header(), b"0 0 0 1 0 0 0",
                                                          b"0 0 0 1 0 0"), "VIEWPOINT too short")
    yield refused(38, "ply", "a property", with_change(ply("ascii", 1), b"float z", b"quad z"),
                  "unknown PLY type")
    yield refused(38, "ply", "format", ply("ascii_3", 1), "PLY format")
    yield refused(38, "ply", "version", with_change(ply("ascii", 1), b"1.0", b"2.0"), "PLY version")
    yield refused(38, "ply", "no format", with_change(ply("ascii", 1), b"format ascii 1.0\n", b""),
                  "no format")
    yield refused(38, "ply", "keyword", with_change(ply("ascii", 1), b"element", b"elements"),
                  "PLY header")
    for descr, what in (("<c16", "complex numbers"), ("|O", "objects"), ("<U5", "text"),
                        ("|V8", "raw bytes"), ("<M8[s]", "times"), ("", "nothing"), ("f8", "no order"),
                        ("|f8", "no order for 8 bytes")):
        yield refused(38, "npy", what, shape("(1,)", descr), "NPY element type")
    for what, fields, message in (
            ("a structure", "('x', '<f4'), ('id', '<i4')", "found fields x, id, expected fields x, y and z"),
            ("a structure in a structure", "('x', [('y', '<f8')])", "a structure in a structure"),
            ("a field of text alone", "('name', '|S8')", "found fields name"),
            ("a field of 2^62 numbers", f"('x', '<f8', ({2 ** 62},))", "more than 2.20 bytes"),
            ("a field of 0 bytes", "('x', '<f8', (0,))", "records of 0 bytes"),
            ("a field without a type", "('x',)", "NPY header"),
            ("two fields of one name", "('x', '<f4'), ('x', '<f4')", "field named twice"),
            ("too few records", "('x', '<f8'), ('y', '<f8')", "truncated, found 8 bytes, expected 16")):
        yield refused(38, "npy", what, npy_header(
            f"{{'descr': [{fields}], 'fortran_order': False, 'shape': (1,), }}") + bytes(8), message)
    yield refused(38, "npy", "version", with_bytes(GRID, 6, b"\x09"), "NPY version, found 9")
    yield refused(38, "npy", "code in the header", npy_header("__import__('os').getpid()"),
                  "NPY header")
    yield refused(38, "npy", "a boolean of 2", npy("|b1", (2,), b"\1\2"), "not a boolean, found 2")
    yield refused(38, "npy", "2^53 + 1", npy("<i8", (1,), struct.pack("<q", 2 ** 53 + 1)),
                  "double cannot hold")
    for code in (1, 32, 128, 1536, 2304):
        yield refused(38, "nifti", f"datatype {code}",
                      with_bytes(nifti(), 70, struct.pack("<h", code)), f"datatype, found {code}")
    yield refused(38, "nifti", "a pair of files", with_bytes(nifti(), 344, b"ni1\0"), "pair")
    yield refused(38, "nifti", "ANALYZE", with_bytes(nifti(), 344, bytes(4)), "NIfTI magic")
    for kind in (3, 9, -1):
        yield refused(38, "dipha", f"type {kind}", dipha(kind, 0), "DIPHA|diagram")
    yield refused(38, "dipha", "magic number", words("<", DIPHA_MAGIC + 1, 1), "not a DIPHA file")
    yield refused(38, "dipha", "a dualised matrix", dipha(0, 1, 0, 0, 0), "dualised")
    for magic in ("P1", "P3", "P4", "P6", "P7", "p2"):
        yield refused(38, "pgm", magic, f"{magic} 1 1 9\n0\n", "not a PGM file")
    yield refused(38, "png", "colours", png(1, 1, 8, 2, [b"\0\1\0"]),
                  "grey.*--channel")
    yield refused(38, "png", "signature of text mode", with_bytes(sample("image", "grey.png"), 4,
                                                                  b"\n\n"), "not a PNG")
    yield refused(38, "off", "first word", "OFFSET\n1 0 0\n0 0 0\n", "not an OFF file")
    yield refused(38, "perseus", "17 axes", "17\n1\n", "dimension out of range")
    yield refused(38, "simplices", "a mesh", ply_header("ascii", *TRIANGLE), "no value|input")


ENTRIES = [*tera(), *overflow(), *negative(), *beyond_int64(), *disagreeing(), *depth_images(),
           *counts_and_sizes(),
           *unknown()]
