# SPDX-License-Identifier: MIT
"""Every misuse of the command line: exit code, and a line that names the option."""
from program import ProgramTest, main

# (arguments, what the message must contain)
USAGE = [
    (["--max-dim", "-1"], "--max-dim"),
    (["--max-dim=-1"], "--max-dim"),
    (["--max-dim", "1.5"], "--max-dim"),
    (["--max-dim", "x"], "--max-dim"),
    (["--max-dim", "99999999999999999999"], "--max-dim"),
    (["--max-dim"], "--max-dim"),
    (["--max-dim="], "--max-dim"),
    (["--max-dim", "1", "--max-dim", "2"], "--max-dim"),
    (["--threshold", "nan"], "--threshold"),
    (["--threshold", "1,5"], "decimals"),
    (["--threshold=-1"], "--threshold"),
    (["--max-scale"], "--max-scale"),
    (["--field", "4"], "--field"),
    (["--field", "1"], "--field"),
    (["--field", "2147483648"], "--field"),
    (["--modulus", "0x2"], "--field"),
    (["--metric", "euclid"], "did you mean 'euclidean'"),
    (["--metric", "minkowski"], "minkowski:P"),
    (["--metric", "minkowski:0.5"], "--metric"),
    (["--engine", "cohomolgy"], "did you mean 'cohomology'"),
    (["--engine", "fastest"], "--engine"),
    (["--format", "lowerdistance"], "did you mean 'lower-distance'"),
    (["--complex", "ribs"], "did you mean 'rips'"),
    (["--complex", "cubical"], "--complex"),
    (["--complex", "explicit"], "--complex"),
    (["--construction", "cells"], "--construction"),
    (["--superlevel"], "--superlevel"),
    (["--periodic", "0"], "--periodic"),
    (["--periodic", "z"], "--periodic"),
    (["--periodic", "0,,1"], "--periodic"),
    (["--symmetrise", "mean"], "--symmetrise"),
    (["--nan", "ignore"], "--nan"),
    (["--min-persistence", "nan"], "--min-persistence"),
    (["--representatives", "cycle"], "did you mean 'cycles'"),
    (["--representatives", "cycles"], "--output-format json"),
    (["--representatives", "cocycles", "-o", "x.csv"], "found output format csv"),
    *((["--representatives", "cycles", "--output-format", name], "found output format " + name)
      for name in ("csv", "ripser", "pers", "dipha", "npy")),
    *((["--representatives", "cycles", "--output-format", "json", "--max-dim", "0", "--engine",
        name], "--engine: found " + name) for name in ("standard", "union_find")),
    (["--collapse", "maybe"], "--collapse"),
    (["--subsample", "0"], "--subsample"),
    (["--approximate", "-1"], "--approximate"),
    (["--output-format", "cvs"], "did you mean 'csv'"),
    (["--plot", "x.pdf"], "--plot"),
    (["--plot", "x.svg", "--plot-kind", "betty"], "did you mean 'betti'"),
    (["--plot-kind", "betti"], "--plot-kind"),
    (["--memory-limit", "4XB"], "--memory-limit"),
    (["--memory-limit", "-4GiB"], "--memory-limit"),
    (["--memory-limit", "0"], "--memory-limit"),
    (["--threads", "0"], "--threads"),
    (["--progress", "fancy"], "--progress"),
    (["--treshold", "2"], "did you mean '--threshold'"),
    (["--max-dims=2"], "did you mean '--max-dim'"),
    (["-max-dim", "2"], "did you mean '--max-dim'"),
    (["--no-such-thing-at-all"], "--no-such-thing-at-all"),
    (["-o", ""], "--output"),
    (["square.txt"], "-o FOLDER/"),
]

NOT_BUILT_IN = [
    (["--plot", "x.png"], "PNG plots are not built in; use .svg"),
    (["--plot", "x.PNG"], "use .svg"),
    (["--report", "x.html"], "--report"),
    (["--collapse", "on"], "--collapse"),
    (["--subsample", "10"], "--subsample"),
    (["--approximate", "0.5"], "--approximate"),
    (["--complex", "alpha"], "alpha"),
]

FINE = [["--collapse", "auto"], ["--collapse", "off"], ["--representatives", "none"],
        ["--threads", "1"], ["--threads=2"], ["--memory-limit", "1GiB"], ["--max-dim=0"],
        ["--memory-limit", "1e9"], ["--memory-limit", "500MB"], ["--threshold", "inf"],
        ["--progress", "none"], ["--field", "2147483647"], ["--min-persistence", "1e-3"]]


class Usage(ProgramTest):
    def test_faults_are_named(self):
        for arguments, words in USAGE:
            with self.subTest(arguments=arguments):
                run = self.expect(64, "square.txt", *arguments)
                self.assertIn(words, run.stderr)
                self.assertEqual(run.stdout, "")
                self.assertEqual(self.files(), ["square.txt"])

    def test_missing_input(self):
        self.assertIn("INPUT", self.expect(64).stderr)

    def test_what_is_not_built_in(self):
        for arguments, words in NOT_BUILT_IN:
            with self.subTest(arguments=arguments):
                self.assertIn(words, self.expect(69, "square.txt", *arguments).stderr)

    def test_what_is_fine(self):
        for arguments in FINE:
            with self.subTest(arguments=arguments):
                self.expect(0, "square.txt", *arguments)

    def test_a_matrix_without_incidences_allows_field_2_only(self):
        self.write("edge.phat", "0\n0\n1 0 1\n")
        run = self.expect(64, "edge.phat", "--format", "phat", "--field", "3")
        self.assertIn("--field", run.stderr)

    def test_options_for_other_data(self):
        self.write("lower.txt", "1\n3 2\n")
        self.expect(64, "lower.txt", "--format", "lower-distance", "--metric", "manhattan")
        self.expect(64, "square.txt", "--values", "square.txt")
        self.write("triangle.txt", "0 : 0\n1 : 0\n0 1 : 1\n")
        self.write("values.txt", "1\n2\n")
        self.expect(64, "triangle.txt", "--format", "simplices", "--values", "values.txt")


if __name__ == "__main__":
    main()
