# SPDX-License-Identifier: MIT
"""Tests how segmentations are used: cuts into a given number of objects, arrays of all kinds,
messages, and limits."""
import os
import re
import threading
import time

import numpy as np
import pytest

import libph as ph
from scenes import CAMERA, TABLE, depth_of_scene, points_of_scene


# ---- a number of objects


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize("options", [{"supervoxels": 0.04},
                                     {"method": "paper", "distance": 0.05, "steps": "exact"},
                                     {"objects": False, "min_part": 5, "min_size": 5}], ids=str)
def test_so_many_objects(rng, options):
    found = ph.segment(points_of_scene(rng), **options)
    reached = 0
    for n in range(1, 12):
        try:
            other = found.cut(n=n)
        except ph.UsageError as error:
            assert re.search(r"found no cut into \d+ objects; the nearest cuts give \d+", str(error))
            continue
        reached += 1
        assert len(other.objects) == n and other.labels.max() == n
        assert np.array_equal(found.cut(other.meta["cut"]).labels, other.labels)
    assert reached > 2


# ---- arrays


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_arrays_of_all_kinds(rng):
    points = np.round(points_of_scene(rng), 4).astype(np.float32).astype(np.float64)
    expected = ph.segment(points)
    assert expected.objects
    before = points.copy()
    wide = np.zeros((len(points), 7))
    wide[:, 1:6:2] = points
    read_only = points.copy()
    read_only.flags.writeable = False
    for same in (points.astype(np.float32), points.astype(">f8"), np.asfortranarray(points),
                 wide[:, 1:6:2], read_only, points[::-1][::-1], memoryview(points),
                 points.tolist()):
        assert np.array_equal(ph.segment(same).labels, expected.labels)
    assert np.array_equal(points, before)
    # The result does not depend on the order of the points.
    order = rng.permutation(len(points))
    assert np.array_equal(ph.segment(points[order]).labels, expected.labels[order])
    # A masked entry is a hole.
    masked = np.ma.masked_array(points, mask=False)
    masked[:10] = np.ma.masked
    holes = points.copy()
    holes[:10] = np.nan
    assert np.array_equal(ph.segment(masked).labels, ph.segment(holes).labels)


def test_a_masked_depth_image_keeps_its_unit():
    depth = np.full((240, 320), 800, np.uint16)
    depth[60:120, 60:120] = 700
    camera = (260, 260, 159.5, 119.5)
    masked = np.ma.masked_array(depth, mask=False)
    masked[0, 0] = np.ma.masked
    holes = depth / 1000
    holes[0, 0] = np.nan
    expected = ph.segment(holes, intrinsics=camera)
    assert len(expected.objects) == 1
    for given in (masked, masked / 1000):
        assert np.array_equal(ph.segment(given, intrinsics=camera).labels, expected.labels)


@pytest.mark.parametrize("cloud", [np.empty((0, 3)), [], np.full((5, 3), np.nan),
                                   np.full((4, 6, 3), np.nan), [[0, 0, 1]]], ids=str)
@pytest.mark.filterwarnings("ignore::UserWarning")
def test_clouds_of_nothing(cloud):
    for options in ({}, {"method": "paper"}, {"supervoxels": 0.1}):
        found = ph.segment(cloud, **options)
        assert found.labels.shape == np.shape(cloud)[:-1] or found.labels.size == 0
        assert found._repr_html_() and repr(found) and repr(found.objects)
        table = found.objects.to_pandas()
        assert len(table) == len(found.objects) <= 1
        assert list(table.role) == found.objects.role and list(table.on) == found.objects.on
        assert found.cut(0.0).labels.shape == found.labels.shape
        assert len(found.tree) == len(found.voxels.points)


# ---- words


CLOUD = np.random.default_rng(0).uniform(size=(50, 3))
DEPTH = np.full((20, 30), 0.5)


