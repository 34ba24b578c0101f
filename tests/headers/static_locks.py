#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Checks that no static variable of a function of libph has a lock: static_locks.py LIBRARY…

If a process forks while another of its threads holds such a lock, the child waits for it forever.
ph/detail/core/on_first_use.hpp says how to do without."""
import re
import subprocess
import sys

# A thread has its own guards for thread_local variables; they are not locks.
GUARD = re.compile(r"\bOBJECT\b.*\bguard variable for (ph::.*)")


def main():
    assert GUARD.search("1: 0 8 OBJECT LOCAL DEFAULT 4 guard variable for ph::f()::x")[1] == "ph::f()::x"
    symbols = subprocess.run(["readelf", "--symbols", "--wide", "--demangle", *sys.argv[1:]], check=True,
                             capture_output=True, text=True).stdout
    assert " ph::persistence(" in symbols, "the libraries have no symbols"
    found = sorted({match[1] for line in symbols.splitlines() if (match := GUARD.search(line))})
    for name in found:
        print(f"{name} has a lock: found a static variable of a function, expected "
              "ph::detail::OnFirstUse or a constexpr variable")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
