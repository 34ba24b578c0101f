# SPDX-License-Identifier: MIT
"""ph-vectorise: options without an effect are refused, values are parsed strictly, and outputs
replace no input."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, files, main  # noqa: E402

BARS = "dim,birth,death\n0,0,4\n0,1,2\n1,3,5\n1,1,4\n"
KINDS = ("statistics", "betti", "landscape", "silhouette", "image", "entropy", "life-entropy",
         "lengths", "atol", "euler")
ON_GRIDS = {"betti", "landscape", "silhouette", "image", "life-entropy", "euler"}
# Each option with a value, and the kinds of vectors that it applies to.
SCOPES = {
    ("--grid", "0,9,5"): ON_GRIDS, ("--length-grid", "0,9,5"): {"image"},
    ("--layers", "2"): {"landscape"}, ("--count", "2"): {"lengths", "atol"},
    ("--sigma", "0.5"): {"image"}, ("--power", "2"): {"image", "silhouette"},
    ("--normalised",): {"entropy"}, ("--contrast", "gauss"): {"atol"}, ("--seed", "1"): {"atol"},
    ("--dims", "1"): set(KINDS) - {"euler"}, ("--format", "barcode"): {"euler"},
    ("--infinite", "keep"): {"betti", "landscape", "euler"}, ("--infinite", "error"): set(KINDS),
}
OF_IMAGES = (("--nan", "drop"), ("--construction", "cells"), ("--superlevel",), ("--periodic", "0"))


class OptionsTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.csv", BARS)
        self.write("image.npy", files.array((2, 2), [0, 1, 2, 9], "|u1"))

    def kind(self, kind):
        return ["--kind", kind, *(["--count", "2"] if kind == "atol" else [])]

    def test_options_are_for_some_kinds(self):
        for option, kinds in SCOPES.items():
            for kind in KINDS:
                if kind == "atol" and option[0] == "--count":
                    continue
                run = self.expect(0 if kind in kinds else 64, "a.csv", *self.kind(kind), *option)
                if kind not in kinds:
                    self.assertIn(option[0], run.stderr)
                    self.assertEqual(run.stdout, "")
        for option in OF_IMAGES:
            self.expect(0, "image.npy", "--kind", "euler", *option)
            for kind in KINDS:
                run = self.expect(64, "a.csv", *self.kind(kind), *option)
                self.assertIn(f"{option[0]}: makes sense for images with --kind euler only", run.stderr)
        self.expect(64, "image.npy", "--kind", "euler", "--infinite", "drop")

    def test_nothing_is_given_beside_a_fit(self):
        for kind in KINDS:
            self.expect(0, "a.csv", *self.kind(kind), "--fit", "fit.json", "-o", "x.csv")
            for option in (*SCOPES, *OF_IMAGES, ("--kind", kind), ("--fit", "other.json")):
                if option in (("--format", "barcode"), ("--nan", "drop")) and kind == "euler":
                    continue
                run = self.expect(64, "a.csv", "--fitted", "fit.json", *option)
                self.assertIn(option[0], run.stderr)
        self.assertEqual(self.expect(0, "a.csv", "--fitted", "fit.json", "--format", "barcode").stdout,
                         self.read("x.csv"))
        self.expect(0, "image.npy", "--fitted", "fit.json", "--nan", "drop")

    def test_values_are_strict(self):
        for option, values in {
                "--grid": ("", "0", "1,0,5", "0,0,5", "0,inf,5", "0,1", "0,1,0", "0,1,1.5", "a,b,3", "0,1,2,3"),
                "--length-grid": ("0", "3,1,2"), "--layers": ("0", "-1", "x"), "--count": ("0",),
                "--sigma": ("0", "-1", "inf", "nan"), "--power": ("-1", "inf"),
                "--dims": ("", "-1", "a", "0,0"), "--infinite": ("", "inf", "nan", "sometimes"),
                "--kind": ("", "tree"), "--contrast": ("flat",), "--seed": ("-1",),
                "--periodic": ("8", "x"), "--output-format": ("json",)}.items():
            for value in values:
                run = self.expect(64, "a.csv", option, value)
                self.assertIn(option, run.stderr)
                self.assertEqual(run.stdout, "")
        for arguments in ([], [""], ["a.csv", "--fit", "-"], ["-", "-"], ["a.csv", "-o", ""],
                          ["a.csv", "--whatever"], ["-", "--fitted", "-"]):
            self.expect(64, *arguments)
        self.assertIn("did you mean", self.expect(64, "a.csv", "--layer", "3").stderr)

    def test_outputs_replace_no_input(self):
        self.expect(0, "a.csv", "--fit", "fit.json", "-o", "x.csv")
        for arguments in (["a.csv", "-o", "a.csv"], ["a.csv", "-o", "./a.csv"], ["a.csv", "--fit", "a.csv"],
                          ["a.csv", "-o", "y", "--fit", "y"],
                          ["a.csv", "--fitted", "fit.json", "-o", "fit.json"]):
            self.expect(64, *arguments)
            self.assertEqual(self.read("a.csv"), BARS)
        self.expect(73, "a.csv", "-o", "missing/x.csv")
        self.expect(0, "a.csv", "-o", "a.csv", "--force")
        self.assertTrue(self.read("a.csv").startswith("input,"))
        # A failed run leaves nothing behind.
        before = self.files()
        self.expect(65, "square.txt", "-o", "z.csv", "--fit", "z.json")
        self.assertEqual(self.files(), before)

    def test_messages(self):
        run = self.expect(0, "a.csv", "--kind", "lengths")
        self.assertEqual(run.stderr, "ph-vectorise: 1 input, lengths: 1 vector of 10 numbers\n")
        self.assertEqual(self.expect(0, "a.csv", "--quiet").stderr, "")
        self.assertIn("threads 1", self.expect(0, "a.csv", "--verbose", "--threads", "1").stderr)
        self.assertRegex(self.expect(0, "--version").stdout, r"^ph-vectorise \d+\.\d+\.\d+\n$")
        self.assertIn("kinds      statistics betti", self.expect(0, "--version", "--verbose").stdout)
        with subprocess.Popen(["true"], stdin=subprocess.PIPE) as reader:
            reader.wait()
            run = self.run_program("a.csv", stdout=reader.stdin)
        self.assertEqual(run.returncode, 74)


if __name__ == "__main__":
    main()
