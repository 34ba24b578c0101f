# SPDX-License-Identifier: MIT
"""Short code within a line, as `--min-size`, is not broken: browsers break at each hyphen."""
from docutils import nodes
from sphinx.transforms import SphinxTransform

LONGEST = 24


class ShortCode(SphinxTransform):
    default_priority = 400

    def apply(self):
        for code in self.document.findall(nodes.literal):
            if len(code.astext()) <= LONGEST:
                code["classes"].append("short")


def setup(app):
    app.add_transform(ShortCode)
    return {"parallel_read_safe": True}
