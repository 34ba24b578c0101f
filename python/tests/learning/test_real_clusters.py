# SPDX-License-Identifier: MIT
"""Stability and significance of clusters, compared with their definitions and with simulations."""
import threading

import numpy as np
import pytest
import scipy.sparse
import scipy.spatial.distance as spatial
from samples import blobs

import libph as ph
from libph import _run
from libph.sklearn import HDBSCAN


def members(labels, rows):
    """The clusters as sets of rows."""
    return [set(rows[labels == c]) for c in range(labels.max() + 1)]


def separations(tree):
    """The separation of each cluster of a tree, from the definition."""
    table = tree.clusters
    prominence = table["top"] / table["least"]
    found = []
    for c in range(len(table)):
        largest = 1.0
        while table["parent"][c] >= 0:
            others = [d for d in np.flatnonzero(table["parent"] == table["parent"][c]) if d != c]
            strongest = prominence[others].max()
            largest = max(largest, min(prominence[c], strongest))
            if prominence[c] < strongest:
                break
            c = table["parent"][c]
        found.append(largest)
    return np.array(found)


def smallest_p(X, **options):
    """The least p of all clusters; 1 if there are none."""
    return HDBSCAN(8).fit(X).significance(**options).p.min(initial=1.0)


# ---- stability


@pytest.mark.parametrize("seed", range(8))
def test_similarities_are_those_of_the_definition(seed):
    X = blobs(np.random.default_rng(seed))
    largest, largest_of_sample = (30, 18) if seed % 2 else (None, None)
    found = HDBSCAN(6, 4, max_cluster_size=largest).fit(X)
    rows = np.sort(np.random.default_rng([seed, 0]).choice(90, 54, replace=False))
    of_sample = HDBSCAN(4, 3, max_cluster_size=largest_of_sample)  # k is 3 * 0.6, about 2
    of_sample = members(of_sample.fit(X[rows]).labels_, rows)
    expected = [max((len(a & b) / len(a | b) for b in of_sample), default=0)
                for a in ({*c} & {*rows} for c in members(found.labels_, np.arange(90)))]
    one = found.stability(1, fraction=0.6, seed=seed)
    assert np.allclose(one.jaccard, expected, rtol=1e-15)
    assert np.allclose(one.quartiles, [expected] * 3, rtol=1e-15)
    assert np.array_equal(one.dissolved, np.less_equal(expected, 0.5))
    assert np.array_equal(one.recovered, np.greater(expected, 0.75))


def test_real_clusters_are_stable_and_others_are_not(rng):
    X = np.vstack([rng.normal((x, 0), 0.2, (50, 2)) for x in (0, 2)])
    real = HDBSCAN(8).fit(X).stability()
    assert real.jaccard.shape == (2,) and (real.jaccard > 0.85).all()
    noise = [HDBSCAN(8).fit(rng.uniform(size=(200, 2))).stability(20) for _ in range(10)]
    assert np.concatenate([part.jaccard for part in noise]).mean() < 0.6
    for part in (real, *noise):
        assert (part.recovered + part.dissolved <= 100).all()
        assert (np.diff(part.quartiles, axis=0) >= 0).all()


def test_stability_of_other_inputs(rng):
    X = blobs(rng)
    expected = HDBSCAN(6).fit(X).stability(20)
    D = spatial.squareform(spatial.pdist(X))
    more = np.insert(X, 5, [[np.nan, 1], [np.inf, 1]], axis=0)
    for data, options in ((X, {"n_jobs": 2}), (D, {"metric": "precomputed"}), (more, {}),
                          (scipy.sparse.csr_matrix(D), {"metric": "precomputed"})):
        found = HDBSCAN(6, **options).fit(data).stability(20)
        assert all(np.allclose(a, b, rtol=1e-12) for a, b in zip(found, expected))
    assert not np.array_equal(HDBSCAN(6).fit(X).stability(20, seed=1).jaccard, expected.jaccard)
    assert "jaccard=array" in repr(expected)


def test_without_clusters(rng):
    found = HDBSCAN(30).fit(rng.normal(size=(40, 2)))
    assert found.labels_.max() == -1
    stability = found.stability(3)
    assert stability.jaccard.shape == (0,) and stability.quartiles.shape == (3, 0)
    assert found.significance(3).p.shape == (0,)
    whole = HDBSCAN(30, allow_single_cluster=True).fit(rng.normal(size=(40, 2)))
    assert [part.tolist() for part in whole.significance(9)] == [[1.0], [1.0]]


def test_a_cluster_that_is_never_drawn():
    X = [[0.0], [0.1], *[[5 + x / 10] for x in range(38)]]
    found = HDBSCAN(2, 1).fit(X)
    stability = found.stability(1, fraction=0.1, seed=0)
    assert 0 not in found.labels_[np.random.default_rng([0, 0]).choice(40, 4, replace=False)]
    assert np.isnan(stability.jaccard[0]) and np.isnan(stability.quartiles[:, 0]).all()
    assert stability.dissolved[0] == stability.recovered[0] == 0


