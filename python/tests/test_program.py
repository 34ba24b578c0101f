# SPDX-License-Identifier: MIT
"""Tests that the package and ph-barcode compute the same bars, cells, chains and loops on random
inputs of all kinds."""
import json
import subprocess

import numpy as np
import pytest
import scipy.sparse as sparse
from scipy.spatial.distance import pdist, squareform

import libph as ph


class Program:
    def __init__(self, path, folder):
        self.path, self.folder = path, folder

    def file(self, name, content):
        path = self.folder / name
        if isinstance(content, np.ndarray):
            np.save(path, content)
        else:
            path.write_text(content)
        return path

    def __call__(self, path, *arguments):
        run = subprocess.run([self.path, path, "--output-format", "json", "--quiet", *arguments],
                             capture_output=True, text=True)
        assert run.returncode == 0, run.stderr
        return json.loads(run.stdout)


@pytest.fixture
def ph_barcode(program, tmp_path):
    return Program(program, tmp_path)


def numbers(cell):
    (found,) = cell.values()
    return found if isinstance(found, list) else [found]


def check(bars, expected):
    """Compares bars with everything that the program writes about them."""
    assert [(b["dim"], b["birth"], np.inf if b["death"] is None else b["death"])
            for b in expected["bars"]] == list(bars)
    births = [row for d in range(bars._top_dim + 1) for row in bars.birth_cells(d).tolist()]
    deaths = [row for d in range(bars._top_dim + 1) for row in bars.death_cells(d).tolist()]
    for i, bar in enumerate(expected["bars"]):
        assert births[i] == numbers(bar["birth_cell"])
        if bar["death"] is not None:
            assert deaths[i] == numbers(bar["death_cell"])
        else:
            assert set(deaths[i]) == {-1}
        if "representative" in bar:
            chain = bars.representative(i)
            assert [numbers(term) for term in
                    ({k: v for k, v in t.items() if k != "coefficient"}
                     for t in bar["representative"])] == chain.cells.tolist()
            assert [t["coefficient"] for t in bar["representative"]] == chain.coefficients.tolist()
        if "loops" in bar:
            loops = bars.representative(i).loops()
            assert [loop["coefficient"] for loop in bar["loops"]] == [x.coefficient for x in loops]
            for loop, found in zip(bar["loops"], loops):
                (vertices,) = (v for k, v in loop.items() if k in ("vertices", "grid"))
                assert np.array_equal(vertices, found.vertices)
                assert loop.get("length") == found.length
                assert loop.get("tight", "no") == chain.tightness
    for name in ("threshold", "engine", "field", "max_dim"):
        assert bars.meta.get(name) == expected.get(name), name


ROUNDS = range(12)


@pytest.mark.parametrize("metric", ["euclidean", "manhattan", "chebyshev", "cosine", "hamming",
                                    "minkowski"])
@pytest.mark.parametrize("seed", ROUNDS)
def test_points(ph_barcode, metric, seed):
    rng = np.random.default_rng(seed)
    n, d, max_dim = rng.integers(1, 40), rng.integers(1, 5), int(rng.integers(0, 4))
    points = rng.normal(size=(n, d)) if seed % 2 else rng.integers(1, 4, size=(n, d)).astype(float)
    field = int(rng.choice([2, 3, 5]))
    kind = [None, "cycles", "cocycles"][seed % 3]
    options, arguments = {}, []
    if rng.integers(2):
        options["threshold"] = float(np.round(rng.uniform(0.2, 2), 2))
        arguments += ["--threshold", str(options["threshold"])]
    if metric == "minkowski":
        options["minkowski_p"] = 3
    bars = ph.rips(points, metric=metric, max_dim=max_dim, field=field, representatives=kind,
                   **options)
    name = "minkowski:3" if metric == "minkowski" else metric
    check(bars, ph_barcode(ph_barcode.file("p.npy", points), "--format", "npy", "--metric", name,
                           "--max-dim", str(max_dim), "--field", str(field), "--representatives",
                           kind or "none", *arguments))


