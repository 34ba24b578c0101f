# SPDX-License-Identifier: MIT
"""Rows 69 to 71: part files of a computation that several machines share. The files are damaged,
hold false data with a matching checksum, or belong to another computation."""
import binascii
import struct

from entry import Entry, with_bytes

NAN, INF = float("nan"), float("inf")


def sealed(kind, content):
    head = b"ph part\n" + kind.ljust(8).encode() + struct.pack("<IQ", 1, len(content))
    return head + content + struct.pack("<I", binascii.crc32(head + content))


def listed(items, form=None):
    items = list(items)
    return struct.pack("<Q", len(items)) + b"".join(
        struct.pack("<" + form, *item) if form else item for item in items)


def text(words):
    return struct.pack("<Q", len(words)) + words


def inputs(names=(b"a.txt", b"b.txt"), part=0, parts=1, code=0, failure=b"", bars=((0, 0., 1.),),
           options=(), numbers=None, count=None):
    """A part file of a batch: the bars of some of its inputs."""
    own = [i for i in range(len(names)) if i % parts == part] if count is None else range(count)
    return sealed("inputs", listed(map(text, names)) + listed(map(text, options))
                  + struct.pack("<i", parts)
                  + listed([(part,)] if numbers is None else [(n,) for n in numbers], "i")
                  + listed(struct.pack("<QQi", i, 1, code) + text(failure) + listed(bars, "idd")
                           for i in own))


def cloud(part=0, parts=2, points=4, axes=2, sample=4, blocks=4, limit=INF, print_=7, present=None,
          size=2, numbers=(0, 0), edges=((1., 1, 0),), claims=(), more=b""):
    """A part file of a cloud. @param numbers how many points were left out before each point."""
    return sealed("cloud", struct.pack("<qqqiidQ", points, axes, sample, parts, blocks, limit, print_)
                  + listed([(p,) for p in ([part] if present is None else present)], "i")
                  + struct.pack("<q", size) + listed([(n,) for n in numbers], "B")
                  + listed(edges, "dII") + listed(claims, "dII") + more)


def image(extents=(2, 2), periodic=(0, 0), type_=0, construction=1, sign=0, limit=1.7976931348623157e308,
          parts=1, min_dim=0, max_dim=0, cells=0, loops=0, layers=(), first=0, last=0, forest=None,
          tops=b"\0", bars=((0, 1., INF),), numbers=b"\0\0", more=b""):
    """A part file of an image; by default the whole image, 2 x 2 voxels with value 1."""
    content = listed([(n,) for n in extents], "q") + bytes(periodic)
    content += struct.pack("<BBBd3iBB", type_, construction, sign, limit, parts, min_dim, max_dim, cells, loops)
    content += listed([(n,) for n in layers], "q") + struct.pack("<ii", first, last)
    content += (b"\1" + roots() if forest is None else forest) + tops
    content += struct.pack("<QQQ", 0, 0, 0)
    content += listed(struct.pack("<idd", *bar) + numbers for bar in bars)
    content += struct.pack("<Q", 7)  # the fingerprint
    return sealed("image", content + more)


def roots(items=((1., 0, 0, 0),), outside=(0, 0), before=(), after=(), bridges=()):
    """A forest of components: its roots, the nodes for the outside, both seams, and bridges."""
    return (listed([struct.pack("<dQII", *item) for item in items]) + struct.pack("<II", *outside)
            + b"".join(listed([(root,) for root, _ in seam], "I")
                       + b"".join(struct.pack("<d", value) for _, value in seam)
                       for seam in (before, after))
            + listed([struct.pack("<dQIII", *bridge) for bridge in bridges]))


