# SPDX-License-Identifier: MIT
"""Tests Barcode as a sequence, and its arrays, cells, chains and summaries."""
import copy
import html.parser
import math
import pickle
from collections.abc import Sequence

import numpy as np
import pytest

import libph as ph
from barcodes import CIRCLE, POINTS, VOLUME, each, parts, same


@each
def test_sequence(bars):
    assert isinstance(bars, Sequence)
    listed = list(bars)
    assert len(listed) == len(bars) and listed == sorted(listed, key=lambda b: b[:3])
    assert all(type(b) is ph.Bar and type(b.dim) is int and type(b.birth) is float for b in listed)
    for i, bar in enumerate(listed):
        assert bars[i] == bar == bars[i - len(listed)] == bars[np.int64(i)]
        assert bar in bars and bars.index(bar) <= i and bars.count(bar) >= 1
    assert list(reversed(bars)) == listed[::-1]
    for out in (len(listed), -len(listed) - 1):
        with pytest.raises(IndexError):
            bars[out]
    with pytest.raises(TypeError):
        bars["x"]


@each
def test_arrays(bars):
    assert (bars.dims.dtype, bars.births.dtype, bars.deaths.dtype) == (np.int64, float, float)
    table = np.array([*bars], dtype=float).reshape(-1, 3)
    assert np.array_equal(np.asarray(bars), table)
    assert np.asarray(bars, dtype=np.float32).dtype == np.float32
    assert np.array_equal(bars.to_numpy(), table)
    dgms = bars.dgms()
    assert sum(map(len, dgms)) == len(bars)
    for dim, dgm in enumerate(dgms):
        assert dgm.shape == (len(dgm), 2) and dgm.dtype == np.float64 and dgm.flags.writeable
        assert np.array_equal(dgm, table[table[:, 0] == dim][:, 1:])
        dgm[...] = 7  # a copy: the barcode does not change
    assert np.array_equal(np.asarray(bars), table)
    for array in (bars.dims, bars.births, bars.deaths):
        with pytest.raises(ValueError):
            array[...] = 0
    assert bars.dgm(17).shape == (0, 2)


def test_layouts_of_others():
    bars = ph.rips(POINTS, max_dim=2)
    table = np.asarray(bars)
    assert np.array_equal(bars.to_numpy("giotto"), table[:, [1, 2, 0]])
    ripser = bars.to_numpy("ripser")
    assert (np.diff(ripser[0][:, 1][:-1]) >= 0).all() and np.isinf(ripser[0][-1, 1])
    for dgm in ripser[1:]:
        assert (np.diff(dgm[:, 0]) <= 0).all()
    gudhi = bars.to_numpy("gudhi")
    assert sorted(gudhi) == sorted((d, (b, e)) for d, b, e in bars)
    assert [d for d, _ in gudhi] == sorted((d for d, _ in gudhi), reverse=True)
    frame = bars.to_pandas()
    assert list(frame.columns) == ["dim", "birth", "death"]
    assert np.array_equal(frame.to_numpy(), table)
    with pytest.raises(ph.UsageError):
        bars.to_numpy("numpy")


@each
def test_pickle(bars):
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        other = pickle.loads(pickle.dumps(bars, protocol))
        assert other == bars and hash(other) == hash(bars) and repr(other) == repr(bars)
        assert dict(other.meta) == dict(bars.meta)
    assert same(parts(other), parts(bars))
    assert copy.copy(bars) is bars and copy.deepcopy(bars) is bars


def test_a_damaged_pickle_is_refused():
    restored, (version, state, meta) = ph.rips(POINTS, representatives="cycles").__reduce__()
    with pytest.raises(ph.UsageError, match="version"):
        restored(version + 1, state, meta)
    for name, array in state.items():
        missing = {other: member for other, member in state.items() if other != name}
        for damaged in (missing, {**state, name: None}, {**state, name: "text"},
                        {**state, name: (np.zeros(3), 7)}):
            with pytest.raises(ph.DataError, match="state of a barcode: found damaged"):
                restored(version, damaged, meta)
        if not isinstance(array, tuple):
            continue
        numbers, ends = array
        for wrong in ((numbers[:-1], ends), (numbers, ends[::-1].copy()), (numbers, ends + 1),
                      (numbers, -ends), (numbers, ends[:-1])):
            try:
                restored(version, {**state, name: wrong}, meta)
            except ph.DataError:
                pass


def test_equality_and_hash():
    bars = ph.rips(CIRCLE)
    assert bars == ph.rips(CIRCLE, representatives="cycles") != ph.rips(CIRCLE[1:])
    assert bars != list(bars) and bars is not None
    assert len({bars, ph.rips(CIRCLE), ph.rips(CIRCLE[1:])}) == 2


