# SPDX-License-Identifier: MIT
"""Tests that the parts of a cloud, computed by separate processes, give the same components as a
single process."""
import concurrent.futures
import itertools
import multiprocessing
import pickle
import subprocess

import numpy as np
import pytest

import libph as ph

RNG = np.random.default_rng(7)
POINTS = RNG.random((300, 3))


def parts_of(points, count, **options):
    return [ph.cloud_part(points, i, count, **options) for i in range(count)]


@pytest.mark.parametrize("count", [1, 2, 5, 12])
@pytest.mark.parametrize("options", [
    {}, {"threshold": 0.1}, {"threshold": 0}, {"threshold": np.inf}])
def test_the_same_bars(options, count):
    joined = ph.join_parts(parts_of(POINTS, count, **options))
    assert joined.is_whole and joined.missing == ()
    bars, whole = joined.barcode(), ph.rips(POINTS, max_dim=0, **options)
    assert bars == whole and len(bars) == 300
    assert joined.barcode(cells=False) == whole
    assert np.array_equal(bars.birth_cells(0), whole.birth_cells(0))
    assert np.array_equal(bars.death_cells(0), whole.death_cells(0))
    for name in ("complex", "field", "points", "coordinates", "metric", "max_dim", "engine"):
        assert bars.meta.get(name) == whole.meta.get(name), name


def test_other_points():
    clouds = [RNG.random((40, d)) for d in range(1, 9)]
    clouds += [POINTS[::-2, ::2], np.asfortranarray(POINTS), POINTS.astype(np.float32),
               POINTS[:9].tolist(), RNG.integers(0, 3, (50, 2)), POINTS[:3], POINTS[:1], POINTS[:0],
               np.zeros((7, 2)), []]
    for points in clouds:
        bars = ph.join_parts(parts_of(points, 4)).barcode()
        assert bars == ph.rips(points, max_dim=0)


def test_any_order_and_grouping():
    a, b, c, d = parts_of(POINTS, 4)
    for order in itertools.permutations([a, b, c, d]):
        assert ph.join_parts(order).is_whole
    whole = ph.join_parts([a, b, c, d])
    assert ph.join_parts([ph.join_parts([a, c]), ph.join_parts(iter([d, b]))]) == whole
    some = ph.join_parts([d, a])
    assert (some.parts, some.missing, some.is_whole) == (4, (1, 2), False)
    assert (some.points, some.coordinates, some.threshold) == (300, 3, None)
    assert repr(some).startswith("CloudPart(2 parts of 4, 300 points in R^3, ")
    assert "(2 of 4, " in repr(c) and "(1 to 3 of 4, " in repr(ph.join_parts([b, d, c]))
    assert ph.cloud_part(POINTS, 0, 2, threshold=0.5).threshold == 0.5


def test_what_does_not_belong_together():
    a, b, c = parts_of(POINTS, 3)
    moved = POINTS.copy()
    moved[7, 1] += 1e-9
    foreign = [ph.cloud_part(moved, 1, 3), ph.cloud_part(POINTS, 1, 4),
               ph.cloud_part(POINTS, 1, 3, threshold=1), ph.cloud_part(POINTS[1:], 1, 3),
               ph.image_part(POINTS, 1, 3)]
    for parts in ([a, a], [a, b, a], [ph.join_parts([a, b]), b], [], *([a, f] for f in foreign)):
        with pytest.raises(ph.DataError):
            ph.join_parts(parts)
    with pytest.raises(ph.DataError, match="found 2 of 3, expected all"):
        ph.join_parts([c, a]).barcode()
    with pytest.raises(ph.UsageError, match="expected ImagePart or CloudPart"):
        ph.join_parts([a, b.to_bytes()])
    for part, parts in ((3, 3), (-1, 3), (0, 0), (0, 2**30 + 1), (0.5, 3)):
        with pytest.raises(ph.UsageError):
            ph.cloud_part(POINTS, part, parts)


