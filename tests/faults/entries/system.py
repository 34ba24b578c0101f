# SPDX-License-Identifier: MIT
"""Rows 51 to 60 and 77 to 84: files, folders, names and environments. Cases that need closed
descriptors, system limits or a second reader are in tests/apps/barcode/faults.py."""
import contextlib
import functools
import os
import shutil
import stat
import subprocess
import tempfile
import threading

from files import nifti

from entry import Entry, Unavailable, bars
from characters import SQUARE, SQUARE_BARS

FILE = {"square.txt": SQUARE.encode()}
BARCODE, SEGMENT = "ph-barcode", "ph-segment"
LOCALES = {81: "de_DE.UTF-8", 84: "tr_TR.UTF-8"}


def around(function):
    """Decorator: makes `function(folder, …)` a context manager whose arguments after `folder` are
    given in advance."""
    manager = contextlib.contextmanager(function)
    return lambda *arguments: lambda folder: manager(folder, *arguments)


@around
def with_folder(folder, name, mode=0o755):
    os.mkdir(os.path.join(folder, name))
    os.chmod(os.path.join(folder, name), mode)
    yield {}
    os.chmod(os.path.join(folder, name), 0o755)


@around
def with_mode(folder, name, mode):
    os.chmod(os.path.join(folder, name), mode)
    yield {}


@around
def with_link(folder, target, name):
    os.symlink(target, os.path.join(folder, name))
    yield {}


@around
def with_fifo(folder, name, content):
    path = os.path.join(folder, name)
    try:
        os.mkfifo(path)
    except OSError as error:
        raise Unavailable(f"no FIFO: {error.strerror}") from error
    writer = threading.Thread(target=lambda: open(path, "wb").write(content), daemon=True)
    writer.start()
    yield {}
    with contextlib.suppress(OSError):  # releases a writer that waits for a reader
        os.close(os.open(path, os.O_RDONLY | os.O_NONBLOCK))


@around
def with_stdin(_folder, content):
    yield {"input": content}


def require_device(path):
    """@throws Unavailable if the path is not a device: opening it would create a file."""
    try:
        if stat.S_ISCHR(os.stat(path).st_mode):
            return
    except OSError:
        pass
    raise Unavailable(f"no device {path}")


@around
def with_device(_folder, path):
    require_device(path)
    yield {}


@around
def from_device(_folder, path):
    require_device(path)
    with open(path, "rb") as file:
        yield {"stdin": file}


@around
def from_file(folder, name):
    with open(os.path.join(folder, name), "rb") as file:
        yield {"stdin": file}


@around
def to_device(_folder, path):
    require_device(path)
    with open(path, "wb") as file:
        yield {"stdout": file}


@around
def with_standard_input_file(_folder, content):
    if not os.path.exists("/dev/stdin"):
        raise Unavailable("no /dev/stdin")
    yield {"input": content}


@around
def with_proc(_folder):
    if not os.path.exists("/proc/self"):
        raise Unavailable("no /proc")
    yield {}


@around
def to_nobody(_folder):
    reader, writer = os.pipe()
    os.close(reader)
    yield {"stdout": writer}
    os.close(writer)


@functools.cache
def folder_of_locales():
    """Compiles the locales that the tests need, because few machines have them installed."""
    folder = tempfile.TemporaryDirectory()
    for locale in LOCALES.values():
        if shutil.which("localedef") is None:
            raise Unavailable(f"no locale {locale}: localedef is not installed")
        made = subprocess.run(["localedef", "-f", "UTF-8", "-i", locale.split(".")[0],
                               os.path.join(folder.name, locale)], capture_output=True, check=False)
        if not os.path.isdir(os.path.join(folder.name, locale)):
            raise Unavailable(f"no locale {locale}: {made.stderr.decode().strip()}")
    return folder


@around
def in_locale(_folder, name):
    yield {"env": {**os.environ, "LOCPATH": folder_of_locales().name, "LC_ALL": name, "LANG": name}}


@around
def in_zone(_folder, zone):
    yield {"env": {**os.environ, "TZ": zone}}