@pytest.mark.parametrize("seed", ROUNDS)
@pytest.mark.parametrize("options, arguments", [
    ({"subsample": 9}, ["--subsample", "9"]),
    ({"subsample_radius": 0.5}, ["--subsample-radius", "0.5"]),
    ({"subsample": 20, "subsample_radius": 0.25},
     ["--subsample", "20", "--subsample-radius", "0.25"]),
    ({"approximation": 1.5}, ["--approximate", "1.5"]),
    ({"weights": "dtm", "dtm_neighbors": 4}, ["--dtm", "4"]),
    ({"weights": "core", "core_neighbors": 3}, ["--core", "3"]),
    ({"weights": "dtm", "dtm_neighbors": 3, "weight_exponent": 2},
     ["--dtm", "3", "--weight-exponent", "2"]),
    ({"collapse": True}, ["--collapse", "on"]), ({"collapse": False}, ["--collapse", "off"]),
    ({"min_persistence": 0.1}, ["--min-persistence", "0.1"]),
    ({"min_persistence": -1}, ["--min-persistence", "-1"]),
    ({"min_dim": 1}, ["--min-dim", "1"]), ({"engine": "standard"}, ["--engine", "standard"]),
    ({"engine": "cohomology"}, ["--engine", "cohomology"]),
    ({"max_dim": 0}, ["--max-dim", "0"])], ids=str)
def test_options_of_rips(ph_barcode, seed, options, arguments):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(30, 3)).round(1)
    check(ph.rips(points, **options),
          ph_barcode(ph_barcode.file("p.npy", points), "--format", "npy", *arguments))


@pytest.mark.parametrize("seed", ROUNDS)
def test_delays(ph_barcode, seed):
    rng = np.random.default_rng(seed)
    dimension, delay = int(rng.integers(1, 5)), int(rng.integers(1, 4))
    one, two = rng.normal(size=40).round(1), rng.normal(size=(40, 2)).round(1)
    option = f"{dimension},{delay}" if delay > 1 else str(dimension)
    table = ph_barcode.file("two.csv", "t,a,b\n" + "".join(
        f"x{i},{a},{b}\n" for i, (a, b) in enumerate(two)))
    for series, path, arguments in (
            (one, ph_barcode.file("one.npy", one), []),
            (one, ph_barcode.file("one.txt", "".join(f"{x}\n" for x in one)), []),
            (two, ph_barcode.file("two.npy", two), []),
            (two, ph_barcode.file("points.npy", two), ["--format", "points"]),
            (two[:, 1], table, ["--columns", "b"]), (two, table, ["--columns", "a,b"])):
        points = ph.delay_embedding(series, dimension, delay)
        check(ph.rips(points), ph_barcode(path, "--delay", option, *arguments))


@pytest.mark.parametrize("series, arguments, code, words", [
    (np.arange(9.0), ["--delay", "10"], 65, "found a series of 9 times, expected more than"),
    (np.arange(9.0), ["--delay", "2,9"], 65, "found a series of 9 times"),
    (np.arange(9.0), ["--delay", str(2**62)], 65, "found a series of 9 times"),
    (np.arange(9.0), ["--delay", "0"], 64, "--delay: found '0'"),
    (np.arange(9.0), ["--delay", "2,1,1"], 64, "expected D or D,TAU"),
    (np.arange(9.0), ["--delay", "2", "--nan", "drop"], 64, "cannot be combined with --nan drop"),
    (np.array([1, np.nan, 3]), ["--delay", "2"], 65, "nan"),
    (np.zeros((3, 3, 3)), ["--delay", "2"], 65, "expected a time series"),
    (np.zeros((3, 3)), ["--delay", "2", "--format", "distance"], 65, "expected a time series"),
    (np.arange(9.0), ["--delay", "2", "--complex", "cubical"], 64, "--delay: makes sense for")])
def test_delays_that_are_refused(ph_barcode, series, arguments, code, words):
    run = subprocess.run([ph_barcode.path, ph_barcode.file("s.npy", series), *arguments],
                         capture_output=True, text=True)
    assert run.returncode == code and words in run.stderr and not run.stdout