def test_it_cannot_be_changed():
    bars = ph.rips(CIRCLE)
    with pytest.raises(AttributeError):
        bars.births = 3
    with pytest.raises(TypeError):
        bars[0] = (0, 0, 0)
    with pytest.raises(TypeError):
        bars.meta["field"] = 3
    with pytest.raises(TypeError):
        ph.Barcode()


# ---- metadata


def test_meta():
    meta = ph.rips(POINTS, max_dim=2, field=3, threshold=1.5).meta
    assert meta["complex"] == "rips" and meta["field"] == 3 and meta["max_dim"] == 2
    assert meta["threshold"] == 1.5 and meta["points"] == 60 and meta["coordinates"] == 3
    assert meta["engine"] == "edge-links" and meta["version"] == ph.__version__
    assert meta["edges"] == sum(np.linalg.norm(a - b) <= 1.5 for i, a in enumerate(POINTS)
                                for b in POINTS[:i])
    assert hash(meta) == hash(ph.rips(POINTS, max_dim=2, field=3, threshold=1.5).meta)
    assert ph.cubical(VOLUME).meta["shape"] == (6, 7, 5)
    sample = ph.rips(POINTS, subsample=20).meta
    assert sample["vertices"] == 20 and sample["points"] == 60
    assert sample["covering_radius"] == ph.farthest_points(POINTS, 20).covering_radius


def test_repr():
    assert repr(ph.rips(np.zeros((1024, 9)) + np.arange(1024)[:, None])) == \
        "Barcode(rips of 1 024 points in R^9, field 2: 1 024 bars of H0)"
    assert repr(ph.rips([])) == "Barcode(rips of 0 points in R^0, field 2: no bars)"
    assert "of 20 points in R^2, field 2: 20 bars of H0, 1 of H1, longest [0.31" in repr(
        ph.rips(CIRCLE))
    assert repr(ph.cubical(VOLUME)).startswith("Barcode(cubical of 6 x 7 x 5, field 2: ")


@each
def test_html(bars):
    class Tags(html.parser.HTMLParser):
        def __init__(self):
            super().__init__()
            self.open, self.seen = [], set()

        def handle_starttag(self, tag, attributes):
            self.seen.add(tag)
            if tag != "br":
                self.open.append(tag)
            assert not any(name.startswith("on") for name, _ in attributes)

        def handle_startendtag(self, tag, attributes):
            self.seen.add(tag)

        def handle_endtag(self, tag):
            assert self.open.pop() == tag

    text = bars._repr_html_()
    tags = Tags()
    tags.feed(text)
    assert not tags.open and "svg" in tags.seen and "script" not in tags.seen
    assert len(text) < 1_000_000


# ---- cells and chains


def test_cells_are_those_of_the_values():
    bars = ph.rips(POINTS, max_dim=2)
    distances = np.linalg.norm(POINTS[:, None] - POINTS, axis=2)

    def diameters(cells):
        return [max([distances[i, j] for i in cell for j in cell]) for cell in cells]

    for dim in range(3):
        births, deaths = bars.birth_cells(dim), bars.death_cells(dim)
        assert births.shape == (len(bars.dgm(dim)), dim + 1) and births.dtype == np.int64
        assert deaths.shape == (len(bars.dgm(dim)), dim + 2)
        assert np.allclose(diameters(births), bars.dgm(dim)[:, 0])
        dies = np.isfinite(bars.dgm(dim)[:, 1])
        assert (deaths[~dies] == -1).all()
        assert np.allclose(diameters(deaths[dies]), bars.dgm(dim)[dies, 1])
    for i, bar in enumerate(bars):
        assert math.isclose(diameters([bars.birth_cell(i)])[0], bar.birth)
        killer = bars.death_cell(i)
        assert bar.death == math.inf if killer is None else \
            math.isclose(diameters([killer])[0], bar.death)
    image = ph.cubical(VOLUME)
    assert image.birth_cells(1).shape == (len(image.dgm(1)), 3)
    assert bars.birth_cells(7).shape == (0, 8)
    with pytest.raises(ph.UsageError, match="cells=True"):
        ph.rips(POINTS, cells=False).birth_cells(0)


def test_the_loop_of_a_circle():
    bars = ph.rips(CIRCLE, representatives="cycles")
    chain = bars.representative(bars.longest(1))
    assert chain.loop().tolist() == list(range(20))
    assert chain.tightness == "shortest" and len(chain) == 20
    (loop,) = chain.loops()
    assert loop.coefficient == 1
    assert math.isclose(loop.length, 20 * np.linalg.norm(CIRCLE[0] - CIRCLE[1]))
    dense = chain.to_dense(20)
    assert dense.shape == (20, 20) and dense.sum() == 20 and dense[0, 1] == 1 and dense[1, 0] == 0
    with pytest.raises(ph.UsageError, match="n: found 19"):
        chain.to_dense(19)


