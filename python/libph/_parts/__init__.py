# SPDX-License-Identifier: MIT
"""Parts of images and clouds that separate processes compute, and their results."""
from ._cloud import CloudPart, cloud_part
from ._image import ImagePart, image_part
from ._join import join_parts
from ._loops import ImageLoops

__all__ = ["CloudPart", "ImageLoops", "ImagePart", "cloud_part", "image_part", "join_parts"]
