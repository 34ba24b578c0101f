# SPDX-License-Identifier: MIT
"""Clocks that go back, leap ahead, stand still or fail: program_clock.py PH-BARCODE PH-SEGMENT
WRONG-CLOCK.so

Whatever the clock says, a run ends in time with exit code 0 and the same output as with a correct
clock. Progress lines are still JSON with finite numbers. Processes that wait for each other are not
tested, because the kernel, whose clock stays correct, decides how long they wait."""
import itertools
import json
import math
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import files  # noqa: E402

BARCODE, SEGMENT, SHIM = map(os.path.abspath, sys.argv[1:4])
WAYS = ("back", "ahead", "frozen", "fails", "leaps")
FROM = (1, 2, 3, 5, 20)  # number of the first call that is wrong
POINTS = "".join(f"{math.cos(i)} {math.sin(3 * i)} {math.cos(7 * i)}\n" for i in range(400))
TABLE = files.pcd_header(width=24, height=24) + "".join(
    f"{x / 100} {y / 100} {0.9 if 8 <= x < 16 and 8 <= y < 16 else 1.0}\n"
    for y in range(24) for x in range(24)).encode()
INPUTS = {"points.txt": POINTS.encode(), "table.pcd": TABLE,
          "image.npy": files.array((40, 40), [float(7 * i * i % 97) for i in range(1600)]),
          "in/a.txt": POINTS.encode(), "in/b.txt": POINTS.encode()}
RUNS = [
    [BARCODE, "points.txt", "--max-dim", "2", "-o", "out.csv", "--progress", "json"],
    [BARCODE, "points.txt", "--progress", "bar", "-o", "out.csv", "--plot", "out.svg"],
    [BARCODE, "points.txt", "--engine", "cohomology", "-o", "out.dipha"],
    [BARCODE, "image.npy", "--progress", "json", "-o", "out.npy"],
    [BARCODE, "in", "-o", "out/", "--progress", "json"],
    [SEGMENT, "table.pcd", "--min-size", "1", "-o", "out.pcd", "--labels", "out.png",
     "--progress", "json"],
]


def run(words, **environment):
    """@return the completed process, and the files that it wrote, by name."""
    with tempfile.TemporaryDirectory() as folder:
        for name, content in INPUTS.items():
            path = os.path.join(folder, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "wb") as file:
                file.write(content)
        process = subprocess.run(words, cwd=folder, env={**os.environ, **environment}, text=True,
                                 stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, timeout=60)
        found = {}
        for at, _, names in os.walk(folder):
            for name in names:
                path = os.path.relpath(os.path.join(at, name), folder)
                if path not in INPUTS:
                    with open(os.path.join(folder, path), "rb") as file:
                        found[path] = file.read()
        return process, found


def is_progress(line):
    try:
        return math.isfinite(json.loads(line)["seconds"])
    except (ValueError, KeyError):
        return False


def faults(words, want, **environment):
    """@return a list that describes what is wrong with a run."""
    try:
        process, found = run(words, **environment)
    except subprocess.TimeoutExpired:
        return ["no end within 60 s"]
    wrong = []
    if process.returncode != 0:
        wrong.append(f"exit {process.returncode}, {process.stderr!r}")
    elif found != want:
        wrong.append(f"other files: {sorted(found)}")
    return wrong + [repr(line) for line in process.stderr.splitlines()
                    if line.startswith("{") and not is_progress(line)]


def main():
    with open(BARCODE, "rb") as file:
        content = file.read()
        if b"__asan_init" in content or b"__tsan_init" in content:
            print("SKIPPED: sanitizers look at the clock as well")
            return 77
    wrong, count = [], 0
    for words in RUNS:
        process, want = run(words)
        assert process.returncode == 0 and want, (words, process)
        for how, first in itertools.product(WAYS, FROM):
            environment = {"PH_CLOCK": how, "PH_CLOCK_FROM": str(first)}
            wrong += [f"{words[1:]}, {environment}: {fault}"
                      for fault in faults(words, want, LD_PRELOAD=SHIM, **environment)]
            count += 1
    print("\n".join([*wrong, f"{count} runs"]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
