# SPDX-License-Identifier: MIT
"""What giotto-ph says of its fields."""

__all__ = ["get_max_coefficient_field_supported"]


def get_max_coefficient_field_supported() -> int:
    """The bound that giotto-ph has for `coeff`. libph takes primes up to 2**31 - 1."""
    return 255
