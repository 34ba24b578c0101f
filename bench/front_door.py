#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the cost of calling the library with the cost of ph-barcode, on the same Rips barcodes,
in one run.

    front_door.py build/release [--large] [--rows WORD] [--csv FILE] [--check [CPU MEMORY]]

Each way to call the library is called a *door*:

* C++: `ph::persistence(ph::Rips(points), {.max_dim = k})`, as the README writes it;
* C++ moved: the same with `ph::Rips(std::move(points))`;
* C: `ph_rips_points` and `ph_rips_distances`;
* Python: `ph.rips(points, max_dim=k)`.

A cell of the table has two ratios of door to program: one of user + system CPU seconds, and one of
peak resident memory. Each door uses one thread, and its run with the least CPU time counts. Every
process reads its input. The doors print a summary of their bars; the program prints nothing while
it is measured. Starting a door takes longer than starting the program, mainly because of Python's
imports. This difference is measured on ten points and subtracted. The doors must find the program's
bars: the same number in each dimension, with the same total length.

A ratio is ≈ 1 if the door and the program differ by at most 8 MB, or by at most 0.02 s plus a
quarter of the CPU time that was subtracted: smaller differences are noise. `--check` exits with 1,
and names the rows, if a door takes more than CPU or MEMORY times as much as the program and the
difference exceeds the noise in each of three measurements. The script always exits with 1 if a door
fails or finds other bars. Needs NumPy. A door that is not built is left out.
"""
import argparse
import csv
import math
import os
import pathlib
import sys
import tempfile
from dataclasses import dataclass

import numpy as np

from measuring import Limits, Meter

PROGRAM = "ph-barcode"
DOORS = ("C++", "C++ moved", "C", "Python")
CPU_BOUND, MEMORY_BOUND = 1.2, 1.5  # the default bounds of --check
# A door within these seconds and MB of the program counts as equal.
CPU_FLOOR, MEMORY_FLOOR = 0.02, 8.0
# Share of a door's start that is added to CPU_FLOOR, because the time of imports varies.
START_NOISE = 0.25
LENGTHS_AGREE = 1e-9  # relative tolerance: the same lengths may be added in different orders
PYTHON = """import numpy as np
import libph as ph
bars = ph.rips(np.load(FILE), max_dim=DIM, metric=METRIC, threads=1)
for dim in range(DIM + 1):
    births, deaths = bars.dgm(dim).T
    print(dim, len(deaths), repr(float((deaths - births)[np.isfinite(deaths)].sum())))
