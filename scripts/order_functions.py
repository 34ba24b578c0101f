#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes cmake/function_order.ld, which puts side by side what most runs of the programs go through:
order_functions.py BUILD (a folder with statically linked programs). Needs valgrind, nm and NumPy.
What has another name by now is linked elsewhere: order_functions.py --check BUILD fails when that
is so for more than a tenth of it."""
import argparse
import os
import re
import subprocess
import sys
import tempfile
from bisect import bisect_left, bisect_right
from os.path import commonprefix

HERE = os.path.dirname(os.path.abspath(__file__))
RESULT = os.path.join(HERE, "..", "cmake", "function_order.ld")
UNUSED = 2000  # bytes of unused functions that are taken along for one pattern less
MOST_STALE = 0.1  # of the patterns

HEADER = """/* SPDX-License-Identifier: MIT
   What most runs of the programs go through, side by side: the system maps programs in pieces of
   64 KiB, wherever one of them is touched. Written by scripts/order_functions.py. */
"""


def inputs(folder):
    """Files of points, distances and voxels."""
    import numpy as np  # not needed for --check
    rng = np.random.default_rng(1)
    sphere = rng.normal(size=(300, 3))
    sphere /= np.linalg.norm(sphere, axis=1)[:, None]
    np.savetxt(os.path.join(folder, "points.txt"), sphere, fmt="%.6f")
    np.savetxt(os.path.join(folder, "points.csv"), sphere, fmt="%.6f", delimiter=",")
    distances = np.linalg.norm(sphere[:, None] - sphere[None], axis=2)[:120, :120]
    np.save(os.path.join(folder, "distances.npy"), (distances + distances.T) / 2)
    np.save(os.path.join(folder, "image.npy"), rng.integers(0, 255, (40, 40)).astype(np.uint8))
    table = np.stack(np.meshgrid(np.arange(60), np.arange(60)), -1).reshape(-1, 2) * 0.01
    height = np.where(np.all((table > 0.2) & (table < 0.4), axis=1), 0.9, 1.0)
    np.savetxt(os.path.join(folder, "table.xyz"), np.column_stack([table, height]), fmt="%.3f")


RUNS = [
    ["barcode", "points.txt"],
    ["barcode", "points.txt", "--max-dim", "2"],
    ["barcode", "points.csv", "--max-dim", "2", "--threshold", "0.5", "-o", "bars.csv"],
    ["barcode", "distances.npy", "--format", "distance"],
    ["barcode", "image.npy", "--output-format", "json"],
    ["segment", "table.xyz", "--labels", "labels.npy"],
]


def functions(program):
    """@return (address, size, name) of each, in order of addresses."""
    lines = subprocess.run(["nm", "-S", program], check=True, capture_output=True,
                           text=True).stdout.splitlines()
    fields = [line.split() for line in lines]
    return sorted((int(f[0], 16), int(f[1], 16), f[3]) for f in fields
                  if len(f) == 4 and f[2] in "tTwWiu")


def executed(trace):
    """@return the addresses of the instructions that callgrind saw."""
    result, address = set(), 0
    with open(trace) as file:
        for line in file:
            if found := re.match(r"(0x[0-9a-f]+|[+-]\d+|\*) ", line):
                word = found[1]
                if word[0] == "0":
                    address = int(word, 16)
                elif word != "*":  # as before
                    address += int(word)
                result.add(address)
    return result


def used_functions(program, arguments, folder):
    trace = os.path.join(folder, "trace")
    subprocess.run(["valgrind", "--tool=callgrind", "--dump-instr=yes",
                    f"--callgrind-out-file={trace}", program, *arguments, "--threads", "1"],
                   cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    known = functions(program)
    addresses = [f[0] for f in known]
    used = {addresses[k - 1] for a in executed(trace) if (k := bisect_right(addresses, a)) > 0}
    return {name for address, _, name in known if address in used}


def section(name):
    """@return the name of a function without what the compiler appends to that of its copies."""
    return re.sub(r"(\.(constprop|isra|part|cold|lto_priv)[.\d]*)+$", "", name)


def patterns(sizes, used, low, high):
    """@return (cost, the fewest prefixes of the names sizes[low:high] that have all that are used
    and little else); sizes: (name, bytes), sorted."""
    names = [name for name, _ in sizes[low:high]]
    if not any(name in used for name in names):
        return 0, []
    prefix = commonprefix([names[0], names[-1]])
    unused = sum(size for name, size in sizes[low:high] if name not in used)
    together = 1 + unused / UNUSED, [prefix + "*"]
    if len(names) == 1:
        return together
    cost, apart = 0, []
    while low < high:
        first = sizes[low][0]
        end = low + 1
        while len(first) > len(prefix) and end < high and \
                sizes[end][0][:len(prefix) + 1] == first[:len(prefix) + 1]:
            end += 1
        if first == prefix:
            more = (1, [first]) if first in used else (0, [])
        else:
            more = patterns(sizes, used, low, end)
        cost, apart, low = cost + more[0], apart + more[1], end
    return min(together, (cost, apart), key=lambda choice: choice[0])


def check(programs):
    with open(RESULT) as file:
        chosen = re.findall(r"\*\(\.text\.(\w+)(?:\*?)\)", file.read())
    names = sorted({name for program in programs.values() for _, _, name in functions(program)})
    stale = []
    for prefix in chosen:
        k = bisect_left(names, prefix)
        if k == len(names) or not names[k].startswith(prefix):
            stale.append(prefix)
    print(f"{len(chosen)} patterns, {len(stale)} of them fit no function", *stale, sep="\n  ")
    return 0 if chosen and len(stale) <= MOST_STALE * len(chosen) else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    programs = {name: os.path.abspath(f"{arguments.build}/apps/{name}/ph-{name}")
                for name in ("barcode", "segment")}
    if arguments.check:
        return check(programs)
    sys.setrecursionlimit(10_000)
    used, sizes = set(), {}
    with tempfile.TemporaryDirectory() as folder:
        inputs(folder)
        for name, *options in RUNS:
            used |= {section(f) for f in used_functions(programs[name], options, folder)}
    for program in programs.values():
        sizes.update((section(name), size) for _, size, name in functions(program)
                     if name.startswith("_Z"))  # those of C lie where their archives have them
    _, chosen = patterns(sorted(sizes.items()), used, 0, len(sizes))
    with open(RESULT, "w") as file:
        file.write(HEADER + "SECTIONS {\n  .text.usual : {\n")
        file.writelines(f"    *(.text.{pattern})\n" for pattern in chosen)
        file.write("  }\n} INSERT BEFORE .text;\n")
    print(f"{len(chosen)} patterns for {len(used & set(sizes))} functions")
    return 0


if __name__ == "__main__":
    sys.exit(main())
