# SPDX-License-Identifier: MIT
"""completion_tests.py PH_BARCODE PH_SEGMENT EXTENDED_BARCODE: tests completion in shells that run
in a terminal. EXTENDED_BARCODE is a ph-barcode with one more engine and one more complex."""
import os
import re
import shutil
import sys
import tempfile
import unittest

import shells
from described import options_of, printed, topics_of

BARCODE, SEGMENT, EXTENDED = map(os.path.abspath, sys.argv[1:])
SHELLS = {"bash": (shells.Bash, "{}"), "zsh": (shells.Zsh, "_{}"), "fish": (shells.Fish, "{}.fish")}
FILES = ["points.csv", "bars.svg", "bars.png", "page.html", "cloud.pcd", "pair of.svg"]


def words(shown):
    return set(re.findall(r"[\w.:+-]+", shown))


class Completion:
    """The tests of one shell. Each subclass below names its shell."""
    shell = None

    @classmethod
    def setUpClass(cls):
        if not shutil.which(cls.shell):
            raise unittest.SkipTest(f"skipped: {cls.shell} is not installed")

    def start(self, program, name=None):
        """Starts the shell in a folder with files and the completion script, which is named after
        the program."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        for file in FILES:
            with open(os.path.join(folder.name, file), "w", encoding="ascii"):
                pass
        os.makedirs(os.path.join(folder.name, "results"))
        os.makedirs(os.path.join(folder.name, "scripts"))
        kind, pattern = SHELLS[self.shell]
        script = os.path.join(folder.name, "scripts", pattern.format(name or os.path.basename(program)))
        with open(script, "w", encoding="utf-8") as file:
            file.write(printed(program, "--help", self.shell))
        shell = kind(folder.name, script)
        self.addCleanup(shell.close)
        return shell

    def shown(self, shell, line, is_expected=None):
        """The text that the shell shows for a line. On a busy machine, the expected text may come
        late. Then the line is tried again with more time."""
        for seconds in (0.05, 0.5, 5) if is_expected else (1,):
            text = shell.complete(line, seconds)
            if is_expected and is_expected(text):
                break
        return text

    def check(self, shell, line, expected, absent=()):
        self.assertEqual(set(expected) & words(line), set(), "it shows anyway")
        shown = self.shown(shell, line, expected and (lambda text: set(expected) <= words(text)))
        self.assertLessEqual(set(expected), words(shown), f"{line!r}: {shown!r}")
        self.assertEqual(set(absent) & words(shown), set(), f"{line!r}: {shown!r}")

    def check_text(self, shell, line, text):
        self.assertIn(text, self.shown(shell, line, lambda shown: text in shown))

    def test_options(self):
        for program, name in ((BARCODE, "ph-barcode"), (SEGMENT, "ph-segment")):
            shell = self.start(program)
            self.check(shell, f"{name} --", [option for option in options_of(program)])
        self.check(self.start(BARCODE), "ph-barcode --eng", ["--engine"], ["--field", "--values"])

    def test_every_choice(self):
        for program, name in ((BARCODE, "ph-barcode"), (SEGMENT, "ph-segment")):
            shell = self.start(program)
            tried = 0
            for option in options_of(program).values():
                choices = [c for c in option.value.split("|") if re.fullmatch("[a-z0-9:-]+", c)]
                if len(choices) > 1:
                    tried += 1
                    self.check(shell, f"{name} {option.name} ", choices)
            self.assertGreater(tried, 4)
            self.check(shell, f"{name} --help ", [*topics_of(program), "all", "markdown"])

    def test_values(self):
        shell = self.start(BARCODE)
        self.check(shell, "ph-barcode --engine ", ["auto", "twist", "union-find"],
                   ["column", "points.csv"])
        self.check(shell, "ph-barcode x --engine co", ["cohomology"], ["twist"])
        self.check(shell, "ph-barcode --engine=co", ["cohomology"], ["twist"])
        self.check(shell, "ph-barcode --metric mi", ["minkowski:"], ["manhattan"])
        self.check(shell, "ph-barcode --max-scale ", [], FILES)
        self.check(shell, "ph-barcode --threads ", [], FILES)

    def test_extensions_of_the_program(self):
        shell = self.start(EXTENDED)
        name = os.path.basename(EXTENDED)
        self.check(shell, f"{name} --engine ", ["auto", "column"])
        self.check(shell, f"{name} --complex ", ["rips", "polygon"])

    def test_files(self):
        shell = self.start(BARCODE)
        self.check(shell, "ph-barcode po", ["points.csv"], ["bars.svg"])
        self.check(shell, "ph-barcode x --plot ba", ["bars.svg", "bars.png"])
        self.check(shell, "ph-barcode x -o po", ["points.csv"])
        self.check(shell, "ph-barcode x --output po", ["points.csv"])
        self.check(shell, "ph-barcode x --values c", ["cloud.pcd"])
        self.check(shell, "ph-barcode x --report p", ["page.html"], self.hidden(["points.csv"]))
        self.check(shell, "ph-barcode x --report re", ["results"])
        self.check(shell, "ph-barcode x --plot pa", ["of.svg"])

    def hidden(self, files):
        """The files that the shell does not offer. Fish offers all files: it only moves files with
        another extension to the end."""
        return [] if self.shell == "fish" else files

    def test_the_first_word(self):
        shell = self.start(BARCODE)
        self.check(shell, "ph-barcode p", ["plot", "points.csv"])
        self.check(shell, "ph-barcode plot b", ["bars.svg"])
        self.check(shell, "ph-barcode x pl", [], ["plot"])

    def test_cameras(self):
        shell = self.start(SEGMENT)
        self.check(shell, "ph-segment --camera ", ["kinect-v1", "realsense-d435", "points.csv"])


class Bash(Completion, unittest.TestCase):
    shell = "bash"


class Zsh(Completion, unittest.TestCase):
    shell = "zsh"

    def test_it_says_what_options_are(self):
        self.check_text(self.start(BARCODE), "ph-barcode --re", "one page to look at")

    def test_an_option_excludes_others(self):
        shell = self.start(SEGMENT)
        self.check(shell, "ph-segment --parts --o", ["--output"], ["--objects"])
        # --plot may be given several times, --tree only once.
        self.check_text(shell, "ph-segment --plot bars.svg --", "figure of")
        self.check_text(shell, "ph-segment --plot bars.svg --", "what other cuts need")
        self.check_text(shell, "ph-segment --tree a.tree --", "figure of")
        self.assertNotIn("what other cuts need", self.shown(shell, "ph-segment --tree a.tree --"))


class Fish(Completion, unittest.TestCase):
    shell = "fish"

    def test_it_says_what_options_are(self):
        self.check_text(self.start(BARCODE), "ph-barcode --re", "one page to look at")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
