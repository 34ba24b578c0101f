# SPDX-License-Identifier: MIT
"""Tests what the drop-in for giotto-ph promises. giotto-ph itself is not needed."""
import itertools

import numpy as np
import pytest
import scipy.sparse as sparse
from scipy.spatial.distance import pdist, squareform

import libph as ph
from libph.compat import _flag
from libph.compat.gph import modules, ripser_parallel
from reference import INF, Flag, random_distances, same, single

SINGLE = np.float32


def of_matrix(matrix, **options):
    return ripser_parallel(matrix, metric="precomputed", **options)


# ---- diagrams


@pytest.mark.parametrize("collapse", [False, True])
@pytest.mark.parametrize("p", [2, 7])
def test_bars(rng, collapse, p):
    for trial in range(10):
        distances = random_distances(rng, 7, trial % 2 == 0) / 3
        thresh = INF if trial % 3 else float(np.median(distances))
        found = of_matrix(distances, maxdim=2, coeff=p, thresh=thresh, collapse_edges=collapse)
        assert set(found) == {"dgms"} and [d.dtype for d in found["dgms"]] == [SINGLE] * 3
        joined = np.where(distances <= thresh, distances, INF)
        assert same(found["dgms"], Flag(single(joined)).bars(2, p))
        exact = of_matrix(distances, maxdim=2, coeff=p, thresh=thresh, dtype=np.float64)
        assert exact["dgms"][1].dtype == np.float64
        assert same(exact["dgms"], Flag(distances, limit=thresh).bars(2, p))


def test_the_threshold_is_of_single_precision_where_distances_are():
    pair = np.array([[0, 0.1], [0.1, 0]])
    near = pair * (1 + 1e-12)
    for matrix, joins in ((pair, True), (near, False), (pair.astype(SINGLE), True),
                          (sparse.csr_matrix(pair.astype(SINGLE)), True),
                          (sparse.csr_matrix(near), True), (pair + pair, False)):
        found = of_matrix(matrix, thresh=0.1)["dgms"][0]
        assert found[:, 1].tolist() == [SINGLE(0.1) if joins else INF, INF]
        assert np.array_equal(of_matrix(matrix, thresh=0.1, collapse_edges=True)["dgms"][0],
                              found) == (joins or matrix is not near)
    assert np.isfinite(ripser_parallel(pair[:1].T.astype(SINGLE), thresh=0.1)["dgms"][0][0, 1])
    assert np.isinf(of_matrix(pair.astype(SINGLE), thresh=0.1, dtype=float)["dgms"][0][0, 1])


def test_order(rng):
    distances = squareform(pdist(rng.random((70, 3))))
    for thresh in (INF, 0.35):
        dgms = of_matrix(distances, maxdim=1, thresh=thresh)["dgms"]
        assert (np.diff(dgms[0][:, 1]) >= 0)[np.isfinite(dgms[0][1:, 1])].all()
        assert dgms[0][-1, 1] == INF
        births, deaths = dgms[1].T
        rows = list(zip(np.isfinite(deaths), births, deaths))
        assert len(rows) > 3 and rows == sorted(rows, reverse=True)
    assert np.isinf(deaths).any() and np.isfinite(deaths).any()


def test_negative_values_and_births(rng):
    for trial in range(6):
        births = rng.integers(-4, 0, 7) / 2
        distances = np.maximum(random_distances(rng, 7, trial % 2 == 0) - 2,
                               np.maximum(births[:, None], births))
        np.fill_diagonal(distances, births)
        expected = Flag(single(distances), single(births)).bars(2)
        for matrix in (distances, np.triu(distances), sparse.coo_matrix(
                (distances.ravel(), tuple(np.indices((7, 7)).reshape(2, -1))), shape=(7, 7))):
            assert same(of_matrix(matrix, maxdim=2)["dgms"], expected)


def test_of_a_dense_matrix_what_is_above_the_diagonal_counts(rng):
    distances = random_distances(rng, 8, False)
    expected = of_matrix(distances)["dgms"]
    for below in (0.0, -5.0, np.nan, rng.random((8, 8))):
        assert same(of_matrix(np.triu(distances) + np.tril(np.full((8, 8), below), -1))["dgms"],
                    expected)


