# SPDX-License-Identifier: MIT
"""Random barcodes, and files of them in each format that programs can read."""
import ast
import gzip
import json
import math
import struct

import files
import formats

INF = math.inf
STYLES = ["grid", "grid", "dyadic", "unit", "wide", "tiny", "huge", "shifted", "any"]
LARGE = 4e99  # vectors accept numbers, and lengths, up to 1e100


def number(rng, style):
    if style == "grid":  # creates ties
        return float(rng.randint(-3, 6))
    if style == "dyadic":
        return rng.randint(-2 ** 12, 2 ** 12) / 2 ** rng.randint(0, 6)
    if style == "wide":
        return rng.choice([-1, 1]) * rng.random() * 10 ** rng.uniform(-8, 8)
    if style == "tiny":
        return rng.choice([5e-324, 1e-310, 1e-300, 1e-160]) * rng.randint(-5, 9)
    if style == "huge":
        return rng.choice([1e97, 4e98]) * rng.randint(-9, 9) * rng.choice([1, rng.random()])
    if style == "shifted":  # numbers whose differences have few digits
        return 1e6 + rng.choice([rng.random(), rng.randint(0, 4)])
    if style == "vast":
        return rng.choice([1e153, 1e200, 1e304]) * rng.randint(-9, 9)
    if style == "any":
        while True:
            value, = struct.unpack("d", struct.pack("Q", rng.getrandbits(64)))
            if abs(value) <= LARGE:
                return value
    return rng.uniform(-1, 1)


def random_bar(rng, style, infinite):
    birth, death = sorted((number(rng, style), number(rng, style)))
    way = rng.random()
    if way < 0.08:
        death = birth
    elif way < 0.16:  # a bar near the diagonal
        death = math.nextafter(birth, INF) if rng.random() < 0.5 else birth + abs(birth) * 2 ** -rng.randint(10, 52)
    elif way < 0.16 + infinite:
        death = INF
    elif way < 0.16 + 1.4 * infinite:
        birth = -INF
        if rng.random() < 0.3:
            death = INF
    if birth == 0 and rng.random() < 0.3:
        birth = -0.0
    return birth, death


def moved(rng, style, bar, far):
    """A bar close to `bar`. @param far factor for the distance; None for a random distance."""
    ends = [x if math.isinf(x) or rng.random() < 0.3 else
            x + number(rng, style) * (far or rng.choice([1, 2 ** -4, 2 ** -20])) for x in bar]
    largest = LARGE if style != "vast" else 1e308
    kept = all(abs(x) <= largest or x == before for x, before in zip(ends, bar))
    return (min(ends), max(ends)) if kept else bar


def random_barcode(rng, style, infinite, before=None):
    """@param infinite the share of bars that never die. @param before a barcode that the new one
    may resemble."""
    if rng.random() < 0.06:
        return []
    bars = []
    if before and rng.random() < 0.6:
        far, kept = rng.choice([None, None, 1, 2 ** -8, 2 ** -14, 2 ** -24]), rng.choice([0.9, 1])
        bars = [(d, *moved(rng, style, (b, e), far)) for d, b, e in before if rng.random() < kept]
    else:
        for dim in sorted(rng.sample(range(4), rng.choice([1, 1, 2, 2, 3]))):
            most = rng.choice([3, 3, 5, 5, 8, 8, 30])
            bars += [(dim, *random_bar(rng, style, infinite)) for _ in range(rng.randint(0, most))]
    while bars and rng.random() < 0.3:  # repeats some of the bars
        bars.append(rng.choice(bars))
    if rng.random() < 0.5:
        rng.shuffle(bars)
    return bars


def finite(bars):
    return [x for bar in bars for x in bar[1:] if math.isfinite(x)]


def csv_file(rng, bars):
    separator, end = rng.choice([",", ",", ",", ";", "\t", ", "]), rng.choice(["\n", "\n", "\r\n"])
    text = "\ufeff" if rng.random() < 0.1 else ""
    text += separator.join(["dim", "birth", "death"]) + end
    for d, b, e in bars:
        if rng.random() < 0.03:
            text += rng.choice(["# a comment", ""]) + end
        text += separator.join([str(d), formats.number(rng, b), formats.number(rng, e)]) + end
    return text.encode()


def json_file(rng, bars):
    def said(value):
        return None if value == INF else "-inf" if value == -INF else value
    found = [{"dim": d, "birth": said(b), "death": said(e)} for d, b, e in bars]
    if rng.random() < 0.2:
        for bar in found:
            bar["later"] = [1, {"a": None}]
    document = {"format": "ph-barcode", "version": 1, "program": "a test",
                "input": {"path": "a.csv", "description": "points"}, "bars": found, "timings": {}, "peak_memory": 1}
    return json.dumps(document, indent=rng.choice([None, 1])).encode()


def ripser_file(rng, bars):
    text = rng.choice(["", "value range: [0,1]\n", "distance matrix with 3 points\n"])
    for dim in range(max([d for d, _, _ in bars], default=0) + 1):
        text += f"persistence intervals in dim {dim}:\n"
        for d, b, e in bars:
            if d == dim:
                text += f" [{b!r}, )\n" if e == INF else f" [{b!r},{e!r})\n"
    return text.encode()


def pers_file(rng, bars):
    first = rng.choice(["", "", "2 "])
    return "".join(f"{first}{d} {formats.number(rng, b)} {formats.number(rng, e)}\n" for d, b, e in bars).encode()


def dipha_file(rng, bars):
    largest = max(finite(bars), default=0.0)
    return files.dipha(2, len(bars)) + b"".join(
        struct.pack("<qdd", *((-d - 1, b, max(largest, b)) if e == INF else (d, b, e))) for d, b, e in bars)


def npy_file(rng, bars):
    big = rng.random() < 0.2
    fortran = rng.random() < 0.2
    columns = list(zip(*bars)) if fortran else bars
    return files.npy("<f8" if not big else ">f8", (len(bars), 3),
                     files.packed("<f8" if not big else ">f8", [x for row in columns for x in row]), fortran,
                     rng.choice([1, 1, 2, 3]))


WRITERS = {"csv": csv_file, "json": json_file, "txt": ripser_file, "pers": pers_file, "dipha": dipha_file,
           "npy": npy_file}


def barcode_file(rng, stem, bars):
    """@return the name and content of a file."""
    ways = list(WRITERS) + ["csv"]
    if any(math.isinf(b) for _, b, _ in bars):
        ways.remove("txt")  # this format has no infinite births
    way = rng.choice(ways)
    name, content = f"{stem}.{way}", WRITERS[way](rng, bars)
    return (name + ".gz", gzip.compress(content)) if rng.random() < 0.05 else (name, content)


def read_npy(content):
    """@return the shape and the numbers of an array of float64 in C order."""
    assert content[:8] == b"\x93NUMPY\x01\x00", content[:8]
    start = 10 + struct.unpack_from("<H", content, 8)[0]
    header = ast.literal_eval(content[10:start].decode("latin-1"))
    assert header["descr"] == "<f8" and not header["fortran_order"] and start % 64 == 0, header
    count = math.prod(header["shape"])
    assert len(content) == start + 8 * count, len(content)
    return header["shape"], struct.unpack_from(f"<{count}d", content, start)
