# SPDX-License-Identifier: MIT
"""long_run.py PH_BARCODE PEAK [--minutes M] [--seed S] [--keep FOLDER]

Runs random jobs for a long time, and disturbs them: by signals at random moments, by limits on
memory, heap and file size, and by stopping and continuing them. Whatever happens, the output is the
complete output of the undisturbed run or the previous file. If the exit code is 0, it is complete.
Nothing else is left in the folder, unless SIGKILL ended the run. No run with a limit on memory uses
more than this limit plus 32 MiB. If the Python package can be imported, one process runs jobs for
the same time, with limits, and its memory must not grow. PEAK is the program built from
tests/faults/peak.c. Exits with 1 at the first fault and prints the command; the files are kept in
FOLDER."""
import argparse
import collections
import json
import os
import pathlib
import random
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "../support")]
import files  # noqa: E402

MIB = 1 << 20
BESIDE_LIMIT = 32 * MIB  # the memory that the program may take in addition to its limit
REFUSED = {73, 74, 75}  # cannot create output, input or output failed, out of memory


class Fault(Exception):
    pass


def points(rng):
    dim = rng.choice([2, 2, 3, 4])
    count = rng.choice([50, 200, 400, 800])
    rows = "".join(" ".join(f"{rng.random():.6f}" for _ in range(dim)) + "\n" for _ in range(count))
    return "points.txt", rows.encode(), ["--max-dim", rng.choice(["0", "1", "1", "2" if count < 300 else "1"])]


def image(rng):
    shape = rng.choice([(300, 300), (40, 40, 40), (64, 64, 32), (12, 12, 12, 12)])
    count = 1
    for n in shape:
        count *= n
    content = files.npy("|u1", shape, rng.randbytes(count))
    options = ["--construction", rng.choice(["vertices", "cells"])]
    if len(shape) < 4:
        options += rng.choice([[], [], ["--slab-layers", str(rng.randint(2, 9))]])
    return "image.npy", content, options


def distances(rng):
    size = rng.choice([30, 60, 120])
    rows = "".join(",".join(f"{rng.random():.4f}" for _ in range(i)) + "\n" for i in range(1, size))
    return "distances.csv", rows.encode(), ["--format", "lower-distance", "--max-dim", rng.choice(["1", "2"])]


def lasting(name, content):
    """The reproducible part of an output: JSON is compared without times and memory. @return None
    if the file is incomplete."""
    if not name.endswith(".json"):
        return content
    try:
        stored = json.loads(content)
    except ValueError:
        return None
    return {key: value for key, value in stored.items() if key not in ("timings", "peak_memory")}


class Job:
    """An input in a separate folder, with the output of its undisturbed run."""

    def __init__(self, program, peak, rng, folder):
        self.folder, self.peak = folder, peak
        name, content, options = rng.choice([points, points, image, image, distances])(rng)
        pathlib.Path(folder, name).write_bytes(content)
        self.output = rng.choice(["bars.csv", "bars.json", "bars.npy"])
        self.command = [program, name, *options, "--quiet", "--threads", rng.choice("112"), "-o", self.output]
        if rng.random() < 0.2:
            self.command += ["--field", rng.choice(["3", "5"])]
        if rng.random() < 0.2:
            self.command += ["--plot", "bars.svg"]
        self.before = set(os.listdir(folder))
        self.expected, begin = {}, time.monotonic()
        run = subprocess.run(self.command, cwd=folder, capture_output=True, timeout=600)
        self.seconds = time.monotonic() - begin
        if run.returncode != 0:
            raise Fault(f"{shlex.join(self.command)}\n  exit {run.returncode}: {run.stderr.decode()}")
        for made in set(os.listdir(folder)) - self.before:
            self.expected[made] = lasting(made, pathlib.Path(folder, made).read_bytes())

    def disturb(self, rng):
        """@return the kind of disturbance, and the outcome."""
        old = {name: b"before" for name in self.expected if rng.random() < 0.5}
        for name in self.expected:
            pathlib.Path(self.folder, name).unlink(missing_ok=True)
        for name, content in old.items():
            pathlib.Path(self.folder, name).write_bytes(content)
        way = rng.choice(["kill", "signal", "stop", "memory limit", "heap", "file size"])
        command, limit, number = list(self.command), None, None
        if way == "memory limit":
            limit = round(MIB * 2 ** rng.uniform(-1, 6))
            command = [self.peak, self.folder + ".peak", *command, "--memory-limit", str(limit)]
        kind, most = {"heap": (resource.RLIMIT_DATA, round(MIB * 2 ** rng.uniform(1, 6))),
                      "file size": (resource.RLIMIT_FSIZE, round(2 ** rng.uniform(4, 18)))}.get(way, (None, 0))
        process = subprocess.Popen(
            command, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            preexec_fn=(lambda: resource.setrlimit(kind, (most, most))) if kind is not None else None)
        if way in ("kill", "signal", "stop"):
            time.sleep(rng.uniform(0, 1.2 * self.seconds))
            number = {"kill": signal.SIGKILL, "stop": signal.SIGSTOP}.get(
                way, rng.choice([signal.SIGINT, signal.SIGTERM, signal.SIGHUP]))
            os.kill(process.pid, number)  # unlike send_signal, this does not reap the process
            if way == "stop":
                time.sleep(rng.uniform(0, 0.05))
                os.kill(process.pid, signal.SIGCONT)
        said = process.stderr.read()  # the messages are short enough to fit into the pipe
        process.stderr.close()
        code = process.wait()
        self.check(way, command, code, number, said, old)
        if limit is not None:
            report = pathlib.Path(self.folder + ".peak")
            resident = int(report.read_text().split()[0])
            report.unlink()
            if resident * 1024 > limit + BESIDE_LIMIT:
                raise Fault(f"{shlex.join(command)}\n  found {resident} KiB resident")
        return f"{way}: {'done' if code == 0 else 'ended'}"

    def check(self, way, command, code, number, said, old):
        where = f"{shlex.join(command)}\n  {way}, exit {code}: {said.decode(errors='replace')}"
        # A signal may arrive before the program has installed its handlers.
        ends = {"kill": {-signal.SIGKILL}, "signal": {128 + number, -number} if number else set(), "stop": set()}
        if code != 0 and code not in ends.get(way, REFUSED):
            raise Fault(f"{where}\n  found an end that this cannot have")
        if code in REFUSED and (said.count(b"\n") != 1 or not said.endswith(b"\n")):
            raise Fault(f"{where}\n  found a refusal that is not one line")
        found = set(os.listdir(self.folder)) - self.before
        left = found - set(self.expected)
        if left and way != "kill":
            raise Fault(f"{where}\n  found {left} in the folder")
        for name in left:
            os.unlink(os.path.join(self.folder, name))
        for name, content in self.expected.items():
            path = pathlib.Path(self.folder, name)
            is_there = path.read_bytes() if path.exists() else None
            is_new = is_there is not None and lasting(name, is_there) == content
            if not is_new and (code == 0 or is_there != old.get(name)):
                raise Fault(f"{where}\n  found {name} that is neither old nor complete")


