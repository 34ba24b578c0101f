# SPDX-License-Identifier: MIT
"""Calls of the C interface (ph/ph.h) with NULL, wrong sizes, options out of range or invalid
numbers. The calls go through ctypes, which checks nothing."""
import ctypes
import math

import numpy as np

STATUS = ("=", "USAGE", "BAD_DATA", "RESOURCE", "CANCELLED", "INTERNAL")
SIZE = ctypes.c_size_t
INDEX = ctypes.c_int64


class Options(ctypes.Structure):
    """The struct ph_options."""
    _fields_ = [("size", SIZE), ("max_dim", ctypes.c_int32), ("min_dim", ctypes.c_int32),
                ("field", INDEX), ("threshold", ctypes.c_double), ("min_persistence", ctypes.c_double),
                ("cells", ctypes.c_int32), ("threads", ctypes.c_int32), ("memory_limit", ctypes.c_uint64),
                ("cancel", ctypes.c_void_p), ("cancel_user", ctypes.c_void_p),
                ("distance", ctypes.c_int32), ("minkowski_p", ctypes.c_double),
                ("construction", ctypes.c_int32), ("superlevel", ctypes.c_int32),
                ("masked", ctypes.c_int32), ("periodic", ctypes.c_void_p)]


POINTS = np.random.default_rng(0).random((10, 3))
DISTANCES = np.ones(45)
IMAGE = np.random.default_rng(1).random((4, 5))


class Library:
    def __init__(self, path):
        self.c = ctypes.CDLL(path)
        self.c.ph_last_error.restype = ctypes.c_char_p
        self.c.ph_barcode_size.restype = SIZE

    def options(self, **values):
        """The default options with some changes."""
        options = Options()
        self.c.ph_options_init_sized(ctypes.byref(options), SIZE(ctypes.sizeof(options)))
        for name, value in values.items():
            setattr(options, name, value)
        return ctypes.byref(options)

    def said(self, status, handles=()):
        """The outcome of a call in the form that run_calls.py expects. A failing call must not
        change `out`."""
        words = self.c.ph_last_error().decode()
        left = [handle.value for handle in handles if handle.value is not None]
        if status != 0 and left:
            return f"{STATUS[status]}, and out was set: {words}"
        bars = sum(self.c.ph_barcode_size(handle) for handle in handles)
        for handle in handles:
            self.c.ph_barcode_free(handle)
        return f"{STATUS[status]}: " + (f"{bars} bars" if status == 0 else words)

    def points(self, data=POINTS, rows=10, columns=3, row_stride=3, column_stride=1, has_out=True, **values):
        out = ctypes.c_void_p()
        status = self.c.ph_rips_points(
            _address(data), INDEX(rows), INDEX(columns), INDEX(row_stride), INDEX(column_stride),
            self.options(**values), ctypes.byref(out) if has_out else None)
        return self.said(status, [out] if has_out else [])

    def distances(self, data=DISTANCES, size=10, has_out=True, **values):
        out = ctypes.c_void_p()
        status = self.c.ph_rips_distances(_address(data), INDEX(size), self.options(**values),
                                          ctypes.byref(out) if has_out else None)
        return self.said(status, [out] if has_out else [])

    def image(self, data=IMAGE, type_=4, axes=2, extents=(4, 5), strides=None, has_out=True, **values):
        out = ctypes.c_void_p()
        status = self.c.ph_cubical_image(
            _address(data), ctypes.c_int32(type_), ctypes.c_int32(axes), _numbers(extents),
            _numbers(strides), self.options(**values), ctypes.byref(out) if has_out else None)
        return self.said(status, [out] if has_out else [])

    def batch(self, clouds, rows, columns=3, count=None, has_out=True, **values):
        given = (ctypes.c_void_p * 8)(*[_address(c).value if c is not None else None
                                        for c in clouds or ()]) if clouds is not None else None
        count = len(clouds) if count is None else count
        out = (ctypes.c_void_p * 8)()
        status = self.c.ph_rips_points_batch(given, _numbers(rows), INDEX(columns), SIZE(count),
                                             self.options(**values), out if has_out else None)
        return self.said(status, [ctypes.c_void_p(value) for value in out][:min(count, 8)])

    def images(self, images, extents=(4, 5), count=None, **values):
        given = (ctypes.c_void_p * 8)(*[_address(c).value if c is not None else None
                                        for c in images or ()]) if images is not None else None
        count = len(images) if count is None else count
        out = (ctypes.c_void_p * 8)()
        status = self.c.ph_cubical_image_batch(given, ctypes.c_int32(4), ctypes.c_int32(len(extents)),
                                               _numbers(extents), SIZE(count), self.options(**values), out)
        return self.said(status, [ctypes.c_void_p(value) for value in out][:min(count, 8)])

    def handles(self):
        """Calls with NULL as the handle, and calls for a bar beyond the last bar of a handle."""
        out = ctypes.c_void_p()
        self.c.ph_rips_points(_address(POINTS), INDEX(10), INDEX(3), INDEX(3), INDEX(1), None, ctypes.byref(out))
        numbers = ctypes.c_void_p(1)
        found = [self.c.ph_barcode_size(None), self.c.ph_barcode_bars(None)]
        for handle, place in ((None, 0), (out, 2**64 - 1), (out, 10**6)):
            for cell in (self.c.ph_barcode_birth_cell, self.c.ph_barcode_death_cell):
                found += [cell(handle, SIZE(place), ctypes.byref(numbers)), numbers.value,
                          cell(handle, SIZE(place), None)]
        self.c.ph_options_init_sized(None, SIZE(100))
        self.c.ph_barcode_free(None)
        self.c.ph_barcode_free(out)
        return "=: " + ("nothing" if not any(found) else str(found))


