# SPDX-License-Identifier: MIT
"""Changes how code looks. Short code within a line, such as `--min-size`, is not broken, although
browsers break lines at each hyphen. The empty line that doctest needs at the end of a block is
removed."""
from docutils import nodes
from sphinx.transforms import SphinxTransform

LONGEST = 24


class ShownCode(SphinxTransform):
    default_priority = 400

    def apply(self):
        for code in self.document.findall(nodes.literal):
            if len(code.astext()) <= LONGEST:
                code["classes"].append("short")
        for block in list(self.document.findall(nodes.literal_block)):
            text = block.astext().rstrip("\n")
            if len(block.children) == 1:
                block.rawsource = text
                block[:] = [nodes.Text(text)]


def setup(app):
    app.add_transform(ShownCode)
    return {"parallel_read_safe": True}
