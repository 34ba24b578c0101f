# SPDX-License-Identifier: MIT
"""Rows 61 to 65: damaged or forged files of barcodes and fits, which normally only the programs
write."""
from files import dipha, npy, packed

from entry import Entry, sample, with_bytes, with_change

GOOD = b"dim,birth,death\n0,0,1\n0,0,inf\n1,1,2\n"
HEAD = b"dim,birth,death\n"
BEGIN = b'{"format": "ph-barcode", "version": 1, "bars": ['
BAR = b'{"dim": 0, "birth": 0, "death": 1}'

# Each program that reads barcodes, with a command that reads the faulty file.
USES = {
    "distance": ("ph-distance", "{}", "good.csv"),
    "wasserstein": ("ph-distance", "--distance", "wasserstein", "good.csv", "{}"),
    "groups": ("ph-distance", "--groups", "groups.txt", "good.csv", "good.csv", "{}", "good.csv"),
    "vectors": ("ph-vectorise", "good.csv", "{}"),
    "images": ("ph-vectorise", "--kind", "image", "{}"),
    "plot": ("ph-barcode", "plot", "{}", "-o", "out.svg"),
    "report": ("ph-barcode", "{}", "--report", "out.html", "-o", "out.csv"),
    "compare": ("ph-barcode", "--compare", "good.csv", "{}"),
}


def refused(row, name, use, file, content, message, **others):
    program, *arguments = USES[use]
    arguments = tuple(argument.format(file) for argument in arguments)
    return Entry(row, f"{use}: {name}", program, arguments, 65, message, file,
                 {"good.csv": GOOD, "groups.txt": b"a\nb\na\nb\n", file: content}, **others)


TEXT = [
    # name, use, content, part of the message
    ("nothing", "distance", b"", "no bars, found nothing"),
    ("a line end alone", "plot", b"\n", "no bars, found nothing"),
    ("no header but words", "distance", b"birth\n", ":1:1: header"),
    ("a column that may change what is meant", "vectors", b"birth,death,dim,multiplicity\n0,1,0,3\n",
     ":1:1: header"),
    ("two columns of one name", "compare", b"dim,death,birth,Death\n0,1,0,1\n", ":1:1: header"),
    ("a death before its birth, by names", "distance", b"death,birth,dim\n1,2,0\n", ":2:1: a bar that dies"),
    ("a row that ends early", "wasserstein", HEAD + b"0,0\n", ":2:4: death missing"),
    ("a row that ends early, by names", "plot", b"birth,death,dim\n0,1\n", ":2:4: dimension missing"),
    ("a row with a cell too many", "plot", HEAD + b"0,0,1,2\n", ":2:7: extra cell"),
    ("a dimension below 0", "distance", HEAD + b"-1,0,1\n", ":2:1: dimension out of range"),
    ("a dimension of 2^31", "vectors", HEAD + b"2147483648,0,1\n", ":2:1: dimension out of range"),
    ("a dimension beyond 64 bits", "plot", HEAD + b"99999999999999999999,0,1\n", ":2:1: dimension"),
    ("half a dimension", "compare", HEAD + b"0.5,0,1\n", ":2:1: dimension is not an integer"),
    ("death before birth", "distance", HEAD + b"0,2,1\n", ":2:1: a bar that dies before its birth"),
    ("death at -inf", "vectors", HEAD + b"0,0,-inf\n", ":2:1: a bar that dies before its birth"),
    ("birth at inf", "plot", HEAD + b"0,inf,inf\n", ":2:1: birth of a bar, found inf"),
    ("a birth that is NaN", "wasserstein", HEAD + b"0,nan,1\n", ":2:3: not a number"),
    ("a death that is NaN", "images", HEAD + b"0,0,nan\n", ":2:5: not a number"),
    ("a number beyond the doubles", "groups", HEAD + b"0,1e400,1\n", ":2:3: number out of range"),
    ("a hexadecimal birth", "distance", HEAD + b"0,0x1,2\n", ":2:3: not a number"),
    ("an empty cell", "vectors", HEAD + b"0,,1\n", ":2:3: empty cell"),
    ("a word as a death", "plot", HEAD + b"0,0,never\n", ":2:5: not a number"),
    ("NUL behind the bars", "compare", HEAD + b"0,0,1\n\0", "byte 22: not plain text"),
    ("UTF-16", "distance", GOOD.decode().encode("utf-16"), "UTF-16"),
    ("a bar of the ripser format that never ends", "distance",
     b"persistence intervals in dim 0:\n [0,1\n", ":2:"),
    ("a dimension of the ripser format below 0", "plot",
     b"persistence intervals in dim -1:\n [0,1)\n", ":1:"),
    ("ripser's bars backwards", "vectors", b"persistence intervals in dim 0:\n [2,1)\n", ":2:"),
    ("ten thousand good bars and one that is not", "distance", HEAD + b"0,0,1\n" * 10_000 + b"0,1,0\n",
     ":10002:1: a bar that dies before its birth"),
]

