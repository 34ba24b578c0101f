# SPDX-License-Identifier: MIT
"""program_stack.py PH_BARCODE PH_DISTANCE PH_VECTORISE PH_SEGMENT
PH_CLUSTER: the programs need a stack of 128
KiB. With less, they end at once with a message."""
import os
import random
import resource
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from option_inputs_segment import HEIGHT, WIDTH, depth_png, depths, pcd, points_of  # noqa: E402
from program import FolderTest, files  # noqa: E402

BARCODE = DISTANCE = VECTORISE = SEGMENT = CLUSTER = None
KIB = 1024
LEAST = 128


class Stacks(FolderTest):
    def setUp(self):
        super().setUp()
        rng = random.Random(1)
        image = depths(36)
        # More than 1024 items are sorted with histograms.
        points = "".join(f"{rng.random()},{rng.random()},{rng.random()}\n" for _ in range(1500))
        voxels = [rng.randrange(99) for _ in range(40 * 40 * 4)]
        for name, content in (("p.csv", points.encode()), ("d.png", depth_png(image)),
                              ("i.npy", files.array((40, 40, 4), voxels, "|u1")),
                              ("s.pcd", pcd(list(points_of(image)), WIDTH, HEIGHT)),
                              ("a.csv", b"dim,birth,death\n0,0,1\n1,1,3\n")):
            self.write(name, content)

    def run_with_stack(self, kib, arguments):
        """A limit of None leaves the stack as it is."""
        limit = (kib * KIB, kib * KIB) if kib else None
        return subprocess.run(
            arguments, cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, timeout=120,
            preexec_fn=lambda: limit and resource.setrlimit(resource.RLIMIT_STACK, limit))

    def test_a_small_stack_is_enough_or_refused(self):
        for arguments in (
                [BARCODE, "p.csv", "--threshold", "0.3"],
                [BARCODE, "p.csv", "--max-dim", "2", "--threshold", "0.2", "--engine", "cohomology"],
                [BARCODE, "p.csv", "--representatives", "cycles", "--threshold", "0.2", "-o", "x.json"],
                [BARCODE, "p.csv", "--complex", "alpha"], [BARCODE, "i.npy"],
                [BARCODE, "i.npy", "--plot", "x.png", "--report", "x.html"],
                [BARCODE, "i.npy", "--engine", "twist"], [BARCODE, "i.npy", "--slab-layers", "2"],
                [DISTANCE, "a.csv", "a.csv"], [VECTORISE, "a.csv"],
                [CLUSTER, "p.csv", "--scores", "--tree", "t.json"],
                [SEGMENT, "s.pcd", "-o", "-", "--report", "x.html"],
                [SEGMENT, "s.pcd", "-o", "-", "--method", "supervoxels"],
                [SEGMENT, "d.png", "--camera", "kinect-v1", "-o", "-"]):
            usual = self.run_with_stack(None, arguments)
            if usual.returncode == 69:
                continue  # this build has no alpha complexes
            self.assertEqual(usual.returncode, 0, (arguments, usual.stderr))
            small = self.run_with_stack(LEAST, arguments)
            self.assertEqual((small.returncode, small.stdout), (0, usual.stdout),
                             (arguments, small.stderr))
            for kib in (LEAST - 32, 64):
                run = self.run_with_stack(kib, arguments)
                self.assertEqual((run.returncode, run.stdout), (75, b""), (arguments, run.stderr))
                self.assertIn(f"found a limit of {kib} KiB for the stack, expected at least 128 "
                              "KiB; `ulimit -s 8192` sets it", run.stderr.decode())


if __name__ == "__main__":
    BARCODE, DISTANCE, VECTORISE, SEGMENT, CLUSTER = (os.path.abspath(sys.argv.pop(1)) for _ in range(5))
    unittest.main(verbosity=2)
