# SPDX-License-Identifier: MIT
"""Tests the drop-in for a part of GUDHI: distances between diagrams, edge collapse, and the classes
for scikit-learn."""
import numpy as np
import pytest
import scipy.sparse as sparse
from scipy.spatial.distance import pdist, squareform

import libph as ph
from libph.compat import gudhi
from libph.compat.gudhi import wasserstein
from libph.compat.gudhi.flag_filtration.edge_collapse import reduce_graph
from reference import INF, Flag, random_distances, same, sorted_rows


def test_bottleneck():
    a = np.array([[2.7, 3.7], [9.6, 14.0], [34.2, 34.974], [3.0, INF]])
    b = [(2.8, 4.45), (9.5, 14.1), (3.2, INF)]
    for function in (gudhi.bottleneck_distance, gudhi.hera.bottleneck_distance):
        assert function(a, b) == 0.75 == function(a - 100, np.array(b) - 100, 0.1)
        assert function([], []) == 0
        for wrong, error in (([[], []], TypeError), ([[1.0], [2.0]], TypeError),
                             ([[1.0], [2.0, 3.0]], ValueError), (np.zeros((2, 3)), TypeError)):
            with pytest.raises(error):
                function(wrong, [])


def test_bottleneck_of_gudhi(gudhi_itself, rng):
    for _ in range(20):
        a, b = (np.sort(rng.random((int(rng.integers(0, 8)), 2)), axis=1) for _ in range(2))
        assert np.isclose(gudhi.bottleneck_distance(a, b), gudhi_itself.bottleneck_distance(a, b))


def test_wasserstein():
    a, b = np.array([[2.7, 3.7], [9.6, 14.0], [34.2, 34.974]]), [(2.8, 4.45), (9.5, 14.1)]
    assert np.isclose(gudhi.hera.wasserstein_distance(a, b), 0.75 + 0.1 + 0.387)
    assert np.isclose(gudhi.hera.wasserstein_distance(a, b, 2, 2),
                      np.sqrt(0.1**2 + 0.75**2 + 2 * 0.1**2 + 0.774**2 / 2))
    distance, pairs = wasserstein.wasserstein_distance(a, b, matching=True)
    assert distance == wasserstein.wasserstein_distance(a, b) == ph.wasserstein(a, b)
    assert pairs.tolist() == [[0, 0], [1, 1], [2, -1]]
    for other, rows in ((b, pairs), ([], [[0, -1], [1, -1], [2, -1]])):
        distance, found = gudhi.hera.wasserstein_distance(a, other, matching=True)
        assert distance == gudhi.hera.wasserstein_distance(a, other, 1, INF, 0.1, False)
        assert found.dtype == np.int32 and np.array_equal(found, rows)
    more = np.vstack([[[1.0, INF]], a])
    assert gudhi.hera.wasserstein_distance(more, b, matching=True) == (INF, None)
    assert wasserstein.wasserstein_distance(more, b, matching=True) == (INF, None)
    distance, pairs = wasserstein.wasserstein_distance(more, b, matching=True,
                                                       keep_essential_parts=False)
    assert np.isclose(distance, 1.237) and pairs.tolist() == [[1, 0], [2, 1], [3, -1]]
    with pytest.raises(TypeError):
        gudhi.hera.wasserstein_distance(np.zeros((2, 3)), [])


def test_wasserstein_of_gudhi(gudhi_itself, rng):
    hera = pytest.importorskip("gudhi.hera", reason="GUDHI is not installed")
    for _ in range(20):
        a, b = (np.sort(rng.random((int(rng.integers(0, 8)), 2)), axis=1) for _ in range(2))
        assert np.isclose(gudhi.hera.wasserstein_distance(a, b, 2, 2),
                          hera.wasserstein_distance(a, b, 2, 2, 1e-9))


def test_reduce_graph(rng):
    distances = random_distances(rng, 9, True) - 2  # including negative values
    i, j = np.tril_indices(9, -1)
    for dtype in (np.float64, np.float32):
        given = sparse.coo_matrix((distances[i, j].astype(dtype), (i, j)), shape=(9, 9))
        found = reduce_graph(given)
        assert found.dtype == dtype and found.shape == (9, 9) and 0 < found.nnz < given.nnz
        births = np.full(9, -2.0)
        fewer = np.full((9, 9), INF)
        fewer[found.row, found.col] = fewer[found.col, found.row] = found.data
        assert same(Flag(fewer, births).bars(2), Flag(distances, births).bars(2))
    assert reduce_graph(given, 0).nnz == given.nnz
    assert reduce_graph(sparse.coo_matrix((3, 3))).shape == (3, 3)


