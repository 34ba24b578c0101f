# SPDX-License-Identifier: MIT
"""ph-distance: options without an effect are refused, values are parsed strictly, and outputs
replace no input."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, main  # noqa: E402

BARS = "dim,birth,death\n0,0,4\n0,1,2\n1,3,5\n1,1,4\n"
OTHER = "dim,birth,death\n0,0,4.5\n1,1,2.5\n"
KINDS = ("bottleneck", "wasserstein", "sliced")
BOUNDED = {"bottleneck", "wasserstein"}
# Each option with a value, the distances that it applies to, and its tasks: two barcodes, three
# barcodes, a matching, groups.
PAIR, MANY, MATCHING, GROUPS = ["a.csv", "b.csv"], ["a.csv", "b.csv", "c.csv"], ["--matching", "m.csv"], \
    ["--groups", "g.txt"]
AIMS = {"pair": PAIR, "many": MANY, "matching": PAIR + MATCHING, "groups": [*PAIR, *PAIR, *GROUPS]}
ALL = set(AIMS)
SCOPES = {
    ("--order", "2"): ({"wasserstein"}, ALL), ("--ground", "2"): ({"wasserstein"}, ALL),
    ("--directions", "5"): ({"sliced"}, ALL - {"matching"}), ("--error", "0.1"): (BOUNDED, ALL),
    ("--at-most", "9"): (BOUNDED, {"pair", "many"}), ("--matching", "x.csv"): (BOUNDED, {"pair"}),
    ("--shuffles", "9"): (set(KINDS), {"groups"}), ("--power", "2"): (set(KINDS), {"groups"}),
    ("--seed", "3"): (set(KINDS), {"groups"}), ("--dims", "1"): (set(KINDS), ALL),
    ("--matrix", "x.npy", "--dim", "1"): (set(KINDS), ALL), ("--output-format", "csv"): (set(KINDS), ALL),
}


class OptionsTest(ProgramTest):
    def setUp(self):
        super().setUp()
        for name, content in (("a.csv", BARS), ("b.csv", OTHER), ("c.csv", OTHER), ("g.txt", "x\ny\nx\ny\n")):
            self.write(name, content)

    def test_options_where_they_do_nothing(self):
        for option, (kinds, aims) in SCOPES.items():
            for kind in KINDS:
                for aim, arguments in AIMS.items():
                    if aim == "matching" and (kind == "sliced" or option[0] == "--matching"):
                        # Such a call is refused for another reason, or has the option twice.
                        continue
                    fits = kind in kinds and aim in aims
                    # The matching of the bottleneck distance is exact, and therefore --error is
                    # refused.
                    fits = fits and (option[0], aim, kind) != ("--error", "matching", "bottleneck")
                    before = self.files()
                    run = self.expect(0 if fits else 64, *arguments, "--distance", kind, *option)
                    if not fits:
                        self.assertIn(option[0], run.stderr)
                        self.assertEqual((run.stdout, self.files()), ("", before))
        for arguments in ([*PAIR, "--distance", "sliced", *MATCHING], [*PAIR, *PAIR, *GROUPS, *MATCHING]):
            self.assertIn("--matching", self.expect(64, *arguments).stderr)

    def test_options_change_the_result(self):
        for base, option in ((["--distance", "wasserstein"], ["--order", "2"]),
                             (["--distance", "wasserstein"], ["--ground", "2"]), ([], ["--distance", "sliced"]),
                             (["--distance", "sliced"], ["--directions", "3"]), ([], ["--at-most", "0.1"]),
                             ([], ["--dims", "1"]), ([], ["--output-format", "csv"])):
            results = [self.expect(0, *PAIR, *base, *more, "--quiet").stdout for more in ([], option)]
            self.assertNotEqual(*[text.splitlines()[1:] for text in results], option)

    def test_values_are_strict(self):
        for option, values in {
                "--order": ("", "0.5", "0", "-1", "inf", "nan", "x", "1,5"), "--ground": ("0.5", "nan", "two"),
                "--directions": ("0", "-1", "1.5"), "--error": ("-0.1", "inf", "1%", ""),
                "--at-most": ("-1", "inf", "nan"), "--dims": ("", "-1", "a", "0,0"), "--distance": ("", "hera"),
                "--shuffles": ("0", "x"), "--power": ("0", "-1", "inf"), "--seed": ("-1", "x"),
                "--matching": ("", "m.npy", "m"), "--matrix": ("", "m.json", "m"), "--output-format": ("npy",),
                "--output": ("", "x.npy", "x.pers")}.items():
            for value in values:
                run = self.expect(64, *PAIR, option, value)
                self.assertIn(option, run.stderr)
                self.assertEqual(run.stdout, "")
        self.assertIn("--distance bottleneck has order inf", self.expect(64, *PAIR, "--order", "inf").stderr)
        self.assertIn("did you mean", self.expect(64, *PAIR, "--distanc", "sliced").stderr)
        for arguments in ([], ["a.csv"], ["a.csv", ""], ["-", "-"], ["-", "a.csv", "--groups", "-"],
                          [*PAIR, "--whatever"], [*PAIR, "--matching", "-"], [*PAIR, "--dim", "1", "--matrix", "-",
                                                                             "-o", "-"],
                          [*PAIR, "--dim", "1", "--matrix", "-", "--matching", "-", "-o", "x"]):
            self.expect(64, *arguments)
        self.assertIn("found only a.csv, expected at least two barcodes", self.expect(64, "a.csv").stderr)

    def test_outputs_replace_no_input(self):
        before = self.files()
        for arguments in (["-o", "a.csv"], ["-o", "./b.csv"], ["--matching", "a.csv"], ["--matrix", "b.csv", "--dim", "1"],
                          ["-o", "y.csv", "--matching", "y.csv"],
                          ["--matrix", "y.csv", "--dim", "1", "--matching", "./y.csv"]):
            self.expect(64, *PAIR, *arguments)
        self.expect(64, *PAIR, *PAIR, *GROUPS, "-o", "g.txt")
        self.assertEqual((self.read("a.csv"), self.read("b.csv"), self.read("g.txt")), (BARS, OTHER, "x\ny\nx\ny\n"))
        self.expect(73, *PAIR, "-o", "missing/x.csv")
        # A failed run leaves nothing behind.
        self.expect(65, "a.csv", "square.txt", "-o", "z.csv", "--matching", "m.csv", "--matrix", "m.npy")
        self.assertEqual(self.files(), before)
        self.expect(0, *PAIR, "-o", "a.csv", "--force")
        self.assertTrue(self.read("a.csv").startswith("a,b,dim,"))

    def test_formats_by_extension(self):
        for name, begin in (("d.csv", "a,b,dim,"), ("d.json", "{\n"), ("d.txt", "bottleneck distance")):
            self.expect(0, *PAIR, "-o", name)
            self.assertTrue(self.read(name).startswith(begin))
        self.expect(0, *PAIR, "-o", "x.npy", "--output-format", "csv")
        self.assertTrue(self.read("x.npy").startswith("a,b,dim,"))

    def test_messages(self):
        self.assertEqual(self.expect(0, *PAIR).stderr, "ph-distance: 2 barcodes, H0 and H1: 2 distances\n")
        self.assertEqual(self.expect(0, *MANY, "--dim", "1").stderr, "ph-distance: 3 barcodes, H1: 3 distances\n")
        self.assertEqual(self.expect(0, *PAIR, "--quiet").stderr, "")
        for arguments, idle in ((PAIR, True), (MANY, False), ([*PAIR, "--distance", "sliced"], False)):
            said = self.expect(0, *arguments, "--threads", "2").stderr
            self.assertEqual("--threads does nothing" in said, idle)
        said = self.expect(0, *PAIR, "--verbose", "--threads", "1").stderr
        self.assertIn("threads 1", said)
        self.assertIn("read a.csv: 4 bars", said)
        self.assertRegex(self.expect(0, "--version").stdout, r"^ph-distance \d+\.\d+\.\d+\n$")
        self.assertIn("distances  bottleneck wasserstein sliced", self.expect(0, "--version", "--verbose").stdout)
        with subprocess.Popen(["true"], stdin=subprocess.PIPE) as reader:
            reader.wait()
            run = self.run_program(*PAIR, stdout=reader.stdin)
        self.assertEqual(run.returncode, 74)


if __name__ == "__main__":
    main()
