# SPDX-License-Identifier: MIT
"""The estimators of libph.sklearn: scikit-learn's own checks, and results beside plain loops."""
import os
import pickle
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import scipy.sparse
import scipy.spatial

import libph as ph

pytest.importorskip("sklearn", reason="scikit-learn is missing: nothing of libph.sklearn is tested")
import sklearn.exceptions  # noqa: E402
from sklearn.base import clone  # noqa: E402
from sklearn.ensemble import RandomForestClassifier  # noqa: E402
from sklearn.model_selection import GridSearchCV  # noqa: E402
from sklearn.pipeline import make_pipeline  # noqa: E402
from sklearn.utils import estimator_checks  # noqa: E402

from libph.sklearn import (BettiCurve, CubicalPersistence, DistanceToMeasure, Entropy,  # noqa: E402
                           FarthestPoints, Landscape, Lengths, PersistenceClustering,
                           PersistenceImage, RipsPersistence)

OF_LISTS = [RipsPersistence, CubicalPersistence]
OF_DIAGRAMS = [PersistenceImage, Landscape, BettiCurve, Entropy, Lengths]
OF_POINTS = [PersistenceClustering, DistanceToMeasure, FarthestPoints]
ALL = OF_LISTS + OF_DIAGRAMS + OF_POINTS


def of_class(kind):
    return kind.__name__


@pytest.fixture
def clouds(rng):
    return [rng.random((n, 2)) for n in (12, 20, 15, 18)]


@pytest.fixture
def dgms(clouds):
    return RipsPersistence(reduced=True).fit_transform(clouds)


def same(a, b):
    """Whether lists of lists of arrays are equal."""
    return len(a) == len(b) and all(
        len(x) == len(y) and all(map(np.array_equal, x, y)) for x, y in zip(a, b))


# ---- what scikit-learn asks for


@pytest.mark.filterwarnings("ignore")
@estimator_checks.parametrize_with_checks([
    PersistenceClustering(), PersistenceClustering(k=4, n_clusters=2), DistanceToMeasure(),
    FarthestPoints()])
def test_checks_of_scikit_learn(estimator, check):
    check(estimator)


@pytest.mark.parametrize("check", [
    estimator_checks.check_get_params_invariance, estimator_checks.check_set_params,
    estimator_checks.check_no_attributes_set_in_init,
    estimator_checks.check_parameters_default_constructible], ids=lambda c: c.__name__)
@pytest.mark.parametrize("kind", ALL, ids=of_class)
def test_checks_of_parameters(kind, check):
    check(kind.__name__, kind())


@pytest.mark.parametrize("kind", OF_LISTS + OF_DIAGRAMS, ids=of_class)
def test_tags_say_that_there_is_no_table(kind):
    if hasattr(kind(), "__sklearn_tags__") and hasattr(sklearn.utils, "get_tags"):  # 1.6
        assert not sklearn.utils.get_tags(kind()).input_tags.two_d_array
    else:
        assert kind()._get_tags()["X_types"] == ["3darray"]


def test_importing_libph_does_not_load_scikit_learn():
    code = ("import sys, libph; assert 'sklearn' not in sys.modules and 'scipy' not in sys.modules;"
            "from libph import sklearn; assert sklearn.RipsPersistence; libph.sklearn.Lengths")
    subprocess.run([sys.executable, "-c", code], check=True, env=dict(os.environ))


def inputs_of(kind, clouds, dgms):
    if kind in OF_POINTS:
        return np.vstack(clouds)
    if kind is CubicalPersistence:
        return [cloud @ cloud.T for cloud in clouds]
    return clouds if kind is RipsPersistence else dgms


def out_of(estimator, X):
    return estimator.labels_ if isinstance(estimator, PersistenceClustering) else \
        estimator.transform(X)


@pytest.mark.parametrize("kind", ALL, ids=of_class)
def test_clone_and_pickle(kind, clouds, dgms):
    X = inputs_of(kind, clouds, dgms)
    fitted = kind().fit(X)
    again = clone(fitted)
    assert again.get_params() == kind().get_params()
    results = [out_of(one, X) for one in (fitted, pickle.loads(pickle.dumps(fitted)), again.fit(X))]
    for other in results[1:]:
        assert same(results[0], other) if kind in OF_LISTS else np.array_equal(results[0], other)


