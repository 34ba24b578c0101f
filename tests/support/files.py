# SPDX-License-Identifier: MIT
"""Small encoders of the formats that tests write: NumPy, NIfTI, NRRD, MetaImage,
VTI, DIPHA, PNG and PCD."""
import base64
import binascii
import io
import struct
import zipfile
import zlib

KINDS = {"b1": "?", "i1": "b", "i2": "h", "i4": "i", "i8": "q", "u1": "B", "u2": "H", "u4": "I",
         "u8": "Q", "f2": "e", "f4": "f", "f8": "d"}
DIPHA_MAGIC = 8067171840


def words(order, *numbers):
    """The bytes of integers as int64 and of floats as float64. @param order '<' or '>'."""
    return b"".join(struct.pack(order + ("q" if isinstance(n, int) else "d"), n) for n in numbers)


def packed(descr, values):
    """The bytes of numbers. @param descr the type in NumPy's notation: "<f8", "|u1"."""
    order = ">" if descr[0] == ">" else "<"
    convert = {"b": bool, "f": float}.get(descr[1], int)
    return struct.pack(f"{order}{len(values)}{KINDS[descr[1:]]}", *map(convert, values))


def npy_header(header, version=1):
    """The magic number, version and header of an NPY file, padded such that the data start at a
    multiple of 64."""
    length = 10 if version == 1 else 12
    encoded = header.encode("latin1" if version < 3 else "utf-8")
    encoded += b" " * (-(length + len(encoded) + 1) % 64) + b"\n"
    return (b"\x93NUMPY" + bytes([version, 0])
            + struct.pack("<H" if version == 1 else "<I", len(encoded)) + encoded)


def npy(descr, shape, data, fortran=False, version=1):
    shape = "({},)".format(shape[0]) if len(shape) == 1 else str(tuple(shape))
    return npy_header(f"{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}",
                      version) + data


def array(shape, values, descr="<f8", fortran=False):
    """An NPY file with these values, in the order in which they are stored."""
    return npy(descr, shape, packed(descr, values), fortran)


def npz(members, method=zipfile.ZIP_STORED):
    """An NPZ file. @param members maps names to contents."""
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", method) as file:
        for name, content in members.items():
            file.writestr(zipfile.ZipInfo(name, (2020, 1, 1, 0, 0, 0)), content, method)
    return archive.getvalue()


def gzipped(content):
    """A gzip file whose header has no time. Therefore, the bytes are always the same."""
    packer = zlib.compressobj(9, zlib.DEFLATED, 31)
    return packer.compress(content) + packer.flush()


def png_chunk(kind, content):
    return (struct.pack(">I", len(content)) + kind + content
            + struct.pack(">I", binascii.crc32(kind + content)))


PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
GREY, RGB, PALETTE, GREY_ALPHA, RGBA = 0, 2, 3, 4, 6


def png(width, height, bits, colour, rows, extra=b""):
    """A PNG file. @param rows the bytes of each row. @param extra chunks before the pixels."""
    header = struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, 0)
    return (PNG_SIGNATURE + png_chunk(b"IHDR", header) + extra
            + png_chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows), 9))
            + png_chunk(b"IEND", b""))


NIFTI_TYPES = {"u1": 2, "i2": 4, "i4": 8, "f4": 16, "f8": 64, "i1": 256, "u2": 512, "u4": 768,
               "i8": 1024, "u8": 1280}


def nifti(descr, extents, values, slope=0.0, intercept=0.0):
    """A NIfTI-1 file. @param values the stored values, with the first axis fastest."""
    header = bytearray(352)
    order, kind = descr[0].replace("|", "<"), descr[1:]
    struct.pack_into(order + "i", header, 0, 348)
    struct.pack_into(f"{order}8h", header, 40, len(extents), *extents, *[1] * (7 - len(extents)))
    struct.pack_into(order + "2h", header, 70, NIFTI_TYPES[kind],
                     8 * struct.calcsize("<" + KINDS[kind]))
    struct.pack_into(order + "3f", header, 108, 352, slope, intercept)
    header[344:348] = b"n+1\0"
    return bytes(header) + packed(descr, values)


NRRD_TYPES = {"u1": "uint8", "i2": "short", "i4": "int32", "f4": "float", "f8": "double",
              "i1": "int8", "u2": "ushort", "u4": "uint", "i8": "int64", "u8": "uint64"}


def nrrd(descr, extents, values, encoding="raw", lines=""):
    """An NRRD file. @param values with the first axis fastest. @param encoding raw, gzip or text.
    @param lines further lines of the header."""
    order, kind = descr[0], descr[1:]
    content = {"raw": lambda: packed(descr, values), "gzip": lambda: gzipped(packed(descr, values)),
               "text": lambda: "\n".join(map(str, values)).encode()}[encoding]()
    endian = {"<": "endian: little\n", ">": "endian: big\n"}.get(order, "")
    return (f"NRRD0004\ntype: {NRRD_TYPES[kind]}\ndimension: {len(extents)}\n"
            f"sizes: {' '.join(map(str, extents))}\nencoding: {encoding}\n{endian}{lines}\n"
            ).encode() + content


