# SPDX-License-Identifier: MIT
"""folder.py PH_BARCODE [KILLS [SEED]]: processes that compute an image, or points, together and talk
through a folder.

The bytes are those of one process, and the folder is empty in the end. Whatever happens to one
process, killed, stopped or in error, ends the others with a code that is not 0, a message that names
the part, and no output. What another run left is refused. Runs at the same time do not mix."""
import json
import math
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from volume import volume  # noqa: E402

PATIENCE = 4  # seconds that a part may be silent, in this test
AT_ONCE = 10  # seconds until all have heard of a failure; two looks, and a busy machine
ENV = {**os.environ, "PH_TEST_PATIENCE": str(PATIENCE)}
H0 = ["--complex", "rips", "--max-dim", "0"]
IO, CANNOT_CREATE, USAGE, MEMORY, INTERRUPTED = 74, 73, 64, 75, 130


def smooth(path, extents):
    """Waves, of which there are few bars and long ones."""
    values = bytes(round(127 + 40 * (math.sin(0.9 * x) + math.cos(0.7 * y + 0.2 * x)
                                     + math.sin(0.5 * z + y / 3)))
                   for x in range(extents[0]) for y in range(extents[1]) for z in range(extents[2]))
    header = f"{{'descr': '|u1', 'fortran_order': False, 'shape': {extents!r}, }}".ljust(117) + "\n"
    path.write_bytes(b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header.encode() + values)


class Run:
    """The processes of a run. One may have other arguments: {part: arguments}."""

    def __init__(self, place, parts, *arguments, exchange="exchange", more=None, only=None):
        self.place, self.processes = place, {}
        for part in range(1, parts + 1) if only is None else only:
            self.start(part, parts, arguments, exchange, (more or {}).get(part, ()))

    def start(self, part, parts, arguments, exchange="exchange", more=()):
        self.processes[part] = subprocess.Popen(
            [self.place.program, *arguments, "--part", f"{part}/{parts}", "--exchange", exchange, *more],
            cwd=self.place.folder, env=ENV, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, text=True)

    def ends(self, seconds=120):
        """@return of each part its exit code, and what it wrote."""
        until = time.monotonic() + seconds
        found = {}
        for part, process in self.processes.items():
            try:
                out, err = process.communicate(timeout=max(0.1, until - time.monotonic()))
            except subprocess.TimeoutExpired:
                for other in self.processes.values():
                    other.kill()
                raise AssertionError(f"part {part} did not end within {seconds} s: "
                                     f"{process.communicate()[1]}") from None
            found[part] = (process.returncode, out, err)
        return found


class Place:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def one_process(self, *arguments):
        return subprocess.run([self.program, *arguments, "--quiet"], cwd=self.folder, check=True,
                              capture_output=True, text=True).stdout

    def names(self, exchange="exchange"):
        return sorted(p.name for p in (self.folder / exchange).rglob("*"))

    def wait_for(self, pattern, exchange="exchange"):
        until = time.monotonic() + 60
        while True:
            found = sorted((self.folder / exchange).glob(pattern))
            if found:
                return found[0]
            assert time.monotonic() < until, f"no {pattern}"
            time.sleep(0.002)

    def clear(self, exchange="exchange"):
        shutil.rmtree(self.folder / exchange, ignore_errors=True)


def check_bytes(place):
    tried = 0
    for make, extents, options in (
            (volume, (14, 12, 10), []), (smooth, (24, 20, 16), []),
            (volume, (9, 10, 8), ["--construction", "cells", "--field", "3"]),
            (smooth, (16, 12, 10), ["--construction", "cells", "--superlevel"]),
            (volume, (8, 7, 6), ["--periodic", "all", "--max-dim", "3"]),
            (smooth, (12, 10, 9), ["--periodic", "0", "--construction", "cells"]),
            (volume, (2, 9, 9), ["--min-dim", "1"]),
            (volume, (40, 30), ["--periodic", "0"])):
        make(place.folder / "image.npy", extents)
        expected = place.one_process("image.npy", *options)
        assert expected.count("\n") > 5
        for parts in range(1, 5):
            found = Run(place, parts, "image.npy", *options, "--quiet", "--threads", "1").ends()
            assert found[1] == (0, expected, ""), f"{parts} parts of {options}: {found[1]}"
            for part in range(2, parts + 1):
                assert found[part] == (0, "", ""), found[part]
            assert place.names() == [], place.names()
            tried += 1
    points = place.folder / "points.csv"
    rng = random.Random(3)
    points.write_text("".join(f"{rng.gauss(0, 1)},{rng.gauss(0, 1)},{rng.random()}\n" for _ in range(300)))
    expected = place.one_process("points.csv", *H0)
    for parts in range(1, 4):
        found = Run(place, parts, "points.csv", *H0, "--quiet").ends()
        assert [found[part] for part in found] == [(0, expected, "")] + [(0, "", "")] * (parts - 1), found
        tried += 1
    # JSON has cells and says how many parts there were; files are those of part 1.
    volume(place.folder / "image.npy", (10, 9, 8))
    found = Run(place, 3, "image.npy", "-o", "bars.json", "--plot", "bars.svg").ends()
    assert all(code == 0 for code, _, _ in found.values()), found
    assert "part 2 of 3: done" in found[2][2], found[2]
    ours = json.loads((place.folder / "bars.json").read_text())
    theirs = json.loads(place.one_process("image.npy", "--output-format", "json"))
    assert ours.pop("input")["description"] == theirs.pop("input")["description"] + ", 3 parts"
    differ = [name for name in {**ours, **theirs} if ours.get(name) != theirs.get(name)]
    assert set(differ) <= {"timings", "peak_memory", "engine"}, differ
    assert (place.folder / "bars.svg").exists()
    return tried + 1


