#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that each test is run: unrun.py ROOT.

A test is a source file in tests, python/tests or viewer/test. It is run if a CMakeLists.txt, a
script for people or a workflow names it, or if a test that is run names or imports it. CMake finds
the tests of python/tests and viewer/test by their names, which must therefore have the form that
CMake looks for. The exit code is 0 if each test is run.
"""
import ast
import re
import sys
from pathlib import Path

SUFFIXES = (".py", ".cpp", ".c", ".cu", ".mjs", ".sh")
BY_HAND = {"viewer/test/in_firefox.mjs"}
NAME = re.compile(r"[\w./-]+\.(?:py|cpp|cu|c|mjs|sh|cmake)\b")


def tests_in(root):
    """The files that must be run, by name."""
    tests = {}
    for folder in ("tests", "python/tests", "viewer/test"):
        for path in sorted((root / folder).rglob("*")):
            is_source = path.suffix in SUFFIXES and "violations" not in path.relative_to(root).parts
            if is_source and path.relative_to(root).as_posix() not in BY_HAND:
                tests.setdefault(path.name, []).append(path)
    return tests


def roots_in(root):
    for folder in ("tests", "python", "libreport", "bench", "examples", "scripts", ".github"):
        for path in sorted((root / folder).rglob("*")):
            is_list = path.name == "CMakeLists.txt" or folder in ("scripts", ".github")
            if is_list and path.is_file() and "violations" not in path.relative_to(root).parts:
                yield path


def names_in_python(text):
    """The modules that a Python file imports, as paths, and the files in its texts. Comments and
    docstrings do not count."""
    docstrings = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from (alias.name.replace(".", "/") + ".py" for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            folder = (node.module or "").replace(".", "/")
            yield from (f"{folder}.py", *(f"{folder}/{alias.name}.py" for alias in node.names))
        elif isinstance(node, ast.Expr):
            docstrings.add(node.value)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            if node not in docstrings:
                yield from NAME.findall(node.value)


def names_in_list(text):
    """The files that a CMakeLists.txt, a script or a workflow names, also in a loop over names:
    foreach(suite loops parts), and then ${suite}.py. Comments do not count."""
    text = re.sub(r"(^|\s)#.*", "", text)
    yield from NAME.findall(text)
    for suffix in re.findall(r"\$\{\w+\}(\.py|\.cpp)\b", text):
        yield from (stem + suffix for stem in re.findall(r"[\w/]+", text))


def named_by(path, tests):
    """The tests that a file names. A name means the file in the same folder, if there is one, or
    files of this name in other folders."""
    text = path.read_text(errors="replace")
    names = {".py": names_in_python, ".cpp": NAME.findall, ".mjs": NAME.findall}.get(
        path.suffix, names_in_list)(text)
    for name in {name.lstrip("./") for name in names}:
        here = path.parent / name
        known = tests.get(Path(name).name, [])
        yield from [here] if here in known else [
            test for test in known if test.as_posix().endswith(f"/{name}")]


def found_by_name(path, root):
    """True if CMake finds the test by its name."""
    folder = path.relative_to(root).parts[0]
    return folder == "python" and path.name.startswith("test_") or path.name.endswith(".test.mjs")


def has_tests(path, root):
    """False for a file of python/tests or viewer/test that other tests may use."""
    text = path.read_text()
    return {"python": re.search(r"^def test_", text, re.M) is not None,
            "viewer": "support" not in path.parts}.get(path.relative_to(root).parts[0], True)


def main():
    root = Path(sys.argv[1]).resolve()
    tests = tests_in(root)
    every = [path for paths in tests.values() for path in paths]
    waiting = [*roots_in(root), *(path for path in every if found_by_name(path, root))]
    run = set()
    while waiting:
        path = waiting.pop()
        if path not in run:
            run.add(path)
            waiting += named_by(path, tests)
    unrun = [path for path in every if path not in run and has_tests(path, root)]
    for path in unrun:
        print(f"{path.relative_to(root)}: nothing runs this test; name it in a CMakeLists.txt, or "
              "import it in a test")
    print(f"{len(every)} tests, {len(unrun)} not run")
    return 1 if unrun or not every else 0


if __name__ == "__main__":
    sys.exit(main())
