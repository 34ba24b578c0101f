# SPDX-License-Identifier: MIT
"""Point clouds and depth images, segmented into objects."""
from ._objects import Objects, SceneSurface, Segment
from ._segment import segment
from ._segmentation import Segmentation, Voxels
from ._tracker import LabelTracker, Tracked

__all__ = ["LabelTracker", "Objects", "SceneSurface", "Segment", "Segmentation", "Tracked",
           "Voxels", "segment"]
