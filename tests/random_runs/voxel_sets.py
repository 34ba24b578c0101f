# SPDX-License-Identifier: MIT
"""Checks that sets of voxels belong to their bars, by docs/reference/conventions.md: finds
components and voids by walking from voxel to voxel. Shares nothing with libph."""
import itertools
import math
from dataclasses import dataclass


class Unfit(Exception):
    """A set of voxels that does not belong to its bar; the message says why."""


@dataclass
class Picture:
    """A filtered image. `entry` is the value at which each voxel enters; math.inf if the voxel
    never enters."""
    shape: tuple
    entry: dict
    cells: bool  # true if voxels are top-dimensional cubes
    periodic: set
    threshold: float

    def enters(self, at):
        return self.entry[at] < math.inf and self.entry[at] <= self.threshold

    def neighbours(self, at, across_corners):
        for step in itertools.product((-1, 0, 1), repeat=len(self.shape)):
            if not any(step) or not across_corners and sum(map(abs, step)) > 1:
                continue
            to = [x + s for x, s in zip(at, step)]
            to = tuple(x % n if k in self.periodic else x for k, (x, n) in enumerate(zip(to, self.shape)))
            if to in self.entry:
                yield to

    def reached(self, starts, is_open, across_corners):
        left = list(starts)
        found = set(left)
        while left:
            for to in self.neighbours(left.pop(), across_corners):
                if to not in found and is_open(to):
                    found.add(to)
                    left.append(to)
        return found

    def component(self, birth_voxel, death):
        return self.reached([birth_voxel], lambda v: self.enters(v) and (self.entry[v] < death or death == math.inf),
                            across_corners=self.cells)

    def hollow(self, starts, birth):
        def is_open(voxel):
            return not self.enters(voxel) or self.entry[voxel] > birth
        return self.reached(filter(is_open, starts), is_open, across_corners=not self.cells)

    def open_hollows(self, voxels, birth):
        """The sets of voxels that may represent a void which is never filled: a set with a voxel
        that never enters or, if only one axis of several voxels is not periodic, everything
        towards one of the ends of this axis."""
        inside = self.hollow([min(voxels)], birth)
        if not all(map(self.enters, inside)):
            yield inside
        ends = [axis for axis in range(len(self.shape)) if axis not in self.periodic and self.shape[axis] > 1]
        if len(ends) == 1:
            for end in (0, self.shape[ends[0]] - 1):
                yield self.hollow([v for v in self.entry if v[ends[0]] == end], birth)

    def check(self, bar, birth_voxel, death_voxel, voxels):
        """@param bar (dim, birth, death). @param death_voxel None if the bar never dies."""
        dim, birth, death = bar
        if self.entry[birth_voxel] != birth or death_voxel and self.entry[death_voxel] != death:
            raise Unfit(f"{birth_voxel} and {death_voxel} have other values than the bar")
        if voxels is None:
            return
        if dim == 0:
            expected = [self.component(birth_voxel, death)]
        elif dim != sum(n > 1 for n in self.shape) - 1:
            raise Unfit("bars of this dimension have no set")
        elif death_voxel:
            expected = [self.hollow([death_voxel], birth)]
        else:
            expected = list(self.open_hollows(voxels, birth))
        if voxels not in expected:
            raise Unfit(f"found {sorted(voxels)}, expected {list(map(sorted, expected))}")
