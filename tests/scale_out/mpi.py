# SPDX-License-Identifier: MIT
"""mpi.py PH_BARCODE PH_BARCODE_MPI MPIRUN [KILLS [SEED]]: tests images and points on 1 to 8 ranks
of an MPI implementation.

The ranks write the same bytes as one process. If a rank is killed at a random time, all other ranks
end within seconds, and the output is complete or absent; the same command with --resume then makes
the same bytes. A job that cannot be computed is reported and ends all ranks."""
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from volume import volume  # noqa: E402

# Keeps standard error free of MPI's own messages, for example that /sys is not mounted.
ENV = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
       "HWLOC_HIDE_ERRORS": "2"}
EXAMPLES = pathlib.Path(__file__).parents[2] / "examples"
MOST_SECONDS = 5  # from the death of a rank to the end of all ranks


class Mpi:
    def __init__(self, barcode, program, mpirun, folder):
        self.barcode, self.program, self.mpirun, self.folder = barcode, program, mpirun, folder
        self.more = ["--oversubscribe"] if "openmpi" in mpirun else []

    def start(self, ranks, *arguments):
        return subprocess.Popen([self.mpirun, *self.more, "-n", str(ranks), self.program, *arguments],
                                cwd=self.folder, env=ENV, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def run(self, ranks, *arguments):
        # On a busy machine, MPICH's mpirun may die of a broken pipe to a program that ended
        # quickly.
        for _ in range(3):
            process = self.start(ranks, *arguments)
            out, err = process.communicate(timeout=120)
            if process.returncode != -signal.SIGPIPE:
                break
        return process.returncode, out, err

    def help(self, topic):
        """The help that the program prints without mpirun."""
        return subprocess.run([self.program, "--help", topic], check=True, capture_output=True, text=True,
                              timeout=60).stdout

    def ranks(self, output):
        """The processes of the program that have the output among their arguments."""
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            try:
                words = (entry / "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if words[0] == self.program.encode() and output.encode() in words:
                found.append(int(entry.name))
        return found


def check_bytes(mpi, one_process):
    tried = 0
    for extents, options in (
            ((24, 20, 16), ["--max-dim", "0"]), ((24, 20, 16), []),
            ((12, 10, 8), ["--construction", "cells", "--field", "3"]),
            ((8, 7, 6), ["--periodic", "all", "--max-dim", "3"]),
            ((24, 20, 16), ["--max-dim", "0", "--construction", "cells", "--superlevel"]),
            ((40, 30), ["--periodic", "0"]), ((40, 30), ["--construction", "cells", "--periodic", "all"]),
            ((8, 7, 6, 5), ["--max-dim", "0", "--periodic", "1"]),
            ((8, 7, 6, 5), ["--min-dim", "3", "--construction", "cells"]),
            ((5, 60), ["--threshold", "30"])):
        volume(mpi.folder / "image.npy", extents)
        expected = one_process("image.npy", *options)
        assert expected.count("\n") > 20
        for ranks in (range(1, 9) if not options else (2, 5, 8)):
            code, out, err = mpi.run(ranks, "image.npy", *options, "--quiet")
            assert (code, err) == (0, ""), (code, err)
            assert out == expected, f"{ranks} ranks: other bytes than one process"
            tried += 1
    return tried


def points(path, count, axes, seed=1):
    """Writes clusters of points, some of them duplicated, one point per line."""
    rng = random.Random(seed)
    rows = [[rng.choice((0, 0, 5)) + rng.gauss(0, 1) for _ in range(axes)] for _ in range(count)]
    rows += rows[:count // 10]
    path.write_text("".join(",".join(map(repr, row)) + "\n" for row in rows))


H0 = ["--complex", "rips", "--max-dim", "0"]


def check_clouds(mpi, one_process):
    tried = 0
    for count, axes, options in ((400, 3, []), (300, 2, ["--threshold", "0.4"]),
                                 (90, 8, ["--min-persistence", "0.5"]), (2, 2, []),
                                 (200, 3, ["--output-format", "npy"])):
        points(mpi.folder / "points.csv", count, axes)
        if "npy" in options:
            one_process("points.csv", *H0, *options, "-o", "one.npy")
            for ranks in (1, 3):
                code, _, err = mpi.run(ranks, "points.csv", *H0, *options, "-o", "ranks.npy", "--quiet")
                assert (code, err) == (0, ""), (code, err)
                assert (mpi.folder / "ranks.npy").read_bytes() == (mpi.folder / "one.npy").read_bytes()
                tried += 1
            continue
        expected = one_process("points.csv", *H0, *options)
        assert expected.count("\n") > 1
        for ranks in range(1, 5):
            code, out, err = mpi.run(ranks, "points.csv", *H0, *options, "--quiet")
            assert (code, err) == (0, ""), (code, err)
            assert out == expected, f"{ranks} ranks, {count} points: other bytes than one process"
            tried += 1
    # The JSON has cells, and states the number of ranks.
    code, out, err = mpi.run(3, "points.csv", *H0, "--output-format", "json", "--quiet")
    assert (code, err) == (0, ""), (code, err)
    ours, theirs = json.loads(out), json.loads(one_process("points.csv", *H0, "--output-format", "json"))
    assert ours.pop("input")["description"] == theirs.pop("input")["description"] + ", 3 ranks"
    differ = [name for name in {**ours, **theirs} if ours.get(name) != theirs.get(name)]
    assert set(differ) <= {"timings", "peak_memory"}, differ
    return tried + 1


def check_resumed_clouds(mpi, one_process):
    """A part that was kept is reused. A part that is damaged or belongs to other points is computed
    again."""
    points(mpi.folder / "points.csv", 300, 3)
    command = ["points.csv", *H0, "-o", "resumed.csv"]
    for part in (1, 2, 3):
        subprocess.run([mpi.barcode, "points.csv", *H0, "--part", f"{part}/3", "--quiet", "-o",
                        f"resumed.csv.{part}of3.ph"], cwd=mpi.folder, check=True)
    damaged = mpi.folder / "resumed.csv.2of3.ph"
    damaged.write_bytes(damaged.read_bytes()[:-1])
    code, _, err = mpi.run(3, *command, "--resume", "--verbose")
    assert code == 0, err
    assert err.count("already exists") == 2 and err.count("computed again") == 1, err
    assert (mpi.folder / "resumed.csv").read_text() == one_process("points.csv", *H0)
    assert not list(mpi.folder.glob("resumed.csv.*"))


def unequal(path):
    """Writes an image with noise in the last quarter of the layers and a single value elsewhere."""
    volume(path, (64, 24, 24))
    data = bytearray(path.read_bytes())
    voxels = 64 * 24 * 24
    data[-voxels:-voxels // 4] = bytes([40]) * (voxels * 3 // 4)
    path.write_bytes(bytes(data))


def check_sharing(mpi, one_process):
    """Ranks divide the layers according to their content, and report how. @return the number of
    runs that divided the layers unequally."""
    unequal(mpi.folder / "unequal.npy")
    tried = 0
    for options in ([], ["--construction", "cells", "--superlevel"], ["--periodic", "0"],
                    ["--max-dim", "0", "--resume", "-o", "shared.csv"]):
        resumes = "--resume" in options
        expected = one_process("unequal.npy", *options[:2 if resumes else None])
        for ranks in (4, 8) if resumes else (3, 4, 8):
            code, out, err = mpi.run(ranks, "unequal.npy", *options, "--verbose")
            assert code == 0, err
            found = (mpi.folder / "shared.csv").read_text() if resumes else out
            assert found == expected, f"{ranks} ranks of unequal layers: other bytes"
            said = re.search(r"begin with layers ([\d, ]+): .* would take ([\d.]+) times", err)
            assert said, err
            first = [int(layer) for layer in said[1].split(", ")]
            assert len(first) == ranks and first[0] == 0 and first[-1] < 64, first
            assert first[ranks // 2] > 40, first
            assert sorted(set(first)) == first and float(said[2]) >= 2, said[0]
            assert err.count("sent ") == ranks, err
            tried += 1
    # A uniform image is divided equally, without a message.
    volume(mpi.folder / "image.npy", (24, 20, 16))
    code, _, err = mpi.run(3, "image.npy", "--verbose")
    assert code == 0 and "begin with" not in err, err
    return tried


def check_forecasts(mpi):
    """--dry-run computes nothing, for any number of ranks. Progress lines name their rank."""
    volume(mpi.folder / "image.npy", (24, 20, 16))
    unequal(mpi.folder / "unequal.npy")
    for path, ranks, options, longest in (("image.npy", 3, [], "1.0"), ("image.npy", 30, [], ""),
                                          ("image.npy", 1, ["--max-dim", "0"], "1.0"),
                                          ("unequal.npy", 4, [], "")):
        code, out, err = mpi.run(ranks, path, *options, "-o", "none.csv", "--dry-run")
        assert code == 0, err
        assert not list(mpi.folder.glob("none.csv*"))
        lines = out.splitlines()
        parts = min(ranks, 24) if path == "image.npy" else ranks
        assert [line.split()[0] for line in lines] == ["input", "parts", "memory", "sent"], out
        assert lines[1].startswith(f"parts    {parts}, the longest takes {longest}"), out
        assert ("share layers by what is in them" in out) == (path == "unequal.npy"), out
        for line in lines[2:]:
            assert re.search(r" [0-9.]+ ([KMG]i)?B to [0-9.]+ ([KMG]i)?B \(", line), out
    # The run must be long enough for each rank to report, because at most ten lines are written per
    # second.
    volume(mpi.folder / "large.npy", (96, 96, 96))
    code, _, err = mpi.run(3, "large.npy", "-o", "progress.csv", "--progress", "json")
    assert code == 0, err
    lines = [json.loads(line) for line in err.splitlines() if line.startswith("{")]
    assert {line["rank"] for line in lines} == {0, 1, 2}, err
    assert all("stage" in line and "done" in line for line in lines), err
    for options, does_nothing in ([], True), (["--max-dim", "0"], False):
        code, _, err = mpi.run(2, "image.npy", *options, "-o", "slabs.csv", "--slab-layers", "3")
        assert code == 0 and ("--slab-layers does nothing" in err) == does_nothing, err


def check_help(mpi):
    """The help works without mpirun. It lists the options that ranks accept, and its examples
    work."""
    for topic in ("usual", "all", "man", "markdown"):
        text = mpi.help(topic)
        assert not re.search(r"--(representatives|report|join|keep-cells)\b", text), text
    text = mpi.help("usual")
    assert text.startswith("Usage: ph-barcode-mpi "), text
    examples = re.findall(r"(?m)^  mpirun -n (\d+) ph-barcode-mpi (.*)\n      \S", text)
    assert len(examples) == 5, text
    shutil.copytree(EXAMPLES, mpi.folder / "examples")
    for ranks, arguments in examples:
        code, _, err = mpi.run(int(ranks), *arguments.split())
        assert code == 0, (arguments, err)


def check_refusals(mpi):
    volume(mpi.folder / "image.npy", (24, 20, 16))
    volume(mpi.folder / "large.npy", (48, 96, 96))
    points(mpi.folder / "points.csv", 60, 3)
    points(mpi.folder / "wide.csv", 20, 9)
    points(mpi.folder / "many.csv", 20_000, 3)
    (mpi.folder / "far.csv").write_text("0,1\n1,0\n")
    (mpi.folder / "holes.csv").write_text("1,2\nnan,3\n4,5\n")
    for arguments, word, code in (
            (["image.npy", "--metric", "cosine"], "--metric", 64),
            (["none.npy", "--max-dim", "0"], "none.npy", 66), (["image.npy", "--part", "1/2"], "--part", 64),
            (["image.npy", "--max-dim", "0", "-o", "image.npy"], "is an input", 64),
            (["points.csv", "--complex", "rips"], "expected --max-dim 0", 64),
            (["points.csv", "--complex", "rips", "--max-dim", "1"], "expected --max-dim 0", 64),
            (["points.csv"], "points need --complex rips --max-dim 0", 64),
            (["points.csv", "--complex", "alpha", "--max-dim", "0"], "or rips with --max-dim 0", 64),
            (["points.csv", *H0, "--metric", "manhattan"], "expected euclidean", 64),
            (["points.csv", *H0, "--subsample", "9"], "--subsample", 64),
            (["points.csv", *H0, "--superlevel"], "--superlevel", 64),
            (["points.csv", "points.csv", *H0], "expected one image or cloud", 64),
            (["image.npy", *H0], "not a set of points", 65), (["wide.csv", *H0], "at most 8", 64),
            (["far.csv", "--format", "distance", *H0], "expected points", 64),
            (["holes.csv", *H0], "nan", 65), (["points.csv", *H0, "-o", "points.csv"], "is an input", 64),
            (["many.csv", *H0, "--memory-limit", "1MiB"], "memory", 75),
            (["large.npy", "--max-dim", "0", "--memory-limit", "1MiB"], "memory", 75)):
        found, _, err = mpi.run(3, *arguments)
        assert found == code and word in err, (arguments, found, err)


def check_kills(mpi, one_process, kills, seed):
    rng = random.Random(seed)
    volume(mpi.folder / "image.npy", (48, 96, 96))
    expected = one_process("image.npy", "--max-dim", "0")
    command = ["image.npy", "--max-dim", "0", "-o", "killed.csv", "--quiet"]
    output = mpi.folder / "killed.csv"
    start = time.monotonic()
    assert mpi.run(4, *command)[0] == 0
    usual = time.monotonic() - start
    killed, stuck, slowest = 0, 0, 0.0
    while killed < kills:
        output.unlink(missing_ok=True)
        process = mpi.start(4, *command, "--resume")
        time.sleep(rng.uniform(0, usual))
        ranks = mpi.ranks("killed.csv")
        if ranks:
            os.kill(rng.choice(ranks), signal.SIGKILL)
        start = time.monotonic()
        try:
            process.communicate(timeout=2 * MOST_SECONDS)
        except subprocess.TimeoutExpired:
            # In Open MPI 4.1.4, mpirun may hang if a rank dies during its start: in about one run
            # in a hundred, it waits for its own lock (PMIx) after all ranks have ended.
            assert "openmpi" in mpi.mpirun and not mpi.ranks("killed.csv"), "ranks hang"
            process.kill()
            process.communicate()
            stuck += 1
            start = time.monotonic()
        if process.returncode == 0:  # the run was complete, or had not begun
            assert output.read_text() == expected
            continue
        killed += 1
        slowest = max(slowest, time.monotonic() - start)
        assert slowest < MOST_SECONDS, f"all ranks took {slowest} s to end"
        until = time.monotonic() + MOST_SECONDS
        while mpi.ranks("killed.csv"):
            assert time.monotonic() < until, "a rank is left"
            time.sleep(0.02)
        assert not output.exists() or output.read_text() == expected, "half a file"
        code, _, err = mpi.run(4, *command, "--resume")
        assert code == 0, err
        assert output.read_text() == expected, "other bytes after --resume"
        left = [path.name for path in mpi.folder.glob("killed.csv.*")]
        assert not left, left
    if stuck:
        print(f"mpirun itself, not its ranks, had to be ended {stuck} times")
    return killed, slowest


def main():
    barcode, program, mpirun = sys.argv[1:4]
    kills = int(sys.argv[4]) if len(sys.argv) > 4 else 200
    seed = int(sys.argv[5]) if len(sys.argv) > 5 else 1
    with tempfile.TemporaryDirectory() as name:
        mpi = Mpi(*(str(pathlib.Path(path).resolve()) for path in (barcode, program)), mpirun,
                  pathlib.Path(name))

        def one_process(*arguments):
            return subprocess.run([mpi.barcode, *arguments, "--quiet"], cwd=name,
                                  check=True, capture_output=True, text=True).stdout
        tried = check_bytes(mpi, one_process) + check_clouds(mpi, one_process)
        tried += check_sharing(mpi, one_process)
        check_forecasts(mpi)
        check_resumed_clouds(mpi, one_process)
        check_help(mpi)
        check_refusals(mpi)
        killed, slowest = check_kills(mpi, one_process, kills, seed)
    print(f"{tried} runs with the bytes of one process; {killed} ranks killed, all others ended within "
          f"{slowest:.2f} s, and --resume made the same bytes")


if __name__ == "__main__":
    main()
