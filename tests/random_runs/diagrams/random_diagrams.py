# SPDX-License-Identifier: MIT
"""random_diagrams.py PH_DISTANCE PH_VECTORISE [--runs N] [--seed S] [--jobs J] [--keep FOLDER] [--only WHICH]

Runs both programs with random options on random barcodes of each format, and compares what they write
with distances and vectors by the definition (diagram_oracle.py, vector_oracle.py), which share no line
with them. Each run has a seed of its own: --seed S --runs 1 repeats the run of seed S. Exits 1 at the
first differences, with the commands; the files are kept in FOLDER (default: where the script is run).
Without SciPy it is skipped."""
import argparse
import collections
import os
import pathlib
import random
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor

try:
    import scipy  # noqa: F401
except ModuleNotFoundError:
    print("SKIPPED: no SciPy")
    sys.exit(77)

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.dirname(HERE), os.path.join(HERE, "../../support")]
import distance_runs  # noqa: E402
import vector_runs  # noqa: E402
from random_runs import Difference, Program  # noqa: E402

KINDS = {"distance": distance_runs, "vectorise": vector_runs}


def some_runs(programs, first, count, only, keep):
    """@return counts of what was run, differences."""
    counts, differences = collections.Counter(), []
    for seed in range(first, first + count):
        rng = random.Random(seed)
        which = only or rng.choice(list(KINDS))
        with tempfile.TemporaryDirectory() as folder:
            try:
                counts[KINDS[which].one_run(rng, Program(programs[which], folder), folder)] += 1
            except Difference as error:
                kept = pathlib.Path(keep, f"random-diagrams-{seed}")
                kept.mkdir(exist_ok=True)
                for path in pathlib.Path(folder).iterdir():
                    (kept / path.name).write_bytes(path.read_bytes())
                differences.append(f"seed {seed}: {error}\n  files: {kept}")
            except Exception as error:
                raise RuntimeError(f"seed {seed}: {error!r}") from error
    return counts, differences


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("distance", type=pathlib.Path)
    parser.add_argument("vectorise", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--keep", default=".")
    parser.add_argument("--only", choices=KINDS)
    parser.add_argument("--go-on", action="store_true", help="after a difference")
    options = parser.parse_args()
    programs = {which: str(getattr(options, which).resolve()) for which in KINDS}
    counts, failures, piece = collections.Counter(), [], 100
    with ProcessPoolExecutor(options.jobs) as pool:
        pieces = [pool.submit(some_runs, programs, first, min(piece, options.seed + options.runs - first),
                              options.only, options.keep)
                  for first in range(options.seed, options.seed + options.runs, piece)]
        for done in pieces:
            some, differences = done.result()
            counts += some
            failures += differences
            for failure in differences:
                print(failure, flush=True)
            if failures and not options.go_on:
                pool.shutdown(cancel_futures=True)
                break
    for kind, count in sorted(counts.items()):
        print(f"{count:9d}  {kind}")
    print(f"{sum(counts.values())} runs from seed {options.seed} on, {len(failures)} differences")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
