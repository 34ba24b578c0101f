#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that the contents listed by scripts/sbom.py agree with the symbols that `nm` finds:
check_sbom.py BUILD.

The bill of materials is made from the linker's map files and from dependencies; this check looks at
symbols instead. Each symbol that a program defines must be ours, or must come from an archive in a
package that the bill names (found with `dpkg -L`). Code in headers leaves symbols in its namespace;
the font and the page leave symbols with their names. Then each package in turn is removed from the
bill, and the check must notice it. The bill has the fields that SPDX 2.3 requires.
"""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Symbols that the linker and the start code define.
OF_THE_LINKER = re.compile(r"_(end|edata|etext|GLOBAL_OFFSET_TABLE_|DYNAMIC|init|fini|start)|end|edata|etext"
                           r"|__(bss_start|data_start|dso_handle|ehdr_start|TMC_END__|GNU_EH_FRAME_HDR"
                           r"|(preinit|init|fini)_array_(start|end)|rela_iplt_(start|end)"
                           r"|(start|stop)___libc\w*|start_\w+|stop_\w+)|data_start")
# Namespaces of code in headers, with their packages. None: the code is in an archive, in which
# symbols are looked up.
NAMESPACES = {"CLI": "libcli11-dev", "Eigen": "libeigen3-dev", "fmt": "libfmt-dev", "ph": None,
              "std": None, "__gnu_cxx": None}
TRACES = {"fonts-dejavu-core": "DejaVu Sans".encode("utf-16-be"), "three": b"three.js authors"}


def output_of(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          check=True).stdout


def symbols_of(*files):
    """The exported symbols of some files, as the linker names them."""
    found = set()
    for line in output_of("nm", "--defined-only", "--extern-only", "--quiet", *files).splitlines():
        words = line.split()
        if len(words) == 3:
            found.add(words[2])
    return found


def archives_of(package):
    files = output_of("dpkg", "-L", package).splitlines()
    return [file for file in files if file.endswith(".o") or (
        file.endswith(".a") and Path(file).read_bytes()[:8] == b"!<arch>\n")]


class Evidence:
    """All evidence of what the programs of a build contain."""

    def __init__(self, build):
        programs = [path.with_suffix("") for path in sorted(build.glob("apps/*/*.map"))]
        if not programs:
            print("skipped: the programs of this build are not static")
            sys.exit(77)
        ours = [path for path in build.rglob("*.a")] + list(build.glob("apps/*/CMakeFiles/*.dir/main.cpp.o"))
        own = symbols_of(*ours)
        self.symbols = symbols_of(*programs)
        # In a mangled name, the length of a namespace precedes it.
        self.namespaces = {match[2][:int(match[1])] for name in self.symbols & own
                           if (match := re.match(r"_ZNK?(\d+)(\w+)", name))}
        self.foreign = {name for name in self.symbols - own if not OF_THE_LINKER.fullmatch(name)}
        content = b"".join(path.read_bytes() for path in programs)
        self.traces = {package for package, trace in TRACES.items() if trace in content}
        self.archives = {}

    def defined_by(self, package):
        if package not in self.archives:
            files = archives_of(package)
            self.archives[package] = symbols_of(*files) if files else set()
        return self.archives[package]


def is_debian(package):
    return any("pkg:deb/" in reference["referenceLocator"] for reference in package.get("externalRefs", []))


def content_faults(bill, evidence):
    names = {package["name"] for package in bill["packages"]}
    left = set(evidence.foreign)
    for package in bill["packages"]:
        if is_debian(package):
            left -= evidence.defined_by(package["name"])
    if left:
        yield f"found {len(left)} symbols of no package, as {', '.join(sorted(left)[:5])}"
    for namespace in sorted(evidence.namespaces - set(NAMESPACES)):
        yield f"found namespace {namespace}, which this test knows no package of"
    for namespace in sorted(evidence.namespaces & set(NAMESPACES)):
        if NAMESPACES[namespace] and NAMESPACES[namespace] not in names:
            yield f"found namespace {namespace}, expected {NAMESPACES[namespace]} to be named"
    for package in sorted(evidence.traces - names):
        yield f"found traces of {package}, expected it to be named"


def form_faults(bill):
    expected = {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT"}
    for name, value in expected.items():
        if bill.get(name) != value:
            yield f"{name}: found {bill.get(name)}, expected {value}"
    if not re.fullmatch(r"https?://[^#\s]+", bill.get("documentNamespace", "")):
        yield "documentNamespace: found no address without #"
    creation = bill.get("creationInfo", {})
    if not re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", creation.get("created", "")):
        yield "created: found no time in UTC"
    if not creation.get("creators") or any(
            not re.match(r"(Tool|Person|Organization): ", by) for by in creation["creators"]):
        yield "creators: found none"
    ids = {"SPDXRef-DOCUMENT"}
    for package in bill.get("packages", []):
        for name in ("name", "SPDXID", "downloadLocation", "versionInfo", "licenseConcluded",
                     "licenseDeclared", "copyrightText"):
            if not package.get(name):
                yield f"{package.get('name')}: found no {name}"
        if package.get("filesAnalyzed", True):
            yield f"{package['name']}: found filesAnalyzed, without packageVerificationCode"
        if not re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", package["SPDXID"]) or package["SPDXID"] in ids:
            yield f"{package['SPDXID']}: found twice, or no identifier"
        ids.add(package["SPDXID"])
        if not re.fullmatch(r"[\w.+-]+( (AND|OR|WITH) [\w.+-]+)*", package["licenseConcluded"]):
            yield f"{package['name']}: found licence {package['licenseConcluded']}"
        if re.search(r"\bA?GPL", re.sub(r"\bGPL[\w.-]+ WITH \w[\w.-]*|FTL OR GPL[\w.-]+", "",
                                        package["licenseConcluded"])):
            yield f"{package['name']}: found a licence that binds the whole program"
    pairs = set()
    for relation in bill.get("relationships", []):
        pairs |= {relation["spdxElementId"], relation["relatedSpdxElement"]}
        if not {relation["spdxElementId"], relation["relatedSpdxElement"]} <= ids:
            yield f"found a relationship of what is not there: {relation}"
    if ids - pairs:
        yield f"found packages without a relationship: {sorted(ids - pairs)}"


def without(bill, package):
    return {**bill, "packages": [other for other in bill["packages"] if other is not package]}


def main():
    build = Path(sys.argv[1]).resolve()
    if not list(build.glob("apps/*/ph-*")):
        print(f"skipped: no programs without CGAL in {build}; scripts/test.sh builds them there")
        sys.exit(77)
    evidence = Evidence(build)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "bill.json")
        subprocess.run([sys.executable, "-B", ROOT / "scripts/sbom.py", build, "-o", file], check=True)
        bill = json.loads(file.read_text())
    faults = [*form_faults(bill), *content_faults(bill, evidence)]
    for_headers = {relation["spdxElementId"] for relation in bill["relationships"]
                   if relation["relationshipType"] == "BUILD_DEPENDENCY_OF"}
    for package in bill["packages"][1:]:
        noticed = list(content_faults(without(bill, package), evidence))
        if package["SPDXID"] not in for_headers and not noticed:
            faults.append(f"{package['name']}: found in the bill, but nothing of it in the programs")
    print(*faults, sep="\n")
    print(f"{len(evidence.symbols)} symbols, {len(evidence.foreign)} of others; "
          f"{len(bill['packages'])} packages, {len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
