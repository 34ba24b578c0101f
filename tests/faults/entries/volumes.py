# SPDX-License-Identifier: MIT
"""Rows 31 to 38: volumes of microscopy and medicine whose headers are wrong."""
import contextlib
import os
import struct
import zlib

from arrays import VALUES
import files
import tiff_files

from entry import Entry, bars, refused, taken, with_bytes, with_change

BARS = bars("0,0,inf", "0,1,5")
PICTURE_BARS = BARS  # the same image with its axes exchanged


def nrrd(lines="", **options):
    return files.nrrd(**{"descr": "|u1", "extents": (3, 2), "values": VALUES, "lines": lines,
                         **options})


def nrrd_entries():
    yield refused(31, "nrrd", "10^12 voxels", nrrd(extents=(10 ** 6, 10 ** 6)), "truncated, found 6")
    yield refused(31, "nrrd", "10^12 voxels as text",
                  nrrd(extents=(10 ** 6, 10 ** 6), encoding="text"), "sizes do not fit the file")
    yield refused(31, "nrrd", "10^12 voxels, packed",
                  nrrd(extents=(10 ** 6, 10 ** 6), encoding="gzip"), "truncated, found 6")
    yield refused(32, "nrrd", "2^32 x 2^32", nrrd(extents=(2 ** 32, 2 ** 32)), "more than 2.64")
    yield refused(32, "nrrd", "2^32 x 2^32 as text",
                  nrrd(extents=(2 ** 32, 2 ** 32), encoding="text"), "more than 2.64")
    yield refused(33, "nrrd", "a size", nrrd(extents=(-3, 2)), ":4:8: sizes, found -3 2")
    yield refused(33, "nrrd", "a size of 0", nrrd(extents=(0, 2)), "sizes, found 0 2")
    yield refused(33, "nrrd", "bytes to skip", nrrd("byte skip: -2\n"), "byte skip, found -2")
    yield refused(34, "nrrd", "a size", nrrd(extents=(2 ** 63, 2)), "sizes, found 9223372036854775808")
    yield refused(35, "nrrd", "sizes and dimension", with_change(nrrd(), b"dimension: 2", b"dimension: 3"),
                  "expected 3 sizes")
    yield refused(35, "nrrd", "spacings", nrrd("spacings: 1\n"), "expected 2 numbers")
    yield refused(35, "nrrd", "directions", nrrd("space directions: (1,0)\n"), "expected 2 vectors")
    yield refused(35, "nrrd", "kinds", nrrd("kinds: domain\n"), "expected 2 words")
    yield refused(35, "nrrd", "a field twice", nrrd("type: float\n"), "a second type, expected one; |one: the")
    yield refused(35, "nrrd", "no endian", with_change(nrrd(descr="<i2"), b"endian: little\n", b""),
                  "no field endian")
    yield refused(35, "nrrd", "no sizes", with_change(nrrd(), b"sizes", b"sises"), "no field sizes")
    yield refused(35, "nrrd", "bytes to skip", nrrd("byte skip: 7\n"), "truncated before the data")
    yield refused(35, "nrrd", "lines to skip", nrrd("line skip: 1\n"), "truncated before the data")
    yield refused(38, "nrrd", "type", with_change(nrrd(), b"uint8", b"block"), "type, found block.*npy")
    yield refused(38, "nrrd", "encoding", with_change(nrrd(), b"raw", b"bzip2"), "raw, gzip or ascii; save")
    yield refused(38, "nrrd", "version", with_change(nrrd(), b"NRRD0004", b"NRRD0009"), "NRRD version")
    yield refused(38, "nrrd", "colours", nrrd("kinds: RGB-color domain\n"), "take one component of axis 0")
    yield refused(38, "nrrd", "a line", nrrd("by hand\n"), ":6:1: NRRD header, found .by hand")
    yield refused(38, "nrrd", "text out of range",
                  nrrd(values=[0, 1, 2, 3, 4, 256], encoding="text"), "number, found 256|out of range|0 to 255")
    yield refused(38, "nrrd", "text with a fraction",
                  nrrd(values=[0, 1, 2, 3, 4, 0.5], encoding="text"), "not an integer|integer")
    yield taken(38, "nrrd", "an unknown field", nrrd("colour: red\n"), BARS,
                note="line 6: the field colour is not used")
    header = with_change(nrrd(values=[], lines="data file: input.raw\n"), b"\n\n", b"\n")
    yield Entry(54, "nrrd: the file of the data is missing", "ph-barcode", ("a.nhdr",), 65,
                "found input.raw, expected the name.*cannot open", "a.nhdr", {"a.nhdr": header})
    yield Entry(51, "nrrd: the file of the data is a folder", "ph-barcode", ("a.nhdr",), 65,
                "it is a directory", "a.nhdr", {"a.nhdr": with_change(header, b"input.raw", b".")})
    yield Entry(38, "nrrd: many files of data", "ph-barcode", ("a.nhdr",), 65,
                "expected one file; join", "a.nhdr", {"a.nhdr": with_change(header, b"input.raw", b"LIST")})
    yield Entry(26, "nrrd: the file of the data is too short", "ph-barcode", ("a.nhdr",), 65,
                "truncated, found 5 bytes, expected 6", "input.raw", {"a.nhdr": header, "input.raw": bytes(5)})