@pytest.mark.parametrize("edges, words", [
    (([np.nan], ([0], [1])), "row 0, column 1: found nan, expected a number"),
    (([1.0, 2.0], ([0, 1], [1, 0])), "mirror image: found 1.0 and 2.0, expected equal values"),
    (([3.0, 1.0], ([2, 0], [2, 1])), "row 2, column 2: found 3.0, expected none on the diagonal")])
def test_edges_that_are_refused(edges, words):
    with pytest.raises(ph.DataError, match=f"input_edges: .*{words}"):
        reduce_graph(sparse.coo_matrix(edges, shape=(3, 3)))


def test_classes_for_scikit_learn(rng):
    sklearn = pytest.importorskip("sklearn", reason="scikit-learn is not installed")
    from libph.compat.gudhi.sklearn import CubicalPersistence, RipsPersistence
    for kind in (RipsPersistence, CubicalPersistence):
        with pytest.raises(ph.UsageError, match="homology_dimensions: found .., expected a"):
            kind([]).fit([])
    clouds = [rng.random((n, 2)) for n in (20, 30)]
    expected = [ph.rips(cloud, field=11) for cloud in clouds]
    squares = [squareform(pdist(cloud)) for cloud in clouds]
    for kind, data in (("point cloud", clouds), ("full distance matrix", squares),
                       ("lower distance matrix", [np.tril(s) for s in squares]),
                       ("lower distance matrix", [[row[:i] for i, row in enumerate(s)]
                                                  for s in squares]),
                       ("distance coo_matrix", [sparse.coo_matrix(np.tril(s)) for s in squares])):
        found = RipsPersistence([0, 1], input_type=kind, n_jobs=2).fit_transform(data)
        assert len(found) == 2
        for dgms, bars in zip(found, expected):
            for dim in (0, 1):
                assert np.allclose(sorted_rows(dgms[dim]), bars.dgm(dim))
        single = RipsPersistence(1, input_type=kind, num_collapses=1).fit(data).transform(data)
        assert [np.allclose(a, b[1]) for a, b in zip(single, found)] == [True, True]
    circle = np.exp(2j * np.pi * np.arange(20) / 20)
    circles = np.concatenate([0.3 * circle, circle + 9]).view(float).reshape(-1, 2)
    h0, h1 = RipsPersistence([0, 1], threshold=0.9).fit([circles], Y=None).transform(
        [circles], Y=None)[0]
    assert np.isinf(h1[:, 1]).tolist() == [True, False] and h1[0, 0] > h1[1, 0]
    assert (h0[:-1, 1] <= h0[1:, 1]).all()
    short = RipsPersistence(0, threshold=0.1).fit_transform(clouds)[0]
    assert np.isinf(short[:, 1]).sum() > 1
    images = [rng.integers(0, 5, (6, 6)), rng.random((5, 4)).astype(np.float32)]
    for kind, construction in (("vertices", "vertices"), ("top_dimensional_cells", "cells")):
        estimator = CubicalPersistence([0, 1], input_type=kind, min_persistence=0.1)
        found = estimator.fit_transform(images)
        assert [dgms[0].dtype for dgms in found] == [np.float64, np.float64]
        for dgms, image in zip(found, images):
            bars = ph.cubical(image, construction=construction, field=11, min_persistence=0.1)
            assert all((d[:-1, 1] <= d[1:, 1]).all() for d in dgms)
            assert same(dgms, [bars.dgm(0), bars.dgm(1)])
    for estimator in (RipsPersistence(), CubicalPersistence(2)):
        assert sklearn.base.clone(estimator).get_params() == estimator.get_params()
    assert RipsPersistence([0, 2]).get_feature_names_out() == ["H0", "H2"]
    with pytest.raises(ValueError, match="input_type"):
        RipsPersistence(0, input_type="nothing").fit_transform(clouds)
    with pytest.raises(ValueError, match="homology_dimensions"):
        RipsPersistence([[0]]).fit(clouds)
