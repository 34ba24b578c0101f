# SPDX-License-Identifier: MIT
"""Arrays of all kinds: taken rightly, or refused in words, and never written to."""
import collections
import decimal
import fractions
import re

import numpy as np
import pandas
import pytest
import scipy.sparse as sparse
from scipy.spatial.distance import pdist, squareform

import libph as ph

RNG = np.random.default_rng(1)
POINTS = RNG.integers(-50, 50, size=(30, 3)).astype(float)
DISTANCES = squareform(pdist(POINTS))
IMAGE = RNG.integers(0, 200, size=(9, 8, 7))


class HasArray:
    """What other libraries' arrays look like."""

    def __init__(self, array):
        self.array = array

    def __array__(self, dtype=None, copy=None):
        return np.asarray(self.array, dtype)


class HasDlpack:
    def __init__(self, array):
        self.array = array

    def __dlpack__(self, **options):
        return self.array.__dlpack__(**options)

    def __dlpack_device__(self):
        return self.array.__dlpack_device__()


class Tensor(HasArray):
    """As torch's: with a gradient it gives no array before it is detached."""

    def __init__(self, array, gradient):
        super().__init__(array)
        self.gradient = gradient

    def __array__(self, dtype=None, copy=None):
        if self.gradient:
            raise RuntimeError("Can't call numpy() on Tensor that requires grad.")
        return super().__array__(dtype)

    def detach(self):
        return Tensor(self.array, False)


def unaligned(array):
    """The same numbers one byte off."""
    room = np.empty(array.nbytes + 1, dtype=np.uint8)
    moved = room[1:].view(array.dtype).reshape(array.shape)
    moved[...] = array
    return moved


def padded(array):
    """A field of records: steps that are no whole numbers of items."""
    records = np.zeros(array.shape, dtype=[("x", array.dtype), ("flag", "u1")])
    records["x"] = array
    return records["x"]


def with_gaps(array):
    spread = np.zeros([3 * n for n in array.shape], array.dtype)
    spread[(slice(None, None, 3),) * array.ndim] = array
    return spread[(slice(None, None, 3),) * array.ndim]


def read_only(array):
    copy = array.copy()
    copy.flags.writeable = False
    return copy


def mapped(array, folder, mode):
    path = folder / f"{mode}.npy"
    np.save(path, array)
    return np.load(path, mmap_mode=mode)


def swapped(array):
    return array.astype(array.dtype.newbyteorder())


LAYOUTS = {
    "C order": np.ascontiguousarray, "F order": np.asfortranarray, "backwards":
    lambda a: a[::-1].copy()[::-1], "backwards along all axes":
    lambda a: np.flip(np.flip(a).copy()), "with gaps": with_gaps, "read-only": read_only,
    "unaligned": unaligned, "a field of records": padded, "another byte order": swapped,
    "has __array__": HasArray, "has DLPack": HasDlpack, "a tensor": lambda a: Tensor(a, False),
    "a tensor with a gradient": lambda a: Tensor(a, True), "a memoryview": memoryview,
    "nested lists": lambda a: a.tolist(), "objects": lambda a: a.astype(object),
    "a subclass": lambda a: a.view(type("Own", (np.ndarray,), {})),
    "a masked array without a mask": np.ma.asarray,
}
TYPES = ["float64", "float32", "float16", "longdouble", "int8", "int16", "int32", "int64", "uint8",
         "uint16", "uint32", "uint64", "bool", ">f8", ">f4", ">i2", ">u4", "<i8"]


def copied(data):
    return np.array(data.array if hasattr(data, "array") else data)


def of_type(array, name):
    """Numbers that the type can hold, and the same in float64."""
    kept = array % 2 if name == "bool" else np.abs(array) % 100
    return kept.astype(name), kept.astype(float)


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("name, data, compute", [
    ("points", POINTS, ph.rips),
    ("a matrix", DISTANCES, lambda d: ph.rips(d, metric="precomputed")),
    ("an image", IMAGE.astype(float), ph.cubical),
    ("a small image", IMAGE.astype(np.uint8), ph.cubical),
    ("values", POINTS[:, 0].copy(), lambda v: ph.lower_star(v, [[0, 1], [1, 2]])),
    ("condensed distances", squareform(DISTANCES), lambda d: ph.rips(d, metric="precomputed")),
], ids=lambda x: x if isinstance(x, str) else "")
def test_layouts(layout, name, data, compute):
    given = LAYOUTS[layout](data)
    before = copied(given)
    bars = compute(given)
    assert bars == compute(np.array(data, order="C"))
    assert np.array_equal(copied(given), before)


