# SPDX-License-Identifier: MIT
"""Files of data and of barcodes, in all formats of libph."""
from __future__ import annotations

import logging
import os
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _core, _errors, _options, _results, _run
from ._barcodes import Barcode
from ._images import SpatialImage
from ._results import weights_in

if TYPE_CHECKING:
    from scipy.sparse import csc_array
    from typing_extensions import Unpack

    from ._run import RunOptions

_LOG = logging.getLogger("libph")


class Simplices(NamedTuple):
    """Simplices from a file, for ``filtered(*found)``. If `read` was given `values`, the values are
    values of vertices, for ``lower_star(found.values, found.simplices)``."""

    simplices: list[tuple[int, ...]]
    values: NDArray[np.float64]

    def __repr__(self) -> str:
        return _results.in_brief(self)


class Boundary(NamedTuple):
    """A boundary matrix from a file: for ``boundary(*matrix)``."""

    matrix: csc_array
    dims: NDArray[np.int64]
    values: NDArray[np.float64] | None

    def __repr__(self) -> str:
        return _results.in_brief(self)


class Mesh(NamedTuple):
    """A mesh from a file: ``lower_star(mesh.values, mesh.triangles)``, if it has values."""

    vertices: NDArray[np.float64]
    triangles: NDArray[np.int64]
    values: NDArray[np.float64] | None

    def __repr__(self) -> str:
        return _results.in_brief(self)


def read(path: str | os.PathLike[str], format: str | None = None, *,
         values: str | os.PathLike[str] | None = None, nan: str = "error",
         columns: Sequence[str] | None = None, array: str = "auto", symmetrise: str | None = None,
         from_correlation: bool = False, diagonal: str = "zero", channel: str = "auto",
         raw_shape: Sequence[int] | None = None, raw_points: int | None = None,
         raw_dtype: DTypeLike = None, raw_skip: int = 0, weld: bool = False,
         stack: bool = False, **run: Unpack[RunOptions]) -> Any:
    """Reads a file of points, distances, an image, simplices, a boundary matrix or a mesh.

    If a file has several plausible meanings, such as columns that may be no coordinates, a
    UserWarning says which one was chosen, and how to choose another. Other notes about the file go
    to the logger "libph", level INFO.

    Parameters
    ----------
    path : path
        The file, which may be compressed with gzip. "FILE.npz:NAME" and "FILE.vti:NAME" choose one
        of several arrays.
    format : str, optional
        A name that the option ``--format`` of the program ph-barcode accepts. Default: the format
        is detected from content and extension.
    values : path, optional
        Values of the cells of a boundary matrix, or of the vertices of a mesh or of simplices.
    nan : {"error", "drop"}
        How to treat NaN. "error": raise an error. "drop": leave out points, never join pairs, treat
        voxels as absent. Points of PCD, PLY, XYZ and PTS with a NaN coordinate are always left out.
    columns : sequence of str, optional
        Columns of a table to read: names, "3", or "2-5".
    array : {"auto", "rips", "image", "points", "distances"}
        The content of an array with two axes.
    symmetrise : {None, "max", "min", "lower"}
        Which of two unequal entries of a square matrix to use.
    from_correlation : bool
        If True, entries are correlations r and the distances are 1 - r.
    diagonal : {"zero", "births", "any"}
        The meaning of the diagonal of a square matrix; see `rips`.
    channel : {"auto", "grey", "red", "green", "blue", "alpha"}
        The channel that gives the value of a pixel.
    raw_shape : sequence of int, optional
        For an image without a header (``format="raw"``): sizes of the axes, the last one fastest.
    raw_points : int, optional
        For points without a header (``format="raw"``): numbers per point, 4 for a file of KITTI.
        `columns` chooses some of these numbers: ``raw_points=4, columns=["1-3"]``.
    raw_dtype : dtype, optional
        Type of the numbers, integer or float, with its byte order: ">i2". Default: uint8 for an
        image, float32 in little endian for points.
    raw_skip : int
        Bytes before the first number.
    weld : bool
        For a mesh (OFF, PLY). If True, vertices at the same position become one vertex, as along the
        seams of a texture. Their values must be equal.
    stack : bool
        If True, `path` is a folder. Its PNG, PGM or TIFF pictures are the slices of one volume
        (z, y, x), in the natural order of their names: "slice2.png" before "slice10.png".
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    ndarray, coo_array, Simplices, Boundary or Mesh
        Points (n, d), distances (n, n), an image, or sparse distances, depending on the file. An
        image is a `SpatialImage`, which functions for any kind of data take as an image. It has an
        affine map if the file (NIfTI, NRRD, MetaImage, VTI) states the places of its voxels.
    """
    return _answer(found_by(**locals()))


