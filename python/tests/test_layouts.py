# SPDX-License-Identifier: MIT
"""Tests barcodes in the layouts of other packages, there and back."""
import numpy as np
import pytest

import libph as ph

POINTS = np.random.default_rng(0).normal(size=(30, 3))
ROWS = [[0, 0.0, 1.0], [0, 0.0, np.inf], [1, 0.75, 1.5], [2, 1.25, 2.5]]


@pytest.mark.parametrize("layout", ["dim-birth-death", "giotto", "ripser", "gudhi"])
@pytest.mark.parametrize("make", [
    lambda: ph.rips(POINTS, max_dim=2), lambda: ph.rips(POINTS.round(), min_persistence=-1),
    lambda: ph.cubical(POINTS, superlevel=True), lambda: ph.rips([])])
def test_layouts_there_and_back(make, layout):
    bars = make()
    there = bars.to_numpy(layout)
    assert ph.Barcode.from_dgms(there, layout) == bars


def test_arrays_become_a_barcode():
    expected = [ph.Bar(int(dim), birth, death) for dim, birth, death in ROWS]
    for dgms in (ROWS, np.array(ROWS), [tuple(row) for row in ROWS], np.array(ROWS)[::-1],
                 np.array(ROWS)[:, [1, 2, 0]], np.array(ROWS, dtype=np.float32),
                 [[[0, 1], [0, np.inf]], [[0.75, 1.5]], [[1.25, 2.5]]],
                 (np.array([[0, np.inf], [0, 1]]), np.array([[0.75, 1.5]]), np.array([[1.25, 2.5]])),
                 [(int(d), (b, e)) for d, b, e in ROWS]):
        assert list(ph.Barcode.from_dgms(dgms)) == expected
    by_dimension = (dgm for dgm in ([[0, 1], [0, np.inf]], [[0.75, 1.5]], [[1.25, 2.5]]))
    assert list(ph.Barcode.from_dgms(by_dimension, "ripser")) == expected
    empty = ph.Barcode.from_dgms([np.empty((0, 2)), [[1, 2]], []])
    assert len(empty) == 1 and [len(dgm) for dgm in empty.dgms()] == [0, 1, 0]
    assert len(ph.Barcode.from_dgms([])) == 0 == len(ph.Barcode.from_dgms(np.empty((0, 3))))


@pytest.mark.parametrize("dgms, layout, error, message", [
    ([[0, 0, 1], [1, 1, 2]], None, ph.UsageError, "fit both .*layout='dim-birth-death'"),
    ([[0, 2, 0.5]], None, ph.UsageError, "fit neither of dim, birth, death and"),
    (np.zeros((5, 4, 3)), None, ph.UsageError, r"several inputs, .*dgms\[0\]"),
    (np.zeros((4, 2)), None, ph.UsageError, r"one array for each dimension; a list \[dgm\]"),
    ({"dgms": []}, None, ph.UsageError, r"result\['dgms'\]"),
    (np.zeros((4, 5)), None, ph.UsageError, r"shape \(4, 5\)"),
    ([[[0, 1]], [[0, 1], [3, 2]]], None, ph.DataError, r"dgms\[1\]: row 1: found birth 3 and death 2"),
    ([[[0, np.nan]]], None, ph.DataError, r"dgms\[0\]: row 0: .*expected numbers"),
    ([[[np.inf, np.inf]]], None, ph.DataError, "a finite birth"),
    ([[0.5, 0, 1]], "dim-birth-death", ph.DataError, "row 0: found dimension 0.5"),
    ([(0, (0, 1)), (1, 0, 1)], "gudhi", ph.UsageError,
     r"dgms\[1\]: found \(1, 0, 1\), expected dim, \(birth, death\)"),
    (None, "gudhi", ph.UsageError, r"dgms: found None, expected a list of \(dim,"),
    (np.zeros((2, 2)), "gudhi", ph.UsageError, r"dgms\[0\]: found array"),
    ([[0, 1, -1]], "giotto", ph.DataError, "row 0: found dimension -1"),
    ([[[0, 1, 2]]], "ripser", ph.UsageError, r"dgms\[0\]: .*expected \(n, 2\)"),
    ("bars.csv", None, ph.UsageError, "ph.read"),
    ([], "persim", ph.UsageError, "layout: found 'persim'"),
])
def test_arrays_that_are_no_barcode(dgms, layout, error, message):
    with pytest.raises(error, match=message):
        ph.Barcode.from_dgms(dgms, layout)


def test_the_class_itself_names_from_dgms():
    with pytest.raises(TypeError, match="Barcode.from_dgms takes the arrays"):
        ph.Barcode([np.zeros((2, 2))])
