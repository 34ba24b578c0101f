# SPDX-License-Identifier: MIT
"""Tests that ph-barcode reads the formats of other programs, and that other programs can read the
files that it writes."""
import gzip
import json
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
import program  # noqa: E402
from tiff_files import page, tiff  # noqa: E402
from program import SQUARE_CSV, ProgramTest  # noqa: E402
from files import dipha, meta_image, nifti, nrrd, vti  # noqa: E402

DISTANCES = "0 1 2 1.5\n1 0 1.25 2\n2 1.25 0 1\n1.5 2 1 0\n"


class Formats(ProgramTest):
    def test_table(self):
        text = self.expect(0, "--formats").stdout
        for name in ("points", "sparse", "dipha", "npz", "nifti", "nrrd", "metaimage", "vti", "tiff", "perseus", "json", "ripser"):
            self.assertRegex(text, rf"(?m)^  {name} +\S")

    def bars(self, name, content, *options):
        self.write(name, content)
        return self.expect(0, name, *options).stdout

    def test_gzip(self):
        packed = gzip.compress(self.read_bytes("square.txt"))
        self.assertEqual(self.bars("square.txt.gz", packed), SQUARE_CSV)
        run = self.run_program("-", stdin=None, input=packed, text=False)
        self.assertEqual(run.stdout.decode(), SQUARE_CSV)

    def test_one_image_in_many_formats(self):
        # x varies fastest: 3 x 2 values
        values = [0, 5, 2, 4, 9, 1]
        expected = self.bars("a.dipha", dipha(1, 6, 2, 3, 2, *map(float, values)))
        self.assertIn("0,0,inf", expected)
        self.assertEqual(self.bars("a.perseus", "2\n3 2\n" + "\n".join(map(str, values))), expected)
        self.assertEqual(self.bars("a.pgm", "P2 3 2 9\n" + " ".join(map(str, values))), expected)
        self.assertEqual(self.bars("b.pgm", b"P5 3 2 9\n" + bytes(values)), expected)
        volume = nifti("|u1", (3, 2, 1), values, slope=1)
        self.assertEqual(self.bars("a.nii", volume), expected)
        self.assertEqual(self.bars("a.nii.gz", gzip.compress(volume)), expected)
        for encoding in ("raw", "gzip", "text"):
            self.assertEqual(self.bars("a.nrrd", nrrd("|u1", (3, 2, 1), values, encoding)), expected)
            picture = tiff([page("|u1", (2, 3), values, {"gzip": 8, "text": 5}.get(encoding, 1))])
            self.assertEqual(self.bars("a.tif", picture), expected)
            volume = meta_image("|u1", (3, 2, 1), values, encoding)
            self.assertEqual(self.bars("a.mha", volume), expected)
        for encoding in ("text", "base64", "raw", "gzip_raw", "gzip_base64", "gzip_appended_base64"):
            self.assertEqual(self.bars("a.vti", vti("<f4", (3, 2), values, encoding)), expected)

    def test_one_set_of_distances_in_many_formats(self):
        rows = [[float(d) for d in line.split()] for line in DISTANCES.splitlines()]
        expected = self.bars("d.txt", DISTANCES, "--format", "distance")
        self.assertEqual(self.bars("d.dipha", dipha(7, 4, *sum(rows, []))), expected)
        ids = sum(([j for j in range(4) if j != i] for i in range(4)), [])
        near = sum(([rows[i][j] for j in range(4) if j != i] for i in range(4)), [])
        self.assertEqual(self.bars("s.dipha", dipha(8, 4, 3, 3, 3, 3, *ids, *near), "--threshold",
                                   "2"), self.bars("d.txt", DISTANCES, "--format", "distance",
                                                   "--threshold", "2"))

    def test_boundary_matrix_of_dipha(self):
        content = dipha(0, 0, 3, 1, 0, 0, 1, 0.0, 0.5, 2.0, 0, 0, 0, 2, 0, 1)
        self.assertEqual(self.bars("b.dipha", content), "dim,birth,death\n0,0,inf\n0,0.5,2\n")

    def test_periodic_axes_come_from_the_file(self):
        # With two periodic axes, the image is a torus, whose four classes never die.
        values = "\n0 1 1\n1 1 1\n1 1 1\n"
        torus = self.bars("t.perseus", "2\n-3 -3" + values)
        self.assertEqual(torus.count("inf"), 4)
        self.assertEqual(self.bars("p.perseus", "2\n3 3" + values).count("inf"), 1)


class Peers(ProgramTest):
    def test_gudhi_reads_pers(self):
        code = ("import gudhi, json, sys\n"
                "d = gudhi.read_persistence_intervals_grouped_by_dimension("
                "persistence_file='out.pers')\n"
                "print(json.dumps({k: sorted(map(list, v)) for k, v in d.items()}))\n")
        self.expect(0, "square.txt", "-o", "out.pers")
        run = subprocess.run(["/usr/bin/python3", "-c", code], cwd=self.folder, text=True,
                             capture_output=True, timeout=60, check=False)
        if "ModuleNotFoundError" in run.stderr or "No such file" in run.stderr:
            self.skipTest("skipped: GUDHI's Python module is not installed")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(json.loads(run.stdout),
                         {"0": [[0, 1], [0, 1], [0, 1.0307764064044151], [0, float("inf")]],
                          "1": [[1.25, 1.4142135623730951]]})

    def test_ripser_reads_the_same_files(self):
        if shutil.which("ripser") is None:
            self.skipTest("skipped: ripser is not installed")
        for name, content, kind in (("d.txt", DISTANCES, "distance"),
                                    ("p.txt", "0 0\n1 0\n1 1\n0 1.25\n", "point-cloud"),
                                    ("s.txt", "0 1 1\n1 2 1.25\n2 3 1\n0 3 1.5\n", "sparse"),
                                    ("l.txt", "1\n2,1.25\n1.5,2,1\n", "lower-distance"),
                                    ("d.dipha", dipha(7, 3, 0., 1., 2., 1., 0., 1.5, 2., 1.5, 0.),
                                     "dipha")):
            with self.subTest(kind=kind):
                self.write(name, content)
                theirs = subprocess.run(["ripser", "--format", kind, name], cwd=self.folder,
                                        text=True, capture_output=True, timeout=60, check=True)
                own_kind = "points" if kind == "point-cloud" else kind
                ours = self.expect(0, name, "--format", own_kind, "--output-format", "ripser")
                pick = [line for line in theirs.stdout.splitlines() if line.startswith((" [", "pers"))]
                self.assertEqual(self.by_dimension(pick),
                                 self.by_dimension(ours.stdout.splitlines()))

    @staticmethod
    def by_dimension(lines):
        """The intervals of each dimension, sorted."""
        bars = {}
        for line in lines:
            if line.startswith("pers"):
                dim = bars.setdefault(line, [])
            else:
                dim.append(line)
        return {dim: sorted(found) for dim, found in bars.items() if found}


if __name__ == "__main__":
    program.main()
