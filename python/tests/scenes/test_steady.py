# SPDX-License-Identifier: MIT
"""Tests that labels, roles and the plane stay stable over ten frames of one scene."""
import json
import os
import pickle
import subprocess
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import libph as ph
from sequences import (BESIDE, FRAMES, LARGE, ROOM_CAMERA, SMALL, TABLE, WALL, noise_on, read_png,
                       room, seen_again)

TEST_DATA = os.environ.get("PH_TEST_DATA", "")
UCN, YCB = (612.937, 613.173, 322.549, 248.158), (1066.778, 1067.487, 312.9869, 241.3109)
OSD = (525.0, 525.0, 319.5, 239.5)
REAL = {"ucn0": (UCN, 1000), "ucn1": (UCN, 1000), "ucn2": (UCN, 1000), "ucn3": (UCN, 1000),
        "ucn4": (UCN, 1000), "ycb01": (YCB, 10000), "ycb05": (YCB, 10000), "ycb10": (YCB, 10000),
        "osd-learn6": (OSD, 1000)}


def tracked(depths, camera, **options):
    """Segmentations of consecutive frames, and the identities of the objects in each frame."""
    tracker, scene, frames = ph.LabelTracker(), None, []
    for depth in depths:
        scene = ph.segment(depth, intrinsics=camera, previous=scene, check=False, **options)
        frames.append((scene, tracker.update(scene)))
    return frames


def changes(frames, what):
    """For each object, how often a property differs from its value in the previous frame; and the
    total number of comparisons."""
    before, count, all_ = {}, Counter(), 0
    for scene, objects in frames:
        now = {}
        for thing, found in zip(objects, scene.objects):
            now[thing.number] = what(thing, found, objects)
        count.update(n for n in now if n in before and now[n] != before[n])
        all_ += sum(n in before for n in now)
        before = now
    return count, all_


def held_role(thing, found, objects):
    return thing.role


def held_support(thing, found, objects):
    """What an object stands on, under a name that is the same in all frames."""
    if thing.on and thing.on[0] == "object":
        return objects[thing.on[1] - 1].number
    return thing.on


def single_support(thing, found, objects):
    if found.on and found.on[0] == "object":
        return objects[found.on[1] - 1].number
    return found.on


def angle(a, b):
    return np.degrees(np.arccos(np.clip(np.dot(a, b), -1, 1)))


def test_ten_frames_of_a_room():
    rng = np.random.default_rng(7)
    seen = [room(rng) for _ in range(FRAMES)]
    frames = tracked([depth for depth, _ in seen], ROOM_CAMERA, max_range=4.0)
    numbers = {block: set() for block in (LARGE, SMALL, BESIDE)}
    roles, surfaces, offsets = set(), set(), []
    for (scene, objects), (_, block) in zip(frames, seen):
        for which in numbers:
            labels = scene.labels[(block == which) & (scene.labels > 0)]
            thing = objects[np.bincount(labels).argmax() - 1]
            on = objects[thing.on[1] - 1].number if thing.on[0] == "object" else thing.on
            numbers[which].add((thing.number, thing.role, on))
        for which in (TABLE, WALL):
            surface = scene.surface_labels[block == which]
            surfaces.add((which, int(np.bincount(surface).argmax())))
        roles.update(surface.role for surface in scene.surfaces)
        assert [surface.role for surface in scene.surfaces] == ["support", "wall"]
        offsets.append(scene.meta["plane"][3])
        assert angle(scene.meta["plane"][:3], (0, -np.sqrt(0.5), -np.sqrt(0.5))) < 1
    assert surfaces == {(TABLE, 1), (WALL, 2)}
    (large, role, on), = numbers[LARGE]
    assert (role, on) == ("object", ("surface", 0))
    assert {(r, o) for _, r, o in numbers[SMALL]} == {("object", large)}
    assert {(r, o) for _, r, o in numbers[BESIDE]} == {("object", ("surface", 0))}
    assert [len(each) for each in numbers.values()] == [1, 1, 1]
    assert np.ptp(offsets) < 0.01


