# SPDX-License-Identifier: MIT
"""Rows 9 to 16: a cell that is not a number, or holds a number that the input may not contain."""
from clouds import ply_header, XYZ
from files import pcd_header

from entry import bars, labels, refused, taken

# For each format, a file with a cell to fill in, the place of the cell, and whether infinity is
# allowed there.
PLACES = {
    "points": ("0 0\n1 {}\n", "2:3"),
    "distance": ("0 {0}\n{0} 0\n", "1:3"),
    "lower-distance": ("1\n2 {}\n", "2:3"),
    "upper-distance": ("1 {}\n1\n", "1:3"),
    "sparse": ("0 1 {}\n", "1:5"),
    "simplices": ("0 : 0\n1 : {}\n", "2:5"),
    "perseus": ("1\n2\n1\n{}\n", "4:1"),
    "off": ("OFF\n1 0 0\n0 {} 1\n", "3:3"),
    "xyz": ("0 0 1\n0 {} 1\n", "2:3"),
    "pts": ("1\n0 {} 1\n", "2:3"),
    "pcd": (pcd_header(width=1).decode() + "0 {} 1\n", "12:3"),
    "ply": (ply_header("ascii", "element vertex 1", *XYZ).decode() + "0 {} 1\n", "8:3"),
}
INFINITE = ("distance", "lower-distance", "upper-distance", "sparse", "simplices", "perseus")
CLOUDS = ("xyz", "pts", "pcd", "ply")

NOT_NUMBERS = {
    13: ("0x1p3", '"0x1p3"'),
    15: ("1_000", "digit separators"),
    16: ("1.0abc", '"1.0abc"'),
}


def not_numbers():
    for row, (word, message) in NOT_NUMBERS.items():
        for form, (content, place) in PLACES.items():
            yield refused(row, form, word, content.format(word), f":{place}: .*{message}")
    for form, (content, place) in PLACES.items():  # infinity as Microsoft's library wrote it
        word = "1.#INF"
        yield refused(16, form, word, content.format(word), f":{place}: .*write infinity as inf")
    yield refused(13, "points", "hexadecimal integer", "0x10 1\n", "hexadecimal")
    yield refused(16, "points", "two signs", "--1 0\n", ":1:1: not a number")
    yield refused(16, "points", "a sign alone", "0 -\n", ":1:3: not a number")
    yield refused(16, "points", "a point alone", "0 .\n", ":1:3: not a number")
    yield refused(16, "points", "an exponent alone", "0 1e\n", ":1:3: not a number")
    yield refused(16, "points", "quotes", "0 1\n'1' 2\n", "without quotes")
    yield refused(16, "points", "one quote", "0 1\n\"1 2\n", ":2:1: not a number")
    yield refused(16, "points", "digits of another script", "0 ١\n", ":1:3: not a number")
    yield refused(16, "points", "a no-break space", "0\u00a01\n", ":1:1: not a number")
    yield refused(16, "sparse", "a fraction as an id", "0.5 1 1\n", ":1:1: .*not an integer")
    yield refused(16, "phat", "a fraction as a dimension", "0.5\n", ":1:1: .*not an integer")


def too_large():
    for form, (content, place) in PLACES.items():
        yield refused(12, form, "1e400", content.format("1e400"), f":{place}: number out of range")
    yield refused(12, "pcd", "1e39 in a float", PLACES["pcd"][0].format("1e39"), "out of range")
    yield refused(12, "points", "400 digits", "9" * 400 + "\n", "number out of range")
    yield taken(12, "points", "1e-400 is 0", "0\n1e-400\n1\n",
                bars("0,0,1", "0,0,inf"))


