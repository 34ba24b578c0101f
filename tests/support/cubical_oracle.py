# SPDX-License-Identifier: MIT
"""Barcodes of small images by the definition: cubes in a dictionary, columns reduced over Z/2.

Knows nothing of files: a voxel is a number, or None where it is absent.
"""
import itertools
import math


def cubes_of(shape, voxels, cells, superlevel, periodic):
    """The cubes that enter, by doubled coordinates, each with its value.

    @param voxels by coordinates, None: absent. @param cells whether voxels are top cubes (T).
    """
    def voxel(at):
        value = voxels[at]
        if value is None:
            return math.inf
        return -value if superlevel else value

    def beside(x, axis):
        """The voxels along an axis that decide what lies at a doubled coordinate."""
        at_voxel = x % 2 == (1 if cells else 0)
        both = [x // 2] if at_voxel else [(x + 1) // 2 - 1, (x + 1) // 2]
        if axis in periodic:
            return [i % shape[axis] for i in both]
        return [i for i in both if 0 <= i < shape[axis]]

    lengths = [2 * n if k in periodic else 2 * n + (1 if cells else -1) for k, n in enumerate(shape)]
    found = {}
    for cube in itertools.product(*map(range, lengths)):
        around = itertools.product(*(beside(x, k) for k, x in enumerate(cube)))
        value = (min if cells else max)(map(voxel, around))
        if value < math.inf:
            found[cube] = value
    return found, lengths


def barcode(shape, voxels, cells=False, superlevel=False, periodic=()):
    """All bars of positive length as sorted triples (dim, birth, death)."""
    values, lengths = cubes_of(shape, voxels, cells, superlevel, periodic)
    dim = {cube: sum(x % 2 for x in cube) for cube in values}
    order = sorted(values, key=lambda cube: (values[cube], dim[cube], cube))
    place = {cube: i for i, cube in enumerate(order)}
    bars, columns, paired = [], {}, set()
    for i, cube in enumerate(order):
        column = set()
        for k, x in enumerate(cube):
            if x % 2:
                for y in (x - 1, (x + 1) % lengths[k]):
                    column ^= {place[cube[:k] + (y,) + cube[k + 1:]]}
        while column and max(column) in columns:
            column ^= columns[max(column)]
        if column:
            lowest = max(column)
            columns[lowest] = column
            paired |= {lowest, i}
            birth, death = values[order[lowest]], values[cube]
            if birth < death:
                bars.append((dim[cube] - 1, birth, death))
    bars += [(dim[c], values[c], math.inf) for i, c in enumerate(order) if i not in paired]
    return sorted((d, b + 0.0, e + 0.0) for d, b, e in bars)
