# SPDX-License-Identifier: MIT
"""A small valid file of every input format and variant that the readers know.

samples.py FOLDER writes each sample as FOLDER/<reader>/<name>, and FOLDER/manifest.txt with a line
`reader name sized|open` for each. A `sized` file declares its end: each of its prefixes is faulty,
except the file without its last line break. Text formats of this kind end in a token of one
character.
"""
import os
import sys

import arrays
import barcodes
import clouds
import text
import trees

SAMPLES = [*text.SAMPLES, *arrays.SAMPLES, *clouds.SAMPLES, *barcodes.SAMPLES, *trees.SAMPLES]


def named(reader, name):
    """The sample of a reader with this name."""
    return next(s for s in SAMPLES if (s.reader, s.name) == (reader, name))


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: samples.py FOLDER")
    folder = sys.argv[1]
    places = {(sample.reader, sample.name) for sample in SAMPLES}
    if len(places) != len(SAMPLES):
        sys.exit("samples.py: two samples have the same reader and name")
    lines = []
    for sample in SAMPLES:
        os.makedirs(os.path.join(folder, sample.reader), exist_ok=True)
        with open(os.path.join(folder, sample.reader, sample.name), "wb") as file:
            file.write(sample.content)
        lines.append(f"{sample.reader} {sample.name} {'sized' if sample.sized else 'open'}\n")
    with open(os.path.join(folder, "manifest.txt"), "w", encoding="ascii") as file:
        file.writelines(lines)
    print(f"{len(SAMPLES)} samples, {sum(len(s.content) for s in SAMPLES)} bytes")


if __name__ == "__main__":
    main()