JSON = [
    ("nothing in it", "distance", b"{}", "not a barcode, found no format"),
    ("a list", "plot", b"[]", r":1:1: JSON, found '\['"),
    ("no bars", "vectors", b'{"format": "ph-barcode", "version": 1}', "found no bars"),
    ("another version", "distance", b'{"format": "ph-barcode", "version": 2, "bars": []}',
     ":1:37: version out of range, found 2"),
    ("a version as text", "compare", b'{"format": "ph-barcode", "version": "1", "bars": []}', ":1:37: "),
    ("another format", "plot", b'{"format": "ph-segment", "version": 1, "bars": []}',
     ":1:11: format, found ph-segment"),
    ("distances of ph-distance", "distance", b'{"format": "ph-barcode distances", "version": 1}',
     ":1:11: format, found ph-barcode distances"),
    ("bars that are an object", "vectors", b'{"format": "ph-barcode", "version": 1, "bars": {}}', ":1:48: "),
    ("bars twice", "distance", BEGIN + b'], "bars": []}', ":1:59: bars, found a second list"),
    ("a bar that is a number", "plot", BEGIN + b"1]}", ":1:49: "),
    ("a bar without a death", "distance", BEGIN + b'{"dim": 0, "birth": 0}]}', "found no death"),
    ("a dimension twice", "distance", BEGIN + b'{"dim": 0, "dim": 1, "birth": 0, "death": 1}]}',
     "dim, found a second one, expected one per bar"),
    ("a birth twice", "vectors", BEGIN + b'{"dim": 0, "birth": 0, "birth": 1, "death": 1}]}',
     "birth, found a second one"),
    ("a death twice", "plot", BEGIN + b'{"dim": 0, "birth": 0, "death": 1, "death": null}]}',
     "death, found a second one"),
    ("a birth cell twice", "report",
     BEGIN + b'{"dim": 0, "birth": 0, "death": 1, "birth_cell": {"row": 1}, "birth_cell": {"row": 2}}]}',
     "birth_cell, found a second one"),
    ("a death that is a word", "compare", BEGIN + b'{"dim": 0, "birth": 0, "death": "x"}]}', "found x"),
    ("a birth at infinity", "distance", BEGIN + b'{"dim": 0, "birth": "inf", "death": null}]}', "found inf"),
    ("NaN, as Python writes it", "vectors", BEGIN + b'{"dim": 0, "birth": NaN, "death": 1}]}',
     "found 'N', expected a number"),
    ("1e999", "plot", BEGIN + b'{"dim": 0, "birth": 0, "death": 1e999}]}', "number out of range"),
    ("a dimension of 1e300", "distance", BEGIN + b'{"dim": 1e300, "birth": 0, "death": 1}]}',
     "dimension out of range"),
    ("death before birth", "compare", BEGIN + b'{"dim": 0, "birth": 2, "death": 1}]}', "dies before"),
    ("a comma behind the last bar", "distance", BEGIN + BAR + b",]}", r"found '\]'"),
    ("a number with a sign", "vectors", BEGIN + b'{"dim": 0, "birth": +1, "death": 2}]}', r"found '\+'"),
    *((f"{number} as a number", use, BEGIN + b'{"dim": 0, "birth": %s, "death": 2}]}' % number.encode(),
       f"not a JSON number, found {number}".replace(".", r"\."))
      for number, use in (("00", "distance"), ("-01", "vectors"), (".5", "plot"), ("1.", "compare"),
                          ("-.5", "groups"), ("1.e0", "images"), ("1e-", "wasserstein"))),
    ("a dimension of 00", "report", BEGIN + b'{"dim": 00, "birth": 0, "death": 2}]}', "not a JSON number"),
    ("a truth as a number", "plot", BEGIN + b'{"dim": 0, "birth": true, "death": 2}]}', "found 't'"),
    ("a comment", "distance", BEGIN + b"/* none */]}", "found '/'"),
    ("a second document", "compare", BEGIN + BAR + b"]} {}", "trailing data"),
    ("a bracket too few", "vectors", BEGIN + BAR + b"]", "found the end of the file"),
    ("a tab in a string", "plot", BEGIN + BAR + b'], "x": "a\tb"}', "control character"),
    ("an unknown escape", "distance", BEGIN + BAR + b'], "x": "\\q"}', "unknown escape"),
    ("half an escape", "vectors", BEGIN + BAR + b'], "x": "\\u12"}', "JSON string"),
    ("a string without an end", "plot", BEGIN + BAR + b'], "x": "', "JSON string"),
    ("nested a million times", "distance", BEGIN + b'], "x": ' + b"[" * 1_000_000, "nested too deeply"),
    ("objects nested a million times", "compare", b'{"x":' * 1_000_000, "nested too deeply"),
    ("a cell of planets", "plot",
     BEGIN + b'{"dim": 0, "birth": 0, "death": 1, "birth_cell": {"planets": [0]}}]}', "cell, found none"),
    ("a vertex below 0", "report",
     BEGIN + b'{"dim": 0, "birth": 0, "death": 1, "birth_cell": {"vertices": [-1]}}]}', "number of a cell"),
    ("a vertex beyond 64 bits", "distance",
     BEGIN + b'{"dim": 0, "birth": 0, "death": 1, "birth_cell": {"vertices": [99999999999999999999]}}]}',
     "number of a cell"),
    ("cells of the first bar alone", "vectors",
     BEGIN + b'{"dim": 0, "birth": 0, "death": 1, "birth_cell": {"row": 1}},' + BAR + b"]}", "birth cell"),
    ("a highest dimension below 0", "plot", BEGIN + BAR + b'], "max_dim": -1}', "dimension out of range"),
]

