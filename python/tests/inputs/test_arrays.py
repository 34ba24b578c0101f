# SPDX-License-Identifier: MIT
"""Tests that arrays of all kinds are read correctly and are never modified."""
import collections
import contextlib
import decimal
import fractions

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
    """Offers its array through `__array__`, like the arrays of other libraries."""

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
    """Behaves like torch's tensors: a tensor with a gradient can be read as an array only after
    `detach`."""

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
    """A copy of the array whose address is one byte off alignment."""
    room = np.empty(array.nbytes + 1, dtype=np.uint8)
    moved = room[1:].view(array.dtype).reshape(array.shape)
    moved[...] = array
    return moved


def padded(array):
    """The array as a field of records: its strides are not multiples of the item size."""
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
    """The array's values, mapped to numbers that the type can hold: once in this type, and once as
    float64."""
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
        given = plain  # NumPy's differences of these types wrap around
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
    """Modified pages of a memory map differ from the file. They must not be dropped."""
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
    assert len(ph.rips(np.empty(0), metric="precomputed")) == 1  # no distances: one point
    assert len(ph.rips(np.empty((3, 0)))) == 1  # three equal points of R⁰
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


def off_diagonal_ones(format):
    """Ones in the blocks (0, 1) and (1, 0) of a matrix with two blocks per axis."""
    ones = np.ones((2, 2))
    return sparse.bmat([[None, ones], [ones, None]], format="coo").asformat(format)


@pytest.mark.parametrize("format", ["coo", "csr", "csc", "dok", "lil", "bsr", "dia"])
def test_every_format_of_sparse_matrices(format):
    full = sparse.coo_matrix(DISTANCES + 1 - np.eye(30))
    few = sparse.coo_matrix(np.triu(np.where(DISTANCES < 40, DISTANCES + 1, 0), 1))
    few.data[:3] = 0
    for matrix in (full, few):
        expected = ph.rips(matrix, metric="precomputed", max_dim=2, min_persistence=-1)
        if matrix is few and format in ("bsr", "dia"):
            with pytest.raises(ph.DataError, match=f"found 0 in a matrix of format {format}"):
                ph.rips(matrix.asformat(format), metric="precomputed")
        else:
            assert ph.rips(matrix.asformat(format), metric="precomputed", max_dim=2,
                           min_persistence=-1) == expected
    with pytest.raises(ph.DataError) if format == "dia" else contextlib.nullcontext():
        assert ph.rips(off_diagonal_ones(format), metric="precomputed") == \
            ph.rips(off_diagonal_ones("csr"), metric="precomputed")


def test_what_messages_say_about_zeros_that_fill_blocks_and_diagonals():
    """The advice in the messages gives the bars of the same matrix in CSR format."""
    few = sparse.csr_matrix(([1.0, 2.0, 3.0], ([0, 0, 2], [1, 3, 3])), shape=(4, 4))
    expected = ph.rips(few, metric="precomputed")
    for format in ("bsr", "dia"):
        given = few.tobsr((2, 2)) if format == "bsr" else few.todia()
        with pytest.raises(ph.DataError, match=r"X: row \d, column \d: found 0 .*\.tocsr\(\)"):
            ph.rips(given, metric="precomputed")
        csr = given.tocsr()
        csr.eliminate_zeros()
        assert ph.rips(csr, metric="precomputed") == expected
    for place, outside in ((5, 1), (-5, 1)):  # a diagonal outside the matrix has no entries
        matrix = sparse.dia_matrix((np.array([[0.0] * 4, [1.0] * 4]), [place, outside]), shape=(4, 4))
        assert ph.rips(matrix, metric="precomputed").deaths.tolist() == [1, 1, 1, np.inf]


def test_entries_that_are_stored_twice():
    twice = sparse.coo_matrix(([1.0, 1.0, 2.0], ([0, 0, 1], [1, 1, 2])), shape=(3, 3))
    once = sparse.coo_matrix(([1.0, 2.0], ([0, 1], [1, 2])), shape=(3, 3))
    assert ph.rips(twice, metric="precomputed") == ph.rips(once, metric="precomputed")
    differ = sparse.coo_matrix(([1.0, 3.0], ([0, 1], [1, 0])), shape=(2, 2))
    for which, value in (("max", 3), ("min", 1), ("lower", 3)):
        bars = ph.rips(differ, metric="precomputed", symmetrise=which)
        assert bars.dgm(0)[0, 1] == value


