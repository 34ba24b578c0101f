# SPDX-License-Identifier: MIT
"""Files, folders, descriptors and memory that fail: exit codes, and what is left behind."""
import os
import random
import resource
import subprocess
import unittest

import program
from program import SQUARE, SQUARE_CSV, ProgramTest, main


def limit(kind, amount):
    return lambda: resource.setrlimit(kind, (amount, amount))


class Outputs(ProgramTest):
    def test_full_device(self):
        with open("/dev/full", "w") as full:
            self.expect(74, "square.txt", "--quiet", stdout=full)
            self.expect(74, "--help", stdout=full)
            self.expect(74, "--version", stdout=full)
        self.expect(74, "square.txt", "-o", "/dev/full")

    def test_closed_descriptors(self):
        self.expect(74, "square.txt", stdout=None, preexec_fn=lambda: os.close(1))
        run = self.expect(0, "square.txt", stderr=None, preexec_fn=lambda: os.close(2))
        self.assertEqual(run.stdout, SQUARE_CSV)
        self.expect(0, "square.txt", "-o", "out.csv", stdout=None, stdin=None,
                    preexec_fn=lambda: (os.close(0), os.close(1)))
        self.assertEqual(self.read("out.csv"), SQUARE_CSV)

    def test_file_size_limit(self):
        self.expect(74, "square.txt", "-o", "out.csv",
                    preexec_fn=limit(resource.RLIMIT_FSIZE, 0))
        self.assertEqual(self.files(), ["square.txt"])

    def test_what_cannot_be_created(self):
        for path in ("missing/out.csv", "square.txt/out.csv", ".", "/proc/out.csv", "x" * 300,
                     "/dev/null/out.csv"):
            with self.subTest(path=path):
                self.expect(73, "square.txt", "-o", path)
        self.expect(73, "square.txt", "--plot", "missing/out.svg")
        self.assertEqual(self.files(), ["square.txt"])

    @unittest.skipIf(os.geteuid() == 0, "folders are never read-only for root")
    def test_read_only_folder(self):
        os.mkdir(self.path("folder"), 0o500)
        self.expect(73, "square.txt", "-o", "folder/out.csv")

    def test_output_is_input(self):
        self.expect(0, "square.txt", "-o", "square.txt", "--output-format", "csv")
        self.assertEqual(self.read("square.txt"), SQUARE_CSV)
        self.assertEqual(self.files(), ["square.txt"])

    def test_failure_leaves_the_old_file(self):
        self.write("out.csv", "old")
        self.write("bad.txt", "0 0\n1\n")
        self.expect(65, "bad.txt", "-o", "out.csv")
        self.assertEqual(self.read("out.csv"), "old")
        self.assertEqual(self.files(), ["bad.txt", "out.csv", "square.txt"])

    def test_mode_and_links_are_kept(self):
        self.write("out.csv", "old")
        os.chmod(self.path("out.csv"), 0o640)
        os.symlink("out.csv", self.path("link.csv"))
        self.expect(0, "square.txt", "-o", "link.csv")
        self.assertTrue(os.path.islink(self.path("link.csv")))
        self.assertEqual(self.read("out.csv"), SQUARE_CSV)
        self.assertEqual(os.stat(self.path("out.csv")).st_mode & 0o777, 0o640)

    def test_umask_counts(self):
        self.expect(0, "square.txt", "-o", "out.csv", preexec_fn=lambda: os.umask(0o027))
        self.assertEqual(os.stat(self.path("out.csv")).st_mode & 0o777, 0o640)

    def test_names_of_descriptors(self):
        for path in ("-", "/dev/stdout", "/dev/fd/1"):
            self.assertEqual(self.expect(0, "square.txt", "-o", path).stdout, SQUARE_CSV)
        with open(self.path("log"), "w") as log:
            log.write("before\n")
            log.flush()
            self.expect(0, "square.txt", "-o", "/dev/stdout", stdout=log)
        self.assertEqual(self.read("log"), "before\n" + SQUARE_CSV)

    def test_fifos(self):
        os.mkfifo(self.path("in"))
        os.mkfifo(self.path("out"))
        run = subprocess.Popen([program.PROGRAM, "in", "-o", "out", "--quiet"], cwd=self.folder)
        with open(self.path("out")) as out:
            with open(self.path("in"), "w") as file:
                file.write(SQUARE)
            self.assertEqual(out.read(), SQUARE_CSV)
        self.assertEqual(run.wait(20), 0)

    def test_broken_pipe_is_quiet(self):
        random.seed(1)
        self.write("many.txt", "".join(f"{random.random()}\n" for _ in range(4000)))
        run = subprocess.Popen([program.PROGRAM, "many.txt", "--quiet", "--max-dim", "0"],
                               cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        run.stdout.close()
        self.assertEqual(run.stderr.read(), b"")
        self.assertEqual(run.wait(60), 74)
        run.stderr.close()


class Inputs(ProgramTest):
    def test_missing_and_unreadable(self):
        self.expect(66, "missing.txt")
        self.expect(66, ".")
        self.expect(66, "square.txt/more")

    @unittest.skipIf(os.geteuid() == 0, "root may read everything")
    def test_no_permission(self):
        os.chmod(self.path("square.txt"), 0)
        self.expect(66, "square.txt")

    def test_endless_stream_stops_at_the_budget(self):
        with subprocess.Popen(["yes", "0.5 1"], stdout=subprocess.PIPE) as endless:
            self.expect(75, "-", "--memory-limit", "32MiB", "-o", "out.csv", stdin=endless.stdout)
            endless.kill()
        self.expect(65, "/dev/zero", "--memory-limit", "32MiB", "-o", "out.csv")
        self.assertEqual(self.files(), ["square.txt"])

    def test_strange_names_are_escaped(self):
        for name in (b"new\nline.txt", b"%s%n.txt", b"<script>.txt", b"\x1b[31m.txt",
                     b"\xff\xfe.txt"):
            with self.subTest(name=name):
                run = self.expect(66, name, text=False)
                self.assertEqual(run.stderr.count(b"\n"), 1, run.stderr)
                self.assertNotIn(b"\x1b", run.stderr)
                run.stderr.decode("utf-8")
        path = os.path.join(os.fsencode(self.folder), b"new\nline \"<b>\" \xff.txt")
        with open(path, "w") as file:
            file.write(SQUARE)
        run = self.expect(0, path, "--output-format", "json", text=False)
        run.stdout.decode("utf-8")
        self.expect(66, "x" * 4096)

    def test_locale_has_no_influence(self):
        for locale in ("de_DE.UTF-8", "tr_TR.UTF-8", "C"):
            run = self.expect(0, "square.txt", env={"LC_ALL": locale, "LANG": locale, "TZ": "X"})
            self.assertEqual(run.stdout, SQUARE_CSV)


class Memory(ProgramTest):
    def setUp(self):
        super().setUp()
        random.seed(2)
        self.write("many.txt", "".join(f"{random.random()} {random.random()} {random.random()}\n"
                                       for _ in range(1200)))

    def test_limit_of_the_user(self):
        run = self.expect(75, "many.txt", "--memory-limit", "1MiB", "-o", "out.csv")
        for way_out in ("--max-dim", "threshold", "points"):
            self.assertIn(way_out, run.stderr)
        self.assertEqual(self.files(), ["many.txt", "square.txt"])

    def test_limit_of_the_system(self):
        with open(program.PROGRAM, "rb") as file:
            if b"__asan_init" in file.read():
                self.skipTest("AddressSanitizer needs more address space than the limit leaves")
        self.expect(75, "many.txt", "-o", "out.csv", "--max-dim", "2",
                    preexec_fn=limit(resource.RLIMIT_AS, 60 << 20))
        self.assertEqual(self.files(), ["many.txt", "square.txt"])


if __name__ == "__main__":
    main()
