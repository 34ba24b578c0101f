# SPDX-License-Identifier: MIT
"""Rows 39 to 42: compressed data with wrong lengths, decompression bombs, trailing data, endless
lists."""
import functools
import struct
import zipfile
import zlib

from arrays import GRID, VALUES
from clouds import CORNERS, TRIANGLE, XYZ, columns, floats, ply_header
from files import (GREY, PNG_SIGNATURE, gzipped, lzf, meta_image, nifti, nrrd, npy, npz, pcd_header, png, png_chunk,
                   vti)

from entry import refused, sample, with_bytes, with_change

TEXT = b"0 0\n1 0\n1 1\n"
PACKED = pcd_header(data="binary_compressed")
CENTRAL, END = b"PK\1\2", b"PK\5\6"


def lzf_cloud(packed, size, unpacked):
    return PACKED + struct.pack("<II", size, unpacked) + packed


def lzf_lies():
    raw = b"".join(columns(CORNERS))
    packed = lzf(raw)
    count, size = len(raw), len(packed)
    for name, content, message in (
            ("packed size, one more", lzf_cloud(packed, size + 1, count), "truncated: compressed"),
            ("packed size, one less", lzf_cloud(packed, size - 1, count), "byte|trailing"),
            ("packed size of 4e9", lzf_cloud(packed, 2 ** 32 - 1, count), "truncated: compressed"),
            ("packed size 0", lzf_cloud(packed, 0, count), "trailing data|less data|compressed"),
            ("size, one more", lzf_cloud(packed, size, count + 1), "uncompressed size"),
            ("size, one less", lzf_cloud(packed, size, count - 1), "uncompressed size"),
            ("size of 4e9", lzf_cloud(packed, size, 2 ** 32 - 1), "uncompressed size"),
            ("less data", lzf_cloud(lzf(raw[:-1]), len(lzf(raw[:-1])), count), "less data than declared"),
            ("a match before the data", lzf_cloud(b"\x20\xff" + packed[2:], size, count),
             "a match that starts before the data"),
            ("a match behind the data", lzf_cloud(b"\0\0\xe0", 3, count), "a match that ends after"),
            ("literals behind the data", lzf_cloud(b"\x1f\0", 2, count), "literals that end after"),
            ("more data", lzf_cloud(b"\0\0\xe0\x80\0", 5, count), "more data than declared"),
            ("no sizes", PACKED + b"\1\0", "truncated")):
        yield refused(39, "pcd", f"LZF, {name}", content, message)


def zip_lies():
    stored, deflated = npz({"a.npy": GRID}), npz({"a.npy": GRID}, zipfile.ZIP_DEFLATED)

    def central(content, offset, new):
        return with_bytes(content, content.index(CENTRAL) + offset, new)

    def end(content, offset, new):
        return with_bytes(content, content.index(END) + offset, new)

    most = b"\xff\xff\xff\xff"
    for name, content, message in (
            ("checksum", central(stored, 16, b"\1\2\3\4"), "checksum"),
            ("a byte of the data", with_bytes(stored, 200, b"\xee"), "checksum"),
            ("packed size", central(stored, 20, most), "truncated|do not fit"),
            ("size", central(stored, 24, struct.pack("<I", 9)), "sizes of a member do not fit"),
            ("size of 4e9, deflated", central(deflated, 24, struct.pack("<I", 4_000_000_000)),
             "do not fit|expand too much"),
            ("size, one more, deflated", central(deflated, 24, struct.pack("<I", len(GRID) + 1)),
             "wrong sizes of compressed data"),
            ("size, one less, deflated", central(deflated, 24, struct.pack("<I", len(GRID) - 1)),
             "wrong sizes of compressed data"),
            ("deflate data", with_bytes(deflated, 40, b"\xff\xff\xff"), "deflate|checksum|sizes"),
            ("method", central(stored, 10, b"\x0c\0"), "compression method, found 12"),
            ("encryption", central(stored, 8, b"\1\0"), "encrypted"),
            ("offset of the member", central(stored, 42, struct.pack("<I", 4_000_000_000)),
             "offset of a member"),
            ("offset inside the member", central(stored, 42, b"\1\0\0\0"), "no member"),
            ("length of the name", central(stored, 28, b"\xff\xff"), "truncated|damaged"),
            ("entries, two", end(stored, 10, b"\2\0"), "directory|truncated"),
            ("entries, none", end(stored, 10, b"\0\0"), "directory|empty"),
            ("size of the directory", end(stored, 12, most), "directory does not fit"),
            ("offset of the directory", end(stored, 16, most), "directory does not fit"),
            ("length of the comment", end(stored, 20, b"\7\0"), "truncated"),
            ("no array", npz({}), "archive"),
            ("several arrays", npz({"a.npy": GRID, "b.npy": GRID}), "choose one, for example .*input.npz:a"),
            ("no NPY inside", npz({"a.npy": b"0 0\n"}), "input.npz:a")):
        yield refused(39, "npz", name, content, message)


