# SPDX-License-Identifier: MIT
"""Several inputs with an output folder: tests the result of each input and the exit code of the
whole run."""
import os
import random
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import program  # noqa: E402
from program import SQUARE, SQUARE_CSV, ProgramTest, files, main  # noqa: E402


class Batch(ProgramTest):
    def batch(self, code, *arguments, **options):
        """Runs the program on several inputs. @return the lines on stderr."""
        run = self.run_program(*arguments, **options)
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertEqual(run.stdout, "")
        return run.stderr.splitlines()

    def outputs(self, folder="out"):
        return sorted(os.listdir(self.path(folder)))

    def test_failures_are_counted_and_the_rest_is_done(self):
        self.write("bad.txt", "0 0\n1 x\n")
        self.write("pair.txt", "0 0\n3 4\n")
        lines = self.batch(65, "square.txt", "bad.txt", "missing.txt", "pair.txt", "-o", "out/")
        self.assertEqual(len(lines), 5, lines)
        for line, word in zip(lines, ("square.txt: 4 points in R^2, text: 5 bars", "bad.txt:2",
                                      "missing.txt", "pair.txt", "2 of 4 inputs failed")):
            self.assertTrue(line.startswith("ph-barcode: "))
            self.assertIn(word, line)
        self.assertEqual(self.read("out/square.csv"), SQUARE_CSV)
        self.assertEqual(self.outputs(), ["pair.csv", "square.csv"])

    def test_the_code_is_that_of_the_first_failure(self):
        self.write("bad.txt", "0 0\n1 x\n")
        self.batch(66, "square.txt", "missing.txt", "bad.txt", "-o", "out/")
        self.batch(65, "square.txt", "bad.txt", "missing.txt", "-o", "out/")
        self.assertEqual(self.batch(0, "square.txt", "-o", "out/"),
                         ["ph-barcode: read square.txt: 4 points in R^2, text",
                          "ph-barcode: square.txt: 4 points in R^2, text: 5 bars"])

    def test_pictures_without_an_output_may_be_slices(self):
        stack = "--stack FOLDER reads the pictures in a folder as one volume"
        for names, wanted in ((("a1.png", "a2.png"), True), (("a.tiff", "b.PGM", "c.tif"), True),
                              (("a.png", "b.txt"), False), (("a.npy", "b.npy"), False)):
            [line] = self.batch(64, *names)
            self.assertIn("--output: found '-', expected a folder", line)
            self.assertEqual(stack in line, wanted, line)

    def test_quiet_leaves_the_errors(self):
        lines = self.batch(66, "missing.txt", "square.txt", "--quiet", "-o", "out/")
        self.assertEqual(len(lines), 1)
        self.assertIn("missing.txt", lines[0])

    def test_each_line_names_its_input(self):
        random.seed(4)
        self.write("many.txt", "".join(f"{random.random()} {random.random()}\n"
                                       for _ in range(900)))
        lines = self.batch(75, "many.txt", "square.txt", "--memory-limit", "1MiB", "-o", "out/")
        self.assertIn("many.txt", lines[0])
        self.assertIn("square.txt", lines[1])
        self.assertEqual(self.outputs(), ["square.csv"])

    def test_standard_input_is_one_of_them(self):
        self.batch(0, "square.txt", "-", "-o", "out/", input=SQUARE)
        self.assertEqual(self.outputs(), ["square.csv", "stdin.csv"])
        self.assertEqual(self.read("out/stdin.csv"), SQUARE_CSV)
        self.expect(64, "-", "square.txt", "-", "-o", "out/", input=SQUARE)

    def test_a_data_file_is_no_input_of_its_own(self):
        os.mkdir(self.path("in"))
        for name in ("a", "b"):
            header, data = files.two_files((3, 2), [0, 5, 2, 4, 9, 1], f"{name}.raw")
            self.write(f"in/{name}.mhd", header)
            self.write(f"in/{name}.raw", data)
        lines = self.batch(0, "in", "-o", "out/")
        self.assertEqual(self.outputs(), ["a.csv", "b.csv"])
        self.assertEqual(sum("in/a.raw: not an input of its own" in line for line in lines), 1)
        self.batch(0, "in/a.mhd", "in/b.mhd", "in/./a.raw", "-o", "few/")
        self.assertEqual(self.outputs("few"), ["a.csv", "b.csv"])
        self.expect(0, "in", "--part", "1/1", "-o", "p.ph")
        # A file that no header among the inputs names is an input. With --raw-shape, headers are
        # raw files as well.
        self.assertIn("in/b.raw", "".join(self.batch(65, "in/a.mhd", "in/b.raw", "-o", "two/")))
        self.batch(0, "in/a.raw", "in/b.raw", "--raw-shape", "2,3", "-o", "raw/")
        self.assertEqual(self.outputs("raw"), ["a.csv", "b.csv"])

    def test_same_names(self):
        for folder in ("a", "b", "a/c"):
            os.mkdir(self.path(folder))
            self.write(f"{folder}/same.txt", SQUARE)
        self.write("square.csv", SQUARE.replace(" ", ","))
        self.batch(0, "a/same.txt", "./b/same.txt", "a/c/../c/same.txt", "square.txt", "square.csv",
                   "b/../a/same.txt", "-o", "out/",
                   "--output-format", "pers")
        self.assertEqual(self.outputs(), ["a-c-c-same.txt.pers", "a-same.txt.pers",
                                          "b-a-same.txt.pers", "b-same.txt.pers",
                                          "square.csv.pers", "square.txt.pers"])

    def test_the_same_input_twice(self):
        run = self.expect(64, "square.txt", "square.txt", "-o", "out/")
        self.assertIn("would both be written to out/square.txt.csv", run.stderr)
        self.assertEqual(self.files(), ["square.txt"])

    def test_nothing_is_written_with_none(self):
        self.batch(0, "square.txt", "square.txt", "-o", "out/", "--output-format", "none")
        self.batch(0, "square.txt", "square.txt", "--output-format", "none")
        self.assertEqual(self.files(), ["square.txt"])

    def test_the_folder(self):
        self.write("pair.txt", "0 0\n3 4\n")
        both = ("square.txt", "pair.txt")
        self.batch(0, *both, "-o", "new/")
        self.batch(0, *both, "-o", "new")  # the folder exists now
        self.assertEqual(self.outputs("new"), ["pair.csv", "square.csv"])
        for path in ("missing/deep/", "square.txt/", "/proc/no/"):
            if path.startswith("/proc") and not os.path.exists("/proc/self"):
                continue  # without procfs, /proc/no is an ordinary path
            with self.subTest(path=path):
                self.expect(73, *both, "-o", path)
        self.assertIn("-o FOLDER/", self.expect(64, *both, "-o", "out").stderr)
        os.makedirs(self.path("blocked/pair.csv"))
        lines = self.batch(73, *both, "-o", "blocked/")
        self.assertIn("pair.csv", lines[1])
        self.assertEqual(self.read("blocked/square.csv"), SQUARE_CSV)

    @unittest.skipIf(os.geteuid() == 0, "folders are never read-only for root")
    def test_a_folder_that_cannot_be_written(self):
        os.mkdir(self.path("closed"), 0o500)
        self.batch(73, "square.txt", "-o", "closed/")

    def test_a_signal_leaves_complete_files_only(self):
        random.seed(3)
        self.write("many.txt", "".join(" ".join(f"{random.random():.6f}" for _ in range(6)) + "\n"
                                       for _ in range(4000)))
        self.write("last.txt", SQUARE)
        run = subprocess.Popen([program.PROGRAM, "square.txt", "many.txt", "last.txt", "--quiet",
                                "--max-dim", "2", "-o", "out/"], cwd=self.folder,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        for _ in range(2000):
            if os.path.exists(self.path("out/square.csv")):
                break
            time.sleep(0.005)
        time.sleep(0.2)
        run.send_signal(signal.SIGINT)
        self.assertEqual(run.wait(10), 130)
        self.assertEqual(run.stderr.read(), b"")
        run.stderr.close()
        self.assertEqual(self.read("out/square.csv"), SQUARE_CSV)
        self.assertEqual(self.outputs(), ["square.csv"])


if __name__ == "__main__":
    main()
