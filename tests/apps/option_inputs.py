# SPDX-License-Identifier: MIT
"""option_inputs.py PH_BARCODE PH_SEGMENT [TABLE.csv]: each option of each program with each kind of
input. It runs the program with and without the option; the option

* changes the result (exit code, standard output, files), or
* is obeyed in what is not the result: a message, a field of the JSON, how it is computed, or
* is refused (64) by name, or
* is said on standard error to do nothing.

Anything else is an option that was ignored without a word: SILENT, and the test fails. The options
are those that --help lists: one that has no row here fails, too. The table is written to TABLE.csv."""
import collections
import concurrent.futures
import csv
import json
import os
import re
import subprocess
import sys
import tempfile

import option_inputs_barcode
import option_inputs_segment

CHANGES, OBEYED, REFUSED, SAID, SILENT = "changes", "obeyed", "refused", "said", "SILENT"
VOLATILE = ("timings", "peak_memory", "stages", "table", "seconds")


class Row:
    """How an option is tried.

    arguments: those that are the option; `@name` is a file of the input.
    variant: of the input, where it has one: what makes the difference ("nan").
    beside: arguments of both runs. free: dropped from the input's own arguments.
    sign: a pattern that standard error has with the option only, in place of another result.
    lost: one that it has without the option only. default: whether the result is the same, for the
    option says what holds anyway.
    bad_data: whether it may turn good data into bad ones (65)."""

    def __init__(self, *arguments, variant="plain", beside=(), sign=None, lost=None,
                 default=False, bad_data=False):
        self.arguments, self.variant, self.beside = list(arguments), variant, list(beside)
        self.sign, self.lost, self.default, self.bad_data = sign, lost, default, bad_data


class Input:
    """A kind of input: its arguments, its files, and other contents of the first of them."""

    def __init__(self, name, arguments, files, rows=None, **variants):
        self.name, self.arguments, self.files = name, list(arguments), dict(files)
        self.rows, self.variants = rows or {}, variants

    def content(self, variant):
        files = dict(self.files)
        if variant in self.variants:
            files[next(iter(files))] = self.variants[variant]
        return files


def options_of(program):
    """All options of --help, each by its first long name."""
    text = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    found = []
    for line in text.splitlines():
        match = re.match(r"  (-[^ ]+)", line)
        if match:
            found.append(next(name for name in match[1].split(",") if name.startswith("--")))
    return found


def result_of(content):
    """JSON without what differs from run to run."""
    try:
        value = json.loads(content)
    except (ValueError, UnicodeDecodeError):
        return content
    for name in VOLATILE if isinstance(value, dict) else ():
        value.pop(name, None)
    return json.dumps(value)


class Run:
    def __init__(self, program, arguments, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, content in files.items():
                path = os.path.join(folder, name)
                os.makedirs(os.path.dirname(path), exist_ok=True)
                with open(path, "wb") as file:
                    file.write(content)
            run = subprocess.run([program, *arguments], cwd=folder, capture_output=True, timeout=60,
                                 stdin=subprocess.DEVNULL)
            self.code, self.stdout = run.returncode, result_of(run.stdout)
            self.stderr = run.stderr.decode(errors="replace")
            self.files = {}
            for where, _, names in os.walk(folder):
                for name in names:
                    path = os.path.join(where, name)
                    with open(path, "rb") as file:
                        self.files[os.path.relpath(path, folder)] = result_of(file.read())

    def result(self):
        return self.code, self.stdout, self.files


def without(arguments, option):
    """The arguments less an option and its value."""
    kept, skip = [], False
    for argument in arguments:
        if argument == option:
            skip = True
        elif skip and not argument.startswith("--"):
            skip = False
        else:
            kept, skip = kept + [argument], False
    return kept


def classify(program, option, row, kind):
    files = kind.content(row.variant)
    first = next(iter(kind.files))

    def filled(arguments):
        return [first if a == "@input" else a.replace("@input", first) for a in arguments]

    base = without(kind.arguments, option) + filled(row.beside)
    if row.sign and "--verbose" not in base and option not in ("--quiet", "--verbose"):
        base.append("--verbose")
    plain = Run(program, base, files)
    given = Run(program, base + filled(row.arguments), files)
    names = given.stderr.replace("-o,", "--output")
    if given.code not in (0, 1, 64, 65, 66, 69, 75):
        return SILENT, f"exit {given.code}: {given.stderr}"
    if given.code == 64 and given.stderr != plain.stderr:
        return (REFUSED, "") if option in names else (SILENT, "refused, but not by name: " + names)
    if given.code in (65, 66) and plain.code == 0 and not row.bad_data:
        return SILENT, "bad data: " + given.stderr
    if given.result() != plain.result():
        return CHANGES, ""
    if row.sign and re.search(row.sign, given.stderr) and not re.search(row.sign, plain.stderr):
        return OBEYED, ""
    if row.lost and re.search(row.lost, plain.stderr) and not re.search(row.lost, given.stderr):
        return OBEYED, ""
    if row.default and given.code == 0:
        return OBEYED, ""
    if option in given.stderr and option not in plain.stderr:
        return SAID, ""
    return SILENT, f"{base} {row.arguments}: {given.code}, {given.stderr}"


def pairs_of(program, suite):
    rows = suite.rows(Row)
    listed = options_of(program)
    missing = [option for option in listed if option not in rows]
    if missing:
        sys.exit(f"{program}: no row for {', '.join(missing)} in {suite.__name__}.py")
    for kind in suite.inputs(Input, program):
        for option in listed:
            yield program, option, kind.rows.get(option, rows[option]), kind


def main():
    programs = sys.argv[1:3]
    pairs = [pair for program, suite in zip(programs, (option_inputs_barcode, option_inputs_segment))
             for pair in pairs_of(os.path.abspath(program), suite)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(lambda pair: classify(*pair), pairs))
    counts = collections.Counter(result for result, _ in results)
    if len(sys.argv) > 3:
        with open(sys.argv[3], "w", newline="", encoding="utf-8") as file:
            table = csv.writer(file)
            table.writerow(["program", "option", "input", "result"])
            for (program, option, _, kind), (result, _) in zip(pairs, results):
                table.writerow([os.path.basename(program), option, kind.name, result])
    for (program, option, _, kind), (result, why) in zip(pairs, results):
        if result == SILENT:
            print(f"SILENT {os.path.basename(program)} {option} with {kind.name}: {why.strip()}")
    print(f"{len(pairs)} pairs: " + ", ".join(f"{counts[name]} {name}" for name in
                                             (CHANGES, OBEYED, REFUSED, SAID, SILENT)))
    sys.exit(1 if counts[SILENT] else 0)


if __name__ == "__main__":
    main()
