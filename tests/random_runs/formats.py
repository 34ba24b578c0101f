# SPDX-License-Identifier: MIT
"""Files of random formats with given contents, and readers of barcodes, by the definition of each
format."""
import gzip
import json
import math
import struct
import zipfile

import files

TYPES = {"float64": "f8", "float32": "f4", "int64": "i8", "int32": "i4", "uint32": "u4", "int16": "i2",
         "uint16": "u2", "int8": "i1", "uint8": "u1"}


def fits(values, kind):
    """True if a NumPy type can hold the numbers exactly."""
    if kind == "float64":
        return True
    if kind == "float32":
        return all(math.isinf(v) or math.isnan(v) or struct.unpack("f", struct.pack("f", v))[0] == v
                   for v in values if abs(v) < 1e38 or not math.isfinite(v)) and \
            all(abs(v) < 1e38 for v in values if math.isfinite(v))
    if not all(math.isfinite(v) and v == int(v) for v in values):
        return False
    bits = int(kind.lstrip("uint"))
    low, high = (0, 2 ** bits) if kind[0] == "u" else (-2 ** (bits - 1), 2 ** (bits - 1))
    return all(low <= v < high for v in values)


def descr(kind, big=False):
    """The description of a type in NumPy's notation."""
    return ("|" if kind.endswith("int8") else ">" if big else "<") + TYPES[kind]


def packed(values, kind, big=False):
    return files.packed(descr(kind, big), values)


def any_kind(rng, values):
    return rng.choice([k for k in TYPES if fits(values, k)])


def npy(rng, shape, values):
    """An NPY file. @param values in C order."""
    fortran = rng.random() < 0.3 and len(shape) > 1
    if fortran:
        values = [values[place(shape, at)] for at in indices(shape[::-1], reverse=True)]
    kind, big = any_kind(rng, values), rng.random() < 0.3
    return files.npy(descr(kind, big), shape, packed(values, kind, big), fortran, rng.choice([1, 2, 3]))


def npz(rng, shape, values):
    return files.npz({"a.npy": npy(rng, shape, values)}, rng.choice([zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED]))


def indices(shape, reverse=False):
    """The indices of all elements, with the last axis fastest, or the first if `reverse` is
    true."""
    found = [()]
    for n in shape:
        found = [at + (i,) for at in found for i in range(n)]
    return [at[::-1] for at in found] if reverse else found


def place(shape, at):
    result = 0
    for n, i in zip(shape, at):
        result = result * n + i
    return result


def number(rng, value):
    """A random way to write a number exactly."""
    if math.isnan(value):
        return "nan"
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    ways = [repr(value), f"{value:.17g}", f"{value:.17e}"]
    if value == int(value) and abs(value) < 1e15:
        ways += [str(int(value)), f"{int(value)}.0", f"{int(value)}e0"]
    return rng.choice(ways)


def table(rng, rows, separator=None):
    separator = separator or rng.choice([" ", ",", ";", "\t", ", "])
    end = rng.choice(["\n", "\r\n"])
    text = "\ufeff" if rng.random() < 0.1 else ""
    for row in rows:
        if rng.random() < 0.05:
            text += rng.choice(["# a comment", ""]) + end
        text += separator.join(number(rng, x) for x in row) + end
    if rng.random() < 0.1:
        text = text[:-len(end)]
    return text.encode()


def zipped(rng, name, content):
    """Compresses some of the files, chosen at random."""
    return (name + ".gz", gzip.compress(content)) if rng.random() < 0.1 else (name, content)


# Points. Each function returns (name, content, options).