def gzip_lies():
    packed = gzipped(TEXT)
    for name, content, message in (
            ("checksum", with_bytes(packed, -8, b"\0\1\2\3"), "damaged gzip data"),
            ("size", with_bytes(packed, -4, b"\x01\0\0\0"), "damaged gzip data"),
            ("size of 4e9", with_bytes(packed, -4, b"\xff\xff\xff\xff"),
             "damaged gzip data|expand too much"),
            ("a byte of the data", with_bytes(packed, 12, b"\xff"), "damaged|not a number|truncated"),
            ("method", with_bytes(packed, 2, b"\7"), "damaged gzip data"),
            ("signature alone", packed[:2], "truncated gzip data"),
            ("faulty data inside", gzipped(b"0 0\n1 x\n"), r":2:3: not a number")):
        yield refused(39, "gzip", name, content, message)


def png_lies():
    grey = sample("image", "grey.png")
    pixels = grey.index(b"IDAT")
    size = struct.pack(">IIBBBBB", 3, 2, 8, GREY, 0, 0, 0)
    header = PNG_SIGNATURE + png_chunk(b"IHDR", size)
    for name, content in (
            ("checksum of the pixels", with_bytes(grey, -16, b"\0\0\0\1")),
            ("checksum of the header", with_bytes(grey, 29, b"\0\0\0\1")),
            ("length of the pixels", with_bytes(grey, pixels - 4, b"\0\0\xff\xff")),
            ("length of 2^31", with_bytes(grey, pixels - 4, b"\x80\0\0\0")),
            ("too few pixels", header + png_chunk(b"IDAT", zlib.compress(b"\0\1\2\3"))
             + png_chunk(b"IEND", b"")),
            ("no pixels", header + png_chunk(b"IEND", b"")),
            ("no header", PNG_SIGNATURE + png_chunk(b"IEND", b"")),
            ("width 0", png(0, 2, 8, GREY, [b"", b""])),
            ("an unknown filter", header + png_chunk(b"IDAT", zlib.compress(b"\7\1\2\3\0\1\2\3"))
             + png_chunk(b"IEND", b"")),
            ("an unknown critical chunk", with_change(grey, b"IDAT", b"IDAX")),
            ("no deflate data", header + png_chunk(b"IDAT", b"no zlib") + png_chunk(b"IEND", b""))):
        yield refused(39, "png", name, content, "PNG")


@functools.cache
def zeros(mebibytes):
    """A gzip file of NUL bytes, which is a thousandth of the size of its content."""
    packer = zlib.compressobj(9, zlib.DEFLATED, 31)
    block = bytes(1 << 20)
    return b"".join(packer.compress(block) for _ in range(mebibytes)) + packer.flush()


