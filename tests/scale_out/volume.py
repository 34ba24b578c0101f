# SPDX-License-Identifier: MIT
"""Makes an image to compute, without NumPy."""
import math


def volume(path, extents=(24, 20, 16)):
    """Writes a NumPy file of pseudo-random bytes from 0 to 63."""
    state, values = 1, bytearray()
    for _ in range(math.prod(extents)):
        state = (state * 1103515245 + 12345) % (1 << 31)
        values.append(state >> 16 & 63)
    header = f"{{'descr': '|u1', 'fortran_order': False, 'shape': {extents!r}, }}".ljust(117) + "\n"
    path.write_bytes(b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header.encode() + values)