BARS_OF_DIPHA = sample("barcode", "bars.dipha")
BARS_OF_NPY = sample("barcode", "bars.npy")
BINARY = [
    ("DIPHA without its last byte", "distance", "bars.dipha", BARS_OF_DIPHA[:-1], "truncated"),
    ("DIPHA of 2^60 bars", "vectors", "bars.dipha", with_bytes(BARS_OF_DIPHA, 16, b"\0\0\0\0\0\0\0\x10"),
     "truncated|number"),
    ("DIPHA of -1 bars", "plot", "bars.dipha", with_bytes(BARS_OF_DIPHA, 16, b"\xff" * 8),
     "negative number of bars"),
    ("DIPHA of another kind", "distance", "bars.dipha", with_bytes(BARS_OF_DIPHA, 8, b"\7"),
     "not a persistence diagram"),
    ("DIPHA with NaN", "compare", "bars.dipha", dipha(2, 1, 0, float("nan"), 1.), "birth"),
    ("DIPHA with a death before its birth", "distance", "bars.dipha", dipha(2, 1, 0, 2., 1.), "dies before"),
    ("DIPHA with bytes behind the bars", "vectors", "bars.dipha", BARS_OF_DIPHA + b"\0", "trailing"),
    ("NPY of two columns", "distance", "bars.npy", npy("<f8", (1, 2), packed("<f8", [0, 1])), "shape"),
    ("NPY of one axis", "vectors", "bars.npy", npy("<f8", (3,), packed("<f8", [0, 0, 1])), "shape"),
    ("NPY of half a dimension", "plot", "bars.npy", npy("<f8", (1, 3), packed("<f8", [.5, 0, 1])), "dimension"),
    ("NPY of a NaN dimension", "distance", "bars.npy",
     npy("<f8", (1, 3), packed("<f8", [float("nan"), 0, 1])), "dimension"),
    ("NPY of a dimension of 1e300", "compare", "bars.npy", npy("<f8", (1, 3), packed("<f8", [1e300, 0, 1])),
     "dimension"),
    ("NPY of a NaN birth", "vectors", "bars.npy", npy("<f8", (1, 3), packed("<f8", [0, float("nan"), 1])),
     "birth of a bar, found nan"),
    ("NPY of a death before its birth", "plot", "bars.npy", npy("<f8", (1, 3), packed("<f8", [0, 2, 1])),
     "dies before"),
    ("NPY without its last byte", "distance", "bars.npy", BARS_OF_NPY[:-1], "truncated"),
    ("NPY of nine columns, the last for the first", "plot", "bars.npy",
     npy("<f8", (1, 9), packed("<f8", [.5, 0, 0, 0, 0, 0, 0, 1, 0])), "row 0: dimension"),
    ("NPY of ten columns", "distance", "bars.npy", npy("<f8", (1, 10), packed("<f8", [0] * 10)), "shape"),
    ("NPY of complex numbers", "vectors", "bars.npy", with_change(BARS_OF_NPY, b"<f8", b"<c8"), "element type"),
]

