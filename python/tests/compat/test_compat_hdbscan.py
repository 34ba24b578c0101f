# SPDX-License-Identifier: MIT
"""Tests what the drop-in for hdbscan promises. hdbscan itself is not needed."""
import pickle

import numpy as np
import pytest
import scipy.sparse
import scipy.spatial.distance as spatial

import libph as ph
from libph.compat import hdbscan

pytest.importorskip("sklearn", reason="scikit-learn is missing, which estimators need")
from sklearn.base import clone  # noqa: E402
from sklearn.decomposition import PCA  # noqa: E402
from sklearn.model_selection import GridSearchCV  # noqa: E402
from sklearn.pipeline import make_pipeline  # noqa: E402

from libph.sklearn import HDBSCAN  # noqa: E402


def cloud(rng, axes=2):
    return np.vstack([rng.normal(0, 0.2, (30, axes)), rng.normal(2, 0.4, (25, axes)),
                      rng.normal(-3, 0.1, (20, axes)), rng.uniform(-5, 5, (15, axes))])


def partition(labels):
    return {frozenset(np.flatnonzero(labels == c)) for c in np.unique(labels[labels >= 0])}


@pytest.mark.parametrize("options", [
    {}, {"min_samples": 2}, {"alpha": 1.3}, {"metric": "manhattan"}, {"metric": "p", "p": 3},
    {"cluster_selection_method": "leaf"}, {"cluster_selection_epsilon": 0.5},
    {"max_cluster_size": 26}, {"allow_single_cluster": True}, {"metric": "cosine"},
    {"metric": lambda a, b: float(np.abs(a - b).max())}], ids=str)
def test_the_clusters_are_those_of_the_estimator(rng, options):
    """Its `min_samples` counts the point itself, and its labels have other numbers."""
    X = cloud(rng).round(2)
    found = hdbscan.HDBSCAN(**options).fit(X)
    other = {**options, "min_samples": options.get("min_samples", 5) + 1}
    if "p" in other:
        other["metric_params"] = {"p": other.pop("p")}
    expected = HDBSCAN(**other).fit(X)
    assert partition(found.labels_) == partition(expected.labels_)
    assert np.array_equal(found.probabilities_, expected.probabilities_)
    assert np.array_equal(found.outlier_scores_, expected.outlier_scores_)
    assert sorted(found.cluster_persistence_) == sorted(expected.cluster_persistence_)
    assert sorted(map(len, found.exemplars_)) == sorted(map(len, expected.exemplars_))
    labels, probabilities = hdbscan.approximate_predict(found, X)
    assert np.array_equal(labels, found.labels_)
    assert np.array_equal(probabilities, found.probabilities_)
    assert np.allclose(hdbscan.approximate_predict_scores(found, X), found.outlier_scores_)


def test_the_order_of_rows_changes_nothing_but_numbers(rng):
    X = cloud(rng).round(1)
    expected = hdbscan.HDBSCAN().fit(X)
    strengths = hdbscan.all_points_membership_vectors(expected)
    for _ in range(10):
        order = rng.permutation(len(X))
        found = hdbscan.HDBSCAN().fit(X[order])
        assert {frozenset(order[list(c)]) for c in partition(found.labels_)} == partition(
            expected.labels_)
        there = hdbscan.all_points_membership_vectors(found)
        assert np.allclose(np.sort(there, axis=1), np.sort(strengths[order], axis=1))


@pytest.mark.parametrize("method", ["eom", "leaf"])
def test_numbers_of_clusters(rng, method):
    """Labels are in the order of the numbers of their clusters, and parents come before their
    children."""
    X = cloud(rng)
    fitted = hdbscan.HDBSCAN(3, 2, cluster_selection_method=method).fit(X)
    tree, n = fitted.condensed_tree_.to_numpy(), len(X)
    assert tree["parent"].min() == n and sorted(tree["child"][tree["child_size"] == 1]) == list(
        range(n))
    clusters = tree[tree["child"] >= n]
    assert np.array_equal(np.sort(clusters["child"]), n + 1 + np.arange(len(clusters)))
    assert (clusters["parent"] < clusters["child"]).all()
    chosen = fitted.condensed_tree_._select_clusters()
    assert chosen == sorted(chosen) and len(chosen) == fitted.labels_.max() + 1
    parent = dict(zip(clusters["child"].tolist(), clusters["parent"].tolist()))
    for point, c in zip(tree["child"].tolist(), tree["parent"].tolist()):
        if point < n:
            while c not in chosen and c in parent:
                c = parent[c]
            assert fitted.labels_[point] == (chosen.index(c) if c in chosen else -1)
    sizes = dict(zip(clusters["child"].tolist(), clusters["child_size"].tolist()))
    for c in [n, *parent]:
        assert tree["child_size"][tree["parent"] == c].sum() == sizes.get(c, n)


