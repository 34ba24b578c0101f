# SPDX-License-Identifier: MIT
"""Processes the same scene in other ways, which must give the same labels."""
import copy
import dataclasses
import json
import pathlib

import numpy as np

import scene_files
import scene_oracle as oracle
import scenes
from scene_checks import expect, require

EXPLAINED = "segments {} and {} "


def plain_words(check, source):
    return [*source, *check.file.options, *check.asked.options()]


def labels_of(program, name, check, shape=None):
    return scene_files.read_labels(program.output(name), name, len(check.xyz), shape)


def written(program, check, file):
    pathlib.Path(program.folder, file.name).write_bytes(file.content)


def same_labels(program, check, words, shape, stdin=None):
    program.must([*words, ["--labels", "again.npy"]], stdin)
    found = labels_of(program, "again.npy", check, shape)
    require((found == check.labels).all(), f"labels: found {found.tolist()}, expected {check.labels.tolist()}")


def same_bytes(rng, np_rng, program, check, tree, source, names):
    """Options in another order and another number of threads: all files are the same, except for
    times."""
    words = [*plain_words(check, source), ["--threads", rng.choice("234")]]
    kept = {k: n for k, n in names.items() if k not in ("json", "report")}
    rng.shuffle(words)
    program.must([*words, *([f"--{k}", n.replace(".", "2.", 1)] for k, n in kept.items() if k != "plot")])
    for kind, name in kept.items():
        if kind != "plot" and not (kind == "barcode" and name.endswith(".json")):
            require(program.output(name) == program.output(name.replace(".", "2.", 1)), f"{name}: other bytes")


def standard_input(rng, np_rng, program, check, tree, source, names):
    if check.file.form in ("pts", "csv") or check.scene.depth is not None:
        return  # these formats are recognised by the file's name
    same_labels(program, check, [["-"], *check.asked.options()], check.file.shape, check.file.content)


def other_format(rng, np_rng, program, check, tree, source, names):
    """The same points in another format, possibly as 32-bit floats, have the same labels."""
    scene = dataclasses.replace(check.scene, xyz=check.xyz, viewpoint=tuple(check.json["viewpoint"]), depth=None,
                                extra=[])
    forms = [f for f in scene_files.CLOUDS if f != "pts" or len(check.xyz)]
    finite = np.isfinite(check.scene.xyz).all() or np.isnan(check.scene.xyz).any()
    file = scene_files.cloud_file(rng, scene, rng.choice(forms if finite else forms[:6]))
    file.name = "other-" + file.name
    written(program, check, file)
    asked = dataclasses.replace(check.asked, viewpoint=tuple(check.json["viewpoint"]))
    asked.allow_empty = asked.allow_empty or len(check.xyz) == 0
    same_labels(program, check, [[file.name], *asked.options()], file.shape)


def shuffled(rng, np_rng, program, check, tree, source, names):
    """With the points in another order, each point has the same label."""
    if len(check.xyz) == 0:
        return
    order = np_rng.permutation(len(check.xyz))
    scene = dataclasses.replace(check.scene, xyz=check.xyz[order], shape=None, colours=None, normals=None, extra=[])
    file = scene_files.cloud_file(rng, scene, rng.choice(scene_files.CLOUDS[:6]))
    file.name = "shuffled-" + file.name
    written(program, check, file)
    asked = dataclasses.replace(check.asked, viewpoint=tuple(check.json["viewpoint"]))
    program.must([[file.name], *asked.options(), ["--labels", "again.npy"]])
    found, expected = labels_of(program, "again.npy", check), check.labels[order]
    require((found == expected).all(), f"labels: found {found.tolist()}, expected {expected.tolist()}")


def table(rng, np_rng, program, check, tree, source, names):
    """Without an output, the program prints one line per segment."""
    program.must(plain_words(check, source))
    lines = program.run.stdout.decode().splitlines()
    expect("header", lines[0].split()[:3], ["label", "points", "voxels"])
    expect("segments", len(lines) - 1, len(check.json["segments"]))
    for line, s in zip(lines[1:], check.json["segments"]):
        words = line.split()
        expect("numbers", [int(w) for w in words[:3]], [s["label"], s["points"], s["voxels"]])
        size = [high - low for low, high in zip(s["box"]["min"], s["box"]["max"])]
        for word, value in zip(words[3:], s["centroid"] + size):
            require(abs(float(word) - value) <= 0.000051 + 1e-9 * abs(value), f"found {word}, expected {value}")


def explain(rng, np_rng, program, check, tree, source, names):
    count = len(check.json["segments"])
    if count > 1 and tree is None:
        program.must([*plain_words(check, source), ["--tree", "for-explain.json"]])
        tree = json.loads(program.output("for-explain.json"))
    if count < 2:
        a, b = count + 1, count + 2
        program([*plain_words(check, source), ["--explain", f"{a},{b}"]])
        return program.expect_refusal((64,), "--explain")
    a, b = rng.sample(range(1, count + 1), 2)
    of_vertex = np.zeros(len(tree["vertices"]), int)
    of_point = np.array(tree["vertex_of_point"])
    of_vertex[of_point[check.labels > 0]] = check.labels[check.labels > 0]
    program.must([*plain_words(check, source), ["--explain", f"{a},{b}"]])
    said, value = program.run.stdout.decode(), oracle.meeting(tree, of_vertex, a, b)
    require(said.startswith(EXPLAINED.format(a, b)) and said.count("\n") == 1, f"found {said!r}")
    if value is None:
        return require("never join" in said, f"found {said!r}, expected that they never join")
    return expect("value", float(said.split(" at ")[1].split(",")[0]), value)


