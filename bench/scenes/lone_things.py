# SPDX-License-Identifier: MIT
"""Scenes in which no table is the largest plane, and low things on a table.

Each kind is made in two sizes and seen from three places, with the three kinds of sensor in turn.
Needs numpy.
"""

import dataclasses
import math

import numpy

import arrangements
import cameras
import frames
import shapes
import things
from placing import Scene, drop, moved
from shapes import Box, Revolved, turned

GREY = {"colour": (150, 150, 150)}
SUPPORT = arrangements.ROLES.index("support")
TABLE = arrangements.slab(GREY["colour"], (6, 6, 0.03), (0, 0, 0))


def scene_of(*objects, table=False):
    """A scene with objects, each a tuple of solids, and perhaps a table."""
    scene = Scene()
    if table:
        scene.add("support", TABLE)
    for solids in objects:
        scene.add("object", *solids)
    return scene


def box(size, _):
    return scene_of((Box(size=(0.12 * size, 0.16 * size, 0.1 * size), **GREY),))


def tilted_box(size, random):
    turn = turned("x", random.uniform(0.3, 1.2)) @ turned("y", random.uniform(0.3, 1.2))
    return scene_of(moved(box(size, random).solids(), turn=turn))


def can(size, _):
    return scene_of((shapes.cylinder(0.04 * size, 0.12 * size, **GREY),))


def lying_can(size, random):
    return scene_of(moved(can(size, random).solids(), turn=turned("y", math.pi / 2)))


def bowl(size, _):
    return scene_of((shapes.bowl(0.08 * size, 0.055 * size, 0.004, **GREY),))


def upturned_bowl(size, random):
    return scene_of(moved(bowl(size, random).solids(), turn=turned("x", math.pi)))


def mug(size, _):
    radius, height = 0.042 * size, 0.1 * size
    handle = shapes.handle(radius, height, **GREY)
    return scene_of((shapes.cup(radius, height, 0.004, **GREY), *handle))


def ball(size, _):
    return scene_of((shapes.ball(0.06 * size, **GREY),))


def rod(size, _):
    solid = shapes.cylinder(0.012 * size, 0.3 * size, **GREY)
    return scene_of(moved((solid,), turn=turned("y", math.pi / 2)))


def held(_, random):
    """Any thing in any pose."""
    angles = random.uniform(0, 2 * math.pi, 3)
    turn = turned("z", angles[0]) @ turned("x", angles[1]) @ turned("y", angles[2])
    return scene_of(moved(things.any_thing(random), turn=turn))


def balls(size, _):
    places = (-0.1, 0), (0.1, 0.02), (0, 0.13)
    return scene_of(
        *[(shapes.ball(0.055 * size, **GREY).placed(shift=(x * size, y * size, 0)),)
          for x, y in places]
    )


def person(size, _):
    limb = lambda radius, length, x, z: shapes.cylinder(
        radius * size, length * size, **GREY
    ).placed(shift=(x * size, 0, z * size))
    angles = numpy.linspace(-math.pi / 2, math.pi / 2, 25)
    profile = [(0.2 * size * math.cos(a), 0.375 * size * (1 + math.sin(a))) for a in angles]
    trunk = Revolved(profile=tuple(profile), **GREY).placed(shift=(0, 0, 0.78 * size))
    head = shapes.ball(0.11 * size, **GREY).placed(shift=(0, 0, 1.53 * size))
    legs = limb(0.08, 0.85, -0.1, 0), limb(0.08, 0.85, 0.1, 0)
    arms = limb(0.05, 0.6, -0.24, 0.85), limb(0.05, 0.6, 0.24, 0.85)
    return scene_of((*legs, trunk, *arms, limb(0.06, 0.12, 0, 1.45), head))


def pile(size, random):
    """Parts that fell on each other, without the table on which they lie."""
    scene = scene_of(table=True)
    for _ in range(8):
        drop(scene, random, (0, 0, 0.16 * size, 0.13 * size), things.part, 8)
    del scene.things[0]
    return scene


def bin_(size, random):
    """Parts in a bin, and nothing below it."""
    scene = Scene()
    width, depth = 0.42 * size, 0.32 * size
    scene.add("bin", *arrangements.container(random, width, depth, 0.14 * size, 0.0))
    for _ in range(8):
        drop(scene, random, (0, 0, width / 2 - 0.012, depth / 2 - 0.012), things.part, 8)
    return scene


def three_things(size, random):
    block = Box(size=(0.1 * size, 0.08 * size, 0.14 * size), **GREY)
    turn = turned("z", random.uniform(0, math.pi))
    return scene_of(
        moved((block,), (-0.16 * size, 0, 0), turn),
        moved(can(size, random).solids(), (0, 0.12 * size, 0)),
        (Box(size=(0.12 * size, 0.1 * size, 0.06 * size), **GREY).placed(
            shift=(0.16 * size, -0.02 * size, 0)),),
        table=True,
    )


def low(width, depth):
    """Makes a board 12 mm high, or higher, on a table."""

    def make(size, random):
        board = Box(size=(width, depth, 0.012 * size), **GREY)
        turn = turned("z", random.uniform(0, math.pi))
        return scene_of(moved((board,), turn=turn), table=True)

    return make


