#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares cubical persistence in ph-barcode with other programs, on the same images, in one run.

    compare_images.py build/release --peer 'OTHER 1.0 = construction=cells PROGRAM {input} [--print]'

A peer is NAME = COMMAND; the name includes the version. The command is preceded by
construction=vertices or construction=cells, which names the construction to compare, and by axes=N
if it accepts only images with N axes. In the command, {input} is a .npy file of float64 in C order
and {threads} the number of threads (a command without {threads} is measured with one thread). Bars
are compared in a separate run. Words in [brackets] are used only in this run; [A|B] means A in this
run and B in measured runs. In this run, the peer prints one bar per line, as `dim birth death`.
@FILE stands for the arguments in a file, one per line.

The script measures user + system CPU seconds and peak resident memory of whole processes, including
reading the image, with output discarded; bench/README.md explains how. Needs numpy.
"""
import argparse
import math
import pathlib
import re
import shlex
import sys
import tempfile

import image_rows
import rips_table
from compare_rips import Program, add_options, calls_of, merged, report_of, save
from measuring import Limits, Meter
from rips_table import OURS

CONSTRUCTIONS = ("vertices", "cells")


class Peer(Program):
    """A program to compare with. Words before its command state its construction and number of
    axes."""

    def __init__(self, name, command):
        self.construction, self.axes, words = None, None, []
        for word in command.split():
            if found := re.fullmatch("construction=(vertices|cells)", word):
                self.construction = found[1]
            elif found := re.fullmatch(r"axes=(\d+)", word):
                self.axes = int(found[1])
            else:
                words.append(word)
        super().__init__(name, " ".join(words).replace("{input}", "{options}"))

    def takes(self, row, construction):
        return self.construction == construction and self.axes in (None, len(row.shape))


def peer(text):
    name, equals, command = text.partition(" = ")
    program = Peer(name.strip(), command)
    if not equals or "{input}" not in command or program.construction is None:
        raise argparse.ArgumentTypeError(f"{text!r}: expected NAME = construction=… COMMAND with {{input}} in it")
    return program


def bars_of(text):
    """The sorted bars of a text with lines `dim birth death` or `dim,birth,death`; programs write
    infinity in several ways."""
    bars = []
    for line in text.splitlines():
        words = re.split(r"[\s,]+", line.strip())
        if len(words) < 3 or not words[0].isdigit():
            continue
        birth, death = float(words[1]), float(words[2])
        bars.append((int(words[0]), birth, math.inf if death > 1e300 else death))
    return sorted(bars)


def difference(ours, theirs):
    """The first bar that is in only one of the lists, or None."""
    if ours == theirs:
        return None
    first = next((pair for pair in zip(ours, theirs) if pair[0] != pair[1]), ("no more bars", "or ours has none"))
    return f"{len(ours)} bars of ours, {len(theirs)} of theirs; {first[0]} and {first[1]}"


class Comparison:
    def __init__(self, arguments):
        self._arguments = arguments
        self._meter = Meter(arguments.build / "bench/bench_run", Limits(arguments.time_limit, arguments.memory_limit),
                            arguments.repeat, arguments.together)

    def programs(self, row, construction):
        ours = shlex.quote(str(self._arguments.build / "apps/barcode/ph-barcode"))
        yield Program(OURS, f"{ours} {{options}} --quiet --threads {{threads}} --construction {construction} "
                            "--output-format [pers|none]")
        for program in self._arguments.peer:
            if program.takes(row, construction):
                yield program

    def _bars(self, program, path):
        with tempfile.TemporaryFile() as output:
            ended = self._meter.run(program.command([str(path)], prints=True), stdout=output)
            output.seek(0)
            return bars_of(output.read().decode()) if ended.ok else None

    def row(self, row, construction, path):
        name = f"{row.name}, {construction}"
        result = {"name": name, "results": [], "bars": {}}
        calls = calls_of(self.programs(row, construction), self._arguments.threads)
        runs = self._meter.best_in_turns([program.command([str(path)], threads) for program, threads in calls])
        finished = {}
        for (program, threads), taken in zip(calls, runs):
            result["results"].append({"program": program.name, "threads": threads, "outcome": taken.outcome,
                                      "user": taken.user, "system": taken.system, "cpu": max(taken.cpu, 1e-4),
                                      "wall": taken.wall, "peak_mb": taken.peak})
            print(rips_table.line(name, result["results"][-1]), file=sys.stderr, flush=True)
            if taken.ok:
                finished[program.name] = program
        ours = None
        for program in finished.values() if self._arguments.check else []:
            found = self._bars(program, path)
            if program.name == OURS:
                ours = found
            elif found and ours is not None:  # some programs cannot print their bars
                result["bars"][program.name] = difference(ours, found) or "equal"
                print(f"{name}: {program.name}: bars {result['bars'][program.name]}", file=sys.stderr, flush=True)
        reading = self._meter.best(["cat", path])
        result["limit"] = {"cpu": max(reading.cpu, 1e-4), "peak_mb": reading.peak}
        return result


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     fromfile_prefix_chars="@")
    parser.add_argument("build", type=lambda path: pathlib.Path(path).resolve(),
                        help="build folder, with ph-barcode and bench_run")
    parser.add_argument("--peer", type=peer, action="append", default=[], help="NAME = COMMAND, repeatable")
    parser.add_argument("--scans", type=pathlib.Path, default=pathlib.Path(),
                        help="folder of the scans that --rows names: skull_2.9.inr, ch2.nii.gz")
    parser.add_argument("--rows", type=lambda text: text.split(","), help="names, comma-separated (default: the usual)")
    parser.add_argument("--construction", choices=CONSTRUCTIONS, action="append", help="repeatable (default: both)")
    add_options(parser)
    return parser.parse_args()


def main():
    arguments = parse()
    if arguments.list:
        print("\n".join(row.name for row in image_rows.ROWS))
        return
    rows = [row for row in image_rows.ROWS if (row.name in arguments.rows if arguments.rows else row.usual)]
    if arguments.rows and (unknown := set(arguments.rows) - {row.name for row in rows}):
        raise SystemExit(f"no such row: {', '.join(sorted(unknown))}; --list names them")
    report = report_of(arguments)
    known = {row["name"]: row for row in report["rows"]}
    with tempfile.TemporaryDirectory() as folder:
        made = arguments.made or pathlib.Path(folder)
        made.mkdir(parents=True, exist_ok=True)
        comparison = Comparison(arguments)
        for row in rows:
            path = image_rows.input_file(row, made, arguments.scans)
            for construction in arguments.construction or CONSTRUCTIONS:
                result = comparison.row(row, construction, path)
                known[result["name"]] = merged(known.get(result["name"], {}), result)
                report["rows"] = list(known.values())
                if arguments.json:
                    save(arguments.json, report)
    print(rips_table.markdown(report, limit="read once"))
    if any(said != "equal" for row in report["rows"] for said in row["bars"].values()):
        raise SystemExit(1)


if __name__ == "__main__":
    main()
