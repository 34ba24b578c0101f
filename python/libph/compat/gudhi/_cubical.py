# SPDX-License-Identifier: MIT
"""GUDHI's cubical complexes."""
from __future__ import annotations

import math
import os
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ... import _arrays, _core, _options
from ..._compute import cubical
from ..._errors import MissingInputError, UsageError
from ..._files import found_by, read
from ..._requests import cubical_request
from .._images import deciding_voxels
from ._persistence import Persistence, _OrderError

_DEFAULTS: dict[str, Any] = {**cubical.__kwdefaults__, "run": {}}  # the options of `cubical`


class _FileError(MissingInputError, RuntimeError):
    """GUDHI raises RuntimeError if a file cannot be read."""


@_options.with_hints
class CubicalComplex(Persistence):
    """The cubical complex of an image.

    Parameters
    ----------
    top_dimensional_cells : array_like, optional
        The values of the cubes of the highest dimension; a face has the smallest value of the cubes
        around it.
    vertices : array_like, optional
        The values of the vertices; a cube has the largest value of its vertices.
    dimensions : sequence of int, optional
        The extents, if the values are a flat array in Fortran order.
    perseus_file : path, optional
        A Perseus file with the values of cubes.
    """

    _every: NDArray[Any] | None = None  # the values of all cells, once they are needed

    def __init__(self, *, top_dimensional_cells: ArrayLike | None = None,
                 vertices: ArrayLike | None = None, dimensions: Sequence[int] | None = None,
                 perseus_file: str | os.PathLike[str] = "") -> None:
        if self._read(top_dimensional_cells, vertices, dimensions, perseus_file):
            raise UsageError("perseus_file: found periodic axes, expected a "
                             "PeriodicCubicalComplex for them")
        self._periodic: tuple[bool, ...] = (False,) * self._image.ndim

    def _read(self, cells: Any, vertices: Any, dimensions: Any, perseus_file: Any) -> list[bool]:
        """Stores the values, and the periodic axes if a file states any."""
        given = [name for name, value in (("top_dimensional_cells", cells), ("vertices", vertices),
                                          ("perseus_file", perseus_file or None))
                 if value is not None]
        if len(given) != 1 or (perseus_file and dimensions is not None):
            raise UsageError("found " + (", ".join(given) or "nothing") +
                             (" and dimensions" if dimensions is not None else "") +
                             ", expected one of top_dimensional_cells, vertices and perseus_file, "
                             "which has its dimensions")
        self._is_vertices = vertices is not None
        if perseus_file:
            try:
                found = found_by(**_options.arguments_of(read, perseus_file,
                                                         {"format": "perseus"}))
            except MissingInputError as error:
                raise _FileError(str(error)) from None
            self._image = np.asarray(found["image"])
            return list(found["periodic"])
        array = _arrays.as_image(vertices if self._is_vertices else cells, given[0])
        if dimensions is not None:
            extents = tuple(_options.whole("dimensions", n, 0) for n in dimensions)
            if array.ndim != 1 or int(np.prod(extents)) != array.size:
                raise UsageError(f"dimensions: found {extents} for an array of shape "
                                 f"{array.shape}, expected extents for a flat array")
            array = array.reshape(extents, order="F")
        self._image = array
        return []

    # ---- values

    def all_cells(self) -> NDArray[np.float64]:
        """The values of all cells."""
        if self._every is None:
            every = np.array(self._image, dtype=np.float64)
            for axis, periodic in enumerate(self._periodic):
                every = _with_cells_between(every, axis, periodic, self._is_vertices)
            self._every = every
        return self._every

    def top_dimensional_cells(self) -> NDArray[np.float64]:
        """The values of the cubes of the highest dimension: a view of `all_cells`."""
        return self.all_cells()[(slice(1, None, 2),) * self._image.ndim]

    def vertices(self) -> NDArray[np.float64]:
        """The values of the vertices: a view of `all_cells`."""
        return self.all_cells()[(slice(0, None, 2),) * self._image.ndim]

    def dimension(self) -> int:
        """The number of axes."""
        return self._image.ndim

    def num_simplices(self) -> int:
        """The number of cells of all dimensions."""
        return math.prod(2 * n if periodic else 2 * n + (-1 if self._is_vertices else 1)
                         for n, periodic in zip(self._image.shape, self._periodic))

    # ---- bars

    def compute_persistence(self, homology_coeff_field: int = 11, min_persistence: float = 0
                            ) -> None:
        """Computes the bars of all dimensions.

        Parameters
        ----------
        homology_coeff_field : int
            A prime.
        min_persistence : float
            Bars with death - birth <= this value are left out; a negative value keeps all bars.
        """
        request = cubical_request({
            **_DEFAULTS, "image": self._image, "periodic": self._periodic,
            "construction": "vertices" if self._is_vertices else "cells",
            "field": homology_coeff_field, "min_persistence": min_persistence})
        self._keep(request.run(_core.barcode), self._image.ndim + 1)

    def persistence(self, homology_coeff_field: int = 11, min_persistence: float = 0
                    ) -> list[tuple[int, tuple[float, float]]]:
        """Computes like `compute_persistence` and returns a list of (dimension, (birth, death)):
        the highest dimension first and, within a dimension, the longest bars first."""
        self.compute_persistence(homology_coeff_field, min_persistence)
        return self._listed()

    def cofaces_of_persistence_pairs(self) -> list[list[NDArray[np.int64]]]:
        """The cubes that determine the values of bars, as indices into the flat array in Fortran
        order.

        Returns
        -------
        list of two lists
            For each dimension, rows birth, death of the bars that die; for each dimension, births
            of the bars that never die. Dimensions above the last such bar have no entry.
        """
        return self._places("cofaces_of_persistence_pairs", False)

    def vertices_of_persistence_pairs(self) -> list[list[NDArray[np.int64]]]:
        """Like `cofaces_of_persistence_pairs`, for a complex made from values of vertices."""
        return self._places("vertices_of_persistence_pairs", True)

    def _places(self, asked: str, of_vertices: bool) -> list[list[NDArray[np.int64]]]:
        barcode = self._barcode(asked)
        if self._is_vertices != of_vertices:
            raise _OrderError(f"{asked}: found a complex made of "
                              f"{'vertices' if self._is_vertices else 'top-dimensional cells'}, "
                              "expected one made of "
                              f"{'vertices' if of_vertices else 'top-dimensional cells'}")
        finite, essential = [], []
        for dim in range(self._dims):
            order, dies = self._order(dim)
            born = self._flat(barcode.birth_cells(dim)[order])
            killed = self._flat(barcode.death_cells(dim)[order[dies]])
            finite.append(np.column_stack([born[dies], killed]))
            essential.append(born[~dies])
        return [_without_empty_end(finite), _without_empty_end(essential)]

    def _flat(self, cells: NDArray[np.int64]) -> NDArray[np.int64]:
        voxels = deciding_voxels(cells, self._image, self._is_vertices, self._periodic)
        if not len(voxels):
            return np.empty(0, dtype=np.int64)
        return np.asarray(np.ravel_multi_index(tuple(voxels.T), self._image.shape, order="F"))


