# SPDX-License-Identifier: MIT
"""Computations are stopped, bounded, watched, and run in threads and processes."""
import concurrent.futures
import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import libph as ph
from libph import _core

SOON = 1.0  # seconds; 0.02 to 0.1 as a rule, but machines that run tests are busy


def normal(*shape):
    return np.random.default_rng(0).normal(size=shape)


def symmetric(n):
    d = np.abs(normal(n, n))
    d = np.maximum(d, d.T)
    np.fill_diagonal(d, 0)
    return d


def diagram(n):
    return np.sort(np.random.default_rng(n).random((n, 2)), axis=1)


VOLUME = np.random.default_rng(0).random((150, 150, 150))
# Each takes several seconds at least.
LONG = {
    "edge links": lambda **o: ph.rips(normal(6000, 5), max_dim=2, **o),
    "edge links, field 3": lambda **o: ph.rips(normal(6000, 5), max_dim=2, field=3, **o),
    "a matrix": lambda **o: ph.rips(symmetric(2500), metric="precomputed", max_dim=2, **o),
    "cohomology": lambda **o: ph.rips(normal(500, 5), max_dim=3, collapse=False, **o),
    "collapse": lambda **o: ph.rips(normal(3000, 5), max_dim=3, collapse=True, **o),
    "standard": lambda **o: ph.rips(normal(250, 3), engine="standard", **o),
    "twist": lambda **o: ph.rips(normal(400, 3), max_dim=2, engine="twist", collapse=False, **o),
    "union-find": lambda **o: ph.rips(normal(100_000, 40), max_dim=0, **o),
    "sparse filtration": lambda **o: ph.rips(normal(40_000, 3), approximation=0.2, **o),
    "cohomology of an image": lambda **o: ph.cubical(VOLUME[:90], engine="cohomology", **o),
    "twist of an image": lambda **o: ph.cubical(VOLUME[:90], engine="twist", **o),
    "standard of an image": lambda **o: ph.cubical(VOLUME[:50, :50, :50], engine="standard", **o),
    "gradient": lambda **o: ph.cubical(np.tile(VOLUME, (3, 1, 1)), threads=1, **o),
    "gradient of cells": lambda **o: ph.cubical(np.tile(VOLUME, (3, 1, 1)), construction="cells",
                                                threads=1, **o),
    "voxels": lambda **o: ph.cubical(np.tile(VOLUME, (2, 1, 1)), representatives="voxels", **o),
    "four axes": lambda **o: ph.cubical(np.random.default_rng(0).random((30, 30, 30, 30)), **o),
    "farthest points": lambda **o: ph.farthest_points(normal(100_000, 10), **o),
    "distance to a measure": lambda **o: ph.distance_to_measure(normal(100_000, 20), 50, **o),
    "a merge tree": lambda **o: ph.merge_tree(normal(100_000, 30), **o),
    "bottleneck": lambda **o: ph.bottleneck(diagram(200_000), diagram(200_001), **o),
    "collapsed edges": lambda **o: ph.collapse(symmetric(2500), **o),
}
one_of_the_long = pytest.mark.parametrize("name", LONG)


def interrupt_after(seconds):
    """Ctrl-C; tells when."""
    fired = []

    def fire():
        fired.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(seconds, fire)
    timer.start()
    return fired


@one_of_the_long
def test_ctrl_c(name):
    fired = interrupt_after(0.5)
    with pytest.raises(KeyboardInterrupt):
        LONG[name]()
        time.sleep(5)
    assert time.monotonic() - fired[0] < SOON


@one_of_the_long
def test_timeout(name):
    start = time.monotonic()
    with pytest.raises(ph.Timeout, match="0.4 s"):
        LONG[name](timeout=0.4)
    assert time.monotonic() - start < 0.4 + SOON + 1.5  # making the data counts, too


def test_ctrl_c_while_python_is_told_of_progress():
    def slow(stage, done, total):
        if not fired:
            fired.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)
        time.sleep(0.001)

    fired = []
    with pytest.raises(KeyboardInterrupt):
        LONG["edge links"](progress=slow)
    assert time.monotonic() - fired[0] < SOON


def test_a_handler_of_ones_own():
    class Alarm(Exception):
        pass

    def ring(signum, frame):
        raise Alarm("ring")

    before = signal.signal(signal.SIGALRM, ring)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(Alarm, match="ring"):
            LONG["edge links"]()
    finally:
        signal.signal(signal.SIGALRM, before)


def test_a_handler_that_goes_on():
    calls = []
    before = signal.signal(signal.SIGALRM, lambda *_: calls.append(1))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        bars = ph.rips(normal(1500, 5))
        time.sleep(0.05)
    finally:
        signal.signal(signal.SIGALRM, before)
    assert calls == [1] and len(bars.dgm(0)) == 1500


def test_stop():
    stop = threading.Event()
    threading.Timer(0.3, stop.set).start()
    start = time.monotonic()
    with pytest.raises(ph.Cancelled):
        LONG["edge links"](stop=stop)
    assert time.monotonic() - start < 0.3 + SOON