def test_loops_of_other_chains():
    cocycle = ph.rips(CIRCLE, representatives="cocycles")
    with pytest.raises(ph.UsageError, match="cocycle"):
        cocycle.representative(cocycle.longest(1)).loop()
    component = ph.rips(CIRCLE, representatives="cycles").representative(0)
    with pytest.raises(ph.UsageError):
        component.loop()
    with pytest.raises(ph.UsageError, match="representatives='cycles'"):
        ph.rips(CIRCLE).representative(0)
    for out in (21, -22, "x", 1.5):
        with pytest.raises(ph.UsageError, match="i: found"):
            cocycle.representative(out)
    assert len(cocycle.representative(-1)) == len(cocycle.representative(20))
    ring = [[9, 9, 9, 9], [9, 1, 1, 9], [9, 1, 1, 9], [9, 9, 9, 9]]
    picture = ph.cubical(np.pad(ring, 1), representatives="cycles", superlevel=True)
    loop = picture.representative(picture.longest(1)).loop()
    assert loop.shape == (12, 2) and (loop % 2 == 0).all()


def test_voxels():
    image = np.array([[9, 9, 9, 9, 9, 9], [9, 1, 1, 1, 9, 3], [9, 1, 7, 1, 9, 3],
                      [9, 1, 1, 1, 9, 9], [9, 9, 9, 9, 9, 9]])
    bars = ph.cubical(image, representatives="voxels")
    assert list(bars) == [(0, 1, np.inf), (0, 3, 9), (1, 1, 7)]
    assert bars.voxels(0).all() and bars.voxels(0).shape == image.shape
    assert np.argwhere(bars.voxels(1)).tolist() == [[1, 5], [2, 5]]
    assert np.argwhere(bars.voxels(2)).tolist() == [[2, 2]]
    assert image[bars.birth_voxel(1)] == 3 and image[bars.death_voxel(1)] == 9
    assert bars.death_voxel(0) is None
    with pytest.raises(ph.UsageError, match="representatives='voxels'"):
        ph.cubical(image).voxels(0)


# ---- selections and summaries


@each
def test_selections(bars):
    kept = np.flatnonzero((bars.dims == 1) & (bars.births < 5))
    some = bars.filter(dim=1, born_before=5)
    assert list(some) == [bars[int(i)] for i in kept] and some.meta == bars.meta
    assert list(bars[1::2]) == list(bars)[1::2] and list(bars[::-1]) == list(bars)
    assert same(parts(bars.filter()), parts(bars))
    if bars.meta.get("representatives"):
        for k, i in enumerate(kept.tolist()):
            assert np.array_equal(some.representative(k).cells, bars.representative(i).cells)
    long = bars.filter(min_persistence=0.5)
    assert list(long) == [b for b in bars if b.persistence > 0.5]
    assert list(bars.filter(dim=[0, 2])) == [b for b in bars if b.dim in (0, 2)]
    assert same(parts(pickle.loads(pickle.dumps(long))), parts(long))


def test_longest():
    bars = ph.rips(POINTS)
    lengths = [b.persistence for b in bars]
    assert bars[bars.longest(0)].death == np.inf
    best = bars.longest(1)
    assert type(best) is int and bars[best].dim == 1
    assert lengths[best] == max(b.persistence for b in bars if b.dim == 1)
    three = bars.longest(1, 3)
    assert three[0] == best and [lengths[i] for i in three] == sorted(
        (b.persistence for b in bars if b.dim == 1), reverse=True)[:3]
    assert bars.longest(1, 0).size == 0 and len(bars.longest(1, 10**6)) == len(bars.dgm(1))
    with pytest.raises(ph.UsageError, match="no bar of dimension 5"):
        bars.longest(5)


@each
def test_betti_numbers(bars):
    grid = np.unique(np.concatenate([bars.births, bars.deaths, [0, 1.5, -np.inf, np.inf]]))
    curve = bars.betti_curve(grid)
    for k, t in enumerate(grid):
        by_hand = [sum(b.dim == d and b.birth <= t < b.death for b in bars)
                   for d in range(len(curve))]
        if t < np.inf:
            assert curve[:, k].tolist() == by_hand == bars.betti(t).tolist()


def test_entropy():
    assert ph.rips([[0], [1], [2]]).entropy(0) == pytest.approx(math.log(2))
    assert ph.rips([[0], [1]]).entropy(0) == 0 == ph.rips([]).entropy(1)
    lengths = np.diff(ph.rips(POINTS).dgm(1))[:, 0]
    share = lengths / lengths.sum()
    assert ph.rips(POINTS).entropy(1) == pytest.approx(-(share * np.log(share)).sum())
