#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plants faults (program_mutants.py) in a copy of the repository, one at a time. Each time, builds
the programs. The tests of programs, readers and the segmentation must find each fault.

plant_program_mutants.py [--jobs N] [NAME...]     (names of mutants; default: all)

The exit code is 0 if all mutants were killed. plant_mutants.py does the same for engines and
complexes.
"""
import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from mutant import NotPlanted, find_anchors, plant
from plant_mutants import ROOT
from program_mutants import MUTANTS

OPTIONS = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O1", "-DPH_BUILD_EXAMPLES=OFF"]


def run(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, **options)


def copy_tracked(tree):
    files = run("git", "-C", ROOT, "ls-files", "-z", "--cached", "--others", "--exclude-standard", check=True).stdout
    run("tar", "-C", ROOT, "--null", "-T", "-", "-cf", tree.with_suffix(".tar"), input=files, check=True)
    tree.mkdir()
    run("tar", "-C", tree, "-xf", tree.with_suffix(".tar"), check=True)


def built(tree, targets, jobs):
    """@return the compiler's messages if it failed, otherwise nothing."""
    result = run("cmake", "--build", tree / "build", "-j", str(jobs), "--target", *targets)
    return result.stdout[-600:] if result.returncode else ""


def tests_pass(tree, tests):
    """@param tests the path of a test program, or the name of a test."""
    for program in (tree / "build/tests").glob(f"**/{tests}"):
        if program.is_file():
            return run(program, "--gtest_fail_fast", "--gtest_brief=1").returncode == 0
    return run("ctest", "--test-dir", tree / "build", "-R", f"^{tests}$", "--no-tests=error").returncode == 0


def try_mutant(tree, mutant, anchors, jobs):
    try:
        file, text = plant(tree, mutant, anchors)
    except NotPlanted as why:
        return f"NOT PLANTED: {why}"
    before = (tree / file).read_text()
    (tree / file).write_text(text)
    try:
        if said := built(tree, mutant.targets, jobs):
            return f"DOES NOT COMPILE: {said}"
        return f"SURVIVED {mutant.test}" if tests_pass(tree, mutant.test) else f"killed by {mutant.test}"
    finally:
        (tree / file).write_text(before)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    mutants = [m for m in MUTANTS if not arguments.names or m.name in arguments.names]
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="ph-mutants-") as folder:
        tree = Path(folder) / "tree"
        copy_tracked(tree)
        run("cmake", "-S", tree, "-B", tree / "build", *OPTIONS, check=True)
        if said := built(tree, sorted({t for m in mutants for t in m.targets}), arguments.jobs):
            print(said)
            return 1
        for tests in sorted({m.test for m in mutants}):
            if not tests_pass(tree, tests):
                print(f"{tests} fails without any mutant")
                return 1
        print(f"built without mutants in {time.monotonic() - start:.0f} s", flush=True)
        anchors = find_anchors(tree)
        killed = 0
        for mutant in mutants:
            verdict = try_mutant(tree, mutant, anchors, arguments.jobs)
            killed += verdict.startswith("killed")
            print(f"{mutant.name:<60} {verdict}", flush=True)
    print(f"{killed} passed, {len(mutants) - killed} failed (mutants killed, {time.monotonic() - start:.0f} s)")
    return 0 if killed == len(mutants) and killed > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
