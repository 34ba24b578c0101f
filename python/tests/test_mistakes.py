# SPDX-License-Identifier: MIT
"""First mistakes: what is likely meant otherwise is warned of, or refused with a way out."""
import warnings

import numpy as np
import pytest

import libph as ph

SERIES = np.random.default_rng(1).standard_normal((60, 8))
CORRELATIONS = np.corrcoef(SERIES.T)


@pytest.mark.parametrize("X, words", [
    (CORRELATIONS, "with 1 on its diagonal, as correlations are; .* takes 1 - X for distances"),
    (1 - CORRELATIONS, "with 0 on its diagonal, as distances are; .* takes X for distances"),
    (1e9 * (1 - CORRELATIONS), "as distances are"), (1e-9 * (1 - CORRELATIONS), "as distances are")])
@pytest.mark.parametrize("function", [ph.rips, ph.estimate, ph.merge_tree])
def test_a_matrix_taken_for_points(function, X, words):
    with pytest.warns(UserWarning, match=f"X: 8 points of R.8 were taken; .*{words}") as caught:
        function(X)
    assert caught[0].filename == __file__


@pytest.mark.parametrize("X", [
    np.eye(6), 3 * (1 - np.eye(6)), np.zeros((5, 5)), [[0, 1], [1, 0]], [[0, 1, 2], [1, 0, 1], [2, 1, 0]],
    SERIES[:8], SERIES[:8] - SERIES[:8].T, 1e-12 * SERIES[:8], np.triu(np.ones((5, 5))),
    2 * CORRELATIONS], ids=str)
def test_points_that_are_no_matrix(X):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ph.rips(X)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_correlations_given_as_distances(dtype):
    with pytest.raises(ph.DataError, match="as correlations are, .* 1 - X are distances"):
        ph.rips(CORRELATIONS.astype(dtype), metric="precomputed")
    missing = CORRELATIONS.copy()
    missing[2, 3] = np.nan
    with pytest.raises(ph.DataError, match="as correlations are"):
        ph.rips(missing, metric="precomputed")
    bars = ph.rips(1 - CORRELATIONS, metric="precomputed")
    assert len(bars.dgm(0)) == 8
    # What is asked for is done.
    births = ph.rips(np.ones((3, 3)), metric="precomputed", diagonal="births")
    assert births.dgm(0).tolist() == [[1, np.inf]]


def test_metrics_of_scipy():
    with pytest.raises(ph.UsageError, match="found 'correlation', .*; scipy.*pdist has more"):
        ph.rips(SERIES, metric="correlation")