@pytest.mark.parametrize("seed", ROUNDS)
def test_given_weights(ph_barcode, seed):
    rng = np.random.default_rng(seed)
    points, weights = rng.normal(size=(25, 2)), rng.uniform(0, 1, size=25).round(2)
    path = ph_barcode.file("p.npy", points)
    file = ph_barcode.file("w.txt", "\n".join(map(str, weights)))
    for exponent in (1, 2, np.inf):
        check(ph.rips(points, weights=weights, weight_exponent=exponent),
              ph_barcode(path, "--format", "npy", "--vertex-weights", file, "--weight-exponent",
                         str(exponent)))


@pytest.mark.parametrize("seed", ROUNDS)
def test_points_left_out(ph_barcode, seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(30, 3)).round(2)
    points[rng.integers(30, size=6), rng.integers(3, size=6)] = np.nan
    text = "\n".join(",".join(map(str, row)) for row in points)
    check(ph.rips(points, nan="drop", representatives="cycles"),
          ph_barcode(ph_barcode.file("p.csv", text), "--format", "points", "--nan", "drop",
                     "--representatives", "cycles"))


@pytest.mark.parametrize("seed", ROUNDS)
def test_distances(ph_barcode, seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 30))
    condensed = rng.integers(1, 9, size=n * (n - 1) // 2) / 4 if seed % 2 else \
        pdist(rng.normal(size=(n, 4)))
    condensed[rng.random(condensed.size) < 0.1] = np.inf
    square = squareform(condensed)
    options = {"metric": "precomputed", "max_dim": 2, "representatives": "cycles"}
    arguments = ["--format", "distance", "--max-dim", "2", "--representatives", "cycles"]
    expected = ph_barcode(ph_barcode.file("d.npy", square), *arguments)
    for distances in (condensed, square, np.asfortranarray(square), square[::-1, ::-1][::-1, ::-1]):
        check(ph.rips(distances, **options), expected)
    single = square.astype(np.float32)
    check(ph.rips(single, **options), ph_barcode(ph_barcode.file("f.npy", single), *arguments))


@pytest.mark.parametrize("seed", ROUNDS)
def test_matrices_that_need_an_option(ph_barcode, seed):
    rng = np.random.default_rng(seed)
    matrix = rng.integers(1, 9, size=(12, 12)).astype(float)
    np.fill_diagonal(matrix, 0)
    path = ph_barcode.file("d.npy", matrix)
    for which in ("max", "min", "lower"):
        check(ph.rips(matrix, metric="precomputed", symmetrise=which),
              ph_barcode(path, "--format", "distance", "--symmetrise", which))
    matrix = np.maximum(matrix, matrix.T)
    np.fill_diagonal(matrix, rng.integers(0, 4, size=12))
    path = ph_barcode.file("b.npy", matrix)
    check(ph.rips(matrix, metric="precomputed", diagonal="births"),
          ph_barcode(path, "--format", "distance", "--diagonal", "births"))
    check(ph.rips(matrix, metric="precomputed", diagonal="any"),
          ph_barcode(path, "--format", "distance", "--diagonal", "zero"))
    np.fill_diagonal(matrix, 0)
    i, j = rng.integers(12, size=(2, 5))
    matrix[i, j] = matrix[j, i] = np.nan
    check(ph.rips(matrix, metric="precomputed", nan="drop"),
          ph_barcode(ph_barcode.file("n.npy", matrix), "--format", "distance", "--nan", "drop"))


@pytest.mark.parametrize("seed", ROUNDS)
def test_sparse_distances(ph_barcode, seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 25))
    matrix = np.triu(rng.integers(1, 9, size=(n, n)) * (rng.random((n, n)) < 0.4), 1).astype(float)
    matrix[0, n - 1] = 2  # a sparse matrix in a file does not say how many points there are
    upper = sparse.coo_matrix(matrix)
    lines = "\n".join(f"{i} {j} {d}" for i, j, d in zip(upper.row, upper.col, upper.data))
    expected = ph_barcode(ph_barcode.file("s.txt", lines), "--format", "sparse", "--max-dim", "2")
    both = matrix + matrix.T
    for make in (sparse.coo_matrix, sparse.csr_matrix, sparse.csc_matrix, sparse.lil_matrix,
                 sparse.dok_matrix, sparse.coo_array, sparse.csr_array):
        for dense in (matrix, matrix.T, both):
            check(ph.rips(make(dense), metric="precomputed", max_dim=2), expected)


