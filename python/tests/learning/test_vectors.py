# SPDX-License-Identifier: MIT
"""Compares vectors of diagrams with plain loops over bars."""
import math
import statistics

import numpy as np
import pytest

import libph as ph
from libph import _vectors
from libph._vectors import _functions, _ranges

EMPTY = np.empty((0, 2))


@pytest.fixture(params=[0, 1, 7, 40])
def dgm(request, rng):
    # Rounding creates equal values, which are tested as well.
    births = rng.uniform(-1, 1, request.param).round(1)
    return np.column_stack([births, births + rng.uniform(0, 2, request.param).round(1)])


# ---- loops, each by the definition


def plain_landscape(dgm, k, t):
    tents = sorted((max(0.0, min(t - b, d - t)) for b, d in dgm), reverse=True)
    return tents[k] if k < len(tents) else 0.0


def plain_image(dgm, bandwidth, resolution, births, lengths, power):
    pixels = [[0.0] * resolution[0] for _ in range(resolution[1])]
    width = (births[1] - births[0]) / resolution[0]
    height = (lengths[1] - lengths[0]) / resolution[1]
    for b, d in dgm:
        along_births = statistics.NormalDist(b, bandwidth).cdf
        along_lengths = statistics.NormalDist(d - b, bandwidth).cdf
        for i in range(resolution[1]):
            low = lengths[0] + i * height
            for j in range(resolution[0]):
                left = births[0] + j * width
                pixels[i][j] += (d - b)**power * (
                    along_births(left + width) - along_births(left)) * (
                    along_lengths(low + height) - along_lengths(low))
    return np.array(pixels)


def plain_entropy(dgm):
    lengths = [d - b for b, d in dgm if d > b]
    return -sum(x / sum(lengths) * math.log(x / sum(lengths)) for x in lengths)


def plain_silhouette(dgm, power, t):
    weights = [(d - b)**power for b, d in dgm if d > b]
    tents = [max(0.0, min(t - b, d - t)) for b, d in dgm if d > b]
    return sum(map(math.prod, zip(weights, tents))) / sum(weights) if weights else 0.0


def plain_life_entropy(dgm, t):
    total = sum(d - b for b, d in dgm)
    return -sum((d - b) / total * math.log((d - b) / total) for b, d in dgm if b <= t < d)


def plain_statistics(dgm):
    """Statistics computed with NumPy, in the order of their names."""
    dgm = dgm[dgm[:, 0] < dgm[:, 1]]
    if not len(dgm):
        return [0.0] * 38
    births, deaths = dgm.T
    numbers = []
    for values in (births, deaths, (births + deaths) / 2, deaths - births):
        p10, p25, p75, p90 = np.percentile(values, [10, 25, 75, 90])
        numbers += [values.mean(), values.std(), np.median(values), p75 - p25,
                    values.max() - values.min(), p10, p25, p75, p90]
    return [*numbers, len(dgm), plain_entropy(dgm)]


# ---- the functions


def test_landscape(dgm):
    found = _functions.landscape(dgm, 4, (-1.5, 3.5), 41)
    for k in range(4):
        for i, t in enumerate(np.linspace(-1.5, 3.5, 41)):
            assert found[k, i] == plain_landscape(dgm, k, t)


@pytest.mark.parametrize("power", [0, 1, 2.5])
def test_image(dgm, power):
    how = 0.3, (5, 4), (-1.5, 1.0), (0.0, 1.8), power
    expected = plain_image(dgm[dgm[:, 0] < dgm[:, 1]], *how)
    assert np.allclose(_functions.image(dgm, *how), expected, rtol=1e-12, atol=1e-14)


