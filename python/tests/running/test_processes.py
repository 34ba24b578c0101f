# SPDX-License-Identifier: MIT
"""Computations in threads and in processes, and computations that run while Python exits."""
import concurrent.futures
import copy
import multiprocessing
import os
import pickle
import textwrap
import threading
import time

import numpy as np
import pytest

import libph as ph
from libph import _core
from workloads import VOLUME, normal, run_python, symmetric


@pytest.mark.parametrize("compute", [
    lambda **o: ph.rips(normal(400, 4), max_dim=2, **o),
    lambda **o: ph.rips(symmetric(60), metric="precomputed", max_dim=3, field=3, **o),
    lambda **o: ph.cubical(VOLUME[:50], **o),
    lambda **o: ph.cubical(VOLUME[:30], construction="cells", superlevel=True, **o),
    lambda **o: ph.rips(normal(60, 3), max_dim=1, representatives="cycles", **o),
])
def test_threads_do_not_change_the_result(compute):
    one = compute(threads=1)
    for threads in (2, 5):
        other = compute(threads=threads)
        assert one == other
        for dim in range(int(one.dims.max()) + 1):
            assert np.array_equal(one.birth_cells(dim), other.birth_cells(dim))
            assert np.array_equal(one.death_cells(dim), other.death_cells(dim))


@pytest.mark.parametrize("kib", [64, 96, 128, 256])
def test_threads_with_small_stacks(kib):
    """Threads of Python may have a stack of 32 KiB. One that is too small is an error, because a
    computation would end the process."""
    before = threading.stack_size(kib * 1024)
    try:
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            for compute in (lambda: ph.rips(normal(1200, 3), threshold=0.3),
                            lambda: ph.rips([[0], [1]])):
                if kib >= 128:
                    assert len(pool.submit(compute).result()) > 0
                else:
                    with pytest.raises(ph.UsageError, match=f"found a thread with a stack of {kib} "
                                       "KiB, expected at least 128 KiB; threading.stack_size"):
                        pool.submit(compute).result()
    finally:
        threading.stack_size(before)


def test_the_gil_is_released():
    """Other Python threads continue while a computation runs."""
    ticks, stop = [], threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.monotonic()
    ph.rips(normal(2000, 5), threads=1)
    seconds = time.monotonic() - start
    stop.set()
    thread.join()
    assert len(ticks) > 50 * seconds


def test_calls_at_once():
    points = [normal(100 + i, 3) for i in range(24)]
    expected = [ph.rips(p) for p in points]
    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        assert list(pool.map(ph.rips, points)) == expected


def of_points(seed):
    return len(ph.rips(np.random.default_rng(seed).normal(size=(200, 3))).dgm(0))


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_processes(method):
    of_points(0)
    context = multiprocessing.get_context(method)
    with context.Pool(2) as pool:
        assert pool.map(of_points, range(4)) == [200] * 4


def test_fork_while_another_thread_computes():
    thread = threading.Thread(target=lambda: ph.rips(normal(2500, 5)))
    thread.start()
    time.sleep(0.1)
    pid = os.fork()
    if pid == 0:
        os._exit(0 if of_points(1) == 200 and _core.end_calls() is None else 1)
    assert os.waitpid(pid, 0)[1] == 0
    thread.join()


def test_joblib():
    joblib = pytest.importorskip("joblib")
    for backend in ("threading", "loky"):
        with joblib.Parallel(n_jobs=2, backend=backend) as parallel:
            assert parallel(joblib.delayed(of_points)(i) for i in range(4)) == [200] * 4


# ---- interpreter shutdown and start-up


def test_python_ends_while_a_daemon_thread_computes():
    code = textwrap.dedent("""
        import threading, time, numpy as np, libph as ph
        points = np.random.default_rng(0).normal(size=(3000, 5))

        def forever():
            try:
                ph.rips(points, max_dim=2)
            except ph.Cancelled:
                pass

        threading.Thread(target=forever, daemon=True).start()
        time.sleep(0.3)
        print("end")
    """)
    assert run_python(code).stdout == "end\n"


def test_a_computation_at_the_end_of_python():
    code = textwrap.dedent("""
        import atexit
        atexit.register(lambda: print(len(ph.rips([[0], [1], [3]]))))
        import libph as ph
    """)
    assert run_python(code).stdout == "3\n"


def test_import_needs_numpy_only():
    code = textwrap.dedent("""
        import sys
        import libph
        libph.rips([[0, 0], [1, 0]])
        others = {name.split(".")[0] for name in sys.modules}
        print(others & {"scipy", "sklearn", "pandas", "matplotlib", "tqdm", "pyarrow", "torch"})
    """)
    assert run_python(code).stdout == "set()\n"


@pytest.mark.parametrize("kind", ["cycles", "cocycles"])
def test_chains_are_pickled(rng, kind):
    for bars in (ph.rips(rng.random((20, 2)), representatives=kind),
                 ph.cubical(rng.random((6, 7)), representatives=kind)):
        for i in range(len(bars)):
            chain = bars.representative(i)
            for other in (pickle.loads(pickle.dumps(chain)), copy.deepcopy(chain)):
                assert np.array_equal(other.cells, chain.cells)
                assert np.array_equal(other.coefficients, chain.coefficients)
                if kind == "cycles":
                    assert other.tightness == chain.tightness
                    assert [loop.vertices.tolist() for loop in other.loops()] == [
                        loop.vertices.tolist() for loop in chain.loops()]