def test_memberships_by_definition(rng):
    """Slowly, with walks from the point and the cluster to their first common ancestor."""
    X = cloud(rng)
    fitted = hdbscan.HDBSCAN(4, 2, cluster_selection_method="leaf").fit(X)
    tree, n = fitted.condensed_tree_.to_numpy(), len(X)
    up = {int(r["child"]): (int(r["parent"]), float(r["lambda_val"])) for r in tree}
    chosen = fitted.condensed_tree_._select_clusters()
    last = {c: tree["lambda_val"][tree["parent"] == c].max() for c in set(tree["parent"].tolist())}

    def line(c):
        return [c] + (line(up[c][0]) if c in up else [])

    found = hdbscan.all_points_membership_vectors(fitted)
    assert found.shape == (n, len(chosen)) and len(chosen) > 2
    for x in range(n):
        c, own = up[x]
        heights = []
        for j in chosen:
            if c in line(j) or j in line(c):
                heights.append(own)
            else:
                common = next(a for a in line(c) if a in line(j))
                heights.append(last[common])
        near = 1 / np.array([max(1e-300, spatial.cdist(X[[x]], e).min())
                             for e in fitted.exemplars_])
        inside = np.exp(np.exp(-last[c] / np.array(heights)))
        shares = near / near.max() * inside
        ends = max(1 / last[j] for j, h in zip(chosen, heights) if h == max(heights))
        expected = shares / shares.sum() * max(heights) / max(own, 1 / ends)
        assert np.allclose(found[x], expected)
    assert (found.sum(axis=1) <= 1 + 1e-12).all()
    is_in = fitted.labels_ >= 0
    assert np.allclose(found[is_in].sum(axis=1), fitted.probabilities_[is_in])
    assert (found[is_in].argmax(axis=1) == fitted.labels_[is_in]).mean() > 0.9


def test_memberships_of_new_rows(rng):
    X = cloud(rng)
    fitted = hdbscan.HDBSCAN(8).fit(X)
    new = np.vstack([X[:5] + 0.01, [[40, 40], [np.nan, 0]]])
    found = hdbscan.membership_vector(fitted, new)
    labels, probabilities = hdbscan.approximate_predict(fitted, new)
    assert found.shape == (7, fitted.labels_.max() + 1) and labels[-1] == -1
    assert (found[:5].argmax(axis=1) == labels[:5]).all()
    assert np.allclose(found[:5].sum(axis=1), probabilities[:5])
    assert found[5].sum() < 0.1 and (found[6] == 0).all()
    D = spatial.squareform(spatial.pdist(X))
    by_distances = hdbscan.HDBSCAN(8, metric="precomputed").fit(D)
    again = hdbscan.membership_vector(by_distances, spatial.cdist(new[:6], X))
    assert np.allclose(again, found[:6])
    assert np.allclose(hdbscan.all_points_membership_vectors(by_distances),
                       hdbscan.all_points_membership_vectors(fitted))
    nothing = hdbscan.HDBSCAN(80).fit(X)
    assert hdbscan.membership_vector(nothing, new).shape == (7, 0)
    assert hdbscan.all_points_membership_vectors(nothing).tolist() == [0] * len(X)


def test_copies_of_a_point():
    """Their lambda values are infinite."""
    X = np.repeat([[0.0, 0], [5, 5], [9, 0]], 12, axis=0)
    X = np.vstack([X, [[2.0, 2]]])
    fitted = hdbscan.HDBSCAN(5).fit(X)
    assert partition(fitted.labels_) == {
        frozenset([*range(12), 36]), frozenset(range(12, 24)), frozenset(range(24, 36))}
    assert np.isinf(fitted.condensed_tree_.to_numpy()["lambda_val"]).sum() == 36
    assert fitted.cluster_persistence_.tolist() == [1, 1, 1]
    found = hdbscan.all_points_membership_vectors(fitted)
    assert np.allclose(found[:36].max(axis=1), 1) and np.isfinite(found).all()
    assert np.isfinite(hdbscan.membership_vector(fitted, X)).all()
    assert np.isfinite(fitted.condensed_tree_.get_plot_data()["bar_tops"]).all()


