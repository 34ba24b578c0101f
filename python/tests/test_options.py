# SPDX-License-Identifier: MIT
"""Options: the package and the program have the same defaults, and meaningless values are refused
with a message."""
import threading

import numpy as np
import pytest

import libph as ph
from libph import _options

SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]
IMAGE = np.arange(12).reshape(3, 4)
NAN, INF = float("nan"), float("inf")

# (function, its data, option, refused values)
WHOLE = ["x", None, 1.5, NAN, INF, [1], (1,), {}, 2**70, -2**70, True, np.True_,
         np.array([1, 2]), 1j]
REFUSED = [
    (ph.rips, SQUARE, "max_dim", [-1, *[v for v in WHOLE if v is not None]]),
    (ph.rips, SQUARE, "min_dim", [-1, *WHOLE]),
    (ph.rips, SQUARE, "field", [0, 1, 4, 9, -3, 2**31, 2**31 + 11, *WHOLE]),
    (ph.rips, SQUARE, "threshold", ["x", -1, -INF, NAN, [1], True, np.True_, 1j,
                                    np.array([1, 2])]),
    (ph.rips, SQUARE, "metric", ["x", "", None, 3, ["euclidean"], "Euclidean", b"euclidean"]),
    (ph.rips, SQUARE, "minkowski_p", [3, 0.5, NAN, "2", None]),
    (ph.rips, SQUARE, "weights", ["DTM", "x", 1, [1, 2]]),
    (ph.rips, SQUARE, "dtm_neighbors", [2]),
    (ph.rips, SQUARE, "core_neighbors", [2]),
    (ph.rips, SQUARE, "weight_exponent", [1]),
    (ph.rips, SQUARE, "subsample", [0, -1, "x", 1.5]),
    (ph.rips, SQUARE, "subsample_radius", [-1, NAN, INF, "x"]),
    (ph.rips, SQUARE, "approximation", [0, -1, NAN, INF, "x"]),
    (ph.rips, SQUARE, "merge_equal_points", [1, "yes", []]),
    (ph.rips, SQUARE, "device", ["cuda", "GPU", None, 0]),
    (ph.rips, SQUARE, "collapse", ["x", None, 1, 0, []]),
    (ph.rips, SQUARE, "representatives", ["x", True, 1, "voxels", ["cycles"]]),
    (ph.rips, SQUARE, "loops", ["tight", "plain", "x"]),
    (ph.rips, SQUARE, "min_persistence", [NAN, "x", None, [0], True]),
    (ph.rips, SQUARE, "cells", [1, None, "yes"]),
    (ph.rips, SQUARE, "engine", ["x", None, "gradient", 3, ""]),
    (ph.rips, SQUARE, "nan", ["x", None, True]),
    (ph.rips, SQUARE, "diagonal", ["births", "any", "x"]),
    (ph.rips, SQUARE, "symmetrise", ["max", "x"]),
    (ph.rips, SQUARE, "threads", [0, -1, "x", 1.5, 10**9]),
    (ph.rips, SQUARE, "memory_limit", [0, -1, "x", "4 GiB of it", "", NAN, INF, [], "1e400"]),
    (ph.rips, SQUARE, "timeout", [0, -1, NAN, INF, "x"]),
    (ph.rips, SQUARE, "progress", ["x", 1, []]),
    (ph.rips, SQUARE, "stop", ["x", True, threading.Thread]),
    (ph.cubical, IMAGE, "construction", ["x", None, "V"]),
    (ph.cubical, IMAGE, "superlevel", [1, None, "yes"]),
    (ph.cubical, IMAGE, "periodic", [2, -3, [0, 5], "ALL", ["all"], [True], [0.5], None, 1.5]),
    (ph.cubical, IMAGE, "threshold", [NAN, "x"]),
    (ph.cubical, IMAGE, "max_dim", [-1, "x"]),
    (ph.cubical, IMAGE, "engine", ["edge-links"]),
    (ph.cubical, IMAGE, "loops", ["tight"]),
    (ph.cubical, IMAGE, "slab_layers", [0, -1, "x"]),
    (ph.merge_tree, SQUARE, "max_dim", [1]),
    (ph.merge_tree, SQUARE, "superlevel", []),
    (ph.merge_tree, SQUARE, "complex", ["x", "lower-star", 1]),
    (ph.estimate, SQUARE, "complex", ["x"]),
    (ph.farthest_points, SQUARE, "n", [0, -1, "x", 1.5]),
    (ph.farthest_points, SQUARE, "radius", [-1, NAN, INF, "x"]),
    (ph.collapse, IMAGE[:, :3] * 0, "diagonal", ["births"]),
    (ph.collapse, IMAGE[:, :3] * 0, "threshold", [-1, NAN]),
]


