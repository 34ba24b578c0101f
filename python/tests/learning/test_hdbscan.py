# SPDX-License-Identifier: MIT
"""HDBSCAN*, compared with definitions by brute force and with other packages."""
import pickle

import numpy as np
import pytest
import scipy.sparse
import scipy.spatial.distance as spatial
from samples import blobs
from sklearn.cluster import DBSCAN
from sklearn.utils import estimator_checks

import libph as ph
from libph.sklearn import HDBSCAN


def partition(labels):
    """The clusters as sets of rows."""
    return {frozenset(np.flatnonzero(labels == c)) for c in np.unique(labels[labels >= 0])}


def reachability(X, k, alpha=1.0, metric="euclidean"):
    """The matrix of mutual reachability distances, from the definition."""
    D = spatial.squareform(spatial.pdist(X, metric))
    core = np.array([sorted(np.delete(row, i))[k - 1] if k else 0.0 for i, row in enumerate(D)])
    return np.maximum(np.maximum(core[:, None], core[None, :]), D / alpha), core


def components(V, rows, value):
    """Sets of rows that edges below a value join."""
    left, found = set(rows), []
    while left:
        part = [left.pop()]
        for i in part:
            near = [j for j in left if V[i, j] < value]
            left.difference_update(near)
            part.extend(near)
        found.append(sorted(part))
    return found


def leaves(V, rows, m):
    """The rows of each cluster of the condensed tree without clusters inside it, top down."""
    whole = list(rows)
    while True:
        values = np.unique(V[np.ix_(rows, rows)][~np.eye(len(rows), dtype=bool)])[::-1]
        parts = next((p for p in (components(V, rows, v) for v in values) if len(p) > 1), [])
        real = [p for p in parts if len(p) >= m]
        if len(real) > 1:
            return [leaf for p in real for leaf in leaves(V, p, m)]
        if not real:
            return [whole]
        rows = real[0]


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("alpha", [1.0, 1.5])
def test_leaves_are_those_of_the_definition(seed, alpha):
    rng = np.random.default_rng(seed)
    X = np.vstack([rng.normal(c, 0.4, (int(rng.integers(5, 14)), 2)) for c in (0, 2, 4)])
    if seed % 3 == 0:
        X = X.round(1)  # equal values and copies
    m, rank = int(rng.integers(2, 6)), int(rng.integers(1, 6))
    V, core = reachability(X, rank - 1, alpha)
    found = HDBSCAN(m, rank, cluster_selection_method="leaf", alpha=alpha).fit(X)
    expected = leaves(V, list(range(len(X))), m)
    expected = {frozenset(leaf) for leaf in expected} if len(expected) > 1 else set()
    assert partition(found.labels_) == expected
    assert np.allclose(found.cluster_tree_.births, core)


@pytest.mark.parametrize("kind", ["points", "dense", "sparse", "function"])
@pytest.mark.parametrize("metric", ["euclidean", "manhattan", "chebyshev"])
def test_points_and_distances_give_the_same(rng, kind, metric):
    X = blobs(rng)
    name = "cityblock" if metric == "manhattan" else metric
    D = spatial.squareform(spatial.pdist(X, name))
    expected = HDBSCAN(metric=metric).fit(X)
    if kind == "points":
        found = HDBSCAN(metric={"manhattan": "l1", "chebyshev": "infinity",
                                "euclidean": "l2"}[metric]).fit(X)
    elif kind == "function":
        found = HDBSCAN(metric=lambda a, b: spatial.cdist([a], [b], name)[0, 0]).fit(X)
    else:
        found = HDBSCAN(metric="precomputed").fit(
            scipy.sparse.csr_matrix(D) if kind == "sparse" else D)
    assert np.array_equal(found.labels_, expected.labels_)
    assert np.allclose(found.probabilities_, expected.probabilities_)
    assert np.allclose(found.outlier_scores_, expected.outlier_scores_)