def found_by(path: Any, format: Any, values: Any, nan: Any, columns: Any, array: Any,
             symmetrise: Any, from_correlation: Any, diagonal: Any, channel: Any, raw_shape: Any,
             raw_points: Any, raw_dtype: Any, raw_skip: Any, weld: Any, stack: Any,
             run: Any) -> dict[str, Any]:
    """The result of `_core.read` for the arguments of `read`."""
    _run.check_names("read", dict(run), read)
    name = "auto" if format is None else _options.choice("format", format, _core.format_names())
    try:
        dtype = np.dtype(("uint8" if raw_points is None else "<f4") if raw_dtype is None
                         else raw_dtype)
        if dtype.kind not in "uif" or dtype.itemsize > 8:
            raise TypeError
    except TypeError:
        raise _options.refuse("raw_dtype", raw_dtype, "whole numbers or floats of at most 8 bytes"
                              ) from None
    options = {
        "nan": _options.choice("nan", nan, ["error", "drop"]),
        "columns": [] if columns is None else [str(column) for column in (
            columns.split(",") if isinstance(columns, str)
            else _options.several("columns", columns, "names or numbers of columns"))],
        "array": _options.choice("array", array, ["auto", "rips", "image", "points", "distances"]),
        "symmetrise": _options.choice("symmetrise", symmetrise,
                                      [None, "max", "min", "lower"]) or "none",
        "from_correlation": _options.flag("from_correlation", from_correlation),
        "diagonal": _options.choice("diagonal", diagonal, ["zero", "births", "any"]),
        "channel": _options.choice("channel", channel,
                                   ["auto", "grey", "red", "green", "blue", "alpha"]),
        "raw_shape": None if raw_shape is None else [
            _options.whole("raw_shape", extent, 0)
            for extent in _options.several("raw_shape", raw_shape, "the extents of an image")],
        "raw_points": None if raw_points is None else _options.whole("raw_points", raw_points, 1),
        "raw_type": f"{dtype.kind}{dtype.itemsize}",
        "raw_big_endian": dtype.newbyteorder("=") != dtype,
        "raw_skip": _options.whole("raw_skip", raw_skip, 0),
        "weld": _options.flag("weld", weld), "stack": _options.flag("stack", stack)}
    if columns is not None and not options["columns"]:
        raise _options.refuse("columns", columns, "names or numbers of columns")
    if raw_shape is not None and raw_points is not None:
        raise _errors.UsageError("raw_points: cannot be combined with raw_shape, which reads an image")
    raw = {"raw_shape": raw_shape, "raw_points": raw_points, "raw_dtype": raw_dtype,
           "raw_skip": options["raw_skip"] or None}
    given = ", ".join(option for option, value in raw.items() if value is not None)
    if given and name == "auto":
        if raw_shape is None and raw_points is None:
            raise _errors.UsageError(f"{given}: found neither raw_shape nor raw_points, expected one "
                                     "of them")
        name = "raw"
    if given and name != "raw":
        raise _errors.UsageError(f"{given}: found format={format!r}, expected format='raw'")
    file = _options.path_of(path)
    result = _result_in(file) if format is None and columns is None else ""
    if result:
        raise _errors.DataError(f"{os.fsdecode(file)}: found {result}")
    found = _run.run(_core.read, file, name,
                     b"" if values is None else _options.path_of(values), options,
                     options=dict(run))
    _LOG.info("%s: %s", os.fspath(path), found["description"])
    for note in found["notes"]:
        _LOG.info("%s: %s", os.fspath(path), note)
    for guess in found["guesses"]:
        warnings.warn(f"{os.fsdecode(file)}: {guess}", UserWarning,
                      stacklevel=_options.user_level())
    return found


