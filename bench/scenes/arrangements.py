# SPDX-License-Identifier: MIT
"""Arrangements of things: one function per kind of scene, which makes a scene from a random
generator. placing.py describes the world."""

import math

import numpy

import shapes
from placing import Scene, drop, hangs_over, is_free, put, rest, somewhere, top_of
from shapes import Box, turned
from things import any_thing, book, bowl, box, can, colour_of, look_of, mug, part

ROLES = ("object", "support", "wall", "floor", "shelf", "bin", "ceiling")


def slab(colour, size, middle):
    """A box whose upper face is centred at `middle`."""
    x, y, z = middle
    return Box(size=size, colour=colour).placed(shift=(x, y, z - size[2]))


def grey(random):
    return (random.uniform(90, 220),) * 3


def add_table(scene, random):
    """A very large table, or a smaller table above a floor."""
    if random.uniform() < 0.7:
        scene.add("support", slab(grey(random), (6, 6, 0.03), (0, 0, 0)))
        return
    size = random.uniform(1.0, 1.6), random.uniform(0.8, 1.1), random.uniform(0.02, 0.04)
    scene.add("support", slab(grey(random), size, (0, 0, 0)))
    scene.add("floor", slab(grey(random), (12, 12, 0.1), (0, 0, -random.uniform(0.6, 0.8))))


def look_down(scene, random, nearest=0.65, farthest=1.3, flattest=30, steepest=65):
    """The camera looks down at the middle of the scene. Its distance (metres) and the slope of its
    view (degrees) are random, between the given limits."""
    distance = random.uniform(nearest, farthest)
    slope, around = math.radians(random.uniform(flattest, steepest)), random.uniform(0, 2 * math.pi)
    flat = distance * math.cos(slope)
    scene.eye = (flat * math.cos(around), flat * math.sin(around), distance * math.sin(slope))
    scene.target = (*random.uniform(-0.03, 0.03, 2), 0.03)


def table(random):
    """Single things, at least 3 cm apart."""
    scene = Scene()
    add_table(scene, random)
    for _ in range(random.integers(4, 9)):
        put(scene, random, any_thing, (0, 0, 0.28, 0.22), 0.03)
    look_down(scene, random)
    return scene


def pile(scene, random, overhang):
    """Puts one or two things on a box or a book. If `overhang` is true, each of them hangs over the
    thing below it; otherwise, none does."""
    below = put(scene, random, box if random.uniform() < 0.8 else book, (0, 0, 0.25, 0.2), 0.02)
    if below is None:
        return
    corners = below[0].corners()[:, :2]
    middle = corners.mean(axis=0)
    spread = (0.3 if overhang else 0.15) * (corners.max(axis=0) - corners.min(axis=0))
    for _ in range(2 if random.uniform() < 0.25 else 1):
        for _ in range(60):
            make = (box, box, can, mug, bowl, book)[random.integers(6)]
            placed = rest(scene, *somewhere(random, make, (*middle, *spread)))
            if placed is not None and hangs_over(placed, below) == overhang:
                scene.add("object", *placed)
                below = placed
                break


def piles(random, overhang):
    """Two or three piles, and up to two single things."""
    scene = Scene()
    add_table(scene, random)
    for _ in range(random.integers(2, 4)):
        pile(scene, random, overhang)
    for _ in range(random.integers(0, 3)):
        put(scene, random, any_thing, (0, 0, 0.28, 0.22), 0.02)
    look_down(scene, random)
    return scene


def stack(random):
    """Things that stand on other things and do not hang over their sides."""
    return piles(random, overhang=False)


def overhang(random):
    """Things that hang over the sides of what they stand on."""
    return piles(random, overhang=True)


def clutter(random):
    """Many things that hide each other and nearly touch."""
    scene = Scene()
    add_table(scene, random)
    for _ in range(random.integers(10, 17)):
        put(scene, random, any_thing, (0, 0, 0.26, 0.22), random.uniform(0.004, 0.015))
    look_down(scene, random, steepest=55)
    return scene


