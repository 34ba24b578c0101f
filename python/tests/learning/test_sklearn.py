# SPDX-License-Identifier: MIT
"""Tests the estimators of libph.sklearn with scikit-learn's own checks, in pipelines, and on pandas
tables."""
import os
import pickle
import subprocess
import sys

import numpy as np
import pytest

import libph as ph
from samples import of_class, same

pytest.importorskip("sklearn", reason="scikit-learn is missing: nothing of libph.sklearn is tested")
import sklearn.exceptions  # noqa: E402
from sklearn.base import clone  # noqa: E402
from sklearn.ensemble import RandomForestClassifier  # noqa: E402
from sklearn.model_selection import GridSearchCV  # noqa: E402
from sklearn.pipeline import make_pipeline  # noqa: E402
from sklearn.utils import estimator_checks  # noqa: E402

from libph import _core  # noqa: E402
from libph.sklearn import (AlphaPersistence, Atol, BettiCurve,  # noqa: E402
                           CubicalPersistence, DiagramDistances, DiagramKernels,
                           DistanceToMeasure, Entropy, EulerCurve, FarthestPoints, Landscape,
                           Lengths, LifeEntropy, PersistenceClustering, PersistenceImage,
                           RipsPersistence, Silhouette, Statistics)

OF_LISTS = [RipsPersistence, CubicalPersistence]
if _core.alpha_support():
    OF_LISTS.append(AlphaPersistence)
OF_DIAGRAMS = [PersistenceImage, Landscape, BettiCurve, Entropy, Lengths, Statistics, Silhouette,
               LifeEntropy, Atol, DiagramDistances, DiagramKernels, EulerCurve]
OF_POINTS = [PersistenceClustering, DistanceToMeasure, FarthestPoints]
ALL = OF_LISTS + OF_DIAGRAMS + OF_POINTS


# ---- requirements of scikit-learn


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
    if hasattr(kind(), "__sklearn_tags__") and hasattr(sklearn.utils, "get_tags"):  # since 1.6
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
    if kind in (CubicalPersistence, EulerCurve):
        return [cloud @ cloud.T for cloud in clouds]
    if kind is AlphaPersistence:
        return [cloud[:, :3] for cloud in clouds]
    return clouds if kind is RipsPersistence else dgms


def out_of(estimator, X):
    return estimator.labels_ if isinstance(estimator, PersistenceClustering) else \
        estimator.transform(X)


@pytest.mark.parametrize("kind", ALL, ids=of_class)
def test_clone_and_pickle(kind, clouds, dgms):
    X = inputs_of(kind, clouds, dgms)
    how = {"centres": 3} if kind is Atol else {}
    fitted = kind(**how).fit(X)
    again = clone(fitted)
    assert again.get_params() == kind(**how).get_params()
    results = [out_of(one, X) for one in (fitted, pickle.loads(pickle.dumps(fitted)), again.fit(X))]
    for other in results[1:]:
        assert same(results[0], other) if kind in OF_LISTS else np.array_equal(results[0], other)


@pytest.mark.parametrize("kind", OF_DIAGRAMS + [DistanceToMeasure, FarthestPoints], ids=of_class)
def test_what_is_not_fitted(kind, clouds, dgms):
    with pytest.raises(sklearn.exceptions.NotFittedError):
        kind().transform(inputs_of(kind, clouds, dgms))


# ---- pipelines


def labelled_clouds(rng, count):
    """Clouds with labels: circles and discs."""
    labels = np.arange(count) % 2
    angles = rng.uniform(0, 2 * np.pi, (count, 25))
    radii = np.where(labels[:, None], 1, rng.random((count, 25))**0.5)
    points = np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=2)
    return points + 0.05 * rng.standard_normal(points.shape), labels


def test_pipeline_and_grid_search(rng):
    X, y = labelled_clouds(rng, 40)
    # The search and the first step of the pipeline both use threads.
    steps = make_pipeline(RipsPersistence(homology_dimensions=(1,), n_jobs=2),
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
    # A pandas table keeps its index.
    series = pandas.Series(clouds, index=list("abcd"))
    assert list(RipsPersistence().set_output(transform="pandas").transform(series).index) == list(
        "abcd")