WHOLE_INPUTS = inputs()
DAMAGED = [
    ("nothing", b"", "found 0 bytes that do not begin with"),
    ("the magic alone", b"ph part\n", "part"),
    ("a barcode", b"dim,birth,death\n0,0,1\n", "that do not begin with"),
    ("another magic", b"PH PART\n" + WHOLE_INPUTS[8:], "that do not begin with"),
    ("an unknown kind", WHOLE_INPUTS[:8] + b"potato  " + WHOLE_INPUTS[16:], "damaged"),
    ("version 2", with_bytes(WHOLE_INPUTS, 16, b"\2"), "version"),
    ("without its last byte", WHOLE_INPUTS[:-1], "incomplete"),
    ("without its checksum", WHOLE_INPUTS[:-4], "incomplete"),
    ("a byte behind its end", WHOLE_INPUTS + b"\0", "part"),
    ("a length of 2^64 - 1", with_bytes(WHOLE_INPUTS, 20, b"\xff" * 8), "incomplete"),
    ("a length of 0", with_bytes(WHOLE_INPUTS, 20, b"\0" * 8), "incomplete"),
    ("a bit that fell over", with_bytes(WHOLE_INPUTS, 40, bytes([WHOLE_INPUTS[40] ^ 1])), "checksum|damaged"),
    ("another checksum", WHOLE_INPUTS[:-1] + bytes([WHOLE_INPUTS[-1] ^ 128]), "damaged"),
]
LYING = [
    ("inputs: a birth that is NaN", inputs(bars=[(0, NAN, 1.)]), "damaged bar"),
    ("inputs: a death that is NaN", inputs(bars=[(0, 0., NAN)]), "damaged bar"),
    ("inputs: a death before its birth", inputs(bars=[(0, 2., 1.)]), "damaged bar"),
    ("inputs: a dimension below 0", inputs(bars=[(-5, 0., 1.)]), "damaged bar"),
    ("inputs: a failure with exit code 0", inputs(failure=b"lost", bars=[]), "damaged code"),
    ("inputs: an exit code without a failure", inputs(code=65, bars=[]), "damaged code"),
    ("inputs: an exit code below 0", inputs(code=-1, failure=b"lost", bars=[]), "damaged code"),
    ("inputs: an exit code of 300", inputs(code=300, failure=b"lost", bars=[]), "damaged code"),
    ("inputs: a failure that has bars", inputs(code=65, failure=b"lost"), "damaged code"),
    ("inputs: part 5 of 1", inputs(numbers=[5]), "damaged number"),
    ("inputs: part -1", inputs(numbers=[-1]), "damaged number"),
    ("inputs: a part twice", inputs(parts=3, numbers=[1, 1]), "damaged number"),
    ("inputs: of no parts", inputs(numbers=[]), "damaged number"),
    ("inputs: of 0", sealed(
        "inputs", listed([]) + listed([]) + struct.pack("<i", 0) + listed([(0,)], "i") + listed([])),
     "damaged number"),
    ("inputs: fewer results than inputs", inputs(count=1), "damaged list"),
    ("inputs: more results than inputs", inputs(count=3), "damaged list"),
    ("inputs: 2^61 names", sealed("inputs", struct.pack("<Q", 2**61)), "damaged input"),
    ("inputs: a name of 2^63 letters", sealed("inputs", struct.pack("<QQ", 1, 2**63)), "damaged"),
    ("cloud: an edge at NaN", cloud(edges=[(NAN, 1, 0)]), "damaged edge"),
    ("cloud: an edge below 0", cloud(edges=[(-1., 1, 0)]), "damaged edge"),
    ("cloud: an edge at -0", cloud(edges=[(-0., 1, 0)]), "damaged edge"),
    ("cloud: an edge at infinity", cloud(edges=[(INF, 1, 0)]), "damaged edge"),
    ("cloud: an edge beyond the threshold", cloud(limit=.5), "damaged edge"),
    ("cloud: an edge of a point with itself", cloud(edges=[(1., 1, 1)]), "damaged edge"),
    ("cloud: an edge of a point that is not there", cloud(edges=[(1., 9, 0)]), "damaged edge"),
    ("cloud: edges out of order",
     cloud(numbers=(0, 0, 0), size=3, edges=[(2., 1, 0), (1., 2, 0)]), "damaged edge"),
    ("cloud: edges that close a circle",
     cloud(numbers=(0, 0, 0), size=3, edges=[(1., 1, 0), (1., 2, 0), (1., 2, 1)]), "damaged forest"),
    ("cloud: a claim that is no edge", cloud(claims=[(1., 0, 1)]), "damaged claim"),
    ("cloud: a threshold that is NaN", cloud(limit=NAN), "damaged threshold"),
    ("cloud: a threshold below 0", cloud(limit=-1.), "damaged threshold"),
    ("cloud: -1 points", cloud(points=-1), "damaged size"),
    ("cloud: 2^62 points", cloud(points=2**62), "damaged size"),
    ("cloud: nine coordinates", cloud(axes=9), "damaged size"),
    ("cloud: a sample of more than all", cloud(sample=5), "damaged size"),
    ("cloud: 0 parts", cloud(parts=0), "damaged number"),
    ("cloud: 0 blocks", cloud(blocks=0), "damaged number"),
    ("cloud: part 2 of 2", cloud(part=2), "damaged part"),
    ("cloud: none of its parts", cloud(present=[]), "damaged part"),
    ("cloud: parts out of order", cloud(present=[1, 0]), "damaged part"),
    ("cloud: more points than all", cloud(size=5), "damaged number of points"),
    ("cloud: a point behind the last one", cloud(numbers=(0, 9)), "damaged point"),
    ("cloud: bytes behind the claims", cloud(more=b"\0"), "damaged end"),
    ("image: a root at NaN", image(forest=b"\1" + roots([(NAN, 0, 0, 0)])), "damaged root"),
    ("image: a bridge at NaN", image(forest=b"\1" + roots(bridges=[(NAN, 0, 0, 0, 0)])), "damaged bridge"),
    ("image: a seam at NaN", image(forest=b"\1" + roots(before=[(0, NAN)])), "damaged seam"),
    ("image: a seam of a root that is not there", image(forest=b"\1" + roots(before=[(9, 1.)])), "damaged seam"),
    ("image: an unknown kind of root", image(forest=b"\1" + roots([(1., 0, 0, 9)])), "damaged root"),
    ("image: a root outside that is not there", image(forest=b"\1" + roots(outside=(7, 0))), "damaged root"),
    ("image: 2^60 roots", image(forest=b"\1" + struct.pack("<Q", 2**60)), "damaged roots"),
    ("image: no forest", image(forest=b"\0"), "damaged forest"),
    ("image: a birth that is NaN", image(bars=[(0, NAN, 1.)]), "damaged bar"),
    ("image: a death before its birth", image(bars=[(0, 2., 1.)]), "damaged bar"),
    ("image: a dimension below 0", image(bars=[(-1, 0., 1.)]), "damaged bar"),
    ("image: 2^63 voxels", image(extents=(2**32, 2**31)), "damaged extents"),
    ("image: an extent of 0", image(extents=(0, 2)), "damaged extents"),
    ("image: an extent below 0", image(extents=(-2, 2)), "damaged extents"),
    ("image: one axis", image(extents=(4,), periodic=(0,)), "damaged number of parts"),
    ("image: nine axes", image(extents=(2,) * 9, periodic=(0,) * 9), "damaged"),
    ("image: an axis that half closes up", image(periodic=(2, 0)), "damaged axis"),
    ("image: voxels of an unknown type", image(type_=99), "damaged type"),
    ("image: a threshold that is NaN", image(limit=NAN), "damaged threshold"),
    ("image: 0 parts", image(parts=0), "damaged number of parts"),
    ("image: more parts than layers", image(parts=3), "damaged number of parts"),
    ("image: ends before it begins", image(first=1, last=0), "damaged number"),
    ("image: part 5 of 1", image(first=5, last=5), "damaged number"),
    ("image: layers that are not there", image(layers=(7,)), "damaged layers"),
    ("image: bytes behind the bars", image(more=b"\0"), "damaged end"),
]
SQUARE = b"0 0\n1 0\n0 1\n5 5\n"
MIXED = [
    ("one of two parts", {"a.ph": cloud()}, "found 1 of 2"),
    ("a part twice", {"a.ph": cloud(), "b.ph": cloud()}, "twice"),
    ("of 2 and of 3 parts", {"a.ph": cloud(), "b.ph": cloud(1, 3)}, "found parts that differ in points, options"),
    ("of another cloud", {"a.ph": cloud(), "b.ph": cloud(1, print_=8)}, "found parts that differ in points, options"),
    ("of another threshold", {"a.ph": cloud(), "b.ph": cloud(1, limit=9.)}, "found parts that differ in points, options"),
    ("a cloud and an image", {"a.ph": cloud(), "b.ph": image()}, "found kind 'image'"),
    ("a cloud and inputs", {"a.ph": cloud(), "b.ph": inputs()}, "found kind 'inputs'"),
    ("inputs of other names", {"a.ph": inputs(parts=2), "b.ph": inputs((b"a.txt", b"c.txt"), 1, 2)}, "differ in inputs"),
    ("inputs with other options",
     {"a.ph": inputs(parts=2), "b.ph": inputs(part=1, parts=2, options=[b"--max-dim 2"])}, "differ in inputs"),
    ("inputs, one of two parts", {"a.ph": inputs(parts=2)}, "found 1 of 2 parts"),
    ("inputs, a part twice", {"a.ph": inputs(parts=2), "b.ph": inputs(parts=2)}, "twice"),
    ("a part and a table", {"a.ph": cloud(), "b.ph": SQUARE}, "that do not begin with"),
    ("a part and nothing", {"a.ph": cloud(), "b.ph": b""}, "that do not begin with"),
]


