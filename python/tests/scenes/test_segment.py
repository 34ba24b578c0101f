# SPDX-License-Identifier: MIT
"""Segmentation gives the same results as ph-segment on the same scene."""
import json
import os
import re
import struct
import subprocess
import zlib
from pathlib import Path

import numpy as np
import pytest

import libph as ph
from scenes import CAMERA, TABLE, depth_of_scene, points_of_scene


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    """Runs ph-segment. @return its outputs: labels, the result as JSON, the tree."""
    path = os.environ.get("PH_SEGMENT", "")
    if not os.access(path, os.X_OK):
        pytest.skip("PH_SEGMENT names no program")
    folder = tmp_path_factory.mktemp("ph-segment")

    def run(*arguments, more=()):
        done = subprocess.run([path, *map(str, arguments), "--labels", folder / "labels.npy",
                               "--json", folder / "result.json", "--tree", folder / "tree.tree",
                               *map(str, more)], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return (np.load(folder / "labels.npy"), json.loads((folder / "result.json").read_text()),
                folder / "tree.tree", done.stderr)

    run.path, run.folder = path, folder
    return run


def check(found, expected):
    labels, result, tree, _ = expected
    assert found.labels.dtype == np.uint32 and np.array_equal(found.labels, labels)
    segments = result["segments"]
    assert len(found.objects) == len(segments)
    for mine, its in zip(found.objects, segments):
        assert (mine.label, mine.points, mine.voxels) == (its["label"], its["points"], its["voxels"])
        assert mine.persistence == (np.inf if its["persistence"] is None else its["persistence"])
        assert mine.centroid.tolist() == its["centroid"]
        assert mine.box.tolist() == [its["box"]["min"], its["box"]["max"]]
        box = its["oriented_box"]
        assert (mine.centre.tolist(), mine.axes.tolist(), mine.size.tolist()) == (
            box["centre"], box["axes"], box["size"])
        assert [{"label": n, "meets_at": v} for n, v in mine.neighbours] == its["neighbours"]
    meta = found.meta
    assert (meta["method"], meta["voxel"]) == (result["method"], result["voxel"])
    assert list(meta["viewpoint"]) == result["viewpoint"]
    assert meta["checked"] == result["check"]["ran"]
    assert (meta["voxels"], meta["edges"]) == (result["complex"]["vertices"],
                                               result["complex"]["edges"])
    if result["plane"]["found"]:
        assert list(meta["plane"]) == [*result["plane"]["normal"], result["plane"]["offset"]]
    else:
        assert meta["plane_note"] == result["plane"]["note"]
    own = tree.with_name("own.tree")
    found.save(own)
    assert own.read_bytes() == tree.read_bytes()


# ---- the same results as the program


@pytest.mark.parametrize("options, arguments", [
    ({}, []), ({"objects": False}, ["--parts"]), ({"method": "paper"}, ["--method", "paper"]),
    ({"method": "paper", "distance": 0.02, "steps": "exact"},
     ["--method", "paper", "--distance", "0.02", "--steps", "exact"]),
    ({"supervoxels": 0.04}, ["--supervoxels", "0.04"]),
    ({"method": "supervoxels", "min_part": 4}, ["--method", "supervoxels", "--min-part", "4"]),
    ({"voxel": 0.01, "min_size": 5, "min_part": 30},
     ["--voxel", "0.01", "--min-size", "5", "--min-part", "30"]),
    ({"min_persistence": 0.05}, ["--min-persistence", "0.05"]),
    ({"plane": False, "check": False}, ["--plane", "off", "--no-check"]),
    ({"plane_distance": 0.01, "plane_noise": 0}, ["--plane-distance", "0.01", "--plane-noise", "0"]),
    ({"max_range": 0.95}, ["--max-range", "0.95"]),
    ({"crop": [-0.3, 0.3, -0.2, 0.2, 0, np.inf]}, ["--crop", "-0.3,0.3,-0.2,0.2,0,inf"]),
    ({"viewpoint": [0, 0, 0.1]}, ["--viewpoint", "0,0,0.1"]),
], ids=str)
@pytest.mark.filterwarnings("ignore::UserWarning")
def test_a_file_of_a_cloud(program, options, arguments):
    check(ph.segment(TABLE, **options), program(TABLE, *arguments))


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.filterwarnings("ignore::UserWarning")
def test_random_clouds(program, seed):
    rng = np.random.default_rng(seed)
    points = points_of_scene(rng)
    points[rng.random(len(points)) < 0.02] = np.nan
    path = program.folder / "points.npy"
    for dtype in (np.float64, np.float32):
        np.save(path, points.astype(dtype))
        for options, arguments in (({}, []), ({"method": "paper"}, ["--method", "paper"]),
                                   ({"supervoxels": 0.05}, ["--supervoxels", "0.05"])):
            check(ph.segment(points.astype(dtype), **options), program(path, *arguments))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.filterwarnings("ignore::UserWarning")
def test_clouds_with_rows_and_columns(program, seed):
    rng = np.random.default_rng(seed)
    z = depth_of_scene(rng)
    rows, columns = np.mgrid[0:120, 0:160]
    fx, fy, cx, cy = CAMERA
    cloud = np.stack([(columns - cx) * z / fx, (rows - cy) * z / fy, z], axis=2) + [0.1, 0, 0]
    path = program.folder / "organised.npy"
    np.save(path, cloud)
    found = ph.segment(cloud)
    check(found, program(path))
    assert found.labels.shape == found.voxels.of_point.shape == (120, 160)
    # All rays meet at this point.
    assert found.meta["viewpoint"] == pytest.approx((0.1, 0, 0), abs=1e-3)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.filterwarnings("ignore::UserWarning")
def test_depth_images(program, seed):
    depth = depth_of_scene(np.random.default_rng(seed))
    camera = ["--intrinsics", ",".join(map(str, CAMERA))]
    path = program.folder / "depth.npy"
    fx, fy, cx, cy = CAMERA
    for image, options, arguments in (
            (depth, {}, []), (depth.astype(np.float32), {}, []),
            (np.nan_to_num(depth * 1000).astype(np.uint16), {}, []),
            (np.nan_to_num(depth * 1000).astype(np.int32), {}, []),
            (np.nan_to_num(depth * 5000).astype(np.uint16), {"depth_scale": 5000},
             ["--depth-scale", "5000"])):
        np.save(path, image)
        expected = program(path, *camera, *arguments)
        check(ph.segment(image, intrinsics=CAMERA, **options), expected)
        check(ph.segment(path, intrinsics=CAMERA, **options), expected)
        matrix = [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]
        check(ph.segment(np.asfortranarray(image), intrinsics=matrix, **options), expected)


def test_the_scale_of_a_camera_is_used_for_arrays(tmp_path):
    fx, fy, cx, cy = CAMERA
    camera = tmp_path / "camera.json"
    camera.write_text(json.dumps({"fx": fx, "fy": fy, "cx": cx, "cy": cy, "depth_scale": 5000}))
    depth = depth_of_scene(np.random.default_rng(1))
    units = np.nan_to_num(depth * 5000).astype(np.uint16)
    np.save(tmp_path / "depth.npy", units)
    by_camera = ph.segment(units, camera=camera)
    assert by_camera == ph.segment(units, intrinsics=CAMERA, depth_scale=5000)
    assert by_camera == ph.segment(tmp_path / "depth.npy", camera=camera)
    assert len(by_camera.objects) == len(ph.segment(depth, camera=camera).objects)


def png(array):
    """A PNG file of an RGB image with 8 bits per channel."""
    rows = b"".join(b"\0" + row.tobytes() for row in array)

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(
            ">I", zlib.crc32(name + data))

    head = struct.pack(">IIBBBBB", array.shape[1], array.shape[0], 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(
        b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_colours_go_into_files(program, rng):
    depth = depth_of_scene(rng)
    colours = rng.integers(0, 256, (120, 160, 3), dtype=np.uint8)
    (program.folder / "colours.png").write_bytes(png(colours))
    np.save(program.folder / "depth.npy", depth)
    written = program.folder / "labelled.pcd"
    program("--depth", program.folder / "depth.npy", "--color", program.folder / "colours.png",
            "--intrinsics", ",".join(map(str, CAMERA)), more=("-o", written))
    own = program.folder / "own.pcd"
    for scene, given in ((depth, colours),
                         (program.folder / "depth.npy", program.folder / "colours.png"),
                         (depth, colours / 255), (depth, np.dstack([colours, colours[:, :, :1]]))):
        ph.segment(scene, intrinsics=CAMERA, colours=given).save(own)
        assert own.read_bytes() == written.read_bytes()
    points = points_of_scene(rng)
    colours = rng.integers(0, 256, (len(points), 3))
    colours[0, 0] = 200  # otherwise the colours could pass for numbers from 0 to 1
    np.save(program.folder / "points.npy", np.hstack([points, colours]))
    for name in ("labelled.ply", "labelled.pcd"):
        program(program.folder / "points.npy", more=("-o", program.folder / name))
        own = program.folder / f"own{Path(name).suffix}"
        ph.segment(points, colours=colours).save(own)
        assert own.read_bytes() == (program.folder / name).read_bytes()


def test_cameras(program, rng):
    image = np.nan_to_num(np.kron(depth_of_scene(rng), np.ones((4, 4))) * 1000).astype(np.uint16)
    path = program.folder / "depth.npy"
    np.save(path, image)
    found = ph.segment(image, camera="kinect-v1")
    check(found, program(path, "--camera", "kinect-v1"))
    assert "nominal values" in found.meta["notes"][0]
    calibration = program.folder / "camera.yaml"
    calibration.write_text(
        "image_width: 1280\nimage_height: 960\ndistortion_model: plumb_bob\ncamera_matrix:\n"
        "  rows: 3\n  cols: 3\n  data: [1040, 0, 639.5, 0, 1040, 479.5, 0, 0, 1]\n"
        "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0.1, -0.2, 0.001, 0.002, 0]\n")
    found = ph.segment(image, camera=calibration)
    check(found, program(path, "--camera", calibration))
    assert any("scaled" in note for note in found.meta["notes"])
    assert any("lens" in note for note in found.meta["notes"])


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_cuts(program, rng):
    points = points_of_scene(rng)
    np.save(program.folder / "points.npy", points)
    for options, arguments, cuts in (
            ({}, [], ({"value": 0.002}, {"value": 0.2}, {"min_part": 10, "min_size": 3},
                      {"objects": False})),
            ({"method": "paper"}, ["--method", "paper"], ({"value": 0.012}, {"min_size": 400})),
            ({"supervoxels": 0.04}, ["--supervoxels", "0.04"], ({"value": 0.02}, {"min_part": 40}))):
        whole = ph.segment(points, **options)
        program(program.folder / "points.npy", *arguments)
        tree = program.folder / "whole.tree"
        tree.write_bytes((program.folder / "tree.tree").read_bytes())
        stored = ph.segment(tree)
        assert np.array_equal(stored.labels, whole.labels)
        for cut in cuts:
            asked = [word for name, value in cut.items() for word in (
                ["--parts"] if name == "objects" else
                [{"value": "--cut"}.get(name, "--" + name.replace("_", "-")), value])]
            labels = program(tree, *asked)[0]
            assert np.array_equal(whole.cut(**cut).labels, labels)
            assert np.array_equal(stored.cut(**cut).labels, labels)


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_the_tree_is_that_of_the_program(program):
    for options, arguments in (({}, []), ({"method": "paper"}, ["--method", "paper"])):
        found = ph.segment(TABLE, **options)
        written = program.folder / "tree.json"
        done = subprocess.run([program.path, TABLE, *arguments, "--tree", written],
                              capture_output=True)
        assert done.returncode == 0
        expected = json.loads(written.read_text())
        own = program.folder / "own.json"
        found.save(own)
        assert own.read_bytes() == written.read_bytes()
        merges, vertices = expected["merges"], expected["vertices"]
        tree, voxels = found.tree, found.voxels
        assert tree.values.tolist() == [m["value"] for m in merges]
        assert tree.edges.tolist() == [m["edge"] for m in merges]
        assert tree.elder.tolist() == [m["elder"] for m in merges]
        assert tree.younger.tolist() == [m["younger"] for m in merges]
        assert tree.births.tolist() == [v["birth"] for v in vertices]
        assert voxels.centroids.tolist() == [v["centroid"] for v in vertices]
        assert voxels.points.tolist() == [v["points"] for v in vertices]
        assert voxels.of_point.ravel().tolist() == expected["vertex_of_point"]
        if voxels.normals is None:
            assert options
        else:
            normals = [None if np.isnan(n).any() else n.tolist() for n in voxels.normals]
            assert normals == [v["normal"] for v in vertices]
        # All points of a voxel have the voxel's label.
        has_voxel = voxels.of_point >= 0
        assert np.array_equal(voxels.labels[voxels.of_point[has_voxel]], found.labels[has_voxel])
        barcode = program.folder / "bars.json"
        subprocess.run([program.path, TABLE, *arguments, "--barcode", barcode], check=True,
                       capture_output=True)
        assert ph.read_barcode(barcode) == found.barcode


def test_files_of_labels(program, tmp_path):
    found = ph.segment(TABLE)
    for name in ("l.npy", "l.csv", "l.png"):
        done = subprocess.run([program.path, TABLE, "--labels", tmp_path / name],
                              capture_output=True)
        assert done.returncode == 0
        found.save(tmp_path / f"own{name}")
        assert (tmp_path / f"own{name}").read_bytes() == (tmp_path / name).read_bytes()
    found.save(tmp_path / "x", format="npy")
    assert np.array_equal(np.load(tmp_path / "x"), found.labels)


def test_signatures_and_meetings(program, rng):
    points = points_of_scene(rng, noise=0.0005)
    np.save(program.folder / "points.npy", points)
    found = ph.segment(points, supervoxels=0.05)
    _, result, _, _ = program(program.folder / "points.npy", "--supervoxels", "0.05",
                              more=["--signatures"])
    assert len(found.objects) > 3
    for its in result["segments"]:
        bars = found.signature(its["label"])
        for dim in range(3):
            assert [[b, None if d == np.inf else d] for b, d in bars.dgm(dim).tolist()] == \
                its["signature"][f"h{dim}"]
    for a in (1, 2):
        done = subprocess.run([program.path, program.folder / "points.npy", "--supervoxels", "0.05",
                               "--explain", f"{a},3"], capture_output=True, text=True)
        meeting = found.first_meeting(a, 3)
        if meeting is None:
            assert "never join" in done.stdout
            continue
        value, x, y, z = map(float, re.search(r"join at (\S+), near \((\S+), (\S+), (\S+)\)",
                                              done.stdout).groups())
        assert meeting[0] == value and meeting[1] == pytest.approx((x, y, z), abs=1e-4)
