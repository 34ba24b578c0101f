# SPDX-License-Identifier: MIT
"""Memory: inputs are not copied, and a thousand calls leak nothing."""
import gc
import subprocess
import sys
import textwrap
import tracemalloc

import numpy as np
import pytest

import libph as ph
from libph import _core
from libph._sources import source_of

MIB = 1 << 20


def peak_above_the_data(code):
    """MiB by which the peak resident memory of a separate process exceeds its memory before the
    call."""
    script = textwrap.dedent("""
        import numpy as np, libph as ph

        def status(name):
            with open("/proc/self/status") as lines:
                return int(next(line for line in lines if line.startswith(name)).split()[1]) * 1024

        def measured(compute):
            compute(warm_up=True)
            with open("/proc/self/clear_refs", "w") as file:
                file.write("5")  # the peak is what there is now
            before = status("VmRSS")
            compute(warm_up=False)
            print((status("VmHWM") - before) / 2**20)

    """) + textwrap.dedent(code)
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return float(done.stdout)


@pytest.mark.parametrize("dtype, layout", [
    ("f8", "condensed"), ("f4", "condensed"), ("f8", "square"), ("f4", "square"),
    ("f8", "F order"), ("f8", "backwards")])
def test_ten_million_distances_are_not_copied(dtype, layout):
    """As condensed float64 numbers, the distances take 76 MiB."""
    taken = peak_above_the_data(f"""
        n = 4473
        if "{layout}" == "condensed":
            distances = np.random.default_rng(0).random(n * (n - 1) // 2).astype("{dtype}") + 1
            distances[:50] = 0.5
        else:
            distances = np.ones((n, n), "{dtype}")
            np.fill_diagonal(distances, 0)
            distances[:50, :50] = distances[:50, :50] / 2
            if "{layout}" == "F order":
                distances = np.asfortranarray(distances)
            if "{layout}" == "backwards":
                distances = distances[::-1, ::-1]
        def compute(warm_up):
            few = distances[:10] if distances.ndim == 1 else distances[:5, :5]
            ph.rips(few if warm_up else distances, metric="precomputed", threshold=0.6)
        measured(compute)
    """)
    assert taken < 24, f"{taken} MiB"


@pytest.mark.parametrize("layout", ["points", "points[::-1]", "points[:, ::1]"])
def test_points_are_not_copied(layout):
    """The points take 73 MiB; the memory for H0 depends only on their number."""
    taken = peak_above_the_data(f"""
        points = np.random.default_rng(0).random((1500, 6400))
        def compute(warm_up):
            ph.rips(points[:10] if warm_up else {layout}, max_dim=0)
        measured(compute)
    """)
    assert taken < 8, f"{taken} MiB"


def test_an_image_is_not_copied():
    """The image is 128 MiB of bytes, which are processed four layers at a time."""
    taken = peak_above_the_data("""
        image = np.zeros((512, 512, 512), np.uint8)
        image[::2] = 1
        def compute(warm_up):
            ph.cubical(image[:2, :2, :2] if warm_up else image, max_dim=0, cells=False,
                       slab_layers=4)
        measured(compute)
    """)
    assert taken < 64, f"{taken} MiB"


@pytest.mark.parametrize("how", ["", ", range=(0, 255), resolution=256"])
@pytest.mark.parametrize("layout", ["image", "image[::-1, ::-1, ::-1]"])
def test_an_euler_curve_does_not_copy_the_image(layout, how):
    """The image is 128 MiB of bytes. Only an array that runs backwards is copied first."""
    taken = peak_above_the_data(f"""
        image = np.zeros((512, 512, 512), np.uint8)
        image[::2] = 1
        def compute(warm_up):
            ph.euler_curve((image[:2, :2, :2] if warm_up else {layout}){how})
        measured(compute)
    """)
    assert taken < (32 if layout == "image" else 160), f"{taken} MiB"


MANY = [np.array([[0.0, 1.0 + k]]) for k in range(1500)]


@pytest.mark.parametrize("compute", [
    lambda limit: ph.diagram_distances(MANY, distance="bottleneck", memory_limit=limit),
    lambda limit: ph.diagram_distances(MANY, MANY, distance="bottleneck", memory_limit=limit),
    lambda limit: ph.diagram_kernels(MANY, memory_limit=limit),
    lambda limit: ph.confidence_band(np.eye(2), repetitions=10**7, memory_limit=limit)])
