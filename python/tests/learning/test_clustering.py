# SPDX-License-Identifier: MIT
"""Tests the estimators that take a single cloud, such as clustering, against plain loops and
against GUDHI."""
import math
import warnings

import numpy as np
import pytest
import scipy.cluster.hierarchy
import scipy.spatial

import libph as ph

pytest.importorskip("sklearn", reason="scikit-learn is missing: clusters are not tested")
import sklearn.exceptions  # noqa: E402
import sklearn.neighbors  # noqa: E402
from sklearn.cluster import KMeans  # noqa: E402
from sklearn.metrics import adjusted_rand_score  # noqa: E402

from libph.sklearn import DistanceToMeasure, FarthestPoints, PersistenceClustering  # noqa: E402


# ---- distances


@pytest.mark.parametrize("metric", ["euclidean", "manhattan", "chebyshev", "cosine"])
def test_distance_to_measure(rng, metric):
    X = rng.random((60, 3))
    found = DistanceToMeasure(5, metric=metric).fit_transform(X)
    assert np.allclose(found[:, 0], ph.distance_to_measure(X, 5, metric=metric), rtol=1e-9)
    name = "cityblock" if metric == "manhattan" else metric
    new = rng.random((7, 3))
    near = np.sort(scipy.spatial.distance.cdist(new, X, name), axis=1)[:, :5]
    assert np.allclose(DistanceToMeasure(5, metric=metric).fit(X).transform(new)[:, 0],
                       np.sqrt((near**2).mean(axis=1)), rtol=1e-9)


@pytest.mark.parametrize("metric", ["euclidean", "l2", "manhattan", "l1", "chebyshev"])
@pytest.mark.parametrize("offset, scale", [(1e7, 1), (0, 1e200), (0, 1e-200), (1e5, 1e-3)])
@pytest.mark.parametrize("k", [1, 5, 40])
@pytest.mark.parametrize("columns", [4, 20])
def test_offsets_and_scales_cost_no_digits(rng, metric, offset, scale, k, columns):
    X = rng.normal(size=(60, columns)) * scale + offset
    found = DistanceToMeasure(k, metric=metric).fit_transform(X)
    assert np.allclose(found[:, 0], ph.distance_to_measure(X, k, metric=metric), rtol=1e-12, atol=0)
    found = FarthestPoints(5, metric=metric).fit(X)
    assert np.array_equal(found.transform(X)[found.indices_, range(5)], np.zeros(5))
    new = rng.normal(size=columns) * scale + offset
    expected = [ph.rips([new, point], metric=metric).deaths[0] for point in found.points_]
    assert np.allclose(found.transform([new])[0], expected, rtol=1e-12, atol=0)


def test_rows_far_from_the_points_that_were_fitted():
    estimator = DistanceToMeasure(2).fit([[1e-200], [3e-200], [4e-200]])
    for row, expected in ((1e200, 1e200), (-3, 3), (0, 5**0.5 * 1e-200)):
        assert estimator.transform([[row]]) == pytest.approx(expected, rel=1e-12, abs=0)


def test_cosines_of_small_angles(rng):
    angles = 1e-9 * np.array([0, 1, 3, 7])
    X = np.column_stack([np.cos(angles), np.sin(angles)]) * [[1], [1e200], [1e-200], [5]]
    expected = ph.distance_to_measure(X, 2, metric="cosine")
    assert expected[0] == pytest.approx(1e-18 / 8**0.5)
    found = DistanceToMeasure(2, metric="cosine").fit_transform(X)
    assert np.allclose(found[:, 0], expected, rtol=1e-6, atol=0)
    far = FarthestPoints(4, metric="cosine").fit(X).transform(X[:1])[0]
    assert np.allclose(np.sort(far), np.square(angles) / 2, rtol=1e-6, atol=0)
    for estimator in (DistanceToMeasure(1, metric="cosine"), FarthestPoints(1, metric="cosine"),
                      PersistenceClustering(1, metric="cosine")):
        with pytest.raises(ph.DataError, match="(row|point) 1: found the zero vector"):
            estimator.fit([[1, 0], [0, 0]])


