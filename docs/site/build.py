#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Builds the site: build.py [--folder build/site] [--barcode PH_BARCODE --segment PH_SEGMENT
--vectorise PH_VECTORISE --distance PH_DISTANCE] [--package FOLDER_OF_LIBPH]. scripts/site.sh finds
the last five.

In the folder it makes

source/     a tree of links to the pages of the repository, none of which is copied
doxygen/    XML of the public headers
printed/    the options of the programs, as the programs print them, if there are programs
reports/    the reports of the gallery, if there are programs
html/       the site

Needs no network. A warning of Sphinx is an error. Exit code 77: a requirement is missing.
"""
import argparse
import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
DOCS = ROOT / "docs"
# Pages outside docs/, with their places on the site.
ELSEWHERE = {"CHANGELOG.md": "reference/changes.md", "CONTRIBUTING.md": "development/contributing.md",
             "CODE_OF_CONDUCT.md": "development/conduct.md", "SECURITY.md": "development/security.md",
             "viewer/README.md": "development/viewer.md", "bench/README.md": "notes/measuring.md"}
PROGRAMS = 5  # the programs that must be given together
HEADERS = ["libph/include/ph", "libph/include/ph/io", "libph/include/ph/parts",
           "libsegment/include/ph", "libsegment/pcl/include/ph",
           "libreport/include/ph"]
# Headers outside the public ones with declarations that readers need.
DETAIL = ["components/branch", "complex/filtered_graph", "core/barcode_info", "core/engine",
          "core/loop", "io/camera", "io/cloud_data", "io/png", "io/reader", "metric/metric", "rips/vertex_weights"]
DETAIL_OF_REPORTS = ["provenance", "shown_tree"]


def require_tools():
    missing = [module for module in ("sphinx", "myst_parser", "furo", "breathe", "sphinx_copybutton")
               if importlib.util.find_spec(module) is None]
    missing += [program for program in ("doxygen", "git") if shutil.which(program) is None]
    if missing:
        print(f"skipped: the site needs {', '.join(missing)}; scripts/setup.sh docs installs that, "
              f"for /usr/bin/python3 (this is {sys.executable})")
        sys.exit(77)


def link_pages(tree):
    for file in DOCS.rglob("*"):
        if file.is_file() and HERE not in file.parents:
            link(tree / file.relative_to(DOCS), file)
    for path, place in ELSEWHERE.items():
        link(tree / place, ROOT / path)


def link(place, file):
    place.parent.mkdir(parents=True, exist_ok=True)
    place.symlink_to(file)


def run_doxygen(folder):
    folder.mkdir(parents=True)
    inputs = HEADERS + [f"libph/include/ph/detail/{name}.hpp" for name in DETAIL] + [
        f"libreport/include/ph/detail/report/{name}.hpp" for name in DETAIL_OF_REPORTS]
    settings = (HERE / "Doxyfile").read_text() + (
        f"INPUT = {' '.join(inputs)}\n"
        f"INPUT_FILTER = \"{sys.executable} -B {HERE / 'group.py'}\"\nOUTPUT_DIRECTORY = {folder}\n")
    subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=ROOT, check=True)
    for group in folder.glob("xml/group__*.xml"):
        group.write_text(with_namespaces(group.read_text()))


def with_namespaces(group):
    """Adds namespaces, because Breathe shows the members of a group by their bare names, and does
    not search namespaces for parameter types."""
    def whole(match):
        name = re.search(r"<qualifiedname>(ph::[^<]*)</qualifiedname>", match[0])
        return re.sub(r"<name>[^<]*</name>", f"<name>{name[1]}</name>", match[0], count=1) if name else match[0]
    return re.sub(r"<memberdef .*?</memberdef>", whole, group, flags=re.DOTALL)


def print_options(folder, programs):
    folder.mkdir(parents=True)
    for program in programs:
        text = subprocess.run([program, "--help", "markdown"], capture_output=True, text=True, check=True).stdout
        (folder / f"{Path(program).name}.md").write_text(text)


def make_reports(folder, programs):
    """Makes the reports of the gallery by running the commands on its page."""
    sys.path.insert(0, str(ROOT / "tests/docs"))
    from commands_in_pages import commands_of, has_page
    if not all(map(has_page, programs)):
        print("skipped: the site shows reports, and they are not built in")
        sys.exit(77)
    shutil.copytree(ROOT / "examples", folder / "examples")
    path = os.pathsep.join([*(str(Path(program).resolve().parent) for program in programs), os.environ["PATH"]])
    for command, _ in commands_of(DOCS / "gallery.md"):
        subprocess.run(command, shell=True, cwd=folder, env={**os.environ, "PATH": path}, check=True,
                       stdout=subprocess.DEVNULL)
    shutil.rmtree(folder / "examples")


def has_package(environment):
    code = "import libph._core"
    return subprocess.run([sys.executable, "-B", "-c", code], env=environment, cwd="/",
                          capture_output=True, check=False).returncode == 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--folder", type=Path, default=ROOT / "build/site")
    parser.add_argument("--barcode")
    parser.add_argument("--cluster")
    parser.add_argument("--segment")
    parser.add_argument("--vectorise")
    parser.add_argument("--distance")
    parser.add_argument("--package", type=Path)
    arguments = parser.parse_args()
    require_tools()
    folder = arguments.folder.resolve()
    programs = [program for program in (arguments.barcode, arguments.cluster, arguments.segment, arguments.vectorise,
                                        arguments.distance) if program]
    environment = {**os.environ, "PH_SITE_FOLDER": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}
    if arguments.package:
        environment["PYTHONPATH"] = str(arguments.package.resolve())
    environment["PH_SITE_PYTHON"] = "1" if has_package(environment) else "0"
    for name in ("source", "doxygen", "printed", "reports", "html", "doctrees"):
        shutil.rmtree(folder / name, ignore_errors=True)

    link_pages(folder / "source")
    run_doxygen(folder / "doxygen")
    if len(programs) == PROGRAMS:
        print_options(folder / "printed", programs)
        make_reports(folder / "reports", programs)
    built = subprocess.run(
        [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-j", "auto", "-c", HERE,
         "-d", folder / "doctrees", "-b", "html", folder / "source", folder / "html"],
        env=environment, check=False)
    if environment["PH_SITE_PYTHON"] == "0":
        print("left out: the reference of Python, for there is no compiled module of libph")
    if len(programs) < PROGRAMS:
        print("left out: the options of the programs and the reports of the gallery, for there are no programs")
    if built.returncode:
        sys.exit(built.returncode)
    print(f"{folder / 'html' / 'index.html'}")


if __name__ == "__main__":
    main()