@around
def with_umask(_folder, mask):
    yield {"umask": mask}


def content_of(folder, name):
    with open(os.path.join(folder, name), "rb") as file:
        return file.read()


def holds(name, expected, mode=None):
    """A check that, after the run, a file has this content and this mode."""
    def check(folder):
        if content_of(folder, name) != expected:
            return f"{name} holds {content_of(folder, name)[:100]!r}"
        found = os.stat(os.path.join(folder, name)).st_mode & 0o777
        return "" if mode in (None, found) else f"{name} has mode {found:o}"
    return check


def refused(row, name, *arguments, code, message, named, program=BARCODE, files=FILE, **others):
    return Entry(row, name, program, arguments, code, message, named, files, **others)


def squares(row, name, *arguments, program=BARCODE, files=FILE, output=SQUARE_BARS, **others):
    """An entry whose input, a square, must be read correctly despite the unusual circumstances."""
    return Entry(row, name, program, arguments, 0, files=files, output=output, **others)


def inputs():
    for program in (BARCODE, SEGMENT):
        for path in (".", "..", "/", "folder/"):
            yield refused(51, f"{program} {path}", path, code=66, message="it is a directory",
                          named=path, program=program, around=with_folder("folder"))
        yield refused(54, f"{program}: missing", "missing.txt", code=66, message="No such file",
                      named="missing.txt", program=program)
        yield refused(54, f"{program}: a file as a folder", "square.txt/more", code=66,
                      message="Not a directory", named="square.txt/more", program=program)
        yield refused(54, f"{program}: no permission", "square.txt", code=66, message="Permission",
                      named="square.txt", program=program, unprivileged=True,
                      around=with_mode("square.txt", 0))
        yield refused(54, f"{program}: a link to nothing", "link.txt", code=66, message="No such file",
                      named="link.txt", program=program, around=with_link("nothing", "link.txt"))
        yield refused(54, f"{program}: a link to itself", "link.txt", code=66, message="link",
                      named="link.txt", program=program, around=with_link("link.txt", "link.txt"))
        yield refused(53, f"{program}: /dev/zero", "/dev/zero", code=65, message="only NUL bytes in the first MiB",
                      named="/dev/zero", program=program, around=with_device("/dev/zero"))
        yield refused(53, f"{program}: /dev/zero as standard input", "-", code=65,
                      message="only NUL bytes in the first MiB", named="<stdin>", program=program,
                      around=from_device("/dev/zero"))
        yield refused(53, f"{program}: /dev/urandom", "/dev/urandom", code=65,
                      message="not plain text", named="/dev/urandom", program=program,
                      around=with_device("/dev/urandom"))
        yield refused(52, f"{program}: faulty standard input", "-", code=65, message=":2:3: not a num",
                      named="<stdin>", program=program, around=with_stdin(b"0 0 1\n1 x 1\n"))
        yield refused(52, f"{program}: /dev/null", "/dev/null", code=65, message="no points",
                      named="/dev/null", program=program, around=with_device("/dev/null"))
    for name, words in (("npy", "not an NPY file"), ("png", "not a PNG file"),
                        ("dipha", "not a DIPHA file"), ("pgm", "not a PGM file"),
                        ("npz", "not an NPZ archive"), ("nifti", "not a NIfTI-1 file"),
                        ("nrrd", "not an NRRD file"), ("metaimage", "not a MetaImage"), ("vti", "not a VTI file"),
                        ("tiff", "not a TIFF file"),
                        ("pcd", "not a PCD file"), ("points", "not plain text"),
                        ("sparse", "not plain text"), ("simplices", "not plain text")):
        yield refused(53, f"/dev/urandom as {name}", "/dev/urandom", "--format", name, code=65,
                      message=words, named="/dev/urandom", around=with_device("/dev/urandom"))
    yield refused(53, "an endless stream that may be anything", "/dev/urandom", "--format", "binary",
                  "--memory-limit", "32MiB", code=75, message="larger than the memory limit",
                  named="/dev/urandom", around=with_device("/dev/urandom"))
    yield refused(51, "--values is a directory", "edge.phat", "--values", ".", code=66,
                  message="it is a directory", named=".", files={"edge.phat": b"0\n0\n1 0 1\n"})
    yield refused(54, "--values is missing", "edge.phat", "--values", "no.txt", code=66,
                  message="No such file", named="no.txt", files={"edge.phat": b"0\n0\n1 0 1\n"})
    yield refused(54, "--depth is missing", "--depth", "no.png", "--intrinsics", "1,1,0,0", code=66,
                  message="No such file", named="no.png", program=SEGMENT)
    yield squares(52, "standard input", "-", around=with_stdin(SQUARE.encode()))
    yield squares(52, "a file as standard input", "-", around=from_file("square.txt"))
    yield squares(52, "/dev/stdin", "/dev/stdin",
                  around=with_standard_input_file(SQUARE.encode()))
    yield squares(52, "a FIFO", "fifo", around=with_fifo("fifo", SQUARE.encode()))
    yield refused(52, "a FIFO that ends in a row", "fifo", code=65, message="ragged row", named="fifo",
                  around=with_fifo("fifo", b"0 0\n1"))


