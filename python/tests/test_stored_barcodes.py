# SPDX-License-Identifier: MIT
"""Tests barcodes that are written to files and read back."""
import json
import pickle

import numpy as np
import pytest

import libph as ph
from barcodes import CIRCLE, POINTS, VOLUME, each, parts, same


def test_names_that_promise_packed_files(tmp_path):
    with pytest.raises(ph.UsageError, match="found .gz, expected a name without this ending"):
        ph.rips([[0], [1]]).save(tmp_path / "bars.json.gz", format="json")
    assert not list(tmp_path.iterdir())


@each
@pytest.mark.parametrize("extension", ["csv", "json", "pers", "dipha", "npy", "ripser"])
def test_save_and_read(bars, extension, tmp_path):
    path = tmp_path / f"bars.{extension}"
    bars.save(path)
    other = ph.read_barcode(path, extension)
    if extension == "ripser":
        assert np.allclose(np.asarray(other), np.asarray(bars), rtol=1e-5, equal_nan=False)
        return
    assert other == bars
    if extension == "json":
        check_whole(other, bars)


def check_whole(other, bars):
    """Checks that `other` has everything that `bars` has."""
    assert other == bars and same(parts(other), parts(bars))
    lost = {name: value for name, value in bars.meta.items()
            if other.meta.get(name) != value and (value or name in other.meta)}
    assert not lost
    assert repr(other) == repr(bars)


DISTANCES = [[0.5, 1.0, 2.0], [1.0, 0.25, 1.5], [2.0, 1.5, 0.0]]
TORUS = np.random.default_rng(3).random((4, 5, 6))


@pytest.mark.parametrize("make", [
    lambda: ph.rips(POINTS, max_dim=2, representatives="cycles", threshold=2.0),
    lambda: ph.rips(POINTS, field=3, representatives="cycles", loops="plain"),
    lambda: ph.rips(POINTS, representatives="cocycles", field=5),
    lambda: ph.rips(POINTS, representatives="cycles", cells=False),
    lambda: ph.rips(POINTS, subsample=20), lambda: ph.rips(POINTS, approximation=0.5),
    lambda: ph.rips(POINTS, collapse=True), lambda: ph.rips(POINTS, metric="minkowski", minkowski_p=3),
    lambda: ph.rips(POINTS, weights="dtm", dtm_neighbors=4, weight_exponent=2),
    lambda: ph.rips(POINTS, weights="core", core_neighbors=3),
    lambda: ph.rips(POINTS, weights=np.ones(len(POINTS))),
    lambda: ph.rips(DISTANCES, metric="precomputed", diagonal="births"),
    lambda: ph.cubical(TORUS, representatives="voxels"),
    lambda: ph.cubical(TORUS, representatives="voxels", superlevel=True, construction="cells"),
    lambda: ph.cubical(TORUS[0], representatives="voxels", cells=False),
    lambda: ph.cubical(TORUS, representatives="voxels", cells=False, min_dim=1),
    lambda: ph.cubical(TORUS, representatives="voxels").filter(dim=2),
    lambda: ph.cubical(TORUS, representatives="cycles", periodic=[0, 2], min_persistence=0.1),
    lambda: ph.cubical(TORUS, representatives="cocycles"),
    lambda: ph.lower_star([0, 2, 1], [[0, 1], [1, 2]], representatives="cycles"),
    lambda: ph.filtered([[0], [1], [0, 1]], [0, 0, 1]),
    lambda: ph.rips([]),
])
def test_json_brings_everything_back(make, tmp_path):
    bars = make()
    bars.save(tmp_path / "bars.json")
    other = ph.read_barcode(tmp_path / "bars.json")
    check_whole(other, bars)
    other.save(tmp_path / "again.json")
    assert (tmp_path / "again.json").read_text() == (tmp_path / "bars.json").read_text()


def test_voxels_of_files(tmp_path):
    bars = ph.cubical(TORUS, representatives="voxels")
    bars.save(tmp_path / "v.json")
    bars.save(tmp_path / "v.csv")
    other = ph.read_barcode(tmp_path / "v.json")
    for i in range(len(bars)):
        assert np.array_equal(other.voxels(i), bars.voxels(i))
        assert other.birth_voxel(i) == bars.birth_voxel(i)
        assert other.death_voxel(i) == bars.death_voxel(i)
    table = ph.read_barcode(tmp_path / "v.csv")
    for ask in (lambda: table.voxels(0), lambda: table.birth_voxel(0), lambda: table.birth_cells(0),
                lambda: table.representative(0)):
        with pytest.raises(ph.UsageError, match="found none, .* save them as .json"):
            ask()
    with pytest.raises(ph.UsageError, match="representatives='voxels'$"):
        ph.cubical(TORUS).voxels(0)


