# SPDX-License-Identifier: MIT
"""Arrays from users: used in place if possible, converted with checks, or refused with a message.

No function here writes to its arguments.
"""
from __future__ import annotations

import math
import os
import sys
import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _core, _options, _run
from ._errors import DataError, MemoryLimitError, UsageError
from ._results import in_units

_FLOAT32, _FLOAT64 = np.dtype(np.float32), np.dtype(np.float64)  # in the machine's byte order
_LARGEST = 2**53  # all whole numbers up to this one are doubles
_LARGE = 2**24  # bytes
_WORDS = {"c": "complex numbers, expected real ones; take .real or abs()",
          "M": "dates, expected numbers", "m": "times, expected numbers; divide by a unit",
          "U": "text, expected numbers; .astype(float) reads it",
          "S": "bytes, expected numbers; .astype(float) reads them",
          "V": "records of several fields, expected numbers; "
               "numpy.lib.recfunctions.structured_to_unstructured makes an array of them"}


def place_of(index: Sequence[int]) -> str:
    """The place of a number, in words.

    >>> place_of((3, 1))
    'row 3, column 1'
    """
    if len(index) == 1:
        return f"entry {index[0]}"
    if len(index) == 2:
        return f"row {index[0]}, column {index[1]}"
    return "index (" + ", ".join(map(str, index)) + ")"


def first_of(wrong: NDArray[np.bool_]) -> tuple[int, ...]:
    """The index of the first true entry."""
    return tuple(map(int, np.unravel_index(int(np.argmax(wrong)), wrong.shape)))


def is_sparse(data: Any) -> bool:
    """True for a matrix or array of scipy.sparse."""
    return hasattr(data, "tocoo") and hasattr(data, "nnz")


def is_masked(data: Any) -> bool:
    """True for a masked array. There is none as long as nothing has imported numpy.ma."""
    return "numpy.ma" in sys.modules and isinstance(data, np.ma.MaskedArray)


def as_array(data: Any, name: str) -> NDArray[Any]:
    """The data as an array of real numbers; data that already are such an array are not copied.

    Accepts arrays, objects with the buffer protocol, `__array__` or DLPack, and nested lists.
    """
    if type(data) is np.ndarray:
        array = data
    elif is_sparse(data):
        raise UsageError(f"{name}: found a sparse matrix, expected an array; .toarray() makes one")
    elif is_masked(data):
        array = _without_mask(data, name)
    else:
        array = _converted(data, name)
    kind = array.dtype.kind
    if kind == "O":
        return _numbers_of_objects(array, name)
    if kind in _WORDS:
        raise DataError(f"{name}: found {_WORDS[kind]}")
    return array


def is_graph(data: Any) -> bool:
    """True for a graph of networkx, which NumPy takes for the sequence of its vertices."""
    return hasattr(data, "adjacency") and hasattr(data, "edges")


def _no_array(data: Any, name: str) -> UsageError:
    from . import _hints
    is_path = isinstance(data, (str, bytes, os.PathLike))
    hint = "; ph.read(path) reads a file" if is_path else _hints.of_object(data)
    return UsageError(f"{name}: found {type(data).__name__}, expected an array of numbers{hint}")


def _converted(data: Any, name: str) -> NDArray[Any]:
    is_list = type(data) in (list, tuple)
    if not is_list:
        if data is None or isinstance(data, (str, bytes, dict, set, frozenset)) or is_graph(data):
            raise _no_array(data, name)
        if hasattr(data, "detach") and callable(data.detach):  # a tensor that requires a gradient
            data = data.detach()
    try:
        if not is_list and not hasattr(data, "__array__") and hasattr(data, "__dlpack__"):
            return np.from_dlpack(data)
        array = np.asarray(data)
    except (KeyboardInterrupt, MemoryError):
        raise
    except Exception as error:  # foreign objects may raise anything
        raise DataError(f"{name}: {_ragged(data) or f'found no array of numbers: {error}'}") from None
    if array.dtype.kind == "O" and array.ndim == 0:
        raise _no_array(data, name)
    if array.dtype.kind == "O" and isinstance(data, (list, tuple)) and _ragged(data):
        raise DataError(f"{name}: {_ragged(data)}")
    return array


def _ragged(data: Any) -> str:
    """Describes how nested lists are ragged; empty if they are not."""
    if not isinstance(data, (list, tuple)):
        return ""
    lengths = [len(row) if hasattr(row, "__len__") and not isinstance(row, str) else None
               for row in data]
    for i, length in enumerate(lengths):
        if length != lengths[0]:
            counts = ["one number" if n is None else f"{n} numbers" for n in (length, lengths[0])]
            return f"row {i}: found {counts[0]}, expected {counts[1]} as in row 0"
    return ""