def outputs():
    yield refused(55, "-o /proc/out.csv", "square.txt", "-o", "/proc/out.csv", code=73, message=".",
                  named="/proc/out.csv", around=with_proc())
    for path in ("missing/out.csv", "square.txt/out.csv", ".", "x" * 300, "/dev/null/out.csv"):
        yield refused(55, f"-o {path[:20]}", "square.txt", "-o", path, code=73, message=".",
                      named=path[:200])
    yield refused(55, "--plot missing/out.svg", "square.txt", "--plot", "missing/out.svg", code=73,
                  message=".", named="missing/out.svg")
    for option, path in (("-o", "missing/out.pcd"), ("--labels", "missing/out.npy"),
                         ("--json", "missing/out.json"), ("--barcode", "missing/out.csv"),
                         ("--plot", "missing/out.svg"), ("--coloured", "missing/out.ply")):
        yield refused(55, f"ph-segment {option}", "cloud.xyz", option, path, code=73, message=".",
                      named=path, program=SEGMENT, files={"cloud.xyz": b"0 0 1\n1 0 1\n"})
    yield refused(56, "a folder without write permission", "square.txt", "-o", "closed/out.csv",
                  code=73, message="Permission", named="closed/out.csv", unprivileged=True,
                  around=with_folder("closed", 0o555))
    yield refused(56, "ph-segment: a folder without write permission", "cloud.xyz", "-o",
                  "closed/out.pcd", code=73, message="Permission", named="closed/out.pcd",
                  program=SEGMENT, files={"cloud.xyz": b"0 0 1\n1 0 1\n"}, unprivileged=True,
                  around=with_folder("closed", 0o555))
    done = SQUARE_BARS.encode()
    square = holds("square.txt", SQUARE.encode())
    yield refused(57, "the input", "square.txt", "-o", "square.txt", "--output-format", "csv",
                  code=64, message="--force", named="--output", after=square)
    yield refused(57, "a link to the input", "square.txt", "-o", "link.csv", code=64,
                  message="is the input square.txt", named="--output",
                  around=with_link("square.txt", "link.csv"), after=square)
    yield squares(57, "the input, by force", "square.txt", "-o", "square.txt", "--output-format", "csv",
                  "--force", output="", after=holds("square.txt", done))
    faulty = b"0 0\n1 0\n1\n"
    yield refused(57, "a faulty input", "bad.txt", "-o", "bad.txt", "--output-format", "csv",
                  "--force", code=65,
                  message="ragged row", named="bad.txt", files={"bad.txt": faulty},
                  after=holds("bad.txt", faulty))
    yield refused(58, "standard output", "square.txt", "-o", "-", code=74, message="No space",
                  named="ph-barcode", around=to_device("/dev/full"))
    for option in ("--help", "--version", "--formats"):
        yield refused(58, option, option, "-o", "-", code=74, message="No space", named="ph-barcode",
                      around=to_device("/dev/full"))
    yield refused(58, "-o /dev/full", "square.txt", "-o", "/dev/full", code=74, message="No space",
                  named="/dev/full", around=with_device("/dev/full"))
    yield refused(58, "ph-segment: --labels /dev/full", "cloud.xyz", "-o", "-", code=74,
                  message="No space", named="ph-segment", program=SEGMENT,
                  files={"cloud.xyz": b"0 0 1\n1 0 1\n"}, around=to_device("/dev/full"))
    yield refused(59, "standard output", "square.txt", "-o", "-", code=74, message="", named="",
                  around=to_nobody())
    yield refused(59, "ph-segment", "cloud.xyz", "-o", "-", code=74, message="", named="",
                  program=SEGMENT, files={"cloud.xyz": b"0 0 1\n1 0 1\n"}, around=to_nobody())
    old = {"out.csv": b"old", "bad.txt": faulty, **FILE}
    yield refused(60, "a failure leaves it", "bad.txt", "-o", "out.csv", code=65, message="ragged",
                  named="bad.txt", files=old, after=holds("out.csv", b"old"))
    yield squares(60, "it is replaced", "square.txt", "-o", "out.csv", files=old, output="",
                  after=holds("out.csv", done))
    yield squares(60, "it keeps its mode", "square.txt", "-o", "out.csv", files=old, output="",
                  around=with_mode("out.csv", 0o640), after=holds("out.csv", done, 0o640))


