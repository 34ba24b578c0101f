# SPDX-License-Identifier: MIT
"""Runs ph-barcode under a memory limit: TEST.py PH_BARCODE PEAK. PEAK is the program built from
tests/faults/peak.c."""
import os
import resource
import signal
import subprocess
import sys
import tempfile
import unittest

import program
from program import ProgramTest

BESIDE = 32  # MiB that code, libraries and small allocations may take in addition to the limit
PEAK = os.path.abspath(sys.argv.pop(2))
INPUTS = tempfile.TemporaryDirectory()  # the inputs of all tests of a script
FILES = (".txt", ".dipha", ".values", ".npy", ".gz", ".off")


def is_sanitized():
    with open(program.PROGRAM, "rb") as file:
        return b"__asan_init" in file.read()


def peak_of(arguments, folder, seconds=None):
    """@return exit code (None: still running after `seconds` of CPU time), peak memory in MiB, CPU
    seconds, stderr."""
    read_end, write_end = os.pipe()
    with os.fdopen(read_end) as report:
        run = subprocess.run(
            [PEAK, f"/dev/fd/{write_end}", program.PROGRAM, *arguments], cwd=folder, text=True,
            stdin=subprocess.DEVNULL, capture_output=True, pass_fds=[write_end], check=False,
            preexec_fn=lambda: seconds and resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds)))
        os.close(write_end)
        kib, microseconds = map(int, report.read().split())
    stopped = run.returncode in (-signal.SIGKILL, -signal.SIGXCPU)
    return None if stopped else run.returncode, kib / 1024, microseconds / 1e6, run.stderr


class UnderLimit(ProgramTest):
    """The base class of tests under a memory limit. Each subclass has a function `write_inputs`,
    which writes the inputs of its tests. Subclasses that share the function also share the inputs:
    it runs only once."""
    written = set()

    @classmethod
    def setUpClass(cls):
        if is_sanitized():
            raise unittest.SkipTest("AddressSanitizer takes memory of its own")
        if cls.write_inputs not in UnderLimit.written:
            cls.write_inputs(INPUTS.name)
            UnderLimit.written.add(cls.write_inputs)

    def forget(self, *names):
        for name in os.listdir(self.folder):  # includes the unfinished files of a killed run
            if name in names or name.startswith(".ph-"):
                os.remove(self.path(name))

    def run_within(self, limit, seconds, arguments):
        """@param limit in MiB. @return the values of `peak_of`."""
        output = () if "--output-format" in arguments else ("--output-format", "csv")
        words = [os.path.join(INPUTS.name, word) if word.endswith(FILES) else word
                 for word in arguments]
        return peak_of([*words, *output, "--quiet", "-o", "out", "--memory-limit", f"{limit}MiB"],
                       self.folder, seconds)
