# SPDX-License-Identifier: MIT
"""Parts of images and of clouds that processes compute apart, and what they make together."""
from ._cloud import CloudPart, cloud_part
from ._image import ImagePart, image_part
from ._join import join_parts
from ._loops import ImageLoops

__all__ = ["CloudPart", "ImageLoops", "ImagePart", "cloud_part", "image_part", "join_parts"]