def test_the_program_says_the_same(tmp_path):
    program = os.environ.get("PH_SEGMENT", "")
    if not os.access(program, os.X_OK):
        pytest.skip("PH_SEGMENT names no program")
    rng = np.random.default_rng(8)
    depths = [room(rng)[0] for _ in range(4)]
    for t, depth in enumerate(depths):
        np.save(tmp_path / f"{t}.npy", depth)
    done = subprocess.run(
        [program, *sorted(tmp_path.glob("*.npy")), "--intrinsics", ",".join(map(str, ROOM_CAMERA)), "--max-range", "4",
         "--depth-scale", "1", "--stable-labels", "--no-check", "--json", tmp_path / "all.jsonl"],
        capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    lines = (tmp_path / "all.jsonl").read_text().splitlines()
    for line, (scene, objects) in zip(lines, tracked(depths, ROOM_CAMERA, max_range=4.0)):
        said = json.loads(line)["segments"]
        assert [(s["label"], s["role"]) for s in said] == [(o.number, o.role) for o in objects]
        on = [o.on and ({"surface": o.on[1] + 1} if o.on[0] == "surface" else
                        {"segment": objects[o.on[1] - 1].number}) for o in objects]
        assert [s["on"] for s in said] == on
    assert len(lines) == 4


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize("name", REAL)
def test_ten_frames_of_a_real_scene(name):
    path = Path(TEST_DATA, "scenes/uncropped", f"{name}-depth.png")
    if not TEST_DATA or not path.exists():
        pytest.skip(f"PH_TEST_DATA, which is {TEST_DATA!r}, has no scenes/uncropped/{path.name}")
    camera, unit = REAL[name]
    depth = read_png(path) / unit
    depth[depth == 0] = np.nan
    first = ph.segment(depth, intrinsics=camera, check=False)
    noise = noise_on(depth, camera, first.meta["plane"])
    rng = np.random.default_rng(1)
    frames = tracked([depth, *(seen_again(depth, camera, noise, rng) for _ in range(FRAMES - 1))],
                     camera)
    roles, pairs = changes(frames, held_role)
    support, single = (changes(frames, what)[0] for what in (held_support, single_support))
    large = {t.number for t, o in zip(frames[1][1], frames[1][0].objects) if o.points >= 1000}
    kept = [len(large & {t.number for t in objects}) / len(large) for _, objects in frames[1:]]
    planes = np.array([scene.meta["plane"] for scene, _ in frames])
    turn = max(angle(planes[0, :3], plane[:3]) for plane in planes)
    print(f"{name}: noise {1e3 * noise:.1f} mm, {pairs} objects of the frame before: "
          f"{roles.total()} roles and {support.total()} supports changed ({single.total()} by "
          f"single frames); "
          f"large ones kept: {min(kept):.2f}; the plane turned by {turn:.2f} degrees")
    # A role may change once, because the first frame may have been wrong. No role alternates.
    assert max(roles.values(), default=0) <= 1 and roles.total() <= 1
    assert support.total() <= max(1, single.total() / 4)
    assert min(kept) >= 0.8
    assert turn < 1 and np.ptp(planes[:, 3]) < 0.01


@pytest.mark.parametrize("frame, words", [
    (np.array([[0.5]]), "whole number"), (np.array([-1]), "found labels from -1"),
    (np.array(["a"]), "expected numbers"), (np.array([2**32]), "expected 0 to 4294967295")])
def test_labels_that_are_none(frame, words):
    with pytest.raises(ph.Error, match=words):
        ph.LabelTracker().update(frame)


def test_bounds_of_a_tracker():
    with pytest.raises(ph.UsageError, match="patience: found -1"):
        ph.LabelTracker(patience=-1)
    with pytest.raises(ph.UsageError, match="cell: found 0"):
        ph.LabelTracker(cell=0)
    forgetful = ph.LabelTracker(patience=0)
    one, none = np.array([[1, 1]]), np.array([[0, 0]])
    assert forgetful.update(one).tolist() == [[1, 1]]
    forgetful.update(none)
    assert forgetful.update(one).tolist() == [[2, 2]]


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_a_tracker_is_of_one_stream(protocol):
    with pytest.raises(TypeError, match="cannot pickle a LabelTracker"):
        pickle.dumps(ph.LabelTracker(), protocol)