def meta(lines="", **options):
    return files.meta_image(**{"descr": "|u1", "extents": (3, 2), "values": VALUES, "lines": lines,
                               **options})


def meta_entries():
    form = "metaimage"
    huge = (10 ** 6, 10 ** 6)
    yield refused(31, form, "10^12 voxels", meta(extents=huge), "truncated, found 6")
    yield refused(31, form, "10^12 voxels as text", meta(extents=huge, encoding="text"),
                  "sizes do not fit the file")
    yield refused(31, form, "10^12 voxels, packed", meta(extents=huge, encoding="gzip"),
                  "truncated, found 6")
    yield refused(32, form, "2^32 x 2^32", meta(extents=(2 ** 32, 2 ** 32)), "more than 2.64")
    yield refused(33, form, "a size", meta(extents=(-3, 2)), ":3:11: DimSize, found -3 2")
    yield refused(33, form, "bytes to skip", meta("HeaderSize = -2\n"), "HeaderSize, found -2")
    yield refused(34, form, "a size", meta(extents=(2 ** 63, 2)), "DimSize, found 9223372036854775808")
    yield refused(35, form, "sizes and axes", with_change(meta(), b"NDims = 2", b"NDims = 3"),
                  "expected 3 sizes")
    yield refused(35, form, "spacings", meta("ElementSpacing = 1\n"), "expected 2 numbers")
    yield refused(35, form, "matrix", meta("TransformMatrix = 1 0 1\n"), "expected 4 numbers")
    yield refused(35, form, "a field with two names", meta("Offset = 0 0\nOrigin = 0 0\n"),
                  "a second Origin, expected one; |one: the|a second Origin")
    yield refused(35, form, "packed size", meta("CompressedDataSize = 99\n", encoding="gzip"),
                  "truncated, found 14 bytes, expected 99")
    yield refused(35, form, "bytes to skip", meta("HeaderSize = 7\n"), "truncated before the data")
    yield refused(35, form, "no type", with_change(meta(), b"ElementType", b"ElemenType"),
                  "no field ElementType")
    yield refused(38, form, "type", with_change(meta(), b"MET_UCHAR", b"MET_STRING"),
                  "ElementType, found MET_STRING")
    yield refused(38, form, "channels", meta("ElementNumberOfChannels = 3\n"),
                  "one number per voxel; save one channel")
    yield refused(38, form, "kind of object", with_change(meta(), b"Image", b"Tube"), "found Tube")
    yield refused(38, form, "a word", meta("CompressedData = maybe\n"), "expected True or False")
    yield refused(38, form, "a list of slices", with_change(meta(), b"LOCAL", b"LIST"),
                  "LOCAL or one file; join the slices")
    yield refused(38, form, "a pattern of slices", with_change(meta(), b"LOCAL", b"s%03d.raw 1 9 1"),
                  "LOCAL or one file; join the slices")
    yield taken(38, form, "an unknown field", meta("Colour = red\n"), BARS,
                note="line 5: the field Colour is not used")
    header = with_change(meta(values=[]), b"LOCAL", b"input.raw")
    yield Entry(54, f"{form}: the file of the data is missing", "ph-barcode", ("a.mhd",), 65,
                "found input.raw, expected the name.*cannot open", "a.mhd", {"a.mhd": header})
    yield Entry(26, f"{form}: the file of the data is too short", "ph-barcode", ("a.mhd",), 65,
                "truncated, found 5 bytes, expected 6", "input.raw", {"a.mhd": header, "input.raw": bytes(5)})


