# SPDX-License-Identifier: MIT
"""More than a hundred runs under a memory limit: each keeps to its limit and reports the problem.

Each memory-hungry job runs under limits from 2 MiB to 128 MiB. It succeeds, or ends with exit code
75 and one line that suggests a remedy, or is stopped after some seconds. It never uses more than
the limit plus 32 MiB.
"""
import os
import random
import re
import resource
import shutil
import struct
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../support"))
import program  # noqa: E402
from program import ProgramTest, main  # noqa: E402
from under_limit import BESIDE, INPUTS, UnderLimit, is_sanitized, peak_of  # noqa: E402

MIB = 1 << 20
LIMITS = (2, 16, 48, 128)  # in MiB
NOBODY = 65534
SECONDS = 2  # CPU seconds; a longer run is stopped, and only its memory until then is checked
BEYOND_LIMITS = ("--engine", "cohomology", "--min-persistence", "-1")  # exceeds every limit soon
LEAST_ENDED = 90  # runs that must end in time; the exact number depends on the machine


def write_points(path, count, dim, digits=6):
    with open(path, "w") as file:
        for _ in range(count):
            file.write(" ".join(f"{random.random():.{digits}f}" for _ in range(dim)) + "\n")


def write_image(path, extents):
    """Writes an image in DIPHA's format piece by piece, to save memory."""
    count = 1
    for n in extents:
        count *= n
    with open(path, "wb") as file:
        file.write(struct.pack(f"<{4 + len(extents)}q", 8067171840, 1, count, len(extents),
                               *extents))
        for first in range(0, count, 4096):
            size = min(4096, count - first)
            file.write(struct.pack(f"<{size}d", *(random.random() for _ in range(size))))


def write_lines(path, lines):
    with open(path, "w") as file:
        file.writelines(line + "\n" for line in lines)


def write_inputs(folder):
    random.seed(5)
    path = lambda name: os.path.join(folder, name)
    write_points(path("space.txt"), 1500, 3)
    write_points(path("plane.txt"), 20000, 2)
    write_points(path("cloud.txt"), 200000, 3)
    write_points(path("line.txt"), 400000, 1, digits=4)
    write_points(path("high.txt"), 4000, 12)
    write_image(path("volume.dipha"), (64, 64, 64))
    write_image(path("picture.dipha"), (1600, 1600))
    write_image(path("hyper.dipha"), (24, 24, 24, 24))
    write_lines(path("graph.txt"),
                (f"{i} {i + 1 + random.randrange(50)} {random.random():.4f}"
                 for i in range(200000)))
    write_lines(path("band.txt"), (f"{i} {i + 1 + j} {random.random():.4f}"
                                   for i in range(8000) for j in range(25)))
    write_lines(path("tree.txt"), (f"{i} : {i % 10}" for i in range(150000)))
    with open(path("tree.txt"), "a") as file:
        file.writelines(f"{i} {i + 1} : {10 + i % 7}\n" for i in range(149999))
    write_lines(path("corner.txt"), (f"{20 * i} " + " ".join(str(20 * i + k) for k in range(1, 16))
                                     + " : 0" for i in range(4)))
    write_lines(path("corner.values"), ("0.5" for _ in range(76)))
    # A mesh of 46 MiB, most of which are blanks. Files of this size are mapped.
    side, pad = 300, 200 * " "
    write_lines(path("mesh.off"), [
        "OFF", f"{side * side} {(side - 1)**2} 0",
        *(f"{i // side} {i % side} 0{pad}" for i in range(side * side)),
        *(f"3 {k} {k + 1} {k + side}{pad}"
          for k in (side * row + i for row in range(side - 1) for i in range(side - 1)))])
    write_lines(path("mesh.values"), (f"{random.random():.4f}" for _ in range(side * side)))


BLOW_UPS = (
    ("space.txt", "--max-dim", "2"),
    ("space.txt", "--max-dim", "3", "--field", "3"),
    ("space.txt", "--engine", "standard", "--threshold", "0.3"),
    ("space.txt", "--engine", "twist"),
    ("space.txt", "--representatives", "cycles", "--output-format", "json"),
    ("space.txt", "--min-persistence", "-1"),
    ("plane.txt", "--engine", "edge-links"),
    ("plane.txt", "--threshold", "0.1"),
    ("plane.txt", "--threshold", "0.03", "--max-dim", "2"),
    ("cloud.txt", "--threshold", "0.02"),
    ("cloud.txt", "--threshold", "0.02", "--collapse", "on"),
    ("cloud.txt", "--threshold", "0.01", "--max-dim", "0"),
    ("line.txt", "--threshold", "0.001", "--max-dim", "0"),
    ("high.txt", "--metric", "manhattan", "--max-dim", "0"),
    ("high.txt", "--threshold", "1.5"),
    ("volume.dipha",),
    ("volume.dipha", "--engine", "cohomology"),
    ("volume.dipha", "--output-format", "json", "--representatives", "cocycles"),
    ("picture.dipha", "--plot", "out.svg"),
    ("picture.dipha", "--plot", "out.png", "--plot-kind", "diagram"),
    ("picture.dipha", "--construction", "cells", "--output-format", "json"),
    ("hyper.dipha",),
    ("graph.txt", "--format", "sparse"),
    ("graph.txt", "--format", "sparse", "--max-dim", "0", "--output-format", "npy"),
    ("band.txt", "--format", "sparse", "--max-dim", "2"),
    ("high.txt", "--max-dim", "2", "--threshold", "1"),
    ("cloud.txt", "--threshold", "0.01", "--max-dim", "0", "--output-format", "json"),
    ("tree.txt", "--format", "simplices"),
    ("corner.txt", "--format", "simplices", "--complex", "lower-star", "--values",
     "corner.values"),
    ("mesh.off", "--values", "mesh.values"),
    ("mesh.off", "--values", "mesh.values", "--engine", "cohomology"),
)


