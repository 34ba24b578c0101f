# SPDX-License-Identifier: MIT
"""GUDHI's module random."""
from ... import _options

__all__ = ["set_seed"]


def set_seed(seed: int) -> None:
    """Has no effect, because nothing in this drop-in is random.

    Parameters
    ----------
    seed : int
    """
    _options.whole("seed", seed, 0)
