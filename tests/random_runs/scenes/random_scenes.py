# SPDX-License-Identifier: MIT
"""random_scenes.py PH_SEGMENT [--runs N] [--seed S] [--jobs J] [--keep FOLDER]

Runs the whole program with random options on random small scenes in each format, and compares its
output with the documentation (scene_oracle.py), which shares no code with the program. Voxels,
components and cuts must agree exactly where the documentation determines them, and otherwise have
the required properties. Each run has its own seed: --seed S --runs 1 repeats the run of seed S. If
there are differences, it exits with 1 and prints the commands; the files are kept in FOLDER
(default: where the script is run)."""
import argparse
import functools
import json
import os
import pathlib
import random
import sys

try:
    import numpy as np
    import scipy  # noqa: F401
except ModuleNotFoundError:
    print("SKIPPED: no numpy or no scipy")
    sys.exit(77)

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.dirname(HERE), os.path.join(HERE, "../../support")]
import formats  # noqa: E402
import many_runs  # noqa: E402
import scene_checks  # noqa: E402
import scene_files  # noqa: E402
import scene_follow_ups  # noqa: E402
import scene_oracle as oracle  # noqa: E402
import scenes  # noqa: E402
from random_runs import damaged  # noqa: E402
from scene_checks import Wrong  # noqa: E402
from scene_program import Program  # noqa: E402

BARCODES = {"csv": "csv", "json": "json", "pers": "pers", "dipha": "dipha", "npy": "npy"}
# Options that make no sense, or have no effect with these methods. An empty list of methods means
# any method, or any cloud.
SENSELESS = [
    *((option, "surface supervoxels") for option in ("--distance 0.1", "--steps 3")),
    *((option, "paper") for option in ("--min-part 3", "--min-persistence 1", "--plane-noise 0.1", "--cut 1e39")),
    *((option, "paper supervoxels") for option in ("--parts", "--objects")),
    ("--supervoxels 1e-35", "supervoxels"), ("--color none.png", "cloud"),
    ("--depth-scale 0.5", "cloud"),
    *((option, "") for option in (
        "--voxel 0", "--voxel nan", "--voxel 1e31", "--voxel 1e-31", "--min-size 0", "--max-range -1", "--cut -1",
        "--crop 1,0,0,1,0,1", "--crop 1,2,3", "--viewpoint inf,0,0", "--plot-view 10,10", "--stable-labels",
        "--plane maybe", "--threads -1", "--explain 1,1", "--explain 1", "--explain 1,4000000", "--plot p.gif",
        "--labels l.txt", "--cut nan", "--memory-limit x", "--no-such", "--size 0x0 --plot p.svg", "--size 9x9"))]


def outputs_for(rng, scene, organised):
    """Random outputs, including the summary and the labels. @return the name of each kind of
    output."""
    names = {"json": rng.choice(["s.json", "s.json", "-"])}
    ways = ["npy", "csv"] + (["png"] if organised else [])
    names["labels"] = f"l.{rng.choice(ways)}"
    for kind, chance, choices in (
            ("surfaces", 0.15, [f"f.{w}" for w in ways]), ("tree", 0.5, ["t.json"]), ("stored", 0.0, ["t.tree"]),
            ("barcode", 0.4, [f"b.{e}" for e in BARCODES.values()]), ("output", 0.25, ["o.pcd", "o.ply", "O.PCD"]),
            ("coloured", 0.1, ["k.pcd", "k.ply"]), ("picture", 0.1 * organised, ["p.png"]),
            ("report", 0.02, ["r.html"]), ("plot", 0.06, ["q.svg", "q.png"])):
        if rng.random() < chance:
            names[kind] = rng.choice(choices)
    return names


