#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Renders the tables of PAGES from bench/results: render_tables.py [--check] [ROOT]

A page has a line <!-- table: NAME.csv --> and a line <!-- end --> for each table. The script
replaces the text between them. With --check it does not change the pages, and the exit code is 1 if
a page would change.

A CSV file begins with a column `shown` (yes: the row is on the page) and ends with the columns
`script`, `machine`, `date` and `versions`, from which the line above the table is made. In a row
that was not measured, these columns are empty. The columns between them are the columns of the
table. Two columns "X s" and "X MB", or "X s" and "X B", become one column X. Needs only the standard library.
"""
import argparse
import csv
import difflib
import itertools
import re
import sys
import textwrap
from pathlib import Path

PAGES = ("docs/notes/benchmarks.md", "docs/reference/segmentation-constants.md")
RESULTS = "bench/results"
SOURCE = ["script", "machine", "date", "versions"]
MEMORY = ("MB", "B")  # B: bytes per point
CODE = ("name", "value")  # the columns that are parts of sources
TABLE = re.compile(r"(<!-- table: (\S+) -->\n).*?(<!-- end -->\n)", re.DOTALL)


def read(path):
    """@return the columns of the table, and the rows that are shown."""
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    columns = header[1:-len(SOURCE)]
    if header != ["shown", *columns, *SOURCE] or len(set(header)) < len(header):
        raise SystemExit(f"{path}: expected the columns shown, those of the table, and {', '.join(SOURCE)}")
    for number, row in enumerate(rows, 2):
        if len(row) != len(header) or row[0] not in ("yes", ""):
            raise SystemExit(f"{path}:{number}: expected {len(header)} cells, the first one yes or empty")
    return columns, [dict(zip(header, row)) for row in rows if row[0]]


def memory_of(what, columns):
    """The name of the column with the memory of `what`, or None."""
    return next((f"{what} {unit}" for unit in MEMORY if f"{what} {unit}" in columns), None)


def names_of(columns):
    """The columns on the page: X for the two columns "X s" and "X MB"."""
    pairs = {name: memory_of(name[:-2], columns) for name in columns if name.endswith(" s")}
    return [name[:-2] if pairs.get(name) else name for name in columns if name not in pairs.values()]


def cell(row, name):
    if name in CODE:
        return f"`{row[name]}`"
    if name in row:
        return row[name]
    return " / ".join(filter(None, (row[f"{name} s"], row[memory_of(name, row)])))


def caption(rows, root):
    """The origin of the rows: script, machine, date and versions. If rows have different origins,
    the text states each difference and the rows that it concerns."""
    usual, first, others = [], 1, {}
    for origin, group in itertools.groupby(rows, lambda row: [row[name] for name in SOURCE]):
        last = first + len(list(group)) - 1
        if any(origin):
            if not (root / origin[0]).is_file():
                raise SystemExit(f"{origin[0]}: found no such script")
            said = [f"`{origin[0]}`", *origin[1:]]
            usual = usual or said
            if other := tuple(words for words in said if words and words not in usual):
                others.setdefault(other, []).append(
                    str(first) if first == last else f"{first} to {last}")
        first = last + 1
    sentences = ["; ".join(filter(None, usual)) + "."] if usual else []
    for other, ranges in others.items():
        which = "Rows" if len(ranges) > 1 or " " in ranges[0] else "Row"
        sentences.append(f"{which} {', '.join(ranges)}: {'; '.join(other)}.")
    return textwrap.fill(" ".join(sentences), 100, break_long_words=False, break_on_hyphens=False)


def rendered(path, root):
    columns, rows = read(path)
    names = names_of(columns)
    lines = [names, ["---"] * len(names), *([cell(row, name) for name in names] for row in rows)]
    table = "".join(f"| {' | '.join(cells)} |\n" for cells in lines)
    return "\n\n".join(filter(None, (caption(rows, root), table)))


def new_pages(texts, root):
    """@param texts the text of each page."""
    results = {path.name: path for path in (root / RESULTS).glob("*.csv")}
    named = [match[2] for text in texts for match in TABLE.finditer(text)]
    if sorted(named) != sorted(results):
        raise SystemExit(f"{', '.join(PAGES)}: found the tables {', '.join(sorted(named))}; "
                         f"{RESULTS} has {', '.join(sorted(results))}")
    return [TABLE.sub(lambda match: match[1] + rendered(results[match[2]], root) + match[3], text)
            for text in texts]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=Path, nargs="?", default=Path(__file__).resolve().parents[1])
    parser.add_argument("--check", action="store_true", help="change nothing; exit with 1 if a page would change")
    arguments = parser.parse_args()
    old = [(arguments.root / page).read_text(encoding="utf-8") for page in PAGES]
    new = new_pages(old, arguments.root)
    for page, before, after in zip(PAGES, old, new):
        if not arguments.check:
            (arguments.root / page).write_text(after, encoding="utf-8")
        else:
            sys.stdout.writelines(difflib.unified_diff(before.splitlines(True), after.splitlines(True), page, RESULTS))
    return 1 if arguments.check and new != old else 0


if __name__ == "__main__":
    sys.exit(main())
