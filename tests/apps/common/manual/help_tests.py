# SPDX-License-Identifier: MIT
"""help_tests.py SOURCE_FOLDER PROGRAM…: --help is short, its topics contain all options, and its
examples run unchanged."""
import collections
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from described import name_of, options_in, options_of, printed, topics_of

SOURCE, *PROGRAMS = map(os.path.abspath, sys.argv[1:])
SCREEN = 80  # columns
SHORT = 70   # lines
NOT_BUILT_IN = 69


def examples_of(program):
    """The commands at the end of the help."""
    text = printed(program, "--help")
    return re.findall(rf"(?m)^  ({name_of(program)} .*)\n      \S", text[text.index("Examples"):])


class Help(unittest.TestCase):
    def each(self):
        for program in PROGRAMS:
            with self.subTest(program=name_of(program)):
                yield program

    def test_it_is_short(self):
        for program in self.each():
            text = printed(program, "--help")
            self.assertEqual(text, printed(program, "-h"))
            self.assertLessEqual(len(text.splitlines()), SHORT)
            self.assertEqual(len(options_in(text)), 12)
            self.assertTrue(text.startswith(f"Usage: {name_of(program)} "))
            self.assertLess(text.index("Options used most"), text.index("Topics"))
            self.assertLess(text.index("Topics"), text.index("Examples"))

    def test_lines_fit_a_terminal(self):
        for program in self.each():
            for topic in ("all", *topics_of(program)):
                for line in printed(program, "--help", topic).splitlines():
                    self.assertLessEqual(len(line), SCREEN, line)
            body, examples = printed(program, "--help").split("\nExamples")
            for line in body.splitlines():
                self.assertLessEqual(len(line), SCREEN, line)
            self.assertTrue(examples)  # each command is on one line, however long

    def test_each_option_has_one_topic(self):
        for program in self.each():
            listed = collections.Counter(
                option.name for topic in topics_of(program)
                for option in options_in(printed(program, "--help", topic)))
            self.assertEqual(set(listed), set(options_of(program)))
            self.assertEqual({name: n for name, n in listed.items() if n != 1}, {})
            self.assertGreater(len(listed), 20)

    def test_a_topic_says_what_all_says(self):
        for program in self.each():
            everything = printed(program, "--help", "all")
            for topic in topics_of(program):
                self.assertIn(printed(program, "--help", topic), everything)
                self.assertEqual(printed(program, "--help", topic),
                                 printed(program, f"--help={topic}"))
            for option in options_in(printed(program, "--help")):
                self.assertIn(option.name, options_of(program))

    def test_an_unknown_topic_is_refused_with_the_list(self):
        for program in self.each():
            for typed, meant in (("outputs", "output"), ("examples/data/table.pcd", None)):
                run = subprocess.run([program, "--help", typed], capture_output=True, text=True,
                                     check=False)
                self.assertEqual((run.returncode, run.stdout, run.stderr.count("\n")), (64, "", 1))
                for topic in (*topics_of(program), "all", "man", "markdown", "bash", "zsh", "fish"):
                    self.assertRegex(run.stderr, rf"\b{topic}\b")
                self.assertEqual("did you mean" in run.stderr, meant is not None)
                self.assertIn(f"did you mean '{meant}'" if meant else typed, run.stderr)

    def test_there_are_five_examples(self):
        for program in self.each():
            examples = examples_of(program)
            self.assertEqual(len(examples), 5, examples)
            self.assertTrue(printed(program, "--help").rstrip().splitlines()[-2]
                            .endswith(examples[-1]))

    def test_examples_run_as_they_stand(self):
        for program in PROGRAMS:
            for example in examples_of(program):
                with self.subTest(example=example):
                    self.run_example(program, example)

    def run_example(self, program, example):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(os.path.join(SOURCE, "examples"), os.path.join(folder, "examples"))
            path = os.pathsep.join([os.path.dirname(program), os.environ["PATH"]])
            run = subprocess.run(example, shell=True, cwd=folder, env={**os.environ, "PATH": path},
                                 capture_output=True, text=True, timeout=60, check=False)
            if run.returncode == NOT_BUILT_IN:
                self.skipTest(f"skipped: {run.stderr.strip()}")
            self.assertEqual(run.returncode, 0, run.stderr)
            made = re.findall(r"(?<![\w/])[a-z]+\.[a-z]+", example)
            self.assertEqual(sorted(made), sorted(set(os.listdir(folder)) - {"examples"}))
            # A command that writes no file must print something.
            self.assertTrue(made or run.stdout)
            for name in made:
                self.assertGreater(os.path.getsize(os.path.join(folder, name)), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