def points_file(rng, rows, is_table=False):
    flat = [x for row in rows for x in row]
    width = len(rows[0])
    ways = ["text", "text", "text", "npy", "npz"]
    if width == 3 and not is_table:
        ways += ["xyz", "pts", "off", "ply"]
        if fits(flat, "float32"):
            ways.append("pcd")
    way = rng.choice(ways)
    if way == "text":
        name, content = zipped(rng, rng.choice(["a.txt", "a.csv", "a"]), table(rng, rows))
        return name, content, ["--format", "points"]
    if way in ("npy", "npz"):
        content = (npy if way == "npy" else npz)(rng, (len(rows), width), flat)
        return "a." + way, content, ["--format", way, "--complex", "rips"]
    if way == "xyz":
        return "a.xyz", table(rng, rows, " "), ["--format", "xyz"]
    if way == "pts":
        return "a.pts", f"{len(rows)}\n".encode() + b"".join(
            (" ".join(number(rng, x) for x in row) + "\n").encode() for row in rows), ["--format", "pts"]
    if way == "off":
        return "a.off", (f"OFF\n{len(rows)} 0 0\n" + "".join(
            " ".join(number(rng, x) for x in row) + "\n" for row in rows)).encode(), ["--format", "off"]
    if way == "ply":
        return "a.ply", ply(rng, rows, []), ["--format", "ply"]
    data = rng.choice(["ascii", "binary"])
    head = f"VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {len(rows)}\nHEIGHT 1\n" \
           f"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(rows)}\nDATA {data}\n"
    body = packed(flat, "float32") if data == "binary" else "".join(
        " ".join(number(rng, x) for x in row) + "\n" for row in rows).encode()
    return "a.pcd", head.encode() + body, ["--format", "pcd"]


def ply(rng, rows, faces):
    order = rng.choice(["ascii", "binary_little_endian", "binary_big_endian"])
    head = f"ply\nformat {order} 1.0\nelement vertex {len(rows)}\n" + "".join(
        f"property double {c}\n" for c in "xyz")
    if faces:
        head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\n"
    head += "end_header\n"
    if order == "ascii":
        body = "".join(" ".join(number(rng, x) for x in row) + "\n" for row in rows)
        body += "".join(" ".join(map(str, (len(f), *f))) + "\n" for f in faces)
        return (head + body).encode()
    big = order == "binary_big_endian"
    body = b"".join(packed(row, "float64", big) for row in rows)
    body += b"".join(packed([len(f)], "uint8") + packed(f, "int32", big) for f in faces)
    return head.encode() + body


# Distances `d[i][j]`, which are infinite for points that are never joined.

def square_file(rng, rows):
    """A file with a full matrix, of distances or of other numbers."""
    n = len(rows)
    if rng.random() < 0.5:
        return (*zipped(rng, "a.txt", table(rng, rows)), ["--format", "distance"])
    return "a.npy", npy(rng, (n, n), [x for row in rows for x in row]), ["--format", "distance"]


def distances_file(rng, d):
    n = len(d)
    lower = [d[i][:i] for i in range(n)]
    flat = [x for row in d for x in row]
    ways = ["dipha"]
    if n > 1:
        ways += ["square", "square", "lower-distance", "upper-distance"]
        if fits(flat, "float32"):
            ways.append("binary")
    joined = {i for i in range(n) for j in range(n) if i != j and d[i][j] < math.inf}
    if n - 1 in joined:
        ways += ["sparse", "dipha-sparse"]
    way = rng.choice(ways)
    if way == "square":
        return square_file(rng, d)
    if way == "lower-distance":
        rows = lower[1:] if rng.random() < 0.5 else [[x for row in lower for x in row]]
        return "a.txt", table(rng, rows), ["--format", way]
    if way == "upper-distance":
        rows = [d[i][i + 1:] for i in range(n - 1)]
        return "a.txt", table(rng, rows), ["--format", way]
    if way == "binary":
        return "a.bin", packed([x for row in lower for x in row], "float32"), ["--format", "binary"]
    if way == "dipha":
        return "a.dipha", files.dipha(7, n, *flat), ["--format", "dipha"]
    pairs = [(i, j, d[i][j]) for i in range(n) for j in range(i) if d[i][j] < math.inf]
    rng.shuffle(pairs)
    if way == "sparse":
        rows = [(i, j, x) if rng.random() < 0.5 else (j, i, x) for i, j, x in pairs]
        return "a.txt", "".join(f"{i} {j} {number(rng, x)}\n" for i, j, x in rows).encode(), \
            ["--format", "sparse"]
    at = [[] for _ in range(n)]
    for i, j, x in pairs:
        ends = rng.choice([[(i, j)], [(j, i)], [(i, j), (j, i)]])
        for u, v in ends:
            at[u].append((v, x))
    content = files.dipha(8, n) + packed([len(a) for a in at], "int64")
    content += packed([v for a in at for v, _ in a], "int64") + packed([x for a in at for _, x in a], "float64")
    return "a.dipha", content, ["--format", "dipha"]