def in_one_process(rng, minutes):
    """Runs jobs of the Python package in this process, whose memory must not grow after the first
    jobs."""
    import numpy
    import libph
    rooms, kept, jobs, refused = [], {}, 0, 0
    end = time.monotonic() + 60 * minutes
    while time.monotonic() < end or jobs < 60:
        seed = rng.randrange(40)
        numbers = numpy.random.default_rng(seed)
        room = None if rng.random() < 0.5 else round(MIB * 2 ** rng.uniform(0, 6))
        try:
            if seed % 2:
                bars = libph.rips(numbers.random((50 + 10 * seed, 2 + seed % 3)), memory_limit=room)
            else:
                bars = libph.cubical(numbers.random((8 + seed,) * (2 + seed % 4 // 2)), memory_limit=room)
        except MemoryError:
            refused += 1
        else:
            found = numpy.asarray(bars.bars if hasattr(bars, "bars") else bars).tobytes()
            if kept.setdefault(seed, found) != found:
                raise Fault(f"in one process, seed {seed}: found other bars than before")
        jobs += 1
        with open("/proc/self/statm", encoding="ascii") as statm:
            rooms.append(int(statm.read().split()[1]) * resource.getpagesize())
    # Almost surely, both kinds of input occur in the first third.
    early, late = max(rooms[:len(rooms) // 3]), max(rooms[-len(rooms) // 3:])
    if late > early + 8 * MIB:
        raise Fault(f"in one process: found {late} bytes resident after {jobs} jobs, {early} before")
    return f"{jobs} jobs in one process, {refused} of them over their limits, {early >> 20} MiB resident " \
           f"at most in the first third, {late >> 20} in the last"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("peak", type=pathlib.Path)
    parser.add_argument("--minutes", type=float, default=0.2)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", default=".")
    options = parser.parse_args()
    counts, job = collections.Counter(), 0
    end = time.monotonic() + 60 * options.minutes
    while time.monotonic() < end:
        rng = random.Random(options.seed + job)
        folder = tempfile.mkdtemp()
        try:
            disturbed = Job(str(options.program.resolve()), str(options.peak.resolve()), rng, folder)
            for _ in range(8):
                counts[disturbed.disturb(rng)] += 1
        except Fault as fault:
            kept = os.path.join(options.keep, f"long-run-{options.seed + job}")
            shutil.copytree(folder, kept, dirs_exist_ok=True)
            print(f"job {options.seed + job}: {fault}\n  files: {kept}")
            sys.exit(1)
        finally:
            shutil.rmtree(folder)
        job += 1
    for kind, count in sorted(counts.items()):
        print(f"{count:9d}  {kind}")
    print(f"{job} jobs from seed {options.seed} on, {sum(counts.values())} disturbed runs, 0 faults")
    try:
        import libph  # noqa: F401
    except ImportError:
        print("SKIPPED: no package libph, so nothing is said of one process that goes on")
        return
    print(in_one_process(random.Random(options.seed), options.minutes))


if __name__ == "__main__":
    main()
