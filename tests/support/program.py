# SPDX-License-Identifier: MIT
"""Runs a program in a separate folder. Shared by the tests that run programs."""
import os
import re
import subprocess
import sys
import tempfile
import unittest

import files

PROGRAM = None
SQUARE = "0 0\n1 0\n1 1\n0 1.25\n"
SQUARE_CSV = ("dim,birth,death\n0,0,1\n0,0,1\n0,0,1.0307764064044151\n0,0,inf\n"
              "1,1.25,1.4142135623730951\n")


def has_page(program):
    """True if the report page is built in; otherwise, --report ends with exit code 69."""
    said = subprocess.run([program, "--version", "--verbose"], check=True, text=True,
                          stdout=subprocess.PIPE).stdout
    return re.search("reports +built in", said) is not None


class FolderTest(unittest.TestCase):
    """A test that has its own folder."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = self._folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        mode = "wb" if isinstance(content, bytes) else "w"
        with open(self.path(name), mode) as file:
            file.write(content)
        return name

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def read_bytes(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def files(self):
        return sorted(os.listdir(self.folder))


class ProgramTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.write("square.txt", SQUARE)

    def run_program(self, *arguments, **options):
        """Runs the program in the test's folder. Output is text unless text=False is given."""
        options.setdefault("text", True)
        options.setdefault("timeout", 60)
        options.setdefault("stdin", subprocess.DEVNULL)
        if "input" in options:
            options.pop("stdin")
        options.setdefault("stdout", subprocess.PIPE)
        options.setdefault("stderr", subprocess.PIPE)
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, **options)

    def expect(self, code, *arguments, **options):
        """Runs the program, checks its exit code, and checks that an error is one line. @return the
        run."""
        run = self.run_program(*arguments, **options)
        self.assertEqual(run.returncode, code, f"{arguments}: {run.stderr!r}")
        if code != 0 and isinstance(run.stderr, str):
            lines = [line for line in run.stderr.splitlines() if ": read " not in line]
            self.assertLessEqual(len(lines), 1, run.stderr)
        return run

    def require_page(self):
        """Skips the rest of a subtest or test if reports are not built in."""
        if not has_page(PROGRAM):
            self.skipTest("reports are not built in")


def main():
    global PROGRAM
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    # Tests import this file under its own name, which makes a second module. Both modules need to
    # know the program.
    sys.modules["program"].PROGRAM = PROGRAM
    unittest.main(verbosity=2)
