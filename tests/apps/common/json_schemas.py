# SPDX-License-Identifier: MIT
"""json_schemas.py PH_BARCODE PH_SEGMENT PH_VECTORISE PH_DISTANCE PH_CLUSTER: the JSON of the programs conforms
to docs/reference/schemas, and the schemas describe each member that the programs write. Without
python3-jsonschema, the test is skipped."""
import copy
import json
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import jsonschema
except ImportError:
    print("skipped: jsonschema is missing; scripts/setup.sh docs installs it")
    sys.exit(77)

ROOT = Path(__file__).resolve().parents[3]
DATA = ROOT / "examples/data"
SCHEMAS = ROOT / "docs/reference/schemas"
SQUARE = "0 0\n1 0\n1 1\n0 1\n"
MESH = "0 : 0\n1 : 1\n2 : 2\n0 1 : 1\n1 2 : 2\n0 2 : 3\n"
MATRIX = "0\n0\n1 0 1\n"


def closed(schema):
    """The same schema, made to refuse members that it does not describe."""
    schema = copy.deepcopy(schema)

    def close(part):
        if isinstance(part, dict):
            if "properties" in part:
                part.setdefault("additionalProperties", False)
            for key, inner in part.items():
                # These keywords only state dependencies between members.
                if key not in ("if", "then", "else", "allOf"):
                    close(inner)
        elif isinstance(part, list):
            for inner in part:
                close(inner)
    close(schema)
    return schema