@pytest.mark.parametrize("name", TYPES)
@pytest.mark.parametrize("compute", [
    ph.rips, lambda x: ph.rips(x @ x.T * 0 + np.abs(np.subtract.outer(x[:, 0], x[:, 0])),
                               metric="precomputed"), ph.cubical, ph.merge_tree,
    lambda x: ph.farthest_points(x), lambda x: ph.distance_to_measure(x, 3)],
    ids=["rips", "matrix", "cubical", "merge_tree", "farthest_points", "distance_to_measure"])
def test_types(name, compute):
    given, plain = of_type(POINTS, name)
    if compute not in (ph.rips, ph.cubical, ph.merge_tree) and given.dtype.kind in "bu":
        given = plain  # NumPy itself wraps around
    before = given.copy()
    result, expected = compute(given), compute(plain)
    assert np.array_equal(given, before)
    if isinstance(result, ph.Barcode):
        assert result == expected
    elif isinstance(result, ph.MergeTree):
        assert np.array_equal(result.linkage, expected.linkage)
    else:
        for mine, its in zip(result, expected):
            assert np.array_equal(mine, its)


@pytest.mark.parametrize("mode", ["r", "r+", "c"])
def test_memory_maps(tmp_path, mode):
    for array, compute in ((POINTS, ph.rips), (IMAGE.astype(np.uint8), ph.cubical),
                           (IMAGE.astype(np.float32), lambda x: ph.cubical(x[1:5])),
                           (IMAGE.astype(np.float32), lambda x: ph.cubical(x + 1)),
                           (DISTANCES, lambda d: ph.rips(d, metric="precomputed"))):
        given = mapped(array, tmp_path, mode)
        assert compute(given) == compute(array)
        assert np.array_equal(given, array)


def test_a_memory_map_that_was_written_to(tmp_path):
    """Pages of it are no pages of the file: they must not be dropped."""
    image = mapped(np.zeros((64, 64, 64), dtype=np.uint8), tmp_path, "c")
    image[...] = np.random.default_rng(0).integers(0, 255, size=image.shape)
    expected = image.copy()
    assert ph.cubical(image) == ph.cubical(expected)
    assert np.array_equal(image, expected)


def test_tables():
    frame = pandas.DataFrame(POINTS.copy(), columns=list("xyz"))
    assert ph.rips(frame) == ph.rips(POINTS)
    assert ph.rips(frame.astype({"x": int, "y": "float32"})) == ph.rips(POINTS)
    assert ph.rips(frame[["x"]].assign(z=True)) == ph.rips(
        np.column_stack([POINTS[:, 0], np.ones(30)]))
    assert ph.lower_star(frame["x"], [[0, 1]]) == ph.lower_star(POINTS[:, 0], [[0, 1]])
    frame.loc[3, "y"] = np.nan
    assert ph.rips(frame, nan="drop") == ph.rips(np.delete(POINTS, 3, axis=0))
    nullable = frame.astype({"x": "Int64"}).convert_dtypes()
    assert ph.rips(nullable, nan="drop") == ph.rips(np.delete(POINTS, 3, axis=0))


def test_numbers_of_python():
    exact = [[fractions.Fraction(1, 4), decimal.Decimal("0.5")], [1, 2.5], [np.float32(3), True]]
    assert ph.rips(exact) == ph.rips([[0.25, 0.5], [1, 2.5], [3, 1]])


def test_masked_arrays():
    points = np.ma.masked_equal(POINTS, POINTS[4, 1])
    rows = ~np.ma.getmaskarray(points).any(axis=1)
    with pytest.raises(ph.DataError):
        ph.rips(points)
    assert ph.rips(points, nan="drop") == ph.rips(POINTS[rows])
    image = np.ma.masked_greater(IMAGE.astype(np.uint8), 150)
    absent = np.where(image.mask, np.nan, image.data.astype(float))
    with pytest.raises(ph.DataError):
        ph.cubical(image)
    assert ph.cubical(image, nan="drop") == ph.cubical(absent, nan="drop")