def bombs():
    too_much = "expand too much"
    bomb = zeros(256)
    yield refused(40, "gzip", "256 MiB", bomb, too_much)
    yield refused(40, "gzip", "256 MiB behind a small member", gzipped(TEXT) + bomb, too_much)
    for form in ("npy", "nifti", "nrrd", "metaimage", "vti", "pcd", "ply", "dipha"):
        yield refused(40, form, "256 MiB", bomb, too_much)
    yield refused(40, "nrrd", "256 MiB of voxels",
                  nrrd("|u1", (1 << 28,), [], "gzip") + bomb, too_much)
    yield refused(40, "metaimage", "256 MiB of voxels",
                  meta_image("|u1", (1 << 28,), [], lines="CompressedData = 1\n") + bomb, too_much)
    yield refused(40, "vti", "256 MiB of voxels",
                  vti("|u1", (1 << 14, 1 << 14), bytes(1 << 28), "gzip_raw", block=1 << 28), too_much)
    # The gzip trailer states a size that is too small. Unpacking still stops, at the larger of 128
    # MiB and 256 times the packed size. Here, this is 128 MiB.
    yield refused(40, "gzip", "256 MiB, said to be 1", with_bytes(bomb, -4, b"\1\0\0\0"), too_much,
                  frugal=False)
    yield refused(40, "gzip", "twice packed", gzipped(gzipped(TEXT)), "not plain text|not a number|NUL")
    huge = npy("<f8", (1 << 25,), b"")
    raw = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = raw.compress(huge) + b"".join(raw.compress(bytes(1 << 20)) for _ in range(256))
    packed += raw.flush()
    member = npz({"a.npy": b""}, zipfile.ZIP_DEFLATED)
    at, directory = member.index(CENTRAL), 30 + len("a.npy")
    archive = (member[:directory] + packed + with_bytes(
        member[at:], 20, struct.pack("<II", len(packed), len(huge) + (256 << 20))))
    end = archive.index(END)
    archive = with_bytes(archive, end + 16, struct.pack("<I", directory + len(packed)))
    yield refused(40, "npz", "256 MiB", archive, too_much)
    ratio = struct.pack("<II", 8, 4 << 26) + b"\0\0" + b"\xe0\xff\0" * 2
    yield refused(40, "pcd", "LZF, 256 MiB in 8 bytes",
                  pcd_header("x", "4", "F", "1", 1 << 26, data="binary_compressed") + ratio,
                  "compressed size")
    wide = struct.pack(">IIBBBBB", 30000, 30000, 16, GREY, 0, 0, 0)
    yield refused(40, "png", "1.7 GiB of pixels", PNG_SIGNATURE + png_chunk(b"IHDR", wide)
                  + png_chunk(b"IDAT", zlib.compress(bytes(60001 * 8), 9)) + png_chunk(b"IEND", b""),
                  "does not fit the file")
    text = png_chunk(b"zTXt", b"Title\0\0" + zlib.compress(bytes(32 << 20), 9))
    yield refused(40, "png", "32 MiB of comments, then damage",
                  with_bytes(png(2, 1, 8, GREY, [b"\1\2"], text), -16, b"\0\0\0\1"), "PNG")


