#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the computation of distances between diagrams with Hera, called through GUDHI:
compare_distances.py [ROW…]

Needs libph and gudhi in the same Python. Measures only the computation, on one thread, in CPU
seconds: the least of three runs for libph, and a single run for Hera. The results must agree within
1e-9 or within the requested error. For a matrix, Hera computes some of the pairs, and its time is
extrapolated to all pairs. Prints a table in Markdown."""
import sys
import time

import gudhi.hera
import numpy as np

import libph as ph

PAIRS = 60  # number of pairs of a matrix that Hera computes


def uniform(count, seed):
    return np.sort(np.random.default_rng(seed).random((count, 2)), axis=1)


def near(count, seed):
    """Two diagrams; the second has the points of the first, each moved a little."""
    bars = uniform(count, seed)
    moved = bars + np.random.default_rng(seed + 1).uniform(-1e-3, 1e-3, bars.shape)
    return bars, np.sort(moved, axis=1)


def of_bytes(count, seed):
    """A diagram with whole numbers from 0 to 255, as for 8-bit images: many values are equal."""
    bars = np.sort(np.random.default_rng(seed).integers(0, 256, (count, 2)), axis=1).astype(float)
    return bars[bars[:, 0] < bars[:, 1]]


def short(count, seed):
    rng = np.random.default_rng(seed)
    births = rng.random(count)
    return np.column_stack([births, births + rng.exponential(0.01, count)])


def clouds():
    return [ph.alpha(np.random.default_rng(seed).random((400, 3))).dgm(1) for seed in range(100)]


TEN = 10_000
DATA = {"uniform": lambda: (uniform(TEN, 1), uniform(TEN, 2)), "near": lambda: near(TEN, 1),
        "8-bit": lambda: (of_bytes(TEN, 1), of_bytes(TEN, 2)),
        "short bars": lambda: (short(TEN, 1), short(TEN, 2))}


def seconds(function, repetitions=1):
    best, result = float("inf"), None
    for _ in range(repetitions):
        start = time.process_time()
        result = function()
        best = min(best, time.process_time() - start)
    return best, result


def row(name, ours, peers, error, times=1.0):
    our_time, our_value = seconds(ours, 3)
    peer_time, peer_value = seconds(peers)
    agrees = np.allclose(our_value, peer_value, rtol=max(2 * error, 1e-9), atol=0)
    note = "" if agrees else " (another result)"
    print(f"| {name} | {our_time:.3g} | {times * peer_time:.3g} | {times * peer_time / our_time:.0f}{note} |",
          flush=True)


def main():
    wanted = sys.argv[1:]
    rows = {}
    for kind in ("uniform", "near", "8-bit"):
        def bottleneck(kind=kind):
            a, b = DATA[kind]()
            row(f"bottleneck, {kind}", lambda: ph.bottleneck(a, b, threads=1),
                lambda: gudhi.hera.bottleneck_distance(a, b, 0.0), 0)
        rows[f"bottleneck, {kind}"] = bottleneck
    for kind in ("uniform", "short bars"):
        for order in (1, 2):
            for error in (0.01, 0):
                def wasserstein(kind=kind, order=order, error=error):
                    a, b = DATA[kind]()
                    row(f"W{order}, {kind}, {'within 1 %' if error else 'exact'}",
                        lambda: ph.wasserstein(a, b, order=order, relative_error=error, threads=1),
                        lambda: gudhi.hera.wasserstein_distance(a, b, order=order, delta=0.01), 0.01)
                rows[f"W{order}, {kind}, {error}"] = wasserstein

    def matrix():
        dgms = clouds()
        pairs = [(i, j) for i in range(100) for j in range(i)]
        some = [pairs[k] for k in np.random.default_rng(1).choice(len(pairs), PAIRS, replace=False)]

        def ours():
            distances = ph.diagram_distances(dgms, order=2, relative_error=0.01, threads=1)
            return [distances[pair] for pair in some]
        row(f"W2 of all pairs of 100 diagrams, {np.mean([len(d) for d in dgms]):.0f} bars each, within 1 %", ours,
            lambda: [gudhi.hera.wasserstein_distance(dgms[i], dgms[j], order=2, delta=0.01) for i, j in some],
            0.01, len(pairs) / PAIRS)
    rows["matrix"] = matrix
    print(f"libph {ph.__version__}, Hera in GUDHI {gudhi.__version__}; 10 000 bars each\n")
    print("| distance | libph s | Hera s | Hera / libph |\n|---|---|---|---|")
    for name, compute in rows.items():
        if not wanted or any(word in name for word in wanted):
            compute()


if __name__ == "__main__":
    main()
