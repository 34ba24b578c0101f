# SPDX-License-Identifier: MIT
"""random_arrays.py [--runs N] [--seed S]

Passes arrays of random types, shapes and layouts to libph, and compares the bars with the bars by
the definition (oracle.py). For the definition, the numbers are read one by one. NaN and other
invalid entries must be refused in one line, and no array may be modified. Each run has its own
seed: --seed S --runs 1 repeats the run of seed S. Exits with 1 at the first difference."""
import argparse
import collections
import os
import random
import sys

try:
    import numpy as np
except ModuleNotFoundError:
    print("SKIPPED: no numpy")
    sys.exit(77)

import libph as ph

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../support"))
import oracle  # noqa: E402

NUMBERS = ["f8", "f4", "f2", "g", "i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", "?", "O"]
NO_NUMBERS = ["c8", "c16", "U4", "S4", "M8[s]", "m8[s]", "V4"]


class HasArray:
    """An object that is not a NumPy array but converts to one, as the arrays of other libraries
    do."""

    def __init__(self, array):
        self.array = array

    def __array__(self, dtype=None, copy=None):
        return np.asarray(self.array, dtype)


class Own(np.ndarray):
    pass


def with_gaps(array, draw):
    """A view into a larger array of other numbers, with a separate step for each axis, some of them
    negative."""
    steps = [draw.choice([1, 2, 3, -1, -2]) for _ in array.shape]
    room = np.full([abs(s) * n for s, n in zip(steps, array.shape)], 1, array.dtype)
    view = room[tuple(slice(None, None, s) for s in steps)]
    view[...] = array
    return view


def unaligned(array, draw):
    if array.dtype.kind == "O":
        return array
    room = np.empty(array.nbytes + 1, np.uint8)
    moved = room[1:].view(array.dtype).reshape(array.shape)
    moved[...] = array
    return moved


def of_a_record(array, draw):
    before, after = draw.randrange(3), draw.randrange(3)
    fields = [("before", f"V{before}"), ("x", array.dtype), ("after", f"V{after}")]
    records = np.zeros(array.shape, [f for f in fields if f[1] != "V0"])
    records["x"] = array
    return records["x"]


def turned(array, draw):
    order = list(range(array.ndim))
    draw.shuffle(order)
    return np.ascontiguousarray(array.transpose(order)).transpose(np.argsort(order))


def read_only(array, draw):
    copy = array.copy(order="K")
    copy.flags.writeable = False
    return copy


LAYOUTS = [with_gaps, unaligned, of_a_record, turned, read_only,
           lambda a, draw: np.asfortranarray(a),
           lambda a, draw: a.astype(a.dtype.newbyteorder()),
           lambda a, draw: a.view(Own)]
# Wrappers are applied last, because they return something other than a NumPy array.
WRAPPED = [lambda a: a] * 6 + [HasArray, lambda a: a.tolist(), np.ma.asarray]


def plain_numbers(array):
    """The numbers by index, as Python numbers that are read one by one."""
    return {at: float(array[at]) for at in np.ndindex(*array.shape)}


def random_numbers(draw, shape, kind):
    """Whole numbers that the type can hold, with ties. Floats may also be quarters and, rarely, NaN
    or infinity."""
    if kind == "?":
        pick = [0, 1]
    elif kind[0] == "u":
        pick = range(120)
    else:
        pick = range(-60, 60)
    few = draw.random() < 0.5
    values = [draw.choice(pick[:4] if few else pick) for _ in range(int(np.prod(shape)))]
    if kind in ("f8", "f4", "f2", "g"):
        values = [v / 4 for v in values]
        if values and draw.random() < 0.1:
            values[draw.randrange(len(values))] = draw.choice([np.nan, np.inf, -np.inf])
    array = np.empty(shape, kind)
    array.reshape(-1)[...] = np.array(values, kind)
    return array


def some_shape(draw, task):
    if task == "points":
        return (draw.randrange(8), draw.randrange(1, 5))
    if task == "distances":
        return (draw.randrange(1, 8),) * 2
    return tuple(draw.randrange(1, (12, 6, 4)[axes]) for axes in [draw.randrange(3)] for _ in range(axes + 1))


def made(draw, task, kind):
    shape = some_shape(draw, task)
    array = random_numbers(draw, shape, kind)
    if task == "distances":
        array = np.abs(array) if kind != "?" else array
        array = np.maximum(array, array.T) if kind != "O" else np.where(array >= array.T, array, array.T)
        np.fill_diagonal(array, 0)
    return array


