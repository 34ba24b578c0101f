# SPDX-License-Identifier: MIT
"""Rows 73 and 74: options of alpha complexes, and points that are hard for a Delaunay
triangulation. The values are computed by hand."""
from entry import Entry, bars

SQUARE = b"0 0\n1 0\n0 1\n1 1\n"
ALPHA = ("--complex", "alpha")
LINE = bars("0,0,0.5", "0,0,0.5", "0,0,inf")


def of(row, name, points, options, code, message="", named="points.txt", output=None, **files):
    content = {"points.txt": points, **{file.replace("_", "."): text for file, text in files.items()}}
    return Entry(row, name, "ph-barcode", ("points.txt", *ALPHA, *options, *(("--quiet",) if code == 0 else ())),
                 code, message, named, content, output)


def weighted(name, weights, message="", code=65):
    return of(73, f"weights: {name}", SQUARE, ("--weights", "weights.txt"), code, message, "weights.txt",
              weights_txt=weights)


def entries():
    yield weighted("too few", b"0 0 0\n", "4")
    yield weighted("too many", b"0\n0\n0\n0\n0\n", ":5:1: ")
    yield weighted("NaN", b"0 0 nan 0\n", ":1:5: ")
    yield weighted("infinite", b"0 0 inf 0\n", "found inf for point 2")
    yield weighted("words", b"0 0 x 0\n", ":1:5: ")
    yield weighted("nothing", b"", "found 0, expected 4")
    yield of(73, "weights: beyond what squares hold", SQUARE, ("--weights", "weights.txt"), 65, "2.512",
             weights_txt=b"1e308\n0\n0\n0\n")
    for option, words in (("--period", ("-1", "nan", "inf", "x", "1,1,1", "1,", "")),
                          ("--threshold", ("-1", "nan")),
                          ("--alpha-values", ("diameter", "")),
                          ("--alpha-shape", ("x.ply", "1=", "nan=x.ply", "=x.ply", "1=x.png", "-1")),
                          ("--wrap", ("x=x.off",))):
        for word in words:
            yield of(73, f"{option} {word!r}", SQUARE, (f"{option}={word}",), 64, "found|missing", option)
    for name, options, named in (
            ("weights of Delaunay-Cech complexes",
             ("--weights", "points.txt", "--complex", "delaunay-cech"), "--weights"),
            ("a period of Delaunay-Rips complexes", ("--period", "1", "--complex", "delaunay-rips"), "--period"),
            ("a metric", ("--metric", "manhattan"), "--metric"),
            ("a subsample", ("--subsample", "2"), "--subsample"),
            ("weights as of Rips complexes", ("--vertex-weights", "points.txt"), "--vertex-weights"),
            ("the measure of Rips complexes", ("--dtm", "2"), "--dtm"),
            ("core distances", ("--core", "1"), "--core"),
            ("an engine of Rips complexes", ("--engine", "edge-links"), "engine"),
            ("an axis of an image", ("--periodic", "0"), "--periodic"),
            ("a shape of a periodic space", ("--period", "2", "--alpha-shape", "1=x.ply"), "--alpha-shape")):
        arguments = ("points.txt", *(() if "--complex" in options else ALPHA), *options)
        yield Entry(73, name, "ph-barcode", arguments, 64, "found|cannot", named, {"points.txt": SQUARE})
    yield of(74, "four coordinates", b"0 0 0 0\n1 1 1 1\n", (), 64, "found points of R.4", "--complex")
    yield of(74, "NaN", b"0 0\n1 nan\n", (), 65, ":2:3: ")
    yield of(74, "infinity", b"0 0\n1 inf\n", (), 65, ":2:3: ")
    yield of(74, "distances", b"0 1\n1 0\n", ("--format", "distance"), 64, "found alpha", "--complex")
    yield of(74, "nothing", b"", (), 65, "no points")
    yield of(74, "nothing, and that is fine", b"", ("--allow-empty",), 0, output=bars())
    # Points on the line x = y = z, equal points, and points of a line distorted by rounding.
    yield of(74, "collinear in space", b"0 0 0\n1 0 0\n2 0 0\n", (), 0, output=LINE)
    yield of(74, "collinear in the plane", b"0 0\n0 1\n0 2\n", (), 0, output=LINE)
    yield of(74, "on a line alone", b"0\n1\n2\n", ("--format", "points"), 0, output=LINE)
    yield of(74, "all equal", b"1 2 3\n" * 50, (), 0, output=bars("0,0,inf"))
    yield of(74, "two of each", b"0 0\n1 0\n2 0\n" * 2, (), 0, output=LINE)
    yield of(74, "a square: four on a circle", SQUARE, (), 0,
             output=bars("0,0,0.5", "0,0,0.5", "0,0,0.5", "0,0,inf", "1,0.5,0.7071067811865476"))
    yield of(74, "a cube: eight on a sphere",
             b"".join(b"%d %d %d\n" % (a, b, c) for a in (0, 2) for b in (0, 2) for c in (0, 2)), (), 0,
             output=bars(*["0,0,1"] * 7, "0,0,inf", *["1,1,1.4142135623730951"] * 5,
                         "2,1.4142135623730951,1.7320508075688772"))
    yield of(74, "two points as far apart as doubles are", b"-1e308 0\n1e308 0\n", (), 0,
             output=bars("0,0,1e+308", "0,0,inf"))
    yield of(74, "two points as near as doubles are", b"0 0\n5e-324 0\n", (), 0)
    yield of(74, "a point far from a cluster", b"0 0\n1e-300 0\n0 1e-300\n1e300 0\n", (), 65,
             "point 1: found 1e-300 in data with numbers as large as 2.997")
    yield of(74, "points that only their last bits tell apart",
             b"1 0\n1.0000000000000002 0\n1.0000000000000004 0\n", (), 0,
             output=bars("0,0,1.1102230246251565e-16", "0,0,1.1102230246251565e-16", "0,0,inf"))


ENTRIES = list(entries())