TYPES = ["uint8", "uint16", "int16", "float32", "float64", "bool", "int8", "int32", "int64"]


@pytest.mark.parametrize("seed", range(30))
def test_images(ph_barcode, seed):
    rng = np.random.default_rng(seed)
    shape = tuple(rng.integers(1, 7, size=rng.integers(1, 5)))
    image = rng.integers(0, 5, size=shape).astype(TYPES[seed % len(TYPES)])
    options, arguments = {}, ["--format", "npy", "--complex", "cubical"]
    if seed % 2:
        options["construction"] = "cells"
        arguments += ["--construction", "cells"]
    if seed % 3 == 0:
        options["superlevel"] = True
        arguments.append("--superlevel")
    if seed % 4 == 0:
        options["periodic"] = [len(shape) - 1]
        arguments += ["--periodic", str(len(shape) - 1)]
    if seed % 5 == 0:
        options["threshold"] = 2.0
        arguments += ["--threshold", "2"]
    kind = ["none", "cycles", "cocycles", "none"][seed % 4]
    check(ph.cubical(image, representatives=kind, **options),
          ph_barcode(ph_barcode.file("i.npy", image), "--representatives", kind, *arguments))


@pytest.mark.parametrize("seed", ROUNDS)
def test_absent_voxels(ph_barcode, seed):
    rng = np.random.default_rng(seed)
    image = rng.integers(0, 5, size=(5, 6, 3)).astype([np.float32, np.float64][seed % 2])
    image[rng.random(image.shape) < 0.2] = np.nan
    for superlevel in ([], ["--superlevel"]):
        check(ph.cubical(image, nan="drop", superlevel=bool(superlevel)),
              ph_barcode(ph_barcode.file("i.npy", image), "--format", "npy", "--complex", "cubical",
                         "--nan", "drop", *superlevel))


@pytest.mark.parametrize("seed", ROUNDS)
def test_voxels_of_bars(ph_barcode, seed):
    rng = np.random.default_rng(seed)
    image = rng.integers(0, 9, size=[(7, 8), (4, 5, 4)][seed % 2])
    bars = ph.cubical(image, representatives="voxels")
    expected = ph_barcode(ph_barcode.file("i.npy", image), "--format", "npy", "--complex", "cubical",
                          "--representatives", "voxels")
    check(bars, expected)
    for i, bar in enumerate(expected["bars"]):
        assert list(bars.birth_voxel(i)) == bar["birth_voxel"]
        assert image[bars.birth_voxel(i)] == bars[i].birth
        if bar["death"] is not None:
            assert list(bars.death_voxel(i)) == bar["death_voxel"]
        if "voxels" in bar:
            places = [k for first, count in bar["voxels"] for k in range(first, first + count)]
            assert np.flatnonzero(bars.voxels(i)).tolist() == places


@pytest.mark.parametrize("seed", ROUNDS)
@pytest.mark.parametrize("value", ["distance", "occupancy", "density"])
def test_points_in_voxels(ph_barcode, seed, value):
    points = np.random.default_rng(seed).normal(size=(40, 1 + seed % 3))
    made = ph.point_image(points, 0.5, value=value)
    check(ph.cubical(made),
          ph_barcode(ph_barcode.file("p.npy", points), "--format", "npy", "--complex", "cubical",
                     "--voxel", "0.5", "--voxel-value", value))


