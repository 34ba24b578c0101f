# SPDX-License-Identifier: MIT
"""Compares ph-distance, with random options and on random barcodes, with distances by the
definition."""
import dataclasses
import itertools
import math
import pathlib

import diagram_oracle as oracle
from distance_results import cell, read_distances, read_matching, read_matrix, read_tests
from distance_tasks import random_task, with_senseless
from random_runs import damaged

INF = math.inf
SMALL = 1e-307  # smaller doubles have fewer digits
LEAST = 1e-150  # share of the cost of all bars unmatched, both to the power of the order


def expected_of(task, a, b):
    """@return the distance, and the distance if all bars were unmatched."""
    if task.distance == "bottleneck":
        return (oracle.bottleneck(a, b),) * 2
    if task.distance == "wasserstein":
        return oracle.wasserstein(a, b, task.order, task.ground)
    far = max((abs(x) for bar in a + b for x in bar if math.isfinite(x)), default=0.0)
    return oracle.sliced(a, b, task.directions), far * (len(a) + len(b))


def is_known(task, value, lower, exact, alone):
    """Checks that the bounds enclose the exact distance as closely as requested. @param lower None
    if not stated."""
    if lower is None:
        lower = value if exact == INF or task.distance == "sliced" else min(exact, value)
    if exact == INF:
        return value == lower == INF
    if value < lower or math.isinf(value):
        return False
    if task.distance == "bottleneck":
        # The distance equals the cost of one of the pairs, to the last digit.
        if not lower <= exact <= value:
            return False
        return lower > task.at_most or (
            lower == value if task.error == 0 else value <= (1 + task.error) * lower * (1 + 1e-15))
    if task.distance == "sliced":
        return value == lower and abs(value - exact) <= 1e-12 * exact + 1e-15 * alone + SMALL
    # The numbers below are costs to the power of the order, as shares of the cost of all bars
    # unmatched. They agree up to 1e-12 of their size. Differences below LEAST do not count, because
    # powers of smaller costs may be 0.
    if max(exact, value) <= SMALL or alone == 0:
        return value <= SMALL

    def share(x):
        x = min(x / alone, 2)
        return math.exp(task.order * math.log(x)) if x > 0 else 0.0
    value, lower, exact, limit = map(share, (value, lower, exact, task.at_most))
    far = (1 + task.error) ** task.order
    if lower > exact * (1 + 1e-12) + LEAST or value < exact * (1 - 1e-12) - LEAST:
        return False
    if lower > limit * (1 - 1e-14):
        return True
    if value > far * exact * (1 + 1e-12) + LEAST:
        return False
    return value <= far * (lower * (1 + 1e-12) + 1e-14)


def compare_distances(program, task, found):
    pairs = list(itertools.combinations(range(len(task.names)), 2))
    expected = [(i, j, dim) for dim in task.dims for i, j in pairs]
    if list(found) != expected:
        program.differ(f"found distances of {list(found)}, expected {expected}")
    for (i, j, dim), (value, lower) in found.items():
        exact, alone = expected_of(task, task.of(i, dim), task.of(j, dim))
        if not is_known(task, value, lower, exact, alone):
            program.differ(f"H{dim} of {task.names[i]} and {task.names[j]}: found {value!r}, at least {lower!r}, "
                           f"expected {exact!r} (alone {alone!r})")


def compare_matrix(program, task, folder, found):
    square, dim = read_matrix(program, task, folder), task.dims[0]
    for i, j in itertools.combinations(range(len(task.names)), 2):
        if found is not None:
            cell(program, square[i][j] == found[i, j, dim][0], "number in the matrix than in the table")
        exact, alone = expected_of(task, task.of(i, dim), task.of(j, dim))
        # For distances above --at-most, only a bound is known.
        near = dataclasses.replace(task, at_most=INF)
        if exact <= task.at_most and not is_known(near, square[i][j], None, exact, alone):
            program.differ(f"{task.names[i]} and {task.names[j]}: found {square[i][j]!r} in the matrix, "
                           f"expected {exact!r}")


