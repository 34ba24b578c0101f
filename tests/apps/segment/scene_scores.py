# SPDX-License-Identifier: MIT
"""Checks that ph-segment reaches minimum scores on a few real frames, by the metrics of the
benchmark.

scene_scores.py PH_SEGMENT

The environment variable PH_TEST_DATA names the folder with the frames.

"""
import os
import pathlib
import sys
import tempfile
import unittest

try:
    import numpy
except ImportError as error:
    print(f"SKIPPED: {error} (apt install python3-numpy)")
    sys.exit(77)

TEST_DATA = os.environ.get("PH_TEST_DATA", "")
SCENES = pathlib.Path(TEST_DATA, "scenes")
PROGRAM = pathlib.Path(sys.argv.pop(1))
BENCH = pathlib.Path(__file__).resolve().parents[3] / "bench"
sys.path[:0] = [str(BENCH / "segmentation"), str(BENCH)]
import point_clouds  # noqa: E402
import segmentation_metrics as metrics  # noqa: E402
from segmentation_programs import Program  # noqa: E402

# One frame of each kind that distance-based pipelines get wrong: stacked, occluded, cylindrical,
# complex.
FRAMES = ("learn19", "learn27", "learn37", "test57")
if not TEST_DATA or not all((SCENES / f"{frame}.pcd").exists() for frame in FRAMES):
    print(f"SKIPPED: PH_TEST_DATA, which is {TEST_DATA!r}, lacks frames in scenes: no score is tested")
    sys.exit(77)


class Floors(unittest.TestCase):
    def scores(self, options, score):
        """The mean over the frames for which the score is defined."""
        program = Program(
            "libph", f"{PROGRAM} {{input}} --quiet --no-check --labels {{output}}.npy {options}"
        )
        rows = []
        with tempfile.TemporaryDirectory() as folder:
            for frame in FRAMES:
                scene = point_clouds.read_scene(SCENES / f"{frame}.pcd")
                labels = program.labels(SCENES / f"{frame}.pcd", pathlib.Path(folder))
                shape = (scene.height, scene.width)
                images = [a.reshape(scene.height, scene.width) for a in (scene.truth, labels)]
                rows.append(score(*images))
        mean = numpy.nanmean(numpy.array(rows, float), axis=0)
        print(f"{options or 'defaults'}: {numpy.round(mean, 4)}")
        return mean

    def of_objects(self, parts):
        def both(truth, labels):
            scores = metrics.score(truth, labels, parts)
            return scores.f, scores.boundary_f

        return both

    def test_objects(self):
        f, boundary_f = self.scores("", self.of_objects(parts=False))
        self.assertGreaterEqual(f, 0.975)
        self.assertGreaterEqual(boundary_f, 0.93)

    def test_parts(self):
        f, boundary_f = self.scores("--parts", self.of_objects(parts=True))
        self.assertGreaterEqual(f, 0.975)
        self.assertGreaterEqual(boundary_f, 0.94)

    def test_supervoxels(self):
        def both(truth, labels):
            scores = metrics.supervoxel_scores(truth, labels)
            return scores.boundary_recall, scores.under_segmentation

        recall, error = self.scores("--supervoxels 0.03", both)
        self.assertGreaterEqual(recall, 0.95)
        self.assertLessEqual(error, 0.02)


if __name__ == "__main__":
    unittest.main()