def random_complex(rng, n=9):
    """All faces of some random simplices. The value of each simplex is at least the values of its
    faces."""
    simplices = set()
    for _ in range(12):
        top = sorted(rng.choice(n, size=rng.integers(1, 5), replace=False).tolist())
        for mask in range(1, 2**len(top)):
            simplices.add(tuple(v for k, v in enumerate(top) if mask >> k & 1))
    values = {}
    for simplex in sorted(simplices, key=len):
        faces = [simplex[:k] + simplex[k + 1:] for k in range(len(simplex))] if simplex[1:] else []
        values[simplex] = max([values[f] for f in faces] + [float(rng.integers(0, 6))])
    chosen = list(values)
    rng.shuffle(chosen)
    chosen = [tuple(s) for s in chosen]
    return chosen, [values[s] for s in chosen]


@pytest.mark.parametrize("seed", ROUNDS)
def test_filtered_complexes(ph_barcode, seed):
    rng = np.random.default_rng(seed)
    simplices, values = random_complex(rng)
    text = "\n".join(f"{' '.join(map(str, s))} : {v}" for s, v in zip(simplices, values))
    path = ph_barcode.file("s.txt", text)
    for field in (2, 3):
        for kind in ("none", "cycles", "cocycles"):
            for threshold in (None, 3.0):
                arguments = [] if threshold is None else ["--threshold", str(threshold)]
                check(ph.filtered(simplices, values, field=field, representatives=kind,
                                  threshold=threshold),
                      ph_barcode(path, "--format", "simplices", "--field", str(field),
                                 "--representatives", kind, *arguments))


@pytest.mark.parametrize("seed", ROUNDS)
def test_lower_stars(ph_barcode, seed):
    rng = np.random.default_rng(seed)
    triangles = np.sort([rng.choice(12, size=3, replace=False) for _ in range(15)], axis=1)
    triangles = np.unique(triangles, axis=0)
    values = rng.integers(0, 6, size=12).astype(float)
    path = ph_barcode.file("t.txt", "\n".join(f"{a} {b} {c} : 0" for a, b, c in triangles))
    file = ph_barcode.file("v.txt", "\n".join(map(str, values)))
    check(ph.lower_star(values, triangles),
          ph_barcode(path, "--format", "simplices", "--complex", "lower-star", "--values", file))


@pytest.mark.parametrize("seed", ROUNDS)
def test_boundary_matrices(ph_barcode, seed):
    rng = np.random.default_rng(seed)
    simplices, values = random_complex(rng)
    order = sorted(range(len(simplices)), key=lambda i: (values[i], len(simplices[i])))
    place = {tuple(sorted(simplices[i])): k for k, i in enumerate(order)}
    columns = [sorted(place[s[:k] + s[k + 1:]] for k in range(len(s))) if s[1:] else []
               for s in (tuple(sorted(simplices[i])) for i in order)]
    dims = [len(simplices[i]) - 1 for i in order]
    matrix = sparse.csc_matrix(
        (np.ones(sum(map(len, columns))), np.concatenate([np.array(c, int) for c in columns]),
         np.cumsum([0] + [len(c) for c in columns])), shape=(len(order),) * 2)
    text = "\n".join(" ".join(map(str, [d, *c])) for d, c in zip(dims, columns))
    path = ph_barcode.file("m.txt", text)
    check(ph.boundary(matrix, dims), ph_barcode(path, "--format", "phat"))
    file = ph_barcode.file("v.txt", "\n".join(str(values[i]) for i in order))
    check(ph.boundary(matrix.tocoo(), dims, [values[i] for i in order]),
          ph_barcode(path, "--format", "phat", "--values", file))


@pytest.mark.parametrize("seed", ROUNDS)
def test_estimates(ph_barcode, seed):
    points = np.random.default_rng(seed).normal(size=(60, 3))
    found = ph.estimate(points, max_dim=2)
    text = subprocess.run([ph_barcode.path, ph_barcode.file("p.npy", points), "--format", "npy",
                           "--max-dim", "2", "--dry-run", "--quiet"], capture_output=True,
                          text=True).stdout
    assert found.engine in text