@pytest.mark.parametrize("function, data, name, value", [
    pytest.param(function, data, name, value, id=f"{function.__name__}-{name}-{value!r:.20}")
    for function, data, name, values in REFUSED for value in values])
def test_refused(function, data, name, value):
    with pytest.raises(ph.UsageError) as caught:
        function(data, **{name: value})
    assert name in str(caught.value).replace(" ", "_"), str(caught.value)


@pytest.mark.parametrize("function, arguments", [
    (ph.point_image, (SQUARE, 0)), (ph.point_image, (SQUARE, -1)), (ph.point_image, (SQUARE, NAN)),
    (ph.point_image, (SQUARE, "x")), (ph.distance_to_measure, (SQUARE, 0)),
    (ph.distance_to_measure, (SQUARE, 5)), (ph.distance_to_measure, (SQUARE, "x"))])
def test_refused_arguments(function, arguments):
    with pytest.raises(ph.UsageError):
        function(*arguments)


@pytest.mark.parametrize("keywords, words", [
    ({"weights": "dtm"}, "dtm_neighbors"),
    ({"weights": "core"}, "core_neighbors"),
    ({"weights": "core", "core_neighbors": 4}, "0 to 3"),
    ({"weights": "core", "core_neighbors": 2, "dtm_neighbors": 2}, "dtm_neighbors: does nothing"),
    ({"weights": "dtm", "dtm_neighbors": 5}, "1 to 4"),
    ({"weights": "dtm", "dtm_neighbors": 2, "subsample": 2}, "subsample: cannot be combined with weights"),
    ({"weights": [0, 0, 0, 0], "approximation": 1}, "approximation: cannot be combined with weights"),
    ({"representatives": "cocycles", "collapse": True}, "collapse"),
    ({"representatives": "cocycles", "loops": "plain"}, "loops"),
    ({"min_persistence": -1, "collapse": True}, "collapse"),
    ({"engine": "union-find", "max_dim": 1}, "union-find"),
])
def test_options_that_exclude_each_other(keywords, words):
    with pytest.raises(ph.UsageError, match=words):
        ph.rips(SQUARE, **keywords)


@pytest.mark.parametrize("function, data", [
    (ph.rips, SQUARE), (ph.cubical, IMAGE), (ph.estimate, SQUARE), (ph.merge_tree, SQUARE),
    (ph.farthest_points, SQUARE), (ph.collapse, np.zeros((2, 2)))])
def test_unknown_keywords(function, data):
    with pytest.raises(TypeError, match="unexpected keyword argument 'maxdim'"):
        function(data, maxdim=1)


def test_numbers_of_numpy_are_numbers():
    assert ph.rips(SQUARE, max_dim=np.int64(2), threshold=np.float32(1.5), field=np.uint8(3),
                   cells=np.True_, timeout=np.float64(60), threads=np.int32(1)) == \
        ph.rips(SQUARE, max_dim=2, threshold=1.5, field=3)


def test_scalars_of_numpy_are_choices():
    """An array of words or bools, such as a row of a table of options, has such scalars."""
    words = np.array(["euclidean", "drop"])
    assert ph.rips(SQUARE, metric=words[0], nan=words[1], collapse=np.True_) == ph.rips(SQUARE)
    with pytest.raises(ph.UsageError, match="^nan: found 'euclidean', expected 'error' or 'drop'"):
        ph.rips(SQUARE, nan=words[0])


def test_names_of_engines():
    for name in ("auto", "standard", "cohomology", "edge-links", "lens"):
        assert ph.rips(SQUARE, engine=name) == ph.rips(SQUARE)
    assert ph.rips(SQUARE, engine="lens").meta["engine"] == "edge-links"


def test_other_names_of_metrics():
    for name, other in (("l1", "manhattan"), ("cityblock", "manhattan"), ("l2", "euclidean")):
        assert ph.rips(SQUARE, metric=name) == ph.rips(SQUARE, metric=other)


@pytest.mark.parametrize("text, size", [
    ("1", 1), ("1e9", 10**9), ("500MB", 500 * 10**6), ("4GiB", 4 << 30), ("1.5k", 1500),
    ("2 Mi", 2 << 20), (" 3 tib ", 3 << 40), (1e6, 10**6), (np.int64(7), 7)])
def test_sizes(text, size):
    assert _options.size("memory_limit", text) == size


def test_axes_that_close_up():
    image = np.random.default_rng(0).integers(0, 9, size=(4, 5, 3))
    both = ph.cubical(image, periodic=[0, 2])
    for same in ((0, -1), [True, False, True], np.array([0, 2]), {0, 2},
                 np.array([True, False, True]), (np.True_, False, np.True_)):
        assert ph.cubical(image, periodic=same) == both
    for every in ("all", True, np.True_):
        assert ph.cubical(image, periodic=every) == ph.cubical(image, periodic=[0, 1, 2])
    assert ph.cubical(image, periodic=1) == ph.cubical(image, periodic=[1])
    assert ph.cubical(image, periodic=False) == ph.cubical(image)
    assert both.meta["periodic"] == (0, 2)


