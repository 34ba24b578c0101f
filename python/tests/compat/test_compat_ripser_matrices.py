# SPDX-License-Identifier: MIT
"""Tests the drop-in for ripser.py on matrices: with births, with negative values, sparse, and
large."""
import functools

import numpy as np
import pytest
import scipy.sparse as sparse
from scipy.spatial.distance import pdist, squareform

import libph as ph
from libph.compat.ripser import ripser
from reference import INF, Flag, random_distances, same, single

of_matrix = functools.partial(ripser, distance_matrix=True)


@pytest.mark.parametrize("shift", [0.0, 5.0])
@pytest.mark.parametrize("form", ["dense", "coo", "csr", "array"])
def test_births_on_the_diagonal(rng, shift, form):
    for trial in range(6):
        n = 7
        births = rng.integers(0, 3, n) / 2 - shift
        distances = random_distances(rng, n, trial % 2 == 0) + 0.25 - shift
        matrix = np.maximum(distances, np.maximum(births[:, None], births))
        np.fill_diagonal(matrix, births)
        expected = Flag(single(matrix), single(births)).bars(2, 3)
        if form != "dense":
            i, j = np.indices((n, n)).reshape(2, -1)
            matrix = sparse.coo_matrix((matrix.ravel(), (i, j)), shape=(n, n))
            matrix = {"coo": matrix, "csr": matrix.tocsr(), "array": sparse.csr_array(matrix)}[form]
        assert same(of_matrix(matrix, maxdim=2, coeff=3)["dgms"], expected)


def test_a_point_that_enters_beyond_the_threshold_never_dies():
    matrix = np.array([[0.0, 3.0], [3.0, 2.0]])
    assert of_matrix(matrix, thresh=1)["dgms"][0].tolist() == [[0, INF], [2, INF]]
    assert of_matrix(matrix)["dgms"][0].tolist() == [[2, 3], [0, INF]]


def test_the_point_that_is_near_to_all_may_be_late():
    """The last point is near to all others but is born late. The enclosing radius around this point
    is therefore valid only from its birth on."""
    matrix = np.array([[0, 2, 3, 2, 1], [2, 0, 2, 3, 1], [3, 2, 0, 2, 1], [2, 3, 2, 0, 1],
                       [1, 1, 1, 1, 5.0]])
    found = of_matrix(matrix)["dgms"]
    assert found[1].tolist() == [[2, 3]]
    assert same(found, Flag(matrix - 5 * np.diag([0, 0, 0, 0, 1]), [0, 0, 0, 0, 5]).bars(1))


def test_a_point_that_is_born_at_infinity_never_enters():
    for least in (0.0, -1.0):
        matrix = np.array([[least, 1, INF], [1, 0, 2], [INF, 2, INF]])
        assert sorted(of_matrix(matrix)["dgms"][0].tolist()) == sorted(
            [[least, INF], [0, 1]])


def test_sparse_matrices(rng):
    upper = np.triu(random_distances(rng, 9, True), 1)
    upper[rng.random((9, 9)) < 0.4] = 0
    i, j = np.nonzero(upper)
    values = upper[i, j]
    expected = Flag(np.where(upper + upper.T > 0, upper + upper.T, INF)).bars(1)

    def of(i, j, values):
        order = rng.permutation(len(i))
        return sparse.coo_matrix((values[order], (i[order], j[order])), shape=(9, 9))

    both = of(*(np.concatenate(pair) for pair in ((i, j), (j, i), (values, values))))
    for matrix in (of(i, j, values), of(j, i, values), both, both.tocsr(), both.tocsc(),
                   both.tolil(), sparse.coo_array(both)):
        found = of_matrix(matrix)
        assert same(found["dgms"], expected) and found["num_edges"] == len(i)


def test_zeros_that_are_stored_are_distances():
    stored = sparse.coo_matrix(([0.0], ([0], [1])), shape=(2, 2))
    assert of_matrix(stored)["dgms"][0].tolist() == [[0, INF]]
    dense = np.array([[1.0, 0, 2], [0, 0, 2], [2, 2, 0]])  # an edge older than its endpoint
    assert of_matrix(dense)["dgms"][0].tolist() == [[0, 2], [0, INF]]


def test_a_diagonal_that_is_stored_twice():
    places = [0, 0, 0], [0, 0, 1]
    for same_births in (0.5, INF):
        matrix = sparse.coo_matrix(([same_births, same_births, 1.0], places), shape=(2, 2))
        assert len(of_matrix(matrix)["dgms"][0]) > 0
    differ = sparse.coo_matrix(([0.5, 0.7, 1.0], places), shape=(2, 2))
    with pytest.raises(ph.DataError, match="row 0, column 0: found 0.5 and 0.7, expected equal values"):
        of_matrix(differ)


def test_asymmetry_by_rounding_is_none_and_the_upper_entry_counts():
    matrix = np.array([[0, 1, 2], [1 + 1e-9, 0, 1], [2, 1, 0]])
    assert 1.0 in of_matrix(matrix, dtype=float)["dgms"][0]
    assert 1 + 1e-9 in of_matrix(matrix.T, dtype=float)["dgms"][0]


def test_large_matrices_are_looked_at_in_strips(rng):
    """The matrix has more than 512 rows."""
    points = rng.random((700, 2))
    points[[0, 690]] = [[0, 0], [0.5, 0.5]]  # a corner, and the centre
    matrix = squareform(pdist(points))
    exact = ph.rips(matrix, metric="precomputed")
    assert same(of_matrix(matrix, dtype=float)["dgms"], exact.dgms())
    radius = matrix.max(axis=1).min()
    assert of_matrix(matrix)["num_edges"] == np.count_nonzero(
        single(matrix) <= single(radius)) // 2 - 350
    births = matrix.copy()
    np.fill_diagonal(births, -1)
    assert same(of_matrix(births, maxdim=0, dtype=float)["dgms"],
                [np.column_stack([np.full(700, -1), exact.dgm(0)[:, 1]])])
    for place in ((600, 3), (3, 600), (650, 600)):
        for number in (np.nan, 9.0, INF):
            broken = matrix.copy()
            broken[place] = number
            with pytest.raises(ph.DataError, match=f"row {min(place)}, column {max(place)}"):
                of_matrix(broken)
