# SPDX-License-Identifier: MIT
"""Compares the results of each function with known answers."""
import itertools
import pickle

import numpy as np
import pytest
import scipy.cluster.hierarchy as hierarchy
import scipy.sparse as sparse
from numpy.testing import assert_array_equal
from scipy.spatial.distance import pdist, squareform

import libph as ph

INF = np.inf
RNG = np.random.default_rng(3)


def circle(n, radius=1.0):
    angles = np.linspace(0, 2 * np.pi, n, endpoint=False)
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])


def betti_of_long_bars(bars, length):
    return np.bincount(bars.filter(min_persistence=length).dims,
                       minlength=bars.meta["max_dim"] + 1).tolist()


# ---- rips


def test_two_circles():
    points = np.vstack([circle(40), circle(40) + [5, 0]])
    assert betti_of_long_bars(ph.rips(points), 1) == [2, 2]


def test_a_torus():
    u, v = np.meshgrid(*[np.linspace(0, 2 * np.pi, 24, endpoint=False)] * 2)
    flat = np.column_stack([np.cos(u).ravel(), np.sin(u).ravel(), np.cos(v).ravel(),
                            np.sin(v).ravel()])
    assert betti_of_long_bars(ph.rips(flat, max_dim=2, threshold=1.5), 0.9) == [1, 2, 1]


def test_a_sphere_and_a_projective_plane_differ_by_field():
    """The projective plane, triangulated with six vertices, has different bars over Z/2 and Z/3."""
    triangles = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5), (0, 1, 5), (1, 2, 4), (2, 3, 5),
                 (1, 3, 4), (2, 4, 5), (1, 3, 5)]
    plane = sorted({face for t in triangles for k in (1, 2, 3)
                    for face in itertools.combinations(t, k)}, key=len)
    over = {p: [b.dim for b in ph.filtered(plane, np.zeros(len(plane)), field=p)] for p in (2, 3)}
    assert over == {2: [0, 1, 2], 3: [0]}


def test_four_points_of_a_square():
    bars = ph.rips([[0, 0], [1, 0], [1, 1], [0, 1]])
    assert list(bars) == [(0, 0, 1)] * 3 + [(0, 0, INF), (1, 1, np.sqrt(2))]
    assert bars.meta["threshold"] == np.sqrt(2)


def test_a_threshold_is_inclusive():
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert list(ph.rips(square, threshold=1)) == [(0, 0, 1)] * 3 + [(0, 0, INF), (1, 1, INF)]
    assert list(ph.rips(square, threshold=0.99)) == [(0, 0, INF)] * 4


def test_metrics():
    points = RNG.normal(size=(30, 4))
    for metric, name, options in (("euclidean", "euclidean", {}), ("l1", "cityblock", {}),
                                  ("chebyshev", "chebyshev", {}), ("cosine", "cosine", {}),
                                  ("minkowski", "minkowski", {"p": 3})):
        ours = ph.rips(points, metric=metric, minkowski_p=options.get("p", 2))
        theirs = ph.rips(pdist(points, name, **options), metric="precomputed")
        assert np.allclose(np.asarray(ours), np.asarray(theirs))
    words = RNG.integers(0, 3, size=(20, 5))
    assert ph.rips(words, metric="hamming") == ph.rips(
        np.rint(5 * pdist(words, "hamming")), metric="precomputed")


def test_weights_by_hand():
    """Two points at distance 4 are born at 1 and 3. With the default exponent, infinity, the balls
    meet at 4; with exponent 1, they meet at 4 + 2 = 6."""
    points, weights = [[0.0], [4.0]], [1.0, 3.0]
    assert ph.rips(points, weights=weights, max_dim=0).dgm(0).tolist() == [[1, INF], [3, 4]]
    assert ph.rips(points, weights=weights, weight_exponent=1, max_dim=0).dgm(0).tolist() == [
        [1, INF], [3, 6]]


def test_a_subsample_is_the_rips_complex_of_it():
    points = RNG.normal(size=(80, 3))
    chosen = np.sort(ph.farthest_points(points, 25).indices)
    assert ph.rips(points, subsample=25) == ph.rips(points[chosen])
    cells = ph.rips(points, subsample=25).birth_cells(0)
    assert set(cells[:, 0]) == set(chosen.tolist())