def output_options(rng, names):
    options = []
    for kind, name in names.items():
        word = {"output": rng.choice(["-o", "--output"]), "coloured": rng.choice(["--coloured", "--colored"])}
        options.append([word.get(kind, f"--{kind}"), name])
    if "plot" in names:
        options[-1] += ["--plot-kind", rng.choice(["barcode", "diagram", "betti", "tree", "cloud"])]
        if options[-1][-1] == "cloud" and rng.random() < 0.5:
            options[-1] += ["--plot-view", "30,-10"]
        if rng.random() < 0.3:
            options[-1] += ["--size", "300x200", "--title", "a & b"]
    return options


def side_options(rng):
    """Options that do not change the result."""
    options = [["--threads", rng.choice("123")]] if rng.random() < 0.5 else []
    options += [["--memory-limit", rng.choice(["512MiB", "1GiB", "100MB", "4e8"])]] if rng.random() < 0.2 else []
    return options + rng.choice([[], [["--quiet"]], [["--verbose"]], [["--progress", "json"]], [["--progress", "bar"]]])


def expected_refusal(scene, asked):
    """@return the documented exit codes (none if no refusal is expected), and the text that the
    message names."""
    if asked.method == "supervoxels" and asked.spacing < asked.voxel_edge():
        return (64,), "--supervoxels"
    if not 1e-30 <= asked.voxel_edge() <= 1e30:
        return (64,), "--voxel"
    if asked.method == "paper" and asked.value() > asked.distance:
        return (64,), "--cut"
    if len(scene.xyz) == 0 and not asked.allow_empty:
        return (65,), "--allow-empty"
    return (), ""


def may_be_too_fine(scene, asked):
    """True if coordinates may exceed 2^52 times the edge of a voxel."""
    xyz = abs(oracle.as_floats(scene.xyz))
    top = xyz[np.isfinite(xyz)].max(initial=0)
    return top / asked.voxel_edge() >= 2.0 ** 52 - 1


def check_run(program, check, names):
    """Checks all outputs of a run against each other."""
    check.all()
    tree = json.loads(program.output(names["tree"])) if "tree" in names else None
    if tree:
        check.tree(tree)
    if "barcode" in names:
        check.barcode(formats.read_barcode(program.output(names["barcode"]), names["barcode"].split(".")[1]))
    for kind in ("output", "coloured"):
        if kind in names:
            check.cloud(program.output(names[kind]), kind == "output")
    if "surfaces" in names:
        name, count = names["surfaces"], len(check.json["surfaces"])
        found = scene_files.read_labels(program.output(name), name, len(check.xyz), check.file.shape)
        scene_checks.require(set(found.tolist()) <= set(range(count + 1)), "surfaces out of range")
        scene_checks.require(not ((found > 0) & (check.labels > 0)).any(), "a point in a segment and on a surface")
    for kind, starts in (("picture", (b"\x89PNG",)), ("report", (b"<!doctype html", b"<!DOCTYPE html")),
                         ("plot", (b"\x89PNG", b"<?xml", b"<svg"))):
        if kind in names:
            scene_checks.require(program.output(names[kind]).startswith(starts), f"{kind} begins otherwise")
    return tree


def refuse(rng, program, scene, file, asked, words):
    """Adds an option that must be refused."""
    extra, where = rng.choice(SENSELESS)
    extra = extra.split()
    fits = not where or asked.method in where or (where == "cloud" and scene.depth is None)
    twice = {word for w in words for word in w} | ({"--min-persistence"} if asked.cut_name == "--cut" else {"--cut"})
    if not fits or extra[0] in {word.split("=")[0] for word in twice} or \
            ("--plot" in twice and extra[0] in ("--plot", "--plot-view", "--size")) or \
            (extra[0] == "--explain" and ["--json", "-"] in words) or \
            (extra[0] == "--supervoxels" and asked.voxel_edge() < 1e-35):
        return "senseless option, left out"
    program([*words, extra])
    program.expect_refusal((64,), extra[0])
    return "senseless option"