def entries():
    for row, rows in ((69, DAMAGED), (70, LYING)):
        for name, content, message in rows:
            yield Entry(row, name, "ph-barcode", ("--join", "a.ph"), 65, message, "a.ph", {"a.ph": content},
                        frugal=True)
    yield Entry(70, "inputs: names with control characters are shown as such", "ph-barcode",
                ("--join", "a.ph", "--quiet"), 0, files={"a.ph": inputs((b"a\x1b[31m", b"b\nc"))},
                output="input,dim,birth,death\na\\x1B[31m,0,0,1\nb\\nc,0,0,1\n")
    for name, files, message in MIXED:
        yield Entry(71, name, "ph-barcode", ("--join", *files), 65, message, ".ph", files)
    yield Entry(71, "a part as points", "ph-barcode", ("a.ph",), 65, "--join", "a.ph", {"a.ph": cloud()})
    part = ("square.txt", "--complex", "rips", "--max-dim", "0", "--part")
    for row, number, message in ((49, "0/2", "--part"), (49, "3/2", "--part"), (49, "1/0", "--part"),
                                 (49, "1", "--part"), (49, "-1/2", "--part"), (49, "1/2/3", "--part"),
                                 (49, "1/99999999999", "--part"), (49, "one/two", "--part")):
        yield Entry(row, f"--part {number}", "ph-barcode", (*part, number, "-o", "a.ph"), 64, "found", message,
                    {"square.txt": SQUARE})


ENTRIES = list(entries())
