# SPDX-License-Identifier: MIT
"""Corrects docstrings that napoleon and autodoc render wrongly."""
import re

# reST takes a name that ends in an underscore, like scikit-learn's attributes, for a reference.
TRAILING = re.compile(r"^(:(?:ivar|vartype) [^:]*?)_(?=[:,])")
FIELD = re.compile(r"Alias for field number \d+")


def mend(app, what, name, thing, options, lines):
    if lines and FIELD.fullmatch(lines[0]):  # from a named tuple, which describes the field
        lines[:] = []
    lines[:] = [TRAILING.sub(r"\1\\_", line) for line in lines]


def setup(app):
    app.connect("autodoc-process-docstring", mend, priority=900)  # after napoleon
    return {"parallel_read_safe": True}
