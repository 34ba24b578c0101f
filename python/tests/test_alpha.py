# SPDX-License-Identifier: MIT
"""ph.alpha: compares bars with the bars of a SciPy triangulation whose filtration values are
computed from the definition. Also tests weights, surfaces and refused inputs."""
import itertools
import pickle

import libph as ph
import numpy as np
import pytest
from libph import _core
from numpy.testing import assert_allclose, assert_array_equal

needs_cgal = pytest.mark.skipif(not _core.alpha_support(), reason="CGAL is not built in")


def by_definition(points):
    """The simplices of the Delaunay triangulation with their squared alpha values: the least
    squared radius of an empty sphere through the vertices. For a simplex whose smallest
    circumsphere is empty, this is the squared radius of that sphere; otherwise it is the least
    value of the simplex's cofaces."""
    from scipy.spatial import Delaunay
    cells = [tuple(sorted(cell)) for cell in Delaunay(points).simplices.tolist()]
    dim = points.shape[1]
    values = {}
    for size in range(dim + 1, 0, -1):
        for simplex in {s for cell in cells for s in itertools.combinations(cell, size)}:
            corners = points[list(simplex)]
            edges = corners[1:] - corners[0]
            weights = np.linalg.solve(edges @ edges.T, (edges**2).sum(1) / 2) if size > 1 else []
            centre = corners[0] + (weights @ edges if size > 1 else 0)
            radius = ((corners[0] - centre)**2).sum()
            others = np.delete(points, simplex, axis=0)
            if len(others) and (((others - centre)**2).sum(1) < radius * (1 - 1e-12)).any():
                radius = min(value for other, value in values.items()
                             if len(other) == size + 1 and set(simplex) < set(other))
            values[simplex] = radius
    # In spite of rounding, no face may enter later than its cofaces.
    for simplex in sorted(values, key=len, reverse=True):
        for face in itertools.combinations(simplex, len(simplex) - 1):
            if face:
                values[face] = min(values[face], values[simplex])
    return list(values), np.array(list(values.values()))


@needs_cgal
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("field", [2, 3])
def test_bars_are_those_of_the_definition(dim, field):
    pytest.importorskip("scipy")
    for seed in range(3):
        points = np.random.default_rng(seed).normal(size=(40, dim))
        expected = ph.filtered(*by_definition(points), field=field)
        found = ph.alpha(points, squared=True, field=field)
        for k in range(dim):
            longer = expected.dgm(k)
            longer = longer[longer[:, 1] - longer[:, 0] > 1e-9]
            bars = found.dgm(k)
            assert_allclose(bars[bars[:, 1] - bars[:, 0] > 1e-9], longer, rtol=1e-9)
        radii = ph.alpha(points, field=field)
        for k in range(dim):
            assert_allclose(radii.dgm(k)**2, found.dgm(k), rtol=1e-12)
            cech = ph.alpha(points, values="delaunay-cech", field=field).dgm(k)
            assert_allclose(cech, radii.dgm(k), rtol=1e-12)


@needs_cgal
def test_components_are_half_those_of_rips():
    points = np.random.default_rng(1).normal(size=(200, 3))
    assert_array_equal(2 * ph.alpha(points).dgm(0), ph.rips(points, max_dim=0).dgm(0))
    tree = ph.merge_tree(points, complex="alpha")
    assert_array_equal(2 * tree.values, ph.merge_tree(points).values)


def first_within(points, reach):
    """For each point, the first point that can be reached from it by steps of at most `reach`."""
    apart = np.linalg.norm(points[:, None] - points, axis=2) <= reach
    first = np.arange(len(points))
    for _ in points:
        first = np.where(apart, first, len(points)).min(axis=1)
    return first


