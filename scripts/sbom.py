#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lists the contents of the static programs as SPDX 2.3: sbom.py BUILD [-o FILE] [--licences
FOLDER].

The contents are found in a build folder with PH_STATIC_PROGRAMS, not listed by hand:

archives    the linker's maps (apps/*/*.map), which name each archive with a linked member
headers     the dependencies of each object of the programs, as Ninja recorded them
the font    PH_PLOT_FONT in CMakeCache.txt
the page    report-template.inputs, which viewer/build.mjs writes beside the page

dpkg knows the package and version of a file; package.json states them for npm packages. A package
whose licence is missing from LICENCES is an error: whoever links something new has to check its
licence first. --licences also writes the texts of all licences into a folder. SOURCE_DATE_EPOCH
sets the date.
"""
import argparse
import hashlib
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PROGRAMS = "apps/*/*.map"
# The licences of source packages, as SPDX expressions. All of them permit the distribution of a
# program under any terms, together with its source or with a way to relink it (glibc: LGPL).
LICENCES = {
    "brotli": "MIT",
    "cli11": "BSD-3-Clause",
    "eigen3": "MPL-2.0",
    "fmtlib": "MIT",
    "fonts-dejavu": "Bitstream-Vera",
    "freetype": "FTL OR GPL-2.0-or-later",
    "gcc": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "glibc": "LGPL-2.1-or-later",
    "libpng": "libpng-2.0",
    "linux": "GPL-2.0-only WITH Linux-syscall-note",
    "zlib": "Zlib",
}
# Packages whose headers contain declarations and numbers, but no code.
BUILD_ONLY = {"linux"}


def fail(text):
    sys.exit(f"sbom.py: {text}")


def output_of(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          check=True).stdout


def linked_files(build):
    """The archives and objects that were linked into a program and are not ours. An archive counts
    if one of its members was linked."""
    maps = sorted(build.glob(PROGRAMS))
    if not maps:
        fail(f"found no {build}/{PROGRAMS}, expected a build with PH_STATIC_PROGRAMS")
    files = set()
    for path in maps:
        text = path.read_text(errors="replace")
        files |= set(re.findall(r"^(/\S+\.a)\(", text, re.M))
        files |= set(re.findall(r"^LOAD (/\S+\.o)$", text, re.M))
    return files


def included_files(build):
    """Third-party headers that were included in the compilation of the programs."""
    programs = [path.relative_to(build).with_suffix("") for path in sorted(build.glob(PROGRAMS))]
    inputs = set(output_of("ninja", "-C", build, "-t", "inputs", *programs).splitlines())
    files, wanted = set(), False
    for line in output_of("ninja", "-C", build, "-t", "deps").splitlines():
        if line and not line.startswith(" "):
            wanted = line.split(":")[0] in inputs
        elif wanted:
            files.add(line.strip())
    ours = (str(ROOT), str(build))
    return {file for file in files if file.startswith("/") and not file.startswith(ours)}


def cached(build, name):
    found = re.search(rf"^{name}:\w+=(.*)$", (build / "CMakeCache.txt").read_text(), re.M)
    return found[1] if found else ""


def is_on(value):
    return value.upper() in ("TRUE", "ON", "1")


def debian_packages(files):
    """@return {name: (version, source, source version, architecture)} of the packages that contain
    the files."""
    files = sorted({os.path.realpath(file) for file in files})
    owners, found = set(), set()
    # On systems whose /lib is a link to /usr/lib, dpkg may know a file under its old name in /lib.
    names = files + [file[len("/usr"):] for file in files if file.startswith("/usr/lib")]
    said = subprocess.run(["dpkg", "-S", *names], capture_output=True, text=True, check=False).stdout
    for line in said.splitlines():
        packages, _, file = line.rpartition(": ")
        owners |= set(packages.split(", "))
        found |= {file, "/usr" + file}
    lost = [file for file in files if file not in found]
    if lost:
        fail(f"no package has {lost[0]}" + (f" and {len(lost) - 1} others" if lost[1:] else ""))
    rows = output_of("dpkg-query", "-W", "-f", "${Package}\t${Version}\t${source:Package}\t"
                     "${source:Version}\t${Architecture}\n", *sorted(owners))
    return {row.split("\t")[0]: tuple(row.split("\t")[1:]) for row in rows.splitlines()}


def npm_packages(page):
    """@return {name: (version, licence, folder)} of the packages bundled into the page."""
    viewer = ROOT / "viewer"
    packages = {}
    for line in page.with_suffix(".inputs").read_text().splitlines():
        found = re.match(r"node_modules/((?:@[^/]+/)?[^/]+)/", line)
        if found:
            folder = viewer / found[0]
            facts = json.loads((folder / "package.json").read_text())
            packages[found[1]] = facts["version"], facts["license"], folder
    return packages


def licence_of(source):
    name = re.sub(r"^(gcc|libpng)[-\d.]+$", r"\1", source)
    if name not in LICENCES:
        fail(f"the licence of {source} is not in LICENCES; is it one that a program of the MIT licence "
             "can have in it?")
    return LICENCES[name]


def package(name, version, licence, **more):
    return {"name": name, "SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name),
            "versionInfo": version, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseConcluded": licence, "licenseDeclared": licence, "copyrightText": "NOASSERTION",
            **more}


def reference(locator):
    return [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
             "referenceLocator": locator}]


def relation(one, kind, other, comment=None):
    return {"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other,
            **({"comment": comment} if comment else {})}


def distribution():
    return re.search(r'^ID="?(\w+)', Path("/etc/os-release").read_text(), re.M)[1]


def document(build):
    version = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]
    own = package("libph", version, "MIT", supplier="Organization: The libph authors",
                  primaryPackagePurpose="APPLICATION",
                  comment="ph-barcode, ph-cluster, ph-distance, ph-segment and ph-vectorise for Linux, "
                          f"{platform.machine()}, linked statically")
    packages, relations = [own], [relation("SPDXRef-DOCUMENT", "DESCRIBES", own["SPDXID"])]

    linked = debian_packages(linked_files(build))
    included = debian_packages(included_files(build))
    font = cached(build, "PH_PLOT_FONT")
    fonts = debian_packages([font]) if is_on(cached(build, "PH_HAS_FREETYPE")) else {}
    for name, (version, source, of_source, architecture) in sorted(
            {**linked, **included, **fonts}.items()):
        upstream = source if version == of_source else f"{source}@{of_source}"
        packages.append(package(
            name, version, licence_of(source),
            sourceInfo=f"built from the Debian source package {source} {of_source}",
            externalRefs=reference(f"pkg:deb/{distribution()}/{name}@{version.replace('+', '%2B')}"
                                   f"?arch={architecture}&upstream={upstream.replace('+', '%2B')}")))
        other = packages[-1]["SPDXID"]
        if name in linked:
            relations.append(relation(own["SPDXID"], "STATIC_LINK", other))
        elif name in fonts:
            relations.append(relation(own["SPDXID"], "CONTAINS", other, "the font of plots as PNG"))
        elif source in BUILD_ONLY:
            relations.append(relation(other, "BUILD_DEPENDENCY_OF", own["SPDXID"]))
        else:
            relations.append(relation(own["SPDXID"], "CONTAINS", other, "code of its headers"))

    page = cached(build, "PH_REPORT_PAGE")
    npm = npm_packages(Path(page)) if page else {}
    for name, (version, licence, _) in sorted(npm.items()):
        packages.append(package(name, version, licence, externalRefs=reference(
            f"pkg:npm/{name.replace('@', '%40')}@{version}")))
        relations.append(relation(own["SPDXID"], "CONTAINS", packages[-1]["SPDXID"],
                                  "bundled into the page of --report"))

    seconds = int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))
    digest = hashlib.sha256(json.dumps([packages, relations]).encode()).hexdigest()
    name = f"libph-{own['versionInfo']}-linux-{platform.machine()}"
    return {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
        "name": name, "documentNamespace": f"https://spdx.org/spdxdocs/{name}-{digest}",
        "creationInfo": {"created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(seconds)),
                         "creators": ["Tool: libph scripts/sbom.py"]},
        "packages": packages, "relationships": relations,
    }, {**linked, **included, **fonts}, npm


def write_licences(folder, debian, npm):
    """Writes one file per package, and the licence texts that these files refer to."""
    folder.mkdir(parents=True, exist_ok=True)
    common = Path("/usr/share/common-licenses")
    named = set()
    for name in debian:
        text = Path(f"/usr/share/doc/{name}/copyright").read_text(errors="replace")
        (folder / f"{name}.txt").write_text(text)
        named |= set(re.findall(rf"{common}/([A-Za-z0-9.-]*[A-Za-z0-9])", text))
    for name in sorted(named):
        if (common / name).exists():
            shutil.copyfile(common / name, folder / f"{name}.txt")
    for name, (_, _, source) in npm.items():
        shutil.copyfile(source / "LICENSE", folder / f"{name.replace('/', '-')}.txt")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--licences", type=Path)
    arguments = parser.parse_args()
    bill, debian, npm = document(arguments.build.resolve())
    text = json.dumps(bill, indent=1) + "\n"
    if arguments.output:
        arguments.output.write_text(text)
    else:
        print(text, end="")
    if arguments.licences:
        write_licences(arguments.licences, debian, npm)


if __name__ == "__main__":
    main()
