# SPDX-License-Identifier: MIT
"""Bars that are born at -inf, some of which also die there."""
import numpy as np
import pytest

import libph as ph
import libph.compat.gudhi as gudhi

INF = np.inf
VALLEYS = [-INF, 3, -INF]
PLATEAU = [[-INF, -INF, 3], [-INF, -INF, 4], [5, 5, 5]]


def test_bars_that_never_die_come_first():
    bars = ph.cubical(VALLEYS)
    assert bars.dgm(0).tolist() == [[-INF, 3], [-INF, INF]]
    assert bars[bars.longest(0)].death == INF
    assert bars.longest(0, 2).tolist() == [1, 0]
    ordinary = ph.cubical([0, 9, 1, 7, 2, 8, 0])
    lengths = [ordinary[i].persistence for i in ordinary.longest(0, 5)]
    assert lengths == sorted(lengths, reverse=True)


def test_bars_that_die_at_once_have_no_length():
    bars = ph.cubical(PLATEAU, construction="cells", min_persistence=-1)
    empty = bars.deaths == bars.births
    assert (bars.deaths[empty] == -INF).any()
    assert bars.filter(min_persistence=0) == ph.cubical(PLATEAU, construction="cells")
    assert empty[bars.longest(0, 99)].tolist() == sorted(empty[bars.dims == 0])
    listed = [death - birth if birth != death else 0
              for dim, (birth, death) in bars.to_numpy("gudhi") if dim == 0]
    assert listed == sorted(listed, reverse=True)


@pytest.mark.parametrize("least", [-1, 0])
def test_betti_numbers_of_the_drop_in(least):
    image = gudhi.CubicalComplex(top_dimensional_cells=np.array(PLATEAU))
    bars = image.persistence(min_persistence=least)
    assert image.betti_numbers() == [1, 0, 0]
    pairs, never = image.cofaces_of_persistence_pairs()
    assert len(never[0]) == 1 and sum(map(len, pairs)) == len(bars) - 1