def names():
    for row, name, printed in (
            (77, b"new\nline.txt", r"new\nline.txt"), (77, b"a\r.txt", r"a\r.txt"),
            (77, b"\x1b[31m.txt", r"\x1B[31m.txt"), (77, b"tab\t.txt", r"tab\t.txt"),
            (78, b"<script>.txt", "<script>.txt"), (78, b"a&b\"'.txt", "a&b\"'.txt"),
            (79, b"%s%n%99999d.txt", "%s%n%99999d.txt"), (79, b"{}{0}.txt", "{}{0}.txt"),
            (80, b"\xff\xfe.txt", r"\xFF\xFE.txt"), (80, "é\u202e.txt".encode(), "é"),
            (80, b"x" * 251 + b".txt", "x" * 251)):
        yield refused(row, f"missing {printed[:30]}", name, code=66, message=".", named=printed,
                      files={})
        yield refused(row, f"faulty {printed[:30]}", name, code=65, message=":2:3: not a number",
                      named=printed, files={name: b"0 0\n1 x\n"})
        yield squares(row, f"valid {printed[:30]}", name, "--quiet", files={name: SQUARE.encode()})
    yield refused(80, "4096 bytes", "y" * 4096, code=66, message="too long", named="y" * 4000)
    yield refused(80, "-leading dash", "./-x", code=66, message="No such file", named="./-x")


def surroundings():
    for row, locale in LOCALES.items():
        inside = in_locale(locale)
        # The names of formats and extensions contain the letter i, whose upper case differs in
        # Turkish.
        yield squares(row, locale, "SQUARE.TXT", "--quiet", files={"SQUARE.TXT": SQUARE.encode()},
                      around=inside)
        yield squares(row, f"{locale}, an extension in capitals", "A.NII", "--quiet",
                      files={"A.NII": nifti("|u1", (3, 2), [1] * 6)}, output=bars("0,1,inf"), around=inside)
        yield refused(row, f"{locale}, a decimal comma", "c.txt", code=65, message="decimal point",
                      named="c.txt", files={"c.txt": b"0,5 1,5\n"}, around=inside)
    for zone in ("X", "Asia/Kathmandu", ":/dev/full"):
        yield squares(82, zone, "square.txt", "--quiet", around=in_zone(zone))
    for mask, mode in ((0o027, 0o640), (0o077, 0o600), (0, 0o666)):
        yield squares(83, f"{mask:03o}", "square.txt", "-o", "out.csv", output="", creates=("out.csv",),
                      around=with_umask(mask), after=holds("out.csv", SQUARE_BARS.encode(), mode))


ENTRIES = [*inputs(), *outputs(), *names(), *surroundings()]