def test_matrices(rng):
    X = cloud(rng)
    D = spatial.squareform(spatial.pdist(X))
    expected = hdbscan.HDBSCAN(5, 4).fit(X)
    for data in (D, scipy.sparse.csr_matrix(D)):
        found = hdbscan.HDBSCAN(5, 4, metric="precomputed", gen_min_span_tree=True).fit(data)
        assert np.array_equal(found.labels_, expected.labels_)
        assert np.array_equal(found.minimum_spanning_tree_.to_numpy()[:, 2],
                              expected.minimum_spanning_tree_.to_numpy()[:, 2])
    sparse = hdbscan.HDBSCAN(5, 4).fit(scipy.sparse.csr_matrix(X))  # points
    assert partition(sparse.labels_) == partition(expected.labels_)
    with pytest.raises(AttributeError, match="exemplars_: found distances"):
        found.exemplars_


def test_pairs_that_are_not_stored(rng):
    X = np.vstack([rng.normal(0, 0.3, (20, 2)), rng.normal(9, 0.3, (20, 2)), [[50, 50]]])
    D = spatial.squareform(spatial.pdist(X))
    stored = scipy.sparse.csr_matrix(np.where(D > 5, 0, D))
    found = hdbscan.HDBSCAN(metric="precomputed").fit(stored)
    assert partition(found.labels_) == {frozenset(range(20)), frozenset(range(20, 40))}
    linkage = found.single_linkage_tree_.to_numpy()
    assert linkage.shape == (40, 4) and np.isinf(linkage[-2:, 2]).all() and linkage[-1, 3] == 41
    D[40, 0] = D[0, 40] = 4.9
    few = scipy.sparse.csr_matrix(np.where(D > 5, 0, D))
    assert np.isinf(hdbscan.HDBSCAN(5, 5, metric="precomputed").fit(
        few).single_linkage_tree_.to_numpy()[:, 2]).sum() == 2
    with_limit = hdbscan.HDBSCAN(5, 5, metric="precomputed", max_dist=100.0).fit(few)
    assert (with_limit.single_linkage_tree_.to_numpy()[:, 2] == 100).sum() == 1


def test_places_on_the_earth(rng):
    """Chords and arcs have the same order, and the values are arcs."""
    place = np.vstack([rng.normal((0.9, 0.1), 0.001, (30, 2)), rng.normal((0.7, 2), 0.002, (30, 2)),
                       rng.uniform((-1.5, -3), (1.5, 3), (20, 2))])
    a, b = place.T[:, :, None], place.T[:, None]
    D = 2 * np.arcsin(np.sqrt(np.sin((a[0] - b[0]) / 2)**2
                              + np.cos(a[0]) * np.cos(b[0]) * np.sin((a[1] - b[1]) / 2)**2))
    for alpha in (1.0, 1.5):
        found = hdbscan.HDBSCAN(8, 4, metric="haversine", alpha=alpha).fit(place)
        expected = hdbscan.HDBSCAN(8, 4, metric="precomputed", alpha=alpha).fit(D)
        assert np.array_equal(found.labels_, expected.labels_) and found.labels_.max() > 0
        assert np.allclose(found.minimum_spanning_tree_.to_numpy()[:, 2],
                           expected.minimum_spanning_tree_.to_numpy()[:, 2])
        assert np.array_equal(hdbscan.approximate_predict(found, place)[0], found.labels_)
        assert np.allclose(hdbscan.all_points_membership_vectors(found),
                           hdbscan.all_points_membership_vectors(expected))
    with pytest.raises(ph.UsageError, match="latitude"):
        hdbscan.HDBSCAN(metric="haversine").fit(np.ones((9, 3)))


def test_cuts_leave_out_edges_of_their_value():
    X = np.arange(6.0)[:, None]
    fitted = hdbscan.HDBSCAN(2, 1).fit(X)
    assert fitted.dbscan_clustering(1.0, 2).tolist() == [-1] * 6
    assert fitted.dbscan_clustering(np.nextafter(1.0, 2), 2).tolist() == [0] * 6
    assert fitted.dbscan_clustering(1.0, 1).tolist() == list(range(6))
    assert fitted.single_linkage_tree_.get_clusters(9).tolist() == [0] * 6
    robust = hdbscan.RobustSingleLinkage(cut=1.5, k=1, gamma=2).fit(np.append(X, [[9.0]], axis=0))
    assert robust.labels_.tolist() == [0] * 6 + [-1]
    assert robust.cluster_hierarchy_.to_numpy().shape == (6, 4)
    assert np.array_equal(clone(robust).fit_predict(X), [0] * 6)