def test_p_values_of_files(tmp_path):
    (tmp_path / "p.csv").write_text("dim,birth,death,p\n1,2,3,0.5\n1,1,3,0.25\n0,0,inf,\n")
    bars = ph.read_barcode(tmp_path / "p.csv")
    assert ph.rips(POINTS).p_values is None
    assert bars.p_values[1:].tolist() == [0.25, 0.5] and np.isnan(bars.p_values[0])
    assert bars.filter(dim=1).p_values.tolist() == [0.25, 0.5]
    assert pickle.loads(pickle.dumps(bars)).p_values[1:].tolist() == [0.25, 0.5]
    for name in ("again.csv", "again.json"):
        bars.save(tmp_path / name)
        assert np.array_equal(ph.read_barcode(tmp_path / name).p_values, bars.p_values, equal_nan=True)


def test_files_of_other_programs_say_what_is_left_out(tmp_path, caplog):
    caplog.set_level("INFO", logger="libph")
    (tmp_path / "b.csv").write_text("dim,birth,death,lifetime\n0,0,1,1\n")
    ph.read_barcode(tmp_path / "b.csv")
    assert [record.message for record in caplog.records] == [
        f"{tmp_path / 'b.csv'}: not kept: lifetime"]


@pytest.mark.parametrize("make, members, meta", [
    (lambda: ph.rips(POINTS, metric="cityblock", min_persistence=0.25),
     {"metric": "manhattan", "min_persistence": 0.25}, {}),
    (lambda: ph.rips(POINTS, metric="minkowski", minkowski_p=3.5, max_dim=2, min_dim=1),
     {"metric": "minkowski:3.5", "min_dim": 1}, {"metric": "minkowski", "minkowski_p": 3.5}),
    (lambda: ph.rips(POINTS, metric="minkowski", minkowski_p=np.inf),
     {"metric": "minkowski:inf"}, {"metric": "minkowski", "minkowski_p": np.inf}),
    (lambda: ph.rips(POINTS, metric=lambda x, y: float(abs(x - y).max())), {"metric": "function"},
     {}),
    (lambda: ph.rips(DISTANCES, metric="precomputed", diagonal="births"),
     {"metric": "precomputed", "vertex_weights": "diagonal, exponent inf"}, {}),
    (lambda: ph.rips(POINTS, weights="dtm", dtm_neighbors=4),
     {"metric": "euclidean", "vertex_weights": "dtm 4, exponent 1"}, {}),
    (lambda: ph.rips(POINTS, weights=np.ones(60), weight_exponent=2),
     {"vertex_weights": "given, exponent 2"}, {}),
    (lambda: ph.cubical(VOLUME, construction="cells", periodic=[0, 2], superlevel=True),
     {"construction": "cells", "periodic": [0, 2], "superlevel": True, "min_persistence": 0},
     {"periodic": (0, 2)}),
], ids=["alias", "exponent", "infinity", "function", "diagonal", "dtm", "weights", "image"])
def test_json_says_what_the_bars_are_of(make, members, meta, tmp_path):
    bars = make()
    bars.save(tmp_path / "bars.json")
    text = json.loads((tmp_path / "bars.json").read_text())
    assert {name: text.get(name) for name in members} == members
    assert text["input"]["description"]
    back = ph.read_barcode(tmp_path / "bars.json")
    expected = {**members, **meta}
    assert {name: back.meta.get(name) for name in expected} == expected
    back.save(tmp_path / "again.json")
    again = json.loads((tmp_path / "again.json").read_text())
    assert {name: again.get(name) for name in members} == members


def test_an_exponent_that_a_file_leaves_out(tmp_path):
    (tmp_path / "bars.json").write_text('{"format": "ph-barcode", "version": 1, "complex": "rips", '
                                        '"metric": "minkowski", "bars": []}')
    bars = ph.read_barcode(tmp_path / "bars.json")
    bars.save(tmp_path / "again.json")
    assert json.loads((tmp_path / "again.json").read_text())["metric"] == "minkowski"


def test_files_that_fail(tmp_path):
    bars = ph.rips(CIRCLE)
    with pytest.raises(ph.UsageError, match="csv, json"):
        bars.save(tmp_path / "bars.txt")
    with pytest.raises(ph.UsageError, match="csv, json"):
        bars.save(tmp_path / "bars.csv", format="none")
    with pytest.raises(ph.OutputError):
        bars.save(tmp_path / "nowhere" / "bars.csv")
    with pytest.raises(ph.MissingInputError):
        ph.read_barcode(tmp_path / "missing.csv")
    with pytest.raises(FileNotFoundError):
        ph.read_barcode(tmp_path / "missing.csv")
    (tmp_path / "bad.csv").write_text("dim,birth,death\n0,2,1\n")
    with pytest.raises(ph.DataError, match="bad.csv:2"):
        ph.read_barcode(tmp_path / "bad.csv")
    for path in (None, 3, "", "a\0b"):
        with pytest.raises(ph.UsageError, match="path: found"):
            bars.save(path)


def test_a_dash_is_a_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    ph.rips(CIRCLE).save("-", format="csv")
    assert (tmp_path / "-").exists() and ph.read_barcode("-") == ph.rips(CIRCLE)
