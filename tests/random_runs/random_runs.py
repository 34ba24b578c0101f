# SPDX-License-Identifier: MIT
"""random_runs.py PH_BARCODE [--runs N] [--seed S] [--jobs J] [--keep FOLDER] [--only KIND]

Runs the whole program with random options on random inputs of each kind and format, and compares
its output with barcodes by the definition (oracle.py), which shares no code with the program. Each
run has its own seed: --seed S --runs 1 repeats the run of seed S. If there are differences, it
exits with 1 and prints the commands; the files are kept in FOLDER (default: where the script is
run)."""
import argparse
import dataclasses
import functools
import json
import math
import os
import pathlib
import random
import shlex
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "../support")]
import chains  # noqa: E402
import formats  # noqa: E402
import jobs  # noqa: E402
import many_runs  # noqa: E402
import oracle  # noqa: E402
import voxel_sets  # noqa: E402
from many_runs import Difference  # noqa: E402

EXTENSIONS = {"csv": "csv", "json": "json", "pers": "pers", "ripser": "txt", "dipha": "dipha", "npy": "npy"}


def match(found, expected, tolerance, scale, short):
    """True if two multisets of bars are equal up to the tolerance for each end. A bar may lack a
    partner if rounding decides whether it is longer than `short`."""
    if tolerance == 0:
        return found == expected
    slack = tolerance * scale

    def near(a, b):
        return a == b or abs(a - b) <= slack
    left = list(expected)
    rest = []
    for bar in found:
        partner = next((o for o in left if o[0] == bar[0] and near(o[1], bar[1]) and near(o[2], bar[2])), None)
        if partner:
            left.remove(partner)
        else:
            rest.append(bar)
    return all(death - birth <= short + 4 * slack for _, birth, death in rest + left)


@dataclasses.dataclass
class Output:
    """The format of the output, and the bars to write: bars of dimension `low` and above that are
    longer than `short`."""
    form: str
    name: str = None
    low: int = 0
    short: float = 0.0
    chains: str = None  # cycles, cocycles or voxels, if they are requested


def side_options(rng, job):
    """Options that do not change the barcode, or that leave out bars. @return the options, each
    with its value; the output; and True if the program may refuse the options."""
    options, output = [], Output(rng.choice(list(EXTENSIONS)))
    if rng.random() < 0.4:
        options.append(["--engine", rng.choice(job.engines)])
    if rng.random() < 0.7:
        options.append(["--threads", rng.choice("1123")])
    if rng.random() < 0.3:
        options.append(["--memory-limit", rng.choice(["48MiB", "256MiB", "1GiB", "100MB"])])
    if rng.random() < 0.1:
        options.append(["--check"])
    options += rng.choice([[], [["--quiet"]], [["--verbose"]], [["--progress", "json"]], [["--progress", "bar"]]])
    if rng.random() < 0.2:
        output.low = rng.randint(0, job.max_dim)
        options.append(["--min-dim", str(output.low)])
    if rng.random() < 0.2:
        output.short = rng.choice([0.5, 1.0, 0.25, 0.0])
        options.append(["--min-persistence", formats.number(rng, output.short)])
    if rng.random() < 0.25:
        kinds = ["cycles", "cocycles", "voxels"] if job.picture else ["cycles", "cocycles"]
        output.form, output.chains = "json", rng.choice(kinds)
        options.append(["--representatives", output.chains])
    if rng.random() < 0.5:
        output.name = "out." + EXTENSIONS[output.form]
        options.append([rng.choice(["-o", "--output"]), output.name])
    if output.name is None or output.form == "ripser" or rng.random() < 0.2:
        options.append(["--output-format", output.form])
    if rng.random() < 0.03:
        options.append(["--plot", rng.choice(["p.svg", "p.png"])])
    may_refuse = any(option[0] in ("--engine", "--representatives") for option in options)
    return options, output, may_refuse


def with_values(words):
    """The options of a job, each with its value."""
    options = []
    for word in words:
        if word.startswith("--"):
            options.append([word])
        else:
            options[-1].append(word)
    return options