def _without_mask(data: Any, name: str) -> NDArray[Any]:
    """The numbers of a masked array; masked numbers become NaN."""
    masked: Any = np.ma  # its functions have no type annotations in NumPy 1
    numbers: NDArray[Any] = masked.getdata(data)
    if not masked.is_masked(data):
        return numbers
    if data.dtype.kind not in "biuf":
        raise DataError(f"{name}: found masked entries of type {data.dtype}, expected numbers")
    return as_float64(numbers, name, masked.getmaskarray(data))


def _numbers_of_objects(array: NDArray[Any], name: str) -> NDArray[np.float64]:
    """An array of objects that are real numbers: Fraction, Decimal, Python's large integers,
    pandas' NA."""
    pandas = sys.modules.get("pandas")  # its objects exist only if it is imported
    missing = (None, getattr(pandas, "NA", None), getattr(pandas, "NaT", None))
    numbers = np.empty(array.shape, dtype=np.float64)
    for index in np.ndindex(array.shape):
        value = array[index]
        try:
            if isinstance(value, (str, bytes, complex, np.complexfloating)):
                raise TypeError
            number = float("nan") if any(value is it for it in missing) else float(value)
        except OverflowError:
            raise DataError(f"{name}: {place_of(index)}: found a number beyond the range of "
                            "float64") from None
        except Exception:  # foreign objects may raise anything
            raise DataError(f"{name}: {place_of(index)}: found {type(value).__name__}, expected a "
                            "number") from None
        if isinstance(value, int) and abs(value) > _LARGEST:
            raise _too_large(name, index, value)
        numbers[index] = number
    return numbers


def _too_large(name: str, index: Sequence[int], value: Any) -> DataError:
    return DataError(f"{name}: {place_of(index)}: found {value}, expected whole numbers of at most "
                     "2**53 in absolute value, which float64 holds exactly; .astype(float) rounds "
                     "them")


def as_float64(array: NDArray[Any], name: str, mask: NDArray[np.bool_] | None = None
               ) -> NDArray[np.float64]:
    """The same numbers in native float64: the array itself if it has this type already.

    Entries where `mask` is true become NaN.
    """
    if mask is None and array.dtype == _FLOAT64 and is_aligned(array):
        return array
    kind, size = array.dtype.kind, array.dtype.itemsize
    if kind in "iu" and size == 8 and array.size and (
            int(array.max()) > _LARGEST or int(array.min()) < -_LARGEST):
        beyond = array > _LARGEST
        if kind == "i":
            beyond |= array < -_LARGEST
        if mask is not None:
            beyond &= ~mask
        if beyond.any():
            index = first_of(beyond)
            raise _too_large(name, index, array[index])
    with np.errstate(over="ignore"):
        numbers = _copied(array, np.float64, name)
    if kind == "f" and size > 8:
        lost = np.isinf(numbers) & ~np.isinf(array)
        if lost.any():
            raise DataError(f"{name}: {place_of(first_of(lost))}: found a number beyond the range "
                            "of float64")
    if mask is not None:
        numbers[mask] = np.nan
    return numbers


def require_room(needed: int, what: str,
                 way_out: str = "pass less data or a larger memory_limit") -> None:
    """Refuses data whose conversion, with the copies of input so far, would take more memory than
    a computation may take."""
    limit = _run.memory_limit({})
    if limit is not None and needed > limit - sum(_run.copies()):
        raise MemoryLimitError(f"memory limit of {in_units(limit)} would be exceeded: {what} "
                               f"{in_units(needed)}; {way_out}")


def _exceeds_memory(needed: int) -> bool:
    """True if so many bytes do not fit into memory. They are refused before they are used, because
    the system promises more memory than it has."""
    return needed > _LARGE and needed > _core.memory_left()


def new_array(shape: int | tuple[int, ...]) -> NDArray[np.float64]:
    """A new array of float64 to be filled in, within the memory that `limits` sets."""
    needed = math.prod(shape if isinstance(shape, tuple) else (shape,)) * 8
    if needed > _LARGE:
        require_room(needed, f"a result of shape {shape} takes", "ask for less or raise the limit")
    if _exceeds_memory(needed):
        raise MemoryLimitError(f"found a result of shape {shape}, whose {needed} bytes would "
                               "exceed the available memory")
    array: NDArray[np.float64] = np.empty(shape)
    return array


def side_by_side(array: NDArray[Any], name: str) -> NDArray[Any]:
    """The same numbers in C order without gaps: the array itself if it has this layout already."""
    return array if array.flags.c_contiguous else _copied(array, array.dtype, name)


