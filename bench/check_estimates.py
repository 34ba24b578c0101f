#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the predictions of --dry-run with the true values, on the inputs of compare_rips.py.

check_estimates.py build/release --data FOLDER

For each row, the script compares the predicted memory interval with the additional memory of the
run: its peak resident memory minus the peak of a program that only starts. It also compares the
predicted numbers of cells with the counted numbers. The program that only starts gets small pages,
because a large page for its first bytes would hide how much memory the run needs. The exit code is
1 if a peak lies outside its interval or a number of cells is off by more than a factor of 2.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

import compare_rips
import rips_rows
import rips_table
from measuring import Limits, Meter

UNITS = {"B": 1, "KiB": 1 << 10, "MiB": 1 << 20, "GiB": 1 << 30, "TiB": 1 << 40}
START_SLACK = 1.0  # MB; pages of code count only once they are used


def size(text):
    number, unit = text.split()
    return float(number) * UNITS[unit]


class Foreseen:
    """The predictions that --dry-run printed."""

    def __init__(self, text):
        self.engine = re.search(r"engine +(\w+)", text)[1]
        self.collapses = bool(re.search(r"collapse +on", text))
        low, high = re.search(r"memory +(.+) to (.+)", text).groups()
        self.low, self.high = size(low) / 1e6, size(high) / 1e6  # MB
        self.cells = [int(n) for n in re.findall(r"cells +dimension \d+: (?:about )?(\d+)$", text, re.MULTILINE)]


class Checker:
    def __init__(self, build, seconds, made):
        self.build, self.made = build, made
        self.program = compare_rips.our_program(build / "apps/barcode/ph-barcode")
        self.meter = Meter(build / "bench/bench_run", Limits(seconds), 1, 0)
        self.start_meter = Meter(build / "bench/bench_run", Limits(seconds, small_pages=True), 1, 0)

    def run(self, row, path, *more, stdout=subprocess.DEVNULL, meter=None):
        return (meter or self.meter).run(self.program.command(compare_rips.our_options(row, path)) + list(more), stdout)

    def foreseen(self, row, path):
        with tempfile.TemporaryFile() as output:
            taken = self.run(row, path, "--dry-run", stdout=output)
            output.seek(0)
            return (Foreseen(output.read().decode()) if taken.ok else None), taken

    def cells(self, row, path, foreseen):
        command = [self.build / "bench/bench_cells", "binary" if rips_rows.is_matrix(path) else "points", path,
                   len(foreseen.cells) - 1, "-" if row.threshold is None else row.threshold,
                   "collapse" if foreseen.collapses else "plain"]
        with tempfile.TemporaryFile() as output:
            taken = self.meter.run(command, output)
            output.seek(0)
            return [int(n) for n in output.read().split()] if taken.ok else None

    def row(self, row, path):
        """@return a line of the table, and True if all predictions hold."""
        two = rips_rows.write_two_points(path, self.made)
        start = self.run(rips_rows.Row("two points", row.max_dim), two, meter=self.start_meter).peak
        foreseen, dry = self.foreseen(row, path)
        if foreseen is None:
            return [row.name, f"dry run: {dry.outcome}", "", "", "", ""], False
        whole = self.run(row, path)
        if not whole.ok:
            return [row.name, "", whole.outcome, "", "", ""], True
        peak = max(0.0, whole.peak - start)
        holds = foreseen.low - START_SLACK <= peak <= foreseen.high + START_SLACK
        counted = self.cells(row, path, foreseen)
        near = counted is None or all(a <= 2 * b and b <= 2 * a for a, b in zip(foreseen.cells, counted))
        ratio = max((max(a, 1) / max(b, 1) for a, b in zip(foreseen.cells, counted or [])),
                    key=lambda r: max(r, 1 / r), default=1)
        return [row.name, foreseen.engine + (", collapse" if foreseen.collapses else ""),
                f"{rips_table.number(foreseen.low)} to {rips_table.number(foreseen.high)}"
                + ("" if holds else " **no**"),
                rips_table.number(peak), " ".join(map(str, foreseen.cells)),
                ("counting took too long" if counted is None else f"{ratio:.3f}" + ("" if near else " **no**")),
                f"{rips_table.number(dry.cpu)} of {rips_table.number(whole.cpu)}"], holds and near


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=lambda path: pathlib.Path(path).resolve(),
                        help="build folder, with ph-barcode, bench_run and bench_cells")
    parser.add_argument("--data", type=pathlib.Path, default=rips_rows.data_folder(),
                        help="folder of the inputs that are not generated (default: data in the folder that the "
                             "environment variable PH_TEST_DATA names, else shared/data beside the clone)")
    parser.add_argument("--made", type=pathlib.Path, help="folder for generated inputs (default: a temporary one)")
    parser.add_argument("--rows", type=lambda text: text.split(","), help="names, comma-separated (default: all)")
    parser.add_argument("--time-limit", type=int, default=60, metavar="SECONDS",
                        help="CPU time of a run; rows that take longer are left out (default: 60)")
    arguments = parser.parse_args()
    all_hold, lines = True, []
    with tempfile.TemporaryDirectory() as folder:
        made = arguments.made or pathlib.Path(folder)
        made.mkdir(parents=True, exist_ok=True)
        checker = Checker(arguments.build, arguments.time_limit, made)
        for row in rips_rows.ROWS:
            if arguments.rows is not None and row.name not in arguments.rows:
                continue
            path = rips_rows.input_file(row, arguments.data, made)
            if path is None:
                print(f"{row.name}: not in {arguments.data}, left out", file=sys.stderr)
                continue
            line, holds = checker.row(row, path)
            print(" | ".join(line), file=sys.stderr, flush=True)
            lines.append(line)
            all_hold = all_hold and holds
    print(rips_table.table(["input", "engine", "foreseen, MB", "peak, MB", "cells listed", "worst: foreseen / counted",
                            "CPU seconds: dry run of run"], lines))
    raise SystemExit(0 if all_hold else 1)


if __name__ == "__main__":
    main()