class Limits(UnderLimit):
    write_inputs = staticmethod(write_inputs)

    def test_the_limit_holds(self):
        ends = {0: 0, 75: 0, None: 0}
        version = self.expect(0, "--version", "--verbose").stdout
        for arguments in BLOW_UPS:
            if "out.png" in arguments and "PNG plots   no" in version:
                continue
            for limit in LIMITS:
                with self.subTest(arguments=arguments, limit=limit):
                    code, peak, _, message = self.run_within(limit, SECONDS, arguments)
                    self.assertIn(code, ends, message)
                    ends[code] += 1
                    self.assertLessEqual(peak, limit + BESIDE)
                    if code == 75:
                        self.assertEqual(message.count("\n"), 1, message)
                        self.assertIn("--memory-limit", message)
                        self.assertRegex(message, "--(threshold|max-dim|subsample|engine|representatives)|the number of points")
                        self.assertEqual(self.files(), ["square.txt"])
                    self.forget("out", "out.svg", "out.png")
        print(f"\n{sum(ends.values())} runs under a limit: {ends[75]} stopped by it, {ends[0]} "
              f"done, {ends[None]} still running after {SECONDS} s of CPU", file=sys.stderr)
        self.assertGreaterEqual(ends[0] + ends[75], LEAST_ENDED)
        self.assertGreater(ends[75], ends[0], "most limits are too small for their input")


class Alternatives(UnderLimit):
    """Tests that the alternatives suggested by a stopped run fit into the limit."""
    # Name, limit in MiB, least number of alternatives.
    ROWS = (("space.txt", 10, 3, "--max-dim", "2"),
            ("space.txt", 12, 3),
            ("space.txt", 20, 3, "--max-dim", "2", "--threshold", "0.25", "--engine", "twist",
             "--collapse", "off"),
            ("high.txt", 64, 3),
            ("plane.txt", 64, 3, "--max-dim", "1", "--engine", "edge-links"),
            ("cloud.txt", 128, 2, "--threshold", "0.03"),
            ("graph.txt", 22, 1, "--format", "sparse"),
            ("band.txt", 32, 2, "--format", "sparse", "--max-dim", "2"))

    write_inputs = staticmethod(write_inputs)

    def test_each_is_taken(self):
        for name, limit, ways, *options in self.ROWS:
            arguments = [os.path.join(INPUTS.name, name), "--quiet", "--output-format", "none", *options]
            run = self.run_program(*arguments, "--memory-limit", f"{limit}MiB")
            self.assertEqual(run.returncode, 75, run.stderr)
            found = re.findall(r"(--[a-z-]+) (\S+) \(([^)]*) to ([^)]*)\)", run.stderr)
            with self.subTest(arguments=arguments, limit=limit):
                self.assertGreaterEqual(len(found), ways, run.stderr)
            for option, value, _, _ in found:
                with self.subTest(arguments=arguments, limit=limit, option=option, value=value):
                    code, peak = self.peak(arguments, {option: value, "--memory-limit": f"{limit}MiB"})
                    self.assertEqual(code, 0)
                    self.assertLessEqual(peak, limit + BESIDE)

    def test_loops_that_there_cannot_be_are_taken_back(self):
        run = self.run_program(os.path.join(INPUTS.name, "space.txt"), "--quiet", "-o", "x.json",
                               "--max-dim", "2", "--representatives", "cycles", "--loops", "plain",
                               "--memory-limit", "10MiB")
        self.assertEqual(run.returncode, 75, run.stderr)
        changes = run.stderr.split("what would fit: ")[1].split("; ")
        without = [c for c in changes if "--representatives none" in c or "--max-dim 0" in c]
        self.assertTrue(without, run.stderr)
        for change in without:
            self.assertIn(" without --loops", change)

    def peak(self, arguments, changes):
        """@return exit code, peak memory in MiB."""
        words = list(arguments)
        for option, value in changes.items():
            if option in words:
                words[words.index(option) + 1] = value
            else:
                words += [option, value]
        code, peak, _, _ = peak_of(words, self.folder)
        return code, peak


