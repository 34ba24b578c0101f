# SPDX-License-Identifier: MIT
"""Compares the drop-in for hdbscan with hdbscan itself.

With ``min_samples=1``, the core distance of a point is at most the length of each of its edges. In
general position no two edges are then equal, and the two have to agree in everything except the
numbers of the clusters. Tests with other numbers of neighbours compare what ties leave alone.
"""
import numpy as np
import pytest
import scipy.cluster.hierarchy as hierarchy
import scipy.spatial.distance as spatial

ours = pytest.importorskip("libph.compat.hdbscan")
pytest.importorskip("sklearn", reason="scikit-learn is missing, which estimators need")
genuine = pytest.importorskip("hdbscan", reason="hdbscan is missing, which the drop-in replaces")
if genuine is ours:
    pytest.skip("hdbscan is the drop-in", allow_module_level=True)

EXACT = {"algorithm": "prims_kdtree", "approx_min_span_tree": False, "gen_min_span_tree": True,
         "prediction_data": True}


def cloud(rng):
    """Groups of points of different densities, and noise."""
    count = int(rng.integers(2, 6))
    groups = [rng.normal(rng.uniform(-6, 6, 2), rng.uniform(0.1, 0.9),
                         (int(rng.integers(6, 40)), 2)) for _ in range(count)]
    return np.vstack([*groups, rng.uniform(-8, 8, (int(rng.integers(1, 15)), 2))])


def both(X, **options):
    return (ours.HDBSCAN(**options).fit(X),
            genuine.HDBSCAN(**{**EXACT, **options}).fit(X))


def matched(a, b):
    """For each label of `b`, the label of `a` with the same rows."""
    place = {frozenset(np.flatnonzero(a == c)): c for c in range(a.max(initial=-1) + 1)}
    return [place[frozenset(np.flatnonzero(b == c))] for c in range(b.max(initial=-1) + 1)]


def choice_of(rng):
    """Options at random."""
    options = {"min_samples": 1, "min_cluster_size": int(rng.integers(2, 9)),
               "cluster_selection_method": str(rng.choice(["eom", "leaf"]))}
    if rng.random() < 0.3:
        options["cluster_selection_epsilon"] = float(rng.uniform(0.05, 1.5))
    if rng.random() < 0.3 and options["cluster_selection_method"] == "eom":
        options["allow_single_cluster"] = True
    if rng.random() < 0.3:
        options["max_cluster_size"] = int(rng.integers(5, 40))
    if rng.random() < 0.3:
        options["metric"] = str(rng.choice(["manhattan", "chebyshev", "l1", "infinity"]))
    return options


METRICS = {None: "euclidean", "manhattan": "cityblock", "l1": "cityblock", "chebyshev": "chebyshev"}


def clusters_of(tree, n):
    """The points and the first lambda value of each cluster of a condensed tree, by number."""
    members = {c: set() for c in np.unique(tree["parent"]).tolist()}
    tops = dict.fromkeys(members, 0.0)
    for row in np.sort(tree)[::-1]:  # children have larger numbers than their parents
        child, parent = int(row["child"]), int(row["parent"])
        members[parent] |= {child} if child < n else members[child]
        if child >= n:
            tops[child] = row["lambda_val"]
    return {c: (frozenset(members[c]), tops[c]) for c in members}


def knows_its_clusters(fitted):
    """hdbscan takes a cluster that no point leaves directly for one of the clusters inside it."""
    members = clusters_of(fitted._condensed_tree, len(fitted.labels_))
    return all(members[number][0] == set(np.flatnonzero(fitted.labels_ == c))
               for c, number in enumerate(fitted.condensed_tree_._select_clusters()))