META_TYPES = {"u1": "UCHAR", "i2": "SHORT", "i4": "INT", "f4": "FLOAT", "f8": "DOUBLE", "i1": "CHAR",
              "u2": "USHORT", "u4": "UINT", "i8": "LONG_LONG", "u8": "ULONG_LONG"}


def meta_image(descr, extents, values, encoding="raw", lines=""):
    """A MetaImage in one file. The parameters have the meaning that they have in `nrrd`."""
    content = {"raw": lambda: packed(descr, values), "gzip": lambda: zlib.compress(packed(descr, values)),
               "text": lambda: "\n".join(map(str, values)).encode()}[encoding]()
    lines += {"raw": "", "gzip": "CompressedData = True\n", "text": "BinaryData = False\n"}[encoding]
    if descr[0] == ">":
        lines += "ElementByteOrderMSB = True\n"
    return (f"ObjectType = Image\nNDims = {len(extents)}\nDimSize = {' '.join(map(str, extents))}\n"
            f"ElementType = MET_{META_TYPES[descr[1:]]}\n{lines}ElementDataFile = LOCAL\n"
            ).encode() + content


def two_files(extents, values, data):
    """The header of a MetaImage, and its data file, whose name is `data`."""
    whole = meta_image("|u1", extents, values)
    at = whole.index(b"LOCAL")
    return whole[:at] + data.encode() + b"\n", whole[at + len(b"LOCAL\n"):]


VTI_TYPES = {"u1": "UInt8", "i2": "Int16", "i4": "Int32", "f4": "Float32", "f8": "Float64",
             "i1": "Int8", "u2": "UInt16", "u4": "UInt32", "i8": "Int64", "u8": "UInt64"}


def vti(descr, extents, values, encoding="raw", lines="", image="", more="", block=4):
    """A VTI file. @param values one per point, with the first axis fastest. @param encoding text,
    raw or base64 (in the element), or appended_raw or appended_base64. With "gzip_" before it, the
    numbers are in blocks of zlib data. @param lines further arrays. @param image further attributes
    of the image. @param more further attributes of the array. @param block the bytes of a block."""
    data = packed(descr, values)
    root = f'byte_order="{"Big" if descr[0] == ">" else "Little"}Endian" header_type="UInt32"'
    order = ">" if descr[0] == ">" else "<"
    head = struct.pack(order + "I", len(data))
    where = encoding.replace("gzip_", "")
    if where != encoding:
        root += ' compressor="vtkZLibDataCompressor"'
        blocks = [zlib.compress(data[k:k + block]) for k in range(0, len(data), block)]
        head = struct.pack(f"{order}{3 + len(blocks)}I", len(blocks), block, len(data) % block,
                           *map(len, blocks))
        data = b"".join(blocks)
    coded = base64.b64encode(head) + base64.b64encode(data) if where != encoding else base64.b64encode(head + data)
    inner, after, how = {
        "text": (" ".join(map(str, values)).encode(), b"", 'format="ascii"'),
        "base64": (coded, b"", 'format="binary"'),
        "raw": (b"", head + data, 'format="appended" offset="0"'),
        "appended_base64": (b"", coded, 'format="appended" offset="0"')}[where]
    if after:
        after = (f'<AppendedData encoding="{"raw" if where == "raw" else "base64"}">\n_'.encode() + after
                 + b"\n</AppendedData>\n")
    ends = " ".join(f"0 {n - 1}" for n in (*extents, 1, 1)[:3])
    return (f'<?xml version="1.0"?>\n<VTKFile type="ImageData" version="1.0" {root}>\n'
            f'<ImageData WholeExtent="{ends}" {image}>\n<Piece Extent="{ends}">\n<PointData>\n'
            f'{lines}<DataArray type="{VTI_TYPES[descr[1:]]}" Name="a" {how} {more}>\n').encode() + inner + (
            b"\n</DataArray>\n</PointData>\n</Piece>\n</ImageData>\n" + after + b"</VTKFile>\n")


def dipha(*numbers):
    return words("<", DIPHA_MAGIC, *numbers)


def dipha_image(extents, values):
    """An image in DIPHA's format. @param values with the first axis fastest."""
    return dipha(1, len(values), len(extents), *extents, *map(float, values))


def pcd_header(fields="x y z", sizes="4 4 4", types="F F F", counts="1 1 1", width=4, height=1,
               points=None, data="ascii"):
    points = width * height if points is None else points
    return (f"# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS {fields}\n"
            f"SIZE {sizes}\nTYPE {types}\nCOUNT {counts}\nWIDTH {width}\nHEIGHT {height}\n"
            f"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {points}\nDATA {data}\n").encode()


def lzf(content):
    """Compresses with LZF, with literals and with matches for repeated bytes."""
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
            out.extend((0xE0, run - 1 - 9, 0))  # the previous byte, run - 1 times
            i += run
        else:
            i += 1
    flush()
    return bytes(out)