class System(ProgramTest):
    """Limits set by the system or the user."""

    def setUp(self):
        super().setUp()
        if is_sanitized():
            self.skipTest("AddressSanitizer needs more address space than a limit leaves")
        random.seed(2)
        write_points(self.path("many.txt"), 1500, 3)

    def test_address_space(self):
        for mib in (60, 80, 100, 150):
            self.expect(75, "many.txt", "-o", "out.csv", *BEYOND_LIMITS, "--max-dim", "2",
                        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS,
                                                              (mib * MIB, mib * MIB)))
            self.assertEqual(self.files(), ["many.txt", "square.txt"])

    def heap_limit_after(self, failures, soft):
        """The heap limit (RLIMIT_DATA) of a batch that waits for its last input after `failures`
        inputs have failed. @param soft the soft limit with which the batch starts."""
        inputs = [f"{i}.dipha" for i in range(failures)]
        for name in inputs:
            write_image(self.path(name), (40, 40, 40))
        with subprocess.Popen(
                [program.PROGRAM, *inputs, "-", "-o", "out/", "--engine", "twist",
                 "--memory-limit", "8MiB"], cwd=self.folder,
                stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (soft, -1))) as run:
            messages = [run.stderr.readline() for _ in inputs]
            time.sleep(0.3)  # the batch continues with the next input
            limit = resource.prlimit(run.pid, resource.RLIMIT_DATA)[0]
            run.communicate(b"0\n1\n", 60)
        self.assertTrue(all(b"--memory-limit" in line for line in messages), messages)
        self.assertEqual(run.returncode, 75)
        for name in inputs:
            os.remove(self.path(name))
        return limit

    def test_failures_of_a_batch_do_not_add_up(self):
        once, often = self.heap_limit_after(1, -1), self.heap_limit_after(8, -1)
        # The limits may differ a little, because each depends on the memory in use at the start.
        self.assertLess(abs(often - once), 2 * MIB)
        self.assertLess(often, 128 * MIB)

    def test_the_limit_of_the_user_stays(self):
        soft = self.heap_limit_after(1, -1) - 6 * MIB  # below the limit that the program would set
        self.assertEqual(self.heap_limit_after(3, soft), soft)

    def test_control_group(self):
        if not os.path.exists("/proc/self/cgroup"):
            self.skipTest("no /proc/self/cgroup, which tells the program its group")
        group = f"/sys/fs/cgroup/memory/ph-test-{os.getpid()}"
        name = "memory.limit_in_bytes"
        if not os.path.isdir("/sys/fs/cgroup/memory"):
            group, name = group.replace("/memory/", "/"), "memory.max"
        try:
            os.mkdir(group)
        except OSError as error:
            self.skipTest(f"a control group cannot be made here: {error.strerror}")
        self.addCleanup(os.rmdir, group)
        if not os.path.exists(os.path.join(group, name)):
            self.skipTest("the memory controller is not there")
        with open(os.path.join(group, name), "w") as file:
            file.write(str(64 * MIB))

        def enter():
            with open(os.path.join(group, "cgroup.procs"), "w") as file:
                file.write(str(os.getpid()))
        # In the last two runs, the program also allocates heap memory outside its own budget. This
        # memory counts towards the limit of the control group.
        for options in (BEYOND_LIMITS,
                        ("--engine", "twist", "--max-dim", "2", "--collapse", "off",
                         "--threshold", "0.25"),
                        ("--engine", "cohomology", "--max-dim", "2", "--min-persistence", "-1")):
            with self.subTest(options):
                self.expect(75, "many.txt", "-o", "out.csv", *options, preexec_fn=enter)
        self.assertEqual(self.files(), ["many.txt", "square.txt"])

    def test_no_thread_can_be_created(self):
        command, user = [program.PROGRAM], {}
        if os.geteuid() == 0:  # resource limits on processes do not apply to root
            user = {"user": NOBODY, "group": NOBODY, "extra_groups": []}
            os.chmod(self.folder, 0o755)
            # The program may be in a folder that only root can read.
            command = [shutil.copy(program.PROGRAM, self.path("program"))]
            try:
                subprocess.run([*command, "--version"], cwd=self.folder, check=True,
                               stdout=subprocess.DEVNULL, **user)
            except (OSError, subprocess.SubprocessError) as error:
                self.skipTest(f"no other user may start the program: {error}")
        run = subprocess.run([*command, "square.txt"], cwd=self.folder, text=True, timeout=60,
                             capture_output=True, check=False,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NPROC, (0, 0)),
                             **user)
        self.assertEqual((run.returncode, run.stdout), (0, program.SQUARE_CSV), run.stderr)


if __name__ == "__main__":
    main()
