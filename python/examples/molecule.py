#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pore through a ring of five proteins: its surface, the place where it closes, and the
diagram: molecule.py PICTURE.

The atoms come from PDB entry 1TII, which is part of PyMOL (Debian: pymol-data)."""
import sys

import matplotlib
import numpy as np

import libph as ph

FILE = "/usr/share/pymol/data/demo/1tii.pdb"
RADII = {"C": 1.7, "N": 1.55, "O": 1.52, "S": 1.8}  # Å: Bondi, van der Waals volumes and radii, 1964


def atoms_of(path, chains):
    """Positions and radii of the atoms of some chains, in Å."""
    with open(path) as file:
        rows = [line for line in file if line.startswith("ATOM") and line[21] in chains]
    places = np.array([[float(line[k:k + 8]) for k in (30, 38, 46)] for line in rows])
    return places, np.array([RADII[line[76:78].strip()] for line in rows])


def picture(path):
    import matplotlib.pyplot as plt
    places, radii = atoms_of(FILE, "DEFGH")
    # The view is along the axis of the ring, the direction in which the ring is thinnest.
    middle = places.mean(axis=0)
    axes = np.linalg.svd(places - middle, full_matrices=False)[2]
    places = (places - middle) @ axes.T
    bars = ph.alpha(places, weights=radii**2)
    pore = int(np.diff(bars.dgm(1)).argmax())
    narrowest = places[bars.death_cells(1)[pore]]  # three atoms, where a growing ring closes
    surface = ph.alpha_shape(places, 0, weights=radii**2)

    figure = plt.figure(figsize=(11, 5), constrained_layout=True)
    view = figure.add_subplot(1, 2, 1, projection="3d", computed_zorder=False)
    view.plot_trisurf(*places.T, triangles=surface.triangles, color="#b9c7d6", linewidth=0)
    view.plot_trisurf(*narrowest.T, triangles=[[0, 1, 2]], color="#d1495b")
    view.view_init(elev=75, azim=0)
    view.set_axis_off()
    view.set_box_aspect(np.ptp(places, axis=0), zoom=1.5)
    view.set_title("surface of the atoms, and where the pore closes")
    bars.plot(ax=figure.add_subplot(1, 2, 2))
    figure.axes[1].set(xlabel="Birth, Å²", ylabel="Death, Å²", title="")
    figure.savefig(path, dpi=80, metadata={"Software": None})
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    matplotlib.use("agg")
    picture(sys.argv[1])
