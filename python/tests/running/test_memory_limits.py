# SPDX-License-Identifier: MIT
"""A memory limit holds: the memory of the process grows by at most the limit plus 32 MiB.

Each job runs in a process of its own, under one limit after the other. It succeeds or raises
MemoryLimitError. PH_TEST_SEEDS=2 in the environment runs all jobs.
"""
import os
import subprocess
import sys
import textwrap

import pytest

LIMITS = (40, 100, 250)  # MiB
BESIDE = 32  # MiB that small allocations may take in addition to the limit
SECONDS = 20  # a job that takes longer is stopped; its memory until then counts

SCRIPT = """
import ctypes, gc, sys
import numpy as np, libph as ph
try:
    import scipy.sparse as sparse
except ImportError:
    sparse = None
rng = np.random.default_rng(0)

def status(name):
    with open("/proc/self/status") as lines:
        return int(next(line for line in lines if line.startswith(name)).split()[1]) / 1024

def grid(n):
    corner = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    return np.concatenate([np.stack([corner, corner + 1, corner + n], 1),
                           np.stack([corner + 1, corner + n, corner + n + 1], 1)])

{data}
def compute(limit, timeout):
    return ({call})

try:
    compute(2**20, 20)  # loads what the call needs
except ph.Error:
    pass
for limit in {limits}:
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    with open("/proc/self/clear_refs", "w") as file:
        file.write("5")  # the peak is what there is now
    before, code = status("VmRSS"), status("RssFile")
    try:
        compute(limit * 2**20, {seconds})
        end = "done"
    except ph.MemoryLimitError:
        end = "limit"
    except ph.Timeout:
        end = "stopped"
    code = status("RssFile") - code  # code that ran for the first time
    print(limit, status("VmHWM") - before - code, end)
"""