def tray(size, _):
    bottom = 0.012 * size
    board = lambda x, y, dx, dy, height: Box(size=(dx, dy, height), **GREY).placed(shift=(x, y, 0))
    rims = [board(x, 0, 0.008, 0.22, bottom + 0.01) for x in (-0.156, 0.156)]
    rims += [board(0, y, 0.32, 0.008, bottom + 0.01) for y in (-0.106, 0.106)]
    return scene_of((board(0, 0, 0.32, 0.22, bottom), *rims), table=True)


def plate(size, _):
    return scene_of((shapes.bowl(0.12, 0.012 * size, 0.004, **GREY),), table=True)


# Places of the camera: the slope of the view and the angle around the z axis, in degrees.
AROUND = (20, 20), (45, 60), (75, 200)
LOW = (20, 17), (40, 57), (60, 115)
ABOVE = (45, 60), (60, 115), (50, 230)
STEEP = (60, 60), (80, 115), (70, 230)
ONE_FACE = (0, 90), (2, 0), (88, 90)
TWO_FACES = (2, 50), (45, 1), (3, 130)
THREE_FACES = (35, 45), (50, 35), (25, 140)
FRONT = (0, 90), (10, 40), (25, 115)


@dataclasses.dataclass(frozen=True)
class Case:
    """A kind of scene and what must be found in it."""

    make: object  # a function of a size and a random generator
    least: float  # the least F measure of objects
    exact: bool = True  # the number of objects is the true one
    views: tuple = AROUND
    sizes: tuple = (0.8, 1.5)
    distances: tuple = (1.4, 1.4, 0.5)
    without_table: bool = False  # the user has removed the points of the table


CASES = {
    "box, one face": Case(box, 0.9, views=ONE_FACE),
    "box, two faces": Case(box, 0.9, views=TWO_FACES),
    "box, three faces": Case(box, 0.9, False, THREE_FACES),
    "large box": Case(box, 0.85, False, THREE_FACES, (3.0, 3.5), (0.9, 1.4, 0.9)),
    "tilted box": Case(tilted_box, 0.9),
    "can": Case(can, 0.9, False),
    "lying can": Case(lying_can, 0.9),
    # Without a support, the inside and the outside of a vessel may be two objects.
    "bowl": Case(bowl, 0.35, False, LOW),
    "upturned bowl": Case(upturned_bowl, 0.9, views=LOW),
    "mug": Case(mug, 0.4, False, sizes=(1.0, 1.4), distances=(0.5, 0.9, 0.7)),
    "ball": Case(ball, 0.9, sizes=(0.8, 3.0)),
    "rod": Case(rod, 0.9, sizes=(1.0, 2.0), distances=(0.5, 0.9, 0.7)),
    "held": Case(held, 0.8, sizes=(1.0, 1.0), distances=(0.5, 0.9, 0.7)),
    "three balls": Case(balls, 0.95),
    # Parts of a person may be objects.
    "person": Case(person, 0.2, False, FRONT, (0.7, 1.0), (1.3, 1.8, 1.3)),
    "pile": Case(pile, 0.6, False, ABOVE, (1.0, 1.3), (0.7, 1.1, 0.7)),
    "bin": Case(bin_, 0.6, False, STEEP, (1.0, 1.3), (0.7, 1.1, 0.7)),
    "table removed": Case(
        three_things, 0.85, True, ABOVE, (0.8, 1.3), (0.6, 1.3, 1.0), without_table=True
    ),
    "board": Case(low(0.3, 0.2), 0.85, True, ABOVE, (1.0, 3.3), (0.8, 1.1, 0.8)),
    "book": Case(low(0.2, 0.14), 0.85, True, ABOVE, (1.0, 3.3), (0.7, 1.1, 0.7)),
    "tray": Case(tray, 0.5, False, ABOVE, (1.0, 3.0), (0.8, 1.1, 0.8)),
    "plate": Case(plate, 0.25, False, ABOVE, (1.0, 3.0), (0.7, 1.0, 0.7)),
}


def look_at(scene, slope, around, distance):
    """Points the camera at the middle of all things but the table."""
    corners = [s.corners() for t in scene.things if t.role != "support" for s in t.solids]
    corners = numpy.concatenate(corners)
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
    up, turn = math.radians(slope), math.radians(around)
    flat = distance * math.cos(up)
    away = flat * math.cos(turn), flat * math.sin(turn), distance * math.sin(up)
    scene.target, scene.eye = tuple(middle), tuple(middle + away)


def frames_of(case):
    """The frames of a case: two sizes from three places."""
    sensors = list(cameras.SENSORS)
    for n, size in enumerate(case.sizes):
        for k, (slope, around) in enumerate(case.views):
            random = numpy.random.default_rng([n, k])
            scene = case.make(size, random)
            look_at(scene, slope, around, case.distances[(n + k) % len(case.distances)])
            seen, _ = frames.seen(scene, sensors[(n + k) % 3], random, f"{size}-{slope}-{around}")
            if case.without_table:
                on_table = seen.truth == SUPPORT
                seen.points[on_table] = numpy.nan
                seen.truth[on_table] = 0
            yield seen