def test_of_a_sparse_matrix_both_triangles_are_read_and_the_upper_one_wins(rng):
    i, j = np.triu_indices(8, 1)
    keep = rng.random(len(i)) < 0.6
    i, j = i[keep], j[keep]
    values = rng.random(len(i))
    matrix = np.full((8, 8), INF)
    matrix[i, j] = matrix[j, i] = values
    expected = Flag(single(matrix)).bars(1)
    up = sparse.coo_matrix((values, (i, j)), shape=(8, 8))
    wrong = sparse.coo_matrix((np.concatenate([values + 1, values]),
                               (np.concatenate([j, i]), np.concatenate([i, j]))), shape=(8, 8))
    for stored in (up, up.T, up.tocsr(), wrong, wrong.tocsr()):
        assert same(of_matrix(stored)["dgms"], expected)
    oblong = sparse.coo_matrix(([1.0], ([0], [3])))  # shape (1, 4): three of the points have no row
    assert of_matrix(oblong)["dgms"][0].tolist() == [[0, 1], [0, INF], [0, INF], [0, INF]]
    empty = sparse.coo_matrix((0, 0))
    assert [d.shape for d in of_matrix(empty)["dgms"]] == [(0, 2), (0, 2)]


def test_infinite_distances_never_join():
    two = np.array([[0.0, INF], [INF, 0]])
    assert of_matrix(two)["dgms"][0].tolist() == [[0, INF], [0, INF]]


def test_points(rng):
    points = rng.random((40, 2))
    distances = squareform(pdist(points))
    for thresh in (INF, 0.3):
        for dgm, other in zip(ripser_parallel(points, thresh=thresh, maxdim=2)["dgms"],
                              of_matrix(distances, thresh=thresh, maxdim=2)["dgms"]):
            assert np.allclose(dgm, other, atol=1e-6)
    taxi = ripser_parallel(points, metric="minkowski", metric_params={"p": 1})["dgms"]
    assert np.allclose(taxi[1], of_matrix(squareform(pdist(points, "cityblock")))["dgms"][1],
                       atol=1e-6)
    near = ripser_parallel(points, thresh=0.3, nearest_neighbors_params={"algorithm": "brute"},
                           n_threads=2)["dgms"]
    assert np.allclose(near[0], ripser_parallel(points, thresh=0.3, n_threads=-1)["dgms"][0],
                       atol=1e-6)
    twice = np.array([[0.0], [0.0]])
    assert ripser_parallel(twice, thresh=1.0)["dgms"][0].tolist() == [[0, INF]]


# ---- weights


@pytest.mark.parametrize("p", [1, 2, INF])
@pytest.mark.parametrize("is_sparse", [False, True])
def test_weights(rng, p, is_sparse):
    """Two balls meet at the root t of an equation, but not before the later ball is born."""
    distances, births = random_distances(rng, 7, False), 3 * rng.random(7)
    meet = np.zeros((7, 7))
    for i, j in itertools.combinations(range(7), 2):
        late = max(births[i], births[j])

        def reach(t):
            if p == INF:
                return 2 * t if t >= late else 0
            return (t**p - births[i]**p)**(1 / p) + (t**p - births[j]**p)**(1 / p)

        low, high = late, late + 10
        for _ in range(200):
            middle = (low + high) / 2
            enough = middle >= distances[i, j] if p == INF else reach(middle) >= 2 * distances[i, j]
            low, high = (low, middle) if enough else (middle, high)
        meet[i, j] = meet[j, i] = high
    data = sparse.coo_matrix(distances) if is_sparse else distances
    found = of_matrix(data, weights=births, weight_params={"p": p}, maxdim=1, dtype=float)["dgms"]
    for dgm, other in zip(found, Flag(meet, births).bars(1)):
        other = other[other[:, 1] - other[:, 0] > 1e-9]  # rounded roots may add tiny bars
        assert dgm.shape == other.shape
        assert np.allclose(dgm[np.lexsort(dgm.T[::-1])], other)