class Program:
    def __init__(self, path, folder):
        self.path, self.folder = path, folder
        self.command, self.run, self.said = None, None, ""

    def __call__(self, options, stdin=None):
        """Runs the program. @return the exit code."""
        self.command = [self.path, *sum(options, [])]
        given = {"input": stdin} if stdin is not None else {"stdin": subprocess.DEVNULL}
        try:
            self.run = subprocess.run(self.command, cwd=self.folder, capture_output=True, timeout=120, **given)
        except subprocess.TimeoutExpired:
            raise Difference(f"no end after 120 s: {shlex.join(self.command)}") from None
        self.said = self.run.stderr.decode(errors="replace")
        return self.run.returncode

    def differ(self, what):
        what = what if len(what) < 1500 else what[:1500] + " …"
        raise Difference(f"{what}\n  {shlex.join(self.command)}\n"
                         f"  exit {self.run.returncode}: {self.said[-600:]}")

    def content(self, output):
        return pathlib.Path(self.folder, output.name).read_bytes() if output.name else self.run.stdout

    def read(self, output):
        content = self.content(output)
        try:
            return formats.read_barcode(content, output.form)
        except Exception as error:  # noqa: BLE001
            self.differ(f"cannot read {output.form} back: {error!r}: {content[:200]!r}")

    def expect_refusal(self, code, output):
        """Checks that there is a message, of one line with --quiet, and no output."""
        found = self.run.returncode
        if found != code or self.run.stdout or not self.said.endswith("\n"):
            self.differ(f"found exit {found}, expected {code}, a message and no output")
        if "--quiet" in self.command and self.said.count("\n") != 1:
            self.differ("found more than one line with --quiet")
        if output.name and pathlib.Path(self.folder, output.name).exists():
            self.differ(f"found {output.name} after a refusal")


def compare(program, job, output):
    found = program.read(output)
    bars = oracle.barcode(job.filtration, job.prime)
    expected = [(d, b, e) for d, b, e in bars if output.low <= d <= job.max_dim and e - b > output.short]
    tolerance = job.tolerance
    if output.form == "ripser":
        if any(math.isinf(b) for _, b, _ in bars):
            return f"{job.kind}, not compared"  # this format has no infinite births
        tolerance = max(tolerance, 1e-5)
    finite = [abs(x) for bar in bars for x in bar[1:] if math.isfinite(x)]
    if not match(found, expected, tolerance, max([*finite, 1e-300]), output.short):
        program.differ(f"found {found}\n  expected {expected}")
    if output.chains:
        try:
            check_chains(job, output.chains, json.loads(program.content(output))["bars"])
        except chains.Unfit as error:
            program.differ(f"{output.chains}: {error}")
        return f"{job.kind}, {output.chains}"
    return job.kind


def check_chains(job, kind, bars):
    """Checks the representatives in the output. @param kind cycles, cocycles or voxels. @param bars
    from the JSON. @throws chains.Unfit"""
    representatives = chains.Representatives(job.filtration, job.prime)
    for bar in bars:
        try:
            if kind == "voxels":
                check_voxels(job, bar)
            if "representative" in bar:
                check_chain(job, "cocycles" if kind == "cocycles" else "cycles", bar, representatives)
            elif kind != "voxels":
                raise chains.Unfit("it has no representative")
        except (chains.Unfit, voxel_sets.Unfit, KeyError) as error:
            raise chains.Unfit(f"{bar}: {error!r}") from error


def ends_of(bar):
    return bar["dim"], float(bar["birth"]), math.inf if bar["death"] is None else float(bar["death"])


def check_voxels(job, bar):
    def place(number):
        at = []
        for n in reversed(job.picture.shape if job.name_of((0, 1)) == (0, 1) else job.picture.shape[::-1]):
            at.insert(0, number % n)
            number //= n
        return job.name_of(at)

    voxels = None
    if "voxels" in bar:
        voxels = {place(first + k) for first, count in bar["voxels"] for k in range(count)}
    job.picture.check(ends_of(bar), job.name_of(bar["birth_voxel"]),
                      bar["death_voxel"] and job.name_of(bar["death_voxel"]), voxels)


