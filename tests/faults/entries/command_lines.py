# SPDX-License-Identifier: MIT
"""Rows 47 to 50: meaningless command lines. The error message names the option."""
from entry import Entry, bars, sample
from characters import SQUARE, SQUARE_BARS

SQUARE_FILE = {"square.txt": SQUARE.encode()}
CLOUD = {"cloud.xyz": b"0 0 1\n1 0 1\n"}

# row, arguments, part of the message
BARCODE = [
    (47, ["--max-dim", "-1"], "--max-dim"),
    (47, ["--max-dim=-1"], "--max-dim"),
    (47, ["--max-dim", "-9223372036854775809"], "--max-dim"),
    (49, ["--max-dim", "1.5"], "--max-dim"),
    (49, ["--max-dim", "x"], "--max-dim"),
    (49, ["--max-dim", "99999999999999999999"], "--max-dim"),
    (50, ["--max-dim"], "--max-dim"),
    (50, ["--max-dim="], "--max-dim"),
    (50, ["--max-dim", "1", "--max-dim", "2"], "--max-dim"),
    (49, ["--threshold", "nan"], "--threshold"),
    (49, ["--threshold", "1,5"], "decimals"),
    (49, ["--threshold=-1"], "--threshold"),
    (49, ["--threshold", "1e400"], "--threshold"),
    (49, ["--threshold", ""], "--threshold"),
    (50, ["--max-scale"], "--max-scale"),
    (49, ["--field", "4"], "--field"),
    (49, ["--field", "1"], "--field"),
    (49, ["--field", "-3"], "--field"),
    (49, ["--field", "2147483648"], "--field"),
    (49, ["--modulus", "0x2"], "--field"),
    (49, ["--metric", "euclid"], "did you mean 'euclidean'"),
    (49, ["--metric", "minkowski"], "minkowski:P"),
    (49, ["--metric", "minkowski:0.5"], "--metric"),
    (49, ["--metric", "minkowski:nan"], "--metric"),
    (49, ["--engine", "cohomolgy"], "did you mean 'cohomology'"),
    (49, ["--engine", "fastest"], "--engine"),
    (49, ["--format", "lowerdistance"], "did you mean 'lower-distance'"),
    (49, ["--complex", "ribs"], "did you mean 'rips'"),
    (49, ["--complex", "cubical"], "--complex"),
    (49, ["--complex", "explicit"], "--complex"),
    (49, ["--construction", "cells"], "--construction"),
    (49, ["--superlevel"], "--superlevel"),
    (49, ["--periodic", "0"], "--periodic"),
    (49, ["--periodic", "z"], "--periodic"),
    (49, ["--periodic", "0,,1"], "--periodic"),
    (49, ["--symmetrise", "mean"], "--symmetrise"),
    (49, ["--nan", "ignore"], "--nan"),
    (49, ["--min-persistence", "nan"], "--min-persistence"),
    (49, ["--representatives", "cycle"], "did you mean 'cycles'"),
    (49, ["--representatives", "cocycles"], "--output-format json"),
    (49, ["--representatives", "voxels", "--output-format", "json"], "sets of voxels need an image"),
    (49, ["--representatives", "cocycles", "-o", "x.csv"], "found output format csv"),
    *((49, ["--representatives", "cycles", "--output-format", name], "found output format " + name)
      for name in ("ripser", "pers", "dipha", "npy", "none")),
    *((49, ["--representatives", "cycles", "--output-format", "json", "--max-dim", "0", "--engine",
            name], "--engine: found " + name) for name in ("standard",)),
    (49, ["--min-dim", "2"], "--min-dim: found 2, expected at most 1"),
    (49, ["--collapse", "maybe"], "--collapse"),
    (49, ["--device", "cuda"], "--device"),
    (49, ["--device", "gpu", "--max-dim", "1"], "device gpu"),
    (49, ["--collapse", "on", "--min-persistence=-1"], "--collapse"),
    (49, ["--collapse", "on", "--representatives", "cocycles", "--output-format", "json"],
     "--collapse"),
    (49, ["--subsample", "0"], "--subsample"),
    (49, ["--subsample", "-1"], "--subsample"),
    (49, ["--subsample", "1.5"], "--subsample"),
    (50, ["--subsample"], "--subsample"),
    (49, ["--subsample-radius", "nan"], "--subsample-radius"),
    (49, ["--subsample-radius", "-1"], "--subsample-radius"),
    *((49, ["--approximate", epsilon], "--approximate") for epsilon in ("-1", "0", "inf", "x")),
    (49, ["--dtm", "0"], "--dtm"),
    (49, ["--dtm", "5"], "at most the number of points, 4"),
    (49, ["--core", "-1"], "--core"),
    (49, ["--core", "4"], "at most the number of other points, 3"),
    (49, ["--core", "2", "--dtm", "2"], "cannot be combined with --core"),
    (49, ["--core", "2", "--subsample", "3"], "cannot be combined with --subsample"),
    (49, ["--weight-exponent", "3"], "--weight-exponent"),
    (49, ["--weight-exponent", "2"], "needs --dtm, --core or --vertex-weights"),
    (49, ["--diagonal", "birth"], "did you mean 'births'"),
    (49, ["--diagonal", "births"], "--format distance"),
    (49, ["--vertex-weights", ""], "--vertex-weights"),
    (49, ["--vertex-weights", "square.txt", "--dtm", "2"], "cannot be combined with --dtm"),
    (49, ["--dtm", "2", "--subsample", "3"], "cannot be combined with --subsample"),
    (49, ["--dtm", "2", "--approximate", "1"], "cannot be combined with --approximate"),
    (49, ["--output-format", "cvs"], "did you mean 'csv'"),
    (49, ["--plot", "x.pdf"], "--plot"),
    (49, ["--plot", "x.svg", "--plot-kind", "betty"], "did you mean 'betti'"),
    (49, ["--plot-kind", "betti"], "--plot-kind"),
    (49, ["--plot", "x.svg", "--plot", "x.svg"], "found 'x.svg' twice"),
    (49, ["--memory-limit", "4XB"], "--memory-limit"),
    (49, ["--memory-limit", "-4GiB"], "--memory-limit"),
    (49, ["--memory-limit", "0"], "--memory-limit"),
    (49, ["--memory-limit", "1e30"], "--memory-limit"),
    (49, ["--threads", "0"], "--threads"),
    (49, ["--threads", "5000"], "--threads"),
    (49, ["--progress", "fancy"], "--progress"),
    (49, ["--values", "square.txt"], "values"),
    (50, ["--treshold", "2"], "did you mean '--threshold'"),
    (50, ["--max-dims=2"], "did you mean '--max-dim'"),
    (50, ["-max-dim", "2"], "did you mean '--max-dim'"),
    (50, ["--dim", "2"], "did you mean '--max-dim'"),
    (50, ["--maxdim", "2"], "did you mean '--max-dim'"),
    (50, ["--no-such-thing-at-all"], "--no-such-thing-at-all"),
    (50, ["--plot-title", "x"], "did you mean '--title'"),
    (50, ["--plot-range", "x"], "'--plot-range'; --help all lists the options"),
    (49, ["--quiet", "--verbose"], "--quiet: cannot be combined with --verbose"),
    (49, ["--plot", "x.svg", "--size", "10"], "--size"),
    (49, ["--plot", "x.svg", "--axis", "2,1"], "--axis"),
    (49, ["--compare", "square.txt", "square.txt"], "--compare"),
    (50, ["--quiet=perhaps"], "--quiet"),
    (50, ["-o", ""], "--output"),
    (50, ["square.txt"], "-o FOLDER/"),
    (50, [""], "INPUT"),
]

