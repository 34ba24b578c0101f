# SPDX-License-Identifier: MIT
"""Clouds and depth images in the formats that ph-segment reads, written according to the
definitions of the formats. Also reads the program's outputs: labels, clouds and stored trees."""
import gzip
import struct
import zlib

import numpy as np

import files
import png_reader


PLY_TYPES = {"i1": "char", "u1": "uchar", "i2": "short", "u2": "ushort", "i4": "int", "u4": "uint",
             "f4": "float", "f8": "double"}
CLOUDS = ("pcd-ascii", "pcd-binary", "pcd-compressed", "ply-ascii", "ply-little", "ply-big", "npy", "xyz",
          "csv", "pts")


class File:
    """An input: its name, its bytes, and what it contains."""

    def __init__(self, form, name, content, fields, shape=None, viewpoint=False):
        self.form, self.name, self.content = form, name, content
        self.fields = fields  # maps names to values, for comparison with outputs
        self.shape = shape  # the rows and columns stored in the file
        self.viewpoint = viewpoint  # true if the file stores the position of the sensor
        self.options = []
        self.others = []  # other files: (name, content)


def word(value):
    """The shortest text that reads back to the same number."""
    return "nan" if value != value else str(value)


def lines_of(columns, separator=" ", end="\n"):
    return "".join(separator.join(map(word, row)) + end for row in zip(*(c.tolist() for c in columns)))


def fits_float(xyz):
    with np.errstate(over="ignore", invalid="ignore"):
        return np.array_equal(xyz.astype("f4").astype("f8"), xyz, equal_nan=True)


def columns_of(rng, scene, normals, colours):
    """@return pairs of name and array, with the coordinates first."""
    kind = "f4" if fits_float(scene.xyz) and rng.random() < 0.7 else "f8"
    columns = [(name, scene.xyz[:, k].astype(kind)) for k, name in enumerate("xyz")]
    if scene.normals is not None:
        columns += [(name, scene.normals[:, k].astype("f4")) for k, name in enumerate(normals)]
    if scene.colours is not None:
        columns += colours(scene.colours)
    if scene.extra:
        columns += [(name, values) for name, values in scene.extra]
    return columns


def apart(colours):
    return [(name, colours[:, k].astype("u1")) for k, name in enumerate(("red", "green", "blue"))]


def packed(kind):
    def pack(colours):
        c = colours.astype("u4")
        return [("rgb", (c[:, 0] << 16 | c[:, 1] << 8 | c[:, 2]).astype("u4").view(kind))]
    return pack


def pcd(rng, scene, data):
    pack = packed(rng.choice(["u4", "f4"] if data != "ascii" else ["u4"]))
    columns = columns_of(rng, scene, ("normal_x", "normal_y", "normal_z"), rng.choice([pack, apart]))
    if rng.random() < 0.3:
        rng.shuffle(columns)
    count, names = len(scene.xyz), [name for name, _ in columns]
    sizes = [array.dtype.itemsize for _, array in columns]
    types = [{"f": "F", "u": "U", "i": "I"}[array.dtype.kind] for _, array in columns]
    rows, wide = scene.shape or (1, count)
    words = " ".join(map(repr, map(float, scene.viewpoint)))
    head = rng.choice(["# .PCD v0.7 - Point Cloud Data file format\n", ""]) + f"VERSION {rng.choice(['0.7', '.7'])}\n"
    head += f"FIELDS {' '.join(names)}\nSIZE {' '.join(map(str, sizes))}\nTYPE {' '.join(types)}\n"
    head += f"COUNT {' '.join('1' for _ in names)}\nWIDTH {wide}\nHEIGHT {rows}\nVIEWPOINT {words} 1 0 0 0\n"
    head += f"POINTS {count}\nDATA {data}\n"
    if data == "ascii":
        body = lines_of([array for _, array in columns]).encode()
    elif data == "binary":
        body = records(columns).tobytes()
    else:
        plain = b"".join(array.tobytes() for _, array in columns)
        body = files.lzf(plain)
        body = struct.pack("<II", len(body), len(plain)) + body + b"\0" * rng.choice([0, 0, 100])
    return File(f"pcd-{data}", "a.pcd", head.encode() + body, columns, scene.shape, True)


