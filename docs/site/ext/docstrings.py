# SPDX-License-Identifier: MIT
"""Corrects docstrings that napoleon and autodoc render wrongly."""
import re

# A name that ends in an underscore, like scikit-learn's attributes, would be a reference in reST.
TRAILING = re.compile(r"^(:(?:ivar|vartype) [^:]*?)_(?=[:,])")
FIELD = re.compile(r"Alias for field number \d+")


def mend(app, what, name, thing, options, lines):
    # The line that autodoc writes for a field of a named tuple.
    if lines and FIELD.fullmatch(lines[0]):
        lines[:] = []
    lines[:] = [TRAILING.sub(r"\1\\_", line) for line in lines]


def setup(app):
    app.connect("autodoc-process-docstring", mend, priority=900)  # runs after napoleon
    return {"parallel_read_safe": True}
