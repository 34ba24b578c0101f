# SPDX-License-Identifier: MIT
"""Vectors of persistence diagrams by their definitions, bar by bar and value by value. Reads no
files, and shares nothing with libph. Needs NumPy and SciPy.

A diagram is a list of bars (birth, death) of one dimension and of positive length."""
import math

import numpy as np
from scipy.special import ndtr

INF = math.inf
NAMES = ["mean", "sd", "median", "iqr", "range", "p10", "p25", "p75", "p90"]
STATISTICS = [f"{of}_{name}" for of in ("birth", "death", "midpoint", "length") for name in NAMES] + \
    ["count", "entropy"]


def statistics(bars):
    if not bars:
        return [0.0] * 38
    births, deaths = np.array(bars).T
    found = []
    for numbers in (births, deaths, births / 2 + deaths / 2, deaths - births):
        p10, p25, p50, p75, p90 = np.percentile(numbers, [10, 25, 50, 75, 90])
        unit = max(np.abs(numbers).max(), 1e-300)
        found += [np.mean(numbers), np.std(numbers / unit) * unit, p50, p75 - p25, np.ptp(numbers), p10, p25, p75, p90]
    return [*map(float, found), float(len(bars)), entropy(bars, False)]


def shares(bars):
    unit = max(e - b for b, e in bars)
    total = math.fsum((e - b) / unit for b, e in bars)
    return [(e - b) / unit / total for b, e in bars]


def information(share):
    return -share * math.log(share) if share > 0 else 0.0


def entropy(bars, normalised):
    if not bars:
        return 0.0
    found = math.fsum(map(information, shares(bars)))
    if normalised:
        return found / math.log(len(bars)) if len(bars) > 1 else 0.0
    return found


def lengths(bars, count):
    found = sorted((e - b for b, e in bars), reverse=True)
    return (found + [0.0] * count)[:count]


def grid(low, high, count):
    """Evenly spaced values, including both ends."""
    if count == 1:
        return [low]
    step = (high - low) / (count - 1)
    return [low + i * step for i in range(count - 1)] + [high]


def betti(bars, at):
    return [float(sum(b <= t < e for b, e in bars)) for t in at]


def life_entropy(bars, at):
    parts = list(map(information, shares(bars))) if bars else []
    return [math.fsum(x for x, (b, e) in zip(parts, bars) if b <= t < e) for t in at]


def tent(bar, t):
    return max(0.0, min(t - bar[0], bar[1] - t))


def landscape(bars, at, layers):
    """The values of all layers, one layer after another."""
    columns = [(sorted((tent(bar, t) for bar in bars), reverse=True) + [0.0] * layers)[:layers] for t in at]
    return [columns[i][k] for k in range(layers) for i in range(len(at))]


def weights(bars, power):
    """The weights in units of the largest one. @return these weights, and the length of the longest
    bar."""
    longest = max(e - b for b, e in bars)
    return [((e - b) / longest) ** power for b, e in bars], longest


def silhouette(bars, at, power):
    if not bars:
        return [0.0] * len(at)
    weight, _ = weights(bars, power)
    total = math.fsum(weight)
    return [math.fsum(w / total * tent(bar, t) for w, bar in zip(weight, bars)) for t in at]


def shares_of_pixels(low, high, count, centre, sigma):
    """The mass of a normal distribution in each pixel."""
    ends = low + (high - low) * np.arange(count + 1) / count
    with np.errstate(over="ignore"):
        left, right = (ends[:-1] - centre) / sigma, (ends[1:] - centre) / sigma
    return np.where(left > 0, ndtr(-left) - ndtr(-right), ndtr(right) - ndtr(left))


def image(bars, births, across, sigma, power):
    """A persistence image. Rows are lengths in ascending order. @param births the (low, high,
    pixels) of births. @param across the same for lengths.
    @return the pixels, and the sum of the weights."""
    pixels, total = np.zeros((across[2], births[2])), 0.0
    for b, e in bars:
        weight = (e - b) ** power
        total += weight
        pixels += weight * np.outer(shares_of_pixels(*across, e - b, sigma), shares_of_pixels(*births, b, sigma))
    return [float(x) for x in pixels.ravel()], total


def euler(bars, at):
    """@param bars (dim, birth, death)."""
    return [float(sum((-1) ** d for d, b, e in bars if b <= t < e)) for t in at]


def atol(bars, centres, widths, contrast):
    def part(bar, centre, width):
        x = math.dist(bar, centre) / width
        return math.exp(-x if contrast == "laplace" else -x * x)
    return [math.fsum(part(bar, c, w) for bar in bars) for c, w in zip(centres, widths)]


def are_means(points, centres, slack):
    """True if the centres are a fixed point of k-means: each is the mean of the points that are
    nearest to it."""
    points, centres = np.array(points), np.array(centres)
    far = np.sqrt(((points[:, None] - centres[None]) ** 2).sum(-1))
    nearest = far.argmin(1)
    # A point at the same distance from two centres may belong to either.
    doubtful = (far <= far.min(1)[:, None] + slack).sum(1) > 1
    if doubtful.any():
        return True
    return all((nearest == k).any() and np.abs(points[nearest == k].mean(0) - c).max() <= slack
               for k, c in enumerate(centres))


def widths(points, centres):
    """The width of each centre: half the distance to the nearest other centre. A single centre has
    as its width the mean distance of the points from it, or 1 if this mean is 0."""
    if len(set(points)) == 1:
        return [1.0]
    if len(centres) == 1:
        mean = math.fsum(math.dist(p, centres[0]) for p in points) / len(points)
        return [mean]
    return [min(math.dist(c, o) for k, o in enumerate(centres) if k != i) / 2 for i, c in enumerate(centres)]