def trailing():
    more = "trailing data|extra|not the end"
    for form, content in (
            ("pcd", sample("pcd", "ascii.pcd") + b"0 0 1\n"),
            ("pcd", sample("pcd", "binary.pcd") + b"\0\1"),
            ("pcd", sample("pcd", "compressed.pcd") + b"\1"),
            ("ply", sample("ply", "ascii.ply") + b"3 0 1 2\n"),
            ("ply", sample("ply", "little_endian.ply") + b"\0"),
            ("ply", sample("ply", "big_endian.ply") + b"\n"),
            ("off", sample("off", "octahedron.off") + b"3 0 1 2\n"),
            ("pts", sample("pts", "plain.pts") + b"1 1 1\n"),
            ("npy", GRID + b"\0"),
            ("npz", npz({"a.npy": GRID}) + b"\0"),
            ("nifti", nifti("|u1", (3, 2), VALUES) + b"\0"),
            ("metaimage", meta_image("|u1", (3, 2), VALUES) + b"\0"),
            ("metaimage", meta_image("|u1", (3, 2), VALUES, "gzip") + b"\0"),
            ("metaimage", meta_image("|u1", (3, 2), VALUES, "text") + b" 7"),
            ("vti", vti("|u1", (3, 2), VALUES) + b"\0"),
            ("vti", vti("|u1", (3, 2), VALUES + [7]).replace(b'"0 6', b'"0 5')),
            ("vti", vti("|u1", (3, 2), VALUES + [7], "text")),
            ("vti", vti("|u1", (3, 2), VALUES, "base64").replace(b"=\n</D", b"=AAAA\n</D")),
            ("nrrd", nrrd("|u1", (3, 2), VALUES) + b"\0"),
            ("nrrd", nrrd("|u1", (3, 2), VALUES, "gzip") + b"\0"),
            ("nrrd", nrrd("|u1", (3, 2), VALUES, "text") + b" 7"),
            ("pgm", sample("image", "raw.pgm") + b"\n"),
            ("pgm", sample("image", "raw.pgm") * 2),
            ("pgm", sample("image", "plain.pgm") + b"1\n"),
            ("png", sample("image", "grey.png") + b"\0"),
            ("png", sample("image", "grey.png") * 2),
            ("perseus", sample("perseus", "grid.perseus") + b"1\n"),
            ("dipha", sample("image", "image.dipha") + bytes(8)),
            ("dipha", sample("distances", "distances.dipha") + bytes(8)),
            ("dipha", sample("sparse", "sparse.dipha") + bytes(8)),
            ("dipha", sample("phat", "boundary.dipha") + bytes(1)),
            ("phat", sample("phat", "triangle_binary.phat") + bytes(8)),
            ("gzip", gzipped(TEXT) + b"\0"),
            ("gzip", gzipped(TEXT) + TEXT)):
        name = f"{len(content)} bytes that begin {content[:4]!r}"
        yield refused(41, form, name, content, more)
    yield refused(41, "xyz", "a second molecule", "1\n\nO 0 0 1\n1\n\nO 1 0 1\n",
                  "input.xyz:4:1: trailing data.*each into its own file")
    yield refused(41, "pts", "a second count", "1\n0 0 1\n1\n1 0 1\n", "input.pts:3:1: ragged row")


def lists():
    most = struct.pack("<I", 4_000_000_000)
    vertices = floats([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    for length, raw in (("uint", most), ("int", struct.pack("<i", -1)), ("uchar", b"\xff"),
                        ("char", b"\x80"), ("int", struct.pack("<i", 2 ** 31 - 1))):
        header = with_change(ply_header("binary_little_endian", *TRIANGLE), b"list uchar",
                             b"list " + length.encode())
        yield refused(42, "ply", f"{length} {raw.hex()}", header + vertices + raw + bytes(12),
                      "length of list vertex_indices|does not fit")
    big = with_change(ply_header("binary_big_endian", *TRIANGLE), b"list uchar", b"list uint")
    yield refused(42, "ply", "big endian", big + vertices + most[::-1] + bytes(12),
                  "length of list vertex_indices")
    text = with_change(ply_header("ascii", *TRIANGLE), b"list uchar", b"list uint")
    for word in ("4000000000", "-1", "4294967296", "3.5"):
        yield refused(42, "ply", f"ascii {word}", text + b"0 0 0\n1 0 0\n0 1 0\n" + word.encode()
                      + b" 0 1 2\n", "length of list|out of range|not an integer")
    yield refused(42, "ply", "a float as length",
                  with_change(ply_header("ascii", *TRIANGLE), b"list uchar", b"list float"),
                  "type of a list length")
    yield refused(42, "ply", "of a vertex", ply_header("binary_little_endian", "element vertex 1", *XYZ,
                                                       "property list uint double weights")
                  + floats([(0, 0, 1)]) + most, "length of list weights|does not fit|list")


ENTRIES = [*lzf_lies(), *zip_lies(), *gzip_lies(), *png_lies(), *bombs(), *trailing(), *lists()]
