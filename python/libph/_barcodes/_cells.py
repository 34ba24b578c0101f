# SPDX-License-Identifier: MIT
"""The locations of holes: cells, chains and voxels of bars."""
from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .. import _core, _options
from .._errors import UsageError
from .._images import SpatialImage
from . import _places
from ._chains import Chain


@_options.with_hints
class Cells:
    """The methods of `Barcode` that locate its holes."""

    __slots__ = ()

    if TYPE_CHECKING:
        _bars: _core.Bars
        meta: Mapping[str, Any]
        @property
        def dims(self) -> NDArray[np.int64]: ...
        def __len__(self) -> int: ...
        def _range(self, dim: int) -> slice: ...
        def _place(self, i: Any) -> int: ...

    def birth_cells(self, dim: int) -> NDArray[np.int64]:
        """The birth cell of each bar of a dimension, one row per bar.

        A row lists the vertices, ascending; for a boundary matrix, it is the row number of the
        cell. For an image, it lists the doubled grid coordinates of the cell: the voxel (i, j) is
        (2 i, 2 j). With the construction "cells", the voxel is (2 i + 1, 2 j + 1).
        `gradients.deciders` returns the edge or the voxel that determines the value of the cell.

        >>> bars = ph.rips([[0, 0], [1, 0], [1, 1], [0, 1]])
        >>> bars.birth_cells(1), bars.death_cells(1)
        (array([[2, 3]]), array([[0, 2, 3]]))
        """
        return np.asarray(self._bars.birth_cells(self._dim_of_cells(dim)))

    def death_cells(self, dim: int) -> NDArray[np.int64]:
        """The death cell of each bar of a dimension; a row of -1 if the bar never dies."""
        return np.asarray(self._bars.death_cells(self._dim_of_cells(dim)))

    def birth_cell(self, i: int) -> NDArray[np.int64]:
        """The birth cell of bar i, as a row of `birth_cells`.

        >>> bars = ph.lower_star([0, 2, 1], [[0, 1], [1, 2]])
        >>> bars[1], bars.birth_cell(1), bars.death_cell(1)
        (Bar(dim=0, birth=1.0, death=2.0), array([2]), array([1, 2]))
        """
        place = self._place(i)
        dim = int(self.dims[place])
        return np.asarray(self.birth_cells(dim)[place - self._range(dim).start])

    def death_cell(self, i: int) -> NDArray[np.int64] | None:
        """The death cell of bar i; None if the bar never dies."""
        place = self._place(i)
        dim = int(self.dims[place])
        cell = self.death_cells(dim)[place - self._range(dim).start]
        return None if (cell == -1).all() else cell

    def _found_none(self, what: str, expected: str) -> UsageError:
        # Bars that were not computed here come from a table or from a JSON file.
        hint = "" if "complex" in self.meta else (
            "; if these bars were saved in another format, save them as .json, which keeps cells, "
            "chains and voxels")
        return UsageError(f"{what}: found none, expected a barcode {expected}{hint}")

    def _dim_of_cells(self, dim: int) -> int:
        if not self._bars.has_cells:
            raise self._found_none("cells", "computed with cells=True")
        return _options.whole("dim", dim, 0, 2**31 - 2)

    def representative(self, i: int) -> Chain:
        """The cycle or cocycle of bar i, as requested by `representatives`.

        Examples
        --------
        >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
        >>> bars = ph.rips(square, representatives="cycles")
        >>> bars.representative(bars.longest(1)).loop()
        array([0, 1, 2, 3])
        """
        if self._bars.representatives == "none" and len(self):
            raise self._found_none("representative",
                                   "computed with representatives='cycles' or 'cocycles'")
        return Chain(self._bars, self._place(i))

    def _require_voxels(self) -> tuple[int, ...]:
        shape = self.meta.get("shape")
        if self._bars.representatives != "voxels" or shape is None:
            raise self._found_none("voxels",
                                   "of an image computed with representatives='voxels'")
        return tuple(shape)

    def voxels(self, i: int) -> SpatialImage:
        """A mask of the image: the component or hollow of bar i.

        For bars of other dimensions, which have a cycle instead, the mask is empty. The mask has
        the `affine` of the barcode.
        """
        mask = np.zeros(self._require_voxels(), dtype=bool)
        mask.reshape(-1)[np.asarray(self._bars.voxels(self._place(i)))] = True
        return SpatialImage(mask, self.affine)

    def labels(self, dim: int) -> SpatialImage:
        """A label image: the voxels of bar i of a dimension have the label i + 1, all others 0.

        The sets of voxels of two bars are nested or disjoint. A voxel of several bars has the label
        of the smallest set. A component that never dies has all voxels connected with it;
        ``bars[bars.deaths < np.inf]`` leaves such bars out. The image has the `affine` of the
        barcode.

        Raises
        ------
        UsageError
            If the barcode was computed without ``representatives="voxels"``, or if the bars of the
            dimension have cycles instead of sets of voxels.

        Examples
        --------
        >>> bars = ph.cubical([0, 5, 1, 6, 2], representatives="voxels")
        >>> [tuple(bar) for bar in bars]
        [(0, 0.0, inf), (0, 1.0, 5.0), (0, 2.0, 6.0)]
        >>> bars.labels(0)
        SpatialImage([1, 1, 2, 1, 3], dtype=uint32)
        """
        labels = _places.label_image(self, _options.whole("dim", dim, 0))  # type: ignore[arg-type]
        return SpatialImage(labels, self.affine)

    @property
    def affine(self) -> NDArray[np.float64] | None:
        """The map from voxels to the space of the scan as a matrix (4, 4), or None.

        It maps (i, j, k, 1) to (x, y, z, 1), as in nibabel. The unit is the unit of the file, which
        usually is the millimetre.
        """
        rows = self.meta.get("affine")
        return None if rows is None else np.array([*rows, (0, 0, 0, 1)], dtype=np.float64)

    def birth_voxel(self, i: int) -> tuple[int, ...]:
        """The voxel whose value is the birth of bar i."""
        self._require_voxels()
        return tuple(np.asarray(self._bars.birth_voxel(self._place(i))).tolist())

    def death_voxel(self, i: int) -> tuple[int, ...] | None:
        """The voxel whose value is the death of bar i; None if the bar never dies."""
        self._require_voxels()
        return tuple(np.asarray(self._bars.death_voxel(self._place(i))).tolist()) or None
