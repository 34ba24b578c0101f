#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""read_with_gudhi.py lower-distance|off|perseus FILE: reads a file with GUDHI's own reader, as its
manual shows, and prints the bars as `dim birth death`. Called by compare_peers.py."""
import sys

import gudhi

form, path = sys.argv[1:]
if form == "perseus":
    complex_ = gudhi.CubicalComplex(perseus_file=path)
    count = complex_.num_simplices()
elif form == "off":
    points = gudhi.read_points_from_off_file(off_file=path)
    count = len(points)
    complex_ = gudhi.RipsComplex(points=points).create_simplex_tree(max_dimension=2)
else:
    rows = gudhi.read_lower_triangular_matrix_from_csv_file(csv_file=path, separator=";")
    count = len(rows)
    complex_ = gudhi.RipsComplex(distance_matrix=rows).create_simplex_tree(max_dimension=2)
if count == 0:
    sys.exit(0)  # nothing was read; the messages on stderr show if GUDHI reported it
for dim, (birth, death) in complex_.persistence():
    print(dim, birth, death)
