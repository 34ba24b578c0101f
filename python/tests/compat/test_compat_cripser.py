# SPDX-License-Identifier: MIT
"""Tests what the drop-in for CubicalRipser promises. CubicalRipser itself is not needed."""
import numpy as np
import pytest

import libph as ph
from libph.compat import cripser, tcripser
from reference import Flag, sorted_rows

NEVER = np.finfo(float).max
RING = np.array([[9, 9, 9, 9, 9], [9, 1, 1, 1, 9], [9, 1, 7, 1, 9], [9, 1, 1, 1, 9],
                 [9, 9, 9, 9, 9.0]])


def dgm_of(rows, dim):
    return rows[rows[:, 0] == dim, 1:3]


def components(image, is_vertices):
    """H0 of the voxel graph. Each voxel is joined to its neighbours along the axes and, unless
    `is_vertices` is true, also to its diagonal neighbours."""
    places = list(np.ndindex(image.shape))
    n = len(places)
    distances = np.full((n, n), np.inf)
    for a, p in enumerate(places):
        for b, q in enumerate(places):
            steps = np.abs(np.subtract(p, q))
            if (steps.sum() if is_vertices else steps.max()) <= 1:
                distances[a, b] = max(image[p], image[q])
    return Flag(distances, image.ravel()).bars(0)[0]


@pytest.mark.parametrize("function, is_vertices", [(cripser.computePH, True),
                                                   (cripser.computePH_T, False)])
def test_rows(rng, function, is_vertices):
    for shape in ((9,), (4, 5), (3, 3, 3), (2, 3, 2, 2)):
        for image in (rng.random(shape), rng.integers(0, 3, shape).astype(float)):
            rows = function(image, maxdim=3)
            axes = len(shape)
            width = max(3, axes)
            assert rows.dtype == np.float64 and rows.shape[1] == 3 + 2 * width
            assert sorted(rows[:, 0]) == rows[:, 0].tolist()
            dgm = dgm_of(rows, 0)
            expected = components(image, is_vertices)
            assert np.array_equal(sorted_rows(dgm), np.where(expected == np.inf, NEVER, expected))
            assert (np.diff(dgm[:, 1]) >= 0).all() and dgm[-1, 1] == NEVER
            for dim in range(1, axes):
                assert (np.diff(dgm_of(rows, dim)[:, 0]) <= 0).all()
            for row in rows:
                born, killed = row[3:3 + width], row[3 + width:]
                assert image[tuple(born[:axes].astype(int))] == row[1]
                if row[2] < NEVER:
                    assert image[tuple(killed[:axes].astype(int))] == row[2]
                else:
                    assert not killed.any()
                assert not born[axes:].any() and not killed[axes:].any()
            assert len(set(map(tuple, rows[:, 3:3 + width][rows[:, 0] == 0]))) == len(dgm)


def test_known_answers():
    rows = cripser.computePH(RING)
    assert rows[:, :3].tolist() == [[0, 1, NEVER], [1, 1, 7]]
    assert rows[1, 6:].tolist() == [2, 2, 0] and RING[tuple(rows[1, 3:5].astype(int))] == 1
    diagonal = np.array([[0, 1], [1, 0.0]])
    assert len(cripser.computePH(diagonal)) == 2 and len(tcripser.computePH(diagonal)) == 1


@pytest.mark.parametrize("axes", [2, 3, 4])
def test_embedded_images_are_dual(rng, axes):
    """Alexander duality: H_k of an image in one construction equals H_(axes - 1 - k) of the
    embedded image in the other construction."""
    image = rng.random((6,) * axes)
    for one, other in ((cripser.computePH, tcripser.computePH),
                       (tcripser.computePH, cripser.computePH)):
        rows, dual = one(image, maxdim=3), other(image, maxdim=3, embedded=True)
        seen = 0
        for dim in range(axes):
            dgm, mirror = dgm_of(rows, dim), -dgm_of(dual, axes - 1 - dim)[:, ::-1]
            dgm, mirror = (d[(np.abs(d) < NEVER).all(axis=1)] for d in (dgm, mirror))
            assert np.array_equal(sorted_rows(dgm), sorted_rows(mirror))
            seen += len(dgm)
        assert seen > 3


def test_the_layer_around_an_embedded_image():
    rows = cripser.computePH(np.array([[1.0, 2], [3, 4]]), embedded=True)
    layer = rows[rows[:, 1] == -NEVER]
    assert layer[:, [0, 2]].tolist() == [[0, NEVER], [1, -1]]
    places = layer[:, 3:5]
    assert ((places == -1) | (places == 2)).any(axis=1).all()
    assert layer[1, 6:].tolist() == [0, 0, 0]