def lean(random):
    """Books and rods that lean on boxes."""
    scene = Scene()
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
        leaning = leaning.placed(pose.turn, (*pose.shift[:2], 0))
        if is_free(Scene(scene.things[:-1]), (leaning,), 0.005):  # it touches what it leans on
            scene.add("object", leaning)
    for _ in range(random.integers(1, 4)):
        put(scene, random, any_thing, (0, 0, 0.28, 0.22), 0.03)
    look_down(scene, random)
    return scene


def flush(random):
    """Pairs of boxes side by side or on each other, whose faces lie in one plane and whose colours
    differ."""
    scene = Scene()
    add_table(scene, random)
    for _ in range(random.integers(2, 4)):
        w, d, h = random.uniform(0.06, 0.15, 3)
        split = random.uniform(0.35, 0.65)
        for _ in range(30):
            turn = turned("z", random.uniform(0, 2 * math.pi))
            x, y = random.uniform(-0.25, 0.25), random.uniform(-0.2, 0.2)
            if random.uniform() < 0.5:
                sizes, shifts = ((w, d, h), (w * split, d, h)), (
                    (-w / 2, 0, 0),
                    (w * split / 2, 0, 0),
                )
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
    """Parts in a bin that stands on a table."""
    scene = Scene()
    add_table(scene, random)
    w, d, h = random.uniform(0.36, 0.56), random.uniform(0.28, 0.4), random.uniform(0.1, 0.2)
    scene.add("bin", *container(random, w, d, h, 0.0))
    for _ in range(random.integers(8, 15)):
        drop(scene, random, (0, 0, w / 2 - 0.012, d / 2 - 0.012), part, 12)
    look_down(scene, random, 0.7, 1.2, flattest=55, steepest=85)  # steeply, into the bin
    return scene


def shelf(random):
    """Things on two boards of a shelf with sides and a back, seen from the front."""
    scene = Scene()
    w, d, up = random.uniform(0.7, 1.0), random.uniform(0.3, 0.4), random.uniform(0.3, 0.4)
    colour, thick = grey(random), 0.02
    side = lambda x: Box(size=(thick, d, 2 * up + thick), colour=colour).placed(
        shift=(x, 0, -thick)
    )
    scene.add("wall", side(-w / 2 - thick / 2), side(w / 2 + thick / 2))
    back = Box(size=(w + 2 * thick, 0.01, 2 * up + thick), colour=colour)
    scene.add("wall", back.placed(shift=(0, d / 2 + 0.005, -thick)))

    def fits(random):
        while top_of(thing := any_thing(random)) > up - 0.05:
            pass
        return thing

    for k in range(2):  # the lower board comes first, because `put` looks from above
        scene.add("shelf" if k else "support", slab(colour, (w, d, thick), (0, 0, k * up)))
        for _ in range(random.integers(3, 6)):
            put(scene, random, fits, (0, -0.02, w / 2 - 0.1, d / 2 - 0.1), 0.02, floor=k * up)
    scene.add("shelf", slab(colour, (w, d, thick), (0, 0, 2 * up)))
    scene.eye = (
        random.uniform(-0.3, 0.3),
        -random.uniform(1.0, 1.5),
        up * random.uniform(1.2, 2.2),
    )
    scene.target = (0, 0, up * 0.8)
    return scene


def room(random):
    """A floor, two or three walls and a ceiling; a table with things; large things on the floor."""
    scene = Scene()
    high, colour = random.uniform(2.3, 2.7), grey(random)
    scene.add("floor", slab(grey(random), (9, 9, 0.1), (0, 0, 0)))
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
    # The ceiling comes last, because `put` looks for free places from above.
    scene.add("ceiling", Box(size=(9, 9, 0.1), colour=grey(random)).placed(shift=(0, 0, high)))
    scene.eye = (
        x + random.uniform(-0.5, 0.5),
        y - random.uniform(2.2, 3.6),
        random.uniform(1.3, 1.7),
    )
    scene.target = (x, y, h * random.uniform(0.7, 1.1))
    return scene


def loose(random):
    """Things without a support, as if the points of the support had been removed."""
    make = (table, stack, clutter)[random.integers(3)]
    scene = make(random)
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
