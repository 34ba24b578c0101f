# SPDX-License-Identifier: MIT
"""Draws pictures of labels: ground truth and segments side by side, as PNG.

Unless the pictures are shaded, the only thing that they show of the frame itself is where depth is
missing. A segment has the colour of its matched object; an unmatched segment has its own colour and
stripes."""
import pathlib
import struct
import zlib

import numpy

import segmentation_metrics as metrics

# Okabe & Ito's colours, which most colour-blind people can distinguish, followed by darker and
# lighter ones.
COLOURS = numpy.array(
    [
        (230, 159, 0),
        (86, 180, 233),
        (0, 158, 115),
        (240, 228, 66),
        (0, 114, 178),
        (213, 94, 0),
        (204, 121, 167),
        (128, 89, 0),
        (160, 214, 245),
        (0, 92, 66),
        (168, 159, 20),
        (120, 190, 240),
        (250, 170, 110),
        (120, 60, 95),
        (90, 230, 190),
        (60, 60, 60),
    ],
    numpy.uint8,
)
TABLE, HOLE, GAP = (225, 225, 225), (255, 255, 255), 8


def png(pixels):
    """A PNG file of an array of rows x columns x 3 bytes."""
    # Each row of a PNG begins with the number of its filter, 0.
    rows = numpy.pad(pixels.reshape(len(pixels), -1), ((0, 0), (1, 0)))
    chunk = lambda kind, data: (
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    )
    header = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9))
        + chunk(b"IEND", b"")
    )


def painted(numbers, seen, striped=()):
    """An image of labels 0, 1, 2, …; -1 is the table."""
    image = numpy.full((*numbers.shape, 3), TABLE, numpy.uint8)
    image[numbers >= 0] = COLOURS[numbers[numbers >= 0] % len(COLOURS)]
    y, x = numpy.indices(numbers.shape)
    image[numpy.isin(numbers, list(striped)) & ((x + y) % 8 < 3)] = (0, 0, 0)
    image[~seen] = HOLE
    return image


def shaded(image, points, sensor_light=0.45):
    """The image, darker where the surface turns away from the sensor. The shading is computed from
    the depth alone."""
    dx, dy = (numpy.gradient(points, axis=axis) for axis in (1, 0))
    normal = numpy.cross(dx, dy)
    with numpy.errstate(invalid="ignore", divide="ignore"):
        turned = numpy.abs((normal * points).sum(axis=2))
        turned /= numpy.linalg.norm(normal, axis=2) * numpy.linalg.norm(points, axis=2)
    light = sensor_light + (1 - sensor_light) * numpy.nan_to_num(turned, nan=1.0)
    return (image * light[..., None]).astype(numpy.uint8)


def surroundings(shown, margin=24):
    """The ranges of rows and columns in which something is shown, with a margin."""
    rows, columns = numpy.flatnonzero(shown.any(axis=1)), numpy.flatnonzero(shown.any(axis=0))
    if len(rows) == 0:
        return slice(None), slice(None)
    return (
        slice(max(rows[0] - margin, 0), rows[-1] + margin),
        slice(max(columns[0] - margin, 0), columns[-1] + margin),
    )


def beside(truth_labels, predictions, parts=False, points=None, step=2):
    """The ground truth beside each prediction, cropped to objects and segments. @param points rows
    x columns x 3, for shading. @param step keep only every step-th pixel along each axis."""
    seen = truth_labels > 0
    truth, objects = metrics.truth_of(truth_labels, parts)
    images = [painted(truth, seen)]
    for prediction in predictions:
        segments, count = metrics.dense(prediction, seen & (prediction > 0))
        colour = numpy.arange(objects, objects + count)
        matched = numpy.zeros(count, bool)
        if objects and count:
            common, sizes, found = metrics.overlaps(truth, segments, objects, count)
            for i, j in metrics.matching(common, sizes, found):
                if common[i, j]:
                    colour[j], matched[j] = i, True
        coloured = numpy.where(segments < 0, -1, numpy.append(colour, -1)[segments])
        images.append(painted(coloured, seen, colour[~matched]))
    if points is not None:
        images = [shaded(image, points) for image in images]
    window = surroundings(seen & ((truth >= 0) | numpy.any(predictions, axis=0)))
    images = [image[window] for image in images]
    gap = numpy.full((images[0].shape[0], GAP * step, 3), 255, numpy.uint8)
    row = [part for image in images for part in (gap, image)][1:]
    return numpy.concatenate(row, axis=1)[::step, ::step]


def write(path, pixels):
    pathlib.Path(path).write_bytes(png(numpy.ascontiguousarray(pixels)))