def records(columns, order="<"):
    whole = np.zeros(len(columns[0][1]), [(name, array.dtype.newbyteorder(order)) for name, array in columns])
    for name, array in columns:
        whole[name] = array
    return whole


def ply(rng, scene, data):
    columns = columns_of(rng, scene, ("nx", "ny", "nz"), apart)
    if rng.random() < 0.3:
        rng.shuffle(columns)
    order = {"ascii": "ascii", "little": "binary_little_endian", "big": "binary_big_endian"}[data]
    before, after = rng.random() < 0.15, rng.random() < 0.15
    head = f"ply\nformat {order} 1.0\ncomment of no meaning\n"
    head += "element camera 1\nproperty float focus\n" if before else ""
    head += f"element vertex {len(scene.xyz)}\n" + "".join(
        f"property {PLY_TYPES[array.dtype.str[1:]]} {name}\n" for name, array in columns)
    head += "element face 1\nproperty list uchar int vertex_indices\n" if after else ""
    head += "end_header\n"
    if data == "ascii":
        body = ("1.5\n" if before else "") + lines_of([a for _, a in columns]) + ("3 0 0 0\n" if after else "")
        return File("ply-ascii", "a.ply", (head + body).encode(), columns)
    sign = "<" if data == "little" else ">"
    body = (struct.pack(sign + "f", 1.5) if before else b"") + records(columns, sign).tobytes()
    body += struct.pack(sign + "B3i", 3, 0, 0, 0) if after else b""
    return File(f"ply-{data}", "a.ply", head.encode() + body, columns)


def npy(rng, scene):
    kind = "f4" if fits_float(scene.xyz) and rng.random() < 0.6 else "f8"
    table, fields = scene.xyz, [(name, scene.xyz[:, k]) for k, name in enumerate("xyz")]
    if scene.colours is not None:
        table = np.concatenate([table, scene.colours], axis=1)
        if scene.colours.max(initial=0) > 1:
            fields += apart(scene.colours)
    shape = (*scene.shape, table.shape[1]) if scene.shape else table.shape
    array = table.reshape(shape).astype(rng.choice("<>") + kind)
    fortran = rng.random() < 0.2 and array.size > 0
    data = (array.transpose() if fortran else array).tobytes()
    return File("npy", "a.npy", files.npy(array.dtype.str, shape, data, fortran), fields, scene.shape)


def text(rng, scene, form):
    """A text file with x y z on each line. In csv, a line of names comes first; in pts, the number
    of points."""
    table, names = [scene.xyz[:, k] for k in range(3)], list("xyz")
    if scene.colours is not None and len(scene.xyz) > 0:
        # In pts, an intensity is between the coordinates and the colours.
        if form == "pts":
            table, names = [*table, np.full(len(scene.xyz), 0.5)], [*names, "intensity"]
        table += [scene.colours[:, k].astype("i8") for k in range(3)]
        names += ["red", "green", "blue"]
    fields = list(zip(names, table))
    head = ""
    if form == "csv":
        rng.shuffle(fields)
        head = ",".join(name for name, _ in fields) + "\n"
    elif form == "pts":
        head = f"{len(scene.xyz)}\n"
    elif rng.random() < 0.2:
        head = " ".join(names) + "\n"
    separator = rng.choice([",", ", "]) if form == "csv" else rng.choice([" ", "\t", ";"]) if form == "xyz" else " "
    head = head if separator == " " or form == "csv" else head.replace(" ", separator)
    lines = (head + lines_of([values for _, values in fields], separator)).splitlines()
    if form != "pts" and rng.random() < 0.15:
        lines.insert(rng.randrange(len(lines) + 1), rng.choice(["# a comment", "", "  "]))
    end = rng.choice(["\n", "\r\n"])
    content = rng.choice(["", "", "", "\ufeff"]) + end.join(lines) + rng.choice([end, end, ""])
    return File(form, f"a.{form}", content.encode(), fields)


