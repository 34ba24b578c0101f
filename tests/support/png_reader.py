# SPDX-License-Identifier: MIT
"""Reads PNG files according to their definition."""
import struct
import zlib

CHANNELS = {0: 1, 2: 3, 6: 4}  # number of channels of grey, RGB and RGBA


def chunks(data):
    """@return the name and content of each chunk of a PNG. Checksums are verified."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", data[:8]
    at, found = 8, []
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at:at + 8])
        content = data[at + 8:at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(name + content)
        found.append((name, content))
        at += 12 + size
    assert found[-1] == (b"IEND", b"")
    return found


def unfiltered(kind, line, above, step):
    """@return the row before a PNG filter was applied."""
    if not any(line) and kind in (2, 4):  # most rows are white and equal the row above
        return above
    if kind == 0:
        return line
    if kind == 2:
        return bytes([(byte + up) & 255 for byte, up in zip(line, above)])
    found = bytearray(step) + line  # there is no pixel before the first one
    for i, (byte, up, corner) in enumerate(zip(line, above, bytes(step) + above)):
        left = found[i]
        if kind == 1:
            guess = left
        elif kind == 3:
            guess = (left + up) // 2
        else:
            a, b, c = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
            guess = left if a <= b and a <= c else up if b <= c else corner
        found[i + step] = (byte + guess) & 255
    return bytes(found[step:])


def rows_of(data):
    """@return the width, height, bit depth and colour type, and the bytes of each row."""
    parts = chunks(data)
    width, height, bits, colour, _, _, interlaced = struct.unpack(">IIBBBBB", dict(parts)[b"IHDR"])
    assert not interlaced
    step = CHANNELS[colour] * bits // 8
    raw = zlib.decompress(b"".join(content for name, content in parts if name == b"IDAT"))
    assert len(raw) == height * (width * step + 1)
    rows, above = [], bytes(width * step)
    for y in range(height):
        start = y * (width * step + 1)
        above = unfiltered(raw[start], raw[start + 1:start + 1 + width * step], above, step)
        rows.append(above)
    return (width, height, bits, colour), rows