def test_an_approximation_keeps_its_promise():
    points = RNG.normal(size=(200, 2))
    exact, rough = ph.rips(points), ph.rips(points, approximation=0.5)
    assert rough.meta["edges"] < exact.meta["edges"] and rough.meta["approximation"] == 0.5
    for dim in (0, 1):
        a = exact.filter(dim=dim, min_persistence=0).dgm(dim)
        b = rough.filter(dim=dim).dgm(dim)
        finite = [x[np.isfinite(x).all(axis=1) & (x[:, 0] > 0)] for x in (a, b)]
        if all(map(len, finite)):
            assert ph.bottleneck(np.log(finite[0]), np.log(finite[1])) <= np.log(1.5) + 1e-12


# ---- cubical


def test_constructions():
    diagonal = [[0, 1], [1, 0]]
    assert list(ph.cubical(diagonal)) == [(0, 0, 1), (0, 0, INF)]
    assert list(ph.cubical(diagonal, construction="cells")) == [(0, 0, INF)]


def test_superlevel_and_periodic():
    assert list(ph.cubical([1, 3, 2, 5], superlevel=True)) == [(0, -5, INF), (0, -3, -2)]
    assert list(ph.cubical([1, 3, 2, 5], periodic=True)) == [(0, 1, INF), (0, 2, 3), (1, 5, INF)]


def test_a_hollow_ball():
    grid = np.mgrid[-6:7, -6:7, -6:7]
    distance = np.abs(np.sqrt((grid**2).sum(axis=0)) - 4)
    assert betti_of_long_bars(ph.cubical(distance), 2) in ([1, 0, 1], [1, 0, 1, 0])


def test_infinite_voxels_never_enter():
    assert list(ph.cubical([0.0, INF, 1.0])) == [(0, 0, INF), (0, 1, INF)]
    assert list(ph.cubical([0.0, np.nan, 1.0], nan="drop")) == [(0, 0, INF), (0, 1, INF)]
    assert list(ph.cubical([0.0, INF, 1.0], threshold=0.5)) == [(0, 0, INF)]


# ---- meshes and listed complexes


def test_lower_star():
    height = [0.0, 2.0, 1.0, 3.0]
    edges = [[0, 1], [1, 2], [2, 3], [3, 0]]
    expected = [(0, 0, INF), (0, 1, 2), (1, 3, INF)]
    for simplices in (edges, np.array(edges), np.array(edges, dtype=np.uint8), [np.array(edges)],
                      [tuple(e) for e in edges], (np.array(edges[:2]), np.array(edges[2:]))):
        assert list(ph.lower_star(height, simplices)) == expected
    mixed = [(0, 1, 2), (2, 3), (3,)]
    assert list(ph.lower_star(height, mixed)) == [(0, 0, INF)]
    assert list(ph.lower_star(height, [])) == [(0, v, INF) for v in sorted(height)]
    assert list(ph.lower_star([0, INF, 1], [[0, 1], [1, 2]])) == [(0, 0, INF), (0, 1, INF)]


def test_filtered():
    vertices, edges, triangle = [[0], [1], [2]], [[0, 1], [1, 2], [0, 2]], [[0, 1, 2]]
    expected = [(0, 0, 1), (0, 0, 2), (0, 0, INF), (1, 3, 4)]
    tuples = [tuple(s) for s in vertices + edges + triangle]
    values = [0, 0, 0, 1, 2, 3, 4]
    assert list(ph.filtered(tuples, values)) == expected
    arrays = [np.array(vertices), np.array(edges), np.array(triangle)]
    assert list(ph.filtered(arrays, values)) == expected
    assert list(ph.filtered(arrays, [np.zeros(3), np.array([1, 2, 3]), np.array([4])])) == expected
    assert list(ph.filtered([], [])) == []
    assert list(ph.filtered(tuples, values, threshold=3)) == expected[:3] + [(1, 3, INF)]


