# SPDX-License-Identifier: MIT
"""Rows 1 to 8: files that are not text, or not the text that they appear to be."""
import codecs

from entry import FORMS, bars, labels, refused, sample, taken

SQUARE = "0 0\n1 0\n1 1\n0 1.25\n"
SQUARE_BARS = bars("0,0,1", "0,0,1", "0,0,1.0307764064044151", "0,0,inf",
                   "1,1.25,1.4142135623730951")
PAIR = bars("0,0,1", "0,0,inf")
SPECK = labels(0, 0)  # two points are not enough for a segment

EMPTY = {
    "points": "no points", "distance": "no points", "lower-distance": "no points",
    "upper-distance": "no points", "sparse": "no points", "binary": "no points",
    "simplices": "no simplices", "phat": "no cells", "dipha": "truncated",
    "perseus": "no dimension", "npy": "truncated", "npz": "truncated archive",
    "nifti": "truncated", "nrrd": "not an NRRD", "metaimage": "truncated in the header", "vti": "not a VTI",
    "pgm": "not a PGM", "png": "not a PNG", "tiff": "not a TIFF",
    "off": "not an OFF",
    "gzip": "no points", "pcd": "truncated PCD header", "ply": "truncated PLY header",
    "xyz": "no points", "pts": "no points",
}


def empty():
    for form, message in EMPTY.items():
        yield refused(1, form, "empty", "", message)
    yield taken(1, "points", "empty, allowed", "", bars(), "--allow-empty")
    yield taken(1, "distance", "empty, allowed", "", bars(), "--allow-empty")
    yield taken(1, "xyz", "empty, allowed", "", "", "--allow-empty")


def blanks():
    for form in ("points", "distance", "lower-distance", "upper-distance", "sparse", "simplices",
                 "phat", "perseus", "off", "xyz"):
        yield refused(2, form, "only blanks", " \n\t\n\r\n", EMPTY[form])
        yield refused(2, form, "only comments", "# nothing\n  # here\n", EMPTY[form])
    for form in ("points", "distance", "sparse", "xyz"):
        yield refused(2, form, "only a header", "a,b,c\n" if form != "xyz" else "x,y,z\n",
                      "no points")


def marks():
    mark = codecs.BOM_UTF8
    for form, content, output in (
            ("points", SQUARE, SQUARE_BARS), ("points", "x,y\n0,0\n0,1\n", PAIR),
            ("distance", "0 1\n1 0\n", PAIR), ("lower-distance", "1\n", PAIR),
            ("sparse", "0 1 1\n", PAIR), ("simplices", "0 : 0\n1 : 0\n0 1 : 1\n", PAIR),
            ("phat", "0\n0\n1 0 1\n", bars("0,0,inf", "0,1,2")),
            ("perseus", "1\n3\n0 1 0\n", PAIR), ("off", "OFF\n2 0 0\n0 0 0\n1 0 0\n", PAIR),
            ("xyz", "0 0 1\n1 0 1\n", SPECK)):
        yield taken(3, form, f"mark before {content.split()[0]}", mark + content.encode(), output)
    yield refused(3, "pgm", "mark", mark + b"P2 1 1 9\n5\n", "not a PGM")
    yield refused(3, "ply", "mark", mark + sample("ply", "ascii.ply"), "not a PLY")
    yield refused(3, "points", "mark alone", mark, "no points")