def test_points_left_out_keep_their_names():
    points = np.vstack([[np.nan, 0], POINTS[:6, :2], [0, np.nan]])
    bars = ph.rips(points, nan="drop", representatives="cycles", cells=True)
    plain = ph.rips(POINTS[:6, :2], representatives="cycles")
    assert bars == plain
    for dim in (0, 1):
        assert np.array_equal(bars.birth_cells(dim), plain.birth_cells(dim) + 1)
    for i in range(len(bars)):
        assert np.array_equal(bars.representative(i).cells, plain.representative(i).cells + 1)
    weights = np.arange(8) / 8
    assert ph.rips(points, nan="drop", weights=weights) == \
        ph.rips(POINTS[:6, :2], weights=weights[1:7])


def test_few_or_no_points():
    for empty in ([], np.empty((0, 3)), np.empty((0, 0))):
        assert list(ph.rips(empty)) == []
    assert list(ph.rips(np.empty((0, 0)), metric="precomputed")) == []
    assert list(ph.rips([[1.0, 2.0]])) == [ph.Bar(0, 0.0, np.inf)]
    assert len(ph.rips(np.empty(0), metric="precomputed")) == 1  # no pair: one point
    assert len(ph.rips(np.empty((3, 0)))) == 1  # three equal points of R^0
    assert list(ph.rips([], metric=lambda a, b: 1.0)) == []


def test_functions_as_metrics():
    calls = collections.Counter()

    def manhattan(a, b):
        calls[tuple(a), tuple(b)] += 1
        return np.abs(a - b).sum()

    points = np.unique(POINTS, axis=0)
    assert ph.rips(points, metric=manhattan) == ph.rips(points, metric="manhattan")
    assert set(calls.values()) == {1} and len(calls) == len(points) * (len(points) - 1) // 2
    words = ["cat", "cut", "but", "bat"]
    bars = ph.rips(words, metric=lambda a, b: sum(x != y for x, y in zip(a, b)))
    assert list(bars) == [ph.Bar(0, 0.0, 1.0)] * 3 + [ph.Bar(0, 0.0, np.inf), ph.Bar(1, 1.0, 2.0)]

    def fails(a, b):
        raise ArithmeticError("mine")

    with pytest.raises(ArithmeticError, match="mine"):
        ph.rips(POINTS, metric=fails)


def test_sparse_matrices_are_not_written_to():
    upper = sparse.coo_matrix(np.triu(DISTANCES, 1))
    for make in (upper.tocoo, upper.tocsr, upper.tocsc, upper.todok, upper.tolil):
        given = make()
        before = given.copy()
        ph.rips(given, metric="precomputed")
        assert (given != before).nnz == 0
    edges = sparse.csc_matrix(([1, -1, 0], ([0, 1, 0], [2, 2, 1])), shape=(3, 3))
    stored = edges.data.copy()
    ph.boundary(edges, [0, 0, 1])
    assert np.array_equal(edges.data, stored)


def test_zeros_that_are_stored_are_distances():
    matrix = sparse.coo_matrix(([0.0, 2.0], ([0, 1], [1, 2])), shape=(4, 4))
    assert list(ph.rips(matrix, metric="precomputed", min_persistence=-1)) == [
        ph.Bar(0, 0, 0), ph.Bar(0, 0, 2), ph.Bar(0, 0, np.inf), ph.Bar(0, 0, np.inf)]


def test_entries_that_are_stored_twice():
    twice = sparse.coo_matrix(([1.0, 1.0, 2.0], ([0, 0, 1], [1, 1, 2])), shape=(3, 3))
    once = sparse.coo_matrix(([1.0, 2.0], ([0, 1], [1, 2])), shape=(3, 3))
    assert ph.rips(twice, metric="precomputed") == ph.rips(once, metric="precomputed")
    differ = sparse.coo_matrix(([1.0, 3.0], ([0, 1], [1, 0])), shape=(2, 2))
    for which, value in (("max", 3), ("min", 1), ("lower", 3)):
        bars = ph.rips(differ, metric="precomputed", symmetrise=which)
        assert bars.dgm(0)[0, 1] == value


def test_rounding_is_accepted():
    matrix = DISTANCES * (1 + 1e-9 * np.tri(30))
    matrix[0, 0] = 1e-9
    matrix[5, 6] = matrix[6, 5] = -1e-9
    clean = DISTANCES.copy()
    clean[5, 6] = clean[6, 5] = 0
    assert np.allclose(ph.rips(matrix, metric="precomputed").deaths,
                       ph.rips(clean, metric="precomputed").deaths)


