# SPDX-License-Identifier: MIT
"""Data for computations, and code for separate processes."""
import subprocess
import sys

import numpy as np


def normal(*shape):
    return np.random.default_rng(0).normal(size=shape)


def symmetric(n):
    d = np.abs(normal(n, n))
    d = np.maximum(d, d.T)
    np.fill_diagonal(d, 0)
    return d


VOLUME = np.random.default_rng(0).random((150, 150, 150))


def run_python(code):
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, (done.returncode, done.stderr)
    return done