def _address(array):
    return ctypes.c_void_p(array.ctypes.data) if array is not None else None


def _numbers(values):
    return (INDEX * max(1, len(values)))(*values) if values is not None else None


def with_number(array, place, value):
    array = np.array(array, dtype=float)
    array[place] = value
    return array


def prepared(path):
    names = {"c": Library(path), "np": np, "nan": math.nan, "inf": math.inf, "with_number": with_number,
             "POINTS": POINTS, "DISTANCES": DISTANCES, "IMAGE": IMAGE}
    return lambda text: lambda: eval(text, names)  # evaluates only texts in this file


CALLS = [(room, text, expected, words) for room, rows in {
    "points": [
        ("c.points()", "=", "bars"),
        ("c.points(None)", "USAGE", "data: found NULL"),
        ("c.points(has_out=False)", "USAGE", "out: found NULL"),
        ("c.points(rows=-1)", "USAGE", "expected 0 or more"),
        ("c.points(columns=-1)", "USAGE", "expected 0 or more"),
        ("c.points(rows=-2**63)", "USAGE", "expected 0 or more"),
        ("c.points(rows=2**62)", "RESOURCE", "found 4611686018427387904"),
        ("c.points(rows=2**32, row_stride=0)", "RESOURCE", "found 4294967296"),
        ("c.points(None, rows=2**62, columns=0)", "RESOURCE", "found 4611686018427387904"),
        ("c.points(rows=2**33, columns=2**33, row_stride=0, column_stride=0)", "RESOURCE", "found 8589934592"),
        ("c.points(rows=1, columns=2**40, column_stride=0)", "RESOURCE", "memory"),
        ("c.points(rows=0, columns=2**62)", "=", "0 bars"),
        ("c.points(None, rows=0)", "=", "0 bars"),
        ("c.points(None, rows=200_000, columns=0)", "=", "1 bars"),
        ("c.points(None, rows=200_000, columns=0, max_dim=0)", "=", "1 bars"),
        ("c.points(rows=200_000, row_stride=0)", "=", "1 bars"),
        ("c.points(rows=200_000, row_stride=0, max_dim=2)", "=", "1 bars"),
        ("c.points(with_number(POINTS, (1, 1), nan))", "BAD_DATA", "point 1, coordinate 1: found nan"),
        ("c.points(with_number(POINTS, (9, 2), inf))", "BAD_DATA", "point 9, coordinate 2: found inf"),
        ("c.points(np.zeros((10, 3)), distance=4)", "BAD_DATA", "point 0: found the zero vector"),
    ],
    "options of points": [
        ("c.points(size=0)", "USAGE", "size 0"), ("c.points(size=7)", "USAGE", "size 7"),
        ("c.points(size=8)", "=", "bars"), ("c.points(size=13)", "=", "bars"),
        ("c.points(size=10**6)", "USAGE", "size 1000000"),
        ("c.points(size=2**64 - 1)", "USAGE", "size 18446744073709551615"),
        ("c.points(max_dim=-2)", "USAGE", "max_dim: found -2"),
        ("c.points(max_dim=-2**31)", "USAGE", "max_dim"),
        ("c.points(min_dim=-1)", "USAGE", "lowest dimension: found -1"),
        ("c.points(min_dim=2, max_dim=1)", "USAGE", "min_dim: found 2, expected at most max_dim .1."),
        ("c.points(field=0)", "USAGE", "field: found 0, expected a prime below 2.31"), ("c.points(field=1)", "USAGE", "found 1"),
        ("c.points(field=4)", "USAGE", "found 4"), ("c.points(field=-3)", "USAGE", "found -3"),
        ("c.points(field=2**31)", "USAGE", "2147483648"), ("c.points(field=2**62)", "USAGE", "46116860184"),
        ("c.points(threshold=-1.0)", "USAGE", "threshold: found -1"),
        ("c.points(threshold=-inf)", "USAGE", "threshold: found -inf"),
        ("c.points(with_number(POINTS, (1, 1), nan), threshold=-1)", "USAGE", "threshold: found -1"),
        ("c.points(min_persistence=nan)", "USAGE", "least persistence: found nan"),
        ("c.points(threads=-1)", "USAGE", "threads"),
        ("c.points(memory_limit=1)", "RESOURCE", "memory limit"),
        ("c.points(distance=-1)", "USAGE", "distance: found -1, expected 0 to 5"),
        ("c.points(distance=6)", "USAGE", "distance: found 6"),
        ("c.points(distance=2**31 - 1)", "USAGE", "distance: found 2147483647"),
        ("c.points(distance=3, minkowski_p=nan)", "USAGE", "exponent: found nan"),
        ("c.points(distance=3, minkowski_p=0.5)", "USAGE", "exponent: found 0.5"),
        ("c.points(distance=3, minkowski_p=-1.0)", "USAGE", "exponent: found -1"),
    ],
    "distances": [
        ("c.distances()", "=", "10 bars"), ("c.distances(None)", "USAGE", "lower: found NULL"),
        ("c.distances(has_out=False)", "USAGE", "out: found NULL"),
        ("c.distances(None, 1)", "=", "1 bars"), ("c.distances(None, 0)", "=", "0 bars"),
        ("c.distances(size=-1)", "USAGE", "found -1 points"), ("c.distances(size=2**31 + 1)", "USAGE", "2.31"),
        ("c.distances(size=2**62)", "USAGE", "2.31"), ("c.distances(None, 2**31)", "USAGE", "found NULL"),
        ("c.distances(size=10**6, memory_limit=10**6)", "RESOURCE", "memory limit"),
        ("c.distances(with_number(DISTANCES, 3, nan), max_dim=-2)", "USAGE", "max_dim: found -2"),
        ("c.distances(with_number(DISTANCES, 3, nan))", "BAD_DATA", r"distance \(3, 0\): found nan"),
        ("c.distances(with_number(DISTANCES, 44, -1))", "BAD_DATA", r"distance \(9, 8\): found -1"),
        ("c.distances(with_number(DISTANCES, 0, -inf))", "BAD_DATA", r"distance \(1, 0\): found -inf"),
        ("c.distances(with_number(DISTANCES, 0, inf))", "=", "10 bars"),
        ("c.distances(threshold=-1.0)", "USAGE", "threshold: found -1"),
    ],
    "images": [
        ("c.image()", "=", "bars"), ("c.image(None)", "USAGE", "data: found NULL"),
        ("c.image(extents=None)", "USAGE", "extents: found NULL"),
        ("c.image(has_out=False)", "USAGE", "out: found NULL"),
        ("c.image(axes=0)", "USAGE", "axes: found 0"), ("c.image(axes=-1)", "USAGE", "axes: found -1"),
        ("c.image(axes=9, extents=(1,) * 9)", "USAGE", "axes: found 9"),
        ("c.image(axes=2**31 - 1)", "USAGE", "axes: found 2147483647"),
        ("c.image(type_=5)", "USAGE", "ph_number"), ("c.image(type_=-1)", "USAGE", "ph_number"),
        ("c.image(extents=(0, 5))", "USAGE", "extent 0: found 0"),
        ("c.image(extents=(4, -5))", "USAGE", "extent 1: found -5"),
        ("c.image(extents=(2**16, 2**16))", "USAGE", "extent 1: found 65536"),
        ("c.image(extents=(2**63 - 1, 2**63 - 1))", "USAGE", "extent 0: found 9223372036854775807"),
        ("c.image(extents=(2**15, 2**16), strides=(0, 0), memory_limit=10**8)", "RESOURCE", "memory limit"),
        ("c.image(strides=(0, 0))", "=", "1 bars"),
        ("c.image(with_number(IMAGE, (0, 3), nan))", "BAD_DATA", "voxel 3: found nan"),
        ("c.image(IMAGE * nan, masked=1)", "=", "0 bars"),
        ("c.image(construction=2)", "USAGE", "construction: found 2"),
        ("c.image(construction=-1)", "USAGE", "construction: found -1"),
        ("c.image(min_dim=2, max_dim=1)", "USAGE", "min_dim: found 2, expected at most max_dim .1."),
        ("c.image(field=6)", "USAGE", "found 6"), ("c.image(memory_limit=1)", "RESOURCE", "memory limit"),
    ],
    "many at a time": [
        ("c.batch([POINTS, POINTS], [10, 10])", "=", "bars"), ("c.batch(None, None, count=0)", "=", "0 bars"),
        ("c.batch(None, [10], count=1)", "USAGE", "input 0: clouds or rows: found NULL"),
        ("c.batch([POINTS], None)", "USAGE", "input 0: clouds or rows: found NULL"),
        ("c.batch([POINTS, None], [10, 10])", "USAGE", "input 1: data: found NULL"),
        ("c.batch([POINTS, POINTS], [10, -1])", "USAGE", "input 1: points: found "),
        ("c.batch([POINTS], [10], columns=-3)", "USAGE", "input 0: points: found "),
        ("c.batch([POINTS], [10], has_out=False)", "USAGE", "out: found NULL"),
        ("c.batch([POINTS, with_number(POINTS, (0, 1), nan)], [10, 10])", "BAD_DATA", "input 1: point 0, coord"),
        ("c.batch([POINTS], [10], field=4)", "USAGE", "found 4"),
        ("c.batch([POINTS], [10], count=2**60)", "RESOURCE", "memory"),
        ("c.batch([POINTS], [10], count=2**64 - 1)", "RESOURCE", "memory"),
        ("c.batch([POINTS], [10], memory_limit=1)", "RESOURCE", "memory limit"),
        ("c.images(None, count=1)", "USAGE", "images: found NULL"),
        ("c.images([IMAGE, None])", "USAGE", "input 1: data: found NULL"),
        ("c.images([IMAGE], extents=(4, 0))", "USAGE", "extent 1: found 0"),
        ("c.images([IMAGE, with_number(IMAGE, (1, 0), nan)])", "BAD_DATA", "input 1: voxel 5: found nan"),
        ("c.images([IMAGE], count=2**62)", "RESOURCE", "memory"),
    ],
    "handles": [("c.handles()", "=", "nothing")],
}.items() for text, expected, words in rows]
