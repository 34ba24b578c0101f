# SPDX-License-Identifier: MIT
"""giotto-ph's constants about fields."""

__all__ = ["get_max_coefficient_field_supported"]


def get_max_coefficient_field_supported() -> int:
    """giotto-ph's bound for `coeff`. libph accepts primes up to 2**31 - 1."""
    return 255
