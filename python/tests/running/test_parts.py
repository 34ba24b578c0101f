# SPDX-License-Identifier: MIT
"""Tests that the parts of an image, computed by separate processes, give the same bars as a single
process."""
import concurrent.futures
import multiprocessing
import pickle
import subprocess

import numpy as np
import pytest

import libph as ph

RNG = np.random.default_rng(5)
IMAGE = RNG.integers(0, 9, (12, 11)).astype(np.uint8)
VOLUME = RNG.random((9, 8, 7)).astype(np.float32)


def parts_of(image, count, **options):
    return [ph.image_part(image, i, count, **options) for i in range(count)]


@pytest.mark.parametrize("options", [
    {}, {"construction": "cells"}, {"superlevel": True}, {"periodic": True}, {"threshold": 5},
    {"periodic": [0], "construction": "cells"}, {"cells": False}, {"max_dim": 0}, {"min_dim": 1}])
@pytest.mark.parametrize("count", [1, 2, 5, 12])
def test_the_same_bars(options, count):
    joined = ph.join_parts(reversed(parts_of(IMAGE, count, **options)))
    assert joined.is_whole
    bars, whole = joined.barcode(), ph.cubical(IMAGE, **options)
    assert bars == whole
    assert len(bars) > 0
    for a, b in zip(bars, whole):
        assert a == b
    for name in ("construction", "superlevel", "shape", "threshold"):
        assert bars.meta.get(name) == whole.meta.get(name), name


def test_volumes_and_other_arrays():
    for options in ({"max_dim": 0}, {"min_dim": 2}):
        for image in (VOLUME, VOLUME[::-1, :, ::2], np.asfortranarray(VOLUME), VOLUME.tolist()):
            assert ph.join_parts(parts_of(image, 3, **options)).barcode() == ph.cubical(image, **options)
    holes = VOLUME.copy()
    holes[2:4, 3] = np.nan
    drop = {"nan": "drop", "max_dim": 0}
    assert ph.join_parts(parts_of(holes, 4, **drop)).barcode() == ph.cubical(holes, **drop)
    with pytest.raises(ph.UsageError, match="dimension 0 alone, or 2 alone"):
        ph.image_part(VOLUME, 0, 2)
    with pytest.raises(ph.UsageError, match="at least two such axes"):
        ph.image_part(np.zeros(2), 0, 1)


def test_more_axes():
    image = np.random.default_rng(4).integers(0, 4, (5, 3, 4, 3))
    for construction in ("vertices", "cells"):
        for options in ({"max_dim": 0}, {"min_dim": 3}, {"max_dim": 0, "periodic": (0, 2)}):
            options = {**options, "construction": construction}
            whole = ph.cubical(image, **options)
            for count in (1, 3, 5):
                assert ph.join_parts(parts_of(image, count, **options)).barcode() == whole
    with pytest.raises(ph.UsageError, match="dimension 0 alone, or 3 alone"):
        ph.image_part(image, 0, 2)


def test_any_grouping():
    a, b, c, d = parts_of(IMAGE, 4)
    left = ph.join_parts([ph.join_parts([a, b]), ph.join_parts([d, c])])
    assert left == ph.join_parts([ph.join_parts([b, c, a]), d])
    assert not ph.join_parts([b, c]).is_whole
    assert (left.first, left.last, left.parts, left.shape) == (0, 3, 4, (12, 11))
    assert "0 to 3 of 4" in repr(left)


def test_what_does_not_belong_together():
    a, b, c = parts_of(IMAGE, 3)
    other = ph.image_part(IMAGE[::-1].copy(), 1, 3)
    for parts in ([a, c], [a, a], [a, other], [a, ph.image_part(IMAGE, 1, 3, superlevel=True)], []):
        with pytest.raises(ph.DataError):
            ph.join_parts(parts)
    with pytest.raises(ph.DataError, match="found 2 of 3"):
        ph.join_parts([a, b]).barcode()
    with pytest.raises(ph.UsageError, match="expected ImagePart"):
        ph.join_parts([a, b"part"])
    for part, parts in ((3, 3), (-1, 3), (0, 0), (0, 13), (0.5, 3)):
        with pytest.raises(ph.UsageError):
            ph.image_part(IMAGE, part, parts)


def test_bytes_are_those_of_a_file(tmp_path):
    part = ph.image_part(IMAGE, 1, 3)
    data = part.to_bytes()
    assert ph.ImagePart.from_bytes(data) == part == pickle.loads(pickle.dumps(part))
    assert hash(pickle.loads(pickle.dumps(part))) == hash(part)
    for at in range(0, len(data), 7):
        damaged = bytearray(data)
        damaged[at] ^= 1
        with pytest.raises(ph.DataError):
            ph.ImagePart.from_bytes(damaged)
    with pytest.raises(ph.UsageError, match="expected bytes"):
        ph.ImagePart.from_bytes("part")


def test_the_program_has_the_same_files(program, tmp_path):
    np.save(tmp_path / "image.npy", IMAGE)
    for i in range(3):
        path = tmp_path / f"{i}.ph"
        subprocess.run([program, "image.npy", "--part", f"{i + 1}/3", "-o", path, "--quiet",
                        "--keep-cells"], cwd=tmp_path, check=True)
        assert path.read_bytes() == ph.image_part(IMAGE, i, 3).to_bytes()


def _part_of_file(path, part, parts):
    return ph.image_part(np.load(path, mmap_mode="r"), part, parts, max_dim=0, threads=1)


def test_processes_that_share_a_file(tmp_path):
    path = tmp_path / "volume.npy"
    np.save(path, VOLUME)
    spawn = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=spawn) as pool:
        parts = list(pool.map(_part_of_file, [path] * 4, range(4), [4] * 4))
    assert ph.join_parts(parts).barcode() == ph.cubical(VOLUME, max_dim=0)


def test_limits_hold():
    image = RNG.random((300, 400))
    with pytest.raises(ph.MemoryLimitError):
        ph.image_part(image, 0, 1, memory_limit="1MB")
    seen = []
    ph.image_part(image, 0, 2, progress=lambda *news: seen.append(news))
    with pytest.raises(TypeError, match="thread"):
        ph.image_part(image, 0, 2, thread=1)
