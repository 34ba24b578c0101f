#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that the binary interface of libph_c.so still fits programs that were linked with it:
abi.py --library FILE.so.

`abidiff` compares the library with ph_c.abi, which `abidw` wrote for an older library. Functions
and enumerators may be added. ph_options may grow at its end, because its member `size` tells the
library which members the caller knows. Any other change needs a new PH_ABI_VERSION and a new
ph_c.abi, which `abi.py --library FILE.so --write` writes; `ctest -R packages.abi -V` shows the name
of the file.

--plant changes ph_c.abi, as if the older library had been different. It requires that changes that
break programs are found and that other changes pass.
"""
import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
HEADERS = HERE.parents[1] / "libph/include/ph"
BASELINE = HERE / "ph_c.abi"
OPTIONS = re.compile(r"<class-decl name='ph_options' size-in-bits='(\d+)'.*?</class-decl>", re.S)
MEMBER = re.compile(r" *<data-member access='public' layout-offset-in-bits='(\d+)'>.*?</data-member>\n",
                    re.S)


def description_of(library):
    """The functions and the types that ph.h declares, as XML."""
    with tempfile.NamedTemporaryFile(suffix=".abi") as file:
        subprocess.run(["abidw", "--headers-dir", HEADERS, "--no-corpus-path", "--no-comp-dir-path",
                        "--no-show-locs", "--drop-private-types", "--exported-interfaces-only",
                        "--out-file", file.name, library], check=True)
        text = Path(file.name).read_text()
    return re.sub(r" path='[^']*ph\.cpp'", "", text)


def with_members(text, count, size):
    """The description with only the first members of ph_options."""
    body = OPTIONS.search(text)
    kept = body[0]
    for member in list(MEMBER.finditer(body[0]))[count:]:
        kept = kept.replace(member[0], "")
    return text.replace(body[0], kept.replace(f"'{body[1]}'", f"'{size}'", 1))


def without_new_enumerators(now, before):
    for name, body in re.findall(r"<enum-decl name='(\w+)'(.*?)</enum-decl>", now, re.S):
        known = re.search(rf"<enum-decl name='{name}'(.*?)</enum-decl>", before, re.S)
        if known:
            old = set(re.findall(r"<enumerator name='(\w+)'", known[1]))
            kept = "".join(line for line in body.splitlines(keepends=True)
                           if not (new := re.search(r"<enumerator name='(\w+)'", line))
                           or new[1] in old)
            now = now.replace(body, kept)
    return now


def difference(before, now):
    """@return the output of abidiff, and whether it found a change that breaks programs."""
    old, new = OPTIONS.search(before), OPTIONS.search(now)
    known = len(MEMBER.findall(old[0]))
    if len(MEMBER.findall(new[0])) > known and int(new[1]) > int(old[1]):
        now = with_members(now, known, old[1])
    now = without_new_enumerators(now, before)
    with tempfile.TemporaryDirectory() as folder:
        files = Path(folder, "before.abi"), Path(folder, "now.abi")
        for file, text in zip(files, (before, now)):
            file.write_text(text)
        done = subprocess.run(["abidiff", "--no-added-syms", "--harmless", *files],
                              capture_output=True, text=True, check=False)
    if done.returncode & 3:
        sys.exit(f"abi.py: abidiff failed: {done.stderr}")
    return done.stdout, done.returncode != 0


def of_another_type(text):
    wide = re.search(r"<var-decl name='threshold' type-id='([^']+)'", text)[1]
    return re.sub(r"(<var-decl name='max_dim' type-id=')[^']+'", rf"\g<1>{wide}'", text, count=1)


def one_member_less(text):
    members = list(MEMBER.finditer(OPTIONS.search(text)[0]))
    return with_members(text, len(members) - 1, members[-1][1])


def two_members_swapped(text):
    body = OPTIONS.search(text)[0]
    return text.replace(body, body.replace("'min_dim'", "'?'").replace("'max_dim'", "'min_dim'")
                        .replace("'?'", "'max_dim'"))


def replaced(old, new):
    return lambda text: re.sub(old, new, text, count=1)


# Changes of ph_c.abi, and whether each one breaks programs linked with the old library.
PLANTED = [
    ("a function is gone", replaced(r"(<elf-symbol name=')ph_version('[^\n]*\n)",
                                    r"\1ph_version\2    \1ph_older\2"), True),
    ("a function is new", replaced(r" *<elf-symbol name='ph_version'[^\n]*\n", ""), False),
    ("an argument is new", replaced(r" *<parameter [^\n]*name='row_stride'/>\n", ""), True),
    ("an enumerator has another number",
     replaced(r"(<enumerator name='PH_BAD_DATA' value=')2'", r"\g<1>7'"), True),
    ("an enumerator is gone",
     replaced(r"( *<enumerator name=')PH_INTERNAL(' value=')5('/>\n)", r"\g<0>\1PH_OLDER\g<2>6\3"), True),
    ("an enumerator is new", replaced(r" *<enumerator name='PH_FLOAT64'[^\n]*\n", ""), False),
    ("a member lies elsewhere",
     replaced(r"(layout-offset-in-bits=')96('>\n *<var-decl name='min_dim')", r"\g<1>128\2"), True),
    ("a member has another name", replaced("name='minkowski_p'", "name='exponent'"), True),
    ("a member is of another type", of_another_type, True),
    ("two members of one type are swapped", two_members_swapped, True),
    ("a member is new, at the end", one_member_less, False),
]


def plant(now):
    before, wrong = BASELINE.read_text(), 0
    for name, change, breaks in PLANTED:
        changed = change(before)
        if changed == before:
            sys.exit(f"abi.py: {name}: cannot be planted")
        said, found = difference(changed, now)
        if found != breaks:
            print(f"{name}: {'found' if found else 'not found'}\n{said}")
            wrong += 1
    print(f"{len(PLANTED) - wrong} of {len(PLANTED)} changes judged rightly")
    return wrong


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--library", type=Path, required=True)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--plant", action="store_true")
    arguments = parser.parse_args()
    now = description_of(arguments.library)
    if arguments.write:
        BASELINE.write_text(now)
    elif arguments.plant:
        sys.exit(1 if plant(now) else 0)
    else:
        said, found = difference(BASELINE.read_text(), now)
        print(said if found else "no change that breaks programs")
        sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
