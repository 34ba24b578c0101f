# SPDX-License-Identifier: MIT
"""ph-distance: a signal ends a long run with the exit code that shells use, and the run leaves
nothing behind."""
import os
import signal
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import program  # noqa: E402
from program import ProgramTest, main  # noqa: E402
from diagrams import csv_of, random_bars  # noqa: E402

PATIENCE = 0.2 + 0.3  # the promised time, plus the delay of a busy machine
TRIES = 3


class Signals(ProgramTest):
    def setUp(self):
        super().setUp()
        for name, seed in (("a.csv", 1), ("b.csv", 2)):  # these take some seconds
            self.write(name, csv_of(random_bars(seed, {1: (60_000, 0)})))
        self.names = [self.write(f"{i}.csv", csv_of(random_bars(i, {1: (1500, 0)}))) for i in range(40)]
        self.write("groups.txt", "x\ny\n" * 20)

    def expect_end(self, number, code, *arguments):
        before = self.files()
        for _ in range(TRIES):
            run = subprocess.Popen([program.PROGRAM, *arguments, "--quiet"], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            time.sleep(0.7)
            self.assertIsNone(run.poll(), "the computation was over too soon")
            run.send_signal(number)
            start = time.monotonic()
            said = run.communicate(timeout=10)
            seconds = time.monotonic() - start
            self.assertEqual((run.returncode, *said), (code, b"", b""))
            self.assertEqual(self.files(), before)
            if seconds < PATIENCE:
                return
        self.fail(f"ended after {seconds:.2f} s, expected less than {PATIENCE} s")

    def test_a_pair(self):
        exact = ("a.csv", "b.csv", "--distance", "wasserstein")
        self.expect_end(signal.SIGINT, 130, *exact, "-o", "out.csv", "--matching", "m.json")
        self.expect_end(signal.SIGTERM, 143, *exact, "--matrix", "m.npy")
        self.expect_end(signal.SIGHUP, 129, *exact)

    def test_all_pairs(self):
        many = (*self.names, "--distance", "wasserstein", "--threads", "2")
        self.expect_end(signal.SIGINT, 130, *many, "--matrix", "m.npy")
        self.expect_end(signal.SIGTERM, 143, *many, "--groups", "groups.txt", "-o", "out.json")

    def test_progress(self):
        run = self.expect(0, *self.names[:12], "--distance", "wasserstein", "--progress", "json", "--quiet",
                          "--threads", "1")
        self.assertIn('"stage": "distances of barcodes"', run.stderr)


if __name__ == "__main__":
    main()
