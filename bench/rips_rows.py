# SPDX-License-Identifier: MIT
"""The inputs of compare_rips.py: files of a data folder, and seeded samples that are written when
needed.

Samples use only `random.Random.random()`, whose sequence Python promises to keep: a sample is the
same file on every machine.
"""
import math
import os
import pathlib
import random
import struct
from dataclasses import dataclass
from typing import Optional


def write_sphere(path, count, seed):
    """Uniform points of the unit sphere in R³ (Archimedes: the height is uniform)."""
    draw = random.Random(seed).random
    with open(path, "w") as file:
        for _ in range(count):
            z, angle = 2 * draw() - 1, 2 * math.pi * draw()
            r = math.sqrt(1 - z * z)
            file.write(f"{r * math.cos(angle):.9g} {r * math.sin(angle):.9g} {z:.9g}\n")


def write_cube(path, count, seed):
    """Uniform points of the unit cube in R³."""
    draw = random.Random(seed).random
    with open(path, "w") as file:
        for _ in range(count):
            file.write(f"{draw():.9g} {draw():.9g} {draw():.9g}\n")


def write_square(path, count, seed):
    """Uniform points of the unit square."""
    draw = random.Random(seed).random
    with open(path, "w") as file:
        for _ in range(count):
            file.write(f"{draw():.9g} {draw():.9g}\n")


def write_annulus(path, count, seed):
    """Uniform points of the annulus with radii 1 and 1.3 in the plane."""
    draw = random.Random(seed).random
    with open(path, "w") as file:
        for _ in range(count):
            r, angle = math.sqrt(1 + 0.69 * draw()), 2 * math.pi * draw()
            file.write(f"{r * math.cos(angle):.9g} {r * math.sin(angle):.9g}\n")


def write_symmetric(path, count, seed):
    """A symmetric matrix of independent uniform numbers: the strict lower triangle, float32."""
    draw = random.Random(seed).random
    with open(path, "wb") as file:
        for i in range(1, count):
            file.write(struct.pack(f"<{i}f", *(draw() for _ in range(i))))


def write_orthogonal(path, count, seed):
    """Uniform orthogonal matrices as points of R⁹: rotations (Shoemake's method with quaternions),
    half of them multiplied by -1."""
    draw = random.Random(seed).random
    with open(path, "w") as file:
        for _ in range(count):
            share, first, second = draw(), 2 * math.pi * draw(), 2 * math.pi * draw()
            x, y = math.sqrt(1 - share) * math.sin(first), math.sqrt(1 - share) * math.cos(first)
            z, w = math.sqrt(share) * math.sin(second), math.sqrt(share) * math.cos(second)
            sign = 1 if draw() < 0.5 else -1
            matrix = (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
                      2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                      2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y))
            file.write(" ".join(f"{sign * entry:.9g}" for entry in matrix) + "\n")


@dataclass(frozen=True)
class Sample:
    """A generated input, written by `write(path, count, seed)`."""
    name: str
    suffix: str
    write: object
    count: int
    seed: int = 1


SAMPLES = {sample.name: sample for sample in (
    Sample("s2_600", "txt", write_sphere, 600),
    Sample("s2_2000", "txt", write_sphere, 2000),
    Sample("cube_600", "txt", write_cube, 600),
    Sample("cube_20000", "txt", write_cube, 20_000),
    Sample("cube_100000", "txt", write_cube, 100_000),
    Sample("square_1000000", "txt", write_square, 1_000_000),
    Sample("annulus_100000", "txt", write_annulus, 100_000),
    Sample("cube_1000000", "txt", write_cube, 1_000_000),
    Sample("symmetric_500", "bin", write_symmetric, 500),
    Sample("symmetric_60", "bin", write_symmetric, 60),
    Sample("symmetric_80", "bin", write_symmetric, 80),
    Sample("symmetric_100", "bin", write_symmetric, 100),
    Sample("symmetric_150", "bin", write_symmetric, 150),
    Sample("o3_8192", "txt", write_orthogonal, 8192),
    Sample("tiny_12", "bin", write_symmetric, 12),
)}


