# SPDX-License-Identifier: MIT
"""ph-cluster: labels and trees in all formats say the same, clouds keep their fields, and a run that
fails leaves nothing behind."""
import ast
import csv
import io
import json
import math
import os
import random
import struct
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, main  # noqa: E402


def array_of(content):
    """@return type, shape and numbers of an NPY file."""
    length = struct.unpack_from("<H", content, 8)[0]
    header = ast.literal_eval(content[10:10 + length].decode())
    count = math.prod(header["shape"])
    kind = {"<f8": "d", "<i8": "q"}[header["descr"]]
    return header["descr"], header["shape"], struct.unpack_from(f"<{count}{kind}", content, 10 + length)


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))


def number(value):
    return math.inf if value is None else value


class OutputsTest(ProgramTest):
    def setUp(self):
        super().setUp()
        rng = random.Random(5)
        self.points = [(rng.gauss(6 * (k % 2), 1), rng.gauss(0, 1), 1.0) for k in range(80)]
        for k in range(9, 80, 10):
            self.points[k] = (rng.uniform(-20, 20), rng.uniform(-20, 20), 1.0)
        self.points[7] = (math.nan, 0.0, 1.0)
        self.write("p.txt", "".join(" ".join(map(repr, p)) + "\n" for p in self.points))
        self.base = ["p.txt", "--nan", "drop", "--min-size", "4", "--quiet"]

    def test_labels_in_all_formats(self):
        plain = [int(row["label"]) for row in rows_of(self.expect(0, *self.base).stdout)]
        self.assertEqual(plain[7], -3)
        self.assertLessEqual({-1, 0, 1}, set(plain))
        self.expect(0, *self.base, "-o", "l.npy")
        self.assertEqual(array_of(self.read_bytes("l.npy")), ("<i8", (80,), tuple(plain)))
        scored = rows_of(self.expect(0, *self.base, "--scores").stdout)
        self.assertEqual([int(row["label"]) for row in scored], plain)
        for option in ("--labels", "--output", "-o"):
            self.expect(0, *self.base, "--scores", option, "s.npy")
        kind, shape, values = array_of(self.read_bytes("s.npy"))
        self.assertEqual((kind, shape), ("<f8", (80, 3)))
        for k, row in enumerate(scored):
            self.assertEqual([repr(float(row[name])) for name in ("label", "probability", "outlier_score")],
                             [repr(v) for v in values[3 * k:3 * k + 3]])
        self.expect(0, *self.base, "--scores", "-o", "s.json")
        document = json.loads(self.read("s.json"))
        self.assertEqual(document["labels"], plain)
        for name, column in (("probabilities", "probability"), ("outlier_scores", "outlier_score")):
            self.assertEqual(document[name], [None if row[column] == "nan" else float(row[column]) for row in scored])
        self.assertEqual(document["input"], {"path": "p.txt", "description": "79 points in R^3, text", "points": 80,
                                             "left_out": 1})
        self.assertEqual((document["metric"], document["neighbours"], document["min_size"]), ("euclidean", 3, 4))
        self.assertEqual([c["points"] for c in document["clusters"]],
                         [plain.count(label) for label in range(max(plain) + 1)])
        self.assertNotIn("probabilities", json.loads(self.expect(0, *self.base, "--output-format", "json").stdout))

    def test_trees(self):
        self.expect(0, *self.base, "-o", "l.json", "--tree", "t.json")
        self.expect(0, *self.base, "-o", "l.csv", "--tree", "t.csv")
        tree, labels = json.loads(self.read("t.json")), json.loads(self.read("l.json"))
        clusters = tree["clusters"]
        for place, (row, cluster) in enumerate(zip(rows_of(self.read("t.csv")), clusters)):
            self.assertEqual(row, {"cluster": str(place), **{name: row[name] for name in cluster}})
            for name, value in cluster.items():
                self.assertEqual(float(row[name]), number(value), (place, name))
        self.assertEqual(len(rows_of(self.read("t.csv"))), len(clusters))
        self.assertEqual([c["parent"] == -1 for c in clusters], [False] * (len(clusters) - 1) + [True])
        self.assertEqual(clusters[-1]["size"], 79)
        # The points of a cluster are its own and those of the clusters inside it.
        sizes = [tree["cluster_of"].count(c) for c in range(len(clusters))]
        for place, cluster in enumerate(clusters):
            self.assertEqual(sizes[place], cluster["size"])
            if cluster["parent"] >= 0:
                self.assertGreater(cluster["parent"], place)
                self.assertEqual(cluster["top"], clusters[cluster["parent"]]["bottom"])
                sizes[cluster["parent"]] += sizes[place]
        self.assertEqual((tree["cluster_of"][7], tree["leaves_at"][7]), (-1, None))
        for chosen in labels["clusters"]:
            cluster = clusters[chosen["cluster"]]
            self.assertEqual(chosen, {"label": cluster["label"], "cluster": chosen["cluster"],
                                      "points": chosen["points"],
                                      **{name: cluster[name] for name in ("top", "bottom", "mass")}})
            inside = {chosen["cluster"]}
            for place in reversed(range(len(clusters))):
                if clusters[place]["parent"] in inside:
                    inside.add(place)
            self.assertEqual([k for k, c in enumerate(tree["cluster_of"]) if c in inside],
                             [k for k, label in enumerate(labels["labels"]) if label == cluster["label"]])
        self.assertEqual(self.expect(0, *self.base, "-o", "l.csv", "--tree", "-").stdout, self.read("t.json"))

    def test_copies_have_infinite_mass(self):
        self.write("c.txt", "0 0\n" * 9 + "5 5\n" * 9)
        self.expect(0, "c.txt", "-o", "l.json", "--tree", "t.csv", "--quiet")
        self.assertEqual([c["mass"] for c in json.loads(self.read("l.json"))["clusters"]], [None, None])
        self.assertEqual([row["mass"] for row in rows_of(self.read("t.csv"))][:2], ["inf", "inf"])

    def test_clouds(self):
        size = len(self.points)
        self.write("c.pcd", "VERSION 0.7\nFIELDS x y z intensity label\nSIZE 4 4 4 2 4\nTYPE F F F U U\n"
                   "COUNT 1 1 1 1 1\n"
                   f"WIDTH {size // 4}\nHEIGHT 4\nVIEWPOINT 0 0 2 1 0 0 0\nPOINTS {size}\nDATA ascii\n" + "".join(
                       f"{x!r} {y!r} {z!r} {k} {k + 100}\n" for k, (x, y, z) in enumerate(self.points)))
        expected = [int(row["label"]) for row in rows_of(self.expect(0, "c.pcd", "--min-size", "4").stdout)]
        self.assertLessEqual({-3, -1, 0, 1}, set(expected))
        scored = rows_of(self.expect(0, "c.pcd", "--min-size", "4", "--scores").stdout)
        run = self.expect(0, "c.pcd", "--min-size", "4", "--scores", "-o", "l.ply")
        self.assertIn("PLY does not hold the viewpoint 0,0,2", run.stderr)
        content = self.read_bytes("l.ply")
        header, _, data = content.partition(b"end_header\n")
        names = [line.split()[1:] for line in header.decode().splitlines() if line.startswith("property")]
        self.assertEqual([name for _, name in names], ["x", "y", "z", "intensity", "label_in", "label", "probability",
                                                       "outlier_score"])
        self.assertEqual(names[5][0], "uint")
        record = struct.Struct("<fffHIIff")
        self.assertEqual(len(data), size * record.size)
        for k, (label, row, values) in enumerate(zip(expected, scored, record.iter_unpack(data))):
            self.assertEqual(values[3:6], (k, k + 100, max(label + 1, 0)))
            for value, name in zip(values[6:], ("probability", "outlier_score")):
                if label == -3:
                    self.assertTrue(math.isnan(value))
                else:
                    self.assertAlmostEqual(value, float(row[name]), 6)
        self.expect(0, "c.pcd", "--min-size", "4", "-o", "l.pcd")
        text = self.read_bytes("l.pcd")
        for line in (b"FIELDS x y z intensity label_in label\n", b"WIDTH 20\nHEIGHT 4\nVIEWPOINT 0 0 2 1 0 0 0\n"):
            self.assertIn(line, text)
        # The new file has the points of the old one.
        again = rows_of(self.expect(0, "l.pcd", "--min-size", "4", "--quiet").stdout)
        self.assertEqual([int(row["label"]) for row in again], expected)
        run = self.expect(64, *self.base, "-o", "x.ply")
        self.assertIn("expected csv, json or npy", run.stderr)
        self.assertNotIn("x.ply", self.files())

    def test_a_failure_leaves_nothing(self):
        before = self.files()
        self.expect(65, "p.txt", "-o", "l.csv", "--tree", "t.json")
        self.expect(64, *self.base, "--neighbours", "99", "-o", "l.csv", "--tree", "t.json")
        self.expect(73, *self.base, "-o", "missing/l.csv")
        self.expect(73, *self.base, "-o", "l.csv", "--tree", "missing/t.json")
        self.assertEqual(self.files(), before)
        self.write("l.csv", "old")
        self.expect(65, "p.txt", "-o", "l.csv")
        self.assertEqual(self.read("l.csv"), "old")
        with open("/dev/full", "w") as full:
            self.assertEqual(self.run_program(*self.base, stdout=full).returncode, 74)
        with subprocess.Popen(["true"], stdin=subprocess.PIPE) as reader:
            reader.wait()
            self.assertEqual(self.run_program(*self.base, stdout=reader.stdin).returncode, 74)


if __name__ == "__main__":
    main()
