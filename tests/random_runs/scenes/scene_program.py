# SPDX-License-Identifier: MIT
"""Runs ph-segment in a folder, and checks its messages."""
import pathlib
import re

import random_runs


class Program(random_runs.Program):
    def files(self):
        return {p.name: p.read_bytes() for p in pathlib.Path(self.folder).iterdir() if p.is_file()}

    def __call__(self, options, stdin=None):
        """Runs the program. @return the exit code. Files of earlier calls are kept."""
        self.before = self.files()
        return super().__call__(options, stdin)

    def must(self, options, stdin=None):
        if self(options, stdin) != 0:
            self.differ("found a refusal, expected a result")

    def output(self, name):
        return pathlib.Path(self.folder, name).read_bytes()

    def expect_refusal(self, codes, named):
        """Checks that there is a message (one line with --quiet) that names the fault, and no
        output."""
        found = self.run.returncode
        last = self.said.splitlines()[-1] if self.said else ""
        if found not in codes or self.run.stdout or not self.said.endswith("\n"):
            self.differ(f"found exit {found}, expected one of {codes}, a message and no output")
        names = named in last
        if not last.startswith("ph-segment: ") or not names:
            self.differ(f"found another last line than one that names {named or 'the program'}")
        if "--quiet" in self.command and self.said.count("\n") != 1:
            self.differ("found more than one line with --quiet")
        now = self.files()
        if now != self.before:
            self.differ(f"found other files after a refusal: {sorted(set(now) ^ set(self.before))}")

    def last_line(self, summary, words):
        """Checks the line with the numbers of segments and points on standard error."""
        if ["--quiet"] in words:
            return None if not self.said else self.differ("found messages with --quiet")
        last = self.said.splitlines()[-1]
        count, vertices = len(summary["segments"]), summary["complex"]["vertices"]
        expected = f"{vertices} voxels, {summary['complex']['edges']} edges, {count} segment"
        if not last.startswith(f"ph-segment: {summary['input']['points']} points, ") or expected not in last or \
                not re.search(r"; [0-9.]+ ms$", last):
            self.differ(f"found the last line {last!r}, expected {expected!r}")
        return None
