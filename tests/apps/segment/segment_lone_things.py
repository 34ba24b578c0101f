# SPDX-License-Identifier: MIT
"""Checks that ph-segment finds things where no table is the largest plane, in rooms, and low things
on a table.

segment_lone_things.py PH_SEGMENT

bench/scenes/lone_things.py and frames.py make the scenes.
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
except ImportError as error:
    print(f"SKIPPED: {error} (apt install python3-numpy)")
    sys.exit(77)

PROGRAM = pathlib.Path(sys.argv.pop(1))
BENCH = pathlib.Path(__file__).resolve().parents[3] / "bench"
sys.path[:0] = [str(BENCH / "scenes"), str(BENCH / "segmentation"), str(BENCH)]
import frames  # noqa: E402
import point_clouds  # noqa: E402
import score  # noqa: E402
import segmentation_metrics as metrics  # noqa: E402
from lone_things import CASES, can, frames_of, look_at, scene_of  # noqa: E402


def run(scene, folder, *options):
    """The labels of objects, the summary and the messages of ph-segment for a frame."""
    cloud, labels, summary = (folder / name for name in ("c.pcd", "l.npy", "s.json"))
    point_clouds.write_scene(cloud, scene)
    command = [PROGRAM, cloud, "--no-check", "--labels", labels, "--json", summary, *options]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    found = json.loads(summary.read_text())
    return score.of_objects(numpy.load(labels).ravel(), found), found, done.stderr


class LoneThings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_scenes(self):
        for name, case in CASES.items():
            scores = []
            for scene in frames_of(case):
                with self.subTest(name, frame=scene.name):
                    labels, summary, messages = run(scene, self.folder)
                    result = metrics.score(scene.truth, labels, False, False)
                    scores.append(result.f)
                    why = summary["plane"].get("note", summary["plane"])
                    found = numpy.count_nonzero(numpy.unique(labels))
                    self.assertGreaterEqual(result.f, case.least, why)
                    self.assertGreater(found, 0, why)
                    if case.exact:
                        self.assertEqual(found, result.objects, why)
                    if summary["segments"] == []:
                        self.assertIn("no segments: ", messages)
                    if not summary["plane"]["found"]:
                        self.assertIn(why, messages)
            print(f"{name}: F from {min(scores):.3f} to {max(scores):.3f}")

    def test_rooms(self):
        """In these rooms, more points of things are just in front of a wall than of the floor."""
        for seed in (600, 804, 1013, 1015):
            with self.subTest(seed=seed):
                scene, _ = frames.frame("room", seed)
                labels, summary, _ = run(scene, self.folder, "--max-range", "6")
                self.assertGreaterEqual(metrics.score(scene.truth, labels, False, False).f, 0.8)
                roles = {surface["role"] for surface in summary["surfaces"]}
                self.assertLessEqual({"floor", "support", "wall"}, roles)

    def test_the_edge_that_was_chosen_may_be_given(self):
        scene, _ = frames.frame("room", 1008)
        labels, summary, _ = run(scene, self.folder, "--max-range", "6")
        voxel = summary["voxel"]
        self.assertGreater(voxel, 0.01)
        again, _, _ = run(scene, self.folder, "--max-range", "6", "--voxel", repr(voxel))
        numpy.testing.assert_array_equal(again, labels)

    def test_an_empty_result_has_a_reason(self):
        empty = scene_of(table=True)
        empty.eye, empty.target = (0, -0.7, 0.7), (0, 0, 0)
        speck = can(0.2, None)
        look_at(speck, 20, 0, 1.4)
        for name, scene in (("table", empty), ("speck", speck)):
            with self.subTest(name):
                random = numpy.random.default_rng(0)
                seen, _ = frames.seen(scene, "structured-light", random, name)
                _, summary, messages = run(seen, self.folder)
                self.assertEqual(summary["segments"], [])
                self.assertIn("no segments: ", messages)


if __name__ == "__main__":
    unittest.main()
