# SPDX-License-Identifier: MIT
"""One entry of the corpus: a use of a program that is faulty, or strange but valid, and the
required outcome."""
import contextlib
import dataclasses
import os
import tempfile
import typing

import samples

# The subject of each row in the table of faults.
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
# Files to be refused before anything is allocated: headers with wrong sizes, and files that unpack
# to excessive sizes.
FRUGAL_ROWS = range(31, 43)


@dataclasses.dataclass(frozen=True)
class Form:
    """A format that a program accepts: the extension of its files, and the options that select
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
    "nrrd": Form(".nrrd"),
    "metaimage": Form(".mha"),
    "vti": Form(".vti"),
    "pgm": Form(".pgm"),
    "png": Form(".png"),
    "tiff": Form(".tif"),
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
    message: str = ""   # regular expression for the line of a failure, or for a note of a success
    named: str = ""     # file or option that the error line names
    files: typing.Mapping = dataclasses.field(default_factory=dict)  # maps names to contents
    output: typing.Optional[str] = None   # what a success prints on stdout
    form: str = ""      # key of FORMS; empty if the entry is not about a file's content
    around: typing.Optional[typing.Callable] = None  # a context manager like `plain`
    # after(folder) returns what is wrong after the run, or nothing.
    after: typing.Optional[typing.Callable] = None
    creates: tuple = ()                   # files that must exist only after the run
    unprivileged: bool = False            # run as another user, because root needs no permissions
    # True if the limits for false headers apply; None if this depends on the row.
    frugal: typing.Optional[bool] = None


class Unavailable(Exception):
    """A requirement of an entry is missing. The entry is skipped for this reason."""


@contextlib.contextmanager
def plain(_folder):
    """The default of Entry.around, which changes nothing. Other context managers prepare the
    folder, yield options for subprocess.Popen, and clean up."""
    yield {}


@contextlib.contextmanager
def set_up(entry):
    """Prepares a separate folder with the files of the entry. Yields the folder, and options for
    subprocess.Popen. Files next to the folder are removed together with it."""
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
    """An entry for a file that must be refused."""
    return of_file(row, form, name, content, options, code=code, message=message,
                   **{"named": "input" + FORMS[form].extension, **others})


def taken(row, form, name, content, output, *options, note="", **others):
    """An entry for a file that looks doubtful but is valid. @param output the output of the
    program; for a cloud, the labels."""
    if FORMS[form].program == "ph-segment":
        options = (*options, "--labels", "-", "--quiet")
    return of_file(row, form, name, content, options, code=0, output=output, message=note, **others)


def bars(*rows):
    """@param rows bars such as "0,0,inf". @return the CSV with these bars."""
    return "\n".join(("dim,birth,death", *rows, ""))


def labels(*numbers):
    return "".join(f"{n}\n" for n in numbers)


def sample(reader, name):
    return samples.named(reader, name).content


def with_change(content, old, new):
    """The content with the first occurrence of `old` replaced; there must be one."""
    if old not in content:
        raise ValueError(f"nothing to change: no {old!r}")
    return content.replace(old, new, 1)


def with_bytes(content, offset, new):
    """The content with other bytes at an offset. A negative offset counts from the end."""
    begin = offset % len(content)
    if begin + len(new) > len(content):
        raise ValueError("nothing to change: behind the end")
    return content[:begin] + new + content[begin + len(new):]