@needs_cgal
def test_vertices_of_a_tree_are_points():
    from scipy.cluster.hierarchy import fcluster
    random = np.random.default_rng(9)
    for size in (1, 2, 3, 10, 40):
        for dim in (1, 2, 3):
            # Rounds the coordinates, because some points must coincide.
            points = random.normal(size=(size, dim)).round(1)
            points[random.random(size) < 0.2, 0] = np.nan
            is_there = ~np.isnan(points[:, 0])
            tree = ph.merge_tree(points, complex="alpha", nan="drop")
            assert_array_equal(tree.births, np.where(is_there, 0, np.inf))
            lengths = np.linalg.norm(points[tree.edges[:, 0]] - points[tree.edges[:, 1]], axis=1)
            assert_allclose(2 * tree.values, lengths, rtol=1e-12)
            for radius in (0, 0.101, 0.251, 0.501):
                names = tree.components(radius)
                assert_array_equal(names == -1, ~is_there)
                of_point = names[is_there]
                expected = first_within(points[is_there], 2 * radius)
                same = of_point[:, None] == of_point
                assert_array_equal(same, expected[:, None] == expected)
                assert all(names[name] == name for name in of_point)
            if tree.births.min() < np.inf and is_there.all() and size > 1:
                joined = fcluster(tree.linkage, 0.251, "distance")
                of_point = tree.components(0.251)
                assert_array_equal(joined[:, None] == joined, of_point[:, None] == of_point)


@needs_cgal
def test_what_is_hidden_never_enters_the_tree():
    points = [[9.0], [0], [3], [0.5]]
    tree = ph.merge_tree(points, complex="alpha", weights=[1, 1, 4, -9])
    assert_array_equal(tree.births, [-1, -1, -4, np.inf])
    assert_array_equal(sorted(tree.edges[tree.values.argmin()]), [1, 2])
    assert_array_equal(tree.components(0), [0, 2, 2, -1])
    late = ph.merge_tree(points, complex="alpha", weights=[1, 1, 4, -9], threshold=-2)
    assert_array_equal(late.births, [np.inf, np.inf, -4, np.inf])


@needs_cgal
def test_weights_and_hidden_points(tmp_path):
    bars = ph.alpha([[0, 0, 0], [3, 0, 0], [0.5, 0, 0]], weights=[1, 4, -9])
    assert_array_equal(bars.dgm(0), [[-4, np.inf], [-1, 0]])
    assert bars.meta["hidden"] == (2,)
    assert bars.meta["squared"] is True
    assert pickle.loads(pickle.dumps(bars)) == bars
    bars.save(tmp_path / "bars.json")
    assert ph.read_barcode(tmp_path / "bars.json").meta["hidden"] == (2,)
    assert ph.read_barcode(tmp_path / "bars.json").meta["squared"] is True
    # Equal weights shift the squared values by a constant.
    points = np.random.default_rng(2).normal(size=(50, 2))
    shifted = ph.alpha(points, weights=np.full(50, 0.25)).dgm(1)
    assert_allclose(shifted + 0.25, ph.alpha(points, squared=True).dgm(1), rtol=1e-9)


@needs_cgal
def test_a_file_keeps_what_values_are(tmp_path):
    points = np.random.default_rng(4).random((20, 2))
    for options in ({"squared": False}, {"squared": True}, {"squared": False, "period": 1}):
        bars = ph.alpha(points, **options)
        for _ in range(2):  # writes a barcode, reads it, and writes it again
            bars.save(tmp_path / "bars.json")
            bars = ph.read_barcode(tmp_path / "bars.json")
            assert bars.meta["squared"] is options["squared"]
            assert bars.meta.get("period") == ((1.0, 1.0) if "period" in options else None)


