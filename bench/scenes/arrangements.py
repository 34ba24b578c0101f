# SPDX-License-Identifier: MIT
"""Arrangements of things, one function per kind of scene, all from a random generator.

The world has z up, and the main support is the plane z = 0. A thing is put down where it rests
without tipping over: its centre lies within the convex hull of the places at which it touches
what is below it."""
import colorsys
import dataclasses
import math

import numpy

import shapes
from shapes import Box, Print, turned

ROLES = ("object", "support", "wall", "floor", "shelf", "bin", "ceiling")
CELL = 0.004  # metres: of the grid on which things are put down
TOUCH = 0.0015  # metres: what is nearer touches


@dataclasses.dataclass
class Thing:
    role: str
    solids: tuple


@dataclasses.dataclass
class Scene:
    """Things and a camera: where it stands and what it looks at."""

    kind: str
    things: list = dataclasses.field(default_factory=list)
    eye: tuple = (0.0, -0.7, 0.7)
    target: tuple = (0.0, 0.0, 0.0)
    lid: float = 10.0  # what lies higher does not hinder things that are put down

    def add(self, role, *solids):
        self.things.append(Thing(role, solids))

    def solids(self):
        return [solid for thing in self.things for solid in thing.solids]


# --- Putting things down --------------------------------------------------------------------------


def grid_over(solids, margin=0.0):
    """The places (x, y) of a grid that covers the solids and a margin around them."""
    corners = numpy.concatenate([solid.corners() for solid in solids])[:, :2]
    low, high = corners.min(axis=0) - margin, corners.max(axis=0) + margin
    x, y = (numpy.arange(a, b + CELL, CELL) for a, b in zip(low, high))
    return numpy.array(numpy.meshgrid(x, y)).reshape(2, -1).T, (len(y), len(x))


def heights(solids, places, above, lid=10.0):
    """The highest z of the solids below the lid at each place, or the lowest z; ±infinity where
    there is none."""
    sign = 1.0 if above else -1.0
    best = numpy.full(len(places), numpy.inf)
    low, high = places.min(axis=0), places.max(axis=0)
    origins = numpy.column_stack([places, numpy.full(len(places), sign * lid)])
    directions = numpy.tile((0.0, 0.0, -sign), (len(places), 1))
    for solid in solids:
        corners = solid.corners()[:, :2]
        if (corners.max(axis=0) < low).any() or (corners.min(axis=0) > high).any():
            continue
        best = numpy.minimum(best, solid.hits(origins, directions)[0])
    return sign * (lid - best)


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
    return tuple(solid.placed(turn, shift) for solid in solids)


def rest(scene, solids, x, y, tilt=TOUCH):
    """The solids, moved to (x, y) and let down until they rest on the scene; None if they tip."""
    solids = moved(solids, (x, y, 0))
    places, _ = grid_over(solids)
    lower = heights(solids, places, above=False)
    there = numpy.isfinite(lower)
    places, lower = places[there], lower[there]
    gap = lower - heights(scene.solids(), places, True, scene.lid)
    if not numpy.isfinite(gap).any():
        return None
    drop = gap.min()
    contacts = places[gap - drop < tilt] - places.mean(axis=0)
    angles = numpy.linspace(0, 2 * math.pi, 16, endpoint=False)
    reach = (contacts @ numpy.array([numpy.cos(angles), numpy.sin(angles)])).max(axis=0)
    return moved(solids, (0, 0, -drop)) if (reach > 0).all() else None


def is_free(scene, solids, gap, floor=0.0):
    """True if nothing but the support at height `floor` is within `gap` of the solids, as seen from
    above."""
    places, shape = grid_over(solids, gap + CELL)
    mask = numpy.isfinite(heights(solids, places, above=False)).reshape(shape)
    near = grown(mask, max(1, round(gap / CELL))).ravel()
    return (heights(scene.solids(), places[near], True, scene.lid) < floor + 0.001).all()