@pytest.mark.parametrize("alpha", [0.3, 2**0.5, 3.7])
def test_rounding_by_alpha_keeps_the_order(rng, alpha):
    found = HDBSCAN(alpha=alpha).fit(blobs(rng))
    tree = found.cluster_tree_
    assert (tree.births[tree.edges].max(axis=1) <= tree.values).all()
    assert np.array_equal(found.merge_tree_.values, tree.values)


def test_pairs_that_are_not_stored_are_never_joined(rng):
    X = np.vstack([rng.normal(0, 0.3, (20, 2)), rng.normal(9, 0.3, (20, 2)), [[50, 50]]])
    D = spatial.squareform(spatial.pdist(X))
    far = D > 5
    stored = scipy.sparse.csr_matrix(np.where(far, 0, D))
    found = HDBSCAN(metric="precomputed").fit(stored)
    infinite = HDBSCAN(metric="precomputed").fit(np.where(far, np.inf, D))
    assert partition(found.labels_) == {frozenset(range(20)), frozenset(range(20, 40))}
    assert np.array_equal(found.labels_, infinite.labels_) and found.labels_[40] == -1


def test_rows_that_are_not_finite(rng):
    X = blobs(rng)
    whole = HDBSCAN().fit(X).labels_
    Y = np.insert(X, [0, 7, 7], [[np.nan, 0], [np.inf, 1], [0, -np.inf]], axis=0)
    found = HDBSCAN(store_centers="both").fit(Y)
    assert found.labels_[[0, 8, 9]].tolist() == [-3, -2, -2]
    kept = np.delete(np.arange(len(Y)), [0, 8, 9])
    assert np.array_equal(found.labels_[kept], whole)
    assert np.isnan(found.probabilities_[0]) and (found.probabilities_[[8, 9]] == 0).all()
    assert np.isnan(found.outlier_scores_[[0, 8, 9]]).all()
    assert found.dbscan_clustering(1.0)[[0, 8, 9]].tolist() == [-3, -2, -2]
    assert found.centroids_.shape == found.medoids_.shape == (whole.max() + 1, 2)


@pytest.mark.parametrize("method", ["eom", "leaf"])
def test_the_order_of_rows_changes_nothing(rng, method):
    X = blobs(rng).round(1)
    expected = HDBSCAN(cluster_selection_method=method).fit(X)
    for _ in range(20):
        order = rng.permutation(len(X))
        found = HDBSCAN(cluster_selection_method=method, n_jobs=2).fit(X[order])
        assert {frozenset(order[list(c)]) for c in partition(found.labels_)} == partition(
            expected.labels_)
        assert np.array_equal(found.probabilities_, expected.probabilities_[order])
        assert np.array_equal(found.outlier_scores_, expected.outlier_scores_[order])


@pytest.mark.parametrize("rank", [1, 4, 8])
def test_a_cut_is_dbscan_without_border_points(rng, rank):
    X = blobs(rng)
    found = HDBSCAN(min_samples=rank).fit(X)
    for radius in (0.1, 0.3, 0.7):
        other = DBSCAN(eps=radius, min_samples=rank).fit(X)
        labels = np.full(len(X), -1)
        core = other.core_sample_indices_
        labels[core] = other.labels_[core]
        assert partition(found.dbscan_clustering(radius, 1)) == partition(labels)
        large = {c for c in partition(labels) if len(c) >= 5}
        assert partition(found.dbscan_clustering(radius)) == large


def test_other_parameters_need_no_other_forest(rng):
    X = blobs(rng)
    fitted = HDBSCAN(5, 4).fit(X)
    for changes in ({"min_cluster_size": 3}, {"min_cluster_size": 12},
                    {"cluster_selection_method": "leaf"}, {"cluster_selection_epsilon": 0.4},
                    {"allow_single_cluster": True}, {"max_cluster_size": 20}):
        other = HDBSCAN(**{"min_cluster_size": 5, "min_samples": 4, **changes}).fit(X)
        assert np.array_equal(fitted.cut(**changes), other.labels_), changes
    with pytest.raises(TypeError, match="min_samples"):
        fitted.cut(min_samples=3)


