# SPDX-License-Identifier: MIT
"""Measures how well labels agree with ground truth (overlap and boundary F, as in the evaluation of
UOIS-Net, Xie et al.) and how well supervoxels respect objects.

Labels of the ground truth: 0 is no depth (left out), 1 to 9 are the table and other surfaces, and
labels from 10 on are parts of objects, where label // 10 is the object. Labels of a prediction: 0
is no segment, and every other label is a segment.
"""
import math
from dataclasses import asdict, dataclass

import numpy

FIRST_OBJECT = 10


@dataclass(frozen=True)
class Scores:
    """Scores from 0 to 1. The scores of boundaries are None if they were not computed."""

    precision: float
    recall: float
    f: float
    boundary_precision: float = None
    boundary_recall: float = None
    boundary_f: float = None
    objects: int = 0
    segments: int = 0

    as_dict = asdict


def assignment(cost):
    """The column of each row in an assignment with the least sum; rows <= columns. Uses shortest
    augmenting paths in O(rows² columns)."""
    rows, columns = cost.shape
    potential_of_row, potential = numpy.zeros(rows), numpy.zeros(columns)
    row_of = numpy.full(columns, -1)
    for start in range(rows):
        least = numpy.full(columns, numpy.inf)
        before = numpy.full(columns, -1)
        done = numpy.zeros(columns, bool)
        row, column, length = start, -1, 0.0
        while row >= 0:
            through = length + cost[row] - potential_of_row[row] - potential
            better = ~done & (through < least)
            least[better], before[better] = through[better], column
            column = int(numpy.argmin(numpy.where(done, numpy.inf, least)))
            length, row = least[column], row_of[column]
            done[column] = True
        reached = done & (row_of >= 0)
        potential_of_row[start] += length
        potential_of_row[row_of[reached]] += length - least[reached]
        potential[done] -= length - least[done]
        while column >= 0:
            row_of[column] = row_of[before[column]] if before[column] >= 0 else start
            column = before[column]
    result = numpy.empty(rows, int)
    result[row_of[row_of >= 0]] = numpy.flatnonzero(row_of >= 0)
    return result


def dense(labels, kept):
    """The labels where `kept` is true, renumbered as 0, 1, …, with -1 elsewhere; and the number of
    different labels."""
    values, numbers = numpy.unique(labels[kept], return_inverse=True)
    result = numpy.full(labels.shape, -1)
    result[kept] = numbers
    return result, len(values)


def overlaps(truth, segments, objects, count):
    """For each object i and segment j, the number of common pixels; and the sizes of all objects
    and segments."""
    both = (truth >= 0) & (segments >= 0)
    common = numpy.bincount(truth[both] * count + segments[both], minlength=objects * count)
    size = lambda labels, n: numpy.bincount(labels[labels >= 0], minlength=n)
    return common.reshape(objects, count), size(truth, objects), size(segments, count)


def matching(common, objects, segments):
    """The one-to-one pairs (object, segment) with the largest sum of F measures."""
    f = 2 * common / (objects[:, None] + segments[None, :])
    if len(objects) <= len(segments):
        return list(enumerate(assignment(1 - f)))
    return [(i, j) for j, i in enumerate(assignment(1 - f.T))]


def outside(mask):
    """The pixels that 4-connected paths outside the mask join to the border of the image. No pixel
    of the mask is on the border."""
    seen = numpy.zeros_like(mask)
    seen[0] = seen[-1] = seen[:, 0] = seen[:, -1] = True
    while True:
        before = numpy.count_nonzero(seen)
        for area, blocked in ((seen, mask), (seen.T, mask.T)):
            # In the flattened array, the last pixel of a row is next to the first pixel of the
            # following row. Both are outside the mask.
            run = numpy.cumsum(blocked.ravel()).reshape(blocked.shape)
            reached = numpy.zeros(run[-1, -1] + 1, bool)
            reached[run[area]] = True
            area |= reached[run] & ~blocked
        if numpy.count_nonzero(seen) == before:
            return seen


def outer_boundary(mask):
    """Rows and columns of the pixels of a mask that have a 4-neighbour outside it. Holes count as
    part of the mask."""
    rows, columns = numpy.flatnonzero(mask.any(axis=1)), numpy.flatnonzero(mask.any(axis=0))
    top, left = rows[0], columns[0]
    part = numpy.pad(mask[top : rows[-1] + 1, left : columns[-1] + 1], 1)
    out = outside(part)
    near = numpy.zeros_like(part)
    near[1:-1, 1:-1] = out[:-2, 1:-1] | out[2:, 1:-1] | out[1:-1, :-2] | out[1:-1, 2:]
    y, x = numpy.nonzero(part & near)
    return y + top - 1, x + left - 1