def stored_tree(rng, np_rng, program, check, tree, source, names):
    """Cuts a stored tree with the same options, and with other options."""
    program.must([*plain_words(check, source), ["--tree", "t.tree"], ["--labels", "first.npy"]])
    check.stored(program.output("t.tree"), tree)
    program.must([["t.tree"], ["--labels", "second.npy"], ["--tree", "again.tree"], ["--json", "again.json"]])
    require(program.output("first.npy") == program.output("second.npy"), "labels of a stored tree: other bytes")
    require(program.output("t.tree") == program.output("again.tree"), "a stored tree of a stored tree: other bytes")
    again = json.loads(program.output("again.json"))
    expect("segments of a stored tree", again["segments"], [s | {"signature": None} for s in check.json["segments"]])
    asked = copy.copy(check.asked)
    asked.cut = asked.min_size = asked.min_part = None
    scenes.other_cut(rng, asked, check.scene)
    program.must([["t.tree"], *cut_options(asked), ["--labels", "second.npy"]])
    if check.json["plane"]["found"] and asked.method == "surface":
        return  # the tree keeps the vessel walls and bottoms that the first cut found
    program.must([*source, *check.file.options, *dataclasses.replace(asked).options(), ["--labels", "first.npy"]])
    require(program.output("first.npy") == program.output("second.npy"), "another cut of a stored tree: other bytes")


def cut_options(asked):
    """Options for the same cut. All values are given, because the program takes missing values from
    the tree."""
    full = copy.copy(asked)
    full.cut, full.min_size = float(full.value()), full.least_voxels()
    if full.method != "paper":
        full.min_part = full.least_part()
    return full.cut_options() + ([["--objects"]] if full.method == "surface" and not full.parts else [])


def stream(rng, np_rng, program, check, tree, source, names):
    """The frames of a stream have the same labels as single frames. A failing frame does not affect
    the others."""
    if check.scene.depth is not None or check.asked.plane or ".gz" in check.file.name:
        return  # the search for the plane begins at the plane of the previous frame
    folder = pathlib.Path(program.folder)
    other = dataclasses.replace(check.scene, xyz=check.xyz[::-1].copy(), shape=None, colours=None, normals=None,
                                extra=[])
    frames = [check.file.name, "other.ply"]
    (folder / "other.ply").write_bytes(scene_files.cloud_file(rng, other, "ply-little").content
                                       if len(check.xyz) else b"ply\n")
    fails = rng.random() < 0.3
    if fails:
        frames.insert(rng.randrange(3), "none.pcd")
        (folder / "none.pcd").write_bytes(b"VERSION 0.7\nFIELDS x\n")
    options = check.asked.options()
    lists = rng.random() < 0.3
    (folder / "frames.txt").write_text("\n".join(frames) + "\n")
    given = [["--frames-from", rng.choice(["frames.txt", "-"])]] if lists else [[name] for name in frames]
    (folder / "out").mkdir(exist_ok=True)
    code = program([*given, *options, ["--labels", "out/"], ["--json", "frames.json"]], "\n".join(frames).encode())
    good = [f for f in frames if f != "none.pcd" and not (f == "other.ply" and len(check.xyz) == 0)]
    expect("exit code of a stream", code, 0 if len(good) == len(frames) else 65)
    lines = [json.loads(line) for line in program.output("frames.json").decode().splitlines()]
    expect("frames", [line["input"]["path"] for line in lines], frames)
    expect("frames that failed", ["exit_code" in line for line in lines], [f not in good for f in frames])
    for name in good:
        program.must([[name], *options, ["--labels", "one.npy"]])
        content = (folder / "out" / (pathlib.Path(name).stem + ".npy")).read_bytes()
        require(content == program.output("one.npy"), f"frame {name}: other bytes than by itself")


def over_input(rng, np_rng, program, check, tree, source, names):
    """An output that is also the input is refused; with --force it is overwritten."""
    if check.scene.depth is not None or not check.file.name.endswith((".pcd", ".ply")):
        return
    words = [*plain_words(check, source), ["-o", rng.choice(["", "./"]) + check.file.name]]
    program(words)
    program.expect_refusal((64,), "--output")
    program.must([*words, ["--force"]])
    check.cloud(program.output(check.file.name))


def little_memory(rng, np_rng, program, check, tree, source, names):
    """With little memory, the result is the same, or the exit code is 75."""
    words = [*plain_words(check, source), ["--memory-limit", rng.choice(["1", "1kB", "20kB", "100kB", "1MB", "3MiB"])],
             ["--labels", "small.npy"]]
    if program(words) == 0:
        found = labels_of(program, "small.npy", check, check.file.shape)
        return require((found == check.labels).all(), "other labels with a memory limit")
    return program.expect_refusal((75,), "--memory-limit")


def signatures(rng, np_rng, program, check, tree, source, names):
    """Each segment has one component that is born at 0 and never dies."""
    program.must([*plain_words(check, source), ["--signatures"], ["--json", "g.json"], ["--threads", rng.choice("12")]])
    for s in json.loads(program.output("g.json"))["segments"]:
        bars = s["signature"]
        if bars is None:
            require("no signature" in program.said, "a segment without a signature, and no note")
            continue
        whole = [b for b in bars["h0"] if b[1] is None]
        expect("pieces that never die", len(whole), 1)
        for birth, death in bars["h0"] + bars["h1"] + bars["h2"]:
            require(death is None or death - birth > check.json["voxel"] * (1 - 1e-9),
                    f"a bar no longer than a voxel: {birth}, {death}")


ALL = [same_bytes, standard_input, other_format, other_format, shuffled, table, explain, explain, stored_tree,
       stored_tree, stream, over_input, little_memory, signatures]
