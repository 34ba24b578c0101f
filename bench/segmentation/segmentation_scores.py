#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares ph-segment with other programs on RGB-D frames with ground truth, on the same frames, in
one run.

    segmentation_scores.py build/release SCENES \\
      --peer 'NAME 1.0 = PROGRAM {input} --labels {output}.npy'

SCENES is a folder of PCD files with the fields x y z label. A label of 0 means no depth, 1 to 9 the
table, 20 to 29 the parts of the first object, 30 to 39 the parts of the second, and so on. The
category of each frame is in a CSV file (frame,category).

A peer is NAME = COMMAND; the name includes the version. In the command, {input} is the frame, and
{folder} and {name} are its folder and its name without .pcd. The peer writes one label per point,
in the order of the input, to {output}.npy, {output}.pgm or {output}.pcd; {outputs} is the folder of
this file. The command may be preceded by background=B (labels up to B are not segments; default 0)
and stages=FILE (CSV with the seconds of each stage in columns t_NAME). @FILE stands for the
arguments in a file, one per line.

Scores are always computed. A program with "supervoxels" in its name or options gets the scores for
pieces of objects: boundary recall and under-segmentation error. --times measures CPU seconds and
memory, --perturb degrades the frames, --cross-validate chooses the options for each category by the
scores of the other categories, and --pictures draws labels; see
docs/notes/segmentation-benchmarks.md. Needs numpy.
"""
import argparse
import csv
import datetime
import json
import os
import pathlib
import subprocess
import sys
import tempfile

# The code shared by all benchmarks.
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
import perturbations
import segmentation_curves
import segmentation_tables
from compare_rips import processor, save
from segmentation_benchmark import TRUTHS, Benchmark
from segmentation_programs import peer

# The constants of ph-segment that have an option, with the values to try; the default is the first.
GRID = (
    "min-persistence=1,0.7,1.4 min-part=200,100,400 voxel=0.005,0.004,0.006 "
    "plane-distance=0.005,0.006"
)


def perturbation(text):
    kind, _, amounts = text.partition("=")
    if kind not in perturbations.KINDS:
        raise argparse.ArgumentTypeError(
            f"{text!r}: expected one of {', '.join(perturbations.KINDS)}"
        )
    return kind, [float(amount) for amount in amounts.split(",")]


def grid(text):
    return {name: values.split(",") for name, values in (word.split("=") for word in text.split())}


def read_categories(path, frames):
    with path.open(encoding="utf-8", newline="") as file:
        known = {row["frame"]: row["category"] for row in csv.DictReader(file)}
    return {frame: known.get(frame, "other") for frame in frames}


def parse():
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        fromfile_prefix_chars="@",
    )
    path = lambda text: pathlib.Path(text).resolve()
    parser.add_argument("build", type=path, help="build folder, with ph-segment and bench_run")
    parser.add_argument("scenes", type=path, help="folder of frames, *.pcd")
    parser.add_argument(
        "--peer", type=peer, action="append", default=[], help="NAME = COMMAND, repeatable"
    )
    parser.add_argument(
        "--ours",
        action="append",
        metavar="OPTIONS",
        help="ph-segment with these options, repeatable (default: '', '--parts', '--method paper')",
    )
    parser.add_argument(
        "--only",
        action="append",
        metavar="NAME",
        help="only the program of this name, repeatable; results of others in --json stay",
    )
    parser.add_argument(
        "--frames", type=lambda text: text.split(","), help="names without .pcd, comma-separated"
    )
    parser.add_argument(
        "--categories",
        type=path,
        help="CSV file frame,category; frames that are not in it are "
        "'other' (default: segmentation_categories.csv beside this script)",
        default=pathlib.Path(__file__).with_name("segmentation_categories.csv"),
    )
    parser.add_argument(
        "--no-scores",
        dest="scores",
        action="store_false",
        help="keep the scores that are in --json",
    )
    parser.add_argument(
        "--times",
        type=int,
        default=0,
        metavar="N",
        help="also measure, the least of N runs in turn (default: 0, do not)",
    )
    parser.add_argument(
        "--time-limit", type=int, default=600, metavar="SECONDS", help="CPU time of a measured run"
    )
    parser.add_argument(
        "--perturb",
        type=perturbation,
        action="append",
        default=[],
        metavar="KIND=AMOUNTS",
        help="also score frames made worse, repeatable: "
        + "; ".join(f"{name}: {kind.what}" for name, kind in perturbations.KINDS.items()).replace(
            "%", "%%"
        ),
    )
    parser.add_argument(
        "--cross-validate",
        action="store_true",
        help="also choose options of ours by leaving out one category after the other",
    )
    parser.add_argument(
        "--grid",
        type=grid,
        default=grid(GRID),
        metavar="OPTION=VALUES…",
        help=f"what to choose from (default: '{GRID}')",
    )
    parser.add_argument(
        "--pictures", type=path, metavar="FOLDER", help="also draw truth and labels, side by side"
    )
    parser.add_argument("--shaded", action="store_true", help="pictures shaded by depth")
    parser.add_argument("--svg", type=path, metavar="FILE", help="draw what --perturb found")
    parser.add_argument(
        "--jobs",
        type=int,
        default=1,
        help="programs run at once; times are taken one by one (default: 1)",
    )
    parser.add_argument(
        "--json", type=path, help="all results; what it holds already is kept or replaced"
    )
    return parser.parse_args()


def fill(report, benchmark, arguments, keep):
    """Adds the requested results to the report; calls keep() after each of them."""
    categories = report["categories"]
    for program in benchmark.programs if arguments.scores else []:
        report["scores"][program.name] = {
            **report["scores"].get(program.name, {}),
            **benchmark.scores(program),
        }
        keep()
    for kind, amounts in arguments.perturb:
        known = report["curves"].setdefault(kind, {})
        for amount in amounts:
            known[f"{amount:g}"] = {**known.get(f"{amount:g}", {}), **benchmark.curve(kind, amount)}
            print(f"{kind} {amount:g}: {known[f'{amount:g}']}", file=sys.stderr, flush=True)
            keep()
    for truth in TRUTHS if arguments.cross_validate else []:
        report["cross_validation"][truth] = benchmark.cross_validation(truth, categories)
        keep()
    if arguments.times:
        report["load"] = [os.getloadavg()[0]]
        for name, frames in benchmark.times().items():
            report["times"][name] = frames
        report["load"].append(os.getloadavg()[0])
        keep()
    if arguments.pictures:
        benchmark.pictures(arguments.pictures)


def main():
    arguments = parse()
    report = {}
    if arguments.json and arguments.json.exists():
        report = json.loads(arguments.json.read_text())
    with tempfile.TemporaryDirectory() as folder:
        benchmark = Benchmark(arguments, pathlib.Path(folder))
        for key in ("scores", "curves", "cross_validation", "times", "peers"):
            report.setdefault(key, {})
        version = subprocess.run(
            [arguments.build / "apps/segment/ph-segment", "--version"],
            capture_output=True,
            text=True,
            check=True,
        )
        report.update(
            machine=f"{processor()}, {os.cpu_count()} processors",
            date=str(datetime.date.today()),
            version=version.stdout.strip(),
            categories=read_categories(
                arguments.categories, [path.stem for path in benchmark.paths]
            ),
        )
        report["peers"].update((p.name, p.text) for p in arguments.peer)
        fill(report, benchmark, arguments, lambda: arguments.json and save(arguments.json, report))
    print(segmentation_tables.markdown(report))
    if arguments.svg:
        arguments.svg.write_text(segmentation_curves.svg(report), encoding="utf-8")


if __name__ == "__main__":
    main()
