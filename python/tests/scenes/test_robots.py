# SPDX-License-Identifier: MIT
"""Compares poses and grasps of python/examples with boxes whose poses are known."""
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import libph as ph

SOURCE = Path(os.environ.get("PH_SOURCE_DIR", Path(__file__).parents[3]))
EXAMPLES = SOURCE / "python/examples"
sys.path.insert(0, str(EXAMPLES))
from grasps import CannotGrasp, Gripper, from_above, pose  # noqa: E402

# Boxes on the table: the middle, the rotation about the vertical in degrees, and the size. Lengths
# are in metres.
BOXES = [((-0.16, 0.02), 25, (0.14, 0.06, 0.09)), ((0.03, 0.10), 70, (0.11, 0.05, 0.07)),
         ((0.17, -0.04), -35, (0.16, 0.07, 0.05)), ((-0.02, -0.11), 10, (0.15, 0.12, 0.06))]


def turned(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def poses_of_boxes():
    """The poses of the boxes in the frame of the table, in which z points up and is 0 on the
    table's top."""
    for (x, y), degrees, size in BOXES:
        result = np.eye(4)
        result[:3, :3], result[:3, 3] = turned(degrees), (x, y, size[2] / 2)
        yield result, np.array(size)


def table_from_camera():
    """The pose of a camera 0.75 m above the table and 0.46 m beside its middle, at which the camera
    looks."""
    place = np.array([0.1, -0.45, 0.75])
    z = -place / np.linalg.norm(place)
    x = np.cross(z, [0, 0, 1])
    x /= np.linalg.norm(x)
    result = np.eye(4)
    result[:3] = np.column_stack([x, np.cross(z, x), z, place])
    return result


@pytest.fixture(scope="module")
def cloud():
    """The cloud in the camera's frame: (rows, columns, 3), with noise of half a millimetre."""
    rows, columns = np.mgrid[0:360, 0:480]
    rays = np.stack([(columns - 239.5) / 450, (rows - 179.5) / 450, np.ones(rows.shape)], axis=2)
    camera = table_from_camera()
    origin, along = camera[:3, 3], rays @ camera[:3, :3].T
    depth = -origin[2] / along[..., 2]  # depth of the table
    depth[depth <= 0] = np.inf
    for box, size in poses_of_boxes():
        start = box[:3, :3].T @ (origin - box[:3, 3])
        with np.errstate(divide="ignore"):
            ends = np.stack([(side * size / 2 - start) / (along @ box[:3, :3])
                             for side in (-1, 1)])
        enter, leave = ends.min(axis=0).max(axis=-1), ends.max(axis=0).min(axis=-1)
        depth = np.where((enter < leave) & (enter > 0), np.minimum(depth, enter), depth)
    depth += np.random.default_rng(1).normal(scale=0.0005, size=depth.shape)
    return np.where(np.isfinite(depth), depth, np.nan)[..., None] * rays


@pytest.fixture(scope="module")
def scene(cloud):
    return ph.segment(cloud)


def angle(a, b):
    """The angle between two directions or their opposites, in degrees."""
    return np.degrees(np.arccos(min(1, abs(a @ b))))


def pairs(scene):
    """Each box with its nearest object, in the frame of the camera."""
    into_camera = np.linalg.inv(table_from_camera())
    for box, size in poses_of_boxes():
        known = into_camera @ box
        far = np.linalg.norm(scene.objects.centre - known[:3, 3], axis=1)
        yield known, size, scene.objects[int(np.argmin(far))]


def test_poses_of_known_boxes(scene):
    assert len(scene.objects) == len(BOXES)
    assert len({thing.label for _, _, thing in pairs(scene)}) == len(BOXES)
    for known, size, thing in pairs(scene):
        found = pose(thing.centre, thing.axes)
        assert np.allclose(found[:3, :3].T @ found[:3, :3], np.eye(3), atol=1e-9)
        assert np.linalg.det(found[:3, :3]) == pytest.approx(1)
        assert (found[3] == [0, 0, 0, 1]).all()
        assert angle(found[:3, 0], known[:3, 0]) < 2
        assert found[:3, 2] @ known[:3, 2] > np.cos(np.radians(0.5))  # z points up, not down
        assert np.abs(thing.size - size).max() < 0.006
        assert np.linalg.norm(found[:3, 3] - known[:3, 3]) < 0.004


def test_grasps_of_known_boxes(scene):
    """Grasps in the frame of the table, as for an arm mounted on the table."""
    gripper, grasped = Gripper(opening=0.085), 0
    for known, size, thing in pairs(scene):
        box = table_from_camera() @ known
        if size[1] > 0.085:
            with pytest.raises(CannotGrasp, match=r"12\d mm wide, 13\d mm with clearance"):
                from_above(thing.centre, thing.axes, thing.size, scene.meta["plane"], gripper)
            continue
        grasp = from_above(thing.centre, thing.axes, thing.size, scene.meta["plane"], gripper)
        found = table_from_camera() @ grasp.pose
        assert np.linalg.det(found[:3, :3]) == pytest.approx(1)
        # z points down, against the normal.
        assert found[:3, 2] @ [0, 0, -1] > np.cos(np.radians(0.5))
        assert angle(found[:3, 0], box[:3, 1]) < 2  # x is along the shorter side
        assert grasp.width == pytest.approx(size[1], abs=0.006)
        assert found[:3, 3] == pytest.approx([*box[:2, 3], size[2] - gripper.finger], abs=0.004)
        grasped += 1
    assert grasped == 3


def test_that_the_program_and_the_package_give_the_same(scene, cloud, tmp_path):
    program = os.environ.get("PH_SEGMENT", "")
    if not os.access(program, os.X_OK):
        pytest.skip("PH_SEGMENT names no program")
    np.save(tmp_path / "cloud.npy", cloud)
    done = subprocess.run([program, tmp_path / "cloud.npy", "--json", "-"], capture_output=True,
                          check=True)
    frame = json.loads(done.stdout)
    plane = [*frame["plane"]["normal"], frame["plane"]["offset"]]
    wide = Gripper(opening=1)
    for thing, its in zip(scene.objects, frame["segments"], strict=True):
        mine = from_above(thing.centre, thing.axes, thing.size, scene.meta["plane"], wide)
        same = from_above(**its["oriented_box"], plane=plane, gripper=wide)
        assert np.array_equal(mine.pose, same.pose)


# ---- numbers alone


TABLE = (0, 0, 1, 0)  # z = 0


def box(size=(0.1, 0.04, 0.06), degrees=0.0, bottom=0.0):
    return [0.3, 0.2, bottom + size[2] / 2], turned(degrees).T, size


@pytest.mark.parametrize("degrees", range(0, 360, 15))
def test_a_box_that_is_turned(degrees):
    grasp = from_above(*box(degrees=degrees), TABLE)
    side = turned(degrees)[:, 1]
    assert grasp.width == 0.04
    assert np.allclose(grasp.pose[:3, 0], side if side[0] >= 0 else -side)
    assert np.allclose(grasp.pose[:3, 2], [0, 0, -1])
    assert np.allclose(grasp.pose[:3, 1], np.cross(grasp.pose[:3, 2], grasp.pose[:3, 0]))
    assert np.allclose(grasp.pose[:3, 3], [0.3, 0.2, 0.06 - Gripper().finger])
    other = from_above(*box(degrees=degrees), TABLE, towards=-side)
    assert np.allclose(other.pose[:3, 0], -side)


def test_the_frame_of_the_cloud_does_not_matter(rng):
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)
    shift = rng.normal(size=3)
    centre, axes, size = box(degrees=20)
    up = turn @ [0, 0, 1]
    there = from_above(turn @ centre + shift, axes @ turn.T, size, [*up, -up @ shift],
                       towards=turn @ [1, 0, 0])
    whole = np.eye(4)
    whole[:3, :3], whole[:3, 3] = turn, shift
    assert np.allclose(there.pose, whole @ from_above(*box(degrees=20), TABLE).pose)


