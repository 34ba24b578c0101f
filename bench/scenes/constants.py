#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures on how many frames each constant of the segmentation has an effect, and writes the
numbers into bench/results/segmentation-constants.csv.

    constants.py FOLDER --scenes SCENES

FOLDER receives a copy of the sources, a build of it, the generated frames and the scores of the
unchanged program; a later run uses them again. SCENES are PCD files with ground truth in a field
`label`, or folders of them. Each constant is changed in the copy as the column `change` says:

    x 1.5 and / 1.5     both products; integers are rounded
    + 1 and - 1         both sums
    to A and B          these values, as in C++; or only one
    off: A              this value
    none: INPUTS        the constant is not measured

ph-segment is then built and run on all frames, with and without --parts. A frame counts if its F of
objects or of parts differs by more than .01 for at least one change. If fewer than three visible or
generated frames count, the constant is measured on rare frames as well: on things without a table
(lone_things.py), and on frames of which one point in sixteen is left. Needs numpy, git, cmake and
ninja.
"""

import argparse
import csv
import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from typing import NamedTuple

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "bench/segmentation"))
import arrangements
import declarations
import frames
import lone_things
import point_clouds
import score
import segmentation_metrics

TABLE = "bench/results/segmentation-constants.csv"
LIBRARY = "libsegment"
SCRIPT = "bench/scenes/constants.py"
LEAST = 0.01  # a smaller difference of F does not count
MAKERS = [
    *("arrangements.py", "cameras.py", "frames.py", "lone_things.py"),
    *("placing.py", "shapes.py", "things.py"),
]
GROUPS = "visible", "generated", "rare"
FEW = 3  # frames: a constant that fewer visible and generated frames feel is measured on rare ones
TIMEOUT = 60  # seconds of one run, which takes less than one


class Frame(NamedTuple):
    group: str  # the column of the table: visible, generated or rare
    path: pathlib.Path
    truth: pathlib.Path
    options: tuple


def digest(*paths):
    return hashlib.sha256(b"".join(path.read_bytes() for path in paths)).hexdigest()[:16]


def with_truth(group, path, folder, options=()):
    """The frame of a PCD file. The labels, which take long to read, are kept in the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    truth = folder / f"{path.stem}.npy"
    if not truth.exists():
        numpy.save(truth, point_clouds.read_scene(path).truth)
    return Frame(group, path, truth, tuple(options))


def visible(scenes, without, folder):
    paths = [p for s in scenes for p in (sorted(s.glob("*.pcd")) if s.is_dir() else [s])]
    return [
        with_truth("visible", path.resolve(), folder / "visible")
        for path in paths
        if path.stem not in without
    ]


def made(group, name, folder, make, options=()):
    """A frame that is made again if a script that makes frames has changed. @param make a function
    without arguments that returns the arguments of point_clouds.write_scene after the path."""
    folder = folder / f"{group}-{digest(*(ROOT / 'bench/scenes' / name for name in MAKERS))}"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.pcd"
    if not path.exists():
        point_clouds.write_scene(path, *make())
    return with_truth(group, path, folder, options)


def generated(kinds, seeds, folder):
    """The frames of score.py."""
    return [
        made(
            "generated",
            f"{kind}-{seed}",
            folder,
            lambda kind=kind, seed=seed: frames.frame(kind, seed),
            score.RANGE.get(kind, "").split(),
        )
        for kind in kinds
        for seed in seeds
    ]


def thinned(kind, seed):
    """A frame of which one point in sixteen is left."""
    scene, _ = frames.frame(kind, seed)
    scene.points[numpy.random.default_rng(seed).random(len(scene.points)) > 1 / 16] = numpy.nan
    return (scene,)


def rare(seeds, folder):
    """A frame of each kind of lone_things.py, and sparse frames."""
    found = [
        made("rare", name.replace(", ", "-").replace(" ", "-"), folder,
             lambda case=case: (next(lone_things.frames_of(case)),))
        for name, case in lone_things.CASES.items()
    ]  # fmt: skip
    return found + [
        made("rare", f"sparse-{kind}-{seed}", folder,
             lambda kind=kind, seed=seed: thinned(kind, seed))
        for kind in ("table", "stack", "clutter")
        for seed in seeds
    ]  # fmt: skip


