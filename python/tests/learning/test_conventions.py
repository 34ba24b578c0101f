# SPDX-License-Identifier: MIT
"""Compares our vectors with the definitions of other packages. docs/explanation/vectors.md states
the same options and factors. The packages themselves are not called: the tests contain their
formulas."""
import math

import numpy as np
import pytest

import libph as ph

pytest.importorskip("sklearn", reason="scikit-learn is missing: nothing of libph.sklearn is tested")
from libph.sklearn import (Atol, BettiCurve, Entropy, Landscape, LifeEntropy,  # noqa: E402
                           PersistenceImage, Silhouette)


@pytest.fixture
def dgm(rng):
    births = rng.uniform(-1, 1, 25)
    return np.column_stack([births, births + rng.exponential(0.5, 25)])


def of(transformer, dgm):
    return transformer.fit_transform([dgm])[0]


def tents(dgm, grid):
    return np.maximum(0, np.minimum(grid - dgm[:, :1], dgm[:, 1:] - grid))


GRID = np.linspace(-1, 2, 31)


# ---- curves


@pytest.mark.parametrize("height, factor", [("tent", 1.0), ("euclidean", math.sqrt(2))])
def test_heights(dgm, height, factor):
    """giotto-tda and persim use tents; GUDHI's heights are distances from the diagonal, which are
    √2 times as large."""
    how = {"resolution": 31, "range": (-1, 2), "height": height}
    layers = np.sort(tents(dgm, GRID), axis=0)[::-1][:3] * factor
    assert np.allclose(of(Landscape(layers=3, **how), dgm).reshape(3, 31), layers, atol=1e-14)
    lengths = dgm[:, 1] - dgm[:, 0]
    for power in (0, 1, 2):  # GUDHI: 0 by default; giotto-tda: 1
        weights = lengths**power / (lengths**power).sum()
        assert np.allclose(of(Silhouette(power, **how), dgm), weights @ tents(dgm, GRID) * factor)


def test_the_height_is_a_distance_from_the_diagonal():
    bar = np.array([0.0, 3.0])
    nearest = np.array([1.5, 1.5])  # a point on the diagonal
    (layer,) = Landscape(layers=1, resolution=1, range=(1.5, 2), height="euclidean").fit_transform(
        [bar[None]])[0]
    assert layer == pytest.approx(np.linalg.norm(bar - nearest))
    (exact,) = ph.filtered([(0,), (1,), (0, 1)], [0, -1, 3]).exact_landscape(
        0, infinity="drop", height="euclidean")
    assert exact(1.5) == pytest.approx(np.linalg.norm(bar - nearest))


def test_betti_curves(dgm):
    """GUDHI and giotto-tda count bars with birth <= t < death, at equal steps. giotto-tda includes
    both ends of the range; GUDHI does so with `keep_endpoints=True`, or if the range is given."""
    alive = (dgm[:, :1] <= GRID) & (GRID < dgm[:, 1:])
    assert np.array_equal(of(BettiCurve(31, (-1, 2)), dgm), alive.sum(axis=0))


@pytest.mark.parametrize("normalised", [False, True])
def test_life_entropies(dgm, normalised):
    """GUDHI's mode="vector"; `normalized` divides by the sum of the absolute values."""
    share = (dgm[:, 1] - dgm[:, 0]) / (dgm[:, 1] - dgm[:, 0]).sum()
    alive = (dgm[:, :1] <= GRID) & (GRID < dgm[:, 1:])
    expected = (-share * np.log(share)) @ alive
    if normalised:
        expected = expected / np.abs(expected).sum()
    found = of(LifeEntropy(31, (-1, 2), normalised=normalised), dgm)
    assert np.allclose(found, expected, rtol=1e-12)


# ---- entropies