def test_small_tables():
    for n in range(1, 4):
        fitted = hdbscan.HDBSCAN().fit(np.arange(float(n))[:, None])
        assert fitted.labels_.tolist() == [-1] * n
        assert len(fitted.condensed_tree_.to_numpy()) == n
        assert len(fitted.single_linkage_tree_.to_numpy()) == n - 1
        assert hdbscan.approximate_predict(fitted, [[0.5]])[0].tolist() == [-1]
    X = [[0], [1], [2], [10], [11], [12]]
    assert hdbscan.HDBSCAN(3, 50).fit(X).labels_.tolist() == [-1] * 6
    reference = hdbscan.HDBSCAN(2, 2, match_reference_implementation=True).fit(X)
    assert np.array_equal(reference.labels_, hdbscan.HDBSCAN(3, 1).fit(X).labels_)
    with pytest.raises(ph.UsageError, match="none of them finite"):
        hdbscan.HDBSCAN().fit([[np.nan], [np.inf]])


def test_kinds_of_tables(rng):
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    X = cloud(rng).round(3).astype(np.float32)
    expected = hdbscan.HDBSCAN().fit(X.astype(np.float64))
    for data in (X, X.tolist(), pandas.DataFrame(X), np.asfortranarray(X)):
        found = hdbscan.HDBSCAN().fit(data)
        assert np.array_equal(found.labels_, expected.labels_)
        assert np.array_equal(hdbscan.approximate_predict(found, data)[0], expected.labels_)
    sparse = hdbscan.HDBSCAN(4, 2).fit(scipy.sparse.coo_matrix(np.where(X > 9, np.inf, X)))
    assert len(sparse.labels_) == len(X)
    with_gaps = scipy.sparse.lil_matrix(X)
    with_gaps[3, 0] = np.nan
    assert hdbscan.HDBSCAN().fit(with_gaps).labels_[3] == -1


def test_facts_for_prediction(rng):
    X = cloud(rng)
    fitted = hdbscan.HDBSCAN(6).fit(X)
    fitted.generate_prediction_data()
    data = fitted.prediction_data_
    assert np.array_equal(data.raw_data, X) and len(data.exemplars) == fitted.labels_.max() + 1
    assert np.allclose(data.core_distances, np.sort(spatial.cdist(X, X))[:, 6])
    tree = fitted.condensed_tree_.to_numpy()
    for c, value in data.leaf_max_lambdas.items():
        assert value == tree["lambda_val"][tree["parent"] == c].max()
    for c, label in data.cluster_map.items():
        assert data.max_lambdas[c] == data.leaf_max_lambdas[data.reverse_cluster_map[label]]
    assert (data.cluster_tree["child_size"] > 1).all()


def test_estimators_of_scikit_learn(rng):
    X = cloud(rng, 6)
    fitted = make_pipeline(PCA(2), hdbscan.HDBSCAN(min_cluster_size=8))
    assert fitted.fit_predict(X).max() >= 1
    one = hdbscan.HDBSCAN(5, metric="mahalanobis", V=np.eye(6))
    assert "mahalanobis" in repr(one)
    assert clone(one).get_params()["V"] is not None and clone(one).set_params(
        min_samples=3, V=2 * np.eye(6)).get_params()["V"][0, 0] == 2
    assert partition(clone(one).fit(X).labels_) == partition(hdbscan.HDBSCAN(5).fit(X).labels_)
    search = GridSearchCV(hdbscan.HDBSCAN(), {"min_cluster_size": [5, 40, 10]}, cv=[
        (np.arange(len(X)), np.arange(len(X)))], scoring=lambda e, X, y=None: e.relative_validity_)
    assert search.fit(X).best_params_["min_cluster_size"] in (5, 10)


def test_pickles(rng):
    X = cloud(rng)
    for options in ({}, {"metric": "haversine"}, {"metric": "canberra"}):
        fitted = hdbscan.HDBSCAN(**options).fit(X)
        again = pickle.loads(pickle.dumps(fitted))
        assert np.array_equal(again.condensed_tree_.to_numpy(), fitted.condensed_tree_.to_numpy())
        assert np.array_equal(hdbscan.membership_vector(again, X[:9] + 0.1),
                              hdbscan.membership_vector(fitted, X[:9] + 0.1))


def test_results_wait_for_a_fit():
    for name in ("condensed_tree_", "single_linkage_tree_", "outlier_scores_", "prediction_data_",
                 "exemplars_", "relative_validity_"):
        with pytest.raises(AttributeError, match="not fitted"):
            getattr(hdbscan.HDBSCAN(), name)
    with pytest.raises(ValueError, match="not fitted"):
        hdbscan.approximate_predict(hdbscan.HDBSCAN(), [[0.0]])


