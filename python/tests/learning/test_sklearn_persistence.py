# SPDX-License-Identifier: MIT
"""Tests the estimators that turn lists of clouds or images into lists of diagrams."""
import os
import signal
import threading
import time

import numpy as np
import pytest
import scipy.sparse
import scipy.spatial

import libph as ph
from samples import of_class, same

pytest.importorskip("sklearn", reason="scikit-learn is missing: nothing of libph.sklearn is tested")
from libph import _core  # noqa: E402
from libph.sklearn import (AlphaPersistence, CubicalPersistence, DiagramKernels,  # noqa: E402
                           Entropy, PersistenceImage, RipsPersistence)

OF_LISTS = [RipsPersistence, AlphaPersistence, CubicalPersistence]


def test_rips(clouds):
    found = RipsPersistence().fit_transform(clouds)
    assert same(found, [[ph.rips(c).dgm(0), ph.rips(c).dgm(1)] for c in clouds])
    one = RipsPersistence(homology_dimensions=1).fit_transform(clouds)
    assert same([one], [[row[1] for row in found]])
    assert same(RipsPersistence(homology_dimensions=[1, 0]).fit_transform(clouds),
                [row[::-1] for row in found])
    bars = RipsPersistence(output="barcode").fit_transform(clouds)
    assert bars == [ph.rips(c) for c in clouds] and bars[0].death_cells(1).shape[1] == 3


@pytest.mark.parametrize("how", [
    {"threshold": 0.4}, {"metric": "manhattan"}, {"metric": "minkowski", "minkowski_p": 3.0},
    {"weights": "dtm", "dtm_neighbors": 3}, {"weights": "core", "core_neighbors": 2}, {"field": 3}, {"collapse": False}, {"subsample": 8},
    {"approximation": 9.0}, {"min_persistence": 0.1}])
def test_options_of_rips(clouds, how):
    found = RipsPersistence(**how).fit_transform(clouds)
    assert same(found, [[ph.rips(c, **how).dgm(d) for d in (0, 1)] for c in clouds])
    # Each option changes the bars of these clouds, except `field` and `collapse`.
    if not {"field", "collapse"} & set(how):
        assert not same(found, RipsPersistence().fit_transform(clouds))


def test_distances(clouds):
    found = RipsPersistence(metric="precomputed")
    squares = [scipy.spatial.distance.squareform(scipy.spatial.distance.pdist(c)) for c in clouds]
    expected = RipsPersistence().fit_transform(clouds)
    for samples in (squares, [scipy.sparse.coo_matrix(s) for s in squares],
                    [scipy.spatial.distance.squareform(s) for s in squares]):
        for row, other in zip(found.fit_transform(samples), expected):
            assert all(np.allclose(a, b, rtol=1e-12) for a, b in zip(row, other))


@pytest.mark.parametrize("how", [
    {}, {"construction": "cells"}, {"superlevel": True}, {"periodic": True}, {"threshold": 0.7},
    {"field": 3}, {"min_persistence": 0.2}])
def test_cubical(rng, how):
    images = rng.random((3, 6, 7))
    found = CubicalPersistence(**how).fit_transform(images)
    assert same(found, [[ph.cubical(i, **how).dgm(d) for d in (0, 1)] for i in images])


@pytest.mark.skipif(not _core.alpha_support(), reason="CGAL is not built in")
@pytest.mark.parametrize("how", [
    {}, {"values": "delaunay-rips", "threshold": 0.2}, {"squared": True, "field": 3}])
def test_alpha(rng, how):
    clouds = [rng.random((n, 2)) for n in (20, 31)]
    found = AlphaPersistence(**how, n_jobs=2).fit_transform(clouds)
    assert same(found, [[ph.alpha(c, **how).dgm(d) for d in (0, 1)] for c in clouds])
    with pytest.raises(ph.UsageError, match="sample 0: X: found points of R.4"):
        AlphaPersistence().fit_transform([rng.random((5, 4))])


def test_an_image_with_holes(rng):
    image = rng.random((5, 5))
    image[2, 2] = np.nan
    assert same(CubicalPersistence(nan="drop").fit_transform([image]),
                [[ph.cubical(image, nan="drop").dgm(d) for d in (0, 1)]])
    with pytest.raises(ph.DataError, match="sample 1: image: row 2, column 2: found nan"):
        CubicalPersistence().fit_transform([np.ones((5, 5)), image])