def vti(encoding="raw", **options):
    return files.vti(**{"descr": "|u1", "extents": (3, 2), "values": VALUES, "encoding": encoding,
                        **options})


def vti_entries():
    form = "vti"
    huge = {"extents": (10 ** 6, 10 ** 6)}
    for encoding in ("raw", "base64", "text"):
        yield refused(31, form, f"10^12 voxels, {encoding}", vti(encoding, **huge), "truncated")
        yield refused(32, form, f"2^93 voxels, {encoding}", vti(encoding, extents=[2 ** 31] * 3),
                      "more than 2.64")
    yield refused(31, form, "10^12 voxels, packed", vti("gzip_base64", **huge), "truncated")
    for name, count in (("10^12 bytes", 10 ** 12), ("2^64 - 1 bytes", 2 ** 64 - 1)):
        wide = with_change(vti(**huge), b"UInt32", b"UInt64")
        yield refused(31, form, f"{name} in the count", with_change(wide, b"_\6\0\0\0", b"_"
                      + struct.pack("<Q", count)), "truncated array|array does not fit")
    packed = vti("gzip_raw", block=6)
    for name, counts in (("blocks", (10 ** 9, 6, 0)), ("bytes per block", (1, 2 ** 32 - 1, 0)),
                         ("no blocks", (0, 6, 0)), ("a last block", (1, 6, 7))):
        yield refused(35, form, f"packed: {name}",
                      with_change(packed, struct.pack("<3I", 1, 6, 0), struct.pack("<3I", *counts)),
                      "array does not fit")
    at = packed.index(b"\n_") + 14
    yield refused(35, form, "packed size", with_bytes(packed, at, struct.pack("<I", 10 ** 9)),
                  "truncated array")
    yield refused(33, form, "an extent", with_change(vti(), b'"0 2 0 1', b'"0 -3 0 1'),
                  "WholeExtent, found 0 -3 0 1 0 0")
    yield refused(34, form, "an extent", with_change(vti(), b'"0 2 0 1', b'"0 2147483648 0 1'),
                  "WholeExtent, found 0 2147483648")
    yield refused(35, form, "a piece", with_change(vti(), b'<Piece Extent="0 2', b'<Piece Extent="0 1'),
                  "the extent of the image")
    yield refused(35, form, "spacings", vti(image='Spacing="1 1"'), "expected 3 numbers")
    yield refused(35, form, "an offset", with_change(vti(), b'offset="0"', b'offset="99"'),
                  "offset, found 99")
    yield refused(35, form, "an attribute twice", vti(more='type="Int8"'), "a second attribute type")
    yield refused(35, form, "no type", with_change(vti(), b"type=\"UInt8", b"typ=\"UInt8"),
                  "DataArray without type")
    yield refused(35, form, "tags", with_change(vti(), b"</Piece>", b"</piece>"),
                  "found </piece>, expected </Piece>")
    yield refused(38, form, "type", with_change(vti(), b"UInt8", b"Bit"), "type, found Bit")
    yield refused(38, form, "compressor", with_change(vti("gzip_raw"), b"ZLib", b"LZ4"),
                  "vtkLZ4DataCompressor.*SetCompressorTypeToZLib")
    yield refused(38, form, "vectors", vti(more='NumberOfComponents="3"'),
                  "one number per voxel; save one component")
    yield refused(38, form, "kind of data", with_change(vti(), b"ImageData", b"PolyData"),
                  "found PolyData, expected ImageData", "--format", "vti")
    yield refused(38, form, "pieces", with_change(vti(), b"</Piece>", b"</Piece><Piece>"),
                  "a second Piece, expected one; join the pieces")
    other = '<DataArray type="UInt8" Name="b" format="ascii">1 1 1 1 1 1</DataArray>'
    yield refused(38, form, "several arrays", vti(lines=other),
                  r"several arrays.*choose one, for example input\.vti:b")
    yield taken(38, form, "scalars among several arrays",
                with_change(vti(lines=other), b"<PointData>", b'<PointData Scalars="a">'), BARS,
                note="read the array a, which the file marks as its scalars")
    yield refused(39, form, "Base64", with_change(vti("base64"), b"BgAAAA", b"BgA!AA"),
                  "damaged Base64 data")
    yield refused(39, form, "zlib data", with_change(packed, zlib.compress(bytes(VALUES)), bytes(14)),
                  "zlib")


