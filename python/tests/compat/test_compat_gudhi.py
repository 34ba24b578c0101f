# SPDX-License-Identifier: MIT
"""The drop-in for a part of GUDHI: compares its results with results worked out by hand, and with
GUDHI if it is installed."""
import itertools

import numpy as np
import pytest
from scipy.spatial.distance import pdist, squareform

import libph as ph
from libph.compat import gudhi
from libph.compat.gudhi import wasserstein
from reference import INF, Flag, random_distances, same, sorted_rows

SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]
DIAGONAL = float(np.sqrt(2))


def by_dim(bars):
    return sorted((dim, *bar) for dim, bar in bars)


# ---- Rips complexes


def test_a_tree():
    tree = gudhi.RipsComplex(points=SQUARE).create_simplex_tree(max_dimension=2)
    assert not tree._is_persistence_defined() and tree.num_vertices() == 4
    with pytest.raises(RuntimeError, match="compute_persistence"):
        tree.betti_numbers()
    assert tree.persistence() == [(1, (1, DIAGONAL)), (0, (0, INF))] + 3 * [(0, (0, 1))]
    assert tree.betti_numbers() == [1, 0] and tree.persistent_betti_numbers(0.5, 0.9) == [4, 0]
    assert tree.persistent_betti_numbers(1, 1.2) == [1, 1]
    assert tree.persistent_betti_numbers(1, INF) == [1, 0]  # only the bars that never die are left
    assert tree.persistence_intervals_in_dimension(0).tolist() == 3 * [[0, 1]] + [[0, INF]]
    assert tree.persistence_intervals_in_dimension(2).shape == (0, 2)
    assert tree.persistence(min_persistence=0.5) == [(0, (0, INF))] + 3 * [(0, (0, 1))]
    assert len(tree.persistence(min_persistence=-1)) > 5
    assert tree.compute_persistence() is tree and not tree.is_empty()
    other = tree.copy()
    assert not other._is_persistence_defined()
    assert other.compute_persistence(2).betti_numbers() == [1, 0]
    assert gudhi.RipsComplex().create_simplex_tree().is_empty()


def test_the_dimension_of_the_complex():
    """Bars of the highest dimension are returned only on request. They never die, because there are
    no cells of a higher dimension."""
    rips = gudhi.RipsComplex(points=SQUARE)
    for dim in (0, 1):
        tree = rips.create_simplex_tree(dim)
        assert {d for d, _ in tree.persistence()} == {0}
        assert [bar for d, bar in tree.persistence(persistence_dim_max=True) if d == 1] == [
            (1, INF), (DIAGONAL, INF), (DIAGONAL, INF)]
        assert tree.betti_numbers() == [1, 3]
    tree = rips.create_simplex_tree(3)
    assert [bar for d, bar in tree.persistence(persistence_dim_max=True) if d == 3] == []


def test_distances(rng):
    distances = random_distances(rng, 7, True)
    rows = [distances[i, :i + 1].tolist() for i in range(7)]
    for given in (distances, np.tril(distances), rows, [row[:-1] for row in rows],
                  np.asfortranarray(distances)):
        for field, limit in ((11, INF), (2, 2.0)):
            tree = gudhi.RipsComplex(distance_matrix=given, max_edge_length=limit)
            tree = tree.create_simplex_tree(3)
            tree.compute_persistence(homology_coeff_field=field)
            found = [tree.persistence_intervals_in_dimension(dim) for dim in range(3)]
            assert same(found, Flag(distances, limit=limit).bars(2, field))


def test_weights():
    """A vertex is born at twice its weight, an edge at its length plus both weights, but not before
    its vertices."""
    distances = np.array([[0, 4.0, 9], [4, 0, 2], [9, 2, 0]])
    weights = np.array([1.0, 2, 6])
    values = np.maximum(distances + weights[:, None] + weights,
                        2 * np.maximum(weights[:, None], weights))
    tree = gudhi.WeightedRipsComplex(distances, weights).create_simplex_tree(2)
    tree.compute_persistence()
    expected = Flag(values, 2 * weights).bars(0)[0]
    assert np.array_equal(sorted_rows(tree.persistence_intervals_in_dimension(0)), expected)
    assert tree.num_vertices() == 3
    late = gudhi.WeightedRipsComplex(distances, weights, max_filtration=5).create_simplex_tree(1)
    assert late.num_vertices() == 2 and late.persistence() == [(0, (2, INF)), (0, (4, INF))]


