# SPDX-License-Identifier: MIT
"""random_tables.py [--runs N] [--seed S] [--jobs J] [--keep FOLDER]

Writes tables of numbers as pandas, R, spreadsheets and other programs do, reads them from Python,
and compares the numbers with the original ones. A missing value must be refused, or its row left
out. Each run has its own seed: --seed S --runs 1 repeats the run of seed S. Exits with 1 at the
first difference."""
import argparse
import os
import random
import sys

try:
    import numpy as np
except ModuleNotFoundError:
    print("SKIPPED: no numpy")
    sys.exit(77)

import libph as ph

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import many_runs  # noqa: E402

NAMES = ["x", "y (m)", "Temp. °C", "a,b", "r;g", "naive", "z_2", "say \"\"hi\"\"", "Na"]
WORDS = ["New York", "a#1", "2020-01-01 00:00", "7 dwarfs", "b,c", "d;e", "f\tg", "say \"\"hi\"\", now",
         "", "plain", "-", "12"]
COMMENTS = ["# a comment", "", "   ", "# 1, 2; 3", "#"]


def quoted(text, separator, draw):
    """Quotes a text as writers of tables do: where it is necessary, and sometimes where it is
    not."""
    needs = any(c in text for c in f",;\t#{separator}\"") or (separator == " " and not text)
    return f'"{text}"' if needs or draw.random() < 0.2 else text


def number_as_text(value, draw):
    text = draw.choice([repr(value), f"{value:.17g}", f"{value:+.17e}", f"{value:.17g}".upper()])
    return f'"{text}"' if draw.random() < 0.1 else text


