# SPDX-License-Identifier: MIT
"""Rows 17 to 24 and 43 to 46: rows of numbers, header rows, invalid matrices, and pairs of
points."""
import struct

from files import dipha, npy, packed

from clouds import pcd_header, ply_header, XYZ
from entry import bars, refused, taken

TRIO = bars("0,0,1", "0,0,2", "0,0,inf")


def square(values, descr="<f8"):
    side = int(len(values) ** 0.5)
    return npy(descr, (side, side), packed(descr, values))


def ragged():
    yield refused(17, "points", "a short row", "0 0\n1\n2 2\n", ":2:1: ragged row, found 1 cell, .*2")
    yield refused(17, "points", "a long row", "0 0\n1 1 1\n", ":2:1: ragged row, found 3 cells")
    yield refused(17, "points", "an empty cell", "0,0\n1,,1\n", ":2:3: empty cell")
    yield refused(17, "points", "a first empty cell", "0,0\n,1\n", ":2:1: empty cell")
    yield refused(17, "points", "only separators", ",,\n", ":1:1: empty cell")
    yield refused(17, "distance", "a short row", "0 1 2\n1 0\n2 1 0\n", ":2:1: row 1 .*too short")
    yield refused(17, "lower-distance", "a short row", "1\n2\n3 4 5\n", ":2:1: row 2 .*too short")
    yield refused(17, "upper-distance", "a short row", "1 2 3\n4\n5\n", ":2:1: row 1 .*too short")
    yield refused(17, "sparse", "no distance", "0 1 1\n1 2\n", ":2:4: distance missing")
    yield refused(17, "simplices", "no value", "0 : 0\n1 :\n", ":2:4: no value")
    yield refused(17, "simplices", "no vertices", "0 : 0\n: 1\n", ":2:1: no vertices")
    yield refused(17, "off", "a vertex of two", "OFF\n1 0 0\n0.25 0.5\n", ":3:9: line too short")
    yield refused(17, "off", "a face without all corners", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n",
                  ":6:6: line too short")
    yield refused(17, "xyz", "a short row", "0 0 1\n1 1\n", ":2:1: ragged row")
    yield refused(17, "xyz", "two columns", "0 0\n1 1\n", "too few columns")
    yield refused(17, "pts", "a short row", "2\n0 0 1\n1 1\n", ":3:1: ragged row")
    yield refused(17, "pcd", "a short row", pcd_header(width=1) + b"0.25 0.5\n",
                  ":12:9: point 0 is incomplete")
    yield refused(17, "ply", "a short row", ply_header("ascii", "element vertex 1", *XYZ) 
                  + b"0.25 0.5\n", ":8:9: line too short")


def header_rows():
    note = "line 1 is a header: skipped"
    yield taken(18, "points", "names", "x y\n0 0\n1 0\n", bars("0,0,1", "0,0,inf"), note=note)
    yield taken(18, "points", "quoted names", '"x, in m",y\n0,0\n1,0\n', bars("0,0,1", "0,0,inf"),
                note=note)
    yield taken(18, "distance", "names", "a,b\n0,1\n1,0\n", bars("0,0,1", "0,0,inf"), note=note)
    yield taken(18, "sparse", "names", "i,j,d\n0,1,1\n", bars("0,0,1", "0,0,inf"), note=note)
    yield refused(18, "points", "a name among numbers", "x 1\n0 0\n", ':1:1: not a number, found "x"')
    yield refused(18, "points", "a number that looks like a name", "1x y\n0 0\n", ":1:1: ")
    yield refused(18, "points", "nan as names", "nan nan\n0 0\n", ":1:1: ")
    yield refused(18, "points", "two headers", "x y\nm m\n0 0\n", ":2:1: not a number")
    yield refused(18, "points", "a header in the middle", "0 0\nx y\n1 1\n", ":2:1: not a number")
    yield refused(18, "points", "a column of names", "a 0 1\nb 1 0\n", ":1:3|:1:1")
    yield refused(18, "xyz", "no x", "u,v,w\n0,0,1\n", "x, y and z")
    yield refused(18, "xyz", "x twice", "x,x,z\n0,0,1\n", "x, y and z")