def tiff(values=VALUES, descr="|u1", shape=(2, 3), compression=tiff_files.NONE, **fields):
    return tiff_files.tiff([tiff_files.page(descr, shape, values, compression, **fields)])


def tiff_entries():
    tera = 10 ** 6
    yield refused(31, "tiff", "10^12 pixels", tiff(t256=tera, t257=tera, t278=tera), "truncated: strip 1")
    yield refused(31, "tiff", "10^12 pixels, packed",
                  tiff(compression=tiff_files.DEFLATE, t256=tera, t257=tera, t278=tera),
                  "truncated: strip 1")
    yield refused(31, "tiff", "10^6 strips", tiff(t257=tera, t278=1), "strips and tiles|offsets of strips")
    yield refused(32, "tiff", "2^32 x 2^32", tiff(t256=2 ** 32 - 1, t257=2 ** 32 - 1),
                  "width, found 4294967295")
    yield refused(32, "tiff", "2^31 x 2^31 of 8 bytes",
                  tiff([0.0] * 6, "<f8", t256=2 ** 31, t257=2 ** 31, t278=2 ** 31), "fewer pixels|truncated")
    yield refused(33, "tiff", "width 0", tiff(t256=0), "width, found 0")
    yield refused(33, "tiff", "rows per strip of 0", tiff(t278=0), "rows per strip, found 0")
    yield refused(35, "tiff", "too few strips", tiff(t278=1), "offsets of strips, found 1, expected 2")
    yield refused(35, "tiff", "two bits of samples", tiff(t258=[8, 16]), "found 8 and 16")
    yield refused(35, "tiff", "pages that differ",
                  tiff_files.tiff([tiff_files.page("|u1", (2, 3), VALUES),
                                   tiff_files.page("|u1", (3, 2), VALUES)]),
                  "page 2, found 2 x 3 pixels of uint8, expected 3 x 2 pixels")
    whole = tiff()
    yield refused(35, "tiff", "a page that is its own follower",
                  with_bytes(whole, -4, struct.pack("<I", whole.index(struct.pack("<HHI", 256, 3, 1)) - 2)),
                  "a page that came before")
    yield refused(35, "tiff", "images that are missing", tiff(t270="ImageJ=1\nimages=9\n"),
                  "is the file truncated")
    yield refused(38, "tiff", "channels of ImageJ", tiff(t270="ImageJ=1\nimages=2\nchannels=2\n"),
                  "one number per voxel; save each channel")
    for code, name in ((7, "JPEG"), (34712, "JPEG 2000"), (50000, "Zstandard"), (3, "CCITT Group 3")):
        yield refused(38, "tiff", f"compression {code}", tiff(t259=code),
                      f"compression, found {code} .{name}.*; save it again")
    yield refused(38, "tiff", "a palette", tiff(t262=3), "a palette of colours")
    yield refused(38, "tiff", "colours", tiff([1, 2, 3] * 6, t262=2), "grey.*--channel")
    yield refused(38, "tiff", "complex numbers", tiff([0.0] * 6, "<f8", t339=6), "complex numbers are not")
    yield refused(38, "tiff", "12 bits", tiff(t258=12), "12 bits")
    yield refused(38, "tiff", "version", with_bytes(tiff(), 2, b"\x2c"), "not a TIFF file")
    yield refused(39, "tiff", "LZW", tiff(compression=tiff_files.LZW, t257=3, t278=3),
                  "truncated data, found 6 bytes, expected 9", frugal=False)
    yield refused(39, "tiff", "Deflate", with_bytes(tiff(compression=tiff_files.DEFLATE), 9, b"\xff\xff"),
                  "damaged zlib data")
    yield refused(39, "tiff", "PackBits", tiff(compression=tiff_files.PACK_BITS, t257=3, t278=3),
                  "truncated data, found 6 bytes, expected 9")
    side = 20_000
    zeros = tiff_files.tiff([({256: side, 257: side, 258: 8, 259: 8, 262: 1, 278: side, 273: None, 279: None},
                              [zlib.compress(bytes(side * side), 9)])])
    yield refused(40, "tiff", "381 MiB of pixels", zeros, "expand too much")
    yield taken(41, "tiff", "more data than a strip needs",
                tiff_files.tiff([(tiff_files.page("|u1", (2, 3), VALUES)[0], [bytes(VALUES) + b"x"])]),
                PICTURE_BARS, note="1 strip or tile has more data")
    yield taken(38, "tiff", "WhiteIsZero", tiff(t262=0), PICTURE_BARS, note="0 is white")


