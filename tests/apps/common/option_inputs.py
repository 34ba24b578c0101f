# SPDX-License-Identifier: MIT
"""option_inputs.py PH_BARCODE PH_SEGMENT PH_CLUSTER [TABLE.csv [OPTION...]]: tests each option of each program
with each kind of input. It runs the program with and without the option. One of these statements
must be true:

* The option changes the result (exit code, standard output, files).
* The option affects something other than the result: a message, a field of the JSON, or how the
  result is computed.
* The option is refused (64) by name.
* Standard error reports that the option has no effect.

Otherwise, the option was silently ignored (SILENT), and the test fails. The test also fails if the
option turns the input into bad data without a message about the option, or if the program does not
obey the option. For an option with choices (the help lists them as a|b|c), each choice is tried: it
is refused by name, or its result differs from the result of every other choice.

`--help all` lists the options to test. An option without a row in option_inputs_PROGRAM.py is tried
with its last choice, or with a sample value for its placeholder; if there is no sample, the test
fails. The table is written to TABLE.csv. With OPTION..., only these options are tested."""
import collections
import concurrent.futures
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import threading

for _folder in ("../../support", "manual"):
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), _folder))
import described  # noqa: E402
import option_inputs_barcode  # noqa: E402
import option_inputs_cluster  # noqa: E402
import option_inputs_segment  # noqa: E402
from program import has_page  # noqa: E402

CHANGES, OBEYED, REFUSED, SAID, SILENT = "changes", "obeyed", "refused", "said", "SILENT"
VOLATILE = ("timings", "peak_memory", "stages", "table", "seconds")
DOES_NOTHING = "does nothing|do nothing|ignore[sd]|only to estimate|not needed|is not used"
TIMES = r"; [0-9.]+ ms|[0-9.]+ s: .* CPU per frame"
MEMORY = rb"(?m)^memory .*$"  # the forecast of a dry run depends on the heap of the process
RUNS_AT_ONCE = 2
# Sample values for the placeholders of options without a row.
SAMPLES = {"": [], "[TOPIC]": [], "N": ["2"], "K": ["2"], "D": ["1"], "P": ["3"], "S": ["2"], "T": ["0.5"],
           "R": ["0.5"], "X": ["0.5"], "M": ["0.5"], "EPS": ["0.5"]}


class Row:
    """How to test an option.

    arguments: the option and its value; `@input` stands for the first file of the input.
    variant: the variant of the input on which the option has an effect, such as "nan".
    beside: arguments of both runs.
    sign: for an option that does not change the result, a pattern that standard error matches only
    with the option; {} stands for the choice. lost: a pattern that standard error matches only
    without the option.
    default: other arguments, which change the result, if `arguments` only state the default.
    unfit: a pattern for the message of a run that fails (64, 65) because the input does not fit
    this option or another one; the name of the option is always accepted.
    choices: the choices to try, each with a different result; by default the choices in the help.
    alike: choices that have the same result as another choice."""

    def __init__(self, *arguments, variant="plain", beside=(), sign=None, lost=None, default=(),
                 unfit=None, choices=None, alike=()):
        self.arguments, self.variant, self.beside = list(arguments), variant, list(beside)
        self.sign, self.lost, self.default, self.unfit = sign, lost, list(default), unfit
        self.choices, self.alike = choices, alike


class Input:
    """A kind of input: its arguments, its files, and variants of the first file with other
    contents."""

    def __init__(self, name, arguments, files, rows=None, **variants):
        self.name, self.arguments, self.files = name, list(arguments), dict(files)
        self.rows, self.variants = rows or {}, variants

    def content(self, variant):
        files = dict(self.files)
        if variant in self.variants:
            files[next(iter(files))] = self.variants[variant]
        return files


def options_of(program):
    """Maps the first long name of each option in the help to its placeholder and its listed
    choices."""
    found = {}
    for name, option in described.options_of(program).items():
        choices = option.value.replace("minkowski:P", "minkowski:3").split("|")
        is_list = len(choices) > 1 and all(re.fullmatch("[a-z0-9:_-]+", c) for c in choices)
        found[name] = option.value, [c for c in choices if c != "auto"] if is_list else []
    return found


