# SPDX-License-Identifier: MIT
"""Degrades frames. Each perturbation has one kind and one amount, and is deterministic: the same
frame, kind and amount give the same result."""
import dataclasses
import typing
import zlib

import numpy

BLOCK = 16  # pixels


def without(scene, lost):
    points = scene.points.copy()
    points[lost] = numpy.nan
    return dataclasses.replace(scene, points=points)


def with_depth(scene):
    """The numbers of the points with depth."""
    return numpy.flatnonzero(numpy.isfinite(scene.points).all(axis=1))


def listed(scene, kept):
    """The points with these numbers, in this order, without rows and columns."""
    return dataclasses.replace(
        scene, points=scene.points[kept], truth=scene.truth[kept], width=len(kept), height=1
    )


def along_rays(scene, sigma, generator):
    """Moves each point along its ray such that its depth changes by a normally distributed amount.

    @param sigma the standard deviation of this amount, in metres, as a function of the depth."""
    z = scene.points[:, 2:]
    moved = scene.points * (1 + sigma(z) * generator.standard_normal(z.shape) / z)
    return dataclasses.replace(scene, points=moved.astype(numpy.float32))


def noise(scene, millimetres, generator):
    """Noise along the rays. The standard deviation is `millimetres` at one metre, and grows with
    depth²."""
    return along_rays(scene, lambda z: millimetres / 1000 * z**2, generator)


def dropout(scene, percent, generator):
    """Removes the depth of randomly chosen points, each independently of the others."""
    return without(scene, generator.random(len(scene.truth)) < percent / 100)


def blocks(scene, percent, generator):
    """Removes depth in squares of 16 x 16 pixels. A frame without rows and columns is left
    unchanged."""
    if not scene.organised:
        return scene
    shape = -(-scene.height // BLOCK), -(-scene.width // BLOCK)
    lost = numpy.kron(generator.random(shape) < percent / 100, numpy.ones((BLOCK, BLOCK), bool))
    return without(scene, lost[: scene.height, : scene.width].ravel())


def stride(scene, step, _):
    """A smaller image of every step-th row and column; for a frame without rows and columns, every
    step²-th point."""
    index = numpy.arange(len(scene.truth)).reshape(scene.height, scene.width)
    index = index[::step, ::step] if scene.organised else index[:, :: step * step]
    return dataclasses.replace(
        scene,
        points=scene.points[index.ravel()],
        truth=scene.truth[index.ravel()],
        height=index.shape[0],
        width=index.shape[1],
    )


def subset(scene, percent, generator):
    """A random subset of the points with depth, in random order and without rows and columns."""
    there = with_depth(scene)
    return listed(scene, generator.permutation(there)[: round(len(there) * percent / 100)])


@dataclasses.dataclass(frozen=True)
class Kind:
    apply: typing.Callable
    what: str  # the meaning of the amount
    unharmed: float  # the amount that leaves the frame unchanged


KINDS = {
    "noise": Kind(noise, "noise of depth, σ in mm at 1 m", 0),
    "dropout": Kind(dropout, "points without depth, %", 0),
    "blocks": Kind(blocks, "16 × 16 pixels without depth, %", 0),
    "stride": Kind(stride, "each k-th row and column", 1),
    "subset": Kind(subset, "random points kept, %", 100),
}


def perturbed(scene, kind, amount):
    seed = zlib.crc32(f"{kind} {amount:g} {scene.name}".encode())
    amount = int(amount) if kind == "stride" else amount
    return KINDS[kind].apply(scene, amount, numpy.random.default_rng(seed))
