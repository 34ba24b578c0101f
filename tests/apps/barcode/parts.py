# SPDX-License-Identifier: MIT
"""Parts computed by separate processes: compares the result of --join with the result of one
process."""
import csv
import gzip
import io
import json
import os
import random
import re
import sys
import time
import zipfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import SQUARE, ProgramTest, files, main  # noqa: E402


class PartsTest(ProgramTest):
    OPTIONS = ()  # options given for all parts

    def written(self, name):
        """What changes if a file is written anew: the file system may use an inode again."""
        status = os.stat(self.path(name))
        return status.st_ino, status.st_mtime_ns

    def parts(self, data, count, *options, prefix="p"):
        names = [f"{prefix}{i}.ph" for i in range(1, count + 1)]
        for i, name in enumerate(names, 1):
            self.expect(0, data, *self.OPTIONS, "--part", f"{i}/{count}", "-o", name, "--quiet", *options)
        return names

    def refused(self, names, words, output="bars.csv"):
        """Checks that joining these parts is refused. @param words a regular expression for the
        message"""
        run = self.expect(65, "--join", *names, "-o", output, "--quiet")
        self.assertRegex(run.stderr, words)
        self.assertNotIn(output, self.files())


class Parts(PartsTest):
    def image(self, rng, name, shape):
        count = 1
        for n in shape:
            count *= n
        if rng.random() < 0.5:
            return self.write(name, files.array(shape, [rng.randrange(6) for _ in range(count)], "|u1"))
        inf = float("inf")
        values = [rng.choice((inf, -inf, 1.5, 0.25, rng.random())) for _ in range(count)]
        return self.write(name, files.array(shape, values, "<f4"))

    def join(self, rng, names):
        """Joins random groups of neighbouring parts until few parts are left. @return the remaining
        parts in random order."""
        names = list(names)
        while len(names) > 1 and rng.random() < 0.6:
            i = rng.randrange(len(names) - 1)
            size = rng.randint(2, len(names) - i)
            group = names[i:i + size]
            rng.shuffle(group)
            together = f"{group[0]}-{len(names)}.ph"
            self.expect(0, "--join", *group, "-o", together, "--quiet")
            names[i:i + size] = [together]
        rng.shuffle(names)
        return names

    def test_the_same_bytes_as_one_process(self):
        rng = random.Random(1)
        bars = 0
        for trial in range(36):
            dim = rng.choice((2, 2, 3, 4))
            shape = tuple(rng.randint(2, 7 if dim < 4 else 4) for _ in range(dim))
            image = self.image(rng, "image.npy", shape)
            options = ["--construction", rng.choice(("vertices", "cells"))]
            if rng.random() < 0.3:
                options.append("--superlevel")
            if rng.random() < 0.4:
                options += ["--periodic", rng.choice(("0", "all", str(dim - 1)))]
            if rng.random() < 0.3:
                options += ["--threshold", "2"]
            if dim > 2:
                is_closed = "--periodic" in options
                pieces = is_closed or rng.random() < 0.5
                options += ["--max-dim", "0"] if pieces else ["--min-dim", str(dim - 1)]
            whole = self.expect(0, image, "--quiet", *options).stdout
            bars += whole.count("\n") - 1
            joined = self.join(rng, self.parts(image, rng.randint(1, shape[0]), *options))
            self.assertEqual(self.expect(0, "--join", *joined, "--quiet").stdout, whole,
                             (shape, options))
        self.assertGreater(bars, 100)

    def test_cells_and_lengths(self):
        rng = random.Random(2)
        image = self.image(rng, "image.npy", (9, 8))
        names = self.parts(image, 3, "--keep-cells")
        self.expect(0, image, "-o", "whole.json", "--quiet")
        self.expect(0, "--join", *names, "-o", "joined.json", "--quiet")
        whole, joined = json.loads(self.read("whole.json")), json.loads(self.read("joined.json"))
        self.assertGreater(len(whole["bars"]), 5)
        for key in ("bars", "complex", "max_dim", "field", "format", "version", "threshold"):
            self.assertEqual(whole.get(key), joined.get(key), key)
        self.assertEqual(joined["input"]["path"], " ".join(names))
        long = ("--min-persistence", "1", "--quiet")
        self.assertEqual(self.expect(0, image, *long).stdout,
                         self.expect(0, "--join", *names, *long).stdout)
        plain = self.parts(image, 3, prefix="q")
        self.assertIn("--keep-cells", self.expect(64, "--join", *plain, "-o", "x.json").stderr)
        self.assertFalse(os.path.exists(self.path("x.json")))

    def test_a_part_is_the_same_bytes_whoever_computes_it(self):
        rng = random.Random(3)
        image = self.image(rng, "image.npy", (12, 9, 8))
        first = self.parts(image, 2, "--max-dim", "0", "--threads", "1")
        second = self.parts(image, 2, "--max-dim", "0", "--slab-layers", "2", "--threads", "2",
                            "--memory-limit", "64MiB", prefix="q")
        for a, b in zip(first, second):
            self.assertEqual(self.read_bytes(a), self.read_bytes(b))

    def test_what_does_not_belong_together_is_refused(self):
        rng = random.Random(4)
        image = self.image(rng, "image.npy", (8, 7))
        other = self.image(rng, "other.npy", (8, 7))
        p = self.parts(image, 4)
        refused = {
            "missing": (p[:3], "parts 1 to 3 of 4"),
            "a gap": ([p[0], p[2], p[3]], "part 3 after part 1"),
            "twice": ([*p, p[1]], "each part once"),
            "another image": ([p[0], self.parts(other, 4, prefix="o")[1], *p[2:]], "o2.ph"),
            "other options": ([p[0], self.parts(image, 4, "--superlevel", prefix="s")[1], *p[2:]],
                              "options"),
            "other parts": ([p[0], *self.parts(image, 2, prefix="t")], "differ in extents"),
            "no part": ([*p, "image.npy"], "begin with \"ph part\""),
        }
        for what, (names, word) in refused.items():
            with self.subTest(what):
                self.refused(names, word)
        self.assertIn("no such", self.expect(66, "--join", p[0], "none.ph").stderr.lower())
        self.assertIn("--join", self.expect(65, p[0]).stderr)

    def test_damage_is_found_wherever_it_is(self):
        rng = random.Random(5)
        image = self.image(rng, "image.npy", (4, 3))
        p = self.parts(image, 2)
        whole = self.read_bytes(p[0])
        places = sorted(rng.sample(range(len(whole)), 40)) + [len(whole) - 1]
        for at in places:
            broken = bytearray(whole)
            broken[at] ^= 1 << rng.randrange(8)
            self.write("broken.ph", bytes(broken))
            self.expect(65, "--join", "broken.ph", p[1], "--quiet")
        for size in [0, 1, 8, 27, 31, *rng.sample(range(len(whole)), 20)]:
            self.write("short.ph", whole[:size])
            self.expect(65, "--join", "short.ph", p[1], "--quiet")
        self.write("long.ph", whole + b"\0")
        self.expect(65, "--join", "long.ph", p[1], "--quiet")

    def test_resume_takes_what_is_there(self):
        rng = random.Random(6)
        image = self.write("image.npy", files.array((6, 5), [rng.randrange(200) for _ in range(30)], "|u1"))
        old = time.time() - 1000
        os.utime(self.path(image), (old, old))
        part = self.path("p.ph")

        def resume(*options):
            before = self.written("p.ph") if os.path.exists(part) else None
            said = self.expect(0, image, "--part", "1/2", "-o", "p.ph", "--resume", *options).stderr
            return self.written("p.ph") != before, said
        self.assertTrue(resume()[0])
        is_new, said = resume()
        self.assertFalse(is_new)
        self.assertIn("already exists", said)
        self.assertTrue(resume("--superlevel")[0])
        is_new, said = resume()
        self.assertTrue(is_new)
        self.assertIn("is not the requested part", said)
        with open(part, "rb") as file:
            whole = file.read()
        self.write("p.ph", whole[:-1] + bytes([whole[-1] ^ 1]))
        is_new, said = resume()
        self.assertTrue(is_new)
        self.assertIn("checksum", said)
        with open(part, "rb") as file:
            self.assertEqual(file.read(), whole)
        # The content of the image decides, not its age.
        os.utime(part, (old - 10, old - 10))
        self.assertFalse(resume()[0])
        kept = self.read_bytes("image.npy")
        for voxel, is_read in ((0, True), (3 * 5, True), (5 * 5, False)):
            other = bytearray(kept)
            other[len(other) - 30 + voxel] ^= 1
            self.write("image.npy", bytes(other))
            os.utime(self.path("image.npy"), (old - 20, old - 20))
            is_new, said = resume()
            self.assertEqual(is_new, is_read, voxel)
            self.assertIn("is not the requested part" if is_read else "already exists", said)
            self.assertEqual(self.read_bytes("p.ph"), self.part_anew(image))
            self.write("image.npy", kept)
            resume()

    def part_anew(self, image):
        self.expect(0, image, "--part", "1/2", "-o", "anew.ph", "--quiet")
        return self.read_bytes("anew.ph")

    def test_options_have_a_place(self):
        rng = random.Random(7)
        image = self.image(rng, "image.npy", (6, 5))
        volume = self.image(rng, "volume.npy", (6, 5, 4))
        series = self.image(rng, "series.npy", (3, 3, 2, 2))
        p = self.parts(image, 2)
        for arguments, word in (
                ((image, "--part", "0/2"), "from 1 to 2"), ((image, "--part", "3/2"), "from 1 to 2"),
                ((image, "--part", "2"), "1/8"), ((image, "--part", "1/7"), "expected 1 to 6"),
                ((volume, "--part", "1/2"), "dimension 0 alone, or 2 alone"),
                ((series, "--part", "1/2"), "dimension 0 alone, or 3 alone"), ((image, "--resume"), "--part"),
                ((image, "--keep-cells"), "--part"), ((image, "--part", "1/2", "--join"), "together with"),
                (("square.txt", "--part", "1/2"), "expected an image"),
                ((image, "--part", "1/2", "--field", "3"), "--field"),
                ((image, "--part", "1/2", "--output-format", "json"), "--output-format"),
                ((image, "--part", "1/2", "-o", image), "is an input"),
                (("--join", *p, "-o", p[0]), "is an input"),
                (("--join", *p, "--max-dim", "0"), "--max-dim"),
                (("--join", *p, "--resume"), "--resume"), (("--join", *p, "--report", "x.html"), "plot")):
            with self.subTest(" ".join(arguments)):
                self.assertIn(word, self.expect(64, *arguments).stderr)
        self.expect(0, "--join", *p, "--plot", "x.svg", "--plot-kind", "diagram", "-o", "y.csv")
        self.assertIn("<svg", self.read("x.svg"))
        self.expect(0, image, "--part", "2/2", "-o", "folder/", "--quiet")
        self.assertEqual(os.listdir(self.path("folder")), ["image.2of2.ph"])


    def test_resume_notices_a_data_file_and_a_slice(self):
        header, data = files.two_files((3, 2, 2), [7, 5, 2, 4, 9, 1, 3, 8, 6, 0, 2, 2], "v.raw")
        self.write("v.mhd", header)
        self.write("v.raw", data)
        os.mkdir(self.path("s"))
        for k in range(2):
            self.write(f"s/{k}.pgm", b"P5 3 2 255\n" + data[6 * k:6 * k + 6])
        for arguments, changed in ((("v.mhd",), "v.raw"), (("--stack", "s"), "s/1.pgm")):
            with self.subTest(arguments=arguments):
                again = (*arguments, "--max-dim", "0", "--part", "1/1", "-o", "p.ph", "--resume")
                self.expect(0, *again)
                self.assertIn("already exists", self.expect(0, *again).stderr)
                self.write(changed, self.read_bytes(changed)[:-1] + b"\x63")
                os.utime(self.path(changed), (1, 1))
                self.assertIn("is not the requested part", self.expect(0, *again).stderr)


