# SPDX-License-Identifier: MIT
"""Barcodes and the data of their bars: cells, chains, loops."""
from ._barcode import Bar, Barcode
from ._chains import Chain, Loop

__all__ = ["Bar", "Barcode", "Chain", "Loop"]