def cloud_file(rng, scene, form=None):
    """A cloud in a random format, or in the requested one."""
    if form is None:
        form = rng.choice(CLOUDS)
        if form == "pts" and len(scene.xyz) == 0:
            form = "xyz"
    kind, _, data = form.partition("-")
    if kind == "pcd":
        file = pcd(rng, scene, {"compressed": "binary_compressed"}.get(data, data))
        file.form = form
    elif kind == "ply":
        file = ply(rng, scene, data)
    else:
        file = npy(rng, scene) if form == "npy" else text(rng, scene, form)
    if rng.random() < 0.1:
        file.name, file.content = file.name + ".gz", gzip.compress(file.content)
    return file


def camera_file(rng, camera, rows, columns):
    """@return the name and content of a file."""
    fx, fy, cx, cy = camera
    if rng.random() < 0.5:
        matrix = f"[{fx!r}, 0, 0, 0, {fy!r}, 0, {cx!r}, {cy!r}, 1]"  # the matrix column by column
        return "c.json", f'{{"width": {columns}, "height": {rows}, "intrinsic_matrix": {matrix}}}'.encode()
    return "c.yaml", (f"height: {rows}\nwidth: {columns}\ndistortion_model: plumb_bob\nd: [0, 0, 0, 0, 0]\n"
                      f"k: [{fx!r}, 0, {cx!r}, 0, {fy!r}, {cy!r}, 0, 0, 1]\n").encode()


def depth_file(rng, scene):
    """A depth image with its camera. @param scene its `depth` has the numbers to store."""
    rows, columns = scene.shape
    depth, scale, options = scene.depth, scene.depth_scale, []
    whole = depth.dtype.kind == "u"
    ways = ["npy"] + (["png", "pgm"] if whole else [])
    way = rng.choice(ways)
    if scale != (1000 if whole else 1) or rng.random() < 0.2:
        options += [["--depth-scale", repr(scale)]]
    if way == "npy":
        array = depth.astype(rng.choice("<>") + depth.dtype.str[1:])
        content = files.npy(array.dtype.str, depth.shape, array.tobytes())
    elif way == "png":
        content = files.png(columns, rows, 16, files.GREY, [row.astype(">u2").tobytes() for row in depth])
    elif rng.random() < 0.5:
        content = f"P2\n{columns} {rows}\n65535\n{' '.join(map(str, depth.reshape(-1)))}\n".encode()
    else:
        content = f"P5 {columns} {rows} 65535\n".encode() + depth.astype(">u2").tobytes()
    file = File(f"depth-{way}", f"a.{way}", content, [(n, scene.xyz[:, k]) for k, n in enumerate("xyz")], scene.shape)
    file.options = options
    if rng.random() < 0.5:
        file.options += [["--intrinsics", ",".join(map(repr, scene.camera))]]
    else:
        file.others.append(camera_file(rng, scene.camera, rows, columns))
        file.options += [["--camera", file.others[0][0]]]
    if scene.colours is not None:
        pixels = scene.colours.reshape(rows, columns * 3).astype("u1")
        file.others.append(("c.png", files.png(columns, rows, 8, files.RGB, [row.tobytes() for row in pixels])))
        file.options += [[rng.choice(["--color", "--colour"]), "c.png"]]
    return file


# Readers of the program's outputs.

def read_labels(content, name, count, shape):
    """Reads a file of labels. @param shape None if the cloud is not organised; () for any shape.
    @return one number per point."""
    if name.endswith(".csv"):
        return np.array([int(line) for line in content.decode().split("\n")[:-1]], int)
    if name.endswith(".png"):
        labels = read_grey_png(content)
        assert shape == () or labels.shape == shape, (labels.shape, shape)
        return labels.reshape(-1)
    length = 10 + struct.unpack_from("<H", content, 8)[0]
    header = content[10:length].decode()
    assert content[:6] == b"\x93NUMPY" and "'<u4'" in header, header
    labels = np.frombuffer(content[length:], "<u4").astype(int)
    expected = str((count,) if shape is None else tuple(shape))
    assert shape == () or f"'shape': {expected}" in header, (header, expected)
    return labels


def read_grey_png(content):
    (columns, rows, bits, colour), lines = png_reader.rows_of(content)
    assert (bits, colour) == (16, 0), (bits, colour)
    return np.frombuffer(b"".join(lines), ">u2").reshape(rows, columns).astype(int)


