# SPDX-License-Identifier: MIT
"""CubicalRipser's module tcripser on top of libph: voxels are cubes of the highest dimension."""
from .._core import version as __version__
from .cripser import computePH_T as computePH

__all__ = ["__version__", "computePH"]
