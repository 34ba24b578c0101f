# SPDX-License-Identifier: MIT
"""Segmentations that are pickled, copied, and sent to other processes."""
import copy
import multiprocessing
import pickle
import re

import numpy as np
import pytest

import libph as ph
from scenes import CAMERA, TABLE, depth_of_scene, points_of_scene

RNG = np.random.default_rng(11)
POINTS = points_of_scene(RNG)
DEPTH = depth_of_scene(RNG)
COLOURS = RNG.integers(0, 256, (120, 160, 3), dtype=np.uint8)
MADE = {
    "surface": lambda: ph.segment(POINTS),
    "parts": lambda: ph.segment(POINTS, objects=False, check=False),
    "paper": lambda: ph.segment(POINTS, method="paper"),
    "exact": lambda: ph.segment(POINTS, method="paper", steps="exact"),
    "supervoxels": lambda: ph.segment(POINTS, supervoxels=0.04),
    "no plane": lambda: ph.segment(POINTS, plane=False),
    "depth": lambda: ph.segment(DEPTH, intrinsics=CAMERA, colours=COLOURS),
    "file": lambda: ph.segment(TABLE),
    "cut": lambda: ph.segment(POINTS).cut(0.2, min_part=5, min_size=5),
    "nothing": lambda: ph.segment(np.empty((0, 3))),
    "holes": lambda: ph.segment(np.full((4, 6, 3), np.nan)),
}
pytestmark = pytest.mark.filterwarnings("ignore::UserWarning")


@pytest.fixture(scope="module", params=MADE)
def scene(request):
    return MADE[request.param]()


@pytest.fixture(scope="module")
def table():
    return ph.segment(TABLE)


def same(a, b):
    """True if all properties of two segmentations are bitwise equal and have the same types."""
    if isinstance(a, np.ndarray):
        return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()
    if isinstance(a, tuple):
        return type(a) is type(b) and len(a) == len(b) and all(map(same, a, b))
    return type(a) is type(b) and a == b


def told(scene):
    tree = scene.tree
    pairs = [scene.first_meeting(1, s.label) for s in scene.objects if s.label > 1]
    return (scene.labels, tuple(scene.objects), tree.births, tree.values, tree.edges, tree.elder,
            tree.younger, scene.voxels, np.asarray(scene.barcode), tuple(scene.meta.items()),
            tuple(pairs), repr(scene), scene._repr_html_())


# ---- round trips


def test_pickle(scene):
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        other = pickle.loads(pickle.dumps(scene, protocol))
        assert other == scene and hash(other) == hash(scene) and other.objects == scene.objects
        assert dict(other.meta) == dict(scene.meta)
    assert same(told(other), told(scene))
    assert same(told(pickle.loads(pickle.dumps(other))), told(scene))


def test_what_comes_out_can_be_cut(scene):
    other = pickle.loads(pickle.dumps(scene))
    cuts = {"paper": [{"value": 0.01}, {"min_size": 300}],
            "supervoxels": [{"value": 0.02}, {"min_part": 40}],
            "surface": [{"value": 0.001}, {"value": 0.3, "min_part": 10}, {"objects": False}]}
    for cut in cuts[scene.meta["method"]]:
        assert same(told(other.cut(**cut)), told(scene.cut(**cut)))
        assert other.cut(**cut) == scene.cut(**cut)
    if scene.objects:
        assert other.signature(1) == scene.signature(1)


def test_what_comes_out_can_be_written(scene, tmp_path):
    other = pickle.loads(pickle.dumps(scene))
    for name in ("labels.npy", "labels.csv", "cloud.pcd", "cloud.ply", "whole.tree", "tree.json"):
        for one, folder in ((scene, "before"), (other, "after")):
            (tmp_path / folder).mkdir(exist_ok=True)
            one.save(tmp_path / folder / name)
        assert (tmp_path / "before" / name).read_bytes() == (tmp_path / "after" / name).read_bytes()


def test_report(table):
    try:
        pages = [one.report().html for one in (table, pickle.loads(pickle.dumps(table)))]
    except ph.NotBuiltIn:
        pytest.skip("libph was built without npm")
    timings = re.compile(r' "timings": \{[^}]+\},')  # timings are not kept
    assert timings.search(pages[0]) and timings.sub("", pages[0]) == pages[1]


def test_of_a_stored_tree(table, tmp_path):
    table.save(tmp_path / "table.tree")
    stored = ph.segment(tmp_path / "table.tree")
    other = pickle.loads(pickle.dumps(stored))
    assert same(told(other), told(stored)) and other == stored == table
    with pytest.raises(ph.UsageError, match="has no cloud"):
        other.save(tmp_path / "x.pcd")


def test_a_cloud_with_fields_of_its_own(tmp_path):
    rows = b"".join(b"%.4f %.4f %.4f %d 7 %.3f\n" % (*point, i % 100, i / 7)
                    for i, point in enumerate(POINTS))
    (tmp_path / "own.pcd").write_bytes(
        b"VERSION 0.7\nFIELDS x y z height time\nSIZE 4 4 4 2 8\nTYPE F F F I F\nCOUNT 1 1 1 2 1\n"
        b"WIDTH %d\nHEIGHT 1\nVIEWPOINT 0.1 0 0 0.8 0.6 0 0\nPOINTS %d\nDATA ascii\n"
        % (len(POINTS), len(POINTS)) + rows)
    scene = ph.segment(tmp_path / "own.pcd")
    for number, one in enumerate((scene, pickle.loads(pickle.dumps(scene)))):
        one.save(tmp_path / f"{number}.pcd")
    written = (tmp_path / "0.pcd").read_bytes()
    assert b"VIEWPOINT 0.1 0 0 0.8 0.6 0 0\n" in written and b" height time label\n" in written
    assert (tmp_path / "1.pcd").read_bytes() == written


