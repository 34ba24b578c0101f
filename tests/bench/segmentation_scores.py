# SPDX-License-Identifier: MIT
"""bench/segmentation/segmentation_scores.py on small synthetic scenes, with peers whose scores are
known."""
import itertools
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
except ImportError as error:
    print(f"SKIPPED: {error} (apt install python3-numpy)")
    sys.exit(77)

BUILD = pathlib.Path(sys.argv.pop(1))
BENCH = pathlib.Path(__file__).resolve().parents[2] / "bench/segmentation"
sys.path[:0] = [str(BENCH), str(BENCH.parent)]
import label_pictures  # noqa: E402
import perturbations  # noqa: E402
import point_clouds  # noqa: E402
import segmentation_metrics as metrics  # noqa: E402
import segmentation_benchmark  # noqa: E402
from point_clouds import Pinhole, Scene  # noqa: E402

CAMERA = Pinhole(262.5, 159.5, 119.5, 320, 240)
BOXES = {
    20: (slice(60, 140), slice(40, 120), 0.85),
    30: (slice(80, 170), slice(190, 235), 0.88),
    31: (slice(80, 170), slice(235, 260), 0.88),
}
PEER = """
import sys
sys.path.insert(0, {bench!r})
import numpy, point_clouds
kind, path, output = sys.argv[1:]
truth = point_clouds.read_scene(path).truth
labels = {{"objects": truth // 10 * (truth > 9), "parts": truth * (truth > 9),
           "one": 2 - (truth < 10), "none": 0 * truth, "short": truth[1:]}}[kind]
with open(output + ".pgm", "wb") as file:
    file.write(b"P5 %d 1 65535\\n" % len(labels) + labels.astype(">u2").tobytes())
with open(output + ".csv", "w") as file:
    file.write("frame,t_load,t_cut,t_total,F\\na,0.25,0.5,0.75,1\\n")
"""


def table_scene(name):
    """A table seen from above with two boxes; the second box consists of two parts."""
    truth = numpy.ones((240, 320), int)
    depth = numpy.full((240, 320), 1.0)
    for label, (rows, columns, z) in BOXES.items():
        truth[rows, columns], depth[rows, columns] = label, z
    depth[:5] = numpy.nan
    v, u = numpy.indices(depth.shape)
    points = numpy.stack(
        [
            (u - CAMERA.centre_x) * depth / CAMERA.focal,
            (v - CAMERA.centre_y) * depth / CAMERA.focal,
            depth,
        ],
        axis=2,
    )
    return Scene(name, points.reshape(-1, 3).astype(numpy.float32), truth.ravel(), 320, 240)


def pixels(*labels):
    return sum(
        (rows.stop - rows.start) * (columns.stop - columns.start)
        for rows, columns, _ in map(BOXES.get, labels)
    )


