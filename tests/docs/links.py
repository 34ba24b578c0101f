#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Follows each relative link in the Markdown files to its file and to its heading, and looks up
each path in backticks: links.py ROOT."""
import os
import re
import sys
from pathlib import Path

LINK = re.compile(r"\]\(([^)\s]+)\)|(?:href|src)=\"([^\"]+)\"")
BLOCK = re.compile(r"```.*?```", re.DOTALL)
SPAN = re.compile(r"`([^`\n]*)`")
PATH = re.compile(r"((?:[\w.+-]+/)*)[\w.+-]+\.(\w+)")
# File names with these extensions are looked up even without a folder. `ripser.h` belongs to
# another project.
OURS = {"cpp", "hpp", "ipp"}
# File names with these extensions are looked up in any folder.
SOURCES = OURS | {"c", "cmake", "h", "in", "md", "mjs", "py", "sh", "ts"}
NOT_OURS = {"build", "node_modules", ".git", "violations"}
# This page may name files that no longer exist.
HISTORY = "CHANGELOG.md"


def files_of(root):
    for folder, folders, names in os.walk(root):
        folders[:] = [name for name in folders if name not in NOT_OURS]
        yield from (Path(folder, name) for name in names)


def endings_of(files, root):
    """Each path below the root with all its endings: for a/b/c, also b/c and c."""
    return {"/".join(file.relative_to(root).parts[first:]) for file in files
            for first in range(len(file.relative_to(root).parts))}


def anchors_of(text):
    """The anchors that GitHub makes from the headings of a page."""
    found = set()
    for heading in re.findall(r"^#+ +(.*?)\s*$", BLOCK.sub("", text), re.MULTILINE):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        anchor = re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-")
        number = 0
        while (name := f"{anchor}-{number}" if number else anchor) in found:
            number += 1
        found.add(name)
    return found


def dead_links(root, page):
    for match in LINK.finditer(SPAN.sub("", BLOCK.sub("", page.read_text()))):
        link = match[1] or match[2]
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists():
            yield f"{page.relative_to(root)}: {link}: found no such file"
        elif anchor and target.suffix == ".md" and anchor not in anchors_of(target.read_text()):
            yield f"{page.relative_to(root)}: {link}: found no such heading"


def is_of_source(word, root):
    """True if the word is a path in this repository, such as `examples/data/stack.pcd`. In
    contrast, `out/a.csv` may be an example."""
    match = PATH.fullmatch(word)
    if not match:
        return False
    folder, end = match.groups()
    top = folder.split("/")[0]  # out/ is where scripts/demo.sh writes
    return end in OURS or bool(folder) and (end in SOURCES or top != "out" and (root / top).is_dir())


def dead_paths(root, page, endings):
    """The paths on a page that do not exist. A path may be the ending of a longer one, like
    `ph/rips.hpp`."""
    for span in SPAN.findall(BLOCK.sub("", page.read_text())):
        for word in span.split():
            if is_of_source(word, root) and word not in endings:
                yield f"{page.relative_to(root)}: `{word}`: found no such file"


def main():
    root = Path(sys.argv[1]).resolve()
    files = sorted(files_of(root))
    endings = endings_of(files, root)
    pages = [file for file in files if file.suffix == ".md"]
    dead = [line for page in pages for line in dead_links(root, page)]
    dead += [line for page in pages if page.name != HISTORY for line in dead_paths(root, page, endings)]
    print("\n".join([*dead, f"{len(pages)} pages, {len(dead)} dead links and paths"]))
    return 1 if dead or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