@pytest.mark.parametrize("options", [
    {}, {"min_samples": 1}, {"cluster_selection_method": "leaf"}, {"alpha": 1.5},
    {"cluster_selection_epsilon": 0.5}, {"allow_single_cluster": True}, {"metric": "manhattan"},
    {"metric": lambda a, b: float(np.abs(a - b).max())}, {"metric": "precomputed"}], ids=str)
def test_fitted_rows_are_predicted_as_they_are(rng, options):
    for X in (blobs(rng), blobs(rng).round(1)):
        data = spatial.squareform(spatial.pdist(X)) if options.get("metric") == "precomputed" else X
        found = HDBSCAN(**options).fit(data)
        assert np.array_equal(found.predict(data), found.labels_)
        assert np.array_equal(found._located(data)[1], found.probabilities_)


def test_new_rows_are_predicted_by_definition(rng):
    X = blobs(rng)
    found = HDBSCAN(6, 4).fit(X)
    V, core = reachability(X, 3)
    for row in np.vstack([rng.uniform(-3, 6, (40, 2)), [[np.nan, 0], [0, np.inf]]]):
        label = found.predict([row])[0]
        if not np.isfinite(row).all():
            assert label == (-3 if np.isnan(row).any() else -2)
            continue
        lengths = np.linalg.norm(X - row, axis=1)
        reach = np.maximum(np.maximum(np.sort(lengths)[3], core), lengths)
        q, value = reach.argmin(), reach.min()
        # The row has the label of a cluster if its component at `value` lies in that cluster.
        part = next(p for p in components(V, range(len(X)), np.nextafter(value, np.inf)) if q in p)
        labels = set(found.labels_[part].tolist()) - {-1}
        expected = found.labels_[q] if value <= found.cluster_tree_.leaves_at[q] else (
            labels.pop() if len(labels) == 1 and any(
                set(part) <= c for c in partition(found.labels_)) else -1)
        assert label == expected


def test_more_results(rng):
    X = blobs(rng)
    found = HDBSCAN(store_centers="both").fit(X)
    count = found.labels_.max() + 1
    assert count >= 2
    tree = found.minimum_spanning_tree_
    assert tree.shape == (len(X) - 1, 3) and (np.diff(tree[:, 2]) >= 0).all()
    V, _ = reachability(X, 4)
    assert np.allclose(V[tuple(tree[:, :2].astype(int).T)], tree[:, 2])
    assert found.single_linkage_tree_.shape == (len(X) - 1, 4)
    assert found.single_linkage_tree_[-1, 3] == len(X)
    expected = ph.merge_tree(X, weights="core", core_neighbors=4)
    assert np.array_equal(found.merge_tree_.linkage, expected.linkage)
    assert ((0 < found.cluster_persistence_) & (found.cluster_persistence_ <= 1)).all()
    for c, rows in enumerate(found.exemplars_):
        assert len(rows) and (found.labels_[rows] == c).all()
        assert found.probabilities_[rows].max() == 1
    for c in range(count):
        of_cluster = found.labels_ == c
        w = found.probabilities_[of_cluster]
        assert np.allclose(found.centroids_[c], (X[of_cluster] * w[:, None]).sum(0) / w.sum())
        assert (X[of_cluster] == found.medoids_[c]).all(axis=1).any()
    again = pickle.loads(pickle.dumps(found))
    assert np.array_equal(again.outlier_scores_, found.outlier_scores_)
    assert np.array_equal(again.cut(min_cluster_size=9), found.cut(min_cluster_size=9))