BARCODE_FILES = [
    # row, file, content, arguments, part of the message
    (49, "edge.phat", b"0\n0\n1 0 1\n", ["--field", "3"], "--field"),
    (49, "lower.txt", b"1\n3 2\n", ["--format", "lower-distance", "--metric", "manhattan"],
     "--metric"),
    (49, "edge.phat", b"0\n0\n1 0 1\n", ["--collapse", "on"], "--collapse"),
    (49, "lower.txt", b"1\n3 2\n", ["--format", "lower-distance", "--representatives", "cycles"],
     "expected points with coordinates, or json"),
    *((49, "image.pgm", b"P2\n2 1\n9\n1 2\n", options, "points and distance")
      for options in (["--collapse", "on"], ["--subsample", "2"], ["--approximate", "1"],
                      ["--dtm", "2"], ["--core", "1"], ["--vertex-weights", "image.pgm"])),
    *((49, "image.pgm", b"P2\n2 1\n9\n1 2\n", options, "found an image")
      for options in (["--diagonal", "births"], ["--diagonal", "zero"], ["--from-correlation"],
                      ["--symmetrise", "max"], ["--metric", "euclidean"], ["--collapse", "auto"])),
    (49, "p.txt", b"0 0\n1 0\n0 1\n", ["--from-correlation", "--format", "points"], "found points"),
    (49, "p.txt", b"0 0\n1 0\n0 1\n", ["--symmetrise", "max", "--format", "points"], "found points"),
    (49, "i.raw", b"1234", ["--raw-shape", "2,2", "--raw-big-endian"], "--raw-big-endian"),
    *((49, "sparse.txt", b"0 1 1\n", ["--format", "sparse", *options], "found some distances only")
      for options in (["--subsample", "2"], ["--approximate", "1"], ["--dtm", "2"],
                      ["--core", "1"], ["--diagonal", "births"])),
    (49, "lower.txt", b"1\n", ["--format", "lower-distance", "--diagonal", "births"],
     "full distance matrices"),
    (49, "full.txt", b"1 1\n1 1\n",
     ["--format", "distance", "--diagonal", "births", "--from-correlation"], "cannot be combined"),
]

