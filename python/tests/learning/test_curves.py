# SPDX-License-Identifier: MIT
"""Compares Betti and Euler curves as step functions, and exact landscapes, with counts of cells and
bars."""
import itertools
import pickle
import threading

import numpy as np
import pytest

import libph as ph


@pytest.fixture(scope="module")
def bars():
    return ph.rips(np.random.default_rng(3).random((30, 2)), max_dim=2)


# ---- step functions


def test_a_betti_function_is_the_curve_at_any_value(bars):
    for dim in range(3):
        curve = bars.betti_function(dim)
        dgm = bars.dgm(dim)
        assert set(curve.at) <= set(dgm.ravel()) and np.all(np.diff(curve.at) > 0)
        assert np.all(np.diff(np.concatenate([[0], curve.value])) != 0)
        for t in [*curve.at, *(curve.at + 1e-9), -1.0, 1e9]:
            assert curve(t) == sum(b <= t < d for b, d in dgm)
        grid = np.linspace(-0.1, 1.5, 50)
        assert np.array_equal(curve(grid), bars.betti_curve(grid)[dim])
        assert curve(grid.reshape(5, 10)).shape == (5, 10)


def test_betti_curves_beyond_all_values(bars):
    assert bars.betti_curve([-np.inf, 1e300, np.inf]).tolist() == [
        [0, 1, 0], [0, 0, 0], [0, 0, 0]]


@pytest.mark.parametrize("t, words", [
    (np.nan, "t: found nan, expected a number"), ([0, np.nan], "t: entry 1: found nan"),
    ([[0, 1], [np.nan, 2]], "t: row 1, column 0: found nan"), ("hello", "t: found str"),
    (1j, "t: found complex numbers"), (None, "t: found NoneType")])
def test_functions_are_asked_for_numbers(t, words):
    bars = ph.rips([[0], [1], [3]])
    for function in (bars.betti_function(0), bars.exact_landscape(0, infinity="drop")[0]):
        with pytest.raises(ph.Error, match=words):
            function(t)
    with pytest.raises(ph.DataError, match="grid: entry 1: found nan, expected a number"):
        bars.betti_curve([0, np.nan])


def test_the_euler_curve_of_a_barcode_is_an_alternating_sum(bars):
    curve = bars.euler_curve()
    grid = np.concatenate([bars.births, bars.deaths[np.isfinite(bars.deaths)], [-1, 0.123, 7]])
    b0, b1, b2 = (bars.betti_function(dim)(grid) for dim in range(3))
    assert np.array_equal(curve(grid), b0 - b1 + b2)


def test_functions_are_values(bars):
    curve = bars.betti_function(0)
    again = pickle.loads(pickle.dumps(curve))
    assert again == curve and hash(again) == hash(curve) and curve != bars.betti_function(1)
    assert isinstance(curve(0.1), int) and repr(curve).startswith("StepFunction(")
    assert repr(ph.rips([[0]]).betti_function(1)) == "StepFunction(no changes)"
    with pytest.raises(ValueError, match="read-only"):
        curve.value[0] = 3
    with pytest.raises(AttributeError):
        curve.at = curve.value


# ---- Euler curves of images