# The first bytes of the files in which libph writes its results, with the words of an error.
_RESULTS = (
    (b"dim,birth,death\n", "a barcode, expected data; ph.read_barcode reads it"),
    (b'{\n  "format": "ph-barcode"', "a barcode, expected data; ph.read_barcode reads it"),
    (b"ph-tree\n", "the tree of a segmentation, expected data; ph.segment reads it"),
    (b'{\n  "format": "ph-segment"', "a segmentation, expected data; json.load reads it"),
    (b'{"format": "ph-segment"', "segmentations, one per line, expected data; json.loads reads a "
     "line"),
    (b'{\n  "format": "ph-segment-tree"', "the tree of a segmentation, expected data; "
     "Segmentation.save('x.tree') writes it for ph.segment"),
)


def _result_in(path: bytes) -> str:
    """The result that a file holds, if libph wrote it; empty for any other file."""
    try:
        with open(path, "rb") as file:
            start = file.read(max(len(first) for first, _ in _RESULTS))
    except OSError:  # the reader will report the problem with the file
        return ""
    return next((words for first, words in _RESULTS if start.startswith(first)), "")


def _answer(found: dict[str, Any]) -> Any:
    kind = found["kind"]
    if kind == "image":
        affine = found["affine"]
        return SpatialImage(np.asarray(found[kind]),
                            None if affine is None else [*affine, [0, 0, 0, 1]])
    if kind in ("points", "distances"):
        return np.asarray(found[kind])
    if kind == "sparse":
        from scipy.sparse import coo_array
        size = found["size"]
        return coo_array((np.asarray(found["values"]),
                          (np.asarray(found["i"]), np.asarray(found["j"]))), shape=(size, size))
    offsets = np.asarray(found["offsets"])
    if kind == "simplices":
        vertices = np.asarray(found["vertices"]).tolist()
        return Simplices([tuple(vertices[a:b]) for a, b in zip(offsets[:-1], offsets[1:])],
                         np.asarray(found["values"]))
    values = None if found["values"] is None else np.asarray(found["values"])
    if kind == "boundary":
        from scipy.sparse import csc_array
        cells = len(offsets) - 1
        matrix = csc_array((np.asarray(found["incidences"]), np.asarray(found["rows"]), offsets),
                           shape=(cells, cells))
        return Boundary(matrix, np.asarray(found["dims"]).astype(np.int64), values)
    return Mesh(np.asarray(found["vertices"]), _triangles(np.asarray(found["corners"]), offsets),
                values)


def _triangles(corners: NDArray[np.int64], offsets: NDArray[np.int64]) -> NDArray[np.int64]:
    """Splits faces into triangles around their first corner."""
    fans = [np.column_stack([np.full(b - a - 2, corners[a]), corners[a + 1:b - 1],
                             corners[a + 2:b]])
            for a, b in zip(offsets[:-1], offsets[1:]) if b - a > 2]
    return np.concatenate(fans) if fans else np.empty((0, 3), dtype=np.int64)


def read_barcode(path: str | os.PathLike[str], format: str | None = None,
                 **run: Unpack[RunOptions]) -> Barcode:
    """Reads a barcode from a file of any format that `Barcode.save` writes.

    JSON restores the whole barcode: bars, cells, chains, loops, voxels, p-values and `meta`. CSV
    restores bars and p-values. The other formats store only the bars. The logger "libph", level
    INFO, names what a file of another program has in addition.

    Parameters
    ----------
    path : path
        The file, which may be compressed with gzip.
    format : str, optional
        "csv", "json", "ripser", "pers", "dipha" or "npy". Default: the format is detected from
        content and extension.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Barcode
    """
    _run.check_names("read_barcode", dict(run), read_barcode)
    bars, meta, left_out = _run.run(_core.read_barcode, _options.path_of(path),
                                    None if format is None else str(format), options=dict(run))
    if left_out:
        _LOG.info("%s: not kept: %s", os.fspath(path), ", ".join(left_out))
    meta |= weights_in(meta["vertex_weights"])
    if bars.representatives != "none":
        meta["representatives"] = bars.representatives
    return Barcode._made(bars, {name: value for name, value in meta.items()
                                if value is not None and value != ""})
