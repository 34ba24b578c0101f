# SPDX-License-Identifier: MIT
"""run_corpus.py PH_BARCODE PH_SEGMENT PH_DISTANCE PH_VECTORISE PH_CLUSTER PEAK [WORDS…]: runs every entry of
the corpus (with WORDS, only the entries whose name contains them) in a separate folder. It checks
the promises about faulty inputs: the exit code, one line on stderr that names the file or the
option, nothing on stdout, nothing written, no temporary file, an end within a second, and at most
16 MiB and 50 ms if a header is false. PEAK is the program built from peak.c."""
import collections
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import corpus
from entry import FRUGAL_ROWS, ROWS, Unavailable, set_up

SECONDS = 1  # CPU seconds; on a busy machine, the wall-clock time may be ten times as long
TRIES = 3  # only for times: a busy machine is slow now and then, a slow program every time
FRUGAL_KIB, FRUGAL_MICROSECONDS = 16 << 10, 50_000
NOBODY = 65534
PAGES = "README.md", "docs/explanation/reliability.md"  # these pages state the number of entries
OUTPUT = {"ph-barcode": "out.csv", "ph-segment": "out.pcd", "ph-distance": "out.csv",
          "ph-vectorise": "out.csv", "ph-cluster": "out.csv"}


def named_options(text):
    return re.findall(r"(?<![\w!-])--[a-z][a-z0-9-]*[a-z0-9]", text)


def options_of(program):
    """The options listed in the help of a program."""
    return set(named_options(subprocess.run([program, "--help", "all"], capture_output=True,
                                            text=True, timeout=60, check=True).stdout))