def test_ctrl_c_reaches_the_main_thread_only():
    """Others end by a stop of their own."""
    stop, outcome = threading.Event(), []

    def compute():
        try:
            LONG["edge links"](stop=stop)
        except BaseException as error:
            outcome.append(type(error))

    thread = threading.Thread(target=compute)
    thread.start()
    interrupt_after(0.2)
    with pytest.raises(KeyboardInterrupt):
        time.sleep(5)
    time.sleep(0.1)
    assert not outcome
    stop.set()
    thread.join()
    assert outcome == [ph.Cancelled]


# ---- progress


def test_progress_is_told():
    told = []
    ph.rips(normal(5000, 5), progress=lambda *news: told.append(news), threads=1)
    assert told
    for stage, done, total in told:
        assert isinstance(stage, str) and stage
        assert isinstance(done, int) and isinstance(total, int)
        assert total == 0 or done <= total


def test_what_a_callback_raises_stops():
    def fail(stage, done, total):
        raise LookupError("enough")

    start = time.monotonic()
    with pytest.raises(LookupError, match="enough"):
        LONG["edge links"](progress=fail)
    assert time.monotonic() - start < 0.2 + SOON


def test_progress_true_prints_nothing_without_tqdm(capfd, monkeypatch):
    monkeypatch.setitem(sys.modules, "tqdm", None)
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    ph.rips(normal(1000, 5), progress=True)
    assert capfd.readouterr() == ("", "")


def test_progress_true_is_a_bar_of_tqdm(monkeypatch):
    log = []

    class Bar:
        def __init__(self, desc, total, leave):
            self.n = 0
            log.append((desc, total))

        def update(self, steps):
            self.n += steps

        def close(self):
            log.append("closed")

    module = type(sys)("tqdm.auto")
    module.tqdm = Bar
    monkeypatch.setitem(sys.modules, "tqdm", type(sys)("tqdm"))
    monkeypatch.setitem(sys.modules, "tqdm.auto", module)
    ph.rips(normal(5000, 5), progress=True, threads=1)
    stages = [entry for entry in log if entry != "closed"]
    assert stages and log.count("closed") == len(stages)


# ---- memory


@pytest.mark.parametrize("compute", [
    lambda **o: ph.rips(normal(2000, 5), **o),
    lambda **o: ph.rips(symmetric(1500), metric="precomputed", max_dim=2, **o),
    lambda **o: ph.cubical(VOLUME, **o),
    lambda **o: ph.cubical(VOLUME[:40], engine="twist", **o),
    lambda **o: ph.cubical(VOLUME.T, **o),
    lambda **o: ph.collapse(symmetric(1500), **o),
    lambda **o: ph.merge_tree(VOLUME, **o),
    lambda **o: ph.point_image(normal(100, 3), 0.01, **o),
])
def test_memory_limit(compute):
    with pytest.raises(ph.MemoryLimitError, match="memory limit") as caught:
        compute(memory_limit="1MiB")
    assert isinstance(caught.value, MemoryError) and isinstance(caught.value, ph.Error)
    assert len(ph.rips([[0], [1]])) == 2  # the process lives


def test_a_limit_that_suffices_changes_nothing():
    points = normal(300, 3)
    assert ph.rips(points, memory_limit="1GiB") == ph.rips(points)


def test_memory_that_the_system_refuses():
    """Beyond what is counted: the kernel says no."""
    code = textwrap.dedent("""
        import resource, numpy as np, libph as ph
        points = np.random.default_rng(0).normal(size=(6000, 3))
        now = int(next(l for l in open("/proc/self/status") if l.startswith("VmSize")).split()[1])
        most = resource.RLIM_INFINITY
        resource.setrlimit(resource.RLIMIT_AS, (now * 1024 + (64 << 20), most))
        try:
            ph.rips(points)
        except ph.MemoryLimitError as error:
            print("refused")
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
    """)
    assert run_python(code).stdout == "refused\n"


def test_a_copy_beyond_the_memory_is_refused():
    """Four bytes that look like 16 TiB."""
    huge = np.broadcast_to(np.float32(0), (2**40, 2))
    with pytest.raises(ph.MemoryLimitError, match="X: found"):
        ph.rips(huge)
    with pytest.raises(ph.MemoryLimitError):
        ph.cubical(np.broadcast_to(np.int8(0), (2**20, 2**20)))


def test_the_default_is_what_the_machine_has_left():
    left = _core.memory_left()
    block = np.ones(100 << 17)  # 100 MiB
    taken = left - _core.memory_left()
    assert 80 << 20 < taken < 140 << 20, taken
    del block


# ---- limits


def test_limits_are_defaults():
    points = normal(2000, 5)
    with ph.limits(memory="1MiB"):
        with pytest.raises(ph.MemoryLimitError):
            ph.rips(points)
        ph.rips(points, memory_limit="4GiB")
        with ph.limits(threads=1, timeout=0.01):
            with pytest.raises((ph.MemoryLimitError, ph.Timeout)):
                ph.rips(points, max_dim=2)
        with ph.limits(memory="4GiB"):
            ph.rips(points)
    ph.rips(points)


def test_limits_are_of_one_thread():
    seen = []
    with ph.limits(memory=1000):
        thread = threading.Thread(target=lambda: seen.append(len(ph.rips(normal(100, 2), max_dim=0))))
        thread.start()
        thread.join()
    assert seen == [100]


# ---- threads and processes


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


def test_the_gil_is_released():
    """Python goes on while a computation runs."""
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


def run_python(code):
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, (done.returncode, done.stderr)
    return done


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