def checker(name):
    schema = json.loads((SCHEMAS / f"{name}.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(closed(schema))


class Tester:
    def __init__(self, folder, barcode, segment, vectorise, distance, cluster):
        self.folder, self.barcode, self.segment = folder, barcode, segment
        self.vectorise, self.distance, self.cluster = vectorise, distance, cluster
        self.checkers = {file.name.partition(".")[0]: checker(file.name.partition(".")[0])
                         for file in SCHEMAS.glob("*.schema.json")}
        self.count, self.failures, self.seen = 0, 0, set()

    def run(self, program, *arguments, code=0):
        result = subprocess.run([program, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                                check=False)
        if result.returncode != code:
            sys.exit(f"{arguments}: exit code {result.returncode}, expected {code}\n{result.stderr}")
        return result

    def check(self, schema, text, what):
        self.count += 1
        self.seen.add(schema)
        value = json.loads(text)
        for error in self.checkers[schema].iter_errors(value):
            self.failures += 1
            print(f"{what}: {error.json_path}: {error.message[:300]}")
        return value

    def check_bars(self, *arguments):
        printed = self.run(self.barcode, *arguments, "--output-format", "json", "--quiet").stdout
        return self.check("ph-barcode", printed, arguments)


def test_barcodes(t):
    circles, blobs = DATA / "two_circles.csv", DATA / "blobs.pgm"
    for name, text in {"square.csv": SQUARE, "mesh.simplices": MESH, "matrix.phat": MATRIX}.items():
        (t.folder / name).write_text(text)
    t.check_bars(circles)
    t.check_bars(circles, "--representatives", "cycles")
    t.check_bars(circles, "--representatives", "cycles", "--loops", "plain", "--field", "3")
    t.check_bars(circles, "--representatives", "cocycles", "--max-dim", "2", "--threshold", "1")
    t.check_bars(circles, "--dtm", "3", "--metric", "minkowski:3", "--min-dim", "1")
    t.check_bars(circles, "--subsample", "20")
    t.check_bars(circles, "--approximate", "1")
    t.check_bars(circles, "--complex", "cubical", "--voxel", "0.3", "--voxel-value", "density")
    t.check_bars(blobs, "--superlevel", "--representatives", "voxels")
    t.check_bars(blobs, "--representatives", "cycles", "--construction", "cells", "--periodic", "0",
                 "--min-persistence", "2")
    t.check_bars("mesh.simplices", "--representatives", "cycles")
    t.check_bars("matrix.phat")
    if "alpha complexes need it" not in t.run(t.barcode, "--version", "--verbose").stdout:
        (t.folder / "weights.txt").write_text("1\n1\n1\n-9\n")
        weighted = t.check_bars("square.csv", "--complex", "alpha", "--weights", "weights.txt")
        assert weighted["alpha"]["squared"]
        assert t.check_bars("square.csv", "--complex", "alpha", "--period", "3,0")["alpha"]["period"] == [3, 0]
        t.check_bars("square.csv", "--complex", "delaunay-rips", "--representatives", "cycles")
    assert "row" in t.check_bars("matrix.phat")["bars"][0]["birth_cell"]
    t.run(t.barcode, "square.csv", "-o", "square.pers", "--quiet")
    assert "complex" not in t.check_bars("square.pers")
    (t.folder / "low.grid").write_text("-inf 1 -inf 2\n")
    low = t.check_bars("low.grid", "--format", "grid")
    assert low["bars"][0]["birth"] == "-inf"


def test_others(t):
    t.run(t.barcode, "square.csv", "-o", "a.json", "--quiet")
    t.run(t.barcode, DATA / "two_circles.csv", "-o", "b.json", "--quiet")
    compared = t.run(t.barcode, "--compare", "a.json", "b.json", "--output-format", "json", "--quiet")
    t.check("ph-barcode-distances", compared.stdout, "--compare")
    noise = bytes((i * i * 2654435761 >> 7) & 255 for i in range(500 * 500))
    (t.folder / "noise.raw").write_bytes(noise)  # large enough that a run reports progress
    lines = t.run(t.barcode, "noise.raw", "--raw-shape", "500,500", "--engine", "standard", "--progress", "json",
                  "--quiet", "--output-format", "none").stderr.splitlines()
    if not lines:
        sys.exit("--progress json: found no line on standard error")
    for line in lines:
        t.check("progress", line, "--progress json")


def test_segmentations(t):
    table, stack = DATA / "table.pcd", DATA / "stack.pcd"
    for options in ([], ["--signatures", "--parts"], ["--method", "paper"], ["--supervoxels", "0.03"],
                    ["--method", "paper", "--steps", "exact", "--no-check"], ["--plane", "off"],
                    ["--crop", "-1,1,-1,inf,0,2", "--viewpoint", "0,0,0", "--voxel", "0.01", "--max-range", "inf"],
                    ["--crop", "5,6,5,6,5,6"]):
        t.run(t.segment, stack, "--json", "s.json", "--tree", "t.json", "--barcode", "b.json", "--quiet", *options)
        for schema, name in (("ph-segment", "s"), ("ph-segment-tree", "t"), ("ph-barcode", "b")):
            t.check(schema, (t.folder / f"{name}.json").read_text(), options)
    t.run(t.segment, table, "--tree", "scene.tree", "--quiet")
    t.run(t.segment, "scene.tree", "--cut", "0.05", "--json", "s.json", "--quiet")
    assert t.check("ph-segment", (t.folder / "s.json").read_text(), "a stored tree")["options"] is None
    (t.folder / "broken.pcd").write_text("VERSION 0.7\n")
    t.run(t.segment, table, "broken.pcd", "--json", "frames.jsonl", "--quiet", code=65)
    lines = (t.folder / "frames.jsonl").read_text().splitlines()
    found = [t.check("ph-segment", line, "a stream").get("exit_code") for line in lines]
    assert found == [None, 65], found


def test_fits(t):
    for kind in ("statistics", "betti", "landscape", "silhouette", "image", "entropy", "life-entropy", "lengths",
                 "atol", "euler"):
        for options in ([], ["--infinite", "9"]):
            t.run(t.vectorise, DATA / "bars", "--kind", kind, "--fit", "fit.json", "-o", "x.npy", "--quiet", *options)
            t.check("ph-vectorise-fit", (t.folder / "fit.json").read_text(), (kind, *options))
    t.run(t.vectorise, DATA / "blobs.pgm", "--kind", "euler", "--periodic", "0", "--fit", "fit.json", "-o", "x.npy",
          "--quiet")
    t.check("ph-vectorise-fit", (t.folder / "fit.json").read_text(), "an image")


def test_distances(t):
    bars = DATA / "bars"
    (t.folder / "groups.txt").write_text("x\ny\nx\ny\n")
    (t.folder / "always.csv").write_text("dim,birth,death\n0,-inf,1\n0,0,2\n")
    (t.folder / "never.csv").write_text("dim,birth,death\n0,1,inf\n1,0,inf\n")
    kinds = ([], ["--distance", "wasserstein", "--order", "2", "--ground", "2", "--error", "0.01"],
             ["--distance", "wasserstein"], ["--distance", "sliced"], ["--at-most", "0.1"])
    for options in kinds:
        for inputs in ([bars], [bars, bars], ["always.csv", "never.csv"]):
            printed = t.run(t.distance, *inputs, *options, "--output-format", "json", "--quiet").stdout
            t.check("ph-distance", printed, (inputs, *options))
        if "--at-most" not in options:
            printed = t.run(t.distance, bars, bars, *options, "--groups", "groups.txt", "--output-format", "json",
                            "--quiet").stdout
            t.check("ph-distance", printed, ("--groups", *options))
    for options in kinds[:3]:
        for inputs in ([bars], ["always.csv"] * 2, ["never.csv"] * 2, ["always.csv", "never.csv"]):
            t.run(t.distance, *inputs, *options, "--matching", "m.json", "--quiet")
            t.check("ph-distance-matching", (t.folder / "m.json").read_text(), (inputs, *options))


def test_clusters(t):
    (t.folder / "copies.csv").write_text("0,0\n" * 9 + "5,5\n" * 9 + "nan,1\n")
    (t.folder / "some.txt").write_text("0 1 1\n1 2 1\n3 4 2\n")
    (t.folder / "births.txt").write_text("0.5 1 2\n1 0 2\n2 2 0\n")
    for inputs in ([DATA / "two_circles.csv"], [DATA / "two_circles.csv", "--metric", "minkowski:3",
                                                  "--method", "leaf"],
                   ["copies.csv", "--nan", "drop", "--epsilon", "0.5", "--max-size", "100"],
                   ["some.txt", "--format", "sparse", "--min-size", "2", "--allow-single"],
                   ["births.txt", "--diagonal", "births", "--min-size", "2"]):
        for options in ([], ["--scores"]):
            t.run(t.cluster, *inputs, *options, "-o", "l.json", "--tree", "t.json", "--quiet")
            t.check("ph-cluster", (t.folder / "l.json").read_text(), (inputs, *options))
            t.check("ph-cluster-tree", (t.folder / "t.json").read_text(), (inputs, *options))


def test_that_faults_are_seen(t):
    """Corrupted documents must be refused, because a schema that accepts everything would test
    nothing."""
    printed = t.run(t.barcode, "square.csv", "--representatives", "cycles", "--output-format", "json", "--quiet").stdout
    t.run(t.vectorise, DATA / "bars", "--kind", "image", "--fit", "fit.json", "-o", "x.npy", "--quiet")
    sliced = t.run(t.distance, DATA / "bars", "--distance", "sliced", "--output-format", "json", "--quiet").stdout
    for schema, text, spoils in (
            ("ph-barcode", printed,
             (lambda v: v.pop("bars"), lambda v: v.update(new=1), lambda v: v["bars"][0].update(dim="0"),
              lambda v: v["bars"][0].update(birth="inf"), lambda v: v["bars"][0]["birth_cell"].update(row=1),
              lambda v: v["bars"][0].update(birth_cell={"foo": 1}), lambda v: v["bars"][0].update(death=None),
              lambda v: v["bars"][-1]["representative"][0].pop("vertices"),
              lambda v: v["bars"][-1]["loops"][0].pop("vertices"), lambda v: v.pop("complex"))),
            ("ph-vectorise-fit", (t.folder / "fit.json").read_text(),
             (lambda v: v["blocks"][0].pop("sigma"), lambda v: v["blocks"][0].pop("dim"))),
            ("ph-distance", sliced, (lambda v: v.pop("directions"),)),
            ("ph-cluster", (t.folder / "l.json").read_text(),
             (lambda v: v.pop("labels"), lambda v: v["labels"].append(-2), lambda v: v.pop("outlier_scores"))),
            ("ph-cluster-tree", (t.folder / "t.json").read_text(),
             (lambda v: v["clusters"][0].pop("mass"), lambda v: v["clusters"][0].update(size=0)))):
        good = json.loads(text)
        assert t.checkers[schema].is_valid(good), schema
        for number, spoil in enumerate(spoils):
            bad = copy.deepcopy(good)
            spoil(bad)
            assert not t.checkers[schema].is_valid(bad), (schema, number)


def main():
    with tempfile.TemporaryDirectory() as folder:
        t = Tester(Path(folder), *map(lambda path: str(Path(path).resolve()), sys.argv[1:6]))
        test_barcodes(t)
        test_others(t)
        test_segmentations(t)
        test_fits(t)
        test_distances(t)
        test_clusters(t)
        test_that_faults_are_seen(t)
        unseen = set(t.checkers) - t.seen
        print(f"{t.count} outputs, {t.failures} faults" + "".join(f"\n{name}: no output was held against it"
                                                                 for name in sorted(unseen)))
        sys.exit(1 if t.failures or unseen else 0)


if __name__ == "__main__":
    main()
