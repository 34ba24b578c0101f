# SPDX-License-Identifier: MIT
"""program_overwrites.py PH_BARCODE PH_SEGMENT PH_CLUSTER: an output never replaces an input unless --force
allows it, and never replaces another output, whatever names are used for the files."""
import json
import os
import subprocess
import sys
import unittest
import zipfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from option_inputs_segment import CAMERA, FOCAL, HEIGHT, WIDTH, depth_png, depths, pcd, points_of  # noqa: E402
from files import RGB, array, png, two_files  # noqa: E402
from program import FolderTest, has_page  # noqa: E402

BARCODE = SEGMENT = CLUSTER = None
POINTS = b"0 0\n1 0\n1 1\n0 1.25\n"
ALIASES = ("{}", "./{}", "folder/../{}", "link-{}", "hard-{}")


class Overwrites(FolderTest):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("folder"))

    def write(self, name, content):
        """Writes a file, and creates a symbolic link and a hard link to it."""
        super().write(name, content)
        path = self.path(name)
        folder, name = os.path.split(path)
        os.symlink(name, os.path.join(folder, "link-" + name))
        os.link(path, os.path.join(folder, "hard-" + name))

    def run_in_folder(self, *arguments, **options):
        return subprocess.run(arguments, cwd=self.folder, capture_output=True, text=True,
                              timeout=60, **options)

    def refused(self, program, option, files, *arguments):
        """Checks that a run exits with 64 and names the option, and that no file changes."""
        before = {name: self.read_bytes(name) for name in files}
        run = self.run_in_folder(program, *arguments)
        self.assertEqual(run.returncode, 64, (arguments, run.stderr))
        self.assertIn(option, run.stderr)
        self.assertEqual(run.stdout, "")
        for name, content in before.items():
            self.assertEqual(self.read_bytes(name), content, arguments)

    def test_ph_barcode(self):
        inputs = {"p.csv": POINTS, "w.csv": b"0\n0\n0\n0\n", "v.html": POINTS, "s.svg": POINTS}
        for name, content in inputs.items():
            self.write(name, content)
        for alias in ALIASES:
            points, weights = alias.format("p.csv"), alias.format("w.csv")
            for option, arguments in (
                    ("--output", ["p.csv", "-o", points]),
                    ("--output", ["p.csv", "--vertex-weights", "w.csv", "-o", weights]),
                    ("--report", ["v.html", "--report", alias.format("v.html")]),
                    ("--plot", ["s.svg", "--plot", alias.format("s.svg")]),
                    ("--output", ["p.csv", "w.csv", "-o", "./"]),
                    ("--output", ["--compare", "p.csv", "w.csv", "-o", weights])):
                with self.subTest(arguments=arguments):
                    if option == "--report" and not has_page(BARCODE):
                        self.skipTest("reports are not built in")
                    self.refused(BARCODE, option, inputs, *arguments)

    def test_ph_cluster(self):
        inputs = {"p.csv": POINTS, "t.json": POINTS}
        for name, content in inputs.items():
            self.write(name, content)
        for alias in ALIASES:
            for option, arguments in (
                    ("--output", ["p.csv", "-o", alias.format("p.csv")]),
                    ("--tree", ["t.json", "--format", "points", "--tree", alias.format("t.json")]),
                    ("is also written by --output", ["p.csv", "-o", "x.csv", "--tree", "./x.csv", "--force"])):
                with self.subTest(arguments=arguments):
                    self.refused(CLUSTER, option, inputs, *arguments)
        with open(self.path("p.csv"), "ab") as file:
            run = subprocess.run([CLUSTER, "p.csv", "--dry-run"], cwd=self.folder, stdout=file,
                                 stderr=subprocess.PIPE, timeout=60)
        self.assertEqual((run.returncode, self.read_bytes("p.csv")), (64, POINTS), run.stderr)
        run = self.run_in_folder(CLUSTER, "p.csv", "-o", "p.csv", "--force")
        self.assertEqual((run.returncode, self.read("p.csv")), (0, "label\n" + "-1\n" * 4), run.stderr)

    def test_ph_barcode_values(self):
        self.write("m.off", b"OFF\n2 1 0\n0 0 0\n1 0 0\n2 0 1\n")
        self.write("v.csv", b"1\n2\n")
        self.refused(BARCODE, "--output", ["v.csv"], "m.off", "--values", "v.csv", "-o", "hard-v.csv")

    def test_a_part_of_a_file_is_an_input(self):
        for name in ("scan.npz", "a.npz"):
            path = self.path(name)
            with zipfile.ZipFile(path, "w") as archive:
                for part in ("image", "x"):
                    archive.writestr(part + ".npy", array((2, 3), [0, 0, 1, 1, 0, 2]))
        self.write("h.ply", b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                   b"property float y\nproperty float z\nproperty float height\nelement face 1\n"
                   b"property list uchar int vertex_indices\nend_header\n0 0 0 1\n1 0 0 2\n2 0 1\n")
        self.write("m.off", b"OFF\n2 1 0\n0 0 0\n1 0 0\n2 0 1\n")
        for option, arguments in (
                ("--output", ["scan.npz:image", "-o", "scan.npz"]),
                ("--plot", ["scan.npz:image", "--plot", "link.svg"]),
                ("--output", ["m.off", "--values", "hard-h.ply:height", "-o", "h.ply"]),
                ("--output", ["--compare", "scan.npz:image", "a.npz:x", "-o", "a.npz"])):
            if "link.svg" in arguments:
                os.symlink("scan.npz", self.path("link.svg"))
            with self.subTest(arguments=arguments):
                self.refused(BARCODE, option, ["scan.npz", "a.npz", "h.ply"], *arguments)

    def test_data_files_and_slices_are_inputs(self):
        header, data = two_files((3, 2), [0, 5, 2, 4, 9, 1], "v.raw")
        os.mkdir(self.path("slices"))
        inputs = {"v.mhd": header, "v.raw": data, "slices/1.pgm": b"P5 3 2 9\n" + data,
                  "slices/2.pgm": b"P5 3 2 9\n" + data, "w.mhd": header}
        for name, content in inputs.items():
            self.write(name, content)
        stack = ["--stack", "slices"]
        for option, arguments in (("--output", ["v.mhd", "-o", "hard-v.raw"]),
                                  ("--output", ["v.mhd", "-o", "folder/../v.raw"]),
                                  ("--output", ["v.mhd", "--part", "1/1", "-o", "link-v.raw"]),
                                  ("--output", ["v.mhd", "w.mhd", "--part", "1/1", "-o", "v.raw"]),
                                  ("--output", ["folder/../v.mhd", "--dims", "0", "-o", "v.raw"]),
                                  ("--output", [*stack, "-o", "slices/2.pgm"]),
                                  ("--output", [*stack, "--max-dim", "0", "--part", "1/1", "-o",
                                                "slices/1.pgm"])):
            with self.subTest(arguments=arguments):
                self.refused(BARCODE, option, inputs, *arguments)
        run = self.run_in_folder(BARCODE, *stack, "-o", "slices/bars.csv")
        self.assertEqual(run.returncode, 0, run.stderr)
        run = self.run_in_folder(BARCODE, "v.mhd", "-o", "v.raw", "--force")
        self.assertEqual((run.returncode, self.read_bytes("v.raw")[:4]), (0, b"dim,"), run.stderr)

    def test_standard_input_is_an_input(self):
        self.write("p.csv", POINTS)
        with open(self.path("p.csv"), "rb") as file:
            run = self.run_in_folder(BARCODE, "-", "-o", "p.csv", stdin=file)
        self.assertEqual((run.returncode, self.read_bytes("p.csv")), (64, POINTS))

    def test_standard_output_is_an_output(self):
        self.write("p.csv", POINTS)
        with open(self.path("p.csv"), "ab") as file:
            run = subprocess.run([BARCODE, "p.csv"], cwd=self.folder, stdout=file,
                                 stderr=subprocess.PIPE, timeout=60)
        self.assertEqual((run.returncode, self.read_bytes("p.csv")), (64, POINTS))

    def test_standard_output_of_other_modes(self):
        bars = b"dim,birth,death\n0,0,1\n"
        self.write("a.csv", bars)
        self.write("p.csv", POINTS)
        for name, content, arguments in (("a.csv", bars, ["--compare", "a.csv", "link-a.csv"]),
                                         ("p.csv", POINTS, ["p.csv", "--dry-run"])):
            with open(self.path(name), "ab") as file:
                run = subprocess.run([BARCODE, *arguments], cwd=self.folder, stdout=file,
                                     stderr=subprocess.PIPE, timeout=60)
            self.assertEqual((run.returncode, self.read_bytes(name)), (64, content), run.stderr)

    def test_two_outputs(self):
        self.write("p.csv", POINTS)
        for alias in ("x.svg", "./x.svg", "folder/../x.svg"):
            self.refused(BARCODE, "x.svg", ["p.csv"], "p.csv", "-o", "x.svg",
                         "--output-format", "csv", "--plot", alias)
            self.refused(BARCODE, "x.svg", ["p.csv"], "p.csv", "--plot", "x.svg", "--plot", alias,
                         "--force")
        self.assertFalse(os.path.exists(self.path("x.svg")))
        # The folder of the output does not exist yet.
        for arguments in (["--plot", "new/", "--plot-kind", "barcode", "--plot", "new/*.svg",
                           "--plot-kind", "diagram"],
                          ["-o", "new/*.svg", "--output-format", "csv", "--plot",
                           "folder/../new/*.svg"]):
            self.refused(BARCODE, "p.svg", ["p.csv"], "p.csv", "link-p.csv", *arguments)
        self.assertFalse(os.path.exists(self.path("new")))
        # The same device may be named for two outputs if it keeps nothing.
        run = self.run_in_folder(BARCODE, "p.csv", "-o", "/dev/null", "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_force(self):
        self.write("p.csv", POINTS)
        run = self.run_in_folder(BARCODE, "p.csv", "-o", "p.csv", "--force")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue(self.read_bytes("p.csv").startswith(b"dim,birth,death\n"))

    def scene(self, *clouds):
        """Writes the same scene as clouds and as a depth image, and writes the camera of the depth
        image."""
        image = depths(36)
        for name in clouds:
            self.write(name, pcd(list(points_of(image)), WIDTH, HEIGHT))
        self.write("d.png", depth_png(image))
        self.write("cam.json", json.dumps({
            "width": WIDTH, "height": HEIGHT, "intrinsic_matrix":
            [FOCAL, 0, 0, 0, FOCAL, 0, WIDTH / 2, HEIGHT / 2, 1]}).encode())

    def write_list(self, *frames):
        self.write("list.txt", "".join(f"{frame}\n" for frame in frames).encode())

    def test_ph_segment(self):
        self.scene("s.pcd")
        self.write("c.png", png(WIDTH, HEIGHT, 8, RGB, [bytes([9, 9, 9]) * WIDTH] * HEIGHT))
        files = ("s.pcd", "d.png", "c.png", "cam.json")
        depth = ["--depth", "d.png", "--color", "c.png", "--intrinsics", CAMERA]
        for alias in ALIASES:
            cloud, camera = alias.format("s.pcd"), alias.format("cam.json")
            for option, arguments in (
                    ("--output", ["s.pcd", "-o", cloud]),
                    ("--coloured", ["s.pcd", "--coloured", cloud]),
                    ("--json", ["s.pcd", "--json", cloud]),
                    ("--json", ["d.png", "--camera", "cam.json", "--json", camera]),
                    ("--json", ["d.png", "d.png", "--camera", "cam.json", "--json", camera]),
                    ("--picture", [*depth, "--picture", alias.format("d.png")]),
                    ("--labels", [*depth, "--labels", alias.format("c.png")]),
                    ("--plot", [*depth, "--plot", alias.format("c.png")])):
                with self.subTest(arguments=arguments):
                    self.refused(SEGMENT, option, files, *arguments)
        self.refused(SEGMENT, "--labels", files, "s.pcd", "--barcode", "x.csv", "--labels", "./x.csv")
        self.refused(SEGMENT, "--output", files, "s.pcd", "hard-s.pcd", "-o", "*.pcd")
        self.refused(SEGMENT, "--json", files, "s.pcd", "hard-s.pcd", "--json", "link-s.pcd")

    def test_a_camera_by_its_name_is_no_file(self):
        self.scene()
        self.write("kinect-v1", b"anything")
        run = self.run_in_folder(SEGMENT, "d.png", "--camera", "kinect-v1", "--json", "kinect-v1")
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_frames_of_a_list(self):
        self.scene("s.pcd", "folder/s.pcd")
        self.write_list("folder/s.pcd", "s.pcd")
        files = ("s.pcd", "folder/s.pcd", "list.txt")
        with open(self.path("list.txt"), "rb") as opened:
            for source in (["--frames-from", "list.txt"], ["--frames-from", "-"]):
                opened.seek(0)
                before = {name: self.read_bytes(name) for name in files}
                run = self.run_in_folder(SEGMENT, *source, "-o", "*.pcd", stdin=opened)
                self.assertEqual(run.returncode, 64, run.stderr)
                self.assertIn("--output: s.pcd is an input, expected a file that is not an input", run.stderr)
                self.assertEqual(before, {name: self.read_bytes(name) for name in files}, source)
        for output in ("s.pcd", "hard-s.pcd", "list.txt"):
            self.refused(SEGMENT, "--json", files, "--frames-from", "list.txt", "--json", output)

    def test_frames_of_a_pipe(self):
        self.scene("s.pcd", "t.pcd")
        frames = "t.pcd\ns.pcd\nt.pcd\n"
        for labels in ([], ["--labels", "out/"]):
            before = self.read_bytes("s.pcd")
            run = self.run_in_folder(SEGMENT, "--frames-from", "-", "--json", "hard-s.pcd", *labels,
                                     input=frames)
            self.assertEqual((run.returncode, self.read_bytes("s.pcd")), (64, before), run.stderr)
            self.assertIn("--json: hard-s.pcd is the input s.pcd", run.stderr)
        run = self.run_in_folder(SEGMENT, "--frames-from", "-", "--json", "s.pcd", "--force",
                                 input=frames)
        self.assertEqual((run.returncode, self.read_bytes("s.pcd")[:1]), (0, b"{"), run.stderr)

    def test_the_json_of_all_frames_is_a_file_of_its_own(self):
        self.scene("a.pcd", "b.pcd")
        run = self.run_in_folder(SEGMENT, "a.pcd", "b.pcd", "--labels", "out/*.csv", "--json",
                                 "folder/../out/a.csv")
        self.assertEqual(run.returncode, 64, run.stderr)
        self.assertIn("--json: folder/../out/a.csv is also written by --labels", run.stderr)

    def test_text_of_ph_segment(self):
        self.scene("s.pcd")
        before = self.read_bytes("s.pcd")
        for arguments in ([], ["--explain", "1,2"], ["--json", "-"], ["hard-s.pcd", "--json", "-"]):
            with open(self.path("s.pcd"), "ab") as file:
                run = subprocess.run([SEGMENT, "s.pcd", *arguments], cwd=self.folder, stdout=file,
                                     stderr=subprocess.PIPE, text=True, timeout=60)
            self.assertEqual((run.returncode, self.read_bytes("s.pcd")), (64, before), arguments)
            self.assertIn("standard output is the input", run.stderr)

    def test_a_star_stands_for_the_name_of_one_input_too(self):
        self.scene("s.pcd")
        run = self.run_in_folder(SEGMENT, "s.pcd", "-o", "out/*.pcd", "--labels", "out/*.npy")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(sorted(os.listdir(self.path("out"))), ["s.npy", "s.pcd"])

    def test_force_is_not_needed(self):
        self.scene("s.pcd", "t.pcd")
        said = "--force: not needed, because no output is an input"
        for outputs, needed in ((["--json", "x.json"], False), (["-o", "out/"], False),
                                (["-o", "./"], True), (["--json", "s.pcd"], True)):
            run = self.run_in_folder(SEGMENT, "s.pcd", "t.pcd", *outputs, "--force", "--verbose")
            self.assertEqual(said in run.stderr, not needed, (outputs, run.stderr))


if __name__ == "__main__":
    BARCODE, SEGMENT, CLUSTER = (os.path.abspath(sys.argv.pop(1)) for _ in range(3))
    unittest.main(verbosity=2)
