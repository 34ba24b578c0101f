# SPDX-License-Identifier: MIT
"""Beginners' mistakes: likely misunderstandings cause a warning, or an error that names the right
call."""
import inspect
import warnings
from pathlib import Path

import numpy as np
import pytest

import libph as ph
from libph import _core

SERIES = np.random.default_rng(1).standard_normal((60, 8))
CORRELATIONS = np.corrcoef(SERIES.T)


@pytest.mark.parametrize("X, words", [
    (CORRELATIONS, "with 1 on its diagonal, as correlations are; .* takes 1 - X as distances"),
    (1 - CORRELATIONS, "with 0 on its diagonal, as distances are; .* takes X as distances"),
    (1e9 * (1 - CORRELATIONS), "as distances are"), (1e-9 * (1 - CORRELATIONS), "as distances are")])
@pytest.mark.parametrize("function", [ph.rips, ph.estimate, ph.merge_tree])
def test_a_matrix_taken_for_points(function, X, words):
    with pytest.warns(UserWarning, match=f"X: read as 8 points of R.8; .*{words}") as caught:
        function(X)
    assert caught[0].filename == __file__


@pytest.mark.parametrize("X", [
    np.eye(6), 3 * (1 - np.eye(6)), np.zeros((5, 5)), [[0, 1], [1, 0]],
    [[0, 1, 2], [1, 0, 1], [2, 1, 0]], SERIES[:8], SERIES[:8] - SERIES[:8].T, 1e-12 * SERIES[:8], np.triu(np.ones((5, 5))),
    2 * CORRELATIONS], ids=str)
def test_points_that_are_no_matrix(X):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ph.rips(X)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_correlations_given_as_distances(dtype):
    with pytest.raises(ph.DataError, match="as in correlations, .* 1 - X are distances"):
        ph.rips(CORRELATIONS.astype(dtype), metric="precomputed")
    missing = CORRELATIONS.copy()
    missing[2, 3] = np.nan
    with pytest.raises(ph.DataError, match="as in correlations"):
        ph.rips(missing, metric="precomputed")
    bars = ph.rips(1 - CORRELATIONS, metric="precomputed")
    assert len(bars.dgm(0)) == 8
    # An option that is stated explicitly is obeyed without a warning.
    births = ph.rips(np.ones((3, 3)), metric="precomputed", diagonal="births")
    assert births.dgm(0).tolist() == [[1, np.inf]]


def test_metrics_of_scipy():
    with pytest.raises(ph.UsageError, match="found 'correlation', .*; scipy.*pdist has more"):
        ph.rips(SERIES, metric="correlation")


# ---- missing or too large


@pytest.mark.parametrize("shape, place, words", [
    ((3, 4, 5), (1, 2, 3), "index .1, 2, 3."), ((4, 5), (2, 3), "row 2, column 3"),
    ((5,), (3,), "entry 3")])
@pytest.mark.parametrize("function", [ph.cubical, lambda X: ph.merge_tree(X, complex="cubical")],
                         ids=["cubical", "merge_tree"])
def test_nan_in_an_image(function, shape, place, words):
    image = np.ones(shape)
    image[place] = np.nan
    for X in (image, np.ma.masked_invalid(image)):
        with pytest.raises(ph.DataError, match=f"image: {words}: found nan, .*nan='drop'"):
            function(X)
        assert len(ph.cubical(X, nan="drop")) > 0


def test_nan_in_points():
    X = SERIES.copy()
    X[3, 2] = np.nan
    with pytest.raises(ph.DataError, match="point 3, coordinate 2: found nan, .*; nan='drop' leaves"
                       ) as caught:
        ph.rips(X)
    assert caught.value.remedies == (("nan", "drop"),)
    with pytest.raises(ph.DataError, match="input 1: point 3, .*; nan='drop' leaves") as caught:
        ph.batch(ph.rips, [SERIES, X])
    assert caught.value.remedies == (("nan", "drop"),)
    assert len(ph.rips(X, nan="drop").dgm(0)) == 59


@pytest.mark.parametrize("X", ["a.csv", b"a.csv", Path("a.csv")], ids=["str", "bytes", "Path"])
def test_files_are_read_by_read(X):
    for function in (ph.rips, ph.cubical):
        with pytest.raises(ph.UsageError, match="expected an array of numbers; ph.read"):
            function(X)