@dataclass(frozen=True)
class Row:
    """One input of the table. Without a threshold, edges are at most as long as the enclosing
    radius."""
    source: str  # a sample to generate, or the name of a file in the data folder
    max_dim: int
    threshold: Optional[float] = None
    limit: bool = False  # true: also compared with the time to read and sort the edges
    peers: bool = True  # True: measured for the peers as well; False: for libph alone
    usual: bool = True  # measured if no rows are selected

    @property
    def name(self):
        at = "" if self.threshold is None else f"_t{self.threshold:g}"
        return f"h{self.max_dim}:{pathlib.PurePath(self.source).stem}{at}"


ROWS = (
    Row("dragon_2000.txt", 1, limit=True),
    Row("random_1000_8.txt", 1, limit=True),
    Row("torus_2000.txt", 1, limit=True),
    Row("klein_900.txt", 1, limit=True),
    Row("cyclooctane.csv", 1, limit=True),
    Row("symmetric_500", 1, limit=True),
    Row("ntorus_10000.txt", 1, 1.0),
    Row("sphere_3_192.bin", 2),
    Row("rp2_600.bin", 2),
    Row("s2_600", 2),
    Row("klein_400.txt", 2),
    Row("klein_900.txt", 2),
    Row("fractal_l.bin", 2),
    Row("network379.bin", 2),
    Row("house104.bin", 2),
    Row("cube_600", 2),
    Row("torus_1000.txt", 2),
    Row("random_1000_8.txt", 2),
    Row("cyclooctane.csv", 2, 0.8),
    Row("ntorus_10000.txt", 2, 0.4),
    Row("o3_1024.txt", 2),
    Row("s2_2000", 2),
    Row("o3_1024.txt", 3, 1.8),
    Row("o3_4096.txt", 3, 1.4),
    Row("o3_8192", 3, 1.2),
    Row("sphere_3_192.bin", 3),
    Row("celegans.bin", 3),
    Row("fractal_r.bin", 3),
    Row("symmetric_60", 3),
    Row("symmetric_80", 3),
    Row("symmetric_100", 3),
    Row("symmetric_150", 3, peers=False, usual=False),
    Row("random_50_16.bin", 7),
    Row("random_100_4.bin", 3),
    Row("cube_20000", 1, peers=False, usual=False),
    Row("square_1000000", 1, peers=False, usual=False),
    Row("cube_100000", 1, peers=False, usual=False),
    Row("annulus_100000", 1, peers=False, usual=False),
    Row("cube_1000000", 0, peers=False, usual=False),
    Row("tiny_12", 2, limit=True, usual=False),
)


def data_folder():
    """The default folder of inputs that the script does not generate."""
    root = os.environ.get("PH_TEST_DATA") or pathlib.Path(__file__).resolve().parents[2] / "shared"
    return pathlib.Path(root, "data")


def input_file(row, data, made):
    """The path of a row's input; a sample is written below `made` first. None if `data` lacks the
    file."""
    sample = SAMPLES.get(row.source)
    if sample is None:
        path = data / row.source
        return path if path.is_file() else None
    path = made / f"{sample.name}.{sample.suffix}"
    if not path.exists():
        sample.write(path, sample.count, sample.seed)
    return path


def is_matrix(path):
    """True if a file holds distances (a lower triangle) rather than points."""
    return path.suffix == ".bin"


def write_two_points(like, made):
    """Writes two points in the same format, to measure the start of a program."""
    path = made / f"two_points.{'bin' if is_matrix(like) else 'txt'}"
    if is_matrix(like):
        path.write_bytes(struct.pack("<f", 1))
    else:
        path.write_text("0 0 0\n1 0 0\n")
    return path