def test_of_weighted_sparse_distances_the_upper_entry_wins(rng):
    distances, births = random_distances(rng, 7, False), rng.random(7)
    upper, (i, j) = np.triu(distances), np.triu_indices(7, 1)
    both = sparse.coo_matrix((np.concatenate([distances[i, j] / 2, distances[i, j]]),
                              (np.concatenate([j, i]), np.concatenate([i, j]))), shape=(7, 7))
    expected = of_matrix(upper, weights=births)["dgms"]
    for matrix in (both, both.tocsr()):
        assert same(of_matrix(matrix, weights=births)["dgms"], expected)


@pytest.mark.parametrize("r", [1, 2, 3])
def test_distance_to_measure(rng, r):
    """A vertex is born at twice the power mean, with exponent r, of its distances to its neighbours
    and to itself."""
    distances = random_distances(rng, 9, False)
    nearest = np.sort(distances, axis=1)[:, 1:5]
    births = 2 * ((nearest**r).sum(axis=1) / 5)**(1 / r)
    params = {"n_neighbors": 4, "r": r, "p": INF}
    for data in (distances, np.triu(distances), sparse.coo_matrix(distances)):
        dgm = of_matrix(data, weights="DTM", weight_params=params, dtype=float)["dgms"][0]
        given = of_matrix(data, weights=births, weight_params={"p": INF}, dtype=float)["dgms"][0]
        assert np.allclose(dgm, given) and np.isclose(dgm[-1, 0], births.min())


# ---- generators


def test_generators_of_distinct_distances_are_the_edges_of_these_values(rng):
    seen, never = np.zeros(3, dtype=int), np.zeros(3, dtype=int)
    for births in (np.zeros(30), np.sort(rng.random(30)) / 9):
        distances = squareform(pdist(rng.normal(size=(30, 4)))) + 0.2
        np.fill_diagonal(distances, births)
        for thresh in (INF, 2.0):
            found = of_matrix(distances, maxdim=2, thresh=thresh, return_generators=True)
            seen += [len(dgm) for dgm in found["dgms"]]
            never += [np.isinf(dgm).any() for dgm in found["dgms"]]
            finite0, finite, essential0, essential = found["gens"]
            assert finite0.dtype == essential0.dtype == np.int64
            edge = {single(distances[i, j]).item(): [j, i]
                    for i, j in itertools.combinations(range(30), 2)}
            dgm = found["dgms"][0]
            dies = np.isfinite(dgm[:, 1])
            assert finite0.shape == (dies.sum(), 3) and essential0.shape == ((~dies).sum(),)
            assert finite0[:, 1:].tolist() == [edge[d] for d in dgm[dies, 1].astype(float)]
            assert np.array_equal(single(births[finite0[:, 0]]), dgm[dies, 0])
            assert np.array_equal(single(births[essential0]), dgm[~dies, 0])
            assert len({*finite0[:, 0], *essential0}) == 30
            assert len(finite) == len(essential) == 2
            for dim in (1, 2):
                dgm = found["dgms"][dim]
                dies = np.isfinite(dgm[:, 1])
                rows = [edge[b] + edge[d] for b, d in dgm[dies].astype(float)]
                assert finite[dim - 1].shape == (len(rows), 4)
                assert finite[dim - 1].tolist() == rows
                assert essential[dim - 1].shape == ((~dies).sum(), 2)
                assert essential[dim - 1].tolist() == [edge[b] for b in dgm[~dies, 0].astype(float)]
    assert seen[2] and never[1]


