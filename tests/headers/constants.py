#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that bench/results/segmentation-constants.csv lists each number of libsegment that decides
on labels: constants.py ROOT.

Such a number must be the value of a constexpr name, and a row of the table must have its file, name
and value. The numbers 0, 1, 2 and 1/2 need no name, but a name with such a value needs a row as
well. Numbers that decide on no label are listed here. The exit code is 0 if code and table agree.
"""
import csv
import re
import sys
from collections import Counter
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "bench/scenes"))
import declarations

TABLE = "bench/results/segmentation-constants.csv"
LIBRARY = "libsegment"
PLACES = ("src", "include/ph/detail/segment/bounds.hpp")

# Folders, files and names (FILE:NAME) whose numbers decide on no label.
EXEMPT = {
    "src/pictures/": "sizes and colours of pictures",
    "src/files/": "formats of files",
    "src/tree/": "the format of trees, and checks of it",
    "src/notes.cpp": "texts",
    "src/objects/camera_motion.cpp": "a warning",
    "src/objects/oriented_box": "boxes of segments that are known already",
    "src/scene/options.cpp": "refusals",
    "src/pipeline.cpp:bytes_per_point": "memory",
    "src/pipeline.cpp:bytes_per_voxel": "memory",
    "src/plane/free_patches.cpp:middle": "computed from other constants",
    "src/plane/free_patches.cpp:whole": "rounding",
    "src/plane/free_patches.cpp:half": "rounding",
    "src/plane/plane.cpp:block": "time",
    "src/surface/concavity.cpp:kLanes": "time",
    "src/surface/concavity.cpp:most_steps": "rounding",
    "src/surface/concavity.cpp:least_step": "rounding",
    "src/surface/concavity.cpp:parallel": "rounding",
    "src/voxels/rips_graph.cpp:most": "time",
    "src/voxels/rips_graph.cpp:kEdgesOfAVoxel": "memory",
    "src/voxels/voxel_grid": "hashes, rounding and refusals",
    "src/voxels/voxel_pairs.hpp:some": "time",
}
PLAIN = {0.0, 0.5, 1.0, 2.0}
# Numbers that decide on no label wherever they are.
NEUTRAL = re.compile("|".join((
    r"0x[\da-f']+[ul]*",  # masks and hashes
    r"(?:<<|>>) \d+|rotl\(\w+, \d+|ldexp\(\w+, \d+",  # bits
    r"[<,] \d+>|<\d+>|<double, 3, [\dN]|<double, 3 \* N, 3 \* N>",  # sizes of types
    r"\[\d+\]|\.col\(\d+\)",  # places
    r"< 3\b|[-,] 3\)|, 3,|\+= 3\b|\b3 \* (?:[ikN]|points|vertices|static_cast)\b",  # three dimensions
    r"\b100 \* \w+",  # percent
    r"\(3 \* x\[k\]",  # the derivative of a cubic polynomial
    r"4\.0 / 3 \* std::numbers::pi",  # the volume of a ball
)), re.IGNORECASE)


def exempts(path, name=""):
    """The keys of EXEMPT that cover a name of a file."""
    return [key for key in EXEMPT
            if (key == f"{path}:{name}" if ":" in key else path.startswith(key))]


def bare_numbers(code):
    """The places of numbers that need a name. @param code without the values of constants."""
    neutral = [match.span() for match in NEUTRAL.finditer(code)]
    for match in declarations.NUMBER.finditer(code):
        if not any(begin <= match.start() < end for begin, end in neutral) and \
                declarations.value_of(match[0]) not in PLAIN:
            yield match


def sources(root):
    library = root / LIBRARY
    for place in PLACES:
        files = [library / place] if (library / place).is_file() else (library / place).rglob("*")
        yield from sorted(path for path in files if path.suffix in (".hpp", ".cpp"))


def compared(root, listed, used):
    """The violations of the sources. Removes what it finds from `listed`: pairs (file, name) with
    their values. Adds the keys of EXEMPT that cover something to `used`."""
    for path in sources(root):
        name_of_file = str(path.relative_to(root / LIBRARY))
        text = path.read_text()
        if keys := exempts(name_of_file):
            used.update(keys)
            continue
        constants = [c for c in declarations.constants_in(text) if not NEUTRAL.fullmatch(c.value)]
        used.update(key for c in constants for key in exempts(name_of_file, c.name))
        code = declarations.code_of(text)
        for c in constants:
            code = code[:c.begin] + re.sub(r"[^\n]", " ", code[c.begin:c.end]) + code[c.end:]
        for number in bare_numbers(code):
            line = code.count("\n", 0, number.start()) + 1
            yield f"{name_of_file}:{line}: found the number {number[0]}, expected a constexpr name"
        constants = [c for c in constants if not exempts(name_of_file, c.name)]
        for name, count in Counter(c.name for c in constants).items():
            if count > 1:
                yield f"{name_of_file}: found {name} {count} times, expected different names"
        for c in constants:
            value = listed.pop((name_of_file, c.name), None)
            if value is None:
                yield f"{name_of_file}: {c.name} = {c.value}: found no row of {TABLE}"
            elif value != c.value:
                yield f"{name_of_file}: {c.name} = {c.value}: found {value} in {TABLE}"


def main():
    root = Path(sys.argv[1]).resolve()
    with (root / TABLE).open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    listed = {(row["file"], row["name"]): row["value"] for row in rows}
    found = [f"{TABLE}: {file}: {name}: found {count} rows" for (file, name), count
             in Counter((row["file"], row["name"]) for row in rows).items() if count > 1]
    found += [f"{TABLE}: {row['file']}: {row['name']}: found no {column}"
              for row in rows for column in ("unit", "why", "change") if not row[column]]
    used = set()
    found += compared(root, listed, used)
    found += [f"{TABLE}: {file}: {name}: found no such constant" for file, name in listed]
    unused = [key for key in EXEMPT if key not in used]
    print(*found, *(f"EXEMPT: {key}: found no such place" for key in unused),
          f"{len(rows)} constants, {len(found)} violations, {len(unused)} exemptions of nothing", sep="\n")
    return 1 if found or unused else 0


if __name__ == "__main__":
    sys.exit(main())