def test_what_grows_with_an_option_is_counted(compute):
    with pytest.raises(ph.MemoryLimitError, match="memory limit of 10 MiB would be exceeded"):
        compute("10MiB")


def test_the_conversion_of_a_sparse_matrix_is_counted():
    """An entry takes at most 88 bytes, whatever the format and the types."""
    sparse = pytest.importorskip("scipy.sparse")
    matrix = sparse.random(4000, 4000, 0.02, format="coo", random_state=0)
    matrix = matrix.maximum(matrix.T).tocoo()
    matrix.setdiag(0)
    wide = matrix.copy()
    wide.row, wide.col = wide.row.astype(np.int64), wide.col.astype(np.int64)
    for given in (matrix, wide, matrix.astype(np.float32), matrix.tocsr(), matrix.tolil()):
        tracemalloc.start()
        source = source_of(given, metric="precomputed")
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert 40 * given.nnz < peak < 88 * given.nnz
        assert source.points == 4000
    for limit, refused in ((87 * matrix.nnz, True), (88 * matrix.nnz, False)):
        with pytest.raises(ph.MemoryLimitError) as caught:
            ph.rips(matrix, metric="precomputed", max_dim=3, memory_limit=limit)
        assert (f"the {matrix.nnz} entries of X may" in str(caught.value)) == refused
        with ph.limits(memory=limit), pytest.raises(ph.MemoryLimitError):
            ph.rips(matrix, metric="precomputed", max_dim=3)


def test_a_refused_conversion_names_sizes_and_a_way_out():
    with pytest.raises(ph.MemoryLimitError, match="^memory limit of 1000 bytes would be exceeded: the "
                       "conversion of the 100 simplices may take 8.594 KiB; pass less data or a "
                       "larger memory_limit$"):
        ph.filtered([(k, k + 1) for k in range(100)], np.zeros(100), memory_limit=1000)


def test_a_copy_of_the_input_is_counted():
    image = np.zeros((1700, 1700), np.int64)  # its copy takes 22 MiB
    expected = ph.cubical(image, cells=False, slab_layers=4)
    assert ph.cubical(image, cells=False, slab_layers=4, memory_limit="40MiB") == expected
    assert ph.cubical(image * 1.0, cells=False, slab_layers=4, memory_limit="20MiB") == expected
    words = "^memory limit of 20 MiB would be exceeded: a copy of image in float64 takes 22.05 MiB; "
    for function in (ph.cubical, lambda x, **o: ph.estimate(x, complex="cubical", **o),
                     lambda x, **o: ph.batch(ph.cubical, [x], **o)):
        with pytest.raises(ph.MemoryLimitError, match="a copy of image"):
            function(image, memory_limit="20MiB")
    with ph.limits(memory="20MiB"), pytest.raises(ph.MemoryLimitError, match=words):
        ph.cubical(image)
    with pytest.raises(ph.MemoryLimitError, match="memory limit of 23 MiB .*: 2[23].* MiB in use"):
        ph.cubical(np.arange(image.size).reshape(image.shape) * 7919 % 4096, memory_limit="23MiB")


def test_a_result_must_fit_into_the_limit():
    bars = ph.rips([[0.0], [1.0], [3.0]])
    with ph.limits(memory="20MiB"):
        assert bars.image(0, bandwidth=1, infinity=4).shape == (20, 20)
        with pytest.raises(ph.MemoryLimitError, match=r"20 MiB .* a result of shape \(2000, 2000\)"):
            bars.image(0, bandwidth=1, infinity=4, resolution=2000)
        with pytest.raises(ph.MemoryLimitError, match="memory limit of 20 MiB would be exceeded"):
            bars_of_one = np.random.default_rng(0).random((60_000, 2)).cumsum(axis=1)
            ph.Barcode.from_dgms([bars_of_one]).exact_landscape(0, 300)
        many = ph.Barcode.from_dgms([np.tile(bars_of_one, (4, 1))])
        for curve in (lambda: many.betti_function(0), many.euler_curve):
            with pytest.raises(ph.MemoryLimitError, match="conversion of the 240000 bars may take"):
                curve()
    assert bars.image(0, bandwidth=1, infinity=4, resolution=2000).shape == (2000, 2000)


