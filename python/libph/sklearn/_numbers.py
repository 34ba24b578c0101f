# SPDX-License-Identifier: MIT
"""Diagrams as a few readable numbers."""
from __future__ import annotations

from typing import Any

from .. import _options
from .._vectors import Diagram
from .._vectors._functions import (NORMS, checked_entropy, entropy, longest, statistics,
                                   statistics_names)
from ._vectoriser import Vectoriser


class Statistics(Vectoriser):
    """38 numbers that describe each diagram, a good first choice [Ali et al. 2023].

    For births, deaths, midpoints and lengths: mean, standard deviation, median, interquartile
    range, range, and the 10th, 25th, 75th and 90th percentiles; then the number of bars and their
    entropy in nats. Bars of length 0 do not count. Without bars, all numbers are 0. The numbers
    have different units: scale them, for example with ``StandardScaler``, before you measure
    distances.

    Parameters
    ----------
    infinity : {"error", "drop"} or float
        What to do with a bar that never dies: "error" raises an error, "drop" leaves the bar out,
        and with a number the bar dies at this value.

    Examples
    --------
    >>> statistics = ph.sklearn.Statistics().fit([[[0, 1], [1, 4]]])
    >>> row, = statistics.transform([[[0, 1], [1, 4]]])
    >>> dict(zip(statistics.get_feature_names_out(), row.tolist()))["dgm0_length_mean"]
    2.0
    """

    def __init__(self, infinity: float | str = "error") -> None:
        self.infinity = infinity

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return statistics(dgm)

    def _endings(self) -> list[str]:
        return statistics_names()


class Entropy(Vectoriser):
    """The persistent entropy of each diagram [Chintakunta et al. 2015].

    Each bar has a share in the sum of the lengths; the result is the entropy of these shares.
    Without bars, it is 0.

    Parameters
    ----------
    infinity : {"error", "drop"} or float
        What to do with a bar that never dies: "error" raises an error, "drop" leaves the bar out,
        and with a number the bar dies at this value.
    unit : {"nats", "bits"}
        Natural logarithms, or logarithms to the base 2, as in giotto-tda.
    normalised : {None, "count", "total"}
        "count": divided by the largest possible value, the logarithm of the number of bars, as in
        persim. "total": divided by the logarithm of the sum of the lengths, as in giotto-tda; the
        result then depends on the unit of the values.

    Examples
    --------
    >>> ph.sklearn.Entropy().fit_transform([[[0, 1], [0, 1]], [[0, 5]]]).round(4)
    array([[0.6931],
           [0.    ]])
    """

    def __init__(self, infinity: float | str = "error", unit: str = "nats",
                 normalised: str | None = None) -> None:
        self.infinity = infinity
        self.unit = unit
        self.normalised = normalised

    def _check(self) -> None:
        checked_entropy(self.unit, self.normalised, NORMS)

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return entropy(dgm, self.unit, self.normalised)

    def _endings(self) -> list[str]:
        return ["entropy"]


class Lengths(Vectoriser):
    """The largest lengths of bars, descending, padded with 0.

    Parameters
    ----------
    count : int
        Number of lengths for each diagram.
    infinity : {"error", "drop"} or float
        What to do with a bar that never dies: "error" raises an error, "drop" leaves the bar out,
        and with a number the bar dies at this value.

    Examples
    --------
    >>> ph.sklearn.Lengths(count=2).fit_transform([[[0, 1], [1, 4]], [[0, 2]]])
    array([[3., 1.],
           [2., 0.]])
    """

    def __init__(self, count: int = 5, infinity: float | str = "error") -> None:
        self.count = count
        self.infinity = infinity

    def _fit_columns(self, columns: list[list[Diagram]]) -> None:
        self._count = _options.whole("count", self.count, 1, 2**30)

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return longest(dgm, self._count)

    def _endings(self) -> list[str]:
        return [f"length{i}" for i in range(self._count)]