@pytest.mark.parametrize("kind", OF_DIAGRAMS + [DistanceToMeasure, FarthestPoints], ids=of_class)
def test_what_is_not_fitted(kind, clouds, dgms):
    with pytest.raises(sklearn.exceptions.NotFittedError):
        kind().transform(inputs_of(kind, clouds, dgms))


# ---- lists of clouds and images


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
    {"weights": "dtm", "dtm_neighbors": 3}, {"field": 3}, {"collapse": False}, {"subsample": 8},
    {"approximation": 9.0}, {"min_persistence": 0.1}])
def test_options_of_rips(clouds, how):
    found = RipsPersistence(**how).fit_transform(clouds)
    assert same(found, [[ph.rips(c, **how).dgm(d) for d in (0, 1)] for c in clouds])
    # Each of them does something: merging, a field or collapses leave the bars as they are.
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


def test_an_image_with_holes(rng):
    image = rng.random((5, 5))
    image[2, 2] = np.nan
    assert same(CubicalPersistence(nan="drop").fit_transform([image]),
                [[ph.cubical(image, nan="drop").dgm(d) for d in (0, 1)]])
    with pytest.raises(ph.DataError, match="sample 1: image: row 2, column 2: found nan"):
        CubicalPersistence().fit_transform([np.ones((5, 5)), image])


def test_signals(rng):
    signals = rng.random((4, 30))  # of one axis
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
    # Of two components the eldest is left out.
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
    """H4 of it takes minutes, so a test that ends did stop it."""
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


# ---- vectors of diagrams


def expected_columns(kind, dgm, all_of_it):
    """With the parameters below, by the functions that test_vectors.py checks."""
    from libph import _vectors
    values = np.concatenate(all_of_it)
    low, high = values.min(), values.max()
    grid = np.linspace(low, high, 6)
    if kind is Landscape:
        return _vectors.landscape(dgm, 2, grid).ravel()
    if kind is BettiCurve:
        return _vectors.betti_curve(dgm, grid)
    if kind is Entropy:
        return [_vectors.entropy(dgm)]
    if kind is Lengths:
        return _vectors.longest(dgm, 3)
    births = values[:, 0].min(), values[:, 0].max()
    lengths = 0, (values[:, 1] - values[:, 0]).max()
    if births[0] == births[1]:
        births = births[0] - lengths[1] / 2, births[0] + lengths[1] / 2
    bandwidth = max(births[1] - births[0], lengths[1]) / 20
    return _vectors.image(dgm, bandwidth, (3, 2), births, lengths, 1).ravel()


SMALL = {PersistenceImage: PersistenceImage(resolution=(3, 2)),
         Landscape: Landscape(layers=2, resolution=6), BettiCurve: BettiCurve(resolution=6),
         Entropy: Entropy(), Lengths: Lengths(count=3)}


@pytest.mark.parametrize("kind", OF_DIAGRAMS, ids=of_class)
def test_ranges_are_those_of_the_samples_that_were_fitted(kind, dgms):
    fitted = clone(SMALL[kind]).fit(dgms[:3])
    found = fitted.transform(dgms)  # of one more than was fitted
    for i, row in enumerate(dgms):
        expected = np.concatenate([
            expected_columns(kind, dgm, [other[j] for other in dgms[:3]])
            for j, dgm in enumerate(row)])
        assert np.array_equal(found[i], expected)
    assert found.dtype == np.float64 and found.shape[1] == len(fitted.get_feature_names_out())