@pytest.mark.parametrize("data, options, error, words", [
    (CLOUD[:, :2], {}, ph.UsageError, r"cloud: found an array of shape \(50, 2\), expected \(points"),
    (DEPTH, {}, ph.UsageError, "a depth image needs intrinsics or camera"),
    (np.hstack([CLOUD, CLOUD]), {}, ph.UsageError, "colours are given by colours"),
    (CLOUD[:, 0], {}, ph.UsageError, "cloud: found an array"),
    ([[0, 0, np.inf]], {}, ph.DataError, "row 0, column 2: found inf"),
    (["a"], {}, ph.DataError, "cloud: found text"),
    (CLOUD, {"intrinsics": (1, 2, 3)}, ph.UsageError, "intrinsics: found .* expected fx, fy, cx, cy"),
    (CLOUD, {"intrinsics": np.ones((3, 3))}, ph.UsageError, "intrinsics"),
    (CLOUD[None], {"intrinsics": CAMERA}, ph.UsageError, "expected a depth image"),
    (DEPTH, {"intrinsics": CAMERA, "camera": "kinect-v1"}, ph.UsageError, "camera: cannot be combined"),
    (DEPTH, {"camera": "kinect-v7"}, ph.MissingInputError, "expected an existing file or one of"),
    (DEPTH, {"camera": "kinect-v1"}, ph.UsageError, "camera kinect-v1: "),
    (DEPTH, {"intrinsics": (0, 1, 1, 1)}, ph.UsageError, "focal lengths 0 and 1"),
    (DEPTH, {"intrinsics": CAMERA, "depth_scale": 0.001}, ph.UsageError, "if a unit is 0.001 m, the scale is 1000"),
    (DEPTH, {"intrinsics": CAMERA, "colours": np.zeros((20, 31, 3), np.uint8)}, ph.UsageError,
     r"colours: found an array of shape \(20, 31, 3\), expected \(20, 30, 3\)"),
    (CLOUD, {"colours": CLOUD * 2}, ph.DataError, "colours: row .* a number from 0 to 1"),
    (CLOUD, {"depth_scale": 0}, ph.UsageError, "depth_scale: found 0"),
    (CLOUD, {"method": "best"}, ph.UsageError, "method: found 'best', expected"),
    (CLOUD, {"method": "paper", "supervoxels": 0.1}, ph.UsageError, "supervoxels: found method"),
    (CLOUD, {"method": "paper", "min_part": 3}, ph.UsageError, "min_part: does nothing"),
    (CLOUD, {"method": "paper", "objects": True}, ph.UsageError, "objects: does nothing"),
    (CLOUD, {"distance": 0.1}, ph.UsageError, "distance: does nothing here"),
    (CLOUD, {"steps": 3}, ph.UsageError, "steps: does nothing here"),
    (CLOUD, {"plane": False, "plane_distance": 0.1}, ph.UsageError, "plane_distance: does nothing"),
    (CLOUD, {"voxel": 0}, ph.UsageError, "voxel: found 0"),
    (CLOUD, {"voxel": 1e-40}, ph.UsageError, "voxel: found 1e-40"),
    (CLOUD, {"supervoxels": 0.001}, ph.UsageError, "supervoxels: found 0.001"),
    (CLOUD, {"min_size": 0}, ph.UsageError, "min_size: found 0"),
    (CLOUD, {"crop": [1, 0, 0, 1, 0, 1]}, ph.UsageError, "crop: found"),
    (CLOUD, {"viewpoint": [0, 0, np.inf]}, ph.UsageError, "viewpoint: found"),
    (CLOUD, {"max_range": -1}, ph.UsageError, "max_range: found -1"),
    (CLOUD, {"method": "paper", "steps": "x"}, ph.UsageError, "steps: found 'x', .* or 'exact'"),
    (np.full((4, 3), 1e300), {}, ph.DataError, r"point 0, coordinate 0: found 1e\+300"),
    (np.ones((85, 181)), {"camera": "xtion"}, ph.UsageError, "camera xtion: found an image of"),
    (DEPTH, {"camera": 5}, ph.UsageError, "camera: found 5"),
    (DEPTH, {"intrinsics": CAMERA, "colours": "c.png"}, ph.UsageError,
     "colours: found 'c.png', expected an array"),
    ("", {}, ph.UsageError, "cloud: found ''"),
    ("no/such/file.pcd", {}, ph.MissingInputError, "no/such/file.pcd"),
    (TABLE, {"colours": CLOUD}, ph.UsageError, "colours: does nothing for a cloud file"),
    (None, {}, ph.UsageError, "cloud: found NoneType"),
], ids=str)
def test_what_is_wrong_is_said(data, options, error, words):
    with pytest.raises(error, match=words):
        ph.segment(data, **options)


def test_unknown_keywords():
    with pytest.raises(TypeError, match="unexpected keyword argument 'epsilon'"):
        ph.segment(CLOUD, epsilon=1)
    found = ph.segment(TABLE)
    with pytest.raises(TypeError, match="unexpected keyword argument 'epsilon'"):
        found.cut(epsilon=1)


def test_a_stored_tree_has_no_options(tmp_path):
    found = ph.segment(TABLE)
    found.save(tmp_path / "t.tree")
    for name, value in (("crop", np.array([0, 1, 0, 1, 0, 1])), ("viewpoint", np.zeros(3))):
        with pytest.raises(ph.UsageError, match=f"{name}: does nothing for a stored tree"):
            ph.segment(tmp_path / "t.tree", **{name: value})
    with pytest.raises(ph.UsageError, match="voxel: does nothing for a stored tree"):
        ph.segment(tmp_path / "t.tree", voxel=0.01)
    stored = ph.segment(tmp_path / "t.tree")
    assert np.array_equal(stored.labels, found.labels) and stored._repr_html_()
    with pytest.raises(ph.UsageError, match="has no cloud"):
        stored.save(tmp_path / "x.pcd")
    (tmp_path / "t.tree").write_bytes((tmp_path / "t.tree").read_bytes()[:-1])
    with pytest.raises(ph.DataError, match="t.tree"):
        ph.segment(tmp_path / "t.tree")