def test_image_is_an_integral():
    """Each pixel is the mean of the density over the pixel, times the pixel's area and the weight
    of the bar."""
    bar, width = np.array([[0.2, 1.1]]), 0.25
    (pixel,), = _functions.image(bar, width, (1, 1), (0.0, 0.5), (0.6, 1.2), 1)
    x, y = np.meshgrid((np.arange(400) + 0.5) / 800, 0.6 + (np.arange(400) + 0.5) * 0.6 / 400)
    density = np.exp(-((x - 0.2)**2 + (y - 0.9)**2) / (2 * width**2)) / (2 * math.pi * width**2)
    assert pixel == pytest.approx(0.9 * density.mean() * 0.5 * 0.6, rel=1e-5)


def test_image_far_from_its_bars():
    """The function may ignore only the part of a bar's density beyond eight standard deviations."""
    bars = np.array([[0.0, 1.0], [50.0, 51.0]])
    pixels = _functions.image(bars, 0.01, (2, 1), (-50.0, 50.5), (0.0, 2.0), 0)
    assert pixels.tolist() == [[pytest.approx(1, abs=2e-15), pytest.approx(1, abs=2e-15)]]
    assert _functions.image(bars, 0.01, (1, 1), (10.0, 40.0), (0.0, 2.0), 0)[0, 0] == 0


def test_betti_curve(dgm):
    # Each birth and each death is a value of the grid.
    found = _functions.betti_curve(dgm, (-1.5, 3.5), 51)
    grid = np.linspace(-1.5, 3.5, 51)
    assert found.tolist() == [sum(b <= t < d for b, d in dgm) for t in grid]


@pytest.mark.parametrize("power", [0, 1, 2.5])
def test_silhouette(dgm, power):
    found = _functions.silhouette(dgm, power, (-1.5, 3.5), 41)
    expected = [plain_silhouette(dgm, power, t) for t in np.linspace(-1.5, 3.5, 41)]
    assert np.allclose(found, expected, rtol=1e-12, atol=1e-14)


def test_life_entropy(dgm):
    found = _functions.life_entropy(dgm, (-1.5, 3.5), 41)
    expected = [plain_life_entropy(dgm, t) for t in np.linspace(-1.5, 3.5, 41)]
    assert np.allclose(found, expected, rtol=1e-12, atol=1e-14)


def test_entropy(dgm):
    assert _functions.entropy(dgm) == pytest.approx(plain_entropy(dgm), abs=1e-14)


def test_longest(dgm):
    lengths = sorted((d - b for b, d in dgm), reverse=True) + [0.0] * 10
    assert _functions.longest(dgm, 10).tolist() == lengths[:10]


def test_statistics(dgm):
    assert np.allclose(_functions.statistics(dgm), plain_statistics(dgm), rtol=1e-12, atol=1e-14)


def test_names_of_statistics():
    names = _functions.statistics_names()
    parts = ["mean", "sd", "median", "iqr", "range", "p10", "p25", "p75", "p90"]
    assert names == [*(f"{what}_{part}" for what in ("birth", "death", "midpoint", "length")
                       for part in parts), "count", "entropy"]


@pytest.mark.parametrize("contrast", ["laplace", "gauss"])
def test_atol(rng, contrast):
    dgms = [np.column_stack([b, b + rng.random(n)]) for n in (5, 0, 12) for b in [rng.random(n)]]
    centres, widths = _functions.fit_atol(dgms, 4, 0)
    assert centres.shape == (4, 2) and centres.tolist() == sorted(centres.tolist())
    apart = np.linalg.norm(centres[:, None] - centres, axis=2) + np.diag([np.inf] * 4)
    assert np.allclose(widths, apart.min(axis=1) / 2, rtol=1e-14)
    points = np.concatenate(dgms)  # k-means has converged if each centre is the mean of its points
    nearest = np.linalg.norm(points[:, None] - centres, axis=2).argmin(axis=1)
    assert np.allclose(centres, [points[nearest == k].mean(axis=0) for k in range(4)], rtol=1e-14)
    distances = np.linalg.norm(dgms[2][:, None] - centres, axis=2) / widths
    expected = np.exp(-distances if contrast == "laplace" else -distances**2).sum(axis=0)
    assert np.allclose(_functions.atol(dgms[2], centres, widths, contrast), expected, rtol=1e-13)
    again = _functions.fit_atol([dgm[::-1] for dgm in reversed(dgms)], 4, 0)
    assert np.array_equal(again[0], centres) and np.array_equal(again[1], widths)


