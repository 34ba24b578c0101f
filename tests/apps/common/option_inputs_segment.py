# SPDX-License-Identifier: MIT
"""The options of ph-segment and the kinds of input for option_inputs.py."""
import math
import os
import random
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import files  # noqa: E402

WIDTH, HEIGHT, FOCAL = 96, 72, 150
CAMERA = f"{FOCAL},{FOCAL},{WIDTH / 2},{HEIGHT / 2}"
RESULTS = ["--labels", "l-x.csv", "--barcode", "b-x.csv"]
OF_FRAMES = ["--labels", "l-*.csv", "--barcode", "b-*.csv"]
BESIDE = RESULTS  # arguments added to both runs for options without a row


def rows(Row, name="x"):
    """@param name the name of the input, which output names contain; * for a stream."""
    results = OF_FRAMES if name == "*" else RESULTS
    plot = [*results, "--plot", f"x-{name}.svg"]

    def row(*arguments, beside=results, **how):
        return Row(*arguments, beside=beside, **how)
    return {
        "--frames-from": row("--frames-from", "list.txt", beside=OF_FRAMES),
        "--stable-labels": row("--stable-labels"),
        "--depth": row("--depth", "other.png"),
        "--color": row("--color", "colour.png", beside=["-o", f"o-{name}.pcd"]),
        "--camera": row("--camera", "kinect-v1"),
        "--intrinsics": row("--intrinsics", "100,100,48,36"),
        "--depth-scale": row("--depth-scale", "900"),
        "--allow-empty": row("--allow-empty", variant="empty", sign="--allow-empty: not needed"),
        "--max-range": row("--max-range", "0.93"),
        "--crop": row("--crop", "-0.1,0.1,-1,1,0,2"),
        "--plane": row("--plane", "off"),
        "--plane-distance": row("--plane-distance", "0.08"),
        "--plane-noise": row("--plane-noise", "0.02"),
        "--viewpoint": row("--viewpoint", "0.5,0.5,0.2"),
        "--method": row("--method", "paper"),
        "--supervoxels": row("--supervoxels", "0.06"),
        "--voxel": row("--voxel", "0.02"),
        "--min-persistence": row("--min-persistence", "150"),
        "--distance": row("--distance", "0.012"),
        "--steps": row("--steps", "3"),
        "--no-check": row("--no-check", lost=", checked"),
        "--cut": row("--cut", "0.011"),
        "--min-part": row("--min-part", "600"),
        "--min-size": row("--min-size", "500"),
        "--objects": row("--objects", default=["--parts"]),
        "--parts": row("--parts"),
        "--output": row("-o", f"o-{name}.pcd"),
        "--labels": row("--labels", f"l-{name}.csv", beside=[]),
        "--surfaces": row("--surfaces", f"u-{name}.csv", beside=[]),
        "--json": row("--json", "x.json"),
        "--signatures": row("--signatures", beside=["--json", "x.json"]),
        "--tree": row("--tree", f"t-{name}.tree"),
        "--barcode": row("--barcode", f"b-{name}.csv", beside=[]),
        "--plot": row("--plot", f"x-{name}.svg"),
        "--plot-kind": row("--plot-kind", "diagram", beside=plot),
        "--plot-view": row("--plot-view", "30,20", beside=[*plot, "--plot-kind", "cloud"]),
        "--title": row("--title", "Table", beside=plot),
        "--size": row("--size", "300x200", beside=plot),
        "--axis": row("--axis", "0.001,0.02", beside=plot),
        "--coloured": row("--coloured", f"c-{name}.pcd"),
        "--explain": row("--explain", "1,2"),
        "--picture": row("--picture", f"p-{name}.png"),
        "--report": row("--report", f"r-{name}.html"),
        "--threads": row("--threads", "1"),
        "--memory-limit": row("--memory-limit", "300MiB", sign="memory limit 300 MiB"),
        "--progress": row("--progress", "json", sign="progress {}"),
        "--quiet": row("--quiet", lost="segment"),
        "--verbose": row("--verbose", sign="memory limit"),
        "--force": row("--force", beside=["--json", "@input"]),
    }


def depth_png(image):
    rows = [struct.pack(f">{WIDTH}H", *row) for row in image]
    return files.png(WIDTH, HEIGHT, 16, files.GREY, rows)


def depths(second, first=24):
    """A depth image in millimetres: a table at 1 m, a box 10 cm high and `first` pixels wide with
    waves on its top, a flat object, another box `second` pixels wide, and above it a rod that hides
    its middle."""
    random.seed(7)
    image = []
    for y in range(HEIGHT):
        row = []
        for x in range(WIDTH):
            depth = 1000
            if 10 <= x < 10 + first and 14 <= y < 52:
                depth = round(900 + 8 * math.cos(2 * math.pi * (x - 10) / 12))
            if 2 <= x < 8 and 56 <= y < 68:
                depth = 985
            if 52 <= x < 52 + second and 10 <= y < 60:
                depth = 860
            if 33 <= y < 37 and x > 44:
                depth = 700
            row.append(depth + random.choice((-1, 0, 0, 1)))
        image.append(row)
    return image


def points_of(image):
    for y, row in enumerate(image):
        for x, depth in enumerate(row):
            z = depth / 1000
            yield (x - WIDTH / 2) * z / FOCAL, (y - HEIGHT / 2) * z / FOCAL, z