def result_of(content):
    """The content without the parts that differ from run to run. JSON may consist of one document
    per line, as for a stream."""
    if not content.startswith(b"{"):  # numbers are valid JSON too, but the same in each run
        return re.sub(MEMORY, b"", content) if b"memory " in content else content
    try:
        values = [json.loads(content)]
    except (ValueError, UnicodeDecodeError):
        try:
            values = [json.loads(line) for line in content.splitlines()]
        except (ValueError, UnicodeDecodeError):
            return re.sub(MEMORY, b"", content)
    for value in values:
        for name in VOLATILE if isinstance(value, dict) else ():
            value.pop(name, None)
    return json.dumps(values)


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
            self.stderr = re.sub(TIMES, "", run.stderr.decode(errors="replace"))
            self.files = {}
            for where, _, names in os.walk(folder):
                for name in names:
                    path = os.path.join(where, name)
                    with open(path, "rb") as file:
                        self.files[os.path.relpath(path, folder)] = result_of(file.read())

    def result(self):
        return self.code, self.stdout, self.files

    def names(self, word, line=None):
        text = self.stderr if line is None else line
        return re.search(rf"{word}(?![a-z-])", text.replace("-o,", "--output"))


class Runs:
    """Runs programs. A run is not repeated with the same arguments and files."""

    def __init__(self):
        self.known, self.lock = {}, threading.Lock()

    def get(self, program, arguments, files, again=False):
        """@param again true for a second run with the same arguments."""
        key = (program, tuple(arguments), tuple(files.items()), again)
        with self.lock:
            first = key not in self.known
            future = self.known.setdefault(key, concurrent.futures.Future())
        if first:
            try:
                future.set_result(Run(program, arguments, files))
            except BaseException as error:
                future.set_exception(error)
                raise
        return future.result()


class Pair:
    """An option together with a kind of input."""

    def __init__(self, runs, program, option, row, kind, choices):
        self.runs, self.program, self.option, self.row, self.kind = runs, program, option, row, kind
        self.files = kind.content(row.variant)
        self.base = without(kind.arguments, option)
        for word in row.beside:
            self.base = without(self.base, word)
        self.base += self.filled(row.beside)
        if row.sign and "--verbose" not in self.base and option not in ("--quiet", "--verbose"):
            self.base.append("--verbose")
        self.choices = choices if row.choices is None else row.choices
        self.program_name = os.path.basename(program)

    def filled(self, arguments):
        first = next(iter(self.kind.files))
        return [a.replace("@input", first) for a in arguments]

    def run(self, arguments, **how):
        return self.runs.get(self.program, self.base + self.filled(arguments), self.files, **how)

    def classify(self):
        plain = self.run([])
        if plain.result() != self.run([], again=True).result():
            return SILENT, f"{self.base}: another result each time"
        verdict = self.verdict(plain, self.row.arguments)
        if verdict[0] == SILENT or not self.choices:
            return verdict
        return self.fault_of_choices(plain) or verdict

    def verdict(self, plain, arguments):
        row, option, given = self.row, self.option, self.run(arguments)
        sign = row.sign and row.sign.replace("{}", re.escape(arguments[-1]))
        tried = f"{self.base} {arguments}: {given.code}, {given.stderr}"
        if given.code not in (0, 64, 65, 66):
            return SILENT, tried
        if given.code != 0 and given.stderr != plain.stderr:
            told = (given.names(option) or row.unfit and re.search(row.unfit, given.stderr)
                    or arguments[-1] in self.choices and given.names(arguments[-1]))
            return (REFUSED if given.code == 64 else CHANGES, "") if told else (SILENT, tried)
        if given.result() != plain.result():
            return CHANGES, ""
        if sign and re.search(sign, given.stderr) and not re.search(sign, plain.stderr):
            return OBEYED, ""
        if row.lost and re.search(row.lost, plain.stderr) and not re.search(row.lost, given.stderr):
            return OBEYED, ""
        if row.default and given.code == 0:
            other = self.run(row.default)
            return ((OBEYED, "") if other.code == 0 and other.result() != given.result()
                    else (SILENT, f"nor does {row.default}: {tried}"))
        # A remark about an output also applies to options that change how the output looks.
        outputs = {"-o": "--output", "--plot": "--plot", "--representatives": "--representatives"}
        said_of = [option, *(outputs[word] for word in row.beside if word in outputs)]
        if any(given.names(word, line) and re.search(DOES_NOTHING, line)
               for line in given.stderr.splitlines() for word in said_of):
            return SAID, ""
        return SILENT, tried

    def fault_of_choices(self, plain):
        """Checks that each choice is the default or has an effect, and that no two choices give the
        same result."""
        results = {}
        for choice in self.choices:
            arguments = [self.option, choice]
            given = self.run(arguments)
            verdict = self.verdict(plain, arguments)
            is_default = given.result() == plain.result() and given.stderr == plain.stderr
            if verdict[0] == SILENT and not is_default:
                return verdict
            if given.code == 0 and verdict[0] != SAID and not self.row.sign:
                results.setdefault(str(given.result()), []).append(choice)
        for same in results.values():
            if len(set(same) - set(self.row.alike)) > 1:
                return SILENT, f"{self.base}: {self.option} is the same of {same}"
        return None


