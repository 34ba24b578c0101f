#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the files of an archive of the sources: archive.py ROOT [ARCHIVE.tar.xz].

Without an archive, it checks what `git archive` would contain. The archive has all files in git,
except debian/ and hidden files in the root. It has no built files, except the report page and the
files of npm packages in it. Names and times do not reveal who made it. Exit code 77: the root is
not a git clone.
"""
import io
import re
import subprocess
import sys
import tarfile
from pathlib import Path

HIDDEN = {".clang-format", ".clang-tidy"}
BUILT = re.compile(r"(^|/)(build|dist|out|__pycache__)/|\.(a|o|so|pyc|whl|deb|log)$|(^|/)[^/]*~$")
PAGE = {"viewer/build/report-template.html", "viewer/build/report-template.inputs"}


def git(root, *arguments):
    return subprocess.run(["git", "-C", root, *arguments], capture_output=True, check=True).stdout


def is_wanted(name):
    return name in HIDDEN or not name.startswith((".", "debian/"))


def faults_of(root, archive, has_page):
    top = {member.name.split("/")[0] for member in archive}
    if len(top) != 1 or not re.fullmatch(r"libph-\d+\.\d+\.\d+", *top):
        yield f"found {sorted(top)} on top, expected libph-VERSION"
    members = {member.name.split("/", 1)[1]: member for member in archive if member.isfile()}
    tracked = {}
    for line in git(root, "ls-tree", "-r", "HEAD").decode().splitlines():
        facts, _, name = line.partition("\t")
        tracked[name] = facts.startswith("100755")
    wanted = {name for name in tracked if is_wanted(name)}
    for name in sorted(wanted - set(members)):
        yield f"{name}: not found"
    npm = set()
    if has_page:
        listed = archive.extractfile(members["viewer/build/report-template.inputs"]).read().decode()
        npm = {f"viewer/{line}" for line in listed.split() if line.startswith("node_modules/")}
        folders = {re.match(r"viewer/node_modules/(?:@[^/]+/)?[^/]+", name)[0] for name in npm}
        npm |= {f"{folder}/{file}" for folder in folders for file in ("LICENSE", "package.json")}
        wanted |= PAGE | npm
        for name in sorted((PAGE | npm) - set(members)):
            yield f"{name}: not found"
    for name in sorted(set(members) - wanted):
        yield f"{name}: found, expected what git holds"
    for name, member in members.items():
        if BUILT.search(name) and name not in PAGE | npm:
            yield f"{name}: found what was built"
        if name in tracked and bool(member.mode & 0o100) != tracked[name]:
            yield f"{name}: found mode {member.mode:o}"
        if has_page and (member.uid or member.gid or member.uname or member.gname
                         or member.mode & 0o022):
            yield f"{name}: found {member.uid} {member.uname} {member.mode:o}, expected no user"
    if has_page and len({member.mtime for member in archive}) != 1:
        yield "found several times, expected that of the commit"


def main():
    root = Path(sys.argv[1])
    if not (root / ".git").exists():
        print("skipped: this is no clone of git")
        sys.exit(77)
    if sys.argv[2:]:
        archive = tarfile.open(sys.argv[2])
    else:
        archive = tarfile.open(fileobj=io.BytesIO(git(root, "archive", "--prefix=libph-0.0.0/", "HEAD")))
    with archive:
        faults = list(faults_of(root, archive, bool(sys.argv[2:])))
        print(*faults, f"{len(archive.getmembers())} members, {len(faults)} faults", sep="\n")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