def put(scene, random, make, area, gap, floor=0.0, tries=40):
    """Puts one thing on the support, apart from all others by the gap; False if no place is free.

    @param area (x, y, half the width, half the depth) of the places of its middle."""
    for _ in range(tries):
        solids = moved(make(random), turn=turned("z", random.uniform(0, 2 * math.pi)))
        x = area[0] + random.uniform(-area[2], area[2])
        y = area[1] + random.uniform(-area[3], area[3])
        placed = moved(solids, (x, y, floor))
        if is_free(scene, placed, gap, floor):
            scene.add("object", *placed)
            return placed
    return None


# --- Single things --------------------------------------------------------------------------------


def colour_of(random):
    h, s, v = random.uniform(0, 1), random.uniform(0.1, 0.9), random.uniform(0.25, 0.95)
    return tuple(255 * c for c in colorsys.hsv_to_rgb(h, s, v))


def look_of(random):
    """A colour and, every other time, a printed pattern."""
    look = {"colour": colour_of(random)}
    if random.uniform() < 0.5:
        along = ((1, 0, 0), (0, 1, 0), (0, 0, 1))[random.integers(3)]
        look["print_"] = Print(
            colour_of(random), along, random.uniform(0.03, 0.15), random.uniform(-0.3, 0.7)
        )
    return look


def box(random, low=0.05, high=0.18):
    return (Box(size=tuple(random.uniform(low, high, 3)), **look_of(random)),)


def can(random, scale=1.0):
    radius = scale * random.uniform(0.025, 0.055)
    return (shapes.cylinder(radius, scale * random.uniform(0.07, 0.18), **look_of(random)),)


def lying_can(random):
    (solid,) = can(random)
    radius = solid.profile[1][0]
    length = solid.profile[2][1]
    return moved((solid,), (-length / 2, 0, radius), turned("y", math.pi / 2))


def rod(random):
    radius, length = random.uniform(0.009, 0.02), random.uniform(0.15, 0.35)
    solid = shapes.cylinder(radius, length, **look_of(random))
    return moved((solid,), (-length / 2, 0, radius), turned("y", math.pi / 2))


def book(random):
    size = random.uniform(0.15, 0.26), random.uniform(0.1, 0.19), random.uniform(0.012, 0.05)
    return (Box(size=size, **look_of(random)),)


def bowl(random):
    radius = random.uniform(0.055, 0.1)
    return (
        shapes.bowl(radius, radius * random.uniform(0.5, 0.9), 0.004, colour=colour_of(random)),
    )


def mug(random):
    radius, height = random.uniform(0.035, 0.05), random.uniform(0.08, 0.12)
    look = {"colour": colour_of(random)}
    return (shapes.cup(radius, height, 0.004, **look), *shapes.handle(radius, height, **look))


def ball(random):
    return (shapes.ball(random.uniform(0.025, 0.07), **look_of(random)),)


def any_thing(random):
    makers = (box, box, box, can, can, lying_can, book, bowl, mug, ball, rod)
    return makers[random.integers(len(makers))](random)


def top_of(solids):
    return max(solid.corners()[:, 2].max() for solid in solids)


# --- Surroundings ---------------------------------------------------------------------------------


def slab(colour, size, middle):
    """A box whose upper face has its middle at a place."""
    x, y, z = middle
    return Box(size=size, colour=colour).placed(shift=(x, y, z - size[2]))


def grey(random):
    return (random.uniform(90, 220),) * 3


def add_table(scene, random):
    """A large table, or one that ends in the picture with the floor behind it."""
    if random.uniform() < 0.7:
        scene.add("support", slab(grey(random), (6, 6, 0.03), (0, 0, 0)))
        return
    size = random.uniform(1.0, 1.6), random.uniform(0.8, 1.1), random.uniform(0.02, 0.04)
    scene.add("support", slab(grey(random), size, (0, 0, 0)))
    scene.add("floor", slab(grey(random), (12, 12, 0.1), (0, 0, -random.uniform(0.6, 0.8))))


def look_down(scene, random, nearest=0.65, farthest=1.3, steepest=65):
    """The camera looks at the middle from one side, from above."""
    distance = random.uniform(nearest, farthest)
    slope, around = math.radians(random.uniform(30, steepest)), random.uniform(0, 2 * math.pi)
    flat = distance * math.cos(slope)
    scene.eye = (flat * math.cos(around), flat * math.sin(around), distance * math.sin(slope))
    scene.target = (*random.uniform(-0.03, 0.03, 2), 0.03)


