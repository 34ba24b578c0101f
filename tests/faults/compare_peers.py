#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""compare_peers.py PH_BARCODE PH_SEGMENT PEAK READ_WITH_PCL [-v]: runs the corpus of faults through
our programs and through other programs that read the same formats. Writes the table of
docs/explanation/reliability.md between its two markers. Run by hand; `-v` prints each run. Needs
ripser and python3-gudhi."""
import collections
import contextlib
import dataclasses
import os
import re
import resource
import subprocess
import sys
import tempfile

import corpus
from entry import FORMS, of_file, sample, set_up

HERE = os.path.dirname(os.path.abspath(__file__))
PAGE = os.path.join(HERE, os.pardir, os.pardir, "docs", "explanation", "reliability.md")
BEGIN, END = "<!-- compare_peers.py writes from here -->", "<!-- to here -->"
SECONDS = 20
ADDRESS_SPACE = 8 << 30
MOST_KIB = 1 << 20

CLEAN, RIGHT, REFUSED, WRONG, CRASH, ENDLESS = KINDS = (
    "clean error", "valid, right", "valid, refused", "wrong answer", "crash", "hang or > 1 GiB")

GROUPS = {
    "points": ("points",), "distances": ("distance", "lower-distance", "upper-distance"),
    "sparse": ("sparse",), "DIPHA": ("dipha",), "OFF": ("off",), "Perseus": ("perseus",),
    "PCD": ("pcd",), "PLY": ("ply",),
}
GROUP_OF_FORM = {form: group for group, forms in GROUPS.items() for form in forms}
# Ripser's format `binary` is left out: Debian's build aborts on valid files.
RIPSER_FORMATS = {"points": "point-cloud", "distance": "distance", "lower-distance": "lower-distance",
                  "upper-distance": "upper-distance", "sparse": "sparse", "dipha": "dipha"}
# Misuse that both command lines allow: our arguments, and Ripser's.
COMMANDS = [
    (["--max-dim", "-1"], ["--dim", "-1"]),
    (["--max-dim", "x"], ["--dim", "x"]),
    (["--max-dim", "1.5"], ["--dim", "1.5"]),
    (["--max-dim", "99999999999999999999"], ["--dim", "99999999999999999999"]),
    (["--max-dim"], ["--dim"]),
    (["--threshold", "nan"], ["--threshold", "nan"]),
    (["--threshold", "1,5"], ["--threshold", "1,5"]),
    (["--threshold=-1"], ["--threshold", "-1"]),
    (["--max-scale"], ["--threshold"]),
    (["--format", "lowerdistance"], ["--format", "lowerdistance"]),
    (["--no-such-thing-at-all"], ["--no-such-thing-at-all"]),
    (["square.txt"], ["square.txt"]),
]


class Run:
    """The outcome of a command: how it ended, and its output."""
    def __init__(self, peak, command, folder, options):
        report = os.path.join(folder, os.pardir, "report")
        open(report, "wb").close()
        limit = (ADDRESS_SPACE, ADDRESS_SPACE)
        options = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, **options}
        content = options.pop("input", None)
        if content is not None:
            options["stdin"] = subprocess.PIPE
        with subprocess.Popen([peak, report, *command], cwd=folder, stderr=subprocess.PIPE,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, limit),
                              **options) as run:
            self.timed_out = False
            try:
                out, err = run.communicate(content, timeout=SECONDS)
            except subprocess.TimeoutExpired:
                run.kill()
                out, err = run.communicate()
                self.timed_out = True
        self.out = (out or b"").decode("utf-8", "replace")
        self.err = (err or b"").decode("utf-8", "replace")
        self.code = run.returncode
        with open(report, encoding="ascii") as file:
            self.kib = int((file.read().split() or ["0"])[0])

    def kind(self, expected, result):
        """@param expected the right result of a valid file; None if the file is faulty.
        @param result the computed result; empty if there is none."""
        if self.timed_out or self.kib > MOST_KIB:
            return ENDLESS
        if self.code < 0:
            return CRASH
        # A message without a result is an error as well, whatever the exit code.
        if self.code != 0 or (not result and self.err.strip() and expected is None):
            return CLEAN if expected is None else REFUSED
        return RIGHT if expected is not None and same(result, expected) else WRONG


def same(result, expected):
    if isinstance(expected, int):
        return result == expected
    return len(result) == len(expected) and all(
        len(a) == len(b) and a[0] == b[0] and all(x == y or abs(x - y) <= 1e-5 * abs(y)
                                                  for x, y in zip(a[1:], b[1:]))
        for a, b in zip(result, expected))


def bars_of_rows(text):
    """The bars in lines `dim birth death`, or in our CSV."""
    rows = [re.split(r"[ ,]+", line.strip()) for line in text.splitlines()]
    bars = [(int(r[0]), float(r[1]), float(r[2])) for r in rows
            if len(r) == 3 and r[0].isdigit()]
    return sorted(bar for bar in bars if bar[1] != bar[2])


def bars_of_ripser(text):
    bars, dim = [], None
    for line in text.splitlines():
        if found := re.match(r"persistence intervals in dim (\d+)", line):
            dim = int(found[1])
        elif found := re.match(r" \[([^,]+), ?([^)]*)\)", line):
            bars.append((dim, float(found[1]), float(found[2] or "inf")))
    return sorted(bar for bar in bars if bar[1] != bar[2])


def points_of_pcl(text):
    """The number of points, which is in the last line. PCL prints its messages before it."""
    lines = text.split()
    return int(lines[-1]) if lines and lines[-1].isdigit() else 0


def content_of(entry):
    return next(iter(entry.files.values()))


def is_for_peers(entry):
    """True if the entry is a fair test of other programs: a file read in its own format without
    options. Entries that only test rules of libph are left out: lines that are too long for libph,
    infinity as text, data after the declared end (the preceding data may be complete), and packed
    files."""
    options = set(entry.arguments[1:]) - {"--check", "--format", *FORMS[entry.form].options, entry.form}
    return (entry.row not in (8, 41) and not (entry.row in (10, 11) and entry.code == 0)
            and not content_of(entry).startswith(b"\x1f\x8b")
            and (not options or entry.program == "ph-segment"))


class Ripser:
    name, parse = "Ripser", staticmethod(bars_of_ripser)

    def takes(self, entry):
        if entry.form not in RIPSER_FORMATS or not is_for_peers(entry):
            return False
        if entry.form == "dipha":  # of DIPHA's files, Ripser reads only distance matrices
            return content_of(entry)[8:9] == b"\7" or len(content_of(entry)) < 16
        # Ripser's formats have no header rows. Ripser computes in single precision, as its
        # documentation says.
        return entry.code != 0 or entry.row not in (18, 88, 89)

    def command(self, entry, _folder, file):
        return ["/usr/bin/ripser", "--format", RIPSER_FORMATS[entry.form], file]


class Gudhi:
    name, parse = "GUDHI", staticmethod(bars_of_rows)

    def takes(self, entry):
        content = content_of(entry)
        if entry.form not in ("lower-distance", "off", "perseus") or not is_for_peers(entry):
            return False
        if entry.form == "lower-distance":  # GUDHI expects one row per line
            return b"\n" in content.rstrip(b"\n")
        # GUDHI reads only the points of OFF files, as its documentation says.
        if entry.form == "off":
            return not re.match(rb"OFF\s(#.*\s)?\d+ -?[1-9]", content)
        # GUDHI supports neither infinity nor periodic axes nor Perseus' list of cubes.
        return (b"inf" not in content and b"\n-" not in content and "cube" not in entry.name
                and "coordinate" not in entry.name)

    def command(self, entry, folder, file):
        content = content_of(entry)
        # GUDHI's triangle begins with an empty row and has semicolons.
        if entry.form == "lower-distance":
            content = b"\n" + content.replace(b" ", b";")
        elif entry.form == "perseus":  # GUDHI expects one number per line
            content = re.sub(b"[ \t]+", b"\n", content)
        else:  # GUDHI expects the counts on a separate line
            content = re.sub(rb"^OFF ", b"OFF\n", content)
        with open(os.path.join(folder, file), "wb") as copy:
            copy.write(content)
        return ["/usr/bin/python3", os.path.join(HERE, "read_with_gudhi.py"), entry.form, file]


class Pcl:
    name, parse = "PCL", staticmethod(points_of_pcl)

    def __init__(self, program):
        self.program = os.path.abspath(program)

    def takes(self, entry):
        return entry.form in ("pcd", "ply") and is_for_peers(entry)

    def command(self, _entry, _folder, file):
        return [self.program, file]


class Ours:
    name = "libph"

    def __init__(self, barcode, segment):
        self.programs = {"ph-barcode": os.path.abspath(barcode), "ph-segment": os.path.abspath(segment)}

    def command(self, entry, _folder, _file):
        return [self.programs[entry.program], *entry.arguments]

    @staticmethod
    def parse(text):
        return bars_of_rows(text) if text.startswith("dim,") else text


def expected_of(entry, peer):
    """@return the right result for this peer, or None for a faulty file."""
    if entry.code != 0:
        return None
    if peer.name == "PCL":
        return entry.output.count("\n")
    return peer.parse(entry.output) if peer.name == "libph" else bars_of_rows(entry.output)


def try_entry(entry, peer, peak):
    with set_up(entry) as (folder, options):
        file = next(iter(entry.files), "")
        run = Run(peak, peer.command(entry, folder, file), folder, options)
    return run, run.kind(expected_of(entry, peer), peer.parse(run.out))


def try_command(command, parse, peak):
    with tempfile.TemporaryDirectory() as outer:
        folder = os.path.join(outer, "here")
        os.mkdir(folder)
        with open(os.path.join(folder, "square.txt"), "w", encoding="ascii") as file:
            file.write("0 0\n1 0\n1 1\n0 1.25\n")
        run = Run(peak, command, folder, {})
    return run, run.kind(None, parse(run.out))


SOUND = {"points": ("points", "blank.txt"), "distance": ("distances", "full.txt"),
         "lower-distance": ("lower_distances", "lower.txt"),
         "upper-distance": ("upper_distances", "upper.txt"), "sparse": ("sparse", "sparse.txt"),
         "dipha": ("distances", "distances.dipha"),
         "off": ("off", "points.off"), "perseus": ("perseus", "grid.perseus"), "pcd": ("pcd", "ascii.pcd"),
         "ply": ("ply", "ascii.ply")}


def calibrate(ours, peers, peak):
    """Runs all programs on valid files. If a peer fails on one of these files, it was called in the
    wrong way, and no table is written."""
    for form, place in SOUND.items():
        options = ("--labels", "-") if FORMS[form].program == "ph-segment" else ()
        if form == "perseus":
            options = ("--construction", "cells")
        entry = of_file(1, form, "sound", sample(*place), (), code=0, output="")
        own = dataclasses.replace(entry, arguments=(*entry.arguments, *options))
        entry = dataclasses.replace(entry, output=try_entry(own, ours, peak)[0].out)
        for peer in peers:
            if peer.takes(entry) and (found := try_entry(entry, peer, peak))[1] != RIGHT:
                sys.exit(f"{peer.name} on a sound {form} file: {found[1]}: {found[0].out}{found[0].err}")


def all_runs(ours, peers, peak):
    """Yields the group, the name of the program, what was tried, the run, and the kind of
    outcome."""
    for entry in corpus.ENTRIES:
        if entry.form in GROUP_OF_FORM:
            for peer in (ours, *(p for p in peers if p.takes(entry))):
                yield (GROUP_OF_FORM[entry.form], peer.name, f"row {entry.row}, {entry.name}",
                       *try_entry(entry, peer, peak))
    for own, theirs in COMMANDS:
        yield ("command line", "libph", " ".join(own), *try_command(
            [ours.programs["ph-barcode"], "square.txt", *own], bars_of_rows, peak))
        yield ("command line", "Ripser", " ".join(theirs), *try_command(
            ["/usr/bin/ripser", "--format", "point-cloud", "square.txt", *theirs], bars_of_ripser, peak))


def table(counts):
    """@param counts maps (group, program) to a counter of outcomes."""
    lines = [f"| input | program | tried | {' | '.join(KINDS)} |", "|---|---|" + "--:|" * (len(KINDS) + 1)]

    def line(group, program, found):
        cells = (str(found[kind] or "") for kind in KINDS)
        lines.append(f"| {group} | {program} | {sum(found.values())} | {' | '.join(cells)} |")

    totals = collections.defaultdict(collections.Counter)
    for group in (*GROUPS, "command line"):
        for (of_group, program), found in counts.items():
            if of_group == group:
                line(group, program, found)
                totals[program] += found
    for program, found in totals.items():
        line("**all**", f"**{program}**", found)
    return "\n".join(lines)


def versions():
    installed = subprocess.run(["dpkg-query", "-W", "-f", "${Package} ${Version}\n", "ripser",
                                "python3-gudhi", "libpcl-io1.13"], capture_output=True, text=True,
                               check=False).stdout.split("\n")
    return ", ".join(filter(None, installed))


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    barcode, segment, peak, pcl = sys.argv[1:5]
    verbose = "-v" in sys.argv[5:]
    ours = Ours(barcode, segment)
    peers, peak = [Ripser(), Gudhi(), Pcl(pcl)], os.path.abspath(peak)
    calibrate(ours, peers, peak)
    counts = collections.defaultdict(collections.Counter)
    for group, program, what, run, kind in all_runs(ours, peers, peak):
        counts[group, program][kind] += 1
        if verbose:
            last = (run.err.strip().splitlines() or run.out.strip().splitlines() or [""])[-1]
            print(f"{program}: {what}: {kind} (exit code {run.code}, {run.kib} KiB): {last[:150]}")
    text = f"{BEGIN}\n{table(counts)}\n\nDebian 12: {versions()}.\n{END}"
    with contextlib.suppress(FileNotFoundError), open(PAGE, encoding="utf-8") as file:
        page = file.read()
        before, rest = page.split(BEGIN)
        with open(PAGE, "w", encoding="utf-8") as out:
            out.write(before + text + rest.split(END)[1])
    print(text)


if __name__ == "__main__":
    main()
