#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Scores ph-segment, and other programs, on generated frames, by kind of scene.

    score.py build/release --seeds 0-19

prints, for each kind, the mean F measure of objects with its standard error, the mean number of
strays, and the mean CPU time of a run. A stray is a segment of which less than half lies on
objects. A segment of ph-segment counts only if its role is `object`. The score of a frame is the
mean over five voxel edges: the edge that ph-segment chooses (5 mm or more), and 0.94 to 1.06 times
this edge.

A program for --peer is NAME = COMMAND, as for segmentation_scores.py. The printed difference is our
F minus its F, averaged over the frames. The CPU time is that of the process (user + system), or, if
the command names stages=FILE, the sum of the stages in that file. The CPU time of a peer is printed
as a multiple of ours. CPU times are comparable only with --jobs 1.

A command with {edge} runs once per voxel edge: {edge} stands for nothing or for `--voxel E`. If the
command writes no {outputs}/summary.json, the edge that it chooses counts as 5 mm. {range} stands
for the option that ph-segment needs for a kind: --max-range 6 in rooms, which are larger than its
default range of 2 m.

Needs numpy.
"""

import argparse
import concurrent.futures
import csv
import json
import os
import pathlib
import resource
import shlex
import sys
import tempfile

import numpy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "segmentation"))
import arrangements
import frames
import point_clouds
import segmentation_metrics
from segmentation_programs import OURS, Program, peer

EDGES = (1, 0.94, 0.97, 1.03, 1.06)  # multiples of the edge that is chosen
RANGE = {"room": "--max-range 6"}


def of_objects(labels, summary):
    """The labels of a run of ph-segment, with 0 for segments that are not objects, such as
    containers. @param summary what --json wrote."""
    others = [s["label"] for s in summary["segments"] if s["role"] != "object"]
    return numpy.where(numpy.isin(labels, others), 0, labels)


def run(program, path, outputs):
    """The labels that a program gives to the objects of a frame, and the edge of its voxels in
    metres. @param outputs a folder for its files."""
    labels = program.labels(path, outputs)
    file = outputs / "summary.json"
    if not file.exists():
        return labels, 0.005
    summary = json.loads(file.read_text())
    file.unlink()
    return of_objects(labels, summary), summary["voxel"]


def runs(program, kind, edges, path, outputs):
    """The labels and the CPU seconds of the runs of a program on a frame of a kind: one run per
    voxel edge if the command contains {edge}."""
    text = program.text.replace("{range}", RANGE.get(kind, ""))
    for times in edges if "{edge}" in text else (1,):
        option = "" if times == 1 else f"--voxel {times * voxel:.6g}"
        variant = Program(program.name, text.replace("{edge}", option))
        before = cpu_of_children()
        labels, edge = run(variant, path, outputs)
        cpu = cpu_of_children() - before
        if stages := variant.stages(path, outputs):
            cpu = sum(stages.values())
        if times == 1:
            voxel = edge
        yield labels, cpu


def strays(truth, labels):
    """The number of segments of which less than half lies on objects. Only points with a true label
    count."""
    known = (truth > 0) & (labels > 0)
    on_all = numpy.bincount(labels[known])
    is_object = truth >= segmentation_metrics.FIRST_OBJECT
    on_objects = numpy.bincount(labels[known & is_object], minlength=len(on_all))
    return int(((on_all > 0) & (2 * on_objects < on_all)).sum())


def cpu_of_children():
    """The user + system seconds of all programs that this process has run."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def score(kind, seed, programs, edges, keep):
    """For each program, the mean F, number of strays and CPU seconds of its runs on one frame."""
    scene, colours = frames.frame(kind, seed)
    results = []
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(keep or folder) / f"{scene.name}.pcd"
        point_clouds.write_scene(path, scene, colours)
        for program in programs:
            found = []
            for labels, cpu in runs(program, kind, edges, path, pathlib.Path(folder) / "labels"):
                scores = segmentation_metrics.score(scene.truth, labels, False, False)
                found.append((scores.f, strays(scene.truth, labels), cpu))
            results.append(numpy.mean(found, axis=0))
    return results