def test_signals(rng):
    signals = rng.random((4, 30))  # signals with one axis
    found = CubicalPersistence(homology_dimensions=0).fit_transform(signals)
    assert same([found], [[ph.cubical(s).dgm(0) for s in signals]])


def test_rows_birth_death_dimension(clouds):
    rows = RipsPersistence(output="giotto", reduced=True).fit_transform(clouds[:2] + [[[0, 0]]])
    longest = [max(len(ph.rips(c).dgm(d)) for c in clouds[:2]) for d in (0, 1)]
    assert rows.shape == (3, longest[0] - 1 + longest[1], 3) and rows.dtype == np.float64
    assert (np.diff(rows[:, :, 2]) >= 0).all() and set(rows[:, :, 2].flat) == {0, 1}
    least = min(ph.rips(c).dgm(1)[:, 0].min() for c in clouds[:2])
    assert len(ph.rips(clouds[1]).dgm(1)) > 1
    for sample, cloud in zip(rows, [*clouds[:2], np.zeros((1, 2))]):
        for dim in (0, 1):
            part = sample[sample[:, 2] == dim, :2]
            real = part[part[:, 0] != part[:, 1]]
            fill = part[part[:, 0] == part[:, 1]]
            dgm = ph.rips(cloud).dgm(dim)
            assert np.array_equal(real, dgm[np.isfinite(dgm[:, 1])])
            assert (fill == (least if dim else 0)).all()
    assert RipsPersistence(output="giotto", reduced=True).fit_transform([[[0, 0]]]).tolist() == [
        [[0, 0, 0], [0, 0, 1]]]


def test_bars_that_never_die(clouds):
    plain = RipsPersistence().fit_transform(clouds)
    assert all(np.isinf(row[0][-1, 1]) for row in plain)
    dropped = RipsPersistence(infinity="drop").fit_transform(clouds)
    assert same(dropped, RipsPersistence(reduced=True).fit_transform(clouds))
    assert same(dropped, [[row[0][:-1], row[1]] for row in plain])
    assert RipsPersistence(infinity=9.0).fit_transform(clouds)[0][0][-1].tolist() == [0, 9]
    with pytest.raises(ph.UsageError, match="H0: row 11: found a bar that never dies"):
        RipsPersistence(infinity="error").fit_transform(clouds)
    # Vectorisers name the option that leaves out the component.
    names = "reduced=True of the estimator that found the bars leaves out the component"
    for vectoriser in (Entropy(), PersistenceImage(), DiagramKernels()):
        with pytest.raises(ph.UsageError, match=f"sample 0, dgm0: row 11: .*never dies; {names}"):
            vectoriser.fit_transform(plain)
        assert len(vectoriser.fit_transform(RipsPersistence(reduced=True).fit_transform(clouds)))
    with pytest.raises(ph.UsageError, match=f"fitted sample 0, dgm0: row 11: .*; {names}"):
        DiagramKernels().fit(plain).transform(dropped)
    # With a threshold, several components never die.
    scattered = RipsPersistence(threshold=1e-6).fit_transform(clouds)
    for vectoriser in (Entropy(), DiagramKernels()):
        with pytest.raises(ph.UsageError, match="never dies; (RipsPersistence.)?infinity='drop'"):
            vectoriser.fit_transform(scattered)
    # The component that is born first is left out.
    image = [[0.0, np.inf, 1.0]]
    assert CubicalPersistence(homology_dimensions=0, reduced=True).fit_transform(image)[0].tolist() \
        == [[1, np.inf]]


@pytest.mark.parametrize("how", [
    {"homology_dimensions": ()}, {"homology_dimensions": (0, 0)}, {"homology_dimensions": -1},
    {"homology_dimensions": "0"}, {"homology_dimensions": 1.5}, {"output": "array"},
    {"infinity": "keep"}, {"reduced": 1}, {"output": "barcode", "reduced": True},
    {"output": "barcode", "infinity": 3.0}])
@pytest.mark.parametrize("kind", OF_LISTS, ids=of_class)
def test_parameters_that_make_no_sense(kind, how):
    with pytest.raises(ph.UsageError, match=next(iter(how))):
        kind(**how).fit([np.ones((3, 3))])


@pytest.mark.parametrize("kind, X, words", [
    (RipsPersistence, np.ones((4, 2)), r"found an array of shape \(4, 2\), expected a list of clouds"),
    (RipsPersistence, scipy.sparse.eye(3), "expected a list of clouds"),
    (RipsPersistence, 3, "found int"), (RipsPersistence, "ab", "found str"),
    (CubicalPersistence, np.ones(5), r"found an array of shape \(5,\), expected a list of images")])
