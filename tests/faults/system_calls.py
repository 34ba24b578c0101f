# SPDX-License-Identifier: MIT
"""system_calls.py PH_BARCODE PH_SEGMENT [STEP]: makes each system call fail, each time it is made.

strace counts the calls of a run. The script then runs the program again and again: the first call
fails, then the second, and so on, once with each error that the call may report. Whatever fails,
the run ends in time with a documented exit code. If the exit code is 0, the outputs equal the
outputs of a run without failures. Otherwise there is one error line, each output is complete or
absent, and nothing else is left in the folder. STEP: only every STEP-th call."""
import collections
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../support"))
import files  # noqa: E402
from program import has_page  # noqa: E402

ERRORS = {
    "read": ("EIO", "EINTR"), "pread64": ("EIO", "EINTR"), "write": ("EIO", "ENOSPC", "EINTR"),
    "openat": ("EACCES", "EMFILE", "EINTR"), "close": ("EIO", "EINTR"), "fsync": ("EIO", "EINVAL"),
    "fdatasync": ("EIO",), "rename": ("EACCES", "EXDEV"), "renameat2": ("EINVAL",), "linkat": ("EPERM", "EXDEV"),
    "unlink": ("EACCES",), "ftruncate": ("EIO",), "fchmod": ("EPERM",), "fchown": ("EPERM",),
    "mmap": ("ENOMEM",), "mremap": ("ENOMEM",), "munmap": ("EINVAL",), "madvise": ("EINVAL",),
    "mprotect": ("ENOMEM",), "fallocate": ("ENOSPC", "EOPNOTSUPP"), "clone3": ("EAGAIN",), "clone": ("EAGAIN",),
    "newfstatat": ("EACCES", "EIO"), "fstat": ("EIO",), "lseek": ("ESPIPE",), "fcntl": ("EINVAL",),
    "ioctl": ("EIO",), "poll": ("EINTR", "ENOMEM"), "pipe2": ("EMFILE",), "getrandom": ("ENOSYS",),
    "sysinfo": ("EFAULT",), "prlimit64": ("EPERM",), "getcwd": ("ENOENT",), "access": ("EACCES",),
    "readlink": ("EACCES", "EINVAL"), "sched_getaffinity": ("EINVAL",), "mkdir": ("EACCES",),
    "getdents64": ("EIO",), "statfs": ("EIO",), "statx": ("ENOSYS",), "rt_sigaction": ("EINVAL",),
    "clock_gettime": ("EINVAL",), "clock_nanosleep": ("EINVAL", "EINTR"), "sigaltstack": ("EPERM",)}
# If one of these calls fails, the program does not start, or the C library ends it. A failing brk
# returns the old end of the heap instead of an error, which strace cannot imitate; mmap is tested
# in its place.
OF_LIBC = {"brk", "execve", "arch_prctl", "set_tid_address", "set_robust_list", "rseq", "futex", "exit_group", "exit",
           "rt_sigprocmask", "rt_sigreturn", "sched_yield", "gettid", "getpid", "tgkill", "uname", "getuid",
           "geteuid", "getgid", "getegid", "umask", "restart_syscall"}
CODES = {0, 66, 69, 73, 74, 75}
POINTS = "0 0\n1 0\n1 1\n0 1.25\n"


def cloud():
    """A cloud of a table with a box on it, as a camera sees it."""
    rows = [(x / 100, y / 100, 0.9 if 10 <= x < 22 and 10 <= y < 22 else 1.0)
            for y in range(40) for x in range(40)]
    return f"VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {len(rows)}\nHEIGHT 1\n" \
           f"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(rows)}\nDATA ascii\n" + "".join(
               f"{x} {y} {z}\n" for x, y, z in rows)


# Inputs, preparatory commands, the program with its arguments, outputs.
Scene = collections.namedtuple("Scene", "name inputs before program arguments outputs")


def scenes(programs):
    values = [float((7 * i * i + i) % 23) for i in range(4096)]
    report = ["--report", "page.html"] if has_page(programs[0]) else []
    yield Scene("points to a table, a picture, a page", {"a.txt": POINTS}, [], 0,
                ["a.txt", "-o", "bars.csv", "--plot", "p.svg", *report, "--threads", "2"],
                ["bars.csv", "p.svg", *report[1:]])
    yield Scene("a mapped array to DIPHA, in slabs", {"a.npy": files.array((16, 16, 16), values, "<f4")}, [], 0,
                ["a.npy", "-o", "bars.dipha", "--slab-layers", "2", "--threads", "2"], ["bars.dipha"])
    yield Scene("packed text to standard output", {"a.txt": POINTS}, [["gzip", "-kn", "a.txt"]], 0,
                ["a.txt.gz", "--threads", "1"], [])
    yield Scene("a part that takes the place of another", {"a.npy": files.array((16, 256), values, "<f4"), "p.ph": "old"}, [], 0,
                ["a.npy", "--complex", "cubical", "--part", "1/2", "-o", "p.ph", "--force"], ["p.ph"])
    yield Scene("a folder to a folder", {"in/a.txt": POINTS, "in/b.txt": POINTS}, [], 0,
                ["in", "-o", "out/", "--threads", "2"], ["out/a.csv", "out/b.csv"])
    yield Scene("a scene to labels, objects, a picture", {"s.pcd": cloud()}, [], 1,
                ["s.pcd", "--labels", "l.npy", "-o", "o.pcd", "--plot", "p.svg", "--no-check"],
                ["l.npy", "o.pcd", "p.svg"])
    yield Scene("frames of a list", {"s.pcd": cloud(), "frames.txt": "s.pcd\ns.pcd\n"}, [], 1,
                ["--frames-from", "frames.txt", "--labels", "out/", "--no-check", "--quiet"],
                ["out/s.npy", "out/s-2.npy"])


