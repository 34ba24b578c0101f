# SPDX-License-Identifier: MIT
"""complexity.py PH_BARCODE PH_SEGMENT PH_DISTANCE PH_VECTORISE PH_CLUSTER [full] [WORDS…]: runs
attacks, which are inputs designed to make a run slow. Each attack has the sizes n, 2n and 4n. The CPU time must
not grow faster than the complexity class of the attack allows. Some attacks whose time may grow
quadratically or faster must also reach a memory limit, or --dry-run must predict their memory.
`full` selects larger sizes, and WORDS the attacks whose names contain the words."""
import dataclasses
import gzip
import math
import os
import random
import resource
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "entries"))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "samples"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import part_files  # noqa: E402

SLACK = 2         # times on a busy machine are not exact
SMALLEST = 0.03   # seconds: in a shorter run, starting the program takes most of the time
UNHEARD = 0.3     # seconds: a shorter run never counts as too slow
TRIES = 3
LARGER = 4        # `full` multiplies the sizes by this factor
SECONDS = 120


@dataclasses.dataclass(frozen=True)
class Attack:
    name: str
    make: object        # make(n) returns a map from file names to contents
    arguments: tuple    # the first one names the program, without "ph-"
    size: int           # n
    power: float = 1.2  # time must not grow faster than n to this power; 1.2 covers n log n
    codes: tuple = (0,)
    stop: int = 0       # at this multiple of n, a limit of 64 MiB must be reached
    foresee: bool = False  # --dry-run must predict much more memory for 16 n than for n


def text(rows):
    return "".join(" ".join(map(repr, row)) + "\n" for row in rows).encode()


def points(function):
    return lambda n: {"p.txt": text(function(n))}


def skew_lines(n):
    """Points on two skew lines: each edge of one line and each edge of the other span a
    tetrahedron, n^2 / 4 in total."""
    half = n // 2
    return [(i / half, 0., 0.) for i in range(half)] + [(.5, i / half - .5, 1.) for i in range(half)]


def moment_curve(n):
    return [(i / n, (i / n)**2, (i / n)**3) for i in range(n)]


def sphere(n):
    seed = random.Random(1)
    found = []
    for _ in range(n):
        v = [seed.gauss(0, 1) for _ in range(3)]
        length = math.sqrt(sum(x * x for x in v))
        found.append([x / length for x in v])
    return found


def circle(n):
    return [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), 0.) for i in range(n)]


def equal(n):
    return [(1., 2., 3.)] * n


def line(n):
    return [(i * 1.5, i * 1.5, i * 1.5) for i in range(n)]


def two_far(n):
    seed = random.Random(2)
    return [(seed.random() * 1e-6 + (1e9 if i % 2 else 0.), seed.random(), seed.random()) for i in range(n)]


def tiny_cluster(n):
    """Points so close to each other that the third powers of their distances underflow, and one
    point far away."""
    seed = random.Random(3)
    return [[seed.random() * 1e-150 for _ in range(3)] for _ in range(n)] + [(1., 1., 1.)]


