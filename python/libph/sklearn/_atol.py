# SPDX-License-Identifier: MIT
"""Vectors of diagrams from centres that are learned from a batch."""
from __future__ import annotations

from typing import Any

from .. import _options
from .._errors import DataError
from .._vectors import Diagram
from .._vectors._functions import atol, fit_atol
from ._vectoriser import Vectoriser


class Atol(Vectoriser):
    """Measures how much of a diagram is near each of some learned centres [Royer et al. 2021].

    The bars of all fitted samples are points (birth, death). k-means finds their centres; the width
    of a centre is half its distance to the nearest other centre. A feature is the sum of the
    `contrast` function over the bars of a diagram. The result depends neither on the order of
    samples and bars, nor on threads or the machine.

    Parameters
    ----------
    centres : int
        Number of centres for each diagram of a sample. The fitted bars must have at least this many
        different pairs of birth and death.
    contrast : {"laplace", "gauss"}
        exp(-distance / width), or exp(-distance² / width²), the default of GUDHI.
    seed : int
        Seed for the initial centres.
    infinity : {"error", "drop"} or float
        What to do with a bar that never dies: "error" raises an error, "drop" leaves the bar out,
        and with a number the bar dies at this value.

    Attributes
    ----------
    centres_ : list of ndarray
        For each diagram of a sample, the centres as rows birth, death, ascending.
    widths_ : list of ndarray
        The width of each centre.

    Examples
    --------
    >>> atol = ph.sklearn.Atol(centres=2).fit([[[0, 1], [0, 9]], [[0, 1]]])
    >>> atol.centres_, atol.widths_
    ([array([[0., 1.], [0., 9.]])], [array([4., 4.])])
    >>> atol.transform([[[0, 1]], [[0, 5]]]).round(3)
    array([[1.   , 0.135],
           [0.368, 0.368]])
    """

    def __init__(self, centres: int = 10, contrast: str = "laplace", seed: int = 0,
                 infinity: float | str = "error") -> None:
        self.centres = centres
        self.contrast = contrast
        self.seed = seed
        self.infinity = infinity

    def _check(self) -> None:
        _options.choice("contrast", self.contrast, ["laplace", "gauss"])

    def _fit_columns(self, columns: list[list[Diagram]]) -> None:
        count = _options.whole("centres", self.centres, 1, 2**31 - 1)
        seed = _options.whole("seed", self.seed, 0)
        fitted = []
        for name, dgms in zip(self._diagram_names, columns):
            try:
                fitted.append(fit_atol(dgms, count, seed))
            except DataError as error:
                raise DataError(f"{name}: {str(error).removeprefix(f'{error._place}: ')}") from None
        self.centres_ = [centres for centres, _ in fitted]
        self.widths_ = [widths for _, widths in fitted]
        self._count = count

    def _vector(self, dgm: Diagram, place: int) -> Any:
        return atol(dgm, self.centres_[place], self.widths_[place], self.contrast)

    def _endings(self) -> list[str]:
        return [f"atol{i}" for i in range(self._count)]