# ---- significance


@pytest.mark.parametrize("seed", range(10))
def test_p_is_the_rank_among_noise(seed):
    """Coordinates on a grid give clusters that separate into more than two."""
    rng = np.random.default_rng(seed)
    X = rng.normal(size=(60, 2)) if seed < 5 else rng.permutation(100)[:60, None] // [10, 1] % 10
    found = HDBSCAN(4, 3, cluster_selection_method="leaf").fit(X)
    order = rng.permutation(60)
    result = found.significance(19, null="normal", seed=seed)
    assert np.allclose(result.separation, separations(found.cluster_tree_)[found._chosen])
    other = HDBSCAN(4, 3, cluster_selection_method="leaf").fit(4.0 * X[order])
    assert np.allclose(sorted(other.significance(1).separation), sorted(result.separation))
    _, spread, axes = np.linalg.svd(X - X.mean(axis=0), full_matrices=False)
    noise = [X.mean(axis=0) + np.random.default_rng([seed, i]).normal(size=(60, 2)) * spread
             / np.sqrt(59) @ axes for i in range(19)]
    largest = np.array([separations(HDBSCAN(4, 3).fit(Y).cluster_tree_).max() for Y in noise])
    expected = [(1 + np.sum(largest >= s)) / 20 for s in result.separation]
    assert np.allclose(result.p, expected)


@pytest.mark.parametrize("kind", ["normal", "uniform"])
def test_p_of_noise_is_valid(kind):
    """In 80 clouds, at most 8 have p of at most 0.05 with a probability of 98 %, if p is exact."""
    clouds = (getattr(np.random.default_rng(i), kind)(size=(100, 2)) for i in range(80))
    p = np.array([smallest_p(X, samples=39, seed=i) for i, X in enumerate(clouds)])
    assert np.sum(p <= 0.05) <= 8
    assert np.sum(p <= 0.5) <= 50


def test_p_of_separated_groups_is_small(rng):
    for _ in range(5):
        X = np.vstack([rng.normal(c, 0.5, (40, 3)) for c in (0, 3)])
        both = HDBSCAN(8).fit(X).significance(39)
        assert both.p.tolist() == [1 / 40, 1 / 40]
    # A loose and a dense group are as significant as two of the same density.
    X = np.vstack([rng.normal(0, 0.1, (40, 2)), rng.normal(20, 3, (40, 2))])
    assert smallest_p(X, samples=39) == HDBSCAN(8).fit(X).significance(39).p.max() == 1 / 40


def test_both_is_the_larger_p(rng):
    found = HDBSCAN(6).fit(blobs(rng))
    parts = [found.significance(19, null=null).p for null in ("normal", "uniform")]
    both = found.significance(19)
    assert np.array_equal(both.p, found.significance(19, threads=2).p)
    assert (both.p >= parts[0]).all()  # the same samples


# ---- options


@pytest.mark.parametrize("method", ["stability", "significance"])
def test_both_can_be_stopped_and_watched(rng, method):
    found = HDBSCAN(6).fit(blobs(rng))
    call = getattr(found, method)
    seen = []
    call(7, progress=lambda stage, done, total: seen.append((done, total)))
    total = 7 if method == "stability" else 14
    assert seen == [(i, total) for i in range(total + 1)]
    for options, error in (({"timeout": 0.05}, ph.Timeout), ({"stop": threading.Event()},
                                                             ph.Cancelled)):
        if "stop" in options:
            options["progress"] = lambda *_: options["stop"].set()
        with pytest.raises(error):
            call(10**6, **options)
        assert _run._DEFAULTS.get() == {}
    with ph.limits(timeout=0.05), pytest.raises(ph.Timeout):
        call(10**6)
    with pytest.raises(TypeError, match="did you mean 'threads'"):
        call(thread=1)
    with pytest.raises(Exception, match="not fitted"):
        getattr(HDBSCAN(), method)()


def test_bad_options_are_refused(rng):
    X = blobs(rng)
    found = HDBSCAN(6).fit(X)
    for method, options, text in (
            ("stability", {"resamples": 0}, "resamples: found 0"),
            ("stability", {"fraction": 1}, "fraction: found 1"),
            ("stability", {"fraction": 0.01}, "90 rows have at least 2"),
            ("stability", {"seed": -1}, "seed"), ("significance", {"seed": -1}, "seed"),
            ("significance", {"samples": 0}, "samples: found 0"),
            ("significance", {"null": "gauss"}, "null: found 'gauss'")):
        with pytest.raises(ph.UsageError, match=text):
            getattr(found, method)(**options)
    of_distances = HDBSCAN(6, metric="precomputed").fit(spatial.squareform(spatial.pdist(X)))
    with pytest.raises(ph.UsageError, match="expected points"):
        of_distances.significance()
    copies = HDBSCAN(6).fit(np.repeat(X, 6, axis=0))
    with pytest.raises(ph.DataError, match="copies of a point"):
        copies.significance()