class Failure(Exception):
    """A change with which the sources do not compile."""


class Copy:
    """A copy of the sources, in which constants are changed, and its build."""

    def __init__(self, folder, jobs):
        self.tree, self._build, self._jobs = folder / "tree", folder / "build", jobs
        names = self._run("git", "-C", ROOT, "ls-files", "-z").split("\0")
        for name in filter(None, names):
            self._bring(name)
        self._run(
            "cmake", "-S", self.tree, "-B", self._build, "-G", "Ninja",
            "-DCMAKE_BUILD_TYPE=Release", "-DPH_BUILD_TESTS=OFF", "-DPH_BUILD_PYTHON=OFF",
            "-DPH_BUILD_EXAMPLES=OFF",
        )  # fmt: skip
        self.program = self._build / "apps/segment/ph-segment"

    @staticmethod
    def _run(*command):
        run = subprocess.run(
            [str(word) for word in command], capture_output=True, text=True, check=False
        )
        if run.returncode != 0:
            raise Failure(f"{command[0]}: {(run.stdout + run.stderr)[-2000:]}")
        return run.stdout

    def _bring(self, name):
        """Copies a file unless the copy is the same, which keeps what was built from it."""
        source, copy = ROOT / name, self.tree / name
        if not source.is_file():
            return
        if not copy.exists() or copy.read_bytes() != source.read_bytes():
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(source.read_bytes())
            copy.chmod(source.stat().st_mode)

    def build(self):
        self._run("cmake", "--build", self._build, "-j", self._jobs, "--target", "ph-segment")

    def change(self, constant, file, value):
        path = self.tree / LIBRARY / file
        text = (ROOT / LIBRARY / file).read_text()
        path.write_text(text[: constant.begin] + value + text[constant.end :])

    def restore(self, file):
        self._bring(f"{LIBRARY}/{file}")


def labels_of(program, frame, parts, folder):
    """The labels of a run, with 0 for segments that are not objects; None if the run fails."""
    outputs = [folder / "labels.npy", folder / "summary.json"]
    command = [program, frame.path, "--quiet", "--threads", "1", "--no-check", *frame.options]
    command += ["--labels", outputs[0], "--json", outputs[1], *(["--parts"] if parts else [])]
    try:
        subprocess.run(command, capture_output=True, check=True, timeout=TIMEOUT)
    except subprocess.SubprocessError:
        return None
    summary = json.loads(outputs[1].read_text())
    return score.of_objects(numpy.load(outputs[0]).ravel().astype(numpy.int64), summary)


