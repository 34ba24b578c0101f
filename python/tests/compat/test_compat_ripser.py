# SPDX-License-Identifier: MIT
"""Tests what the drop-in for ripser.py promises. ripser.py itself is not needed."""
import functools
import pickle
import shutil
import subprocess
import warnings

import numpy as np
import pytest
import scipy.sparse as sparse
from scipy.spatial.distance import pdist, squareform

import libph as ph
from libph.compat import ripser as module
from libph.compat.ripser import correlation_to_distance, get_greedy_perm, lower_star_img, ripser
from reference import INF, Flag, random_distances, same, single, sorted_rows

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 1.0]])
of_matrix = functools.partial(ripser, distance_matrix=True)


# ---- results


def test_the_dictionary():
    found = ripser(SQUARE, maxdim=2)
    assert set(found) == {"dgms", "cocycles", "num_edges", "dperm2all", "idx_perm", "r_cover"}
    assert [d.dtype for d in found["dgms"]] == [np.float64] * 3
    assert [d.shape for d in found["dgms"]] == [(4, 2), (1, 2), (0, 2)]
    assert np.array_equal(found["dgms"][1], [[1, single(np.sqrt(2))]])
    assert found["cocycles"] == [[], [], []]
    assert found["num_edges"] == 10 and type(found["num_edges"]) is int
    assert found["idx_perm"].dtype == np.int64 and found["idx_perm"].tolist() == [0, 1, 2, 3, 4]
    assert found["r_cover"] == 0.0 and np.allclose(found["dperm2all"], squareform(pdist(SQUARE)))


def test_dperm2all_is_the_matrix_that_was_given():
    for matrix in (squareform(pdist(SQUARE)), sparse.coo_matrix(squareform(pdist(SQUARE)))):
        assert of_matrix(matrix)["dperm2all"] is matrix


@pytest.mark.parametrize("p", [2, 3, 5])
@pytest.mark.parametrize("ties", [False, True])
def test_bars_are_those_of_rounded_distances(rng, p, ties):
    for _ in range(8):
        n = int(rng.integers(2, 8))
        distances = random_distances(rng, n, ties) / 3
        thresh = INF if rng.random() < 0.5 else float(rng.choice(distances.ravel()))
        flag = Flag(single(distances), limit=single(thresh))
        found = of_matrix(distances, maxdim=2, coeff=p, thresh=thresh)
        assert same(found["dgms"], flag.bars(2, p))
        exact = of_matrix(distances, maxdim=2, coeff=p, thresh=thresh, dtype=np.float64)
        assert same(exact["dgms"], Flag(distances, limit=thresh).bars(2, p))


def test_thresholds_and_distances_are_compared_in_single_precision():
    step = 2.0**-24  # half the gap between 1 and the next larger float32
    for above, joined in ((0.5 * step, True), (step, True), (1.001 * step, False)):
        matrix = [[0, 1 + above], [1 + above, 0]]
        assert len(of_matrix(np.array(matrix), thresh=1)["dgms"][0]) == 2
        assert np.isfinite(of_matrix(np.array(matrix), thresh=1)["dgms"][0][0, 1]) == joined
        assert not np.isfinite(of_matrix(np.array(matrix), thresh=1, dtype=float)["dgms"][0][0, 1])
    close = np.array([[0, 1, 2], [1, 0, 1 + step / 2], [2, 1 + step / 2, 0]])
    assert of_matrix(close)["dgms"][0].tolist() == [[0, 1], [0, 1], [0, INF]]


def test_a_bar_that_rounding_shortens_to_nothing_is_left_out():
    long = 1 + 2.0**-26
    square = np.array([[0, 1, long, 1], [1, 0, 1, long], [long, 1, 0, 1], [1, long, 1, 0]])
    assert of_matrix(square)["dgms"][1].shape == (0, 2)
    assert of_matrix(square, dtype=np.float64)["dgms"][1].tolist() == [[1, long]]


def test_order(rng):
    found = ripser(rng.normal(size=(60, 4)), maxdim=2)["dgms"]
    assert (np.diff(found[0][:, 1]) >= 0).all() and found[0][-1, 1] == INF
    for dgm in found[1:]:
        assert len(dgm) > 1 and (np.diff(dgm[:, 0]) <= 0).all()
    # Infinite bars are sorted together with the finite bars.
    cut = ripser(rng.random((60, 3)), thresh=0.3)["dgms"][1]
    assert np.isinf(cut[:, 1]).any() and (np.diff(cut[:, 0]) <= 0).all()
    squares = [np.array([[0, 1, d, 1], [1, 0, 1, d], [d, 1, 0, 1], [1, d, 1, 0]])
               for d in (1.25, 1.75, 1.5)]
    three = np.kron(1 - np.eye(3), np.full((4, 4), 9.0))
    for k, square in enumerate(squares):
        three[4 * k:4 * k + 4, 4 * k:4 * k + 4] = square
    assert of_matrix(three)["dgms"][1].tolist() == [[1, 1.75], [1, 1.5], [1, 1.25]]