def test_entropies(dgm):
    lengths = dgm[:, 1] - dgm[:, 0]
    share = lengths / lengths.sum()
    nats, bits = -(share * np.log(share)).sum(), -(share * np.log2(share)).sum()
    for how, expected in (({}, nats),  # GUDHI, persim
                          ({"unit": "bits"}, bits),  # giotto-tda
                          ({"normalised": "count"}, nats / np.log(25)),  # persim, normalize=True
                          ({"normalised": "total"}, bits / np.log2(lengths.sum()))):  # giotto-tda
        assert of(Entropy(**how), dgm)[0] == pytest.approx(expected, rel=1e-13)
    assert bits == pytest.approx(nats / math.log(2), rel=1e-14)


# ---- images


def density(dgm, sigma, births, lengths):
    """The density of the bars at each (birth, length); the rows of the result are lengths."""
    x = (births - dgm[:, :1]) / sigma
    y = (lengths - (dgm[:, 1:] - dgm[:, :1])) / sigma
    return np.einsum("nl,nb->lb", np.exp(-y**2 / 2), np.exp(-x**2 / 2)) / (2 * math.pi * sigma**2)


def test_images_of_gudhi(dgm):
    """GUDHI computes densities at evenly spaced points. The first and the last point are the ends
    of a range. If the range is extended by half a step at each end, the points are the centres of
    its pixels."""
    sigma, (b, p), (low, high), longest = 0.2, (7, 5), (-1.0, 1.0), 2.0
    points = np.linspace(low, high, b), np.linspace(0, longest, p)
    step = (high - low) / (b - 1), longest / (p - 1)
    image = PersistenceImage(
        sigma, (b, p), (low - step[0] / 2, high + step[0] / 2), (-step[1] / 2, longest + step[1] / 2),
        weight_power=0, pixel="density")
    assert np.allclose(of(image, dgm).reshape(p, b), density(dgm, sigma, *points), rtol=1e-12)


def test_an_integral_is_a_density_times_an_area(dgm):
    """GUDHI's pixels agree with ours to second order in the width of a pixel."""
    how = {"bandwidth": 0.2, "birth_range": (-1, 1), "persistence_range": (0, 2)}
    errors = []
    for pixels in (20, 40):
        area = (2 / pixels) ** 2
        integral = of(PersistenceImage(resolution=pixels, **how), dgm)
        at_centres = of(PersistenceImage(resolution=pixels, pixel="density", **how), dgm) * area
        errors.append(np.abs(integral - at_centres).max() / at_centres.max())
    assert errors[0] < 0.02 and errors[1] == pytest.approx(errors[0] / 4, rel=0.1)


def test_images_of_persim(dgm):
    """persim integrates; its weight is the length, its rows are births, and its sigma is a
    variance."""
    variance, edges_b, edges_p = 0.04, np.linspace(-1, 1, 11), np.linspace(0, 2, 11)
    phi = np.vectorize(lambda x: 0.5 * (1 + math.erf(x / math.sqrt(2 * variance))))
    lengths = dgm[:, 1] - dgm[:, 0]
    along_b = np.diff(phi(edges_b - dgm[:, :1]), axis=1)
    along_p = np.diff(phi(edges_p - lengths[:, None]), axis=1)
    expected = np.einsum("n,nb,np->bp", lengths, along_b, along_p)
    image = PersistenceImage(math.sqrt(variance), 10, (-1, 1), (0, 2), orientation="births")
    assert np.allclose(of(image, dgm).reshape(10, 10), expected, rtol=1e-11, atol=1e-14)


def blurred(counts, sigma):
    """Blurs the counts along both axes with a discrete normal distribution that is cut off at 4
    sigma and sums to 1."""
    reach = int(4 * sigma + 0.5)
    weights = np.exp(-np.arange(-reach, reach + 1)**2 / (2 * sigma**2))
    weights /= weights.sum()
    for axis in (0, 1):
        counts = np.apply_along_axis(lambda row: np.convolve(row, weights, "same"), axis, counts)
    return counts


