#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the rules for pages: pages.py ROOT.

* A page has one title, in its first line, and can be reached from docs/index.md by links.
* Prose is at most 100 characters wide.
* A picture has an alternative text, and each picture in docs/images is shown on a page.
* A code block states its language. A block of Python, C, C++ or console commands is run by a test,
  or the preceding line says why not: <!-- not run: REASON -->.
* The C++ reference lists all public headers.
"""
import re
import sys
from pathlib import Path

FENCE = re.compile(r"^( *)(`{3,})(\S*)[^\n]*\n(.*?)^\1\2 *$", re.MULTILINE | re.DOTALL)
IMAGE = re.compile(r"!\[([^\]]*)\]\(([^)\s]+)\)")
LINK = re.compile(r"\]\(([^)\s]+)\)")
NOT_RUN = re.compile(r"<!-- not run: \S.*-->\n$")
WIDTH = 100
NOT_OURS = {"build", "node_modules", ".git", "violations", "out"}
CODE = {"python", "c", "cpp", "console"}


def pages_of(root):
    return sorted(page for page in root.rglob("*.md")
                  if not NOT_OURS & set(page.relative_to(root).parts))


def without_code(text):
    """Replaces each code block with the same number of empty lines."""
    return FENCE.sub(lambda match: "\n" * match[0].count("\n"), text)


def title_faults(text):
    titles = re.findall(r"^# +\S", without_code(text), re.MULTILINE)
    if not text.startswith("# ") or len(titles) != 1:
        yield "found no title in the first line, or several titles"


def is_prose(line):
    """True for prose. Tables, comments and unbreakable text may be wider."""
    return not line.lstrip().startswith(("|", "<!--", "!", "[![")) and " " in line.strip()


def width_faults(text):
    for number, line in enumerate(without_code(text).split("\n"), 1):
        if len(line) > WIDTH and is_prose(line):
            yield f"line {number}: found {len(line)} characters, expected at most {WIDTH}"


def picture_faults(text):
    for words, path in IMAGE.findall(without_code(text)):
        if not words.strip():
            yield f"{path}: found no alternative text"


def runs(language, code, page, compiled):
    """True if doctest, commands_in_pages.py or programs_in_pages.py runs the block."""
    if language == "python":
        return ">>> " in code
    if language == "console":
        return code.startswith("$ ")
    return language == "cpp" and "int main(" in code and page in compiled


def code_faults(text, page, compiled):
    for match in FENCE.finditer(text):
        line = text.count("\n", 0, match.start()) + 1
        language = match[3]
        if not language:
            yield f"line {line}: found a block of code without a language; `text` is one"
        if language in CODE and not runs(language, match[4], page, compiled) \
                and not NOT_RUN.search(text[:match.start()]):
            yield (f"line {line}: found a block of {language} that no test runs; "
                   "<!-- not run: REASON --> before it says why")


def reachable(start):
    """The pages that can be reached from a page by links, and the pictures that these pages
    show."""
    pages, pictures, ahead = set(), set(), [start]
    while ahead:
        page = ahead.pop()
        if page in pages or not page.exists():
            continue
        pages.add(page)
        for link in LINK.findall(without_code(page.read_text(encoding="utf-8"))):
            target = (page.parent / link.partition("#")[0]).resolve()
            if target.suffix == ".md":
                ahead.append(target)
            else:
                pictures.add(target)
    return pages, pictures


def compiled_pages(root):
    """The pages whose programs are compiled in the build."""
    lists = root / "tests/docs/CMakeLists.txt"
    return set(re.findall(r"^ph_page_programs\((\S+)", lists.read_text(), re.MULTILINE)) if lists.exists() else set()


def missing_headers(root):
    """Public headers that no page of the reference links to. ph.hpp is left out, because it only
    includes the others."""
    pages = " ".join(page.read_text(encoding="utf-8") for page in (root / "docs/reference/cpp").glob("*.md"))
    for folder in ("libph", "libsegment", "libsegment/pcl", "libreport"):
        for header in sorted((root / folder / "include/ph").rglob("*.h*")):
            path = header.relative_to(root).as_posix()
            if "detail" not in header.parts and header.name != "ph.hpp" and f"/{path})" not in pages:
                yield f"{path}: docs/reference/cpp does not have it"


def main():
    root = Path(sys.argv[1]).resolve()
    compiled = compiled_pages(root)
    pages = pages_of(root)
    found, shown = reachable(root / "docs/index.md")
    faults = [*missing_headers(root)]
    for page in pages:
        text, name = page.read_text(encoding="utf-8"), page.relative_to(root).as_posix()
        of_page = [*title_faults(text), *width_faults(text), *picture_faults(text),
                   *code_faults(text, name, compiled)]
        if name.startswith("docs/") and page not in found:
            of_page.append("docs/index.md does not lead to it")
        faults += [f"{name}: {fault}" for fault in of_page]
    for picture in sorted((root / "docs/images").rglob("*")):
        if picture.suffix in (".png", ".svg") and picture not in shown \
                and picture not in reachable(root / "README.md")[1]:
            faults.append(f"{picture.relative_to(root)}: no page shows it")
    print("\n".join([*faults, f"{len(pages)} pages, {len(faults)} faults"]))
    return 1 if faults or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