class Clouds(PartsTest):
    OPTIONS = ("--complex", "rips", "--max-dim", "0")

    def cloud(self, rng, name, count, dim):
        ties = rng.random() < 0.5
        rows = [[rng.randrange(4) if ties else rng.random() for _ in range(dim)] for _ in range(count)]
        return self.write(name, "".join(",".join(map(repr, row)) + "\n" for row in rows))

    def test_the_same_bytes_as_one_process(self):
        rng = random.Random(11)
        for trial in range(12):
            cloud = self.cloud(rng, "cloud.csv", rng.randint(1, 60), rng.randint(1, 3))
            options = ["--threshold", "0.4"] if rng.random() < 0.3 else []
            whole = self.expect(0, cloud, *self.OPTIONS, "--quiet", *options).stdout
            names = self.parts(cloud, rng.randint(1, 6), *options)
            rng.shuffle(names)
            if len(names) > 2:
                self.expect(0, "--join", *names[:2], "-o", "two.ph", "--quiet")
                names[:2] = ["two.ph"]
            self.assertEqual(self.expect(0, "--join", *names, "--quiet").stdout, whole)
        self.expect(0, cloud, *self.OPTIONS, "-o", "whole.json", "--quiet", *options)
        self.expect(0, "--join", *names, "-o", "joined.json", "--quiet")
        whole, joined = json.loads(self.read("whole.json")), json.loads(self.read("joined.json"))
        for key in ("complex", "max_dim", "field", "format", "version"):
            self.assertEqual(whole[key], joined[key], key)
        self.assertEqual([(bar["birth"], bar["death"]) for bar in whole["bars"]],
                         [(bar["birth"], bar["death"]) for bar in joined["bars"]])

    def test_what_a_part_takes_is_foreseen(self):
        cloud = self.cloud(random.Random(13), "cloud.csv", 3000, 3)
        said = self.expect(0, cloud, *self.OPTIONS, "--part", "1/4", "--dry-run", "--quiet").stdout
        self.assertFalse(os.path.exists(self.path("cloud.1of4.ph")))
        lines = dict(line.split(None, 1) for line in said.splitlines())
        self.assertEqual(list(lines), ["input", "parts", "memory", "file", "join"])
        found = re.match(r"([\d.]+) (KiB|MiB) to ([\d.]+) (KiB|MiB)", lines["file"])
        low, high = (float(n) * {"KiB": 2**10, "MiB": 2**20}[unit] for n, unit in (found.group(1, 2), found.group(3, 4)))
        for name in self.parts(cloud, 4):
            size = os.path.getsize(self.path(name))
            self.assertTrue(low <= size <= high, f"{name}: {size} bytes, foreseen {lines['file']}")

    def test_refusals_and_resume(self):
        rng = random.Random(12)
        cloud, other = (self.cloud(rng, name, 40, 2) for name in ("cloud.csv", "other.csv"))
        p = self.parts(cloud, 3)
        o = self.parts(other, 3, prefix="o")
        for names, word in ((p[:2], "missing: part 3"), ([p[0], p[0], p[2]], "twice"),
                            ([p[0], o[1], p[2]], "differ in points"),
                            ([*p, "cloud.csv"], 'begin with "ph part"')):
            self.refused(names, word)
        for options, word in ((("--complex", "rips"), "--max-dim 0"),
                              ((*self.OPTIONS, "--metric", "manhattan"), "euclidean"),
                              ((*self.OPTIONS, "--superlevel"), "--superlevel")):
            self.assertIn(word, self.expect(64, cloud, "--part", "1/2", *options).stderr)
        again = (cloud, *self.OPTIONS, "--part", "1/3", "-o", p[0], "--resume")
        old = time.time() - 1000
        os.utime(self.path(cloud), (old, old))
        self.assertIn("already exists", self.expect(0, *again).stderr)
        self.assertIn("is not the requested part", self.expect(0, *again, "--threshold", "3").stderr)
        self.expect(0, *again[:-1], "--quiet")
        kept = self.read(cloud)
        # Replaces the cloud with another one that has the same number of points and is older than
        # the part.
        self.write(cloud, self.read(other))
        os.utime(self.path(cloud), (old, old))
        self.assertIn("is not the requested part", self.expect(0, *again).stderr)
        self.write(cloud, kept)
        os.utime(self.path(cloud), (old, old))
        self.write(p[0], b"ph part\n")
        self.assertIn("computed again", self.expect(0, *again).stderr)


