# SPDX-License-Identifier: MIT
"""Tests where holes are: tables with places, label images, and images with an affine map."""
import pickle
import warnings

import numpy as np
import pytest

import libph as ph
from libph import _core

pandas = pytest.importorskip("pandas")

VOLUME = np.random.default_rng(0).random((5, 6, 4))
AFFINE = np.array([[0, -2, 0, 10], [3, 0, 0, -5], [0, 0, 0.5, 1], [0, 0, 0, 1.0]])


@pytest.mark.parametrize("construction", ["vertices", "cells"])
def test_places_of_voxels(construction):
    bars = ph.cubical(VOLUME, representatives="voxels", construction=construction)
    table = bars.to_pandas(places=True)
    assert list(table)[:3] == ["dim", "birth", "death"] and len(table) == len(bars)
    assert not set(table) & {"birth_x", "volume"}
    for i, row in enumerate(table.itertuples()):
        at = bars.birth_voxel(i)
        assert (row.birth_0, row.birth_1, row.birth_2) == at and VOLUME[at] == row.birth
        if bars.death_voxel(i) is None:
            assert np.isnan([row.death_0, row.death_1, row.death_2]).all()
        else:
            assert VOLUME[tuple(int(row[k]) for k in range(7, 10))] == row.death
        mask = bars.voxels(i)
        assert row.voxels == mask.sum()
        centre = [row.centroid_0, row.centroid_1, row.centroid_2]
        if mask.any():
            assert np.allclose(centre, np.argwhere(mask).mean(axis=0))
        else:
            cells = bars.representative(i).cells
            assert np.allclose(centre, (cells.mean(axis=0) - (construction == "cells")) / 2)
    # A loop lies inside the image.
    loops = table[table.dim == 1][["centroid_0", "centroid_1", "centroid_2"]]
    assert len(loops) and ((loops > -1) & (loops < [5, 6, 4])).all(axis=None)


def test_places_in_space():
    plain = ph.cubical(VOLUME, representatives="voxels").to_pandas(places=True)
    table = ph.cubical(ph.SpatialImage(VOLUME, AFFINE), representatives="voxels").to_pandas(places=True)
    assert plain.equals(table[list(plain)])
    for end in ("birth", "death", "centroid"):
        i, j, k = (table[f"{end}_{axis}"] for axis in range(3))
        for name, expected in (("x", 10 - 2 * j), ("y", 3 * i - 5), ("z", 0.5 * k + 1)):
            assert np.allclose(table[f"{end}_{name}"], expected, equal_nan=True)
    assert np.allclose(table.volume, 3 * table.voxels)


def test_places_of_points():
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    table = ph.rips(square).to_pandas(places=True)
    assert sorted(table.birth_vertices[:4]) == [(0,), (1,), (2,), (3,)]
    assert table.birth_vertices[4] == (2, 3)
    assert table.death_vertices.tolist()[-1] == (0, 2, 3) and table.death_vertices.isna().sum() == 1
    assert len(ph.rips([]).to_pandas(places=True)) == 0
    with pytest.raises(ph.UsageError, match="cells: found none, .*cells=True"):
        ph.rips(square, cells=False).to_pandas(places=True)
    with pytest.raises(ph.UsageError, match="voxels: found none, .*representatives='voxels'"):
        ph.cubical(VOLUME).to_pandas(places=True)


def by_definition(bars, points):
    """The mean of the means of the cells of each cycle; NaN for components."""
    return np.array([points[bars.representative(i).cells].mean(axis=1).mean(axis=0) if dim > 0
                     else np.full(points.shape[1], np.nan) for i, dim in enumerate(bars.dims)])


def centroids(bars, axes):
    return bars.to_pandas(places=True)[[f"centroid_{k}" for k in range(axes)]].to_numpy()


@pytest.mark.parametrize("axes", [2, 3])
def test_places_of_cycles(axes):
    rng = np.random.default_rng(5)
    points = rng.normal(size=(60, axes)) + 7
    for bars in (ph.rips(points, representatives="cycles", max_dim=axes - 1),
                 ph.rips(points, representatives="cycles", subsample=40),
                 *([ph.alpha(points, representatives="cycles")] if _core.alpha_support() else [])):
        assert {0, 1} <= set(bars.dims)
        expected = by_definition(bars, points)
        assert np.allclose(centroids(bars, axes), expected, rtol=1e-12, equal_nan=True)
        kept = bars.filter(min_persistence=0.2)
        assert 0 < len(kept) < len(bars)
        assert np.allclose(centroids(kept, axes), by_definition(kept, points), equal_nan=True)
        again = pickle.loads(pickle.dumps(bars))
        assert np.array_equal(centroids(again, axes), centroids(bars, axes), equal_nan=True)
    # A circle has one long loop, whose place is its centre.
    angles = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    circle = np.column_stack([3 + np.cos(angles), 5 + np.sin(angles)])
    bars = ph.rips(circle, representatives="cycles")
    assert np.allclose(centroids(bars, 2)[bars.longest(1)], [3, 5])


