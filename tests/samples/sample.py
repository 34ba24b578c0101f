# SPDX-License-Identifier: MIT
"""One valid file of a format, and the small encoders that the samples are made with."""
import binascii
import dataclasses
import io
import struct
import zipfile
import zlib


@dataclasses.dataclass(frozen=True)
class Sample:
    """A small valid file."""
    name: str       # with its extension, by which some formats are known
    reader: str     # the library's function without `read_`; correlations: distances, from_correlation
    content: bytes
    sized: bool     # the format says where it ends: no shorter file is valid
    arguments: tuple = ("{}",)  # of the program; {} is the file
    program: str = "ph-barcode"  # empty: no program reads it
    needs: tuple = ()            # names of the samples that the arguments name too


def words(order, *numbers):
    """Integers as int64, floats as float64. @param order '<' or '>'."""
    return b"".join(struct.pack(order + ("q" if isinstance(n, int) else "d"), n) for n in numbers)


def npy_header(header, version=1):
    """Magic number, version and header, padded so that the data start at a multiple of 64."""
    length = 10 if version == 1 else 12
    encoded = header.encode("latin1" if version < 3 else "utf-8")
    encoded += b" " * (-(length + len(encoded) + 1) % 64) + b"\n"
    return (b"\x93NUMPY" + bytes([version, 0])
            + struct.pack("<H" if version == 1 else "<I", len(encoded)) + encoded)


def npy(descr, shape, data, fortran=False, version=1):
    shape = "({},)".format(shape[0]) if len(shape) == 1 else str(tuple(shape))
    return npy_header(f"{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}",
                      version) + data


def npz(members, method=zipfile.ZIP_STORED):
    """@param members name to content."""
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", method) as file:
        for name, content in members.items():
            file.writestr(zipfile.ZipInfo(name, (2020, 1, 1, 0, 0, 0)), content, method)
    return archive.getvalue()


def gzipped(content):
    """Without a time in its header: the same bytes each time."""
    packer = zlib.compressobj(9, zlib.DEFLATED, 31)
    return packer.compress(content) + packer.flush()


def png_chunk(kind, content):
    return (struct.pack(">I", len(content)) + kind + content
            + struct.pack(">I", binascii.crc32(kind + content)))


PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
GREY, RGB, PALETTE, GREY_ALPHA, RGBA = 0, 2, 3, 4, 6


def png(width, height, bits, colour, rows, extra=b""):
    """@param rows the bytes of each row. @param extra chunks before the pixels."""
    header = struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, 0)
    return (PNG_SIGNATURE + png_chunk(b"IHDR", header) + extra
            + png_chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows), 9))
            + png_chunk(b"IEND", b""))


def lzf(content):
    """LZF with literals, and matches where a byte repeats."""
    out, literals, i = bytearray(), bytearray(), 0

    def flush():
        for k in range(0, len(literals), 32):
            run = literals[k:k + 32]
            out.append(len(run) - 1)
            out.extend(run)
        literals.clear()

    while i < len(content):
        run = 1
        while i + run < len(content) and run < 265 and content[i + run] == content[i]:
            run += 1
        literals.append(content[i])
        if run > 9:
            flush()
            out.extend((0xE0, run - 1 - 9, 0))  # the byte before, run - 1 times more
            i += run
        else:
            i += 1
    flush()
    return bytes(out)
