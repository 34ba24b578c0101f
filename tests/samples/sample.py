# SPDX-License-Identifier: MIT
"""One valid file of a format. The samples are made with the encoders of tests/support/files.py."""
import dataclasses
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "support"))


@dataclasses.dataclass(frozen=True)
class Sample:
    """A small valid file."""
    name: str       # with its extension, by which some formats are known
    reader: str     # the library's function without `read_`; correlations: distances, from_correlation
    content: bytes
    sized: bool     # the format declares its end: no shorter file is valid
    arguments: tuple = ("{}",)  # of the program; {} is the file
    program: str = "ph-barcode"  # empty: no program reads it
    needs: tuple = ()            # names of further samples in the arguments