def missing(rng, program, scene, file, asked, words):
    """Checks that a missing input, or a missing folder of an output, is refused."""
    if rng.random() < 0.5:
        output, name = rng.choice([("--labels", "none/l.npy"), ("--json", "none/o.json"), ("--tree", "none/t.tree")])
        program([*(w for w in words if w[0] != output), [output, name]])
        program.expect_refusal((73,), "none/")
        return "no place for an output"
    name = rng.choice(["none.pcd", "."]) if scene.depth is None else "none.png"
    program([[word if word != file.name else name for word in w] for w in words])
    program.expect_refusal((66,), "none" if name != "." else "directory")
    return "no input"


def one_run(path, seed, folder):
    """Runs the program once. @return the kind of run, for the counts. @throws Difference"""
    rng, np_rng = random.Random(seed), np.random.default_rng(seed)
    program = Program(path, folder)
    scene = scenes.random_scene(rng, np_rng)
    asked = scenes.random_options(rng, scene)
    file = scene_files.depth_file(rng, scene) if scene.depth is not None else scene_files.cloud_file(rng, scene)
    is_damaged = rng.random() < 0.1
    inputs = [(file.name, file.content), *file.others]
    if is_damaged:  # one of the files, with bytes changed or the end left out
        k = rng.randrange(len(inputs))
        name, content = inputs[k]
        inputs[k] = name, damaged(rng, content) if rng.random() < 0.8 else content[:rng.randrange(len(content) + 1)]
    for name, content in inputs:
        pathlib.Path(folder, name).write_bytes(content)
    names = outputs_for(rng, scene, bool(file.shape) and file.shape[0] > 1)
    source = [["--depth", file.name]] if scene.depth is not None and (scene.colours is not None or rng.random() < 0.5) \
        else [[file.name]]
    words = [*source, *file.options, *asked.options(), *side_options(rng), *output_options(rng, names)]
    rng.shuffle(words)
    if not is_damaged and rng.random() < 0.1 and not expected_refusal(scene, asked)[0]:
        return rng.choice([refuse, refuse, refuse, missing])(rng, program, scene, file, asked, words)
    code = program(words)
    kind = f"{scene.kind}, {asked.method}"
    if code != 0:
        codes, needle = expected_refusal(scene, asked)
        if is_damaged:
            codes, needle = (64, 65, 66, 75), ""
        elif not codes and may_be_too_fine(scene, asked):
            codes, needle = (64,), ""
        program.expect_refusal(codes, needle)
        return "damaged, refused" if is_damaged else "refused"
    if expected_refusal(scene, asked)[0] and not is_damaged:
        program.differ(f"found a result, expected exit {expected_refusal(scene, asked)[0]}")
    try:
        summary = json.loads(program.run.stdout if names["json"] == "-" else program.output("s.json"))
        if is_damaged:
            valid(program, summary, names)
            return "damaged, read"
        labels = scene_files.read_labels(program.output(names["labels"]), names["labels"], len(scene.xyz), file.shape)
        check = scene_checks.Check(scene, file, asked, summary, labels, None if ["--quiet"] in words else program.said)
        tree = check_run(program, check, names)
        program.last_line(summary, words)
        follow = rng.choice(scene_follow_ups.ALL) if rng.random() < 0.6 else None
        if follow:
            follow(rng, np_rng, program, check, tree, source, names)
    except (Wrong, AssertionError, KeyError, IndexError, ValueError, OSError, StopIteration) as error:
        if isinstance(error, (Wrong, AssertionError)):
            program.differ(str(error))
        program.differ(repr(error))
    return kind + (", not all determined" if check.unsure else "")


def valid(program, summary, names):
    """Checks that labels and segments agree, whatever the damaged bytes mean."""
    count = summary["input"]["points"]
    labels = scene_files.read_labels(program.output(names["labels"]), names["labels"], count, ())
    scene_checks.expect("labels", len(labels), count)
    scene_checks.expect("points", [s["points"] for s in summary["segments"]],
                        np.bincount(labels, minlength=1)[1:].tolist())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    many_runs.add_options(parser, 500)
    options = parser.parse_args()
    many_runs.run_all(functools.partial(one_run, str(options.program.resolve())), options, "random-scene")



if __name__ == "__main__":
    main()