# name: data, call; `limit` and `timeout` belong to the call
JOBS = {
    "lower_star": ("tri, v = grid(400), rng.random(160000)",
                   "ph.lower_star(v, tri, memory_limit=limit, timeout=timeout)"),
    "lower_star, cycles": ("tri, v = grid(250), rng.random(62500)",
                           "ph.lower_star(v, tri, representatives='cycles', memory_limit=limit, timeout=timeout)"),
    "lower_star, cohomology": ("tri, v = grid(300), rng.random(90000)",
                               "ph.lower_star(v, tri, engine='cohomology', memory_limit=limit, timeout=timeout)"),
    "lower_star of tuples": ("tri, v = [tuple(t) for t in grid(200).tolist()], rng.random(40000)",
                             "ph.lower_star(v, tri, memory_limit=limit, timeout=timeout)"),
    "delaunay-cech": ("X = rng.random((60000, 3))",
                      "ph.alpha(X, values='delaunay-cech', memory_limit=limit, timeout=timeout)"),
    "delaunay-rips": ("X = rng.random((40000, 3))",
                      "ph.alpha(X, values='delaunay-rips', memory_limit=limit, timeout=timeout)"),
    "delaunay-cech of a plane": ("X = rng.random((150000, 2))",
                                 "ph.alpha(X, values='delaunay-cech', memory_limit=limit, timeout=timeout)"),
    "alpha": ("X = rng.random((100000, 3))", "ph.alpha(X, memory_limit=limit, timeout=timeout)"),
    "alpha, cycles": ("X = rng.random((30000, 3))",
                      "ph.alpha(X, representatives='cycles', memory_limit=limit, timeout=timeout)"),
    "filtered": ("n = 400000; e = np.stack([np.arange(n - 1), np.arange(1, n)], 1); "
                 "s = [np.arange(n)[:, None], e]; w = [np.zeros(n), rng.random(n - 1)]",
                 "ph.filtered(s, w, memory_limit=limit, timeout=timeout)"),
    "filtered, graph": ("n = 100000; e = np.unique(np.sort(rng.integers(0, n, (600000, 2)), 1), axis=0); "
                        "e = e[e[:, 0] != e[:, 1]]; s = [np.arange(n)[:, None], e]; "
                        "w = [np.zeros(n), rng.random(len(e))]",
                        "ph.filtered(s, w, memory_limit=limit, timeout=timeout)"),
    "filtered, twist": ("n = 60000; e = np.unique(np.sort(rng.integers(0, n, (300000, 2)), 1), axis=0); "
                        "e = e[e[:, 0] != e[:, 1]]; s = [np.arange(n)[:, None], e]; "
                        "w = [np.zeros(n), rng.random(len(e))]",
                        "ph.filtered(s, w, engine='twist', memory_limit=limit, timeout=timeout)"),
    "boundary": ("n = 150000; i = np.arange(n - 1); rows = np.concatenate([i, i + 1]); "
                 "cols = np.concatenate([n + i, n + i]); "
                 "m = sparse.csc_matrix((np.ones(2 * n - 2, int), (rows, cols)), shape=(2 * n - 1, 2 * n - 1)); "
                 "dims = np.repeat([0, 1], [n, n - 1])",
                 "ph.boundary(m, dims, memory_limit=limit, timeout=timeout)"),
    "sparse distances": ("n, m = 100000, 3000000; i, j = rng.integers(0, n, m), rng.integers(0, n, m); "
                         "k = i < j; m = sparse.csr_matrix((rng.random(k.sum()), (i[k], j[k])), shape=(n, n)); "
                         "m = m.maximum(m.T).tocsr()",
                         "ph.rips(m, metric='precomputed', max_dim=0, memory_limit=limit, timeout=timeout)"),
    "sparse distances, H1": ("n, m = 50000, 400000; i, j = rng.integers(0, n, m), rng.integers(0, n, m); "
                             "k = i < j; m = sparse.coo_matrix((rng.random(k.sum()), (i[k], j[k])), shape=(n, n)); "
                             "m.sum_duplicates()",
                             "ph.rips(m, metric='precomputed', memory_limit=limit, timeout=timeout)"),
    "distances": ("X = rng.random((2500, 3)); D = np.sqrt(((X[:, None] - X)**2).sum(2))",
                  "ph.rips(D, metric='precomputed', memory_limit=limit, timeout=timeout)"),
    "rips": ("X = rng.random((3000, 3))",
             "ph.rips(X, memory_limit=limit, timeout=timeout)"),
    "rips, H2": ("X = rng.random((800, 3))",
                 "ph.rips(X, max_dim=2, memory_limit=limit, timeout=timeout)"),
    "rips, cycles": ("X = rng.random((2000, 3))",
                     "ph.rips(X, representatives='cycles', memory_limit=limit, timeout=timeout)"),
    "rips, cocycles": ("X = rng.random((1500, 3))",
                       "ph.rips(X, representatives='cocycles', memory_limit=limit, timeout=timeout)"),
    "rips, cohomology": ("X = rng.random((500, 3))",
                         "ph.rips(X, engine='cohomology', memory_limit=limit, timeout=timeout)"),
    "rips, standard": ("X = rng.random((300, 3))",
                       "ph.rips(X, engine='standard', memory_limit=limit, timeout=timeout)"),
    "rips, all bars": ("X = rng.random((1500, 3))",
                       "ph.rips(X, min_persistence=-1, memory_limit=limit, timeout=timeout)"),
    "sparse distances, converted": ("n, m = 60000, 1800000; i, j = rng.integers(0, n, m), rng.integers(0, n, m); "
                                    "k = i < j; m = sparse.csr_matrix((rng.random(k.sum()), (i[k], j[k])), shape=(n, n)); "
                                    "m = m.maximum(m.T).tocsr()",
                                    "ph.rips(m, metric='precomputed', memory_limit=limit, timeout=timeout)"),
    "rips of float32": ("X = rng.random((150000, 60), dtype=np.float32)",
                        "ph.rips(X, max_dim=0, memory_limit=limit, timeout=timeout)"),
    "cubical of int64": ("V = rng.integers(0, 255, (4000, 4000))",
                         "ph.cubical(V, max_dim=0, memory_limit=limit, timeout=timeout)"),
    "batch": ("V = [rng.random((48, 48, 48)) for _ in range(24)]",
              "ph.batch(ph.cubical, V, memory_limit=limit, timeout=timeout)"),
    "components": ("X = rng.random((400000, 3))",
                   "ph.rips(X, max_dim=0, memory_limit=limit, timeout=timeout)"),
    "cubical": ("V = rng.integers(0, 255, (80, 80, 80), dtype=np.uint8)",
                "ph.cubical(V, memory_limit=limit, timeout=timeout)"),
    "cubical, cohomology": ("V = rng.integers(0, 255, (50, 50, 50), dtype=np.uint8)",
                            "ph.cubical(V, engine='cohomology', memory_limit=limit, timeout=timeout)"),
    "cubical, voxels": ("V = rng.integers(0, 255, (80, 80, 80), dtype=np.uint8)",
                        "ph.cubical(V, max_dim=0, representatives='voxels', memory_limit=limit, timeout=timeout)"),
    "cubical, four axes": ("V = rng.random((20, 20, 20, 20))",
                           "ph.cubical(V, memory_limit=limit, timeout=timeout)"),
    "merge_tree": ("V = rng.random((1200, 1200))",
                   "ph.merge_tree(V, memory_limit=limit, timeout=timeout)"),
    "collapse": ("X = rng.random((1200, 3)); D = np.sqrt(((X[:, None] - X)**2).sum(2))",
                 "ph.collapse(D, memory_limit=limit, timeout=timeout)"),
}
IN_THE_SUITE = ("lower_star", "delaunay-cech", "filtered", "filtered, graph", "boundary",
                "sparse distances", "rips", "cubical", "cubical of int64", "batch")
ALL = float(os.environ.get("PH_TEST_SEEDS", "1")) > 1


@pytest.mark.parametrize("job", JOBS if ALL else IN_THE_SUITE)
def test_a_limit_holds(job):
    data, call = JOBS[job]
    if "sparse" in data:
        pytest.importorskip("scipy.sparse")
    script = SCRIPT.format(data=data, call=call, limits=LIMITS, seconds=SECONDS)
    run = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], capture_output=True,
                         text=True)
    if "NotBuiltIn" in run.stderr:
        pytest.skip("not built in")
    assert run.returncode == 0, run.stderr
    ends = set()
    for line in run.stdout.splitlines():
        limit, growth, end = line.split()
        ends.add(end)
        assert float(growth) <= int(limit) + BESIDE, run.stdout
    assert len(run.stdout.splitlines()) == len(LIMITS) and ends & {"done", "limit"}, run.stdout
