# SPDX-License-Identifier: MIT
"""Tests the computation of many inputs in one call."""
import threading
import time

import numpy as np
import pytest

import libph as ph

sparse = pytest.importorskip("scipy.sparse")

RNG = np.random.default_rng(5)
CLOUDS = [np.round(RNG.random((n, 2)) * 8) / 8 for n in RNG.integers(0, 40, 60)]
CLOUDS[0] = np.empty((0, 2))
IMAGES = [RNG.integers(0, 9, (rows, 7)).astype(np.float32) for rows in RNG.integers(1, 9, 30)]
PATH = [[0], [1], [2], [0, 1], [1, 2]]
MESHES = [(RNG.random(3), PATH) for _ in range(9)]
LISTS = [(PATH, [0, 0, 0, *RNG.random(2)]) for _ in range(9)]
EDGE = sparse.csc_array(np.array([[0, 0, -1], [0, 0, 1], [0, 0, 0]]))
MATRICES = [(EDGE, [0, 0, 1]), (EDGE, [0, 0, 1], [0, 0, 2])]


@pytest.mark.parametrize("threads", [None, 1, 2, 5])
@pytest.mark.parametrize("function, inputs, options", [
    (ph.rips, CLOUDS, {}),
    (ph.rips, CLOUDS, {"max_dim": 2, "field": 3, "metric": "manhattan", "threshold": 0.5}),
    (ph.rips, CLOUDS[5:], {"representatives": "cycles", "min_persistence": 0.1}),
    (ph.cubical, IMAGES, {"superlevel": True, "cells": False}),
    (ph.lower_star, MESHES, {}),
    (ph.filtered, LISTS, {"field": 5}),
    (ph.boundary, MATRICES, {}),
])
def test_it_is_as_one_by_one(function, inputs, options, threads):
    single = [function(*x if isinstance(x, tuple) else (x,), **options) for x in inputs]
    together = ph.batch(function, inputs, threads=threads, **options)
    assert together == single
    assert [bars.meta for bars in together] == [bars.meta for bars in single]
    assert [repr(bars) for bars in together] == [repr(bars) for bars in single]
    if "representatives" in options:
        assert all(str(a.representative(i)) == str(b.representative(i))
                   for a, b in zip(together, single) for i in range(len(a)))


@pytest.mark.skipif(not ph._core.alpha_support(), reason="built without CGAL")
def test_alpha():
    assert ph.batch(ph.alpha, CLOUDS[1:], threads=2) == [ph.alpha(x) for x in CLOUDS[1:]]


def test_any_iterable():
    assert ph.batch(ph.rips, (x for x in CLOUDS[:3])) == ph.batch(ph.rips, CLOUDS[:3])
    assert ph.batch(ph.rips, np.zeros((4, 3, 2))) == [ph.rips(np.zeros((3, 2)))] * 4
    assert ph.batch(ph.cubical, []) == []


@pytest.mark.parametrize("inputs, options, error, words", [
    ([[[0.0]], [[np.nan]]], {}, ph.DataError,
     "input 1: point 0, coordinate 0: found nan, .*; nan='drop' leaves such points out"),
    ([[[0.0]], "cloud.csv"], {}, ph.UsageError, "input 1: X: found str"),
    ([[[0.0]]], {"field": 4}, ph.UsageError, "input 0: .*4"),
    ([[[0.0]]], {"max_dm": 4}, TypeError, "rips.* 'max_dm'; did you mean 'max_dim'"),
    ([[[0.0]]], {"thread": 4}, TypeError, "rips.* 'thread'; did you mean 'threads'"),
    ([RNG.random((3000, 3))], {"max_dim": 2, "memory_limit": "1MiB"}, ph.MemoryLimitError,
     "input 0: memory limit .*; what would fit: max_dim=0 .*; or a larger memory_limit$"),
])
def test_errors_name_the_input(inputs, options, error, words):
    with pytest.raises(error, match=words):
        ph.batch(ph.rips, inputs, **options)


def test_what_cannot_be_computed():
    with pytest.raises(ph.UsageError, match="function: found .*print.*, expected rips"):
        ph.batch(print, [1])
    with pytest.raises(ph.UsageError, match=r"input 0: found list, expected a tuple \(values, sim"):
        ph.batch(ph.lower_star, [[1.0, 2.0]])
    with pytest.raises(ph.DataError, match="input 0: image: row 0, column 1: found nan"):
        ph.batch(ph.cubical, [[[1, np.nan]]])


def test_progress_counts_inputs():
    told = []
    ph.batch(ph.rips, [RNG.random((400, 3)) for _ in range(60)], threads=1,
             progress=lambda *news: told.append(news))
    assert all(stage == "inputs" and 0 < done <= total == 60 for stage, done, total in told)
    assert told == sorted(told)


def test_it_stops():
    slow = [RNG.random((700, 3))] * 9
    options = {"max_dim": 4, "collapse": "off"}  # would take hours
    begin = time.monotonic()
    with pytest.raises(ph.Timeout, match="timeout"):
        ph.batch(ph.rips, slow, **options, timeout=0.3)
    stop = threading.Event()
    threading.Timer(0.3, stop.set).start()
    with pytest.raises(ph.Cancelled):
        ph.batch(ph.rips, slow, **options, stop=stop)
    with pytest.raises(ph.DataError, match="input 3"):
        ph.batch(ph.rips, [*slow[:3], [[np.inf]], *slow], **options, threads=4)
    assert time.monotonic() - begin < 60


def test_a_metric_of_the_callers_own():
    def apart(a, b):
        return abs(a - b)

    words = [[1, 5, 9], [2, 4], [7]] * 20
    assert ph.batch(ph.rips, words, metric=apart, threads=3) == \
        [ph.rips(x, metric=apart) for x in words]

    def broken(a, b):
        raise KeyError("broken")

    with pytest.raises(KeyError, match="broken"):
        ph.batch(ph.rips, words, metric=broken, threads=3)