def test_generators_among_ties_have_the_right_values(rng):
    for trial in range(10):
        distances = random_distances(rng, 10, True)
        data = distances if trial % 2 else sparse.coo_matrix(distances)
        found = of_matrix(data, maxdim=2, return_generators=True)
        for dim, gens in enumerate(found["gens"][1], 1):
            dgm = found["dgms"][dim]
            dgm = dgm[np.isfinite(dgm[:, 1])]
            assert gens.shape == (len(dgm), 4)
            assert np.array_equal(distances[gens[:, 0], gens[:, 1]], dgm[:, 0])
            assert np.array_equal(distances[gens[:, 2], gens[:, 3]], dgm[:, 1])
            assert (gens[:, 0] > gens[:, 1]).all() and (gens[:, 2] > gens[:, 3]).all()


def test_the_youngest_edge_of_a_simplex(rng):
    distances = rng.integers(1, 4, (9, 9))
    simplices = np.array(list(itertools.combinations(range(9), 4)))
    found = _flag.youngest_edges(lambda u, v: distances[u, v], simplices)
    for simplex, edge in zip(simplices.tolist(), found.tolist()):
        pairs = [(-distances[a, b], b, a) for a, b in itertools.combinations(simplex, 2)]
        assert edge == list(min(pairs)[1:])


# ---- errors, modules


@pytest.mark.parametrize("options, error, text", [
    ({"weights": "foo"}, ValueError,
     "'foo' passed for `weights` but the only allowed string is 'DTM'"),
    ({"weights": "DTM", "weight_params": {"p": 1.2}}, NotImplementedError, "p: found 1.2"),
    ({"weights": "DTM", "weight_params": {"q": 1}}, ValueError, "found 'q'"),
    ({"weights": "DTM", "weight_params": {"n_neighbors": 9}}, ValueError, "n_neighbors"),
    ({"weights": [1, -1, 1]}, ValueError, "weights: entry 1: found -1"),
    ({"weights": [1, 1]}, ValueError, "weights: found an array of shape"),
    ({"coeff": 4}, ValueError, "4"), ({"coeff": 256}, ValueError, "256"),
    ({"n_threads": 0}, ValueError, "n_threads"), ({"thresh": np.nan}, ValueError, "thresh"),
    ({"collapse_edges": True, "return_generators": True}, NotImplementedError, "collapse_edges"),
    ({"engines": 1}, TypeError, "engines")])
def test_errors(options, error, text):
    with pytest.raises(error, match=text):
        of_matrix(np.array([[0, 1, 2], [1, 0, 1], [2, 1, 0.0]]), **options)


def test_negative_distances_exclude_weights():
    for matrix in (np.array([[0, -1], [-1, 0.0]]), sparse.coo_matrix([[0, -1], [0, 0.0]])):
        with pytest.raises(ph.DataError, match="found the distance -1.0"):
            of_matrix(matrix, weights=[1, 1])


def test_modules(rng):
    assert modules.gph_ripser.get_max_coefficient_field_supported() == 255
    distances = random_distances(rng, 12, True).astype(SINGLE)
    i, j = np.triu_indices(12, 1)
    collapse = modules.gph_collapser
    edges = collapse.flag_complex_collapse_edges_coo(i, j, distances[i, j])
    assert all(np.array_equal(a, b) for a, b in zip(
        edges, collapse.flag_complex_collapse_edges_dense(distances)))
    row, column, data = edges
    assert (row < column).all() and 0 < len(row) < len(i) and data.dtype == SINGLE
    fewer = np.full((12, 12), INF)
    fewer[row, column] = fewer[column, row] = data
    assert same(Flag(fewer).bars(2), Flag(distances.astype(float)).bars(2))
    cut = collapse.flag_complex_collapse_edges_dense(distances, 1.0)
    assert set(cut[2].tolist()) == {1.0}
    missing = distances.copy()
    missing[2, 5] = np.nan
    with pytest.raises(ph.DataError, match="dm: row 2, column 5: found nan"):
        collapse.flag_complex_collapse_edges_dense(missing)
    with pytest.raises(ph.DataError, match="data: entry 1: found nan"):
        collapse.flag_complex_collapse_edges_coo([0, 0], [1, 2], [1, np.nan])
    with pytest.raises(ph.UsageError, match="dm: found an array of shape .3,., expected a square"):
        collapse.flag_complex_collapse_edges_dense([1, 2, 3])
