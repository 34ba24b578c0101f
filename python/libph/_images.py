# SPDX-License-Identifier: MIT
"""Images with places in space."""
from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _options, _run
from ._errors import UsageError


@_options.with_hints
class SpatialImage(np.ndarray[Any, np.dtype[Any]]):
    """An image that knows the places of its voxels in space.

    It is an array like any other. Results of computations and slices are arrays without an affine
    map, because their voxels may be at other places.

    Parameters
    ----------
    image : array_like
        The image. An array is not copied unless it has masked voxels, which become NaN.
    affine : array_like (4, 4), optional
        Maps (i, j, k, 1) to (x, y, z, 1), as in nibabel. Default: the image has no map.

    Attributes
    ----------
    affine : ndarray (4, 4) or None

    Examples
    --------
    >>> scan = ph.SpatialImage(np.zeros((4, 5, 6)), np.diag([1.0, 1.0, 2.5, 1.0]))
    >>> float(ph.cubical(scan).affine[2, 2])
    2.5
    """

    affine: NDArray[np.float64] | None

    def __new__(cls, image: ArrayLike, affine: ArrayLike | None = None) -> SpatialImage:
        self = _arrays.as_array(image, "image").view(cls)
        self.affine = None if affine is None else _matrix(affine)
        return self

    def __array_finalize__(self, other: Any) -> None:
        self.affine = None

    def __array_wrap__(self, array: Any, *_: Any) -> Any:
        """A result without axes is a number, as it is for other arrays."""
        if array is self:
            return array
        return array.view(SpatialImage) if array.ndim else array[()]

    def __reduce__(self) -> tuple[Any, ...]:
        return (SpatialImage, (np.asarray(self), self.affine))


def _matrix(affine: Any) -> NDArray[np.float64]:
    matrix = np.array(_arrays.as_array(affine, "affine"), dtype=np.float64)
    if matrix.shape != (4, 4):
        raise UsageError(f"affine: found an array of shape {matrix.shape}, expected (4, 4)")
    if not np.isfinite(matrix).all() or (matrix[3] != [0, 0, 0, 1]).any():
        raise _options.refuse("affine", matrix.tolist(), "finite numbers with the last row 0, 0, 0, 1")
    return matrix


def affine_of(image: Any) -> tuple[tuple[float, ...], ...] | None:
    """The first three rows of the affine map of an image, if it has one: of a SpatialImage, or of
    an image of nibabel."""
    affine = getattr(image, "affine", None)
    if affine is None or not (isinstance(image, SpatialImage) or hasattr(image, "dataobj")):
        return None
    return tuple(map(tuple, _matrix(affine)[:3].tolist()))


_NIFTI_TYPES = {"u1": 2, "i2": 4, "i4": 8, "f4": 16, "f8": 64, "i1": 256, "u2": 512, "u4": 768,
                "i8": 1024, "u8": 1280}
_NIFTI_HEADER = np.dtype({
    "names": ["sizeof_hdr", "dim", "datatype", "bitpix", "pixdim", "vox_offset", "scl_slope",
              "sform_code", "srow", "magic"],
    "formats": ["<i4", ("<i2", 8), "<i2", "<i2", ("<f4", 8), "<f4", "<f4", "<i2", ("<f4", (3, 4)),
                "S4"],
    "offsets": [0, 40, 70, 72, 76, 108, 112, 254, 280, 344], "itemsize": 348})


def nifti_bytes(image: Any, affine: ArrayLike | None) -> bytes:
    """The image as a NIfTI-1 file, see `write_nifti`."""
    rows = affine_of(image) if affine is None else _matrix(affine)[:3]
    array = _arrays.as_array(image, "image")
    if array.dtype == np.bool_:
        array = array.astype(np.uint8)
    code = _NIFTI_TYPES.get(array.dtype.str[1:])
    if code is None:
        raise UsageError(f"image: found numbers of type {array.dtype}, expected one of "
                         f"{', '.join(_NIFTI_TYPES)}; .astype converts them")
    if not 1 <= array.ndim <= 7 or not 1 <= min(array.shape) <= max(array.shape) <= 32767:
        raise UsageError(f"image: found an array of shape {array.shape}, expected 1 to 7 axes of 1 "
                         "to 32767 voxels")
    srow = np.eye(3, 4) if rows is None else np.asarray(rows)
    sizes = np.ones(8, dtype="<f4")
    sizes[1:4] = np.linalg.norm(srow[:, :3], axis=0)
    header = np.zeros(1, dtype=_NIFTI_HEADER)[0]
    header["sizeof_hdr"], header["magic"], header["vox_offset"] = 348, b"n+1", 352
    header["dim"] = [array.ndim, *array.shape] + [1] * (7 - array.ndim)
    header["datatype"], header["bitpix"] = code, 8 * array.itemsize
    header["pixdim"], header["scl_slope"] = sizes, 1
    header["srow"], header["sform_code"] = srow, 0 if rows is None else 1
    voxels = array.astype(array.dtype.newbyteorder("<"), copy=False).tobytes(order="F")
    return bytes(header.tobytes()) + bytes(4) + voxels


@_options.with_hints
def write_nifti(path: str | os.PathLike[str], image: ArrayLike, affine: ArrayLike | None = None
                ) -> None:
    """Writes an image to a NIfTI-1 file (.nii), completely or not at all.

    Parameters
    ----------
    path : path
        The file.
    image : array_like
        1 to 7 axes, integers or floats of at most 8 bytes, such as `Barcode.labels`, or bools, such
        as `Barcode.voxels`, which become 0 and 1. Masked voxels are written as NaN.
    affine : array_like (4, 4), optional
        Maps (i, j, k, 1) to (x, y, z, 1). Default: the affine map of a `SpatialImage`; without one,
        the file states none.

    Raises
    ------
    UsageError, DataError
        If the format does not have the shape or the type of the image, or if `affine` is no affine
        map.
    OutputError
        If the file cannot be written.
    """
    file = _options.path_of(path)
    if not file.lower().endswith(b".nii"):
        raise UsageError(f"path: found {os.fsdecode(file)!r}, expected a name that ends in .nii; "
                         "gzip makes .nii.gz of the file")
    _run.run(_core.write_file, file, nifti_bytes(image, affine), options={})