"""


def uniform(count, axes):
    return np.random.default_rng(1).random((count, axes))


def copies(count, places):
    """`count` points of the plane at only `places` different places."""
    generator = np.random.default_rng(2)
    return generator.random((places, 2))[generator.integers(places, size=count)]


def distances(count):
    points = uniform(count, 2)
    matrix = np.empty((count, count))
    for row, point in zip(matrix, points):
        np.hypot(points[:, 0] - point[0], points[:, 1] - point[1], out=row)
    return matrix


@dataclass(frozen=True)
class Row:
    """A task. `make` returns its points, or the matrix of their distances."""
    name: str
    make: object
    max_dim: int
    is_matrix: bool = False


def rows_of(scale=1.0, large=False):
    """@param scale factor for the numbers of points. @param large also includes tasks that take
    minutes."""
    def number(n):
        return max(2, round(n * scale))

    def label(n):
        return f"{number(n):,}".replace(",", " ")

    size = 10_000 if large else 3_000
    rows = [
        Row(f"{label(10_000)} points of the plane, H0", lambda: uniform(number(10_000), 2), 0),
        Row(f"{label(10_000)} points of the plane, H1", lambda: uniform(number(10_000), 2), 1),
        Row(f"{label(8_000)} points in {label(400)} places, H1", lambda: copies(number(8_000), number(400)), 1),
        Row(f"{label(20_000)} points of R³, H0", lambda: uniform(number(20_000), 3), 0),
        Row(f"{label(2_000)} points of R³, H1", lambda: uniform(number(2_000), 3), 1),
        Row(f"distances of {label(size)} points, H0", lambda: distances(number(size)), 0, True),
        Row(f"distances of {label(size)} points, H1", lambda: distances(number(size)), 1, True),
    ]
    if large:
        rows.append(Row(f"{label(20_000)} points of R³, H1", lambda: uniform(number(20_000), 3), 1))
    return rows


class Files:
    """The files of one input: NPY, and plain doubles for the door in C."""

    def __init__(self, folder, name, array, is_matrix):
        self.array = folder / f"{name}.npy"
        self.numbers = folder / f"{name}.doubles"  # for a matrix, its strict lower triangle
        self.shape, self.is_matrix = array.shape, is_matrix
        np.save(self.array, array)
        with open(self.numbers, "wb") as file:
            if is_matrix:
                for i, row in enumerate(array):
                    row[:i].tofile(file)
            else:
                array.tofile(file)


def commands(build, files, max_dim, python, prints=False):
    """The command of each door that is built, and the command of the program. @param prints true if
    the program prints its bars."""
    kind = "distances" if files.is_matrix else "points"
    dim = str(max_dim)
    result = {
        PROGRAM: [build / "apps/barcode/ph-barcode", files.array, "--max-dim", dim, "--threads", "1", "--quiet",
                  "--output-format", "csv" if prints else "none",
                  *(("--format", "distance") if files.is_matrix else ("--complex", "rips"))],
        "C++": [build / "bench/bench_front_door", kind, "copied", dim, files.array],
        "C++ moved": [build / "bench/bench_front_door", kind, "moved", dim, files.array],
    }
    if (program := build / "bench/bench_front_door_c").exists():
        result["C"] = [program, kind, *files.shape, dim, files.numbers]
    if any((build / "python/libph").glob("_core*")):
        text = PYTHON.replace("DIM", dim).replace("FILE", repr(str(files.array)))
        text = text.replace("METRIC", repr("precomputed" if files.is_matrix else "euclidean"))
        result["Python"] = [python, "-c", text]
    return result


@dataclass(frozen=True)
class Cost:
    """The cost of a process: CPU seconds and MB. `outcome` has the values of measuring.Run."""
    cpu: float = 0.0
    peak: float = 0.0
    outcome: str = "ok"


@dataclass(frozen=True)
class Result:
    """The results of a door and of the program. `bars` maps each dimension to (count, sum of finite
    lengths); None means that the bars could not be read."""
    row: str
    door: str
    cost: Cost
    program: Cost
    bars: object
    program_bars: object
    start: float = 0.0  # CPU seconds that were subtracted for the door's start

    @property
    def cpu_ratio(self):
        return self.cost.cpu / self.program.cpu

    @property
    def memory_ratio(self):
        return self.cost.peak / self.program.peak

    @property
    def cpu_floor(self):
        return CPU_FLOOR + START_NOISE * self.start

    def fault(self):
        """A description of a failure that does not depend on the bounds, or None."""
        if self.cost.outcome != "ok":
            return f"it did not end well: {self.cost.outcome}"
        return difference(self.bars, self.program_bars)

    def excess(self, cpu_bound, memory_bound):
        """A description of how the result exceeds the bounds, or None."""
        beyond = []
        if self.cost.cpu > max(cpu_bound * self.program.cpu, self.program.cpu + self.cpu_floor):
            beyond.append(f"{self.cpu_ratio:.3g} times the CPU time ({self.cost.cpu:.3f} s, {PROGRAM} "
                          f"{self.program.cpu:.3f} s), allowed {cpu_bound:g}")
        if self.cost.peak > max(memory_bound * self.program.peak, self.program.peak + MEMORY_FLOOR):
            beyond.append(f"{self.memory_ratio:.3g} times the memory ({self.cost.peak:.0f} MB, {PROGRAM} "
                          f"{self.program.peak:.0f} MB), allowed {memory_bound:g}")
        return "; ".join(beyond) or None


def difference(ours, theirs):
    """A description of the first difference between two summaries of bars, or None."""
    if ours is None or theirs is None:
        return "no bars were printed"
    for dim, (count, lengths) in theirs.items():
        found, sum_found = ours.get(dim, (0, 0.0))
        if found != count:
            return f"H{dim}: {found} bars, {PROGRAM} {count}"
        if not math.isclose(sum_found, lengths, rel_tol=LENGTHS_AGREE):
            return f"H{dim}: the bars are {sum_found!r} long together, {PROGRAM}'s {lengths!r}"
    return None


def summary_of_csv(text, max_dim):
    """The summary of the bars that ph-barcode writes."""
    lengths, counts = {d: [] for d in range(max_dim + 1)}, dict.fromkeys(range(max_dim + 1), 0)
    for dim, birth, death in list(csv.reader(text.splitlines()))[1:]:
        counts[int(dim)] += 1
        if math.isfinite(float(death)):
            lengths[int(dim)].append(float(death) - float(birth))
    return {d: (counts[d], math.fsum(lengths[d])) for d in counts}


def summary(text):
    """The summary of the bars that a door prints."""
    return {int(dim): (int(count), float(lengths)) for dim, count, lengths in map(str.split, text.splitlines())}


class Comparison:
    def __init__(self, options, folder):
        self.options, self.folder = options, folder
        self.meter = Meter(options.build / "bench/bench_run", Limits(options.time_limit, options.memory_limit),
                           options.repeat, options.together)

    def commands(self, files, max_dim, prints=False):
        return commands(self.options.build, files, max_dim, self.options.python, prints)

    def measured(self, row, files):
        """The cost of each door on the input, and on ten points, which measures the start of the
        door. The doors take turns."""
        ten = Files(self.folder, "ten", distances(10) if row.is_matrix else uniform(10, 2), row.is_matrix)
        calls, starts = self.commands(files, row.max_dim), self.commands(ten, row.max_dim)
        runs = self.meter.best_in_turns([*calls.values(), *starts.values()])
        return dict(zip(calls, runs)), dict(zip(starts, runs[len(calls):]))

    def bars(self, door, command, max_dim):
        with tempfile.TemporaryFile("w+") as output:
            run = self.meter.run(command, stdout=output)
            output.seek(0)
            text = output.read()
        if not run.ok:
            return None
        return summary_of_csv(text, max_dim) if door == PROGRAM else summary(text)

    def results(self, row):
        files = Files(self.folder, "input", row.make(), row.is_matrix)
        runs, starts = self.measured(row, files)
        program = Cost(runs[PROGRAM].cpu, runs[PROGRAM].peak, runs[PROGRAM].outcome)
        if program.outcome != "ok":
            raise SystemExit(f"{row.name}: {PROGRAM}: {program.outcome}")
        calls = self.commands(files, row.max_dim, prints=True)
        bars = {door: self.bars(door, calls[door], row.max_dim) for door, run in runs.items() if run.ok}
        for door, run in runs.items():
            if door != PROGRAM:
                start = max(starts[door].cpu - starts[PROGRAM].cpu, 0.0)
                start_peak = max(starts[door].peak - starts[PROGRAM].peak, 0.0)
                cost = Cost(max(run.cpu - start, 1e-4), max(run.peak - start_peak, 1e-4), run.outcome)
                yield Result(row.name, door, cost, program, bars.get(door), bars[PROGRAM], start)


def ratio(taken, of_program, floor):
    return "≈ 1" if abs(taken - of_program) <= floor else f"{taken / of_program:.3g}"


def line(row, results):
    """A line of the table in Markdown."""
    by_door = {result.door: result for result in results}
    program = results[0].program
    cells = [f"{program.cpu:.3f} s, {program.peak:.0f} MB"]
    for door in DOORS:
        result = by_door.get(door)
        if result is None:
            cells.append("–")
        elif result.cost.outcome != "ok":
            cells.append(result.cost.outcome)
        else:
            cells.append(f"{ratio(result.cost.cpu, program.cpu, result.cpu_floor)} / "
                         f"{ratio(result.cost.peak, program.peak, MEMORY_FLOOR)}")
    return f"| {row.name} | " + " | ".join(cells) + " |"


def write_csv(path, results):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["input", "door", "outcome", "cpu_s", "peak_mb", "program_cpu_s", "program_peak_mb",
                         "cpu_ratio", "memory_ratio"])
        for r in results:
            writer.writerow([r.row, r.door, r.cost.outcome, f"{r.cost.cpu:.4f}", f"{r.cost.peak:.2f}",
                             f"{r.program.cpu:.4f}", f"{r.program.peak:.2f}", f"{r.cpu_ratio:.3f}",
                             f"{r.memory_ratio:.3f}"])


def faults(results, bounds):
    """A line for each door that fails, finds other bars, or exceeds the bounds.
    @param bounds ratios of CPU time and memory; None for no bounds."""
    for result in results:
        for said in (result.fault(), bounds and result.excess(*bounds)):
            if said:
                yield f"{result.row}: {result.door}: {said}"


def confirmed(measure, bounds, again=2):
    """The results of a row. While they exceed the bounds, the row is measured again, up to `again`
    times: on a busy machine the start of a door varies, but a door that costs too much does so each
    time. A door that fails or finds other bars is not tried again."""
    results = list(measure())
    for _ in range(again):
        if any(faults(results, None)) or not any(faults(results, bounds)):
            break
        results = list(measure())
    return results


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=lambda path: pathlib.Path(path).resolve(),
                        help="build folder, with ph-barcode and the programs of bench/")
    parser.add_argument("--large", action="store_true", help="10 000 distances, and 20 000 points of R³ for H1")
    parser.add_argument("--scale", type=float, default=1.0, help="of the numbers of points (default: 1)")
    parser.add_argument("--rows", default="", help="only rows with this in their name")
    parser.add_argument("--csv", type=pathlib.Path, metavar="FILE", help="also write all figures")
    parser.add_argument("--check", type=float, nargs="*", metavar=("CPU", "MEMORY"),
                        help=f"largest ratios allowed (default: {CPU_BOUND} {MEMORY_BOUND})")
    parser.add_argument("--python", default=sys.executable)
    parser.add_argument("--repeat", type=int, default=3, help="runs of which the fastest counts (default: 3)")
    parser.add_argument("--together", type=float, default=0.5, metavar="SECONDS",
                        help="runs below 50 ms are repeated until they took this long together (default: 0.5)")
    parser.add_argument("--time-limit", type=int, default=600, metavar="SECONDS", help="CPU time of a run")
    parser.add_argument("--memory-limit", type=int, default=12 << 30, metavar="BYTES", help="private memory of a run")
    options = parser.parse_args()
    if options.check is not None and len(options.check) not in (0, 2):
        parser.error("--check: expected CPU and MEMORY, or nothing")
    return options


def main():
    options = parse()
    os.environ["PYTHONPATH"] = str(options.build / "python")
    os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"
    bounds = None if options.check is None else options.check or (CPU_BOUND, MEMORY_BOUND)
    chosen = [row for row in rows_of(options.scale, options.large) if options.rows in row.name]
    if not chosen:
        raise SystemExit(f"no row has {options.rows!r} in its name")
    results = []
    print(f"| input | {PROGRAM} | " + " | ".join(DOORS) + " |\n|" + "---|" * (len(DOORS) + 2))
    with tempfile.TemporaryDirectory() as folder:
        comparison = Comparison(options, pathlib.Path(folder))
        for row in chosen:
            some = confirmed(lambda: comparison.results(row), bounds)
            print(line(row, some), flush=True)
            results += some
    if options.csv:
        write_csv(options.csv, results)
    wrong = list(faults(results, bounds))
    print("\n".join(wrong), end="\n" * bool(wrong), file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
