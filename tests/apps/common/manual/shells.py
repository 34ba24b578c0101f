# SPDX-License-Identifier: MIT
"""Runs shells at a terminal to test completion."""
import os
import pty
import re
import select
import signal
import subprocess
import struct
import termios
import time
import fcntl

PATIENCE = 30  # seconds
TAB, KILL_LINE, ENTER = b"\t", b"\x15", b"\r"


class Terminal:
    """A shell at a pseudo-terminal, which behaves as if somebody were typing."""

    def __init__(self, command, folder, environment):
        self.pid, self.descriptor = pty.fork()
        if self.pid == 0:
            os.chdir(folder)
            os.execvpe(command[0], command, environment)
        fcntl.ioctl(self.descriptor, termios.TIOCSWINSZ, struct.pack("HHHH", 200, 400, 0, 0))
        self.asked = 0

    def close(self):
        os.close(self.descriptor)
        os.kill(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)

    def type(self, keys):
        os.write(self.descriptor, keys)

    def read_until(self, pattern):
        """All output up to the first match of a pattern."""
        shown, end = b"", time.monotonic() + PATIENCE
        while not re.search(pattern, shown):
            if not select.select([self.descriptor], [], [], max(0, end - time.monotonic()))[0]:
                raise TimeoutError(f"no {pattern!r} in {shown.decode(errors='replace')!r}")
            shown += os.read(self.descriptor, 65536)
        return shown

    def run(self, line):
        """Types a command and waits until it is done. The command prints a word that the typed text
        contains only in a different form. This word distinguishes the command's output from the
        echo of the typed text."""
        self.asked += 1
        self.type(line.encode() + b"; echo an''swer" + str(self.asked).encode() + ENTER)
        return self.read_until(b"answer%d\r?\n" % self.asked)

    def complete(self, line, seconds):
        """What the shell prints for a TAB after a line: candidates, or the completed line.
        @param seconds how long to wait for the shell's answer before the next key, which would
        suppress the answer."""
        self.type(line.encode() + TAB)
        time.sleep(seconds)
        self.type(KILL_LINE)
        shown = self.run(" true").decode(errors="replace")
        return re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]|\x1b[=>]|[\0\x07\r]", "", shown)


def environment(folder):
    return {"PATH": os.environ["PATH"], "HOME": folder, "TERM": "vt100", "LC_ALL": "C.UTF-8",
            "PS1": "> ", "INPUTRC": "/dev/null", "ZDOTDIR": folder}


class Bash(Terminal):
    def __init__(self, folder, script):
        super().__init__(["bash", "--norc", "--noprofile", "-i"], folder, environment(folder))
        for setting in ("show-all-if-ambiguous on", "completion-query-items 0", "bell-style none",
                        "page-completions off", "enable-bracketed-paste off"):
            self.run(f"bind 'set {setting}'")
        self.run(f"source {script}")


class Zsh(Terminal):
    """Zsh finds the completion script by its name in a folder, as in an installation."""

    def __init__(self, folder, script):
        super().__init__(["zsh", "-f", "-i"], folder, environment(folder))
        self.run("unsetopt beep list_ambiguous; setopt no_always_last_prompt; bindkey -e")
        self.run("LISTMAX=100000; unset zle_bracketed_paste")
        self.run(f"fpath=({os.path.dirname(script)} $fpath); autoload -U compinit; "
                 f"compinit -u -d {folder}/dump")


class Fish:
    """Fish prints its completions on request."""

    def __init__(self, folder, script):
        self.folder, self.script = folder, script

    def close(self):
        pass

    def complete(self, line, _seconds):
        return subprocess.run(["fish", "--no-config", "-c",
                               f"source {self.script}; complete -C '{line}'"], cwd=self.folder,
                              env={**environment(self.folder), "XDG_DATA_HOME": self.folder},
                              capture_output=True, text=True, timeout=PATIENCE, check=True).stdout
