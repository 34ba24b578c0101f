#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that the programs of two builds print and write the same bytes.

same_outputs.py [--every N] [--seconds S] BUILD OTHER [EMULATOR…] runs the commands of commands.py,
or every Nth of them. It compares exit codes, standard output, standard error and each written file,
except for times and memory. EMULATOR runs the programs of OTHER. Numbers computed with functions of
the C library may differ by 1e-13 of their size, or by 1e-100; the number of such outputs is
printed. If OTHER is built without CGAL, as for other platforms, commands with alpha complexes are
left out and counted. So are commands that OTHER has not completed after S seconds. The last line
has the counts. The exit code is 0 if nothing else differs.
"""
import argparse
import itertools
import math
import re
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

from commands import DATA, commands

# Output that describes the run instead of its result: times, and the memory, which a forecast
# measures on a part of the input.
MEASURED = re.compile(rb'"timings": \{[^}]*\}|"(?:seconds|time|peak_memory)": [-+.e\d]+|; [.\d]+ m?s$|'
                      rb'^memory  .*$', re.M)
TRIANGULATED = {"alpha", "delaunay-cech", "delaunay-rips"}
NEAR = 1e-13  # relative to the size of the number
NOTHING = 1e-100  # exp(-300) has fewer correct digits than exp(-1)
NUMBER = re.compile(rb"(-?\d+(?:\.\d+)?(?:e[-+]?\d+)?)")


def result_of(build, emulator, command, seconds=None):
    """The exit code, outputs and files as bytes, by name. @throws subprocess.TimeoutExpired"""
    with tempfile.TemporaryDirectory() as folder:
        for file in DATA.iterdir():
            Path(folder, file.name).symlink_to(file)
        for name, content in command.inputs.items():
            Path(folder, name).write_bytes(content)
        program = build / command.words[0]
        if not program.exists():  # on Windows
            program = program.with_name(program.name + ".exe")
        run = subprocess.run([*emulator, str(program), *command.words[1:]], cwd=folder,
                             capture_output=True, check=False, timeout=seconds)
        outputs = {path.name: path.read_bytes() for path in Path(folder).glob("out*")}
    return {"exit code": b"%d" % run.returncode, "standard output": run.stdout,
            "standard error": run.stderr, **outputs}


def without_measurements(content):
    return MEASURED.sub(b"", content)


def doubles_of(array):
    """The doubles of an NPY file, and the bytes before them; None for other files."""
    start = 10 + int.from_bytes(array[8:10], "little")
    if not array.startswith(b"\x93NUMPY\x01") or b"'<f8'" not in array[:start] or (len(array) - start) % 8:
        return None
    return array[:start], struct.unpack(f"<{(len(array) - start) // 8}d", array[start:])


def are_near(ours, theirs):
    return len(ours) == len(theirs) and all(
        math.isclose(a, b, rel_tol=NEAR, abs_tol=NOTHING) for a, b in zip(ours, theirs))


def are_close(ours, theirs):
    """True if two texts or arrays are equal, except that numbers may be only nearly equal."""
    arrays = doubles_of(ours), doubles_of(theirs)
    if None not in arrays:
        return arrays[0][0] == arrays[1][0] and are_near(arrays[0][1], arrays[1][1])
    ours, theirs = NUMBER.split(ours), NUMBER.split(theirs)
    return ours[::2] == theirs[::2] and are_near(list(map(float, ours[1::2])), list(map(float, theirs[1::2])))


def lacks_alpha(command, theirs):
    """True if the run was refused because the program was built without CGAL."""
    return b"CGAL" in theirs["standard error"] and theirs["exit code"] != b"0" and \
        not TRIANGULATED.isdisjoint(command.words)


def compare(command, ours, theirs):
    """@return the differences, one per line, and the number of outputs that differ only in last
    bits, which is permitted."""
    words = " ".join(command.words)
    faults, close = [], 0
    if ours["exit code"] not in ((b"0", b"64") if command.may_refuse else (b"0",)):
        faults.append(f"{words}: exit code {ours['exit code'].decode()}: "
                      f"{ours['standard error'].decode().strip()}")
    if ours.keys() != theirs.keys():
        faults.append(f"{words}: found files {sorted(theirs)}, expected {sorted(ours)}")
    for name in sorted(ours.keys() & theirs.keys()):
        found, expected = without_measurements(theirs[name]), without_measurements(ours[name])
        if found == expected:
            continue
        if command.of_library and are_close(found, expected):
            close += 1
            continue
        faults.append(f"{words}: {name} differs")
        if name in ("exit code", "standard error"):
            faults.append(f"  found {found.decode(errors='replace')[:3000]}")
    return faults, close


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--seconds", type=float)
    parser.add_argument("build", type=Path)
    parser.add_argument("other", type=Path)
    parser.add_argument("emulator", nargs=argparse.REMAINDER)
    options = parser.parse_args()
    count = compared = refused = close = lacking = late = 0
    faults = []
    for command in itertools.islice(commands(), 0, None, options.every):
        ours = result_of(options.build.resolve(), [], command)
        try:
            theirs = result_of(options.other.resolve(), options.emulator, command, options.seconds)
        except subprocess.TimeoutExpired:
            late += 1
            continue
        if lacks_alpha(command, theirs):
            lacking += 1
            continue
        count += 1
        compared += len(ours)
        refused += ours["exit code"] != b"0"
        some_faults, some_close = compare(command, ours, theirs)
        faults += some_faults
        close += some_close
    if refused * 4 > count:  # for a refused command, only a single line is compared
        faults.append(f"found {refused} of {count} commands refused, expected fewer than a quarter")
    differ = sum(not line.startswith("  ") for line in faults)
    in_last_bits = f", {close} in the last bits of functions of the C library" if close else ""
    left_out = f", {lacking} commands left out without CGAL" if lacking else ""
    if late:
        left_out += f", {late} not done after {options.seconds:g} s"
    print("\n".join([*faults, f"{count} commands, {compared} outputs, {differ} differ{in_last_bits}{left_out}"]))
    return 1 if faults or not count else 0


if __name__ == "__main__":
    sys.exit(main())
