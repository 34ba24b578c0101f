#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plants faults (mutants.py) in a copy of libph, one at a time. The tests must find each fault.

plant_mutants.py [--jobs N] [--check] [NAME...]     (names of mutants; default: all)

A mutant is killed if its test program fails or reaches the time limit. It is a failure if the tests
pass or the mutant does not compile. It is also a failure if the anchor of the mutant (mutant.py) or
the text to replace does not occur exactly once, because then the sources have changed and the
mutant must be adapted. The exit code is 0 if all mutants were killed. --check builds nothing. It
only tests that each mutant can be planted, including the mutants of program_mutants.py, and that
each anchor has a mutant.
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from mutant import NotPlanted, find_anchors, plant
from mutants import MUTANTS
from program_mutants import MUTANTS as PROGRAM_MUTANTS

ROOT = Path(__file__).resolve().parents[2]
TIME_LIMIT = 90  # seconds that a test program may run

# The folders of libph/src that are compiled.
SOURCES = ["core", "gpu", "metric", "image", "complex", "rips", "cubical", "facade", "diagram", "vectors",
           "significance", "loops"]
HAS_CGAL = Path("/usr/include/CGAL").is_dir()
if HAS_CGAL:
    SOURCES.append("alpha")
NINJA = """\
cxx = {compiler}
flags = -std=c++20 -O1 -frounding-math -DCGAL_NDEBUG -I. -Ilibph/include '-DPH_TEST_DATA=""' {includes}
rule compile
  command = $cxx $flags -MMD -MF $out.d -c $in -o $out
  depfile = $out.d
  deps = gcc
rule link
  command = $cxx $in -o $out {libraries}
rule archive
  command = rm -f $out && ar crs $out $in
"""


def flags_of(package):
    found = subprocess.run(["pkg-config", "--cflags", "--libs", package], capture_output=True,
                           text=True, check=True).stdout.split()
    return ([f for f in found if not f.startswith("-l")], [f for f in found if f.startswith("-l")])


def write_build(tree, programs):
    """Writes a build file with only relative names, because the build must also be up to date in a
    copy of the folder."""
    includes, libraries = [], []
    for package in ("eigen3", "fmt", "gtest_main"):
        found = flags_of(package)
        includes += found[0]
        libraries += found[1]
    text = NINJA.format(compiler=os.environ.get("CXX", "c++"), includes=" ".join(includes),
                        libraries=" ".join(libraries + ["-lpthread"] + ["-lmpfr -lgmp"] * HAS_CGAL))
    library = []
    sources = [p.relative_to(tree) for f in SOURCES
               for p in (tree / "libph/src" / f).rglob("*.cpp")
               if p.name != "estimate.cpp" and p.parent.name != "windows"]
    for source in sorted(sources):
        library.append(f"o/{source.parent.name}_{source.stem}.o")
        text += f"build {library[-1]}: compile {source}\n"
    text += "build o/estimate.o: compile libph/src/facade/estimate.cpp\n"
    text += f"build o/libph.a: archive {' '.join(library)}\n"
    tests = {p.stem: p.relative_to(tree) for f in SOURCES for p in (tree / "tests/libph" / f).rglob("*.cpp")}
    for program in programs:
        text += f"build o/{program}.o: compile {tests[program]}\n"
        extra = "o/estimate.o" if "estimate(" in (tree / tests[program]).read_text() else ""
        text += f"build {program}: link o/{program}.o {extra} o/libph.a\n"
    (tree / "build.ninja").write_text(text)


def build(tree, programs, jobs):
    return subprocess.run(["ninja", "-j", str(jobs), *programs], cwd=tree, capture_output=True,
                          text=True)


def passes(tree, program):
    """True if the tests pass, False if they fail, None if they reached the time limit."""
    try:
        # Tests of the speed and tests that stop a run are left out, because they do not concern
        # mutants and are slow without optimisation.
        command = [f"./{program}", "--gtest_fail_fast", "--gtest_brief=1",
                   "--gtest_filter=-RunContexts.*:*LinearTime*:*Duplicates*:*LongChains*:*WideCells*"]
        return subprocess.run(command, cwd=tree, capture_output=True, text=True,
                              timeout=TIME_LIMIT).returncode == 0
    except subprocess.TimeoutExpired:
        return None


def check(anchors):
    """Checks that all mutants can be planted. @return the exit code."""
    mutants = MUTANTS + PROGRAM_MUTANTS
    lost = []
    for mutant in mutants:
        try:
            plant(ROOT, mutant, anchors)
        except NotPlanted as why:
            lost.append(f"{mutant.name}: {why}")
    unused = [f"no mutant has the anchor {a}" for a in sorted(anchors.keys() - {m.anchor for m in mutants})]
    print(*lost, *unused, f"{len(mutants) - len(lost)} of {len(mutants)} can be planted", sep="\n")
    return 1 if lost or unused else 0


def try_mutant(base, mutant, anchors):
    try:
        file, text = plant(base, mutant, anchors)
    except NotPlanted as why:
        return f"NOT PLANTED: {why}"
    tree = Path(tempfile.mkdtemp(prefix="mutant-", dir=base.parent))
    try:
        # The copies keep the times of the files. As a result, only the mutated file is rebuilt.
        shutil.copytree(base, tree, dirs_exist_ok=True)
        (tree / file).write_text(text)
        if (result := build(tree, [mutant.test], 1)).returncode != 0:
            return "DOES NOT COMPILE: " + result.stdout[-600:]
        passed = passes(tree, mutant.test)
        if passed is None:
            return f"killed by the time limit of {mutant.test}"
        return f"SURVIVED {mutant.test}" if passed else f"killed by {mutant.test}"
    finally:
        shutil.rmtree(tree)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    anchors = find_anchors(ROOT)
    if arguments.check:
        return check(anchors)
    mutants = [m for m in MUTANTS if not arguments.names or m.name in arguments.names]
    if not HAS_CGAL:
        left_out = [m for m in mutants if any("alpha" in file.parts for file in anchors.get(m.anchor, []))]
        mutants = [m for m in mutants if m not in left_out]
        print(f"without CGAL: {len(left_out)} mutants of alpha complexes are left out")
    programs = sorted({m.test for m in mutants})
    start = time.monotonic()

    with tempfile.TemporaryDirectory(prefix="ph-mutants-") as folder:
        base = Path(folder) / "base"
        for part in ("libph/include", "libph/src", "tests/libph", "tests/support"):
            shutil.copytree(ROOT / part, base / part)
        write_build(base, programs)
        if (result := build(base, programs, arguments.jobs)).returncode != 0:
            print(result.stdout[-4000:])
            return 1
        for program in programs:
            if not passes(base, program):
                print(f"{program} fails without any mutant")
                return 1
        print(f"built without mutants in {time.monotonic() - start:.0f} s", flush=True)

        killed = 0
        with ThreadPoolExecutor(arguments.jobs) as pool:
            for mutant, verdict in zip(mutants, pool.map(lambda m: try_mutant(base, m, anchors), mutants)):
                killed += verdict.startswith("killed")
                print(f"{mutant.name:<60} {verdict}", flush=True)
    print(f"{killed} passed, {len(mutants) - killed} failed "
          f"(mutants killed, {time.monotonic() - start:.0f} s)")
    return 0 if killed == len(mutants) and killed > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
