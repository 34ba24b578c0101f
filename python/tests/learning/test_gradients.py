# SPDX-License-Identifier: MIT
"""Compares gradients of births and deaths with finite differences of recomputed barcodes."""
import functools

import numpy as np
import pytest
import scipy.sparse
import scipy.spatial

import libph as ph
from libph.gradients import deciders, pullback

STEP = 1e-6


def differences(barcode, X, d_births, d_deaths):
    """The gradient of sum(d * births) + sum(d * deaths) by finite differences, one coordinate at a
    time."""

    def total(Y):
        bars = barcode(Y)
        assert len(bars) == len(d_births)
        dies = np.isfinite(bars.deaths)
        return d_births @ bars.births + d_deaths[dies] @ bars.deaths[dies]

    gradient = np.zeros(X.shape)
    for place in np.ndindex(X.shape):
        Y = X.copy()
        Y[place] += STEP
        above = total(Y)
        Y[place] -= 2 * STEP
        gradient[place] = (above - total(Y)) / (2 * STEP)
    return gradient


def check(barcode, X, rng, **how):
    bars = barcode(X)
    d_births, d_deaths = rng.standard_normal((2, len(bars)))
    d_deaths[np.isinf(bars.deaths)] = 0
    found = pullback(bars, X, d_births, d_deaths, **how)
    expected = differences(barcode, X, d_births, d_deaths)
    assert found.shape == X.shape and found.dtype == np.float64
    assert np.abs(expected).max() > 0.1
    assert np.allclose(found, expected, atol=1e-7)
    return bars


# ---- points


@pytest.mark.parametrize("how", [
    {}, {"max_dim": 2}, {"metric": "manhattan"}, {"metric": "chebyshev"}, {"metric": "cosine"},
    {"metric": "minkowski", "minkowski_p": 3.0}, {"metric": "minkowski", "minkowski_p": 1.0},
    {"metric": "minkowski", "minkowski_p": np.inf}, {"threshold": 0.6}, {"subsample": 12},
    {"collapse": True}, {"collapse": False}, {"field": 3}, {"min_persistence": -1.0},
    {"engine": "cohomology"}, {"engine": "twist"}, {"max_dim": 0}, {"min_dim": 1}], ids=str)
def test_points(rng, how):
    bars = check(functools.partial(ph.rips, **how), rng.random((18, 3)), rng)
    assert how.get("max_dim") == 0 or (bars.dims == 1).any()