class Metrics(unittest.TestCase):
    def test_assignment_is_the_best_of_all(self):
        generator = numpy.random.default_rng(1)
        for _ in range(200):
            rows = int(generator.integers(1, 5))
            cost = generator.random((rows, int(generator.integers(rows, 7)))).round(1)
            found = metrics.assignment(cost)
            self.assertEqual(len(set(found)), rows)
            least = min(
                sum(cost[i, j] for i, j in enumerate(columns))
                for columns in itertools.permutations(range(cost.shape[1]), rows)
            )
            self.assertAlmostEqual(cost[range(rows), found].sum(), least)

    def test_outside_is_what_a_search_reaches(self):
        generator = numpy.random.default_rng(2)
        for _ in range(50):
            mask = numpy.pad(generator.random((12, 15)) < generator.random(), 1)
            seen, stack = numpy.zeros_like(mask), [(0, 0)]
            while stack:
                y, x = stack.pop()
                if (
                    0 <= y < mask.shape[0]
                    and 0 <= x < mask.shape[1]
                    and not mask[y, x]
                    and not seen[y, x]
                ):
                    seen[y, x] = True
                    stack += [(y + 1, x), (y - 1, x), (y, x + 1), (y, x - 1)]
            self.assertTrue((metrics.outside(mask) == seen).all())

    def test_a_boundary_does_not_go_around_holes(self):
        mask = numpy.ones((7, 9), bool)
        mask[2:5, 3:6] = False
        self.assertEqual(len(metrics.outer_boundary(mask)[0]), 2 * (7 + 9) - 4)

    def test_without_objects_or_segments(self):
        table, box = numpy.ones((4, 4), int), numpy.full((4, 4), 20)
        both = lambda s: (s.precision, s.recall, s.f, s.boundary_f)
        self.assertEqual(both(metrics.score(table, 0 * table, False)), (1, 1, 1, 1))
        self.assertEqual(both(metrics.score(box, 0 * box, False)), (1, 0, 0, 0))
        self.assertEqual(both(metrics.score(table, table, False)), (0, 1, 0, 0))
        # The last frame has no depth.
        self.assertEqual(both(metrics.score(0 * box, box, False)), (1, 1, 1, 1))

    def test_supervoxels(self):
        truth = numpy.ones((8, 20), int)
        truth[1:7, 2:10], truth[1:7, 10:18] = 20, 30  # two objects of 48 pixels each, side by side
        halves = numpy.where(truth > 9, truth, 0)
        perfect = metrics.supervoxel_scores(truth, halves)
        self.assertEqual(
            perfect, metrics.SupervoxelScores(2, 1.0, 0.0), "and labels of the table do not count"
        )
        self.assertEqual(metrics.supervoxel_scores(truth, halves + (truth == 1)), perfect)
        one = metrics.supervoxel_scores(truth, numpy.full(truth.shape, 7))
        self.assertEqual((one.supervoxels, one.boundary_recall), (1, 0))
        # The only piece covers both objects. Only pixels of objects count. For each object, the
        # piece therefore has as many pixels outside the object as inside.
        self.assertEqual(one.under_segmentation, 1)
        for step, recall in ((2, 1), (3, 0)):  # the number of columns by which the border moves
            moved = numpy.where(numpy.indices(truth.shape)[1] < 10 + step, 1, 2)
            found = metrics.supervoxel_scores(truth, moved)
            self.assertEqual(found.boundary_recall, recall)
            self.assertAlmostEqual(found.under_segmentation, 2 * 6 * step / 96)
        nothing = metrics.supervoxel_scores(truth // 2, halves)
        self.assertEqual(nothing, metrics.SupervoxelScores(2, None, 0.0))
        self.assertIsNone(metrics.supervoxel_scores(truth * 0 + 1, halves).under_segmentation)

    def test_a_boundary_may_be_two_pixels_away(self):
        scene = table_scene("a")
        truth = scene.truth.reshape(240, 320)
        objects = truth // 10 * (truth > 9)
        f = lambda step: metrics.score(truth, numpy.roll(objects, step, axis=1), False).boundary_f
        self.assertEqual((f(0), f(2)), (1, 1))
        self.assertLess(f(3), 0.8)  # the rows of the upper and lower border still agree


class Clouds(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "a.pcd"

    def test_lzf(self):
        stream = bytes([2]) + b"abc" + bytes([(2 << 5) | 0, 2]) + bytes([(7 << 5) | 0, 1, 0])
        plain = b"abcabca" + b"a" * 10
        self.assertEqual(point_clouds.decompressed(stream, len(plain)), plain)
        self.assertEqual(point_clouds.decompressed(stream, 4), plain[:4])
        for bad, size in (
            (stream[:-1], 17),
            (stream, 18),
            (bytes([0]) + b"a" + bytes([1 << 5, 3]), 4),
        ):
            with self.assertRaises(ValueError):
                point_clouds.decompressed(bad, size)

    def test_every_kind_of_file(self):
        scene = table_scene("a")
        point_clouds.write_scene(self.path, scene)
        binary = self.path.read_bytes()
        start = binary.index(b"DATA binary\n")
        rows = numpy.frombuffer(binary[start + 12 :], numpy.float32).reshape(-1, 4)
        columns = rows.T.tobytes()
        literals = b"".join(
            bytes([len(part) - 1]) + part
            for part in (columns[i : i + 32] for i in range(0, len(columns), 32))
        )
        labels = rows[:, 3].view(numpy.uint32)
        text = "".join(
            f"{x:.9g} {y:.9g} {z:.9g} {label}\n" for (x, y, z, _), label in zip(rows, labels)
        )
        for data in (
            b"binary\n" + rows.tobytes(),
            b"ascii\n" + text.encode(),
            b"binary_compressed\n" + struct.pack("<II", len(literals), len(columns)) + literals,
        ):
            self.path.write_bytes(binary[:start] + b"DATA " + data)
            found = point_clouds.read_scene(self.path)
            numpy.testing.assert_array_equal(found.points, scene.points)
            numpy.testing.assert_array_equal(found.truth, scene.truth)

    def test_a_camera_puts_points_back(self):
        scene = table_scene("a")
        there = numpy.flatnonzero(numpy.isfinite(scene.points[:, 2]))
        loose = Scene("a", scene.points[there], scene.truth[there], len(there), 1)
        numpy.testing.assert_array_equal(CAMERA.image(loose, loose.truth).ravel(), scene.truth)


class Perturbations(unittest.TestCase):
    def test_each_is_as_stated_and_the_same_again(self):
        scene = table_scene("a")
        there = numpy.isfinite(scene.points[:, 2])
        for kind in perturbations.KINDS:
            amount = 2 if kind in ("noise", "stride") else 30
            found, again = (perturbations.perturbed(scene, kind, amount) for _ in range(2))
            numpy.testing.assert_array_equal(found.points, again.points)
            self.assertEqual(len(found.truth), found.width * found.height)
            self.assertTrue((found.truth[~numpy.isfinite(found.points[:, 2])] == 0).all())
            if kind == "noise":
                moved = (found.points - scene.points)[there]
                self.assertAlmostEqual(
                    (moved[:, 2] / scene.points[there, 2] ** 2).std(), 0.002, delta=1e-4
                )
                numpy.testing.assert_allclose(
                    numpy.cross(found.points[there], scene.points[there]), 0, atol=1e-6
                )
            elif kind == "stride":
                self.assertEqual((found.width, found.height), (160, 120))
            else:
                kept = numpy.isfinite(found.points[:, 2]).sum() / there.sum()
                self.assertAlmostEqual(kept, 0.3 if kind == "subset" else 0.7, delta=0.06)


class Script(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.json = self.folder / "results.json"
        (self.folder / "scenes").mkdir()
        for name in ("a", "b"):
            point_clouds.write_scene(self.folder / f"scenes/{name}.pcd", table_scene(name))
        (self.folder / "categories.csv").write_text("frame,category\na,boxes\n")
        (self.folder / "peer.py").write_text(PEER.format(bench=str(BENCH)))

    def peer(self, kind, settings=""):
        program = f"{sys.executable} -B {self.folder}/peer.py"
        return f"{kind} = {settings} {program} {kind} {{input}} {{output}}"

    def run_it(self, *arguments, code=0):
        run = subprocess.run(
            [
                sys.executable,
                "-B",
                BENCH / "segmentation_scores.py",
                BUILD,
                self.folder / "scenes",
                "--json",
                self.json,
                "--categories",
                self.folder / "categories.csv",
                *arguments,
            ],
            capture_output=True,
            text=True,
            timeout=240,
        )
        self.assertEqual(run.returncode, code, run.stderr)
        return run

    def test_known_scores(self):
        run = self.run_it(
            "--peer",
            self.peer("objects"),
            "--peer",
            self.peer("parts"),
            "--peer",
            self.peer("none"),
            "--peer",
            self.peer("one", "background=1"),
            "--ours=--objects",
            "--frames",
            "a",
            "--times",
            "1",
        )
        report = json.loads(self.json.read_text())
        f = lambda program, truth, key="f": report["scores"][program]["a"][truth][key]
        every = pixels(20, 30, 31)
        self.assertEqual([f(p, "objects") for p in ("objects", "none")], [1, 0])
        self.assertEqual((f("parts", "parts"), f("parts", "parts", "boundary_f")), (1, 1))
        self.assertAlmostEqual(f("objects", "parts"), pixels(20, 30) / every)
        self.assertAlmostEqual(f("parts", "objects"), pixels(20, 30) / every)
        self.assertAlmostEqual(f("one", "objects"), max(pixels(20), pixels(30, 31)) / every)
        self.assertGreater(f("libph --objects", "objects"), 0.98)
        self.assertEqual(f("libph --objects", "objects", "segments"), 2)
        self.assertIn("| objects | 1.000 | 1.000 |", run.stdout)
        self.assertIn("| one | .504 | .504 |", run.stdout)

    def test_times_curves_pictures_and_cross_validation(self):
        run = self.run_it(
            "--peer",
            self.peer("objects", "stages={output}.csv"),
            "--ours=",
            "--times",
            "2",
            "--perturb",
            "noise=1",
            "--perturb",
            "dropout=20,50",
            "--perturb",
            "stride=2",
            "--cross-validate",
            "--grid",
            "min-part=200,100000",
            "--pictures",
            self.folder / "pictures",
            "--svg",
            self.folder / "curves.svg",
        )
        report = json.loads(self.json.read_text())
        self.assertEqual(report["categories"], {"a": "boxes", "b": "other"})
        taken = report["times"]["objects"]["a"]
        self.assertEqual(taken["stages"], {"load": 0.25, "cut": 0.5})
        self.assertGreater(taken["cpu"], 0)
        self.assertEqual(
            list(report["times"]["libph"]["b"]["stages"])[:3], ["load", "range filter", "plane"]
        )
        for kind, amounts in report["curves"].items():
            for scores in amounts.values():
                self.assertEqual(scores["objects"]["objects"], 1)
                self.assertGreater(scores["libph"]["objects"], 0.9, kind)
        picked = report["cross_validation"]["objects"]["chosen"]["boxes"]
        self.assertEqual(picked["options"], "--min-part 200")
        self.assertIn("libph, cross-validated", run.stdout)
        self.assertIn("| libph | load ", run.stdout)
        self.assertIn("</svg>", (self.folder / "curves.svg").read_text())
        self.assertEqual((self.folder / "pictures/a.png").read_bytes()[:4], b"\x89PNG")

    def test_a_program_that_fails_is_named(self):
        self.assertIn(
            "76799 labels of 76800 points", self.run_it("--peer", self.peer("short"), code=1).stderr
        )
        self.assertIn(
            "short: a.pcd: exit 2",
            self.run_it(
                "--peer", f"short = {sys.executable} -c 'import sys; sys.exit(2)' {{input}}", code=1
            ).stderr,
        )

    def test_results_are_kept(self):
        self.run_it("--ours", "", "--frames", "a")
        self.run_it("--ours", "", "--peer", self.peer("none"), "--only", "none", "--frames", "a")
        self.assertEqual(set(json.loads(self.json.read_text())["scores"]), {"libph", "none"})

    def test_a_category_is_scored_with_what_is_best_on_the_others(self):
        result = segmentation_benchmark.cross_validated(
            {"first": {"a": 0.9, "b": 0.5, "c": 0.6}, "second": {"a": 0.4, "b": 0.8, "c": 0.9}},
            {"a": "boxes", "b": "mixed", "c": "mixed"},
        )
        self.assertEqual(result["chosen"]["boxes"]["options"], "second")
        self.assertEqual(result["chosen"]["mixed"]["options"], "first")
        self.assertEqual(result["f"]["boxes"], 0.4)
        self.assertAlmostEqual(result["f"]["all"], (0.4 + 0.5 + 0.6) / 3)

    def test_segments_have_the_colours_of_their_objects(self):
        truth = numpy.ones((60, 60), int)
        truth[10:20, 10:20], truth[30:50, 30:50] = 20, 30
        prediction = numpy.where(truth == 30, 7, 0)
        picture = label_pictures.beside(truth, [prediction], step=1)
        half = (picture.shape[1] - label_pictures.GAP) // 2
        left, right = picture[:, :half], picture[:, -half:]
        self.assertEqual((left != right).any(axis=2).sum(), 100)


if __name__ == "__main__":
    unittest.main()