def test_boundary():
    columns = np.array([[0, 0, 0, -1, 0, -1], [0, 0, 0, 1, -1, 0], [0, 0, 0, 0, 1, 1],
                        [0] * 6, [0] * 6, [0] * 6])
    for make in (sparse.csc_matrix, sparse.csr_matrix, sparse.coo_array, sparse.lil_matrix):
        for field in (2, 3):
            bars = ph.boundary(make(columns), [0, 0, 0, 1, 1, 1], field=field)
            assert list(bars) == [(0, 0, INF), (0, 1, 3), (0, 2, 4), (1, 5, INF)]
    assert list(ph.boundary(sparse.csc_matrix(np.abs(columns)), [0, 0, 0, 1, 1, 1])) == list(bars)


# ---- results that are not barcodes


def test_point_image():
    made = ph.point_image([[0.0, 0.0], [3.0, 0.0]], 1.0, value="occupancy", margin=0)
    assert made.image.shape == (4, 1) and made.voxel == 1
    assert np.isnan(made.image[1:3]).all() and made.image[0, 0] == made.image[3, 0] == 0
    assert np.allclose(made.first, [0, 0], atol=0.5)
    assert len(ph.cubical(made).dgm(0)) == 2
    density = ph.point_image([[0.0], [0.1], [5.0]], 1.0, value="density")
    assert np.nanmin(density.image) == -2


def test_farthest_points():
    points = RNG.normal(size=(50, 2))
    distances = squareform(pdist(points))
    found = ph.farthest_points(points)
    chosen = [0]
    for k in range(1, 50):
        nearest = distances[:, chosen].min(axis=1)
        chosen.append(int(np.argmax(nearest)))
        assert np.isclose(found.radii[k], nearest.max())
    assert found.indices.tolist() == chosen and found.covering_radius == 0
    few = ph.farthest_points(points, radius=1.0)
    assert few.covering_radius <= 1 < found.radii[len(few.indices) - 1]
    assert np.array_equal(ph.farthest_points(distances, metric="precomputed").indices,
                          found.indices)
    assert ph.farthest_points(np.empty((0, 2))).indices.tolist() == []


def test_distance_to_measure():
    points = RNG.normal(size=(40, 3))
    distances = np.sort(squareform(pdist(points)), axis=1)
    for k in (1, 5, 40):
        expected = np.sqrt((distances[:, :k]**2).mean(axis=1))
        assert np.allclose(ph.distance_to_measure(points, k), expected)
        assert np.allclose(ph.distance_to_measure(pdist(points), k, metric="precomputed"), expected)
    assert ph.distance_to_measure(np.empty((0, 3)), 1).shape == (0,)


def test_collapse():
    distances = squareform(pdist(RNG.normal(size=(60, 3))))
    edges = ph.collapse(distances)
    assert isinstance(edges, sparse.coo_array) and edges.shape == (60, 60)
    assert 0 < edges.nnz < 60 * 59 / 2 and (edges.row < edges.col).all()
    before = ph.rips(distances, metric="precomputed", max_dim=3)
    assert ph.rips(edges, metric="precomputed", max_dim=3, threshold=before.meta["threshold"]) == \
        before


def test_merge_trees_are_single_linkage():
    points = RNG.normal(size=(50, 3))
    tree = ph.merge_tree(points)
    expected = hierarchy.linkage(points, "single")
    assert np.allclose(tree.linkage[:, 2], expected[:, 2])
    assert np.array_equal(tree.linkage[:, 3], expected[:, 3])
    for t in (0.3, 0.6, 1.2):
        ours = tree.components(t)
        theirs = hierarchy.fcluster(expected, t, "distance")
        assert len(set(zip(ours, theirs))) == len(set(ours)) == len(set(theirs))
    assert np.allclose(np.sort(tree.values), ph.rips(points, max_dim=0).deaths[:-1])
    assert hierarchy.is_valid_linkage(tree.linkage)