def check_start(place):
    """Parts begin in any order. One that is late is waited for, and those who wait say so."""
    volume(place.folder / "image.npy", (10, 9, 8))
    expected = place.one_process("image.npy")
    run = Run(place, 3, "image.npy", only=[2, 3])
    time.sleep(4)
    run.start(1, 3, ["image.npy"])
    found = run.ends()
    assert found[1][:2] == (0, expected) and found[2][0] == found[3][0] == 0, found
    assert "waiting for part 1 in exchange" in found[2][2], found[2]
    # A dry run needs nobody else.
    found = Run(place, 3, "image.npy", "--dry-run", only=[2]).ends()
    assert found[2][0] == 0 and "memory" in found[2][1], found
    assert place.names() == []


def check_refusals(place):
    volume(place.folder / "image.npy", (10, 9, 8))
    (place.folder / "points.csv").write_text("1,2\n3,5\n4,4\n")
    part = ["--part", "1/1", "--exchange", "exchange"]
    for arguments, word in (
            (["image.npy", "--exchange", "exchange"], "--exchange: found without --part"),
            (["image.npy", *part, "--resume"], "--resume"),
            (["image.npy", *part, "--keep-cells"], "--keep-cells"),
            (["image.npy", *part, "--join"], "--join"),
            (["image.npy", *part, "--report", "x.html"], "--report"),
            (["image.npy", "image.npy", *part], "expected one image or cloud"),
            ([".", *part], "expected one image or cloud"),
            (["image.npy", *part, "--metric", "cosine"], "--metric"),
            (["image.npy", *part, "--min-persistence", "-1"], "--min-persistence"),
            (["image.npy", *part, "--plot", "x.svg", "--plot-kind", "tree"], "--plot-kind"),
            (["image.npy", *part, "--exchange", ""], "--exchange"),
            (["points.csv", *part], "points need --complex rips"),
            (["image.npy", *part, "-o", "image.npy"], "is an input")):
        place.clear()
        run = subprocess.run([place.program, *arguments], cwd=place.folder, capture_output=True, text=True,
                             check=False)
        assert run.returncode == USAGE and word in run.stderr, (arguments, run)
    place.clear()
    for more, word in ((["--max-dim", "1"], "--max-dim 1"), (["--superlevel"], "--superlevel"),
                       (["--output-format", "json"], "--output-format json")):
        found = Run(place, 2, "image.npy", more={2: more}).ends(AT_ONCE)
        assert found[2][0] == USAGE and "--exchange: part 2: found" in found[2][2], found
        assert word in found[2][2], found
        assert found[1][0] == IO and "part 2 has failed: --exchange: part 2" in found[1][2], found
        assert place.names() == [], "all have ended, and nothing is left"
    place.clear()
    (place.folder / "exchange").write_text("")
    found = Run(place, 2, "image.npy", only=[1]).ends()
    assert found[1][0] == CANNOT_CREATE and "exchange" in found[1][2], found
    (place.folder / "exchange").unlink()


def check_errors(place):
    """An error of one part, and Ctrl-C, are heard of by all."""
    volume(place.folder / "image.npy", (48, 96, 96))
    output = place.folder / "bars.csv"
    found = Run(place, 3, "image.npy", "-o", "bars.csv", more={2: ["--memory-limit", "1MiB"]}).ends(60)
    assert found[2][0] == MEMORY, found
    for part in (1, 3):
        assert found[part][0] == IO and "part 2 has failed: " in found[part][2], found[part]
    assert not output.exists() and place.names() == []
    for stopped in (1, 3):
        run = Run(place, 3, "image.npy", "-o", "bars.csv")
        place.wait_for("ph-run/*/hello-3")
        time.sleep(0.3)
        run.processes[stopped].send_signal(signal.SIGINT)
        found = run.ends(AT_ONCE)
        assert found[stopped][0] == INTERRUPTED, found
        for part in {1, 2, 3} - {stopped}:
            assert found[part][0] == IO, found
            assert f"part {stopped} has failed: it was stopped" in found[part][2], found
        assert not output.exists()
        place.clear()
    # While it waits for others, it ends at once.
    run = Run(place, 3, "image.npy", only=[1])
    place.wait_for("ph-run/*/hello-1")
    time.sleep(1)
    run.processes[1].send_signal(signal.SIGTERM)
    begin = time.monotonic()
    assert run.ends(AT_ONCE)[1][0] == 143
    assert time.monotonic() - begin < 0.5
    place.clear()


