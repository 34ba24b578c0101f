# SPDX-License-Identifier: MIT
"""Memory runs out at any moment: the programs exit with 75 or manage without the memory, and no
file is half written: program_allocation.py PH-BARCODE PH-SEGMENT FAILING-MALLOC.so [--all]

There are some 17000 allocating calls, each tested by two runs, except for most of those that were
tested in another case. Without --all, only one call in EVERY fails: a different selection in each
case and for each way to fail."""
import gzip
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import SQUARE, files, has_page  # noqa: E402

BARCODE, SEGMENT, SHIM = map(os.path.abspath, sys.argv[1:4])
EVERY = 1 if "--all" in sys.argv else 23

TRIANGLE = "0 : 0\n1 : 0\n2 : 0\n0 1 : 1\n1 2 : 2\n0 2 : 3\n0 1 2 : 4\n"


def table():
    """An ASCII PCD file: a table seen from above with a box on it."""
    points = [(0.01 * x, 0.01 * y, 0.9 if 4 <= x < 8 and 4 <= y < 8 else 1.0)
              for y in range(14) for x in range(14)]
    lines = "".join("%g %g %g\n" % p for p in points)
    return files.pcd_header(width=14, height=14) + lines.encode()


# (program, arguments without outputs, outputs, each of which must be complete or absent)
CASES = [
    (BARCODE, ["square.txt"], {"-o": "out.csv", "--plot": "out.svg"}),
    (BARCODE, ["square.txt", "--engine", "standard"], {"-o": "out.dipha"}),
    (BARCODE, ["square.txt", "--check", "--max-dim", "2", "--engine", "twist"], {"-o": "out.npy"}),
    (BARCODE, ["ring.npy"], {"-o": "out.pers"}),
    (BARCODE, ["triangle.txt", "--format", "simplices"], {"-o": "out.ripser"}),
    (BARCODE, ["table.pcd", "--max-dim", "0"], {"-o": "out.csv"}),
    (BARCODE, ["out.png.in", "--format", "png"], {"-o": "out.csv"}),
    (BARCODE, ["square.txt.gz", "--representatives", "cocycles", "--output-format", "json"],
     {"-o": "/dev/null", "--plot": "out.svg"}),
    (BARCODE, ["square.txt", "--plot-kind", "tree"], {"-o": "out.csv", "--plot": "out.svg"}),
    (BARCODE, ["square.txt"], {"--plot": "out.png"}),
    (SEGMENT, ["table.pcd", "--min-size", "1", "--voxel", "0.01"],
     {"-o": "out.pcd", "--labels": "out.npy", "--plot": "out.svg", "--picture": "out.png"}),
    (SEGMENT, ["table.pcd", "--min-size", "1", "--plot-kind", "cloud", "--size", "200x150"],
     {"--plot": "out.png"}),
    (SEGMENT, ["table.pcd", "--min-size", "1", "--plot-kind", "cloud", "--size", "200x150"],
     {"--plot": "out.svg"}),
    (SEGMENT, ["--depth", "out.png.in", "--intrinsics", "20,20,7,7", "--depth-scale", "1"],
     {"--json": "/dev/null", "-o": "out.pcd"}),
    (SEGMENT, ["out.pcd.in", "--min-size", "1"], {"--coloured": "out.ply", "--labels": "out.png"}),
]
DRAWS_PNG = "PNG plots   FreeType" in subprocess.run([BARCODE, "--version", "--verbose"], check=True,
                                                     stdout=subprocess.PIPE, text=True).stdout
CASES = [case for case in CASES if DRAWS_PNG or not case[2].get("--plot", "").endswith(".png")]
REPORTS = [
    (BARCODE, ["square.txt", "--output-format", "none", "--representatives", "cycles"],
     {"--report": "out.html"}),
    (BARCODE, ["ring.npy"], {"-o": "out.csv", "--report": "out.html"}),
    (SEGMENT, ["table.pcd", "--min-size", "1", "--voxel", "0.01"], {"--report": "out.html"}),
]


SAMPLED = 97  # one in this many of the calls already tested in another case fails
total = [0]  # number of runs
first = [0]  # offset of the failing calls


