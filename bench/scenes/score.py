#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Scores ph-segment on generated frames, by kind of scene.

    score.py build/release/apps/segment/ph-segment --seeds 0-19

prints, for each kind, the mean F measure of objects and its standard error, each frame as the mean
over five voxel edges (4.7 to 5.3 mm), and the mean number of strays: segments that lie for the
greater part on no object. A second program or other options after --against are run on the same
frames; then the paired difference is printed as well. Words after -- go to the program. --least
KIND=F ends with exit 1 if a mean is smaller. Needs numpy.
"""
import argparse
import concurrent.futures
import csv
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

import numpy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "segmentation"))
import arrangements
import frames
import segmentation_metrics

# Options without which the program leaves out what the kind is about.
OPTIONS = {"room": ["--max-range", "6"]}
EDGES = ("", "0.0047", "0.00485", "0.00515", "0.0053")  # metres; "": the default, 5 mm


def labels_of(command, path, edge, output):
    """The labels that the program gives to a frame."""
    words = [*command, str(path), "--quiet", "--threads", "1", "--labels", str(output)]
    run = subprocess.run(
        words + (["--voxel", edge] if edge else []), capture_output=True, text=True, check=False
    )
    if run.returncode != 0:
        raise RuntimeError(f"{shlex.join(words)}: exit {run.returncode}: {run.stderr[-400:]}")
    labels = numpy.load(output)
    output.unlink()
    return labels


def strays(truth, labels):
    """The number of segments of which less than half of the pixels with truth is on objects."""
    known = (truth > 0) & (labels > 0)
    on_all = numpy.bincount(labels[known])
    on_objects = numpy.bincount(labels[known & (truth >= 10)], minlength=len(on_all))
    return int(((on_all > 0) & (2 * on_objects < on_all)).sum())


def score(task):
    """Kind, seed, and for each command the mean F and the mean number of strays of one frame."""
    kind, seed, commands, edges, keep = task
    points, colours, truth = frames.frame(kind, seed)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(keep or folder) / f"{kind}-{seed}.pcd"
        frames.write(path, points, colours, truth)
        results = []
        for command in commands:
            f, stray = [], []
            for edge in edges:
                words = [*command, *OPTIONS.get(kind, ())]
                labels = labels_of(words, path, edge, pathlib.Path(folder) / "labels.npy")
                labels = labels.reshape(truth.shape).astype(numpy.int64)
                f.append(segmentation_metrics.score(truth.astype(int), labels, False, False).f)
                stray.append(strays(truth, labels))
            results.append((float(numpy.mean(f)), float(numpy.mean(stray))))
    return kind, seed, results


def summary(values):
    """Mean and standard error."""
    error = numpy.std(values, ddof=1) / len(values) ** 0.5 if len(values) > 1 else 0.0
    return f"{numpy.mean(values):.4f} ± {error:.4f}"


def least(text):
    kind, _, value = text.partition("=")
    return kind, float(value)


def parse():
    words = sys.argv[1:]
    split = words.index("--") if "--" in words else len(words)
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("program", help="ph-segment")
    parser.add_argument("--seeds", type=frames.seeds, default=range(4), metavar="A-B")
    parser.add_argument("--kinds", type=frames.kinds, default=list(arrangements.KINDS))
    parser.add_argument(
        "--against", type=shlex.split, metavar="COMMAND", help="a program and options to compare"
    )
    parser.add_argument("--least", type=least, nargs="*", default=[], metavar="KIND=F")
    parser.add_argument("--one-edge", action="store_true", help="only the default voxel edge")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--csv", type=pathlib.Path, help="write the scores of all frames")
    parser.add_argument("--keep", type=pathlib.Path, help="keep the frames in this folder")
    arguments = parser.parse_args(words[:split])
    arguments.options = words[split + 1 :]
    return arguments


def main():
    arguments = parse()
    commands = [[arguments.program, *arguments.options]]
    if arguments.against:
        commands.append(arguments.against)
    if arguments.keep:
        arguments.keep.mkdir(parents=True, exist_ok=True)
    edges = EDGES[:1] if arguments.one_edge else EDGES
    tasks = [
        (kind, seed, commands, edges, arguments.keep)
        for kind in arguments.kinds
        for seed in arguments.seeds
    ]
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs) as pool:
        rows = list(pool.map(score, tasks))
    if arguments.csv:
        with arguments.csv.open("w", newline="") as file:
            csv.writer(file).writerows(
                [("kind", "seed", *(["f", "strays"] * len(commands)))]
                + [(kind, seed, *sum(results, ())) for kind, seed, results in rows]
            )
    failed = False
    for kind in arguments.kinds:
        of_kind = numpy.array([results for k, _, results in rows if k == kind])
        line = f"{kind:9} F {summary(of_kind[:, 0, 0])}, strays {of_kind[:, 0, 1].mean():.2f}"
        if arguments.against:
            line += f" | {summary(of_kind[:, 1, 0])}, strays {of_kind[:, 1, 1].mean():.2f}"
            line += f" | difference {summary(of_kind[:, 0, 0] - of_kind[:, 1, 0])}"
        wanted = dict(arguments.least).get(kind, 0.0)
        if of_kind[:, 0, 0].mean() < wanted:
            line, failed = f"{line} < {wanted}", True
        print(line)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
