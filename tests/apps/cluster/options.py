# SPDX-License-Identifier: MIT
"""ph-cluster: values are parsed strictly, options without an effect are refused, limits hold, and a
dry run computes nothing."""
import json
import os
import random
import re
import signal
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import program  # noqa: E402
from program import ProgramTest, files, main  # noqa: E402

MATRIX = "0 1 2\n1 0 1.5\n2 1.5 0\n"


def bytes_of(text):
    number, unit = text.split()
    return float(number) * 1024 ** ["bytes", "KiB", "MiB", "GiB"].index(unit)


class OptionsTest(ProgramTest):
    def cloud(self, size, axes=2):
        rng = random.Random(size)
        self.write("cloud.npy", files.array((size, axes), [rng.random() for _ in range(size * axes)]))
        return ["cloud.npy", "--format", "points"]

    def test_values_are_strict(self):
        for option, values in {
                "--min-size": ("", "1", "0", "-3", "2.5", "x", "99999999999999999999"),
                "--neighbours": ("", "-1", "1.5", "x"), "--epsilon": ("", "-1", "nan", "inf", "x"),
                "--max-size": ("", "0", "-1", "x", "4"), "--method": ("", "excess"),
                "--metric": ("", "minkowski", "minkowski:0.5", "euclid"), "--output-format": ("txt",),
                "--format": ("png", "phat"), "--tree": ("", "t.txt", "t"), "--columns": (",",),
                "--raw-points": ("0",)}.items():
            for value in values:
                run = self.expect(64, "square.txt", option, value)
                self.assertIn(option, run.stderr, (option, value))
                self.assertEqual(run.stdout, "")
        for arguments in ([], [""], ["square.txt", "square.txt"], ["square.txt", "-o", ""],
                          ["square.txt", "--whatever"], ["square.txt", "--tree", "-"], ["square.txt", "--min-size", "2", "--min-size", "3"]):
            self.expect(64, *arguments)
        self.assertIn("did you mean 'euclidean'", self.expect(64, "square.txt", "--metric", "euclid").stderr)
        self.assertIn("did you mean '--min-size'", self.expect(64, "square.txt", "--min-cluster-size", "5").stderr)
        self.assertIn("min_samples - 1", self.expect(64, "square.txt", "--min-samples", "5").stderr)

    def test_options_without_an_effect(self):
        self.write("m.txt", MATRIX)
        for arguments in (["--max-size", "9", "--method", "leaf"], ["--symmetrise", "max", "--format", "points"],
                          ["--from-correlation", "--format", "points"], ["--raw-type", "uint8"], ["--raw-skip", "4"]):
            run = self.expect(64, "square.txt", *arguments)
            self.assertIn(arguments[0], run.stderr)
        for arguments in (["--metric", "manhattan"], ["--raw-points", "2"]):
            run = self.expect(64, "m.txt", "--format", "distance", *arguments)
            self.assertIn(arguments[0], run.stderr)

    def test_a_dry_run(self):
        run = self.expect(0, *self.cloud(5000), "--dry-run", "-o", "x.csv", "--tree", "t.json", "--scores",
                          "--method", "leaf", "--epsilon", "1", "--allow-single")
        self.assertIn("--dry-run ignores --method, --epsilon, --allow-single, --output, --scores, --tree", run.stderr)
        self.assertRegex(run.stdout, r"^input     5000 points in R\^2, .*\n"
                         r"distances euclidean, mutual reachability with 4 neighbours\n"
                         r"clusters  of at least 5 points\nmemory    .* to .*\n$")
        self.assertEqual(self.files(), ["cloud.npy", "square.txt"])
        for size, axes in ((60_000, 2), (60_000, 3), (4000, 12)):
            cloud = self.cloud(size, axes)
            forecast = self.expect(0, *cloud, "--dry-run").stdout
            low, high = re.search(r"memory +(\S+ \S+) to (\S+ \S+)\n", forecast).groups()
            said = self.expect(0, *cloud, "--verbose", "--memory-limit", high.replace(" ", ""), "-o", "x.csv").stderr
            taken = re.search(r"ph-cluster: memory (\d\S* \S+)\n", said)[1]
            # The programs themselves take a few MiB, which depend on the system.
            self.assertLessEqual(bytes_of(low) / 2, bytes_of(taken))
            self.assertLessEqual(bytes_of(taken), bytes_of(high) + (2 << 20))
        os.remove(self.path("x.csv"))
        self.assertIn("single linkage", self.expect(0, "square.txt", "--dry-run", "--neighbours", "0").stdout)
        self.expect(64, "square.txt", "--dry-run", "--neighbours", "9")
        self.write("x.txt", "1 x\n2 3\n")
        self.expect(65, "x.txt", "--dry-run")

    def test_limits(self):
        arguments = self.cloud(60_000)
        run = self.expect(75, *arguments, "--memory-limit", "4MiB", "-o", "x.csv")
        self.assertIn("--memory-limit", run.stderr)
        self.assertEqual(self.files(), ["cloud.npy", "square.txt"])
        one = self.expect(0, *arguments, "--threads", "1", "--scores", "--quiet")
        two = self.expect(0, *arguments, "--threads", "2", "--scores", "--quiet")
        self.assertEqual(one.stdout, two.stdout)

    def test_progress_and_signals(self):
        arguments = self.cloud(24_000, 12)  # all pairs are compared
        run = self.expect(0, *arguments, "--progress", "json", "--quiet", "-o", "x.csv")
        stages = [json.loads(line)["stage"] for line in run.stderr.splitlines()]
        self.assertIn("core distances", stages)
        with subprocess.Popen([program.PROGRAM, *self.cloud(40_000, 12), "-o", "y.csv", "--quiet"], cwd=self.folder,
                              stderr=subprocess.PIPE) as run:
            time.sleep(0.3)
            run.send_signal(signal.SIGINT)
            _, said = run.communicate(timeout=20)
            self.assertEqual((run.returncode, said), (130, b""))
        self.assertEqual(self.files(), ["cloud.npy", "square.txt", "x.csv"])

    def test_messages(self):
        run = self.expect(0, "square.txt", "--min-size", "2")
        self.assertEqual(run.stderr, "ph-cluster: read square.txt: 4 points in R^2, text\n"
                         "ph-cluster: 4 points in R^2, text: 0 clusters, 4 points of noise\n")
        self.assertEqual(self.expect(0, "square.txt", "--quiet").stderr, "")
        said = self.expect(0, "square.txt", "--verbose", "--threads", "1", "--min-size", "2").stderr
        for words in ("threads 1", "memory limit", "distances euclidean, mutual reachability with 1 neighbour\n"):
            self.assertIn(words, said)
        self.assertIn("the extension names no format, writing csv", self.expect(0, "square.txt", "-o", "x.tsv").stderr)
        self.assertRegex(self.expect(0, "--version").stdout, r"^ph-cluster \d+\.\d+\.\d+\n$")
        self.assertIn("methods    eom leaf", self.expect(0, "--version", "--verbose").stdout)

    def test_advice_names_options_of_this_program(self):
        known = set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", self.expect(0, "--help", "all").stdout))
        for name, content in (("a.bin", b"\x00\x01\x02\x03" * 5), ("b.txt", b"\x01\x02 3\n"),
                              ("c.png", files.png(2, 1, 8, files.RGB, [bytes(range(6))])),
                              ("d.txt", b"0 1\n2 0\n"), ("e.txt", b"1 0.5 0.2\n0.5 1 0.1\n0.2 0.1 1\n"),
                              ("f.txt", b"1 nan\n2 3\n")):
            self.write(name, content)
            run = self.run_program(name)
            self.assertIn(run.returncode, (0, 65), run.stderr)
            self.assertLessEqual(set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", run.stderr)), known, run.stderr)


if __name__ == "__main__":
    main()