def test_defaults_are_those_of_the_program():
    """For points, max_dim is 1 by default. H0 of points needs no threshold."""
    assert ph.rips(SQUARE).meta["max_dim"] == 1
    assert ph.rips(SQUARE, max_dim=0).meta["engine"] == "union-find"
    assert "threshold" not in ph.rips(SQUARE, max_dim=0).meta


def test_merge_equal_points():
    points = np.repeat(SQUARE, 3, axis=0)
    assert ph.rips(points).meta["vertices"] == 4
    assert ph.rips(points, merge_equal_points=False).meta["vertices"] == 12
    assert ph.rips(points, min_persistence=-1).meta["vertices"] == 12
    assert ph.rips(points, merge_equal_points=False) == ph.rips(points)


def test_slab_layers_change_nothing():
    image = np.random.default_rng(0).integers(0, 99, size=(20, 20, 20)).astype(np.uint8)
    assert ph.cubical(image, slab_layers=3) == ph.cubical(image)


def test_errors_are_those_of_python_too():
    for error, other in ((ph.UsageError, ValueError), (ph.DataError, ValueError),
                         (ph.MissingInputError, FileNotFoundError), (ph.OutputError, OSError),
                         (ph.MemoryLimitError, MemoryError), (ph.Timeout, TimeoutError),
                         (ph.Timeout, ph.Cancelled), (ph.NotBuiltIn, NotImplementedError),
                         (ph.InternalError, RuntimeError)):
        assert issubclass(error, other) and issubclass(error, ph.Error)


DISTANCES = np.linalg.norm(np.subtract(np.array(SQUARE)[:, None], SQUARE), axis=2)


def manhattan(a, b):
    return float(np.abs(np.subtract(a, b)).sum())


@pytest.mark.parametrize("function", [
    ph.rips, ph.merge_tree, lambda X, **o: ph.farthest_points(X, 2, **o),
    lambda X, **o: ph.distance_to_measure(X, 2, **o)])
@pytest.mark.parametrize("data, metric, found", [
    (DISTANCES, "precomputed", "metric='precomputed'"), (SQUARE, manhattan, "a function as metric"),
    (SQUARE, "l1", "metric='l1'")])
def test_minkowski_p_is_for_one_metric(function, data, metric, found):
    with pytest.raises(ph.UsageError, match=f"minkowski_p: does nothing for {found}"):
        function(data, metric=metric, minkowski_p=3)


@pytest.mark.parametrize("name, value, words", [
    ("diagonal", "births", "does nothing for a function as metric; metric='precomputed'"),
    ("symmetrise", "max", "does nothing for a function as metric"),
    ("diagonal", "bogus", "found 'bogus', expected 'zero'"), ("nan", "bogus", "found 'bogus'")])
def test_options_of_matrices_with_a_function(name, value, words):
    with pytest.raises(ph.UsageError, match=f"{name}: {words}"):
        ph.rips(SQUARE, metric=manhattan, **{name: value})


def test_nan_is_advised_where_it_is_an_option():
    def partly(a, b):
        return np.nan if list(a) == SQUARE[0] else manhattan(a, b)

    missing = DISTANCES.copy()
    missing[0, 1:] = missing[1:, 0] = np.nan
    for function, data, keywords in ((ph.rips, SQUARE, {"metric": partly}),
                                     (ph.rips, missing, {"metric": "precomputed"}),
                                     (ph.merge_tree, SQUARE, {"metric": partly}),
                                     (ph.collapse, missing, {})):
        with pytest.raises(ph.DataError, match="found nan, .*; nan='drop' never joins"):
            function(data, **keywords)
        function(data, **keywords, nan="drop")
    assert np.isinf(ph.rips(SQUARE, metric=partly, nan="drop").dgm(0)[:, 1]).sum() == 2
    for function in (ph.farthest_points, lambda X, **o: ph.distance_to_measure(X, 2, **o)):
        with pytest.raises(ph.DataError, match="found nan, expected 0 or more$"):
            function(SQUARE, metric=partly)


@pytest.mark.parametrize("name", [
    "max_dim", "representatives", "min_persistence", "field", "weights", "subsample",
    "approximation", "metric", "collapse"])
def test_collapse_has_no_options_of_bars(name):
    with pytest.raises(TypeError, match=f"unexpected keyword argument '{name}'"):
        ph.collapse(DISTANCES, **{name: 1})
