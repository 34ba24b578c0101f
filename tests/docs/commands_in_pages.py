# SPDX-License-Identifier: MIT
"""Runs the commands that pages show and compares what they print: commands_in_pages.py BIN… -- PAGE…

In a block ```console, a line `$ command` is run in a copy of the repository with the programs of the folders BIN
on the path; a backslash at its end continues it in the next line. The lines after it are what it prints. `…` stands
for anything within a line, a line `…` for any number of lines.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```console\n(.*?)^```", re.MULTILINE | re.DOTALL)


def commands_of(page):
    """@return pairs (command, expected lines)."""
    commands = []
    for block in BLOCK.findall(page.read_text(encoding="utf-8")):
        for line in block.splitlines():
            if line.startswith("$ "):
                commands.append((line[2:], []))
            elif commands and commands[-1][0].endswith("\\"):
                commands[-1] = (f"{commands[-1][0]}\n{line}", [])
            elif commands:
                commands[-1][1].append(line)
    return commands


def matches(expected, printed):
    parts = ["(?:.*\n)*" if line == "…" else ".*".join(map(re.escape, line.split("…"))) + "\n" for line in expected]
    return re.fullmatch("".join(parts), printed) is not None


def main():
    split = sys.argv.index("--")
    path = os.pathsep.join([*map(os.path.abspath, sys.argv[1:split]), os.environ["PATH"]])
    count = failures = 0
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(ROOT / "examples", pathlib.Path(folder) / "examples")
        for name in sys.argv[split + 1:]:
            commands = commands_of(ROOT / name)
            if not commands:
                print(f"{name}: found no command, expected a block ```console")
                failures += 1
            for command, expected in commands:
                count += 1
                run = subprocess.run(command, shell=True, cwd=folder, env={**os.environ, "PATH": path}, text=True,
                                     stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120)
                if run.returncode != 0 or not matches(expected, run.stdout):
                    failures += 1
                    print(f"{name}: $ {command}\nexit code {run.returncode}, found:\n{run.stdout}expected:\n"
                          + "".join(f"{line}\n" for line in expected))
    print(f"{count} commands, {failures} differ")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
