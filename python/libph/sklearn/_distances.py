# SPDX-License-Identifier: MIT
"""Distances and kernels for lists of diagrams; `libph` computes them."""
from __future__ import annotations

import math

import numpy as np
from joblib import effective_n_jobs
from numpy.typing import NDArray

from .. import _distances, _options
from .._errors import UsageError
from .._vectors import _kernels
from ._diagrams import Samples, without_component
from ._pairs import BesideFitted


class DiagramDistances(BesideFitted):
    """The distances between diagrams and the fitted diagrams.

    If a sample has several diagrams, a norm combines their distances into one number.

    Parameters
    ----------
    distance : {"wasserstein", "bottleneck", "sliced_wasserstein"}
        The distance to compute; see `libph.wasserstein`, `libph.bottleneck`,
        `libph.sliced_wasserstein`.
    order, ground : float
        For "wasserstein".
    relative_error : float
        For "wasserstein" and "bottleneck": the allowed relative error; results are never too small.
    directions : int
        For "sliced_wasserstein": number of lines.
    norm : float
        For samples with several diagrams: 1 adds their distances, 2 takes the root of the sum of
        squares, inf takes the largest.
    n_jobs : int, optional
        Number of threads, in the convention of scikit-learn. Default: one.

    Attributes
    ----------
    n_features_in_ : int
        Number of diagrams per sample.

    Examples
    --------
    >>> train, test = [[[0, 1]], [[0, 4]]], [[[0, 3]]]
    >>> ph.sklearn.DiagramDistances("bottleneck").fit(train).transform(test)
    array([[1.5, 1. ]])
    """

    def __init__(self, distance: str = "wasserstein", order: float = 1.0, ground: float = math.inf,
                 relative_error: float = 0.0, directions: int = 50, norm: float = 2.0,
                 n_jobs: int | None = None) -> None:
        self.distance = distance
        self.order = order
        self.ground = ground
        self.relative_error = relative_error
        self.directions = directions
        self.norm = norm
        self.n_jobs = n_jobs

    def _all(self, samples: Samples, others: Samples | None) -> NDArray[np.float64]:
        norm = _options.real("norm", self.norm, "a number, at least 1, or inf", 1)
        of_diagrams = [
            _distances.diagram_distances(
                [row[k] for row in samples.rows],
                None if others is None else [row[k] for row in others.rows],
                distance=self.distance, order=self.order, ground=self.ground,
                relative_error=self.relative_error, directions=self.directions,
                threads=effective_n_jobs(self.n_jobs))
            for k in range(self.n_features_in_)]
        return of_diagrams[0] if len(of_diagrams) == 1 else _joined(np.array(of_diagrams), norm)


class DiagramKernels(BesideFitted):
    """A positive definite kernel between diagrams and the fitted diagrams.

    If a sample has several diagrams, their kernels are added. ``SVC(kernel="precomputed")`` accepts
    the result.

    Parameters
    ----------
    kernel : {"scale_space", "weighted_gaussian"}
        The kernel to compute; see `libph.diagram_kernels`.
    sigma : float
        Width of the kernel: for "scale_space" in the squared unit of the values, for
        "weighted_gaussian" in the unit of the values.
    slope, power : float
        For "weighted_gaussian": the weight of a bar is arctan(slope · length^power).
    n_jobs : int, optional
        Number of threads, in the convention of scikit-learn. Default: one.

    Attributes
    ----------
    n_features_in_ : int
        Number of diagrams per sample.

    Examples
    --------
    >>> train, test = [[[0, 1]], [[0, 4]]], [[[0, 3]]]
    >>> ph.sklearn.DiagramKernels().fit(train).transform(test).round(4)
    array([[0.0127, 0.0334]])
    """

    def __init__(self, kernel: str = "scale_space", sigma: float = 1.0, slope: float = 1.0,
                 power: float = 1.0, n_jobs: int | None = None) -> None:
        self.kernel = kernel
        self.sigma = sigma
        self.slope = slope
        self.power = power
        self.n_jobs = n_jobs

    def _all(self, samples: Samples, others: Samples | None) -> NDArray[np.float64]:
        for what, given in (("sample", samples), ("fitted sample", others)):
            _require_deaths(given, what)
        of_diagrams = [
            _kernels.diagram_kernels(
                [row[k] for row in samples.rows],
                None if others is None else [row[k] for row in others.rows], kernel=self.kernel,
                sigma=self.sigma, slope=self.slope, power=self.power,
                threads=effective_n_jobs(self.n_jobs))
            for k in range(self.n_features_in_)]
        result: NDArray[np.float64] = np.sum(of_diagrams, axis=0)
        return result


def _require_deaths(samples: Samples | None, what: str) -> None:
    if samples is None:
        return
    for i, row in enumerate(samples.rows):
        for dgm, name in zip(row, samples.names):
            endless = np.flatnonzero(np.isinf(dgm[:, 1]))
            if len(endless):
                way = without_component(dgm) or (
                    "RipsPersistence(infinity='drop'), for example, leaves such bars out")
                raise UsageError(f"{what} {i}, {name}: row {endless[0]}: found a bar that never "
                                 f"dies; {way}")


def _joined(distances: NDArray[np.float64], norm: float) -> NDArray[np.float64]:
    """The norm along the first axis, without a power that overflows or vanishes."""
    largest = distances.max(axis=0)
    largest[(largest == 0) | (largest == math.inf)] = 1
    unit = np.ldexp(1.0, np.frexp(largest)[1] - 1)  # powers of 2 cause no rounding
    result: NDArray[np.float64] = np.linalg.norm(distances / unit, norm, axis=0) * unit
    return result