@pytest.mark.parametrize("scale", [1, 1e200, 1e-200])
def test_clusters_at_any_scale(rng, scale):
    X = np.vstack([rng.standard_normal((80, 2)), rng.standard_normal((80, 2)) + 9])
    found = PersistenceClustering(10).fit(X)
    scaled = PersistenceClustering(10).fit(X * scale)
    assert found.n_clusters_ > 1 and np.array_equal(found.labels_, scaled.labels_)
    distances = scipy.spatial.distance.cdist(X, X) * scale
    again = PersistenceClustering(10, metric="precomputed").fit(distances)
    assert adjusted_rand_score(again.labels_, found.labels_) == 1


def test_more_neighbours_than_points():
    for estimator in (DistanceToMeasure(4), PersistenceClustering(4)):
        with pytest.raises(ph.UsageError, match="k: found 4, expected at most .* n_samples = 3"):
            estimator.fit([[0], [1], [2]])


def test_farthest_points(rng):
    X = rng.random((40, 2))
    chosen = [0]
    for _ in range(5):
        gaps = [min(math.dist(x, X[j]) for j in chosen) for x in X]
        chosen.append(int(np.argmax(gaps)))
    found = FarthestPoints(6).fit(X)
    assert found.indices_.tolist() == chosen and np.array_equal(found.points_, X[chosen])
    covering = max(min(math.dist(x, X[j]) for j in chosen) for x in X)
    assert found.covering_radius_ == pytest.approx(covering) and len(found.radii_) == 6
    assert np.array_equal(found.transform(X), scipy.spatial.distance.cdist(X, X[chosen]))
    assert FarthestPoints(99).fit(X).transform(X).shape == (40, 40)


# ---- clusters


def tomato(function, neighbours, least):
    """The published algorithm ToMATo, which processes one point at a time. The label of a point is
    the peak of its cluster."""
    n = len(function)
    order = sorted(range(n), key=lambda i: (function[i], i))
    rank = {point: r for r, point in enumerate(order)}
    joined = [set() for _ in range(n)]
    for i, row in enumerate(neighbours):
        for j in row:
            if i != j:
                joined[i].add(j)
                joined[j].add(i)
    root = list(range(n))

    def find(i):
        while root[i] != i:
            i = root[i]
        return i

    for i in order:
        denser = [j for j in joined[i] if rank[j] < rank[i]]
        if not denser:
            continue
        root[i] = find(min(denser, key=rank.get))
        for j in sorted(denser, key=rank.get):
            mine, its = find(i), find(j)
            if mine != its:
                younger, elder = sorted((mine, its), key=rank.get, reverse=True)
                if function[i] - function[younger] <= least:
                    root[younger] = elder
    return np.array([find(i) for i in range(n)])


def neighbours_of(X, k):
    distances = scipy.spatial.distance.cdist(X, X)
    return np.argsort(distances, axis=1, kind="stable")[:, :k], np.sort(distances, axis=1)[:, :k]


@pytest.mark.parametrize("least", [0.0, 0.05, 0.3, 5.0])
@pytest.mark.parametrize("k", [3, 8])
def test_clusters_are_those_of_the_algorithm(rng, k, least):
    X = np.vstack([rng.standard_normal((60, 2)), rng.standard_normal((60, 2)) * 0.4 + [4, 0]])
    found = PersistenceClustering(k, min_persistence=least).fit(X)
    neighbours, distances = neighbours_of(X, k)
    function = np.log(np.sqrt((distances**2).mean(axis=1)))
    assert np.allclose(found.function_, function, rtol=1e-9)
    expected = tomato(found.function_, neighbours, least)
    assert adjusted_rand_score(expected, found.labels_) == 1
    assert found.n_clusters_ == len(set(expected)) == len(set(found.labels_))
    assert np.array_equal(found.peaks_[found.labels_], expected)
    assert (np.diff(found.function_[found.peaks_]) >= 0).all()
    assert found.n_clusters_ == len(found.barcode_.filter(min_persistence=least))


def test_ties(rng):
    """For points on a grid, large regions have the same density."""
    X = np.argwhere(rng.random((12, 12)) < 0.8).astype(float)
    density = rng.integers(1, 4, len(X)).astype(float)
    found = PersistenceClustering(5, min_persistence=0.5, density=lambda _: density).fit(X)
    # The estimator uses the same search. Both therefore make the same choice among equal distances.
    search = sklearn.neighbors.NearestNeighbors(n_neighbors=5).fit(X)
    expected = tomato(-np.log(density), search.kneighbors(X)[1], 0.5)
    assert np.array_equal(found.peaks_[found.labels_], expected)