# --- Kinds ----------------------------------------------------------------------------------------


def table(random):
    """Single things, at least 3 cm apart."""
    scene = Scene("table")
    add_table(scene, random)
    for _ in range(random.integers(4, 9)):
        put(scene, random, any_thing, (0, 0, 0.28, 0.22), 0.03)
    look_down(scene, random)
    return scene


def pile(scene, random, overhang):
    """One thing on another; what is above lies within what is below, or hangs over its sides."""
    below = put(scene, random, box if random.uniform() < 0.8 else book, (0, 0, 0.25, 0.2), 0.02)
    if below is None:
        return
    corners = below[0].corners()[:, :2]
    middle = corners.mean(axis=0)
    across = corners.max(axis=0) - corners.min(axis=0)
    for _ in range(2 if random.uniform() < 0.25 else 1):
        for _ in range(30):
            make = (box, box, can, mug, bowl, book)[random.integers(6)]
            above = moved(make(random), turn=turned("z", random.uniform(0, 2 * math.pi)))
            own = numpy.concatenate([solid.corners() for solid in above])[:, :2]
            hangs = ((own.max(axis=0) - own.min(axis=0)) > across - 0.006).any()
            spread = 0.3 if overhang else 0.15
            x, y = middle + random.uniform(-spread, spread, 2) * across
            placed = rest(scene, above, x, y)
            if hangs == overhang and placed is not None and placed[0].corners()[:, 2].min() > 0.01:
                scene.add("object", *placed)
                break


def piles(kind, random, overhang):
    scene = Scene(kind)
    add_table(scene, random)
    for _ in range(random.integers(2, 4)):
        pile(scene, random, overhang)
    for _ in range(random.integers(0, 3)):
        put(scene, random, any_thing, (0, 0, 0.28, 0.22), 0.02)
    look_down(scene, random)
    return scene


def stack(random):
    """Things on smaller areas of things: each lies within what it stands on."""
    return piles("stack", random, overhang=False)


def overhang(random):
    """Things that hang over the sides of what they stand on."""
    return piles("overhang", random, overhang=True)


def clutter(random):
    """Many things that hide each other and nearly touch."""
    scene = Scene("clutter")
    add_table(scene, random)
    for _ in range(random.integers(10, 17)):
        put(scene, random, any_thing, (0, 0, 0.26, 0.22), random.uniform(0.004, 0.015))
    look_down(scene, random, steepest=55)
    return scene


def lean(random):
    """Books and rods that lean on boxes."""
    scene = Scene("lean")
    add_table(scene, random)
    for _ in range(random.integers(2, 4)):
        size = tuple(random.uniform((0.08, 0.08, 0.08), (0.18, 0.18, 0.2)))
        held = put(scene, random, lambda r: (Box(size=size, **look_of(r)),), (0, 0, 0.25, 0.2), 0.1)
        if held is None:
            continue
        slope = math.radians(random.uniform(12, 35))
        if random.uniform() < 0.7:
            wide, long, thick = random.uniform(0.1, 0.2), random.uniform(0.14, 0.25), 0.02
            leaning = Box(size=(thick, wide, long), **look_of(random)).placed(
                shift=(thick / 2, 0, 0)
            )
        else:
            radius, long = 0.012, random.uniform(0.18, 0.3)
            leaning = shapes.cylinder(radius, long, **look_of(random)).placed(shift=(radius, 0, 0))
        away = min(long * math.sin(slope), size[2] * math.tan(slope)) + 0.0005
        leaning = leaning.placed(turned("y", -slope)).placed(shift=(size[0] / 2 + away, 0, 0))
        pose = held[0]
        placed = leaning.placed(pose.turn, (*pose.shift[:2], 0))
        scene.add("object", placed)
    for _ in range(random.integers(1, 4)):
        put(scene, random, any_thing, (0, 0, 0.28, 0.22), 0.03)
    look_down(scene, random)
    return scene


