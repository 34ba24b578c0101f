# SPDX-License-Identifier: MIT
"""A valid file of a format. The samples are made with the encoders of tests/support/files.py."""
import dataclasses
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "support"))


@dataclasses.dataclass(frozen=True)
class Sample:
    """A small valid file."""
    name: str       # with an extension, by which some formats are recognised
    # Name of the library's function without `read_`; `correlations`: distances with
    # from_correlation.
    reader: str
    content: bytes
    sized: bool     # true if the format declares its end: no shorter file is valid
    arguments: tuple = ("{}",)  # arguments of the program; {} is the file
    program: str = "ph-barcode"  # empty if no program reads the file
    needs: tuple = ()            # names of other samples that the arguments use