def test_num_edges():
    distances = squareform(pdist(SQUARE))
    for maxdim in (0, 1):
        assert ripser(SQUARE, thresh=1, maxdim=maxdim)["num_edges"] == 7
    line = np.array([[0.0], [1.0], [2.0], [10.0], [11.0]])
    assert ripser(line)["num_edges"] == 7  # edges up to the enclosing radius, 9
    # The sparse matrix stores no zeros.
    assert of_matrix(sparse.csr_matrix(distances), thresh=1)["num_edges"] == 6
    births = squareform(pdist(line))
    np.fill_diagonal(births, 0.5)
    # For a matrix with births, ripser.py computes no enclosing radius.
    assert of_matrix(births)["num_edges"] == 10
    close = 1 + 2.0**-26
    nearly = np.array([[0, 1, 1], [1, 0, close], [1, close, 0]])
    assert of_matrix(nearly)["num_edges"] == 3 and of_matrix(nearly, dtype=float)["num_edges"] == 2


def test_maxdim_and_lists():
    assert len(ripser(SQUARE, maxdim=-3)["dgms"]) == 1
    assert same(ripser(SQUARE.tolist())["dgms"], ripser(SQUARE)["dgms"])
    assert same(of_matrix(np.array([[0.0]]))["dgms"], [[[0, INF]], []])


# ---- points


def test_points_are_measured_by_scikit_learn(rng):
    from sklearn.metrics import pairwise_distances
    points = rng.random((30, 3))
    for metric in ("euclidean", "manhattan", "cosine", lambda a, b: abs(a - b).max()):
        matrix = pairwise_distances(points, metric=metric)
        found = ripser(points, metric=metric)
        assert np.array_equal(found["dperm2all"], matrix)
        mirrored = np.triu(matrix, 1) + np.triu(matrix, 1).T
        assert same(found["dgms"], of_matrix(mirrored)["dgms"])


def test_euclidean_distances_have_the_digits_of_scikit_learn(rng):
    from sklearn.metrics import pairwise_distances
    for rows, columns in ((1, 1), (2, 5), (10, 2), (33, 3), (100, 50), (300, 7)):
        points = rng.normal(size=(2 * rows, columns)) * 10.0**rng.integers(-8, 9)
        repeated = np.repeat(points[:rows], 2, axis=0)
        for data in (points, points[::2], np.asfortranarray(points), points.astype(np.float32),
                     repeated, np.round(repeated).astype(int), points > 0, points[:, ::-1]):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                found = ripser(data, maxdim=0)["dperm2all"]
            expected = pairwise_distances(data)
            assert found.dtype == expected.dtype and np.array_equal(found, expected)


def test_n_perm(rng):
    points = rng.random((40, 2))
    distances = squareform(pdist(points))
    for data, options in ((points, {}), (distances, {"distance_matrix": True})):
        found = ripser(data, n_perm=12, **options)
        chosen = [0]
        for _ in range(11):
            chosen.append(int(np.argmax(distances[chosen].min(axis=0))))
        assert found["idx_perm"].tolist() == chosen and found["idx_perm"].dtype == np.int64
        assert np.isclose(found["r_cover"], distances[chosen].min(axis=0).max())
        assert type(found["r_cover"]) is np.float64
        assert found["dperm2all"].shape == (12, 40)
        every, radii, to_all = get_greedy_perm(data, **options)
        assert every[:12].tolist() == chosen and len(set(every)) == 40
        assert radii.shape == (40,) and radii[11] == found["r_cover"] and radii[-1] == 0
        assert np.array_equal(to_all[:12], found["dperm2all"])
        part = of_matrix(distances[np.ix_(chosen, chosen)])
        for dgm, other in zip(found["dgms"], part["dgms"]):
            assert np.allclose(dgm, other)
    angles = ripser(rng.random((40, 7)), n_perm=12, metric="cosine")
    # The distance from a chosen point to itself is exactly 0, in spite of rounding.
    assert not angles["dperm2all"][np.arange(12), angles["idx_perm"]].any()
    for n_perm in (0, None, 40):
        found = ripser(points, n_perm=n_perm)
        assert found["idx_perm"].tolist() == list(range(40)) and found["r_cover"] == 0.0
        assert found["dperm2all"].shape == (40, 40)


# ---- cocycles