class Batches(PartsTest):
    def setUp(self):
        super().setUp()
        rng = random.Random(8)
        os.mkdir(self.path("in"))
        for k in range(7):
            self.write(f"in/{k}.csv", "".join(f"{rng.random()!r},{rng.random()!r}\n" for _ in range(9)))
        self.write("in/a,b.txt", SQUARE)

    def parts(self, count, *options, code=0, prefix="p"):
        names = [f"{prefix}{i}.ph" for i in range(1, count + 1)]
        codes = {self.run_program("in", "--part", f"{i}/{count}", "-o", name, "--quiet", *options)
                 .returncode for i, name in enumerate(names, 1)}
        self.assertEqual(codes, {0, code})
        return names

    def test_one_table_of_all(self):
        expected = [("input", "dim", "birth", "death")]
        for name in sorted(os.listdir(self.path("in"))):
            lines = self.expect(0, f"in/{name}", "--quiet", "--max-dim", "1").stdout.splitlines()[1:]
            expected += [(f"in/{name}", *line.split(",")) for line in lines]
        for count in (1, 2, 3, 8, 11):
            names = self.parts(count, "--max-dim", "1")
            random.Random(count).shuffle(names)
            if count > 2:
                self.expect(0, "--join", *names[:2], "-o", "some.ph", "--quiet")
                names[:2] = ["some.ph"]
            table = self.expect(0, "--join", *names, "--quiet").stdout
            self.assertEqual([tuple(row) for row in csv.reader(io.StringIO(table))], expected)

    def test_what_fails_is_named_and_does_not_stop_the_others(self):
        self.write("in/bad.csv", "1,2\n3,x\n")
        names = self.parts(2, code=65)
        run = self.run_program("--join", *names, "-o", "table.csv")
        self.assertEqual(run.returncode, 65)
        self.assertIn("in/bad.csv:2:3", run.stderr)
        self.assertIn("9 inputs, 1 of them failed", run.stderr)
        inputs = {row["input"] for row in csv.DictReader(io.StringIO(self.read("table.csv")))}
        self.assertEqual(len(inputs), 8)
        self.assertNotIn("in/bad.csv", inputs)

    def test_what_does_not_belong_together_is_refused(self):
        p = self.parts(3)
        for names, word in ((p[:2], "missing: 3"), ([*p, p[0]], "found part 1 of 3 twice"),
                            ([p[0], self.parts(3, "--max-dim", "0", prefix="q")[1], p[2]], "options")):
            self.refused(names, word, output="table.csv")
        self.assertIn("--plot", self.expect(64, "in", "--part", "1/3", "--plot", "x.svg").stderr)
        self.assertIn("csv", self.expect(64, "--join", *p, "-o", "x.json").stderr)
        self.write("in/z.csv", "dim,birth,death\n0,0,1\n")
        self.assertEqual(self.run_program("in", "--part", "3/3", "-o", "z.ph", "--quiet").returncode, 65)

    def test_resume(self):
        name, = self.parts(1)
        before = self.written(name)
        run = self.expect(0, "in", "--part", "1/1", "-o", name, "--resume")
        self.assertIn("already exists", run.stderr)
        self.assertEqual(self.written(name), before)
        # The content of the inputs decides, not their age.
        kept, old = self.read("in/3.csv"), time.time() - 1000
        os.utime(self.path(name), (old, old))
        self.assertIn("already exists", self.expect(0, "in", "--part", "1/1", "-o", name, "--resume").stderr)
        self.write("in/3.csv", kept.replace("1", "2", 1))
        os.utime(self.path("in/3.csv"), (old - 10, old - 10))
        said = self.expect(0, "in", "--part", "1/1", "-o", name, "--resume").stderr
        self.assertIn("has bars of other data than in/3.csv has now; it is computed again", said)
        self.write("in/new.csv", SQUARE.replace(" ", ","))
        said = self.expect(0, "in", "--part", "1/1", "-o", name, "--resume").stderr
        self.assertIn("is not the requested part", said)
        self.assertNotEqual(self.written(name), before)

    def test_resume_compares_the_files_of_options(self):
        self.write("mesh.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        self.write("square.off", "OFF\n3 1 0\n0 0 0\n2 0 0\n0 2 0\n3 0 1 2\n")
        self.write("values.txt", "0\n1\n2\n")
        again = ("mesh.off", "square.off", "--values", "values.txt", "--part", "1/1", "-o", "m.ph",
                 "--resume")
        self.expect(0, *again)
        self.assertIn("already exists", self.expect(0, *again).stderr)
        self.write("values.txt", "0\n1\n3\n")
        os.utime(self.path("values.txt"), (1, 1))
        self.assertIn("has bars of other data than mesh.off has now", self.expect(0, *again).stderr)

    def test_resume_finds_the_file_of_a_member(self):
        for name in ("a.npz", "b.npz"):
            with zipfile.ZipFile(self.path(name), "w") as archive:
                archive.writestr("p.npy", files.array((4, 2), [0, 0, 1, 0, 1, 1, 0, 1], "<f8"))
                archive.writestr("q.npy", files.array((2, 2), [0, 0, 3, 0], "<f8"))
        again = ("a.npz:p", "b.npz:p", "--part", "1/1", "-o", "m.ph", "--resume")
        self.expect(0, *again)
        self.assertIn("already exists", self.expect(0, *again).stderr)
        with zipfile.ZipFile(self.path("b.npz"), "w") as archive:
            archive.writestr("p.npy", files.array((4, 2), [0, 0, 2, 0, 2, 2, 0, 2], "<f8"))
        self.assertIn("has bars of other data than b.npz:p has now", self.expect(0, *again).stderr)

    def test_resume_notices_a_data_file(self):
        nrrd = b"NRRD0004\ntype: uint8\ndimension: 2\nsizes: 3 2\nencoding: raw\ndata file: n.raw\n"
        self.write("n.nhdr.gz", gzip.compress(nrrd))
        self.write("n.raw", bytes([1, 2, 3, 4, 9, 6]))
        header, data = files.two_files((3, 2), [0, 5, 2, 4, 9, 1], "v.raw")
        self.write("v.mhd", header)
        self.write("v.raw", data)
        again = ("v.mhd", "n.nhdr.gz", "--part", "1/1", "-o", "m.ph", "--resume")
        self.expect(0, *again)
        self.assertIn("already exists", self.expect(0, *again).stderr)
        for name, changed in (("v.mhd", "v.raw"), ("n.nhdr.gz", "n.raw")):
            self.write(changed, self.read_bytes(changed)[:-1] + b"\7")
            self.assertIn(f"has bars of other data than {name} has now", self.expect(0, *again).stderr)


if __name__ == "__main__":
    main()