@pytest.mark.parametrize("seed", range(60))
def test_random_calls(seed):
    rng = np.random.default_rng(seed)
    X, options = cloud(rng), choice_of(rng)
    a, b = both(X, **options)
    order = matched(a.labels_, b.labels_)
    assert len(order) == a.labels_.max() + 1 and np.array_equal(a.labels_ < 0, b.labels_ < 0)
    assert np.allclose(a.probabilities_, b.probabilities_)
    assert np.allclose(a.outlier_scores_, b.outlier_scores_)
    # hdbscan gives clusters that `cluster_selection_epsilon` or the root replace other stabilities.
    has_root = any(c == len(X) for c in a.condensed_tree_._select_clusters())
    if not has_root and "cluster_selection_epsilon" not in options:
        assert np.allclose(a.cluster_persistence_[order], b.cluster_persistence_)
    assert a.relative_validity_ == pytest.approx(b.relative_validity_, nan_ok=True)
    if knows_its_clusters(b):
        for c, other in enumerate(b.exemplars_):
            assert {tuple(x) for x in a.exemplars_[order[c]]} == {tuple(x) for x in other}
    for radius in rng.uniform(0.05, 2, 4):
        size = int(rng.integers(1, 9))
        labels = a.dbscan_clustering(radius, size)
        other = b.dbscan_clustering(radius, size)
        assert len(matched(labels, other)) == labels.max() + 1
        assert np.array_equal(labels < 0, other < 0)
    for c, place in enumerate(order):
        assert np.allclose(a.weighted_cluster_centroid(place), b.weighted_cluster_centroid(c))
        if options.get("metric") != "infinity":  # of which hdbscan knows no medoids
            rows, weights = X[b.labels_ == c], b.probabilities_[b.labels_ == c]
            sums = [(spatial.cdist([one], rows, METRICS[options.get("metric")]) * weights).sum()
                    for one in (a.weighted_cluster_medoid(place), b.weighted_cluster_medoid(c))]
            assert sums[0] == pytest.approx(sums[1])


@pytest.mark.parametrize("seed", range(20))
def test_trees(seed):
    rng = np.random.default_rng(seed)
    X = cloud(rng)
    a, b = both(X, min_samples=1, min_cluster_size=int(rng.integers(2, 9)))
    one, other = a.condensed_tree_.to_numpy(), b.condensed_tree_.to_numpy()
    assert one.dtype == other.dtype and len(one) == len(other)
    assert one["parent"].min() == other["parent"].min() == len(X)
    for name in ("lambda_val", "child_size"):
        assert np.allclose(np.sort(one[name]), np.sort(other[name]))
    first, second = (dict(clusters_of(tree, len(X)).values()) for tree in (one, other))
    assert first.keys() == second.keys()
    assert all(first[points] == pytest.approx(second[points]) for points in first)
    one, other = a.single_linkage_tree_.to_numpy(), b.single_linkage_tree_.to_numpy()
    assert one.shape == other.shape and hierarchy.is_valid_linkage(one)
    assert np.allclose(hierarchy.cophenet(one), hierarchy.cophenet(other))
    edges = [{(*sorted((int(u), int(v))), round(d, 9)) for u, v, d in tree.to_numpy()}
             for tree in (a.minimum_spanning_tree_, b.minimum_spanning_tree_)]
    assert edges[0] == edges[1]


@pytest.mark.parametrize("seed", range(10))
def test_tables_and_graphs(seed):
    pandas = pytest.importorskip("pandas", reason="pandas is missing")
    rng = np.random.default_rng(seed)
    X = cloud(rng)
    a, b = both(X, min_samples=1, min_cluster_size=4)
    for name in ("condensed_tree_", "single_linkage_tree_", "minimum_spanning_tree_"):
        one, other = (getattr(fitted, name).to_pandas() for fitted in (a, b))
        assert isinstance(one, pandas.DataFrame) and one.shape == other.shape
        assert list(one.columns) == list(other.columns) and (one.dtypes == other.dtypes).all()
    data, other = (fitted.condensed_tree_.get_plot_data() for fitted in (a, b))
    assert data.keys() == other.keys()
    assert np.allclose(sorted(np.subtract(b[1], b[0]) for b in data["cluster_bounds"].values()),
                       sorted(np.subtract(b[1], b[0]) for b in other["cluster_bounds"].values()))
    for end in (2, 3):
        assert np.allclose(sorted(b[end] for b in data["cluster_bounds"].values()),
                           sorted(b[end] for b in other["cluster_bounds"].values()))