def test_blocks_do_not_change_what_comes_out(monkeypatch, rng):
    dgm = np.sort(rng.random((60, 2)), axis=1)
    how = 0.1, (6, 5), (0.0, 1.0), (0.0, 1.0), 1, "density"
    image = _functions.image(dgm, *how)
    monkeypatch.setattr(_functions, "_BLOCK", 100)
    assert np.allclose(_functions.image(dgm, *how), image, rtol=1e-13, atol=0)


def test_arrays_of_any_steps(rng):
    """Rows that are not contiguous give the same result."""
    wide = np.sort(rng.random((80, 6)), axis=1)
    dgm = wide[::2, [1, 4]]
    for view in (wide[::2, 1:5:3], np.asfortranarray(dgm), dgm[::-1]):
        assert np.array_equal(_functions.landscape(view, 2, (0, 1), 9),
                              _functions.landscape(dgm, 2, (0, 1), 9))


def test_bars_of_length_0_do_not_count(dgm):
    longer = np.concatenate([dgm, [[0.3, 0.3], [2.5, 2.5]]])
    for vector in (_functions.statistics, _functions.entropy,
                   lambda bars: _functions.image(bars, 0.3, (3, 3), (-1, 3), (0, 2), 0),
                   lambda bars: _functions.image(bars, 0.3, (3, 3), (-1, 3), (0, 2), 0, "density"),
                   lambda bars: _functions.silhouette(bars, 0, (-1, 3), 9),
                   lambda bars: _ranges.ranges_of_image([bars], None, None)):
        assert np.array_equal(vector(longer), vector(dgm))


# ---- bars that never die


ENDLESS = np.array([[0.0, 1.0], [0.5, np.inf]])


def test_bars_that_never_die():
    def settle(infinity):
        return _vectors.settled(ENDLESS, infinity, "x").tolist()

    assert settle("drop") == [[0, 1]] and settle(2.0) == [[0, 1], [0.5, 2]]
    assert settle("keep") == ENDLESS.tolist()
    with pytest.raises(ph.UsageError, match="x: row 1: found a bar that never dies"):
        settle("error")
    with pytest.raises(ph.UsageError, match="at least 0.5, the birth"):
        settle(0.25)
    assert _vectors.settled(ENDLESS[:1], "error", "x").tolist() == [[0, 1]]


def test_a_bar_that_never_dies_on_a_grid():
    grid = (0.0, 2.0), 5
    assert _functions.betti_curve(ENDLESS, *grid).tolist() == [1, 2, 1, 1, 1]
    assert _functions.landscape(ENDLESS, 1, *grid).tolist() == [[0, 0.5, 0.5, 1, 1.5]]


@pytest.mark.parametrize("infinity", ["keep", "all", None, np.nan, np.inf, True])
def test_words_for_infinity(infinity):
    with pytest.raises(ph.UsageError, match="infinity: found"):
        _vectors.checked_infinity(infinity, may_keep=False)


def test_drop_leaves_out_what_begins_at_minus_infinity(tmp_path):
    path = tmp_path / "bars.csv"
    path.write_text("dim,birth,death\n0,-inf,inf\n0,-inf,3\n0,0,1\n")
    bars = ph.read_barcode(path)
    assert bars.statistics(0, infinity="drop")["count"] == 1
    assert bars.landscape(0, layers=1, range=(0, 1), resolution=3, infinity="drop").tolist() == [
        [0, 0.5, 0]]
    with pytest.raises(ph.DataError, match="found birth -inf"):
        bars.landscape(0, infinity="keep")


# ---- diagrams and ranges


