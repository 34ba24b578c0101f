#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the frames that ph-segment segments worst: ground truth beside the segments.

    pictures.py build/release generated.png --seeds 0-9
    pictures.py build/release real.png --frames FOLDER --worst 10

With --seeds, the picture shows the worst generated frame of each kind. With --frames, it shows the
worst of the PCD files in a folder, which have ground truth in the field `label`. The script prints
the name and the F of each frame, in the order of the picture: from left to right, then down. A
segment has the colour of its matched object; a segment without one is striped. Needs numpy.
"""

import argparse
import pathlib
import shlex
import sys
import tempfile

import numpy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "segmentation"))
import arrangements
import frames
import label_pictures
import point_clouds
import segmentation_metrics
from score import RANGE, run
from segmentation_programs import OURS, Program

COLUMNS = 2
WIDTH, HEIGHT = 460, 190  # pixels of a frame with its segments
MARGIN = 6


def segmented(ph_segment, path, option):
    """A frame and the labels of its objects."""
    with tempfile.TemporaryDirectory() as folder:
        command = (
            f"{ph_segment} {{input}} --quiet --labels {{output}}.npy "
            f"--json {{outputs}}/summary.json {option}"
        )
        labels, _ = run(Program(OURS, command), path, pathlib.Path(folder))
    return point_clouds.read_scene(path), labels


def worst_of(found, count):
    """The frames with the smallest F. @param found pairs (scene, labels)."""
    scored = [
        (segmentation_metrics.score(scene.truth, labels, False, False).f, scene, labels)
        for scene, labels in found
    ]
    return sorted(scored, key=lambda one: one[0])[:count]


def worst_generated(ph_segment, kinds, seeds):
    for kind in kinds:
        with tempfile.TemporaryDirectory() as folder:
            found = []
            for seed in seeds:
                scene, colours = frames.frame(kind, seed)
                path = pathlib.Path(folder) / f"{scene.name}.pcd"
                point_clouds.write_scene(path, scene, colours)
                found.append(segmented(ph_segment, path, RANGE.get(kind, "")))
            yield from worst_of(found, 1)


def fitted(image):
    """The image in a white rectangle of WIDTH x HEIGHT; only every n-th pixel if it is larger."""
    step = max(1, -(-image.shape[0] // HEIGHT), -(-image.shape[1] // WIDTH))
    image = image[::step, ::step]
    paper = numpy.full((HEIGHT, WIDTH, 3), 255, numpy.uint8)
    paper[: image.shape[0], : image.shape[1]] = image
    return paper


def drawn(scene, labels):
    shape = scene.height, scene.width
    points = scene.points.reshape(*shape, 3)
    return fitted(
        label_pictures.beside(
            scene.truth.reshape(shape), [labels.reshape(shape)], points=points, step=1
        )
    )


def sheet(images):
    """All images on one page, row by row."""
    page = [
        numpy.pad(image, ((0, MARGIN), (0, MARGIN), (0, 0)), constant_values=255)
        for image in images
    ]
    page += [numpy.full_like(page[0], 255)] * (-len(page) % COLUMNS)
    rows = [numpy.hstack(page[k : k + COLUMNS]) for k in range(0, len(page), COLUMNS)]
    return numpy.vstack(rows)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("build", type=pathlib.Path, help="build folder, with ph-segment")
    parser.add_argument("picture", type=pathlib.Path, help="PNG file to write")
    parser.add_argument("--kinds", type=frames.kinds, default=list(arrangements.KINDS))
    parser.add_argument("--seeds", type=frames.seeds, default=range(4), metavar="A-B")
    parser.add_argument("--frames", type=pathlib.Path, help="folder of PCD files")
    parser.add_argument("--worst", type=int, default=10, help="number of frames of the folder")
    arguments = parser.parse_args()
    ph_segment = shlex.quote(str(arguments.build.resolve() / "apps/segment/ph-segment"))
    if arguments.frames:
        paths = sorted(arguments.frames.glob("*.pcd"))
        shown = worst_of((segmented(ph_segment, p, "") for p in paths), arguments.worst)
    else:
        shown = list(worst_generated(ph_segment, arguments.kinds, arguments.seeds))
    label_pictures.write(arguments.picture, sheet([drawn(*one[1:]) for one in shown]))
    for f, scene, _ in shown:
        print(f"{scene.name}: {f:.3f}")


if __name__ == "__main__":
    main()