def test_a_diagonal_that_is_stored_twice():
    def births(*diagonal, **keywords):
        matrix = sparse.coo_matrix(([*diagonal, 1.0], ([0] * len(diagonal) + [0],
                                                       [0] * len(diagonal) + [1])), shape=(2, 2))
        return ph.rips(matrix, metric="precomputed", diagonal="births", **keywords).dgm(0)[:, 0]

    assert births(0.5, 0.5).tolist() == births(0.5).tolist() == [0, 0.5]
    for pair in ((0.5, 0.7), (0.7, 0.5)):
        with pytest.raises(ph.DataError, match="row 0, column 0: found 0.5 and 0.7, expected equal values"):
            births(*pair)
        for which, value in (("max", 0.7), ("min", 0.5), ("lower", pair[1])):
            assert births(*pair, symmetrise=which).tolist() == [0, value]


def test_rounding_is_accepted():
    matrix = DISTANCES * (1 + 1e-9 * np.tri(30))
    matrix[0, 0] = 1e-9
    matrix[5, 6] = matrix[6, 5] = -1e-9
    clean = DISTANCES.copy()
    clean[5, 6] = clean[6, 5] = 0
    assert np.allclose(ph.rips(matrix, metric="precomputed").deaths,
                       ph.rips(clean, metric="precomputed").deaths)


def test_delay_embedding():
    rng = np.random.default_rng(3)
    for quantities in (None, 1, 3):
        series = rng.random(23 if quantities is None else (23, quantities))
        rows = series.reshape(23, -1)
        for dimension, delay in ((1, 1), (2, 5), (4, 1), (3, 11), (23, 1)):
            expected = [np.concatenate([rows[i + k * delay] for k in range(dimension)])
                        for i in range(23 - (dimension - 1) * delay)]
            assert np.array_equal(ph.delay_embedding(series, dimension, delay), expected)
            span = (dimension - 1) * delay + 1
            for window in range(span, 24, 5):
                clouds = ph.delay_embedding(series, dimension, delay, window=window, step=4)
                assert np.array_equal(clouds, [expected[b:b + window - span + 1]
                                               for b in range(0, 23 - window + 1, 4)])
                assert ph.batch(ph.rips, clouds) == [ph.rips(np.array(c)) for c in clouds]


@pytest.mark.parametrize("series, arguments, options, error, words", [
    (np.zeros(5), (0,), {}, ph.UsageError, "dimension: found 0"),
    (np.zeros(5), (2, 0), {}, ph.UsageError, "delay: found 0"),
    (np.zeros(5), (3, 2.5), {}, ph.UsageError, "delay: found 2.5"),
    (np.zeros(5), (4, 2), {}, ph.DataError, "series: found 5 times, expected at least 7"),
    (np.zeros((2, 2, 2)), (1,), {}, ph.UsageError, "series: found an array of shape"),
    (["a"], (1,), {}, ph.Error, "series"),
    (np.zeros(5), (2,), {"step": 2}, ph.UsageError, "step: does nothing without window"),
    (np.zeros(5), (3,), {"window": 2}, ph.UsageError, "window: found 2"),
    (np.zeros(5), (3,), {"window": 6}, ph.UsageError, "window: found 6"),
    (np.zeros(5), (3,), {"window": 5, "step": 0}, ph.UsageError, "step: found 0"),
])
def test_delay_embedding_refuses(series, arguments, options, error, words):
    with pytest.raises(error, match=words):
        ph.delay_embedding(series, *arguments, **options)


def test_delay_embedding_needs_room_for_what_it_copies(monkeypatch):
    monkeypatch.setattr(ph._core, "memory_left", lambda: 2**24)
    series = np.zeros((400_000, 2))
    for arguments, given in (((3, 2), series), ((3, 1), np.asfortranarray(series))):
        with pytest.raises(ph.MemoryLimitError, match="a result of shape .* exceed the available memory"):
            ph.delay_embedding(given, *arguments)
    assert np.shares_memory(ph.delay_embedding(series, 3), series)  # a view, not a copy
    assert ph.delay_embedding(np.empty((6, 0)), 2).shape == (5, 0)