def plain_euler(image, construction, t):
    """The Euler characteristic of a small image at the value t: counts the cells that are present,
    one by one."""
    cells = {}
    # The cells have doubled coordinates, in which an odd number stands for a unit interval.
    for corner in np.ndindex(*(2 * n + 1 for n in image.shape)):
        if construction == "vertices":
            # Coordinates in the doubled grid: even ones are voxels, and odd ones are the cells
            # between voxels. Cells after the last voxel do not exist.
            if any(c >= 2 * n - 1 for c, n in zip(corner, image.shape)):
                continue
            around = [(c // 2, c // 2 + 1) if c % 2 else (c // 2,) for c in corner]
            cells[corner] = max(image[voxel] for voxel in itertools.product(*around))
        else:
            around = [(c // 2,) if c % 2 else (c // 2 - 1, c // 2) for c in corner]
            there = [voxel for voxel in itertools.product(*around)
                     if all(0 <= i < n for i, n in zip(voxel, image.shape))]
            cells[corner] = min(image[voxel] for voxel in there)
    return sum((-1)**sum(c % 2 for c in corner) for corner, value in cells.items() if value <= t)


@pytest.mark.parametrize("construction", ["vertices", "cells"])
@pytest.mark.parametrize("shape", [(7,), (4, 5), (3, 2, 4), (2, 3, 2, 2)])
def test_images_by_counting_cells(rng, shape, construction):
    image = rng.integers(0, 6, shape)
    curve = ph.euler_curve(image, construction=construction)
    expected = [plain_euler(image, construction, t) for t in range(-1, 8)]
    assert curve(np.arange(-1, 8)).tolist() == expected
    grid = ph.euler_curve(image, construction=construction, range=(-1, 7), resolution=9)
    assert grid.tolist() == expected and grid.dtype == np.float64


@pytest.mark.parametrize("how", [
    {}, {"construction": "cells"}, {"superlevel": True}, {"periodic": [0]}, {"periodic": True},
    {"threshold": 3}, {"construction": "cells", "superlevel": True, "periodic": [1]}])
@pytest.mark.parametrize("dtype", ["u1", "i2", "f4", "f8", ">f8", "i8"])
def test_images_have_the_curve_of_their_barcode(rng, how, dtype):
    image = rng.integers(0, 6, (5, 6, 4)).astype(dtype)
    assert ph.euler_curve(image, **how) == ph.cubical(image, **how).euler_curve()


def test_other_layouts_and_holes(rng):
    image = rng.random((9, 8))
    expected = ph.euler_curve(image)
    for same in (np.asfortranarray(image), image[::-1, ::-1], image.T):
        assert ph.euler_curve(same) == expected
    image[2, 3] = np.nan
    assert ph.euler_curve(image, nan="drop") == ph.cubical(image, nan="drop").euler_curve()
    points = ph.point_image(rng.random((50, 2)), 0.2)
    assert ph.euler_curve(points) == ph.cubical(points).euler_curve()


def test_a_file_that_is_mapped(tmp_path, rng):
    image = rng.integers(0, 200, (20, 30), dtype=np.uint8)
    np.save(tmp_path / "image.npy", image)
    assert ph.euler_curve(np.load(tmp_path / "image.npy", mmap_mode="r")) == ph.euler_curve(image)


def test_threads_do_not_change_the_curve(rng):
    image = rng.random((40, 30, 20))
    curve = ph.euler_curve(image, threads=1)
    assert ph.euler_curve(image, threads=3) == curve == ph.cubical(image).euler_curve()


@pytest.mark.parametrize("how, words", [
    ({"resolution": 5}, "resolution: found 5, expected a range"), ({"range": (1, 0)}, "range: found"),
    ({"range": (0, 1), "resolution": 0}, "resolution: found 0"), ({"construction": "top"}, "top"),
    ({"periodic": [2]}, "periodic"), ({"superlevel": 1}, "superlevel"), ({"nan": "zero"}, "nan")])
def test_options_of_euler_curves(how, words):
    with pytest.raises(ph.UsageError, match=words):
        ph.euler_curve(np.ones((3, 3)), **how)


def test_words_of_euler_curves():
    with pytest.raises(ph.DataError, match="image: row 1, column 0: found nan.*nan='drop'"):
        ph.euler_curve([[0.0, 1.0], [np.nan, 2.0]])
    with pytest.raises(TypeError, match="euler_curve.. got an unexpected .*'max_dim'"):
        ph.euler_curve(np.ones((3, 3)), max_dim=1)
    stop = threading.Event()
    stop.set()
    with pytest.raises(ph.Cancelled):
        ph.euler_curve(np.random.default_rng(0).random((300, 300, 100)), stop=stop)


# ---- exact landscapes


def plain_tents(dgm, t):
    return sorted((max(0.0, min(t - b, d - t)) for b, d in dgm), reverse=True)


@pytest.mark.parametrize("count", [0, 1, 3, 40])
def test_exact_landscapes(rng, count):
    births = rng.random(count).round(2)
    dgm = np.column_stack([births, births + rng.random(count).round(2)])
    cells = [(i,) for i in range(count)] + [(i, count + i) for i in range(count)]
    vertices = [(count + i,) for i in range(count)]
    # Each bar is born at a vertex and dies at an edge.
    values = [*dgm[:, 0], *dgm[:, 1], *([-9.0] * count)]
    made = ph.filtered(cells + vertices, values)
    finite = made.dgm(0)[np.isfinite(made.dgm(0)[:, 1])] if count else dgm
    layers = made.exact_landscape(0, layers=50, infinity="drop")
    points = np.concatenate([*(layer.at for layer in layers), rng.random(100) * 2, [-1.0, 3.0]])
    for t in points:
        expected = plain_tents(finite, t)
        for k in range(max(len(layers), len(expected))):
            value = layers[k](t) if k < len(layers) else 0.0
            assert value == pytest.approx(expected[k] if k < len(expected) else 0, abs=1e-14)


def test_the_grid_of_a_landscape_has_values_of_the_exact_one(bars):
    exact = bars.exact_landscape(1, layers=4)
    values = bars.landscape(1, layers=4, resolution=50, range=(0, 1))
    grid = np.linspace(0, 1, 50)
    for k, layer in enumerate(exact):
        assert np.allclose(layer(grid), values[k], atol=1e-14)
        assert np.all(np.diff(layer.at) > 0)
    assert len(exact) == 4 or not values[len(exact):].any()
    assert repr(exact[0]).startswith("PiecewiseLinear(")
