# SPDX-License-Identifier: MIT
"""The options of ph-cluster and the kinds of input for option_inputs.py."""
import gzip
import math
import os
import random
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import files  # noqa: E402

SCORES = ["--scores"]
BESIDE = SCORES  # arguments added to both runs for options without a row
POINTS = "not a set of points|found points"


def rows(Row):
    def row(*arguments, beside=(), **how):
        return Row(*arguments, beside=[*SCORES, *beside], **how)
    return {
        "--format": row("--format", "lower-distance", choices=(), unfit="triangle|row|not plain text|number|distances"),
        "--allow-empty": row("--allow-empty", variant="empty", sign="--allow-empty: not needed"),
        "--symmetrise": row("--symmetrise", "max", variant="asymmetric"),
        "--from-correlation": row("--from-correlation", variant="correlation", unfit="not a correlation"),
        "--diagonal": row("--diagonal", "births", variant="births"),
        "--nan": row("--nan", "drop", variant="nan"),
        "--columns": row("--columns", "1", unfit="as many as there are columns"),
        "--raw-points": row("--raw-points", "2", unfit="found raw|truncated point|NaN|infinite"),
        "--raw-type": row("--raw-type", "int16", unfit="found raw|truncated point|double cannot hold|NaN",
                          alike=("uint32", "int32")),
        "--raw-skip": row("--raw-skip", "8", unfit="found raw|truncated point"),
        "--min-size": row("--min-size", "7"),
        "--neighbours": row("--neighbours", "1"),
        "--metric": row("--metric", "manhattan", unfit=POINTS),
        "--method": row("--method", "leaf"),
        "--epsilon": row("--epsilon", "3"),
        "--max-size": row("--max-size", "5"),
        "--allow-single": row("--allow-single", beside=["--epsilon", "50"]),
        "--output": row("-o", "x.csv"),
        "--output-format": row("--output-format", "json"),
        "--scores": Row("--scores"),
        "--tree": row("--tree", "t.json"),
        "--threads": row("--threads", "1", sign="threads 1"),
        "--memory-limit": row("--memory-limit", "300MiB", sign="memory limit 300 MiB"),
        "--progress": row("--progress", "json", sign="progress {}"),
        "--quiet": row("--quiet", lost="ph-cluster: "),
        "--verbose": row("--verbose", sign="memory limit"),
        "--force": row("--force", beside=["-o", "@input", "--output-format", "csv"]),
    }


def blobs():
    """Two groups of two blobs. One blob consists of two parts that are only a little apart."""
    rng = random.Random(4)
    found = []
    for x, y, size in ((1, 1, 6), (2.5, 1, 6), (12, 2, 6), (13.4, 2, 4), (13.4, 2.22, 4)):
        found += [(x + rng.uniform(-.08, .08), y + rng.uniform(-.08, .08), 1 + rng.uniform(0, .08))
                  for _ in range(size)]
    return found


def text(table):
    return "".join(" ".join(map(repr, row)) + "\n" for row in table).encode()


def inputs(Input, _program):
    import option_inputs

    def of(option, *more, **how):
        return {option: option_inputs.Row(option, *more, beside=how.pop("beside", SCORES), **how)}
    # A point of a cloud with NaN is left out without an option.
    of_clouds = of("--nan", "error", variant="nan")
    points = blobs()
    size = len(points)
    flat = [p[:2] for p in points]
    with_nan = [*points[:-1], (1.0, math.nan, 1.0)]
    distances = [[math.dist(p, q) for q in points] for p in points]

    def matrix(change):
        return text([[change(i, j) for j in range(size)] for i in range(size)])

    def lower(change):
        return text([[change(i, j) for j in range(i)] for i in range(1, size)])

    def of_nan(i, j):
        return math.nan if {i, j} == {3, 4} else distances[i][j]

    def of_correlation(i, j):
        return 1 if i == j else 1 - distances[i][j] / 20
    square = {"plain": matrix(lambda i, j: distances[i][j]), "nan": matrix(of_nan),
              "asymmetric": matrix(lambda i, j: distances[i][j] * (1 + (3 * i + j) % 4 / 4)),
              "births": matrix(lambda i, j: distances[i][j] or 0.1 + i / 100), "correlation": matrix(of_correlation),
              "empty": b""}
    triangle = {"plain": lower(lambda i, j: distances[i][j]), "nan": lower(of_nan),
                "correlation": lower(of_correlation), "empty": b""}
    pairs = [(i, j) for i in range(size) for j in range(i) if distances[i][j] < 13]
    some = {"plain": text((i, j, distances[i][j]) for i, j in pairs),
            "nan": text((i, j, of_nan(i, j)) for i, j in pairs),
            "correlation": text((i, j, of_correlation(i, j)) for i, j in pairs), "empty": b""}

    def pcd(rows):
        return (f"VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {len(rows)}\nHEIGHT 1\n"
                f"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(rows)}\nDATA ascii\n").encode() + text(rows)

    def ply(rows):
        return (f"ply\nformat ascii 1.0\nelement vertex {len(rows)}\nproperty double x\nproperty double y\n"
                "property double z\nend_header\n").encode() + text(rows)

    def off(rows):
        return f"OFF\n{len(rows)} 1 0\n".encode() + text(rows) + b"3 0 1 2\n"

    def npy(rows):
        return files.array((len(rows), 3), [x for row in rows for x in row])

    def raw(rows):
        return b"".join(struct.pack("<3f", *row) for row in rows)

    def kind(name, arguments, file, plain, rows=None, **variants):
        return Input(name, [file, "--min-size", "3", *arguments], {file: plain}, rows, **variants)
    return [
        kind("points", [], "p.txt", text(points), nan=text(with_nan), empty=b"# none\n"),
        kind("points of the plane", [], "p.csv", text(flat).replace(b" ", b","), nan=text(p[:2] for p in with_nan),
             empty=b"# none\n"),
        kind("points.gz", [], "p.txt.gz", gzip.compress(text(points)), nan=gzip.compress(text(with_nan)),
             empty=gzip.compress(b"# none\n"), rows=of("--force", sign="--force: not needed")),
        kind("NPY points", [], "p.npy", npy(points), nan=npy(with_nan), empty=npy([])),
        kind("PCD", [], "p.pcd", pcd(points), nan=pcd(with_nan), empty=pcd([]), rows=of_clouds),
        kind("PLY", [], "p.ply", ply(points), nan=ply(with_nan), empty=ply([]), rows=of_clouds),
        kind("XYZ", [], "p.xyz", text(points), nan=text(with_nan), empty=b"# none\n", rows=of_clouds),
        kind("OFF", [], "p.off", off(points), empty=b"OFF\n0 0 0\n"),
        kind("raw points", ["--raw-points", "3"], "p.bin", raw(points), nan=raw(with_nan), empty=b""),
        kind("matrix", ["--format", "distance"], "m.txt", **square),
        kind("lower triangle", ["--format", "lower-distance"], "m.txt", **triangle,
             rows=of("--format", "sparse", choices=(), unfit="found|not")),
        kind("sparse", ["--format", "sparse"], "m.txt", **some),
        kind("points, leaf", ["--method", "leaf"], "p.txt", text(points), nan=text(with_nan), empty=b"# none\n"),
        kind("points, dry run", ["--dry-run"], "p.txt", text(points), nan=text(with_nan), empty=b"# none\n"),
    ]
