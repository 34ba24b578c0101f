# SPDX-License-Identifier: MIT
"""program_descriptors.py PH_BARCODE PH_DISTANCE PH_VECTORISE PH_SEGMENT
PH_CLUSTER: names like /dev/fd/4 stand
for descriptors that the caller opened, never for the program's own. Data already written to a
descriptor are kept."""
import os
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from option_inputs_segment import HEIGHT, WIDTH, depth_png, depths, pcd, points_of  # noqa: E402
from program import SQUARE, SQUARE_CSV, FolderTest  # noqa: E402

BARCODE = DISTANCE = VECTORISE = SEGMENT = CLUSTER = None
OWN = range(3, 9)  # the descriptors that the programs open first


class Descriptors(FolderTest):
    def setUp(self):
        super().setUp()
        image = depths(36)
        for name, content in (("p.csv", SQUARE.encode()), ("a.csv", SQUARE_CSV.encode()),
                              ("b.csv", SQUARE_CSV.encode()), ("d.png", depth_png(image)),
                              ("s.pcd", pcd(list(points_of(image)), WIDTH, HEIGHT)),
                              ("m.off", b"OFF\n2 1 0\n0 0 0\n1 0 0\n2 0 1\n")):
            self.write(name, content)

    def run_in_folder(self, *arguments, **options):
        options = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE} | options
        return subprocess.run(arguments, cwd=self.folder, stderr=subprocess.PIPE, text=True,
                              timeout=20, **options)

    def refused(self, *arguments, **options):
        run = self.run_in_folder(*arguments, **options)
        self.assertEqual((run.returncode, run.stdout), (64, ""), (arguments, run.stderr))
        self.assertIn("expected a descriptor that is open when the program starts", run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)

    def test_their_own_are_no_files(self):
        before = sorted(os.listdir(self.folder))
        for arguments in (
                [BARCODE, "{}"], [BARCODE, "p.csv", "-o", "{}"],
                [BARCODE, "p.csv", "-o", "{}", "--plot", "x.svg"], [BARCODE, "--join", "{}"],
                [BARCODE, "p.csv", "--vertex-weights", "{}"], [BARCODE, "m.off", "--values", "{}"],
                [BARCODE, "--compare", "a.csv", "{}"], [BARCODE, "p.csv", "--plot={}"],
                [DISTANCE, "a.csv", "{}"], [DISTANCE, "a.csv", "b.csv", "--matching", "{}"],
                [DISTANCE, "a.csv", "b.csv", "--groups", "{}"],
                [VECTORISE, "{}"], [VECTORISE, "a.csv", "--fit", "{}"],
                [VECTORISE, "a.csv", "--fitted", "{}"],
                [CLUSTER, "{}"], [CLUSTER, "p.csv", "-o", "{}"], [CLUSTER, "p.csv", "--tree", "{}"],
                [SEGMENT, "{}"], [SEGMENT, "s.pcd", "-o", "{}"],
                [SEGMENT, "d.png", "--camera", "{}"],
                [SEGMENT, "--depth", "d.png", "--color", "{}", "--camera", "kinect-v1"],
                [SEGMENT, "--frames-from", "{}", "--json", "x.json"]):
            for number in OWN:
                with self.subTest(arguments=arguments, number=number):
                    self.refused(*(word.format(f"/dev/fd/{number}") for word in arguments))
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_their_own_by_other_names(self):
        os.symlink("/dev/fd/4", self.path("link"))
        os.symlink("link", self.path("link-to-link"))
        for name in ("/proc/self/fd/4", "/proc/thread-self/fd/4", "//dev/./fd/4", "link",
                     "./link-to-link"):
            self.refused(BARCODE, "p.csv", "-o", name)
            self.refused(BARCODE, name)
        self.refused("sh", "-c", 'cd /proc/$$/fd && exec "$0" 4', BARCODE)

    def test_their_own_in_lists_and_folders(self):
        os.mkdir(self.path("in"))
        os.mkdir(self.path("out"))
        os.symlink("/dev/fd/3", self.path("in/x.csv"))
        os.symlink("/dev/fd/4", self.path("out/p.csv"))
        self.refused(BARCODE, "in", "-o", "new/")
        self.refused(BARCODE, "p.csv", "m.off", "-o", "out/", "--quiet")
        frames = self.run_in_folder(SEGMENT, "--frames-from", "-", "--json", "x.json", "--quiet",
                                    stdin=None, input="/dev/fd/3\ns.pcd\n")
        self.assertEqual(frames.returncode, 64, frames.stderr)
        self.assertIn("--frames-from: found /dev/fd/3, expected a descriptor", frames.stderr)
        lines = self.read("x.json").splitlines()
        self.assertEqual(["segments" in line for line in lines], [False, True])

    def test_those_of_the_caller(self):
        with open(self.path("p.csv"), "rb") as points, open(self.path("log"), "w") as log:
            log.write("before\n")
            log.flush()
            both = (points.fileno(), log.fileno())
            run = self.run_in_folder(BARCODE, f"/dev/fd/{both[0]}", "-o", f"/dev/fd/{both[1]}",
                                     pass_fds=both)
            self.assertEqual(run.returncode, 0, run.stderr)
            # The descriptor is open for reading only.
            run = self.run_in_folder(BARCODE, "m.off", "-o", f"/dev/fd/{both[0]}", pass_fds=both)
            self.assertEqual(run.returncode, 73, run.stderr)
        self.assertEqual(self.read("log"), "before\n" + SQUARE_CSV)

    def test_a_log_stays_by_whatever_name(self):
        os.symlink("/dev/stdout", self.path("link"))
        for name in ("link", "/proc/thread-self/fd/1", "//dev/stdout", "/dev/./stdout", "log",
                     "/proc/$$/fd/1"):
            call = f'exec >> log; echo header; "$0" p.csv -o {name} --quiet; echo footer'
            with open(self.path("log"), "w") as log:
                log.write("before\n")
            run = self.run_in_folder("sh", "-c", call, BARCODE)
            self.assertEqual(run.stderr, "")
            self.assertEqual(self.read("log"), f"before\nheader\n{SQUARE_CSV}footer\n", name)
        call = 'echo before > log; "$0" p.csv -o log 2>> log'
        run = self.run_in_folder("sh", "-c", call, BARCODE)
        self.assertEqual(run.returncode, 0)
        self.assertTrue(self.read("log").startswith("before\n"))
        self.assertIn(SQUARE_CSV, self.read("log"))

    def test_two_outputs_are_not_mixed(self):
        os.mkfifo(self.path("fifo"))
        os.symlink("/dev/stdout", self.path("link"))
        for first, second in (("-", "/dev/stdout"), ("/proc/self/fd/1", "link"),
                              ("/dev/stderr", "/dev/fd/2"), ("fifo", "./fifo")):
            run = self.run_in_folder(VECTORISE, "a.csv", "-o", first, "--fit", second)
            self.assertEqual((run.returncode, run.stdout), (64, ""), (first, second, run.stderr))
            self.assertIn("is also written by --output", run.stderr)
        # Two outputs may share /dev/null, because it keeps nothing that could get mixed up.
        run = self.run_in_folder(VECTORISE, "a.csv", "-o", "/dev/null", "--fit", "/dev/null")
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_closed_ones_where_there_is_no_null_device(self):
        alone = ["unshare", "--user", "--map-root-user", "--mount"]
        empty = "mount -t tmpfs none /dev"
        try:
            subprocess.run([*alone, "sh", "-c", empty], check=True, capture_output=True)
        except (OSError, subprocess.SubprocessError) as error:
            self.skipTest(f"no mounts of one's own: {error}")
        call = f'{empty} && exec "$0" p.csv -o o.csv --verbose <&- >&- 2>&-'
        run = self.run_in_folder(*alone, "sh", "-c", call, BARCODE)
        self.assertEqual(run.returncode, 0)
        self.assertEqual(self.read("o.csv"), SQUARE_CSV)


if __name__ == "__main__":
    BARCODE, DISTANCE, VECTORISE, SEGMENT, CLUSTER = (os.path.abspath(sys.argv.pop(1)) for _ in range(5))
    unittest.main(verbosity=2)