@pytest.mark.parametrize(("options", "message"), [
    ({"min_cluster_size": 1}, "min_cluster_size: found 1"),
    ({"min_cluster_size": 5.0}, "min_cluster_size: found 5.0"),
    ({"min_samples": 0}, "min_samples: found 0"),
    ({"alpha": 0.0}, "alpha: found 0"),
    ({"cluster_selection_epsilon": -1.0}, "epsilon: found -1"),
    ({"cluster_selection_method": "oem"}, "method: found 'oem'"),
    ({"algorithm": "fastest"}, "algorithm: found 'fastest'"),
    ({"metric": 3}, "metric: found 3"),
    ({"metric": "minkowski", "p": -1}, "p: found -1"),
    ({"metric": "precomputed"}, "expected a square one"),
])
def test_bad_options_are_refused(options, message):
    with pytest.raises(ph.UsageError, match=message):
        hdbscan.HDBSCAN(**options).fit(np.arange(18.0).reshape(9, 2))


@pytest.mark.parametrize(("options", "message"), [
    ({"cluster_selection_persistence": 0.1}, "cluster_selection_epsilon joins"),
    ({"cluster_selection_epsilon_max": 2.0}, "max_cluster_size bounds"),
    ({"branch_detection_data": True}, "branches are not in this drop-in")])
def test_what_is_missing_is_refused_by_name(options, message):
    with pytest.raises(ph.NotBuiltIn, match=f"{next(iter(options))}: found .*{message}"):
        hdbscan.HDBSCAN(**options).fit(np.arange(18.0).reshape(9, 2))


def test_keywords():
    X = np.arange(18.0).reshape(9, 2)
    with pytest.raises(TypeError, match="hdbscan.. got an unexpected keyword argument "
                                        "'min_sample'; did you mean 'min_samples'"):
        hdbscan.HDBSCAN(min_sample=3).fit(X)
    with pytest.raises(TypeError, match="hdbscan.. got .*'min_sample'"):
        hdbscan.hdbscan(X, min_sample=3)
    with pytest.raises(TypeError, match="validity_index.. got .*'dim'"):
        hdbscan.validity_index(X, np.zeros(9, dtype=int), dim=3)
    with pytest.raises(TypeError, match="did you mean 'k'"):
        hdbscan.RobustSingleLinkage(min_samples=3)
    with pytest.raises(ph.UsageError, match=r"shape \(1, 3\), expected rows with 2 columns"):
        hdbscan.approximate_predict(hdbscan.HDBSCAN().fit(X), [[1, 2, 3]])
    with pytest.raises(ph.UsageError, match="cluster_id: found -1"):
        hdbscan.HDBSCAN().fit(X).weighted_cluster_centroid(-1)


def test_validity(rng):
    X = cloud(rng)
    labels = hdbscan.HDBSCAN(8).fit(X).labels_
    good, scores = hdbscan.validity_index(X, labels, per_cluster_scores=True)
    bad = hdbscan.validity_index(X, rng.permutation(labels))
    assert good > 0.3 > 0 > bad and scores.shape == (labels.max() + 1,) and (scores <= 1).all()
    D = spatial.squareform(spatial.pdist(X))
    assert hdbscan.validity_index(D, labels, "precomputed", d=2) == pytest.approx(good)
    with pytest.raises(ph.UsageError, match="d: found None"):
        hdbscan.validity_index(D, labels, "precomputed")
    with pytest.raises(ph.UsageError, match="labels: found an array"):
        hdbscan.validity_index(X, labels[1:])
    gap = np.where(labels == 0, labels.max() + 1, labels)
    assert hdbscan.validity_index(X, gap) == pytest.approx(good)
    by_hand = hdbscan.validity_index([[0], [1], [3], [10], [11], [13]], [0, 0, 0, 1, 1, 1],
                                     mst_raw_dist=True)
    assert by_hand == pytest.approx((10 - 2) / 10)  # the inner points are 1 and 11


def test_validity_can_be_printed(capsys):
    hdbscan.validity_index([[0], [1], [9], [10]], [0, 0, 1, 1], verbose=True)
    assert capsys.readouterr().out.splitlines() == [
        "cluster 0: separation 9.0, sparseness 1.0", "cluster 1: separation 9.0, sparseness 1.0"]
    hdbscan.validity_index([[0], [1], [9], [10]], [0, 0, 1, 1])
    assert capsys.readouterr().out == ""
