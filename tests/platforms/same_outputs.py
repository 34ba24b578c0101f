#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether programs of two builds print and write the same bytes: same_outputs.py BUILD OTHER [EMULATOR…].

The commands read each file of examples/data. Compared are exit code, standard output and error, and
each file that is written, but for times and memory. EMULATOR runs the programs
of OTHER. The last line has the counts. Exit code 0 if nothing differs.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

DATA = Path(__file__).resolve().parents[2] / "examples/data"
BARCODE, SEGMENT = "apps/barcode/ph-barcode", "apps/segment/ph-segment"
VECTORISE, DISTANCE = "apps/vectorise/ph-vectorise", "apps/distance/ph-distance"
# Of a run, not of its result: times, and memory, which a forecast measures on a part of the input.
MEASURED = re.compile(rb'"timings": \{[^}]*\}|"(?:seconds|time|peak_memory)": [-+.e\d]+|; [.\d]+ m?s$|'
                      rb'^memory  .*$', re.M)


def commands():
    """Program and arguments; files that are written begin with `out`."""
    yield [BARCODE, "two_circles.csv", "--max-dim", "2", "--check"]
    yield [BARCODE, "two_circles.csv", "--representatives", "cycles", "-o", "out.json", "--loops", "tight"]
    yield [BARCODE, "two_circles.csv", "--plot", "out.svg", "--plot", "out.png", "-o", "out.csv"]
    yield [BARCODE, "two_circles.csv", "--dry-run"]
    yield [BARCODE, "two_circles.csv", "-o", "out-größe-→.json", "--quiet"]
    for metric in ("manhattan", "chebyshev", "cosine", "hamming", "minkowski:3"):
        yield [BARCODE, "torus.csv", "--metric", metric, "--subsample", "60"]
    for engine in ("standard", "twist", "cohomology", "edge-links"):
        yield [BARCODE, "two_circles.csv", "--engine", engine, "--threads", "2"]
    for field in ("2", "3", "11"):
        yield [BARCODE, "torus.csv", "--field", field, "--threshold", "1.2", "--max-dim", "1"]
    yield [BARCODE, "correlations.csv", "--from-correlation"]
    yield [BARCODE, "pulse.csv", "--threads", "2"]
    for image in ("blobs.pgm", "phantom.nii.gz"):
        for more in ([], ["--superlevel"], ["--representatives", "cycles", "-o", "out.json"]):
            yield [BARCODE, image, *more]
    yield [BARCODE, "hills.ply", "-o", "out.npy"]
    yield [BARCODE, "stack.pcd", "--subsample", "80", "-o", "out.dipha"]
    for cloud in ("table.pcd", "stack.pcd"):
        yield [SEGMENT, cloud, "-o", "out.pcd", "--labels", "out.npy", "--json", "out.json"]
        yield [SEGMENT, cloud, "--parts", "--plot", "out.svg", "--plot-kind", "cloud"]
    yield [SEGMENT, "stack.pcd", "--explain", "1,2"]
    yield [SEGMENT, "table.pcd", "--plot", "out.png"]
    for kind in ("statistics", "betti", "landscape", "silhouette", "image", "life-entropy", "lengths", "atol",
                 "euler"):
        yield [VECTORISE, "bars", "--kind", kind, "-o", "out.npy", "--fit", "out.json"]
    yield [VECTORISE, "blobs.pgm", "phantom.nii.gz", "--kind", "euler"]
    for options in ([], ["--distance", "wasserstein"], ["--distance", "wasserstein", "--order", "3", "--ground", "1.5"],
                    ["--distance", "sliced"]):
        matching = [] if "sliced" in options else ["--matching", "out.csv"]
        yield [DISTANCE, "bars", *options, *matching, "-o", "out.json"]
    yield [DISTANCE, "bars", "bars", "--dim", "1", "--matrix", "out.npy"]


def result_of(build, emulator, command):
    """Exit code, outputs and files as bytes, by name."""
    with tempfile.TemporaryDirectory() as folder:
        for file in DATA.iterdir():
            Path(folder, file.name).symlink_to(file)
        program = build / command[0]
        if not program.exists():  # for Windows
            program = program.with_name(program.name + ".exe")
        run = subprocess.run([*emulator, str(program), *command[1:]], cwd=folder,
                             capture_output=True, check=False)
        files = {path.name: path.read_bytes() for path in Path(folder).glob("out*")}
    return {"exit code": b"%d" % run.returncode, "standard output": run.stdout,
            "standard error": run.stderr, **files}


def without_measurements(content):
    return MEASURED.sub(b"", content)


def main():
    build, other, *emulator = sys.argv[1:]
    count = compared = 0
    faults = []
    for command in commands():
        ours = result_of(Path(build).resolve(), [], command)
        theirs = result_of(Path(other).resolve(), emulator, command)
        words = " ".join(command)
        count += 1
        compared += len(ours)
        if ours["exit code"] not in (b"0",):
            faults.append(f"{words}: exit code {ours['exit code'].decode()}: "
                          f"{ours['standard error'].decode().strip()}")
        if ours.keys() != theirs.keys():
            faults.append(f"{words}: found files {sorted(theirs)}, expected {sorted(ours)}")
        faults += [f"{words}: {name} differs" for name in ours.keys() & theirs.keys()
                   if without_measurements(ours[name]) != without_measurements(theirs[name])]
    print("\n".join([*faults, f"{count} commands, {compared} outputs, {len(faults)} differ"]))
    return 1 if faults or not count else 0


if __name__ == "__main__":
    sys.exit(main())