def with_slices(**files_of_folder):
    """Makes a folder `s` with these files: `_1_pgm` is 1.pgm."""
    @contextlib.contextmanager
    def around(folder):
        os.mkdir(os.path.join(folder, "s"))
        for name, content in files_of_folder.items():
            with open(os.path.join(folder, "s", name[1:].replace("_", ".")), "w", encoding="ascii") as file:
                file.write(content)
        yield {}
    return around


def stack_entries():
    first, second, high = "P2 3 1 9\n0 5 2\n", "P2 3 1 9\n4 9 1\n", "P2 1 3 9\n4 9 1\n"

    def entry(name, code, message, around, named="s", options=(), output=None):
        return Entry(35, f"stack: {name}", "ph-barcode", ("s", "--stack", *options), code, message,
                     named if code else "", output=output, around=around)

    yield entry("two slices", 0, "2 slices, from 1.pgm to 2.pgm", with_slices(_1_pgm=first, _2_pgm=second),
                output=BARS)
    yield entry("a gap", 0, "not evenly spaced: 2.pgm is followed by 4.pgm",
                with_slices(_1_pgm=first, _2_pgm=second, _4_pgm=second), output=BARS)
    yield entry("another file", 0, "1 other file or folder is not read, such as a.txt",
                with_slices(_1_pgm=first, _2_pgm=second, _a_txt="a"), output=BARS)
    yield entry("slices of two sizes", 65, "found 1 x 3 pixels of uint8, expected 3 x 1",
                with_slices(_1_pgm=first, _2_pgm=high), "s/2.pgm")
    yield entry("slices of two formats", 65, "slices of two formats", with_slices(_1_pgm=first, _2_png="x"))
    yield entry("a damaged slice", 65, "not a PNG file", with_slices(_1_png="x"), "s/1.png")
    yield entry("no slices", 65, "no slices", with_slices(_a_txt="a"))
    yield entry("a format without slices", 64, "reads folders of PNG, PGM or TIFF pictures",
                with_slices(_1_pgm=first), "", ("--format", "npy"))
    yield Entry(35, "stack: a file", "ph-barcode", ("1.pgm", "--stack"), 64,
                "expected a folder of pictures; a single file", "1.pgm", {"1.pgm": first.encode()})
    yield Entry(35, "stack: standard input", "ph-barcode", ("-", "--stack"), 64,
                "found -, expected a folder of pictures", "--stack")
    yield entry("vertices at one position", 64, "makes sense for meshes", with_slices(_1_pgm=first), "--weld",
                ("--weld",))
    yield entry("values", 64, "format pgm takes no separate values", with_slices(_1_pgm=first), "--values",
                ("--values", "s/1.pgm"))
    yield Entry(51, "stack: a folder without the option", "ph-barcode", ("s",), 66,
                "--stack reads the pictures", "s", around=with_slices(_1_pgm=first))


ENTRIES = [*nrrd_entries(), *meta_entries(), *vti_entries(), *tiff_entries(), *stack_entries()]