def mean(values):
    """The mean and its standard error, as text."""
    error = numpy.std(values, ddof=1) / len(values) ** 0.5 if len(values) > 1 else 0.0
    return f"{numpy.mean(values):.4f} ± {error:.4f}"


def line(kind, programs, of_kind):
    """The results of a kind as text.

    @param of_kind an array of frames x programs x (F, strays, CPU seconds)."""
    cpu = of_kind[:, :, 2].mean(axis=0)
    parts = []
    for k, program in enumerate(programs):
        text = f"F {mean(of_kind[:, k, 0])}, strays {of_kind[:, k, 1].mean():.2f}"
        if k == 0:
            text += f", CPU {1000 * cpu[0]:.0f} ms"
        else:
            difference = mean(of_kind[:, 0, 0] - of_kind[:, k, 0])
            text = f"{program.name}: {text}, CPU x {cpu[k] / cpu[0]:.2f}, difference {difference}"
        parts.append(text)
    return f"{kind:9} " + " | ".join(parts)


def least(text):
    kind, _, value = text.partition("=")
    return kind, float(value)


def parse():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("build", type=pathlib.Path, help="build folder, with ph-segment")
    parser.add_argument("--seeds", type=frames.seeds, default=range(4), metavar="A-B")
    parser.add_argument("--kinds", type=frames.kinds, default=list(arrangements.KINDS))
    parser.add_argument("--ours", default="", metavar="OPTIONS", help="options of ph-segment")
    parser.add_argument(
        "--peer", type=peer, action="append", default=[], help="NAME = COMMAND, repeatable"
    )
    parser.add_argument(
        "--least",
        type=least,
        nargs="*",
        default=[],
        metavar="KIND=F",
        help="end with exit 1 if the mean of a kind is smaller",
    )
    parser.add_argument("--one-edge", action="store_true", help="only the default voxel edge")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--csv", type=pathlib.Path, help="also write the scores of all frames")
    parser.add_argument("--keep", type=pathlib.Path, help="keep the frames in this folder")
    return parser.parse_args()


def main():
    arguments = parse()
    ph_segment = shlex.quote(str(arguments.build.resolve() / "apps/segment/ph-segment"))
    ours = (
        f"{ph_segment} {{input}} --quiet --threads 1 --labels {{output}}.npy "
        "--json {outputs}/summary.json {range} {edge}"
    )
    programs = [Program(OURS, f"{ours} {arguments.ours}"), *arguments.peer]
    edges = EDGES[:1] if arguments.one_edge else EDGES
    if arguments.keep:
        arguments.keep.mkdir(parents=True, exist_ok=True)
    tasks = [(kind, seed) for kind in arguments.kinds for seed in arguments.seeds]
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs) as pool:
        runs = [pool.submit(score, *task, programs, edges, arguments.keep) for task in tasks]
        results = numpy.array([run.result() for run in runs])
    if arguments.csv:
        with arguments.csv.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(["kind", "seed", "program", "f", "strays", "cpu"])
            for (kind, seed), of_frame in zip(tasks, results):
                for program, (f, stray, cpu) in zip(programs, of_frame):
                    row = [kind, seed, program.name, f"{f:.4f}", f"{stray:g}", f"{cpu:.4f}"]
                    writer.writerow(row)
    failed = False
    for kind in arguments.kinds:
        of_kind = results[[k == kind for k, _ in tasks]]
        wanted = dict(arguments.least).get(kind, 0.0)
        below = of_kind[:, 0, 0].mean() < wanted
        failed |= below
        print(line(kind, programs, of_kind) + (f", expected {wanted} or more" if below else ""))
    if len(arguments.kinds) > 1:
        print(line("all", programs, results))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