def check_damage(place):
    """A message that changes on its way is found."""
    volume(place.folder / "image.npy", (48, 96, 96))
    # Part 1 goes on once part 2 is stopped: its first message lies there.
    arguments = ["image.npy", "-o", "bars.csv"]
    run = Run(place, 2, *arguments, only=[1])
    place.wait_for("ph-run/*/hello-1")
    run.processes[1].send_signal(signal.SIGSTOP)
    run.start(2, 2, arguments)
    place.wait_for("ph-run/*/hello-2")
    run.processes[2].send_signal(signal.SIGSTOP)
    run.processes[1].send_signal(signal.SIGCONT)
    message = place.wait_for("ph-run/*/part-2/1-0")
    content = bytearray(message.read_bytes())
    content[len(content) // 2] ^= 16
    message.write_bytes(content)
    run.processes[2].send_signal(signal.SIGCONT)
    found = run.ends(60)
    assert found[2][0] == IO and "part 2: message from part 1: found another checksum" in found[2][2], found
    assert found[1][0] == IO and "part 2 has failed: part 2: message from part 1" in found[1][2], found
    assert not (place.folder / "bars.csv").exists()
    place.clear()


def check_runs_at_once(place):
    """In two folders they do not see each other. In one, what is not the first is refused."""
    volume(place.folder / "a.npy", (14, 12, 10))
    smooth(place.folder / "b.npy", (14, 12, 10))
    bars = {name: place.one_process(name) for name in ("a.npy", "b.npy")}
    runs = {name: Run(place, 3, name, "--quiet", exchange=f"of-{name}") for name in bars}
    for name, run in runs.items():
        found = run.ends()
        assert found[1] == (0, bars[name], ""), found
        assert place.names(f"of-{name}") == []
    for _ in range(5):
        runs = [Run(place, 2, "a.npy", "--quiet") for _ in range(2)]
        found = [run.ends(PATIENCE + AT_ONCE) for run in runs]
        for of_run in found:
            for part, (code, out, err) in of_run.items():
                assert code in (0, IO, CANNOT_CREATE), found
                assert out == (bars["a.npy"] if code == 0 and part == 1 else ""), found
                assert code != CANNOT_CREATE or "is there already" in err, found
        place.clear()


def check_kills(place, kills, seed):
    rng = random.Random(seed)
    volume(place.folder / "image.npy", (16, 40, 40))
    expected = place.one_process("image.npy")
    command = ["image.npy", "-o", "killed.csv", "--quiet", "--threads", "1"]
    output = place.folder / "killed.csv"
    begin = time.monotonic()
    found = Run(place, 3, *command).ends()
    usual = time.monotonic() - begin
    assert all(end == (0, "", "") for end in found.values()) and output.read_text() == expected, found
    killed, slowest = 0, 0.0
    while killed < kills:
        output.unlink(missing_ok=True)
        run = Run(place, 3, *command)
        victim = rng.randrange(1, 4)
        if rng.random() < 0.9:
            place.wait_for("ph-run/*/hello-3")
        time.sleep(rng.uniform(0, usual))
        run.processes[victim].kill()
        begin = time.monotonic()
        others = Run(place, 0)
        others.processes = {part: p for part, p in run.processes.items() if part != victim}
        if not list((place.folder / "exchange").glob(f"ph-run/*/hello-{victim}")):
            for process in run.processes.values():  # it had not begun, or all was done
                process.kill()
            run.ends()
            place.clear()
            continue
        found = others.ends(PATIENCE + AT_ONCE)
        run.processes[victim].communicate()
        if all(end[0] == 0 for end in found.values()):  # the victim had done its part
            assert output.read_text() == expected
            place.clear()
            continue
        killed += 1
        slowest = max(slowest, time.monotonic() - begin)
        said = "".join(err for _, _, err in found.values())
        assert all(code in (0, IO) for code, _, _ in found.values()), found
        assert f"part {victim} has said nothing for {PATIENCE} s" in said, found
        assert not output.exists() or output.read_text() == expected, "half a file"
        # What is left is refused, until it is deleted.
        again = Run(place, 3, *command).ends(PATIENCE + AT_ONCE)
        assert all(code == CANNOT_CREATE and "exchange/ph-run" in err and "delete" in err
                   for code, _, err in again.values()), again
        shutil.rmtree(place.folder / "exchange/ph-run")
        again = Run(place, 3, *command).ends()
        assert all(end == (0, "", "") for end in again.values()), again
        assert output.read_text() == expected
    return slowest


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    kills = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    with tempfile.TemporaryDirectory() as name:
        place = Place(program, pathlib.Path(name))
        tried = check_bytes(place)
        check_start(place)
        check_refusals(place)
        check_errors(place)
        check_damage(place)
        check_runs_at_once(place)
        slowest = check_kills(place, kills, seed)
    print(f"{tried} runs with the bytes of one process; {kills} processes killed, all others ended within "
          f"{slowest:.1f} s where a part may be silent for {PATIENCE} s")


if __name__ == "__main__":
    main()
