# SPDX-License-Identifier: MIT
"""Rows 25 to 30: files that end too early. Other tests pass every prefix of every sample to the
readers; these entries pass one truncated file per sample to the programs."""
import samples

from entry import Entry, refused

ROW_OF_READER = {
    "points": 25, "npy_points": 25, "distances": 25, "sparse": 25, "lower_distances": 25,
    "image": 26, "npy_image": 26, "nifti": 26, "nrrd": 26, "metaimage": 26, "vti": 26, "tiff": 26,
    "perseus": 26,
    "phat": 27, "off": 27, "welded": 27, "ply_mesh": 27,
    "pcd": 28, "ply": 28, "pts": 28, "npy_cloud": 28, "tree": 28,
}


# Maps the reader of a sample to the form of the entry, which compare_peers.py uses.
FORM_OF_READER = {"pcd": "pcd", "ply": "ply", "pts": "pts", "off": "off", "perseus": "perseus"}


def form_of(sample):
    if sample.name.endswith(".gz"):
        return ""
    return "dipha" if sample.name.endswith(".dipha") else FORM_OF_READER.get(sample.reader, "")


def without_its_end(sample):
    """The content without its last byte or, for text, without its line end and its last character,
    which is the last token."""
    content = sample.content
    return content[:-1] if not content.endswith(b"\n") else content.rstrip(b"\n")[:-1]


def cut_samples():
    for sample in samples.SAMPLES:
        if not sample.sized or not sample.program or sample.reader == "png":
            continue
        packed = sample.name.endswith((".gz", ".npz"))
        row = 29 if packed else ROW_OF_READER[sample.reader]
        options = tuple(a.format(sample.name) for a in sample.arguments)
        yield Entry(row, f"{sample.reader}: {sample.name} cut at its end", sample.program, options, 65,
                    "truncated|too short|incomplete|not fit|bytes that follow|number of connections",
                    sample.name, {sample.name: without_its_end(sample)}, form=form_of(sample))
        half = sample.content[:len(sample.content) // 2]
        if row in (29, 28):
            yield Entry(row, f"{sample.reader}: {sample.name} cut in half", sample.program, options,
                        65, ".", sample.name, {sample.name: half}, form=form_of(sample))


def cut_pictures():
    depth = samples.named("png", "depth.png").content
    arguments = ("--depth", "cut.png", "--intrinsics", "100,100,4,3")
    for name, size in (("in its signature", 5), ("in its header", 20), ("in its pixels", 60),
                       ("before its end", len(depth) - 1)):
        yield Entry(26, f"png: depth cut {name}", "ph-segment", arguments, 65, "PNG", "cut.png",
                    {"cut.png": depth[:size]})


def text_without_a_length():
    hint = "is the file truncated"
    yield refused(30, "points", "in a row", "0 0\n1 0\n1", f":3:1: ragged row.*{hint}")
    yield refused(30, "points", "in a number", "0 0\n1 1e", ":2:3: not a number")
    yield refused(30, "points", "behind a separator", "0,0\n1,", f":2:1: ragged row.*{hint}")
    yield refused(30, "distance", "in a row", "0 1 2\n1 0 3\n2 3", f"row 2 of the matrix is too short, found 2 cells.*{hint}")
    yield refused(30, "distance", "after a row", "0 1 2\n1 0 3\n", f"found 2 rows.*{hint}")
    yield refused(30, "distance", "in a number", "0 1e\n", "input.txt")
    yield refused(30, "lower-distance", "in a row", "1\n2 3\n4 5", f":3:1: row 3 .*{hint}")
    yield refused(30, "lower-distance", "in one line", "1 2 3 4 5", "not a triangle")
    yield refused(30, "upper-distance", "after a row", "1 2 3\n4 5\n", "truncated matrix")
    yield refused(30, "upper-distance", "in one line", "1 2 3 4 5", "not a triangle")
    yield refused(30, "sparse", "in a row", "0 1 1\n1 2", ":2:4: distance missing")
    yield refused(30, "simplices", "before a value", "0 : 0\n1 :", ":2:4: no value")
    yield refused(30, "simplices", "before the colon", "0 : 0\n1", ":2:2: no value")
    yield refused(30, "phat", "in the facets", "0\n0\n0\n1 0 1\n1 1 2\n1 0 2\n2 3 4",
                  r"input\.phat:7")
    yield refused(30, "perseus", "in a cube", "2\n0 0 1\n1 0", ":3:4: incomplete cube")
    yield refused(30, "binary", "in a number", b"\0\0\x80\x3f\0\0", "truncated or not a triangle")
    yield refused(30, "xyz", "in a row", "0 0 1\n1 0", f":2:1: ragged row.*{hint}")


ENTRIES = [*cut_samples(), *cut_pictures(), *text_without_a_length()]