class Runner:
    def __init__(self, *programs, peak):
        self.programs = {os.path.basename(path): os.path.abspath(path) for path in programs}
        self.peak = os.path.abspath(peak)
        self.options = {name: options_of(program) for name, program in self.programs.items()}
        with open(programs[0], "rb") as file:
            content = file.read()
        # Instrumentation also needs memory and time.
        self.is_watched = b"__asan_init" in content or b"__gcov_exit" in content
        self.obstacle = self.let_nobody_in() if os.geteuid() == 0 else None

    def let_nobody_in(self):
        """Copies the programs to a place where another user can start them, because they may be in
        a folder that only root can read. @return the reason why no other user can start them; empty
        if one can."""
        self.copies = tempfile.TemporaryDirectory()  # removed with the runner
        os.chmod(self.copies.name, 0o755)
        self.programs = {name: shutil.copy(path, self.copies.name)
                         for name, path in self.programs.items()}
        self.peak = shutil.copy(self.peak, self.copies.name)
        try:
            for path in self.programs.values():
                subprocess.run([path, "--version"], user=NOBODY, group=NOBODY, extra_groups=[],
                               cwd="/", capture_output=True, timeout=60, check=True)
        except (OSError, subprocess.SubprocessError) as error:
            return f"no other user may start the programs: {error}"
        return None

    def faults(self, entry):
        """@return what is wrong with the entry's outcome; empty if nothing is. @throws Unavailable
        if the entry cannot be tested here."""
        if entry.unprivileged and self.obstacle:
            raise Unavailable(self.obstacle)
        for _ in range(TRIES):
            fault, of_time = self.try_once(entry)
            if not of_time:
                break
        return fault

    def try_once(self, entry):
        """@return what is wrong, and True if the only fault is that the run took too long."""
        with set_up(entry) as (folder, options):
            if entry.unprivileged and os.geteuid() == 0:
                os.chmod(os.path.dirname(folder), 0o755)
                os.chown(folder, NOBODY, NOBODY)
                options = {**options, "user": NOBODY, "group": NOBODY, "extra_groups": []}
            return self.run_in(folder, entry, options)

    def run_in(self, folder, entry, options):
        before = sorted(os.listdir(os.fsencode(folder)))
        report = os.path.join(os.path.dirname(folder), "report")
        with open(report, "wb"):
            os.chmod(report, 0o666)  # another user must be able to write it
        arguments = list(entry.arguments)
        if entry.code != 0:
            if "-o" not in arguments:
                arguments[:0] = ["-o", OUTPUT[entry.program]]
            arguments.insert(0, "--quiet")  # without other messages, stderr has only the failure
        options = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE,
                   "stderr": subprocess.PIPE, **options}
        content = options.pop("input", None)
        if content is not None:
            options["stdin"] = subprocess.PIPE
        start = time.monotonic()
        with subprocess.Popen([self.peak, report, self.programs[entry.program], *arguments],
                              cwd=folder, **options) as run:
            try:
                out, err = run.communicate(content, timeout=20)
            except subprocess.TimeoutExpired:
                run.kill()
                return "it hangs", False
        seconds = time.monotonic() - start
        wrong = self.result_faults(entry, run.returncode, out or b"", err or b"")
        wrong += self.unknown_options(entry, (err or b"").decode("utf-8", "replace"))
        after = sorted(os.listdir(os.fsencode(folder)))
        expected = sorted({*before, *map(os.fsencode, entry.creates)})
        if after != expected:
            wrong.append(f"the folder holds {after}, expected {expected}")
        if entry.after and (fault := entry.after(folder)):
            wrong.append(fault)
        if wrong:
            return "; ".join(wrong), False
        with open(report, encoding="ascii") as file:
            kib, microseconds = map(int, file.read().split())
        return self.cost_fault(entry, seconds, kib, microseconds)

    def unknown_options(self, entry, message):
        """Options that a message recommends although the program lacks them. Text typed by the user
        may contain anything."""
        written = " ".join(map(os.fsdecode, entry.arguments))
        return [f"it names {option}, which {entry.program} has not: {message!r}"
                for option in sorted(set(named_options(message)) - self.options[entry.program])
                if option not in written]

    @staticmethod
    def result_faults(entry, code, out, err):
        wrong = []
        lines = err.decode("utf-8", "replace").split("\n")[:-1] if err else []
        if code != entry.code:
            wrong.append(f"exit code {code}, expected {entry.code}: {lines}")
        if err and not err.endswith(b"\n") or b"\x1b" in err or b"\xef\xbf\xbd" in err:
            wrong.append(f"stderr is not lines of plain UTF-8: {err!r}")
        try:
            err.decode("utf-8")
        except UnicodeDecodeError:
            wrong.append("stderr is not UTF-8")
        if entry.code != 0:
            if len(lines) != (1 if entry.message else 0):
                wrong.append(f"{len(lines)} lines on stderr: {lines}")
            if lines and not lines[0].startswith(entry.program + ": "):
                wrong.append(f"the line does not begin with the program: {lines[0]}")
            if lines and entry.named not in lines[0]:
                wrong.append(f"'{entry.named}' is not named: {lines[0]}")
            if out:
                wrong.append(f"a failure with output: {out[:100]!r}")
        elif entry.output is not None and out.decode("utf-8", "replace") != entry.output:
            wrong.append(f"output {out.decode('utf-8', 'replace')!r}, expected {entry.output!r}")
        if entry.message and not re.search(entry.message, "\n".join(lines)):
            wrong.append(f"no '{entry.message}' in {lines}")
        return wrong

    def cost_fault(self, entry, seconds, kib, microseconds):
        if self.is_watched:
            return "", False
        if microseconds > SECONDS * 1e6 or seconds > 10 * SECONDS:
            return f"{microseconds / 1e6:.2f} s of CPU, {seconds:.2f} s", True
        frugal = entry.row in FRUGAL_ROWS if entry.frugal is None else entry.frugal
        if frugal and kib > FRUGAL_KIB:
            return f"{kib} KiB, expected at most {FRUGAL_KIB}", False
        if frugal and microseconds > FRUGAL_MICROSECONDS:
            return f"{microseconds} us of CPU, expected at most {FRUGAL_MICROSECONDS}", True
        return "", False


def states_count(page, count):
    text = (pathlib.Path(__file__).parents[2] / page).read_text(encoding="utf-8")
    return f"{count:,}".replace(",", " ") in text


def main():
    runner = Runner(*sys.argv[1:6], peak=sys.argv[6])
    words = sys.argv[7:]
    entries = [entry for entry in corpus.ENTRIES if all(word in entry.name for word in words)]
    of_row = collections.Counter()
    faults = skipped = 0
    for entry in entries:
        try:
            fault = runner.faults(entry)
        except Unavailable as reason:
            skipped += 1
            print(f"skipped: row {entry.row}, {entry.name}: {reason}")
            continue
        of_row[entry.row] += 1
        if fault:
            faults += 1
            print(f"row {entry.row}, {entry.name}: {str(entry.arguments)[:300]}: {fault[:1000]}")
    for row, title in ROWS.items():
        print(f"{row:4}  {of_row[row]:4}  {title}")
    print(f"{sum(of_row.values())} entries in {len(of_row)} rows, {faults} faults, "
          f"{skipped} skipped")
    missing = [row for row in ROWS if not any(entry.row == row for entry in entries)]
    if missing and not words:
        print(f"rows without an entry: {missing}")
    stale = [page for page in PAGES if not words and not states_count(page, len(entries))]
    if stale:
        print(f"pages that do not say that there are {len(entries)} entries: {stale}")
    sys.exit(1 if faults or not of_row or (missing and not words) or stale else 0)


if __name__ == "__main__":
    main()
