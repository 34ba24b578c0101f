#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the programs that pages show: they compile and print what the page says.

    programs_in_pages.py write PAGE FOLDER COUNT     writes PAGE's programs to FOLDER/1.cpp, …
    programs_in_pages.py run PAGE NUMBER PROGRAM     runs PROGRAM, compiled from one of the files

A program is a block ```cpp with a main function. The block ```text after it is its expected output.
A program runs in a folder that is empty except for a link to `examples`.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
BLOCK = re.compile(r"^```(cpp|text)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def programs_of(page):
    """@return pairs (source, expected output)."""
    blocks = BLOCK.findall(Path(page).read_text(encoding="utf-8"))
    programs = []
    for (kind, text), (next_kind, printed) in zip(blocks, [*blocks[1:], ("", "")]):
        if kind == "cpp" and "int main(" in text:
            if next_kind != "text":
                sys.exit(f"{page}: program {len(programs) + 1}: expected a block ```text after it")
            programs.append((text, printed))
    return programs


def write(page, folder, count):
    programs = programs_of(page)
    if len(programs) != int(count):
        sys.exit(f"{page}: found {len(programs)} programs, expected {count}")
    for number, (source, _) in enumerate(programs, 1):
        Path(folder, f"{number}.cpp").write_text(source, encoding="utf-8")


def run(page, number, program):
    expected = programs_of(page)[int(number) - 1][1]
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "examples").symlink_to(EXAMPLES)
        ended = subprocess.run([program], cwd=folder, capture_output=True, text=True, timeout=60)
    if ended.returncode != 0 or ended.stdout != expected:
        sys.exit(f"{page}: program {number}: exit code {ended.returncode}, found:\n{ended.stdout}"
                 f"{ended.stderr}expected:\n{expected}")
    print(f"{page}: program {number} prints what the page says")


if __name__ == "__main__":
    {"write": write, "run": run}[sys.argv[1]](*sys.argv[2:])