@pytest.mark.parametrize("data, words", [
    ([[1, 0]], "row 0: found birth 1.0 and death 0.0, expected birth <= death"),
    ([[0, 1], [np.nan, 1]], "row 1: found birth nan"),
    ([[-np.inf, 1]], "row 0: found birth -inf, expected a finite number"),
    ([[0, 1, 2]], r"found an array of shape \(1, 3\), expected rows \(birth, death\)"),
    ([0, 1], r"found an array of shape \(2,\)"),
])
def test_what_is_no_diagram(data, words):
    with pytest.raises(ph.Error, match=f"x: {words}"):
        _vectors.as_diagram(data, "x")


def test_ranges():
    assert _ranges.range_of_values([EMPTY]) == (0, 1)
    assert _ranges.range_of_values([EMPTY, ENDLESS]) == (0, 1)
    # A bar of length 0 does not count.
    assert _ranges.range_of_values([np.array([[3.0, 3.0]])]) == (0, 1)
    assert _ranges.range_of_values([np.array([[3.0, np.inf]])]) == (2.5, 3.5)
    assert _ranges.ranges_of_image([EMPTY], None, None) == ((0, 1), (0, 1))
    births, lengths = _ranges.ranges_of_image([np.array([[0.0, 1.0], [0.0, 4.0]])], None, None)
    # All births are 0: the range of births is as wide as the range of lengths.
    assert lengths == (0, 4) and births == (-2, 2)
    assert _ranges.ranges_of_image([np.array([[1.0, 2.0]])], (0, 3), (0, 5)) == ((0, 3), (0, 5))
    low, high = _ranges.widened(1e300, 1e300)
    assert low < 1e300 < high


@pytest.mark.parametrize("value", [(0, 0), (1, 0), (0, np.inf), (0,), 3, "ab", (0, np.nan)])
def test_what_is_no_range(value):
    with pytest.raises(ph.UsageError, match="r: found"):
        _ranges.checked_range("r", value)


# ---- methods of barcodes


@pytest.fixture(scope="module")
def bars():
    return ph.rips(np.random.default_rng(3).random((30, 2)))


def test_of_a_barcode(bars):
    dgm = bars.dgm(1)
    image = bars.image(1, bandwidth=0.1, resolution=(4, 3), birth_range=(0, 0.5),
                       persistence_range=(0, 0.3), weight_power=2)
    assert np.allclose(image, plain_image(dgm, 0.1, (4, 3), (0, 0.5), (0, 0.3), 2), rtol=1e-12)
    landscape = bars.landscape(1, layers=2, resolution=9, range=(0, 1))
    assert landscape.shape == (2, 9)
    assert landscape[0, 3] == plain_landscape(dgm, 0, 3 / 8)
    silhouette = bars.silhouette(1, power=2, resolution=9, range=(0, 1))
    assert silhouette[3] == pytest.approx(plain_silhouette(dgm, 2, 3 / 8), rel=1e-12)
    life = bars.life_entropy(1, resolution=9, range=(0, 1))
    assert life[3] == pytest.approx(plain_life_entropy(dgm, 3 / 8), rel=1e-12)
    numbers = bars.statistics(1)
    assert list(numbers) == _functions.statistics_names()
    assert np.allclose(list(numbers.values()), plain_statistics(dgm), rtol=1e-12, atol=1e-14)
    assert bars.entropy(1) == pytest.approx(plain_entropy(dgm))
    assert bars.entropy(0) == pytest.approx(plain_entropy(bars.dgm(0)[:-1]))


def test_ranges_of_a_barcode_are_its_own(bars):
    dgm = bars.dgm(1)
    births = dgm[:, 0].min(), dgm[:, 0].max()
    lengths = 0, (dgm[:, 1] - dgm[:, 0]).max()
    width = max(births[1] - births[0], lengths[1]) / 20
    assert np.array_equal(bars.image(1), bars.image(
        1, bandwidth=width, birth_range=births, persistence_range=lengths))
    assert np.array_equal(bars.landscape(1), bars.landscape(1, range=(dgm.min(), dgm.max())))
    assert not bars.landscape(1)[0, [0, -1]].any() and bars.landscape(1).shape == (5, 100)


