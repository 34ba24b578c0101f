# SPDX-License-Identifier: MIT
"""Kernels for diagrams."""
from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core, _options, _run
from .._barcodes import Barcode
from .._distances import all_rows
from .._errors import UsageError
from ._functions import checked_power

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .._run import RunOptions

_KERNELS = ("scale_space", "weighted_gaussian")


def diagram_kernels(diagrams: Iterable[Barcode | ArrayLike],
                    others: Iterable[Barcode | ArrayLike] | None = None, dim: int | None = None, *,
                    kernel: str = "scale_space", sigma: float = 1.0, slope: float = 1.0,
                    power: float = 1.0, **run: Unpack[RunOptions]) -> NDArray[np.float64]:
    """The Gram matrix of a positive definite kernel for diagrams, computed on all cores.

    "scale_space" is the persistence scale-space kernel [Reininghaus et al. 2015]: the sum of
    ``exp(-|p - q|² / (8 sigma)) - exp(-|p - q'|² / (8 sigma))`` over the bars p of one diagram and
    q of the other, divided by 8 π sigma; q' is q with birth and death exchanged.

    "weighted_gaussian" is the linear version of the persistence weighted Gaussian kernel [Kusano et
    al. 2016]: the sum of ``w(p) w(q) exp(-|p - q|² / (2 sigma²))``, with w = arctan(slope ·
    length^power).

    All bars must be finite.

    Parameters
    ----------
    diagrams : sequence of Barcode or array_like
        Barcodes, or arrays of rows birth, death.
    others : sequence of Barcode or array_like, optional
        The columns of the matrix. Default: the diagrams themselves.
    dim : int, optional
        For barcodes: the dimension.
    kernel : {"scale_space", "weighted_gaussian"}
        The kernel to compute.
    sigma : float
        Width of the kernel: for "scale_space" in the squared unit of the values, for
        "weighted_gaussian" in the unit of the values.
    slope, power : float
        Parameters of "weighted_gaussian".
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    ndarray
        A matrix of shape (len(diagrams), len(others)); symmetric without `others`. ``SVC`` of
        scikit-learn accepts it with ``kernel="precomputed"``.

    Examples
    --------
    >>> ph.diagram_kernels([[[0, 1]], [[0, 2]], []], sigma=0.5).round(4)
    array([[0.0313, 0.0392, 0.    ],
           [0.0392, 0.0688, 0.    ],
           [0.    , 0.    , 0.    ]])
    """
    _run.check_names("diagram_kernels", run, diagram_kernels)
    choice = kernel_choice(kernel, sigma, slope, power)
    rows = all_rows("diagrams", diagrams, dim)
    columns = None if others is None else all_rows("others", others, dim)
    for name, dgms in (("diagrams", rows), ("others", columns or [])):
        for i, dgm in enumerate(dgms):
            endless = ~np.isfinite(dgm).all(axis=1)
            if endless.any():
                j = int(np.argmax(endless))
                raise UsageError(f"{name}[{i}]: row {j}: found birth {dgm[j, 0]} and death "
                                 f"{dgm[j, 1]}, expected finite numbers; "
                                 "dgm[np.isfinite(dgm).all(axis=1)] leaves out all other bars")
    return np.asarray(_run.run(_core.kernels, rows, columns, choice, options=dict(run)))


def kernel_choice(kernel: Any, sigma: Any, slope: Any, power: Any) -> _core.KernelChoice:
    """The kernel with this name."""
    _options.choice("kernel", kernel, _KERNELS)
    for name, value in (("slope", slope), ("power", power)):
        if value != 1 and kernel != "weighted_gaussian":
            raise UsageError(f"{name}: does nothing for kernel={kernel!r}, only for "
                             "'weighted_gaussian'")
    return _core.KernelChoice(kernel, _options.positive("sigma", sigma),
                              _options.positive("slope", slope), checked_power("power", power))