def test_basins_of_an_image():
    image = np.array([[0, 1, 5, 1, 0], [1, 1, 5, 1, 1]])
    tree = ph.merge_tree(image, complex="cubical")
    basins = tree.basins(2).reshape(tree.shape)
    assert len(set(basins.ravel())) == 2 and len(set(basins[:, 0])) == 1
    assert basins[0, 0] != basins[0, 4]
    assert len(set(tree.basins(10))) == 1
    volume = RNG.random((4, 5, 6))
    assert ph.merge_tree(volume).shape == (4, 5, 6)
    cells = ph.merge_tree(volume, construction="cells")
    assert cells.shape == (5, 6, 7) and len(cells) == 5 * 6 * 7


def test_merge_trees_can_be_pickled():
    image = np.random.default_rng(3).normal(size=(4, 5, 6))
    for tree in (ph.merge_tree(image), ph.merge_tree(image[0], complex="cubical"), ph.merge_tree(np.empty((0, 2)))):
        again = pickle.loads(pickle.dumps(tree))
        assert again == tree and hash(again) == hash(tree) and again.shape == tree.shape
        for name in ("births", "values", "edges", "elder", "younger", "linkage"):
            assert_array_equal(getattr(again, name), getattr(tree, name))
        assert_array_equal(again.components(0.1), tree.components(0.1))
        assert_array_equal(again.basins(0.5, 2), tree.basins(0.5, 2))
    restored, (births, values, ends, sizes, shape) = tree.__reduce__()
    with pytest.raises(ph.DataError, match="merge tree: found arrays of different trees"):
        restored(births, np.zeros(1), np.zeros((1, 4), dtype=np.int64), sizes, shape)


def test_equal_merge_trees():
    image = np.array([[0.0, 3, 1], [2, 5, 4]])
    tree = ph.merge_tree(image, complex="cubical")
    assert tree == ph.merge_tree(image.copy(), complex="cubical")
    assert {tree: 1}[ph.merge_tree(image, complex="cubical")] == 1
    # Shapes, births, values and ends of merges make a difference.
    assert tree != ph.merge_tree(image.reshape(3, 2), complex="cubical")
    higher = np.where(image == 5, 6, image)
    assert tree != ph.merge_tree(higher, complex="cubical")
    assert ph.merge_tree([[0], [1], [3]]) != ph.merge_tree([[0], [1], [4]])
    assert ph.merge_tree([[0], [1], [3]]) != ph.merge_tree([[1], [0], [3]])
    assert tree != 1 and (tree == "tree") is False


def test_merge_tree_of_equal_points():
    assert ph.merge_tree([[0.0], [0.0], [1.0]]).linkage.tolist() == [[0, 1, 0, 2], [2, 3, 1, 3]]


def test_estimate():
    points = RNG.normal(size=(300, 3))
    found = ph.estimate(points, max_dim=2)
    assert found.engine == ph.rips(points, max_dim=2).meta["engine"] and found.max_dim == 2
    assert 0 < found.bytes_low <= found.bytes_high and found.reason
    assert found.cells[0] == 300
    assert ph.estimate(np.zeros((30, 30, 30))).engine == "gradient"
    assert ph.estimate(np.zeros((30, 30)), complex="cubical").engine == "gradient"
    assert ph.estimate(ph.point_image(points, 0.5)).engine == "gradient"
    assert ph.estimate(sparse.eye(4) * 0, metric="precomputed").cells[0] == 4


def test_bottleneck():
    assert ph.bottleneck([[0, 1.5]], [[0, 1.25]]) == 0.25
    assert ph.bottleneck([], [[0, 1]]) == 0.5 and ph.bottleneck([], []) == 0
    assert ph.bottleneck([[0, INF]], [[0, 1]]) == INF
    assert ph.bottleneck([[0, INF]], [[0.5, INF]]) == 0.5
    a, b = ph.rips(circle(30)), ph.rips(circle(30, 1.1))
    both = ph.bottleneck(a, b)
    assert set(both) == {0, 1} and both[1] == ph.bottleneck(a, b, dim=1) == ph.bottleneck(
        a.dgm(1), b.dgm(1)) == ph.bottleneck(a, b.dgm(1), dim=1)
    assert 0 < both[1] <= 0.2
    with pytest.raises(ph.UsageError, match="dim"):
        ph.bottleneck(a, b.dgm(1))
    with pytest.raises(ph.UsageError, match="dim"):
        ph.bottleneck([[0, 1]], [[0, 1]], dim=1)
