# SPDX-License-Identifier: MIT
"""Barcodes as differentiable functions of torch tensors.

A step that makes the longest bar of H1 longer::

    X = torch.rand(100, 2, requires_grad=True)
    h1 = libph.torch.rips(X)[1]
    (h1[:, 1] - h1[:, 0]).max().backward()
    X.data += 0.1 * X.grad

The gradients are the same as in `libph.gradients`, also at ties. They are exact for tensors of type
float64; for float32 they are rounded. The computation runs on the CPU, wherever the tensor is.
There are no second derivatives.
"""
from __future__ import annotations

from typing import Any

import numpy as np
import torch
from torch.autograd.function import once_differentiable

from .. import _compute
from .._barcodes import Barcode
from .._errors import UsageError
from ..gradients import pullback

__all__ = ["cubical", "lower_star", "rips"]


class _Values(torch.autograd.Function):
    """The rows birth, death of all bars, as a function of the data."""

    @staticmethod
    def forward(ctx: Any, X: Any, bars: Barcode, weights: Any) -> Any:
        ctx.bars, ctx.weights = bars, weights
        ctx.save_for_backward(X)
        rows = np.column_stack([bars.births, bars.deaths])
        return torch.as_tensor(rows, dtype=_floating(X), device=X.device)

    @staticmethod
    @once_differentiable
    def backward(ctx: Any, d_rows: Any) -> Any:
        (X,) = ctx.saved_tensors
        d = d_rows.detach().cpu().double().numpy()
        gradient = pullback(ctx.bars, _array(X), d[:, 0], d[:, 1], weights=ctx.weights)
        return torch.as_tensor(gradient, dtype=X.dtype, device=X.device), None, None


def _array(X: Any) -> Any:
    """The same numbers in a type that NumPy knows, because NumPy lacks bfloat16."""
    tensor = X.detach().cpu()
    return (tensor.double() if tensor.dtype == torch.bfloat16 else tensor).numpy()


def _floating(X: Any) -> Any:
    return X.dtype if X.dtype.is_floating_point else torch.float64


def _diagrams(X: Any, function: Any, arguments: tuple[Any, ...], options: dict[str, Any]
              ) -> list[Any]:
    if not isinstance(X, torch.Tensor):
        raise UsageError(f"X: found {type(X).__name__}, expected a torch tensor")
    if X.layout != torch.strided:
        raise UsageError(f"X: found a tensor of the layout {X.layout}, expected a dense one")
    if options.get("cells") is False:
        raise UsageError("cells: found False, but gradients need cells")
    weights = options.get("weights")
    if isinstance(weights, torch.Tensor):
        if weights.requires_grad:
            raise UsageError("weights: found a tensor that requires a gradient, expected constants")
        weights = options["weights"] = _array(weights)
    bars = function(_array(X), *arguments, **options)
    rows = _Values.apply(X, bars, None if isinstance(weights, str) else weights)
    return [rows[bars._range(dim)] for dim in range(bars._top_dim + 1)]


def rips(X: Any, **options: Any) -> list[Any]:
    """The diagrams of points or distances, as functions of the data.

    Parameters
    ----------
    X : torch.Tensor
        Points, one per row; with ``metric="precomputed"``, a square or condensed matrix of
        distances.
    **options
        As in `libph.rips`.

    Returns
    -------
    list of torch.Tensor
        For each dimension, rows birth, death.
    """
    return _diagrams(X, _compute.rips, (), options)


def cubical(image: Any, **options: Any) -> list[Any]:
    """The diagrams of an image, as functions of its pixels.

    Parameters
    ----------
    image : torch.Tensor
        Values of pixels or voxels.
    **options
        As in `libph.cubical`.

    Returns
    -------
    list of torch.Tensor
        For each dimension, rows birth, death.
    """
    return _diagrams(image, _compute.cubical, (), options)


def lower_star(values: Any, simplices: Any, **options: Any) -> list[Any]:
    """The diagrams of a function on the vertices of a mesh or graph, as functions of its values.

    Parameters
    ----------
    values : torch.Tensor
        A value for each vertex.
    simplices
        As in `libph.lower_star`.
    **options
        As in `libph.lower_star`.

    Returns
    -------
    list of torch.Tensor
        For each dimension, rows birth, death.
    """
    return _diagrams(values, _compute.lower_star, (simplices,), options)