def _copied(array: NDArray[Any], dtype: DTypeLike, name: str) -> NDArray[Any]:
    """A copy of another type, in C order."""
    needed = array.size * np.dtype(dtype).itemsize
    if needed > _LARGE:
        require_room(needed, f"a copy of {name} in {np.dtype(dtype)} takes",
                     "pass less data or raise the limit")
        _run.copies().append(needed)
    if _exceeds_memory(needed):
        raise MemoryLimitError(f"{name}: found {array.size} numbers of type {array.dtype}, whose "
                               f"copy of type {np.dtype(dtype)} would exceed the available memory")
    return array.astype(dtype, order="C")


def is_aligned(array: NDArray[Any]) -> bool:
    """True if all numbers and the steps between them are aligned."""
    size = array.itemsize
    for step in array.strides:
        if step % size:
            return False
    return bool(array.flags.aligned)


def as_points(data: Any, name: str = "X") -> NDArray[np.float64]:
    """Points, one per row. The fields x, y and z of a structured array, or all its fields if they are
    floats, are coordinates."""
    if isinstance(data, np.ndarray) and data.dtype.names is not None:
        data = _fields_of(data, name)
    array = as_array(data, name)
    if array.ndim != 2:
        if array.size == 0 and array.ndim == 1:
            return np.empty((0, 0))
        hint = {0: "", 1: "; .reshape(-1, 1) makes each number a point, metric='precomputed' "
                          "reads condensed distances"}.get(array.ndim, "; ph.cubical takes images")
        if array.ndim == 3 and array.shape[2] == 3:
            hint = "; .reshape(-1, 3) makes points of an organised cloud" + hint
        raise UsageError(f"{name}: found an array of shape {array.shape}, expected (points, "
                         f"coordinates){hint}")
    _warn_of_columns(data, array, name)
    return as_float64(array, name)


def _fields_of(data: NDArray[Any], name: str) -> NDArray[np.float64]:
    """The coordinates in a structured array, such as the vertices of a RealSense camera."""
    names = list(data.dtype.names or ())
    fields = [field for axis in "xyz" for field in names if field.lower() == axis]
    kinds = "biuf"
    if [field.lower() for field in fields] != ["x", "y", "z"]:
        fields, kinds = names, "f"
    if not all(data.dtype[field].kind in kinds for field in fields):
        raise DataError(f"{name}: found records of the fields {', '.join(names)}, expected numbers "
                        "x, y and z, or only floats; "
                        "numpy.lib.recfunctions.structured_to_unstructured makes points of the "
                        "fields that you choose")
    columns = [(data[field].ravel(), f"{name}[{field!r}]") for field in fields]
    return np.stack([as_float64(as_array(column, place), place) for column, place in columns], axis=1)


def _warn_of_columns(data: Any, points: NDArray[Any], name: str) -> None:
    """Warns of columns that are probably not coordinates: columns of a data frame beside x and y,
    latitudes and longitudes, or whole numbers beside three columns of fractions."""
    if hasattr(data, "columns"):
        return _warn_of_names([str(column) for column in data.columns], name)
    rows, columns = points.shape
    if rows < 8 or not 3 < columns <= 7 or points.dtype.kind != "f":
        return
    with np.errstate(invalid="ignore"):
        whole = [bool((np.floor(points[:, k]) == points[:, k]).all()) for k in range(columns)]
    if whole == [k >= 3 for k in range(columns)]:
        which = "column 3 has" if columns == 4 else f"columns 3 to {columns - 1} have"
        _warn(f"{name}: {which} only whole numbers, unlike the first three, and "
              f"{'is read as a coordinate' if columns == 4 else 'are read as coordinates'}; "
              f"{name}[:, :3] leaves {'it' if columns == 4 else 'them'} out")


def _warn_of_names(names: list[str], name: str) -> None:
    axes = [column for column in names if column.lower() in ("x", "y", "z")]
    found = [column.lower() for column in axes]
    others = [column for column in names if column not in axes]
    if others and found in (["x", "y"], ["x", "y", "z"]):
        shown = others if len(others) <= 3 else [*others[:2], f"{len(others) - 2} more"]
        _warn(f"{name}: read {' and '.join([', '.join(shown[:-1]), shown[-1]] if shown[1:] else shown)} "
              f"as {'a coordinate' if len(others) == 1 else 'coordinates'}; {name}[{axes}] leaves "
              f"{'it' if len(others) == 1 else 'them'} out")
    degrees = [[column for column in names if column.lower() in known] for known in
               (("lat", "latitude"), ("lon", "lng", "long", "longitude"))]
    if [len(columns) for columns in degrees] == [1, 1]:
        (lat,), (lon,) = degrees
        _warn(f"{name}: read {lat} and {lon} as coordinates of the plane, but differences of degrees "
              f"are not distances; (cos {lat} cos {lon}, cos {lat} sin {lon}, sin {lat}) is the "
              "point on the unit sphere")


