# SPDX-License-Identifier: MIT
"""Samples of text formats for numbers: points, distances, complexes, images."""
from sample import Sample
from files import gzipped

SQUARE = b"0 0\n1 0\n1 1\n0 1.25\n"
CIRCLE = (b"1 0\n0.866025 0.5\n0.5 0.866025\n0 1\n-0.5 0.866025\n-0.866025 0.5\n-1 0\n"
          b"-0.866025 -0.5\n-0.5 -0.866025\n0 -1\n0.5 -0.866025\n0.866025 -0.5\n")
DISTANCES = b"0 1 2 1.5\n1 0 1.25 2\n2 1.25 0 1\n1.5 2 1 0\n"
OCTAHEDRON = (b"OFF\n6 8 12\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n"
              b"3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n")


def points(name, content):
    return Sample(name, "points", content, False, ("{}", "--format", "points"))


def of_format(reader, form):
    def make(name, content, *options, sized=False):
        return Sample(name, reader, content, sized, ("{}", "--format", form, *options))
    return make


distances = of_format("distances", "distance")
lower = of_format("lower_distances", "lower-distance")
upper = of_format("upper_distances", "upper-distance")
sparse = of_format("sparse", "sparse")
simplices = of_format("simplices", "simplices")
phat = of_format("phat", "phat")
perseus = of_format("perseus", "perseus")
off = of_format("off", "off")
image = of_format("image", "pgm")

SAMPLES = [
    points("blank.txt", SQUARE),
    points("comma.csv", b"0,0\n1,0\n1,1\n0,1.25\n"),
    points("semicolon.csv", b"0; 0\n1; 0\n1; 1\n0; 1.25\n"),
    points("tab.tsv", b"0\t0\t0\n1\t0\t2e-3\n1\t1\t-.5\n"),
    points("header.csv", b"x,\"y, in metres\",z\n0,0,1\n1,0,2\n0.5,0.5,3\n"),
    points("comments.txt", b"# a square\n\n0 0 # a corner\n1 0\n  1 1  \n# the last\n0 1\n"),
    points("mark.txt", b"\xef\xbb\xbf0 0\n1 0\n1 1\n"),
    points("carriage_return.csv", b"a,b\r\n0,0\r\n1,0\r\n1,1\r\n"),
    points("said.asc", b"//X Y Z\n3\n0 0 1\n1 0 2\n0.5 0.5 3\n"),
    points("one_column.txt", b"0\n1\n1.5\n-4e-1\n"),
    points("trailing_separator.csv", b"0,0,\n1,0,\n1,1,\n"),
    points("denormal.txt", b"0 4.9e-324\n1e-310 1\n-0 1e300\n"),
    points("circle.txt", CIRCLE),
    Sample("square.txt.gz", "points", gzipped(SQUARE), True),
    Sample("two_members.txt.gz", "points", gzipped(SQUARE) + gzipped(b"2 2\n3 3\n"), True),

    distances("full.txt", DISTANCES),
    distances("full.csv", b"a,b,c\n0,1,2\n1,0,1.5\n2,1.5,0\n"),
    distances("never.txt", b"0 1 inf\n1 0 2\ninf 2 0\n"),
    distances("float32.txt", b"0 1.0000001 2\n1 0 1.5\n2 1.4999999 0\n"),
    Sample("correlation.csv", "correlations", b"1,0.5,-0.25\n0.5,1,0\n-0.25,0,1\n", False,
           ("{}", "--format", "distance", "--from-correlation")),
    Sample("full.txt.gz", "distances", gzipped(DISTANCES), True, ("{}", "--format", "distance")),

    lower("lower.txt", b"1\n2 1.25\n1.5 2 1\n"),
    lower("lower.csv", b"1,\n2,1.25,\n1.5,2,1\n"),
    lower("lower_one_line.txt", b"1 2 1.25 1.5 2 1\n"),
    Sample("lower.txt.gz", "lower_distances", gzipped(b"1\n2 1.25\n1.5 2 1\n"), True,
           ("{}", "--format", "lower-distance")),
    upper("upper.txt", b"1 2 1.5\n1.25 2\n1\n"),
    upper("condensed.csv", b"1,2,1.5,1.25,2,1\n"),
    sparse("sparse.txt", b"0 1 1\n1 2 1.25\n2 3 1\n0 3 1.5\n"),
    sparse("sparse.csv", b"i,j,d\n0,1,1\n1,2,1.25\n1,0,1\n5,2,inf\n"),
    Sample("known.sparse", "sparse", b"# pairs\n0 1 0.5\n3 1 2\n", False),

    simplices("triangle.simplices", b"0 : 0\n1 : 0\n2 : 0.5\n0 1 : 1\n1 2 : 1\n0 2 : 2\n0 1 2 : 3\n"),
    simplices("any_order.txt", b"1 0 : 1e0\n1 : -inf\n0 : 0\n"),
    phat("triangle.phat", b"0\n0\n0\n1 0 1\n1 1 2\n1 0 2\n2 3 4 5\n"),
    phat("edge.txt", b"# two points and an edge\n0\n0\n1 0 1\n"),

    perseus("grid.perseus", b"2\n3 2\n0 5 2\n4 9 1\n", sized=True),
    perseus("line.perseus", b"1\n5\n3\n1\n4\n1\n5\n", sized=True),
    perseus("torus.perseus", b"2\n-3\n-3\n0 1 1\n1 1 1\n1 1 1\n", sized=True),
    perseus("volume.cub", b"3\n2 2 2\n1 2 3 4 5 6 inf 8\n", sized=True),
    perseus("missing.perseus", b"2\n2 2\n1 -1\n2 3\n", sized=True),
    perseus("cubes.perseus", b"2\n0 0 1\n1 0 4\n1 1 2\n"),

    off("octahedron.off", OCTAHEDRON, sized=True),
    off("points.off", b"OFF 3 0 0\n0 0 0\n1 0 0\n0 1 0\n", sized=True),
    off("modelnet.off", b"OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", sized=True),
    Sample("split.off", "welded", b"OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 1 0\n1 0 0\n"
           b"3 0 1 2\n3 3 4 5\n", True, ("{}", "--format", "off")),
    off("colours.off", b"OFF\n# two triangles\n3 2 0\n0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n"
        b"3 0 1 2 255 0 9\n3 2 1 0\n", sized=True),

    image("plain.pgm", b"P2 3 2 9\n0 5 2\n4 9 1\n", sized=True),
    image("comment.pgm", b"P2\n# made by hand\n3 2\n# largest\n255\n0 50 2 4 90 1\n", sized=True),
    image("deep.pgm", b"P2 2 2 65535 0 65535 400 7\n", sized=True),
]
