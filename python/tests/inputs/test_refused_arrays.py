# SPDX-License-Identifier: MIT
"""Inputs that are not arrays of numbers are refused with a message that says where the fault is,
and are never modified."""
import re

import numpy as np
import pandas
import pytest
import scipy.sparse as sparse

import libph as ph
from libph import gradients
from libph.compat import gph, ripser
from libph.compat.gudhi.flag_filtration import edge_collapse

NAN, INF = np.nan, np.inf
BIG = 2**53 + 1
pre = {"metric": "precomputed"}


def matrix(*entries, n=4):
    """A matrix of ones in which some entries are replaced."""
    made = np.ones((n, n)) - np.eye(n)
    for i, j, value in entries:
        made[i, j] = value
    return made


def pairs(*entries, n=4):
    i, j, values = zip(*entries)
    return sparse.coo_matrix((values, (i, j)), shape=(n, n))


def point(i, k, value, dtype=None):
    """Points with one coordinate replaced."""
    made = np.zeros((5, 3)) if dtype is None else np.zeros((5, 3), dtype)
    made[i, k] = value
    return made


class Broken:
    def __array__(self, dtype=None, copy=None):
        raise OSError("device lost")


class Cuda:
    def __array__(self, dtype=None, copy=None):
        raise TypeError("can't convert cuda:0 device type tensor to numpy")


