# SPDX-License-Identifier: MIT
"""Debian's Furo is not bundled: its script imports another one, which a page opened as a file must
not, and its style sheet asks a web server for normalize.css. Both are put together here."""
import re
from pathlib import Path

NORMALIZE = Path("/usr/share/javascript/normalize.css/normalize.css")


def bundle(app, error):
    static = Path(app.outdir, "_static")
    script, spy = static / "scripts/furo.js", static / "scripts/gumshoe-patched.js"
    if error or app.builder.format != "html":
        return
    text = script.read_text()
    if text.startswith("import Gumshoe from"):
        script.write_text(spy.read_text() + "\n(() => {\n" + text.partition("\n")[2] + "\n})();\n")
    style = static / "styles/furo.css"
    text = style.read_text()
    whole = re.sub(r"@import url\(/javascript/normalize\.css/normalize\.css\);",
                   lambda _: NORMALIZE.read_text(), text)
    if whole != text:
        style.write_text(whole)


def setup(app):
    app.connect("build-finished", bundle)
    return {"parallel_read_safe": True}