def check_pair(program, task, bars, row):
    """Checks the ends and the cost of a pair. @param bars of both barcodes, in order. @return the
    cost."""
    _, a, b, *ends, cost = row
    for place, own, end, other in ((a, bars[0], ends[0], ends[1]), (b, bars[1], ends[1], ends[0])):
        if place is None:
            middle = other[0] / 2 + other[1] / 2
            cell(program, end[0] == end[1] and math.isclose(end[0], middle, rel_tol=1e-15, abs_tol=1e-323),
                 f"point of the diagonal: {row}")
        else:
            cell(program, end == own[place], f"bar: {row}")
    if a is None or b is None:
        birth, death = ends[0] if b is None else ends[1]
        factor = 1 if task.ground == INF else 2 ** (1 / task.ground)
        exact = (death - birth) / 2 * factor if death < INF else INF
    else:
        exact = oracle.norm(*(0.0 if x == y else abs(x - y) for x, y in zip(*ends)), task.ground)
    same = cost == exact if task.ground == INF else math.isclose(cost, exact, rel_tol=1e-14, abs_tol=SMALL)
    cell(program, same, f"cost, expected {exact!r}: {row}")
    return cost


def compare_matching(program, task, folder, found):
    rows = read_matching(program, task, folder)
    cell(program, [r[0] for r in rows] == [d for d in task.dims for r in rows if r[0] == d], "order of dimensions")
    for dim in task.dims:
        own = [row for row in rows if row[0] == dim]
        bars = [sorted(task.of(i, dim)) for i in (0, 1)]
        if not oracle.same_numbers(*bars):
            cell(program, not own, f"matching where H{dim} is infinitely far")
            continue
        for side in (0, 1):
            places = sorted(row[1 + side] for row in own if row[1 + side] is not None)
            cell(program, places == list(range(len(bars[side]))), f"list of bars of H{dim}: {places}")
        order = [INF if row[1] is None else row[1] for row in own]
        cell(program, order == sorted(order), "order of pairs")
        cell(program, (None, None) not in [row[1:3] for row in own], "pair of the diagonal with itself")
        all_costs = [check_pair(program, task, bars, row) for row in own]
        if found is None:
            continue
        value = found[0, 1, dim][0]
        largest = max(all_costs, default=0.0)
        total = largest
        if task.order < INF and largest > 0:
            total = largest * math.fsum((c / largest) ** task.order for c in all_costs) ** (1 / task.order)
        # If a cost is far below the cost of all bars unmatched, its power underflows.
        alone = expected_of(task, *bars)[1]
        if task.order < INF and total < alone * 1e-300 ** (1 / task.order):
            continue
        if total != value and not (task.order < INF and math.isclose(total, value, rel_tol=1e-12, abs_tol=SMALL)):
            program.differ(f"H{dim}: found pairs that cost {total!r}, and a distance of {value!r}")


def compare_tests(program, task, found):
    cell(program, list(found) == task.dims, f"list of tests: {found}, expected {task.dims}")
    deals = list(oracle.deals(task.labels))
    for dim, (p, loss) in found.items():
        count = len(task.names)
        square = [[0.0] * count for _ in range(count)]
        for i, j in itertools.combinations(range(count), 2):
            square[i][j] = square[j][i] = expected_of(task, task.of(i, dim), task.of(j, dim))[0]
        unit = max(map(max, square)) or 1.0
        square = [[x / unit for x in row] for row in square]
        exact = oracle.loss(square, task.labels, task.power)
        # If the loss is near the limits of doubles or beyond them, it is not checked.
        is_vast = abs(math.log10(unit)) * task.power > 290
        scale = math.nan if is_vast else unit ** task.power
        doubt = (1 + task.error) ** task.power - 1 + 1e-11
        ends = ((exact * (1 + sign * doubt) + sign * 1e-14) * scale for sign in (-1, 1))
        if not is_vast and not next(ends) <= loss <= next(ends):
            program.differ(f"H{dim}: found a loss of {loss!r}, expected {exact * scale!r}")
        if task.error:
            continue
        losses = [oracle.loss(square, deal, task.power) for deal in deals]
        ends = []
        for slack in (-1e-9, 1e-9):
            share = sum(x <= exact * (1 + slack) + slack * 1e-3 for x in losses) / len(losses)
            # Seven standard deviations of the share of shuffles, plus 25 shuffles if the share is
            # neither 0 nor 1, plus the given labelling.
            spread = 7 * math.sqrt(share * (1 - share) / task.shuffles) + 25 / task.shuffles * (share * (1 - share) > 0)
            ends.append(share + math.copysign(spread + 1 / (task.shuffles + 1), slack))
        if not ends[0] <= p <= ends[1] or not 0 < p <= 1:
            program.differ(f"H{dim}: found p {p!r}, expected {ends} by all {len(losses)} deals")