def test_what_is_no_cloud():
    holes = POINTS.copy()
    holes[5, 2] = np.nan
    with pytest.raises(ph.DataError, match="point 5, coordinate 2: found nan"):
        ph.cloud_part(holes, 0, 2)
    for points in (np.zeros(5), np.zeros((2, 2, 2)), "points.npy", None):
        with pytest.raises(ph.UsageError, match="points: found"):
            ph.cloud_part(points, 0, 2)
    with pytest.raises(ph.UsageError, match="found 9 coordinates, expected at most 8"):
        ph.cloud_part(np.zeros((5, 9)), 0, 2)
    for threshold in (-1, np.nan, "far"):
        with pytest.raises(ph.UsageError, match="threshold"):
            ph.cloud_part(POINTS, 0, 2, threshold=threshold)
    with pytest.raises(TypeError, match="thread"):
        ph.cloud_part(POINTS, 0, 2, thread=1)


def test_bytes_are_those_of_a_file(program, tmp_path):
    part = ph.cloud_part(POINTS[:60], 1, 3)
    data = part.to_bytes()
    assert ph.CloudPart.from_bytes(data) == part == pickle.loads(pickle.dumps(part))
    assert hash(pickle.loads(pickle.dumps(part))) == hash(part)
    for at in range(0, len(data), 7):
        damaged = bytearray(data)
        damaged[at] ^= 1
        with pytest.raises(ph.DataError):
            ph.CloudPart.from_bytes(damaged)
        with pytest.raises(ph.DataError):
            ph.CloudPart.from_bytes(data[:at])
    with pytest.raises(ph.DataError):
        ph.ImagePart.from_bytes(data)
    with pytest.raises(ph.DataError):
        ph.CloudPart.from_bytes(ph.image_part(POINTS, 0, 3).to_bytes())
    with pytest.raises(ph.UsageError, match="expected bytes"):
        ph.CloudPart.from_bytes("part")
    np.save(tmp_path / "points.npy", POINTS[:60])
    subprocess.run([program, "points.npy", "--complex", "rips", "--max-dim", "0", "--part", "2/3",
                    "-o", "part.ph", "--quiet"], cwd=tmp_path, check=True)
    assert (tmp_path / "part.ph").read_bytes() == data


def _part_of_file(path, part, parts):
    return ph.cloud_part(np.load(path, mmap_mode="r"), part, parts, threads=1)


def test_processes_that_share_a_file(tmp_path):
    path = tmp_path / "points.npy"
    np.save(path, POINTS)
    spawn = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=spawn) as pool:
        parts = list(pool.map(_part_of_file, [path] * 4, range(4), [4] * 4))
    assert ph.join_parts(parts).barcode() == ph.rips(POINTS, max_dim=0)


def _anonymous():
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("RssAnon:"))


def test_points_stay_in_their_file(tmp_path):
    """One of 64 parts of a 64 MiB cloud is computed in less than 50 MB."""
    path = tmp_path / "points.npy"
    np.save(path, RNG.random((4 << 20, 2)))
    points = np.load(path, mmap_mode="r")
    before, most = _anonymous(), 0

    def look(*news):
        nonlocal most
        most = max(most, _anonymous())
    part = ph.cloud_part(points, 5, 64, threads=1, memory_limit="50MB", progress=look)
    assert (part.points, part.coordinates) == (4 << 20, 2)
    assert 0 < most - before < 50_000  # kB


def test_limits_hold():
    points = RNG.random((50_000, 3))
    with pytest.raises(ph.MemoryLimitError):
        ph.cloud_part(points, 0, 1, memory_limit="1MB")
    with pytest.raises(ph.Timeout):
        ph.cloud_part(RNG.random((1_000_000, 3)), 0, 1, timeout=0.01)
    ph.cloud_part(points, 0, 2, progress=lambda *news: None)
