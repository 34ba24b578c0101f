#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures how much the labels of ph-segment, and of other programs, change if a frame changes.

    stability.py build/release --frames FOLDER --every 3 --kinds stack,bin --seeds 0-4

segments each frame as it is, and then under each change in FIXED and RANDOM. The labels before and
after the change are compared on the points that both frames have, by the F measure of
segmentation_metrics with the labels before as the truth. The script prints one table for the frames
of --frames, which are organised PCD files with the fields x y z label, and one for generated
frames. A cell has the mean F, the worst F, and the share of the runs in which no label changed. The
first row has the mean and the worst F of the frames as they are, against their ground truth: a
program that finds nothing is stable. If the order of the points or the number of threads changes a
label of ph-segment, the exit code is 1.

A program for --peer is NAME = COMMAND, as for score.py. In the command, {range} stands for the
option for large scenes, and {change} for the options that go with a change. These are --threads N
and, if the input is a depth image, --intrinsics and --depth-scale. A segment counts only if its
role is `object`, as in score.py. Needs numpy.
"""

import argparse
import concurrent.futures
import csv
import dataclasses
import os
import pathlib
import shlex
import sys
import tempfile
import typing
import zlib

import numpy

BENCH = pathlib.Path(__file__).resolve().parents[1]
sys.path += [str(BENCH), str(BENCH / "segmentation")]
import frames
import perturbations
import point_clouds
import segmentation_metrics
from perturbations import with_depth
from score import RANGE, run
from segmentation_metrics import FIRST_OBJECT
from segmentation_programs import OURS, Program, peer
from segmentation_tables import share, table

PER_METRE = 10000  # units of a depth image: it is rounded to 0.1 mm
MORE_NOISE = (1.5**2 - 1) ** 0.5  # added to noise of 1, it makes noise of 1.5


@dataclasses.dataclass
class Frame:
    """A frame, the standard deviation of its depth, in metres, as a function of the depth, and the
    option for large scenes."""

    scene: point_clouds.Scene
    spread: typing.Callable
    range: str = ""


@dataclasses.dataclass
class Changed:
    """A frame after a change. `origin` is the number of each of its points in the frame before. If
    `options` contains --intrinsics, the program reads a depth image."""

    scene: point_clouds.Scene
    origin: numpy.ndarray
    viewpoint: tuple = (0, 0, 0)
    options: str = "--threads 1"


def in_place(scene):
    """A frame in which each point has its number before."""
    return Changed(scene, numpy.arange(len(scene.truth)))


def listed(scene, kept):
    return Changed(perturbations.listed(scene, kept), kept)


def mirrored(frame):
    scene = frame.scene
    origin = numpy.arange(len(scene.truth)).reshape(scene.height, scene.width)[:, ::-1].ravel()
    points = scene.points[origin] * numpy.float32((-1, 1, 1))
    return Changed(dataclasses.replace(scene, points=points, truth=scene.truth[origin]), origin)


def without_rows(frame):
    return listed(frame.scene, with_depth(frame.scene))


def as_depth(frame):
    changed = in_place(frame.scene)
    camera = ",".join(f"{x:.7g}" for x in pinhole(frame.scene))
    changed.options += f" --intrinsics {camera} --depth-scale {PER_METRE}"
    return changed


def backwards(frame):
    return listed(frame.scene, with_depth(frame.scene)[::-1])


def with_two_threads(frame):
    return dataclasses.replace(in_place(frame.scene), options="--threads 2")


def turned(frame, random, centre):
    """Turned about an axis through `centre`. All rotations are equally likely."""
    turn, triangle = numpy.linalg.qr(random.normal(size=(3, 3)))
    turn *= numpy.sign(numpy.diag(triangle))
    turn[:, 0] *= numpy.linalg.det(turn)
    points = (frame.scene.points - centre) @ turn.T + centre
    changed = in_place(dataclasses.replace(frame.scene, points=points.astype(numpy.float32)))
    changed.viewpoint = tuple(centre - turn @ centre)
    return changed


def turned_about_sensor(frame, random):
    return turned(frame, random, numpy.zeros(3))


def turned_elsewhere(frame, random):
    return turned(frame, random, random.normal(size=3))


def shuffled(frame, random):
    return listed(frame.scene, random.permutation(with_depth(frame.scene)))


def thinned(frame, random):
    return in_place(perturbations.dropout(frame.scene, 50, random))


def noisy(frame, random):
    sigma = lambda z: MORE_NOISE * frame.spread(z)
    return in_place(perturbations.along_rays(frame.scene, sigma, random))


def cropped(frame, random):
    """Without the points outside a box around an object. The box is twice as long as the object in
    each direction."""
    objects = frame.scene.truth // FIRST_OBJECT
    chosen = random.choice(numpy.unique(objects[objects > 0]))
    points = frame.scene.points[objects == chosen]
    low, high = points.min(axis=0), points.max(axis=0)
    away = abs(frame.scene.points - (low + high) / 2)
    return in_place(perturbations.without(frame.scene, (away > high - low).any(axis=1)))


FIXED = {
    "two threads": with_two_threads,
    "points in reversed order": backwards,
    "without rows and columns": without_rows,
    "a depth image": as_depth,
    "mirrored": mirrored,
}
RANDOM = {
    "points in random order": shuffled,
    "turned about the sensor": turned_about_sensor,
    "turned about an axis elsewhere": turned_elsewhere,
    "half of the points": thinned,
    "noise × 1.5": noisy,
    "cropped around an object": cropped,
}
EXACT = ("two threads", "points in reversed order", "points in random order")
NONE = "none, F against the truth"


def pinhole(scene):
    """The focal lengths and the principal point of the camera of an organised frame."""
    there = with_depth(scene)
    x, y, z = scene.points[there].T.astype(float)
    across = numpy.polyfit(x / z, there % scene.width, 1)
    down = numpy.polyfit(y / z, there // scene.width, 1)
    return across[0], down[0], across[1], down[1]


def noise_of_surfaces(scene, size=16):
    """The standard deviation of depth at one metre, if it grows with depth²: the median over the
    squares of size x size pixels that show a single surface."""
    rows, columns = scene.height // size, scene.width // size
    squares = lambda values: (
        values.reshape(scene.height, scene.width)[: rows * size, : columns * size]
        .reshape(rows, size, columns, size)
        .swapaxes(1, 2)
        .reshape(-1, size * size)
    )
    truth = squares(scene.truth)
    flat = (truth == truth[:, :1]).all(axis=1) & (truth[:, 0] > 0) & (truth[:, 0] < FIRST_OBJECT)
    if not flat.any():
        raise ValueError(f"{scene.name}: no square of {size} x {size} pixels shows one surface")
    # On a plane, 1/depth is linear in row and column. Its noise is the noise of depth / depth².
    values = 1 / squares(scene.points[:, 2].astype(float))[flat]
    v, u = numpy.divmod(numpy.arange(size * size), size)
    linear = numpy.stack([u, v, numpy.ones_like(u)], axis=1)
    rest = values - values @ numpy.linalg.pinv(linear).T @ linear.T
    return numpy.median((rest**2).sum(axis=1) / (size * size - 3)) ** 0.5


def real_frame(path):
    scene = point_clouds.read_scene(path)
    noise = noise_of_surfaces(scene)
    return Frame(scene, lambda z: noise * z**2)


def generated_frame(kind, seed):
    scene, _ = frames.frame(kind, seed)
    return Frame(scene, frames.sensor_of(kind, seed).spread, RANGE.get(kind, ""))


def labels_of(program, frame, changed, folder):
    text = program.text.replace("{range}", frame.range).replace("{change}", changed.options)
    path = pathlib.Path(folder) / f"{frame.scene.name}.pcd"
    if "--intrinsics" in changed.options:
        path = path.with_suffix(".pgm")
        point_clouds.write_depth(path, changed.scene, PER_METRE)
    else:
        point_clouds.write_scene(path, changed.scene, viewpoint=changed.viewpoint)
    return run(Program(program.name, text), path, path.parent / "labels")[0]


def agreement(before, changed, after):
    """The F measure of the labels after a change, and whether all labels are equal."""
    before = before[changed.origin]
    there = numpy.isfinite(changed.scene.points).all(axis=1)
    truth = numpy.where(there, numpy.where(before > 0, FIRST_OBJECT * before, 1), 0)
    f = segmentation_metrics.score(truth, after, False, False).f
    return f, numpy.array_equal(before[there], after[there])


@dataclasses.dataclass
class Run:
    """A line of --csv."""

    frame: str
    change: str
    program: str
    f: float
    equal: bool = False


def changes(frame, draws):
    """The names of all changes, with the frame after each of them."""
    for name, change in FIXED.items():
        yield name, change(frame)
    for name, change in RANDOM.items():
        seed = zlib.crc32(f"{name} {frame.scene.name}".encode())
        random = numpy.random.default_rng(seed)
        for _ in range(draws):
            yield name, change(frame, random)


def runs_of(make, source, programs, draws):
    """The runs of one frame, which is make(*source)."""
    frame = make(*source)
    scene = frame.scene
    with tempfile.TemporaryDirectory() as folder:
        before = {p.name: labels_of(p, frame, in_place(scene), folder) for p in programs}
        f = lambda labels: segmentation_metrics.score(scene.truth, labels, False, False).f
        runs = [Run(scene.name, NONE, name, f(labels)) for name, labels in before.items()]
        for change, changed in changes(frame, draws):
            for p in programs:
                after = labels_of(p, frame, changed, folder)
                result = agreement(before[p.name], changed, after)
                runs.append(Run(scene.name, change, p.name, *result))
    return runs


def cell(runs):
    text = f"{share(numpy.mean([r.f for r in runs]))} / {share(min(r.f for r in runs))}"
    if runs[0].change == NONE:
        return text
    return f"{text} / {100 * numpy.mean([r.equal for r in runs]):.0f} %"


def rows(runs, programs):
    of = lambda change, program: [r for r in runs if (r.change, r.program) == (change, program)]
    return [[c, *(cell(of(c, p.name)) for p in programs)] for c in (NONE, *FIXED, *RANDOM)]


def pcd_files(paths):
    for path in paths:
        yield from sorted(path.glob("*.pcd")) if path.is_dir() else [path]


def parse():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("build", type=pathlib.Path, help="build folder, with ph-segment")
    parser.add_argument(
        "--frames", type=pathlib.Path, nargs="*", default=[], help="PCD files, or folders of them"
    )
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only every N-th of them")
    parser.add_argument("--kinds", type=frames.kinds, default=[], help="of generated frames")
    parser.add_argument("--seeds", type=frames.seeds, default=range(4), metavar="A-B")
    parser.add_argument("--draws", type=int, default=1, help="of each random change of a frame")
    parser.add_argument(
        "--peer", type=peer, action="append", default=[], help="NAME = COMMAND, repeatable"
    )
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--csv", type=pathlib.Path, help="also write the results of all runs")
    return parser.parse_args()


def main():
    arguments = parse()
    ph_segment = shlex.quote(str(arguments.build.resolve() / "apps/segment/ph-segment"))
    ours = Program(
        OURS,
        f"{ph_segment} {{input}} --quiet --labels {{output}}.npy --json {{outputs}}/summary.json "
        "{range} {change}",
    )
    programs = [ours, *arguments.peer]
    files = [(file,) for file in pcd_files(arguments.frames)][:: arguments.every]
    generated = [(kind, seed) for kind in arguments.kinds for seed in arguments.seeds]
    found = []
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs) as pool:
        for name, make, sources in (
            ("frames", real_frame, files),
            ("generated frames", generated_frame, generated),
        ):
            if sources:
                tasks = [pool.submit(runs_of, make, s, programs, arguments.draws) for s in sources]
                runs = [run for task in tasks for run in task.result()]
                header = [f"{len(sources)} {name}", *(p.name for p in programs)]
                print(table(header, rows(runs, programs)), end="\n\n", flush=True)
                found += runs
    if arguments.csv:
        with arguments.csv.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow([field.name for field in dataclasses.fields(Run)])
            writer.writerows(dataclasses.astuple(run) for run in found)
    return any(r.program == OURS and r.change in EXACT and not r.equal for r in found)


if __name__ == "__main__":
    sys.exit(main())