def doubling(n):
    """Rows of 1000 points, in each of which the x coordinate doubles from one point to the next."""
    return [(math.ldexp(1., i % 1000 - 500), float(i // 1000)) for i in range(n)]


def cubes(n):
    side = max(2, round(n**(1 / 3)))
    return [(float(i), float(j), float(k)) for i in range(side) for j in range(side) for k in range(side)]


def bars(*diagrams):
    return {f"{'ab'[i]}.csv": ("dim,birth,death\n" + "".join(f"0,{b!r},{d!r}\n" for b, d in rows)).encode()
            for i, rows in enumerate(diagrams)}


def lattice(n):
    side = max(1, round(n**.5))
    return bars([(float(i), float(i + j + 1)) for i in range(side) for j in range(side)],
                [(i + .5, i + j + 1.5) for i in range(side) for j in range(side)])


def raw(shape, value):
    """A raw image with n voxels of one byte."""
    def make(n):
        return {"i.raw": bytes(value(i) for i in range(n))}
    return make, shape


def star(n):
    return {"s.txt": b"".join(b"0 %d 1\n" % i for i in range(1, n))}


def two_hubs(n):
    return {"s.txt": b"0 1 1\n" + b"".join(b"0 %d 1\n1 %d 1\n" % (i, i) for i in range(2, n))}


def full_simplex(n):
    """All faces of a simplex that has about n faces."""
    count = max(2, n.bit_length() - 1)
    rows = sorted((bin(mask).count("1"), mask) for mask in range(1, 1 << count))
    return {"f.simplices": "".join(
        " ".join(str(v) for v in range(count) if mask >> v & 1) + f" : {size}\n"
        for size, mask in rows).encode()}


ALPHA = ("barcode", "--complex", "alpha", "p.txt")
H0 = ("barcode", "--max-dim", "0", "p.txt")
CLUSTERS = ("cluster", "--scores", "--tree", "t.json", "p.txt")
DTM = ("barcode", "--dtm", "3", "--max-dim", "0", "p.txt")
WASSERSTEIN = ("distance", "--distance", "wasserstein", "a.csv", "b.csv")
BOTTLENECK = ("distance", "a.csv", "b.csv")
JSON = b'{"format": "ph-barcode", "version": 1, "bars": []'


def images():
    for name, shape in (("one voxel wide", "{n}"), ("one voxel wide, in the plane", "1,{n}"),
                        ("one voxel wide, in space", "1,{n},1"), ("of one row, closed up", "{n},1,1")):
        yield Attack(f"image: {name}", lambda n: {"i.raw": bytes((i * 97 + i // 7) % 251 for i in range(n))},
                     ("barcode", "i.raw", "--raw-shape", shape,
                      *(("--periodic", "all") if "closed" in name else ())), 50_000)
    for name, value in (("all equal", lambda i: 7), ("a chessboard", lambda i: (i + i // 256) % 2),
                        ("stripes", lambda i: i // 256 % 2), ("a slope", lambda i: i // 256 % 251)):
        yield Attack(f"image: {name}", lambda n, value=value: {"i.raw": bytes(map(value, range(n // 256 * 256)))},
                     ("barcode", "i.raw", "--raw-shape", "{rows},256"), 1 << 16)


def texts():
    for name, content in (("one token of digits", lambda n: b"1 2\n" + b"9" * n + b" 1\n"),
                          ("one token of zeros", lambda n: b"1 2\n0." + b"0" * n + b"1 1\n"),
                          ("one long exponent", lambda n: b"1 2\n1e" + b"0" * n + b" 1\n"),
                          ("one long word", lambda n: b"x" * n + b"\n1 2\n"),
                          ("commas", lambda n: b"," * (n // 4) + b"1\n"),
                          ("quotes", lambda n: b'"' * n + b"\n1 2\n"),
                          ("blanks", lambda n: b" " * n + b"1 2\n3 4\n"),
                          ("line ends", lambda n: b"\n" * (n // 4) + b"1 2\n3 4\n"),
                          ("one comment", lambda n: b"#" * n + b"\n1 2\n3 4\n"),
                          ("comments", lambda n: b"#\n" * (n // 4) + b"1 2\n3 4\n")):
        yield Attack(f"text: {name}", lambda n, content=content: {"t.txt": content(n)}, ("barcode", "t.txt"),
                     1 << 20, codes=(0, 65))
    for name, content in (("nested lists", lambda n: JSON + b', "x": ' + b"[" * n),
                          ("one long string", lambda n: JSON + b', "x": "' + b"\\u0041" * (n // 6) + b'"}'),
                          ("one long number", lambda n: JSON + b', "x": ' + b"1" * n + b"}"),
                          ("one long name", lambda n: JSON + b', "' + b"x" * n + b'": 1}'),
                          ("many names", lambda n: JSON + b"".join(b', "x%d": 1' % i for i in range(n // 16)) + b"}"),
                          ("blanks", lambda n: JSON + b" " * n + b"}")):
        yield Attack(f"JSON: {name}", lambda n, content=content: {"a.json": content(n), "b.csv": b"dim,birth,death\n"},
                     ("distance", "a.json", "b.csv"), 1 << 20, codes=(0, 65))
    yield Attack("gzip: zeros", lambda n: {"z.txt.gz": gzip.compress(b"0 " * (n // 2) + b"\n", 9)},
                 ("barcode", "z.txt.gz", "--max-dim", "0"), 1 << 20, codes=(0, 65))
    yield Attack("OFF: one face of all", lambda n: {"f.off": b"OFF\n%d 1 0\n" % n + b"0 0 0\n" * n + b"%d " % n
                 + b" ".join(b"%d" % i for i in range(n)) + b"\n"},
                 ("barcode", "f.off", "--complex", "lower-star"), 20_000, codes=(0, 64, 65, 75))
    yield Attack("PHAT: one column of all", lambda n: {"m.phat": b"0\n" * n + b"1 "
                 + b" ".join(b"%d" % i for i in range(n)) + b"\n"}, ("barcode", "m.phat"), 20_000, codes=(0, 65))


ATTACKS = [
    # The triangulation itself has about n² simplices and must be built. A memory limit stops the
    # run.
    Attack("alpha: two skew lines", points(skew_lines), ALPHA, 250, 2.2, stop=64),
    Attack("alpha: the moment curve", points(moment_curve), ALPHA, 250, 2.4, stop=64),
    Attack("alpha: points of a sphere", points(sphere), ALPHA, 1500),
    Attack("alpha: points of a circle", points(circle), ALPHA, 4000),
    Attack("alpha: all equal", points(equal), ALPHA, 20_000),
    Attack("alpha: a line", points(line), ALPHA, 10_000),
    Attack("alpha: a grid", points(cubes), ALPHA, 1000),
    Attack("alpha: two clusters that are far", points(two_far), ALPHA, 1000),
    Attack("alpha: a cluster of 1e-150", points(tiny_cluster), ALPHA, 1000, 1.4),
    Attack("alpha: distances that double", points(doubling), ALPHA, 1000, codes=(0, 65)),
    Attack("components: all equal", points(equal), H0, 20_000),
    Attack("components: a line", points(line), H0, 10_000),
    Attack("components: points of a circle", points(circle), H0, 5000),
    # After rounding, the distances from one cluster to the other have only 17 different values, and
    # each distance is examined.
    Attack("components: two clusters that are far", points(two_far), H0, 3000, 2.2),
    Attack("components: a cluster of 1e-150", points(tiny_cluster), H0, 5000),
    Attack("components: distances that double", points(doubling), H0, 5000),
    # Points that enter late are compared with all other points.
    Attack("births: all equal", points(equal), DTM, 2000, 2.2),
    Attack("births: a cluster of 1e-150", points(tiny_cluster), DTM, 2000, 2.2),
    Attack("births: two clusters that are far", points(two_far), DTM, 2000, 2.2),
    Attack("clusters: all equal", points(equal), CLUSTERS, 5000),
    Attack("clusters: a line", points(line), CLUSTERS, 5000),
    Attack("clusters: points of a circle", points(circle), CLUSTERS, 5000),
    Attack("clusters: two clusters that are far", points(two_far), CLUSTERS, 2000, 2.2),
    Attack("clusters: a cluster of 1e-150", points(tiny_cluster), CLUSTERS, 2000, 2.2),
    Attack("clusters: a star", star, ("cluster", "s.txt", "--format", "sparse", "--neighbours", "1"), 20_000),
    Attack("near pairs: a cluster of 1e-150", points(tiny_cluster), ("barcode", "p.txt", "--threshold", "1e-152"),
           17_000),
    Attack("loops: all equal", points(equal), ("barcode", "p.txt"), 20_000),
    Attack("loops: equal, with bars of length 0", points(equal), ("barcode", "p.txt", "--min-persistence=-1"),
           300, 2.5, stop=64, foresee=True),
    Attack("loops: points of a circle", points(circle), ("barcode", "p.txt"), 400, 2.2, foresee=True),
    Attack("graph: a star", star, ("barcode", "s.txt", "--format", "sparse", "--max-dim", "2"), 20_000),
    Attack("graph: two hubs", two_hubs, ("barcode", "s.txt", "--format", "sparse", "--max-dim", "2"), 5000),
    Attack("simplices: all faces of one", full_simplex, ("barcode", "f.simplices"), 1 << 13, 1.6),
    Attack("simplices: one of all vertices", lambda n: {"f.simplices": " ".join(map(str, range(n))).encode() + b" : 0\n"},
           ("barcode", "f.simplices"), 50_000, codes=(65,)),
    Attack("Wasserstein: a lattice", lattice, WASSERSTEIN, 2500, 2.2),
    Attack("Wasserstein: a ladder", lambda n: bars([(0., 100. + 2 * i) for i in range(n)],
                                                   [(0., 101. + 2 * i) for i in range(n)]), WASSERSTEIN, 2000, 2.2),
    Attack("Wasserstein: a ladder that doubles", lambda n: bars([(0., 2.**(i % 900)) for i in range(n)],
                                                                [(0., 1.3 * 2.**(i % 900)) for i in range(n)]),
           WASSERSTEIN, 1000, 2.2),
    Attack("Wasserstein: all bars equal", lambda n: bars([(0., 1.)] * n, [(0., 1.5)] * (n - 1)), WASSERSTEIN, 5000, 1.5),
    Attack("bottleneck: a lattice", lattice, BOTTLENECK, 2500, 1.6),
    Attack("bottleneck: a ladder", lambda n: bars([(float(i), i + 1. + 1e-3 * i) for i in range(n)],
                                                  [(i + .5, i + 1.6) for i in range(n)]), BOTTLENECK, 4000, 1.6),
    Attack("bottleneck: all bars equal", lambda n: bars([(0., 1.)] * n, [(0., 1.5)] * (n - 1)), BOTTLENECK, 10_000),
    Attack("landscape: nested bars", lambda n: bars([(float(i), 2. * n - i) for i in range(n)]),
           ("vectorise", "a.csv", "--kind", "landscape"), 5000, 1.4),
    Attack("picture: many bars", lambda n: bars([(float(i % 97), 100. + i) for i in range(n)]),
           ("barcode", "plot", "a.csv", "-o", "x.svg"), 20_000),
    Attack("parts: many tiny ones", lambda n: {f"{i}.ph": part_files.inputs(
        tuple(b"%d" % k for k in range(n)), i, n) for i in range(n)}, ("barcode", "--join", "{parts}"), 60, 2.2),
    Attack("batch: many tiny inputs", lambda n: {f"in{i}.txt": b"0 1\n1 0\n" for i in range(n)},
           ("barcode", "{inputs}", "-o", "out/"), 100),
    Attack("segments: all points equal", lambda n: {"c.xyz": b"0.1 0.2 1\n" * n}, ("segment", "c.xyz"), 20_000),
    Attack("segments: a line", lambda n: {"c.xyz": text((i * 1e-4, 0., 1.) for i in range(n))}, ("segment", "c.xyz"),
           5000),
    Attack("segments: a cluster and a far point", lambda n: {"c.xyz": text(
        (random.Random(i).random() * 1e-3, i * 1e-7, 1.) for i in range(n)) + b"1e6 1e6 1e6\n"},
        ("segment", "c.xyz"), 5000),
    *images(), *texts(),
]


class Programs:
    def __init__(self, paths):
        self.paths = {os.path.basename(path): os.path.abspath(path) for path in paths}

    def run(self, attack, n, *more):
        """@return exit code, CPU seconds, output."""
        with tempfile.TemporaryDirectory() as folder:
            files = attack.make(n)
            for name, content in files.items():
                with open(os.path.join(folder, name), "wb") as file:
                    file.write(content)
            program, *arguments = attack.arguments
            filled = []
            for argument in arguments:
                if argument in ("{parts}", "{inputs}"):
                    filled += sorted(files)
                else:
                    filled.append(argument.format(n=n, rows=n // 256))
            if "-o" not in filled and "--dry-run" not in more:
                filled += ["-o", "out.pcd" if program == "segment" else "out.csv"]
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            try:
                run = subprocess.run([self.paths["ph-" + program], *filled, "--threads", "1", "--quiet", *more],
                                     cwd=folder, capture_output=True, timeout=SECONDS, check=False)
            except subprocess.TimeoutExpired:
                return -1, math.inf, "it takes too long"
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            return run.returncode, seconds, (run.stdout + run.stderr).decode("utf-8", "replace")

    def faults(self, attack, larger):
        """@return what is wrong, and the seconds of each size."""
        n = attack.size * larger
        for attempt in range(TRIES):  # only a slow algorithm is slow every time
            seconds = []
            for size in (n, 2 * n, 4 * n):
                code, taken, said = self.run(attack, size)
                if code not in attack.codes:
                    return f"n = {size}: exit code {code}: {said[:300]}", seconds
                seconds.append(taken)
            most = max(UNHEARD, max(seconds[0], SMALLEST) * 4**attack.power * SLACK)
            if seconds[-1] <= most:
                break
        else:
            return (f"{seconds[-1]:.2f} s for n = {4 * n}, expected at most {most:.2f} s after "
                    f"{seconds[0]:.2f} s for {n}"), seconds
        return self.unbounded(attack, n // larger), seconds

    def unbounded(self, attack, n):
        """What is wrong with the limits or forecasts of an attack that grows fast; empty if nothing
        is."""
        if attack.foresee:
            foreseen = [foreseen_bytes(self.run(attack, size, "--dry-run")[2]) for size in (n, 16 * n)]
            if not 0 < 64 * foreseen[0] < foreseen[1]:
                return f"--dry-run foresees {foreseen[0]:.3g} and {foreseen[1]:.3g} bytes for n = {n} and {16 * n}"
        if attack.stop:
            code, seconds, said = self.run(attack, attack.stop * n, "--memory-limit", "64MiB")
            if code != 75 or seconds > 20:
                return (f"n = {attack.stop * n} within 64 MiB: exit code {code} after {seconds:.1f} s, "
                        f"expected 75: {said[:300]}")
        return ""


def foreseen_bytes(text_of_run):
    """The largest memory that --dry-run predicts; 0 if there is no prediction."""
    units = {"B": 1, "bytes": 1, "KiB": 2**10, "MiB": 2**20, "GiB": 2**30, "TiB": 2**40, "PiB": 2**50}
    for words in map(str.split, text_of_run.splitlines()):
        if words[:1] == ["memory"] and words[-1] in units:
            return float(words[-2]) * units[words[-1]]
    return 0.


def main():
    programs, words = Programs(sys.argv[1:6]), sys.argv[6:]
    larger = LARGER if "full" in words else 1
    words = [word for word in words if word != "full"]
    chosen = [attack for attack in ATTACKS if all(word in attack.name for word in words)]
    faults = 0
    for attack in chosen:
        fault, seconds = programs.faults(attack, larger)
        growth = math.log(max(seconds[-1], 1e-3) / max(seconds[0], 1e-3), 4) if len(seconds) == 3 else math.nan
        print(f"{attack.name:48} n = {attack.size * larger:8}  "
              + " ".join(f"{s:6.2f}" for s in seconds) + f" s   n^{growth:.1f} of n^{attack.power}"
              + (f"   FAULT: {fault}" if fault else ""), flush=True)
        faults += bool(fault)
    print(f"{len(chosen)} attacks, {faults} faults")
    sys.exit(1 if faults or not chosen else 0)


if __name__ == "__main__":
    main()
