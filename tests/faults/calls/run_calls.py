# SPDX-License-Identifier: MIT
"""run_calls.py python FOLDER | c LIBRARY [WORDS…]: runs senseless calls, each in a separate
process, and checks the exception or result and its message. FOLDER contains the Python package;
LIBRARY is libph_c.so. With WORDS, it runs only the calls whose text contains all of them."""
import collections
import os
import re
import signal
import sys

try:
    import numpy  # noqa: F401
except ModuleNotFoundError:
    print("SKIPPED: no numpy")
    sys.exit(77)

SECONDS = 20
# Words of the underlying tools, which mean nothing to users of the library.
FOREIGN = re.compile(r"incompatible function arguments|pybind|std::|not iterable|Unable to allocate")


def outcome(call):
    """The outcome of a call as text. The call runs in a child process, because a crash then does
    not end this script."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        signal.alarm(SECONDS)
        try:
            text = call()
        except BaseException as error:  # a call may raise anything
            text = f"{type(error).__name__}: {error}"
        os.write(writer, text.encode("utf-8", "backslashreplace")[:60_000])
        os._exit(0)
    os.close(writer)
    with os.fdopen(reader, "rb") as file:
        text = file.read().decode()
    status = os.waitpid(child, 0)[1]
    if status == 0:
        return text
    ended = signal.Signals(os.WTERMSIG(status)).name if os.WIFSIGNALED(status) else status
    return f"the process ended: {ended}" + (" (it hangs)" if ended == "SIGALRM" else "")


def fault(found, expected, words):
    """@param expected the name of an exception or status; "=" for no error. @return what is wrong,
    or nothing."""
    kind, separator, message = found.partition(": ")
    if not separator or kind != expected:
        return f"found {found[:300]!r}, expected {expected}"
    if not re.search(words, message):
        return f"no {words!r} in {message[:300]!r}"
    if expected != "=" and ("\n" in message or FOREIGN.search(message)):
        return f"words that say nothing to users: {message[:300]!r}"
    return ""


def main():
    kind, place, *words = sys.argv[1:]
    if kind == "python":
        import python_calls as table
    else:
        import c_calls as table
    call_of = table.prepared(place)
    rooms = collections.Counter()
    faults = 0
    for room, text, expected, message in table.CALLS:
        if not all(word in text for word in words):
            continue
        rooms[room] += 1
        wrong = fault(outcome(call_of(text)), expected, message)
        if wrong:
            faults += 1
            print(f"{room}: {text}: {wrong}")
    for room, count in rooms.items():
        print(f"{count:5}  {room}")
    print(f"{sum(rooms.values())} calls in {len(rooms)} rooms, {faults} faults")
    sys.exit(1 if faults or not rooms else 0)


if __name__ == "__main__":
    main()