def test_images_of_giotto(rng):
    """giotto-tda counts bars at points, including both ends of a range, and blurs the counts; the
    top row has the longest bars. For bars exactly at these points, the result is the density,
    except beyond 4 sigma."""
    n, sigma, low, step = 60, 0.15, -1.0, 0.05
    places = rng.integers(20, 40, (12, 2))  # far from the border
    counts = np.zeros((n, n))
    for birth, length in places:
        counts[length, birth] += 1
    expected = blurred(counts, sigma / step)[::-1] / step**2
    births, lengths = low + places[:, 0] * step, places[:, 1] * step
    image = PersistenceImage(sigma, n, (low - step / 2, low + (n - 0.5) * step),
                             (-step / 2, (n - 0.5) * step), weight_power=0, pixel="density",
                             orientation="descending")
    found = of(image, np.column_stack([births, births + lengths])).reshape(n, n)
    assert np.abs(found - expected).max() < 5e-4 * expected.max()


# ---- ATOL, kernels


@pytest.mark.parametrize("ours, theirs", [("gauss", "gaussian"), ("laplace", "laplacian")])
def test_atol_of_gudhi(dgm, ours, theirs):
    """For the same centres, both packages compute the same sums. Their quantisers may find
    different centres."""
    fitted = Atol(centres=5, contrast=ours).fit([dgm])
    centres, = fitted.centres_
    between = np.array([[math.dist(c, d) for d in centres] for c in centres])
    inertias = np.array([min(row[row > 0]) for row in between]) / 2
    distances = np.array([[math.dist(bar, c) for c in centres] for bar in dgm])
    ratio = distances / inertias
    expected = np.exp(-ratio if theirs == "laplacian" else -ratio**2).sum(axis=0)
    assert np.allclose(fitted.transform([dgm])[0], expected, rtol=1e-12)


def gauss_sum(a, b, weights_a, weights_b, bandwidth):
    squares = ((a[:, None] - b)**2).sum(axis=2)
    return weights_a @ np.exp(-squares / (2 * bandwidth**2)) @ weights_b / (
        math.sqrt(2 * math.pi) * bandwidth)


def test_scale_space_kernel_of_gudhi(dgm):
    """GUDHI's kernel adds the mirror image of each diagram with weight -1, and takes half of the
    sum. It equals ours with sigma = bandwidth² / 4, up to a constant factor."""
    other = dgm[::2] + [0.03, 0.08]
    bandwidth = 0.7
    sides = [np.concatenate([bars, bars[:, ::-1]]) for bars in (dgm, other)]
    signs = [np.where(bars[:, 0] < bars[:, 1], 1.0, -1.0) for bars in sides]
    expected = gauss_sum(*sides, *signs, bandwidth) / 2
    sigma = bandwidth**2 / 4
    ours = ph.diagram_kernels([dgm], [other], sigma=sigma)[0, 0]
    factor = math.sqrt(2 * math.pi) * bandwidth
    assert ours * factor == pytest.approx(expected, rel=1e-12)


def test_heat_of_persim(dgm):
    """persim computes the distance that the kernel of Reininghaus et al. induces."""
    def kernel(a, b):
        return sum(math.exp(-math.dist(p, q)**2 / 3.2) - math.exp(-math.dist(p, q[::-1])**2 / 3.2)
                   for p in a for q in b) / (3.2 * math.pi)
    a, b = dgm, dgm[::2] + [0.03, 0.08]
    expected = math.sqrt(kernel(a, a) + kernel(b, b) - 2 * kernel(a, b))
    k = ph.diagram_kernels([a, b], sigma=0.4)
    assert (k[0, 0] + k[1, 1] - 2 * k[0, 1])**0.5 == pytest.approx(expected, rel=1e-10)


def test_weighted_gaussian_kernel_of_gudhi(dgm):
    """GUDHI's kernel with the weight arctan(slope · length^power) equals ours up to a factor."""
    weights = np.arctan(2 * (dgm[:, 1] - dgm[:, 0])**1.5)
    expected = gauss_sum(dgm, dgm[::3], weights, weights[::3], 0.7)
    ours = ph.diagram_kernels([dgm], [dgm[::3]], kernel="weighted_gaussian", sigma=0.7, slope=2,
                              power=1.5)[0, 0]
    assert ours / (math.sqrt(2 * math.pi) * 0.7) == pytest.approx(expected, rel=1e-12)
