# SPDX-License-Identifier: MIT
"""The options of ph-barcode and the kinds of input for option_inputs.py."""
import gzip
import math
import os
import random
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import files  # noqa: E402
import tiff_files  # noqa: E402

RIPS = ("points", "points.gz", "NPY points", "OFF mesh", "PCD", "XYZ", "matrix", "NPY matrix",
        "DIPHA distances", "lower triangle", "upper triangle", "binary triangle", "sparse",
        "DIPHA sparse distances")

LISTED = ("lower star", "PHAT", "DIPHA boundaries", "OFF mesh with values", "PLY mesh with values")


# Parts of messages that an option may cause for unsuitable data.
POINTS, IMAGE = "not a set of points|found points", "an image has rows"
H0 = ["--complex", "rips", "--max-dim", "0"]
LOOPS = ["--representatives", "cycles", "--output-format", "json"]
# Arguments added to both runs for options without a row.
BESIDE = []


def rows(Row):
    plot = ["--plot", "x.svg"]
    return {
        "--format": Row("--format", "phat", choices=(),
                        unfit="found phat|dimension|number of cells|boundary matrix|facet"),
        "--values": Row("--values", "values.txt"),
        "--allow-empty": Row("--allow-empty", variant="empty", sign="--allow-empty: not needed"),
        "--symmetrise": Row("--symmetrise", "max", variant="asymmetric"),
        "--from-correlation": Row("--from-correlation", variant="correlation", unfit="not a correlation"),
        "--diagonal": Row("--diagonal", "births", variant="births"),
        "--nan": Row("--nan", "drop", variant="nan"),
        "--columns": Row("--columns", "1", variant="labelled", unfit="as many as there are columns|ragged row|one point per row"),
        "--delay": Row("--delay", "2", unfit="expected a time series|an image has rows|points of R.4, expected"
                       "|found more than 13|for images only, found points"),
        "--channel": Row("--channel", "red", variant="colour", unfit="no channel"),
        "--raw-shape": Row("--raw-shape", "5,4", unfit="for shape|found raw"),
        "--raw-points": Row("--raw-points", "2", unfit="found raw|truncated point|NaN|infinite|too few values"
                            "|takes no separate values|for images only"),
        "--raw-type": Row("--raw-type", "int16", unfit="for shape|found raw|truncated point|double cannot hold|NaN"),
        "--raw-skip": Row("--raw-skip", "2", unfit="for shape|found raw|truncated point"),
        "--stack": Row("--stack", unfit="expected a folder of pictures"),
        "--weld": Row("--weld", variant="split", sign="joined with another one"),
        "--complex": Row("--complex", "cubical", unfit=IMAGE, alike=("alpha", "delaunay-cech")),
        "--threshold": Row("--threshold", "0.9"),
        "--metric": Row("--metric", "manhattan", unfit=POINTS),
        "--construction": Row("--construction", "cells", unfit=IMAGE, lost="read as an image"),
        "--superlevel": Row("--superlevel", unfit=IMAGE),
        "--periodic": Row("--periodic", "all", unfit=IMAGE),
        "--slab-layers": Row("--slab-layers", "1", sign="slabs of 1 layer", unfit=IMAGE),
        "--voxel": Row("--voxel", "0.4", unfit=POINTS),
        "--voxel-value": Row("--voxel-value", "density", unfit=POINTS),
        "--collapse": Row("--collapse", "on", sign=r"collapse {} \(requested\)", unfit=POINTS),
        "--device": Row("--device", "gpu", unfit=POINTS + "|expected components|not built in"),
        "--subsample": Row("--subsample", "6", unfit=POINTS + "|no sample"),
        "--subsample-radius": Row("--subsample-radius", "0.5", unfit=POINTS + "|no sample"),
        "--approximate": Row("--approximate", "0.5", sign="too late by a factor", unfit=POINTS + "|no approximation"),
        "--vertex-weights": Row("--vertex-weights", "weights.txt", unfit="weights.txt|" + POINTS),
        "--dtm": Row("--dtm", "3", unfit=POINTS),
        "--core": Row("--core", "3", unfit=POINTS),
        "--weight-exponent": Row("--weight-exponent", "2"),
        "--weights": Row("--weights", "weights.txt", unfit="weights.txt|" + POINTS),
        "--period": Row("--period", "3"),
        "--alpha-shape": Row("--alpha-shape", "0.5=x.ply"),
        "--wrap": Row("--wrap", "0.5=x.off"),
        "--max-dim": Row("--max-dim", "0"),
        "--field": Row("--field", "3", beside=["--output-format", "json"]),
        "--engine": Row("--engine", "standard", sign="engine {}: requested"),
        "--check": Row("--check", sign="check: the reference engine agrees"),
        "--min-persistence": Row("--min-persistence", "1e9"),
        "--representatives": Row("--representatives", "cycles", beside=["--output-format", "json"]),
        "--loops": Row("--loops", "none", beside=LOOPS),
        "--significance": Row("--significance", unfit=POINTS),
        "--part": Row("--part", "1/2", unfit=IMAGE),
        "--join": Row("--join", unfit='begin with "ph part"'),
        "--output": Row("--output", "x.csv"),
        "--output-format": Row("--output-format", "json"),
        "--plot": Row("--plot", "x.svg"),
        "--plot-kind": Row("--plot-kind", "betti", beside=plot),
        "--dims": Row("--dims", "9"),
        "--title": Row("--title", "Loops", beside=plot),
        "--size": Row("--size", "300x200", beside=plot),
        "--axis": Row("--axis", "0.25,0.5", beside=plot),
        "--report": Row("--report", "x.html"),
        "--compare": Row("--compare", "bars.csv", "bars.csv"),
        "--threads": Row("--threads", "1", sign="threads 1"),
        "--memory-limit": Row("--memory-limit", "300MiB", sign="memory limit 300 MiB"),
        "--progress": Row("--progress", "json", sign="progress {}"),
        "--quiet": Row("--quiet", lost="ph-barcode: "),
        "--verbose": Row("--verbose", sign="memory limit"),
        "--force": Row("--force", beside=["-o", "@input", "--output-format", "csv"]),
    }