@needs_cgal
def test_periodic_spaces():
    rng = np.random.default_rng(5)
    points = rng.random((60, 3))
    bars = ph.alpha(points, period=1, squared=True)
    assert np.bincount(bars.dims[np.isinf(bars.deaths)]).tolist() == [1, 3, 3, 1]
    assert bars.meta["period"] == (1.0, 1.0, 1.0)
    # The points are moved around the torus by exactly representable amounts.
    moved = ph.alpha(np.round(points * 2**20) / 2**20 + [0.5, 0.25, 3], period=[1, 1, 1])
    still = ph.alpha(np.round(points * 2**20) / 2**20, period=1)
    for dim in range(4):
        assert_allclose(moved.dgm(dim), still.dgm(dim), rtol=1e-14)
    # With one axis that is not periodic, the space is a cylinder. Without a periodic axis, it is
    # ordinary space.
    cylinder = ph.alpha(points, period=[1, None, 0])
    assert np.bincount(cylinder.dims[np.isinf(cylinder.deaths)]).tolist() == [1, 1]
    assert ph.alpha(points, period=[0, 0, 0]) == ph.alpha(points)
    # Components by definition: a minimum spanning tree of the distances on the torus.
    apart = np.abs(points[:, None] - points)
    distances = np.sqrt((np.minimum(apart, 1 - apart)**2).sum(axis=2))
    tree = ph.rips(distances, metric="precomputed", max_dim=0)
    assert_allclose(np.sqrt(bars.dgm(0)), tree.dgm(0) / 2, rtol=1e-9)
    for how in ({"period": [1, 1]}, {"period": -1}, {"period": "1"}, {"period": [1, 1, np.inf]},
                {"period": 1, "values": "delaunay-rips"}):
        with pytest.raises(ph.UsageError, match="period: found"):
            ph.alpha(points, **how)
    with pytest.raises(ph.UsageError, match="period"):
        ph.merge_tree(points, complex="alpha", period=1)


@needs_cgal
def test_points_that_are_left_out_keep_their_numbers():
    points = np.array([[np.nan, 0], [0, 0], [1, 0], [1, 1], [0, 1]])
    bars = ph.alpha(points, nan="drop", representatives="cycles", weights=[7, 0, 0, 0, 0])
    chain = bars.representative([bar.dim for bar in bars].index(1))
    assert sorted(map(sorted, chain.cells.tolist())) == [[1, 2], [1, 4], [2, 3], [3, 4]]
    surface = ph.alpha_shape(points, 1, nan="drop")
    assert sorted(set(surface.triangles.ravel().tolist())) == [1, 2, 3, 4]