# name, content, part of the message; there are four points
WEIGHTS = [
    ("too few", b"0 0 1\n", "too few values.*4, one per point"),
    ("too many", b"0\n0\n0\n0\n0\n", ":5:1: too many values"),
    ("negative", b"0 0 -1 0\n", "-1 for point 2"),
    ("infinite", b"0 0 0 inf\n", "inf for point 3"),
    ("NaN", b"0 nan 0 0\n", ":1:3: "),
    ("no number", b"0 x 0 0\n", ":1:3: "),
    ("nothing", b"", "weights.txt"),
]

FINE = [["--subsample", "4"], ["--subsample-radius", "0"], ["--dtm", "1"], ["--core", "0"],
        ["--collapse", "auto"], ["--collapse", "on"], ["--collapse", "off"], ["--representatives", "none"],
        ["--threads", "1"], ["--threads=2"], ["--memory-limit", "1GiB"], ["--memory-limit", "1e9"],
        ["--memory-limit", "500MB"], ["--threshold", "inf"], ["--progress", "none"],
        ["--field", "2147483647"], ["--min-persistence", "1e-3"]]

SEGMENT = [
    (49, ["--distance", "nan"], "--distance"),
    (49, ["--distance", "-1"], "--distance"),
    (49, ["--voxel", "0"], "--voxel"),
    (49, ["--voxel", "inf"], "--voxel"),
    (49, ["--steps", "0"], "--steps"),
    (49, ["--steps", "exactly"], "--steps"),
    (49, ["--min-size", "0"], "--min-size"),
    (49, ["--max-range", "-1"], "--max-range"),
    (49, ["--plane", "perhaps"], "--plane"),
    (49, ["--plane-distance", "0"], "--plane-distance"),
    (49, ["--crop", "0,1,0,1,0"], "--crop"),
    (49, ["--crop", "1,0,0,1,0,1"], "crop"),
    (49, ["--viewpoint", "0,0"], "--viewpoint"),
    (49, ["--viewpoint", "0,0,inf"], "viewpoint"),
    (49, ["--method", "papers"], "did you mean 'paper'"),
    (49, ["--depth", "d.png"], "found both INPUT and --depth"),
    (49, ["--intrinsics", "1,1,0,0"], "--intrinsics"),
    (49, ["--intrinsics", "1,1,0"], "--intrinsics"),
    (49, ["--intrinsics", "camera.yaml"], "--camera takes a file"),
    (49, ["--intrinsics", "kinect-v1"], "--camera takes a file or the name"),
    (49, ["--depth-scale", "0"], "--depth-scale"),
    (49, ["--depth-scale", "0.001"], "if a unit is 0.001 m, the scale is 1000"),
    (49, ["--labels", "x.txt"], "--labels"),
    (49, ["--labels", "x.png"], "unorganised"),
    (49, ["--picture", "x.png"], "unorganised"),
    (49, ["--picture", "x.jpg"], "--picture"),
    (49, ["--steps", "10"], "--method paper only"),
    (49, ["--method", "paper", "--min-part", "3"], "found --method paper"),
    (49, ["--plane", "off", "--plane-distance", "0.01"], "--plane on"),
    (49, ["--depth-scale", "inf"], "--depth-scale"),
    (49, ["--plot", "x.svg", "--plot-view", "1,2"], "--plot-kind cloud"),
    (49, ["--plot", "x.pdf"], "--plot"),
    (49, ["--barcode", "x.xlsx"], "--barcode"),
    (49, ["-o", "x.obj"], "found x.obj, expected a file name that ends in .pcd or .ply"),
    (50, ["--distance"], "--distance"),
    (50, ["--voxle", "0.1"], "did you mean '--voxel'"),
    (50, ["another.pcd"], "found 'out.pcd', expected a folder (FOLDER/) or a *"),
]