def test_shuffles_take_no_memory():
    distances = np.ones((4, 4)) - np.eye(4)
    test = ph.permutation_test(distances, [0, 0, 1, 1], shuffles=10**5, memory_limit="64KiB")
    assert test.p == 1
    with pytest.raises(ph.Timeout):
        ph.permutation_test(distances, [0, 0, 1, 1], shuffles=2**40, timeout=0.1)


def resident():
    with open("/proc/self/status") as lines:
        return int(next(line for line in lines if line.startswith("RssAnon")).split()[1]) * 1024


POINTS = np.random.default_rng(0).normal(size=(60, 3))
IMAGE = np.random.default_rng(0).integers(0, 99, size=(12, 12, 12))
BARS = ph.rips(POINTS)


@pytest.mark.parametrize("compute", [
    lambda: ph.rips(POINTS, max_dim=2), lambda: ph.rips(POINTS, timeout=60),
    lambda: ph.rips(POINTS, representatives="cycles").representative(-1).loops(),
    lambda: ph.rips(np.abs(np.subtract.outer(POINTS[:, 0], POINTS[:, 0])), metric="precomputed"),
    lambda: ph.cubical(IMAGE, representatives="voxels").voxels(0),
    lambda: ph.merge_tree(POINTS).linkage, lambda: ph.farthest_points(POINTS),
    lambda: ph.rips(POINTS)._repr_html_(), lambda: ph.rips(POINTS).__reduce__(),
    lambda: ph.rips(POINTS).filter(dim=1).dgms(), lambda: refused(lambda: ph.rips([[np.nan]])),
    lambda: refused(lambda: ph.rips(POINTS, max_dim=2, memory_limit=1)),
    lambda: ph.rips(POINTS, progress=lambda *news: None),
    lambda: ph.bottleneck(ph.rips(POINTS), ph.rips(POINTS + 0.1)),
    lambda: ph.euler_curve(IMAGE)(5), lambda: ph.euler_curve(IMAGE, range=(0, 99), timeout=60),
    lambda: refused(lambda: ph.euler_curve([np.nan])), lambda: BARS.exact_landscape(1),
    lambda: (BARS.statistics(1), BARS.silhouette(1), BARS.image(1), BARS.landscape(1, layers=3)),
    lambda: (BARS.betti_function(0), BARS.life_entropy(1), BARS.entropy(1), BARS.euler_curve()),
    lambda: ph.diagram_kernels([BARS, BARS], dim=1, threads=2),
    lambda: ph.point_image(POINTS, 0.5), lambda: ph.lower_star(POINTS[:, 0], [[0, 1], [1, 2]])])
def test_a_thousand_calls_leak_nothing(compute):
    for _ in range(100):
        compute()
    gc.collect()
    memory, objects = [], []
    for _ in range(3):
        memory.append(resident())
        objects.append(len(gc.get_objects()))
        for _ in range(1000):
            compute()
        gc.collect()
    memory.append(resident())
    objects.append(len(gc.get_objects()))
    # A leak grows in every round. The heap may take back once what an earlier test had returned.
    assert min(np.diff(memory)) < 1 * MIB
    assert min(np.diff(objects)) < 100


def refused(compute):
    with pytest.raises(ph.Error):
        compute()


def test_arrays_outlive_what_they_came_from():
    bars = ph.rips(POINTS, representatives="cycles")
    cells, chain = bars.birth_cells(0), bars.representative(0)
    expected = cells.copy(), chain.cells.copy()
    del bars
    gc.collect()
    [ph.rips(POINTS) for _ in range(20)]
    assert np.array_equal(cells, expected[0]) and np.array_equal(chain.cells, expected[1])
    block = np.asarray(_core.point_image(POINTS, 0.5, "distance", 1,
                                         _core.RunOptions(0, None, None, None, None, 0))[0])
    total = block.sum()
    gc.collect()
    assert block.sum() == total


def test_data_live_as_long_as_they_are_needed():
    """Nothing else holds a reference to the array or to the array that it is a view of."""
    for _ in range(50):
        assert len(ph.rips(np.array(POINTS)).dgm(0)) == 60
        assert len(ph.rips(np.array(POINTS)[::2], timeout=10).dgm(0)) == 30
        assert ph.cubical(np.array(IMAGE, dtype=np.uint8), timeout=10).births[0] == IMAGE.min()
