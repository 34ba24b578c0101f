# SPDX-License-Identifier: MIT
"""Tests descriptors, limits and streams that fail. These cases need more setup than the corpus in
tests/faults provides."""
import json
import os
import random
import resource
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import program  # noqa: E402
from program import SQUARE, SQUARE_CSV, ProgramTest, main  # noqa: E402


OTHER = 4321  # a user and group id that nobody has


def limit(kind, amount):
    return lambda: resource.setrlimit(kind, (amount, amount))


class Outputs(ProgramTest):
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

    def test_mode_and_links_are_kept(self):
        self.write("out.csv", "old")
        os.chmod(self.path("out.csv"), 0o6640)
        os.symlink("out.csv", self.path("link.csv"))
        self.expect(0, "square.txt", "-o", "link.csv")
        self.assertTrue(os.path.islink(self.path("link.csv")))
        self.assertEqual(self.read("out.csv"), SQUARE_CSV)
        # Set-ID bits belong to the old content and are dropped.
        self.assertEqual(os.stat(self.path("out.csv")).st_mode & 0o7777, 0o640)

    @unittest.skipIf(os.geteuid() != 0, "only root may give files away")
    def test_owners_are_kept(self):
        self.write("out.csv", "old")
        os.chown(self.path("out.csv"), OTHER, OTHER + 1)
        self.expect(0, "square.txt", "-o", "out.csv")
        status = os.stat(self.path("out.csv"))
        self.assertEqual((status.st_uid, status.st_gid), (OTHER, OTHER + 1))

    def refused_at_once(self, run):
        """Checks outputs that no new file can replace: the old file stays, and the run ends before
        it computes anything."""
        self.assertEqual((run.returncode, self.read("out.csv")), (73, "old"), run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertIn("out.csv: cannot create the output", run.stderr)
        self.assertIn("expected another name, or '-' with standard output redirected into it",
                      run.stderr)

    def test_a_file_that_is_mounted(self):
        self.write("out.csv", "old")
        alone = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c"]
        mount = "mount --bind out.csv out.csv"
        try:
            subprocess.run([*alone, mount], cwd=self.folder, check=True, capture_output=True)
        except (OSError, subprocess.SubprocessError) as error:
            self.skipTest(f"no mounts of one's own: {error}")
        call = [*alone, f'{mount} && exec "$0" square.txt -o out.csv', program.PROGRAM]
        self.refused_at_once(subprocess.run(call, cwd=self.folder, capture_output=True, text=True,
                                            timeout=60))

    @unittest.skipIf(os.geteuid() != 0, "only root runs programs as another user")
    def test_a_file_of_another_user_in_a_sticky_folder(self):
        self.write("out.csv", "old")
        os.chmod(self.path("out.csv"), 0o666)
        os.chmod(self.folder, 0o1777)
        copy = shutil.copy(program.PROGRAM, self.path("program"))
        try:
            run = subprocess.run([copy, "square.txt", "-o", "out.csv"], cwd=self.folder,
                                 user=OTHER, group=OTHER, extra_groups=[], capture_output=True,
                                 text=True, timeout=60)
        except OSError as error:
            self.skipTest(f"no other user may start the program: {error}")
        self.refused_at_once(run)

    def test_a_file_to_append_to(self):
        path = self.path(self.write("out.csv", "old"))
        try:
            subprocess.run(["chattr", "+a", path], check=True, capture_output=True)
        except (OSError, subprocess.SubprocessError) as error:
            self.skipTest(f"no file is for appending alone: {error}")
        try:
            self.refused_at_once(self.run_program("square.txt", "-o", "out.csv"))
        finally:
            subprocess.run(["chattr", "-a", path], check=True)

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
    def test_endless_stream_stops_at_the_budget(self):
        with subprocess.Popen(["yes", "0.5 1"], stdout=subprocess.PIPE) as endless:
            self.expect(75, "-", "--memory-limit", "32MiB", "-o", "out.csv", stdin=endless.stdout)
            endless.kill()
        self.assertEqual(self.files(), ["square.txt"])

    def test_strange_names_are_escaped_in_json(self):
        path = os.path.join(os.fsencode(self.folder), b"new\nline \"<b>\" \xff.txt")
        with open(path, "w") as file:
            file.write(SQUARE)
        run = self.expect(0, path, "--output-format", "json", text=False)
        json.loads(run.stdout.decode("utf-8"))


if __name__ == "__main__":
    main()