def line_ends():
    def crlf(content):
        return content.replace("\n", "\r\n")

    for form, content, output in (
            ("points", SQUARE, SQUARE_BARS), ("points", "a,b\n0,0\n0,1\n", PAIR),
            ("distance", "0 1\n1 0\n", PAIR), ("lower-distance", "1\n", PAIR),
            ("upper-distance", "1\n", PAIR), ("sparse", "0 1 1\n", PAIR),
            ("simplices", "0 : 0\n1 : 0\n0 1 : 1\n", PAIR),
            ("phat", "0\n0\n1 0 1\n", bars("0,0,inf", "0,1,2")),
            ("perseus", "1\n3\n0 1 0\n", PAIR), ("pgm", "P2\n3 1\n1\n0 1 0\n", PAIR),
            ("off", "OFF\n2 0 0\n0 0 0\n1 0 0\n", PAIR), ("xyz", "0 0 1\n1 0 1\n", SPECK),
            ("pts", "2\n0 0 1\n1 0 1\n", SPECK)):
        yield taken(4, form, f"CRLF after {content.split()[0]}", crlf(content), output)
    for reader, name in (("pcd", "ascii.pcd"), ("ply", "ascii.ply")):
        count = 4 if reader == "pcd" else 3
        yield taken(4, reader, "CRLF", crlf(sample(reader, name).decode()), labels(*[0] * count))
    yield refused(4, "points", "CR alone", "0 0\r1 0\r", "end lines with a line feed")
    yield refused(4, "distance", "CR alone", "0 1\r1 0\r", "not a number.*line feed")
    yield taken(4, "points", "no end of the last line", SQUARE[:-1], SQUARE_BARS)


def utf16():
    for form in ("points", "distance", "sparse", "simplices", "xyz"):
        content = "0 1 : 2\n" if form == "simplices" else "0 1 2\n1 0 3\n2 3 0\n"
        for name, encoding in (("mark, little endian", "utf-16-le"),
                               ("mark, big endian", "utf-16-be")):
            yield refused(5, form, f"UTF-16, {name}", ("\ufeff" + content).encode(encoding),
                          "a UTF-16 byte order mark")
        yield refused(5, form, "UTF-16 without a mark", content.encode("utf-16-le"),
                      "NUL bytes as in UTF-16")
    yield refused(5, "points", "UTF-32", SQUARE.encode("utf-32"), "byte order mark")


def nul_bytes():
    for form in ("points", "distance", "lower-distance", "sparse", "simplices", "perseus", "xyz"):
        yield refused(6, form, "NUL in a number", b"1 \x001 2\n", "byte 2: not plain text")
    late = SQUARE * 300 + "0 \0 1\n"
    yield refused(6, "points", "NUL behind the first 4 KiB", late, r":1201:3: .*binary file")
    yield refused(6, "xyz", "NUL behind the first 4 KiB", "0 0 1\n" * 1000 + "0 0 \0\n", ":1001:5")
    yield refused(6, "points", "NUL alone", b"\0", "a NUL byte")


def binary():
    for form in ("points", "distance", "sparse", "simplices"):
        for reader, name in (("image", "grey.png"), ("nifti", "u1.nii")):
            yield refused(7, form, name, sample(reader, name), "not plain text|not a number|not an "
                          "integer|no value|control|NUL")
    random = bytes((i * i * 31 + 7 * i) % 255 + 1 for i in range(300)).replace(b"#", b"")
    yield refused(7, "points", "bytes without NUL", random, r"not a number|mixed separators")
    yield refused(7, "xyz", "a binary cloud", sample("pcd", "binary.pcd")[180:], "not plain text")
    for form in ("dipha", "npy", "npz", "nifti", "nrrd", "metaimage", "vti", "pgm", "png", "tiff", "pcd", "ply", "off", "pts"):
        yield refused(7, form, "text instead", "0 0\n1 0\n1 1\n", "input" + FORMS[form].extension)


def one_line():
    too_long = b"1 " * (33 << 20)
    yield refused(8, "points", "66 MiB on a line", too_long, "line too long")
    yield refused(8, "lower-distance", "66 MiB on a line", too_long, "line too long")
    yield refused(8, "points", "a cell of a mebibyte", "0" * (1 << 20) + "x 1\n", r":1:1: .*\.\.\.")
    yield taken(8, "points", "a number of a mebibyte", "0\n1." + "0" * (1 << 20) + "\n", PAIR)
    yield refused(8, "points", "10,000 coordinates, then 9,999",
                  "1 " * 10_000 + "\n" + "1 " * 9_999 + "\n", "ragged row, found 9999 cells")


ENTRIES = [*empty(), *blanks(), *marks(), *line_ends(), *utf16(), *nul_bytes(), *binary(),
           *one_line()]
