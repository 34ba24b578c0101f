# SPDX-License-Identifier: MIT
"""Compares distances between barcodes with the costs of optimal assignments, which SciPy computes.
In the cost matrices, each bar can also be paired with the diagonal."""
import itertools
import math
import pickle

import numpy as np
import pytest

import libph as ph

optimize = pytest.importorskip("scipy.optimize")
INF = math.inf


def random_diagram(rng, size, infinite=0, grid=None):
    dgm = np.sort(rng.random((size, 2)), axis=1)
    if grid:
        dgm = np.floor(dgm * grid) / grid
    return np.vstack([dgm, np.column_stack([rng.random(infinite), np.full(infinite, INF)])])


def costs_of(a, b, ground):
    """Costs of pairing each bar of `a` (row) with each bar of `b` (column). Further rows and
    columns are copies of the diagonal, one for each bar."""
    def to_diagonal(dgm):  # the point at the bar's midpoint is the nearest one, in any norm
        return np.linalg.norm(dgm - dgm.mean(axis=1, keepdims=True), ground, axis=1)
    size = len(a) + len(b)
    costs = np.zeros((size, size))
    costs[:len(a), :len(b)] = np.linalg.norm(a[:, None] - b[None], ground, axis=2)
    costs[:len(a), len(b):] = to_diagonal(a)[:, None]
    costs[len(a):, :len(b)] = to_diagonal(b)
    return costs


def wasserstein_by_scipy(a, b, order, ground):
    costs = costs_of(a, b, ground) ** order
    rows, columns = optimize.linear_sum_assignment(costs)
    return costs[rows, columns].sum() ** (1 / order)


def bottleneck_by_scipy(a, b):
    """The least value such that some assignment uses only costs of at most this value."""
    costs = costs_of(a, b, np.inf)
    for value in np.unique(costs):
        rows, columns = optimize.linear_sum_assignment(costs > value)
        if not (costs > value)[rows, columns].any():
            return value
    return 0.0


SIZES = [(0, 0), (0, 3), (4, 0), (1, 1), (7, 5), (12, 30), (25, 25)]


@pytest.mark.parametrize("order, ground", [(1, INF), (1, 2), (2, 2), (2, INF), (3, 1), (1.5, 4)])
@pytest.mark.parametrize("grid", [None, 8])
def test_wasserstein(rng, order, ground, grid):
    for sizes in SIZES:
        a, b = (random_diagram(rng, size, grid=grid) for size in sizes)
        found = ph.wasserstein(a, b, order=order, ground=ground)
        expected = wasserstein_by_scipy(a, b, order, ground)
        assert type(found) is float and math.isclose(found, expected, rel_tol=1e-12, abs_tol=1e-13)
        rough = ph.wasserstein(a, b, order=order, ground=ground, relative_error=0.1)
        assert expected * (1 - 1e-12) <= rough <= expected * 1.1 + 1e-12
        beyond = ph.wasserstein(a, b, order=order, ground=ground, at_most=expected / 2)
        assert beyond >= expected * (1 - 1e-12)


@pytest.mark.parametrize("grid", [None, 8])
def test_bottleneck(rng, grid):
    for sizes in SIZES[:-1]:
        a, b = (random_diagram(rng, size, grid=grid) for size in sizes)
        expected = bottleneck_by_scipy(a, b)
        assert math.isclose(ph.bottleneck(a, b), expected, rel_tol=1e-15)
        assert expected <= ph.bottleneck(a, b, relative_error=0.2) <= expected * 1.2 + 1e-15
        if expected:
            assert ph.bottleneck(a, b, at_most=expected / 2) > expected / 2


def test_infinite_bars(rng):
    a, b = random_diagram(rng, 6, infinite=3), random_diagram(rng, 4, infinite=3)
    ends = np.abs(np.sort(a[6:, 0]) - np.sort(b[4:, 0]))
    finite = wasserstein_by_scipy(a[:6], b[:4], 2, 2)
    assert math.isclose(ph.wasserstein(a, b, order=2, ground=2),
                        math.sqrt(finite ** 2 + (ends ** 2).sum()))
    assert math.isclose(ph.bottleneck(a, b), max(bottleneck_by_scipy(a[:6], b[:4]), ends.max()))
    for function in (ph.bottleneck, ph.wasserstein, ph.sliced_wasserstein):
        assert function(a, b[:-1]) == INF
    assert ph.wasserstein_matching(a, b[:-1]).pairs.shape == (0, 2)


def sliced_by_hand(a, b, directions):
    def nearest(dgm):
        return np.repeat(dgm.mean(axis=1), 2).reshape(-1, 2)
    first, second = np.vstack([a, nearest(b)]), np.vstack([b, nearest(a)])
    angles = np.arange(directions) * np.pi / directions
    lines = np.array([np.cos(angles), np.sin(angles)])
    return np.abs(np.sort(first @ lines, axis=0) - np.sort(second @ lines, axis=0)).sum() / directions


