# SPDX-License-Identifier: MIT
"""Compares statistics of bars and of groups of barcodes with their definitions."""
import itertools
import math

import numpy as np
import pytest

import libph as ph

INF = math.inf


def noisy_circle(rng, size=150, noise=0.1):
    angles = rng.uniform(0, 2 * np.pi, size)
    return np.column_stack([np.cos(angles), np.sin(angles)]) + rng.normal(0, noise, (size, 2))


# ---- p-values


@pytest.mark.parametrize("filtration, a", [("rips", 1), ("cech", 0.5)])
def test_p_values(rng, filtration, a):
    births = rng.random(30) + 0.1
    dgm = np.column_stack([births, births * (1 + rng.random(30))])
    ratio = a * np.log(np.log(dgm[:, 1] / dgm[:, 0]))
    expected = np.exp(-np.exp(ratio - ratio.mean() - np.euler_gamma))
    found = ph.p_values(dgm, filtration=filtration, corrected=False)
    assert np.allclose(found, expected, rtol=1e-12)
    assert np.allclose(ph.p_values(dgm, filtration=filtration), np.minimum(1, 30 * expected))
    more = np.vstack([dgm, [[1, INF]]])
    assert np.array_equal(ph.p_values(more, filtration=filtration, corrected=False),
                          [*found, np.nan], equal_nan=True)


def test_p_values_of_barcodes(rng):
    bars = ph.rips(noisy_circle(rng))
    found = ph.p_values(bars, 1)
    assert np.array_equal(found, ph.p_values(bars.dgm(1), filtration="rips"))
    assert int(np.argmin(found)) == int(np.argmax(bars.dgm(1)[:, 1] - bars.dgm(1)[:, 0]))
    for call, text in ((lambda: ph.p_values(bars), "dim"), (lambda: ph.p_values(bars, 0), "dim"),
                       (lambda: ph.p_values(bars.dgm(1)), "filtration"),
                       (lambda: ph.p_values(bars.dgm(1), 1, filtration="rips"), "dim"),
                       (lambda: ph.p_values(bars, 1, filtration="alpha"), "filtration"),
                       (lambda: ph.p_values(ph.cubical(np.eye(5)), 1), "the test is not defined for "
                        "images")):
        with pytest.raises(ph.UsageError, match=text):
            call()
    with pytest.raises(ph.DataError, match="born at 0"):
        ph.p_values([[0, 1]], filtration="rips")


# ---- confidence radius


def test_confidence_radius(rng):
    """For subsamples that leave out one point, the radius is twice the largest distance from a
    point to its nearest neighbour."""
    X = rng.random((12, 3))
    gaps = np.linalg.norm(X[:, None] - X, axis=2) + np.diag(np.full(12, INF))
    found = ph.confidence_radius(X, size=11, subsamples=3000, alpha=0.001)
    assert math.isclose(found, 2 * gaps.min(axis=1).max())
    assert ph.confidence_radius(X, size=12) == 0
    assert ph.confidence_radius(X, seed=3) == ph.confidence_radius(X, seed=3, threads=1)
    for options, name in (({"alpha": 0}, "alpha"), ({"alpha": 2}, "alpha"), ({"size": 0}, "size"),
                          ({"size": 13}, "size"), ({"subsamples": 0}, "subsamples"),
                          ({"seed": -1}, "seed")):
        with pytest.raises(ph.UsageError, match=name):
            ph.confidence_radius(X, **options)
    with pytest.raises(ph.Timeout):
        ph.confidence_radius(rng.random((20000, 3)), subsamples=10**6, timeout=0.1)


def test_a_circle_is_told_from_noise(rng):
    X = noisy_circle(rng, 3000, 0.01)
    bars = ph.rips(X[ph.farthest_points(X, 300).indices])
    lengths = bars.dgm(1)[:, 1] - bars.dgm(1)[:, 0]
    assert (lengths > 4 * ph.confidence_radius(X)).sum() == 1


# ---- bands


def test_band_is_drawn(rng):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    samples = rng.normal(size=(20, 3, 10))
    band = ph.confidence_band(samples)
    axes = band.plot(grid=np.linspace(0, 1, 10), layer=2, color="red", label="mean")
    line, = axes.get_lines()
    assert np.array_equal(line.get_ydata(), band.mean[2])
    assert (line.get_color(), line.get_label()) == ("red", "mean")
    ends = axes.collections[0].get_paths()[0].vertices
    assert np.isclose(ends[:, 1].min(), band.lower[2].min())
    assert np.isclose(ends[:, 1].max(), band.upper[2].max())
    assert ph.confidence_band(samples[:, 0]).plot(axes) is axes
    pyplot.close("all")
    for wrong in ({"layer": 3}, {"grid": [0, 1]}):
        with pytest.raises(ph.UsageError, match=next(iter(wrong))):
            band.plot(**wrong)
    with pytest.raises(ph.UsageError, match="expected a number for each grid point"):
        ph.confidence_band(samples[..., None]).plot()