def png(width, samples, colour=files.GREY):
    size = width * (4 if colour == files.RGBA else 1)
    rows = [bytes(samples[k:k + size]) for k in range(0, len(samples), size)]
    return files.png(width, len(rows), 8, colour, rows)


def text(table):
    return "".join(" ".join(map(repr, row)) + "\n" for row in table).encode()


def square(distance, size):
    return [[distance(i, j) for j in range(size)] for i in range(size)]


def said_of(program):
    return subprocess.run([program, "--version", "--verbose"], check=True, text=True,
                          stdout=subprocess.PIPE).stdout


def parts_of(program, floats):
    """The two part files of an image. The bars in these files have cells."""
    parts = {}
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "i.npy"), "wb") as file:
            file.write(files.array((5, 6), floats))
        for number, name in enumerate(("a.ph", "b.ph"), 1):
            subprocess.run([program, "i.npy", "--part", f"{number}/2", "-o", name, "--keep-cells",
                            "--quiet"], cwd=folder, check=True)
            with open(os.path.join(folder, name), "rb") as file:
                parts[name] = file.read()
    return parts


def inputs(Input, program):
    random.seed(5)
    size = 14
    points = [(math.cos(2 * math.pi * k / size) + random.gauss(0, 0.05),
               math.sin(2 * math.pi * k / size) + random.gauss(0, 0.05)) for k in range(size)]
    with_nan = [(math.nan, 0.5), *points[1:]]
    flat = [x for point in points for x in point]

    def length(i, j):
        return math.dist(points[i], points[j])

    matrix = square(length, size)
    asymmetric = [[d if (i < j) == ((i + j) % 2 == 0) else 1.5 * d for j, d in enumerate(row)]
                  for i, row in enumerate(matrix)]
    births = [[0.3 if i == j else d for j, d in enumerate(row)] for i, row in enumerate(matrix)]
    correlation = [[1 - d / 4 for d in row] for row in matrix]
    holes = [[math.nan if {i, j} == {0, 1} else d for j, d in enumerate(row)]
             for i, row in enumerate(matrix)]

    def lower(table):
        return text(row[:i] for i, row in enumerate(table) if i)

    def upper(table):
        return text(row[i + 1:] for i, row in enumerate(table) if i + 1 < size)

    pairs = [(i, j, length(i, j)) for i in range(size) for j in range(i)]
    grey = [random.randrange(10) for _ in range(30)]
    grey[7] = 200  # a byte whose high bit is set
    many = [random.randrange(256) for _ in range(4 * 30)]
    floats = [value + 0.25 for value in grey]
    one_nan = [math.nan, *floats[1:]]
    volume = [random.randrange(10) + 0.5 for _ in range(27)]

    weights = "\n".join(["0.25"] * size).encode()
    beside = {"weights.txt": weights, "values.txt": b"1\n2\n", "bars.csv": b"dim,birth,death\n0,0,1\n"}
    found = []

    def add(name, arguments, files, threshold=None, values=None, **others):
        given = {}
        row = rows_of()
        if threshold is not None:
            given["--threshold"] = row("--threshold", str(threshold))
        if threshold is not None and name not in LISTED:  # the input is an image
            given["--complex"] = row("--complex", "rips", unfit=POINTS, lost="read as an image")
        # With these options, the format is not reported.
        if {"--format", "--raw-shape", "--raw-points"} & set(arguments):
            given["--quiet"] = row("--quiet", lost="ph-barcode: ",
                                   beside=["-o", "x.csv", "--output-format", "none"])
        if name in RIPS:
            given["--weight-exponent"] = row("--weight-exponent", "2",
                                             beside=["--vertex-weights", "weights.txt"])
        given.update({option: row(*how[0], **how[1]) for option, how in others.pop("rows", {}).items()})
        extra = dict(beside)
        if values:
            extra["values.txt"] = "\n".join(map(str, values)).encode()
        found.append(Input(name, arguments, {**files, **extra}, rows=given, **others))

    def rows_of():
        import option_inputs
        return option_inputs.Row

    add("points", ["p.csv"], {"p.csv": text(points)}, nan=text(with_nan), empty=b"# none\n")
    add("points.gz", ["packed.txt"], {"packed.txt": gzip.compress(text(points))},
        nan=gzip.compress(text(with_nan)))
    add("XYZ", ["p.xyz"], {"p.xyz": text((*p, 0.0) for p in points)},
        rows={"--nan": (("--nan", "error"), {"variant": "nan"})},
        nan=text([(math.nan, 0.0, 0.0), *((*p, 0.0) for p in points[1:])]))
    pcd = files.pcd_header(width=size)
    add("PCD", ["p.pcd"], {"p.pcd": pcd + text((*p, 0.0) for p in points)},
        rows={"--nan": (("--nan", "error"), {"variant": "nan"})},
        nan=pcd + text([(math.nan, 0.0, 0.0), *((*p, 0.0) for p in points[1:])]))
    add("NPY points", ["p.npy", "--complex", "rips"], {"p.npy": files.array((size, 2), flat)},
        rows={"--complex": (("--complex", "rips"), {"default": ["--complex", "cubical"]})},
        nan=files.array((size, 2), [math.nan, *flat[1:]]), empty=files.array((0, 2), []))
    add("voxels", ["p.csv", "--complex", "cubical", "--voxel", "0.25"], {"p.csv": text(points)},
        rows={"--complex": (("--complex", "explicit"), {}),
              "--threshold": (("--threshold", "0.1"), {})}, nan=text(with_nan))
    if "alpha complexes need it" in said_of(program):
        print("skipped: alpha complexes are not built in", file=sys.stderr)
    else:
        add("alpha", ["p.csv", "--complex", "alpha"], {"p.csv": text(points)}, nan=text(with_nan),
            empty=b"# none\n", rows={"--threshold": (("--threshold", "0.4"), {}),
                                     "--complex": (("--complex", "explicit"), {}),
                                     "--loops": (("--loops", "none"), {"beside": LOOPS})})
        add("alpha with weights", ["p.csv", "--complex", "alpha", "--weights", "weights.txt"],
            {"p.csv": text(points), "other.txt": "\n".join(map(str, range(size))).encode()},
            nan=text(with_nan),
            rows={"--threshold": (("--threshold", "-0.1"), {}),
                  "--complex": (("--complex", "explicit"), {}),
                  "--alpha-values": (("--alpha-values", "radius"), {}),
                  "--weights": (("--weights", "other.txt"), {})})
    for name, arguments, make in (
            ("matrix", ["m.txt", "--format", "distance"], text),
            ("NPY matrix", ["m.npy", "--format", "distance"],
             lambda table: files.array((size, size), [x for row in table for x in row])),
            ("DIPHA distances", ["m.dipha"],
             lambda table: files.dipha(7, size, *(x for row in table for x in row)))):
        file = arguments[0]
        add(name, arguments, {file: make(matrix)}, asymmetric=make(asymmetric), births=make(births),
            correlation=make(correlation), nan=make(holes))
    add("lower triangle", ["m.txt"], {"m.txt": lower(matrix)}, correlation=lower(correlation),
        nan=lower(holes))
    add("upper triangle", ["m.txt"], {"m.txt": upper(matrix)}, correlation=upper(correlation),
        nan=upper(holes))

    def packed(table):
        return struct.pack(f"<{size * (size - 1) // 2}f",
                           *(table[i][j] for i in range(size) for j in range(i)))
    add("binary triangle", ["m.bin"], {"m.bin": packed(matrix)}, correlation=packed(correlation),
        nan=packed(holes))
    add("sparse", ["m.sparse"], {"m.sparse": text(pairs)},
        nan=text([(1, 0, math.nan), *pairs[1:]]))
    def connections(distance):
        others = [[j for j in range(size) if j != i] for i in range(size)]
        return (files.dipha(8, size)
                + struct.pack(f"<{size}q", *map(len, others))
                + b"".join(struct.pack(f"<{size - 1}q", *row) for row in others)
                + b"".join(struct.pack(f"<{size - 1}d", *(distance(i, j) for j in row))
                           for i, row in enumerate(others)))
    add("DIPHA sparse distances", ["s.dipha"], {"s.dipha": connections(length)},
        nan=connections(lambda i, j: math.nan if {i, j} == {0, 1} else length(i, j)))
    add("NPY image", ["i.npy"], {"i.npy": files.array((5, 6), floats)}, 4, nan=files.array((5, 6), one_nan))
    add("NPY whole numbers", ["i.npy"], {"i.npy": files.array((5, 6), grey, "|u1")}, 4)
    add("NPY volume", ["v.npy"], {"v.npy": files.array((3, 3, 2), volume[:18])}, 4,
        nan=files.array((3, 3, 2), [math.nan, *volume[1:18]]))
    # With one axis, both constructions have the same bars, and only a periodic axis has a loop.
    add("NPY series", ["s.npy"], {"s.npy": files.array((30,), floats)}, 4, nan=files.array((30,), one_nan),
        rows={"--loops": (("--loops", "none"), {"beside": [*LOOPS, "--periodic", "all"]}),
              "--max-dim": (("--max-dim", "0"), {"beside": ["--periodic", "all"]}),
              "--min-dim": (("--min-dim", "1"), {"beside": ["--periodic", "all"]})})
    add("NPZ image", ["i.npz"], {"i.npz": files.npz({"image.npy": files.array((5, 6), floats)})}, 4, nan=files.npz({"image.npy": files.array((5, 6), one_nan)}))
    add("PNG", ["i.png"], {"i.png": png(6, grey)}, 4)
    add("PNG in colours", ["i.png", "--channel", "green"], {"i.png": png(6, many, files.RGBA)}, 40,
        rows={"--channel": (("--channel", "red"), {})})
    add("PGM", ["i.pgm"], {"i.pgm": b"P2\n6 5\n255\n" + " ".join(map(str, grey)).encode()}, 4)
    add("NIfTI", ["v.nii"], {"v.nii": files.nifti("<f4", (3, 3, 3), volume)}, 4,
        nan=files.nifti("<f4", (3, 3, 3), [math.nan, *volume[1:]]))
    add("NRRD", ["v.nrrd"], {"v.nrrd": files.nrrd("<f4", (3, 3, 3), volume)}, 4,
        nan=files.nrrd("<f4", (3, 3, 3), [math.nan, *volume[1:]]))
    add("MetaImage", ["v.mha"], {"v.mha": files.meta_image("<f4", (3, 3, 3), volume)}, 4,
        nan=files.meta_image("<f4", (3, 3, 3), [math.nan, *volume[1:]]))
    add("VTI", ["v.vti"], {"v.vti": files.vti("<f4", (3, 3, 3), volume)}, 4,
        nan=files.vti("<f4", (3, 3, 3), [math.nan, *volume[1:]]))
    slices = [tiff_files.page("<f4", (3, 3), volume[k:k + 9]) for k in (0, 9, 18)]
    nan_slices = [tiff_files.page("<f4", (3, 3), [math.nan, *volume[1:9]]), *slices[1:]]
    add("TIFF", ["v.tif"], {"v.tif": tiff_files.tiff(slices)}, 4, nan=tiff_files.tiff(nan_slices))
    add("TIFF in colours", ["i.tif", "--channel", "green"],
        {"i.tif": tiff_files.tiff([tiff_files.page("|u1", (5, 6), many, t262=2)])}, 40,
        rows={"--channel": (("--channel", "red"), {})})
    words = struct.pack("<20H", *(random.randrange(60000) for _ in range(20)))
    add("raw", ["i.raw", "--raw-shape", "4,5", "--raw-type", "uint16"], {"i.raw": words}, 30000)
    add("raw points", ["p.bin", "--raw-points", "2", "--raw-type", "float64"],
        {"p.bin": struct.pack(f"<{2 * size}d", *flat)},
        nan=struct.pack(f"<{2 * size}d", math.nan, *flat[1:]), empty=b"")
    add("Perseus", ["i.perseus"],
        {"i.perseus": ("2\n6\n5\n" + "\n".join(map(str, floats)) + "\n").encode()}, 4,
        rows={"--construction": (("--construction", "cells"), {})})
    add("DIPHA image", ["i.dipha"], {"i.dipha": files.dipha_image((6, 5), floats)}, 4,
        nan=files.dipha_image((6, 5), one_nan))
    # A triangle that is filled late, next to a triangle that is never filled.
    simplices = (b"0 : 0\n1 : 0.25\n2 : 0\n0 1 : 1\n1 2 : 2\n0 2 : 3\n0 1 2 : 4\n3 : 0\n2 3 : 2\n4 : 0\n"
                 b"3 4 : 2.5\n2 4 : 2.75\n")
    add("simplices", ["t.simplices"], {"t.simplices": simplices}, values=[3, 1, 4, 2, 5],
        rows={"--complex": (("--complex", "lower-star"), {})})
    add("lower star", ["t.simplices", "--complex", "lower-star", "--values", "values.txt"], {"t.simplices": simplices}, 3.5,
        values=[3, 1, 4, 2, 5], rows={"--complex": (("--complex", "rips"), {}),
                                   "--min-dim": (("--min-dim", "1"), {})})
    phat = b"0\n0\n0\n1 0 1\n1 1 2\n1 0 2\n2 3 4 5\n"
    add("PHAT", ["b.phat"], {"b.phat": phat}, 5.5, values=[0, 0, 0, 1, 2, 3, 5],
        rows={"--format": (("--format", "simplices"), {"unfit": "simplex|plain text", "choices": ()}),
              "--loops": (("--loops", "plain"), {"beside": LOOPS}),
              "--complex": (("--complex", "rips"), {})})
    add("DIPHA boundaries", ["b.dipha"],
        {"b.dipha": files.dipha(0, 0, 7, 2)
         + struct.pack("<7q", 0, 0, 0, 1, 1, 1, 2)
         + struct.pack("<7d", 0, 0, 0, 1, 2, 3, 5)
         + struct.pack("<8q", 0, 0, 0, 0, 2, 4, 6, 9)
         + struct.pack("<9q", 0, 1, 1, 2, 0, 2, 3, 4, 5)}, 2.5, values=[0, 0, 0, 1, 2, 3, 6],
        rows={"--format": (("--format", "simplices"), {"unfit": "simplex|plain text", "choices": ()}),
              "--loops": (("--loops", "plain"), {"beside": LOOPS}),
              "--complex": (("--complex", "rips"), {})})
    corners = [*((x, y, 0.0) for x, y in points)]
    faces = "".join(f"3 {k} {(k + 1) % size} {(k + 2) % size}\n" for k in range(size)).encode()
    off = f"OFF\n{size} {size} 0\n".encode() + text(corners) + faces
    heights = [random.randrange(9) for _ in range(size)]
    # The first and the last vertex are at one position and have one value.
    heights[-1] = heights[0]
    split = text([*corners[:-1], corners[0]])
    add("OFF mesh", ["m.off"], {"m.off": off}, values=heights)
    add("OFF mesh with values", ["m.off", "--values", "values.txt"], {"m.off": off}, 4, values=heights,
        split=f"OFF\n{size} {size} 0\n".encode() + split + faces, rows={"--complex": (("--complex", "rips"), {})})
    ply = (f"ply\nformat ascii 1.0\nelement vertex {size}\nproperty float x\nproperty float y\n"
           f"property float z\nelement face {size}\nproperty list uchar int vertex_indices\nend_header\n")
    add("PLY mesh with values", ["m.ply", "--values", "values.txt"],
        {"m.ply": ply.encode() + text(corners) + faces}, 4, values=heights,
        split=ply.encode() + split + faces,
        rows={"--complex": (("--complex", "rips"), {})})
    looks = {"--plot-kind": (("--plot-kind", "betti"), {}), "--dims": (("--dims", "1"), {}),
             "--title": (("--title", "Loops"), {}), "--size": (("--size", "300x200"), {}),
             "--axis": (("--axis", "-3,-1"), {})}
    add("points, dry run", ["p.csv", "--dry-run"], {"p.csv": text(points)}, nan=text(with_nan))
    add("points, nothing but a plot", ["p.csv", "--output-format", "none", "--plot", "y.svg"],
        {"p.csv": text(points)}, nan=text(with_nan),
        rows={**looks, "--axis": (("--axis", "0.25,0.5"), {})})
    add("points, plot of the tree", ["p.csv", "--plot-kind", "tree", "--plot", "y.svg"],
        {"p.csv": text(points)}, nan=text(with_nan),
        rows={**looks, "--axis": (("--axis", "0.25,0.5"), {})})
    add("superlevel plot", ["i.npy", "--superlevel", "--plot", "y.svg"],
        {"i.npy": files.array((5, 6), floats)}, -4, nan=files.array((5, 6), one_nan), rows=looks)
    bars = b"dim,birth,death\n0,0,1\n0,0,inf\n1,0.3,0.75\n"
    alone = {"--loops": (("--loops", "none"), {})}
    add("a barcode", ["b.csv"], {"b.csv": bars}, rows=alone)
    add("plot a barcode", ["plot", "b.npy", "-o", "y.svg"],
        {"b.npy": files.array((2, 3), [0, 0, 1, 1, 0.3, 0.75])},
        rows={**alone, "--force": (("--force",), {"sign": "--force: not needed"}),
              "--output": (("--output", "x.svg"), {}),
              "--field": (("--field", "3"), {}),
              "--representatives": (("--representatives", "cycles"), {}),
              "--plot-kind": (("--plot-kind", "betti"), {}), "--dims": (("--dims", "9"), {}),
              "--title": (("--title", "Loops"), {}), "--size": (("--size", "300x200"), {}),
              "--axis": (("--axis", "0.25,0.5"), {})})
    add("two barcodes", ["--compare", "b.csv", "bars.csv"], {"b.csv": bars},
        rows={**alone, "--compare": (("--compare", "bars.csv", "bars.csv"), {}),
              "--plot-kind": (("--plot-kind", "betti"), {}), "--dims": (("--dims", "9"), {}),
              "--title": (("--title", "Loops"), {}), "--size": (("--size", "300x200"), {}),
              "--axis": (("--axis", "0.25,0.5"), {})})
    # The options of runs with --part. Such a run writes neither other formats nor pictures.
    of_part = {option: ((option, value) if value else (option,), {}) for option, value in (
        ("--part", "2/2"), ("--output", "x.ph"), ("--field", "3"), ("--representatives", "cycles"),
        ("--loops", "none"), ("--plot-kind", "betti"), ("--title", "Loops"), ("--size", "300x200"),
        ("--axis", "0.25,0.5"), ("--dims", "9"))}
    of_part["--complex"] = (("--complex", "rips"), {"default": ["--complex", "cubical"]})
    of_part["--force"] = (("--force",), {"beside": ["-o", "@input"]})
    add("a part of an image", ["i.npy", "--part", "1/2", "-o", "y.ph"],
        {"i.npy": files.array((5, 6), floats)}, 4, nan=files.array((5, 6), one_nan), rows=of_part)
    of_cloud = {**of_part, "--complex": (("--complex", "rips"), {}),
                "--max-dim": (("--max-dim", "0"), {}), "--threshold": (("--threshold", "0.3"), {})}
    add("a part of a cloud", ["p.csv", *H0, "--part", "1/2", "-o", "y.ph"],
        {"p.csv": text(points)}, nan=text(with_nan), rows=of_cloud)
    add("a part of a folder", ["in", "--part", "1/2", "-o", "y.ph"],
        {"in/a.csv": text(points), "in/b.csv": text(points)}, rows=of_part)
    add("parts", ["--join", "a.ph", "b.ph", "-o", "y.csv"], parts_of(program, floats),
        rows={"--output": (("--output", "x.csv"), {}), "--loops": (("--loops", "none"), {})})
    add("a folder", ["in", "-o", "out/"], {"in/a.csv": text(points), "in/b.csv": text(points)},
        nan=text(with_nan),
        rows={"--force": (("--force",), {"sign": "--force: not needed"}),
              "--output": (("--output", "new/"), {}), "--plot": (("--plot", "p/"), {}),
              "--report": (("--report", "r/"), {}),
              "--output-format": (("--output-format", "json"), {}),
              **{option: ((option, value), {"beside": ["--plot", "p/"]}) for option, value in (
                  ("--plot-kind", "betti"), ("--dims", "9"), ("--title", "Loops"),
                  ("--size", "300x200"), ("--axis", "0.25,0.5"))}})
    return found
