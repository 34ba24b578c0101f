# SPDX-License-Identifier: MIT
"""pages_tests.py PROGRAM…: the manual page and the reference page have every option, and are well
formed."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from described import name_of, options_of, printed

PROGRAMS = list(map(os.path.abspath, sys.argv[1:]))
SECTIONS = ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "FORMATS", "EXIT STATUS", "ENVIRONMENT",
            "EXAMPLES", "SEE ALSO"]
EXIT_CODES = [0, 1, 64, 65, 66, 69, 70, 73, 74, 75, 129, 130, 143]


def needs(tool):
    return unittest.skipUnless(shutil.which(tool), f"skipped: {tool} is not installed")


class ManPage(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.pages = {}
        for program in PROGRAMS:
            path = os.path.join(self.folder.name, f"{name_of(program)}.1")
            with open(path, "w", encoding="utf-8") as file:
                file.write(printed(program, "--help", "man"))
            self.pages[program] = path

    def shown(self, program, *formatter):
        """The page as a reader sees it, without bold face and underlining."""
        run = subprocess.run([*formatter, self.pages[program]], capture_output=True, text=True,
                             env={**os.environ, "MANWIDTH": "100", "LC_ALL": "C.UTF-8",
                                  "MAN_KEEP_FORMATTING": ""}, timeout=60, check=False)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        plain = re.sub(r"\x1b\[[0-9;]*m|.\x08", "", run.stdout)
        return plain.replace("\N{HYPHEN}", "-").replace("\N{MINUS SIGN}", "-")

    def check_shown(self, program, text):
        self.assertEqual(re.findall(r"(?m)^([A-Z][A-Z ]*)$", text), SECTIONS)
        words = set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", text))
        for option in options_of(program).values():
            for name in option.names:
                self.assertIn(name, words)
        status = text[text.index("EXIT STATUS"):text.index("ENVIRONMENT")]
        self.assertEqual([int(n) for n in re.findall(r"(?m)^ +(\d+) ", status)], EXIT_CODES)
        unbroken = re.sub(r"\s+", " ", text)
        for example in re.findall(rf"(?m)^  ({name_of(program)} .*)$",
                                  printed(program, "--help").split("\nExamples")[1]):
            self.assertIn(example, unbroken)

    @needs("man")
    def test_man_shows_it(self):
        for program in PROGRAMS:
            self.check_shown(program, self.shown(program, "man", "--warnings", "-l"))

    @needs("groff")
    def test_groff_has_no_warning(self):
        for program in PROGRAMS:
            for device in ("utf8", "ascii", "html"):
                run = subprocess.run(["groff", "-ww", "-man", f"-T{device}", self.pages[program]],
                                     capture_output=True, timeout=60, check=False)
                lines = run.stderr.decode()
                if device == "html" and "cannot" in lines:
                    continue  # groff needs further tools for this device
                self.assertEqual((run.returncode, lines), (0, ""), device)

    @needs("mandoc")
    def test_mandoc_finds_no_fault(self):
        for program in PROGRAMS:
            run = subprocess.run(["mandoc", "-Tlint", "-Wall", self.pages[program]],
                                 capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual((run.returncode, run.stdout), (0, ""))
            self.check_shown(program, self.shown(program, "mandoc", "-Tutf8"))

    def test_it_is_ascii(self):
        for path in self.pages.values():
            with open(path, "rb") as file:
                self.assertTrue(file.read().isascii())

    def test_options_and_values_can_be_copied(self):
        for program in PROGRAMS:
            with open(self.pages[program], encoding="utf-8") as file:
                source = file.read().replace("\\:", "")
            for option in options_of(program).values():
                # groff prints a plain "-" as a hyphen, which programs do not accept in place of a
                # minus sign.
                for text in (*option.names, option.value.replace("…", "...")):
                    self.assertIn(text.replace("-", "\\-"), source)


class ReferencePage(unittest.TestCase):
    def test_it_has_every_option(self):
        for program in PROGRAMS:
            page = printed(program, "--help", "markdown")
            entries = re.findall(r"(?m)^```\{option\} (.*)$", page)
            self.assertEqual(page.count(f"```{{program}} {name_of(program)}\n"), 1)
            known = options_of(program)
            written = [", ".join(f"{name} {option.value}".strip() for name in option.names)
                       for option in known.values()]
            self.assertEqual(sorted(entries), sorted(written))

    def test_its_references_are_options(self):
        for program in PROGRAMS:
            page = printed(program, "--help", "markdown")
            references = re.findall(r"\{option\}`(--[a-z-]+)<(\S+) (--[a-z-]+)>`", page)
            self.assertGreater(len(references), 3)
            for shown, of, target in references:
                self.assertEqual((shown, of), (target, name_of(program)))
                self.assertIn(target, options_of(program))
            # Outside code, typographic software would turn two hyphens into one dash.
            prose = re.sub(r"(?s)```.*?\n|`[^`]*`", "", re.sub(r"(?s)```(text|sh)\n.*?```", "", page))
            self.assertNotIn("--", prose)

    def test_sphinx_finds_no_fault(self):
        python = "/usr/bin/python3"  # the Python for which Debian packages Sphinx
        imported = "import sphinx.cmd.build, myst_parser"
        if subprocess.run([python, "-c", imported], capture_output=True, check=False).returncode:
            self.skipTest("skipped: Sphinx with MyST is not installed")
        with tempfile.TemporaryDirectory() as folder:
            names = [f"options-{name_of(program)}" for program in PROGRAMS]
            for program, name in zip(PROGRAMS, names):
                with open(os.path.join(folder, f"{name}.md"), "w", encoding="utf-8") as file:
                    file.write(printed(program, "--help", "markdown"))
            with open(os.path.join(folder, "index.md"), "w", encoding="utf-8") as file:
                file.write("# Options\n\n```{toctree}\n" + "\n".join(names) + "\n```\n")
            run = subprocess.run([python, "-m", "sphinx", "-q", "-n", "-W", "-b", "html", "-C", "-D",
                                  "extensions=myst_parser", folder, os.path.join(folder, "site")],
                                 capture_output=True, text=True, timeout=120, check=False)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            for program, name in zip(PROGRAMS, names):
                with open(os.path.join(folder, "site", f"{name}.html"), encoding="utf-8") as file:
                    anchors = set(re.findall(r'id="cmdoption-([^"]*)"', file.read()))
                for option in options_of(program):
                    self.assertIn(f"{name_of(program)}-{option[2:]}", anchors)

    def test_fences_are_closed(self):
        for program in PROGRAMS:
            page = printed(program, "--help", "markdown")
            self.assertEqual(len(re.findall(r"(?m)^```", page)) % 2, 0)
            self.assertTrue(page.startswith("# "))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