def without(arguments, option):
    """The arguments without the given option and its value."""
    kept, skip = [], False
    for argument in arguments:
        if argument == option:
            skip = True
        elif skip and not argument.startswith("--"):
            skip = False
        else:
            kept, skip = kept + [argument], False
    return kept


def pairs_of(runs, program, suite):
    rows = suite.rows(Row)
    listed = options_of(program)
    for option, (placeholder, choices) in listed.items():
        value = choices[-1:] or SAMPLES.get(placeholder)
        if option not in rows and value is None:
            sys.exit(f"{program}: {option} {placeholder}: add a row with a value of it to rows() in "
                     f"{suite.__name__}.py, or a sample of {placeholder} to SAMPLES")
        rows.setdefault(option, Row(option, *(value or ()), beside=suite.BESIDE))
    if "--report" in listed and not has_page(program):
        print(f"skipped: {os.path.basename(program)} --report: this build has no page")
        del listed["--report"]
    for kind in suite.inputs(Input, program):
        for option, (_, choices) in listed.items():
            yield Pair(runs, program, option, kind.rows.get(option, rows[option]), kind, choices)


def main():
    runs, programs = Runs(), sys.argv[1:4]
    suites = option_inputs_barcode, option_inputs_segment, option_inputs_cluster
    pairs = [pair for program, suite in zip(programs, suites)
             for pair in pairs_of(runs, os.path.abspath(program), suite)
             if pair.option in sys.argv[5:] or not sys.argv[5:]]
    with concurrent.futures.ThreadPoolExecutor(RUNS_AT_ONCE) as pool:
        results = list(pool.map(Pair.classify, pairs))
    counts = collections.Counter(result for result, _ in results)
    if len(sys.argv) > 4:
        with open(sys.argv[4], "w", newline="", encoding="utf-8") as file:
            table = csv.writer(file)
            table.writerow(["program", "option", "input", "result"])
            for pair, (result, _) in zip(pairs, results):
                table.writerow([pair.program_name, pair.option, pair.kind.name, result])
    for pair, (result, why) in zip(pairs, results):
        if result == SILENT:
            print(f"SILENT {pair.program_name} {pair.option} with {pair.kind.name}: {why.strip()}")
    print(f"{len(runs.known)} runs")
    print(f"{len(pairs)} pairs: " + ", ".join(f"{counts[name]} {name}" for name in
                                             (CHANGES, OBEYED, REFUSED, SAID, SILENT)))
    sys.exit(1 if counts[SILENT] else 0)


if __name__ == "__main__":
    main()
