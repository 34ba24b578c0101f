#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that each component of an installation is complete, and that the components together make
the whole: components.py BUILD FOLDER.

A file without a component would be in no package, and a file in two components would be in two
packages.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

DOC = "share/doc/libph(-doc)?"  # debian/rules uses the longer name
# The least content of each component, and all that it may contain, as regular expressions.
HAS = {
    "c": ([r"lib/.*libph_c\.so\.1"], r"lib/([^/]+/)?libph_c\.so\.\d[\d.]*"),
    "dev": ([r"include/ph/ph\.hpp", r"include/ph/ph\.h", r".*/libph_core\.a", r".*/libph_c\.so",
             r".*/cmake/ph/ph-config\.cmake"],
            r"include/ph/.*\.(hpp|h|ipp)|lib/([^/]+/)?(libph_\w+\.a|libph_c\.so|cmake/ph/ph-[\w-]+\.cmake)"),
    "pcl": ([], r"include/ph/pcl\.hpp|lib/(.*/)?cmake/ph/ph-pcl\.cmake"),
    "alpha": ([], r"include/ph/(detail/alpha/\w+|alpha)\.hpp|lib/(.*/)?cmake/ph/ph-alpha(-\w+)?\.cmake|"
                  r"lib/([^/]+/)?libph_alpha\.a"),
    "programs": ([], r"bin/ph-\w+|share/(man/man1|bash-completion|zsh|fish)/.*"),
    "mpi": ([], r"bin/ph-barcode-mpi"),
    "python": ([], r"lib/python[^/]*/[^/]+/libph/.*\.(py|pyi|so|typed)"),
    "doc": ([rf"{DOC}/README\.md", rf"{DOC}/docs/index\.md", rf"{DOC}/examples/01_points\.cpp"],
            rf"{DOC}/.*"),
    "licence": ([rf"{DOC}/LICENSE"], rf"{DOC}/LICENSE"),
}


def installed(build, folder, *options):
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run(["cmake", "--install", build, "--prefix", folder, *options], check=True,
                   stdout=subprocess.DEVNULL)
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if not path.is_dir()}


def faults_of(build, folder):
    whole = installed(build, folder / "all")
    seen = {}
    for component, (needed, allowed) in HAS.items():
        files = installed(build, folder / component, "--component", component)
        print(f"{component}: {len(files)} files")
        for pattern in needed:
            if not any(re.fullmatch(pattern, file) for file in files):
                yield f"{component}: found no {pattern}"
        for file in sorted(files):
            if not re.fullmatch(allowed, file):
                yield f"{component}: {file}: found where it does not belong"
            if file in seen:
                yield f"{file}: found in {component} and {seen[file]}"
            seen[file] = component
    for file in sorted(whole ^ set(seen)):
        yield f"{file}: found in {'no component' if file in whole else seen[file] + ' only'}"


def main():
    faults = list(faults_of(Path(sys.argv[1]), Path(sys.argv[2])))
    print(*faults, f"{len(faults)} faults", sep="\n")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
