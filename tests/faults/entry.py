# SPDX-License-Identifier: MIT
"""One line of the corpus: a faulty, or a strange but valid, use of a program, and the required
outcome."""
import contextlib
import dataclasses
import os
import tempfile
import typing

import samples

# The subject of each row of the table of faults.
ROWS = {
    1: "empty file", 2: "only blanks or comments", 3: "byte order mark", 4: "CRLF", 5: "UTF-16",
    6: "NUL bytes", 7: "binary given as text", 8: "everything on one line",
    9: "nan", 10: "inf", 11: "-inf", 12: "1e400", 13: "0x1p3", 14: "decimal comma", 15: "1_000",
    16: "1.0abc",
    17: "ragged rows", 18: "header row", 19: "extra column", 20: "mixed separators",
    21: "rows and columns differ", 22: "non-zero diagonal", 23: "asymmetric", 24: "correlations",
    25: "truncated points and distances", 26: "truncated images", 27: "truncated complexes",
    28: "truncated clouds", 29: "truncated compressed data", 30: "truncated text without a length",
    31: "10^12 points", 32: "sizes whose product overflows", 33: "negative sizes", 34: "2^63",
    35: "counts that disagree", 36: "COUNT 2e9", 37: "SIZE 3", 38: "unknown types",
    39: "compressed lengths that lie", 40: "bombs", 41: "trailing data", 42: "lists of 4e9",
    43: "negative ids", 44: "ids of 4e9", 45: "a pair with two values", 46: "self loops",
    47: "dimensions below 0", 48: "high dimensions", 49: "impossible option values",
    50: "options without value, or unknown",
    51: "a directory as input", 52: "FIFO and standard input", 53: "endless streams",
    54: "missing and unreadable files",
    55: "outputs that cannot be created", 56: "read-only folder", 57: "output = input",
    58: "/dev/full", 59: "broken pipe", 60: "an older output",
    61: "barcodes as text", 62: "barcodes as JSON", 63: "binary barcodes", 64: "groups of barcodes",
    65: "what was fitted", 66: "stored merge trees", 67: "cameras", 68: "lists of frames",
    69: "damaged parts", 70: "parts that lie", 71: "parts of something else",
    73: "weights, periods and values of alpha complexes", 74: "points of alpha complexes",
    77: "line feed in a file name", 78: "markup in a file name", 79: "%s in a file name",
    80: "long file names, and not UTF-8",
    81: "locale with decimal comma", 82: "TZ", 83: "umask", 84: "Turkish case",
    85: "all points equal", 86: "collinear", 87: "cocircular", 88: "1e-300", 89: "1e300",
    90: "duplicates",
    91: "organised cloud all NaN", 92: "one valid pixel", 93: "height 1", 94: "label already there",
    95: "rgb whose float is NaN", 96: "zero normals",
}
# To be refused before any allocation: headers that lie, and files that unpack to excessive sizes.
FRUGAL_ROWS = range(31, 43)


@dataclasses.dataclass(frozen=True)
class Form:
    """A format as a program accepts it: the extension of its files, and the options that select
    it."""
    extension: str
    options: tuple = ()
    program: str = "ph-barcode"


FORMS = {
    "points": Form(".txt", ("--format", "points")),
    "distance": Form(".txt", ("--format", "distance")),
    "lower-distance": Form(".txt", ("--format", "lower-distance")),
    "upper-distance": Form(".txt", ("--format", "upper-distance")),
    "sparse": Form(".txt", ("--format", "sparse")),
    "binary": Form(".bin", ("--format", "binary")),
    "simplices": Form(".simplices", ("--format", "simplices")),
    "phat": Form(".phat"),
    "dipha": Form(".dipha"),
    "perseus": Form(".perseus"),
    "npy": Form(".npy"),
    "npy-points": Form(".npy", ("--format", "npy", "--complex", "rips")),
    "npy-distance": Form(".npy", ("--format", "distance")),
    "npz": Form(".npz"),
    "nifti": Form(".nii"),
    "pgm": Form(".pgm"),
    "png": Form(".png"),
    "off": Form(".off"),
    "gzip": Form(".txt.gz"),
    "pcd": Form(".pcd", (), "ph-segment"),
    "ply": Form(".ply", (), "ph-segment"),
    "xyz": Form(".xyz", (), "ph-segment"),
    "pts": Form(".pts", (), "ph-segment"),
}


@dataclasses.dataclass(frozen=True)
class Entry:
    row: int
    name: str
    program: str
    arguments: tuple
    code: int
    message: str = ""   # regular expression: the line of a failure, or a note of a success
    named: str = ""     # file or option that the line of a failure names
    files: typing.Mapping = dataclasses.field(default_factory=dict)  # name to content
    output: typing.Optional[str] = None   # of a success, on stdout
    form: str = ""      # key of FORMS; empty: not about a file's content
    around: typing.Optional[typing.Callable] = None  # see `plain`
    after: typing.Optional[typing.Callable] = None   # after(folder): what is wrong then, or nothing
    creates: tuple = ()                   # files that did not exist before
    unprivileged: bool = False            # useless as root
    frugal: typing.Optional[bool] = None  # held to the limits of a header that lies; None: by row


class Unavailable(Exception):
    """A requirement of an entry is missing: it is skipped, with this reason."""


@contextlib.contextmanager
def plain(_folder):
    """The environment of a run: prepares a folder, yields options of subprocess.Popen, cleans
    up."""
    yield {}


@contextlib.contextmanager
def set_up(entry):
    """Yields a separate folder for the entry, with its files, and options of subprocess.Popen.
    Files beside the folder are removed with it."""
    with tempfile.TemporaryDirectory() as outer:
        folder = os.path.join(outer, "here")
        os.mkdir(folder)
        for name, content in entry.files.items():
            with open(os.path.join(os.fsencode(folder), os.fsencode(name)), "wb") as file:
                file.write(content)
        with (entry.around or plain)(folder) as options:
            yield folder, options


def of_file(row, form, name, content, options, **others):
    kind = FORMS[form]
    file = "input" + kind.extension
    return Entry(row, f"{form}: {name}", kind.program, (file, *kind.options, *options),
                 files={file: content if isinstance(content, bytes) else content.encode()},
                 form=form, **others)


def refused(row, form, name, content, message, *options, code=65, **others):
    """A file that must be refused."""
    return of_file(row, form, name, content, options, code=code, message=message,
                   **{"named": "input" + FORMS[form].extension, **others})


def taken(row, form, name, content, output, *options, note="", **others):
    """A file that looks doubtful and is valid. @param output the program's; a cloud's labels."""
    if FORMS[form].program == "ph-segment":
        options = (*options, "--labels", "-", "--quiet")
    return of_file(row, form, name, content, options, code=0, output=output, message=note, **others)


def bars(*rows):
    """@param rows "0,0,inf". @return the CSV of these bars."""
    return "\n".join(("dim,birth,death", *rows, ""))


def labels(*numbers):
    return "".join(f"{n}\n" for n in numbers)


def sample(reader, name):
    return samples.named(reader, name).content


def with_change(content, old, new):
    """The content with the first `old` replaced, which must be there."""
    if old not in content:
        raise ValueError(f"nothing to change: no {old!r}")
    return content.replace(old, new, 1)


def with_bytes(content, offset, new):
    """The content with other bytes at an offset; a negative one counts from the end."""
    begin = offset % len(content)
    if begin + len(new) > len(content):
        raise ValueError("nothing to change: behind the end")
    return content[:begin] + new + content[begin + len(new):]
