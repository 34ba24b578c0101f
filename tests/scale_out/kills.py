# SPDX-License-Identifier: MIT
"""kills.py PH_BARCODE [KILLS [SEED]]: kills, at random times, jobs that compute or join parts.

Whatever was killed, each output is either absent or complete. The same commands, repeated with
--resume, make the same bytes as an undisturbed run. No process is left running."""
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from volume import volume  # noqa: E402

PARTS = 4


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    kills = int(sys.argv[2]) if len(sys.argv) > 2 else 200
    rng = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        volume(folder / "volume.npy", (64, 96, 96))
        jobs = [["volume.npy", "--max-dim", "0", "--part", f"{i}/{PARTS}", "-o", f"part{i}.ph",
                 "--resume"] for i in range(1, PARTS + 1)]
        jobs.append(["--join", *(f"part{i}.ph" for i in range(1, PARTS + 1)), "-o", "bars.csv"])

        def run(job, kill_after=None):
            process = subprocess.Popen([program, *job, "--quiet"], cwd=folder, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE, start_new_session=True)
            if kill_after is not None:
                time.sleep(kill_after)
                os.killpg(process.pid, signal.SIGKILL)
            said = process.communicate(timeout=60)[1]
            return process.returncode, said

        def clear():
            for path in folder.iterdir():
                if path.name != "volume.npy":
                    path.unlink()
        clean, seconds = {}, []
        for job in jobs:
            start = time.monotonic()
            assert run(job) == (0, b""), job
            seconds.append(time.monotonic() - start)
            output = job[job.index("-o") + 1]
            clean[output] = (folder / output).read_bytes()
        done = cut = 0
        while cut < kills:
            clear()
            for job, usual in zip(jobs, seconds):
                output = folder / job[job.index("-o") + 1]
                while cut < kills and rng.random() < 0.7:
                    code, _ = run(job, rng.uniform(0, 1.1) * usual)
                    cut += code == -signal.SIGKILL
                    assert code in (0, -signal.SIGKILL), (job, code)
                    if output.exists():
                        assert output.read_bytes() == clean[output.name], f"{output.name} is not whole"
                assert run(job) == (0, b""), job
                assert output.read_bytes() == clean[output.name], output.name
                done += 1
    print(f"{cut} jobs killed, {done} resumed: the same bytes each time")


if __name__ == "__main__":
    main()