def extra_columns():
    yield refused(19, "distance", "a column more", "0 1 9\n1 0 9\n", "not square|do not match|rows")
    yield refused(19, "distance", "a cell more", "0 1\n1 0 5\n", ":2:1: row 1 .* too long")
    yield refused(19, "lower-distance", "a cell more", "1\n2 3 4\n", ":2:1: row 2 .*too long")
    yield refused(19, "upper-distance", "a cell more", "1 2\n3 4\n", ":2:1: row 1 .*too long")
    yield refused(19, "sparse", "a fourth column", "0 1 1 7\n", ':1:7: extra cell, found "7"')
    yield refused(19, "simplices", "two values", "0 : 1 2\n", ":1:7: extra cell")
    yield refused(19, "simplices", "two colons", "0 : 1 : 2\n", ":1:7: ")
    yield refused(19, "perseus", "two dimensions", "2 2\n2 2\n1 2 3 4\n", ":1:3: extra cell")
    yield refused(19, "pts", "two counts", "2 2\n0 0 1\n1 1 1\n", "input.pts:")
    yield refused(19, "pcd", "a cell more", pcd_header(width=1) + b"0 1 2 3\n", ":12:7: extra cell")
    yield refused(19, "ply", "a cell more", ply_header("ascii", "element vertex 1", *XYZ)
                  + b"0 1 2 3\n", ":8:7: extra cell")


def separators():
    yield refused(20, "points", "a comma, then a blank", "0,0\n1 0\n", ":2:3: mixed separators|:2:1: ")
    yield refused(20, "points", "a comma and a semicolon", "0,0;1\n", ":1:3: mixed separators")
    yield refused(20, "points", "in one row", "0 0,1\n", ":1:3: mixed separators")
    yield refused(20, "distance", "a semicolon, then a comma", "0;1\n1,0\n", ":2:")
    yield refused(20, "sparse", "a comma, then a blank", "0,1 1\n", ":1:3: mixed separators")
    yield refused(20, "points", "another one", "0|0\n1|0\n", ":1:1: not a number")
    yield refused(20, "points", "a full stop for all", "0.0.1\n", ":1:1: not a number")
    yield taken(20, "points", "blanks around commas", "0 , 0\n1,0\n", bars("0,0,1", "0,0,inf"))


def not_square():
    yield refused(21, "distance", "rows missing", "0 1 2\n1 0 3\n", "found 2 rows")
    yield refused(21, "distance", "rows more", "0 1\n1 0\n1 1\n", ":3:1: not square")
    yield refused(21, "distance", "one row", "0 1 2 3\n", "not square|do not match")
    yield refused(21, "lower-distance", "no triangle", "1 2 3 4\n", ":1:1: not a triangle")
    yield refused(21, "upper-distance", "no triangle", "1 2 3 4 5\n", ":1:1: not a triangle")
    yield refused(21, "upper-distance", "rows missing", "1 2 3\n4 5\n", "truncated matrix, found 2")
    yield refused(21, "upper-distance", "rows more", "1 2\n3\n4\n", ":3:1: row 2 .* too long")
    yield refused(21, "binary", "no triangle", struct.pack("<2f", 1, 2), "not a triangle")
    yield refused(21, "npy-distance", "2 x 3", npy("<f8", (2, 3), bytes(48)), "not a square matrix")
    yield refused(21, "npy-points", "three axes", npy("<f8", (1, 2, 1), bytes(16)),
                  "not a set of points")
    yield refused(21, "perseus", "a value short", "2\n2 2\n1 2 3\n", "truncated")
    yield refused(21, "pgm", "a pixel short", "P2 2 2 9\n1 2 3\n", "truncated")


