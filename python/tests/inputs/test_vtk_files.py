# SPDX-License-Identifier: MIT
"""Tests that VTI files are read as VTK wrote them."""
import itertools

import numpy as np
import pytest

import libph as ph

vtk = pytest.importorskip("vtk", reason="VTK is not installed")
support = pytest.importorskip("vtk.util.numpy_support", reason="VTK has no NumPy support")

MODES = [("Ascii", False), ("Binary", False), ("Appended", False), ("Appended", True)]
TYPES = ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"]


def image_with(values, of_cells):
    """A VTK image with these values, (x, y, z), and another array."""
    data = vtk.vtkImageData()
    first = (2, -1, 5)
    data.SetExtent(*itertools.chain.from_iterable(
        (f, f + n - (0 if of_cells else 1)) for f, n in zip(first, values.shape)))
    data.SetSpacing(1, 2, 0.5)
    data.SetOrigin(10, 20, 30)
    data.SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1)
    place = data.GetCellData() if of_cells else data.GetPointData()
    for name, numbers in (("values", values), ("others", 0 * values)):
        array = support.numpy_to_vtk(numbers.ravel(order="F"), deep=True)
        array.SetName(name)
        place.AddArray(array)
    place.SetActiveScalars("values")
    return data, first


def written(data, path, mode, encoded, zlib, wide, big):
    writer = vtk.vtkXMLImageDataWriter()
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    getattr(writer, f"SetDataModeTo{mode}")()
    writer.SetEncodeAppendedData(encoded)
    (writer.SetCompressorTypeToZLib if zlib else writer.SetCompressorTypeToNone)()
    (writer.SetHeaderTypeToUInt64 if wide else writer.SetHeaderTypeToUInt32)()
    (writer.SetByteOrderToBigEndian if big else writer.SetByteOrderToLittleEndian)()
    writer.SetBlockSize(64)
    assert writer.Write() == 1
    return path


@pytest.mark.parametrize("mode,encoded", MODES)
@pytest.mark.parametrize("zlib", [False, True])
@pytest.mark.parametrize("of_cells", [False, True])
def test_arrays_of_vtk(tmp_path, mode, encoded, zlib, of_cells):
    numbers = np.random.default_rng(1).integers(0, 100, (5, 4, 3))
    for kind, wide, big in itertools.product(TYPES, (False, True), (False, True)):
        values = (numbers / 7 if kind[0] == "f" else numbers).astype(kind)
        data, first = image_with(values, of_cells)
        path = written(data, tmp_path / "a.vti", mode, encoded, zlib, wide, big)
        found = ph.read(path)
        assert found.shape == values.shape
        same = np.allclose if mode == "Ascii" and kind[0] == "f" else np.array_equal
        assert same(found, values), (kind, wide, big)
        assert np.array_equal(ph.read(f"{path}:others"), 0 * values)
        centre = [0.0] * 3
        data.TransformContinuousIndexToPhysicalPoint(
            *(np.array(first) + (1, 2, 0) + (0.5 if of_cells else 0)), centre)
        assert np.allclose(found.affine @ (1, 2, 0, 1), (*centre, 1))
