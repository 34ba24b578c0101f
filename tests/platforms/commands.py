# SPDX-License-Identifier: MIT
"""Commands whose output must be the same, byte for byte, wherever the programs were compiled.

They read the files of examples/data, a sample of each format, random inputs for each kind of
complex (from tests/random_runs, which compares their bars with the definition), and inputs with
rounded values, which would reveal a different order of computation.
"""
import dataclasses
import math
import random
import struct
import sys
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / folder) for folder in ("random_runs", "samples", "support")]
import files  # noqa: E402
import jobs  # noqa: E402
import samples  # noqa: E402

DATA = TESTS.parent / "examples/data"
BARCODE, SEGMENT = "apps/barcode/ph-barcode", "apps/segment/ph-segment"
VECTORISE, DISTANCE = "apps/vectorise/ph-vectorise", "apps/distance/ph-distance"
CLUSTER = "apps/cluster/ph-cluster"


@dataclasses.dataclass
class Command:
    """A command and its inputs. The names of output files begin with `out`."""
    words: list
    # Inputs other than the files of examples/data: maps names to bytes.
    inputs: dict = dataclasses.field(default_factory=dict)
    may_refuse: bool = False  # with exit code 64, if the complex lacks what is requested
    # True if values are computed with exp, log, pow, hypot or sin of the C library. The last bits
    # of these values depend on the processor: glibc's results differ on a processor without fused
    # multiply-add.
    of_library: bool = False


def of_examples():
    yield [BARCODE, "two_circles.csv", "--max-dim", "2", "--check"]
    yield [BARCODE, "two_circles.csv", "--representatives", "cycles", "-o", "out.json", "--loops", "tight"]
    yield [BARCODE, "two_circles.csv", "--plot", "out.svg", "--plot", "out.png", "-o", "out.csv"]
    yield [BARCODE, "two_circles.csv", "--dry-run"]
    yield [BARCODE, "two_circles.csv", "-o", "out-größe-→.json", "--quiet"]
    for metric in ("manhattan", "chebyshev", "cosine", "hamming", "minkowski:3"):
        yield [BARCODE, "torus.csv", "--metric", metric, "--subsample", "60"]
    for engine in ("standard", "twist", "cohomology", "edge-links"):
        yield [BARCODE, "two_circles.csv", "--engine", engine, "--threads", "2"]
    for field in ("2", "3", "11"):
        yield [BARCODE, "torus.csv", "--field", field, "--threshold", "1.2", "--max-dim", "1"]
    yield [BARCODE, "correlations.csv", "--from-correlation"]
    yield [BARCODE, "pulse.csv", "--threads", "2"]
    for image in ("blobs.pgm", "phantom.nii.gz"):
        for more in ([], ["--superlevel"], ["--representatives", "cycles", "-o", "out.json"]):
            yield [BARCODE, image, *more]
    yield [BARCODE, "hills.ply", "-o", "out.npy"]
    yield [BARCODE, "stack.pcd", "--subsample", "80", "-o", "out.dipha"]
    for cloud in ("table.pcd", "stack.pcd"):
        yield [SEGMENT, cloud, "-o", "out.pcd", "--labels", "out.npy", "--json", "out.json"]
        yield [SEGMENT, cloud, "--parts", "--plot", "out.svg", "--plot-kind", "cloud"]
        for method in ("paper", "supervoxels"):
            yield [SEGMENT, cloud, "--method", method, "--labels", "out.csv", "--json", "out.json",
                   "--tree", "out-tree.json", "--barcode", "out-bars.csv"]
    yield [SEGMENT, "stack.pcd", "--explain", "1,2"]
    yield [SEGMENT, "stack.pcd", "--signatures", "--surfaces", "out.npy", "--json", "out.json"]
    yield [SEGMENT, "table.pcd", "--plot", "out.png"]
    for kind in ("statistics", "betti", "landscape", "silhouette", "image", "entropy", "life-entropy", "lengths",
                 "atol", "euler"):
        yield Command([VECTORISE, "bars", "--kind", kind, "-o", "out.npy", "--fit", "out.json"],
                      of_library=kind in ("image", "atol"))
    yield Command([VECTORISE, "bars", "--kind", "atol", "--contrast", "gauss"], of_library=True)
    yield Command([VECTORISE, "bars", "--kind", "image", "--power", "1.7"], of_library=True)
    yield [VECTORISE, "blobs.pgm", "phantom.nii.gz", "--kind", "euler"]
    for options in ([], ["--distance", "wasserstein"], ["--distance", "wasserstein", "--order", "3", "--ground", "1.5"],
                    ["--distance", "sliced"]):
        matching = [] if "sliced" in options else ["--matching", "out.csv"]
        yield [DISTANCE, "bars", *options, *matching, "-o", "out.json"]
    yield [DISTANCE, "bars", "bars", "--dim", "1", "--matrix", "out.npy"]
    for options in ([], ["--method", "leaf", "--neighbours", "1"], ["--metric", "cosine", "--epsilon", "0.1"]):
        yield [CLUSTER, "torus.csv", *options, "--scores", "-o", "out.npy", "--tree", "out.json"]
    yield [CLUSTER, "stack.pcd", "--min-size", "50", "--scores", "-o", "out.ply"]
    yield [CLUSTER, "correlations.csv", "--from-correlation", "--min-size", "2"]