def diagonal():
    yield refused(22, "distance", "not zero", "0 1\n1 3\n", ":2:3: non-zero diagonal, found 3")
    yield taken(22, "distance", "rounding", "1e-9 1\n1 0\n", bars("0,0,1", "0,0,inf"),
                note="0 except for rounding")
    yield refused(22, "distance", "more than rounding", "1e-5 1\n1 0\n", ":1:1: non-zero diagonal")
    yield refused(22, "npy-distance", "not zero", square([0, 1, 1, 3]), "diagonal at row 1, column 1")
    yield refused(22, "dipha", "not zero", dipha(7, 2, 0., 1., 1., 3.), "diagonal")
    yield refused(22, "distance", "negative distance", "0 -1\n-1 0\n", ":1:3: negative distance")
    yield refused(22, "lower-distance", "negative distance", "-1\n", ":1:1: negative distance")
    yield refused(22, "upper-distance", "negative distance", "1 -2\n1\n", ":1:3: negative distance")
    yield refused(22, "sparse", "negative distance", "0 1 -1\n", ":1:5: negative distance")
    yield refused(22, "binary", "negative distance", struct.pack("<f", -1), "byte 0: negative")
    yield refused(22, "dipha", "negative distance", dipha(7, 2, 0., -1., -1., 0.),
                  "negative distance")
    yield refused(22, "npy-distance", "NaN", square([0, float("nan")] * 2), "NaN")
    yield refused(22, "binary", "NaN", struct.pack("<f", float("nan")), "byte 0: .*NaN")
    births = "2 1\n1 0.5\n"
    yield taken(22, "distance", "births", births, bars("0,0.5,inf"), "--diagonal", "births")
    yield refused(22, "distance", "births without the option", births, "--diagonal births")
    yield taken(22, "npy-distance", "births", square([2, 3, 3, 0.5]), bars("0,0.5,inf", "0,2,3"),
                "--diagonal", "births")
    yield taken(22, "dipha", "births", dipha(7, 2, 2., 3., 3., 0.5),
                bars("0,0.5,inf", "0,2,3"), "--diagonal", "births")
    for bad in ("-1", "inf"):
        yield refused(22, "distance", f"{bad} as a birth", f"0 1\n1 {bad}\n", ":2:3: ", "--diagonal",
                      "births")
    yield refused(22, "npy-distance", "inf as a birth", square([0, 1, 1, float("inf")]), "not a birth",
                  "--diagonal", "births")
    yield taken(22, "distance", "-0", "-0 1\n1 -0.0\n", bars("0,0,1", "0,0,inf"))


def asymmetric():
    content = "0 1 2\n1.5 0 3\n2 3 0\n"
    yield refused(23, "distance", "by a half", content, r":2:1: asymmetric .*d\(1,0\) = 1.5 .*--symm")
    yield refused(23, "npy-distance", "by a half", square([0, 1, 1.5, 0]), "asymmetric")
    yield refused(23, "dipha", "by a half", dipha(7, 2, 0., 1., 1.5, 0.), "asymmetric")
    yield refused(23, "distance", "inf on one side", "0 inf\n1 0\n", ":2:1: asymmetric")
    yield refused(23, "distance", "by 1e-5", "0 1\n1.00001 0\n", ":2:1: asymmetric")
    yield taken(23, "distance", "by 1e-7", "0 1.0000001\n1 0\n", bars("0,0,1", "0,0,inf"))
    for how, rest in (("max", "0,0,1.5"), ("min", "0,0,1"), ("lower", "0,0,1.5")):
        yield taken(23, "distance", f"by a half, {how}", content, bars(rest, "0,0,2", "0,0,inf"),
                    "--symmetrise", how)


def correlations():
    content = "1 0.5\n0.5 1\n"
    yield refused(24, "distance", "without the option", content, "diagonal.*--from-correlation")
    yield refused(24, "npy-distance", "without the option", square([1, 0.5, 0.5, 1]),
                  "diagonal.*--from-correlation")
    yield taken(24, "distance", "with the option", content, bars("0,0,0.5", "0,0,inf"),
                "--from-correlation")
    yield refused(24, "points", "names of rows", "a,b\np,0\nq,1\n", ":2:1: .*--columns")
    yield refused(24, "sparse", "above 1", "0 1 1.5\n", ":1:5: not a correlation",
                  "--from-correlation")
    yield taken(24, "sparse", "with the option", "0 1 0.75\n", bars("0,0,0.25", "0,0,inf"),
                "--from-correlation")
    yield refused(24, "distance", "above 1", "1 1.5\n1.5 1\n", ":1:3: not a correlation",
                  "--from-correlation")
    yield refused(24, "distance", "distances as correlations", "0 1\n1 0\n",
                  ":1:1: diagonal of a correlation matrix", "--from-correlation")
    yield refused(24, "distance", "asymmetric correlations", "1 0.5\n0.25 1\n", ":2:1: asymmetric",
                  "--from-correlation")