@pytest.mark.parametrize(("options", "message"), [
    ({"min_cluster_size": 1}, "min_cluster_size: found 1"),
    ({"min_samples": 0}, "min_samples: found 0"),
    ({"min_samples": 99}, "min_samples: found 99, expected at most .* n_samples = 9"),
    ({"min_cluster_size": 12}, "min_cluster_size: found 12, expected at most"),
    ({"cluster_selection_method": "oem"}, "method: found 'oem'"),
    ({"cluster_selection_epsilon": -1}, "epsilon: found -1"),
    ({"metric": "euclid"}, "metric: found 'euclid'"),
    ({"alpha": 0}, "alpha: found 0"),
    ({"store_centers": "mean"}, "store_centers: found 'mean'"),
    ({"metric": "precomputed"}, "expected a square one"),
])
def test_bad_options_are_refused(options, message):
    with pytest.raises(ValueError, match=message):
        HDBSCAN(**options).fit(np.arange(18.0).reshape(9, 2))


def test_distances_that_are_not_symmetric_are_refused(rng):
    D = spatial.squareform(spatial.pdist(rng.random((9, 2))))
    D[2, 5] += 1
    with pytest.raises(ph.DataError, match="symmetr"):
        HDBSCAN(2, metric="precomputed").fit(D)
    D[2, 5] = np.nan
    with pytest.raises(ph.DataError, match="NaN"):
        HDBSCAN(2, metric="precomputed").fit(D)


@pytest.mark.filterwarnings("ignore")
@estimator_checks.parametrize_with_checks([HDBSCAN(), HDBSCAN(3, 2)])
def test_checks_of_scikit_learn(estimator, check):
    check(estimator)


@pytest.mark.parametrize("seed", range(30))
def test_where_no_values_are_equal_scikit_learn_agrees(seed):
    """Single linkage of points in general position has no equal values."""
    pytest.importorskip("sklearn", minversion="1.3")
    from sklearn.cluster import HDBSCAN as Other
    rng = np.random.default_rng(seed)
    X = blobs(rng)
    m = int(rng.integers(2, 8))
    for method in ("eom", "leaf"):
        ours = HDBSCAN(m, 1, cluster_selection_method=method).fit(X)
        other = Other(m, 1, cluster_selection_method=method, copy=True).fit(X)
        assert partition(ours.labels_) == partition(other.labels_)
        assert np.allclose(ours.probabilities_, other.probabilities_)


# ---- cluster trees

def test_trees_of_images():
    image = np.array([[5, 1, 2, 7, 3, 4, 3, 9, 0]])
    tree = ph.cluster_tree(image, 2, complex="cubical")
    assert tree.scale == "linear"
    assert tree.select().labels.tolist() == [0, 0, 0, -1, 1, 1, 1, -1, -1]
    again = ph.merge_tree(image, complex="cubical").clusters(2)
    assert np.array_equal(again.clusters, tree.clusters)
    assert ph.cluster_tree(image, 2, complex="cubical", scale="log").scale == "log"


def test_points_that_are_left_out_are_noise():
    X = [[0], [1], [np.nan], [2], [20], [21], [22]]
    tree = ph.cluster_tree(X, 3, weights="core", core_neighbors=1, nan="drop")
    assert tree.select().labels.tolist() == [0, 0, -1, 0, 1, 1, 1]
    assert tree.births[2] == np.inf and len(tree) == 7
    assert tree.cut(1.0).tolist() == [0, 0, -1, 0, 1, 1, 1]
    near = ph.cluster_tree([[0], [1], [2], [9]], 2, weights="core", core_neighbors=1, threshold=3)
    assert near.births.tolist() == [1, 1, 1, np.inf]


def test_trees_of_other_sizes(rng):
    X = blobs(rng)
    tree = ph.cluster_tree(X, 3, weights="core", core_neighbors=2)
    larger = tree.with_min_size(9)
    anew = ph.cluster_tree(X, 9, weights="core", core_neighbors=2)
    fields = ["top", "bottom", "least", "size", "mass"]  # clusters may be numbered differently
    assert sorted(larger.clusters[fields].tolist()) == sorted(anew.clusters[fields].tolist())
    assert np.array_equal(larger.leaves_at, anew.leaves_at)
    with pytest.raises(ph.UsageError, match="min_size: found 2"):
        larger.with_min_size(2)
    with pytest.raises(ph.UsageError, match="does nothing for a cluster tree of rips"):
        ph.cluster_tree(X, 3, max_dim=1)