def flush(random):
    """Pairs of boxes side by side or on each other, with faces in one plane and other colours."""
    scene = Scene("flush")
    add_table(scene, random)
    for _ in range(random.integers(2, 4)):
        w, d, h = random.uniform(0.06, 0.15, 3)
        split = random.uniform(0.35, 0.65)
        for _ in range(30):
            turn = turned("z", random.uniform(0, 2 * math.pi))
            x, y = random.uniform(-0.25, 0.25), random.uniform(-0.2, 0.2)
            if random.uniform() < 0.5:
                sizes, shifts = ((w, d, h), (w * split, d, h)), ((-w / 2, 0, 0), (w * split / 2, 0, 0))
            else:
                sizes, shifts = ((w, d, h), (w, d, h * split)), ((0, 0, 0), (0, 0, h))
            pair = [
                Box(size=size, **look_of(random)).placed(shift=shift).placed(turn, (x, y, 0))
                for size, shift in zip(sizes, shifts)
            ]
            if is_free(scene, pair, 0.02):
                for solid in pair:
                    scene.add("object", solid)
                break
    look_down(scene, random)
    return scene


def drop(scene, random, area, make, tries=30):
    """Lets a thing down at the place of the area, of a few, where it comes to rest lowest."""
    best = None
    for _ in range(tries):
        solids = moved(make(random), turn=turned("z", random.uniform(0, 2 * math.pi)))
        x = area[0] + random.uniform(-area[2], area[2])
        y = area[1] + random.uniform(-area[3], area[3])
        corners = numpy.concatenate([solid.corners() for solid in moved(solids, (x, y, 0))])
        if (abs(corners[:, :2] - area[:2]) > numpy.array(area[2:]) - 0.003).any():
            continue
        placed = rest(scene, solids, x, y)
        if placed is not None and (best is None or top_of(placed) < top_of(best)):
            best = placed
    if best is not None:
        scene.add("object", *best)


def part(random):
    """A small thing, as they are stored in bins."""
    makers = (
        lambda r: box(r, 0.03, 0.1),
        lambda r: box(r, 0.03, 0.1),
        lambda r: can(r, 0.7),
        lying_can,
        rod,
        ball,
    )
    return makers[random.integers(len(makers))](random)


def container(random, w, d, h, floor):
    """A bin without a lid: a floor and four walls in one colour."""
    thick, colour = 0.008, colour_of(random)
    board = lambda size, x, y: Box(size=size, colour=colour).placed(shift=(x, y, floor))
    return (
        board((w, d, thick), 0, 0),
        board((w, thick, h), 0, (d - thick) / 2),
        board((w, thick, h), 0, -(d - thick) / 2),
        board((thick, d, h), (w - thick) / 2, 0),
        board((thick, d, h), -(w - thick) / 2, 0),
    )


def bin_(random):
    """Parts in a bin that stands on a table or on the floor."""
    scene = Scene("bin")
    add_table(scene, random)
    w, d, h = random.uniform(0.36, 0.56), random.uniform(0.28, 0.4), random.uniform(0.1, 0.2)
    scene.add("bin", *container(random, w, d, h, 0.0))
    for _ in range(random.integers(8, 15)):
        drop(scene, random, (0, 0, w / 2 - 0.012, d / 2 - 0.012), part, 12)
    look_down(scene, random, 0.7, 1.2)
    distance = numpy.linalg.norm(scene.eye)
    slope = math.radians(random.uniform(55, 85))  # steeply, into the bin
    around = math.atan2(scene.eye[1], scene.eye[0])
    flat = distance * math.cos(slope)
    scene.eye = (flat * math.cos(around), flat * math.sin(around), distance * math.sin(slope))
    return scene


