# SPDX-License-Identifier: MIT
"""Compares the kernels of pairs of diagrams with the definitions of these kernels."""
import math

import numpy as np
import pytest

import libph as ph


@pytest.fixture
def many(rng):
    return [np.column_stack([b, b + rng.random(n)]) for n in (7, 0, 12, 1) for b in [rng.random(n)]]


def plain_scale_space(a, b, sigma):
    total = 0.0
    for p in a:
        for q in b:
            total += math.exp(-((p[0] - q[0])**2 + (p[1] - q[1])**2) / (8 * sigma))
            total -= math.exp(-((p[0] - q[1])**2 + (p[1] - q[0])**2) / (8 * sigma))
    return total / (8 * math.pi * sigma)


def plain_weighted(a, b, sigma, slope, power):
    def weight(p):
        return math.atan(slope * (p[1] - p[0])**power)
    return sum(weight(p) * weight(q) * math.exp(-((p[0] - q[0])**2 + (p[1] - q[1])**2)
                                                / (2 * sigma**2)) for p in a for q in b)


@pytest.mark.parametrize("sigma", [0.01, 0.3, 5.0])
def test_scale_space(many, sigma):
    found = ph.diagram_kernels(many, sigma=sigma)
    expected = [[plain_scale_space(a, b, sigma) for b in many] for a in many]
    assert np.allclose(found, expected, rtol=1e-12, atol=1e-15) and np.array_equal(found, found.T)


@pytest.mark.parametrize("sigma, slope, power", [(0.3, 1.0, 1.0), (1.0, 2.5, 3.0), (0.05, 1.0, 0.0)])
def test_weighted_gaussian(many, sigma, slope, power):
    found = ph.diagram_kernels(many, kernel="weighted_gaussian", sigma=sigma, slope=slope, power=power)
    expected = [[plain_weighted(a, b, sigma, slope, power) for b in many] for a in many]
    assert np.allclose(found, expected, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("kernel", ["scale_space", "weighted_gaussian"])
def test_matrices(many, kernel):
    whole = ph.diagram_kernels(many, kernel=kernel, sigma=0.2, threads=1)
    assert np.array_equal(ph.diagram_kernels(many, kernel=kernel, sigma=0.2, threads=3), whole)
    part = ph.diagram_kernels(many[:2], many, kernel=kernel, sigma=0.2)
    assert np.allclose(part, whole[:2], rtol=1e-13) and part.shape == (2, 4)
    assert np.linalg.eigvalsh(whole).min() > -1e-12 * whole.max()
    assert ph.diagram_kernels([]).shape == (0, 0) and ph.diagram_kernels([], many).shape == (0, 4)


def test_of_barcodes(rng):
    bars = [ph.rips(rng.random((15, 2))) for _ in range(3)]
    expected = ph.diagram_kernels([one.dgm(1) for one in bars])
    assert np.array_equal(ph.diagram_kernels(bars, dim=1), expected)
    with pytest.raises(ph.UsageError, match=r"diagrams\[0\]: row 14: found birth 0.0 and death inf"):
        ph.diagram_kernels(bars, dim=0)
    with pytest.raises(ph.UsageError, match="dim: found None"):
        ph.diagram_kernels(bars)


@pytest.mark.parametrize("how, words", [
    ({"kernel": "pssk"}, "kernel: found 'pssk'"), ({"sigma": 0}, "sigma"), ({"sigma": np.inf}, "sigma"),
    ({"slope": 2}, "slope: does nothing for kernel='scale_space'"), ({"power": 0}, "power: does no"),
    ({"kernel": "weighted_gaussian", "slope": -1}, "slope: found -1"),
    ({"kernel": "weighted_gaussian", "power": np.inf}, "power: found inf")])
def test_options(many, how, words):
    with pytest.raises(ph.UsageError, match=words):
        ph.diagram_kernels(many, **how)


def test_what_is_no_diagram():
    with pytest.raises(ph.UsageError, match=r"diagrams\[1\]: found an array of shape \(3,\)"):
        ph.diagram_kernels([[[0, 1]], [1.0, 2.0, 3.0]])
    with pytest.raises(ph.DataError, match="birth <= death"):
        ph.diagram_kernels([[[1, 0]]])
    with pytest.raises(TypeError, match="unexpected keyword argument 'bandwidth'.*'sigma'"):
        ph.diagram_kernels([[[0, 1]]], bandwidth=1)


def test_a_classifier_by_kernels(rng):
    pytest.importorskip("sklearn", reason="scikit-learn is missing, which has classifiers")
    from sklearn.pipeline import make_pipeline
    from sklearn.svm import SVC

    from libph.sklearn import DiagramKernels
    labels = np.arange(40) % 2
    dgms = [[np.column_stack([b := rng.random(9), b + 0.2 * rng.random(9)]),
             np.array([[0.0, 0.3 + 0.5 * label + 0.1 * rng.random()]])] for label in labels]
    kernels = DiagramKernels(sigma=0.02).fit(dgms[:5])
    assert np.allclose(kernels.transform(dgms[5:7]), sum(
        ph.diagram_kernels([row[k] for row in dgms[5:7]], [row[k] for row in dgms[:5]], sigma=0.02)
        for k in (0, 1)), rtol=1e-13)
    assert kernels.get_feature_names_out().tolist() == [f"sample{i}" for i in range(5)]
    steps = make_pipeline(DiagramKernels(sigma=0.02, n_jobs=2), SVC(kernel="precomputed"))
    assert steps.fit(dgms[:20], labels[:20]).score(dgms[20:], labels[20:]) == 1