def not_a_number():
    for form, (content, place) in PLACES.items():
        if form not in CLOUDS:
            yield refused(9, form, "nan", content.format("nan"), f":{place}: ")
    yield refused(9, "points", "-NaN", "0 0\n-NaN 1\n", ":2:1: ")
    yield refused(9, "points", "nan(1)", "0 0\nnan(1) 1\n", ":2:1: ")
    for form in CLOUDS:  # in a cloud, NaN is a hole
        count = 2 if form == "xyz" else 1
        yield taken(9, form, "nan", PLACES[form][0].format("nan"), labels(*[0] * count))
    yield taken(9, "points", "nan, dropped", "0\nnan\n1\n", bars("0,0,1", "0,0,inf"),
                "--nan", "drop", note="1 of 3 points")
    yield taken(9, "distance", "nan, dropped", "0 nan 1\nnan 0 2\n1 2 0\n",
                bars("0,0,1", "0,0,2", "0,0,inf"), "--nan", "drop")


def infinite():
    for row, word in ((10, "inf"), (11, "-inf")):
        for form in ("pcd", "ply"):  # like a hole, the point is out of range and in no segment
            yield taken(row, form, word, PLACES[form][0].format(word), labels(0), "--max-range", "inf")
        for form in ("points", "off", "xyz", "pts"):
            yield refused(row, form, word, PLACES[form][0].format(word), "infinit")
        for form in ("distance", "lower-distance", "upper-distance", "sparse"):
            content, place = PLACES[form]
            if word == "-inf":
                yield refused(row, form, word, content.format(word), f":{place}: negative")
    yield taken(10, "distance", "inf never joins", "0 inf\ninf 0\n", bars("0,0,inf", "0,0,inf"))
    yield taken(10, "lower-distance", "inf never joins", "1\ninf inf\n",
                bars("0,0,1", "0,0,inf", "0,0,inf"))
    yield taken(10, "upper-distance", "inf never joins", "inf 1\n2\n",
                bars("0,0,1", "0,0,2", "0,0,inf"))
    yield taken(10, "sparse", "inf never joins", "0 1 inf\n1 2 3\n",
                bars("0,0,3", "0,0,inf", "0,0,inf"))
    yield taken(10, "simplices", "inf never enters", "0 : 0\n1 : 1\n0 1 : inf\n",
                bars("0,0,inf", "0,1,inf"))
    yield taken(10, "perseus", "inf never enters", "1\n3\n0 inf 1\n", bars("0,0,inf", "0,1,inf"))
    yield taken(11, "perseus", "-inf", "1\n3\n-inf 2 1\n", bars("0,-inf,inf", "0,1,2"))
    yield taken(11, "simplices", "-inf", "0 : -inf\n1 : 1\n0 1 : 2\n",
                bars("0,-inf,inf", "0,1,2"))


def decimal_comma():
    hint = "decimal point"
    yield refused(14, "points", "between blanks", "0,5 1,5\n1,5 2,5\n", hint)
    yield refused(14, "points", "between semicolons", "0,5;1,5\n1,5;2,5\n", hint)
    yield refused(14, "points", "among points", "0 1\n1,5 2\n", hint)
    yield refused(14, "distance", "between blanks", "0 1,5\n1,5 0\n", hint)
    yield refused(14, "lower-distance", "between blanks", "1\n2 1,5\n", hint)
    yield refused(14, "upper-distance", "between blanks", "1 1,5\n1\n", hint)
    yield refused(14, "sparse", "between blanks", "0 1 1,5\n", hint)
    yield refused(14, "simplices", "a value", "0 : 0,5\n", "input.simplices:1:")
    yield refused(14, "perseus", "a value", "1\n2\n0,5 1\n", "input.perseus:3:")
    yield refused(14, "off", "a coordinate", "OFF\n1 0 0\n0,5 0 0\n", "input.off:3:")
    yield refused(14, "xyz", "between blanks", "0,5 1 1\n1 1,5 1\n", hint)
    yield refused(14, "pcd", "a coordinate", PLACES["pcd"][0].format("0,5"), hint)
    yield refused(14, "ply", "a coordinate", PLACES["ply"][0].format("0,5"), hint)


ENTRIES = [*not_numbers(), *too_large(), *not_a_number(), *infinite(), *decimal_comma()]
