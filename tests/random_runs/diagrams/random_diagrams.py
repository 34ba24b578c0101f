# SPDX-License-Identifier: MIT
"""random_diagrams.py PH_DISTANCE PH_VECTORISE [--runs N] [--seed S] [--jobs J] [--keep FOLDER]
[--only WHICH]

Runs both programs with random options on random barcodes in each format, and compares their output
with distances and vectors by the definition (diagram_oracle.py, vector_oracle.py), which share no
code with the programs. Each run has its own seed: --seed S --runs 1 repeats the run of seed S. If
there are differences, it exits with 1 and prints the commands; the files are kept in FOLDER
(default: where the script is run). Skipped without SciPy."""
import argparse
import functools
import os
import pathlib
import random
import sys

try:
    import scipy  # noqa: F401
except ModuleNotFoundError:
    print("SKIPPED: no SciPy")
    sys.exit(77)

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.dirname(HERE), os.path.join(HERE, "../../support")]
import distance_runs  # noqa: E402
import many_runs  # noqa: E402
import vector_runs  # noqa: E402
from random_runs import Program  # noqa: E402

KINDS = {"distance": distance_runs, "vectorise": vector_runs}


def one_run(programs, only, seed, folder):
    rng = random.Random(seed)
    which = only or rng.choice(list(KINDS))
    return KINDS[which].one_run(rng, Program(programs[which], folder), folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("distance", type=pathlib.Path)
    parser.add_argument("vectorise", type=pathlib.Path)
    many_runs.add_options(parser, 1000)
    parser.add_argument("--only", choices=KINDS)
    options = parser.parse_args()
    programs = {which: str(getattr(options, which).resolve()) for which in KINDS}
    many_runs.run_all(functools.partial(one_run, programs, options.only), options, "random-diagrams")



if __name__ == "__main__":
    main()
