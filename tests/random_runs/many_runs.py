# SPDX-License-Identifier: MIT
"""Many random runs. Each has a seed, and a folder whose files are kept if the run finds a
difference."""
import collections
import os
import pathlib
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor

PIECE = 50  # number of runs that one process does in sequence


class Difference(Exception):
    """A result differs from the required result. The message names the result and the command."""


def add_options(parser, runs):
    """@param runs the default number of runs."""
    parser.add_argument("--runs", type=int, default=runs)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--keep", default=".")
    parser.add_argument("--go-on", action="store_true", help="after a difference")


def some_runs(one_run, first, count, keep):
    """@return the number of runs of each kind, and the differences."""
    counts, differences = collections.Counter(), []
    for seed in range(first, first + count):
        with tempfile.TemporaryDirectory() as folder:
            try:
                counts[one_run(seed, folder)] += 1
            except Difference as error:
                kept = pathlib.Path(f"{keep}-{seed}")
                kept.mkdir(exist_ok=True)
                for path in pathlib.Path(folder).iterdir():
                    if path.is_file():
                        (kept / path.name).write_bytes(path.read_bytes())
                differences.append(f"seed {seed}: {error}\n  files: {kept}")
            except Exception as error:
                raise RuntimeError(f"seed {seed}: {error!r}") from error
    return counts, differences


def run_all(one_run, options, name):
    """Makes all runs, prints their counts, and exits with 1 if there were differences. @param
    one_run(seed, folder) returns the kind of run, for the counts; it must be picklable, and raises
    Difference. @param options the result of add_options. @param name for the folders that are
    kept."""
    counts, failures, end = collections.Counter(), [], options.seed + options.runs
    keep = os.path.join(options.keep, name)
    with ProcessPoolExecutor(options.jobs) as pool:
        pieces = [pool.submit(some_runs, one_run, first, min(PIECE, end - first), keep)
                  for first in range(options.seed, end, PIECE)]
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
