# SPDX-License-Identifier: MIT
"""Puts things down where they rest without tipping over.

The world has z up, and the main support is the plane z = 0. Rays that are cast from above and from
below find the height at which solids touch. A thing rests if its centre lies within the convex hull
of the places at which it touches what is below it. All lengths are in metres."""

import dataclasses
import math

import numpy

from shapes import turned

CELL = 0.004  # metres: the width of a cell of the ray grid
TOUCH = 0.0015  # metres: solids that are nearer than this touch
SKY = 10.0  # metres; every solid is between -SKY and SKY


@dataclasses.dataclass
class Thing:
    """A role (see arrangements.ROLES) and the solids that the thing consists of."""

    role: str
    solids: tuple


@dataclasses.dataclass
class Scene:
    """Things and a camera: where the camera stands and what it looks at."""

    things: list = dataclasses.field(default_factory=list)
    eye: tuple = (0.0, -0.7, 0.7)
    target: tuple = (0.0, 0.0, 0.0)

    def add(self, role, *solids):
        self.things.append(Thing(role, solids))

    def solids(self):
        return [solid for thing in self.things for solid in thing.solids]


def grid_over(solids, margin=0.0):
    """The places (x, y) of a grid that covers the solids and a margin around them."""
    corners = numpy.concatenate([solid.corners() for solid in solids])[:, :2]
    low, high = corners.min(axis=0) - margin, corners.max(axis=0) + margin
    x, y = (numpy.arange(a, b + CELL, CELL) for a, b in zip(low, high))
    return numpy.array(numpy.meshgrid(x, y)).reshape(2, -1).T, (len(y), len(x))


def heights(solids, places, above):
    """The z of the solids at each place: the highest z if `above` is true, otherwise the lowest.
    It is -infinity, or infinity, where there is no solid."""
    sign = 1.0 if above else -1.0
    best = numpy.full(len(places), numpy.inf)
    low, high = places.min(axis=0), places.max(axis=0)
    origins = numpy.column_stack([places, numpy.full(len(places), sign * SKY)])
    directions = numpy.tile((0.0, 0.0, -sign), (len(places), 1))
    for solid in solids:
        corners = solid.corners()[:, :2]
        if (corners.max(axis=0) < low).any() or (corners.min(axis=0) > high).any():
            continue
        best = numpy.minimum(best, solid.hits(origins, directions)[0])
    return sign * (SKY - best)


def grown(mask, cells):
    """The mask and all places that are at most `cells` rows and columns away from it."""
    for axis in (0, 1):
        wide = mask.copy()
        for k in range(1, cells + 1):
            for shift in (-k, k):
                moved = numpy.roll(mask, shift, axis)
                edge = slice(0, shift) if shift > 0 else slice(shift, None)
                moved[(edge, slice(None)) if axis == 0 else (slice(None), edge)] = False
                wide |= moved
        mask = wide
    return mask


def moved(solids, shift=(0, 0, 0), turn=None):
    """The solids of a thing, turned about the origin and then moved."""
    return tuple(solid.placed(turn, shift) for solid in solids)


def footprint(solids):
    """The places (x, y) of the grid that lie below the solids, and the lowest z there."""
    places, _ = grid_over(solids)
    lower = heights(solids, places, above=False)
    there = numpy.isfinite(lower)
    return places[there], lower[there]


def hangs_over(above, below):
    """True if some part of the solids `above` has nothing of the solids `below` under it."""
    return not numpy.isfinite(heights(below, footprint(above)[0], above=True)).all()


def top_of(solids):
    return max(solid.corners()[:, 2].max() for solid in solids)


def rest(scene, solids, x, y):
    """The solids, moved to (x, y) and lowered until they rest on the scene; None if they tip
    over."""
    solids = moved(solids, (x, y, 0))
    places, lower = footprint(solids)
    gap = lower - heights(scene.solids(), places, above=True)
    if not numpy.isfinite(gap).any():
        return None
    drop = gap.min()
    contacts = places[gap - drop < TOUCH] - places.mean(axis=0)
    angles = numpy.linspace(0, 2 * math.pi, 16, endpoint=False)
    reach = (contacts @ numpy.array([numpy.cos(angles), numpy.sin(angles)])).max(axis=0)
    return moved(solids, (0, 0, -drop)) if (reach > 0).all() else None


def is_free(scene, solids, gap, floor=0.0):
    """True if nothing but the support at height `floor` is within `gap` of the solids, as seen from
    above."""
    places, shape = grid_over(solids, gap + CELL)
    mask = numpy.isfinite(heights(solids, places, above=False)).reshape(shape)
    near = grown(mask, max(1, round(gap / CELL))).ravel()
    return (heights(scene.solids(), places[near], above=True) < floor + 0.001).all()


def somewhere(random, make, area):
    """A thing that is turned about the z axis at random, and a random place in an area.

    @param make makes the solids of a thing from the generator. @param area x and y of the middle of
    the area, half its width and half its depth."""
    x, y, width, depth = area
    solids = moved(make(random), turn=turned("z", random.uniform(0, 2 * math.pi)))
    return solids, x + random.uniform(-width, width), y + random.uniform(-depth, depth)


def put(scene, random, make, area, gap, floor=0.0, tries=40):
    """Puts one thing on the support at height `floor`, more than `gap` away from all other things.

    Returns its solids, or None if no place was free. For `make` and `area`, see `somewhere`."""
    for _ in range(tries):
        solids, x, y = somewhere(random, make, area)
        placed = moved(solids, (x, y, floor))
        if is_free(scene, placed, gap, floor):
            scene.add("object", *placed)
            return placed
    return None


def drop(scene, random, area, make, tries=30):
    """Lowers things at random places in an area, within which they must stay. Adds the thing that
    comes to rest with the lowest top. For `make` and `area`, see `somewhere`."""
    best = None
    for _ in range(tries):
        solids, x, y = somewhere(random, make, area)
        corners = numpy.concatenate([solid.corners() for solid in moved(solids, (x, y, 0))])
        if (abs(corners[:, :2] - area[:2]) > numpy.array(area[2:]) - 0.003).any():
            continue
        placed = rest(scene, solids, x, y)
        if placed is not None and (best is None or top_of(placed) < top_of(best)):
            best = placed
    if best is not None:
        scene.add("object", *best)