def test_places_of_points_with_nan():
    points = np.random.default_rng(6).normal(size=(30, 2))
    points[[0, 7]] = np.nan
    bars = ph.rips(points, representatives="cycles", nan="drop")
    assert np.allclose(centroids(bars, 2), by_definition(bars, points), equal_nan=True)
    assert 1 in bars.dims


def test_bars_without_centroids():
    points = np.random.default_rng(6).random((20, 2))
    distances = np.linalg.norm(points[:, None] - points, axis=2)
    without = [ph.rips(points), ph.rips(points, representatives="cocycles"),
               ph.rips(distances, metric="precomputed", representatives="cycles")]
    if _core.alpha_support():
        without.append(ph.alpha(points, period=1, representatives="cycles"))
    for bars in without:
        assert list(bars.to_pandas(places=True)) == ["dim", "birth", "death", "birth_vertices", "death_vertices"]


def test_p_values_in_tables(tmp_path):
    (tmp_path / "p.csv").write_text("dim,birth,death,p\n1,1,3,0.25\n0,0,inf,\n")
    assert ph.read_barcode(tmp_path / "p.csv").to_pandas().p.tolist()[1:] == [0.25]
    assert list(ph.rips([[0], [1]]).to_pandas()) == ["dim", "birth", "death"]


@pytest.mark.parametrize("dim", [0, 2])
def test_labels(dim):
    bars = ph.cubical(VOLUME, representatives="voxels")
    labels = bars.labels(dim)
    assert labels.shape == VOLUME.shape and labels.dtype == np.uint32
    owners = np.zeros(VOLUME.shape, dtype=int)
    sizes = np.full(VOLUME.shape, VOLUME.size + 1)
    for i in np.flatnonzero(bars.dims == dim):  # by definition: the smallest set of each voxel
        mask = bars.voxels(i)
        smaller = mask & (mask.sum() < sizes)
        owners[smaller], sizes[smaller] = i + 1, mask.sum()
    assert np.array_equal(labels, owners) and (dim == 0 or (labels == 0).any())
    with pytest.raises(ph.UsageError, match="found 1, whose bars have cycles, expected 0 or 2"):
        bars.labels(1)
    with pytest.raises(ph.UsageError, match="representatives='voxels'"):
        ph.cubical(VOLUME).labels(0)


def test_spatial_images():
    image = ph.SpatialImage(VOLUME, AFFINE)
    assert np.shares_memory(image, VOLUME) and np.array_equal(image.affine, AFFINE)
    assert image[1:].affine is None and (image + 1).affine is None
    again = pickle.loads(pickle.dumps(image))
    assert np.array_equal(again, VOLUME) and np.array_equal(again.affine, AFFINE)
    bars = ph.cubical(image, representatives="voxels")
    assert np.array_equal(bars.affine, AFFINE) and np.array_equal(bars.labels(0).affine, AFFINE)
    assert ph.cubical(VOLUME).affine is None and hash(bars.meta)
    for wrong, message in ((np.eye(3), r"shape \(3, 3\), expected \(4, 4\)"),
                           (np.full((4, 4), np.nan), "found .*nan, .*expected finite numbers"),
                           (np.ones((4, 4)), "the last row 0, 0, 0, 1"), ("x", "found str"),
                           ([[1, 2], [3]], "row 1: found 1 numbers, expected 2"),
                           (np.full((4, 4), "x"), "found text, expected numbers")):
        with pytest.raises(ph.Error, match=f"affine: .*{message}"):
            ph.SpatialImage(VOLUME, wrong)


def test_results_of_spatial_images():
    image = ph.SpatialImage(VOLUME.copy(), AFFINE)
    assert type(image.max()) is type(image.mean()) is np.float64
    assert type((image > 0.5).any()) is np.bool_
    assert (image.sum(axis=0) - VOLUME.sum(axis=0) == 0).all()
    image += 1
    assert np.array_equal(image, VOLUME + 1) and np.array_equal(image.affine, AFFINE)


