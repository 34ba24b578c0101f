# SPDX-License-Identifier: MIT
"""What napoleon and autodoc make of docstrings that reads wrongly."""
import re

# A name that ends in an underscore, as attributes of scikit-learn do, is a reference for reST.
TRAILING = re.compile(r"^(:(?:ivar|vartype) [^:]*?)_(?=[:,])")
FIELD = re.compile(r"Alias for field number \d+")


def mend(app, what, name, thing, options, lines):
    if lines and FIELD.fullmatch(lines[0]):  # of a named tuple, which describes it
        lines[:] = []
    lines[:] = [TRAILING.sub(r"\1\\_", line) for line in lines]


def setup(app):
    app.connect("autodoc-process-docstring", mend, priority=900)  # after napoleon
    return {"parallel_read_safe": True}
