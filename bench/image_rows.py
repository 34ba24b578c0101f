# SPDX-License-Identifier: MIT
"""The inputs of compare_images.py: seeded pictures and volumes. Needs numpy."""
import math
from dataclasses import dataclass

import numpy

SEED = 1


@dataclass(frozen=True)
class Row:
    name: str
    shape: tuple
    kind: str
    usual: bool  # measured unless --rows says otherwise


def noise(shape, generator):
    return generator.random(shape)


def eight_bit(shape, generator):
    return numpy.floor(256 * generator.random(shape))


def smooth(shape, generator):
    """A few waves and a little noise: features of tens of voxels, a critical cell in some hundreds of voxels."""
    axes = numpy.meshgrid(*[numpy.arange(n, dtype=float) for n in shape], indexing="ij", sparse=True)
    waves = sum(math.sin(1 + k) * numpy.sin(0.05 * (1 + k % 3) * sum((1 + (k + j) % 3) * x for j, x in enumerate(axes)))
                for k in range(5))
    return waves + 0.01 * generator.random(shape)


KINDS = {"noise": noise, "smooth": smooth, "8-bit": eight_bit}
SIZES = {"2048²": (2048, 2048), "64³": (64, 64, 64), "128³": (128, 128, 128), "256³": (256, 256, 256),
         "512³": (512, 512, 512)}

ROWS = [Row(f"{size} {kind}", shape, kind, math.prod(shape) <= 2048**2 or (size, kind) == ("256³", "smooth"))
        for size, shape in SIZES.items() for kind in KINDS]


def input_file(row, made):
    """The path of a row's input, written now if it is not there."""
    path = made / (row.name.replace(" ", "_") + ".npy")
    if not path.exists():
        part = path.with_suffix(".part.npy")
        numpy.save(part, KINDS[row.kind](row.shape, numpy.random.default_rng(SEED)))
        part.rename(path)
    return path