def shelf(random):
    """Things on two boards of a shelf with sides and a back, seen from the front."""
    scene = Scene("shelf")
    w, d, up = random.uniform(0.7, 1.0), random.uniform(0.3, 0.4), random.uniform(0.3, 0.4)
    colour, thick = grey(random), 0.02
    for k in range(3):
        role = "support" if k == 0 else "shelf"
        scene.add(role, slab(colour, (w, d, thick), (0, 0, k * up)))
    side = lambda x: Box(size=(thick, d, 2 * up + thick), colour=colour).placed(
        shift=(x, 0, -thick)
    )
    scene.add("wall", side(-w / 2 - thick / 2), side(w / 2 + thick / 2))
    back = Box(size=(w + 2 * thick, 0.01, 2 * up + thick), colour=colour)
    scene.add("wall", back.placed(shift=(0, d / 2 + 0.005, -thick)))
    fits = lambda random: next(
        s for s in iter(lambda: any_thing(random), None) if top_of(s) < up - 0.05
    )
    for k in range(2):
        scene.lid = (k + 1) * up - 2 * thick
        for _ in range(random.integers(3, 6)):
            put(scene, random, fits, (0, -0.02, w / 2 - 0.1, d / 2 - 0.1), 0.02, floor=k * up)
    scene.eye = (random.uniform(-0.3, 0.3), -random.uniform(1.0, 1.5), up * random.uniform(1.2, 2.2))
    scene.target = (0, 0, up * 0.8)
    return scene


def room(random):
    """A floor, two or three walls and sometimes a ceiling; a table with things; large things."""
    scene = Scene("room")
    high, colour = random.uniform(2.3, 2.7), grey(random)
    scene.add("floor", slab(grey(random), (9, 9, 0.1), (0, 0, 0)))
    scene.add("ceiling", Box(size=(9, 9, 0.1), colour=grey(random)).placed(shift=(0, 0, high)))
    wall = lambda size, x, y: Box(size=size, colour=colour).placed(shift=(x, y, 0))
    back, side = random.uniform(0.8, 1.6), random.uniform(1.2, 2.2)
    scene.add("wall", wall((9, 0.1, high), 0, back + 0.05))
    scene.add("wall", wall((0.1, 9, high), side + 0.05, 0))
    if random.uniform() < 0.5:
        scene.add("wall", wall((0.1, 9, high), -side - 0.05, 0))
    w, d, h = random.uniform(0.9, 1.4), random.uniform(0.6, 0.8), random.uniform(0.55, 0.75)
    x, y = random.uniform(-0.3, 0.3), random.uniform(-0.2, back - d / 2 - 0.05)
    wood = grey(random)
    legs = [
        Box(size=(0.05, 0.05, h - 0.03), colour=wood).placed(
            shift=(x + i * (w / 2 - 0.04), y + j * (d / 2 - 0.04), 0)
        )
        for i in (-1, 1)
        for j in (-1, 1)
    ]
    scene.add("support", slab(wood, (w, d, 0.03), (x, y, h)), *legs)
    scene.lid = 2.0
    large = lambda r: box(r, 0.12, 0.3) if r.uniform() < 0.6 else can(r, 2.0)
    for _ in range(random.integers(3, 6)):
        put(scene, random, large, (x, y, w / 2 - 0.15, d / 2 - 0.15), 0.04, floor=h)
    for _ in range(random.integers(1, 4)):
        put(
            scene,
            random,
            lambda r: box(r, 0.2, 0.45),
            (x, y - 0.2, min(side - 0.3, 1.3), back - y + 0.1),
            0.05,
        )
    scene.eye = (x + random.uniform(-0.5, 0.5), y - random.uniform(2.2, 3.6), random.uniform(1.3, 1.7))
    scene.target = (x, y, h * random.uniform(0.7, 1.1))
    return scene


def loose(random):
    """Things without a support: its points have been removed, or never were there."""
    make = (table, stack, clutter)[random.integers(3)]
    scene = make(random)
    scene.kind = "loose"
    things = [thing for thing in scene.things if thing.role == "object"]
    if random.uniform() < 0.25:  # one thing, cropped out or held in the air
        things = [things[random.integers(len(things))]]
        middle = numpy.mean([solid.corners().mean(axis=0) for solid in things[0].solids], axis=0)
        scene.eye = tuple(numpy.array(scene.eye) + middle - numpy.array(scene.target))
        scene.target = tuple(middle)
    scene.things = things
    return scene


KINDS = {
    "table": table,
    "stack": stack,
    "overhang": overhang,
    "clutter": clutter,
    "lean": lean,
    "flush": flush,
    "bin": bin_,
    "shelf": shelf,
    "room": room,
    "loose": loose,
}