class Table:
    """Numbers, and the lines of a file that contains them."""

    def __init__(self, draw):
        self.draw = draw
        self.separator = draw.choice([",", ",", ";", "\t", "\t", " "])
        rows, columns = draw.randrange(1, 9), draw.randrange(1, 6)
        self.values = [[draw.gauss(0, 1) * 10 ** draw.randrange(-3, 4) for _ in range(columns)]
                       for _ in range(rows)]
        self.index = draw.choice(["none", "none", "counts", "names", "id", "of R", "levels"])
        self.words = draw.randrange(columns + 1) if draw.random() < 0.3 else None
        self.header = self.index != "none" or self.words is not None or draw.random() < 0.5
        self.years = self.index in ("names", "levels") and draw.random() < 0.3
        if self.header and self.words is not None and self.index in ("none", "id"):
            self.years = draw.random() < 0.3
        self.full = None  # the index of a row whose last cell is not empty
        self.missing = self.some_missing(0.15 if draw.random() < 0.4 else 0)

    def some_missing(self, share):
        """The places of missing values. If no header names the last column, at least one of its
        values is present."""
        places = {(i, k) for i in range(len(self.values)) for k in range(len(self.values[0]))
                  if self.draw.random() < share}
        if not self.header or self.index == "of R":
            self.full = self.draw.randrange(len(self.values))
            places.discard((self.full, len(self.values[0]) - 1))
        return places

    def missing_as_text(self):
        spellings = ["nan", "NaN", "NA", "#N/A", '""', '"NA"']
        is_alone = len(self.values[0]) == 1 and self.index == "none" and self.words is None
        if self.separator != " " and not is_alone:
            spellings += ["", "", ""]
        return self.draw.choice(spellings)

    def lead(self, i):
        """The cells of a row before its numbers."""
        draw = self.draw
        name = f"{draw.choice(['r', 'a b', 'p#', 'x,'])}{i}"
        return {"none": lambda: [], "counts": lambda: [str(i)], "id": lambda: [str(i + 1)],
                "names": lambda: [quoted(name, self.separator, draw)], "of R": lambda: [f'"{name}"'],
                "levels": lambda: [quoted(name, self.separator, draw), str(i)]}[self.index]()

    def names(self):
        """The names of the columns of numbers, and of a column of words among them."""
        columns = len(self.values[0]) + (self.words is not None)
        if self.years:
            return [str(2019 + k) if k != self.words else "town" for k in range(columns)]
        return self.draw.sample(NAMES, columns)

    def lines(self):
        draw, separator = self.draw, self.separator
        self.header_names = self.names() if self.header else []
        first = {"none": [], "counts": [""], "names": [""], "id": ["id"], "of R": [],
                 "levels": ["", ""]}[self.index]
        rows = []
        if self.header:
            # Otherwise, blanks in the name would separate names.
            is_alone = len(first) + len(self.header_names) == 1
            names = [f'"{name}"' if is_alone or self.index == "of R" else
                     quoted(name, separator, draw) for name in self.header_names]
            rows.append([f'"{name}"' if separator == " " else name for name in first] + names)
        for i, values in enumerate(self.values):
            cells = [self.missing_as_text() if (i, k) in self.missing
                     else number_as_text(value, draw) for k, value in enumerate(values)]
            if self.words is not None:
                word = draw.choice([word for word in WORDS if word or i != self.full])
                cells.insert(self.words, quoted(word, separator, draw))
            rows.append(self.lead(i) + cells)
        space = draw.choice(["", "", " "]) if separator in ",;" else ""
        end = separator if separator != " " and draw.random() < 0.2 else ""
        texts = [(separator + space).join(row) + end for row in rows]
        for _ in range(draw.randrange(3)):
            comment = draw.choice(COMMENTS)
            texts.insert(draw.randrange(len(texts) + 1), comment)
        return texts

    def bytes(self):
        draw = self.draw
        ending = draw.choice(["\n", "\n", "\r\n"])
        text = ending.join(self.lines()) + ("" if draw.random() < 0.2 else ending)
        return (b"\xef\xbb\xbf" if draw.random() < 0.1 else b"") + text.encode()

    def columns(self):
        """The value of the option `columns`, by name or by number; None if all columns except the
        index are read."""
        draw = self.draw
        if self.words is None and not (self.years and self.index == "none") and draw.random() < 0.7:
            return None
        lead = {"none": 0, "levels": 2}.get(self.index, 1)
        places = [k for k in range(len(self.values[0]) + (self.words is not None)) if k != self.words]
        has_names = self.header and self.index != "of R"
        by_name = has_names and (self.years or draw.random() < 0.5)
        if by_name:
            return [self.header_names[k] for k in places]
        return [str(lead + k + 1) for k in places]


def one_run(seed, folder):
    draw = random.Random(seed)
    table = Table(draw)
    path = os.path.join(folder, draw.choice(["t.csv", "t.tsv", "t.txt", "t"]))
    data = table.bytes()
    with open(path, "wb") as file:
        file.write(data)
    columns, nan = table.columns(), draw.choice(["error", "drop"])
    what = f"{data!r} columns={columns} nan={nan!r}"
    kept = [row for i, row in enumerate(table.values)
            if not any((i, k) in table.missing for k in range(len(row)))]
    is_refused = table.missing and nan == "error"
    try:
        found = ph.read(path, "points", columns=columns, nan=nan)
    except ph.DataError as error:
        if not is_refused:
            raise many_runs.Difference(f"{what}: refused: {error}") from None
        if "\n" in str(error) or os.path.basename(path) not in str(error):
            raise many_runs.Difference(f"{what}: {error!r} is no line of the file") from None
        return "refused"
    except ph.Error as error:
        raise many_runs.Difference(f"{what}: {error!r}") from None
    if is_refused:
        raise many_runs.Difference(f"{what}: found {found.tolist()}, expected a refusal")
    if not np.array_equal(found, np.reshape(kept, (len(kept), -1)) if kept else found[:0]):
        raise many_runs.Difference(f"{what}: found {found.tolist()}, expected {kept}")
    return "read"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    many_runs.add_options(parser, 3000)
    many_runs.run_all(one_run, parser.parse_args(), "table")