@needs_cgal
def test_surfaces(tmp_path):
    points = np.random.default_rng(3).normal(size=(100, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    surface = ph.alpha_shape(points, 10)
    assert_array_equal(surface.vertices, points)
    a, b, c = (points[surface.triangles[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    assert 3 < volume < 4 * np.pi / 3
    assert len(surface.triangles) == 2 * len(points) - 4  # all points are on the hull
    assert not surface.singular.any()
    for name in ("a.ply", "a.off"):
        surface.save(tmp_path / name)
        mesh = ph.read(tmp_path / name)
        assert_array_equal(mesh.vertices, points)
        assert_array_equal(mesh.triangles, surface.triangles)
    # Three points in space form a triangle but no tetrahedron.
    flat = ph.alpha_shape([[0, 0, 0], [1, 0, 0], [0, 1, 0]], 1)
    assert len(flat.triangles) == 1
    assert len(ph.alpha_shape(points, 1e-6).triangles) == 0
    assert len(ph.alpha_shape(points, 10, wrap=True).triangles) > 0


@needs_cgal
@pytest.mark.parametrize("data", [np.empty((0, 3)), [[1.0, 2.0]], [[1.0], [2.0], [2.0]],
                                  [[0, 0, 0]] * 3, [[k, k, k] for k in range(5)],
                                  [[x, y, 5] for x in range(3) for y in range(3)]])
def test_degenerate_points(data):
    bars = ph.alpha(data)
    endless = int(np.isinf(bars.deaths).sum())
    assert endless == min(1, len(data))
    assert (bars.deaths > bars.births).all()


@needs_cgal
def test_estimates_and_pages():
    points = np.random.default_rng(4).normal(size=(60, 3))
    estimate = ph.estimate(points, complex="alpha")
    assert estimate.engine == "gradient" and 0 < estimate.bytes_low <= estimate.bytes_high
    try:
        page = ph.alpha(points, values="delaunay-cech", representatives="cycles").report(points).html
    except ph.NotBuiltIn:
        pytest.skip("reports are not built in")
    assert "complex/triangles" in page and "Radius" in page
    assert "complex/triangles" in ph.report(points, complex="alpha").html


@needs_cgal
@pytest.mark.parametrize("how, message", [
    ({"X": np.zeros((3, 4))}, r"X: found points of R\^4, expected R\^1 to R\^3"),
    ({"values": "cech"}, "values: found 'cech'"),
    ({"weights": [1, 2]}, "weights"),
    ({"weights": [0] * 4, "squared": False}, "squared: found False with weights"),
    ({"weights": [0] * 4, "values": "delaunay-rips"}, "weights: found values='delaunay-rips'"),
    ({"weights": [0, 0, 0, np.inf]}, "weight"),
    ({"threshold": -1}, "threshold: found -1"),
    ({"representatives": "cocycle"}, "representatives"),
    ({"loops": "tight", "representatives": "cycles"}, "loops"),
    ({"squared": "yes"}, "squared: found 'yes'")])
def test_refused(how, message):
    options = {"X": [[0, 0], [1, 0], [1, 1], [0, 1]], **how}
    with pytest.raises((ph.UsageError, ph.DataError), match=message):
        ph.alpha(options.pop("X"), **options)


@needs_cgal
def test_other_things_are_refused(tmp_path):
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    with pytest.raises(ph.DataError, match="nan='drop'"):
        ph.alpha([[0, np.nan]])
    with pytest.raises(TypeError, match="max_scale"):
        ph.alpha(square, max_scale=1)
    with pytest.raises(ph.UsageError, match=r"\.ply or \.off"):
        ph.alpha_shape(square, 1).save(tmp_path / "a.stl")
    with pytest.raises(ph.UsageError, match="value"):
        ph.alpha_shape(square, "far")
    with pytest.raises(ph.UsageError, match="max_dim: does nothing"):
        ph.merge_tree(square, complex="alpha", max_dim=1)


TRIANGLE = ph.Surface(np.eye(3), np.array([[0, 1, 2]]), np.zeros(1, bool))


@pytest.mark.parametrize("wrong, message", [
    ({"triangles": np.array([[0, 1, 10**9]])}, "column 2: found 1000000000, expected one of 3"),
    ({"triangles": np.array([[0, -1, 2]])}, "row 0, column 1: found -1"),
    ({"triangles": np.array([[0, 1, 3]])}, "found 3, expected one of 3"),
    ({"triangles": np.array([0, 1, 2])}, "shape .3,., expected .m, 3."),
    ({"triangles": np.array([[0, 1, 1.5]])}, "found 1.5, expected a whole number"),
    ({"singular": np.zeros(2, bool)}, "shape .2,., expected bool of shape .1,."),
    ({"singular": np.zeros(1)}, "float64 .* expected bool"),
    ({"triangles": np.array([[0, 1, 2]] * 2), "singular": np.array([True, False])}, "come last"),
    ({"vertices": np.zeros((3, 4))}, "shape .3, 4., expected .n, 2. or .n, 3."),
    ({"vertices": np.zeros((0, 0))}, "vertices")])
def test_a_surface_that_is_none_is_not_written(wrong, message, tmp_path):
    surface = TRIANGLE._replace(**wrong)
    for name in ("a.ply", "a.off"):
        with pytest.raises((ph.UsageError, ph.DataError), match=message):
            surface.save(tmp_path / name)
        assert not (tmp_path / name).exists()
        TRIANGLE.save(tmp_path / f"right-{name}")


@needs_cgal
@pytest.mark.parametrize("X", [[], np.empty((0, 2)), np.empty((0, 3)), np.empty((0, 5))], ids=str)
def test_a_surface_of_no_points(X, tmp_path):
    surface = ph.alpha_shape(X, 1)
    assert surface.vertices.shape == (0, 3)
    surface.save(tmp_path / "a.ply")
    surface.save(tmp_path / "a.off")


@needs_cgal
def test_a_surface_has_vertices_of_its_own():
    points = np.eye(3)
    surface = ph.alpha_shape(points, 2)
    points[0, 0] = 7
    assert surface.vertices[0, 0] == 1


@pytest.mark.skipif(bool(_core.alpha_support()), reason="CGAL is built in")
def test_without_cgal():
    with pytest.raises(ph.NotBuiltIn, match="libcgal-dev"):
        ph.alpha([[0, 0]])
    with pytest.raises(ph.NotBuiltIn, match="libcgal-dev"):
        ph.alpha_shape([[0, 0]], 1)