def _warn(text: str) -> None:
    warnings.warn(text, UserWarning, stacklevel=_options.user_level())


def as_distances(data: Any, name: str = "X") -> NDArray[Any]:
    """Distances in float32 or float64, square or condensed."""
    array = as_array(data, name)
    if array.ndim not in (1, 2) or (array.ndim == 2 and array.shape[0] != array.shape[1]):
        raise UsageError(f"{name}: found an array of shape {array.shape}, expected distances: a "
                         "square matrix, or n(n-1)/2 numbers as scipy.spatial.distance.pdist gives "
                         "them")
    if array.dtype == _FLOAT32 and is_aligned(array):
        return array
    return as_float64(array, name)


def as_image(data: Any, name: str = "image") -> NDArray[Any]:
    """An image in one of the types that libph keeps: uint8, uint16, int16, float32, float64."""
    array = as_array(data, name)
    if not 1 <= array.ndim <= 8:
        raise UsageError(f"{name}: found an array of shape {array.shape}, expected 1 to 8 axes")
    _warn_of_colours(array, name)
    kind, size = array.dtype.kind, array.dtype.itemsize
    if kind == "b":
        return array.view(np.uint8)
    if (kind, size) in (("u", 1), ("u", 2), ("i", 2), ("f", 4), ("f", 8)):
        if array.dtype.isnative and is_aligned(array):
            return array
        return _copied(array, array.dtype.newbyteorder("="), name)
    if (kind, size) == ("i", 1):
        return _copied(array, np.int16, name)
    if (kind, size) == ("f", 2):
        return _copied(array, np.float32, name)
    return as_float64(array, name)


def _warn_of_colours(array: NDArray[Any], name: str) -> None:
    """Warns of an array that may be a colour picture: three axes, the last or the first one with 3
    or 4 entries, bytes or numbers from 0 to 1."""
    places = [("..., 0", -1, array.shape[:2]), ("0", 0, array.shape[1:])]
    found = [(first, array.shape[axis]) for first, axis, size in places if array.ndim == 3
             and array.shape[axis] in (3, 4) and min(size) >= 16]
    if not found:
        return
    first, channels = found[0]
    with np.errstate(invalid="ignore"):
        is_share = array.dtype.kind == "f" and bool(((array >= 0) & (array <= 1)).all())
    if array.dtype == np.uint8 or is_share:
        _warn(f"{name}: read as a volume of {' x '.join(map(str, array.shape))} voxels; if it is a "
              f"picture with {channels} channels, take one channel, {name}[{first}]")


def as_values(data: Any, name: str, count: int | None = None, of: str = "number"
              ) -> NDArray[np.float64]:
    """A contiguous array of one axis with `count` numbers."""
    array = as_array(data, name)
    if array.ndim != 1 or (count is not None and array.shape[0] != count):
        expected = "one axis" if count is None else f"{count} numbers, one for each {of}"
        raise UsageError(f"{name}: found an array of shape {array.shape}, expected {expected}")
    return side_by_side(as_float64(array, name), name)


def as_integers(data: Any, name: str) -> NDArray[np.int64]:
    """Whole numbers as int64, of any shape, in C order."""
    array = as_array(data, name)
    if array.dtype.kind == "f":
        with np.errstate(invalid="ignore"):
            numbers = array.astype(np.int64)
        wrong = (numbers != array) | (np.abs(array) > _LARGEST)
    elif array.dtype.kind == "u" and array.dtype.itemsize == 8:
        numbers, wrong = array.astype(np.int64), array > np.uint64(2**63 - 1)
    elif array.dtype.kind in "iu":
        return np.ascontiguousarray(array, dtype=np.int64)
    else:
        raise DataError(f"{name}: found {array.dtype.name}, expected whole numbers")
    if wrong.any():
        index = first_of(wrong)
        raise DataError(f"{name}: {place_of(index)}: found {array[index]}, expected a whole number, "
                        "as a float at most 2**53 in absolute value, as an integer below 2**63")
    return np.ascontiguousarray(numbers)


def is_mapped_file(array: NDArray[Any]) -> bool:
    """True if the array is a file that is mapped read-only, whose pages the system may drop from
    memory."""
    if not isinstance(array, np.memmap) or array.mode != "r":
        return False
    import mmap
    base: Any = array
    while isinstance(base, np.ndarray):
        base = base.base
    return isinstance(base, mmap.mmap)