def test_a_barcode_with_a_bar_that_never_dies(bars):
    with pytest.raises(ph.UsageError, match="bars: row 29: found a bar that never dies"):
        bars.image(0)
    assert bars.image(0, infinity="drop").sum() > 0
    assert bars.landscape(0, range=(0, 10), resolution=2)[0].tolist() == [0, 10]
    assert bars.landscape(0, range=(0, 10), resolution=2, infinity="drop")[0].tolist() == [0, 0]


@pytest.mark.parametrize("how", [
    {"bandwidth": 0}, {"bandwidth": -1}, {"resolution": 0}, {"resolution": (1, 2, 3)},
    {"weight_power": -1}, {"weight_power": np.inf}, {"birth_range": (1, 0)},
    {"persistence_range": 3}, {"infinity": "keep"}, {"pixel": "centre"}, {"orientation": "up"}])
def test_options_of_an_image(bars, how):
    with pytest.raises(ph.UsageError, match=next(iter(how))):
        bars.image(1, **how)


@pytest.mark.parametrize("how", [{"layers": 0}, {"resolution": 0}, {"range": (0, 0)},
                                 {"infinity": "all"}, {"height": "gudhi"}])
def test_options_of_a_landscape(bars, how):
    with pytest.raises(ph.UsageError, match=next(iter(how))):
        bars.landscape(1, **how)


@pytest.mark.parametrize("method, how", [
    ("silhouette", {"power": -1}), ("silhouette", {"height": 2}), ("silhouette", {"infinity": "keep"}),
    ("silhouette", {"resolution": 0}), ("life_entropy", {"unit": "bit"}),
    ("life_entropy", {"normalised": 1}), ("life_entropy", {"unit": "bits", "normalised": True}),
    ("entropy", {"unit": "e"}), ("entropy", {"normalised": True}),
    ("entropy", {"unit": "bits", "normalised": "count"}), ("exact_landscape", {"layers": 0}),
    ("exact_landscape", {"height": None}), ("statistics", {"infinity": "keep"})])
def test_options_of_others(bars, method, how):
    with pytest.raises(ph.UsageError, match=next(iter(how))):
        getattr(bars, method)(1, **how)


def test_an_entropy_that_has_no_norm():
    bars = ph.rips([[0], [0.25], [1]])  # bars of lengths 0.25 and 0.75
    with pytest.raises(ph.DataError, match="normalised: found bars whose lengths add up to 1"):
        bars.entropy(0, normalised="total")
    assert ph.rips([[0], [1]]).entropy(0, normalised="total") == 0


def test_numbers_that_are_too_large():
    with pytest.raises(ph.DataError, match="choose a larger unit"):
        ph.rips([[0.0], [1e150]]).silhouette(0, infinity="drop")


def test_of_no_bars():
    none = ph.rips(np.zeros((1, 2)))
    assert not none.image(1).any() and not none.landscape(1).any()
    assert not any(none.statistics(1).values()) and not none.silhouette(1).any()
    assert not none.life_entropy(1).any() and none.exact_landscape(1) == []


# ---- another program


def test_beside_gudhi(dgm):
    """GUDHI's landscapes equal ours times √2."""
    theirs = pytest.importorskip("gudhi.representations", reason="GUDHI is missing")
    if not len(dgm):
        pytest.skip("GUDHI 3.7 fails without bars")
    landscapes = theirs.Landscape(num_landscapes=3, resolution=33, sample_range=[-1, 3])(dgm)
    assert np.allclose(landscapes, _functions.landscape(dgm, 3, (-1, 3), 33).ravel() * math.sqrt(2))
    assert np.isclose(theirs.Entropy()(dgm)[0], _functions.entropy(dgm))
