#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that facts stated in several places agree: facts.py ROOT, or facts.py --plant ROOT.

* Each stated version equals the version of project() in CMakeLists.txt, and each stated version of
  the C interface equals PH_ABI_VERSION in ph.h.
* debian/control requires what CMake searches for and what scripts/setup.sh installs.
* debian/copyright names each copyright holder that a file states, and the holders of npm packages
  in the page. Each of its patterns matches a file. Its licence text is the text of LICENSE.
* debian/rules makes each package of debian/control from a component.

--plant plants one fault after another in a copy, and requires that each is found. Exit code 77:
debian/ is missing, as in an archive of the sources.
"""
import fnmatch
import json
import re
import shutil
import sys
import tempfile
from pathlib import Path

# The dependencies in CMakeLists.txt, and the Debian packages that provide them.
FINDS = {"Eigen3": "libeigen3-dev", "fmt": "libfmt-dev", "ZLIB": "zlib1g-dev", "PNG": "libpng-dev",
         "Freetype": "libfreetype-dev", "CLI11": "libcli11-dev", "pybind11": "pybind11-dev",
         "PCL": "libpcl-dev", "GTest": "libgtest-dev", "Python3": "python3-dev", "Threads": None,
         "CGAL": "libcgal-dev",
         "benchmark": None, "MPI": None, "CUDAToolkit": None}  # turned off in debian/rules
# Components that are in no package. One of them is mpi, because each cluster has its own MPI.
OF_NO_PACKAGE = {"licence", "mpi"}
# Folders whose targets belong to no package.
NOT_PACKAGED = {"bench", "violations", "build", "install", "node_modules"}
# Packages listed only in debian/control, and packages listed only in scripts/setup.sh; a compiler
# is always installed for a Debian build.
FOR_DEBIAN = {"debhelper-compat", "dh-sequence-python3"}
FOR_PEOPLE = {"build-essential", "ccache", "pkg-config"}
# Only an archive of the sources has these files, see scripts/package.sh.
IN_ARCHIVE = {"viewer/build/report-template.html"}
HOLDERS = {"The libph authors"}
COMMENT = r"^[ \t]*(?:#|//|/?\*|<!--)[ \t]*"


def read(root, name):
    return (root / name).read_text(encoding="utf-8")


def found_in(pattern, text, name):
    match = re.search(pattern, text, re.M)
    if not match:
        raise SystemExit(f"facts.py: {name}: found no {pattern}")
    return match[1]


def versions(root):
    version = found_in(r"^project\(libph VERSION ([\d.]+)", read(root, "CMakeLists.txt"),
                       "CMakeLists.txt")
    stated = {
        "debian/changelog": found_in(r"\Alibph \(([^)]+)-[^)-]+\)", read(root, "debian/changelog"),
                                     "debian/changelog"),
        "CITATION.cff": found_in(r"^version: (.*)$", read(root, "CITATION.cff"), "CITATION.cff"),
        "CHANGELOG.md": found_in(r"^## (\d.*)$", read(root, "CHANGELOG.md"), "CHANGELOG.md"),
        "viewer/package.json": json.loads(read(root, "viewer/package.json"))["version"],
        "viewer/package-lock.json": json.loads(read(root, "viewer/package-lock.json"))["version"],
    }
    for place, other in stated.items():
        if other != version:
            yield f"{place}: found version {other}, expected {version}, that of CMakeLists.txt"
    project = read(root, "pyproject.toml")
    if 'dynamic = ["version"]' not in project or re.search(r"^version *=", project, re.M):
        yield "pyproject.toml: found a version, expected it to be dynamic"


def interface_versions(root):
    number = found_in(r"^#define PH_ABI_VERSION (\d+)", read(root, "libph/include/ph/ph.h"), "ph.h")
    found = {
        "libph/CMakeLists.txt": found_in(r"SOVERSION (\d+)", read(root, "libph/CMakeLists.txt"),
                                         "libph/CMakeLists.txt"),
        "debian/control": found_in(r"^Package: libph-c(\d+)$", read(root, "debian/control"),
                                   "debian/control"),
    }
    for file in sorted((root / "debian").glob("libph-c*.symbols")):
        name = f"debian/{file.name}"
        found[name] = found_in(r"\Alibph_c\.so\.(\d+) libph-c\d+ ", file.read_text(), name)
        declared = set(re.findall(r"^PH_API [^(;]*?\b(ph_\w+)\(", read(root, "libph/include/ph/ph.h"),
                                  re.M))
        listed = set(re.findall(r"^ (ph_\w+)@Base ", file.read_text(), re.M))
        if listed != declared:
            yield f"{name}: found other functions than ph.h: {sorted(listed ^ declared)}"
    for place, other in found.items():
        if other != number:
            yield f"{place}: found {other}, expected {number}, PH_ABI_VERSION of ph.h"


def build_dependencies(root):
    control = read(root, "debian/control")
    field = found_in(r"^Build-Depends: ((?:.*\n)(?: .*\n)*)", control, "debian/control")
    return {re.split(r"[ (<]", entry.strip())[0] for entry in field.split(",") if entry.strip()}


def sets_of_setup(root):
    text = read(root, "scripts/setup.sh")
    return {name: set(words.split()) for name, words in re.findall(
        r"^(\w+)=\(([a-z0-9\s.+-]+)\)", re.sub(r'"[^"]*"', "", text), re.M)}


def dependencies(root):
    wanted, sets = build_dependencies(root) - FOR_DEBIAN, sets_of_setup(root)
    for package in sorted(wanted - set().union(*sets.values())):
        yield f"debian/control: found {package}, which scripts/setup.sh does not install"
    for package in sorted(sets["build"] - FOR_PEOPLE - wanted):
        yield f"debian/control: found no {package}, which scripts/setup.sh build installs"
    for file in sorted([*root.rglob("CMakeLists.txt"), *root.glob("cmake/*.cmake")]):
        name = file.relative_to(root)
        if NOT_PACKAGED & set(name.parts):
            continue
        for found in re.findall(r"^[^#\n]*find_package\((\w+)", file.read_text(), re.M):
            if found not in FINDS:
                yield f"{name}: found find_package({found}), which this test knows no package of"
            elif FINDS[found] and FINDS[found] not in wanted:
                yield f"debian/control: found no {FINDS[found]}, which {name} looks for"


def stanzas(root):
    """@return [(patterns, holders, licence)] of the paragraphs with Files, in the order of the
    file."""
    found = []
    for paragraph in re.split(r"\n\s*\n", read(root, "debian/copyright")):
        fields = dict(re.findall(r"^([A-Z][\w-]*): *((?:.*)(?:\n .*)*)", paragraph, re.M))
        if "Files" in fields:
            holders = {re.sub(r"^[\d, -]+", "", line.strip())
                       for line in fields["Copyright"].splitlines()}
            found.append((fields["Files"].split(), holders, fields["License"].split("\n")[0]))
    return found


def files_of(root):
    skipped = {"build", "node_modules", ".git", "__pycache__", "dist", "out"}
    return sorted(path.relative_to(root).as_posix() for path in root.rglob("*")
                  if path.is_file() and not skipped & set(path.relative_to(root).parts))


def rights(root):
    named = stanzas(root)
    files = files_of(root)
    inputs = root / "viewer/build/report-template.inputs"
    if inputs.exists():
        npm = {f"viewer/{line}" for line in inputs.read_text().split()
               if line.startswith("node_modules/")}
        files += sorted(IN_ARCHIVE | npm)
    for patterns, _, _ in named:
        for pattern in patterns:
            unseen = pattern.startswith("viewer/") and not inputs.exists()
            if not unseen and not any(fnmatch.fnmatch(file, pattern) for file in files):
                yield f"debian/copyright: {pattern}: found no such file"
    for file in files:
        holders, licence = next((h, l) for patterns, h, l in reversed(named)
                                if any(fnmatch.fnmatch(file, p) for p in patterns))
        path = root / file
        text = path.read_bytes()[:4096].decode("utf-8", "replace") if path.exists() else ""
        stated = re.findall(COMMENT + r"SPDX-License-Identifier: (\S+)", text, re.M)
        if any(other != "MIT" for other in stated) or licence != "Expat":
            yield f"debian/copyright: {file}: found licence {stated} and {licence}"
        for holder in re.findall(COMMENT + r"Copyright (?:\(c\) |© )?[\d, -]+(.+?)\W*$", text, re.M):
            if holder.casefold() not in {other.casefold() for other in holders}:
                yield f"debian/copyright: {file}: found no {holder}, whom the file names"
        if file.startswith("viewer/node_modules/") and holders == HOLDERS:
            yield f"debian/copyright: {file}: found nobody but {HOLDERS}, and it is of others"
    text = re.sub(r"^ \.?", "", read(root, "debian/copyright").rsplit("License: Expat\n", 1)[1],
                  flags=re.M)
    if text.split() != read(root, "LICENSE").split("\n\n", 2)[2].split():
        yield "debian/copyright: found another text than LICENSE"


def packages(root):
    listed = set(re.findall(r"^Package: (\S+)$", read(root, "debian/control"), re.M))
    made = dict(re.findall(r"\$\(call install,([\w-]+),(\w+)\)", read(root, "debian/rules")))
    if listed != set(made):
        yield f"debian/rules: found other packages than debian/control: {sorted(listed ^ set(made))}"
    text = read(root, "cmake/install.cmake") + read(root, "python/CMakeLists.txt")
    components = set(re.findall(r"COMPONENT (\w+)", text)) - OF_NO_PACKAGE
    components |= set(found_in(r'if\(library MATCHES "\^\(([\w|]+)\)\$"\)', text,
                               "cmake/install.cmake").split("|"))
    for component in sorted(components ^ set(made.values())):
        yield f"debian/rules: found component {component} not in both it and CMake"


CHECKS = (versions, interface_versions, dependencies, rights, packages)


def faults_of(root):
    return [fault for check in CHECKS for fault in check(root)]


# Planted faults: the file, the text to replace, its replacement, and the expected message.
PLANTED = [
    ("debian/changelog", "libph (", "libph (9.", "debian/changelog: found version"),
    ("CITATION.cff", "\nversion: ", "\nversion: 9.", "CITATION.cff: found version"),
    ("pyproject.toml", 'dynamic = ["version"]', 'version = "1"', "expected it to be dynamic"),
    ("libph/CMakeLists.txt", "SOVERSION ", "SOVERSION 9", "PH_ABI_VERSION"),
    ("debian/libph-c1.symbols", " ph_barcode_free@", " ph_barcode_delete@", "other functions"),
    ("debian/control", "               libcli11-dev (>= 2.1),\n", "", "found no libcli11-dev"),
    ("debian/control", "ninja-build,", "ninja-build, bison,", "found bison"),
    ("scripts/setup.sh", "ninja-build ", "ninja-build libtbb-dev ", "found no libtbb-dev"),
    ("libph/CMakeLists.txt", "find_package(Threads", "find_package(TBB", "find_package(TBB)"),
    ("libph/src/core/field.cpp", "// SPDX", "// Copyright 2020 Somebody\n// SPDX", "found no Somebody"),
    ("libph/src/core/field.cpp", "Identifier: MIT", "Identifier: GPL-3.0-only", "found licence"),
    ("debian/copyright", "docs/images/motorcycle.png", "docs/images/bicycle.png", "no such file"),
    ("debian/copyright", "WITHOUT WARRANTY", "WITH WARRANTY", "another text"),
    ("debian/rules", "$(call install,libph-doc,doc)", "", "other packages"),
]


def plant(root):
    missed = 0
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder, "libph")
        shutil.copytree(root, copy, symlinks=True, ignore=shutil.ignore_patterns(
            "build", "build-*", "obj-*", "dist", "out", "node_modules", ".git", "corpus", "*.so"))
        before = set(faults_of(copy))
        for name, old, new, said in PLANTED:
            text = read(copy, name)
            if text.count(old) < 1:
                raise SystemExit(f"facts.py: {name}: found no {old!r} to replace")
            (copy / name).write_text(text.replace(old, new, 1), encoding="utf-8")
            if not any(said in fault for fault in set(faults_of(copy)) - before):
                print(f"{name}: {new!r} was not noticed")
                missed += 1
            (copy / name).write_text(text, encoding="utf-8")
    print(f"{len(PLANTED) - missed} of {len(PLANTED)} faults found")
    return missed


def main():
    if not Path(sys.argv[-1], "debian").exists():
        print("skipped: debian/ is missing, as in an archive of the sources")
        sys.exit(77)
    if sys.argv[1] == "--plant":
        sys.exit(1 if plant(Path(sys.argv[2]).resolve()) else 0)
    faults = faults_of(Path(sys.argv[1]).resolve())
    print(*faults, f"{len(faults)} faults", sep="\n")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