PROGRAMS = {"ph-barcode": BARCODE, "ph-segment": SEGMENT}


def of_samples():
    """Commands that read a file of each format. Barcode files are given to the programs that read
    barcodes."""
    for sample in samples.SAMPLES:
        inputs = {sample.name: sample.content}
        for name in sample.needs:
            inputs[name] = next(s.content for s in samples.SAMPLES if s.name == name)
        if sample.program:
            words = [argument.format(sample.name) for argument in sample.arguments]
            yield Command([PROGRAMS[sample.program], *words], inputs)
        elif sample.reader == "barcode":
            yield Command([VECTORISE, sample.name], inputs)


def of_random_inputs(count):
    """Commands with small inputs of each kind, with cycles or cocycles where these are possible."""
    for kind, job_of in jobs.KINDS.items():
        for seed in range(count):
            job = job_of(random.Random(seed))
            more = ["--representatives", ("cycles", "cocycles")[seed // 2 % 2]] if seed % 2 else []
            yield Command([BARCODE, job.files[0][0], *job.options, *more, "-o", "out.json"],
                          dict(job.files), may_refuse=True)


def rows(numbers):
    """Numbers as lines of text, with all digits of each double."""
    return "".join(",".join(map(repr, row)) + "\n" for row in numbers).encode()


def grid(numbers, *shape):
    return files.npy("<f8", shape, struct.pack(f"<{len(numbers)}d", *numbers))


def of_rounded_values():
    """Commands with coordinates, distances and voxels that use all bits of a double."""
    rng = random.Random(1)
    planar, spatial, many = ({"a.csv": rows([[rng.gauss(0, 1) for _ in range(dim)] for _ in range(count)])}
                             for dim, count in ((2, 200), (3, 120), (8, 60)))
    entering = {**planar, "weights.txt": rows([[abs(rng.gauss(0, 0.1))] for _ in range(200)])}
    around = {"a.csv": rows([[rng.random() for _ in range(3)] for _ in range(80)])}
    rips = [BARCODE, "a.csv", "-o", "out.json"]
    for points in (planar, spatial, many):
        for metric in ("euclidean", "manhattan", "chebyshev", "cosine", "minkowski:3", "minkowski:1.5"):
            yield Command([*rips, "--metric", metric, "--representatives", "cycles"], points,
                          of_library=metric.startswith("minkowski"))
        yield Command([*rips, "--max-dim", "2"], points)
        yield Command([*rips, "--significance"], points, of_library=True)
        yield Command([*rips, "--collapse", "on", "--threshold", "0.9"], points)
        yield Command([*rips, "--dtm", "5", "--weight-exponent", "2"], points, of_library=True)
        yield Command([*rips, "--approximate", "0.3"], points)
        yield Command([*rips, "--subsample-radius", "0.4", "--field", "3"], points)
        yield Command([*rips, "--max-dim", "0"], points)
        yield Command([*rips, "--delay", "2,3"], points)
    yield Command([*rips, "--engine", "beta-skeleton"], planar)
    for exponent in ("1", "2", "inf"):
        yield Command([*rips, "--vertex-weights", "weights.txt", "--weight-exponent", exponent], entering,
                      of_library=exponent == "2")
    for points in (planar, spatial):
        for kind in ("alpha", "delaunay-cech", "delaunay-rips"):
            yield Command([*rips, "--complex", kind, "--representatives", "cycles"], points)
        for value in ("distance", "occupancy", "density"):
            yield Command([*rips, "--complex", "cubical", "--voxel", "0.3", "--voxel-value", value], points)
    yield Command([*rips, "--complex", "alpha", "--weights", "weights.txt"], entering)
    yield Command([*rips, "--complex", "alpha", "--period", "1"], around)
    yield Command([*rips, "--complex", "alpha", "--alpha-values", "squared", "--alpha-shape", "0.5=out.ply",
                   "--wrap", "0.7=out.off"], spatial)
    n = 40
    upper = {(i, j): rng.random() for j in range(n) for i in range(j)}
    matrix = {"a.csv": rows([[0.0 if i == j else upper[min(i, j), max(i, j)] for j in range(n)] for i in range(n)])}
    yield Command([*rips, "--format", "distance", "--max-dim", "2", "--representatives", "cocycles"], matrix)
    for shape in ((300,), (20, 30), (8, 9, 10), (4, 5, 4, 5)):
        voxels = {"a.npy": grid([rng.gauss(0, 1) for _ in range(math.prod(shape))], *shape)}
        cubical = [BARCODE, "a.npy", "--complex", "cubical", "-o", "out.json"]
        for construction in ("vertices", "cells"):
            for more in (["--superlevel"], ["--representatives", "cycles"], ["--periodic", "all"]):
                yield Command([*cubical, "--construction", construction, *more], voxels)
        yield Command([VECTORISE, "a.npy", "--kind", "euler"], voxels)
    diagrams = {}
    for name in ("one.csv", "two.csv"):
        bars = [(rng.randrange(3), birth, birth + rng.expovariate(3)) for birth in
                (rng.gauss(0, 1) for _ in range(150))]
        diagrams[name] = b"dim,birth,death\n" + rows(bars)
    for kind in ("statistics", "betti", "landscape", "silhouette", "image", "entropy", "life-entropy", "atol"):
        yield Command([VECTORISE, *diagrams, "--kind", kind], diagrams,
                      of_library=kind not in ("betti", "landscape"))
    yield Command([DISTANCE, *diagrams, "--matching", "out.csv"], diagrams)
    for order in ("1", "2", "2.5"):
        for ground in ("inf", "2", "3"):
            yield Command([DISTANCE, *diagrams, "--distance", "wasserstein", "--order", order, "--ground", ground,
                           "-o", "out.json"], diagrams, of_library=True)
    yield Command([DISTANCE, *diagrams, "--distance", "sliced", "-o", "out.json"], diagrams, of_library=True)
    yield Command([DISTANCE, *diagrams, "--distance", "wasserstein", "--error", "0.1", "-o", "out.json"], diagrams)


def commands():
    for words in of_examples():
        yield words if isinstance(words, Command) else Command(words)
    yield from of_samples()
    yield from of_random_inputs(40)
    yield from of_rounded_values()
