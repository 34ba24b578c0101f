# SPDX-License-Identifier: MIT
"""Reads point clouds in PCD files with ground truth, and images of labels."""
import pathlib
from dataclasses import dataclass

import numpy

TYPES = {
    ("F", 4): "<f4",
    ("F", 8): "<f8",
    ("U", 1): "u1",
    ("U", 2): "<u2",
    ("U", 4): "<u4",
    ("U", 8): "<u8",
    ("I", 1): "i1",
    ("I", 2): "<i2",
    ("I", 4): "<i4",
    ("I", 8): "<i8",
}
WANTED = ("label", "x", "y", "z")


def decompressed(data, size):
    """The first `size` bytes of an LZF stream."""
    result, at, end = bytearray(), 0, len(data)
    try:
        while len(result) < size and at < end:
            control = data[at]
            at += 1
            if control < 32:
                result += data[at : at + control + 1]
                at += control + 1
                continue
            length = control >> 5
            if length == 7:
                length += data[at]
                at += 1
            start = len(result) - ((control & 31) << 8) - data[at] - 1
            at += 1
            length += 2
            if start < 0:
                raise ValueError("LZF: a reference before the beginning")
            if start + length <= len(result):
                result += result[start : start + length]
            else:  # the bytes to copy overlap the bytes that are appended
                period = result[start:]
                result += (period * (length // len(period) + 1))[:length]
    except IndexError:
        raise ValueError("LZF: truncated") from None
    if len(result) < size:
        raise ValueError("LZF: truncated")
    return bytes(result[:size])


def read_pcd(path):
    """The columns label, x, y and z of a PCD file, and its width and height. Other fields are
    ignored."""
    data = pathlib.Path(path).read_bytes()
    header, at = {}, 0
    while "DATA" not in header:
        end = data.index(b"\n", at)
        words = data[at:end].decode("ascii").split()
        at = end + 1
        if words and not words[0].startswith("#"):
            header[words[0]] = words[1:]
    names = header["FIELDS"]
    counts = [int(n) for n in header.get("COUNT", ["1"] * len(names))]
    types = [TYPES[kind, int(size)] for kind, size in zip(header["TYPE"], header["SIZE"])]
    record = numpy.dtype([(str(i), t, (n,)) for i, (t, n) in enumerate(zip(types, counts))])
    width, height = int(header["WIDTH"][0]), int(header["HEIGHT"][0])
    size = width * height
    field = {name: str(i) for i, name in enumerate(names) if name in WANTED}
    kind = header["DATA"][0]
    if kind == "ascii":
        table = numpy.loadtxt(data[at:].decode("ascii").splitlines(), ndmin=2)
        offsets = numpy.cumsum([0, *counts])
        columns = {name: table[:, offsets[int(i)]] for name, i in field.items()}
    elif kind == "binary":
        rows = numpy.frombuffer(data, record, size, at)
        columns = {name: rows[i][:, 0] for name, i in field.items()}
    elif kind == "binary_compressed":
        packed = int.from_bytes(data[at : at + 4], "little")
        starts = [size * record.fields[str(i)][1] for i in range(len(names))]
        enough = max(starts[int(i)] + size * record[i].itemsize for i in field.values())
        plain = decompressed(data[at + 8 : at + 8 + packed], enough)
        columns = {
            name: numpy.frombuffer(plain, record[i].base, size * counts[int(i)], starts[int(i)])[
                :: counts[int(i)]
            ]
            for name, i in field.items()
        }
    else:
        raise ValueError(f"{path}: DATA {kind}")
    return columns, width, height


@dataclass
class Scene:
    """One frame. `points` are rows x, y, z, NaN where there is no depth; `truth` holds one label
    per point: 0 no depth, 1 to 9 the table and other surfaces, from 10 on the parts of objects
    (label // 10 is the object)."""

    name: str
    points: numpy.ndarray
    truth: numpy.ndarray
    width: int
    height: int  # 1: without rows and columns

    def __post_init__(self):
        self.truth = numpy.where(numpy.isfinite(self.points).all(axis=1), self.truth, 0)

    @property
    def organised(self):
        return self.height > 1


def read_scene(path):
    columns, width, height = read_pcd(path)
    if missing := [name for name in WANTED if name not in columns]:
        raise ValueError(f"{path}: no field {missing[0]}")
    points = numpy.stack([columns[axis] for axis in "xyz"], axis=1).astype(numpy.float32)
    return Scene(
        pathlib.Path(path).stem, points, columns["label"].astype(numpy.int32), width, height
    )


def write_scene(path, scene, colours=None, viewpoint=(0, 0, 0)):
    """Writes a frame as a PCD file.

    @param colours red, green and blue of each point, as bytes.
    @param viewpoint the place of the sensor."""
    colour = [("rgb", "<u4")] if colours is not None else []
    rows = numpy.empty(len(scene.truth), [("xyz", "<f4", 3), ("label", "<u4"), *colour])
    rows["xyz"], rows["label"] = scene.points, scene.truth
    if colours is not None:
        rows["rgb"] = colours.astype(numpy.uint32) @ numpy.array([1 << 16, 1 << 8, 1], numpy.uint32)
    fields = 4 + len(colour)
    header = (
        "VERSION 0.7",
        "FIELDS x y z label" + " rgb" * len(colour),
        "SIZE" + " 4" * fields,
        "TYPE F F F U" + " U" * len(colour),
        "COUNT" + " 1" * fields,
        f"WIDTH {scene.width}",
        f"HEIGHT {scene.height}",
        f"VIEWPOINT {' '.join(f'{x:.9g}' for x in viewpoint)} 1 0 0 0",
        f"POINTS {len(rows)}",
        "DATA binary",
        "",
    )
    pathlib.Path(path).write_bytes("\n".join(header).encode() + rows.tobytes())


def write_depth(path, scene, per_metre):
    """Writes the depth of an organised frame as a PGM file of 16 bits. 0 is no depth.

    @param per_metre units of depth per metre."""
    depth = numpy.nan_to_num(numpy.rint(scene.points[:, 2] * float(per_metre))).astype(">u2")
    header = f"P5 {scene.width} {scene.height} 65535\n"
    pathlib.Path(path).write_bytes(header.encode() + depth.tobytes())


def read_pgm(path):
    data = pathlib.Path(path).read_bytes()
    words, at = [], 0
    while len(words) < 4:
        start = at
        while not data[at : at + 1].isspace():
            at += 1
        words.append(data[start:at])
        at += 1
    if words[0] != b"P5":
        raise ValueError(f"{path}: not a binary PGM")
    width, height, largest = map(int, words[1:])
    return numpy.frombuffer(data, ">u2" if largest > 255 else "u1", width * height, at)


def read_labels(stem):
    """The labels, one per point, that a program wrote to the path `stem` plus .npy, .pgm (binary)
    or .pcd; None if it wrote no such file."""
    for ending, read in (
        (".npy", numpy.load),
        (".pgm", read_pgm),
        (".pcd", lambda p: read_pcd(p)[0]["label"]),
    ):
        path = pathlib.Path(f"{stem}{ending}")
        if path.exists():
            return numpy.asarray(read(path)).ravel().astype(numpy.int64)
    return None


@dataclass(frozen=True)
class Pinhole:
    """A camera that maps the points of a frame without rows and columns back to its pixels."""

    focal: float = 525.0
    centre_x: float = 319.5
    centre_y: float = 239.5
    width: int = 640
    height: int = 480

    def image(self, scene, labels):
        """`labels` as an image. Of two points in the same pixel, the later one counts."""
        seen = numpy.isfinite(scene.points).all(axis=1) & (scene.points[:, 2] > 0)
        x, y, z = scene.points[seen].T.astype(float)
        u = numpy.rint(self.focal * x / z + self.centre_x).astype(int)
        v = numpy.rint(self.focal * y / z + self.centre_y).astype(int)
        inside = (u >= 0) & (v >= 0) & (u < self.width) & (v < self.height)
        image = numpy.zeros((self.height, self.width), numpy.int64)
        image[v[inside], u[inside]] = labels[seen][inside]
        return image