@pytest.mark.parametrize("p", [2, 3, 5])
def test_cocycles(rng, p):
    seen = 0
    for trial in range(10):
        distances = random_distances(rng, 9, trial % 2 == 0)
        thresh = INF if trial % 3 else 0.8 * distances.max()
        found = of_matrix(distances, maxdim=2, coeff=p, thresh=thresh, do_cocycles=True)
        flag = Flag(single(distances), limit=single(thresh))
        assert found["cocycles"][0] == []
        for dim in (1, 2):
            dgm, cocycles = found["dgms"][dim], found["cocycles"][dim]
            assert len(dgm) == len(cocycles)
            for (birth, death), rows in zip(dgm, cocycles):
                assert rows.dtype == np.int64 and rows.shape[1] == dim + 2
                assert (np.diff(rows[:, :-1], axis=1) < 0).all()
                flag.check_cocycle(rows, p, birth, death)
                seen += 1
    assert seen > 10


def test_cocycles_name_the_points_of_the_whole_cloud(rng):
    points = rng.random((40, 2))
    found = ripser(points, n_perm=15, do_cocycles=True, coeff=3)
    chosen = found["idx_perm"]
    part = ripser(points[chosen], do_cocycles=True, coeff=3)
    assert len(part["cocycles"][1]) > 1
    for rows, inner in zip(found["cocycles"][1], part["cocycles"][1]):
        assert np.array_equal(rows[:, :-1], chosen[inner[:, :-1]])
        assert np.array_equal(rows[:, -1], inner[:, -1])


# ---- warnings and errors


