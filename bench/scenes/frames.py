#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes RGB-D frames with exact labels from seeds.

    frames.py FOLDER --kinds stack,bin --seeds 0-19

writes FOLDER/KIND-SEED.pcd: an organised cloud with the fields x y z label rgb, in metres, as a
depth camera at the origin sees it. The label is 0 where there is no depth, where a pixel mixes two
depths, and on objects of which fewer than 300 pixels are seen. It is 1 on the support, 2 on walls,
3 on the floor, 4 on the boards of a shelf, 5 on a bin, 6 on the ceiling, and a multiple of 10 from
20 on for each object. The same kind and seed give the same frame. Needs numpy.
"""

import argparse
import pathlib
import sys

import numpy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "segmentation"))
import arrangements
import cameras
import point_clouds
from segmentation_metrics import FIRST_OBJECT

FEWEST = 300  # pixels of an object


def seen(scene, sensor, random, name):
    """What a sensor, by its name in cameras.SENSORS, sees of a scene of placing.py: the frame as
    point_clouds.Scene, and the colours of its points as bytes."""
    optics = cameras.SENSORS[sensor]
    view = cameras.View.towards(optics, scene.eye, scene.target, random.normal(0, 0.05))
    solids = [(n, solid) for n, thing in enumerate(scene.things) for solid in thing.solids]
    image = cameras.measured(view, cameras.cast(view, solids), random)
    labels = numpy.zeros(image.thing.shape, numpy.int32)
    for n, thing in enumerate(scene.things):
        mask = image.thing == n
        if thing.role != "object":
            labels[mask] = arrangements.ROLES.index(thing.role)
        elif numpy.count_nonzero(mask & numpy.isfinite(image.depth)) >= FEWEST:
            labels[mask] = FIRST_OBJECT * (n + 2)
    points = (view.rays() * image.depth[..., None]).astype(numpy.float32).reshape(-1, 3)
    frame = point_clouds.Scene(name, points, labels.ravel(), optics.width, optics.height)
    return frame, image.colour.astype(numpy.uint8).reshape(-1, 3)


def arranged(kind, seed):
    """The scene of a kind and a seed, the name of the sensor that the seed chooses, and the
    generator of what is random in the image."""
    random = numpy.random.default_rng([list(arrangements.KINDS).index(kind), seed])
    scene = arrangements.KINDS[kind](random)
    names = list(cameras.SENSORS)
    return scene, names[random.integers(len(names))], random


def sensor_of(kind, seed):
    """The sensor that the seed chooses."""
    return cameras.SENSORS[arranged(kind, seed)[1]]


def frame(kind, seed, sensor=None):
    """A frame as point_clouds.Scene, and the colours of its points as bytes.

    @param sensor a name of cameras.SENSORS; without it, the seed chooses one."""
    scene, chosen, random = arranged(kind, seed)
    return seen(scene, sensor or chosen, random, f"{kind}-{seed}")


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
            scene, colours = frame(kind, seed, arguments.sensor)
            point_clouds.write_scene(arguments.folder / f"{scene.name}.pcd", scene, colours)
    return 0


if __name__ == "__main__":
    sys.exit(main())