def test_the_barcode_is_that_of_the_function_on_the_graph(rng):
    X = rng.random((150, 2))
    found = PersistenceClustering(6).fit(X)
    neighbours, _ = neighbours_of(X, 6)
    edges = np.column_stack([np.repeat(np.arange(150), 6), neighbours.ravel()])
    edges = edges[edges[:, 0] != edges[:, 1]]
    whole = ph.lower_star(found.function_, edges, max_dim=0)
    assert found.barcode_ == whole
    peaks = found.barcode_.birth_cells(0)[:, 0]
    assert np.array_equal(found.function_[peaks], found.barcode_.births)


def test_the_number_of_clusters(rng):
    X = np.vstack([rng.standard_normal((80, 2)) + at for at in ([0, 0], [3, 0], [0, 3])])
    base = PersistenceClustering(8).fit(X)
    lengths = np.sort(np.diff(base.barcode_.dgm(0))[:, 0])[::-1]
    assert np.isinf(lengths[0]) and np.isfinite(lengths[1])
    for wanted in (1, 2, 5, len(lengths)):
        found = PersistenceClustering(8, n_clusters=wanted).fit(X)
        assert found.n_clusters_ == wanted == found.labels_.max() + 1
        between = lengths[wanted] if wanted < len(lengths) else 0.0
        same_as = PersistenceClustering(8, min_persistence=between).fit(X)
        assert np.array_equal(found.labels_, same_as.labels_)
    with pytest.warns(sklearn.exceptions.ConvergenceWarning, match="found 999, expected at most"):
        assert PersistenceClustering(8, n_clusters=999).fit(X).n_clusters_ == len(lengths)


@pytest.mark.parametrize("lengths, expected", [
    ([], 1), ([0.3], 2), ([2.0, 0.5, 0.4], 2), ([2.0, 1.9, 0.5, 0.4], 3),
    ([0.5, 0.45, 0.4, 0.2, 0.19], 4), ([0.5, 0.4, 0.35, 0.3, 0.28, 0.25, 0.22], 8),
    ([0.5, 0.38, 0.36, 0.30, 0.25, 0.2, 0.16, 0.11, 0.06], 1)])
def test_the_number_that_is_guessed(lengths, expected):
    """There is a row of hills. The first hill is the highest; `lengths` has the heights of the
    other hills above their passes."""
    values = [0.0, 10.0]
    for length in lengths:
        values += [5.0 - length, 5.0]
    values = np.array(values + [0.0])
    line = np.abs(np.subtract.outer(np.arange(len(values)), np.arange(len(values)))).astype(float)
    found = PersistenceClustering(3, density=lambda _: np.exp(values), metric="precomputed").fit(line)
    assert np.allclose(np.sort(np.diff(found.barcode_.dgm(0))[:, 0])[::-1][1:], lengths)
    assert found.n_clusters_ == expected


def test_moons_that_k_means_cuts():
    from sklearn.datasets import make_moons
    X, y = make_moons(1000, noise=0.08, random_state=0)
    assert adjusted_rand_score(y, PersistenceClustering(k=15).fit_predict(X)) > 0.97
    assert adjusted_rand_score(y, KMeans(2, n_init=3, random_state=0).fit_predict(X)) < 0.6


