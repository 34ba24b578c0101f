#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lists the words on the pages that are neither in hunspell's British dictionary nor in words.txt:
spelling.py ROOT. words.txt has terms and names, one per line. Exit code 77: hunspell or its
dictionary is missing."""
import re
import shutil
import subprocess
import sys
from pathlib import Path

from pages import pages_of, without_code

WORDS = Path(__file__).with_name("words.txt")
# Text that is not prose: comments, code, link targets, addresses, file names, numbers with letters.
NO_PROSE = [re.compile(pattern, re.DOTALL) for pattern in (
    r"<!--.*?-->", r"`[^`]*`", r"\]\([^)]*\)", r"<[^>\n]*>", r"\bhttps?:\S+", r"\S*[/_@\\]\S*",
    r"\b\w+\.\w[\w.]*", r"\S*\d\S*", r"--?\w[\w-]*")]
WORD = re.compile(r"[^\W\d_]+(?:['’][^\W\d_]+)*")


def words_of(page):
    """Each word with the number of the first line where it occurs."""
    text = without_code(page.read_text(encoding="utf-8"))
    for pattern in NO_PROSE:
        text = pattern.sub(lambda match: " " + "\n" * match[0].count("\n"), text)
    found = {}
    for number, line in enumerate(text.split("\n"), 1):
        for word in WORD.findall(line):
            found.setdefault(word.replace("’", "'"), number)
    return found


def unknown(words):
    """The words that are missing from the dictionary."""
    result = subprocess.run(["hunspell", "-d", "en_GB", "-i", "utf-8", "-l"], input="\n".join(sorted(words)),
                            capture_output=True, text=True, check=False)
    if result.returncode != 0 or "Can't open" in result.stderr:
        print(f"skipped: {result.stderr.strip()}; scripts/setup.sh docs installs the dictionary")
        sys.exit(77)
    return set(result.stdout.split())


def main():
    root = Path(sys.argv[1]).resolve()
    if shutil.which("hunspell") is None:
        print("skipped: hunspell is missing; scripts/setup.sh docs installs it")
        return 77
    ours = set(WORDS.read_text(encoding="utf-8").split("\n")) - {""}
    pages = pages_of(root)
    words = {page: words_of(page) for page in pages}
    wrong = {word for word in unknown(set().union(*words.values()))
             if not {word, word.removesuffix("'s"), word.removesuffix("'s").lower()} & ours}
    faults = [f"{page.relative_to(root)}:{line}: {word}" for page in pages
              for word, line in words[page].items() if word in wrong]
    print("\n".join([*faults, f"{len(pages)} pages, {len(faults)} unknown words"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