def test_sliced_wasserstein(rng):
    for sizes in SIZES:
        a, b = (random_diagram(rng, size) for size in sizes)
        for directions in (1, 7, 50):
            assert math.isclose(ph.sliced_wasserstein(a, b, directions=directions),
                                sliced_by_hand(a, b, directions), abs_tol=1e-12)


def cost_of(matching, norm):
    costs = []
    for i, j in matching.pairs:
        ends = [None if k < 0 else dgm[k] for dgm, k in ((matching.a, i), (matching.b, j))]
        ends = [ends[1 - s].mean() if end is None else end for s, end in enumerate(ends)]
        costs.append(np.linalg.norm(ends[0] - ends[1], norm))
    return np.array(costs)


@pytest.mark.parametrize("grid", [None, 4])
def test_matchings(rng, grid):
    for sizes in SIZES:
        a, b = (random_diagram(rng, size, grid=grid) for size in sizes)
        for matching in (ph.bottleneck_matching(a, b),
                         ph.wasserstein_matching(a, b, order=2, ground=2)):
            assert np.array_equal(np.sort(matching.pairs[matching.pairs[:, 0] >= 0, 0]),
                                  np.arange(len(a)))
            assert np.array_equal(np.sort(matching.pairs[matching.pairs[:, 1] >= 0, 1]),
                                  np.arange(len(b)))
            assert matching.lower <= matching.distance
            costs = cost_of(matching, matching.ground)
            total = np.linalg.norm(costs, matching.order) if len(costs) else 0
            assert math.isclose(total, matching.distance, rel_tol=1e-12, abs_tol=1e-13)
        copy = pickle.loads(pickle.dumps(matching))
        assert np.array_equal(copy.pairs, matching.pairs) and copy.distance == matching.distance


def test_of_barcodes():
    a, b = (ph.rips(np.random.default_rng(seed).random((30, 2))) for seed in (1, 2))
    for function in (ph.wasserstein, ph.sliced_wasserstein, ph.bottleneck):
        both = function(a, b)
        assert both == {d: function(a.dgm(d), b.dgm(d)) for d in (0, 1)}
        assert function(a, b, 1) == both[1]
    matching = ph.wasserstein_matching(a, b, 1)
    assert np.array_equal(matching.a, a.dgm(1)) and matching.distance == ph.wasserstein(a, b, 1)
    with pytest.raises(ph.UsageError, match="dim: found None"):
        ph.bottleneck_matching(a, b)
    with pytest.raises(ph.UsageError, match="dim: found None"):
        ph.diagram_distances([a, b])
    assert ph.diagram_distances([a, b], dim=1)[0, 1] == ph.wasserstein(a, b, 1)


@pytest.mark.parametrize("distance, options", [
    ("wasserstein", {}), ("wasserstein", {"order": 2, "ground": 2}), ("bottleneck", {}),
    ("sliced_wasserstein", {"directions": 9})])
def test_matrices(rng, distance, options):
    dgms = [random_diagram(rng, size, infinite=1) for size in (3, 0, 12, 30, 7)]
    others = [random_diagram(rng, size, infinite=1) for size in (5, 1)]
    function = getattr(ph, distance)
    expected = [[function(a, b, **options) for b in dgms] for a in dgms]
    for threads in (1, 3):
        found = ph.diagram_distances(dgms, distance=distance, threads=threads, **options)
        assert np.allclose(found, expected, rtol=1e-12) and np.array_equal(found, found.T)
    across = ph.diagram_distances(dgms, others, distance=distance, **options)
    assert np.array_equal(across, [[function(a, b, **options) for b in others] for a in dgms])
    assert ph.diagram_distances([], distance=distance).shape == (0, 0)
    assert ph.diagram_distances(dgms, [], distance=distance).shape == (5, 0)


def test_barycentre(rng):
    """The barycentre cannot be improved by moving one of its bars, and no given diagram is a better
    mean."""
    dgms = [random_diagram(rng, 8) + [[0, 0.3]] for _ in range(4)]
    found = ph.barycentre(dgms)
    distances = [ph.wasserstein(found.diagram, dgm, order=2, ground=2) for dgm in dgms]
    rms = math.sqrt(np.mean(np.square(distances)))
    assert found.converged and found.rounds > 0 and math.isclose(rms, found.root_mean_square)
    matrix = ph.diagram_distances(dgms, order=2, ground=2)
    assert rms < np.sqrt((matrix ** 2).mean(axis=1)).min()
    for bar, axis, step in itertools.product(range(len(found.diagram)), (0, 1), (-1e-3, 1e-3)):
        moved = found.diagram.copy()
        moved[bar, axis] += step
        if moved[bar, 0] < moved[bar, 1]:
            others = [ph.wasserstein(moved, dgm, order=2, ground=2) for dgm in dgms]
            assert np.mean(np.square(others)) > rms ** 2 * (1 - 1e-12)
    medoid = ph.barycentre(dgms, max_rounds=0)
    assert np.array_equal(medoid.diagram, sorted(dgms[np.argmin((matrix ** 2).sum(axis=1))].tolist()))