@pytest.mark.parametrize("seed", range(20))
def test_functions(seed):
    rng = np.random.default_rng(seed)
    X = cloud(rng)
    wants = bool(seed % 2)
    one = ours.hdbscan(X, 5, 1, gen_min_span_tree=wants)
    other = genuine.hdbscan(X, 5, 1, gen_min_span_tree=wants, algorithm="prims_kdtree")
    assert len(one) == len(other) and (one[5] is None) == (other[5] is None) == (not wants)
    assert len(matched(one[0], other[0])) == one[0].max() + 1
    for a, b in zip(one, other):
        assert a is b is None or a.shape == b.shape and a.dtype.kind == b.dtype.kind
    D = spatial.squareform(spatial.pdist(X))
    for data, metric, options in ((X, "euclidean", {}), (X, "cityblock", {}),
                                  (D, "precomputed", {"d": 2})):
        for raw in (False, True)[:1 if metric == "precomputed" else 2]:  # hdbscan fails there
            index, scores = ours.validity_index(data, one[0], metric, per_cluster_scores=True,
                                                mst_raw_dist=raw, **options)
            expected, by_cluster = genuine.validity_index(
                data, one[0], metric, per_cluster_scores=True, mst_raw_dist=raw, **options)
            assert index == pytest.approx(expected, nan_ok=True)
            assert np.allclose(scores, by_cluster, equal_nan=True)


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("method", ["eom", "leaf"])
def test_memberships_of_fitted_rows(seed, method):
    rng = np.random.default_rng(seed)
    X = cloud(rng)
    a, b = both(X, min_samples=1, min_cluster_size=5, cluster_selection_method=method)
    found, expected = map(lambda f, m: m.all_points_membership_vectors(f), (a, b), (ours, genuine))
    if not len(matched(a.labels_, b.labels_)):
        assert found.shape == expected.shape == (len(X),)
        return
    if not knows_its_clusters(b):
        return
    found = found[:, matched(a.labels_, b.labels_)]
    is_in = a.labels_ >= 0  # elsewhere the sums in hdbscan depend on the numbers of clusters
    assert is_in.sum() > len(X) / 3
    assert np.allclose(found[is_in], expected[is_in], rtol=1e-5, atol=1e-9)
    shares = found / found.sum(axis=1, keepdims=True)
    assert np.allclose(shares, expected / expected.sum(axis=1, keepdims=True), rtol=1e-5, atol=1e-9)


@pytest.mark.parametrize("seed", range(20))
def test_new_rows(seed):
    """hdbscan predicts with core distances of one neighbour fewer than it fits with. With the right
    ones, the two agree on rows that join a row before it leaves its cluster."""
    rng = np.random.default_rng(seed)
    X = cloud(rng)
    k = 1
    a, b = both(X, min_samples=k, min_cluster_size=6)
    order = matched(a.labels_, b.labels_)
    if not knows_its_clusters(b) or not order:
        return
    b.prediction_data_.core_distances = np.sort(spatial.cdist(X, X))[:, k]
    new = X[rng.integers(0, len(X), 80)] + rng.normal(0, 0.1, (80, 2))
    labels, probabilities, joined = ours.approximate_predict(a, new, return_connecting_points=True)
    expected, strengths, neighbours = genuine.approximate_predict(
        b, new, return_connecting_points=True)
    assert labels.shape == expected.shape and joined.shape == neighbours.shape
    reach = np.maximum(spatial.cdist(new, X), np.maximum(
        np.sort(spatial.cdist(new, X))[:, k][:, None], b.prediction_data_.core_distances))
    assert np.allclose(reach[np.arange(80), joined], reach.min(axis=1))
    # Of several rows that are reached first, the two may take different ones.
    same = joined == neighbours
    assert same.sum() > 15
    number = np.append(order, -1)
    assert np.array_equal(labels[same], number[expected[same]])
    within = same & (reach.min(axis=1) <= a._fit.tree.leaves_at[joined])
    found = ours.membership_vector(a, new)[:, order]
    theirs = genuine.membership_vector(b, new)
    assert found.shape == theirs.shape
    steady = within & (labels >= 0)
    assert steady.sum() > 5
    assert np.allclose(found[steady], theirs[steady], rtol=1e-3, atol=1e-5)