def scores_of(program, frame, known):
    """F of objects and of parts. @param known the digests of labels that were scored, with F."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for parts in (False, True):
            labels = labels_of(program, frame, parts, pathlib.Path(folder))
            if labels is None:
                found.append(0.0)
                continue
            key = f"{frame.truth.name} {parts} {hashlib.sha256(labels.tobytes()).hexdigest()}"
            if key not in known:
                truth = numpy.load(frame.truth)
                known[key] = segmentation_metrics.score(truth, labels, parts, False).f
            found.append(known[key])
    return found


def baseline_of(copy, all_frames, folder, known):
    """The scores of the unchanged program, which are kept in the folder."""
    path = folder / f"baseline-{digest(copy.program)}.json"
    scores = json.loads(path.read_text()) if path.exists() else {}
    for frame in all_frames:
        if str(frame.path) not in scores:
            scores[str(frame.path)] = scores_of(copy.program, frame, known)
    path.write_text(json.dumps(scores, indent=1))
    return scores


def values(constant, change):
    """The values that a change stands for, as in C++, with the change of each."""
    if of := re.fullmatch(r"off: (.+)", change):
        return {"off": of[1]}
    if of := re.fullmatch(r"to (.+?)(?: and (.+))?", change):
        return {f"to {value}": value for value in of.groups() if value}
    is_whole = re.search(r"\b(int|Index|size_t|u?int\d+_t)\b", constant.type)
    number = declarations.NUMBER

    def every(to):
        text = lambda x: str(round(x)) if is_whole else f"{x:.6g}"
        return number.sub(lambda match: text(to(declarations.value_of(match[0]))), constant.value)

    if change == "x 1.5 and / 1.5":
        return {"x 1.5": every(lambda x: x * 1.5), "/ 1.5": every(lambda x: x / 1.5)}
    if change == "+ 1 and - 1":
        return {"+ 1": every(lambda x: x + 1), "- 1": every(lambda x: x - 1)}
    raise SystemExit(f"{constant.name}: {change!r}: found no such change")


def changed_frames(constant, row, copy, of_group, baseline, known):
    """The frames of a group that at least one change of a constant changes, and the changes with
    which the sources do not compile."""
    file = row["file"]
    changed, failed = set(), []
    for text, value in values(constant, row["change"]).items():
        try:
            copy.change(constant, file, value)
            copy.build()
        except Failure as failure:
            print(f"{file}: {row['name']} = {value}: {failure}", file=sys.stderr)
            failed.append(text)
            continue
        finally:
            copy.restore(file)
        for frame in of_group:
            before, now = baseline[str(frame.path)], scores_of(copy.program, frame, known)
            if any(abs(a - b) > LEAST for a, b in zip(before, now)):
                changed.add(frame)
    return changed, failed


def is_felt(row):
    """True if at least FEW visible and generated frames feel a constant."""
    counts = [re.match(r"\d+", row[group]) for group in ("visible", "generated")]
    return sum(int(count[0]) for count in counts if count) >= FEW


def measure(row, copy, all_frames, baseline, known):
    """Fills the columns of a row that are empty."""
    constants = declarations.constants_in((ROOT / LIBRARY / row["file"]).read_text())
    constant = next((c for c in constants if c.name == row["name"]), None)
    if constant is None:
        print(f"{row['file']}: {row['name']}: found no such constant", file=sys.stderr)
        return
    for groups in (("visible", "generated"), ("rare",)):
        if row[groups[0]] or (groups == ("rare",) and is_felt(row)):
            continue
        of_groups = [frame for frame in all_frames if frame.group in groups]
        changed, failed = changed_frames(constant, row, copy, of_groups, baseline, known)
        note = f"{' and '.join(failed)}: does not compile" if failed else ""
        is_measured = len(failed) < len(values(constant, row["change"]))
        for group in groups:
            of_group = [frame for frame in of_groups if frame.group == group]
            count = sum(frame in changed for frame in of_group)
            text = f"{count} / {len(of_group)}" if is_measured else ""
            row[group] = "; ".join(filter(None, (text, note)))
    row["script"], row["date"] = SCRIPT, datetime.date.today().isoformat()


def read():
    with (ROOT / TABLE).open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def write(rows):
    with (ROOT / TABLE).open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def parse():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=pathlib.Path, help="for the copy, its build and the frames")
    parser.add_argument("--scenes", type=pathlib.Path, nargs="*", default=[])
    parser.add_argument("--without", nargs="*", default=[], metavar="NAME", help="scenes to omit")
    parser.add_argument("--seeds", type=frames.seeds, default=range(3), metavar="A-B")
    parser.add_argument("--kinds", type=frames.kinds, default=list(arrangements.KINDS))
    parser.add_argument(
        "--only", nargs="+", metavar="FILE:NAME", help="measure these; default: unmeasured ones"
    )
    parser.add_argument("--all", action="store_true", help="measure all again")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="of the build")
    return parser.parse_args()


def is_wanted(row, arguments):
    if row["change"].startswith("none: "):
        return False
    if arguments.only:
        return f"{row['file']}:{row['name']}" in arguments.only
    return arguments.all or not row["visible"] or not (row["rare"] or is_felt(row))


def main():
    arguments = parse()
    folder = arguments.folder.resolve()
    all_frames = visible(arguments.scenes, arguments.without, folder)
    all_frames += generated(arguments.kinds, arguments.seeds, folder)
    all_frames += rare(arguments.seeds, folder)
    rows, known = read(), {}
    wanted = [row for row in rows if is_wanted(row, arguments)]
    copy = Copy(folder, arguments.jobs)
    copy.build()
    baseline = baseline_of(copy, all_frames, folder, known)
    for row in wanted:
        if arguments.all or arguments.only:
            row.update(dict.fromkeys(GROUPS, ""))
        measure(row, copy, all_frames, baseline, known)
        write(rows)
        print(*(row[c] for c in ("file", "name", *GROUPS)), sep=", ", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
