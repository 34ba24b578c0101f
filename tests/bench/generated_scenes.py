# SPDX-License-Identifier: MIT
"""generated_scenes.py BUILD: the generated frames agree with the geometry, and the same seed gives
the same frame."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
except ModuleNotFoundError:
    print("SKIPPED: no NumPy")
    sys.exit(77)

BUILD = pathlib.Path(sys.argv.pop(1))
SCENES = pathlib.Path(__file__).resolve().parents[2] / "bench/scenes"
sys.path.insert(0, str(SCENES))
import arrangements  # noqa: E402
import cameras  # noqa: E402
import frames  # noqa: E402
import placing  # noqa: E402
import shapes  # noqa: E402
import score  # noqa: E402
import stability  # noqa: E402
import point_clouds  # noqa: E402

VIEW = cameras.View.towards(cameras.SENSORS["structured-light"], (0.3, -0.8, 0.7), (0, 0, 0.05))


def seen(solid):
    """The visible points of a solid, in world coordinates."""
    image = cameras.cast(VIEW, [(0, solid)])
    points = (VIEW.rays() * image.depth[..., None])[image.thing == 0]
    return points @ VIEW.turn + VIEW.eye


class Shapes(unittest.TestCase):
    def test_points_of_a_ball_are_at_its_radius(self):
        away = numpy.linalg.norm(seen(shapes.ball(0.1)) - (0, 0, 0.1), axis=1)
        self.assertGreater(len(away), 5000)
        self.assertLess(abs(away - 0.1).max(), 0.001)  # the ball is a chain of 24 frustums

    def test_points_of_a_turned_box_are_on_its_faces(self):
        turn = shapes.turned("z", 0.5)
        points = seen(shapes.Box(size=(0.2, 0.1, 0.15)).placed(turn, (0.05, 0, 0)))
        own = (points - (0.05, 0, 0)) @ turn
        faces = abs(abs(own - (0, 0, 0.075)) - (0.1, 0.05, 0.075))
        self.assertLess(faces.min(axis=1).max(), 1e-9)
        self.assertTrue((abs(own - (0, 0, 0.075)) <= numpy.array((0.1, 0.05, 0.075)) + 1e-9).all())

    def test_a_cup_is_hollow(self):
        points = seen(shapes.cup(0.05, 0.1, 0.004))
        away = numpy.hypot(points[:, 0], points[:, 1])
        self.assertTrue(((away < 0.047) & (points[:, 2] < 0.08)).any())
        self.assertLess(away.max(), 0.05 + 1e-9)

    def test_what_is_let_down_touches_and_does_not_cut(self):
        scene, can = placing.Scene(), (shapes.cylinder(0.05, 0.1),)
        scene.add("support", shapes.Box(size=(1, 1, 0.1)).placed(shift=(0, 0, -0.1)))
        below = placing.rest(scene, (shapes.Box(size=(0.2, 0.2, 0.1)),), 0, 0)
        scene.add("object", *below)
        for x, hangs in ((0.03, False), (0.08, True)):
            above = placing.rest(scene, can, x, 0)
            self.assertAlmostEqual(above[0].corners()[:, 2].min(), 0.1)
            self.assertEqual(placing.hangs_over(above, below), hangs)
        self.assertIsNone(placing.rest(scene, can, 0.12, 0))  # the can tips over


class Frames(unittest.TestCase):
    def test_each_kind(self):
        for kind in arrangements.KINDS:
            with self.subTest(kind):
                scene, colours = frames.frame(kind, 3)
                self.assertEqual(len(scene.truth), scene.width * scene.height)
                self.assertEqual(colours.shape, scene.points.shape)
                self.assertFalse((scene.truth[~numpy.isfinite(scene.points).all(axis=1)] > 0).any())
                self.assertTrue((scene.truth >= 20).any())
                self.assertEqual((scene.truth == 1).any(), kind != "loose")

    def test_the_same_seed_gives_the_same_bytes_which_read_back(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = [pathlib.Path(folder, name) for name in ("a.pcd", "b.pcd")]
            for path in paths:
                scene, colours = frames.frame("stack", 7)
                point_clouds.write_scene(path, scene, colours)
            self.assertEqual(*(path.read_bytes() for path in paths))
            back = point_clouds.read_scene(paths[0])
        numpy.testing.assert_array_equal(back.points, scene.points)
        numpy.testing.assert_array_equal(back.truth, scene.truth)
        self.assertFalse(numpy.array_equal(frames.frame("stack", 8)[0].truth, scene.truth))


class Scores(unittest.TestCase):
    def test_strays(self):
        truth = numpy.array([1, 1, 1, 20, 20, 0, 0])
        self.assertEqual(score.strays(truth, numpy.array([5, 5, 0, 6, 6, 7, 7])), 1)
        self.assertEqual(score.strays(truth, numpy.array([5, 0, 0, 5, 5, 0, 0])), 0)

    def test_things_on_a_table(self):
        command = [sys.executable, "-B", SCENES / "score.py", BUILD, "--kinds", "table", "--seeds", "1-3",
                   "--one-edge", "--peer", f"itself = {BUILD}/apps/segment/ph-segment {{input}} --labels {{output}}.npy"]
        run = subprocess.run([*command, "--least", "table=0.9"], capture_output=True, text=True, timeout=280)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("table     F 0.9", run.stdout)
        self.assertIn("difference 0.0000 ± 0.0000", run.stdout)
        self.assertRegex(run.stdout, r"CPU [1-9]\d* ms \| .*, CPU x \d+\.\d\d,")
        run = subprocess.run([*command, "--least", "table=1.1"], capture_output=True, text=True, timeout=280)
        self.assertEqual(run.returncode, 1, run.stdout + run.stderr)


class Stability(unittest.TestCase):
    def setUp(self):
        self.frame = stability.generated_frame("table", 3)

    def test_a_change_moves_points_and_keeps_their_numbers(self):
        scene = self.frame.scene
        there = numpy.isfinite(scene.points).all(axis=1)
        for name, changed in stability.changes(self.frame, 1):
            with self.subTest(name):
                self.assertEqual(len(changed.origin), changed.scene.width * changed.scene.height)
                kept = numpy.isfinite(changed.scene.points).all(axis=1)
                self.assertTrue(there[changed.origin[kept]].all())
                truth = scene.truth[changed.origin[kept]]
                numpy.testing.assert_array_equal(changed.scene.truth[kept], truth)
                before = numpy.linalg.norm(scene.points[changed.origin[kept]], axis=1)
                after = numpy.linalg.norm(changed.scene.points[kept] - changed.viewpoint, axis=1)
                if name.startswith("noise"):
                    self.assertGreater(abs(after - before).max(), 1e-3)
                else:
                    numpy.testing.assert_allclose(after, before, atol=1e-5)

    def test_noise_of_surfaces_is_that_of_the_sensor(self):
        for sensor, allowed in (("structured-light", 0.1), ("active-stereo", 0.2)):
            scene, _ = frames.frame("table", 3, sensor)
            spread = cameras.SENSORS[sensor].spread(1.0)
            ratio = stability.noise_of_surfaces(scene) / spread
            self.assertAlmostEqual(ratio, 1, delta=allowed, msg=sensor)

    def test_the_camera_is_found(self):
        scene, _ = frames.frame("table", 3, "active-stereo")
        expected = (460, 460, 319.5, 239.5)
        numpy.testing.assert_allclose(stability.pinhole(scene), expected, atol=1e-3)

    def test_a_table(self):
        command = [sys.executable, "-B", SCENES / "stability.py", BUILD, "--kinds", "table",
                   "--seeds", "1"]
        run = subprocess.run(command, capture_output=True, text=True, timeout=280)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("| 1 generated frames | libph |", run.stdout)
        self.assertIn("| points in random order | 1.000 / 1.000 / 100 % |", run.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
