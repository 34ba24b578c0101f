# SPDX-License-Identifier: MIT
"""Arrays and tables whose columns are not all coordinates."""
import warnings

import libph as ph
import numpy as np
import pytest

RNG = np.random.default_rng(0)
XYZ = RNG.random((20, 3))


def bars_of(points):
    """The bars of points, which must not lead to a warning."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return ph.rips(points)


def test_fields_of_a_structured_array_are_coordinates():
    vertices = np.empty(20, dtype=[("f0", "f4"), ("f1", "f4"), ("f2", "f4")])
    cloud = np.empty(20, dtype=[("ring", "u2"), ("z", "f8"), ("y", "f8"), ("x", "f8")])
    for k, name in enumerate(("f0", "f1", "f2")):
        vertices[name] = XYZ[:, k]
    for k, name in enumerate("xyz"):
        cloud[name] = XYZ[:, k]
    assert bars_of(vertices) == bars_of(XYZ.astype("f4").astype("f8"))
    assert bars_of(cloud) == bars_of(XYZ)
    assert bars_of(cloud.reshape(4, 5)) == bars_of(XYZ)
    with pytest.raises(ph.DataError, match="records of the fields ring, z, .*structured_to_unstructured"):
        ph.rips(cloud[["ring", "z"]])
    with pytest.raises(ph.DataError, match="records of several fields"):
        ph.cubical(cloud)
    masked = np.ma.array(cloud)
    masked["x"][2] = np.ma.masked
    assert bars_of(masked[[0, 1]]) == bars_of(XYZ[:2])
    with pytest.raises(ph.DataError, match="point 2, coordinate 0: found nan"):
        ph.rips(masked)


@pytest.mark.parametrize("field, value, message", [
    ("S4", b"far", "expected numbers x, y and z"), (("f4", (2,)), 0, "expected numbers x, y and z"),
    ("i8", 2**53 + 1, r"X\['x'\]: entry 0: found 9007199254740993, expected")])
def test_fields_that_are_no_coordinates(field, value, message):
    dtype = [("x", *field) if isinstance(field, tuple) else ("x", field), ("y", "f4"), ("z", "f4")]
    cloud = np.zeros(3, dtype=dtype)
    cloud["x"] = value
    with pytest.raises(ph.DataError, match=message):
        ph.rips(cloud)


@pytest.mark.parametrize("others", [[7.0 * np.arange(20)], [np.arange(20), np.ones(20)]])
def test_whole_numbers_beside_fractions_are_named(others):
    points = np.column_stack([XYZ, *others])
    with pytest.warns(UserWarning, match=r"only whole numbers.*X\[:, :3\] leaves"):
        ph.rips(points)
    bars_of(points[:, 1:])
    bars_of(points[:7])
    bars_of(np.column_stack([XYZ, XYZ]))


def test_columns_of_a_data_frame_are_named():
    pd = pytest.importorskip("pandas")
    frame = pd.DataFrame({"x": XYZ[:, 0], "y": XYZ[:, 1], "z": XYZ[:, 2], "intensity": XYZ[:, 0]})
    with pytest.warns(UserWarning, match=r"read intensity as a coordinate; X\[\['x', 'y', 'z'\]\]"):
        ph.rips(frame)
    assert bars_of(frame[["x", "y", "z"]]) == bars_of(XYZ)
    bars_of(frame.rename(columns={"x": "a"}))


def test_latitudes_and_longitudes_are_no_distances():
    pd = pytest.importorskip("pandas")
    places = pd.DataFrame({"Lat": XYZ[:, 0], "lng": XYZ[:, 1]})
    with pytest.warns(UserWarning, match=r"Lat and lng .*\(cos Lat cos lng, cos Lat sin lng, sin Lat\)"):
        ph.rips(places)
    bars_of(places.rename(columns={"lng": "height"}))


def test_colour_pictures_and_organised_clouds_are_named():
    picture = RNG.integers(0, 255, (24, 20, 3)).astype("u1")
    for image in (picture, picture / 255):
        with pytest.warns(UserWarning, match=r"24 x 20 x 3 voxels.*image\[..., 0\]"):
            ph.cubical(image)
    for image in (np.moveaxis(picture, 2, 0), np.moveaxis(picture, 2, 0) / 255):
        with pytest.warns(UserWarning, match=r"3 x 24 x 20 voxels.*3 channels.*image\[0\]"):
            ph.cubical(image)
    with pytest.warns(UserWarning, match=r"4 channels, take one channel, image\[0\]"):
        ph.cubical(RNG.integers(0, 255, (4, 16, 17)).astype("u1"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ph.cubical(np.moveaxis(picture, 2, 0)[:2])
        ph.cubical(np.moveaxis(picture, 2, 0)[:, :9])
        ph.cubical(np.moveaxis(picture, 2, 1))
        ph.cubical(picture[..., 0])
        ph.cubical(picture.astype("i2"))
        ph.cubical(picture[:9])
    with pytest.raises(ph.UsageError, match=r"\.reshape\(-1, 3\) makes points"):
        ph.rips(XYZ.reshape(4, 5, 3))