def test_warnings():
    square = ("The input matrix is square, but the distance_matrix flag is off.  Did you mean to "
              "indicate that this was a distance matrix?")
    wide = "The input point cloud has more columns than rows; did you mean to transpose?"
    for data, text in ((np.eye(3), square), (np.zeros((2, 3)), wide)):
        with pytest.warns(UserWarning) as caught:
            ripser(data)
        assert [str(warning.message) for warning in caught] == [text]
        assert caught[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ripser(SQUARE)


DISTANCES = {"distance_matrix": True}


@pytest.mark.parametrize("data, options, text", [
    (np.zeros((2, 3)), DISTANCES, "Distance matrix is not square"),
    (sparse.eye(3).tocsr(), {**DISTANCES, "n_perm": 2},
     "Greedy permutation is not supported for sparse distance matrices"),
    (SQUARE, {"n_perm": 6},
     "Number of points in greedy permutation is greater than number of points in the point cloud"),
    (SQUARE, {"n_perm": -1},
     "Should be a strictly positive number of points in the greedy permutation"),
    (np.zeros(4), {}, "X: found an array of shape"),
    (SQUARE, {"coeff": 4}, "4"),
    (SQUARE, {"coeff": 0}, "field: found 0"),
    (SQUARE, {"thresh": np.nan}, "thresh: found nan"),
    (SQUARE, {"maxdim": 1.5}, "maxdim: found 1.5"),
    (SQUARE, {"dtype": int}, "dtype: found"),
    (np.empty((0, 0)), {}, "0 sample"),
    (np.array([[0.0, 1], [np.nan, 2], [3, 4]]), {}, "NaN"),
    (np.array([[0.0, np.nan], [np.nan, 0]]), DISTANCES, "row 0, column 1: found nan"),
    (np.array([[0.0, 1], [2, 0]]), DISTANCES, "row 0, column 1: found 1.0, but 2.0"),
    (np.array([[np.nan, 1], [1, 0]]), DISTANCES, "the diagonal: entry 0: found nan"),
    (sparse.coo_matrix(([1.0, 2], ([0, 1], [1, 0]))), DISTANCES, "expected equal values"),
    (sparse.coo_matrix(([np.nan], ([0], [1])), shape=(2, 2)), DISTANCES, "found nan")])
@pytest.mark.filterwarnings("ignore:The input matrix is square")
def test_errors(data, options, text):
    with pytest.raises(ValueError, match=text):
        ripser(data, **options)


def test_run_options():
    with pytest.raises(ph.Timeout):
        ripser(np.random.default_rng(0).random((400, 3)), maxdim=2, timeout=1e-9)
    with pytest.raises(ph.MemoryLimitError):
        ripser(np.random.default_rng(0).random((400, 3)), memory_limit=1000)
    with pytest.raises(TypeError, match="unexpected keyword argument 'thread'"):
        ripser(SQUARE, thread=1)
    assert same(ripser(SQUARE, threads=2)["dgms"], ripser(SQUARE)["dgms"])


# ---- other functions of the module


def test_the_class(capsys):
    from sklearn.base import TransformerMixin
    rips = module.Rips(maxdim=2, coeff=3, do_cocycles=True)
    assert capsys.readouterr().out == (
        "Rips(maxdim=2, thresh=inf, coeff=3, do_cocycles=True, n_perm = None, verbose=True)\n")
    assert isinstance(rips, TransformerMixin) and not hasattr(rips, "fit")
    assert rips.dgms_ is None and rips.r_cover_ == 0.0 and rips.metric_ is None
    found = ripser(SQUARE, maxdim=2, coeff=3, do_cocycles=True)
    for transform in (rips.transform, rips.fit_transform):
        assert same(transform(SQUARE), found["dgms"]) and rips.num_edges_ == found["num_edges"]
    assert len(rips.cocycles_[1]) == 1 and rips.idx_perm_.tolist() == [0, 1, 2, 3, 4]
    assert np.array_equal(rips.dperm2all_, found["dperm2all"])
    again = pickle.loads(pickle.dumps(rips))
    assert same(again.dgms_, rips.dgms_) and again.coeff == 3
    module.Rips(verbose=False)
    assert capsys.readouterr().out == ""
    with pytest.raises(AttributeError):
        module.nothing


def by_hand(image):
    """H0 of the graph in which each pixel is joined to its eight neighbours."""
    image = np.asarray(image, dtype=float)
    places = list(np.ndindex(image.shape))
    distances = np.array([[max(image[a], image[b]) if max(abs(a[0] - b[0]), abs(a[1] - b[1])) == 1
                           else 0 if a == b else INF for b in places] for a in places])
    return Flag(distances, image.ravel()).bars(0)[0]


def test_lower_star_img(rng):
    for image in (rng.random((4, 5)), rng.integers(0, 3, (5, 4)), -rng.random((3, 3)),
                  np.zeros((1, 1)), rng.integers(0, 255, (4, 4)).astype(np.uint8)):
        found = lower_star_img(image)
        assert found.dtype == np.float64
        assert np.array_equal(sorted_rows(found), by_hand(single(image)))
        assert (np.diff(found[:, 1]) >= 0).all()
        assert np.array_equal(sorted_rows(lower_star_img(image, dtype=float)), by_hand(image))
    with pytest.raises(ph.DataError, match="nan"):
        lower_star_img([[0.0, np.nan]])
    with pytest.raises(ph.UsageError, match="two axes"):
        lower_star_img(np.zeros((2, 2, 2)))


def test_correlation_to_distance():
    correlations = np.array([[1, 0.5, -1], [0.5, 1, 0], [-1, 0, 1]])
    found = correlation_to_distance(correlations)
    assert np.allclose(found, [[0, 1, 2], [1, 0, np.sqrt(2)], [2, np.sqrt(2), 0]])
    for wrong, text in ((np.zeros(3), "Input must be a 2D matrix"),
                        (np.zeros((2, 3)), "Matrix must be square"),
                        (np.array([[1, 0.8], [0.2, 1]]), "Matrix must be symmetric"),
                        (np.array([[1, 1.1], [1.1, 1]]),
                         "significantly outside the valid correlation bounds"),
                        (np.array([[1, np.nan], [np.nan, 1]]), "found nan")):
        with pytest.raises(ValueError, match=text):
            correlation_to_distance(wrong)
    with pytest.warns(RuntimeWarning, match="slightly outside the valid correlation bounds"):
        assert correlation_to_distance([[1, 1.02], [1.02, 1]])[0, 1] == 0
    with pytest.warns(RuntimeWarning, match="diagonal elements deviate from 1.0"):
        assert correlation_to_distance([[0.9, 0], [0, 1]])[0, 0] == 0
    assert correlation_to_distance([[5, -9], [7, 3]], check_input=False)[1, 0] == 0


@pytest.mark.skipif(shutil.which("ripser") is None, reason="the program ripser is not installed")
def test_the_program_ripser(rng, tmp_path):
    distances = squareform(pdist(rng.normal(size=(40, 4))))
    path = tmp_path / "distances.csv"
    np.savetxt(path, distances, delimiter=",")
    text = subprocess.run(["ripser", "--format", "distance", "--dim", "2", path],
                          capture_output=True, text=True, check=True).stdout
    theirs = [[] for _ in range(3)]
    for line in text.splitlines():
        if line.startswith("persistence intervals in dim"):
            dim = int(line.rstrip(":").split()[-1])
        elif line.startswith(" ["):
            birth, death = line.strip(" [)").split(",")
            theirs[dim].append((float(birth), float(death or "inf")))
    ours = of_matrix(distances, maxdim=2)["dgms"]
    assert len(theirs[2]) > 0
    for dgm, bars in zip(ours, theirs):
        assert len(dgm) == len(bars)
        assert np.allclose(sorted_rows(dgm), sorted_rows(bars), rtol=1e-5)