def contents_of(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


class Run:
    def __init__(self, programs, scene, inject=None):
        with tempfile.TemporaryDirectory() as folder:
            here = pathlib.Path(folder)
            for name, content in scene.inputs.items():
                (here / name).parent.mkdir(exist_ok=True)
                (here / name).write_bytes(content if isinstance(content, bytes) else content.encode())
            for command in scene.before:
                subprocess.run(command, cwd=folder, check=True)
            self.old = contents_of(here)
            trace = ["-e", f"trace={inject[0]}", "-e", "inject={}:error={}:when={}".format(*inject)] if inject else []
            with tempfile.NamedTemporaryFile() as log:
                run = subprocess.run(["strace", "-f", "-o", log.name, *trace, programs[scene.program],
                                      *scene.arguments], cwd=folder, stdin=subprocess.DEVNULL,
                                     capture_output=True, timeout=20)
                self.trace = pathlib.Path(log.name).read_text(errors="replace")
            self.code, self.out = run.returncode, run.stdout
            self.lines = run.stderr.decode(errors="replace").splitlines()
            self.files = contents_of(here)
            self.left = sorted(set(self.files) - set(self.old) - set(scene.outputs))


def fault_of(run, whole, scene, name):
    """What is wrong with a run, or nothing."""
    if run.code == 127 and "loading shared libraries" in run.lines[-1]:
        return None  # the program did not start
    if run.code not in CODES:
        return f"found exit {run.code}, expected one of {sorted(CODES)}"
    if run.left and name != "unlink":
        return f"found {run.left} in the folder"
    # A batch reports at the end how many of its inputs failed.
    errors = [line for line in run.lines if line not in whole.lines and not line.endswith(" inputs failed")]
    for output in scene.outputs:
        content = run.files.get(output)
        if output.endswith(".html"):  # a report contains times
            is_whole = content is not None and content.rstrip().endswith(b"</html>")
        else:
            is_whole = content == whole.files[output]
        if not is_whole and (run.code == 0 or content != run.old.get(output)):
            return f"found {output} {'missing' if content is None else 'other than it is'}"
    if run.code == 0:
        return None if run.out == whole.out else "found another standard output"
    # If writing to standard error fails, the message is lost.
    return None if len(errors) == 1 or name == "write" else f"found {run.lines}, expected one error"


def main():
    programs = [str(pathlib.Path(p).resolve()) for p in sys.argv[1:3]]
    step = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    if not shutil.which("strace"):
        print("skipped: strace is not installed")
        sys.exit(77)
    probe = subprocess.run(["strace", "-e", "inject=getcwd:error=EIO", "true"], capture_output=True)
    if probe.returncode != 0:
        print("skipped: strace cannot look at programs here")
        sys.exit(77)
    faults, runs, codes, unknown = [], 0, collections.Counter(), set()
    for scene in scenes(programs):
        whole = Run(programs, scene)
        assert whole.code == 0, (scene.name, whole.lines)
        assert not whole.left, (scene.name, whole.left)
        calls = collections.Counter(re.findall(r"^\d+ +(\w+)\(", whole.trace, re.M))
        unknown |= set(calls) - set(ERRORS) - OF_LIBC
        for name in sorted(set(calls) & set(ERRORS)):
            for error in ERRORS[name]:
                for number in range(1, calls[name] + 1, step):
                    runs += 1
                    try:
                        run = Run(programs, scene, (name, error, number))
                        codes[run.code] += 1
                        fault = fault_of(run, whole, scene, name)
                        said = f"exit {run.code}; {run.lines[-1:]}"
                    except subprocess.TimeoutExpired:
                        fault, said = "found no end", "stopped"
                    if fault:
                        faults.append(f"{scene.name}: {name} {number} of {calls[name]}, {error}: {fault}; {said}")
                        print(faults[-1], flush=True)
    print(f"{runs} runs, ends: {dict(sorted(codes.items()))}; {len(faults)} faults")
    if unknown:
        print(f"calls that nothing was injected into: {sorted(unknown)}")
    sys.exit(1 if faults or unknown else 0)


if __name__ == "__main__":
    main()
