# SPDX-License-Identifier: MIT
"""Distances between barcodes, matchings, and barycentres."""
from ._barycentre import Barycentre, barycentre
from ._diagrams import all_rows
from ._matchings import Matching, bottleneck_matching, wasserstein_matching
from ._values import bottleneck, diagram_distances, sliced_wasserstein, wasserstein

__all__ = ["Barycentre", "Matching", "all_rows", "barycentre", "bottleneck", "bottleneck_matching",
           "diagram_distances", "sliced_wasserstein", "wasserstein", "wasserstein_matching"]
