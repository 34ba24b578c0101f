# SPDX-License-Identifier: MIT
"""Measures programs: user and system CPU seconds, wall seconds, peak resident memory."""
import ctypes
import os
import re
import resource
import signal
import subprocess
import tempfile
from dataclasses import dataclass

SHORT = 0.05  # s: a shorter run is repeated often
LONG = 10.0  # s: a program whose runs have taken this time is not run again
WALL_OVER_CPU = 6  # the wall-clock limit of a run, as a multiple of its CPU limit
PR_SET_THP_DISABLE = 41  # from <linux/prctl.h>; the setting survives execve


@dataclass(frozen=True)
class Limits:
    """Limits of a run: CPU seconds, and bytes of private memory; None means no limit. If
    `small_pages` is true, the system provides memory in pages of 4 KiB, never of 2 MiB."""
    seconds: int = None
    memory: int = None
    small_pages: bool = False

    def apply(self):
        if self.seconds:
            resource.setrlimit(resource.RLIMIT_CPU, (self.seconds, self.seconds + 5))
        if self.memory:
            resource.setrlimit(resource.RLIMIT_DATA, (self.memory, self.memory))
        if self.small_pages:
            ctypes.CDLL(None).prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


@dataclass(frozen=True)
class Run:
    """The cost of one run. `outcome` is "ok" or the reason why the run failed: "time", "memory", or
    its exit status in words."""
    outcome: str
    user: float = 0.0
    system: float = 0.0
    wall: float = 0.0
    peak: float = 0.0  # MB (10⁶ bytes)

    @property
    def cpu(self):
        return self.user + self.system

    @property
    def ok(self):
        return self.outcome == "ok"


def _outcome(status, messages):
    code = os.waitstatus_to_exitcode(status)
    if code == 0:
        return "ok"
    if code == -signal.SIGXCPU:
        return "time"
    if code == 75 or re.search("bad_alloc|memory", messages, re.IGNORECASE):
        return "memory"
    return f"exit {code}" if code > 0 else signal.Signals(-code).name


class Meter:
    """Runs programs through `bench_run`, which reports the cost of each run.

    Each program is run `repeat` times, or until its runs have taken LONG seconds. A short program
    is repeated until its runs have taken `together` seconds.

    """

    def __init__(self, bench_run, limits=Limits(), repeat=3, together=0.5):
        self._bench_run, self._limits, self._repeat, self._together = bench_run, limits, repeat, together

    def run(self, command, stdout=subprocess.DEVNULL):
        """Runs a command once. @param stdout the file that receives its output (default: none)."""
        with tempfile.TemporaryFile("w+") as messages, tempfile.TemporaryFile("w+") as taken:
            process = subprocess.Popen([self._bench_run, str(taken.fileno()), *map(str, command)],
                                       stdin=subprocess.DEVNULL, stdout=stdout, stderr=messages,
                                       pass_fds=[taken.fileno()], preexec_fn=self._limits.apply,
                                       start_new_session=True)
            try:
                process.wait(self._limits.seconds and WALL_OVER_CPU * self._limits.seconds)
            except subprocess.TimeoutExpired:
                return Run("time")
            finally:
                if process.poll() is None:
                    os.killpg(process.pid, signal.SIGKILL)
                    process.wait()
            messages.seek(0)
            taken.seek(0)
            said, figures = messages.read(65536), taken.read().split()
        if process.returncode != 0 or len(figures) != 5:
            raise RuntimeError(f"{self._bench_run}: {said or process.returncode}")
        status, user, system, wall, peak = figures
        return Run(_outcome(int(status), said), float(user), float(system), float(wall), int(peak) / 1e6)

    def best(self, command):
        """The run that took the least CPU time; a failed run, if a run failed."""
        return self.best_in_turns([command])[0]

    def best_in_turns(self, commands):
        """The best run of each command. The commands take turns, because a slow minute of the
        machine then affects all of them."""
        taken = [[] for _ in commands]
        while waiting := [i for i, runs in enumerate(taken) if not self._enough(runs)]:
            for i in waiting:
                taken[i] += self._turn(commands[i])
        return [min(runs, key=lambda r: r.cpu) if runs[-1].ok else runs[-1] for runs in taken]

    def _turn(self, command):
        """Runs a command once. If the command is short, runs it several times until its share of
        the total time is used."""
        runs = [self.run(command)]
        while runs[-1].ok and runs[0].cpu < SHORT and sum(r.cpu for r in runs) < self._together / self._repeat:
            runs.append(self.run(command))
        return runs

    def _enough(self, runs):
        if not runs:
            return False
        if not runs[-1].ok:
            return True
        taken = sum(run.cpu for run in runs)
        if min(run.cpu for run in runs) < SHORT:
            return taken >= self._together and len(runs) >= self._repeat
        return len(runs) >= self._repeat or taken >= LONG
