# SPDX-License-Identifier: MIT
"""Makes the menu of the site. An `index` page lists its pages as links for readers of the file; the
menu has the same pages in the same order."""
import posixpath
import re
from pathlib import Path

# The first link of a list item.
LINK = re.compile(r"^\* (?:[^\n]|\n  )*?\]\(([\w./-]+\.md)\)", re.MULTILINE)


def pages_below(file, text, pages):
    """The pages that an index links to, each once."""
    for link in dict.fromkeys(LINK.findall(text)):
        page = pages.get(str((file.parent / link).resolve()))
        if page:
            yield page


def add_menu(app, docname, source):
    if posixpath.basename(docname) == "index":
        file = Path(app.env.doc2path(docname)).resolve()
        pages = "\n".join(f"/{page}" for page in pages_below(file, source[0], app.config.site_docs))
        source[0] += f"\n\n```{{toctree}}\n:hidden:\n\n{pages}\n```\n"


def setup(app):
    app.connect("source-read", add_menu)
    return {"parallel_read_safe": True}