class Folder:
    def __init__(self, path):
        self.path = path
        self.inputs = {}
        for name, content in (("square.txt", SQUARE.encode()), ("triangle.txt", TRIANGLE.encode()),
                              ("ring.npy", files.array((3, 3), [0, 1, 2, 1, 9, 3, 2, 3, 4])),
                              ("table.pcd", table()),
                              ("square.txt.gz", gzip.compress(SQUARE.encode()))):
            self.add(name, content)

    def add(self, name, content):
        self.inputs[name] = content
        with open(os.path.join(self.path, name), "wb") as file:
            file.write(content)

    def outputs(self):
        """Removes the files of the last run. @return the content of each file, by name."""
        left = {}
        for name in set(os.listdir(self.path)) - set(self.inputs):
            with open(os.path.join(self.path, name), "rb") as file:
                left[name] = file.read()
            os.remove(os.path.join(self.path, name))
        return left

    def run(self, program, arguments, outputs, **environment):
        words = [word for pair in outputs.items() for word in pair]
        return subprocess.run([program, *arguments, *words, "--threads", "1"], cwd=self.path,
                              env={**os.environ, "LD_PRELOAD": SHIM, **environment},
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, timeout=60)


def calls_of(folder, *case):
    """@return the sizes that a successful run requests, in order, and the files that it writes."""
    run = folder.run(*case, PH_CALLS_FILE=os.path.join(folder.path, "calls"))
    made = folder.outputs()
    assert run.returncode == 0, run.stderr
    sizes = [int(line) for line in made.pop("calls").split()]
    assert sizes, "the calls were not counted"
    return sizes, made


def shared(sizes, others):
    """@return the number of leading requests whose sizes agree."""
    for i, (a, b) in enumerate(zip(sizes, others)):
        if a != b:
            return i
    return min(len(sizes), len(others))


def is_complete(name, content, want):
    """True if a file is complete. Of a report, only the beginning and the end are compared, because
    it contains times and may lack a merge tree."""
    if name.endswith(".html"):
        return content[:1000] == want[:1000] and content[-1000:] == want[-1000:]
    return content == want


def check(folder, case, known, wrong):
    """Makes one call in EVERY fail, in two ways. Where the run begins with the same calls as the
    run `known`, only one in SAMPLED of the selected calls fails. @return the sizes that the run
    requests."""
    program, arguments, outputs = case
    sizes, want = calls_of(folder, *case)
    assert set(want) == set(outputs.values()) - {"/dev/null"}, want.keys()
    before = shared(sizes, known)
    runs = {0: 0, 75: 0}
    for how in ("PH_FAIL_AT", "PH_FAIL_FROM"):
        first[0] += 5  # coprime to EVERY
        skip = first[0] % EVERY
        for call in [*range(1 + skip, before + 1, SAMPLED * EVERY),
                     *range(before + 1 + skip, len(sizes) + 1, EVERY)]:
            run = folder.run(*case, **{how: str(call)})
            left = folder.outputs()
            label = f"{os.path.basename(program)} {' '.join(arguments)} {how}={call}"
            if run.returncode not in (0, 75):
                wrong.append(f"{label}: exit {run.returncode}, {run.stderr[-200:]!r}")
                continue
            runs[run.returncode] += 1
            if run.returncode == 0 and set(left) != set(want):
                wrong.append(f"{label}: exit 0, but the files are others")
            for name, content in left.items():
                if name not in want or not is_complete(name, content, want[name]):
                    wrong.append(f"{label}: {name} is not complete")
            if run.returncode == 75 and not run.stderr:
                wrong.append(f"{label}: not a word on stderr")
    print(f"{os.path.basename(program)} {' '.join(arguments)}: {len(sizes)} calls, the first "
          f"{before} as in the first case; {runs[75]} runs end with 75, {runs[0]} do without",
          flush=True)
    total[0] += runs[0] + runs[75]
    return sizes


def main():
    with open(BARCODE, "rb") as file:
        content = file.read()
        if b"__asan_init" in content or b"__tsan_init" in content:
            print("SKIPPED: sanitizers bring their own malloc")
            return 77
    wrong = []
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        folder.run(SEGMENT, ["table.pcd", "--min-size", "1"],
                   {"-o": "out.pcd", "--labels": "out.png"})
        made = folder.outputs()
        folder.add("out.pcd.in", made["out.pcd"])  # a binary_compressed PCD file
        folder.add("out.png.in", made["out.png"])
        # Most allocations are made while the options are declared, and they are the same in every
        # run of a program. Only the first case of each program tests more than a few of them.
        of_program = {}
        reports = REPORTS if has_page(BARCODE) else []
        if not reports:
            print("skipped: --report: reports are not built in")
        for case in CASES + reports:
            sizes = check(folder, case, of_program.get(case[0], []), wrong)
            of_program.setdefault(case[0], sizes)
    print("\n".join([*wrong, f"{total[0]} runs"]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