def near(boundary, others, shape, radius):
    """The number of pixels of a boundary that lie within the radius of a pixel of the other
    boundary."""
    around = numpy.zeros((shape[0] + 2 * radius, shape[1] + 2 * radius), bool)
    for dy in range(-radius, radius + 1):
        for dx in range(-radius, radius + 1):
            if dx * dx + dy * dy <= radius * radius:
                around[others[0] + dy + radius, others[1] + dx + radius] = True
    return numpy.count_nonzero(around[boundary[0] + radius, boundary[1] + radius])


def harmonic_mean(precision, recall):
    return 2 * precision * recall / (precision + recall) if precision + recall else 0.0


def boundary_scores(truth, segments, objects, count, pairs):
    radius = math.ceil(0.003 * math.hypot(*truth.shape))  # 3 pixels for an image of 640 x 480
    theirs = [outer_boundary(truth == i) for i in range(objects)]
    ours = [outer_boundary(segments == j) for j in range(count)]
    length = lambda boundaries: sum(len(rows) for rows, _ in boundaries)
    precision = sum(near(ours[j], theirs[i], truth.shape, radius) for i, j in pairs) / length(ours)
    recall = sum(near(theirs[i], ours[j], truth.shape, radius) for i, j in pairs) / length(theirs)
    return precision, recall, harmonic_mean(precision, recall)


def truth_of(labels, parts):
    """The ground truth as numbers 0, 1, …: one number per part, or one number per object, which
    consists of parts."""
    return dense(labels if parts else labels // FIRST_OBJECT, labels >= FIRST_OBJECT)


def score(labels, prediction, parts, boundaries=True):
    """Scores of one frame. All arrays have the same shape, which must have rows and columns if
    boundaries are scored.

    @param parts if true, the visible parts of an object count as separate objects.

    """
    truth, objects = truth_of(labels, parts)
    segments, count = dense(prediction, (labels > 0) & (prediction > 0))
    if objects == 0 or count == 0:
        precision, recall = float(objects > 0 or count == 0), float(objects == 0)
        edge = (precision, recall, float(objects == count)) if boundaries else ()
        return Scores(
            precision, recall, float(objects == count), *edge or (None,) * 3, objects, count
        )
    common, sizes, found = overlaps(truth, segments, objects, count)
    pairs = matching(common, sizes, found)
    agreed = sum(common[i, j] for i, j in pairs)
    precision, recall = agreed / found.sum(), agreed / sizes.sum()
    edge = boundary_scores(truth, segments, objects, count, pairs) if boundaries else (None,) * 3
    return Scores(precision, recall, harmonic_mean(precision, recall), *edge, objects, count)


@dataclass(frozen=True)
class SupervoxelScores:
    """Scores over the pixels of objects. Shares from 0 to 1, None if there are no pixels."""

    supervoxels: int
    boundary_recall: float
    under_segmentation: float

    as_dict = asdict


def borders(labels):
    """Pixels whose right or lower neighbour has a different label. Both labels must be at least
    0."""
    found = numpy.zeros(labels.shape, bool)
    for here, there, mark in (
        (labels[:, :-1], labels[:, 1:], found[:, :-1]),
        (labels[:-1], labels[1:], found[:-1]),
    ):
        mark |= (here != there) & (here >= 0) & (there >= 0)
    return numpy.nonzero(found)


def supervoxel_scores(labels, prediction, radius=2):
    """Scores of supervoxels, here called pieces, in one image.

    Boundary recall: the share of pixels at borders between objects that have a border of pieces
    within the radius. Under-segmentation error (Neubert & Protzel, Superpixel benchmark and
    comparison, 2012): each piece contributes, for each object that it overlaps, the smaller of its
    two numbers of pixels inside and outside the object; the sum is divided by the number of pixels
    of objects. Only pixels of objects count.

    """
    truth, objects = truth_of(labels, parts=False)
    pieces, count = dense(prediction, truth >= 0)
    if objects == 0:
        return SupervoxelScores(0, None, None)
    common, sizes, found = overlaps(truth, pieces, objects, count)
    leak = numpy.minimum(common, found[None, :] - common).sum()
    theirs = borders(truth)
    recall = None
    if len(theirs[0]) > 0:
        recall = near(theirs, borders(pieces), truth.shape, radius) / len(theirs[0])
    kept = numpy.unique(prediction[(truth >= 0) & (prediction > 0)])
    return SupervoxelScores(len(kept), recall, leak / sizes.sum())