@pytest.mark.parametrize("k", [3, 8])
def test_with_ties_the_clusters_are_similar(k):
    from sklearn.metrics import adjusted_rand_score
    scores = []
    for seed in range(20):
        X = cloud(np.random.default_rng(seed))
        a, b = both(X, min_samples=k, min_cluster_size=8)
        scores.append(adjusted_rand_score(a.labels_, b.labels_))
        assert np.allclose(a.single_linkage_tree_.to_numpy()[:, 2],
                           b.single_linkage_tree_.to_numpy()[:, 2])
    assert np.mean(scores) > 0.95


@pytest.mark.parametrize("options", [
    {"metric": "haversine"}, {"metric": "canberra"}, {"metric": "braycurtis"},
    {"metric": "minkowski", "p": 3}, {"metric": "precomputed"},
    {"metric": "mahalanobis", "V": np.array([[2.0, 0.3], [0.3, 1.0]])},
    {"metric": lambda x, y: float(np.abs(x - y).max())}], ids=str)
def test_metrics(options):
    rng = np.random.default_rng(0)
    X = np.abs(cloud(rng)) / 9
    data = spatial.squareform(spatial.pdist(X)) if options["metric"] == "precomputed" else X
    # The search trees of hdbscan ignore `p`.
    how = {"algorithm": "generic" if "p" in options or options["metric"] == "precomputed"
           or callable(options["metric"]) else "prims_balltree"}
    a = ours.HDBSCAN(4, 1, **options).fit(data)
    b = genuine.HDBSCAN(4, 1, **how, **options).fit(data)
    assert len(matched(a.labels_, b.labels_)) == a.labels_.max() + 1 > 1
    assert np.allclose(a.probabilities_, b.probabilities_)
    assert np.allclose(a.single_linkage_tree_.to_numpy()[:, 2],
                       b.single_linkage_tree_.to_numpy()[:, 2])


def test_rows_that_are_not_finite():
    X = cloud(np.random.default_rng(3))
    X = np.insert(X, [0, 4], [[np.nan, 1], [np.inf, 0]], axis=0)
    a, b = both(X, min_samples=1, prediction_data=False)
    assert len(matched(a.labels_, b.labels_)) == a.labels_.max() + 1 > 0
    assert np.allclose(a.probabilities_, b.probabilities_)
    assert np.allclose(np.sort(a.condensed_tree_.to_numpy()["lambda_val"]),
                       np.sort(b.condensed_tree_.to_numpy()["lambda_val"]))
    one, other = (f.single_linkage_tree_.to_numpy() for f in (a, b))
    assert one.shape == other.shape and np.allclose(one[:, 2:], other[:, 2:])


def test_small_tables_and_large_numbers():
    X = cloud(np.random.default_rng(5))
    for k in (len(X) - 1, len(X), 10 * len(X)):
        a, b = both(X, min_samples=k, min_cluster_size=5, prediction_data=False)
        assert np.allclose(a.single_linkage_tree_.to_numpy()[:, 2],
                           b.single_linkage_tree_.to_numpy()[:, 2])
    a, b = both(X, min_samples=1, min_cluster_size=len(X) + 1, prediction_data=False)
    assert (a.labels_ == -1).all() and (b.labels_ == -1).all()


def test_robust_single_linkage():
    rng = np.random.default_rng(1)
    X = cloud(rng)
    a = ours.RobustSingleLinkage(cut=0.5, k=1, alpha=1.2, gamma=4).fit(X)
    D = spatial.squareform(spatial.pdist(X))
    labels = genuine.HDBSCAN(2, 1, alpha=1.2, metric="precomputed", algorithm="generic").fit(
        D).single_linkage_tree_.get_clusters(0.5, 4)
    assert len(matched(a.labels_, labels)) == a.labels_.max() + 1 > 0