def lzf_unpacked(packed):
    out, at = bytearray(), 0
    while at < len(packed):
        control = packed[at]
        if control < 32:
            out += packed[at + 1:at + 2 + control]
            at += 2 + control
            continue
        length = control >> 5
        if length == 7:
            at += 1
            length += packed[at]
        back = ((control & 31) << 8 | packed[at + 1]) + 1
        at += 2
        for _ in range(length + 2):
            out.append(out[-back])
    return bytes(out)


def unpacked(columns):
    """Replaces a packed colour with its three channels."""
    out = {}
    for name, array in columns.items():
        if name in ("rgb", "rgba") and "red" not in columns:
            bits = array.view("u4")
            out |= {c: (bits >> s & 255).astype("u1") for c, s in (("red", 16), ("green", 8), ("blue", 0))}
        else:
            out[name] = array
    return out


def read_cloud(content):
    """@return values by name; and rows and columns, which PLY lacks."""
    if content[:3] == b"ply":
        head, _, body = content.partition(b"end_header\n")
        lines = head.decode().splitlines()
        assert lines[1] == "format binary_little_endian 1.0", lines[1]
        count = int(lines[2].split()[2])
        kinds = {name: kind for kind, name in PLY_TYPES.items()}
        kind = np.dtype([(line.split()[2], "<" + kinds[line.split()[1]]) for line in lines[3:]])
        shape = None
    else:
        head, _, body = content.partition(b"DATA binary_compressed\n")
        keys = {line.split()[0]: line.split()[1:] for line in head.decode().splitlines()[1:]}
        assert set(keys["COUNT"]) == {"1"}, keys["COUNT"]
        count, shape = int(keys["POINTS"][0]), (int(keys["HEIGHT"][0]), int(keys["WIDTH"][0]))
        kind = np.dtype([(n, "<" + t.lower() + s) for n, t, s in zip(keys["FIELDS"], keys["TYPE"], keys["SIZE"])])
        size, plain = struct.unpack_from("<II", body)
        body = lzf_unpacked(body[8:8 + size])
        assert len(body) == plain == count * kind.itemsize, (len(body), plain, count, kind)
        columns, at = {}, 0
        for name in kind.names:  # the fields follow one another
            columns[name] = np.frombuffer(body, kind[name], count, at)
            at += columns[name].nbytes
        return columns, shape
    assert len(body) == count * kind.itemsize, (len(body), count, kind)
    array = np.frombuffer(body, kind)
    return {name: np.ascontiguousarray(array[name]) for name in kind.names}, shape


def read_tree(content):
    """Reads a stored tree according to docs/explanation/segmentation.md."""
    assert content[:8] == b"ph-tree\n", content[:8]
    assert zlib.crc32(content[:-4]) == struct.unpack("<I", content[-4:])[0], "checksum of a stored tree"
    at = 8

    def take(kind, count):
        nonlocal at
        values = np.frombuffer(content, kind, count, at)
        at += values.nbytes
        return values
    version, method, columns, rows, vertices, merges, points, edges = take("<i8", 8).tolist()
    assert version == 4, version
    voxel, *viewpoint, distance = take("<f8", 5).tolist()
    take("<i8", 2)
    take("<f8", 5)
    take("<f8", 1)
    take("<i8", 3)
    surfaces, _, ranges = take("<i8", 3).tolist()
    at += surfaces * 168 + ranges * 16
    corners = take("<f8", 3 * vertices).reshape(-1, 3)
    centroids = take("<f8", 3 * vertices).reshape(-1, 3)
    if method != 1:
        take("<f8", 3 * vertices)
    counts, births = take("<i8", vertices), take("<f8", vertices)
    values = [(take("<f8", 1)[0], *take("<u4", 2).tolist()) for _ in range(merges)]
    vertex_of_point = take("<u4", columns * rows).astype(int)
    take("<f4", 3 * points)
    assert at == len(content) - 4, (at, len(content))
    vertex_of_point[vertex_of_point >= vertices] = -1
    return {"method": ("surface", "paper", "supervoxels")[method], "voxel": voxel, "viewpoint": viewpoint,
            "distance": distance, "edges": edges, "corners": corners, "centroids": centroids, "counts": counts,
            "births": births, "merges": values, "vertex_of_point": vertex_of_point, "points": points}




