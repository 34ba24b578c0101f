# SPDX-License-Identifier: MIT
"""Memory limits, and default options that apply within a `with` block."""
import re
import textwrap
import threading

import numpy as np
import pytest

import libph as ph
from libph import _core
from workloads import VOLUME, normal, run_python, symmetric


@pytest.mark.parametrize("compute", [
    lambda **o: ph.rips(normal(2000, 5), **o),
    lambda **o: ph.rips(symmetric(1500), metric="precomputed", max_dim=2, **o),
    lambda **o: ph.cubical(VOLUME, **o),
    lambda **o: ph.cubical(VOLUME[:40], engine="twist", **o),
    lambda **o: ph.cubical(VOLUME.T, **o),
    lambda **o: ph.collapse(symmetric(1500), **o),
    lambda **o: ph.merge_tree(VOLUME, **o),
    lambda **o: ph.core_distances(normal(20000, 3), 4, **o),
    lambda **o: ph.cluster_tree(normal(20000, 3), 4, **o),
    lambda **o: ph.image_part(VOLUME, 0, 2, max_dim=0, **o),
    lambda **o: ph.point_image(normal(100, 3), 0.01, **o),
])
def test_memory_limit(compute):
    with pytest.raises(ph.MemoryLimitError, match="memory limit") as caught:
        compute(memory_limit="1MiB")
    assert isinstance(caught.value, MemoryError) and isinstance(caught.value, ph.Error)
    assert re.search("; .*(memory_limit|ph.estimate)", str(caught.value)), "a way out"
    assert len(ph.rips([[0], [1]])) == 2  # the process can still compute


def test_a_limit_that_suffices_changes_nothing():
    points = normal(300, 3)
    assert ph.rips(points, memory_limit="1GiB") == ph.rips(points)


def test_memory_that_the_system_refuses():
    """The counted memory is within its limit, but the kernel refuses to provide it."""
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
    """A broadcast array takes four bytes but looks like 8 TiB."""
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
