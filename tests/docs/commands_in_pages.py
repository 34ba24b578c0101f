# SPDX-License-Identifier: MIT
"""Runs the commands that pages show and compares their output: commands_in_pages.py BIN… [-- PAGE…]
Without PAGE, it takes all pages with commands.

In a block ```console, each line `$ command` is run. All commands of a page run in a separate
folder, which contains a copy of examples/. The folders BIN, which contain the programs, are on the
path. A backslash at the end of a line continues the command. The lines after a command are its
expected output, in which `…` stands for any text within a line, and a line `…` for any number of
lines. Commands that write a report are skipped with a message if the report page is not built in,
and so are commands that use jq if it is missing.

A picture images/pages/NAME.svg on a page must equal, byte for byte, the file NAME.svg that the
commands of the page write; docs/images/make.py copies it.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))
from program import has_page  # noqa: E402

PICTURE = re.compile(r"\]\([./]*images/pages/([\w-]+\.svg)\)")
BLOCK = re.compile(r"^```console\n(.*?)^```", re.MULTILINE | re.DOTALL)


def commands_of(page):
    """@return pairs (command, lines of its expected output)."""
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


def pictures_of(page):
    """The names of the pictures that the page's commands draw."""
    return PICTURE.findall(page.read_text(encoding="utf-8"))


def matches(expected, printed):
    parts = ["(?:.*\n)*" if line == "…" else ".*".join(map(re.escape, line.split("…"))) + "\n" for line in expected]
    return re.fullmatch("".join(parts), printed) is not None


def why_left_out(command, path):
    """The reason to skip a command: it writes a report but its program has no report page built in,
    or it needs a program that is missing. Empty if it can run."""
    if "--report" in command and not has_page(shutil.which(command.split()[0], path=path)):
        return "reports are not built in"
    if "| jq " in command and not shutil.which("jq", path=path):
        return "jq is missing"
    return ""


def pages_with_commands():
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    return [page for page in pages if commands_of(page)]


def failures_of(page, path):
    """Runs the commands of a page. @return the numbers of commands, of skipped commands, and of
    differences."""
    commands, skipped, failures = commands_of(page), 0, 0
    if not commands:
        print(f"{page}: found no command, expected a block ```console")
        return 0, 0, 1
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(ROOT / "examples", pathlib.Path(folder) / "examples")
        for command, expected in commands:
            if reason := why_left_out(command, path):
                skipped += 1
                print(f"skipped, for {reason}: {page.relative_to(ROOT)}: $ {command}")
                continue
            run = subprocess.run(command, shell=True, cwd=folder, env={**os.environ, "PATH": path}, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120)
            if run.returncode != 0 or not matches(expected, run.stdout):
                failures += 1
                print(f"{page.relative_to(ROOT)}: $ {command}\nexit code {run.returncode}, found:\n{run.stdout}"
                      "expected:\n" + "".join(f"{line}\n" for line in expected))
        for name in pictures_of(page):
            made, kept = pathlib.Path(folder, name), ROOT / "docs/images/pages" / name
            if not made.exists() or made.read_bytes() != kept.read_bytes():
                failures += 1
                print(f"{page.relative_to(ROOT)}: {name} is not what its commands draw; docs/images/make.py makes it")
    return len(commands), skipped, failures


def main():
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    path = os.pathsep.join([*map(os.path.abspath, sys.argv[1:split]), os.environ["PATH"]])
    pages = [ROOT / page for page in sys.argv[split + 1:]] or pages_with_commands()
    results = [failures_of(page, path) for page in pages]
    count, skipped, failures = (sum(column) for column in zip(*results))
    print(f"{len(pages)} pages, {count} commands, {skipped} skipped, {failures} differ")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
