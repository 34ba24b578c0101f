# SPDX-License-Identifier: MIT
"""Point clouds and depth images, segmented into objects."""
from ._objects import Objects, SceneSurface, Segment
from ._segment import segment
from ._segmentation import Segmentation, Voxels

__all__ = ["Objects", "SceneSurface", "Segment", "Segmentation", "Voxels", "segment"]