def text_of(points):
    return "".join(f"{x:.5f} {y:.5f} {z:.5f}\n" for x, y, z in points).encode()


def pcd(points, width, height):
    return files.pcd_header(width=width, height=height) + text_of(points)


def ply(points):
    return (f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty float x\n"
            "property float y\nproperty float z\nend_header\n").encode() + text_of(points)


def tree(program, cloud, arguments):
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "s.pcd"), "wb") as file:
            file.write(cloud)
        subprocess.run([program, "s.pcd", "--tree", "t.tree", "--quiet", *arguments], cwd=folder,
                       check=True)
        with open(os.path.join(folder, "t.tree"), "rb") as file:
            return file.read()


def inputs(Input, program):
    import option_inputs
    Row = option_inputs.Row
    image, other = depths(36), depths(36, 12)
    points = list(points_of(image))
    organised = pcd(points, WIDTH, HEIGHT)
    sixteen = depth_png(image)
    beside = {
        "list.txt": b"next.pcd\n", "images.txt": b"other.png\n", "next.pcd": organised, 
        "other.png": depth_png(other),
        "colour.png": files.png(WIDTH, HEIGHT, 8, files.RGB, [bytes([90, 160, 30]) * WIDTH] * HEIGHT)}
    streams = {**rows(Row, "*"), "--cut": Row("--cut", "150", beside=OF_FRAMES)}
    moved = {"--viewpoint": Row("--viewpoint", "0.3,0,0", beside=[*RESULTS, "--plane", "off",
                                                              "--max-range", "1.02"])}
    supervoxels = {**moved, "--min-persistence": Row("--min-persistence", "0.05", beside=RESULTS),
                   "--cut": Row("--cut", "0.05", beside=RESULTS)}
    shape = {"--cut": Row("--cut", "150", beside=RESULTS)}
    apart = {"--objects": Row("--objects", beside=RESULTS),
             "--parts": Row("--parts", default=["--objects"], beside=RESULTS), **shape}
    paper = {**moved, "--method": Row("--method", "supervoxels", beside=RESULTS)}
    kinds = [
        ("organised PCD", ["s.pcd"], {"s.pcd": organised}, shape, pcd([], 0, 1)),
        ("organised PCD, paper", ["s.pcd", "--method", "paper"], {"s.pcd": organised}, paper, None),
        ("organised PCD, supervoxels", ["s.pcd", "--method", "supervoxels"], {"s.pcd": organised},
         supervoxels, None),
        ("PCD without a plane", ["s.pcd", "--plane", "off", "--max-range", "0.95"],
         {"s.pcd": organised}, {**shape, "--plane": Row("--plane", "on", default=["--plane", "off"], beside=RESULTS)}, None),
        ("unorganised PCD", ["s.pcd"], {"s.pcd": pcd(points, len(points), 1)}, shape, None),
        ("PLY", ["s.ply"], {"s.ply": ply(points)}, shape, ply([])),
        ("XYZ", ["s.xyz"], {"s.xyz": text_of(points)}, shape, b"# none\n"),
        ("depth image", ["--depth", "d.png", "--intrinsics", CAMERA], {"d.png": sixteen}, shape, None),
        ("depth INPUT", ["d.png", "--intrinsics", CAMERA], {"d.png": sixteen},
         {**shape, "--frames-from": Row("--frames-from", "images.txt", beside=OF_FRAMES)}, None),
        ("tree", ["t.tree"], {"t.tree": tree(program, organised, ["--parts"])}, apart, None),
        ("tree, paper", ["t.tree"], {"t.tree": tree(program, organised, ["--method", "paper"])}, {},
         None),
        ("stream", ["s.pcd", "u.pcd"], {"s.pcd": organised,
                                        "u.pcd": pcd(list(points_of(other)), WIDTH, HEIGHT)},
         streams, None),
        ("folder", ["in"], {"in/s.pcd": organised,
                            "in/u.pcd": pcd(list(points_of(other)), WIDTH, HEIGHT)},
         streams, None),
    ]
    looks = {"--frames-from": Row("--frames-from", "list.txt", unfit="several inputs"),
             "--plot-kind": Row("--plot-kind", "diagram"),
             "--title": Row("--title", "Table"), "--size": Row("--size", "300x200"),
             "--axis": Row("--axis", "0.001,0.02")}
    scaled = {"d.png": sixteen}
    kinds += [
        ("frames from a list", ["--frames-from", "frames.txt"],
         {"s.pcd": organised, "frames.txt": b"s.pcd\nu.pcd\n",
          "u.pcd": pcd(list(points_of(other)), WIDTH, HEIGHT)}, streams, None),
        ("stream with a camera", ["d.png", "other.png", "--camera", "xtion"], scaled,
         {**streams, "--frames-from": Row("--frames-from", "images.txt", beside=OF_FRAMES)},
         None),
        ("plot of the tree", ["s.pcd", *RESULTS, "--plot", "y.svg", "--plot-kind", "tree"],
         {"s.pcd": organised}, {**shape, **looks}, None)]
    return [Input(name, arguments, {**files, **beside}, rows=given,
                  **({} if empty is None else {"empty": empty}))
            for name, arguments, files, given, empty in kinds]