def test_wrong_options():
    a, b = [[0, 1]], [[0, 2]]
    for call, text in (
            (lambda: ph.wasserstein(a, b, order=0.5), "order"),
            (lambda: ph.wasserstein(a, b, order=INF), "order"),
            (lambda: ph.wasserstein(a, b, ground=0), "ground"),
            (lambda: ph.wasserstein(a, b, relative_error=-1), "relative_error"),
            (lambda: ph.bottleneck(a, b, at_most=math.nan), "at_most"),
            (lambda: ph.sliced_wasserstein(a, b, directions=0), "directions"),
            (lambda: ph.diagram_distances([a, b], distance="hausdorff"), "distance"),
            (lambda: ph.diagram_distances([a, b], distance="bottleneck", order=2), "order"),
            (lambda: ph.diagram_distances([a, b], directions=3), "directions"),
            (lambda: ph.diagram_distances("ab"), "diagrams"),
            (lambda: ph.diagram_distances([a, [[0, 1, 2]]]), r"diagrams\[1\]"),
            (lambda: ph.barycentre([]), "diagram"),
            (lambda: ph.barycentre([a], max_rounds=-1), "max_rounds"),
            (lambda: ph.barycentre([a], tolerance=math.nan), "tolerance")):
        with pytest.raises(ph.UsageError, match=text):
            call()
    with pytest.raises(TypeError, match="'order'"):
        ph.wasserstein(a, b, p=2)
    with pytest.raises(ph.DataError):
        ph.barycentre([a, [[0, INF]]])


def test_limits(rng):
    dgms = [random_diagram(rng, 3000) for _ in range(4)]
    with pytest.raises(ph.MemoryLimitError):
        ph.wasserstein(dgms[0], dgms[1], memory_limit=10_000)
    with pytest.raises(ph.Timeout):
        ph.diagram_distances(dgms * 20, timeout=0.1)


def test_plot_of_a_matching(rng):
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    matplotlib.use("agg")
    import matplotlib.pyplot as plt
    matching = ph.bottleneck_matching(random_diagram(rng, 5, infinite=1),
                                      random_diagram(rng, 3, infinite=1))
    ax = matching.plot(colors="red")
    lines, = (c for c in ax.collections if hasattr(c, "get_segments"))
    assert len(lines.get_segments()) == len(matching.pairs)
    assert np.isfinite(np.concatenate(lines.get_segments())).all()
    plt.close("all")


# ---- scikit-learn


def test_in_pipelines(rng):
    pytest.importorskip("sklearn", reason="scikit-learn is not installed")
    from sklearn.base import clone
    from sklearn.neighbors import KNeighborsClassifier
    from sklearn.pipeline import make_pipeline

    from libph.sklearn import DiagramDistances
    dgms = [[random_diagram(rng, 5), random_diagram(rng, 3)] for _ in range(6)]
    first = [row[0] for row in dgms]
    by = clone(DiagramDistances(order=2, norm=1)).fit(dgms[:4])
    assert np.array_equal(by.transform(dgms), sum(
        ph.diagram_distances([row[k] for row in dgms], [row[k] for row in dgms[:4]], order=2)
        for k in (0, 1)))
    assert np.allclose(DiagramDistances().fit_transform(first), ph.diagram_distances(first))
    assert list(by.get_feature_names_out()) == [f"sample{i}" for i in range(4)]
    with pytest.raises(ph.UsageError, match="found 1 diagrams"):
        by.transform(first)
    steps = make_pipeline(DiagramDistances("bottleneck"),
                          KNeighborsClassifier(1, metric="precomputed"))
    assert list(steps.fit(first, range(6)).predict(first)) == list(range(6))


@pytest.mark.parametrize("scale", [1e-170, 1e200, 5e-324])
@pytest.mark.parametrize("norm, factor", [(1, 2), (2, 2**0.5), (np.inf, 1)])
def test_norms_of_distances_at_any_scale(scale, norm, factor):
    pytest.importorskip("sklearn", reason="scikit-learn is not installed")
    from libph.sklearn import DiagramDistances
    dgms = [np.array([[0, scale]]), np.array([[0, 3 * scale]])]
    estimator = DiagramDistances("bottleneck", norm=norm)
    single = estimator.fit_transform(dgms)
    assert np.array_equal(single, ph.diagram_distances(dgms, distance="bottleneck"))
    twice = estimator.fit_transform([[dgm, dgm] for dgm in dgms])
    assert twice == pytest.approx(factor * single, rel=1e-12, abs=5e-324)
    endless = np.array([[0, scale], [0, np.inf]])
    assert estimator.fit_transform([[endless, endless], [dgms[0], endless]])[0, 1] == np.inf


def test_a_matching_has_diagrams_of_its_own():
    a, b = np.array([[0.0, 2]]), np.array([[0.0, 3]])
    for function in (ph.bottleneck_matching, ph.wasserstein_matching):
        matching = function(a, b)
        assert np.array_equal(matching.a, a) and np.array_equal(matching.b, b)
        assert not np.shares_memory(matching.a, a) and not np.shares_memory(matching.b, b)