def test_masked_voxels_are_nan(tmp_path):
    masked = np.ma.masked_less((9 * VOLUME).astype(np.int16), 4)
    expected = np.where(masked.mask, np.nan, masked.data)
    assert np.array_equal(ph.SpatialImage(masked), expected, equal_nan=True)
    ph.write_nifti(tmp_path / "v.nii", masked)
    assert np.array_equal(ph.read(tmp_path / "v.nii", nan="drop"), expected, equal_nan=True)


class OfNibabel:
    """The part of an image of nibabel that libph uses."""

    affine, dataobj = AFFINE, VOLUME

    def __array__(self, *_):
        raise TypeError("Cannot convert Nifti1Image to array")


def test_images_of_nibabel():
    bars = ph.cubical(OfNibabel(), representatives="voxels")
    assert bars == ph.cubical(VOLUME) and np.array_equal(bars.affine, AFFINE)


def test_a_mask_keeps_its_place(tmp_path):
    bars = ph.cubical(ph.SpatialImage(VOLUME, AFFINE), representatives="voxels")
    mask = bars.voxels(0)
    ph.write_nifti(tmp_path / "mask.nii", mask)
    back = ph.read(tmp_path / "mask.nii")
    assert np.array_equal(back, mask) and np.array_equal(back.affine, AFFINE)
    assert bars.voxels(0).dtype == np.bool_ and back.max() == 1


def test_pictures_are_images(tmp_path):
    """Functions for any kind of data take a picture that was read as an image."""
    picture = (np.arange(400).reshape(20, 20) * 7 % 251).astype(np.uint8)
    (tmp_path / "p.pgm").write_bytes(b"P5 20 20 255\n" + picture.tobytes())
    image = ph.read(tmp_path / "p.pgm")
    assert type(image) is ph.SpatialImage and image.affine is None
    tree = ph.merge_tree(image)
    assert len(tree.births) == 400
    assert ph.estimate(image).engine == ph.estimate(picture, complex="cubical").engine
    assert ph.cluster_tree(image, 5).scale == "linear"
    with pytest.warns(UserWarning, match=r"20 points of R\^20.*complex='cubical'"):
        ph.merge_tree(picture)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ph.merge_tree(picture.astype(float))
        ph.merge_tree(picture, complex="rips")
        ph.merge_tree(picture[:, :3])


def test_bars_chosen_by_bools():
    bars = ph.cubical(VOLUME)
    finite = bars[bars.deaths < np.inf]
    assert len(finite) == len(bars) - 1 and np.isfinite(finite.deaths).all()
    assert bars[np.ones(len(bars), dtype=bool)] == bars
    with pytest.raises(IndexError, match=r"shape \(2,\), expected one per bar"):
        bars[np.array([True, False])]


@pytest.mark.parametrize("dtype", ["u1", "i2", ">i4", "f4", ">f8", "i1", "u2", "u4", "i8", "u8"])
def test_nifti_there_and_back(dtype, tmp_path):
    image = (100 * VOLUME).astype(dtype)
    ph.write_nifti(tmp_path / "v.nii", image, AFFINE)
    back = ph.read(tmp_path / "v.nii")
    assert np.array_equal(back, image) and np.array_equal(back.affine, AFFINE)
    bars = ph.cubical(back, representatives="voxels")
    ph.write_nifti(tmp_path / "labels.nii", bars.labels(0))
    labels = ph.read(tmp_path / "labels.nii")
    assert np.array_equal(labels, bars.labels(0)) and np.array_equal(labels.affine, AFFINE)
    bars.save(tmp_path / "bars.json")
    assert np.array_equal(ph.read_barcode(tmp_path / "bars.json").affine, AFFINE)


def test_nifti_that_is_refused(tmp_path):
    for image, message in ((VOLUME.astype(complex), "complex numbers"), (np.zeros((3, 0)), r"\(3, 0\)"),
                           (np.zeros((2,) * 8), "1 to 7 axes"), (np.zeros((40000,)), "40000"),
                           (VOLUME.astype("f2"), "float16"), (OfNibabel(), "Cannot convert"),
                           (None, "found NoneType, expected an array")):
        with pytest.raises(ph.Error, match=f"image: .*{message}"):
            ph.write_nifti(tmp_path / "v.nii", image)
    with pytest.raises(ph.UsageError, match="ends in .nii; gzip"):
        ph.write_nifti(tmp_path / "v.nii.gz", VOLUME)
    assert not list(tmp_path.iterdir())