def test_hollows_have_gradients(rng):
    points = rng.standard_normal((25, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    bars = check(functools.partial(ph.rips, max_dim=2), points, rng)
    assert (bars.dims == 2).any()


@pytest.mark.parametrize("exponent", [1, 2, np.inf])
def test_weights(rng, exponent):
    X, weights = rng.random((20, 2)), rng.uniform(0, 0.4, 20)
    barcode = functools.partial(ph.rips, weights=weights, weight_exponent=exponent)
    check(barcode, X, rng, weights=weights)
    with pytest.raises(ph.UsageError, match="weights: found none"):
        pullback(barcode(X), X)


@pytest.mark.parametrize("exponent", [1, 2, np.inf])
@pytest.mark.parametrize("metric", ["euclidean", "manhattan"])
def test_births_that_are_distances_to_a_measure(rng, exponent, metric):
    X = rng.random((20, 2))
    check(functools.partial(ph.rips, weights="dtm", dtm_neighbors=4, weight_exponent=exponent,
                            metric=metric), X, rng)


def test_points_that_are_left_out(rng):
    X = rng.random((15, 2))
    X[[3, 7], 0] = np.nan
    bars = ph.rips(X, nan="drop")
    whole = np.delete(X, [3, 7], axis=0)
    d = np.where(np.isfinite(bars.deaths), rng.standard_normal(len(bars)), 0)
    found = pullback(bars, X, d_deaths=d)
    assert not found[[3, 7]].any()
    assert np.array_equal(np.delete(found, [3, 7], axis=0),
                          pullback(ph.rips(whole), whole, d_deaths=d))


def test_some_of_the_bars(rng):
    X = rng.random((20, 2))
    bars = ph.rips(X)
    d = rng.standard_normal(len(bars)) * np.isfinite(bars.deaths)
    is_long = bars.deaths - bars.births > 0.1
    some = bars.filter(min_persistence=0.1)
    assert 0 < len(some) < len(bars)
    assert np.allclose(pullback(some, X, d_deaths=d[is_long]), pullback(bars, X, d_deaths=d * is_long))


def test_far_points(rng):
    """The squares of the distances between far points would overflow."""
    X = rng.random((8, 2))
    d = np.array([1.0] * 7 + [0])
    small = pullback(ph.rips(X, max_dim=0), X, d_deaths=d)
    assert np.allclose(pullback(ph.rips(X * 1e200, max_dim=0), X * 1e200, d_deaths=d), small)


# ---- distances


@pytest.fixture
def distances(rng):
    return scipy.spatial.distance.squareform(rng.uniform(0.5, 1.0, 14 * 13 // 2))


@pytest.mark.parametrize("scale", [1e200, 1e-200])
@pytest.mark.parametrize("how", [
    {"weights": True, "weight_exponent": 2}, {"weights": True, "weight_exponent": 1},
    {"weights": "dtm", "dtm_neighbors": 3},
    {"weights": "core", "core_neighbors": 2},
    {"weights": "dtm", "dtm_neighbors": 3, "weight_exponent": 2}], ids=str)
def test_a_gradient_is_the_same_at_any_scale(rng, how, scale):
    X, weights = rng.standard_normal((14, 2)), rng.random(14)
    found = []
    for unit in (1, scale):
        given = weights * unit if how["weights"] is True else how["weights"]
        bars = ph.rips(X * unit, **{**how, "weights": given})
        beside = {"weights": given} if how["weights"] is True else {}
        found.append(pullback(bars, X * unit, np.ones(len(bars)), np.isfinite(bars.deaths),
                              **beside))
    assert np.abs(found[0]).max() > 0.1 and np.allclose(found[0], found[1], rtol=1e-9)


def test_condensed_distances(rng, distances):
    check(functools.partial(ph.rips, metric="precomputed"),
          scipy.spatial.distance.squareform(distances), rng)


@pytest.mark.parametrize("dtm", [{}, {"weights": "dtm", "dtm_neighbors": 3}])
def test_a_matrix(rng, distances, dtm):
    """The two entries of a symmetric pair change together, and each gets half of the derivative."""
    barcode = functools.partial(ph.rips, metric="precomputed", **dtm)
    bars = barcode(distances)
    d = rng.standard_normal(len(bars)) * np.isfinite(bars.deaths)
    found = pullback(bars, distances, d_deaths=d)
    assert np.allclose(found, found.T, rtol=1e-12) and not np.diagonal(found).any()
    condensed = scipy.spatial.distance.squareform(distances)
    expected = differences(barcode, condensed, np.zeros(len(bars)), d)
    assert np.allclose(2 * found[np.triu_indices(14, 1)], expected, atol=1e-7)
    assert np.allclose(pullback(barcode(condensed), condensed, d_deaths=d), expected, atol=1e-7)


def test_a_matrix_of_float32(rng, distances):
    single = distances.astype(np.float32)
    bars = ph.rips(single, metric="precomputed")
    found = pullback(bars, single, d_births=np.ones(len(bars)))
    assert found.dtype == np.float64 and found.sum() == pytest.approx((bars.dims == 1).sum())


def test_births_on_a_diagonal(rng, distances):
    births = rng.uniform(0, 0.8, len(distances))
    np.fill_diagonal(distances, births)
    barcode = functools.partial(ph.rips, metric="precomputed", diagonal="births")
    bars = barcode(distances)
    d_births = rng.standard_normal(len(bars))
    found = pullback(bars, distances, d_births)

    def with_births(b):
        changed = distances.copy()
        np.fill_diagonal(changed, b)
        return barcode(changed)

    expected = differences(with_births, births, d_births, np.zeros(len(bars)))
    assert np.allclose(np.diagonal(found), expected, atol=1e-7) and np.abs(expected).max() > 0.1
    sparse = scipy.sparse.coo_matrix(distances)
    assert np.allclose(pullback(barcode(sparse), sparse, d_births).toarray(), found)


@pytest.mark.parametrize("kind", ["csr", "coo", "csc"])
@pytest.mark.parametrize("one_triangle", [False, True])
def test_sparse_distances(rng, distances, kind, one_triangle):
    dense = np.where(distances < 0.9, distances, 0)
    sparse = scipy.sparse.coo_matrix(np.triu(dense) if one_triangle else dense).asformat(kind)
    bars = ph.rips(sparse, metric="precomputed")
    d = rng.standard_normal(len(bars)) * np.isfinite(bars.deaths)
    found = pullback(bars, sparse, d_deaths=d)
    assert scipy.sparse.issparse(found) and found.nnz == sparse.nnz
    condensed = scipy.spatial.distance.squareform(dense)
    stored = np.flatnonzero(condensed)

    def barcode(values):
        changed = condensed.copy()
        changed[stored] = values
        upper = np.triu(scipy.spatial.distance.squareform(changed))
        return ph.rips(scipy.sparse.coo_matrix(upper), metric="precomputed")

    expected = np.zeros(len(condensed))
    expected[stored] = differences(barcode, condensed[stored], np.zeros(len(bars)), d)
    whole = found.toarray()
    both = whole if one_triangle else whole + whole.T
    assert np.allclose(np.triu(both), np.triu(scipy.spatial.distance.squareform(expected)), atol=1e-7)
    assert one_triangle or np.array_equal(whole, whole.T)


# ---- images and others


@pytest.mark.parametrize("construction", ["vertices", "cells"])
@pytest.mark.parametrize("superlevel", [False, True])
@pytest.mark.parametrize("shape, periodic", [
    ((40,), ()), ((6, 7), ()), ((6, 7), (1,)), ((6, 7), True), ((4, 3, 5), ()), ((4, 3, 5), (0, 2)),
    ((3, 2, 3, 3), ()), ((1, 9), ()), ((2, 9), (0,))])
def test_images(rng, construction, superlevel, shape, periodic):
    barcode = functools.partial(ph.cubical, construction=construction, superlevel=superlevel,
                                periodic=periodic, min_persistence=-1.0)
    bars = check(barcode, rng.permutation(np.prod(shape)).reshape(shape) / np.prod(shape), rng)
    assert len(bars) > 3


def test_layouts_of_images(rng):
    image = rng.permutation(42).reshape(6, 7)
    expected = None
    for one in (image.astype(np.uint8), image.astype(float), np.asfortranarray(image),
                image.tolist(), image.astype(np.int64)):
        bars = ph.cubical(one)
        found = pullback(bars, one, d_births=np.arange(len(bars)))
        assert expected is None or np.array_equal(found, expected)
        expected = found
    assert expected.sum() == np.arange(len(bars)).sum()


def test_an_image_with_holes(rng):
    image = rng.random((6, 7))
    image[rng.random((6, 7)) < 0.3] = np.nan
    for construction in ("vertices", "cells"):
        check(functools.partial(ph.cubical, nan="drop", construction=construction), image, rng)
    points = ph.point_image(rng.random((30, 2)), 0.2, value="density")
    bars = ph.cubical(points)
    assert pullback(bars, points, d_births=np.ones(len(bars))).sum() == len(bars)


def test_vertices_of_a_mesh(rng):
    points = rng.random((40, 2))
    triangles = scipy.spatial.Delaunay(points).simplices
    check(lambda values: ph.lower_star(values, triangles), rng.random(40), rng)


def test_cells_of_a_complex(rng):
    """Each cell has its own value, for example an edge that closes a loop and a triangle that fills
    it."""
    edges = [(0, 1), (0, 2), (1, 2)]
    matrix = np.zeros((7, 7), dtype=int)
    for k, (u, v) in enumerate(edges):
        matrix[u, 3 + k], matrix[v, 3 + k] = -1, 1
    matrix[[3, 4, 5], 6] = [1, -1, 1]
    values = np.array([0, 0.1, 0.2, 1, 2, 3, 5])
    check(lambda v: ph.boundary(scipy.sparse.csc_matrix(matrix), [0, 0, 0, 1, 1, 1, 2], v), values,
          rng)


# ---- ties


def test_ties_of_points():
    """For a square, the loop is born at one of four equal sides and dies at one of two equal
    diagonals."""
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    bars = ph.rips(square).filter(dim=1)
    births, deaths = deciders(bars, square)
    assert tuple(sorted(births[0])) in {(0, 1), (1, 2), (2, 3), (0, 3)}
    assert tuple(sorted(deaths[0])) in {(0, 2), (1, 3)}
    found = pullback(bars, square, d_deaths=[1])
    i, j = deaths[0]
    assert np.allclose(found[i], (square[i] - square[j]) / 2**0.5) and np.allclose(found[j], -found[i])
    assert np.count_nonzero(found.any(axis=1)) == 2


def test_equal_points_have_no_direction():
    X = np.zeros((3, 2))
    bars = ph.rips(X, max_dim=0, min_persistence=-1, merge_equal_points=False)
    assert len(bars) == 3
    found = pullback(bars, X, d_deaths=[1, 1, 0])
    assert not found.any()


def test_ties_of_pixels():
    bars = ph.cubical(np.zeros((3, 3)), min_persistence=-1)
    assert pullback(bars, np.zeros((3, 3)), d_births=np.ones(len(bars))).sum() == len(bars)


# ---- deciders


def test_deciders(rng):
    X = rng.random((20, 2))
    bars = ph.rips(X)
    births, deaths = deciders(bars, X)
    lengths = scipy.spatial.distance.squareform(scipy.spatial.distance.pdist(X))
    assert np.allclose(lengths[tuple(births.T)], bars.births)
    dies = np.isfinite(bars.deaths)
    assert np.allclose(lengths[tuple(deaths[dies].T)], bars.deaths[dies])
    assert (deaths[~dies] == -1).all() and deaths.shape == (len(bars), 2)

    image = rng.random((5, 6))
    for superlevel in (False, True):
        bars = ph.cubical(image, superlevel=superlevel)
        births, deaths = deciders(bars, image)
        sign = -1 if superlevel else 1
        assert np.array_equal(sign * image[tuple(births.T)], bars.births)
        dies = np.isfinite(bars.deaths)
        assert np.array_equal(sign * image[tuple(deaths[dies].T)], bars.deaths[dies])

    values = rng.random(10)
    bars = ph.lower_star(values, [[i, i + 1] for i in range(9)])
    births, deaths = deciders(bars, values)
    assert np.array_equal(values[births[:, 0]], bars.births)

    weights = np.full(20, 5.0)  # so large that each bar is born with a point
    births, deaths = deciders(ph.rips(X, weights=weights), X, weights=weights)
    assert (births[:, 0] == births[:, 1]).all()


# ---- errors


def test_a_bar_that_never_dies(rng):
    X = rng.random((9, 2))
    bars = ph.rips(X, max_dim=0)
    for wrong in (1.0, np.nan):
        d = np.zeros(len(bars))
        d[-1] = wrong
        with pytest.raises(ph.UsageError, match=f"d_deaths: entry 8: found {wrong}, expected 0"):
            pullback(bars, X, d_deaths=d)


def test_other_data_than_those_of_the_barcode(rng):
    X = rng.random((12, 2))
    bars = ph.rips(X)
    for wrong, words in ((X + rng.random((12, 2)), "found the value .* of the cell"),
                         (X[:10], "found 10 points, expected 12"),
                         (X * 1.001, "the (birth|death) of its bar")):
        with pytest.raises(ph.DataError, match=words):
            pullback(bars, wrong, d_deaths=np.zeros(len(bars)))
    image = rng.random((4, 4))
    with pytest.raises(ph.DataError, match="the birth of its bar"):
        pullback(ph.cubical(image), image.T)
    with pytest.raises(ph.UsageError, match=r"of shape \(4, 3\), expected \(4, 4\)"):
        pullback(ph.cubical(image), image[:, :3])
    sparse = scipy.sparse.coo_matrix(np.triu(rng.random((6, 6)), 1))
    bars = ph.rips(sparse, metric="precomputed")
    with pytest.raises(ph.DataError, match="found no entry, expected one"):
        pullback(bars, scipy.sparse.coo_matrix((6, 6)))
    values = rng.random(5)
    bars = ph.lower_star(values, [[0, 4]])
    with pytest.raises(ph.UsageError, match="found an array of shape"):
        pullback(bars, values[:4])


@pytest.mark.parametrize("how, words", [
    ({"metric": "hamming"}, "found metric='hamming'"),
    ({"metric": lambda x, y: abs(x - y).sum()}, "found metric='function'"),
    ({"approximation": 0.5}, "found an approximation"), ({"cells": False}, "cells: found none")])
def test_what_cannot_be_differentiated(rng, how, words):
    X = rng.random((10, 2))
    with pytest.raises(ph.UsageError, match=words):
        pullback(ph.rips(X, **how), X)


def test_complexes_of_which_nothing_is_known(tmp_path):
    X = np.random.default_rng(0).random((10, 2))
    bars = ph.filtered([(0,), (1,), (0, 1)], [0, 0, 1])
    with pytest.raises(ph.UsageError, match="found a barcode of the complex 'explicit'"):
        pullback(bars, [0, 0, 1])
    ph.rips(X).save(tmp_path / "bars.csv")
    with pytest.raises(ph.UsageError, match="found a barcode of the complex"):
        pullback(ph.read_barcode(tmp_path / "bars.csv"), X)
    with pytest.raises(ph.UsageError, match="bars: found list, expected a Barcode"):
        pullback([], X)
    with pytest.raises(ph.UsageError, match="weights: do nothing"):
        pullback(ph.rips(X), X, weights=np.ones(10))
    with pytest.raises(ph.UsageError, match=r"d_births: .*expected .* numbers, one for each bar"):
        pullback(ph.rips(X), X, d_births=[1])


def test_stored_bars(tmp_path):
    X = np.random.default_rng(0).random((10, 2))
    bars = ph.rips(X)
    bars.save(tmp_path / "bars.json")
    np.testing.assert_array_equal(pullback(ph.read_barcode(tmp_path / "bars.json"), X),
                                  pullback(bars, X))


def test_no_bars():
    assert pullback(ph.rips(np.empty((0, 2))), np.empty((0, 2))).shape == (0, 2)
    assert pullback(ph.rips(np.ones((1, 3))), np.ones((1, 3)), d_births=[1]).tolist() == [[0, 0, 0]]
