# SPDX-License-Identifier: MIT
"""Tests libph.torch with torch's own finite-difference check of gradients, and with tensors of all
kinds."""
import os
import re
from pathlib import Path

import numpy as np
import pytest

import libph as ph

torch = pytest.importorskip("torch", reason="torch is missing: libph.torch is not tested")
import libph.torch  # noqa: E402


def finite(dgms):
    return [dgm[dgm[:, 1] < float("inf")] for dgm in dgms]


@pytest.mark.parametrize("how", [
    {}, {"max_dim": 2}, {"metric": "manhattan"}, {"weights": "dtm", "dtm_neighbors": 3},
    {"weights": "core", "core_neighbors": 2}], ids=str)
def test_gradcheck_of_points(how):
    X = torch.rand(16, 3, dtype=torch.float64, generator=torch.Generator().manual_seed(1),
                   requires_grad=True)
    assert torch.autograd.gradcheck(lambda x: finite(libph.torch.rips(x, **how)), X)


@pytest.mark.parametrize("how", [{}, {"construction": "cells"}, {"superlevel": True}], ids=str)
def test_gradcheck_of_images(how):
    image = torch.rand(5, 6, dtype=torch.float64, generator=torch.Generator().manual_seed(1),
                       requires_grad=True)
    assert torch.autograd.gradcheck(lambda x: finite(libph.torch.cubical(x, **how)), image)


def test_gradcheck_of_distances_and_vertices(rng):
    condensed = torch.tensor(rng.uniform(0.5, 1.0, 14 * 13 // 2), requires_grad=True)
    assert torch.autograd.gradcheck(
        lambda x: finite(libph.torch.rips(x, metric="precomputed")), condensed)
    values = torch.tensor(rng.random(12), requires_grad=True)
    edges = [[i, (i + 1) % 12] for i in range(12)]
    assert torch.autograd.gradcheck(lambda x: finite(libph.torch.lower_star(x, edges)), values)


def test_tensors(rng):
    X = rng.random((20, 2))
    expected = ph.rips(X).dgms()
    for kind in (torch.float64, torch.float32):
        dgms = libph.torch.rips(torch.tensor(X, dtype=kind, requires_grad=True))
        assert [d.dtype for d in dgms] == [kind] * 2 and all(d.requires_grad for d in dgms)
        assert all(np.allclose(d.detach().numpy(), e, rtol=1e-5) for d, e in zip(dgms, expected))
    for kind in (torch.float16, torch.bfloat16):
        half = torch.tensor(X, dtype=kind, requires_grad=True)
        libph.torch.rips(half)[1].sum().backward()
        assert half.grad.dtype == kind and half.grad.abs().sum() > 0
    assert not libph.torch.rips(torch.tensor(X))[0].requires_grad
    pixels = torch.arange(12).reshape(3, 4)
    assert libph.torch.cubical(pixels)[0].dtype == torch.float64
    weights = torch.tensor(0.2 * rng.random(20))
    leaf = torch.tensor(X, requires_grad=True)
    (libph.torch.rips(leaf, weights=weights)[1]).sum().backward()
    assert leaf.grad.abs().sum() > 0


def test_what_torch_cannot(rng):
    X = torch.tensor(rng.random((8, 2)), requires_grad=True)
    with pytest.raises(ph.UsageError, match="X: found ndarray, expected a tensor"):
        libph.torch.rips(X.detach().numpy())
    with pytest.raises(ph.UsageError, match="layout torch.sparse_coo, expected a dense one"):
        libph.torch.rips(X.detach().to_sparse())
    with pytest.raises(ph.UsageError, match="cells: found False"):
        libph.torch.rips(X, cells=False)
    with pytest.raises(ph.UsageError, match="weights: found a tensor that requires a gradient"):
        libph.torch.rips(X, weights=torch.ones(8, dtype=torch.float64, requires_grad=True))
    with pytest.raises(ph.UsageError, match="expected 0 for a bar that never dies"):
        libph.torch.rips(X)[0].sum().backward()
    (first,) = torch.autograd.grad(libph.torch.rips(X)[1].pow(2).sum(), X, create_graph=True)
    with pytest.raises(RuntimeError, match="once_differentiable"):
        first.sum().backward()


def test_code_of_the_page():
    """The code blocks of docs/how-to/gradients.md, without their prompts."""
    torch.manual_seed(0)
    source = Path(os.environ.get("PH_SOURCE_DIR", Path(__file__).parents[3]))
    page = (source / "docs/how-to/gradients.md").read_text()
    (code,) = (c for c in re.findall(r"```python\n(.*?)```", page, re.S) if ">>>" not in c)
    names = {}
    exec(code, names)
    length = (names["h1"][:, 1] - names["h1"][:, 0]).max()
    assert length > 0.3  # it was 0.1 at the start