def test_a_limit_that_is_met_says_what_takes_less():
    X = np.random.default_rng(0).random((2000, 3))
    for options in ({"max_dim": 2}, {"max_dim": 1, "representatives": "cocycles"}):
        with pytest.raises(ph.MemoryLimitError, match="more needed; what would fit: ") as caught:
            ph.rips(X, memory_limit="20MB", **options)
        assert str(caught.value).endswith("; or a larger memory_limit")
        changes = {name: int(value) if name in ("max_dim", "subsample") else value
                   for name, value in caught.value.remedies}
        # With this change, the computation fits.
        ph.rips(X, memory_limit="20MB", **{**options, **changes})
    for less in ({"max_dim": 0}, {"threshold": 0.02}, {"subsample": 20}, {"approximation": 0.5}):
        assert ph.estimate(X, **less).bytes_high < ph.estimate(X).bytes_high


def test_a_barcode_is_no_data(tmp_path):
    # No bar is infinite, and therefore the table could be taken for points.
    bars = ph.rips(SERIES).filter(dim=1)
    for name in ("bars.csv", "bars.json"):
        bars.save(tmp_path / name)
        with pytest.raises(ph.DataError, match="found a barcode, .*ph.read_barcode"):
            ph.read(tmp_path / name)
        assert ph.read_barcode(tmp_path / name) == bars
    points = ph.read(tmp_path / "bars.csv", columns=["birth", "death"])
    assert points.tolist() == bars.dgm(1).tolist()


def test_a_segmentation_is_no_data(tmp_path):
    found = ph.segment(np.argwhere(np.ones((20, 20, 2))) / 100 + [0, 0, 1], plane=False)
    found.save(tmp_path / "scene.tree")
    found.save(tmp_path / "tree.json")
    (tmp_path / "scene.json").write_text('{\n  "format": "ph-segment",\n  "version": 2\n}\n')
    (tmp_path / "frames.json").write_text('{"format": "ph-segment", "version": 2}\n' * 2)
    for name, words in (("scene.tree", "the tree of a segmentation.*ph.segment reads it"),
                        ("tree.json", r"the tree of a segmentation.*save\('x.tree'\)"),
                        ("scene.json", "a segmentation, .*json.load reads it"),
                        ("frames.json", "segmentations, one per line, .*json.loads")):
        with pytest.raises(ph.DataError, match=rf"{name}: found {words}"):
            ph.read(tmp_path / name)
    (tmp_path / "other.json").write_text('{"points": [[0, 1], [2, 3]]}')
    with pytest.raises(ph.DataError, match="other.json: not numbers, found a JSON file"):
        ph.read(tmp_path / "other.json")


def test_diagrams_of_other_shapes():
    bars = ph.rips(SERIES)
    for wrong, words in ((bars.dgms(), "a list of arrays, .* a.1. has the rows of H1"),
                         (bars.to_numpy("gudhi"), "pairs .dimension, .birth, death..")):
        with pytest.raises(ph.UsageError, match=f"a: found {words}"):
            ph.bottleneck(wrong, bars.dgm(1))
    rows = [tuple(row) for row in bars.dgm(1)]
    assert ph.bottleneck(rows, bars.dgm(1)) == 0


def test_a_dimension_is_a_number():
    with pytest.raises(ph.UsageError, match="dim: found 'H1', expected a whole number"):
        ph.rips(SERIES).filter(dim="H1")


# ---- messages in Python's terms

NO_KEYWORDS = {"allow_empty", "labels", "plane_guess", "report"}
METHODS = {"first_meeting"}


def test_each_setting_is_a_keyword():
    functions = [thing for name in ph.__all__ if inspect.isfunction(thing := getattr(ph, name))]
    functions += [ph.LabelTracker, ph.Segmentation.cut, ph.sklearn.Atol]
    known = {"memory_limit"}.union(*(inspect.signature(f).parameters for f in functions))
    keywords = _core.keywords()
    assert {name for name, keyword in keywords.items() if not keyword} == NO_KEYWORDS
    assert {keyword for keyword in keywords.values() if keyword} - known == METHODS


@pytest.mark.parametrize("text, remedies", [
    ("1,2\n3,nan\n", (("nan", "drop"), ("columns", ""))),
    ("0 1\n2 0\n", (("symmetrise", "max"), ("symmetrise", "min"), ("symmetrise", "lower")))])
def test_errors_of_files_know_what_helps(tmp_path, text, remedies):
    path = tmp_path / "a.txt"
    path.write_text(text)
    with pytest.raises(ph.DataError) as caught:
        ph.read(path, "distance" if " " in text else "points")
    assert caught.value.remedies == remedies
    assert all(keyword in str(caught.value) for keyword, _ in remedies)
    with pytest.raises(ph.DataError) as caught:
        ph.farthest_points([[0, np.nan], [np.nan, 0]], metric="precomputed")
    assert not caught.value.remedies and "nan=" not in str(caught.value)