# Images, with values in C order. The value of an absent voxel is NaN.

def image_file(rng, shape, values, periodic):
    """@return name, content and options, including the options for periodic axes."""
    def around(axes):
        axes = sorted(axes)
        return ["--periodic", "all" if len(axes) == len(shape) and rng.random() < 0.5 else
                ",".join(map(str, axes))] if axes else []
    kept = around(periodic)
    ways = ["npy", "npz", "npy", "raw"]
    finite = all(map(math.isfinite, values))
    if len(shape) == 2:
        ways += ["grid"] if min(shape) > 1 else []
        if fits(values, "uint16"):
            ways += ["pgm", "png", "pgm", "png"]
    if finite:
        ways.append("dipha")
        if -1 not in values:
            ways.append("perseus")
        if shape[-1] > 1 and len(shape) <= 7:
            ways.append("nifti")
    way = rng.choice(ways)
    fortran = [values[place(shape, at)] for at in indices(shape[::-1], reverse=True)]
    if way in ("npy", "npz"):
        content = (npy if way == "npy" else npz)(rng, shape, values)
        return "a." + way, content, ["--format", way, "--complex", "cubical", *kept]
    if way == "raw":
        kind = any_kind(rng, values)
        big = rng.random() < 0.3 and not kind.endswith("int8")
        skip = rng.choice([0, 0, 7])
        options = ["--raw-shape", ",".join(map(str, shape)), "--raw-type", kind]
        options += ["--raw-big-endian"] if big else []
        return "a.raw", b"x" * skip + packed(values, kind, big), \
            options + (["--raw-skip", str(skip)] if skip else []) + kept
    if way == "grid":
        rows = [values[i * shape[1]:(i + 1) * shape[1]] for i in range(shape[0])]
        return (*zipped(rng, "a.txt", table(rng, rows)), ["--format", "grid", *kept])
    if way == "pgm":
        most = max(1, int(max(values)))
        most = rng.choice([most, 255 if most < 256 else 65535])
        whole = [int(v) for v in values]
        if rng.random() < 0.5:
            return "a.pgm", f"P2\n{shape[1]} {shape[0]}\n{most}\n{' '.join(map(str, whole))}\n".encode(), \
                ["--format", "pgm", *kept]
        return "a.pgm", f"P5 {shape[1]} {shape[0]} {most}\n".encode() + \
            packed(values, "uint8" if most < 256 else "uint16", True), ["--format", "pgm", *kept]
    if way == "png":
        return "a.png", picture(rng, shape, values), ["--format", "png", *kept]
    if way == "dipha":
        return "a.dipha", files.dipha_image(shape[::-1], values), \
            ["--format", "dipha", *around({len(shape) - 1 - k for k in periodic})]
    if way == "perseus":
        sizes = [-n if k in periodic else n for k, n in enumerate(shape)]
        content = f"{len(shape)}\n" + "".join(f"{n}\n" for n in sizes) + "".join(
            number(rng, v) + "\n" for v in fortran)
        return "a.txt", content.encode(), ["--format", "perseus"]
    content = files.nifti(descr(any_kind(rng, values), rng.random() < 0.3), shape, fortran)
    return (*zipped(rng, "a.nii", content), ["--format", "nifti", *kept])


