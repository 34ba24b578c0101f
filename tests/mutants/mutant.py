# SPDX-License-Identifier: MIT
"""Mutants, which are faults to plant, and the places in the sources where they are planted.

A comment `// mutant: NAME` marks the place and names an anchor. It is at the end of a line, or
alone on the line above. The anchored statement begins with that line. It ends with the first line
that closes its brackets and ends in a semicolon, a comma or a brace. Each anchor occurs once in the
sources. Several mutants may use the same anchor.
"""
import itertools
import re
from typing import NamedTuple

ANCHOR = re.compile(r"// mutant: ([a-z0-9-]+)$", re.MULTILINE)
ANCHOR_AND_SPACE = re.compile(r"^[ \t]*// mutant: [a-z0-9-]+\n|[ \t]*// mutant: [a-z0-9-]+$", re.MULTILINE)
COMMENT_OR_LITERAL = re.compile(
    r"""//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\w)'(?:\\.|[^'\\\n])+'""", re.DOTALL)
BRACKET_OR_END = re.compile(r"[(\[]|[)\]]|[;,{}](?= *\n)")


class NotPlanted(Exception):
    """The sources have changed, and the mutant must be adapted."""


class Mutant(NamedTuple):
    name: str
    anchor: str
    old: str  # occurs once in the anchored statement; empty: the whole statement
    new: str  # replaces the old text
    test: str  # must fail: a test program, or the name of a test
    targets: list  # the targets to build for the test


def found_by(test, faults, targets=None):
    """@param faults the name, anchor, old text and new text of each fault; or name, anchor and a
    new statement.
    @return mutants that the test must find."""
    return [Mutant(name, anchor, "".join(old), new, test, targets or [test]) for name, anchor, *old, new in faults]


def find_anchors(root):
    """@return for each anchor in libraries and programs, the files that contain it, relative to
    root."""
    found = {}
    for folder in (root / "apps", *sorted(root.glob("lib*"))):
        for file in sorted(folder.rglob("*.[chi]pp")):
            for anchor in ANCHOR.findall(file.read_text()):
                found.setdefault(anchor, []).append(file.relative_to(root))
    return found


def find_statement(text, begin):
    """@return begin and end of the statement that begins with the line at `begin`."""
    code = COMMENT_OR_LITERAL.sub(lambda m: (" " if m[0][0] == "/" else "x") * len(m[0]), text)
    begin += len(code[begin:]) - len(code[begin:].lstrip())
    depth = 0
    for m in BRACKET_OR_END.finditer(code, begin):
        if m[0] in "([":
            depth += 1
        elif m[0] in ")]":
            depth -= 1
        elif depth <= 0 or m[0] in "{}":
            return begin, m.end()
    return begin, len(text)


def plant(root, mutant, anchors):
    """@param anchors the result of find_anchors. @return the file, and its text with the fault and
    without anchors."""
    files = anchors.get(mutant.anchor, [])
    if len(files) != 1:
        raise NotPlanted(f"the anchor {mutant.anchor} occurs {len(files)} times")
    text = (root / files[0]).read_text()
    line = re.search(rf"^.*// mutant: {mutant.anchor}$", text, re.MULTILINE).start()
    line = len(ANCHOR_AND_SPACE.sub("", text[:line]))
    text = ANCHOR_AND_SPACE.sub("", text)
    begin, end = find_statement(text, line)
    if mutant.old:
        # The formatter may have moved the line breaks.
        old = re.compile(r"\s+".join(re.escape(word) for word in mutant.old.split()))
        found = list(itertools.takewhile(lambda m: m.start() < end, old.finditer(text, begin)))
        if len(found) != 1:
            raise NotPlanted(f"{mutant.old!r} occurs {len(found)} times at {mutant.anchor} in {files[0]}")
        begin, end = found[0].span()
    return files[0], text[:begin] + mutant.new + text[end:]