def expected_bars(task, array, options):
    numbers = plain_numbers(array)
    if task == "image":
        filtration = oracle.cubical_filtration(
            array.shape, numbers, options["construction"] == "cells", options["superlevel"],
            options["periodic"])
        return oracle.barcode(filtration, options["field"])
    count = array.shape[0]
    if task == "points":
        between = oracle.distance(options["metric"])
        rows = [[numbers[i, k] for k in range(array.shape[1])] for i in range(count)]
        edge = lambda i, j: between(rows[i], rows[j])  # noqa: E731
    else:
        edge = lambda i, j: numbers[i, j]  # noqa: E731
    bars = oracle.barcode(oracle.flag_filtration([0] * count, edge, options["max_dim"]), options["field"])
    return [bar for bar in bars if bar[0] <= options["max_dim"]]


def options_of(draw, task, array):
    field = draw.choice([2, 3, 5])
    if task == "image":
        periodic = tuple(k for k in range(array.ndim) if draw.random() < 0.2)
        return {"construction": draw.choice(["vertices", "cells"]), "superlevel": draw.random() < 0.3,
                "periodic": periodic, "field": field}
    metric = "precomputed" if task == "distances" else draw.choice(["chebyshev", "manhattan", "euclidean"])
    return {"metric": metric, "max_dim": draw.randrange(3), "field": field}


def same(before, after):
    """True if two arrays have the same type and the same bytes."""
    return before.dtype == after.dtype and before.tobytes() == after.tobytes()


def run(seed):
    """@return the outcome: the number of bars, or the reason for a refusal."""
    draw = random.Random(seed)
    task = draw.choice(["points", "distances", "image"])
    compute = ph.cubical if task == "image" else ph.rips
    is_number = draw.random() < 0.95
    kind = draw.choice(NUMBERS if is_number else NO_NUMBERS)
    array = made(draw, task, kind) if is_number else np.zeros(some_shape(draw, task), kind)
    options = options_of(draw, task, array)
    plain = array.copy(order="C")
    for layout in draw.sample(LAYOUTS, draw.randrange(4)):
        array = layout(array, draw)
    before = np.array(array, copy=True, order="C", subok=False)
    given = draw.choice(WRAPPED)(array)
    if isinstance(given, list) and array.size == 0:
        is_number = True  # an empty list does not show the type of its elements
    what = f"seed {seed}: {task}, {array.dtype!r} {array.shape} {array.strides}, {type(given).__name__}, {options}"
    finite = is_number and all(np.isfinite(x) for x in plain_numbers(plain).values())
    try:
        bars = sorted(tuple(bar) for bar in compute(given, **options))
    except ph.Error as error:
        if finite or "\n" in str(error) or "found" not in str(error):
            raise AssertionError(f"{what}: {type(error).__name__}: {error}") from error
        bars = None
    after = np.array(array, copy=True, order="C", subok=False)
    if not same(before, after):
        raise AssertionError(f"{what}: the array was written to")
    if bars is None:
        return "refused"
    if not is_number:
        raise AssertionError(f"{what}: no numbers, and yet there are bars {bars}")
    if any(np.isnan(x) for x in plain_numbers(plain).values()):
        raise AssertionError(f"{what}: NaN, and yet there are bars {bars}")
    expected = expected_bars(task, plain, options)
    if bars != expected:
        raise AssertionError(f"{what}: found {bars}, expected {expected} of {plain.tolist()}")
    return "bars of " + task


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=3000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    counts = collections.Counter()
    for seed in range(arguments.seed, arguments.seed + arguments.runs):
        try:
            counts[run(seed)] += 1
        except AssertionError as difference:
            print(f"FAILED: {difference}")
            return 1
        except Exception:
            print(f"FAILED: seed {seed}")
            raise
    least = arguments.runs // 20
    for outcome in ("refused", "bars of points", "bars of distances", "bars of image"):
        if counts[outcome] < least:
            print(f"FAILED: found {counts[outcome]} runs with: {outcome}, expected at least {least}")
            return 1
    print(f"{arguments.runs} runs, 0 failures:", ", ".join(f"{n} {what}" for what, n in sorted(counts.items())))
    return 0


if __name__ == "__main__":
    sys.exit(main())