def test_a_graph_that_falls_apart(rng):
    at = np.array([[0, 0], [10, 0], [100, 0], [111, 0]])
    X = np.vstack([rng.standard_normal((30, 2)) * 0.3 + a for a in at])
    truth = np.repeat(np.arange(4), 30)
    found = PersistenceClustering(10).fit(X)
    assert np.isinf(found.barcode_.deaths).sum() == 4 and found.n_clusters_ >= 4
    assert adjusted_rand_score(truth, PersistenceClustering(10, n_clusters=4).fit_predict(X)) == 1
    with pytest.warns(sklearn.exceptions.ConvergenceWarning, match="expected at least 4, the number of parts"):
        two = PersistenceClustering(10, n_clusters=2).fit_predict(X)
    assert adjusted_rand_score(truth // 2, two) == 1
    distances = scipy.spatial.distance.cdist(X, X)
    with pytest.warns(sklearn.exceptions.ConvergenceWarning):
        again = PersistenceClustering(10, n_clusters=2, metric="precomputed").fit_predict(distances)
    assert np.array_equal(two, again)


def test_parts_are_joined_by_their_densest_points(rng):
    at = np.array([[0, 0], [20, 5], [45, 0], [80, 9], [3, 60], [30, 70], [80, 64]])
    X = np.vstack([rng.uniform(-4, 4, (60, 2)) + a for a in at])
    part = np.repeat(np.arange(7), 60)
    function = PersistenceClustering(6).fit(X).function_
    densest = [np.flatnonzero(part == p)[np.argmin(function[part == p])] for p in range(7)]
    tree = scipy.cluster.hierarchy.linkage(X[densest], "single")
    for wanted in range(1, 7):
        with pytest.warns(sklearn.exceptions.ConvergenceWarning, match="expected at least 7, the number of parts"):
            found = PersistenceClustering(6, n_clusters=wanted).fit(X)
        assert len(found.barcode_) > 14  # components have several hills
        last = tree[6 - wanted, 2]  # the longest link that is needed
        expected = scipy.cluster.hierarchy.fcluster(tree, last, "distance")[part]
        assert adjusted_rand_score(expected, found.labels_) == 1 and found.n_clusters_ == wanted


def test_distances_of_points(rng):
    X = rng.random((90, 2))
    distances = scipy.spatial.distance.cdist(X, X)
    found = PersistenceClustering(6, metric="precomputed", n_clusters=4).fit(distances)
    assert np.array_equal(found.labels_, PersistenceClustering(6, n_clusters=4).fit(X).labels_)
    with pytest.raises(ph.UsageError, match="expected a square one"):
        PersistenceClustering(6, metric="precomputed").fit(distances[:, :9])


def test_points_that_lie_on_each_other():
    X = np.repeat([[0.0], [1.0], [1.2]], 5, axis=0)
    found = PersistenceClustering(7).fit(X)
    to_measure = ph.distance_to_measure(X, 7)
    assert np.allclose(found.function_, np.log(to_measure)) and found.n_clusters_ == 1
    few = PersistenceClustering(4, min_persistence=0.1).fit(np.append(X, [[1.6], [1.7]], axis=0))
    least = ph.distance_to_measure(np.append(X, [[1.6], [1.7]], axis=0), 4)[-2:].min()
    assert np.allclose(few.function_[:15], np.log(least)) and np.isfinite(few.function_).all()
    all_equal = PersistenceClustering(3, min_persistence=0.0).fit(np.zeros((9, 2)))
    assert (all_equal.function_ == 0).all()


@pytest.mark.parametrize("how, words", [
    ({"k": 0}, "k: found 0"), ({"n_clusters": 0}, "n_clusters: found 0"),
    ({"min_persistence": -1}, "min_persistence: found -1"),
    ({"n_clusters": 2, "min_persistence": 1}, "n_clusters: cannot be combined with min_persistence"),
    ({"density": "kde"}, "density: found 'kde'"), ({"metric": "hamming"}, "metric: found 'hamming'"),
    ({"density": lambda X: np.zeros(len(X))}, "density: row 0: found 0.0"),
    ({"density": lambda X: np.ones(3)}, r"density: found an array of shape \(3,\), expected 20")])
def test_parameters_of_clusters(rng, how, words):
    with pytest.raises(ph.UsageError, match=words):
        PersistenceClustering(**how).fit(rng.random((20, 2)))


def test_clusters_beside_gudhi(rng):
    tomato = pytest.importorskip("gudhi.clustering.tomato", reason="GUDHI is missing")
    X = np.vstack([rng.standard_normal((400, 2)), rng.standard_normal((400, 2)) + [3, 1]])
    found = PersistenceClustering(12, n_clusters=2).fit(X)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        theirs = tomato.Tomato(k=12, n_clusters=2, density_type="logDTM", q=2, dim=1,
                               symmetrize_graph=True).fit(X)
    assert adjusted_rand_score(theirs.labels_, found.labels_) == 1
    ours = found.barcode_.dgm(0)
    ours = np.sort((ours[:, 1] - ours[:, 0])[np.isfinite(ours[:, 1])])
    lengths = theirs.diagram_[:, 0] - theirs.diagram_[:, 1]
    assert np.allclose(np.sort(lengths[lengths > 0]), ours, atol=1e-12)
