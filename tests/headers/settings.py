#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that texts of the libraries mention settings instead of options, and that each setting is
an option of a program: settings.py ROOT.

A library does not know which program calls it: its messages mark a Setting of ph/error.hpp, and the
program writes the setting as an option. The exit code is 0 if no text contains an option and each
setting is an option or is listed here.
"""
import re
import sys
from pathlib import Path

TEXT = re.compile(r'"(?:[^"\\\n]|\\.)*"')
OPTION = re.compile(r"(?<![\w!-])--[a-z]")

# Settings of C++ that are not options of any program.
NO_OPTIONS = {"cell", "patience", "plane_guess"}
# Settings whose options have other names; see apps/common/terminal/words.cpp.
OTHER_NAMES = {"spacing": "supervoxels", "first_meeting": "explain", "most_supports": "plane"}


def options_in_texts(root):
    for top in ("libph", "libsegment", "libreport"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix not in (".hpp", ".ipp", ".cpp", ".h", ".cu", ".mm"):
                continue
            for line, text in enumerate(path.read_text().splitlines(), 1):
                for match in TEXT.finditer(text):
                    is_comment = "//" in TEXT.sub("", text[:match.start()])
                    if not is_comment and OPTION.search(match[0]):
                        yield f"{path.relative_to(root)}:{line}: {match[0]}: expected a setting, " \
                              "mark(Setting::…)"


def settings(root):
    enum = re.search(r"enum class Setting[^{]*\{(.*?)\};",
                     (root / "libph/include/ph/error.hpp").read_text(), re.S)[1]
    return [name for name in re.findall(r"\w+", enum) if name != "none"]


def settings_without_options(root):
    texts = "".join(path.read_text() for path in (root / "apps").rglob("*.cpp"))
    for name in settings(root):
        option = "--" + OTHER_NAMES.get(name, name).replace("_", "-")
        is_there = re.search(rf'"(?:-\w,)?{option}["=,]', texts) is not None
        if is_there == (name in NO_OPTIONS):
            yield f"Setting::{name}: {'' if is_there else 'no '}option {option} in apps, which " \
                  f"{'NO_OPTIONS denies' if is_there else 'NO_OPTIONS does not say'}"


def main():
    root = Path(sys.argv[1]).resolve()
    found = [*options_in_texts(root), *settings_without_options(root)]
    print(*found, f"{len(settings(root))} settings, {len(found)} violations", sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