def test_words_of_results(tmp_path):
    found = ph.segment(TABLE)
    for act, words in ((lambda: found.cut(0.1, n=2), "n: cannot be combined"), (lambda: found.cut(-1), "value"),
                       (lambda: found.signature(), "labels: found none"),
                       (lambda: found.signature(3), "labels: found 3"),
                       (lambda: found.first_meeting(0, 1), "a: found 0"),
                       (lambda: found.save(tmp_path / "x.obj"), r"path: found .*expected \.npy"),
                       (lambda: found.save(tmp_path / "x", format="obj"), "format: found 'obj'"),
                       (lambda: found.cut(n=10**6), "no cut into 1000000 .* the nearest cuts give 2"),
                       (lambda: found.cut(n=0), "no cut into 0 .* the nearest cuts give 2")):
        with pytest.raises(ph.UsageError, match=words):
            act()
    with pytest.raises(ph.OutputError):
        found.save(tmp_path / "no" / "x.npy")
    with pytest.raises(TypeError):
        ph.Segmentation()


def test_doubts_are_warnings():
    def doubts(cloud, **options):
        with pytest.warns(UserWarning) as caught:
            found = ph.segment(cloud, **options)
        assert all(one.filename == __file__ for one in caught)
        return found, "\n".join(str(one.message) for one in caught)

    points = points_of_scene(np.random.default_rng(1)) * 1000
    found, words = doubts(points)
    assert "are these millimetres" in words
    assert not found.objects and "are these millimetres" in " ".join(found.meta["notes"])
    words = doubts(CLOUD * 0.1 + 3)[1]
    assert re.search(r"see viewpoint|viewpoint X,Y,Z|no plane|no point", words)
    offset = np.array([5e5, 4e6, 100])  # coordinates as in a map
    words = doubts(points / 1000 + offset, viewpoint=offset)[1]
    assert "single precision has steps of 0.25 m; subtract" in words


def test_a_picture_needs_a_camera(tmp_path):
    (tmp_path / "depth.png").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(100))
    with pytest.raises(ph.DataError, match="found PNG, .*a depth image needs a camera: camera or"):
        ph.segment(tmp_path / "depth.png")


def test_points_have_the_order_of_labels(tmp_path):
    depth = depth_of_scene(np.random.default_rng(2))
    found = ph.segment(depth, intrinsics=CAMERA)
    assert found.points.shape == (120, 160, 3)
    assert np.allclose(found.points[..., 2], depth, equal_nan=True)
    assert (found.labels == 1).sum() == len(found.points[found.labels == 1]) > 0
    found.save(tmp_path / "cloud.pcd")
    again = ph.segment(tmp_path / "cloud.pcd")
    assert np.array_equal(again.points, found.points, equal_nan=True)
    found.save(tmp_path / "scene.tree")
    with pytest.raises(ph.UsageError, match="a stored tree has no cloud"):
        ph.segment(tmp_path / "scene.tree").points


def test_depths_that_look_like_grey_are_doubted():
    depth = np.nan_to_num(depth_of_scene(np.random.default_rng(2)))
    with pytest.warns(UserWarning, match="no depth is above 255.*depth_scale"):
        found = ph.segment(np.uint8(100 * depth), intrinsics=CAMERA)
    assert any("no depth is above 255" in note for note in found.meta["notes"])
    assert len(ph.segment(np.uint8(100 * depth), intrinsics=CAMERA, depth_scale=100).objects) > 1


# ---- runs


SPACE = np.random.default_rng(5).uniform(size=(1_500_000, 3)).astype(np.float32)
LONG = {"max_range": np.inf, "plane": False, "supervoxels": 0.03, "voxel": 0.01}  # takes seconds
SOON = 1.0


def test_stopping():
    with pytest.raises(ph.Timeout):
        start = time.monotonic()
        ph.segment(SPACE, timeout=0.3, **LONG)
    assert time.monotonic() - start < 0.3 + SOON
    stop = threading.Event()
    threading.Timer(0.3, stop.set).start()
    with pytest.raises(ph.Cancelled):
        start = time.monotonic()
        ph.segment(SPACE, stop=stop, **LONG)
    assert time.monotonic() - start < 0.3 + SOON


def test_interrupt():
    threading.Timer(0.3, lambda: os.kill(os.getpid(), 2)).start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        ph.segment(SPACE, **LONG)
    assert time.monotonic() - start < 0.3 + SOON


def test_memory_limit():
    for limit in ("2MB", "60MB", "200MB"):
        with pytest.raises(ph.MemoryLimitError, match="memory limit"):
            ph.segment(SPACE, memory_limit=limit, **LONG)
    with pytest.raises(ph.MemoryLimitError, match="lower max_range, enlarge voxel"):
        ph.segment(SPACE, memory_limit="100MB", **LONG)
    assert len(ph.segment(TABLE).objects) == 2


def test_the_gil_is_released():
    ticks, stop = [], threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.monotonic()
    try:
        with pytest.raises(ph.Timeout):
            ph.segment(SPACE, timeout=0.5, **LONG)
    finally:
        seconds = time.monotonic() - start
        stop.set()
        thread.join()
    assert len(ticks) > 50 * seconds
