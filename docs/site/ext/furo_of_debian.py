# SPDX-License-Identifier: MIT
"""Fixes the defects of Debian's theme Furo, which was built with other tools. The theme's script
imports a second script, which a page opened as a file must not do. The style sheet requests
normalize.css from a web server, and lacks dark colours for browsers that ask for them. Keyboard
users have to step through the menu on each page."""
import re
from pathlib import Path

NORMALIZE = Path("/usr/share/javascript/normalize.css/normalize.css")


def whole_script(script, spy):
    """The script with the scroll spy that it imports; unchanged if the script imports nothing."""
    first, _, rest = script.partition("\n")
    return f"{spy}\n(() => {{\n{rest}\n}})();\n" if first.startswith("import Gumshoe") else script


def whole_style(style):
    style = re.sub(r"@import url\(/javascript/normalize\.css/normalize\.css\);",
                   lambda _: NORMALIZE.read_text(), style)
    dark = re.search(r'body\[data-theme="dark"\] (\{\s*--[^}]*\})', style)
    if "prefers-color-scheme" not in style and dark:
        style += f'@media screen and (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {dark[1]} }}\n'
    return style


def with_way_to_text(page):
    page = page.replace("<body>", '<body>\n<a class="skip" href="#text">To the text</a>', 1)
    return page.replace('<article role="main">', '<article role="main" id="text">', 1)


def mend(app, error):
    if error or app.builder.format != "html":
        return
    static = Path(app.outdir, "_static")
    script, style = static / "scripts/furo.js", static / "styles/furo.css"
    script.write_text(whole_script(script.read_text(), (static / "scripts/gumshoe-patched.js").read_text()))
    style.write_text(whole_style(style.read_text()))
    for page in Path(app.outdir).rglob("*.html"):
        if "reports" not in page.relative_to(app.outdir).parts:
            page.write_text(with_way_to_text(page.read_text()))


def setup(app):
    app.connect("build-finished", mend)
    return {"parallel_read_safe": True}