def test_copies(table):
    assert copy.copy(table) is table and copy.deepcopy(table) is table
    for array in (table.labels, table.objects[0].centroid, table.objects[0].box):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0


def test_equality_and_hash(table):
    again, cut = ph.segment(TABLE), table.cut(min_size=300)
    assert table == again and hash(table) == hash(again) and table.objects == again.objects
    assert table != cut and table.objects != cut.objects and table.objects[0] == again.objects[0]
    assert table.objects[0] != table.objects[1] and table.objects != list(table.objects)
    assert table != ph.segment(POINTS) and table is not None and table != [1, 2]
    assert len({table, again, cut}) == 2


# ---- other processes


def objects_of(scene):
    return len(scene.objects), scene.cut(min_size=300)


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes(table, method):
    cut = table.cut(min_size=300)
    with multiprocessing.get_context(method).Pool(2) as pool:
        found = pool.map(objects_of, [table, cut])
    assert found == [(2, cut), (len(cut.objects), cut)]


def test_joblib(table, tmp_path):
    joblib = pytest.importorskip("joblib", reason="joblib is missing")
    found = joblib.Parallel(n_jobs=2)(joblib.delayed(objects_of)(s) for s in [table] * 3)
    assert found == [(2, table.cut(min_size=300))] * 3
    memory = joblib.Memory(tmp_path / "cache", verbose=0)
    assert memory.cache(ph.segment)(TABLE) == memory.cache(ph.segment)(TABLE) == table
    joblib.dump(table, tmp_path / "table.joblib")
    assert joblib.load(tmp_path / "table.joblib") == table
    assert joblib.load(tmp_path / "table.joblib", mmap_mode="r") == table
    assert joblib.hash(table) == joblib.hash(ph.segment(TABLE))


# ---- invalid states


def test_another_version_is_refused(table):
    restored, (version, state, names) = table.__reduce__()
    for other in (version + 1, version - 1):
        with pytest.raises(ph.UsageError, match=rf"pickle: found version {other}, expected {version}"):
            restored(other, state, names)


@pytest.mark.parametrize("change, words", [
    (lambda s: s.pop("tree"), "damaged members"), (lambda s: s.pop("cloud"), "damaged members"),
    (lambda s: s.pop("checked"), "damaged members"),
    (lambda s: s.update(tree=3), "damaged members"),
    (lambda s: s.update(tree=s["tree"].astype(np.int32)), "damaged members"),
    (lambda s: s.update(tree=np.stack([s["tree"], s["tree"]])), "damaged members"),
    (lambda s: s.update(tree=s["tree"][::2]), "damaged members"),
    (lambda s: s.update(tree=s["tree"][:0]), "not a stored tree"),
    (lambda s: s.update(tree=s["tree"][:-1]), "truncated"),
    (lambda s: s.update(tree=np.append(s["tree"], s["tree"][:1])), "trailing data"),
    (lambda s: s.update(cloud=3), "damaged members"),
    (lambda s: s.update(plane_note=b"\xff"), "damaged members"),
    (lambda s: s["cloud"].pop("data"), "damaged members"),
    (lambda s: s["cloud"].update(data=s["cloud"]["data"][:-1]), "cloud: found .* bytes"),
    (lambda s: s["cloud"].update(width=2**62), "cloud"),
    (lambda s: s["cloud"].update(width=-1), "cloud"),
    (lambda s: s["cloud"].update(width=2**70), "damaged members"),
    (lambda s: s["cloud"].update(stride=2**63), "cloud"),
    (lambda s: s["cloud"].update(stride=-1), "damaged members"),
    (lambda s: s["cloud"].update(viewpoint=[0, 0]), "damaged members"),
    (lambda s: s["cloud"].update(fields=[]), "cloud"),
    (lambda s: s["cloud"].update(fields=[("x", 99, 1, 0)]), "damaged members"),
    (lambda s: s["cloud"].update(fields=[("x", 8, 2**62, 0)]), "cloud"),
    (lambda s: s["cloud"].update(fields=[("x", 8, 1, 10**6)]), "cloud"),
    (lambda s: s["cloud"].update(width=s["cloud"]["height"], height=s["cloud"]["width"]),
     "found a cloud of 160 x 120 points, expected 120 x 160 as in the tree"),
])
def test_a_damaged_state_is_refused(table, change, words):
    restored, (version, state, names) = table.__reduce__()
    state["cloud"] = dict(state["cloud"])
    change(state)
    with pytest.raises(ph.DataError, match=words):
        restored(version, state, names)._repr_html_()


def test_every_damaged_byte_of_the_tree_is_found(table, rng):
    restored, (version, state, names) = table.__reduce__()
    for place in (*range(208), *rng.integers(0, len(state["tree"]), 300)):
        damaged = state["tree"].copy()
        damaged[place] ^= rng.integers(1, 256)
        with pytest.raises(ph.DataError, match="state of a segmentation: byte"):
            restored(version, {**state, "tree": damaged}, names)