def test_a_third_axis_of_one_voxel_is_no_axis_of_the_layer(rng):
    for function in (cripser.computePH, tcripser.computePH):
        for shape in ((3, 4), (1, 4), (4, 1)):
            image = rng.random(shape)
            rows = function(image, embedded=True)
            assert np.array_equal(function(image[..., None], embedded=True), rows)
            four = function(image[..., None, None], embedded=True)
            assert np.array_equal(np.delete(four, (6, 10), axis=1), rows)
        assert dgm_of(function(np.ones((1, 3, 4)), embedded=True), 2).size


def test_dimensions(rng):
    image = rng.random((6, 6, 6))
    full = cripser.computePH(image, maxdim=9)
    assert np.array_equal(cripser.computePH(image), full) and full[:, 0].max() == 2
    assert np.array_equal(cripser.computePH(image, maxdim=0), full[full[:, 0] == 0])
    assert np.array_equal(cripser.computePH(image, top_dim=True), full[full[:, 0] == 2])
    assert cripser.computePH(rng.random(5), top_dim=True)[:, 0].max() == 0
    cells = tcripser.computePH(image)
    assert np.array_equal(cripser.compute_ph(image, filtration="t", inf_cutoff=False), cells)
    assert np.array_equal(cripser.compute_ph(image, inf_cutoff=False), full)
    full[full[:, 2] == NEVER, 2] = np.inf
    assert np.array_equal(cripser.compute_ph(image), full) and np.isinf(full[:, 2]).sum() == 1
    four = np.ones((3, 3, 3, 3))
    four[1, 1, 1, 1] = 2
    assert cripser.computePH(four, top_dim=True)[:, :3].tolist() == [[3, 1, 2]]
    assert cripser.compute_ph(four)[:, 0].max() == 3 > cripser.computePH(four)[:, 0].max()


def test_corners(rng):
    for shape in ((4,), (3, 5), (2, 1, 3), (2, 2, 3, 2)):
        image = rng.random(shape)
        corners = cripser.dual_embedding(image)
        assert corners.shape == tuple(n + 1 for n in shape)
        for place in np.ndindex(corners.shape):
            around = tuple(slice(max(0, k - 1), k + 1) for k in place)
            assert corners[place] == image[around].min()
    assert cripser.dual_embedding([[2, 1]]).tolist() == [[2, 1, 1], [2, 1, 1]]
    for wrong in (np.zeros((1,) * 5), np.float64(1), ["a"]):
        with pytest.raises(ph.Error):
            cripser.dual_embedding(wrong)


def test_arrays(rng):
    base = rng.random((8, 10))
    part = base[::2, ::2]
    expected = cripser.computePH(np.ascontiguousarray(part))
    for image in (part, np.asfortranarray(part), part.tolist(), part[::-1][::-1]):
        assert np.array_equal(cripser.computePH(image), expected)
    whole = rng.integers(0, 9, (5, 5))
    for dtype in (np.uint8, np.int64, np.float32, bool):
        image = whole.astype(dtype)
        assert np.array_equal(cripser.computePH(image), cripser.computePH(image.astype(float)))
        assert np.array_equal(cripser.computePH(image, embedded=True),
                              cripser.computePH(image.astype(float), embedded=True))
    assert cripser.computePH(np.array([0.0, np.inf, 1.0]))[:, :3].tolist() == [
        [0, 0, NEVER], [0, 1, NEVER]]


@pytest.mark.parametrize("image, options, text", [
    (np.zeros((2,) * 5), {}, "1 to 4 axes"), ([[0, np.nan]], {}, "nan|NaN"), (3.0, {}, "axes"),
    (np.empty((0, 3)), {}, "extents 0 x 3"), ([0.0, 1], {"maxdim": -1}, "maxdim"),
    ([0.0, 1], {"top_dim": 2}, "top_dim")])
def test_errors(image, options, text):
    with pytest.raises(ph.Error, match=text):
        cripser.computePH(image, **options)
    with pytest.raises(ph.UsageError, match="filtration"):
        cripser.compute_ph([0.0], filtration="W")


def test_helpers():
    rows = cripser.computePH(RING, maxdim=1)
    dgms = cripser.to_gudhi_diagrams(rows)
    assert [d.tolist() for d in dgms] == [[[1, np.inf]], [[1, 7]]]
    assert [len(d) for d in cripser.to_gudhi_diagrams(rows, maxdim=2)] == [1, 1, 0]
    assert len(cripser.to_gudhi_diagrams(rows, maxdim=2, include_empty=False)) == 2
    assert cripser.to_gudhi_persistence(rows) == [(0, (1.0, np.inf)), (1, (1.0, 7.0))]
    groups = cripser.group_by_dim(rows)
    assert [g.tolist() for g in groups] == [rows[:1].tolist(), rows[1:].tolist()]
    assert len(cripser.to_gudhi_diagrams(np.empty((0, 9)))) == 1
    for function in (cripser.to_gudhi_diagrams, cripser.to_gudhi_persistence, cripser.group_by_dim):
        with pytest.raises(ValueError, match="ph: found an array of shape"):
            function(np.zeros((2, 2)))
