# SPDX-License-Identifier: MIT
"""Checks by calling GUDHI what docs/how-to/coming-from.md says about GUDHI's functions."""
import numpy as np
import pytest

import libph as ph

gudhi = pytest.importorskip("gudhi", reason="GUDHI is missing, which the page is compared with")
X = np.random.default_rng(0).random((30, 2))
IMAGE = np.random.default_rng(0).random((6, 7))


def tree_of(points, dimension=2):
    tree = gudhi.RipsComplex(points=points).create_simplex_tree(max_dimension=dimension)
    tree.compute_persistence(homology_coeff_field=2, min_persistence=0)
    return tree


def sorted_rows(rows):
    rows = np.array(rows)
    return rows[np.lexsort(rows.T)]


def test_simplices_of_a_tree():
    tree = tree_of(X)
    bars = ph.filtered(*zip(*tree.get_filtration()), max_dim=1)
    assert np.allclose(sorted_rows(bars.dgm(1)),
                       sorted_rows(tree.persistence_intervals_in_dimension(1)))


def test_pairs_of_simplices():
    pairs = {(tuple(sorted(birth)), tuple(sorted(death)))
             for birth, death in tree_of(X).persistence_pairs()}
    bars = ph.rips(X)
    ours = {(tuple(birth), tuple(death)) for birth, death in zip(
        bars.birth_cells(1).tolist(), bars.death_cells(1).tolist())}
    assert len(ours) == len(bars.dgm(1)) > 0 and ours <= pairs


def test_edges_that_decide():
    bars = ph.rips(X).filter(dim=1)
    births, deaths = ph.gradients.deciders(bars, X)
    theirs = tree_of(X).flag_persistence_generators()[1][0]
    edges = np.sort(theirs.reshape(-1, 2, 2), axis=2).reshape(-1, 4)
    assert np.array_equal(sorted_rows(np.column_stack([births, deaths])), sorted_rows(edges))


def test_pixels_that_decide():
    theirs = gudhi.CubicalComplex(top_dimensional_cells=IMAGE)
    theirs.compute_persistence(homology_coeff_field=2)
    pairs, _ = theirs.cofaces_of_persistence_pairs()
    bars = ph.cubical(IMAGE, construction="cells")
    births, deaths = ph.gradients.deciders(bars, IMAGE)
    for dim in (0, 1):
        dies = (bars.dims == dim) & np.isfinite(bars.deaths)
        ours = [np.ravel_multi_index(cells[dies].T, IMAGE.shape, order="F")
                for cells in (births, deaths)]
        assert np.array_equal(sorted_rows(np.transpose(ours)), sorted_rows(pairs[dim]))