CLUSTER = [
    (49, ["--min-size", "1"], "--min-size"),
    (49, ["--min-size", "2.5"], "--min-size"),
    (49, ["--neighbours", "-1"], "--neighbours"),
    (49, ["--neighbours", "4"], "at most the number of other points, 3"),
    (49, ["--epsilon", "nan"], "--epsilon"),
    (49, ["--epsilon", "inf"], "--epsilon"),
    (49, ["--epsilon=-1"], "--epsilon"),
    (49, ["--max-size", "4"], "at least --min-size (5)"),
    (49, ["--max-size", "9", "--method", "leaf"], "found --method leaf"),
    (49, ["--method", "eon"], "did you mean 'eom'"),
    (49, ["--metric", "minkowski"], "minkowski:P"),
    (49, ["--format", "png"], "--format"),
    (49, ["--output-format", "ply"], "expected csv, json or npy"),
    (49, ["--tree", "x.txt"], "found x.txt, expected a file name that ends in .json or .csv"),
    (49, ["--raw-type", "int16"], "need --raw-points"),
    (49, ["--columns", "z"], "--columns"),
    (49, ["--diagonal", "births", "--neighbours", "2"], "cannot be combined with --diagonal births"),
    (50, ["--min-samples", "5"], "min_samples - 1"),
    (50, ["--min-cluster-size", "5"], "did you mean '--min-size'"),
    (50, ["--min-size"], "--min-size"),
    (50, ["--scores=perhaps"], "--scores"),
    (50, ["square.txt"], "found 2 inputs, expected one"),
    (57, ["--tree", "out.csv"], "also written by --output"),
]


def entries():
    for row, options, words in BARCODE:
        yield Entry(row, " ".join(options) or "nothing", "ph-barcode", ("square.txt", *options), 64,
                    ".", words, SQUARE_FILE)
    for row, file, content, options, words in BARCODE_FILES:
        yield Entry(row, f"{file} {' '.join(options)}", "ph-barcode", (file, *options), 64, ".", words,
                    {file: content})
    for row, options, words in SEGMENT:
        yield Entry(row, "ph-segment " + " ".join(options), "ph-segment", ("cloud.xyz", *options), 64,
                    ".", words, CLOUD)
    for row, options, words in CLUSTER:
        yield Entry(row, "ph-cluster " + " ".join(options), "ph-cluster", ("square.txt", *options), 64,
                    ".", words, SQUARE_FILE)
    yield Entry(49, "--intrinsics without a focal length", "ph-segment",
                ("--depth", "d.png", "--intrinsics", "0,1,0,0"), 64, "found focal lengths 0 and 1",
                "--intrinsics", {"d.png": sample("png", "depth.png")})
    for program in ("ph-barcode", "ph-segment", "ph-cluster"):
        yield Entry(50, f"{program} without input", program, (), 64, "INPUT", "INPUT")
    yield Entry(50, "--max-dim at the end", "ph-barcode", ("square.txt", "-o", "x.csv", "--max-dim"),
                64, "the value is missing", "--max-dim", SQUARE_FILE)
    yield Entry(49, "values of simplices that have some", "ph-barcode",
                ("edge.simplices", "--values", "values.txt"), 64, ".", "--values",
                {"edge.simplices": b"0 : 0\n1 : 0\n0 1 : 1\n", "values.txt": b"1\n2\n"})
    for name, content, words in WEIGHTS:
        yield Entry(49, f"weights: {name}", "ph-barcode",
                    ("square.txt", "--vertex-weights", "weights.txt"), 65, words, "weights.txt",
                    {**SQUARE_FILE, "weights.txt": content})
    yield Entry(54, "weights that are missing", "ph-barcode",
                ("square.txt", "--vertex-weights", "missing.txt"), 66, ".", "missing.txt", SQUARE_FILE)
    for options in FINE:
        yield Entry(49, " ".join(options) + " is fine", "ph-barcode", ("square.txt", *options), 0,
                    files=SQUARE_FILE, output=SQUARE_BARS)
    yield Entry(47, "0 is fine", "ph-barcode", ("square.txt", "--max-dim=0"), 0, files=SQUARE_FILE,
                output=bars("0,0,1", "0,0,1", "0,0,1.0307764064044151", "0,0,inf"))
    for dimension in ("2", "60", "1000000"):
        yield Entry(48, f"{dimension} is fine", "ph-barcode", ("square.txt", "--max-dim", dimension), 0,
                    files=SQUARE_FILE, output=SQUARE_BARS)
    yield Entry(48, "10^12", "ph-barcode", ("square.txt", "--max-dim", str(10 ** 12)), 64, ".",
                "--max-dim", SQUARE_FILE)


ENTRIES = list(entries())
