# SPDX-License-Identifier: MIT
"""An encoder of TIFF and BigTIFF files for tests, with strips or tiles."""
import struct
import zlib

import files

NONE, LZW, DEFLATE, PACK_BITS, OLD_DEFLATE = 1, 5, 8, 32773, 32946


def pack_bits(content):
    """Repeated bytes as runs, other bytes one by one."""
    out, at = bytearray(), 0
    while at < len(content):
        run = 1
        while run < 128 and content[at:at + run + 1] == content[at:at + 1] * (run + 1):
            run += 1
        out += bytes([257 - run if run > 1 else 0, content[at]])
        at += run
    return bytes(out)


def lzw(content):
    """LZW with codes of 9 to 12 bits, as in section 13 of TIFF 6.0."""
    bits = []

    def put(code, width):
        bits.append(f"{code:0{width}b}")

    def fresh():
        return {bytes([byte]): byte for byte in range(256)}

    codes, following, width, string = fresh(), 258, 9, b""
    put(256, 9)
    for byte in content:
        longer = string + bytes([byte])
        if longer in codes:
            string = longer
            continue
        put(codes[string], width)
        codes[longer] = following
        following += 1
        string = bytes([byte])
        if following == 4095:
            put(256, 12)
            codes, following, width = fresh(), 258, 9
        elif following == 1 << width:
            width += 1
    if string:
        put(codes[string], width)
        following += 1
        width += following == 1 << width and width < 12
    put(257, width)
    text = "".join(bits)
    text += "0" * (-len(text) % 8)
    return bytes(int(text[k:k + 8], 2) for k in range(0, len(text), 8))


PACKERS = {NONE: bytes, LZW: lzw, DEFLATE: zlib.compress, PACK_BITS: pack_bits,
           OLD_DEFLATE: zlib.compress}
FORMATS = {"u": 1, "i": 2, "f": 3}


def page(descr, shape, values, compression=NONE, chunk=None, **fields):
    """A page: its fields and its chunks. @param shape (y, x). @param chunk the size of a tile, or
    None for one strip. @param fields further fields, by number as text after a letter: t262=2."""
    height, width = shape
    samples = len(values) // (width * height)
    rows = [values[y * width * samples:(y + 1) * width * samples] for y in range(height)]
    across, down = (width, height) if chunk is None else chunk[::-1]
    chunks = []
    for top in range(0, height, down):
        for left in range(0, width, across):
            part = []
            for y in range(top, top + down):
                row = rows[y][left * samples:(left + across) * samples] if y < height else []
                part += [*row, *[0] * (across * samples - len(row))]
            chunks.append(PACKERS[compression](files.packed(descr, part)))
    tags = {256: width, 257: height, 258: [8 * struct.calcsize("<" + files.KINDS[descr[1:]])] * samples,
            259: compression, 262: 1, 277: samples, 339: [FORMATS[descr[1]]] * samples}
    tags.update({322: across, 323: down, 324: None, 325: None} if chunk
                else {278: down, 273: None, 279: None})
    tags.update({int(name[1:]): value for name, value in fields.items()})
    return tags, chunks


def tiff(pages, order="<", big=False):
    """A file. @param pages the results of `page`."""
    offset = order + ("Q" if big else "I")
    size = struct.calcsize(offset)
    content = bytearray(b"II" if order == "<" else b"MM")
    content += struct.pack(order + ("HHH" if big else "H"), *((43, 8, 0) if big else (42,)))
    link = len(content)
    content += bytes(size)
    for tags, chunks in pages:
        places = []
        for chunk in chunks:
            places.append(len(content))
            content += chunk
        content += bytes(-len(content) % 2)
        entries, beside = [], []
        for tag, value in sorted(tags.items()):
            if tag in (273, 324):
                value = places
            elif tag in (279, 325):
                value = [len(chunk) for chunk in chunks]
            if isinstance(value, str):
                kind, numbers, count = 2, value.encode() + b"\0", len(value) + 1
            else:
                value = value if isinstance(value, list) else [value]
                kind = 3 if all(0 <= number < 65536 for number in value) else 4
                numbers = struct.pack(f"{order}{len(value)}{'H' if kind == 3 else 'I'}", *value)
                count = len(value)
            entries.append((tag, kind, count, numbers))
        struct.pack_into(offset, content, link, len(content))
        begin = len(content) + (8 if big else 2) + len(entries) * (4 + 2 * size) + size
        content += struct.pack(order + ("Q" if big else "H"), len(entries))
        for tag, kind, count, numbers in entries:
            content += struct.pack(order + "HH" + offset[1], tag, kind, count)
            if len(numbers) <= size:
                content += numbers.ljust(size, b"\0")
            else:
                content += struct.pack(offset, begin + sum(map(len, beside)))
                beside.append(numbers + bytes(len(numbers) % 2))
        link = len(content)
        content += bytes(size) + b"".join(beside)
    return bytes(content)