FIT = b"""{"format": "ph-vectorise fit", "version": 1, "program": "ph-vectorise 0.1.0", "kind": "image",
"length": 6, "infinite": "drop", "dropped": 0, "power": 1, "blocks": [{"dim": 0, "shape": [2, 3],
"births": {"lo": 0, "hi": 1, "pixels": 3}, "lengths": {"lo": 0, "hi": 1, "pixels": 2}, "sigma": 0.5}]}"""
# name, what is replaced, its replacement, part of the message
FITTED = [
    ("another version", b'"version": 1', b'"version": 9', "version out of range"),
    ("another format", b"ph-vectorise fit", b"ph-vectorise", "format"),
    ("an unknown kind", b'"image"', b'"tarot"', "kind, found tarot"),
    ("infinite bars by an unknown word", b'"drop"', b'"lose"', "infinite"),
    ("a length that is not that of the blocks", b'"length": 6', b'"length": 7', "length"),
    ("a length of 2^63", b'"length": 6', b'"length": 9223372036854775808', "length"),
    ("a dimension below 0", b'"dim": 0', b'"dim": -1', "dimension"),
    ("a shape that is not that of the grids", b"[2, 3]", b"[3, 2]", "shape"),
    ("a shape of other axes", b"[2, 3]", b"[6]", "shape"),
    ("a range backwards", b'"births": {"lo": 0, "hi": 1', b'"births": {"lo": 1, "hi": 0', "found a range from 1 to 0"),
    ("a range without a width", b'"births": {"lo": 0, "hi": 1', b'"births": {"lo": 1, "hi": 1', "found a range from 1 to 1"),
    ("a range beyond the doubles", b'"births": {"lo": 0', b'"births": {"lo": -1e999', "number out of range"),
    ("no pixels", b'"pixels": 3', b'"pixels": 0', "number out of range, found 0"),
    ("10^12 pixels", b'"pixels": 3', b'"pixels": 1000000000000', "number out of range"),
    ("a width of 0", b'"sigma": 0.5', b'"sigma": 0', "sigma"),
    ("a width below 0", b'"sigma": 0.5', b'"sigma": -1', "sigma"),
    ("a power that is NaN", b'"power": 1', b'"power": NaN', "found 'N'"),
    ("a power below 0", b'"power": 1', b'"power": -1', "power"),
    ("no power", b'"power": 1, ', b"", "power"),
    ("no blocks", b'"blocks"', b'"bricks"', "blocks"),
    ("no end", b"}]}", b"}", "found the end of the file"),
    ("nested a million times", b'"power": 1', b'"power": ' + b"[" * 1_000_000, "expected a number"),
]

GROUPS = [
    ("too few words", b"a\nb\na\n", "found 3"),
    ("too many words", b"a\nb\na\nb\na\n", "found 5|:5:"),
    ("one group", b"a\na\na\na\n", "group"),
    ("a group of one", b"a\na\na\nb\n", "group"),
    ("two words on a line", b"a b\nb\na\nb\n", ":1:2: a group"),
    ("nothing", b"", "found 0 words"),
    ("NUL in a word", b"a\0\nb\na\0\nb\n", "byte 1: not plain text"),
]


def entries():
    for rows, row, file in ((TEXT, 61, "bars.csv"), (JSON, 62, "bars.json")):
        for name, use, content, message in rows:
            yield refused(row, name, use, file, content, message)
    for name, use, file, content, message in BINARY:
        yield refused(63, name, use, file, content, message)
    for name, content, message in GROUPS:
        yield Entry(64, name, "ph-distance",
                    ("--groups", "groups.txt", *["good.csv"] * 4), 65, message, "groups",
                    {"good.csv": GOOD, "groups.txt": content})
    for name, old, new, message in FITTED:
        yield Entry(65, name, "ph-vectorise", ("--fitted", "fit.json", "good.csv"), 65, message,
                    "fit.json", {"good.csv": GOOD, "fit.json": with_change(FIT, old, new)})
    for name, program, inputs in (("distances", "ph-distance", ("good.csv", "good.csv")),
                                  ("vectors", "ph-vectorise", ("good.csv",))):
        yield Entry(50, f"{name} to a packed file", program, (*inputs, "-o", "o.csv.GZ"), 64,
                    "found .gz, expected a name without this ending", "o.csv.GZ", {"good.csv": GOOD})
    yield Entry(65, "what was fitted, unchanged", "ph-vectorise", ("--fitted", "fit.json", "good.csv"),
                0, files={"good.csv": GOOD, "fit.json": FIT})


ENTRIES = list(entries())
