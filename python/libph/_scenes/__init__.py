# SPDX-License-Identifier: MIT
"""Point clouds and depth images, segmented into objects."""
from ._objects import Objects, Segment
from ._segment import segment
from ._segmentation import SceneSurface, Segmentation, Voxels

__all__ = ["Objects", "SceneSurface", "Segment", "Segmentation", "Voxels", "segment"]