# Runs of the program.

def refused(program, task, names):
    """Expects one line that names one of the options, and no output."""
    program.expect_refusal(program.run.returncode, Names(task))
    said = [line for line in program.said.splitlines() if line.startswith("ph-distance: ") and ": read " not in line]
    if not any(name in said[-1] for name in names):
        program.differ(f"found a message that does not name any of {names}")


class Names:
    """The names of all outputs, in the form that Program.expect_refusal needs."""

    def __init__(self, task):
        self.name = task.output or task.matching or task.matrix
        self.all = [name for name in (task.output, task.matching, task.matrix) if name]


def no_outputs(program, task, folder):
    for name in Names(task).all:
        if pathlib.Path(folder, name).exists():
            program.differ(f"found {name} after a refusal")


def expected_refusal(task):
    """@return the documented exit code, and words, one of which the message must contain; None if
    no refusal is expected."""
    if task.matrix and len(task.dims) != 1:
        return 64, ["--matrix"]
    if task.aim != "groups":
        return None
    if len(set(task.labels)) < 2 or min(map(task.labels.count, task.labels)) < 2:
        return 65, ["group"]
    if any(not oracle.same_numbers(task.of(i, dim), task.of(j, dim)) for dim in task.dims
           for i, j in itertools.combinations(range(len(task.names)), 2)):
        return 65, ["infinite", "never die", "always there"]
    return None


def one_run(rng, program, folder):
    """Runs the program once. @return the kind of run, for the counts."""
    task, options = random_task(rng, folder)
    kind = f"{task.distance}, {task.aim}"
    if rng.random() < 0.1:
        path = pathlib.Path(folder, rng.choice(task.names + ["g.txt"] * (task.aim == "groups")))
        path.write_bytes(damaged(rng, path.read_bytes()))
        code = program([*[[name] for name in task.names], *options])
        if code not in (0, 64, 65, 66, 75):
            program.differ("found another end than distances or a refusal")
        if code:
            program.expect_refusal(code, Names(task))
            no_outputs(program, task, folder)
        return f"{kind}, damaged"
    if rng.random() < 0.08:
        options, name = with_senseless(rng, task, options)
        if program([*[[n] for n in task.names], *options]) != 64:
            program.differ(f"found no refusal of {name}")
        refused(program, task, [name])
        no_outputs(program, task, folder)
        return f"{kind}, refused"
    # The order of files matters, and the order of options does not.
    rng.shuffle(options)
    at = rng.randint(0, len(options))
    code = program([*options[:at], *[[name] for name in task.names], *options[at:]])
    expected = expected_refusal(task)
    if expected:
        if code != expected[0]:
            program.differ(f"found no refusal with {expected[0]}")
        refused(program, task, expected[1])
        no_outputs(program, task, folder)
        return f"{kind}, refused"
    if code != 0:
        program.differ("found a refusal, expected distances")
    if "--quiet" in program.command and program.said:
        program.differ("found a message with --quiet")
    content = pathlib.Path(folder, task.output).read_bytes() if task.output else program.run.stdout
    found = None
    try:
        if task.aim == "groups":
            compare_tests(program, task, read_tests(program, task, content))
        elif not (task.matrix and not task.output and "--output-format" not in program.command):
            found = read_distances(program, task, content)
            compare_distances(program, task, found)
        else:
            cell(program, not content, "output than the matrix alone")
        if task.matrix:
            compare_matrix(program, task, folder, found)
        if task.matching:
            compare_matching(program, task, folder, found)
    except (ValueError, KeyError, IndexError) as error:
        program.differ(f"cannot read it back: {error!r}: {content[:300]!r}")
    return kind
