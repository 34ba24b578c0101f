# SPDX-License-Identifier: MIT
"""Samples of barcodes as ph-barcode and other programs write them."""
from sample import Sample
from files import dipha, npy, packed


def barcode(name, content, sized=False):
    return Sample(name, "barcode", content, sized, (), "")


JSON = b"""{"format": "ph-barcode", "version": 1, "program": "ph-barcode 0.1",
"input": {"path": "a \\u00e9.txt", "description": "2 points in R^1, text"}, "complex": "rips",
"field": 2, "max_dim": 1, "threshold": null, "engine": "cohomology",
"bars": [
{"dim": 0, "birth": 0, "death": 1.5, "birth_cell": {"vertices": [1]}, "death_cell": {"vertices": [0, 1]}},
{"dim": 0, "birth": 0, "death": null, "birth_cell": {"vertices": [0]}, "death_cell": null}
], "timings": {"read": 0.001}, "peak_memory": 4096}
"""
CYCLES = b"""{"format": "ph-barcode", "version": 1, "representatives": "cycles", "bars": [
{"dim": 1, "birth": "-inf", "death": 2, "birth_cell": {"grid": [1, 0]}, "death_cell": {"grid": [1, 1]},
"representative": [{"grid": [1, 0], "coefficient": 1}, {"grid": [0, 1], "coefficient": -1}]}
]}"""
ROWS = (b'{"format": "ph-barcode", "version": 1, "complex": "explicit", "bars": ['
        + b",".join(b'{"dim": %d, "birth": %d, "death": %d.5, "birth_cell": {"row": %d},'
                    b' "death_cell": {"row": %d}}' % (i % 3, i, i, i, i + 1) for i in range(6))
        + b"]}")
RIPSER = b"""value range: [0,2]
distance matrix with 4 points
persistence intervals in dim 0:
 [0,1)
 [0, )
persistence intervals in dim 1:
 [1.25,1.41421)
"""

SAMPLES = [
    barcode("bars.csv", b"dim,birth,death\n0,0,1.5\n0,0,inf\n1,1.25,2\n"),
    barcode("minus_infinity.csv", b"dim,birth,death\n0,-inf,inf\n"),
    barcode("bars.json", JSON, sized=True),
    barcode("cycles.json", CYCLES, sized=True),
    barcode("rows.json", ROWS, sized=True),
    barcode("bars.ripser", RIPSER),
    barcode("bars.pers", b"0 0 1.5\n0 0 inf\n1 1.25 2\n"),
    barcode("characteristic.pers", b"2  0 0 1.5\n2  0 0 inf\n3  1 1.25 2\n"),
    barcode("bars.dipha", dipha(2, 3, 0, 0., 1.5, -1, 0., 2., 1, 1.25, 2.), sized=True),
    barcode("bars.npy", npy("<f8", (2, 3), packed("<f8", [0, 0, 1.5, 0, 0, float("inf")])),
            sized=True),
]