def test_fingers_stay_above_the_plane():
    grasp = from_above(*box((0.1, 0.04, 0.02)), TABLE)
    assert grasp.pose[2, 3] == pytest.approx(Gripper().clearance)
    # For an object on top of another object, a grasp may use the full length of the fingers.
    stacked = from_above(*box((0.1, 0.04, 0.02), bottom=0.1), TABLE)
    assert stacked.pose[2, 3] == pytest.approx(0.12 - Gripper().finger)


@pytest.mark.parametrize("size, bottom, reason", [
    ((0.1, 0.076, 0.06), 0, "76 mm wide, 86 mm with clearance, and the gripper opens 85 mm"),
    ((0.1, 0.04, 0.004), 0, "4 mm high: too flat"),
    ((0.1, 0.04, 0.06), -0.7, "it lies below the plane")])
def test_refusals(size, bottom, reason):
    with pytest.raises(CannotGrasp, match=reason):
        from_above(*box(size, bottom=bottom), TABLE)


def test_mistakes():
    centre, axes, size = box()
    with pytest.raises(ValueError, match="right-handed"):
        pose(centre, axes[[1, 0, 2]])
    with pytest.raises(ValueError, match="right-handed"):
        pose(centre, 2 * axes)
    with pytest.raises(ValueError, match="does not stand on the plane"):
        from_above(centre, axes, size, (0, 1, 0, 0))


# ---- Open3D


def run_example(*arguments, **environment):
    return subprocess.run([sys.executable, EXAMPLES / "open3d_objects.py", *map(str, arguments)],
                          env={**os.environ, **environment}, capture_output=True, text=True)


def test_open3d_example(tmp_path):
    o3d = pytest.importorskip("open3d", reason="open3d is missing, which open3d_objects.py needs")
    table = SOURCE / "examples/data/table.pcd"
    done = run_example(table, "--opening", 0.12, "--save", tmp_path)
    assert done.returncode == 0, done.stderr
    points = np.asarray(o3d.io.read_point_cloud(str(table)).points)
    expected = ph.segment(points, viewpoint=(0, 0, 0))
    lines = done.stdout.splitlines()
    assert len(lines) == len(expected.objects) > 0
    for line, thing in zip(lines, expected.objects):
        assert line.startswith(f"table.pcd: object {thing.label}: {thing.points} points, ")
        points = o3d.io.read_point_cloud(str(tmp_path / f"table-{thing.label}.ply"))
        assert len(points.points) == thing.points
    assert "grasp at (" in done.stdout


def test_open3d_example_without_open3d(tmp_path):
    (tmp_path / "open3d.py").write_text("raise ImportError\n")
    path = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
    done = run_example("cloud.pcd", PYTHONPATH=path)
    assert done.returncode == 1
    assert "Open3D is missing" in done.stderr and "Traceback" not in done.stderr