# ---- what is refused

NAN, INF = np.nan, np.inf
BIG = 2**53 + 1
pre = {"metric": "precomputed"}


def matrix(*entries, n=4):
    """A matrix of ones with some other entries."""
    made = np.ones((n, n)) - np.eye(n)
    for i, j, value in entries:
        made[i, j] = value
    return made


def pairs(*entries, n=4):
    i, j, values = zip(*entries)
    return sparse.coo_matrix((values, (i, j)), shape=(n, n))


def point(i, k, value, dtype=None):
    """Points of which one coordinate is something."""
    made = np.zeros((5, 3)) if dtype is None else np.zeros((5, 3), dtype)
    made[i, k] = value
    return made


class Broken:
    def __array__(self, dtype=None, copy=None):
        raise OSError("device lost")


class Cuda:
    def __array__(self, dtype=None, copy=None):
        raise TypeError("can't convert cuda:0 device type tensor to numpy")


# (name, function, arguments, keywords, words of the message)
BAD = [
    # no arrays
    *[(f"{type(data).__name__} {data!r:.20}", ph.rips, (data,), {}, "found")
      for data in (None, "abc", b"abc", {}, {1: 2}, {1, 2}, 3, 2.5, object(), len, ph, Broken(),
                   Cuda(), [None], [[None, 1]], ["a", "b"], [["a"]], [[1], ["b"]], [[{}]],
                   range(3), iter([1, 2]), (x for x in [[1]]), Ellipsis, NotImplemented, 1j,
                   True, np.float64(1), np.array(3.0), slice(3), Exception("x"))],
    *[(f"image {data!r:.20}", ph.cubical, (data,), {}, "image: found")
      for data in (None, "abc", 3, object(), np.array(1.0), np.zeros((1,) * 9), {}, Broken())],
    # ragged
    ("rows of two lengths", ph.rips, ([[1, 2], [3]],), {}, "row 1: found 1 numbers, expected 2"),
    ("a number among rows", ph.rips, ([[1, 2], 3],), {}, "row 1: found one number, expected 2"),
    ("rows of three lengths", ph.rips, ([[1], [2], [3, 4, 5]],), {}, "row 2: found 3 numbers"),
    ("a ragged image", ph.cubical, ([[1, 2], [3]],), {}, "row 1"),
    ("ragged objects", ph.rips, (np.array([[1, 2], [3]], dtype=object),), {}, "found"),
    # shapes
    ("numbers for points", ph.rips, ([1.0, 2.0],), {}, "reshape(-1, 1)"),
    ("three axes for points", ph.rips, (np.zeros((2, 2, 2)),), {}, "ph.cubical takes images"),
    ("no square", ph.rips, (np.zeros((3, 4)),), pre, "(3, 4), expected distances: a square"),
    ("three axes of distances", ph.rips, (np.zeros((2, 2, 2)),), pre, "(2, 2, 2)"),
    ("two condensed numbers", ph.rips, ([1.0, 2.0],), pre, "found 2 numbers, expected n(n-1)/2"),
    ("a sparse one that is no square", ph.rips, (sparse.coo_matrix((3, 4)),), pre, "(3, 4)"),
    ("sparse points", ph.rips, (sparse.eye(3),), {}, ".toarray() makes points of it"),
    ("a sparse image", ph.cubical, (sparse.eye(3),), {}, ".toarray()"),
    ("an image without voxels", ph.cubical, (np.zeros((3, 0)),), {}, "0"),
    ("a signal without values", ph.cubical, (np.zeros(0),), {}, "0"),
    ("one number as a diagram", ph.bottleneck, ([1.0], [[0, 1]]), {}, "rows birth, death"),
    ("three columns of a diagram", ph.bottleneck, (np.zeros((2, 3)), [[0, 1]]), {}, "(2, 3)"),
    # types
    *[(f"points of {kind}", ph.rips, (np.zeros((3, 2), kind),), {}, words)
      for kind, words in (("complex128", "complex"), ("complex64", "complex"), ("U3", "text"),
                          ("S3", "bytes"), ("M8[s]", "dates"), ("m8[s]", "times"),
                          ([("x", "f8"), ("y", "f8")], "records"), ("V8", "records"))],
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
    # whole numbers that are no doubles
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
    ("correlations", ph.rips, (np.eye(3),), pre, "row 0, column 0: found 1"),
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
    # other data
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