@pytest.mark.parametrize("kind", OF_DIAGRAMS, ids=of_class)
def test_layouts(kind, clouds, dgms):
    """Lists, arrays of lists, barcodes, padded arrays and tables are the same diagrams."""
    expected = clone(SMALL[kind]).fit_transform(dgms)
    objects = np.empty((len(dgms), 2), dtype=object)
    for i, row in enumerate(dgms):
        objects[i, 0], objects[i, 1] = row
    giotto = RipsPersistence(output="giotto", reduced=True).fit_transform(clouds)
    table = RipsPersistence(reduced=True).set_output(transform="pandas").fit_transform(clouds)
    for other in (list(objects), objects, giotto, table, [tuple(row) for row in dgms]):
        assert np.array_equal(clone(SMALL[kind]).fit_transform(other), expected)
    if kind is PersistenceImage:  # in which bars of length 0 would count
        flat = PersistenceImage(weight_power=0, resolution=2)
        assert np.array_equal(flat.fit_transform(giotto), flat.fit_transform(dgms))
    bars = RipsPersistence(output="barcode").fit_transform(clouds)
    dropped = clone(SMALL[kind]).set_params(infinity="drop").fit(bars)
    assert np.array_equal(dropped.transform(bars), expected)
    single = clone(SMALL[kind]).fit_transform([row[1] for row in dgms])
    assert np.array_equal(single, expected[:, expected.shape[1] // 2:])
    as_lists = clone(SMALL[kind]).fit_transform([row[1].tolist() for row in dgms])
    assert np.array_equal(as_lists, single)


def test_names(clouds, dgms):
    assert Lengths(count=2).fit(dgms).get_feature_names_out().tolist() == [
        "dgm0_length0", "dgm0_length1", "dgm1_length0", "dgm1_length1"]
    bars = RipsPersistence(output="barcode").fit_transform(clouds)
    assert Entropy(infinity="drop").fit(bars).get_feature_names_out().tolist() == [
        "H0_entropy", "H1_entropy"]
    giotto = RipsPersistence((1,), output="giotto").fit_transform(clouds)
    assert BettiCurve(resolution=2).fit(giotto).get_feature_names_out().tolist() == [
        "H1_betti0", "H1_betti1"]
    image = PersistenceImage(resolution=(2, 1)).fit(dgms)
    assert image.get_feature_names_out(["a", "b"]).tolist() == [
        "a_p0_b0", "a_p0_b1", "b_p0_b0", "b_p0_b1"]
    landscape = Landscape(layers=2, resolution=1).fit(dgms)
    assert landscape.get_feature_names_out()[:2].tolist() == ["dgm0_layer0_0", "dgm0_layer1_0"]
    with pytest.raises(ph.UsageError, match="input_features: found 1 names, expected 2"):
        landscape.get_feature_names_out(["a"])


def test_a_name_is_that_of_its_number():
    """The pixel of the highest persistence and the largest birth is the one named so."""
    image = PersistenceImage(resolution=(2, 3), bandwidth=1e-3, birth_range=(0, 2),
                             persistence_range=(0, 3))
    (row,) = image.fit_transform([[[1.5, 4.0]]])
    assert image.get_feature_names_out()[np.argmax(row)] == "dgm0_p2_b1"


def test_bars_that_never_die_are_never_dropped_in_silence(clouds):
    dgms = RipsPersistence().fit_transform(clouds)
    for kind in (PersistenceImage, Entropy, Lengths):
        with pytest.raises(ph.UsageError, match="sample 0, dgm0: row 11: found a bar that never"):
            kind().fit(dgms)
        fitted = kind(infinity=5.0).fit(dgms)
        assert not np.array_equal(fitted.transform(dgms),
                                  kind(infinity="drop").fit(dgms).transform(dgms))
    curve = BettiCurve(resolution=3, range=(0, 100)).fit_transform(dgms)
    assert curve[:, 2].tolist() == [1] * 4
    assert Lengths(count=1, infinity=5.0).fit_transform(dgms)[:, 0].tolist() == [5] * 4


def test_ranges_that_are_given(dgms):
    both = Landscape(range=(0, 2)).fit(dgms)
    assert both.ranges_ == [(0, 2)] * 2 and both.grids_[0][-1] == 2
    each = BettiCurve(range=[(0, 2), None]).fit(dgms)
    h1 = np.concatenate([row[1] for row in dgms])
    assert each.ranges_ == [(0, 2), (h1.min(), h1.max())]
    image = PersistenceImage(birth_range=(0, 1), persistence_range=[None, (0, 3)]).fit(dgms)
    assert image.birth_ranges_ == [(0, 1)] * 2 and image.persistence_ranges_[1] == (0, 3)
    assert image.bandwidths_[1] == pytest.approx(3 / 20)
    with pytest.raises(ph.UsageError, match="range: found 3 ranges, expected 2"):
        Landscape(range=[None] * 3).fit(dgms)
    with pytest.raises(ph.UsageError, match=r"range: found \(1, 0\)"):
        Landscape(range=(1, 0)).fit(dgms)


@pytest.mark.parametrize("X, words", [
    (5, "found int"), ("ab", "found str"), (np.ones((3, 2)), r"found an array of shape \(3, 2\)"),
    ([], "found no samples"), ([[]], "found samples without diagrams"),
    ([[np.ones((1, 2))], [np.ones((1, 2))] * 2], "sample 1: found 2 diagrams, expected 1"),
    ([ph.rips([[0], [1]]), np.ones((1, 2))], "found barcodes and arrays"),
    ([np.array([[1.0, 0.0]])], "sample 0: row 0: found birth 1.0 and death 0.0"),
    (np.array([[[0, 1, 0.5]]]), "found dimensions"), (ph.rips([[0], [1]]), "found Barcode")])
def test_what_is_no_list_of_diagrams(X, words):
    with pytest.raises(ph.Error, match=words):
        Entropy(infinity="drop").fit(X)


def test_other_diagrams_than_those_fitted(dgms):
    with pytest.raises(ph.UsageError, match="found 1 diagrams for each sample, expected 2"):
        Entropy().fit(dgms).transform([row[0] for row in dgms])


# ---- pipelines


def labelled_clouds(rng, count):
    """Circles and blobs."""
    labels = np.arange(count) % 2
    angles = rng.uniform(0, 2 * np.pi, (count, 25))
    radii = np.where(labels[:, None], 1, rng.random((count, 25))**0.5)
    points = np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=2)
    return points + 0.05 * rng.standard_normal(points.shape), labels


def test_pipeline_and_grid_search(rng):
    X, y = labelled_clouds(rng, 40)
    steps = make_pipeline(RipsPersistence(homology_dimensions=(1,), n_jobs=2),  # threads in threads
                          PersistenceImage(resolution=5, infinity=2.0),
                          RandomForestClassifier(10, random_state=0))
    search = GridSearchCV(steps, {"persistenceimage__bandwidth": [0.05, 0.2],
                                  "ripspersistence__threshold": [None, 1.5]}, cv=3)
    search.fit(X[:30], y[:30])
    assert search.score(X[30:], y[30:]) >= 0.9
    assert search.best_params_.keys() == {"persistenceimage__bandwidth",
                                          "ripspersistence__threshold"}


def test_names_go_through_a_pipeline(clouds):
    steps = make_pipeline(RipsPersistence(reduced=True), Lengths(count=1)).fit(clouds)
    assert steps.get_feature_names_out().tolist() == ["H0_length0", "H1_length0"]


def test_pandas(clouds, dgms):
    pandas = pytest.importorskip("pandas", reason="pandas is missing")
    steps = make_pipeline(RipsPersistence(reduced=True), Lengths(count=2))
    table = steps.set_output(transform="pandas").fit_transform(clouds)
    assert isinstance(table, pandas.DataFrame)
    assert list(table.columns) == ["H0_length0", "H0_length1", "H1_length0", "H1_length1"]
    assert np.array_equal(table.to_numpy(), Lengths(count=2).fit_transform(dgms))
    with sklearn.config_context(transform_output="pandas"):
        bars = RipsPersistence(output="barcode").fit_transform(clouds)
        assert bars.shape == (4, 1) and bars["barcode"][2] == ph.rips(clouds[2])
        names = Entropy(infinity="drop").fit_transform(bars).columns
        assert list(names) == ["H0_entropy", "H1_entropy"]
        one = RipsPersistence(homology_dimensions=1).fit_transform(clouds)
        assert list(one.columns) == ["H1"] and np.array_equal(one["H1"][0], dgms[0][1])
        points = pandas.DataFrame(clouds[0], index=range(5, 17))
        points.columns = ["x", "y"]
        assert list(DistanceToMeasure(3).fit_transform(points).columns) == ["distancetomeasure0"]
        assert list(FarthestPoints(2).fit_transform(points).index) == list(range(5, 17))
    # A table keeps its index.
    series = pandas.Series(clouds, index=list("abcd"))
    assert list(RipsPersistence().set_output(transform="pandas").transform(series).index) == list(
        "abcd")
