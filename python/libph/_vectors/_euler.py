# SPDX-License-Identifier: MIT
"""Euler characteristic curves, computed directly from images."""
from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from .. import _core, _options, _run
from .._requests import cubical_request
from ._ranges import checked_range
from ._steps import StepFunction

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .._run import RunOptions

# Arguments of cubical_request that an Euler curve lacks; no bar is computed.
_OF_BARS = {"max_dim": None, "min_dim": 0, "field": 2, "representatives": None, "loops": None,
            "min_persistence": 0.0, "cells": False, "engine": "auto"}


@overload
def euler_curve(image: Any, *, range: None = None, resolution: None = None,
                construction: str = "vertices", superlevel: bool = False, periodic: Any = (),
                threshold: float | None = None, nan: str = "error", **run: Unpack[RunOptions]
                ) -> StepFunction: ...
@overload
def euler_curve(image: Any, *, range: Iterable[float], resolution: int | None = None,
                construction: str = "vertices", superlevel: bool = False, periodic: Any = (),
                threshold: float | None = None, nan: str = "error", **run: Unpack[RunOptions]
                ) -> NDArray[np.float64]: ...


def euler_curve(image: Any, *, range: Iterable[float] | None = None,
                resolution: int | None = None, construction: str = "vertices",
                superlevel: bool = False, periodic: Any = (), threshold: float | None = None,
                nan: str = "error", **run: Unpack[RunOptions]
                ) -> StepFunction | NDArray[np.float64]:
    """The Euler characteristic curve of an image, without its bars.

    At t, it is the number of cells of even dimension that are present, minus the number of cells of
    odd dimension: in two dimensions, components minus holes; in three, components minus tunnels
    plus hollows. It equals `Barcode.euler_curve` of the result of `cubical`, and takes a few
    nanoseconds per voxel [Heiss, Wagner 2017].

    Parameters
    ----------
    image : array_like or PointImage
        As in `cubical`.
    range : pair of float, optional
        The ends of a grid. The curve is computed only at the values of the grid, which takes little
        memory for any image. Default: the exact curve, with all its steps.
    resolution : int, optional
        Number of values of the grid, including both ends of the range. Default: 100.
    construction, superlevel, periodic, threshold, nan
        As in `cubical`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    StepFunction or ndarray
        A StepFunction, or an array if there is a `range`.

    Examples
    --------
    >>> rings = [[1, 1, 1, 1, 1], [1, 5, 1, 7, 1], [1, 1, 1, 1, 1]]
    >>> curve = ph.euler_curve(rings)           # a component with two holes, with one, with none
    >>> curve.at, curve.value
    (array([1., 5., 7.]), array([-1,  0,  1]))
    >>> ph.euler_curve(rings, range=(0, 8), resolution=5)
    array([ 0., -1., -1.,  0.,  1.])
    """
    _run.check_names("euler_curve", run, euler_curve)
    request = cubical_request({**_OF_BARS, **locals()})._replace(task=None)
    if range is None:
        if resolution is not None:
            raise _options.refuse("resolution", resolution, "a range as well: without one there is no "
                                  "grid")
        return StepFunction._of(request.run(_core.curve_of_image))
    ends = checked_range("range", range)
    count = 100 if resolution is None else _options.whole("resolution", resolution, 1, 2**30)
    return np.asarray(request.run(
        lambda recipe, run: _core.values_of_image(recipe, ends, count, run)))
