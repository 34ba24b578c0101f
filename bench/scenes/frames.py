#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes RGB-D frames with exact labels from seeds.

    frames.py FOLDER --kinds stack,bin --seeds 0-19

writes FOLDER/KIND-SEED.pcd: an organised cloud with the fields x y z rgb label, in metres, as a
depth camera at the origin sees it. The label is 0 where there is no depth or a pixel mixes two
depths, 1 for the support, 2 wall, 3 floor, 4 shelf, 5 bin, 6 ceiling, and 10, 20, 30, … for the
objects. The same kind and seed give the same frame. Needs numpy.
"""
import argparse
import pathlib
import sys

import numpy

import arrangements
import cameras

FEWEST = 300  # pixels: an object of which less is seen is left out of the truth


def frame(kind, seed, sensor=None):
    """Points (rows x columns x 3, NaN without depth), colours (bytes) and labels of one frame.

    @param sensor a name of cameras.SENSORS; otherwise the seed chooses one."""
    random = numpy.random.default_rng([list(arrangements.KINDS).index(kind), seed])
    scene = arrangements.KINDS[kind](random)
    names = list(cameras.SENSORS)
    chosen = names[random.integers(len(names))]
    optics = cameras.SENSORS[sensor or chosen]
    view = cameras.View.towards(optics, scene.eye, scene.target, random.normal(0, 0.05))
    solids = [(n, solid) for n, thing in enumerate(scene.things) for solid in thing.solids]
    image = cameras.measured(view, cameras.cast(view, solids), random)
    labels = numpy.zeros(image.thing.shape, numpy.uint32)
    for n, thing in enumerate(scene.things):
        mask = image.thing == n
        if thing.role != "object":
            labels[mask] = arrangements.ROLES.index(thing.role)
        elif numpy.count_nonzero(mask & numpy.isfinite(image.depth)) >= FEWEST:
            labels[mask] = 10 * (n + 1)
    labels[~numpy.isfinite(image.depth)] = 0
    points = (view.rays() * image.depth[..., None]).astype(numpy.float32)
    return points, image.colour.astype(numpy.uint8), labels


def write(path, points, colours, labels):
    rows = numpy.empty(labels.size, [("xyz", "<f4", 3), ("rgb", "<u4"), ("label", "<u4")])
    rows["xyz"], rows["label"] = points.reshape(-1, 3), labels.ravel()
    r, g, b = colours.reshape(-1, 3).astype(numpy.uint32).T
    rows["rgb"] = r << 16 | g << 8 | b
    height, width = labels.shape
    header = (
        "VERSION 0.7",
        "FIELDS x y z rgb label",
        "SIZE 4 4 4 4 4",
        "TYPE F F F U U",
        "COUNT 1 1 1 1 1",
        f"WIDTH {width}",
        f"HEIGHT {height}",
        "VIEWPOINT 0 0 0 1 0 0 0",
        f"POINTS {labels.size}",
        "DATA binary",
        "",
    )
    pathlib.Path(path).write_bytes("\n".join(header).encode() + rows.tobytes())


def seeds(text):
    first, _, last = text.partition("-")
    return range(int(first), int(last or first) + 1)


def kinds(text):
    names = text.split(",")
    if unknown := [name for name in names if name not in arrangements.KINDS]:
        raise argparse.ArgumentTypeError(
            f"{unknown[0]!r}: expected one of {', '.join(arrangements.KINDS)}"
        )
    return names


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--kinds", type=kinds, default=list(arrangements.KINDS))
    parser.add_argument("--seeds", type=seeds, default=range(1), metavar="A-B")
    parser.add_argument("--sensor", choices=cameras.SENSORS, help="default: the seed chooses")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for kind in arguments.kinds:
        for seed in arguments.seeds:
            write(arguments.folder / f"{kind}-{seed}.pcd", *frame(kind, seed, arguments.sensor))
    return 0


if __name__ == "__main__":
    sys.exit(main())