def check_chain(job, kind, bar, representatives):
    def content(cell):
        return cell and next(value for key, value in cell.items() if key in ("vertices", "grid", "row"))

    def named(cell):
        return cell and job.name_of(content(cell))

    ends = ends_of(bar)
    born, killer = named(bar["birth_cell"]), named(bar["death_cell"])
    chain = representatives.chain([(named(cell), cell["coefficient"]) for cell in bar["representative"]])
    by_value = job.has_cells and job.tolerance == 0  # otherwise, values differ in their last digits
    if not by_value:
        if kind == "cycles" and chains.boundary(chain, oracle.simplex_boundary, job.prime):
            raise chains.Unfit("it has a boundary")
    elif kind == "cycles":
        representatives.check_cycle(chain, ends, born)
    else:
        representatives.check_cocycle(chain, ends, born, killer)
    loops = [(list(map(tuple, content(loop))) if job.period else content(loop), loop["coefficient"])
             for loop in bar.get("loops", ())]
    # The vertices do not determine a loop that has only one or two vertices around a periodic
    # space. On a periodic axis with two voxels, they do not determine which edge joins the two
    # voxels. In these cases, only the chain is checked.
    if not loops or any(len(vertices) < 3 for vertices, _ in loops) or job.period and 4 in job.period:
        return
    run_through = {job.name_of(edge): number
                   for edge, number in chains.sum_of_loops(loops, job.period, job.prime).items()}
    if by_value:
        representatives.check_cycle(run_through, ends, born)
    elif run_through.get(born) != chain.get(born):
        raise chains.Unfit(f"its loops sum to {run_through}")


def in_parts(rng, program, job):
    """Joins part files in any order, at once or in steps."""
    count = rng.randint(1, 4)
    names = [f"part{i + 1}.ph" for i in range(count)]
    order = list(range(count))
    rng.shuffle(order)
    # For components and for images, these options have no effect and are refused.
    options = [option for option in with_values(job.options)
               if option[0] not in ("--field", "--modulus", "--metric", "--collapse", "--complex")]
    options.append(["--complex", "rips" if job.kind.startswith("rips") else "cubical"])
    for i in order:
        if program([[job.files[0][0]], *options, ["--part", f"{i + 1}/{count}"], ["-o", names[i]]]) != 0:
            if i == order[0] and program.run.returncode in (64, 65):
                return f"{job.kind} in parts, refused"
            program.differ("found a refusal, expected a part")
    while len(names) > 1 and rng.random() < 0.5:
        i = rng.randrange(len(names) - 1)
        joined = f"joined{len(names)}.ph"
        if program([["--join"], rng.sample(names[i:i + 2], 2), ["-o", joined]]) != 0:
            program.differ("found a refusal, expected one part of two")
        names[i:i + 2] = [joined]
    output = Output("csv")
    if program([["--join"], rng.sample(names, len(names))]) != 0:
        program.differ("found a refusal, expected a barcode")
    compare(program, job, output)
    return f"{job.kind} in parts"


def damaged(rng, content):
    """The content with some bytes changed, left out, doubled or inserted."""
    content = bytearray(content)
    for _ in range(rng.choice([1, 1, 1, 3, 10])):
        at = rng.randrange(len(content) + 1)
        way = rng.randrange(4)
        if way == 0 and at < len(content):
            content[at] ^= 1 << rng.randrange(8)
        elif way == 1:
            del content[at:at + rng.randint(1, 8)]
        elif way == 2:
            content[at:at] = content[at:at + rng.randint(1, 8)]
        else:
            content[at:at] = rng.choice([b"nan", b"-", b"inf", b" ", b"\n", b"\0", b"1e999", b"9" * 20, b"\xff"])
    return bytes(content)


def one_run(path, only, seed, folder):
    """Runs the program once. @return the kind of run, for the counts. @throws Difference"""
    rng = random.Random(seed)
    job = jobs.KINDS[only or rng.choice(list(jobs.KINDS))](rng)
    is_damaged = rng.random() < 0.1
    for k, (name, content) in enumerate(job.files):
        pathlib.Path(folder, name).write_bytes(damaged(rng, content) if is_damaged and k == 0 else content)
    program = Program(path, folder)
    if job.has_parts and not is_damaged and rng.random() < 0.3:
        return in_parts(rng, program, job)
    options, output, may_refuse = side_options(rng, job)
    words = [[job.files[0][0]], *with_values(job.options), *options]
    rng.shuffle(words)
    code = program(words)
    if is_damaged:
        # Whatever the damaged bytes mean, the result is a barcode or a refusal.
        if code == 0:
            program.read(output)
        else:
            if code not in (64, 65, 66, 75):
                program.differ("found another end than a barcode or a refusal")
            program.expect_refusal(code, output)
        return f"{job.kind}, damaged"
    if code == 64 and may_refuse:
        program.expect_refusal(64, output)
        return f"{job.kind}, refused"
    if code != 0:
        program.differ("found a refusal, expected a barcode")
    return compare(program, job, output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    many_runs.add_options(parser, 1000)
    parser.add_argument("--only", choices=jobs.KINDS)
    options = parser.parse_args()
    many_runs.run_all(functools.partial(one_run, str(options.program.resolve()), options.only), options, "random-run")



if __name__ == "__main__":
    main()
