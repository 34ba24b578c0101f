# SPDX-License-Identifier: MIT
"""Single things from a random generator: each function returns the solids of one thing, which
stands or lies on the plane z = 0 with its middle near the z axis."""

import colorsys
import math

import shapes
from placing import moved
from shapes import Box, Print, turned


def colour_of(random):
    h, s, v = random.uniform(0, 1), random.uniform(0.1, 0.9), random.uniform(0.25, 0.95)
    return tuple(255 * c for c in colorsys.hsv_to_rgb(h, s, v))


def look_of(random):
    """A colour and, with probability 1/2, a printed pattern."""
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


def part(random):
    """A small thing of a kind that is stored in bins."""
    makers = (
        lambda r: box(r, 0.03, 0.1),
        lambda r: box(r, 0.03, 0.1),
        lambda r: can(r, 0.7),
        lying_can,
        rod,
        ball,
    )
    return makers[random.integers(len(makers))](random)