def test_confidence_band(rng):
    samples = rng.normal(5, 2, (80, 3, 4))
    band = ph.confidence_band(samples)
    assert np.allclose(band.mean, samples.mean(axis=0))
    width = band.upper - band.lower
    assert width.shape == (3, 4) and np.allclose(width, width[0, 0])
    # For twelve independent numbers, the factor lies between the quantile of a single number and
    # the Bonferroni bound.
    sd = samples.std(axis=0).max() / math.sqrt(80)
    assert 1.96 * sd * 0.8 < width[0, 0] / 2 < 3.2 * sd
    one = ph.confidence_band(samples[:, 0, :1], repetitions=20000)
    sd = samples[:, 0, 0].std() / math.sqrt(80)
    assert math.isclose((one.upper - one.lower)[0] / 2, 1.96 * sd, rel_tol=0.03)
    assert np.array_equal(ph.confidence_band(samples, seed=1, threads=1).lower,
                          ph.confidence_band(samples, seed=1, threads=3).lower)
    for wrong, error, text in ((samples[:1], ph.UsageError, "two samples"),
                               ([1.0, 2.0], ph.UsageError, "two samples"),
                               ([[1, 2], [3, INF]], ph.DataError, "inf")):
        with pytest.raises(error, match=text):
            ph.confidence_band(wrong)


# ---- groups


def test_permutation_test(rng):
    places = np.floor(rng.random(7) * 30)
    distances = np.abs(places[:, None] - places)
    groups = list("aaabbbb")

    def loss(chosen):
        parts = [np.array(chosen), np.setdiff1d(range(7), chosen)]
        return sum(distances[np.ix_(k, k)].sum() / (2 * len(k) * (len(k) - 1)) for k in parts)

    losses = [loss(chosen) for chosen in itertools.combinations(range(7), 3)]
    found = ph.permutation_test(distances, groups, shuffles=20000)
    assert math.isclose(found.loss, losses[0])
    assert abs(found.p - np.mean(np.array(losses) <= losses[0] + 1e-9)) < 0.015
    assert found == ph.permutation_test(distances, [5, 5, 5, 1, 1, 1, 1], shuffles=20000, threads=1)
    squares = ph.permutation_test(distances, groups, power=2)
    assert math.isclose(squares.loss, ph.permutation_test(distances ** 2, groups).loss)


def test_wrong_groups():
    D = np.abs(np.arange(4)[:, None] - np.arange(4.0))
    for distances, groups, error, text in (
            (D, [None, None, "a", "a"], ph.UsageError, "groups: found .* numbers or words"),
            (D, [[1, 2], [1, 2, 3], 1, 1], ph.UsageError, "groups: found"),
            (D, "aabb", ph.UsageError, "groups"), (D, list("aab"), ph.UsageError, "groups"),
            (D, list("aaab"), ph.UsageError, r"\[3, 1\]"), (D, list("aaaa"), ph.UsageError, "groups"),
            (D[:3], list("aabb"), ph.UsageError, "square"),
            (np.triu(D), list("aabb"), ph.DataError, "symmetric"),
            (np.where(D == 3, INF, D), list("aabb"), ph.DataError, "infinite distance")):
        with pytest.raises(error, match=text):
            ph.permutation_test(distances, groups)
    with pytest.raises(ph.UsageError, match="shuffles"):
        ph.permutation_test(D, list("aabb"), shuffles=0)


# ---- pictures


def test_noise_in_a_diagram(rng):
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    matplotlib.use("agg")
    import matplotlib.pyplot as plt
    bars = ph.rips(noisy_circle(rng))
    ax = bars.plot(dims=1, noise=0.3)
    low, high = ax.collections[0].get_paths()[0].vertices[:, 1].min(), bars.dgm(1).max()
    assert math.isclose(low, bars.dgm(1).min()) and math.isclose(
        ax.collections[0].get_paths()[0].vertices[:, 1].max(), high + 0.3)
    with pytest.raises(ph.UsageError, match="noise"):
        bars.plot("barcode", noise=0.3)
    plt.close("all")
