# SPDX-License-Identifier: MIT
"""Fills in generated content. A page has a line

    <!-- site: KIND ARGUMENTS -->

which is invisible to readers of the file. Kinds:

    cpp HEADER…         the declarations of public headers, described by their comments
    python NAME…        functions and classes of the package libph, described by their docstrings
    options PROGRAM     the options of a program, as the program prints them
    schema FILE         a JSON Schema as a table of members
    report NAME         a link to a report that a program made for build.py
"""
import json
import re
import shutil
from pathlib import Path

from group import group_of, head_of
from schema_tables import tables

MARKER = re.compile(r"^<!-- site: (\w+) (.*?) -->$", re.MULTILINE)


def fence(directive, body="", of=""):
    return f"````{{{directive}}} {of}\n{body}\n````\n"


def rst(*lines):
    return fence("eval-rst", "\n".join(lines))


def cpp(app, *headers):
    return "\n".join(f"{head_of(text_of(app, header))}\n" +
                     fence("doxygengroup", ":content-only:\n:members:", group_of(header)) for header in headers)


def text_of(app, header):
    file, = Path(app.config.site_root).glob(f"lib*/**/include/{header}")
    return file.read_text()


def members(thing):
    """The members of a class that libph itself defines, in the order of the source; members of
    foreign base classes are left out."""
    own = [name for base in thing.__mro__ if base.__module__.startswith("libph") for name in vars(base)]
    return [name for name in dict.fromkeys(own) if not name.startswith("_")]


def python(app, *names):
    if not app.config.site_has_python:
        return fence("warning", "This copy of the site was built without the compiled module of "
                                "libph: the reference of Python is left out.")
    import importlib
    from sphinx.ext.autodoc.mock import mock
    made = []
    for name in names:
        module, _, attribute = name.rpartition(".")
        with mock(app.config.autodoc_mock_imports):
            thing = getattr(importlib.import_module(module), attribute)
        if isinstance(thing, type):
            made.append(rst(f".. autoclass:: {name}", f"   :members: {', '.join(members(thing))}"))
        else:
            made.append(rst(f".. autofunction:: {name}"))
    return "\n".join(made)


def options(app, program):
    file = Path(app.config.site_made, "printed", f"{program}.md")
    if not file.exists():
        return fence("warning", "This copy of the site was built without the programs: their options "
                                "are left out.")
    return file.read_text().partition("\n")[2]  # without the first line: the page has its own title


def schema(app, name):
    return tables(json.loads(Path(app.config.site_root, name).read_text()))


def report(app, name):
    if not Path(app.config.site_made, "reports", f"{name}.html").exists():
        return fence("warning", "This copy of the site was built without the programs: the report is left out.")
    return f'<p><a class="report" href="reports/{name}.html">Open this report</a></p>\n'


def copy_reports(app):
    """Copies the reports beside the pages, as separate files."""
    made = Path(app.config.site_made, "reports")
    if app.builder.format == "html" and made.exists():
        shutil.copytree(made, Path(app.outdir, "reports"), dirs_exist_ok=True)
    return []


KINDS = {"cpp": cpp, "python": python, "options": options, "report": report, "schema": schema}


def fill_in(app, docname, source):
    def made(match):
        return KINDS[match[1]](app, *match[2].split())
    source[0] = MARKER.sub(made, source[0])


def setup(app):
    app.add_config_value("site_made", "", "env")
    app.add_config_value("site_has_python", False, "env")
    app.connect("source-read", fill_in)
    app.connect("html-collect-pages", copy_reports)
    return {"parallel_read_safe": True}