@pytest.mark.parametrize("q", [2, 3])
def test_distance_to_measure(rng, q):
    points = rng.random((12, 2))
    distances = squareform(pdist(points))
    weights = ((np.sort(distances, axis=1)[:, :4]**q).sum(axis=1) / 4)**(1 / q)
    expected = gudhi.WeightedRipsComplex(distances, weights).create_simplex_tree(2)
    for data in ({"points": points}, {"distance_matrix": distances}):
        tree = gudhi.DTMRipsComplex(**data, k=4, q=q).create_simplex_tree(2)
        for (dim, bar), (other, its) in zip(tree.persistence(), expected.persistence()):
            assert dim == other and np.allclose(bar, its)
    unweighted = gudhi.RipsComplex(points=points).create_simplex_tree(2).persistence()
    for k in (-1, 0, 1):
        plain = gudhi.DTMRipsComplex(points=points, k=k).create_simplex_tree(2)
        assert plain.persistence() == unweighted
    assert gudhi.DTMRipsComplex().create_simplex_tree(1).persistence() == []


def test_the_dimension_of_the_complex_over_fields():
    """The projective plane has a void over Z/2, but over no other field."""
    faces = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5), (0, 1, 5), (1, 2, 4), (2, 4, 5),
             (2, 3, 5), (1, 3, 5), (1, 3, 4)]
    cells = sorted({cell for face in faces for k in (1, 2, 3)
                    for cell in itertools.combinations(sorted(face), k)})
    distances = np.array([[a != b and (1 if {*a} < {*b} or {*b} < {*a} else 9) for b in cells]
                          for a in cells], dtype=np.float64)
    tree = gudhi.RipsComplex(distance_matrix=distances, max_edge_length=2).create_simplex_tree(2)
    for field, betti in ((2, [1, 1, 1]), (3, [1, 0, 0]), (11, [1, 0, 0])):
        tree.compute_persistence(field, persistence_dim_max=True)
        assert tree.betti_numbers() == betti


def test_generators_in_the_dimension_of_the_complex():
    tree = gudhi.RipsComplex(points=SQUARE).create_simplex_tree(1)
    tree.compute_persistence(persistence_dim_max=True)
    _, finite, _, essential = tree.flag_persistence_generators()
    values = [np.linalg.norm(np.subtract(*np.array(SQUARE)[edge])) for edge in essential[0]]
    assert values == tree.persistence_intervals_in_dimension(1)[:, 0].tolist()
    assert len(finite) == len(essential) == 1 and finite[0].shape == (0, 4)
    tree.compute_persistence()
    assert tree.flag_persistence_generators()[3] == []


def test_generators(rng):
    points = rng.random((25, 3))
    distances = squareform(pdist(points))
    edge = {round(distances[i, j], 12): [j, i] for i, j in itertools.combinations(range(25), 2)}
    for data in ({"points": points}, {"distance_matrix": distances}):
        tree = gudhi.RipsComplex(**data, max_edge_length=0.6).create_simplex_tree(2)
        with pytest.raises(RuntimeError):
            tree.flag_persistence_generators()
        tree.compute_persistence()
        finite0, finite, essential0, essential = tree.flag_persistence_generators()
        h0, h1 = map(tree.persistence_intervals_in_dimension, (0, 1))
        dies = np.isfinite(h0[:, 1])
        assert [row[1:] for row in finite0.tolist()] == [edge[round(d, 12)] for d in h0[dies, 1]]
        assert sorted([*finite0[:, 0], *essential0]) == list(range(25))
        dies = np.isfinite(h1[:, 1])
        assert len(finite) == len(essential) == 1 and len(h1) > 1
        assert finite[0].tolist() == [edge[round(b, 12)] + edge[round(d, 12)] for b, d in h1[dies]]
        assert essential[0].tolist() == [edge[round(b, 12)] for b in h1[~dies, 0]]


@pytest.mark.parametrize("seed", range(12))
def test_trees_of_gudhi(gudhi_itself, seed):
    rng = np.random.default_rng(seed)
    points = rng.integers(0, 4, (9, 2)).astype(float) if seed % 2 else rng.random((9, 3))
    limit = [INF, 0.7 * pdist(points).max()][seed % 3 == 0]
    data = {"points": points} if seed % 4 else {"distance_matrix": squareform(pdist(points))}
    trees = [module.RipsComplex(**data, max_edge_length=limit).create_simplex_tree(max_dimension=3)
             for module in (gudhi, gudhi_itself)]
    # The dimension of GUDHI's complex may be below 3. By default, GUDHI returns only bars of
    # dimensions below it.
    top = trees[1].dimension()
    for options in ({}, {"homology_coeff_field": 3}, {"min_persistence": 0.2},
                    {"min_persistence": -1}, {"persistence_dim_max": top == 3}):
        ours, theirs = (by_dim(tree.persistence(**options)) for tree in trees)
        ours = [bar for bar in ours if bar[0] < top + options.get("persistence_dim_max", False)]
        assert [bar[0] for bar in ours] == [bar[0] for bar in theirs]
        assert np.allclose([bar[1:] for bar in ours], [bar[1:] for bar in theirs])
    assert trees[0].num_vertices() == trees[1].num_vertices()