def picture(rng, shape, values):
    kind = "uint8" if max(values) < 256 and rng.random() < 0.7 else "uint16"
    rows = [packed(values[i * shape[1]:(i + 1) * shape[1]], kind, True) for i in range(shape[0])]
    return files.png(shape[1], shape[0], 8 if kind == "uint8" else 16, files.GREY, rows)


# Filtered complexes. Cells are ordered such that faces come first.

def simplices_file(rng, values):
    lines = [(s, v) for s, v in values.items()]
    rng.shuffle(lines)
    text = "".join(f"{' '.join(map(str, rng.sample(s, len(s))))} : {number(rng, v)}\n" for s, v in lines)
    return "a.simplices", text.encode(), ["--format", "simplices"]


def boundary_file(rng, cells, values):
    """@param cells the dimension and the ascending facets of each cell. @param values the value of
    each cell."""
    way = rng.choice(["phat", "phat-binary", "dipha"])
    if way == "phat":
        return [("a.phat", "".join(" ".join(map(str, (d, *f))) + "\n" for d, f in cells).encode())], \
            ["--format", "phat"], True
    if way == "phat-binary":
        content = struct.pack("<q", len(cells)) + b"".join(
            struct.pack(f"<{2 + len(f)}q", d, len(f), *f) for d, f in cells)
        return [("a.phat", content)], ["--format", "phat"], True
    offsets, flat = [], []
    for _, facets in cells:
        offsets.append(len(flat))
        flat += facets
    content = files.dipha(0, 0, len(cells), max(d for d, _ in cells))
    content += packed([d for d, _ in cells], "int64") + packed(values, "float64")
    content += packed(offsets, "int64") + struct.pack("<q", len(flat)) + packed(flat, "int64")
    return [("a.dipha", content)], ["--format", "dipha"], False


def values_file(rng, values):
    way = rng.choice(["text", "npy", "npz", "raw"])
    if way == "text":
        return "v.txt", "".join(number(rng, v) + "\n" for v in values).encode()
    if way == "npy":
        return "v.npy", npy(rng, (len(values),), values)
    if way == "npz":
        return "v.npz", npz(rng, (len(values),), values)
    return "v.bin", packed(values, "float64")


# Barcodes, read from the program's output.

def read_barcode(content, form):
    """@return the bars as sorted triples (dim, birth, death)."""
    if form == "csv":
        lines = content.decode().splitlines()
        assert lines[0] == "dim,birth,death", lines[0]
        rows = [line.split(",") for line in lines[1:]]
    elif form == "pers":
        rows = [line.split() for line in content.decode().splitlines()]
    elif form == "json":
        rows = [(b["dim"], -math.inf if b["birth"] == "-inf" else b["birth"],
                 math.inf if b["death"] is None else b["death"]) for b in json.loads(content)["bars"]]
    elif form == "ripser":
        rows, dim = [], None
        for line in content.decode().splitlines():
            if line.startswith("persistence intervals in dim "):
                dim = int(line[len("persistence intervals in dim "):-1])
            else:
                birth, death = line.strip("[) ").split(",")
                rows.append((dim, birth, death.strip() or math.inf))
    elif form == "dipha":
        magic, kind, count = struct.unpack_from("<3q", content)
        assert (magic, kind) == (files.DIPHA_MAGIC, 2) and len(content) == 24 + 24 * count
        rows = [struct.unpack_from("<qdd", content, 24 + 24 * i) for i in range(count)]
        rows = [(d, b, e) if d >= 0 else (-d - 1, b, math.inf) for d, b, e in rows]
    else:
        assert form == "npy" and content[:6] == b"\x93NUMPY", content[:10]
        start = 10 + struct.unpack_from("<H", content, 8)[0]
        count = (len(content) - start) // 24
        assert f"({count}, 3)" in content[:start].decode("latin-1"), content[:start]
        rows = [struct.unpack_from("<3d", content, start + 24 * i) for i in range(count)]
    return sorted((int(d), float(b) + 0.0, float(e) + 0.0) for d, b, e in rows)