@_options.with_hints
class PeriodicCubicalComplex(CubicalComplex):
    """The cubical complex of an image with some periodic axes.

    Parameters
    ----------
    dimensions, top_dimensional_cells, vertices
        As in `CubicalComplex`.
    periodic_dimensions : sequence of bool
        Which axes are periodic; not with a file.
    perseus_file : path, optional
        A Perseus file with the values of cubes. Axes with negative extents are periodic.
    """

    def __init__(self, dimensions: Sequence[int] | None = None,
                 top_dimensional_cells: ArrayLike | None = None,
                 vertices: ArrayLike | None = None,
                 periodic_dimensions: Sequence[bool] | None = None,
                 perseus_file: str | os.PathLike[str] = "") -> None:
        closed = self._read(top_dimensional_cells, vertices, dimensions, perseus_file)
        axes = self._image.ndim
        if perseus_file:
            if periodic_dimensions is not None:
                raise UsageError(f"periodic_dimensions: found {periodic_dimensions}, expected none "
                                 "with perseus_file, which marks periodic axes by extents below 0")
            periodic_dimensions = closed or [False] * axes
        if periodic_dimensions is None or len(periodic_dimensions) != axes:
            raise UsageError(f"periodic_dimensions: found {periodic_dimensions}, expected {axes} "
                             "bools")
        self._periodic = tuple(map(bool, periodic_dimensions))


def _with_cells_between(values: NDArray[np.float64], axis: int, periodic: bool, is_vertices: bool
                        ) -> NDArray[np.float64]:
    """Inserts, along one axis, the cells that lie between the given cells and at the ends."""
    a = np.moveaxis(values, axis, 0)
    following = np.roll(a, -1, axis=0)
    n = len(a)
    if is_vertices:
        every = np.empty((2 * n - (not periodic), *a.shape[1:]))
        every[0::2] = a
        every[1::2] = np.maximum(a, following)[:len(every) // 2]
    else:
        every = np.empty((2 * n + (not periodic), *a.shape[1:]))
        every[1::2] = a
        every[2::2] = np.minimum(a, following)[:(len(every) - 1) // 2]
        every[0] = np.minimum(a[-1], a[0]) if periodic else a[0]
        if not periodic:
            every[-1] = a[-1]
    return np.moveaxis(every, 0, axis)


def _without_empty_end(arrays: list[NDArray[np.int64]]) -> list[NDArray[np.int64]]:
    last = max((k for k, array in enumerate(arrays) if len(array)), default=-1)
    return arrays[:last + 1]