@pytest.mark.parametrize("seed", range(6))
def test_weighted_trees_of_gudhi(gudhi_itself, seed):
    from gudhi.dtm_rips_complex import DTMRipsComplex
    from gudhi.weighted_rips_complex import WeightedRipsComplex
    rng = np.random.default_rng(seed)
    # For some seeds, the weights of two points differ by more than the distance between these
    # points.
    points, weights = rng.random((8, 2)), [0.2, 0.6][seed // 3] * rng.random(8)
    limit = [INF, 0.9][seed % 2]
    distances = squareform(pdist(points))
    pairs = [[weighted(distances, weights, limit), dtm(points, k=3, max_filtration=limit)]
             for weighted, dtm in ((gudhi.WeightedRipsComplex, gudhi.DTMRipsComplex),
                                   (WeightedRipsComplex, DTMRipsComplex))]
    for ours, theirs in zip(*pairs):
        ours, theirs = (rips.create_simplex_tree(max_dimension=2) for rips in (ours, theirs))
        assert theirs.dimension() == 2 and ours.num_vertices() == theirs.num_vertices()
        for options in ({}, {"persistence_dim_max": True}, {"min_persistence": -1}):
            bars, others = (by_dim(tree.persistence(**options)) for tree in (ours, theirs))
            assert [bar[0] for bar in bars] == [bar[0] for bar in others]
            assert np.allclose([bar[1:] for bar in bars], [bar[1:] for bar in others])


def test_a_sparse_complex_keeps_its_promise(rng):
    points = rng.random((120, 2)) + 0.5
    exact, rough = (gudhi.RipsComplex(points=points, sparse=epsilon).create_simplex_tree(1)
                    for epsilon in (None, 0.3))
    deaths = [np.sort([death for _, (_, death) in tree.persistence() if death < INF])
              for tree in (exact, rough)]
    assert (deaths[0] <= deaths[1] + 1e-12).all()
    assert (deaths[1] <= deaths[0] / 0.7 + 1e-12).all() and (deaths[0] != deaths[1]).any()
    bars = ph.rips(points, max_dim=0, approximation=0.3 / 0.7)
    assert np.array_equal(deaths[1], bars.deaths[:-1])


def test_what_is_elsewhere():
    tree = gudhi.RipsComplex(points=SQUARE).create_simplex_tree(1)
    rough = gudhi.RipsComplex(points=SQUARE, sparse=0.5).create_simplex_tree(1)
    for call in (lambda: gudhi.AlphaComplex(points=SQUARE), gudhi.SimplexTree,
                 lambda: tree.insert([0, 1]),
                 lambda: wasserstein.wasserstein_distance([], [], enable_autodiff=True),
                 lambda: rough.persistence(persistence_dim_max=True)):
        with pytest.raises(ph.NotBuiltIn, match="GUDHI"):
            call()
    for name in ("get_filtration", "euler_characteristic", "num_simplices_by_dimension", "clear"):
        with pytest.raises(ph.NotBuiltIn, match=f"^{name}: "):
            getattr(tree, name)()
    for name in ("write_points_to_off_file", "pick_n_random_points", "sparsify_point_set"):
        with pytest.raises(ph.NotBuiltIn, match=f"^{name}: "):
            getattr(gudhi, name)(points=SQUARE)
    with pytest.raises(ph.NotBuiltIn, match="ph.farthest_points gives the indices of the points"):
        gudhi.choose_n_farthest_points(points=SQUARE, nb_points=2)
    gudhi.random.set_seed(1)
    with pytest.raises(AttributeError):
        gudhi.nothing
    with pytest.raises(AttributeError):
        tree.nothing


@pytest.mark.parametrize("options, text", [
    ({"distance_matrix": [[0, 1], [2, 0]]}, "asymmetric"),
    ({"points": SQUARE, "sparse": 1.0}, "sparse"),
    ({"distance_matrix": np.zeros((2, 3))}, "distance_matrix"),
    ({"points": SQUARE, "distance_matrix": [[0]]}, "points: cannot be combined"),
    ({"points": SQUARE, "max_edge_length": -1}, "max_edge_length: found -1")])
def test_errors(options, text):
    with pytest.raises(ph.Error, match=text):
        gudhi.RipsComplex(**options).create_simplex_tree(1).persistence()


def test_errors_name_arguments_of_gudhi():
    for call, text in (
            (lambda: gudhi.DTMRipsComplex(SQUARE, k=5), "k: found 5, expected a whole number, at most"),
            (lambda: gudhi.DTMRipsComplex([], k=1.5), "k: found 1.5"),
            (lambda: gudhi.DTMRipsComplex(SQUARE, k=2, q=0), "q: found 0"),
            (lambda: gudhi.bottleneck_distance([], [], -1), "e: found -1"),
            (lambda: wasserstein.wasserstein_distance([], [], order=INF), "order: found inf"),
            (lambda: gudhi.RipsComplex(points=SQUARE).create_simplex_tree(1).persistence(
                min_persistence="a"), "min_persistence: found 'a'")):
        with pytest.raises(ph.UsageError, match=f"^{text}"):
            call()


# ---- images


def test_images():
    cells = np.array([[INF, 0, 0], [0, 1, 0], [0, 0, 0]])
    flat = cells.ravel(order="F")
    for image in (gudhi.CubicalComplex(top_dimensional_cells=cells),
                  gudhi.CubicalComplex(top_dimensional_cells=flat, dimensions=[3, 3])):
        assert not image._is_persistence_defined() and image.dimension() == 2
        assert image.persistence() == [(1, (0, 1)), (0, (0, INF))]
        assert image.betti_numbers() == [1, 0, 0] == image.persistent_betti_numbers(0, 1)
        assert image.persistence_intervals_in_dimension(1).tolist() == [[0, 1]]
        assert image.persistence_intervals_in_dimension(5).shape == (0, 2)
        pairs, never = image.cofaces_of_persistence_pairs()
        assert [p.shape for p in pairs] == [(0, 2), (1, 2)] and pairs[1][0, 1] == 4
        assert len(never) == 1 and flat[never[0][0]] == 0 == flat[pairs[1][0, 0]]
        with pytest.raises(RuntimeError, match="made of top-dimensional cells, expected one made of vertices"):
            image.vertices_of_persistence_pairs()
    line = gudhi.CubicalComplex(top_dimensional_cells=[2, 4, 3, 5])
    line.compute_persistence()
    assert line.persistence_intervals_in_dimension(0).tolist() == [[3, 4], [2, INF]]
    oblong = gudhi.CubicalComplex(vertices=[0, 1, 2, 3, 4, 5], dimensions=[2, 3])
    assert oblong.num_simplices() == oblong.all_cells().size == 15
    assert oblong.vertices().tolist() == [[0, 2, 4], [1, 3, 5]]
    torus = gudhi.PeriodicCubicalComplex(top_dimensional_cells=np.arange(9).reshape(3, 3),
                                         periodic_dimensions=[True, True])
    assert [b for b in torus.persistence()] == [
        (2, (8, INF)), (1, (2, INF)), (1, (6, INF)), (0, (0, INF))]
    assert torus.betti_numbers() == [1, 2, 1] and torus.compute_persistence() is None
    for options in ((None, np.arange(9).reshape(3, 3), None, [True, False]),
                    ([3, 3], np.arange(9).reshape(3, 3).T.ravel(), None, [True, False])):
        cylinder = gudhi.PeriodicCubicalComplex(*options)
        assert cylinder.persistence() == [(1, (6, INF)), (0, (0, INF))]


def test_places_have_the_values(rng):
    for kind, asked in (("top_dimensional_cells", "cofaces_of_persistence_pairs"),
                        ("vertices", "vertices_of_persistence_pairs")):
        for trial in range(6):
            values = rng.random((4, 3, 5)) if trial % 2 else rng.integers(0, 4, (4, 3, 5))
            flat = np.asarray(values, dtype=float).ravel(order="F")
            periodic = [trial > 2, False, trial > 3]
            image = gudhi.PeriodicCubicalComplex(**{kind: values}, periodic_dimensions=periodic)
            image.compute_persistence()
            pairs, never = getattr(image, asked)()
            for dim in range(4):
                dgm = image.persistence_intervals_in_dimension(dim)
                dies = np.isfinite(dgm[:, 1])
                assert (dim < len(pairs)) >= dies.any() and (dim < len(never)) >= (~dies).any()
                if dim < len(pairs):
                    assert np.array_equal(flat[pairs[dim]], dgm[dies])
                if dim < len(never):
                    assert np.array_equal(flat[never[dim]], dgm[~dies, 0])


def test_all_cells(rng):
    values = rng.random((3, 4))
    for kind, periodic in itertools.product(("vertices", "top_dimensional_cells"),
                                            itertools.product((False, True), repeat=2)):
        image = gudhi.PeriodicCubicalComplex(**{kind: values}, periodic_dimensions=periodic)
        every = image.all_cells()
        of_vertices = kind == "vertices"
        assert every.shape == tuple(2 * n + (0 if closes else -1 if of_vertices else 1)
                                    for n, closes in zip(values.shape, periodic))
        assert np.array_equal(getattr(image, kind)(), values)
        for place in np.ndindex(every.shape):
            around = []
            for x, n, closes in zip(place, values.shape, periodic):
                ends = {x // 2, (x + 1) // 2} if of_vertices else {(x - 1) // 2, x // 2}
                around.append({e % n if closes else min(max(e, 0), n - 1) for e in ends})
            found = [values[p] for p in itertools.product(*around)]
            assert every[place] == (max if of_vertices else min)(found)
    image.top_dimensional_cells()[0, 0] = 42
    assert image.all_cells()[1, 1] == 42


def test_a_file_of_perseus(tmp_path):
    path = tmp_path / "image.txt"
    path.write_text("2\n3\n3\n0\n0\n0\n0\n100\n0\n0\n0\n0\n")
    image = gudhi.CubicalComplex(perseus_file=str(path))
    assert image.persistence() == [(1, (0, 100)), (0, (0, INF))]
    assert gudhi.PeriodicCubicalComplex(perseus_file=path).persistence() == image.persistence()
    with pytest.raises(RuntimeError, match="nowhere"):
        gudhi.CubicalComplex(perseus_file="nowhere")
    path.write_text("2\n-3\n3\n0\n0\n0\n0\n100\n0\n0\n0\n0\n")
    image = gudhi.PeriodicCubicalComplex(perseus_file=str(path))
    assert image.persistence() == [(1, (0, INF)), (1, (0, 100)), (0, (0, INF))]
    assert image.all_cells().shape == (6, 7)
    with pytest.raises(ValueError, match="expected a PeriodicCubicalComplex"):
        gudhi.CubicalComplex(perseus_file=path)
    with pytest.raises(ValueError, match="periodic_dimensions: found .* with perseus_file"):
        gudhi.PeriodicCubicalComplex(perseus_file=path, periodic_dimensions=[True, False])


@pytest.mark.parametrize("options", [
    {}, {"vertices": [1], "top_dimensional_cells": [1]}, {"dimensions": [1]},
    {"dimensions": [1], "perseus_file": "a"}, {"vertices": [1, 2], "dimensions": [3]}])
def test_errors_of_images(options):
    with pytest.raises(ValueError, match="expected"):
        gudhi.CubicalComplex(**options)


def test_errors_of_periodic_images():
    for periodic in (None, [True]):
        with pytest.raises(ValueError, match="periodic_dimensions"):
            gudhi.PeriodicCubicalComplex(vertices=[[1, 2]], periodic_dimensions=periodic)


@pytest.mark.parametrize("seed", range(8))
def test_images_of_gudhi(gudhi_itself, seed):
    rng = np.random.default_rng(seed)
    shape = [(9,), (4, 5), (3, 4, 4), (3, 3, 3, 2)][seed % 4]
    values = rng.random(shape) if seed % 2 else rng.integers(0, 4, shape).astype(float)
    periodic = [bool(b) for b in rng.integers(0, 2, len(shape))]
    pairs = [[module.CubicalComplex(top_dimensional_cells=values),
              module.PeriodicCubicalComplex(top_dimensional_cells=values,
                                            periodic_dimensions=periodic)]
             for module in (gudhi, gudhi_itself)]
    for ours, theirs in zip(*pairs):
        for options in ({}, {"min_persistence": 0.3}, {"homology_coeff_field": 2}):
            bars = ours.persistence(**options)
            assert by_dim(bars) == by_dim(theirs.persistence(**options))
            dims = [dim for dim, _ in bars]
            lengths = [death - birth for _, (birth, death) in bars]
            assert list(zip(dims, lengths)) == sorted(zip(dims, lengths), reverse=True)
        assert ours.betti_numbers() == theirs.betti_numbers()
        assert ours.persistent_betti_numbers(0.6, 0.8) == theirs.persistent_betti_numbers(0.6, 0.8)
        assert ours.num_simplices() == theirs.num_simplices() == ours.all_cells().size
