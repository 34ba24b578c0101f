#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the structure of the sources: which room may include which other room; that no folders
include each other in a cycle; that no file includes private headers of another folder's library;
that includes state full paths; how large a folder may be; where tests are; and that files with
fmt::join include its header: layering.py ROOT.

Rooms are the folders of libph/src, libsegment, libreport, apps and python. A public header belongs
to the room that HEADERS names. The exit code is 0 if there is no violation.
"""
import re
import sys
from pathlib import Path

# For each room, the other rooms that it may include.
MAY_INCLUDE = {
    "core": "",
    "metric": "core components",
    "image": "core",
    "components": "core",
    "reduction": "core components",
    "complex": "core metric image",
    "gpu": "core metric",
    "rips": "core metric components reduction complex gpu",
    "cubical": "core image components reduction",
    "diagram": "core metric",
    "vectors": "core image complex diagram",
    "significance": "core metric",
    "alpha": "core metric components reduction complex",
    "facade": "core metric image components reduction complex rips cubical alpha",
    "clusters": "core metric components complex rips facade",
    "loops": "core metric complex components reduction rips alpha facade clusters",
    "umbrella": "core metric complex rips facade clusters loops diagram vectors significance",
    "c": "core metric image complex rips cubical facade",
    "io": "core metric image complex rips alpha facade",
    "plot": "core components io",
    "segment": "core metric image components reduction complex rips facade io plot",
    "report": "core metric image components complex rips alpha facade io plot segment",
    "common": "core metric image complex rips facade diagram io plot report",
    "barcode": "core metric image components complex rips cubical alpha facade loops diagram significance io "
               "plot report common",
    "python": "core metric image complex rips alpha facade clusters loops diagram vectors significance io plot segment "
              "report",
    "cluster": "core metric rips clusters io segment common",
    "distance": "core metric diagram significance io common",
    "vectorise": "core image complex vectors diagram io report common",
    "segment_program": "core metric image components complex rips facade io plot segment report common",
}

# The room of each header in include/ph. Headers in ph/io belong to io; headers in ph/detail belong
# to the room with the name of their folder.
HEADERS = {
    "core": "barcode error filtration run_context",
    "metric": "distance_matrix distance_to_measure eigen greedy_permutation points sparse_distances",
    "image": "image",
    "complex": "cubical explicit voxel_image",
    "rips": "rips",
    "diagram": "distances",
    "vectors": "euler_curve vectorise",
    "significance": "significance",
    "alpha": "alpha",
    "facade": "custom estimate merge_tree parts/cloud_part parts/image_loops parts/image_part persistence",
    "clusters": "cluster_tree",
    "loops": "loops",
    "umbrella": "ph",
    "plot": "io/plot",
    "segment": "label_tracker pcl scene_tree segment",
    "report": "report scene_report",
}
ROOM_OF = {name: room for room, names in HEADERS.items() for name in names.split()}

FOLDERS = (("libph/src/", None), ("libsegment/", "segment"), ("libreport/", "report"),
           ("apps/segment/", "segment_program"),
           ("apps/", None), ("python/", "python"))
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"]+)"|<((?:ph|pcl|CGAL)/[^>]+)>)', re.M)
MAY_SHOW = {"pcl": "libsegment/pcl/", "CGAL": "libph/src/alpha/cgal/"}
MOST_FILES = 40  # in a larger folder, it is hard to find a file by its name
PUBLIC = ("libph/include", "libsegment/include", "libsegment/pcl/include", "libreport/include")
# Folders that only the library itself may include. Tests and benchmarks may include anything.
PRIVATE = ("libph/src/", "libsegment/src/", "libreport/report/")
# The most headers that each folder of public headers may have. Headers that users do not include
# themselves belong in ph/detail.
MOST_PUBLIC = {"libph/include/ph": 28, "libph/include/ph/io": 5,
               "libph/include/ph/parts": 3, "libsegment/include/ph": 3,
               "libsegment/pcl/include/ph": 1, "libreport/include/ph": 2}

# Folders of tests, and the folders of sources with the same rooms.
TESTS_OF = {"tests/libph": ("libph/src",), "tests/libsegment": ("libsegment/src", "libsegment"),
            "tests/apps": ("apps", "libreport")}


def room_of_header(path):
    """@param path below include/, such as ph/detail/core/chain.hpp. @return the room; None if the
    header is in no room."""
    if path.endswith(".h"):
        return "c"
    name = str(path)[len("ph/"):].rsplit(".", 1)[0]
    if name.startswith("detail/"):
        return name.split("/")[1]
    return ROOM_OF.get(name) or ("io" if name.startswith("io/") else None)


def room_of(file):
    """@param file a path below ROOT."""
    text = str(file)
    if "/include/" in text:
        return room_of_header(text.split("/include/", 1)[1])
    for folder, room in FOLDERS:
        if text.startswith(folder):
            return room or text[len(folder):].split("/")[0]
    return None


def target_of(root, file, include):
    """The path below ROOT of the included file; None for a third-party file."""
    for base in (*map(Path, PUBLIC), Path(), file.parent):
        if (root / base / include).is_file():
            return (root / base / include).resolve().relative_to(root)
    return None


def unclear_includes(root):
    """Includes without a full path: a header that is not public must be included by its path from
    the root."""
    tops = ("libph", "libsegment", "libreport", "apps", "bench", "examples", "python", "tests")
    for path in sorted(p for top in tops for p in (root / top).rglob("*")):
        if path.suffix not in (".hpp", ".ipp", ".cpp", ".h", ".cu", ".cuh", ".mm") or \
                root / "tests/headers/violations" in path.parents:
            continue
        file = path.relative_to(root)
        for match in INCLUDE.finditer((root / file).read_text()):
            include = match[1] or match[2]
            target = target_of(root, file, include)
            if target and include not in (str(target), str(target).split("/include/")[-1]):
                yield f"{file}: {include}: expected {target}"


def lacks_header_of_join(text):
    """fmt/format.h declares fmt::join only in fmt 9 and 10."""
    return re.search(r"\bfmt::join\(", text) and "#include <fmt/ranges.h>" not in text


def violations_of(root, file):
    room = room_of(file)
    if room not in MAY_INCLUDE:
        yield f"{file}: found in no room, expected one of {', '.join(MAY_INCLUDE)}"
        return
    text = (root / file).read_text()
    if lacks_header_of_join(text):
        yield f"{file}: found fmt::join without #include <fmt/ranges.h>"
    for match in INCLUDE.finditer(text):
        include = match[1] or match[2]
        if include.startswith(("pcl/", "CGAL/")):
            if not str(file).startswith(MAY_SHOW[include.split("/")[0]]):
                yield f"{file}: {include}: PCL and CGAL stay out"
            continue
        target = target_of(root, file, include)
        if target is None:
            continue
        other = room_of(target)
        if other != room and other not in MAY_INCLUDE[room].split():
            yield f"{file}: {include}: {room} may include {MAY_INCLUDE[room] or 'nothing else'}, " \
                  f"found {other}"
        inside = next((start for start in PRIVATE if str(target).startswith(start)), None)
        if inside and not str(file).startswith(inside):
            yield f"{file}: {include}: {inside} is private to its library, and no installed header may " \
                  "include it: expected a header of ph/detail"


def too_large(root):
    tops = ("libph", "libsegment", "libreport", "apps", "bench", "python", "tests")
    for folder in sorted(p for top in tops for p in (root / top, *(root / top).rglob("*"))
                         if p.is_dir()):
        # The corpus may have any number of files, and Python's caches are not part of the sources.
        if (root / "tests/corpus") in folder.parents or folder.name == "__pycache__":
            continue
        count = sum(p.is_file() and p.name != "py.typed" for p in folder.iterdir())
        most = MOST_PUBLIC.get(str(folder.relative_to(root)), MOST_FILES)
        if count > most:
            yield f"{folder.relative_to(root)}: found {count} files, expected at most {most}"


def misplaced_tests(root):
    for tests, tested in TESTS_OF.items():
        for path in sorted((root / tests).rglob("*")):
            name = path.relative_to(root)
            if path.is_dir() and path.parent == root / tests and \
                    not any((root / folder / path.name).is_dir() for folder in tested):
                yield f"{name}: found no such room in {' or '.join(tested)}"
            if path.suffix == ".cpp" and not path.stem.endswith("_tests"):
                yield f"{name}: expected a name that ends in _tests.cpp"


def room_cycles():
    """The rooms that, by MAY_INCLUDE, are in a cycle of rooms that include each other."""
    seen = {room: set(rooms.split()) for room, rooms in MAY_INCLUDE.items()}
    for via in seen:
        for rooms in seen.values():
            if via in rooms:
                rooms |= seen[via]
    return (f"{room}: found in a cycle of rooms" for room in seen if room in seen[room])


def folder_of(file):
    """The folder of a file. For a public header, this is its room, because the folder of the header
    was chosen for the convenience of users."""
    if "/include/" in str(file):
        return f"public headers of {room_of(file)}"
    return str(file.parent)


def reachable(start, edges):
    found, left = set(), [start]
    while left:
        for other in edges[left.pop()] - found:
            found.add(other)
            left.append(other)
    return found


def circles(root, files):
    """Cycles of folders that include each other, such as a folder and its subfolder. A reader would
    have to read all folders of a cycle to understand one."""
    edges, example = {folder_of(f): set() for f in files}, {}
    for file in files:
        for match in INCLUDE.finditer((root / file).read_text()):
            target = target_of(root, file, match[1] or match[2])
            here = folder_of(file)
            if target and folder_of(target) in edges and folder_of(target) != here:
                edges[here].add(folder_of(target))
                example.setdefault((here, folder_of(target)), f"{file}: {target}")
    reached = {folder: reachable(folder, edges) for folder in edges}
    told = set()
    for folder in sorted(edges):
        circle = sorted(f for f in reached[folder] if folder in reached[f])
        if circle and folder not in told:
            told.update(circle)
            yield f"{', '.join(circle)}: found in a circle:"
            for (a, b), text in sorted(example.items()):
                if a in circle and b in circle:
                    yield f"  {text}"


def main():
    root = Path(sys.argv[1]).resolve()
    files = sorted(p.relative_to(root) for top in ("libph", "libsegment", "libreport", "apps", "python")
                   for p in (root / top).rglob("*") if p.suffix in (".hpp", ".ipp", ".cpp"))
    found = [v for file in files for v in violations_of(root, file)]
    found += [*too_large(root), *misplaced_tests(root), *room_cycles(), *circles(root, files),
              *unclear_includes(root)]
    count = sum(not text.startswith(" ") for text in found)
    print(*found, f"{len(files)} files looked at, {count} violations", sep="\n")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