def test_what_is_no_list(kind, X, words):
    with pytest.raises(ph.UsageError, match=words):
        kind().fit_transform(X)


def test_errors_name_the_sample(clouds):
    with pytest.raises(ph.DataError, match="sample 2: X: row 1: found 1 numbers, expected 2"):
        RipsPersistence().fit_transform([*clouds[:2], [[0, 1], [2]]])
    with pytest.raises(ph.UsageError, match="sample 0: homology_dimensions: found 1, expected less "
                                            "than the 1 axes"):
        CubicalPersistence().fit_transform(np.ones((3, 4)))
    with pytest.raises(ph.UsageError, match="found 1 more|sample 0: metric"):
        RipsPersistence(metric="foo").fit_transform(clouds)


@pytest.mark.parametrize("n_jobs", [2, 5, -1])
def test_jobs_do_not_change_what_comes_out(clouds, n_jobs):
    assert same(RipsPersistence(n_jobs=n_jobs).fit_transform(clouds),
                RipsPersistence().fit_transform(clouds))


def test_limits_reach_the_threads(clouds):
    big = [np.random.default_rng(0).random((4000, 3))] * 2
    with ph.limits(memory=1000), pytest.raises(ph.MemoryLimitError, match="sample"):
        RipsPersistence(n_jobs=2).fit_transform(big)


@pytest.fixture
def slow():
    """Computing H4 would take minutes: if the test ends, the computation was stopped."""
    return np.random.default_rng(0).random((1000, 8))


def threads_that_are_left(before):
    limit = time.monotonic() + 30
    while threading.active_count() > before and time.monotonic() < limit:
        time.sleep(0.05)
    return threading.active_count() - before


def test_an_error_stops_the_other_samples(slow):
    before, begin = threading.active_count(), time.monotonic()
    with pytest.raises(ph.DataError, match="sample 1: point 0, coordinate 0: found nan"):
        RipsPersistence(homology_dimensions=4, n_jobs=2).fit_transform([slow, [[np.nan, 0]]])
    assert time.monotonic() - begin < 30 and threads_that_are_left(before) <= 0
    with ph.limits(timeout=0.5), pytest.raises(ph.Timeout):
        RipsPersistence(homology_dimensions=4, n_jobs=2).fit_transform([slow, slow])


def test_ctrl_c_stops_all_samples(slow):
    before = threading.active_count()
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        RipsPersistence(homology_dimensions=4, n_jobs=2).fit_transform([slow, slow])
    assert threads_that_are_left(before) <= 0


def test_no_samples():
    assert RipsPersistence().fit_transform([]) == []
    assert RipsPersistence(output="giotto").fit_transform([]).shape == (0, 2, 3)


@pytest.mark.parametrize("dims", [{1, 0}, np.array([0, 1]), range(2)], ids=str)
def test_collections_of_dimensions(rng, dims):
    clouds, images = rng.random((2, 9, 2)), rng.random((2, 5, 5))
    for kind, samples in ((RipsPersistence, clouds), (CubicalPersistence, images)):
        assert same(kind(dims).fit_transform(samples), kind((0, 1)).fit_transform(samples))
    single = RipsPersistence({1}).fit_transform(clouds)
    assert same(single, RipsPersistence((1,)).fit_transform(clouds))


def test_axes_and_images_of_all_kinds(rng):
    image = rng.random((5, 5))
    expected = CubicalPersistence((0, 1, 2), periodic=True).fit_transform([image])
    for axes in ("all", np.array([0, 1]), [True, True], np.array([True, True]), [np.True_] * 2,
                 (0, -1)):
        assert same(CubicalPersistence((0, 1, 2), periodic=axes).fit_transform([image]), expected)
    for axes in ((), False, [False, False]):
        with pytest.raises(ph.UsageError, match="found 2, expected less than the 2 axes"):
            CubicalPersistence(2, periodic=axes).fit([image])
    of_points = ph.point_image(rng.random((9, 2)), 0.2)
    found, = CubicalPersistence().fit_transform([of_points])
    assert same(found, [ph.cubical(of_points).dgm(dim) for dim in (0, 1)])
    with pytest.raises(ph.DataError, match="sample 0: row 1: found 1 numbers"):
        CubicalPersistence().fit([[[1, 2], [3]]])