def sparse_of_dipha(degrees, ids, distances, count=3):
    return dipha(8, count, *degrees, *ids, *distances)


def pairs():
    yield refused(43, "sparse", "first id", "-1 1 1\n", ":1:1: point out of range, found .*-1")
    yield refused(43, "sparse", "second id", "0 1 1\n0 -2 1\n", ":2:3: point out of range")
    yield refused(43, "dipha", "an id", sparse_of_dipha([1, 0, 0], [-1], [1.]), "connected point")
    yield refused(43, "dipha", "a degree", sparse_of_dipha([-1, 1, 0], [1], [1.]), "connections")
    yield refused(43, "simplices", "a vertex", "-1 : 0\n", ":1:1: vertex out of range")
    yield refused(43, "phat", "a facet", "0\n1 -1\n", ":2:3: facet")
    yield refused(43, "perseus", "a coordinate", "2\n-1 0 5\n", ":2:1: coordinate out of range")
    yield refused(43, "off", "a corner", "OFF\n1 1 0\n0 0 0\n1 -1\n", ":4:3: vertex out of range")
    for word in ("4000000000", "9223372036854775808", "99999999999999999999999"):
        yield refused(44, "sparse", word, f"0 {word} 1\n", ":1:3: point out of range")
        yield refused(44, "phat", word, f"0\n1 {word}\n", ":2:3: facet")
    for word in ("2147483647", "1048576"):
        yield refused(44, "sparse", f"a lonely {word}", f"0 1 1\n0 {word} 1\n",
                      ":2:1: point far beyond the others", frugal=True)
    yield refused(44, "dipha", "an id", sparse_of_dipha([1, 0, 0], [4_000_000_000], [1.]),
                  "connected point out of range")
    yield refused(44, "off", "a corner", "OFF\n1 1 0\n0 0 0\n1 4000000000\n", ":4:3: vertex out of")
    yield refused(44, "perseus", "a coordinate", "2\n4000000000 4000000000 5\n", "lie too far apart",
                  frugal=True)
    yield refused(44, "simplices", "2^63", "9223372036854775808 : 0\n", ":1:1: vertex out of range")
    yield refused(45, "sparse", "another value", "0 1 1\n1 2 1\n1 0 2\n",
                  ":3:1: pair 0 1 listed again with another distance, found 2, expected 1")
    yield refused(45, "dipha", "another value", sparse_of_dipha([1, 1, 0], [1, 0], [1., 2.]),
                  "pair 0 1 listed again")
    yield taken(45, "sparse", "the same value", "0 1 1\n1 2 2\n1 0 1\n", TRIO)
    yield refused(45, "simplices", "a simplex twice", "0 : 0\n0 : 1\n", r"input\.simplices:2")
    yield refused(45, "simplices", "a simplex twice, other order", "0 : 0\n1 : 0\n0 1 : 1\n1 0 : 1\n",
                  r"input\.simplices:4")
    yield refused(45, "perseus", "a cube twice", "2\n0 0 1\n0 0 2\n", r"input\.perseus:3")
    yield refused(45, "phat", "a facet twice", "0\n1 0 0\n", ":2:5: facets of cell 1 not ascending")
    yield refused(46, "sparse", "a pair", "0 0 1\n", ":1:3: a point joined to itself")
    yield refused(46, "sparse", "a pair at distance 0", "0 1 1\n1 1 0\n", ":2:3: a point joined")
    yield refused(46, "dipha", "a pair", sparse_of_dipha([1, 0, 0], [0], [1.]),
                  "distance of 0 and 0")
    yield refused(46, "simplices", "a vertex twice", "0 : 0\n0 0 : 1\n", r"input\.simplices:2")
    yield refused(46, "phat", "its own facet", "0\n1 1\n", ":2:3: facet of cell 1 out of range")


ENTRIES = [*ragged(), *header_rows(), *extra_columns(), *separators(), *not_square(), *diagonal(),
           *asymmetric(), *correlations(), *pairs()]
