# SPDX-License-Identifier: MIT
"""Solids that rays can hit: boxes and solids of revolution, each with a pose.

All lengths are in metres. A solid in its own frame stands on the plane z = 0 with its axis on the
z axis; `placed` turns it and moves it."""

import dataclasses
import math

import numpy

FAR = numpy.inf


def turned(axis, angle):
    """The matrix that rotates by `angle` radians about the x, y or z axis."""
    c, s = math.cos(angle), math.sin(angle)
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = numpy.eye(3)
    matrix[i, i], matrix[i, j], matrix[j, i], matrix[j, j] = c, -s, s, c
    return matrix


@dataclasses.dataclass(frozen=True)
class Print:
    """A second colour on the bands of a solid: where sin(2 pi * along · p / period) > level."""

    colour: tuple
    along: tuple
    period: float
    level: float

    def covers(self, points):
        waves = numpy.sin(2 * math.pi * (points @ numpy.array(self.along)) / self.period)
        return waves > self.level


@dataclasses.dataclass(frozen=True)
class Solid:
    """A solid with a pose: a point p of its own frame is at `turn @ p + shift`."""

    colour: tuple = (128, 128, 128)
    print_: Print = None
    turn: numpy.ndarray = dataclasses.field(default_factory=lambda: numpy.eye(3))
    shift: numpy.ndarray = dataclasses.field(default_factory=lambda: numpy.zeros(3))

    def placed(self, turn=None, shift=None):
        """This solid, turned about the origin and then moved."""
        turn = numpy.eye(3) if turn is None else turn
        shift = numpy.zeros(3) if shift is None else numpy.asarray(shift, float)
        return dataclasses.replace(self, turn=turn @ self.turn, shift=turn @ self.shift + shift)

    def corners(self):
        """The eight corners of a box around the solid, in the world."""
        low, high = self.bounds()
        grid = numpy.array(numpy.meshgrid(*zip(low, high))).reshape(3, -1).T
        return grid @ self.turn.T + self.shift

    def hits(self, origins, directions):
        """For each ray, the least t > 0 at which origin + t * direction is on the solid, and the
        normal there, in the world. If the ray misses the solid, t is infinite."""
        o = (origins - self.shift) @ self.turn
        d = directions @ self.turn
        t, normals = self.own_hits(numpy.broadcast_to(o, d.shape), d)
        return t, normals @ self.turn.T

    def colours(self, points):
        """The colours at points of the surface, given in the world."""
        colours = numpy.tile(numpy.array(self.colour, float), (len(points), 1))
        if self.print_ is not None:
            colours[self.print_.covers((points - self.shift) @ self.turn)] = self.print_.colour
        return colours


@dataclasses.dataclass(frozen=True)
class Box(Solid):
    """A box of `size` x, y, z."""

    size: tuple = (1, 1, 1)

    def bounds(self):
        x, y, z = self.size
        return (-x / 2, -y / 2, 0), (x / 2, y / 2, z)

    def own_hits(self, o, d):
        low, high = map(numpy.array, self.bounds())
        with numpy.errstate(divide="ignore", invalid="ignore"):
            a, b = (low - o) / d, (high - o) / d
        near, far = numpy.fmin(a, b), numpy.fmax(a, b)
        side = near.argmax(axis=1)
        t = near.max(axis=1)
        t = numpy.where((t <= far.min(axis=1)) & (t > 0), t, FAR)
        normals = numpy.zeros(d.shape)
        rows = numpy.arange(len(d))
        normals[rows, side] = -numpy.sign(d[rows, side])
        return t, normals


@dataclasses.dataclass(frozen=True)
class Revolved(Solid):
    """The surface that a profile, a chain of points (radius, z), sweeps about the z axis."""

    profile: tuple = ()

    def bounds(self):
        radius = max(r for r, _ in self.profile)
        heights = [z for _, z in self.profile]
        return (-radius, -radius, min(heights)), (radius, radius, max(heights))

    def own_hits(self, o, d):
        best, normals = numpy.full(len(d), FAR), numpy.zeros(d.shape)

        def keep(t, ok, normal):
            better = ok & (t > 0) & (t < best)
            best[better] = t[better]
            normals[better] = normal(better)

        with numpy.errstate(divide="ignore", invalid="ignore"):
            for (r0, z0), (r1, z1) in zip(self.profile, self.profile[1:]):
                if z0 == z1:  # a disc or a ring
                    t = (z0 - o[:, 2]) / d[:, 2]
                    r = numpy.hypot(o[:, 0] + t * d[:, 0], o[:, 1] + t * d[:, 1])
                    keep(t, (min(r0, r1) <= r) & (r <= max(r0, r1)), lambda _: (0.0, 0.0, 1.0))
                    continue
                slope = (r1 - r0) / (z1 - z0)  # the frustum has the radius r0 + slope * (z - z0)
                c = r0 + slope * (o[:, 2] - z0)
                k = slope * d[:, 2]
                qa = d[:, 0] ** 2 + d[:, 1] ** 2 - k * k
                qb = o[:, 0] * d[:, 0] + o[:, 1] * d[:, 1] - c * k
                qc = o[:, 0] ** 2 + o[:, 1] ** 2 - c * c
                root = numpy.sqrt(qb * qb - qa * qc)
                for t in ((-qb - root) / qa, (-qb + root) / qa):
                    z = o[:, 2] + t * d[:, 2]
                    ok = (min(z0, z1) <= z) & (z <= max(z0, z1)) & (c + k * t >= 0)

                    def normal(rows, t=t, slope=slope):
                        p = o[rows] + t[rows, None] * d[rows]
                        n = numpy.column_stack(
                            [p[:, 0], p[:, 1], -slope * numpy.hypot(p[:, 0], p[:, 1])]
                        )
                        return n / numpy.linalg.norm(n, axis=1, keepdims=True)

                    keep(t, ok, normal)
        return best, normals


def cylinder(radius, height, **look):
    return Revolved(profile=((0, 0), (radius, 0), (radius, height), (0, height)), **look)


def ball(radius, **look):
    angles = numpy.linspace(-math.pi / 2, math.pi / 2, 25)
    profile = tuple((radius * math.cos(a), radius * (1 + math.sin(a))) for a in angles)
    return Revolved(profile=profile, **look)


def cup(radius, height, wall, **look):
    """A hollow cylinder with a bottom as thick as its wall."""
    inner = radius - wall
    return Revolved(
        profile=((0, 0), (radius, 0), (radius, height), (inner, height), (inner, wall), (0, wall)),
        **look,
    )


def bowl(radius, height, wall, **look):
    """A bowl with a flat foot: a shell between two surfaces whose radius grows as a power of z."""
    foot = 0.45 * radius
    heights = numpy.linspace(0, 1, 13)
    outer = [(foot + (radius - foot) * z**0.6, z * height) for z in heights]
    inner = [(foot - wall + (radius - foot) * z**0.6, wall + z * (height - wall)) for z in heights]
    return Revolved(profile=((0, 0), *outer, *reversed(inner), (0, wall)), **look)


def handle(radius, height, **look):
    """The handle of a cup: three bars beside it."""
    out, thick = 0.55 * radius, 0.16 * radius + 0.004
    bar = lambda size, x, z: Box(size=size, **look).placed(shift=(x, 0, z))
    middle = radius + out / 2 - thick / 4
    return (
        bar((out, thick, thick), middle, 0.2 * height),
        bar((out, thick, thick), middle, 0.8 * height - thick),
        bar((thick, thick, 0.6 * height), radius + out - thick / 2, 0.2 * height),
    )
