# SPDX-License-Identifier: MIT
"""foreign_options.py SOURCE_FOLDER PROGRAM…: each program answers the options of other programs with
its own options. The rows are read from the table in the source."""
import os
import re
import subprocess
import sys
import unittest

SOURCE, *PROGRAMS = map(os.path.abspath, sys.argv[1:])
TABLE = os.path.join(SOURCE, "apps", "common", "arguments", "foreign_options.cpp")


def rows():
    """The names, and the option that a program must have."""
    with open(TABLE, encoding="utf-8") as file:
        found = re.findall(r'ForeignOptions\{\s*"([^"]+)",\s*"(--[^"]+)"', file.read())
    return [(names.split(), option) for names, option in found]


def run(program, *arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=False)


def options_of(program):
    return set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", run(program, "--help", "all").stdout))


class ForeignOptions(unittest.TestCase):
    def test_each_row_in_each_program(self):
        applied = set()
        for program in PROGRAMS:
            own = options_of(program)
            self.assertGreater(len(own), 20)
            answered = set()
            for names, option in rows():
                if option not in own:
                    continue
                applied.add(option)
                for name in set(names) - answered:
                    with self.subTest(program=os.path.basename(program), name=name):
                        self.assertNotIn(f"--{name}", own, "the option exists: delete the name")
                        refused = run(program, f"--{name}", "1")
                        self.assertEqual((refused.returncode, refused.stdout), (64, ""))
                        message = refused.stderr.split("; ", 1)[1]
                        self.assertNotIn("--help all", message)
                        self.assertLessEqual(set(re.findall(r"--[a-z][a-z-]*", message)), own)
                answered.update(names)
        self.assertEqual(applied, {option for _, option in rows()})
        self.assertGreater(len(applied), 20)

    def test_the_values_of_hints_exist(self):
        """The commands that hints quote, such as '--nan drop', name values that programs accept."""
        with open(TABLE, encoding="utf-8") as file:
            text = file.read().replace('"\n', "").replace("\n", " ")
        text = re.sub(r'" +"', "", re.sub(r'\s+"', ' "', text))
        quoted = re.findall(r"'(--[a-z-]+) ([a-z]+)'", text)
        self.assertGreater(len(quoted), 5)
        helps = [run(program, "--help", "all").stdout for program in PROGRAMS]
        for option, value in quoted:
            with self.subTest(option=option, value=value):
                self.assertTrue(any(re.search(rf"{option} \S*\n?\s*\S*\b{value}\b", text)
                                    for text in helps))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
