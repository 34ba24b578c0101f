#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares Vietoris-Rips persistence in ph-barcode with other programs, on the same inputs, in one
run.

    compare_rips.py build/release --data FOLDER --peer 'Ripser 1.2.1 = ripser {options}'

A peer is NAME = COMMAND; the name includes the version. In the command, {options} stands for the
input in Ripser's options (--format F --dim D [--threshold T] FILE), and {threads} for the number of
threads (a command without {threads} is measured with one thread). Bars are compared in a separate
run. Words in [brackets] are used only in this run; [A|B] means A in this run and B in measured
runs. @FILE stands for the arguments in a file, one per line.

The script measures user + system CPU seconds and peak resident memory of whole processes, with
output discarded; bench/README.md explains how. Needs only the standard library.
"""
import argparse
import datetime
import json
import os
import pathlib
import platform
import re
import shlex
import subprocess
import sys
import tempfile

import agreement
import rips_rows
import rips_table
from measuring import SHORT, Limits, Meter
from rips_table import OURS

UNITS = {"KiB": 1 << 10, "MiB": 1 << 20, "GiB": 1 << 30}


class Program:
    """A program and how it is called. The same class serves for libph and its peers."""

    def __init__(self, name, command):
        self.name, self._command = name, command
        self.has_threads = "{threads}" in command

    def command(self, options, threads=1, prints=False):
        text = re.sub(r"\[([^|\]]*)\|?(.*?)\]", r"\1" if prints else r"\2", self._command)
        words = []
        for word in shlex.split(text):
            if word == "{options}":
                words += options
            else:
                words.append(word.replace("{threads}", str(threads)))
        return words

    def __str__(self):
        return self._command


def peer(text):
    name, equals, command = text.partition("=")
    if not equals or "{options}" not in command:
        raise argparse.ArgumentTypeError(f"{text!r}: expected NAME = COMMAND with {{options}} in it")
    return Program(name.strip(), command.strip())


def size(text):
    found = re.fullmatch(r"(\d+)(KiB|MiB|GiB)", text)
    if not found:
        raise argparse.ArgumentTypeError(f"{text!r}: expected a size such as 16GiB")
    return int(found[1]) * UNITS[found[2]]


def our_program(path, choice=""):
    return Program(f"{OURS} {choice}".strip(), f"{shlex.quote(str(path))} --quiet --threads {{threads}} {{options}} "
                                               f"{choice} --output-format [ripser|none]")


def ripser_options(row, path):
    options = ["--format", "binary" if rips_rows.is_matrix(path) else "point-cloud", "--dim", str(row.max_dim)]
    if row.threshold is not None:
        options += ["--threshold", f"{row.threshold:g}"]
    return options + [str(path)]


def our_options(row, path):
    options = ["--format", "binary" if rips_rows.is_matrix(path) else "points", "--complex", "rips",
               "--max-dim", str(row.max_dim)]
    if row.threshold is not None:
        options += ["--threshold", f"{row.threshold:g}"]
    return options + [str(path)]


class Comparison:
    def __init__(self, arguments, made):
        self.arguments, self.made = arguments, made
        self.ours = our_program(arguments.build / "apps/barcode/ph-barcode")
        self._choices = [our_program(arguments.build / "apps/barcode/ph-barcode", c) for c in arguments.choice]
        self._limit_program = arguments.build / "bench/bench_rips_limit"
        self._meter = Meter(arguments.build / "bench/bench_run",
                            Limits(arguments.time_limit, arguments.memory_limit), arguments.repeat,
                            arguments.together)
        self._startups = {}

    def programs(self, row):
        wanted = self.arguments.only
        for program in [self.ours, *self._choices, *(self.arguments.peer if row.peers else [])]:
            if not wanted or any(program.name.startswith(name) for name in wanted):
                yield program

    @staticmethod
    def options(program, row, path):
        return (our_options if rips_table.is_ours(program.name) else ripser_options)(row, path)

    def startup(self, program, row, path, threads):
        """The CPU seconds that the same command takes for an input of only two points."""
        options = self.options(program, rips_rows.Row("two points", row.max_dim),
                               rips_rows.write_two_points(path, self.made))
        command = tuple(program.command(options, threads))
        if command not in self._startups:
            taken = self._meter.best(command)
            self._startups[command] = taken.cpu if taken.ok else 0.0
        return self._startups[command]

    def measure(self, row, path):
        """The time and memory of each program with each number of threads; the programs take
        turns."""
        calls = calls_of(self.programs(row), self.arguments.threads)
        runs = self._meter.best_in_turns([program.command(self.options(program, row, path), threads)
                                          for program, threads in calls])
        for (program, threads), taken in zip(calls, runs):
            startup = self.startup(program, row, path, threads) if taken.cpu < SHORT else 0.0
            yield program, {"program": program.name, "threads": threads, "outcome": taken.outcome, "user": taken.user,
                            "system": taken.system, "wall": taken.wall, "peak_mb": taken.peak, "startup": startup,
                            "cpu": max(taken.cpu - startup, 1e-4)}

    def limit(self, path):
        kind = "binary" if rips_rows.is_matrix(path) else "points"
        command = lambda file: [self._limit_program, kind, file]
        taken = self._meter.best(command(path))
        startup = self._meter.best(command(rips_rows.write_two_points(path, self.made)))
        return {"cpu": max(taken.cpu - startup.cpu * (taken.cpu < SHORT), 1e-4), "peak_mb": taken.peak}

    def bars(self, program, row, path):
        with tempfile.TemporaryFile() as output:
            command = program.command(self.options(program, row, path), prints=True)
            ended = self._meter.run(command, stdout=output)
            output.seek(0)
            return agreement.read(output.read().decode(), row.max_dim) if ended.ok else None

    def check(self, row, path, programs):
        """Compares the bars of each program that completed its run with ours: "equal" or the first
        difference."""
        ours = self.bars(self.ours, row, path)
        result = {}
        for program in programs if ours is not None else []:
            theirs = self.bars(program, row, path)
            if theirs is not None:
                result[program.name] = agreement.difference(ours, theirs) or "equal"
        return result

    def row(self, row, path):
        result = {"name": row.name, "max_dim": row.max_dim, "threshold": row.threshold, "results": [], "bars": {}}
        finished = {}
        for program, entry in self.measure(row, path):
            result["results"].append(entry)
            print(rips_table.line(row.name, entry), file=sys.stderr, flush=True)
            if entry["outcome"] == "ok" and program.name != OURS:
                finished[program.name] = program
        if row.limit:
            result["limit"] = self.limit(path)
        if self.arguments.check:
            result["bars"] = self.check(row, path, finished.values())
            for name, said in result["bars"].items():
                if said != "equal":
                    print(f"{row.name}: {name}: {said}", file=sys.stderr, flush=True)
        return result


def merged(old, new):
    """The results of one row of an earlier run, with repeated measurements replaced."""
    key = lambda entry: (entry["program"], entry["threads"])
    results = {key(entry): entry for entry in [*old.get("results", []), *new["results"]]}
    return {**old, **new, "results": list(results.values()), "bars": {**old.get("bars", {}), **new["bars"]}}


def processor():
    try:
        with open("/proc/cpuinfo", encoding="ascii") as file:
            return next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.machine()


def add_options(parser):
    """Adds the options that all comparisons have."""
    parser.add_argument("--made", type=pathlib.Path, help="folder for generated inputs (default: a temporary one)")
    parser.add_argument("--threads", type=lambda text: [int(n) for n in text.split(",")], default=[1],
                        help="numbers of threads, comma-separated (default: 1)")
    parser.add_argument("--repeat", type=int, default=3, help="runs of which the fastest counts (default: 3)")
    parser.add_argument("--together", type=float, default=0.5, metavar="SECONDS",
                        help="runs below 50 ms are repeated until they took this long together (default: 0.5)")
    parser.add_argument("--time-limit", type=int, default=600, metavar="SECONDS", help="CPU time of a run")
    parser.add_argument("--memory-limit", type=size, metavar="SIZE", help="private memory of a run, such as 16GiB")
    parser.add_argument("--no-check", dest="check", action="store_false", help="do not compare the bars")
    parser.add_argument("--json", type=pathlib.Path, help="all results; what it holds already is kept or replaced")
    parser.add_argument("--list", action="store_true", help="print the names of the rows and end")


def calls_of(programs, threads):
    """Each program with each number of threads."""
    return [(program, n) for program in programs for n in (threads if program.has_threads else [1])]


def report_of(arguments):
    """@return the report, with the rows of an earlier run."""
    report = {"rows": []}
    if arguments.json and arguments.json.exists():
        report = json.loads(arguments.json.read_text())
    version = subprocess.run([arguments.build / "apps/barcode/ph-barcode", "--version"], capture_output=True,
                             text=True, check=True)
    report.update(machine=f"{processor()}, {os.cpu_count()} processors", date=str(datetime.date.today()),
                  version=version.stdout.strip(),
                  peers={**report.get("peers", {}), **{p.name: str(p) for p in arguments.peer}})
    return report


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     fromfile_prefix_chars="@")
    parser.add_argument("build", type=lambda path: pathlib.Path(path).resolve(),
                        help="build folder, with ph-barcode, bench_run and bench_rips_limit")
    parser.add_argument("--peer", type=peer, action="append", default=[], help="NAME = COMMAND, repeatable")
    parser.add_argument("--choice", action="append", default=[], metavar="WORDS",
                        help="also measure ph-barcode with these options, such as '--engine edge-links'; repeatable")
    parser.add_argument("--data", type=pathlib.Path, default=rips_rows.data_folder(),
                        help="folder of the inputs that are not generated (default: data in the folder that the "
                             "environment variable PH_TEST_DATA names, else shared/data beside the clone)")
    parser.add_argument("--rows", type=lambda text: text.split(","), help="names, comma-separated (default: all)")
    parser.add_argument("--only", action="append", default=[], metavar="NAME",
                        help="only programs whose name begins so, repeatable")
    add_options(parser)
    return parser.parse_args()


def chosen_rows(names):
    rows = {row.name: row for row in rips_rows.ROWS}
    if names is None:
        return [row for row in rips_rows.ROWS if row.usual]
    if unknown := [name for name in names if name not in rows]:
        raise SystemExit(f"no such row: {', '.join(unknown)}; --list names them")
    return [rows[name] for name in names]


def save(path, report):
    part = path.with_name(path.name + ".part")
    part.write_text(json.dumps(report, indent=1) + "\n")
    os.replace(part, path)


def main():
    arguments = parse()
    if arguments.list:
        print("\n".join(row.name for row in rips_rows.ROWS))
        return
    report = report_of(arguments)
    with tempfile.TemporaryDirectory() as folder:
        made = arguments.made or pathlib.Path(folder)
        made.mkdir(parents=True, exist_ok=True)
        comparison = Comparison(arguments, made)
        known = {row["name"]: row for row in report["rows"]}
        for row in chosen_rows(arguments.rows):
            path = rips_rows.input_file(row, arguments.data, made)
            if path is None:
                print(f"{row.name}: not in {arguments.data}, left out", file=sys.stderr)
                continue
            known[row.name] = merged(known.get(row.name, {}), comparison.row(row, path))
            order = [r.name for r in rips_rows.ROWS]
            report["rows"] = sorted(known.values(), key=lambda r: order.index(r["name"]))
            if arguments.json:
                save(arguments.json, report)
    print(rips_table.markdown(report))
    if any(said != "equal" for row in report["rows"] for said in row["bars"].values()):
        raise SystemExit(1)


if __name__ == "__main__":
    main()