# (name, function, arguments, keyword arguments, words of the message)
BAD = [
    # data that are not arrays
    *[(f"{type(data).__name__} {data!r:.20}", ph.rips, (data,), {}, "found")
      for data in (None, "abc", b"abc", {}, {1: 2}, {1, 2}, 3, 2.5, object(), len, ph, Broken(),
                   Cuda(), [None], [[None, 1]], ["a", "b"], [["a"]], [[1], ["b"]], [[{}]],
                   range(3), iter([1, 2]), (x for x in [[1]]), Ellipsis, NotImplemented, 1j,
                   True, np.float64(1), np.array(3.0), slice(3), Exception("x"))],
    *[(f"image {data!r:.20}", ph.cubical, (data,), {}, "image: found")
      for data in (None, "abc", 3, object(), np.array(1.0), np.zeros((1,) * 9), {}, Broken())],
    *[(f"image of an Euler curve {data!r:.20}", ph.euler_curve, (data,), {}, "image: found")
      for data in (None, "abc", 3, object(), np.zeros((1,) * 9), Broken(),
                   np.zeros((3, 2), "complex128"), np.zeros((3, 2), "U3"))],
    # ragged rows
    ("rows of two lengths", ph.rips, ([[1, 2], [3]],), {}, "row 1: found 1 numbers, expected 2"),
    ("a number among rows", ph.rips, ([[1, 2], 3],), {}, "row 1: found one number, expected 2"),
    ("rows of three lengths", ph.rips, ([[1], [2], [3, 4, 5]],), {}, "row 2: found 3 numbers"),
    ("a ragged image", ph.cubical, ([[1, 2], [3]],), {}, "row 1"),
    ("ragged objects", ph.rips, (np.array([[1, 2], [3]], dtype=object),), {}, "found"),
    # wrong shapes
    ("numbers for points", ph.rips, ([1.0, 2.0],), {}, "reshape(-1, 1)"),
    ("three axes for points", ph.rips, (np.zeros((2, 2, 2)),), {}, "ph.cubical takes images"),
    ("no square", ph.rips, (np.zeros((3, 4)),), pre, "(3, 4), expected distances: a square"),
    ("three axes of distances", ph.rips, (np.zeros((2, 2, 2)),), pre, "(2, 2, 2)"),
    ("two condensed numbers", ph.rips, ([1.0, 2.0],), pre, "found 2 numbers, expected n(n-1)/2"),
    ("a sparse one that is no square", ph.rips, (sparse.coo_matrix((3, 4)),), pre, "(3, 4)"),
    *[(f"zeros that fill a matrix of format {kind}, {name}", function, (given,), keywords,
       f"row 0, column 2: found 0 in a matrix of format {kind}")
      for kind, given in (("bsr", pairs((0, 3, 1)).tobsr((2, 2))),
                          ("dia", pairs((1, 3, 1), (0, 1, 1), (1, 2, 1), (2, 3, 1)).todia()))
      for name, function, keywords in (
          ("rips", ph.rips, pre), ("collapse", ph.collapse, {}),
          ("ripser", ripser.ripser, {"distance_matrix": True}),
          ("gph", gph.ripser_parallel, pre),
          ("weighted gph", gph.ripser_parallel, {**pre, "weights": np.ones(4)}),
          ("reduce_graph", edge_collapse.reduce_graph, {}),
          ("gradients", lambda X: gradients.pullback(
              ph.rips(X.tocsr(), metric="precomputed"), X), {}))],
    ("sparse points", ph.rips, (sparse.eye(3),), {}, ".toarray() makes points of it"),
    ("a sparse image", ph.cubical, (sparse.eye(3),), {}, ".toarray()"),
    ("an image without voxels", ph.cubical, (np.zeros((3, 0)),), {}, "0"),
    ("a signal without values", ph.cubical, (np.zeros(0),), {}, "0"),
    ("one number as a diagram", ph.bottleneck, ([1.0], [[0, 1]]), {}, "rows (birth, death)"),
    ("three columns of a kernel's diagram", ph.diagram_kernels, ([np.zeros((2, 3))],), {}, "(2, 3)"),
    ("a text as diagrams", ph.diagram_kernels, ("abc",), {}, "diagrams: found 'abc', expected a list"),
    ("an Euler curve without voxels", ph.euler_curve, (np.zeros((3, 0)),), {}, "0"),
    ("three columns of a diagram", ph.bottleneck, (np.zeros((2, 3)), [[0, 1]]), {}, "(2, 3)"),
    # refused types
    *[(f"points of {kind}", ph.rips, (np.zeros((3, 2), kind),), {}, words)
      for kind, words in (("complex128", "complex"), ("complex64", "complex"), ("U3", "text"),
                          ("S3", "bytes"), ("M8[s]", "dates"), ("m8[s]", "times"),
                          ([("x", "f8"), ("id", "i4")], "records"), ("V8", "records"))],
    *[(f"an image of {kind}", ph.cubical, (np.zeros((3, 2), kind),), {}, words)
      for kind, words in (("complex128", "complex"), ("U3", "text"), ("M8[D]", "dates"),
                          ([("x", "f8")], "records"))],
    *[(f"distances of {kind}", ph.rips, (np.zeros((3, 3), kind),), pre, words)
      for kind, words in (("complex128", "complex"), ("U3", "text"), ("m8[D]", "times"))],
    ("sparse complex", ph.rips, (sparse.eye(3, dtype=complex),), pre, "complex128"),
    ("a text among objects", ph.rips, (np.array([[1, "a"]], dtype=object),), {}, "row 0, column 1"),
    ("a complex among objects", ph.rips, (np.array([[1], [2j]], dtype=object),), {},
     "row 1, column 0: found complex"),
    ("a list among objects", ph.cubical, (np.array([[1, [2]]], dtype=object),), {}, "column 1"),
    ("a column of text", ph.rips, (pandas.DataFrame({"x": [1, 2], "name": ["a", "b"]}),), {},
     "row 0, column 1: found str"),
    ("a column of dates", ph.rips,
     (pandas.DataFrame({"x": [1.0], "t": pandas.to_datetime(["2020-01-01"])}),), {}, "column 1"),
    ("a column of categories", ph.rips, (pandas.DataFrame({"c": pandas.Categorical(["a"])}),), {},
     "found str"),
    ("a frame with NA", ph.rips, (pandas.DataFrame({"x": [1, None]}, dtype="Int64"),), {},
     "point 1"),
    # whole numbers that a double cannot represent
    *[(f"{BIG} as {kind}", ph.rips, (point(2, 1, BIG, kind),), {}, f"row 2, column 1: found {BIG}")
      for kind in ("int64", "uint64", ">i8", "object")],
    ("a large negative one", ph.rips, (point(4, 0, -BIG, "int64"),), {}, f"found -{BIG}"),
    ("the largest of all", ph.rips, (point(0, 2, 2**64 - 1, "uint64"),), {}, "row 0, column 2"),
    ("a large voxel", ph.cubical, (point(3, 2, BIG, "int64"),), {}, "row 3, column 2"),
    ("a large voxel of three axes", ph.cubical, (np.full((2, 2, 2), BIG),), {}, "index (0, 0, 0)"),
    ("a large distance", ph.rips, (np.full((2, 2), BIG),), pre, "row 0, column 0"),
    ("a large value", ph.lower_star, ([0, BIG], [[0, 1]]), {}, "entry 1"),
    ("a large integer of Python", ph.rips, ([[10**30]],), {}, "row 0, column 0"),
    ("an integer beyond all doubles", ph.rips, ([[10**400]],), {}, "row 0, column 0"),
    ("a long double beyond all", ph.rips,
     (np.array([[1], [np.finfo(np.longdouble).max]], np.longdouble),), {}, "row 1, column 0"),
    # NaN and infinity
    ("NaN", ph.rips, (point(3, 2, NAN),), {}, "point 3"),
    ("infinity", ph.rips, (point(1, 0, INF),), {}, "point 1"),
    ("minus infinity", ph.rips, (point(1, 0, -INF),), {}, "point 1"),
    ("NaN in a list", ph.rips, ([[0, NAN]],), {}, "point 0"),
    ("NaN of float32", ph.rips, (point(2, 2, NAN, "float32"),), {}, "point 2"),
    ("infinity stays with nan='drop'", ph.rips, (point(1, 0, INF),), {"nan": "drop"}, "point 1"),
    ("NaN voxel", ph.cubical, (point(1, 1, NAN),), {}, "NaN"),
    ("NaN voxel of float32", ph.cubical, (point(1, 1, NAN, "float32"),), {}, "NaN"),
    ("NaN value", ph.lower_star, ([0, NAN], [[0, 1]]), {}, "NaN"),
    ("NaN of a simplex", ph.filtered, ([(0,)], [NAN]), {}, "NaN"),
    ("NaN in a kernel's diagram", ph.diagram_kernels, ([[[0, NAN]]],), {}, "row 0: found birth 0.0"),
    ("infinity in it", ph.diagram_kernels, ([[[0, INF]]],), {}, "death inf, expected finite"),
    ("NaN voxel of an Euler curve", ph.euler_curve, (point(1, 1, NAN),), {}, "row 1, column 1"),
    ("a large voxel of it", ph.euler_curve, (point(3, 2, BIG, "int64"),), {}, "row 3, column 2"),
    ("NaN in a diagram", ph.bottleneck, ([[0, NAN]], [[0, 1]]), {}, "NaN"),
    ("NaN distance", ph.rips, (matrix((2, 1, NAN), (1, 2, NAN)),), pre,
     "row 1, column 2: found nan"),
    ("NaN above the diagonal", ph.rips, (matrix((0, 3, NAN)),), pre, "row 0, column 3"),
    ("NaN below it", ph.rips, (matrix((3, 0, NAN)),), pre, "row 3, column 0"),
    ("NaN on the diagonal", ph.rips, (matrix((2, 2, NAN)),), pre, "row 2, column 2"),
    ("condensed NaN", ph.rips, ([1, 1, NAN],), pre, "entry 2, of points 1 and 2"),
    ("sparse NaN", ph.rips, (pairs((1, 2, NAN)),), pre, "row 1, column 2"),
    ("NaN on one side", ph.rips, (matrix((0, 3, NAN)),), {**pre, "nan": "drop"}, "asymmetric"),
    ("NaN of float32 distances", ph.rips, (matrix((3, 1, NAN)).astype("f4"),), pre, "row 3"),
    # distances
    ("negative", ph.rips, (matrix((2, 1, -1), (1, 2, -1)),), pre, "row 1, column 2: found -1"),
    ("minus infinity as a distance", ph.rips, (matrix((1, 0, -INF), (0, 1, -INF)),), pre, "-inf"),
    ("condensed negative", ph.rips, ([1, -2, 1],), pre, "entry 1, of points 0 and 2: found -2"),
    ("sparse negative", ph.rips, (pairs((3, 0, -1.5)),), pre, "row 3, column 0: found -1.5"),
    ("asymmetric", ph.rips, (matrix((3, 1, 2)),), pre,
     "row 3, column 1 is 2 but row 1, column 3 is 1"),
    ("asymmetric by infinity", ph.rips, (matrix((3, 1, INF)),), pre, "asymmetric"),
    ("sparse conflict", ph.rips, (pairs((0, 2, 1.0), (2, 0, 4.0)),), pre, "row 0, column 2"),
    ("sparse conflict of duplicates", ph.rips, (pairs((0, 2, 1.0), (0, 2, 4.0)),), pre, "found 1"),
    ("a diagonal", ph.rips, (matrix((1, 1, 0.5)),), pre, "row 1, column 1: found 0.5"),
    ("a sparse diagonal", ph.rips, (pairs((1, 1, 0.5)),), pre, "row 1, column 1: found 0.5"),
    ("correlations", ph.rips, (np.eye(3),), pre, "1 on the whole diagonal"),
    ("negative births", ph.rips, (matrix((1, 1, -1)),), {**pre, "diagonal": "births"}, "vertex 1"),
    ("infinite births", ph.rips, (matrix((1, 1, INF)),), {**pre, "diagonal": "births"},
     "vertex 1"),
    ("a zero row and cosine", ph.rips, (point(1, 1, 1.0),), {"metric": "cosine"}, "point 0"),
    ("distances that overflow", ph.rips, ([[1.7e308], [-1.7e308]],), {}, "farther apart"),
    ("a metric that is negative", ph.rips, ([[0], [1]],), {"metric": lambda a, b: -1.0},
     "points 0 and 1: found -1"),
    ("a metric that is NaN", ph.rips, ([[0], [1]],), {"metric": lambda a, b: NAN},
     "points 0 and 1: found nan"),
    ("a metric that is text", ph.rips, ([[0], [1]],), {"metric": lambda a, b: "far"}, "found str"),
    ("a metric that is None", ph.rips, ([[0], [1]],), {"metric": lambda a, b: None}, "points 0"),
    ("a metric that is complex", ph.rips, ([[0], [1]],), {"metric": lambda a, b: 1j}, "complex"),
    # simplices
    ("no simplices", ph.filtered, (None, []), {}, "simplices: found NoneType"),
    ("a text of simplices", ph.filtered, ("01", []), {}, "simplices: found str"),
    ("a number for a simplex", ph.filtered, ([0, 1], [0, 0]), {}, "simplex 0: found int"),
    ("a text for a simplex", ph.filtered, (["ab"], [0]), {}, "simplex 0: found str"),
    ("a simplex without vertices", ph.filtered, ([(0,), ()], [0, 0]), {}, "simplex 1"),
    ("half a vertex", ph.filtered, ([(0,), (1.5,)], [0, 0]), {}, "simplex 1: entry 0: found 1.5"),
    ("a named vertex", ph.filtered, ([("a",)], [0]), {}, "simplex 0"),
    ("a vertex that is NaN", ph.filtered, ([(NAN,)], [0]), {}, "found nan"),
    ("a vertex below 0", ph.filtered, ([(-1,)], [0]), {}, "-1"),
    ("a large vertex", ph.lower_star, ([0, 1], [[0, 2**40]]), {}, "vertex"),
    ("a vertex beyond int64", ph.lower_star, ([0, 1], [[0, 2**70]]), {}, "found"),
    ("a vertex twice", ph.filtered, ([(0,), (0, 0)], [0, 0]), {}, "twice"),
    ("a simplex twice", ph.filtered, ([(0,), (0,)], [0, 0]), {}, "twice"),
    ("a face that is missing", ph.filtered, ([(0,), (0, 1)], [0, 0]), {}, "cell 1"),
    ("a face that is late", ph.filtered, ([(0,), (1,), (0, 1)], [0, 2, 1]), {}, "cell 2"),
    ("too few values", ph.filtered, ([(0,), (1,)], [0]), {}, "2 numbers, one for each simplex"),
    ("too many values", ph.filtered, ([(0,)], [0, 1]), {}, "1 numbers, one for each simplex"),
    ("a vertex without a value", ph.lower_star, ([0, 1], [[0, 2]]), {}, "vertex 2"),
    ("three axes of simplices", ph.lower_star, ([0, 1], np.zeros((1, 1, 2), int)), {}, "(1, 1, 2)"),
    ("simplices of floats", ph.lower_star, ([0, 1], [[0.5, 1]]), {}, "found 0.5"),
    ("simplices of complex numbers", ph.lower_star, ([0, 1], np.ones((1, 2), complex)), {},
     "complex"),
    ("two axes of values", ph.lower_star, ([[0, 1]], [[0, 1]]), {}, "values: found"),
    # boundary matrices
    ("a dense boundary", ph.boundary, (np.zeros((2, 2)), [0, 0]), {}, "matrix: found ndarray"),
    ("a boundary that is no square", ph.boundary, (sparse.coo_matrix((2, 3)), [0, 0]), {}, "(2, 3)"),
    ("dims of another count", ph.boundary, (sparse.coo_matrix((2, 2)), [0]), {}, "dims: found"),
    ("dims below 0", ph.boundary, (sparse.coo_matrix((2, 2)), [0, -1]), {}, "dims: found -1"),
    ("dims of text", ph.boundary, (sparse.coo_matrix((2, 2)), ["a", "b"]), {}, "dims: found text"),
    ("half an incidence", ph.boundary, (pairs((0, 1, 0.5), n=2), [0, 1]), {}, "found 0.5"),
    ("a huge incidence", ph.boundary, (pairs((0, 1, 2**40), n=2), [0, 1]), {"field": 3},
     "matrix: found"),
    ("an incidence beyond all", ph.boundary, (pairs((0, 1, INF), n=2), [0, 1]), {}, "found inf"),
    ("a facet of another dimension", ph.boundary, (pairs((0, 1, 1), n=2), [0, 2]), {}, "cell 1"),
    ("no boundary of a boundary", ph.boundary,
     (pairs((0, 2, 1), (1, 2, 1), (2, 3, 1)), [0, 0, 1, 2]), {}, "cell 3"),
    ("values of another count", ph.boundary, (sparse.coo_matrix((2, 2)), [0, 0], [1]), {},
     "2 numbers, one for each cell"),
    # other arguments
    ("weights of another count", ph.rips, ([[0], [1]],), {"weights": [1]}, "2 numbers, one for"),
    ("negative weights", ph.rips, ([[0], [1]],), {"weights": [0, -1]}, "entry 1: found -1"),
    ("infinite weights", ph.rips, ([[0], [1]],), {"weights": [0, INF]}, "entry 1: found inf"),
    ("NaN weights", ph.rips, ([[0], [1]],), {"weights": [NAN, 0]}, "entry 0: found nan"),
    ("weights of text", ph.rips, ([[0]],), {"weights": ["a"]}, "weights: found text"),
    ("weights of two axes", ph.rips, ([[0], [1]],), {"weights": [[0], [1]]}, "weights: found"),
    ("a death before its birth", ph.bottleneck, ([[2, 1]], [[0, 1]]), {}, "2"),
    ("no points for an image", ph.point_image, (np.empty((0, 2)), 1), {}, "point"),
    ("points of nine coordinates", ph.point_image, (np.zeros((2, 9)), 1), {}, "9"),
    ("infinite points for an image", ph.point_image, ([[INF]], 1), {}, "not finite"),
    ("sparse for farthest points", ph.farthest_points, (sparse.eye(2),), pre, "row 0, column 0"),
    ("some distances for farthest points", ph.farthest_points, (pairs((0, 1, 1.0)),), pre, "all"),
    ("some distances for a measure", ph.distance_to_measure, (pairs((0, 1, 1.0)), 1), pre, "all"),
    ("points for a collapse", ph.collapse, (np.zeros((3, 2)),), {}, "(3, 2)"),
    ("text for a merge tree", ph.merge_tree, ("abc",), {}, "X: found str"),
    ("text for an estimate", ph.estimate, ("abc",), {}, "X: found str"),
    ("a grid of text", lambda g: ph.rips([[0]]).betti_curve(g), ("abc",), {}, "grid"),
]


def test_there_are_many():
    assert len(BAD) >= 150


@pytest.mark.parametrize("name, function, arguments, keywords, words", BAD,
                         ids=[entry[0] for entry in BAD])
def test_bad_arrays(name, function, arguments, keywords, words):
    before = [np.array(a) for a in arguments if isinstance(a, np.ndarray)]
    with pytest.raises((ph.DataError, ph.UsageError)) as caught:
        function(*arguments, **keywords)
    message = str(caught.value)
    assert words.lower() in message.lower(), message
    assert isinstance(caught.value, ValueError)
    assert "\n" not in message and "_core" not in message
    assert not re.search(r"--[a-z]", message), "options of the program"
    for array, copy in zip((a for a in arguments if isinstance(a, np.ndarray)), before):
        assert array.dtype.kind == "O" or array.tobytes() == copy.tobytes()
