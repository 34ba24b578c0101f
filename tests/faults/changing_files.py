# SPDX-License-Identifier: MIT
"""Tests inputs that another process changes or truncates while the program reads them. Large files
are memory-mapped."""
import os
import random
import signal
import struct
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../support"))
import files  # noqa: E402
import program  # noqa: E402
from program import ProgramTest, main  # noqa: E402

SHAPE = (96, 256, 256)  # 24 MiB of float32; files of at least 16 MiB are mapped


class ChangingFiles(ProgramTest):
    def setUp(self):
        super().setUp()
        self.rng = random.Random(5)
        layer = struct.pack(f"<{SHAPE[1] * SHAPE[2]}f", *[self.rng.random() for _ in range(SHAPE[1] * SHAPE[2])])
        layers = [layer[4 * shift:] + layer[:4 * shift] for shift in self.rng.sample(range(1000), SHAPE[0])]
        self.volume = files.npy("<f4", SHAPE, b"".join(layers))
        row = "".join(f"{self.rng.random():.6f} {self.rng.random():.6f}\n" for _ in range(4000)).encode()
        self.table = row * (17 * 2 ** 20 // len(row) + 1)

    def while_it_runs(self, arguments, change):
        """Changes the input during a run. @return exit code, standard error, seconds."""
        begin = time.monotonic()
        run = subprocess.Popen([program.PROGRAM, *arguments, "--quiet", "-o", "out.csv"], cwd=self.folder,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        change(run)
        out, err = run.communicate(timeout=100)
        self.assertEqual(out, "")
        if run.returncode != 0:
            self.assertEqual(err.count("\n"), 1, err)
            self.assertFalse(os.path.exists(self.path("out.csv")))
        self.assertEqual([f for f in self.files() if f not in ("square.txt", "a.npy", "a.txt", "out.csv")], [])
        if os.path.exists(self.path("out.csv")):
            os.remove(self.path("out.csv"))
        return run.returncode, err, time.monotonic() - begin

    def ends_of(self, name, content, arguments, change, tries):
        self.write(name, content)
        code, err, seconds = self.while_it_runs([name, *arguments], lambda run: None)
        self.assertEqual(code, 0, err)
        ends = []
        for k in range(tries):
            self.write(name, content)
            delay = seconds * k / tries
            code, err, _ = self.while_it_runs([name, *arguments], lambda run: (time.sleep(delay), change(run)))
            self.assertIn(code, (0, 65, 74), err)
            ends.append((code, err))
        return ends

    def cut_once_it_is_mapped(self, name):
        def change(run):
            while run.poll() is None:
                with open(f"/proc/{run.pid}/maps", encoding="utf-8") as maps:
                    if name in maps.read():
                        break
            run.send_signal(signal.SIGSTOP)
            os.truncate(self.path(name), 5000)
            run.send_signal(signal.SIGCONT)
        return change

    def test_files_that_become_shorter(self):
        lost = "ph-barcode: an input file became shorter while it was read, or its disk failed\n"
        for name, content, arguments in (
                ("a.npy", self.volume, ["--max-dim", "0", "--slab-layers", "8", "--threads", "1"]),
                ("a.txt", self.table, ["--complex", "rips", "--threshold", "0", "--max-dim", "0"])):
            # On a busy machine a run may end before this process has seen the mapping.
            for _ in range(20):
                self.write(name, content)
                code, err, _ = self.while_it_runs([name, *arguments], self.cut_once_it_is_mapped(name))
                if code != 0:
                    break
            self.assertEqual((code, err), (74, lost))
            self.ends_of(name, content, arguments, lambda run: os.truncate(self.path(name), 5000), 3)
        self.ends_of("a.npy", self.volume, ["--max-dim", "0", "--threads", "2"],
                     lambda run: os.truncate(self.path("a.npy"), 5000), 3)

    def test_bytes_that_change(self):
        def scribble(name):
            def change(run):
                with open(self.path(name), "r+b") as file:
                    size = os.path.getsize(self.path(name))
                    while run.poll() is None:
                        file.seek(self.rng.randrange(size))
                        file.write(self.rng.choice([b"\0" * 8, b"\xff" * 8, b"1 1\n1 1\n", b"nan", b"inf\n"]))
                        file.flush()
            return change
        self.ends_of("a.npy", self.volume, ["--max-dim", "0", "--slab-layers", "8"], scribble("a.npy"), 3)
        self.ends_of("a.npy", self.volume, ["--max-dim", "0", "--threads", "2"], scribble("a.npy"), 2)
        self.ends_of("a.txt", self.table, ["--complex", "rips", "--threshold", "0", "--max-dim", "0"],
                     scribble("a.txt"), 3)


if __name__ == "__main__":
    main()
